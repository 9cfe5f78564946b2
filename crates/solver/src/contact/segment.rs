//! Segments against segments: the pressure of two surfaces is integrated over what they have in common, on
//! the line between both.
//!
//! Two segments a (of the first surface) and b that face each other have the common direction t = (t_a −
//! t_b)/|t_a − t_b| and the normal n ⟂ t. Their common part is where both projections on t overlap; at each
//! of its Gauss points stand the points x_a and x_b of the segments with the same coordinate along t, and
//! between them a spring with the gap g = n·(x_a − x_b) and the stiffness κ w ℓ (weight w, length ℓ of the
//! common part). The forces are F ∂g/∂x of the four nodes: the gap does not change when both segments move
//! together, so both momenta are exact. A uniform gap gives the consistent loads of a uniform pressure on
//! both meshes, so flat surfaces pass the patch test whatever their nodes; node-to-segment contact does not.
//! In an axisymmetric body each point stands for its present circumference, w ℓ 2π x with x half way between
//! x_a and x_b, and the forces are the gradient of that energy. After Papadopoulos and Taylor, Comput. Meth.
//! Appl. Mech. Engng 94 (1992) 373-389 (integration over the parts that segments have in common) and Puso and
//! Laursen, Comput. Meth. Appl. Mech. Engng 193 (2004) 601-629 (common plane of both).
//!
//! Which pairs there are comes from the [`Tracker`], nodes of each surface against the other: the two
//! segments at a node that touches, with the segment it touches and its neighbours. So nothing is paired with
//! the back side of a thin body.

mod common;
mod space;
mod start;
mod tied;

use super::checked::Look;
use super::depths::Depths;
use super::findings::Findings;
use super::formulation::{FormulationKind, Setup, Side, both_passes};
use super::law::{Law, penalty};
use super::springs::{Answers, Patch, Slip, Spring, Springs};
use super::tied::Beside;
use super::tied::surfaces::Bound;
use super::tracker::{Certificate, SearchReport, Tracker};
use super::{Formulation, Scene, Sweep, Vector};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::forest;
use crate::mesh::surface::tributary::Depth;
use crate::mesh::surface::{NONE, Surface};
use crate::model::{ContactLaw, Penalty};
use crate::rows::Rows;
use common::Common;
pub(in crate::contact) use start::{ByNodes, pairs_again};
use start::{Start, Unseen};
use std::any::Any;

/// Registry entry.
pub const KIND: FormulationKind = FormulationKind {
    name: "segment",
    doc: "segments (in 3D facets) against each other, integrated over their common part: passes the contact patch test on any meshes",
    source: "Papadopoulos and Taylor (1992); common plane as in Puso and Laursen (2004)",
    passes: both_passes,
    tied: Some(&tied::SURFACES),
    is_carried: false,
    in_2d: Some(|setup| Ok(Box::new(Segment::of(setup)))),
    in_3d: Some(|setup| Ok(Box::new(space::Segment::of(setup)))),
};

/// Place (0 to 1) and weight of integration points.
type Rule = &'static [[f64; 2]];
const TWO: Rule = &[[0.211_324_865_405_187_13, 0.5], [0.788_675_134_594_812_9, 0.5]];
const ONE: Rule = &[[0.5, 1.0]];
/// Common parts shorter than this fraction of a segment are round-off.
const SLIVER: f64 = 1e-9;
/// Ends that lie together within this fraction of a common part belong to both segments.
const FLUSH: f64 = 1e-6;
/// A pair may be deeper than its nodes by this factor. Normals of segments that face each other differ from
/// the common one by less than 45 degrees, 1/cos 45° = 1.41; what is deeper by more belongs to another side
/// of a corner.
const DEEPER: f64 = 2.0;

/// A new pair that had more than this fraction of its shorter segment in common at the beginning of the step
/// already has not slid or turned in: it was not seen before. What its springs would store no one put in, so
/// that their gaps count as zero until the surfaces part.
const AT_ONCE: f64 = 0.05;

