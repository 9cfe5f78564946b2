//! Shells: elements of a mid surface whose nodes move and rotate, with layers of points through the
//! thickness.
//!
//! A kernel ([`ShellKernel`]; `line.rs`) knows positions and rotations of the nodes: it strains the layers in
//! the frame of the element and makes forces and moments of their stresses. Each layer is a point of the law
//! without stress across it ([`points::layer`]), so every law works, and its thickness follows the strain
//! across: heights of the layers and the section are those of the present thickness. Work of a step in rate
//! form: ½ (σ_old + σ_new):Δε times the volume of the layer half way.
//!
//! Nodes have the moment of inertia m α about every axis; α is chosen at the start such that membrane waves
//! alone set the stable step, which so does not depend on the thickness. An element that has failed neither
//! is strained nor pulls. Strips of a few batches go through strain, law and forces one after the other, so
//! that what passes between stays in the first-level cache.
//!
//! [`points::layer`]: crate::material::points::layer

mod advance;
mod as_block;
mod beam;
mod bound;
mod laws;
mod line;
mod local;
mod profile;
mod quad;
mod quad_full;
mod rate;
mod section;
mod surface;
mod triangle;

pub(super) use beam::Beam;
pub(super) use line::Line;
pub(super) use quad::Quad;
pub(super) use quad_full::Full;
pub(super) use triangle::Triangle;

use super::make::BlockInput;
use super::{Report, SHELL_VALUES, Through};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::material::points::{PointLaw, RESPONSE, Scratch};
use crate::material::variable::PLASTIC_STRAIN;
use crate::material::{Family, young_and_poisson};
use crate::stress_state::{rubber_sheet_modulus, sheet_modulus};
use crate::tensor::{Dim, Space, SymmetricTensor, Turn};
use crate::vector::{plus, times};
use embate_lanes::{BATCH, Batch, Indices, Lane, Moving, VectorSums};
use laws::{Held, LawOf, Laws, Stiffness};
use local::{LocalPoints, Pose};
use profile::Profile;
use section::Points as Section;
use std::sync::Mutex;

/// Batches that one task advances.
const CHUNK: usize = 32;
/// Batches that go through strain, law and forces together, so that what passes between stays near.
const STRIP: usize = 2;

/// A tensor of the layers.
type Tensor<const D: usize, L> = <Dim<D> as Space<D>>::Tensor<L>;

/// What is the same for all elements of a block.
#[derive(Clone, Debug)]
pub(super) struct Facts {
    section: Section,
    /// Of beams, whose thickness is the area of their cross-section.
    profile: Profile,
    family: Family,
    /// Whether K and µ of the law are those of an isotropic body; else they bound waves alone.
    is_isotropic: bool,
    /// Whether there is no stress out of the plane either (2D).
    is_plane_stress: bool,
    /// Whether x is the radius.
    is_axisymmetric: bool,
    /// Whether the law wants the volume ratio.
    needs_ratio: bool,
    /// Places in the history of a batch of λ across at each point (of λ² where it is also that out of the
    /// plane), and of λ out of the plane where that is another.
    ratios: Vec<[Option<usize>; 2]>,
    /// Batches of history of a batch of elements.
    width: usize,
    /// Components of a stress.
    components: usize,
    /// K and µ at rest, Pa.
    at_rest: [f64; 2],
    /// Modulus of a membrane, and shear moduli in the plane and across it, at rest, Pa; and whether they
    /// never change.
    moduli: [f64; 3],
    is_constant: bool,
    /// Whether its layers have laws of their own, and whether none of them grows stiffer than at rest.
    is_layered: bool,
    is_limited: bool,
    /// What holds patterns of hourglass in 3D.
    held: Held,
}

impl Facts {
    /// Thickness of a section about its middle with the moment of inertia that one has about the surface of
    /// the nodes: t √(1 + 12 o²) with the middle at o t.
    #[inline(always)]
    fn reach(&self) -> f64 {
        (1.0 + 12.0 * self.section.middle * self.section.middle).sqrt()
    }

