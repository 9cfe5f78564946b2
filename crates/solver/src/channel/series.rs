//! Functions of whole series of the history, as formulas of channels call them.

use super::filter::{Filter, interpolated};

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.806_65;

type Function = fn(&[f64], &[Vec<f64>]) -> Vec<f64>;

/// A function of series.
pub(super) struct Series {
    pub(super) name: &'static str,
    /// Number of arguments.
    pub(super) takes: usize,
    /// What it is, for the documentation.
    pub(super) doc: &'static str,
    /// Of the times, s, and the arguments.
    pub(super) of: Function,
}

const fn series(name: &'static str, takes: usize, doc: &'static str, of: Function) -> Series {
    Series { name, takes, doc, of }
}

/// Every function.
pub(super) const SERIES: &[Series] = &[
    series("cfc60", 1, "filtered by CFC 60 of SAE J211", |t, x| Filter::Class(60.0).apply(t, &x[0])),
    series("cfc180", 1, "by CFC 180", |t, x| Filter::Class(180.0).apply(t, &x[0])),
    series("cfc600", 1, "by CFC 600", |t, x| Filter::Class(600.0).apply(t, &x[0])),
    series("cfc1000", 1, "by CFC 1000", |t, x| Filter::Class(1000.0).apply(t, &x[0])),
    series("lowpass", 2, "`lowpass(x, f)`: by a Butterworth filter without phase that damps by 3 dB at f, Hz", |t, x| {
        Filter::Corner(x[1].first().copied().unwrap_or(f64::INFINITY)).apply(t, &x[0])
    }),
    series("integral", 1, "over time, from 0", |t, x| integral(t, &x[0])),
    series("derivative", 1, "by time, from central differences", |t, x| derivative(t, &x[0])),
    series("first", 1, "its first value, in all rows: `x - first(x)` is the change", |_, x| all(&x[0], x[0].first())),
    series("last", 1, "its last value", |_, x| all(&x[0], x[0].last())),
    series("mean", 1, "its mean over the time of the run", |t, x| {
        let (whole, time) = (integral(t, &x[0]), t.last().unwrap_or(&0.0) - t.first().unwrap_or(&0.0));
        all(&x[0], whole.last().map(|last| last / time).as_ref())
    }),
    series("largest", 1, "its largest value", |_, x| all(&x[0], x[0].iter().copied().reduce(f64::max).as_ref())),
    series("smallest", 1, "its smallest value", |_, x| all(&x[0], x[0].iter().copied().reduce(f64::min).as_ref())),
    series("over_stroke", 2, "`over_stroke(F, s)`: mean of F over the way s so far, ∫F ds/(s − s₀)", |_, x| {
        over_stroke(&x[0], &x[1])
    }),
    series("hic15", 1, "head injury criterion of an acceleration (m/s²) over at most 15 ms", |t, x| {
        all(&x[0], Some(&hic(t, &x[0], 0.015)))
    }),
    series("hic36", 1, "over at most 36 ms", |t, x| all(&x[0], Some(&hic(t, &x[0], 0.036)))),
    series("clip3ms", 1, "the largest value that lasts for 3 ms without a break", |t, x| all(&x[0], Some(&clip(t, &x[0], 0.003)))),
];

/// A value in all rows.
fn all(like: &[f64], value: Option<&f64>) -> Vec<f64> {
    vec![value.copied().unwrap_or(f64::NAN); like.len()]
}

/// ∫ x dt by trapezoids.
fn integral(times: &[f64], values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut before = None;
    let step = |(&time, &value): (&f64, &f64)| {
        if let Some((old_time, old)) = before.replace((time, value)) {
            sum += 0.5 * (time - old_time) * (old + value);
        }
        sum
    };
    times.iter().zip(values).map(step).collect()
}

/// dx/dt: the slope of the parabola through each point and its neighbours; at the ends of the line.
fn derivative(times: &[f64], values: &[f64]) -> Vec<f64> {
    let count = values.len();
    let slope = |a: usize, b: usize| (values[b] - values[a]) / (times[b] - times[a]);
    let at = |k: usize| match (k.checked_sub(1), k + 1 < count) {
        (Some(before), true) => {
            let [left, right] = [times[k] - times[before], times[k + 1] - times[k]];
            (right * slope(before, k) + left * slope(k, k + 1)) / (left + right)
        }
        (None, true) => slope(k, k + 1),
        (Some(before), false) => slope(before, k),
        (None, false) => 0.0,
    };
    (0..count).map(at).collect()
}

/// ∫ F ds / (s − s₀); F at the start.
fn over_stroke(force: &[f64], way: &[f64]) -> Vec<f64> {
    let work = integral(way, force);
    let start = way.first().copied().unwrap_or(0.0);
    let mean = |((work, way), force): ((f64, &f64), &f64)| if *way == start { *force } else { work / (way - start) };
    work.into_iter().zip(way).zip(force).map(mean).collect()
}

