//! Where slave nodes lie with respect to the bodies of surfaces in 3D, from step to step: candidates from
//! the global search, the side from which each node came in, and the projection of the step.
//!
//! Positions come from the step; what is found goes to the formulation, which makes springs of it. A slave
//! node and a body make a group with a memory of its own and at most one touch. The nearest feature of the
//! body decides (`projection/node_facet.rs`), and
//!
//! - a node that is inside, or has just gone through a facet on its way (checked along the way in the step,
//!   so that it may be as fast as it likes, by `passage.rs`), sees only facets that look to the side from
//!   which it came: through a thin plate the far side may be nearer, but is not where it goes out;
//! - the face by which it comes in leads it while it is over that face, however near a side wall is, and
//!   wherever it is once it went through the far side: until it is before the face, or went out by another
//!   side, or the face is what is nearest;
//! - a face holds the nodes that press on it, or come upon it from the front, over its rim and a little
//!   beyond: blocks that end flush press on each other with their edges too, whatever rounds or spreads. The
//!   slave's own surface has to face it and to go back over it; who slides down beside a body has nothing to
//!   do with its top;
//! - in its own body it sees only facets that its own surface looks at, and is inside only if it was seen to
//!   come in: its neighbours along the surface are near, and its own far side is behind it.
//!
//! Everything within the search's radius less the skin is a candidate, until some node has moved by more than
//! half the skin; what is far among them is not looked at (`far.rs`). Order is fixed: passes, slave nodes,
//! bodies ascending.

mod locate;
mod steady;

use super::super::continuity::SpringHistory;
use super::super::projection::node_facet::{Placed, Projection, Vector};
use super::super::search::{Query, Search};
use super::super::tracker::sleep::{AWAKE, awake, wake_at};
use super::super::tracker::{Reach, SKIN, SLACK, SearchReport};
use super::super::{Origins, Sweep};
use super::groups::{self, Group, Meeting, bend, bodies_of, halves, mean_edge, nearest, renumbered};
use super::measured::Measures;
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::mesh::surface::{NONE, SpaceSurface};
use crate::vector::{length, minus};
use embate_lanes::Level;
use locate::{Chunk, Look};

/// Cosine of the angle between the side from which a node came and those of facets that it sees while it is
/// inside.
pub(in crate::contact) const SAME_SIDE: f64 = -0.5;
/// The same between a node's own normal and those of facets of its own body that it can meet.
pub(in crate::contact) const FACING: f64 = -0.2;
/// Nodes are seen that may come in with so many times the last motion, and this fraction of the skin for
/// those that are set in motion now.
const LOOK_AHEAD: f64 = 4.0;
const START: f64 = 0.02;
/// A node nearer to a side than this fraction of the skin (a millionth of an edge) is on it, within
/// rounding.
const FLUSH: f64 = 4e-6;
/// How far a face holds nodes beyond its rim, as a fraction of the size of its facets (the root of the sum of
/// the squares of both diagonals).
const BAND: f64 = 0.02;
/// Cosine of the angle between the normal that a node felt and that of the face that holds it.
const SAME_FACE: f64 = 0.9;

/// Groups that one task looks at, and how many have to be awake for more than one task.
const CHUNK: usize = 256;
const SERIAL: usize = 2 * CHUNK;

/// What is kept of a slave and a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactHistory {
    /// Elastic slip at n + ½ as a vector, m.
    pub slip: Vector,
    /// Facet on which it was, or [`NONE`], and the edge or node, see `Placed::rests_on`.
    pub facet: u32,
    /// See `facet`.
    pub rest: [u32; 2],
    /// Its spring.
    pub spring: SpringHistory<3>,
    /// By how much that was less deep at n − ½ than the surfaces at n − 1, m.
    pub carried: f64,
    /// Side from which the node came in; zero while it is outside.
    pub side: Vector,
    /// Whether the face by which it came in leads it, though something else is nearer.
    pub is_led: bool,
    /// Stiffness of its spring by area, Pa/m.
    pub by_area: f64,
}

impl Default for ContactHistory {
    fn default() -> Self {
        let (none, spring) = ([0.0; 3], SpringHistory::default());
        Self { slip: none, facet: NONE, rest: [NONE; 2], spring, carried: 0.0, side: none, is_led: false, by_area: 0.0 }
    }
}

