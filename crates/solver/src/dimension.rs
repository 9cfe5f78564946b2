//! The traits of a dimension that the system needs, under one name.

use crate::block::Blocks;
use crate::contact::springs::TangentSpace;
use crate::contact::traces::Tractions;
use crate::mesh::geometry::CellGeometry;
use crate::rotation::Rotate;
use crate::skins::RotatedArm;
use crate::tensor::Space;

/// All that the step and what stands below it ask of a dimension: each trait belongs to the module that needs
/// it.
pub trait Dimension<const D: usize>:
    Space<D> + CellGeometry<D> + Rotate<D> + TangentSpace<D> + Tractions<D> + RotatedArm<D> + Blocks<D> + Send + Sync + 'static
{
}

impl<T, const D: usize> Dimension<D> for T where
    T: Space<D> + CellGeometry<D> + Rotate<D> + TangentSpace<D> + Tractions<D> + RotatedArm<D> + Blocks<D> + Send + Sync + 'static
{
}
