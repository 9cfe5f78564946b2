//! The data that are recorded of a system: which fields (`field` has their values), history rows, momentum,
//! the state hash. Values only; formats are elsewhere.

use crate::archive::{Archive, ArchiveResult, Persist};
use crate::body_columns::BodyColumns;
use crate::contact::ContactKind;
use crate::contact::connection::Connected;
use crate::contact::springs::Tangential;
use crate::dimension::Dimension;
use crate::error::Fault;
use crate::field::snapshot::LiveSnapshot;
use crate::field::{ALIVE, VON_MISES};
use crate::hash::Fnv;
use crate::load::cavity::{self, Cavity};
use crate::material::variable::PLASTIC_STRAIN;
use crate::mesh::ElementGroup;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{Model, Part, ProbeAt};
use crate::output::{Cells, FieldKind, Needs, fields_of};
use crate::rigid::{Body, RigidMotion};
use crate::rotation::{Rotate, unit_matrix};
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{self, dot, first, length, minus, plus, times};

/// Columns of energies, after `energy.`.
const ENERGIES: [&str; 12] = [
    "kinetic",
    "internal",
    "plastic",
    "hourglass",
    "bulk_viscosity",
    "contact",
    "friction",
    "contact_damping",
    "damping",
    "eroded",
    "external",
    "total",
];
/// Axes of the components of a vector.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Fields and probes of a model, resolved to nodes.
pub(crate) struct Recorded {
    fields: Vec<&'static FieldKind>,
    probes: Vec<Probe>,
}

struct Probe {
    name: String,
    /// Nodes and their weights, which sum to one.
    nodes: Vec<(u32, f64)>,
    /// What `embate check` reports of it.
    line: String,
}

impl Recorded {
    pub(crate) fn new<const D: usize>(model: &Model, system: &System<D>) -> Result<Self, Vec<Fault>>
    where
        Dim<D>: Dimension<D> + BodyColumns<D>,
    {
        let has_failure = system.erosion.is_some();
        let has_contact = !system.contacts.is_empty();
        let has_friction = system.springs.terms.iter().any(|terms| matches!(terms.tangential, Tangential::Friction(_)));
        let wanted = |kind: &&FieldKind| {
            let include = &model.output.include;
            let named = include.iter().any(|name| name == kind.name) || model.output.picture_field == kind.name;
            let sensible = match kind.needs {
                Needs::Nothing => true,
                Needs::History(variable) => system.blocks.iter().any(|block| block.has(variable)),
                Needs::Contact => has_contact,
                Needs::Friction => has_friction,
                Needs::Failure => has_failure,
                Needs::Shells => model.parts.iter().any(Part::is_of_shells),
                Needs::Beams => model.parts.iter().any(Part::is_of_beams),
                Needs::Asking => false,
            };
            // Pictures fall back on these two.
            let pictured = model.output.pictures && (kind.name == VON_MISES.name || (kind.name == PLASTIC_STRAIN.name && sensible));
            let pictured = pictured || (model.output.pictures && kind.name == ALIVE.name && has_failure);
            named || pictured || (include.is_empty() && sensible)
        };
        let fields = fields_of(D).iter().filter(wanted).collect();
        let (mut probes, mut faults) = (Vec::new(), Vec::new());
        for (i, probe) in model.probes.iter().enumerate() {
            match resolve(&probe.at, system) {
                Ok((nodes, line)) => probes.push(Probe { name: probe.name.clone(), nodes, line: format!("{}: {line}", probe.name) }),
                Err(message) => {
                    faults.push(Fault::new(&UNKNOWN_NAME, format!("probe[{i}]"), message, "name a part, a side as part.side, or a group"))
                }
            }
        }
        if faults.is_empty() { Ok(Self { fields, probes }) } else { Err(faults) }
    }

    pub(crate) fn probe_lines(&self) -> Vec<String> {
        self.probes.iter().map(|probe| probe.line.clone()).collect()
    }

