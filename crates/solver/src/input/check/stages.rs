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
                if release >= stage.duration {
                    let message = format!("it takes {release} s to let go, and the stage is over after {} s", stage.duration);
                    self.fault(&PERIOD, format!("{path}.release"), message, "give a longer `duration` or a shorter `release`");
                }
                if index == 0 {
                    self.fault(
                        &CLASH,
                        format!("{path}.release"),
                        "nothing ends before the first stage",
                        "leave it out, or give it to a later stage",
                    );
                }
            }
            let Some(relaxation) = stage.relaxation else { continue };
            self.relaxation(&path, relaxation);
            if relaxation.from >= stage.duration {
                let message = format!("rest counts from {} s on, and the stage is over after {} s", relaxation.from, stage.duration);
                self.fault(&PERIOD, format!("{path}.relaxation.from"), message, "give a longer `duration` or an earlier `from`");
            }
        }
        if !model.stages.is_empty() {
            self.run_of_stages();
        }
        for (index, constraint) in model.constraints.iter().enumerate() {
            self.stage_list(&format!("constraint[{index}].stages"), &constraint.stages);
        }
        for (index, terms) in model.load_terms.iter().enumerate() {
            self.stage_list(&format!("load[{index}].stages"), &terms.stages);
        }
        for (index, contact) in model.contacts.iter().enumerate() {
            self.stage_list(&format!("contact[{index}].stages"), &contact.interface.stages);
        }
        for (index, obstacle) in model.obstacles.iter().enumerate() {
            self.stage_list(&format!("obstacle[{index}].stages"), &obstacle.interface.stages);
        }
        for (name, curve) in &model.curves {
            self.stage_list(&format!("curve.{name}.stage"), curve.stage.as_slice());
        }
    }

    /// What a run with stages has besides.
    fn run_of_stages(&mut self) {
        let model = self.model;
        let durations: f64 = model.stages.iter().map(|stage| stage.duration).sum();
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
