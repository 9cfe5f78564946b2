//! Nodes against facets of surfaces in space: a spring for each slave node, in a single pass, a double pass, or of a surface with itself.
//!
//! Where the nodes lie comes from the [`Tracker`]; friction and thickness are those of the slave node, the stiffness that of the softer side where they meet. The rows of a spring are the
//! gradient of its gap (`projection/node_facet.rs`), so resultant, momentum and angular momentum are exact, and what slides over an edge or a corner keeps its energy as far as half steps
//! see the turn of the normal.

pub mod tracker;

use super::initial::{is_ignored, kept};
use super::node_segment::{Before, Closed, carried, is_stored};
use super::projection::node_facet::{Placed, Projection, Vector, unit};
use super::springs::friction::cone;
use super::springs::{Answers, End, Spring, Springs};
use super::tracker::SearchReport;
use super::{Formulation, Scene};
use crate::archive::{Archive, Kept, keep_each};
use crate::mesh::surface::{Corners, NONE};
use crate::model;
use crate::motion::{Motion, any_tangent, cross_space as cross, dot_space as dot};
use crate::tensor::Dim;
use std::any::Any;
use tracker::{Memory, Touch, Tracker};

/// What a pass knows of its nodes and facets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassInput {
    /// Slave nodes in the order of their surface.
    pub slaves: Vec<Slave>,
    /// Stiffness (N/m) of each slave by unit of pressure stiffness κ (Pa/m) of the target; empty where the stiffness is given.
    pub per_modulus: Vec<f64>,
    /// κ behind each facet of the target, Pa/m: the softest of its part.
    pub moduli: Vec<f64>,
}

/// A slave node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slave {
    /// Stiffness as its own side gives it, N/m: of the automatic penalty κ times the area, half of it in a double pass.
    pub stiffness: f64,
    /// Area of surface that it stands for, m²: its own, half of that where both surfaces are slaves.
    pub area: f64,
}

impl PassInput {
    /// The softer of both sides decides, where they meet.
    fn stiffness(&self, slave: usize, facet: u32) -> f64 {
        let own = self.slaves[slave].stiffness;
        self.per_modulus.get(slave).map_or(own, |per| own.min(per * self.moduli[facet as usize]))
    }
}

/// The formulation.
pub struct NodeFacet {
    tracker: Tracker,
    passes: Vec<PassInput>,
    /// Distance that the surfaces keep, m.
    thickness: f64,
    /// Largest gap at which the law pushes, m.
    reach: f64,
    /// Whether springs store energy: multipliers do not.
    stores: bool,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    /// Initial positions, m: only where a surface meets itself at a distance.
    initial: Vec<Vector>,
    has_begun: bool,
    /// Energy of the springs of the last step, and of those that were not found again, J.
    closed: Closed,
    let_go: f64,
    /// Positions at which the springs of this step lie: of the facets that slips turn with.
    frames: Vec<[Vector; 2]>,
}

impl NodeFacet {
    /// For the passes of `tracker`; `reach` of the law, m; `initial` positions, m.
    #[must_use]
    pub fn new(tracker: Tracker, passes: Vec<PassInput>, interface: &model::Interface, reach: f64, initial: &[Vector]) -> Self {
        Self {
            tracker,
            passes,
            thickness: interface.thickness,
            reach,
            stores: is_stored(interface),
            ignores_start: is_ignored(interface),
            initial: if interface.thickness + reach > 0.0 { initial.to_vec() } else { Vec::new() },
            has_begun: false,
            closed: Closed::default(),
            let_go: 0.0,
            frames: Vec::new(),
        }
    }

    /// What follows the nodes.
    #[must_use]
    pub fn tracker(&self) -> &Tracker {
        &self.tracker
    }

    /// Gap less the thickness. A surface keeps no more distance from itself than half of what it had: neighbours along a surface are near, and stay so.
    fn gap(&self, touch: &Touch) -> f64 {
        let gap = touch.projection.gap - self.thickness;
        if !touch.own || self.initial.is_empty() {
            return gap;
        }
        let placed = Placed { surface: self.tracker.target(touch.pass), positions: &self.initial };
        let distance = placed.distance(self.initial[touch.node as usize], touch.projection.facet);
        gap + (self.thickness + self.reach - 0.5 * distance.unwrap_or(0.0)).max(0.0)
    }

