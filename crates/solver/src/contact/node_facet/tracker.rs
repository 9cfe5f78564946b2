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

use super::super::Sweep;
use super::super::continuity::SpringHistory;
use super::super::projection::node_facet::{Placed, Projection, Vector};
use super::super::search::{Query, Search};
use super::super::tracker::sleep::{AWAKE, awake, wake_at};
use super::super::tracker::{Reach, SKIN, SLACK, SearchReport};
use super::far::Candidates;
use super::groups::{Group, Meeting, bend, bodies_of, halves, mean_edge};
use super::passage::{Passages, led};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::mesh::surface::{NONE, SpaceSurface};
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};

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
}

impl Default for ContactHistory {
    fn default() -> Self {
        let (none, spring) = ([0.0; 3], SpringHistory::default());
        Self { slip: none, facet: NONE, rest: [NONE; 2], spring, carried: 0.0, side: none, is_led: false }
    }
}

persist_all!(ContactHistory { slip, facet, rest, spring, carried, side, is_led });

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

/// Where a node is with respect to a body.
enum Place {
    /// It touches: its projection, the side from which it came in, and whether the face there leads it.
    Touches(Projection, Vector, bool),
    /// Not near.
    Away,
    /// So deep inside, without having been seen to come in, that it is not taken for a touch.
    Lost,
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
    found: Found,
    /// The same of each chunk of groups, where these are shared among threads.
    chunks: Vec<Found>,
}

/// Groups that one task looks at, and what is known of them.
struct Chunk<'a> {
    /// Number of the first group, and of the first candidate, among those of the pass.
    first: [usize; 2],
    groups: &'a mut [Group<Known>],
    wakes: &'a mut [f64],
    clear: &'a mut [f64],
}

impl Chunk<'_> {
    /// The groups before number `middle`, and the others.
    fn split(self, middle: usize) -> [Self; 2] {
        let Chunk { first: [first, begin], groups, wakes, clear } = self;
        // Groups without candidates may stand anywhere.
        let to = groups[middle..].iter().find(|group| group.begin < group.end).map_or(clear.len(), |group| group.begin as usize - begin);
        let (groups, wakes, clear) = (groups.split_at_mut(middle), wakes.split_at_mut(middle), clear.split_at_mut(to));
        [
            Chunk { first: [first, begin], groups: groups.0, wakes: wakes.0, clear: clear.0 },
            Chunk { first: [first + middle, begin + to], groups: groups.1, wakes: wakes.1, clear: clear.1 },
        ]
    }
}

/// What was found in a step.
#[derive(Default)]
struct Found {
    touches: Vec<ContactPoint>,
    /// Depth of the deepest touch, m.
    deepest: f64,
}

impl Found {
    fn clear(&mut self) {
        self.touches.clear();
        self.deepest = 0.0;
    }
}