    /// Bounds in the plane, across it and the cosine between both: 1 where the middle is beside the nodes.
    #[inline(always)]
    fn coupled<L: Lane>(&self, [plane, plate, cosine]: [L; 3]) -> [L; 3] {
        [plane, plate, if self.section.middle == 0.0 { cosine } else { L::splat(1.0) }]
    }

    /// Of points with a law, in plane strain or in 3D.
    fn new<K: ShellKernel<D>, const D: usize>(section: Section, laws: &Laws, is_plane_stress: bool) -> Self
    where
        Dim<D>: Space<D>,
    {
        let (family, at_rest) = (laws.first().family(), laws.stiffness());
        let mut facts = Self {
            section,
            profile: Profile::default(),
            family,
            is_isotropic: laws.all(|law| law.is_stiffest_at_rest() || law.family() == Family::Hyperelastic),
            is_plane_stress,
            is_axisymmetric: false,
            needs_ratio: !laws.all(|law| !law.needs_volume()) || family == Family::Hyperelastic,
            ratios: laws.ratios(),
            width: laws.width(),
            components: <K::Tensor as SymmetricTensor<f64>>::COMPONENTS,
            at_rest,
            moduli: [0.0; 3],
            is_constant: false,
            is_layered: false,
            is_limited: false,
            held: Held::isotropic(young_and_poisson(at_rest), at_rest[1]),
        };
        let moduli = |law: &dyn PointLaw| {
            let [bulk, shear] = law.stiffness();
            [facts.membrane_modulus(bulk, shear), shear, shear]
        };
        facts.moduli = laws.largest(moduli);
        facts.is_constant = laws.has_constant_stiffness();
        facts
    }

    /// The same of layers with laws of their own.
    fn layered<const D: usize>(self, laws: &Laws) -> Self {
        if D < 3 {
            return Self { is_layered: true, ..self };
        }
        let Stiffness { held, moduli, is_limited } = laws.measured(&self.section);
        Self { is_layered: true, held, moduli, is_limited, ..self }
    }

    /// Modulus of a membrane, Pa, from K and µ: E/(1 − ν²), in plane stress E; of laws whose K and µ bound
    /// waves alone K + 4µ/3.
    #[inline(always)]
    fn membrane_modulus<L: Lane>(&self, bulk: L, shear: L) -> L {
        if self.is_constant {
            return L::splat(self.moduli[0]);
        }
        if !self.is_isotropic {
            return bulk + L::splat(4.0 / 3.0) * shear;
        }
        if self.is_plane_stress { L::splat(9.0) * bulk * shear / (L::splat(3.0) * bulk + shear) } else { sheet_modulus(bulk, shear) }
    }

    /// Bound of [`Facts::membrane_modulus`] that stretched rubber stays below too.
    #[inline(always)]
    fn membrane_bound<L: Lane>(&self, bulk: L, shear: L) -> L {
        match self.family {
            Family::Hyperelastic if !self.is_plane_stress => rubber_sheet_modulus(bulk, shear),
            _ => self.membrane_modulus(bulk, shear),
        }
    }

    /// The shear modulus that Poisson's ratio is taken from: 0 makes it 1, which bounds that of any layer.
    #[inline(always)]
    fn contracting<L: Lane>(&self, shear: L) -> L {
        if self.is_layered { L::splat(0.0) } else { shear }
    }

    /// λ across of a point, and its product with that out of the plane, from the history of its batch.
    #[inline(always)]
    fn stretches<L: Lane>(&self, history: &[Batch], point: usize, at: usize) -> [L; 2] {
        let [Some(place), beside] = self.ratios[point] else { return [L::splat(1.0); 2] };
        let own = L::load(&history[place], at);
        match beside {
            Some(other) => [own, own * L::load(&history[other], at)],
            None if self.is_plane_stress => [own.sqrt(), own],
            None => [own, own],
        }
    }
}

/// An element of a shell at the start.
#[derive(Clone, Debug, Default)]
pub(super) struct Start {
    /// What the kernel keeps of it.
    state: Vec<f64>,
    /// Share of each corner in the mass by density and thickness, m (m²).
    areas: Vec<f64>,
    /// Volume of each layer, m² (m³).
    volumes: Vec<f64>,
    /// Inertia of a corner by its mass, m².
    inertia: f64,
}

