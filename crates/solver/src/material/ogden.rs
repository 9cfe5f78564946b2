//! Compressible Ogden rubber, hyperelastic, from principal stretches.
//!
//! W = Σ_k (µ_k/α_k) (Σ_i λ̄_i^{α_k} − 3) + ¼K (J² − 1 − 2 ln J) per initial volume, λ̄_i = J^{-1/3} λ_i.
//! With β_i = λ̄_i^α and T_i = Σ_k µ_k β_i the principal Cauchy stresses are (T_i − Σ_j T_j / 3)/J + ½K (J −
//! 1/J), along the eigenvectors of b. Moduli at rest K and µ = ½ Σ µ_k α_k. Each µ_k α_k > 0, so that the
//! stress grows with the stretch. Sources that write W = Σ (2 µ_k/α_k²) (...) have other µ_k: µ_k here = 2
//! µ_k there / α_k. Source: Ogden, Proc. R. Soc. A 326 (1972) 565-584; volume as in `neo_hookean`.
//!
//! With x_i = α ln λ̄_i, Σ x_i = 0 and Σ (β_i − 1) = Σ (e^{x_i} − 1 − x_i): squares of small numbers near
//! rest, without cancellation.
//!
//! Stiffness for the stable step. Along L = a⊗n in principal axes, u_i = λ_i², y_i = a_i n_i, S_i = Σ_k µ_k
//! α_k β_i, means over i with a bar: J ρc² − J² U'' (a·n)² = Σ_ij D_ij y_i y_j + Σ_{i≠j} g_ij u_j a_i² n_j²
//! with the divided difference g_ij = (T_i − T_j)/(u_i − u_j), D_ii = (S_i + S̄)/3 − T_i + T̄ and D_ij = (S̄
//! − S_i − S_j)/3 + u_j g_ij − T_j + T̄ (symmetric). Since Σ_{i≠j} a_i² n_j² = 1 − Σ y_i² and Σ |y_i| ≤ 1,
//! with G = max g_ij u_j this is at most max(D_ii, G + |D_ij|).

use super::rubber::Volume;
use super::{BULK, DENSITY, Family, Kinematics, Law, LawKind, ParameterFault, Parameters, Response};
use crate::material::messages::UNSTABLE_RUBBER;
use crate::model::messages::LIST_LENGTH;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::SymmetricTensor;
use embate_lanes::{Lane, math};

/// Most terms.
const TERMS: usize = 3;

/// The law with its terms.
#[derive(Clone, Copy, Debug)]
pub struct Ogden {
    bulk: f64,
    /// µ_k, zero where there is no term.
    moduli: [f64; TERMS],
    /// α_k.
    exponents: [f64; TERMS],
}

impl Law for Ogden {
    const KIND: LawKind = LawKind {
        name: "ogden",
        doc: "rubber elasticity from powers of the principal stretches; shear modulus at rest ½ Σ µ_k α_k",
        source: "Ogden, Proc. R. Soc. A 326 (1972) 565-584",
        parameters: &[
            DENSITY.such_as("1000 kg/m^3"),
            Parameter::new("mu", "µ_k", Dimension::PRESSURE, Range::Finite, "moduli of up to three terms, each of its exponent's sign")
                .such_as("0.63 MPa")
                .list(TERMS),
            Parameter::new("alpha", "α_k", Dimension::NONE, Range::Finite, "their exponents, as many as moduli").such_as("1.3").list(TERMS),
            BULK,
        ],
    };
    const FAMILY: Family = Family::Hyperelastic;
    const CAN_BE_AVERAGED: bool = true;
    type State<L: Lane, T: SymmetricTensor<L>> = [L; 0];

    fn new(parameters: &Parameters<'_>) -> Self {
        Self { bulk: parameters.value("bulk"), moduli: parameters.array("mu", 0.0), exponents: parameters.array("alpha", 1.0) }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let (moduli, exponents) = (parameters.list("mu"), parameters.list("alpha"));
        if moduli.len() != exponents.len() {
            let message = format!("{} exponents for {} moduli", exponents.len(), moduli.len());
            return vec![ParameterFault { kind: &LIST_LENGTH, name: "alpha", message, help: "give one exponent to each modulus".into() }];
        }
        let pairs = moduli.iter().zip(exponents).enumerate();
        let wrong = pairs.filter(|(_, (mu, alpha))| *mu * *alpha <= 0.0 || alpha.abs() > 60.0);
        let fault = |(k, (mu, alpha)): (usize, (&f64, &f64))| ParameterFault {
            kind: &UNSTABLE_RUBBER,
            name: "mu",
            message: format!(
                "term {} has mu = {mu} Pa and alpha = {alpha}: their product must be above 0, else the rubber is \
                    unstable, and |alpha| at most 60",
                k + 1
            ),
            help: "give the modulus the sign of its exponent; fits with other signs need another law".into(),
        };
        wrong.map(fault).collect()
    }

