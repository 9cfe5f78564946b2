//! Every section and key of the model file, described once: name, kind of value, range, default, one line of explanation.
//!
//! Data comes from this file and from the registries of materials, elements and searches; the reader, the range checks, "did you mean",
//! the JSON schema and the tables of `docs/model-file.md` are made from it by iteration. A new key is one line here and its use
//! in the builder of `embate-files`.

use super::reference::excerpt;
use crate::quantity::{Dimension, Range};
use crate::{contact, element, material, output};

/// A table of the model file.
#[derive(Debug)]
pub struct Section {
    /// Key in the file.
    pub name: &'static str,
    /// What it describes, one or two sentences.
    pub doc: &'static str,
    /// How it is written.
    pub form: Form,
    /// Whether a model can't be without it.
    pub required: bool,
    /// Its keys, in the order of the documentation.
    pub keys: &'static [Key],
    /// What must hold between its keys.
    pub rules: &'static [Rule],
    /// More keys that depend on the value of one key.
    pub more: Option<More>,
}

/// How a section is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `[name]`, at most once.
    Single,
    /// `[[name]]`, any number of times.
    Repeated,
    /// `[name.NAME]`, any number of times with different names.
    Named,
    /// `key = { ... }` inside another section.
    Inline,
}

/// A key of a section.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Name in the file.
    pub name: &'static str,
    /// What its value may be.
    pub kind: Kind,
    /// Whether it may be left out.
    pub need: Need,
    /// One line: what it is.
    pub doc: &'static str,
}

/// Names that a key's value is chosen from.
pub type Choices = fn() -> Vec<&'static str>;

/// What a value may be.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number in SI units or a string with a unit.
    Quantity(Dimension, Range),
    /// An angle: radians, or a string such as `"30 deg"`.
    Angle(Range),
    /// Two quantities, x and y.
    Vector(Dimension, Range),
    /// A table with `x`, `y` or both.
    Components(Dimension, Range),
    /// A contact stiffness: per node and depth (Pa = N/m/m) or a pressure per depth (Pa/m).
    Stiffness(Range),
    /// A whole number that is not less than the minimum.
    Integer(u64),
    /// So many whole numbers that are not less than the minimum.
    Integers(usize, u64),
    /// How often: a count (whole number) or a time.
    Cadence,
    /// `true` or `false`.
    Flag,
    /// Any text.
    Text,
    /// The name of this thing: letters, digits, `_` and `-`.
    Name,
    /// The name of something else in the model.
    Reference,
    /// Names of other things: a list (a single name needs no list), of exactly this length if given.
    References(Option<usize>),
    /// One of these names.
    Choice(Choices),
    /// Some of these names: a list (a single name needs no list).
    Choices(Choices),
    /// A table of its own.
    Table(&'static Section),
}

/// Whether a key may be left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Need {
    /// It must be there.
    Required,
    /// It may be left out; the text says what happens then.
    Optional(&'static str),
    /// Left out it has this value, written as in the file.
    Default(&'static str),
    /// Left out it has this value, SI.
    Value(f64),
}

/// What must hold between the keys of a section.
#[derive(Clone, Copy, Debug)]
pub enum Rule {
    /// Exactly one of these keys.
    OneOf(&'static [&'static str]),
    /// At least one of these keys.
    SomeOf(&'static [&'static str]),
    /// Not both of these keys.
    NotBoth(&'static str, &'static str),
    /// The first key needs the second.
    Needs(&'static str, &'static str),
}

/// Keys that depend on the value of one key of the section.
#[derive(Clone, Copy, Debug)]
pub struct More {
    /// The key.
    pub by: &'static str,
    /// The further keys for one of its values; `None` for an unknown value.
    pub keys: fn(&str) -> Option<Vec<Key>>,
}

const fn key(name: &'static str, kind: Kind, need: Need, doc: &'static str) -> Key {
    Key { name, kind, need, doc }
}

use Kind::{Angle, Choice, Components, Flag, Integer, Integers, Name, Quantity, Reference, References, Stiffness, Table, Text, Vector};
use Need::{Default, Optional, Required};
use Range::{Finite, Positive, UpTo};

