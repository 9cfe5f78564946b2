//! Motion of rigid bodies by dimension: generalized velocities and forces, and how rotations act
//! ([`RigidMotion`], on [`Dim`]).
//!
//! In 2D a body has three velocities (x, y, spin), in 3D six (x, y, z and the spins about them). Arrays of 2D
//! keep the order in which their entries are added, so that results in 2D do not depend on there being 3D.

use super::space::{Attitude, Turning};
use super::{Body, Drive};
use crate::archive::Plain;
use crate::energy::Sums;
use crate::tensor::{Dim, cross as cross_space};
use crate::vector::{cross, dot};
use std::fmt::Debug;
use std::ops::{Index, IndexMut};

/// What a dimension knows of the motion of rigid bodies.
pub trait RigidMotion<const D: usize>: Sized {
    /// A value for each velocity of a rigid body: x, y, spin; x, y, z and the spins about them.
    type Generalized<T: Plain>: Plain + Index<usize, Output = T> + IndexMut<usize> + AsRef<[T]>;
    /// Where a rigid body is turned to since the start: an angle, rad; a rotation.
    type Angle: Plain;
    /// A moment, or a spin: a number; a vector.
    type Spin: Plain;
    /// What a rigid body knows of its rotation beyond angle and spin: nothing; angular momentum and inertia.
    type Turning: Plain;
    /// Moments of what weighs differently on one body.
    type Moments: Plain;
    /// What prescribes each velocity of a rigid body.
    type Drives: Clone + Debug + Default + PartialEq + AsRef<[Drive]> + Send + Sync;
    /// Entries of a row.
    const FREEDOMS: usize;
    /// Nothing to add to.
    const NO_SPIN: Self::Spin;
    /// A value for each velocity.
    fn generalized<T: Plain>(of: impl FnMut(usize) -> T) -> Self::Generalized<T>;
    /// Generalized · row.
    fn dot(a: &Self::Generalized<f64>, b: &Self::Generalized<f64>) -> f64;
    /// Generalized of a force, and of its moment at the end of an `arm` (m) where it acts on a rigid body.
    fn generalized_of(force: [f64; D], arm: Option<[f64; D]>) -> Self::Generalized<f64>;
    /// The force in a row.
    fn force_of(row: &Self::Generalized<f64>) -> [f64; D];
    /// A row of a force and a moment.
    fn generalized_with(force: [f64; D], moment: Self::Spin) -> Self::Generalized<f64>;
    /// Moment of a force at the end of an arm.
    fn moment(arm: [f64; D], force: [f64; D]) -> Self::Spin;
    /// The spin in generalized velocities, rad/s, about x, y and z.
    fn spin_vector(velocity: &Self::Generalized<f64>) -> [f64; 3];
    /// A moment about x, y and z as one of the dimension.
    fn moment_of(moment: [f64; 3]) -> Self::Spin;
    /// Where a body is turned to, as an angle (2D) and as a rotation (3D).
    fn orientation(angle: &Self::Angle) -> (f64, Attitude);
    /// Adds an inertia that is the same about all axes, kg m (kg m²).
    fn add_inertia(body: &mut Body<D>, inertia: f64)
    where
        Dim<D>: RigidMotion<D>;
    /// Sum of two moments.
    fn plus(a: Self::Spin, b: Self::Spin) -> Self::Spin;
    /// A vector in the frame of a body, in the global frame.
    fn turned(angle: &Self::Angle, vector: [f64; D]) -> [f64; D];
    /// A vector in the global frame, in the frame of a body.
    fn turned_back(angle: &Self::Angle, vector: [f64; D]) -> [f64; D];
    /// Velocity of the point at the end of an arm of a rigid body.
    fn velocity_at(velocity: &Self::Generalized<f64>, arm: [f64; D]) -> [f64; D];
    /// The moment of a weight at an angle.
    fn weight_moment(moments: &Self::Moments, angle: &Self::Angle) -> Self::Spin;
    /// Adds what a member at `arm` (in the frame of the body) weighs beyond the others.
    fn add_weight(moments: &mut Self::Moments, arm: [f64; D], force: [f64; D]);
    /// Kinetic energy of a body with two velocities, without what is driven.
    fn kinetic(body: &Body<D>, first: &Self::Generalized<f64>, second: &Self::Generalized<f64>) -> f64
    where
        Dim<D>: RigidMotion<D>;
    /// Once the velocities at the start are known.
    fn start_spins(body: &mut Body<D>)
    where
        Dim<D>: RigidMotion<D>;
    /// The spins without contact forces, as those along the axes.
    fn free_spins(body: &mut Body<D>, weight: &Self::Generalized<f64>, mean_step: f64)
    where
        Dim<D>: RigidMotion<D>;
    /// The spins with them, and their part in the ledger.
    fn accelerate_spins(body: &mut Body<D>, weight: &Self::Generalized<f64>, mean_step: f64, sums: &mut Sums)
    where
        Dim<D>: RigidMotion<D>;
    /// Kinetic energy of one velocity in the ledger; `momenta`: before and after.
    fn book_mass(body: &Body<D>, k: usize, momenta: [f64; 2], sums: &mut Sums)
    where
        Dim<D>: RigidMotion<D>;
    /// Impulse of the damping of one velocity.
    fn slowed(body: &Body<D>, k: usize, momenta: [f64; 2], mean: f64) -> f64
    where
        Dim<D>: RigidMotion<D>;
    /// What the chords of a body over a step (s) have in common.
    type Chords;
    /// See [`RigidMotion::Chords`].
    fn chords(body: &Body<D>, time_step: f64) -> Self::Chords
    where
        Dim<D>: RigidMotion<D>;
    /// Velocity that leads the point at the end of an arm over the step.
    fn chord(body: &Body<D>, chords: &Self::Chords, arm: [f64; D]) -> [f64; D]
    where
        Dim<D>: RigidMotion<D>;
    /// The angle after a step, s.
    fn turned_by(body: &Body<D>, time_step: f64) -> Self::Angle
    where
        Dim<D>: RigidMotion<D>;
    /// What turning many arms by one angle has in common.
    type Places;
    /// See [`RigidMotion::Places`].
    fn places(angle: &Self::Angle) -> Self::Places;
    /// An arm of the frame of a body, turned.
    fn place(places: &Self::Places, arm: [f64; D]) -> [f64; D];
    /// Numbers that say where a rigid body is and how it moves, for hashes.
    fn numbers(body: &Body<D>) -> Vec<f64>
    where
        Dim<D>: RigidMotion<D>;
    /// What of a rigid body's mass is free to move along an axis, kg/m (kg), its velocity, and its spin times
    /// its inertia.
    fn momenta(body: &Body<D>) -> (f64, [f64; D], [f64; 3])
    where
        Dim<D>: RigidMotion<D>;
}