persist_all!(ContactHistory { slip, facet, rest, spring, carried, side, is_led, by_area });

/// What is known of a slave node and a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Known {
    /// Whether it touched in the last step. Else nothing is kept of it.
    touches: bool,
    memory: ContactHistory,
}

persist_all!(Known { touches, memory });

/// A slave node that is inside a body, or near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Pass that found it.
    pub pass: u32,
    /// Index of the node in its surface.
    pub slave: u32,
    /// The node.
    pub node: u32,
    /// Where it lies.
    pub projection: Projection,
    /// Whether it is the node's own body.
    pub own: bool,
    group: u32,
}

/// Nodes of one surface against another one, or the same.
#[derive(Default)]
struct Pass {
    slave: usize,
    target: usize,
    /// Body of each facet of the target.
    bodies: Vec<u32>,
    groups: Vec<Group<Known>>,
    candidates: Vec<u32>,
    /// What is known of the distances of candidates and groups; see `far.rs`.
    clear: Vec<f64>,
    wakes: Vec<f64>,
    /// How far beyond what touches a rim may hold a node, m.
    band: f64,
}

/// Follows the nodes of surfaces in 3D along the bodies of other surfaces, or of their own.
pub struct Tracker {
    surfaces: Vec<SpaceSurface>,
    passes: Vec<Pass>,
    reach: Reach<3>,
    /// Two triangles for each facet of each surface; of a triangle twice itself.
    triangles: Vec<Vec<[u32; 3]>>,
    /// A facet and a corner at each node of each surface.
    corners: Vec<Vec<(u32, u32)>>,
    /// Body of each node as far as the surfaces go.
    bodies: Vec<u32>,
    /// Whether nothing is known of the past.
    is_new: bool,
    /// A face holds nodes no farther beyond its rim than this, m.
    band: f64,
    /// Everything nearer was found by the last search, m.
    radius: f64,
    /// Travel of the last step, m.
    travel: f64,
    /// What was found in the last step.
    task: Task,
    /// The same of each chunk of groups, where these are shared among threads.
    chunks: Vec<Task>,
    /// With which groups that touch are measured together; nothing: each by itself.
    level: Option<Level>,
}

/// What was found in a step.
#[derive(Default)]
struct Found {
    touches: Vec<ContactPoint>,
    /// Depth of the deepest touch, m.
    deepest: f64,
}

/// What looks at groups: what it found, and room for what is measured on the way.
#[derive(Default)]
struct Task {
    found: Found,
    measures: Measures,
    /// How many groups continued as they were in the last step.
    #[cfg(test)]
    stayed: usize,
}

impl Found {
    fn clear(&mut self) {
        self.touches.clear();
        self.deepest = 0.0;
    }
}

impl Tracker {
    /// For the nodes of `surfaces[slave]` against `surfaces[target]` in each pass (slave, target), which may
    /// be the same surface; `bodies` of each node of the model (0 for those beyond), `positions` the initial
    /// ones.
    #[must_use]
    pub fn new(
        surfaces: Vec<SpaceSurface>,
        passes: &[(usize, usize)],
        bodies: &[u32],
        search: Box<dyn Search<3>>,
        positions: &[Vector],
    ) -> Self {
        let of = |node: u32| bodies.get(node as usize).copied().unwrap_or(u32::MAX);
        let pass = |&(slave, target): &(usize, usize)| {
            let own = surfaces[target].facets.iter().map(|facet| of(facet[0])).collect();
            Pass { slave, target, bodies: own, ..Pass::default() }
        };
        let passes = passes.iter().map(pass).collect();
        let halves = |surface: &SpaceSurface| surface.facets.iter().flat_map(halves).collect();
        let corners = |surface: &SpaceSurface| {
            let at = |(rank, node): (usize, &u32)| {
                let facet = surface.around(rank).first().copied().unwrap_or(0);
                let corner = surface.facets[facet as usize].iter().position(|other| other == node).unwrap_or(0);
                (facet, corner as u32)
            };
            surface.nodes.iter().enumerate().map(at).collect()
        };
        let (triangles, corners) = (surfaces.iter().map(halves).collect(), surfaces.iter().map(corners).collect());
        let nodes = surfaces.iter().flat_map(|surface| surface.nodes.iter().copied());
        let reach = Reach::new(search, nodes, SKIN * mean_edge(&surfaces, positions));
        let bodies = bodies_of(&surfaces, bodies);
        #[rustfmt::skip]
        let tracker = Self {
            surfaces, passes, reach, triangles, corners, bodies, is_new: true, band: f64::INFINITY, radius: 0.0,
            travel: 0.0, task: Task::default(), chunks: Vec::new(), level: Some(Level::best()),
        };
        tracker
    }

