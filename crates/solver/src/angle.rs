//! Cosine and sine with the same bits on every platform; those of the standard library differ between
//! platforms.

use std::f64::consts::FRAC_PI_2;

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

#[cfg(test)]
mod tests {
    use super::*;

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
