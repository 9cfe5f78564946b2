//! Where slave nodes lie with respect to target surfaces, from step to step: candidates from the global search, the segment through which each
//! node came in, and the projection of the step.
//!
//! Positions come from the step; what is found goes to the formulation, which makes springs of it. Order is fixed: passes, then slave nodes ascending; so
//! results do not depend on the search.

use super::projection::node_segment::{Projection, Target, Vector};
use super::search::{Pair, Query, Search};
use super::{Sweep, length};
use crate::mesh::surface::NONE;

/// A slave node that is inside a target, or within the skin of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Pass that found it.
    pub pass: usize,
    /// Index of the node in its surface.
    pub slave: usize,
    /// The node.
    pub node: u32,
    /// Where it lies.
    pub projection: Projection,
}

/// Follows the nodes of surfaces along other surfaces.
pub struct Tracker {
    targets: Vec<Target>,
    passes: Vec<Pass>,
    reach: Reach,
    touches: Vec<Touch>,
}

/// One pass: nodes of one surface against another.
struct Pass {
    slave: usize,
    target: usize,
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
    /// All nodes of the surfaces.
    nodes: Vec<u32>,
    /// Their positions at the last search; empty before the first.
    positions: Vec<Vector>,
    /// Pairs within this distance were found, m.
    skin: f64,
}

/// Skin as a fraction of the mean segment length: how far bodies may move before the next global search.
pub const SKIN: f64 = 0.25;
/// The first search looks this many skins far: bodies may overlap at the start.
const FIRST: f64 = 4.0;
/// The global search is asked for a little more than is kept, so that what is kept does not depend on how each search rounds.
const SLACK: f64 = 1.001;

impl Tracker {
    /// For the nodes of `targets[slave]` against `targets[target]` in each pass (slave, target); `positions` are the initial ones.
    #[must_use]
    pub fn new(targets: Vec<Target>, passes: &[(usize, usize)], search: Box<dyn Search<2>>, positions: &[Vector]) -> Self {
        let pass = |&(slave, target): &(usize, usize)| {
            let count = targets[slave].surface.nodes.len();
            Pass { slave, target, memory: vec![NONE; count], starts: vec![0; count + 1], candidates: Vec::new() }
        };
        let mut nodes: Vec<u32> = targets.iter().flat_map(|target| target.surface.nodes.iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let lengths = targets.iter().flat_map(|target| target.surface.segments.iter()).map(|&segment| length(segment, positions));
        let count = targets.iter().map(|target| target.surface.segments.len()).sum::<usize>().max(1);
        let skin = SKIN * lengths.sum::<f64>() / count as f64;
        let reach = Reach { search, pairs: Vec::new(), nodes, positions: Vec::new(), skin };
        let passes = passes.iter().map(pass).collect();
        Self { targets, passes, reach, touches: Vec::new() }
    }

    /// The surfaces.
    #[must_use]
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// Target of a pass.
    #[must_use]
    pub fn target(&self, pass: usize) -> &Target {
        &self.targets[self.passes[pass].target]
    }

    /// Whether the slaves of a pass are the first surface (1), the second (−1), or both in one (0).
    #[must_use]
    pub fn side(&self, pass: usize) -> f64 {
        let Pass { slave, target, .. } = self.passes[pass];
        if slave == target { 0.0 } else { 1.0 - 2.0 * slave as f64 }
    }

    /// Nodes that are inside, or near enough to come in during the next update, ascending by pass and slave. Pairs farther than the skin and `extra` (m)
    /// are not looked at.
    pub fn track(&mut self, sweep: Sweep<'_>, extra: f64) -> &[Touch] {
        let at_start = self.reach.positions.is_empty();
        if at_start || self.reach.is_left(sweep.new) {
            let skin = if at_start { FIRST * self.reach.skin } else { self.reach.skin };
            self.search(sweep, skin + extra + 2.0 * self.reach.fastest(sweep));
        }
        self.touches.clear();
        for (index, pass) in self.passes.iter_mut().enumerate() {
            let target = &self.targets[pass.target];
            for (slave, &node) in self.targets[pass.slave].surface.nodes.iter().enumerate() {
                if let Some(projection) = pass.locate(slave, node, target, sweep, at_start) {
                    self.touches.push(Touch { pass: index, slave, node, projection });
                }
            }
        }
        &self.touches
    }

    /// Global search, then a filter by distance: candidates are the same whatever the search, and few.
    fn search(&mut self, sweep: Sweep<'_>, reach: f64) {
        for pass in &mut self.passes {
            let target = &self.targets[pass.target];
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
