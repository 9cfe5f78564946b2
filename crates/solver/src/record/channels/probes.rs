//! Probes: places, velocities, accelerations, and values of fields, of nodes, elements and sets.

mod values;

use super::{AXES, Channel, Column, changes, samples};
use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::error::Fault;
use crate::field::kind::{FieldKind, fields_of};
use crate::field::snapshot::LiveSnapshot;
use crate::field::{NodeFields, Source};
use crate::material::variable::PLASTIC_STRAIN;
use crate::mesh::locate::Located;
use crate::mesh::{ElementGroup, Mesh};
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{self, Model, Position, ProbeAt, ProbeKind};
use crate::rotation::{Rotate, inverse};
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{self, dot, first, minus, plus, times};
use values::{Elements, Values};

/// The group.
pub(crate) struct Probes(Vec<Probe>);

struct Probe {
    name: String,
    /// Nodes and their weights, which sum to one; none where an element alone is asked.
    nodes: Vec<(u32, f64)>,
    /// Whether its place and velocity are written.
    moves: bool,
    /// Whether it has a spin.
    spins: bool,
    fields: Vec<&'static FieldKind>,
    values: Values,
    /// Where it stays, if it does.
    watched: Option<Watched>,
    /// What `embate check` reports of it.
    line: String,
}

/// A place that a probe watches.
struct Watched {
    /// The part that is watched there, and its name.
    part: usize,
    name: String,
    /// m.
    place: [f64; 3],
    position: Position,
}

impl Probes {
    /// # Errors
    /// Probes of nothing.
    pub(crate) fn new<const D: usize>(model: &Model, system: &System<D>) -> Result<Self, Vec<Fault>>
    where
        Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
    {
        let (mut probes, mut faults) = (Vec::new(), Vec::new());
        for (i, probe) in model.probes.iter().enumerate() {
            match Probe::new(probe, (model, system)) {
                Ok(found) => probes.push(found),
                Err(message) => {
                    faults.push(Fault::new(&UNKNOWN_NAME, format!("probe[{i}]"), message, "name a part, a side as part.side, or a group"))
                }
            }
        }
        if faults.is_empty() { Ok(Self(probes)) } else { Err(faults) }
    }

    /// What `embate check` reports of each.
    pub(crate) fn lines(&self) -> Vec<String> {
        self.0.iter().map(|probe| format!("{}: {}", probe.name, probe.line)).collect()
    }
}

impl Probe {
    fn new<const D: usize>(probe: &model::Probe, (model, system): (&Model, &System<D>)) -> Result<Self, String>
    where
        Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
    {
        let watched = Watched::of(probe, &system.mesh)?;
        let (nodes, line) = match &watched {
            Some(watched) => (Vec::new(), format!("what of \"{}\" is at {} m", watched.name, vector::place(first::<D>(watched.place)))),
            None => resolve(&probe.at, (model, system))?,
        };
        let kind = |name: &String| fields_of(D).iter().find(|kind| kind.name == *name);
        let mut fields: Vec<&FieldKind> = probe.fields.iter().filter_map(kind).collect();
        let of_element = matches!(probe.at, ProbeAt::Element { .. });
        let of_cells = fields.iter().any(|kind| matches!(kind.source, Source::Cells(..)));
        let elements = match &probe.at {
            ProbeAt::Element { part, element } => Elements::one(element_of(&system.mesh, part, *element)?),
            _ if !of_cells || watched.is_some() => Elements::default(),
            ProbeAt::Point { part, .. } | ProbeAt::Node { part, .. } => Elements::at(&system.mesh, Some(part), &nodes, probe.position),
            ProbeAt::Set { set } => {
                let part = system.mesh.parts.iter().find(|it| it.name == *set).map(|it| &it.name);
                Elements::at(&system.mesh, part, &nodes, probe.position)
            }
        };
        if of_element && fields.is_empty() {
            let flows = elements.first().is_some_and(|group| system.blocks[group].has(&PLASTIC_STRAIN));
            let usual = ["stress", "von_mises", "plastic_strain"].map(String::from);
            fields = usual[..if flows { 3 } else { 2 }].iter().filter_map(kind).collect();
        }
        Ok(Self {
            name: probe.name.clone(),
            moves: !of_element && probe.extreme.is_none() && watched.is_none(),
            spins: matches!(probe.at, ProbeAt::Set { .. }) && nodes.len() > 1 && !system.of_revolution,
            nodes,
            fields,
            values: Values { extreme: probe.extreme, has_place: probe.place, elements },
            watched,
            line,
        })
    }

    /// Weighted sum over its nodes.
    fn mean<const D: usize>(&self, value: impl Fn(usize) -> [f64; D]) -> [f64; D] {
        mean(&self.nodes, value)
    }

