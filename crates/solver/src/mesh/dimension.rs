//! What a mesh knows of its dimension: the pieces of its outside, its elements' forms and orientation, its
//! curve.
//!
//! [`Mesh`](super::Mesh) is written once for the plane and for space and asks here where the two differ in
//! kind.

use super::Mesh;
use super::cell::{Cell, CellKind, MOST_NODES};
use super::shapes::Body;
use super::surface::{Corners, PlaneSurface, Sided, SpaceSurface};
use crate::error::Fault;
use crate::model::{Model, Part};
use crate::tensor::{Dim, cross};
use crate::vector::{dot, minus, plus, times};

/// A dimension in which there are meshes.
pub trait Meshed<const D: usize> {
    /// A piece of an outside: a segment `[u32; 2]`, or a facet `[u32; 4]`.
    type Facet: Corners;
    /// An oriented surface.
    type Surface: Sided<Facet = Self::Facet>;
    /// Bits of each coordinate along the curve on which nodes and elements are sorted; `D` times as many are
    /// 62 or 63.
    const CURVE_BITS: u32;

    /// See [`exterior`](super::surface::exterior).
    ///
    /// # Errors
    /// As there.
    fn exterior<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<Self::Facet>, Fault>;

    /// The whole outside of cells without the pieces that `leave_out` names, which is asked once for each in
    /// order.
    ///
    /// # Errors
    /// As [`exterior`](super::surface::exterior).
    fn outside_without<'a>(
        cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>,
        leave_out: impl Fn(Self::Facet) -> bool,
    ) -> Result<Self::Surface, Fault>;

    /// The part of the outside of cells that consists of these pieces, kept in their order.
    ///
    /// # Errors
    /// As [`PlaneSurface::new`] and [`SpaceSurface::new`].
    fn surface<'a>(facets: Vec<Self::Facet>, cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Self::Surface, Fault>;

    /// The components of a point in 3D that this dimension has.
    fn of_3d(point: [f64; 3]) -> [f64; D];

    /// Body of a part with a built-in shape, placed; `None` for a group of a mesh file.
    ///
    /// # Errors
    /// A fault, its path from the part on.
    fn body(part: &Part) -> Option<Result<Body<D>, Fault>>
    where
        Dim<D>: Meshed<D>;

    /// What is wrong with the form of a cell whose nodes are in these places, if anything, and what to do
    /// about it.
    fn wrong_form(kind: CellKind, places: &[[f64; D]]) -> Option<[&'static str; 2]>;

    /// Gives shells and beams their faces, and the nodes of shells the directions of the middle.
    fn add_skins(mesh: &mut Mesh<D>, model: &Model)
    where
        Dim<D>: Meshed<D>;

    /// Distance along a Hilbert curve of a cell of a grid of 2^[`Meshed::CURVE_BITS`] cells in each
    /// direction.
    fn along_curve(cell: [u32; D]) -> u64;

    /// Adds to `sums`, at each node of an element, what gives zero when the node is inside and the elements
    /// all around it have added theirs. (Where two fans meet in a point in 2D it may look as if it
    /// were inside: it only lies elsewhere in memory.)
    fn add_around(cell: Cell<'_>, sums: &mut [u64]);
}

const MEND: &str = "fix the mesh there";
const MEND_MIDDLE: &str =
    "move it towards the middle of its edge, or let the mesh generator make straight ones (Gmsh: Mesh.SecondOrderLinear = 1)";
const FOLDED: &str = "is folded over by a node between its corners";
const DEGENERATE: &str = "is degenerate or folds over at a corner";

impl Meshed<2> for Dim<2> {
    type Facet = [u32; 2];
    type Surface = PlaneSurface;
    const CURVE_BITS: u32 = 31;

    fn exterior<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<[u32; 2]>, Fault> {
        PlaneSurface::exterior(cells)
    }

    fn outside_without<'a>(
        cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>,
        leave_out: impl Fn([u32; 2]) -> bool,
    ) -> Result<PlaneSurface, Fault> {
        PlaneSurface::outside_without(cells, leave_out)
    }

    fn surface<'a>(segments: Vec<[u32; 2]>, cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<PlaneSurface, Fault> {
        PlaneSurface::new(segments, cells)
    }

    fn of_3d([x, y, _]: [f64; 3]) -> [f64; 2] {
        [x, y]
    }

    fn body(part: &Part) -> Option<Result<Body<2>, Fault>> {
        part.plane_body()
    }

    /// Every corner must turn counter-clockwise: then the Jacobian is positive in the whole element, and so
    /// is a triangle's area.
    fn wrong_form(kind: CellKind, places: &[[f64; 2]]) -> Option<[&'static str; 2]> {
        let n = kind.corners();
        let x = |corner: usize| places[corner % n];
        if kind.dimension() == 1 {
            return has_no_length(places);
        }
        let turns = || {
            (0..n).map(|c| {
                let (a, b, d) = (x(c), x(c + 1), x(c + n - 1));
                (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0])
            })
        };
        if turns().all(|turn| turn > 0.0) {
            let is_folded = kind == CellKind::Triangle6 && !subtriangles(places).all(|area| area > 0.0);
            is_folded.then_some([FOLDED, MEND_MIDDLE])
        } else if turns().all(|turn| turn < 0.0) {
            Some(["has negative area: its nodes run clockwise", "number its nodes counter-clockwise"])
        } else {
            // NaN too.
            Some(["is degenerate or not convex", MEND])
        }
    }

    fn add_skins(mesh: &mut Mesh<2>, model: &Model) {
        mesh.add_skins_of_lines(model);
    }

    fn along_curve(cell: [u32; 2]) -> u64 {
        super::order::hilbert(cell)
    }

    fn add_around(cell: Cell<'_>, sums: &mut [u64]) {
        // Around a node inside each neighbour is once the next one and once the one before.
        for [a, b] in cell.pieces_of_edges().filter(|_| cell.kind.dimension() == 2) {
            sums[a as usize] = sums[a as usize].wrapping_add(b.into());
            sums[b as usize] = sums[b as usize].wrapping_sub(a.into());
        }
    }
}

