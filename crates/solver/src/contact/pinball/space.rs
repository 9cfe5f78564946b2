//! Pinballs in 3D: balls in the elements under the surfaces, a spring between each two that come near.
//!
//! Surfaces, the elements behind their facets and κ come from the builder; springs go to the solver. As the
//! disks of the plane ([`super`]), after Belytschko and Neal (1991): but the ball touches the surface from
//! inside (`geometry`), so that surfaces that touch have no gap and no overlap. The centre is a fixed point
//! of the element, c = Σ N_k x_k, the radius is constant: the gap |c₁ − c₂| − R₁ − R₂ has the rows N_k n, its
//! spring keeps the energy, and the forces keep both momenta exactly. Friction acts at both centres, along
//! two tangents, and each element takes its part of the couple by its mean spin, which is its own in every
//! rigid motion.
//!
//! Surfaces of balls are bumpy: between four balls of equal cubes a ball of their size comes nearer by 29 %
//! of their diameter, and one of less than 0.41 of it passes.

mod geometry;

use super::super::formulation::{Setup, Side};
use super::super::projection::node_facet::Placed;
use super::super::spin;
use super::super::springs::friction::cone;
use super::super::springs::{Answers, End, Slip, Springs};
use super::super::tied::Beside;
use super::super::tracker::SearchReport;
use super::super::{Formulation, Scene, Sweep};
use super::follower::{self, Follower};
use crate::archive::{Archive, ArchiveResult, persist_each};
use crate::contact::springs::TangentSpace;
use crate::mesh::surface::Corners;
use crate::tensor::{Dim, cross, dot};
use crate::vector::{length, minus};
use std::any::Any;

type Vector = [f64; 3];

/// A ball in an element of at most eight nodes.
type Ball = follower::Ball<8>;

/// Springs are there that may close with so many times the last motion, and at this fraction of the skin for
/// what is set in motion now.
const LOOK_AHEAD: f64 = 4.0;
const START: f64 = 0.02;

/// The formulation.
pub struct Pinball {
    follower: Follower<3, 8>,
    /// Those that are near and have springs in this step.
    used: Vec<u32>,
}

impl Pinball {
    /// Of one surface that meets itself, or of two.
    #[must_use]
    pub fn of(setup: &Setup<'_, 3>) -> Self {
        let layers = setup.sides.iter().map(|side| geometry::balls_under(side, setup.positions)).collect();
        let (interface, reach, search) = (&setup.contact.interface, (setup.law)().reach(), (setup.search)());
        let places = (setup.bodies, setup.positions);
        Self { follower: Follower::new(layers, interface, setup.penalty(), reach, search, places), used: Vec::new() }
    }
}

impl Formulation<3> for Pinball {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        let follower = &mut self.follower;
        follower.follow(scene.sweep);
        self.used.clear();
        for index in 0..follower.near.len() {
            let lying = follower.lying(index);
            let near = follower.near[index];
            if lying.gap > follower.reach + START * follower.skin + LOOK_AHEAD * follower.motion(near.pair) {
                follower.near[index].slip = [0.0; 3];
                continue;
            }
            let spring = follower.spring(near.pair, &lying);
            let [one, other] = near.pair.map(|ball| &follower.balls[ball as usize]);
            let tangents = Dim::<3>::tangents(spring.normal, &[0.0; 3]);
            let slip = cone::carried(turned_with([one, other], near.slip, scene.sweep), tangents);
            // Friction acts at both centres; each element takes the part of the couple that its radius has in
            // the distance.
            let part = lying.distance / (one.radius + other.radius);
            let mut ends = [End::<3>::default(); 16];
            let arms = tangents.map(|tangent| cross(spring.normal, tangent));
            let (positions, of) = (scene.sweep.new, |ball: &Ball| arms.map(|arm| arm.map(|c| part * ball.radius * c)));
            let count = one.add_ends(positions, 1.0, of(one), &mut ends);
            let count = count + other.add_ends(positions, -1.0, of(other), &mut ends[count..]);
            springs.push(spring, Slip::of(slip), &ends[..count]);
            self.used.push(index as u32);
        }
        follower.has_begun = true;
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        for (&index, answer) in self.used.iter().zip(solved) {
            let ([first, second], [a, b]) = (answer.tangents(), answer.slid().slip_new);
            self.follower.near[index as usize].slip = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { follower, used: _ } = self;
        follower.persist(archive)?;
        persist_each!(archive; &mut follower.report.steps, &mut follower.report.searches);
        Ok(())
    }

    fn beside(&self) -> Beside {
        Beside::Elements
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.follower.inherit(&old.follower);
        }
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(SearchReport { candidates: self.follower.near.len(), ..self.follower.report })
    }
}

/// A slip that turns in the step as both elements do in the mean: whichever is the first, and however their
/// nodes are numbered.
///
/// Of each the spin is Θ⁻¹ Σ r × Δx about the mean of its nodes with r half way, which is 2 tan ½φ along the
/// axis of every rigid motion: half of it makes the rotation by Cayley's map, exactly.
fn turned_with(balls: [&Ball; 2], slip: Vector, sweep: Sweep<'_, 3>) -> Vector {
    let [one, other] = balls.map(|ball| spin::turn([&ball.nodes[..ball.count]], sweep));
    spin::turned(slip, [0, 1, 2].map(|d| 0.5 * (one[d] + other[d])))
}

impl Ball {
    /// Arms of its element's nodes about their mean, m, and the sum Θ of r² 1 − r ⊗ r over them.
    fn arms(&self, at: impl Fn(u32) -> Vector) -> ([Vector; 8], [Vector; 3]) {
        let nodes = &self.nodes[..self.count];
        let mut mean = [0.0; 3];
        for &node in nodes {
            let x = at(node);
            (0..3).for_each(|d| mean[d] += x[d] / self.count as f64);
        }
        let (mut arms, mut inertia) = ([[0.0; 3]; 8], [[0.0; 3]; 3]);
        for (arm, &node) in arms.iter_mut().zip(nodes) {
            let r = minus(at(node), mean);
            spin::add_arm(r, &mut inertia);
            *arm = r;
        }
        (arms, inertia)
    }

    /// Writes the ends of a spring that pushes the ball along `sign` n; friction's couple is taken by the
    /// element's nodes as their mean spin takes it: `arms` is n × t times the radius, for both tangents. How
    /// many there are.
    fn add_ends(&self, positions: &[Vector], sign: f64, arms: [Vector; 2], ends: &mut [End<3>]) -> usize {
        // ω = Θ⁻¹ Σ r × v: the spin of every rigid motion. ω·a of a vector a has the rows (Θ⁻¹ a) × r.
        let (of_nodes, inertia) = self.arms(|node| positions[node as usize]);
        let spins = arms.map(|arm| spin::solved(&inertia, arm));
        for (((end, &node), share), r) in ends.iter_mut().zip(&self.nodes[..self.count]).zip(self.shares).zip(of_nodes) {
            let turn = spins.map(|spin| cross(r, spin));
            *end = End { turn, ..End::node(node, sign * share) };
        }
        self.count
    }
}

#[cfg(test)]
mod tests;
