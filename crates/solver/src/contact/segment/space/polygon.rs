//! Triangles of a plane, what edges leave of them, and integrals over it.
//!
//! Corners and edges come from the facets of a pair in their common plane ([`super::fan`]). What two
//! triangles have in common is convex: one is cut along the edges of the other one (Sutherland and Hodgman,
//! Comm. ACM 17 (1974) 32-42). A corner that is new lies between two old ones, however short an edge is or
//! however nearly parallel two are, so nothing leaves the first triangle.

/// A place in the plane, m.
pub(super) type Point = [f64; 2];

/// A linear function c₀ + c₁ x + c₂ y of places.
pub(super) type Linear = [f64; 3];

/// Corners of a common part. A cut makes at most half as many corners more, even where rounding makes a
/// straight line crooked: 3, 4, 6, 9.
const CORNERS: usize = 9;

/// A triangle whose area is less than this fraction of the square of its longest edge has none.
pub(super) const FLAT: f64 = 1e-10;

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

    /// Those within corners, counter-clockwise, as a fan of triangles about the first one.
    pub(super) fn around(corners: &[Point]) -> Self {
        let [first, second, others @ ..] = corners else { return Self::default() };
        let from = |p: &Point| [p[0] - first[0], p[1] - first[1]];
        let (mut u, mut sums) = (from(second), [0.0; 6]);
        for corner in others {
            let v = from(corner);
            let (twice, [x, y]) = (u[0] * v[1] - u[1] * v[0], [u[0] + v[0], u[1] + v[1]]);
            let square = |i: usize, j: usize, all: f64| u[i] * u[j] + v[i] * v[j] + all;
            let more = [1.0, x, y, square(0, 0, x * x), square(0, 1, x * y), square(1, 1, y * y)];
            sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += twice * more);
            u = v;
        }
        let [x0, y0] = *first;
        let [one, x, y] = [0.5 * sums[0], sums[1] / 6.0, sums[2] / 6.0];
        let [xx, xy, yy] = [sums[3] / 24.0, sums[4] / 24.0, sums[5] / 24.0];
        Self([
            one,
            x + x0 * one,
            y + y0 * one,
            xx + x0 * (2.0 * x + x0 * one),
            xy + x0 * y + y0 * (x + x0 * one),
            yy + y0 * (2.0 * y + y0 * one),
        ])
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
#[cfg(test)]
pub(super) fn doubled([a, b, c]: [Point; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// From a corner along an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    pub(super) from: Point,
    pub(super) along: Point,
}

impl Edge {
    #[cfg(test)]
    pub(super) fn new(from: Point, to: Point) -> Self {
        Self { from, along: [to[0] - from[0], to[1] - from[1]] }
    }

    /// Positive on its left, m².
    pub(super) fn side(&self, p: Point) -> f64 {
        self.along[0] * (p[1] - self.from[1]) - self.along[1] * (p[0] - self.from[0])
    }

    /// The same in the other direction.
    pub(super) fn reversed(&self) -> Self {
        Self { along: self.along.map(|c| -c), ..*self }
    }
}

/// A convex part of the plane, counter-clockwise; of a triangle, by weights of its corners, where `N` is 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon<const N: usize = 2> {
    corners: [[f64; N]; CORNERS],
    count: usize,
}

impl<const N: usize> Default for Polygon<N> {
    fn default() -> Self {
        Self { corners: [[0.0; N]; CORNERS], count: 0 }
    }
}

impl<const N: usize> Polygon<N> {
    pub(super) fn corners(&self) -> &[[f64; N]] {
        &self.corners[..self.count]
    }

    pub(super) fn set(&mut self, corners: &[[f64; N]; 3]) {
        self.corners[..3].copy_from_slice(corners);
        self.count = 3;
    }

    pub(super) fn set_each(&mut self, corners: impl Iterator<Item = [f64; N]>) {
        self.count = 0;
        corners.for_each(|corner| self.push(corner));
    }

    /// Writes what of it is on the positive side of a line.
    #[inline(always)]
    pub(super) fn cut(&self, side: impl Fn(&[f64; N]) -> f64, left: &mut Self) {
        left.count = 0;
        let Some(last) = self.corners().last() else { return };
        let (mut from, mut before) = (last, side(last));
        let mut was_beyond = before < 0.0;
        for to in self.corners() {
            let after = side(to);
            let is_beyond = after < 0.0;
            if was_beyond != is_beyond {
                // Both have different signs: the sum of their sizes is not zero.
                let way = before / (before - after);
                left.push(std::array::from_fn(|d| from[d] + way * (to[d] - from[d])));
            }
            if !is_beyond {
                left.push(*to);
            }
            (from, before, was_beyond) = (to, after, is_beyond);
        }
    }

    #[inline(always)]
    fn push(&mut self, corner: [f64; N]) {
        if self.count < CORNERS {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }
}

impl Polygon {
    /// The same with what is on the left of an edge.
    pub(super) fn cut_along(&self, edge: Edge, left: &mut Self) {
        self.cut(|&p| edge.side(p), left);
    }

    /// Integrals over it.
    pub(super) fn moments(&self) -> Moments {
        Moments::around(self.corners())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_a_triangle_are_the_closed_forms() {
        let corners = [[0.2, 0.1], [1.4, 0.3], [0.5, 1.1]];
        let moments = Moments::around(&corners);
        let [x, y] = [0, 1].map(|d| corners.iter().map(|p| p[d]).sum::<f64>() / 3.0);
        assert!((moments.area() - 0.5 * doubled(corners)).abs() < 1e-15);
        assert!((moments.0[1] - x * moments.area()).abs() < 1e-15 && (moments.0[2] - y * moments.area()).abs() < 1e-15);
        let [xx, xy, yy] = Moments::around(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).covariance();
        assert!((xx - 1.0 / 18.0).abs() < 1e-15 && (xy + 1.0 / 36.0).abs() < 1e-15 && (yy - 1.0 / 18.0).abs() < 1e-15);
    }

    #[test]
    fn what_is_cut_by_weights_is_what_is_cut_by_places() {
        let corners = [[0.2, 0.1], [1.4, 0.3], [0.5, 1.1]];
        let (mut part, mut weights) = (Polygon::default(), Polygon::<3>::default());
        part.set(&corners);
        weights.set(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        for (from, to) in [([0.0, 0.5], [1.0, 0.4]), ([0.7, 0.0], [0.5, 1.0])] {
            let edge = Edge::new(from, to);
            let mut left = Polygon::default();
            part.cut_along(edge, &mut left);
            part = left;
            let sides = corners.map(|p| edge.side(p));
            let mut left = Polygon::default();
            weights.cut(|at| (0..3).map(|k| sides[k] * at[k]).sum(), &mut left);
            weights = left;
        }
        assert!(part.corners().len() > 2 && part.corners().len() == weights.corners().len());
        for (p, at) in part.corners().iter().zip(weights.corners()) {
            assert!((0..2).all(|d| (p[d] - (0..3).map(|k| at[k] * corners[k][d]).sum::<f64>()).abs() < 1e-15));
        }
    }
}
