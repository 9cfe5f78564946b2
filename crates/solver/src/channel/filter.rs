//! Low-pass filters without phase: of the channel frequency classes of SAE J211/1 and ISO 6487, and
//! Butterworth ones with a corner.
//!
//! A Butterworth filter of second order runs over the samples forwards and backwards:
//!
//! ```text
//! y_k = a₀ x_k + 2 a₀ x_{k−1} + a₀ x_{k−2} + b₁ y_{k−1} + b₂ y_{k−2}
//! ω = tan(π f T),  a₀ = ω²/(1 + √2 ω + ω²),  b₁ = −2 (ω² − 1)/(1 + √2 ω + ω²),
//! b₂ = −(1 − √2 ω + ω²)/(1 + √2 ω + ω²)
//! ```
//!
//! with the sampling interval T. Both passes together damp by (1 + (tan(π f' T)/ω)⁴)⁻¹ at a frequency f', 3
//! dB at 0.8022 f where samples are dense. Of a class CFC the standard has f = 2.0775 CFC, and so 3 dB at
//! CFC/0.6; of a corner ω is such that it is exactly there. Before the passes the samples are continued at
//! both ends by their point reflection, so that ends do not ring.
//!
//! Source: SAE J211/1 and ISO 6487, whose formulas for this filter differ by 0.3 % in the frequency.

pub use crate::model::Filter;
use std::f64::consts::{PI, SQRT_2};

/// Frequency of each pass over the class.
const OF_CLASS: f64 = 2.0775;

impl Filter {
    /// The longest interval between samples that the standard allows, s: ten samples for the class's number
    /// in Hz, six for the frequency of 3 dB.
    #[must_use]
    pub fn longest_interval(self) -> f64 {
        match self {
            Self::Class(class) => 0.1 / class,
            Self::Corner(corner) => 1.0 / (6.0 * corner),
        }
    }

    /// Filtered values at times that ascend, s. Between times that are not even the values are taken from
    /// straight lines.
    #[must_use]
    pub fn apply(self, times: &[f64], values: &[f64]) -> Vec<f64> {
        let count = values.len().min(times.len());
        if count < 3 {
            return values.to_vec();
        }
        let (first, last) = (times[0], times[count - 1]);
        let interval = (last - first) / (count - 1) as f64;
        let (frequency, share) = match self {
            Self::Class(class) => (OF_CLASS * class, 1.0),
            Self::Corner(corner) => (corner, (SQRT_2 - 1.0).powf(0.25)),
        };
        // Above half the sampling frequency there is nothing to damp.
        if !(interval > 0.0) || frequency * interval >= 0.5 {
            return values.to_vec();
        }
        let even: Vec<f64> = (0..count).map(|k| first + interval * k as f64).collect();
        let samples = interpolated(times, values, &even);
        let omega = (PI * frequency * interval).tan() / share;
        let filtered = filtered(&samples, omega, (2.0 / (frequency * interval)).ceil() as usize);
        interpolated(&even, &filtered, &times[..count])
    }
}

/// Both passes over samples that are continued by so many at both ends.
fn filtered(samples: &[f64], omega: f64, more: usize) -> Vec<f64> {
    let count = samples.len();
    let more = more.clamp(2, count - 1);
    let (first, last) = (samples[0], samples[count - 1]);
    let before = (1..=more).rev().map(|k| 2.0 * first - samples[k]);
    let after = (1..=more).map(|k| 2.0 * last - samples[count - 1 - k]);
    let mut values: Vec<f64> = before.chain(samples.iter().copied()).chain(after).collect();
    pass(&mut values, omega);
    values.reverse();
    pass(&mut values, omega);
    values.reverse();
    values[more..more + count].to_vec()
}

/// One pass, from rest at the first value.
fn pass(values: &mut [f64], omega: f64) {
    let whole = 1.0 + SQRT_2 * omega + omega * omega;
    let a0 = omega * omega / whole;
    let [b1, b2] = [-2.0 * (omega * omega - 1.0) / whole, -(1.0 - SQRT_2 * omega + omega * omega) / whole];
    let (mut x, mut y) = ([values[0]; 2], [values[0]; 2]);
    for value in values {
        let next = a0 * *value + 2.0 * a0 * x[0] + a0 * x[1] + b1 * y[0] + b2 * y[1];
        (x, y) = ([*value, x[0]], [next, y[0]]);
        *value = next;
    }
}

