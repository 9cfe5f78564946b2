//! Everything that can be reported about a model before it is meshed: numbers, names, references,
//! contradictions.
//!
//! Data comes from [`Model`], however it was made; ranges come from [`sections`] and the registries, so that
//! they stand in one place. All faults are returned at once, each with the path of its key. Parts are in
//! `parts.rs`, contacts in `contact.rs`, what moves in `motion.rs`, loads and joins in `load.rs`. What is no
//! fault and should be known all the same is in `warnings.rs`.

mod beams;
mod cavities;
mod connections;
mod contact;
mod discrete;
mod load;
mod motion;
mod parts;
mod plane;
mod plausible;
mod remesh;
mod shells;
mod space;
mod stages;
mod triangles;
mod warnings;

use super::sections;
use crate::error::Fault;
use crate::failure;
use crate::material::messages::{EQUATION_OF_STATE, PARAMETER_MISSING, PARAMETER_UNKNOWN};
use crate::material::{self, Parameters};
use crate::mesh::messages::{BARS, NOTHING_CUT};
use crate::message::Message;
use crate::model::messages::{CLASH, LIST_LENGTH, NAME, NO_DIRECTION, OUTPUT_TOO_MUCH, PERIOD, RANGE, TWICE, UNKNOWN_NAME};
use crate::model::reference::{Reference, Wanted};
use crate::model::{Axis, Cadence, Camera, Material, Model, Part, Probe, ProbeAt, Shape, StableStep};
use crate::output;
use crate::quantity::{Dimension, Parameter, Range};
use crate::vocabulary::{Key, Kind, excerpt, nearest, out_of_range, suggestion};
use std::collections::{BTreeMap, BTreeSet};

/// Most field files of a run.
const FRAMES_MAX: f64 = 1e6;
/// Most rows of a history.
const ROWS_MAX: f64 = 1e8;

/// What to do about bars where a surface is meant.
const NO_SURFACE: &str = "name another part; give beams the shape and the sizes of their section, or take beams in the place of bars";

/// What a part without a surface is made of.
fn lines_of(part: &Part) -> &'static str {
    if part.is_of_beams() { "beams with a `given` section" } else { "bars" }
}

impl Model {
    /// All faults that can be reported without meshing; empty for a sound model. Paths are those of the model
    /// file, such as `part[0].ring.inner`.
    #[must_use]
    pub fn check(&self) -> Vec<Fault> {
        let mut check = Check { model: self, faults: Vec::new() };
        check.run();
        check.stages();
        check.materials();
        check.curves();
        check.parts();
        check.contacts();
        check.obstacles();
        check.symmetries();
        check.constraints();
        check.joins();
        check.loads();
        check.cavities();
        check.non_reflecting();
        check.connections();
        check.springs();
        check.point_masses();
        check.probes();
        check.cuts();
        check.channels();
        check.remeshes();
        check.names_of_conditions();
        check.output();
        if self.dimension() == 2 {
            check.nothing_out_of_2d();
        } else {
            check.nothing_of_2d_alone();
        }
        check.faults
    }
}

struct Check<'a> {
    model: &'a Model,
    faults: Vec<Fault>,
}

