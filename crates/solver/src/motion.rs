//! What a dimension knows of motion: how many velocities a body has, what lies along a surface, and how rotations act ([`Motion`], on [`Dim`]).
//!
//! Springs in contact ([`crate::contact::springs`]) and rigid bodies ([`crate::rigid`]) are written once against it. In the plane a row of velocities has three entries
//! (x, y, spin) and a surface one tangent; in space six (x, y, z and three spins) and two tangents, which a spring carries with it. Arrays of the plane keep the order in which
//! their entries were always added, so its results do not depend on there being a space.

use crate::archive::Keep;
use crate::contact::springs::friction::{self, Slid, Stick, cone};
use crate::energy::Sums;
use crate::mesh::surface::tributary::Tributary;
use crate::rigid::space::{Attitude, Turning};
use crate::rigid::{self, Body};
use crate::tensor::{Dim, cross as cross_space};
use crate::vector::{cross, dot};
use std::fmt::Debug;
use std::ops::{Index, IndexMut};

/// A value that is copied, compared and kept.
pub trait Cell: Copy + Debug + Default + PartialEq + Keep + Send + Sync + 'static {}
impl<T: Copy + Debug + Default + PartialEq + Keep + Send + Sync + 'static> Cell for T {}

/// What a dimension knows of motion.
pub trait Motion<const D: usize>: Tributary<D> {
    /// A value for each direction along a surface: D − 1.
    type Along<T: Cell>: Cell + Index<usize, Output = T> + IndexMut<usize>;
    /// A value for each velocity of a rigid body: x, y, spin; x, y, z and the spins about them.
    type Row<T: Cell>: Cell + Index<usize, Output = T> + IndexMut<usize> + AsRef<[T]>;
    /// A symmetric D × D matrix, its upper triangle row by row: xx, xy, yy; xx, xy, xz, yy, yz, zz.
    type Symmetric: Cell + Index<usize, Output = f64> + IndexMut<usize>;
    /// Change of a row of velocities per row of force.
    type Mobility: Cell;
    /// A vector for each direction along a surface.
    type Tangents: Cell + Index<usize, Output = [f64; D]> + IndexMut<usize>;
    /// First tangent of a spring where the normal does not say it.
    type Tangent: Cell;
    /// Rotation from the motion of a node to that of its image: cosine and sine; a matrix.
    type Turn: Cell;
    /// Where a rigid body is turned to since the start: an angle, rad; a rotation.
    type Angle: Cell;
    /// A moment, or a spin: a number; a vector.
    type Spin: Cell;
    /// What a rigid body knows of its rotation beyond angle and spin: nothing; angular momentum and inertia.
    type Turning: Cell;
    /// Moments of what weighs differently on one body.
    type Moments: Cell;
    /// What prescribes each velocity of a rigid body.
    type Drives: Clone + Debug + Default + PartialEq + AsRef<[rigid::Drive]> + Send + Sync;

    /// Entries of a row.
    const ROW: usize;
    /// Where the entry i, j of a symmetric matrix is.
    const AT: [[usize; D]; D];
    /// Nothing to add to.
    const NO_SPIN: Self::Spin;

