//! Prediction of the forces in an island: Newton's step for all springs that push, by a direct solution of the linearized system.
//!
//! Islands come from [`super::relax`], which calls where sweeps are slow: springs much stiffer than the nodes between them, or more of them than the nodes have ways to move. The change of
//! a spring's force with the gap that it would have without it, s = −dF/dg_free, is that of a compliance d + c with its own c = Σ row·response: d = 2/k of a closed linear
//! spring, zero of a multiplier. So the steps of the forces obey
//!
//! (d_i + A_ii) ΔF_i + Σ_j A_ij ΔF_j = r_i / s_i,   A_ij = ½ dt row_i · response_j,   r_i what the law would change,
//!
//! with friction that sticks as unknowns of the same kind and friction that slides as a multiple of its normal force. Springs in line along a surface only know their
//! neighbours: they are ordered from one end to the other (Cuthill and McKee), rigid bodies come last as unknowns of their own, and the solution costs as much as a few sweeps.
//! Where springs say the same twice the forces are not unique (the motion is); [`SOFTNESS`] keeps the factors then. Nothing is trusted: sweeps confirm or go on.

use super::Tangential;
use super::link::{Arm, dot};
use super::relax::Island;
use super::skyline::Skyline;

/// Least d of an unknown, as a fraction of its c.
const SOFTNESS: f64 = 1e-10;
/// Difference of gaps by which slopes are found, as a fraction of the gaps.
const DIFFERENCE: f64 = 1e-6;
/// Multiplications that a solution may take per unknown, and in all.
const WORK: [usize; 2] = [10_000, 100_000_000];
/// No unknown.
const NONE: u32 = u32::MAX;

/// Memory for predictions.
#[derive(Default)]
pub(super) struct Newton {
    state: Vec<State>,
    /// Where the touches of each slot begin; touches are (link, arm).
    starts: Vec<u32>,
    touches: Vec<[u32; 2]>,
    /// Links in the order of the unknowns.
    order: Vec<u32>,
    seen: Vec<bool>,
    /// First unknown of a rigid body by slot, for x, y and spin.
    bodies: Vec<[u32; 3]>,
    first: Vec<u32>,
    matrix: Skyline,
    right: Vec<f64>,
}

/// What a spring is in the linearized system.
#[derive(Clone, Copy)]
struct State {
    /// Unknowns of the normal force and of the friction.
    unknown: [u32; 2],
    /// d of both; `NAN`: no unknown.
    softness: [f64; 2],
    /// What is wanted, in units of the gap.
    wanted: [f64; 2],
    /// Change of a sliding friction per normal force.
    follow: f64,
}

impl Newton {
    /// Moves the forces of an island by a `fraction` of the way to where its springs agree, were they as they are now.
    pub(super) fn predict(&mut self, island: &mut Island<'_>, fraction: f64) {
        self.look(island);
        self.touch(island);
        self.arrange(island);
        if self.number(island) {
            self.fill(island);
            if self.matrix.factor() {
                self.matrix.solve(&mut self.right);
                self.apply(island, fraction);
            }
        }
    }

    /// Who pushes, and how stiff. Forces that want to vanish do.
    fn look(&mut self, island: &mut Island<'_>) {
        self.state.clear();
        for i in 0..island.links.len() {
            let (mut state, link) = (State { unknown: [NONE; 2], softness: [f64::NAN; 2], wanted: [0.0; 2], follow: 0.0 }, island.links[i]);
            let terms = island.terms_of(i);
            let tied = matches!(terms.tangential, Tangential::Tied);
            if link.force == 0.0 && link.friction == 0.0 && !tied || link.compliance <= 0.0 {
                self.state.push(state);
                continue;
            }
            let free = island.gap_without(i);
            let scale = DIFFERENCE * (free.abs() + link.gap_old.abs() + link.compliance * link.force.abs());
            let force = island.normal_force(i, free);
            let slope = (island.normal_force(i, free - scale) - force) / scale;
            if slope > 0.0 {
                state.softness[0] = (1.0 / slope - link.compliance).max(SOFTNESS * link.compliance);
                state.wanted[0] = link.compliance + state.softness[0];
            } else {
                island.push(i, force - link.force, 0.0);
                island.links[i].force = force;
            }
            self.look_along(island, i, &mut state);
            self.state.push(state);
        }
        // The residuals once all that is given is given.
        for (i, state) in self.state.iter_mut().enumerate() {
            if !state.softness[0].is_nan() {
                let force = island.normal_force(i, island.gap_without(i));
                state.wanted[0] *= force - island.links[i].force;
            }
            if !state.softness[1].is_nan() {
                let tied = matches!(island.terms_of(i).tangential, Tangential::Tied);
                let friction = if tied { island.tie(i) } else { island.slide(i).friction };
                state.wanted[1] *= friction - island.links[i].friction;
            }
        }
    }

