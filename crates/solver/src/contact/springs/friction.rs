//! Friction along a spring's tangent: Coulomb's law by return mapping on an elastic slip, and ties that never
//! slip.
//!
//! The slip s is elastic up to T = k s. Over an update, from half step to half step, it moves by Δs = ½
//! (dt^{n−1} + dt^n) · ½ (ṡ^{n−½} + ṡ^{n+½}):
//!
//! T_trial = −½ k (s^{n−½} + s^{n−½} + Δs), T = T_trial within ±T_max, s^{n+½} = s^{n−½} + Δs within ±T_max /
//! k when T is at its limit.
//!
//! While it sticks T takes from the motion exactly what ½ k s² stores, for any k and step (as normal springs
//! do). What it takes beyond is lost, and never negative: at the limit −T Δs − ½ k (s^{n+½}² −
//! s^{n−½}²) = (s^{n+½} − s^{n−½}) (T_max − ½ k (s^{n+½} + s^{n−½})) + T_max Δs_plastic ≥ 0 (for T < 0). With
//! a multiplier as normal law k is infinite: the force that stops the slip in v^{n+½}, within ±T_max.

pub mod cone;
pub(super) mod lanes;

use super::Along;
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;

/// Coulomb friction: T_max = min(µ(v) F + c A v, τ_max A) at slip rate v, µ(v) = µ_d + (µ_s − µ_d) exp(−β v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// µ_s.
    pub coefficient: f64,
    /// µ_d.
    pub dynamic: f64,
    /// β, s/m.
    pub decay: f64,
    /// c, Pa s/m.
    pub viscosity: f64,
    /// τ_max, Pa.
    pub limit: f64,
}

impl Friction {
    /// T_max, N/m, for the normal force F (N/m) on a length `area` (m) at a slip rate (m/s; that before the
    /// update).
    #[must_use]
    pub fn limit(&self, force: f64, area: f64, slip_rate: f64) -> f64 {
        let [coefficient, added, most] = self.limits(area, slip_rate);
        // Where nothing presses nothing rubs.
        if force > 0.0 { (coefficient * force + added).min(most) } else { 0.0 }
    }

    /// What T_max is made of: µ(v), c A v and τ_max A.
    #[must_use]
    pub fn limits(&self, area: f64, slip_rate: f64) -> [f64; 3] {
        let speed = slip_rate.abs();
        let coefficient = if self.coefficient == self.dynamic {
            self.dynamic
        } else {
            self.dynamic + (self.coefficient - self.dynamic) * embate_lanes::math::exp(-self.decay * speed)
        };
        let most = if self.limit.is_finite() { self.limit * area } else { f64::INFINITY };
        [coefficient, self.viscosity * area * speed, most]
    }
}

/// What a tangential force can do.
#[derive(Clone, Copy, Debug)]
pub struct FrictionInput<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// ṡ^{n−½} along each tangent, m/s.
    pub old: Along<D>,
    /// ṡ^{n+½} without the force, m/s.
    pub free: Along<D>,
    /// Change of ṡ^{n+½} per force: a symmetric matrix.
    pub compliance: <Dim<D> as TangentSpace<D>>::TangentVector<Along<D>>,
    /// k, N/m per metre of depth; infinite: the slip stops at once.
    pub stiffness: f64,
    /// dt^{n−1}, dt^n, s.
    pub time_steps: [f64; 2],
}

impl<const D: usize> FrictionInput<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Change of the slip rate per friction that sticks, beside `compliance`, m/s per N/m.
    #[must_use]
    pub fn softness(&self) -> f64 {
        softness(self.stiffness, self.time_steps)
    }

    /// The same of a tie.
    #[must_use]
    pub fn tie_softness(&self) -> f64 {
        tie_softness(self.stiffness, self.time_steps)
    }
}

/// As [`FrictionInput::softness`], of a stiffness (N/m) and two steps (s).
pub(super) fn softness(stiffness: f64, [before, after]: [f64; 2]) -> f64 {
    8.0 / (stiffness * (before + after))
}

/// As [`FrictionInput::tie_softness`].
pub(super) fn tie_softness(stiffness: f64, [_, after]: [f64; 2]) -> f64 {
    4.0 / (stiffness * after)
}

/// Friction that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionResult<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// T along each tangent, N/m.
    pub friction: Along<D>,
    /// Elastic slip s^{n+½}, m.
    pub slip: Along<D>,
    /// Whether T is at its limit.
    pub slides: bool,
}

