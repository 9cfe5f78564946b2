//! Nodes moved along the outline's normals until the region's measure is what it was. A node that would be
//! inside of what the body presses on is put outside of it and held there; the others make up for it.

use super::outline::{Chain, Line, halved};
use super::{KeptOut, Spot};
use crate::plane::{Measure, Point, cross, distance, dot, minus, on_line};

/// Farthest that a node is moved, by the length of the edges there.
const FARTHEST: f64 = 0.05;
/// Of it that much by what is foreseen, and bound of the factor for the place on the old edge.
const FORESEEN: f64 = 0.04;
const MOST: f64 = 1.5;
/// Steps of Newton.
const STEPS: usize = 6;
/// Times that a chain is refined.
const REFINED: usize = 4;
/// Corrections at most with ever more nodes that are held, and farthest that one of them is put from its old
/// edge, by the length of the edges there.
const PASSES: usize = 12;
const QUARTER: f64 = 0.25;
const THIRD_OF_PI: f64 = std::f64::consts::PI / 3.0;

/// A sum whose roundings are added up apart. Source: Neumaier, Z. angew. Math. Mech. 54 (1974) 39-51.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    pub(super) fn add(&mut self, x: f64) {
        let sum = self.sum + x;
        self.lost += if self.sum.abs() >= x.abs() { (self.sum - sum) + x } else { (x - sum) + self.sum };
        self.sum = sum;
    }

    pub(super) fn value(self) -> f64 {
        self.sum + self.lost
    }
}

/// What an edge contributes to the measure of what is on its left: ½ (a − o) × (b − o) for an area, and π/3
/// (a₀² + a₀b₀ + b₀²)(b₁ − a₁), which is π ∫ x² dy, for a volume of revolution, m² or m³.
pub(super) fn contribution(measure: Measure, a: Point, b: Point, o: Point) -> f64 {
    match measure {
        Measure::Plane => 0.5 * cross(minus(a, o), minus(b, o)),
        Measure::Revolution => THIRD_OF_PI * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) * (b[1] - a[1]),
    }
}

/// The measure of a region between closed lines that have it on their left, m² or m³.
pub(crate) fn measured(measure: Measure, polygons: &[Vec<Point>]) -> f64 {
    let mut sum = Sum::default();
    for polygon in polygons {
        let n = polygon.len();
        for k in 0..n {
            sum.add(contribution(measure, polygon[k], polygon[(k + 1) % n], polygon[0]));
        }
    }
    sum.value()
}

/// The measure along a line that isn't closed, seen from `o`.
fn along(measure: Measure, points: &[Point], o: Point) -> Sum {
    let mut sum = Sum::default();
    points.windows(2).for_each(|pair| sum.add(contribution(measure, pair[0], pair[1], o)));
    sum
}

/// How the measure changes as a node between `a` and `b` moves along `way`.
fn slope(measure: Measure, [a, x, b]: [Point; 3], way: Point) -> f64 {
    match measure {
        Measure::Plane => 0.5 * (way[0] * (b[1] - a[1]) - way[1] * (b[0] - a[0])),
        Measure::Revolution => {
            let radial = (a[0] + 2.0 * x[0]) * (x[1] - a[1]) + (b[0] + 2.0 * x[0]) * (b[1] - x[1]);
            let axial = (a[0] - b[0]) * (a[0] + b[0] + x[0]);
            THIRD_OF_PI * (way[0] * radial + way[1] * axial)
        }
    }
}

/// Nodes of each chain of each line.
type Nodes = Vec<Vec<Vec<Point>>>;

