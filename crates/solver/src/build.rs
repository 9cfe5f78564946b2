//! From a model to a [`System`]: mesh, blocks, masses, contacts, obstacles, rigid bodies, conditions. All
//! faults are collected before anything runs.

mod again;
mod bodies;
mod dimension;
mod discrete;
mod failure;
mod fans;
mod idle;
mod limits;
mod mass;
mod mirrors;
mod obstacles;
mod outline;
pub(crate) mod plane;
mod space;
mod space_contact;
mod space_pinball;
mod space_start;
mod start;
mod triangles;

use crate::contact::messages::{NO_STEP, TIED_TWICE};
use crate::material::messages::INITIAL_STATE;
use crate::model::messages::UNKNOWN_NAME;
use crate::tensor::Dim;
use crate::vector;
use again::Origin;
pub use dimension::Builds;
use fans::Fans;
use mass::part_masses;

use crate::assembly::Assembly;
use crate::block::{Block, BlockInput, Initial, Motion, Report, Wrong, make};
use crate::contact::initial::is_ignored;
use crate::contact::law::{self, Law};
use crate::contact::obstacle::{Manner, OutlineShape};
use crate::contact::search;
use crate::contact::search::SearchKind;
use crate::contact::springs::friction::Friction;
use crate::contact::springs::{Springs, Tangential, Terms};
use crate::contact::traces::Traces;
use crate::contact::tracker::SKIN;
use crate::contact_forces::ContactForces;
use crate::element::ElementOptions;
use crate::energy::{Ledger, Sums};
use crate::error::{Fault, Warning};
use crate::load::body_force::BodyForces;
use crate::load::constraint::Constraints;
use crate::load::curve::Curves;
use crate::load::damping::Damping;
use crate::load::force::Forces;
use crate::load::join::Joins;
use crate::load::non_reflecting::{Behind, NonReflecting};
use crate::mesh::surface::Surface;
use crate::mesh::surface::tributary::Depth;
use crate::mesh::{ElementGroup, Mesh};
use crate::model::{self, ContactLaw, Interface, Model, Penalty, PenaltySource};
use crate::rigid::Bodies;
use crate::step::erosion::Erosion;
use crate::step::free::Groups;
use crate::step::relaxation::Relaxation;
use crate::step::{CHUNK, Governor, System};
use embate_lanes::{Level, Team};
use std::cell::OnceCell;
use std::collections::BTreeMap;

/// Below so many elements threads cost more than they bring.
const SERIAL: usize = 4096;

