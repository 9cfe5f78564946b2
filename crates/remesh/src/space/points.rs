//! Values of the integration points of a new mesh, as in 2D.
//!
//! Sub-cells are cells with one point, and with a point for each corner the parts of a cell at its corners,
//! between middles of edges, centres of faces and of the cell. Points do not stand at centres of sub-cells:
//! within a cell a field is taken as the function of its reference coordinates, linear along each, that has
//! the values of the points, and as linear in the tetrahedra of the sub-cells; means over these are a matrix
//! times the values, and integrals over the cell weights of the points: the Jacobians but for terms of second
//! order in the warping. Linear fields are exact in warped cells too; in tetrahedra of ten nodes whose edges
//! are curved they are but for what the middle nodes are off.

use super::boundary::{outer_faces, slivers};
use super::clip::Tet;
use super::cut::{Cut, Local, Plan};
use super::kind::SIGNS;
use super::tets::{Search, Tets, local};
use super::vector::{dot, minus};
use super::{Failure, Kind, Mesh, Order, Point, Side, Values};
use crate::shared::limiter::{Layout, Map, Rule as Matrices, Share, merged, neighbours};
use crate::shared::uncovered;

/// Integration points of the cells of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// One in each cell.
    One,
    /// Hexahedra have eight, at ±1/√3 in the order of the corners; wedges six, at 1/6 and 2/3 in the triangle
    /// and ±1/√3 across; tetrahedra of ten nodes four, at (5 ± (3 or 1) √5)/20: each the nearest to its
    /// corner. Tetrahedra of four nodes have one.
    Full,
}

/// Integration points of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a> {
    /// The mesh.
    pub mesh: Mesh<'a>,
    /// Points of each cell.
    pub rule: Rule,
}

impl Points<'_> {
    /// Number of points of a cell of a kind.
    #[must_use]
    pub fn of(rule: Rule, kind: Kind) -> usize {
        match (rule, kind) {
            (Rule::One, _) | (_, Kind::Tetrahedron) => 1,
            (Rule::Full, kind) => kind.corners(),
        }
    }

    fn cut(&self) -> Cut {
        match self.rule {
            Rule::One => Cut::Cells,
            Rule::Full => Cut::Parts,
        }
    }

    fn layout(&self, rules: Vec<Option<Matrices>>) -> Layout {
        Layout::new(self.mesh.cells.iter().map(|cell| Self::of(self.rule, cell.kind())), rules)
    }
}

/// The overlaps of the sub-cells of two meshes.
#[derive(Debug)]
pub struct PointMap {
    map: Map<3>,
}

/// The values of the new mesh's points, `width` numbers by point, points by cell.
///
/// # Errors
/// As `PointMap::new` and `PointMap::values`.
pub fn points(old: &Points<'_>, new: &Points<'_>, values: &Values<'_>) -> Result<Vec<f64>, Failure> {
    PointMap::new(old, new)?.values(values)
}

impl PointMap {
    /// The overlaps of two meshes.
    ///
    /// # Errors
    /// `Size`; `Inverted`; `Uncovered`; `Overlap`.
    pub fn new(old: &Points<'_>, new: &Points<'_>) -> Result<Self, Failure> {
        let plans = [old, new].map(|points| Plan::all(points.cut()));
        let tets = Tets::of(&plans[0], old.mesh)?;
        let (old_rules, sub_cells) = described(&plans[0], old)?;
        let old_layout = old.layout(old_rules);
        let starts = &old_layout.starts;
        let of_old = |index: usize| starts[tets.all[index].cell as usize] + u32::from(tets.all[index].part);
        let (volumes, centres) = centres(&tets, old_layout.len(), of_old);
        let share = |index: usize, new: u32, moments: &[f64; 4]| {
            let (old, mut moment) = (of_old(index), [0.0; 3]);
            for (part, place) in moments.iter().zip(tets.places_of(&tets.all[index])) {
                let arm = minus(place, centres[old as usize]);
                (0..3).for_each(|k| moment[k] += part * arm[k]);
            }
            Share { old, new, volume: moments.iter().sum(), moment }
        };
        let mut found = Overlaps { within: vec![[0.0; 4]; tets.all.len()], shares: Vec::new(), rules: Vec::new() };
        found.gather(&plans[1], &tets, new, share)?;
        let new_layout = new.layout(std::mem::take(&mut found.rules));
        let (slivers, triangles) = slivers(&tets, &found.within, &plans[1], new.mesh)?;
        for sliver in &slivers {
            let triangle = &triangles[sliver.triangle as usize];
            let to = new_layout.starts[triangle.cell as usize] + u32::from(triangle.part);
            found.shares.push(share(sliver.old as usize, to, &sliver.moments));
        }
        let (starts, neighbours) = neighbours(sub_cells.iter(), sub_cells.count);
        let (outer, shares) = (sub_cells.outer, merged(found.shares));
        let map = Map { old: old_layout, new: new_layout, shares, centres, volumes, starts, neighbours, outer, solve: slope };
        Ok(Self { map })
    }

