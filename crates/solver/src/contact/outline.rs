//! Outlines of bodies in 2D: what is opposite of each segment, and what is inside.
//!
//! Local thickness is how far the surface is on the other side, along the inward normal. The ray from the
//! middle of a segment finds the opposite segment once, at the start; what lies there is followed as both
//! move, so that a crushed body is as thin as it is. On a symmetry line the body continues as its image.
//! Nothing is thicker than 4 A / P with the area A and the perimeter P of the body, which is twice the radius
//! of the inscribed circle for polygons that have one, and more for other convex ones. That is taken, too,
//! where the ray leaves the body at less than 30 degrees to the surface there, as beside a corner.

mod folds;
mod sides;

use super::Vector;
use super::boxes::{Aabb, around, do_meet, joined, longest, meets_ray, square_away};
use super::findings::PLACES;
use crate::mesh::surface::{NONE, Surface};
use crate::vector::{dot, minus};
use robust::{Coord, orient2d};
pub use sides::Sides;
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
    /// Thickness at the start, m, and the most that it can be; infinite: unknown.
    pub(super) initial: f64,
    most: f64,
}

impl Default for Opposite {
    fn default() -> Self {
        Self { nodes: [NONE; 2], share: 0.0, is_mirror: false, initial: f64::INFINITY, most: f64::INFINITY }
    }
}

impl Opposite {
    /// Thickness now, m.
    pub(super) fn now(&self, [a, b]: [u32; 2], positions: &[Vector]) -> f64 {
        if self.nodes[0] == NONE {
            return self.most;
        }
        let [a, b, p, q] = [a, b, self.nodes[0], self.nodes[1]].map(|node| positions[node as usize]);
        let away = [0, 1].map(|d| (1.0 - self.share) * p[d] + self.share * q[d] - 0.5 * (a[d] + b[d]));
        let way = dot(away, away).sqrt();
        if self.is_mirror { 2.0 * way } else { way }.min(self.most)
    }
}

/// All bodies of a plane mesh.
#[derive(Clone, Debug, Default)]
pub struct Outlines {
    pub(super) bodies: Vec<Outline>,
    /// What is opposite of each segment.
    opposite: BTreeMap<[u32; 2], Opposite>,
}

impl Outlines {
    /// Of an outside, with the segments on symmetry lines (`is_mirror`), of bodies at their initial
    /// `positions`, m.
    #[must_use]
    pub fn new(outside: &[[u32; 2]], is_mirror: impl Fn([u32; 2]) -> bool, body_of: &[u32], positions: &[Vector]) -> Self {
        let body = |segment: &[u32; 2]| body_of.get(segment[0] as usize).copied().unwrap_or(0);
        let mut of_body: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
        outside.iter().for_each(|segment| of_body.entry(body(segment)).or_default().push(*segment));
        let bodies: Vec<Outline> =
            of_body.into_iter().map(|(body, segments)| Outline::new(body, segments, &is_mirror, positions)).collect();
        let opposite = bodies.iter().flat_map(|outline| &outline.sides).map(|side| (side.segment, side.opposite)).collect();
        Self { bodies, opposite }
    }

    /// With the outlines of these bodies as a first side, and that of the rigid body `other`, whose solid is
    /// on the right of its segments, as a second one.
    pub(crate) fn against(&self, counts: impl Fn(u32) -> bool, other: (u32, Vec<[u32; 2]>), positions: &[Vector]) -> Vec<(Outline, u8)> {
        let bodies = self.bodies.iter().filter(|outline| counts(outline.body)).map(|outline| (outline.clone(), 1));
        bodies.chain([(Outline::new(other.0, other.1, &|_| false, positions), 2)]).collect()
    }

    /// What is opposite of the segments of a surface.
    #[must_use]
    pub fn opposite(&self, surface: &Surface<2>) -> Vec<Opposite> {
        surface.segments.iter().map(|segment| self.opposite.get(segment).copied().unwrap_or_default()).collect()
    }
}

/// A segment of an outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) segment: [u32; 2],
    pub(super) opposite: Opposite,
    /// Whether it lies on a symmetry line: it closes the body and is no surface of it.
    pub(super) is_mirror: bool,
}

/// The outline of a body: its segments in the order of a binary tree of boxes, by halves along the longer
/// axis of their middles.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    pub(super) body: u32,
    pub(super) sides: Vec<Side>,
    /// Whether the solid is outside of it, as that of a hollow obstacle.
    is_hollow: bool,
    /// The box around each half, and where that of its second half is; the first follows.
    boxes: Vec<(Aabb<2>, u32)>,
}