    /// Gap as the spring sees it, and the gap that counts as zero.
    fn beyond(&self, touch: &Touch, memory: &Memory) -> (f64, f64) {
        let gap = self.gap(touch);
        let offset = kept(self.has_begun, memory.offset, gap);
        let offset = if self.ignores_start && !touch.own { offset } else { 0.0 };
        (gap - offset, offset)
    }
}

impl Formulation<3> for NodeFacet {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        let positions = scene.sweep.new;
        let count = self.tracker.track(scene.sweep, self.thickness + self.reach).len();
        let mut again = Closed::default();
        self.frames.clear();
        for index in 0..count {
            let touch = self.tracker.touches()[index];
            let memory = *self.tracker.kept(&touch);
            again.add(memory.stored);
            let placed = Placed { surface: self.tracker.target(touch.pass), positions };
            let (ends, known) = ends(&placed, touch.node, &touch.projection);
            let ends = &ends[..known];
            let (pass, slave, Projection { normal, facet, .. }) =
                (&self.passes[touch.pass as usize], touch.slave as usize, touch.projection);
            let frame = frame(&placed, facet);
            let tangent = tangent(normal, frame[0]);
            let (gap, offset) = self.beyond(&touch, &memory);
            let before = Before { half: memory.half, normal: memory.normal, carried: memory.carried };
            let carried = if self.stores { carried(&before, normal, gap, ends, self.reach, scene.sweep, self.has_begun) } else { 0.0 };
            let slip = cone::carried(slip(&placed, &memory), Dim::<3>::tangents(normal, &tangent));
            let (stiffness, area, side) = (pass.stiffness(slave, facet), pass.slaves[slave].area, self.tracker.side(touch.pass));
            springs.push(Spring { normal, gap: gap + carried, stiffness, area, side, slip, tangent, ..Spring::default() }, ends);
            self.frames.push(frame);
            *self.tracker.kept_mut(&touch) = Memory { offset, carried, normal, facet, stored: 0.0, ..memory };
        }
        self.let_go = self.closed.less(&again);
        self.has_begun = true;
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        self.closed = Closed::default();
        for (index, answer) in solved.enumerate() {
            let touch = self.tracker.touches()[index];
            let frame = self.frames[index];
            let memory = self.tracker.kept_mut(&touch);
            let ([first, second], [a, b]) = (answer.spring.tangents(), answer.solved.slip_new);
            memory.slip = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
            (memory.frame, memory.half) = (frame, answer.gap_new());
            if self.stores && memory.half < self.reach {
                memory.stored = answer.stored_new();
                self.closed.add(memory.stored);
            }
        }
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        let Self {
            passes: _,
            thickness: _,
            reach: _,
            stores: _,
            ignores_start: _,
            initial: _,
            let_go: _,
            frames: _,
            tracker,
            has_begun,
            closed,
        } = self;
        tracker.keep(archive)?;
        keep_each!(archive; has_begun, closed);
        Ok(())
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            // What is not found again went with its surface.
            self.tracker.inherit(&old.tracker);
            self.has_begun = old.has_begun;
        }
    }

    fn let_go(&self) -> f64 {
        self.let_go
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(self.tracker.search_report())
    }
}

/// Direction of a facet's first edge, and its normal: what turns with it.
fn frame(placed: &Placed<'_>, facet: u32) -> [Vector; 2] {
    let [a, b, ..] = placed.surface.facets[facet as usize].map(|node| placed.positions[node as usize]);
    let normal = placed.facet_normal(facet);
    [tangent(normal, [0, 1, 2].map(|d| b[d] - a[d])), normal]
}

/// The unit vector at right angles to a unit vector that is nearest to a direction.
fn tangent(normal: Vector, direction: Vector) -> Vector {
    let along = dot(direction, normal);
    let across = unit([0, 1, 2].map(|d| direction[d] - along * normal[d]));
    // A direction along the normal has none.
    if dot(across, across) > 0.5 && dot(across, normal).abs() < 1e-6 { across } else { any_tangent(normal) }
}

