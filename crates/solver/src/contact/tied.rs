//! Tied contact: what touches at the start stays together, as if glued, until the traction exceeds a
//! strength.
//!
//! Each slave node near the target is bound to the segment below it: its place along the segment and its
//! distance from it at the start are kept by two springs (law [`super::law::tie::Tie`], or multipliers),
//! whose rows are those of node-to-segment contact: objective, and exact in both momenta. One surface is
//! slave (the first one, unless the formulation is `single_pass` with another): binding the nodes of both
//! would hold more than there is to hold.
//!
//! Where √(⟨−F⟩² + T²) / area exceeds the strength the tie is gone for good; pressing does not break it. What
//! was stored in pulling and in slip is lost, and reported to the ledger. Nodes that are free, and those
//! whose ties are gone, are in ordinary contact with the same surface.

use super::formulation::{FormulationKind, Setup, one_pass};
use super::node_segment::{NodeSegment, PassInput, ends};
use super::projection::node_segment::{Projection, Target};
use super::search::{Query, Search};
use super::springs::{Answers, Spring, Springs};
use super::{Formulation, Scene, Vector, length};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::contact::messages::TIE;
use crate::error::Fault;
use std::any::Any;

/// What makes contacts with `tied`; it stands in for the formulation.
pub const KIND: FormulationKind = FormulationKind {
    name: "tied",
    doc: "nodes bound to segments until the traction exceeds a strength, then ordinary contact",
    source: "two-way springs or multipliers on gap and slip",
    passes: one_pass,
    make: |setup| Ok(Box::new(Tied::of(setup)?)),
};

/// Nodes within this fraction of a segment's length of it are bound (beyond the thickness).
pub(super) const NEAR: f64 = 0.05;

/// The formulation.
pub struct Tied {
    target: Target,
    ties: Vec<Tie>,
    /// What binds at birth; `None` when it has.
    unborn: Option<PendingTies>,
    /// Traction that breaks a tie, Pa.
    strength: f64,
    /// Which terms ties follow.
    terms: usize,
    side: f32,
    /// Ordinary contact, and which of its slave nodes are bound.
    loose: NodeSegment,
    bound: Vec<bool>,
    broken: usize,
    /// Energy of the ties that broke in this step, J/m.
    freed: f64,
}

struct PendingTies {
    search: Box<dyn Search<2>>,
    nodes: Vec<u32>,
    input: PassInput,
    thickness: f64,
}

/// A bound node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Tie {
    node: u32,
    /// Index in the slave surface.
    slave: u32,
    segment: u32,
    /// Place along the segment at the start: 0 and 1 are its nodes.
    place: f64,
    /// Distance at the start, m.
    gap: f64,
    stiffness: f64,
    area: f64,
}

persist_all!(Tie { node, slave, segment, place, gap, stiffness, area });

impl Tied {
    fn of(setup: Setup<'_>) -> Result<Self, Fault> {
        let (slave, master) = setup.passes[0];
        let target = setup.sides[master].target.clone();
        let nodes = setup.sides[slave].target.surface.nodes.clone();
        // The element that a node is bound to counts, not the softest of its part.
        let moduli = setup.sides[master].segments.clone();
        let input = PassInput { slaves: setup.slaves(slave, 1), per_modulus: setup.per_modulus(slave, 1), moduli, ..PassInput::default() };
        let interface = &setup.contact.interface;
        let birth = interface.active[0];
        let unborn = PendingTies { search: (setup.search)(), nodes, input, thickness: interface.thickness };
        let (strength, terms, side) = (setup.contact.tied.unwrap_or(f64::INFINITY), setup.tie_terms, [1.0, -1.0][slave]);
        let (positions, bound) = (setup.positions, vec![false; unborn.nodes.len()]);
        let rebuild = setup.rebuild;
        let loose = NodeSegment::of(setup);
        let mut tied = Self { target, ties: Vec::new(), unborn: Some(unborn), strength, terms, side, loose, bound, broken: 0, freed: 0.0 };
        if birth <= 0.0 && !rebuild {
            tied.bind(positions);
            if tied.ties.is_empty() {
                let (first, second) = [("first", "second"), ("second", "first")][slave];
                let message =
                    format!("it binds nothing: no node of the {first} surface is within 5 % of a segment's length of the {second}");
                return Err(Fault::new(&TIE, "tied", message, "let the surfaces touch, raise `thickness`, or leave `tied` out"));
            }
        }
        Ok(tied)
    }