/// Stresses, histories and responses of the layers of a batch of elements, point by point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layers<'a> {
    stress: &'a [Batch],
    history: &'a [Batch],
    response: &'a [Batch],
    /// Stress of the damping; empty: there is none.
    damped: &'a [Batch],
    /// Thickness at the start, m.
    thickness: &'a Batch,
    /// See [`Answer::flow`]: of the last step.
    flow: &'a [Batch; 3],
    /// Number of the first of these points in the history.
    first: usize,
}

impl Layers<'_> {
    /// λ across of a point, and its product with that out of the plane.
    #[inline(always)]
    fn stretches<L: Lane>(&self, facts: &Facts, point: usize, at: usize) -> [L; 2] {
        facts.stretches(self.history, self.first + point, at)
    }

    /// Present thickness, m.
    #[inline(always)]
    fn thickness_now<L: Lane>(&self, facts: &Facts, at: usize) -> L {
        let mut sum = L::splat(0.0);
        for (p, &weight) in facts.section.weights.iter().enumerate() {
            let [across, _] = self.stretches::<L>(facts, p, at);
            sum += L::splat(weight) * across;
        }
        L::load(self.thickness, at) * sum
    }

    /// Those of one point in the plane.
    #[inline(always)]
    fn plane(&self, facts: &Facts, number: usize) -> Self {
        let count = facts.section.count();
        Self {
            stress: &self.stress[number * count * facts.components..],
            history: self.history,
            response: &self.response[number * count * RESPONSE..],
            damped: if self.damped.is_empty() { self.damped } else { &self.damped[number * count * facts.components..] },
            thickness: self.thickness,
            flow: self.flow,
            first: number * count,
        }
    }

    /// Stress of a point with that of the damping, components of the dimension.
    #[inline(always)]
    fn stress_of<T: SymmetricTensor<L>, L: Lane>(&self, point: usize, at: usize) -> T {
        let own = T::load(&self.stress[point * T::COMPONENTS..][..T::COMPONENTS], at);
        if self.damped.is_empty() { own } else { own.plus(T::load(&self.damped[point * T::COMPONENTS..][..T::COMPONENTS], at)) }
    }
}

/// What the layers of a batch are to be strained by.
#[derive(Debug)]
pub(super) struct Strains<'a> {
    /// Strain increment, or b, of each point.
    strain: &'a mut [Batch],
    /// Volume ratio without that across.
    ratio: &'a mut [Batch],
    /// Rate: volume of the layer half way, with the thickness of the start. Hyperelastic: that at the start.
    volume: &'a mut [Batch],
    /// Stress of each point, to turn with the material, Pa, and how far it turns (where the law wants to
    /// know).
    stress: &'a mut [Batch],
    rotation: &'a mut [Batch],
    /// Thickness now, and at the start, m.
    thickness: [&'a Batch; 2],
    /// Time β of the damping in proportion to the stiffness over the step; 0: none.
    damping: f64,
    /// 1: it is there.
    live: &'a Batch,
}

impl Strains<'_> {
    /// Those of one point in the plane.
    #[inline(always)]
    fn plane(&mut self, facts: &Facts, number: usize) -> Strains<'_> {
        let (count, components) = (facts.section.count(), facts.components);
        let turn = if self.rotation.is_empty() { 0 } else { self.rotation.len() / self.ratio.len() };
        Strains {
            strain: &mut self.strain[number * count * components..],
            ratio: &mut self.ratio[number * count..],
            volume: &mut self.volume[number * count..],
            stress: &mut self.stress[number * count * components..],
            rotation: &mut self.rotation[number * count * turn..],
            thickness: self.thickness,
            damping: self.damping,
            live: self.live,
        }
    }
}

/// What an element answers to the stresses of its layers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer<L> {
    /// Square of the highest frequency that it may have, times the mass, N/m.
    stiffness: L,
    /// Least length or area of a layer over that of the middle; not positive: the element is inverted.
    determinant: L,
    /// Present thickness, m.
    thickness: L,
    /// Energy that hourglass control has stored and taken, J.
    hourglass: L,
    /// Energy that it stores besides in its layers, and damping took besides in these, J.
    besides: [L; 2],
    /// Part of the work of the last step that flow took, in the mean over the points and by the square of
    /// their heights; and the quadratic mean of their equivalent stress, Pa.
    flow: [L; 3],
    /// See [`super::ElementState::shell`].
    resultants: [L; SHELL_VALUES],
}

