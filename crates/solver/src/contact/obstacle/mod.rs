//! Nodes against a rigid obstacle: a spring for each node that is behind its surface, or soon may be. One
//! shape a file.
//!
//! The shape lives in the frame of its rigid body; positions come from the step. Reactions go to the body.
//! What is swept is the way of a node as the body sees it: straight between where the node was seen before
//! the step and where it is seen after it.

pub mod behind;
pub mod circle;
mod far;
pub mod plane;
pub mod points;
pub mod space;

use super::findings::Findings;
use super::initial::{kept, moved_by, pressing};
use super::law::penalty::stiffening;
use super::slaves::Slave;
use super::springs::{Answers, End, Slip, Spring, Springs, Stiffening};
use super::tracker::{Certificate, SearchReport};
use super::{Formulation, Origins, Scene, Standing, Vector};
use crate::archive::{Archive, ArchiveError, ArchiveResult, Persist, persist_all, persist_each};
use crate::contact::springs::TangentSpace;
use crate::model::in_3d;
use crate::outline::Outline;
use crate::rigid::Bodies;
use crate::tensor::Dim;
use crate::vector::{bound_of, dot, plus, times};
use behind::{Behind, Thick};
use std::any::Any;

/// Shape of an obstacle in the frame of its body.
pub trait Shape: Send + Sync {
    /// Gap (m, negative inside) and unit normal along which a node is pushed out; `None` where it does not
    /// meet the obstacle.
    fn meet(&self, way: Way, memory: &mut ContactHistory) -> Option<(f64, Vector)>;

    /// Depth of the place of a segment that is deepest in it, m (negative outside), and that place, if that
    /// may be between its ends.
    fn deepest(&self, _: &[Vector]) -> Option<(f64, Vector)> {
        None
    }

    /// Its radius, if it is round and whole, m.
    fn radius(&self) -> Option<f64> {
        None
    }
}

/// Way of a node in the step, as the body sees it, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// At the beginning.
    pub from: Vector,
    /// At the end, where it is now.
    pub to: Vector,
}

/// What an obstacle remembers of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactHistory {
    /// Where the node is.
    pub state: State,
    /// Whether its spring pushed in the last update.
    pub presses: bool,
    /// Normal along which it is held, in the frame of the body.
    pub normal: Vector,
    /// Gap that counts as zero, m.
    pub offset: f64,
    /// Gap of its spring in the last step, m; not a number: not known.
    pub gap: f64,
}

impl Default for ContactHistory {
    fn default() -> Self {
        Self { state: State::default(), presses: false, normal: Vector::default(), offset: 0.0, gap: f64::NAN }
    }
}

/// Where a node is with respect to an obstacle that has another side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// Not looked at yet.
    #[default]
    Unknown,
    /// On the free side.
    Free,
    /// On the free side, but so fast that it may go through within the next step.
    Ahead,
    /// Inside: it came in through the surface.
    Held,
    /// Beyond, without having gone through the surface.
    Behind,
}

/// In the order of their numbers in a kept state.
const STATES: [State; 5] = [State::Unknown, State::Free, State::Ahead, State::Held, State::Behind];

/// Outline of an obstacle in the frame of its body.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlineShape<const D: usize> {
    /// Name of the obstacle.
    pub name: String,
    /// Its rigid body.
    pub body: usize,
    /// From point to point, the solid on the right, m.
    pub points: Vec<[f64; D]>,
    /// In 3D: facets of it, outward; a triangle repeats its last point.
    pub facets: Vec<[u32; 4]>,
    /// Until when it acts, s.
    pub death: f64,
}

impl<const D: usize> OutlineShape<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Where it is now, at this time.
    #[must_use]
    pub fn now(&self, bodies: &Bodies<D>, time: f64) -> Outline {
        let body = bodies.state(self.body);
        let place = |&point: &[f64; D]| in_3d(body.place(point));
        Outline {
            name: self.name.clone(),
            points: self.points.iter().map(place).collect(),
            facets: self.facets.clone(),
            is_gone: time >= self.death,
        }
    }
}

