//! Points through the thickness of shells, and over the cross-section of beams: heights and weights of Gauss'
//! and Lobatto's rules.
//!
//! Gauss' points are inside, and as few as two integrate elastic bending exactly; Lobatto's have one on each
//! face, and take three. Of an ideally plastic hinge Gauss' odd numbers have less than the true moment, even
//! ones more: 5 points 0.945 of it, 4 points 1.043, 6 points 1.020. Source: Abramowitz and Stegun, Handbook
//! of Mathematical Functions (1964), 25.4.29 and 25.4.32.

use crate::angle::cos_sin;
use std::ops::Range;

/// Points through a thickness of one, from the lower to the upper face, or those of a cross-section: heights
/// over the middle, and weights, which sum to one.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Points {
    pub(super) heights: Vec<f64>,
    /// Places across the heights, of cross-sections alone.
    pub(super) sides: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// Points of each layer, and its upper side, where there are several.
    layers: Vec<(Range<usize>, f64)>,
    /// Height of the middle over the surface of the nodes.
    pub(super) middle: f64,
}

/// Legendre's polynomials P_n and P_{n−1} at x.
fn legendre(n: usize, x: f64) -> [f64; 2] {
    let (mut last, mut now) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (last, now) = (now, ((2.0 * k + 1.0) * x * now - k * last) / (k + 1.0));
    }
    [now, last]
}

