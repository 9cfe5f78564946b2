//! Local thickness of bodies of the plane: how far their surface is on the other side, along the inward normal.
//!
//! The ray from the middle of a segment finds the opposite segment once, at the start; what lies there is followed as both move, so that a crushed body is as thin as it is. On a symmetry line the
//! body goes on as its image. Where the ray leaves the body at less than 30 degrees to the surface there, as beside a corner, the segment is as thick as a round body of the same shape: 4 A / P with
//! the area A and the perimeter P of the body, which is twice the radius of the inscribed circle of every polygon that has one.

use super::findings::{Findings, Overlap};
use super::law::penalty::LIMIT;
use super::tracker::{Touch, Tracker};
use super::{Scene, Vector};
use crate::archive::{Archive, Kept, keep_each};
use crate::mesh::surface::{NONE, Surface};
use crate::vector::{dot, minus};
use std::collections::BTreeMap;

/// Cosine between the normals of a segment and of the opposite one.
const OPPOSITE: f64 = -0.5;
/// How far beside a segment a ray may pass and still meet it, as a share.
const BESIDE: f64 = 1e-9;
/// Segments of a leaf of the tree.
const LEAF: usize = 4;

/// What is opposite of a segment.
#[derive(Clone, Copy, Debug)]
pub struct Opposite {
    /// Its nodes, [`NONE`] where there is nothing, and the place between them.
    nodes: [u32; 2],
    share: f64,
    /// Whether it lies on a symmetry line.
    is_mirror: bool,
    /// Thickness at the start, m; infinite: unknown.
    initial: f64,
}

impl Default for Opposite {
    fn default() -> Self {
        Self { nodes: [NONE; 2], share: 0.0, is_mirror: false, initial: f64::INFINITY }
    }
}

impl Opposite {
    /// Thickness now, m.
    fn now(&self, [a, b]: [u32; 2], positions: &[Vector]) -> f64 {
        if self.nodes[0] == NONE {
            return self.initial;
        }
        let [a, b, p, q] = [a, b, self.nodes[0], self.nodes[1]].map(|node| positions[node as usize]);
        let away = [0, 1].map(|d| (1.0 - self.share) * p[d] + self.share * q[d] - 0.5 * (a[d] + b[d]));
        let way = dot(away, away).sqrt();
        if self.is_mirror { 2.0 * way } else { way }
    }
}

/// Of all segments of the outside of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Thickness(BTreeMap<[u32; 2], Opposite>);

impl Thickness {
    /// Of an outside, with the segments on symmetry lines (`is_mirror`), of bodies at their initial `positions`, m.
    #[must_use]
    pub fn new(outside: &[[u32; 2]], is_mirror: impl Fn([u32; 2]) -> bool, body_of: &[u32], positions: &[Vector]) -> Self {
        let body = |segment: &[u32; 2]| body_of.get(segment[0] as usize).copied().unwrap_or(0);
        let mut of_body: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
        outside.iter().for_each(|segment| of_body.entry(body(segment)).or_default().push(*segment));
        let mut all = BTreeMap::new();
        for mut segments in of_body.into_values() {
            let (mut double, mut perimeter) = (0.0, 0.0);
            let origin = positions[segments[0][0] as usize];
            for &segment in &segments {
                let [a, b] = segment.map(|node| minus(positions[node as usize], origin));
                double += a[1] * b[0] - a[0] * b[1];
                perimeter += if is_mirror(segment) { 0.0 } else { dot(minus(b, a), minus(b, a)).sqrt() };
            }
            let round = if double > 0.0 && perimeter > 0.0 { 2.0 * double / perimeter } else { f64::INFINITY };
            let tree = Tree::new(&mut segments, positions);
            for &segment in segments.iter().filter(|segment| !is_mirror(**segment)) {
                let found = tree.opposite(&segments, segment, positions).map(|(nodes, share)| {
                    let found = Opposite { nodes, share, is_mirror: is_mirror(nodes), initial: 0.0 };
                    Opposite { initial: found.now(segment, positions), ..found }
                });
                all.insert(segment, found.unwrap_or(Opposite { initial: round, ..Opposite::default() }));
            }
        }
        Self(all)
    }

    /// Of the segments of a surface.
    #[must_use]
    pub fn of(&self, surface: &Surface) -> Vec<Opposite> {
        surface.segments.iter().map(|segment| self.0.get(segment).copied().unwrap_or_default()).collect()
    }
}

/// Depths of a contact of the plane against the local thickness, the lesser of both bodies'.
#[derive(Debug, Default)]
pub struct Depths {
    /// What is opposite of the segments of each surface.
    surfaces: Vec<Vec<Opposite>>,
    findings: Findings,
    /// Deepest of the step against its thickness.
    deepest: f64,
}

/// Fraction of the depth beyond which springs stiffen from which on a depth is looked at: a body may be crushed to a sixteenth.
const SEEN: f32 = 0.1;

impl Depths {
    /// For surfaces with what is opposite of their segments.
    #[must_use]
    pub fn new(surfaces: Vec<Vec<Opposite>>) -> Self {
        Self { surfaces, ..Self::default() }
    }

