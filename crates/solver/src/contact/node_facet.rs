//! Nodes against facets of surfaces in 3D: a spring for each slave node, in a single pass, a double pass,
//! or of a surface with itself; in the latter two also edges against edges ([`super::edge_edge`]), which
//! share friction, thickness and memory with the nodes.
//!
//! Where the nodes lie comes from the [`Tracker`]; friction and thickness are those of the slave node, the
//! stiffness that of the softer side where they meet. The rows of a spring are the gradient of its gap
//! (`projection/node_facet.rs`), so resultant, momentum and angular momentum are exact, and what slides over
//! an edge or a corner keeps its energy as far as half steps see the turn of the normal.

mod ends;
mod far;
pub(super) mod groups;
pub mod make;
mod measured;
pub(super) mod passage;
mod tied;
pub mod tracker;

use super::checked::Look;
use super::continuity::{Closed, Continuity, SpringHistory};
use super::edge_edge::{self, Around, EdgeTouch, EdgeTracker};
use super::findings::Findings;
use super::law::penalty::stiffening;
use super::missed_contacts::MissedContactCheck;
use super::overlap::OverlapCheck;
use super::projection::edge_edge::distance;
use super::projection::node_facet::{Placed, Projection, Vector, unit};
use super::search::Search;
use super::slaves::{Face, PassInput};
use super::spin;
use super::springs::friction::cone;
use super::springs::{Answer, Answers, End, Slip, Spring, Springs, Stiffening};
use super::tracker::{Certificate, SearchReport};
use super::{Formulation, Origins, Scene, Sweep, both};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::contact::springs::TangentSpace;
use crate::mesh::surface::{Corners, NONE};
use crate::model;
use crate::tensor::{Dim, dot};
use crate::vector::any_tangent;
pub use ends::ends;
use ends::{ends_with, pushed};
use std::any::Any;
use std::collections::BTreeMap;
use tracker::{ContactHistory, ContactPoint, Tracker};

/// The formulation.
pub struct NodeFacet {
    tracker: Tracker,
    /// Edges against edges, if they meet.
    edges: Option<EdgeTracker>,
    /// Sweeps pairs within each step.
    proof: Option<MissedContactCheck>,
    /// Looks at the bodies as they are.
    overlap_check: Option<OverlapCheck>,
    passes: Vec<PassInput>,
    continuity: Continuity<3>,
    /// Whether springs care for slip.
    slips: bool,
    /// The touches of nodes that made springs in this step; those of edges follow.
    used: Vec<u32>,
    /// Nodes whose springs were closed after the last step, and those that edges stand for in this one: slave
    /// surface, node, and facet.
    closed_nodes: Vec<(usize, u32, u32)>,
    superseded: Vec<(usize, u32, u32)>,
    /// Whether `closed_nodes` are to be found again from what is kept of them.
    is_stale: bool,
    /// Ends of a spring beyond those of its own facet, while it is made.
    more: Vec<End<3>>,
}

impl NodeFacet {
    /// For the passes of `tracker`; `reach` of the law, m; `initial` positions, m.
    #[must_use]
    pub fn new(tracker: Tracker, passes: Vec<PassInput>, interface: &model::Interface, reach: f64, initial: &[Vector]) -> Self {
        Self {
            tracker,
            edges: None,
            proof: None,
            overlap_check: None,
            passes,
            continuity: Continuity::new(interface, reach, initial),
            slips: interface.friction.is_some(),
            used: Vec::new(),
            closed_nodes: Vec::new(),
            is_stale: false,
            superseded: Vec::new(),
            more: Vec::new(),
        }
    }

    /// The same with the edges of both surfaces against each other, or of the one against themselves; found
    /// by `search`.
    #[must_use]
    pub fn with_edges(self, search: Box<dyn Search<3>>) -> Self {
        Self { edges: Some(EdgeTracker::new(self.tracker.surfaces(), self.tracker.bodies(), search)), ..self }
    }

