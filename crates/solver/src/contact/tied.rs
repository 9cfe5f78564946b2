//! Tied contact: what touches at the start stays together, as if glued, until the traction exceeds a
//! strength.
//!
//! What is bound is for the formulation to say (trait `Bindable`): each slave node near the target to the
//! segment below it, in 3D to a triangle of the facet below it (`nodes.rs`), or both surfaces over what their
//! segments or facets have in common (`surfaces.rs`). Place along each other and distance at the start are
//! kept by springs (law [`super::law::tie::Tie`], or multipliers) whose rows are objective, and exact in both
//! momenta.
//!
//! Where √(⟨−F⟩² + T²) / area exceeds the strength the tie is gone for good; pressing does not break it. What
//! was stored in pulling and in slip is lost, and reported to the ledger. What is free, and what is so
//! because its ties are gone, is in ordinary contact with the same surface.

mod beside;
pub(super) mod nodes;
pub(super) mod surfaces;

pub use beside::Beside;
pub(crate) use beside::leave_out_tied;

use super::checked::Checked;
use super::formulation::{FormulationKind, Setup, Surfaces, one_pass};
use super::node_facet::NodeFacet;
use super::node_segment::NodeSegment;
use super::search::Search;
use super::slaves::PassInput;
use super::springs::{Answer, Answers, Spring, Springs};
use super::{Formulation, Scene};
use crate::archive::{Archive, ArchiveResult, Persist, Plain, persist_each};
use crate::contact::messages::TIE;
use crate::error::Fault;
use crate::tensor::Dim;
use std::any::Any;

/// What nodes have that are tied.
pub const NODES: FormulationKind = FormulationKind {
    name: "tied",
    doc: "nodes bound to segments or facets until the traction exceeds a strength, then ordinary contact",
    source: "two-way springs or multipliers on gap and slip",
    passes: one_pass,
    tied: None,
    is_carried: false,
    in_2d: Some(|setup| {
        let (pending, at_start) = PendingTies::of(&setup);
        Ok(Box::new(Tied::new(pending, NodeSegment::of(setup), at_start)?))
    }),
    in_3d: Some(|setup| {
        let (pending, at_start) = PendingTies::of(&setup);
        let (loose, overlap_check) = NodeFacet::of(setup);
        // What weighs forces has to see those of the ties.
        Ok(Box::new(Checked::new(Box::new(Tied::new(pending, loose, at_start)?), overlap_check)))
    }),
};

/// What is nearer than this fraction of a segment's length, or of a facet's width, is bound (beyond the
/// thickness).
pub(super) const NEAR: f64 = 0.05;

/// Ordinary contact, and what can be bound beside it.
pub(super) trait Bindable<const D: usize>: Formulation<D> + Sized
where
    Dim<D>: Surfaces<D>,
{
    /// What a spring of a tie holds.
    type Hold: Hold;
    /// What is bound, as ordinary contact asks for it.
    type Bound: Send + Sync + 'static;
    /// What is bound, and what [`NEAR`] is a fraction of.
    const WORDS: [&'static str; 2];

    /// Ties of what is near.
    fn bind(&self, pending: &mut PendingTies<D>, positions: &[[f64; D]]) -> Vec<Tie<Self::Hold>>;

    /// Nodes of the target that lie on what these ties hold of the slave, beside those of
    /// [`Bindable::sides`].
    fn beneath(&self, _pending: &mut PendingTies<D>, _ties: &[Tie<Self::Hold>], _positions: &[[f64; D]]) -> Vec<u32> {
        Vec::new()
    }

    /// Nodes of the slave and of the target that these ties hold, in any order.
    fn sides(&self, ties: &[Tie<Self::Hold>]) -> [Vec<u32>; 2];

    /// What these ties bind.
    fn bound(&self, ties: &[Tie<Self::Hold>]) -> Self::Bound;

    /// Whether that can be held, of a model with so many nodes.
    fn is_there(&self, hold: &Self::Hold, nodes: usize) -> bool;

    /// Where that is found again of what `old` held, whose surfaces were those before they changed.
    fn again<'a>(&'a self, old: &'a Self) -> impl Fn(&Self::Hold) -> Option<Self::Hold> + 'a;

    /// Adds the springs of the ties of a unit, one each; `side` is that of [`Spring`].
    fn hold(&self, ties: &[Tie<Self::Hold>], side: f32, positions: &[[f64; D]], springs: &mut Springs<D>);

    /// [`Formulation::detect`] for what is not bound.
    fn detect_free(&mut self, bound: &Self::Bound, scene: &Scene<'_, D>, springs: &mut Springs<D>);

    /// [`Formulation::remember`], where `all` has the ties too.
    fn remember_free(&mut self, _all: &Answers<'_, D>, own: Answers<'_, D>) {
        self.remember(own);
    }

    /// Begins where a unit broke whose springs had the energy `pressing` (J, in 2D J/m) of those that press;
    /// returns what is lost of it.
    fn take_over(&mut self, _ties: &[Tie<Self::Hold>], _pressing: f64) -> f64 {
        0.0
    }
}

/// What a spring of a tie holds.
pub(super) trait Hold: Plain {
    /// What it belongs to: springs of one unit stand one after the other, and break together.
    fn unit(&self) -> [u32; 2];

    /// The node that no other tie may hold, if there is one.
    fn node(&self) -> Option<u32>;
}

/// A spring of a tie.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tie<H> {
    pub(super) hold: H,
    /// Distance at the start, m.
    pub(super) gap: f64,
    pub(super) stiffness: f64,
    pub(super) area: f64,
}

impl<H> Tie<H> {
    /// The spring without its place; `side` is that of [`Spring`].
    pub(super) fn spring<const D: usize>(&self, side: f32) -> Spring<D>
    where
        Dim<D>: Surfaces<D>,
    {
        Spring { stiffness: self.stiffness, area: self.area, side, ..Spring::default() }
    }
}

impl<H: Persist> Persist for Tie<H> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { hold, gap, stiffness, area } = self;
        persist_each!(archive; hold, gap, stiffness, area);
        Ok(())
    }
}