/// The kinematics of a shell element. All functions with lanes are `#[inline(always)]`.
pub(super) trait ShellKernel<const D: usize>: Clone + Send + Sync + 'static
where
    Dim<D>: Space<D>,
{
    /// Strains and stresses of its points.
    type Tensor: SymmetricTensor<f64>;
    /// Nodes of an element.
    const NODES: usize;
    /// Batches that are kept of an element.
    const STATE: usize;
    /// Batches that pass from strain to forces in a step.
    const PASSED: usize = 0;
    /// What it knows of the rotation of a node.
    const POSE: Pose;
    /// Points in the plane, each with all layers.
    const PLANES: usize = 1;
    /// Whether the material of a layer may rotate against the frame of its element.
    const ROTATES: bool = false;

    /// Directions of the nodes of each element (its tangents; in 3D its normals), which are common to the
    /// elements around a node as far as these differ by less than an angle with the cosine `fold`.
    fn directions(connectivity: &[u32], positions: &[[f64; D]], fold: f64) -> Vec<[f64; D]>;
    /// An element at the start.
    fn start(facts: &Facts, positions: &[[f64; D]], directions: &[[f64; D]], thickness: f64) -> Start;
    /// Strains the layers, and keeps or passes on what forces need.
    fn strain<L: Lane>(
        facts: &Facts,
        corners: &Corners<'_, D>,
        state: &mut [Batch],
        passed: &mut [Batch],
        strains: &mut Strains<'_>,
        at: usize,
    );
    /// Forces and moments of the stresses; `inertia` is that of a corner by its mass, m².
    fn forces<L: Lane>(
        facts: &Facts,
        state: &mut [Batch],
        passed: &[Batch],
        layers: &Layers<'_>,
        inertia: L,
        pulls: &mut Pulls<'_, L, D>,
        at: usize,
    ) -> Answer<L>;
    /// [`Answer::resultants`] of a lane, from what is kept alone.
    fn resultants(facts: &Facts, state: &[Batch], layers: &Layers<'_>, lane: usize) -> [f64; SHELL_VALUES] {
        let mut pulls = Pulls { forces: &mut [[0.0; D]; CORNERS], moments: &mut [[0.0; 3]; CORNERS], there: true };
        Self::forces::<f64>(facts, &mut state.to_vec(), &vec![Batch::default(); Self::PASSED], layers, 1.0, &mut pulls, lane).resultants
    }
    /// Stress of an elastic body with K and µ (Pa) that is strained like a layer, Pa.
    fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], stiffness: [L; 2], at: usize) -> [L; 6];
    /// A stress in the frame of an element (at one of its points in the plane), in that of the model: xx yy
    /// zz xy yz zx.
    fn turned(state: &[Batch], stress: [f64; 6], plane: usize, lane: usize) -> [f64; 6];
}

/// Corners of an element, at most.
const CORNERS: usize = 4;

/// The corners of a batch of elements among the points of their chunk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners<'a, const D: usize> {
    points: &'a Moving<4>,
    places: &'a Indices,
    /// Row of the first of them.
    row: usize,
}

impl<const D: usize> Corners<'_, D> {
    /// Position of a corner, and its [`Pose`].
    #[inline(always)]
    fn of<L: Lane>(&self, corner: usize, at: usize) -> ([L; D], [L; 4]) {
        let (mut position, zero) = ([L::splat(0.0); D], L::splat(0.0));
        if D == 2 {
            let [[x, y, angle, _]] = L::gather_one::<4, 1, false>(self.points, self.places, self.row + corner, at);
            (position[0], position[1]) = (x, y);
            return (position, [angle, zero, zero, zero]);
        }
        let [own, pose] = L::gather::<4>(self.points, self.places, self.row + corner, at);
        position.copy_from_slice(&own[..D]);
        (position, pose)
    }
}

