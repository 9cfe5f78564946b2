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
pub(super) fn doubled([a, b, c]: [Point; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Linear functions that are one at a corner of a triangle and zero at the others, and sum up to one; `None`
/// where it has no area, or runs clockwise.
#[inline]
pub(super) fn shares(corners: [Point; 3]) -> Option<[Linear; 3]> {
    let [a, b, c] = corners;
    let whole = doubled(corners);
    let square = |p: Point, q: Point| (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
    let squares = [square(a, b), square(b, c), square(c, a)];
    // No number fails the comparison too.
    if !squares.into_iter().all(|square| whole > FLAT * square) {
        return None;
    }
    let share = |p: Point, q: Point| {
        // Zero on the edge from p to q.
        let [gx, gy] = [(p[1] - q[1]) / whole, (q[0] - p[0]) / whole];
        [-(gx * p[0] + gy * p[1]), gx, gy]
    };
    let (first, second) = (share(b, c), share(c, a));
    Some([first, second, [1.0 - first[0] - second[0], -first[1] - second[1], -first[2] - second[2]]])
}

/// From a corner along an edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    pub(super) from: Point,
    pub(super) along: Point,
}

impl Edge {
    pub(super) fn new(from: Point, to: Point) -> Self {
        Self { from, along: [to[0] - from[0], to[1] - from[1]] }
    }

    /// Positive on its left, m².
    pub(super) fn side(&self, p: Point) -> f64 {
        self.along[0] * (p[1] - self.from[1]) - self.along[1] * (p[0] - self.from[0])
    }

    /// Square of its length, m².
    pub(super) fn square(&self) -> f64 {
        self.along[0] * self.along[0] + self.along[1] * self.along[1]
    }

    /// The same in the other direction.
    pub(super) fn reversed(&self) -> Self {
        Self { along: self.along.map(|c| -c), ..*self }
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

    pub(super) fn set(&mut self, corners: &[Point; 3]) {
        self.corners[..3].copy_from_slice(corners);
        self.count = 3;
    }

    /// Keeps what of it is on the left of an edge; `room` has what it was.
    pub(super) fn cut(&mut self, edge: Edge, room: &mut Self) {
        (room.corners, room.count) = (self.corners, self.count);
        self.count = 0;
        let Some(&last) = room.corners().last() else { return };
        let (mut from, mut before) = (last, edge.side(last));
        for &to in room.corners() {
            let after = edge.side(to);
            if (before < 0.0) != (after < 0.0) {
                // Both have different signs: the sum of their sizes is not zero.
                let way = before / (before - after);
                self.push([from[0] + way * (to[0] - from[0]), from[1] + way * (to[1] - from[1])]);
            }
            if !(after < 0.0) {
                self.push(to);
            }
            (from, before) = (to, after);
        }
    }

    fn push(&mut self, corner: Point) {
        if self.count < CORNERS {
            self.corners[self.count] = corner;
            self.count += 1;
        }
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
    fn integrals_of_shares_and_their_products_are_the_closed_forms() {
        let corners = [[0.2, 0.1], [1.4, 0.3], [0.5, 1.1]];
        let (shares, moments) = (shares(corners).unwrap(), Moments::around(&corners));
        let integral = |share: Linear| (0..3).map(|k| share[k] * moments.0[k]).sum::<f64>();
        for i in 0..3 {
            assert!((integral(shares[i]) - moments.area() / 3.0).abs() < 1e-15);
            let by = moments.weighted(shares[i]);
            for j in 0..3 {
                let found: f64 = (0..3).map(|k| by[k] * shares[j][k]).sum();
                let expected = moments.area() / if i == j { 6.0 } else { 12.0 };
                assert!((found - expected).abs() < 1e-15, "{i} {j}: {found} {expected}");
            }
        }
        let [xx, xy, yy] = Moments::around(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).covariance();
        assert!((xx - 1.0 / 18.0).abs() < 1e-15 && (xy + 1.0 / 36.0).abs() < 1e-15 && (yy - 1.0 / 18.0).abs() < 1e-15);
    }

    #[test]
    fn what_has_no_area_or_is_no_number_is_no_triangle() {
        let none = [[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [[0.0; 2]; 3], [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]];
        assert!(none.into_iter().all(|corners| shares(corners).is_none()));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(shares([[0.0, 0.0], [1.0, 0.0], [0.3, bad]]).is_none());
        }
    }
}