    /// A value for each direction along a surface.
    fn along<T: Cell>(of: impl FnMut(usize) -> T) -> Self::Along<T>;
    /// A vector for each direction along a surface.
    fn vectors(of: impl FnMut(usize) -> [f64; D]) -> Self::Tangents;
    /// A value for each velocity.
    fn row<T: Cell>(of: impl FnMut(usize) -> T) -> Self::Row<T>;
    /// The directions along a surface with the unit normal `normal`: orthonormal to it and to each other.
    fn tangents(normal: [f64; D], tangent: &Self::Tangent) -> Self::Tangents;
    /// Length of what lies along a surface.
    fn size(along: &Self::Along<f64>) -> f64;
    /// The nearest to it that is no longer than `limit`.
    fn within(along: Self::Along<f64>, limit: f64) -> Self::Along<f64>;
    /// The direction of it: of no length any.
    fn direction(along: &Self::Along<f64>) -> Self::Along<f64>;
    /// Friction that a spring wants; see [`friction`].
    fn slide(stick: &Stick<D>, slip: Self::Along<f64>, limit: f64) -> Slid<D>
    where
        Dim<D>: Motion<D>;
    /// A direction along the surface in which friction that slides still follows the slip, and the change of its rate per force (beside the compliance); see [`cone`].
    fn gives_aside(stick: &Stick<D>, slip: Self::Along<f64>, friction: &Self::Along<f64>) -> Option<(Self::Along<f64>, f64)>
    where
        Dim<D>: Motion<D>;
    /// Force of a tie along the surface.
    fn tie(stick: &Stick<D>, slip: Self::Along<f64>) -> Self::Along<f64>
    where
        Dim<D>: Motion<D>;
    /// Row · row.
    fn dot(a: &Self::Row<f64>, b: &Self::Row<f64>) -> f64;
    /// Row of a force, and of its moment at the end of an `arm` (m) where it acts on a rigid body.
    fn row_of(force: [f64; D], arm: Option<[f64; D]>) -> Self::Row<f64>;
    /// A force on an image as its leader feels it.
    fn back(turn: &Self::Turn, force: [f64; D]) -> [f64; D];
    /// Of a node.
    fn mobility_of_node(mobility: &Self::Symmetric) -> Self::Mobility;
    /// Of a rigid body over a step, s.
    fn mobility_of_body(body: &Body<D>, mean_step: f64) -> Self::Mobility
    where
        Dim<D>: Motion<D>;
    /// Change of velocities by a row of forces.
    fn response(mobility: &Self::Mobility, row: &Self::Row<f64>) -> Self::Row<f64>;
    /// The same of a node by a force.
    fn response_of_node(mobility: &Self::Mobility, force: [f64; D]) -> [f64; D];
    /// The force in a row.
    fn force_of(row: &Self::Row<f64>) -> [f64; D];
    /// Whether a velocity of a rigid body gives way.
    fn gives(mobility: &Self::Mobility, axis: usize) -> bool;
    /// Hands the entries of `factor` times the inverse of a rigid body's mobility over (row, column, value), of what gives way.
    fn inverse(mobility: &Self::Mobility, factor: f64, each: impl FnMut(usize, usize, f64));
    /// A row of a force and a moment.
    fn row_with(force: [f64; D], moment: Self::Spin) -> Self::Row<f64>;
    /// Moment of a force at the end of an arm.
    fn moment(arm: [f64; D], force: [f64; D]) -> Self::Spin;
    /// Sum of two moments.
    fn plus(a: Self::Spin, b: Self::Spin) -> Self::Spin;

    /// A vector of a body as space sees it.
    fn turned(angle: &Self::Angle, vector: [f64; D]) -> [f64; D];
    /// A vector of space as a body sees it.
    fn turned_back(angle: &Self::Angle, vector: [f64; D]) -> [f64; D];
    /// Velocity of the point at the end of an arm of a rigid body.
    fn velocity_at(velocity: &Self::Row<f64>, arm: [f64; D]) -> [f64; D];
    /// The moment of a weight at an angle.
    fn weight_moment(moments: &Self::Moments, angle: &Self::Angle) -> Self::Spin;
    /// Adds what a member at `arm` (in the frame of the body) weighs beyond the others.
    fn add_weight(moments: &mut Self::Moments, arm: [f64; D], force: [f64; D]);
    /// Kinetic energy of a body with two velocities, without what is driven.
    fn kinetic(body: &Body<D>, first: &Self::Row<f64>, second: &Self::Row<f64>) -> f64
    where
        Dim<D>: Motion<D>;
    /// Once the velocities at the start are known.
    fn start_spins(body: &mut Body<D>)
    where
        Dim<D>: Motion<D>;
    /// The spins without contact forces, as those along the axes.
    fn free_spins(body: &mut Body<D>, weight: &Self::Row<f64>, mean_step: f64)
    where
        Dim<D>: Motion<D>;
    /// The spins with them, and their part in the books.
    fn accelerate_spins(body: &mut Body<D>, weight: &Self::Row<f64>, mean_step: f64, sums: &mut Sums)
    where
        Dim<D>: Motion<D>;
    /// Kinetic energy of one velocity in the books; `momenta`: before and after.
    fn book_mass(body: &Body<D>, k: usize, momenta: [f64; 2], sums: &mut Sums)
    where
        Dim<D>: Motion<D>;
    /// Impulse of the damping of one velocity.
    fn slowed(body: &Body<D>, k: usize, momenta: [f64; 2], mean: f64) -> f64
    where
        Dim<D>: Motion<D>;
    /// What the chords of a body over a step (s) have in common.
    type Chords;
    /// See [`Motion::Chords`].
    fn chords(body: &Body<D>, time_step: f64) -> Self::Chords
    where
        Dim<D>: Motion<D>;
    /// Velocity that leads the point at the end of an arm over the step.
    fn chord(body: &Body<D>, chords: &Self::Chords, arm: [f64; D]) -> [f64; D]
    where
        Dim<D>: Motion<D>;
    /// The angle after a step, s.
    fn turned_by(body: &Body<D>, time_step: f64) -> Self::Angle
    where
        Dim<D>: Motion<D>;
    /// What turning many arms by one angle has in common.
    type Places;
    /// See [`Motion::Places`].
    fn places(angle: &Self::Angle) -> Self::Places;
    /// An arm of the frame of a body, turned.
    fn place(places: &Self::Places, arm: [f64; D]) -> [f64; D];
}

