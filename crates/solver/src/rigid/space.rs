//! How a rigid body turns in 3D: a rotation instead of an angle, and an angular momentum that only moments
//! change.
//!
//! With L^{n−½} the angular momentum, J^n = R^n I (R^n)ᵀ the inertia (I in the frame of the body, about the
//! reference point) and T the moments about X^n:
//!
//! L^{n+½} = L^{n−½} + ½ (dt^{n−1} + dt^n) T, ω^{n∓½} = (J^n)⁻¹ L^{n∓½}, ½ L^{n+½}·ω^{n+½} − ½
//! L^{n−½}·ω^{n−½} = Δt T·½ (ω^{n−½} + ω^{n+½})
//!
//! so the ledger of the velocity update close exactly. Over the step no moment acts, and R^{n+1} = R^n cay(½
//! dt (W^n + W^{n+1})) with the body's own spins W = I⁻¹ Rᵀ L^{n+½}, which keeps L and the energy ½ W·I W
//! both to round-off (Simo and Wong, Int. J. Numer. Meth. Engng 31 (1991) 19-52): ½ L·(J^{n+1})⁻¹ L is what
//! it was. cay(θ) is the rotation about θ by 2 atan(|θ|/2); the equation is solved by repetition, which a
//! step that a body turns by little in needs few times.
//!
//! Where spins about axes in 3D are driven they are what they are; the others follow from their part of L,
//! and the turn of the step is that of ω^{n+½}. That is exact for a body that turns about one axis, or is
//! driven altogether; a body that is driven about some axes and free about others has a rotation of first
//! order in the step.

use super::Body;
use crate::angle::cos_sin;
use crate::archive::{Archive, ArchiveResult, Persist, persist_all};
use crate::energy::Sums;
use crate::tensor::{cross, dot};
use crate::vector::{SYMMETRIC, times_symmetric};

/// A rotation as a unit quaternion: w, x, y, z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude(pub [f64; 4]);

impl Default for Attitude {
    fn default() -> Self {
        Self([1.0, 0.0, 0.0, 0.0])
    }
}

impl Persist for Attitude {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.0.persist(archive)
    }
}

impl Attitude {
    /// Its matrix: the columns are where the axes of the body are.
    #[must_use]
    pub fn matrix(&self) -> [[f64; 3]; 3] {
        let [w, x, y, z] = self.0;
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    }

    /// A vector of the body as space sees it; without a turn to the last bit.
    #[must_use]
    pub fn turned(&self, v: [f64; 3]) -> [f64; 3] {
        let [w, x, y, z] = self.0;
        quaternion_turn(w, [x, y, z], v)
    }

    /// A vector in 3D as the body sees it.
    #[must_use]
    pub fn turned_back(&self, v: [f64; 3]) -> [f64; 3] {
        let [w, x, y, z] = self.0;
        quaternion_turn(w, [-x, -y, -z], v)
    }

    /// This rotation after `first`, fixed so that it stays one.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        let ([w, x, y, z], [s, a, b, c]) = (self.0, first.0);
        let product =
            [w * s - x * a - y * b - z * c, w * a + x * s + y * c - z * b, w * b - x * c + y * s + z * a, w * c + x * b - y * a + z * s];
        let size = product.iter().map(|q| q * q).sum::<f64>().sqrt();
        Self(product.map(|q| q / size))
    }

    /// cay(θ): about θ by 2 atan(|θ|/2).
    #[must_use]
    pub fn cayley(theta: [f64; 3]) -> Self {
        let half = theta.map(|t| 0.5 * t);
        let w = 1.0 / (1.0 + dot(half, half)).sqrt();
        Self([w, w * half[0], w * half[1], w * half[2]])
    }

    /// About θ by |θ|, rad.
    #[must_use]
    pub fn exponential(theta: [f64; 3]) -> Self {
        let angle = dot(theta, theta).sqrt();
        if angle == 0.0 {
            return Self::default();
        }
        let [cos, sin] = cos_sin(0.5 * angle);
        Self([cos, theta[0] / angle * sin, theta[1] / angle * sin, theta[2] / angle * sin])
    }
}

/// v + 2 w u × v + 2 u × (u × v).
fn quaternion_turn(w: f64, u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    let once = cross(u, v);
    let twice = cross(u, once);
    [0, 1, 2].map(|d| v[d] + 2.0 * (w * once[d] + twice[d]))
}

