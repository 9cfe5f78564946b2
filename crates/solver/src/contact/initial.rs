//! Penetrations at the start: where they are, and how nodes are moved out of them before anything is
//! strained.
//!
//! Surfaces come from the builder as trackers that know nothing of the past; what is found goes to the
//! model's faults, or to the overview. Bodies with themselves are never thought to penetrate at the start.

pub mod space;

use super::tracker::{ContactPoint, Tracker};
use super::{Sweep, Vector};
use crate::contact::messages::PENETRATION;
use crate::error::Fault;
use crate::load::constraint::Constraints;
use crate::model::{InitialPenetration, Interface};
use crate::vector::place;

/// At most so many are reported one by one.
const REPORTED_MAX: usize = 20;
/// Rounds of looking for penetrations, and sweeps over those that a round found.
const ROUNDS: usize = 100;
const SWEEPS: usize = 10;

/// What is inside at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration<const D: usize> {
    /// A node or an edge.
    pub what: Inside,
    /// Where it is, m.
    pub place: [f64; D],
    /// How deep, m.
    pub depth: f64,
}

/// See [`Penetration`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// A node, behind a segment, a facet or an obstacle.
    Node,
    /// An edge in 3D that crosses another one.
    Edge,
}

impl<const D: usize> Penetration<D> {
    /// In words.
    #[must_use]
    pub fn line(&self) -> String {
        let (at, depth) = (place(self.place), self.depth);
        let what = if self.what == Inside::Node { "node" } else { "edge" };
        format!("the {what} at {at} m is {depth:.3e} m inside at the start")
    }
}

/// Faults of a contact or obstacle at `path` with these penetrations; the first 20 are reported, the rest is
/// counted.
#[must_use]
pub fn faults<const D: usize>(path: &str, name: &str, found: &[Penetration<D>]) -> Vec<Fault> {
    let help = "move the bodies apart, or set `initial_penetration` to \"push_out\" or \"ignore\"";
    let one = |penetration: &Penetration<D>| Fault::new(&PENETRATION, path, format!("\"{name}\": {}", penetration.line()), help);
    let mut faults: Vec<Fault> = found.iter().take(REPORTED_MAX).map(one).collect();
    if found.len() > REPORTED_MAX {
        faults.push(Fault::new(&PENETRATION, path, format!("\"{name}\": and {} more nodes are inside", found.len() - REPORTED_MAX), help));
    }
    faults
}

/// Lines of a contact or obstacle for the overview; the first 20 are reported, the rest is counted.
#[must_use]
pub fn lines<const D: usize>(name: &str, found: &[Penetration<D>], what_is_done: &str) -> Vec<String> {
    let mut lines: Vec<String> =
        found.iter().take(REPORTED_MAX).map(|penetration| format!("{name}: {}; {what_is_done}", penetration.line())).collect();
    if found.len() > REPORTED_MAX {
        lines.push(format!("{name}: and {} more nodes; {what_is_done}", found.len() - REPORTED_MAX));
    }
    lines
}

/// Whether gaps that are negative when an interface begins to act count as zero: where the model says so, or
/// where it begins later, so that no one can say where bodies are then.
#[must_use]
pub fn is_ignored(interface: &Interface) -> bool {
    interface.initial_penetration == InitialPenetration::Ignore || interface.active[0] > 0.0
}

/// The gap that counts as zero (m, negative), now that the gap is `gap`: that at which the interface began to
/// act, until the surfaces part. One that went with the gap would give to springs what no one put in.
/// `offset` is that of the step before; it has none before it has begun.
#[must_use]
pub fn kept(has_begun: bool, offset: f64, gap: f64) -> f64 {
    if !has_begun {
        gap.min(0.0)
    } else if gap < 0.0 {
        offset
    } else {
        0.0
    }
}

/// How far a model is drawn: its farthest coordinate, m.
#[must_use]
pub fn size<const D: usize>(positions: &[[f64; D]]) -> f64 {
    positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()))
}

