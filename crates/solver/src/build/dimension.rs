//! What is built in a way of its own in 2D and 3D ([`Builds`], on [`Dim`]).

use super::start::AtStart;
use super::{Builder, plane};
use crate::contact::Formulation;
use crate::contact::depths::Depths;
use crate::contact::formulation::Side;
use crate::contact::initial::{Penetrating, is_ignored};
use crate::contact::outline::Outlines;
use crate::contact::overlap::OverlapCheck;
use crate::contact::projection::node_segment::Target;
use crate::dimension::Dimension;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::mesh::surface::{SpaceSurface, Surface};
use crate::model::{self, Model};
use crate::rigid::Body;
use crate::tensor::Dim;

/// What the builder does by dimension.
pub trait Builds<const D: usize>: Dimension<D> + Penetrating<D> {
    /// The model with what its mesh asks for besides: the axis that an axisymmetric body touches.
    ///
    /// # Errors
    /// Nodes where no axisymmetric body can be.
    fn with_axis(model: &Model, mesh: &Mesh<D>) -> Result<Option<Model>, Vec<Fault>>
    where
        Dim<D>: Builds<D>;
    /// What is inside an obstacle at the start, and how it is pushed out where that is wanted.
    fn obstacle_at_start(builder: &Builder<'_, D>, obstacle: &model::Obstacle, tolerance: f64) -> AtStart<D>
    where
        Dim<D>: Builds<D>;
    /// Penetrations that are found when all others have been pushed out: faults are noted, lines for the
    /// overview returned.
    fn left_at_start(builder: &mut Builder<'_, D>, tolerance: f64) -> Vec<String>
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
    /// A surface that nodes of a contact are projected on.
    fn target(builder: &Builder<'_, D>, surface: Surface<D>) -> Self::Target
    where
        Dim<D>: Builds<D>;
    /// Part of a node of a surface that belongs to the model, and not to its images in symmetries.
    fn share(builder: &Builder<'_, D>, target: &Self::Target, node: u32) -> f64
    where
        Dim<D>: Builds<D>;
    /// What looks at the bodies of a contact as they are.
    ///
    /// # Errors
    /// Elements that overlap.
    fn overlap_check(
        builder: &Builder<'_, D>,
        contact: &model::Contact,
        sides: &[Side<'_, D>],
        outlines: &Self::Outlines,
    ) -> Result<Self::OverlapCheck, Fault>
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
    fn obstacle_at_start(builder: &Builder<'_, 2>, obstacle: &model::Obstacle, tolerance: f64) -> AtStart<2> {
        builder.obstacle_at_start(obstacle, tolerance).unwrap_or_default()
    }
    fn left_at_start(_: &mut Builder<'_, 2>, _: f64) -> Vec<String> {
        Vec::new()
    }
    fn rigid_part(builder: &Builder<'_, 2>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<2> {
        builder.rigid_part(index, motion, own)
    }
    type Outlines = Outlines;
    fn outlines(builder: &Builder<'_, 2>) -> Outlines {
        builder.outlines()
    }
    fn target(builder: &Builder<'_, 2>, surface: Surface<2>) -> Target {
        builder.with_mirrors(surface)
    }
    fn share(_: &Builder<'_, 2>, target: &Target, node: u32) -> f64 {
        if target.mirrors.binary_search_by_key(&node, |&(node, _)| node).is_ok() { 0.5 } else { 1.0 }
    }
    fn overlap_check(
        builder: &Builder<'_, 2>,
        contact: &model::Contact,
        sides: &[Side<'_, 2>],
        outlines: &Outlines,
    ) -> Result<Depths, Fault> {
        // Where something is tied, or overlaps at the start, bodies are not looked at.
        let is_judging = contact.tied.is_none() && !is_ignored(&contact.interface);
        Ok(Side::depths(sides, outlines, &builder.body_of_node, is_judging))
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
    fn obstacle_at_start(builder: &Builder<'_, 3>, obstacle: &model::Obstacle, tolerance: f64) -> AtStart<3> {
        builder.obstacle_at_start_in_3d(obstacle, tolerance).unwrap_or_default()
    }
    fn left_at_start(builder: &mut Builder<'_, 3>, tolerance: f64) -> Vec<String> {
        builder.inside_triangles(tolerance)
    }
    fn rigid_part(builder: &Builder<'_, 3>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<3> {
        builder.rigid_part_in_3d(index, motion, own)
    }
    type Outlines = ();
    fn outlines(_: &Builder<'_, 3>) {}
    fn target(builder: &Builder<'_, 3>, surface: SpaceSurface) -> SpaceSurface {
        let mirrors = |edge: [u32; 2]| builder.constraints.common_mirrors(&edge).collect::<Vec<_>>();
        surface.with_mirrors(mirrors, &builder.mesh.positions).with_kin(&builder.mesh.kin)
    }
    fn share(builder: &Builder<'_, 3>, _: &SpaceSurface, node: u32) -> f64 {
        builder.constraints.share(node)
    }
    fn overlap_check(builder: &Builder<'_, 3>, contact: &model::Contact, sides: &[Side<'_, 3>], (): &()) -> Result<OverlapCheck, Fault> {
        builder.overlap_check(sides, contact)
    }
    fn obstacle(builder: &mut Builder<'_, 3>, obstacle: &model::Obstacle, (): &()) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        builder.obstacle_in_3d(obstacle)
    }
}
