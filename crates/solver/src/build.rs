//! From a model to a [`System`]: mesh, blocks, masses, contacts, obstacles, rigid bodies, conditions. All faults are collected before anything runs.

mod bodies;
mod obstacles;

use crate::assembly::Assembly;
use crate::block::{Block, BlockInput, Report, make};
use crate::contact::law::{self, Law};
use crate::contact::node_segment::{NodeSegment, Slave};
use crate::contact::obstacle::OutlineShape;
use crate::contact::projection::node_segment::Target;
use crate::contact::search::Search;
use crate::contact::springs::friction::Friction;
use crate::contact::springs::{Springs, Tangential, Terms};
use crate::contact::traces::Traces;
use crate::contact::tracker::Tracker;
use crate::contact::{self, Contact, ContactKind, search};
use crate::energy::{Ledger, Sums};
use crate::error::Fault;
use crate::load::constraint::Constraints;
use crate::load::curve::Curves;
use crate::load::damping::Damping;
use crate::load::gravity;
use crate::mesh::surface::{NONE, Surface};
use crate::mesh::{Mesh, PartMesh};
use crate::model::{self, ContactLaw, Formulation, Interface, Model, Partners, Penalty};
use crate::rigid::Bodies;
use crate::step::{CHUNK, Governor, Limits, System};
use embate_lanes::{Batch, Level};

/// Below so many elements threads cost more than they bring.
const SERIAL: usize = 4096;

/// Builds the system.
///
/// # Errors
/// All faults of the model.
pub fn system(model: &Model, level: Level, threads: usize) -> Result<System, Vec<Fault>> {
    let faults = model.check();
    if !faults.is_empty() {
        return Err(faults);
    }
    let mesh = Mesh::new(model)?;
    let curves = Curves::new(model);
    let mut builder = Builder {
        model,
        faults: Vec::new(),
        constraints: Constraints::new(model, &mesh, &curves)?,
        curves,
        positions: mesh.positions.clone(),
        mass: vec![0.0; mesh.positions.len()],
        body_parts: Vec::new(),
        under: Vec::new(),
        bodies: Bodies::default(),
        terms: Vec::new(),
        outlines: Vec::new(),
        mesh,
    };
    let blocks = builder.blocks();
    if blocks.len() < model.parts.len() {
        return Err(builder.faults);
    }
    let part_mass = part_masses(&builder.mesh, &blocks);
    for &(node, share) in part_mass.iter().flatten() {
        builder.mass[node as usize] += share;
    }
    let gravity = gravity::accelerations(model, &builder.mesh, &builder.mass, &part_mass);
    let damping = Damping::new(model, &builder.mesh, &builder.mass, &part_mass);
    let mut velocities = builder.velocities(&part_mass);
    builder.rigid_parts(&part_mass, &gravity);
    builder.find_elements_under_surfaces(&blocks);
    let mut contacts = builder.contacts();
    contacts.extend(builder.obstacles());
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    let Builder { mesh, constraints, curves, positions, mass, body_parts, bodies, terms, outlines, .. } = builder;
    let inputs: Vec<(&dyn Block<2>, usize, &[u32])> =
        blocks.iter().zip(&mesh.parts).map(|(block, part)| (block.as_ref(), part.nodes_per_element, &part.connectivity[..])).collect();
    let nodes = positions.len();
    let assembly = Assembly::new(nodes, &inputs);
    velocities.resize(nodes, [0.0; 2]);
    let outside = if contacts.is_empty() { Surface::default() } else { mesh.outside(&[]).map_err(|fault| vec![fault])? };
    let traces = Traces::new(outside, &mesh.positions);
    let limits =
        Limits { end: model.run.end, safety: model.run.safety, energy: model.run.energy_limit, step: model.run.step_limit.unwrap_or(0.0) };
    let elements: usize = blocks.iter().map(|block| block.elements()).sum();
    Ok(System {
        corners: vec![Batch::default(); assembly.corner_batches],
        rigid: model.parts.iter().map(|part| part.rigid.is_some()).collect(),
        positions_old: positions.clone(),
        positions,
        velocities_old: velocities.clone(),
        velocities,
        contact_forces: vec![[0.0; 2]; nodes],
        springs: Springs::new(nodes, bodies.len()),
        reports: vec![Report::NOTHING; blocks.len()],
        sums: vec![Sums::default(); nodes.div_ceil(CHUNK)],
        of_bodies: Sums::default(),
        ledger: Ledger::default(),
        penetration_max: 0.0,
        step: 0,
        time: 0.0,
        time_step_old: 0.0,
        time_step: 0.0,
        governor: Governor::Schedule,
        parallel: threads > 1 && elements >= SERIAL,
        mesh,
        blocks,
        assembly,
        mass,
        contacts,
        terms,
        bodies,
        body_parts,
        curves,
        damping,
        gravity,
        outlines,
        traces,
        constraints,
        limits,
        level,
    })
}

