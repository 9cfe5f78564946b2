//! Penalty: a spring that only pushes. F = k_n |G| where the gap G is negative, eq. (11) of the paper; energy
//! ½ k_n G².
//!
//! Beyond the depth ℓ, a twentieth of the local thickness of the thinner body, it stiffens: V = ½ k d² + k S
//! (d − ℓ)³ / 6ℓ with d = −G up to 2ℓ, and continues with the stiffness k (1 + S) that it has there: twice
//! continuously differentiable and convex. A linear spring as stiff as the elements lets a heavy body through
//! a soft one. S is 100, or α m / (k dt²) with the mass m of the lighter side's nodes, α = 0.1 and the first
//! step dt, where that is more: so stiff a spring stops a node within a few steps whatever the elements are.
//! Where the stiffness is given S is 100, and a `penalty_scale` below 1 scales that by mass, too. At
//! obstacles S is 10, less with a `penalty_scale` above 1. In sound contact d stays below ℓ.
//!
//! Stiffness of a slave node: given (the paper's k_n), a pressure per depth times the node's tributary
//! length, or automatic: the stiffness κ of the elements under the surface times the tributary length, the
//! softer of both bodies; half of it in a double pass, where both passes act. What κ is:
//!
//! - `wave_modulus`: M L / A with M = K + 4µ/3 (in plane stress E/(1 − ν²)), the modulus of plane waves over
//!   the height of the element; as stiff as the element itself.
//! - `bulk_modulus`: K L / A, as in Hallquist, Goudreau and Benson, Comput. Meth. Appl. Mech. Engng 51 (1985)
//!   107-137 (K A² / V in 3D): softer for metals, nearly the same for rubber.
//! - `time_step`: α m / (dt² A) with the node's mass m, its tributary length A, the first step dt and
//!   α = 0.1: a spring with k = α m / dt², for bodies whose moduli differ by orders, or say nothing (the
//!   "soft constraint" of explicit codes, LS-DYNA Theory Manual, chapter on contact). With m ~ ρ A h / 2 and
//!   dt ~ 0.9 h / c it is about 0.06 (K + 4µ/3) A / h.

use super::{ContactLawKind, Law, Node, fixed_point};
use crate::contact::springs::{Closing, Patch, Stiffening};
use crate::model;
use crate::quantity::{Dimension, Parameter, Range};

/// Registry entry.
pub const KIND: ContactLawKind = ContactLawKind {
    name: "penalty",
    doc: "force proportional to the penetration; without `penalty` about as stiff as the elements under the surface",
    source: "Bittencourt and Creus (1995), eqs. (11)-(14) with the reactions corrected to F_1 = -(1-ε)F/2, F_2 = -(1+ε)F/2",
    parameters: &[
        Parameter::new(
            "penalty",
            "k_n",
            Dimension::PRESSURE,
            Range::Positive,
            "stiffness per slave node and metre of depth (N/m/m), or pressure per penetration (Pa/m); left out: automatic",
        ),
        Parameter::new("penalty_scale", "s", Dimension::NONE, Range::Positive, "factor on the automatic stiffness").or(1.0),
    ],
};

/// How much stiffer it is at least between bodies, at twice the limit than below it.
const STIFFENING: f64 = 100.0;
/// How much stiffer it is there at obstacles, which do not yield: of 52 scenes in which bodies are pressed
/// against planes 5 did not end with 10, 7 with 0 and 3, and 9 with 100, which throws nodes back within a
/// step.
const AT_OBSTACLES: f64 = 10.0;
/// Fraction of the local thickness beyond which it stiffens.
pub const LIMIT: f64 = 0.05;

/// Fraction α of m / dt² that `penalty_from = "time_step"` takes.
const OF_TIME_STEP: f64 = 0.1;

/// κ of a node from its mass m (kg/m), the first step dt (s) and its tributary length A (m), of an
/// axisymmetric body from mass and area all around: α m / (dt² A), Pa/m.
#[must_use]
pub fn of_time_step(mass: f64, time_step: f64, area: f64) -> f64 {
    OF_TIME_STEP * mass / (time_step * time_step * area)
}

