//! A law without load across: plane stress (σ_zz = 0), uniaxial stress (σ_yy = σ_zz = 0) and the layers of
//! shells (in 2D σ_yy = 0, y across the layer; in 3D σ_zz = 0) around any law. The strain across is found
//! such that the stress across vanishes.
//!
//! The law is asked again and again with another Δε across (rate laws) or λ (hyperelastic laws: b = λ²
//! across, J = det F times what the volume gains across) until the stress |σ_zz| is at most 1e-12 of the
//! stiffness K + 4µ/3: first with the slope of an elastic body, then with the secant. Under uniaxial stress
//! both directions across have the same strain: the law must be isotropic. What a thickness (λ) or a
//! cross-section (λ²) has become is part of the history. Source: the nested iteration of de Borst, Int. J.
//! Numer. Meth. Engng 32 (1991) 1169-1180, with a secant for a law whose tangent is unknown.
//!
//! Nothing is searched for where the law knows its layers or fibres by itself ([`super::Law::layer`],
//! [`super::Law::fibre`]).

use super::points::{PLANE, PointLaw, Points, RESPONSE, SOLID};
use super::{Family, History};
use embate_lanes::{BATCH, Batch, Level};

/// Components xx, yy, zz and xy of a tensor in 2D; yz and zx in 3D.
const XX: usize = 0;
const XY: usize = 3;
const YY: usize = 1;
const ZZ: usize = 2;
const YZ: usize = 4;
const ZX: usize = 5;
/// Largest |σ_zz| over the stiffness K + 4µ/3.
const TOLERANCE: f64 = 1e-12;
/// Calls of the law; perfectly plastic points with a secant need about ten.
const CALLS: usize = 80;
/// Calls until the search no longer relies on slopes alone.
const PATIENCE: usize = 12;

/// A law without load across.
pub(super) struct StressConstrained {
    law: Box<dyn PointLaw>,
    /// Components without stress, which all have the same strain; the first decides.
    across: &'static [usize],
    /// Components of its tensors.
    components: usize,
    /// Of hyperelastic laws: whether b across is what shear makes of it and λ², not λ² alone.
    is_sheared: bool,
}

impl StressConstrained {
    pub(super) fn plane_stress(law: Box<dyn PointLaw>) -> Self {
        Self { law, across: &[ZZ], components: PLANE, is_sheared: false }
    }

    pub(super) fn uniaxial(law: Box<dyn PointLaw>) -> Self {
        Self { law, across: &[ZZ, YY], components: PLANE, is_sheared: false }
    }

    /// Of a layer of a shell, y across it. Its fibres do not stretch for nothing: with F = [λ 0; γ μ] the
    /// energy is at its minimum over μ, which is σ_yy − σ_xy γ/λ = 0 (hyperelastic laws; the b that comes in
    /// has λ², γ² and λ γ). In rate form σ_yy = 0.
    pub(super) fn layer(law: Box<dyn PointLaw>) -> Self {
        Self { law, across: &[YY], components: PLANE, is_sheared: true }
    }

    /// The same in 3D, z across it: with F = [F̂ 0; γ μ] the energy is at its minimum where σ_zz − w·(σ_zx,
    /// σ_zy) = 0, w = (F̂ F̂ᵀ)⁻¹ F̂ γ.
    pub(super) fn layer_in_3d(law: Box<dyn PointLaw>) -> Self {
        Self { law, across: &[ZZ], components: SOLID, is_sheared: true }
    }

    fn uniaxial_stress(&self) -> bool {
        self.across.len() > 1
    }

    /// Whether nothing has to be searched for. Plane stress is a layer without shear across.
    fn knows_itself(&self) -> bool {
        if self.uniaxial_stress() { self.law.has_fibre() } else { self.law.has_layer() }
    }