/// Builds the system; with it come all warnings of the model.
///
/// # Errors
/// All faults of the model.
pub fn system<const D: usize>(model: &Model, level: Level, threads: usize) -> Result<(System<D>, Vec<Warning>), Vec<Fault>>
where
    Dim<D>: Builds<D>,
{
    let faults = model.check();
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut warnings = model.warnings();
    let mesh = Mesh::new(model)?;
    let with_axis = <Dim<D>>::with_axis(model, &mesh)?;
    let model = with_axis.as_ref().unwrap_or(model);
    let curves = Curves::new(model);
    let joins = Joins::new(model, &mesh)?;
    let mut builder = Builder {
        model,
        faults: Vec::new(),
        body_of_node: mesh.bodies(),
        constraints: Constraints::new(model, &mesh, &curves, &joins)?,
        joins,
        curves,
        positions: mesh.positions.clone(),
        mass: vec![0.0; mesh.positions.len()],
        body_parts: Vec::new(),
        fans: OnceCell::new(),
        moduli: Vec::new(),
        time_step: 0.0,
        bodies: Bodies::default(),
        terms: Vec::new(),
        outlines: Vec::new(),
        made: BTreeMap::new(),
        again: false,
        mesh,
    };
    warnings.extend(idle::warnings(model, &builder.mesh, &builder.body_of_node));
    // Found before there are blocks, because the facets of all elements are large; told of at its place.
    let touches = !(model.contacts.is_empty() && model.obstacles.is_empty());
    let outside = builder.outside(touches);
    let initial_penetrations = <Dim<D>>::part_at_start(&mut builder);
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    let mut blocks = builder.blocks();
    if blocks.len() < builder.mesh.groups.len() {
        return Err(builder.faults);
    }
    let mut part_mass_true = part_masses(&builder.mesh, &blocks);
    builder.point_masses(&mut part_mass_true);
    let mass_added = builder.scale_mass(&mut blocks, level);
    let is_scaled = model.run.mass_scaling.is_some() || model.parts.iter().any(|part| part.mass_scale != 1.0);
    let part_mass_scaled = is_scaled.then(|| {
        let mut part_mass = part_masses(&builder.mesh, &blocks);
        builder.point_masses(&mut part_mass);
        part_mass
    });
    let part_mass = part_mass_scaled.as_ref().unwrap_or(&part_mass_true);
    for &(node, share) in part_mass.iter().flatten() {
        builder.mass[node as usize] += share;
    }
    // What is added to resist motion weighs nothing.
    let body_forces = BodyForces::new(model, &builder.mesh, &builder.curves, &builder.mass, &part_mass_true);
    let mut damping = Damping::new(model, &builder.mesh, &builder.mass, part_mass);
    if model.run.relaxation.is_some() {
        damping.relax(0.0);
    }
    let velocities = builder.velocities(part_mass);
    builder.rigid_parts(part_mass);
    let shares = builder.shares(&blocks, part_mass);
    // From here on masses are those of nodes, and of parts as a whole: each list of them is as large as all
    // positions.
    blocks.iter_mut().for_each(|block| block.release_corner_masses());
    drop((part_mass_scaled, part_mass_true));
    builder.measure_stiffness(&mut blocks, level);
    let springs = builder.springs().map(|springs| Box::new(springs) as Box<dyn Block<D>>);
    let (forces, boundary) = builder.loads();
    let mut contacts = <Dim<D>>::contacts(&mut builder);
    contacts.extend(<Dim<D>>::obstacles(&mut builder));
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    builder.bodies.weigh(&body_forces, &builder.mass);
    let criteria = builder.criteria(&blocks);
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    blocks.iter_mut().zip(&criteria).filter(|(_, criteria)| !criteria.is_empty()).for_each(|(block, _)| block.keep_forces());
    let outside = if touches == contacts.is_empty() { builder.outside(!touches) } else { outside }.map_err(|fault| vec![fault]);
    let Builder { mesh, constraints, joins, curves, positions, mass, body_parts, bodies, terms, outlines, moduli, time_step, .. } = builder;
    let origin = || Box::new(Origin { model: model.clone(), fans: Fans::of(&mesh), moduli, time_step, positions: positions.clone() });
    let erosion = criteria.iter().any(|criteria| !criteria.is_empty()).then(|| Box::new(Erosion::new(criteria, origin())));
    let elements: usize = blocks.iter().map(|block| block.elements()).sum();
    let has_springs = springs.is_some();
    blocks.extend(springs);
    let nodes = positions.len();
    let assembly = Assembly::new(nodes, &blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
    let mut velocities = velocities;
    velocities.resize(nodes, [0.0; D]);
    let outside = outside?;
    let limits = limits::of(model, &mesh, &blocks, &outside);
    // Without contacts there is nothing to remember of any node.
    let touched = if contacts.is_empty() { 0 } else { nodes };
    let traces = Traces::new(outside, &mesh.positions[..touched.min(mesh.positions.len())], Depth::of(model));
    let run = &model.run;
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
        relaxation: run.relaxation.map(|relaxation| Relaxation::new(relaxation, nodes)),
        step: 0,
        time: 0.0,
        time_step_old: 0.0,
        time_step: 0.0,
        governor: Governor::Schedule,
        team: if elements >= SERIAL { Team::new(threads) } else { Team::alone() },
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
        boundary,
        joins,
        outlines,
        traces,
        constraints,
        limits,
        level,
        of_revolution: model.is_axisymmetric(),
    };
    system.find_free_nodes();
    Ok((system, warnings))
}