/// What a rigid body knows of its rotation in 3D.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turning {
    /// Inertia about the reference point in the frame of the body, kg m²: xx, xy, xz, yy, yz, zz (moments on
    /// the diagonal, products with their signs as in Σ m (r² I − r rᵀ)).
    pub inertia: [f64; 6],
    /// L^{n+½}, kg m²/s.
    pub momentum: [f64; 3],
    /// Without contact forces.
    pub momentum_free: [f64; 3],
    /// Change of spin per impulse of moment, of what is not driven.
    pub response: [f64; 6],
}

persist_all!(Turning { inertia, momentum, momentum_free, response });

impl Turning {
    /// Inertia of point masses (kg) at arms from the reference point (m).
    #[must_use]
    pub fn of_masses(masses: impl IntoIterator<Item = (f64, [f64; 3])>) -> Self {
        let mut inertia = [0.0; 6];
        for (m, [x, y, z]) in masses {
            let more = [y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y];
            inertia.iter_mut().zip(more).for_each(|(sum, more)| *sum += m * more);
        }
        Self { inertia, ..Self::default() }
    }
}

const AT: [[usize; 3]; 3] = SYMMETRIC;

/// Inverse of the part of a symmetric matrix that belongs to the axes `of`; zero elsewhere.
#[must_use]
pub fn inverse_of(matrix: &[f64; 6], of: [bool; 3]) -> [f64; 6] {
    // What is left out counts as the unit matrix.
    let at = |i: usize, j: usize| if of[i] && of[j] { matrix[AT[i][j]] } else { f64::from(u8::from(i == j)) };
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| at(i, j)));
    let minors = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
    let determinant = dot(rows[0], minors[0]);
    let mut inverse = [0.0; 6];
    for i in 0..3 {
        for j in i..3 {
            if of[i] && of[j] {
                inverse[AT[i][j]] = minors[i][j] / determinant;
            }
        }
    }
    inverse
}

/// Inertia as space sees it now.
fn inertia_now(body: &Body<3>) -> [f64; 6] {
    let (r, inertia) = (body.angle.matrix(), &body.turning.inertia);
    // R I, row by row; then its product with Rᵀ.
    let half = r.map(|row| times_symmetric(inertia, row));
    let mut now = [0.0; 6];
    for i in 0..3 {
        for j in i..3 {
            now[AT[i][j]] = dot(half[i], r[j]);
        }
    }
    now
}

fn spins(row: &[f64; 6]) -> [f64; 3] {
    [row[3], row[4], row[5]]
}

fn free_axes(body: &Body<3>) -> [bool; 3] {
    [3, 4, 5].map(|k: usize| body.drives[k].is_none())
}

/// Spins with the momentum `momentum`: of what is driven as in `driven`.
fn spins_of(momentum: [f64; 3], driven: [f64; 3], free: [bool; 3], inertia: &[f64; 6]) -> [f64; 3] {
    let led = [0, 1, 2].map(|k| if free[k] { 0.0 } else { driven[k] });
    let coupled = times_symmetric(inertia, led);
    let rest = [0, 1, 2].map(|k| if free[k] { momentum[k] - coupled[k] } else { 0.0 });
    let found = times_symmetric(&inverse_of(inertia, free), rest);
    [0, 1, 2].map(|k| if free[k] { found[k] } else { driven[k] })
}

pub(crate) fn start_spins(body: &mut Body<3>) {
    body.turning.momentum = times_symmetric(&inertia_now(body), spins(&body.velocity));
}

pub(crate) fn free_spins(body: &mut Body<3>, weight: &[f64; 6], mean_step: f64) {
    let (free, inertia) = (free_axes(body), inertia_now(body));
    // The same momentum, seen from where the body has turned to.
    let old = spins_of(body.turning.momentum, spins(&body.velocity), free, &inertia);
    body.velocity_old[3..].copy_from_slice(&old);
    let a = body.slowing[3];
    let mut momentum = body.turning.momentum;
    for k in 0..3 {
        let undamped = momentum[k] + mean_step * (body.internal[k + 3] + weight[k + 3] + body.load[k + 3]);
        momentum[k] = (undamped - a * momentum[k]) / (1.0 + a);
    }
    body.turning.momentum_free = momentum;
    let found = spins_of(momentum, spins(&body.velocity_free), free, &inertia);
    body.velocity_free[3..].copy_from_slice(&found);
    body.turning.response = inverse_of(&inertia, free).map(|inverse| inverse / (1.0 + a));
}

