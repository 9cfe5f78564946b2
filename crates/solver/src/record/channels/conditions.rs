//! Reactions of what holds and moves nodes, and resultants of loads.
//!
//! The reaction of a condition is the force that it needs to keep its nodes on their way: what the velocity
//! update lacks without it, as the ledger enters it. Moments are about the mean of its nodes at the start;
//! they have the moments of held rotations of shells and beams in them.

use super::{Channel, Column, forces, means, moment};
use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::load::constraint::NodeConstraint;
use crate::model::{Load, Model};
use crate::rotation::Rotate;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{dot, minus, times};

/// The groups of a system.
pub(super) fn of_system<const D: usize>(model: &Model, system: &System<D>) -> Vec<Box<dyn Channel<D>>>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    let mut channels: Vec<Box<dyn Channel<D>>> = Vec::new();
    let held = Held::new(model, system);
    if !held.names.is_empty() {
        channels.push(Box::new(held));
    }
    let loads = Loads::new(model);
    if !loads.names.is_empty() {
        channels.push(Box::new(loads));
    }
    channels
}

/// A name, or that of what has none: its place among its kind.
fn name_of(name: &str, place: usize) -> String {
    if name.is_empty() { place.to_string() } else { name.to_string() }
}

/// Symmetries and constraints, in the order of [`crate::load::constraint::Constraints`].
struct Held<const D: usize> {
    /// What columns are called by: kind and name.
    names: Vec<(&'static str, String)>,
    /// Mean of the nodes at the start, m.
    points: Vec<[f64; D]>,
    /// What is held in each stage of the run.
    stages: Vec<InStage<D>>,
}

/// What is held in a stage.
struct InStage<const D: usize> {
    /// Nodes that are held along directions across each other: node, condition, direction; by node.
    simple: Vec<(u32, u32, [f64; D])>,
    /// Whether there are other held nodes.
    has_oblique: bool,
}

impl<const D: usize> InStage<D> {
    fn new<'a>(held: impl Iterator<Item = (u32, &'a NodeConstraint<D>)>, conditions: usize) -> Self {
        let (mut simple, mut has_oblique) = (Vec::new(), false);
        for (node, held) in held {
            match held.directions() {
                // What closes a join around its axis is no condition of the model.
                Some(own) => simple.extend(own.filter(|(source, _)| (*source as usize) < conditions).map(|(source, n)| (node, source, n))),
                None => has_oblique = true,
            }
        }
        simple.sort_by_key(|&(node, source, _)| (node, source));
        Self { simple, has_oblique }
    }
}

impl<const D: usize> Held<D>
where
    Dim<D>: Dimension<D>,
{
    fn new(model: &Model, system: &System<D>) -> Self {
        let symmetries = model.symmetries.iter().enumerate().map(|(k, it)| ("symmetry", name_of(&it.name, k)));
        let constraints = model.constraints.iter().enumerate().map(|(k, it)| ("constraint", name_of(&it.name, k)));
        let names: Vec<(&str, String)> = symmetries.chain(constraints).collect();
        let mesh = &system.mesh;
        let nodes = model.symmetries.iter().map(|it| mesh.on_symmetry(it));
        let nodes = nodes.chain(model.constraints.iter().map(|it| mesh.nodes(&it.on).unwrap_or_default()));
        let points: Vec<[f64; D]> = nodes.map(|nodes| mesh.mean_place(&nodes)).collect();
        let later = system.stages.iter().flat_map(|stages| stages.later_constraints());
        let stages = std::iter::once(&system.constraints).chain(later).map(|own| InStage::new(system.held_by(own), points.len())).collect();
        Self { names, points, stages }
    }
}

