//! What two triangles of a plane have in common, and integrals over it.
//!
//! Corners come from the facets of a pair ([`super::common`]), which lie in their common plane. The common
//! part is convex: one triangle is cut along the edges of the other one (Sutherland and Hodgman, Comm. ACM 17
//! (1974) 32-42). A corner that is new lies between two old ones, however short an edge is or however
//! nearly parallel two are, so nothing leaves the first triangle.

/// A place in the plane, m.
pub(super) type Point = [f64; 2];

/// A linear function c₀ + c₁ x + c₂ y of places.
pub(super) type Linear = [f64; 3];

/// Corners of a common part. A cut makes at most half as many corners more, even where rounding makes a
/// straight line crooked: 3, 4, 6, 9.
const CORNERS: usize = 9;

/// A triangle whose area is less than this fraction of the square of its longest edge has none.
const FLAT: f64 = 1e-10;

/// Integrals of 1, x, y, x², xy and y².
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments(pub(super) [f64; 6]);

impl Moments {
    /// m².
    pub(super) fn area(&self) -> f64 {
        self.0[0]
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (sum, more) in self.0.iter_mut().zip(other.0) {
            *sum += more;
        }
    }

    /// Adds what a triangle has.
    fn add_triangle(&mut self, [a, b, c]: [Point; 3]) {
        let part = 0.5 * doubled([a, b, c]);
        let (x, y) = (a[0] + b[0] + c[0], a[1] + b[1] + c[1]);
        let square = |i: usize, j: usize| a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
        let (third, twelfth) = (part / 3.0, part / 12.0);
        let more = [
            part,
            third * x,
            third * y,
            twelfth * (square(0, 0) + x * x),
            twelfth * (square(0, 1) + x * y),
            twelfth * (square(1, 1) + y * y),
        ];
        self.add(&Self(more));
    }

    /// Integral of a linear function.
    pub(super) fn of(&self, [c0, c1, c2]: Linear) -> f64 {
        let [one, x, y, ..] = self.0;
        c0 * one + c1 * x + c2 * y
    }

    /// What a linear function `by` makes of the integrals of 1, x and y: those of `by`, `by` x and `by` y.
    pub(super) fn weighted(&self, [c0, c1, c2]: Linear) -> [f64; 3] {
        let [one, x, y, xx, xy, yy] = self.0;
        [c0 * one + c1 * x + c2 * y, c0 * x + c1 * xx + c2 * xy, c0 * y + c1 * xy + c2 * yy]
    }

    /// Covariance xx, xy, yy, m².
    pub(super) fn covariance(&self) -> [f64; 3] {
        let [one, x, y, xx, xy, yy] = self.0;
        let (x, y) = (x / one, y / one);
        [xx / one - x * x, xy / one - x * y, yy / one - y * y]
    }
}

