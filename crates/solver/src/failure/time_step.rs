//! Failure at a stable step: what is crushed or drawn out so far that it would stop the run is taken out of
//! it. An element that turns inside out fails too.

use super::CriterionKind;
use crate::quantity::{Dimension, Parameter, Range};

pub(super) const KIND: CriterionKind = CriterionKind {
    limit: Parameter::new(
        "time_step",
        "Δt_f",
        Dimension::TIME,
        Range::Positive,
        "Stable step (without `safety`) below which an element fails, also where it is inverted.",
    ),
    needs: None,
    // An element without a step (NaN) fails as well.
    fails: |seen, limit| seen.time_step_squared().0.map(|squared| !(squared >= limit * limit)),
};