    /// Number of pairs of sub-cells that overlap.
    #[must_use]
    pub fn pairs(&self) -> usize {
        self.map.shares.len()
    }

    /// Weights of points in which the integral is kept, Σ w φ: volumes (m³), or masses (kg) with densities.
    /// Old ones, then new ones. New material weighs what it has come from, whatever the new cell's volume.
    ///
    /// # Errors
    /// `Size` if there is not one density for each old cell; `Massless` for one that is not positive.
    pub fn weights(&self, densities: Option<&[f64]>, order: Order) -> Result<[Vec<f64>; 2], Failure> {
        self.map.weights(densities, order)
    }

    /// The values of the new mesh's points, `width` numbers by point. Sums Σ w φ with `weights` are kept.
    ///
    /// # Errors
    /// `Size`; `Number`; `Massless` for a density that is not positive.
    pub fn values(&self, of: &Values<'_>) -> Result<Vec<f64>, Failure> {
        self.map.values(of)
    }
}

/// What the pieces give.
struct Overlaps {
    /// Of each old tetrahedron ∫ λ_j dV over its pieces.
    within: Vec<[f64; 4]>,
    /// By new cell.
    shares: Vec<Share<3>>,
    rules: Vec<Option<Matrices>>,
}

impl Overlaps {
    fn gather(
        &mut self,
        plans: &[Plan; 4],
        tets: &Tets,
        new: &Points<'_>,
        share: impl Fn(usize, u32, &[f64; 4]) -> Share<3>,
    ) -> Result<(), Failure> {
        let (mut covered, mut volumes) = (Vec::new(), Vec::new());
        let (mut search, mut first, mut of_cell) = (Search::new(tets), 0u32, Vec::new());
        for cell in 0..new.mesh.cells.len() {
            let local = local(plans, new.mesh, cell, Side::New)?;
            of_cell.clear();
            for (tet, &volume) in local.volumes.iter().enumerate() {
                let to = first + u32::from(local.plan.parts[tet]);
                search.pieces(&Tet::new(local.tet(tet), volume), |index, piece| {
                    let Some(moments) = piece.moments() else { return };
                    (0..4).for_each(|j| self.within[index][j] += moments[j]);
                    of_cell.push(share(index, to, &moments));
                });
            }
            covered.push(of_cell.iter().map(|share| share.volume).sum());
            volumes.push(local.volumes.iter().sum());
            self.shares.extend(merged(std::mem::take(&mut of_cell)));
            self.rules.push(matrices(&local, new.mesh.cells[cell].kind(), new.rule));
            first += local.plan.count as u32;
        }
        uncovered(&covered, &volumes).map(|_| ())
    }
}

/// Volumes and centres of the old sub-cells.
fn centres(tets: &Tets, count: usize, of: impl Fn(usize) -> u32) -> (Vec<f64>, Vec<Point>) {
    let (mut volumes, mut centres) = (vec![0.0; count], vec![[0.0; 3]; count]);
    for (index, tet) in tets.all.iter().enumerate() {
        volumes[of(index) as usize] += tet.volume;
    }
    for (index, tet) in tets.all.iter().enumerate() {
        let (e, x) = (of(index) as usize, tets.places_of(tet));
        (0..3).for_each(|k| centres[e][k] += 0.25 * tet.volume / volumes[e] * (x[0][k] + x[1][k] + x[2][k] + x[3][k]));
    }
    (volumes, centres)
}

