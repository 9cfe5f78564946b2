//! Nodes against segments: a spring for each slave node, in a single pass, a double pass, or of a surface
//! with itself.
//!
//! Where the nodes lie comes from the [`Tracker`]; friction and thickness are those of the slave node, the
//! stiffness that of the softer side where they meet.

mod fold;

use super::checked::Look;
use super::closed::Closed;
use super::depths::Depths;
use super::findings::Findings;
use super::formulation::{FormulationKind, Setup, both_passes, one_pass};
use super::initial::{is_ignored, kept};
use super::law::penalty::{at_obstacles, factor, penalty_of, stiffening};
use super::projection::node_segment::{Projection, Target};
use super::springs::{Answers, End, Spring, Springs, tangent};
use super::tracker::{Certificate, ContactHistory, ContactPoint, SearchReport, Tracker, is_facing};
use super::{Formulation, Scene, Vector};
use crate::archive::{Archive, ArchiveResult, persist_each};
use crate::mesh::surface::NONE;
use crate::model;
use fold::{other_at_node, turn_with_both};
use std::any::Any;

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
    /// Whether springs store energy: multipliers do not.
    stores: bool,
    /// Whether springs care for slip.
    slips: bool,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    /// Initial positions, m: only where a surface meets itself at a distance.
    initial: Vec<Vector>,
    has_begun: bool,
    /// The touches of this step that made springs.
    used: Vec<u32>,
    /// Energy of the springs of the last step, and of those that were not found again, J/m.
    closed: Closed,
    lost_contact_energy: f64,
    /// How deep nodes are against the local thickness.
    depths: Depths,
}

/// What a pass knows of its nodes and segments.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassInput {
    /// Slave nodes in the order of their surface; stiffness as their own side gives it.
    pub slaves: Vec<Slave>,
    /// Stiffness (N/m per metre of depth) of each slave by unit of pressure stiffness κ (Pa/m) of the target;
    /// empty where the stiffness is given.
    pub per_modulus: Vec<f64>,
    /// Smallest κ of the part behind each segment of the target, Pa/m.
    pub moduli: Vec<f64>,
    /// The same α m / (dt² A) by the mass of its nodes and the first step, Pa/m; empty: not known.
    pub of_mass: Vec<f64>,
    /// What the segments at each slave stand for, [that which ends there, that which begins there]; empty:
    /// slaves count whole.
    pub faces: Vec<[Face; 2]>,
    /// By what factor springs stiffen if the slaves or the target are those of an obstacle.
    pub at_obstacle: Option<f64>,
    /// Local thickness at each slave at the start, m; empty: what is behind the target counts alone.
    pub thickness: Vec<f64>,
}

/// What a segment at a node has of the node's tributary length and of its stiffness, as fractions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Face {
    /// Fraction of the length, of an axisymmetric body of the area.
    pub length: f64,
    /// Fraction of the stiffness.
    pub stiffness: f64,
}

/// Both faces of a node.
const BOTH: u8 = 3;

impl PassInput {
    /// The softer of both sides decides, where they meet.
    pub(super) fn stiffness(&self, slave: usize, segment: u32) -> f64 {
        self.stiffness_of(slave, segment, Face { length: 1.0, stiffness: 1.0 })
    }

    fn stiffness_of(&self, slave: usize, segment: u32, part: Face) -> f64 {
        let own = part.stiffness * self.slaves[slave].stiffness;
        self.per_modulus.get(slave).map_or(own, |per| own.min(part.length * per * self.moduli[segment as usize]))
    }

    /// Stiffness by mass and step, of the lighter side, N/m per metre of depth.
    fn of_mass(&self, slave: usize, segment: u32) -> f64 {
        let Slave { of_mass, area, .. } = self.slaves[slave];
        self.of_mass.get(segment as usize).map_or(0.0, |other| of_mass.min(other * area))
    }