/// Largest number of elements of a model.
pub const ELEMENTS_MAX: u128 = 100_000_000;

/// Keys outside all sections.
pub static TOP: Section = Section {
    name: "",
    doc: "Keys that stand above all sections.",
    form: Form::Single,
    required: false,
    keys: &[key("title", Text, Optional("the model's name"), "Title for pictures and reports.")],
    rules: &[],
    more: None,
};

/// Every section, in the order of the documentation.
pub static SECTIONS: &[&Section] = &[&RUN, &MATERIAL, &PART, &CONTACT, &OBSTACLE, &SYMMETRY, &CONSTRAINT, &LOAD, &PROBE, &OUTPUT];

static RUN: Section = Section {
    name: "run",
    doc: "How long the simulation runs and what stops it.",
    form: Form::Single,
    required: true,
    keys: &[
        key("end", Quantity(Dimension::TIME, Positive), Required, "End time."),
        key("safety", Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.9"), "Fraction of the stable time step that is used."),
        key(
            "energy_limit",
            Quantity(Dimension::NONE, Positive),
            Default("0.05"),
            "Energy drift at which the run stops, as a fraction of the largest total energy.",
        ),
        key(
            "step_limit",
            Quantity(Dimension::TIME, Positive),
            Optional("a thousandth of the first stable step"),
            "Time step below which the run stops.",
        ),
        key("max_steps", Integer(1), Optional("no limit"), "Largest number of steps."),
    ],
    rules: &[],
    more: None,
};

static MATERIAL: Section = Section {
    name: "material",
    doc: "A material: a law and its parameters. Parts refer to it by its name.",
    form: Form::Named,
    required: true,
    keys: &[key("law", Choice(laws), Required, "Name of the law.")],
    rules: &[],
    more: Some(More { by: "law", keys: law_keys }),
};

static PART: Section = Section {
    name: "part",
    doc: "A body of one material and one kind of element. Exactly one of `rectangle`, `ring`, `disk` and `mesh` says where its elements come from.",
    form: Form::Repeated,
    required: true,
    keys: &[
        key("name", Name, Required, "Unique name."),
        key("material", Reference, Required, "Name of a `[material.NAME]` section."),
        key("element", Choice(elements), Default("\"quad4\""), "Kind of element."),
        key("velocity", Vector(Dimension::VELOCITY, Finite), Default("[0, 0]"), "Initial velocity."),
        key("rectangle", Table(&RECTANGLE), Optional("another shape"), "An axis-parallel rectangle."),
        key("ring", Table(&RING), Optional("another shape"), "A ring or a sector of one."),
        key("disk", Table(&DISK), Optional("another shape"), "A full disk."),
        key("mesh", Table(&MESH), Optional("another shape"), "A group of a mesh file."),
    ],
    rules: &[Rule::OneOf(&["rectangle", "ring", "disk", "mesh"])],
    more: None,
};

static RECTANGLE: Section = Section {
    name: "rectangle",
    doc: "An axis-parallel rectangle; its sides are `left`, `right`, `bottom` and `top`.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("corner", Vector(Dimension::LENGTH, Finite), Required, "Lower left corner."),
        key("size", Vector(Dimension::LENGTH, Positive), Required, "Width and height."),
        key("elements", Integers(2, 1), Required, "Elements along x and along y."),
    ],
    rules: &[],
    more: None,
};

static RING: Section = Section {
    name: "ring",
    doc: "A ring, or a sector of one, counter-clockwise from `from` to `to`; its sides are `inner` and `outer` and, for a sector, `start` and `end`.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("centre", Vector(Dimension::LENGTH, Finite), Required, "Centre."),
        key("inner", Quantity(Dimension::LENGTH, Positive), Required, "Inner radius."),
        key("outer", Quantity(Dimension::LENGTH, Positive), Required, "Outer radius."),
        key("from", Angle(Finite), Default("0"), "Angle at which it begins, counter-clockwise from the x axis."),
        key("to", Angle(Finite), Default("\"360 deg\""), "Angle at which it ends: more than `from`, by at most a full turn."),
        key("elements", Integers(2, 1), Required, "Elements through the wall and around."),
    ],
    rules: &[],
    more: None,
};

