//! Penetrations at the start: where they are, and how nodes are moved out of them before anything is strained.
//!
//! Surfaces come from the builder as trackers that know nothing of the past; what is found goes to the model's faults, or to the overview. Bodies with themselves are
//! never thought to penetrate at the start.

use super::tracker::{Touch, Tracker};
use super::{Sweep, Vector};
use crate::error::Fault;
use crate::load::constraint::Constraints;

/// Penetrations deeper than this fraction of the model's size count.
pub const TOLERANCE: f64 = 1e-9;
/// At most so many are told one by one.
const TOLD: usize = 20;
/// Rounds of looking for penetrations, and sweeps over those that a round found.
const ROUNDS: usize = 100;
const SWEEPS: usize = 10;

/// A node that is inside at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// The node.
    pub node: u32,
    /// Where it is, m.
    pub place: Vector,
    /// How deep, m.
    pub depth: f64,
}

impl Penetration {
    /// In words.
    #[must_use]
    pub fn line(&self) -> String {
        let Self { place: [x, y], depth, .. } = self;
        format!("the node at ({x:.6e}, {y:.6e}) m is {depth:.3e} m inside at the start")
    }
}

/// Faults of a contact or obstacle at `path` with these penetrations; the first 20 are told, the rest is counted.
#[must_use]
pub fn faults(path: &str, name: &str, found: &[Penetration]) -> Vec<Fault> {
    let help = "move the bodies apart, or set `initial_penetration` to \"push_out\" or \"ignore\"";
    let one = |penetration: &Penetration| Fault::new(path, format!("\"{name}\": {}", penetration.line()), help);
    let mut faults: Vec<Fault> = found.iter().take(TOLD).map(one).collect();
    if found.len() > TOLD {
        faults.push(Fault::new(path, format!("\"{name}\": and {} more nodes are inside", found.len() - TOLD), help));
    }
    faults
}

/// Lines of a contact or obstacle for the overview; the first 20 are told, the rest is counted.
#[must_use]
pub fn lines(name: &str, found: &[Penetration], what_is_done: &str) -> Vec<String> {
    let mut lines: Vec<String> =
        found.iter().take(TOLD).map(|penetration| format!("{name}: {}; {what_is_done}", penetration.line())).collect();
    if found.len() > TOLD {
        lines.push(format!("{name}: and {} more nodes; {what_is_done}", found.len() - TOLD));
    }
    lines
}

/// Size of a model for tolerances: its farthest coordinate, m.
#[must_use]
pub fn size(positions: &[Vector]) -> f64 {
    positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()))
}

/// Nodes that are inside other bodies, or nearer than `thickness` (m), by more than `tolerance` (m).
#[must_use]
pub fn penetrations(tracker: &mut Tracker, thickness: f64, positions: &[Vector], tolerance: f64) -> Vec<Penetration> {
    let inside = inside(tracker, thickness, positions, tolerance);
    let of =
        |touch: &Touch| Penetration { node: touch.node, place: positions[touch.node as usize], depth: thickness - touch.projection.gap };
    inside.iter().map(of).collect()
}

fn inside(tracker: &mut Tracker, thickness: f64, positions: &[Vector], tolerance: f64) -> Vec<Touch> {
    tracker.forget();
    let touches = tracker.track(Sweep { old: positions, new: positions }, thickness);
    touches.iter().filter(|touch| !touch.own && touch.projection.gap - thickness < -tolerance).copied().collect()
}

/// Moves nodes until none is inside another body, or nearer than `thickness` (m), by more than `tolerance` (m). A node and the segment that it is behind share the way so that the
/// sum of squares is least, each along the directions in which it is not held; nodes from number `fixed` on, those of obstacles, stay. Returns what could not be moved out.
pub fn push_out(
    tracker: &mut Tracker,
    thickness: f64,
    positions: &mut [Vector],
    fixed: usize,
    constraints: &Constraints<2>,
    tolerance: f64,
) -> Vec<Penetration> {
    for _ in 0..ROUNDS {
        let found = inside(tracker, thickness, positions, tolerance);
        if found.is_empty() {
            break;
        }
        for _ in 0..SWEEPS {
            for touch in &found {
                part(tracker, touch, thickness + 0.5 * tolerance, positions, fixed, constraints);
            }
        }
    }
    penetrations(tracker, thickness, positions, tolerance)
}

/// Moves a node and the segment that it touches to a distance.
fn part(tracker: &Tracker, touch: &Touch, distance: f64, positions: &mut [Vector], fixed: usize, constraints: &Constraints<2>) {
    let target = tracker.target(touch.pass);
    let Some(here) = target.follow(positions[touch.node as usize], touch.projection.segment, positions) else { return };
    let [a, b] = target.surface.segments[here.segment as usize];
    let [wa, wb] = here.weights;
    let way = |(node, share): (u32, f64)| {
        let normal = here.normal;
        let share = if (node as usize) < fixed { share } else { 0.0 };
        let free = constraints.of(node as usize).map_or(normal, |held| held.free_part(normal));
        (node, [share * free[0], share * free[1]], share * share * (free[0] * normal[0] + free[1] * normal[1]))
    };
    let ways = [(touch.node, 1.0), (a, -wa), (b, -wb)].map(way);
    let gain: f64 = ways.iter().map(|(_, _, gain)| gain).sum();
    if here.gap >= distance || gain <= 1e-12 {
        return;
    }
    for (node, way, _) in ways {
        for d in 0..2 {
            positions[node as usize][d] += (distance - here.gap) / gain * way[d];
        }
    }
}
