//! Flow stress over equivalent plastic strain: the contract that each kind of hardening fulfils; `j2.rs`
//! makes a law of each. To add one: a file here with its curve, a type in `j2.rs`, and its name in the line
//! of `j2` in `laws!`.

mod linear;
mod ludwik;
mod rate;
mod swift;
mod table;
mod voce;

pub use linear::Linear;
pub use ludwik::Ludwik;
pub use rate::Rate;
pub use swift::Swift;
pub use table::Table;
pub use voce::Voce;

pub(super) use ludwik::Power;
pub(super) use rate::{RATE_EXPONENT, RATE_REFERENCE};
pub(super) use table::{PLASTIC_STRAIN, STRESS};

use super::{LawKind, ParameterFault, Parameters, State};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// Initial yield stress.
pub(super) const YIELD: Parameter =
    Parameter::new("yield", "σ_y", Dimension::PRESSURE, Range::Positive, "initial yield stress").such_as("355 MPa");

/// A flow stress σ_y(ε_p), nowhere negative. Where it falls, it does so by less than 3µ per plastic strain:
/// the return has one solution then.
pub trait Hardening: Copy + Send + Sync + 'static {
    /// The law `j2` with this hardening.
    const KIND: LawKind;
    /// What a point keeps of [`Hardening::flow`] where it is: all of it, `[L; 2]`, or, where it costs next to
    /// nothing, nothing, `[L; 0]`.
    type StoredFlow<L: Lane>: StoredFlow<L>;
    /// Whether [`Flow::reach`] is ever more than 0: the return then takes the curvature with it.
    const CURVED: bool = true;

    /// Reads its parameters; `shear` is the elastic shear modulus, Pa.
    fn new(parameters: &Parameters<'_>, shear: f64) -> Self;

    /// What is wrong with its parameters beyond the range of each.
    fn faults(_parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        Vec::new()
    }

    /// How it falls: the parameter, the least slope (Pa), and the plastic strain at which nothing is left;
    /// `None` where it does not.
    fn falling(_parameters: &Parameters<'_>) -> Option<(&'static str, f64, Option<f64>)> {
        None
    }

    /// Plastic strain up to which it was measured; `None` for a formula.
    fn end(_parameters: &Parameters<'_>) -> Option<f64> {
        None
    }

    /// The flow stress at the equivalent plastic strain. `#[inline(always)]`.
    fn flow<L: Lane>(&self, plastic: L) -> Flow<L>;

    /// dσ_y/dε_p if it is the same everywhere and not negative, Pa: then the return has a closed form.
    #[inline(always)]
    fn modulus(&self) -> Option<f64> {
        None
    }
}

/// A flow stress and how it continues.
#[derive(Clone, Copy, Debug)]
pub struct Flow<L> {
    /// σ_y, Pa.
    pub stress: L,
    /// dσ_y/dε_p, Pa.
    pub slope: L,
    /// d²σ_y/dε_p², Pa.
    pub curvature: L,
    /// Plastic strain within half of which there is no kink and the curvature changes by no more than its
    /// part of this; 0: no one knows.
    pub reach: L,
}

impl<L: Lane> Flow<L> {
    /// Stress and slope a short way on in the lanes that are `live`; `before` in the others.
    #[inline(always)]
    pub(super) fn after(&self, step: L, live: L::Mask, before: [L; 2]) -> [L; 2] {
        let stress = self.stress + step * (self.slope + L::splat(0.5) * self.curvature * step);
        let slope = self.slope + self.curvature * step;
        [L::select(live, stress, before[0]), L::select(live, slope, before[1])]
    }

    /// Of a stress that falls: stress and slope zero where it would be negative, a kink that is not reported.
    #[inline(always)]
    fn not_negative(self) -> Self {
        let zero = L::splat(0.0);
        Self { stress: self.stress.max(zero), slope: L::select(zero.less(self.stress), self.slope, zero), curvature: zero, reach: zero }
    }
}

/// The flow stress and its slope at the plastic strain that a point has, kept from the step that led there: a
/// power or an exponential less in every step.
pub trait StoredFlow<L: Lane>: State<L> {
    /// Keeps them.
    fn new(flow: [L; 2]) -> Self;
    /// Gives them back.
    fn flow<H: Hardening>(&self, hardening: &H, plastic: L) -> [L; 2];
}

impl<L: Lane> StoredFlow<L> for [L; 0] {
    #[inline(always)]
    fn new(_flow: [L; 2]) -> Self {
        []
    }
    #[inline(always)]
    fn flow<H: Hardening>(&self, hardening: &H, plastic: L) -> [L; 2] {
        let Flow { stress, slope, .. } = hardening.flow(plastic);
        [stress, slope]
    }
}

impl<L: Lane> StoredFlow<L> for [L; 2] {
    #[inline(always)]
    fn new(flow: [L; 2]) -> Self {
        flow
    }
    #[inline(always)]
    fn flow<H: Hardening>(&self, _hardening: &H, _plastic: L) -> [L; 2] {
        *self
    }
}
