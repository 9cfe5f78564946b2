//! Contact: search -> project -> law -> forces, each pass of each contact on the same configuration.
//!
//! Sees surfaces, positions and stiffnesses; knows nothing of elements and materials. [`Contact::detect`] finds the springs of the step,
//! [`springs::Springs::solve`] the forces of all contacts and walls together, [`Contact::collect`] what they sum up to. Order is fixed: passes, then slave nodes ascending; so results do not depend on the search.

pub mod search;
pub mod projection;
pub mod law;
pub mod springs;

use crate::mesh::surface::NONE;
use crate::model::{Formulation, Penalty};
use projection::node_segment::{Projection, Target, Vector};
use search::{Pair, Query, Search};
use springs::{Spring, Springs};
use std::ops::Range;

/// A contact between two surfaces.
pub struct Contact {
    /// Name.
    pub name: String,
    /// Force of the second surface on the first, N/m.
    pub resultant: Vector,
    /// Energy of its springs, J/m.
    pub energy: f64,
    /// Work of its forces in the last velocity update, J/m.
    pub work: f64,
    /// Deepest penetration in the last evaluation, m.
    pub penetration: f64,
    targets: [Target; 2],
    passes: Vec<Pass>,
    reach: Reach,
    /// Where each pass's springs of this step lie in the list of all.
    found: Vec<Range<usize>>,
}

/// One pass: nodes of one surface against the other.
struct Pass {
    slave: usize,
    /// Spring stiffness of each slave node, N/m per metre of depth.
    stiffness: Vec<f64>,
    /// Segment through which each slave node came in; [`NONE`] while it is outside.
    memory: Vec<u32>,
    /// Candidates of slave `i`: `candidates[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    candidates: Vec<u32>,
}

/// When the global search must run again.
struct Reach {
    search: Box<dyn Search<2>>,
    pairs: Vec<Pair>,
    /// All nodes of both surfaces.
    nodes: Vec<u32>,
    /// Their positions at the last search; empty before the first.
    positions: Vec<Vector>,
    /// Pairs within this distance were found, m.
    skin: f64,
}

/// Positions at both ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Sweep<'a> {
    /// At the beginning, m.
    pub old: &'a [Vector],
    /// At the end, m: the configuration on which all forces are evaluated.
    pub new: &'a [Vector],
}

/// What a contact is made from.
pub struct ContactInput {
    /// Name.
    pub name: String,
    /// The two surfaces.
    pub targets: [Target; 2],
    /// Pressure stiffness κ of the elements under each segment of each surface, Pa/m.
    pub pressure_stiffness: [Vec<f64>; 2],
    /// Double or single pass.
    pub formulation: Formulation,
    /// Stiffness.
    pub penalty: Penalty,
    /// Global search.
    pub search: Box<dyn Search<2>>,
}

/// Skin as a fraction of the mean segment length: how far bodies may move before the next global search.
pub const SKIN: f64 = 0.25;
/// The first search looks this many skins far: bodies may overlap at the start.
const FIRST: f64 = 4.0;
/// The global search is asked for a little more than is kept, so that what is kept does not depend on how each search rounds.
const SLACK: f64 = 1.001;

