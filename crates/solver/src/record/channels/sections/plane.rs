//! The plane of a cut at the start, and what it cuts of elements.

use crate::dimension::Dimension;
use crate::mesh::ElementGroup;
use crate::model::{self, in_3d};
use crate::step::System;
use crate::tensor::{Dim, cross};
use crate::vector::{any_tangent, dot, first, length, minus, plus, times, unit};

/// A plane, or a disc in it, and on which side the nodes are.
pub(super) struct Plane<const D: usize> {
    point: [f64; D],
    pub(super) normal: [f64; D],
    /// Of a disc; infinite: the whole plane.
    radius: f64,
    /// Whether each node of the mesh is on the side of the normal: nodes on faces of shells, and joined ones,
    /// are where the node is with which they go.
    beyond: Vec<bool>,
}

/// What a plane cuts of an element.
pub(super) struct Slice {
    /// Cut edges, with the share of the way to the second node at which they are cut, and where that is.
    edges: Vec<([u32; 2], f64)>,
    points: Vec<[f64; 3]>,
}

impl<const D: usize> Plane<D>
where
    Dim<D>: Dimension<D>,
{
    /// That of a cut; `None`: it has no normal.
    pub(super) fn new(cut: &model::Cut, system: &System<D>) -> Option<Self> {
        let (mesh, joins) = (&system.mesh, &system.joins);
        let mut plane = Self {
            point: first(cut.point),
            normal: unit(first::<D>(cut.normal))?,
            radius: cut.radius.unwrap_or(f64::INFINITY),
            beyond: vec![],
        };
        // Nodes in the plane are on the other side, whatever rounding says.
        let least = crate::mesh::tolerance(&mesh.positions);
        // Images of others are elsewhere.
        let leader = |node: u32| if joins.is_periodic() { node } else { joins.leader(node).0 };
        let is_beyond = |node: u32| plane.height(leader(mesh.leader_of(node)), &mesh.positions) > least;
        plane.beyond = (0..mesh.positions.len() as u32).map(is_beyond).collect();
        Some(plane)
    }

    fn height(&self, node: u32, positions: &[[f64; D]]) -> f64 {
        dot(minus(positions[node as usize], self.point), self.normal)
    }

    /// Whether a node is on the side of the normal.
    pub(super) fn has_beyond(&self, node: u32) -> bool {
        self.beyond[node as usize]
    }

    /// Whether there are nodes of the mesh on both sides, and no others.
    pub(super) fn is_between(&self, mut nodes: impl Iterator<Item = u32> + Clone) -> bool {
        let is_of_mesh = |node: u32| (node as usize) < self.beyond.len();
        nodes.clone().all(is_of_mesh) && nodes.clone().any(|node| self.has_beyond(node)) && nodes.any(|node| !self.has_beyond(node))
    }

    /// Whether the line between the means of what is on either side, as it was at the start (m), goes through
    /// the disc.
    pub(super) fn meets(&self, nodes: impl Iterator<Item = u32> + Clone, positions: &[[f64; D]]) -> bool {
        if self.radius == f64::INFINITY {
            return true;
        }
        let mean = |beyond: bool| {
            let own = nodes.clone().filter(|node| self.has_beyond(*node) == beyond);
            let count = own.clone().count() as f64;
            times(1.0 / count, own.fold([0.0; D], |sum, node| plus(sum, minus(positions[node as usize], self.point))))
        };
        let (from, to) = (mean(false), mean(true));
        let (low, high) = (dot(from, self.normal), dot(to, self.normal));
        let share = if high > low { (-low / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
        length(plus(from, times(share, minus(to, from)))) <= self.radius
    }

    /// What it cuts of an element, if it does; of a disc, if the middle of that is on it.
    pub(super) fn slice(&self, group: &ElementGroup, element: usize, positions: &[[f64; D]]) -> Option<Slice> {
        if !self.is_between(group.nodes_of(element).iter().copied()) {
            return None;
        }
        let edges = group.cell(element).pieces_of_edges().filter(|edge| self.has_beyond(edge[0]) != self.has_beyond(edge[1]));
        let edges: Vec<([u32; 2], f64)> = edges.map(|edge| (edge, self.share(edge, positions))).collect();
        let slice = Slice { points: edges.iter().map(|&(edge, share)| in_3d(between(edge, share, positions))).collect(), edges };
        let way = minus(slice.middle(), in_3d(self.point));
        (length(way) <= self.radius).then_some(slice)
    }

    /// The share of the way to the second node at which an edge is cut.
    pub(super) fn share(&self, edge: [u32; 2], positions: &[[f64; D]]) -> f64 {
        let [a, b] = edge.map(|node| self.height(node, positions));
        // Where a joined node lies beyond its leader there may be no place between.
        let has_place = if self.has_beyond(edge[1]) { b > a } else { a > b };
        if has_place { a / (a - b) } else { 0.5 }
    }
}

/// A place between two nodes.
fn between<const D: usize>(edge: [u32; 2], share: f64, positions: &[[f64; D]]) -> [f64; D] {
    let [a, b] = edge.map(|node| positions[node as usize]);
    plus(a, times(share, minus(b, a)))
}

impl Slice {
    fn middle(&self) -> [f64; 3] {
        times(1.0 / self.points.len() as f64, self.points.iter().fold([0.0; 3], |sum, &x| plus(sum, x)))
    }

    /// Adds its centre as a sum over the nodes of the cut edges, weighted by the area (of surfaces the
    /// length, of lines one).
    pub(super) fn add_centre<const D: usize>(&self, normal: [f64; D], centre: &mut Vec<(u32, f64)>) {
        let weight = self.size(in_3d(normal)) / self.points.len() as f64;
        for &(edge, at) in &self.edges {
            centre.extend([(edge[0], weight * (1.0 - at)), (edge[1], weight * at)]);
        }
    }

    /// Size of what its points bound: of one 1, of two their distance, of more the area of the polygon around
    /// their middle.
    fn size(&self, normal: [f64; 3]) -> f64 {
        match &self.points[..] {
            [] | [_] => 1.0,
            [a, b] => length(minus(*a, *b)),
            points => {
                let middle = self.middle();
                let along = any_tangent(normal);
                let across = cross(normal, along);
                let mut flat: Vec<[f64; 2]> =
                    points.iter().map(|&x| [dot(minus(x, middle), along), dot(minus(x, middle), across)]).collect();
                // Around the middle, by the angle.
                flat.sort_by(|a, b| a[1].atan2(a[0]).total_cmp(&b[1].atan2(b[0])));
                let next = flat.iter().cycle().skip(1);
                0.5 * flat.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
            }
        }
    }
}
