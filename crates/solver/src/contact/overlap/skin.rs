//! The surfaces of a contact as triangles: the flat pieces that contact itself projects on, four around the
//! middle of a facet of four nodes, with their edges and bodies.
//!
//! Topology is fixed, places are taken again for each look. Vertices are the surfaces' nodes, ascending, then
//! the middles of facets of four nodes.

use crate::contact::boxes::{Aabb, around};
use crate::mesh::surface::{NONE, SpaceSurface};
use crate::rows::Rows;
use crate::tensor::cross;
use crate::vector::minus;

type Vector = [f64; 3];

/// A facet of a surface.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Facet {
    /// Its first triangle, and how many it has: one or four.
    pub(super) first: u32,
    pub(super) count: u32,
    /// Its vertices: corners, then the middle; of three nodes the first three.
    pub(super) vertices: [u32; 5],
    /// Edges that are looked at with this facet: each edge of the skin belongs to one.
    pub(super) edges: [u32; 2],
    /// Number of its body in the skin.
    pub(super) body: u32,
    /// Which surface: what is of one side meets the other alone, where there are two.
    pub(super) side: u32,
    /// Whether it lies on a symmetry plane: it closes the body and is no surface of it.
    pub(super) is_mirror: bool,
}

/// What is known of the bodies of a contact.
pub struct Bodies<'a> {
    /// The whole outside of all of them, also where it lies on symmetry planes.
    pub outside: &'a SpaceSurface,
    /// Whether a facet lies on a symmetry plane.
    pub is_mirror: &'a dyn Fn([u32; 4]) -> bool,
    /// Body of a node.
    pub body_of: &'a dyn Fn(u32) -> u32,
    /// Side of a body where two surfaces meet, 0 or 1; `None`: all bodies meet all, themselves included.
    pub side_of: Option<&'a dyn Fn(u32) -> u32>,
}

impl Facet {
    pub(super) fn triangles(&self) -> std::ops::Range<u32> {
        self.first..self.first + self.count
    }

    /// All its vertices.
    pub(super) fn all(&self) -> &[u32] {
        if self.count == 1 { &self.vertices[..3] } else { &self.vertices }
    }

    pub(super) fn edges(&self) -> std::ops::Range<u32> {
        self.edges[0]..self.edges[1]
    }
}

/// An edge of triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Its vertices.
    pub(super) ends: [u32; 2],
    /// The triangles on its sides; [`NONE`] where the surface ends.
    pub(super) triangles: [u32; 2],
}

/// The triangles of one or two surfaces.
#[derive(Debug, Default)]
pub(super) struct Skin {
    /// Node of each of the first vertices.
    pub(super) nodes: Vec<u32>,
    /// Corners (vertices) of the facets of the others.
    middles: Vec<[u32; 4]>,
    /// Counter-clockwise seen from outside.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Facet of each triangle.
    pub(super) facet_of: Vec<u32>,
    pub(super) facets: Vec<Facet>,
    pub(super) edges: Vec<Edge>,
    /// Edge of each triangle from its corner k to the next.
    pub(super) edges_of: Vec<[u32; 3]>,
    /// Edges at each vertex.
    pub(super) around: Rows<u32>,
    /// Triangles at each vertex.
    pub(super) at_vertex: Rows<u32>,
    /// Label of each of the nodes' vertices: what has the same does not touch. Empty where there are none.
    kin: Vec<u32>,
    /// How many bodies there are, and whether facets of one body may meet each other.
    pub(super) bodies: u32,
    pub(super) meets_itself: bool,
    /// Places of the vertices, m.
    pub(super) x: Vec<Vector>,
}

impl Skin {
    /// Of the bodies of a contact.
    pub(super) fn new(bodies: &Bodies<'_>) -> Self {
        let Bodies { outside, body_of, side_of, .. } = *bodies;
        let mut known: Vec<u32> = outside.facets.iter().map(|facet| body_of(facet[0])).collect();
        known.sort_unstable();
        known.dedup();
        let nodes = outside.nodes.clone();
        let kin = outside.labels();
        let mut skin = Self { bodies: known.len() as u32, meets_itself: side_of.is_none(), nodes, kin, ..Self::default() };
        skin.add(bodies, &known);
        let vertices = skin.nodes.len() + skin.middles.len();
        let ends = skin.edges.iter().zip(0..).flat_map(|(edge, number)| edge.ends.map(|vertex| (vertex, number)));
        skin.around = Rows::new(vertices, ends.collect::<Vec<_>>().into_iter());
        let corners = skin.triangles.iter().zip(0..).flat_map(|(corners, number)| corners.map(|vertex| (vertex, number)));
        skin.at_vertex = Rows::new(vertices, corners.collect::<Vec<_>>().into_iter());
        skin
    }

