//! What a dimension means beyond the kernels: rotations about an axis, and the trait that the system asks for.
//!
//! [`World`] is what everything from the mesh to the step needs of a dimension; `tensor.rs` has what elements need. In the plane axes stand on it.

mod plane;
mod space;

use crate::block::Blocks;
use crate::build::Builder;
use crate::contact::Contact;
use crate::contact::springs::TangentSpace;
use crate::contact::traces::Traces;
use crate::contact_forces::ContactForces;
use crate::error::Fault;
use crate::mesh::cell::Cell;
use crate::mesh::surface::Facet;
use crate::mesh::surface::tributary::Tributary;
use crate::mesh::{Mesh, Meshed};
use crate::model::{self, Model};
use crate::rigid::Body;
use crate::rigid::RigidMotion;
use crate::tensor::{Dim, Space};
use crate::vector::{dot, first};

/// A square matrix of numbers.
pub type Square<const D: usize> = [[f64; D]; D];

/// What the system needs of a dimension.
pub trait World<const D: usize>: Space<D> + Meshed<D> + Tributary<D> + TangentSpace<D> + Blocks<D> + Send + Sync + 'static {
    /// Velocity (m/s) that leads the point `arm` (m) from a centre that rests along the chord of an arc about `axis` (a unit vector), with `spin` (rad/s) over `time_step` (s); without a
    /// step that along the tangent.
    fn led(arm: [f64; D], axis: [f64; 3], spin: f64, time_step: f64) -> [f64; D];
    /// Rotation by an angle (rad) about `axis`, a unit vector.
    fn rotation(axis: [f64; 3], angle: f64) -> Square<D>;
    /// The part of a point that lies across `axis`.
    fn across(arm: [f64; D], axis: [f64; 3]) -> [f64; D];
    /// The cross product `spin` × `arm`; in the plane the spin is its third component.
    fn swept(spin: [f64; 3], arm: [f64; D]) -> [f64; D];
    /// Smallest Jacobian determinant of a cell, times that of its natural corner, over its corners (m², in space m³): positive in all of them where the cell is sound; `None` of lines.
    fn least_corner(cell: Cell<'_>, positions: &[[f64; D]]) -> Option<f64>;
    /// That over the square (in space: the third power) of the longest side: 1 of squares and cubes, less of what is long, sheared or folded; lines have the best.
    fn shape(cell: Cell<'_>, positions: &[[f64; D]]) -> f64;
    /// One over the height of a cell over a piece of its outside, 1/m: its length over the area, in space its area over the volume.
    fn flatness(facet: Facet<D>, cell: Cell<'_>, positions: &[[f64; D]]) -> f64
    where
        Dim<D>: Meshed<D>;
    /// Length of a line, area of what has more corners; in space the volume of a cell; m, m², m³.
    fn size(cell: Cell<'_>, positions: &[[f64; D]]) -> f64;
    /// Largest and smallest principal logarithmic strain at the centre of a cell, from the positions at the start to those now: half the logarithms of the eigenvalues of FᵀF. Of a line
    /// its one strain twice.
    fn strains(cell: Cell<'_>, from: &[[f64; D]], to: &[[f64; D]]) -> [f64; 2];
    /// The pieces of the outside that a cell alone would have: in the plane they run against its own direction; in the form in which surfaces have them.
    fn facets(cell: Cell<'_>) -> Vec<Facet<D>>
    where
        Dim<D>: Meshed<D>;
    /// Pressure and shear stress of every node, Pa.
    fn tractions(traces: &Traces<D>, forces: &ContactForces<D>, positions: &[[f64; D]]) -> Vec<[f64; 2]>
    where
        Dim<D>: TangentSpace<D>;
    /// Columns of the moment on an obstacle.
    const MOMENT: &[&str];
    /// Their values.
    fn moments(moment: &<Self as RigidMotion<D>>::Spin) -> Vec<f64>;
    /// Columns of a rigid body that moves: its reference point, in the plane its angle, and their velocities.
    const MOTION: &[&str];
    /// Their values at the whole step; `before` is the part of the last update that lies before it.
    fn motion(body: &Body<D>, before: f64) -> Vec<f64>
    where
        Dim<D>: World<D>;
    /// Numbers that say where a rigid body is and how it moves, for hashes.
    fn numbers(body: &Body<D>) -> Vec<f64>
    where
        Dim<D>: World<D>;
    /// What of a rigid body's mass is free to move along an axis, kg/m (kg), its velocity, and its spin times its inertia.
    fn momenta(body: &Body<D>) -> (f64, [f64; D], [f64; 3])
    where
        Dim<D>: World<D>;
    /// The image of a motion that a join turns, as springs in contact take it.
    fn image(turn: &Square<D>) -> <Self as TangentSpace<D>>::ImageRotation;
    /// The model with what its mesh asks for besides: the axis of a body of revolution that touches it.
    ///
    /// # Errors
    /// Nodes where no body of revolution can be.
    fn with_axis(model: &Model, mesh: &Mesh<D>) -> Result<Option<Model>, Vec<Fault>>
    where
        Dim<D>: World<D>;
    /// Notes penetrations at the start as faults, or gives lines for the overview; those that shall be pushed out are, in the mesh.
    fn part_at_start(builder: &mut Builder<'_, D>) -> Vec<String>
    where
        Dim<D>: World<D>;
    /// The body of a rigid part with its mass on its nodes, kg/m (kg).
    fn rigid_part(builder: &Builder<'_, D>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<D>
    where
        Dim<D>: World<D>;
    /// The contacts of the model; notes faults.
    fn contacts(builder: &mut Builder<'_, D>) -> Vec<Contact<D>>
    where
        Dim<D>: World<D>;
    /// Its obstacles.
    fn obstacles(builder: &mut Builder<'_, D>) -> Vec<Contact<D>>
    where
        Dim<D>: World<D>;
    /// Gives contacts and obstacles new surfaces after elements were eroded.
    fn renew(builder: &mut Builder<'_, D>, contacts: &mut [Contact<D>])
    where
        Dim<D>: World<D>;
    /// The moment `arm` × `force`; in the plane its third component, and no other.
    fn moment(arm: [f64; D], force: [f64; D]) -> [f64; 3];
}

/// A point in words, by the components that the dimension has.
#[must_use]
pub fn place<const D: usize>(x: [f64; D]) -> String {
    let components: Vec<String> = x.iter().map(|component| format!("{component:.6e}")).collect();
    format!("({})", components.join(", "))
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

/// The unit vector along an axis that the model gives; z where it has no direction.
#[must_use]
pub fn axis(of: [f64; 3]) -> [f64; 3] {
    crate::load::constraint::unit(of).unwrap_or_else(|| first([0.0, 0.0, 1.0]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;

    #[test]
    fn a_point_is_led_around_an_axis_on_its_circle() {
        let axis = axis([1.0, 2.0, 2.0]);
        let (mut x, dt, spin) = ([0.3, -0.2, 0.5], 0.01, 3.0);
        let (start, radius) = (x, Dim::<3>::across(x, axis));
        for _ in 0..100 {
            let v = Dim::<3>::led(x, axis, spin, dt);
            x = std::array::from_fn(|d| x[d] + dt * v[d]);
        }
        let turned = applied(&Dim::<3>::rotation(axis, 3.0), start);
        assert!((0..3).all(|d| (x[d] - turned[d]).abs() < 1e-14), "{x:?} {turned:?}");
        let now = Dim::<3>::across(x, axis);
        assert!((dot(now, now) - dot(radius, radius)).abs() < 1e-14 && (dot(x, axis) - dot(start, axis)).abs() < 1e-14);
    }

    #[test]
    fn about_z_space_turns_as_the_plane_does() {
        let z = [0.0, 0.0, 1.0];
        let (plane, space) = (Dim::<2>::rotation(z, 0.7), Dim::<3>::rotation(z, 0.7));
        assert!((0..2).all(|i| (0..2).all(|j| plane[i][j] == space[i][j])) && space[2] == z);
        let (plane, space) = (Dim::<2>::led([0.3, 0.4], z, 2.0, 0.1), Dim::<3>::led([0.3, 0.4, 5.0], z, 2.0, 0.1));
        assert!((0..2).all(|d| (plane[d] - space[d]).abs() < 1e-16) && space[2] == 0.0);
    }

    #[test]
    fn the_shape_of_squares_and_cubes_is_one_and_of_what_is_flat_or_folded_less() {
        fn of<const D: usize>(positions: &[[f64; D]]) -> f64
        where
            Dim<D>: World<D>,
        {
            let kind = CellKind::of(D, positions.len()).unwrap();
            <Dim<D>>::shape(kind.cell(&(0..positions.len() as u32).collect::<Vec<_>>()), positions)
        }
        assert_eq!(of(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]), 1.0);
        assert_eq!(of(&[[0.0, 0.0], [10.0, 0.0], [10.0, 1.0], [0.0, 1.0]]), 0.1);
        assert!((of(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]]) - 0.75f64.sqrt()).abs() < 1e-15);
        assert!(of(&[[0.0, 0.0], [1.0, 0.0], [0.2, 0.2], [0.0, 1.0]]) < 0.0);
        let prism = |base: &[[f64; 2]], height: f64| -> Vec<[f64; 3]> {
            [0.0, height].iter().flat_map(|&z| base.iter().map(move |x| [x[0], x[1], z])).collect()
        };
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        assert_eq!((of(&prism(&square, 2.0)), of(&prism(&square, -2.0)), of(&prism(&square, 1.0))), (1.0, -1.0, 0.5));
        assert!((of(&prism(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]], 1.0)) - 0.75f64.sqrt()).abs() < 1e-15);
        let (a, b) = ((1.0f64 / 3.0).sqrt(), (2.0f64 / 3.0).sqrt());
        let tetrahedron = [[a, 0.0, 0.0], [-0.5 * a, 0.5, 0.0], [-0.5 * a, -0.5, 0.0], [0.0, 0.0, b]];
        assert!((of(&tetrahedron) - 0.5f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_matrix_times_its_inverse_is_one() {
        let m = [[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 0.9]];
        let product = inverse(&m).map(|row| std::array::from_fn::<f64, 3, _>(|j| (0..3).map(|k| row[k] * m[k][j]).sum()));
        assert!((0..9).all(|k| (product[k / 3][k % 3] - unit_matrix::<3>()[k / 3][k % 3]).abs() < 1e-15));
    }
}
