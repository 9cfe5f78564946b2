//! Contact: search, projection, springs and forces, all on the same configuration.
//!
//! Sees surfaces, positions and stiffnesses; knows nothing of elements and materials. A [`Contact`] is a
//! [`Formulation`] (what it makes springs of) and what the springs sum up to; laws and friction are in the
//! [`springs::Terms`] whose number it has. [`Contact::detect`] finds the springs of the step,
//! [`springs::Springs::solve`] the forces of all contacts and obstacles together, [`Contact::collect`] what
//! they sum up to.

pub mod search;
pub(crate) mod messages;
pub mod projection;
pub mod tracker;
pub mod initial;
pub mod law;
pub mod springs;
mod spin;
pub mod formulation;
pub mod edge_edge;
pub mod node_facet;
pub mod node_segment;
pub mod pinball;
pub mod missed_contacts;
pub mod segment;
pub mod slaves;
pub mod tied;
pub mod obstacle;
pub mod connection;
pub mod findings;
mod boxes;
pub mod overlap;
pub mod depths;
pub mod outline;
pub mod continuity;
pub mod checked;
pub mod mirror;
pub mod traces;
pub(crate) mod rebuild;

use crate::archive::{Archive, ArchiveResult, persist_each};
use crate::contact::springs::TangentSpace;
use crate::contact_forces::ContactForces;
use crate::mesh::surface::tributary::{self, Depth};
use crate::mesh::surface::{Corners, Facet, Sided};
use crate::model::Window;
use crate::rigid::{Bodies, RigidMotion};
use crate::tensor::Dim;
use crate::vector::{self, minus};
use connection::Connected;
use findings::{CAST, Findings, Overlap};
use springs::{Answer, Answers, Springs, Totals};
use std::any::Any;
use std::ops::Range;
use tied::{Beside, Held, Ties};
use traces::Traces;
use tracker::{Certificate, SearchReport};

/// A vector in 2D.
pub type Vector = [f64; 2];

