//! Which facets may have something in common: those at a node that touches, with the facet that it touches
//! and its neighbours. So nothing is paired with the back side of a thin body.
//!
//! Touches come from the tracker of nodes; pairs go to the formulation.

use super::common::Frame;
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::contact::Sweep;
use crate::contact::continuity::SpringHistory;
use crate::contact::node_facet::tracker::{ContactHistory, Tracker};
use crate::contact::projection::node_facet::Placed;
use crate::mesh::surface::{Corners, NONE};
use crate::tensor::dot;

type Vector = [f64; 3];

/// Cosine of the angle between a facet and one across an edge beyond which its surface turns away there.
const TURNS: f64 = 0.5;

/// Pairs of facets of two surfaces, or of one that meets itself.
pub(super) struct Pairs {
    pub(super) tracker: Tracker,
    /// Per surface.
    layers: Vec<Layer>,
    /// Pairs of this step, ascending.
    pub(super) list: Vec<[u32; 2]>,
    /// What leads to them: the first facet above the second one, as often as a node touches.
    found: Vec<u64>,
    /// Number of this step.
    step: u32,
    /// Energy at the rims of both bodies of a pair of bodies in the last step, J: (bodies ascending, [at the
    /// rim of the first, of the second]).
    rims: Vec<([u32; 2], [f64; 2])>,
}

/// What is known of a surface in a step.
struct Layer {
    /// Each facet as it is, and the step of that.
    frames: Vec<(u32, Frame)>,
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
                depth: vec![f64::NEG_INFINITY; surface.nodes.len()],
                deep: Vec::new(),
                local: surface.facets.iter().map(local).collect(),
            }
        });
        Self { layers: layers.collect(), tracker, list: Vec::new(), found: Vec::new(), step: 0, rims: Vec::new() }
    }

    /// Surfaces of the facets of a pair.
    pub(super) fn surfaces(&self) -> [usize; 2] {
        [0, self.layers.len() - 1]
    }

    /// The pairs that touching nodes lead to; nodes farther apart than `extra` (m) beyond what they move do
    /// not touch.
    pub(super) fn find(&mut self, sweep: Sweep<'_, 3>, extra: f64) {
        self.step = self.step.wrapping_add(1).max(1);
        self.found.clear();
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
                    let meets = !is_one || !shares_a_node(target.facets[a as usize], target.facets[b as usize]);
                    if meets {
                        let forward = if is_one { a < b } else { slave == 0 };
                        let [first, second] = if forward { [a, b] } else { [b, a] };
                        self.found.push(u64::from(first) << 32 | u64::from(second));
                    }
                }
            }
        }
        self.found.sort_unstable();
        self.found.dedup();
        self.list.clear();
        self.list.extend(self.found.iter().map(|&pair| [(pair >> 32) as u32, pair as u32]));
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

    /// Whether a surface ends at one of these edges of a facet (as bits), or turns away there.
    fn is_at_rim(&self, surface: usize, facet: u32, edges: u8, positions: &[Vector]) -> bool {
        let placed = Placed { surface: &self.tracker.surfaces()[surface], positions };
        let own = placed.facet_normal(facet);
        let turns = |other: u32| other == NONE || dot(own, placed.facet_normal(other)) < TURNS;
        (0..4).any(|k| edges & 1 << k != 0 && turns(placed.surface.across(facet, k)))
    }

    /// Begins to note energy at rims.
    pub(super) fn begin_rims(&mut self) {
        self.rims.clear();
    }

    /// Notes the energy (J) of a pair whose common part ends at these edges of both facets.
    pub(super) fn note_rims(&mut self, pair: [u32; 2], edges: [u8; 2], energy: f64, positions: &[Vector]) {
        let (bodies, surfaces) = (self.bodies(pair), self.surfaces());
        if !(energy > 0.0) || bodies[0] == bodies[1] {
            return;
        }
        let at_rim = [0, 1].map(|k| if self.is_at_rim(surfaces[k], pair[k], edges[k], positions) { energy } else { 0.0 });
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
    pub(super) fn frames(&mut self, pair: [u32; 2], positions: &[Vector]) -> [&Frame; 2] {
        let (surfaces, step) = (self.surfaces(), self.step);
        for k in 0..2 {
            let (of, frame) = &mut self.layers[surfaces[k]].frames[pair[k] as usize];
            if *of != step {
                *of = step;
                *frame = Frame::new(self.tracker.surfaces()[surfaces[k]].facets[pair[k] as usize], positions);
            }
        }
        [0, 1].map(|k| &self.layers[surfaces[k]].frames[pair[k] as usize].1)
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

fn shares_a_node(one: [u32; 4], other: [u32; 4]) -> bool {
    one.corners().iter().any(|node| other.corners().contains(node))
}