/// Vertices of the old sub-cells.
struct SubCells {
    /// Of each sub-cell the first of its vertices; one more at the end.
    starts: Vec<u32>,
    vertices: Vec<u32>,
    /// Number of vertices.
    count: usize,
    /// Sub-cells with a vertex on the outline, and that.
    outer: Vec<(u32, Point)>,
}

impl SubCells {
    fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        self.starts.windows(2).map(|pair| &self.vertices[pair[0] as usize..pair[1] as usize])
    }
}

/// A vertex as the nodes of which it is the mean: as both cells of a face have it.
fn key(set: &[u8], nodes: &[u32]) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    key.iter_mut().zip(set).for_each(|(place, &node)| *place = nodes[usize::from(node)]);
    key.sort_unstable();
    key
}

/// Matrices of the cells of a mesh, and the vertices of its sub-cells.
fn described(plans: &[Plan; 4], of: &Points<'_>) -> Result<(Vec<Option<Matrices>>, SubCells), Failure> {
    let mesh = of.mesh;
    let plan_of = |cell: usize| &plans[mesh.cells[cell].kind() as usize];
    // Vertices of whole cells are their nodes; the middle of a cell has no neighbours.
    let is_vertex = |plan: &Plan, vertex: usize| {
        plan.centre.is_none_or(|centre| usize::from(centre) != vertex) && (of.rule == Rule::Full || plan.sets[vertex].len() == 1)
    };
    let mut keys: Vec<[u32; 4]> = Vec::new();
    for (index, cell) in mesh.cells.iter().enumerate() {
        let plan = plan_of(index);
        keys.extend((0..plan.sets.len()).filter(|&v| is_vertex(plan, v)).map(|v| key(&plan.sets[v], cell.nodes())));
    }
    keys.sort_unstable();
    keys.dedup();
    let number = |cell: usize, vertex: usize| keys.binary_search(&key(&plan_of(cell).sets[vertex], mesh.cells[cell].nodes())).unwrap_or(0);
    let mut is_outer = vec![false; keys.len()];
    for (cell, face) in outer_faces(mesh) {
        let plan = plan_of(cell as usize);
        for facet in plan.facets.iter().filter(|facet| facet.face == face) {
            for vertex in facet.vertices.map(usize::from).into_iter().filter(|&v| is_vertex(plan, v)) {
                is_outer[number(cell as usize, vertex)] = true;
            }
        }
    }
    let mut found = SubCells { starts: vec![0], vertices: Vec::new(), count: keys.len(), outer: Vec::new() };
    let mut rules = Vec::with_capacity(mesh.cells.len());
    for (index, cell) in mesh.cells.iter().enumerate() {
        let local = local(plans, mesh, index, Side::Old)?;
        rules.push(matrices(&local, cell.kind(), of.rule));
        for part in 0..local.plan.count {
            let own = local.plan.tets.iter().zip(&local.plan.parts).filter(|(_, of)| usize::from(**of) == part);
            let mut vertices: Vec<u8> = own.flat_map(|(tet, _)| *tet).collect();
            vertices.sort_unstable();
            vertices.dedup();
            for vertex in vertices.into_iter().map(usize::from).filter(|&v| is_vertex(local.plan, v)) {
                let number = number(index, vertex);
                found.vertices.push(number as u32);
                if is_outer[number] {
                    found.outer.push((found.starts.len() as u32 - 1, local.places[vertex]));
                }
            }
            found.starts.push(found.vertices.len() as u32);
        }
    }
    Ok((rules, found))
}

/// Means over the sub-cells of a cell from the values of its points. `None` where there is one point, or
/// where values are taken as means.
fn matrices(local: &Local<'_>, kind: Kind, rule: Rule) -> Option<Matrices> {
    match (rule, kind) {
        (Rule::One, _) | (_, Kind::Tetrahedron) => None,
        (_, Kind::Wedge) => means(local, &wedge()),
        (_, Kind::Hexahedron) => means(local, &hexahedron()),
        (_, Kind::Tetrahedron10) => means(local, &tetrahedron10()),
    }
}

