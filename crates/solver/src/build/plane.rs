//! What is built in 2D in a way of its own: the axis of an axisymmetric body, the outlines of all bodies, and
//! surfaces that continue beyond symmetry lines.

use super::Builder;
use crate::contact::outline::Outlines;
use crate::contact::projection::node_segment::Target;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::mesh::messages::NEGATIVE_RADIUS;
use crate::mesh::surface::{NONE, Surface};
use crate::model::{Model, Symmetry};
use crate::vector::{dot, minus};

/// An axisymmetric model with its axis as a symmetry line, if it touches that.
pub(crate) fn with_axis(model: &Model, mesh: &Mesh<2>) -> Result<Option<Model>, Vec<Fault>> {
    if !model.is_axisymmetric() {
        return Ok(None);
    }
    // Nodes nearer to the axis are on it.
    let near = crate::mesh::tolerance(&mesh.positions);
    if let Some([x, y]) = mesh.positions.iter().find(|x| x[0] < -near) {
        let message = format!("an axisymmetric part has a node at a negative radius, ({x:.6e}, {y:.6e}) m");
        return Err(vec![Fault::new(&NEGATIVE_RADIUS, "part", message, "x is the radius: move the part to the right of the axis x = 0")]);
    }
    let touches = mesh.positions.iter().any(|x| x[0] <= near);
    let axis = Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() };
    let is_there = |symmetry: &Symmetry| symmetry.parts.is_empty() && symmetry.point[0] == 0.0 && symmetry.normal[1] == 0.0;
    if !touches || model.symmetries.iter().any(is_there) {
        return Ok(None);
    }
    let mut model = model.clone();
    model.symmetries.push(axis);
    Ok(Some(model))
}

impl Builder<'_, 2> {
    /// Outlines of all bodies; nothing where nothing meets them.
    pub(crate) fn outlines(&self) -> Outlines {
        if self.model.contacts.is_empty() && self.model.obstacles.is_empty() {
            return Outlines::default();
        }
        // Elements that overlap are reported elsewhere.
        let outside = self.mesh.outside(&[]).map(|surface| surface.segments).unwrap_or_default();
        Outlines::new(&outside, |segment| self.constraints.is_mirror(segment), &self.body_of_node, &self.mesh.positions)
    }

    /// A surface as a target that continues beyond symmetry lines.
    pub(super) fn with_mirrors(&self, surface: Surface<2>) -> Target {
        let starts =
            surface.segments.iter().zip(&surface.previous).filter(|(_, previous)| **previous == NONE).map(|(segment, _)| segment[0]);
        let ends = surface.segments.iter().zip(&surface.next).filter(|(_, next)| **next == NONE).map(|(segment, _)| segment[1]);
        let open = starts.chain(ends);
        let mut mirrors: Vec<(u32, [f64; 2])> =
            open.filter_map(|node| Some((node, self.constraints.mirror_normals(node).next()?))).collect();
        mirrors.sort_by_key(|&(node, _)| node);
        Target { surface, mirrors }
    }

    /// Whether a point lies on a symmetry line of one of these parts (none: all) or beyond it, where the
    /// mirror images of the parts are.
    pub(crate) fn is_beyond_mirrors(&self, x: [f64; 2], parts: &[String]) -> bool {
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        let concerns = |held: &[String]| held.is_empty() || parts.is_empty() || held.iter().any(|part| parts.contains(part));
        self.mirrors()
            .any(|(number, point, normal)| concerns(&self.model.symmetries[number].parts) && dot(minus(x, point), normal) <= tolerance)
    }
}
