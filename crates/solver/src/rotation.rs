//! Matrices and rotations about an axis, in 2D and 3D ([`Rotate`], on [`Dim`]). In 2D axes are normal to the
//! plane.

use crate::angle::cos_sin;
use crate::tensor::{Dim, Space, cross};
use crate::vector::{dot, first, minus, times, unit};

/// A square matrix of numbers.
pub type Square<const D: usize> = [[f64; D]; D];

/// Rotations about an axis.
pub trait Rotate<const D: usize> {
    /// Velocity (m/s) that leads the point `arm` (m) from a centre that rests along the chord of an arc about
    /// `axis` (a unit vector), with `spin` (rad/s) over `time_step` (s); without a step that along the
    /// tangent.
    fn chord_velocity(arm: [f64; D], axis: [f64; 3], spin: f64, time_step: f64) -> [f64; D];
    /// Rotation by an angle (rad) about `axis`, a unit vector.
    fn rotation(axis: [f64; 3], angle: f64) -> Square<D>;
    /// The part of a point that lies across `axis`.
    fn perpendicular(arm: [f64; D], axis: [f64; 3]) -> [f64; D];
    /// The cross product `spin` × `arm`; in 2D the spin is its third component.
    fn spin_velocity(spin: [f64; 3], arm: [f64; D]) -> [f64; D];
    /// The moment `arm` × `force`; in 2D its third component, and no other.
    fn moment_vector(arm: [f64; D], force: [f64; D]) -> [f64; 3];
}

impl Rotate<2> for Dim<2> {
    fn chord_velocity(arm: [f64; 2], _axis: [f64; 3], spin: f64, time_step: f64) -> [f64; 2] {
        if time_step == 0.0 {
            return [-spin * arm[1], spin * arm[0]];
        }
        let [[_, sin], [_, half]] = [time_step * spin, 0.5 * time_step * spin].map(cos_sin);
        let (along, across) = (-2.0 * half * half / time_step, sin / time_step);
        [along * arm[0] - across * arm[1], along * arm[1] + across * arm[0]]
    }
    fn rotation(_axis: [f64; 3], angle: f64) -> Square<2> {
        let [cos, sin] = cos_sin(angle);
        [[cos, -sin], [sin, cos]]
    }
    fn perpendicular(arm: [f64; 2], _axis: [f64; 3]) -> [f64; 2] {
        arm
    }
    fn spin_velocity([_, _, spin]: [f64; 3], [a, b]: [f64; 2]) -> [f64; 2] {
        [-spin * b, spin * a]
    }
    fn moment_vector(arm: [f64; 2], force: [f64; 2]) -> [f64; 3] {
        [0.0, 0.0, arm[0] * force[1] - arm[1] * force[0]]
    }
}

impl Rotate<3> for Dim<3> {
    fn chord_velocity(arm: [f64; 3], axis: [f64; 3], spin: f64, time_step: f64) -> [f64; 3] {
        let sweep = cross(axis, arm);
        if time_step == 0.0 {
            return times(spin, sweep);
        }
        let [[_, sin], [_, half]] = [time_step * spin, 0.5 * time_step * spin].map(cos_sin);
        let (along, around) = (-2.0 * half * half / time_step, sin / time_step);
        let arm = Self::perpendicular(arm, axis);
        std::array::from_fn(|d| along * arm[d] + around * sweep[d])
    }
    /// Rodrigues: R = cos I + sin (a ×) + (1 − cos) a aᵀ.
    fn rotation(axis: [f64; 3], angle: f64) -> Square<3> {
        let [cos, sin] = cos_sin(angle);
        let column = |d: usize| {
            let unit = std::array::from_fn(|k| if k == d { 1.0 } else { 0.0 });
            let (across, sweep) = (Self::perpendicular(unit, axis), cross(axis, unit));
            let along = minus(unit, across);
            std::array::from_fn(|k| cos * across[k] + sin * sweep[k] + along[k])
        };
        let columns: Square<3> = [0, 1, 2].map(column);
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
    }
    fn perpendicular(arm: [f64; 3], axis: [f64; 3]) -> [f64; 3] {
        minus(arm, times(dot(arm, axis), axis))
    }
    fn spin_velocity(spin: [f64; 3], arm: [f64; 3]) -> [f64; 3] {
        cross(spin, arm)
    }
    fn moment_vector(arm: [f64; 3], force: [f64; 3]) -> [f64; 3] {
        cross(arm, force)
    }
}

/// A matrix times a vector.
#[inline]
#[must_use]
pub fn applied<const D: usize>(m: &Square<D>, v: [f64; D]) -> [f64; D] {
    m.map(|row| dot(row, v))
}

/// The unit matrix.
#[must_use]
pub fn unit_matrix<const D: usize>() -> Square<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }))
}