    /// Δε across (or λ) to begin with: what an elastic law needs, to the last digits (or the last λ).
    fn guess(&self, strain: &[Batch], stress: &[Batch], ratio: &Batch) -> Batch {
        if self.law.family() == Family::Hyperelastic {
            return if self.uniaxial_stress() { Batch(ratio.0.map(f64::sqrt)) } else { *ratio };
        }
        let [bulk, shear] = self.law.stiffness();
        let (slope, lame) = (self.slope(bulk, shear), bulk - 2.0 / 3.0 * shear);
        let inside = |k: usize| match self.across {
            [ZZ] => strain[0].0[k] + strain[YY].0[k],
            [YY] => strain[0].0[k] + strain[ZZ].0[k],
            _ => strain[0].0[k],
        };
        Batch(std::array::from_fn(|k| -(lame * inside(k) + stress[self.across[0]].0[k]) / slope))
    }

    /// What the transverse shear stress has of the stress across of a hyperelastic layer, from stress and b.
    fn pulled_along(&self, stress: impl Fn(usize) -> f64, b: impl Fn(usize) -> f64) -> f64 {
        if self.components == PLANE {
            return stress(XY) * (b(XY) / b(XX));
        }
        let determinant = b(XX) * b(YY) - b(XY) * b(XY);
        let along = [(b(YY) * b(ZX) - b(XY) * b(YZ)) / determinant, (b(XX) * b(YZ) - b(XY) * b(ZX)) / determinant];
        stress(ZX) * along[0] + stress(YZ) * along[1]
    }

    /// ∂σ_zz over the unknown strain of an elastic body: K + 4µ/3, or with both strains across 2K + 2µ/3.
    fn slope(&self, bulk: f64, shear: f64) -> f64 {
        if self.uniaxial_stress() { 2.0 * bulk + 2.0 / 3.0 * shear } else { bulk + 4.0 / 3.0 * shear }
    }

    /// The next unknowns of a point's eight searches; whether all are found.
    fn improve(&self, searches: &mut [Batch], residual: &Batch, [bulk, shear]: [&Batch; 2], call: usize) -> bool {
        let mut found = true;
        for k in 0..BATCH {
            let (wave, f) = (bulk.0[k] + 4.0 / 3.0 * shear.0[k], residual.0[k]);
            if f.abs() <= TOLERANCE * wave {
                continue;
            }
            found = false;
            let mut search = Search::load(searches, k);
            let scale = if self.law.family() == Family::Hyperelastic { search.unknown } else { 1.0 };
            search.next(f, [wave, self.slope(bulk.0[k], shear.0[k])], scale, call);
            search.store(searches, k);
        }
        found
    }