/// Nodes of all chains of each line, both ends of each chain included, such that the measure is that of the
/// old lines. With `halves` there is another node between each two places. Chains that turn too much for it
/// get more places. Nodes are where `kept_out` wants them, as far as the measure can be kept. `None` where it
/// can't.
pub(crate) fn corrected(lines: &mut [Line], measure: Measure, halves: bool, kept_out: KeptOut<'_>) -> Option<Nodes> {
    refine(lines, measure, halves);
    let (mut whole, mut rounding) = (0.0, 0.0);
    for line in &*lines {
        whole += measured(measure, std::slice::from_ref(&line.points));
        let farthest = line.points.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let around = if measure == Measure::Plane { 1.0 } else { 6.0 * THIRD_OF_PI * farthest };
        rounding += f64::EPSILON * farthest * line.arc[line.points.len()] * around;
    }
    let of = |(l, line): (usize, _)| pieces(l, line, measure, halves);
    let mut pieces: Vec<Vec<Piece>> = lines.iter().enumerate().map(of).collect();
    let is_kept = |rest: f64| rest.abs() <= 5e-14 * whole.abs() + rounding;
    let (nodes, rest) = placed(&pieces, whole);
    // Places on the old edges first: where these are inside of something, foreseen ways mean nothing.
    let from = pieces.iter().map(|pieces| pieces.iter().map(|piece| piece.from.clone()).collect()).collect();
    let mut is_held = hold(&mut pieces, &from, kept_out);
    is_held |= !is_held && hold(&mut pieces, &nodes, kept_out);
    let mut best = is_kept(rest).then_some(nodes);
    for _ in 0..PASSES {
        if !is_held {
            break;
        }
        let (nodes, rest) = placed(&pieces, whole);
        if !is_kept(rest) {
            break;
        }
        is_held = hold(&mut pieces, &nodes, kept_out);
        best = Some(nodes);
    }
    best
}

/// Gives chains that turn too much more places.
fn refine(lines: &mut [Line], measure: Measure, halves: bool) {
    for line in lines {
        for c in 0..line.chains.len() {
            for _ in 0..REFINED {
                if !Piece::new(0, line, &line.chains[c], measure, halves).moved(0.0).is_short {
                    break;
                }
                line.chains[c].halve();
            }
        }
    }
}

/// The chains of a line.
fn pieces(of_loop: usize, line: &Line, measure: Measure, halves: bool) -> Vec<Piece<'_>> {
    line.chains.iter().map(|chain| Piece::new(of_loop, line, chain, measure, halves)).collect()
}

/// Nodes of all chains with the measure of the old ones, and what it lacks still.
fn placed(pieces: &[Vec<Piece>], whole: f64) -> (Nodes, f64) {
    let mut left = Sum::default();
    let mut of = |piece: &Piece| {
        let moved = piece.moved(0.0);
        left.add(moved.rest);
        moved.nodes
    };
    let mut nodes: Nodes = pieces.iter().map(|pieces| pieces.iter().map(&mut of).collect()).collect();
    // What is left over, including rounding, goes to the first chains that can take it.
    let mut rest = left.value();
    for (piece, nodes) in pieces.iter().flatten().zip(nodes.iter_mut().flatten()) {
        if rest.abs() <= 1e-15 * whole.abs() || piece.is_still() {
            continue;
        }
        let moved = piece.moved(rest - piece.moved(0.0).rest);
        rest = moved.rest;
        *nodes = moved.nodes;
    }
    (nodes, rest)
}

/// Holds the nodes that may not be where they are, where they may be instead; whether there are any.
fn hold(pieces: &mut [Vec<Piece>], nodes: &Nodes, kept_out: KeptOut<'_>) -> bool {
    let mut any = false;
    for (piece, nodes) in pieces.iter_mut().flatten().zip(nodes.iter().flatten()) {
        any |= piece.hold(nodes, kept_out);
    }
    any
}

struct Moved {
    nodes: Vec<Point>,
    /// What the measure lacks still, be it by rounding alone.
    rest: f64,
    /// Whether that is for want of room.
    is_short: bool,
}

