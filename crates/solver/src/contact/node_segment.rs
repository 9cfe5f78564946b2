//! Nodes against segments: a spring for each slave node, in a single pass, a double pass, or of a surface
//! with itself.
//!
//! Where the nodes lie comes from the [`Tracker`]; friction and thickness are those of the slave node, the
//! stiffness that of the softer side where they meet.

mod fold;
mod tied;

use super::checked::Look;
use super::continuity::{Closed, Continuity, SpringHistory};
use super::depths::Depths;
use super::findings::Findings;
use super::formulation::{FormulationKind, Setup, both_passes, one_pass};
use super::law::penalty::{at_obstacles, penalty_of, stiffening};
use super::node_facet::NodeFacet;
use super::projection::node_segment::{Projection, Target};
use super::slaves::{PassInput, Slave};
use super::springs::{Answers, End, Slip, Spring, Springs, tangent};
use super::tracker::{Certificate, ContactHistory, ContactPoint, SearchReport, Tracker, is_facing};
use super::{Formulation, Origins, Scene, Vector};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::mesh::surface::NONE;
use crate::model;
use fold::{other_at_node, turn_with_both};
use std::any::Any;

/// Registry entry.
pub const DOUBLE_PASS: FormulationKind = FormulationKind {
    name: "double_pass",
    doc: "nodes against segments or facets; each surface is slave once and target once in every force evaluation",
    source: "Bittencourt and Creus (1995)",
    passes: both_passes,
    tied: Some(&super::tied::NODES),
    is_carried: true,
    in_2d: Some(|setup| Ok(Box::new(NodeSegment::of(setup)))),
    in_3d: Some(|setup| Ok(Box::new(NodeFacet::checked(setup)))),
};

/// Registry entry.
pub const SINGLE_PASS: FormulationKind = FormulationKind {
    name: "single_pass",
    doc: "nodes against segments or facets; only the nodes of the slave surface are checked against the other one",
    source: "Bittencourt and Creus (1995)",
    passes: one_pass,
    tied: Some(&super::tied::NODES),
    is_carried: true,
    in_2d: Some(|setup| Ok(Box::new(NodeSegment::of(setup)))),
    in_3d: Some(|setup| Ok(Box::new(NodeFacet::checked(setup)))),
};

/// The formulation.
pub struct NodeSegment {
    tracker: Tracker,
    passes: Vec<PassInput>,
    continuity: Continuity<2>,
    /// Whether springs care for slip.
    slips: bool,
    /// The touches of this step that made springs.
    used: Vec<u32>,
    /// How deep nodes are against the local thickness.
    depths: Depths,
}

/// Both faces of a node.
const BOTH: u8 = 3;

impl NodeSegment {
    /// For the passes of a contact. Where it ignores initial penetrations, gaps that are negative when it
    /// begins to act count as zero until the surfaces part.
    #[must_use]
    pub fn of(mut setup: Setup<'_, 2>) -> Self {
        let passes = setup.passes;
        // A surface that meets itself is met from both sides.
        let sides = if setup.sides.len() == 1 { 2 } else { passes.len() };
        let pass = |&pass: &(usize, usize)| PassInput { faces: setup.faces(pass.0), ..setup.input(pass, sides) };
        let inputs = passes.iter().map(pass).collect();
        let (interface, reach) = (&setup.contact.interface, (setup.law)().reach());
        let (tracker, continuity) = (setup.tracker().with_ends(setup.positions), Continuity::new(interface, reach, setup.positions));
        Self { passes: inputs, continuity, depths: setup.overlap_check, ..Self::new(tracker, Vec::new(), interface, reach) }
    }

    /// Of an obstacle, for the passes of `tracker` with slaves whose stiffness is known; `reach` of the law,
    /// m.
    #[must_use]
    pub fn new(tracker: Tracker, slaves: Vec<Vec<Slave>>, interface: &model::Interface, reach: f64) -> Self {
        let factor = at_obstacles(penalty_of(interface));
        let passes = slaves.into_iter().map(|slaves| PassInput { slaves, at_obstacle: Some(factor), ..PassInput::default() }).collect();
        let (continuity, slips) = (Continuity::new(interface, reach, &[]), interface.friction.is_some());
        Self { tracker, passes, continuity, slips, used: Vec::new(), depths: Depths::default() }
    }

