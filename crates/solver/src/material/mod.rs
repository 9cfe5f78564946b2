//! Material registry.

use crate::quantity::Parameter;

/// A law as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct LawKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Parameters, density first.
    pub parameters: &'static [Parameter],
}

/// Every law.
#[must_use]
pub fn registry() -> Vec<LawKind> {
    Vec::new()
}