/// Where a spring stiffens: beyond a fraction of the local `thickness` (m), by a `factor` at twice that.
#[must_use]
pub fn stiffening(thickness: f64, factor: f64) -> Stiffening {
    Stiffening::new(LIMIT * thickness, factor)
}

/// By what factor a spring of a stiffness stiffens between bodies, so that it is as stiff as `of_mass` (the
/// unit of the stiffness) then.
#[must_use]
pub fn factor(stiffness: f64, of_mass: f64) -> f64 {
    if stiffness > 0.0 { STIFFENING.max(of_mass / stiffness) } else { STIFFENING }
}

/// The same at obstacles. An automatic stiffness that is made larger already stiffens by less.
#[must_use]
pub fn at_obstacles(penalty: model::Penalty) -> f64 {
    match penalty {
        model::Penalty::Automatic { scale, .. } if scale > 1.0 => ((1.0 + AT_OBSTACLES) / scale - 1.0).max(0.0),
        _ => AT_OBSTACLES,
    }
}

/// Stiffness of a contact; of laws without one the automatic one, for what needs a scale.
#[must_use]
pub fn penalty_of(interface: &model::Interface) -> model::Penalty {
    if let model::ContactLaw::Penalty(penalty) = interface.law { penalty } else { model::Penalty::default() }
}

/// Share of the stiffness by mass that springs may stiffen to: none where a stiffness is given, and less
/// where the automatic one is made softer.
#[must_use]
pub fn share_of_mass(penalty: model::Penalty) -> f64 {
    match penalty {
        model::Penalty::Automatic { scale, .. } => scale.min(1.0),
        model::Penalty::PerNode(_) | model::Penalty::Pressure(_) => 0.0,
    }
}

/// Spring stiffness of a slave node, N/m per metre of depth (in 3D N/m); `passes` 1 or 2.
#[must_use]
pub fn stiffness(penalty: model::Penalty, node: Node, passes: usize) -> f64 {
    match penalty {
        // Per metre of depth: of an axisymmetric body per metre of its circumference.
        model::Penalty::PerNode(stiffness) => stiffness * node.share * (node.own.area / node.own.length),
        // Tributary lengths end at the symmetry line already.
        model::Penalty::Pressure(pressure) => pressure * node.own.area,
        model::Penalty::Automatic { scale, .. } => scale * node.own.area * node.own.stiffness.min(node.other) / passes as f64,
    }
}

/// Pressure per depth between two segments with κ = `own` and `other` behind them, Pa/m.
///
/// A stiffness per node has none: formulations without slave nodes refuse it before.
#[must_use]
pub fn pressure(penalty: model::Penalty, own: f64, other: f64) -> f64 {
    match penalty {
        model::Penalty::PerNode(_) => 0.0,
        model::Penalty::Pressure(pressure) => pressure,
        model::Penalty::Automatic { scale, .. } => scale * own.min(other),
    }
}

/// The law; a spring knows its stiffness.
#[derive(Clone, Copy, Debug)]
pub struct Penalty;

impl Law for Penalty {
    fn force(&self, closing: &Closing<'_>, _: [f64; 2]) -> f64 {
        let Closing { spring, old, free, compliance } = *closing;
        let linear = force(spring.stiffness, old, free, compliance);
        if old >= -spring.limit && free + compliance * linear >= -spring.limit {
            return linear;
        }
        fixed_point(|force| self.mean_force(spring, old, free + compliance * force))
    }
    fn stored(&self, spring: &Patch, gap: f64) -> f64 {
        let beyond = beyond(spring, gap);
        let more = if beyond > 0.0 { spring.more * spring.stiffness * beyond * mean_depth(beyond, 0.0, spring.limit) } else { 0.0 };
        0.5 * spring.stiffness * gap.min(0.0) * gap.min(0.0) + more
    }
    fn linear(&self, spring: &Patch) -> Option<[f64; 2]> {
        Some([-spring.limit, 0.0])
    }
    fn stiffness(&self, spring: &Patch, gap: f64) -> f64 {
        let beyond = beyond(spring, gap);
        if beyond > 0.0 { spring.stiffness * (1.0 + spring.more * (beyond / spring.limit).min(1.0)) } else { spring.stiffness }
    }
    fn mean_force(&self, spring: &Patch, old: f64, new: f64) -> f64 {
        // The square of the deeper gap counts as far as it is closed.
        let (deep, high) = (old.min(new), old.max(new));
        let linear = match (deep < 0.0, high < 0.0) {
            (false, _) => 0.0,
            (true, true) => -0.5 * spring.stiffness * (old + new),
            (true, false) => 0.5 * spring.stiffness * deep * (deep / (high - deep)),
        };
        let (most, least) = (beyond(spring, deep), beyond(spring, high));
        if most == 0.0 {
            return linear;
        }
        let share = if least > 0.0 { 1.0 } else { most / (high - deep) };
        linear + spring.more * spring.stiffness * share * mean_depth(most, least, spring.limit)
    }
}

