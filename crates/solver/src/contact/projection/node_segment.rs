//! Node against segments in 2D: nearest feature, inside or outside, and the swept crossing of a
//! segment.
//!
//! Positions come from the step, candidates from the global search; projections go to the contact law. One
//! rule covers both corner cases of the paper (figures 4 and 5): the nearest feature of the target decides,
//! the inside of a segment or a node; the pseudo-normal of a node is the sum of its two segment normals.
//! Theory, sections 4.1 and 4.2.

use crate::archive::persist_all;
use crate::mesh::surface::{NONE, Sided, Surface};
use crate::vector::{bound, cross, dot, minus, plus, times};

/// A point or vector in 2D.
pub type Vector = [f64; 2];

/// A surface as a target: its segments, and what its ends know.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Target {
    /// The segments, body on the right.
    pub surface: Surface<2>,
    /// Normal of the symmetry line that the node of an open end lies on: (node, normal), by node. The
    /// mirrored half of the body continues there.
    pub mirrors: Vec<(u32, Vector)>,
}

impl Sided for Target {
    type Facet = [u32; 2];

    fn facets(&self) -> &[[u32; 2]] {
        &self.surface.segments
    }

    fn nodes(&self) -> &[u32] {
        &self.surface.nodes
    }
}

/// Where a node lies with respect to the nearest feature of a target.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Projection {
    /// Segment that the feature belongs to.
    pub segment: u32,
    /// Shares Φ₁, Φ₂ of the segment's nodes in the projected point, eqs. (5)-(7).
    pub weights: [f64; 2],
    /// Distance with sign, m: negative inside the target.
    pub gap: f64,
    /// Unit vector along which the slave node is pushed out.
    pub normal: Vector,
}

persist_all!(Projection { segment, weights, gap, normal });

/// Nodes that project beyond a segment's end by this fraction of its length still project on it. Two bars of
/// one height meet corner on corner: round-off must not decide whether they touch.
pub(in crate::contact) const END_TOLERANCE: f64 = 1e-6;
/// Round-off of f, and of the comparison with it, over lengths of both factors.
pub(in crate::contact) const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Off a node by this part of the distance, squared, the inside of a segment is nearer than the node whatever
/// rounds.
pub(in crate::contact) const CLEAR: f64 = 1e-6;
/// Two sides are equally near when their distances differ by less than this fraction.
const TIE: f64 = 1e-9;
/// Cosine of the angle between two segments from which on their common node is an edge, not a facet of
/// something round.
const EDGE: f64 = 0.5;
/// How far a face continues beyond a free end: this fraction of the length of its last segment, or of the
/// slave's segments where those are shorter.
pub const BAND: f64 = 0.025;

/// By how much a face that continues over a band of this width (m) has fallen at a distance `beyond` its end
/// (m): φ, m, and its slope.
///
/// It goes straight on over half of the band, bends down over the other half, and falls at 45 degrees from
/// there. What is flush but for half of the band feels no end at all; what leaves the face sideways slides
/// down the slope and gives the energy of its spring back as work, over a way that is as long as it was deep.
#[must_use]
pub fn fall_off(beyond: f64, band: f64) -> [f64; 2] {
    let half = 0.5 * band;
    let down = beyond - half;
    if down <= 0.0 {
        [0.0; 2]
    } else if down < half {
        [0.5 * down * down / half, down / half]
    } else {
        [down - 0.5 * half, 1.0]
    }
}

/// How a slave is held beyond the ends of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held {
    /// How far faces continue, m; 0: not at all.
    pub band: f64,
    /// Gap up to which it is held, m.
    pub gap: f64,
}

/// What a node has ahead of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    /// Segment that the nearest feature in front belongs to, and the projection on it: `None` where the
    /// surface is cut off there.
    pub first: Option<(u32, Option<Projection>)>,
    /// So far all candidates are away, in front or behind, m: until one of them is nearer nothing is touched
    /// or passed through. Minus infinity if one has no length.
    pub clear: f64,
}

