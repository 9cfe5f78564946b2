//! The springs of an island, relaxed until they agree: Gauss-Seidel over the springs in their order, normal
//! force and friction in turn.
//!
//! Links and arms come from [`super::link`], predictions from [`super::newton`] where sweeps are slow; only a
//! sweep that changes nothing ends the solution. For linear springs the matrix (2/k on the diagonal plus
//! compliances) is symmetric and positive definite, so sweeps converge; how fast depends on how much stiffer
//! the springs are than the nodes between them.

use super::couple::{Couplings, Forces, Rates};
use super::friction::{FrictionInput, FrictionResult};
use super::link::{Arm, Laws, Link, Row, Slips, Slot};
use super::newton::Newton;
use super::solve::Results;
use super::{Along, Closing, Patch, Slid, Solved, TangentSpace, Tangential, Terms};
use crate::rigid::RigidMotion;
use crate::tensor::Dim;
use embate_lanes::math;

/// An island is solved when a sweep changes no force by more than this fraction of the island's largest.
pub(super) const TOLERANCE: f64 = 1e-12;
/// Sweeps after which the forces are taken as they are.
pub(super) const SWEEPS: usize = 500;
/// Sweeps that a prediction is worth: if more are to be expected, it is made.
const WORTH: f64 = 8.0;
/// Predictions in a row; the sweeps between those that follow double each time.
const EAGER: usize = 16;
/// Compliance that constraints get while they are sought, as a fraction of that of what they act on.
const LENT: f64 = 1e-7;

/// Springs that share what they move.
pub(super) struct Island<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) links: &'a mut [Link<D>],
    pub(super) arms: &'a [Arm<D>],
    /// Rows of the slips, as `arms`; zero of springs that do not care, empty where none does.
    pub(super) slips: &'a [Slips<D>],
    pub(super) slots: &'a mut [Slot<D>],
    pub(super) couplings: &'a Couplings<D>,
    /// Of each link, as found so far.
    pub(super) forces: &'a mut [Forces<D>],
    pub(super) laws: Laws<'a, D>,
}

/// What a sweep did, N/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Change {
    /// Largest change of a force.
    pub(super) change: f64,
    /// Largest force.
    pub(super) largest: f64,
}

impl Change {
    #[inline]
    fn see(&mut self, step: f64, force: f64) {
        self.change = self.change.max(step.abs());
        self.largest = self.largest.max(force.abs());
    }

    fn is_small(self) -> bool {
        self.change <= TOLERANCE * self.largest
    }

    /// Sweeps that are still to be expected where the last one changed `before`.
    fn sweeps_left(self, before: f64) -> f64 {
        let rate = self.change / before;
        if rate < 1.0 { math::ln(TOLERANCE * self.largest / self.change) / math::ln(rate) } else { f64::INFINITY }
    }
}

/// What a solution took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Effort {
    /// Most sweeps over an island.
    pub(super) sweeps: usize,
    /// Whether the forces still changed after the last sweep that is allowed.
    pub(super) unsolved: bool,
}

/// How a solution goes.
#[derive(Clone, Copy)]
struct Pace {
    sweeps: usize,
    predictions: usize,
    /// Sweeps before a prediction.
    patience: usize,
    /// Fraction of its steps that are made.
    fraction: f64,
    /// Least change of a sweep over all springs.
    best: f64,
    /// Whether predictions are too much work.
    is_wide: bool,
}

impl Default for Pace {
    fn default() -> Self {
        Self { sweeps: 0, predictions: 0, patience: 1, fraction: 1.0, best: f64::INFINITY, is_wide: false }
    }
}

impl Pace {
    /// After a sweep over all springs that changed so much: predictions that lead nowhere are followed by
    /// shorter steps, which ends running in circles.
    fn after_sweep(&mut self, change: f64) {
        self.fraction = if change < 0.7 * self.best { 1.0 } else { (0.6 * self.fraction).max(0.1) };
        self.best = self.best.min(change);
        if self.predictions >= EAGER {
            self.patience *= 2;
        }
    }

    fn effort(self) -> Effort {
        Effort { sweeps: self.sweeps.min(SWEEPS), unsolved: self.sweeps >= SWEEPS }
    }
}

