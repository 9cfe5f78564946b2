//! Where a body lies in itself: parts of its outline that are inside, and how deep.
//!
//! A body that comes to lie in itself cuts its own outline. The outline falls into parts between the cuts, and the winding number just outside
//! of a part says whether the body is there, too. Parts that are inside and follow each other make a chain. Two chains bound an overlap, or
//! the two flanks of a chain that run against each other, and a place of one is as deep as the other one is far.

use super::{Outline, PLACES, Side, turn};
use crate::contact::Vector;
use crate::contact::boxes::{around, do_meet};
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
    /// Shows places of the outline that are inside the body itself, with their segment, the square of their depth (m²) and the segment that
    /// is nearest.
    pub(in crate::contact) fn folds(&self, positions: &[Vector], mut see: impl FnMut(Vector, &Side, f64, &Side)) {
        let cuts = self.cuts(positions);
        if cuts.is_empty() {
            return;
        }
        let parts = chained(self.parts(&cuts, positions));
        for part in &parts {
            let mut look = |x: Vector| {
                let others = parts.iter().filter(|other| other.chain != part.chain || is_facing(part.ends, other.ends));
                let away = |other: &Part| (square_away_from(x, other.ends), other.side);
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

    /// Where segments are cut by others that are no neighbours: the number of the segment, and the share of its way; ascending.
    fn cuts(&self, positions: &[Vector]) -> Vec<(usize, f64)> {
        let mut cuts = Vec::new();
        for (number, side) in self.sides.iter().enumerate() {
            let [p, q] = side.segment.map(|node| positions[node as usize]);
            let way = around([p, q]);
            self.visit(
                |around| do_meet(around, &way),
                |other| {
                    if other.segment.iter().any(|node| side.segment.contains(node)) {
                        return;
                    }
                    let [a, b] = other.segment.map(|node| positions[node as usize]);
                    let (from, to) = (turn(a, b, p), turn(a, b, q));
                    if (from > 0.0) != (to > 0.0) && (turn(p, q, a) > 0.0) != (turn(p, q, b) > 0.0) {
                        cuts.push((number, from / (from - to)));
                    }
                },
            );
        }
        cuts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        cuts
    }

    /// The parts of segments that are inside.
    fn parts(&self, cuts: &[(usize, f64)], positions: &[Vector]) -> Vec<Part> {
        let mut parts = Vec::new();
        let mut rest = cuts;
        for (number, &side) in self.sides.iter().enumerate() {
            let (own, others) = rest.split_at(rest.iter().take_while(|cut| cut.0 == number).count());
            rest = others;
            if side.is_mirror {
                continue;
            }
            let ends = side.segment.map(|node| positions[node as usize]);
            for k in 0..=own.len() {
                let shares = [if k == 0 { 0.0 } else { own[k - 1].1 }, own.get(k).map_or(1.0, |cut| cut.1)];
                let ends = shares.map(|share| between(ends, share));
                if self.is_within(between(ends, 0.5), &side, positions) {
                    parts.push(Part { side, shares, ends, chain: NONE });
                }
            }
        }
        parts
    }

    /// Whether the body is just outside of a place on one of its segments, by the winding number there.
    fn is_within(&self, x: Vector, own: &Side, positions: &[Vector]) -> bool {
        let [a, b] = own.segment.map(|node| positions[node as usize]);
        // A ray along x across segments that run along y more than along x, and the other way round: that turns the outline round.
        let is_turned = (b[1] - a[1]).abs() < (b[0] - a[0]).abs();
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
                if side.segment == own.segment {
                    // Counts as crossed if what is outside of it is before it.
                    winding += if (b[1] > a[1]) != is_turned { if rises { 1 } else { -1 } } else { 0 };
                } else if (a[1] > x[1]) != rises && (turn(a, b, x) > 0.0) == rises {
                    winding += if rises { 1 } else { -1 };
                }
            },
        );
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

/// Whether two pieces run against each other, to 60 degrees: those of one chain that do are the flanks of a notch.
fn is_facing([a, b]: [Vector; 2], [c, d]: [Vector; 2]) -> bool {
    let (own, other) = (minus(b, a), minus(d, c));
    dot(own, other) < -0.5 * (dot(own, own) * dot(other, other)).sqrt()
}

fn between([p, q]: [Vector; 2], share: f64) -> Vector {
    [0, 1].map(|d| (1.0 - share) * p[d] + share * q[d])
}

/// Square of the distance of a place from a piece, m².
fn square_away_from(x: Vector, [p, q]: [Vector; 2]) -> f64 {
    let (along, off) = (minus(q, p), minus(x, p));
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(off, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let away = [0, 1].map(|d| off[d] - share * along[d]);
    dot(away, away)
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