/// Twice the area of a triangle, positive where it runs counter-clockwise, m².
pub(super) fn doubled([a, b, c]: [Point; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A triangle, counter-clockwise.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Triangle {
    pub(super) corners: [Point; 3],
    /// Linear functions that are one at a corner and zero at the others; they sum up to one.
    pub(super) shares: [Linear; 3],
    low: Point,
    high: Point,
}

impl Triangle {
    /// `None` where it has no area, or runs the other way round.
    pub(super) fn new(corners: [Point; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let whole = doubled(corners);
        let square = |p: Point, q: Point| (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
        let longest = square(a, b).max(square(b, c)).max(square(c, a));
        // No number fails the comparison too.
        if !(whole > FLAT * longest) {
            return None;
        }
        let share = |p: Point, q: Point| {
            // Zero on the edge from p to q.
            let [gx, gy] = [(p[1] - q[1]) / whole, (q[0] - p[0]) / whole];
            [-(gx * p[0] + gy * p[1]), gx, gy]
        };
        let (first, second) = (share(b, c), share(c, a));
        let third = [1.0 - first[0] - second[0], -first[1] - second[1], -first[2] - second[2]];
        let low = [0, 1].map(|d| a[d].min(b[d]).min(c[d]));
        let high = [0, 1].map(|d| a[d].max(b[d]).max(c[d]));
        Some(Self { corners, shares: [first, second, third], low, high })
    }

    /// Moments of all of it.
    pub(super) fn moments(&self) -> Moments {
        let mut moments = Moments::default();
        moments.add_triangle(self.corners);
        moments
    }

    /// What it has in common with another one.
    pub(super) fn common(&self, other: &Self) -> Polygon {
        if (0..2).any(|d| self.low[d] >= other.high[d] || other.low[d] >= self.high[d]) {
            return Polygon::default();
        }
        let mut polygon = Polygon { corners: [[0.0; 2]; CORNERS], count: 3 };
        polygon.corners[..3].copy_from_slice(&self.corners);
        let [a, b, c] = other.corners;
        for edge in [[a, b], [b, c], [c, a]] {
            polygon = polygon.cut(edge);
        }
        polygon
    }
}

/// A convex part of the plane, counter-clockwise.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Polygon {
    corners: [Point; CORNERS],
    count: usize,
}

impl Polygon {
    pub(super) fn corners(&self) -> &[Point] {
        &self.corners[..self.count]
    }

    /// What of it is on the left of an edge.
    fn cut(&self, [a, b]: [Point; 2]) -> Self {
        let along = [b[0] - a[0], b[1] - a[1]];
        let side = |p: Point| along[0] * (p[1] - a[1]) - along[1] * (p[0] - a[0]);
        let mut left = Self::default();
        let mut keep = |corner: Point| {
            if left.count < CORNERS {
                left.corners[left.count] = corner;
                left.count += 1;
            }
        };
        let Some(&last) = self.corners().last() else { return left };
        let (mut from, mut before) = (last, side(last));
        for &to in self.corners() {
            let after = side(to);
            if (before < 0.0) != (after < 0.0) {
                // Both have different signs: the sum of their sizes is not zero.
                let way = before / (before - after);
                keep([from[0] + way * (to[0] - from[0]), from[1] + way * (to[1] - from[1])]);
            }
            if !(after < 0.0) {
                keep(to);
            }
            (from, before) = (to, after);
        }
        left
    }

    /// Integrals over it.
    pub(super) fn moments(&self) -> Moments {
        let mut moments = Moments::default();
        if let [first, others @ ..] = self.corners() {
            for two in others.windows(2) {
                moments.add_triangle([*first, two[0], two[1]]);
            }
        }
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;

    /// Area that two triangles have in common as a sum over strips between the ordinates of all corners and
    /// crossings, in which it is a trapezoid: no polygon is cut.
    fn by_strips(one: [Point; 3], other: [Point; 3]) -> f64 {
        let edges = |t: [Point; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        let mut heights: Vec<f64> = one.iter().chain(&other).map(|p| p[1]).collect();
        for [a, b] in edges(one) {
            for [c, d] in edges(other) {
                let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
                let whole = u[0] * v[1] - u[1] * v[0];
                if whole != 0.0 {
                    let t = ((c[0] - a[0]) * v[1] - (c[1] - a[1]) * v[0]) / whole;
                    if (0.0..=1.0).contains(&t) {
                        heights.push(a[1] + t * u[1]);
                    }
                }
            }
        }
        heights.sort_by(f64::total_cmp);
        // Width of a triangle along a line of constant y.
        let range = |t: [Point; 3], y: f64| {
            let mut found = [f64::INFINITY, f64::NEG_INFINITY];
            for [p, q] in edges(t) {
                if (p[1] - y) * (q[1] - y) < 0.0 {
                    let x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
                    found = [found[0].min(x), found[1].max(x)];
                }
            }
            found
        };
        let strip = |two: &[f64]| {
            let middle = 0.5 * (two[0] + two[1]);
            let (a, b) = (range(one, middle), range(other, middle));
            (a[1].min(b[1]) - a[0].max(b[0])).max(0.0) * (two[1] - two[0])
        };
        heights.windows(2).map(strip).sum()
    }

    fn some(random: &mut Random, sort: usize) -> [Point; 3] {
        let mut unit = || random.unit();
        let mut corners = [0, 1, 2].map(|_| [unit(), unit()]);
        match sort {
            // A needle, a sliver, corners on a grid, so that edges coincide.
            1 => corners[2] = [corners[0][0] + 1e-7 * unit(), corners[0][1] + 1e-7 * unit()],
            2 => {
                let along = unit();
                corners[2] = [0, 1].map(|d| corners[0][d] + along * (corners[1][d] - corners[0][d]) + 1e-9 * unit());
            }
            3 => corners = corners.map(|p| p.map(|c| (3.0 * c).round() / 3.0)),
            _ => {}
        }
        if doubled(corners) < 0.0 { [corners[0], corners[2], corners[1]] } else { corners }
    }

    #[test]
    fn common_areas_are_those_of_strips_for_needles_slivers_and_edges_that_coincide() {
        let mut random = Random::new(11);
        let mut met = 0;
        for round in 0..40_000 {
            let (a, b) = (some(&mut random, round % 4), some(&mut random, round / 4 % 4));
            let (Some(one), Some(other)) = (Triangle::new(a), Triangle::new(b)) else { continue };
            let (found, expected) = (one.common(&other).moments().area(), by_strips(a, b));
            assert!((found - expected).abs() < 1e-13, "{a:?} {b:?}: {found} {expected}");
            assert!((found - other.common(&one).moments().area()).abs() < 1e-13);
            met += usize::from(expected > 0.0);
        }
        assert!(met > 10_000, "{met}");
    }

    #[test]
    fn what_covers_a_triangle_has_all_of_its_moments_at_any_scale() {
        let mut random = Random::new(5);
        for round in 0..2_000 {
            let scale = [1.0, 1e-12, 1e12][round % 3];
            let scaled = |t: [Point; 3]| t.map(|p| p.map(|c| scale * c));
            let Some(one) = Triangle::new(scaled(some(&mut random, round / 3 % 4))) else { continue };
            // The unit square in a fan about any of its points, some of which are on its rim or a corner.
            let mut unit = || random.unit();
            let middle = match round % 5 {
                0 => [0.0, unit()],
                1 => [1.0, 1.0],
                _ => [0.1 + 0.8 * unit(), 0.1 + 0.8 * unit()],
            };
            let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            let mut sum = Moments::default();
            for k in 0..4 {
                if let Some(other) = Triangle::new(scaled([corners[k], corners[(k + 1) % 4], middle])) {
                    sum.add(&one.common(&other).moments());
                }
            }
            let whole = one.moments();
            for (k, (found, expected)) in sum.0.iter().zip(whole.0).enumerate() {
                let size = scale.powi([2, 3, 3, 4, 4, 4][k]);
                assert!((found - expected).abs() < 1e-14 * size, "{k}: {found} {expected}");
            }
            assert!((sum.area() - whole.area()).abs() < 1e-12 * whole.area().max(1e-2 * scale * scale));
        }
    }

    #[test]
    fn integrals_of_shares_and_their_products_are_the_closed_forms() {
        let triangle = Triangle::new([[0.2, 0.1], [1.4, 0.3], [0.5, 1.1]]).unwrap();
        let moments = triangle.moments();
        for i in 0..3 {
            assert!((moments.of(triangle.shares[i]) - moments.area() / 3.0).abs() < 1e-15);
            let by = moments.weighted(triangle.shares[i]);
            for j in 0..3 {
                let found: f64 = (0..3).map(|k| by[k] * triangle.shares[j][k]).sum();
                let expected = moments.area() / if i == j { 6.0 } else { 12.0 };
                assert!((found - expected).abs() < 1e-15, "{i} {j}: {found} {expected}");
            }
        }
        let [xx, xy, yy] = Triangle::new([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).unwrap().moments().covariance();
        assert!((xx - 1.0 / 18.0).abs() < 1e-15 && (xy + 1.0 / 36.0).abs() < 1e-15 && (yy - 1.0 / 18.0).abs() < 1e-15);
    }

    #[test]
    fn what_has_no_area_or_is_no_number_is_no_triangle() {
        let none = [[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [[0.0; 2]; 3], [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]];
        assert!(none.into_iter().all(|corners| Triangle::new(corners).is_none()));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(Triangle::new([[0.0, 0.0], [1.0, 0.0], [0.3, bad]]).is_none());
        }
    }
}