/// What makes springs of surfaces: nodes against segments, segments against segments, pinballs, nodes against
/// obstacles.
pub trait Formulation<const D: usize>: Any + Send + Sync
where
    Dim<D>: TangentSpace<D>,
{
    /// Adds the springs of the step: of everything that is inside or may come in during the next update, so
    /// that a spring is there before it is needed (one that closes unseen would give back what it never
    /// took).
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>);

    /// Keeps what the next step needs of the solved springs, in the order of [`Formulation::detect`].
    fn remember(&mut self, solved: Answers<'_, D>);

    /// Keeps what it knows of the past.
    ///
    /// # Errors
    /// What is read is of other surfaces.
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult;

    /// Takes over what its predecessor knew, which was of the same kind and made of the same contact before
    /// surfaces changed. What belongs to nodes and segments that are no more is forgotten.
    fn inherit(&mut self, old: Box<dyn Any>);

    /// Takes over what its predecessor knew of the places where its surfaces are now: elements were made
    /// again, and numbers have changed. The rest is forgotten.
    fn carry(&mut self, _old: &dyn Any, _origins: &Origins<'_, D>) {}

    /// Where a new node has to be instead of this place of a surface, m, between some nodes with these
    /// shares: as deep as their springs are, if all of them press, and no deeper else. By being made it must
    /// neither come in nor leave. `None`: it may be there.
    fn fitted(&self, between: &[(u32, f64)], place: [f64; D], now: &Standing<'_, D>) -> Option<[f64; D]> {
        self.within()?.fitted(between, place, now)
    }

    /// The formulation that it stands around, if it does: what is asked for and not answered below is that
    /// one's.
    fn within(&self) -> Option<&dyn Formulation<D>> {
        None
    }

    /// Energy of springs that broke in the last step and will not come back, J/m.
    fn freed(&self) -> f64 {
        self.within().map_or(0.0, |within| within.freed())
    }

    /// Energy of springs that were closed in the step before and were not found by the last
    /// [`Formulation::detect`], because what they pushed on has left the surface, J/m. What goes with
    /// surfaces that are no more is not among it.
    fn lost_contact_energy(&self) -> f64 {
        self.within().map_or(0.0, |within| within.lost_contact_energy())
    }

    /// Its ties, if it has such.
    fn ties(&self) -> Option<Ties> {
        self.within()?.ties()
    }

    /// What its ties hold, if it has such.
    fn held(&self) -> Option<&Held> {
        self.within()?.held()
    }

    /// How its springs end at what ties of others hold.
    fn beside(&self) -> Beside {
        self.within().map_or(Beside::Nodes, |within| within.beside())
    }

    /// Lets go of nodes without elements; of what is made again when surfaces change there is nothing to do.
    fn lose(&mut self, _has_elements: &dyn Fn(u32) -> bool) {}

    /// What it transmits, if it is a connection at a point.
    fn connected(&self) -> Option<Connected> {
        None
    }

    /// What was checked so far, and whether a contact was missed; without [`Formulation::overlaps`].
    fn certificate(&self) -> Certificate {
        self.within().map(|within| within.certificate()).unwrap_or_default()
    }

    /// What the global search did, if there is one.
    fn search_report(&self) -> Option<SearchReport> {
        self.within()?.search_report()
    }

    /// What was found of overlaps of the bodies, if they are looked at.
    fn overlaps(&self) -> Option<&Findings> {
        self.within()?.overlaps()
    }

    /// Nodes that were inside another body when the bodies were last looked at, and how deep, m.
    fn inside(&self) -> &[(u32, f64)] {
        self.within().map_or(&[], |within| within.inside())
    }

    /// The least local thickness of the bodies at the start, m; infinite: not known.
    fn thinnest(&self) -> f64 {
        self.within().map_or(f64::INFINITY, |within| within.thinnest())
    }
}

/// Where the nodes of a mesh whose elements were made again come from.
#[derive(Clone, Copy, Debug)]
pub struct Origins<'a, const D: usize> {
    /// Of each node the old nodes of the outline that it lies between, with their shares; none inside.
    pub nodes: &'a [Vec<(u32, f64)>],
    /// Where nodes are, m.
    pub positions: &'a [[f64; D]],
    /// Where the old nodes were at the same time, m.
    pub before: &'a [[f64; D]],
}

impl<const D: usize> Origins<'_, D> {
    /// The old node that a node is nearest to.
    #[must_use]
    pub fn nearest(&self, node: u32) -> Option<u32> {
        let between = self.nodes[node as usize].iter();
        between.reduce(|most, own| if own.1 > most.1 { own } else { most }).map(|&(from, _)| from)
    }

    /// Whether a node is an old one.
    #[must_use]
    pub fn is_as_before(&self, node: u32) -> bool {
        matches!(self.nodes[node as usize][..], [(_, 1.0)])
    }
}

/// Where everything is between two steps.
#[derive(Clone, Copy)]
pub struct Standing<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Of the nodes, m.
    pub positions: &'a [[f64; D]],
    /// Rigid bodies.
    pub bodies: &'a Bodies<D>,
}

/// What a step shows to contacts.
#[derive(Clone, Copy)]
pub struct Scene<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Paths of the nodes in the step that led here.
    pub sweep: Sweep<'a, D>,
    /// Rigid bodies.
    pub bodies: &'a Bodies<D>,
    /// Time, s.
    pub time: f64,
}

/// Positions at both ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Sweep<'a, const D: usize> {
    /// At the beginning, m.
    pub old: &'a [[f64; D]],
    /// At the end, m: the configuration on which all forces are evaluated.
    pub new: &'a [[f64; D]],
    /// Way that no node has exceeded since the start, m: ∑ dt max |v|. What is far sleeps until its partners
    /// may have come near.
    pub travel: f64,
}

impl<'a, const D: usize> Sweep<'a, D> {
    /// From `old` to `new`, with nothing known of how far nodes go: nothing sleeps.
    #[must_use]
    pub fn between(old: &'a [[f64; D]], new: &'a [[f64; D]]) -> Self {
        Self { old, new, travel: f64::INFINITY }
    }
}