/// How far each free node should go along its way, by the length of the edges there. The vertices of a
/// polygon that has the area of a smooth curve are κh²/12 outside of it, κ being the curvature and h the
/// edges' length. A node at the fraction t of an old edge of length l, whose ends are so much outside, goes κ
/// (h² − l² + 6 l² t (1 − t)) / 12; so a line that is divided again and again keeps its form. Curvatures of
/// held nodes count for them alone.
fn foreseen(piece: &Piece) -> Vec<f64> {
    let (ways, count, is_closed) = (&piece.ways, piece.ways.len(), piece.chain.is_closed);
    let turn = |k: usize| {
        let [x, y, z] = piece.around(&piece.from, k);
        let (a, b) = (minus(y, x), minus(z, y));
        let turn = 2.0 * cross(a, b) / ((dot(a, a) * dot(b, b)).sqrt() + dot(a, b));
        if turn.is_finite() { turn } else { 0.0 }
    };
    let next = |i: usize| {
        if is_closed { [(i + count - 1) % count, (i + 1) % count] } else { [i.saturating_sub(1), (i + 1).min(count - 1)] }
    };
    let is_held = |i: usize| piece.held[i].is_some();
    let turns = beside(&piece.free().map(turn).collect::<Vec<_>>(), &is_held, &next);
    let of = |i: usize| {
        let turn = smoothed(&turns, i, &is_held, &next);
        let [length, t] = piece.line.edge(piece.places[piece.free().start + i]);
        let edge = dot(ways[i], ways[i]).sqrt();
        let old = if edge > 0.0 { length / edge * (length / edge) } else { 0.0 };
        let factor = (1.0 + old * (6.0 * t * (1.0 - t) - 1.0)).clamp(-MOST, MOST);
        (turn / 12.0 * factor).clamp(-FORESEEN, FORESEEN)
    };
    (0..count).map(of).collect()
}

/// Bends of a line that leaves what it is held by, where it may bend suddenly: free nodes there bend as the
/// free ones next to them.
fn beside(bends: &[f64], is_held: &dyn Fn(usize) -> bool, next: &dyn Fn(usize) -> [usize; 2]) -> Vec<f64> {
    let of = |k: usize| match next(k) {
        [before, after] if is_held(before) && !is_held(after) => bends[after],
        [before, after] if is_held(after) && !is_held(before) => bends[before],
        _ => bends[k],
    };
    (0..bends.len()).map(of).collect()
}

/// A mean of bends around a node, without those of held ones.
fn smoothed(bends: &[f64], k: usize, is_held: &dyn Fn(usize) -> bool, next: &dyn Fn(usize) -> [usize; 2]) -> f64 {
    let [before, after] = next(k).map(|other| bends[if is_held(other) { k } else { other }]);
    0.25 * (before + 2.0 * bends[k] + after)
}