/// A node as a segment's line sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Place along the segment; 0 and 1 are its nodes.
    pub place: f64,
    /// Distance from the line, m, positive on the outer side.
    pub gap: f64,
    /// Length of the segment, m.
    pub length: f64,
}

impl Seen {
    /// How far beyond an end it is, m; negative where it is not.
    #[must_use]
    pub fn beyond(&self) -> f64 {
        (-self.place).max(self.place - 1.0) * self.length
    }
}

impl Target {
    /// Projects `x` on segment `segment` or on the end that is nearest; `None` where the surface is cut off
    /// there, or the segment has no length.
    ///
    /// ε of eq. (8) is 2 s − 1 with s = (x − C₁)·T / |C₂ − C₁|.
    #[must_use]
    pub fn project(&self, x: Vector, segment: u32, positions: &[Vector]) -> Option<Projection> {
        self.feature(x, segment, positions)?.projection
    }

    /// Distance of `x` from segment `segment`, m; `None` where it has no length.
    #[must_use]
    pub fn distance(&self, x: Vector, segment: u32, positions: &[Vector]) -> Option<f64> {
        self.feature(x, segment, positions).map(|feature| feature.distance)
    }

    /// Distance of `x` from the line of segment `segment`, m, positive on the outer side; `None` where it has
    /// no length.
    #[must_use]
    pub fn side_of(&self, x: Vector, segment: u32, positions: &[Vector]) -> Option<f64> {
        let [c1, c2] = self.surface.segments[segment as usize].map(|node| positions[node as usize]);
        let t = minus(c2, c1);
        let length = dot(t, t).sqrt();
        (length > 0.0).then(|| cross(t, minus(x, c1)) / length)
    }

    /// Where `x` is as seen from the line of segment `segment`; `None` where it has no length.
    #[must_use]
    pub fn seen(&self, x: Vector, segment: u32, positions: &[Vector]) -> Option<Seen> {
        let [c1, c2] = self.surface.segments[segment as usize].map(|node| positions[node as usize]);
        let (t, r) = (minus(c2, c1), minus(x, c1));
        let square = dot(t, t);
        let length = square.sqrt();
        (length > 0.0).then(|| Seen { place: dot(r, t) / square, gap: cross(t, r) / length, length })
    }

    /// Whether a face ends where segment `segment` begins (`end` 0) or ends (1): the surface is cut off
    /// there, or continues around a sharp edge, away from the outside.
    #[must_use]
    pub fn is_free(&self, segment: u32, end: usize, positions: &[Vector]) -> bool {
        let neighbour = self.neighbour(segment, PLACES[end]);
        if neighbour == NONE {
            let node = self.surface.segments[segment as usize][end];
            return self.mirrors.binary_search_by_key(&node, |&(node, _)| node).is_err();
        }
        let [before, after] = if end == 0 { [neighbour, segment] } else { [segment, neighbour] };
        self.is_edge(before, after, positions) && cross(self.along(before, positions), self.along(after, positions)) <= 0.0
    }

    /// The projection on segment `segment` as it continues beyond a free end over a band of this width (m),
    /// see [`fall_off`]; `None` where `x` is not beyond such an end. Weights are those of the place on the
    /// segment's line, one of them negative; the gap is that of the line and what the face has fallen off.
    #[must_use]
    pub fn beyond(&self, x: Vector, segment: u32, band: f64, positions: &[Vector]) -> Option<Projection> {
        let seen = self.seen(x, segment, positions)?;
        let beyond = seen.beyond();
        if !(beyond > 0.0 && band > 0.0 && self.is_free(segment, usize::from(seen.place > 0.5), positions)) {
            return None;
        }
        let normal = outward(self.along(segment, positions), seen.length);
        Some(Projection { segment, weights: [1.0 - seen.place, seen.place], gap: seen.gap + fall_off(beyond, band)[0], normal })
    }

    /// From the beginning of a segment to its end, m.
    #[must_use]
    pub fn along(&self, segment: u32, positions: &[Vector]) -> Vector {
        let [a, b] = self.surface.segments[segment as usize].map(|node| positions[node as usize]);
        minus(b, a)
    }

