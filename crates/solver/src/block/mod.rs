//! Blocks: the elements of one kind with one material, which gather node motion, update strain and stress,
//! and return forces.
//!
//! The state of the elements lives in the store (`store.rs`), in batches of eight (`batch.rs`); it is the
//! same type for every element and every law. A step goes chunk by chunk (`local.rs`: nodes side by side,
//! forces summed where they arise), and in it strip by strip (`strip.rs`): the kernel of the element strains
//! the points (`strain.rs`), the law responds (`crate::material::points`), and the kernel makes forces of the
//! stresses (`forces.rs`). Only kernels are compiled for each element (`kernel.rs`), and laws for themselves,
//! so there are as many as elements plus laws, not their product. A block is a `Box<dyn Block>`: one virtual
//! call per block and step, and three per strip of 64 elements. Forces go to the assembly, which sums those
//! of all chunks in fixed order.

mod bar;
mod batch;
mod damping;
mod elastic;
mod erosion;
mod forces;
mod initial;
mod kernel;
mod local;
mod make;
mod mass_scaling;
mod nodal;
mod shell;
pub(crate) mod spring;
mod store;
mod strain;
mod strip;
mod subcycles;
mod transfer;

pub use elastic::{Elastic, ElasticInput};
pub use initial::{Initial, Wrong};
pub use local::LocalNodes;
pub use make::{BlockInput, Blocks, make};
pub use store::CHUNK;
pub use subcycles::{Begin, RATIO_MOST, Regions, Subcycled, largest_divisor};
pub use transfer::PointValues;

use crate::archive::{Archive, ArchiveResult, persist_all};
use crate::failure::Criterion;
use crate::material::points::PointLaw;
use crate::material::{VARIABLES_MOST, Variable};
use crate::reductions;
use crate::rotations::Rotations;
use embate_lanes::{Level, Team};

/// A slot of forces without a node.
pub const NO_NODE: u32 = u32::MAX;

/// Node motion that a block gathers from: end of step positions and the velocities that led there.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a, const D: usize> {
    /// Positions at the end of the step, m.
    pub positions: &'a [[f64; D]],
    /// Velocities of the step, m/s: x_new = x_old + `time_step` v.
    pub velocities: &'a [[f64; D]],
    /// Step, s; zero for the first evaluation.
    pub time_step: f64,
    /// Steps since the cycle of subcycling began: what has the step ratio r is evaluated where r divides it.
    pub turn: u32,
    /// Rotations of nodes at the end of the step, and the spins that led there.
    pub rotations: &'a Rotations,
}

impl<'a, const D: usize> Motion<'a, D> {
    /// Of nodes without rotations.
    #[must_use]
    pub fn new(positions: &'a [[f64; D]], velocities: &'a [[f64; D]], time_step: f64) -> Self {
        Self { positions, velocities, time_step, turn: 0, rotations: Rotations::NONE }
    }
}

/// Where a block leaves what pulls on its nodes: an entry for each of its slots.
#[derive(Debug)]
pub struct NodalForces<'a, const D: usize> {
    /// Forces in [`Block::slots`], N/m in 2D.
    pub forces: &'a mut [[f64; D]],
    /// Moments in [`Block::moment_slots`], N in 2D (N m), about x, y and z.
    pub moments: &'a mut [[f64; 3]],
}

impl<'a, const D: usize> NodalForces<'a, D> {
    /// Of a block without rotations.
    pub fn new(forces: &'a mut [[f64; D]]) -> Self {
        Self { forces, moments: &mut [] }
    }
}

/// What a block (or a chunk of it) reports after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Smallest square of an element's stable step, s².
    pub time_step_squared: f64,
    /// Smallest ratio of such a square to that of the same element at the last [`Block::mark_time_steps`];
    /// infinite before the first.
    pub step_change: f64,
    /// Largest way of the nodes of an element around their mean in the step times its weight
    /// ([`Block::weigh_motion`]); zero without weights.
    pub motion: f64,
    /// Largest coefficient of the bulk viscosity of an element with its quadratic part, L + 2 Q² l |ε̇|/c.
    pub viscosity: f64,
    /// Smallest Jacobian determinant; not positive: an element is inverted.
    pub determinant: f64,
    /// Stored elastic energy, J/m.
    pub stored: f64,
    /// Energy dissipated so far, J/m.
    pub dissipated: f64,
    /// Energy that hourglass control has stored and taken so far, J/m.
    pub hourglass: f64,
    /// Work that the bulk viscosity has taken so far, J/m.
    pub viscous: f64,
    /// Work that damping in proportion to the stiffness has taken so far, J/m.
    pub damping: f64,
}

