//! Nodes against segments: a spring for each slave node, in a single pass, a double pass, or of a surface with itself.
//!
//! Where the nodes lie comes from the [`Tracker`]; friction and thickness are those of the slave node, the stiffness that of the softer side where they meet.

use super::formulation::{FormulationKind, Setup, both_passes, one_pass};
use super::initial::{is_ignored, kept};
use super::projection::node_segment::{Projection, Target};
use super::springs::{End, Spring, Springs};
use super::tracker::{Certificate, Memory, SearchReport, Touch, Tracker};
use super::{Formulation, Scene, Vector};
use crate::model;

/// Registry entry.
pub const DOUBLE_PASS: FormulationKind = FormulationKind {
    name: "double_pass",
    doc: "nodes against segments; each surface is slave once and target once in every force evaluation",
    source: "Bittencourt and Creus (1995)",
    passes: both_passes,
    make: |setup| Ok(Box::new(NodeSegment::of(setup))),
};

/// Registry entry.
pub const SINGLE_PASS: FormulationKind = FormulationKind {
    name: "single_pass",
    doc: "nodes against segments; only the nodes of the slave surface are checked against the other one",
    source: "Bittencourt and Creus (1995)",
    passes: one_pass,
    make: |setup| Ok(Box::new(NodeSegment::of(setup))),
};

/// The formulation.
pub struct NodeSegment {
    tracker: Tracker,
    passes: Vec<PassInput>,
    /// Distance that the surfaces keep, m.
    thickness: f64,
    /// Largest gap at which the law pushes, m.
    reach: f64,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    /// Initial positions, m: only where a surface meets itself at a distance.
    initial: Vec<Vector>,
    has_begun: bool,
    /// What was found in this step.
    touches: Vec<Touch>,
}

/// What a pass knows of its nodes and segments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassInput {
    /// Slave nodes in the order of their surface; stiffness as their own side gives it.
    pub slaves: Vec<Slave>,
    /// Stiffness (N/m per metre of depth) of each slave by unit of pressure stiffness κ (Pa/m) of the target; empty where the stiffness is given.
    pub per_modulus: Vec<f64>,
    /// Smallest κ of the part behind each segment of the target, Pa/m.
    pub moduli: Vec<f64>,
}

impl PassInput {
    /// The softer of both sides decides, where they meet.
    pub(super) fn stiffness(&self, slave: usize, segment: u32) -> f64 {
        let own = self.slaves[slave].stiffness;
        self.per_modulus.get(slave).map_or(own, |per| own.min(per * self.moduli[segment as usize]))
    }
}

/// A slave node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slave {
    /// Stiffness, N/m per metre of depth.
    pub stiffness: f64,
    /// Length of surface that it stands for, m: its own, half of that where both surfaces are slaves.
    pub area: f64,
    /// Elastic slip at n − ½, m.
    pub slip: f64,
}

impl NodeSegment {
    /// For the passes of a contact. Where it ignores initial penetrations, gaps that are negative when it begins to act count as zero until the surfaces part.
    #[must_use]
    pub fn of(setup: Setup<'_>) -> Self {
        let passes = setup.passes;
        // A surface that meets itself is met from both sides.
        let sides = if setup.sides.len() == 1 { 2 } else { passes.len() };
        let pass = |&(slave, target): &(usize, usize)| PassInput {
            slaves: setup.slaves(slave, sides),
            per_modulus: setup.per_modulus(slave, sides),
            moduli: setup.sides[target].softest(),
        };
        let inputs = passes.iter().map(pass).collect();
        let (thickness, reach) = (setup.contact.interface.thickness, (setup.law)().reach());
        let initial = if thickness + reach > 0.0 { setup.positions.to_vec() } else { Vec::new() };
        let ignores_start = setup.ignores_start();
        let tracker = setup.tracker();
        Self { tracker, passes: inputs, thickness, reach, ignores_start, initial, has_begun: false, touches: Vec::new() }
    }

    /// For the passes of `tracker` with slaves whose stiffness is known; `reach` of the law, m.
    #[must_use]
    pub fn new(tracker: Tracker, slaves: Vec<Vec<Slave>>, interface: &model::Interface, reach: f64) -> Self {
        let passes = slaves.into_iter().map(|slaves| PassInput { slaves, ..PassInput::default() }).collect();
        let ignores_start = is_ignored(interface);
        let (thickness, initial, touches) = (interface.thickness, Vec::new(), Vec::new());
        Self { tracker, passes, thickness, reach, ignores_start, initial, has_begun: false, touches }
    }