    /// What was found.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Depth beyond which a spring between segments (of their surfaces) stiffens, m: from the thickness at the start.
    #[must_use]
    pub fn limit(&self, around: impl IntoIterator<Item = (usize, u32)>) -> f32 {
        let initial = |(surface, segment): (usize, u32)| Some(self.surfaces.get(surface)?.get(segment as usize)?.initial);
        (LIMIT * around.into_iter().filter_map(initial).fold(f64::INFINITY, f64::min)) as f32
    }

    /// A new step begins.
    pub fn begin(&mut self) {
        self.deepest = 0.0;
        let Findings { looks, now, own, through, .. } = &mut self.findings;
        *looks += 1;
        (*now, *own, *through) = (Overlap::default(), Overlap::default(), None);
    }

    /// Takes a node that is so deep inside (m), and the limit there; whether a contact is held is the search's to prove.
    pub fn see(&mut self, tracker: &Tracker, touch: &Touch, depth: f64, limit: f32, scene: &Scene<'_>) {
        if !(depth > f64::from(SEEN * limit)) {
            return;
        }
        let around = tracker.around(touch);
        let positions = scene.sweep.new;
        let thickness = |(surface, segment): (usize, u32)| {
            let opposite = self.surfaces.get(surface)?.get(segment as usize)?;
            Some(opposite.now(tracker.targets()[surface].surface.segments[segment as usize], positions))
        };
        let thickness = around.into_iter().filter_map(thickness).fold(f64::INFINITY, f64::min);
        let [(surface, segment), _, _] = around;
        let other = tracker.targets()[surface].surface.segments[segment as usize][0];
        let [x, y] = positions[touch.node as usize];
        let place = Overlap { place: [x, y, 0.0], depth, thickness, nodes: [touch.node, other], time: scene.time };
        self.findings.see(place, touch.own);
        self.deepest = self.deepest.max(place.ratio());
    }

    /// The step has been seen: what is too deep counts.
    pub fn end(&mut self) {
        self.findings.count(self.deepest);
    }

    /// Keeps what was found.
    pub fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        keep_each!(archive; &mut self.findings);
        Ok(())
    }

    /// Goes on with the counts of another one whose surfaces were those before they changed.
    pub fn inherit(&mut self, old: &Self) {
        self.findings = old.findings;
    }
}

/// Boxes around segments in a binary tree, as halves of their list.
struct Tree(Vec<[Vector; 2]>);

impl Tree {
    /// Sorts the segments.
    fn new(segments: &mut [[u32; 2]], positions: &[Vector]) -> Self {
        let mut boxes = Vec::new();
        grow(segments, positions, &mut boxes);
        Self(boxes)
    }

    /// Where the ray from the middle of a segment inwards first leaves the body, if the surface there looks the other way.
    fn opposite(&self, segments: &[[u32; 2]], segment: [u32; 2], positions: &[Vector]) -> Option<([u32; 2], f64)> {
        let [a, b] = segment.map(|node| positions[node as usize]);
        let along = minus(b, a);
        let size = dot(along, along).sqrt();
        // The body is on the right.
        let (from, inward) = ([0, 1].map(|d| 0.5 * (a[d] + b[d])), [along[1] / size, -along[0] / size]);
        let mut nearest = (f64::INFINITY, None);
        let mut stack = vec![(0, 0, segments.len())];
        while let Some((number, begin, end)) = stack.pop() {
            if !meets_box(from, inward, self.0[number], nearest.0) {
                continue;
            }
            if end - begin > LEAF {
                let half = begin + (end - begin) / 2;
                let second = number + 2 * count(half - begin);
                stack.extend([(number + 1, begin, half), (second, half, end)]);
                continue;
            }
            for &other in segments[begin..end].iter().filter(|other| **other != segment) {
                let [p, q] = other.map(|node| positions[node as usize]);
                if let Some((away, share, cosine)) = meets(from, inward, p, q).filter(|met| met.0 < nearest.0) {
                    nearest = (away, (cosine > -OPPOSITE).then_some((other, share)));
                }
            }
        }
        nearest.1
    }
}

/// How many nodes the tree of so many segments has, more one, halved: leaves.
fn count(segments: usize) -> usize {
    if segments > LEAF { count(segments / 2) + count(segments - segments / 2) } else { 1 }
}

/// Adds the box of these segments, then those of both halves.
fn grow(segments: &mut [[u32; 2]], positions: &[Vector], boxes: &mut Vec<[Vector; 2]>) {
    let mut around = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for x in segments.iter().flatten().map(|&node| positions[node as usize]) {
        (0..2).for_each(|d| (around[0][d], around[1][d]) = (around[0][d].min(x[d]), around[1][d].max(x[d])));
    }
    boxes.push(around);
    if segments.len() > LEAF {
        let axis = usize::from(around[1][1] - around[0][1] > around[1][0] - around[0][0]);
        let middle = |[a, b]: &[u32; 2]| positions[*a as usize][axis] + positions[*b as usize][axis];
        segments.sort_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
        let (first, second) = segments.split_at_mut(segments.len() / 2);
        grow(first, positions, boxes);
        grow(second, positions, boxes);
    }
}

