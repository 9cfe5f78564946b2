//! A surface of triangles in space, the shape of an obstacle: points, each once, and triangles that are
//! counter-clockwise seen from outside.
//!
//! Corners come from a file or from code; the surface goes to the check and to the builder, which makes
//! facets of a rigid body of it.

use super::Placement;
use crate::contact::messages::{OBSTACLE, TURNED};
use crate::error::Fault;
use crate::mesh::placement::{Turn, shift, turn};
use crate::tensor::{cross, dot};
use crate::vector::{length, minus, place};
use std::fmt;

/// A surface of triangles.
#[derive(Clone, Default, PartialEq)]
pub struct TriangleSurface {
    /// Where it came from, for messages.
    pub source: String,
    /// Its points, m.
    pub positions: Vec<[f64; 3]>,
    /// Corners of each triangle, counter-clockwise seen from the side on which bodies are.
    pub triangles: Vec<[u32; 3]>,
}

/// Heights below this fraction of a triangle's longest edge count as none.
const FLAT: f64 = 1e-9;

impl TriangleSurface {
    /// From the corners of triangles (m), which are one point where they are equal to the last bit. A
    /// triangle with two equal corners is left out: it is a line that its neighbours have in common.
    #[must_use]
    pub fn welded(source: &str, triangles: &[[[f64; 3]; 3]]) -> Self {
        // Zero has one sign, and so one point.
        let corners: Vec<[f64; 3]> = triangles.iter().flatten().map(|x| x.map(|c| c + 0.0)).collect();
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        let compare = |a: &u32, b: &u32| {
            let [a, b] = [a, b].map(|&corner| corners[corner as usize]);
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
        };
        order.sort_by(compare);
        // The first corner at each place, in the order of the triangles.
        let mut first: Vec<u32> = (0..corners.len() as u32).collect();
        for equal in order.chunk_by(|a, b| compare(a, b).is_eq()) {
            equal.iter().for_each(|&corner| first[corner as usize] = equal[0]);
        }
        let mut surface = Self { source: source.to_string(), ..Self::default() };
        let mut number = vec![u32::MAX; corners.len()];
        for triangle in first.chunks_exact(3) {
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
            if a == b || b == c || c == a {
                continue;
            }
            surface.triangles.push([a, b, c].map(|corner| {
                let known = &mut number[corner as usize];
                if *known == u32::MAX {
                    *known = surface.positions.len() as u32;
                    surface.positions.push(corners[corner as usize]);
                }
                *known
            }));
        }
        surface
    }

    /// The same turned and moved; mirrors and copies don't count.
    #[must_use]
    pub fn placed(mut self, placement: &Placement) -> Self {
        let by = Turn { angle: placement.rotation, about: placement.rotation_point, axis: placement.rotation_axis };
        turn(&mut self.positions, &by, 1);
        shift(&mut self.positions, placement.translation, 1);
        self
    }

    /// The same seen from its other side.
    #[must_use]
    pub fn turned_over(mut self) -> Self {
        self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        self
    }

