//! What forbids to compute with a surface of triangles.

use crate::contact::messages::{OBSTACLE, TURNED};
use crate::error::Fault;
use crate::model::TriangleSurface;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus, place};

/// Heights below this fraction of a triangle's longest edge count as none.
const FLAT: f64 = 1e-9;

impl TriangleSurface {
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
            let message = format!("{} no area: {}", counted(flat.len(), "triangle has", "triangles have"), self.described(first));
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

    fn described(&self, triangle: [u32; 3]) -> String {
        let [a, b, c] = self.corners(triangle).map(place);
        format!("that of {a}, {b} and {c} m")
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Placement;

    /// A tetrahedron, outward.
    fn tetrahedron() -> Vec<[[f64; 3]; 3]> {
        let x = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|triangle: [usize; 3]| triangle.map(|k| x[k])).into()
    }

    fn messages(triangles: &[[[f64; 3]; 3]]) -> Vec<String> {
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
        assert!(messages(&triangles).is_empty());
    }

    #[test]
    fn a_triangle_with_two_equal_corners_leaves_no_hole() {
        let mut triangles = tetrahedron();
        triangles.insert(2, [[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]]);
        let surface = TriangleSurface::welded("a.stl", &triangles);
        assert_eq!((surface.triangles.len(), surface.open_edges()), (4, None));
        assert_eq!(messages(&[[[1.0; 3]; 3]]), ["E0411 a.stl: it has no triangle with an area"]);
    }

    #[test]
    fn what_is_no_surface_is_reported_with_its_place() {
        let good = tetrahedron();
        let mut other = good.clone();
        other[2].swap(0, 1);
        let found = messages(&other);
        let expected = "E0413 a.stl: triangles beside each other look to opposite sides at 3 edges, the first from (";
        assert!(found.len() == 1 && found[0].starts_with(expected), "{found:?}");
        other = good.clone();
        other.push([[0.0; 3], [1.0, 0.0, 0.0], [0.5, -1.0, 0.0]]);
        assert!(
            messages(&other)[0].starts_with("E0413 a.stl: 1 edge has more than two triangles: 3 at the edge from"),
            "{:?}",
            messages(&other)
        );
        other = good.clone();
        other.push([[4.0; 3], [5.0; 3], [6.0; 3]]);
        assert!(messages(&other)[0].starts_with("E0411 a.stl: 1 triangle has no area: that of (4.0"), "{:?}", messages(&other));
        other = good.clone();
        other[1][2][1] = f64::NAN;
        assert!(messages(&other)[0].contains("no finite numbers"));
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