impl RigidMotion<2> for Dim<2> {
    type Generalized<T: Plain> = [T; 3];
    type Angle = f64;
    type Spin = f64;
    type Turning = [f64; 0];
    type Moments = [f64; 2];
    type Drives = [Drive; 3];
    const FREEDOMS: usize = 3;
    const NO_SPIN: f64 = -0.0;
    #[inline(always)]
    fn generalized<T: Plain>(of: impl FnMut(usize) -> T) -> [T; 3] {
        std::array::from_fn(of)
    }
    #[inline(always)]
    fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }
    #[inline(always)]
    fn generalized_of(force: [f64; 2], arm: Option<[f64; 2]>) -> [f64; 3] {
        [force[0], force[1], arm.map_or(0.0, |arm| cross(arm, force))]
    }
    #[inline(always)]
    fn force_of(&[x, y, _]: &[f64; 3]) -> [f64; 2] {
        [x, y]
    }
    #[inline(always)]
    fn generalized_with([x, y]: [f64; 2], moment: f64) -> [f64; 3] {
        [x, y, moment]
    }
    #[inline(always)]
    fn moment(arm: [f64; 2], force: [f64; 2]) -> f64 {
        cross(arm, force)
    }
    fn spin_vector(&[_, _, spin]: &[f64; 3]) -> [f64; 3] {
        [0.0, 0.0, spin]
    }
    fn moment_of([_, _, moment]: [f64; 3]) -> f64 {
        moment
    }
    fn orientation(&angle: &f64) -> (f64, Attitude) {
        (angle, Attitude::default())
    }
    fn add_inertia(body: &mut Body<2>, inertia: f64) {
        if body.drives[2].is_none() {
            body.mass[2] += inertia;
        }
    }
    #[inline(always)]
    fn plus(a: f64, b: f64) -> f64 {
        a + b
    }
    fn turned(&angle: &f64, vector: [f64; 2]) -> [f64; 2] {
        if angle == 0.0 { vector } else { super::turn(vector, angle) }
    }
    fn turned_back(&angle: &f64, vector: [f64; 2]) -> [f64; 2] {
        if angle == 0.0 { vector } else { super::turn(vector, -angle) }
    }
    #[inline(always)]
    fn velocity_at(&[u, v, spin]: &[f64; 3], arm: [f64; 2]) -> [f64; 2] {
        [u - spin * arm[1], v + spin * arm[0]]
    }
    fn weight_moment(moments: &[f64; 2], &angle: &f64) -> f64 {
        if *moments == [0.0; 2] { 0.0 } else { super::turn(*moments, angle)[0] }
    }
    fn add_weight(moments: &mut [f64; 2], arm: [f64; 2], force: [f64; 2]) {
        *moments = [moments[0] + cross(arm, force), moments[1] + dot(arm, force)];
    }
    fn kinetic(body: &Body<2>, first: &[f64; 3], second: &[f64; 3]) -> f64 {
        (0..3).map(|k| 0.5 * body.mass[k] * first[k] * second[k]).sum()
    }
    fn start_spins(_: &mut Body<2>) {}
    fn free_spins(body: &mut Body<2>, weight: &[f64; 3], mean_step: f64) {
        body.free_along(2, weight, mean_step);
    }
    fn accelerate_spins(body: &mut Body<2>, weight: &[f64; 3], mean_step: f64, sums: &mut Sums) {
        body.velocity[2] = body.velocity_free[2] + mean_step * body.inverse_mass[2] * body.force[2];
        body.book(2, [0.0; 2], weight, mean_step, sums);
    }
    fn book_mass(body: &Body<2>, k: usize, _: [f64; 2], sums: &mut Sums) {
        body.book_straight(k, sums);
    }
    fn slowed(body: &Body<2>, k: usize, _: [f64; 2], mean: f64) -> f64 {
        -2.0 * body.slowing[k] * body.mass[k] * mean
    }
    /// Of the arm along itself and across it.
    type Chords = [f64; 2];
    fn chords(body: &Body<2>, time_step: f64) -> [f64; 2] {
        let spin = body.velocity[2];
        let [[_, sin], [_, half]] = [time_step * spin, 0.5 * time_step * spin].map(crate::angle::cos_sin);
        [-2.0 * half * half / time_step, sin / time_step]
    }
    fn chord(body: &Body<2>, &[along, across]: &[f64; 2], arm: [f64; 2]) -> [f64; 2] {
        let [u, v, _] = body.velocity;
        [u + along * arm[0] - across * arm[1], v + along * arm[1] + across * arm[0]]
    }
    fn turned_by(body: &Body<2>, time_step: f64) -> f64 {
        body.angle + time_step * body.velocity[2]
    }
    type Places = [f64; 2];
    fn places(&angle: &f64) -> [f64; 2] {
        crate::angle::cos_sin(angle)
    }
    fn place(&[cos, sin]: &[f64; 2], [a, b]: [f64; 2]) -> [f64; 2] {
        [cos * a - sin * b, sin * a + cos * b]
    }
    fn numbers(body: &Body<2>) -> Vec<f64> {
        [body.centre[0], body.centre[1], body.angle].into_iter().chain(body.velocity).collect()
    }
    /// Of an axisymmetric body the mass along the axis.
    fn momenta(body: &Body<2>) -> (f64, [f64; 2], [f64; 3]) {
        let ([x, y, inertia], [u, v, spin]) = (body.mass, body.velocity);
        (x.max(y), [u, v], [0.0, 0.0, inertia * spin])
    }
}