    /// Local thickness at a slave, m; infinite: not known.
    fn thickness(&self, slave: usize) -> f64 {
        self.thickness.get(slave).copied().unwrap_or(f64::INFINITY)
    }

    /// By what factor a spring stiffens.
    fn factor(&self, slave: usize, segment: u32, stiffness: f64) -> f64 {
        self.at_obstacle.unwrap_or_else(|| factor(stiffness, self.of_mass(slave, segment)))
    }

    /// What counts of a slave.
    fn part(&self, slave: usize, faces: u8) -> Face {
        match self.faces.get(slave) {
            Some(&[before, _]) if faces == 1 => before,
            Some(&[_, after]) if faces == 2 => after,
            _ => Face { length: 1.0, stiffness: 1.0 },
        }
    }
}

/// A slave node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slave {
    /// Stiffness, N/m per metre of depth.
    pub stiffness: f64,
    /// Area of surface that it stands for, m (of an axisymmetric body m²): its own, half of that where both
    /// surfaces are slaves.
    pub area: f64,
    /// Elastic slip at n − ½, m.
    pub slip: f64,
    /// Stiffness α m / dt² by its mass and the first step, N/m per metre of depth; zero: not known.
    pub of_mass: f64,
}

impl NodeSegment {
    /// For the passes of a contact. Where it ignores initial penetrations, gaps that are negative when it
    /// begins to act count as zero until the surfaces part.
    #[must_use]
    pub fn of(setup: Setup<'_>) -> Self {
        let passes = setup.passes;
        // A surface that meets itself is met from both sides.
        let sides = if setup.sides.len() == 1 { 2 } else { passes.len() };
        let pass = |&(slave, target): &(usize, usize)| PassInput {
            slaves: setup.slaves(slave, sides),
            per_modulus: setup.per_modulus(slave, sides),
            moduli: setup.sides[target].softest(),
            of_mass: setup.of_mass(target),
            faces: setup.faces(slave),
            ..PassInput::default()
        };
        let inputs = passes.iter().map(pass).collect();
        let (interface, reach) = (&setup.contact.interface, (setup.law)().reach());
        let initial = if interface.thickness + reach > 0.0 { setup.positions.to_vec() } else { Vec::new() };
        let depths = setup.depths();
        Self { passes: inputs, initial, depths, ..Self::new(setup.tracker(), Vec::new(), interface, reach) }
    }

    /// Of an obstacle, for the passes of `tracker` with slaves whose stiffness is known; `reach` of the law,
    /// m.
    #[must_use]
    pub fn new(tracker: Tracker, slaves: Vec<Vec<Slave>>, interface: &model::Interface, reach: f64) -> Self {
        let factor = at_obstacles(penalty_of(interface));
        let passes = slaves.into_iter().map(|slaves| PassInput { slaves, at_obstacle: Some(factor), ..PassInput::default() }).collect();
        Self {
            tracker,
            passes,
            thickness: interface.thickness,
            reach,
            stores: is_stored(interface),
            slips: interface.friction.is_some(),
            ignores_start: is_ignored(interface),
            initial: Vec::new(),
            has_begun: false,
            used: Vec::new(),
            closed: Closed::default(),
            lost_contact_energy: 0.0,
            depths: Depths::default(),
        }
    }

    /// The same with what is known of depths, and of each pass the thickness of the bodies at its slaves, m
    /// (empty: not known).
    #[must_use]
    pub fn with_depths(self, depths: Depths, thickness: Vec<Vec<f64>>) -> Self {
        let passes = self.passes.into_iter().zip(thickness).map(|(pass, thickness)| PassInput { thickness, ..pass }).collect();
        Self { passes, depths, ..self }
    }

    /// Gap less the thickness. A surface keeps no more distance from itself than half of what it had:
    /// neighbours along a surface are near, and stay so.
    fn gap(&self, touch: &ContactPoint) -> f64 {
        let gap = touch.projection.gap - self.thickness;
        if !touch.own || self.initial.is_empty() {
            return gap;
        }
        let target = self.tracker.target(touch.pass);
        let distance = target.distance(self.initial[touch.node as usize], touch.projection.segment, &self.initial);
        gap + (self.thickness + self.reach - 0.5 * distance.unwrap_or(0.0)).max(0.0)
    }