impl Motion<2> for Dim<2> {
    type Along<T: Cell> = [T; 1];
    type Row<T: Cell> = [T; 3];
    type Symmetric = [f64; 3];
    type Mobility = [f64; 4];
    type Tangents = [[f64; 2]; 1];
    type Tangent = [f64; 0];
    type Turn = [f64; 2];
    type Angle = f64;
    type Spin = f64;
    type Turning = [f64; 0];
    type Moments = [f64; 2];
    type Drives = [rigid::Drive; 3];

    const ROW: usize = 3;
    const AT: [[usize; 2]; 2] = [[0, 1], [1, 2]];
    const NO_SPIN: f64 = -0.0;

    #[inline(always)]
    fn along<T: Cell>(mut of: impl FnMut(usize) -> T) -> [T; 1] {
        [of(0)]
    }
    #[inline(always)]
    fn vectors(mut of: impl FnMut(usize) -> [f64; 2]) -> [[f64; 2]; 1] {
        [of(0)]
    }
    #[inline(always)]
    fn row<T: Cell>(of: impl FnMut(usize) -> T) -> [T; 3] {
        std::array::from_fn(of)
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
    fn slide(stick: &Stick<2>, slip: [f64; 1], limit: f64) -> Slid<2> {
        friction::slide(stick, slip, limit)
    }
    #[inline(always)]
    fn gives_aside(_: &Stick<2>, _: [f64; 1], _: &[f64; 1]) -> Option<([f64; 1], f64)> {
        None
    }
    #[inline(always)]
    fn tie(stick: &Stick<2>, slip: [f64; 1]) -> [f64; 1] {
        friction::tie(stick, slip)
    }
    #[inline(always)]
    fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }
    #[inline(always)]
    fn row_of(force: [f64; 2], arm: Option<[f64; 2]>) -> [f64; 3] {
        [force[0], force[1], arm.map_or(0.0, |arm| cross(arm, force))]
    }
    #[inline(always)]
    fn back(turn: &[f64; 2], force: [f64; 2]) -> [f64; 2] {
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
    #[inline(always)]
    fn response(&[xx, xy, yy, spin]: &[f64; 4], row: &[f64; 3]) -> [f64; 3] {
        [xx * row[0] + xy * row[1], xy * row[0] + yy * row[1], spin * row[2]]
    }
    #[inline(always)]
    fn response_of_node(&[xx, xy, yy, _]: &[f64; 4], [x, y]: [f64; 2]) -> [f64; 2] {
        [xx * x + xy * y, xy * x + yy * y]
    }
    #[inline(always)]
    fn force_of(&[x, y, _]: &[f64; 3]) -> [f64; 2] {
        [x, y]
    }
    fn gives(&[x, _, y, spin]: &[f64; 4], axis: usize) -> bool {
        [x, y, spin][axis] > 0.0
    }
    fn inverse(&[x, _, y, spin]: &[f64; 4], factor: f64, mut each: impl FnMut(usize, usize, f64)) {
        for (axis, mobility) in [x, y, spin].into_iter().enumerate().filter(|(_, mobility)| *mobility > 0.0) {
            each(axis, axis, factor / mobility);
        }
    }
    #[inline(always)]
    fn row_with([x, y]: [f64; 2], moment: f64) -> [f64; 3] {
        [x, y, moment]
    }
    #[inline(always)]
    fn moment(arm: [f64; 2], force: [f64; 2]) -> f64 {
        cross(arm, force)
    }
    #[inline(always)]
    fn plus(a: f64, b: f64) -> f64 {
        a + b
    }
    fn turned(&angle: &f64, vector: [f64; 2]) -> [f64; 2] {
        if angle == 0.0 { vector } else { rigid::turn(vector, angle) }
    }
    fn turned_back(&angle: &f64, vector: [f64; 2]) -> [f64; 2] {
        if angle == 0.0 { vector } else { rigid::turn(vector, -angle) }
    }
    #[inline(always)]
    fn velocity_at(&[u, v, spin]: &[f64; 3], arm: [f64; 2]) -> [f64; 2] {
        [u - spin * arm[1], v + spin * arm[0]]
    }
    fn weight_moment(moments: &[f64; 2], &angle: &f64) -> f64 {
        if *moments == [0.0; 2] { 0.0 } else { rigid::turn(*moments, angle)[0] }
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
}

/// A symmetric matrix (its upper triangle row by row) times a vector.
#[inline(always)]
pub(crate) fn times_symmetric(&[xx, xy, xz, yy, yz, zz]: &[f64; 6], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
}

/// A unit vector at right angles to a unit vector.
#[must_use]
pub fn any_tangent(normal: [f64; 3]) -> [f64; 3] {
    // The axis that is farthest from it.
    let [x, y, z] = normal.map(f64::abs);
    let axis = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let across = cross_space(normal, axis);
    let length = dot(across, across).sqrt();
    if length > 0.0 { across.map(|c| c / length) } else { [0.0; 3] }
}

impl Motion<3> for Dim<3> {
    type Along<T: Cell> = [T; 2];
    type Row<T: Cell> = [T; 6];
    type Symmetric = [f64; 6];
    /// Of what is straight and of what turns.
    type Mobility = [[f64; 6]; 2];
    type Tangents = [[f64; 3]; 2];
    /// The first; zero: any.
    type Tangent = [f64; 3];
    type Turn = [[f64; 3]; 3];
    type Angle = Attitude;
    type Spin = [f64; 3];
    type Turning = Turning;
    /// Σ r fᵀ with r in the frame of the body.
    type Moments = [[f64; 3]; 3];
    type Drives = [rigid::Drive; 6];

    const ROW: usize = 6;
    const AT: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
    const NO_SPIN: [f64; 3] = [-0.0; 3];

    #[inline(always)]
    fn along<T: Cell>(of: impl FnMut(usize) -> T) -> [T; 2] {
        std::array::from_fn(of)
    }
    #[inline(always)]
    fn vectors(of: impl FnMut(usize) -> [f64; 3]) -> [[f64; 3]; 2] {
        std::array::from_fn(of)
    }
    #[inline(always)]
    fn row<T: Cell>(of: impl FnMut(usize) -> T) -> [T; 6] {
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
    fn slide(stick: &Stick<3>, slip: [f64; 2], limit: f64) -> Slid<3> {
        cone::slide(stick, slip, limit)
    }
    fn gives_aside(stick: &Stick<3>, slip: [f64; 2], friction: &[f64; 2]) -> Option<([f64; 2], f64)> {
        cone::gives_aside(stick, slip, friction)
    }
    #[inline]
    fn tie(stick: &Stick<3>, slip: [f64; 2]) -> [f64; 2] {
        cone::tie(stick, slip)
    }
    #[inline(always)]
    fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
    }
    #[inline(always)]
    fn row_of(force: [f64; 3], arm: Option<[f64; 3]>) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (force, arm.map_or([0.0; 3], |arm| cross_space(arm, force)));
        [x, y, z, a, b, c]
    }
    #[inline(always)]
    fn back(turn: &[[f64; 3]; 3], force: [f64; 3]) -> [f64; 3] {
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
    #[inline(always)]
    fn response([straight, round]: &[[f64; 6]; 2], &[x, y, z, a, b, c]: &[f64; 6]) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (times_symmetric(straight, [x, y, z]), times_symmetric(round, [a, b, c]));
        [x, y, z, a, b, c]
    }
    #[inline(always)]
    fn response_of_node([straight, _]: &[[f64; 6]; 2], force: [f64; 3]) -> [f64; 3] {
        times_symmetric(straight, force)
    }
    #[inline(always)]
    fn force_of(&[x, y, z, ..]: &[f64; 6]) -> [f64; 3] {
        [x, y, z]
    }
    fn gives(mobility: &[[f64; 6]; 2], axis: usize) -> bool {
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
    #[inline(always)]
    fn row_with([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 6] {
        [x, y, z, a, b, c]
    }
    #[inline(always)]
    fn moment(arm: [f64; 3], force: [f64; 3]) -> [f64; 3] {
        cross_space(arm, force)
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
        rigid::space::kinetic(body, first, second)
    }
    fn start_spins(body: &mut Body<3>) {
        rigid::space::start_spins(body);
    }
    fn free_spins(body: &mut Body<3>, weight: &[f64; 6], mean_step: f64) {
        rigid::space::free_spins(body, weight, mean_step);
    }
    fn accelerate_spins(body: &mut Body<3>, weight: &[f64; 6], mean_step: f64, sums: &mut Sums) {
        rigid::space::accelerate_spins(body, weight, mean_step, sums);
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
        rigid::space::chords(body, time_step)
    }
    fn chord(body: &Body<3>, chords: &[[f64; 3]; 3], arm: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|d| body.velocity[d] + dot(chords[d], arm))
    }
    fn turned_by(body: &Body<3>, time_step: f64) -> Attitude {
        rigid::space::turned_by(body, time_step)
    }
    type Places = [[f64; 3]; 3];
    fn places(angle: &Attitude) -> [[f64; 3]; 3] {
        angle.matrix()
    }
    fn place(matrix: &[[f64; 3]; 3], arm: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| dot(row, arm))
    }
}