impl Outline {
    fn new(body: u32, segments: Vec<[u32; 2]>, is_mirror: &impl Fn([u32; 2]) -> bool, positions: &[Vector]) -> Self {
        let (mut double, mut perimeter) = (0.0, 0.0);
        let origin = positions[segments[0][0] as usize];
        for &segment in &segments {
            let [a, b] = segment.map(|node| minus(positions[node as usize], origin));
            double += a[1] * b[0] - a[0] * b[1];
            perimeter += if is_mirror(segment) { 0.0 } else { dot(minus(b, a), minus(b, a)).sqrt() };
        }
        let most = if double > 0.0 && perimeter > 0.0 { 2.0 * double / perimeter } else { f64::INFINITY };
        let opposite = Opposite { initial: most, most, ..Opposite::default() };
        let side = |segment: [u32; 2]| Side { segment, opposite, is_mirror: is_mirror(segment) };
        let is_hollow = double < 0.0;
        let mut made = Self { body, sides: segments.into_iter().map(side).collect(), is_hollow, boxes: Vec::new() };
        sort(&mut made.sides, positions);
        made.refit(positions);
        let found: Vec<Option<Opposite>> = made.sides.iter().map(|side| made.opposite(side, positions)).collect();
        for (side, found) in made.sides.iter_mut().zip(found) {
            side.opposite = found.unwrap_or(opposite);
        }
        made
    }

    /// Takes the boxes again.
    pub(super) fn refit(&mut self, positions: &[Vector]) {
        let mut boxes = std::mem::take(&mut self.boxes);
        boxes.clear();
        fit(&self.sides, positions, &mut boxes);
        self.boxes = boxes;
    }

    /// The box around all of it.
    pub(super) fn around(&self) -> Aabb<2> {
        self.boxes[0].0
    }

    /// Shows the segments of leaves whose boxes count, and those of all boxes around them.
    fn visit(&self, mut counts: impl FnMut(&Aabb<2>) -> bool, mut see: impl FnMut(&Side)) {
        self.visit_below(0, &self.sides, &mut counts, &mut see);
    }

    fn visit_below(&self, number: usize, sides: &[Side], counts: &mut impl FnMut(&Aabb<2>) -> bool, see: &mut impl FnMut(&Side)) {
        let (around, second) = &self.boxes[number];
        if !counts(around) {
            return;
        }
        if sides.len() <= LEAF {
            return sides.iter().for_each(see);
        }
        let (first, last) = sides.split_at(sides.len() / 2);
        self.visit_below(number + 1, first, counts, see);
        self.visit_below(*second as usize, last, counts, see);
    }

    /// Where the ray from the middle of a segment inwards first leaves the body, if the surface there looks
    /// the other way.
    fn opposite(&self, side: &Side, positions: &[Vector]) -> Option<Opposite> {
        let [a, b] = side.segment.map(|node| positions[node as usize]);
        let along = minus(b, a);
        let size = dot(along, along).sqrt();
        // The body is on the right.
        let (from, inward) = ([0, 1].map(|d| 0.5 * (a[d] + b[d])), [along[1] / size, -along[0] / size]);
        let far = std::cell::Cell::new(f64::INFINITY);
        let mut nearest = None;
        self.visit(
            |around| meets_ray(around, from, inward, far.get()),
            |other| {
                let [p, q] = other.segment.map(|node| positions[node as usize]);
                let met = if other.segment == side.segment { None } else { meets(from, inward, p, q) };
                if let Some((away, share, cosine)) = met.filter(|met| met.0 < far.get()) {
                    far.set(away);
                    let found = Opposite { nodes: other.segment, share, is_mirror: other.is_mirror, ..side.opposite };
                    nearest = (cosine > -OPPOSITE).then_some(found);
                }
            },
        );
        nearest.map(|found| Opposite { initial: found.now(side.segment, positions), ..found })
    }

    /// Whether a place is inside, by its winding number.
    pub(super) fn is_inside(&self, x: Vector, positions: &[Vector]) -> bool {
        // Across the longer extent a ray meets few segments.
        let [low, high] = self.around();
        let is_wide = high[0] - low[0] > high[1] - low[1];
        (self.winding(x, is_wide, |_| true, positions) != 0) != self.is_hollow
    }

