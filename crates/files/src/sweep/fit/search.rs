//! Nonlinear least squares within bounds, for functions that are runs: derivatives are differences, and what
//! does not depend on each other is asked for at once.
//!
//! Levenberg and Marquardt's method on the box 0..1 of every variable: (JᵀJ + λ diag JᵀJ) d = −Jᵀr over the
//! variables that no bound holds, the step cut to the box; four λ are tried at once and the best is taken.
//! Source: J. J. Moré, "The Levenberg-Marquardt algorithm: implementation and theory", 1978.

/// Values of λ that are tried together, as multiples of the present one.
const TRIES: [f64; 4] = [0.1, 1.0, 10.0, 100.0];
/// Where a λ leads nowhere any more.
const DAMPING_MAX: f64 = 1e8;

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Search {
    /// Length of the differences, a part of the range of each variable.
    pub(super) step: f64,
    /// Relative change of the sum of squares, or change of all variables, at which it ends.
    pub(super) tolerance: f64,
    /// Most steps.
    pub(super) steps: usize,
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    /// Variables, 0..1.
    pub(super) at: Vec<f64>,
    /// Differences there.
    pub(super) residuals: Vec<f64>,
    /// Their derivatives, a row for each difference, at or near this place.
    pub(super) derivatives: Vec<Vec<f64>>,
    /// Whether it ended by itself.
    pub(super) is_converged: bool,
}

/// Differences at each of some places; none where a run has failed.
pub(super) type Evaluate<'a, E> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, E> + 'a;

impl Search {
    /// Searches from a place on; `None`: the run there fails.
    pub(super) fn run<E>(&self, first: &[f64], evaluate: &mut Evaluate<'_, E>) -> Result<Option<Found>, E> {
        let Some(residuals) = evaluate(&[first.to_vec()])?.pop().flatten() else { return Ok(None) };
        let mut found = Found { at: first.to_vec(), residuals, derivatives: Vec::new(), is_converged: false };
        let mut damping = 1e-2;
        for _ in 0..self.steps {
            found.derivatives = self.derivatives(&found, evaluate)?;
            let mut is_better = false;
            while damping <= DAMPING_MAX && !is_better {
                let places: Vec<Vec<f64>> = TRIES.iter().map(|factor| step(&found, factor * damping)).collect();
                let far = places.iter().map(|place| distance(place, &found.at)).fold(0.0, f64::max);
                if far <= self.tolerance * 1e-3 {
                    found.is_converged = true;
                    return Ok(Some(found));
                }
                let size = squares(&found.residuals);
                let tried = evaluate(&places)?;
                let sized = tried.into_iter().zip(places).zip(TRIES).filter_map(|((residuals, place), factor)| {
                    let residuals = residuals?;
                    Some((squares(&residuals), residuals, place, factor))
                });
                let best = sized.min_by(|a, b| a.0.total_cmp(&b.0));
                let Some((new, residuals, at, factor)) = best.filter(|(new, ..)| *new < size) else {
                    damping *= 1e3;
                    continue;
                };
                is_better = true;
                damping = (damping * factor).max(1e-9);
                let moved = distance(&at, &found.at);
                (found.residuals, found.at) = (residuals, at);
                if size - new <= self.tolerance * size || moved <= self.tolerance || new <= 1e-24 {
                    found.is_converged = true;
                    return Ok(Some(found));
                }
            }
            if !is_better {
                // No direction leads down: what is left is noise of the runs.
                found.is_converged = true;
                return Ok(Some(found));
            }
            damping = damping.min(1e2);
        }
        Ok(Some(found))
    }

    /// One run more for each variable, away from the nearer bound; where it fails, on the other side.
    fn derivatives<E>(&self, found: &Found, evaluate: &mut Evaluate<'_, E>) -> Result<Vec<Vec<f64>>, E> {
        let beside = |k: usize, step: f64| {
            let mut place = found.at.clone();
            place[k] += step;
            place
        };
        let steps: Vec<f64> = found.at.iter().map(|x| if x + self.step <= 1.0 { self.step } else { -self.step }).collect();
        let places: Vec<Vec<f64>> = steps.iter().enumerate().map(|(k, &step)| beside(k, step)).collect();
        let mut rows = vec![vec![0.0; found.at.len()]; found.residuals.len()];
        for (k, residuals) in evaluate(&places)?.into_iter().enumerate() {
            let (residuals, step) = match residuals {
                Some(residuals) => (residuals, steps[k]),
                None => match evaluate(&[beside(k, -steps[k])])?.pop().flatten() {
                    Some(residuals) => (residuals, -steps[k]),
                    None => continue,
                },
            };
            for ((row, other), own) in rows.iter_mut().zip(residuals).zip(&found.residuals) {
                row[k] = (other - own) / step;
            }
        }
        Ok(rows)
    }
}