/// Friction with the elastic slip `slip` (m, at n − ½) and the limit T_max (N/m).
#[must_use]
pub fn slide(stick: &FrictionInput<2>, [slip]: [f64; 1], limit: f64) -> FrictionResult<2> {
    let FrictionInput { old: [old], free: [free], compliance: [[compliance]], stiffness, time_steps: [before, after] } = *stick;
    if !(limit > 0.0 && compliance > 0.0) {
        return FrictionResult { friction: [0.0], slip: [0.0], slides: limit <= 0.0 };
    }
    if stiffness.is_infinite() {
        let trial = -free / compliance;
        let friction = trial.clamp(-limit, limit);
        return FrictionResult { friction: [friction], slip: [0.0], slides: trial.abs() > limit };
    }
    // ½ Δs = quarter (ṡ⁻ + ṡ_free + c T)
    let quarter = 0.25 * 0.5 * (before + after);
    let trial = -stiffness * (slip + quarter * (old + free)) / (1.0 + stiffness * quarter * compliance);
    let friction = trial.clamp(-limit, limit);
    let slip_new = slip + 2.0 * quarter * (old + free + compliance * friction);
    if trial.abs() <= limit {
        return FrictionResult { friction: [friction], slip: [slip_new], slides: false };
    }
    let elastic = limit / stiffness;
    FrictionResult { friction: [friction], slip: [slip_new.clamp(-elastic, elastic)], slides: true }
}

/// Force of a tie on the slip `slip` (m, at n): a spring that pulls both ways, or with an infinite stiffness
/// what ends the slip in one step.
#[must_use]
pub fn tie(stick: &FrictionInput<2>, [slip]: [f64; 1]) -> [f64; 1] {
    let FrictionInput { old: [old], free: [free], compliance: [[compliance]], stiffness, time_steps: [before, after] } = *stick;
    if stiffness.is_infinite() {
        return [if compliance > 0.0 { -(slip / after + free) / compliance } else { 0.0 }];
    }
    let sum = 2.0 * slip - 0.5 * before * old + 0.5 * after * free;
    [-0.5 * stiffness * sum / (1.0 + 0.25 * stiffness * after * compliance)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_never_gives_more_than_the_slip_has_stored() {
        let (mut least, mut slides) = (f64::INFINITY, 0);
        for k in [0.1, 1.0, 50.0] {
            for slip in [-2.0, -0.3, 0.0, 0.1, 1.0] {
                for old in [-3.0, -0.1, 0.0, 0.2, 2.0] {
                    for free in [-2.0, -0.2, 0.0, 0.1, 3.0] {
                        for limit in [0.05, 0.4, 3.0] {
                            let stick =
                                FrictionInput { old: [old], free: [free], compliance: [[0.7]], stiffness: k, time_steps: [0.9, 1.1] };
                            let slid = slide(&stick, [slip], limit);
                            let (friction, [slid_to]) = (slid.friction[0], slid.slip);
                            let moved = 0.5 * (old + free + 0.7 * friction);
                            let lost = -friction * moved - 0.5 * k * (slid_to * slid_to - slip * slip);
                            assert!(friction.abs() <= limit);
                            let scale = 1.0 + k * slip * slip;
                            if slid.slides {
                                least = least.min(lost / scale);
                                slides += 1;
                            } else {
                                assert!(lost.abs() < 1e-12 * scale, "it sticks, but loses {lost}");
                            }
                        }
                    }
                }
            }
        }
        assert!(least > -1e-12 && slides > 100, "{least} {slides}");
    }

    #[test]
    fn a_multiplier_stops_the_slip_within_its_limit() {
        let stick = |free| FrictionInput { old: [1.0], free: [free], compliance: [[0.5]], stiffness: f64::INFINITY, time_steps: [1.0; 2] };
        assert_eq!(slide(&stick(0.3), [0.0], 1.0), FrictionResult { friction: [-0.6], slip: [0.0], slides: false });
        assert_eq!(slide(&stick(-2.0), [0.0], 1.0), FrictionResult { friction: [1.0], slip: [0.0], slides: true });
    }

    #[test]
    fn the_coefficient_falls_from_static_to_dynamic() {
        let law = Friction { coefficient: 0.5, dynamic: 0.2, decay: 2.0, viscosity: 0.0, limit: f64::INFINITY };
        assert_eq!(law.limit(10.0, 1.0, 0.0), 5.0);
        assert!((law.limit(10.0, 1.0, -1.0) - (2.0 + 3.0 * (-2.0f64).exp())).abs() < 1e-12);
        assert_eq!(Friction { limit: 3.0, ..law }.limit(10.0, 0.5, 0.0), 1.5);
        assert_eq!(Friction { viscosity: 4.0, dynamic: 0.5, ..law }.limit(10.0, 0.5, 2.0), 9.0);
        assert_eq!(law.limit(0.0, 1.0, 3.0), 0.0);
    }
}
