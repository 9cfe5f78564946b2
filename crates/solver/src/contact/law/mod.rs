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

/// Every contact law.
pub const LAWS: &[ContactLawKind] = &[penalty::KIND];