    /// Angular velocity ω of its nodes as if they were rigid, I ω = Σ m (x − c) × v, rad/s; zero about an
    /// axis on which all of them lie.
    fn spin<const D: usize>(&self, system: &System<D>) -> [f64; 3]
    where
        Dim<D>: Dimension<D>,
    {
        let centre = self.mean(|node| system.positions[node]);
        let (mut momentum, mut inertia) = ([0.0; 3], [[0.0; 3]; 3]);
        for &(node, weight) in &self.nodes {
            let arm = minus(system.positions[node as usize], centre);
            momentum = plus(momentum, times(weight, <Dim<D>>::moment_vector(arm, system.velocity(node as usize))));
            let arm = model::in_3d(arm);
            for i in 0..3 {
                inertia[i][i] += weight * dot(arm, arm);
                (0..3).for_each(|j| inertia[i][j] -= weight * arm[i] * arm[j]);
            }
        }
        if D == 2 {
            return [0.0, 0.0, if inertia[2][2] > 0.0 { momentum[2] / inertia[2][2] } else { 0.0 }];
        }
        // What lies on a line has no inertia about it: a trace of some finds the spin across.
        let trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
        (0..3).for_each(|d| inertia[d][d] += 1e-12 * trace);
        if trace > 0.0 { inverse::<3>(&inertia).map(|row| dot(row, momentum)) } else { [0.0; 3] }
    }
}

impl<const D: usize> Channel<D> for Probes
where
    Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
{
    fn columns(&self, _: &System<D>) -> Vec<Column> {
        let mut columns = Vec::new();
        for Probe { name, moves, spins, fields, values, watched, .. } in &self.0 {
            let of_axes = |what: &str| AXES[..D].iter().map(|axis| format!("{name}.{what}{axis}")).collect::<Vec<_>>();
            if watched.is_some() {
                columns.extend(samples(of_axes("v")));
            }
            if *moves {
                columns.extend(samples(of_axes("").into_iter().chain(of_axes("v"))));
                columns.extend(changes(of_axes("a")));
            }
            if *moves && *spins {
                let spin = if D == 2 { vec![format!("{name}.spin")] } else { of_axes("spin_") };
                columns.extend(samples(spin));
            }
            columns.extend(samples(fields.iter().flat_map(|field| values.names(field, name, &AXES[..D]))));
        }
        columns
    }

    fn samples(&self, system: &System<D>, row: &mut Vec<f64>) {
        let snapshot = LiveSnapshot::new(system, &[]);
        for probe in &self.0 {
            if let Some(watched) = &probe.watched {
                watched.add(&probe.fields, system, &snapshot, row);
                continue;
            }
            if probe.moves {
                row.extend(probe.mean(|node| system.positions[node]));
                row.extend(probe.mean(|node| system.velocity(node)));
            }
            if probe.moves && probe.spins {
                row.extend(super::moment::<D>(probe.spin(system)));
            }
            probe.fields.iter().for_each(|kind| probe.values.add(kind, &probe.nodes, &snapshot, row));
        }
    }

    fn levels(&self, system: &System<D>, levels: &mut Vec<[f64; 2]>) {
        for probe in self.0.iter().filter(|probe| probe.moves) {
            let [before, after] = [0, 1].map(|at| probe.mean(|node| system.velocities_around(node)[at]));
            levels.extend(before.into_iter().zip(after).map(|(before, after)| [before, after]));
        }
    }
}

impl Watched {
    /// That of a probe of this kind.
    fn of<const D: usize>(probe: &model::Probe, mesh: &Mesh<D>) -> Result<Option<Self>, String>
    where
        Dim<D>: Dimension<D>,
    {
        let (ProbeKind::Place, ProbeAt::Point { part, point }) = (probe.kind, &probe.at) else { return Ok(None) };
        let index = part_of(mesh, part)?;
        if !mesh.groups_of(index).any(|group| group.kind.facts().dimension == D) {
            return Err(format!("part \"{part}\" has no solid elements, in which a place could be: leave out `kind`"));
        }
        Ok(Some(Self { part: index, name: part.clone(), place: *point, position: probe.position }))
    }