impl Points {
    /// `count` points of a rule (`lobatto`: with the faces), on −½ to ½. Newton's steps from the zeros of
    /// Chebyshev's polynomials, a fixed number of them.
    pub(super) fn new(count: usize, lobatto: bool) -> Self {
        let n = count;
        let point = |k: usize| -> (f64, f64) {
            let first = |of: f64| -cos_sin(std::f64::consts::PI * of)[0];
            if lobatto {
                // The faces, and the zeros of P'_{n−1} between them.
                let degree = n - 1;
                let end = 2.0 / (n * degree) as f64;
                if k == 0 || k == degree {
                    return (if k == 0 { -1.0 } else { 1.0 }, end);
                }
                let mut x = first(k as f64 / degree as f64);
                for _ in 0..20 {
                    let [now, last] = legendre(degree, x);
                    let d = degree as f64;
                    let slope = d * (last - x * now) / (1.0 - x * x);
                    let curvature = (2.0 * x * slope - d * (d + 1.0) * now) / (1.0 - x * x);
                    x -= slope / curvature;
                }
                let [now, _] = legendre(degree, x);
                return (x, end / (now * now));
            }
            let mut x = first((k as f64 + 0.75) / (n as f64 + 0.5));
            let mut slope = 1.0;
            for _ in 0..20 {
                let [now, last] = legendre(n, x);
                slope = n as f64 * (last - x * now) / (1.0 - x * x);
                x -= now / slope;
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        };
        // Symmetric to the last digit.
        let half: Vec<(f64, f64)> = (0..n.div_ceil(2)).map(point).collect();
        let all = (0..n).map(|k| {
            let (x, w) = half[k.min(n - 1 - k)];
            let x = if 2 * k + 1 == n { 0.0 } else { x };
            (0.5 * if 2 * k < n { x } else { -x }, 0.5 * w)
        });
        let (heights, weights) = all.unzip();
        Self { heights, weights, ..Self::default() }
    }

    /// Of layers from the lower face up: part of the thickness, and points of the rule.
    pub(super) fn layered(layers: impl IntoIterator<Item = (f64, usize)>, lobatto: bool) -> Self {
        let (mut points, mut low) = (Self::default(), -0.5);
        for (share, count) in layers {
            let (own, first) = (Self::new(count, lobatto), points.count());
            points.heights.extend(own.heights.iter().map(|height| low + share * (height + 0.5)));
            points.weights.extend(own.weights.iter().map(|weight| share * weight));
            low += share;
            points.layers.push((first..points.count(), low));
        }
        points
    }

    /// The same with the middle at a height over the surface of the nodes.
    pub(super) fn moved(mut self, middle: f64) -> Self {
        if middle != 0.0 {
            self.heights.iter_mut().for_each(|height| *height += middle);
            self.middle = middle;
        }
        self
    }

    /// At places y and z, with weights by their sum.
    pub(super) fn at(places: impl IntoIterator<Item = ([f64; 2], f64)>) -> Self {
        let mut points = Self::default();
        for ([y, z], weight) in places {
            points.sides.push(y);
            points.heights.push(z);
            points.weights.push(weight);
        }
        let sum: f64 = points.weights.iter().sum();
        points.weights.iter_mut().for_each(|weight| *weight /= sum);
        points
    }

    /// Gauss' points of a rectangle, `count` along each side.
    pub(super) fn grid(count: usize, [width, height]: [f64; 2]) -> Self {
        let one = Self::new(count, false);
        let all =
            |k: usize| ([width * one.heights[k % count], height * one.heights[k / count]], one.weights[k % count] * one.weights[k / count]);
        Self::at((0..count * count).map(all))
    }

    /// The two points of a layer between or beyond which a height over the middle is, with their shares in
    /// what varies linearly: exact where a point is there. Where two layers meet it is the lower one.
    pub(super) fn around(&self, height: f64) -> [(usize, f64); 2] {
        let own = self.layers.iter().find(|(_, upper)| height <= upper + 1e-12);
        let Range { start, end } = own.or(self.layers.last()).map_or(0..self.count(), |(points, _)| points.clone());
        let (heights, last, height) = (&self.heights[start..end], end - start - 1, height + self.middle);
        let upper = heights.partition_point(|own| *own < height).clamp(last.min(1), last);
        let lower = upper.saturating_sub(1);
        if lower == upper {
            return [(start + lower, 1.0), (start + upper, 0.0)];
        }
        let share = (height - heights[lower]) / (heights[upper] - heights[lower]);
        [(start + lower, 1.0 - share), (start + upper, share)]
    }

    pub(super) fn count(&self) -> usize {
        self.heights.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly_as_far_as_the_rules_go() {
        for (lobatto, least) in [(false, 1), (true, 3)] {
            for n in least..=10 {
                let points = Points::new(n, lobatto);
                let degree = if lobatto { 2 * n - 3 } else { 2 * n - 1 };
                for power in 0..=degree + 1 {
                    let sum: f64 = points.heights.iter().zip(&points.weights).map(|(z, w)| w * z.powi(power as i32)).sum();
                    let exact = if power % 2 == 1 { 0.0 } else { 0.5f64.powi(power as i32) / (power as f64 + 1.0) };
                    let is_exact = (sum - exact).abs() < 1e-15;
                    assert!(is_exact == (power <= degree), "{lobatto} {n} {power}: {sum} {exact}");
                }
                assert!(points.heights.is_sorted());
                assert!(!lobatto || (points.heights[0], points.heights[n - 1]) == (-0.5, 0.5));
            }
        }
    }

    #[test]
    fn a_plastic_hinge_has_the_moment_of_the_table() {
        let moment = |n: usize, lobatto: bool| -> f64 {
            let points = Points::new(n, lobatto);
            4.0 * points.heights.iter().zip(&points.weights).map(|(z, w)| w * z.abs()).sum::<f64>()
        };
        let gauss = [1.155, 0.861, 1.043, 0.945, 1.020, 0.971, 1.012, 0.982, 1.008];
        let lobatto = [0.667, 1.079, 0.913, 1.029, 0.960, 1.015, 0.977, 1.009];
        gauss.iter().zip(2..).for_each(|(value, n)| assert!((moment(n, false) - value).abs() < 6e-4, "{n}"));
        lobatto.iter().zip(3..).for_each(|(value, n)| assert!((moment(n, true) - value).abs() < 6e-4, "{n}"));
    }
}
