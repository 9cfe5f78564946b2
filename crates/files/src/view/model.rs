//! A model before it runs as the page gets it: its bodies at the start as a run of one frame, and what is
//! said of it: glyphs, faults and warnings with their lines, a table of parts.

use super::bodies::Bodies;
use super::container::Container;
use super::describe::{FrameTime, PartDescription, RunDescription, Warned};
use super::folder::Ranged;
use super::frame;
use super::probe::{self, ProbePlace, Probed, Track};
use super::request::FrameRequest;
use super::values::{RangeOf, range_of};
use crate::model_file::{Diagnostic, Diagnostics};
use crate::picture::field::Scalar;
use crate::preview::{KINDS, Preview};
use crate::results::Appearance;
use embate_solver::output::{Frame, Location};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// A state of a model file, as a page shows it.
#[derive(Debug)]
pub struct ModelView {
    /// Which state of the file it is, from 1: the number of its frame.
    pub version: usize,
    bodies: Arc<Bodies>,
    frame: Frame,
    description: RunDescription,
    about: Value,
}

impl ModelView {
    /// That of what was found of the model file `path`; `before`: what was shown of the file before it
    /// changed.
    #[must_use]
    pub fn new(path: &Path, preview: Preview, before: Option<&Self>) -> Self {
        let version = before.map_or(1, |before| before.version + 1);
        let same = before.filter(|before| before.bodies.dimension == preview.frame.dimension);
        let bodies = match same {
            Some(before) => before.bodies.with_cells(preview.cells.clone(), &preview.frame),
            None => Bodies::new(preview.cells.clone(), &preview.frame),
        };
        let description = description(path, version, &preview, &bodies);
        let about = about(path, version, &preview);
        Self { version, bodies: Arc::new(bodies), frame: preview.frame, description, about }
    }

    /// Its bodies.
    #[must_use]
    pub fn bodies(&self) -> &Arc<Bodies> {
        &self.bodies
    }

    /// As that of a run.
    #[must_use]
    pub fn description(&self) -> &RunDescription {
        &self.description
    }

    /// Faults, warnings, glyphs and parts.
    #[must_use]
    pub fn about(&self) -> &Value {
        &self.about
    }

    /// The bodies at the start.
    #[must_use]
    pub fn frame(&self, request: &FrameRequest) -> Container {
        let outlines = frame::outlines(&self.frame);
        frame::frame(&self.bodies, &self.bodies.without(&[]), &self.frame, &outlines, request).with("frame", self.version)
    }

    /// Smallest and largest value of a scalar.
    #[must_use]
    pub fn range(&self, name: &str, of: RangeOf) -> Ranged {
        let found = self.scalars(name).and_then(|(scalar, values)| range_of(&self.bodies, &self.bodies.without(&[]), scalar, &values, of));
        (found, 1)
    }

    /// A scalar at a node or in a cell; none where there is no such scalar or place.
    #[must_use]
    pub fn probe(&self, name: &str, place: ProbePlace) -> Option<Probed> {
        let (scalar, values) = self.scalars(name)?;
        let own = probe::places(&self.bodies, place, scalar.kind.location == Location::Cell)?;
        let found: Vec<f64> = own.iter().filter_map(|&place| values.get(place)).copied().filter(|value| value.is_finite()).collect();
        let mean = (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64);
        Some(Probed { times: vec![0.0], values: vec![mean], unit: scalar.kind.unit, label: scalar.label() })
    }

    /// Where a node, or the middle of an element, is; none where there is no such place.
    #[must_use]
    pub fn track(&self, place: ProbePlace) -> Option<Track> {
        let nodes = probe::places(&self.bodies, place, false).filter(|nodes| !nodes.is_empty())?;
        let initial = probe::initial(&self.bodies, &nodes);
        Some(Track { times: vec![0.0], initial, positions: vec![initial] })
    }