persist_all!(Report { time_step_squared, determinant, stored, dissipated, hourglass, viscous, damping } but { step_change, motion, viscosity });

impl Report {
    /// Of no element.
    pub const NOTHING: Self = Self {
        time_step_squared: f64::INFINITY,
        step_change: f64::INFINITY,
        motion: 0.0,
        viscosity: 0.0,
        determinant: f64::INFINITY,
        stored: 0.0,
        dissipated: 0.0,
        hourglass: 0.0,
        viscous: 0.0,
        damping: 0.0,
    };

    /// All together: energies are exact until they are rounded once.
    pub fn joined(parts: impl Iterator<Item = Self> + Clone) -> Self {
        let of = |value: fn(&Self) -> f64| parts.clone().map(move |report| value(&report));
        Self {
            time_step_squared: reductions::min(of(|report| report.time_step_squared)),
            step_change: reductions::min(of(|report| report.step_change)),
            motion: reductions::max(of(|report| report.motion)),
            viscosity: reductions::max(of(|report| report.viscosity)),
            determinant: reductions::min(of(|report| report.determinant)),
            stored: reductions::sum(of(|report| report.stored)),
            dissipated: reductions::sum(of(|report| report.dissipated)),
            hourglass: reductions::sum(of(|report| report.hourglass)),
            viscous: reductions::sum(of(|report| report.viscous)),
            damping: reductions::sum(of(|report| report.damping)),
        }
    }
}

/// Mean state of an element for output.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementState {
    /// Cauchy stress xx yy zz xy (yz zx), mean over the points, Pa.
    pub stress: [f64; 6],
    /// The history variables in the order in which the law declares them ([`PointLaw::variables`]), mean over
    /// the points, of shells the largest; zero beyond. By variable: [`Block::variable`].
    pub variables: [f64; VARIABLES_MOST],
    /// Stored elastic energy per initial volume, J/m³.
    pub energy_density: f64,
    /// Of shells: membrane forces 11 22 12 (N/m), moments 11 22 12 (N), transverse forces 1 2 (N/m) by width,
    /// and the thickness, m; in 2D 1 is along the shell, 2 out of the plane. Of beams: normal and transverse
    /// forces y z (N), torque and moments about y z (N m), and no thickness. Zero of others.
    pub shell: [f64; SHELL_VALUES],
    /// Of shells: 1 − t/t₀, and what is at the lower face, half way and at the upper face (in 2D the right
    /// and the left one). Zero of others.
    pub thinning: f64,
    /// See [`ElementState::thinning`].
    pub through: [Through; 3],
}

/// What is at a height of a shell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Through {
    /// Cauchy stress xx yy zz xy (yz zx) in the axes of the model, Pa.
    pub stress: [f64; 6],
    /// Plastic strain.
    pub plastic_strain: f64,
}

persist_all!(Through { stress, plastic_strain });

/// Values of [`ElementState::shell`].
pub const SHELL_VALUES: usize = 9;

persist_all!(ElementState { stress, variables, energy_density, shell, thinning, through });

/// What a block reports at the start, at rest; its state is that of the first [`Block::advance`].
pub fn evaluate_at_rest<const D: usize>(block: &mut dyn Block<D>, positions: &[[f64; D]], level: Level) -> Report {
    let rotations = Rotations::at_rest(block.rotating_nodes().into_iter().map(|(node, _)| node), D);
    let velocities = vec![[0.0; D]; positions.len()];
    let motion = Motion { rotations: &rotations, ..Motion::new(positions, &velocities, 0.0) };
    let (mut forces, mut moments) = (vec![[0.0; D]; block.slots().len()], vec![[0.0; 3]; block.moment_slots().len()]);
    block.advance(&motion, level, NodalForces { forces: &mut forces, moments: &mut moments }, &mut Team::alone())
}

