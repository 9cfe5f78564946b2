//! Subcycling: regions of elements with a longer stable step are evaluated less often.
//!
//! The global step is that of the elements that need the shortest; chunks of elements are evaluated in every
//! r-th step, and pull with impulses then ([`crate::block::Begin`]). A cycle is so many steps, up to
//! [`RATIO_MOST`], that its divisors r need the fewest evaluations; at its first step all chunks are
//! evaluated, and ratios may change.
//!
//! Impulses in the rhythm r dt excite motions of half that frequency, ω r dt = π (and its multiples):
//! resonance, by which the energy grows by up to some per cent per cycle where impulses meet elements or
//! springs that are fast enough to move so. The elements with the ratio r themselves are not: ω ≤ 2/(r dt).
//! In a layer of such elements motions of these frequencies decay from node to node, by a factor of about
//! (ω h/2c)²: so [`LAYERS`] layers of them around what is faster are evaluated as often as that is, and with
//! them nothing grows (chains of masses, and 400,000 steps of a shaken strip, in `tests/all/subcycling.rs`).
//! Nodes in contact count as fast, and so do those of blocks without subcycling; nodes that move as one, or
//! with one rigid body, count together.
//!
//! Source of the resonance: Bishop, Skeel and Schulten, J. Comput. Chem. 18 (1997) 1785-1791; Fong, Darve
//! and Lew, J. Comput. Phys. 227 (2008) 8367-8394.

use super::limits::FIRST;
use super::nodes::Nodes;
use super::{CHUNK, System};
use crate::archive::{Archive, ArchiveResult, Persist, persist_all, persist_each};
use crate::block::{Begin, Block, NO_NODE, RATIO_MOST, Regions, Report, largest_divisor};
use crate::dimension::Dimension;
use crate::energy::Sums;
use crate::reductions;
use crate::tensor::Dim;
use embate_lanes::{BATCH, Chunks, Team};

/// Velocities, next positions and sums of nodes, by chunks.
type NodeParts<'a, const D: usize> = (Chunks<'a, [f64; D]>, Chunks<'a, [f64; D]>, Chunks<'a, Sums>);

/// Elements with the ratio r have stable steps of at least this times r dt. Where they meet others, the nodes
/// that they share swing between two impulses by up to ω² r² dt²/8 of the strain that the elements bear:
/// 2.5 % with one half.
const SLACK: f64 = 2.0;
/// A cycle of another length must need less than this of the evaluations.
const WORTH: f64 = 0.9;
/// Layers of elements around faster ones that are evaluated as often as these: two, one for the elements at
/// the fast nodes and one more.
const LAYERS: usize = 2;
/// Ratios are chosen again when the step is below this fraction, squared, of what the fastest elements allow,
/// or nodes are in contact that were not for long; after so many cycles at the earliest.
const SHORTENED: f64 = 0.81;
const PAUSE: u32 = 2;
/// Otherwise after so many cycles, of so many steps at least. Nodes that were in contact since count as fast.
const REST: u32 = 32;
const REST_LEAST: u32 = 64;

/// Where a run with subcycling is in its cycle.
#[derive(Clone, Debug)]
pub(crate) struct Subcycling {
    /// Steps since the cycle began, and those that it has.
    turn: u32,
    cycle: u32,
    /// Steps since ratios were chosen; none have been: since the start.
    since: u32,
    /// Of each group of eight nodes the number of the last step in which it was in contact, plus one; 0: it
    /// never was.
    touched: Vec<u64>,
    /// Whether some are in contact that did not count as fast when ratios were chosen.
    touches_anew: bool,
    /// Chunks of nodes.
    nodes: Vec<Coasting>,
    /// Evaluations of elements, summed over the steps.
    pub(crate) evaluations: u64,
}

impl Persist for Subcycling {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { turn, cycle, since, touched, touches_anew, nodes, evaluations } = self;
        persist_each!(archive; turn, cycle, since, touched, touches_anew, evaluations);
        nodes[..].persist(archive)?;
        if archive.reads() {
            self.wake();
        }
        archive.check((1..=RATIO_MOST).contains(&self.cycle) && self.turn < self.cycle, "a cycle that there is not")
    }
}

