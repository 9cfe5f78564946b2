//! A surface of triangles in 3D, the shape of an obstacle: points, each once, and triangles that are
//! counter-clockwise seen from outside.
//!
//! Corners come from a file or from code; the surface goes to the check and to the builder, which makes
//! facets of a rigid body of it.

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
