//! What mass scaling would need: of each element the mass that it must weigh more for a step, the whole as a
//! function of the step, and the longest step within a limit.

use super::{FailureEntity, Neighbourhood};
use crate::error::Error;
use crate::mesh::geometry::CellGeometry;
use crate::model::{MassScaling, Model, in_3d};
use crate::simulation::{Either, Options, Runs, Simulation, either};
use crate::step::System;
use crate::tensor::Dim;
use std::collections::BTreeMap;

/// An element that is too light.
#[derive(Clone, Debug, PartialEq)]
pub struct Heavy {
    /// Its part.
    pub part: String,
    /// Its number in the part.
    pub element: usize,
    /// Mean of its nodes, m.
    pub at: [f64; 3],
    /// Its stable step, `safety` included, s.
    pub time_step: f64,
    /// Its mass, kg/m.
    pub mass: f64,
    /// What it needs besides, kg/m.
    pub added: f64,
}

/// What a part needs.
#[derive(Clone, Debug, PartialEq)]
pub struct PartNeeds {
    /// Its name.
    pub part: String,
    /// Elements, and how many of them are too light.
    pub elements: usize,
    /// See `elements`.
    pub light: usize,
    /// Its mass, and what it needs besides, kg/m.
    pub mass: f64,
    /// See `mass`.
    pub added: f64,
}

/// What mass scaling needs for a step.
pub struct MassNeeded {
    /// The model without mass scaling, at the start.
    pub simulation: Simulation,
    /// The step and the limit that the model asks for.
    pub scaling: MassScaling,
    /// The worst element.
    pub failure_entity: FailureEntity,
    /// The elements that need most, worst first.
    pub heaviest: Vec<Heavy>,
    /// Deformable parts that need any.
    pub parts: Vec<PartNeeds>,
    /// Mass of all deformable parts, kg/m.
    pub mass: f64,
    /// Of each element its part, its number there, and its stable step, `safety` included (s), and its mass
    /// (kg/m).
    steps: Vec<(usize, usize, [f64; 2])>,
}

/// So many elements are named.
const NAMED: usize = 20;

impl MassNeeded {
    /// What a model that asks for mass scaling needs; `None` where it asks for none.
    ///
    /// # Errors
    /// Those of [`Simulation::new`] for the model without mass scaling.
    pub fn of(model: &Model, options: &Options) -> Result<Option<Self>, Error> {
        let Some(scaling) = model.run.mass_scaling else { return Ok(None) };
        let mut plain = model.clone();
        plain.run.mass_scaling = None;
        let simulation = Simulation::new(&plain, options)?;
        let Looked { mut parts, steps, heaviest, failure_entity } = either!(&simulation, run => look(&run.system, model, scaling));
        let mass = parts.iter().map(|part| part.mass).sum();
        parts.retain(|part| part.light > 0);
        Ok(Some(Self { simulation, scaling, failure_entity, heaviest, parts, mass, steps }))
    }

    /// Mass that a step needs, as a fraction of that of the deformable parts.
    #[must_use]
    pub fn share(&self, time_step: f64) -> f64 {
        self.steps.iter().map(|&(.., element)| added(time_step, element)).sum::<f64>() / self.mass
    }

    /// What each of some elements needs besides its own mass, over that.
    #[must_use]
    pub fn shares_of(&self, near: &Neighbourhood) -> Vec<f64> {
        let of: BTreeMap<(usize, usize), [f64; 2]> = self.steps.iter().map(|&(part, element, own)| ((part, element), own)).collect();
        let share = |own: &[f64; 2]| added(self.scaling.time_step, *own) / own[1];
        near.cells.iter().map(|cell| of.get(&(cell.part, cell.element)).map_or(f64::NAN, share)).collect()
    }

    /// The longest step within the limit, s.
    #[must_use]
    pub fn longest(&self) -> f64 {
        let (mut low, mut high) = (0.0, self.scaling.time_step);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.share(middle) > self.scaling.limit { high = middle } else { low = middle }
        }
        low
    }
}

/// What elements need, as they are looked at one by one.
struct Looked {
    parts: Vec<PartNeeds>,
    steps: Vec<(usize, usize, [f64; 2])>,
    heaviest: Vec<Heavy>,
    failure_entity: FailureEntity,
}

/// What the elements of a model need for a step.
fn look<const D: usize>(system: &System<D>, model: &Model, scaling: MassScaling) -> Looked
where
    Dim<D>: Runs<D>,
{
    let safety = model.run.safety;
    let mut needed = Vec::new();
    let (mut steps, mut parts) = (Vec::new(), Vec::<PartNeeds>::new());
    for (g, (group, block)) in system.mesh.groups.iter().zip(&system.blocks).enumerate().filter(|(g, _)| !system.rigid[*g]) {
        let part = &model.parts[group.part];
        let density = model.materials.get(&part.material).and_then(|it| it.parameters.get("density")).copied().unwrap_or(f64::NAN);
        if parts.last().is_none_or(|last| last.part != part.name) {
            parts.push(PartNeeds { part: part.name.clone(), elements: 0, light: 0, mass: 0.0, added: 0.0 });
        }
        let Some(sums) = parts.last_mut() else { continue };
        for (element, cell) in group.cells().enumerate() {
            let at = in_3d(system.centre(cell.nodes));
            let depth = if part.is_axisymmetric() { std::f64::consts::TAU * at[0] } else { 1.0 };
            let area = part.area.filter(|_| cell.kind.dimension() == 1).unwrap_or(1.0);
            let mass = density * area * depth * <Dim<D>>::size(cell, &system.positions) * part.mass_scale;
            let time_step = safety * block.time_step_squared(element).sqrt();
            let added = added(scaling.time_step, [time_step, mass]);
            sums.elements += 1;
            sums.light += usize::from(added > 0.0);
            (sums.mass, sums.added) = (sums.mass + mass, sums.added + added);
            let user = group.user_elements[element] as usize;
            steps.push((group.part, user, [time_step, mass]));
            if added > 0.0 {
                needed.push(((g, element), Heavy { part: part.name.clone(), element: user, at, time_step, mass, added }));
            }
        }
    }
    needed.sort_by(|(_, a), (_, b)| b.added.total_cmp(&a.added));
    let failure_entity = needed.first().map_or(FailureEntity::default(), |(element, _)| system.failure_of_element(*element));
    Looked { parts, steps, heaviest: needed.into_iter().take(NAMED).map(|(_, heavy)| heavy).collect(), failure_entity }
}

/// Mass that an element of a stable step and a mass needs for a step, kg/m.
fn added(time_step: f64, [own, mass]: [f64; 2]) -> f64 {
    let ratio = time_step / own;
    if ratio > 1.0 { mass * (ratio * ratio - 1.0) } else { 0.0 }
}
