//! When a weld fails: (N/N_f)^a + (Q/Q_f)^b + (M/M_f)^c ≥ 1 with the tensile force N, the shear force Q and
//! the moment M, each of which has gone through a low-pass filter of first order.

use embate_lanes::math;

/// The criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// N_f and Q_f (N), M_f (N m); infinite: no limit.
    pub limits: [f64; 3],
    /// a, b, c.
    pub exponents: [f64; 3],
    /// Time of the filter, s.
    pub filter: f64,
}

impl Strength {
    /// Part of the change of a force that passes the filter in a step, s.
    pub(super) fn share(&self, step: f64) -> f64 {
        if self.filter > 0.0 { step / (self.filter + step) } else { 1.0 }
    }

    /// Whether it fails at these forces along and moments about its axes; the first is the normal force,
    /// positive where it presses.
    pub(super) fn fails(&self, &[normal, b, c, x, y, z]: &[f64; 6]) -> bool {
        let found = [(-normal).max(0.0), (b * b + c * c).sqrt(), (x * x + y * y + z * z).sqrt()];
        let term = |k: usize| {
            let ratio = found[k] / self.limits[k];
            match self.exponents[k] {
                _ if ratio <= 0.0 => 0.0,
                1.0 => ratio,
                2.0 => ratio * ratio,
                exponent => math::exp(exponent * math::ln(ratio)),
            }
        };
        term(0) + term(1) + term(2) >= 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_fails_on_the_surface_of_its_criterion_and_not_by_pressing() {
        let strength = Strength { limits: [3.0, 4.0, 5.0], exponents: [2.0, 1.5, 1.0], filter: 0.0 };
        assert!(strength.fails(&[-3.0, 0.0, 0.0, 0.0, 0.0, 0.0]) && !strength.fails(&[-2.9999, 0.0, 0.0, 0.0, 0.0, 0.0]));
        assert!(!strength.fails(&[30.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
        assert!(strength.fails(&[0.0, 2.4, -3.2001, 0.0, 0.0, 0.0]) && !strength.fails(&[0.0, 2.4, -3.1999, 0.0, 0.0, 0.0]));
        // ¼ + (½)^1.5 = 0.603553…, so a moment of 1.982233… fails.
        assert!(strength.fails(&[-1.5, 2.0, 0.0, 0.0, 1.98224, 0.0]) && !strength.fails(&[-1.5, 2.0, 0.0, 0.0, 1.98222, 0.0]));
        let only = Strength { limits: [f64::INFINITY, 1.0, f64::INFINITY], ..strength };
        assert!(!only.fails(&[-1e9, 0.999, 0.0, 1e9, 0.0, 0.0]) && only.fails(&[0.0, 1.001, 0.0, 0.0, 0.0, 0.0]));
    }
}
