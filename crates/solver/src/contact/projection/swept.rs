//! When, in a step, a node goes through a triangle that moves, and an edge through another one: the swept
//! check of solids, for the proof that no contact was missed.
//!
//! Positions of both ends of a step come from the check of missed contacts
//! ([`super::super::missed_contacts`]); all nodes go straight and evenly between them. Then the volume that a
//! node spans with a triangle, and that of two edges, is a cubic of the time, det(u, v, w) of three vectors
//! that are linear in it. Where it vanishes all four nodes are in one plane (Provot 1997; Bridson, Fedkiw and
//! Anderson 2002), and where the place is on the triangle, or on both edges, one goes through the other. In
//! Bernstein's form no sign changes among the coefficients mean no root, one change one root, and halves have
//! their coefficients by de Casteljau's rule: roots are isolated, not guessed. Everything within rounding
//! counts as it is worst for the proof: who begins a rounding behind the triangle begins in front of it, and
//! a place a rounding beyond an edge is on it.

use crate::tensor::{cross, dot};
use crate::vector::minus;

type Vector = [f64; 3];

/// Rounding of a volume, as a fraction of the product of its lengths.
pub(in crate::contact) const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// How far beyond the rim of a triangle, or the end of an edge, a place is on it: a fraction of its size.
const RIM: f64 = 1e-9;
/// Halvings of a step after which a root is known well enough, and the part of the step that is left then.
const HALVINGS: u32 = 50;
const ENOUGH: f64 = 1.0 / (1_u64 << HALVINGS) as f64;
/// Steps of the false position before halving; three lines of a cubic that is nearly straight would do.
const CHORDS: u32 = 12;

/// Times between 0 and 1 at which something may change its side; no cubic has more than two falls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    all: [f64; 3],
    count: usize,
}

impl Times {
    fn add(&mut self, time: f64) {
        if self.count < 3 {
            self.all[self.count] = time;
            self.count += 1;
        }
    }

    /// Ascending.
    pub fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.all[..self.count].iter().copied()
    }
}

/// Between two vectors, or places.
fn between<const N: usize>(old: [Vector; N], new: [Vector; N], time: f64) -> [Vector; N] {
    std::array::from_fn(|k| [0, 1, 2].map(|d| (1.0 - time) * old[k][d] + time * new[k][d]))
}

/// Bernstein's coefficients of det(u, v, w), m³, and what rounding may make of them.
fn volume(old: [Vector; 3], new: [Vector; 3]) -> ([f64; 4], f64) {
    let det = |u: Vector, v: Vector, w: Vector| dot(u, cross(v, w));
    let ([u, v, w], [p, q, r]) = (old, new);
    let third = 1.0 / 3.0;
    let coefficients = [
        det(u, v, w),
        third * (det(p, v, w) + det(u, q, w) + det(u, v, r)),
        third * (det(u, q, r) + det(p, v, r) + det(p, q, w)),
        det(p, q, r),
    ];
    let size = |k: usize| [old[k], new[k]].iter().map(|v| dot(*v, *v)).fold(0.0, f64::max).sqrt();
    (coefficients, ROUNDING * size(0) * size(1) * size(2))
}

/// Times at which a cubic with these coefficients, lifted by a rounding, goes from above or zero to below.
fn falls([a, b, c, d]: [f64; 4], rounding: f64) -> Times {
    let mut times = Times::default();
    let lifted = [a + rounding, b + rounding, c + rounding, d + rounding];
    if lifted.iter().any(|value| !(*value >= 0.0)) && lifted.iter().any(|value| *value >= 0.0) {
        split(lifted, [0.0, 1.0], HALVINGS, &mut times);
    }
    times
}

/// Adds the falls of a part of a step.
fn split([a, b, c, d]: [f64; 4], [begin, end]: [f64; 2], halvings: u32, times: &mut Times) {
    let above = [a, b, c, d].map(|value| value >= 0.0);
    let changes = (0..3).filter(|&k| above[k] != above[k + 1]).count();
    if changes == 0 || (changes == 1 && !above[0]) {
        return;
    }
    if changes == 1 {
        times.add(begin + only_fall([a, b, c, d], ENOUGH / (end - begin)) * (end - begin));
        return;
    }
    let middle = 0.5 * (begin + end);
    if halvings == 0 || !(middle > begin && middle < end) {
        if above[0] && !above[3] {
            times.add(begin);
        }
        return;
    }
    let half = |a: f64, b: f64| 0.5 * (a + b);
    let (ab, bc, cd) = (half(a, b), half(b, c), half(c, d));
    let (abc, bcd) = (half(ab, bc), half(bc, cd));
    let all = half(abc, bcd);
    split([a, ab, abc, all], [begin, middle], halvings - 1, times);
    split([all, bcd, cd, d], [middle, end], halvings - 1, times);
}

