//! Tied contact: what touches at the start stays together, as if glued, until the traction exceeds a
//! strength.
//!
//! Each slave node near the target is bound to the segment below it, in 3D to a triangle of the facet below
//! it: its place along it and its distance from it at the start are kept by springs (law
//! [`super::law::tie::Tie`], or multipliers), whose rows are those of ordinary contact at the node's present
//! foot: objective, and exact in both momenta. One surface is slave (the first one, unless the formulation is
//! `single_pass` with another): binding the nodes of both would hold more than there is to hold.
//!
//! Where √(⟨−F⟩² + T²) / area exceeds the strength the tie is gone for good; pressing does not break it. What
//! was stored in pulling and in slip is lost, and reported to the ledger. Nodes that are free, and those
//! whose ties are gone, are in ordinary contact with the same surface. What differs between 2D and 3D is
//! the trait `Bindable`.

use super::checked::Checked;
use super::formulation::{FormulationKind, Setup, Surfaces, one_pass};
use super::node_facet::NodeFacet;
use super::node_segment::NodeSegment;
use super::search::Search;
use super::slaves::PassInput;
use super::springs::{Answers, Spring, Springs};
use super::{Formulation, Scene};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact::messages::TIE;
use crate::error::Fault;
use crate::mesh::surface::{Facet, Sided};
use crate::tensor::Dim;
use std::any::Any;

/// What makes contacts with `tied`; it stands in for the formulation.
pub const KIND: FormulationKind = FormulationKind {
    name: "tied",
    doc: "nodes bound to segments until the traction exceeds a strength, then ordinary contact",
    source: "two-way springs or multipliers on gap and slip",
    passes: one_pass,
    in_2d: Some(|setup| {
        let (pending, at_start) = (PendingTies::of(&setup), setup.binds_at_start().then_some(setup.positions));
        Ok(Box::new(Tied::new(pending, NodeSegment::of(setup), at_start)?))
    }),
    in_3d: Some(|setup| {
        let (pending, at_start) = (PendingTies::of(&setup), setup.binds_at_start().then_some(setup.positions));
        let (loose, overlap_check) = NodeFacet::of(setup);
        // What weighs forces has to see those of the ties.
        Ok(Box::new(Checked::new(Box::new(Tied::new(pending, loose, at_start)?), overlap_check)))
    }),
};

/// Nodes within this fraction of a segment's length, or of a facet's width, are bound (beyond the thickness).
pub(super) const NEAR: f64 = 0.05;

/// Ordinary contact in one pass, and what nodes can be bound to beside it.
pub(super) trait Bindable<const D: usize>: Formulation<D> + Sized
where
    Dim<D>: Surfaces<D>,
{
    /// Where a node is bound to a facet.
    type Place: Copy + Default + Persist + Send + Sync + 'static;
    /// What [`NEAR`] is a fraction of.
    const WIDTH: &'static str;

    /// The slave nodes.
    fn slaves(&self) -> &[u32];

    /// The surface that they are bound to.
    fn target(&self) -> &<Dim<D> as Surfaces<D>>::Target;

    /// Those of the slaves that are near a facet, ascending, with their places on the nearest one.
    fn near(&self, search: &mut dyn Search<D>, thickness: f64, positions: &[[f64; D]]) -> Vec<Bond<Self::Place>>;

    /// Whether a facet has such a place.
    fn is_place(_: Facet<D>, _: &Self::Place) -> bool {
        true
    }

    /// Adds the spring of a tie, of which `spring` has stiffness, area and side.
    fn hold(&self, tie: &Tie<Self::Place>, spring: Spring<D>, positions: &[[f64; D]], springs: &mut Springs<D>);

    /// [`Formulation::detect`] for those slaves of the first pass that are not bound (`bound` by index;
    /// empty: all).
    fn detect_free(&mut self, bound: &[bool], scene: &Scene<'_, D>, springs: &mut Springs<D>);
}

/// A slave near a facet.
pub(super) struct Bond<P> {
    /// Index in the slave surface.
    pub(super) slave: u32,
    pub(super) facet: u32,
    pub(super) place: P,
    /// Distance, m.
    pub(super) gap: f64,
}

/// A bound node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tie<P> {
    pub(super) node: u32,
    /// Index in the slave surface.
    slave: u32,
    /// Index in the target.
    pub(super) facet: u32,
    /// Where on it at the start.
    pub(super) place: P,
    /// Distance at the start, m.
    pub(super) gap: f64,
    stiffness: f64,
    area: f64,
}