pub(crate) fn accelerate_spins(body: &mut Body<3>, weight: &[f64; 6], mean_step: f64, sums: &mut Sums) {
    let (free, a, before) = (free_axes(body), body.slowing[3], body.turning.momentum);
    let moment = spins(&body.force);
    let change = times_symmetric(&body.turning.response, moment);
    for k in 0..3 {
        body.velocity[k + 3] = body.velocity_free[k + 3] + mean_step * change[k];
        body.turning.momentum[k] = body.turning.momentum_free[k] + mean_step * moment[k] / (1.0 + a);
    }
    // What is driven takes whatever momentum it needs.
    let inertia = inertia_now(body);
    let whole = times_symmetric(&inertia, spins(&body.velocity));
    for k in (0..3).filter(|&k| !free[k]) {
        body.turning.momentum[k] = whole[k];
    }
    // In the ledger is what the free spins have without those that are driven.
    let part = |row: &[f64; 6], momentum: [f64; 3]| {
        let led = [0, 1, 2].map(|k| if free[k] { 0.0 } else { row[k + 3] });
        let coupled = times_symmetric(&inertia, led);
        [0, 1, 2].map(|k| momentum[k] - coupled[k])
    };
    let (old, new) = (part(&body.velocity_old, before), part(&body.velocity, body.turning.momentum));
    (0..3).for_each(|k| body.book(k + 3, [old[k], new[k]], weight, mean_step, sums));
}

pub(crate) fn kinetic(body: &Body<3>, first: &[f64; 6], second: &[f64; 6]) -> f64 {
    let free = free_axes(body);
    let part = |row: &[f64; 6]| [0, 1, 2].map(|k| if free[k] { row[k + 3] } else { 0.0 });
    let straight = (0..3).map(|k| 0.5 * body.mass[k] * first[k] * second[k]).sum::<f64>();
    straight + 0.5 * dot(part(first), times_symmetric(&inertia_now(body), part(second)))
}

/// Repetitions in search of the turn of a step.
const REPETITIONS: usize = 100;

/// The turn of the coming step (s), in the frame of the body at its beginning.
fn step_turn(body: &Body<3>, time_step: f64) -> Attitude {
    if !free_axes(body).iter().all(|&free| free) {
        return Attitude::exponential(body.angle.turned_back(spins(&body.velocity).map(|spin| time_step * spin)));
    }
    let inverse = inverse_of(&body.turning.inertia, [true; 3]);
    let momentum = body.angle.turned_back(body.turning.momentum);
    let begin = times_symmetric(&inverse, momentum);
    let (mut theta, mut last) = (begin.map(|spin| time_step * spin), f64::INFINITY);
    for _ in 0..REPETITIONS {
        let end = times_symmetric(&inverse, Attitude::cayley(theta).turned_back(momentum));
        let next = [0, 1, 2].map(|d| 0.5 * time_step * (begin[d] + end[d]));
        let change = (0..3).map(|d| (next[d] - theta[d]).abs()).fold(0.0, f64::max);
        theta = next;
        // Until it gets no better.
        if change == 0.0 || (change >= last && change <= 1e-13) {
            break;
        }
        last = change;
    }
    Attitude::cayley(theta)
}

pub(crate) fn turned_by(body: &Body<3>, time_step: f64) -> Attitude {
    body.angle.after(&step_turn(body, time_step))
}