    /// Binds what is near.
    fn bind(&mut self, positions: &[Vector]) {
        let Some(PendingTies { mut search, nodes, input, thickness }) = self.unborn.take() else { return };
        let segments = &self.target.surface.segments;
        let longest = segments.iter().map(|&segment| length(segment, positions)).fold(0.0, f64::max);
        let query = Query {
            positions_old: positions,
            positions_new: positions,
            slaves: &nodes,
            facets: segments,
            reach: thickness + 1.01 * NEAR * longest,
        };
        let mut pairs = Vec::new();
        search.pairs(&query, &mut pairs);
        let mut best: Option<(f64, Tie)> = None;
        for (index, pair) in pairs.iter().enumerate() {
            let node = nodes[pair.slave as usize];
            let slave = pair.slave as usize;
            let (stiffness, area) = (input.stiffness(slave, pair.facet), input.slaves[slave].area);
            if let Some([along, gap, whole]) = place(positions, node, segments[pair.facet as usize])
                && self.target.surface.nodes.binary_search(&node).is_err()
            {
                let beyond = f64::max(0.0, (along - 0.5 * whole).abs() - 0.5 * whole);
                let distance = (gap * gap + beyond * beyond).sqrt();
                if distance <= thickness + NEAR * whole && best.is_none_or(|(nearest, _)| distance < nearest) {
                    best =
                        Some((distance, Tie { node, slave: pair.slave, segment: pair.facet, place: along / whole, gap, stiffness, area }));
                }
            }
            // Pairs are sorted by slave.
            if pairs.get(index + 1).is_none_or(|next| next.slave != pair.slave)
                && let Some((_, tie)) = best.take()
            {
                self.bound[tie.slave as usize] = true;
                self.ties.push(tie);
            }
        }
    }
}

/// Where a node is seen from a segment: along it from its beginning, and above it, m; and the length of the
/// segment, m. `None` where that has none.
fn place(positions: &[Vector], node: u32, segment: [u32; 2]) -> Option<[f64; 3]> {
    let [a, b] = segment.map(|node| positions[node as usize]);
    let x = positions[node as usize];
    let (d, r) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
    let whole = (d[0] * d[0] + d[1] * d[1]).sqrt();
    (whole > 0.0).then(|| [(r[0] * d[0] + r[1] * d[1]) / whole, (d[0] * r[1] - d[1] * r[0]) / whole, whole])
}

impl Formulation<2> for Tied {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        let positions = scene.sweep.new;
        self.bind(positions);
        for tie in &self.ties {
            let segment = self.target.surface.segments[tie.segment as usize];
            // A segment without length is the elements' to tell; the tie does nothing.
            let [along, gap, whole] = place(positions, tie.node, segment).unwrap_or([0.0, tie.gap, 1.0]);
            let [a, b] = segment.map(|node| positions[node as usize]);
            let normal = [-(b[1] - a[1]) / whole, (b[0] - a[0]) / whole];
            // Forces act at the present foot of the node, so that both are collinear.
            let projection = Projection { segment: tie.segment, weights: [1.0 - along / whole, along / whole], gap, normal };
            let (stiffness, area, slip) = (tie.stiffness, tie.area, along - tie.place * whole);
            let spring = Spring { normal, gap: gap - tie.gap, stiffness, area, side: self.side, slip: [slip], ..Spring::default() };
            springs.push(spring, &ends(tie.node, &projection, &self.target, positions));
        }
        springs.close_group(self.terms);
        self.loose.detect_free(&self.bound, scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        let (mut ties, loose) = (solved.part(0, self.ties.len()), solved.part(self.ties.len(), usize::MAX));
        self.loose.remember(loose);
        self.freed = 0.0;
        if self.strength == f64::INFINITY {
            return;
        }
        let (strength, bound) = (self.strength, &mut self.bound);
        let (broken, freed) = (&mut self.broken, &mut self.freed);
        self.ties.retain(|tie| {
            let Some(answer) = ties.next() else { return true };
            let [pull, shear] = [(-answer.solved.force).max(0.0), answer.solved.friction[0]];
            let holds = (pull * pull + shear * shear).sqrt() <= strength * tie.area;
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
        let Self { target, ties, unborn, strength: _, terms: _, side: _, loose, bound, broken, freed } = self;
        let mut is_unborn = unborn.is_some();
        persist_each!(archive; &mut is_unborn, ties, &mut bound[..], broken, freed);
        archive.check(unborn.is_some() || !is_unborn, "ties of this contact are there from the start")?;
        if !is_unborn {
            *unborn = None;
        }
        let is_tie = |tie: &Tie| {
            let Tie { node, slave, segment, .. } = *tie;
            (node as usize) < archive.nodes && (slave as usize) < bound.len() && (segment as usize) < target.surface.segments.len()
        };
        archive.check(ties.iter().all(is_tie), "a tie binds what is not there")?;
        loose.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        let Self { target: before, ties, unborn, loose, broken, .. } = *old;
        self.loose.inherit(Box::new(loose));
        self.broken = broken;
        if unborn.is_some() {
            return;
        }
        let Some(PendingTies { nodes, .. }) = self.unborn.take() else { return };
        let mut by_nodes: Vec<([u32; 2], u32)> = self.target.surface.segments.iter().copied().zip(0..).collect();
        by_nodes.sort_unstable();
        for tie in ties {
            let segment = before.surface.segments[tie.segment as usize];
            let at = by_nodes.binary_search_by_key(&segment, |&(nodes, _)| nodes).ok().map(|at| by_nodes[at].1);
            // Ties go with the elements on either side.
            match (at, nodes.binary_search(&tie.node)) {
                (Some(segment), Ok(slave)) => {
                    self.bound[slave] = true;
                    self.ties.push(Tie { slave: slave as u32, segment, ..tie });
                }
                _ => self.broken += 1,
            }
        }
    }

    fn within(&self) -> Option<&dyn Formulation<2>> {
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