    /// The same where the lengths of `surface` count alone, however large facets of others are: those of an
    /// obstacle may have any size.
    #[must_use]
    pub fn measured_by(self, surface: usize, positions: &[Vector]) -> Self {
        let edge = mean_edge(&self.surfaces[surface..=surface], positions);
        let skin = self.reach.skin.min(SKIN * edge);
        // The diagonals of a square.
        Self { reach: self.reach.with_skin(skin), band: 2.0 * BAND * edge, ..self }
    }

    /// The surfaces.
    #[must_use]
    pub fn surfaces(&self) -> &[SpaceSurface] {
        &self.surfaces
    }

    /// Target of a pass.
    #[must_use]
    pub fn target(&self, pass: u32) -> &SpaceSurface {
        &self.surfaces[self.passes[pass as usize].target]
    }

    /// Whether the slaves of a pass are the first surface (1), the second (−1), or both in one (0).
    #[must_use]
    pub fn side(&self, pass: u32) -> f32 {
        let Pass { slave, target, .. } = self.passes[pass as usize];
        if slave == target { 0.0 } else { 1.0 - 2.0 * slave as f32 }
    }

    /// What the search cost so far.
    #[must_use]
    pub fn search_report(&self) -> SearchReport {
        SearchReport { candidates: self.passes.iter().map(|pass| pass.candidates.len()).sum(), ..self.reach.report }
    }

    /// Everything nearer was found by the last search, and the part of it for what moves until the next one,
    /// m.
    #[must_use]
    pub fn reach(&self) -> [f64; 2] {
        [self.radius, self.reach.skin]
    }

    /// Gap (m) up to which springs are there before they are needed, beside what the motion asks for; and how
    /// many motions ahead.
    #[must_use]
    pub fn near(&self) -> [f64; 2] {
        [START * self.reach.skin, LOOK_AHEAD]
    }

    /// Fills a list with the nodes whose springs were closed (gap below `open`, m) after the last step: slave
    /// surface, node, and each facet on which it lay, ascending.
    pub fn note_closed(&self, open: f64, closed: &mut Vec<(usize, u32, u32)>) {
        closed.clear();
        for pass in &self.passes {
            // A node that edges stand for touches without a spring.
            let is_closed = |group: &&Group<Known>| group.known.touches && group.known.memory.spring.half() < open;
            for group in pass.groups.iter().filter(is_closed) {
                closed.extend(self.lies_on(pass, group));
            }
        }
        closed.sort_unstable();
    }

    /// Slave surface and node of a touch, and each facet on which it lay in the last step.
    pub fn lay_on(&self, touch: &ContactPoint) -> impl Iterator<Item = (usize, u32, u32)> {
        let pass = &self.passes[touch.pass as usize];
        self.lies_on(pass, &pass.groups[touch.group as usize])
    }

    fn lies_on(&self, pass: &Pass, group: &Group<Known>) -> impl Iterator<Item = (usize, u32, u32)> {
        let (slave, node, ContactHistory { facet, rest, .. }) = (pass.slave, group.node, group.known.memory);
        self.surfaces[pass.target].sharing(facet, rest).map(move |facet| (slave, node, facet))
    }

    /// Body of each node as far as the surfaces go.
    #[must_use]
    pub fn bodies(&self) -> &[u32] {
        &self.bodies
    }

    /// Slave surface of a pass.
    #[must_use]
    pub fn slave(&self, pass: u32) -> usize {
        self.passes[pass as usize].slave
    }

    /// What [`Tracker::track`] found last.
    #[must_use]
    pub fn touches(&self) -> &[ContactPoint] {
        &self.task.found.touches
    }

