//! Orthotropic linear elasticity in rate form: three axes that turn with the material, in the plane of the
//! model the first two.
//!
//! In the axes of the material ε_ii = Σ_j S_ij σ_jj with S_ii = 1/E_i, S_ij = −ν_ij/E_i (ν_ij: contraction
//! along j under a pull along i, so that ν_ij/E_i = ν_ji/E_j), and σ_ij = 2 G_ij ε_ij. C = S⁻¹; positive
//! definite when |ν_ij| < √(E_i/E_j) and 1 − ν₁₂² E₂/E₁ − ν₂₃² E₃/E₂ − ν₃₁² E₁/E₃ − 2 ν₁₂ ν₂₃ ν₃₁ > 0.
//!
//! The state is the rotation R of the axes since they were x, y, z: R ← Q R with the Q that turns the stress;
//! σ ← Q σ Qᵀ + R C[Rᵀ Δε R] Rᵀ. So the stress in the axes is C times the summed strain in the axes: the law
//! stores and gives back energy exactly, for any rotation. Right for small strains; at large shear the axes
//! follow the mean rotation (Jaumann), not the fibres. Source: Lekhnitskii, Theory of Elasticity of an
//! Anisotropic Body (1963), 1.3; Jones, Mechanics of Composite Materials (1999), 2.4.
//!
//! Stiffness for the stable step: with y_i = a_i n_i, ρc² = Σ_ij C_ij y_i y_j + Σ_{i<j} G_ij (a_i² n_j² +
//! a_j² n_i² + 2 y_i y_j) is at most max(C_ii, G + |C_ij + G_ij|), G the largest G_ij, since Σ_{i≠j} a_i²
//! n_j² = 1 − Σ y_i² and Σ |y_i| ≤ 1. Reported as Voigt's bulk modulus Σ C_ij / 9 and the shear modulus that
//! completes the bound; both are those of the isotropic law where the material is isotropic. In plane stress
//! the same with Q_ij = C_ij − C_i3 C_j3 / C_33 and G₁₂ alone: max(Q₁₁, Q₂₂, G₁₂ + |Q₁₂ + G₁₂|).

use super::{DENSITY, Family, Kinematics, Law, LawKind, Orientation, ParameterFault, Parameters, Response};
use crate::angle::cos_sin;
use crate::message::{Example, Message};
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::{Solid, SymmetricTensor, Turn};
use embate_lanes::Lane;

static NOT_POSITIVE: Message = Message {
    code: "E0310",
    title: "orthotropic stiffnesses that are not positive",
    example: Example::Model(
        "[material.ply]\nlaw = \"orthotropic_elastic\"\ndensity = 1600\nyoung_1 = \"10 GPa\"\nyoung_2 = \"140 GPa\"\nyoung_3 = \"10 GPa\"\n\
         poisson_12 = 0.3\npoisson_23 = 0.02\npoisson_31 = 0.3\nshear_12 = \"5 GPa\"\nshear_23 = \"5 GPa\"\nshear_31 = \"3 GPa\"\n",
    ),
    cause: "With these ratios some strain would release energy. Often one ratio is meant the other way round: nu_ij / E_i = nu_ji / E_j.",
    remedy: "Convert the ratio (nu_ij = nu_ji E_i / E_j), or lower it.",
};

/// The law with its stiffness.
#[derive(Clone, Copy, Debug)]
pub struct OrthotropicElastic {
    /// C_ij of the normal components.
    normal: [[f64; 3]; 3],
    /// G₁₂, G₂₃, G₃₁.
    shear: [f64; 3],
    /// cos and sin of the angle from x to the first axis.
    axis: [f64; 2],
    /// Reported bulk and shear stiffness.
    reported: [f64; 2],
}

const fn young(name: &'static str, symbol: &'static str, doc: &'static str) -> Parameter {
    Parameter::new(name, symbol, Dimension::PRESSURE, Range::Positive, doc)
}
const fn poisson(name: &'static str, symbol: &'static str, doc: &'static str) -> Parameter {
    Parameter::new(name, symbol, Dimension::NONE, Range::Finite, doc)
}

