//! Faults of parts: their materials, kinds of elements and shapes.

use super::Check;
use super::warnings::parameters;
use crate::element;
use crate::error::{Fault, MEMORY};
use crate::input::sections::ELEMENTS_MAX;
use crate::material;
use crate::material::messages::{INITIAL_STATE, SOFTENS_TOO_STEEPLY};
use crate::mesh::cell::CellKind;
use crate::mesh::messages::{BARS, DIMENSION, GROUP, NO_ELEMENT, SAME_PLACE, SHAPE, TOO_MANY};
use crate::mesh::shapes::{Count, ShapeCheck};
use crate::model::messages::{CLASH, NOTHING, OF_REVOLUTION, UNKNOWN_NAME};
use crate::model::reference::dimension_word;
use crate::model::{Extrude, Model, Part, Placement, Revolve, Shape, Sweep};
use crate::stress_state::{PLANE_STRESS, STRESS_STATES};
use crate::vocabulary::{excerpt, suggestion};
use std::collections::BTreeSet;

impl Check<'_> {
    pub(super) fn parts(&mut self) {
        let model = self.model;
        if model.parts.is_empty() {
            self.fault(&NOTHING, "part", "the model has no part", "add a [[part]] section with a name, a material and a shape");
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
            self.number(&format!("{path}.mass_scale"), part.mass_scale);
            self.shape(&path, part);
            self.sweep(&path, part);
            self.initial(&path, part);
            self.bars(&path, part);
            self.beams(&path, part);
            self.shells(&path, part);
            self.falling(&path, part);
            let count = model.element_count(part);
            if total <= ELEMENTS_MAX && total.saturating_add(count) > ELEMENTS_MAX {
                self.fault(
                    &TOO_MANY,
                    format!("{path}.{}", size_key(&part.shape)),
                    format!("the model has more than {} million elements", ELEMENTS_MAX / 1_000_000),
                    "take fewer elements",
                );
            }
            total = total.saturating_add(count);
        }
        if let Some(limit) = model.run.memory_limit {
            self.faults.extend(model.memory_fault(limit, "`run.memory_limit`"));
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
                &OF_REVOLUTION,
                path,
                message,
                "make all parts axisymmetric, or none: forces of the whole circumference and per metre of depth can't be added",
            );
        }
    }

    /// What a part holds at the start. Whether its law can hold it is seen when there are elements.
    fn initial(&mut self, path: &str, part: &Part) {
        let rigid = "the part is rigid, so nothing in it is strained or heated";
        if let Some(stress) = &part.stress_initial {
            let path = format!("{path}.stress_initial");
            for (of, values) in [("", stress.value), (".per_x", stress.per_x), (".per_y", stress.per_y)] {
                for (name, value) in ["xx", "yy", "zz", "xy"].into_iter().zip(values) {
                    self.number(&format!("{path}{of}.{name}"), value);
                }
            }
            self.vector(&format!("{path}.point"), stress.point);
            if part.stress_state == PLANE_STRESS.name && !stress.lacks(2) {
                self.fault(&INITIAL_STATE, format!("{path}.zz"), "in plane stress there is no stress across the plane", "leave it out");
            }
            if part.rigid.is_some() {
                self.fault(&INITIAL_STATE, path, rigid, "leave it out, or let the part deform");
            }
        }
        if let Some(temperature) = part.temperature_initial {
            let path = format!("{path}.temperature_initial");
            self.number(&path, temperature);
            if part.rigid.is_some() {
                self.fault(&INITIAL_STATE, path, rigid, "leave it out, or let the part deform");
            }
        }
    }

    /// A flow stress that falls needs more stiffness against flow than a plate or a bar may have. At a point
    /// of a solid it has enough: that is a fault of the material.
    fn falling(&mut self, path: &str, part: &Part) {
        let Some(it) = self.model.materials.get(&part.material).filter(|_| part.rigid.is_none()) else { return };
        let Some(softening) = parameters(it).and_then(|parameters| material::softening(&it.law, &parameters)) else { return };
        let (stiffness, of) = match part {
            part if part.is_of_bars() => (softening.bar, "a bar"),
            part if part.is_of_beams() => (softening.bar, "a fibre of a beam"),
            part if part.is_of_shells() => (softening.plate, "a shell"),
            part if part.stress_state == PLANE_STRESS.name => (softening.plate, "plane stress"),
            _ => return,
        };
        if softening.is_too_steep(stiffness) && !softening.is_too_steep(softening.solid) {
            let (message, help) = softening.too_steep(stiffness);
            self.fault(&SOFTENS_TOO_STEEPLY, format!("{path}.material"), format!("`{}` in {of}: {message}", excerpt(&part.material)), help);
        }
    }

    /// What bars need, and what they can't have.
    fn bars(&mut self, path: &str, part: &Part) {
        let area = format!("{path}.area");
        if let Some(value) = part.area {
            self.number(&area, value);
        }
        if !part.is_of_bars() {
            if part.area.is_some() {
                let of_3d = self.model.dimension_of(part) == 3;
                let help = if of_3d {
                    "leave it out, or take `space_truss` with `element = \"bar2\"`"
                } else {
                    "leave it out, or take `element = \"bar2\"`"
                };
                self.fault(&BARS, area, "`area` is the cross-section of bars, but the part has none", help);
            }
            return;
        }
        if part.shape.cell_kind() == Some(CellKind::Triangle) {
            self.fault(
                &NO_ELEMENT,
                format!("{path}.element"),
                "the part is made of triangles, so `bar2` can't be its element",
                "leave `element` out",
            );
            return;
        }
        if part.area.is_none() {
            let of_3d = self.model.dimension() == 3;
            let help = if of_3d { "add `area = \"1e-4 m^2\"`" } else { "add `area = \"1e-4 m\"`: cross-section per metre of depth" };
            self.fault(&BARS, area, "bars need their cross-section", help);
        }
        if !part.stress_state.is_empty() && part.stress_state != STRESS_STATES[0].name {
            let help = "leave `stress_state` out; in an axisymmetric body a line is a shell: take `element = \"shell2\"`";
            self.fault(&BARS, format!("{path}.stress_state"), "bars have a stress along their line and no other", help);
        }
        if let Some(material) = self.model.materials.get(&part.material)
            && material::bears_uniaxial_stress(&material.law) == Some(false)
        {
            let message = format!("bars can't be of law `{}`: it answers differently in different directions, or is a fluid", material.law);
            self.fault(&BARS, format!("{path}.material"), message, "take an isotropic solid such as `elastic` or `j2`");
        }
        if let Some(stress) = part.stress_initial.as_ref().filter(|stress| !(1..4).all(|component| stress.lacks(component))) {
            let component = (1..4).find(|&component| !stress.lacks(component)).unwrap_or(1);
            let path = format!("{path}.stress_initial.{}", ["xx", "yy", "zz", "xy"][component]);
            self.fault(&BARS, path, "bars have a stress along their line and no other", "give it as `xx`, whatever their direction");
        }
    }

    fn shape(&mut self, path: &str, part: &Part) {
        // What can't be the shell that it should be has its own fault.
        let kind = part.cell_kind().filter(|_| !part.is_of_sheets() || part.makes_sheet());
        if let Some((shape, key)) = part.shape.solid() {
            let key = format!("{path}.{key}");
            shape.check(&mut Table { check: self, path: &key });
            if let Some(kind) = kind {
                self.takes(path, part, kind, &key, &made_of(kind));
            }
            self.placement(path, &part.placement);
            return;
        }
        let Some((shape, key)) = part.shape.built_in() else {
            if let Shape::Group { mesh, group } = &part.shape {
                self.group(path, part, *mesh, group);
            }
            self.placement(path, &part.placement);
            return;
        };
        let key = format!("{path}.{key}");
        shape.check(&mut Table { check: self, path: &key });
        if let Some(kind) = kind {
            self.takes(path, part, kind, &key, &made_of(kind));
        }
        self.placement(path, &part.placement);
    }

    /// Parts in 2D and 3D do not go together; nor does a sweep with what has no area, or is a
    /// solid as it is.
    fn sweep(&mut self, path: &str, part: &Part) {
        let dimension = self.model.dimension();
        let known = |part: &&Part| !self.model.lacks_mesh(part);
        if known(&part) && self.model.dimension_of(part) != dimension {
            let first = excerpt(self.model.parts.iter().find(known).map_or("", |first| &first.name));
            let lines = |part: &Part| part.shape.cell_kind() == Some(CellKind::Line) || part.is_of_lines();
            let word = |dimension: usize, part: &Part| match (dimension, lines(part)) {
                (2, _) => "2D",
                _ if part.is_of_sheets() => "a shell in 3D",
                (_, true) if part.is_of_beams() => "of beams in 3D",
                (_, true) => "of bars in 3D",
                _ => "a solid",
            };
            let other = self.model.parts.iter().find(known).map_or("", |first| word(dimension, first));
            let own = word(self.model.dimension_of(part), part);
            let help = match (lines(part), dimension) {
                (true, 3) if part.is_of_shells() => "take `extrude` or `revolve` with `element = \"shell4\"`: shells in 3D",
                // Beams in 2D have their own fault.
                (true, _) if part.is_of_beams() && self.model.dimension_of(part) == 2 => return,
                (true, 2) => "take `truss`: bars in 2D; or make the other parts solids, such as by `extrude`",
                (true, _) => "take `space_truss` with `element = \"bar2\"`: bars in 3D",
                _ => "make all parts solids, such as by `extrude`, or none",
            };
            let at = part.sweep.as_ref().map_or_else(|| size_key(&part.shape), |sweep| sweep.key().to_string());
            let at = at.split('.').next().unwrap_or_default().to_string();
            self.fault(&DIMENSION, format!("{path}.{at}"), format!("the part is {own}, but part `{first}` is {other}"), help);
        }
        let Some(sweep) = &part.sweep else { return };
        let path = format!("{path}.{}", sweep.key());
        if part.shape.solid().is_some() {
            self.fault(&CLASH, path.as_str(), "the shape is a solid as it is", "leave it out, or take a 2D shape");
        } else if !part.is_of_sheets() && (part.is_of_lines() || part.shape.cell_kind() == Some(CellKind::Line)) {
            let help = "leave it out, or take `element = \"shell4\"`";
            self.fault(&CLASH, path.as_str(), "lines have no area that could become a solid", help);
        }
        match sweep {
            Sweep::Extrude(Extrude { from, length, elements, grading }) => {
                for (key, value) in [("from", from), ("length", length), ("grading", grading)] {
                    self.number(&format!("{path}.{key}"), *value);
                }
                self.counts(&format!("{path}.elements"), &[*elements]);
            }
            Sweep::Revolve(Revolve { axis, point, angle, elements }) => {
                self.direction(&format!("{path}.axis"), *axis);
                self.vector(&format!("{path}.point"), *point);
                self.number(&format!("{path}.angle"), *angle);
                self.counts(&format!("{path}.elements"), &[*elements]);
                if sweep.is_closed() && (1..3).contains(elements) {
                    let message = format!("{elements} elements can't go all around");
                    self.fault(&SHAPE, format!("{path}.elements"), message, "give at least 3");
                }
            }
        }
    }

    fn placement(&mut self, path: &str, placement: &Placement) {
        if self.model.dimension() == 2 {
            self.placement_in_plane(path, placement);
        }
        if let Some(mirror) = &placement.mirror {
            self.vector(&format!("{path}.mirror.point"), mirror.point);
            self.direction(&format!("{path}.mirror.normal"), mirror.normal);
        }
        self.number(&format!("{path}.rotation.angle"), placement.rotation);
        self.direction(&format!("{path}.rotation.axis"), placement.rotation_axis);
        self.vector(&format!("{path}.rotation.point"), placement.rotation_point);
        self.vector(&format!("{path}.translation"), placement.translation);
        let Some(copies) = &placement.copies else { return };
        let path = format!("{path}.copies");
        self.counts(&format!("{path}.count"), &[copies.count]);
        self.vector(&format!("{path}.translation"), copies.translation);
        self.number(&format!("{path}.angle"), copies.angle);
        self.vector(&format!("{path}.point"), copies.point);
        self.direction(&format!("{path}.axis"), copies.axis);
        let turns = |k: usize| k as f64 * copies.angle / std::f64::consts::TAU;
        let full = |k: &usize| (turns(*k) - turns(*k).round()).abs() < 1e-9;
        // Without angle, or after a full turn, a body without translation lies on the first one.
        if copies.translation == [0.0; 3]
            && let Some(k) = (1..copies.count.min(10_000)).find(full)
        {
            let message = format!("bodies 1 and {} of the copies lie on each other", k + 1);
            self.fault(&SAME_PLACE, format!("{path}.count"), message, "take fewer copies, another angle, or a translation");
        }
    }

    /// In 2D nothing leads out of it.
    fn placement_in_plane(&mut self, path: &str, placement: &Placement) {
        let along_z = |[x, y, z]: [f64; 3]| x == 0.0 && y == 0.0 && z != 0.0;
        let Placement { mirror, rotation_point, rotation_axis, translation, copies, .. } = placement;
        let mut flat = vec![("translation", translation[2] == 0.0), ("rotation.point", rotation_point[2] == 0.0)];
        flat.push(("rotation.axis", along_z(*rotation_axis)));
        if let Some(mirror) = mirror {
            flat.extend([("mirror.point", mirror.point[2] == 0.0), ("mirror.normal", mirror.normal[2] == 0.0)]);
        }
        if let Some(copies) = copies {
            flat.extend([("copies.translation", copies.translation[2] == 0.0), ("copies.point", copies.point[2] == 0.0)]);
            flat.push(("copies.axis", along_z(copies.axis)));
        }
        for (key, _) in flat.into_iter().filter(|(_, is_flat)| !is_flat) {
            let (message, help) = ("it leads out of the plane, but the model is 2D", "leave z out, or make the parts solids");
            self.fault(&DIMENSION, format!("{path}.{key}"), message, help);
        }
    }

    fn group(&mut self, part_path: &str, part: &Part, mesh: usize, group: &str) {
        let Some(imported) = self.model.meshes.get(mesh) else {
            self.fault(
                &UNKNOWN_NAME,
                format!("{part_path}.mesh"),
                format!("there is no mesh number {mesh}"),
                "add it to the model's meshes",
            );
            return;
        };
        let path = format!("{part_path}.mesh.group");
        let dimension = self.model.cells_dimension(part);
        let known: Vec<&str> = imported.groups.iter().filter(|it| it.dimension == dimension).map(|it| it.name.as_str()).collect();
        let Some(found) = imported.groups.iter().find(|it| it.name == group && it.dimension == dimension) else {
            let name = excerpt(group);
            match imported.groups.iter().find(|it| it.name == group) {
                Some(other) => {
                    let wanted = ["", "not of lines", "not of surfaces", "not of volumes"][usize::from(dimension)];
                    let message = format!("`{name}` in {} is {}, {wanted}", imported.source, dimension_word(other.dimension));
                    self.fault(&GROUP, path, message, suggestion("", &known));
                }
                None => self.fault(&UNKNOWN_NAME, path, format!("{} has no group `{name}`", imported.source), suggestion(group, &known)),
            }
            return;
        };
        if found.cells.is_empty() {
            self.fault(
                &GROUP,
                path.as_str(),
                format!("group `{}` has no cells", excerpt(group)),
                "mesh its surfaces before the file is written",
            );
        }
        let nodes = imported.positions.len();
        if found.cells.iter().flatten().any(|node| *node as usize >= nodes) {
            self.fault(
                &GROUP,
                path.as_str(),
                format!("group `{}` names a node that the mesh doesn't have", excerpt(group)),
                "the mesh has to be made again",
            );
        } else if found.cells.iter().flatten().any(|node| !imported.positions[*node as usize].iter().all(|x| x.is_finite())) {
            self.fault(
                &GROUP,
                path.as_str(),
                format!("group `{}` has a node whose position is not finite", excerpt(group)),
                "the mesh has to be made again",
            );
        }
        let lengths: BTreeSet<usize> = found.cells.iter().map(Vec::len).collect();
        for nodes in lengths {
            let count = found.cells.iter().filter(|cell| cell.len() == nodes).count();
            let Some(kind) = CellKind::of(dimension.into(), nodes) else {
                let message = format!("group `{}` has {count} cells of {nodes} nodes, which no element has", excerpt(group));
                self.fault(&NO_ELEMENT, path.as_str(), message, "the mesh has to be made again");
                continue;
            };
            // Lines that are swept are quadrilaterals of shells; those of bars have their own fault.
            let swept = if part.is_of_sheets() { Some(CellKind::Quadrilateral) } else { kind.facts().extruded };
            let Some(kind) = part.sweep.as_ref().map_or(Some(kind), |_| swept) else { continue };
            let what = match kind {
                CellKind::Line | CellKind::Triangle => kind.facts().plural.to_string(),
                _ => format!("cells of {} nodes", kind.nodes()),
            };
            self.takes(part_path, part, kind, &path, &format!("group `{}` has {count} {what}", excerpt(group)));
        }
    }

    /// Whether a part has an element for cells of a kind; `has` says at `path` that it has such cells.
    fn takes(&mut self, part_path: &str, part: &Part, cell: CellKind, path: &str, has: &str) {
        let dimension = self.model.dimension_of(part);
        if part.is_of_beams() && dimension == 2 {
            return;
        }
        let known = element::registry();
        let is_triangle = matches!(cell, CellKind::Triangle | CellKind::Triangle6);
        let names = &part.element_triangles;
        let is_wrong =
            dimension == 2 && is_triangle && !names.is_empty() && !known.iter().any(|kind| kind.is_triangle() && kind.name == *names);
        if !is_wrong && part.element_in(dimension, cell).is_some() || (!is_triangle && !known.iter().any(|kind| kind.name == part.element))
        {
            return;
        }
        let fits = |kind: &&element::ElementKind| kind.cell == cell && (kind.dimension == dimension || cell == CellKind::Line);
        let known: Vec<&str> = known.iter().filter(fits).map(|kind| kind.name).collect();
        if known.is_empty() {
            let help =
                if path.ends_with(".group") { "let the mesh generator make quadrilaterals only (Gmsh: Recombine Surface)" } else { "" };
            self.fault(&NO_ELEMENT, path, format!("{has}, but no element has {} nodes", cell.nodes()), help);
        } else if is_triangle {
            let message = format!("{has}, but `{}` is no element of triangles", excerpt(&part.element_triangles));
            self.fault(&NO_ELEMENT, format!("{part_path}.element_triangles"), message, suggestion(&part.element_triangles, &known));
        } else {
            self.fault(&NO_ELEMENT, path, format!("{has}, but element `{}` has not", part.element), suggestion(&part.element, &known));
        }
    }

    /// Whole numbers that must be at least one.
    fn counts(&mut self, path: &str, values: &[usize]) {
        for (index, value) in values.iter().enumerate() {
            if *value == 0 {
                let path = if values.len() > 1 { format!("{path}[{index}]") } else { path.to_string() };
                self.fault(&NOTHING, path, "there must be at least 1 element", "");
            }
        }
    }
}

