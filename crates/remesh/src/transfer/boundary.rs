//! Edges of a mesh that one cell has, and the place on them that is nearest.

use super::clip::Twin;
use crate::plane::{Cell, Mesh, Point, corners, dot, minus};

/// An edge of one cell only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) cell: u32,
    /// Which corners of the cell its ends are.
    pub(super) corners: [u8; 2],
    pub(super) nodes: [u32; 2],
}

/// Edges that one cell has, by cell and corner.
pub(super) fn boundary(cells: &[Cell]) -> Vec<Edge> {
    let mut all: Vec<([u32; 2], Edge)> = Vec::with_capacity(4 * cells.len());
    for (index, cell) in cells.iter().enumerate() {
        let nodes = corners(cell);
        for k in 0..nodes.len() {
            let next = if k + 1 == nodes.len() { 0 } else { k + 1 };
            let (a, b) = (nodes[k], nodes[next]);
            let edge = Edge { cell: index as u32, corners: [k as u8, next as u8], nodes: [a, b] };
            all.push(([a.min(b), a.max(b)], edge));
        }
    }
    all.sort_unstable_by_key(|(key, edge)| (*key, edge.cell, edge.corners[0]));
    let mut found: Vec<Edge> = all.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0].1).collect();
    found.sort_unstable_by_key(|edge| (edge.cell, edge.corners[0]));
    found
}

/// The nearest of some edges, and where on it: 0 is its first end, 1 its second.
pub(super) fn nearest(edges: &[Edge], mesh: Mesh<'_>, x: Point) -> Option<(Edge, f64)> {
    let mut best: Option<(f64, Edge, f64)> = None;
    for &edge in edges {
        let [a, b] = edge.nodes.map(|node| mesh.positions[node as usize]);
        let along = minus(b, a);
        let length = dot(along, along);
        let part = if length > 0.0 { (dot(minus(x, a), along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let away = minus(x, [a[0] + part * along[0], a[1] + part * along[1]]);
        let square = dot(away, away);
        if best.is_none_or(|(least, _, _)| square < least) {
            best = Some((square, edge, part));
        }
    }
    best.map(|(_, edge, part)| (edge, part))
}

/// Material of an old triangle that is outside the new mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sliver {
    pub(super) old: u32,
    /// ∫ λ_j dV over it for each corner j of the old triangle.
    pub(super) moments: [f64; 3],
    /// The nearest edge of the new mesh's outline, and the part of it up to the nearest place.
    pub(super) edge: Edge,
    pub(super) part: f64,
}

/// What is left of old triangles when their pieces are taken from them, and is more than round-off. `None` if
/// the new mesh has no outline.
pub(super) fn slivers(twins: &[Twin], whole: &[[f64; 3]], within: &[[f64; 3]], new: Mesh<'_>) -> Option<Vec<Sliver>> {
    let mut edges: Option<Vec<Edge>> = None;
    let mut found = Vec::new();
    for (index, twin) in twins.iter().enumerate() {
        let moments = [0, 1, 2].map(|j| whole[index][j] - within[index][j]);
        let volume = moments[0] + moments[1] + moments[2];
        if !(volume > ROUND_OFF * (whole[index][0] + whole[index][1] + whole[index][2])) {
            continue;
        }
        let centre = [0, 1].map(|k| (0..3).map(|j| moments[j] / volume * twin.places[j][k]).sum());
        let (edge, part) = nearest(edges.get_or_insert_with(|| boundary(new.cells)), new, centre)?;
        found.push(Sliver { old: index as u32, moments, edge, part });
    }
    Some(found)
}

/// Part of a triangle's volume that pieces may miss by rounding.
const ROUND_OFF: f64 = 1e-12;
