//! Contact laws: from gap to normal force. One law a file, one line in [`LAWS`].
//!
//! Laws come from the model, springs from the contacts; [`super::springs`] asks a law for the force of each
//! spring, again in every sweep.

pub mod multiplier;
pub mod penalty;
pub mod pressure_gap;
pub mod tie;

use super::Tributary;
use super::springs::{Closing, Patch};
use crate::quantity::Parameter;

/// A law of the normal force in a spring.
pub trait Law: Send + Sync {
    /// Force F ≥ 0 (of ties: any), N/m, over an update with the steps dt^{n−1}, dt^n. Of an elastic law F (g₊
    /// − g₋) = V(g₋) − V(g₊) with g₊ = free + compliance F.
    fn force(&self, closing: &Closing<'_>, time_steps: [f64; 2]) -> f64;
    /// Energy V of a spring at a gap, J/m.
    fn stored(&self, spring: &Patch, gap: f64) -> f64;
    /// Stiffness −dF/dg of a spring at a gap, N/m per metre of depth.
    fn stiffness(&self, spring: &Patch, gap: f64) -> f64;
    /// Mean force between two gaps, [V(old) − V(new)] / (new − old), N/m: without the difference of energies,
    /// which is round-off where they are near each other.
    fn mean_force(&self, spring: &Patch, old: f64, new: f64) -> f64;
    /// Stiffness of the elastic slip, N/m per metre of depth.
    fn slip_stiffness(&self, spring: &Patch) -> f64 {
        spring.stiffness
    }
    /// The gaps between which F = −k g, lowest and highest, m; `None`: there are none, or not for a spring
    /// with this patch. Above the highest one that is finite it does not push.
    fn linear(&self, _: &Patch) -> Option<[f64; 2]> {
        None
    }
    /// Whether what the force takes is stored, and given back.
    fn is_elastic(&self) -> bool {
        true
    }
    /// Whether the ends of a spring at one rigid body or node are one arm; only without friction.
    fn joins_ends(&self) -> bool {
        false
    }
    /// Largest gap at which it pushes, m.
    fn reach(&self) -> f64 {
        0.0
    }
}

/// A contact law as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct ContactLawKind {
    /// Name.
    pub name: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Parameters.
    pub parameters: &'static [Parameter],
}

/// A slave node as a law sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Its own surface, and the elements behind it.
    pub own: Tributary,
    /// Pressure stiffness κ of the elements behind the target, Pa/m.
    pub other: f64,
    /// Part of the node that belongs to the model: one half on a symmetry line, where the mirror image holds
    /// the other.
    pub share: f64,
}

/// Every contact law.
pub const LAWS: &[ContactLawKind] = &[penalty::KIND, pressure_gap::KIND, multiplier::KIND];

/// Force of an elastic law with a dashpot in parallel: F = max(0, F_elastic − c φ ½ (ġ⁻ + ġ⁺)) with c = 2 ξ
/// √(k m).
///
/// `fraction` ξ of critical, m the mass that the spring feels, k its stiffness at the deeper end, φ the part
/// of the update in which the gap is closed. The rate is the mean of both half steps, so the dashpot takes
/// energy for any c and step.
#[must_use]
pub fn damped(law: &dyn Law, closing: &Closing<'_>, fraction: f64, rate_old: f64, time_steps: [f64; 2]) -> f64 {
    let Closing { spring, old, free, compliance } = *closing;
    let [before, after] = time_steps;
    // Multipliers have nothing to damp: they leave no rate behind.
    if compliance <= 0.0 || !law.is_elastic() {
        return law.force(closing, time_steps);
    }
    // compliance = ½ dt^n · ½ (dt^{n−1} + dt^n) / m
    let mass = 0.25 * after * (before + after) / compliance;
    let edge = law.reach();
    let response = |force: f64| {
        let new = free + compliance * force;
        let closed = if old < edge && new < edge {
            1.0
        } else if old >= edge && new >= edge {
            return 0.0;
        } else {
            (edge - old.min(new)) / (new - old).abs()
        };
        let stiffness = law.stiffness(spring, old.min(new));
        let rate = 0.5 * (rate_old + 2.0 * (new - spring.gap) / after);
        (law.mean_force(spring, old, new) - 2.0 * fraction * (stiffness * mass).sqrt() * closed * rate).max(0.0)
    };
    fixed_point(response)
}

/// The force F with F = `response`(F), where the response falls as the force grows.
#[must_use]
pub fn fixed_point(response: impl Fn(f64) -> f64) -> f64 {
    let first = response(0.0);
    if !(first > 0.0) {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, first);
    let (mut below, mut above) = (-first, high - response(high));
    for _ in 0..64 {
        if above >= 0.0 {
            break;
        }
        (low, below) = (high, above);
        high *= 2.0;
        above = high - response(high);
    }
    // Regula falsi of the Illinois kind, with bisection where it is slow.
    for step in 0..200 {
        if high - low <= 4.0 * f64::EPSILON * high || above == 0.0 {
            break;
        }
        let secant = high - above * (high - low) / (above - below);
        let middle = if step % 8 == 7 || !(low < secant && secant < high) { 0.5 * (low + high) } else { secant };
        let value = middle - response(middle);
        if value >= 0.0 {
            (high, above) = (middle, value);
            below *= 0.5;
        } else {
            (low, below) = (middle, value);
            above *= 0.5;
        }
        if value == 0.0 {
            return middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fixed_point_is_found_to_the_last_digits() {
        for (slope, start) in [(0.0, 2.0), (1.0, 3.0), (1e6, 1.0), (1e-9, 7.0)] {
            let found = fixed_point(|force| start - slope * force);
            assert!((found * (1.0 + slope) / start - 1.0).abs() < 1e-14, "{slope} {found}");
        }
        assert_eq!(fixed_point(|_| -1.0), 0.0);
        let found = fixed_point(|force: f64| (1.0 - force).max(0.0).powi(2) * 5.0);
        assert!((found - 5.0 * (1.0 - found).powi(2)).abs() < 1e-14);
    }

    #[test]
    fn a_mean_force_is_the_difference_of_energies_by_the_way() {
        let spring = Patch { stiffness: 3.0, area: 1.5, limit: 1.1, more: 100.0, ..Patch::default() };
        let laws: [Box<dyn Law>; 3] = [
            Box::new(penalty::Penalty),
            Box::new(tie::Tie { rigid: false, joins_ends: false }),
            Box::new(pressure_gap::PressureGap::new(&[-2.0, -1.0, 0.5], &[7.0, 2.0, 0.0])),
        ];
        for law in laws {
            for old in [-3.0, -1.5, -0.2, 0.0, 0.3, 2.0] {
                for new in [-4.0, -1.2, -0.1, 0.1, 0.4, 3.0] {
                    let expected = (law.stored(&spring, old) - law.stored(&spring, new)) / (new - old);
                    let found = law.mean_force(&spring, old, new);
                    assert!((found - expected).abs() <= 1e-13 * (1.0 + expected.abs()), "{old} {new}: {found} {expected}");
                }
                // Near each other: the force itself.
                let (a, b) = (law.mean_force(&spring, old, old + 1e-12), law.mean_force(&spring, old, old));
                assert!((a - b).abs() < 1e-10 + 1e-12 * law.stiffness(&spring, old), "{old}: {a} {b}");
            }
        }
    }
}