    pub(crate) fn columns<const D: usize>(&self, system: &System<D>) -> Vec<String>
    where
        Dim<D>: Dimension<D> + BodyColumns<D>,
    {
        let mut columns: Vec<String> = ["time", "time_step"].map(String::from).to_vec();
        columns.extend(ENERGIES.iter().map(|name| format!("energy.{name}")));
        for part in &system.mesh.parts {
            columns.extend(["kinetic", "internal", "plastic"].iter().map(|name| format!("energy.{name}[{}]", part.name)));
        }
        for contact in &system.contacts {
            let (kind, name) = (contact.kind.name(), &contact.name);
            let column = |value: &&str| format!("{kind}.{value}[{name}]");
            match contact.kind {
                ContactKind::Weld => {
                    columns.extend(["normal_force", "shear_force", "moment", "intact"].iter().map(column));
                    continue;
                }
                ContactKind::Joint => {
                    columns.extend(["force_x", "force_y", "force_z"][..D].iter().chain(<Dim<D>>::MOMENT).chain(&["gap"]).map(column));
                    continue;
                }
                ContactKind::Contact | ContactKind::Obstacle(_) => {}
            }
            columns.extend(["force_x", "force_y", "force_z"][..D].iter().chain(&["energy", "penetration", "friction_work"]).map(column));
            if let ContactKind::Obstacle(body) = contact.kind {
                columns.extend(<Dim<D>>::MOMENT.iter().map(column));
                if !system.bodies.state(body).is_fixed() {
                    columns.extend(<Dim<D>>::MOTION.iter().map(column));
                }
            }
        }
        for &(part, _) in &system.body_parts {
            columns.extend(<Dim<D>>::MOTION.iter().map(|value| format!("rigid.{value}[{}]", system.mesh.parts[part].name)));
        }
        for cavity in system.cavities.iter() {
            columns.extend(cavity::VALUES.iter().map(|value| format!("cavity.{value}[{}]", cavity.name)));
        }
        for probe in &self.probes {
            columns.extend(AXES[..D].iter().map(|axis| format!("{}.{axis}", probe.name)));
            columns.extend(AXES[..D].iter().map(|axis| format!("{}.v{axis}", probe.name)));
        }
        columns
    }

    pub(crate) fn row<const D: usize>(&self, system: &System<D>) -> Vec<f64>
    where
        Dim<D>: Dimension<D> + BodyColumns<D>,
    {
        let (stores, external) = (system.ledger.stores, system.ledger.external);
        let mut row = vec![system.time, system.time_step, stores.kinetic, stores.elastic + stores.plastic, stores.plastic];
        row.extend([
            stores.hourglass,
            stores.bulk_viscosity,
            stores.contact,
            stores.friction,
            stores.contact_damping,
            stores.damping,
            stores.eroded,
            external,
            stores.total() - external,
        ]);
        let mut of_parts = vec![[0.0; 3]; system.mesh.parts.len()];
        for (group, report) in system.mesh.groups.iter().zip(&system.reports) {
            let energies = [report.stored + report.dissipated, report.dissipated];
            of_parts[group.part][1..].iter_mut().zip(energies).for_each(|(sum, energy)| *sum += energy);
        }
        for (index, (part, energies)) in system.mesh.parts.iter().zip(&mut of_parts).enumerate() {
            let of_node = |&node: &u32| system.shares.of(index, node, system.mass[node as usize]) * system.specific_kinetic(node as usize);
            energies[0] = part.nodes.iter().map(of_node).sum();
        }
        row.extend(of_parts.iter().flatten());
        for contact in &system.contacts {
            if contact.kind.is_connection() {
                row.extend(connected::<D>(contact.kind, &contact.connected().unwrap_or_default()));
                continue;
            }
            let totals = &contact.totals;
            row.extend(totals.resultant);
            row.extend([totals.energy + totals.slip_energy, contact.depth(), contact.friction_work]);
            if let ContactKind::Obstacle(body) = contact.kind {
                let moment = contact.moment(body, &system.bodies, &system.springs, &system.positions);
                row.extend(<Dim<D>>::moments(&moment));
                if !system.bodies.state(body).is_fixed() {
                    row.extend(<Dim<D>>::motion(system.bodies.state(body), system.before()));
                }
            }
        }
        for &(_, body) in &system.body_parts {
            row.extend(<Dim<D>>::motion(system.bodies.state(body), system.before()));
        }
        row.extend(system.cavities.iter().flat_map(Cavity::values));
        for probe in &self.probes {
            let mean = |value: &dyn Fn(usize) -> [f64; D]| {
                probe.nodes.iter().fold([0.0; D], |sum, &(node, weight)| plus(sum, times(weight, value(node as usize))))
            };
            row.extend(mean(&|node| system.positions[node]));
            row.extend(mean(&|node| system.velocity(node)));
        }
        row
    }

