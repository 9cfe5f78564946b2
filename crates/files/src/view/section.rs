//! What a plane cuts of solid cells: polygons in the plane, with the values of the field inside.
//!
//! Each facet of a cell that the plane crosses gives the piece of a line from one cut edge to another; the
//! pieces close to polygons. The facets are those of [`CellKind`], so cells of any kind are cut, also
//! ten-node tetrahedra, and neighbours meet without a gap: what is cut of a facet depends on its nodes alone.
//! Values are linear along edges: a linear field is exact. Cells come from `bodies`, the plane from
//! `request`; `frame` sends the answer.

use super::request::Plane;
use embate_solver::output::{CellKind, Cells};
use std::collections::HashMap;

/// Most nodes of a cell, as the width of a table of its edges.
const WIDTH: usize = 16;
/// No edge.
const NONE: u8 = u8::MAX;

/// A point of an edge: its two nodes, and the share of the way from the first to the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) nodes: [u32; 2],
    pub(super) share: f64,
}

impl Point {
    /// What is linear along the edge.
    pub(super) fn between(&self, [from, to]: [f64; 2]) -> f64 {
        // At a node the value is that of the node, whatever the other is.
        if self.share == 0.0 {
            from
        } else if self.share == 1.0 {
            to
        } else {
            (1.0 - self.share) * from + self.share * to
        }
    }
}

/// A polygon: what is cut of one cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polygon {
    pub(super) cell: u32,
    pub(super) part: u32,
    /// Its corners: places in [`Section::corners`].
    pub(super) corners: std::ops::Range<usize>,
}

/// What a plane cuts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Section {
    /// Each once for each part.
    pub(super) points: Vec<Point>,
    /// The part of each point.
    pub(super) parts: Vec<u32>,
    pub(super) polygons: Vec<Polygon>,
    /// Points of the polygons, one polygon after the other.
    pub(super) corners: Vec<u32>,
}

impl Section {
    /// What a plane cuts of the solid cells that are not `gone` (ascending). `heights`: of all nodes, over
    /// the plane; a cell with a height that is not a number is not cut.
    pub(super) fn new(cells: &Cells, gone: &[u32], heights: &[f64]) -> Self {
        let mut section = Self::default();
        let mut known: HashMap<(u32, [u32; 2]), u32> = HashMap::new();
        let mut gone = gone.iter().copied().peekable();
        let mut own = [0.0; WIDTH];
        for cell in 0..cells.len() {
            if gone.next_if_eq(&(cell as u32)).is_some() {
                continue;
            }
            let Some(nodes) = solid(cells, cell) else { continue };
            let Some(heights) = heights_of(nodes, heights, &mut own) else { continue };
            let part = cells.parts.get(cell).copied().unwrap_or(0);
            let mut point = |[a, b]: [u8; 2]| {
                let ends = [usize::from(a), usize::from(b)];
                let ends = if nodes[ends[0]] <= nodes[ends[1]] { ends } else { [ends[1], ends[0]] };
                let key = (part, ends.map(|end| nodes[end]));
                *known.entry(key).or_insert_with(|| {
                    let [from, to] = ends.map(|end| heights[end]);
                    section.points.push(Point { nodes: key.1, share: from / (from - to) });
                    section.parts.push(part);
                    section.points.len() as u32 - 1
                })
            };
            for_each_loop(cells.kinds[cell], heights, |edges| {
                let first = section.corners.len();
                section.corners.extend(edges.iter().map(|&edge| point(edge)));
                section.polygons.push(Polygon { cell: cell as u32, part, corners: first..section.corners.len() });
            });
        }
        section
    }

    /// Numbers of all points, and then of the middles of all polygons, by those of the points.
    pub(super) fn with_middles(&self, mut points: Vec<f64>) -> Vec<f64> {
        let middle = |polygon: &Polygon| {
            let own = &self.corners[polygon.corners.clone()];
            own.iter().map(|&corner| points[corner as usize]).sum::<f64>() / own.len() as f64
        };
        let middles: Vec<f64> = self.polygons.iter().map(middle).collect();
        points.extend(middles);
        points
    }