impl Meshed<3> for Dim<3> {
    type Facet = [u32; 4];
    type Surface = SpaceSurface;
    const CURVE_BITS: u32 = 21;

    fn exterior<'a>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<[u32; 4]>, Fault> {
        SpaceSurface::exterior(cells)
    }

    fn outside_without<'a>(
        cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>,
        leave_out: impl Fn([u32; 4]) -> bool,
    ) -> Result<SpaceSurface, Fault> {
        SpaceSurface::outside_without(cells, leave_out)
    }

    fn surface<'a>(facets: Vec<[u32; 4]>, cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<SpaceSurface, Fault> {
        SpaceSurface::new(facets, cells)
    }

    fn of_3d(point: [f64; 3]) -> [f64; 3] {
        point
    }

    fn body(part: &Part) -> Option<Result<Body<3>, Fault>> {
        part.solid_body()
    }

    /// The edges from every corner must span a positive volume: then the Jacobian is positive at the corners,
    /// and in a tetrahedron everywhere. Those of a surface must turn like the whole of it.
    fn wrong_form(kind: CellKind, places: &[[f64; 3]]) -> Option<[&'static str; 2]> {
        if kind.dimension() == 1 {
            return has_no_length(places);
        }
        if kind.dimension() == 2 {
            let normals = || corner_normals(kind, places.iter().copied());
            let whole = normals().fold([0.0; 3], plus);
            // NaN too.
            let is_sound = normals().all(|normal| dot(normal, whole) > 0.0);
            return (!is_sound).then_some([DEGENERATE, MEND]);
        }
        let volumes = || corner_volumes(kind, places);
        if volumes().all(|volume| volume > 0.0) {
            let is_folded = kind == CellKind::Tetrahedron10 && !subtetrahedra(places).all(|volume| volume > 0.0);
            is_folded.then_some([FOLDED, MEND_MIDDLE])
        } else if volumes().all(|volume| volume < 0.0) {
            Some(["has negative volume: its nodes run the wrong way round", "exchange its lower and its upper nodes"])
        } else {
            // NaN too.
            Some([DEGENERATE, MEND])
        }
    }

    fn add_skins(mesh: &mut Mesh<3>, model: &Model) {
        mesh.add_skins_of_surfaces(model, Part::is_of_shells);
        mesh.add_skins_of_beams(model);
        mesh.add_hubs_of_beams(model);
    }

    fn along_curve(cell: [u32; 3]) -> u64 {
        super::order::hilbert_in_3d(cell)
    }

    fn add_around(cell: Cell<'_>, sums: &mut [u64]) {
        // A facet inside is seen once from each side: what it adds for one cell it takes for the other.
        for facet in cell.facets().filter(|_| cell.kind.dimension() == 3) {
            let [lowest, next, c, d] = facet.canonical();
            let (opposite, before) = if c == d { (0, c) } else { (c, d) };
            let mixed = [lowest, next.min(before), opposite, next.max(before)].iter().fold(0, |mixed, &node| mix(mixed ^ u64::from(node)));
            let signed = if next > before { mixed } else { mixed.wrapping_neg() };
            for &node in facet.corners() {
                let sum = &mut sums[node as usize];
                *sum = sum.wrapping_add(signed);
            }
        }
    }
}