impl<const D: usize> Channel<D> for Held<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    fn columns(&self, _: &System<D>) -> Vec<Column> {
        let values = || forces::<D>().iter().chain(<Dim<D>>::MOMENT);
        self.names.iter().flat_map(|(kind, name)| means(values().map(move |value| format!("{kind}.{value}[{name}]")))).collect()
    }

    fn rates(&self, system: &System<D>, row: &mut Vec<f64>) {
        // Those of a condition lie side by side.
        let (first, width) = (row.len(), D + <Dim<D>>::MOMENT.len());
        row.resize(first + width * self.points.len(), 0.0);
        let mut add = |source: u32, values: &mut dyn Iterator<Item = f64>, from: usize| {
            if (source as usize) < self.points.len() {
                row[first + width * source as usize + from..].iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            }
        };
        let mut push = |node: u32, source: u32, force: [f64; D]| {
            let about = <Dim<D>>::moment_vector(minus(system.positions[node as usize], self.points[source as usize]), force);
            add(source, &mut force.into_iter().chain(moment::<D>(about)), 0);
        };
        let Some(InStage { simple, has_oblique }) = self.stages.get(system.stage()) else { return };
        for &(node, source, direction) in simple {
            let along = dot(system.reaction(node), direction);
            push(node, source, times(along, direction));
        }
        if *has_oblique {
            for (node, held) in system.held().filter(|(_, held)| held.directions().is_none()) {
                held.share_out(system.reaction(node), |source, force| {
                    if (source as usize) < self.points.len() {
                        push(node, source, force);
                    }
                });
            }
        }
        system.moment_reactions(|_, held, reaction| held.share_out(reaction, |source, own| add(source, &mut moment::<D>(own), D)));
    }
}

/// Loads with a resultant.
struct Loads {
    /// Place in the model, name, and what it is.
    names: Vec<(usize, String, Resultant)>,
}

/// What the resultant of a load is.
#[derive(Clone, Copy, PartialEq)]
enum Resultant {
    /// Force and moment, of what acts on nodes.
    OfNodes,
    /// A moment.
    Moment,
    /// A force on mass.
    OfMass,
}

impl Loads {
    fn new(model: &Model) -> Self {
        let kind = |load: &Load| match load {
            Load::Force { .. } | Load::Pressure { .. } => Some(Resultant::OfNodes),
            Load::Moment { .. } => Some(Resultant::Moment),
            Load::Gravity { .. } | Load::Centrifugal { .. } => Some(Resultant::OfMass),
            Load::Damping { .. } | Load::StiffnessDamping { .. } => None,
        };
        let name = |place: usize| name_of(model.load_terms.get(place).map_or("", |terms| &terms.name), place);
        Self { names: model.loads.iter().enumerate().filter_map(|(k, load)| Some((k, name(k), kind(load)?))).collect() }
    }
}

impl<const D: usize> Channel<D> for Loads
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    fn columns(&self, _: &System<D>) -> Vec<Column> {
        let mut columns = Vec::new();
        for (_, name, kind) in &self.names {
            let column = |value: &&str| format!("load.{value}[{name}]");
            match kind {
                Resultant::OfNodes => columns.extend(means(forces::<D>().iter().chain(<Dim<D>>::MOMENT).map(column))),
                Resultant::Moment => columns.extend(means(<Dim<D>>::MOMENT.iter().map(column))),
                Resultant::OfMass => columns.extend(means(forces::<D>().iter().map(column))),
            }
        }
        columns
    }

    fn rates(&self, system: &System<D>, row: &mut Vec<f64>) {
        for &(place, _, kind) in &self.names {
            match kind {
                Resultant::OfNodes => {
                    let found = system.forces.resultants().find(|(index, _)| *index == place);
                    let found = found.map(|(_, resultant)| resultant).unwrap_or_default();
                    row.extend(found.force.into_iter().chain(moment::<D>(found.moment)));
                }
                Resultant::Moment => {
                    let found = system.rotations.load_moments().find(|(index, _)| *index == place);
                    row.extend(moment::<D>(found.map_or([0.0; 3], |(_, moment)| moment)));
                }
                Resultant::OfMass => row.extend(system.body_forces.resultant(place, &system.mass, &system.positions)),
            }
        }
    }
}
