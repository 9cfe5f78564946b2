//! Penalty: a spring that only pushes. F = k_n |G| where the gap G is negative, eq. (11) of the paper; energy ½ k_n G².
//!
//! Stiffness of a slave node: given (the paper's k_n), a pressure per depth times the node's tributary length, or automatic: the stiffness
//! κ = (K + 4µ/3) L / A of the elements under the surface (modulus over element height) times the tributary length, the softer of both
//! bodies; half of it in a double pass, where both passes act.

use super::{ContactLawKind, Node};
use crate::model::Penalty;
use crate::quantity::{Dimension, Parameter, Range};

/// Registry entry.
pub const KIND: ContactLawKind = ContactLawKind {
    name: "penalty",
    doc: "force proportional to the penetration; without `penalty` about as stiff as the elements under the surface",
    source: "Bittencourt and Creus (1995), eqs. (11)-(14) with the reactions corrected to F_1 = -(1-ε)F/2, F_2 = -(1+ε)F/2",
    parameters: &[
        Parameter {
            name: "penalty",
            symbol: "k_n",
            dimension: Dimension::PRESSURE,
            range: Range::Positive,
            default: None,
            doc: "stiffness per slave node and metre of depth (N/m/m), or pressure per penetration (Pa/m); left out: automatic",
        },
        Parameter {
            name: "penalty_scale",
            symbol: "s",
            dimension: Dimension::NONE,
            range: Range::Positive,
            default: Some(1.0),
            doc: "factor on the automatic stiffness",
        },
    ],
};

/// Spring stiffness of a slave node, N/m per metre of depth; `passes` 1 or 2.
#[must_use]
pub fn stiffness(penalty: Penalty, node: Node, passes: usize) -> f64 {
    match penalty {
        Penalty::PerNode(stiffness) => stiffness * node.share,
        // Tributary lengths end at the symmetry line already.
        Penalty::Pressure(pressure) => pressure * node.tributary,
        Penalty::Automatic { scale, .. } => scale * node.tributary * node.own.min(node.other) / passes as f64,
    }
}