/// The ties of each unit.
fn units<H: Hold>(ties: &[Tie<H>]) -> impl Iterator<Item = &[Tie<H>]> {
    ties.chunk_by(|a, b| a.hold.unit() == b.hold.unit())
}

/// What binds.
pub(super) struct PendingTies<const D: usize> {
    pub(super) search: Box<dyn Search<D>>,
    input: PassInput,
    pub(super) thickness: f64,
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
    /// And the positions (m) at which they bind before the first step, if they do.
    pub(super) fn of<'a>(setup: &Setup<'a, D>) -> (Self, Option<&'a [[f64; D]]>) {
        let (slave, target) = setup.passes[0];
        // The element that a node is bound to counts, not the softest of its part.
        let moduli = setup.sides[target].stiffness.clone();
        let pending = Self {
            search: (setup.search)(),
            input: PassInput { moduli, ..setup.input((slave, target), 1) },
            thickness: setup.contact.interface.thickness,
            strength: setup.contact.tied.unwrap_or(f64::INFINITY),
            terms: setup.tie_terms,
            slave,
        };
        (pending, setup.binds_at_start().then_some(setup.positions))
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
    ties: Vec<Tie<L::Hold>>,
    /// What binds at birth; `None` when it has.
    unborn: Option<PendingTies<D>>,
    /// Traction that breaks a tie, Pa.
    strength: f64,
    /// Which terms ties follow.
    terms: usize,
    side: f32,
    /// Ordinary contact, and what of it is bound.
    loose: L,
    bound: L::Bound,
    /// See [`Bindable::beneath`].
    beneath: Vec<u32>,
    held: Held,
    /// Units that are gone.
    broken: usize,
    /// Energy of the ties that broke in this step, J (in 2D J/m).
    freed: f64,
}

