//! Facets against facets in 3D: the pressure of two surfaces is integrated over what they have in common, on
//! the plane between both.
//!
//! A facet of four nodes is four flat triangles about its middle ([`super::super::projection::node_facet`]),
//! so that ∫ N_k dA of a flat one is that of its bilinear functions. Two facets a and b that face each other
//! have the common normal n ∥ n_b − n_a, which halves the angle between them. Over each place of the plane
//! across n lie the points x_a = Σ N_k x_k and x_b = Σ M_k x_k with x_a − x_b = g n. Of the common part P of
//! both projections a spring stands for
//!
//! - the mean gap ∫_P g dA / A, with the shares ∫_P N_k dA / A and −∫_P M_k dA / A of the nodes; or
//! - the gaps ∫_P N_c g dA / ∫_P N_c dA at the corners c of the smaller facet, with their shares:
//!
//! the latter where P covers that facet or spans one in a direction, between both by parts that sum up to
//! one. For where facets lie on each other corner on corner, the means alone do not see corners move in and
//! out in turn, and elsewhere they do; they are a quarter of the springs. Narrow strips have the mean alone.
//! All integrals are exact, where no corner is within a millionth of an edge (`fan.rs`, `polygon.rs`).
//!
//! *Patch test.* The shares of all springs sum up to ∫ N_k dA: a uniform gap between flat surfaces gives the
//! consistent loads of a uniform pressure, whatever the meshes. So that it is uniform beside elements of any
//! size the stiffness is that of the softest element of either part.
//!
//! *Momenta.* The mean points of a spring are the gap apart along its normal: forces along it have no couple.
//! Friction's is balanced by both facets, see [`common`].
//!
//! *Energy.* The rows are the rate of the gap at places that go with the mean of both surfaces: as the
//! surfaces slide by u, it changes by the slopes of both against the plane, −½ (β_a + β_b)·u, which n makes
//! opposite, and as n turns by none, since x_a − x_b ∥ n. What places go from pair to pair take their energy
//! with them, since both have the same gap there: the sum ∫ v(g) dA is kept but for how far means miss the
//! variation of g over a pair, and at the rims of a contact, which go with their own surface. A tilted block
//! on its edge would slide off its energy, or be braked. So where the rim is that of a, n is n_b, and the
//! places go with a; where either has rims n ∥ (1 + λ) n_b − (1 − λ) n_a with the difference λ of the
//! energies (of the step before) beside the rims of both over their sum, for each two bodies.
//!
//! Area that counts is A φ(c) 2/(1 + c) with the cosine c = −n_a·n_b: of facets that are inclined to n by
//! half their angle the load along their own normals is that of the pressure on them; φ fades facets out that
//! turn away from each other by more than 60 degrees. After Puso and Laursen, Comput. Meth. Appl. Mech. Engng
//! 193 (2004) 601-629.

mod common;
mod fan;
mod pairs;
mod polygon;
mod tied;

use super::super::checked::Look;
use super::super::continuity::Closed;
use super::super::findings::Findings;
use super::super::formulation::Setup;
use super::super::law::{Law, penalty};
use super::super::missed_contacts::MissedContactCheck;
use super::super::node_facet::make;
use super::super::overlap::OverlapCheck;
use super::super::search::registry;
use super::super::spin;
use super::super::springs::friction::cone;
use super::super::springs::{Answers, End, Slip, Spring, Springs};
use super::super::tied::Beside;
use super::super::tied::surfaces::Bound;
use super::super::tracker::{Certificate, SearchReport};
use super::super::{Formulation, Scene, Sweep};
use super::start::{Start, Unseen, pairs_again};
use super::{AT_ONCE, DEEPER};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::mesh::surface::SpaceSurface;
use crate::model::{ContactLaw, Penalty};
use common::{Common, Facets, PARTS, Part, Room};
use embate_lanes::Level;
use pairs::Pairs;
use std::any::Any;

type Vector = [f64; 3];

/// A pair that is deeper than its nodes by this fraction of its size is so by rounding.
const ROUNDING: f64 = 1e-9;

/// The formulation.
pub(super) struct Segment {
    pairs: Pairs,
    proof: MissedContactCheck,
    overlap_check: OverlapCheck,
    law: Box<dyn Law>,
    penalty: Penalty,
    /// Whether each pair has a single spring.
    is_mean: bool,
    slips: bool,
    level: Level,
    start: Start<3>,
    /// Softest κ of the part of each facet of each surface, Pa/m.
    stiffness: Vec<Vec<f64>>,
    /// Pairs with springs in this step, and in the last one.
    facing: Vec<Facing>,
    before: Vec<Facing>,
    /// The latter by their second facet, where new pairs ask for it.
    by_second: Vec<(u32, u32)>,
    /// Of each spring of the step its pair among `facing`, and which of its springs it is.
    used: Vec<(u32, u8)>,
    /// Volume springs, and their energy that was not found again, J.
    nets: Closed,
    lost_contact_energy: f64,
}