    /// The nearest feature of a segment; `None` for a segment without length.
    fn feature(&self, x: Vector, segment: u32, positions: &[Vector]) -> Option<Feature> {
        let [n1, n2] = self.surface.segments[segment as usize];
        let (c1, c2) = (positions[n1 as usize], positions[n2 as usize]);
        let t = minus(c2, c1);
        let length_squared = dot(t, t);
        // NaN fails the comparison too
        if !(length_squared > 0.0) {
            return None;
        }
        let s = dot(minus(x, c1), t) / length_squared;
        let length = length_squared.sqrt();
        let normal = outward(t, length);
        if (-END_TOLERANCE..=1.0 + END_TOLERANCE).contains(&s) {
            // The sign is that of `crossing` at the beginning of the next step, to the last bit.
            let gap = cross(t, minus(x, c1)) / length;
            let projection = Some(Projection { segment, weights: [1.0 - s, s], gap, normal });
            return Some(Feature { segment, at: Place::Inside, distance: gap.abs(), length, projection });
        }
        let (node, end, weights, at) = if s < 0.0 { (n1, c1, [1.0, 0.0], Place::Begin) } else { (n2, c2, [0.0, 1.0], Place::End) };
        let away = minus(x, end);
        let distance = dot(away, away).sqrt();
        let cut_off = Feature { segment, at, distance, length, projection: None };
        let pseudo = match self.neighbour_normal(segment, at, positions) {
            Some(other) => plus(normal, other),
            None => match self.mirrors.binary_search_by_key(&node, |&(node, _)| node) {
                Ok(i) => {
                    let m = self.mirrors[i].1;
                    let along = dot(normal, m);
                    [normal[0] - along * m[0], normal[1] - along * m[1]]
                }
                Err(_) => return Some(cut_off),
            },
        };
        if distance == 0.0 {
            let projection = Some(Projection { segment, weights, gap: 0.0, normal: unit(pseudo, normal) });
            return Some(Feature { projection, ..cut_off });
        }
        let inside = dot(away, pseudo) < 0.0;
        let sign = if inside { -1.0 } else { 1.0 };
        let normal = [sign * away[0] / distance, sign * away[1] / distance];
        Some(Feature { projection: Some(Projection { segment, weights, gap: sign * distance, normal }), ..cut_off })
    }

    /// Normal of the segment that continues at an end, zero if that one has no length; `None` at an open end.
    fn neighbour_normal(&self, segment: u32, end: Place, positions: &[Vector]) -> Option<Vector> {
        let neighbour = self.neighbour(segment, end);
        let [a, b] = *self.surface.segments.get(neighbour as usize)?;
        let t = minus(positions[b as usize], positions[a as usize]);
        let length = dot(t, t).sqrt();
        Some(if length > 0.0 { outward(t, length) } else { [0.0, 0.0] })
    }

    fn neighbour(&self, segment: u32, end: Place) -> u32 {
        if end == Place::Begin { self.surface.previous[segment as usize] } else { self.surface.next[segment as usize] }
    }

    /// Nearest feature to `x` among those of `candidates` that `x` is in front of, or behind by no more than
    /// `rounding` (m): a node above a thin plate sees neither the plate's far side nor that of its own body.
    /// `None` where the nearest is an end at which the surface is cut off.
    #[must_use]
    pub fn ahead(&self, x: Vector, candidates: &[u32], rounding: f64, positions: &[Vector]) -> Option<Projection> {
        self.look_ahead(x, candidates, rounding, positions).first?.1
    }