    /// A system as it is shown now.
    pub(crate) fn snapshot<'a, const D: usize>(&'a self, system: &'a System<D>) -> LiveSnapshot<'a, D>
    where
        Dim<D>: Dimension<D> + BodyColumns<D>,
    {
        LiveSnapshot::new(system, &self.fields)
    }
}

/// Values of a weld or joint in the history.
fn connected<const D: usize>(kind: ContactKind, found: &Connected) -> Vec<f64> {
    let Connected { force, moment, normal, shear, gap, intact, grounded: _ } = *found;
    if kind == ContactKind::Weld {
        return vec![normal, shear, length(moment), f64::from(u8::from(intact))];
    }
    let moment = if D == 2 { &moment[2..] } else { &moment[..] };
    force[..D].iter().chain(moment).copied().chain([gap]).collect()
}

fn resolve<const D: usize>(at: &ProbeAt, system: &System<D>) -> Result<(Vec<(u32, f64)>, String), String>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    let part_of =
        |name: &str| system.mesh.parts.iter().find(|part| part.name == name).ok_or_else(|| format!("there is no part \"{name}\""));
    let place = |node: u32| format!("{} m", vector::place(system.positions[node as usize]));
    match at {
        ProbeAt::Point { part, point } => {
            let distance = |node: &u32| {
                let way = minus(system.positions[*node as usize], first(*point));
                dot(way, way).sqrt()
            };
            let nearest = part_of(part)?.with_faces().reduce(|best, node| if distance(&node) < distance(&best) { node } else { best });
            let node = nearest.ok_or_else(|| format!("part \"{part}\" has no nodes"))?;
            Ok((vec![(node, 1.0)], format!("node of \"{part}\" at {}, {:.3e} m from the wanted point", place(node), distance(&node))))
        }
        ProbeAt::Node { part, node } => {
            let nodes = &part_of(part)?.nodes;
            let index = *nodes.get(*node).ok_or_else(|| format!("part \"{part}\" has {} nodes, numbered from 0", nodes.len()))?;
            Ok((vec![(index, 1.0)], format!("node {node} of \"{part}\" at {}", place(index))))
        }
        ProbeAt::Set { set } => {
            let nodes =
                system.mesh.nodes(set).filter(|nodes| !nodes.is_empty()).ok_or_else(|| format!("there is nothing called \"{set}\""))?;
            let total: f64 = nodes.iter().map(|&node| system.mass[node as usize]).sum();
            let line = format!("mass-weighted mean of {} nodes of \"{set}\"", nodes.len());
            Ok((nodes.into_iter().map(|node| (node, system.mass[node as usize] / total)).collect(), line))
        }
    }
}

