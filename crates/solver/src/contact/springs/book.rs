//! Energies and works of solved springs.
//!
//! Springs and what was found of them come from [`super::answers`], which sums up what is entered here.

use super::{Answer, Slid, TangentSpace, Tangential, sum_along};
use crate::energy::Lost;
use crate::tensor::Dim;

/// The energy balance of a spring, J/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Books {
    /// Energy at the whole step n, in step with ½ Σ m v^{n-1/2}·v^{n+1/2}: ½ (V(g^{n−½}) + V(g^{n+½})) + ½ F
    /// (g^{n+½} + g^{n−½} − 2 g^n).
    pub energy: f64,
    /// Energy at n + ½ of the gap, and of a tie's slip.
    pub stored: [f64; 2],
    /// The sum of both at n − ½.
    pub stored_before: f64,
    /// Energy of the elastic slip at n: ¼ k (s^{n−½}² + s^{n+½}²).
    pub slip_energy: f64,
    /// Work of both forces in the velocity update.
    pub work: f64,
    /// What the update took for good or for the elastic slip: minus the work of friction, damping and
    /// multipliers.
    pub lost: Lost,
}

impl<const D: usize> Answer<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Energies and works of the spring.
    #[must_use]
    pub fn books(&self) -> Books {
        let ([before, after], terms, spring, solved) = (self.time_steps(), self.terms(), self.spring, self.solved);
        let (patch, slid) = (spring.patch(), self.slid());
        let (slip, Slid { friction, slip_new, rates: [slip_rate_old, slip_rate], .. }) = (self.slip().slip, slid);
        let [rate_old, rate] = solved.rates;
        let mean_step = 0.5 * (before + after);
        let (gap_old, gap_new) = (self.gap_old(), self.gap_new());
        let (stored_old, stored_new) = (terms.law.stored(&patch, gap_old), terms.law.stored(&patch, gap_new));
        // Part of the force that the energy explains; the rest is damping, or a multiplier's.
        let elastic = match terms.law.is_elastic() {
            false => 0.0,
            true if terms.damping == 0.0 => solved.force,
            true => terms.law.mean_force(&patch, gap_old, gap_new),
        };
        let bend = gap_new + gap_old - 2.0 * solved.gap;
        let rate_mean = 0.5 * (rate_old + rate);
        let slip_mean = Dim::<D>::tangent_vector(|a| 0.5 * (slip_rate_old[a] + slip_rate[a]));
        let inelastic = solved.force - elastic;
        let mut lost = Lost { damping: -mean_step * inelastic * rate_mean, ..Lost::default() };
        lost.old[1] = -mean_step * inelastic * rate_old;
        let mut books = Books {
            energy: 0.5 * (stored_old + stored_new) + 0.5 * elastic * bend,
            stored: [stored_new, 0.0],
            stored_before: stored_old,
            slip_energy: 0.0,
            work: mean_step * (solved.force * rate_mean + sum_along::<D>(|a| friction[a] * slip_mean[a])),
            lost,
        };
        match terms.tangential {
            Tangential::Free => {}
            Tangential::Friction(_) => {
                books.lost.friction = sum_along::<D>(|a| -mean_step * friction[a] * slip_mean[a]);
                books.lost.old[0] = sum_along::<D>(|a| -mean_step * friction[a] * slip_rate_old[a]);
                let stiffness = terms.law.slip_stiffness(&patch);
                if stiffness.is_finite() {
                    books.slip_energy = 0.25 * stiffness * sum_along::<D>(|a| slip[a] * slip[a] + slip_new[a] * slip_new[a]);
                }
            }
            Tangential::Tied => {
                let stiffness = terms.law.slip_stiffness(&patch);
                if stiffness.is_finite() {
                    let old = Dim::<D>::tangent_vector(|a| slip[a] - 0.5 * before * slip_rate_old[a]);
                    let new = Dim::<D>::tangent_vector(|a| slip[a] + 0.5 * after * slip_rate[a]);
                    books.stored[1] = sum_along::<D>(|a| 0.5 * stiffness * new[a] * new[a]);
                    books.stored_before += sum_along::<D>(|a| 0.5 * stiffness * old[a] * old[a]);
                    books.energy += 0.25 * stiffness * sum_along::<D>(|a| old[a] * old[a] + new[a] * new[a])
                        + sum_along::<D>(|a| 0.5 * friction[a] * (old[a] + new[a] - 2.0 * slip[a]));
                } else {
                    books.lost.damping -= sum_along::<D>(|a| mean_step * friction[a] * slip_mean[a]);
                    books.lost.old[1] -= sum_along::<D>(|a| mean_step * friction[a] * slip_rate_old[a]);
                }
            }
        }
        books
    }
}
