//! Which facets may have something in common: those at a node that touches, with the facet that it touches
//! and its neighbours. So nothing is paired with the back side of a thin body.
//!
//! Touches come from the tracker of nodes; pairs go to the formulation.

use super::common::{Borders, Facets, Frame};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::contact::Sweep;
use crate::contact::continuity::SpringHistory;
use crate::contact::node_facet::tracker::{ContactHistory, Tracker};
use crate::contact::projection::node_facet::Placed;
use crate::mesh::surface::{Corners, NONE};
use crate::tensor::dot;

type Vector = [f64; 3];

/// Pairs of facets of two surfaces, or of one that meets itself.
pub(super) struct Pairs {
    pub(super) tracker: Tracker,
    /// Per surface.
    layers: Vec<Layer>,
    /// Pairs of this step, ascending.
    pub(super) list: Vec<[u32; 2]>,
    /// What leads to them.
    found: Found,
    /// Number of this step.
    step: u32,
    /// Energy at the rims of both bodies of a pair of bodies in the last step, J: (bodies ascending, [at the
    /// rim of the first, of the second]).
    rims: Vec<([u32; 2], [f64; 2])>,
}

/// Partners of a facet that have room beside it.
const BESIDE: usize = 16;

/// Pairs, each once, as they are found: as often as nodes touch.
#[derive(Default)]
struct Found {
    /// Second facets of each first one, else [`NONE`], and how many these are.
    beside: Vec<([u32; BESIDE], usize)>,
    /// First facets that have pairs.
    firsts: Vec<u32>,
    /// Pairs that had no room, as often as they are found.
    others: Vec<[u32; 2]>,
}

impl Found {
    fn add(&mut self, first: u32, second: u32) {
        let (beside, count) = &mut self.beside[first as usize];
        // All at once instead of one after the other until it is found.
        if beside.iter().fold(false, |is_there, &other| is_there | (other == second)) {
            return;
        }
        if *count == 0 {
            self.firsts.push(first);
        }
        match beside.get_mut(*count) {
            Some(room) => (*room, *count) = (second, *count + 1),
            None => self.others.push([first, second]),
        }
    }

    /// Writes all pairs, ascending.
    fn drain_into(&mut self, list: &mut Vec<[u32; 2]>) {
        list.clear();
        self.firsts.sort_unstable();
        for first in self.firsts.drain(..) {
            let (beside, count) = &mut self.beside[first as usize];
            beside[..*count].sort_unstable();
            list.extend(beside[..*count].iter().map(|&second| [first, second]));
            (*beside, *count) = ([NONE; BESIDE], 0);
        }
        if !self.others.is_empty() {
            list.append(&mut self.others);
            list.sort_unstable();
            list.dedup();
        }
    }
}

/// What is known of a surface in a step.
struct Layer {
    /// Each facet as it is, and the step of that.
    frames: Vec<(u32, Frame)>,
    /// What is beyond its edges, and the step of that.
    borders: Vec<(u32, Borders)>,
    /// Depth of each node, m; negative where it is outside.
    depth: Vec<f64>,
    /// Nodes whose depth is set.
    deep: Vec<u32>,
    /// Indices of each facet's nodes among the surface's nodes.
    local: Vec<[u32; 4]>,
}

impl Pairs {
    pub(super) fn new(tracker: Tracker) -> Self {
        let layers = tracker.surfaces().iter().map(|surface| {
            let local = |facet: &[u32; 4]| facet.map(|node| surface.nodes.partition_point(|&other| other < node) as u32);
            Layer {
                frames: vec![(0, Frame::default()); surface.facets.len()],
                borders: vec![(0, Borders::ALONE); surface.facets.len()],
                depth: vec![f64::NEG_INFINITY; surface.nodes.len()],
                deep: Vec::new(),
                local: surface.facets.iter().map(local).collect(),
            }
        });
        Self { layers: layers.collect(), tracker, list: Vec::new(), found: Found::default(), step: 0, rims: Vec::new() }
    }

