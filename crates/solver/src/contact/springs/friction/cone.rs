//! Friction in 3D: Coulomb's cone by return mapping in the tangent plane, and ties along both tangents.
//!
//! As in 2D ([`super`]) the slip s is elastic up to T = −k m with the mean slip of the update
//! m = s^{n−½} + ½ Δs, ½ Δs = q (ṡ^{n−½} + ṡ_free + C T), where the compliance C is a symmetric 2 × 2 matrix.
//! Where |T| would exceed T_max it is T = −T_max d, in the direction d of the mean slip itself: with m₀ = s +
//! q (ṡ^{n−½} + ṡ_free) and λ = |m|
//!
//! (λ I + T_max q C) d = m₀,   |d| = 1,
//!
//! one equation for λ on the axes of C, which falls and is solved by Newton's method on 1/|d| from T_max/k on
//! (Moré and Sorensen 1983). The elastic slip s^{n+½} is that of s + Δs within T_max/k. Then −T·Δs ≥ ½ k
//! (|s^{n+½}|² − |s^{n−½}|²) for any C, slip and step: what slides never gains. (With e = T_max/k ≤ λ,
//! σ = s·d the loss over k is 2 (e − λ)(λ − σ) with λ ≤ σ where s + Δs is inside, and at least 2 (λ − e)(σ −
//! λ), ½ (σ² − e²) or (e − σ)(3e − σ)/2 for σ beyond λ, between, below e where it is not.) What sticks gives
//! back exactly what it took.

use super::{FrictionInput, FrictionResult};
use crate::contact::springs::TangentSpace;
use crate::tensor::{Dim, dot};

/// Newton's steps for λ: each squares the error, and far away they are exact.
const STEPS: usize = 60;

/// Eigenvalues (ascending) and the first axis of a symmetric matrix, the second one is (−y, x).
fn axes([[a, b], [_, c]]: [[f64; 2]; 2]) -> ([f64; 2], [f64; 2]) {
    let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
    let radius = (half * half + b * b).sqrt();
    if radius == 0.0 {
        return ([mean; 2], [1.0, 0.0]);
    }
    // Of (A − high I) the column that is longer is the axis of the lower value.
    let low = if half >= 0.0 { [b, -(half + radius)] } else { [half - radius, b] };
    let size = Dim::<3>::size(&low);
    ([(mean - radius).max(0.0), mean + radius], [low[0] / size, low[1] / size])
}

/// Components along the axes, and back.
fn onto([x, y]: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    [x * v[0] + y * v[1], x * v[1] - y * v[0]]
}

fn back([x, y]: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    [x * v[0] - y * v[1], y * v[0] + x * v[1]]
}

/// The unit vector d with (λ I + limit · diag(`give`)) d = `along` for the λ ≥ `least` where there is one;
/// its length is more than one at `least`.
fn direction(along: [f64; 2], give: [f64; 2], limit: f64, mut least: f64) -> [f64; 2] {
    let at = |lambda: f64| [0, 1].map(|k| if along[k] == 0.0 { 0.0 } else { along[k] / (lambda + limit * give[k]) });
    for _ in 0..STEPS {
        let d = at(least);
        let square = d[0] * d[0] + d[1] * d[1];
        if !square.is_finite() {
            // Nothing yields along an axis: anything beyond nothing.
            least = Dim::<3>::size(&along) * f64::EPSILON;
            continue;
        }
        // d|d|/dλ = −Σ d_k² / (λ + limit give_k) / |d|
        let slope = (0..2).map(|k| if d[k] == 0.0 { 0.0 } else { d[k] * d[k] / (least + limit * give[k]) }).sum::<f64>();
        let size = square.sqrt();
        let step = (size - 1.0) * square / slope;
        if !(step > 0.0 && least + step > least) {
            break;
        }
        least += step;
    }
    let d = at(least);
    let size = Dim::<3>::size(&d);
    d.map(|component| component / size)
}

