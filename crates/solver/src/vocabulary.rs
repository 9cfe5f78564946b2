//! The types that describe the model file (sections, keys, kinds of values, ranges, rules), and the messages
//! about wrong names and numbers.
//!
//! A section is described beside the struct of its values, in `model`; a shape beside its mesh. The reader,
//! the range checks, "did you mean", the JSON schema and the tables of `docs/model-file.md` are made from the
//! descriptions by iteration.

use crate::quantity::{Dimension, Range};

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
    /// Its own keys, in the order of the documentation.
    pub keys: &'static [Key],
    /// Keys that it shares with other sections.
    pub groups: &'static [&'static Group],
    /// What must hold between its own keys.
    pub rules: &'static [Rule],
    /// More keys that depend on the value of one key each.
    pub more: &'static [More],
}

/// Keys that several sections have.
#[derive(Debug)]
pub struct Group {
    /// What they are about, for the documentation.
    pub title: &'static str,
    /// What they describe, one or two sentences.
    pub doc: &'static str,
    /// The keys.
    pub keys: &'static [Key],
    /// What must hold between them.
    pub rules: &'static [Rule],
}

impl Section {
    /// An optional inline table without anything in it, to build on.
    pub const EMPTY: Self = Self { name: "", doc: "", form: Form::Inline, required: false, keys: &[], groups: &[], rules: &[], more: &[] };

    /// Its own keys and those that it shares.
    pub fn all_keys(&self) -> impl Iterator<Item = &'static Key> + use<> {
        self.keys.iter().chain(self.groups.iter().flat_map(|group| group.keys))
    }

    /// What must hold between its keys.
    pub fn all_rules(&self) -> impl Iterator<Item = &'static Rule> + use<> {
        self.rules.iter().chain(self.groups.iter().flat_map(|group| group.rules))
    }
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
    /// A number as people write it, for messages; empty: what is usual for its kind.
    pub example: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
}

/// Names that a key's value is chosen from: words, or the names of a registry, which `input` knows
/// ([`Choices::names`]).
#[derive(Clone, Copy, Debug)]
pub enum Choices {
    /// These words.
    Words(&'static [&'static str]),
    /// What this function lists.
    Listed(fn() -> Vec<&'static str>),
    /// Laws of materials.
    Laws,
    /// Equations of state.
    EquationsOfState,
    /// Elements for cells that are no triangles.
    Elements,
    /// Elements for triangles.
    Triangles,
    /// Stress states.
    StressStates,
    /// Laws of contacts.
    ContactLaws,
    /// Formulations of contacts.
    Formulations,
    /// Searches of contacts.
    Searches,
    /// Fields of the output.
    Fields,
}

/// What a value may be.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number in SI units or a string with a unit.
    Quantity(Dimension, Range),
    /// An angle or an angular velocity: radians, or a string such as `"30 deg"`.
    Angle(Dimension, Range),
    /// Two quantities, x and y.
    Vector(Dimension, Range),
    /// A vector of the space that the model lies in: x and y, of solids z too (zero where it is left out).
    Spatial(Dimension, Range),
    /// A list of at least so many quantities.
    Quantities(Dimension, Range, usize),
    /// A quantity of whichever dimension.
    Value,
    /// A list of at least one quantity, all of one dimension, whichever it is.
    Values,
    /// A list of at least so many points.
    Points(usize),
    /// A list of such lists.
    Outlines(usize),
    /// A list of at least so many points in 3D (z is zero where it is left out).
    SpatialPoints(usize),
    /// A list of such lists.
    SpatialOutlines(usize),
    /// A quantity (angular velocity where it is a rate) or the name of a curve; also part of the next three.
    Drive(Dimension),
    /// A table with `x`, `y`, `z` or some of them: such quantities by component.
    Components(Dimension),
    /// A table with some of `x`, `y`, `z` and `rotation`: prescribed velocities, or `"free"`.
    Motion,
    /// `true`, `false`, or such a table.
    Rigid,
    /// A contact stiffness: per node in this dimension (with depth Pa = N/m/m, of solids N/m), or a pressure
    /// per depth (Pa/m).
    Stiffness(Dimension, Range),
    /// A mass per time, in this dimension (with depth kg/s/m, of whole bodies kg/s).
    MassFlow(Dimension, Range),
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
    /// A list of such tables.
    Tables(&'static Section),
}

