//! Curves over a column of the history that may go back, such as force over displacement, at the places where
//! something was measured.
//!
//! Both are followed in their order: the value of each place is taken where the run passes it at or after the
//! place before. So loading is compared with loading, and unloading with unloading. Going back by less than
//! [`STILL`] of the measured range is standing still, in both: noise turns no curve. `embate fit` and
//! Python's `embate.calibrate` ask here.

use std::fmt;

/// Part of the measured range by which a curve goes back without turning, and by which a run may miss a
/// place.
const STILL: f64 = 0.01;

/// A place that a run does not come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missed {
    /// Its number from 0.
    pub number: usize,
    /// Where it is.
    pub place: f64,
    /// Where the run is after the place before: the least and the largest.
    pub range: [f64; 2],
}

impl fmt::Display for Missed {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.range;
        let after = if self.number == 0 { "the run is" } else { "after the place before it the run is" };
        write!(out, "the run does not come to {:.6e}: {after} between {low:.6e} and {high:.6e}", self.place)
    }
}

/// Values of the curve (x, y), on straight lines between its points, at `places`, which are passed in their
/// order.
///
/// # Errors
/// The first place that the curve does not pass after those before.
pub fn followed(x: &[f64], y: &[f64], places: &[f64]) -> Result<Vec<f64>, Missed> {
    let slack = STILL * width(places);
    let (x, places) = (without_returns(x, slack), without_returns(places, slack));
    let mut way = Way { x: &x, ends: ends(&x, slack), segment: 0, share: 0.0 };
    let mut values = Vec::with_capacity(places.len());
    for (number, &place) in places.iter().enumerate() {
        (way.segment, way.share) = way.next(place, slack).ok_or_else(|| {
            let range = way.rest().map(|(_, [a, b])| [a.min(b), a.max(b)]).reduce(|one, next| [one[0].min(next[0]), one[1].max(next[1])]);
            Missed { number, place, range: range.unwrap_or([f64::NAN; 2]) }
        })?;
        let [from, to] = [way.segment, way.segment + 1].map(|at| y.get(at).copied().unwrap_or(f64::NAN));
        // Exactly an end where it is one.
        values.push(match way.share {
            0.0 => from,
            1.0 => to,
            share => from + share * (to - from),
        });
    }
    Ok(values)
}

/// How far one has come on a curve.
struct Way<'a> {
    x: &'a [f64],
    /// 1 at points where it begins, turns or ends and that are larger than those beside them, -1 where they
    /// are smaller, 0 at all others.
    ends: Vec<f64>,
    segment: usize,
    /// Part of the segment.
    share: f64,
}

impl Way<'_> {
    /// Segments that are left, the first one from where it is.
    fn rest(&self) -> impl Iterator<Item = (usize, [f64; 2])> {
        let after = self.x.windows(2).enumerate().skip(self.segment);
        after.map(|(at, ends)| (at, [if at == self.segment { ends[0] + self.share * (ends[1] - ends[0]) } else { ends[0] }, ends[1]]))
    }

    /// Where it passes a place next, or turns, begins or ends a little before it.
    fn next(&self, place: f64, slack: f64) -> Option<(usize, f64)> {
        let is_beyond = |point: usize| (f64::MIN_POSITIVE..=slack).contains(&(self.ends[point] * (place - self.x[point])));
        if self.share == 0.0 && self.segment + 1 < self.x.len() && is_beyond(self.segment) {
            return Some((self.segment, 0.0));
        }
        self.rest().find_map(|(at, [from, to])| {
            if from.min(to) <= place && place <= from.max(to) {
                let begin = if at == self.segment { self.share } else { 0.0 };
                let part = if place == from { 0.0 } else { (place - from) / (to - from) };
                return Some((at, (begin + part * (1.0 - begin)).min(1.0)));
            }
            is_beyond(at + 1).then_some((at, 1.0))
        })
    }
}

/// See [`Way::ends`].
fn ends(x: &[f64], slack: f64) -> Vec<f64> {
    let mut ends = vec![0.0; x.len()];
    let turns: Vec<usize> = [0].into_iter().chain(turns(x, slack)).chain(x.len().checked_sub(1)).collect();
    for pair in turns.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let way = if x[to] == x[from] { 0.0 } else { (x[to] - x[from]).signum() };
        (ends[from], ends[to]) = (-way, way);
    }
    ends
}

fn width(values: &[f64]) -> f64 {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let width = finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min);
    width.max(0.0)
}

/// The same values, where what goes back by less than `slack` stands still: between two turns they only rise
/// or only fall.
fn without_returns(values: &[f64], slack: f64) -> Vec<f64> {
    let mut still = values.to_vec();
    let mut begin = 0;
    for end in turns(values, slack).into_iter().chain([values.len().saturating_sub(1)]) {
        let rises = values.get(end) >= values.get(begin);
        for at in begin + 1..=end {
            still[at] = if rises { still[at].max(still[at - 1]) } else { still[at].min(still[at - 1]) };
        }
        begin = end;
    }
    still
}

