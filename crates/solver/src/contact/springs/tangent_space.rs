//! Directions along a surface, and what springs in contact ask of a dimension ([`TangentSpace`], on [`Dim`]).
//!
//! A surface has one tangent in 2D, and two in 3D, which a spring carries with it. Arrays of 2D keep the
//! order in which their entries are added, so that results in 2D do not depend on there being 3D.

use super::friction::{self, FrictionInput, FrictionResult, cone};
use crate::archive::Plain;
use crate::mesh::surface::tributary::Tributary;
use crate::rigid::{self, Body, RigidMotion};
use crate::rotation::Square;
use crate::tensor::{Dim, cross as cross_space};
use crate::vector::{SYMMETRIC, any_tangent, times_symmetric};
use std::ops::{Index, IndexMut};

/// What springs in contact ask of a dimension: vectors along a surface, friction, and how nodes and bodies
/// respond to forces.
pub trait TangentSpace<const D: usize>: Tributary<D> + RigidMotion<D> {
    /// A value for each direction along a surface: D − 1.
    type TangentVector<T: Plain>: Plain + Index<usize, Output = T> + IndexMut<usize>;
    /// A symmetric D × D matrix, its upper triangle row by row: xx, xy, yy; xx, xy, xz, yy, yz, zz.
    type Symmetric: Plain + Index<usize, Output = f64> + IndexMut<usize>;
    /// Change of a row of velocities per row of force.
    type Mobility: Plain;
    /// A vector for each direction along a surface.
    type Tangents: Plain + Index<usize, Output = [f64; D]> + IndexMut<usize>;
    /// First tangent of a spring where the normal does not say it.
    type FirstTangent: Plain;
    /// Rotation from the motion of a node to that of its image: cosine and sine; a matrix.
    type ImageRotation: Plain;
    /// Where the entry i, j of a symmetric matrix is.
    const AT: [[usize; D]; D];
    /// A value for each direction along a surface.
    fn tangent_vector<T: Plain>(of: impl FnMut(usize) -> T) -> Self::TangentVector<T>;
    /// A vector for each direction along a surface.
    fn vectors(of: impl FnMut(usize) -> [f64; D]) -> Self::Tangents;
    /// The directions along a surface with the unit normal `normal`: orthonormal to it and to each other.
    fn tangents(normal: [f64; D], tangent: &Self::FirstTangent) -> Self::Tangents;
    /// Length of what lies along a surface.
    fn size(along: &Self::TangentVector<f64>) -> f64;
    /// The nearest to it that is no longer than `limit`.
    fn within(along: Self::TangentVector<f64>, limit: f64) -> Self::TangentVector<f64>;
    /// The direction of it: of no length any.
    fn direction(along: &Self::TangentVector<f64>) -> Self::TangentVector<f64>;
    /// Friction that a spring wants; see [`friction`].
    fn slide(stick: &FrictionInput<D>, slip: Self::TangentVector<f64>, limit: f64) -> FrictionResult<D>
    where
        Dim<D>: TangentSpace<D>;
    /// A direction along the surface in which friction that slides still follows the slip, and the change of
    /// its rate per force (beside the compliance); see [`cone`].
    fn lateral_compliance(
        stick: &FrictionInput<D>,
        slip: Self::TangentVector<f64>,
        friction: &Self::TangentVector<f64>,
    ) -> Option<(Self::TangentVector<f64>, f64)>
    where
        Dim<D>: TangentSpace<D>;
    /// Force of a tie along the surface.
    fn tie(stick: &FrictionInput<D>, slip: Self::TangentVector<f64>) -> Self::TangentVector<f64>
    where
        Dim<D>: TangentSpace<D>;
    /// A force on an image as its leader feels it.
    fn pull_back(turn: &Self::ImageRotation, force: [f64; D]) -> [f64; D];
    /// Of a node.
    fn mobility_of_node(mobility: &Self::Symmetric) -> Self::Mobility;
    /// Of a rigid body over a step, s.
    fn mobility_of_body(body: &Body<D>, mean_step: f64) -> Self::Mobility
    where
        Dim<D>: TangentSpace<D>;
    /// That of a node which rotates by a moment as `spin` says, about x, y and z.
    fn mobility_with_spin(mobility: Self::Mobility, spin: &Square<3>) -> Self::Mobility;
    /// Change of velocities by a row of forces.
    fn response(mobility: &Self::Mobility, row: &<Self as RigidMotion<D>>::Generalized<f64>) -> <Self as RigidMotion<D>>::Generalized<f64>;
    /// The same of a node by a force.
    fn response_of_node(mobility: &Self::Mobility, force: [f64; D]) -> [f64; D];
    /// Whether a velocity of a rigid body is free.
    fn is_free(mobility: &Self::Mobility, axis: usize) -> bool;
    /// Hands the entries of `factor` times the inverse of a rigid body's mobility over (row, column, value),
    /// of velocities that are free.
    fn inverse(mobility: &Self::Mobility, factor: f64, each: impl FnMut(usize, usize, f64));
    /// The image of a motion that a join turns, as springs in contact take it.
    fn image_rotation(turn: &Square<D>) -> Self::ImageRotation;
}

