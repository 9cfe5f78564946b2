//! Cells cut into tetrahedra.
//!
//! A quadrilateral face is four triangles about the mean of its corners, so that both of its cells have the
//! same face though it is warped; a cell is tetrahedra from the triangles of its faces to a centre: 24 in a
//! hexahedron, whose sum is exactly the volume of the trilinear cell (Davies & Salmond), 14 in a wedge. No
//! diagonal is preferred, so the masses of a cube's corners are equal. Sub-cells of integration points are
//! made of the same tetrahedra, each halved at the middle of its edge.

use super::kind::{EDGES, MOST};
use super::vector::{cross, dot, minus, six_volumes};
use super::{Kind, Mesh, Point};
use crate::shared::matrix::eliminate;

/// How cells are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// As a whole.
    Cells,
    /// Into sub-cells at their corners.
    Parts,
}

/// A triangle of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    pub(super) face: u8,
    pub(super) vertices: [u8; 3],
    /// Its sub-cell.
    pub(super) part: u8,
}

/// How cells of one kind are cut. Vertices are means of nodes; the first ones are the nodes themselves.
#[derive(Debug)]
pub(super) struct Plan {
    kind: Kind,
    /// Nodes of which each vertex is the mean.
    pub(super) sets: Vec<Vec<u8>>,
    /// Weights of the nodes at each vertex.
    shapes: Vec<[f64; MOST]>,
    pub(super) tets: Vec<[u8; 4]>,
    /// Of each tetrahedron its sub-cell.
    pub(super) parts: Vec<u8>,
    pub(super) facets: Vec<Facet>,
    /// The vertex in the middle of the cell.
    pub(super) centre: Option<u8>,
    /// Number of sub-cells.
    pub(super) count: usize,
}

impl Plan {
    /// How cells of each kind are cut, in the order of `Kind::ALL`.
    pub(super) fn all(cut: Cut) -> [Self; 4] {
        Kind::ALL.map(|kind| Self::of(kind, cut))
    }

    fn of(kind: Kind, cut: Cut) -> Self {
        let mut plan = Self {
            kind,
            sets: (0..kind.nodes() as u8).map(|node| vec![node]).collect(),
            shapes: Vec::new(),
            tets: Vec::new(),
            parts: Vec::new(),
            facets: Vec::new(),
            centre: None,
            count: if cut == Cut::Parts && kind != Kind::Tetrahedron { kind.corners() } else { 1 },
        };
        if kind == Kind::Tetrahedron {
            plan.add_tet([0, 1, 2, 3], 0);
        } else {
            let nodes = if kind == Kind::Tetrahedron10 { 4..10 } else { 0..kind.nodes() as u8 };
            plan.centre = Some(plan.vertex(nodes.collect()));
        }
        for (face, corners) in kind.faces().iter().enumerate() {
            match (kind, cut) {
                (Kind::Tetrahedron, _) => {
                    plan.facets.push(Facet { face: face as u8, vertices: [corners[0], corners[1], corners[2]], part: 0 })
                }
                (Kind::Tetrahedron10, _) => plan.add_curved(face as u8, corners, cut),
                (_, Cut::Cells) => plan.add_face(face as u8, corners),
                (_, Cut::Parts) => plan.add_parts(face as u8, corners),
            }
        }
        if kind == Kind::Tetrahedron10 && cut == Cut::Cells {
            plan.cut_corners();
        }
        plan.shapes = plan.sets.iter().map(|set| mean_of(set)).collect();
        plan
    }

    /// The vertex that is the mean of some nodes; a new one if there is none.
    fn vertex(&mut self, mut nodes: Vec<u8>) -> u8 {
        nodes.sort_unstable();
        let found = self.sets.iter().position(|set| *set == nodes).unwrap_or(self.sets.len());
        if found == self.sets.len() {
            self.sets.push(nodes);
        }
        found as u8
    }

    /// Adds a tetrahedron, its vertices in the order that gives it a positive volume.
    fn add_tet(&mut self, [a, b, c, d]: [u8; 4], part: u8) {
        let corners = self.kind.reference();
        let of_node = |node: u8| match EDGES.get(usize::from(node).wrapping_sub(self.kind.corners())) {
            Some(&[a, b]) => mean([corners[usize::from(a)], corners[usize::from(b)]].into_iter(), 2),
            None => corners[usize::from(node)],
        };
        let places = [a, b, c, d].map(|vertex| {
            let set = &self.sets[usize::from(vertex)];
            mean(set.iter().map(|&node| of_node(node)), set.len())
        });
        self.tets.push(if six_volumes(&places) > 0.0 { [a, b, c, d] } else { [b, a, c, d] });
        self.parts.push(part);
    }