impl Effort {
    pub(super) fn join(&mut self, other: Self) {
        self.sweeps = self.sweeps.max(other.sweeps);
        self.unsolved |= other.unsolved;
    }
}

impl<const D: usize> Island<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Finds the forces; `newton` and `live` are memory to work in.
    pub(super) fn solve(&mut self, newton: &mut Newton<D>, live: &mut Vec<u32>) -> Effort {
        // All springs, then those that push until they agree, then all again: open ones are only looked at.
        let mut all = self.sweep_all();
        let mut pace = Pace { sweeps: 1, ..Pace::default() };
        // A spring alone without friction is solved by its law, unless it acts on a body at several places,
        // of which each feels what the others do.
        if self.links.len() == 1 && !self.links[0].is_at_hub && matches!(self.terms_of(0).tangential, Tangential::Free) {
            return pace.effort();
        }
        loop {
            while !all.is_small() {
                if pace.sweeps >= SWEEPS {
                    return pace.effort();
                }
                self.relax_live(live, all.change, newton, &mut pace);
                all = self.sweep_all();
                pace.sweeps += 1;
            }
            // With what was lent to constraints they hold where nothing is left of it.
            if pace.predictions == 0 || !self.centre() {
                return pace.effort();
            }
            all = self.sweep_all();
            pace.sweeps += 1;
            pace.best = f64::INFINITY;
            if all.is_small() {
                return pace.effort();
            }
        }
    }

    /// Sweeps over the springs that push, until nothing changes or a prediction has been made; `before` is
    /// the change of the sweep before.
    fn relax_live(&mut self, live: &mut Vec<u32>, before: f64, newton: &mut Newton<D>, pace: &mut Pace) {
        live.clear();
        live.extend((0..self.links.len() as u32).filter(|&i| self.forces[i as usize] != [0.0; D]));
        pace.after_sweep(before);
        let mut last = before;
        for sweep in 1.. {
            let now = self.sweep_live(live);
            pace.sweeps += 1;
            if now.is_small() || pace.sweeps >= SWEEPS {
                return;
            }
            if !pace.is_wide && sweep >= pace.patience && now.sweeps_left(last) > WORTH {
                if pace.predictions == 0 {
                    self.soften();
                }
                pace.predictions += 1;
                pace.is_wide = !newton.predict(self, pace.fraction);
                if !pace.is_wide {
                    return;
                }
            }
            last = now.change;
        }
    }

    /// Lends constraints a little compliance about the forces that they have: more constraints than ways to
    /// move contradict each other until the right ones are found.
    fn soften(&mut self) {
        for i in 0..self.links.len() {
            if !self.terms_of(i).law.is_elastic() {
                let link = &mut self.links[i];
                let along = (2..D).fold(link.own(1, 1), |most, a| most.max(link.own(a, a)));
                link.lent = [LENT * link.compliance, LENT * along];
                link.centre = self.forces[i];
            }
        }
    }

    /// Makes the forces that there are those about which constraints yield; `false`: there are no
    /// constraints.
    fn centre(&mut self) -> bool {
        let mut any = false;
        for (link, &forces) in self.links.iter_mut().zip(&*self.forces).filter(|(link, _)| link.lent != [0.0; 2]) {
            any = true;
            link.centre = forces;
        }
        any
    }

    fn sweep_all(&mut self) -> Change {
        let mut change = Change::default();
        (0..self.links.len()).for_each(|i| self.relax(i, &mut change));
        change
    }

    fn sweep_live(&mut self, live: &[u32]) -> Change {
        let mut change = Change::default();
        live.iter().for_each(|&i| self.relax(i as usize, &mut change));
        change
    }

    /// What acts in a spring.
    #[inline]
    pub(super) fn terms_of(&self, i: usize) -> &Terms {
        self.laws.terms(self.links[i].spring)
    }

    /// Gives a spring the forces that its law and friction want as the others are.
    #[inline]
    fn relax(&mut self, i: usize, sum: &mut Change) {
        let rates = self.rates(i);
        let old = self.forces[i];
        let force = self.normal_force(i, self.gap_from(i, rates));
        self.forces[i][0] = force;
        sum.see(force - old[0], force);
        let friction = self.friction_from(i, rates);
        for a in 0..D - 1 {
            self.forces[i][a + 1] = friction[a];
            sum.see(friction[a] - old[a + 1], friction[a]);
        }
        if self.links[i].is_at_hub {
            let forces = self.forces[i];
            self.report_hubs(i, std::array::from_fn(|k| forces[k] - old[k]));
        }
    }

    /// Friction that a spring wants where the others add `rates` to its own.
    #[inline]
    fn friction_from(&mut self, i: usize, rates: Rates<D>) -> Along<D> {
        let tangential = self.terms_of(i).tangential;
        match tangential {
            Tangential::Free => Along::<D>::default(),
            Tangential::Friction(_) => {
                // What is open has slid nowhere, whatever an earlier sweep gave it.
                let found = if self.forces[i] == [0.0; D] { FrictionResult::default() } else { self.slide_from(i, rates) };
                (self.links[i].slip_new, self.links[i].slides) = (found.slip, found.slides);
                found.friction
            }
            Tangential::Tied => self.tie_from(i, rates),
        }
    }

    /// What the forces of the others add to the rates of a spring.
    #[inline]
    pub(super) fn rates(&self, i: usize) -> Rates<D> {
        let mut rates = self.couplings.rates(i, self.forces);
        let link = &self.links[i];
        if link.is_at_hub {
            for k in link.arms() {
                let slot = &self.slots[self.arms[k].slot as usize];
                if slot.is_hub {
                    let own = Dim::<D>::response(&slot.mobility, &self.pull(k, self.forces[i]));
                    let others = Dim::<D>::generalized(|d| slot.change[d] - own[d]);
                    rates[0] += Dim::<D>::dot(&self.arms[k].row, &others);
                    if let Some(slips) = self.slips.get(k) {
                        for a in 0..D - 1 {
                            rates[a + 1] += Dim::<D>::dot(&slips[a], &others);
                        }
                    }
                }
            }
        }
        rates
    }

    /// Rows of the gap and of the slips at the arm `k`.
    #[inline]
    pub(super) fn rows(&self, k: usize) -> [Row<D>; D] {
        let slips = self.slips.get(k);
        std::array::from_fn(|axis| if axis == 0 { self.arms[k].row } else { slips.map_or_else(Default::default, |slips| slips[axis - 1]) })
    }

    /// Force of a spring on what is at its arm `k`.
    fn pull(&self, k: usize, forces: Forces<D>) -> Row<D> {
        let rows = self.rows(k);
        Dim::<D>::generalized(|d| {
            let mut sum = rows[0][d] * forces[0];
            for axis in 1..D {
                sum += rows[axis][d] * forces[axis];
            }
            sum
        })
    }

    /// Velocities of hubs follow the changes of a spring's forces.
    fn report_hubs(&mut self, i: usize, step: Forces<D>) {
        for k in self.links[i].arms() {
            let pull = self.pull(k, step);
            let slot = &mut self.slots[self.arms[k].slot as usize];
            if slot.is_hub {
                let response = Dim::<D>::response(&slot.mobility, &pull);
                (0..Dim::<D>::FREEDOMS).for_each(|d| slot.change[d] += response[d]);
            }
        }
    }

    /// g^{n+½} of a spring without its own normal force, where the others add `rates` to its own.
    #[inline]
    pub(super) fn gap_from(&self, i: usize, rates: Rates<D>) -> f64 {
        let link = &self.links[i];
        let mut rate = rates[0];
        for axis in 1..D {
            rate += link.own(0, axis) * self.forces[i][axis];
        }
        link.gap_free + 0.5 * self.laws.time_steps[1] * rate
    }

    /// Normal force by the law where the gap without it is `free`.
    #[inline]
    pub(super) fn normal_force(&self, i: usize, free: f64) -> f64 {
        let (link, terms) = (&self.links[i], self.terms_of(i));
        let spring = &Patch { gap: link.gap, ..self.laws.list[link.spring as usize].patch() };
        let closing =
            Closing { spring, old: link.gap_old, free: free - link.lent[0] * link.centre[0], compliance: link.compliance + link.lent[0] };
        terms.normal_force(&closing, link.rate_old, self.laws.time_steps)
    }

    /// What friction can do at a spring where the others add `rates` to its own.
    #[inline]
    pub(super) fn stick_from(&self, i: usize, rates: Rates<D>) -> FrictionInput<D> {
        let link = &self.links[i];
        let free = |a| link.slip_rate_free[a] + rates[a + 1] + link.own(a + 1, 0) * self.forces[i][0] - link.lent[1] * link.centre[a + 1];
        let compliance = |a: usize, b: usize| if a == b { link.own(a + 1, a + 1) + link.lent[1] } else { link.own(a + 1, b + 1) };
        FrictionInput {
            old: link.slip_rate_old,
            free: Dim::<D>::tangent_vector(free),
            compliance: Dim::<D>::tangent_vector(|a| Dim::<D>::tangent_vector(|b| compliance(a, b))),
            stiffness: self.terms_of(i).law.slip_stiffness(&self.laws.list[link.spring as usize].patch()),
            time_steps: self.laws.time_steps,
        }
    }

    /// Most friction with the normal force `force`.
    pub(super) fn limit(&self, i: usize, force: f64) -> f64 {
        let link = &self.links[i];
        match self.terms_of(i).tangential {
            Tangential::Friction(law) => law.limit(force, self.laws.list[link.spring as usize].area, Dim::<D>::size(&link.slip_rate_old)),
            _ => 0.0,
        }
    }

    /// Friction by its law where the others add `rates` to its own.
    #[inline]
    pub(super) fn slide_from(&self, i: usize, rates: Rates<D>) -> FrictionResult<D> {
        Dim::<D>::slide(&self.stick_from(i, rates), self.laws.slip(self.links[i].spring).slip, self.limit(i, self.forces[i][0]))
    }

    /// The same of a tie.
    #[inline]
    pub(super) fn tie_from(&self, i: usize, rates: Rates<D>) -> Along<D> {
        Dim::<D>::tie(&self.stick_from(i, rates), self.laws.slip(self.links[i].spring).slip)
    }

    /// Adds to the forces of a spring.
    pub(super) fn push(&mut self, i: usize, step: Forces<D>) {
        self.forces[i].iter_mut().zip(step).for_each(|(force, step)| *force += step);
        self.report_hubs(i, step);
    }

    /// Reports what was found, with the rates that the forces lead to; parts of `length` springs each at the
    /// same time.
    pub(super) fn settle(&self, results: Results<'_, D>, length: usize) {
        self.settle_part(0, results, length);
    }

    /// The same of the springs from number `first` on.
    fn settle_part(&self, first: usize, mut results: Results<'_, D>, length: usize) {
        if results.len() > length {
            let middle = results.len().div_ceil(length) / 2 * length;
            let [low, high] = results.split_at(middle);
            rayon::join(|| self.settle_part(first, low, length), || self.settle_part(first + middle, high, length));
            return;
        }
        for number in 0..results.len() {
            let i = first + number;
            let link = &self.links[i];
            let is_free = matches!(self.terms_of(i).tangential, Tangential::Free);
            let (others, forces) = (self.rates(i), self.forces[i]);
            let own = |axis: usize| (1..D).fold(link.own(axis, 0) * forces[0], |sum, by| sum + link.own(axis, by) * forces[by]);
            let rate = link.rate_free + (others[0] + own(0));
            let slip_rate = Dim::<D>::tangent_vector(|a| if is_free { 0.0 } else { link.slip_rate_free[a] + (others[a + 1] + own(a + 1)) });
            let (force, friction) = (forces[0], Dim::<D>::tangent_vector(|a| forces[a + 1]));
            let slides = if is_free { force != 0.0 } else { link.slides };
            let Link { gap, slip_new, rate_old, slip_rate_old, .. } = *link;
            let slid = Slid { friction, slip_new, slides, rates: [slip_rate_old, slip_rate] };
            results.set(number, Solved { gap, force, rates: [rate_old, rate] }, || slid);
        }
    }
}
