//! Which nodes are inside other bodies when nothing is known of the past: by winding numbers, exactly as the
//! levels count from then on.
//!
//! A ray along +x is counted against the segments of its row; only nodes within the box of another body are
//! asked. Surfaces that don't enclose their body (those with ends, sides that end on symmetry lines, the
//! sides of holes) say nothing of what is far from them: there the nearest feature within the first reach
//! decides. A node is never inside its own body.

use super::super::projection::node_segment::{Projection, Target, Vector};
use super::group::{Group, Pass};
use crate::vector::{cross, minus};
use std::collections::{BTreeMap, BTreeSet};

/// Segments sorted into rows by y.
struct Rows {
    low: f64,
    inverse: f64,
    /// By row, then by descending x: what lies left of a node ends its row.
    entries: Vec<Entry>,
    /// Symmetry lines: a point and the normal that points to the model.
    lines: Vec<[Vector; 2]>,
    /// Nodes nearer than this to a symmetry line are on it, m.
    rounding: f64,
    begin: Vec<usize>,
}

/// A segment in a row.
struct Entry {
    row: usize,
    /// Largest x, m.
    x: f64,
    segment: [u32; 2],
    body: u32,
}

/// Segments of the bodies that were asked for.
#[derive(Default)]
struct Whole {
    of: BTreeMap<u32, Vec<u32>>,
}

impl Whole {
    fn segments(&mut self, body: u32, bodies: &[u32]) -> &[u32] {
        let own = || (0..).zip(bodies).filter(|(_, of)| **of == body).map(|(segment, _)| segment).collect();
        self.of.entry(body).or_insert_with(own)
    }
}

/// With more bodies than this, their boxes are not asked first.
const BOXES: usize = 64;

/// The box of a body: lower and upper corner.
type Extent = [Vector; 2];

impl Pass {
    /// Enters the nodes that are inside other bodies; of surfaces with ends only where `open` says so.
    pub(super) fn start(&mut self, targets: &[Target], positions: &[Vector], open: bool) {
        let target = &targets[self.target];
        let enclosed = self.enclosed(target, positions);
        let mut inside = if open { self.near_ones(target, &enclosed, positions) } else { Vec::new() };
        let segments = || target.surface.segments.iter().copied().zip(self.segment_bodies.iter().copied());
        let lids = || self.lids.iter().map(|&(lid, body)| (lid, body, true));
        let closed =
            || segments().map(|(segment, body)| (segment, body, false)).chain(lids()).filter(|(_, body, _)| enclosed.contains(body));
        let mut boxes: BTreeMap<u32, Extent> = BTreeMap::new();
        for (segment, body, _) in closed() {
            let extent = boxes.entry(body).or_insert([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]);
            for (x, d) in segment.iter().flat_map(|&node| [0, 1].map(|d| (positions[node as usize][d], d))) {
                extent[0][d] = extent[0][d].min(x);
                extent[1][d] = extent[1][d].max(x);
            }
        }
        let boxes: Vec<(u32, Extent)> = boxes.into_iter().collect();
        let within = |x: Vector, [low, high]: Extent| (0..2).all(|d| low[d] <= x[d] && x[d] <= high[d]);
        let is_near = |x: Vector, own: u32| boxes.len() > BOXES || boxes.iter().any(|&(body, extent)| body != own && within(x, extent));
        let (mut rows, mut whole) = (None, Whole::default());
        for slave in 0..self.slave_bodies.len() {
            let ((node, x), own) = (self.place(targets, slave, positions), self.slave_bodies[slave]);
            if !is_near(x, own) || self.joins(target, node) {
                continue;
            }
            let rows = rows.get_or_insert_with(|| Rows::new(closed(), positions));
            for (body, level) in rows.levels(x, own, positions) {
                // A node exactly on a corner may count as −1: what it does next is counted from there.
                if level <= 0 {
                    inside.extend((level < 0).then(|| self.entered(slave, node, body, level, None)));
                    continue;
                }
                // Candidates are all segments within reach; who is deeper asks the whole body.
                let mut nearest = target.nearest(x, self.candidates_of(slave, body), positions);
                if nearest.is_none() {
                    nearest = target.nearest(x, whole.segments(body, &self.segment_bodies), positions);
                }
                inside.push(self.entered(slave, node, body, level, nearest.filter(|nearest| nearest.gap < 0.0)));
            }
        }
        self.enter(inside);
    }

    fn entered(&self, slave: usize, node: u32, body: u32, level: i32, nearest: Option<Projection>) -> Group {
        let group = self.group(slave as u32, node, body);
        Group { level, memory: nearest.map_or(group.memory, |nearest| nearest.segment), ..group }
    }

    fn joins(&self, target: &Target, node: u32) -> bool {
        self.slave != self.target && target.surface.nodes.binary_search(&node).is_ok()
    }