/// How nodes meet an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// What is within this distance gets a spring, m: a fraction of the nodes' spacing and the reach of the
    /// law.
    pub reach: f64,
    /// By what factor springs stiffen.
    pub factor: f64,
    /// Whether gaps that are negative when it begins to act count as zero until the surfaces part.
    pub ignores_start: bool,
}

/// Nodes against an obstacle.
pub struct NodeObstacle {
    shape: Box<dyn Shape>,
    /// Number of its rigid body.
    body: usize,
    nodes: Vec<(u32, Slave)>,
    /// Their elastic slips at n − ½, m.
    slips: Vec<f64>,
    /// Where their springs stiffen, and the thickness of their bodies there at the start, m.
    walls: Vec<(Stiffening, f64)>,
    memories: Vec<ContactHistory>,
    /// Whether elements were made again since the last step.
    is_new: bool,
    /// Nodes within this distance get a spring, m.
    reach: f64,
    /// Whether gaps that are negative when it begins to act count as zero.
    ignores_start: bool,
    has_begun: bool,
    /// Indices of the nodes with springs in this step.
    found: Vec<u32>,
    near: Near,
    behind: Behind<2>,
    /// Whether segments may be deep in it between their nodes.
    sees_facets: bool,
}

/// Nodes that an obstacle has to look at in each step. The others are farther from it than they can come
/// before the next look at all.
#[derive(Default)]
struct Near {
    /// Their indices.
    indices: Vec<u32>,
    /// Way of the scene at the last look at all, m; `None`: there was none.
    since: Option<f64>,
    /// Where the body was then.
    place: (f64, Vector),
}

impl Near {
    /// Nodes may go this far between two looks at all, in multiples of the reach.
    const WAY: f64 = 1.0;
    /// Gap beyond which a node is not near, in multiples of the reach. A gap changes by the way at most, and
    /// the reach grows with four times the sum of both components of a step, which is less than six times the
    /// way.
    const GAP: f64 = 1.0 + 8.0 * Self::WAY;

    /// Whether the far nodes are still far.
    fn holds(&self, scene: &Scene<'_, 2>, place: (f64, Vector), reach: f64) -> bool {
        self.place == place && self.since.is_some_and(|since| scene.sweep.travel - since < Self::WAY * reach)
    }
}

impl NodeObstacle {
    /// For `nodes` of `bodies` in their initial places.
    #[must_use]
    pub fn new(shape: Box<dyn Shape>, body: usize, nodes: Vec<(u32, Slave)>, manner: Manner, bodies: Box<dyn Thick<2>>) -> Self {
        let Manner { reach, factor, ignores_start } = manner;
        let (memories, slips) = (vec![ContactHistory::default(); nodes.len()], vec![0.0; nodes.len()]);
        let thickness = shape.radius().map_or(f64::INFINITY, |radius| 2.0 * radius);
        let wall = |thickness: f64| (stiffening(thickness, factor), thickness);
        let walls = nodes.iter().map(|&(node, _)| wall(bodies.at(node).min(thickness))).collect();
        let (behind, found, near) = (Behind::new(bodies, thickness), Vec::new(), Near::default());
        let sees_facets = !ignores_start && shape.radius().is_some_and(|radius| behind.may_be_between(radius));
        let (has_begun, is_new) = (false, false);
        Self { shape, body, memories, is_new, nodes, slips, walls, reach, ignores_start, has_begun, found, near, behind, sees_facets }
    }
}

persist_all!(Near { indices, since, place });

impl Persist for ContactHistory {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { state, presses, normal, offset, gap } = self;
        let mut number = STATES.iter().position(|it| it == state).unwrap_or(0) as u8;
        persist_each!(archive; &mut number, presses, normal, offset, gap);
        *state = *STATES.get(usize::from(number)).ok_or_else(|| ArchiveError::new("a node is neither before nor behind an obstacle"))?;
        Ok(())
    }
}

