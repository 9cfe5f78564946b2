//! Friction of springs in lanes: [`super::slide`] in 2D and [`super::cone::slide`] in 3D, operation for
//! operation, for a finite stiffness.

use embate_lanes::Lane;

/// Newton's steps for λ at most, as in [`super::cone`].
const STEPS: usize = 60;

/// What friction can do; entries from 1 on are those along the tangents.
pub(in super::super) struct Input<L, const D: usize> {
    /// ṡ^{n−½}, and ṡ^{n+½} without friction, m/s.
    pub(in super::super) old: [L; D],
    pub(in super::super) free: [L; D],
    /// Change of ṡ^{n+½} per force.
    pub(in super::super) compliance: [[L; D]; D],
    /// Elastic slip at n − ½, m, and its stiffness.
    pub(in super::super) slip: [L; D],
    pub(in super::super) stiffness: L,
    /// T_max, N.
    pub(in super::super) limit: L,
    /// ¼ of the mean step, s.
    pub(in super::super) quarter: L,
}

/// Friction, the elastic slip at n + ½, and one where it is at its limit, else zero.
pub(in super::super) type Found<L, const D: usize> = ([L; D], [L; D], L);

/// Friction by its law.
#[inline(always)]
pub(in super::super) fn slide<L: Lane, const D: usize>(input: &Input<L, D>) -> Found<L, D> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let Input { limit, compliance, .. } = input;
    let (friction, slip, slides) = if D == 2 { along_a_line(input) } else { along_a_plane(input) };
    let mut sum = compliance[1][1];
    for axis in 2..D {
        sum += compliance[axis][axis];
    }
    // Where there is no limit, and where nothing yields, there is none.
    let (mut found, yields) = ((friction, slip, slides), zero.less(sum));
    for axis in 1..D {
        found.0[axis] = L::select(zero.less(*limit), L::select(yields, found.0[axis], zero), zero);
        found.1[axis] = L::select(zero.less(*limit), L::select(yields, found.1[axis], zero), zero);
    }
    found.2 = L::select(zero.less(*limit), L::select(yields, found.2, zero), one);
    found
}

/// In 2D.
#[inline(always)]
fn along_a_line<L: Lane, const D: usize>(input: &Input<L, D>) -> Found<L, D> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let Input { old, free, compliance, slip, stiffness, limit, quarter } = input;
    let (old, free, compliance, slip) = (old[1], free[1], compliance[1][1], slip[1]);
    let trial = (-*stiffness) * (slip + *quarter * (old + free)) / (one + *stiffness * *quarter * compliance);
    let friction = clamped(trial, *limit);
    let moved = slip + L::splat(2.0) * *quarter * (old + free + compliance * friction);
    let slides = limit.less(trial.abs());
    let elastic = clamped(moved, *limit / *stiffness);
    let mut found = ([zero; D], [zero; D], L::select(slides, one, zero));
    found.0[1] = friction;
    found.1[1] = L::select(slides, elastic, moved);
    found
}

/// A value within ± a limit.
#[inline(always)]
fn clamped<L: Lane>(value: L, limit: L) -> L {
    L::select(value.less(-limit), -limit, L::select(limit.less(value), limit, value))
}

/// In 3D.
#[inline(always)]
fn along_a_plane<L: Lane, const D: usize>(input: &Input<L, D>) -> Found<L, D> {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let Input { old, free, compliance, slip, stiffness, limit, quarter } = input;
    let (first, second) = (1, D - 1);
    let (give, axis) = axes(compliance[first][first], compliance[first][second], compliance[second][second]);
    let mean = onto(axis, [slip[first] + *quarter * (old[first] + free[first]), slip[second] + *quarter * (old[second] + free[second])]);
    let mut along = [zero; 2];
    for k in 0..2 {
        along[k] = (-*stiffness) * mean[k] / (one + *stiffness * *quarter * give[k]);
    }
    let slides = limit.less(size(along));
    let elastic = *limit / *stiffness;
    if L::any(slides) {
        let toward = direction(mean, [*quarter * give[0], *quarter * give[1]], *limit, elastic);
        for k in 0..2 {
            along[k] = L::select(slides, (-*limit) * toward[k], along[k]);
        }
    }
    let [x, y] = axis;
    let friction = [x * along[0] - y * along[1], y * along[0] + x * along[1]];
    let mut moved = [zero; 2];
    for (a, axis) in [first, second].into_iter().enumerate() {
        let pulled = compliance[axis][first] * friction[0] + compliance[axis][second] * friction[1];
        moved[a] = slip[axis] + L::splat(2.0) * *quarter * (old[axis] + free[axis] + pulled);
    }
    let length = size(moved);
    let within = L::select(elastic.less(length), elastic / length, one);
    let mut found = ([zero; D], [zero; D], L::select(slides, one, zero));
    for (a, axis) in [first, second].into_iter().enumerate() {
        found.0[axis] = friction[a];
        found.1[axis] = L::select(slides, moved[a] * within, moved[a]);
    }
    found
}