    /// What is kept of a touch: nothing where slave and body did not touch in the last step.
    #[must_use]
    pub fn kept(&self, touch: &ContactPoint) -> &ContactHistory {
        &self.passes[touch.pass as usize].groups[touch.group as usize].known.memory
    }

    /// The same to change it.
    pub fn kept_mut(&mut self, touch: &ContactPoint) -> &mut ContactHistory {
        &mut self.passes[touch.pass as usize].groups[touch.group as usize].known.memory
    }

    /// Nodes that are inside, or near enough to come in during the next update, ascending by pass, slave and
    /// body. Nodes farther than `extra` (m) beyond that are not looked at.
    pub fn track(&mut self, sweep: Sweep<'_, 3>, extra: f64) -> &[ContactPoint] {
        self.reach.report.steps += 1;
        let mut sweep = sweep;
        if std::mem::replace(&mut self.is_new, false) {
            // Nothing is known of the past: a node in another body is where the nearest feature says.
            sweep.old = sweep.new;
        }
        let way = sweep.travel - std::mem::replace(&mut self.travel, sweep.travel);
        if self.reach.is_left(sweep) {
            self.find_candidates(sweep, extra);
        }
        let (mut task, mut chunks) = (std::mem::take(&mut self.task), std::mem::take(&mut self.chunks));
        task.found.clear();
        for number in 0..self.passes.len() {
            let pass = &mut self.passes[number];
            let asleep = awake(extra + START * self.reach.skin + pass.band, LOOK_AHEAD, sweep.travel, way);
            let (mut groups, mut wakes, mut clear) =
                (std::mem::take(&mut pass.groups), std::mem::take(&mut pass.wakes), std::mem::take(&mut pass.clear));
            // Within a pool of threads the groups are shared among them; each is looked at by itself.
            let is_shared = rayon::current_thread_index().is_some() && wakes.iter().filter(|wake| **wake <= asleep).count() >= SERIAL;
            let look = Look { pass: number, sweep, extra, way, asleep };
            let count = groups.len().div_ceil(CHUNK);
            let all = Chunk { first: [0; 2], groups: &mut groups, wakes: &mut wakes, clear: &mut clear };
            if is_shared {
                chunks.resize_with(count.max(chunks.len()), Task::default);
                chunks[..count].iter_mut().for_each(|chunk| chunk.found.clear());
                self.share(look, all, &mut chunks[..count]);
                for Task { found, .. } in &chunks[..count] {
                    task.found.touches.extend_from_slice(&found.touches);
                    task.found.deepest = task.found.deepest.max(found.deepest);
                }
            } else {
                self.look_at(look, all, &mut task);
            }
            let pass = &mut self.passes[number];
            (pass.groups, pass.wakes, pass.clear) = (groups, wakes, clear);
        }
        (self.task, self.chunks) = (task, chunks);
        &self.task.found.touches
    }

    /// Forgets what is known of the past.
    pub fn forget(&mut self) {
        for Pass { groups, candidates, clear, wakes, .. } in &mut self.passes {
            groups.clear();
            candidates.clear();
            clear.clear();
            wakes.clear();
        }
        self.reach.forget();
        (self.is_new, self.radius, self.task.found.deepest, self.travel) = (true, 0.0, 0.0, 0.0);
    }