impl Formulation<2> for NodeObstacle {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        self.found.clear();
        self.behind.begin();
        let body = scene.bodies.state(self.body);
        let at = (scene.sweep.new.len() + self.body) as u32;
        let place = (body.angle, body.centre);
        let looks_at_all = !self.near.holds(scene, place, self.reach);
        if looks_at_all {
            (self.near.since, self.near.place) = (Some(scene.sweep.travel), place);
            self.near.indices.clear();
            self.near.indices.extend(0..self.nodes.len() as u32);
        }
        // Of a look at all, those that stay near; at first what moved is not known.
        let (mut count, has_begun) = (0, self.has_begun);
        for k in 0..self.near.indices.len() {
            let index = self.near.indices[k] as usize;
            let ((node, slave), memory) = (self.nodes[index], &mut self.memories[index]);
            let x = scene.sweep.new[node as usize];
            let way = Way { from: body.to_local_old(scene.sweep.old[node as usize]), to: body.to_local(x) };
            let met = self.shape.meet(way, memory);
            if looks_at_all && !(has_begun && met.is_some_and(|(gap, _)| gap > Near::GAP * self.reach)) {
                self.near.indices[count] = index as u32;
                count += 1;
            }
            let pressed = std::mem::replace(&mut memory.presses, false);
            let Some((gap, normal)) = met else {
                (memory.offset, memory.gap) = (0.0, f64::NAN);
                continue;
            };
            let moved = [way.to[0] - way.from[0], way.to[1] - way.from[1]];
            if self.is_new {
                memory.offset = moved_by(memory.gap, gap - dot(normal, moved));
            }
            if self.ignores_start || memory.offset != 0.0 {
                memory.offset = kept(self.has_begun, memory.offset, gap);
            }
            let gap = gap - memory.offset;
            memory.gap = gap;
            // Who comes from behind, or past a corner, has pressed no spring that could give anything back.
            if gap >= 0.0 && !pressed && normal[0] * moved[0] + normal[1] * moved[1] > 2.0 * gap {
                continue;
            }
            let (stiffening, initial) = self.walls[index];
            self.behind.see(node, -gap, initial, dot(moved, moved).sqrt(), scene);
            // Well before it touches: a spring that closes unseen would give back what it never took.
            if gap <= self.reach + 4.0 * bound_of(moved) {
                let Slave { stiffness, area, .. } = slave;
                let ends = [End::node(node, 1.0), End { at, share: -1.0, point: x, ..End::default() }];
                springs.push(
                    Spring { normal: body.to_global(normal), gap, stiffness, area, stiffening, side: 1.0, ..Spring::default() },
                    Slip::of([self.slips[index]]),
                    &ends,
                );
                self.found.push(index as u32);
            }
        }
        if looks_at_all {
            self.near.indices.truncate(count);
        }
        if self.sees_facets {
            self.behind.see_facets(body, |ends| self.shape.deepest(ends), scene);
        }
        self.behind.end();
        (self.has_begun, self.is_new) = (true, false);
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            shape: _, body: _, walls: _, reach: _, ignores_start: _, found: _, sees_facets: _,
            nodes, slips, memories, is_new, has_begun, near, behind,
        } = self;
        persist_each!(archive; &mut slips[..], &mut memories[..], is_new, has_begun, near);
        behind.persist(archive)?;
        archive.check(near.indices.iter().all(|&index| (index as usize) < nodes.len()), "an obstacle looks at nodes that are not there")
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        self.has_begun = old.has_begun;
        self.behind.inherit(&old.behind);
        self.is_new = old.is_new;
        for (((node, _), slip), memory) in self.nodes.iter().zip(&mut self.slips).zip(&mut self.memories) {
            if let Ok(at) = old.nodes.binary_search_by_key(node, |&(node, _)| node) {
                (*slip, *memory) = (old.slips[at], old.memories[at]);
            }
        }
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, 2>) {
        let Some(old) = old.downcast_ref::<Self>() else { return };
        (self.has_begun, self.is_new) = (old.has_begun, true);
        self.behind.inherit(&old.behind);
        let place = |node: u32| old.nodes.binary_search_by_key(&node, |&(node, _)| node).ok();
        let by_area = |slave: &Slave| slave.stiffness / slave.area;
        for (((node, slave), slip), memory) in self.nodes.iter().zip(&mut self.slips).zip(&mut self.memories) {
            let near = || origins.nodes[*node as usize].iter().filter_map(|&(node, share)| Some((place(node)?, share)));
            *slip = near().map(|(at, share)| share * old.slips[at]).sum();
            // On which side it is, as the nearest of them.
            if let Some((at, _)) = near().reduce(|most, own| if own.1 > most.1 { own } else { most }) {
                let gap = near().map(|(at, share)| share * old.memories[at].gap).sum();
                let by_areas = [near().map(|(at, share)| share * by_area(&old.nodes[at].1)).sum(), by_area(slave)];
                *memory = ContactHistory { offset: 0.0, gap: pressing(gap, by_areas), ..old.memories[at] };
            }
        }
    }

    fn fitted(&self, between: &[(u32, f64)], place: Vector, now: &Standing<'_, 2>) -> Option<Vector> {
        // Chords cut what is round; on what is straight they are as deep as their ends.
        self.shape.radius()?;
        let known = |&(node, share): &(u32, f64)| {
            let at = self.nodes.binary_search_by_key(&node, |&(node, _)| node).ok()?;
            Some((share, &self.memories[at]))
        };
        let near: Vec<(f64, &ContactHistory)> = between.iter().filter_map(known).collect();
        let (_, nearest) = near.iter().reduce(|most, own| if own.0 > most.0 { own } else { most })?;
        let body = now.bodies.state(self.body);
        let x = body.to_local(place);
        let (gap, normal) = self.shape.meet(Way { from: x, to: x }, &mut (**nearest).clone())?;
        // Of open ones it is none, or not known.
        let of = |memory: &ContactHistory| memory.gap.min(0.0) + if self.ignores_start { memory.offset.min(0.0) } else { 0.0 };
        let allowed: f64 = near.iter().map(|(share, memory)| share * of(memory)).sum();
        let all_press = near.len() == between.len() && near.iter().all(|(_, memory)| memory.presses);
        (gap < allowed || all_press).then(|| plus(place, times(allowed - gap, body.to_global(normal))))
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        for (&index, answer) in self.found.iter().zip(solved) {
            self.slips[index as usize] = answer.slid().slip_new[0];
            self.memories[index as usize].presses = answer.solved.force != 0.0;
        }
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.behind.findings())
    }
}

