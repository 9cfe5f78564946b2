//! Penetrations at the start: where they are, and how nodes are moved out of them before anything is
//! strained.
//!
//! Surfaces come from the builder as trackers that know nothing of the past; what is found goes to the
//! model's faults, or to the overview. Bodies with themselves are never thought to penetrate at the start.
//! The nodes of a touch, on both sides, share the way so that the sum of squares is least, each along the
//! directions in which it is not held; again and again until none is inside. What is found in 2D and in 3D
//! says [`Penetrating`].

mod plane;
mod space;

use super::formulation::Surfaces;
use super::search::Search;
use crate::contact::messages::PENETRATION;
use crate::error::Fault;
use crate::load::constraint::Constraints;
use crate::model::{InitialPenetration, Interface, Model, Part};
use crate::tensor::Dim;
use crate::vector::{dot, place};

/// Rounds of looking for penetrations, and sweeps over those that a round found.
const ROUNDS: usize = 100;
const SWEEPS: usize = 10;
/// Ways that open less than this of a gap are none.
const GAIN: f64 = 1e-12;

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

/// Penetrations in one line: how many nodes and edges, how deep at most, and where that is.
fn summed<const D: usize>(found: &[Penetration<D>]) -> Option<String> {
    let deepest = found.iter().reduce(|best, it| if it.depth > best.depth { it } else { best })?;
    let (at, depth) = (place(deepest.place), deepest.depth);
    let edges = found.iter().filter(|it| it.what == Inside::Edge).count();
    let words = [("node", found.len() - edges), ("edge", edges)];
    if let ([only], Some((word, _))) = (found, words.into_iter().find(|(_, count)| *count > 0)) {
        return Some(format!("the {word} at {} m is {depth:.3e} m inside at the start", place(only.place)));
    }
    let counted = words
        .into_iter()
        .filter(|(_, count)| *count > 0)
        .map(|(word, count)| format!("{count} {word}{}", if count > 1 { "s" } else { "" }));
    let counted: Vec<String> = counted.collect();
    Some(format!("{} are up to {depth:.3e} m inside at the start, the deepest at {at} m", counted.join(" and ")))
}

/// The fault of a contact or obstacle at `path` with these penetrations, if there are any; `model` says
/// whether nodes can be pushed out, `hint` what else may be wrong.
#[must_use]
pub fn fault<const D: usize>(model: &Model, path: &str, name: &str, found: &[Penetration<D>], hint: Option<String>) -> Option<Fault> {
    // Nodes on the faces of shells can not.
    let help = match model.parts.iter().any(Part::is_of_shells) {
        true => "move the bodies apart, or set `initial_penetration` to \"ignore\"; shells can't be pushed out",
        false => "move the bodies apart, or set `initial_penetration` to \"push_out\" or \"ignore\"",
    };
    let (message, help) = match hint {
        None => (format!("\"{name}\": {}", summed(found)?), help.to_string()),
        Some(hint) => (format!("\"{name}\": {}: all of the bodies", summed(found)?), hint),
    };
    Some(Fault::new(&PENETRATION, path, message, help).at(found.iter().map(|it| it.place)))
}

/// The line of a contact or obstacle for the overview, if there are penetrations.
#[must_use]
pub fn line<const D: usize>(name: &str, found: &[Penetration<D>], what_is_done: &str) -> Option<String> {
    Some(format!("{name}: {}; {what_is_done}", summed(found)?))
}

/// Whether gaps that are negative when an interface begins to act count as zero: where the model says so, or
/// where it begins later, so that no one can say where bodies are then.
#[must_use]
pub fn is_ignored(interface: &Interface) -> bool {
    interface.initial_penetration == InitialPenetration::Ignore || interface.active[0] > 0.0
}

/// The gap that counts as zero (m), now that the gap is `gap`: that at which the interface began to act, or
/// by which surfaces of elements that were made again are off those before, until the surfaces part. One that
/// went with the gap would give to springs what no one put in. `offset` is that of the step before; it has
/// none before it has begun.
#[must_use]
pub fn kept(has_begun: bool, offset: f64, gap: f64) -> f64 {
    if !has_begun {
        gap.min(0.0)
    } else if gap < offset.max(0.0) {
        offset
    } else {
        0.0
    }
}

/// The gap that counts as zero (m) where surfaces of elements that were made again have the gap `now` and
/// those before had `before`, not a number where there was none: springs press as before.
#[must_use]
pub fn moved_by(before: f64, now: f64) -> f64 {
    if before.is_nan() {
        now.min(0.0)
    } else if before < 0.0 || now < 0.0 {
        now - before
    } else {
        0.0
    }
}

/// Most that a spring's gap changes by, as a factor, so that it presses as before with another stiffness.
const STIFFER: f64 = 4.0;

/// The gap (m) of a spring that presses as one of the gap `gap` did whose stiffness by area was the first of
/// `by_area` and is now the second, Pa/m.
#[must_use]
pub fn pressing(gap: f64, [before, now]: [f64; 2]) -> f64 {
    let known = gap < 0.0 && before > 0.0 && now > 0.0;
    if known { gap * (before / now).clamp(1.0 / STIFFER, STIFFER) } else { gap }
}

/// How far a model is drawn: its farthest coordinate, m.
#[must_use]
pub fn size<const D: usize>(positions: &[[f64; D]]) -> f64 {
    positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()))
}