/// The last place between 0 and 1, but for `width`, at which a cubic that falls once has not fallen: the
/// false position (Illinois: Dowell and Jarratt, BIT 11 (1971) 168-174), then halves of what is left.
fn only_fall(coefficients: [f64; 4], width: f64) -> f64 {
    let at = |t: f64| {
        let [a, b, c, d] = coefficients;
        let (s, part) = (1.0 - t, |a: f64, b: f64| (1.0 - t) * a + t * b);
        let (ab, bc, cd) = (part(a, b), part(b, c), part(c, d));
        s * (s * ab + t * bc) + t * (s * bc + t * cd)
    };
    let (mut above, mut below) = (0.0, 1.0);
    let (mut high, mut low) = (coefficients[0], coefficients[3]);
    let mut last = f64::NAN;
    for _ in 0..CHORDS {
        let place = above + (below - above) * (high / (high - low));
        if !(place > above && place < below) || (place - last).abs() <= 0.25 * width {
            break;
        }
        let (value, was_above) = (at(place), last == above);
        if value >= 0.0 {
            // The end that stays twice counts half: it comes nearer then.
            low *= if was_above { 0.5 } else { 1.0 };
            (above, high) = (place, value);
        } else {
            high *= if last == below { 0.5 } else { 1.0 };
            (below, low) = (place, value);
        }
        last = place;
    }
    for place in [last - 0.5 * width, last + 0.5 * width] {
        if place > above && place < below {
            if at(place) >= 0.0 { above = place } else { below = place }
        }
    }
    while below - above > width {
        let middle = 0.5 * (above + below);
        if !(middle > above && middle < below) {
            break;
        }
        if at(middle) >= 0.0 { above = middle } else { below = middle }
    }
    above
}

/// Whether a volume keeps its sign in the step, by far: it differs from the straight line between its ends by
/// no more than ¼ |Q| + 0.39 |C| of the terms Q t² + C t³.
fn keeps_sign(old: [Vector; 3], new: [Vector; 3], [begin, end]: [f64; 2]) -> bool {
    let size = |v: Vector| v[0].abs() + v[1].abs() + v[2].abs();
    let ([u, v, w], [du, dv, dw]) = (old.map(size), [0, 1, 2].map(|k| size(minus(new[k], old[k]))));
    let bend = 0.25 * (u * dv * dw + v * du * dw + w * du * dv) + 0.39 * (du * dv * dw);
    let rounding = ROUNDING * ((u + du) * (v + dv) * (w + dw));
    begin * end > 0.0 && begin.abs().min(end.abs()) > 1.01 * bend + 4.0 * rounding
}

/// Times at which a node goes through a triangle: from its front (from where it is counter-clockwise) to its
/// back, and from its back to its front. One that begins on the triangle and goes behind it, or before it,
/// does so. `is_over` says whether a place in the triangle's plane is on it, or no farther beyond it than it
/// counts.
pub fn passages([from, to]: [Vector; 2], old: [Vector; 3], new: [Vector; 3], is_over: impl Fn(Vector, [Vector; 3]) -> bool) -> [Times; 2] {
    let sides = |x: Vector, [a, b, c]: [Vector; 3]| [minus(x, a), minus(b, a), minus(c, a)];
    let (before, after) = (sides(from, old), sides(to, new));
    let det = |[u, v, w]: [Vector; 3]| dot(u, cross(v, w));
    if keeps_sign(before, after, [det(before), det(after)]) {
        return [Times::default(); 2];
    }
    let (coefficients, rounding) = volume(before, after);
    [coefficients, coefficients.map(|c| -c)].map(|coefficients| {
        let mut times = Times::default();
        for time in falls(coefficients, rounding).iter() {
            let ([x], triangle) = (between([from], [to], time), between(old, new, time));
            if is_over(x, triangle) {
                times.add(time);
            }
        }
        times
    })
}

/// Times at which a node goes through a triangle from its front to its back.
#[must_use]
pub fn entries(path: [Vector; 2], old: [Vector; 3], new: [Vector; 3]) -> Times {
    passages(path, old, new, |x, triangle| (0..3).all(|side| is_beside(x, triangle, side)))[0]
}