    /// The same along the surface.
    fn look_along(&self, island: &mut Island<'_>, i: usize, state: &mut State) {
        let link = island.links[i];
        let half = 0.5 * island.time_steps[1];
        let stick = island.stick(i);
        let softness = match island.terms_of(i).tangential {
            Tangential::Free => return,
            Tangential::Friction(_) => {
                let found = island.slide(i);
                if found.slides || link.force == 0.0 || stick.compliance <= 0.0 {
                    island.push(i, 0.0, found.friction - link.friction);
                    island.links[i].friction = found.friction;
                    let more = 1.0 + DIFFERENCE;
                    if found.slides && link.force > 0.0 {
                        let limits = [link.force, more * link.force].map(|force| island.limit(i, force));
                        state.follow = found.friction.signum() * (limits[1] - limits[0]) / (DIFFERENCE * link.force);
                    }
                    return;
                }
                stick.softness()
            }
            Tangential::Tied if stick.compliance > 0.0 => stick.tie_softness(),
            Tangential::Tied => return,
        };
        let softness = (softness + link.lent[1]).max(SOFTNESS * stick.compliance);
        state.softness[1] = half * softness;
        state.wanted[1] = half * (softness + link.slip_compliance);
    }

    /// The unknown springs at every slot.
    fn touch(&mut self, island: &Island<'_>) {
        let slots = island.slots.len();
        self.starts.clear();
        self.starts.resize(slots + 1, 0);
        let links = || island.links.iter().zip(&self.state).enumerate().filter(|(_, (_, state))| state.is_unknown());
        for arm in links().flat_map(|(_, (link, _))| &island.arms[link.arms()]) {
            self.starts[arm.slot as usize + 1] += 1;
        }
        for slot in 0..slots {
            self.starts[slot + 1] += self.starts[slot];
        }
        self.touches.clear();
        self.touches.resize(self.starts[slots] as usize, [0; 2]);
        for (i, (link, _)) in links() {
            for k in link.arms() {
                let at = &mut self.starts[island.arms[k].slot as usize];
                self.touches[*at as usize] = [i as u32, k as u32];
                *at += 1;
            }
        }
        // Now each start is the end of its slot, that is the start of the next.
        self.starts.rotate_right(1);
        self.starts[0] = 0;
    }

    /// The springs from neighbour to neighbour, each part of the island from one of its ends.
    fn arrange(&mut self, island: &Island<'_>) {
        self.order.clear();
        self.seen.clear();
        self.seen.resize(island.links.len() + island.slots.len(), false);
        for i in 0..island.links.len() {
            if !self.state[i].is_unknown() || self.seen[i] {
                continue;
            }
            // Once for the farthest spring, once from there.
            let begin = self.order.len();
            self.spread(island, i);
            let last = self.order.last().map_or(i, |&last| last as usize);
            for k in begin..self.order.len() {
                let link = self.order[k] as usize;
                self.seen[link] = false;
                for arm in &island.arms[island.links[link].arms()] {
                    self.seen[island.links.len() + arm.slot as usize] = false;
                }
            }
            self.order.truncate(begin);
            self.spread(island, last);
            self.order[begin..].reverse();
        }
    }

    /// Appends what is connected to `from` by nodes, the nearest first.
    fn spread(&mut self, island: &Island<'_>, from: usize) {
        let links = island.links.len();
        let mut next = self.order.len();
        self.order.push(from as u32);
        self.seen[from] = true;
        while let Some(&link) = self.order.get(next) {
            next += 1;
            for arm in &island.arms[island.links[link as usize].arms()] {
                let slot = arm.slot as usize;
                if std::mem::replace(&mut self.seen[links + slot], true) || island.slots[slot].is_body {
                    continue;
                }
                for k in self.starts[slot]..self.starts[slot + 1] {
                    let [other, _] = self.touches[k as usize];
                    if !std::mem::replace(&mut self.seen[other as usize], true) {
                        self.order.push(other);
                    }
                }
            }
        }
    }

