//! Parts of a run that follow each other, such as a preload that is brought to rest and an impact:
//! `[[stage]]`.

use super::run::{RELAXATION, Relaxation};
use super::{Model, Window, section};
use crate::quantity::Dimension;
use crate::quantity::Range::Positive;
use crate::vocabulary::Kind::{Name, Quantity, References, Table};
use crate::vocabulary::Need::Optional;
use crate::vocabulary::{Form, Key, Section, key};

section! {
    /// `[[stage]]`: a part of the run.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Stage in STAGE = Section {
        name: "stage",
        doc: "A part of the run; stages follow each other in the order of the file, and `run.end` is left out. Loads, \
            constraints, contacts and obstacles that name `stages` act in these alone, and times of a curve that names a \
            `stage` count from the beginning of that. A stage with `relaxation` is a static one: it ends when all is at \
            rest. Initial velocities of parts and obstacles are those at the beginning of the first stage without it.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    name: String = Name, Optional("`stage`, `stage2`, ..."), "Unique name, by which others refer to it.";
    duration: f64 = Quantity(Dimension::TIME, Positive), Required,
        "How long it lasts; with `relaxation` the longest that it may.";
    relaxation: Option<Relaxation> = Table(&RELAXATION), Optional("none"),
        "Damping that brings everything to rest, and the end of the stage when it is; `from` counts from its beginning.";
    release: Option<f64> = Quantity(Dimension::TIME, Positive), Optional("at once"),
        "Time over which what held bodies in the stage before, and does so no more, lets go: reactions of constraints and \
            forces of contacts and obstacles that end decrease smoothly to zero. Rest does not count until then.";
}

/// The key of what acts in some stages only.
pub(crate) const STAGES: Key = key("stages", References(None), Optional("all stages"), "Stages in which it acts, one after the other.");

impl Model {
    /// First and last of the stages of these names, which follow each other; `None`: they are not limited, or
    /// a name is unknown.
    #[must_use]
    pub fn stages_of(&self, names: &[String]) -> Option<[usize; 2]> {
        let places = names.iter().filter_map(|name| self.stages.iter().position(|stage| stage.name == *name));
        let (first, last) = (places.clone().min()?, places.max()?);
        Some([first, last])
    }

    /// Whether what names these stages acts in one of them.
    #[must_use]
    pub fn acts_in(&self, names: &[String], stage: usize) -> bool {
        self.stages_of(names).is_none_or(|[first, last]| (first..=last).contains(&stage))
    }

    /// How long the stages last together, at the longest, s.
    #[must_use]
    pub fn duration_of_stages(&self) -> f64 {
        self.stages.iter().map(|stage| stage.duration).sum()
    }

    /// The stage in which bodies get their initial velocities: the first without relaxation; `None`: there is
    /// none.
    #[must_use]
    pub fn stage_of_velocities(&self) -> Option<usize> {
        self.stages.iter().position(|stage| stage.relaxation.is_none())
    }

    /// The relaxation that the run begins with.
    #[must_use]
    pub fn first_relaxation(&self) -> Option<Relaxation> {
        self.stages.first().map_or(self.run.relaxation, |stage| stage.relaxation)
    }

    /// The model with the times of what acts in some stages alone as they are known at the start; `None`: it
    /// has no stages.
    #[must_use]
    pub fn with_windows(&self) -> Option<Self> {
        if self.stages.is_empty() {
            return None;
        }
        let mut model = self.clone();
        let of_contacts = model.contacts.iter_mut().map(|it| &mut it.interface);
        for interface in of_contacts.chain(model.obstacles.iter_mut().map(|it| &mut it.interface)) {
            interface.active = Window::of(self, &interface.stages, interface.active).times();
        }
        Some(model)
    }

    /// Longest interval between two rows of the history, s.
    #[must_use]
    pub fn history_interval(&self) -> f64 {
        let longest = self.stages.iter().map(|stage| stage.duration).reduce(f64::max);
        self.output.history.interval(longest.unwrap_or(self.run.end))
    }
}
