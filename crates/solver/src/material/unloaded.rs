//! A law without load across: plane stress (σ_zz = 0) and uniaxial stress (σ_yy = σ_zz = 0) around any law. The strain across is found such that the stress
//! across vanishes.
//!
//! The law is asked again and again with another Δε across (rate laws) or λ (hyperelastic laws: b = λ² across, J = det F times what the volume gains across) until
//! |σ_zz| ≤ 1e-12 of the stiffness K + 4µ/3: first with the slope of an elastic body, then with the secant. Under uniaxial stress both directions across have the
//! same strain: the law must be isotropic. What a thickness (λ) or a cross-section (λ²) has become is part of the history.
//! Source: the nested iteration of de Borst, Int. J. Numer. Meth. Engng 32 (1991) 1169-1180, with a secant for a law whose tangent is unknown.

use super::points::{PLANE, PointLaw, Points, RESPONSE};
use super::{Family, Variable};
use embate_lanes::{BATCH, Batch, Level};

/// Components yy and zz of a tensor of the plane.
const YY: usize = 1;
const ZZ: usize = 2;
/// Largest |σ_zz| over the stiffness K + 4µ/3.
const TOLERANCE: f64 = 1e-12;
/// Calls of the law; perfectly plastic points with a secant need about ten.
const CALLS: usize = 40;

/// A law without load across.
pub(super) struct Unloaded {
    law: Box<dyn PointLaw>,
    /// Whether there is none along y either.
    uniaxial: bool,
}

impl Unloaded {
    pub(super) fn plane_stress(law: Box<dyn PointLaw>) -> Self {
        Self { law, uniaxial: false }
    }

    pub(super) fn uniaxial(law: Box<dyn PointLaw>) -> Self {
        Self { law, uniaxial: true }
    }

    /// Δε across (or λ) to begin with: what an elastic law needs, to the last digits (or the last λ).
    fn guess(&self, strain: &[Batch], stress: &[Batch], ratio: &Batch) -> Batch {
        if self.law.family() == Family::Hyperelastic {
            return if self.uniaxial { Batch(ratio.0.map(f64::sqrt)) } else { *ratio };
        }
        let [bulk, shear] = self.law.stiffness();
        let (slope, lame) = (self.slope(bulk, shear), bulk - 2.0 / 3.0 * shear);
        let inside = |k: usize| if self.uniaxial { strain[0].0[k] } else { strain[0].0[k] + strain[1].0[k] };
        Batch(std::array::from_fn(|k| -(lame * inside(k) + stress[ZZ].0[k]) / slope))
    }

    /// ∂σ_zz over the unknown strain of an elastic body: K + 4µ/3, or with both strains across 2K + 2µ/3.
    fn slope(&self, bulk: f64, shear: f64) -> f64 {
        if self.uniaxial { 2.0 * bulk + 2.0 / 3.0 * shear } else { bulk + 4.0 / 3.0 * shear }
    }

    /// Thickness or cross-section over that at the start, with the unknown.
    fn ratio_new(&self, old: f64, unknown: f64) -> f64 {
        match (self.law.family(), self.uniaxial) {
            // Δε is the change of thickness over the mean thickness.
            (Family::Rate, false) => old * (1.0 + 0.5 * unknown) / (1.0 - 0.5 * unknown),
            (Family::Rate, true) => {
                let factor = (1.0 + 0.5 * unknown) / (1.0 - 0.5 * unknown);
                old * (factor * factor)
            }
            (Family::Hyperelastic, false) => unknown,
            (Family::Hyperelastic, true) => unknown * unknown,
        }
    }
}

/// One point's search.
#[derive(Clone, Copy, Default)]
struct Search {
    unknown: Batch,
    unknown_old: Batch,
    residual_old: Batch,
}

impl Search {
    /// The next unknown from the residual σ_zz; whether all eight are found.
    fn next(&mut self, law: &Unloaded, residual: &Batch, [bulk, shear]: [&Batch; 2], first: bool) -> bool {
        let mut found = true;
        for k in 0..BATCH {
            let (wave, f) = (bulk.0[k] + 4.0 / 3.0 * shear.0[k], residual.0[k]);
            if f.abs() <= TOLERANCE * wave {
                continue;
            }
            found = false;
            let elastic = law.slope(bulk.0[k], shear.0[k]);
            let (step, change) = (self.unknown.0[k] - self.unknown_old.0[k], f - self.residual_old.0[k]);
            let secant = change / step;
            // Cords in rubber are a ten-thousandth as stiff across as along.
            let slope = if !first && secant > 1e-6 * wave && secant < 4.0 * wave { secant } else { elastic };
            (self.unknown_old.0[k], self.residual_old.0[k]) = (self.unknown.0[k], f);
            self.unknown.0[k] -= f / slope;
        }
        found
    }
}