#[inline(always)]
fn size<L: Lane>([a, b]: [L; 2]) -> L {
    (a * a + b * b).sqrt()
}

#[inline(always)]
fn onto<L: Lane>([x, y]: [L; 2], v: [L; 2]) -> [L; 2] {
    [x * v[0] + y * v[1], x * v[1] - y * v[0]]
}

/// Eigenvalues (ascending) and the first axis of a symmetric matrix.
#[inline(always)]
fn axes<L: Lane>(a: L, b: L, c: L) -> ([L; 2], [L; 2]) {
    let (zero, one, half) = (L::splat(0.0), L::splat(1.0), L::splat(0.5));
    let (mean, lean) = (half * (a + c), half * (a - c));
    let radius = (lean * lean + b * b).sqrt();
    let is_low = lean.less(zero);
    let low = [L::select(is_low, lean - radius, b), L::select(is_low, b, -(lean + radius))];
    let length = size(low);
    let is_round = zero.less(radius);
    let axis = [L::select(is_round, low[0] / length, one), L::select(is_round, low[1] / length, zero)];
    let least = mean - radius;
    let give = [L::select(is_round, L::select(zero.less(least), least, zero), mean), mean + radius];
    (give, axis)
}

/// The unit vector d with (λ I + limit · diag(`give`)) d = `along`.
#[inline(always)]
fn direction<L: Lane>(along: [L; 2], give: [L; 2], limit: L, least: L) -> [L; 2] {
    let (zero, one, infinite) = (L::splat(0.0), L::splat(1.0), L::splat(f64::INFINITY));
    let mut lambda = least;
    for _ in 0..STEPS {
        let (d, slope) = at(along, give, limit, lambda);
        let square = d[0] * d[0] + d[1] * d[1];
        let is_finite = square.less(infinite);
        let length = square.sqrt();
        let step = (length - one) * square / slope;
        let next = L::select(zero.less(step), lambda + step, lambda);
        let next = L::select(is_finite, next, size(along) * L::splat(f64::EPSILON));
        let moves = L::either(lambda.less(next), next.less(lambda));
        if !L::any(moves) {
            break;
        }
        lambda = next;
    }
    let (d, _) = at(along, give, limit, lambda);
    let length = size(d);
    [d[0] / length, d[1] / length]
}

/// d at λ, and Σ d_k² / (λ + limit give_k).
#[inline(always)]
fn at<L: Lane>(along: [L; 2], give: [L; 2], limit: L, lambda: L) -> ([L; 2], L) {
    let zero = L::splat(0.0);
    let (mut d, mut slope) = ([zero; 2], zero);
    for k in 0..2 {
        let sum = lambda + limit * give[k];
        d[k] = L::select(zero.less(along[k].abs()), along[k] / sum, zero);
        slope += L::select(zero.less(d[k].abs()), d[k] * d[k] / sum, zero);
    }
    (d, slope)
}

#[cfg(test)]
mod tests {
    use super::super::{FrictionInput, FrictionResult, cone};
    use super::*;
    use crate::bench::Random;
    use embate_lanes::{BATCH, Batch, Kernel, Level};

    struct Slide<const D: usize>([FrictionCase<D>; BATCH]);

    /// Rates, compliance, slip, stiffness and limit.
    type FrictionCase<const D: usize> = ([[f64; D]; 2], [[f64; D]; D], [f64; D], f64, f64);

    impl<const D: usize> Kernel for Slide<D> {
        type Output = [([f64; D], [f64; D], bool); BATCH];

