//! Everything that can be told about a model before it is meshed: numbers, names, references, contradictions.
//!
//! Data comes from [`Model`], whoever made it; ranges come from [`describe`] and the registries, so that they stand in one place. All faults
//! are returned at once, each with the path of its key.

use super::describe::{self, ELEMENTS_MAX, out_of_range, suggestion};
use super::reference::{Reference, dimension_word, excerpt};
use super::{
    Cadence, Contact, ContactLaw, Drive, Formulation, Interface, Load, Model, ObstacleShape, Part, Partners, Penalty, Probe, ProbeAt, Shape,
};
use crate::error::Fault;
use crate::quantity::{Dimension, Range};
use crate::{contact, element, material, output};
use std::collections::{BTreeMap, BTreeSet};

/// Most field files of a run.
const FRAMES_MAX: f64 = 1e6;
/// Most rows of a history.
const ROWS_MAX: f64 = 1e8;

impl Model {
    /// All faults that can be told without meshing; empty for a sound model. Paths are those of the model file, such as `part[0].ring.inner`.
    #[must_use]
    pub fn check(&self) -> Vec<Fault> {
        let mut check = Check { model: self, faults: Vec::new() };
        check.run();
        check.materials();
        check.parts();
        check.contacts();
        check.obstacles();
        check.symmetries();
        check.constraints();
        check.loads();
        check.probes();
        check.output();
        check.faults
    }
}

struct Check<'a> {
    model: &'a Model,
    faults: Vec<Fault>,
}

