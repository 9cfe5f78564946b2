//! The common part of two segments that face each other: where it is, the gap in it, and how gap, area and
//! radius vary with the nodes.
//!
//! Nodes and positions come from the formulation; rows of rates go to its springs.

use super::{AT_ONCE, SLIVER};
use crate::contact::springs::End;
use crate::contact::{Sweep, Vector};
use crate::vector::{dot, minus};

/// Direction of a segment, and its length, m.
fn direction([begin, end]: [Vector; 2]) -> (Vector, f64) {
    let along = minus(end, begin);
    let length = dot(along, along).sqrt();
    ([along[0] / length, along[1] / length], length)
}

/// The common direction t of two segments with these directions.
fn between([ta, tb]: [Vector; 2]) -> Vector {
    let sum = minus(ta, tb);
    let size = dot(sum, sum).sqrt();
    [sum[0] / size, sum[1] / size]
}

/// Normal of two segments, from the second to the first; `None`: there is none.
pub(super) fn normal(positions: [[Vector; 2]; 2]) -> Option<Vector> {
    let t = between(positions.map(|ends| direction(ends).0));
    (t[0].is_finite() && t[1].is_finite()).then_some([t[1], -t[0]])
}

/// Half of the rate at which a segment turns by the velocity of its end i, 1/m.
pub(super) fn half_angle([begin, end]: [Vector; 2], i: usize) -> Vector {
    let chord = minus(end, begin);
    let per_length = (i as f64 - 0.5) / dot(chord, chord);
    [-chord[1] * per_length, chord[0] * per_length]
}

/// The common part of two segments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Common {
    pub(super) nodes: [[u32; 2]; 2],
    positions: [[Vector; 2]; 2],
    /// Points from the second segment to the first.
    pub(super) normal: Vector,
    /// Coordinates along t of the nodes of both segments.
    along: [[f64; 2]; 2],
    /// Where the common part begins, and its length, m.
    begin: f64,
    pub(super) length: f64,
    /// Length times −t_a·t_b, m: segments that turn away from each other fade out instead of being dropped at
    /// a right angle.
    pub(super) area: f64,
    /// Gap at the beginning and the end, and whose node is there: segment (0, 1) and its end (0, 1).
    pub(super) ends: [[f64; 3]; 2],
}

impl Common {
    pub(super) fn new(nodes: [[u32; 2]; 2], positions: &[Vector]) -> Option<Self> {
        let positions = nodes.map(|nodes| nodes.map(|node| positions[node as usize]));
        let [ta, tb] = positions.map(direction);
        let facing = -dot(ta.0, tb.0);
        // NaN (a segment without length) fails the comparison too
        if !(facing > 0.0) {
            return None;
        }
        let t = between([ta.0, tb.0]);
        let origin = positions[0][0];
        let along = positions.map(|ends| ends.map(|x| dot(minus(x, origin), t)));
        let [[a0, a1], [b0, b1]] = along;
        // The first runs along t, the second against it.
        let (begin, first) = if a0 >= b1 { (a0, [0.0, 0.0]) } else { (b1, [1.0, 1.0]) };
        let (end, last) = if a1 <= b0 { (a1, [0.0, 1.0]) } else { (b0, [1.0, 0.0]) };
        let length = end - begin;
        if !(length > SLIVER * ta.1.min(tb.1)) {
            return None;
        }
        let mut common = Self { nodes, positions, normal: [t[1], -t[0]], along, begin, length, area: length * facing, ends: [[0.0; 3]; 2] };
        common.ends = [first, last].map(|[whose, end]| [0.0, whose, end]);
        common.ends = [0.0, 1.0].map(|place| [common.point(place).0, common.ends[place as usize][1], common.ends[place as usize][2]]);
        Some(common)
    }