/// The same where a chain's points were nodes, which may be spaced unevenly, as its new nodes. Points between
/// edges of lengths a and b are κ (a² − ab + b²)/12 outside of the curve: with half the sum of both edges
/// that is what the edges lack, κ a³/24 and κ b³/24. Curvatures are those of the old points; ends are on the
/// curve.
fn followed(piece: &Piece) -> Vec<f64> {
    let Piece { line, chain, old, from, ways, .. } = piece;
    let excess = |a: f64, b: f64| a * a - a * b + b * b;
    let last = old.len() - 1;
    let free = piece.free();
    // Of the old points: outside of the curve by κ/12, and curvature.
    let (mut outside, mut bends) = (vec![0.0; last + 1], vec![0.0; last + 1]);
    for k in free.start..last {
        let [x, y, z] = piece.around(old, k);
        let (p, q) = (minus(y, x), minus(z, y));
        let [a, b] = [distance(x, y), distance(y, z)];
        outside[k] = excess(a, b);
        bends[k] = 4.0 * cross(p, q) / ((a * b + dot(p, q)) * (a + b));
    }
    if chain.is_closed {
        (outside[last], bends[last]) = (outside[0], bends[0]);
    } else if last > 1 {
        (bends[0], bends[last]) = (bends[1], bends[last - 1]);
    }
    let next = |k: usize| match k {
        0 => [if chain.is_closed { last - 1 } else { 0 }, 1],
        k if k == last => [last - 1, if chain.is_closed { 1 } else { last }],
        k => [k - 1, k + 1],
    };
    // Each node slides near to the old point of its number.
    let held = |k: usize| (if chain.is_closed { k % last } else { k }).checked_sub(free.start).and_then(|i| piece.held.get(i));
    let is_held = |k: usize| held(k).is_some_and(Option::is_some);
    let bends = beside(&bends, &is_held, &next);
    let of = |i: usize| {
        let k = free.start + i;
        let (segment, t) = line.segment(chain.places[k]);
        // A closed chain is all of a line: its places may be a little before its first point.
        let s = (segment - chain.points[0]).min(last - 1);
        let t = t.clamp(0.0, 1.0);
        let between = |a: f64, b: f64| (1.0 - t) * a + t * b;
        let [x, y, z] = piece.around(from, k);
        let length = distance(old[s], old[s + 1]);
        let rise = excess(distance(x, y), distance(y, z)) - between(outside[s], outside[s + 1]) + 6.0 * length * length * t * (1.0 - t);
        let [one, other] = [s, s + 1].map(|k| smoothed(&bends, k, &is_held, &next));
        let bend = match [s, s + 1].map(is_held) {
            [true, false] => other,
            [false, true] => one,
            _ => between(one, other),
        };
        let by = bend / 12.0 * rise / dot(ways[i], ways[i]).sqrt();
        if by.is_finite() { by.clamp(-FORESEEN, FORESEEN) } else { 0.0 }
    };
    (0..ways.len()).map(of).collect()
}

/// A chain and its new nodes.
struct Piece<'a> {
    of_loop: usize,
    line: &'a Line,
    chain: &'a Chain,
    measure: Measure,
    old: Vec<Point>,
    /// Places of the nodes along the line.
    places: Vec<f64>,
    /// The nodes on the old line.
    from: Vec<Point>,
    /// Ways of all nodes but ends, out of the body and as long as the edges there.
    ways: Vec<Point>,
    /// How much of it each should go, and where it is held instead.
    first: Vec<f64>,
    held: Vec<Option<Point>>,
}

impl<'a> Piece<'a> {
    fn new(of_loop: usize, line: &'a Line, chain: &'a Chain, measure: Measure, halves: bool) -> Self {
        let n = line.points.len();
        let old: Vec<Point> = (chain.points[0]..=chain.points[1]).map(|k| line.points[k % n]).collect();
        let places = if halves { halved(&chain.places) } else { chain.places.clone() };
        let from: Vec<Point> = places.iter().map(|&place| line.at(place).0).collect();
        let mut piece = Self { of_loop, line, chain, measure, old, places, from, ways: Vec::new(), first: Vec::new(), held: Vec::new() };
        let way = |k: usize| {
            let [a, x, b] = piece.around(&piece.from, k);
            let (chord, length) = (minus(b, a), distance(a, b));
            let scale = 0.5 * (distance(a, x) + distance(x, b)) / length;
            if length > 0.0 { [scale * chord[1], -scale * chord[0]] } else { [0.0; 2] }
        };
        piece.ways = piece.free().map(way).collect();
        piece.held = vec![None; piece.ways.len()];
        piece.first = piece.foreseen();
        piece
    }

    /// How far each node should go.
    fn foreseen(&self) -> Vec<f64> {
        match (self.chain.is_straight, self.line.is_of_nodes) {
            (true, _) => vec![0.0; self.ways.len()],
            (_, true) => followed(self),
            (_, false) => foreseen(self),
        }
    }

    /// Its nodes but ends; in a closed chain the last node is the first.
    fn free(&self) -> std::ops::Range<usize> {
        usize::from(!self.chain.is_closed)..self.from.len() - 1
    }

    /// A node between its neighbours.
    fn around(&self, nodes: &[Point], k: usize) -> [Point; 3] {
        [nodes[if k == 0 { nodes.len() - 2 } else { k - 1 }], nodes[k], nodes[k + 1]]
    }

