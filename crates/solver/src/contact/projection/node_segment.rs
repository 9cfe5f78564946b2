//! Node against segments of the plane: nearest feature, inside or outside, and the swept crossing of a segment.
//!
//! Positions come from the step, candidates from the global search; projections go to the contact law. One rule covers both corner cases
//! of the paper (figures 4 and 5): the nearest feature of the target decides, the inside of a segment or a node; the pseudo-normal of
//! a node is the sum of its two segment normals. Theory, sections 4.1 and 4.2.

use crate::mesh::surface::{NONE, Surface};

/// A point or vector of the plane.
pub type Vector = [f64; 2];

/// A surface as a target: its segments, and what its ends know.
#[derive(Clone, Debug, Default)]
pub struct Target {
    /// The segments, body on the right.
    pub surface: Surface,
    /// Normal of the symmetry line that the node of an open end lies on: (node, normal), by node. The mirrored half of the body goes on there.
    pub mirrors: Vec<(u32, Vector)>,
}

/// Where a node lies with respect to the nearest feature of a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Segment that the feature belongs to.
    pub segment: u32,
    /// Shares Φ₁, Φ₂ of the segment's nodes in the projected point, eqs. (5)-(7).
    pub weights: [f64; 2],
    /// Distance with sign, m: negative inside the target.
    pub gap: f64,
    /// Unit vector along which the slave node is pushed out.
    pub normal: Vector,
}

/// An end beyond which a body is cut (a named side only): nodes that project beyond it by this fraction of the segment still count.
const END_TOLERANCE: f64 = 1e-9;

impl Target {
    /// Projects `x` on segment `segment` or on the end that is nearest; `None` where the surface is cut off there, or the segment has no length.
    ///
    /// ε of eq. (8) is 2 s − 1 with s = (x − C₁)·T / |C₂ − C₁|.
    #[must_use]
    pub fn project(&self, x: Vector, segment: u32, positions: &[Vector]) -> Option<Projection> {
        let [n1, n2] = self.surface.segments[segment as usize];
        let (c1, c2) = (positions[n1 as usize], positions[n2 as usize]);
        let t = minus(c2, c1);
        let length_squared = dot(t, t);
        // NaN fails the comparison too
        if !(length_squared > 0.0) {
            return None;
        }
        let s = dot(minus(x, c1), t) / length_squared;
        let normal = outward(t, length_squared.sqrt());
        if (0.0..=1.0).contains(&s) {
            let gap = dot(minus(x, c1), normal);
            return Some(Projection { segment, weights: [1.0 - s, s], gap, normal });
        }
        let (node, end, beyond, weights) = if s < 0.0 { (n1, c1, -s, [1.0, 0.0]) } else { (n2, c2, s - 1.0, [0.0, 1.0]) };
        let pseudo = match self.neighbour_normal(segment, s > 0.0, positions) {
            Some(other) => plus(normal, other),
            None => match self.mirrors.binary_search_by_key(&node, |&(node, _)| node) {
                Ok(i) => {
                    let m = self.mirrors[i].1;
                    let along = dot(normal, m);
                    [normal[0] - along * m[0], normal[1] - along * m[1]]
                }
                Err(_) if beyond <= END_TOLERANCE => normal,
                Err(_) => return None,
            },
        };
        let away = minus(x, end);
        let distance = dot(away, away).sqrt();
        if distance == 0.0 {
            return Some(Projection { segment, weights, gap: 0.0, normal: unit(pseudo, normal) });
        }
        let inside = dot(away, pseudo) < 0.0;
        let sign = if inside { -1.0 } else { 1.0 };
        Some(Projection { segment, weights, gap: sign * distance, normal: [sign * away[0] / distance, sign * away[1] / distance] })
    }

    fn neighbour_normal(&self, segment: u32, at_end: bool, positions: &[Vector]) -> Option<Vector> {
        let neighbour = if at_end { self.surface.next[segment as usize] } else { self.surface.previous[segment as usize] };
        let [a, b] = *self.surface.segments.get(neighbour as usize)?;
        let t = minus(positions[b as usize], positions[a as usize]);
        let length = dot(t, t).sqrt();
        (length > 0.0).then(|| outward(t, length))
    }

