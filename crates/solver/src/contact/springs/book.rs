//! Energies and works of solved springs.
//!
//! Springs and what was found of them come from [`super::answers`], which sums up what is booked here.

use super::{Answer, Lost, Tangential};

/// The books of a spring, J/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Books {
    /// Energy at the whole step n, in step with ½ Σ m v^{n-1/2}·v^{n+1/2}: ½ (V(g^{n−½}) + V(g^{n+½})) + ½ F (g^{n+½} + g^{n−½} − 2 g^n).
    pub energy: f64,
    /// Energy at n + ½ of the gap, and of a tie's slip.
    pub stored: [f64; 2],
    /// The sum of both at n − ½.
    pub stored_before: f64,
    /// Energy of the elastic slip at n: ¼ k (s^{n−½}² + s^{n+½}²).
    pub slip_energy: f64,
    /// Work of both forces in the velocity update.
    pub work: f64,
    /// What the update took for good or for the elastic slip: minus the work of friction, damping and multipliers.
    pub lost: Lost,
}

impl Answer<'_> {
    /// Energies and works of the spring.
    #[must_use]
    pub fn books(&self) -> Books {
        let ([before, after], terms, spring, solved) = (self.time_steps(), self.terms(), self.spring, self.solved);
        let [rate_old, rate] = solved.rates;
        let [slip_rate_old, slip_rate] = solved.slip_rates;
        let mean_step = 0.5 * (before + after);
        let (gap_old, gap_new) = (self.gap_old(), self.gap_new());
        let (stored_old, stored_new) = (terms.law.stored(spring, gap_old), terms.law.stored(spring, gap_new));
        // Part of the force that the energy explains; the rest is damping, or a multiplier's.
        let elastic = match terms.law.is_elastic() {
            false => 0.0,
            true if terms.damping == 0.0 => solved.force,
            true => terms.law.mean_force(spring, gap_old, gap_new),
        };
        let bend = gap_new + gap_old - 2.0 * spring.gap;
        let rate_mean = 0.5 * (rate_old + rate);
        let slip_mean = 0.5 * (slip_rate_old + slip_rate);
        let inelastic = solved.force - elastic;
        let mut lost = Lost { damping: -mean_step * inelastic * rate_mean, ..Lost::default() };
        lost.old[1] = -mean_step * inelastic * rate_old;
        let mut books = Books {
            energy: 0.5 * (stored_old + stored_new) + 0.5 * elastic * bend,
            stored: [stored_new, 0.0],
            stored_before: stored_old,
            slip_energy: 0.0,
            work: mean_step * (solved.force * rate_mean + solved.friction * slip_mean),
            lost,
        };
        match terms.tangential {
            Tangential::Free => {}
            Tangential::Friction(_) => {
                books.lost.friction = -mean_step * solved.friction * slip_mean;
                books.lost.old[0] = -mean_step * solved.friction * slip_rate_old;
                let stiffness = terms.law.slip_stiffness(spring);
                if stiffness.is_finite() {
                    books.slip_energy = 0.25 * stiffness * (spring.slip * spring.slip + solved.slip_new * solved.slip_new);
                }
            }
            Tangential::Tied => {
                let stiffness = terms.law.slip_stiffness(spring);
                if stiffness.is_finite() {
                    let (old, new) = (spring.slip - 0.5 * before * slip_rate_old, spring.slip + 0.5 * after * slip_rate);
                    books.stored[1] = 0.5 * stiffness * new * new;
                    books.stored_before += 0.5 * stiffness * old * old;
                    books.energy += 0.25 * stiffness * (old * old + new * new) + 0.5 * solved.friction * (old + new - 2.0 * spring.slip);
                } else {
                    books.lost.damping -= mean_step * solved.friction * slip_mean;
                    books.lost.old[1] -= mean_step * solved.friction * slip_rate_old;
                }
            }
        }
        books
    }
}
