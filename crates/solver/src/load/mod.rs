//! Loads and constraints: prescribed motion and symmetry, joined nodes, forces, damping, non-reflecting
//! boundaries, and the curves that they follow.
//!
//! A load's part in the velocity update is in `step/nodes.rs`. Forces are evaluated at x^n; what follows a
//! curve takes its mean over the update, from the middle of the last step to the middle of the next: so its
//! impulse is the integral of its curve, whatever the steps.

pub mod body_force;
pub mod cavity;
pub mod constraint;
pub mod curve;
pub mod damping;
pub mod force;
pub mod join;
pub(crate) mod messages;
pub mod non_reflecting;