    /// Winding number of a place, of the segments that count: by a ray along x, or along y if the outline
    /// `is_turned`, which changes the sign.
    fn winding(&self, x: Vector, is_turned: bool, counts: impl Fn(&Side) -> bool, positions: &[Vector]) -> i32 {
        let turned = |[x, y]: Vector| if is_turned { [y, x] } else { [x, y] };
        let x = turned(x);
        let mut winding = 0;
        self.visit(
            |around| {
                let [low, high] = around.map(turned);
                low[1] <= x[1] && x[1] <= high[1] && x[0] <= high[0]
            },
            |side| {
                let [a, b] = side.segment.map(|node| turned(positions[node as usize]));
                let rises = b[1] > x[1];
                if (a[1] > x[1]) != rises && (turn(a, b, x) > 0.0) == rises && counts(side) {
                    winding += if rises { 1 } else { -1 };
                }
            },
        );
        winding
    }

    /// The segment that is nearest to a place, and the square of the distance, m².
    pub(super) fn nearest(&self, x: Vector, positions: &[Vector]) -> Option<(f64, Side)> {
        let square = std::cell::Cell::new(f64::INFINITY);
        let mut found = None;
        self.visit(
            |around| square_away(around, x) < square.get(),
            |side| {
                let away = square_to(x, side.segment.map(|node| positions[node as usize]));
                if !side.is_mirror && away < square.get() {
                    square.set(away);
                    found = Some((away, *side));
                }
            },
        );
        found
    }

    /// Adds where along the way from p to q (0 to 1) the segments that count are crossed.
    fn cross(&self, [p, q]: [Vector; 2], counts: impl Fn(&Side) -> bool, positions: &[Vector], places: &mut Vec<f64>) {
        let way = around([p, q]);
        self.visit(
            |around| do_meet(around, &way),
            |side| {
                let [a, b] = side.segment.map(|node| positions[node as usize]);
                let (from, to) = (turn(a, b, p), turn(a, b, q));
                if (from > 0.0) != (to > 0.0) && (turn(p, q, a) > 0.0) != (turn(p, q, b) > 0.0) && counts(side) {
                    places.push(from / (from - to));
                }
            },
        );
    }

    /// Shows nodes of this outline that are inside another one, and three places on each part of its segments
    /// that is, and whether a place is the first node of its segment. Returns how many segments it looked at.
    pub(super) fn inside(&self, other: &Self, positions: &[Vector], mut see: impl FnMut(Vector, &Side, bool)) -> usize {
        let near: Vec<&Side> = self.near(other, positions).collect();
        let looked = near.len();
        let (cuts, begin) = other.cuts(&near, |_, _| true, positions);
        // Outlines that do not cut each other are apart, or one is all inside.
        let middle = |side: &Side| {
            let [a, b] = side.segment.map(|node| positions[node as usize]);
            [0, 1].map(|d| 0.5 * (a[d] + b[d]))
        };
        if cuts.is_empty() && !near.first().is_some_and(|side| other.is_inside(middle(side), positions)) {
            return looked;
        }
        for (side, range) in near.into_iter().zip(begin.windows(2)) {
            let ends = side.segment.map(|node| positions[node as usize]);
            for (part, [from, to]) in pieces(&cuts[range[0]..range[1]]).enumerate() {
                let at = |share: f64| between(ends, from + share * (to - from));
                if other.is_inside(at(0.5), positions) {
                    if part == 0 {
                        see(ends[0], side, true);
                    }
                    PLACES.into_iter().for_each(|share| see(at(share), side, false));
                }
            }
        }
        looked
    }

    /// Where segments cut this outline, of those of its own that count for each: shares of their ways,
    /// ascending, and where those of each segment begin.
    fn cuts(&self, of: &[&Side], counts: impl Fn(&Side, &Side) -> bool, positions: &[Vector]) -> (Vec<f64>, Vec<usize>) {
        let (mut cuts, mut begin) = (Vec::new(), vec![0]);
        for &side in of {
            let first = cuts.len();
            self.cross(side.segment.map(|node| positions[node as usize]), |other| counts(side, other), positions, &mut cuts);
            cuts[first..].sort_by(f64::total_cmp);
            begin.push(cuts.len());
        }
        (cuts, begin)
    }

    /// Its segments near another outline.
    fn near<'a>(&'a self, other: &'a Self, positions: &'a [Vector]) -> impl Iterator<Item = &'a Side> {
        let around = other.around();
        let is_near = move |side: &&Side| !side.is_mirror && do_meet(&box_of(std::slice::from_ref(*side), positions), &around);
        self.sides.iter().filter(is_near)
    }
}