        #[inline(always)]
        fn run<L: Lane>(self) -> Self::Output {
            let mut all = [([0.0; D], [0.0; D], false); BATCH];
            let load = |of: &dyn Fn(usize) -> f64, at: usize| L::load(&Batch(std::array::from_fn(of)), at);
            for at in (0..BATCH).step_by(L::WIDTH) {
                let vector = |of: &dyn Fn(usize) -> [f64; D]| -> [L; D] { std::array::from_fn(|axis| load(&|lane| of(lane)[axis], at)) };
                let input: Input<L, D> = Input {
                    old: vector(&|lane| self.0[lane].0[0]),
                    free: vector(&|lane| self.0[lane].0[1]),
                    compliance: std::array::from_fn(|on| vector(&|lane| self.0[lane].1[on])),
                    slip: vector(&|lane| self.0[lane].2),
                    stiffness: load(&|lane| self.0[lane].3, at),
                    limit: load(&|lane| self.0[lane].4, at),
                    quarter: L::splat(0.25 * 0.5 * (0.9 + 1.1)),
                };
                let (friction, slip, slides) = slide(&input);
                let mut store = [Batch::default(); 1];
                for axis in 1..D {
                    friction[axis].store(&mut store[0], at);
                    (at..at + L::WIDTH).for_each(|lane| all[lane].0[axis] = store[0].0[lane]);
                    slip[axis].store(&mut store[0], at);
                    (at..at + L::WIDTH).for_each(|lane| all[lane].1[axis] = store[0].0[lane]);
                }
                slides.store(&mut store[0], at);
                (at..at + L::WIDTH).for_each(|lane| all[lane].2 = store[0].0[lane] != 0.0);
            }
            all
        }
    }

    #[test]
    fn lanes_find_the_bits_of_one_after_the_other() {
        let (mut random, mut slid) = (Random::new(7), 0);
        for round in 0..2000 {
            let cases: [FrictionCase<3>; BATCH] = std::array::from_fn(|_| {
                let mut pick = |of: [f64; 3]| of[(3.0 * random.unit()) as usize % 3];
                let (k, limit, size) = (pick([0.1, 1.0, 1e6]), pick([0.0, 0.05, 3.0]), pick([0.0, 1e-3, 2.0]));
                let kind = pick([0.0, 1.0, 2.0]);
                let mut vector = || [0.0, size * (random.unit() - 0.5), size * (random.unit() - 0.5)];
                let (old, free, slip) = (vector(), vector(), vector());
                let [_, p, q] = [0.0, random.unit(), random.unit()];
                let matrix = match kind {
                    0.0 => [0.7, 0.0, 0.7],
                    1.0 => [p * p, p * q, q * q],
                    _ => [p + 0.1, 0.3 * (q - 0.5), q + 0.1],
                };
                let [a, b, c] = if round % 50 == 0 { [0.0; 3] } else { matrix };
                ([old, free], [[0.0; 3], [0.0, a, b], [0.0, b, c]], slip, k, limit)
            });
            let space: Vec<FrictionResult<3>> = cases
                .iter()
                .map(|([old, free], c, slip, stiffness, limit)| {
                    let (cut, stiffness) = (|v: &[f64; 3]| [v[1], v[2]], *stiffness);
                    let input = FrictionInput {
                        old: cut(old),
                        free: cut(free),
                        compliance: [cut(&c[1]), cut(&c[2])],
                        stiffness,
                        time_steps: [0.9, 1.1],
                    };
                    cone::slide(&input, cut(slip), *limit)
                })
                .collect();
            let line: Vec<FrictionResult<2>> = cases
                .iter()
                .map(|([old, free], c, slip, stiffness, limit)| {
                    let input = FrictionInput {
                        old: [old[1]],
                        free: [free[1]],
                        compliance: [[c[1][1]]],
                        stiffness: *stiffness,
                        time_steps: [0.9, 1.1],
                    };
                    super::super::slide(&input, [slip[1]], *limit)
                })
                .collect();
            let flat = cases.map(|([old, free], c, slip, k, limit)| {
                let cut = |v: [f64; 3]| [0.0, v[1]];
                ([cut(old), cut(free)], [[0.0; 2], cut(c[1])], cut(slip), k, limit)
            });
            for level in Level::available() {
                for (lane, (friction, slip, slides)) in level.run(Slide(cases)).into_iter().enumerate() {
                    let expected = space[lane];
                    assert_eq!(
                        ([friction[1], friction[2]], [slip[1], slip[2]], slides),
                        (expected.friction, expected.slip, expected.slides)
                    );
                    slid += usize::from(slides);
                }
                for (lane, (friction, slip, slides)) in level.run(Slide(flat)).into_iter().enumerate() {
                    let expected = line[lane];
                    assert_eq!(([friction[1]], [slip[1]], slides), (expected.friction, expected.slip, expected.slides));
                }
            }
        }
        assert!(slid > 1000, "{slid}");
    }
}