    /// Groups and candidates again; what groups remember continues.
    fn find_candidates(&mut self, sweep: Sweep<'_, 3>, extra: f64) {
        let way = |node: u32| length(minus(sweep.new[node as usize], sweep.old[node as usize]));
        let radius = 2.0 * self.reach.skin + extra + LOOK_AHEAD * self.reach.fastest(way) + self.task.found.deepest;
        let Self { surfaces, passes, triangles, bodies, band, reach: Reach { search, pairs, skin, .. }, .. } = self;
        let skin = *skin;
        for pass in passes {
            let (slaves, target) = (&surfaces[pass.slave].nodes, &surfaces[pass.target]);
            let reach = SLACK * (radius + bend(target, sweep.new));
            let query = Query { positions_old: sweep.old, positions_new: sweep.new, slaves, facets: &triangles[pass.target], reach };
            let placed = Placed { surface: target, positions: sweep.new };
            let largest = (0..target.facets.len() as u32).map(|facet| placed.size(facet)).fold(0.0, f64::max);
            pass.band = (BAND * largest).min(*band);
            let old = std::mem::take(&mut pass.groups);
            let mut old = old.iter().peekable();
            pass.candidates.clear();
            pass.clear.clear();
            let body = |node: u32| bodies.get(node as usize).copied().unwrap_or(u32::MAX);
            let counts = |node: u32, facet: u32| {
                let distance = placed.distance(sweep.new[node as usize], facet);
                // Those that the node has passed on its way stay, however far it is now.
                let is_near = distance.is_some_and(|distance| distance <= radius) || way(node) > skin;
                is_near.then(|| distance.map_or(AWAKE, |distance| wake_at(distance, sweep.travel)))
            };
            let meeting = Meeting { slaves, target, is_one: pass.slave == pass.target };
            meeting.each(&mut **search, &query, pairs, body, counts, |[slave, node, there], facets| {
                let begin = pass.candidates.len() as u32;
                for (facet, clear) in facets {
                    pass.candidates.push(facet);
                    pass.clear.push(clear);
                }
                let (end, own) = (pass.candidates.len() as u32, body(node) == there);
                let known = Group::known_of(&mut old, (slave, there)).unwrap_or_default();
                pass.groups.push(Group { slave, node, body: there, begin, end, own, known });
            });
            pass.wakes.clear();
            pass.wakes.resize(pass.groups.len(), AWAKE);
        }
        self.radius = radius;
        self.reach.settle(sweep);
    }

    /// Normal of a slave at its own surface.
    pub(in crate::contact) fn own_normal(&self, surface: usize, slave: u32, positions: &[Vector]) -> Vector {
        let (facet, corner) = self.corners[surface][slave as usize];
        let (normal, _) = Placed { surface: &self.surfaces[surface], positions }.node_normal(facet, corner as usize);
        normal.map(|n| n / length(normal).max(f64::MIN_POSITIVE))
    }

    /// Whether the surface at a slave looks against a direction as far as all its triangles say, and so its
    /// normal: without the angles that this takes.
    fn own_faces(&self, surface: usize, slave: u32, direction: Vector, positions: &[Vector]) -> bool {
        let (facet, corner) = self.corners[surface][slave as usize];
        Placed { surface: &self.surfaces[surface], positions }.faces(facet, corner as usize, direction, FACING)
    }