/// Forces and moments of a batch of elements, corner by corner.
#[derive(Debug)]
pub(super) struct Pulls<'a, L: Lane, const D: usize> {
    forces: &'a mut [[L; D]; CORNERS],
    moments: &'a mut [[L; 3]; CORNERS],
    /// What is not there does not pull.
    there: L::Mask,
}

impl<L: Lane, const D: usize> Pulls<'_, L, D> {
    #[inline(always)]
    fn put(&mut self, corner: usize, mut force: [L; D], mut moment: [L; 3]) {
        for d in 0..D {
            force[d] = L::select(self.there, force[d], L::splat(0.0));
        }
        for d in 0..3 {
            moment[d] = L::select(self.there, moment[d], L::splat(0.0));
        }
        (self.forces[corner], self.moments[corner]) = (force, moment);
    }
}

/// What belongs to a batch of eight elements.
#[derive(Clone, Copy, Debug, Default)]
struct ShellBatch {
    /// Least corner mass of each element times its corners, kg/m (kg).
    mass_least: Batch,
    /// Thickness at the start and now, m.
    thickness_initial: Batch,
    thickness: Batch,
    /// Inertia of a corner by its mass, m².
    inertia: Batch,
    /// Energies, J/m.
    stored: Batch,
    dissipated: Batch,
    damping: Batch,
    hourglass: Batch,
    besides: [Batch; 2],
    flow: [Batch; 3],
    time_step_squared: Batch,
    /// See [`Answer::determinant`].
    determinant: Batch,
    /// 1 for an element that is there, else 0.
    live: Batch,
}

impl Persist for ShellBatch {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            mass_least: _, thickness_initial: _, inertia: _,
            thickness, stored, dissipated, damping, hourglass, besides, flow, time_step_squared, determinant, live,
        } = self;
        besides[..].persist(archive)?;
        flow[..].persist(archive)?;
        crate::archive::persist_each!(archive; thickness, stored, dissipated, damping, hourglass, time_step_squared, determinant, live);
        Ok(())
    }
}

/// Room of a thread.
#[derive(Debug, Default)]
struct Room {
    points: Moving<4>,
    /// Forces and moments on them; in 2D the first alone, with the moment as the third value.
    sums: [VectorSums<3>; 2],
    passed: Vec<Batch>,
    strain: Vec<Batch>,
    ratio: Vec<Batch>,
    rotation: Vec<Batch>,
    volume: Vec<Batch>,
    response: Vec<Batch>,
    law: Scratch,
}

/// The thickness of a corner, by its number and place, m.
type ThicknessAt<'a, const D: usize> = &'a dyn Fn(usize, [f64; D]) -> f64;

/// The shells of a part.
pub(super) struct Shells<K, const D: usize> {
    laws: Laws,
    facts: Facts,
    /// β of the damping in proportion to the stiffness, s.
    damping: f64,
    /// Share of failed points with which an element fails.
    failed_share: f64,
    count: usize,
    /// Nodes of the chunks: the slots of forces and moments.
    local: LocalPoints,
    /// Whether elements may fail; then forces and moments of each corner, else one batch per chunk, which
    /// stands for nothing.
    keeps_forces: bool,
    kept: Vec<Batch>,
    state: Vec<Batch>,
    elements: Vec<ShellBatch>,
    /// Mass of each corner, kg/m (kg), and initial volume of each element, m² (m³).
    corner_mass: Vec<f64>,
    volume: Vec<f64>,
    stress: Vec<Batch>,
    history: Vec<Batch>,
    /// Stress of the damping, Pa; without it one batch per chunk, which stands for nothing.
    damped: Vec<Batch>,
    /// Squares of the stable steps when they were marked, s²; empty: not yet.
    marks: Vec<Batch>,
    /// No rotation, at the points of a strip, and no heat.
    rotation: Vec<Batch>,
    heat: Vec<Batch>,
    reports: Vec<Report>,
    rooms: Vec<Mutex<Room>>,
    kernel: std::marker::PhantomData<K>,
}

