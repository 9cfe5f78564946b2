//! Curves: functions of time, linear between their points, constant before the first and after the last; and velocities that follow them.
//!
//! Curves come from the model. Constraints and rigid bodies ask for the mean velocity over a step, so that what is driven is at every step where the
//! integral of its curve says, whatever the step.

use crate::model::{Drive, Model};

/// A function of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Strictly ascending, s.
    times: Vec<f64>,
    values: Vec<f64>,
}

impl Curve {
    /// Through these points; as many times, strictly ascending, as values. Without points it is zero.
    #[must_use]
    pub fn new(times: Vec<f64>, values: Vec<f64>) -> Self {
        Self { times, values }
    }

    /// Value at `time`.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        let next = self.times.partition_point(|&t| t <= time);
        let at = |k: usize| self.values.get(k).copied().unwrap_or(0.0);
        if next == 0 || next >= self.times.len() {
            return at(next.saturating_sub(1));
        }
        let (t0, t1) = (self.times[next - 1], self.times[next]);
        let s = (time - t0) / (t1 - t0);
        at(next - 1) + s * (at(next) - at(next - 1))
    }

    /// Mean value between two times; the value itself where they are one.
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

/// The curves of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curves {
    list: Vec<Curve>,
    names: Vec<String>,
}

/// A velocity that is prescribed: a constant and multiples of curves, m/s or rad/s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Speed {
    constant: f64,
    /// Factor and curve.
    terms: Vec<(f64, usize)>,
}

impl Curves {
    /// Of a model that has been checked.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let list = model.curves.values().map(|curve| Curve::new(curve.times.clone(), curve.values.clone())).collect();
        Self { list, names: model.curves.keys().cloned().collect() }
    }

    /// The velocity that a drive means; `None` where there is no such curve.
    #[must_use]
    pub fn speed(&self, drive: &Drive) -> Option<Speed> {
        match drive {
            Drive::Constant(velocity) => Some(Speed::constant(*velocity)),
            Drive::Curve(name) => {
                let curve = self.names.iter().position(|it| it == name)?;
                Some(Speed { constant: 0.0, terms: vec![(1.0, curve)] })
            }
        }
    }

    /// Mean of `speed` between two times, s.
    #[must_use]
    pub fn mean(&self, speed: &Speed, from: f64, to: f64) -> f64 {
        speed.terms.iter().fold(speed.constant, |sum, &(factor, curve)| sum + factor * self.list[curve].mean(from, to))
    }
}

impl Speed {
    /// The same at all times.
    #[must_use]
    pub fn constant(velocity: f64) -> Self {
        Self { constant: velocity, terms: Vec::new() }
    }

    /// Whether it is the same at all times, and which.
    #[must_use]
    pub fn as_constant(&self) -> Option<f64> {
        self.terms.is_empty().then_some(self.constant)
    }

    /// This velocity plus `factor` times another.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let mut sum = Self { constant: self.constant + factor * other.constant, terms: self.terms.clone() };
        for &(share, curve) in &other.terms {
            match sum.terms.iter_mut().find(|(_, it)| *it == curve) {
                Some((own, _)) => *own += factor * share,
                None => sum.terms.push((factor * share, curve)),
            }
        }
        sum
    }

    /// This velocity `factor` times.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        Self { constant: factor * self.constant, terms: self.terms.iter().map(|&(share, curve)| (factor * share, curve)).collect() }
    }

    /// Whether it is nothing but round-off beside velocities of the size of `scale` (m/s) and whole curves.
    #[must_use]
    pub fn is_round_off(&self, scale: f64) -> bool {
        self.constant.abs() <= 1e-9 * scale && self.terms.iter().all(|(share, _)| share.abs() <= 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_linear_between_its_points_and_constant_beyond() {
        let curve = Curve::new(vec![1.0, 2.0, 4.0], vec![3.0, 5.0, -1.0]);
        for (time, value) in [(-7.0, 3.0), (1.0, 3.0), (1.5, 4.0), (2.0, 5.0), (3.0, 2.0), (4.0, -1.0), (9.0, -1.0)] {
            assert_eq!(curve.value(time), value, "at {time}");
        }
        assert_eq!(Curve::new(vec![2.0], vec![7.0]).value(1.0), 7.0);
    }

    #[test]
    fn means_over_steps_add_up_to_the_integral() {
        let curve = Curve::new(vec![1.0, 2.0, 4.0], vec![3.0, 5.0, -1.0]);
        // 3 until 1, 4 until 2, 2 on average until 4, then −1.
        assert!((5.0 * curve.mean(0.0, 5.0) - (3.0 + 4.0 + 4.0 - 1.0)).abs() < 1e-14);
        for steps in [1, 3, 7, 100] {
            let dt = 5.0 / f64::from(steps);
            let sum: f64 = (0..steps).map(|k| dt * curve.mean(dt * f64::from(k), dt * f64::from(k + 1))).sum();
            assert!((sum - 10.0).abs() < 1e-13, "{steps}: {sum}");
        }
        assert_eq!(curve.mean(2.0, 2.0), 5.0);
        assert_eq!(curve.mean(3.0, 3.0), 2.0);
    }
}
