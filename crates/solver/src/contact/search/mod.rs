//! Global search: which slave nodes may meet which facets. Every search returns a superset of the true pairs.
//!
//! Positions and surfaces come from the contact; candidate pairs go to the projection. One search a file, one
//! line in [`registry`]. What all promise is tested in `tests/all/search.rs` for whatever the registry holds;
//! `docs/theory.md` section 4.5 says where they come from.
//!
//! Nodes whose position is not finite meet nothing: every search but the brute force leaves them out.

mod boxes;
mod brute_force;
mod eight;
mod extent;
mod grid;
mod hull;
mod nearest_node;
mod size_class;
mod spheres;

/// A slave node that may meet a facet; both are indices into the lists of the [`Query`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pair {
    /// Index into [`Query::slaves`].
    pub slave: u32,
    /// Index into [`Query::facets`].
    pub facet: u32,
}

/// What is searched: paths of nodes from their old to their new positions (straight, in one step).
#[derive(Clone, Copy, Debug)]
pub struct Query<'a, const D: usize> {
    /// Positions of all nodes at the beginning of the step, m.
    pub positions_old: &'a [[f64; D]],
    /// Positions of all nodes at its end, m.
    pub positions_new: &'a [[f64; D]],
    /// Slave nodes: indices into the positions.
    pub slaves: &'a [u32],
    /// Facets: `D` node indices each (a segment in 2D, a triangle in 3D).
    pub facets: &'a [[u32; D]],
    /// Pairs that come nearer than this at any time of the step must be found, m.
    pub reach: f64,
}

/// A global search. Implementations may keep storage between calls, never results.
pub trait Search<const D: usize>: Send + Sync {
    /// Writes into `pairs` (cleared first, sorted by slave, then facet, each pair once) every pair that comes
    /// nearer than `reach` during the step, and perhaps others. A node is never paired with a facet that it
    /// belongs to.
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>);
    /// The same gradually: `take` gets those of some slave nodes after the other, of each all at once;
    /// `pairs` is room. What a search keeps between calls is freed at the end: it is for those that are rare.
    fn by_and_by(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>, take: &mut dyn FnMut(&[Pair])) {
        self.pairs(query, pairs);
        take(pairs);
    }
}

/// A search as the registry describes it.
#[derive(Clone, Copy)]
pub struct SearchKind<const D: usize> {
    /// Name in the model file.
    pub name: &'static str,
    /// One line: how it works and what it costs.
    pub doc: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// Makes one.
    pub make: fn() -> Box<dyn Search<D>>,
}

/// Every search; the first is the default.
#[must_use]
pub fn registry<const D: usize>() -> Vec<SearchKind<D>> {
    vec![grid::kind(), boxes::kind(), spheres::kind(), nearest_node::kind(), brute_force::kind()]
}
