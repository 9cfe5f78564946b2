//! Nodes moved along the outline's normals until the region's measure is what it was.

use super::outline::{Chain, Line, halved};
use crate::plane::{Measure, Point, cross, distance, dot, minus};

/// Farthest that a node is moved, by the length of the edges there.
const FARTHEST: f64 = 0.05;
/// Of it that much by what is foreseen, and bound of the factor for the place on the old edge.
const FORESEEN: f64 = 0.04;
const MOST: f64 = 1.5;
/// Steps of Newton.
const STEPS: usize = 6;
/// Times that a chain is refined.
const REFINED: usize = 4;
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
pub(super) fn measured(measure: Measure, polygons: &[Vec<Point>]) -> f64 {
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

/// Nodes of all chains of each line, both ends of each chain included, such that the measure is that of the
/// old lines. With `halves` there is another node between each two places. Chains that turn too much for it
/// get more places. `None` where it can't be done.
pub(super) fn corrected(lines: &mut [Line], measure: Measure, halves: bool) -> Option<Vec<Vec<Vec<Point>>>> {
    let mut nodes: Vec<Vec<Vec<Point>>> = Vec::new();
    let mut left = Sum::default();
    let (mut whole, mut rounding) = (0.0, 0.0);
    for line in lines.iter_mut() {
        let points = line.points.clone();
        let n = points.len();
        whole += measured(measure, std::slice::from_ref(&points));
        let farthest = points.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let around = if measure == Measure::Plane { 1.0 } else { 6.0 * THIRD_OF_PI * farthest };
        rounding += f64::EPSILON * farthest * line.arc[n] * around;
        let mut of_line = Vec::new();
        for c in 0..line.chains.len() {
            let old: Vec<Point> = (line.chains[c].points[0]..=line.chains[c].points[1]).map(|k| points[k % n]).collect();
            for round in 0.. {
                let moved = moved(line, &line.chains[c], &old, measure, halves, 0.0);
                if !moved.is_short || round == REFINED {
                    left.add(moved.rest);
                    of_line.push(moved.nodes);
                    break;
                }
                line.chains[c].halve();
            }
        }
        nodes.push(of_line);
    }
    // What is left over, including rounding, goes to the first chains that can take it.
    let mut rest = left.value();
    for (line, nodes) in lines.iter().zip(&mut nodes) {
        let n = line.points.len();
        for (chain, nodes) in line.chains.iter().zip(nodes) {
            if rest.abs() <= 1e-15 * whole.abs() || chain.is_straight {
                continue;
            }
            let old: Vec<Point> = (chain.points[0]..=chain.points[1]).map(|k| line.points[k % n]).collect();
            let before = moved(line, chain, &old, measure, halves, 0.0).rest;
            let moved = moved(line, chain, &old, measure, halves, rest - before);
            rest = moved.rest;
            *nodes = moved.nodes;
        }
    }
    (rest.abs() <= 5e-14 * whole.abs() + rounding).then_some(nodes)
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
/// (h² − l² + 6 l² t (1 − t)) / 12; so a line that is divided again and again keeps its form.
fn foreseen(line: &Line, places: &[f64], from: &[Point], is_closed: bool, ways: &[Point]) -> Vec<f64> {
    let count = ways.len();
    let last = from.len() - 1;
    let first = usize::from(!is_closed);
    let turn = |k: usize| {
        let before = if k == 0 { last - 1 } else { k - 1 };
        let (a, b) = (minus(from[k], from[before]), minus(from[k + 1], from[k]));
        let turn = 2.0 * cross(a, b) / ((dot(a, a) * dot(b, b)).sqrt() + dot(a, b));
        if turn.is_finite() { turn } else { 0.0 }
    };
    let turns: Vec<f64> = (0..count).map(|i| turn(first + i)).collect();
    let of = |i: usize| {
        let [before, after] =
            if is_closed { [(i + count - 1) % count, (i + 1) % count] } else { [i.saturating_sub(1), (i + 1).min(count - 1)] };
        let turn = 0.25 * (turns[before] + 2.0 * turns[i] + turns[after]);
        let [length, t] = line.edge(places[first + i]);
        let edge = dot(ways[i], ways[i]).sqrt();
        let old = if edge > 0.0 { length / edge * (length / edge) } else { 0.0 };
        let factor = (1.0 + old * (6.0 * t * (1.0 - t) - 1.0)).clamp(-MOST, MOST);
        (turn / 12.0 * factor).clamp(-FORESEEN, FORESEEN)
    };
    (0..count).map(of).collect()
}

/// Nodes of one chain with the old chain's measure and `more`, as far as they can have it.
fn moved(line: &Line, chain: &Chain, old: &[Point], measure: Measure, halves: bool, more: f64) -> Moved {
    let places = if halves { halved(&chain.places) } else { chain.places.clone() };
    let from: Vec<Point> = places.iter().map(|&place| line.at(place).0).collect();
    let last = from.len() - 1;
    if chain.is_straight {
        return Moved { nodes: from, rest: 0.0, is_short: false };
    }
    let o = old[0];
    // Neighbours of a node; in a closed chain the last node is the first.
    let between = |nodes: &[Point], k: usize| match k {
        0 => [nodes[last - 1], nodes[0], nodes[1]],
        k => [nodes[k - 1], nodes[k], nodes[k + 1]],
    };
    let free = if chain.is_closed { 0..last } else { 1..last };
    let ways: Vec<Point> = free
        .clone()
        .map(|k| {
            let [a, x, b] = between(&from, k);
            let (chord, length) = (minus(b, a), distance(a, b));
            let scale = 0.5 * (distance(a, x) + distance(x, b)) / length;
            if length > 0.0 { [scale * chord[1], -scale * chord[0]] } else { [0.0; 2] }
        })
        .collect();
    let first = foreseen(line, &places, &from, chain.is_closed, &ways);
    let farthest = first.iter().fold(0.0_f64, |most, by| most.max(by.abs()));
    let place = |by: f64| {
        let mut nodes = from.clone();
        for ((k, way), first) in free.clone().zip(&ways).zip(&first) {
            nodes[k] = [from[k][0] + (first + by) * way[0], from[k][1] + (first + by) * way[1]];
        }
        if chain.is_closed {
            nodes[last] = nodes[0];
        }
        nodes
    };
    let wanted = along(measure, old, o);
    let missing = |nodes: &[Point]| {
        let mut sum = wanted;
        sum.add(more);
        nodes.windows(2).for_each(|pair| sum.add(-contribution(measure, pair[0], pair[1], o)));
        sum.value()
    };
    let mut by = 0.0;
    for _ in 0..STEPS {
        let nodes = place(by);
        let slope: f64 = free.clone().zip(&ways).map(|(k, &way)| slope(measure, between(&nodes, k), way)).sum();
        let step = missing(&nodes) / slope;
        if !step.is_finite() {
            break;
        }
        by += step;
    }
    let most = FARTHEST - farthest;
    let room = if by.is_finite() { by.clamp(-most, most) } else { 0.0 };
    let nodes = place(room);
    let rest = missing(&nodes);
    Moved { nodes, rest, is_short: room != by || ways.is_empty() }
}