    /// Thickness or cross-section over that at the start, with the unknown.
    fn ratio_new(&self, old: f64, unknown: f64) -> f64 {
        match (self.law.family(), self.uniaxial_stress()) {
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

/// One point's search: unknowns between `low` and `high`, where σ_zz is negative and positive.
#[derive(Clone, Copy)]
struct Search {
    unknown: f64,
    unknown_old: f64,
    residual_old: f64,
    low: f64,
    high: f64,
}

impl Search {
    /// Batches of a search.
    const WIDTH: usize = 5;

    /// Around the first guess. An increment of two would turn a body inside out, and a ratio is positive.
    fn begin(batches: &mut [Batch], guess: Batch, family: Family) {
        let [low, high] = if family == Family::Hyperelastic { [0.0, f64::INFINITY] } else { [-1.9, 1.9] };
        batches.copy_from_slice(&[guess, Batch::default(), Batch::default(), Batch::splat(low), Batch::splat(high)]);
    }

    fn load(batches: &[Batch], k: usize) -> Self {
        let [unknown, unknown_old, residual_old, low, high] = std::array::from_fn(|i| batches[i].0[k]);
        Self { unknown, unknown_old, residual_old, low, high }
    }

    fn store(self, batches: &mut [Batch], k: usize) {
        for (batch, value) in batches.iter_mut().zip([self.unknown, self.unknown_old, self.residual_old, self.low, self.high]) {
            batch.0[k] = value;
        }
    }

    /// The next unknown after the residual f = σ_zz at this one, with the stiffnesses there. `scale` is the
    /// unknown's change by unit of logarithmic strain.
    ///
    /// The secant where it is one of a stable law, else the elastic slope; half way between what is too
    /// little and what is too much where that leaves the bracket, and from [`PATIENCE`] on at every other
    /// call: σ_zz grows with the strain across, so the answer is always between both.
    fn next(&mut self, f: f64, [wave, elastic]: [f64; 2], scale: f64, call: usize) {
        let secant = scale * (f - self.residual_old) / (self.unknown - self.unknown_old);
        // Cords in rubber are a ten-thousandth as stiff across as along.
        let slope = if call > 0 && secant > 1e-6 * wave && secant < 4.0 * wave { secant } else { elastic };
        if f > 0.0 {
            self.high = self.unknown;
        } else {
            self.low = self.unknown;
        }
        (self.unknown_old, self.residual_old) = (self.unknown, f);
        let next = self.unknown - scale * (f / slope);
        let slow = call >= PATIENCE && call.is_multiple_of(2);
        let high = self.high.min(4.0 * self.unknown.abs().max(1.0));
        self.unknown = if self.low < next && next < self.high && !slow { next } else { 0.5 * (self.low + high) };
    }
}

impl PointLaw for StressConstrained {
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
    fn variables(&self) -> &[History] {
        self.law.variables()
    }
    fn stiffness(&self) -> [f64; 2] {
        self.law.stiffness()
    }
    fn is_stiffest_at_rest(&self) -> bool {
        self.law.is_stiffest_at_rest()
    }
    fn least_sheet_modulus(&self) -> f64 {
        self.law.least_sheet_modulus()
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
    fn ratios(&self) -> [Option<usize>; 2] {
        [self.thickness(), self.law.thickness()]
    }
    fn start(&self, state: &mut [Batch]) {
        let width = self.law.state_width();
        self.law.start(&mut state[..width]);
        state[width] = Batch::splat(1.0);
    }

    fn has_constant_stiffness(&self) -> bool {
        // What knows its layers or fibres has that of its elastic body.
        self.is_stiffest_at_rest() && self.knows_itself()
    }

    fn respond(&self, level: Level, points: Points<'_>) {
        if !self.knows_itself() {
            self.search(level, points);
        } else if self.uniaxial_stress() {
            self.law.respond_fibre(level, points);
        } else {
            self.law.respond_layer(level, self.across[0], points);
        }
    }
}

impl StressConstrained {
    /// Searches for the strain across.
    fn search(&self, level: Level, points: Points<'_>) {
        let Points { time_step, strain, rotation, volume_ratio, viscous_heat, stress, state, response, scratch } = points;
        let components = self.components;
        let (inner, count) = (self.law.state_width(), strain.len() / components);
        let width = inner + 1;
        let hyperelastic = self.law.family() == Family::Hyperelastic;
        // Strain, stress, state and ratio of the trial; then each point's search.
        let (scratch, nested) = scratch.split(count * (2 * components + inner + 1 + Search::WIDTH));
        let (trial_strain, rest) = scratch.split_at_mut(count * components);
        let (trial_stress, rest) = rest.split_at_mut(count * components);
        let (trial_state, rest) = rest.split_at_mut(count * inner);
        let (trial_ratio, searches) = rest.split_at_mut(count);
        for p in 0..count {
            let guess =
                self.guess(&strain[p * components..][..components], &stress[p * components..][..components], &state[p * width + inner]);
            Search::begin(&mut searches[p * Search::WIDTH..][..Search::WIDTH], guess, self.law.family());
        }
        for call in 0..CALLS {
            trial_strain.copy_from_slice(strain);
            trial_stress.copy_from_slice(stress);
            for p in 0..count {
                let (unknown, thickness) = (searches[p * Search::WIDTH], state[p * width + inner]);
                for k in 0..BATCH {
                    let u = unknown.0[k];
                    let across = if hyperelastic { u * u } else { u };
                    for &component in self.across {
                        let own = &mut trial_strain[p * components + component].0[k];
                        *own = if hyperelastic && self.is_sheared { *own + across } else { across };
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
                    scratch: nested,
                },
            );
            let mut found = true;
            for p in 0..count {
                let out = &response[p * RESPONSE..];
                let (trial, given) = (&trial_stress[p * components..][..components], &strain[p * components..][..components]);
                let mut across = trial[self.across[0]];
                if hyperelastic && self.is_sheared {
                    for k in 0..BATCH {
                        across.0[k] += -self.pulled_along(|c| trial[c].0[k], |c| given[c].0[k]);
                    }
                }
                let search = &mut searches[p * Search::WIDTH..][..Search::WIDTH];
                found &= self.improve(search, &across, [&out[2], &out[3]], call);
            }
            if found {
                break;
            }
        }
        stress.copy_from_slice(trial_stress);
        for p in 0..count {
            state[p * width..p * width + inner].copy_from_slice(&trial_state[p * inner..(p + 1) * inner]);
            let (unknown, thickness) = (searches[p * Search::WIDTH], state[p * width + inner]);
            for k in 0..BATCH {
                let new = self.ratio_new(thickness.0[k], unknown.0[k]);
                state[p * width + inner].0[k] = new;
                // Energies come per volume, the block counts areas (lengths): times the thickness
                // (cross-section) at mid-step (rate) or at the end.
                let mean = if hyperelastic { new } else { 0.5 * (thickness.0[k] + new) };
                if !hyperelastic {
                    response[p * RESPONSE].0[k] *= mean;
                }
                response[p * RESPONSE + 1].0[k] *= mean;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::points::{Scratch, of};
    use crate::material::young_and_poisson;
    use crate::model::Material;
    use crate::stress_state::rubber_sheet_modulus;

    /// A number between -1 and 1.
    fn random(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / 2f64.powi(52) - 1.0
    }

    /// Goes the same way with the stress of a layer that the law knows and with that which is searched for.
    fn compare(material: &Material, law: &StressConstrained, seed: u64) {
        let (components, width) = (law.components, law.state_width());
        let mut numbers = seed;
        let mut start = vec![Batch::default(); width];
        law.start(&mut start);
        let mut states = [start.clone(), start];
        let mut stresses = [vec![Batch::default(); components], vec![Batch::default(); components]];
        for step in 0..200 {
            let size = if step % 7 == 0 { 0.05 } else { 0.002 };
            let mut strain: Vec<Batch> = (0..components).map(|_| Batch(std::array::from_fn(|_| size * random(&mut numbers)))).collect();
            law.across.iter().for_each(|&across| strain[across] = Batch::default());
            // Some without shear.
            (0..BATCH / 2).for_each(|lane| strain[XY].0[lane] = if law.uniaxial_stress() { 0.0 } else { strain[XY].0[lane] });
            let mut responses = [vec![Batch::default(); RESPONSE], vec![Batch::default(); RESPONSE]];
            for (which, response) in responses.iter_mut().enumerate() {
                let points = Points {
                    time_step: 1.0,
                    strain: &strain,
                    rotation: &[],
                    volume_ratio: &[],
                    viscous_heat: &[],
                    stress: &mut stresses[which],
                    state: &mut states[which],
                    response,
                    scratch: &mut Scratch::default(),
                };
                if which == 0 { law.respond(Level::best(), points) } else { law.search(Level::best(), points) }
            }
            let near = |a: &[Batch], b: &[Batch], tolerance: f64| {
                a.iter().zip(b).all(|(a, b)| a.0.iter().zip(b.0).all(|(a, b)| (a - b).abs() <= tolerance))
            };
            assert!(near(&stresses[0], &stresses[1], 1e-8), "{} {step}: {stresses:?}", material.law);
            // Plastic strain and thickness; the stored slope is extrapolated in one of them.
            for place in [0, width - 1] {
                assert!(near(&states[0][place..=place], &states[1][place..=place], 1e-9), "{} {step}: {states:?}", material.law);
            }
            assert!(near(&responses[0], &responses[1], 1e-8), "{} {step}: {responses:?}", material.law);
        }
        // Fibres are strained along one axis alone, and half of them are not sheared.
        let least = if law.uniaxial_stress() { 0.4 } else { 0.5 };
        assert!(width == 1 || states[0][0].0.iter().all(|plastic| *plastic > least), "{}: {states:?}", material.law);
    }

    #[test]
    fn a_layer_that_the_law_knows_is_that_which_is_searched_for() {
        let number = |material: &mut Material, name: &str, value: f64| {
            material.parameters.insert(name.into(), value);
        };
        for (law, more) in [
            ("elastic", &[][..]),
            ("j2", &[("yield", 3.0), ("hardening", 20.0)][..]),
            ("j2", &[("yield", 3.0), ("hardening", 0.0)]),
            ("j2", &[("yield", 3.0), ("hardening", -2.0)]),
            ("j2_voce", &[("yield", 3.0), ("hardening", 1.0), ("saturation", 5.0), ("saturation_rate", 8.0)]),
        ] {
            let mut material = Material { law: law.into(), ..Material::default() };
            [("density", 1.0), ("young", 1000.0), ("poisson", 0.3)]
                .iter()
                .chain(more)
                .for_each(|(name, value)| number(&mut material, name, *value));
            compare(&material, &StressConstrained::layer_in_3d(of::<3>(&material).unwrap()), 5);
            compare(&material, &StressConstrained::layer(of::<2>(&material).unwrap()), 7);
            compare(&material, &StressConstrained::plane_stress(of::<2>(&material).unwrap()), 11);
            compare(&material, &StressConstrained::uniaxial(of::<2>(&material).unwrap()), 9);
        }
    }

    /// Energy per initial volume, K, µ, and the thickness ratio of sheets with those gradients [xx, xy, yx,
    /// yy].
    fn sheet(law: &StressConstrained, gradients: &[[f64; 4]; BATCH]) -> [[f64; 4]; BATCH] {
        let batch = |of: &dyn Fn([f64; 4]) -> f64| Batch(gradients.map(of));
        let strain = [
            batch(&|[a, b, ..]| a * a + b * b),
            batch(&|[.., c, d]| c * c + d * d),
            Batch::default(),
            batch(&|[a, b, c, d]| a * c + b * d),
        ];
        let mut state = vec![Batch::default(); law.state_width()];
        law.start(&mut state);
        let mut response = [Batch::default(); RESPONSE];
        let points = Points {
            time_step: 1.0,
            strain: &strain,
            rotation: &[],
            volume_ratio: &[batch(&|[a, b, c, d]| a * d - b * c)],
            viscous_heat: &[],
            stress: &mut [Batch::default(); PLANE],
            state: &mut state,
            response: &mut response,
            scratch: &mut Scratch::default(),
        };
        law.respond(Level::SCALAR, points);
        std::array::from_fn(|k| [response[0].0[k], response[2].0[k], response[3].0[k], state[law.state_width() - 1].0[k]])
    }

    #[test]
    fn no_wave_in_a_stretched_sheet_of_rubber_is_faster_than_its_stiffnesses_say() {
        let rubber = |law: &str, numbers: &[(&str, f64)], lists: &[(&str, &[f64])]| Material {
            law: law.into(),
            parameters: [("density", 1.0)].iter().chain(numbers).map(|&(name, value)| (name.into(), value)).collect(),
            lists: lists.iter().map(|&(name, list)| (name.into(), list.to_vec())).collect(),
            ..Material::default()
        };
        let mut numbers = 3;
        for bulk in [0.5, 2.0, 30.0, 3000.0] {
            let young_and_poisson = young_and_poisson([bulk, 1.0]);
            for material in [
                rubber("neo_hookean", &[("young", young_and_poisson[0]), ("poisson", young_and_poisson[1])], &[]),
                rubber("mooney_rivlin", &[("c10", 0.3), ("c01", 0.2), ("bulk", bulk)], &[]),
                rubber("mooney_rivlin", &[("c10", 0.01), ("c01", 0.49), ("bulk", bulk)], &[]),
                rubber("yeoh", &[("c10", 0.5), ("c20", -0.05), ("c30", 0.02), ("bulk", bulk)], &[]),
                rubber("arruda_boyce", &[("shear", 1.0), ("locking_stretch", 2.5), ("bulk", bulk)], &[]),
                rubber("ogden", &[("bulk", bulk)], &[("mu", &[0.8, 0.01, -0.05]), ("alpha", &[1.3, 6.0, -3.0])]),
                rubber("yeoh", &[("c10", 0.05), ("c30", 0.2), ("bulk", bulk)], &[]),
                rubber("ogden", &[("bulk", bulk)], &[("mu", &[0.25]), ("alpha", &[8.0])]),
                rubber("ogden", &[("bulk", bulk)], &[("mu", &[-0.25]), ("alpha", &[-8.0])]),
                rubber("ogden", &[("bulk", bulk)], &[("mu", &[4.0]), ("alpha", &[0.5])]),
            ] {
                let law = StressConstrained::plane_stress(of::<2>(&material).unwrap());
                let (mut worst, mut at_rest) = (0.0f64, 0.0f64);
                for round in 0..400 {
                    let mut turned = |size: f64| {
                        let (s, c) = (3.0 * random(&mut numbers)).sin_cos();
                        let [a, b] = [random(&mut numbers), random(&mut numbers)].map(|x| (size * x).exp());
                        [c * c * a + s * s * b, s * c * (a - b), s * c * (a - b), s * s * a + c * c * b]
                    };
                    let f = turned(if round == 0 { 0.0 } else { 0.9 });
                    // W of (1 + t a nᵀ) F for unit vectors a and n: its curvature is J ρc².
                    let rays: [[f64; 2]; BATCH] =
                        std::array::from_fn(|k| if k == 0 { [0.3; 2] } else { [3.0 * random(&mut numbers), 3.0 * random(&mut numbers)] });
                    let moved = |t: f64| {
                        rays.map(|[a, n]| {
                            let m = [f[0] * n.cos() + f[2] * n.sin(), f[1] * n.cos() + f[3] * n.sin()];
                            [f[0] + t * a.cos() * m[0], f[1] + t * a.cos() * m[1], f[2] + t * a.sin() * m[0], f[3] + t * a.sin() * m[1]]
                        })
                    };
                    const T: f64 = 2e-3;
                    let [before, now, after] = [-T, 0.0, T].map(|t| sheet(&law, &moved(t)));
                    for k in 0..BATCH {
                        let [_, bulk, shear, thickness] = now[k];
                        let curvature = (before[k][0] - 2.0 * now[k][0] + after[k][0]) / (T * T);
                        let wave = curvature / ((f[0] * f[3] - f[1] * f[2]) * thickness);
                        let ratio = wave / rubber_sheet_modulus(bulk, shear);
                        worst = worst.max(ratio);
                        at_rest = at_rest.max(if round == 0 { ratio } else { 0.0 });
                    }
                }
                println!("{:<14} K = {bulk}: {worst:.4} of the bound at most, {at_rest:.4} at rest", material.law);
                assert!(worst < 1.0 + 1e-4 && at_rest > 0.74, "{} {bulk}: {worst} {at_rest}", material.law);
            }
        }
    }
}
