//! Cosine and sine with the same bits on every platform; those of the standard library differ between
//! platforms.

use embate_lanes::Lane;
use std::f64::consts::FRAC_PI_2;

/// Added and taken away again, it rounds numbers below 2^51 to whole ones.
const ROUNDS: f64 = 6_755_399_441_055_744.0;

/// Cosine and sine by Taylor polynomials on ±45 degrees (truncation below 1e-17): the same bits on every
/// platform.
pub(crate) fn cos_sin(angle: f64) -> [f64; 2] {
    let quarters = (angle / FRAC_PI_2).round();
    let r = angle - quarters * FRAC_PI_2;
    let r2 = r * r;
    let (mut cos, mut sin) = (1.0, 1.0);
    // Horner from the inside: each step multiplies by −r²/(k (k + 1)).
    for k in (1..=17).rev().step_by(2) {
        cos = 1.0 - r2 / f64::from(k * (k + 1)) * cos;
    }
    for k in (2..=16).rev().step_by(2) {
        sin = 1.0 - r2 / f64::from(k * (k + 1)) * sin;
    }
    sin *= r;
    match quarters.rem_euclid(4.0) as u8 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// [`cos_sin`] in lanes, below 2^51 quarters of a turn.
#[inline(always)]
pub(crate) fn cos_sin_of<L: Lane>(angle: L) -> [L; 2] {
    let (one, rounds) = (L::splat(1.0), L::splat(ROUNDS));
    let quarters = angle * L::splat(1.0 / FRAC_PI_2) + rounds - rounds;
    let r = angle - quarters * L::splat(FRAC_PI_2);
    let r2 = r * r;
    let (mut cos, mut sin) = (one, one);
    for k in (1..=17).rev().step_by(2) {
        cos = one - r2 * L::splat(1.0 / (k * (k + 1)) as f64) * cos;
    }
    for k in (2..=16).rev().step_by(2) {
        sin = one - r2 * L::splat(1.0 / (k * (k + 1)) as f64) * sin;
    }
    sin = sin * r;
    // −2 to 2: 1 and −1 are odd quarters.
    let rest = quarters - L::splat(4.0) * (quarters * L::splat(0.25) + rounds - rounds);
    let is_odd = (rest.abs() - one).abs().less(L::splat(0.5));
    let sign = one - rest.abs();
    [L::select(is_odd, -(rest * sin), sign * cos), L::select(is_odd, rest * cos, sign * sin)]
}

/// The angle from the first axis to a direction, in (−π, π]: by the angle's eighth, whose tangent has a short
/// series; the same bits on every platform. Zero where there is no direction.
pub(crate) fn angle_of([x, y]: [f64; 2]) -> f64 {
    let length = (x * x + y * y).sqrt();
    if length == 0.0 {
        return 0.0;
    }
    // tan(α/2) = sin α / (1 + cos α), from the side where that is at most 1.
    let (x, y) = (x / length, y / length);
    if x < 0.0 {
        let rest = angle_of([-x, y.abs()]);
        let angle = std::f64::consts::PI - rest;
        return if y < 0.0 { -angle } else { angle };
    }
    let mut tangent = y / (1.0 + x);
    for _ in 0..2 {
        tangent /= 1.0 + (1.0 + tangent * tangent).sqrt();
    }
    let square = tangent * tangent;
    // |tan| < 0.2: the first term that is left out is below 1e-18 of the first.
    let series = (0..13).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - square * sum);
    8.0 * tangent * series
}

/// B with atan(t)/t = 1 − t² B, of the square of t, in lanes, |t| ≤ 1: by the angle's quarter, whose tangent
/// has a short series. Nothing cancels where t is small.
#[inline(always)]
pub(crate) fn arc_of_tangent<L: Lane>(square: L) -> L {
    let (one, two) = (L::splat(1.0), L::splat(2.0));
    // tan(α/2) = t/(1 + √(1 + t²)), twice.
    let first = one / (one + (one + square).sqrt());
    let halved = square * first * first;
    let second = one / (one + (one + halved).sqrt());
    let quartered = halved * second * second;
    // |tan| < 0.2: the first term that is left out is below 1e-18 of the first.
    let mut series = L::splat(0.0);
    for k in (0..13).rev() {
        series = L::splat(1.0 / (2 * k + 3) as f64) - quartered * series;
    }
    // 1 − atan(t)/t from that of the half: t²/(1 + √)² (1 + 2/(1 + √) B).
    series = second * second * (one + two * second * series);
    first * first * (one + two * first * series)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_in_lanes_are_those_of_numbers() {
        for i in -40_000..=40_000 {
            let angle = f64::from(i) * 1.234_567e-3;
            let ([c, s], [d, t]) = (cos_sin_of(angle), [angle.cos(), angle.sin()]);
            assert!((c - d).abs() < 1e-14 && (s - t).abs() < 1e-14, "{angle}");
        }
        assert_eq!(cos_sin_of(0.0), [1.0, 0.0]);
    }

    #[test]
    fn the_angle_of_a_direction_is_found() {
        for i in -100_000i32..=100_000 {
            let angle = f64::from(i) * std::f64::consts::PI / 100_000.0;
            let found = angle_of([3.0 * angle.cos(), 3.0 * angle.sin()]);
            assert!((found - angle).abs() < 2e-15 || i.abs() == 100_000, "{found} {angle}");
        }
        for small in [1e-300, 1e-20, 1e-9] {
            assert!((angle_of([1.0, small]) / small - 1.0).abs() < 4e-16);
        }
        assert_eq!([angle_of([0.0, 0.0]), angle_of([-1.0, 0.0])], [0.0, std::f64::consts::PI]);
    }

    #[test]
    fn the_arc_of_a_tangent_is_found() {
        for k in 0..=10_000 {
            let t = f64::from(k) * 1e-4;
            let found = t * (1.0 - t * t * arc_of_tangent(t * t));
            assert!((found - t.atan()).abs() <= 4e-16, "{t}: {found}");
        }
        assert!((arc_of_tangent(0.0) - 1.0 / 3.0).abs() < 1e-16);
        // 1/3 − t²/5 + ...
        assert!((arc_of_tangent(1e-6) - (1.0 / 3.0 - 0.2e-6)).abs() < 1e-12);
    }

    #[test]
    fn the_own_sine_and_cosine_agree_with_the_platforms_for_slow_and_for_many_turns() {
        let mut worst = 0.0_f64;
        for i in -40_000..=40_000 {
            let angle = f64::from(i) * 1.234_567e-3;
            let [c, s] = cos_sin(angle);
            worst = worst.max((c - angle.cos()).abs()).max((s - angle.sin()).abs());
        }
        assert!(worst < 1e-14, "{worst:e}");
        for angle in [1e-30, 1e-12, -1e-9, 1e-5] {
            assert!((cos_sin(angle)[1] / angle.sin() - 1.0).abs() < 3e-16);
        }
    }
}