    /// As [`Target::ahead`], with what the way to the nearest feature reports besides.
    #[must_use]
    pub fn look_ahead(&self, x: Vector, candidates: &[u32], rounding: f64, positions: &[Vector]) -> Ahead {
        let (mut first, mut clear) = (None, f64::INFINITY);
        for &segment in candidates {
            let Some(feature) = self.feature(x, segment, positions) else {
                clear = f64::NEG_INFINITY;
                continue;
            };
            clear = clear.min(feature.distance - 2.0 * END_TOLERANCE * feature.length);
            if feature.projection.is_none_or(|projection| projection.gap >= -rounding) {
                first = Some(first.map_or(feature, |best| nearer(best, feature)));
            }
        }
        Ahead { first: first.map(|feature| (feature.segment, feature.projection)), clear }
    }

    /// Nearest feature to `x` among `candidates`; of equally near ones the first. `None` where that is an end
    /// at which the surface is cut off.
    pub fn nearest(&self, x: Vector, candidates: &[u32], positions: &[Vector]) -> Option<Projection> {
        let nearest = candidates.iter().filter_map(|&segment| self.feature(x, segment, positions)).reduce(nearer)?;
        self.between_sides(x, nearest, NONE, positions, true)
    }

    /// Follows the chain from `start` to the nearest feature: the way to stay on the side of a thin body on
    /// which a node came in. `None` beyond an end at which the surface is cut off.
    ///
    /// Across a sharp edge the node stays with the face that it came in through as long as it projects on it:
    /// near an edge the other face is always near, and a bar that meets another end on would be pushed out
    /// sideways, with no force at all. On faceted curves the nearest decides.
    ///
    /// A neighbour counts with its own inside and the shared node. Its far end counts only when `x` is beyond
    /// the shared node: else a node deep below a thin body would be led around the body's edge to the far
    /// side.
    #[must_use]
    pub fn follow(&self, x: Vector, start: u32, positions: &[Vector]) -> Option<Projection> {
        self.follow_without(x, start, NONE, Held::default(), positions)
    }

    /// As [`Target::follow`], but the chain ends at the segments of node `own`: those of the slave itself, in
    /// a contact of a surface with itself. Beyond a free end the node stays with the face as
    /// [`Target::beyond`] and `held` say.
    #[must_use]
    pub fn follow_without(&self, x: Vector, start: u32, own: u32, held: Held, positions: &[Vector]) -> Option<Projection> {
        let mut best = self.feature(x, start, positions)?;
        for _ in 0..self.surface.segments.len() {
            let here = best;
            if here.at != Place::Inside
                && let Some(beyond) = self.beyond(x, here.segment, held.band, positions)
                && beyond.gap <= held.gap
            {
                return Some(beyond);
            }
            for end in PLACES {
                let neighbour = self.neighbour(here.segment, end);
                if !self.continues(neighbour, own) || self.is_left_behind(x, &here, neighbour, end, positions) {
                    continue;
                }
                if here.at == Place::Inside && self.is_edge(here.segment, neighbour, positions) {
                    continue;
                }
                let other = self.feature(x, neighbour, positions).filter(|other| other.at != end || here.at == end);
                best = other.map_or(best, |other| nearer(best, other));
            }
            if best.segment == here.segment {
                break;
            }
        }
        self.between_sides(x, best, own, positions, false)
    }

    /// Whether `x`, which projects on the inside of `here`, can't be nearer to the neighbour at its end
    /// `end`: it is beyond the common node as the neighbour sees it, so that node is what it would find
    /// there, and clearly off that node on `here`. This is so for nearly all nodes on nearly flat surfaces,
    /// and costs no root and no division.
    #[inline]
    fn is_left_behind(&self, x: Vector, here: &Feature, neighbour: u32, end: Place, positions: &[Vector]) -> bool {
        let Some(Projection { weights, gap, .. }) = here.projection.filter(|_| here.at == Place::Inside) else { return false };
        let [a, b] = self.surface.segments[neighbour as usize].map(|node| positions[node as usize]);
        let (along, weight) = (minus(b, a), weights[usize::from(end == Place::Begin)]);
        let (back, common) = if end == Place::Begin { (along, b) } else { (minus(a, b), a) };
        let (square, off) = (dot(along, along), weight * here.length);
        square > 0.0
            && dot(minus(x, common), back) > 2.0 * END_TOLERANCE * square
            && weight > END_TOLERANCE
            && off * off > CLEAR * gap * gap
    }

