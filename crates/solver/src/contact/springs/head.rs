//! Eight springs as sweeps see them: what their laws make of the rates of gap and slip.
//!
//! Springs and their laws come from [`super::block`], forces are found in [`super::sweep`].

use super::{Along, Spring, TangentSpace, Tangential, Terms};
use crate::tensor::Dim;
use embate_lanes::Batch;
use std::ops::{Index, IndexMut};

/// For each batch of springs a batch across the surface, and where they slide those along the tangents.
#[derive(Default)]
pub(super) struct Axes {
    list: Vec<Batch>,
    axes: usize,
}

impl Axes {
    /// Zeros for so many batches and axes.
    pub(super) fn clear(&mut self, batches: usize, axes: usize) {
        self.list.clear();
        self.list.resize(batches * axes, Batch::default());
        self.axes = axes;
    }

    /// Whether there are none.
    #[inline(always)]
    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Zeros everywhere.
    pub(super) fn fill(&mut self) {
        self.list.fill(Batch::default());
    }
}

impl Index<usize> for Axes {
    type Output = [Batch];

    #[inline(always)]
    fn index(&self, batch: usize) -> &[Batch] {
        &self.list[batch * self.axes..][..self.axes]
    }
}

impl IndexMut<usize> for Axes {
    #[inline(always)]
    fn index_mut(&mut self, batch: usize) -> &mut [Batch] {
        &mut self.list[batch * self.axes..][..self.axes]
    }
}

/// Eight springs across the surface, as sweeps see them.
///
/// While the force is linear in the gaps, F = −k (g⁻ + g⁺) / 2, with what all springs add to the rate of the
/// gap, r, and its own last force F it is F' = b F − (a + r c) where κ = k / (2 + k C) of the compliance C,
/// a = κ (g⁻ + g⁺ without forces), b = κ C, c = ½ κ dt.
#[derive(Clone, Copy)]
pub(super) struct Head {
    /// a, b, c.
    pub(super) terms: [Batch; 3],
    /// Forces between which it is linear; none if it is not at n − ½.
    pub(super) linear: [Batch; 2],
    /// Force up to which it stays open; none if it was not at n − ½.
    pub(super) open: Batch,
}

impl Default for Head {
    /// Of no spring: no force.
    fn default() -> Self {
        let (never, zero) = (Batch::splat(f64::NEG_INFINITY), Batch::default());
        Self { terms: [zero; 3], linear: [never, Batch::splat(f64::INFINITY)], open: never }
    }
}

impl Head {
    /// Puts a spring into a lane: `gaps` at n − ½ and at n + ½ without any force, m, and change of the latter
    /// per force; the coming `step`, s.
    pub(super) fn set<const D: usize>(
        &mut self,
        lane: usize,
        (spring, terms): (&Spring<D>, &Terms),
        [old, free, compliance]: [f64; 3],
        step: f64,
    ) where
        Dim<D>: TangentSpace<D>,
    {
        let linear = if terms.damping > 0.0 || !(spring.stiffness > 0.0) { None } else { terms.law.linear(&spring.patch()) };
        let linear = linear.filter(|[low, high]| low <= high);
        let reach = linear.map_or_else(|| terms.law.reach(), |[_, high]| high);
        // Of a law that has no stiffness the sum of both gaps says whether it stays open.
        let stiffness = if linear.is_some() { spring.stiffness / (2.0 + spring.stiffness * compliance) } else { 1.0 };
        let values = [stiffness * (old + free), stiffness * compliance, 0.5 * step * stiffness];
        self.terms.iter_mut().zip(values).for_each(|(kept, value)| kept.0[lane] = value);
        let begins = linear.filter(|[low, high]| (*low..=*high).contains(&old));
        let forces = |[low, high]: [f64; 2]| [high, low].map(|gap| -0.5 * spring.stiffness * (old + gap));
        let bounds = begins.map_or([f64::INFINITY, f64::NEG_INFINITY], forces);
        self.linear.iter_mut().zip(bounds).for_each(|(kept, force)| kept.0[lane] = force);
        self.open.0[lane] = if old >= reach { -stiffness * (old + reach) } else { f64::NEG_INFINITY };
    }
}

/// The same as laws see them.
#[derive(Clone, Copy, Default)]
pub(super) struct Gaps {
    /// g^n, g^{n−½}, and g^{n+½} without any force, m.
    pub(super) now: Batch,
    pub(super) old: Batch,
    pub(super) free: Batch,
    /// Change of g^{n+½} per normal force.
    pub(super) compliance: Batch,
}