/// Values on straight lines between points; the first and the last one beyond.
pub(super) fn interpolated(times: &[f64], values: &[f64], at: &[f64]) -> Vec<f64> {
    let mut next = 1;
    let value = |&time: &f64| {
        while next + 1 < times.len() && times[next] < time {
            next += 1;
        }
        let [from, to] = [times[next - 1], times[next]];
        let share = if to > from { ((time - from) / (to - from)).clamp(0.0, 1.0) } else { 1.0 };
        values[next - 1] + share * (values[next] - values[next - 1])
    };
    at.iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decibels by which a sine of a frequency (Hz) is damped in the middle of a long record.
    fn gain(filter: Filter, frequency: f64, rate: f64) -> f64 {
        let cycles = 40.0;
        let count = (cycles * rate / frequency).max(4000.0) as usize;
        let times: Vec<f64> = (0..count).map(|k| k as f64 / rate).collect();
        let sine = |t: &f64| (2.0 * PI * frequency * t).sin();
        let values: Vec<f64> = times.iter().map(sine).collect();
        let found = filter.apply(&times, &values);
        let middle = count / 3..2 * count / 3;
        // By its projection on the sine: the phase counts too.
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let ratio = dot(&found[middle.clone()], &values[middle.clone()]) / dot(&values[middle.clone()], &values[middle]);
        20.0 * ratio.log10()
    }

    /// The corridor of SAE J211/1, figure 1, for each class: F_L = 0.1 Hz to F_H = CFC within +0.5/−1 dB, at
    /// F_N = CFC/0.6 within +0.5/−4 dB, then a slope between −9 dB and −24 dB an octave from there, down to
    /// −30 dB (60, 180) or −40 dB (600, 1000).
    #[test]
    fn classes_keep_to_the_corridor_of_the_standard() {
        for class in [60.0, 180.0, 600.0, 1000.0] {
            let rate = 20.0 * class;
            let at = |frequency: f64| gain(Filter::Class(class), frequency, rate);
            for share in [0.01, 0.1, 0.3, 0.6, 0.8] {
                let damped = at(share * class);
                assert!((-1.0..=0.5).contains(&damped), "CFC {class} at {share}: {damped} dB");
            }
            let damped = at(class);
            assert!((-1.0..=0.5).contains(&damped), "CFC {class} at F_H: {damped} dB");
            let corner = at(class / 0.6);
            assert!((corner + 3.0).abs() < 0.25, "CFC {class} at F_N: {corner} dB");
            let octave = at(2.0 * class / 0.6);
            assert!((-4.0 - 24.0..=0.5 - 9.0).contains(&octave), "CFC {class} an octave above: {octave} dB");
            let floor = if class < 500.0 { -30.0 } else { -40.0 };
            assert!(at(8.0 * class) < floor, "CFC {class} far above");
        }
    }

    #[test]
    fn a_corner_is_where_three_decibels_are_lost() {
        for rate in [3000.0, 20_000.0] {
            let damped = gain(Filter::Corner(200.0), 200.0, rate);
            assert!((damped + 10.0 * 2f64.log10()).abs() < 0.02, "{damped}");
        }
    }

    #[test]
    fn constants_and_straight_lines_pass_and_uneven_times_do_no_harm() {
        let times: Vec<f64> = (0..400).map(|k| 1e-4 * (f64::from(k) + 0.3 * f64::from(k % 3))).collect();
        let values: Vec<f64> = times.iter().map(|t| 5.0 - 200.0 * t).collect();
        for filter in [Filter::Class(60.0), Filter::Class(1000.0), Filter::Corner(900.0)] {
            for (found, wanted) in filter.apply(&times, &values).iter().zip(&values) {
                assert!((found - wanted).abs() < 0.02, "{filter:?}: {found} for {wanted}");
            }
        }
        assert_eq!(Filter::Class(60.0).apply(&[0.0, 1.0], &[3.0, 4.0]), [3.0, 4.0]);
    }
}
