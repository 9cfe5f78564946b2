//! Where a body lies in itself: parts of its outline that are inside, and how deep.
//!
//! A body that comes to lie in itself cuts its own outline. The outline falls into parts between the cuts,
//! and the winding number just outside of a part says whether the body is there, too. Parts that are inside
//! and follow each other make a chain. Two chains bound an overlap, or the two flanks of a chain that run
//! against each other, and a place of one is as deep as the other one is far.

use super::{Outline, Side, between, pieces, square_to};
use crate::contact::Vector;
use crate::contact::findings::PLACES;
use crate::mesh::surface::NONE;
use crate::vector::{dot, minus};
use std::collections::BTreeMap;

/// A part of a segment that is inside the body, from a share of its way to another.
struct Part {
    side: Side,
    shares: [f64; 2],
    ends: [Vector; 2],
    chain: u32,
}

impl Outline {
    /// Shows places of the outline that are inside the body itself, with their segment, the square of their
    /// depth (m²) and the segment that is nearest.
    pub(in crate::contact) fn folds(&self, positions: &[Vector], mut see: impl FnMut(Vector, &Side, f64, &Side)) {
        let sides: Vec<&Side> = self.sides.iter().collect();
        let are_apart = |side: &Side, other: &Side| !other.segment.iter().any(|node| side.segment.contains(node));
        let (cuts, begin) = self.cuts(&sides, are_apart, positions);
        if cuts.is_empty() {
            return;
        }
        let own = begin.windows(2).map(|range| &cuts[range[0]..range[1]]);
        let parts = chained(self.sides.iter().zip(own).flat_map(|(side, own)| self.parts(side, own, positions)).collect());
        for part in &parts {
            let mut look = |x: Vector| {
                let others = parts.iter().filter(|other| other.chain != part.chain || is_facing(part.ends, other.ends));
                let away = |other: &Part| (square_to(x, other.ends), other.side);
                if let Some((square, nearest)) = others.map(away).reduce(|a, b| if b.0 < a.0 { b } else { a }) {
                    see(x, &part.side, square, &nearest);
                }
            };
            if part.shares[0] == 0.0 {
                look(part.ends[0]);
            }
            PLACES.into_iter().for_each(|share| look(between(part.ends, share)));
        }
    }

    /// The parts of a segment between its cuts that are inside.
    fn parts(&self, side: &Side, cuts: &[f64], positions: &[Vector]) -> Vec<Part> {
        if side.is_mirror {
            return Vec::new();
        }
        let ends = side.segment.map(|node| positions[node as usize]);
        let part = |shares: [f64; 2]| Part { side: *side, shares, ends: shares.map(|share| between(ends, share)), chain: NONE };
        pieces(cuts).map(part).filter(|part| self.is_within(between(part.ends, 0.5), side, positions)).collect()
    }

    /// Whether the body is just outside of a place on one of its segments, by the winding number there.
    fn is_within(&self, x: Vector, own: &Side, positions: &[Vector]) -> bool {
        let [a, b] = own.segment.map(|node| positions[node as usize]);
        // A ray along x across segments that run along y more than along x, and the other way round: that
        // turns the outline round.
        let is_turned = (b[1] - a[1]).abs() < (b[0] - a[0]).abs();
        let others = self.winding(x, is_turned, |side| side.segment != own.segment, positions);
        // The own segment counts as crossed if what is outside of it is before it.
        let axis = usize::from(!is_turned);
        let is_crossed = (b[axis] > a[axis]) != is_turned;
        let winding = others
            + if !is_crossed {
                0
            } else if b[axis] > x[axis] {
                1
            } else {
                -1
            };
        // The body is on the right of its segments.
        if is_turned { winding > 0 } else { winding < 0 }
    }
}

/// Numbers chains of parts that follow each other: each by its first part.
fn chained(mut parts: Vec<Part>) -> Vec<Part> {
    let mut before: BTreeMap<u32, usize> = BTreeMap::new();
    for (number, part) in parts.iter().enumerate() {
        if part.shares[1] == 1.0 {
            before.insert(part.side.segment[1], number);
        }
    }
    let parent: Vec<Option<usize>> =
        parts.iter().map(|part| if part.shares[0] == 0.0 { before.get(&part.side.segment[0]).copied() } else { None }).collect();
    for number in 0..parts.len() {
        let mut way = vec![number];
        let mut at = number;
        while parts[at].chain == NONE {
            match parent[at] {
                Some(next) if !way.contains(&next) => {
                    way.push(next);
                    at = next;
                }
                _ => break,
            }
        }
        let chain = if parts[at].chain == NONE { at as u32 } else { parts[at].chain };
        way.into_iter().for_each(|at| parts[at].chain = chain);
    }
    parts
}

