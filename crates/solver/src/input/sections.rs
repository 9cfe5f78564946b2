//! Every section of the model file, found by name or path, and what registries add: names to choose from,
//! and the keys of materials.
//!
//! A section is described beside the struct of its values, in `model`; that of materials is here, since its
//! keys are those of laws, equations of state and failure criteria.

use crate::contact::{formulation, law, search};
use crate::failure::CRITERIA;
use crate::model::values::Datum;
use crate::model::{
    CAVITY, CHANNEL, CONSTRAINT, CONTACT, CURVE, CUT, FLOW, JOIN, JOINT, LOAD, Material, NON_REFLECTING, OBSTACLE, OUTPUT, PART,
    POINT_MASS, PROBE, RELOCATE, REMESH, RUN, SPRING, STAGE, SYMMETRY, Values, WELD,
};
use crate::quantity::Parameter;
use crate::stress_state::STRESS_STATES;
use crate::vocabulary::Kind::{Angle, Choice, Flag, Quantities, Quantity, Table, Text};
use crate::vocabulary::Need::{self, Optional, Required};
use crate::vocabulary::{Choices, Form, Key, More, Rule, Section, key};
use crate::{element, material, output};

/// Largest number of elements of a model.
pub const ELEMENTS_MAX: u128 = 100_000_000;

/// Keys outside all sections.
pub static TOP: Section = Section {
    name: "",
    doc: "Keys that stand above all sections.",
    form: Form::Single,
    keys: &[key("title", Text, Optional("the model's name"), "Title for pictures and reports.")],
    ..Section::EMPTY
};

/// Every section, in the order of the documentation.
pub static SECTIONS: &[&Section] = &[
    &RUN,
    &STAGE,
    &MATERIAL,
    &PART,
    &CONTACT,
    &OBSTACLE,
    &REMESH,
    &RELOCATE,
    &FLOW,
    &SYMMETRY,
    &CONSTRAINT,
    &JOIN,
    &WELD,
    &JOINT,
    &LOAD,
    &CAVITY,
    &NON_REFLECTING,
    &SPRING,
    &POINT_MASS,
    &CURVE,
    &PROBE,
    &CUT,
    &CHANNEL,
    &OUTPUT,
];

/// Keys that people know from elsewhere or from before, and what stands for them now.
pub static MOVED: &[(&str, &str)] = &[("wall", "walls are obstacles now: [[obstacle]] with plane = { point, normal }")];

static MATERIAL: Section = Section {
    name: "material",
    doc: "A material: a law and its parameters, or a material of the library by `from`, of which any key can be given another value \
        here. Parts refer to it by its name.",
    form: Form::Named,
    required: true,
    keys: &[
        key(
            "from",
            Text,
            Optional("no other material"),
            "Name of a material of the library, as `embate list materials --library` shows them: the law and the keys are its own, but \
                for those that are given here.",
        ),
        key("law", Choice(Choices::Laws), Optional("that of `from`"), "Name of the law."),
        key("failure", Table(&FAILURE), Optional("nothing fails"), "When elements of this material fail: they are taken out of the model."),
        key(
            "eos",
            Choice(Choices::EquationsOfState),
            Optional("the law's own pressure"),
            "Equation of state: gives the pressure in place of the law, which keeps what is without volume. Not with \
                hyperelastic laws, nor where flow changes the volume (`drucker_prager`, `crushable_foam`); `null` \
                needs it.",
        ),
    ],
    rules: &[Rule::SomeOf(&["law", "from"])],
    more: &[More { by: "law", keys: law_keys }, More { by: "eos", keys: equation_keys }],
    ..Section::EMPTY
};

impl Material {
    /// From its table in the model file.
    #[must_use]
    pub fn read(values: &dyn Values) -> Self {
        let numbers = |it: &dyn Values| {
            let number = |(key, datum): (&String, &Datum)| if let Datum::Number(it) = datum { Some((key.clone(), *it)) } else { None };
            it.values().iter().filter_map(number).collect()
        };
        let list = |(key, datum): (&String, &Datum)| if let Datum::Numbers(it) = datum { Some((key.clone(), it.clone())) } else { None };
        Self {
            from: values.get("from"),
            law: values.get("law"),
            eos: values.get("eos"),
            parameters: numbers(values),
            lists: values.values().iter().filter_map(list).collect(),
            failure: values.table("failure").map(numbers).unwrap_or_default(),
        }
    }
}

static FAILURE: Section = Section {
    name: "failure",
    doc: "Limits at which an element fails. What counts is the mean over its points, as in the result files, after \
        every step; any one limit is enough. A failed element pulls no more, contact sees the surfaces behind it at \
        once, and its mass stays on its nodes.",
    keys: &FAILURE_KEYS,
    ..Section::EMPTY
};

/// One key per criterion of the registry.
const FAILURE_KEYS: [Key; CRITERIA.len()] = {
    let mut keys = [key("", Flag, Required, ""); CRITERIA.len()];
    let mut at = 0;
    while at < CRITERIA.len() {
        let Parameter { name, dimension, range, doc, .. } = CRITERIA[at].limit;
        keys[at] = key(name, Quantity(dimension, range), Optional("no limit"), doc);
        at += 1;
    }
    keys
};

