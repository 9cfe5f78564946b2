//! What is built in a way of its own in 2D and 3D ([`Builds`], on [`Dim`]).

use super::{Builder, plane};
use crate::contact::Contact;
use crate::dimension::Dimension;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::model::{self, Model};
use crate::rigid::Body;
use crate::tensor::Dim;

/// What the builder does by dimension.
pub trait Builds<const D: usize>: Dimension<D> {
    /// The model with what its mesh asks for besides: the axis that an axisymmetric body touches.
    ///
    /// # Errors
    /// Nodes where no axisymmetric body can be.
    fn with_axis(model: &Model, mesh: &Mesh<D>) -> Result<Option<Model>, Vec<Fault>>
    where
        Dim<D>: Builds<D>;
    /// Notes penetrations at the start as faults, or gives lines for the overview; those that shall be pushed
    /// out are, in the mesh.
    fn resolve_initial_penetration(builder: &mut Builder<'_, D>) -> Vec<String>
    where
        Dim<D>: Builds<D>;
    /// The body of a rigid part with its mass on its nodes, kg/m (kg).
    fn rigid_part(builder: &Builder<'_, D>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<D>
    where
        Dim<D>: Builds<D>;
    /// The contacts of the model; notes faults.
    fn contacts(builder: &mut Builder<'_, D>) -> Vec<Contact<D>>
    where
        Dim<D>: Builds<D>;
    /// Its obstacles.
    fn obstacles(builder: &mut Builder<'_, D>) -> Vec<Contact<D>>
    where
        Dim<D>: Builds<D>;
    /// Gives contacts and obstacles new surfaces after elements were eroded.
    fn renew(builder: &mut Builder<'_, D>, contacts: &mut [Contact<D>])
    where
        Dim<D>: Builds<D>;
}

impl Builds<2> for Dim<2> {
    fn with_axis(model: &Model, mesh: &Mesh<2>) -> Result<Option<Model>, Vec<Fault>> {
        plane::with_axis(model, mesh)
    }
    fn resolve_initial_penetration(builder: &mut Builder<'_, 2>) -> Vec<String> {
        builder.resolve_initial_penetration()
    }
    fn rigid_part(builder: &Builder<'_, 2>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<2> {
        builder.rigid_part(index, motion, own)
    }
    fn contacts(builder: &mut Builder<'_, 2>) -> Vec<Contact> {
        builder.contacts()
    }
    fn obstacles(builder: &mut Builder<'_, 2>) -> Vec<Contact> {
        builder.obstacles()
    }
    fn renew(builder: &mut Builder<'_, 2>, contacts: &mut [Contact]) {
        builder.renew(contacts);
    }
}

impl Builds<3> for Dim<3> {
    fn with_axis(_: &Model, _: &Mesh<3>) -> Result<Option<Model>, Vec<Fault>> {
        Ok(None)
    }
    fn resolve_initial_penetration(builder: &mut Builder<'_, 3>) -> Vec<String> {
        builder.resolve_initial_penetration_in_3d()
    }
    fn rigid_part(builder: &Builder<'_, 3>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<3> {
        builder.rigid_part_in_3d(index, motion, own)
    }
    fn contacts(builder: &mut Builder<'_, 3>) -> Vec<Contact<3>> {
        builder.contacts_in_3d()
    }
    fn obstacles(builder: &mut Builder<'_, 3>) -> Vec<Contact<3>> {
        builder.obstacles_in_3d()
    }
    fn renew(builder: &mut Builder<'_, 3>, contacts: &mut [Contact<3>]) {
        builder.renew_in_3d(contacts);
    }
}