impl<K, const D: usize> Shells<K, D>
where
    K: ShellKernel<D>,
    Dim<D>: Space<D>,
{
    /// From what [`super::make`] was given; `None` without a section, or where a law is unknown.
    pub(super) fn new(input: &BlockInput<'_, D>, law_of: LawOf<'_>, [is_plane_stress, is_axisymmetric]: [bool; 2]) -> Option<Self> {
        let section = input.section?;
        let (laws, points) = Laws::of(input, section, law_of, K::PLANES)?;
        let facts = Facts { is_axisymmetric, ..Facts::new::<K, D>(points, &laws, is_plane_stress) };
        let facts = if section.layers.is_empty() { facts } else { facts.layered::<D>(&laws) };
        let thickness =
            |corner: usize, place: [f64; D]| input.thicknesses.get(corner).copied().unwrap_or_else(|| section.thickness_at(place));
        Some(Self::of(input, laws, facts, section.failed_points, (&thickness, section.fold_angle)))
    }

    /// The same of beams, with the law of their fibres; `None` without a cross-section.
    pub(super) fn of_beams(input: &BlockInput<'_, D>, law: Box<dyn PointLaw>) -> Option<Self> {
        let given = input.profile?;
        let (profile, points) = Profile::of(given)?;
        let laws = Laws::one(input.material, law, points.count() * K::PLANES);
        // No stress in both directions across.
        let facts = Facts { profile, ..Facts::new::<K, D>(points, &laws, true) };
        Some(Self::of(input, laws, facts, given.failed_points, (&|_, _| profile.area, 0.0)))
    }

    fn of(
        input: &BlockInput<'_, D>,
        laws: Laws,
        facts: Facts,
        failed_share: f64,
        (thickness, fold_angle): (ThicknessAt<'_, D>, f64),
    ) -> Self {
        let density = laws.density(&facts.section);
        let (points, count, components) = (facts.section.count() * K::PLANES, input.connectivity.len() / K::NODES, facts.components);
        let batches = count.div_ceil(BATCH);
        let scratch = |width: usize| vec![Batch::default(); batches * width];
        let turn = <<K::Tensor as SymmetricTensor<f64>>::Rotation as Turn<f64>>::COMPONENTS;
        let mut rotation = vec![Batch::default(); STRIP * points * turn];
        for point in rotation.chunks_exact_mut(turn) {
            (0..BATCH).for_each(|lane| <<K::Tensor as SymmetricTensor<f64>>::Rotation as Turn<f64>>::none().store(point, lane));
        }
        let mut history = scratch(facts.width);
        history.chunks_exact_mut(facts.width).for_each(|batch| laws.start(batch));
        let damped = if input.damping > 0.0 { scratch(points * components) } else { vec![Batch::default(); batches.div_ceil(CHUNK)] };
        let mut shells = Self {
            damping: input.damping,
            failed_share,
            count,
            local: LocalPoints::default(),
            keeps_forces: false,
            kept: vec![Batch::default(); batches.div_ceil(CHUNK)],
            state: scratch(K::STATE),
            elements: vec![ShellBatch::default(); batches],
            corner_mass: Vec::with_capacity(input.connectivity.len()),
            volume: Vec::with_capacity(count),
            stress: scratch(points * components),
            history,
            damped,
            marks: Vec::new(),
            rotation,
            heat: vec![Batch::default(); STRIP * points],
            reports: vec![Report::NOTHING; batches.div_ceil(CHUNK)],
            rooms: vec![Mutex::default()],
            kernel: std::marker::PhantomData,
            laws,
            facts,
        };
        shells.begin_elements(input, thickness, fold_angle, density);
        shells
    }

    fn begin_elements(&mut self, input: &BlockInput<'_, D>, thickness_at: ThicknessAt<'_, D>, fold_angle: f64, density: f64) {
        let own =
            input.directions.is_empty().then(|| K::directions(input.connectivity, input.positions, crate::angle::cos_sin(fold_angle)[0]));
        let directions = own.as_deref().unwrap_or(input.directions);
        self.local = LocalPoints::new(input.connectivity, K::NODES, if matches!(K::POSE, Pose::Director) { directions } else { &[] });
        let stored = self.laws.first().stored();
        for (element, nodes) in input.connectivity.chunks_exact(K::NODES).enumerate() {
            let (batch, lane) = (element / BATCH, element % BATCH);
            let positions: Vec<[f64; D]> = nodes.iter().map(|&node| input.positions[node as usize]).collect();
            let own = &directions[element * K::NODES..][..K::NODES];
            let corners: Vec<f64> = (element * K::NODES..).zip(&positions).map(|(corner, &place)| thickness_at(corner, place)).collect();
            let is_even = corners.iter().all(|own| *own == corners[0]);
            let thickness = if is_even { corners[0] } else { corners.iter().sum::<f64>() / K::NODES as f64 };
            let start = K::start(&self.facts, &positions, own, thickness);
            let state = &mut self.state[batch * K::STATE..][..K::STATE];
            state.iter_mut().zip(&start.state).for_each(|(batch, &value)| batch.0[lane] = value);
            let volume: f64 = start.volumes.iter().sum();
            // What a middle beside the nodes has more of a bent shell.
            let more = if self.facts.section.middle == 0.0 { 1.0 } else { volume / (thickness * start.areas.iter().sum::<f64>()) };
            // Integrals of a linear thickness with the shape functions: of triangles a quarter of what is
            // more.
            let part = if K::NODES == 3 { 0.25 } else { 1.0 / 3.0 };
            let at = |own: f64| if is_even { thickness } else { thickness + part * (own - thickness) };
            let masses = start.areas.iter().zip(&corners).map(|(area, &own)| density * at(own) * area * more);
            let least = masses.clone().fold(f64::INFINITY, f64::min);
            self.corner_mass.extend(masses);
            self.volume.push(volume);
            let own = &mut self.elements[batch];
            for (batch, value) in [
                (&mut own.mass_least, K::NODES as f64 * least),
                (&mut own.thickness_initial, thickness),
                (&mut own.thickness, thickness),
                (&mut own.inertia, start.inertia),
                (&mut own.stored, stored * volume),
                (&mut own.live, 1.0),
            ] {
                batch.0[lane] = value;
            }
        }
    }

    fn joined(&self) -> Report {
        Report::joined(self.reports.iter().copied())
    }

    /// Points of an element.
    fn points(&self) -> usize {
        self.facts.section.count() * K::PLANES
    }

    /// The history of a batch.
    fn history_of(&self, batch: usize) -> &[Batch] {
        &self.history[batch * self.facts.width..][..self.facts.width]
    }

    /// The layers of a batch; responses are those of the last step where they are given.
    fn layers<'a>(&'a self, batch: usize, response: &'a [Batch]) -> Layers<'a> {
        let points = self.points();
        Layers {
            stress: &self.stress[batch * points * self.facts.components..][..points * self.facts.components],
            history: self.history_of(batch),
            response,
            damped: &[],
            thickness: &self.elements[batch].thickness_initial,
            flow: &self.elements[batch].flow,
            first: 0,
        }
    }

    /// What is at the lower face, half way and at the upper face: linear between two points of a layer, and
    /// beyond them.
    fn through(&self, element: usize) -> [Through; 3] {
        let (batch, lane) = (element / BATCH, element % BATCH);
        let state = &self.state[batch * K::STATE..][..K::STATE];
        let history = self.history_of(batch);
        let mut all = [Through::default(); 3];
        let part = 1.0 / K::PLANES as f64;
        for (own, height) in all.iter_mut().zip([-0.5, 0.0, 0.5]) {
            for plane in 0..K::PLANES {
                let mut stress = [0.0; 6];
                for (point, share) in self.facts.section.around(height) {
                    let point = plane * self.facts.section.count() + point;
                    stress = plus(stress, times(share, self.stress_of(element, point)));
                    let strain = self.laws.place(point, &PLASTIC_STRAIN).map_or(0.0, |place| history[place].0[lane]);
                    own.plastic_strain += part * share * strain;
                }
                own.stress = plus(own.stress, times(part, K::turned(state, stress, plane, lane)));
            }
            own.plastic_strain = own.plastic_strain.max(0.0);
        }
        all
    }

    /// Stress xx yy zz xy yz zx of a point in the frame of the element.
    fn stress_of(&self, element: usize, point: usize) -> [f64; 6] {
        let (batch, lane) = (element / BATCH, element % BATCH);
        let components = self.facts.components;
        let own = &self.stress[(batch * self.points() + point) * components..][..components];
        K::Tensor::load(own, lane).components()
    }
}
