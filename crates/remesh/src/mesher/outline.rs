//! An outline as chains between nodes that stay, and how long the edges along it should be.

use super::{Failure, OnOutline, Outline};
use crate::plane::{Point, cross, distance, dot, minus, on_line};

/// Cosine of the turn, 30 degrees, above which a point stays a node.
const CORNER: f64 = 0.866_025_403_784_438_6;
/// Most that a chain should turn along one edge, 20 degrees.
const TURN: f64 = 0.349_065_850_398_865_9;
/// Edges are shortened for a turn to no less than this part of the wanted size.
const SHORTEST: f64 = 0.125;
/// Growth of the edges' length by distance along the outline.
const GROWTH: f64 = 0.25;
/// A turn that is none, besides that of rounding.
const STRAIGHT: f64 = 1e-9;
/// Straight lines of so many edges keep their ends.
const KEPT: f64 = 1.5;
/// Parts of an edge between two places where the size is asked for.
const PARTS: f64 = 4.0;

/// A closed line without points that coincide; it begins at a point that stays, where one does.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) points: Vec<Point>,
    /// The old segment that begins at each point.
    pub(crate) segments: Vec<u32>,
    /// Length of the line up to each point, and in all.
    pub(crate) arc: Vec<f64>,
    pub(crate) chains: Vec<Chain>,
    /// Whether its points are the nodes, which only slide.
    pub(super) is_of_nodes: bool,
}

/// A piece of a line between two points that stay, or all of a line without one.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// From this point to that, the last of a line being its first again.
    pub(crate) points: [usize; 2],
    pub(crate) is_straight: bool,
    pub(crate) is_closed: bool,
    /// Places of its nodes along the line, both ends included.
    pub(crate) places: Vec<f64>,
}

/// The lines of an outline, with places of nodes between which there will be `per` edges; `limit` on each
/// chain at most.
pub(super) fn lines(outline: &Outline, size: &dyn Fn(Point) -> f64, per: f64, limit: usize) -> Result<Vec<Line>, Failure> {
    let near = near(outline)?;
    outline.loops.iter().zip(&outline.fixed).map(|(points, fixed)| Line::new(points, fixed, size, near, per, limit)).collect()
}

/// The lines of an outline whose points are the nodes. Straight lines of two edges or more keep their ends,
/// and a chain is straight where its points are no farther from its chord than rounding puts them.
pub(crate) fn of_nodes(outline: &Outline) -> Result<Vec<Line>, Failure> {
    let near = near(outline)?;
    let of = |(points, fixed): (&Vec<Point>, &Vec<bool>)| {
        let (mut line, _, _) = Line::divided(points, fixed, near, &|_, edges| Ok(edges > 1))?;
        let n = line.points.len();
        if n != points.len() {
            return Err(Failure::Outline("two nodes are in one place"));
        }
        line.is_of_nodes = true;
        for chain in &mut line.chains {
            let [from, to] = chain.points;
            chain.places = line.arc[from..=to].to_vec();
            let (a, b) = (line.points[from], line.points[to % n]);
            let off = |x: &Point| cross(minus(b, a), minus(*x, a)).abs();
            chain.is_straight &= line.points[from + 1..to].iter().all(|x| off(x) <= near * distance(a, b));
        }
        Ok(line)
    };
    outline.loops.iter().zip(&outline.fixed).map(of).collect()
}

/// The distance below which points of an outline are one.
fn near(outline: &Outline) -> Result<f64, Failure> {
    if outline.loops.is_empty() || outline.loops.len() != outline.fixed.len() {
        return Err(Failure::Outline("there are not as many lists of fixed points as loops, or none"));
    }
    let all = || outline.loops.iter().flatten();
    if !all().flatten().all(|x| x.is_finite()) {
        return Err(Failure::Outline("a coordinate is not a number"));
    }
    let [low, high] = all().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], x| {
        [[low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])]]
    });
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    let farthest = [low, high].as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if !(extent > 1e-60 && farthest < 1e60 && extent > 1e-9 * farthest) {
        return Err(Failure::Outline("it is too small or too large, or too far from the origin, for its coordinates"));
    }
    Ok(8.0 * f64::EPSILON * farthest)
}

impl Line {
    fn new(points: &[Point], fixed: &[bool], size: &dyn Fn(Point) -> f64, near: f64, per: f64, limit: usize) -> Result<Self, Failure> {
        let is_long = |[a, b]: [Point; 2], _: usize| Ok(distance(a, b) >= KEPT * checked(size, on_line(a, b, 0.5))?);
        let (mut line, turns, start) = Self::divided(points, fixed, near, &is_long)?;
        let stations = line.stations(&turns, start, size, per, limit)?;
        line.place(&stations, per, limit)?;
        Ok(line)
    }

