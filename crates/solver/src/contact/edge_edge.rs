//! Edges against edges: which ridges of surfaces in 3D cross each other, from step to step, and the
//! springs between them.
//!
//! Nodes that meet facets say nothing of two edges that cross between their nodes: such bodies would go
//! through each other. Surfaces and the search's radius come from the tracker of the nodes
//! ([`super::node_facet`]), which makes one contact of both. Nothing is held twice:
//!
//! - only ridges count (`projection/edge_edge.rs`), and only where the normal is well between those of the
//!   facets of one of them and not beyond those of the other: faces that lie on each other leave it to their
//!   nodes, a ridge on a narrow face does not;
//! - a pair is not taken where an end of one of its edges is in contact with a facet at the other one
//!   already; while ridges that cross are held (and none lies on a face), such nodes are left out that were
//!   not in contact before: the depth of the edges is that of the bodies, also where a node is inside;
//! - where a crossing goes over a node to the next edge of the same line, the spring continues there with
//!   what it knows; where the line bends inward, so that it is on neither edge, it continues along the first
//!   one; where the next edge leaves in any other direction, but the normal stays about the same, the spring
//!   continues there as soon as it is well off the first one.
//!
//! A pair is inside only if it was seen to come in (on its way in the step, at any speed, as long as the
//! edges still cross at its end), or at the start. Candidates come from the same global search, of the ends
//! of edges against edges; order is fixed: edges ascending.

mod near;

use super::Sweep;
use super::continuity::SpringHistory;
use super::node_facet::groups::bodies_of;
use super::node_facet::tracker::ContactHistory;
use super::projection::edge_edge::{Crossing, Ridge, crossing, point};
use super::projection::node_facet::{Placed, Vector, unit};
use super::search::{Pair, Search};
use super::springs::{End, Stiffening};
use crate::archive::{Archive, ArchiveResult, persist_all};
use crate::contact::springs::TangentSpace;
use crate::mesh::surface::SpaceSurface;
use crate::rows::Rows;
use crate::tensor::{Dim, cross, dot};
use crate::vector::{length, minus};
use near::near;
use std::mem::take;

/// How well the normal must be between those of the facets: of one edge at least, of the other one where a
/// spring begins (on a flat face it is along a facet's), and as long as it is closed.
const BETWEEN: f64 = 0.25;
const BEGINS: f64 = -0.05;
const STAYS: f64 = -0.25;
/// By which fraction of an edge a closed spring continues beyond its end where the line ends.
const BEYOND: f64 = 0.05;
/// The same where the line continues, but bends inward there so that no place on the next edge takes it over.
const BENT: f64 = 0.5;
/// The same of the place where edges go through each other on their way in a step.
const ON_WAY: f64 = 0.1;
/// Cosine of the angle between edges of the same line.
const STRAIGHT: f64 = 0.7;
/// At the start edges may be inside by this fraction of the width of their facets.
const SHALLOW: f64 = 0.25;
/// The global search is asked for a little more than is needed: it may round.
const SLACK: f64 = 1.001;

/// Another pair, and whether its first edge is that which continues in the second one here: of one surface
/// pairs are ascending.
#[derive(Clone, Copy)]
struct Other {
    pair: usize,
    is_swapped: bool,
}

impl Other {
    /// Sign of its normal and its slip here.
    fn sign(self) -> f64 {
        if self.is_swapped { -1.0 } else { 1.0 }
    }
}

/// Two edges that are near each other, and what is kept of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EdgePair {
    /// Of the first and of the second surface; of one surface ascending.
    pub edges: [u32; 2],
    /// Whether they are of one body.
    own: bool,
    /// Whether there was a spring in the last step. Else nothing is kept.
    touches: bool,
    /// Of the spring, N/m, and the area that it stands for, m²: as where it began.
    pub stiffness: f64,
    /// See `stiffness`.
    pub area: f64,
    /// Depth beyond which the spring stiffens, m.
    pub stiffening: Stiffening,
    /// What is kept of the spring.
    pub memory: ContactHistory,
}

