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

/// Largest square of half an angle, rad², up to which its cosine and sine are short series.
const SMALL: f64 = 1.0 / 16.0;

/// cos(√u) and sin(√u)/√u of a small u: the first terms that are left out are below 1e-19.
#[inline(always)]
fn series<L: Lane>(u: L) -> [L; 2] {
    let (mut cos, mut sin) = (L::splat(0.0), L::splat(0.0));
    let one = L::splat(1.0);
    for k in (1..8).rev() {
        let twice = 2.0 * f64::from(k);
        cos = (one - cos) * (u * L::splat(1.0 / (twice * (twice - 1.0))));
        sin = (one - sin) * (u * L::splat(1.0 / (twice * (twice + 1.0))));
    }
    [one - cos, one - sin]
}

/// exp(θ) after a rotation.
#[inline(always)]
fn rotated<L: Lane>(theta: [L; 3], [s, a, b, c]: [L; 4]) -> [L; 4] {
    let half = L::splat(0.5);
    let square = dot(theta, theta);
    let quarter = L::splat(0.25) * square;
    let [mut w, part] = series(quarter);
    let mut part = half * part;
    let large = L::splat(SMALL).less(quarter);
    if L::any(large) {
        let angle = square.sqrt();
        let [cos, sin] = cos_sin_of(half * angle);
        (w, part) = (L::select(large, cos, w), L::select(large, sin / angle, part));
    }
    let [x, y, z] = times(part, theta);
    let product =
        [w * s - x * a - y * b - z * c, w * a + x * s + y * c - z * b, w * b - x * c + y * s + z * a, w * c + x * b - y * a + z * s];
    // One step of Newton towards the length 1, off which it is by roundings.
    times(L::splat(1.5) - half * dot(product, product), product)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_are_cosine_and_sine() {
        for k in 0..=200 {
            let u = SMALL * f64::from(k) / 200.0;
            let [cos, sin] = series(u);
            let x = u.sqrt();
            assert!((cos - x.cos()).abs() < 2e-16, "{u}: {cos}");
            assert!(k == 0 || (sin - x.sin() / x).abs() < 3e-16, "{u}: {sin}");
        }
    }

    #[test]
    fn a_rotation_by_a_small_and_by_a_large_angle_is_that_about_its_axis() {
        for angle in [0.0, 1e-9, 0.01, 0.499_999, 0.500_001, 1.0, 3.0] {
            let [w, x, y, z] = rotated([0.0, 0.6 * angle, -0.8 * angle], [1.0, 0.0, 0.0, 0.0]);
            let (sin, cos) = (0.5 * angle).sin_cos();
            for (own, expected) in [(w, cos), (x, 0.0), (y, 0.6 * sin), (z, -0.8 * sin)] {
                assert!((own - expected).abs() < 4e-16, "{angle}: {own} for {expected}");
            }
        }
    }
}