    /// Surfaces of the facets of a pair.
    pub(super) fn surfaces(&self) -> [usize; 2] {
        [0, self.layers.len() - 1]
    }

    /// The pairs that touching nodes lead to; nodes farther apart than `extra` (m) beyond what they move do
    /// not touch.
    pub(super) fn find(&mut self, sweep: Sweep<'_, 3>, extra: f64) {
        self.step = self.step.wrapping_add(1).max(1);
        self.found.beside.resize(self.layers[0].frames.len(), ([NONE; BESIDE], 0));
        for layer in &mut self.layers {
            for node in layer.deep.drain(..) {
                layer.depth[node as usize] = f64::NEG_INFINITY;
            }
        }
        self.tracker.track(sweep, extra);
        let surfaces = self.tracker.surfaces();
        for touch in self.tracker.touches() {
            let slave = self.tracker.slave(touch.pass);
            let layer = &mut self.layers[slave];
            let depth = &mut layer.depth[touch.slave as usize];
            *depth = depth.max(-touch.projection.gap);
            layer.deep.push(touch.slave);
            let (target, b) = (self.tracker.target(touch.pass), touch.projection.facet);
            let is_one = self.tracker.side(touch.pass) == 0.0;
            let beside = (0..target.facets[b as usize].corners().len()).map(|k| target.across(b, k));
            for b in std::iter::once(b).chain(beside).filter(|&b| b != NONE) {
                for &a in surfaces[slave].around(touch.slave as usize) {
                    let meets = !is_one || !target.are_kin(&target.facets[a as usize], &target.facets[b as usize]);
                    if meets {
                        let forward = if is_one { a < b } else { slave == 0 };
                        let [first, second] = if forward { [a, b] } else { [b, a] };
                        self.found.add(first, second);
                    }
                }
            }
        }
        self.found.drain_into(&mut self.list);
    }

    /// Depth of the deepest node of a pair, m.
    pub(super) fn depth(&self, pair: [u32; 2]) -> f64 {
        let deepest = |k: usize| {
            let layer = &self.layers[self.surfaces()[k]];
            layer.local[pair[k] as usize].iter().map(|&node| layer.depth[node as usize]).fold(f64::NEG_INFINITY, f64::max)
        };
        deepest(0).max(deepest(1))
    }

    /// Bodies of the facets of a pair.
    fn bodies(&self, pair: [u32; 2]) -> [u32; 2] {
        let surfaces = self.surfaces();
        [0, 1].map(|k| {
            let node = self.tracker.surfaces()[surfaces[k]].facets[pair[k] as usize][0];
            self.tracker.bodies().get(node as usize).copied().unwrap_or(u32::MAX)
        })
    }

    /// Begins to note energy at rims.
    pub(super) fn begin_rims(&mut self) {
        self.rims.clear();
    }

    /// Notes the energy (J) of a pair whose common part ends at these rims of both facets.
    pub(super) fn note_rims(&mut self, pair: [u32; 2], edges: [u8; 2], energy: f64) {
        let bodies = self.bodies(pair);
        if !(energy > 0.0) || bodies[0] == bodies[1] {
            return;
        }
        let at_rim = edges.map(|edges| if edges == 0 { 0.0 } else { energy });
        let (key, is_turned) = ascending(bodies);
        let at = self.rims.binary_search_by_key(&key, |rim| rim.0).unwrap_or_else(|at| {
            self.rims.insert(at, (key, [0.0; 2]));
            at
        });
        (0..2).for_each(|k| self.rims[at].1[if is_turned { 1 - k } else { k }] += at_rim[k]);
    }

    /// With which of its facets the places of a pair go: 1 with the first, −1 with the second, 0 with the
    /// mean of both; see [`super`].
    pub(super) fn lead(&self, pair: [u32; 2]) -> f64 {
        let (key, is_turned) = ascending(self.bodies(pair));
        let Ok(at) = self.rims.binary_search_by_key(&key, |rim| rim.0) else { return 0.0 };
        let [first, second] = self.rims[at].1;
        let sum = first + second;
        let lead = if sum > 0.0 { (first - second) / sum } else { 0.0 };
        if is_turned { -lead } else { lead }
    }