    /// Gap less the thickness. A surface keeps no more distance from itself than half of what it had: neighbours along a surface are near, and stay so.
    fn gap(&self, touch: &Touch) -> f64 {
        let gap = touch.projection.gap - self.thickness;
        if !touch.own || self.initial.is_empty() {
            return gap;
        }
        let target = self.tracker.target(touch.pass);
        let distance = target.distance(self.initial[touch.node as usize], touch.projection.segment, &self.initial);
        gap + (self.thickness + self.reach - 0.5 * distance.unwrap_or(0.0)).max(0.0)
    }

    /// Gap as the spring sees it, and the gap that counts as zero.
    fn beyond(&self, touch: &Touch) -> (f64, f64) {
        let gap = self.gap(touch);
        let offset = kept(self.has_begun, touch.memory.offset, gap);
        let offset = if self.ignores_start && !touch.own { offset } else { 0.0 };
        (gap - offset, offset)
    }
}

impl NodeSegment {
    /// [`Formulation::detect`] for those slaves of the first pass that are not bound otherwise (`bound` by index; empty: all).
    pub(super) fn detect_free(&mut self, bound: &[bool], scene: &Scene<'_>, springs: &mut Springs) {
        self.touches.clear();
        self.touches.extend_from_slice(self.tracker.track(scene.sweep, self.thickness + self.reach));
        self.touches.retain(|touch| touch.pass > 0 || !bound.get(touch.slave).copied().unwrap_or(false));
        for index in 0..self.touches.len() {
            let touch = self.touches[index];
            let pass = &self.passes[touch.pass];
            let ends = ends(touch.node, &touch.projection, self.tracker.target(touch.pass), scene.sweep.new);
            let Projection { normal, segment, .. } = touch.projection;
            let (stiffness, area) = (pass.stiffness(touch.slave, segment), pass.slaves[touch.slave].area);
            let (gap, offset) = self.beyond(&touch);
            let (side, slip) = (self.tracker.side(touch.pass), touch.memory.slip);
            springs.push(Spring { normal, gap, stiffness, area, side, slip, ..Spring::default() }, &ends);
            self.touches[index].memory.offset = offset;
        }
        self.has_begun = true;
    }
}

impl Formulation for NodeSegment {
    fn detect(&mut self, scene: &Scene<'_>, springs: &mut Springs) {
        self.detect_free(&[], scene, springs);
    }

    fn remember(&mut self, solved: &[Spring]) {
        for (touch, spring) in self.touches.iter().zip(solved) {
            self.tracker.remember(touch, Memory { slip: spring.slip_new, ..touch.memory });
        }
    }

    fn certificate(&self) -> Certificate {
        self.tracker.certificate()
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(self.tracker.search_report())
    }
}

/// The ends of a spring between a node and where it projects.
///
/// The slip rate is that of the node against the target at the node's own distance, ṡ = t·(v − Σ Φ v_C) − g θ̇ with the rate θ̇ at which the segment turns: it does not see
/// rotations of both together, and its transpose, the friction, keeps the angular momentum.
#[must_use]
pub fn ends(node: u32, projection: &Projection, target: &Target, positions: &[Vector]) -> [End; 3] {
    let segment = target.surface.segments[projection.segment as usize];
    let [wa, wb] = projection.weights;
    let [xa, xb] = segment.map(|node| positions[node as usize]);
    let x = positions[node as usize];
    let foot = [wa * xa[0] + wb * xb[0], wa * xa[1] + wb * xb[1]];
    let arm = (x[0] - foot[0]) * projection.normal[0] + (x[1] - foot[1]) * projection.normal[1];
    let [a, b] = segment_ends(segment, projection.weights, arm, positions);
    [End::node(node, 1.0), a, b]
}

/// The nodes of a segment as ends of a spring to what is seen from its foot at the distance `arm` (m), and slides there.
#[must_use]
pub fn segment_ends([a, b]: [u32; 2], [wa, wb]: [f64; 2], arm: f64, positions: &[Vector]) -> [End; 2] {
    let (xa, xb) = (positions[a as usize], positions[b as usize]);
    let along = [xb[0] - xa[0], xb[1] - xa[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    // arm / L times the segment's normal
    let turn = if square > 0.0 { [-along[1] * arm / square, along[0] * arm / square] } else { [0.0; 2] };
    [End { at: a, share: -wa, turn: [-turn[0], -turn[1]], ..End::default() }, End { at: b, share: -wb, turn, ..End::default() }]
}
