//! Pinballs in space: balls in the elements under the surfaces, a spring between each two that come near.
//!
//! Surfaces, the elements behind their facets and κ come from the builder; springs go to the solver. As the disks of the plane ([`super`]), after Belytschko and Neal (1991): but the ball
//! touches the surface from inside (`geometry`), so that surfaces that touch have no gap and no overlap. The centre is a fixed point of the element, c = Σ N_k x_k, the radius is constant:
//! the gap |c₁ − c₂| − R₁ − R₂ has the rows N_k n, its spring keeps the energy, and the forces keep both momenta exactly. Friction acts at both centres, along two tangents, and each element
//! takes its part of the couple by its mean spin, which is its own in every rigid motion.
//!
//! Surfaces of balls are bumpy: between four balls of equal cubes a ball of their size comes nearer by 29 % of their diameter, and one of less than 0.41 of it passes.

mod geometry;

use super::super::initial::{is_ignored, kept};
use super::super::law::penalty;
use super::super::node_facet::{tangent, turned};
use super::super::projection::node_facet::{Placed, unit};
use super::super::search::{Pair, Query, Search};
use super::super::springs::friction::cone;
use super::super::springs::{Answers, End, Spring, Springs};
use super::super::tracker::{SKIN, SearchReport};
use super::super::{Formulation, Scene, Sweep};
use crate::archive::{Archive, Kept, keep_all, keep_each};
use crate::mesh::surface::{Corners, SpaceSurface};
use crate::model;
use crate::motion::Motion;
use crate::tensor::{Dim, cross, dot};
use crate::vector::{length, minus};
use geometry::Ball;
use std::any::Any;

type Vector = [f64; 3];

/// Springs are there that may close with so many times the last motion, and at this fraction of the skin for what is set in motion now.
const LOOK_AHEAD: f64 = 4.0;
const START: f64 = 0.02;

/// A surface, and what is behind its facets.
pub struct Layer<'a> {
    /// The surface.
    pub surface: &'a SpaceSurface,
    /// Nodes of the element behind each facet; empty where it is not known.
    pub cells: Vec<&'a [u32]>,
    /// κ of these elements, Pa/m.
    pub stiffness: Vec<f64>,
}

/// The formulation.
pub struct Pinball {
    balls: Vec<Ball>,
    /// Balls of the first surface come first; of a contact of bodies with themselves all.
    first: usize,
    search: Box<dyn Search<3>>,
    penalty: model::Penalty,
    /// Distance that the balls keep and largest gap at which the law pushes, m.
    thickness: f64,
    reach: f64,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    has_begun: bool,
    /// How far balls may move before the next search, m: half of it.
    skin: f64,
    centres_old: Vec<Vector>,
    centres: Vec<Vector>,
    /// Centres at the last search; empty before the first.
    searched: Vec<Vector>,
    /// Centres at the start, m, and the body of each ball.
    initial: Vec<Vector>,
    bodies: Vec<u32>,
    pairs: Vec<Pair>,
    near: Vec<Near>,
    before: Vec<Near>,
    /// Those of `near` that have springs in this step.
    used: Vec<u32>,
    report: SearchReport,
}

/// Two balls that are near each other.
#[derive(Clone, Copy, Debug, Default)]
struct Near {
    pair: [u32; 2],
    /// Elastic slip, m, and the axes of the first ball's element when it was noted.
    slip: Vector,
    frame: [Vector; 3],
    /// Gap that counts as zero, m; not positive.
    offset: f64,
    /// Whether the pair was there before the surfaces changed.
    known: bool,
}

keep_all!(Near { pair, slip, frame, offset, known });