    /// The same with a proof that nothing is missed.
    #[must_use]
    pub fn with_proof(self, proof: MissedContactCheck) -> Self {
        Self { proof: Some(proof), ..self }
    }

    /// The same with an overlap check of overlaps.
    #[must_use]
    pub fn with_check(self, overlap_check: OverlapCheck) -> Self {
        Self { overlap_check: Some(overlap_check), ..self }
    }

    /// What follows the edges.
    #[must_use]
    pub fn edges(&self) -> Option<&EdgeTracker> {
        self.edges.as_ref()
    }

    /// What follows the nodes.
    #[must_use]
    pub fn tracker(&self) -> &Tracker {
        &self.tracker
    }

    /// As [`Continuity::gap`].
    fn gap(&self, touch: &ContactPoint) -> f64 {
        self.continuity.gap(touch.projection.gap, touch.own, |positions| {
            let placed = Placed { surface: self.tracker.target(touch.pass), positions };
            let facets = placed.surface.sharing(touch.projection.facet, placed.rests_on(&touch.projection));
            facets.map(|facet| placed.distance(positions[touch.node as usize], facet).unwrap_or(0.0)).fold(f64::INFINITY, f64::min)
        })
    }

    /// The same of edges.
    fn edge_gap(&self, touch: &EdgeTouch) -> f64 {
        self.continuity.gap(touch.crossing.gap, touch.own, |positions| {
            let [a, b] = touch.nodes.map(|edge| edge.map(|node| positions[node as usize]));
            distance(a, b)
        })
    }

    /// Finds the pairs of edges that touch.
    fn track_edges(&mut self, scene: &Scene<'_, 3>, is_searched: bool) {
        let Self { tracker, edges: Some(edges), passes, closed_nodes, continuity, .. } = self else { return };
        let (surfaces, is_new) = (tracker.surfaces(), !continuity.has_begun);
        let sweep = if is_new { Sweep { old: scene.sweep.new, ..scene.sweep } } else { scene.sweep };
        let around = around(tracker, sweep, is_new, [continuity.thickness + continuity.reach, continuity.reach]);
        if is_searched {
            edges.find(&around);
        }
        let sides = edges.sides();
        let is_held = |of: usize, node: u32, facet: u32| closed_nodes.binary_search(&(sides[of], node, facet)).is_ok();
        // Both passes carry a node and a facet together: so do both sides the edges.
        let make = |touch: &EdgeTouch| {
            let (mut stiffness, mut area, mut of_mass, mut thickness) = (0.0, 0.0, 0.0, f64::INFINITY);
            for of in 0..2 {
                let (slave, target) = (&surfaces[sides[of]], &surfaces[sides[1 - of]]);
                let pass = passes.iter().zip(0..).find(|(_, number)| tracker.slave(*number) == sides[of]);
                let facets = target.edges[touch.edges[1 - of] as usize].facets.into_iter().filter(|&facet| facet != NONE);
                for node in touch.nodes[of] {
                    if let (Some((pass, _)), Ok(rank)) = (pass, slave.nodes.binary_search(&node)) {
                        stiffness += 0.5 * pass.softest(rank, Face::WHOLE, facets.clone());
                        area += 0.5 * pass.slaves[rank].area;
                        of_mass += 0.5 * pass.of_mass(rank, facets.clone());
                        thickness = thickness.min(pass.thickness(rank, facets.clone()));
                    }
                }
            }
            (stiffness, area, stiffening(thickness, passes[0].factor(stiffness, of_mass)))
        };
        edges.track(&around, is_held, make);
    }

    /// Nodes that edges stand for, and the facets on which.
    fn find_superseded(&mut self) {
        self.superseded.clear();
        let Some(edges) = &self.edges else { return };
        let (sides, surfaces) = (edges.sides(), self.tracker.surfaces());
        let of_touch = |touch: &EdgeTouch| {
            let facets = |of: usize| surfaces[sides[of]].edges[touch.edges[of] as usize].facets;
            let mut all = [(0, 0, 0); 8];
            for k in 0..8 {
                let of = k / 4;
                all[k] = (sides[of], touch.nodes[of][k / 2 % 2], facets(1 - of)[k % 2]);
            }
            all
        };
        self.superseded.extend(edges.touches().iter().filter(|touch| touch.stands).flat_map(of_touch));
        self.superseded.sort_unstable();
    }