    /// Keeps what is known of the past.
    pub(in crate::contact) fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        for pass in &mut self.passes {
            persist_each!(archive; &mut pass.groups, &mut pass.candidates, &mut pass.clear, &mut pass.wakes, &mut pass.band);
            let (groups, candidates) = (pass.groups.len(), pass.candidates.len());
            archive.check(pass.wakes.len() == groups && pass.clear.len() == candidates, "a contact knows distances of others")?;
            let (slaves, target, facets) = (&self.surfaces[pass.slave].nodes, &self.surfaces[pass.target].nodes, pass.bodies.len());
            let is_known = |group: &Group<Known>| {
                let memory = &group.known.memory;
                group.is_there(slaves, pass.candidates.len())
                    && (memory.facet == NONE || (memory.facet as usize) < facets)
                    && memory.rest.iter().all(|&node| node == NONE || target.binary_search(&node).is_ok())
            };
            // Chunks of groups are looked at with their own candidates.
            let mut ends = pass.groups.iter().filter(|group| group.begin < group.end).map(|group| [group.begin, group.end]);
            let follow = ends.next().is_none_or(|first| ends.try_fold(first[1], |end, [begin, to]| (begin == end).then_some(to)).is_some());
            archive.check(follow, "candidates of a contact's nodes are out of order")?;
            let are_there = pass.candidates.iter().all(|&facet| (facet as usize) < facets);
            archive.check(are_there && pass.groups.iter().all(is_known), "a contact follows nodes or facets that are not there")?;
        }
        persist_each!(archive; &mut self.reach, &mut self.is_new, &mut self.radius, &mut self.task.found.deepest, &mut self.travel);
        Ok(())
    }

    /// Takes over what another one knew whose surfaces were those before they changed: of nodes that are
    /// still there.
    pub(in crate::contact) fn inherit(&mut self, old: &Self) {
        for (pass, before) in self.passes.iter_mut().zip(&old.passes) {
            let touching = before.groups.iter().filter(|group| group.known.touches);
            pass.groups = Group::moved(touching, &self.surfaces[pass.slave].nodes);
            // Facets have other numbers now.
            pass.groups.iter_mut().for_each(|group| (group.known.memory.facet, group.known.memory.rest) = (NONE, [NONE; 2]));
            pass.wakes = vec![AWAKE; pass.groups.len()];
        }
        self.inherit_course(old);
    }

    fn inherit_course(&mut self, old: &Self) {
        self.is_new = old.is_new;
        (self.travel, self.task.found.deepest) = (old.travel, old.task.found.deepest);
        self.reach.inherit(&old.reach);
    }

    /// Takes over what another one knew before elements were made again: a node has what those knew that it
    /// lies between. `gap` is that of the spring of an old touch, m, which goes into `half`: see
    /// [`super::super::continuity::Continuity::moved`].
    pub(in crate::contact) fn carry(&mut self, old: &Self, origins: &Origins<'_, 3>, gap: impl Fn(&ContactPoint) -> f64) {
        let bodies = renumbered(&old.bodies, &self.bodies, origins);
        let mut gaps: Vec<Vec<f64>> = old.passes.iter().map(|pass| vec![0.0; pass.groups.len()]).collect();
        old.touches().iter().for_each(|touch| gaps[touch.pass as usize][touch.group as usize] = gap(touch));
        for ((pass, before), gaps) in self.passes.iter_mut().zip(&old.passes).zip(&mut gaps) {
            // What a node has to do with its body, with its gap.
            let with_gap = |(group, gap): (&Group<Known>, &f64)| {
                let mut own = *group;
                own.known.memory.spring.half = *gap;
                own
            };
            let touching: Vec<Group<Known>> =
                before.groups.iter().zip(&*gaps).filter(|(group, _)| group.known.touches).map(with_gap).collect();
            pass.groups = Group::carried(touching.iter(), (&self.surfaces[pass.slave].nodes, &bodies), origins, mixed);
            pass.wakes = vec![AWAKE; pass.groups.len()];
        }
        self.inherit_course(old);
    }
}

/// What is known of a node between others that touch a body: means, and the rest from the nearest.
fn mixed(others: &[(f64, &Group<Known>)]) -> Known {
    let whole: f64 = others.iter().map(|(share, _)| share).sum();
    let mean = |of: &dyn Fn(&ContactHistory) -> f64| others.iter().map(|(share, group)| share * of(&group.known.memory)).sum::<f64>();
    let Some(nearest) = nearest(others) else { return Known::default() };
    // Who came in is inside, whatever those know that are not.
    let came_in: Vec<(f64, &Group<Known>)> = others.iter().copied().filter(|(_, group)| group.known.memory.side != [0.0; 3]).collect();
    let inside = groups::nearest(&came_in).unwrap_or(nearest).known.memory;
    let has_spring: Vec<(f64, &Group<Known>)> =
        others.iter().copied().filter(|(_, group)| group.known.memory.spring.normal != [0.0; 3]).collect();
    let shares: f64 = has_spring.iter().map(|(share, _)| share).sum();
    let of_springs = |of: &dyn Fn(&ContactHistory) -> f64| {
        if shares > 0.0 { has_spring.iter().map(|(share, group)| share * of(&group.known.memory)).sum::<f64>() / shares } else { 0.0 }
    };
    let spring = groups::nearest(&has_spring).map_or_else(SpringHistory::default, |own| own.known.memory.spring);
    let memory = ContactHistory {
        slip: [0, 1, 2].map(|d| mean(&|memory| memory.slip[d])),
        spring: SpringHistory { offset: 0.0, half: of_springs(&|memory| memory.spring.half), stored: 0.0, ..spring },
        side: inside.side,
        is_led: inside.is_led,
        by_area: of_springs(&|memory| memory.by_area),
        ..ContactHistory::default()
    };
    Known { touches: whole > 0.0, memory }
}

#[cfg(test)]
mod tests;
