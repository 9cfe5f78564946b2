//! The stages of the builder, in their order. Each takes what those before it made and returns what it makes;
//! none knows whether it is the first time, so what changes cells or surfaces later calls those that it
//! needs.
//!
//! 1. [`Builder::start`]: the outside of the bodies, and who penetrates whom;
//! 2. [`Builder::elements`]: blocks, masses, velocities, rigid parts;
//! 3. [`Builder::conditions`]: springs, loads, contacts, obstacles, failure;
//! 4. [`Builder::assembled`]: the system.

use super::mass::part_masses;
use super::node_elements::NodeElements;
use super::rebuild::RebuildSource;
use super::{Builder, Builds, SERIAL, limits, source_of};
use crate::assembly::Assembly;
use crate::block::{Block, BlockInput, Initial, Report, Wrong, evaluate_at_rest, make};
use crate::contact::Contact;
use crate::contact::messages::NO_STEP;
use crate::contact::springs::Springs;
use crate::contact::traces::Traces;
use crate::contact_forces::ContactForces;
use crate::element::ElementOptions;
use crate::energy::{Ledger, Sums};
use crate::error::Fault;
use crate::failure::Criterion;
use crate::load::body_force::BodyForces;
use crate::load::cavity::Cavities;
use crate::load::damping::Damping;
use crate::load::force::Forces;
use crate::load::non_reflecting::{Behind, NonReflecting};
use crate::masses::PartMasses;
use crate::material::messages::INITIAL_STATE;
use crate::mesh::ElementGroup;
use crate::mesh::messages::{BEAMS, SHELLS};
use crate::mesh::surface::Surface;
use crate::mesh::surface::tributary::Depth;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{self, ContactLaw, Penalty, PenaltySource, StableStep};
use crate::skins::Skins;
use crate::step::erosion::Erosion;
use crate::step::free::Groups;
use crate::step::mass_scaling::MassScaling;
use crate::step::relaxation::Relaxation;
use crate::step::remap::Remap;
use crate::step::rotations::NodalRotations;
use crate::step::stages::Stages;
use crate::step::{CHUNK, Governor, NodalBound, System};
use crate::tensor::Dim;
use crate::vector::{minus, place, unit};
use embate_lanes::{Level, Team};
use std::borrow::Cow;
use std::mem::{replace, take};

/// The bodies as they are given.
pub(super) struct Start<const D: usize>
where
    Dim<D>: Builds<D>,
{
    /// Their outside. Found before there are blocks, because the facets of all elements are large; its fault
    /// is reported at its place.
    pub(super) outside: Result<Surface<D>, Fault>,
    /// Penetrations, a line each.
    pub(super) penetrations: Vec<String>,
}

/// Elements, and what nodes have of them.
pub(super) struct Elements<const D: usize>
where
    Dim<D>: Builds<D>,
{
    pub(super) blocks: Vec<Box<dyn Block<D>>>,
    velocities: Vec<[f64; D]>,
    shares: PartMasses,
    body_forces: BodyForces<D>,
    damping: Damping,
    mass_added: [f64; 2],
    /// What of it was added for the step that mass scaling wants, kg/m.
    mass_for_step: f64,
}