persist_all!(EdgePair { edges, own, touches, stiffness, area, stiffening, memory });

/// Edges that are inside each other, or near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeTouch {
    /// The edges.
    pub edges: [u32; 2],
    /// Their nodes: first edge, second edge.
    pub nodes: [[u32; 2]; 2],
    /// Where they cross.
    pub crossing: Crossing,
    /// Whether they are of one body.
    pub own: bool,
    /// Whether there was no spring in the step before.
    pub is_new: bool,
    /// Whether it is that of two ridges that cross, which it parts, and not that of one that lies on a face:
    /// nodes need no springs of their own.
    pub stands: bool,
    pair: u32,
}

/// What the tracker of the nodes knows.
#[derive(Clone, Copy)]
pub struct Around<'a> {
    /// The surfaces.
    pub surfaces: &'a [SpaceSurface],
    /// Paths in the step; at the beginning none.
    pub sweep: Sweep<'a, 3>,
    /// Whether nothing is known of the past.
    pub is_new: bool,
    /// Everything nearer counts, m.
    pub radius: f64,
    /// Part of it for what moves until the next search, m.
    pub skin: f64,
    /// Gap (m) up to which springs are there before they are needed, beside what the motion asks for; and how
    /// many motions ahead.
    pub near: [f64; 2],
    /// Distance (m) up to which the law pushes, thickness included.
    pub extra: f64,
    /// Gap below which a spring is closed, m.
    pub open: f64,
}

/// Follows the ridges of one surface along those of another one, or of the same.
pub struct EdgeTracker {
    /// Number of the surface of the first and of the second edges.
    sides: [usize; 2],
    /// Body of each node as far as the surfaces go.
    bodies: Vec<u32>,
    /// Edges at each node of each surface.
    at_nodes: Vec<Rows<u32>>,
    search: Box<dyn Search<3>>,
    /// Ascending by edges.
    pairs: Vec<EdgePair>,
    touches: Vec<EdgeTouch>,
    /// Depth of the deepest spring of the last step, m.
    deepest: f64,
    found: Vec<Pair>,
    /// The touches of a step in the order in which they get springs, and whether each pair has one.
    order: Vec<usize>,
    taken: Vec<bool>,
}

impl EdgeTracker {
    /// For `surfaces`, one or two; `bodies` of each node of the model.
    #[must_use]
    pub fn new(surfaces: &[SpaceSurface], bodies: &[u32], search: Box<dyn Search<3>>) -> Self {
        let at_nodes = |surface: &SpaceSurface| {
            let rank = |node: u32| surface.nodes.binary_search(&node).map_or(0, |rank| rank as u32);
            let ends = surface.edges.iter().zip(0..).flat_map(|(edge, number)| edge.nodes.map(|node| (rank(node), number)));
            Rows::new(surface.nodes.len(), ends.collect::<Vec<_>>().into_iter())
        };
        Self {
            sides: [0, surfaces.len() - 1],
            bodies: bodies_of(surfaces, bodies),
            at_nodes: surfaces.iter().map(at_nodes).collect(),
            search,
            pairs: Vec::new(),
            touches: Vec::new(),
            deepest: 0.0,
            found: Vec::new(),
            order: Vec::new(),
            taken: Vec::new(),
        }
    }

    /// Which surfaces meet: numbers of the first and of the second.
    #[must_use]
    pub fn sides(&self) -> [usize; 2] {
        self.sides
    }

    /// What [`EdgeTracker::track`] found last.
    #[must_use]
    pub fn touches(&self) -> &[EdgeTouch] {
        &self.touches
    }

    /// How many pairs are looked at.
    #[must_use]
    pub fn candidates(&self) -> usize {
        self.pairs.len()
    }

