//! Tied contact in 3D: what touches at the start stays together until the traction exceeds a strength, as
//! in 2D ([`crate::contact::tied`]).
//!
//! Each slave node near the target is bound to the triangle of a facet below it. Its height above the
//! triangle and its place along it, of which the corners keep their shares of the start, are kept by springs
//! with the rows of a node against a facet ([`super::ends`]) at the node's present foot: objective, and exact
//! in both momenta. One surface is slave. Broken ties are gone for good, what they stored is reported to the
//! ledger; nodes that are free, and those whose ties are gone, are in ordinary contact with the same surface.

use super::groups::{bend, halves};
use super::{NodeFacet, PassInput, ends, first_edge, tangent};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::contact::projection::node_facet::{Feature, Placed, Projection, Vector};
use crate::contact::search::{Query, Search};
use crate::contact::springs::{Answers, Spring, Springs, TangentSpace};
use crate::contact::tied::{NEAR, Ties};
use crate::contact::{Formulation, Scene};
use crate::mesh::surface::{Corners, SpaceSurface};
use crate::tensor::{Dim, dot};
use std::any::Any;

/// The formulation.
pub struct TiedFacet {
    target: SpaceSurface,
    ties: Vec<Tie>,
    /// What binds at birth; `None` when it has.
    unborn: Option<PendingTies>,
    /// Traction that breaks a tie, Pa.
    strength: f64,
    /// Which terms ties follow.
    terms: usize,
    side: f32,
    /// Ordinary contact, and which of its slave nodes are bound.
    loose: NodeFacet,
    bound: Vec<bool>,
    broken: usize,
    /// Energy of the ties that broke in this step, J.
    freed: f64,
}

/// What binds.
pub struct PendingTies {
    /// Finds what is near.
    pub search: Box<dyn Search<3>>,
    /// What is known of slaves, and of the element behind each facet of the target.
    pub input: PassInput,
    /// Distance that the surfaces keep, m.
    pub thickness: f64,
}

/// A bound node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Tie {
    node: u32,
    /// Index in the slave surface.
    slave: u32,
    facet: u32,
    triangle: u32,
    /// Shares of the triangle's corners in the node's foot at the start.
    place: Vector,
    /// Distance at the start, m.
    gap: f64,
    stiffness: f64,
    area: f64,
}

persist_all!(Tie { node, slave, facet, triangle, place, gap, stiffness, area });

impl TiedFacet {
    /// For the only pass of `loose`, the ordinary contact; ties hold up to `strength` (Pa) and follow
    /// `terms`.
    #[must_use]
    pub fn new(loose: NodeFacet, unborn: PendingTies, strength: f64, terms: usize) -> Self {
        let target = loose.tracker().target(0).clone();
        let side = loose.tracker().side(0);
        let bound = vec![false; unborn.input.slaves.len()];
        Self { target, ties: Vec::new(), unborn: Some(unborn), strength, terms, side, loose, bound, broken: 0, freed: 0.0 }
    }

    /// Binds what is near, if that was not done before.
    pub fn bind(&mut self, positions: &[Vector]) {
        let Some(PendingTies { mut search, input, thickness }) = self.unborn.take() else { return };
        let tracker = self.loose.tracker();
        let slaves = &tracker.surfaces()[tracker.slave(0)].nodes;
        let placed = Placed { surface: &self.target, positions };
        let triangles: Vec<[u32; 3]> = self.target.facets.iter().flat_map(halves).collect();
        let width = |facet: u32| placed.area(facet).sqrt();
        let widest = (0..self.target.facets.len() as u32).map(width).fold(0.0, f64::max);
        // The middle of a facet of four nodes may be off both halves, by less than its width.
        let reach = thickness + 1.01 * NEAR * widest + bend(&self.target, positions);
        let query = Query { positions_old: positions, positions_new: positions, slaves, facets: &triangles, reach };
        let mut pairs = Vec::new();
        search.pairs(&query, &mut pairs);
        for of_slave in pairs.chunk_by(|a, b| a.slave == b.slave) {
            let slave = of_slave[0].slave;
            let node = slaves[slave as usize];
            if self.target.nodes.binary_search(&node).is_ok() {
                continue;
            }
            let mut facets: Vec<u32> = of_slave.iter().map(|pair| pair.facet / 2).collect();
            facets.sort_unstable();
            facets.dedup();
            let mut best: Option<(f64, u32, usize)> = None;
            for facet in facets {
                if let Some((distance, triangle)) = placed.nearest_triangle(positions[node as usize], facet)
                    && distance <= thickness + NEAR * width(facet)
                    && best.is_none_or(|(nearest, ..)| distance < nearest)
                {
                    best = Some((distance, facet, triangle));
                }
            }
            if let Some((_, facet, triangle)) = best
                && let Some((place, gap, _)) = placed.above(positions[node as usize], facet, triangle)
            {
                let (stiffness, area) = (input.stiffness(slave as usize, facet), input.slaves[slave as usize].area);
                self.bound[slave as usize] = true;
                self.ties.push(Tie { node, slave, facet, triangle: triangle as u32, place, gap, stiffness, area });
            }
        }
    }
}