/// The elastic slip of the step before, turned with its facet.
fn slip(placed: &Placed<'_>, memory: &Memory) -> Vector {
    let Memory { slip, facet, frame: [along, normal], .. } = *memory;
    if facet == NONE || slip == [0.0; 3] {
        return slip;
    }
    let axes = |[along, normal]: [Vector; 2]| [along, cross(normal, along), normal];
    let (before, now) = (axes([along, normal]), axes(frame(placed, facet)));
    let parts = before.map(|axis| dot(axis, slip));
    [0, 1, 2].map(|d| parts[0] * now[0][d] + parts[1] * now[1][d] + parts[2] * now[2][d])
}

/// The ends of a spring between a node and where it projects, and how many there are.
///
/// The slip rate is that of the node against the facet at the node's own distance, ṡ = t·(v − Σ w v_C − ω × r) with r = x − P and the spin ω of the triangle: ω = N × Ṅ + ½ N (N·∇ × v) is the
/// body's own for every rigid motion, so ṡ does not see rotations of both together, and its transpose, the friction, keeps the angular momentum.
#[must_use]
pub fn ends(placed: &Placed<'_>, node: u32, projection: &Projection) -> ([End<3>; 5], usize) {
    let Projection { facet, triangle, weights, foot, normal, .. } = *projection;
    let corners = placed.surface.facets[facet as usize];
    let count = corners.corners().len();
    let x = placed.positions[node as usize];
    let arm = [0, 1, 2].map(|d| x[d] - foot[d]);
    let spins = spin_rows(placed, facet, triangle);
    let tangents = Dim::<3>::tangents(normal, &tangent(normal, frame(placed, facet)[0]));
    let mut ends = [End::node(node, 1.0); 5];
    for k in 0..count {
        // t·(ω × r) = ω·(r × t)
        let turn = tangents.map(|t| {
            let pull = cross(arm, t);
            // Of a row pair [a, b]: ω = a (b·v).
            let mut row = [0.0; 3];
            for [spin, by] in spins[k] {
                let share = dot(pull, spin);
                (0..3).for_each(|d| row[d] -= share * by[d]);
            }
            row
        });
        ends[k + 1] = End { turn, ..End::node(corners[k], -weights[k]) };
    }
    (ends, count + 1)
}

/// How a triangle of a facet spins with each corner: ω = Σ a (b·v), pairs [a, b] of each.
fn spin_rows(placed: &Placed<'_>, facet: u32, triangle: usize) -> [[[Vector; 2]; 2]; 4] {
    let x = placed.triangle(facet, triangle);
    let minus = |a: Vector, b: Vector| [0, 1, 2].map(|d| a[d] - b[d]);
    let area = cross(minus(x[1], x[0]), minus(x[2], x[0]));
    let square = dot(area, area);
    let mut rows = [[[[0.0; 3]; 2]; 2]; 4];
    if !(square > 0.0) {
        return rows;
    }
    let (twice, normal) = (square.sqrt(), unit(area));
    let mut of = [[0.0; 3]; 3];
    for (k, row) in of.iter_mut().enumerate() {
        // N × ∇Φ_k = −e / 2A with the opposite edge e
        *row = minus(x[(k + 2) % 3], x[(k + 1) % 3]).map(|e| -e / twice);
    }
    for corner in 0..4 {
        let share = |k: usize| {
            let mut unit = [0.0; 3];
            unit[k] = 1.0;
            placed.spread(facet, triangle, unit)[corner]
        };
        let whole = [0, 1, 2].map(|d| (0..3).map(|k| share(k) * of[k][d]).sum::<f64>());
        // ω = −(N × ∇Φ)(N·v) + ½ N ((N × ∇Φ)·v)
        rows[corner][0] = [whole.map(|c| -c), normal];
        rows[corner][1] = [normal.map(|n| 0.5 * n), whole];
    }
    rows
}

#[cfg(test)]
mod tests;