impl<P: Persist> Persist for Tie<P> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { node, slave, facet, place, gap, stiffness, area } = self;
        persist_each!(archive; node, slave, facet, place, gap, stiffness, area);
        Ok(())
    }
}

/// What binds.
pub(super) struct PendingTies<const D: usize> {
    search: Box<dyn Search<D>>,
    input: PassInput,
    thickness: f64,
    /// Traction that breaks a tie, Pa.
    strength: f64,
    /// Which terms ties follow.
    terms: usize,
    /// Which of the two surfaces is slave.
    slave: usize,
}

impl<const D: usize> PendingTies<D>
where
    Dim<D>: Surfaces<D>,
{
    fn of(setup: &Setup<'_, D>) -> Self {
        let (slave, target) = setup.passes[0];
        // The element that a node is bound to counts, not the softest of its part.
        let moduli = setup.sides[target].stiffness.clone();
        Self {
            search: (setup.search)(),
            input: PassInput { moduli, ..setup.input((slave, target), 1) },
            thickness: setup.contact.interface.thickness,
            strength: setup.contact.tied.unwrap_or(f64::INFINITY),
            terms: setup.tie_terms,
            slave,
        }
    }
}

impl<const D: usize> Setup<'_, D>
where
    Dim<D>: Surfaces<D>,
{
    /// Whether its ties bind before the first step.
    fn binds_at_start(&self) -> bool {
        self.contact.interface.active[0] <= 0.0 && !self.rebuild
    }
}

/// The formulation.
pub(super) struct Tied<L, const D: usize>
where
    L: Bindable<D>,
    Dim<D>: Surfaces<D>,
{
    ties: Vec<Tie<L::Place>>,
    /// What binds at birth; `None` when it has.
    unborn: Option<PendingTies<D>>,
    /// Traction that breaks a tie, Pa.
    strength: f64,
    /// Which terms ties follow.
    terms: usize,
    side: f32,
    /// Ordinary contact, and which of its slave nodes are bound.
    loose: L,
    bound: Vec<bool>,
    broken: usize,
    /// Energy of the ties that broke in this step, J (in 2D J/m).
    freed: f64,
}

impl<L, const D: usize> Tied<L, D>
where
    L: Bindable<D>,
    Dim<D>: Surfaces<D>,
{
    /// Ties beside the only pass of `loose`; with the positions at the start they bind at once.
    fn new(pending: PendingTies<D>, loose: L, at_start: Option<&[[f64; D]]>) -> Result<Self, Fault> {
        let (strength, terms, slave) = (pending.strength, pending.terms, pending.slave);
        let (bound, side) = (vec![false; loose.slaves().len()], [1.0, -1.0][slave]);
        let mut tied = Self { ties: Vec::new(), unborn: Some(pending), strength, terms, side, loose, bound, broken: 0, freed: 0.0 };
        if let Some(positions) = at_start {
            tied.bind(positions);
            if tied.ties.is_empty() {
                let (first, second) = [("first", "second"), ("second", "first")][slave];
                let message = format!("it binds nothing: no node of the {first} surface is within 5 % of {} of the {second}", L::WIDTH);
                return Err(Fault::new(&TIE, "tied", message, "let the surfaces touch, raise `thickness`, or leave `tied` out"));
            }
        }
        Ok(tied)
    }

    /// Binds what is near, if that was not done before.
    fn bind(&mut self, positions: &[[f64; D]]) {
        let Some(PendingTies { mut search, input, thickness, .. }) = self.unborn.take() else { return };
        for Bond { slave, facet, place, gap } in self.loose.near(&mut *search, thickness, positions) {
            let (node, of) = (self.loose.slaves()[slave as usize], slave as usize);
            let (stiffness, area) = (input.stiffness_at(of, facet), input.slaves[of].area);
            self.bound[of] = true;
            self.ties.push(Tie { node, slave, facet, place, gap, stiffness, area });
        }
    }
}

