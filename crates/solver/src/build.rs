//! From a model to a [`System`]: mesh, blocks, masses, contacts, obstacles, rigid bodies, conditions. All faults are collected before anything runs.

mod again;
mod bodies;
mod discrete;
mod failure;
mod fans;
mod idle;
mod limits;
mod mass;
mod mirrors;
mod obstacles;
mod start;

use crate::contact::messages::{NO_STEP, ON_SYMMETRY, TIED_TWICE};
use crate::material::messages::INITIAL_STATE;
use crate::mesh::messages::NEGATIVE_RADIUS;
use crate::model::messages::UNKNOWN_NAME;
pub(crate) use again::{Lent, Origin};
use fans::{Fans, Under};
pub(crate) use mass::Shares;
use mass::part_masses;

use crate::assembly::Assembly;
use crate::block::{Block, BlockInput, Initial, Motion, Report, Wrong, make};
use crate::contact::forces::ContactForces;
use crate::contact::formulation::{self, Setup, Side};
use crate::contact::law::{self, Law};
use crate::contact::mirror::Mirrored;
use crate::contact::obstacle::OutlineShape;
use crate::contact::projection::node_segment::Target;
use crate::contact::search::SearchKind;
use crate::contact::springs::friction::Friction;
use crate::contact::springs::{Springs, Tangential, Terms};
use crate::contact::traces::Traces;
use crate::contact::{self, Contact, ContactKind, Formulation, search};
use crate::element::ElementOptions;
use crate::energy::{Ledger, Sums};
use crate::error::{Fault, Warning};
use crate::load::body_force::BodyForces;
use crate::load::constraint::{Constraints, unit};
use crate::load::curve::Curves;
use crate::load::damping::Damping;
use crate::load::force::Forces;
use crate::load::join::Joins;
use crate::load::non_reflecting::{Behind, NonReflecting};
use crate::load::tributary::Depth;
use crate::mesh::surface::{NONE, Surface};
use crate::mesh::{ElementGroup, Mesh};
use crate::model::{self, ContactLaw, Interface, Model, Partners, Penalty, PenaltySource, Symmetry};
use crate::rigid::Bodies;
use crate::step::erosion::Erosion;
use crate::step::free::Groups;
use crate::step::relaxation::Relaxation;
use crate::step::{CHUNK, Governor, System};
use crate::vector::first;
use embate_lanes::{Level, Team};
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

/// Nodes nearer to the axis than this fraction of the model's size are on it.
const ON_AXIS: f64 = 1e-9;
/// Below so many elements threads cost more than they bring.
const SERIAL: usize = 4096;