/// The formulation.
pub struct Segment {
    tracker: Tracker,
    /// Per surface.
    chains: Vec<Chain>,
    law: Box<dyn Law>,
    penalty: Penalty,
    rule: Rule,
    depth: Depth,
    start: Start<2>,
    /// Pairs of this step, ascending.
    pairs: Vec<[u32; 2]>,
    /// Those that have a common part.
    commons: Vec<Meeting>,
    /// Nodes that pairs join, as a forest by index of the first surface's nodes, then of the second's; and
    /// the least energy per area at ends in each tree, J/m².
    tree: Vec<u32>,
    least: Vec<f64>,
    /// Of each node whether common parts of the first (1) or second segment (2) of a pair end there and do
    /// not continue, and of each tree of which surfaces its free ends are.
    free_ends: Vec<u8>,
    owners: Vec<u8>,
    /// Pairs with springs in this step, and in the last one.
    facing: Vec<Facing>,
    before: Vec<Facing>,
    /// Energy of springs that were not found again, J/m.
    lost_contact_energy: f64,
    /// How deep nodes are against the local thickness.
    depths: Depths,
}

/// Two segments with a common part.
#[derive(Clone, Copy)]
struct Meeting {
    pair: [u32; 2],
    common: Common,
    /// Pressure per depth, Pa/m.
    pressure: f64,
    /// Distance that they keep, m.
    distance: f64,
}

/// What is known of a surface beyond its tracking.
struct Chain {
    /// κ behind each segment, Pa/m.
    stiffness: Vec<f64>,
    /// Indices of each segment's nodes among the surface's nodes.
    local: Vec<[u32; 2]>,
    /// Segments at each node.
    around: Rows<u32>,
    /// Depth of each node in this step, m; negative where it is outside.
    depth: Vec<f64>,
    /// Nodes whose depth is set.
    deep: Vec<u32>,
}

/// Two segments with springs, and the elastic slips of these: they stay with the integration points of their
/// pair. Points move along the segments only as fast as the surfaces slide, and where they slide friction
/// sets the slip again.
#[derive(Clone, Copy, Debug, Default)]
struct Facing {
    pair: [u32; 2],
    length: f64,
    slips: [f64; 2],
    /// Gaps that count as zero, m; not positive.
    offsets: [f64; 2],
    /// Energy of its springs at n − ½, J/m.
    stored: f64,
}

persist_all!(Facing { pair, length, slips, offsets, stored });

impl Chain {
    fn new(surface: &Surface<2>, stiffness: Vec<f64>) -> Self {
        // Nodes of segments are nodes of the surface.
        let local: Vec<[u32; 2]> = surface
            .segments
            .iter()
            .map(|segment| segment.map(|node| surface.nodes.partition_point(|&other| other < node) as u32))
            .collect();
        let ends = (0..).zip(&local).flat_map(|(segment, nodes)| nodes.map(|node| (node, segment)));
        let around = Rows::new(surface.nodes.len(), ends);
        let depth = vec![f64::NEG_INFINITY; surface.nodes.len()];
        Self { stiffness, local, around, depth, deep: Vec::new() }
    }
}

impl Segment {
    fn of(mut setup: Setup<'_, 2>) -> Self {
        // With springs that don't yield two points a pair were more conditions than the nodes can meet.
        let rule = if matches!(setup.contact.interface.law, ContactLaw::Multiplier) { ONE } else { TWO };
        let law = (setup.law)();
        let (penalty, depth, start) = (setup.penalty(), setup.depth, Start::of(&setup, law.reach()));
        // Ties hold all elements: the pressure of unlike ones is even where their springs are alike.
        let is_tied = setup.contact.tied.is_some();
        let stiffness = |side: &Side<'_, 2>| if is_tied { side.softest.clone() } else { side.stiffness.clone() };
        let chains: Vec<Chain> = setup.sides.iter().map(|side| Chain::new(&side.surface.target.surface, stiffness(side))).collect();
        let count = chains.iter().map(|chain| chain.depth.len()).sum();
        let tracker = setup.tracker().with_ends(setup.positions);
        Self {
            tracker,
            depths: setup.overlap_check,
            chains,
            law,
            penalty,
            rule,
            depth,
            start,
            pairs: Vec::new(),
            commons: Vec::new(),
            tree: vec![0; count],
            least: vec![0.0; count],
            free_ends: vec![0; count],
            owners: vec![0; count],
            facing: Vec::new(),
            before: Vec::new(),
            lost_contact_energy: 0.0,
        }
    }