    /// The same with what is known of depths, and of each pass the thickness of the bodies at its slaves, m
    /// (empty: not known).
    #[must_use]
    pub fn with_depths(self, depths: Depths, thickness: Vec<Vec<f64>>) -> Self {
        let passes = self
            .passes
            .into_iter()
            .zip(thickness)
            .map(|(pass, thickness)| PassInput { thickness: [thickness, Vec::new()], ..pass })
            .collect();
        Self { passes, depths, ..self }
    }

    /// As [`Continuity::gap`].
    fn gap(&self, touch: &ContactPoint) -> f64 {
        self.continuity.gap(touch.projection.gap, touch.own, |initial| {
            let target = self.tracker.target(touch.pass);
            target.distance(initial[touch.node as usize], touch.projection.segment, initial).unwrap_or(0.0)
        })
    }
}

impl NodeSegment {
    /// Which of the segments at a slave stand for it in a touch. At a sharp edge that is the one that faces
    /// the target, so that the corner of a block presses with half of the segment under it and not with the
    /// side wall; else, and where none faces the target, both. It stays so for as long as they are near: a
    /// spring that is closed may not change its stiffness.
    fn faces(&self, touch: &ContactPoint, memory: &ContactHistory, positions: &[Vector]) -> u8 {
        if memory.faces != 0 {
            return memory.faces;
        }
        let ([before, after], slaves) = self.tracker.segments_at(touch);
        if before == NONE || after == NONE || !slaves.is_edge(before, after, positions) {
            return BOTH;
        }
        // Of a corner of the target the direction to it counts.
        let along = tangent(touch.projection.normal);
        let faces = [before, after].map(|own| u8::from(is_facing(slaves.along(own, positions), along)));
        match faces[0] + 2 * faces[1] {
            0 => BOTH,
            faces => faces,
        }
    }

    /// [`Formulation::detect`] for those slaves of the first pass that are not bound otherwise (`bound` by
    /// index; empty: all).
    pub(super) fn detect_free(&mut self, bound: &[bool], scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        let count = self.tracker.track(scene.sweep, self.continuity.thickness + self.continuity.reach).len();
        self.used.clear();
        self.depths.begin(scene);
        let mut again = Closed::default();
        for index in 0..count {
            let touch = self.tracker.touches()[index];
            let slave = touch.slave as usize;
            if touch.pass == 0 && bound.get(slave).copied().unwrap_or(false) {
                continue;
            }
            let memory = *self.tracker.kept(&touch);
            again.add(memory.spring.stored);
            let pass = &self.passes[touch.pass as usize];
            let target = self.tracker.target(touch.pass);
            let mut ends = ends(touch.node, &touch.projection, target, scene.sweep.new);
            let Projection { normal, segment, .. } = touch.projection;
            let faces = self.faces(&touch, &memory, scene.sweep.new);
            let part = pass.part(slave, faces);
            let other = other_at_node(touch.node, &touch.projection, target);
            let stiffness = pass.softest(slave, part, std::iter::once(segment).chain(other));
            let area = part.length * pass.slaves[slave].area;
            let by_area = if area > 0.0 { stiffness / area } else { 0.0 };
            let history = self.continuity.pressing(&memory.spring, self.gap(&touch), [memory.stiffness, by_area]);
            let (gap, offset) = self.continuity.beyond(self.gap(&touch), touch.own, &history);
            let thickness = self.depths.thickness(self.tracker.around(&touch)).min(pass.thickness(slave, None));
            self.depths.see(&self.tracker, &touch, offset - touch.projection.gap, thickness, scene);
            let stiffening = stiffening(thickness, pass.factor(stiffness, pass.of_mass(slave, [segment])));
            if touch.slope != 0.0 {
                lean(&mut ends, &touch, scene.sweep.new);
            }
            let (side, slip) = (self.tracker.side(touch.pass), Slip::of([memory.slip]));
            let spring = Spring { normal, gap, stiffness, area, stiffening, side, ..Spring::default() };
            match other.filter(|_| self.slips).map(|other| turn_with_both(&mut ends, &touch.projection, other, target, scene.sweep.new)) {
                None => springs.push(spring, slip, &ends),
                Some(more) => springs.push_with(spring, slip, ends.iter().chain([&more])),
            }
            self.continuity.resume(&memory.spring, springs);
            let spring = SpringHistory { offset, normal, stored: 0.0, ..memory.spring };
            *self.tracker.kept_mut(&touch) = ContactHistory { spring, faces, stiffness: by_area, ..memory };
            self.used.push(index as u32);
        }
        self.depths.end();
        self.continuity.found(&again);
    }
}

