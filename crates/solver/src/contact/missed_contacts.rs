//! Proof that no contact between solids was missed: beside the trackers of nodes and edges, with a search of
//! its own, every pair of a node and a facet, and of two ridges, is swept in every step, and who goes into a
//! body has to be in contact with it.
//!
//! Surfaces, positions and touches come from the formulation ([`super::node_facet`]), counts go to the
//! [`Certificate`]. What is proven:
//!
//! - a node that goes through a facet of a body from its front (`node_facet/passage.rs`; of its own body only
//!   such as face it), and does not come out again by that side or beside it, is held on the side where it
//!   came in: else it is `unverified` in that step. So is one that was inside and goes through the far side
//!   of a thin body: that is no way out;
//! - a node that was inside a body and has no touch with it any more is outside by the nearest feature, else
//!   it is `unverified`;
//! - ridges that go through each other, so that both wedges open there, have a spring, or one of them has in
//!   the same line, or a node of theirs touches the other body: else they are.
//!
//! Pairs within the margin are searched; they are all until nodes have gone half of it (by the travel, ∑ dt
//! max |v|, that none exceeds), when they are searched again. A pair that was d apart at the travel T can't
//! have met before 2 (T' − T) > d: until then it sleeps, and counts as swept. What touches and continues
//! doing so was not missed, and is not swept.

use super::edge_edge::{Around, EdgeTouch, EdgeTracker};
use super::node_facet::groups::{Group, Meeting, bend, bodies_of, halves, mean_edge, nearest, renumbered};
use super::node_facet::passage::{ALONG, Outcome, Passages};
use super::node_facet::tracker::{ContactPoint, FACING, SAME_SIDE, Tracker};
use super::projection::edge_edge::{crossing, distance};
use super::projection::node_facet::{Placed, Vector};
use super::projection::swept::crossings;
use super::search::{Pair, Query, Search};
use super::tracker::Certificate;
use super::tracker::sleep::AWAKE;
use super::{Origins, Sweep};
use crate::archive::{Archive, ArchiveResult, persist_all, persist_each};
use crate::mesh::surface::{Corners, SpaceSurface};
use crate::tensor::dot;
use crate::vector::{length, minus};
use rayon::prelude::*;

/// How far is searched, as a fraction of the mean edge.
const MARGIN: f64 = 1.0;
/// The global search is asked for a little more than is needed: it may round.
const SLACK: f64 = 1.001;
/// Groups that one task looks at.
const CHUNK: usize = 512;
/// A sleeper wakes a little before it has to.
const EARLY: f64 = 1.0 - 1e-9;
/// Who is no farther before a facet than this fraction of its size is on it: what lies on a rim is reported
/// to be over it or beside it by rounding.
const FLUSH: f64 = 1e-6;
/// How well both ridges open where they go through each other.
const BETWEEN: f64 = 0.25;
/// Who is less deep than this fraction of a facet's size is on the surface, as far as rounding can resolve.
const ROUNDING: f64 = 1e-9;

/// What is known of a slave node and a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Known {
    /// Side on which it was inside after the last step; zero: it was not. Who was does not sleep.
    side: Vector,
}

persist_all!(Known { side });

/// Nodes of one surface against another one, or the same.
#[derive(Default)]
struct Pass {
    slave: usize,
    target: usize,
    triangles: Vec<[u32; 3]>,
    groups: Vec<Group<Known>>,
    /// Travel up to which each sleeps, m.
    wakes: Vec<f64>,
    /// By which each stands where it is ([`order_of`]); made again where it is empty.
    order: Vec<u64>,
    candidates: Vec<u32>,
}