/// The cells of all parts, in the user's order and numbering: of a beam those of its cross-section.
pub(crate) fn cells<const D: usize>(system: &System<D>) -> Cells
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    let elements: usize = system.mesh.groups.iter().map(ElementGroup::elements).sum();
    // A large model has no room to grow into.
    let mut cells = Cells {
        nodes: Vec::with_capacity(system.mesh.groups.iter().map(|group| group.connectivity.len().max(group.outer.len())).sum()),
        offsets: Vec::with_capacity(elements + 1),
        kinds: Vec::with_capacity(elements),
        parts: Vec::with_capacity(elements),
        part_names: Vec::new(),
    };
    cells.offsets.push(0);
    for (index, part) in system.mesh.parts.iter().enumerate() {
        cells.part_names.push(part.name.clone());
        let groups: Vec<&ElementGroup> = system.mesh.groups_of(index).collect();
        // Where each element is stored, by the user's number.
        let mut places = vec![(0, 0); system.mesh.elements_of(index)];
        for (of_part, group) in (0u8..).zip(&groups) {
            (0..).zip(&group.user_elements).for_each(|(element, &user)| places[user as usize] = (of_part, element));
        }
        for (of_part, element) in places {
            for cell in groups[usize::from(of_part)].shown_cells_of(element as usize) {
                cells.nodes.extend(cell.nodes.iter().map(|&node| system.mesh.user_nodes[node as usize]));
                cells.offsets.push(cells.nodes.len() as u32);
                cells.kinds.push(cell.kind);
                cells.parts.push(index as u32);
            }
        }
    }
    cells
}

/// FNV-1a hash (64 bit) of the bits of all positions and velocities v^{n+1/2}, node by node, then of the
/// obstacles that move; hexadecimal.
pub(crate) fn state_hash<const D: usize>(system: &System<D>) -> String
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    let mut hash = Fnv::default();
    let moving = system.bodies.iter().filter(|body| !body.of_elements && !body.is_fixed());
    let states = moving.flat_map(<Dim<D>>::numbers);
    // Nodes in the order of the curve, then those of obstacles: as they are numbered only for speed, that is
    // no matter here.
    let nodes = || system.mesh.along_curve().chain(system.mesh.user_nodes.len()..system.positions.len());
    let positions = nodes().flat_map(|node| system.positions[node]);
    let velocities = nodes().flat_map(|node| system.velocities[node]);
    let rotations = nodes().flat_map(|node| system.rotations.now.numbers(node as u32));
    for value in positions.chain(velocities).chain(rotations).chain(states) {
        hash.add(&value.to_le_bytes());
    }
    hash.to_string()
}

/// Linear and angular momentum of a model on which nothing acts from outside.
pub(crate) struct Momentum<const D: usize> {
    start: Moments<D>,
    /// The centre of mass at the start, m: about it the angular momentum is measured, far from the origin
    /// too.
    centre: [f64; D],
    drift: [f64; 2],
    /// Whether x is a radius: forces around the axis cancel, and only what goes along it is kept.
    of_revolution: bool,
}

#[derive(Clone, Copy)]
struct Moments<const D: usize> {
    linear: [f64; D],
    /// In 2D about z alone.
    angular: [f64; 3],
    /// Σ m|v| and Σ m|x − c||v|: what the drifts are measured against.
    scale: [f64; 2],
}

impl<const D: usize> Persist for Momentum<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // The start is that of the model.
        let Self { start: _, centre: _, drift, of_revolution: _ } = self;
        drift.persist(archive)
    }
}

