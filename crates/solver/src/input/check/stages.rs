//! Faults of the stages of a run, and of what names them.

use super::Check;
use crate::model::messages::{CLASH, PERIOD, TWICE};
use crate::model::{Part, Relaxation};
use crate::vocabulary::excerpt;
use std::collections::BTreeSet;

impl Check<'_> {
    pub(super) fn stages(&mut self) {
        let model = self.model;
        self.names("stage", model.stages.iter().map(|stage| stage.name.as_str()));
        for (index, stage) in model.stages.iter().enumerate() {
            let path = format!("stage[{index}]");
            self.number(&format!("{path}.duration"), stage.duration);
            if let Some(release) = stage.release {
                self.number(&format!("{path}.release"), release);
                let what = format!("it takes {release} s to let go");
                self.before_end(format!("{path}.release"), release, stage.duration, &what, "a shorter `release`");
                if index == 0 {
                    let help = "leave it out, or give it to a later stage";
                    self.fault(&CLASH, format!("{path}.release"), "nothing ends before the first stage", help);
                }
            }
            if let Some(relaxation) = stage.relaxation {
                self.relaxation(&path, relaxation);
                let what = format!("rest counts from {} s on", relaxation.from);
                self.before_end(format!("{path}.relaxation.from"), relaxation.from, stage.duration, &what, "an earlier `from`");
            }
        }
        if !model.stages.is_empty() {
            self.run_of_stages();
        }
        let constraints = model.constraints.iter().map(|it| &it.stages).enumerate().map(|it| ("constraint", it));
        let loads = model.load_terms.iter().map(|it| &it.stages).enumerate().map(|it| ("load", it));
        let contacts = model.contacts.iter().map(|it| &it.interface.stages).enumerate().map(|it| ("contact", it));
        let obstacles = model.obstacles.iter().map(|it| &it.interface.stages).enumerate().map(|it| ("obstacle", it));
        for (section, (index, stages)) in constraints.chain(loads).chain(contacts).chain(obstacles) {
            self.stage_list(&format!("{section}[{index}].stages"), stages);
        }
        for (name, curve) in &model.curves {
            self.stage_list(&format!("curve.{name}.stage"), curve.stage.as_slice());
        }
    }

    /// A time of a stage that must be before its end, s.
    fn before_end(&mut self, path: String, time: f64, duration: f64, what: &str, change: &str) {
        if time >= duration {
            let message = format!("{what}, and the stage is over after {duration} s");
            self.fault(&PERIOD, path, message, format!("give a longer `duration` or {change}"));
        }
    }

    /// What a run with stages has besides.
    fn run_of_stages(&mut self) {
        let model = self.model;
        let durations = model.duration_of_stages();
        if (model.run.end - durations).abs() > 1e-9 * durations {
            let message = format!("the run ends at {} s, and its stages last {durations} s", model.run.end);
            self.fault(&CLASH, "run.end", message, "give the sum of their durations; in a model file leave `end` out");
        }
        if model.run.relaxation.is_some() {
            self.fault(&CLASH, "run.relaxation", "the model has stages, of which each may be relaxed", "give it to a stage: `[[stage]]`");
        }
        let moves = |part: &Part| part.velocity != [0.0; 3] || part.spin_vector() != [0.0; 3] || part.radial_velocity.is_some();
        if model.stage_of_velocities().is_none()
            && let Some(index) = model.parts.iter().position(moves)
        {
            let message =
                format!("all stages are relaxed, so part `{}` never gets its initial velocity", excerpt(&model.parts[index].name));
            self.fault(&CLASH, format!("part[{index}].velocity"), message, "leave it out, or add a stage without `relaxation`");
        }
    }

    pub(super) fn relaxation(&mut self, path: &str, relaxation: Relaxation) {
        self.number(&format!("{path}.relaxation.tolerance"), relaxation.tolerance);
        self.number(&format!("{path}.relaxation.from"), relaxation.from);
    }

    /// Stages that follow each other.
    fn stage_list(&mut self, path: &str, names: &[String]) {
        let known: Vec<&str> = self.model.stages.iter().map(|stage| stage.name.as_str()).collect();
        let mut places = BTreeSet::new();
        for name in names {
            self.known(path, "stage", name, &known);
            if let Some(place) = known.iter().position(|it| it == name)
                && !places.insert(place)
            {
                self.fault(&TWICE, path, format!("stage `{}` is named twice", excerpt(name)), "name it once");
            }
        }
        if let (Some(first), Some(last)) = (places.first(), places.last())
            && last - first + 1 > places.len()
        {
            let missing = (*first..*last).find(|place| !places.contains(place)).map_or("", |place| known[place]);
            let message = format!("stage `{}` lies between those that are named", excerpt(missing));
            self.fault(&CLASH, path, message, "name stages that follow each other, and give what acts again later a table of its own");
        }
    }
}