/// Friction with the elastic slip `slip` (m, at n − ½) and the limit T_max (N).
#[must_use]
pub fn slide(stick: &FrictionInput<3>, slip: [f64; 2], limit: f64) -> FrictionResult<3> {
    let FrictionInput { old, free, compliance, stiffness, time_steps: [before, after] } = *stick;
    if !(limit > 0.0 && compliance[0][0] + compliance[1][1] > 0.0) {
        return FrictionResult { friction: [0.0; 2], slip: [0.0; 2], slides: limit <= 0.0 };
    }
    let (give, axis) = axes(compliance);
    if stiffness.is_infinite() {
        // The force that stops the slip; where nothing yields none does.
        let rate = onto(axis, free);
        let trial = [0, 1].map(|k| if give[k] > 1e-14 * give[1] { -rate[k] / give[k] } else { 0.0 });
        let slides = Dim::<3>::size(&trial) > limit;
        let friction = if slides { direction(rate, give, limit, 0.0).map(|d| -limit * d) } else { trial };
        return FrictionResult { friction: back(axis, friction), slip: [0.0; 2], slides };
    }
    let quarter = 0.25 * 0.5 * (before + after);
    let mean = onto(axis, [0, 1].map(|a| slip[a] + quarter * (old[a] + free[a])));
    let trial = [0, 1].map(|k| -stiffness * mean[k] / (1.0 + stiffness * quarter * give[k]));
    let slides = Dim::<3>::size(&trial) > limit;
    let elastic = limit / stiffness;
    let friction = if slides { direction(mean, give.map(|c| quarter * c), limit, elastic).map(|d| -limit * d) } else { trial };
    let friction = back(axis, friction);
    let pulled = [0, 1].map(|a| compliance[a][0] * friction[0] + compliance[a][1] * friction[1]);
    let slip_new = [0, 1].map(|a| slip[a] + 2.0 * quarter * (old[a] + free[a] + pulled[a]));
    FrictionResult { friction, slip: if slides { Dim::<3>::within(slip_new, elastic) } else { slip_new }, slides }
}

/// The direction p across a friction that slides, and the change of the slip rate along p per friction along
/// p: d and with it T turn with the mean slip, as a spring of the stiffness T_max / λ would have them do.
/// `None` where nothing slides.
#[must_use]
pub fn lateral_compliance(stick: &FrictionInput<3>, slip: [f64; 2], friction: &[f64; 2]) -> Option<([f64; 2], f64)> {
    let FrictionInput { old, free, compliance, stiffness, time_steps: [before, after] } = *stick;
    let size = Dim::<3>::size(friction);
    if !(size > 0.0) {
        return None;
    }
    let rate = [0, 1].map(|a| free[a] + (compliance[a][0] * friction[0] + compliance[a][1] * friction[1]));
    let quarter = 0.25 * 0.5 * (before + after);
    let softness = if stiffness.is_infinite() {
        Dim::<3>::size(&rate) / size
    } else {
        Dim::<3>::size(&[0, 1].map(|a| slip[a] + quarter * (old[a] + rate[a]))) / (size * quarter)
    };
    Some(([-friction[1] / size, friction[0] / size], softness))
}

/// Force of a tie on the slip `slip` (m, at n): springs that pull both ways, or with an infinite stiffness
/// what ends the slip in one step.
#[must_use]
pub fn tie(stick: &FrictionInput<3>, slip: [f64; 2]) -> [f64; 2] {
    let FrictionInput { old, free, compliance, stiffness, time_steps: [before, after] } = *stick;
    let (give, axis) = axes(compliance);
    if stiffness.is_infinite() {
        if give[1] <= 0.0 {
            return [0.0; 2];
        }
        let rate = onto(axis, [0, 1].map(|a| slip[a] / after + free[a]));
        return back(axis, [0, 1].map(|k| if give[k] > 1e-14 * give[1] { -rate[k] / give[k] } else { 0.0 }));
    }
    let sum = onto(axis, [0, 1].map(|a| 2.0 * slip[a] - 0.5 * before * old[a] + 0.5 * after * free[a]));
    back(axis, [0, 1].map(|k| -0.5 * stiffness * sum[k] / (1.0 + 0.25 * stiffness * after * give[k])))
}