    /// Gap at a place q (0 to 1) of the common part, and the ends of a spring there. The row of the gap is
    /// its whole derivative.
    ///
    /// The point of segment a is at ξ_a = (s − s_a0)/(s_a1 − s_a0) with s = (1 − q) s_begin + q s_end, of the
    /// nodes where the common part begins and ends; coordinates change by ds_k = t·dx_k + h_k dφ (h_k: height
    /// of node k above t), where t turns by dφ = ½ (dφ_a + dφ_b). So
    ///
    /// dg = n·(Σ N dx_a − Σ M dx_b) + n·d_a dξ_a − n·d_b dξ_b        with d = x_1 − x_0 of a segment:
    ///
    /// where segments are inclined to each other, points that slide along them open or close the gap. (n
    /// turns too, but x_a − x_b is parallel to it.)
    ///
    /// Friction acts along t at both points, which are the gap apart; its couple is taken by forces across
    /// both segments, half of it each. So the slip rate ṡ = t·(v_a − v_b) + ½ g (θ̇_a + θ̇_b) does not see
    /// rotations of both together, and friction keeps the angular momentum.
    pub(super) fn point(&self, place: f64) -> (f64, [End<2>; 4]) {
        let n = self.normal;
        let [xa, xb] = self.points(place);
        let gap = dot(minus(xa, xb), n);
        let (weights, slid) = (self.weights(place), self.slides(place, [n, [-n[0], -n[1]]]));
        let end = |k: usize, i: usize| {
            let share = if k == 0 { weights[k][i] } else { -weights[k][i] };
            End { at: self.nodes[k][i], share, lean: slid[k][i], turn: [self.half_angle(k, i).map(|half| gap * half)], ..End::default() }
        };
        (gap, [end(0, 0), end(0, 1), end(1, 0), end(1, 1)])
    }

    /// What each node has of the points x_a and x_b at a place.
    fn weights(&self, place: f64) -> [[f64; 2]; 2] {
        let s = self.begin + place * self.length;
        self.along.map(|[begin, end]| {
            let share = (s - begin) / (end - begin);
            [1.0 - share, share]
        })
    }

    /// x_a and x_b at a place, m.
    fn points(&self, place: f64) -> [Vector; 2] {
        let weights = self.weights(place);
        [0, 1].map(|k| [0, 1].map(|d| weights[k][0] * self.positions[k][0][d] + weights[k][1] * self.positions[k][1][d]))
    }

    /// How far the segment that does not end at the beginning and at the end of the common part continues
    /// there, m.
    pub(super) fn beyond(&self) -> [f64; 2] {
        let [[a0, a1], [b0, b1]] = self.along;
        [(a0 - b1).abs(), (a1 - b0).abs()]
    }

    /// Whether it is more than what slides in or out in a step.
    pub(super) fn is_long(&self) -> bool {
        let shorter = self.along.map(|[begin, end]| (end - begin).abs()).into_iter().fold(f64::INFINITY, f64::min);
        self.area > AT_ONCE * shorter
    }

    /// How far the four nodes moved in a step, less what they moved together, m.
    pub(super) fn moved(&self, sweep: Sweep<'_, 2>) -> f64 {
        let nodes = [self.nodes[0][0], self.nodes[0][1], self.nodes[1][0], self.nodes[1][1]].map(|node| node as usize);
        let ways = nodes.map(|node| minus(sweep.new[node], sweep.old[node]));
        let mean = [0, 1].map(|d| 0.25 * (ways[0][d] + ways[1][d] + ways[2][d] + ways[3][d]));
        ways.map(|way| minus(way, mean)).into_iter().map(|own| dot(own, own).sqrt()).sum()
    }

    /// By how much a gap with these ends grew in a step, m.
    pub(super) fn way(&self, ends: &[End<2>; 4], sweep: Sweep<'_, 2>) -> f64 {
        let of = |end: &End<2>| {
            let way = minus(sweep.new[end.at as usize], sweep.old[end.at as usize]);
            dot([0, 1].map(|d| end.share * self.normal[d] + end.lean[d]), way)
        };
        ends.iter().map(of).sum()
    }