impl Found {
    /// Standard errors of the variables, from s² (JᵀJ)⁻¹ with s² the sum of squares over the degrees of
    /// freedom: infinite where the differences don't depend on a variable, or only on a combination of it
    /// with others.
    pub(super) fn errors(&self) -> Vec<f64> {
        let count = self.at.len();
        let normal = normal(&self.derivatives, count);
        let freedom = self.residuals.len().saturating_sub(count).max(1) as f64;
        let variance = squares(&self.residuals) / freedom;
        let largest = (0..count).map(|k| normal[k][k]).fold(0.0, f64::max);
        let seen: Vec<usize> = (0..count).filter(|&k| normal[k][k] > 1e-20 * largest).collect();
        let mut errors = vec![f64::INFINITY; count];
        // Scaled to ones on the diagonal, so that pivots are what a variable has of its own.
        let scale = |k: usize| normal[k][k].sqrt();
        let scaled: Vec<Vec<f64>> = seen.iter().map(|&i| seen.iter().map(|&j| normal[i][j] / scale(i) / scale(j)).collect()).collect();
        for (place, &k) in seen.iter().enumerate() {
            let unit: Vec<f64> = (0..seen.len()).map(|j| if j == place { 1.0 } else { 0.0 }).collect();
            if let Some(column) = solve(&scaled, &unit) {
                errors[k] = (variance * column[place]).sqrt() / scale(k);
            }
        }
        errors
    }
}

/// The step for this λ, cut to the box.
fn step(found: &Found, damping: f64) -> Vec<f64> {
    let count = found.at.len();
    let normal = normal(&found.derivatives, count);
    let gradient: Vec<f64> = (0..count).map(|k| found.derivatives.iter().zip(&found.residuals).map(|(row, r)| row[k] * r).sum()).collect();
    // What a bound holds, and would cross it.
    let is_free = |k: &usize| !((found.at[*k] <= 0.0 && gradient[*k] > 0.0) || (found.at[*k] >= 1.0 && gradient[*k] < 0.0));
    let free: Vec<usize> = (0..count).filter(is_free).collect();
    let largest = free.iter().map(|&k| normal[k][k]).fold(0.0, f64::max);
    let of = |i: usize, j: usize| {
        let own = if i == j { damping * normal[i][i].max(1e-12 * largest) } else { 0.0 };
        normal[i][j] + own
    };
    let matrix: Vec<Vec<f64>> = free.iter().map(|&i| free.iter().map(|&j| of(i, j)).collect()).collect();
    let right: Vec<f64> = free.iter().map(|&k| -gradient[k]).collect();
    let mut at = found.at.clone();
    if let Some(steps) = solve(&matrix, &right) {
        free.iter().zip(steps).for_each(|(&k, step)| at[k] = (at[k] + step).clamp(0.0, 1.0));
    }
    at
}

/// JᵀJ.
fn normal(rows: &[Vec<f64>], count: usize) -> Vec<Vec<f64>> {
    (0..count).map(|i| (0..count).map(|j| rows.iter().map(|row| row[i] * row[j]).sum()).collect()).collect()
}