/// A system while it is built.
pub struct Builder<'a, const D: usize>
where
    Dim<D>: Builds<D>,
{
    model: &'a Model,
    mesh: Mesh<D>,
    /// Body that each node of the mesh belongs to.
    body_of_node: Vec<u32>,
    constraints: Constraints<D>,
    joins: Joins<D>,
    curves: Curves,
    faults: Vec<Fault>,
    /// Initial positions of all nodes, m: those of elements, then those of obstacles.
    positions: Vec<[f64; D]>,
    /// Their masses, kg/m; 1 where an obstacle has a node.
    mass: Vec<f64>,
    /// Which elements are at which nodes; found when the first edge asks.
    fans: OnceCell<Fans>,
    /// Wave modulus and bulk modulus of each group of elements, Pa.
    moduli: Vec<[f64; 2]>,
    /// First time step, s; only where a contact asks for it.
    time_step: f64,
    bodies: Bodies<D>,
    /// Rigid parts and their bodies.
    body_parts: Vec<(usize, usize)>,
    /// What acts in contacts, ties and obstacles, as they are made.
    terms: Vec<Terms>,
    outlines: Vec<OutlineShape<D>>,
    /// Rigid bodies of the obstacles by name, where they are there already.
    made: BTreeMap<String, usize>,
    /// Whether contacts are made again, of changed surfaces.
    again: bool,
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// The outside of all bodies. Made only to be told of elements that overlap where nothing `touches`. A
    /// symmetry line is no surface: pressures count the length on the model's side.
    fn outside(&self, touches: bool) -> Result<Surface<D>, Fault> {
        self.mesh.outside_without(&[], |segment| !touches || self.constraints.is_mirror(segment))
    }

    /// A block for each group of elements.
    fn blocks(&mut self) -> Vec<Box<dyn Block<D>>> {
        let mut blocks = Vec::new();
        for group in &self.mesh.groups {
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
            let viscosity = self.model.run.bulk_viscosity;
            let input = BlockInput {
                area: part.area.unwrap_or(0.0),
                damping: self.model.stiffness_damping(part),
                options: ElementOptions { hourglass: part.hourglass },
                stress_state: if D == 2 { &part.stress_state } else { "" },
                viscosity: (viscosity != [0.0; 2]).then_some(viscosity),
                ..BlockInput::new(element, material, &group.connectivity, &self.mesh.positions)
            };
            match make(&input) {
                Some(mut block) => {
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

    /// What the stiffness of contacts is made from beyond the elements behind their surfaces: moduli and the
    /// first step.
    fn measure_stiffness(&mut self, blocks: &mut [Box<dyn Block<D>>], level: Level) {
        self.moduli = blocks.iter().map(|block| [block.wave_modulus(), block.bulk_modulus()]).collect();
        let interfaces = self.model.contacts.iter().map(|c| &c.interface).chain(self.model.obstacles.iter().map(|o| &o.interface));
        let is_asked = interfaces.into_iter().any(|interface| source_of(interface) == PenaltySource::TimeStep);
        // Springs of the automatic penalty between bodies stiffen by it, too.
        let stiffens = |contact: &model::Contact| matches!(contact.interface.law, ContactLaw::Penalty(Penalty::Automatic { .. }));
        if is_asked || self.model.contacts.iter().any(stiffens) {
            let velocities = vec![[0.0; D]; self.mesh.positions.len()];
            let motion = Motion { positions: &self.mesh.positions, velocities: &velocities, time_step: 0.0 };
            let stable = |(block, group): (&mut Box<dyn Block<D>>, &ElementGroup)| {
                if self.model.parts[group.part].rigid.is_some() {
                    return f64::INFINITY;
                }
                let mut slots = vec![[0.0; D]; block.slots().len()];
                block.advance(&motion, level, &mut slots, &mut Team::alone()).time_step_squared
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

    /// Stiffness of a node by its mass and the first step, of the area that it stands for, Pa/m; zero where
    /// the step was not asked for.
    fn of_mass(&self, node: u32, area: f64) -> f64 {
        if self.time_step > 0.0 { law::penalty::of_time_step(self.mass[node as usize], self.time_step, area) } else { 0.0 }
    }

    /// Forces on nodes, and boundaries that reflect nothing.
    fn loads(&mut self) -> (Forces<D>, NonReflecting<D>) {
        let forces = Forces::new(self.model, &self.mesh, &self.curves, |facet| self.constraints.is_mirror(facet));
        let behind = |facet| {
            let under = self.under(facet)?;
            let part = &self.model.parts[self.mesh.groups[under.group].part];
            let density = *self.model.materials.get(&part.material)?.parameters.get("density")?;
            Some(Behind { density, moduli: self.moduli[under.group] })
        };
        let boundary = NonReflecting::new(self.model, &self.mesh, |facet| self.constraints.is_mirror(facet), behind);
        let mut faults = Vec::new();
        let made = (told(forces, &mut faults), told(boundary, &mut faults));
        self.faults.extend(faults);
        made
    }

    /// Tells if nodes are bound already (`tied`: which contact binds a node): two ties would hold against
    /// each other.
    fn tied_once<'m>(&mut self, path: &str, contact: &'m str, nodes: &[u32], tied: &mut BTreeMap<u32, &'m str>) {
        let twice = nodes.iter().find_map(|&node| Some((node, *tied.get(&node)?)));
        if let Some((node, other)) = twice {
            let at = vector::place(self.mesh.positions[node as usize]);
            self.faults.push(Fault::new(
                &TIED_TWICE,
                path,
                format!("the node at {at} m is tied already by contact \"{other}\""),
                "leave one of the two ties out, name smaller surfaces, or let the other surface be the slave",
            ));
        }
        tied.extend(nodes.iter().map(|&node| (node, contact)));
    }

    /// Adds what acts in springs; returns its number.
    fn add_terms(&mut self, terms: Terms) -> usize {
        self.terms.push(terms);
        self.terms.len() - 1
    }
}

/// What was made, or its faults noted and what stands in for it.
fn told<T: Default>(made: Result<T, Vec<Fault>>, faults: &mut Vec<Fault>) -> T {
    made.unwrap_or_else(|wrong| {
        faults.extend(wrong);
        T::default()
    })
}

fn law_of(interface: &Interface) -> Box<dyn Law> {
    match &interface.law {
        ContactLaw::Penalty(_) => Box::new(law::penalty::Penalty),
        ContactLaw::PressureGap { gaps, pressures } => Box::new(law::pressure_gap::PressureGap::new(gaps, pressures)),
        ContactLaw::Multiplier => Box::new(law::multiplier::Multiplier),
    }
}

/// What acts in the springs of an interface.
fn terms_of(interface: &Interface) -> Terms {
    let tangential = interface.friction.map_or(Tangential::Free, |friction| {
        let model::Friction { coefficient, dynamic, decay, viscosity, limit } = friction;
        Tangential::Friction(Friction { coefficient, dynamic: dynamic.unwrap_or(coefficient), decay, viscosity, limit })
    });
    Terms { law: law_of(interface), tangential, damping: interface.damping }
}

/// What acts in the ties of an interface.
fn terms_of_ties(interface: &Interface) -> Terms {
    let rigid = matches!(interface.law, ContactLaw::Multiplier);
    Terms { law: Box::new(law::tie::Tie { rigid }), tangential: Tangential::Tied, damping: 0.0 }
}

/// Stiffness of a slave node.
fn stiffness_of(interface: &Interface, node: law::Node, passes: usize) -> f64 {
    law::penalty::stiffness(law::penalty::penalty_of(interface), node, passes)
}

/// How nodes of this spacing (m) meet an obstacle.
fn manner(interface: &Interface, spacing: f64) -> Manner {
    Manner {
        reach: SKIN * spacing + law_of(interface).reach(),
        factor: law::penalty::at_obstacles(law::penalty::penalty_of(interface)),
        ignores_start: is_ignored(interface),
    }
}

/// What an automatic penalty is made from; of laws without a penalty the default.
fn source_of(interface: &Interface) -> PenaltySource {
    match interface.law {
        ContactLaw::Penalty(Penalty::Automatic { source, .. }) => source,
        _ => PenaltySource::default(),
    }
}

fn search_by_name<const D: usize>(name: &str) -> Option<SearchKind<D>> {
    let registry = search::registry::<D>();
    if name.is_empty() { registry.first().copied() } else { registry.into_iter().find(|kind| kind.name == name) }
}
