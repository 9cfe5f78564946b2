//! Nodes against segments: a spring for each slave node, in a single pass, a double pass, or of a surface with itself.
//!
//! Where the nodes lie comes from the [`Tracker`]; stiffness, friction and thickness are those of the slave node.

use super::formulation::{FormulationKind, Setup};
use super::projection::node_segment::{Projection, Target};
use super::springs::{End, Spring, Springs};
use super::tracker::{Touch, Tracker};
use super::{Formulation, Scene, Vector};
use crate::error::Fault;
use crate::model;

/// Registry entry.
pub const DOUBLE_PASS: FormulationKind = FormulationKind {
    name: "double_pass",
    doc: "nodes against segments; each surface is slave once and target once in every force evaluation",
    source: "Bittencourt and Creus (1995)",
    make: |setup| {
        let passes = setup.both_passes();
        Ok(Box::new(NodeSegment::of(setup, passes)))
    },
};

/// Registry entry.
pub const SINGLE_PASS: FormulationKind = FormulationKind {
    name: "single_pass",
    doc: "nodes against segments; only the nodes of the slave surface are checked against the other one",
    source: "Bittencourt and Creus (1995)",
    make: |setup| {
        let slave = if let model::Formulation::SinglePass { slave } = setup.contact.formulation { slave } else { 0 };
        if setup.sides.len() == 1 {
            return Err(Fault::new(
                "formulation",
                "a surface that meets itself has no slave and no target",
                "take \"double_pass\" or \"segment\"",
            ));
        }
        Ok(Box::new(NodeSegment::of(setup, [&[(0, 1)], &[(1, 0)]][slave.min(1)])))
    },
};

/// The formulation.
pub struct NodeSegment {
    tracker: Tracker,
    /// Slave nodes of each pass, in the order of their surface.
    slaves: Vec<Vec<Slave>>,
    /// Distance that the surfaces keep, m.
    thickness: f64,
    /// Largest gap at which the law pushes, m.
    reach: f64,
    /// What was found in this step.
    touches: Vec<Touch>,
}

/// A slave node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slave {
    /// Stiffness, N/m per metre of depth.
    pub stiffness: f64,
    /// Length of surface that is its own, m.
    pub area: f64,
    /// Elastic slip at n − ½, m.
    pub slip: f64,
}

impl NodeSegment {
    /// For a contact with these passes (slave, target).
    #[must_use]
    pub fn of(setup: Setup<'_>, passes: &[(usize, usize)]) -> Self {
        let pass = |&(slave, target): &(usize, usize)| {
            let other = setup.sides[target].softest();
            let of = |(index, &(area, _)): (usize, &(f64, f64))| {
                let stiffness = setup.node_stiffness(slave, index, other, passes.len());
                // In a double pass each side carries half of the pressure.
                Slave { stiffness, area: area / passes.len() as f64, slip: 0.0 }
            };
            setup.sides[slave].nodes.iter().enumerate().map(of).collect()
        };
        let slaves = passes.iter().map(pass).collect();
        let (interface, reach, positions, search) = (&setup.contact.interface, setup.terms.law.reach(), setup.positions, (setup.search)());
        let targets = setup.sides.into_iter().map(|side| side.target).collect();
        Self::new(Tracker::new(targets, passes, search, positions), slaves, interface.thickness, reach)
    }

    /// For the passes of `tracker`; `slaves` per pass in the order of the slave surface's nodes, `reach` of the law, m.
    #[must_use]
    pub fn new(tracker: Tracker, slaves: Vec<Vec<Slave>>, thickness: f64, reach: f64) -> Self {
        Self { tracker, slaves, thickness, reach, touches: Vec::new() }
    }
}

impl NodeSegment {
    /// [`Formulation::detect`] for those slaves of the first pass that are not bound otherwise (`bound` by index; empty: all).
    pub(super) fn detect_free(&mut self, bound: &[bool], scene: &Scene<'_>, springs: &mut Springs) {
        self.touches.clear();
        self.touches.extend_from_slice(self.tracker.track(scene.sweep, self.thickness + self.reach));
        self.touches.retain(|touch| touch.pass > 0 || !bound.get(touch.slave).copied().unwrap_or(false));
        for touch in &self.touches {
            let slave = self.slaves[touch.pass][touch.slave];
            let ends = ends(touch.node, &touch.projection, self.tracker.target(touch.pass), scene.sweep.new);
            let Projection { normal, gap, .. } = touch.projection;
            let Slave { stiffness, area, slip } = slave;
            let side = self.tracker.side(touch.pass);
            springs.push(Spring { normal, gap: gap - self.thickness, stiffness, area, side, slip, ..Spring::default() }, &ends);
        }
    }
}

impl Formulation for NodeSegment {
    fn detect(&mut self, scene: &Scene<'_>, springs: &mut Springs) {
        self.detect_free(&[], scene, springs);
    }

    fn remember(&mut self, solved: &[Spring]) {
        for (touch, spring) in self.touches.iter().zip(solved) {
            self.slaves[touch.pass][touch.slave].slip = spring.slip_new;
        }
    }
}

/// The ends of a spring between a node and where it projects.
///
/// The slip rate is that of the node against the target at the node's own distance, ṡ = t·(v − Σ Φ v_C) − g θ̇ with the rate θ̇ at which the segment turns: it does not see
/// rotations of both together, and its transpose, the friction, keeps the angular momentum.
#[must_use]
pub fn ends(node: u32, projection: &Projection, target: &Target, positions: &[Vector]) -> [End; 3] {
    let [a, b] = target.surface.segments[projection.segment as usize];
    let [wa, wb] = projection.weights;
    let (x, xa, xb) = (positions[node as usize], positions[a as usize], positions[b as usize]);
    let along = [xb[0] - xa[0], xb[1] - xa[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let foot = [wa * xa[0] + wb * xb[0], wa * xa[1] + wb * xb[1]];
    let arm = (x[0] - foot[0]) * projection.normal[0] + (x[1] - foot[1]) * projection.normal[1];
    // arm / L times the segment's normal
    let turn = if square > 0.0 { [-along[1] * arm / square, along[0] * arm / square] } else { [0.0; 2] };
    [
        End::node(node, 1.0),
        End { at: a, share: -wa, turn: [-turn[0], -turn[1]], ..End::default() },
        End { at: b, share: -wb, turn, ..End::default() },
    ]
}
