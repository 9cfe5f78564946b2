//! Element registry.

/// An element as the registry describes it.
#[derive(Clone, Copy, Debug)]
pub struct ElementKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: what it is and when to take it.
    pub doc: &'static str,
    /// Where its equations come from.
    pub source: &'static str,
    /// Nodes per element.
    pub nodes: usize,
}

/// Every element.
#[must_use]
pub fn registry() -> Vec<ElementKind> {
    Vec::new()
}
