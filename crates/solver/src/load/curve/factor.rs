//! What a load is multiplied by: the value of its curve, in its stages, and nothing elsewhere.

use super::Curves;
use crate::model::{Load, Model, Window};

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

/// Windows of the loads that act in some stages alone, with their places in the model.
pub(super) fn windows(model: &Model) -> Vec<(usize, Window)> {
    let window = |index: usize| (index, Window::of(model, model.stages_of_load(index), [0.0, f64::INFINITY]));
    (0..model.loads.len()).map(window).filter(|(_, window)| window.is_of_stages()).collect()
}

impl Curves {
    /// The factor on a load, with its place in the model.
    #[must_use]
    pub fn factor_on(&self, index: usize, load: &Load) -> Factor {
        Factor { curve: load.curve().and_then(|name| self.find(name)), window: self.windows.iter().position(|(load, _)| *load == index) }
    }

    /// Mean of a factor between two times; its value where they are one.
    #[must_use]
    pub fn factor(&self, factor: Factor, [from, to]: [f64; 2]) -> f64 {
        let mean = |from: f64, to: f64| factor.curve.map_or(1.0, |curve| self.mean_of(curve, from, to));
        let Some([begin, end]) = factor.window.map(|window| self.windows[window].1.times()) else { return mean(from, to) };
        if from == to {
            return if (begin..end).contains(&from) { mean(from, to) } else { 0.0 };
        }
        let (first, last) = (from.max(begin), to.min(end));
        if first < last { (last - first) / (to - from) * mean(first, last) } else { 0.0 }
    }
}