/// The step as all groups of a pass see it.
#[derive(Clone, Copy)]
struct Look<'a> {
    /// Number of the pass.
    pass: usize,
    sweep: Sweep<'a, 3>,
    /// Distance up to which touches are wanted beside what the motion asks for, and the longest way of a node
    /// in the step, m.
    extra: f64,
    way: f64,
    /// Groups that wake beyond it are not looked at, m.
    asleep: f64,
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
            surfaces, passes, reach, triangles, corners, bodies, is_new: true, band: f64::INFINITY, radius: 0.0, travel: 0.0, found: Found::default(), chunks: Vec::new(),
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
            let target = &self.surfaces[pass.target];
            for Group { node, known: Known { memory: ContactHistory { facet, rest, .. }, .. }, .. } in pass.groups.iter().filter(is_closed)
            {
                closed.extend(target.sharing(*facet, *rest).map(|facet| (pass.slave, *node, facet)));
            }
        }
        closed.sort_unstable();
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
        &self.found.touches
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
        let (mut found, mut chunks) = (std::mem::take(&mut self.found), std::mem::take(&mut self.chunks));
        found.clear();
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
                chunks.resize_with(count.max(chunks.len()), Found::default);
                chunks[..count].iter_mut().for_each(Found::clear);
                self.share(look, all, &mut chunks[..count]);
                for chunk in &chunks[..count] {
                    found.touches.extend_from_slice(&chunk.touches);
                    found.deepest = found.deepest.max(chunk.deepest);
                }
            } else {
                self.look_at(look, all, &mut found);
            }
            let pass = &mut self.passes[number];
            (pass.groups, pass.wakes, pass.clear) = (groups, wakes, clear);
        }
        (self.found, self.chunks) = (found, chunks);
        &self.found.touches
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
        (self.is_new, self.radius, self.found.deepest, self.travel) = (true, 0.0, 0.0, 0.0);
    }

    /// Groups and candidates again; what groups remember continues.
    fn find_candidates(&mut self, sweep: Sweep<'_, 3>, extra: f64) {
        let way = |node: u32| length(minus(sweep.new[node as usize], sweep.old[node as usize]));
        let radius = 2.0 * self.reach.skin + extra + LOOK_AHEAD * self.reach.fastest(way) + self.found.deepest;
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

    /// Looks at a chunk in `found.len()` smaller ones, halves of them at the same time.
    fn share(&self, look: Look<'_>, chunk: Chunk<'_>, found: &mut [Found]) {
        if let [found] = found {
            return self.look_at(look, chunk, found);
        }
        let middle = found.len() / 2;
        let (low, high) = found.split_at_mut(middle);
        let [before, after] = chunk.split(middle * CHUNK);
        rayon::join(|| self.share(look, before, low), || self.share(look, after, high));
    }

    /// Looks at the groups of a chunk that are awake.
    fn look_at(&self, look: Look<'_>, mut chunk: Chunk<'_>, found: &mut Found) {
        for index in 0..chunk.groups.len() {
            if chunk.wakes[index] <= look.asleep {
                self.look_at_group(look, &mut chunk, index, found);
            }
        }
    }

    /// Where the node of a group is with respect to its body.
    fn look_at_group(&self, look: Look<'_>, chunk: &mut Chunk<'_>, index: usize, found: &mut Found) {
        let Look { pass: number, sweep, extra, way, asleep } = look;
        let (pass, [first, begin]) = (&self.passes[number], chunk.first);
        let group = &mut chunk.groups[index];
        let facets = &pass.candidates[group.candidates()];
        let clear = if facets.is_empty() { &mut [] } else { &mut chunk.clear[group.begin as usize - begin..group.end as usize - begin] };
        let mut candidates = Candidates { facets, clear, travel: sweep.travel, way };
        let place = self.locate(pass, group, &mut candidates, sweep, extra);
        chunk.wakes[index] = match place {
            Place::Away => {
                let placed = Placed { surface: &self.surfaces[pass.target], positions: sweep.new };
                candidates.bound(&placed, sweep.new[group.node as usize], asleep)
            }
            _ => AWAKE,
        };
        group.known.touches = false;
        if let Place::Touches(projection, side, is_led) = place {
            group.known.touches = true;
            (group.known.memory.side, group.known.memory.is_led) = (side, is_led);
            found.deepest = found.deepest.max(-projection.gap);
            let Group { slave, node, own, .. } = *group;
            found.touches.push(ContactPoint { pass: number as u32, slave, node, projection, own, group: (first + index) as u32 });
        } else {
            group.known.memory = ContactHistory::default();
        }
    }

    /// Whether a node touches: its projection, and the side from which it came in.
    fn locate(&self, pass: &Pass, group: &Group<Known>, candidates: &mut Candidates<'_>, sweep: Sweep<'_, 3>, extra: f64) -> Place {
        let placed = Placed { surface: &self.surfaces[pass.target], positions: sweep.new };
        let x = sweep.new[group.node as usize];
        let facing = if group.own { Some(self.own_normal(pass.slave, group.slave, sweep.new)) } else { None };
        let faces = |facet: u32| facing.is_none_or(|own| dot(own, placed.facet_normal(facet)) < FACING);
        let passages =
            |candidates: &Candidates<'_>| Passages::of(&placed, sweep, group.node, candidates.in_passage().filter(|&facet| faces(facet)));
        let ContactHistory { facet: likely, side: before, is_led: was_led, .. } = group.known.memory;
        let was_inside = before != [0.0; 3];
        let side = if was_inside { before } else { passages(candidates).fate(before).side };
        let came = side != [0.0; 3];
        let sees = |facet: u32| faces(facet) && (!came || dot(side, placed.facet_normal(facet)) > SAME_SIDE);
        let mut found = candidates.nearest(&placed, x, likely, sees).and_then(|found| placed.seen(x, found));
        let is_inside = found.is_some_and(|found| found.gap < 0.0);
        // Who comes in now; and who was inside and seems to be out, but went through the far side.
        let mut may_lead = came && !was_inside;
        if was_inside && (was_led || !is_inside) {
            let fate = passages(candidates).fate(side);
            may_lead = fate.is_through || (was_led && fate.side != [0.0; 3]);
        }
        if may_lead && let Some((led, along)) = led(candidates, &placed, x, side, found.as_ref(), (likely, &faces)) {
            return Place::Touches(led, along, true);
        }
        // Who continues with its face needs no second look.
        let continues = |found: &Projection| group.known.touches && dot(group.known.memory.spring.normal, found.normal) > SAME_FACE;
        if !group.own && !found.as_ref().is_some_and(continues) {
            let own = self.own_normal(pass.slave, group.slave, sweep.new);
            if found.is_none_or(|found| dot(own, found.normal) >= FACING) {
                let faces = |facet: u32| dot(own, placed.facet_normal(facet)) < FACING;
                let over = candidates.nearest(&placed, x, likely, |facet| sees(facet) && faces(facet));
                let over = over.and_then(|over| placed.seen_over(x, over, faces));
                let is_flush = found.is_some_and(|found| found.gap.abs() <= FLUSH * self.reach.skin);
                // No face before which it is leads it out of a body into which it has gone.
                let may_hold = |over: &Projection| !(may_lead && is_inside) || is_flush || over.gap < 0.0;
                let over = over.filter(|over| may_hold(&over.0) && self.is_held(pass, group, side, sweep, over, is_flush));
                found = over.map(|(over, _)| over).or(found);
            }
        }
        let Some(found) = found else { return Place::Away };
        if found.gap < 0.0 {
            // In its own body only who was seen to come in, or was just before it.
            let known = came || (group.known.touches && dot(group.known.memory.spring.normal, found.normal) > SAME_SIDE);
            return match known {
                false if group.own => Place::Away,
                false if -found.gap > self.radius - self.reach.skin => Place::Lost,
                _ => Place::Touches(found, found.normal, false),
            };
        }
        let near = extra + START * self.reach.skin + LOOK_AHEAD * motion(&placed, &found, sweep, group.node);
        let is_near = found.gap <= near.min(self.radius - self.reach.skin).max(extra);
        if is_near { Place::Touches(found, [0.0; 3], false) } else { Place::Away }
    }

    /// Whether a face holds a node that is over its rim or beyond it, by the projection and the way from the
    /// rim: `side` is the one from which it came, `is_flush` says whether it lies on the body's surface
    /// within rounding.
    fn is_held(
        &self,
        pass: &Pass,
        group: &Group<Known>,
        side: Vector,
        sweep: Sweep<'_, 3>,
        (over, beyond): &(Projection, Vector),
        is_flush: bool,
    ) -> bool {
        let target = &self.surfaces[pass.target];
        let (placed, before) = (Placed { surface: target, positions: sweep.new }, Placed { surface: target, positions: sweep.old });
        let way = length(*beyond);
        if way > (BAND * placed.size(over.facet)).min(self.band) || -over.gap > self.radius - self.reach.skin {
            return false;
        }
        let held =
            dot(side, over.normal) > SAME_FACE || (group.known.touches && dot(group.known.memory.spring.normal, over.normal) > SAME_FACE);
        let from_the_front = || {
            let [a, b, c] = before.triangle(over.facet, over.triangle);
            let height = dot(minus(sweep.old[group.node as usize], a), cross(minus(b, a), minus(c, a)));
            over.gap >= 0.0 || height >= 0.0
        };
        (held || is_flush || from_the_front()) && (way == 0.0 || self.goes_back(pass, group, *beyond, sweep.new))
    }

    /// Whether the surface of a slave goes from it back over the face that it is beyond by a way.
    fn goes_back(&self, pass: &Pass, group: &Group<Known>, beyond: Vector, positions: &[Vector]) -> bool {
        let slaves = &self.surfaces[pass.slave];
        let x = positions[group.node as usize];
        slaves.around(group.slave as usize).iter().flat_map(|&facet| slaves.facets[facet as usize]).any(|other| {
            let along = minus(positions[other as usize], x);
            // More than the rim's own direction, as far as rounding can resolve.
            dot(along, beyond) < -0.05 * length(along) * length(beyond)
        })
    }

    /// Normal of a slave at its own surface.
    pub(in crate::contact) fn own_normal(&self, surface: usize, slave: u32, positions: &[Vector]) -> Vector {
        let (facet, corner) = self.corners[surface][slave as usize];
        let (normal, _) = Placed { surface: &self.surfaces[surface], positions }.node_normal(facet, corner as usize);
        normal.map(|n| n / length(normal).max(f64::MIN_POSITIVE))
    }

    /// Keeps what is known of the past.
    pub(super) fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
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
        persist_each!(archive; &mut self.reach, &mut self.is_new, &mut self.radius, &mut self.found.deepest, &mut self.travel);
        Ok(())
    }

    /// Takes over what another one knew whose surfaces were those before they changed: of nodes that are
    /// still there.
    pub(super) fn inherit(&mut self, old: &Self) {
        for (pass, before) in self.passes.iter_mut().zip(&old.passes) {
            let touching = before.groups.iter().filter(|group| group.known.touches);
            pass.groups = Group::moved(touching, &self.surfaces[pass.slave].nodes);
            // Facets have other numbers now.
            pass.groups.iter_mut().for_each(|group| (group.known.memory.facet, group.known.memory.rest) = (NONE, [NONE; 2]));
            pass.wakes = vec![AWAKE; pass.groups.len()];
        }
        self.is_new = old.is_new;
        (self.travel, self.found.deepest) = (old.travel, old.found.deepest);
        self.reach.inherit(&old.reach);
    }
}

/// How far a node and where it projects have moved with respect to each other in the step, m.
fn motion(placed: &Placed<'_>, found: &Projection, sweep: Sweep<'_, 3>, node: u32) -> f64 {
    let moved = |node: u32| minus(sweep.new[node as usize], sweep.old[node as usize]);
    let facet = placed.surface.facets[found.facet as usize];
    let mut way = moved(node);
    for (corner, weight) in facet.into_iter().zip(found.weights) {
        let by = moved(corner);
        (0..3).for_each(|d| way[d] -= weight * by[d]);
    }
    length(way)
}