/// Twice the areas of the four of which a six-node triangle is made, m².
fn subtriangles(places: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    CellKind::Triangle6.facts().facets.iter().map(|facet| {
        let [a, b, c, _] = facet.map(|k| places[usize::from(k)]);
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    })
}

/// A number that has nothing in common with the one before. Steele, Lea, Flood, OOPSLA 2014 (SplitMix).
fn mix(number: u64) -> u64 {
    let number = number.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let number = (number ^ number >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let number = (number ^ number >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    number ^ number >> 31
}

fn has_no_length<const D: usize>(ends: &[[f64; D]]) -> Option<[&'static str; 2]> {
    let length: f64 = (0..D).map(|k| (ends[1][k] - ends[0][k]) * (ends[1][k] - ends[0][k])).sum();
    // NaN too.
    if length > 0.0 { None } else { Some(["has no length", MEND]) }
}

/// Areas times normals that the edges from each corner of a surface span, m²: of a triangle twice its area.
pub(in crate::mesh) fn corner_normals(kind: CellKind, places: impl Iterator<Item = [f64; 3]>) -> impl Iterator<Item = [f64; 3]> {
    let mut all = [[0.0; 3]; MOST_NODES];
    places.zip(&mut all).for_each(|(x, place)| *place = x);
    let two = kind.facts().neighbours.iter().map_while(|neighbours| neighbours.first_chunk::<2>());
    two.enumerate().map(move |(corner, neighbours)| {
        let [a, b] = neighbours.map(|k| minus(all[usize::from(k)], all[corner]));
        cross(a, b)
    })
}

/// Volume a · (b × c) that the edges from each corner of a cell span, m³: of a hexahedron eight times, of a
/// wedge four times the Jacobian there, of a tetrahedron six times its volume.
pub(in crate::mesh) fn corner_volumes(kind: CellKind, places: &[[f64; 3]]) -> impl Iterator<Item = f64> {
    let three = kind.facts().neighbours.iter().map_while(|neighbours| neighbours.first_chunk::<3>());
    places.iter().zip(three).map(|(x, neighbours)| {
        let [a, b, c] = neighbours.map(|k| {
            let y = places[usize::from(k)];
            [y[0] - x[0], y[1] - x[1], y[2] - x[2]]
        });
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    })
}

/// Six times the volumes of the twelve tetrahedra of which one of ten nodes consists, m³: at the corners, and
/// around the mean of the nodes between them towards corners and faces.
fn subtetrahedra(places: &[[f64; 3]]) -> impl Iterator<Item = f64> + '_ {
    // By corner: the nodes next to it, and those of the face opposite; right-handed seen from it.
    const NEXT: [([usize; 3], [usize; 3]); 4] =
        [([4, 6, 7], [5, 9, 8]), ([5, 4, 8], [6, 7, 9]), ([6, 5, 9], [4, 8, 7]), ([9, 8, 7], [5, 4, 6])];
    let middle = times(1.0 / 6.0, places[4..].iter().fold([0.0; 3], |sum, &x| plus(sum, x)));
    let volume = move |apex: [f64; 3], nodes: [usize; 3]| {
        let [a, b, c] = nodes.map(|node| minus(places[node], apex));
        dot(cross(a, b), c)
    };
    NEXT.into_iter().zip(places).flat_map(move |((near, far), &corner)| {
        let [a, b, c] = near;
        [volume(corner, near), volume(middle, [a, c, b]), volume(middle, far)]
    })
}

/// Volume of a tetrahedron, wedge or hexahedron, m³, as the mean of the Jacobians at its corners: exact for
/// tetrahedra and where opposite edges are parallel; negative for one that is turned inside out, 0 for a cell
/// that is no volume.
#[must_use]
pub fn signed_volume(kind: CellKind, places: &[[f64; 3]]) -> f64 {
    if kind.dimension() != 3 {
        return 0.0;
    }
    corner_volumes(kind, places).sum::<f64>() * kind.facts().size / kind.corners() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    const VOLUMES: [CellKind; 4] = [CellKind::Tetrahedron, CellKind::Wedge, CellKind::Hexahedron, CellKind::Tetrahedron10];

    #[test]
    fn a_cell_that_is_reflected_and_renumbered_has_its_volume() {
        for kind in VOLUMES {
            let reflected: Vec<[f64; 3]> = kind.facts().reference.iter().map(|&[x, y, z]| [-x, y, z]).collect();
            assert!(Dim::<3>::wrong_form(kind, &reflected).unwrap()[0].contains("negative volume"));
            let mut cell: Vec<u32> = (0..kind.nodes() as u32).collect();
            kind.reflect(&mut cell);
            let places: Vec<[f64; 3]> = cell.iter().map(|&k| reflected[k as usize]).collect();
            assert_eq!(Dim::<3>::wrong_form(kind, &places), None);
            assert_eq!(signed_volume(kind, &places), signed_volume(kind, kind.facts().reference));
            assert!(signed_volume(kind, &reflected) < 0.0);
        }
    }

    #[test]
    fn an_element_that_folds_over_or_is_flat_is_wrong() {
        let mut x = CellKind::Hexahedron.facts().reference.to_vec();
        x[6] = [-0.5, -0.5, 0.2];
        assert!(Dim::<3>::wrong_form(CellKind::Hexahedron, &x).unwrap()[0].contains("folds over"));
        let flat: Vec<[f64; 3]> = CellKind::Tetrahedron.facts().reference.iter().map(|&[x, y, _]| [x, y, 0.0]).collect();
        assert!(Dim::<3>::wrong_form(CellKind::Tetrahedron, &flat).is_some());
        assert!(Dim::<3>::wrong_form(CellKind::Tetrahedron, &[[f64::NAN; 3]; 4]).is_some());
    }

    #[test]
    fn a_middle_node_may_leave_its_edge_until_a_part_of_the_element_is_turned_over() {
        let straight = CellKind::Tetrahedron10.facts().reference;
        let with = |middle: [f64; 3]| {
            let mut places = straight.to_vec();
            places[4] = middle;
            Dim::<3>::wrong_form(CellKind::Tetrahedron10, &places)
        };
        assert!(with([0.5, -0.1, 0.1]).is_none() && with([0.6, 0.0, 0.0]).is_none());
        assert!(with([1.1, 0.0, 0.0]).is_some() && with([0.5, 0.6, 0.0]).is_some() && with([f64::NAN; 3]).is_some());
        // The twelve fill it, whatever its form.
        let moved: Vec<[f64; 3]> = straight.iter().zip(0..).map(|(x, k)| x.map(|x| x + 0.03 * f64::from(k % 4))).collect();
        let nodes: Vec<u32> = (0..10).collect();
        let whole = <Dim<3> as crate::mesh::geometry::CellGeometry<3>>::size(CellKind::Tetrahedron10.cell(&nodes), &moved);
        assert!((subtetrahedra(&moved).sum::<f64>() / 6.0 - whole).abs() < 1e-15);
    }

    #[test]
    fn a_surface_in_space_may_be_warped_but_not_folded() {
        let square = CellKind::Quadrilateral.facts().reference;
        let with = |corner: [f64; 3]| [square[0], square[1], corner, square[3]];
        let is_wrong = |x: &[[f64; 3]]| Dim::<3>::wrong_form(CellKind::of(2, x.len()).unwrap(), x).is_some();
        assert!(!is_wrong(square) && !is_wrong(&with([1.0, 1.0, 0.4])) && !is_wrong(&with([1.0, 1.0, 0.0]).map(|[x, y, z]| [z, y, x])));
        assert!(is_wrong(&with([0.2, 0.2, 0.0])) && is_wrong(&with([0.5, 0.5, 0.0])) && is_wrong(&with(square[1])));
        assert!(is_wrong(&[square[0], square[2], square[1], square[3]]) && is_wrong(&with([f64::NAN; 3])));
        assert!(!is_wrong(&[square[2], square[1], square[0]]) && is_wrong(&[square[0], square[1], [2.0, 0.0, 0.0]]));
    }
}
