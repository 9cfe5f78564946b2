//! `time` and `value`: a curve through points, linear or smooth between them, constant before the first and
//! after the last.
//!
//! Smooth is the polynomial of fifth degree with zero velocity and acceleration at both points: y₀ + (y₁ −
//! y₀) s³ (10 − 15 s + 6 s²), twice continuously differentiable.

/// s³ (10 − 15 s + 6 s²): from 0 to 1 without velocity and acceleration at both ends.
#[must_use]
pub fn smooth_step(s: f64) -> f64 {
    s * s * s * (10.0 + s * (6.0 * s - 15.0))
}

/// Points in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Strictly ascending, s.
    pub times: Vec<f64>,
    /// As many.
    pub values: Vec<f64>,
    /// Whether smooth steps lead from point to point; else straight lines.
    pub smooth: bool,
}

impl Table {
    /// Value at `time`; without points it is zero.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        let next = self.times.partition_point(|&t| t <= time);
        let at = |k: usize| self.values.get(k).copied().unwrap_or(0.0);
        if next == 0 || next >= self.times.len() {
            return at(next.saturating_sub(1));
        }
        let (t0, t1) = (self.times[next - 1], self.times[next]);
        let s = (time - t0) / (t1 - t0);
        let s = if self.smooth { smooth_step(s) } else { s };
        at(next - 1) + s * (at(next) - at(next - 1))
    }

    /// Mean value of straight lines between two times, exact.
    #[must_use]
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        let (first, last) = (self.times.partition_point(|&t| t <= from), self.times.partition_point(|&t| t < to));
        if first >= last {
            return self.value(0.5 * (from + to));
        }
        let (mut sum, mut begin) = (0.0, from);
        for &end in self.times[first..last].iter().chain([&to]) {
            sum += (end - begin) * self.value(0.5 * (begin + end));
            begin = end;
        }
        sum / (to - from)
    }
}