    /// The line with its chains, which have no nodes but their ends, how much it turns at each point, and the
    /// point that it begins at. A straight line keeps its ends if that is wanted for it, given where they are
    /// and the number of its edges.
    fn divided(
        points: &[Point],
        fixed: &[bool],
        near: f64,
        is_long: &dyn Fn([Point; 2], usize) -> Result<bool, Failure>,
    ) -> Result<(Self, Vec<f64>, usize), Failure> {
        if points.len() != fixed.len() {
            return Err(Failure::Outline("a loop has not as many flags of fixed points as points"));
        }
        let mut kept: Vec<(Point, bool, u32)> = Vec::new();
        for ((&x, &fixed), k) in points.iter().zip(fixed).zip(0_u32..) {
            match kept.last_mut().filter(|last| distance(last.0, x) <= near) {
                Some(last) if last.1 && fixed && last.0 != x => {
                    return Err(Failure::Outline("two fixed points are too near to each other"));
                }
                Some(last) => *last = (if last.1 { last.0 } else { x }, last.1 || fixed, k),
                None => kept.push((x, fixed, k)),
            }
        }
        while kept.len() > 1 && distance(kept[kept.len() - 1].0, kept[0].0) <= near {
            let last = kept.pop().unwrap_or(kept[0]);
            if last.1 && kept[0].1 && last.0 != kept[0].0 {
                return Err(Failure::Outline("two fixed points are too near to each other"));
            }
            if last.1 && !kept[0].1 {
                kept[0] = (last.0, true, kept[0].2);
            }
        }
        let n = kept.len();
        if n < 3 {
            return Err(Failure::Outline("a loop has fewer than three points"));
        }
        let edge = |k: usize| minus(kept[(k + 1) % n].0, kept[k % n].0);
        let length = |k: usize| dot(edge(k), edge(k)).sqrt();
        // Turns, as 2 tan(θ/2), which is nearly the angle where a point need not stay.
        let turn = |k: usize| {
            let (a, b) = (edge(k + n - 1), edge(k));
            let (sine, product) = (cross(a, b), length(k + n - 1) * length(k));
            let rounding = near * (length(k + n - 1) + length(k)) / product;
            if sine.abs() <= (STRAIGHT + rounding) * product { 0.0 } else { 2.0 * sine / (product + dot(a, b)) }
        };
        let turns: Vec<f64> = (0..n).map(turn).collect();
        let is_on_axis = |k: usize| kept[k % n].0[0] == 0.0 && kept[(k + 1) % n].0[0] == 0.0;
        let is_corner = |k: usize| {
            let (a, b) = (edge(k + n - 1), edge(k));
            dot(a, b) < CORNER * length(k + n - 1) * length(k) || is_on_axis(k) != is_on_axis(k + n - 1)
        };
        let mut stays: Vec<bool> = (0..n).map(|k| kept[k].1 || is_corner(k)).collect();
        // Ends of straight lines stay too.
        let bends: Vec<usize> = (0..n).filter(|&k| stays[k] || turns[k] != 0.0).collect();
        for (i, &from) in bends.iter().enumerate() {
            let to = if i + 1 < bends.len() { bends[i + 1] } else { bends[0] + n };
            let (a, b) = (kept[from].0, kept[to % n].0);
            if is_long([a, b], to - from)? {
                (stays[from], stays[to % n]) = (true, true);
            }
        }
        let first = stays.iter().position(|&stays| stays);
        let start = first.unwrap_or(0);
        let turned = |k: usize| (k + start) % n;
        let mut arc = vec![0.0];
        for k in 0..n {
            arc.push(arc[k] + length(turned(k)));
        }
        let mut ends: Vec<usize> = (0..n).filter(|&k| stays[turned(k)] || k == 0).collect();
        ends.push(n);
        let chain = |pair: &[usize]| Chain {
            points: [pair[0], pair[1]],
            is_straight: first.is_some() && (pair[0] + 1..pair[1]).all(|k| turns[turned(k)] == 0.0),
            is_closed: first.is_none(),
            places: vec![arc[pair[0]], arc[pair[1]]],
        };
        let chains: Vec<Chain> = ends.windows(2).map(chain).collect();
        let (points, segments) = (0..n).map(|k| (kept[turned(k)].0, kept[turned(k)].2)).unzip();
        Ok((Self { points, segments, arc, chains, is_of_nodes: false }, turns, start))
    }