    /// Adds a triangle of a face, and its tetrahedron to the centre.
    fn add_facet(&mut self, face: u8, vertices: [u8; 3], part: u8) {
        self.facets.push(Facet { face, vertices, part });
        if let Some(centre) = self.centre {
            self.add_tet([vertices[0], vertices[1], vertices[2], centre], part);
        }
    }

    /// A face of the whole cell: a triangle as it is, a quadrilateral about its centre.
    fn add_face(&mut self, face: u8, corners: &[u8]) {
        if let &[a, b, c] = corners {
            return self.add_facet(face, [a, b, c], 0);
        }
        let middle = self.vertex(corners.to_vec());
        for k in 0..corners.len() {
            self.add_facet(face, [corners[k], corners[(k + 1) % corners.len()], middle], 0);
        }
    }

    /// A face in parts, two triangles at each corner.
    fn add_parts(&mut self, face: u8, corners: &[u8]) {
        let (middle, count) = (self.vertex(corners.to_vec()), corners.len());
        for k in 0..count {
            let corner = corners[k];
            for other in [corners[(k + 1) % count], corners[(k + count - 1) % count]] {
                let edge = self.vertex(vec![corner, other]);
                self.add_facet(face, [corner, edge, middle], corner);
            }
        }
    }

    /// A face of a tetrahedron of ten nodes: four triangles between its nodes, the middle one in three parts.
    fn add_curved(&mut self, face: u8, corners: &[u8], cut: Cut) {
        let between = |a: u8, b: u8| EDGES.iter().position(|&[c, d]| [a, b] == [c, d] || [b, a] == [c, d]).map_or(a, |at| at as u8 + 4);
        let middles = [0, 1, 2].map(|k| between(corners[k], corners[(k + 1) % 3]));
        if cut == Cut::Cells {
            self.add_facet(face, middles, 0);
            (0..3).for_each(|k| self.facets.push(Facet { face, vertices: [corners[k], middles[k], middles[(k + 2) % 3]], part: 0 }));
            return;
        }
        let middle = self.vertex(middles.to_vec());
        for k in 0..3 {
            let (next, last) = (middles[k], middles[(k + 2) % 3]);
            self.add_facet(face, [corners[k], next, last], corners[k]);
            self.add_facet(face, [next, middle, last], corners[k]);
        }
    }

    /// The tetrahedra of ten nodes at their corners, and those that face them from the centre.
    fn cut_corners(&mut self) {
        for (corner, [a, b, c]) in [[4, 6, 7], [4, 5, 8], [5, 6, 9], [7, 8, 9]].into_iter().enumerate() {
            self.add_tet([corner as u8, a, b, c], 0);
            if let Some(centre) = self.centre {
                self.add_tet([centre, a, b, c], 0);
            }
        }
    }
}

fn mean_of(set: &[u8]) -> [f64; MOST] {
    let mut shape = [0.0; MOST];
    set.iter().for_each(|&node| shape[usize::from(node)] = 1.0 / set.len() as f64);
    shape
}

fn mean(places: impl Iterator<Item = Point>, count: usize) -> Point {
    let sum = places.fold([0.0; 3], |sum, x| [sum[0] + x[0], sum[1] + x[1], sum[2] + x[2]]);
    sum.map(|sum| sum / count as f64)
}

/// Why a cell cannot be cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Uncut {
    /// It has a node that is not there.
    Node,
    /// A tetrahedron has no positive volume.
    Inverted,
}

/// A cell that is cut.
pub(super) struct Local<'a> {
    pub(super) plan: &'a Plan,
    /// Of the vertices, m.
    pub(super) places: Vec<Point>,
    /// Of the tetrahedra, m³.
    pub(super) volumes: Vec<f64>,
    /// Weights of the nodes at the centre where it is not their mean.
    moved: Option<[f64; MOST]>,
}