/// Mass of each part on each of its nodes, kg/m, nodes ascending.
pub(crate) fn part_masses(mesh: &Mesh<2>, blocks: &[Box<dyn Block<2>>]) -> Vec<Vec<(u32, f64)>> {
    let of = |(part, block): (&PartMesh, &dyn Block<2>)| {
        let mut sums = vec![0.0; mesh.positions.len()];
        for (k, &node) in part.connectivity.iter().enumerate() {
            sums[node as usize] += block.corner_mass(k / part.nodes_per_element, k % part.nodes_per_element);
        }
        let mut nodes = part.nodes.clone();
        nodes.sort_unstable();
        nodes.into_iter().map(|node| (node, sums[node as usize])).collect()
    };
    mesh.parts.iter().zip(blocks.iter().map(AsRef::as_ref)).map(of).collect()
}

struct Builder<'a> {
    model: &'a Model,
    mesh: Mesh<2>,
    constraints: Constraints<2>,
    curves: Curves,
    faults: Vec<Fault>,
    /// Initial positions of all nodes, m: those of elements, then those of obstacles.
    positions: Vec<[f64; 2]>,
    /// Their masses, kg/m; 1 where an obstacle has a node.
    mass: Vec<f64>,
    /// Pressure stiffness κ = (K + 4µ/3) L / A of the element behind each edge as an outside segment, Pa/m; sorted by nodes.
    under: Vec<([u32; 2], f64)>,
    bodies: Bodies,
    /// Rigid parts and their bodies.
    body_parts: Vec<(usize, usize)>,
    /// What acts in each contact, then in each obstacle.
    terms: Vec<Terms>,
    outlines: Vec<OutlineShape>,
}

