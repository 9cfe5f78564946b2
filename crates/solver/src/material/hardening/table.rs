//! A measured curve: points (ε_p, σ_y), straight lines between them, the last stress after the last point.
//!
//! The first point is at ε_p = 0. Stresses may fall, by less than the return can bear (`softening.rs`); all
//! are positive, so something is always left.

use super::super::{DENSITY, LawKind, POISSON, ParameterFault, Parameters, YOUNG};
use super::{Flow, Hardening, RATE_EXPONENT, RATE_REFERENCE};
use crate::model::messages::{LIST_LENGTH, LIST_ORDER};
use crate::quantity::{Dimension, Parameter, Range};
use embate_lanes::Lane;

/// Most points of a curve.
const POINTS: usize = 16;

/// Plastic strains of the points.
pub(crate) const PLASTIC_STRAIN: Parameter = Parameter::new(
    "plastic_strain",
    "ε_p",
    Dimension::NONE,
    Range::NotNegative,
    "equivalent plastic strains of the curve's points (logarithmic), ascending from 0",
)
.such_as("0")
.list(POINTS);
/// Stresses of the points.
pub(crate) const STRESS: Parameter = Parameter::new(
    "stress",
    "σ_y",
    Dimension::PRESSURE,
    Range::Positive,
    "true flow stresses of the points, as many as plastic strains; the last one holds from there on",
)
.such_as("355 MPa")
.list(POINTS);

/// Start, stress and slope of every line; lines that are not there start at infinity.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    strains: [f64; POINTS],
    stresses: [f64; POINTS],
    slopes: [f64; POINTS],
    points: usize,
}

impl Hardening for Table {
    const KIND: LawKind = LawKind {
        name: "j2_table",
        doc: "elasto-plasticity after von Mises with a measured flow curve",
        source: "Simo and Hughes, Computational Inelasticity (1998), box 3.1, with a flow stress of straight lines",
        parameters: &[DENSITY, YOUNG, POISSON, PLASTIC_STRAIN, STRESS, RATE_REFERENCE, RATE_EXPONENT],
    };

    type StoredFlow<L: Lane> = [L; 2];

    fn new(parameters: &Parameters<'_>, _shear: f64) -> Self {
        let strains: [f64; POINTS] = parameters.array("plastic_strain", f64::INFINITY);
        let stresses: [f64; POINTS] = parameters.array("stress", 0.0);
        let slope = |i: usize| (stresses[i + 1] - stresses[i]) / (strains[i + 1] - strains[i]);
        let slopes = std::array::from_fn(|i| if i + 1 < POINTS && strains[i + 1].is_finite() { slope(i) } else { 0.0 });
        Self { strains, stresses, slopes, points: parameters.list("plastic_strain").len() }
    }

    fn faults(parameters: &Parameters<'_>) -> Vec<ParameterFault> {
        let (strains, stresses) = (parameters.list("plastic_strain"), parameters.list("stress"));
        let fault = |kind, name, message: String, help: &str| vec![ParameterFault { kind, name, message, help: help.into() }];
        if strains.len() != stresses.len() {
            let message = format!("there are {} stresses for {} plastic strains", stresses.len(), strains.len());
            return fault(&LIST_LENGTH, "stress", message, "give one stress for every plastic strain");
        }
        if strains.first().is_some_and(|&first| first != 0.0) {
            return fault(
                &LIST_ORDER,
                "plastic_strain",
                format!("the curve starts at {}", strains[0]),
                "give the initial yield stress at a plastic strain of 0",
            );
        }
        if let Some(at) = (1..strains.len()).find(|&i| strains[i] <= strains[i - 1]) {
            let message = format!("{} comes after {}", strains[at], strains[at - 1]);
            return fault(&LIST_ORDER, "plastic_strain", message, "sort the points by their plastic strain, each once");
        }
        Vec::new()
    }

    fn end(parameters: &Parameters<'_>) -> Option<f64> {
        parameters.list("plastic_strain").last().copied()
    }

    fn falling(parameters: &Parameters<'_>) -> Option<(&'static str, f64, Option<f64>)> {
        let steepest = Self::new(parameters, 0.0).steepest();
        (steepest < 0.0).then_some(("stress", steepest, None))
    }

    #[inline(always)]
    fn flow<L: Lane>(&self, plastic: L) -> Flow<L> {
        let (mut strain, mut stress, mut slope) = (L::splat(0.0), L::splat(self.stresses[0]), L::splat(self.slopes[0]));
        let mut end = L::splat(self.strains[1]);
        for i in 1..self.points.min(POINTS) {
            let start = L::splat(self.strains[i]);
            let past = start.less(plastic);
            strain = L::select(past, start, strain);
            stress = L::select(past, L::splat(self.stresses[i]), stress);
            slope = L::select(past, L::splat(self.slopes[i]), slope);
            end = L::select(past, L::splat(if i + 1 < POINTS { self.strains[i + 1] } else { f64::INFINITY }), end);
        }
        // To the nearer end of the line.
        let reach = (end - plastic).min(plastic - strain);
        Flow { stress: stress + slope * (plastic - strain), slope, curvature: L::splat(0.0), reach }
    }
}

impl Table {
    /// Least slope of a line, Pa; zero after the last point.
    pub(crate) fn steepest(&self) -> f64 {
        self.slopes.iter().fold(0.0, |least, &slope| slope.min(least))
    }
}
