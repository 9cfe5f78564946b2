//! A curve whose values the program that drives a simulation gives, one after the other: straight lines, or
//! jumps, from one to the next.

use crate::archive::{Archive, ArchiveResult, Persist};

/// Half a step before the last change, the change, and its end: time (s) and value of each. Change and end
/// are at one time where the value jumps; it is the old one until then and at that time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Steered {
    points: [[f64; 2]; 3],
}

impl Persist for Steered {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { points } = self;
        points.persist(archive)
    }
}

impl Steered {
    /// Two points of what was, ascending in time, and where it goes, not before the second.
    #[must_use]
    pub fn new([before, change]: [[f64; 2]; 2], end: [f64; 2]) -> Self {
        Self { points: [before, change, end] }
    }

    /// Times of its corners, ascending, s.
    #[must_use]
    pub fn times(&self) -> [f64; 3] {
        self.points.map(|[time, _]| time)
    }

    /// Value at `time`.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        let [before, change, end] = self.points;
        if time <= before[0] {
            before[1]
        } else if time <= change[0] {
            between(before, change, time)
        } else if time < end[0] {
            between(change, end, time)
        } else {
            end[1]
        }
    }

    /// Mean value between two times, exact.
    #[must_use]
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        if to <= from {
            return self.value(from);
        }
        let (mut sum, mut begin) = (0.0, from);
        for corner in self.times().into_iter().filter(|&time| from < time && time < to).chain([to]) {
            sum += (corner - begin) * self.value(0.5 * (begin + corner));
            begin = corner;
        }
        sum / (to - from)
    }
}

/// On the straight line between two points.
fn between([t0, y0]: [f64; 2], [t1, y1]: [f64; 2], time: f64) -> f64 {
    y0 + (time - t0) / (t1 - t0) * (y1 - y0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_behind_its_time_and_a_ramp_ends_where_it_should() {
        let jump = Steered::new([[1.0, 4.0], [2.0, 6.0]], [2.0, -1.0]);
        assert_eq!([0.0, 1.5, 2.0, 2.0_f64.next_up(), 9.0].map(|time| jump.value(time)), [4.0, 5.0, 6.0, -1.0, -1.0]);
        let ramp = Steered::new([[1.0, 4.0], [2.0, 6.0]], [4.0, 0.0]);
        assert_eq!([2.0, 3.0, 4.0, 5.0].map(|time| ramp.value(time)), [6.0, 3.0, 0.0, 0.0]);
    }

    #[test]
    fn means_are_integrals() {
        let jump = Steered::new([[1.0, 4.0], [2.0, 6.0]], [2.0, -1.0]);
        // Half of 5.5 and half of -1; all before; all behind; a point.
        assert_eq!([(1.5, 2.5), (1.0, 2.0), (2.0, 3.0), (2.0, 2.0)].map(|(from, to)| jump.mean(from, to)), [2.25, 5.0, -1.0, 6.0]);
        let ramp = Steered::new([[1.0, 4.0], [2.0, 6.0]], [4.0, 0.0]);
        assert!((ramp.mean(0.0, 6.0) - (4.0 + 5.0 + 6.0) / 6.0).abs() < 1e-15);
    }
}
