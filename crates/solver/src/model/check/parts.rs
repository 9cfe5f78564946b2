//! Faults of parts: their materials, kinds of elements and shapes.

use super::Check;
use crate::block::stress_state::STRESS_STATES;
use crate::element;
use crate::model::describe::{ELEMENTS_MAX, suggestion};
use crate::model::reference::{dimension_word, excerpt};
use crate::model::{Model, Part, Shape};
use std::collections::BTreeSet;

impl Check<'_> {
    pub(super) fn parts(&mut self) {
        let model = self.model;
        if model.parts.is_empty() {
            self.fault("part", "the model has no part", "add a [[part]] section with a name, a material and a shape");
        }
        self.names("part", model.parts.iter().map(|part| part.name.as_str()));
        let materials: Vec<&str> = model.materials.keys().map(String::as_str).collect();
        let registry = element::registry();
        let elements: Vec<&str> = registry.iter().map(|kind| kind.name).collect();
        let mut total: u128 = 0;
        for (index, part) in model.parts.iter().enumerate() {
            let path = format!("part[{index}]");
            self.known(&format!("{path}.material"), "material", &part.material, &materials);
            self.known(&format!("{path}.element"), "element", &part.element, &elements);
            self.stress_state(&path, part);
            self.part_motion(&path, part);
            self.shape(&path, part);
            let count = element_count(model, &part.shape);
            if total <= ELEMENTS_MAX && total.saturating_add(count) > ELEMENTS_MAX {
                self.fault(
                    format!("{path}{}", elements_key(&part.shape)),
                    format!("the model has more than {} million elements", ELEMENTS_MAX / 1_000_000),
                    "take fewer elements",
                );
            }
            total = total.saturating_add(count);
        }
    }

    /// The circumference of an axisymmetric part and the depth of a plane one do not go together.
    fn stress_state(&mut self, path: &str, part: &Part) {
        let path = format!("{path}.stress_state");
        let known: Vec<&str> = STRESS_STATES.iter().map(|kind| kind.name).collect();
        if !part.stress_state.is_empty() {
            self.known(&path, "stress state", &part.stress_state, &known);
        }
        let first = &self.model.parts[0];
        if part.is_axisymmetric() != first.is_axisymmetric() {
            let [state, other] = [part, first].map(|part| if part.is_axisymmetric() { "axisymmetric" } else { "plane" });
            let message = format!("the part is {state}, but part `{}` is {other}", excerpt(&first.name));
            self.fault(
                path,
                message,
                "make all parts axisymmetric, or none: forces of the whole circumference and per metre of depth can't be added",
            );
        }
    }

    fn shape(&mut self, path: &str, part: &Part) {
        match &part.shape {
            Shape::Rectangle { corner, size, elements } => {
                self.vector(&format!("{path}.rectangle.corner"), *corner);
                self.vector(&format!("{path}.rectangle.size"), *size);
                self.counts(&format!("{path}.rectangle.elements"), elements);
            }
            Shape::Ring { centre, inner, outer, from, to, elements } => {
                let path = format!("{path}.ring");
                self.vector(&format!("{path}.centre"), *centre);
                for (key, value) in [("inner", inner), ("outer", outer), ("from", from), ("to", to)] {
                    self.number(&format!("{path}.{key}"), *value);
                }
                self.counts(&format!("{path}.elements"), elements);
                if inner >= outer {
                    self.fault(
                        format!("{path}.inner"),
                        format!("the inner radius {inner} m is not smaller than the outer radius {outer} m"),
                        "swap or correct the radii",
                    );
                }
                self.angles(&path, *from, *to);
            }
            Shape::Disk { centre, radius, elements } => {
                self.vector(&format!("{path}.disk.centre"), *centre);
                self.number(&format!("{path}.disk.radius"), *radius);
                self.counts(&format!("{path}.disk.elements"), &[*elements]);
            }
            Shape::Group { mesh, group } => self.group(path, part, *mesh, group),
        }
    }

    fn angles(&mut self, path: &str, from: f64, to: f64) {
        let degrees = |angle: f64| (angle.to_degrees() * 1e9).round() / 1e9;
        if to <= from {
            let message = format!("the ring ends at {} deg, not after its beginning at {} deg", degrees(to), degrees(from));
            self.fault(format!("{path}.to"), message, "it runs counter-clockwise: add \"360 deg\" to `to`, or swap the two");
        } else if to - from > std::f64::consts::TAU + 1e-9 {
            let message = format!("the ring runs over {} deg, more than a full turn", degrees(to - from));
            self.fault(format!("{path}.to"), message, "let `to` exceed `from` by at most 360 deg");
        }
    }

    fn group(&mut self, part_path: &str, part: &Part, mesh: usize, group: &str) {
        let Some(imported) = self.model.meshes.get(mesh) else {
            self.fault(format!("{part_path}.mesh"), format!("there is no mesh number {mesh}"), "add it to the model's meshes");
            return;
        };
        let path = format!("{part_path}.mesh.group");
        let known: Vec<&str> = imported.groups.iter().filter(|it| it.dimension == 2).map(|it| it.name.as_str()).collect();
        let Some(found) = imported.groups.iter().find(|it| it.name == group && it.dimension == 2) else {
            let name = excerpt(group);
            match imported.groups.iter().find(|it| it.name == group) {
                Some(other) => {
                    let message = format!("`{name}` in {} is {}, not of surfaces", imported.source, dimension_word(other.dimension));
                    self.fault(path, message, suggestion("", &known));
                }
                None => self.fault(path, format!("{} has no group `{name}`", imported.source), suggestion(group, &known)),
            }
            return;
        };
        if found.cells.is_empty() {
            self.fault(path.as_str(), format!("group `{}` has no cells", excerpt(group)), "mesh its surfaces before the file is written");
        }
        let nodes = imported.positions.len();
        if found.cells.iter().flatten().any(|node| *node as usize >= nodes) {
            self.fault(
                path.as_str(),
                format!("group `{}` names a node that the mesh doesn't have", excerpt(group)),
                "the mesh has to be made again",
            );
        } else if found.cells.iter().flatten().any(|node| !imported.positions[*node as usize].iter().all(|x| x.is_finite())) {
            self.fault(
                path.as_str(),
                format!("group `{}` has a node whose position is not finite", excerpt(group)),
                "the mesh has to be made again",
            );
        }
        let lengths: BTreeSet<usize> = found.cells.iter().map(Vec::len).collect();
        for nodes in lengths {
            let count = found.cells.iter().filter(|cell| cell.len() == nodes).count();
            let what = if nodes == 3 { "triangles".to_string() } else { format!("cells of {nodes} nodes") };
            self.takes(part_path, part, nodes, &path, &format!("group `{}` has {count} {what}", excerpt(group)));
        }
    }

    /// Whether a part has an element for cells of so many nodes; `has` says at `path` that it has such cells.
    fn takes(&mut self, part_path: &str, part: &Part, nodes: usize, path: &str, has: &str) {
        if part.element_of(nodes).is_some() || (nodes != 3 && !element::registry().iter().any(|kind| kind.name == part.element)) {
            return;
        }
        let known: Vec<&str> = element::registry().iter().filter(|kind| kind.nodes == nodes).map(|kind| kind.name).collect();
        if known.is_empty() {
            let help = "let the mesh generator make quadrilaterals only (Gmsh: Recombine Surface)";
            self.fault(path, format!("{has}, but no element has {nodes} nodes"), help);
        } else if nodes == 3 {
            let message = format!("{has}, but `{}` is no element of three nodes", excerpt(&part.element_triangles));
            self.fault(format!("{part_path}.element_triangles"), message, suggestion(&part.element_triangles, &known));
        } else {
            self.fault(path, format!("{has}, but element `{}` has not", part.element), suggestion(&part.element, &known));
        }
    }

    /// Whole numbers that must be at least one.
    fn counts(&mut self, path: &str, values: &[usize]) {
        for (index, value) in values.iter().enumerate() {
            if *value == 0 {
                let path = if values.len() > 1 { format!("{path}[{index}]") } else { path.to_string() };
                self.fault(path, "there must be at least 1 element", "");
            }
        }
    }
}

/// Number of elements; a bound for a disk.
fn element_count(model: &Model, shape: &Shape) -> u128 {
    match shape {
        Shape::Rectangle { elements, .. } | Shape::Ring { elements, .. } => (elements[0] as u128).saturating_mul(elements[1] as u128),
        Shape::Disk { elements, .. } => (*elements as u128).saturating_mul(*elements as u128).saturating_mul(3),
        Shape::Group { mesh, group } => {
            let found =
                model.meshes.get(*mesh).and_then(|imported| imported.groups.iter().find(|it| it.name == *group && it.dimension == 2));
            found.map_or(0, |it| it.cells.len() as u128)
        }
    }
}

fn elements_key(shape: &Shape) -> &'static str {
    match shape {
        Shape::Rectangle { .. } => ".rectangle.elements",
        Shape::Ring { .. } => ".ring.elements",
        Shape::Disk { .. } => ".disk.elements",
        Shape::Group { .. } => ".mesh.group",
    }
}