impl<L, const D: usize> Tied<L, D>
where
    L: Bindable<D>,
    Dim<D>: Surfaces<D>,
{
    /// Ties beside `loose`; with the positions at the start they bind at once.
    pub(super) fn new(pending: PendingTies<D>, loose: L, at_start: Option<&[[f64; D]]>) -> Result<Self, Fault> {
        let (strength, terms, slave) = (pending.strength, pending.terms, pending.slave);
        let (bound, side) = (loose.bound(&[]), [1.0, -1.0][slave]);
        #[rustfmt::skip]
        let mut tied = Self {
            ties: Vec::new(), unborn: Some(pending), strength, terms, side, loose, bound, beneath: Vec::new(), held: Held::default(),
            broken: 0, freed: 0.0,
        };
        if let Some(positions) = at_start {
            tied.bind(positions);
            if tied.ties.is_empty() {
                let (first, second) = [("first", "second"), ("second", "first")][slave];
                let [what, width] = L::WORDS;
                let message = format!("it binds nothing: no {what} of the {first} surface is within 5 % of {width} of the {second}");
                return Err(Fault::new(&TIE, "tied", message, "let the surfaces touch, raise `thickness`, or leave `tied` out"));
            }
        }
        Ok(tied)
    }

    /// Binds what is near, if that was not done before.
    fn bind(&mut self, positions: &[[f64; D]]) {
        if let Some(mut pending) = self.unborn.take() {
            self.ties = self.loose.bind(&mut pending, positions);
            self.beneath = self.loose.beneath(&mut pending, &self.ties, positions);
            self.note_bound();
            self.held.first.clone_from(&self.held.now);
        }
    }

    /// Notes what the ties bind that are there now.
    fn note_bound(&mut self) {
        self.bound = self.loose.bound(&self.ties);
        let [slave, mut target] = self.loose.sides(&self.ties);
        target.extend(&self.beneath);
        self.held.now = [slave, target].map(|mut nodes| {
            nodes.sort_unstable();
            nodes.dedup();
            nodes
        });
    }

    /// Lets go of the units of which a spring has a traction above the strength.
    fn break_units(&mut self, answers: &Answers<'_, D>) {
        let (mut kept, mut at) = (0, 0);
        while at < self.ties.len() {
            let (from, to) = (at, at + units(&self.ties[at..]).next().map_or(1, <[_]>::len));
            at = to;
            let holds = |(tie, answer): (&Tie<L::Hold>, Answer<'_, D>)| {
                let (pull, shear) = ((-answer.solved.force).max(0.0), answer.slid().friction);
                let square = (0..D - 1).fold(pull * pull, |sum, d| sum + shear[d] * shear[d]);
                square.sqrt() <= self.strength * tie.area
            };
            if self.ties[from..to].iter().zip(answers.part(from, to)).all(holds) {
                self.ties.copy_within(from..to, kept);
                kept += to - from;
                continue;
            }
            self.broken += 1;
            let mut pressing = 0.0;
            for answer in answers.part(from, to) {
                let [gap, slip] = answer.books().stored;
                let (pulls, presses) = if answer.solved.force < 0.0 { (gap, 0.0) } else { (0.0, gap) };
                self.freed += slip + pulls;
                pressing += presses;
            }
            self.freed += self.loose.take_over(&self.ties[from..to], pressing);
        }
        if kept < self.ties.len() {
            self.ties.truncate(kept);
            self.note_bound();
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
        units(&self.ties).for_each(|unit| self.loose.hold(unit, self.side, positions, springs));
        springs.close_group(self.terms);
        self.loose.detect_free(&self.bound, scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, D>) {
        let ties = solved.part(0, self.ties.len());
        self.loose.remember_free(&solved, solved.part(self.ties.len(), usize::MAX));
        self.freed = 0.0;
        if self.strength < f64::INFINITY {
            self.break_units(&ties);
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { ties, unborn, strength: _, terms: _, side: _, loose, bound: _, beneath, held, broken, freed } = self;
        let mut is_unborn = unborn.is_some();
        persist_each!(archive; &mut is_unborn, ties, broken, freed, beneath, &mut held.first[0], &mut held.first[1]);
        archive.check(unborn.is_some() || !is_unborn, "ties of this contact are there from the start")?;
        if !is_unborn {
            *unborn = None;
        }
        archive.check(ties.iter().all(|tie| loose.is_there(&tie.hold, archive.nodes)), "a tie binds what is not there")?;
        loose.persist(archive)?;
        self.note_bound();
        Ok(())
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        let Self { ties, unborn, loose, broken, beneath, held, .. } = *old;
        (self.broken, self.beneath, self.held) = (broken, beneath, held);
        if unborn.is_none() && self.unborn.take().is_some() {
            let again = self.loose.again(&loose);
            for unit in units(&ties) {
                let count = self.ties.len();
                self.ties.extend(unit.iter().filter_map(|tie| Some(Tie { hold: again(&tie.hold)?, ..*tie })));
                // Ties go with the elements on either side.
                self.broken += usize::from(self.ties.len() == count);
            }
        }
        self.note_bound();
        self.loose.inherit(Box::new(loose));
    }

    fn within(&self) -> Option<&dyn Formulation<D>> {
        Some(&self.loose)
    }

    fn freed(&self) -> f64 {
        self.freed
    }

    fn held(&self) -> Option<&Held> {
        Some(&self.held)
    }

    fn ties(&self) -> Option<Ties> {
        let nodes = self.ties.iter().filter_map(|tie| tie.hold.node()).collect();
        Some(Ties { nodes, held: units(&self.ties).count(), broken: self.broken })
    }
}

/// Nodes of the slave and of the target that ties hold, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Held {
    /// When they were bound.
    first: [Vec<u32>; 2],
    /// Without those whose ties are gone.
    now: [Vec<u32>; 2],
}

/// What a tied contact holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ties {
    /// Nodes that no other tie may hold, ascending.
    pub nodes: Vec<u32>,
    /// How many ties there are: nodes, or pairs of segments or facets.
    pub held: usize,
    /// How many were and are no more.
    pub broken: usize,
}