    /// The edges of all pairs that are looked at.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        self.pairs.iter().map(|pair| pair.edges)
    }

    /// What is kept of a touch.
    #[must_use]
    pub fn kept(&self, touch: &EdgeTouch) -> &EdgePair {
        &self.pairs[touch.pair as usize]
    }

    /// The same to change it.
    pub fn kept_mut(&mut self, touch: &EdgeTouch) -> &mut EdgePair {
        &mut self.pairs[touch.pair as usize]
    }

    /// Candidates again: all pairs of ridges nearer than the radius. What pairs remember continues.
    pub fn find(&mut self, around: &Around<'_>) {
        let Self { sides, at_nodes, search, found, .. } = self;
        let mut near = near(around, *sides, at_nodes, &mut **search, found);
        let old = take(&mut self.pairs);
        let kept = old.iter().filter(|pair| pair.touches);
        near.extend(kept.clone().map(|pair| pair.edges));
        near.sort_unstable();
        near.dedup();
        let body = |node: u32| self.bodies.get(node as usize).copied().unwrap_or(u32::MAX);
        let mut kept = kept.peekable();
        for edges in near {
            let [[a, _], [b, _]] = [0, 1].map(|of| around.surfaces[self.sides[of]].edges[edges[of] as usize].nodes);
            let new = EdgePair { edges, own: body(a) == body(b), ..EdgePair::default() };
            self.pairs.push(kept.next_if(|pair| pair.edges == edges).copied().unwrap_or(new));
        }
    }

    /// Pairs that are inside, or near enough to come in during the next update, ascending. `is_held` says
    /// whether a node (of the first surface or of the second) is in contact with a facet of the other one;
    /// `make` gives the stiffness and the area of a new spring, and the depth beyond which it stiffens.
    pub fn track(
        &mut self,
        around: &Around<'_>,
        is_held: impl Fn(usize, u32, u32) -> bool,
        make: impl Fn(&EdgeTouch) -> (f64, f64, Stiffening),
    ) -> &[EdgeTouch] {
        let springs = self.pairs.iter().filter(|pair| pair.touches);
        self.deepest = springs
            .map(|pair| pair.memory.spring.offset.abs() + pair.memory.spring.half.abs() + pair.memory.carried.abs())
            .fold(0.0, f64::max);
        let (mut found, mut order, mut taken) = (take(&mut self.touches), take(&mut self.order), take(&mut self.taken));
        found.clear();
        for number in 0..self.pairs.len() {
            found.extend(self.look_at(number, around, &is_held));
        }
        // What had a spring comes first; then one spring for each place at which two lines of edges cross;
        // then what had one beyond an end. The deepest first: numbers say nothing.
        order.clear();
        order.extend(0..found.len());
        order.sort_unstable_by(|&a, &b| found[a].crossing.gap.total_cmp(&found[b].crossing.gap).then(a.cmp(&b)));
        taken.clear();
        taken.resize(self.pairs.len(), false);
        for turn in 0..3 {
            let is_beyond = |touch: &EdgeTouch| !touch.crossing.is_within(BEYOND);
            let turn_of = |touch: &EdgeTouch| if touch.is_new { 1 } else { 2 * u32::from(is_beyond(touch)) };
            for touch in order.iter().map(|&at| &found[at]).filter(|touch| turn_of(touch) == turn) {
                let mut lines = self.beside(touch, around);
                let is_held = |other: Other| taken[other.pair] && self.cosine(other, &touch.crossing) > STRAIGHT;
                let is_free =
                    turn == 0 || lines.all(|other| !taken[other.pair]) && (turn == 2 || !self.come_from(touch.edges, around).any(is_held));
                taken[touch.pair as usize] = is_free;
            }
        }
        for touch in order.iter().map(|&at| &found[at]) {
            if !taken[touch.pair as usize] {
                continue;
            }
            if touch.is_new {
                let (stiffness, area, stiffening) = make(touch);
                let pair = &mut self.pairs[touch.pair as usize];
                (pair.stiffness, pair.area, pair.stiffening, pair.memory) = (stiffness, area, stiffening, ContactHistory::default());
                // A spring that went over the end of another edge continues: of several that which pushed
                // most nearly along this normal.
                let others = self.beside(touch, around).chain(self.come_from(touch.edges, around));
                let cosine = |other: Other| self.cosine(other, &touch.crossing);
                let better = |a: Other, b: Other| if cosine(b) > cosine(a) { b } else { a };
                let left = others.filter(|&other| self.goes_over(other, touch, &taken)).reduce(better);
                if let Some(left) = left {
                    let EdgePair { stiffness, area, stiffening, memory, .. } = self.pairs[left.pair];
                    // Normal and slip are those of the first edge against the second.
                    let of = |vector: Vector| vector.map(|c| left.sign() * c);
                    let spring = SpringHistory { normal: of(memory.spring.normal), ..memory.spring };
                    let memory = ContactHistory { spring, slip: of(memory.slip), ..memory };
                    self.pairs[left.pair].touches = false;
                    self.pairs[touch.pair as usize] = EdgePair { stiffness, area, stiffening, memory, ..self.pairs[touch.pair as usize] };
                }
            }
        }
        for (pair, taken) in self.pairs.iter_mut().zip(&taken) {
            pair.touches = *taken;
        }
        found.retain(|touch| taken[touch.pair as usize]);
        (self.touches, self.order, self.taken) = (found, order, taken);
        &self.touches
    }

    /// Whether the spring of a pair ended in this step and continues at a touch.
    fn goes_over(&self, other: Other, touch: &EdgeTouch, taken: &[bool]) -> bool {
        self.pairs[other.pair].touches && !taken[other.pair] && self.cosine(other, &touch.crossing) > STRAIGHT
    }

    /// Cosine of the angle between the normal of a pair's spring and that of a crossing.
    fn cosine(&self, other: Other, crossing: &Crossing) -> f64 {
        other.sign() * dot(self.pairs[other.pair].memory.spring.normal, crossing.normal)
    }

    /// Pairs of the edges of a touch, or those that continue from them in the same line.
    fn beside<'a>(&'a self, touch: &EdgeTouch, around: &'a Around<'_>) -> impl Iterator<Item = Other> + use<'a> {
        let [firsts, seconds] = [0, 1].map(|of| self.line(of, touch.edges[of], around));
        let (own, sides) = (touch.edges, self.sides);
        firsts.into_iter().flat_map(move |a| seconds.clone().into_iter().map(move |b| [a, b])).filter_map(move |[a, b]| {
            let is_swapped = sides[0] == sides[1] && a > b;
            let edges = if is_swapped { [b, a] } else { [a, b] };
            let pair = if edges == own { None } else { self.pairs.binary_search_by_key(&edges, |pair| pair.edges).ok() };
            pair.map(|pair| Other { pair, is_swapped })
        })
    }

    /// Pairs with an edge that continues from one of these at its end in any direction, and the same other
    /// edge, that cross beyond that end: what crosses has gone over the node.
    fn come_from<'a>(&'a self, edges: [u32; 2], around: &'a Around<'_>) -> impl Iterator<Item = Other> + use<'a> {
        let nodes = move |of: usize, edge: u32| around.surfaces[self.sides[of]].edges[edge as usize].nodes;
        let ends = (0..2).flat_map(move |of| nodes(of, edges[of]).map(|node| (of, node)));
        let others = ends.flat_map(move |(of, node)| {
            let surface = &around.surfaces[self.sides[of]];
            let at_node = surface.nodes.binary_search(&node).map_or(&[][..], |rank| self.at_nodes[self.sides[of]].of(rank));
            at_node.iter().filter(move |&&edge| edge != edges[of]).map(move |&edge| (of, node, edge))
        });
        others.filter_map(move |(of, node, edge)| {
            let mut pair = edges;
            pair[of] = edge;
            let is_turned = self.sides[0] == self.sides[1] && pair[0] > pair[1];
            let (sorted, at) = if is_turned { ([pair[1], pair[0]], 1 - of) } else { (pair, of) };
            let found = self.pairs.binary_search_by_key(&sorted, |pair| pair.edges).ok().filter(|&found| self.pairs[found].touches)?;
            let placed =
                [0, 1].map(|of| Placed { surface: &around.surfaces[self.sides[of]], positions: around.sweep.new }.edge(sorted[of]));
            let along = crossing(placed[0], placed[1])?.along[at];
            let is_beyond = if nodes(of, edge)[0] == node { along < 0.0 } else { along > 1.0 };
            is_beyond.then_some(Other { pair: found, is_swapped: is_turned })
        })
    }

    /// An edge, and those that continue from its ends in the same line.
    fn line(&self, of: usize, edge: u32, around: &Around<'_>) -> Vec<u32> {
        let nodes = around.surfaces[self.sides[of]].edges[edge as usize].nodes;
        let mut line = vec![edge];
        for node in nodes {
            line.extend(self.next(of, edge, node, around));
        }
        line
    }

    /// Edges that continue from an edge at its end `node` in the same line.
    fn next<'a>(&'a self, of: usize, edge: u32, node: u32, around: &'a Around<'_>) -> impl Iterator<Item = u32> + use<'a> {
        let surface = &around.surfaces[self.sides[of]];
        let placed = Placed { surface, positions: around.sweep.new };
        let along = move |edge: u32| {
            let [a, b] = placed.edge(edge);
            unit(minus(b, a))
        };
        let own = along(edge);
        let at_node = surface.nodes.binary_search(&node).map_or(&[][..], |rank| self.at_nodes[self.sides[of]].of(rank));
        at_node.iter().copied().filter(move |&other| other != edge && dot(own, along(other)).abs() > STRAIGHT)
    }

    /// Whether a crossing is on both edges, or so little beyond their ends that a closed spring continues.
    fn continues(&self, edges: [u32; 2], crossing: &Crossing, around: &Around<'_>) -> bool {
        (0..2).all(|of| {
            let along = crossing.along[of];
            let beyond = (-along).max(along - 1.0);
            let node = || around.surfaces[self.sides[of]].edges[edges[of] as usize].nodes[usize::from(along > 0.5)];
            beyond <= BEYOND || (beyond <= BENT && self.next(of, edges[of], node(), around).next().is_some())
        })
    }

    /// Where the edges of a pair cross.
    fn look_at(&self, number: usize, around: &Around<'_>, is_held: &impl Fn(usize, u32, u32) -> bool) -> Option<EdgeTouch> {
        let &Around { surfaces, sweep, is_new, radius, skin, near: [near, ahead], extra, open } = around;
        let EdgePair { edges, own, touches, memory, .. } = self.pairs[number];
        let placed = [0, 1].map(|of| Placed { surface: &surfaces[self.sides[of]], positions: sweep.new });
        let [a, b] = [0, 1].map(|of| placed[of].edge(edges[of]));
        let crossing = crossing(a, b)?;
        // A closed spring stays where one would not begin.
        let is_closed = touches && memory.spring.half < open;
        if !(if is_closed { self.continues(edges, &crossing, around) } else { crossing.is_within(0.0) }) {
            return None;
        }
        let nodes = [0, 1].map(|of| surfaces[self.sides[of]].edges[edges[of] as usize].nodes);
        let old = nodes.map(|edge| edge.map(|node| sweep.old[node as usize]));
        let [p, q] = crossing.along;
        let moved = minus(minus(point(a, p), point(old[0], p)), minus(point(b, q), point(old[1], q)));
        let motion = length(moved);
        if !is_closed && !is_new && crossing.gap.abs() > (near + ahead * motion).max(extra) + 2.0 * self.deepest {
            return None;
        }
        let ridges = [0, 1].map(|of| placed[of].ridge(edges[of]));
        let [Some(first), Some(second)] = ridges else { return None };
        let turned = crossing.turned();
        let fits = |crossing: &Crossing| crossing.fits([&first, &second]);
        let least = |crossing: &Crossing| fits(crossing).into_iter().fold(1.0, f64::min);
        let is_turned = if is_closed { dot(crossing.normal, memory.spring.normal) < 0.0 } else { least(&turned) > least(&crossing) };
        let crossing = if is_turned { turned } else { crossing };
        let [worse, better] = {
            let [a, b] = fits(&crossing);
            [a.min(b), a.max(b)]
        };
        if worse < if is_closed { STAYS } else { BEGINS } || (!is_closed && better < BETWEEN) {
            return None;
        }
        let are_sharp = first.is_sharp() && second.is_sharp();
        if !is_closed && !are_sharp {
            return None;
        }
        let known = touches && dot(memory.spring.normal, crossing.normal) > 0.0;
        if crossing.gap < 0.0 && !known {
            let shallow = || -crossing.gap <= (radius - skin).min(SHALLOW * Ridge::narrower(&first, &second));
            let comes = if is_new { !own && shallow() } else { self.entered(&crossing, [a, b], old) };
            // What went over the end of another edge was seen there.
            if !comes && !self.follows(number, &crossing, around) {
                return None;
            }
        }
        let touch = EdgeTouch { edges, nodes, crossing, own, is_new: !touches, stands: worse >= BETWEEN, pair: number as u32 };
        let facets = |of: usize| surfaces[self.sides[of]].edges[edges[of] as usize].facets;
        let holds = |of: usize| nodes[of].iter().any(|&node| facets(1 - of).iter().any(|&facet| is_held(of, node, facet)));
        if !is_closed && (holds(0) || holds(1)) {
            return None;
        }
        let ahead = extra + near + ahead * motion;
        (is_closed || crossing.gap <= ahead.min(radius - skin).max(extra)).then_some(touch)
    }

    /// Whether edges went through each other in the step.
    fn entered(&self, crossing_new: &Crossing, [a, b]: [[Vector; 2]; 2], [a_old, b_old]: [[Vector; 2]; 2]) -> bool {
        let Some(before) = crossing(a_old, b_old) else { return false };
        let before = if dot(before.normal, crossing_new.normal) < 0.0 { before.turned() } else { before };
        if before.gap < 0.0 {
            return false;
        }
        let at = before.gap / (before.gap - crossing_new.gap);
        let between = |from: [Vector; 2], to: [Vector; 2]| [0, 1].map(|k| [0, 1, 2].map(|d| from[k][d] + at * (to[k][d] - from[k][d])));
        crossing(between(a_old, a), between(b_old, b)).is_some_and(|found| found.is_within(ON_WAY))
    }

    /// Whether a pair beside had a closed spring to the same side.
    fn follows(&self, number: usize, crossing: &Crossing, around: &Around<'_>) -> bool {
        let pair = &self.pairs[number];
        let touch = EdgeTouch {
            edges: pair.edges,
            nodes: [[0; 2]; 2],
            crossing: *crossing,
            own: pair.own,
            is_new: true,
            stands: false,
            pair: number as u32,
        };
        let follows = |other: Other| {
            let pair = &self.pairs[other.pair];
            pair.touches && pair.memory.spring.half < around.open && self.cosine(other, crossing) > STRAIGHT
        };
        self.beside(&touch, around).any(follows) || self.come_from(pair.edges, around).any(follows)
    }

    /// Keeps what is known of the past.
    pub(super) fn persist(&mut self, archive: &mut Archive<'_>, surfaces: &[SpaceSurface]) -> ArchiveResult {
        crate::archive::Persist::persist(&mut self.pairs, archive)?;
        let is_there = |pair: &EdgePair| (0..2).all(|of| (pair.edges[of] as usize) < surfaces[self.sides[of]].edges.len());
        let is_sorted = self.pairs.is_sorted_by(|a, b| a.edges < b.edges);
        archive.check(is_sorted && self.pairs.iter().all(is_there), "a contact follows edges that are not there")
    }

    /// Takes over what another one knew whose `surfaces` were those before they changed: of edges that are
    /// still there in `new` ones.
    pub(super) fn inherit(&mut self, old: &Self, surfaces: [&[SpaceSurface]; 2], number: impl Fn(u32) -> Option<u32>) {
        let [surfaces, new] = surfaces;
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let by_nodes = |side: usize| {
            let mut all: Vec<([u32; 2], u32)> = new[side].edges.iter().map(|edge| sorted(edge.nodes)).zip(0..).collect();
            all.sort_unstable();
            all
        };
        let tables = self.sides.map(by_nodes);
        let known = old.pairs.iter().filter(|pair| pair.touches).filter_map(|pair| {
            let mut edges = [0; 2];
            for of in 0..2 {
                let [a, b] = surfaces[old.sides[of]].edges[pair.edges[of] as usize].nodes;
                let nodes = sorted([number(a)?, number(b)?]);
                let at = tables[of].binary_search_by_key(&nodes, |entry| entry.0).ok()?;
                edges[of] = tables[of][at].1;
            }
            if self.sides[0] == self.sides[1] {
                edges.sort_unstable();
            }
            Some(EdgePair { edges, ..*pair })
        });
        self.pairs = known.collect();
        self.pairs.sort_by_key(|pair| pair.edges);
    }
}

