//! The curve of a law under uniaxial stress, as a slow or fast test of a bar shows it.

use super::points::{self, Points, RESPONSE, Scratch};
use super::{Family, bears_uniaxial_stress};
use crate::model::Material;
use embate_lanes::{Batch, Level};

/// Largest strain of a step.
const STEP: f64 = 1e-3;

/// Cauchy stress (Pa) along a bar without load across, and its cross-section over that at the start, at
/// logarithmic strains that follow each other, from rest, at a rate (1/s). `None` where there is no such law,
/// or where it is not for bars (a fluid, one with axes of its own).
///
/// Each stretch is gone in steps of at most 0.1 %. Parameters are sound.
#[must_use]
pub fn uniaxial_curve(material: &Material, strains: &[f64], rate: f64) -> Option<Vec<[f64; 2]>> {
    bears_uniaxial_stress(&material.law).filter(|bears| *bears)?;
    let law = points::uniaxial(material)?;
    let is_hyperelastic = law.family() == Family::Hyperelastic;
    let mut state = vec![Batch::default(); law.state_width()];
    law.start(&mut state);
    let (mut stress, mut response) = ([Batch::default(); points::PLANE], [Batch::default(); RESPONSE]);
    let mut scratch = Scratch::default();
    let (unturned, cold) = ([Batch::splat(1.0), Batch::splat(0.0)], [Batch::splat(0.0)]);
    let mut to = |from: f64, strain: f64| {
        let (length, step) = (strain.exp(), strain - from);
        let first = if is_hyperelastic { length * length } else { step };
        let ratio = [Batch::splat(length)];
        law.respond(
            Level::SCALAR,
            Points {
                time_step: step.abs() / rate,
                strain: &[first, 0.0, 0.0, 0.0].map(Batch::splat),
                rotation: if law.needs_rotation() { &unturned } else { &[] },
                volume_ratio: if is_hyperelastic || law.needs_volume() { &ratio } else { &[] },
                viscous_heat: if law.needs_volume() { &cold } else { &[] },
                stress: &mut stress,
                state: &mut state,
                response: &mut response,
                scratch: &mut scratch,
            },
        );
        [stress[0].0[0], law.thickness().map_or(1.0, |at| state[at].0[0])]
    };
    let (mut here, mut reached) = (0.0, [0.0, 1.0]);
    let at = |&strain: &f64| {
        let count = ((strain - here) / STEP).abs().ceil();
        let mut k = 0.0;
        let start = here;
        while k < count {
            k += 1.0;
            let next = if k < count { start + (strain - start) * (k / count) } else { strain };
            reached = to(here, next);
            here = next;
        }
        reached
    };
    Some(strains.iter().map(at).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(law: &str, values: &[(&str, f64)], lists: &[(&str, &[f64])]) -> Material {
        Material {
            law: law.into(),
            parameters: values.iter().map(|&(name, value)| (name.into(), value)).collect(),
            lists: lists.iter().map(|&(name, list)| (name.into(), list.to_vec())).collect(),
            ..Material::default()
        }
    }

    #[test]
    fn metals_follow_their_flow_curve_and_unload_elastically() {
        let elastic = [("density", 7800.0), ("young", 200e9), ("poisson", 0.3)];
        let curve = |law: &str, more: &[(&str, f64)], strains: &[f64]| {
            uniaxial_curve(&material(law, &[&elastic[..], more].concat(), &[]), strains, 1.0)
                .unwrap()
                .into_iter()
                .map(|[stress, _]| stress)
                .collect::<Vec<_>>()
        };
        let straight = curve("elastic", &[], &[1e-3, -2e-3]);
        assert!((straight[0] / 200e6 - 1.0).abs() < 1e-9 && (straight[1] / -400e6 - 1.0).abs() < 1e-9, "{straight:?}");
        // ε = σ/E + (σ − σ_y)/H, and back by E.
        let flow = curve("j2", &[("yield", 300e6), ("hardening", 2e9)], &[0.1, 0.099]);
        let expected = (0.1 + 300e6 / 2e9) / (1.0 / 200e9 + 1.0 / 2e9);
        assert!((flow[0] / expected - 1.0).abs() < 1e-9 && ((flow[0] - flow[1]) / 200e6 - 1.0).abs() < 1e-6, "{flow:?} {expected}");
    }

    #[test]
    fn rubber_is_pulled_as_its_powers_say() {
        // σ = Σ µ (λ^α − λ^(−α/2)) where the volume does not change.
        let (mu, alpha) = ([0.63e6, 0.0012e6, -0.01e6], [1.3, 5.0, -2.0]);
        let rubber = material("ogden", &[("density", 1000.0), ("bulk", 1e13)], &[("mu", &mu), ("alpha", &alpha)]);
        let strains = [0.2, 1.0, 1.8, -0.5];
        for (strain, [stress, area]) in strains.iter().zip(uniaxial_curve(&rubber, &strains, 1.0).unwrap()) {
            let term = |(mu, alpha): (f64, f64)| mu * ((alpha * strain).exp() - (-0.5 * alpha * strain).exp());
            let expected: f64 = mu.into_iter().zip(alpha).map(term).sum();
            assert!((stress / expected - 1.0).abs() < 1e-4, "{strain}: {stress} {expected}");
            assert!((area * strain.exp() - 1.0).abs() < 1e-6, "{strain}: {area}");
        }
    }

    #[test]
    fn what_is_no_material_of_bars_has_no_curve() {
        let fluid = Material { law: "null".into(), ..Material::default() };
        assert!(uniaxial_curve(&fluid, &[0.1], 1.0).is_none());
        assert!(uniaxial_curve(&Material::default(), &[0.1], 1.0).is_none());
    }
}