impl Formulation<2> for NodeSegment {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        self.detect_free(&[], scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        self.continuity.begin_notes();
        for (&index, answer) in self.used.iter().zip(solved) {
            let touch = self.tracker.touches()[index as usize];
            let memory = self.tracker.kept_mut(&touch);
            memory.slip = answer.slid().slip_new[0];
            self.continuity.note(&mut memory.spring, &answer);
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { passes: _, slips: _, used: _, tracker, continuity, depths } = self;
        tracker.persist(archive)?;
        continuity.persist(archive)?;
        depths.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            // What is not found again went with its surface.
            self.tracker.inherit(&old.tracker);
            self.continuity.has_begun = old.continuity.has_begun;
            self.depths.inherit(&old.depths);
        }
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, 2>) {
        let Some(old) = old.downcast_ref::<Self>() else { return };
        self.tracker.carry(&old.tracker, origins);
        self.continuity.carry(&old.continuity);
        self.depths.inherit(&old.depths);
    }

    fn lost_contact_energy(&self) -> f64 {
        self.continuity.lost_contact_energy
    }

    fn certificate(&self) -> Certificate {
        self.tracker.certificate()
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.depths.findings())
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.depths.inside()
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(self.tracker.search_report())
    }
}

/// The ends of a spring between a node and where it projects.
///
/// The slip rate is that of the node against the target at the node's own distance, ṡ = t·(v − Σ Φ v_C) − g
/// θ̇ with the rate θ̇ at which the segment turns: it does not see rotations of both together, and its
/// transpose, the friction, keeps the angular momentum.
#[must_use]
pub fn ends(node: u32, projection: &Projection, target: &Target, positions: &[Vector]) -> [End<2>; 3] {
    let segment = target.surface.segments[projection.segment as usize];
    let [wa, wb] = projection.weights;
    let [xa, xb] = segment.map(|node| positions[node as usize]);
    let x = positions[node as usize];
    let foot = [wa * xa[0] + wb * xb[0], wa * xa[1] + wb * xb[1]];
    let arm = (x[0] - foot[0]) * projection.normal[0] + (x[1] - foot[1]) * projection.normal[1];
    let [a, b] = segment_ends(segment, projection, arm, positions);
    [End::node(node, 1.0), a, b]
}

