//! Failure at a damage that the law sums up, such as that of Johnson and Cook: 1 is what their parameters
//! mean by fracture.

use super::CriterionKind;
use crate::material::variable::DAMAGE;
use crate::quantity::{Dimension, Parameter, Range};

pub(super) const KIND: CriterionKind = CriterionKind {
    limit: Parameter::new(
        "damage",
        "D_f",
        Dimension::NONE,
        Range::UpTo(0.0, 1.0),
        "Damage of the law at which an element fails; 1 is fracture as the law's parameters mean it.",
    ),
    needs: Some(&DAMAGE),
    fails: |seen, limit| seen.variable(&DAMAGE).0.map(|damage| damage >= limit),
};
