//! Which nodes are inside other bodies when nothing is known of the past: by winding numbers, exactly as the levels count from then on.
//!
//! A ray along +x is counted against the segments of its row; only nodes within the box of another body are asked. Surfaces with ends enclose nothing: there the nearest
//! feature within the first reach decides. A node is never inside its own body.

use super::super::projection::node_segment::{Projection, Target, Vector};
use super::group::{Group, Pass};
use std::collections::BTreeMap;

/// Segments sorted into rows by y.
struct Rows {
    low: f64,
    inverse: f64,
    /// (row, largest x, segment, body), by row, then by descending x: what lies left of a node ends its row.
    entries: Vec<(usize, f64, [u32; 2], u32)>,
    begin: Vec<usize>,
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
    /// Enters the nodes that are inside other bodies.
    pub(super) fn start(&mut self, targets: &[Target], positions: &[Vector]) {
        let target = &targets[self.target];
        let mut inside = self.open_ones(target, positions);
        let segments = || target.surface.segments.iter().copied().zip(self.segment_bodies.iter().copied());
        let closed = || segments().filter(|&(_, body)| !self.is_open(body)).chain(self.lids.iter().copied());
        let mut boxes: BTreeMap<u32, Extent> = BTreeMap::new();
        for (segment, body) in closed() {
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
            for (body, level) in rows.levels(x, own, positions).into_iter().filter(|&(_, level)| level > 0) {
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

    /// Nodes that are behind the nearest candidate of a surface with ends.
    fn open_ones(&self, target: &Target, positions: &[Vector]) -> Vec<Group> {
        let of = |group: &Group| {
            let candidates = &self.candidates[group.begin as usize..group.end as usize];
            let nearest = target.nearest(positions[group.node as usize], candidates, positions)?;
            (nearest.gap < 0.0).then_some(Group { memory: nearest.segment, ..*group })
        };
        self.groups.iter().filter(|group| group.open && !group.own).filter_map(of).collect()
    }
}

impl Rows {
    fn new(segments: impl Iterator<Item = ([u32; 2], u32)> + Clone, positions: &[Vector]) -> Self {
        let ends = |segment: [u32; 2]| segment.map(|node| positions[node as usize]);
        let (mut low, mut high, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0);
        for (segment, _) in segments.clone() {
            for [_, y] in ends(segment) {
                (low, high) = (low.min(y), high.max(y));
            }
            count += 1;
        }
        // As many rows as make a segment span one in the mean, at most one per segment.
        let height = high - low;
        let heights: f64 = segments.clone().map(|(segment, _)| ends(segment)).map(|[a, b]| (a[1] - b[1]).abs()).sum();
        let rows = (height * f64::from(count) / heights).clamp(1.0, f64::from(count).max(1.0));
        let inverse = if height > 0.0 { rows / height } else { 0.0 };
        let mut rows = Self { low, inverse, entries: Vec::new(), begin: Vec::new() };
        for (segment, body) in segments {
            let [a, b] = ends(segment);
            // A level segment crosses no ray.
            if a[1] != b[1] {
                let x = a[0].max(b[0]);
                rows.entries.extend((rows.row(a[1].min(b[1]))..=rows.row(a[1].max(b[1]))).map(|row| (row, x, segment, body)));
            }
        }
        rows.entries.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let last = rows.entries.last().map_or(0, |entry| entry.0);
        rows.begin = (0..=last + 1).map(|row| rows.entries.partition_point(|entry| entry.0 < row)).collect();
        rows
    }

    fn row(&self, y: f64) -> usize {
        ((y - self.low) * self.inverse) as usize
    }

    /// How often `x` is inside each body but its own; bodies ascending.
    fn levels(&self, x: Vector, own: u32, positions: &[Vector]) -> BTreeMap<u32, i32> {
        let mut levels = BTreeMap::new();
        let row = self.row(x[1]);
        if x[1] >= self.low && row + 1 < self.begin.len() {
            let entries = &self.entries[self.begin[row]..self.begin[row + 1]];
            for &(_, _, segment, body) in entries.iter().take_while(|entry| entry.1 >= x[0]).filter(|entry| entry.3 != own) {
                *levels.entry(body).or_insert(0) -= Target::turn(x, segment, positions);
            }
        }
        levels
    }
}