    /// A scalar, and its values at all nodes or cells.
    fn scalars(&self, name: &str) -> Option<(Scalar, Vec<f64>)> {
        let scalar = Scalar::of(self.frame.fields.iter().map(|field| field.kind), name)?;
        let field = self.frame.fields.iter().find(|field| field.kind == scalar.kind)?;
        Some((scalar, field.values.chunks_exact(field.kind.width()).map(|own| scalar.scalar(own)).collect()))
    }
}

fn description(path: &Path, version: usize, preview: &Preview, bodies: &Bodies) -> RunDescription {
    let appearance = preview.model.as_ref().map(Appearance::of).unwrap_or_default();
    let mut elements = vec![0usize; preview.cells.part_names.len()];
    preview.cells.parts.iter().for_each(|&part| elements[part as usize] += 1);
    let is_rigid = |name: &str| appearance.parts.iter().any(|(part, is_rigid)| part == name && *is_rigid);
    let parts = preview.cells.part_names.iter().zip(elements);
    let name = preview.model.as_ref().map_or_else(|| path.display().to_string(), |model| model.name.clone());
    let mut description = RunDescription {
        title: name.clone(),
        name,
        path: path.display().to_string(),
        dimension: preview.frame.dimension,
        nodes: preview.frame.nodes(),
        elements: preview.cells.len(),
        parts: parts.map(|(name, elements)| PartDescription { is_rigid: is_rigid(name), name: name.clone(), elements }).collect(),
        frames: vec![FrameTime { number: version, time: 0.0 }],
        is_over: true,
        size: bodies.size().unwrap_or_default(),
        obstacles: appearance.obstacles.clone(),
        contacts: appearance.contacts.clone(),
        warnings: preview.warnings.entries.iter().map(warned).collect(),
        ..RunDescription::default()
    };
    let kinds: Vec<_> = preview.frame.fields.iter().map(|field| field.kind).collect();
    description.show(&appearance, &kinds);
    // Parts first: fields are chosen.
    description.scalar = None;
    description
}

fn warned(warning: &Diagnostic) -> Warned {
    let text = [&warning.message, &warning.consequence, &warning.help].into_iter().filter(|text| !text.is_empty());
    Warned { code: warning.kind.code.into(), text: text.map(String::as_str).collect::<Vec<_>>().join("; ") }
}

fn about(path: &Path, version: usize, preview: &Preview) -> Value {
    let list = |diagnostics: &Diagnostics| {
        let of = |entry: &Diagnostic| {
            let Diagnostic { kind, file, line, column, path, message, consequence, help, .. } = entry;
            json!({ "code": kind.code, "title": kind.title, "file": file, "line": line, "column": column, "path": path,
                "message": message, "consequence": consequence, "help": help })
        };
        diagnostics.entries.iter().map(of).collect::<Vec<_>>()
    };
    let overview = preview.overview.as_ref();
    let parts: Vec<Value> = overview
        .into_iter()
        .flat_map(|overview| &overview.parts)
        .map(|part| {
            let kinds: Vec<Value> = part.kinds.iter().map(|(kind, count)| json!([kind, count])).collect();
            json!({ "name": part.name, "kinds": kinds, "nodes": part.nodes, "mass": part.mass, "size": part.size,
            "wave_speed": part.wave_speed, "is_rigid": part.is_rigid, "governs": part.governs,
            "stable_step": Some(part.stable_time_step).filter(|step| step.is_finite()) })
        })
        .collect();
    let step = overview
        .map(|overview| json!({ "first": overview.stable_time_step, "governor": overview.governor, "count": overview.steps_expected }));
    let mass_unit = preview.model.as_ref().map_or("kg", |model| if model.is_of_whole_bodies() { "kg" } else { "kg/m" });
    json!({
        "version": version, "path": path.display().to_string(), "has_bodies": preview.has_bodies(), "is_checked": preview.is_checked(),
        "faults": list(&preview.faults), "warnings": list(&preview.warnings), "kinds": KINDS, "glyphs": preview.glyphs,
        "parts": parts, "mass_unit": mass_unit, "step": step,
        "end": preview.model.as_ref().map(|model| model.run.end).filter(|end| end.is_finite()),
    })
}