/// The nodes of a segment as ends of a spring to what is seen from its foot at the distance `arm` (m), and
/// slides there.
#[must_use]
pub fn segment_ends([a, b]: [u32; 2], projection: &Projection, arm: f64, positions: &[Vector]) -> [End<2>; 2] {
    let Projection { weights: [wa, wb], normal, .. } = *projection;
    let (xa, xb) = (positions[a as usize], positions[b as usize]);
    let along = [xb[0] - xa[0], xb[1] - xa[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    // arm / L times the segment's normal
    let turn = if square > 0.0 { [-along[1] * arm / square, along[0] * arm / square] } else { [0.0; 2] };
    let t = tangent(normal);
    // A weight is negative beyond the end of a face: such a node is pulled along, but belongs to the target
    // all the same.
    let end = |at: u32, weight: f64, sign: f64| {
        let (share, beyond) = (-weight.max(0.0), (-weight).max(0.0));
        let of = |row: Vector, d: usize| beyond * row[d];
        End { at, share, lean: [0, 1].map(|d| of(normal, d)), turn: [[0, 1].map(|d| of(t, d) + sign * turn[d])], ..End::default() }
    };
    [end(a, wa, -1.0), end(b, wb, 1.0)]
}

/// Adds to the rows of the gap those of what the face has fallen off at a distance d beyond its end, φ(d),
/// with the slope φ'.
///
/// d = ± t·(x − C) with the segment's direction t and its nearer end C, so dd = ± [t·(dx − dC) + h n·(dx_C2 −
/// dx_C1) / L] with the height h of the node over the segment's line. The whole gradient, so no energy is
/// lost, and d does not see motions of node and segment together, so both momenta are exact.
fn lean(ends: &mut [End<2>; 3], touch: &ContactPoint, positions: &[Vector]) {
    let Projection { weights: [before, place], normal, .. } = touch.projection;
    let t = tangent(normal);
    let along = |k: usize| positions[ends[k].at as usize];
    let ([x, a, b], whole) = ([0, 1, 2].map(along), |a: Vector, b: Vector| (a[0] - b[0]) * t[0] + (a[1] - b[1]) * t[1]);
    let height = (x[0] - a[0]) * normal[0] + (x[1] - a[1]) * normal[1];
    let turned = height / whole(b, a);
    let (slope, nearer) = if place > before { (touch.slope, 2) } else { (-touch.slope, 1) };
    for (k, end) in ends.iter_mut().enumerate() {
        let straight = f64::from(u8::from(k == 0)) - f64::from(u8::from(k == nearer));
        let turned = [0.0, -turned, turned][k];
        end.lean = [0, 1].map(|d| end.lean[d] + slope * (straight * t[d] + turned * normal[d]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::projection::node_segment::fall_off;
    use crate::mesh::surface::Surface;

    /// An open segment from node 1 to node 2 and a node 0 beside one of its ends.
    fn beside(x: Vector) -> (Target, [Vector; 3]) {
        let surface = Surface::<2> { segments: vec![[1, 2]], previous: vec![NONE], next: vec![NONE], nodes: vec![1, 2] };
        (Target { surface, mirrors: Vec::new() }, [x, [0.1, 0.2], [1.3, 0.7]])
    }

    #[test]
    fn beyond_an_end_the_rows_are_the_gradient_of_the_gap_and_blind_to_rigid_motion() {
        let band = 0.1;
        for x in [[1.36, 0.70], [1.35, 0.715], [1.5, 0.6], [0.0, 0.1], [0.05, 0.17]] {
            let (target, positions) = beside(x);
            let gap = |positions: &[Vector]| target.beyond(positions[0], 0, band, positions).unwrap().gap;
            let projection = target.beyond(x, 0, band, &positions).unwrap();
            let slope = fall_off(target.seen(x, 0, &positions).unwrap().beyond(), band)[1];
            assert!(slope > 0.0, "{x:?}");
            let touch = ContactPoint { pass: 0, slave: 0, node: 0, projection, slope, group: 0, own: false };
            let mut ends = ends(0, &projection, &target, &positions);
            lean(&mut ends, &touch, &positions);
            let row = |end: &End<2>| [0, 1].map(|d| end.share * projection.normal[d] + end.lean[d]);
            let (mut sum, mut moment) = ([0.0; 2], 0.0);
            for end in &ends {
                let (row, place) = (row(end), positions[end.at as usize]);
                for d in 0..2 {
                    let moved = |by: f64| {
                        let mut positions = positions;
                        positions[end.at as usize][d] += by;
                        gap(&positions)
                    };
                    let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                    assert!((row[d] - slope).abs() < 1e-8, "{x:?} node {} {d}: {} {slope}", end.at, row[d]);
                    sum[d] += row[d];
                }
                moment += place[0] * row[1] - place[1] * row[0];
                assert!(end.at == 0 || end.share <= 0.0, "the target's nodes are the target's");
            }
            assert!(sum[0].abs() + sum[1].abs() + moment.abs() < 1e-14, "{x:?}: {sum:?} {moment}");
            // Friction does not see rotations of both together either.
            let t = tangent(projection.normal);
            let spin: f64 = ends
                .iter()
                .map(|end| {
                    let ([x, y], slip) = (positions[end.at as usize], [0, 1].map(|d| end.share * t[d] + end.turn[0][d]));
                    x * slip[1] - y * slip[0]
                })
                .sum();
            assert!(spin.abs() < 1e-14, "{x:?}: {spin}");
        }
    }
}