impl PointLaw for Unloaded {
    fn family(&self) -> Family {
        self.law.family()
    }
    fn state_width(&self) -> usize {
        self.law.state_width() + 1
    }
    fn needs_rotation(&self) -> bool {
        self.law.needs_rotation()
    }
    fn needs_volume(&self) -> bool {
        self.law.needs_volume()
    }
    fn variables(&self) -> &[(Variable, usize)] {
        self.law.variables()
    }
    fn stiffness(&self) -> [f64; 2] {
        self.law.stiffness()
    }
    fn stored(&self) -> f64 {
        self.law.stored()
    }
    fn energy(&self, stress: [f64; 6]) -> f64 {
        self.law.energy(stress)
    }
    fn thickness(&self) -> Option<usize> {
        Some(self.law.state_width())
    }
    fn start(&self, state: &mut [Batch]) {
        let width = self.law.state_width();
        self.law.start(&mut state[..width]);
        state[width] = Batch::splat(1.0);
    }

    fn respond(&self, level: Level, points: Points<'_>) {
        let Points { time_step, strain, rotation, volume_ratio, viscous_heat, stress, state, response, room } = points;
        let (inner, count) = (self.law.state_width(), strain.len() / PLANE);
        let width = inner + 1;
        let hyperelastic = self.law.family() == Family::Hyperelastic;
        // Strain, stress, state and ratio of the trial; then the three batches of each point's search.
        let (room, nested) = room.split(count * (2 * PLANE + inner + 1 + 3));
        let (trial_strain, rest) = room.split_at_mut(count * PLANE);
        let (trial_stress, rest) = rest.split_at_mut(count * PLANE);
        let (trial_state, rest) = rest.split_at_mut(count * inner);
        let (trial_ratio, searches) = rest.split_at_mut(count);
        for p in 0..count {
            let guess = self.guess(&strain[p * PLANE..][..PLANE], &stress[p * PLANE..][..PLANE], &state[p * width + inner]);
            searches[3 * p] = guess;
        }
        for call in 0..CALLS {
            trial_strain.copy_from_slice(strain);
            trial_stress.copy_from_slice(stress);
            for p in 0..count {
                let (unknown, thickness) = (searches[3 * p], state[p * width + inner]);
                for k in 0..BATCH {
                    let u = unknown.0[k];
                    let across = if hyperelastic { u * u } else { u };
                    trial_strain[p * PLANE + ZZ].0[k] = across;
                    if self.uniaxial {
                        trial_strain[p * PLANE + YY].0[k] = across;
                    }
                    let ratio = volume_ratio.get(p).map_or(1.0, |ratio| ratio.0[k]);
                    trial_ratio[p].0[k] = ratio * self.ratio_new(thickness.0[k], u);
                }
                trial_state[p * inner..(p + 1) * inner].copy_from_slice(&state[p * width..p * width + inner]);
            }
            self.law.respond(
                level,
                Points {
                    time_step,
                    strain: trial_strain,
                    rotation,
                    volume_ratio: trial_ratio,
                    viscous_heat,
                    stress: trial_stress,
                    state: trial_state,
                    response,
                    room: nested,
                },
            );
            let mut found = true;
            for p in 0..count {
                let mut search = Search { unknown: searches[3 * p], unknown_old: searches[3 * p + 1], residual_old: searches[3 * p + 2] };
                let out = &response[p * RESPONSE..];
                found &= search.next(self, &trial_stress[p * PLANE + ZZ], [&out[2], &out[3]], call == 0);
                [searches[3 * p], searches[3 * p + 1], searches[3 * p + 2]] = [search.unknown, search.unknown_old, search.residual_old];
            }
            if found {
                break;
            }
        }
        stress.copy_from_slice(trial_stress);
        for p in 0..count {
            state[p * width..p * width + inner].copy_from_slice(&trial_state[p * inner..(p + 1) * inner]);
            let (unknown, thickness) = (searches[3 * p], state[p * width + inner]);
            for k in 0..BATCH {
                let new = self.ratio_new(thickness.0[k], unknown.0[k]);
                state[p * width + inner].0[k] = new;
                // Energies come per volume, the block counts areas (lengths): times the thickness (cross-section) at mid-step (rate) or at the end.
                let mean = if hyperelastic { new } else { 0.5 * (thickness.0[k] + new) };
                if !hyperelastic {
                    response[p * RESPONSE].0[k] *= mean;
                }
                response[p * RESPONSE + 1].0[k] *= mean;
            }
        }
    }
}