/// Components along two tangents of an elastic slip (m) that lay along another plane: turned the shortest
/// way, so that it keeps its length and its energy.
#[must_use]
pub fn carried(slip: [f64; 3], to: [[f64; 3]; 2]) -> [f64; 2] {
    let seen = to.map(|tangent| dot(tangent, slip));
    let (size, length) = (dot(slip, slip).sqrt(), Dim::<3>::size(&seen));
    if length > 0.0 { seen.map(|component| component * (size / length)) } else { [0.0; 2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some(k: f64, [old, free]: [[f64; 2]; 2], [a, b, c]: [f64; 3]) -> FrictionInput<3> {
        FrictionInput { old, free, compliance: [[a, b], [b, c]], stiffness: k, time_steps: [0.9, 1.1] }
    }

    /// Compliances from round to one that does not yield along an axis.
    const COMPLIANCES: [[f64; 3]; 6] =
        [[0.7, 0.0, 0.7], [0.7, 0.2, 0.5], [2.0, 0.99, 0.5], [1.0, 1.0, 1.0], [0.0, 0.0, 0.8], [30.0, -0.1, 1e-3]];

    #[test]
    fn friction_never_gives_more_than_the_slip_has_stored_and_is_against_the_mean_slip() {
        let (mut least, mut slides, mut sticks) = (f64::INFINITY, 0, 0);
        let rates = [[0.0, 0.0], [1.0, 0.2], [-3.0, 0.1], [0.1, -0.3], [0.0, 2.0]];
        for compliance in COMPLIANCES {
            for (k, limit) in [(0.1, 0.05), (0.1, 3.0), (1.0, 0.4), (50.0, 0.05), (50.0, 3.0), (1e6, 0.4)] {
                for slip in [[0.0, 0.0], [0.1, -0.2], [1.0, 0.5], [-2.0, 1e-3]] {
                    for old in rates {
                        for free in rates {
                            let stick = some(k, [old, free], compliance);
                            let slid = slide(&stick, slip, limit);
                            let pulled = stick.compliance.map(|row| row[0] * slid.friction[0] + row[1] * slid.friction[1]);
                            let moved = [0, 1].map(|a| 0.5 * (old[a] + free[a] + pulled[a]));
                            let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
                            let work = slid.friction[0] * moved[0] + slid.friction[1] * moved[1];
                            let lost = -work - 0.5 * k * (square(slid.slip) - square(slip));
                            let size = square(slid.friction).sqrt();
                            assert!(size <= limit * (1.0 + 1e-14), "{size} {limit}");
                            let scale = 1.0 + k * square(slip) + size * square(moved).sqrt();
                            if slid.slides {
                                let mean = [0, 1].map(|a| slip[a] + 0.5 * moved[a]);
                                let across = mean[0] * slid.friction[1] - mean[1] * slid.friction[0];
                                let along = mean[0] * slid.friction[0] + mean[1] * slid.friction[1];
                                let of = size * (square(mean).sqrt() + square(slip).sqrt() + square(old).sqrt() + square(free).sqrt());
                                assert!(
                                    across.abs() <= 1e-11 * of && along < 1e-12 * of,
                                    "{across} {along} {of} {stick:?} {slip:?} {limit}"
                                );
                                least = least.min(lost / scale);
                                slides += 1;
                            } else {
                                assert!(lost.abs() < 1e-11 * scale, "it sticks, but loses {lost}: {stick:?}");
                                sticks += 1;
                            }
                        }
                    }
                }
            }
        }
        assert!(least > -1e-11 && slides > 500 && sticks > 300, "{least} {slides} {sticks}");
    }

    #[test]
    fn along_one_line_friction_is_that_of_2d() {
        for (slip, old, free, limit) in [(0.1, 0.3, -0.2, 0.4), (0.5, 2.0, 1.0, 0.05), (-0.2, 0.0, 1e-3, 9.0), (0.0, 1.0, 2.0, 0.3)] {
            for stiffness in [0.3, 40.0, f64::INFINITY] {
                let line = FrictionInput { old: [old], free: [free], compliance: [[0.6]], stiffness, time_steps: [0.9, 1.1] };
                let (plane, angle) = (super::super::slide(&line, [slip], limit), [0.6, 0.8]);
                let along = |value: f64| angle.map(|c| value * c);
                let stick = some(stiffness, [along(old), along(free)], [0.6, 0.0, 0.6]);
                let space = slide(&stick, along(slip), limit);
                for a in 0..2 {
                    assert!((space.friction[a] - angle[a] * plane.friction[0]).abs() < 1e-14);
                    assert!((space.slip[a] - angle[a] * plane.slip[0]).abs() < 1e-14);
                }
                assert_eq!(space.slides, plane.slides);
                let tied = tie(&stick, along(slip));
                assert!((tied[0] / 0.6 - super::super::tie(&line, [slip])[0]).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn a_multiplier_stops_the_slip_or_brakes_it_where_it_goes() {
        for compliance in [[0.7, 0.0, 0.7], [0.7, 0.2, 0.5], [2.0, 0.99, 0.5]] {
            let stick = some(f64::INFINITY, [[0.0; 2], [0.4, -0.3]], compliance);
            let after = |slid: &FrictionResult<3>| {
                [0, 1].map(|a| stick.free[a] + stick.compliance[a][0] * slid.friction[0] + stick.compliance[a][1] * slid.friction[1])
            };
            let stopped = slide(&stick, [0.0; 2], 100.0);
            assert!(!stopped.slides && after(&stopped).iter().all(|rate| rate.abs() < 1e-13));
            let braked = slide(&stick, [0.0; 2], 0.05);
            let ([x, y], [u, v]) = (braked.friction, after(&braked));
            assert!(braked.slides && (x * v - y * u).abs() < 1e-15 && x * u + y * v < 0.0, "{braked:?}");
        }
    }

    #[test]
    fn a_carried_slip_keeps_its_length_and_stays_where_tangents_stay() {
        let from = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(carried([0.3, -0.4, 0.0], from), [0.3, -0.4]);
        let to = [[0.8, 0.0, 0.6], [0.0, 1.0, 0.0]];
        let [a, b] = carried([0.3, -0.4, 0.0], to);
        assert!((a * a + b * b - 0.25).abs() < 1e-15 && a > 0.0 && b < 0.0);
    }
}