/// Solves a symmetric positive definite system by Cholesky's factors; `None` where it is not one.
fn solve(matrix: &[Vec<f64>], right: &[f64]) -> Option<Vec<f64>> {
    let count = right.len();
    let mut factor = vec![vec![0.0; count]; count];
    for i in 0..count {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = matrix[i][j] - sum;
            if i != j {
                factor[i][j] = rest / factor[j][j];
            } else if rest > 1e-13 * matrix[i][i] && rest.is_finite() {
                factor[i][i] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    let mut x = right.to_vec();
    for i in 0..count {
        let sum: f64 = (0..i).map(|k| factor[i][k] * x[k]).sum();
        x[i] = (x[i] - sum) / factor[i][i];
    }
    for i in (0..count).rev() {
        let sum: f64 = (i + 1..count).map(|k| factor[k][i] * x[k]).sum();
        x[i] = (x[i] - sum) / factor[i][i];
    }
    Some(x)
}

pub(super) fn squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    const SEARCH: Search = Search { step: 1e-4, tolerance: 1e-9, steps: 100 };

    /// Runs a search; what it found and how many places were asked for.
    fn found(first: &[f64], of: impl Fn(&[f64]) -> Option<Vec<f64>>) -> (Option<Found>, usize) {
        let mut count = 0;
        let mut evaluate = |places: &[Vec<f64>]| -> Result<Vec<Option<Vec<f64>>>, Infallible> {
            count += places.len();
            assert!(places.iter().flatten().all(|x| (0.0..=1.0).contains(x)), "{places:?}");
            Ok(places.iter().map(|place| of(place)).collect())
        };
        let Ok(found) = SEARCH.run(first, &mut evaluate);
        (found, count)
    }

    fn near(found: &Found, at: &[f64], tolerance: f64) {
        assert!(found.is_converged && distance(&found.at, at) < tolerance, "{found:?}");
    }

    #[test]
    fn straight_lines_are_fitted_as_by_their_formula() {
        // y = a + b x through points with noise: the normal equations say what comes, errors included.
        let (x, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.31, 0.49, 0.72, 0.88, 1.12]);
        let (it, count) = found(&[0.5, 0.5], |p| Some(x.iter().zip(y).map(|(x, y)| p[0] + p[1] * x - y).collect()));
        let it = it.unwrap();
        let (mean_x, mean_y) = (2.0, y.iter().sum::<f64>() / 5.0);
        let slope = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum::<f64>() / 10.0;
        near(&it, &[mean_y - slope * mean_x, slope], 1e-7);
        let variance = squares(&it.residuals) / 3.0;
        let expected = [(variance * (0.2 + 0.4)).sqrt(), (variance / 10.0).sqrt()];
        assert!(distance(&it.errors(), &expected) < 1e-6 * expected[0], "{:?} {expected:?}", it.errors());
        assert!(count < 60, "{count}");
    }

    #[test]
    fn a_curved_valley_is_followed() {
        // Rosenbrock's function on −1.5..1.5 twice, with its minimum at (1, 1).
        let of = |p: &[f64]| {
            let [x, y] = [3.0 * p[0] - 1.5, 3.0 * p[1] - 1.5];
            Some(vec![10.0 * (y - x * x), 1.0 - x])
        };
        let (it, count) = found(&[0.1, 0.9], of);
        near(&it.unwrap(), &[2.5 / 3.0, 2.5 / 3.0], 1e-4);
        assert!(count < 250, "{count}");
    }

    #[test]
    fn an_exponential_is_fitted_and_failed_runs_are_walked_around() {
        let y: Vec<f64> = (0..20).map(|k| 2.0 * (-0.7 * 0.2 * f64::from(k)).exp()).collect();
        let of = |p: &[f64]| {
            // Nothing runs beyond here.
            (p[1] < 0.9).then(|| (0..20).zip(&y).map(|(k, y)| 5.0 * p[0] * (-3.0 * p[1] * 0.2 * f64::from(k)).exp() - y).collect())
        };
        for first in [[0.9, 0.8999], [0.1, 0.1], [0.5, 0.6]] {
            near(&found(&first, of).0.unwrap(), &[0.4, 0.7 / 3.0], 1e-5);
        }
        assert_eq!(found(&[0.5, 0.95], of).0, None);
    }

    #[test]
    fn bounds_hold_and_what_nothing_depends_on_is_not_known() {
        let (it, _) = found(&[0.5, 0.5, 0.3], |p| Some(vec![p[0] - 1.7, p[1] + 0.3 - 0.1 * p[0], 2.0 * p[0] - 3.0]));
        let it = it.unwrap();
        near(&it, &[1.0, 0.0, 0.3], 1e-9);
        let errors = it.errors();
        assert!(errors[0].is_finite() && errors[1].is_finite() && errors[2] == f64::INFINITY, "{errors:?}");
        // Only the sum is known.
        let (it, _) = found(&[0.5, 0.5], |p| Some(vec![p[0] + p[1] - 0.7, 2.0 * (p[0] + p[1]) - 1.4]));
        let it = it.unwrap();
        assert!((it.at[0] + it.at[1] - 0.7).abs() < 1e-7 && it.errors().iter().all(|error| *error > 1e3 || error.is_infinite()), "{it:?}");
    }

    #[test]
    fn noise_of_the_runs_ends_the_search() {
        // A function of steps: derivatives by small differences mean nothing.
        let (it, count) = found(&[0.1], |p| Some(vec![(p[0] * 50.0).floor() / 50.0 - 0.62, 0.1]));
        assert!(it.unwrap().is_converged && count < 100);
    }
}
