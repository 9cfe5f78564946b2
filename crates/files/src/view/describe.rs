//! What a page is sent about a run: its model, what can be shown of it, how it ended. Plain data for JSON,
//! made by `folder`.

use crate::picture::field::Scalar;
use crate::results::Appearance;
use embate_solver::output::FieldKind;
use serde::Serialize;
use serde_json::Value;

/// A part of the model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartDescription {
    /// Name.
    pub name: String,
    /// Cells that it has.
    pub elements: usize,
    /// Whether it is a rigid body.
    pub is_rigid: bool,
}

/// A frame on disk.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FrameTime {
    /// Its number.
    pub number: usize,
    /// s.
    pub time: f64,
}

/// A number of each node or cell that can be chosen as colour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScalarDescription {
    /// What it is asked for by: `stress.xy`.
    pub key: String,
    /// Name for people.
    pub label: String,
    /// What it is.
    pub doc: &'static str,
    /// SI unit; empty for a pure number.
    pub unit: &'static str,
    /// `node` or `cell`.
    pub location: &'static str,
    /// Whether its colours begin at zero.
    pub starts_at_zero: bool,
    /// Names of the values 0, 1, ... of a field that reports states.
    pub states: &'static [&'static str],
}

impl ScalarDescription {
    /// All of some fields.
    #[must_use]
    pub fn of(kinds: &[&'static FieldKind]) -> Vec<Self> {
        let describe = |(key, scalar): (String, Scalar)| Self {
            key,
            label: scalar.label(),
            doc: scalar.kind.doc,
            unit: scalar.kind.unit,
            location: if scalar.at_nodes() { "node" } else { "cell" },
            starts_at_zero: scalar.starts_at_zero(),
            states: scalar.states(),
        };
        Scalar::all(kinds).into_iter().map(describe).collect()
    }

    /// What is shown first: the model's choice, plastic strain, equivalent stress, or whatever there is.
    #[must_use]
    pub fn first(kinds: &[&'static FieldKind], wanted: &str) -> Option<String> {
        let names = [wanted, "plastic_strain", "von_mises"].into_iter().chain(kinds.first().map(|kind| kind.name));
        names.map(ToString::to_string).find(|name| Scalar::of(kinds.iter().copied(), name).is_some())
    }
}

/// A warning of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Warned {
    /// Its code.
    pub code: String,
    /// What it says.
    pub text: String,
}

/// A column of the history.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Column {
    /// As in `history.csv`.
    pub name: String,
    /// SI unit; empty for a pure number.
    pub unit: String,
}

/// A run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RunDescription {
    /// Name of the model.
    pub name: String,
    /// Title of the model, or its name.
    pub title: String,
    /// Folder of the results.
    pub path: String,
    /// By which it can be run again.
    pub command: Option<String>,
    /// 2 in 2D, 3 in 3D.
    pub dimension: usize,
    /// Whether it is an axisymmetric body.
    pub axisymmetric: bool,
    /// End time, s.
    pub end: Option<f64>,
    /// J/m in 2D, else J.
    pub energy_unit: &'static str,
    /// How many.
    pub nodes: usize,
    /// How many.
    pub elements: usize,
    /// In model order.
    pub parts: Vec<PartDescription>,
    /// On disk, by time.
    pub frames: Vec<FrameTime>,
    /// Whether nothing will be added.
    pub is_over: bool,
    /// What can be shown as colour.
    pub scalars: Vec<ScalarDescription>,
    /// What is shown first.
    pub scalar: Option<String>,
    /// Whether frames have contact forces.
    pub has_arrows: bool,
    /// Unit of a contact force.
    pub arrow_unit: &'static str,
    /// Symmetries by which the model is completed, across x = 0, y = 0 and z = 0.
    pub mirror: [bool; 3],
    /// As the model wants it.
    pub camera: Option<Value>,
    /// Box of the bodies at the first frame, m.
    pub size: [[f64; 3]; 2],
    /// Names.
    pub obstacles: Vec<String>,
    /// Names.
    pub contacts: Vec<String>,
    /// `summary.json` as it is.
    pub summary: Option<Value>,
    /// Of the run.
    pub warnings: Vec<Warned>,
    /// Of a run that failed.
    pub error: Option<String>,
    /// Bytes of its frames.
    pub size_on_disk: u64,
}

impl RunDescription {
    /// How the model wants to be shown, with the fields that its frames have.
    pub(super) fn show(&mut self, appearance: &Appearance, kinds: &[&'static FieldKind]) {
        let of_whole_bodies = appearance.axisymmetric || self.dimension == 3;
        let Appearance { title, axisymmetric, end, mirror, camera, .. } = appearance;
        (self.axisymmetric, self.end, self.mirror) = (*axisymmetric, *end, *mirror);
        self.camera = camera.as_ref().and_then(|camera| serde_json::to_value(camera).ok());
        self.energy_unit = if of_whole_bodies { "J" } else { "J/m" };
        self.arrow_unit = if of_whole_bodies { "N" } else { "N/m" };
        if !title.is_empty() {
            self.title.clone_from(title);
        }
        self.scalars = ScalarDescription::of(kinds);
        // Rigid bodies have neither stress nor strain: their parts say more than how far they have come.
        let are_rigid = !self.parts.is_empty() && self.parts.iter().all(|part| part.is_rigid);
        let is_chosen = !appearance.field.is_empty();
        self.scalar = ScalarDescription::first(kinds, &appearance.field).filter(|_| is_chosen || !are_rigid);
        self.has_arrows = kinds.iter().any(|kind| kind.name == "contact_force");
    }

    /// The warnings of a summary: each begins with its code.
    pub(super) fn warned(summary: &Value) -> Vec<Warned> {
        let warned = |text: &str| {
            let (code, text) = text.split_once(": ").filter(|(code, _)| code.len() == 5).unwrap_or(("", text));
            Warned { code: code.into(), text: text.into() }
        };
        let texts = summary.get("warnings").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str);
        texts.map(warned).collect()
    }
}
