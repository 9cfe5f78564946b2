//! What is built in a way of its own in 2D and 3D ([`Builds`], on [`Dim`]).

use super::{Builder, plane};
use crate::contact::Formulation;
use crate::contact::outline::Outlines;
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
    /// What contacts are made with beyond the builder: in 2D the outlines of all bodies.
    type Outlines;
    /// See [`Builds::Outlines`].
    fn outlines(builder: &Builder<'_, D>) -> Self::Outlines
    where
        Dim<D>: Builds<D>;
    /// What makes the springs of a contact, and the number of the terms that they follow. Faults have paths
    /// relative to the contact.
    ///
    /// # Errors
    /// All faults of the contact.
    fn formulation(
        builder: &mut Builder<'_, D>,
        contact: &model::Contact,
        outlines: &Self::Outlines,
    ) -> Result<(Box<dyn Formulation<D>>, usize), Vec<Fault>>
    where
        Dim<D>: Builds<D>;
    /// The body of an obstacle, and what makes springs at it. Faults have paths relative to the obstacle.
    ///
    /// # Errors
    /// What is wrong with it.
    fn obstacle(
        builder: &mut Builder<'_, D>,
        obstacle: &model::Obstacle,
        outlines: &Self::Outlines,
    ) -> Result<(usize, Box<dyn Formulation<D>>), Fault>
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
    type Outlines = Outlines;
    fn outlines(builder: &Builder<'_, 2>) -> Outlines {
        builder.outlines()
    }
    fn formulation(
        builder: &mut Builder<'_, 2>,
        contact: &model::Contact,
        outlines: &Outlines,
    ) -> Result<(Box<dyn Formulation<2>>, usize), Vec<Fault>> {
        builder.formulation(contact, outlines)
    }
    fn obstacle(
        builder: &mut Builder<'_, 2>,
        obstacle: &model::Obstacle,
        outlines: &Outlines,
    ) -> Result<(usize, Box<dyn Formulation<2>>), Fault> {
        builder.obstacle_formulation(obstacle, outlines)
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
    type Outlines = ();
    fn outlines(_: &Builder<'_, 3>) {}
    fn formulation(
        builder: &mut Builder<'_, 3>,
        contact: &model::Contact,
        (): &(),
    ) -> Result<(Box<dyn Formulation<3>>, usize), Vec<Fault>> {
        builder.node_facet(contact)
    }
    fn obstacle(builder: &mut Builder<'_, 3>, obstacle: &model::Obstacle, (): &()) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        builder.obstacle_in_3d(obstacle)
    }
}