    /// Whether there is a segment, and not one of node `own`.
    fn continues(&self, segment: u32, own: u32) -> bool {
        segment != NONE && (own == NONE || !self.surface.segments[segment as usize].contains(&own))
    }

    /// The projection of a feature; of a node that is equally near to two sides, within
    /// rounding, that on their common node: what is symmetric stays so. Sides that meet at an edge count only
    /// with `over_edges`.
    fn between_sides(&self, x: Vector, feature: Feature, own: u32, positions: &[Vector], over_edges: bool) -> Option<Projection> {
        let projection = feature.projection?;
        if feature.at != Place::Inside || projection.gap >= 0.0 {
            return Some(projection);
        }
        for (end, weights, corner) in [(Place::Begin, [1.0, 0.0], 0), (Place::End, [0.0, 1.0], 1)] {
            let neighbour = self.neighbour(feature.segment, end);
            if !self.continues(neighbour, own) || self.is_left_behind(x, &feature, neighbour, end, positions) {
                continue;
            }
            if !over_edges && self.is_edge(feature.segment, neighbour, positions) {
                continue;
            }
            let other = self.feature(x, neighbour, positions).filter(|other| other.at == Place::Inside);
            let tie = other.is_some_and(|other| (other.distance - feature.distance).abs() <= TIE * feature.distance);
            if tie {
                let node = self.surface.segments[feature.segment as usize][corner];
                let out = minus(positions[node as usize], x);
                // The depth is that of the sides: it does not jump where a node slides over the ridge.
                return Some(Projection { weights, normal: unit(out, projection.normal), ..projection });
            }
        }
        Some(projection)
    }

    /// Whether two segments meet at a sharp angle.
    #[must_use]
    pub fn is_edge(&self, a: u32, b: u32, positions: &[Vector]) -> bool {
        let [ta, tb] = [a, b].map(|segment| self.along(segment, positions));
        dot(ta, tb) < EDGE * (dot(ta, ta) * dot(tb, tb)).sqrt()
    }

    /// Time (0 to 1) at which a node that moves from `x_old` to `x_new` goes through `segment` from the
    /// outside in; all paths straight.
    ///
    /// The side f = T × (x − C₁) is a quadratic in time; where it falls through zero, the node must lie
    /// between the segment's nodes.
    ///
    /// What holds, tested against whole numbers (`tests/all/swept.rs`):
    /// - A way in is found at any speed and thickness: over the segment or exactly over an end (then by both
    ///   neighbours whose side it changes), in for good or out again within the step, from a place on the
    ///   segment too. On it is outside, and f is zero or not by the very expression that gives
    ///   [`Target::project`] its sign.
    /// - Round-off hides none along a chain: anyone who is outside a closed chain before and inside it after
    ///   is reported by some segment (by its winding number), if the signs of both gaps say so too. Of a dip
    ///   under a single segment it hides what is no deeper than the rounding of f.
    /// - Nothing else is reported: no way out, no graze (f touches zero), no path along the segment, no
    ///   motion together with it, no segment that shrinks to a point elsewhere. Exceptions, all of which
    ///   [`Target::follow`] finds outside: beyond an end by a millionth of the length; over the end of a side
    ///   that the body does not go behind (a corner grazed); and, where rounding decides, who ends on the
    ///   segment or slides along it.
    #[must_use]
    pub fn crossing(&self, x_old: Vector, x_new: Vector, segment: u32, positions_old: &[Vector], positions_new: &[Vector]) -> Option<f64> {
        self.passage(x_old, x_new, segment, positions_old, positions_new)?.entered
    }