/// Builds the system; with it come all warnings of the model.
///
/// # Errors
/// All faults of the model.
pub fn system(model: &Model, level: Level, threads: usize) -> Result<(System, Vec<Warning>), Vec<Fault>> {
    let faults = model.check();
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut warnings = model.warnings();
    let mesh = Mesh::new(model)?;
    let with_axis = with_axis(model, &mesh)?;
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
    let initial_penetrations = builder.part_at_start();
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
    let mut velocities = builder.velocities(part_mass);
    builder.rigid_parts(part_mass);
    let shares = builder.shares(&blocks, part_mass);
    // From here on masses are those of nodes, and of parts as a whole: each list of them is as large as all positions.
    blocks.iter_mut().for_each(|block| block.release_corner_masses());
    drop((part_mass_scaled, part_mass_true));
    builder.measure_stiffness(&mut blocks, level);
    let springs = builder.springs();
    let (forces, boundary) = builder.loads();
    let mut contacts = builder.contacts();
    contacts.extend(builder.obstacles());
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    builder.bodies.weigh(&body_forces, &builder.mass);
    let criteria = builder.criteria(&blocks);
    if !builder.faults.is_empty() {
        return Err(builder.faults);
    }
    blocks.iter_mut().zip(&criteria).filter(|(_, criteria)| !criteria.is_empty()).for_each(|(block, _)| block.keep_forces());
    let Builder { mesh, constraints, joins, curves, positions, mass, body_parts, bodies, terms, outlines, moduli, time_step, .. } = builder;
    let origin = || Origin { model: model.clone(), fans: Fans::of(&mesh), moduli, time_step, positions: positions.clone() };
    let erosion = criteria.iter().any(|criteria| !criteria.is_empty()).then(|| Box::new(Erosion::new(criteria, origin())));
    let elements: usize = blocks.iter().map(|block| block.elements()).sum();
    let has_springs = springs.is_some();
    blocks.extend(springs.map(|springs| Box::new(springs) as Box<dyn Block<2>>));
    let nodes = positions.len();
    let assembly = Assembly::new(nodes, &blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
    velocities.resize(nodes, [0.0; 2]);
    // Made only to be told of elements that overlap where nothing touches. A symmetry line is no surface: pressures count the length on the model's side.
    let outside =
        mesh.outside_without(&[], |segment| contacts.is_empty() || constraints.is_mirror(segment)).map_err(|fault| vec![fault])?;
    let limits = limits::of(model, &mesh, &blocks, &outside);
    // Without contacts there is nothing to remember of any node.
    let touched = if contacts.is_empty() { 0 } else { nodes };
    let traces = Traces::new(outside, &mesh.positions[..touched.min(mesh.positions.len())], Depth::of(model));
    let run = &model.run;
    let mut system = System {
        slots: vec![[0.0; 2]; assembly.count],
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

/// An axisymmetric model with its axis as a symmetry line, if it touches that.
fn with_axis(model: &Model, mesh: &Mesh<2>) -> Result<Option<Model>, Vec<Fault>> {
    if !model.is_axisymmetric() {
        return Ok(None);
    }
    let size = mesh.positions.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
    if let Some([x, y]) = mesh.positions.iter().find(|x| x[0] < -ON_AXIS * size) {
        let message = format!("an axisymmetric part has a node at a negative radius, ({x:.6e}, {y:.6e}) m");
        return Err(vec![Fault::new(&NEGATIVE_RADIUS, "part", message, "x is the radius: move the part to the right of the axis x = 0")]);
    }
    let touches = mesh.positions.iter().any(|x| x[0] <= ON_AXIS * size);
    let axis = Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() };
    let is_there = |symmetry: &Symmetry| symmetry.parts.is_empty() && symmetry.point[0] == 0.0 && symmetry.normal[1] == 0.0;
    if !touches || model.symmetries.iter().any(is_there) {
        return Ok(None);
    }
    let mut model = model.clone();
    model.symmetries.push(axis);
    Ok(Some(model))
}

struct Builder<'a> {
    model: &'a Model,
    mesh: Mesh<2>,
    /// Body that each node of the mesh belongs to.
    body_of_node: Vec<u32>,
    constraints: Constraints<2>,
    joins: Joins,
    curves: Curves,
    faults: Vec<Fault>,
    /// Initial positions of all nodes, m: those of elements, then those of obstacles.
    positions: Vec<[f64; 2]>,
    /// Their masses, kg/m; 1 where an obstacle has a node.
    mass: Vec<f64>,
    /// Which elements are at which nodes; found when the first edge asks.
    fans: OnceCell<Fans>,
    /// Wave modulus and bulk modulus of each group of elements, Pa.
    moduli: Vec<[f64; 2]>,
    /// First time step, s; only where a contact asks for it.
    time_step: f64,
    bodies: Bodies,
    /// Rigid parts and their bodies.
    body_parts: Vec<(usize, usize)>,
    /// What acts in contacts, ties and obstacles, as they are made.
    terms: Vec<Terms>,
    outlines: Vec<OutlineShape>,
    /// Rigid bodies of the obstacles by name, where they are there already.
    made: BTreeMap<String, usize>,
    /// Whether contacts are made again, of changed surfaces.
    again: bool,
}

impl Builder<'_> {
    /// A block for each group of elements.
    fn blocks(&mut self) -> Vec<Box<dyn Block<2>>> {
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
            let element = part.element_of(group.nodes_per_element).map_or("", |kind| kind.name);
            let viscosity = self.model.run.bulk_viscosity;
            let input = BlockInput {
                area: part.area.unwrap_or(0.0),
                damping: self.model.stiffness_damping(part),
                options: ElementOptions { hourglass: part.hourglass },
                stress_state: &part.stress_state,
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

    /// What the stiffness of contacts is made from beyond the elements behind their surfaces: moduli and the first step.
    fn measure_stiffness(&mut self, blocks: &mut [Box<dyn Block<2>>], level: Level) {
        self.moduli = blocks.iter().map(|block| [block.wave_modulus(), block.bulk_modulus()]).collect();
        let interfaces = self.model.contacts.iter().map(|c| &c.interface).chain(self.model.obstacles.iter().map(|o| &o.interface));
        if interfaces.into_iter().any(|interface| source_of(interface) == PenaltySource::TimeStep) {
            let velocities = vec![[0.0; 2]; self.mesh.positions.len()];
            let motion = Motion { positions: &self.mesh.positions, velocities: &velocities, time_step: 0.0 };
            let stable = |(block, group): (&mut Box<dyn Block<2>>, &ElementGroup)| {
                if self.model.parts[group.part].rigid.is_some() {
                    return f64::INFINITY;
                }
                let mut slots = vec![[0.0; 2]; block.slots().len()];
                block.advance(&motion, level, &mut slots, &mut Team::alone()).time_step_squared
            };
            let elements =
                self.model.run.safety * blocks.iter_mut().zip(&self.mesh.groups).map(stable).fold(f64::INFINITY, f64::min).sqrt();
            self.time_step = elements.min(self.model.run.time_step.unwrap_or(f64::INFINITY));
            if self.time_step == f64::INFINITY {
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
    fn loads(&mut self) -> (Forces, NonReflecting) {
        let is_mirror = |segment| self.constraints.is_mirror(segment);
        let behind = |segment| {
            let under = self.under(segment)?;
            let part = &self.model.parts[self.mesh.groups[under.group].part];
            let density = *self.model.materials.get(&part.material)?.parameters.get("density")?;
            Some(Behind { density, moduli: self.moduli[under.group] })
        };
        let forces = Forces::new(self.model, &self.mesh, &self.curves, is_mirror);
        let boundary = NonReflecting::new(self.model, &self.mesh, is_mirror, behind);
        let mut faults = Vec::new();
        let made = (forces.unwrap_or_else(|wrong| told(wrong, &mut faults)), boundary.unwrap_or_else(|wrong| told(wrong, &mut faults)));
        self.faults.extend(faults);
        made
    }

    /// What is behind a surface, with the stiffness that an interface asks for.
    fn side(&self, Outlined { target, lids }: Outlined, interface: &Interface) -> Side<'_> {
        let (surface, positions, source) = (&target.surface, &self.mesh.positions, source_of(interface));
        let modulus = |under: Under| self.moduli[under.group][usize::from(source == PenaltySource::BulkModulus)] * under.flatness;
        let mut segments: Vec<f64> = surface.segments.iter().map(|&segment| self.under(segment).map_or(0.0, modulus)).collect();
        let mut nodes = contact::tributaries(surface, &segments, positions, Depth::of(self.model));
        if source == PenaltySource::TimeStep {
            for (&node, own) in surface.nodes.iter().zip(&mut nodes) {
                own.stiffness = law::penalty::of_time_step(self.mass[node as usize], self.time_step, own.area);
            }
            let of = |node: u32| surface.nodes.binary_search(&node).map_or(0.0, |at| nodes[at].stiffness);
            segments = surface.segments.iter().map(|&[a, b]| 0.5 * (of(a) + of(b))).collect();
        }
        let cell = |&segment: &[u32; 2]| self.under(segment).map_or(&[][..], |under| self.mesh.groups[under.group].cell(under.element));
        let cells = surface.segments.iter().map(cell).collect();
        let parts = surface
            .segments
            .iter()
            .map(|&segment| self.under(segment).map_or(0, |under| self.mesh.groups[under.group].part as u32))
            .collect();
        Side { lids, segments, parts, nodes, cells, target }
    }

    fn contacts(&mut self) -> Vec<Contact> {
        let mut contacts = Vec::new();
        let mut tied = BTreeMap::new();
        for (i, contact) in self.model.contacts.iter().enumerate() {
            match self.contact(contact) {
                Ok(made) => {
                    if let Some(ties) = made.ties() {
                        self.tied_once(&format!("contact[{i}].tied"), &contact.name, &ties.nodes, &mut tied);
                    }
                    contacts.push(made);
                }
                Err(faults) => self.faults.extend(faults.into_iter().map(|fault| {
                    let dot = if fault.path.is_empty() { "" } else { "." };
                    Fault { path: format!("contact[{i}]{dot}{}", fault.path), ..fault }
                })),
            }
        }
        contacts
    }

    /// Tells if nodes are bound already (`tied`: which contact binds a node): two ties would hold against each other.
    fn tied_once<'m>(&mut self, path: &str, contact: &'m str, nodes: &[u32], tied: &mut BTreeMap<u32, &'m str>) {
        let twice = nodes.iter().find_map(|&node| Some((node, *tied.get(&node)?)));
        if let Some((node, other)) = twice {
            let [x, y] = self.mesh.positions[node as usize];
            self.faults.push(Fault::new(
                &TIED_TWICE,
                path,
                format!("the node at ({x:.6e}, {y:.6e}) m is tied already by contact \"{other}\""),
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

    /// A contact; faults have paths relative to it.
    fn contact(&mut self, contact: &model::Contact) -> Result<Contact, Vec<Fault>> {
        let (formulation, terms) = self.formulation(contact)?;
        Ok(Contact::new(contact.name.clone(), ContactKind::Contact, formulation, terms, contact.interface.active))
    }

    /// What makes the springs of a contact, and the number of the terms that they follow.
    fn formulation(&mut self, contact: &model::Contact) -> Result<(Box<dyn Formulation>, usize), Vec<Fault>> {
        let terms = self.add_terms(terms_of(&contact.interface));
        let tie_terms = if contact.tied.is_some() { self.add_terms(terms_of_ties(&contact.interface)) } else { terms };
        let mirror_terms = self.add_terms(mirrors::terms_of_mirrors(&contact.interface));
        let sides: Vec<Side<'_>> = self.outlines_of(contact)?.into_iter().map(|outline| self.side(outline, &contact.interface)).collect();
        let mirrors = self.mirrors_of(contact, &sides[0]);
        let Some(search) = search_by_name(&contact.search) else {
            let message = format!("there is no search \"{}\"", contact.search);
            return Err(vec![Fault::new(&UNKNOWN_NAME, "search", message, "see `embate list searches`")]);
        };
        let Some(kind) = formulation::kind_of(contact) else {
            let message = format!("there is no formulation \"{}\"", contact.formulation.name());
            return Err(vec![Fault::new(&UNKNOWN_NAME, "formulation", message, "see `embate list formulations`")]);
        };
        let setup = Setup {
            contact,
            sides,
            bodies: &self.body_of_node,
            positions: &self.mesh.positions,
            depth: Depth::of(self.model),
            law: &|| law_of(&contact.interface),
            passes: (kind.passes)(contact),
            tie_terms,
            search: &|| (search.make)(),
            again: self.again,
        };
        let mut made = (kind.make)(setup).map_err(|fault| vec![fault])?;
        if !mirrors.is_empty() {
            made = Box::new(Mirrored::new(made, mirrors, mirror_terms));
        }
        Ok((made, terms))
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
            return Err(Fault::new(&ON_SYMMETRY, "", format!("{what} lies on a symmetry line altogether"), "name another surface"));
        }
        Ok(Outlined { target: self.with_mirrors(surface), lids: lids.into_inner() })
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

/// Notes faults and gives what stands in for the thing that has them.
fn told<T: Default>(wrong: Vec<Fault>, faults: &mut Vec<Fault>) -> T {
    faults.extend(wrong);
    T::default()
}

impl Builder<'_> {
    /// Symmetry lines behind which there is nothing of the parts that they hold: number, a point, and the unit normal that points to the parts.
    fn mirror_lines(&self) -> impl Iterator<Item = (usize, [f64; 2], [f64; 2])> {
        let tolerance = contact::initial::TOLERANCE * contact::initial::size(&self.mesh.positions);
        self.model.symmetries.iter().enumerate().filter_map(move |(number, symmetry)| {
            let (normal, point) = (unit(first(symmetry.normal))?, first(symmetry.point));
            let parts = self.mesh.parts.iter().filter(|part| symmetry.parts.is_empty() || symmetry.parts.contains(&part.name));
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for &node in parts.flat_map(|part| &part.nodes) {
                let distance = height(self.mesh.positions[node as usize], point, normal);
                (low, high) = (low.min(distance), high.max(distance));
            }
            if low >= -tolerance {
                Some((number, point, normal))
            } else {
                (high <= tolerance).then_some((number, point, normal.map(|n| -n)))
            }
        })
    }

    /// Whether a point lies on a symmetry line of one of these parts (none: all) or beyond it, where the mirror images of the parts are.
    fn is_beyond_mirrors(&self, x: [f64; 2], parts: &[String]) -> bool {
        let tolerance = contact::initial::TOLERANCE * contact::initial::size(&self.mesh.positions);
        let concerns = |held: &[String]| held.is_empty() || parts.is_empty() || held.iter().any(|part| parts.contains(part));
        self.mirror_lines()
            .any(|(number, point, normal)| concerns(&self.model.symmetries[number].parts) && height(x, point, normal) <= tolerance)
    }
}

/// How far `x` is from the line through `point`, along its normal, m.
fn height(x: [f64; 2], point: [f64; 2], normal: [f64; 2]) -> f64 {
    (x[0] - point[0]) * normal[0] + (x[1] - point[1]) * normal[1]
}

/// A surface of a contact.
pub(crate) struct Outlined {
    target: Target,
    /// Segments that were left out because they lie on a symmetry line.
    lids: Vec<[u32; 2]>,
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

/// Stiffness of a slave node; of laws without a penalty that of the automatic one, for what needs a scale.
fn stiffness_of(interface: &Interface, node: law::Node, passes: usize) -> f64 {
    let penalty = if let ContactLaw::Penalty(penalty) = interface.law { penalty } else { Penalty::default() };
    law::penalty::stiffness(penalty, node, passes)
}

/// What an automatic penalty is made from; of laws without a penalty the default.
fn source_of(interface: &Interface) -> PenaltySource {
    match interface.law {
        ContactLaw::Penalty(Penalty::Automatic { source, .. }) => source,
        _ => PenaltySource::default(),
    }
}

fn search_by_name(name: &str) -> Option<SearchKind<2>> {
    let registry = search::registry::<2>();
    if name.is_empty() { registry.first().copied() } else { registry.into_iter().find(|kind| kind.name == name) }
}