impl<L, const D: usize> Formulation<D> for Tied<L, D>
where
    L: Bindable<D>,
    Dim<D>: Surfaces<D>,
{
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        let positions = scene.sweep.new;
        self.bind(positions);
        for tie in &self.ties {
            let spring = Spring { stiffness: tie.stiffness, area: tie.area, side: self.side, ..Spring::default() };
            self.loose.hold(tie, spring, positions, springs);
        }
        springs.close_group(self.terms);
        self.loose.detect_free(&self.bound, scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, D>) {
        let (mut ties, loose) = (solved.clone().part(0, self.ties.len()), solved.part(self.ties.len(), usize::MAX));
        self.loose.remember(loose);
        self.freed = 0.0;
        if self.strength == f64::INFINITY {
            return;
        }
        let (strength, bound) = (self.strength, &mut self.bound);
        let (broken, freed) = (&mut self.broken, &mut self.freed);
        self.ties.retain(|tie| {
            let Some(answer) = ties.next() else { return true };
            let (pull, shear) = ((-answer.solved.force).max(0.0), answer.solved.friction);
            let square = (0..D - 1).fold(pull * pull, |sum, d| sum + shear[d] * shear[d]);
            let holds = square.sqrt() <= strength * tie.area;
            if !holds {
                bound[tie.slave as usize] = false;
                *broken += 1;
                let stored = answer.books().stored;
                *freed += stored[1] + if answer.solved.force < 0.0 { stored[0] } else { 0.0 };
            }
            holds
        });
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { ties, unborn, strength: _, terms: _, side: _, loose, bound, broken, freed } = self;
        let mut is_unborn = unborn.is_some();
        persist_each!(archive; &mut is_unborn, ties, &mut bound[..], broken, freed);
        archive.check(unborn.is_some() || !is_unborn, "ties of this contact are there from the start")?;
        if !is_unborn {
            *unborn = None;
        }
        let is_tie = |tie: &Tie<L::Place>| {
            let facet = loose.target().facets().get(tie.facet as usize);
            (tie.node as usize) < archive.nodes
                && (tie.slave as usize) < bound.len()
                && facet.is_some_and(|&facet| L::is_place(facet, &tie.place))
        };
        archive.check(ties.iter().all(is_tie), "a tie binds what is not there")?;
        loose.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        let Self { ties, unborn, loose, broken, .. } = *old;
        let before = loose.target().facets();
        let ties: Vec<_> = ties.into_iter().map(|tie| (before[tie.facet as usize], tie)).collect();
        self.loose.inherit(Box::new(loose));
        self.broken = broken;
        if unborn.is_some() || self.unborn.take().is_none() {
            return;
        }
        let mut by_nodes: Vec<(Facet<D>, u32)> = self.loose.target().facets().iter().copied().zip(0..).collect();
        by_nodes.sort_unstable();
        for (facet, tie) in ties {
            let at = by_nodes.binary_search_by_key(&facet, |&(nodes, _)| nodes).ok().map(|at| by_nodes[at].1);
            // Ties go with the elements on either side.
            match (at, self.loose.slaves().binary_search(&tie.node)) {
                (Some(facet), Ok(slave)) => {
                    self.bound[slave] = true;
                    self.ties.push(Tie { slave: slave as u32, facet, ..tie });
                }
                _ => self.broken += 1,
            }
        }
    }

    fn within(&self) -> Option<&dyn Formulation<D>> {
        Some(&self.loose)
    }

    fn freed(&self) -> f64 {
        self.freed
    }

    fn ties(&self) -> Option<Ties> {
        Some(Ties { nodes: self.ties.iter().map(|tie| tie.node).collect(), broken: self.broken })
    }
}

/// What a tied contact holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ties {
    /// Nodes that are bound, ascending.
    pub nodes: Vec<u32>,
    /// How many were and are no more.
    pub broken: usize,
}
