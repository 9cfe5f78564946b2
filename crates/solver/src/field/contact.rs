//! What contact does to nodes on surfaces; other nodes have zero, and no gap.

use super::{Components, Description};
use crate::dimension::Dimension;
use crate::field::kind::Needs;
use crate::field::snapshot::LiveSnapshot;
use crate::tensor::Dim;

pub(super) fn fields() -> Vec<Description> {
    let scalar = |name, unit, doc, source| Description::new(name, Components::Scalar, unit, doc, source).needs(Needs::Contact);
    vec![
        Description::new(
            "contact_force",
            Components::Vector,
            "N/m",
            "sum of the contact and obstacle forces on the node, per metre of depth (of an axisymmetric model in N, all around)",
            of_nodes!(force),
        )
        .needs(Needs::Contact)
        .in_3d("N"),
        scalar(
            "contact_pressure",
            "Pa",
            "normal part of the contact force over the node's current length (of an axisymmetric model area) of surface",
            of_nodes!(pressure),
        ),
        scalar("contact_shear", "Pa", "tangential part, along the surface with the body on its right", of_nodes!(shear))
            .needs(Needs::Friction),
        scalar(
            "contact_gap",
            "m",
            "distance from what is opposite, negative where it penetrates (inside a body where no node holds it: \
                minus the distance to its surface when the bodies were last looked at); not a number where nothing \
                is near",
            of_nodes!(gap),
        ),
        scalar("contact_slip", "m", "distance that the surfaces have slid on each other", of_nodes!(slip)),
        scalar("contact_status", "", "0 open, 1 stick, 2 slip (closed without friction counts as slip)", of_nodes!(status)),
        scalar("friction_heat", "J/m^2", "friction work so far, half of it on either surface, per initial surface", of_nodes!(heat))
            .needs(Needs::Friction),
    ]
}

fn force<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values.copy_from_slice(&at.system.contact_forces.of(node));
}

fn pressure<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values[0] = at.traction(node)[0];
}

fn shear<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values[0] = at.traction(node)[1];
}

fn gap<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values[0] = at.contact_state(node).gap;
}

fn slip<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values[0] = at.system.traces.slip(node);
}

fn status<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values[0] = at.contact_state(node).status;
}

fn heat<const D: usize>(at: &LiveSnapshot<'_, D>, node: usize, values: &mut [f64])
where
    Dim<D>: Dimension<D>,
{
    values[0] = at.system.traces.heat(node);
}