    /// Surfaces of the segments of a pair.
    fn surfaces(&self) -> [usize; 2] {
        [0, self.chains.len() - 1]
    }

    /// Nodes of the segments of a pair.
    fn nodes(&self, pair: [u32; 2]) -> [[u32; 2]; 2] {
        let surfaces = self.surfaces();
        [0, 1].map(|k| self.tracker.targets()[surfaces[k]].surface.segments[pair[k] as usize])
    }

    /// The pairs that touching nodes lead to, without those that are bound.
    fn pair_up(&mut self, bound: &Bound, scene: &Scene<'_, 2>) {
        self.pairs.clear();
        for chain in &mut self.chains {
            for node in chain.deep.drain(..) {
                chain.depth[node as usize] = f64::NEG_INFINITY;
            }
        }
        self.tracker.track(scene.sweep, self.start.within());
        self.depths.begin(scene);
        for touch in self.tracker.touches() {
            let side = self.tracker.side(touch.pass);
            let [slave, target] = if side > 0.0 { [0, 1] } else { [self.chains.len() - 1, 0] };
            let chain = &mut self.chains[slave];
            let depth = &mut chain.depth[touch.slave as usize];
            *depth = depth.max(-touch.projection.gap);
            chain.deep.push(touch.slave);
            let (surface, b) = (&self.tracker.targets()[target].surface, touch.projection.segment);
            for &a in self.chains[slave].around.of(touch.slave as usize) {
                for b in [surface.previous[b as usize], b, surface.next[b as usize]] {
                    if b != NONE {
                        let forward = if side == 0.0 { a < b } else { slave == 0 };
                        self.pairs.push(if forward { [a, b] } else { [b, a] });
                    }
                }
            }
        }
        self.depths.end();
        self.pairs.sort_unstable();
        self.pairs.dedup();
        self.pairs.retain(|&pair| bound.frees(pair));
    }

    /// What two segments have in common; `None` where they don't face each other. Those that had springs in
    /// the last step keep them, however deep they are: a pair that came and went would give its energy and
    /// take it away.
    fn common(&self, pair: [u32; 2], positions: &[Vector]) -> Option<Common> {
        let (surfaces, nodes) = (self.surfaces(), self.nodes(pair));
        if nodes[0].iter().any(|node| nodes[1].contains(node)) {
            return None;
        }
        let common = Common::new(nodes, positions)?;
        if self.facing.binary_search_by_key(&pair, |facing| facing.pair).is_ok() {
            return Some(common);
        }
        let depth = |k: usize, end: usize| {
            let chain = &self.chains[surfaces[k]];
            chain.depth[chain.local[pair[k] as usize][end] as usize]
        };
        // The nodes at the beginning are a_0 and b_1, at the end a_1 and b_0.
        for ([gap, ..], end) in common.ends.into_iter().zip([0, 1]) {
            if gap < 0.0 && -gap > DEEPER * f64::max(depth(0, end), depth(1, 1 - end)) + SLIVER * common.length {
                return None;
            }
        }
        Some(common)
    }

    /// Elastic slips and offsets of the points of a pair: what they had, or what its first segment had in the
    /// mean; and whether the pair is new.
    fn kept(&self, pair: [u32; 2], length: f64) -> (Facing, bool) {
        if let Ok(at) = self.before.binary_search_by_key(&pair, |facing| facing.pair) {
            return (Facing { length, ..self.before[at] }, false);
        }
        let first = self.before.partition_point(|facing| facing.pair[0] < pair[0]);
        let same = self.before[first..].iter().take_while(|facing| facing.pair[0] == pair[0]);
        let (mut sums, mut whole) = ([0.0; 2], 0.0);
        for facing in same {
            let part = facing.length / self.rule.len() as f64;
            for k in 0..self.rule.len() {
                sums = [sums[0] + part * facing.slips[k], sums[1] + part * facing.offsets[k]];
            }
            whole += facing.length;
        }
        let [slip, offset] = if whole > 0.0 { sums.map(|sum| sum / whole) } else { [0.0; 2] };
        (Facing { pair, length, slips: [slip; 2], offsets: [offset; 2], stored: 0.0 }, true)
    }
}