    /// Numbers the unknowns and finds the profile; `false`: there are none, or too much work.
    fn number(&mut self, island: &Island<'_>) -> bool {
        let mut count = 0;
        for &link in &self.order {
            let state = &mut self.state[link as usize];
            for axis in 0..2 {
                if !state.softness[axis].is_nan() {
                    state.unknown[axis] = count;
                    count += 1;
                }
            }
        }
        self.bodies.clear();
        self.first.clear();
        self.first.extend(0..count);
        for (slot, body) in island.slots.iter().enumerate() {
            self.bodies.push([NONE; 3]);
            let begin = self.starts[slot] as usize..self.starts[slot + 1] as usize;
            let unknowns =
                || self.touches[begin.clone()].iter().flat_map(|&[link, _]| self.state[link as usize].unknown).filter(|&u| u != NONE);
            let Some(low) = unknowns().min() else { continue };
            if !body.is_body {
                unknowns().for_each(|u| self.first[u as usize] = self.first[u as usize].min(low));
                continue;
            }
            let [x, _, y, spin] = body.mobility.0;
            for (axis, mobility) in [x, y, spin].into_iter().enumerate() {
                if mobility > 0.0 {
                    self.bodies[slot][axis] = self.first.len() as u32;
                    self.first.push(low);
                }
            }
        }
        // Normal force and friction of a spring know each other.
        for state in self.state.iter().filter(|state| !state.unknown.contains(&NONE)) {
            let [normal, along] = state.unknown.map(|u| u as usize);
            self.first[along] = self.first[along].min(self.first[normal]);
        }
        let work = self.first.iter().enumerate().map(|(row, &first)| (row - first as usize + 1).pow(2)).fold(0usize, usize::saturating_add);
        count > 0 && work <= (WORK[0] * self.first.len()).min(WORK[1])
    }

    /// Matrix and right side.
    fn fill(&mut self, island: &Island<'_>) {
        let half = 0.5 * island.time_steps[1];
        self.matrix.reset(&self.first);
        self.right.clear();
        self.right.resize(self.first.len(), 0.0);
        for state in &self.state {
            for axis in 0..2 {
                if state.unknown[axis] != NONE {
                    let u = state.unknown[axis] as usize;
                    self.matrix.add(u, u, state.softness[axis]);
                    self.right[u] = state.wanted[axis];
                }
            }
        }
        for slot in 0..island.slots.len() {
            let (mobility, unknowns) = (island.slots[slot].mobility, self.bodies[slot]);
            let touches = self.starts[slot] as usize..self.starts[slot + 1] as usize;
            for &[i, k] in &self.touches[touches.clone()] {
                let (state, columns) = (&self.state[i as usize], self.state[i as usize].columns(island, k as usize));
                if island.slots[slot].is_body {
                    let rows = [island.arms[k as usize].row, island.slips[k as usize]];
                    for (axis, body) in unknowns.into_iter().enumerate().filter(|(_, body)| *body != NONE) {
                        for (own, u) in state.unknown.into_iter().enumerate().filter(|(_, u)| *u != NONE) {
                            self.matrix.add(u as usize, body as usize, half * rows[own][axis]);
                            self.matrix.add(body as usize, u as usize, half * columns[own][axis]);
                        }
                    }
                    continue;
                }
                let responses = columns.map(|column| mobility.response(column).map(|v| half * v));
                for &[j, l] in &self.touches[touches.clone()] {
                    let rows = [island.arms[l as usize].row, island.slips[l as usize]];
                    for (v, row) in self.state[j as usize].unknown.into_iter().zip(rows).filter(|(v, _)| *v != NONE) {
                        for (u, response) in state.unknown.into_iter().zip(responses).filter(|(u, _)| *u != NONE) {
                            self.matrix.add(v as usize, u as usize, dot(row, response));
                        }
                    }
                }
            }
            let [x, _, y, spin] = mobility.0;
            for (body, mobility) in unknowns.into_iter().zip([x, y, spin]).filter(|(body, _)| *body != NONE) {
                self.matrix.add(body as usize, body as usize, -half / mobility);
            }
        }
    }

    /// Adds the steps to the forces, within their bounds.
    fn apply(&self, island: &mut Island<'_>, fraction: f64) {
        for (i, state) in self.state.iter().enumerate() {
            let mut step = state.unknown.map(|u| if u == NONE { 0.0 } else { fraction * self.right[u as usize] });
            if step == [0.0; 2] || !(step[0] + step[1]).is_finite() {
                continue;
            }
            let link = &island.links[i];
            if !matches!(island.terms_of(i).tangential, Tangential::Tied) {
                step[0] = step[0].max(-link.force);
                let limit = island.limit(i, link.force + step[0]);
                step[1] = (link.friction + step[1] + state.follow * step[0]).clamp(-limit, limit) - link.friction;
            }
            island.push(i, step[0], step[1]);
        }
    }
}

impl State {
    fn is_unknown(&self) -> bool {
        self.softness.iter().any(|softness| !softness.is_nan())
    }

    /// Columns of the arm `k` for a unit of the normal force, with the friction that follows it, and of friction.
    fn columns(&self, island: &Island<'_>, k: usize) -> [[f64; 3]; 2] {
        let (Arm { row, .. }, slip) = (island.arms[k], island.slips[k]);
        [[0, 1, 2].map(|d| row[d] + self.follow * slip[d]), slip]
    }
}
