//! The builder: from a model to a [`System`] with mesh, blocks, masses, contacts, obstacles, rigid bodies and
//! conditions. All faults are collected before anything runs.

mod rebuild;
pub(crate) mod remeshing;
mod bodies;
mod connections;
mod contacts;
mod dimension;
mod discrete;
mod failure;
mod hinges;
mod node_elements;
mod idle;
mod locking;
pub(crate) mod inside_out;
mod normals;
mod limits;
mod mass;
mod mirrors;
mod obstacles;
mod outline;
pub(crate) mod plane;
mod passing;
mod sizes;
mod space;
mod space_obstacles;
mod stages;
mod start;
mod surfaces;
mod triangles;

use crate::contact::initial::is_ignored;
use crate::contact::law::{self, Law};
use crate::contact::messages::TIED_TWICE;
use crate::contact::obstacle::{Manner, OutlineShape};
use crate::contact::search;
use crate::contact::search::SearchKind;
use crate::contact::springs::friction::Friction;
use crate::contact::springs::{Tangential, Terms};
use crate::contact::tracker::SKIN;
use crate::error::{Fault, Warning};
use crate::load::constraint::Constraints;
use crate::load::curve::Curves;
use crate::load::join::Joins;
use crate::mesh::Mesh;
use crate::model::{self, ContactLaw, Interface, Model, Penalty, PenaltySource};
use crate::rigid::Bodies;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector;
pub use dimension::Builds;
use embate_lanes::Level;
use node_elements::NodeElements;
use std::cell::OnceCell;
use std::collections::BTreeMap;

/// Below so many elements threads cost more than they bring.
pub(crate) const SERIAL: usize = 4096;

/// Builds the system of a model at time zero, on a mesh that stands for the model's (`None`: its own); with
/// it come all warnings of the model.
///
/// # Errors
/// All faults of the model.
pub fn system<const D: usize>(
    model: &Model,
    mesh: Option<Mesh<D>>,
    level: Level,
    threads: usize,
) -> Result<(System<D>, Vec<Warning>), Vec<Fault>>
where
    Dim<D>: Builds<D>,
{
    let faults = model.check();
    if !faults.is_empty() {
        let of_mesh = model.check_mesh(&faults);
        return Err(faults.into_iter().chain(of_mesh).collect());
    }
    let mut warnings = model.warnings();
    let with_windows = model.with_windows();
    let model = with_windows.as_ref().unwrap_or(model);
    let mesh = mesh.map_or_else(|| Mesh::new(model), Ok)?;
    let (system, of_mesh) = system_of(model, mesh, level, threads)?;
    warnings.extend(of_mesh);
    Ok((system, warnings))
}

impl Model {
    /// Faults of the mesh of a model that has other `faults`: as far as none of those keeps it from being
    /// meshed, so that all are reported at once.
    #[must_use]
    pub fn check_mesh(&self, faults: &[Fault]) -> Vec<Fault> {
        let is_of_parts = |fault: &Fault| fault.path.is_empty() || (fault.path.starts_with("part") && !fault.path.ends_with(".material"));
        let is_there = self.parts.iter().all(|part| !self.lacks_mesh(part));
        if self.parts.is_empty() || faults.iter().any(is_of_parts) || !is_there {
            return Vec::new();
        }
        let of_mesh = if self.dimension() == 3 { Mesh::<3>::new(self).err() } else { Mesh::<2>::new(self).err() };
        of_mesh.unwrap_or_default()
    }
}