/// Which section of the model file a contact belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactKind {
    /// Surfaces of deformable bodies or rigid parts.
    Contact,
    /// A rigid obstacle; carries the number of its rigid body.
    Obstacle(usize),
    /// A spot weld.
    Weld,
    /// A joint.
    Joint,
}

impl ContactKind {
    /// Word of the model file and of columns.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::Obstacle(_) => "obstacle",
            Self::Weld => "weld",
            Self::Joint => "joint",
        }
    }

    /// Whether it connects bodies at a point.
    #[must_use]
    pub fn is_connection(self) -> bool {
        matches!(self, Self::Weld | Self::Joint)
    }
}

/// A contact between surfaces, or between surfaces and an obstacle.
pub struct Contact<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Name.
    pub name: String,
    /// Where it stands in the model.
    pub kind: ContactKind,
    /// What the springs of the step sum up to: force on the first surface (of an obstacle: on the bodies),
    /// energy, work.
    pub totals: Totals<D>,
    /// Deepest penetration in the last evaluation, m.
    pub penetration: f64,
    /// Whether it pressed at any time so far.
    pub has_pressed: bool,
    /// What friction took until the last half step, J/m.
    pub friction_work: f64,
    formulation: Box<dyn Formulation<D>>,
    /// What was checked before its surfaces were gone.
    checked: Certificate,
    /// Number of the terms that its springs follow.
    terms: usize,
    /// When it acts.
    window: Window,
    /// Whether it leaves out what others tie.
    is_of_bodies: bool,
    /// Time of the last detection, s.
    time: f64,
    /// Where its springs of this step lie in the list of all.
    found: Range<usize>,
}

