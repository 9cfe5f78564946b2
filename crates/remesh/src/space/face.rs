//! Faces of the outline of a mesh, and their triangles: a quadrilateral is four about the mean of its
//! corners.

use super::boundary::outer_faces;
use super::vector::{cross, minus};
use super::{Mesh, Point};

/// A face of one cell only: its corners, outward; a triangle repeats its last one.
pub(super) type Face = [u32; 4];

/// The faces that are of one cell only, each with its corners outward; a triangle repeats the last.
#[must_use]
pub fn faces(mesh: Mesh<'_>) -> Vec<[u32; 4]> {
    let of = |(cell, face): (u32, u8)| -> Face {
        let cell = &mesh.cells[cell as usize];
        let corners = cell.kind().faces()[usize::from(face)];
        std::array::from_fn(|k| cell.nodes()[usize::from(corners[k.min(corners.len() - 1)])])
    };
    outer_faces(mesh).into_iter().map(of).collect()
}

pub(super) fn corners(face: &Face) -> &[u32] {
    &face[..if face[2] == face[3] { 3 } else { 4 }]
}

/// A triangle of a face: two corners, and the third one or the centre of four.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    pub(super) ends: [u32; 2],
    pub(super) face: Face,
}

impl Triangle {
    /// Those of a face.
    pub(super) fn of(face: &Face) -> impl Iterator<Item = Self> {
        let (face, count) = (*face, corners(face).len());
        let pairs = if count == 3 { 1 } else { 4 };
        (0..pairs).map(move |k| Self { ends: [face[k], face[(k + 1) % count]], face })
    }

    /// Its vertices in these places.
    pub(super) fn places(&self, positions: &[Point]) -> [Point; 3] {
        let x = |node: u32| positions[node as usize];
        let last = if self.is_whole() {
            x(self.face[2])
        } else {
            // By ascending node, as cells have it.
            let mut nodes = self.face;
            nodes.sort_unstable();
            let sum = nodes.iter().fold([0.0; 3], |sum, &node| [0, 1, 2].map(|k| sum[k] + x(node)[k]));
            sum.map(|sum| 0.25 * sum)
        };
        [x(self.ends[0]), x(self.ends[1]), last]
    }

    fn is_whole(&self) -> bool {
        self.face[2] == self.face[3]
    }

    /// Shares of nodes at weights of its vertices.
    pub(super) fn shares(&self, weights: [f64; 3]) -> Vec<(u32, f64)> {
        let mut shares: Vec<(u32, f64)> = self.ends.into_iter().zip(weights).collect();
        if self.is_whole() {
            shares.push((self.face[2], weights[2]));
        } else {
            let quarter = 0.25 * weights[2];
            shares.iter_mut().for_each(|(_, share)| *share += quarter);
            shares.extend(self.face.into_iter().filter(|node| !self.ends.contains(node)).map(|node| (node, quarter)));
        }
        shares.retain(|&(_, share)| share != 0.0);
        shares
    }

    /// Twice its area times its normal.
    pub(super) fn area(&self, positions: &[Point]) -> Point {
        let x = self.places(positions);
        cross(minus(x[1], x[0]), minus(x[2], x[0]))
    }
}