/// Two formulations of one contact, one after the other.
pub struct Both {
    parts: [Box<dyn Formulation<2>>; 2],
    /// Springs of the first in this step.
    split: usize,
    /// What both found of overlaps.
    findings: Findings,
}

impl Both {
    /// From these two.
    #[must_use]
    pub fn new(parts: [Box<dyn Formulation<2>>; 2]) -> Self {
        Self { parts, split: 0, findings: Findings::default() }
    }

    fn find(&mut self) {
        let found = self.parts.iter().filter_map(|part| part.overlaps());
        self.findings = found.fold(Findings::default(), |sum, found| sum.with(found));
    }
}

impl Formulation<2> for Both {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        let begin = springs.list.len();
        let [first, second] = &mut self.parts;
        first.detect(scene, springs);
        self.split = springs.list.len() - begin;
        second.detect(scene, springs);
        self.find();
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // Where the second begins counts within a step.
        let Self { parts, split: _, findings: _ } = self;
        parts.iter_mut().try_for_each(|part| part.persist(archive))?;
        self.find();
        Ok(())
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            for (part, old) in self.parts.iter_mut().zip(old.parts) {
                part.inherit(old);
            }
        }
        self.find();
    }

    fn carry(&mut self, old: &dyn Any, origins: &Origins<'_, 2>) {
        if let Some(old) = old.downcast_ref::<Self>() {
            for (part, old) in self.parts.iter_mut().zip(&old.parts) {
                let old: &dyn Any = &**old;
                part.carry(old, origins);
            }
        }
        self.find();
    }

    fn fitted(&self, between: &[(u32, f64)], place: Vector, now: &Standing<'_, 2>) -> Option<Vector> {
        self.parts.iter().find_map(|part| part.fitted(between, place, now))
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(&self.findings)
    }

    fn certificate(&self) -> Certificate {
        let mut sum = self.parts[0].certificate();
        sum += self.parts[1].certificate();
        sum
    }

    fn search_report(&self) -> Option<SearchReport> {
        self.parts.iter().find_map(|part| part.search_report())
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        // Nothing is found, and nothing solved, while the contact does not act.
        self.parts[0].remember(solved.part(0, self.split));
        self.parts[1].remember(solved.part(self.split, usize::MAX));
    }
}