/// Two facets with springs, and what these know: the elastic slip of each, m, and the gap that counts as
/// zero, m; not positive.
#[derive(Clone, Copy, Debug, Default)]
struct Facing {
    pair: [u32; 2],
    area: f64,
    /// Of which facet the corners have springs, and rims of both at which the common part ends, as bits.
    owner: u8,
    edges: [u8; 2],
    slips: [Vector; PARTS],
    offsets: [f64; PARTS],
    /// Energy of its springs at n − ½, J.
    stored: f64,
}

persist_all!(Facing { pair, area, owner, edges, slips, offsets, stored });

impl Facing {
    /// The same in which all springs have the mean of those that have areas.
    fn evened(self, areas: [f64; PARTS]) -> Self {
        let mut sum = Mean::default();
        (0..PARTS).for_each(|slot| sum.add(areas[slot], self.slips[slot], self.offsets[slot]));
        let (slip, offset) = sum.mean();
        Self { slips: [slip; PARTS], offsets: [offset; PARTS], ..self }
    }

    /// Whether any spring has slip, or a gap that counts as zero.
    fn knows(&self) -> bool {
        self.slips != [[0.0; 3]; PARTS] || self.offsets != [0.0; PARTS]
    }

    /// The same with another owner of the corners.
    fn of(self, owner: u8) -> Self {
        Self { owner, ..self }
    }
}

/// Mean slip and offset by area.
#[derive(Default)]
struct Mean {
    area: f64,
    slip: Vector,
    offset: f64,
}

impl Mean {
    fn add(&mut self, area: f64, slip: Vector, offset: f64) {
        self.area += area;
        (0..3).for_each(|d| self.slip[d] += area * slip[d]);
        self.offset += area * offset;
    }

    fn mean(&self) -> (Vector, f64) {
        if self.area > 0.0 { (self.slip.map(|sum| sum / self.area), self.offset / self.area) } else { ([0.0; 3], 0.0) }
    }
}

impl Segment {
    pub(super) fn of(mut setup: Setup<'_, 3>) -> Self {
        let law = (setup.law)();
        let (start, penalty, interface) = (Start::of(&setup, law.reach()), setup.penalty(), &setup.contact.interface);
        // With springs that don't yield more than one a pair were more conditions than the nodes can meet.
        let is_mean = matches!(interface.law, ContactLaw::Multiplier);
        let (slips, passes) = (interface.friction.is_some(), setup.passes);
        let inputs: Vec<_> = passes.iter().map(|&pass| setup.input(pass, 2)).collect();
        let stiffness = setup.sides.iter().map(|side| side.softest.clone()).collect();
        let tracker = setup.tracker();
        let surfaces = tracker.surfaces();
        let proof = MissedContactCheck::new(surfaces, passes, setup.bodies, setup.positions, false, registry::<3>()[0].make);
        let overlap_check = match setup.contact.tied {
            Some(_) => setup.overlap_check.without_nets(),
            None => make::with_moduli(setup.overlap_check, surfaces, passes, &inputs),
        };
        Self {
            pairs: Pairs::new(tracker),
            proof,
            overlap_check,
            law,
            penalty,
            is_mean,
            slips,
            level: Level::best(),
            start,
            stiffness,
            facing: Vec::new(),
            before: Vec::new(),
            by_second: Vec::new(),
            used: Vec::new(),
            nets: Closed::default(),
            lost_contact_energy: 0.0,
        }
    }

    fn surface(&self, k: usize) -> &SpaceSurface {
        &self.pairs.tracker.surfaces()[self.pairs.surfaces()[k]]
    }

    /// Whether two facets have something in common: not where they don't face each other. Those that had
    /// springs in the last step keep them, however deep they are; what else is deeper than its nodes belongs
    /// to another side of a corner.
    fn meet(&mut self, pair: [u32; 2], was_there: bool, positions: &[Vector], common: &mut Common, room: &mut Room) -> bool {
        let lead = self.pairs.lead(pair);
        if !common.find(&self.pairs.facets(pair, positions), self.is_mean, lead, room, self.level) {
            return false;
        }
        let depth = || self.pairs.depth(pair);
        was_there || common.lowest >= 0.0 || -common.lowest <= DEEPER * depth() + ROUNDING * common.size()
    }