impl Pinball {
    /// Of one surface that meets itself, or of two; `bodies` of each node of the model, `positions` the initial ones, m; `reach` of the law, m.
    #[must_use]
    pub fn new(
        layers: &[Layer<'_>],
        contact: &model::Contact,
        penalty: model::Penalty,
        reach: f64,
        search: Box<dyn Search<3>>,
        (bodies, positions): (&[u32], &[Vector]),
    ) -> Self {
        let mut balls: Vec<Ball> = Vec::new();
        let mut first = 0;
        for (index, layer) in layers.iter().enumerate() {
            balls.extend(geometry::balls_under(layer, positions));
            if index == 0 {
                first = balls.len();
            }
        }
        let skin = SKIN * balls.iter().map(|ball| ball.area.sqrt()).sum::<f64>() / balls.len().max(1) as f64;
        let of = |ball: &Ball| bodies.get(ball.nodes[0] as usize).copied().unwrap_or(u32::MAX);
        Self {
            first,
            search,
            penalty,
            thickness: contact.interface.thickness,
            reach,
            ignores_start: is_ignored(&contact.interface),
            has_begun: false,
            skin,
            centres_old: Vec::new(),
            centres: Vec::new(),
            searched: Vec::new(),
            initial: balls.iter().map(|ball| ball.centre(positions)).collect(),
            bodies: balls.iter().map(of).collect(),
            pairs: Vec::new(),
            near: Vec::new(),
            before: Vec::new(),
            used: Vec::new(),
            report: SearchReport { skin, ..SearchReport::default() },
            balls,
        }
    }

    fn meets_itself(&self) -> bool {
        self.first == self.balls.len()
    }

    /// Moves the centres; searches again where some ball has left the skin.
    fn follow(&mut self, sweep: Sweep<'_, 3>) {
        for (centres, positions) in [(&mut self.centres_old, sweep.old), (&mut self.centres, sweep.new)] {
            centres.clear();
            centres.extend(self.balls.iter().map(|ball| ball.centre(positions)));
        }
        self.report.steps += 1;
        let limit = 0.25 * self.skin * self.skin;
        let left = |(x, from): (&Vector, &Vector)| {
            let moved = minus(*x, *from);
            // What is no number counts as moved.
            !(dot(moved, moved) <= limit)
        };
        if self.searched.is_empty() || self.centres.iter().zip(&self.searched).any(left) {
            self.search();
        }
    }

    fn search(&mut self) {
        let way = |(x, old): (&Vector, &Vector)| length(minus(*x, *old));
        let fastest = self.centres.iter().zip(&self.centres_old).map(way).fold(0.0, f64::max);
        let ahead = self.thickness + self.reach + self.skin + 2.0 * LOOK_AHEAD * fastest;
        let largest = |balls: &[Ball]| balls.iter().map(|ball| ball.radius).fold(0.0, f64::max);
        let from = if self.meets_itself() { 0 } else { self.first };
        let slaves: Vec<u32> = (0..self.first as u32).collect();
        let facets: Vec<[u32; 3]> = (from as u32..self.balls.len() as u32).map(|ball| [ball; 3]).collect();
        let query = Query {
            positions_old: &self.centres_old,
            positions_new: &self.centres,
            slaves: &slaves,
            facets: &facets,
            reach: ahead + largest(&self.balls[..self.first]) + largest(&self.balls[from..]),
        };
        self.search.pairs(&query, &mut self.pairs);
        self.report.searches += 1;
        std::mem::swap(&mut self.near, &mut self.before);
        self.near.clear();
        for pair in &self.pairs {
            let pair = [pair.slave, pair.facet + from as u32];
            let [one, other] = pair.map(|ball| &self.balls[ball as usize]);
            if (self.meets_itself() && pair[0] >= pair[1]) || one.shares_a_node_with(other) {
                continue;
            }
            let apart = |centres: &[Vector]| {
                let [a, b] = pair.map(|ball| centres[ball as usize]);
                length(minus(a, b))
            };
            // What came from afar within the step may have passed: both ends of it count.
            if apart(&self.centres).min(apart(&self.centres_old)) <= ahead + one.radius + other.radius {
                let known = self.before.binary_search_by_key(&pair, |near| near.pair).ok();
                self.near.push(known.map_or(Near { pair, ..Near::default() }, |at| self.before[at]));
            }
        }
        self.searched.clone_from(&self.centres);
    }

    /// Gap less the thickness. A body keeps no more distance from itself than half of what it had.
    fn gap(&self, pair: [u32; 2], distance: f64) -> (f64, bool) {
        let [mine, theirs] = pair.map(|ball| ball as usize);
        let touching = self.balls[mine].radius + self.balls[theirs].radius;
        let (gap, own) = (distance - touching - self.thickness, self.bodies[mine] == self.bodies[theirs]);
        if !own {
            return (gap, own);
        }
        let had = length(minus(self.initial[mine], self.initial[theirs])) - touching;
        (gap + (self.thickness + self.reach - 0.5 * had.max(0.0)).max(0.0), own)
    }
}

impl Formulation<3> for Pinball {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        self.follow(scene.sweep);
        let side = if self.meets_itself() { 0.0 } else { 1.0 };
        let positions = scene.sweep.new;
        self.used.clear();
        for index in 0..self.near.len() {
            let near = self.near[index];
            let [a, b] = near.pair.map(|ball| self.centres[ball as usize]);
            let [a_old, b_old] = near.pair.map(|ball| self.centres_old[ball as usize]);
            let away = minus(a, b);
            let distance = length(away);
            let (gap, own) = self.gap(near.pair, distance);
            let offset = kept(self.has_begun || near.known, near.offset, gap);
            let offset = if self.ignores_start || own { offset } else { 0.0 };
            self.near[index].offset = offset;
            let motion = length(minus(away, minus(a_old, b_old)));
            if gap - offset > self.reach + START * self.skin + LOOK_AHEAD * motion {
                self.near[index].slip = [0.0; 3];
                continue;
            }
            // Balls in one place have no direction: any will do.
            let normal = if distance > 0.0 { away.map(|part| part / distance) } else { [1.0, 0.0, 0.0] };
            let [one, other] = near.pair.map(|ball| &self.balls[ball as usize]);
            let area = one.area.min(other.area);
            let stiffness = area * penalty::pressure(self.penalty, one.stiffness, other.stiffness);
            let frame = one.axes(positions);
            let tangent = tangent(normal, frame[0]);
            let tangents = Dim::<3>::tangents(normal, &tangent);
            let slip = cone::carried(turned(near.slip, &near.frame, &frame), tangents);
            // Friction acts at both centres; each element takes the part of the couple that its radius has in the distance.
            let part = distance / (one.radius + other.radius);
            let mut ends = [End::<3>::default(); 16];
            let arms = tangents.map(|tangent| cross(normal, tangent));
            let count = one.add_ends(positions, 1.0, arms.map(|arm| arm.map(|c| part * one.radius * c)), &mut ends);
            let count = count + other.add_ends(positions, -1.0, arms.map(|arm| arm.map(|c| part * other.radius * c)), &mut ends[count..]);
            springs.push(Spring { normal, gap: gap - offset, stiffness, area, side, slip, tangent, ..Spring::default() }, &ends[..count]);
            self.near[index].frame = frame;
            self.used.push(index as u32);
        }
        self.has_begun = true;
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        for (&index, answer) in self.used.iter().zip(solved) {
            let ([first, second], [a, b]) = (answer.spring.tangents(), answer.solved.slip_new);
            self.near[index as usize].slip = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
        }
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        #[rustfmt::skip]
        let Self {
            balls, first: _, search: _, penalty: _, thickness: _, reach: _, ignores_start: _, skin: _, centres_old: _, centres: _, initial: _,
            bodies: _, pairs: _, before: _, used: _,
            has_begun, searched, near, report: SearchReport { steps, searches, skin: _, candidates: _ },
        } = self;
        keep_each!(archive; has_begun, searched, near, steps, searches);
        archive.check(searched.is_empty() || searched.len() == balls.len(), "pinballs were searched at other places")?;
        let is_there = |near: &Near| near.pair.iter().all(|&ball| (ball as usize) < balls.len());
        archive.check(near.iter().all(is_there), "a pinball is not there")
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        let mut by_nodes: Vec<([u32; 8], usize)> = self.balls.iter().map(|ball| ball.nodes).zip(0..).collect();
        by_nodes.sort_unstable();
        let find = |ball: u32| {
            let ball = &old.balls[ball as usize];
            let first = by_nodes.partition_point(|&(nodes, _)| nodes < ball.nodes);
            let same = by_nodes[first..].iter().take_while(|&&(nodes, _)| nodes == ball.nodes).map(|&(_, index)| index);
            same.into_iter().find(|&index| self.balls[index].shares == ball.shares).map(|index| index as u32)
        };
        let now = |near: &Near| {
            let mut pair = [find(near.pair[0])?, find(near.pair[1])?];
            let is_turned = self.meets_itself() && pair[0] > pair[1];
            if is_turned {
                pair.reverse();
            }
            // The slip is that of the first against the second, and turns with the first.
            let slip = if is_turned { near.slip.map(|s| -s) } else { near.slip };
            Some(Near { pair, slip, known: old.has_begun, ..*near })
        };
        // The first search looks what is known of its pairs up here. Balls that come to light may be in each other, where their body has been squeezed: that counts as zero.
        let mut near: Vec<Near> = old.near.iter().filter_map(now).collect();
        near.sort_by_key(|near| near.pair);
        self.near = near;
        self.report = SearchReport { skin: self.skin, ..old.report };
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(SearchReport { candidates: self.near.len(), ..self.report })
    }
}

