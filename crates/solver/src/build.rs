//! From a model to a [`System`]: mesh, blocks, masses, contacts, walls, conditions. All faults are collected before anything runs.

use crate::assembly::Assembly;
use crate::block::{Block, BlockInput, Report, make};
use crate::contact::projection::node_segment::Target;
use crate::contact::search::Search;
use crate::contact::springs::Springs;
use crate::contact::{self, Contact, ContactInput, law, search};
use crate::energy::Ledger;
use crate::error::Fault;
use crate::load::constraint::{Constraints, unit};
use crate::load::{gravity, wall::Wall};
use crate::mesh::surface::{NONE, Surface};
use crate::mesh::{Mesh, PartMesh};
use crate::model::{ContactLaw, Model, ObstacleShape, Partners};
use crate::step::{CHUNK, Governor, Limits, NodeSums, System};
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
    let mut builder = Builder { model, faults: Vec::new(), constraints: Constraints::new(model, &mesh)?, under: Vec::new(), mesh };
    let blocks = builder.blocks();
    if blocks.len() < model.parts.len() {
        return Err(builder.faults);
    }
    builder.find_elements_under_surfaces(&blocks);
    let contacts = builder.contacts();
    let walls = builder.walls();
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    let Builder { mesh, constraints, .. } = builder;
    let inputs: Vec<(&dyn Block<2>, usize, &[u32])> =
        blocks.iter().zip(&mesh.parts).map(|(block, part)| (block.as_ref(), part.nodes_per_element, &part.connectivity[..])).collect();
    let nodes = mesh.positions.len();
    let assembly = Assembly::new(nodes, &inputs);
    let part_mass = part_masses(&mesh, &blocks);
    let mut mass = vec![0.0; nodes];
    let mut momentum = vec![[0.0; 2]; nodes];
    for (masses, part) in part_mass.iter().zip(&model.parts) {
        for &(node, share) in masses {
            mass[node as usize] += share;
            for d in 0..2 {
                momentum[node as usize][d] += share * part.velocity[d];
            }
        }
    }
    let velocities: Vec<[f64; 2]> = momentum.iter().zip(&mass).map(|(p, &m)| p.map(|p| p / m)).collect();
    let limits =
        Limits { end: model.run.end, safety: model.run.safety, energy: model.run.energy_limit, step: model.run.step_limit.unwrap_or(0.0) };
    let elements: usize = blocks.iter().map(|block| block.elements()).sum();
    Ok(System {
        corners: vec![Batch::default(); assembly.corner_batches],
        gravity: gravity::accelerations(model, &mesh, &mass, &part_mass),
        positions: mesh.positions.clone(),
        positions_old: mesh.positions.clone(),
        velocities_old: velocities.clone(),
        velocities,
        contact_forces: vec![[0.0; 2]; nodes],
        springs: Springs::new(nodes),
        reports: vec![Report::NOTHING; blocks.len()],
        sums: vec![NodeSums::default(); nodes.div_ceil(CHUNK)],
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
        walls,
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
    faults: Vec<Fault>,
    /// Pressure stiffness κ = (K + 4µ/3) L / A of the element behind each edge as an outside segment, Pa/m; sorted by nodes.
    under: Vec<([u32; 2], f64)>,
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
            let ContactLaw::Penalty(penalty) = contact.interface.law else { continue };
            let sides = [0, 1].map(|side| self.target(&between[side]).map_err(|fault| (side, fault)));
            let [first, second] = match sides {
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
            let pressure_stiffness = [self.stiffness_under(&first.surface), self.stiffness_under(&second.surface)];
            let input = ContactInput {
                name: contact.name.clone(),
                targets: [first, second],
                pressure_stiffness,
                formulation: contact.formulation,
                penalty,
                search,
            };
            contacts.push(Contact::new(input, &self.mesh.positions));
        }
        contacts
    }

    /// A surface without the segments on symmetry lines, and the normals of the lines at the ends that this leaves open.
    fn target(&self, name: &str) -> Result<Target, Fault> {
        let surface = self.mesh.surface(name, |segment| self.constraints.is_mirror(segment))?;
        if surface.segments.is_empty() {
            return Err(Fault::new("", format!("surface \"{name}\" lies on a symmetry line altogether"), "name another surface"));
        }
        let starts =
            surface.segments.iter().zip(&surface.previous).filter(|(_, previous)| **previous == NONE).map(|(segment, _)| segment[0]);
        let ends = surface.segments.iter().zip(&surface.next).filter(|(_, next)| **next == NONE).map(|(segment, _)| segment[1]);
        let open = starts.chain(ends);
        let mut mirrors: Vec<(u32, [f64; 2])> =
            open.filter_map(|node| Some((node, self.constraints.mirror_normals(node).next()?))).collect();
        mirrors.sort_by_key(|&(node, _)| node);
        Ok(Target { surface, mirrors })
    }

    fn walls(&mut self) -> Vec<Wall> {
        let mut walls = Vec::new();
        for (i, wall) in self.model.obstacles.iter().enumerate() {
            let ObstacleShape::Plane { point, normal, .. } = wall.shape else { continue };
            let ContactLaw::Penalty(penalty) = wall.interface.law else { continue };
            let Some(normal) = unit(normal) else { continue };
            let surface = match self.mesh.outside(&wall.parts) {
                Ok(surface) => surface,
                Err(fault) => {
                    self.faults.push(Fault { path: format!("obstacle[{i}].parts"), ..fault });
                    continue;
                }
            };
            let own = contact::node_stiffness(&surface, &self.stiffness_under(&surface), &self.mesh.positions);
            // Nodes that a symmetry line keeps on this wall need no spring.
            let held = |node: u32| self.constraints.mirror_normals(node).any(|m| (m[0] * normal[1] - m[1] * normal[0]).abs() < 1e-12);
            let stiffness = |(&node, &(length, own)): (&u32, &(f64, f64))| {
                let here = law::Node { tributary: length, own, other: own, share: self.constraints.share(node) };
                (!held(node)).then(|| (node, law::penalty::stiffness(penalty, here, 1)))
            };
            let reach = contact::SKIN * own.iter().map(|&(length, _)| length).sum::<f64>() / own.len().max(1) as f64;
            let nodes = surface.nodes.iter().zip(&own).filter_map(stiffness).collect();
            walls.push(Wall::new(wall.name.clone(), point, normal, nodes, reach));
        }
        walls
    }
}

fn search_by_name(name: &str) -> Option<Box<dyn Search<2>>> {
    let registry = search::registry::<2>();
    let kind = if name.is_empty() { registry.first() } else { registry.iter().find(|kind| kind.name == name) };
    kind.map(|kind| (kind.make)())
}