    /// Places of the corners of a triangle, m.
    #[must_use]
    pub fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|point| self.positions[point as usize])
    }

    /// Middle of the box around it, m.
    #[must_use]
    pub fn middle(&self) -> [f64; 3] {
        let of = |d: usize| {
            let values = || self.positions.iter().map(|x| x[d]);
            0.5 * (values().fold(f64::INFINITY, f64::min) + values().fold(f64::NEG_INFINITY, f64::max))
        };
        [0, 1, 2].map(of)
    }

    /// What forbids to compute with it; paths are those of the obstacle's shape.
    #[must_use]
    pub(crate) fn faults(&self) -> Vec<Fault> {
        let path = "stl.file";
        let of = |kind, message: String, help: &str| Fault::new(kind, path, format!("{}: {message}", self.source), help);
        if self.triangles.is_empty() {
            return vec![of(&OBSTACLE, "it has no triangle with an area".into(), "export the surface again, as triangles")];
        }
        if let Some(at) = self.positions.iter().position(|x| !x.iter().all(|c| c.is_finite())) {
            let message = format!("the coordinates of point {at} are no finite numbers");
            return vec![of(&OBSTACLE, message, "export the surface again, and look at its scale")];
        }
        if self.triangles.iter().flatten().any(|&point| point as usize >= self.positions.len()) {
            return vec![of(&OBSTACLE, "a triangle has a point that is not there".into(), "name points by their index from 0")];
        }
        let mut faults = Vec::new();
        let flat: Vec<[u32; 3]> = self.triangles.iter().copied().filter(|&triangle| is_flat(self.corners(triangle))).collect();
        if let Some(&first) = flat.first() {
            let message = format!("{} no area: {}", counted(flat.len(), "triangle has", "triangles have"), self.told(first));
            faults.push(of(
                &OBSTACLE,
                message,
                "repair the surface in the program that made it (remove faces without area, then merge what they leave open)",
            ));
        }
        let edges = self.edges();
        let around = || edges.chunk_by(|a, b| a.key() == b.key());
        let many: Vec<_> = around().filter(|here| here.len() > 2).collect();
        if let Some(first) = many.first() {
            let message = format!(
                "{} more than two triangles: {} at the edge from {} to {} m",
                counted(many.len(), "edge has", "edges have"),
                first.len(),
                place(self.positions[first[0].nodes[0] as usize]),
                place(self.positions[first[0].nodes[1] as usize])
            );
            faults.push(of(
                &TURNED,
                message,
                "remove triangles that are there twice or inside of the body; give bodies that touch in an edge a file each",
            ));
        }
        let turned: Vec<_> = around().filter(|here| here.len() == 2 && here[0].nodes == here[1].nodes).collect();
        if let Some(first) = turned.first() {
            let message = format!(
                "triangles beside each other look to opposite sides at {}, the first from {} to {} m",
                counted(turned.len(), "edge", "edges"),
                place(self.positions[first[0].nodes[0] as usize]),
                place(self.positions[first[0].nodes[1] as usize])
            );
            faults.push(of(&TURNED, message, "let the program that made it turn all normals outward (\"unify normals\")"));
        }
        faults
    }

    /// Edges that belong to one triangle alone: how many, and the first.
    #[must_use]
    pub(crate) fn open_edges(&self) -> Option<(usize, [[f64; 3]; 2])> {
        let edges = self.edges();
        let mut open = edges.chunk_by(|a, b| a.key() == b.key()).filter(|here| here.len() == 1).map(|here| here[0].nodes);
        let first = open.next()?;
        Some((1 + open.count(), first.map(|point| self.positions[point as usize])))
    }

    /// The edges of all triangles; those of the same points follow each other.
    pub(crate) fn edges(&self) -> Vec<TriangleEdge> {
        let of = |(triangle, number): (&[u32; 3], u32)| {
            let [a, b, c] = *triangle;
            [[a, b], [b, c], [c, a]].map(|nodes| TriangleEdge { nodes, triangle: number })
        };
        let mut edges: Vec<TriangleEdge> = self.triangles.iter().zip(0..).flat_map(of).collect();
        edges.sort_by_key(|edge| (edge.key(), edge.triangle));
        edges
    }

    fn told(&self, triangle: [u32; 3]) -> String {
        let [a, b, c] = self.corners(triangle).map(place);
        format!("that of {a}, {b} and {c} m")
    }
}

/// An edge of a triangle, in its direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleEdge {
    pub(crate) nodes: [u32; 2],
    pub(crate) triangle: u32,
}

impl TriangleEdge {
    /// The same for both triangles.
    pub(crate) fn key(&self) -> [u32; 2] {
        let [a, b] = self.nodes;
        [a.min(b), a.max(b)]
    }
}

/// So many of them.
fn counted(count: usize, one: &str, several: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {several}") }
}

fn is_flat([a, b, c]: [[f64; 3]; 3]) -> bool {
    let (p, q, r) = (minus(b, a), minus(c, a), minus(c, b));
    let longest = [p, q, r].map(|edge| dot(edge, edge)).into_iter().fold(0.0, f64::max);
    !(length(cross(p, q)) > FLAT * longest)
}

