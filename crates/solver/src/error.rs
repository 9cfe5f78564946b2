//! What can go wrong: faults of a model (all are reported at once), warnings of one that is accepted, and failures of a run (the first ends it).

use crate::archive::Misfit;
use std::fmt;
use thiserror::Error;

/// One fault of a model: where in the input, what is wrong, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Path of the key in the input, `part[0].ring.inner` for example; empty for the whole model.
    pub path: String,
    /// What is wrong, with the value.
    pub message: String,
    /// What to do about it; may be empty.
    pub help: String,
}

impl Fault {
    /// A fault at `path`.
    pub fn new(path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into(), help: help.into() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(f, " ({})", self.help)?;
        }
        Ok(())
    }
}

/// Something of a sound model that the user should know before he trusts its results: the model is accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Path of the key in the input, as in [`Fault`].
    pub path: String,
    /// What it is, with the value.
    pub message: String,
    /// What follows from it.
    pub consequence: String,
    /// What to do about it.
    pub help: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        write!(f, "{}: {} ({})", self.message, self.consequence, self.help)
    }
}

/// Why a run failed: what, where, when, and what to try.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Error {
    /// The model has faults; nothing was run.
    #[error("the model has {} fault(s): {}", .0.len(), .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Model(Vec<Fault>),
    /// An element turned inside out.
    #[error(
        "element {element} of part \"{part}\" at ({}) turned inside out at time {time:.6e} s, step {step}; \
         refine the mesh there, lower the load or velocity, or check the material's units",
        place(.at)
    )]
    Inverted {
        #[doc = "Part name."]
        part: String,
        #[doc = "Element number within the part."]
        element: usize,
        #[doc = "Centre, m."]
        at: Vec<f64>,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// The stable time step fell below the limit.
    #[error(
        "the stable time step fell to {time_step:.3e} s, below the limit of {limit:.3e} s, at time {time:.6e} s, step {step}; it is governed by \
         {governor}; look at that place in the last written state, or lower run.step_limit"
    )]
    Collapsed {
        #[doc = "Step, s."]
        time_step: f64,
        #[doc = "Limit, s."]
        limit: f64,
        #[doc = "Who governs."]
        governor: String,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// The energy drift exceeded the limit.
    #[error(
        "the energy drift reached {:.2} % of the largest total energy, more than the limit of {:.2} %, at time {time:.6e} s, step {step}; \
         lower run.safety, check contact penalties and initial penetrations, or raise run.energy_limit if the loss is understood",
        100.0 * .drift, 100.0 * .limit
    )]
    EnergyDrift {
        #[doc = "Drift as a fraction."]
        drift: f64,
        #[doc = "Limit as a fraction."]
        limit: f64,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// A number stopped being finite.
    #[error("{what} is no longer a finite number at time {time:.6e} s, step {step}; {place}; check material parameters, loads and units")]
    NotFinite {
        #[doc = "Which quantity."]
        what: String,
        #[doc = "Node or element and its coordinates."]
        place: String,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// A kept state is not one of the model.
    #[error("the kept state does not fit the model: {0}; it was written by another version of embate, or it is damaged")]
    State(String),
    /// The observer could not take a result.
    #[error("results can't be written: {0}")]
    Output(String),
}

impl From<Misfit> for Error {
    fn from(Misfit(what): Misfit) -> Self {
        Self::State(what.into())
    }
}

fn place(at: &[f64]) -> String {
    at.iter().map(|x| format!("{x:.6e}")).collect::<Vec<_>>().join(", ")
}