    /// Whether edges stand for a node that touches.
    fn is_superseded(&self, touch: &ContactPoint, scene: &Scene<'_, 3>) -> bool {
        let (surface, side) = (self.tracker.target(touch.pass), self.tracker.slave(touch.pass));
        let rest = Placed { surface, positions: scene.sweep.new }.rests_on(&touch.projection);
        surface.sharing(touch.projection.facet, rest).any(|facet| self.superseded.binary_search(&(side, touch.node, facet)).is_ok())
    }

    /// The springs of the nodes that touch, so many of them; the energy that they had. See
    /// [`Self::detect_free`].
    fn push_nodes(&mut self, (count, bound): (usize, &[bool]), scene: &Scene<'_, 3>, springs: &mut Springs<3>) -> Closed {
        self.find_superseded();
        let (mut again, reach) = (Closed::default(), self.continuity.reach);
        self.used.clear();
        for index in 0..count {
            let touch = self.tracker.touches()[index];
            if touch.pass == 0 && bound.get(touch.slave as usize).copied().unwrap_or(false) {
                continue;
            }
            // Who stands for nothing presses on nothing.
            if self.passes[touch.pass as usize].slaves[touch.slave as usize].area == 0.0 {
                continue;
            }
            let spring = &self.tracker.kept(&touch).spring;
            if !self.superseded.is_empty() && spring.half() >= reach && self.is_superseded(&touch, scene) {
                continue;
            }
            again.add(spring.stored);
            self.push_node(index, scene, springs);
            self.used.push(index as u32);
        }
        again
    }

    /// The spring of a node that touches.
    fn push_node(&mut self, index: usize, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        let touch = self.tracker.touches()[index];
        let ContactHistory { spring: history, by_area: by_area_before, .. } = *self.tracker.kept(&touch);
        let mut more = std::mem::take(&mut self.more);
        let (pass, node, slave) = (&self.passes[touch.pass as usize], touch.node, touch.slave as usize);
        let Projection { normal, facet, weights, .. } = touch.projection;
        let target = self.tracker.target(touch.pass);
        let rest = Placed { surface: target, positions: scene.sweep.new }.rests_on(&touch.projection);
        let facets = target.sharing(facet, rest);
        let (stiffness, area) = (pass.softest(slave, Face::WHOLE, facets.clone()), pass.slaves[slave].area);
        let by_area = if area > 0.0 { stiffness / area } else { 0.0 };
        let whole = self.gap(&touch);
        let history = self.continuity.moved(&history, whole, [by_area_before, by_area]);
        let (gap, offset) = self.continuity.beyond(whole, touch.own, &history);
        let (thickness, of_mass) = (pass.thickness(slave, facets.clone()), pass.of_mass(slave, facets));
        let (stiffening, side) = (stiffening(thickness, pass.factor(stiffness, of_mass)), self.tracker.side(touch.pass));
        let spring = Spring { normal, gap, stiffness, area, stiffening, side, ..Spring::default() };
        if !self.slips && weights.iter().all(|weight| *weight >= 0.0) {
            // Nearly all without friction.
            let corners = target.facets[facet as usize].into_iter().zip(weights);
            let shares = corners.filter(|(_, weight)| *weight != 0.0).map(|(corner, weight)| (corner, -weight));
            springs.push_plain(spring, std::iter::once((node, 1.0)).chain(shares));
        } else {
            self.push_whole(&touch, (spring, rest), scene, (springs, &mut more));
        }
        self.continuity.resume(&history, springs);
        self.more = more;
        let kept = self.tracker.kept_mut(&touch);
        (kept.spring.offset, kept.spring.normal, kept.spring.stored) = (offset, normal, 0.0);
        (kept.facet, kept.rest, kept.by_area) = (facet, rest, by_area);
    }