/// The proof of one contact.
pub struct MissedContactCheck {
    passes: Vec<Pass>,
    bodies: Vec<u32>,
    search: Box<dyn Search<3>>,
    pairs: Vec<Pair>,
    edges: Option<EdgeTracker>,
    /// Travel up to which each pair of edges sleeps, m.
    wakes: Vec<f64>,
    /// Everything nearer was found by the last search, m.
    margin: f64,
    /// Travel at the last search, m; minus infinity before the first.
    searched: f64,
    /// Whether it is known who was inside in the last step.
    has_begun: bool,
    certificate: Certificate,
}

impl MissedContactCheck {
    /// For the passes (slave, target) of surfaces; `bodies` of each node of the model, `positions` the
    /// initial ones. `makes` a search, which is not that of the contact.
    #[must_use]
    pub fn new(
        surfaces: &[SpaceSurface],
        passes: &[(usize, usize)],
        bodies: &[u32],
        positions: &[Vector],
        with_edges: bool,
        makes: fn() -> Box<dyn Search<3>>,
    ) -> Self {
        let pass = |&(slave, target): &(usize, usize)| {
            let triangles = surfaces[target].facets.iter().flat_map(halves).collect();
            Pass { slave, target, triangles, ..Pass::default() }
        };
        Self {
            passes: passes.iter().map(pass).collect(),
            bodies: bodies_of(surfaces, bodies),
            search: makes(),
            pairs: Vec::new(),
            edges: with_edges.then(|| EdgeTracker::new(surfaces, bodies, makes())),
            wakes: Vec::new(),
            margin: MARGIN * mean_edge(surfaces, positions),
            searched: f64::NEG_INFINITY,
            has_begun: false,
            certificate: Certificate::default(),
        }
    }

    /// What was proven so far.
    #[must_use]
    pub fn certificate(&self) -> Certificate {
        self.certificate
    }

    /// Looks at a step after the trackers have, and before anything is noted of their touches.
    pub fn look_at(&mut self, tracker: &Tracker, edges: Option<&EdgeTracker>, sweep: Sweep<'_, 3>) {
        // At the start nothing is known of the past.
        let sweep = if self.has_begun { sweep } else { Sweep { old: sweep.new, ..sweep } };
        // What is not known counts as gone too far.
        if !(2.0 * (sweep.travel - self.searched) < EARLY * self.margin) {
            self.find(tracker.surfaces(), sweep);
        }
        let mut touches = tracker.touches();
        for number in 0..self.passes.len() {
            let count = touches.partition_point(|touch| touch.pass as usize <= number);
            let (own, rest) = touches.split_at(count);
            touches = rest;
            self.look_at_nodes(number, tracker, own, sweep);
        }
        if let (Some(own), Some(edges)) = (self.edges.take(), edges) {
            self.look_at_edges(&own, edges.touches(), tracker, sweep);
            self.edges = Some(own);
        }
        self.has_begun = true;
    }

    fn body(&self, node: u32) -> u32 {
        self.bodies.get(node as usize).copied().unwrap_or(u32::MAX)
    }