/// The pieces between cuts of a segment, from a share of its way to another.
fn pieces(cuts: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    (0..=cuts.len()).map(|k| [if k == 0 { 0.0 } else { cuts[k - 1] }, cuts.get(k).copied().unwrap_or(1.0)])
}

/// The place at a share of the way from p to q.
fn between([p, q]: [Vector; 2], share: f64) -> Vector {
    [0, 1].map(|d| (1.0 - share) * p[d] + share * q[d])
}

/// Square of the distance of a place from the way from p to q, m².
fn square_to(x: Vector, [p, q]: [Vector; 2]) -> f64 {
    let (along, off) = (minus(q, p), minus(x, p));
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(off, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let away = [0, 1].map(|d| off[d] - share * along[d]);
    dot(away, away)
}

/// Twice the area of the triangle a, b, c, with the right sign: positive where c is on the left of a → b.
fn turn(a: Vector, b: Vector, c: Vector) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

/// Sorts segments so that halves of them, of those and so on are apart.
fn sort(sides: &mut [Side], positions: &[Vector]) {
    if sides.len() <= LEAF {
        return;
    }
    let axis = longest(&box_of(sides, positions));
    let middle = |Side { segment: [a, b], .. }: &Side| positions[*a as usize][axis] + positions[*b as usize][axis];
    sides.sort_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.segment.cmp(&b.segment)));
    let (first, second) = sides.split_at_mut(sides.len() / 2);
    sort(first, positions);
    sort(second, positions);
}

/// Adds the box of segments, then those of both halves; the first.
fn fit(sides: &[Side], positions: &[Vector], boxes: &mut Vec<(Aabb<2>, u32)>) -> Aabb<2> {
    let at = boxes.len();
    boxes.push(([[0.0; 2]; 2], 0));
    if sides.len() > LEAF {
        let (first, second) = sides.split_at(sides.len() / 2);
        let a = fit(first, positions, boxes);
        boxes[at].1 = boxes.len() as u32;
        let b = fit(second, positions, boxes);
        boxes[at].0 = joined(a, b);
    } else {
        boxes[at].0 = box_of(sides, positions);
    }
    boxes[at].0
}

fn box_of(sides: &[Side], positions: &[Vector]) -> Aabb<2> {
    around(sides.iter().flat_map(|side| side.segment).map(|node| positions[node as usize]))
}