impl<const D: usize> Contact<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// A contact that has not acted yet. Its springs follow the terms number `terms`; it acts in a `window`
    /// of time.
    #[must_use]
    pub fn new(name: String, kind: ContactKind, formulation: Box<dyn Formulation<D>>, terms: usize, window: Window) -> Self {
        Self {
            name,
            kind,
            totals: Totals::default(),
            penetration: 0.0,
            has_pressed: false,
            friction_work: 0.0,
            formulation,
            checked: Certificate::default(),
            terms,
            window,
            is_of_bodies: false,
            time: 0.0,
            found: 0..0,
        }
    }

    /// The same of bodies: it leaves out what others tie.
    #[must_use]
    pub fn of_bodies(self) -> Self {
        Self { is_of_bodies: true, ..self }
    }

    /// What its ties hold, if it has such and acts all the time.
    pub(crate) fn held_all_the_time(&self) -> Option<&Held> {
        self.formulation.held().filter(|_| self.window.is_always())
    }

    /// Its springs of the step, if it leaves out what others tie.
    pub(crate) fn beside_ties(&self) -> Option<(Range<usize>, Beside)> {
        self.is_of_bodies.then(|| (self.found.clone(), self.formulation.beside()))
    }

    /// Keeps what it knows of the past; `springs` is how many there are in this step.
    ///
    /// # Errors
    /// What is read is of other surfaces.
    pub(crate) fn persist(&mut self, archive: &mut Archive<'_>, springs: usize) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            name: _, kind: _, terms: _, window: _, is_of_bodies: _,
            totals, penetration, has_pressed, friction_work, formulation, checked, time, found,
        } = self;
        persist_each!(archive; totals, penetration, has_pressed, friction_work, checked, time, &mut found.start, &mut found.end);
        archive.check(found.start <= found.end && found.end <= springs, "a contact has springs that are not there")?;
        formulation.persist(archive)
    }

    fn acts_at(&self, time: f64) -> bool {
        self.window.contains(time)
    }

    /// Notes that a stage begins at `now`, s. Returns the energy (J/m) of its springs where it acts no more.
    pub(crate) fn enter(&mut self, stage: usize, now: f64, springs: &Springs<D>) -> f64 {
        if !self.window.enter(stage, now) {
            return 0.0;
        }
        springs.answers(self.found.clone()).flat_map(|answer| answer.books().stored).sum()
    }

    /// When it begins to act and acts no more, as far as that is known, s.
    pub(crate) fn times(&self) -> [f64; 2] {
        self.window.times()
    }

    /// Adds the forces of its springs to `forces`, and to `bodies` those on what has no nodes.
    pub(crate) fn push(&self, springs: &Springs<D>, forces: &mut ContactForces<D>, bodies: &mut Bodies<D>) {
        springs.answers(self.found.clone()).for_each(|answer| answer.push(forces, bodies, &mut Totals::default()));
    }

    /// Adds the springs of the step to `springs`.
    pub fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        let first = springs.list.len();
        self.time = scene.time;
        if self.acts_at(scene.time) {
            self.formulation.detect(scene, springs);
        }
        self.found = first..springs.list.len();
        springs.close_group(self.terms);
    }

    /// Sums up the solved springs: adds their forces to `forces` and `bodies`, and what they did in the
    /// update of `time_step` (s) to `traces`.
    pub fn collect(
        &mut self,
        springs: &Springs<D>,
        forces: &mut ContactForces<D>,
        bodies: &mut Bodies<D>,
        traces: &mut Traces<D>,
        time_step: f64,
    ) {
        let answers = springs.answers(self.found.clone());
        let (sum, formulation) = (|| answers.clone().collect_into(forces, bodies, traces), &mut self.formulation);
        let remember = || formulation.remember(answers.clone());
        // Neither reads what the other one writes.
        let (found, ()) = both(sum, remember);
        (self.totals, self.penetration) = found;
        if self.kind.is_connection() {
            self.penetration = 0.0;
        }
        self.has_pressed |= self.totals.pressing > 0.0;
        self.friction_work += self.totals.lost.friction;
        let acts = self.acts_at(self.time);
        self.totals.lost.lost_contact_energy = if acts { self.formulation.lost_contact_energy() } else { 0.0 };
        let ends = acts && !self.acts_at(self.time + time_step);
        self.totals.lost.freed = if ends { answers.flat_map(|answer| answer.books().stored).sum() } else { self.formulation.freed() };
    }

    /// Continues with another formulation of the same kind, made of changed surfaces.
    pub fn renew(&mut self, formulation: Box<dyn Formulation<D>>) {
        let old = std::mem::replace(&mut self.formulation, formulation);
        self.formulation.inherit(old);
    }

    /// See [`Formulation::fitted`].
    pub(crate) fn fitted(&self, between: &[(u32, f64)], place: [f64; D], now: &Standing<'_, D>) -> Option<[f64; D]> {
        self.formulation.fitted(between, place, now)
    }

    /// Continues where a contact of the same model was before elements were made again.
    pub(crate) fn carry(&mut self, old: Self, origins: &Origins<'_, D>) {
        self.checked = old.certificate();
        (self.totals, self.penetration, self.has_pressed) = (old.totals, old.penetration, old.has_pressed);
        (self.friction_work, self.window, self.time) = (old.friction_work, old.window, old.time);
        let old: Box<dyn Any> = old.formulation;
        self.formulation.carry(&*old, origins);
    }

    /// Lets go of nodes without elements.
    pub fn lose(&mut self, has_elements: &dyn Fn(u32) -> bool) {
        self.formulation.lose(has_elements);
    }

    /// What it transmits, if it is a connection at a point.
    #[must_use]
    pub fn connected(&self) -> Option<Connected> {
        self.formulation.connected()
    }

    /// Acts no more: one of its surfaces is gone.
    pub fn end(&mut self) {
        self.checked = self.certificate();
        self.formulation = Box::new(Nothing);
    }

    /// Energy at n + ½ of the springs of the last step that have not broken, J/m.
    #[must_use]
    pub fn stored(&self, springs: &Springs<D>) -> f64 {
        let stored = |answer: Answer<'_, D>| answer.books().stored.iter().sum::<f64>();
        springs.answers(self.found.clone()).map(stored).sum::<f64>() - self.totals.lost.freed
    }

    /// Energy at n − ½ of the springs of this step, J/m.
    #[must_use]
    pub fn stored_before(&self, springs: &Springs<D>) -> f64 {
        springs.answers(self.found.clone()).map(|answer| answer.books().stored_before).sum()
    }

    /// Its ties, if it has such.
    #[must_use]
    pub fn ties(&self) -> Option<Ties> {
        self.formulation.ties()
    }

    /// What was checked so far, and whether a contact was missed.
    #[must_use]
    pub fn certificate(&self) -> Certificate {
        let mut sum = self.checked;
        sum += self.formulation.certificate();
        sum.unverified += self.overlaps().map_or(0, |found| found.unverified);
        sum
    }

    /// What was found of overlaps of the bodies, if they are looked at.
    #[must_use]
    pub fn overlaps(&self) -> Option<&Findings> {
        self.formulation.overlaps()
    }

    /// Nodes that were inside another body when the bodies were last looked at, and how deep, m.
    #[must_use]
    pub fn inside(&self) -> &[(u32, f64)] {
        self.formulation.inside()
    }

    /// The least local thickness of its bodies at the start, m; infinite: not known.
    #[must_use]
    pub fn thinnest(&self) -> f64 {
        self.formulation.thinnest()
    }

    /// How deep it is, m: the deepest of the last evaluation's penetration and of the overlaps that are deep
    /// enough for a volume spring in the last look, between bodies and in themselves.
    #[must_use]
    pub fn depth(&self) -> f64 {
        let found = self.overlaps().map_or([Overlap::default(); 2], |found| [found.now, found.own]);
        let deep = found.into_iter().filter(|overlap| overlap.ratio() > CAST).map(|overlap| overlap.depth);
        deep.fold(self.penetration, f64::max)
    }

    /// An overlap that is deeper than the body there is thick: one has gone through the other.
    #[must_use]
    pub fn gone_through(&self) -> Option<&Overlap> {
        self.overlaps()?.through.as_ref()
    }

    /// What the global search did, if there is one.
    #[must_use]
    pub fn search_report(&self) -> Option<SearchReport> {
        self.formulation.search_report()
    }

    /// Moment (N) of the forces that the last step's springs put on what is not the rigid body `body`, about
    /// its reference point.
    #[must_use]
    pub fn moment(
        &self,
        body: usize,
        bodies: &Bodies<D>,
        springs: &Springs<D>,
        positions: &[[f64; D]],
    ) -> <Dim<D> as RigidMotion<D>>::Spin {
        let centre = bodies.state(body).centre;
        let moment = |(answer, end): (Answer<'_, D>, springs::KeptEnd<'_, D>)| {
            let (on_body, point) = match positions.get(end.at as usize) {
                Some(&x) => (bodies.of_node(end.at) == Some(body), x),
                None => (end.at as usize - positions.len() == body, end.point()),
            };
            let force = if on_body { [0.0; D] } else { answer.force_on(&end) };
            Dim::<D>::moment(std::array::from_fn(|d| point[d] - centre[d]), force)
        };
        self.ends(springs).map(moment).fold(Dim::<D>::NO_SPIN, Dim::<D>::plus)
    }

    /// Hands over what each spring of the last step does at all but the first of its ends: that first end,
    /// the end, and the force (N/m) on what is at the first one. Ends are nodes, or the number of nodes +
    /// rigid body.
    pub(crate) fn each_end(&self, springs: &Springs<D>, mut see: impl FnMut(u32, u32, [f64; D])) {
        for answer in springs.answers(self.found.clone()) {
            let mut ends = answer.ends();
            let Some(first) = ends.next() else { continue };
            for end in ends {
                see(first.at, end.at, answer.force_on(&end).map(|force| 0.0 - force));
            }
        }
    }

    /// Hands over each spring of the last step: its ends, numbered as in [`Contact::each_end`], with the
    /// forces (N/m) on them.
    pub(crate) fn each_spring(&self, springs: &Springs<D>, mut see: impl FnMut(&[(u32, [f64; D])])) {
        let mut ends = Vec::new();
        for answer in springs.answers(self.found.clone()) {
            ends.clear();
            ends.extend(answer.ends().map(|end| (end.at, answer.force_on(&end))));
            see(&ends);
        }
    }

    /// Hands over the forces of the last step's springs of which [`Totals::resultant`] is the sum, with where
    /// they act.
    pub(crate) fn each_on_first(&self, springs: &Springs<D>, mut see: impl FnMut(u32, [f64; D])) {
        for (answer, end) in self.ends(springs).filter(|(_, end)| end.share > 0.0) {
            see(end.at, answer.force_on(&end).map(|force| f64::from(answer.spring.side) * force));
        }
    }

    /// Every end of the last step's springs, with its spring.
    fn ends<'a>(&self, springs: &'a Springs<D>) -> impl Iterator<Item = (Answer<'a, D>, springs::KeptEnd<'a, D>)> {
        springs.answers(self.found.clone()).flat_map(|answer| answer.ends().map(move |end| (answer, end)))
    }

    /// Sum of the sizes of the forces of the last step's springs on some nodes (ascending), N/m.
    #[must_use]
    pub fn force_on(&self, nodes: &[u32], springs: &Springs<D>) -> f64 {
        let forces = self.ends(springs).filter(|(_, end)| nodes.binary_search(&end.at).is_ok()).map(|(answer, end)| answer.force_on(&end));
        forces.map(|force| (1..D).fold(force[0] * force[0], |sum, d| sum + force[d] * force[d]).sqrt()).sum()
    }

    /// Slave nodes that are inside in the last step, with their depth, m.
    pub fn penetrations<'a>(&'a self, springs: &'a Springs<D>) -> impl Iterator<Item = (u32, f64)> + 'a {
        let found = if self.kind.is_connection() { 0..0 } else { self.found.clone() };
        let inside = springs.answers(found).filter(|answer| answer.solved.gap < 0.0);
        inside.filter_map(|answer| Some((answer.ends().next()?.at, -answer.solved.gap)))
    }
}