    /// Nearest feature to `x` among `candidates`; of equally near ones the first.
    pub fn nearest(&self, x: Vector, candidates: &[u32], positions: &[Vector]) -> Option<Projection> {
        candidates.iter().filter_map(|&segment| self.project(x, segment, positions)).reduce(nearer)
    }

    /// Follows the chain from `start` to the nearest feature: the way to stay on the side of a thin body on which a node came in.
    #[must_use]
    pub fn follow(&self, x: Vector, start: u32, positions: &[Vector]) -> Option<Projection> {
        let mut best = self.project(x, start, positions);
        for _ in 0..self.surface.segments.len() {
            let at = best.map_or(start, |projection| projection.segment) as usize;
            let neighbours = [self.surface.previous[at], self.surface.next[at]];
            let around = neighbours.iter().filter(|&&segment| segment != NONE).filter_map(|&segment| self.project(x, segment, positions));
            let next = best.into_iter().chain(around).reduce(nearer);
            if next.map(|p| p.segment) == best.map(|p| p.segment) {
                break;
            }
            best = next;
        }
        best
    }

    /// First time (0 to 1) at which a node that moves from `x_old` to `x_new` goes through `segment` from the outside in; all paths straight.
    ///
    /// The side f = T × (x − C₁) is a quadratic in time; its roots are tested for lying between the segment's nodes.
    #[must_use]
    pub fn crossing(&self, x_old: Vector, x_new: Vector, segment: u32, positions_old: &[Vector], positions_new: &[Vector]) -> Option<f64> {
        let [n1, n2] = self.surface.segments[segment as usize].map(|node| node as usize);
        let e0 = minus(positions_old[n2], positions_old[n1]);
        let r0 = minus(x_old, positions_old[n1]);
        let de = minus(minus(positions_new[n2], positions_new[n1]), e0);
        let dr = minus(minus(x_new, positions_new[n1]), r0);
        let (c, b, a) = (cross(e0, r0), cross(e0, dr) + cross(de, r0), cross(de, dr));
        if c.abs() > b.abs() + a.abs() {
            return None;
        }
        let within = |time: &f64| {
            let e = [e0[0] + time * de[0], e0[1] + time * de[1]];
            let r = [r0[0] + time * dr[0], r0[1] + time * dr[1]];
            let (along, whole) = (dot(r, e), dot(e, e));
            (0.0..=1.0).contains(time)
                && b + 2.0 * a * time < 0.0
                && whole > 0.0
                && (-END_TOLERANCE * whole..=(1.0 + END_TOLERANCE) * whole).contains(&along)
        };
        quadratic_roots(a, b, c).into_iter().flatten().find(within)
    }
}

/// Real roots of a t² + b t + c = 0 in ascending order, without cancellation.
fn quadratic_roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 || discriminant.is_nan() {
        return [None, None];
    }
    let q = -0.5 * (b + if b < 0.0 { -discriminant.sqrt() } else { discriminant.sqrt() });
    let (first, second) = (q / a, c / q);
    match (first.is_finite(), second.is_finite()) {
        (true, true) if first > second => [Some(second), Some(first)],
        (true, true) => [Some(first), Some(second)],
        (true, false) => [Some(first), None],
        (false, true) => [Some(second), None],
        // q = 0: both b and c vanish
        (false, false) => [(c == 0.0 && b == 0.0 && a != 0.0).then_some(0.0), None],
    }
}

fn nearer(best: Projection, other: Projection) -> Projection {
    if other.gap.abs() < best.gap.abs() { other } else { best }
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Outward normal of a segment with the body on its right: n = (−t₂, t₁).
fn outward(t: Vector, length: f64) -> Vector {
    [-t[1] / length, t[0] / length]
}

fn unit(v: Vector, otherwise: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    if length > 0.0 { [v[0] / length, v[1] / length] } else { otherwise }
}