impl Check<'_> {
    fn fault(&mut self, path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) {
        self.faults.push(Fault::new(path, message, help));
    }

    /// A number against the range of its key.
    fn number(&mut self, path: &str, value: f64) {
        let (dimension, range) = describe::find(path).and_then(describe::Key::range).unwrap_or((Dimension::NONE, Range::Finite));
        self.within(path, value, dimension, range);
    }

    fn within(&mut self, path: &str, value: f64, dimension: Dimension, range: Range) {
        if !range.contains(value) {
            let name = path.rsplit('.').next().unwrap_or(path);
            let shown = format!("{value} {}", dimension.unit());
            let (message, help) = out_of_range(name, shown.trim_end(), value, range);
            self.fault(path, message, help);
        }
    }

    fn vector(&mut self, path: &str, value: [f64; 2]) {
        for (index, component) in value.into_iter().enumerate() {
            self.number(&format!("{path}[{index}]"), component);
        }
    }

    /// A vector that must have a direction.
    fn direction(&mut self, path: &str, value: [f64; 2]) {
        self.vector(path, value);
        if value == [0.0, 0.0] {
            self.fault(path, "the normal is zero, so it has no direction", "give a vector such as [1, 0]");
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

    fn known(&mut self, path: &str, what: &str, name: &str, known: &[&str]) {
        if !known.contains(&name) {
            self.fault(path, format!("there is no {what} `{}`", excerpt(name)), suggestion(name, known));
        }
    }

    /// Names of one section: not empty, plain, each once.
    fn names<'n>(&mut self, section: &str, names: impl Iterator<Item = &'n str>) {
        let mut seen = BTreeMap::new();
        for (index, name) in names.enumerate() {
            let path = format!("{section}[{index}].name");
            self.name(&path, name);
            if let Some(first) = seen.insert(name, index) {
                seen.insert(name, first);
                self.fault(path, format!("the name `{}` is taken by {section}[{first}]", excerpt(name)), "give each its own name");
            }
        }
    }

    fn name(&mut self, path: &str, name: &str) {
        if let Err((message, help)) = name_is_plain(name) {
            self.fault(path, message, help);
        }
    }

    fn run(&mut self) {
        let run = &self.model.run;
        self.number("run.end", run.end);
        self.number("run.safety", run.safety);
        self.number("run.energy_limit", run.energy_limit);
        if let Some(limit) = run.step_limit {
            self.number("run.step_limit", limit);
            if limit >= run.end && run.end > 0.0 {
                self.fault("run.step_limit", "the step limit is not smaller than the end time, so no step could be taken", "");
            }
        }
        if run.max_steps == Some(0) {
            self.fault("run.max_steps", "`max_steps` must be at least 1, but it is 0", "leave it out for no limit");
        }
    }

    fn materials(&mut self) {
        let registry = material::registry();
        let laws: Vec<&str> = registry.iter().map(|kind| kind.name).collect();
        for (name, it) in &self.model.materials {
            let path = format!("material.{name}");
            self.name(&path, name);
            let Some(kind) = registry.iter().find(|kind| kind.name == it.law) else {
                self.known(&format!("{path}.law"), "law", &it.law, &laws);
                continue;
            };
            let known: Vec<&str> = kind.parameters.iter().map(|parameter| parameter.name).collect();
            for parameter in kind.parameters {
                let path = format!("{path}.{}", parameter.name);
                match it.parameters.get(parameter.name) {
                    Some(value) => self.within(&path, *value, parameter.dimension, parameter.range),
                    None if parameter.default.is_some() => {}
                    None => self.fault(path, format!("law `{}` needs `{}`", it.law, parameter.name), parameter.doc),
                }
            }
            for key in it.parameters.keys().filter(|key| !known.contains(&key.as_str())) {
                self.fault(
                    format!("{path}.{key}"),
                    format!("law `{}` has no parameter `{}`", it.law, excerpt(key)),
                    suggestion(key, &known),
                );
            }
        }
    }

    fn parts(&mut self) {
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
            self.vector(&format!("{path}.velocity"), part.velocity);
            self.shape(&path, part, registry.iter().find(|kind| kind.name == part.element));
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

    fn shape(&mut self, path: &str, part: &Part, kind: Option<&element::ElementKind>) {
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
            Shape::Group { mesh, group } => self.group(&format!("{path}.mesh"), *mesh, group, kind),
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

    fn group(&mut self, path: &str, mesh: usize, group: &str, kind: Option<&element::ElementKind>) {
        let Some(imported) = self.model.meshes.get(mesh) else {
            self.fault(path, format!("there is no mesh number {mesh}"), "add it to the model's meshes");
            return;
        };
        let path = format!("{path}.group");
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
        if let Some(kind) = kind
            && let Some(other) = found.cells.iter().map(Vec::len).find(|length| *length != kind.nodes)
        {
            let count = found.cells.iter().filter(|cell| cell.len() == other).count();
            let message =
                format!("element `{}` has {} nodes, but {count} cells of group `{}` have {other}", kind.name, kind.nodes, excerpt(group));
            let help = if kind.nodes == 4 { "let the mesh generator make quadrilaterals only (Gmsh: Recombine Surface)" } else { "" };
            self.fault(path, message, help);
        }
    }

    /// A reference to a part, side or group.
    fn reference(&mut self, path: &str, name: &str, dimension: Option<u8>) -> Option<Reference> {
        match self.model.reference(name, dimension) {
            Ok(found) => Some(found),
            Err((message, help)) => {
                if !self.may_be_missing(name) {
                    self.fault(path, message, help);
                }
                None
            }
        }
    }

    /// Whether an unknown name may be one of a mesh that is not there: then its fault would only follow from the mesh's.
    fn may_be_missing(&self, name: &str) -> bool {
        let missing = |part: &&Part| matches!(part.shape, Shape::Group { mesh, .. } if mesh >= self.model.meshes.len());
        if !self.model.parts.iter().any(|part| missing(&part)) {
            return false;
        }
        let first = name.split('.').next().unwrap_or(name);
        let known: Vec<&str> = self.model.parts.iter().filter(|part| !missing(part)).map(|part| part.name.as_str()).collect();
        describe::nearest(first, known).is_none()
    }

    /// References to parts; each once.
    fn part_list(&mut self, path: &str, parts: &[String]) {
        let known: Vec<&str> = self.model.parts.iter().map(|part| part.name.as_str()).collect();
        let mut seen = BTreeSet::new();
        for (index, name) in parts.iter().enumerate() {
            let path = format!("{path}[{index}]");
            self.known(&path, "part", name, &known);
            if !seen.insert(name) {
                self.fault(path, format!("part `{}` is named twice", excerpt(name)), "name it once");
            }
        }
    }

    fn penalty(&mut self, path: &str, penalty: Penalty) {
        match penalty {
            Penalty::Automatic { scale, .. } => self.number(&format!("{path}.penalty_scale"), scale),
            Penalty::PerNode(value) => self.number(&format!("{path}.penalty"), value),
            Penalty::Pressure(value) => {
                self.within(&format!("{path}.penalty"), value, Dimension::PRESSURE_PER_LENGTH, Range::Positive);
            }
        }
    }

    fn contacts(&mut self) {
        let model = self.model;
        self.names("contact", model.contacts.iter().map(|contact| contact.name.as_str()));
        let searches: Vec<&str> = contact::search::registry::<2>().iter().map(|kind| kind.name).collect();
        let mut pairs = BTreeMap::new();
        for (index, contact) in model.contacts.iter().enumerate() {
            let path = format!("contact[{index}]");
            self.surfaces(&path, contact);
            self.interface(&path, &contact.interface);
            if let Formulation::SinglePass { slave } = contact.formulation
                && slave > 1
            {
                self.fault(format!("{path}.slave"), format!("the slave is surface {slave}, but there are only 0 and 1"), "");
            }
            if !contact.search.is_empty() {
                self.known(&format!("{path}.search"), "search", &contact.search, &searches);
            }
            let Partners::Between(between) = &contact.partners else { continue };
            let pair = sorted(between);
            let first = *pairs.entry(pair).or_insert(index);
            if first != index {
                self.fault(
                    format!("{path}.between"),
                    format!("`{}` and `{}` are already joined by contact[{first}]", excerpt(pair[0]), excerpt(pair[1])),
                    "leave one of the two contacts out: their forces would add up",
                );
            }
        }
    }

    fn surfaces(&mut self, path: &str, contact: &Contact) {
        let Partners::Between(between) = &contact.partners else { return };
        let mut found = [None, None];
        for (side, name) in between.iter().enumerate() {
            found[side] = self.reference(&format!("{path}.between[{side}]"), name, Some(1));
        }
        let [Some(a), Some(b)] = found else { return };
        let whole = |one: Reference, other: Reference| match (one, other) {
            (Reference::Part(part), Reference::Side { part: of, .. }) => part == of,
            _ => false,
        };
        if a == b || whole(a, b) || whole(b, a) {
            self.fault(
                format!("{path}.between"),
                format!(
                    "`{}` and `{}` share a surface: contact of a body with itself is not available",
                    excerpt(&between[0]),
                    excerpt(&between[1])
                ),
                "name two different bodies or two different sides",
            );
        }
    }

    fn interface(&mut self, path: &str, interface: &Interface) {
        if let ContactLaw::Penalty(penalty) = interface.law {
            self.penalty(path, penalty);
        }
    }

    fn obstacles(&mut self) {
        let model = self.model;
        self.names("obstacle", model.obstacles.iter().map(|obstacle| obstacle.name.as_str()));
        for (index, obstacle) in model.obstacles.iter().enumerate() {
            let path = format!("obstacle[{index}]");
            self.part_list(&format!("{path}.parts"), &obstacle.parts);
            if let ObstacleShape::Plane { point, normal, .. } = obstacle.shape {
                self.vector(&format!("{path}.plane.point"), point);
                self.direction(&format!("{path}.plane.normal"), normal);
            }
            self.interface(&path, &obstacle.interface);
        }
    }

    fn symmetries(&mut self) {
        let model = self.model;
        for (index, symmetry) in model.symmetries.iter().enumerate() {
            let path = format!("symmetry[{index}]");
            self.part_list(&format!("{path}.parts"), &symmetry.parts);
            self.vector(&format!("{path}.point"), symmetry.point);
            self.direction(&format!("{path}.normal"), symmetry.normal);
        }
    }

    fn constraints(&mut self) {
        for (index, constraint) in self.model.constraints.iter().enumerate() {
            let path = format!("constraint[{index}]");
            self.reference(&format!("{path}.on"), &constraint.on, None);
            for (axis, velocity) in ["x", "y"].iter().zip(&constraint.velocity) {
                if let Some(Drive::Constant(velocity)) = velocity {
                    self.number(&format!("{path}.velocity.{axis}"), *velocity);
                }
            }
            if constraint.velocity == [None, None] {
                self.fault(
                    path,
                    "the constraint leaves both components free, so it does nothing",
                    "add `fixed = \"x\"` or `velocity = { x = \"1 m/s\" }`",
                );
            }
        }
    }

    fn loads(&mut self) {
        for (index, load) in self.model.loads.iter().enumerate() {
            let path = format!("load[{index}]");
            match load {
                Load::Gravity { parts, acceleration } => {
                    self.part_list(&format!("{path}.parts"), parts);
                    self.vector(&format!("{path}.gravity"), *acceleration);
                }
                Load::Damping { parts, rate, .. } => {
                    self.part_list(&format!("{path}.parts"), parts);
                    self.number(&format!("{path}.damping"), *rate);
                }
            }
        }
    }

    fn probes(&mut self) {
        let model = self.model;
        self.names("probe", model.probes.iter().map(|probe| probe.name.as_str()));
        for (index, probe) in model.probes.iter().enumerate() {
            self.probe(&format!("probe[{index}]"), probe);
        }
    }

    fn probe(&mut self, path: &str, probe: &Probe) {
        let known: Vec<&str> = self.model.parts.iter().map(|part| part.name.as_str()).collect();
        match &probe.at {
            ProbeAt::Point { part, point } => {
                self.known(&format!("{path}.part"), "part", part, &known);
                self.vector(&format!("{path}.point"), *point);
            }
            ProbeAt::Node { part, node } => {
                self.known(&format!("{path}.part"), "part", part, &known);
                let found = self.model.parts.iter().find(|it| it.name == *part);
                if let Some(count) = found.and_then(|it| node_count(self.model, &it.shape))
                    && *node as u128 >= count
                {
                    let help = format!("nodes are numbered from 0 to {}", count.saturating_sub(1));
                    self.fault(
                        format!("{path}.node"),
                        format!("part `{}` has {count} nodes, so there is no node {node}", excerpt(part)),
                        help,
                    );
                }
            }
            ProbeAt::Set { set } => {
                self.reference(&format!("{path}.set"), set, None);
            }
        }
    }

    fn output(&mut self) {
        let output = &self.model.output;
        for (path, cadence, most) in [("output.fields", output.fields, FRAMES_MAX), ("output.history", output.history, ROWS_MAX)] {
            let count = match cadence {
                Cadence::Count(count) => count as f64,
                Cadence::Interval(time) => self.model.run.end / time,
            };
            if count.is_finite() && count > most {
                self.fault(
                    path,
                    format!("this would be written {count} times, more than {most}"),
                    "give a smaller count or a longer interval",
                );
            }
            match cadence {
                Cadence::Count(0) => {
                    self.fault(path, "there must be at least 1 interval, but it is 0", "give a count of 1 or more, or an interval")
                }
                Cadence::Count(_) => {}
                Cadence::Interval(time) => self.number(path, time),
            }
        }
        let known: Vec<&str> = output::FIELDS.iter().map(|kind| kind.name).collect();
        for (index, name) in output.include.iter().enumerate() {
            self.known(&format!("output.include[{index}]"), "field", name, &known);
        }
        if !output.picture_field.is_empty() {
            self.known("output.picture_field", "field", &output.picture_field, &known);
        }
    }
}

/// Whether a name can stand in `part.side`, in column names and in file names.
///
/// # Errors
/// What is wrong and what to do.
pub fn name_is_plain(name: &str) -> Result<(), (String, String)> {
    let help = "use letters, digits, `_` and `-`, at most 64 of them".to_string();
    if name.is_empty() {
        return Err(("the name is empty".to_string(), help));
    }
    if let Some(wrong) = name.chars().find(|c| !(c.is_alphanumeric() || matches!(c, '_' | '-'))) {
        return Err((format!("the name `{}` has a character that names can't have: {wrong:?}", excerpt(name)), help));
    }
    if name.chars().count() > 64 {
        return Err((format!("the name `{}` is too long", excerpt(name)), help));
    }
    Ok(())
}

fn sorted(between: &[String; 2]) -> [&str; 2] {
    let mut pair = [between[0].as_str(), between[1].as_str()];
    pair.sort_unstable();
    pair
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

/// Number of nodes, where it can be told without meshing.
fn node_count(model: &Model, shape: &Shape) -> Option<u128> {
    let grid = |first: u128, second: u128| Some(first.saturating_mul(second));
    match shape {
        Shape::Rectangle { elements, .. } => grid(elements[0] as u128 + 1, elements[1] as u128 + 1),
        Shape::Ring { elements, .. } => grid(elements[0] as u128 + 1, elements[1] as u128 + u128::from(shape.sides().len() == 4)),
        Shape::Disk { .. } => None,
        Shape::Group { mesh, group } => {
            let it = model.meshes.get(*mesh)?.groups.iter().find(|it| it.name == *group && it.dimension == 2)?;
            Some(it.cells.iter().flatten().collect::<BTreeSet<_>>().len() as u128)
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

#[cfg(test)]
mod tests;
