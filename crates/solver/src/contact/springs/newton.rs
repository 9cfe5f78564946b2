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
use super::couple::Rates;
use super::link::{Link, dot};
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
    /// From forces to the units of the gap.
    scale: [f64; 2],
    /// What is wanted, in units of the gap.
    wanted: [f64; 2],
    /// Change of a sliding friction per normal force.
    follow: f64,
}

impl Newton {
    /// Moves the forces of an island by a `fraction` of the way to where its springs agree, were they as they are now.
    pub(super) fn predict(&mut self, island: &mut Island<'_>, fraction: f64) {
        self.look(island);
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
        let mut moved = false;
        for i in 0..island.links.len() {
            let mut state = State { unknown: [NONE; 2], softness: [f64::NAN; 2], scale: [0.0; 2], wanted: [0.0; 2], follow: 0.0 };
            let tied = matches!(island.terms_of(i).tangential, Tangential::Tied);
            if (island.forces[i] != [0.0; 2] || tied) && island.links[i].compliance > 0.0 {
                let before = island.forces[i];
                let rates = island.rates(i);
                self.look_across(island, i, rates, &mut state);
                self.look_along(island, i, rates, &mut state);
                moved |= island.forces[i] != before;
            }
            self.state.push(state);
        }
        if moved {
            self.look_again(island);
        }
    }

    /// Across the surface, where the other springs add `rates`.
    fn look_across(&self, island: &mut Island<'_>, i: usize, rates: Rates, state: &mut State) {
        let free = island.gap_from(i, rates);
        let Link { compliance, gap_old, .. } = island.links[i];
        let before = island.forces[i][0];
        let scale = DIFFERENCE * (free.abs() + gap_old.abs() + compliance * before.abs());
        let force = island.normal_force(i, free);
        let slope = (island.normal_force(i, free - scale) - force) / scale;
        if slope > 0.0 {
            state.softness[0] = (1.0 / slope - compliance).max(SOFTNESS * compliance);
            state.scale[0] = compliance + state.softness[0];
            state.wanted[0] = state.scale[0] * (force - before);
        } else {
            island.push(i, [force - before, 0.0]);
            island.forces[i][0] = force;
        }
    }

    /// The same along the surface.
    fn look_along(&self, island: &mut Island<'_>, i: usize, rates: Rates, state: &mut State) {
        let half = 0.5 * island.time_steps[1];
        let tangential = island.terms_of(i).tangential;
        if matches!(tangential, Tangential::Free) {
            return;
        }
        let ([force, friction], stick) = (island.forces[i], island.stick_from(i, rates));
        let (softness, found) = match tangential {
            Tangential::Friction(_) => {
                let found = island.slide_from(i, rates);
                if found.slides || force == 0.0 || stick.compliance <= 0.0 {
                    island.push(i, [0.0, found.friction - friction]);
                    island.forces[i][1] = found.friction;
                    let more = 1.0 + DIFFERENCE;
                    if found.slides && force > 0.0 {
                        let limits = [force, more * force].map(|force| island.limit(i, force));
                        state.follow = found.friction.signum() * (limits[1] - limits[0]) / (DIFFERENCE * force);
                    }
                    return;
                }
                (stick.softness(), found.friction)
            }
            _ if stick.compliance > 0.0 => (stick.tie_softness(), island.tie_from(i, rates)),
            _ => return,
        };
        let Link { lent, own, .. } = island.links[i];
        let softness = (softness + lent[1]).max(SOFTNESS * stick.compliance);
        state.softness[1] = half * softness;
        state.scale[1] = half * (softness + own[2]);
        state.wanted[1] = state.scale[1] * (found - friction);
    }