/// Large as it may be, a model is shown with its size and a check sum (FNV-1a of the bits) alone.
impl fmt::Debug for TriangleSurface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut sum = 0xcbf2_9ce4_8422_2325_u64;
        let mut add =
            |bits: u64| bits.to_le_bytes().iter().for_each(|&byte| sum = (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
        self.positions.iter().flatten().for_each(|x| add(x.to_bits()));
        self.triangles.iter().flatten().for_each(|&point| add(u64::from(point)));
        f.debug_struct("TriangleSurface")
            .field("source", &self.source)
            .field("points", &self.positions.len())
            .field("triangles", &self.triangles.len())
            .field("sum", &sum)
            .finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron, outward.
    fn tetrahedron() -> Vec<[[f64; 3]; 3]> {
        let x = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|triangle: [usize; 3]| triangle.map(|k| x[k])).into()
    }

    fn told(triangles: &[[[f64; 3]; 3]]) -> Vec<String> {
        TriangleSurface::welded("a.stl", triangles)
            .faults()
            .into_iter()
            .map(|fault| format!("{} {}", fault.kind.code, fault.message))
            .collect()
    }

    #[test]
    fn equal_corners_are_one_point_whatever_the_sign_of_zero() {
        let mut triangles = tetrahedron();
        triangles[1][0] = [-0.0, 0.0, -0.0];
        let surface = TriangleSurface::welded("a.stl", &triangles);
        assert_eq!((surface.positions.len(), surface.triangles.len()), (4, 4));
        assert_eq!(surface.triangles[1], [0, 2, 3]);
        assert_eq!((surface.open_edges(), surface.middle()), (None, [0.5; 3]));
        assert!(told(&triangles).is_empty());
    }

    #[test]
    fn a_triangle_with_two_equal_corners_leaves_no_hole() {
        let mut triangles = tetrahedron();
        triangles.insert(2, [[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]]);
        let surface = TriangleSurface::welded("a.stl", &triangles);
        assert_eq!((surface.triangles.len(), surface.open_edges()), (4, None));
        assert_eq!(told(&[[[1.0; 3]; 3]]), ["E0411 a.stl: it has no triangle with an area"]);
    }

    #[test]
    fn what_is_no_surface_is_told_with_its_place() {
        let good = tetrahedron();
        let mut other = good.clone();
        other[2].swap(0, 1);
        let found = told(&other);
        let expected = "E0413 a.stl: triangles beside each other look to opposite sides at 3 edges, the first from (";
        assert!(found.len() == 1 && found[0].starts_with(expected), "{found:?}");
        other = good.clone();
        other.push([[0.0; 3], [1.0, 0.0, 0.0], [0.5, -1.0, 0.0]]);
        assert!(told(&other)[0].starts_with("E0413 a.stl: 1 edge has more than two triangles: 3 at the edge from"), "{:?}", told(&other));
        other = good.clone();
        other.push([[4.0; 3], [5.0; 3], [6.0; 3]]);
        assert!(told(&other)[0].starts_with("E0411 a.stl: 1 triangle has no area: that of (4.0"), "{:?}", told(&other));
        other = good.clone();
        other[1][2][1] = f64::NAN;
        assert!(told(&other)[0].contains("no finite numbers"));
        assert_eq!(TriangleSurface::welded("a.stl", &good[1..]).open_edges().map(|(count, _)| count), Some(3));
    }

    #[test]
    fn a_surface_is_turned_moved_and_turned_over() {
        let quarter = Placement { rotation: std::f64::consts::FRAC_PI_2, translation: [0.0, 0.0, 2.0], ..Placement::default() };
        let surface = TriangleSurface::welded("a.stl", &tetrahedron());
        let moved = surface.clone().placed(&quarter);
        for (x, y) in surface.positions.iter().zip(&moved.positions) {
            assert!(length(minus([-x[1], x[0], x[2] + 2.0], *y)) < 1e-15);
        }
        assert_eq!(surface.clone().turned_over().turned_over(), surface);
        assert_ne!(format!("{surface:?}"), format!("{moved:?}"));
    }
}