/// Where a ray meets a segment from p to q that it comes to from inside: how far, m, the share of q there,
/// and the cosine between its direction and the normal.
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
        let made = Outlines::new(&segments, |_| false, &vec![0; places.len()], &places);
        segments.iter().map(|segment| of_segment(&made, *segment).initial).collect()
    }

    fn of_segment(made: &Outlines, segment: [u32; 2]) -> Opposite {
        made.bodies[0].sides.iter().find(|side| side.segment == segment).unwrap().opposite
    }

    #[test]
    fn a_rectangle_is_as_thick_as_its_sides_are_apart_wherever_and_however_it_lies() {
        for (angle, shift) in [(0.0_f64, 0.0), (0.3, 0.0), (2.5, 1e6), (-1.0, -3.0)] {
            let (sin, cos) = angle.sin_cos();
            let corners =
                [[0.0, 0.0], [3.0, 0.0], [3.0, 0.5], [0.0, 0.5]].map(|[x, y]: Vector| [cos * x - sin * y + shift, sin * x + cos * y]);
            for parts in [1, 2, 7] {
                let found = of(&corners, parts);
                for (k, thickness) in found.iter().enumerate() {
                    // The ends are three apart, and nothing is thicker than 4 A / P.
                    let expected = if (k / parts) % 2 == 0 { 0.5 } else { 6.0 / 7.0 };
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
        // Beside corners the rays are short; the radius of the circle in it is a half.
        assert!(of(&triangle, 3).iter().all(|thickness| (thickness - 1.0).abs() < 1e-12 || *thickness > 0.499), "{:?}", of(&triangle, 3));
        let disk: Vec<Vector> = (0..64).map(|k| corner(k, 64)).collect();
        assert!(of(&disk, 1).iter().all(|thickness| (thickness - 2.0).abs() < 0.005), "{:?}", of(&disk, 1));
    }

    #[test]
    fn a_half_on_a_symmetry_line_is_as_thick_as_the_whole_and_what_is_crushed_is_thin() {
        let (segments, mut places) = outline(&[[0.0, 0.0], [3.0, 0.0], [3.0, 0.5], [0.0, 0.5]], 4);
        let is_mirror = |segment: [u32; 2]| segment.iter().all(|&node| node <= 4);
        let made = Outlines::new(&segments, is_mirror, &[0; 16], &places);
        let top = segments.iter().copied().filter(|segment| segment.iter().all(|&node| (8..=12).contains(&node)));
        let top: Vec<[u32; 2]> = top.collect();
        assert_eq!(top.len(), 4);
        assert!(top.iter().all(|segment| (of_segment(&made, *segment).initial - 1.0).abs() < 1e-12));
        places.iter_mut().for_each(|x| x[1] *= 0.25);
        assert!(top.iter().all(|segment| (of_segment(&made, *segment).now(*segment, &places) - 0.25).abs() < 1e-12));
    }

    /// Two rectangles, each turned and shifted.
    fn two(angle: f64, shift: Vector, parts: usize) -> (Outlines, Vec<Vector>) {
        let (mut segments, mut places) = outline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], parts);
        let (other, more) = outline(&[[0.0, 0.0], [3.0, 0.0], [3.0, 0.2], [0.0, 0.2]], parts);
        let first = places.len() as u32;
        segments.extend(other.iter().map(|segment| segment.map(|node| node + first)));
        let (sin, cos) = angle.sin_cos();
        places.extend(more.iter().map(|x| [cos * x[0] - sin * x[1] + shift[0], sin * x[0] + cos * x[1] + shift[1]]));
        let bodies: Vec<u32> = (0..places.len() as u32).map(|node| u32::from(node >= first)).collect();
        (Outlines::new(&segments, |_| false, &bodies, &places), places)
    }

    fn deepest(made: &Outlines, places: &[Vector]) -> f64 {
        let mut deepest: f64 = 0.0;
        for [own, other] in [[0, 1], [1, 0]] {
            made.bodies[own].inside(&made.bodies[other], places, |x, _, _| {
                if made.bodies[other].is_inside(x, places) {
                    deepest = deepest.max(made.bodies[other].nearest(x, places).unwrap().0.sqrt());
                }
            });
        }
        deepest
    }

    #[test]
    fn what_is_inside_is_found_also_where_no_node_is() {
        for parts in [1, 3, 8] {
            // A bar through the middle of a square: no node of either is in the other, and its sides are 0.4
            // and 0.2 from the nearest sides.
            let (made, places) = two(0.0, [-1.0, 0.4], parts);
            assert!((deepest(&made, &places) - 0.4).abs() < 0.11, "{parts}: {}", deepest(&made, &places));
            // Its end in the square, by 0.1 from the left.
            let (made, places) = two(0.0, [-2.9, 0.4], parts);
            assert!((deepest(&made, &places) - 0.1).abs() < 1e-12, "{parts}: {}", deepest(&made, &places));
            // Beside it, and flush with it.
            for shift in [[1.5, 0.4], [1.0, 0.0], [0.0, 1.0], [-1.0, -0.2], [-3.0, 0.4]] {
                let (made, places) = two(0.0, shift, parts);
                assert!(deepest(&made, &places) < 1e-15, "{parts} {shift:?}: {}", deepest(&made, &places));
            }
            // All inside.
            let (made, places) = two(0.0, [0.1, 0.4], parts);
            assert!(deepest(&made, &places) > 0.09);
        }
    }

    #[test]
    fn winding_numbers_agree_with_a_closed_form_for_turned_bars() {
        let mut state = 12345_u32;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            f64::from(state) / f64::from(u32::MAX)
        };
        for _ in 0..200 {
            let (angle, shift) = (6.3 * random(), [random(), random()]);
            let (made, places) = two(angle, shift, 5);
            for _ in 0..20 {
                let x = [4.0 * random() - 1.5, 4.0 * random() - 1.5];
                let off = minus(x, shift);
                let own = [angle.cos() * off[0] + angle.sin() * off[1], angle.cos() * off[1] - angle.sin() * off[0]];
                let expected = (0.0..=3.0).contains(&own[0]) && (0.0..=0.2).contains(&own[1]);
                assert_eq!(made.bodies[1].is_inside(x, &places), expected, "{angle} {shift:?} {x:?}");
            }
        }
    }
}