/// The transpose.
#[must_use]
pub fn transposed<const D: usize>(m: &Square<D>) -> Square<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// Inverse of a matrix that has one.
#[must_use]
pub fn inverse<const D: usize>(m: &Square<D>) -> Square<D>
where
    Dim<D>: Space<D>,
{
    let (adjugate, determinant) = (<Dim<D> as Space<D>>::adjugate(m), <Dim<D> as Space<D>>::determinant(m));
    adjugate.map(|row| row.map(|component| component / determinant))
}

/// The rotation that is nearest to a matrix, in its polar decomposition; `None`: it turns inside out, or is
/// singular.
///
/// Source: Newton's iteration with Higham's scaling, SIAM J. Sci. Stat. Comput. 7 (1986) 1160-1174.
#[must_use]
pub fn nearest_rotation<const D: usize>(matrix: &Square<D>) -> Option<Square<D>>
where
    Dim<D>: Space<D>,
{
    let size = |of: &Square<D>| of.as_flattened().iter().map(|value| value * value).sum::<f64>().sqrt();
    let mut rotation = *matrix;
    for _ in 0..60 {
        if !(<Dim<D> as Space<D>>::determinant(&rotation) > 0.0) {
            return None;
        }
        let inverse = transposed(&inverse(&rotation));
        let scale = (size(&inverse) / size(&rotation)).sqrt();
        let next: Square<D> = std::array::from_fn(|i| std::array::from_fn(|k| 0.5 * (rotation[i][k] * scale + inverse[i][k] / scale)));
        let change: Square<D> = std::array::from_fn(|i| std::array::from_fn(|k| next[i][k] - rotation[i][k]));
        rotation = next;
        if size(&change) < 1e-14 {
            return Some(rotation);
        }
    }
    None
}

/// The unit vector along an axis that the model gives; z where it has no direction.
#[must_use]
pub fn axis(of: [f64; 3]) -> [f64; 3] {
    unit(of).unwrap_or_else(|| first([0.0, 0.0, 1.0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_rotation_of_a_stretch_and_a_rotation_is_the_rotation() {
        let (cos, sin) = (0.3_f64.cos(), 0.3_f64.sin());
        let turn = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let stretch = [[3e5, 2e3, 0.0], [2e3, 4e2, -1.0], [0.0, -1.0, 1e-2]];
        let product = std::array::from_fn(|i| std::array::from_fn(|k| (0..3).map(|j| turn[i][j] * stretch[j][k]).sum()));
        let found = nearest_rotation::<3>(&product).unwrap();
        assert!(found.as_flattened().iter().zip(turn.as_flattened()).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
        assert_eq!(nearest_rotation::<2>(&[[1.0, 0.0], [0.0, -1.0]]), None);
        assert_eq!(nearest_rotation::<2>(&[[1.0, 2.0], [2.0, 4.0]]), None);
        assert_eq!(nearest_rotation::<2>(&[[f64::NAN, 0.0], [0.0, 1.0]]), None);
    }

    #[test]
    fn a_point_is_led_around_an_axis_on_its_circle() {
        let axis = axis([1.0, 2.0, 2.0]);
        let (mut x, dt, spin) = ([0.3, -0.2, 0.5], 0.01, 3.0);
        let (start, radius) = (x, Dim::<3>::perpendicular(x, axis));
        for _ in 0..100 {
            let v = Dim::<3>::chord_velocity(x, axis, spin, dt);
            x = std::array::from_fn(|d| x[d] + dt * v[d]);
        }
        let turned = applied(&Dim::<3>::rotation(axis, 3.0), start);
        assert!((0..3).all(|d| (x[d] - turned[d]).abs() < 1e-14), "{x:?} {turned:?}");
        let now = Dim::<3>::perpendicular(x, axis);
        assert!((dot(now, now) - dot(radius, radius)).abs() < 1e-14 && (dot(x, axis) - dot(start, axis)).abs() < 1e-14);
    }

    #[test]
    fn about_z_space_turns_as_the_plane_does() {
        let z = [0.0, 0.0, 1.0];
        let (plane, space) = (Dim::<2>::rotation(z, 0.7), Dim::<3>::rotation(z, 0.7));
        assert!((0..2).all(|i| (0..2).all(|j| plane[i][j] == space[i][j])) && space[2] == z);
        let (plane, space) = (Dim::<2>::chord_velocity([0.3, 0.4], z, 2.0, 0.1), Dim::<3>::chord_velocity([0.3, 0.4, 5.0], z, 2.0, 0.1));
        assert!((0..2).all(|d| (plane[d] - space[d]).abs() < 1e-16) && space[2] == 0.0);
    }

    #[test]
    fn a_matrix_times_its_inverse_is_one() {
        let m = [[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 0.9]];
        let product = inverse(&m).map(|row| std::array::from_fn::<f64, 3, _>(|j| (0..3).map(|k| row[k] * m[k][j]).sum()));
        assert!((0..9).all(|k| (product[k / 3][k % 3] - unit_matrix::<3>()[k / 3][k % 3]).abs() < 1e-15));
    }
}
