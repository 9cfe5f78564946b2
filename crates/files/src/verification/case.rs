//! A case as data: its models, and which quantity of which model must have which value.
//!
//! Made by `read.rs` from `expected.toml`; `run.rs` runs its models, `quantity.rs` finds the quantities,
//! `judge.rs` compares.

use crate::model_file::Described;
use embate_solver::model::Model;
use std::path::PathBuf;

/// When a case is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// By default.
    Every,
    /// Only when all are wanted, or by name.
    All,
}

/// A folder of `verification/`.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name of the folder.
    pub name: String,
    /// What is verified.
    pub title: String,
    /// When it is run.
    pub tier: Tier,
    /// Where it lies.
    pub folder: PathBuf,
    /// The models that its checks need, in the order in which the checks name them.
    pub models: Vec<(String, Model)>,
    /// What must hold.
    pub checks: Vec<Check>,
    /// The text, for faults that show only when the models are made ready.
    pub(super) text: Described,
}

/// A quantity and the values that it may have.
#[derive(Clone, Debug)]
pub struct Check {
    /// What is compared.
    pub name: String,
    /// Models for which it is made.
    pub models: Vec<String>,
    /// What is compared.
    pub quantity: Quantity,
    /// A second quantity that it is combined with.
    pub with: Option<With>,
    /// What is accepted.
    pub accepted: Accepted,
    /// Where the value and the tolerance come from.
    pub reason: String,
}

/// A second quantity.
#[derive(Clone, Debug)]
pub struct With {
    /// How it comes in.
    pub how: Combination,
    /// What it is.
    pub quantity: Quantity,
    /// Of which model; `None`: of that of the check.
    pub model: Option<String>,
}

/// How a second quantity comes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// The first is divided by it.
    Over,
    /// It is taken away from the first.
    Minus,
}

/// What is accepted.
#[derive(Clone, Debug, PartialEq)]
pub enum Accepted {
    /// |found − expected| ≤ tolerance · |expected|.
    Relative {
        /// The value.
        expected: f64,
        /// The largest deviation.
        tolerance: f64,
    },
    /// |found − expected| ≤ tolerance.
    Absolute {
        /// The value.
        expected: f64,
        /// The largest deviation.
        tolerance: f64,
    },
    /// |found − expected| ≤ `fraction` · |found by `model` − expected|.
    Converges {
        /// The value.
        expected: f64,
        /// The coarser model.
        model: String,
        /// Largest fraction of its deviation.
        fraction: f64,
    },
    /// Between two limits.
    Limits {
        /// Smallest value.
        least: Option<f64>,
        /// Largest value.
        most: Option<f64>,
    },
}

/// One number of a run.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Path of its table in the file, for faults.
    pub(super) path: String,
    /// Where it comes from.
    pub source: Source,
}

/// Where a number comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// A figure of the summary: keys within keys.
    Summary(String),
    /// A column of the history at a time, s.
    HistoryAt(String, f64),
    /// What `take` makes of a column of the history, perhaps only from one time to another.
    History {
        /// The column.
        column: String,
        /// What is made of it.
        take: &'static Take,
        /// Begin and end, s; `None`: of the run.
        during: [Option<f64>; 2],
        /// For takes with a level.
        level: f64,
    },
    /// Values of a field.
    Field {
        /// `stress.yy`.
        name: String,
        /// Time of the frame, s; `None`: the last.
        at: Option<f64>,
        /// Which of its values.
        part: Option<String>,
        /// Which of its values.
        place: Place,
        /// What is made of them; of a nearest value, itself.
        take: &'static Take,
    },
}

/// Nodes or elements by their position at the start, m; in 2D z is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// All.
    All,
    /// Those from `low` to `high`, border included.
    Box {
        /// Corner with the least coordinates.
        low: [f64; 3],
        /// Corner with the largest coordinates.
        high: [f64; 3],
    },
    /// The nearest one.
    Nearest([f64; 3]),
}

/// What can be made of many values.
#[derive(Debug)]
pub struct Take {
    /// Name in the file.
    pub name: &'static str,
    /// How.
    pub how: How,
    /// Whether it applies to a history.
    pub of_history: bool,
    /// Whether it applies to a field.
    pub of_field: bool,
    /// What it is.
    pub doc: &'static str,
}

/// What is made of many values; a NaN among them makes it NaN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // TAKES explains each
pub enum How {
    Mean,
    Max,
    Min,
    MaxAbs,
    Last,
    Sum,
    Integral,
    FirstAbove,
    FirstBelow,
    LastAbove,
    LastBelow,
    TimeOfMax,
    TimeOfMin,
}

impl How {
    /// Whether what it gives is a time.
    #[must_use]
    pub fn is_time(self) -> bool {
        self.has_level() || matches!(self, Self::TimeOfMax | Self::TimeOfMin)
    }

    /// Whether it needs a level.
    #[must_use]
    pub fn has_level(self) -> bool {
        matches!(self, Self::FirstAbove | Self::FirstBelow | Self::LastAbove | Self::LastBelow)
    }
}

const fn take(name: &'static str, how: How, [of_history, of_field]: [bool; 2], doc: &'static str) -> Take {
    Take { name, how, of_history, of_field, doc }
}

/// Everything that can be made of many values.
pub static TAKES: &[Take] = &[
    take("mean", How::Mean, [true, true], "integral over time divided by the time; of a field, sum divided by number"),
    take("max", How::Max, [true, true], "largest value"),
    take("min", How::Min, [true, true], "smallest value"),
    take("max_abs", How::MaxAbs, [true, true], "largest size, whatever the sign"),
    take("last", How::Last, [true, false], "value at the end"),
    take("sum", How::Sum, [false, true], "sum"),
    take("integral", How::Integral, [true, false], "integral over time, on straight lines between rows"),
    take("first_above", How::FirstAbove, [true, false], "first time at which the column is above `level`"),
    take("first_below", How::FirstBelow, [true, false], "first time at which the column is below `level`"),
    take("last_above", How::LastAbove, [true, false], "last time at which the column is above `level`"),
    take("last_below", How::LastBelow, [true, false], "last time at which the column is below `level`"),
    take("time_of_max", How::TimeOfMax, [true, false], "first time of the largest value"),
    take("time_of_min", How::TimeOfMin, [true, false], "first time of the smallest value"),
];
