//! What a load is multiplied by: the value of its curve, in its stages, and nothing elsewhere.

use super::Curves;
use crate::model::{Load, LoadTerms, Model, Window};

/// The factor on one load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Factor {
    /// Number of its curve; `None`: one.
    curve: Option<usize>,
    /// Number of its window among those of the curves; `None`: it acts always.
    window: Option<usize>,
}

impl Factor {
    /// Whether it changes with time.
    #[must_use]
    pub fn varies(&self) -> bool {
        self.curve.is_some() || self.window.is_some()
    }
}

/// Windows of the loads that have one, with their places in the model.
pub(super) fn windows(model: &Model) -> Vec<(usize, Window)> {
    let window = |(index, terms): (usize, &LoadTerms)| Some((index, Window::of(model, &terms.stages)?));
    model.load_terms.iter().enumerate().filter_map(window).collect()
}

impl Curves {
    /// The factor on the load of this place in the model, with the name of its curve.
    #[must_use]
    pub fn factor_on(&self, index: usize, curve: Option<&String>) -> Factor {
        Factor { curve: curve.and_then(|name| self.find(name)), window: self.windows.iter().position(|(load, _)| *load == index) }
    }

    /// Mean of a factor between two times; its value where they are one.
    #[must_use]
    pub fn factor(&self, factor: Factor, [from, to]: [f64; 2]) -> f64 {
        let mean = |from: f64, to: f64| factor.curve.map_or(1.0, |curve| self.mean_of(curve, from, to));
        let Some([begin, end]) = factor.window.map(|window| self.windows[window].1.times) else { return mean(from, to) };
        if from == to {
            return if (begin..end).contains(&from) { mean(from, to) } else { 0.0 };
        }
        let (first, last) = (from.max(begin), to.min(end));
        if first < last { (last - first) / (to - from) * mean(first, last) } else { 0.0 }
    }
}

/// The curve of a load that has one.
#[must_use]
pub fn curve_of(load: &Load) -> Option<&String> {
    match load {
        Load::Gravity { curve, .. }
        | Load::Centrifugal { curve, .. }
        | Load::Force { curve, .. }
        | Load::Moment { curve, .. }
        | Load::Pressure { curve, .. } => curve.as_ref(),
        Load::Damping { .. } | Load::StiffnessDamping { .. } => None,
    }
}