    /// Adds the facets with the edges that they have first.
    fn add(&mut self, bodies: &Bodies<'_>, known: &[u32]) {
        let Bodies { outside, is_mirror, body_of, side_of } = *bodies;
        let vertex = |nodes: &[u32], node: u32| nodes.binary_search(&node).unwrap_or(0) as u32;
        let mut rims: Vec<u32> = vec![NONE; outside.edges.len()];
        for (nodes, edges) in outside.facets.iter().zip(&outside.edges_of) {
            let count = if nodes[2] == nodes[3] { 3 } else { 4 };
            let corners = nodes.map(|node| vertex(&self.nodes, node));
            let (facet, first) = (self.facets.len() as u32, self.triangles.len() as u32);
            let begin = self.edges.len() as u32;
            let mut rim = [0; 4];
            for k in 0..count {
                let known = &mut rims[edges[k] as usize];
                // In the triangle that has corner k first, or in the one.
                let triangle = first + if count == 4 { k as u32 } else { 0 };
                if *known == NONE {
                    *known = self.edges.len() as u32;
                    let ends = [corners[k], corners[(k + 1) % count]];
                    self.edges.push(Edge { ends, triangles: [triangle, NONE] });
                } else {
                    self.edges[*known as usize].triangles[1] = triangle;
                }
                rim[k] = *known;
            }
            let mut vertices = [corners[0], corners[1], corners[2], corners[3], NONE];
            if count == 3 {
                self.triangles.push([corners[0], corners[1], corners[2]]);
                self.edges_of.push([rim[0], rim[1], rim[2]]);
            } else {
                let middle = (self.nodes.len() + self.middles.len()) as u32;
                self.middles.push(corners);
                vertices[4] = middle;
                let spokes = self.edges.len() as u32;
                for k in 0..4 {
                    let before = first + (k as u32 + 3) % 4;
                    self.edges.push(Edge { ends: [corners[k], middle], triangles: [before, first + k as u32] });
                }
                for k in 0..4 {
                    self.triangles.push([corners[k], corners[(k + 1) % 4], middle]);
                    self.edges_of.push([rim[k], spokes + (k as u32 + 1) % 4, spokes + k as u32]);
                }
            }
            let count = self.triangles.len() as u32 - first;
            self.facet_of.extend((0..count).map(|_| facet));
            let edges = [begin, self.edges.len() as u32];
            let own = body_of(nodes[0]);
            let (body, side) = (known.binary_search(&own).unwrap_or(0) as u32, side_of.map_or(0, |side_of| side_of(own)));
            self.facets.push(Facet { first, count, vertices, edges, body, side, is_mirror: is_mirror(*nodes) });
        }
    }

    /// Takes the places of all vertices; whether all are numbers.
    pub(super) fn place(&mut self, positions: &[Vector]) -> bool {
        self.x.clear();
        self.x.extend(self.nodes.iter().map(|&node| positions[node as usize]));
        for k in 0..self.middles.len() {
            let [a, b, c, d] = self.middles[k].map(|corner| self.x[corner as usize]);
            self.x.push([0, 1, 2].map(|d_| 0.25 * (a[d_] + b[d_] + c[d_] + d[d_])));
        }
        self.x.iter().flatten().all(|c| c.is_finite())
    }