    /// What the springs of a pair know: what they knew (by the number of the pair in the last step), or the
    /// mean of those of its facets in the last step.
    fn kept(&mut self, pair: [u32; 2], before: Option<usize>, common: &Common) -> Facing {
        let now = Facing { pair, area: common.area, owner: common.owner, edges: common.edges, ..Facing::default() };
        if let Some(at) = before {
            let before = self.before[at];
            let kept = Facing { area: now.area, edges: now.edges, stored: 0.0, ..before };
            // Corners of another facet know nothing of those.
            return if before.owner == now.owner { kept } else { kept.evened([1.0; PARTS]).of(now.owner) };
        }
        if self.by_second.len() < self.before.len() {
            self.by_second.extend(self.before.iter().zip(0..).map(|(facing, at)| (facing.pair[1], at)));
            self.by_second.sort_unstable();
        }
        let mut sum = Mean::default();
        let mut add = |facing: &Facing| {
            for slot in 0..PARTS {
                sum.add(facing.area / PARTS as f64, facing.slips[slot], facing.offsets[slot]);
            }
        };
        let first = self.before.partition_point(|facing| facing.pair[0] < pair[0]);
        self.before[first..].iter().take_while(|facing| facing.pair[0] == pair[0]).for_each(&mut add);
        let first = self.by_second.partition_point(|&(facet, _)| facet < pair[1]);
        let second = self.by_second[first..].iter().take_while(|&&(facet, _)| facet == pair[1]);
        second.for_each(|&(_, at)| add(&self.before[at as usize]));
        let (slip, offset) = sum.mean();
        Facing { slips: [slip; PARTS], offsets: [offset; PARTS], ..now }
    }

    /// Pressure per depth of a pair, Pa/m.
    fn pressure(&self, pair: [u32; 2]) -> f64 {
        let surfaces = self.pairs.surfaces();
        let [own, other] = [0, 1].map(|k| self.stiffness[surfaces[k]][pair[k] as usize]);
        penalty::pressure(self.penalty, own, other)
    }

    /// Adds the springs of a pair, which has a number if it was there in the last step.
    fn connect(&mut self, pair: [u32; 2], before: Option<usize>, common: &Common, sweep: Sweep<'_, 3>, springs: &mut Springs<3>) {
        let mut facing = self.kept(pair, before, common);
        let may_be = before.is_none() && self.start.has_begun && self.law.is_elastic();
        let at_once = may_be && {
            let old = self.pairs.frames_at(pair, sweep.old);
            Common::new(&Facets::alone([&old[0], &old[1]]), true, 0.0, self.level).is_some_and(|before| before.fraction() > AT_ONCE)
        };
        let (surfaces, pressure) = (self.pairs.surfaces(), self.pressure(pair));
        let distance = self.start.distance([common.frames[0].nodes(), common.frames[1].nodes()]);
        let side = if surfaces[0] == surfaces[1] { 0.0 } else { 1.0 };
        let turn = if self.slips && facing.slips != [[0.0; 3]; PARTS] { common.turn(sweep) } else { [0.0; 3] };
        for part in common.parts() {
            let gap = part.gap - distance;
            let unseen = at_once.then(|| Unseen { moved: common.moved(sweep), way: common.way(part, sweep) });
            facing.offsets[part.slot] = self.start.offset(facing.offsets[part.slot], gap, unseen);
            let gap = gap - facing.offsets[part.slot];
            let spring = Spring { normal: common.normal, gap, stiffness: pressure * part.area, area: part.area, side, ..Spring::default() };
            if self.slips {
                push_with_slip(common, part, spring, spin::turned(facing.slips[part.slot], turn), springs);
            } else {
                springs.push_plain(spring, common.shares(part));
            }
            self.used.push((self.facing.len() as u32, part.slot as u8));
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
                let frames = self.pairs.frames_at(before.pair, positions);
                let common = Common::new(&Facets::alone([&frames[0], &frames[1]]), true, 0.0, self.level);
                sum += if common.is_some_and(|common| common.fraction() > AT_ONCE) { before.stored } else { 0.0 };
            }
        }
        sum
    }
}

/// Adds a spring that cares for slip, with what it had of it.
fn push_with_slip(common: &Common, part: &Part, spring: Spring<3>, slip: Vector, springs: &mut Springs<3>) {
    let tangents = common.tangents();
    let mut ends = [End::default(); 8];
    let count = common.ends(part, tangents, &mut ends);
    springs.push(spring, Slip::of(cone::carried(slip, tangents)), &ends[..count]);
}

