//! Sheets: the middle surfaces of shells in space, from shapes in the plane, lines that are swept, and the
//! skins of solids.
//!
//! A sheet is a body of quadrilaterals and triangles in 3D, of which nodes run counter-clockwise seen from the
//! side that its normal looks to. It has no sides: what bounds it or lies on it is a set of nodes. Faces are
//! made by `mesh/skin.rs`.

use super::{Body, Count, Part, UNMESHABLE};
use crate::error::Fault;
use crate::input::sections::ELEMENTS_MAX;
use crate::mesh::cell::CellKind;
use crate::mesh::sorted;
use crate::mesh::surface::Corners;

/// The skin of a solid shape of which a shell can be made.
pub(crate) struct Skin {
    /// The sides of the solid that it consists of.
    pub(super) sides: &'static [&'static str],
    /// How large it will be.
    pub(super) count: Count,
}

impl Part {
    /// Whether its shape can be that of a shell in space: a surface, lines that are swept, or a solid with a
    /// skin; of a group of a mesh file only the file knows.
    #[must_use]
    pub(crate) fn makes_sheet(&self) -> bool {
        match (self.shape.solid(), self.shape.built_in()) {
            (Some((solid, _)), _) => solid.skin().is_some(),
            (_, Some((shape, _))) => (shape.cell_kind() == CellKind::Line) == self.sweep.is_some(),
            (None, None) => true,
        }
    }

    /// The middle surface of a shell in space, not yet placed; `None` for a group of a mesh file, and where
    /// [`Part::makes_sheet`] is false.
    pub(super) fn sheet(&self) -> Option<Result<Body<3>, Fault>> {
        if !self.makes_sheet() {
            return None;
        }
        if let Some((shape, key)) = self.shape.solid() {
            let skin = shape.skin()?;
            let count = shape.count();
            if count.elements as u128 > ELEMENTS_MAX || count.nodes > u32::MAX as usize {
                let message = "the solid whose skin this is would have too many elements";
                let path = format!("{key}.{}", shape.size_key());
                return Some(Err(Fault::new(&UNMESHABLE, path, message, "take fewer elements, or `line` or `arc` with `revolve`")));
            }
            return Some(shape.body().map(|body| body.skin(skin.sides)).map_err(|wrong| wrong.at(key)));
        }
        let (shape, key) = self.shape.built_in()?;
        let body = shape.body().map_err(|wrong| wrong.at(key));
        Some(match &self.sweep {
            Some(sweep) => body.and_then(|lines| sweep.sheet(&lines).map_err(|wrong| wrong.at(sweep.key()))),
            None => body.map(Body::sheet),
        })
    }
}

impl Body<2> {
    /// The same in the plane z = 0, its normal along z.
    fn sheet(self) -> Body<3> {
        let positions = self.positions.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        let rims = self.sides.into_iter().map(|(name, segments)| (name, sorted(segments.into_iter().flatten())));
        Body { positions, elements: self.elements, sides: Vec::new(), points: rims.chain(self.points).collect() }
    }
}

impl Body<3> {
    /// The surface of which these sides of a solid consist; each side of the solid becomes the set of those of
    /// its nodes that are left.
    fn skin(&self, of: &[&str]) -> Self {
        let mut sheet = Self::default();
        for facet in self.sides.iter().filter(|(name, _)| of.contains(&name.as_str())).flat_map(|(_, facets)| facets) {
            let corners = facet.corners();
            let kind = if corners.len() == 3 { CellKind::Triangle } else { CellKind::Quadrilateral };
            sheet.add([kind.cell(corners)]);
        }
        let used = sorted(sheet.cells().flat_map(|cell| cell.nodes).copied());
        let left = |facets: &[[u32; 4]]| sorted(facets.iter().flatten().copied().filter(|node| used.binary_search(node).is_ok()));
        sheet.points = self.sides.iter().map(|(name, facets)| (name.clone(), left(facets))).collect();
        sheet.only_used(&self.positions);
        sheet
    }
}