static DISK: Section = Section {
    name: "disk",
    doc: "A full disk; its side is `outer`.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("centre", Vector(Dimension::LENGTH, Finite), Required, "Centre."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key("elements", Integer(1), Required, "Elements around a quarter of the circumference."),
    ],
    rules: &[],
    more: None,
};

static MESH: Section = Section {
    name: "mesh",
    doc: "A group of a mesh file (Gmsh `.msh` 2.2 or 4.1). Its other groups can be named in contacts, constraints and probes.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("file", Text, Required, "Path of the file, from the model file's folder."),
        key("group", Text, Required, "Name of a two-dimensional physical group."),
        key("scale", Quantity(Dimension::LENGTH, Positive), Default("\"1 m\""), "Length of one unit of the file."),
    ],
    rules: &[],
    more: None,
};

static CONTACT: Section = Section {
    name: "contact",
    doc: "Two surfaces that can't go through each other. A surface is a part (its whole outside), a side such as `plate.top`, or a line group of a mesh file.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("name", Name, Optional("the two surfaces' names joined by `-`"), "Unique name."),
        key("between", References(Some(2)), Required, "The two surfaces."),
        key(
            "formulation",
            Choice(|| vec!["double_pass", "single_pass"]),
            Default("\"double_pass\""),
            "Whether the nodes of both surfaces are checked, or only those of `slave`.",
        ),
        key("slave", Reference, Optional("needed for, and only for, `single_pass`"), "The surface of `between` whose nodes are checked."),
        key(
            "penalty",
            Stiffness(Positive),
            Optional("automatic, from the elements under the surfaces"),
            "Stiffness per node and depth (N/m/m, also meant by a bare number), or pressure per penetration (Pa/m).",
        ),
        key("penalty_scale", Quantity(Dimension::NONE, Positive), Optional("1"), "Factor on the automatic penalty."),
        key("search", Choice(searches), Optional("`grid`"), "How near pairs are found; changes no result."),
    ],
    rules: &[Rule::NotBoth("penalty", "penalty_scale")],
    more: None,
};

static OBSTACLE: Section = Section {
    name: "obstacle",
    doc: "A rigid body without elements that some parts can't cross.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("name", Name, Optional("`obstacle`, `obstacle2`, ..."), "Unique name."),
        key("parts", References(None), Optional("all parts"), "Parts that it stops."),
        key("plane", Table(&PLANE), Required, "A straight line."),
        key(
            "penalty",
            Stiffness(Positive),
            Optional("automatic, from the elements under the surfaces"),
            "Stiffness per node and depth (N/m/m, also meant by a bare number), or pressure per penetration (Pa/m).",
        ),
        key("penalty_scale", Quantity(Dimension::NONE, Positive), Optional("1"), "Factor on the automatic penalty."),
    ],
    rules: &[Rule::NotBoth("penalty", "penalty_scale")],
    more: None,
};

static PLANE: Section = Section {
    name: "plane",
    doc: "A straight line.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("point", Vector(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line."),
        key("normal", Vector(Dimension::NONE, Finite), Required, "Normal that points to the free side; any length but zero."),
    ],
    rules: &[],
    more: None,
};

static SYMMETRY: Section = Section {
    name: "symmetry",
    doc: "A line of symmetry: nodes that lie on it at the start stay on it.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("normal", Vector(Dimension::NONE, Finite), Required, "Normal of the line; any length but zero."),
        key("point", Vector(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line."),
        key("parts", References(None), Optional("all parts"), "Parts that it holds."),
    ],
    rules: &[],
    more: None,
};

static CONSTRAINT: Section = Section {
    name: "constraint",
    doc: "Prescribed motion of a set of nodes: a part, a side such as `plate.left`, or a group of a mesh file.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("on", Reference, Required, "The set."),
        key("fixed", Kind::Choices(|| vec!["x", "y"]), Optional("none"), "Components that don't move."),
        key(
            "velocity",
            Components(Dimension::VELOCITY, Finite),
            Optional("none"),
            "Prescribed velocity of components, such as `{ x = \"1 m/s\" }`.",
        ),
    ],
    rules: &[Rule::SomeOf(&["fixed", "velocity"])],
    more: None,
};