/// The matrix of what the step turns, less one, by time (1/s): 2 (w [u] + [u]²) / dt with the quaternion w, u
/// as space sees it. No difference of near numbers.
pub(crate) fn chords(body: &Body<3>, time_step: f64) -> [[f64; 3]; 3] {
    let Attitude([w, x, y, z]) = step_turn(body, time_step);
    let u = body.angle.turned([x, y, z]);
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| {
        let once = cross(u, axis);
        let twice = cross(u, once);
        [0, 1, 2].map(|d| 2.0 * (w * once[d] + twice[d]) / time_step)
    });
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact_forces::ContactForces;
    use crate::load::curve::Curves;
    use crate::rigid::RigidMotion;
    use crate::rigid::{Acting, Bodies, Member};
    use crate::tensor::Dim;

    /// A lopsided body of four masses about its centre of mass, at a corner of the frame of the nodes.
    fn lopsided(spin: [f64; 3], positions: &mut Vec<[f64; 3]>) -> (Body<3>, Vec<f64>) {
        let mass = vec![1.0, 2.0, 0.5, 1.3];
        let x = [[0.0, 0.1, 0.2], [1.0, 0.3, -0.1], [0.2, 2.0, 0.4], [-0.3, 0.1, 1.5]];
        let whole: f64 = mass.iter().sum();
        let centre = [0, 1, 2].map(|d| mass.iter().zip(&x).map(|(m, x)| m * x[d]).sum::<f64>() / whole);
        let arms = x.map(|x| [0, 1, 2].map(|d| x[d] - centre[d]));
        positions.extend(x);
        let members = arms.iter().zip(0..).map(|(&arm, node)| Member { node, arm }).collect();
        let turning = Turning::of_masses(mass.iter().copied().zip(arms));
        let velocity = [0.3, -0.2, 0.1, spin[0], spin[1], spin[2]];
        let body = Body { centre, velocity, members, turning, mass: [whole, whole, whole, 0.0, 0.0, 0.0], ..Body::default() };
        (body, mass)
    }

    /// Takes `steps` steps with forces at time n on nodes; what each step does is reported.
    fn run(
        bodies: &mut Bodies<3>,
        positions: &mut [[f64; 3]],
        dt: f64,
        steps: usize,
        push: impl Fn(usize, &mut ContactForces<3>),
        mut see: impl FnMut(&Bodies<3>, &[[f64; 3]], &Sums),
    ) {
        let curves = Curves::default();
        let mut velocities = vec![[0.0; 3]; positions.len()];
        bodies.start(&curves, positions, &mut velocities);
        for step in 0..steps {
            let at = positions.to_vec();
            bodies.set_free(&Acting {
                mean_step: dt,
                from: 0.0,
                to: dt,
                curves: &curves,
                positions: &at,
                loads: &[],
                internal: |_| [0.0; 3],
                moment: &|_| None,
            });
            let mut forces = ContactForces::new(positions.len());
            push(step, &mut forces);
            let sums = bodies.accelerate([dt; 2], &forces, positions, &mut velocities);
            let led: Vec<[f64; 3]> = (0..positions.len()).map(|k| [0, 1, 2].map(|d| positions[k][d] + dt * velocities[k][d])).collect();
            bodies.advance(dt, positions);
            for (led, x) in led.iter().zip(&*positions) {
                assert!((0..3).all(|d| (led[d] - x[d]).abs() < 1e-13), "nodes go where the body has them: {led:?} {x:?}");
            }
            see(bodies, positions, &sums);
        }
    }

    #[test]
    fn a_body_that_spins_freely_keeps_its_angular_momentum_and_its_energy_while_it_tumbles() {
        for (spin, dt) in [([3.0, 0.01, -0.02], 0.05), ([0.1, 4.0, 0.1], 0.02), ([1.0, 2.0, 3.0], 0.1)] {
            let mut positions = Vec::new();
            let (body, _) = lopsided(spin, &mut positions);
            let mut bodies = Bodies::default();
            bodies.add_with_nodes(body, 4);
            let (mut begin, mut axis): (Option<([f64; 3], f64)>, [f64; 2]) = (None, [f64::INFINITY, f64::NEG_INFINITY]);
            run(
                &mut bodies,
                &mut positions,
                dt,
                2000,
                |_, _| {},
                |bodies, _, sums| {
                    let body = bodies.state(0);
                    let now = (body.turning.momentum, sums.kinetic_half);
                    let (momentum, energy) = *begin.get_or_insert(now);
                    assert!((0..3).all(|d| (now.0[d] - momentum[d]).abs() < 1e-12), "{now:?} {momentum:?}");
                    assert!((now.1 / energy - 1.0).abs() < 1e-11 && (sums.kinetic / energy - 1.0).abs() < 1e-11, "{} {energy}", now.1);
                    let w = body.velocity[4];
                    axis = [axis[0].min(w), axis[1].max(w)];
                },
            );
            assert!(axis[1] - axis[0] > 0.05 * spin[1].abs(), "it does tumble: {axis:?}");
        }
    }

    #[test]
    fn moments_change_the_angular_momentum_by_their_impulse_and_the_books_close() {
        let mut positions = Vec::new();
        let (body, mass) = lopsided([0.4, -1.0, 0.7], &mut positions);
        let mut bodies = Bodies::default();
        bodies.add_with_nodes(body, 4);
        let push = |step: usize, forces: &mut ContactForces<3>| {
            if step < 60 {
                forces.push(1, [0.3, -0.2 * (step % 7) as f64, 0.5]);
                forces.push(3, [-0.1, 0.4, 0.2]);
            }
        };
        let momentum_of = |bodies: &Bodies<3>| {
            let body = bodies.state(0);
            let straight = cross(body.centre, [0, 1, 2].map(|d| body.mass[0] * body.velocity[d]));
            [0, 1, 2].map(|d| body.turning.momentum[d] + straight[d])
        };
        let (mut places, dt) = (positions.clone(), 0.03);
        let (mut given, mut work) = ([0.0; 3], 0.0);
        let mut last: Option<(f64, [f64; 3])> = None;
        let mut step = 0;
        run(&mut bodies, &mut positions, dt, 120, push, |bodies, now, sums| {
            let body = bodies.state(0);
            let mut forces = ContactForces::new(4);
            push(step, &mut forces);
            if let Some((_, before)) = last {
                let moment = (0..4).map(|k| cross(places[k], forces.of(k))).fold([0.0; 3], |sum, m| [0, 1, 2].map(|d| sum[d] + m[d]));
                given = [0, 1, 2].map(|d| given[d] + dt * moment[d]);
                let mean = |x: [f64; 3]| body.velocity_at(x, &[0, 1, 2, 3, 4, 5].map(|k| 0.5 * (body.velocity_old[k] + body.velocity[k])));
                // Rates at x^n about X^n: the body has continued since.
                let old = [0, 1, 2].map(|d| body.centre[d] - dt * body.velocity[d]);
                work = (0..4).map(|k| dot(forces.of(k), mean([0, 1, 2].map(|d| places[k][d] - old[d] + body.centre[d])))).sum::<f64>() * dt;
                let found = momentum_of(bodies);
                assert!((0..3).all(|d| (found[d] - before[d] - given[d]).abs() < 1e-12), "{found:?} {before:?} {given:?}");
            }
            if let Some((energy, before)) = last {
                assert!((sums.kinetic_half - energy - work).abs() < 1e-12, "{} {energy} {work}", sums.kinetic_half);
                last = Some((sums.kinetic_half, before));
            } else {
                last = Some((sums.kinetic_half, momentum_of(bodies)));
            }
            (step, places) = (step + 1, now.to_vec());
        });
        assert!(mass.iter().sum::<f64>() > 0.0 && dot(given, given) > 0.1);
    }

    #[test]
    fn a_wheel_on_a_driven_axle_turns_about_it_alone() {
        let mut positions = Vec::new();
        let (mut body, _) = lopsided([0.0, 0.0, 2.0], &mut positions);
        let rest = || Some(crate::load::curve::Speed::default());
        body.drives = [rest(), rest(), rest(), rest(), rest(), None];
        (body.velocity, body.mass) = ([0.0, 0.0, 0.0, 0.0, 0.0, 2.0], [0.0; 6]);
        let (centre, inertia) = (body.centre, body.turning.inertia[5]);
        let mut bodies = Bodies::default();
        bodies.add_with_nodes(body, 4);
        let begin = positions.clone();
        let (dt, steps) = (0.01, 157);
        run(
            &mut bodies,
            &mut positions,
            dt,
            steps,
            |_, _| {},
            |bodies, _, sums| {
                let velocity = bodies.state(0).velocity;
                assert!((0..5).all(|k| velocity[k] == 0.0) && (velocity[5] - 2.0).abs() < 1e-13);
                assert!((sums.kinetic_half - 0.5 * inertia * 4.0).abs() < 1e-12);
            },
        );
        let [cos, sin] = cos_sin(2.0 * dt * steps as f64);
        for (x, x0) in positions.iter().zip(&begin) {
            let arm = [x0[0] - centre[0], x0[1] - centre[1]];
            let there = [centre[0] + cos * arm[0] - sin * arm[1], centre[1] + sin * arm[0] + cos * arm[1], x0[2]];
            assert!((0..3).all(|d| (x[d] - there[d]).abs() < 1e-12), "{x:?} {there:?}");
        }
    }

    #[test]
    fn weights_that_differ_over_a_body_have_the_moment_of_their_forces() {
        let angle = Attitude::exponential([0.3, -0.8, 0.5]);
        let parts = [([1.0, 0.2, -0.4], [0.1, 0.0, 2.0]), ([0.0, -0.7, 0.3], [1.0, -1.0, 0.2])];
        let (mut moments, mut expected) = ([[0.0; 3]; 3], [0.0; 3]);
        for (arm, force) in parts {
            Dim::<3>::add_weight(&mut moments, arm, force);
            expected = Dim::<3>::plus(expected, cross(angle.turned(arm), force));
        }
        let found = Dim::<3>::weight_moment(&moments, &angle);
        assert!((0..3).all(|d| (found[d] - expected[d]).abs() < 1e-14), "{found:?} {expected:?}");
    }
}