    /// Pairs again; what is known of nodes that are inside continues.
    fn find(&mut self, surfaces: &[SpaceSurface], sweep: Sweep<'_, 3>) {
        let way = |node: u32| length(minus(sweep.new[node as usize], sweep.old[node as usize]));
        for pass in &mut self.passes {
            let (slaves, target) = (&surfaces[pass.slave].nodes, &surfaces[pass.target]);
            let fastest = slaves.iter().chain(&target.nodes).map(|&node| way(node)).fold(0.0, f64::max);
            let reach = SLACK * (self.margin + bend(target, sweep.new));
            let query = Query { positions_old: sweep.old, positions_new: sweep.new, slaves, facets: &pass.triangles, reach };
            let placed = Placed { surface: target, positions: sweep.new };
            // Who ends beyond the margin may have gone through.
            let farthest = self.margin.max(2.0 * fastest);
            let body = |node: u32| self.bodies.get(node as usize).copied().unwrap_or(u32::MAX);
            let old = std::mem::take(&mut pass.groups);
            let mut old = old.iter().filter(|group| group.known.side != [0.0; 3]).peekable();
            pass.candidates.clear();
            pass.wakes.clear();
            pass.order.clear();
            // What is no number is not far from anything.
            let distance = |node: u32, facet: u32| placed.distance(sweep.new[node as usize], facet).unwrap_or(0.0);
            let is_near = |found: &f64| *found <= farthest;
            let meeting = Meeting { slaves, target, is_one: pass.slave == pass.target };
            meeting.each(
                &mut *self.search,
                &query,
                &mut self.pairs,
                body,
                |node, facet| Some(distance(node, facet)).filter(is_near),
                |[slave, node, there], facets| {
                    let (begin, mut clear) = (pass.candidates.len() as u32, f64::INFINITY);
                    pass.candidates.extend(facets.map(|(facet, apart)| {
                        clear = clear.min(apart);
                        facet
                    }));
                    let side = Group::known_of(&mut old, (slave, there)).map_or([0.0; 3], |known| known.side);
                    let (end, own) = (pass.candidates.len() as u32, body(node) == there);
                    pass.groups.push(Group { slave, node, body: there, begin, end, own, known: Known { side } });
                    // Who was outside and is farther than both can have gone did not meet anything.
                    let sleeps = side == [0.0; 3] && clear > 2.0 * fastest * SLACK;
                    pass.wakes.push(if sleeps { wake_at(clear, sweep.travel) } else { AWAKE });
                },
            );
        }
        if let Some(edges) = &mut self.edges {
            let near = [0.0; 2];
            edges.find(&Around {
                surfaces,
                sweep,
                is_new: false,
                radius: self.margin,
                skin: 0.25 * self.margin,
                near,
                extra: 0.0,
                open: 0.0,
            });
            self.wakes.clear();
            self.wakes.resize(edges.candidates(), AWAKE);
        }
        self.searched = sweep.travel;
    }

    /// Sweeps the nodes of a pass that do not sleep, `touches` are theirs.
    fn look_at_nodes(&mut self, number: usize, tracker: &Tracker, touches: &[ContactPoint], sweep: Sweep<'_, 3>) {
        let pass = &mut self.passes[number];
        if pass.order.len() != pass.groups.len() {
            pass.order.clear();
            pass.order.extend(pass.groups.iter().map(|group| order_of(group.key())));
        }
        let (bodies, has_begun) = (&self.bodies[..], self.has_begun);
        let Pass { slave, target, groups, wakes, order, candidates, .. } = pass;
        let step = Step { tracker, slave: *slave, target: *target, candidates, bodies, sweep, has_begun };
        // Within a pool of threads the groups are shared among them; counts have no order.
        let seen = if rayon::current_thread_index().is_some() && groups.len() > CHUNK {
            let chunks = (groups.par_chunks_mut(CHUNK), wakes.par_chunks_mut(CHUNK), order.par_chunks(CHUNK));
            let seen = chunks.into_par_iter().map(|chunk| step.look_at(chunk, touches));
            seen.reduce(Certificate::default, |mut sum, seen| {
                sum += seen;
                sum
            })
        } else {
            step.look_at((groups, wakes, order), touches)
        };
        self.certificate += seen;
        self.certificate.pairs_swept += candidates.len() as u64;
    }

