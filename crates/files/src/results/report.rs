//! `summary.json`: what came out of a run, in a fixed order of keys.
//!
//! Figures come from [`Summary`]; the recorder adds status, names and times. Goes to the user, to tests and
//! to tools.

use crate::program;
use embate_solver::error::Notice;
use embate_solver::output::{self, Eroded, ForcePeak, StageRun, Summary};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RunStatus {
    /// It reached its end time, or rest where relaxation was asked for.
    Done,
    /// It ended with an error; what was computed until then is kept.
    Failed,
    /// It ended before its end time because the user or `run.max_steps` said so.
    Stopped,
}

/// Relative change of momentum over the whole run; a number is `None` where something is held or driven, or
/// loads act.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MomentumDrift {
    /// Change of linear momentum over Σ m|v|.
    pub linear: Option<f64>,
    /// Change of angular momentum about the centre of mass at the start c, over Σ m|x − c||v|.
    pub angular: Option<f64>,
}

/// Mass that was added in the run for longer steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MassAddedInRun {
    /// The mass, kg/m (kg).
    pub mass: f64,
    /// Absolute value of the momentum that it brought, kg/s (kg m/s).
    pub momentum: f64,
    /// Kinetic energy that it brought, J/m (J).
    pub kinetic_energy: f64,
}

/// Proof that no contact between surfaces was missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ContactCheck {
    /// Pairs of a node and a segment whose paths within a step were checked for crossing, over all steps.
    pub pairs_swept: u64,
    /// Nodes that were found to go into a body.
    pub crossings_found: u64,
    /// Nodes inside a body without contact, over all steps; must be zero.
    pub unverified: u64,
}

/// What erosion has done.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Erosion {
    /// Eroded elements of each part that has lost some.
    pub elements: BTreeMap<String, usize>,
    /// Mass of nodes that have no element any more, kg/m.
    pub mass_loose: f64,
    /// The element that failed first.
    pub first: FirstEroded,
}

/// The element that failed first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FirstEroded {
    /// Its part.
    pub part: String,
    /// Its number in the part.
    pub element: usize,
    /// Its place when it failed, m: two components in 2D, three in 3D.
    pub at: Vec<f64>,
    /// When it failed, s.
    pub time: f64,
    /// By which criterion.
    pub criterion: String,
}

/// The largest force of a contact, condition, load or cut in the history.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Force {
    /// Its size, N/m (N).
    pub max: f64,
    /// Time of its row, s.
    pub time: f64,
    /// Components in the last row, N/m (N).
    pub end: Vec<f64>,
}

/// What a channel comes to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelFigures {
    /// The largest value.
    pub max: f64,
    /// Its time, s.
    pub time_max: f64,
    /// The smallest value.
    pub min: f64,
    /// Its time, s.
    pub time_min: f64,
    /// The last value.
    pub end: f64,
}

/// The contents of `summary.json`; the order of the fields is the order in the file. Numbers that are not
/// finite become `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// How the run ended.
    pub status: RunStatus,
    /// The message of a failed run.
    pub error: Option<String>,
    /// The page about the failure, relative to the folder; left out where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub post_mortem: Option<String>,
    /// Model name.
    pub model: String,
    /// Version of embate.
    pub version: String,
    /// Commit that the program was built from, if that was known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// Names of the parts; their order gives the numbers of the cell field `part`.
    pub parts: Vec<String>,
    /// Threads used.
    pub threads: usize,
    /// Instruction set used.
    pub simd: String,
    /// Number of elements.
    pub elements: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Steps done.
    pub steps: u64,
    /// Time reached, s.
    pub time_end: f64,
    /// When relaxation had brought everything to rest, which ended the run, s; left out where it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rest: Option<f64>,
    /// The stages of the run so far; left out where it has none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<Stage>,
    /// Wall time of the run with its output and pictures, without reading and meshing the model, s.
    pub wall_seconds: f64,
    /// User CPU time of the whole process, s; `None` where the system does not report it.
    pub user_cpu_seconds: Option<f64>,
    /// Time that the writer of results was at work, beside the steps or in turn with them, and with the
    /// pictures at the end, s.
    pub output_seconds: f64,
    /// Wall time that the run waited for its output: steps that waited for the writer, and the end for the
    /// rest and the pictures, s.
    pub output_wait_seconds: f64,
    /// Elements × steps over the wall time of the steps alone, output taken out; `None` for a run without
    /// steps.
    pub element_steps_per_second: Option<f64>,
    /// Smallest time step taken, s.
    pub stable_time_step_min: f64,
    /// What governed that step.
    pub stable_time_step_governor: String,
    /// Largest |stores − works| as a fraction of the largest total energy.
    pub energy_drift: f64,
    /// Largest |change of kinetic energy − sum of works| as a fraction of the largest total energy.
    pub ledger_residual: f64,
    /// Change of momentum; `None` where something is held or driven, or loads act.
    pub momentum_drift: Option<MomentumDrift>,
    /// Deepest penetration seen, m.
    pub penetration_max: f64,
    /// What was checked in the contacts.
    pub contact: ContactCheck,
    /// Mass that was added for longer steps, kg/m; left out where none was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_added: Option<f64>,
    /// What of it was added in the run, with the momentum and the energy that it brought; left out where none
    /// was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_added_in_run: Option<MassAddedInRun>,
    /// With subcycling: evaluations of elements, summed over the steps; left out without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub element_evaluations: Option<u64>,
    /// Each time that elements were made again; left out where none were.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remeshings: Vec<Remeshing>,
    /// Parts that material flows through; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub flows: Vec<Flow>,
    /// What erosion has done; left out where nothing was eroded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub erosion: Option<Erosion>,
    /// Largest forces of the history's rows, by what they are of; left out where there are none.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub forces: BTreeMap<String, Force>,
    /// What the model's channels come to; left out where it has none.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub channels: BTreeMap<String, ChannelFigures>,
    /// Hash of positions and velocities at the end.
    pub state_hash: String,
    /// Things the user should know.
    #[serde(serialize_with = "texts")]
    pub warnings: Vec<Notice>,
}