    /// The same place from 0 to less than the line's length, for one less than that beyond.
    fn wrapped(&self, place: f64) -> f64 {
        let whole = self.arc[self.points.len()];
        let place = if place < 0.0 { place + whole } else { place };
        if place >= whole { place - whole } else { place }
    }

    /// The segment at a length along the line, and the fraction of it there.
    pub(super) fn segment(&self, place: f64) -> (usize, f64) {
        let place = self.wrapped(place);
        let k = self.arc.partition_point(|&arc| arc <= place).clamp(1, self.points.len()) - 1;
        (k, (place - self.arc[k]) / (self.arc[k + 1] - self.arc[k]))
    }

    /// The place at a length along the line, with its segment of the old loop and the fraction of it.
    pub(crate) fn at(&self, place: f64) -> (Point, u32, f64) {
        let (k, fraction) = self.segment(place);
        let fraction = fraction.clamp(0.0, 1.0 - f64::EPSILON);
        (on_line(self.points[k], self.points[(k + 1) % self.points.len()], fraction), self.segments[k], fraction)
    }

    /// Gives both chains that meet in a corner of less than 60 degrees a first edge of the same length, so
    /// that the triangles there need no ever smaller ones.
    pub(super) fn level(&mut self) {
        let count = self.chains.len();
        for k in 0..count {
            let last = (k + count - 1) % count;
            let corner = self.chains[k].points[0];
            let n = self.points.len();
            let x = self.points[corner];
            let (back, on) = (minus(self.points[(corner + n - 1) % n], x), minus(self.points[(corner + 1) % n], x));
            let is_sharp = 2.0 * dot(back, on) > (dot(back, back) * dot(on, on)).sqrt();
            if self.chains[k].is_closed || !is_sharp || count < 2 {
                continue;
            }
            let (before, after) = (&self.chains[last].places, &self.chains[k].places);
            let (m, start, end) = (before.len(), after[0], before[before.len() - 1]);
            let [one, other] = [end - before[m - 2], after[1] - start];
            // A chain of one edge can't have it shorter.
            if one > other && m > 2 {
                self.chains[last].places[m - 2] = end - other;
            } else if other > one && after.len() > 2 {
                self.chains[k].places[1] = start + one;
            }
        }
    }

    /// Length of the segment at a place along the line, and the fraction of it there.
    pub(super) fn edge(&self, place: f64) -> [f64; 2] {
        let (k, fraction) = self.segment(place);
        [self.arc[k + 1] - self.arc[k], fraction.clamp(0.0, 1.0)]
    }

    /// Where a node of the line lies on the old outline.
    pub(crate) fn on_outline(&self, place: f64, node: u32) -> OnOutline {
        let (_, segment, fraction) = self.at(place);
        OnOutline { node, segment, fraction }
    }