/// Whether a place in the plane of a triangle is on that side of the line from its corner `side` to the next
/// one where the triangle is.
#[must_use]
pub fn is_beside(x: Vector, t: [Vector; 3], side: usize) -> bool {
    let normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    let share = dot(cross(minus(t[(side + 1) % 3], t[side]), minus(x, t[side])), normal);
    // Of a triangle without an area nothing can be said.
    !(share < -RIM * dot(normal, normal))
}

/// Times at which two edges go through each other so that the first, which was on the side to which first ×
/// second points, times `sign`, goes to the other; how far along either they meet.
pub fn crossings(sign: f64, [a_old, b_old]: [[Vector; 2]; 2], [a, b]: [[Vector; 2]; 2], mut meet: impl FnMut(f64, [f64; 2])) {
    let sides = |a: [Vector; 2], b: [Vector; 2]| [minus(a[0], b[0]).map(|c| sign * c), minus(a[1], a[0]), minus(b[1], b[0])];
    let (coefficients, rounding) = volume(sides(a_old, b_old), sides(a, b));
    for time in falls(coefficients, rounding).iter() {
        let (first, second) = (between(a_old, a, time), between(b_old, b, time));
        let (p, q, r) = (minus(first[1], first[0]), minus(second[1], second[0]), minus(first[0], second[0]));
        let (pp, qq, pq, pr, qr) = (dot(p, p), dot(q, q), dot(p, q), dot(p, r), dot(q, r));
        let across = pp * qq - pq * pq;
        let along = [(pq * qr - pr * qq) / across, (pp * qr - pq * pr) / across];
        if along.iter().all(|along| (-RIM..=1.0 + RIM).contains(along)) {
            meet(time, along);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vector> {
        prop::array::uniform3(-1.0..1.0_f64)
    }

    fn value([a, b, c, d]: [f64; 4], t: f64) -> f64 {
        let s = 1.0 - t;
        a * s * s * s + 3.0 * b * s * s * t + 3.0 * c * s * t * t + d * t * t * t
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn the_volume_is_that_of_the_places_between(old in prop::array::uniform3(vector()), new in prop::array::uniform3(vector()), t in 0.0..1.0_f64) {
            let [u, v, w] = between(old, new, t);
            prop_assert!((value(volume(old, new).0, t) - dot(u, cross(v, w))).abs() < 1e-14);
        }

        #[test]
        fn falls_are_where_samples_change_their_sign(c in prop::array::uniform4(-1.0..1.0_f64)) {
            let found: Vec<f64> = falls(c, 0.0).iter().collect();
            let count = 20_000;
            let times = (0..count).map(|k| [k, k + 1].map(|k| f64::from(k) / f64::from(count)));
            let sampled: Vec<[f64; 2]> = times.filter(|[from, to]| value(c, *from) >= 0.0 && value(c, *to) < 0.0).collect();
            // A fall and a rise between two samples are seen by the halves alone.
            prop_assert!(found.len() >= sampled.len(), "{found:?} {sampled:?}");
            for [from, to] in &sampled {
                prop_assert!(found.iter().any(|time| (from - 1e-9..=to + 1e-9).contains(time)));
            }
            for time in &found {
                prop_assert!(value(c, *time).abs() < 1e-12, "{time} {}", value(c, *time));
            }
        }

        /// A node that goes through a triangle at a chosen time, wherever all go before and after.
        #[test]
        fn who_goes_through_a_triangle_is_found(
            old in prop::array::uniform3(vector()), new in prop::array::uniform3(vector()), from in vector(),
            time in 0.02..0.98_f64, shares in prop::array::uniform3(0.02..1.0_f64),
        ) {
            let sum: f64 = shares.iter().sum();
            let middle = between(old, new, time);
            let place = [0, 1, 2].map(|d| (0..3).map(|k| shares[k] / sum * middle[k][d]).sum::<f64>());
            let to = [0, 1, 2].map(|d| (place[d] - (1.0 - time) * from[d]) / time);
            // Of both ways around the triangle one sees it come from the front, unless it turns back there.
            let turned = |[a, b, c]: [Vector; 3]| [a, c, b];
            let ways = [entries([from, to], old, new), entries([from, to], turned(old), turned(new))];
            let is_found = ways.iter().flat_map(Times::iter).any(|found| (found - time).abs() < 1e-6);
            let flat = { let [a, b, c] = middle; let n = cross(minus(b, a), minus(c, a)); dot(n, n) < 1e-6 };
            let sides = |x: Vector, [a, b, c]: [Vector; 3]| [minus(x, a), minus(b, a), minus(c, a)];
            let cubic = volume(sides(from, old), sides(to, new)).0;
            let is_grazing = value(cubic, time - 1e-4) * value(cubic, time + 1e-4) >= 0.0;
            prop_assert!(is_found || flat || is_grazing, "{ways:?} {time}");
        }

        /// Edges that go through each other at a chosen time.
        #[test]
        fn edges_that_go_through_each_other_are_found(
            a in prop::array::uniform2(vector()), b in prop::array::uniform2(vector()), a_old in prop::array::uniform2(vector()), b_old in prop::array::uniform2(vector()),
            time in 0.02..0.98_f64, along in prop::array::uniform2(0.02..0.98_f64),
        ) {
            // The second edge is moved along so that both meet then.
            let (first, second) = (between(a_old, a, time), between(b_old, b, time));
            let at = |[x, y]: [Vector; 2], s: f64| [0, 1, 2].map(|d| (1.0 - s) * x[d] + s * y[d]);
            let off = minus(at(first, along[0]), at(second, along[1]));
            let shift = |edge: [Vector; 2]| edge.map(|x| [0, 1, 2].map(|d| x[d] + off[d]));
            let (b, b_old) = (shift(b), shift(b_old));
            let mut found = Vec::new();
            for sign in [1.0, -1.0] {
                crossings(sign, [a_old, b_old], [a, b], |time, along| found.push((time, along)));
            }
            let is_met = |&(t, [s, u]): &(f64, [f64; 2])| (t - time).abs() < 1e-6 && (s - along[0]).abs() < 1e-3 && (u - along[1]).abs() < 1e-3;
            let sides = |a: [Vector; 2], b: [Vector; 2]| [minus(a[0], b[0]), minus(a[1], a[0]), minus(b[1], b[0])];
            let cubic = volume(sides(a_old, b_old), sides(a, b)).0;
            let is_grazing = value(cubic, time - 1e-4) * value(cubic, time + 1e-4) >= 0.0;
            prop_assert!(found.iter().any(is_met) || is_grazing, "{found:?} {time} {along:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

        /// What is not looked at for roots has none.
        #[test]
        fn a_volume_that_keeps_its_sign_has_no_root(
            old in prop::array::uniform3(vector()), ways in prop::array::uniform3(vector()), far in 0.0..2.0_f64,
        ) {
            let speed = 10f64.powf(-far);
            let new = [0, 1, 2].map(|k| [0, 1, 2].map(|d| old[k][d] + speed * ways[k][d]));
            let (cubic, rounding) = volume(old, new);
            if keeps_sign(old, new, [cubic[0], cubic[3]]) {
                let [c, turned] = [cubic, cubic.map(|c| -c)];
                prop_assert!(falls(c, rounding).count == 0 && falls(turned, rounding).count == 0, "{cubic:?}");
                prop_assert!((0..=100).all(|k| value(cubic, f64::from(k) / 100.0) * cubic[0] > 0.0));
            } else if speed < 0.02 && cubic.iter().all(|c| *c > 0.01) {
                prop_assert!(false, "it is hardly ever of use: {cubic:?}");
            }
        }
    }

    #[test]
    fn a_node_that_begins_on_a_triangle_goes_in_or_out() {
        let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let way = |z: f64| entries([[0.2, 0.3, 0.0], [0.2, 0.3, z]], flat, flat).iter().count();
        assert_eq!((way(-0.1), way(0.1), way(0.0)), (1, 0, 0));
        // Along a side, through a corner, and beside them.
        let down = |x: f64, y: f64| entries([[x, y, 0.5], [x, y, -0.5]], flat, flat).iter().count();
        assert_eq!((down(0.5, 0.5), down(0.0, 0.0), down(0.0, 0.7), down(-1e-6, 0.5), down(0.6, 0.6)), (1, 1, 1, 0, 0));
    }

    #[test]
    fn a_triangle_that_comes_turns_and_continues_is_gone_through() {
        // The node stays, the triangle flies over it in the step, and turns so that its volume falls, rises
        // and falls.
        let old = [[-1.0, -1.0, -3.0], [1.0, -1.0, -3.0], [0.0, 1.0, -3.0]];
        let new = old.map(|[x, y, _]| [x, y, 4.0]);
        let times: Vec<f64> = entries([[0.0; 3]; 2], old, new).iter().collect();
        assert!(times.len() == 1 && (times[0] - 3.0 / 7.0).abs() < 1e-12, "{times:?}");
    }
}