    /// Bodies that their surface, with the segments on symmetry lines, goes around: as many segments begin as
    /// end at each node, and the area on their right is not that of a void.
    fn enclosed(&self, target: &Target, positions: &[Vector]) -> BTreeSet<u32> {
        let segments = target.surface.segments.iter().copied().zip(self.segment_bodies.iter().copied());
        // Seen from one of their nodes: far from the origin no digits are lost, and what a chain encloses is
        // the same from anywhere.
        let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
        let mut seen_from: BTreeMap<u32, Vector> = BTreeMap::new();
        let mut ends = Vec::new();
        for ([a, b], body) in segments.chain(self.lids.iter().copied()) {
            let from = *seen_from.entry(body).or_insert(positions[a as usize]);
            let [p, q] = [a, b].map(|node| minus(positions[node as usize], from));
            *areas.entry(body).or_insert(0.0) -= cross(p, q);
            ends.extend([(body, a, 1), (body, b, -1)]);
        }
        ends.sort_unstable();
        for at_node in ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            if at_node.iter().map(|end| end.2).sum::<i32>() != 0 {
                areas.remove(&at_node[0].0);
            }
        }
        areas.into_iter().filter(|&(_, area)| area > 0.0).map(|(body, _)| body).collect()
    }

    /// Nodes that are behind the nearest candidate of a surface that does not enclose its body.
    fn near_ones(&self, target: &Target, enclosed: &BTreeSet<u32>, positions: &[Vector]) -> Vec<Group> {
        let of = |group: &Group| {
            let candidates = &self.candidates[group.begin as usize..group.end as usize];
            let nearest = target.nearest(positions[group.node as usize], candidates, positions)?;
            // From here on the level counts, as it does where the surface is closed.
            let level = i32::from(!group.open);
            (nearest.gap < 0.0).then_some(Group { memory: nearest.segment, level, ..*group })
        };
        self.groups.iter().filter(|group| !group.own && !enclosed.contains(&group.body)).filter_map(of).collect()
    }
}

impl Rows {
    fn new(segments: impl Iterator<Item = ([u32; 2], u32, bool)> + Clone, positions: &[Vector]) -> Self {
        let ends = |segment: [u32; 2]| segment.map(|node| positions[node as usize]);
        let (mut low, mut high, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for (segment, ..) in segments.clone() {
            for [_, y] in ends(segment) {
                (low, high) = (low.min(y), high.max(y));
            }
            count += 1;
        }
        // As many rows as make a segment span one in the mean, at most one per segment.
        let height = high - low;
        let heights: f64 = segments.clone().map(|(segment, ..)| ends(segment)).map(|[a, b]| (a[1] - b[1]).abs()).sum();
        let rows = (height * f64::from(count) / heights).clamp(1.0, f64::from(count).max(1.0));
        let inverse = if height > 0.0 { rows / height } else { 0.0 };
        // A fraction of what there is, and what coordinates so large round to.
        let rounding = 1e-9 * height + 4.0 * f64::EPSILON * low.abs().max(high.abs());
        let mut rows = Self { low, inverse, entries: Vec::new(), lines: Vec::new(), rounding, begin: Vec::new() };
        for (segment, body, is_lid) in segments {
            let [a, b] = ends(segment);
            if is_lid {
                rows.add_line(a, b);
            }
            // A level segment crosses no ray.
            if a[1] != b[1] {
                let x = a[0].max(b[0]);
                let span = rows.row(a[1].min(b[1]))..=rows.row(a[1].max(b[1]));
                rows.entries.extend(span.map(|row| Entry { row, x, segment, body }));
            }
        }
        rows.entries.sort_by(|a, b| a.row.cmp(&b.row).then(b.x.total_cmp(&a.x)));
        let last = rows.entries.last().map_or(0, |entry| entry.row);
        rows.begin = (0..=last + 1).map(|row| rows.entries.partition_point(|entry| entry.row < row)).collect();
        rows
    }

    /// Notes the line of a segment that runs with the body on its right.
    fn add_line(&mut self, a: Vector, b: Vector) {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let normal = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
        let same = |[point, other]: &[Vector; 2]| {
            distance(a, [*point, *other]).abs() <= self.rounding && (normal[0] * other[0] + normal[1] * other[1]) > 1.0 - 1e-9
        };
        if length > 0.0 && !self.lines.iter().any(same) {
            self.lines.push([a, normal]);
        }
    }

    /// A node on a symmetry line is as inside as its mirror image: seen from a little off the line.
    fn off_lines(&self, mut x: Vector) -> Vector {
        for line in &self.lines {
            if distance(x, *line).abs() <= self.rounding {
                x = [x[0] + 2.0 * self.rounding * line[1][0], x[1] + 2.0 * self.rounding * line[1][1]];
            }
        }
        x
    }

    fn row(&self, y: f64) -> usize {
        ((y - self.low) * self.inverse) as usize
    }

    /// How often `x` is inside each body but its own; bodies ascending.
    fn levels(&self, x: Vector, own: u32, positions: &[Vector]) -> BTreeMap<u32, i32> {
        let mut levels = BTreeMap::new();
        let x = self.off_lines(x);
        let row = self.row(x[1]);
        if x[1] >= self.low && row + 1 < self.begin.len() {
            let entries = &self.entries[self.begin[row]..self.begin[row + 1]];
            for entry in entries.iter().take_while(|entry| entry.x >= x[0]).filter(|entry| entry.body != own) {
                *levels.entry(entry.body).or_insert(0) -= Target::turn(x, entry.segment, positions);
            }
        }
        levels
    }
}

fn distance(x: Vector, [point, normal]: [Vector; 2]) -> f64 {
    (x[0] - point[0]) * normal[0] + (x[1] - point[1]) * normal[1]
}