/// Stands in where a surface is gone.
struct Nothing;

impl<const D: usize> Formulation<D> for Nothing
where
    Dim<D>: TangentSpace<D>,
{
    fn detect(&mut self, _: &Scene<'_, D>, _: &mut Springs<D>) {}
    fn remember(&mut self, _: Answers<'_, D>) {}
    fn persist(&mut self, _: &mut Archive<'_>) -> ArchiveResult {
        Ok(())
    }
    fn inherit(&mut self, _: Box<dyn Any>) {}
}

/// Does both, at the same time within a pool of threads.
pub(crate) fn both<A: Send, B: Send>(one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
    if rayon::current_thread_index().is_some() { rayon::join(one, other) } else { (one(), other()) }
}

pub(crate) fn length(segment: [u32; 2], positions: &[Vector]) -> f64 {
    let [a, b] = segment.map(|node| positions[node as usize]);
    ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
}

/// What a node of a surface stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tributary {
    /// Area, m²/m; of an axisymmetric body m², all around.
    pub area: f64,
    /// Length, m; in 3D the area.
    pub length: f64,
    /// Mean pressure stiffness κ of the elements behind it, Pa/m.
    pub stiffness: f64,
    /// α m / (dt² A) by its mass and the first step, Pa/m; zero: not known.
    pub of_mass: f64,
}

/// What each node of a surface stands for, in the order of its nodes.
#[must_use]
pub fn tributaries<const D: usize>(
    surface: &impl Sided<Facet = Facet<D>>,
    pressure_stiffness: &[f64],
    positions: &[[f64; D]],
    depth: Depth,
) -> Vec<Tributary>
where
    Dim<D>: TangentSpace<D>,
{
    let mut sums = vec![Tributary::default(); surface.nodes().len()];
    for (&facet, &stiffness) in surface.facets().iter().zip(pressure_stiffness) {
        let [a, b] = [0, 1].map(|k| positions[facet.corners()[k] as usize]);
        for (node, share) in tributary::shares(depth, facet, positions) {
            if let Ok(at) = surface.nodes().binary_search(&node) {
                sums[at].area += share;
                sums[at].length += if D == 2 { 0.5 * vector::length(minus(b, a)) } else { share };
                sums[at].stiffness += share * stiffness;
            }
        }
    }
    for sum in &mut sums {
        sum.stiffness /= sum.area;
    }
    sums
}