static LOAD: Section = Section {
    name: "load",
    doc: "A load on some parts.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("gravity", Vector(Dimension::ACCELERATION, Finite), Required, "Uniform acceleration, such as `[0, \"-9.81 m/s^2\"]`."),
        key("parts", References(None), Optional("all parts"), "Parts that it acts on."),
    ],
    rules: &[],
    more: None,
};

static PROBE: Section = Section {
    name: "probe",
    doc: "A place whose position and velocity are written to the history as `NAME.x`, `NAME.y`, `NAME.vx`, `NAME.vy`: the node of `part` nearest to `point`, node number `node` of `part`, or the mean over `set`.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("name", Name, Required, "Unique name."),
        key("part", Reference, Optional("only with `set`"), "Part of `point` or `node`."),
        key("point", Vector(Dimension::LENGTH, Finite), Optional("`node` or `set`"), "Initial position; the nearest node is taken."),
        key("node", Integer(0), Optional("`point` or `set`"), "Number of the node in its part, from 0."),
        key("set", Reference, Optional("`point` or `node`"), "A part, a side such as `plate.top`, or a group of a mesh file."),
    ],
    rules: &[
        Rule::OneOf(&["point", "node", "set"]),
        Rule::Needs("point", "part"),
        Rule::Needs("node", "part"),
        Rule::NotBoth("set", "part"),
    ],
    more: None,
};

static OUTPUT: Section = Section {
    name: "output",
    doc: "What is written.",
    form: Form::Single,
    required: false,
    keys: &[
        key("fields", Kind::Cadence, Default("100"), "How often the fields are written: a count, or an interval such as `\"0.1 ms\"`."),
        key("history", Kind::Cadence, Default("1000"), "How often a row of the history is written: a count or an interval."),
        key("include", Kind::Choices(fields), Optional("all"), "Fields to write."),
        key(
            "mirror",
            Kind::Choices(|| vec!["x", "y"]),
            Optional("none"),
            "Pictures also show the model mirrored at the line x = 0 (`\"x\"`), y = 0 (`\"y\"`), or both.",
        ),
        key("pictures", Flag, Default("true"), "Whether pictures and the animation are made."),
        key("picture_field", Choice(fields), Optional("what suits the model"), "Field that colours the pictures."),
    ],
    rules: &[],
    more: None,
};

fn laws() -> Vec<&'static str> {
    material::registry().iter().map(|kind| kind.name).collect()
}

fn elements() -> Vec<&'static str> {
    element::registry().iter().map(|kind| kind.name).collect()
}

fn searches() -> Vec<&'static str> {
    contact::search::registry::<2>().iter().map(|kind| kind.name).collect()
}

fn fields() -> Vec<&'static str> {
    output::FIELDS.iter().map(|kind| kind.name).collect()
}

/// The keys of a law's parameters.
fn law_keys(law: &str) -> Option<Vec<Key>> {
    let kind = material::registry().into_iter().find(|kind| kind.name == law)?;
    let need = |default: Option<f64>| default.map_or(Required, Need::Value);
    Some(kind.parameters.iter().map(|p| key(p.name, Quantity(p.dimension, p.range), need(p.default), p.doc)).collect())
}

/// The section of this name.
#[must_use]
pub fn section(name: &str) -> Option<&'static Section> {
    SECTIONS.iter().copied().find(|section| section.name == name)
}

/// The key at a path such as `part[0].ring.inner` or `run.end`; indices are ignored. Parameters of materials are not found here.
#[must_use]
pub fn find(path: &str) -> Option<&'static Key> {
    let mut steps = path.split('.').map(|step| step.split('[').next().unwrap_or(step));
    let first = steps.next()?;
    let Some(mut here) = section(first) else { return TOP.keys.iter().find(|key| key.name == first) };
    loop {
        let name = steps.next()?;
        let key = here.keys.iter().find(|key| key.name == name)?;
        match (key.kind, steps.clone().next()) {
            (Table(inner), Some(_)) => here = inner,
            _ => return Some(key),
        }
    }
}