/// What acts on bodies.
pub(super) struct Conditions<const D: usize>
where
    Dim<D>: Builds<D>,
{
    springs: Option<Box<dyn Block<D>>>,
    forces: Forces<D>,
    cavities: Cavities<D>,
    boundary: NonReflecting<D>,
    /// Contacts, then obstacles.
    pub(super) contacts: Vec<Contact<D>>,
    /// Criteria of failure of each block.
    criteria: Vec<Vec<Criterion>>,
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// What was made, unless faults have been noted.
    fn sound<T>(&mut self, made: T) -> Result<T, Vec<Fault>> {
        if self.faults.is_empty() { Ok(made) } else { Err(take(&mut self.faults)) }
    }

    /// Whether the model has a contact or an obstacle.
    fn touches(&self) -> bool {
        !(self.model.contacts.is_empty() && self.model.obstacles.is_empty())
    }

    /// The outside of all bodies. Made only to report elements that overlap where nothing `touches`. A
    /// symmetry line is no surface: pressures count the length on the model's side.
    fn outside(&self, touches: bool) -> Result<Surface<D>, Fault> {
        self.mesh.outside_without(&[], |segment| !touches || self.constraints.is_mirror(segment))
    }

    /// The outside that was found at the start, or that of a model whose contacts turned out to be none.
    pub(super) fn outside_of(&self, outside: Result<Surface<D>, Fault>, contacts: &[Contact<D>]) -> Result<Surface<D>, Vec<Fault>> {
        let touches = !contacts.is_empty();
        if touches == self.touches() { outside } else { self.outside(touches) }.map_err(|fault| vec![fault])
    }

    /// Penetrations at the start are resolved, in the mesh, or faults.
    pub(super) fn start(&mut self) -> Result<Start<D>, Vec<Fault>> {
        let outside = self.outside(self.touches());
        // Bodies of a run on its way are where they are.
        let penetrations = if self.mesh.remeshed.is_empty() { self.resolve_initial_penetration() } else { Vec::new() };
        self.sound(Start { outside, penetrations })
    }

    /// Blocks, masses of nodes, velocities, rigid parts, and what acts on mass.
    pub(super) fn elements(&mut self, level: Level) -> Result<Elements<D>, Vec<Fault>> {
        let model = self.model;
        let mut blocks = self.blocks();
        if blocks.len() < self.mesh.groups.len() {
            return Err(take(&mut self.faults));
        }
        let mut part_mass_true = part_masses(&self.mesh, &blocks);
        self.point_masses(&mut part_mass_true);
        let (mass_added, mass_for_step) = self.scale_mass(&mut blocks, level);
        let is_scaled = model.run.mass_scaling.is_some() || model.parts.iter().any(|part| part.mass_scale != 1.0);
        let part_mass_scaled = is_scaled.then(|| {
            let mut part_mass = part_masses(&self.mesh, &blocks);
            self.point_masses(&mut part_mass);
            part_mass
        });
        let part_mass = part_mass_scaled.as_ref().unwrap_or(&part_mass_true);
        for &(node, share) in part_mass.iter().flatten() {
            self.mass[node as usize] += share;
        }
        // What is added to resist motion weighs nothing.
        let body_forces = BodyForces::new(model, &self.mesh, &self.curves, &self.mass, &part_mass_true);
        let mut damping = Damping::new(model, &self.mesh, &self.mass, part_mass);
        if model.first_relaxation().is_some() {
            damping.relax(0.0);
        }
        let velocities = self.velocities(part_mass);
        self.rigid_parts(part_mass);
        let shares = self.shares(&blocks, part_mass);
        self.masses_of_transfer(&mut blocks, &part_mass_true);
        // From here on masses are those of nodes, and of parts as a whole: each list of them is as large as
        // all positions.
        blocks.iter_mut().for_each(|block| block.release_corner_masses());
        drop((part_mass_scaled, part_mass_true));
        self.measure_stiffness(&mut blocks, level);
        Ok(Elements { blocks, velocities, shares, body_forces, damping, mass_added, mass_for_step })
    }

    /// Springs, loads, contacts and obstacles, and what fails.
    pub(super) fn conditions(&mut self, elements: &Elements<D>) -> Result<Conditions<D>, Vec<Fault>> {
        let springs = self.springs().map(|springs| Box::new(springs) as Box<dyn Block<D>>);
        let (forces, boundary) = self.loads();
        let cavities = self.cavities();
        self.check_moments(&elements.blocks);
        let contacts = self.in_references(Self::contacts_and_obstacles);
        let contacts = self.sound(contacts)?;
        self.bodies.weigh(&elements.body_forces, &self.mass);
        let criteria = self.criteria();
        let criteria = self.sound(criteria)?;
        Ok(Conditions { springs, forces, cavities, boundary, contacts, criteria })
    }

    /// What is made of the mesh where areas and lengths of parts whose elements were made again are those of
    /// that time.
    pub(super) fn in_references<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> T {
        let references = match self.mesh.references() {
            Cow::Owned(positions) => Some(positions),
            Cow::Borrowed(_) => None,
        };
        let initial = references.map(|positions| replace(&mut self.mesh.positions, positions));
        let made = make(self);
        if let Some(positions) = initial {
            self.mesh.positions = positions;
        }
        made
    }

    /// The system.
    pub(super) fn assembled(
        self,
        elements: Elements<D>,
        conditions: Conditions<D>,
        outside: Surface<D>,
        initial_penetrations: Vec<String>,
        level: Level,
        threads: usize,
    ) -> System<D> {
        let Elements { mut blocks, mut velocities, shares, body_forces, damping, mass_added, mass_for_step } = elements;
        let Conditions { springs, forces, cavities, boundary, contacts, criteria } = conditions;
        let Self {
            model,
            mesh,
            constraints,
            later_constraints,
            joins,
            curves,
            positions,
            mass,
            body_parts,
            bodies,
            terms,
            outlines,
            moduli,
            time_step,
            ..
        } = self;
        let is_cut = |part: usize| model.cuts.iter().any(|cut| cut.radius.is_some() && cut.takes(&mesh.parts[part].name));
        for ((block, criteria), group) in blocks.iter_mut().zip(&criteria).zip(&mesh.groups) {
            if !criteria.is_empty() || is_cut(group.part) {
                block.keep_forces();
            }
        }
        let origin = || {
            Box::new(RebuildSource {
                model: model.clone(),
                node_elements: NodeElements::of(&mesh),
                moduli,
                time_step,
                positions: positions.clone(),
            })
        };
        let erosion = criteria.iter().any(|criteria| !criteria.is_empty()).then(|| Box::new(Erosion::new(criteria, origin())));
        let count: usize = blocks.iter().map(|block| block.elements()).sum();
        let has_springs = springs.is_some();
        blocks.extend(springs);
        let nodes = positions.len();
        let assembly = Assembly::new(nodes, &blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
        velocities.resize(nodes, [0.0; D]);
        let limits = limits::of(model, &mesh, &blocks, &outside);
        // Without contacts there is nothing to remember of any node.
        let touched = if contacts.is_empty() { 0 } else { nodes };
        let traces = Traces::new(outside, &mesh.positions[..touched.min(mesh.positions.len())], Depth::of(model));
        let mut system = System {
            slots: vec![[0.0; D]; assembly.count],
            rigid: mesh.groups.iter().map(|group| model.parts[group.part].rigid.is_some()).chain(has_springs.then_some(false)).collect(),
            has_springs,
            shares,
            positions_old: positions.clone(),
            positions,
            velocities_old: velocities.clone(),
            velocities,
            contact_forces: ContactForces::new(touched),
            springs: Springs::new(touched, bodies.len(), terms),
            reports: vec![Report::NOTHING; blocks.len()],
            sums: vec![Sums::default(); nodes.div_ceil(CHUNK)],
            groups: Groups::default(),
            of_bodies: Sums::default(),
            ledger: Ledger::default(),
            penetration_max: 0.0,
            speed: 0.0,
            travel: 0.0,
            initial_penetrations,
            erosion,
            mass_added,
            mass_scaling: model
                .run
                .mass_scaling
                .as_ref()
                .filter(|own| own.in_run)
                .map(|own| MassScaling::new(own, model.run.safety, [mass_for_step, mass_added[1]])),
            relaxation: model.first_relaxation().map(|relaxation| Relaxation::new(relaxation, nodes)),
            stages: Stages::of(model, later_constraints),
            step: 0,
            time: 0.0,
            time_step_old: 0.0,
            time_step: 0.0,
            governor: Governor::Schedule,
            bound_by: Governor::Schedule,
            nodal_bound: (model.run.stable_step != StableStep::Elements).then(NodalBound::default),
            assembled_bound: None,
            subcycling: None,
            remap: (model.is_remeshed() || !mesh.remeshed.is_empty()).then(|| Box::new(Remap::new(model))),
            team: if count >= SERIAL { Team::new(threads) } else { Team::alone() },
            mesh,
            blocks,
            assembly,
            mass,
            contacts,
            bodies,
            body_parts,
            curves,
            damping,
            body_forces,
            forces,
            cavities,
            boundary,
            joins,
            outlines,
            traces,
            constraints,
            limits,
            level,
            of_revolution: model.is_axisymmetric(),
            rotations: NodalRotations::default(),
            skins: Skins::default(),
        };
        system.find_free_nodes();
        if model.run.subcycling {
            system.start_subcycling();
        }
        if model.run.stable_step == StableStep::Assembled {
            system.bound_by_assembled_mesh();
        }
        let spins: Vec<[f64; 3]> = system.mesh.groups.iter().map(|group| model.parts[group.part].spin_vector()).collect();
        // The block of springs is beyond those of the mesh, and has no rotations.
        system.find_rotations(|block| spins.get(block).copied().unwrap_or_default());
        system.load_rotations(model);
        system.find_skins();
        system.hold_velocities_back(model.stage_of_velocities());
        system
    }

    /// A moment needs nodes that rotate.
    fn check_moments(&mut self, blocks: &[Box<dyn Block<D>>]) {
        let moments = |load: &&model::Load| matches!(load, model::Load::Moment { .. });
        if !self.model.loads.iter().any(|load| moments(&load)) {
            return;
        }
        let mut rotating: Vec<u32> = blocks.iter().flat_map(|block| block.rotating_nodes()).map(|(node, _)| node).collect();
        rotating.sort_unstable();
        for (i, load) in self.model.loads.iter().enumerate() {
            let model::Load::Moment { on, .. } = load else { continue };
            let rotates = |node: &u32| rotating.binary_search(node).is_ok() && self.bodies.of_node(*node).is_none();
            if !self.mesh.nodes(on).is_some_and(|nodes| nodes.iter().any(rotates)) {
                let message = format!("no node of \"{on}\" can rotate by itself");
                self.faults.push(Fault::new(
                    &SHELLS,
                    format!("load[{i}].on"),
                    message,
                    "name a set of nodes of shells or beams that deform",
                ));
            }
        }
    }

    /// A block for each group of elements.
    fn blocks(&mut self) -> Vec<Box<dyn Block<D>>> {
        let mut blocks = Vec::new();
        let references = self.mesh.references();
        for (index, group) in self.mesh.groups.iter().enumerate() {
            let (i, part) = (group.part, &self.model.parts[group.part]);
            let Some(material) = self.model.materials.get(&part.material) else {
                self.faults.push(Fault::new(
                    &UNKNOWN_NAME,
                    format!("part[{i}].material"),
                    format!("there is no material \"{}\"", part.material),
                    "define it",
                ));
                continue;
            };
            let element = part.element_in(D, group.kind).map_or("", |kind| kind.name);
            let layers: Vec<&model::Material> = part.materials().map(|name| self.model.materials.get(name).unwrap_or(material)).collect();
            let viscosity = self.model.run.bulk_viscosity;
            let input = BlockInput {
                area: part.area.unwrap_or(0.0),
                section: part.section.as_ref(),
                layers: &layers,
                profile: part.profile.as_ref(),
                directions: self.mesh.directions.get(index).map_or(&[], |own| &own[..]),
                thicknesses: self.mesh.thicknesses.get(index).map_or(&[], |own| &own[..]),
                damping: self.model.stiffness_damping(part),
                options: ElementOptions { hourglass: part.hourglass },
                stress_state: if D == 2 { &part.stress_state } else { "" },
                viscosity: (viscosity != [0.0; 2]).then_some(viscosity),
                ..BlockInput::new(element, material, &group.connectivity, &references)
            };
            self.faults.extend(lying(part, i, &group.connectivity, &references));
            match make(&input) {
                Some(mut block) => {
                    if let Some(own) = self.mesh.remeshed.of(i) {
                        // What they hold is filled in later.
                        let earlier = self.mesh.groups[..index].iter().filter(|other| other.part == i);
                        let first: usize = earlier.map(ElementGroup::elements).sum();
                        for (element, mass) in own.masses.iter().skip(first).take(group.elements()).enumerate() {
                            block.scale_density(element, mass / block.mass(element));
                        }
                        blocks.push(block);
                        continue;
                    }
                    let initial = Initial { stress: part.stress_initial.as_ref(), temperature: part.temperature_initial };
                    if let Err(Wrong { key, message, help }) = block.begin(&initial, &self.mesh.positions) {
                        self.faults.push(Fault::new(&INITIAL_STATE, format!("part[{i}].{key}"), message, help));
                    }
                    blocks.push(block);
                }
                None => {
                    self.faults.push(Fault::new(&UNKNOWN_NAME, format!("part[{i}]"), "its element or law is unknown", "see `embate list`"))
                }
            }
        }
        blocks
    }

    /// Gives nodes of parts that were made again the masses that they got then. Where such a mass is less
    /// than that of the elements at the node, the stable steps of these count with it.
    fn masses_of_transfer(&mut self, blocks: &mut [Box<dyn Block<D>>], of_elements: &[Vec<(u32, f64)>]) {
        for own in &self.mesh.remeshed.parts {
            for (&node, &mass) in self.mesh.parts[own.part].nodes.iter().zip(&own.node_masses) {
                self.mass[node as usize] = mass;
            }
            let mut ratio = vec![1.0f64; self.mass.len()];
            for &(node, mass) in &of_elements[own.part] {
                ratio[node as usize] = (self.mass[node as usize] / mass).min(1.0);
            }
            for (group, block) in self.mesh.groups.iter().zip(&mut *blocks).filter(|(group, _)| group.part == own.part) {
                for (element, cell) in group.cells().enumerate() {
                    let least = cell.nodes.iter().map(|&node| ratio[node as usize]).fold(1.0, f64::min);
                    if least < 1.0 {
                        block.scale_mass(element, least);
                    }
                }
            }
        }
    }

    /// What the stiffness of contacts is made from beyond the elements behind their surfaces: moduli and the
    /// first step.
    fn measure_stiffness(&mut self, blocks: &mut [Box<dyn Block<D>>], level: Level) {
        self.moduli = blocks.iter().map(|block| [block.wave_modulus(), block.bulk_modulus(), block.shear_modulus()]).collect();
        let interfaces = self.model.contacts.iter().map(|c| &c.interface).chain(self.model.obstacles.iter().map(|o| &o.interface));
        let is_asked = interfaces.into_iter().any(|interface| source_of(interface) == PenaltySource::TimeStep);
        // Springs of the automatic penalty between bodies stiffen by it, too.
        let stiffens = |contact: &model::Contact| matches!(contact.interface.law, ContactLaw::Penalty(Penalty::Automatic { .. }));
        if is_asked || self.model.contacts.iter().any(stiffens) {
            let references = self.mesh.references();
            let stable = |(block, group): (&mut Box<dyn Block<D>>, &ElementGroup)| {
                if self.model.parts[group.part].rigid.is_some() {
                    return f64::INFINITY;
                }
                evaluate_at_rest(block.as_mut(), &references, level).time_step_squared
            };
            let elements =
                self.model.run.safety * blocks.iter_mut().zip(&self.mesh.groups).map(stable).fold(f64::INFINITY, f64::min).sqrt();
            self.time_step = elements.min(self.model.run.time_step.unwrap_or(f64::INFINITY));
            if is_asked && self.time_step == f64::INFINITY {
                self.faults.push(Fault::new(
                    &NO_STEP,
                    "run.time_step",
                    "a penalty is made from the time step, but all parts are rigid and no step is given",
                    "give `time_step`, or take another `penalty_from`",
                ));
            }
        }
    }

    /// Forces on nodes, and boundaries that reflect nothing.
    fn loads(&mut self) -> (Forces<D>, NonReflecting<D>) {
        let forces = Forces::new(self.model, &self.mesh, &self.curves, |facet| self.constraints.is_mirror(facet));
        let behind = |facet| {
            let under = self.under(facet)?;
            let part = &self.model.parts[self.mesh.groups[under.group].part];
            let density = *self.model.materials.get(&part.material)?.parameters.get("density")?;
            let [wave, _, shear] = self.moduli[under.group];
            Some(Behind { density, moduli: [wave, shear] })
        };
        let boundary = NonReflecting::new(self.model, &self.mesh, |facet| self.constraints.is_mirror(facet), behind);
        let mut faults = Vec::new();
        let made = (reported(forces, &mut faults), reported(boundary, &mut faults));
        self.faults.extend(faults);
        made
    }
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Gas in closed surfaces.
    fn cavities(&mut self) -> Cavities<D> {
        let cavities = Cavities::new(self.model, &self.mesh, &self.curves, |facet| self.constraints.is_mirror(facet));
        reported(cavities, &mut self.faults)
    }
}

/// A beam whose height can't be across it.
fn lying<const D: usize>(part: &model::Part, index: usize, connectivity: &[u32], positions: &[[f64; D]]) -> Option<Fault> {
    let up = part.profile.as_ref().filter(|_| part.is_of_beams())?.up?;
    let mut beams = connectivity.as_chunks::<2>().0.iter().map(|nodes| nodes.map(|node| positions[node as usize]));
    let [from, _] =
        beams.find(|&[from, to]| unit(model::in_3d(minus(to, from))).is_some_and(|along| model::beam_axes(along, Some(up)).is_none()))?;
    let message = format!("the beam that begins at {} m goes along it", place(from));
    Some(Fault::new(&BEAMS, format!("part[{index}].profile.up"), message, "give a direction across all beams of the part"))
}

/// What was made, or its faults noted and what stands in for it.
fn reported<T: Default>(made: Result<T, Vec<Fault>>, faults: &mut Vec<Fault>) -> T {
    made.unwrap_or_else(|wrong| {
        faults.extend(wrong);
        T::default()
    })
}