    /// Sweeps the pairs of ridges that do not sleep.
    fn look_at_edges(&mut self, own: &EdgeTracker, touches: &[EdgeTouch], tracker: &Tracker, sweep: Sweep<'_, 3>) {
        let (surfaces, sides) = (tracker.surfaces(), own.sides());
        self.certificate.pairs_swept += own.candidates() as u64;
        for (number, edges) in own.pairs().enumerate() {
            if self.wakes[number] > sweep.travel {
                continue;
            }
            let nodes = [0, 1].map(|of| surfaces[sides[of]].edges[edges[of] as usize].nodes);
            let at = |positions: &[Vector]| nodes.map(|edge| edge.map(|node| positions[node as usize]));
            let (old, new) = (at(sweep.old), at(sweep.new));
            let apart = distance(new[0], new[1]);
            self.wakes[number] = wake_at(apart, sweep.travel);
            let way = |of: usize| (0..2).map(|k| length(minus(new[of][k], old[of][k]))).fold(0.0, f64::max);
            if apart > (way(0) + way(1)) * SLACK {
                continue;
            }
            let placed = [0, 1].map(|of| Placed { surface: &surfaces[sides[of]], positions: sweep.new });
            let [Some(first), Some(second)] = [0, 1].map(|of| placed[of].ridge(edges[of])) else { continue };
            if !(first.is_sharp() && second.is_sharp()) {
                continue;
            }
            let mut goes_through = false;
            for sign in [1.0, -1.0] {
                crossings(sign, old, new, |time, _| {
                    let then = [0, 1].map(|of| [0, 1].map(|k| [0, 1, 2].map(|d| (1.0 - time) * old[of][k][d] + time * new[of][k][d])));
                    let Some(found) = crossing(then[0], then[1]) else { return };
                    let found = if sign > 0.0 { found } else { found.turned() };
                    goes_through |= found.fits([&first, &second]).into_iter().all(|fit| fit >= BETWEEN);
                });
            }
            if goes_through && !self.is_held(edges, nodes, touches, tracker, sides) {
                self.certificate.unverified += 1;
            }
        }
    }

    /// Whether edges that went through each other are held: by a spring of theirs or of edges at their nodes,
    /// or by a node of theirs.
    fn is_held(&self, edges: [u32; 2], nodes: [[u32; 2]; 2], touches: &[EdgeTouch], tracker: &Tracker, sides: [usize; 2]) -> bool {
        let meets = |a: [u32; 2], b: [u32; 2]| a.iter().any(|node| b.contains(node));
        let by_edges =
            touches.iter().any(|touch| touch.edges == edges || (meets(touch.nodes[0], nodes[0]) && meets(touch.nodes[1], nodes[1])));
        let touches_body = |touch: &ContactPoint, of: usize| {
            let target = tracker.target(touch.pass);
            tracker.slave(touch.pass) == sides[of]
                && nodes[of].contains(&touch.node)
                && self.body(target.facets[touch.projection.facet as usize][0]) == self.body(nodes[1 - of][0])
        };
        by_edges || tracker.touches().iter().any(|touch| touches_body(touch, 0) || touches_body(touch, 1))
    }

    /// Keeps what was proven, and which pairs sleep.
    pub(super) fn persist(&mut self, archive: &mut Archive<'_>, surfaces: &[SpaceSurface]) -> ArchiveResult {
        let Self { passes, bodies: _, search: _, pairs: _, edges, wakes, margin: _, searched, has_begun, certificate } = self;
        for pass in passes {
            persist_each!(archive; &mut pass.groups, &mut pass.wakes, &mut pass.candidates);
            pass.order.clear();
            archive.check(pass.wakes.len() == pass.groups.len(), "a proof knows when others wake")?;
            let (slaves, facets) = (&surfaces[pass.slave].nodes, surfaces[pass.target].facets.len());
            let is_there = |group: &Group<Known>| group.is_there(slaves, pass.candidates.len());
            let are_there = pass.candidates.iter().all(|&facet| (facet as usize) < facets);
            archive.check(are_there && pass.groups.iter().all(is_there), "a proof follows nodes or facets that are not there")?;
        }
        persist_each!(archive; wakes, searched, has_begun, certificate);
        if let Some(edges) = edges {
            edges.persist(archive, surfaces)?;
            archive.check(wakes.len() == edges.candidates(), "a proof follows more or fewer edges than there are")?;
        }
        Ok(())
    }