impl Key {
    /// The range of its numbers; `None` where it has no numbers or only whole ones.
    #[must_use]
    pub fn range(&self) -> Option<(Dimension, Range)> {
        match self.kind {
            Quantity(dimension, range) | Vector(dimension, range) | Components(dimension, range) => Some((dimension, range)),
            Angle(range) => Some((Dimension::NONE, range)),
            Stiffness(range) => Some((Dimension::PRESSURE, range)),
            Kind::Cadence => Some((Dimension::TIME, Positive)),
            _ => None,
        }
    }
}

/// What is wrong with a number outside its range, and what to do: `(message, help)`. `shown` is the value as the user wrote it.
#[must_use]
pub fn out_of_range(name: &str, shown: &str, value: f64, range: Range) -> (String, String) {
    if value.is_nan() {
        return (format!("`{name}` is not a number"), format!("give a number that is {range}"));
    }
    if value.is_infinite() {
        return (format!("`{name}` is not finite, but {shown}"), format!("give a number that is {range}"));
    }
    (format!("`{name}` must be {range}, but it is {shown}"), String::new())
}

/// The name nearest to `name`: "did you mean". `None` when nothing is near.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.is_empty() || name.len() > 64 {
        return None;
    }
    let lower = name.to_lowercase();
    let distance = |other: &str| (strsim::damerau_levenshtein(&lower, &other.to_lowercase()), strsim::damerau_levenshtein(name, other));
    let limit = (name.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|other| (distance(other), other))
        .filter(|((d, _), _)| *d <= limit)
        .min_by_key(|(d, _)| *d)
        .map(|(_, other)| other)
}

/// Help for an unknown name: the nearest one, or all that there are.
#[must_use]
pub fn suggestion(name: &str, known: &[&str]) -> String {
    if let Some(near) = nearest(name, known.iter().copied()) {
        return format!("did you mean `{near}`?");
    }
    let mut all: Vec<String> = Vec::new();
    for name in known.iter().map(|name| excerpt(name)) {
        if !name.is_empty() && !all.contains(&name) && all.len() < 100 {
            all.push(name);
        }
    }
    let known = all;
    match known.as_slice() {
        [] => "there is none".to_string(),
        [one] => format!("there is only `{one}`"),
        _ => {
            let shown: Vec<_> = known.iter().take(12).map(|name| format!("`{name}`")).collect();
            let rest = if known.len() > 12 { format!(" and {} more", known.len() - 12) } else { String::new() };
            format!("known are {}{rest}", shown.join(", "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            all.extend(section.keys.iter().filter_map(|key| if let Table(inner) = key.kind { Some(inner) } else { None }));
        }
        for section in all {
            assert!(section.doc.ends_with('.'), "{}", section.name);
            for (index, key) in section.keys.iter().enumerate() {
                assert!(key.doc.ends_with('.'), "{}.{}", section.name, key.name);
                assert!(section.keys[..index].iter().all(|other| other.name != key.name), "{}.{}", section.name, key.name);
            }
            for rule in section.rules {
                let names: Vec<&str> = match rule {
                    Rule::OneOf(names) | Rule::SomeOf(names) => names.to_vec(),
                    Rule::NotBoth(a, b) | Rule::Needs(a, b) => vec![a, b],
                };
                assert!(names.iter().all(|name| section.keys.iter().any(|key| key.name == *name)), "{}", section.name);
            }
        }
    }

    #[test]
    fn a_near_name_is_suggested_and_a_far_one_is_not() {
        assert_eq!(nearest("velocty", ["name", "velocity"]), Some("velocity"));
        assert_eq!(nearest("Young", ["young", "yield"]), Some("young"));
        assert_eq!(nearest("abc", ["xyz"]), None);
    }
}