    /// Gap as the spring sees it, and the gap that counts as zero.
    fn beyond(&self, touch: &ContactPoint, memory: &ContactHistory) -> (f64, f64) {
        let gap = self.gap(touch);
        let offset = kept(self.has_begun, memory.offset, gap);
        let offset = if self.ignores_start && !touch.own { offset } else { 0.0 };
        (gap - offset, offset)
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
        let count = self.tracker.track(scene.sweep, self.thickness + self.reach).len();
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
            again.add(memory.stored);
            let pass = &self.passes[touch.pass as usize];
            let target = self.tracker.target(touch.pass);
            let mut ends = ends(touch.node, &touch.projection, target, scene.sweep.new);
            let Projection { normal, segment, .. } = touch.projection;
            let faces = self.faces(&touch, &memory, scene.sweep.new);
            let part = pass.part(slave, faces);
            let other = other_at_node(touch.node, &touch.projection, target);
            let stiffness = [Some(segment), other].into_iter().flatten().map(|segment| pass.stiffness_of(slave, segment, part));
            let (stiffness, area) = (stiffness.fold(f64::INFINITY, f64::min), part.length * pass.slaves[slave].area);
            let (gap, offset) = self.beyond(&touch, &memory);
            let thickness = self.depths.thickness(self.tracker.around(&touch)).min(pass.thickness(slave));
            self.depths.see(&self.tracker, &touch, offset - touch.projection.gap, thickness, scene);
            let stiffening = stiffening(thickness, pass.factor(slave, segment, stiffness));
            if touch.slope != 0.0 {
                lean(&mut ends, &touch, scene.sweep.new);
            }
            let (side, slip) = (self.tracker.side(touch.pass), memory.slip);
            let spring = Spring { normal, gap, stiffness, area, stiffening, side, slip: [slip], ..Spring::default() };
            match other.filter(|_| self.slips).map(|other| turn_with_both(&mut ends, &touch.projection, other, target, scene.sweep.new)) {
                None => springs.push(spring, &ends),
                Some(more) => springs.push_with(spring, ends.iter().chain([&more])),
            }
            if self.stores && self.has_begun {
                springs.continues(memory.half(), memory.stored);
            }
            *self.tracker.kept_mut(&touch) = ContactHistory { offset, faces, normal, stored: 0.0, ..memory };
            self.used.push(index as u32);
        }
        self.depths.end();
        self.lost_contact_energy = self.closed.less(&again);
        self.has_begun = true;
    }
}

impl Formulation<2> for NodeSegment {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        self.detect_free(&[], scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        self.closed = Closed::default();
        for (&index, answer) in self.used.iter().zip(solved) {
            let touch = self.tracker.touches()[index as usize];
            let memory = self.tracker.kept_mut(&touch);
            (memory.slip, memory.half) = (answer.solved.slip_new[0], answer.gap_new());
            if self.stores && memory.half < self.reach {
                memory.stored = answer.stored_new();
                self.closed.add(memory.stored);
            }
        }
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            passes: _, thickness: _, reach: _, stores: _, slips: _, ignores_start: _, initial: _, used: _, lost_contact_energy: _,
            tracker, has_begun, closed, depths,
        } = self;
        tracker.persist(archive)?;
        persist_each!(archive; has_begun, closed);
        depths.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            // What is not found again went with its surface.
            self.tracker.inherit(&old.tracker);
            self.has_begun = old.has_begun;
            self.depths.inherit(&old.depths);
        }
    }

    fn lost_contact_energy(&self) -> f64 {
        self.lost_contact_energy
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

/// Whether springs of an interface store energy.
pub(super) fn is_stored(interface: &model::Interface) -> bool {
    interface.law != model::ContactLaw::Multiplier
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