impl Ball {
    /// Axes that turn with the element: along its first edge, across it, and the normal of its first corners.
    fn axes(&self, positions: &[Vector]) -> [Vector; 3] {
        let [a, b, c] = [0, 1, 2].map(|k| positions[self.nodes[k] as usize]);
        let (along, normal) = (unit(minus(b, a)), unit(cross(minus(b, a), minus(c, a))));
        [along, cross(normal, along), normal]
    }

    /// Writes the ends of a spring that pushes the ball along `sign` n; friction's couple is taken by the element's nodes as their mean spin takes it: `arms` is n × t times the radius, for
    /// both tangents. How many there are.
    fn add_ends(&self, positions: &[Vector], sign: f64, arms: [Vector; 2], ends: &mut [End<3>]) -> usize {
        let nodes = &self.nodes[..self.count];
        let mut mean = [0.0; 3];
        for &node in nodes {
            let x = positions[node as usize];
            (0..3).for_each(|d| mean[d] += x[d] / self.count as f64);
        }
        let arm = |node: u32| minus(positions[node as usize], mean);
        // ω = Θ⁻¹ Σ r × v with Θ = Σ (r² 1 − r ⊗ r): the spin of every rigid motion. ω·a of a vector a has the rows (Θ⁻¹ a) × r.
        let mut inertia = [[0.0; 3]; 3];
        for &node in nodes {
            let r = arm(node);
            let square = dot(r, r);
            for i in 0..3 {
                (0..3).for_each(|j| inertia[i][j] -= r[i] * r[j]);
                inertia[i][i] += square;
            }
        }
        let spins = arms.map(|arm| solved(&inertia, arm));
        for ((end, &node), share) in ends.iter_mut().zip(nodes).zip(self.shares) {
            let r = arm(node);
            let turn = spins.map(|spin| cross(r, spin));
            *end = End { turn, ..End::node(node, sign * share) };
        }
        self.count
    }
}

/// The solution of a symmetric system, zero where it has none.
fn solved([a, b, c]: &[Vector; 3], right: Vector) -> Vector {
    let (bc, ca, ab) = (cross(*b, *c), cross(*c, *a), cross(*a, *b));
    let whole = dot(*a, bc);
    if whole.abs() > f64::MIN_POSITIVE { [dot(bc, right), dot(ca, right), dot(ab, right)].map(|part| part / whole) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests;