/// Means over sub-cells of functions that are linear in their tetrahedra, from values of points: the nodes
/// have the values `at_nodes`. A point stands for the integral of the function that is one at it, and
/// nothing at the others.
fn means<const N: usize>(local: &Local<'_>, at_nodes: &[[f64; N]]) -> Option<Matrices> {
    let (mut found, mut volumes, mut of_points) = ([[0.0; N]; N], [0.0; N], [0.0; N]);
    for (index, (tet, &part)) in local.plan.tets.iter().zip(&local.plan.parts).enumerate() {
        let (part, volume) = (usize::from(part), local.volumes[index]);
        volumes[part] += volume;
        for &vertex in tet {
            for (values, weight) in at_nodes.iter().zip(local.shape(vertex)) {
                (0..N).for_each(|p| found[part][p] += 0.25 * volume * weight * values[p]);
            }
        }
    }
    for (row, volume) in found.iter_mut().zip(&volumes) {
        (0..N).for_each(|p| of_points[p] += row[p]);
        row.iter_mut().for_each(|entry| *entry /= volume);
    }
    Matrices::of(&found, &of_points)
}

/// Values at the corners from those of the points: along each reference coordinate (1 ± √3)/2.
fn hexahedron() -> [[f64; 8]; 8] {
    let root = 3.0f64.sqrt();
    SIGNS.map(|corner| SIGNS.map(|point| (0..3).fold(1.0, |product, k| product * 0.5 * (1.0 + corner[k] * point[k] * root))))
}

/// In the triangle 2 δ − 1/3, across as in hexahedra.
fn wedge() -> [[f64; 6]; 6] {
    let root = 3.0f64.sqrt();
    std::array::from_fn(|corner| {
        std::array::from_fn(|point| {
            let in_triangle = if corner % 3 == point % 3 { 5.0 / 3.0 } else { -1.0 / 3.0 };
            in_triangle * 0.5 * if corner / 3 == point / 3 { 1.0 + root } else { 1.0 - root }
        })
    })
}

/// √5 δ − (√5 − 1)/4 at corners, means of these in the middles of edges.
fn tetrahedron10() -> [[f64; 4]; 10] {
    let root = 5.0f64.sqrt();
    let corner =
        |corner: usize| -> [f64; 4] { std::array::from_fn(|point| if corner == point { root } else { 0.0 } - 0.25 * (root - 1.0)) };
    std::array::from_fn(|node| match super::kind::EDGES.get(node.wrapping_sub(4)) {
        Some(&[a, b]) => {
            let (a, b) = (corner(usize::from(a)), corner(usize::from(b)));
            std::array::from_fn(|point| 0.5 * (a[point] + b[point]))
        }
        None => corner(node),
    })
}

/// Solves the normal equations of a slope, of which the upper half is given. Where all neighbours are in a
/// plane or on a line, the slope is in it: the adjugate of a matrix of rank two is n nᵀ times a number.
fn slope(m: [[f64; 3]; 3], right: Point) -> Point {
    let trace = m[0][0] + m[1][1] + m[2][2];
    let (adjugate, determinant) = adjugate(&m);
    let of = |rows: &[[f64; 3]; 3], by: f64| [0, 1, 2].map(|i| dot(rows[i], right) / by);
    if determinant > SINGULAR * trace * trace * trace {
        return of(&adjugate, determinant);
    }
    if adjugate[0][0] + adjugate[1][1] + adjugate[2][2] > SINGULAR * trace * trace {
        let mut regular = m;
        (0..3).for_each(|i| (i..3).for_each(|j| regular[i][j] += adjugate[i][j] / trace));
        let (adjugate, determinant) = self::adjugate(&regular);
        return of(&adjugate, determinant);
    }
    if trace > 0.0 { right.map(|rise| rise / trace) } else { [0.0; 3] }
}

/// Below it a determinant is taken as zero.
const SINGULAR: f64 = 1e-9;

/// The adjugate and the determinant of a symmetric matrix, of which the upper half is given.
fn adjugate(m: &[[f64; 3]; 3]) -> ([[f64; 3]; 3], f64) {
    let [[a, b, c], [_, d, e], [_, _, f]] = *m;
    let (ba, ca, cb) = (c * e - b * f, b * e - c * d, b * c - a * e);
    let rows = [[d * f - e * e, ba, ca], [ba, a * f - c * c, cb], [ca, cb, a * d - b * b]];
    (rows, a * rows[0][0] + b * ba + c * ca)
}