    /// What a node does to `segment` on its way from `x_old` to `x_new`; `None` where it stays on one side of
    /// the segment's line.
    #[inline]
    #[must_use]
    pub fn passage(
        &self,
        x_old: Vector,
        x_new: Vector,
        segment: u32,
        positions_old: &[Vector],
        positions_new: &[Vector],
    ) -> Option<Passage> {
        let [n1, n2] = self.surface.segments[segment as usize].map(|node| node as usize);
        let (e0, r0) = (minus(positions_old[n2], positions_old[n1]), minus(x_old, positions_old[n1]));
        let (e1, r1) = (minus(positions_new[n2], positions_new[n1]), minus(x_new, positions_new[n1]));
        let (de, dr) = (minus(e1, e0), minus(r1, r0));
        let (begin, end) = (cross(e0, r0), cross(e1, r1));
        let (b, a) = (cross(e0, dr) + cross(de, r0), cross(de, dr));
        let rounding = ROUNDING * (bound(e0) + bound(e1)) * (bound(r0) + bound(r1));
        // NaN fails the comparisons too
        if !(begin.abs() <= b.abs() + a.abs() + rounding && rounding < f64::INFINITY) {
            return None;
        }
        let seen = |x: Vector, positions: &[Vector]| [minus(positions[n1], x), minus(positions[n2], x)];
        let (before, after) = (seen(x_old, positions_old), seen(x_new, positions_new));
        let exits = net_exits(before, after);
        let changes = begin >= 0.0 && end < 0.0;
        // Along the segment, or together with it.
        if a == 0.0 && b == 0.0 && !changes {
            return Some(Passage { entered: None, exits });
        }
        // Time counts from that end of the step where f is smaller: tiny segments that a fast node hits late
        // are seen sharply.
        let (e, r, f, forth) = if end.abs() < begin.abs() { (e1, r1, end, -1.0) } else { (e0, r0, begin, 1.0) };
        let from_begin = |time: f64| if forth < 0.0 { 1.0 - time } else { time };
        // Down and up within the step, or up and down: where f has roots at all, they are in it, however they
        // round.
        let turn = -0.5 * b / a;
        let turns = turn > 0.0 && turn < 1.0 && (begin >= 0.0) == (a > 0.0) && (end >= 0.0) == (a > 0.0);
        // Who ends on it did not go in yet.
        let in_step = |&time: &f64| changes || turns || ((0.0..=1.0).contains(&time) && (forth > 0.0 || time > 0.0));
        let fall = fall(forth * a, cross(e, dr) + cross(de, r), forth * f, changes).filter(in_step).map(|time| time.clamp(0.0, 1.0));
        let between = |time: &f64| {
            let (e, r) = (plus(e, times(forth * time, de)), plus(r, times(forth * time, dr)));
            let (along, whole) = (dot(r, e), dot(e, e));
            // The last: a segment that shrinks to a point has no side then, and meets only who is there.
            whole > 0.0 && (-END_TOLERANCE * whole..=(1.0 + END_TOLERANCE) * whole).contains(&along) && dot(r, r) <= 2.0 * whole
        };
        let entered = match fall.filter(between) {
            Some(time) => Some(from_begin(time)),
            // Who begins on an end has f = 0 there to the last bit: no way in is hidden, and winding has no
            // meaning.
            None => (!before.contains(&[0.0; 2]) && exits < 0).then(|| fall.map_or(1.0, from_begin)),
        };
        Some(Passage { entered, exits })
    }

    /// Part of the winding number of `segment` around `x`, as [`Passage::exits`] counts it: summed over a
    /// closed surface it is minus the number of bodies that `x` is in.
    #[must_use]
    pub fn turn(x: Vector, segment: [u32; 2], positions: &[Vector]) -> i32 {
        let [a, b] = segment.map(|node| minus(positions[node as usize], x));
        side(a, b)
    }
}

/// What a node did to a segment in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// Time (0 to 1) at which it went in.
    pub entered: Option<f64>,
    /// How often it went out less how often it went in.
    pub exits: i32,
}

/// The nearest feature of one segment: its inside or an end.
#[derive(Clone, Copy)]
struct Feature {
    segment: u32,
    at: Place,
    distance: f64,
    /// Of the segment.
    length: f64,
    /// `None` beyond an end at which the surface is cut off.
    projection: Option<Projection>,
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    Begin,
    Inside,
    End,
}