impl<'a> Local<'a> {
    /// A cell of a mesh.
    pub(super) fn of(plans: &'a [Plan; 4], mesh: Mesh<'_>, cell: usize) -> Result<Self, Uncut> {
        let nodes = mesh.cells[cell].nodes();
        let plan = &plans[mesh.cells[cell].kind() as usize];
        let mut found = Vec::with_capacity(nodes.len());
        for &node in nodes {
            found.push(*mesh.positions.get(node as usize).ok_or(Uncut::Node)?);
        }
        // Sums by ascending node, so that both cells of a face get the same bits.
        let mut order: Vec<u8> = (0..nodes.len() as u8).collect();
        order.sort_unstable_by_key(|&k| nodes[usize::from(k)]);
        let mut places = Vec::with_capacity(plan.sets.len());
        for set in &plan.sets {
            let of = order.iter().filter(|&k| set.contains(k)).map(|&k| found[usize::from(k)]);
            places.push(mean(of, set.len()));
        }
        let mut local = Self { plan, places, volumes: Vec::new(), moved: None };
        if !local.measure() {
            local.move_centre();
            if !local.measure() {
                return Err(Uncut::Inverted);
            }
        }
        Ok(local)
    }

    /// Sets the volumes; false if one is not positive.
    fn measure(&mut self) -> bool {
        let of = |tet: &[u8; 4]| six_volumes(&tet.map(|vertex| self.places[usize::from(vertex)])) / 6.0;
        self.volumes = self.plan.tets.iter().map(of).collect();
        self.volumes.iter().all(|&volume| volume > 0.0 && volume.is_finite())
    }

    /// Weights of the nodes at a vertex.
    pub(super) fn shape(&self, vertex: u8) -> &[f64; MOST] {
        match &self.moved {
            Some(shape) if self.plan.centre == Some(vertex) => shape,
            _ => &self.plan.shapes[usize::from(vertex)],
        }
    }

    /// The places of a tetrahedron.
    pub(super) fn tet(&self, index: usize) -> [Point; 4] {
        self.plan.tets[index].map(|vertex| self.places[usize::from(vertex)])
    }

    /// Moves the centre of a badly distorted cell to where it sees all triangles of the faces from within,
    /// if there is such a place: steps beyond the plane that it is furthest outside of. Linear functions
    /// keep their values there.
    fn move_centre(&mut self) {
        let Some(centre) = self.plan.centre.map(usize::from) else { return };
        let (start, set) = (self.places[centre], &self.plan.sets[centre]);
        let arms: Vec<Point> = set.iter().map(|&node| minus(self.places[usize::from(node)], start)).collect();
        let mut spread = [[0.0; 3]; 3];
        for arm in &arms {
            (0..3).for_each(|i| (0..3).for_each(|j| spread[i][j] += arm[i] * arm[j]));
        }
        let margin = MARGIN * ((spread[0][0] + spread[1][1] + spread[2][2]) / arms.len() as f64).sqrt();
        let mut planes: Vec<(Point, Point)> = Vec::new();
        for (index, tet) in self.plan.tets.iter().enumerate() {
            let Some(at) = tet.iter().position(|&vertex| usize::from(vertex) == centre) else { continue };
            let x = self.tet(index);
            let [a, b, c] = [(at + 1) % 4, (at + 2) % 4, (at + 3) % 4].map(|k| x[k]);
            // In a positive tetrahedron the other three turn the one or the other way with the place of this
            // one.
            let normal = cross(minus(b, a), minus(c, a)).map(|n| if at % 2 == 1 { n } else { -n });
            let length = dot(normal, normal).sqrt();
            planes.push((a, normal.map(|n| n / length)));
        }
        let mut place = start;
        for _ in 0..STEPS {
            let mut lowest = (margin, [0.0; 3]);
            for &(from, normal) in &planes {
                let height = dot(normal, minus(place, from));
                if height < lowest.0 {
                    lowest = (height, normal);
                }
            }
            let step = margin - lowest.0;
            if !(step > 0.0) {
                break;
            }
            (0..3).for_each(|k| place[k] += (1.0 + 1e-3) * step * lowest.1[k]);
        }
        let slope = eliminate(spread, minus(place, start), 3);
        let mut shape = *self.shape(centre as u8);
        set.iter().zip(&arms).for_each(|(&node, &arm)| shape[usize::from(node)] += dot(slope, arm));
        (self.places[centre], self.moved) = (place, Some(shape));
    }
}

/// Distance of a moved centre from the planes of the faces' triangles, by the size of the cell.
const MARGIN: f64 = 0.02;
/// Steps to a place for the centre.
const STEPS: usize = 200;