    /// Places along the line with the length that edges should have there: the wanted size, less where the
    /// line turns much or where points that stay are near to each other, and growing gently.
    fn stations(&self, turns: &[f64], start: usize, size: &dyn Fn(Point) -> f64, per: f64, limit: usize) -> Result<Vec<[f64; 2]>, Failure> {
        let (n, chains) = (self.points.len(), &self.chains);
        // The sum of the turns, which is reached in the middle of each segment.
        let middles: Vec<f64> = (0..n).map(|k| 0.5 * (self.arc[k] + self.arc[k + 1])).collect();
        let mut sums = vec![0.0];
        let ends: Vec<bool> = {
            let mut ends = vec![false; n + 1];
            chains.iter().filter(|chain| !chain.is_closed).for_each(|chain| ends[chain.points[0]] = true);
            ends
        };
        for k in 1..n {
            sums.push(sums[k - 1] + if ends[k] { 0.0 } else { turns[(k + start) % n] });
        }
        let sum = |place: f64| {
            let k = middles.partition_point(|&middle| middle <= place);
            if k == 0 || k == n {
                return sums[k.saturating_sub(1)];
            }
            sums[k - 1] + (sums[k] - sums[k - 1]) * (place - middles[k - 1]) / (middles[k] - middles[k - 1])
        };
        let mut stations: Vec<[f64; 2]> = Vec::new();
        for (c, chain) in chains.iter().enumerate() {
            let [from, to] = chain.points.map(|k| self.arc[k]);
            // Where a chain begins, the one before ends.
            let before = chains[(c + chains.len() - 1) % chains.len()].points.map(|k| self.arc[k]);
            let first = stations.len();
            for k in chain.points[0]..chain.points[1] {
                let (a, b) = (self.points[k], self.points[(k + 1) % n]);
                let length = self.arc[k + 1] - self.arc[k];
                let mut done = 0.0;
                while done < 1.0 {
                    let wanted = checked(size, on_line(a, b, done))?;
                    let place = self.arc[k] + done * length;
                    let mut most = wanted;
                    if !chain.is_straight {
                        for _ in 0..8 {
                            let turn = (sum((place + 0.5 * most).min(to)) - sum((place - 0.5 * most).max(from))).abs();
                            if turn <= TURN || most <= SHORTEST * wanted {
                                break;
                            }
                            most = (most * (TURN / turn).max(0.5)).max(SHORTEST * wanted);
                        }
                    }
                    stations.push([place, most.min((to - from) / per)]);
                    if stations.len() > 4 * n + 16 * limit.min(1 << 40) + 10_000 {
                        return Err(Failure::Limit);
                    }
                    let step = (wanted / (PARTS * length)).max(1.0 / 4096.0);
                    done = if done + 1.5 * step >= 1.0 { 1.0 } else { done + step };
                }
            }
            stations[first][1] = stations[first][1].min((before[1] - before[0]) / per);
        }
        // Twice around, so that the first station knows of the last.
        let whole = self.arc[n];
        let count = stations.len();
        for step in 0..2 * count {
            let [i, k] = [step % count, (step + 1) % count];
            let gap = stations[k][0] - stations[i][0] + if k == 0 { whole } else { 0.0 };
            stations[k][1] = stations[k][1].min(stations[i][1] + GROWTH * gap);
        }
        for step in (0..2 * count).rev() {
            let [i, k] = [step % count, (step + 1) % count];
            let gap = stations[k][0] - stations[i][0] + if k == 0 { whole } else { 0.0 };
            stations[i][1] = stations[i][1].min(stations[k][1] + GROWTH * gap);
        }
        stations.push([whole, stations[0][1]]);
        Ok(stations)
    }

    /// Puts nodes on the chains at equal parts of ∫ ds / h, h being the length at the stations.
    fn place(&mut self, stations: &[[f64; 2]], per: f64, limit: usize) -> Result<(), Failure> {
        let mut first = 0;
        for chain in &mut self.chains {
            let end = self.arc[chain.points[1]];
            let mut sums = vec![(self.arc[chain.points[0]], 0.0)];
            while first + 1 < stations.len() && stations[first][0] < end {
                let [[from, one], [to, other]] = [stations[first], stations[first + 1]];
                let sum = sums[sums.len() - 1].1 + (to - from) * 0.5 * (1.0 / one + 1.0 / other) / per;
                sums.push((to, sum));
                first += 1;
            }
            let whole = sums[sums.len() - 1].1;
            let count = whole.round().max(1.0);
            if !(count <= limit as f64) {
                return Err(Failure::Limit);
            }
            chain.places.truncate(1);
            for i in 1..count as usize {
                let wanted = whole * i as f64 / count;
                let k = sums.partition_point(|&(_, sum)| sum <= wanted).clamp(1, sums.len() - 1);
                let [(from, low), (to, high)] = [sums[k - 1], sums[k]];
                chain.places.push(from + (to - from) * (wanted - low) / (high - low));
            }
            chain.places.push(end);
            chain.places.dedup();
        }
        let mut nodes: usize = self.chains.iter().map(|chain| chain.places.len() - 1).sum();
        while nodes < 3 {
            for chain in &mut self.chains {
                chain.halve();
            }
            nodes *= 2;
        }
        Ok(())
    }
}

impl Chain {
    /// Puts a node between each two.
    pub(super) fn halve(&mut self) {
        self.places = halved(&self.places);
    }

    /// Puts nodes at more places.
    pub(super) fn add(&mut self, more: &[f64]) {
        self.places.extend(more);
        self.places.sort_by(f64::total_cmp);
        self.places.dedup();
    }
}

/// Places with one more between each two.
pub(super) fn halved(places: &[f64]) -> Vec<f64> {
    let mut all = vec![places[0]];
    for pair in places.windows(2) {
        all.extend([0.5 * (pair[0] + pair[1]), pair[1]]);
    }
    all
}

/// The wanted length of edges at a point.
pub(super) fn checked(size: &dyn Fn(Point) -> f64, x: Point) -> Result<f64, Failure> {
    let wanted = size(x);
    if wanted > 0.0 && wanted.is_finite() { Ok(wanted) } else { Err(Failure::Size { at: x }) }
}
