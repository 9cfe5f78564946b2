//! Numbers that shapes share: equal and graded steps, and angles in quarter turns.
//!
//! Sines, cosines and angles are computed here with fixed operations: the same bits on every platform, exact
//! zeros and ones on the axes (nodes that should lie on a symmetry line do), and mirror images that agree to
//! the last bit.

pub(super) use crate::vector::{cross, dot, minus};
use embate_lanes::math::{exp, ln};
pub(super) use embate_remesh::plane::{distance, on_line};
use std::f64::consts::FRAC_PI_2;

/// Entry `i` of `0..=n` equal steps from `a` to `b`, exact at both ends and symmetric under exchange of the
/// ends.
pub(super) fn between(a: f64, b: f64, i: usize, n: usize) -> f64 {
    if i == 0 {
        a
    } else if i == n {
        b
    } else {
        (a * (n - i) as f64 + b * i as f64) / n as f64
    }
}

/// `n` steps between two values whose lengths grow geometrically.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Steps {
    n: usize,
    /// Where each step begins, from 0 to 1; empty where all are equal.
    places: Vec<f64>,
}

impl Steps {
    /// `grading` is the length of the last step over that of the first.
    pub(super) fn new(n: usize, grading: f64) -> Self {
        if grading == 1.0 || n < 2 {
            return Self { n, places: Vec::new() };
        }
        let ratio = exp(ln(grading) / (n - 1) as f64);
        let (mut places, mut sum, mut length) = (vec![0.0], 0.0, 1.0);
        for _ in 0..n {
            sum += length;
            length *= ratio;
            places.push(sum);
        }
        Self { n, places: places.iter().map(|place| place / sum).collect() }
    }

    /// Place `i` of `0..=n` between `a` and `b`, exact at both ends.
    pub(super) fn between(&self, a: f64, b: f64, i: usize) -> f64 {
        if self.places.is_empty() || i == 0 || i == self.n {
            return between(a, b, i, self.n);
        }
        let place = self.places[i];
        a * (1.0 - place) + b * place
    }

    /// Place `i` of `0..=n` between 0 and 1.
    pub(super) fn place(&self, i: usize) -> f64 {
        self.between(0.0, 1.0, i)
    }
}

/// An angle in radians as a number of quarter turns; whole, half and quarter steps of a quarter turn that
/// were meant are made exact.
pub(in crate::mesh) fn quarters(angle: f64) -> f64 {
    let q = angle / FRAC_PI_2;
    let snapped = (4.0 * q).round() / 4.0;
    if (q - snapped).abs() < 1e-12 { snapped } else { q }
}

/// Cosine and sine of a number of quarter turns, by Taylor polynomials of degree 18 and 17 on ±45 degrees
/// (truncation below 1e-17). Within 1e-12 of whole quarter turns they are exactly 0 and ±1.
pub(in crate::mesh) fn cos_sin(quarters: f64) -> [f64; 2] {
    let whole = quarters.round();
    let mut rest = quarters - whole;
    if rest.abs() < 1e-12 {
        rest = 0.0;
    }
    let r = rest * FRAC_PI_2;
    let r2 = r * r;
    let (mut c, mut s) = (1.0, 1.0);
    // Horner from the inside: each step multiplies by −r²/(k (k + 1)).
    for k in (1..=17).rev().step_by(2) {
        c = 1.0 - r2 / f64::from(k * (k + 1)) * c;
    }
    for k in (2..=16).rev().step_by(2) {
        s = 1.0 - r2 / f64::from(k * (k + 1)) * s;
    }
    s *= r;
    match whole.rem_euclid(4.0) as u8 {
        0 => [c, s],
        1 => [0.0 - s, c],
        2 => [-c, 0.0 - s],
        _ => [s, -c],
    }
}

/// The angle of a vector that is not zero, in quarter turns from −2 to 2: θ ← θ + sin(α − θ) until it stands.
pub(super) fn quarters_of([x, y]: [f64; 2]) -> f64 {
    let length = (x * x + y * y).sqrt();
    let (c, s) = (x / length, y / length);
    // The nearest axis, and the vector seen from there.
    let (whole, c, s) = if c.abs() >= s.abs() {
        if c > 0.0 {
            (0.0, c, s)
        } else if s < 0.0 {
            (-2.0, -c, -s)
        } else {
            (2.0, -c, -s)
        }
    } else if s > 0.0 {
        (1.0, s, -c)
    } else {
        (-1.0, -s, c)
    };
    let mut rest = s / FRAC_PI_2;
    for _ in 0..6 {
        let [cos, sin] = cos_sin(rest);
        rest += (s * cos - c * sin) / FRAC_PI_2;
    }
    whole + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_own_sine_and_cosine_agree_with_the_platforms() {
        let mut worst = 0.0_f64;
        for i in -40_000..=40_000 {
            let q = f64::from(i) * 1.234_567e-4;
            let [c, s] = cos_sin(q);
            worst = worst.max((c - (q * FRAC_PI_2).cos()).abs()).max((s - (q * FRAC_PI_2).sin()).abs());
        }
        // Far angles carry the rounding of their own argument: 7.8 · 1.1e-16.
        assert!(worst < 1.2e-15, "{worst:e}");
        for i in -1000..=1000 {
            let q = f64::from(i) * 5e-4;
            let [c, s] = cos_sin(q);
            assert!((c - (q * FRAC_PI_2).cos()).abs() <= 2.3e-16 && (s - (q * FRAC_PI_2).sin()).abs() <= 1.7e-16, "{q}");
        }
        assert_eq!(
            [0.0, 1.0, 2.0, 3.0, 4.0, -1.0].map(cos_sin),
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, -1.0]]
        );
    }

    #[test]
    fn the_angle_of_a_vector_is_found_again() {
        for i in -1999..=1999 {
            let q = f64::from(i) * 1e-3;
            assert!((quarters_of(cos_sin(q)) - q).abs() < 4e-16 * 4.0, "{q}");
        }
        assert_eq!([[1.0, 0.0], [0.0, 3.0], [-2.0, 0.0], [0.0, -1.0]].map(quarters_of), [0.0, 1.0, 2.0, -1.0]);
    }

    #[test]
    fn the_last_of_graded_steps_is_so_many_times_as_long_as_the_first() {
        for (n, grading) in [(1, 3.0), (2, 3.0), (7, 0.2), (100, 50.0), (5, 1.0)] {
            let steps = Steps::new(n, grading);
            let length = |i: usize| steps.between(1.0, 3.0, i + 1) - steps.between(1.0, 3.0, i);
            assert!(n == 1 || (length(n - 1) / length(0) / grading - 1.0).abs() < 1e-11, "{n} {grading}");
            assert!((1..n).all(|i| (length(i) / length(i - 1) * length(0) / length(1) - 1.0).abs() < 1e-11));
            assert_eq!((steps.between(1.0, 3.0, 0), steps.between(1.0, 3.0, n)), (1.0, 3.0));
        }
    }
}