impl Ridge {
    fn narrower(a: &Self, b: &Self) -> f64 {
        a.width.min(b.width)
    }
}

/// Direction of the first edge: the first tangent along which the slip is.
#[must_use]
pub fn tangent(touch: &EdgeTouch, positions: &[Vector]) -> Vector {
    let [a, b] = touch.nodes[0].map(|node| positions[node as usize]);
    unit(minus(b, a))
}

/// The ends of a spring between two edges; `tangent` is the first along which the slip is.
///
/// The slip rate is that of the closest points less what a rotation of both together makes of it, ṡ = t·(v_a
/// − v_b) − g t·ṅ. The normal stays at right angles to both edges, e·ṅ = −n·ė, so ṅ = −(n·ė_a) e^a − (n·ė_b)
/// e^b with the dual vectors of both edges: friction keeps the angular momentum.
#[must_use]
pub fn ends(touch: &EdgeTouch, tangent: Vector, positions: &[Vector]) -> [End<3>; 4] {
    let Crossing { along: [s, t], gap, normal } = touch.crossing;
    let [p, q] = touch.nodes.map(|[a, b]| minus(positions[b as usize], positions[a as usize]));
    let dual = |own: Vector, other: Vector| {
        let across = cross(other, normal);
        let size = dot(across, own);
        across.map(|c| c / size)
    };
    let duals = [dual(p, q), dual(q, p)];
    let tangents = Dim::<3>::tangents(normal, &tangent);
    let [[a, b], [c, d]] = touch.nodes;
    let end = |node: u32, weight: f64, of: usize, sign: f64| {
        // Beyond the end of an edge a weight is negative: the node belongs to its surface all the same.
        let side = [1.0, -1.0][of];
        let (share, beyond) = (side * weight.max(0.0), side * weight.min(0.0));
        let turn = tangents.map(|t| {
            let by = sign * gap * dot(t, duals[of]);
            [0, 1, 2].map(|d| by * normal[d] + beyond * t[d])
        });
        End { lean: normal.map(|n| beyond * n), turn, ..End::node(node, share) }
    };
    [end(a, 1.0 - s, 0, -1.0), end(b, s, 0, 1.0), end(c, 1.0 - t, 1, -1.0), end(d, t, 1, 1.0)]
}