/// Elements of one kind and one material.
pub trait Block<const D: usize>: Send + Sync {
    /// Number of elements.
    fn elements(&self) -> usize;
    /// The node of each slot in which [`Block::advance`] leaves forces, or [`NO_NODE`]. A node's slots follow
    /// each other in the order of the elements.
    fn slots(&self) -> &[u32];
    /// The node of each slot in which [`Block::advance`] leaves moments, or [`NO_NODE`]; empty where its
    /// elements have no rotations.
    fn moment_slots(&self) -> &[u32] {
        &[]
    }
    /// Nodes that rotate, each with what an element adds to its moment of inertia, which is the same about
    /// all axes, kg m in 2D (kg m²).
    fn rotating_nodes(&self) -> Vec<(u32, f64)> {
        Vec::new()
    }
    /// Advances all points to the end of the step and writes to the slots what pulls on their nodes. The
    /// first time is that of time zero, without a step. The result does not depend on `level`
    /// or on the threads of the `team`.
    fn advance(&mut self, motion: &Motion<'_, D>, level: Level, pulls: NodalForces<'_, D>, team: &mut Team) -> Report;
    /// From now on keeps the forces of every element for [`Block::force`] and [`Block::moment`]: of elements
    /// that can fail, or whose forces the history wants. Lines have slots of their own, and keep nothing
    /// besides.
    fn keep_forces(&mut self) {}
    /// Force of an element on the node at a corner, N/m in 2D, as of the last [`Block::advance`] with
    /// these slots; zero if it was not kept.
    fn force(&self, element: usize, corner: usize, slots: &[[f64; D]]) -> [f64; D];
    /// Moment of an element on the node at a corner, N in 2D (N m), as of the last [`Block::advance`]; zero
    /// if it was not kept, or of elements without rotations.
    fn moment(&self, _element: usize, _corner: usize) -> [f64; 3] {
        [0.0; 3]
    }
    /// Mass of an element, kg/m in 2D.
    fn mass(&self, element: usize) -> f64;
    /// Share of corner `corner` in the mass of `element` (row sum of the consistent mass), kg/m in 2D.
    fn corner_mass(&self, element: usize, corner: usize) -> f64;
    /// Frees the memory of the corner masses, once nodes have theirs: what is left of them, as of
    /// [`Block::mass`], may be not a number.
    fn release_corner_masses(&mut self) {}
    /// Square of an element's stable step, s², in the state of the last [`Block::advance`].
    fn time_step_squared(&self, element: usize) -> f64;
    /// Hands over for each live element and each of its nodes the stiffness k_e with which its own is at most
    /// k_e 1, N/m, and the mass m_c of its lightest corner, kg/m, in the state of the last
    /// [`Block::advance`]: k_e = 4 m_c / dt_e² of its stable step, and 4 m_c / (dt_e `shortest`) where
    /// damping is in it, with the `shortest` stable step of all elements, s.
    fn bound_stiffness(&self, shortest: f64, add: &mut dyn FnMut(u32, f64, f64));
    /// From now on reports how the stable steps have changed since the last [`Block::advance`].
    fn mark_time_steps(&mut self);
    /// The elastic body that its elements are never stiffer than, where its law has one.
    fn elastic(&self) -> Option<&dyn Elastic<D>> {
        None
    }
    /// From now on reports the largest way of the nodes of an element times its weight, 1/m; of blocks with
    /// [`Block::elastic`].
    fn weigh_motion(&mut self, _weight: &dyn Fn(usize) -> f64) {}
    /// Its regions, where they may have steps of their own.
    fn regions(&self) -> Option<&dyn Regions> {
        None
    }
    /// From now on these are evaluated less often than in every step, where [`Subcycled::set_ratios`] says.
    fn start_subcycling(&mut self) {}
    /// The block with subcycling, where that was started.
    fn subcycled(&mut self) -> Option<&mut dyn Subcycled<D>> {
        None
    }
    /// Mean state of an element.
    fn state(&self, element: usize) -> ElementState;
    /// Mean states of several elements, in their order: one call for all of them.
    fn states(&self, elements: &[u32], states: &mut [ElementState]) {
        states.iter_mut().zip(elements).for_each(|(state, &element)| *state = self.state(element as usize));
    }
    /// Squares of the stable steps of all elements, s², in the state of the last [`Block::advance`].
    fn time_steps_squared(&self) -> Vec<f64> {
        (0..self.elements()).map(|element| self.time_step_squared(element)).collect()
    }
    /// Steps from one evaluation of an element to the next.
    fn step_ratio(&self, _element: usize) -> u32 {
        1
    }
    /// The first element that has not been eroded and whose stable step over its step ratio has this square,
    /// s²; not a number is found too.
    fn governing_element(&self, squared: f64) -> Option<usize> {
        let allowed = |element: usize| self.time_step_squared(element) / f64::from(self.step_ratio(element)).powi(2);
        (0..self.elements()).find(|&element| self.is_alive(element) && allowed(element).total_cmp(&squared).is_eq())
    }
    /// The law of its points; springs have none.
    fn law(&self) -> Option<&dyn PointLaw>;
    /// P-wave modulus K + 4µ/3 at rest, of solids in plane stress that of a sheet, Pa: stiffness of the
    /// material under a contact surface.
    fn wave_modulus(&self) -> f64 {
        self.law().map(PointLaw::stiffness).map_or(0.0, |[bulk, shear]| bulk + 4.0 / 3.0 * shear)
    }
    /// Bulk modulus K at rest, Pa.
    fn bulk_modulus(&self) -> f64 {
        self.law().map_or(0.0, |law| law.stiffness()[0])
    }
    /// Shear modulus µ at rest, Pa: with the density the speed of shear waves.
    fn shear_modulus(&self) -> f64 {
        0.75 * (self.wave_modulus() - self.bulk_modulus())
    }
    /// Where a variable is among [`ElementState::variables`]; `None`: the law has none such.
    fn index_of(&self, variable: &Variable) -> Option<usize> {
        self.law()?.variables().iter().position(|own| own.variable == variable)
    }
    /// Whether the law has this variable.
    fn has(&self, variable: &Variable) -> bool {
        self.index_of(variable).is_some()
    }
    /// A variable in the state of one of the elements; `None`: the law has none such.
    fn variable(&self, state: &ElementState, variable: &Variable) -> Option<f64> {
        self.index_of(variable).map(|index| state.variables[index])
    }
    /// Makes an element heavier by a factor, for a longer stable step; before the first [`Block::advance`]
    /// that counts.
    fn scale_mass(&mut self, element: usize, factor: f64);
    /// Mass that elements whose squared stable step, s², is below the first of these need for the second,
    /// kg/m in 2D, in the state of the last [`Block::advance`]; of elements all of whose nodes `may` get any.
    fn mass_for(&self, _squared: [f64; 2], _may: &dyn Fn(u32) -> bool) -> f64 {
        0.0
    }
    /// Gives it to them, the same to each corner, and hands over each node with what it got; returns the
    /// squared step that the block reports with it. `None`: none was given.
    fn make_heavier(&mut self, _squared: [f64; 2], _may: &dyn Fn(u32) -> bool, _add: &mut dyn FnMut(u32, f64)) -> Option<f64> {
        None
    }
    /// Stresses and states of its points; `None`: it is not of solids whose law can continue with means of
    /// them.
    fn point_values(&self, _positions: &[[f64; D]]) -> Option<PointValues> {
        None
    }
    /// Elastic energy of the stresses of its points by their volumes now, J/m; of rate laws, where
    /// [`Block::point_values`] has them. [`Report::stored`] is the sum of the works of all steps instead.
    fn elastic_energy(&self, _positions: &[[f64; D]]) -> f64 {
        0.0
    }
    /// Gives these to its points, as many as it has, before the first [`Block::advance`]; `before`: what the
    /// elements that it stands for had dissipated, and had stored beyond the energy of their stresses, which
    /// stays; `positions`, m, are those of its nodes now.
    fn take_point_values(&mut self, _values: &PointValues, _before: &Report, _positions: &[[f64; D]]) {}
    /// Makes an element heavier by a factor that is its density over that of the material; before nodes have
    /// their masses.
    fn scale_density(&mut self, element: usize, factor: f64) {
        self.scale_mass(element, factor);
    }
    /// Gives the points what they hold at the start; before the first [`Block::advance`].
    ///
    /// # Errors
    /// What keeps the law from holding it.
    fn begin(&mut self, initial: &Initial<'_>, positions: &[[f64; D]]) -> Result<(), Wrong>;
    /// Whether an element has not been eroded.
    fn is_alive(&self, element: usize) -> bool;
    /// Elements that fail by one of the criteria in the state of the last [`Block::advance`], ascending, with
    /// the index of the first such criterion.
    fn failed(&self, criteria: &[Criterion], parallel: bool) -> Vec<(u32, u32)>;
    /// Smallest Jacobian determinant of an element over its points.
    fn determinant(&self, element: usize, positions: &[[f64; D]]) -> f64;
    /// Takes elements (ascending) out: they pull no more, have no step and store nothing, but keep their
    /// mass. What they dissipated stays in the reports. Returns the elastic energy that each had stored, J/m;
    /// their forces are gone from the slots.
    fn erode(&mut self, elements: &[u32], pulls: NodalForces<'_, D>) -> Vec<f64>;
    /// What the last [`Block::advance`] reported, without the elements that were eroded since.
    fn report(&self, positions: &[[f64; D]]) -> Report;
    /// Keeps what changes with time and is not worked out again in [`Block::advance`].
    ///
    /// # Errors
    /// What is read is of another block.
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult;
}
