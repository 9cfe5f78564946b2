//! Prediction of the forces in an island: Newton's step for all springs that push, by a direct solution of
//! the linearized system.
//!
//! Islands come from [`super::relax`], which calls where sweeps are slow: springs much stiffer than the nodes
//! between them, or more of them than the nodes have ways to move. The change of a spring's force with the
//! gap that it would have without it, s = −dF/dg_free, is that of a compliance d + c with its own c = Σ
//! row·response: d = 2/k of a closed linear spring, zero of a multiplier. So the steps of the forces obey
//!
//! (d_i + A_ii) ΔF_i + Σ_j A_ij ΔF_j = r_i / s_i, A_ij = ½ dt row_i · response_j, r_i what the law would
//! change,
//!
//! with friction that sticks as unknowns of the same kind and friction that slides as a multiple of its
//! normal force; in 3D it has an unknown across itself. Springs in line along a surface only know their
//! neighbours: they are ordered from one end to the other (Cuthill and McKee), rigid bodies come last as
//! unknowns of their own, and the solution costs as much as a few sweeps. Where springs say the same twice
//! the forces are not unique (the motion is); [`SOFTNESS`] keeps the factors then. Nothing is trusted: sweeps
//! confirm or continue.

use super::couple::{Forces, Rates, SlotArm};
use super::friction::FrictionInput;
use super::link::Link;
use super::relax::Island;
use super::skyline::Skyline;
use super::{TangentSpace, Tangential, sum_along};
use crate::rigid::RigidMotion;
use crate::tensor::Dim;

/// Least d of an unknown, as a fraction of its c.
const SOFTNESS: f64 = 1e-10;
/// Difference of gaps by which slopes are found, as a fraction of the gaps.
const DIFFERENCE: f64 = 1e-6;
/// Multiplications that a solution may take per unknown, and in all.
const WORK: [usize; 2] = [10_000, 100_000_000];
/// Springs of an island from which on it is measured before its springs are looked at.
const LARGE: usize = 2_000;
/// No unknown.
const NONE: u32 = u32::MAX;

/// Memory for predictions.
#[derive(Default)]
pub(super) struct Newton<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    state: Vec<State<D>>,
    /// Links in the order of the unknowns.
    order: Vec<u32>,
    seen: Vec<bool>,
    /// Unknowns of a rigid body by slot, one for each velocity.
    bodies: Vec<<Dim<D> as RigidMotion<D>>::Generalized<u32>>,
    first: Vec<u32>,
    matrix: Skyline,
    right: Vec<f64>,
}

/// What a spring is in the linearized system.
#[derive(Clone, Copy)]
struct State<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Unknowns of the normal force and of the friction along each tangent.
    unknown: [u32; D],
    /// d of each; `NAN`: no unknown.
    softness: [f64; D],
    /// From forces to the units of the gap.
    scale: [f64; D],
    /// What is wanted, in units of the gap.
    wanted: [f64; D],
    /// Change of a sliding friction per normal force.
    follow: <Dim<D> as TangentSpace<D>>::TangentVector<f64>,
    /// Direction of each unknown of the friction along the surface.
    along: <Dim<D> as TangentSpace<D>>::TangentVector<<Dim<D> as TangentSpace<D>>::TangentVector<f64>>,
}