    /// What is wanted once all that is given is given.
    fn look_again(&mut self, island: &Island<'_>) {
        for (i, state) in self.state.iter_mut().enumerate().filter(|(_, state)| state.is_unknown()) {
            let (rates, [force, friction]) = (island.rates(i), island.forces[i]);
            if !state.softness[0].is_nan() {
                state.wanted[0] = state.scale[0] * (island.normal_force(i, island.gap_from(i, rates)) - force);
            }
            if !state.softness[1].is_nan() {
                let tied = matches!(island.terms_of(i).tangential, Tangential::Tied);
                let found = if tied { island.tie_from(i, rates) } else { island.slide_from(i, rates).friction };
                state.wanted[1] = state.scale[1] * (found - friction);
            }
        }
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
            for &other in island.couplings.neighbours(link as usize) {
                self.see(other);
            }
            if !island.links[link as usize].is_at_hub {
                continue;
            }
            for slot in island.arms[island.links[link as usize].arms()].iter().map(|arm| arm.slot as usize) {
                let is_joint = island.slots[slot].is_hub && !island.slots[slot].is_body;
                if is_joint && !std::mem::replace(&mut self.seen[links + slot], true) {
                    island.couplings.touches(slot).iter().for_each(|&[other, _]| self.see(other));
                }
            }
        }
    }

    /// Appends an unknown spring that was not there yet.
    fn see(&mut self, link: u32) {
        if self.state[link as usize].is_unknown() && !std::mem::replace(&mut self.seen[link as usize], true) {
            self.order.push(link);
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
        for &link in &self.order {
            let low = |j: &u32| self.state[*j as usize].lowest();
            let low = island.couplings.neighbours(link as usize).iter().map(low).min().unwrap_or(NONE);
            begin_at(&mut self.first, self.state[link as usize].unknown, low);
        }
        for (slot, hub) in island.slots.iter().enumerate() {
            self.bodies.push([NONE; 3]);
            if !hub.is_hub {
                continue;
            }
            let touches = island.couplings.touches(slot);
            let low = touches.iter().map(|&[link, _]| self.state[link as usize].lowest()).min().unwrap_or(NONE);
            if low == NONE {
                continue;
            }
            if !hub.is_body {
                touches.iter().for_each(|&[link, _]| begin_at(&mut self.first, self.state[link as usize].unknown, low));
                continue;
            }
            let [x, _, y, spin] = hub.mobility.0;
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
        for &link in &self.order {
            let (i, couplings) = (link as usize, island.couplings);
            add(&mut self.matrix, [&self.state[i]; 2], half, own(island, i));
            couplings.pairs(i).for_each(|(j, pair)| add(&mut self.matrix, [&self.state[i], &self.state[j]], half, pair));
        }
        for slot in (0..island.slots.len()).filter(|&slot| island.slots[slot].is_hub) {
            if island.slots[slot].is_body {
                self.fill_body(island, slot);
                continue;
            }
            let (mobility, touches) = (island.slots[slot].mobility, island.couplings.touches(slot));
            for &[j, l] in touches.iter().filter(|&&[j, _]| self.state[j as usize].is_unknown()) {
                let responses = island.rows(l as usize).map(|row| mobility.response(row));
                for &[i, k] in touches {
                    let states = [i, j].map(|link| &self.state[link as usize]);
                    add(&mut self.matrix, states, half, island.rows(k as usize).map(|row| responses.map(|response| dot(row, response))));
                }
            }
        }
    }

    /// A rigid body as unknowns of its own.
    fn fill_body(&mut self, island: &Island<'_>, slot: usize) {
        let half = 0.5 * island.time_steps[1];
        let unknowns = self.bodies[slot];
        for &[i, k] in island.couplings.touches(slot) {
            let (state, [row, slip]) = (self.state[i as usize], island.rows(k as usize));
            let columns = [[0, 1, 2].map(|d| row[d] + state.follow * slip[d]), slip];
            for (axis, body) in unknowns.into_iter().enumerate().filter(|(_, body)| *body != NONE) {
                for (own, u) in state.unknown.into_iter().enumerate().filter(|(_, u)| *u != NONE) {
                    self.matrix.add(u as usize, body as usize, half * [row, slip][own][axis]);
                    self.matrix.add(body as usize, u as usize, half * columns[own][axis]);
                }
            }
        }
        let [x, _, y, spin] = island.slots[slot].mobility.0;
        for (body, mobility) in unknowns.into_iter().zip([x, y, spin]).filter(|(body, _)| *body != NONE) {
            self.matrix.add(body as usize, body as usize, -half / mobility);
        }
    }

    /// Adds the steps to the forces, within their bounds.
    fn apply(&self, island: &mut Island<'_>, fraction: f64) {
        for (i, state) in self.state.iter().enumerate() {
            let mut step = state.unknown.map(|u| if u == NONE { 0.0 } else { fraction * self.right[u as usize] });
            if step == [0.0; 2] || !(step[0] + step[1]).is_finite() {
                continue;
            }
            let [force, friction] = island.forces[i];
            if !matches!(island.terms_of(i).tangential, Tangential::Tied) {
                step[0] = step[0].max(-force);
                let limit = island.limit(i, force + step[0]);
                step[1] = (friction + step[1] + state.follow * step[0]).clamp(-limit, limit) - friction;
            }
            island.push(i, step);
        }
    }
}

impl State {
    fn is_unknown(&self) -> bool {
        self.softness.iter().any(|softness| !softness.is_nan())
    }

    /// The first of its unknowns; [`NONE`]: it has none.
    fn lowest(&self) -> u32 {
        self.unknown[0].min(self.unknown[1])
    }
}

/// Rows of unknowns begin not after the column `low`.
fn begin_at(first: &mut [u32], unknowns: [u32; 2], low: u32) {
    for u in unknowns.into_iter().filter(|&u| u != NONE) {
        let first = &mut first[u as usize];
        *first = low.min(*first);
    }
}

/// Adds what the forces of the second of two springs do to the rates of gap and slip of the first, times `half` a step.
#[inline]
fn add(matrix: &mut Skyline, [on, by]: [&State; 2], half: f64, pair: [[f64; 2]; 2]) {
    for axis in [0, 1] {
        let (row, [by_normal, by_along]) = (on.unknown[axis], pair[axis]);
        if row == NONE {
            continue;
        }
        if by.unknown[0] != NONE {
            matrix.add(row as usize, by.unknown[0] as usize, half * (by_normal + by.follow * by_along));
        }
        if by.unknown[1] != NONE {
            matrix.add(row as usize, by.unknown[1] as usize, half * by_along);
        }
    }
}

/// What the forces of a spring do to its own rates by way of what is no hub.
fn own(island: &Island<'_>, i: usize) -> [[f64; 2]; 2] {
    let link = &island.links[i];
    let [mut gap, mut cross, mut slip] = link.own;
    if link.is_at_hub {
        [gap, cross, slip] = [0.0; 3];
        for k in link.arms() {
            let (slot, [row, along]) = (&island.slots[island.arms[k].slot as usize], island.rows(k));
            if !slot.is_hub {
                let response = slot.mobility.response(row);
                gap += dot(row, response);
                cross += dot(along, response);
                slip += dot(along, slot.mobility.response(along));
            }
        }
    }
    [[gap, cross], [cross, slip]]
}
