//! The plane of a cut at the start, and what it cuts of elements.

use crate::mesh::ElementGroup;
use crate::mesh::geometry::CellGeometry;
use crate::model::{self, in_3d};
use crate::tensor::{Dim, cross};
use crate::vector::{any_tangent, dot, first, length, minus, plus, times, unit};

/// A plane, or a disc in it.
pub(super) struct Plane<'a, const D: usize> {
    point: [f64; D],
    pub(super) normal: [f64; D],
    /// Of a disc; infinite: the whole plane.
    radius: f64,
    /// Nodes in the plane are on the other side, whatever rounding says.
    least: f64,
    positions: &'a [[f64; D]],
}

/// What a plane cuts of an element.
pub(super) struct Slice {
    /// Cut edges, with the share of the way to the second node at which they are cut, and where that is.
    edges: Vec<([u32; 2], f64)>,
    points: Vec<[f64; 3]>,
}

impl<'a, const D: usize> Plane<'a, D>
where
    Dim<D>: CellGeometry<D>,
{
    /// That of a cut among nodes at these places at the start, m; `None`: it has no normal.
    pub(super) fn new(cut: &model::Cut, positions: &'a [[f64; D]]) -> Option<Self> {
        Some(Self {
            point: first(cut.point),
            normal: unit(first::<D>(cut.normal))?,
            radius: cut.radius.unwrap_or(f64::INFINITY),
            least: crate::mesh::tolerance(positions),
            positions,
        })
    }

    fn height(&self, node: u32) -> f64 {
        dot(minus(self.positions[node as usize], self.point), self.normal)
    }

    /// Whether a node is on the side of the normal.
    pub(super) fn has_beyond(&self, node: u32) -> bool {
        self.height(node) > self.least
    }

    /// What it cuts of an element, if it does; of a disc, if the middle of that is on it.
    pub(super) fn slice(&self, group: &ElementGroup, element: usize) -> Option<Slice> {
        let nodes = group.nodes_of(element);
        if nodes.iter().all(|&node| self.has_beyond(node)) || !nodes.iter().any(|&node| self.has_beyond(node)) {
            return None;
        }
        let edges = group.cell(element).edges().filter(|edge| self.has_beyond(edge[0]) != self.has_beyond(edge[1]));
        let edges: Vec<([u32; 2], f64)> = edges.map(|edge| (edge, self.share(edge))).collect();
        let points = edges.iter().map(|&(edge, share)| self.between(edge, share)).collect();
        let slice = Slice { edges, points };
        let way = minus(slice.middle(), in_3d(self.point));
        (length(way) <= self.radius).then_some(slice)
    }

    fn share(&self, [a, b]: [u32; 2]) -> f64 {
        self.height(a) / (self.height(a) - self.height(b))
    }

    fn between(&self, edge: [u32; 2], share: f64) -> [f64; 3] {
        let [a, b] = edge.map(|node| self.positions[node as usize]);
        in_3d(plus(a, times(share, minus(b, a))))
    }
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
