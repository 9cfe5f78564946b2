//! Rigid parts and the gas in cavities.

use super::{Channel, Column, forces, means, samples};
use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::load::cavity::{self, Cavity};
use crate::rigid::{Body, RigidMotion};
use crate::step::System;
use crate::tensor::Dim;

/// The group.
pub(super) struct Bodies;

/// Rigid parts whose motion is prescribed, if only in part.
fn driven<const D: usize>(system: &System<D>) -> impl Iterator<Item = (usize, &Body<D>)>
where
    Dim<D>: Dimension<D>,
{
    let all = system.body_parts.iter().map(|&(part, body)| (part, system.bodies.state(body)));
    all.filter(|(_, body)| body.drives().iter().any(Option::is_some))
}

impl<const D: usize> Channel<D> for Bodies
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    fn columns(&self, system: &System<D>) -> Vec<Column> {
        let name = |part: usize| &system.mesh.parts[part].name;
        let mut columns = Vec::new();
        for &(part, _) in &system.body_parts {
            columns.extend(samples(<Dim<D>>::MOTION.iter().map(|value| format!("rigid.{value}[{}]", name(part)))));
        }
        for (part, _) in driven(system) {
            let values = forces::<D>().iter().chain(<Dim<D>>::MOMENT);
            columns.extend(means(values.map(|value| format!("rigid.{value}[{}]", name(part)))));
        }
        for cavity in system.cavities.iter() {
            columns.extend(samples(cavity::VALUES.iter().map(|value| format!("cavity.{value}[{}]", cavity.name))));
        }
        columns
    }

    fn samples(&self, system: &System<D>, row: &mut Vec<f64>) {
        for &(_, body) in &system.body_parts {
            row.extend(<Dim<D>>::motion(system.bodies.state(body), system.before()));
        }
        row.extend(system.cavities.iter().flat_map(Cavity::values));
    }

    fn rates(&self, system: &System<D>, row: &mut Vec<f64>) {
        for (_, body) in driven(system) {
            let reaction = |k: usize| if body.drives()[k].is_some() { -(body.internal[k] + body.force[k] + body.load[k]) } else { 0.0 };
            // Those along the axes, then about them: in 2D the third velocity is the spin.
            row.extend((0..<Dim<D>>::FREEDOMS).map(reaction));
        }
    }
}