    /// Continues with what another one knew whose surfaces were those before they changed to `surfaces`:
    /// counts, and who is inside. Pairs are searched again in the next step.
    pub(super) fn inherit(&mut self, old: &Self, surfaces: &[SpaceSurface]) {
        for (pass, before) in self.passes.iter_mut().zip(&old.passes) {
            let inside = before.groups.iter().filter(|group| group.known.side != [0.0; 3]);
            pass.groups = Group::moved(inside, &surfaces[pass.slave].nodes);
            pass.wakes = vec![AWAKE; pass.groups.len()];
            pass.order.clear();
        }
        (self.certificate, self.has_begun) = (old.certificate, old.has_begun);
    }

    /// The same before elements were made again: a node between some that were inside is inside. `bodies` of
    /// old nodes and of new ones.
    pub(super) fn carry(&mut self, old: &Self, surfaces: &[SpaceSurface], bodies: (&[u32], &[u32]), origins: &Origins<'_, 3>) {
        let bodies = renumbered(bodies.0, bodies.1, origins);
        for (pass, before) in self.passes.iter_mut().zip(&old.passes) {
            let inside = before.groups.iter().filter(|group| group.known.side != [0.0; 3]);
            let known = |others: &[(f64, &Group<Known>)]| nearest(others).map_or_else(Known::default, |own| own.known);
            pass.groups = Group::carried(inside, (&surfaces[pass.slave].nodes, &bodies), origins, known);
            pass.wakes = vec![AWAKE; pass.groups.len()];
            pass.order.clear();
        }
        (self.certificate, self.has_begun) = (old.certificate, old.has_begun);
    }
}

/// A step as all nodes of a pass see it.
struct Step<'a> {
    tracker: &'a Tracker,
    slave: usize,
    target: usize,
    candidates: &'a [u32],
    bodies: &'a [u32],
    sweep: Sweep<'a, 3>,
    /// Whether it is known who was inside in the last step.
    has_begun: bool,
}

impl Step<'_> {
    /// Sweeps those of some groups that do not sleep; `touches` are those of the pass, in the order of its
    /// groups.
    fn look_at(&self, (groups, wakes, order): (&mut [Group<Known>], &mut [f64], &[u64]), touches: &[ContactPoint]) -> Certificate {
        let Self { tracker, sweep, .. } = *self;
        let target = &tracker.surfaces()[self.target];
        let order_of = |touch: &ContactPoint| {
            let node = target.facets[touch.projection.facet as usize][0];
            order_of((touch.slave, self.bodies.get(node as usize).copied().unwrap_or(u32::MAX)))
        };
        let mut seen = Certificate::default();
        let (Some(&first), Some(&last)) = (order.first(), order.last()) else { return seen };
        let mut at = 0;
        for touch in &touches[touches.partition_point(|touch| order_of(touch) < first)..] {
            let own = order_of(touch);
            if own > last {
                break;
            }
            // Those before it have no touch.
            while order[at] < own {
                if !(wakes[at] > sweep.travel) {
                    self.look_at_one(&mut groups[at], &mut wakes[at], None, &mut seen);
                }
                at += 1;
            }
            if order[at] == own {
                self.look_at_one(&mut groups[at], &mut wakes[at], Some(touch), &mut seen);
                at += 1;
            }
            if at == order.len() {
                return seen;
            }
        }
        for at in at..order.len() {
            if !(wakes[at] > sweep.travel) {
                self.look_at_one(&mut groups[at], &mut wakes[at], None, &mut seen);
            }
        }
        seen
    }

    /// Sweeps a group with its touch, if it has one, unless it sleeps.
    #[inline(always)]
    fn look_at_one(&self, group: &mut Group<Known>, wake: &mut f64, touch: Option<&ContactPoint>, seen: &mut Certificate) {
        let Self { tracker, slave, sweep, .. } = *self;
        let side = touch.map_or([0.0; 3], |touch| tracker.kept(touch).side);
        let was = std::mem::replace(&mut group.known.side, side);
        let was_inside = was != [0.0; 3];
        if side != [0.0; 3] {
            // What is there at the start did not go in.
            seen.crossings_found += u64::from(!was_inside && self.has_begun);
            *wake = AWAKE;
            return;
        }
        if *wake > sweep.travel {
            return;
        }
        // Who continues with its face has not passed.
        if touch.is_some_and(|touch| dot(tracker.kept(touch).spring.normal, touch.projection.normal) > 0.0) {
            *wake = AWAKE;
            return;
        }
        let placed = Placed { surface: &tracker.surfaces()[self.target], positions: sweep.new };
        let candidates = &self.candidates[group.candidates()];
        let own = if group.own { tracker.own_normal(slave, group.slave, sweep.new) } else { [0.0; 3] };
        let (passages, clear) = sweep_through(group, candidates, &placed, own, sweep);
        let is_missed = is_missed(passages.fate(was), touch, sweep.new[group.node as usize], candidates, &placed);
        let is_lost = || {
            let left = was_inside && !group.own && touch.is_none();
            let nearest = if left { placed.project(sweep.new[group.node as usize], candidates.iter().copied()) } else { None };
            nearest.is_some_and(|nearest| nearest.gap < -ROUNDING * placed.size(nearest.facet))
        };
        seen.unverified += u64::from(is_missed || is_lost());
        *wake = if touch.is_some() { AWAKE } else { wake_at(clear, sweep.travel) };
    }
}