/// Whether two pieces run against each other, to 60 degrees: those of one chain that do are the flanks of a
/// notch.
fn is_facing([a, b]: [Vector; 2], [c, d]: [Vector; 2]) -> bool {
    let (own, other) = (minus(b, a), minus(d, c));
    dot(own, other) < -0.5 * (dot(own, own) * dot(other, other)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::Outlines;
    use super::*;

    /// Deepest place and how many there are, of a closed way whose body is on its right.
    fn deepest(places: &[Vector]) -> (f64, usize) {
        let count = places.len() as u32;
        let segments: Vec<[u32; 2]> = (0..count).map(|k| [k, (k + 1) % count]).collect();
        let made = Outlines::new(&segments, |_| false, &vec![0; places.len()], places);
        let (mut deepest, mut found): (f64, usize) = (0.0, 0);
        made.bodies[0].folds(places, |_, _, square, _| (deepest, found) = (deepest.max(square.sqrt()), found + 1));
        (deepest, found)
    }

    fn moved(places: &[Vector], angle: f64, shift: f64) -> Vec<Vector> {
        let (sin, cos) = angle.sin_cos();
        places.iter().map(|&[x, y]| [cos * x - sin * y + shift, sin * x + cos * y - shift]).collect()
    }

    #[test]
    fn a_strip_that_is_bent_into_itself_is_as_deep_as_its_legs_overlap() {
        // A hook, clockwise: both legs are 1 wide, and a tooth of one goes into the other by `over` - 2.
        let hook = |over: f64| {
            let end = 3.0 - over;
            let outside = [[0.0, 0.0], [0.0, 2.0], [0.0, 6.0], [3.5, 6.0], [3.5, 0.5], [2.5, 0.5]];
            let inside = [[2.5, 1.0], [end, 1.0], [end, 2.0], [2.5, 2.0], [2.5, 5.0], [1.0, 5.0], [1.0, 0.0]];
            [&outside[..], &inside[..]].concat()
        };
        for (angle, shift) in [(0.0, 0.0), (0.4, 0.0), (2.0, 3.0), (-0.7, 1e3)] {
            for over in [0.0, 1.0, 1.9] {
                assert_eq!(deepest(&moved(&hook(over), angle, shift)), (0.0, 0), "{angle} {over}");
            }
            for over in [2.1, 2.4] {
                let (depth, count) = deepest(&moved(&hook(over), angle, shift));
                let expected = over - 2.0;
                assert!(count > 0 && (depth - expected).abs() < 1e-9 * (1.0 + shift), "{angle} {over}: {depth} {count}");
            }
        }
    }

    #[test]
    fn the_flanks_of_a_notch_that_is_closed_beyond_itself_are_in_each_other() {
        // A block with a notch from above; its flanks are straight and cross beside the root.
        let notch = |over: f64| {
            let (left, right) = (2.0 + 0.5 * over, 2.0 - 0.5 * over);
            vec![
                [0.0, 0.0],
                [0.0, 3.0],
                [left, 3.0],
                [left, 1.5],
                [1.9, 1.0],
                [2.1, 1.0],
                [right, 1.5],
                [right, 3.0],
                [4.0, 3.0],
                [4.0, 0.0],
            ]
        };
        for angle in [0.0, 0.7] {
            assert_eq!(deepest(&moved(&notch(-0.1), angle, 0.0)).1, 0);
            let (depth, count) = deepest(&moved(&notch(0.2), angle, 0.0));
            assert!(count > 0 && (depth - 0.2).abs() < 1e-9, "{angle}: {depth} {count}");
        }
    }

    #[test]
    fn a_corner_that_is_turned_inside_out_is_no_overlap() {
        let square = [[0.0, 0.0], [0.0, 1.0], [0.5, 1.0], [0.3, 1.2], [0.6, 1.2], [0.4, 1.0], [1.0, 1.0], [1.0, 0.0]];
        for angle in [0.0, 1.0, 2.5] {
            assert_eq!(deepest(&moved(&square, angle, 0.0)).1, 0, "{angle}");
        }
    }
}
