//! Faults of shells and of the layers in them.

use super::Check;
use crate::material;
use crate::mesh::cell::CellKind;
use crate::mesh::messages::SHELLS;
use crate::model::{GAUSS, LOBATTO, LOWER, MIDDLE, Part, Shape, ShellSection, UPPER};
use crate::quantity::{Dimension, Range};
use crate::vocabulary::excerpt;

impl Check<'_> {
    /// What shells need, and what they can't have.
    pub(super) fn shells(&mut self, path: &str, part: &Part) {
        let at = format!("{path}.section");
        if !part.is_of_shells() {
            if part.section.is_some() {
                self.fault(
                    &SHELLS,
                    at,
                    "`section` is that of shells, but the part has none",
                    if self.model.dimension_of(part) == 3 {
                        "leave it out, or take `element = \"shell4\"`"
                    } else {
                        "leave it out, or take `element = \"shell2\"`"
                    },
                );
            }
            return;
        }
        if let Some((message, help)) = self.no_shell(part) {
            self.fault(&SHELLS, format!("{path}.element"), message, help);
            return;
        }
        if part.element_triangles != "tri3" && part.element_triangles != "shell3" && !part.element_triangles.is_empty() {
            let message = "`element_triangles` is that of solids, but the part is a shell";
            self.fault(&SHELLS, format!("{path}.element_triangles"), message, "leave it out: triangles of shells are `shell3`");
        }
        let Some(section) = &part.section else {
            self.fault(&SHELLS, at, "shells need their thickness", "add `section = { thickness = \"2 mm\" }`");
            return;
        };
        for (key, value) in [("failed_points", section.failed_points), ("fold_angle", section.fold_angle)] {
            self.number(&format!("{at}.{key}"), value);
        }
        if section.thickness_field.is_empty() {
            self.number(&format!("{at}.thickness"), section.thickness);
        } else {
            self.thickness_field(&format!("{at}.thickness_field"), part, &section.thickness_field);
        }
        self.known(&format!("{at}.reference"), "reference", &section.reference, &[MIDDLE, LOWER, UPPER]);
        self.number(&format!("{at}.offset"), section.offset);
        self.vector(&format!("{at}.thickness_growth"), section.thickness_growth);
        self.vector(&format!("{at}.thickness_point"), section.thickness_point);
        if section.middle().abs() > 0.5 * (1.0 + 1e-12) {
            let message =
                format!("`offset` is {} m, but the nodes of a shell lie within its thickness of {} m", section.offset, section.thickness);
            let help = "take half of the thickness at most; `reference = \"lower\"` puts the nodes on the lower face";
            self.fault(&SHELLS, format!("{at}.offset"), message, help);
        }
        self.known(&format!("{at}.rule"), "rule", &section.rule, &[GAUSS, LOBATTO]);
        let least = if section.rule == LOBATTO { 3 } else { 1 };
        self.layers(path, part, section, least);
        if section.layers.is_empty() && !(least..=10).contains(&section.points) {
            let message = format!("`{}` has {least} to 10 points, not {}", section.rule, section.points);
            self.fault(&SHELLS, format!("{at}.points"), message, "take as many as that: 5 do in most cases");
        }
        self.has_no_pressure(&format!("{path}.material"), &part.material);
        if part.hourglass.is_some() {
            self.fault(&SHELLS, format!("{path}.hourglass"), "these shells have no hourglass control", "leave it out");
        }
        self.rotating(&SHELLS, path, part, Part::is_of_shells, ["shells", "their membrane"]);
    }

    /// A thickness from a mesh file needs one that has it.
    fn thickness_field(&mut self, path: &str, part: &Part, name: &str) {
        let model = self.model;
        let (Shape::Group { mesh, .. }, None) = (&part.shape, &part.sweep) else {
            let message = format!("part `{}` is not a group of a mesh file as it is, so no file gives its thickness", excerpt(&part.name));
            self.fault(&SHELLS, path, message, "give `thickness`, or take `mesh` without a sweep");
            return;
        };
        // What can't be read has its own fault.
        let Some(source) = model.meshes.get(*mesh) else { return };
        let known: Vec<&str> = source.fields.iter().map(|field| field.name.as_str()).collect();
        self.known(path, "field in the mesh file", name, &known);
    }

    /// A law with a pressure of its own can't be that of a shell.
    fn has_no_pressure(&mut self, at: &str, name: &str) {
        let Some(material) = self.model.materials.get(name) else { return };
        if !material.eos.is_empty() || material::equation_of_state(&material.law) == Some([true, true]) {
            let message = format!("`{}` has an equation of state, but there is no pressure across a shell", excerpt(name));
            self.fault(&SHELLS, at, message, "take a solid without one, such as `elastic` or `j2`");
        }
    }

    /// Layers of a shell: materials that go together, points, and angles where there is a direction to turn.
    fn layers(&mut self, path: &str, part: &Part, section: &ShellSection, least: usize) {
        let materials: Vec<String> = self.model.materials.keys().cloned().collect();
        let materials: Vec<&str> = materials.iter().map(String::as_str).collect();
        let mut first: Option<(&str, bool)> = None;
        for (k, layer) in section.layers.iter().enumerate() {
            let at = format!("{path}.section.layers[{k}]");
            self.within(&format!("{at}.thickness"), layer.thickness, Dimension::LENGTH, Range::Positive);
            self.within(&format!("{at}.angle"), layer.angle, Dimension::NONE, Range::Finite);
            if layer.points.is_some_and(|points| !(least..=10).contains(&points)) {
                let message = format!("`{}` has {least} to 10 points in a layer", section.rule);
                self.fault(&SHELLS, format!("{at}.points"), message, "take as many as that: 2 Gauss points do while it is elastic");
            }
            if layer.angle != 0.0 && self.model.dimension() == 2 {
                let help = "take `shell4` in 3D, or a material whose axes are exchanged";
                self.fault(&SHELLS, format!("{at}.angle"), "a layer can't be turned about its normal in 2D", help);
            }
            let name = section.material_of(layer, &part.material);
            if !layer.material.is_empty() {
                self.known(&format!("{at}.material"), "material", name, &materials);
                self.has_no_pressure(&format!("{at}.material"), name);
            }
            let Some(is_rubber) = self.model.materials.get(name).and_then(|it| material::is_hyperelastic(&it.law)) else { continue };
            let (other, other_is) = *first.get_or_insert((name, is_rubber));
            if is_rubber != other_is {
                let message = format!(
                    "`{}` has its stress from the whole deformation, `{}` from its rate: they can't be layers of one shell",
                    excerpt(if is_rubber { name } else { other }),
                    excerpt(if is_rubber { other } else { name })
                );
                let help = "take a law in rate form such as `elastic` for the rubber, or put shells of their own beside each other and tie their faces";
                self.fault(&SHELLS, format!("{at}.material"), message, help);
                return;
            }
        }
    }

    /// Why a part can't be the shell that its element says, and what to do.
    fn no_shell(&self, part: &Part) -> Option<(String, &'static str)> {
        if !part.is_of_sheets() {
            let is_line = part.shape.cell_kind().is_none_or(|kind| kind == CellKind::Line);
            return (!is_line || self.model.dimension() == 3).then(|| {
                let message = "`shell2` is a line in 2D, but the part is not made of lines in a 2D model";
                let help = "take `line`, `arc`, `truss` or lines of a mesh file, in 2D; in 3D `shell4`, lines with `extrude` or `revolve`";
                (message.to_string(), help)
            });
        }
        let is_line = part.shape.cell_kind() == Some(CellKind::Line);
        let (what, help) = match (part.shape.solid(), part.shape.built_in()) {
            _ if part.makes_sheet() => return None,
            (Some(_), _) if is_line => {
                ("made of lines in 3D", "take `cylinder`, `sphere` or `box`, whose skin a shell can be, or a plane shape")
            }
            (Some(_), _) => ("a solid with two skins", "take `cylinder`, whose side `outer` a shell can be, or `arc` with `extrude`"),
            _ if is_line => ("made of lines that are not swept", "add `extrude` or `revolve`, or take `shell2` in a 2D model"),
            _ => ("a solid", "leave its sweep out, or sweep `line` or `arc`"),
        };
        Some((format!("`{}` is a surface, but the part is {what}", part.element), help))
    }
}