impl Segment {
    /// [`Formulation::detect`] for what is not bound.
    fn detect_free(&mut self, bound: &Bound, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        self.overlap_check.see_step(scene);
        self.pairs.find(scene.sweep, self.start.within());
        self.proof.look_at(&self.pairs.tracker, None, scene.sweep);
        self.pairs.begin_rims();
        for facing in &self.facing {
            self.pairs.note_rims(facing.pair, facing.edges, facing.stored);
        }
        std::mem::swap(&mut self.facing, &mut self.before);
        self.facing.clear();
        self.by_second.clear();
        self.used.clear();
        let (mut common, mut room) = (Common::default(), Room::default());
        let mut at = 0;
        for index in 0..self.pairs.list.len() {
            let pair = self.pairs.list[index];
            // Both lists ascend.
            while self.before.get(at).is_some_and(|facing| facing.pair < pair) {
                at += 1;
            }
            let before = self.before.get(at).is_some_and(|facing| facing.pair == pair).then_some(at);
            if bound.frees(pair) && self.meet(pair, before.is_some(), scene.sweep.new, &mut common, &mut room) {
                self.connect(pair, before, &common, scene.sweep, springs);
            }
        }
        self.pairs.note_touches(scene.sweep.new);
        let mut again = Closed::default();
        self.overlap_check.push_nets(springs, |stored| again.add(stored));
        self.lost_contact_energy = self.missing(scene.sweep.new) + self.nets.less(&again);
        self.start.has_begun = true;
    }

    /// [`Formulation::remember`] without weighing forces.
    fn keep(&mut self, solved: &Answers<'_, 3>) {
        let count = self.used.len();
        self.nets = Closed::default();
        self.overlap_check.note_nets(solved.part(count, usize::MAX), |stored| self.nets.add(stored));
        self.facing.iter_mut().for_each(|facing| facing.stored = 0.0);
        let mut answers = solved.part(0, count);
        for of_pair in self.used.chunk_by(|a, b| a.0 == b.0) {
            let facing = &mut self.facing[of_pair[0].0 as usize];
            let mut areas = [0.0; PARTS];
            for (&(_, slot), answer) in of_pair.iter().zip(&mut answers) {
                let ([first, second], [a, b]) = (answer.tangents(), answer.slid().slip_new);
                facing.slips[slot as usize] = [0, 1, 2].map(|d| a * first[d] + b * second[d]);
                facing.stored += answer.stored_new();
                areas[slot as usize] = answer.spring.area;
            }
            if !facing.knows() {
                continue;
            }
            // Those that are not there begin with the mean.
            let mean = facing.evened(areas);
            for slot in (0..PARTS).filter(|&slot| areas[slot] == 0.0) {
                (facing.slips[slot], facing.offsets[slot]) = (mean.slips[slot], mean.offsets[slot]);
            }
        }
    }
}

impl Formulation<3> for Segment {
    fn detect(&mut self, scene: &Scene<'_, 3>, springs: &mut Springs<3>) {
        self.detect_free(&Bound::default(), scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, 3>) {
        self.keep(&solved);
        self.overlap_check.weigh(&solved);
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            law: _, penalty: _, is_mean: _, slips: _, level: _, stiffness: _, before: _, by_second: _, used: _, lost_contact_energy: _,
            pairs, proof, overlap_check, start, facing, nets,
        } = self;
        pairs.persist(archive)?;
        proof.persist(archive, pairs.tracker.surfaces())?;
        overlap_check.persist(archive)?;
        persist_each!(archive; start, facing, nets);
        let facets = [0, 1].map(|k| self.surface(k).facets.len());
        let is_there = |facing: &Facing| (0..2).all(|k| (facing.pair[k] as usize) < facets[k]) && facing.owner < 2;
        archive.check(self.facing.iter().all(is_there), "a facet is not there")
    }

    fn beside(&self) -> Beside {
        Beside::Surfaces
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        self.pairs.tracker.inherit(&old.pairs.tracker);
        self.proof.inherit(&old.proof, self.pairs.tracker.surfaces());
        self.overlap_check.inherit(&old.overlap_check);
        self.start.has_begun = old.start.has_begun;
        let again = pairs_again(self.facets(), old.facets());
        let is_one = self.pairs.surfaces()[0] == self.pairs.surfaces()[1];
        let now = |facing: &Facing| {
            let mut pair = again(facing.pair)?;
            let is_turned = is_one && pair[0] > pair[1];
            if is_turned {
                pair.reverse();
            }
            // What is not found again went with its surface.
            let owner = if is_turned { 1 - facing.owner } else { facing.owner };
            let edges = if is_turned { [facing.edges[1], facing.edges[0]] } else { facing.edges };
            let slips = if is_turned { facing.slips.map(|slip| slip.map(|s| -s)) } else { facing.slips };
            Some(Facing { pair, owner, edges, slips, stored: 0.0, ..*facing })
        };
        self.facing = old.facing.iter().filter_map(now).collect();
        self.facing.sort_by_key(|facing| facing.pair);
    }

    fn lost_contact_energy(&self) -> f64 {
        self.lost_contact_energy
    }

    fn certificate(&self) -> Certificate {
        self.proof.certificate()
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.overlap_check.findings())
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.overlap_check.inside()
    }

    fn thinnest(&self) -> f64 {
        self.overlap_check.thinnest()
    }

    fn search_report(&self) -> Option<SearchReport> {
        Some(self.pairs.tracker.search_report())
    }
}
