//! From a model to a [`System`]: mesh, blocks, masses, contacts, walls, conditions. All faults are collected before anything runs.

use crate::assembly::Assembly;
use crate::block::{Block, BlockInput, Report, make};
use crate::contact::law::{self, Law};
use crate::contact::node_segment::{NodeSegment, PassInput, Slave};
use crate::contact::obstacle::{NodeObstacle, OutlineShape, plane::Plane};
use crate::contact::projection::node_segment::Target;
use crate::contact::search::Search;
use crate::contact::springs::friction::Friction;
use crate::contact::springs::{Springs, Tangential, Terms};
use crate::contact::traces::Traces;
use crate::contact::tracker::{SKIN, Tracker};
use crate::contact::{self, Contact, ContactKind, initial, search};
use crate::energy::Ledger;
use crate::error::Fault;
use crate::load::constraint::{Constraints, unit};
use crate::load::gravity;
use crate::mesh::surface::{NONE, Surface};
use crate::mesh::{Mesh, PartMesh};
use crate::model::{self, ContactLaw, Formulation, InitialPenetration, Interface, Model, ObstacleShape, Partners, Penalty};
use crate::rigid::{Bodies, Body};
use crate::step::{CHUNK, Governor, Limits, NodeSums, System};
use embate_lanes::{Batch, Level};
use std::cell::RefCell;

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
    let mut builder = Builder {
        model,
        faults: Vec::new(),
        constraints: Constraints::new(model, &mesh)?,
        under: Vec::new(),
        bodies: Bodies::default(),
        terms: Vec::new(),
        outlines: Vec::new(),
        mesh,
    };
    let initial_penetrations = builder.part_at_start();
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    let blocks = builder.blocks();
    if blocks.len() < model.parts.len() {
        return Err(builder.faults);
    }
    builder.find_elements_under_surfaces(&blocks);
    let mut contacts = builder.contacts();
    contacts.extend(builder.obstacles());
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    let Builder { mesh, constraints, bodies, terms, outlines, .. } = builder;
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
    let outside = if contacts.is_empty() { Surface::default() } else { mesh.outside(&[]).map_err(|fault| vec![fault])? };
    let traces = Traces::new(outside, &mesh.positions);
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
        springs: Springs::new(nodes, bodies.len()),
        reports: vec![Report::NOTHING; blocks.len()],
        sums: vec![NodeSums::default(); nodes.div_ceil(CHUNK)],
        ledger: Ledger::default(),
        penetration_max: 0.0,
        initial_penetrations,
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
    faults: Vec<Fault>,
    /// Pressure stiffness κ = (K + 4µ/3) L / A of the element behind each edge as an outside segment, Pa/m, and its part; sorted by nodes.
    under: Vec<([u32; 2], f64, u32)>,
    bodies: Bodies,
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
        for (number, (part, block)) in (0..).zip(self.mesh.parts.iter().zip(blocks)) {
            for cell in part.connectivity.chunks_exact(part.nodes_per_element) {
                let x = |corner: usize| self.mesh.positions[cell[corner % cell.len()] as usize];
                let area = 0.5 * (0..cell.len()).map(|c| x(c)[0] * x(c + 1)[1] - x(c)[1] * x(c + 1)[0]).sum::<f64>();
                for c in 0..cell.len() {
                    let (a, b) = (x(c), x(c + 1));
                    let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
                    // Outside segments run against the element's own direction.
                    self.under.push(([cell[(c + 1) % cell.len()], cell[c]], block.wave_modulus() * length / area, number));
                }
            }
        }
        self.under.sort_unstable_by_key(|&(nodes, ..)| nodes);
    }

    /// Pressure stiffness κ behind each segment, Pa/m, and the part that it belongs to.
    fn behind(&self, surface: &Surface) -> Vec<(f64, u32)> {
        let find = |segment: &[u32; 2]| self.under.binary_search_by_key(segment, |&(nodes, ..)| nodes).ok();
        surface.segments.iter().map(|segment| find(segment).map_or((0.0, 0), |at| (self.under[at].1, self.under[at].2))).collect()
    }

    fn stiffness_under(&self, surface: &Surface) -> Vec<f64> {
        self.behind(surface).into_iter().map(|(stiffness, _)| stiffness).collect()
    }

    /// Smallest κ of the segments of the same part, for each segment, Pa/m.
    fn softest_under(&self, surface: &Surface) -> Vec<f64> {
        let behind = self.behind(surface);
        let mut softest = vec![f64::INFINITY; self.mesh.parts.len()];
        for &(stiffness, part) in &behind {
            softest[part as usize] = stiffness.min(softest[part as usize]);
        }
        behind.into_iter().map(|(_, part)| softest[part as usize]).collect()
    }

    /// Penetrations of the contacts at the start: faults, or lines for the overview. Those that shall be pushed out are, in the mesh.
    fn part_at_start(&mut self) -> Vec<String> {
        let mut lines = Vec::new();
        let mut is_moved = false;
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let Interface { initial_penetration, thickness, active, .. } = contact.interface;
            // Ties hold what is there; who begins later can't know. Wrong surfaces are told when contacts are made.
            if contact.tied.is_some() || active[0] > 0.0 {
                continue;
            }
            let (Ok(outlines), Some(search)) = (self.outlines_of(contact), search_by_name(&contact.search)) else { continue };
            let mut tracker = tracker(outlines, passes_of(contact), search, &self.mesh);
            let tolerance = initial::TOLERANCE * initial::size(&self.mesh.positions);
            let found = initial::penetrations(&mut tracker, thickness, &self.mesh.positions, tolerance);
            let path = format!("contact[{i}]");
            match initial_penetration {
                InitialPenetration::Error => self.faults.extend(initial::faults(&path, &contact.name, &found)),
                InitialPenetration::Ignore => lines.extend(initial::lines(&contact.name, &found, "this counts as zero")),
                InitialPenetration::PushOut => {
                    lines.extend(initial::lines(&contact.name, &found, "it was pushed out"));
                    is_moved |= !found.is_empty();
                    let left = initial::push_out(&mut tracker, thickness, &mut self.mesh.positions, &self.constraints, tolerance);
                    self.faults.extend(initial::faults(&path, &contact.name, &left).into_iter().map(|fault| Fault {
                        message: format!("{} and can't be pushed out", fault.message),
                        help: "move the bodies apart".into(),
                        ..fault
                    }));
                }
            }
        }
        if is_moved && self.faults.is_empty() {
            self.faults.extend(self.mesh.faults_of_elements());
        }
        lines
    }

    fn contacts(&mut self) -> Vec<Contact> {
        let mut contacts = Vec::new();
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let outlines = match self.outlines_of(contact) {
                Ok(outlines) => outlines,
                Err(faults) => {
                    self.faults.extend(faults.into_iter().map(|fault| Fault { path: format!("contact[{i}].{}", fault.path), ..fault }));
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
            let formulation = self.node_segment(contact, outlines, search, terms.law.reach());
            self.terms.push(terms);
            contacts.push(Contact::new(contact.name.clone(), ContactKind::Contact, Box::new(formulation), contact.interface.active));
        }
        contacts
    }

    fn node_segment(&self, contact: &model::Contact, outlines: Vec<Outlined>, search: Box<dyn Search<2>>, reach: f64) -> NodeSegment {
        let passes = passes_of(contact);
        let stiffness: Vec<_> = outlines.iter().map(|outline| self.stiffness_under(&outline.target.surface)).collect();
        // A surface that meets itself is met from both sides.
        let sides = if outlines.len() == 1 { 2 } else { passes.len() };
        let interface = &contact.interface;
        let scale = match interface.law {
            ContactLaw::Penalty(Penalty::PerNode(_) | Penalty::Pressure(_)) => None,
            ContactLaw::Penalty(Penalty::Automatic { scale, .. }) => Some(scale),
            _ => Some(1.0),
        };
        let pass = |&(slave, target): &(usize, usize)| {
            let Target { surface, mirrors } = &outlines[slave].target;
            let nodes = contact::node_stiffness(surface, &stiffness[slave], &self.mesh.positions);
            let of = |(&(tributary, own), node): (&(f64, f64), &u32)| {
                let on_line = mirrors.binary_search_by_key(node, |&(node, _)| node).is_ok();
                let node = law::Node { tributary, own, other: f64::INFINITY, share: if on_line { 0.5 } else { 1.0 } };
                Slave { stiffness: stiffness_of(interface, node, sides), area: tributary / sides as f64, slip: 0.0 }
            };
            let per_modulus = scale.map(|scale| nodes.iter().map(|&(tributary, _)| scale * tributary / sides as f64).collect());
            PassInput {
                slaves: nodes.iter().zip(&surface.nodes).map(of).collect(),
                per_modulus: per_modulus.unwrap_or_default(),
                moduli: self.softest_under(&outlines[target].target.surface),
            }
        };
        let inputs = passes.iter().map(pass).collect();
        let tracker = tracker(outlines, passes, search, &self.mesh);
        // Nobody can say where bodies are when a contact begins later.
        let ignores_start = interface.initial_penetration == InitialPenetration::Ignore || interface.active[0] > 0.0;
        NodeSegment::new(tracker, inputs, [interface.thickness, reach], ignores_start, &self.mesh.positions)
    }

    /// The surfaces of a contact: two, or one that meets itself. Faults have paths relative to the contact.
    fn outlines_of(&self, contact: &model::Contact) -> Result<Vec<Outlined>, Vec<Fault>> {
        match &contact.partners {
            Partners::Between(between) => {
                let sides = (0..).zip(between).map(|(side, name)| {
                    let outline = self.outlined(|leave_out| self.mesh.surface(name, leave_out), &format!("surface \"{name}\""));
                    outline.map_err(|fault| Fault { path: format!("between[{side}]"), ..fault })
                });
                let (good, faulty): (Vec<_>, Vec<_>) = sides.partition(Result::is_ok);
                if faulty.is_empty() {
                    Ok(good.into_iter().flatten().collect())
                } else {
                    Err(faulty.into_iter().filter_map(Result::err).collect())
                }
            }
            Partners::Bodies(parts) => {
                let outline = self.outlined(|leave_out| self.mesh.outside_without(parts, leave_out), "the outside of the bodies");
                outline.map(|outline| vec![outline]).map_err(|fault| vec![Fault { path: "bodies".into(), ..fault }])
            }
        }
    }

    /// A surface without the segments on symmetry lines, and the normals of the lines at the ends that this leaves open.
    fn outlined(&self, surface: impl Fn(&dyn Fn([u32; 2]) -> bool) -> Result<Surface, Fault>, what: &str) -> Result<Outlined, Fault> {
        let lids = RefCell::new(Vec::new());
        let surface = surface(&|segment| {
            let is_lid = self.constraints.is_mirror(segment);
            if is_lid {
                lids.borrow_mut().push(segment);
            }
            is_lid
        })?;
        if surface.segments.is_empty() {
            return Err(Fault::new("", format!("{what} lies on a symmetry line altogether"), "name another surface"));
        }
        let starts =
            surface.segments.iter().zip(&surface.previous).filter(|(_, previous)| **previous == NONE).map(|(segment, _)| segment[0]);
        let ends = surface.segments.iter().zip(&surface.next).filter(|(_, next)| **next == NONE).map(|(segment, _)| segment[1]);
        let open = starts.chain(ends);
        let mut mirrors: Vec<(u32, [f64; 2])> =
            open.filter_map(|node| Some((node, self.constraints.mirror_normals(node).next()?))).collect();
        mirrors.sort_by_key(|&(node, _)| node);
        Ok(Outlined { target: Target { surface, mirrors }, lids: lids.into_inner() })
    }

    fn obstacles(&mut self) -> Vec<Contact> {
        let mut contacts = Vec::new();
        for (i, obstacle) in self.model.obstacles.iter().enumerate() {
            let ObstacleShape::Plane { point, normal, length } = obstacle.shape else { continue };
            let Some(normal) = unit(normal) else { continue };
            let surface = match self.mesh.outside(&obstacle.parts) {
                Ok(surface) => surface,
                Err(fault) => {
                    self.faults.push(Fault { path: format!("obstacle[{i}].parts"), ..fault });
                    continue;
                }
            };
            let own = contact::node_stiffness(&surface, &self.stiffness_under(&surface), &self.mesh.positions);
            // Nodes that a symmetry line keeps on this plane need no spring.
            let held = |node: u32| self.constraints.mirror_normals(node).any(|m| (m[0] * normal[1] - m[1] * normal[0]).abs() < 1e-12);
            let slave = |(&node, &(length, own)): (&u32, &(f64, f64))| {
                let here = law::Node { tributary: length, own, other: own, share: self.constraints.share(node) };
                (!held(node)).then(|| (node, Slave { stiffness: stiffness_of(&obstacle.interface, here, 1), area: length, slip: 0.0 }))
            };
            let terms = terms(&obstacle.interface);
            let reach = SKIN * own.iter().map(|&(length, _)| length).sum::<f64>() / own.len().max(1) as f64 + terms.law.reach();
            let nodes = surface.nodes.iter().zip(&own).filter_map(slave).collect();
            self.terms.push(terms);
            let body = self.bodies.add(Body { centre: point, ..Body::default() });
            let shape = Plane { normal, half: length.map_or(f64::INFINITY, |length| 0.5 * length) };
            // Beyond every picture of the model.
            let far = shape.half.min(20.0 * self.mesh.positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs())));
            let points = [1.0, -1.0].map(|side| [-side * far * normal[1], side * far * normal[0]]);
            self.outlines.push(OutlineShape { name: obstacle.name.clone(), body, points: points.into() });
            let formulation = NodeObstacle::new(Box::new(shape), body, nodes, reach, obstacle.interface.thickness);
            contacts.push(Contact::new(
                obstacle.name.clone(),
                ContactKind::Obstacle(body),
                Box::new(formulation),
                obstacle.interface.active,
            ));
        }
        contacts
    }
}

/// A surface of a contact.
pub(crate) struct Outlined {
    target: Target,
    /// Segments that were left out because they lie on a symmetry line.
    lids: Vec<[u32; 2]>,
}

/// Which nodes meet which surface: (slave, target).
fn passes_of(contact: &model::Contact) -> &'static [(usize, usize)] {
    match (&contact.partners, contact.formulation) {
        (Partners::Bodies(_), _) => &[(0, 0)],
        (_, Formulation::SinglePass { slave: 0 }) => &[(0, 1)],
        (_, Formulation::SinglePass { .. }) => &[(1, 0)],
        _ => &[(0, 1), (1, 0)],
    }
}

fn tracker(outlines: Vec<Outlined>, passes: &[(usize, usize)], search: Box<dyn Search<2>>, mesh: &Mesh<2>) -> Tracker {
    let (targets, lids): (Vec<_>, Vec<_>) = outlines.into_iter().map(|Outlined { target, lids }| (target, lids)).unzip();
    Tracker::new(targets, passes, search, &mesh.positions).with_bodies(&mesh.bodies(), &lids)
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