/// Whether a ray meets a box before it has gone so far.
fn meets_box(from: Vector, direction: Vector, [low, high]: [Vector; 2], far: f64) -> bool {
    let (mut begin, mut end) = (0.0, far);
    for d in 0..2 {
        if direction[d] == 0.0 {
            if from[d] < low[d] || from[d] > high[d] {
                return false;
            }
            continue;
        }
        let [s, t] = [low[d], high[d]].map(|bound| (bound - from[d]) / direction[d]);
        (begin, end) = (s.min(t).max(begin), s.max(t).min(end));
    }
    // A flat box counts, whatever rounds.
    begin <= end * (1.0 + BESIDE)
}

/// Where a ray meets a segment from p to q that it comes to from inside: how far, m, the share of q there, and the cosine between its direction and the normal.
fn meets(from: Vector, direction: Vector, p: Vector, q: Vector) -> Option<(f64, f64, f64)> {
    let along = minus(q, p);
    // The body is on the right: the normal looks to the left.
    let falls = direction[1] * along[0] - direction[0] * along[1];
    if !(falls > 0.0) {
        return None;
    }
    let off = minus(p, from);
    let away = (off[1] * along[0] - off[0] * along[1]) / falls;
    let share = (off[1] * direction[0] - off[0] * direction[1]) / falls;
    (away > 0.0 && (-BESIDE..=1.0 + BESIDE).contains(&share)).then(|| (away, share, falls / dot(along, along).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A closed outline, counter-clockwise, as segments with the body on their right.
    fn outline(points: &[Vector], parts: usize) -> (Vec<[u32; 2]>, Vec<Vector>) {
        let side = |k: usize| {
            let (a, b) = (points[k], points[(k + 1) % points.len()]);
            (0..parts).map(move |i| [0, 1].map(|d| a[d] + i as f64 / parts as f64 * (b[d] - a[d])))
        };
        let places: Vec<Vector> = (0..points.len()).flat_map(side).collect();
        let count = places.len() as u32;
        ((0..count).map(|k| [(k + 1) % count, k]).collect(), places)
    }

    fn of(points: &[Vector], parts: usize) -> Vec<f64> {
        let (segments, places) = outline(points, parts);
        let made = Thickness::new(&segments, |_| false, &vec![0; places.len()], &places);
        segments.iter().map(|segment| made.0[segment].initial).collect()
    }

    #[test]
    fn a_rectangle_is_as_thick_as_its_sides_are_apart_wherever_and_however_it_lies() {
        for (angle, shift) in [(0.0_f64, 0.0), (0.3, 0.0), (2.5, 1e6), (-1.0, -3.0)] {
            let (sin, cos) = angle.sin_cos();
            let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 0.5], [0.0, 0.5]].map(|[x, y]| [cos * x - sin * y + shift, sin * x + cos * y]);
            for parts in [1, 2, 7] {
                let found = of(&corners, parts);
                for (k, thickness) in found.iter().enumerate() {
                    let expected = if (k / parts) % 2 == 0 { 0.5 } else { 3.0 };
                    assert!((thickness - expected).abs() < 1e-9 * (1.0 + shift.abs()), "{angle} {parts} {k}: {thickness}");
                }
            }
        }
    }

    #[test]
    fn a_triangle_is_as_thick_as_the_circle_in_it_and_a_disk_as_its_diameter() {
        let corner = |k: usize, n: usize| {
            let angle = 2.0 * std::f64::consts::PI * k as f64 / n as f64;
            [angle.cos(), angle.sin()]
        };
        let triangle: Vec<Vector> = (0..3).map(|k| corner(k, 3)).collect();
        // One element a side: the rays meet corners; the radius of the circle in it is a half.
        assert!(of(&triangle, 3).iter().all(|thickness| (thickness - 1.0).abs() < 1e-12 || *thickness > 0.5), "{:?}", of(&triangle, 3));
        let disk: Vec<Vector> = (0..64).map(|k| corner(k, 64)).collect();
        assert!(of(&disk, 1).iter().all(|thickness| (thickness - 2.0).abs() < 0.005), "{:?}", of(&disk, 1));
    }

    #[test]
    fn a_half_on_a_symmetry_line_is_as_thick_as_the_whole_and_what_is_crushed_is_thin() {
        let (segments, mut places) = outline(&[[0.0, 0.0], [3.0, 0.0], [3.0, 0.5], [0.0, 0.5]], 4);
        let is_mirror = |segment: [u32; 2]| segment.iter().all(|&node| node <= 4);
        let made = Thickness::new(&segments, is_mirror, &[0; 16], &places);
        let top = segments.iter().copied().filter(|segment| segment.iter().all(|&node| (8..=12).contains(&node)));
        let top: Vec<[u32; 2]> = top.collect();
        assert_eq!(top.len(), 4);
        assert!(top.iter().all(|segment| (made.0[segment].initial - 1.0).abs() < 1e-12));
        places.iter_mut().for_each(|x| x[1] *= 0.25);
        assert!(top.iter().all(|segment| (made.0[segment].now(*segment, &places) - 0.25).abs() < 1e-12));
    }
}