/// Moduli as they are given: E₁ E₂ E₃, ν₁₂ ν₂₃ ν₃₁, G₁₂ G₂₃ G₃₁.
fn moduli(parameters: &Parameters<'_>) -> [[f64; 3]; 3] {
    let own = parameters.value("shear_12");
    let or_own = |value: f64| if value == 0.0 { own } else { value };
    [
        ["young_1", "young_2", "young_3"].map(|name| parameters.value(name)),
        ["poisson_12", "poisson_23", "poisson_31"].map(|name| parameters.value(name)),
        [own, or_own(parameters.value("shear_23")), or_own(parameters.value("shear_31"))],
    ]
}

/// det S times E₁ E₂ E₃: positive where the normal components are definite.
fn definiteness([e1, e2, e3]: [f64; 3], [p12, p23, p31]: [f64; 3]) -> f64 {
    1.0 - p12 * p12 * e2 / e1 - p23 * p23 * e3 / e2 - p31 * p31 * e1 / e3 - 2.0 * p12 * p23 * p31
}

impl Law for OrthotropicElastic {
    const KIND: LawKind = LawKind {
        name: "orthotropic_elastic",
        doc: "linear elasticity with three own axes that turn with the material, in rate form; small strains, any rotation",
        source: "Lekhnitskii, Theory of Elasticity of an Anisotropic Body (1963), 1.3",
        parameters: &[
            DENSITY,
            young("young_1", "E₁", "Young's modulus along axis 1"),
            young("young_2", "E₂", "Young's modulus along axis 2, in the plane"),
            young("young_3", "E₃", "Young's modulus along axis 3, out of the plane"),
            poisson("poisson_12", "ν₁₂", "contraction along axis 2 under a pull along axis 1"),
            poisson("poisson_23", "ν₂₃", "contraction along axis 3 under a pull along axis 2"),
            poisson("poisson_31", "ν₃₁", "contraction along axis 1 under a pull along axis 3 (ν₃₁/E₃ = ν₁₃/E₁)"),
            young("shear_12", "G₁₂", "shear modulus in the plane"),
            Parameter::new("shear_23", "G₂₃", Dimension::PRESSURE, Range::NotNegative, "shear modulus out of the plane; 0: as shear_12")
                .or(0.0),
            Parameter::new("shear_31", "G₃₁", Dimension::PRESSURE, Range::NotNegative, "shear modulus out of the plane; 0: as shear_12")
                .or(0.0),
            Parameter::new("angle", "θ", Dimension::NONE, Range::Finite, "angle from x to axis 1, counter-clockwise").angle().or(0.0),
        ],
    };
    const MESSAGES: &'static [&'static Message] = &[&NOT_POSITIVE];
    const FAMILY: Family = Family::Rate;
    type State<L: Lane, T: SymmetricTensor<L>> = Orientation<L, T>;
    const NEEDS_ROTATION: bool = true;
    const ISOTROPIC: bool = false;

    fn new(parameters: &Parameters<'_>) -> Self {
        let [young, [p12, p23, p31], shear] = moduli(parameters);
        let [e1, e2, e3] = young;
        let [p21, p32, p13] = [p12 * e2 / e1, p23 * e3 / e2, p31 * e1 / e3];
        let inverse = 1.0 / definiteness(young, [p12, p23, p31]);
        let (c12, c23, c31) = (e1 * (p21 + p31 * p23) * inverse, e2 * (p32 + p12 * p31) * inverse, e3 * (p13 + p23 * p12) * inverse);
        let normal = [
            [e1 * (1.0 - p23 * p32) * inverse, c12, c31],
            [c12, e2 * (1.0 - p31 * p13) * inverse, c23],
            [c31, c23, e3 * (1.0 - p12 * p21) * inverse],
        ];
        let largest = shear.into_iter().fold(0.0, f64::max);
        let mixed = (c12 + shear[0]).abs().max((c23 + shear[1]).abs()).max((c31 + shear[2]).abs());
        let wave = normal[0][0].max(normal[1][1]).max(normal[2][2]).max(largest + mixed);
        let bulk = normal.iter().flatten().sum::<f64>() / 9.0;
        let [cos, sin] = cos_sin(parameters.value("angle"));
        Self { normal, shear, axis: [cos, sin], reported: [bulk, 0.75 * (wave - bulk)] }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let [young, poisson, _] = moduli(parameters);
        let names = ["poisson_12", "poisson_23", "poisson_31"];
        let mut faults = Vec::new();
        for k in 0..3 {
            let limit = (young[k] / young[(k + 1) % 3]).sqrt();
            if poisson[k].abs() >= limit {
                let [i, j] = [k + 1, (k + 1) % 3 + 1];
                let message = format!(
                    "{} = {} is not within ±sqrt(young_{i} / young_{j}) = ±{limit}: some strain would release energy",
                    names[k], poisson[k]
                );
                faults.push(ParameterFault {
                    kind: &NOT_POSITIVE,
                    name: names[k],
                    message,
                    help: format!(
                        "check which way it is meant: nu_ij / E_i = nu_ji / E_j; nu_{j}{i} goes in as nu_{i}{j} = nu_{j}{i} E_{i} / E_{j}"
                    ),
                });
            }
        }
        let definite = definiteness(young, poisson);
        if faults.is_empty() && definite <= 0.0 {
            let message = format!(
                "the three ratios together make a stiffness that is not positive definite (1 - Σ nu_ij nu_ji - 2 \
                    nu_12 nu_23 nu_31 = {definite}, must be above 0)"
            );
            faults.push(ParameterFault {
                kind: &NOT_POSITIVE,
                name: names[0],
                message,
                help: "lower the ratios, or check which way each is meant: nu_ij / E_i = nu_ji / E_j".into(),
            });
        }
        faults
    }

    #[inline(always)]
    fn start<L: Lane, T: SymmetricTensor<L>>(&self) -> Orientation<L, T> {
        Orientation(T::Rotation::about_z(L::splat(self.axis[0]), L::splat(self.axis[1])))
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, state: &mut Orientation<L, T>) -> Response<L, T> {
        let zero = L::splat(0.0);
        state.0 = state.0.then(&kinematics.rotation);
        let e = kinematics.strain_increment.rotated(&state.0.inverse()).components();
        let mut change = [zero; 6];
        for i in 0..3 {
            let c = &self.normal[i];
            change[i] = e[0] * L::splat(c[0]) + e[1] * L::splat(c[1]) + e[2] * L::splat(c[2]);
            change[3 + i] = e[3 + i] * L::splat(2.0 * self.shear[i]);
        }
        let stress = kinematics.stress_rotated.plus(T::from_components(change).rotated(&state.0));
        Response::rate(stress, zero, self.reported)
    }

    fn stiffness(&self) -> [f64; 2] {
        self.reported
    }

    fn sheet_modulus(&self) -> f64 {
        let (c, shear) = (&self.normal, self.shear[0]);
        let reduced = |i: usize, j: usize| c[i][j] - c[i][2] * c[j][2] / c[2][2];
        reduced(0, 0).max(reduced(1, 1)).max(shear + (reduced(0, 1) + shear).abs())
    }

    fn energy(&self, stress: [f64; 6]) -> f64 {
        let axes = <<Solid<f64> as SymmetricTensor<f64>>::Rotation as Turn<f64>>::about_z(self.axis[0], self.axis[1]);
        let s = Solid(stress).rotated(&axes.inverse()).0;
        // S = C⁻¹ of the normal part, by its adjugate (C is symmetric); shear stands alone.
        let c = &self.normal;
        let minor = |i: usize, j: usize| {
            let ([a, b], [d, e]) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
            c[a][d] * c[b][e] - c[a][e] * c[b][d]
        };
        let determinant = c[0][0] * minor(0, 0) + c[0][1] * minor(0, 1) + c[0][2] * minor(0, 2);
        let normal: f64 = (0..9).map(|k| s[k / 3] * minor(k / 3, k % 3) * s[k % 3]).sum();
        let shear: f64 = (0..3).map(|k| s[3 + k] * s[3 + k] / self.shear[k]).sum();
        0.5 * (normal / determinant + shear)
    }
}