impl<const D: usize> Momentum<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    /// `None` where something is held or driven, or loads act.
    pub(crate) fn new(system: &System<D>) -> Option<Self> {
        let of_revolution = system.of_revolution;
        let is_free = |body: &Body<D>| if of_revolution { body.drives.as_ref()[1].is_none() } else { body.is_free() };
        let is_held = if of_revolution { system.constraints.holds_more_than(unit_matrix()[0]) } else { !system.constraints.is_empty() };
        let isolated = system.bodies.iter().all(is_free)
            && !is_held
            && system.body_forces.is_empty()
            && system.forces.is_empty()
            && system.boundary.is_empty()
            && !system.rotations.is_acted_on()
            && !system.joins.is_periodic()
            && system.damping.is_empty()
            && !system.contacts.iter().any(|contact| contact.connected().is_some_and(|found| found.grounded));
        // Forces at time zero have acted half a step already; both momenta are kept by them as well.
        isolated.then(|| {
            let centre = centre_of_mass(system);
            Self { start: Moments::of(system, centre), centre, drift: [0.0; 2], of_revolution }
        })
    }

    pub(crate) fn note(&mut self, system: &System<D>) {
        let now = Moments::of(system, self.centre);
        let mut change = minus(now.linear, self.start.linear);
        if self.of_revolution {
            change[0] = 0.0;
        }
        let turned = minus(now.angular, self.start.angular);
        let (linear, angular) = (dot(change, change).sqrt(), dot(turned, turned).sqrt());
        for (drift, (change, scales)) in
            self.drift.iter_mut().zip([(linear, [self.start.scale[0], now.scale[0]]), (angular, [self.start.scale[1], now.scale[1]])])
        {
            let scale = scales[0].max(scales[1]);
            if scale > 0.0 {
                *drift = drift.max(change / scale);
            }
        }
    }

    pub(crate) fn linear(&self) -> f64 {
        self.drift[0]
    }

    /// `None` of axisymmetric bodies: there is none.
    pub(crate) fn angular(&self) -> Option<f64> {
        (!self.of_revolution).then_some(self.drift[1])
    }
}

impl<const D: usize> Moments<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    /// Σ m v^{n+1/2} and Σ m (x^n − c) × v^{n+1/2} + Σ I ω^{n+1/2} about a point c: the latter is the one
    /// that central differences keep exactly.
    fn of(system: &System<D>, centre: [f64; D]) -> Self {
        let mut sum = Self { linear: [0.0; D], angular: [0.0; 3], scale: [0.0; 2] };
        for (node, ((&m, x), v)) in (0..).zip(system.mass.iter().zip(&system.positions).zip(&system.velocities)) {
            if system.bodies.of_node(node).is_none() {
                sum.add(m, minus(*x, centre), *v);
            }
        }
        for spin in system.rotations.momenta() {
            sum.angular = plus(sum.angular, spin);
            sum.scale[1] += dot(spin, spin).sqrt();
        }
        for body in system.bodies.iter() {
            let (m, velocity, spin) = <Dim<D>>::momenta(body);
            sum.add(m, minus(body.centre, centre), velocity);
            sum.angular = plus(sum.angular, spin);
            sum.scale[1] += dot(spin, spin).sqrt();
        }
        sum
    }

    fn add(&mut self, m: f64, arm: [f64; D], v: [f64; D]) {
        self.linear = plus(self.linear, times(m, v));
        self.angular = plus(self.angular, times(m, <Dim<D> as Rotate<D>>::moment_vector(arm, v)));
        let speed = m * dot(v, v).sqrt();
        self.scale[0] += speed;
        self.scale[1] += speed * dot(arm, arm).sqrt();
    }
}

/// Centre of the masses that `Moments` counts, m; seen from the first node, so that far from the origin no
/// digits are lost.
fn centre_of_mass<const D: usize>(system: &System<D>) -> [f64; D]
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    let Some(&from) = system.positions.first() else { return [0.0; D] };
    let (mut mass, mut sum) = (0.0, [0.0; D]);
    let mut add = |m: f64, x: [f64; D]| {
        mass += m;
        sum = plus(sum, times(m, minus(x, from)));
    };
    for (node, (&m, x)) in (0..).zip(system.mass.iter().zip(&system.positions)) {
        if system.bodies.of_node(node).is_none() {
            add(m, *x);
        }
    }
    system.bodies.iter().for_each(|body| add(<Dim<D>>::momenta(body).0, body.centre));
    if mass > 0.0 { plus(from, times(1.0 / mass, sum)) } else { from }
}