    /// Whether its nodes stay on a straight line.
    fn is_still(&self) -> bool {
        self.chain.is_straight && self.held.iter().all(Option::is_none)
    }

    /// The nodes, those that are not held so much farther along their ways than is foreseen.
    fn at(&self, by: f64) -> Vec<Point> {
        let mut nodes = self.from.clone();
        for (i, k) in self.free().enumerate() {
            let (first, way) = (self.first[i], self.ways[i]);
            let moved = [self.from[k][0] + (first + by) * way[0], self.from[k][1] + (first + by) * way[1]];
            nodes[k] = self.held[i].unwrap_or(moved);
        }
        if self.chain.is_closed {
            nodes[self.from.len() - 1] = nodes[0];
        }
        nodes
    }

    /// The nodes with the old chain's measure and `more`, as far as they can have it.
    fn moved(&self, more: f64) -> Moved {
        if self.is_still() {
            return Moved { nodes: self.from.clone(), rest: 0.0, is_short: false };
        }
        let (measure, o) = (self.measure, self.old[0]);
        let wanted = along(measure, &self.old, o);
        let missing = |nodes: &[Point]| {
            let mut sum = wanted;
            sum.add(more);
            nodes.windows(2).for_each(|pair| sum.add(-contribution(measure, pair[0], pair[1], o)));
            sum.value()
        };
        let mut by = 0.0;
        for _ in 0..STEPS {
            let nodes = self.at(by);
            let moving = self.free().enumerate().filter(|&(i, _)| self.held[i].is_none());
            let slope: f64 = moving.map(|(i, k)| slope(measure, self.around(&nodes, k), self.ways[i])).sum();
            let step = missing(&nodes) / slope;
            if !step.is_finite() {
                break;
            }
            by += step;
        }
        let moving = self.first.iter().zip(&self.held).filter(|(_, held)| held.is_none());
        let most = FARTHEST - moving.fold(0.0_f64, |most, (by, _)| most.max(by.abs()));
        let room = if by.is_finite() { by.clamp(-most, most) } else { 0.0 };
        let nodes = self.at(room);
        let rest = missing(&nodes);
        Moved { nodes, rest, is_short: room != by || self.ways.is_empty() }
    }

    /// Holds the nodes that `kept_out` wants elsewhere than in `nodes`; whether there are any. On a straight
    /// line nodes at points of it stay as they are.
    fn hold(&mut self, nodes: &[Point], kept_out: KeptOut<'_>) -> bool {
        let is_at_point = |k: usize| self.chain.is_straight && self.line.segment(self.places[k]).1 == 0.0;
        let mut held = self.held.clone();
        for (i, k) in self.free().enumerate().filter(|&(i, k)| self.held[i].is_none() && !is_at_point(k)) {
            held[i] = self.outside(i, k, nodes[k], kept_out);
        }
        if held == self.held {
            return false;
        }
        self.free().enumerate().filter(|&(_, k)| is_at_point(k)).for_each(|(i, k)| held[i] = Some(self.from[k]));
        self.held = held;
        self.first = self.foreseen();
        true
    }

    /// Where a node at `x` has to be instead, not too far from the old edge.
    fn outside(&self, i: usize, k: usize, x: Point, kept_out: KeptOut<'_>) -> Option<Point> {
        let from = self.from[k];
        if self.measure == Measure::Revolution && from[0] == 0.0 {
            return None;
        }
        let (_, segment, fraction) = self.line.at(self.places[k]);
        let to = kept_out(Spot { of_loop: self.of_loop, segment, fraction, place: x })?;
        let (far, most) = (distance(from, to), QUARTER * dot(self.ways[i], self.ways[i]).sqrt());
        let to = if far > most { on_line(from, to, most / far) } else { to };
        let is_place = to.iter().all(|x| x.is_finite()) && (self.measure == Measure::Plane || to[0] > 0.0);
        is_place.then_some(to)
    }
}