impl TangentSpace<2> for Dim<2> {
    type TangentVector<T: Plain> = [T; 1];
    type Symmetric = [f64; 3];
    type Mobility = [f64; 4];
    type Tangents = [[f64; 2]; 1];
    type FirstTangent = [f64; 0];
    type ImageRotation = [f64; 2];
    const AT: [[usize; 2]; 2] = [[0, 1], [1, 2]];
    #[inline(always)]
    fn tangent_vector<T: Plain>(mut of: impl FnMut(usize) -> T) -> [T; 1] {
        [of(0)]
    }
    #[inline(always)]
    fn vectors(mut of: impl FnMut(usize) -> [f64; 2]) -> [[f64; 2]; 1] {
        [of(0)]
    }
    /// The normal turned clockwise, along the target segment.
    #[inline(always)]
    fn tangents(normal: [f64; 2], _: &[f64; 0]) -> [[f64; 2]; 1] {
        [[normal[1], -normal[0]]]
    }
    #[inline(always)]
    fn size(&[along]: &[f64; 1]) -> f64 {
        along.abs()
    }
    #[inline(always)]
    fn within([along]: [f64; 1], limit: f64) -> [f64; 1] {
        [along.clamp(-limit, limit)]
    }
    #[inline(always)]
    fn direction(&[along]: &[f64; 1]) -> [f64; 1] {
        [along.signum()]
    }
    #[inline(always)]
    fn slide(stick: &FrictionInput<2>, slip: [f64; 1], limit: f64) -> FrictionResult<2> {
        friction::slide(stick, slip, limit)
    }
    #[inline(always)]
    fn lateral_compliance(_: &FrictionInput<2>, _: [f64; 1], _: &[f64; 1]) -> Option<([f64; 1], f64)> {
        None
    }
    #[inline(always)]
    fn tie(stick: &FrictionInput<2>, slip: [f64; 1]) -> [f64; 1] {
        friction::tie(stick, slip)
    }
    #[inline(always)]
    fn pull_back(turn: &[f64; 2], force: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = *turn;
        crate::load::join::back([[cos, -sin], [sin, cos]], force)
    }
    #[inline(always)]
    fn mobility_of_node(&[xx, xy, yy]: &[f64; 3]) -> [f64; 4] {
        [xx, xy, yy, 0.0]
    }
    fn mobility_of_body(body: &Body<2>, mean_step: f64) -> [f64; 4] {
        let [x, y, spin] = body.inverse_mass.map(|inverse| mean_step * inverse);
        [x, 0.0, y, spin]
    }
    fn mobility_with_spin([xx, xy, yy, _]: [f64; 4], spin: &Square<3>) -> [f64; 4] {
        [xx, xy, yy, spin[2][2]]
    }
    #[inline(always)]
    fn response(&[xx, xy, yy, spin]: &[f64; 4], row: &[f64; 3]) -> [f64; 3] {
        [xx * row[0] + xy * row[1], xy * row[0] + yy * row[1], spin * row[2]]
    }
    #[inline(always)]
    fn response_of_node(&[xx, xy, yy, _]: &[f64; 4], [x, y]: [f64; 2]) -> [f64; 2] {
        [xx * x + xy * y, xy * x + yy * y]
    }
    fn is_free(&[x, _, y, spin]: &[f64; 4], axis: usize) -> bool {
        [x, y, spin][axis] > 0.0
    }
    fn inverse(&[x, _, y, spin]: &[f64; 4], factor: f64, mut each: impl FnMut(usize, usize, f64)) {
        for (axis, mobility) in [x, y, spin].into_iter().enumerate().filter(|(_, mobility)| *mobility > 0.0) {
            each(axis, axis, factor / mobility);
        }
    }
    fn image_rotation(turn: &Square<2>) -> [f64; 2] {
        [turn[0][0], turn[1][0]]
    }
}

