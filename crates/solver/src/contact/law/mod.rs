//! Contact laws: from gap to force. One law a file, one line in [`LAWS`].

pub mod penalty;

use crate::quantity::Parameter;

/// A contact law as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct ContactLawKind {
    /// Name.
    pub name: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Parameters.
    pub parameters: &'static [Parameter],
}

/// A slave node as a law sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Length of the surface that is its own, m.
    pub tributary: f64,
    /// Pressure stiffness κ of the elements behind it, Pa/m.
    pub own: f64,
    /// Pressure stiffness κ of the elements behind the target, Pa/m.
    pub other: f64,
    /// Part of the node that belongs to the model: one half on a symmetry line, where the mirror image holds the other.
    pub share: f64,
}

/// Every contact law.
pub const LAWS: &[ContactLawKind] = &[penalty::KIND];