    /// Triangles that have all these vertices.
    pub(super) fn sharing<'a>(&'a self, vertices: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
        let at = vertices.first().map_or(&[][..], |&vertex| self.at_vertex.of(vertex as usize));
        at.iter().copied().filter(|&triangle| vertices.iter().all(|vertex| self.triangles[triangle as usize].contains(vertex)))
    }

    /// Triangles that have any of these vertices, once for each that they have.
    pub(super) fn at_any<'a>(&'a self, vertices: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
        vertices.iter().flat_map(|&vertex| self.at_vertex.of(vertex as usize).iter().copied())
    }

    /// Whether a triangle lies on a symmetry plane.
    pub(super) fn is_mirror(&self, triangle: u32) -> bool {
        self.facets[self.facet_of[triangle as usize] as usize].is_mirror
    }

    /// Body of a triangle.
    pub(super) fn body(&self, triangle: u32) -> u32 {
        self.facets[self.facet_of[triangle as usize] as usize].body
    }

    /// Whether the surface of each body is closed.
    pub(super) fn are_closed(&self) -> Vec<bool> {
        let mut closed = vec![true; self.bodies as usize];
        for edge in self.edges.iter().filter(|edge| edge.triangles[1] == NONE) {
            closed[self.body(edge.triangles[0]) as usize] = false;
        }
        closed
    }

    /// Places of a triangle's corners, m.
    pub(super) fn corners(&self, triangle: u32) -> [Vector; 3] {
        self.triangles[triangle as usize].map(|vertex| self.x[vertex as usize])
    }

    /// Twice the area of a triangle along its outward normal, m².
    pub(super) fn double(&self, triangle: u32) -> Vector {
        let [a, b, c] = self.corners(triangle);
        cross(minus(b, a), minus(c, a))
    }

    /// The box around a facet.
    pub(super) fn box_of(&self, facet: &Facet) -> Aabb<3> {
        around(facet.all().iter().map(|&vertex| self.x[vertex as usize]))
    }

    /// Whether a facet has a label: it is one of a beam, or near one.
    pub(super) fn is_labelled(&self, facet: &Facet) -> bool {
        facet.all().iter().any(|&vertex| self.kin.get(vertex as usize).is_some_and(|label| *label != NONE))
    }

    /// Whether facets may meet each other: they are of different sides where there are two, and no
    /// neighbours.
    pub(super) fn may_meet(&self, a: &Facet, b: &Facet) -> bool {
        let has_same_label = |vertex: &u32| {
            let label = self.kin.get(*vertex as usize).filter(|label| **label != NONE);
            label.is_some_and(|label| b.all().iter().any(|other| self.kin.get(*other as usize) == Some(label)))
        };
        (self.meets_itself || a.side != b.side)
            && !a.all().iter().any(|vertex| b.all().contains(vertex))
            && (self.kin.is_empty() || !a.all().iter().any(has_same_label))
    }

    /// Nodes (vertices) that carry a vertex, with their shares: itself, or the corners around a middle.
    pub(super) fn shares(&self, vertex: u32) -> ([u32; 4], usize) {
        match (vertex as usize).checked_sub(self.nodes.len()) {
            None => ([vertex; 4], 1),
            Some(middle) => (self.middles[middle], 4),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;

    #[test]
    fn each_edge_of_a_closed_skin_has_two_triangles_and_runs_both_ways() {
        let cells = [CellKind::Hexahedron.cell(&[0, 1, 2, 3, 4, 5, 6, 7]), CellKind::Tetrahedron.cell(&[9, 10, 11, 12])];
        let surface = SpaceSurface::outside(cells).unwrap();
        let bodies = Bodies { outside: &surface, is_mirror: &|_| false, body_of: &|node| u32::from(node > 8), side_of: None };
        let skin = Skin::new(&bodies);
        assert_eq!((skin.triangles.len(), skin.edges.len(), skin.bodies), (6 * 4 + 4, 12 + 24 + 6, 2));
        for (number, edge) in skin.edges.iter().enumerate() {
            let mut runs = [0; 2];
            for triangle in edge.triangles {
                let corners = skin.triangles[triangle as usize];
                let k = skin.edges_of[triangle as usize].iter().position(|&other| other as usize == number).unwrap();
                let along = [corners[k], corners[(k + 1) % 3]];
                runs[usize::from(along == edge.ends)] += 1;
                assert!(along == edge.ends || along == [edge.ends[1], edge.ends[0]]);
            }
            assert_eq!(runs, [1, 1]);
        }
        let owned: u32 = skin.facets.iter().map(|facet| facet.edges[1] - facet.edges[0]).sum();
        assert_eq!(owned as usize, skin.edges.len());
    }
}