/// The system of a checked model on a mesh of it, at time zero; with it come the warnings that need the mesh.
///
/// # Errors
/// All faults of the first stage that has any.
fn system_of<const D: usize>(model: &Model, mesh: Mesh<D>, level: Level, threads: usize) -> Result<(System<D>, Vec<Warning>), Vec<Fault>>
where
    Dim<D>: Builds<D>,
{
    let with_axis = <Dim<D>>::with_axis(model, &mesh)?;
    let mut builder = Builder::new(with_axis.as_ref().unwrap_or(model), mesh)?;
    let (passing, of_pairs) = passing::warnings(&builder);
    let mut warnings = idle::warnings(builder.model, &builder.mesh, &builder.body_of_node);
    // Of what others go through it is said already.
    warnings.retain(|idle| of_pairs.iter().all(|part| idle.path != format!("part[{part}]")));
    warnings.extend(passing);
    warnings.extend(sizes::warnings(builder.model, &builder.mesh));
    warnings.extend(normals::warnings(builder.model, &builder.mesh));
    warnings.extend(locking::warnings(builder.model, &builder.mesh));
    warnings.extend(hinges::warnings(builder.model, &builder.mesh, &builder.joins));
    builder.faults.extend(remeshing::faults(builder.model, &builder.mesh));
    // What is wrong at the start and what is wrong with conditions has nothing to do with each other.
    let start = builder.start();
    let conditions = builder.elements(level).and_then(|elements| Ok((builder.conditions(&elements)?, elements)));
    let (start, (conditions, elements)) = match (start, conditions) {
        (Ok(start), Ok(conditions)) => (start, conditions),
        (start, conditions) => return Err(start.err().into_iter().chain(conditions.err()).flatten().collect()),
    };
    let outside = builder.outside_of(start.outside, &conditions.contacts)?;
    Ok((builder.assembled(elements, conditions, outside, start.penetrations, level, threads), warnings))
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
    /// What holds nodes in the first stage, and in the later ones.
    constraints: Constraints<D>,
    later_constraints: Vec<Constraints<D>>,
    joins: Joins<D>,
    curves: Curves,
    faults: Vec<Fault>,
    /// Initial positions of all nodes, m: those of elements, then those of obstacles.
    positions: Vec<[f64; D]>,
    /// Their masses, kg/m; 1 where an obstacle has a node.
    mass: Vec<f64>,
    /// Which elements are at which nodes; found when the first edge asks.
    node_elements: OnceCell<NodeElements>,
    /// Moduli of each group of elements, of waves, bulk and shear, Pa.
    moduli: Vec<[f64; 3]>,
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
    rebuild: bool,
}

impl<'a, const D: usize> Builder<'a, D>
where
    Dim<D>: Builds<D>,
{
    /// Names are resolved, and what is prescribed is known; nothing else is made.
    fn new(model: &'a Model, mesh: Mesh<D>) -> Result<Self, Vec<Fault>> {
        let curves = Curves::new(model);
        let joins = Joins::new(model, &mesh)?;
        let of_stage = |stage| Constraints::new(model, &mesh, &curves, &joins, stage);
        Ok(Self {
            constraints: of_stage(0)?,
            later_constraints: (1..model.stages.len()).map(of_stage).collect::<Result<_, _>>()?,
            positions: mesh.references().into_owned(),
            mass: vec![0.0; mesh.positions.len()],
            ..Self::of(model, mesh, joins, curves)
        })
    }

    /// One with a mesh alone.
    fn of(model: &'a Model, mesh: Mesh<D>, joins: Joins<D>, curves: Curves) -> Self {
        Self {
            model,
            body_of_node: mesh.bodies(),
            mesh,
            constraints: Constraints::default(),
            later_constraints: Vec::new(),
            joins,
            curves,
            faults: Vec::new(),
            positions: Vec::new(),
            mass: Vec::new(),
            node_elements: OnceCell::new(),
            moduli: Vec::new(),
            time_step: 0.0,
            bodies: Bodies::default(),
            body_parts: Vec::new(),
            terms: Vec::new(),
            outlines: Vec::new(),
            made: BTreeMap::new(),
            rebuild: false,
        }
    }
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// Stiffness of a node by its mass and the first step, of the area that it stands for, Pa/m; zero where
    /// the step was not asked for.
    fn of_mass(&self, node: u32, area: f64) -> f64 {
        if self.time_step > 0.0 { law::penalty::of_time_step(self.mass_behind(node), self.time_step, area) } else { 0.0 }
    }

    /// Mass that moves with a node of a surface, kg/m: of a shell's face half of that of the middle.
    fn mass_behind(&self, node: u32) -> f64 {
        let skin = (node as usize).checked_sub(self.mesh.first_skin_node()).and_then(|own| self.mesh.skins.get(own));
        skin.map_or_else(|| self.mass[node as usize], |skin| 0.5 * self.mass[skin.owner as usize])
    }

    /// Reports if nodes are bound already (`tied`: which contact binds a node): two ties would hold against
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
    Terms { law: Box::new(law::tie::Tie { rigid, joins_ends: false }), tangential: Tangential::Tied, damping: 0.0 }
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