/// Both ends of a segment.
const PLACES: [Place; 2] = [Place::Begin, Place::End];

/// How often a node goes out through a segment a → b (body on its right) less how often it goes in, in one
/// step. `seen` are a and b at the beginning and a and b at the end, as seen from the node.
///
/// This is the winding number of the loop a₀ → a₁ → b₁ → b₀ → a₀ around the node (the origin), counted by the
/// ray along +x. Neighbours share the way of their common node, with the same bits and opposite signs; so
/// along a chain nothing is lost or counted twice, however the products round: the sum over a closed chain is
/// exactly the change of the winding number of the chain.
fn net_exits([a0, b0]: [Vector; 2], [a1, b1]: [Vector; 2]) -> i32 {
    let way = |from: Vector, to: Vector| match (from[1] <= 0.0, to[1] <= 0.0) {
        (true, false) => i32::from(cross(from, to) > 0.0),
        (false, true) => -i32::from(cross(from, to) < 0.0),
        _ => 0,
    };
    way(a0, a1) + side(a1, b1) - way(b0, b1) - side(a0, b0)
}

/// How often the segment a → b goes through the ray along +x from the origin: 1 upwards, −1 downwards. A node
/// on the segment itself is outside, as its gap of zero says.
fn side(a: Vector, b: Vector) -> i32 {
    match (a[1] <= 0.0, b[1] <= 0.0) {
        (true, false) => i32::from(cross(a, b) >= 0.0),
        (false, true) => -i32::from(cross(a, b) < 0.0),
        _ => 0,
    }
}

/// Time at which a t² + b t + c falls through zero, or rests on it and then falls; without cancellation.
/// `certain`: it does so somewhere.
fn fall(a: f64, b: f64, c: f64, certain: bool) -> Option<f64> {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 && !certain {
        return None;
    }
    let root = discriminant.max(0.0).sqrt();
    let time = if b < 0.0 { 2.0 * c / (root - b) } else { -0.5 * (b + root) / a };
    // Who only touches zero from above does not fall.
    (time.is_finite() && (certain || root > 0.0 || a < 0.0)).then_some(time)
}

fn nearer(best: Feature, other: Feature) -> Feature {
    if other.distance < best.distance { other } else { best }
}

/// Outward normal of a segment with the body on its right: n = (−t₂, t₁).
fn outward(t: Vector, length: f64) -> Vector {
    [-t[1] / length, t[0] / length]
}

fn unit(v: Vector, otherwise: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    if length > 0.0 { [v[0] / length, v[1] / length] } else { otherwise }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Winding number of a lattice triangle around the origin; `None` when that lies on it.
    fn winding(triangle: &[[i32; 2]; 3]) -> Option<i32> {
        let turns: Vec<i32> = (0..3)
            .map(|i| {
                let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
                (a[0] * b[1] - a[1] * b[0]).signum()
            })
            .collect();
        let on = (0..3).any(|i| {
            let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
            turns[i] == 0 && a[0] * b[0] + a[1] * b[1] <= 0
        });
        (!on).then(|| if turns.iter().all(|&turn| turn == turns[0]) { turns[0] } else { 0 })
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn exits_through_the_sides_of_a_triangle_sum_up_to_the_change_of_its_winding(
            corners in prop::collection::vec(prop::array::uniform2(-5..=5_i32), 6),
        ) {
            let of = |i: usize| [corners[i], corners[i + 1], corners[i + 2]];
            if let (Some(before), Some(after)) = (winding(&of(0)), winding(&of(3))) {
                // Ways through the origin and sides along the ray are common here; the scale makes products
                // round.
                let real = |i: usize| corners[i].map(|c| f64::from(c) * 0.1);
                let sum: i32 = (0..3).map(|i| {
                    let j = (i + 1) % 3;
                    net_exits([real(i), real(j)], [real(3 + i), real(3 + j)])
                }).sum();
                prop_assert_eq!(sum, after - before, "{:?}", corners);
            }
        }
    }
}