    /// Adds the velocity (m/s) and the values of fields of what is there now; where nothing is, no numbers.
    fn add<const D: usize>(&self, fields: &[&FieldKind], system: &System<D>, snapshot: &LiveSnapshot<'_, D>, row: &mut Vec<f64>)
    where
        Dim<D>: Dimension<D> + NodeFields<D>,
    {
        let mesh = &system.mesh;
        let found = mesh.located(self.part, &system.positions, first(self.place), ElementGroup::is_alive);
        let Some(found) = found.filter(Located::is_inside) else {
            let width = D + fields.iter().map(|kind| kind.width()).sum::<usize>();
            row.extend(std::iter::repeat_n(f64::NAN, width));
            return;
        };
        row.extend(mean(&found.nodes, |node| system.velocity(node)));
        let elements = match self.position {
            Position::Element => Elements::one(found.element),
            Position::Node => Elements::at(mesh, Some(&self.name), &found.nodes, self.position),
        };
        let values = Values { extreme: None, has_place: false, elements };
        fields.iter().for_each(|kind| values.add(kind, &found.nodes, snapshot, row));
    }
}

/// Whether elements of a part are made again in the run, so that a probe goes with the material between
/// nodes.
fn is_made_again<const D: usize>(model: &Model, mesh: &Mesh<D>, part: usize) -> bool
where
    Dim<D>: Dimension<D>,
{
    let name = &model.parts[part].name;
    let flows = model.flows.iter().any(|flow| flow.part == *name);
    !flows && (mesh.remeshed.of(part).is_some() || model.rules_of_remeshing().iter().any(|rule| rule.of.part == *name))
}

/// Weighted sum over nodes.
fn mean<const D: usize>(nodes: &[(u32, f64)], value: impl Fn(usize) -> [f64; D]) -> [f64; D] {
    nodes.iter().fold([0.0; D], |sum, &(node, weight)| plus(sum, times(weight, value(node as usize))))
}

/// Index of a part.
fn part_of<const D: usize>(mesh: &Mesh<D>, name: &str) -> Result<usize, String>
where
    Dim<D>: Dimension<D>,
{
    mesh.parts.iter().position(|part| part.name == name).ok_or_else(|| format!("there is no part \"{name}\""))
}

/// Where an element is stored, by the user's number in its part.
fn element_of<const D: usize>(mesh: &Mesh<D>, part: &str, number: usize) -> Result<(usize, u32), String>
where
    Dim<D>: Dimension<D>,
{
    let index = part_of(mesh, part)?;
    let own = |(_, group): &(usize, &ElementGroup)| group.part == index;
    for (place, group) in mesh.groups.iter().enumerate().filter(own) {
        if let Some(element) = (0u32..).zip(&group.user_elements).find(|(_, user)| **user as usize == number) {
            return Ok((place, element.0));
        }
    }
    Err(format!("part \"{part}\" has {} elements, numbered from 0", mesh.elements_of(index)))
}

type Resolved = (Vec<(u32, f64)>, String);

fn resolve<const D: usize>(at: &ProbeAt, (model, system): (&Model, &System<D>)) -> Result<Resolved, String>
where
    Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
{
    let place = |node: u32| format!("{} m", vector::place(system.mesh.positions[node as usize]));
    match at {
        ProbeAt::Point { part, point } => {
            let distance = |node: &u32| {
                let way = minus(system.mesh.positions[*node as usize], first(*point));
                dot(way, way).sqrt()
            };
            let index = part_of(&system.mesh, part)?;
            if is_made_again(model, &system.mesh, index)
                && let Some(found) = system.mesh.located(index, &system.mesh.positions, first(*point), |_, _| true).filter(Located::is_near)
            {
                let own = mean(&found.nodes, |node| system.mesh.positions[node]);
                let way = minus(own, first(*point));
                let line =
                    format!("material of \"{part}\" at {} m, {:.3e} m from the wanted point", vector::place(own), dot(way, way).sqrt());
                return Ok((found.nodes, line));
            }
            let nearest =
                system.mesh.parts[index].with_faces().reduce(|best, node| if distance(&node) < distance(&best) { node } else { best });
            let node = nearest.ok_or_else(|| format!("part \"{part}\" has no nodes"))?;
            Ok((vec![(node, 1.0)], format!("node of \"{part}\" at {}, {:.3e} m from the wanted point", place(node), distance(&node))))
        }
        ProbeAt::Node { part, node } => {
            let nodes = &system.mesh.parts[part_of(&system.mesh, part)?].nodes;
            let index = *nodes.get(*node).ok_or_else(|| format!("part \"{part}\" has {} nodes, numbered from 0", nodes.len()))?;
            Ok((vec![(index, 1.0)], format!("node {node} of \"{part}\" at {}", place(index))))
        }
        ProbeAt::Element { part, element } => {
            let (group, stored) = element_of(&system.mesh, part, *element)?;
            let middle = system.mesh.mean_place(system.mesh.groups[group].nodes_of(stored as usize));
            Ok((Vec::new(), format!("element {element} of \"{part}\" at {} m", vector::place(middle))))
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