/// A chunk of nodes.
#[derive(Clone, Copy, Debug, Default)]
struct Coasting {
    /// The step ratios r of the elements at its nodes, as bits r − 1; 1 is among them where a node is not
    /// free. None until ratios are chosen.
    ratios: u64,
    /// What is known of its last step.
    last: Last,
}

persist_all!(Coasting { ratios } but { last });

/// The ratios whose elements are evaluated in a turn of the cycle, as bits.
fn due(turn: u32) -> u64 {
    (1..=RATIO_MOST).filter(|&ratio| turn.is_multiple_of(ratio)).map(bit).sum()
}

/// A ratio among those of a chunk of nodes.
fn bit(ratio: u32) -> u64 {
    1 << (ratio - 1)
}

/// The node of each slot of a block that has one.
fn nodes_of_slots<const D: usize>(block: &dyn Block<D>) -> impl Iterator<Item = u32> {
    block.slots().iter().copied().filter(|&node| node != NO_NODE)
}

/// What is known of the last step of a chunk of nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Last {
    /// Nothing: what was summed is not of its velocities.
    #[default]
    Unknown,
    /// What was summed.
    Summed,
    /// What was summed, and that no velocity changed.
    Coasted,
}

impl Subcycling {
    /// Of a system with so many nodes.
    fn new(nodes: usize) -> Self {
        let nodes = vec![Coasting::default(); nodes.div_ceil(CHUNK)];
        Self { turn: 0, cycle: 1, since: 0, touched: Vec::new(), touches_anew: false, nodes, evaluations: 0 }
    }

    /// Steps since the cycle began.
    pub(super) fn turn(&self) -> u32 {
        self.turn
    }

    /// Steps of the cycle.
    pub(super) fn cycle(&self) -> u32 {
        self.cycle
    }

    /// A step has been taken.
    pub(super) fn pass(&mut self) {
        self.turn = (self.turn + 1) % self.cycle.clamp(1, RATIO_MOST);
        self.since = self.since.saturating_add(1);
    }

    /// Updates the velocities of all nodes; those that no element pulls at coast.
    pub(super) fn accelerate<const D: usize>(&mut self, nodes: &Nodes<'_, D>, (velocities, next, sums): NodeParts<'_, D>, team: &mut Team)
    where
        Dim<D>: Dimension<D>,
    {
        let (due, are_free) = (due(self.turn), nodes.coast_freely());
        let parts = (velocities, next, sums, Chunks::new(&mut self.nodes, 1));
        team.each(parts, |index, _, (velocities, next, sums, own)| {
            let (Some(own), Some(sums)) = (own.first_mut(), sums.first_mut()) else { return };
            let first = index * CHUNK;
            let coasts = are_free && own.last != Last::Unknown && own.ratios != 0 && own.ratios & due == 0;
            let coasted = if coasts { nodes.coast((first, own.last == Last::Coasted), velocities, next, sums) } else { None };
            own.last = if coasted.is_some() { Last::Coasted } else { Last::Summed };
            *sums = coasted.unwrap_or_else(|| nodes.update(first, velocities, next));
        });
    }

    /// Velocities were changed from outside.
    pub(crate) fn wake(&mut self) {
        self.nodes.iter_mut().for_each(|own| own.last = Last::Unknown);
    }

    /// Steps between two choices of ratios without a cause.
    fn rest(&self) -> u32 {
        (REST * self.cycle).max(REST_LEAST)
    }

    /// Whether a group of eight nodes was in contact in the last steps before this one.
    fn was_touched(&self, group: usize, step: u64) -> bool {
        self.touched.get(group).is_some_and(|&last| last > 0 && step < last + 2 * u64::from(self.rest()))
    }

    /// Remembers the groups of nodes in contact in a step.
    fn touch(&mut self, groups: &[u32], step: u64) {
        for &group in groups {
            let group = group as usize;
            self.touches_anew |= !self.was_touched(group, step);
            if group >= self.touched.len() {
                self.touched.resize(group + 1, 0);
            }
            self.touched[group] = step + 1;
        }
    }
}