/// What is inside at the start in a dimension.
pub trait Penetrating<const D: usize>: Surfaces<D> {
    /// A node, in 3D also an edge, that is inside another body.
    type Touch;
    /// Depth up to which nodes are found for certain, m.
    fn deepest(tracker: &Self::Tracker) -> f64;
    /// What is inside another body, or nearer than the thickness, by more than a tolerance (m).
    fn inside(look: &mut Look<D>, positions: &[[f64; D]], tolerance: f64) -> Vec<Self::Touch>
    where
        Dim<D>: Penetrating<D>;
    /// Where and how deep it is against surfaces that keep this distance, m.
    fn penetration(touch: &Self::Touch, thickness: f64, positions: &[[f64; D]]) -> Penetration<D>;
    /// How it can be opened, with the nodes where they are now; `None`: it is no more.
    fn opening(tracker: &Self::Tracker, touch: &Self::Touch, positions: &[[f64; D]]) -> Option<Opening<D>>;
}

/// A gap and the nodes that open it.
pub struct Opening<const D: usize> {
    /// Nodes with their shares in the gap, as many as count.
    ends: [(u32, f64); 5],
    count: usize,
    normal: [f64; D],
    /// m.
    gap: f64,
}

/// How a contact looks at its surfaces for the first time.
pub struct Look<const D: usize>
where
    Dim<D>: Penetrating<D>,
{
    tracker: <Dim<D> as Surfaces<D>>::Tracker,
    /// In 3D: makes the search for edges; `None`: they do not meet.
    edges: Option<fn() -> Box<dyn Search<D>>>,
    /// Distance that the surfaces keep, m.
    thickness: f64,
    /// Depth up to which nodes are found for certain, m.
    deepest: f64,
}

impl<const D: usize> Look<D>
where
    Dim<D>: Penetrating<D>,
{
    /// Of what follows the nodes of surfaces that keep this distance (m); `edges` makes the search for edges
    /// in 3D, if they meet.
    #[must_use]
    pub fn new(tracker: <Dim<D> as Surfaces<D>>::Tracker, edges: Option<fn() -> Box<dyn Search<D>>>, thickness: f64) -> Self {
        let deepest = Dim::<D>::deepest(&tracker);
        Self { tracker, edges, thickness, deepest }
    }

    /// The same that sees no deeper than the search of a step.
    #[must_use]
    pub fn shallow(self) -> Self {
        Self { deepest: 0.0, ..self }
    }

    /// What follows the nodes.
    #[must_use]
    pub fn tracker(&self) -> &<Dim<D> as Surfaces<D>>::Tracker {
        &self.tracker
    }

    /// What is inside another body, or nearer than the thickness, by more than a tolerance (m).
    #[must_use]
    pub fn penetrations(&mut self, positions: &[[f64; D]], tolerance: f64) -> Vec<Penetration<D>> {
        let inside = Dim::<D>::inside(self, positions, tolerance);
        inside.iter().map(|touch| Dim::<D>::penetration(touch, self.thickness, positions)).collect()
    }
}

/// What may be moved at the start, and what must not.
pub struct Movable<'a, const D: usize> {
    /// m; nodes beyond `count` are those of obstacles and stay where they are.
    pub positions: &'a mut Vec<[f64; D]>,
    /// Nodes of the model.
    pub count: usize,
    /// Directions in which nodes are held.
    pub constraints: &'a Constraints<D>,
    /// Depth that is round-off, m.
    pub tolerance: f64,
}

impl<const D: usize> Movable<'_, D>
where
    Dim<D>: Penetrating<D>,
{
    /// Moves nodes until nothing is inside another body, or nearer than the thickness, by more than the
    /// tolerance, or until that has been tried often enough. Whether something was moved.
    pub fn push_out(&mut self, look: &mut Look<D>) -> bool {
        let distance = look.thickness + 0.5 * self.tolerance;
        for round in 0..ROUNDS {
            let found = Dim::<D>::inside(look, self.positions, self.tolerance);
            if found.is_empty() {
                return round > 0;
            }
            for _ in 0..SWEEPS {
                for touch in &found {
                    let opening = Dim::<D>::opening(&look.tracker, touch, self.positions);
                    if let Some(Opening { ends, count, normal, gap }) = opening.filter(|opening| opening.gap < distance) {
                        self.open(&ends[..count], normal, distance - gap);
                    }
                }
            }
        }
        true
    }

    /// Moves `nodes` out of an obstacle of which `distance` says how far they are from its surface (m,
    /// negative inside) and the normal. Whether something was moved.
    pub fn push_off(&mut self, nodes: &[u32], distance: impl Fn([f64; D]) -> Option<(f64, [f64; D])>) -> bool {
        let mut is_moved = false;
        for &node in nodes {
            for _ in 0..ROUNDS {
                let Some((gap, normal)) = distance(self.positions[node as usize]) else { break };
                if !(gap < -self.tolerance && self.open(&[(node, 1.0)], normal, 0.5 * self.tolerance - gap)) {
                    break;
                }
                is_moved = true;
            }
        }
        is_moved
    }

    /// Opens a gap with these shares of nodes by so much (m), as far as they can: whether they can at all.
    fn open(&mut self, ends: &[(u32, f64)], normal: [f64; D], by: f64) -> bool {
        let free = |node: u32| match node as usize {
            at if at >= self.count => [0.0; D],
            at => self.constraints.of(at).map_or(normal, |held| held.free_part(normal)),
        };
        let gain: f64 = ends.iter().map(|&(node, share)| share * share * dot(free(node), normal)).sum();
        if !(gain > GAIN) {
            return false;
        }
        for &(node, share) in ends {
            let way = free(node);
            let x = &mut self.positions[node as usize];
            // Both orders round differently, and results depend on them.
            (0..D).for_each(|d| x[d] += if D == 2 { by / gain * (share * way[d]) } else { by / gain * share * way[d] });
        }
        true
    }
}
