//! Failure at an equivalent plastic strain: the usual limit of ductile metals.

use super::CriterionKind;
use crate::material::variable::PLASTIC_STRAIN;
use crate::quantity::{Dimension, Parameter, Range};

pub(super) const KIND: CriterionKind = CriterionKind {
    limit: Parameter::new(
        "plastic_strain",
        "ε_f",
        Dimension::NONE,
        Range::Positive,
        "Equivalent plastic strain at which an element fails.",
    ),
    needs: Some(&PLASTIC_STRAIN),
    fails: |seen, limit| seen.variable(&PLASTIC_STRAIN).0.map(|strain| strain >= limit),
};