impl TangentSpace<3> for Dim<3> {
    type TangentVector<T: Plain> = [T; 2];
    type Symmetric = [f64; 6];
    /// Of what is straight and of what turns.
    type Mobility = [[f64; 6]; 2];
    type Tangents = [[f64; 3]; 2];
    /// The first; zero: any.
    type FirstTangent = [f64; 3];
    type ImageRotation = [[f64; 3]; 3];
    const AT: [[usize; 3]; 3] = SYMMETRIC;
    #[inline(always)]
    fn tangent_vector<T: Plain>(of: impl FnMut(usize) -> T) -> [T; 2] {
        std::array::from_fn(of)
    }
    #[inline(always)]
    fn vectors(of: impl FnMut(usize) -> [f64; 3]) -> [[f64; 3]; 2] {
        std::array::from_fn(of)
    }
    #[inline]
    fn tangents(normal: [f64; 3], tangent: &[f64; 3]) -> [[f64; 3]; 2] {
        let first = if *tangent == [0.0; 3] { any_tangent(normal) } else { *tangent };
        [first, cross_space(normal, first)]
    }
    #[inline(always)]
    fn size(&[a, b]: &[f64; 2]) -> f64 {
        (a * a + b * b).sqrt()
    }
    #[inline]
    fn within(along: [f64; 2], limit: f64) -> [f64; 2] {
        let size = Self::size(&along);
        if size > limit { along.map(|component| component * (limit / size)) } else { along }
    }
    #[inline]
    fn direction(along: &[f64; 2]) -> [f64; 2] {
        let size = Self::size(along);
        if size > 0.0 { along.map(|component| component / size) } else { [0.0; 2] }
    }
    #[inline]
    fn slide(stick: &FrictionInput<3>, slip: [f64; 2], limit: f64) -> FrictionResult<3> {
        cone::slide(stick, slip, limit)
    }
    fn lateral_compliance(stick: &FrictionInput<3>, slip: [f64; 2], friction: &[f64; 2]) -> Option<([f64; 2], f64)> {
        cone::lateral_compliance(stick, slip, friction)
    }
    #[inline]
    fn tie(stick: &FrictionInput<3>, slip: [f64; 2]) -> [f64; 2] {
        cone::tie(stick, slip)
    }
    #[inline(always)]
    fn pull_back(turn: &[[f64; 3]; 3], force: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|d| turn[0][d] * force[0] + turn[1][d] * force[1] + turn[2][d] * force[2])
    }
    #[inline(always)]
    fn mobility_of_node(mobility: &[f64; 6]) -> [[f64; 6]; 2] {
        [*mobility, [0.0; 6]]
    }
    fn mobility_of_body(body: &Body<3>, mean_step: f64) -> [[f64; 6]; 2] {
        let [x, y, z, ..] = body.inverse_mass.map(|inverse| mean_step * inverse);
        [[x, 0.0, 0.0, y, 0.0, z], body.turning.response.map(|inverse| mean_step * inverse)]
    }
    fn mobility_with_spin([straight, _]: [[f64; 6]; 2], spin: &Square<3>) -> [[f64; 6]; 2] {
        let mut round = [0.0; 6];
        (0..3).for_each(|i| (i..3).for_each(|j| round[Self::AT[i][j]] = spin[i][j]));
        [straight, round]
    }
    #[inline(always)]
    fn response([straight, round]: &[[f64; 6]; 2], &[x, y, z, a, b, c]: &[f64; 6]) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (times_symmetric(straight, [x, y, z]), times_symmetric(round, [a, b, c]));
        [x, y, z, a, b, c]
    }
    #[inline(always)]
    fn response_of_node([straight, _]: &[[f64; 6]; 2], force: [f64; 3]) -> [f64; 3] {
        times_symmetric(straight, force)
    }
    fn is_free(mobility: &[[f64; 6]; 2], axis: usize) -> bool {
        mobility[axis / 3][Self::AT[axis % 3][axis % 3]] > 0.0
    }
    fn inverse(mobility: &[[f64; 6]; 2], factor: f64, mut each: impl FnMut(usize, usize, f64)) {
        for (part, matrix) in mobility.iter().enumerate() {
            let gives = [0, 1, 2].map(|axis| matrix[Self::AT[axis][axis]] > 0.0);
            let inverse = rigid::space::inverse_of(matrix, gives);
            for i in (0..3).filter(|&i| gives[i]) {
                for j in (0..3).filter(|&j| gives[j]) {
                    each(3 * part + i, 3 * part + j, factor * inverse[Self::AT[i][j]]);
                }
            }
        }
    }
    /// No join turns what contacts see.
    fn image_rotation(turn: &Square<3>) -> [[f64; 3]; 3] {
        *turn
    }
}