    /// The same with slip and rims.
    fn push_whole(
        &self,
        touch: &ContactPoint,
        (spring, rest): (Spring<3>, [u32; 2]),
        scene: &Scene<'_, 3>,
        (springs, more): (&mut Springs<3>, &mut Vec<End<3>>),
    ) {
        let Projection { normal, facet, .. } = touch.projection;
        let placed = Placed { surface: self.tracker.target(touch.pass), positions: scene.sweep.new };
        if !self.slips {
            let (ends, known) = pushed(&placed, touch.node, &touch.projection);
            springs.push(spring, Slip::default(), &ends[..known]);
            return;
        }
        let facets = placed.surface.sharing(facet, rest);
        let tangent = tangent(normal, first_edge(&placed, facet));
        let (ends, known) = ends_with(&placed, (touch.node, &touch.projection), &tangent, facets.clone(), more);
        let slip = cone::carried(slip(&placed, self.tracker.kept(touch).slip, facets, scene.sweep), Dim::<3>::tangents(normal, &tangent));
        springs.push_with(spring, Slip { slip, tangent }, ends[..known].iter().chain(&*more));
    }

    /// The spring of edges that touch; the energy that it had, J.
    fn push_edges(&mut self, at: usize, scene: &Scene<'_, 3>, springs: &mut Springs<3>) -> f64 {
        let Some(edges) = &self.edges else { return 0.0 };
        let touch = edges.touches()[at];
        let touch = &touch;
        let (pair, positions, normal) = (*edges.kept(touch), scene.sweep.new, touch.crossing.normal);
        let side = if edges.sides()[0] == edges.sides()[1] { 0.0f32 } else { 1.0 };
        let tangent = edge_edge::tangent(touch, positions);
        let ends = edge_edge::ends(touch, tangent, positions);
        let (gap, offset) = self.continuity.beyond(self.edge_gap(touch), touch.own, &pair.memory.spring);
        // It turns with both edges alike: which is the first says nothing.
        let turn = || spin::turn(touch.nodes.iter().map(|nodes| &nodes[..]), scene.sweep);
        let slip = if pair.memory.slip == [0.0; 3] { [0.0; 3] } else { spin::turned(pair.memory.slip, turn()) };
        let slip = cone::carried(slip, Dim::<3>::tangents(normal, &tangent));
        let (stiffness, area, stiffening) = (pair.stiffness, pair.area, pair.stiffening);
        springs.push(Spring { normal, gap, stiffness, area, stiffening, side, ..Spring::default() }, Slip { slip, tangent }, &ends);
        self.continuity.resume(&pair.memory.spring, springs);
        if let Some(edges) = &mut self.edges {
            let spring = SpringHistory { offset, normal, stored: 0.0, ..pair.memory.spring };
            edges.kept_mut(touch).memory = ContactHistory { spring, facet: touch.edges[1], ..pair.memory };
        }
        pair.memory.spring.stored
    }
}

impl NodeFacet {
    /// [`Formulation::detect`] for those slaves of the first pass that are not bound otherwise (`bound` by
    /// index; empty: all).
    fn detect_free(&mut self, bound: &[bool], scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        let Continuity { thickness, reach, .. } = self.continuity;
        if self.edges.is_some() && std::mem::take(&mut self.is_stale) {
            self.tracker.note_closed(reach, &mut self.closed_nodes);
        }
        let searches = self.tracker.search_report().searches;
        let count = self.tracker.track(scene.sweep, thickness + reach).len();
        let is_searched = self.tracker.search_report().searches != searches;
        self.track_edges(scene, is_searched);
        // The bodies know nothing of springs.
        let mut overlap_check = self.overlap_check.take();
        let look = || overlap_check.as_mut().into_iter().for_each(|overlap_check| overlap_check.see_step(scene));
        let ((), mut again) = both(look, || {
            if let Some(proof) = &mut self.proof {
                proof.look_at(&self.tracker, self.edges.as_ref(), scene.sweep);
            }
            self.push_nodes((count, bound), scene, springs)
        });
        self.overlap_check = overlap_check;
        for at in 0..self.edges.as_ref().map_or(0, |edges| edges.touches().len()) {
            again.add(self.push_edges(at, scene, springs));
        }
        if let Some(overlap_check) = &mut self.overlap_check {
            overlap_check.push_nets(springs, |stored| again.add(stored));
        }
        self.continuity.found(&again);
    }
}

