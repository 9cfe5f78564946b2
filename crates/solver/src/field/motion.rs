//! How nodes move.

use super::{Components, Description};
use crate::dimension::Dimension;
use crate::field::snapshot::LiveSnapshot;
use crate::tensor::Dim;
use crate::vector::minus;

pub(super) fn fields() -> Vec<Description> {
    let vector = |name, unit, doc, source| Description::new(name, Components::Vector, unit, doc, source);
    vec![
        vector("displacement", "m", "current minus initial position", of_nodes!(displacement)),
        vector("velocity", "m/s", "velocity at the frame's time", of_nodes!(velocity)),
    ]
}

fn displacement<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values.copy_from_slice(&minus(at.system.positions[node], at.system.mesh.positions[node]));
}

fn velocity<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values.copy_from_slice(&at.system.velocity(node));
}
