//! Ties of nodes: each slave node near the target is bound to a place on a segment or facet.
//!
//! The springs' rows are those of ordinary contact at the node's present foot. One surface is slave (the
//! first one, unless the formulation is `single_pass` with another): binding the nodes of both would hold
//! more than there is to hold.

use super::{Hold, PendingTies, Tie};
use crate::archive::{Archive, ArchiveResult, Persist, Plain, persist_each};
use crate::contact::formulation::Surfaces;
use crate::contact::segment::ByNodes;
use crate::contact::springs::Spring;
use crate::mesh::surface::Corners;
use crate::tensor::Dim;

/// A slave near a facet.
pub(in crate::contact) struct Bond<P> {
    /// Index in the slave surface.
    pub(in crate::contact) slave: u32,
    pub(in crate::contact) facet: u32,
    pub(in crate::contact) place: P,
    /// Distance, m.
    pub(in crate::contact) gap: f64,
}

/// A node at a place on a facet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::contact) struct NodeHold<P> {
    pub(in crate::contact) node: u32,
    /// Index in the slave surface.
    pub(in crate::contact) slave: u32,
    /// Index in the target.
    pub(in crate::contact) facet: u32,
    /// Where on it at the start.
    pub(in crate::contact) place: P,
}

impl<P: Persist> Persist for NodeHold<P> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { node, slave, facet, place } = self;
        persist_each!(archive; node, slave, facet, place);
        Ok(())
    }
}

impl<P: Plain> Hold for NodeHold<P> {
    fn unit(&self) -> [u32; 2] {
        [self.slave; 2]
    }

    fn node(&self) -> Option<u32> {
        Some(self.node)
    }
}

/// The ties of these bonds of `slaves`.
pub(in crate::contact) fn ties<P, const D: usize>(bonds: Vec<Bond<P>>, slaves: &[u32], pending: &PendingTies<D>) -> Vec<Tie<NodeHold<P>>> {
    let input = &pending.input;
    let tie = |Bond { slave, facet, place, gap }| {
        let (node, of) = (slaves[slave as usize], slave as usize);
        Tie { hold: NodeHold { node, slave, facet, place }, gap, stiffness: input.stiffness_at(of, facet), area: input.slaves[of].area }
    };
    bonds.into_iter().map(tie).collect()
}

/// Nodes of the target near the facets of the slave of which all nodes are bound; `near` those facets, by the
/// index among `targets`.
pub(in crate::contact) fn beneath<P, Q, F: Corners>(
    near: Vec<Bond<Q>>,
    targets: &[u32],
    facets: &[F],
    ties: &[Tie<NodeHold<P>>],
) -> Vec<u32> {
    // Ascending as the slaves are.
    let is_bound = |node: &u32| ties.binary_search_by_key(node, |tie| tie.hold.node).is_ok();
    let is_on = |bond: &Bond<Q>| facets[bond.facet as usize].corners().iter().all(is_bound);
    near.into_iter().filter(is_on).map(|bond| targets[bond.slave as usize]).collect()
}

/// The bound nodes, and those of the facets to which they are bound.
pub(in crate::contact) fn sides<P, F: Corners>(ties: &[Tie<NodeHold<P>>], facets: &[F]) -> [Vec<u32>; 2] {
    let targets = ties.iter().flat_map(|tie| facets[tie.hold.facet as usize].corners()).copied();
    [ties.iter().map(|tie| tie.hold.node).collect(), targets.collect()]
}

/// Which of `count` slaves are bound.
pub(in crate::contact) fn bound<P>(ties: &[Tie<NodeHold<P>>], count: usize) -> Vec<bool> {
    let mut bound = vec![false; count];
    ties.iter().for_each(|tie| bound[tie.hold.slave as usize] = true);
    bound
}

/// Finds nodes among `slaves`, and facets of a surface that was `before`, again.
pub(in crate::contact) fn again<'a, P: Copy, F: Copy + Ord>(
    slaves: &'a [u32],
    facets: &[F],
    before: &'a [F],
) -> impl Fn(&NodeHold<P>) -> Option<NodeHold<P>> + use<'a, P, F> {
    let by_nodes = ByNodes::new(facets);
    move |hold| {
        let facet = by_nodes.number_of(before[hold.facet as usize])?;
        let slave = slaves.binary_search(&hold.node).ok()?;
        Some(NodeHold { slave: slave as u32, facet, ..*hold })
    }
}

/// The one tie of a unit, and its spring without its place.
pub(in crate::contact) fn only<P, const D: usize>(ties: &[Tie<NodeHold<P>>], side: f32) -> Option<(&Tie<NodeHold<P>>, Spring<D>)>
where
    Dim<D>: Surfaces<D>,
{
    ties.first().map(|tie| (tie, tie.spring(side)))
}