/// Elements that are evaluated per step of so many `elements` by their largest ratio, in a cycle.
fn evaluated(elements: &[usize], cycle: u32) -> f64 {
    let of = |(most, &count): (u32, &usize)| if count > 0 { count as f64 / f64::from(largest_divisor(cycle, most)) } else { 0.0 };
    (1..).zip(&elements[1..]).map(of).sum()
}

/// The number of steps in a cycle whose divisors need the fewest evaluations; the present one unless another
/// needs clearly less.
fn best_cycle(elements: &[usize], present: u32) -> u32 {
    let best = (1..=RATIO_MOST).map(|cycle| (evaluated(elements, cycle), cycle)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(present, |(least, cycle)| if least < WORTH * evaluated(elements, present) { cycle } else { present })
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Lets regions have steps of their own from now on.
    pub(crate) fn start_subcycling(&mut self) {
        self.subcycling = Some(Subcycling::new(self.positions.len()));
        for index in 0..self.blocks.len() {
            if self.regions(index).is_some() {
                self.blocks[index].start_subcycling();
            }
        }
    }

    /// At the start of a cycle chooses ratios, if that is due; returns what elements report with them.
    pub(super) fn choose_ratios(&mut self, elements: Report) -> Report {
        let Some(mut own) = self.subcycling.take() else { return elements };
        own.touch(self.contact_forces.groups(), self.step);
        // While the first steps find out how fast bodies come at each other all take the same.
        if own.turn == 0 && self.step > FIRST {
            let is_first = u64::from(own.since) == self.step;
            let has_cause = own.touches_anew || elements.time_step_squared < SHORTENED * self.shortest_squared();
            if is_first || own.since >= own.rest() || (own.since >= PAUSE * own.cycle && has_cause) {
                own.cycle = self.new_ratios(&own);
                self.find_coasting(&mut own.nodes);
                (own.since, own.touches_anew) = (0, false);
                self.subcycling = Some(own);
                return self.joined_reports();
            }
        }
        self.subcycling = Some(own);
        elements
    }

    /// Square of the stable step of the element that needs the shortest, evaluated often or not, s².
    pub(super) fn shortest_of_elements(&self) -> f64 {
        let of = |block: usize| self.regions(block).map_or(self.reports[block].time_step_squared, Regions::shortest_squared);
        reductions::min((0..self.blocks.len() - usize::from(self.has_springs)).filter(|&block| !self.rigid[block]).map(of))
    }

    /// The same of elements and springs together.
    fn shortest_squared(&self) -> f64 {
        self.with_springs(self.shortest_of_elements())
    }

    /// The regions of a block, if they may have steps of their own: no rigid part, and none whose elements
    /// may fail.
    fn regions(&self, block: usize) -> Option<&dyn Regions> {
        let may_fail = self.erosion.as_ref().is_some_and(|erosion| erosion.may_fail(block));
        if self.rigid[block] || may_fail { None } else { self.blocks[block].regions() }
    }

    /// The least square of the stable steps, s², of the elements at each node and in the layers around it;
    /// where what needs the `shortest` step is, or nodes are `fast`, that.
    fn least_around(&self, shortest: f64, fast: impl Fn(usize) -> bool) -> Vec<f64> {
        let mut least = vec![f64::INFINITY; self.positions.len()];
        for (index, block) in self.blocks.iter().enumerate().filter(|(index, _)| !self.rigid[*index]) {
            match self.regions(index) {
                Some(regions) => regions.add_steps(&mut least),
                None => nodes_of_slots(block.as_ref()).for_each(|node| least[node as usize] = shortest),
            }
        }
        for (group, nodes) in least.chunks_mut(BATCH).enumerate() {
            if fast(group) {
                nodes.fill(shortest);
            }
        }
        for _ in 1..LAYERS {
            self.share_least(&mut least);
            let from = least.clone();
            (0..self.blocks.len()).filter_map(|block| self.regions(block)).for_each(|regions| regions.widen(&from, &mut least));
        }
        self.share_least(&mut least);
        least
    }

    /// The best cycle with so many elements by the ratio that they may have, and what of all evaluations
    /// remains with it.
    fn cycle_and_share(&self, least: &[f64], shortest: f64, present: u32) -> (u32, f64) {
        let (mut elements, mut others) = ([0; RATIO_MOST as usize + 1], 0);
        for (index, block) in self.blocks.iter().enumerate().filter(|(index, _)| !self.rigid[*index]) {
            match self.regions(index) {
                Some(regions) => regions.allowed(least, shortest, &mut |ratio, count| elements[ratio as usize] += count),
                None => others += block.elements(),
            }
        }
        let cycle = best_cycle(&elements, present);
        let all = elements.iter().sum::<usize>() + others;
        (cycle, if all == 0 { 1.0 } else { (evaluated(&elements, cycle) + others as f64) / all as f64 })
    }

    /// What of all evaluations of elements remains with subcycling, in the present state and without contact.
    pub(crate) fn share_with_subcycling(&self) -> f64 {
        let shortest = self.shortest_squared();
        let least = self.least_around(shortest, |_| false);
        self.cycle_and_share(&least, SLACK * SLACK * shortest, 1).1
    }

    /// Gives all chunks of elements their ratios, and returns the cycle.
    fn new_ratios(&mut self, own: &Subcycling) -> u32 {
        let shortest = self.shortest_squared();
        let least = self.least_around(shortest, |group| own.was_touched(group, self.step));
        let shortest = SLACK * SLACK * shortest;
        let (cycle, _) = self.cycle_and_share(&least, shortest, own.cycle);
        for (block, report) in self.blocks.iter_mut().zip(&mut self.reports) {
            if let Some(block) = block.subcycled() {
                block.set_ratios(&least, shortest, cycle);
                *report = block.report();
            }
        }
        cycle
    }

    /// Nodes that move as one have the least value of them all.
    fn share_least(&self, least: &mut [f64]) {
        for group in self.joins.groups() {
            let nodes = || group.members.iter().map(|member| member.node as usize);
            let lowest = nodes().map(|node| least[node]).fold(f64::INFINITY, f64::min);
            nodes().for_each(|node| least[node] = lowest);
        }
        let mut of_bodies = vec![f64::INFINITY; self.bodies.len()];
        for (node, value) in (0..).zip(&*least) {
            if let Some(body) = self.bodies.of_node(node) {
                of_bodies[body] = f64::min(of_bodies[body], *value);
            }
        }
        for (node, value) in (0..).zip(&mut *least) {
            if let Some(body) = self.bodies.of_node(node) {
                *value = of_bodies[body];
            }
        }
    }

    /// Finds the ratios of the elements at each chunk of nodes.
    fn find_coasting(&mut self, nodes: &mut [Coasting]) {
        // Where there is no element nothing pulls.
        nodes.iter_mut().for_each(|own| own.ratios = bit(RATIO_MOST));
        for block in &mut self.blocks {
            let mut add = |node: u32, ratio: u32| nodes[node as usize / CHUNK].ratios |= bit(ratio);
            match block.subcycled() {
                Some(block) => block.ratios(&mut add),
                None => nodes_of_slots(block.as_ref()).for_each(|node| add(node, 1)),
            }
        }
        for (chunk, own) in nodes.iter_mut().enumerate() {
            let groups = chunk * CHUNK / BATCH..((chunk + 1) * CHUNK).min(self.positions.len()).div_ceil(BATCH);
            if !groups.clone().all(|group| self.groups.free.get(group) == Some(&true)) {
                own.ratios = bit(1);
            }
        }
    }

    /// Makes impulses of the forces of the chunks that were evaluated in this step, before
    /// dt^n = `time_step`.
    pub(super) fn begin_intervals(&mut self, time_step: f64) {
        let Some(own) = &mut self.subcycling else { return };
        let begin = Begin { positions: &self.positions, time_steps: [self.time_step_old, time_step], turn: own.turn };
        let (mut rest, mut evaluated) = (&mut self.slots[..], 0);
        for (block, rigid) in self.blocks.iter_mut().zip(&self.rigid) {
            let (slots, others) = rest.split_at_mut(block.slots().len());
            let elements = if *rigid { 0 } else { block.elements() };
            evaluated += block.subcycled().map_or(elements, |block| block.begin(&begin, slots, &mut self.team));
            rest = others;
        }
        own.evaluations += if self.step > 0 { evaluated as u64 } else { 0 };
    }
}