    /// Triangles of all polygons: two neighbouring corners and the middle, with the polygon of each.
    pub(super) fn triangles(&self) -> impl Iterator<Item = ([u32; 3], &Polygon)> {
        (0..).zip(&self.polygons).flat_map(move |(index, polygon): (u32, _)| {
            let own = &self.corners[polygon.corners.clone()];
            let middle = self.points.len() as u32 + index;
            (0..own.len()).map(move |k| ([own[k], own[(k + 1) % own.len()], middle], polygon))
        })
    }
}

/// A node closer to the plane than this part of the largest height lies in it: a plane through a face of
/// elements cuts all of them there, whatever rounding says.
const IN_PLANE: f64 = 1e-9;

/// Heights of places over a plane, m.
pub(super) fn heights(plane: &Plane, places: impl Iterator<Item = [f64; 3]>) -> Vec<f64> {
    let (normal, offset) = (plane.normal(), plane.offset());
    let mut heights: Vec<f64> = places.map(|x| normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] - offset).collect();
    let largest = heights.iter().filter(|height| height.is_finite()).fold(0.0f64, |most, height| most.max(height.abs()));
    heights.iter_mut().filter(|height| height.abs() < IN_PLANE * largest).for_each(|height| *height = 0.0);
    heights
}

/// Nodes of a cell; none if it is no solid, or has not as many as its kind.
fn solid(cells: &Cells, cell: usize) -> Option<&[u32]> {
    let kind = cells.kinds[cell];
    let ends = [*cells.offsets.get(cell)? as usize, *cells.offsets.get(cell + 1)? as usize];
    let nodes = cells.nodes.get(ends[0]..ends[1])?;
    (kind.dimension() == 3 && nodes.len() == kind.nodes() && nodes.len() <= WIDTH).then_some(nodes)
}

/// Heights of the nodes of a cell, if there are nodes on both sides.
fn heights_of<'a>(nodes: &[u32], heights: &[f64], own: &'a mut [f64; WIDTH]) -> Option<&'a [f64]> {
    let (mut low, mut high) = (false, false);
    for (own, &node) in own.iter_mut().zip(nodes) {
        *own = *heights.get(node as usize).filter(|height| height.is_finite())?;
        (low, high) = (low || *own < 0.0, high || *own >= 0.0);
    }
    (low && high).then_some(&own[..nodes.len()])
}

/// The closed polygons that a cell is cut into, as edges by the numbers of their nodes in the cell.
fn for_each_loop(kind: CellKind, heights: &[f64], mut take: impl FnMut(&[[u8; 2]])) {
    let is_beyond = |node: u8| heights[usize::from(node)] >= 0.0;
    let place = |[a, b]: [u8; 2]| usize::from(a.min(b)) * WIDTH + usize::from(a.max(b));
    let mut next = [NONE; WIDTH * WIDTH];
    for facet in kind.facts().facets {
        let corners = if facet[2] == facet[3] { &facet[..3] } else { &facet[..] };
        let (mut cut, mut count) = ([([0u8; 2], false); 4], 0);
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if is_beyond(a) != is_beyond(b) {
                cut[count] = ([a, b], is_beyond(b));
                count += 1;
            }
        }
        // Of a facet that is cut twice the middle decides what belongs together.
        let mean: f64 = corners.iter().map(|&corner| heights[usize::from(corner)]).sum();
        let step = if count == 4 && mean >= 0.0 { count - 1 } else { 1 };
        for (k, (edge, is_rising)) in cut[..count].iter().enumerate() {
            if *is_rising {
                let (end, _) = cut[(k + step) % count];
                next[place(*edge)] = place(end) as u8;
            }
        }
    }
    let mut edges: Vec<[u8; 2]> = Vec::with_capacity(8);
    for first in 0..next.len() {
        let mut at = first;
        edges.clear();
        while next[at] != NONE {
            edges.push([(at / WIDTH) as u8, (at % WIDTH) as u8]);
            at = usize::from(std::mem::replace(&mut next[at], NONE));
        }
        if at == first && edges.len() > 2 {
            take(&edges);
        }
    }
}

#[cfg(test)]
mod tests;