    /// The facets of a pair in this step.
    pub(super) fn facets(&mut self, pair: [u32; 2], positions: &[Vector]) -> Facets<'_> {
        let surfaces = self.surfaces();
        let of = [0, 1].map(|k| {
            let at = pair[k] as usize;
            if self.layers[surfaces[k]].borders[at].0 != self.step {
                self.set_borders(surfaces[k], pair[k], positions);
            }
            self.layers[surfaces[k]].borders[at].1
        });
        let (mut borders, mut cut) = (of, 0);
        if surfaces[0] == surfaces[1] {
            let bodies = self.bodies(pair);
            cut = usize::from(bodies[1] < bodies[0]);
            // Two facets of one body may come in any order, depending on the pair.
            if bodies[0] == bodies[1] {
                borders = of.map(Borders::as_it_is);
            }
        }
        Facets { frames: [0, 1].map(|k| &self.layers[surfaces[k]].frames[pair[k] as usize].1), borders, cut }
    }

    /// Sets what a facet is in this step, and what is beyond its edges.
    fn set_borders(&mut self, surface: usize, facet: u32, positions: &[Vector]) {
        let normal = self.frame(surface, facet, positions).normal;
        let cosines = [0, 1, 2, 3].map(|k| {
            let beyond = self.tracker.surfaces()[surface].across(facet, k);
            if beyond == NONE { -1.0 } else { dot(normal, self.frame(surface, beyond, positions).normal) }
        });
        self.layers[surface].borders[facet as usize] = (self.step, Borders::new(cosines));
    }

    /// A facet of a surface in this step.
    fn frame(&mut self, surface: usize, facet: u32, positions: &[Vector]) -> &Frame {
        let (of, frame) = &mut self.layers[surface].frames[facet as usize];
        if *of != self.step {
            *of = self.step;
            *frame = Frame::new(self.tracker.surfaces()[surface].facets[facet as usize], positions);
        }
        frame
    }

    /// The same at any positions, m.
    pub(super) fn frames_at(&self, pair: [u32; 2], positions: &[Vector]) -> [Frame; 2] {
        let surfaces = self.surfaces();
        [0, 1].map(|k| Frame::new(self.tracker.surfaces()[surfaces[k]].facets[pair[k] as usize], positions))
    }

    /// Notes where nodes touch: the tracker begins there in the next step.
    pub(super) fn note_touches(&mut self, positions: &[Vector]) {
        for index in 0..self.tracker.touches().len() {
            let touch = self.tracker.touches()[index];
            let (facet, normal) = (touch.projection.facet, touch.projection.normal);
            let rest = Placed { surface: self.tracker.target(touch.pass), positions }.rests_on(&touch.projection);
            let memory = *self.tracker.kept(&touch);
            let spring = SpringHistory { normal, ..memory.spring };
            *self.tracker.kept_mut(&touch) = ContactHistory { spring, facet, rest, ..memory };
        }
    }

    pub(super) fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.tracker.persist(archive)?;
        self.rims.persist(archive)
    }
}

/// Two bodies, the lower first, and whether they were the other way round.
fn ascending([first, second]: [u32; 2]) -> ([u32; 2], bool) {
    ([first.min(second), first.max(second)], second < first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;

    #[test]
    fn pairs_that_are_found_in_any_order_and_often_are_listed_ascending_and_once() {
        let (mut random, mut found, mut list) = (Random::new(2), Found::default(), Vec::new());
        found.beside.resize(20, ([NONE; BESIDE], 0));
        for _ in 0..50 {
            let mut expected: Vec<[u32; 2]> = (0..500).map(|_| [20.0, 30.0].map(|count| (count * random.unit()) as u32)).collect();
            expected.iter().for_each(|&[first, second]| found.add(first, second));
            found.drain_into(&mut list);
            expected.sort_unstable();
            expected.dedup();
            assert_eq!(list, expected);
        }
    }
}