impl Builder<'_> {
    fn blocks(&mut self) -> Vec<Box<dyn Block<2>>> {
        let mut blocks = Vec::new();
        for (i, (part, mesh)) in self.model.parts.iter().zip(&self.mesh.parts).enumerate() {
            let Some(material) = self.model.materials.get(&part.material) else {
                self.faults.push(Fault::new(
                    format!("part[{i}].material"),
                    format!("there is no material \"{}\"", part.material),
                    "define it",
                ));
                continue;
            };
            let input = BlockInput { element: &part.element, material, connectivity: &mesh.connectivity, positions: &self.mesh.positions };
            match make(&input) {
                Some(block) => blocks.push(block),
                None => self.faults.push(Fault::new(format!("part[{i}]"), "its element or law is unknown", "see `embate list`")),
            }
        }
        blocks
    }

    /// Stiffness of the elements behind every edge, for the automatic penalty.
    fn find_elements_under_surfaces(&mut self, blocks: &[Box<dyn Block<2>>]) {
        for (part, block) in self.mesh.parts.iter().zip(blocks) {
            for cell in part.connectivity.chunks_exact(part.nodes_per_element) {
                let x = |corner: usize| self.mesh.positions[cell[corner % cell.len()] as usize];
                let area = 0.5 * (0..cell.len()).map(|c| x(c)[0] * x(c + 1)[1] - x(c)[1] * x(c + 1)[0]).sum::<f64>();
                for c in 0..cell.len() {
                    let (a, b) = (x(c), x(c + 1));
                    let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
                    // Outside segments run against the element's own direction.
                    self.under.push(([cell[(c + 1) % cell.len()], cell[c]], block.wave_modulus() * length / area));
                }
            }
        }
        self.under.sort_unstable_by_key(|&(nodes, _)| nodes);
    }

    fn stiffness_under(&self, surface: &Surface) -> Vec<f64> {
        let of = |segment: &[u32; 2]| self.under.binary_search_by_key(segment, |&(nodes, _)| nodes).map_or(0.0, |at| self.under[at].1);
        surface.segments.iter().map(of).collect()
    }

    fn contacts(&mut self) -> Vec<Contact> {
        let mut contacts = Vec::new();
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let Partners::Between(between) = &contact.partners else { continue };
            let sides = [0, 1].map(|side| self.target(&between[side]).map_err(|fault| (side, fault)));
            let targets = match sides {
                [Ok(first), Ok(second)] => [first, second],
                faulty => {
                    for (side, fault) in faulty.into_iter().filter_map(Result::err) {
                        self.faults.push(Fault { path: format!("contact[{i}].between[{side}]"), ..fault });
                    }
                    continue;
                }
            };
            let Some(search) = search_by_name(&contact.search) else {
                self.faults.push(Fault::new(
                    format!("contact[{i}].search"),
                    format!("there is no search \"{}\"", contact.search),
                    "see `embate list searches`",
                ));
                continue;
            };
            let terms = terms(&contact.interface);
            let formulation = self.node_segment(contact, targets, search, terms.law.reach());
            self.terms.push(terms);
            contacts.push(Contact::new(contact.name.clone(), ContactKind::Contact, Box::new(formulation), contact.interface.active));
        }
        contacts
    }

    fn node_segment(&self, contact: &model::Contact, targets: [Target; 2], search: Box<dyn Search<2>>, reach: f64) -> NodeSegment {
        let passes: &[(usize, usize)] = match contact.formulation {
            Formulation::SinglePass { slave: 0 } => &[(0, 1)],
            Formulation::SinglePass { .. } => &[(1, 0)],
            _ => &[(0, 1), (1, 0)],
        };
        let stiffness = [0, 1].map(|surface: usize| self.stiffness_under(&targets[surface].surface));
        let softest = |surface: usize| stiffness[surface].iter().copied().fold(f64::INFINITY, f64::min);
        let pass = |&(slave, target): &(usize, usize)| {
            let Target { surface, mirrors } = &targets[slave];
            let nodes = contact::node_stiffness(surface, &stiffness[slave], &self.mesh.positions);
            let other = softest(target);
            let of = |(&(tributary, own), node): (&(f64, f64), &u32)| {
                let on_line = mirrors.binary_search_by_key(node, |&(node, _)| node).is_ok();
                let node = law::Node { tributary, own, other, share: if on_line { 0.5 } else { 1.0 } };
                Slave { stiffness: stiffness_of(&contact.interface, node, passes.len()), area: tributary / passes.len() as f64, slip: 0.0 }
            };
            nodes.iter().zip(&surface.nodes).map(of).collect()
        };
        let slaves = passes.iter().map(pass).collect();
        let tracker = Tracker::new(targets.into(), passes, search, &self.mesh.positions);
        NodeSegment::new(tracker, slaves, contact.interface.thickness, reach)
    }

    /// A surface without the segments on symmetry lines, and the normals of the lines at the ends that this leaves open.
    fn target(&self, name: &str) -> Result<Target, Fault> {
        let surface = self.mesh.surface(name, |segment| self.constraints.is_mirror(segment))?;
        if surface.segments.is_empty() {
            return Err(Fault::new("", format!("surface \"{name}\" lies on a symmetry line altogether"), "name another surface"));
        }
        Ok(self.with_mirrors(surface))
    }

    /// A surface as a target that goes on beyond symmetry lines.
    fn with_mirrors(&self, surface: Surface) -> Target {
        let starts =
            surface.segments.iter().zip(&surface.previous).filter(|(_, previous)| **previous == NONE).map(|(segment, _)| segment[0]);
        let ends = surface.segments.iter().zip(&surface.next).filter(|(_, next)| **next == NONE).map(|(segment, _)| segment[1]);
        let open = starts.chain(ends);
        let mut mirrors: Vec<(u32, [f64; 2])> =
            open.filter_map(|node| Some((node, self.constraints.mirror_normals(node).next()?))).collect();
        mirrors.sort_by_key(|&(node, _)| node);
        Target { surface, mirrors }
    }
}

/// What acts in the springs of an interface.
fn terms(interface: &Interface) -> Terms {
    let law: Box<dyn Law> = match &interface.law {
        ContactLaw::Penalty(_) => Box::new(law::penalty::Penalty),
        ContactLaw::PressureGap { gaps, pressures } => Box::new(law::pressure_gap::PressureGap::new(gaps, pressures)),
        ContactLaw::Multiplier => Box::new(law::multiplier::Multiplier),
    };
    let tangential = interface.friction.map_or(Tangential::Free, |friction| {
        let model::Friction { coefficient, dynamic, decay, viscosity, limit } = friction;
        Tangential::Friction(Friction { coefficient, dynamic: dynamic.unwrap_or(coefficient), decay, viscosity, limit })
    });
    Terms { law, tangential, damping: interface.damping }
}

/// Stiffness of a slave node; of laws without a penalty that of the automatic one, for what needs a scale.
fn stiffness_of(interface: &Interface, node: law::Node, passes: usize) -> f64 {
    let penalty = if let ContactLaw::Penalty(penalty) = interface.law { penalty } else { Penalty::default() };
    law::penalty::stiffness(penalty, node, passes)
}

fn search_by_name(name: &str) -> Option<Box<dyn Search<2>>> {
    let registry = search::registry::<2>();
    let kind = if name.is_empty() { registry.first() } else { registry.iter().find(|kind| kind.name == name) };
    kind.map(|kind| (kind.make)())
}