impl Contact {
    /// Makes a contact ready; `positions` are the initial ones.
    #[must_use]
    pub fn new(input: ContactInput, positions: &[Vector]) -> Self {
        let slaves: &[usize] = match input.formulation {
            Formulation::DoublePass | Formulation::Segment | Formulation::Pinball => &[0, 1],
            Formulation::SinglePass { slave: 0 } => &[0],
            Formulation::SinglePass { .. } => &[1],
        };
        let softest = |surface: usize| input.pressure_stiffness[surface].iter().copied().fold(f64::INFINITY, f64::min);
        let pass = |&slave: &usize| {
            let Target { surface, mirrors } = &input.targets[slave];
            let nodes = node_stiffness(surface, &input.pressure_stiffness[slave], positions);
            let other = softest(1 - slave);
            let stiffness = |(&(tributary, own), node): (&(f64, f64), &u32)| {
                let on_line = mirrors.binary_search_by_key(node, |&(node, _)| node).is_ok();
                let node = law::Node { tributary, own, other, share: if on_line { 0.5 } else { 1.0 } };
                law::penalty::stiffness(input.penalty, node, slaves.len())
            };
            Pass {
                slave,
                stiffness: nodes.iter().zip(&surface.nodes).map(stiffness).collect(),
                memory: vec![NONE; surface.nodes.len()],
                starts: vec![0; surface.nodes.len() + 1],
                candidates: Vec::new(),
            }
        };
        let passes: Vec<Pass> = slaves.iter().map(pass).collect();
        let mut nodes: Vec<u32> = input.targets.iter().flat_map(|target| target.surface.nodes.iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let lengths = input.targets.iter().flat_map(|target| target.surface.segments.iter()).map(|&segment| length(segment, positions));
        let count = input.targets.iter().map(|target| target.surface.segments.len()).sum::<usize>().max(1);
        let skin = SKIN * lengths.sum::<f64>() / count as f64;
        let reach = Reach { search: input.search, pairs: Vec::new(), nodes, positions: Vec::new(), skin };
        Self {
            name: input.name,
            resultant: [0.0; 2],
            energy: 0.0,
            work: 0.0,
            penetration: 0.0,
            targets: input.targets,
            passes,
            reach,
            found: Vec::new(),
        }
    }

    /// Adds the springs of the step to `springs`: of every slave node that is inside or within the skin, so that a spring is there before it is
    /// needed (one that closes unseen would give back what it never took).
    pub fn detect(&mut self, sweep: Sweep<'_>, springs: &mut Springs) {
        let at_start = self.reach.positions.is_empty();
        if at_start || self.reach.is_left(sweep.new) {
            let reach = if at_start { FIRST * self.reach.skin } else { self.reach.skin };
            self.search(sweep, reach + 2.0 * self.reach.fastest(sweep));
        }
        self.penetration = 0.0;
        self.found.clear();
        for pass in &mut self.passes {
            let target = &self.targets[1 - pass.slave];
            let nodes = &self.targets[pass.slave].surface.nodes;
            let first = springs.list.len();
            for (i, &node) in nodes.iter().enumerate() {
                let Some(projection) = pass.locate(i, node, target, sweep, at_start) else { continue };
                let segment = target.surface.segments[projection.segment as usize];
                let [a, b] = projection.weights;
                let (nodes, shares) = ([node, segment[0], segment[1]], [1.0, -a, -b]);
                let stiffness = pass.stiffness[i];
                springs.list.push(Spring { nodes, shares, normal: projection.normal, gap: projection.gap, stiffness, ..Spring::default() });
                self.penetration = self.penetration.max(-projection.gap);
            }
            self.found.push(first..springs.list.len());
        }
    }

    /// Sums up the solved springs: adds their forces to `forces`, keeps resultant, energy and work.
    pub fn collect(&mut self, springs: &Springs, forces: &mut [Vector]) {
        (self.resultant, self.energy, self.work) = ([0.0; 2], 0.0, 0.0);
        for (pass, found) in self.passes.iter().zip(&self.found) {
            let sign = if pass.slave == 0 { 1.0 } else { -1.0 };
            for spring in &springs.list[found.clone()] {
                self.energy += spring.energy;
                self.work += spring.work;
                for d in 0..2 {
                    let force = spring.force * spring.normal[d];
                    self.resultant[d] += sign * force;
                    for (node, share) in spring.nodes.iter().zip(spring.shares) {
                        forces[*node as usize][d] += share * force;
                    }
                }
            }
        }
    }

    /// Slave nodes that are inside in the last step, with their depth, m.
    pub fn penetrations<'a>(&'a self, springs: &'a Springs) -> impl Iterator<Item = (u32, f64)> + 'a {
        let all = self.found.iter().flat_map(|found| &springs.list[found.clone()]);
        all.filter(|spring| spring.gap < 0.0).map(|spring| (spring.nodes[0], -spring.gap))
    }

    /// Global search, then a filter by distance: candidates are the same whatever the search, and few.
    fn search(&mut self, sweep: Sweep<'_>, reach: f64) {
        for pass in &mut self.passes {
            let target = &self.targets[1 - pass.slave];
            let slaves = &self.targets[pass.slave].surface.nodes;
            let query = Query {
                positions_old: sweep.old,
                positions_new: sweep.new,
                slaves,
                facets: &target.surface.segments,
                reach: SLACK * reach,
            };
            self.reach.search.pairs(&query, &mut self.reach.pairs);
            pass.candidates.clear();
            pass.starts.fill(0);
            for pair in &self.reach.pairs {
                let node = slaves[pair.slave as usize];
                let (x_old, x) = (sweep.old[node as usize], sweep.new[node as usize]);
                let comes_near = target.distance(x, pair.facet, sweep.new).is_some_and(|distance| distance <= reach)
                    || target.crossing(x_old, x, pair.facet, sweep.old, sweep.new).is_some();
                // A node of both surfaces joins them: it can't go in.
                if comes_near && target.surface.nodes.binary_search(&node).is_err() {
                    pass.candidates.push(pair.facet);
                    pass.starts[pair.slave as usize + 1] += 1;
                }
            }
            for i in 1..pass.starts.len() {
                pass.starts[i] += pass.starts[i - 1];
            }
        }
        self.reach.positions.clear();
        self.reach.positions.extend(self.reach.nodes.iter().map(|&node| sweep.new[node as usize]));
    }
}

impl Pass {
    /// Where slave `i` lies: on the chain that it came in through while it is inside, else by crossing and nearest feature of its candidates.
    /// `at_start`: nothing is known of the past.
    fn locate(&mut self, i: usize, node: u32, target: &Target, sweep: Sweep<'_>, at_start: bool) -> Option<Projection> {
        let (x_old, x) = (sweep.old[node as usize], sweep.new[node as usize]);
        let was_inside = self.memory[i] != NONE;
        if was_inside {
            let projection = target.follow(x, self.memory[i], sweep.new);
            if let Some(inside) = projection.filter(|projection| projection.gap < 0.0) {
                self.memory[i] = inside.segment;
                return projection;
            }
            self.memory[i] = NONE;
        }
        let candidates = &self.candidates[self.starts[i] as usize..self.starts[i + 1] as usize];
        if candidates.is_empty() {
            return None;
        }
        // Who just left may have been beyond a thin body: on its way back it goes through the far side, but does not come in there.
        let outside = if was_inside { &[] } else { candidates };
        let entered = outside
            .iter()
            .filter_map(|&segment| Some((target.crossing(x_old, x, segment, sweep.old, sweep.new)?, segment)))
            .reduce(|first, other| if other.0 < first.0 { other } else { first });
        let projection = match entered {
            Some((_, segment)) => target.follow(x, segment, sweep.new),
            None => target.nearest(x, candidates, sweep.new),
        }?;
        if projection.gap < 0.0 {
            // Who was outside can't be deeper than it moved: a node that seems to be is behind a side on which it did not come in.
            let segment = target.surface.segments[projection.segment as usize];
            if entered.is_none() && !at_start && -projection.gap > motion(node, segment, sweep) {
                return None;
            }
            self.memory[i] = projection.segment;
        }
        Some(projection)
    }
}

impl Reach {
    /// Longest way of a node in the step, m: so far a spring must be seen ahead.
    fn fastest(&self, sweep: Sweep<'_>) -> f64 {
        self.nodes.iter().map(|&node| way(node, sweep)).fold(0.0, f64::max)
    }