impl RigidMotion<3> for Dim<3> {
    type Generalized<T: Plain> = [T; 6];
    type Angle = Attitude;
    type Spin = [f64; 3];
    type Turning = Turning;
    /// Σ r fᵀ with r in the frame of the body.
    type Moments = [[f64; 3]; 3];
    type Drives = [Drive; 6];
    const FREEDOMS: usize = 6;
    const NO_SPIN: [f64; 3] = [-0.0; 3];
    #[inline(always)]
    fn generalized<T: Plain>(of: impl FnMut(usize) -> T) -> [T; 6] {
        std::array::from_fn(of)
    }
    #[inline(always)]
    fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
    }
    #[inline(always)]
    fn generalized_of(force: [f64; 3], arm: Option<[f64; 3]>) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (force, arm.map_or([0.0; 3], |arm| cross_space(arm, force)));
        [x, y, z, a, b, c]
    }
    #[inline(always)]
    fn force_of(&[x, y, z, ..]: &[f64; 6]) -> [f64; 3] {
        [x, y, z]
    }
    #[inline(always)]
    fn generalized_with([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 6] {
        [x, y, z, a, b, c]
    }
    #[inline(always)]
    fn moment(arm: [f64; 3], force: [f64; 3]) -> [f64; 3] {
        cross_space(arm, force)
    }
    fn spin_vector(&[_, _, _, a, b, c]: &[f64; 6]) -> [f64; 3] {
        [a, b, c]
    }
    fn moment_of(moment: [f64; 3]) -> [f64; 3] {
        moment
    }
    fn orientation(&angle: &Attitude) -> (f64, Attitude) {
        (0.0, angle)
    }
    fn add_inertia(body: &mut Body<3>, inertia: f64) {
        [0, 3, 5].into_iter().for_each(|k| body.turning.inertia[k] += inertia);
    }
    #[inline(always)]
    fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    }
    fn turned(angle: &Attitude, vector: [f64; 3]) -> [f64; 3] {
        angle.turned(vector)
    }
    fn turned_back(angle: &Attitude, vector: [f64; 3]) -> [f64; 3] {
        angle.turned_back(vector)
    }
    #[inline(always)]
    fn velocity_at(&[u, v, w, a, b, c]: &[f64; 6], arm: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = cross_space([a, b, c], arm);
        [u + x, v + y, w + z]
    }
    fn weight_moment(moments: &[[f64; 3]; 3], angle: &Attitude) -> [f64; 3] {
        // Σ (R r) × f: column j of R Σ r fᵀ is Σ (R r) f_j.
        if *moments == [[0.0; 3]; 3] {
            return [0.0; 3];
        }
        let column = |j: usize| angle.turned([moments[0][j], moments[1][j], moments[2][j]]);
        let [x, y, z] = [column(0), column(1), column(2)];
        [z[1] - y[2], x[2] - z[0], y[0] - x[1]]
    }
    fn add_weight(moments: &mut [[f64; 3]; 3], arm: [f64; 3], force: [f64; 3]) {
        for (row, a) in moments.iter_mut().zip(arm) {
            for (entry, f) in row.iter_mut().zip(force) {
                *entry += a * f;
            }
        }
    }
    fn kinetic(body: &Body<3>, first: &[f64; 6], second: &[f64; 6]) -> f64 {
        super::space::kinetic(body, first, second)
    }
    fn start_spins(body: &mut Body<3>) {
        super::space::start_spins(body);
    }
    fn free_spins(body: &mut Body<3>, weight: &[f64; 6], mean_step: f64) {
        super::space::free_spins(body, weight, mean_step);
    }
    fn accelerate_spins(body: &mut Body<3>, weight: &[f64; 6], mean_step: f64, sums: &mut Sums) {
        super::space::accelerate_spins(body, weight, mean_step, sums);
    }
    fn book_mass(body: &Body<3>, k: usize, momenta: [f64; 2], sums: &mut Sums) {
        if k < 3 {
            return body.book_straight(k, sums);
        }
        sums.kinetic_half += 0.5 * momenta[1] * body.velocity[k];
        sums.kinetic += 0.5 * momenta[0] * body.velocity[k];
    }
    fn slowed(body: &Body<3>, k: usize, [old, new]: [f64; 2], _: f64) -> f64 {
        -body.slowing[k] * (old + new)
    }
    /// The matrix of what the step turns, less one, by time, 1/s.
    type Chords = [[f64; 3]; 3];
    fn chords(body: &Body<3>, time_step: f64) -> [[f64; 3]; 3] {
        super::space::chords(body, time_step)
    }
    fn chord(body: &Body<3>, chords: &[[f64; 3]; 3], arm: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|d| body.velocity[d] + dot(chords[d], arm))
    }
    fn turned_by(body: &Body<3>, time_step: f64) -> Attitude {
        super::space::turned_by(body, time_step)
    }
    type Places = [[f64; 3]; 3];
    fn places(angle: &Attitude) -> [[f64; 3]; 3] {
        angle.matrix()
    }
    fn place(matrix: &[[f64; 3]; 3], arm: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| dot(row, arm))
    }
    fn numbers(body: &Body<3>) -> Vec<f64> {
        body.centre.into_iter().chain(body.angle.0).chain(body.velocity).collect()
    }
    fn momenta(body: &Body<3>) -> (f64, [f64; 3], [f64; 3]) {
        let [u, v, w, ..] = body.velocity;
        (body.mass[..3].iter().copied().fold(0.0, f64::max), [u, v, w], body.turning.momentum)
    }
}