impl<const D: usize> Newton<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Moves the forces of an island by a `fraction` of the way to where its springs agree, were they as they
    /// are now; `false`: the island is far too wide for that, and stays so.
    pub(super) fn predict(&mut self, island: &mut Island<'_, D>, fraction: f64) -> bool {
        if self.is_wide(island) {
            return false;
        }
        self.look(island);
        self.arrange(island);
        if self.number(island) {
            self.fill(island);
            if self.matrix.factor() {
                self.matrix.solve(&mut self.right);
                self.apply(island, fraction);
            }
        }
        true
    }

    /// Whether the matrix of a large island is seen to be too much work before its springs are looked at:
    /// those that push are taken neighbour by neighbour, and where the fronts get so wide that half of them
    /// all along were too much, nothing else needs to be known.
    fn is_wide(&mut self, island: &Island<'_, D>) -> bool {
        let links = island.links.len();
        if links < LARGE {
            return false;
        }
        let pushes = |link: usize| island.forces[link] != [0.0; D];
        let limit = WORK[1].min(WORK[0] * links);
        let (mut work, mut next) = (0usize, 0);
        self.order.clear();
        self.seen.clear();
        self.seen.resize(links, false);
        for first in 0..links {
            if !pushes(first) || std::mem::replace(&mut self.seen[first], true) {
                continue;
            }
            self.order.push(first as u32);
            while next < self.order.len() {
                let end = self.order.len();
                work = work.saturating_add((end - next) * ((end - next) / 2).pow(2));
                if work > limit {
                    return true;
                }
                for k in next..end {
                    for &other in island.couplings.neighbours(self.order[k] as usize) {
                        if pushes(other as usize) && !std::mem::replace(&mut self.seen[other as usize], true) {
                            self.order.push(other);
                        }
                    }
                }
                next = end;
            }
        }
        false
    }

    /// Who pushes, and how stiff. Forces that want to vanish do.
    fn look(&mut self, island: &mut Island<'_, D>) {
        self.state.clear();
        let mut moved = false;
        for i in 0..island.links.len() {
            let mut state = State::none();
            let tied = matches!(island.terms_of(i).tangential, Tangential::Tied);
            if (island.forces[i] != [0.0; D] || tied) && island.links[i].compliance > 0.0 {
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
    fn look_across(&self, island: &mut Island<'_, D>, i: usize, rates: Rates<D>, state: &mut State<D>) {
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
            let mut step = [0.0; D];
            step[0] = force - before;
            island.push(i, step);
            island.forces[i][0] = force;
        }
    }

    /// The same along the surface.
    fn look_along(&self, island: &mut Island<'_, D>, i: usize, rates: Rates<D>, state: &mut State<D>) {
        let half = 0.5 * island.laws.time_steps[1];
        let tangential = island.terms_of(i).tangential;
        if matches!(tangential, Tangential::Free) {
            return;
        }
        let (forces, stick) = (island.forces[i], island.stick_from(i, rates));
        let force = forces[0];
        let gives = |a: usize| stick.compliance[a][a] > 0.0;
        let (softness, found) = match tangential {
            Tangential::Friction(_) => {
                let found = island.slide_from(i, rates);
                if found.slides || force == 0.0 || !(0..D - 1).any(gives) {
                    give(island, i, |a| Some(found.friction[a]));
                    let more = 1.0 + DIFFERENCE;
                    if found.slides && force > 0.0 {
                        let limits = [force, more * force].map(|force| island.limit(i, force));
                        let direction = Dim::<D>::direction(&found.friction);
                        state.follow = Dim::<D>::tangent_vector(|a| direction[a] * (limits[1] - limits[0]) / (DIFFERENCE * force));
                        self.look_aside(island, i, &stick, &found.friction, state);
                    }
                    return;
                }
                (stick.softness(), found.friction)
            }
            _ if (0..D - 1).any(gives) => (stick.tie_softness(), island.tie_from(i, rates)),
            _ => return,
        };
        // Where nothing yields the force is what it is.
        if matches!(tangential, Tangential::Friction(_)) && !(0..D - 1).all(gives) {
            give(island, i, |a| (!gives(a)).then_some(found[a]));
        }
        let Link { lent, .. } = island.links[i];
        for a in (0..D - 1).filter(|&a| gives(a)) {
            let softness = (softness + lent[1]).max(SOFTNESS * stick.compliance[a][a]);
            state.softness[a + 1] = half * softness;
            state.scale[a + 1] = half * (softness + island.links[i].own(a + 1, a + 1));
        }
        state.want_along(&island.links[i], half, |a| found[a] - forces[a + 1]);
    }

    /// Across a friction that slides.
    fn look_aside(
        &self,
        island: &Island<'_, D>,
        i: usize,
        stick: &FrictionInput<D>,
        friction: &<Dim<D> as TangentSpace<D>>::TangentVector<f64>,
        state: &mut State<D>,
    ) {
        let link = &island.links[i];
        let slip = island.laws.slip(link.spring).slip;
        let Some((direction, softness)) = Dim::<D>::lateral_compliance(stick, slip, friction) else { return };
        let (half, own) = (0.5 * island.laws.time_steps[1], link.own_along(&direction));
        if own > 0.0 {
            let softness = (softness + link.lent[1]).max(SOFTNESS * own);
            state.along[0] = direction;
            state.softness[1] = half * softness;
            state.scale[1] = half * (softness + own);
        }
    }

    /// What is wanted once all that is given is given.
    fn look_again(&mut self, island: &Island<'_, D>) {
        for (i, state) in self.state.iter_mut().enumerate().filter(|(_, state)| state.is_unknown()) {
            let (rates, forces) = (island.rates(i), island.forces[i]);
            if !state.softness[0].is_nan() {
                state.wanted[0] = state.scale[0] * (island.normal_force(i, island.gap_from(i, rates)) - forces[0]);
            }
            if state.softness[1..].iter().any(|softness| !softness.is_nan()) {
                let tied = matches!(island.terms_of(i).tangential, Tangential::Tied);
                let found = if tied { island.tie_from(i, rates) } else { island.slide_from(i, rates).friction };
                state.want_along(&island.links[i], 0.5 * island.laws.time_steps[1], |a| found[a] - forces[a + 1]);
            }
        }
    }

    /// The springs from neighbour to neighbour, each part of the island from one of its ends.
    fn arrange(&mut self, island: &Island<'_, D>) {
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
    fn spread(&mut self, island: &Island<'_, D>, from: usize) {
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
                    island.couplings.touches(slot).iter().for_each(|other| self.see(other.link));
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
    fn number(&mut self, island: &Island<'_, D>) -> bool {
        let mut count = 0;
        for &link in &self.order {
            let state = &mut self.state[link as usize];
            for axis in 0..D {
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
            self.bodies.push(Dim::<D>::generalized(|_| NONE));
            if !hub.is_hub {
                continue;
            }
            let touches = island.couplings.touches(slot);
            let low = touches.iter().map(|touch| self.state[touch.link as usize].lowest()).min().unwrap_or(NONE);
            if low == NONE {
                continue;
            }
            if !hub.is_body {
                touches.iter().for_each(|touch| begin_at(&mut self.first, self.state[touch.link as usize].unknown, low));
                continue;
            }
            for axis in (0..Dim::<D>::FREEDOMS).filter(|&axis| Dim::<D>::is_free(&hub.mobility, axis)) {
                self.bodies[slot][axis] = self.first.len() as u32;
                self.first.push(low);
            }
        }
        // Normal force and friction of a spring know each other.
        for state in &self.state {
            let mut known = state.unknown.into_iter().filter(|&u| u != NONE).map(|u| u as usize);
            if let Some(lowest) = known.next() {
                known.for_each(|along| self.first[along] = self.first[along].min(self.first[lowest]));
            }
        }
        let work = self.first.iter().enumerate().map(|(row, &first)| (row - first as usize + 1).pow(2)).fold(0usize, usize::saturating_add);
        count > 0 && work <= (WORK[0] * self.first.len()).min(WORK[1])
    }

    /// Matrix and right side.
    fn fill(&mut self, island: &Island<'_, D>) {
        let half = 0.5 * island.laws.time_steps[1];
        self.matrix.reset(&self.first);
        self.right.clear();
        self.right.resize(self.first.len(), 0.0);
        for state in &self.state {
            for axis in 0..D {
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
            for &SlotArm { link: j, arm: l, .. } in touches.iter().filter(|touch| self.state[touch.link as usize].is_unknown()) {
                let responses = island.rows(l as usize).map(|row| Dim::<D>::response(&mobility, &row));
                for &SlotArm { link: i, arm: k, .. } in touches {
                    let states = [i, j].map(|link| &self.state[link as usize]);
                    add(
                        &mut self.matrix,
                        states,
                        half,
                        island.rows(k as usize).map(|row| responses.map(|response| Dim::<D>::dot(&row, &response))),
                    );
                }
            }
        }
    }

    /// A rigid body as unknowns of its own.
    fn fill_body(&mut self, island: &Island<'_, D>, slot: usize) {
        let half = 0.5 * island.laws.time_steps[1];
        let unknowns = self.bodies[slot];
        for &SlotArm { link: i, arm: k, .. } in island.couplings.touches(slot) {
            let (state, rows) = (self.state[i as usize], island.rows(k as usize));
            let row = |own: usize, axis: usize| match own {
                0 => rows[0][axis],
                own => sum_along::<D>(|a| state.along[own - 1][a] * rows[a + 1][axis]),
            };
            let column = |own: usize, axis: usize| match own {
                0 => (1..D).fold(rows[0][axis], |sum, a| sum + state.follow[a - 1] * rows[a][axis]),
                own => row(own, axis),
            };
            for (axis, &body) in unknowns.as_ref().iter().enumerate().filter(|(_, body)| **body != NONE) {
                for (own, u) in state.unknown.into_iter().enumerate().filter(|(_, u)| *u != NONE) {
                    self.matrix.add(u as usize, body as usize, half * row(own, axis));
                    self.matrix.add(body as usize, u as usize, half * column(own, axis));
                }
            }
        }
        let matrix = &mut self.matrix;
        Dim::<D>::inverse(&island.slots[slot].mobility, -half, |i, j, value| {
            if unknowns[i] != NONE && unknowns[j] != NONE {
                matrix.add(unknowns[i] as usize, unknowns[j] as usize, value);
            }
        });
    }

    /// Adds the steps to the forces, within their bounds.
    fn apply(&self, island: &mut Island<'_, D>, fraction: f64) {
        for (i, state) in self.state.iter().enumerate() {
            let mut step = state.unknown.map(|u| if u == NONE { 0.0 } else { fraction * self.right[u as usize] });
            if step == [0.0; D] || !(1..D).fold(step[0], |sum, axis| sum + step[axis]).is_finite() {
                continue;
            }
            let forces = island.forces[i];
            if !matches!(island.terms_of(i).tangential, Tangential::Tied) {
                step[0] = step[0].max(-forces[0]);
                let limit = island.limit(i, forces[0] + step[0]);
                let wanted = Dim::<D>::tangent_vector(|a| {
                    forces[a + 1] + sum_along::<D>(|u| step[u + 1] * state.along[u][a]) + state.follow[a] * step[0]
                });
                let within = Dim::<D>::within(wanted, limit);
                (1..D).for_each(|axis| step[axis] = within[axis - 1] - forces[axis]);
            }
            island.push(i, step);
        }
    }
}

impl<const D: usize> State<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Of a spring without unknowns.
    fn none() -> Self {
        Self {
            unknown: [NONE; D],
            softness: [f64::NAN; D],
            scale: [0.0; D],
            wanted: [0.0; D],
            follow: Default::default(),
            along: Dim::<D>::tangent_vector(|a| Dim::<D>::tangent_vector(|b| f64::from(u8::from(a == b)))),
        }
    }

    /// Notes what friction would change, as far as it is unknown.
    fn want_along(&mut self, link: &Link<D>, half: f64, change: impl Fn(usize) -> f64) {
        let known = self.softness;
        let part = |along: &<Dim<D> as TangentSpace<D>>::TangentVector<f64>| sum_along::<D>(|a| along[a] * change(a));
        for u in (0..D - 1).filter(|&u| !known[u + 1].is_nan()) {
            let others =
                (0..D - 1).filter(|&v| v != u && !known[v + 1].is_nan()).map(|v| half * link.own(u + 1, v + 1) * part(&self.along[v]));
            self.wanted[u + 1] = others.fold(self.scale[u + 1] * part(&self.along[u]), |sum, other| sum + other);
        }
    }

    fn is_unknown(&self) -> bool {
        self.softness.iter().any(|softness| !softness.is_nan())
    }

    /// The first of its unknowns; [`NONE`]: it has none.
    fn lowest(&self) -> u32 {
        self.unknown.into_iter().fold(NONE, u32::min)
    }
}

/// Rows of unknowns begin not after the column `low`.
fn begin_at<const D: usize>(first: &mut [u32], unknowns: [u32; D], low: u32) {
    for u in unknowns.into_iter().filter(|&u| u != NONE) {
        let first = &mut first[u as usize];
        *first = low.min(*first);
    }
}

/// Adds what the forces of the second of two springs do to the rates of gap and slip of the first, times
/// `half` a step.
#[inline]
fn add<const D: usize>(matrix: &mut Skyline, [on, by]: [&State<D>; 2], half: f64, pair: [[f64; D]; D])
where
    Dim<D>: TangentSpace<D>,
{
    for axis in 0..D {
        let row = on.unknown[axis];
        if row == NONE {
            continue;
        }
        let seen = |by: usize| match axis {
            0 => pair[0][by],
            axis => sum_along::<D>(|a| on.along[axis - 1][a] * pair[a + 1][by]),
        };
        if by.unknown[0] != NONE {
            let sum = (1..D).fold(seen(0), |sum, a| sum + by.follow[a - 1] * seen(a));
            matrix.add(row as usize, by.unknown[0] as usize, half * sum);
        }
        for u in 1..D {
            if by.unknown[u] != NONE {
                matrix.add(row as usize, by.unknown[u] as usize, half * sum_along::<D>(|a| by.along[u - 1][a] * seen(a + 1)));
            }
        }
    }
}

/// Gives a spring the friction that is named along its tangents.
fn give<const D: usize>(island: &mut Island<'_, D>, i: usize, named: impl Fn(usize) -> Option<f64>)
where
    Dim<D>: TangentSpace<D>,
{
    let (mut step, before): (Forces<D>, Forces<D>) = ([0.0; D], island.forces[i]);
    (0..D - 1).for_each(|a| step[a + 1] = named(a).map_or(0.0, |friction| friction - before[a + 1]));
    island.push(i, step);
    (0..D - 1).for_each(|a| island.forces[i][a + 1] = named(a).unwrap_or(before[a + 1]));
}

/// What the forces of a spring do to its own rates by way of what is no hub.
fn own<const D: usize>(island: &Island<'_, D>, i: usize) -> [[f64; D]; D]
where
    Dim<D>: TangentSpace<D>,
{
    let link = &island.links[i];
    if !link.is_at_hub {
        return std::array::from_fn(|on| std::array::from_fn(|by| link.own(on, by)));
    }
    let mut sums = [[0.0; D]; D];
    for k in link.arms() {
        let (slot, rows) = (&island.slots[island.arms[k].slot as usize], island.rows(k));
        if slot.is_hub {
            continue;
        }
        for by in 0..D {
            let response = Dim::<D>::response(&slot.mobility, &rows[by]);
            (by..D).for_each(|on| sums[on][by] += Dim::<D>::dot(&rows[on], &response));
        }
    }
    std::array::from_fn(|on| std::array::from_fn(|by| sums[on.max(by)][on.min(by)]))
}