/// Nodes that are inside other bodies, or nearer than `thickness` (m), by more than `tolerance` (m).
#[must_use]
pub fn penetrations(tracker: &mut Tracker, thickness: f64, positions: &[Vector], tolerance: f64) -> Vec<Penetration<2>> {
    let inside = inside(tracker, thickness, positions, tolerance);
    let of = |touch: &ContactPoint| Penetration {
        what: Inside::Node,
        place: positions[touch.node as usize],
        depth: thickness - touch.projection.gap,
    };
    inside.iter().map(of).collect()
}

fn inside(tracker: &mut Tracker, thickness: f64, positions: &[Vector], tolerance: f64) -> Vec<ContactPoint> {
    tracker.forget();
    let touches = tracker.track(Sweep::between(positions, positions), thickness);
    touches.iter().filter(|touch| !touch.own && touch.projection.gap - thickness < -tolerance).copied().collect()
}

/// What may be moved at the start, and what must not.
pub struct Movable<'a> {
    /// m; nodes beyond `count` are those of obstacles and stay where they are.
    pub positions: &'a mut Vec<Vector>,
    /// Nodes of the model.
    pub count: usize,
    /// Directions in which nodes are held.
    pub constraints: &'a Constraints<2>,
    /// Depth that is round-off, m.
    pub tolerance: f64,
}

impl Movable<'_> {
    /// Moves nodes until none is inside another body, or nearer than `thickness` (m), by more than the
    /// tolerance, or until that has been tried often enough. A node and the segment that it is behind share
    /// the way so that the sum of squares is least, each along the directions in which it is not held.
    /// Whether something was moved.
    pub fn push_out(&mut self, tracker: &mut Tracker, thickness: f64) -> bool {
        for round in 0..ROUNDS {
            let found = inside(tracker, thickness, self.positions, self.tolerance);
            if found.is_empty() {
                return round > 0;
            }
            for _ in 0..SWEEPS {
                for touch in &found {
                    self.part(tracker, touch, thickness + 0.5 * self.tolerance);
                }
            }
        }
        true
    }

    /// Moves `nodes` out of an obstacle of which `project` reports gap (m) and normal. Whether something was
    /// moved.
    pub fn push_off(&mut self, nodes: &[u32], project: impl Fn(Vector) -> Option<(f64, Vector)>) -> bool {
        let mut is_moved = false;
        for &node in nodes {
            for _ in 0..ROUNDS {
                let Some((gap, normal)) = project(self.positions[node as usize]).filter(|&(gap, _)| gap < -self.tolerance) else { break };
                let (way, gain) = self.way(node, 1.0, normal);
                if gain <= 1e-12 {
                    break;
                }
                is_moved = true;
                self.shift(node, way, (0.5 * self.tolerance - gap) / gain);
            }
        }
        is_moved
    }

    /// Moves a node and the segment that it touches to a distance.
    fn part(&mut self, tracker: &Tracker, touch: &ContactPoint, distance: f64) {
        let target = tracker.target(touch.pass);
        let Some(here) = target.follow(self.positions[touch.node as usize], touch.projection.segment, self.positions) else { return };
        let [a, b] = target.surface.segments[here.segment as usize];
        let [wa, wb] = here.weights;
        let ways = [(touch.node, 1.0), (a, -wa), (b, -wb)].map(|(node, share)| (node, self.way(node, share, here.normal)));
        let gain: f64 = ways.iter().map(|(_, (_, gain))| gain).sum();
        if here.gap < distance && gain > 1e-12 {
            for (node, (way, _)) in ways {
                self.shift(node, way, (distance - here.gap) / gain);
            }
        }
    }

    /// Way of a node per unit of what opens a gap with its `share`, and how much of the gap this opens.
    fn way(&self, node: u32, share: f64, normal: Vector) -> (Vector, f64) {
        if node as usize >= self.count {
            return ([0.0; 2], 0.0);
        }
        let free = self.constraints.of(node as usize).map_or(normal, |held| held.free_part(normal));
        ([share * free[0], share * free[1]], share * share * (free[0] * normal[0] + free[1] * normal[1]))
    }

    fn shift(&mut self, node: u32, way: Vector, by: f64) {
        let x = &mut self.positions[node as usize];
        *x = [x[0] + by * way[0], x[1] + by * way[1]];
    }
}
