//! Faults of parts of beams: their cross-sections, laws and what they can't have.

use super::Check;
use crate::material;
use crate::mesh::messages::BEAMS;
use crate::message::Message;
use crate::model::{GIVEN, PROFILES, Part, Profile, StableStep};
use crate::vocabulary::excerpt;
use std::collections::BTreeSet;

impl Check<'_> {
    /// What beams need, and what they can't have.
    pub(super) fn beams(&mut self, path: &str, part: &Part) {
        let at = format!("{path}.profile");
        if !part.is_of_beams() {
            if part.profile.is_some() {
                let help = "leave it out, or take `space_truss` with `element = \"beam2\"`";
                self.fault(&BEAMS, at, "`profile` is the cross-section of beams, but the part has none", help);
            }
            return;
        }
        if self.model.dimension_of(part) == 2 {
            let help = "take `shell2`, which in plane stress is a beam; or `space_truss`, or lines of a mesh file, in 3D";
            self.fault(&BEAMS, format!("{path}.element"), "`beam2` is a line in 3D, but the part is 2D", help);
            return;
        }
        if part.sweep.is_some() {
            // Lines that are swept have their own fault.
            return;
        }
        match &part.profile {
            Some(profile) => self.profile(&at, profile),
            None => {
                let help = "add `profile = { shape = \"round\", diameter = \"10 mm\" }`";
                self.fault(&BEAMS, at, "beams need their cross-section", help);
            }
        }
        if let Some(material) = self.model.materials.get(&part.material)
            && (material::bears_uniaxial_stress(&material.law) == Some(false) || !material.eos.is_empty())
        {
            let message =
                format!("beams can't be of `{}`: it answers differently in different directions, or is a fluid", excerpt(&part.material));
            self.fault(&BEAMS, format!("{path}.material"), message, "take an isotropic solid such as `elastic` or `j2`");
        }
        self.rotating(&BEAMS, path, part, Part::is_of_beams, ["beams", "a bar"]);
    }

    /// What elements whose nodes rotate can't have; said of the step with the first such part alone.
    pub(super) fn rotating(
        &mut self,
        kind: &'static Message,
        path: &str,
        part: &Part,
        is_such: fn(&Part) -> bool,
        [what, like]: [&str; 2],
    ) {
        if part.stress_initial.is_some() {
            let help = "leave it out; bring it about by loads in the first part of the run";
            self.fault(kind, format!("{path}.stress_initial"), format!("{what} begin without stress"), help);
        }
        let is_first = self.model.parts.iter().find(|part| is_such(part)).is_some_and(|first| first.name == part.name);
        if is_first && self.model.run.stable_step != StableStep::Elements {
            let message = format!("this bound of the stable step knows no rotations, but the model has {what}");
            self.fault(kind, "run.stable_step", message, format!("leave it out: {what} have the step of {like}"));
        }
    }

    /// A cross-section: sizes that its shape needs, and no others.
    fn profile(&mut self, at: &str, profile: &Profile) {
        let known: Vec<&str> = PROFILES.iter().map(|(name, _)| *name).collect();
        self.known(&format!("{at}.shape"), "shape", &profile.shape, &known);
        let Some((shape, needed)) = PROFILES.iter().find(|(name, _)| *name == profile.shape) else { return };
        let keys: BTreeSet<&str> = PROFILES.iter().flat_map(|(_, keys)| *keys).copied().collect();
        for key in &keys {
            let path = format!("{at}.{key}");
            match (profile.size(key), needed.contains(key)) {
                (Some(value), true) => self.number(&path, value),
                (Some(_), false) => {
                    let message = format!("the shape `{shape}` has no `{key}`");
                    self.fault(&BEAMS, path, message, format!("it has {}", listed(needed)));
                }
                (None, true) => {
                    let message = format!("the shape `{shape}` needs {}", listed(needed));
                    self.fault(&BEAMS, path, message, format!("add `{key}`"));
                }
                (None, false) => {}
            }
        }
        if let Some((key, message)) = profile.impossible() {
            self.fault(&BEAMS, format!("{at}.{key}"), message, "make it smaller");
        }
        if let Some(up) = profile.up {
            self.direction(&format!("{at}.up"), up);
        }
        self.number(&format!("{at}.failed_points"), profile.failed_points);
        if let Some(corners) = profile.corners.filter(|_| profile.is_circular()).filter(|corners| !(4..=64).contains(corners)) {
            let message = format!("the polygon of a circle has 4 to 64 corners, not {corners}");
            self.fault(&BEAMS, format!("{at}.corners"), message, "leave it out: 12 corners do in most cases");
        } else if profile.corners.is_some() && !profile.is_circular() {
            let help = "leave it out: only `round` and `tube` are touched by a polygon";
            self.fault(&BEAMS, format!("{at}.corners"), format!("the shape `{shape}` has no `corners` to choose"), help);
        }
        let range = if profile.is_circular() { 4..=64 } else { 2..=10 };
        if profile.shape != GIVEN && !range.contains(&profile.fibres()) {
            let message = format!("`{shape}` has {} to {} points, not {}", range.start(), range.end(), profile.fibres());
            self.fault(&BEAMS, format!("{at}.points"), message, "leave it out: the default does in most cases");
        }
    }
}

/// Keys in a message.
fn listed(keys: &[&str]) -> String {
    keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
}