    /// Whether some node has moved by more than half the skin since the last search (or there was none).
    fn is_left(&self, positions: &[Vector]) -> bool {
        let limit = 0.25 * self.skin * self.skin;
        self.positions.is_empty()
            || self.nodes.iter().zip(&self.positions).any(|(&node, from)| {
                let x = positions[node as usize];
                let moved = [x[0] - from[0], x[1] - from[1]];
                // NaN counts as moved
                !(moved[0] * moved[0] + moved[1] * moved[1] <= limit)
            })
    }
}

/// Bound of how much a gap changes in the step, m.
fn motion(node: u32, segment: [u32; 2], sweep: Sweep<'_>) -> f64 {
    way(node, sweep) + way(segment[0], sweep).max(way(segment[1], sweep))
}

/// Bound of how far a node moves in the step, m.
fn way(node: u32, sweep: Sweep<'_>) -> f64 {
    let (a, b) = (sweep.old[node as usize], sweep.new[node as usize]);
    (b[0] - a[0]).abs() + (b[1] - a[1]).abs()
}

fn length(segment: [u32; 2], positions: &[Vector]) -> f64 {
    let [a, b] = segment.map(|node| positions[node as usize]);
    ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
}

/// Tributary length (m) and mean pressure stiffness (Pa/m) of each node of a surface, in the order of its nodes.
#[must_use]
pub fn node_stiffness(surface: &crate::mesh::surface::Surface, pressure_stiffness: &[f64], positions: &[Vector]) -> Vec<(f64, f64)> {
    let mut sums = vec![(0.0, 0.0); surface.nodes.len()];
    for (&segment, &stiffness) in surface.segments.iter().zip(pressure_stiffness) {
        let half = 0.5 * length(segment, positions);
        for node in segment {
            if let Ok(at) = surface.nodes.binary_search(&node) {
                sums[at].0 += half;
                sums[at].1 += half * stiffness;
            }
        }
    }
    sums.into_iter().map(|(length, weighted)| (length, weighted / length)).collect()
}