/// A number by which groups stand in their order: that of slaves, then of bodies.
fn order_of((slave, body): (u32, u32)) -> u64 {
    u64::from(slave) << 32 | u64::from(body)
}

/// The travel up to which what is `clear` (m) apart can't meet.
fn wake_at(clear: f64, travel: f64) -> f64 {
    let wake = travel + 0.5 * EARLY * clear;
    if wake < f64::INFINITY { wake } else { AWAKE }
}

/// Whether a node at x that went in, or through the far side, is neither held there nor came around the body,
/// before the face again by which it came in.
fn is_missed(fate: Outcome, touch: Option<&ContactPoint>, x: Vector, candidates: &[u32], placed: &Placed<'_>) -> bool {
    let Outcome { side, enters, is_through } = fate;
    let is_held = |touch: &ContactPoint| {
        let nearness = FLUSH * placed.size(touch.projection.facet);
        touch.projection.gap <= nearness && dot(side, touch.projection.normal) > SAME_SIDE
    };
    let is_before = || {
        let of_face = |facet: &u32| dot(side, placed.facet_normal(*facet)) > ALONG;
        let nearest = placed.nearest_of(x, candidates.iter().copied().filter(of_face));
        nearest.is_some_and(|nearest| placed.behind(x, nearest).is_none())
    };
    (enters || is_through) && !touch.is_some_and(is_held) && !is_before()
}

/// What a node did with the facets of a body in the step, and its distance from all of them at the end, m.
fn sweep_through(group: &Group<Known>, candidates: &[u32], placed: &Placed<'_>, own: Vector, sweep: Sweep<'_, 3>) -> (Passages, f64) {
    let way = |node: u32| length(minus(sweep.new[node as usize], sweep.old[node as usize]));
    let (own_way, mut passages, mut clear) = (way(group.node), Passages::default(), f64::INFINITY);
    for &facet in candidates {
        let apart = placed.distance(sweep.new[group.node as usize], facet).unwrap_or(0.0);
        clear = clear.min(apart);
        // What turns towards it later is looked at then.
        if group.own && dot(own, placed.facet_normal(facet)) >= FACING {
            continue;
        }
        let corners = placed.surface.facets[facet as usize];
        let fastest = corners.corners().iter().map(|&node| way(node)).fold(0.0, f64::max);
        if apart <= (own_way + fastest) * SLACK {
            passages.add(placed, sweep, group.node, (facet, 0));
        }
    }
    (passages, clear)
}