    /// Half way between x_a and x_b, m.
    pub(super) fn middle(&self, place: f64) -> Vector {
        let [xa, xb] = self.points(place);
        [0, 1].map(|d| 0.5 * (xa[d] + xb[d]))
    }

    /// Derivative of c_a·x_a + c_b·x_b by the position of each node, as far as it comes from the points'
    /// sliding along their segments.
    fn slides(&self, place: f64, by: [Vector; 2]) -> [[Vector; 2]; 2] {
        let (n, origin) = (self.normal, self.positions[0][0]);
        let t = [-n[1], n[0]];
        let weights = self.weights(place);
        let chord = self.positions.map(|[begin, end]| minus(end, begin));
        // By the coordinate of each node along t: by s at the nodes of the ends, by the segments' own nodes.
        let slopes = [0, 1].map(|k| dot(by[k], chord[k]) / (self.along[k][1] - self.along[k][0]));
        let mut by_place = [0, 1].map(|k| weights[k].map(|weight| -slopes[k] * weight));
        for ([_, whose, end], part) in self.ends.into_iter().zip([1.0 - place, place]) {
            by_place[whose as usize][end as usize] += part * (slopes[0] + slopes[1]);
        }
        let height = |x: Vector| -dot(minus(x, origin), n);
        let by_angle: f64 = (0..4).map(|i| by_place[i / 2][i % 2] * height(self.positions[i / 2][i % 2])).sum();
        [0, 1].map(|k| {
            [0, 1].map(|i| {
                let half = self.half_angle(k, i);
                [0, 1].map(|d| by_place[k][i] * t[d] + by_angle * half[d])
            })
        })
    }

    /// ½ dφ_k of segment k by the position of its end i.
    fn half_angle(&self, k: usize, i: usize) -> Vector {
        half_angle(self.positions[k], i)
    }

    /// Adds `factor` times the derivative of ln(r) to the rows of the gap, with the radius r half way between
    /// both points at a place.
    pub(super) fn vary_radius(&self, ends: &mut [End<2>; 4], place: f64, factor: f64) {
        let radius = self.middle(place)[0];
        if !(radius > 0.0) {
            return;
        }
        let (weights, slid) = (self.weights(place), self.slides(place, [[0.5, 0.0]; 2]));
        for (index, end) in ends.iter_mut().enumerate() {
            let (k, i) = (index / 2, index % 2);
            let own = [0.5 * weights[k][i], 0.0];
            end.lean = [0, 1].map(|d| end.lean[d] + factor / radius * (own[d] + slid[k][i][d]));
        }
    }

    /// Adds `factor` times the derivative of ln(area) to the rows of the gap.
    ///
    /// d area / area = dℓ/ℓ − tan θ (dφ_a − dφ_b) with the angle θ between the segments, dℓ = t·(dx_end −
    /// dx_begin) + (h_end − h_begin) dφ.
    pub(super) fn vary_area(&self, ends: &mut [End<2>; 4], factor: f64) {
        let (n, per_length) = (self.normal, factor / self.length);
        let t = [-n[1], n[0]];
        let [da, db] = self.positions.map(|[begin, end]| minus(end, begin));
        let tangent = (da[0] * db[1] - da[1] * db[0]) / -dot(da, db);
        let mut rise = 0.0;
        for ([_, whose, end], sign) in self.ends.into_iter().zip([-1.0, 1.0]) {
            let (k, i) = (whose as usize, end as usize);
            rise -= sign * dot(minus(self.positions[k][i], self.positions[0][0]), n);
            for d in 0..2 {
                ends[2 * k + i].lean[d] += sign * per_length * t[d];
            }
        }
        for (index, end) in ends.iter_mut().enumerate() {
            let (k, i) = (index / 2, index % 2);
            let half = self.half_angle(k, i);
            let turned = per_length * rise - 2.0 * factor * tangent * if k == 0 { 1.0 } else { -1.0 };
            for d in 0..2 {
                end.lean[d] += turned * half[d];
            }
        }
    }
}