/// Each as one text: code, colon, what it is.
fn texts<S: serde::Serializer>(notices: &[Notice], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(notices.iter().map(ToString::to_string))
}

fn force(peak: &ForcePeak) -> (String, Force) {
    (peak.name.clone(), Force { max: peak.largest, time: peak.time, end: peak.last.clone() })
}

fn erosion(erosion: &embate_solver::output::Erosion, dimension: usize) -> Erosion {
    let Eroded { part, element, at, time, criterion } = erosion.first.clone();
    let first = FirstEroded { part, element, at: at[..dimension].to_vec(), time, criterion: criterion.to_string() };
    Erosion { elements: erosion.elements.iter().cloned().collect(), mass_loose: erosion.mass_loose, first }
}

/// Elements of a part were made again.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Remeshing {
    /// When, s, and after which step.
    pub time: f64,
    /// See `time`.
    pub step: u64,
    /// The part.
    pub part: String,
    /// Whether nodes were moved, instead of elements made again.
    #[serde(default)]
    pub relocated: bool,
    /// Why: `quality`, `time_step`, `size` or `interval`.
    pub reason: String,
    /// Elements before and after.
    pub elements: [usize; 2],
    /// Least scaled Jacobian before and after.
    pub quality: [f64; 2],
    /// Stable step of the part before and after, s.
    pub stable_time_step: [f64; 2],
    /// Kinetic energy that was lost, J/m (J).
    pub kinetic_lost: f64,
    /// Elastic energy that was lost, J/m (J).
    pub elastic_lost: f64,
    /// Largest correction of a node's mass, as a fraction of it.
    pub mass_correction: f64,
    /// Change of linear and of angular momentum of the part over Σ m|v| and Σ m|x − c||v|.
    pub momentum_change: [f64; 2],
    /// Change of the volume, as a fraction of it.
    pub volume_change: f64,
}

impl Remeshing {
    fn of(event: &output::Remeshing) -> Self {
        let output::Remeshing { time, step, part, relocated, reason, elements, quality, time_step, .. } = event.clone();
        let output::Remeshing { kinetic_lost, elastic_lost, mass_correction, momentum_change, volume_change, .. } = *event;
        Self {
            time,
            step,
            part,
            relocated,
            reason,
            elements,
            quality,
            stable_time_step: time_step,
            kinetic_lost,
            elastic_lost,
            mass_correction,
            momentum_change,
            volume_change,
        }
    }
}

/// A part that material flows through.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Flow {
    /// The part.
    pub part: String,
    /// How often its nodes went back to their places.
    pub events: u64,
    /// Way of the material over the length of the part.
    pub passages: f64,
    /// Mass that came in, kg/m (kg).
    pub mass_in: f64,
    /// Mass that went out, kg/m (kg).
    pub mass_out: f64,
    /// Kinetic and elastic energy that came in, J/m (J).
    pub energy_in: f64,
    /// Kinetic and elastic energy that went out, J/m (J).
    pub energy_out: f64,
    /// Kinetic energy that was lost, J/m (J).
    pub kinetic_lost: f64,
    /// Elastic energy that was lost, J/m (J).
    pub elastic_lost: f64,
    /// Largest change at once of linear and of angular momentum, beyond what came in and went out, over Σ
    /// m|v| and Σ m|x − c||v|.
    pub momentum_change: [f64; 2],
    /// Largest correction of a node's mass, as a fraction of it.
    pub mass_correction: f64,
    /// Change of the state over the last quarter of a passage; left out where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change: Option<f64>,
    /// When the state was steady first, s; left out where it was not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady: Option<f64>,
}