/// Where the values turn: from there they go back by at least `slack`, and not by nothing.
fn turns(values: &[f64], slack: f64) -> Vec<usize> {
    // The farthest either way since the last turn.
    let (mut low, mut high, mut rises) = (0, 0, None);
    let mut found = Vec::new();
    for (at, &value) in values.iter().enumerate() {
        high = if value > values[high] { at } else { high };
        low = if value < values[low] { at } else { low };
        let (down, up) = (values[high] - value, value - values[low]);
        let (turn, back) = if rises.unwrap_or(down >= up) { (high, down) } else { (low, up) };
        if back > 0.0 && back >= slack {
            // Before the first way there was none that could turn.
            found.extend(rises.map(|_| turn));
            rises = Some(value > values[turn]);
            (low, high) = (at, at);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run: displacement up to 1, back to 0.4, up to 2; and the time as value.
    fn cycle() -> (Vec<f64>, Vec<f64>) {
        let x: Vec<f64> = (0..=10).map(|k| 0.1 * f64::from(k)).chain((4..10).rev().map(|k| 0.1 * f64::from(k))).collect();
        let x: Vec<f64> = x.into_iter().chain((5..=20).map(|k| 0.1 * f64::from(k))).collect();
        let y = (0..x.len()).map(|k| k as f64).collect();
        (x, y)
    }

    fn near(found: &[f64], wanted: &[f64]) {
        assert!(found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} {wanted:?}");
    }

    #[test]
    fn a_curve_that_only_rises_or_only_falls_is_interpolated() {
        let (x, y) = ([0.0, 1.0, 3.0], [5.0, 7.0, 3.0]);
        near(&followed(&x, &y, &[0.0, 0.5, 2.0, 3.0]).unwrap(), &[5.0, 6.0, 5.0, 3.0]);
        let back = x.map(|x| -x);
        near(&followed(&back, &y, &[0.0, -0.5, -2.0, -3.0]).unwrap(), &[5.0, 6.0, 5.0, 3.0]);
        // Places at one place, and a curve that stands still.
        near(&followed(&x, &y, &[1.0, 1.0, 2.0]).unwrap(), &[7.0, 7.0, 5.0]);
        near(&followed(&[0.0, 0.0, 1.0], &[9.0, 4.0, 6.0], &[0.0, 0.5]).unwrap(), &[9.0, 5.0]);
    }

    #[test]
    fn loading_and_unloading_are_told_apart() {
        let (x, y) = cycle();
        near(&followed(&x, &y, &[0.05, 0.55, 0.95, 0.75, 0.45, 0.55, 1.5]).unwrap(), &[0.5, 5.5, 9.5, 12.5, 15.5, 17.5, 27.0]);
        // The other way round it is the same.
        let mirrored: Vec<f64> = x.iter().map(|x| -x).collect();
        near(&followed(&mirrored, &y, &[-0.55, -0.95, -0.75]).unwrap(), &[5.5, 9.5, 12.5]);
        // What turns earlier than the run does: the way back is that after the run's turn.
        near(&followed(&x, &y, &[0.5, 0.8, 0.5]).unwrap(), &[5.0, 8.0, 15.0]);
    }

    #[test]
    fn noise_turns_nothing() {
        let (x, y) = cycle();
        // Back by 0.5 % of the range: as if it had stood still.
        near(&followed(&x, &y, &[0.2, 0.195, 0.3, 1.2]).unwrap(), &[2.0, 2.0, 3.0, 24.0]);
        let mut shaken = x.clone();
        shaken.splice(3..3, [0.201, 0.199, 0.205]);
        let times: Vec<f64> = (0..shaken.len()).map(|k| k as f64).collect();
        near(&followed(&shaken, &times, &[0.2, 0.203, 0.3, 0.5, 1.2]).unwrap(), &[2.0, 4.5, 6.0, 8.0, 27.0]);
        // A turn that the run misses by less: its own turn.
        near(&followed(&x, &y, &[0.0, 1.005, 0.7]).unwrap(), &[0.0, 10.0, 13.0]);
    }

    #[test]
    fn what_is_not_reached_is_named() {
        let (x, y) = cycle();
        let missed = followed(&x, &y, &[0.5, 1.0, 0.3]).unwrap_err();
        assert_eq!((missed.number, missed.place), (2, 0.3));
        assert!((missed.range[0] - 0.4).abs() < 1e-12 && missed.range[1] == 2.0, "{missed:?}");
        assert!(missed.to_string().starts_with("the run does not come to 3.000000e-1: after the place before it the run is between"));
        assert_eq!(followed(&x, &y, &[-1.0, 0.0]).unwrap_err().number, 0);
        assert_eq!(followed(&x, &y, &[0.0, 2.5]).unwrap_err().number, 1);
        for x in [vec![], vec![1.0], vec![f64::NAN; 3]] {
            assert!(followed(&x, &y[..x.len()], &[1.0]).is_err());
        }
    }
}