/// HIC: the largest (t₂ − t₁) (∫ a/g dt/(t₂ − t₁))^2.5 with t₂ − t₁ ≤ `most`, s; ends between rows lie where
/// a straight line between the integrals has them. Negative means count as zero.
///
/// Source: J. Versace, 15th Stapp Car Crash Conference (1971); FMVSS 208, S6.
fn hic(times: &[f64], acceleration: &[f64], most: f64) -> f64 {
    let sums = integral(times, acceleration);
    let mut largest = 0.0f64;
    let mut note = |from: f64, to: f64, impulse: f64| {
        if to > from {
            largest = largest.max((to - from) * (impulse / (to - from) / GRAVITY).max(0.0).powf(2.5));
        }
    };
    let ends: Vec<f64> = times.iter().map(|time| time + most).collect();
    let at_ends = if times.len() > 1 { interpolated(times, &sums, &ends) } else { sums.clone() };
    for (k, &from) in times.iter().enumerate() {
        for (&to, &sum) in times[k + 1..].iter().zip(&sums[k + 1..]).take_while(|(to, _)| **to - from <= most) {
            note(from, to, sum - sums[k]);
        }
        if ends[k] <= *times.last().unwrap_or(&0.0) {
            note(from, ends[k], at_ends[k] - sums[k]);
        }
    }
    largest
}

/// The largest level above which the values stay for `least`, s.
fn clip(times: &[f64], values: &[f64], least: f64) -> f64 {
    let mut largest = f64::NAN;
    for (k, &from) in times.iter().enumerate() {
        let Some(end) = (k..times.len()).find(|&end| times[end] - from >= least * (1.0 - 1e-9)) else { break };
        let level = values[k..=end].iter().copied().fold(f64::INFINITY, f64::min);
        largest = largest.max(level);
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn even(count: usize, end: f64) -> Vec<f64> {
        (0..=count).map(|k| end * k as f64 / count as f64).collect()
    }

    #[test]
    fn integrals_and_derivatives_are_those_of_parabolas() {
        let times: Vec<f64> = (0..=40).map(|k| 0.05 * f64::from(k) + 0.01 * f64::from(k % 4)).collect();
        let square: Vec<f64> = times.iter().map(|t| t * t).collect();
        for (found, t) in derivative(&times, &square)[1..40].iter().zip(&times[1..]) {
            assert!((found - 2.0 * t).abs() < 1e-12, "{found} at {t}");
        }
        let line: Vec<f64> = times.iter().map(|t| 2.0 * t).collect();
        let back = integral(&times, &line);
        assert!(back.iter().zip(&square).all(|(found, wanted)| (found - wanted).abs() < 1e-12));
    }

    /// Of a constant acceleration a over T: HIC = min(T, 15 ms) (a/g)^2.5; of a half sine the best window
    /// around its middle is searched on its own.
    #[test]
    fn head_injury_criteria_of_a_block_and_a_half_sine() {
        let times = even(3000, 0.030);
        let block: Vec<f64> = times.iter().map(|&t| if t <= 0.010 { 100.0 * GRAVITY } else { 0.0 }).collect();
        assert!((hic(&times, &block, 0.015) / (0.010 * 1e5) - 1.0).abs() < 2e-3);
        let long = vec![50.0 * GRAVITY; times.len()];
        assert!((hic(&times, &long, 0.015) / (0.015 * 50f64.powf(2.5)) - 1.0).abs() < 1e-9);
        assert!((hic(&times, &long, 0.036) / (0.030 * 50f64.powf(2.5)) - 1.0).abs() < 1e-9);
        let duration = 0.012;
        let half: Vec<f64> =
            times.iter().map(|&t| if t < duration { 150.0 * GRAVITY * (std::f64::consts::PI * t / duration).sin() } else { 0.0 }).collect();
        // The window τ around the middle: f(τ) = τ (2T/(πτ) sin(πτ/2T))^2.5, searched on its own.
        let of_window = |tau: f64| tau * (2.0 / (std::f64::consts::PI * tau) * (0.5 * std::f64::consts::PI * tau).sin()).powf(2.5);
        let wanted = (1..10_000).map(|k| of_window(f64::from(k) * 1e-4)).fold(0.0, f64::max) * duration * 150f64.powf(2.5);
        assert!((hic(&times, &half, 0.015) / wanted - 1.0).abs() < 1e-4, "{} {wanted}", hic(&times, &half, 0.015));
        assert_eq!(hic(&[0.0], &[1.0], 0.015), 0.0);
    }

    #[test]
    fn clips_and_means_over_a_stroke() {
        let times = even(1000, 0.010);
        let ramp: Vec<f64> = times.iter().map(|t| 1e4 * t).collect();
        // The last 3 ms begin at 7 ms.
        assert!((clip(&times, &ramp, 0.003) - 70.0).abs() < 0.2);
        let way: Vec<f64> = times.iter().map(|t| 5.0 + 3.0 * t).collect();
        let mean = over_stroke(&ramp, &way);
        assert!((mean[1000] - 50.0).abs() < 1e-9 && mean[0] == 0.0);
    }
}