/// Mean of what stiffening adds to the depth between `most` and `least` beyond the limit ℓ, m: b² / 2ℓ up to
/// ℓ, then b − ℓ/2.
fn mean_depth(most: f64, least: f64, limit: f64) -> f64 {
    // Of differences of cubes and squares by the way.
    let curved = |most: f64, least: f64| (most * most + most * least + least * least) / (6.0 * limit);
    let straight = |most: f64, least: f64| 0.5 * (most + least - limit);
    if most <= limit {
        curved(most, least)
    } else if least >= limit {
        straight(most, least)
    } else {
        ((limit - least) * curved(limit, least) + (most - limit) * straight(most, limit)) / (most - least)
    }
}

/// How far a gap is deeper than the limit, m.
fn beyond(spring: &Patch, gap: f64) -> f64 {
    (-gap - spring.limit).max(0.0)
}

/// The force F ≥ 0 with F (g₊ − g₋) = V(g₋) − V(g₊) and g₊ = `free` + `compliance` F; `old` is g₋.
fn force(stiffness: f64, old: f64, free: f64, compliance: f64) -> f64 {
    let kc = stiffness * compliance;
    if old < 0.0 {
        // Closed all along: F = −½ k (g₊ + g₋).
        let closed = -stiffness * (free + old) / (2.0 + kc);
        if free + compliance * closed <= 0.0 {
            return closed.max(0.0);
        }
        // Release: c F² + (free − g₋) F = ½ k g₋², the positive root without cancellation.
        let b = free - old;
        let root = (b * b + 2.0 * kc * old * old).sqrt();
        return if b >= 0.0 { stiffness * old * old / (b + root) } else { (root - b) / (2.0 * compliance) };
    }
    if free >= 0.0 {
        return 0.0;
    }
    // Closing, with u = −g₊ > 0: (1 + ½ k c) u² − (p − g₋) u − p g₋ = 0 with p = −free.
    let (a, b) = (1.0 + 0.5 * kc, -free - old);
    let root = (b * b - 4.0 * a * free * old).sqrt();
    let u = if b >= 0.0 { (b + root) / (2.0 * a) } else { -2.0 * free * old / (root - b) };
    0.5 * stiffness * u * (u / (old + u))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_takes_and_gives_what_the_spring_stores() {
        let stored = |k: f64, g: f64| 0.5 * k * g.min(0.0).powi(2);
        for k in [0.01, 1.0, 100.0, 1e6] {
            for c in [1e-6, 0.1, 3.0] {
                for old in [-2.0, -0.3, 0.0, 1e-9, 0.4, 5.0] {
                    for free in [-7.0, -1.0, -1e-9, 0.0, 0.2, 3.0] {
                        let f = force(k, old, free, c);
                        let new = free + c * f;
                        assert!(f >= 0.0);
                        let (work, change) = (f * (new - old), stored(k, old) - stored(k, new));
                        // `new` is the difference of `free` and c f: their size sets the round-off.
                        let scale = stored(k, old) + stored(k, new) + f * (free.abs() + old.abs());
                        if f > 0.0 {
                            assert!((work - change).abs() <= 1e-12 * scale, "k {k} c {c} old {old} free {free}: {work} {change}");
                        } else {
                            assert!(new >= 0.0 && old >= 0.0 || free + old >= 0.0, "k {k} c {c} old {old} free {free}");
                        }
                    }
                }
            }
        }
    }
}