    #[inline(always)]
    fn update<L: Lane, T: SymmetricTensor<L>>(&self, kinematics: &Kinematics<L, T>, _state: &mut [L; 0]) -> Response<L, T> {
        let (zero, half, third) = (L::splat(0.0), L::splat(0.5), L::splat(1.0 / 3.0));
        let j = kinematics.volume_ratio;
        let inverse = L::splat(1.0) / j;
        let logarithm = math::ln(j);
        let volume = Volume::with_logarithm(self.bulk, j, inverse, logarithm);
        let (squares, axes) = kinematics.left_cauchy_green.principal();
        // ln λ̄_i: their sum is zero. The second one follows from that: in 2D it is the small one, with the
        // fewest digits.
        let mean = logarithm * third;
        let first = math::ln(squares[0]) * half - mean;
        let last = math::ln(squares[2]) * half - mean;
        let logs = [first, -(first + last), last];
        let mut principal = Principal { squares, per_squares: inverse * inverse, stress: [zero; 3], slope: [zero; 3] };
        let mut stored = volume.stored;
        for k in 0..TERMS {
            // The same for every lane: terms that are not there cost nothing.
            if self.moduli[k] != 0.0 {
                let (modulus, exponent) = (L::splat(self.moduli[k]), L::splat(self.exponents[k]));
                let weight = L::splat(self.moduli[k] / self.exponents[k]);
                for i in 0..3 {
                    let x = exponent * logs[i];
                    let above = math::exp_above_tangent(x);
                    let stress = modulus * (above + x); // µ_k (β_i − 1)
                    principal.stress[i] += stress;
                    principal.slope[i] += exponent * (modulus + stress);
                    stored += weight * above;
                }
            }
        }
        let mean = (principal.stress[0] + principal.stress[1] + principal.stress[2]) * third;
        let mut stress = T::isotropic(volume.pressure);
        for i in 0..3 {
            stress = stress.plus(axes[i].times((principal.stress[i] - mean) * inverse));
        }
        Response { stress, stored, dissipated: zero, bulk: volume.stiffness, shear: principal.need() * inverse * L::splat(0.75) }
    }

    fn stiffness(&self) -> [f64; 2] {
        let sum: f64 = self.moduli.iter().zip(&self.exponents).map(|(mu, alpha)| mu * alpha).sum();
        [self.bulk, 0.5 * sum]
    }
}

/// What the bound of waves needs, in principal axes.
struct Principal<L> {
    /// λ_i²: a common factor of them drops out.
    squares: [L; 3],
    /// One over their product.
    per_squares: L,
    /// T_i − Σ_k µ_k: only differences count, and these have all their digits near rest.
    stress: [L; 3],
    /// S_i = dT_i / d ln λ̄_i.
    slope: [L; 3],
}

impl<L: Lane> Principal<L> {
    /// Bound of J ρc² without the volume's part.
    #[inline(always)]
    fn need(&self) -> L {
        let third = L::splat(1.0 / 3.0);
        let (u, t, s) = (&self.squares, &self.stress, &self.slope);
        let stress = (t[0] + t[1] + t[2]) * third;
        let slope = (s[0] + s[1] + s[2]) * third;
        let (mut own, mut transverse, mut mixed) = (L::splat(0.0), L::splat(0.0), L::splat(0.0));
        for i in 0..3 {
            let j = (i + 1) % 3;
            own = own.max((s[i] + slope) * third - t[i] + stress);
            // Where two values nearly meet, the mean of the slopes at both: right to the square of their
            // distance.
            let (apart, product) = (u[i] - u[j], u[i] * u[j]);
            let close = (apart * apart).less(product * L::splat(1e-8));
            // 1/u_i is the product of the other two over that of all.
            let tangent = (s[i] * u[j] + s[j] * u[i]) * (u[(i + 2) % 3] * self.per_squares) * L::splat(0.25);
            let secant = (t[i] - t[j]) / L::select(close, L::splat(1.0), apart);
            let difference = L::select(close, tangent, secant);
            transverse = transverse.max(difference * u[i].max(u[j]));
            mixed = mixed.max(((slope - s[i] - s[j]) * third + difference * u[j] - t[j] + stress).abs());
        }
        own.max(transverse + mixed)
    }
}