impl Segment {
    /// Energy (J/m²) and pressure (Pa) of the law at a gap.
    fn density(&self, gap: f64, pressure: f64) -> [f64; 2] {
        let patch = Patch { stiffness: pressure, area: 1.0, ..Patch::default() };
        let small = 1e-6 * gap.abs();
        // The slope of the energy by differences: exact for parabolas, and all laws are made of them.
        let slope = |small: f64| 0.5 * (self.law.stored(&patch, gap - small) - self.law.stored(&patch, gap + small)) / small;
        [self.law.stored(&patch, gap), if small > 0.0 { slope(small) } else { 0.0 }]
    }

    /// Index of a pair's first node in the forest.
    fn place(&self, pair: [u32; 2], k: usize, end: usize) -> u32 {
        let before = if self.surfaces()[k] == 0 { 0 } else { self.chains[0].depth.len() as u32 };
        before + self.chains[self.surfaces()[k]].local[pair[k] as usize][end]
    }

    /// The region of a pair.
    fn root(&mut self, pair: [u32; 2]) -> u32 {
        let at = self.place(pair, 0, 0);
        forest::root(&mut self.tree, at)
    }

    /// Pressure per depth of a pair, Pa/m.
    fn pressure(&self, pair: [u32; 2]) -> f64 {
        let surfaces = self.surfaces();
        let [own, other] = [0, 1].map(|k| self.chains[surfaces[k]].stiffness[pair[k] as usize]);
        penalty::pressure(self.penalty, own, other)
    }

    /// Adds the springs of a pair.
    fn connect(&mut self, Meeting { pair, common, pressure, distance }: Meeting, sweep: Sweep<'_, 2>, springs: &mut Springs<2>) {
        let at = self.root(pair);
        let least = self.least[at as usize];
        let (mut facing, is_new) = self.kept(pair, common.length);
        let may_be = is_new && self.start.has_begun && self.law.is_elastic();
        let at_once = may_be && Common::new(common.nodes, sweep.old).is_some_and(|before| before.is_long());
        for (k, &[place, weight]) in self.rule.iter().enumerate() {
            let (gap, mut ends) = common.point(place);
            let gap = gap - distance;
            let unseen = at_once.then(|| Unseen { moved: common.moved(sweep), way: common.way(&ends, sweep) });
            facing.offsets[k] = self.start.offset(facing.offsets[k], gap, unseen);
            let gap = gap - facing.offsets[k];
            let [energy, push] = self.density(gap, pressure);
            let around = self.depth.at(common.middle(place).map(|x| x.max(0.0)));
            if energy > least && push > 0.0 {
                let factor = -(energy - least) / push;
                common.vary_area(&mut ends, factor);
                if self.depth == Depth::Revolution {
                    common.vary_radius(&mut ends, place, factor);
                }
            }
            let (normal, area) = (common.normal, weight * common.area * around);
            let side = if self.chains.len() == 1 { 0.0 } else { 1.0 };
            let (stiffness, slip) = (pressure * area, facing.slips[k]);
            springs.push(Spring { normal, gap, stiffness, area, side, ..Spring::default() }, Slip::of([slip]), &ends);
        }
        self.facing.push(facing);
    }

    /// Energy of the pairs that had springs in the last step, have none now, and yet have much in common:
    /// what runs out as surfaces slide continues in its neighbours.
    fn missing(&self, positions: &[Vector]) -> f64 {
        let (mut now, mut sum) = (self.facing.iter().map(|facing| facing.pair).peekable(), 0.0);
        for before in &self.before {
            while now.next_if(|&pair| pair < before.pair).is_some() {}
            if now.peek() != Some(&before.pair) && before.stored > 0.0 {
                sum += if Common::new(self.nodes(before.pair), positions).is_some_and(|common| common.is_long()) {
                    before.stored
                } else {
                    0.0
                };
            }
        }
        sum
    }