impl Formulation<3> for TiedFacet {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        let positions = scene.sweep.new;
        self.bind(positions);
        let placed = Placed { surface: &self.target, positions };
        for tie in &self.ties {
            let (x, triangle) = (positions[tie.node as usize], tie.triangle as usize);
            let corners = placed.triangle(tie.facet, triangle);
            // A triangle without area is the elements' to tell; the tie does nothing.
            let (weights, gap, normal) = placed.above(x, tie.facet, triangle).unwrap_or((tie.place, tie.gap, [0.0, 0.0, 1.0]));
            let at = |shares: Vector| [0, 1, 2].map(|d| (0..3).map(|k| shares[k] * corners[k][d]).sum::<f64>());
            let (foot, place) = (at(weights), at(tie.place));
            let along = tangent(normal, first_edge(&placed, tie.facet));
            let off = [0, 1, 2].map(|d| foot[d] - place[d]);
            let slip = Dim::<3>::tangents(normal, &along).map(|t| dot(t, off));
            // Forces act at the present foot of the node, so that both are collinear.
            let (facet, weights) = (tie.facet, placed.spread(tie.facet, triangle, weights));
            let projection = Projection { facet, feature: Feature::Face, triangle, weights, foot, gap, normal };
            let (ends, known) = ends(&placed, tie.node, &projection);
            let (stiffness, area, side, gap) = (tie.stiffness, tie.area, self.side, gap - tie.gap);
            springs.push(Spring { normal, gap, stiffness, area, side, slip, tangent: along, ..Spring::default() }, &ends[..known]);
        }
        springs.close_group(self.terms);
        self.loose.detect_free(&self.bound, scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
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
            let pull = (-answer.solved.force).max(0.0);
            let [s, t] = answer.solved.friction;
            let holds = (pull * pull + s * s + t * t).sqrt() <= strength * tie.area;
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
            let facet = target.facets.get(tie.facet as usize);
            let triangles = facet.map_or(0, |facet| if facet.corners().len() == 3 { 1 } else { 4 });
            (tie.node as usize) < archive.nodes && (tie.slave as usize) < bound.len() && tie.triangle < triangles
        };
        archive.check(ties.iter().all(is_tie), "a tie binds what is not there")?;
        loose.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        let Self { target: before, ties, unborn, loose, broken, .. } = *old;
        self.loose.inherit(Box::new(loose));
        self.broken = broken;
        if unborn.is_some() || self.unborn.take().is_none() {
            return;
        }
        let tracker = self.loose.tracker();
        let slaves = &tracker.surfaces()[tracker.slave(0)].nodes;
        let mut by_nodes: Vec<([u32; 4], u32)> = self.target.facets.iter().copied().zip(0..).collect();
        by_nodes.sort_unstable();
        for tie in ties {
            let facet = before.facets[tie.facet as usize];
            let at = by_nodes.binary_search_by_key(&facet, |&(nodes, _)| nodes).ok().map(|at| by_nodes[at].1);
            // Ties go with the elements on either side.
            match (at, slaves.binary_search(&tie.node)) {
                (Some(facet), Ok(slave)) => {
                    self.bound[slave] = true;
                    self.ties.push(Tie { slave: slave as u32, facet, ..tie });
                }
                _ => self.broken += 1,
            }
        }
    }

    fn within(&self) -> Option<&dyn Formulation<3>> {
        Some(&self.loose)
    }

    fn freed(&self) -> f64 {
        self.freed
    }

    fn ties(&self) -> Option<Ties> {
        Some(Ties { nodes: self.ties.iter().map(|tie| tie.node).collect(), broken: self.broken })
    }
}