impl Formulation<3> for NodeFacet {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        self.detect_free(&[], scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        let (nodes, count) = (self.used.len(), self.edges.as_ref().map_or(0, |edges| edges.touches().len()));
        let closed = self.continuity.begin_notes();
        if let Some(overlap_check) = &mut self.overlap_check {
            overlap_check.note_nets(solved.part(nodes + count, usize::MAX), |stored| closed.add(stored));
            overlap_check.weigh(&solved);
        }
        let (nodes, edges) = (solved.part(0, nodes), solved.part(nodes, nodes + count));
        let (slips, reach, continuity) = (self.slips, self.continuity.reach, &mut self.continuity);
        let mut note = |memory: &mut ContactHistory, answer: &Answer<'_, 3>| {
            if slips {
                let ([first, second], [a, b]) = (answer.tangents(), answer.slid().slip_new);
                memory.slip = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
            }
            memory.carried = answer.solved.gap - answer.spring.gap;
            continuity.note(&mut memory.spring, answer);
        };
        // Nothing is solved while the contact does not act.
        let mut nodes = nodes;
        self.closed_nodes.clear();
        for &index in &self.used {
            let touch = self.tracker.touches()[index as usize];
            let memory = self.tracker.kept_mut(&touch);
            if let Some(answer) = nodes.next() {
                note(memory, &answer);
            }
            if self.edges.is_some() && memory.spring.half() < reach {
                self.closed_nodes.extend(self.tracker.lay_on(&touch));
            }
        }
        self.closed_nodes.sort_unstable();
        if let Some(pairs) = &mut self.edges {
            for (at, answer) in edges.enumerate() {
                let touch = pairs.touches()[at];
                note(&mut pairs.kept_mut(&touch).memory, &answer);
            }
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            passes: _, slips: _, used: _, closed_nodes: _, superseded: _, more: _,
            tracker, edges, proof, overlap_check, continuity, is_stale,
        } = self;
        *is_stale |= archive.reads();
        tracker.persist(archive)?;
        if let Some(proof) = proof {
            proof.persist(archive, tracker.surfaces())?;
        }
        if let Some(edges) = edges {
            edges.persist(archive, tracker.surfaces())?;
        }
        if let Some(overlap_check) = overlap_check {
            overlap_check.persist(archive)?;
        }
        continuity.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            // What is not found again went with its surface.
            self.tracker.inherit(&old.tracker);
            if let (Some(edges), Some(before)) = (&mut self.edges, &old.edges) {
                edges.inherit(before, [old.tracker.surfaces(), self.tracker.surfaces()], Some);
            }
            if let (Some(proof), Some(before)) = (&mut self.proof, &old.proof) {
                proof.inherit(before, self.tracker.surfaces());
            }
            if let (Some(overlap_check), Some(before)) = (&mut self.overlap_check, &old.overlap_check) {
                overlap_check.inherit(before);
            }
            self.continuity.has_begun = old.continuity.has_begun;
            self.is_stale = true;
        }
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, 3>) {
        let Some(old) = old.downcast_ref::<Self>() else { return };
        self.tracker.carry(&old.tracker, origins, |touch| old.gap(touch) - old.tracker.kept(touch).spring.offset);
        let surfaces = self.tracker.surfaces();
        if let (Some(edges), Some(before)) = (&mut self.edges, &old.edges) {
            // Between nodes that are as they were; others are found again.
            let as_before = origins.nodes.iter().zip(0..).filter(|(own, _)| matches!(own[..], [(_, 1.0)]));
            let numbers: BTreeMap<u32, u32> = as_before.map(|(own, node)| (own[0].0, node)).collect();
            edges.inherit(before, [old.tracker.surfaces(), surfaces], |node| numbers.get(&node).copied());
        }
        if let (Some(proof), Some(before)) = (&mut self.proof, &old.proof) {
            proof.carry(before, surfaces, (old.tracker.bodies(), self.tracker.bodies()), origins);
        }
        if let (Some(overlap_check), Some(before)) = (&mut self.overlap_check, &old.overlap_check) {
            overlap_check.inherit(before);
        }
        self.continuity.carry(&old.continuity);
        self.is_stale = true;
    }

    fn overlaps(&self) -> Option<&Findings> {
        self.overlap_check.as_ref().map(OverlapCheck::findings)
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.overlap_check.as_ref().map_or(&[], OverlapCheck::inside)
    }

    fn thinnest(&self) -> f64 {
        self.overlap_check.as_ref().map_or(f64::INFINITY, OverlapCheck::thinnest)
    }

    fn certificate(&self) -> Certificate {
        self.proof.as_ref().map(MissedContactCheck::certificate).unwrap_or_default()
    }

    fn lost_contact_energy(&self) -> f64 {
        self.continuity.lost_contact_energy
    }

    fn search_report(&self) -> Option<SearchReport> {
        let report = self.tracker.search_report();
        let edges = self.edges.as_ref().map_or(0, EdgeTracker::candidates);
        Some(SearchReport { candidates: report.candidates + edges, ..report })
    }
}

