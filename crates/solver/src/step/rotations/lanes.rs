//! Eight nodes at a time: spins that nothing holds, as velocities in `free.rs`, and rotations.

use super::NodalRotations;
use crate::angle::cos_sin_of;
use crate::energy::Sums;
use crate::load::damping::Damping;
use crate::rigid::space::Attitude;
use crate::step::free::{LaneSums, Pulled, eight};
use crate::vector::{dot, times};
use embate_lanes::{BATCH, Batch, Kernel, Lane};

/// New spins of the eights that are free.
pub(super) struct Accelerate<'a> {
    pub(super) rotations: &'a NodalRotations,
    /// Δt, s.
    pub(super) dt: f64,
    pub(super) damping: &'a Damping,
    pub(super) spins: &'a mut [[f64; 3]],
}

impl Kernel for Accelerate<'_> {
    type Output = Sums;

    #[inline(always)]
    fn run<L: Lane>(self) -> Sums {
        let Self { rotations, dt, damping, spins } = self;
        let NodalRotations { now, inertia, spins_old, slots, assembly, now_loads, contact, free, .. } = rotations;
        let mut sums = LaneSums::default();
        for (group, own) in spins.as_chunks_mut::<BATCH>().0.iter_mut().enumerate() {
            if !free[group] {
                continue;
            }
            let first = group * BATCH;
            let moments = assembly.forces(group, slots);
            let mut slowing = Batch::default();
            if damping.acts() {
                for lane in 0..BATCH {
                    slowing.0[lane] = damping.factor(now.nodes[first + lane] as usize);
                }
            }
            for at in (0..BATCH).step_by(L::WIDTH) {
                let pulled = Pulled {
                    mass: L::load(&eight(inertia, first), at),
                    old: L::load_points(spins_old, first + at),
                    internal: L::load_points(&moments, at),
                    contact: if contact.is_empty() { None } else { Some(L::load_points(contact, first + at)) },
                    load: if now_loads.is_empty() { None } else { Some(L::load_points(now_loads, first + at)) },
                    gravity: None,
                    slowing: if damping.acts() { Some(L::load(&slowing, at)) } else { None },
                };
                L::store_points(pulled.advance(L::splat(dt), &mut sums, at), own, at);
            }
        }
        sums.total()
    }
}

/// Rotations after a step with the spins ω: exp(dt ω) R, as unit quaternions.
pub(super) struct Rotate<'a> {
    pub(super) attitudes: &'a [Attitude],
    pub(super) spins: &'a [[f64; 3]],
    pub(super) time_step: f64,
    pub(super) next: &'a mut [[f64; 4]],
}

impl Kernel for Rotate<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Self { attitudes, spins, time_step, next } = self;
        let dt = L::splat(time_step);
        for ((attitudes, spins), next) in attitudes.chunks(BATCH).zip(spins.chunks(BATCH)).zip(next.chunks_mut(BATCH)) {
            let (mut old, mut spin) = ([[0.0; 4]; BATCH], [[0.0; 3]; BATCH]);
            for lane in 0..attitudes.len() {
                (old[lane], spin[lane]) = (attitudes[lane].0, spins[lane]);
            }
            let mut new = [[0.0; 4]; BATCH];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let theta = times(dt, L::load_points(&spin, at));
                L::store_points(rotated(theta, L::load_points(&old, at)), &mut new, at);
            }
            next.copy_from_slice(&new[..next.len()]);
        }
    }
}

/// exp(θ) after a rotation.
#[inline(always)]
fn rotated<L: Lane>(theta: [L; 3], [s, a, b, c]: [L; 4]) -> [L; 4] {
    let (zero, half) = (L::splat(0.0), L::splat(0.5));
    let angle = dot(theta, theta).sqrt();
    let [w, sin] = cos_sin_of(half * angle);
    let part = L::select(zero.less(angle), sin / angle, half);
    let [x, y, z] = times(part, theta);
    let product =
        [w * s - x * a - y * b - z * c, w * a + x * s + y * c - z * b, w * b - x * c + y * s + z * a, w * c + x * b - y * a + z * s];
    // One step of Newton towards the length 1, off which it is by roundings.
    times(L::splat(1.5) - half * dot(product, product), product)
}
