//! What contacts learn of their springs once these are solved.
//!
//! Springs and what was found of them lie in [`Springs`]; energies and works are worked out where they are
//! asked for (`book.rs`), so that nothing is stored that is only summed up.

use super::book::Books;
use super::{KeptEnd, Slid, Slip, Solved, Spring, Springs, Terms, Totals};
use crate::contact::springs::TangentSpace;
use crate::contact::traces::Traces;
use crate::contact_forces::ContactForces;
use crate::rigid::Bodies;
use crate::tensor::Dim;
use std::ops::Range;

/// Solved springs, in the order in which they were found.
#[derive(Clone)]
pub struct Answers<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) springs: &'a Springs<D>,
    pub(super) range: Range<usize>,
}

/// A solved spring.
#[derive(Clone, Copy)]
pub struct Answer<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    springs: &'a Springs<D>,
    /// The spring.
    pub spring: &'a Spring<D>,
    /// What was found of it.
    pub solved: &'a Solved,
    number: u32,
}

impl<const D: usize> Answers<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Those of the springs from number `from` on and before number `to`, as far as there are so many.
    #[must_use]
    pub fn part(&self, from: usize, to: usize) -> Self {
        let at = |number: usize| self.range.end.min(self.range.start.saturating_add(number));
        Self { springs: self.springs, range: at(from)..at(to) }
    }
}

impl<'a, const D: usize> Iterator for Answers<'a, D>
where
    Dim<D>: TangentSpace<D>,
{
    type Item = Answer<'a, D>;

    #[inline]
    fn next(&mut self) -> Option<Answer<'a, D>> {
        let (springs, number) = (self.springs, self.range.next()?);
        let solved = &springs.work.solved[springs.work.rank(number)];
        Some(Answer { springs, spring: &springs.list[number], solved, number: number as u32 })
    }
}

impl<'a, const D: usize> Answer<'a, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// What acts in it.
    pub(super) fn terms(&self) -> &'a Terms {
        &self.springs.terms[self.springs.terms_of[self.number as usize] as usize]
    }

    /// Where it was along the surface.
    #[must_use]
    #[inline]
    pub fn slip(&self) -> Slip<D> {
        self.springs.slip(self.number as usize)
    }

    /// The directions along the surface.
    #[must_use]
    #[inline]
    pub fn tangents(&self) -> <Dim<D> as TangentSpace<D>>::Tangents {
        Dim::<D>::tangents(self.spring.normal, &self.slip().tangent)
    }

    /// What was found of it along the surface.
    #[must_use]
    #[inline]
    pub fn slid(&self) -> Slid<D> {
        let work = &self.springs.work;
        let nothing = || Slid { slides: self.solved.force != 0.0, ..Slid::default() };
        if work.slid.is_empty() { nothing() } else { work.slid[work.rank(self.number as usize)] }
    }

    /// Its force on one of its ends, N/m.
    #[must_use]
    #[inline]
    pub fn force_on(&self, end: &KeptEnd<'_, D>) -> [f64; D] {
        let slid = self.slid();
        if slid.friction == Default::default() {
            end.push(self.spring, self.solved)
        } else {
            end.drag(self.spring, &self.tangents(), (self.solved, &slid))
        }
    }

    /// dt^{n−1}, dt^n, s.
    pub(super) fn time_steps(&self) -> [f64; 2] {
        self.springs.time_steps
    }

    /// Its ends.
    pub fn ends(self) -> impl Iterator<Item = KeptEnd<'a, D>> {
        self.springs.ends(self.spring)
    }

    /// g^{n−½}, m.
    #[must_use]
    pub fn gap_old(&self) -> f64 {
        self.solved.gap - 0.5 * self.time_steps()[0] * self.solved.rates[0]
    }

    /// g^{n+½}, m.
    #[must_use]
    pub fn gap_new(&self) -> f64 {
        self.solved.gap + 0.5 * self.time_steps()[1] * self.solved.rates[1]
    }

    /// Energy of the gap at n + ½, J/m.
    #[must_use]
    pub fn stored_new(&self) -> f64 {
        self.terms().law.stored(&self.spring.patch(), self.gap_new())
    }

    /// Adds its force to what is at the ends, and to the resultant.
    pub(crate) fn push(&self, forces: &mut ContactForces<D>, bodies: &mut Bodies<D>, totals: &mut Totals<D>) {
        let (spring, solved, slid) = (self.spring, self.solved, self.slid());
        if solved.force == 0.0 && slid.friction == Default::default() {
            return;
        }
        totals.pressing += solved.force.abs();
        let tangents = (slid.friction != Default::default()).then(|| self.tangents());
        for end in self.ends() {
            let force = tangents.as_ref().map_or_else(|| end.push(spring, solved), |tangents| end.drag(spring, tangents, (solved, &slid)));
            if end.share > 0.0 {
                totals.resultant.iter_mut().zip(force).for_each(|(sum, force)| *sum += f64::from(spring.side) * force);
            }
            if !forces.push(end.at, force) {
                bodies.push_at(end.at as usize - forces.nodes(), force, end.point());
            }
        }
    }

    /// How far it slides in the coming update, m.
    #[must_use]
    pub fn slides_by(&self) -> f64 {
        Dim::<D>::size(&self.slid().rates[1]) * self.time_steps()[1]
    }
}

impl<const D: usize> Answers<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Sums the springs up: adds their forces to `forces` (of nodes) and `bodies` (of bodies without nodes at
    /// the ends), and what they did in the coming update to `traces`. The sums, and the depth of the deepest
    /// one at n, m.
    pub fn collect_into(self, forces: &mut ContactForces<D>, bodies: &mut Bodies<D>, traces: &mut Traces<D>) -> (Totals<D>, f64) {
        let (mut totals, mut deepest) = (Totals::default(), 0.0);
        for answer in self {
            deepest = f64::max(deepest, -answer.solved.gap);
            let Books { energy, slip_energy, work, lost, .. } = answer.books();
            totals.energy += energy;
            totals.slip_energy += slip_energy;
            totals.work += work;
            totals.lost += lost;
            answer.push(forces, bodies, &mut totals);
            traces.mark(&answer, &lost);
        }
        (totals, deepest)
    }
}