/// What a tracker of nodes, which has looked at the same step, reports to one of edges; the law pushes up to
/// the distance `extra`, thickness included, and springs are closed below the gap `open`, m.
fn around<'a>(tracker: &'a Tracker, sweep: Sweep<'a, 3>, is_new: bool, [extra, open]: [f64; 2]) -> Around<'a> {
    let [radius, skin] = tracker.reach();
    Around { surfaces: tracker.surfaces(), sweep, is_new, radius, skin, near: tracker.near(), extra, open }
}

/// Edges that cross other bodies' at the start, or are nearer than `thickness` (m) there; `tracker` has
/// looked at the nodes.
#[must_use]
pub fn edges_at_start(tracker: &Tracker, search: Box<dyn Search<3>>, positions: &[Vector], thickness: f64) -> Vec<EdgeTouch> {
    let around = around(tracker, Sweep::between(positions, positions), true, [thickness, 0.0]);
    let mut edges = EdgeTracker::new(tracker.surfaces(), tracker.bodies(), search);
    edges.find(&around);
    edges.track(&around, |_, _, _| false, |_| (0.0, 0.0, Stiffening::default())).to_vec()
}

/// A facet's first edge, m.
fn first_edge(placed: &Placed<'_>, facet: u32) -> Vector {
    let [a, b, ..] = placed.surface.facets[facet as usize].map(|node| placed.positions[node as usize]);
    [0, 1, 2].map(|d| b[d] - a[d])
}

/// The unit vector at right angles to a unit vector that is nearest to a direction.
fn tangent(normal: Vector, direction: Vector) -> Vector {
    let along = dot(direction, normal);
    let across = unit([0, 1, 2].map(|d| direction[d] - along * normal[d]));
    // A direction along the normal has none.
    if dot(across, across) > 0.5 && dot(across, normal).abs() < 1e-6 { across } else { any_tangent(normal) }
}

/// The elastic slip of the step before, turned as the facets together turn in the step on which it lies,
/// whichever of their corners is the first.
fn slip(placed: &Placed<'_>, slip: Vector, facets: impl Iterator<Item = u32>, sweep: Sweep<'_, 3>) -> Vector {
    if slip == [0.0; 3] {
        return slip;
    }
    spin::turned(slip, spin::turn(facets.map(|facet| placed.surface.facets[facet as usize].corners()), sweep))
}

#[cfg(test)]
mod tests;