/// What a built-in shape is made of, in words.
fn made_of(kind: CellKind) -> String {
    format!("it is made of {}", if kind == CellKind::Line { "bars" } else { kind.facts().plural })
}

/// Memory that an element takes with its share of nodes, results and pictures, bytes: about, as measured
/// (`docs/performance.md`, peak of a run of `quad4` and `j2`).
const BYTES_PER_ELEMENT: f64 = 600.0;

impl Model {
    /// Number of elements of a part; an estimate, where a shape doesn't know it.
    #[must_use]
    pub fn element_count(&self, part: &Part) -> u128 {
        let Shape::Group { mesh, group } = &part.shape else { return part.count().map_or(0, |count| count.elements as u128) };
        let groups = self.meshes.get(*mesh).map_or(&[][..], |imported| &imported.groups);
        let found = groups.iter().find(|it| it.name == *group && it.dimension == self.cells_dimension(part));
        let layers = part.sweep.as_ref().map_or(1, |sweep| sweep.count(Count { nodes: 0, elements: 1, exact: true }).elements);
        found.map_or(0, |it| it.cells.len() as u128).saturating_mul(layers as u128).saturating_mul(part.placement.count() as u128)
    }

    /// The fault of a model that needs more memory than `limit`, bytes, which is what `whose` says: so many
    /// elements, 600 bytes each.
    #[must_use]
    pub fn memory_fault(&self, limit: f64, whose: &str) -> Option<Fault> {
        let counts = || self.parts.iter().map(|part| self.element_count(part) as f64);
        let needed = BYTES_PER_ELEMENT * counts().sum::<f64>();
        if needed <= limit {
            return None;
        }
        let (index, largest) = counts().enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let message = format!(
            "the model needs about {needed:.3e} bytes, {BYTES_PER_ELEMENT} for each element, {:.1} % of them in this \
                part; {whose} is {limit:.3e} bytes",
            100.0 * BYTES_PER_ELEMENT * largest / needed
        );
        let path = format!("part[{index}].{}", size_key(&self.parts[index].shape));
        Some(Fault::new(&MEMORY, path, message, "take larger elements, or raise `run.memory_limit`"))
    }
}

/// Path, from the part on, of what decides how many elements there are.
fn size_key(shape: &Shape) -> String {
    shape.size_path()
}

/// Checks the values of a shape; the path is that of its table.
struct Table<'c, 'm> {
    check: &'c mut Check<'m>,
    path: &'c str,
}

impl Table<'_, '_> {
    fn at(&self, key: &str) -> String {
        if key.is_empty() { self.path.to_string() } else { format!("{}.{key}", self.path) }
    }
}

impl ShapeCheck for Table<'_, '_> {
    fn report(&mut self, key: &str, message: String, help: String) {
        self.check.fault(&SHAPE, self.at(key), message, help);
    }

    fn number(&mut self, key: &str, value: f64) {
        self.check.number(&self.at(key), value);
    }

    fn direction(&mut self, key: &str, value: [f64; 3]) {
        self.check.direction(&self.at(key), value);
    }

    fn known(&mut self, key: &str, what: &str, name: &str, known: &[&str]) {
        self.check.known(&self.at(key), what, name, known);
    }

    fn counts(&mut self, key: &str, values: &[usize]) {
        self.check.counts(&self.at(key), values);
    }
}