    /// Joins the pairs that share nodes to regions, and finds the least energy per area at ends of common
    /// parts in each.
    fn join(&mut self) {
        for (i, root) in self.tree.iter_mut().enumerate() {
            *root = i as u32;
        }
        self.least.fill(f64::INFINITY);
        self.free_ends.fill(0);
        self.owners.fill(0);
        for index in 0..self.commons.len() {
            let pair = self.commons[index].pair;
            let first = self.root(pair);
            for (k, end) in [(0, 1), (1, 0), (1, 1)] {
                let at = self.place(pair, k, end);
                forest::join(&mut self.tree, first, at);
            }
        }
        for index in 0..self.commons.len() {
            let Meeting { pair, common, pressure, distance } = self.commons[index];
            let at = self.root(pair) as usize;
            for [gap, whose, end] in common.ends {
                self.least[at] = self.least[at].min(self.density(gap - distance, pressure)[0]);
                let node = self.place(pair, whose as usize, end as usize);
                self.free_ends[node as usize] ^= 1 << whose as usize;
            }
        }
        // Where both pairs at a node end with it neither is an end of the region. Where one surface overhangs
        // here and the other there the region's length is that of neither.
        for index in 0..self.commons.len() {
            let Meeting { pair, common, .. } = self.commons[index];
            let at = self.root(pair) as usize;
            for ([_, whose, end], other) in common.ends.into_iter().zip(common.beyond()) {
                let node = self.place(pair, whose as usize, end as usize);
                if other > FLUSH * common.length {
                    self.owners[at] |= self.free_ends[node as usize];
                }
            }
            if self.owners[at] == 3 {
                self.least[at] = 0.0;
            }
        }
    }
}

impl Segment {
    /// [`Formulation::detect`] for what is not bound.
    fn detect_free(&mut self, bound: &Bound, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        self.pair_up(bound, scene);
        self.commons.clear();
        for index in 0..self.pairs.len() {
            let pair = self.pairs[index];
            if let Some(common) = self.common(pair, scene.sweep.new) {
                let (pressure, distance) = (self.pressure(pair), self.start.distance([&common.nodes[0], &common.nodes[1]]));
                self.commons.push(Meeting { pair, common, pressure, distance });
            }
        }
        self.join();
        std::mem::swap(&mut self.facing, &mut self.before);
        self.facing.clear();
        for index in 0..self.commons.len() {
            self.connect(self.commons[index], scene.sweep, springs);
        }
        self.lost_contact_energy = self.missing(scene.sweep.new);
        self.start.has_begun = true;
    }
}

impl Formulation<2> for Segment {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        self.detect_free(&Bound::default(), scene, springs);
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            chains: _, law: _, penalty: _, rule: _, depth: _, pairs: _, commons: _,
            tree: _, least: _, free_ends: _, owners: _, before: _, lost_contact_energy: _,
            tracker, start, facing, depths,
        } = self;
        tracker.persist(archive)?;
        depths.persist(archive)?;
        persist_each!(archive; start, facing);
        let segments = self.surfaces().map(|surface| self.tracker.targets()[surface].surface.segments.len());
        let is_there = |facing: &Facing| (0..2).all(|k| (facing.pair[k] as usize) < segments[k]);
        archive.check(self.facing.iter().all(is_there), "a segment is not there")
    }

    fn beside(&self) -> Beside {
        Beside::Surfaces
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        self.tracker.inherit(&old.tracker);
        self.start.has_begun = old.start.has_begun;
        self.depths.inherit(&old.depths);
        let (surfaces, again) = (self.surfaces(), pairs_again(self.segments(), old.segments()));
        let now = |facing: &Facing| {
            let mut pair = again(facing.pair)?;
            // A surface that meets itself has each pair once.
            if surfaces[0] == surfaces[1] {
                pair.sort_unstable();
            }
            // What is not found again went with its surface.
            Some(Facing { pair, stored: 0.0, ..*facing })
        };
        self.facing = old.facing.iter().filter_map(now).collect();
        self.facing.sort_by_key(|facing| facing.pair);
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

    fn remember(&mut self, solved: Answers<'_, 2>) {
        let count = self.rule.len();
        for (index, facing) in self.facing.iter_mut().enumerate() {
            facing.stored = 0.0;
            for (slip, answer) in facing.slips.iter_mut().zip(solved.part(index * count, (index + 1) * count)) {
                *slip = answer.slid().slip_new[0];
                facing.stored += answer.stored_new();
            }
        }
    }
}

#[cfg(test)]
mod tests;