impl Choices {
    /// The names.
    #[must_use]
    pub fn names(self) -> Vec<&'static str> {
        match self {
            Self::Words(words) => words.to_vec(),
            Self::Listed(list) => list(),
            Self::Laws => material::registry().iter().map(|kind| kind.name).collect(),
            Self::EquationsOfState => material::eos::EQUATIONS.iter().map(|kind| kind.name).collect(),
            // A part of triangles alone may name theirs as its element.
            Self::Elements => {
                let known = element::registry().into_iter().filter(|kind| !kind.is_triangle() || kind.cell.has_middles());
                known.map(|kind| kind.name).collect()
            }
            Self::Triangles => element::registry().iter().filter(|kind| kind.is_triangle()).map(|kind| kind.name).collect(),
            Self::StressStates => STRESS_STATES.iter().map(|kind| kind.name).collect(),
            Self::ContactLaws => law::LAWS.iter().map(|kind| kind.name).collect(),
            Self::Formulations => formulation::FORMULATIONS.iter().map(|kind| kind.name).collect(),
            Self::Searches => search::registry::<2>().iter().map(|kind| kind.name).collect(),
            Self::Fields => output::FIELDS.iter().map(|kind| kind.name).collect(),
        }
    }
}

/// The keys of a law's parameters.
fn law_keys(law: &str) -> Option<Vec<Key>> {
    Some(parameter_keys(material::registry().into_iter().find(|kind| kind.name == law)?.parameters))
}

/// The keys of the parameters of an equation of state.
fn equation_keys(name: &str) -> Option<Vec<Key>> {
    let mut keys = parameter_keys(material::eos::kind(name)?.parameters);
    let Parameter { name, dimension, range, doc, .. } = material::eos::TENSION;
    keys.push(key(name, Quantity(dimension, range), Optional("no limit"), doc));
    Some(keys)
}

fn parameter_keys(parameters: &[Parameter]) -> Vec<Key> {
    let need = |default: Option<f64>| default.map_or(Required, Need::Value);
    let kind_of = |p: &Parameter| match (p.list, p.is_angle) {
        (1.., _) => Quantities(p.dimension, p.range, 1),
        (0, true) => Angle(p.dimension, p.range),
        (0, false) => Quantity(p.dimension, p.range),
    };
    let need_of = |p: &Parameter| if p.list > 0 && p.default.is_some() { Optional("none") } else { need(p.default) };
    parameters.iter().map(|p| Key { example: p.example, ..key(p.name, kind_of(p), need_of(p), p.doc) }).collect()
}

/// The section of this name.
#[must_use]
pub fn section(name: &str) -> Option<&'static Section> {
    SECTIONS.iter().copied().find(|section| section.name == name)
}

/// The key at a path such as `part[0].ring.inner` or `run.end`; indices are ignored. Parameters of materials
/// are not found here.
#[must_use]
pub fn find(path: &str) -> Option<&'static Key> {
    let mut steps = path.split('.').map(|step| step.split('[').next().unwrap_or(step));
    let first = steps.next()?;
    let Some(mut here) = section(first) else { return TOP.all_keys().find(|key| key.name == first) };
    loop {
        let name = steps.next()?;
        let key = here.all_keys().find(|key| key.name == name)?;
        match (key.kind.inner(), steps.clone().next()) {
            (Some(inner), Some(_)) => here = inner,
            _ => return Some(key),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vocabulary::Rule;

    #[test]
    fn a_path_finds_its_key() {
        assert_eq!(find("part[3].ring.inner").map(|key| key.name), Some("inner"));
        assert_eq!(find("part[3].rectangle.size[1]").map(|key| key.name), Some("size"));
        assert_eq!(find("run.end").map(|key| key.name), Some("end"));
        assert_eq!(find("constraint[0].velocity.x").map(|key| key.name), Some("velocity"));
        assert_eq!(find("title").map(|key| key.name), Some("title"));
        assert!(find("run.nothing").is_none() && find("").is_none() && find("part").is_none());
    }

    #[test]
    fn every_section_and_key_explains_itself_and_is_unique() {
        let mut all: Vec<&Section> = SECTIONS.to_vec();
        all.push(&TOP);
        for section in &mut all.clone() {
            all.extend(section.all_keys().filter_map(|key| key.kind.inner()));
        }
        for section in all {
            assert!(section.doc.ends_with('.'), "{}", section.name);
            assert!(section.groups.iter().all(|group| group.doc.ends_with('.')), "{}", section.name);
            let mut names: Vec<&str> = section.all_keys().map(|key| key.name).collect();
            assert!(section.all_keys().all(|key| key.doc.ends_with('.')), "{}", section.name);
            for rule in section.all_rules() {
                let own: Vec<&str> = match rule {
                    Rule::OneOf(names) | Rule::SomeOf(names) => names.to_vec(),
                    Rule::NotBoth(a, b) | Rule::Needs(a, b) => vec![a, b],
                    Rule::Only { keys, by, .. } | Rule::With { by, keys, .. } => keys.iter().chain([by]).copied().collect(),
                };
                assert!(own.iter().all(|name| names.contains(name)), "{}: {rule:?}", section.name);
            }
            let count = names.len();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), count, "{} has a key twice", section.name);
        }
    }
}