impl Kind {
    /// The section of a table, or of the tables of a list.
    #[must_use]
    pub fn inner(&self) -> Option<&'static Section> {
        if let Self::Table(inner) | Self::Tables(inner) = self { Some(inner) } else { None }
    }
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
    /// These keys make sense only where another key has this value (a text or a flag).
    Only {
        /// The keys.
        keys: &'static [&'static str],
        /// The other key.
        by: &'static str,
        /// Its value.
        value: &'static str,
    },
    /// Where a key has this value, these keys must be there.
    With {
        /// The key.
        by: &'static str,
        /// Its value.
        value: &'static str,
        /// The keys that must be there.
        keys: &'static [&'static str],
    },
}

/// Keys that depend on the value of one key of the section.
#[derive(Clone, Copy, Debug)]
pub struct More {
    /// The key.
    pub by: &'static str,
    /// The further keys for one of its values; `None` for an unknown value.
    pub keys: fn(&str) -> Option<Vec<Key>>,
}

pub(crate) const fn key(name: &'static str, kind: Kind, need: Need, doc: &'static str) -> Key {
    Key { name, kind, need, example: "", doc }
}

impl Key {
    /// The range of its numbers; `None` where it has no numbers or only whole ones.
    #[must_use]
    pub fn range(&self) -> Option<(Dimension, Range)> {
        match self.kind {
            Kind::Quantity(dimension, range)
            | Kind::Angle(dimension, range)
            | Kind::MassFlow(dimension, range)
            | Kind::Vector(dimension, range)
            | Kind::Spatial(dimension, range)
            | Kind::Quantities(dimension, range, _) => Some((dimension, range)),
            Kind::Drive(dimension) | Kind::Components(dimension) => Some((dimension, Range::Finite)),
            Kind::Points(_) | Kind::Outlines(_) | Kind::SpatialPoints(_) | Kind::SpatialOutlines(_) => {
                Some((Dimension::LENGTH, Range::Finite))
            }
            Kind::Stiffness(dimension, range) => Some((dimension, range)),
            Kind::Cadence => Some((Dimension::TIME, Range::Positive)),
            Kind::Value
            | Kind::Values
            | Kind::Motion
            | Kind::Rigid
            | Kind::Integer(_)
            | Kind::Integers(..)
            | Kind::Flag
            | Kind::Text
            | Kind::Name
            | Kind::Reference
            | Kind::References(_)
            | Kind::Choice(_)
            | Kind::Choices(_)
            | Kind::Table(_)
            | Kind::Tables(_) => None,
        }
    }
}

/// Keys whose numbers have a bound for a reason that is worth saying: key, lower bound, reason.
const SENSE: &[(&str, f64, &str)] = &[
    (
        "friction",
        0.0,
        "friction acts against the sliding: below 0 it would drive it, and the contact would make energy; 0 is a smooth surface",
    ),
    ("thickness", 0.0, "it is the distance that the surfaces keep: below 0 they would go through each other"),
];

/// What is wrong with a number outside its range, and what to do: `(message, help)`. `shown` is the value as
/// the user wrote it.
#[must_use]
pub fn out_of_range(name: &str, shown: &str, value: f64, range: &str) -> (String, String) {
    if value.is_nan() {
        return (format!("`{name}` is not a number"), format!("give a number that is {range}"));
    }
    if value.is_infinite() {
        return (format!("`{name}` is not finite, but {shown}"), format!("give a number that is {range}"));
    }
    let reason = SENSE.iter().find(|(key, low, _)| *key == name && value < *low).map_or("", |(.., reason)| reason);
    (format!("`{name}` must be {range}, but it is {shown}"), reason.to_string())
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

/// A user's text, cut for a message.
pub(crate) fn excerpt(text: &str) -> String {
    let mut shown: String = text.chars().take(60).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(60).is_some() {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_near_name_is_suggested_and_a_far_one_is_not() {
        assert_eq!(nearest("velocty", ["name", "velocity"]), Some("velocity"));
        assert_eq!(nearest("Young", ["young", "yield"]), Some("young"));
        assert_eq!(nearest("abc", ["xyz"]), None);
    }
}