impl Flow {
    fn of(flow: &output::Flow) -> Self {
        let output::Flow { part, events, passages, mass, energy, kinetic_lost, elastic_lost, momentum_change, mass_correction, .. } =
            flow.clone();
        Self {
            part,
            events,
            passages,
            mass_in: mass[0],
            mass_out: mass[1],
            energy_in: energy[0],
            energy_out: energy[1],
            kinetic_lost,
            elastic_lost,
            momentum_change,
            mass_correction,
            change: flow.change,
            steady: flow.steady,
        }
    }
}

/// A stage of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// When it began, s.
    pub begin: f64,
    /// When it was over, s; of the last one the time reached.
    pub end: f64,
    /// Whether all was at rest at its end; left out where it is not relaxed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_rest: Option<bool>,
    /// Kinetic over internal energy at its end, where it is relaxed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinetic_ratio: Option<f64>,
}

impl Stage {
    fn of(StageRun { name, begin, end, is_at_rest, ratio }: &StageRun) -> Self {
        // Nothing that is strained yet has a ratio.
        let kinetic_ratio = ratio.filter(|ratio| ratio.is_finite());
        Self { name: name.clone(), begin: *begin, end: *end, at_rest: *is_at_rest, kinetic_ratio }
    }

    /// What it is called in a table, and when it was, as times are shown there.
    #[must_use]
    pub fn row(&self, time: impl Fn(f64) -> String) -> [String; 2] {
        let rest = self.at_rest.map_or("", |rests| if rests { ", at rest" } else { ", not at rest" });
        [format!("stage {}", self.name), format!("{} to {}{rest}", time(self.begin), time(self.end))]
    }
}

impl Report {
    /// A report of the solver's figures; the rest is filled in by the recorder.
    #[must_use]
    pub fn of(summary: &Summary, model: &str, parts: &[String]) -> Self {
        let momentum = MomentumDrift { linear: summary.momentum_drift_linear, angular: summary.momentum_drift_angular };
        Self {
            status: RunStatus::Done,
            error: None,
            post_mortem: None,
            model: model.to_string(),
            version: program::VERSION.to_string(),
            commit: program::commit().map(Into::into),
            parts: parts.to_vec(),
            threads: summary.threads,
            simd: summary.simd.clone(),
            elements: summary.elements,
            nodes: summary.nodes,
            steps: summary.steps,
            time_end: summary.time_end,
            rest: summary.rest,
            stages: summary.stages.iter().map(Stage::of).collect(),
            wall_seconds: 0.0,
            user_cpu_seconds: None,
            output_seconds: 0.0,
            output_wait_seconds: 0.0,
            element_steps_per_second: None,
            stable_time_step_min: summary.stable_time_step_min,
            stable_time_step_governor: summary.stable_time_step_governor.clone(),
            energy_drift: summary.energy_drift,
            ledger_residual: summary.ledger_residual,
            momentum_drift: (momentum.linear.is_some() || momentum.angular.is_some()).then_some(momentum),
            penetration_max: summary.penetration_max,
            contact: ContactCheck {
                pairs_swept: summary.contact.pairs_swept,
                crossings_found: summary.contact.crossings_found,
                unverified: summary.contact.unverified,
            },
            mass_added: (summary.mass_added != 0.0).then_some(summary.mass_added),
            mass_added_in_run: summary.mass_added_in_run.map(|own| MassAddedInRun {
                mass: own.mass,
                momentum: own.momentum,
                kinetic_energy: own.kinetic_energy,
            }),
            element_evaluations: summary.element_evaluations,
            remeshings: summary.remeshings.iter().map(Remeshing::of).collect(),
            flows: summary.flows.iter().map(Flow::of).collect(),
            erosion: summary.erosion.as_ref().map(|it| erosion(it, summary.dimension)),
            forces: summary.forces.iter().map(force).collect(),
            channels: BTreeMap::new(),
            state_hash: summary.state_hash.clone(),
            warnings: summary.warnings.clone(),
        }
    }

    /// The contents of `summary.json` as a tree.
    pub(crate) fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).expect("plain numbers, texts and lists always have a JSON form")
    }

    /// The text of `summary.json`.
    #[must_use]
    pub fn json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain numbers, texts and lists always have a JSON form");
        text.push('\n');
        text
    }
}