impl Check<'_> {
    fn fault(&mut self, kind: &'static Message, path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) {
        self.faults.push(Fault::new(kind, path, message, help));
    }

    /// A number against the range of its key.
    fn number(&mut self, path: &str, value: f64) {
        let key = sections::find(path);
        let (dimension, range) = key.and_then(Key::range).unwrap_or((Dimension::NONE, Range::Finite));
        if !range.contains(value) && key.is_some_and(|key| matches!(key.kind, Kind::Angle(Dimension::NONE, _))) {
            self.out_of(path, &format!("{value} rad"), value, &range.of_angle());
        } else {
            self.within(path, value, dimension, range);
        }
    }

    fn within(&mut self, path: &str, value: f64, dimension: Dimension, range: Range) {
        if !range.contains(value) {
            let shown = format!("{value} {}", dimension.unit());
            self.out_of(path, shown.trim_end(), value, &range.to_string());
        }
    }

    fn out_of(&mut self, path: &str, shown: &str, value: f64, range: &str) {
        let (message, help) = out_of_range(path.rsplit('.').next().unwrap_or(path), shown, value, range);
        self.fault(&RANGE, path, message, help);
    }

    fn vector<const N: usize>(&mut self, path: &str, value: [f64; N]) {
        for (index, component) in value.into_iter().enumerate() {
            self.number(&format!("{path}[{index}]"), component);
        }
    }

    /// A vector that must have a direction.
    fn direction<const N: usize>(&mut self, path: &str, value: [f64; N]) {
        self.vector(path, value);
        if value == [0.0; N] {
            self.fault(&NO_DIRECTION, path, "the normal is zero, so it has no direction", "give a vector such as [1, 0]");
        }
    }

    /// What something turns about.
    fn axis(&mut self, path: &str, axis: &Axis) {
        self.vector(&format!("{path}.centre"), axis.centre);
        self.direction(&format!("{path}.axis"), axis.direction);
    }

    fn camera(&mut self, camera: &Camera) {
        self.vector("output.camera.from", camera.from);
        self.vector("output.camera.up", camera.up);
        self.vector("output.camera.at", camera.at.unwrap_or_default());
        self.number("output.camera.zoom", camera.zoom);
        let ([a, b, c], [u, v, w]) = (camera.from, camera.up);
        let across = [b * w - c * v, c * u - a * w, a * v - b * u];
        let size = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        if size(across) <= 1e-6 * size(camera.from) * size(camera.up) {
            let what = "`from` and `up` have one direction, or one of them is zero, so it is open which side is up";
            self.fault(&NO_DIRECTION, "output.camera.up", what, "give another `up` or another `from`; both have to be longer than zero");
        }
        if camera.zoom <= 0.0 {
            self.fault(
                &RANGE,
                "output.camera.zoom",
                format!("it must be larger than 0, but it is {}", camera.zoom),
                "give 1 to see everything",
            );
        }
    }

    fn known(&mut self, path: &str, what: &str, name: &str, known: &[&str]) {
        if !known.contains(&name) {
            self.fault(&UNKNOWN_NAME, path, format!("there is no {what} `{}`", excerpt(name)), suggestion(name, known));
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
                self.fault(&TWICE, path, format!("the name `{}` is taken by {section}[{first}]", excerpt(name)), "give each its own name");
            }
        }
    }

    fn name(&mut self, path: &str, name: &str) {
        if let Err((message, help)) = name_is_plain(name) {
            self.fault(&NAME, path, message, help);
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
                self.fault(&PERIOD, "run.step_limit", "the step limit is not smaller than the end time, so no step could be taken", "");
            }
        }
        let limits = [("velocity", run.velocity_limit), ("penetration", run.penetration_limit), ("memory", run.memory_limit)];
        for (name, limit) in limits {
            limit.into_iter().for_each(|limit| self.number(&format!("run.{name}_limit"), limit));
        }
        if let Some(largest) = run.time_step {
            self.number("run.time_step", largest);
        }
        if let Some(relaxation) = run.relaxation {
            self.relaxation("run", relaxation);
        }
        let relaxes = run.relaxation.is_some() || self.model.stages.iter().any(|stage| stage.relaxation.is_some());
        if run.subcycling && relaxes {
            self.fault(
                &CLASH,
                "run.subcycling",
                "dynamic relaxation finds its damping from the forces of all elements in every step",
                "leave one of `subcycling` and `relaxation` out",
            );
        }
        if run.subcycling && run.stable_step != StableStep::Elements {
            self.fault(
                &CLASH,
                "run.subcycling",
                "with `subcycling` the stable step is that by elements",
                "leave one of `subcycling` and `stable_step` out",
            );
        }
        if let Some(scaling) = run.mass_scaling {
            self.number("run.mass_scaling.time_step", scaling.time_step);
            self.number("run.mass_scaling.limit", scaling.limit);
        }
        if run.max_steps == Some(0) {
            self.fault(&RANGE, "run.max_steps", "`max_steps` must be at least 1, but it is 0", "leave it out for no limit");
        }
        if let Some(pause) = run.checkpoint {
            self.number("run.checkpoint", pause);
        }
        if run.checkpoint_steps == Some(0) {
            self.fault(
                &RANGE,
                "run.checkpoint_steps",
                "`checkpoint_steps` must be at least 1, but it is 0",
                "leave it out for none by number",
            );
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
            if !self.equation_of_state(&path, it) {
                continue;
            }
            let own = material::eos::kind(&it.eos);
            // What both have is the same thing, given once.
            let law = |name: &str| kind.parameters.iter().any(|parameter| parameter.name == name);
            let further = own.into_iter().flat_map(|own| own.parameters).filter(|parameter| !law(parameter.name));
            let all: Vec<&Parameter> = kind.parameters.iter().chain(further).collect();
            let limit = own.map(|_| material::eos::TENSION);
            let known: Vec<&str> = all.iter().copied().chain(&limit).map(|parameter| parameter.name).collect();
            if let Some(limit) = &limit
                && let Some(value) = it.parameters.get(limit.name)
            {
                self.within(&format!("{path}.{}", limit.name), *value, limit.dimension, limit.range);
            }
            let needs = |parameter: &Parameter| match own {
                Some(own) if !law(parameter.name) => format!("equation of state `{}` needs `{}`", own.name, parameter.name),
                _ => format!("law `{}` needs `{}`", it.law, parameter.name),
            };
            for &parameter in &all {
                let path = format!("{path}.{}", parameter.name);
                if parameter.list > 0 {
                    self.list(&path, it, parameter, &needs(parameter));
                    continue;
                }
                match it.parameters.get(parameter.name) {
                    Some(value) => self.within(&path, *value, parameter.dimension, parameter.range),
                    None if parameter.default.is_some() => {}
                    None => self.fault(&PARAMETER_MISSING, path, needs(parameter), parameter.doc),
                }
            }
            for (key, &value) in &it.failure {
                match failure::by_name(key) {
                    Some(kind) => self.within(&format!("{path}.failure.{key}"), value, kind.limit.dimension, kind.limit.range),
                    None => self.fault(
                        &UNKNOWN_NAME,
                        format!("{path}.failure"),
                        format!("there is no criterion `{}`", excerpt(key)),
                        "see `embate list failure`",
                    ),
                }
            }
            let before = self.faults.len();
            for key in it.parameters.keys().chain(it.lists.keys()).filter(|key| !known.contains(&key.as_str())) {
                let of_other =
                    material::eos::EQUATIONS.iter().find(|other| other.parameters.iter().any(|parameter| parameter.name == key.as_str()));
                let help = match of_other {
                    _ if own.is_none() && key == material::eos::TENSION.name => {
                        "it is a limit of equations of state: add `eos`, or leave it out".to_string()
                    }
                    Some(other) if own.is_none() => format!("add `eos = \"{}\"`, or leave it out", other.name),
                    _ => suggestion(key, &known),
                };
                let with = own.map_or(String::new(), |own| format!(" with `eos = \"{}\"`", own.name));
                self.fault(
                    &PARAMETER_UNKNOWN,
                    format!("{path}.{key}"),
                    format!("law `{}`{with} has no parameter `{}`", it.law, excerpt(key)),
                    help,
                );
            }
            // Of what is missing it is reported already that it is, and no more can be said.
            let is_given = |parameter: &&Parameter| {
                parameter.default.is_some() || it.parameters.contains_key(parameter.name) || it.lists.contains_key(parameter.name)
            };
            if self.faults.len() == before && all.iter().all(is_given) {
                let faults = material::faults(&it.law, &Parameters::new(kind.parameters, &it.parameters, &it.lists));
                let own = own.map(|own| material::eos::faults(own.name, &Parameters::new(own.parameters, &it.parameters, &it.lists)));
                let faults = faults.into_iter().chain(own.into_iter().flatten());
                faults.for_each(|fault| self.fault(fault.kind, format!("{path}.{}", fault.name), fault.message, fault.help));
            }
        }
    }

    /// Whether the material's equation of state is known and goes with its law.
    fn equation_of_state(&mut self, path: &str, it: &Material) -> bool {
        let names: Vec<&str> = material::eos::EQUATIONS.iter().map(|kind| kind.name).collect();
        let Some([needs, may_have]) = material::equation_of_state(&it.law) else { return false };
        let path = format!("{path}.eos");
        if it.eos.is_empty() {
            if needs {
                let help = format!("give an equation of state, `eos`: {}", names.join(", "));
                self.fault(&EQUATION_OF_STATE, path, format!("law `{}` has no pressure of its own", it.law), help);
            }
            return !needs;
        }
        if !may_have {
            let message = format!(
                "law `{}` has a pressure of its own, from its energy or its flow: an equation of state would contradict it",
                it.law
            );
            self.fault(&EQUATION_OF_STATE, path, message, "leave `eos` out, or take a law in rate form such as `elastic` or `j2`");
            return false;
        }
        if material::eos::kind(&it.eos).is_none() {
            self.known(&path, "equation of state", &it.eos, &names);
            return false;
        }
        true
    }

    /// A parameter that is a list.
    fn list(&mut self, path: &str, it: &Material, parameter: &Parameter, needs: &str) {
        match it.lists.get(parameter.name) {
            Some(values) if values.len() > parameter.list => {
                let message = format!("`{}` takes at most {} values, here are {}", parameter.name, parameter.list, values.len());
                self.fault(&LIST_LENGTH, path, message, "leave the others out");
            }
            Some(values) if values.is_empty() && parameter.default.is_none() => {
                self.fault(&LIST_LENGTH, path, format!("`{}` is empty", parameter.name), parameter.doc);
            }
            Some(values) => {
                for (index, value) in values.iter().enumerate() {
                    self.within(&format!("{path}[{index}]"), *value, parameter.dimension, parameter.range);
                }
            }
            None if parameter.default.is_some() => {}
            None => self.fault(&PARAMETER_MISSING, path, needs, parameter.doc),
        }
    }

    /// A reference to a part, side or group.
    fn reference(&mut self, path: &str, name: &str, wanted: Wanted) -> Option<Reference> {
        match self.model.reference(name, wanted) {
            Ok(Reference::Part(part) | Reference::Side { part, .. })
                if wanted == Wanted::Surface && self.model.parts[part].has_no_surface() =>
            {
                let part = &self.model.parts[part];
                let message = format!("part `{}` is made of {}, which have no surface", excerpt(&part.name), lines_of(part));
                self.fault(&BARS, path, message, NO_SURFACE);
                None
            }
            Ok(found) => Some(found),
            Err((message, help)) => {
                if !self.may_be_missing(name) {
                    self.fault(&UNKNOWN_NAME, path, message, help);
                }
                None
            }
        }
    }

    /// Whether an unknown name may be one of a mesh that is not there: then its fault would only follow from
    /// the mesh's.
    fn may_be_missing(&self, name: &str) -> bool {
        let missing = |part: &&Part| matches!(part.shape, Shape::Group { mesh, .. } if mesh >= self.model.meshes.len());
        if !self.model.parts.iter().any(|part| missing(&part)) {
            return false;
        }
        let first = name.split('.').next().unwrap_or(name);
        let known: Vec<&str> = self.model.parts.iter().filter(|part| !missing(part)).map(|part| part.name.as_str()).collect();
        nearest(first, known).is_none()
    }

    /// References to parts; each once.
    fn part_list(&mut self, path: &str, parts: &[String]) {
        let known: Vec<&str> = self.model.parts.iter().map(|part| part.name.as_str()).collect();
        let mut seen = BTreeSet::new();
        for (index, name) in parts.iter().enumerate() {
            let path = format!("{path}[{index}]");
            self.known(&path, "part", name, &known);
            if !seen.insert(name) {
                self.fault(&TWICE, path, format!("part `{}` is named twice", excerpt(name)), "name it once");
            }
        }
    }

    /// Parts of which a surface is meant (none: all): at least one must have one, and those that are named
    /// must.
    fn with_surface(&mut self, path: &str, parts: &[String]) {
        let model = self.model;
        for (index, name) in parts.iter().enumerate() {
            if let Some(part) = model.parts.iter().find(|part| part.name == *name && part.has_no_surface()) {
                let message = format!("part `{}` is made of {}, which have no surface", excerpt(name), lines_of(part));
                self.fault(&BARS, format!("{path}[{index}]"), message, NO_SURFACE);
            }
        }
        if parts.is_empty() && !model.parts.is_empty() && model.parts.iter().all(Part::has_no_surface) {
            let message = format!("all parts are made of {}, which have no surface", lines_of(&model.parts[0]));
            self.fault(&BARS, path, message, NO_SURFACE);
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

    fn probes(&mut self) {
        let model = self.model;
        self.names("probe", model.probes.iter().map(|probe| probe.name.as_str()));
        for (index, probe) in model.probes.iter().enumerate() {
            self.probe(&format!("probe[{index}]"), probe);
        }
    }

    /// Planes that cut parts.
    fn cuts(&mut self) {
        let model = self.model;
        self.names("cut", model.cuts.iter().map(|cut| cut.name.as_str()));
        for (index, cut) in model.cuts.iter().enumerate() {
            let path = format!("cut[{index}]");
            self.part_list(&format!("{path}.parts"), &cut.parts);
            self.vector(&format!("{path}.point"), cut.point);
            self.direction(&format!("{path}.normal"), cut.normal);
            if let Some(radius) = cut.radius {
                self.number(&format!("{path}.radius"), radius);
            }
            for (place, name) in cut.parts.iter().enumerate() {
                if model.parts.iter().any(|part| part.name == *name && part.rigid.is_some()) {
                    let message = format!("part `{}` is rigid: nothing is known of the forces in it", excerpt(name));
                    self.fault(&NOTHING_CUT, format!("{path}.parts[{place}]"), message, "name deformable parts");
                }
            }
        }
    }

    /// Formulas of columns; what they name is found when the history is known.
    fn channels(&mut self) {
        self.names("channel", self.model.channels.iter().map(|channel| channel.name.as_str()));
    }

    /// Names of conditions whose reactions the history has; those without are numbered.
    fn names_of_conditions(&mut self) {
        let model = self.model;
        let all: [(&str, Vec<&str>); 3] = [
            ("symmetry", model.symmetries.iter().map(|it| it.name.as_str()).collect()),
            ("constraint", model.constraints.iter().map(|it| it.name.as_str()).collect()),
            ("load", model.load_terms.iter().map(|terms| terms.name.as_str()).collect()),
        ];
        for (section, names) in all {
            if names.iter().all(|name| !name.is_empty()) {
                self.names(section, names.into_iter());
            }
        }
    }

    fn probe(&mut self, path: &str, probe: &Probe) {
        let known: Vec<&str> = self.model.parts.iter().map(|part| part.name.as_str()).collect();
        match &probe.at {
            ProbeAt::Element { part, .. } => self.known(&format!("{path}.part"), "part", part, &known),
            ProbeAt::Point { part, point } => {
                self.known(&format!("{path}.part"), "part", part, &known);
                self.vector(&format!("{path}.point"), *point);
            }
            ProbeAt::Node { part, node } => {
                self.known(&format!("{path}.part"), "part", part, &known);
                let found = self.model.parts.iter().find(|it| it.name == *part);
                if let Some(count) = found.and_then(|it| node_count(self.model, it))
                    && *node as u128 >= count
                {
                    let help = format!("nodes are numbered from 0 to {}", count.saturating_sub(1));
                    self.fault(
                        &UNKNOWN_NAME,
                        format!("{path}.node"),
                        format!("part `{}` has {count} nodes, so there is no node {node}", excerpt(part)),
                        help,
                    );
                }
            }
            ProbeAt::Set { set } => {
                self.reference(&format!("{path}.set"), set, Wanted::Nodes);
            }
        }
    }

    fn output(&mut self) {
        let output = &self.model.output;
        if output.hash_steps == Some(0) {
            self.fault(&RANGE, "output.hash_steps", "`hash_steps` must be at least 1, but it is 0", "say `None` for none");
        }
        for (path, cadence, most) in [("output.fields", output.fields, FRAMES_MAX), ("output.history", output.history, ROWS_MAX)] {
            let count = match cadence {
                Cadence::Count(count) => count as f64,
                Cadence::Interval(time) => self.model.run.end / time,
            };
            if count.is_finite() && count > most {
                self.fault(
                    &OUTPUT_TOO_MUCH,
                    path,
                    format!("this would be written {count} times, more than {most}"),
                    "give a smaller count or a longer interval",
                );
            }
            match cadence {
                Cadence::Count(0) if path == "output.history" => self.fault(
                    &RANGE,
                    path,
                    "there must be at least 1 interval, but it is 0",
                    "give a count of 1 or more, or an interval; fields alone can be left out with 0",
                ),
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
        if let Some(view) = output.picture_view {
            self.vector("output.picture_view.corner", view.corner);
            self.vector("output.picture_view.size", view.size);
        }
        if let Some(camera) = output.camera {
            self.camera(&camera);
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

/// Number of nodes, where it can be reported without meshing.
fn node_count(model: &Model, part: &Part) -> Option<u128> {
    if let Shape::Group { mesh, group } = &part.shape {
        let it = model.meshes.get(*mesh)?.groups.iter().find(|it| it.name == *group && it.dimension == model.cells_dimension(part))?;
        return Some((it.cells.iter().flatten().collect::<BTreeSet<_>>().len() * part.placement.count()) as u128);
    }
    part.count().filter(|count| count.exact).map(|count| count.nodes as u128)
}

#[cfg(test)]
mod tests;
