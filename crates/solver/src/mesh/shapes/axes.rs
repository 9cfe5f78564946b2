//! Axes of a body that stands along any direction.

use super::Body;
use crate::tensor::cross;

/// Three orthogonal unit vectors, right-handed; the third is the direction in which a body stands.
pub(super) struct Axes([[f64; 3]; 3]);

/// Unit vector; `None` for a vector without direction.
pub(in crate::mesh) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}

impl Axes {
    /// The first one is the coordinate axis after that which the direction is nearest to, made orthogonal: x
    /// for z, y for x, z for y.
    pub(super) fn along(direction: [f64; 3]) -> Self {
        let third = unit(direction).unwrap_or([0.0, 0.0, 1.0]);
        let nearest = [2, 1, 0].into_iter().fold(2, |best, k| if third[k].abs() > third[best].abs() { k } else { best });
        let next = (nearest + 1) % 3;
        let along = third[next];
        let first = std::array::from_fn(|d| f64::from(u8::from(d == next)) - along * third[d]);
        let first = unit(first).unwrap_or([1.0, 0.0, 0.0]);
        Self([first, cross(third, first), third])
    }

    /// Puts a body that stands along z at the origin there.
    pub(super) fn put(&self, body: &mut Body<3>, origin: [f64; 3]) {
        let Self([u, v, w]) = self;
        for x in &mut body.positions {
            *x = std::array::from_fn(|d| origin[d] + (x[0] * u[d] + x[1] * v[d] + x[2] * w[d]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_right_handed_and_those_of_3d_are_exact() {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (direction, expected) in [(z, [x, y, z]), (x, [y, z, x]), (y, [z, x, y])] {
            assert_eq!(Axes::along(direction.map(|d| 3.0 * d)).0, expected);
        }
        for direction in [[1.0, 2.0, -0.5], [-3.0, 1.0, 1.0], [0.0, 0.0, -1.0], [1.0, 1.0, 1.0]] {
            let Axes([u, v, w]) = Axes::along(direction);
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            assert!([dot(u, v), dot(v, w), dot(w, u)].iter().all(|x| x.abs() < 1e-15));
            assert!([dot(u, u), dot(v, v), dot(w, w), dot(cross(u, v), w)].iter().all(|x| (x - 1.0).abs() < 1e-15));
            assert!(dot(w, direction) > 0.0);
        }
    }
}