/// Eight springs: along the surface, where friction has a finite stiffness. Entries from 1 on are those along
/// the tangents.
#[derive(Clone, Copy)]
pub(super) struct Rub<const D: usize> {
    /// Of the elastic slip, N/m.
    pub(super) stiffness: Batch,
    /// Most friction: per normal force, what it has beyond, and the most that there ever is, N.
    pub(super) limit: [Batch; 3],
    /// Elastic slip at n − ½ and n + ½, m, and ones where friction is at its limit.
    pub(super) slip: [Batch; D],
    pub(super) slip_new: [Batch; D],
    pub(super) slides: Batch,
}

impl<const D: usize> Default for Rub<D> {
    fn default() -> Self {
        let (zero, one) = (Batch::default(), Batch::splat(1.0));
        Self { stiffness: one, limit: [zero, zero, one], slip: [zero; D], slip_new: [zero; D], slides: zero }
    }
}

impl<const D: usize> Rub<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Puts a spring that slid at a rate (m/s) into a lane, with its slip, m.
    pub(super) fn set(&mut self, lane: usize, (spring, terms): (&Spring<D>, &Terms), slip_rate: f64, slip: Along<D>) {
        let Tangential::Friction(friction) = terms.tangential else { return };
        self.stiffness.0[lane] = terms.law.slip_stiffness(&spring.patch());
        for (kept, value) in self.limit.iter_mut().zip(friction.limits(spring.area, slip_rate)) {
            kept.0[lane] = value;
        }
        (1..D).for_each(|axis| self.slip[axis].0[lane] = slip[axis - 1]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;
    use crate::contact::law::Law;
    use crate::contact::law::multiplier::Multiplier;
    use crate::contact::law::penalty::Penalty;
    use crate::contact::law::tie::Tie;
    use crate::contact::springs::{Closing, Stiffening};

    #[test]
    fn forces_between_the_bounds_are_those_of_the_law_and_those_below_vanish() {
        let laws: [fn() -> Box<dyn Law>; 3] =
            [|| Box::new(Penalty), || Box::new(Tie { rigid: false, joins_ends: false }), || Box::new(Multiplier)];
        let (mut random, mut counts) = (Random::new(3), [[0; 3]; 3]);
        for trial in 0..30_000 {
            let law = trial % 3;
            let terms = Terms { law: laws[law](), tangential: Tangential::Free, damping: 0.0 };
            let stiffness = if trial % 100 == 0 { 0.0 } else { 10f64.powf(6.0 * random.unit()) };
            let spring = Spring::<3> { stiffness, stiffening: Stiffening::new(1e-3, 3.0), ..Spring::default() };
            let [old, free] = [0; 2].map(|_| 2e-3 * (random.unit() - 0.6));
            let (compliance, step) = (10f64.powf(-6.0 * random.unit()), 1e-6);
            let (rate, force) = (2e2 * (random.unit() - 0.5), 10.0 * random.unit());
            let mut head = Head::default();
            head.set(5, (&spring, &terms), [old, free, compliance], step);
            let at = |batch: &Batch| batch.0[5];
            let found = at(&head.terms[1]) * force - at(&head.terms[0]) - at(&head.terms[2]) * rate;
            // What the others leave.
            let free = free + 0.5 * step * rate - compliance * force;
            let closing = Closing { spring: &spring.patch(), old, free, compliance };
            let expected = terms.law.force(&closing, [step; 2]);
            let size = stiffness * (old.abs() + free.abs() + compliance * force) + expected.abs();
            let is_linear = (at(&head.linear[0])..=at(&head.linear[1])).contains(&found);
            let kind = if !(at(&head.open) < found) { 0 } else { 1 + usize::from(is_linear) };
            counts[law][kind] += 1;
            match kind {
                0 => assert!(expected.abs() <= 1e-13 * size, "open: {expected}"),
                2 => assert!((found - expected).abs() <= 1e-13 * size, "{law}: {found} {expected}"),
                _ => {}
            }
        }
        assert!(counts[0].iter().all(|count| *count > 500), "{counts:?}");
        assert!(counts[1][2] > 9000 && counts[2][0] > 500 && counts[2][2] == 0, "{counts:?}");
    }
}
