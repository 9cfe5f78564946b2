//! Reads one value as its key's kind says: type, unit, range, choice.
//!
//! Nodes come from `tree.rs` through `reader.rs`; typed values in SI units, or what is wrong with them, go
//! back to it. Each kind of value is one arm of `read`, one of `example`, and one of `words`.

use super::tree::{Node, Place, Value};
use super::units::{self, Wanted};
use crate::model_file::messages::{CHOICE, TYPE, UNIT, UNKNOWN_KEY};
use embate_solver::input::name_is_plain;
use embate_solver::message::Message;
use embate_solver::model::messages::{LIST_LENGTH, RANGE};
use embate_solver::model::values::{Course, Datum};
use embate_solver::model::{Cadence, Drive, Penalty};
use embate_solver::quantity::{Dimension, Range};
use embate_solver::vocabulary::{Key, Kind, out_of_range, suggestion};

/// What is wrong with a value or an item of it.
#[derive(Clone, Debug)]
pub(super) struct Wrong {
    pub kind: &'static Message,
    pub path: String,
    pub place: Place,
    pub texts: (String, String),
}

type Read<T> = Result<T, Vec<Wrong>>;

/// A node on its way through this file: its kind, the key for messages, path and place for faults.
#[derive(Clone, Copy)]
struct At<'a> {
    kind: Kind,
    key: &'a Key,
    node: &'a Node,
    path: &'a str,
}

impl<'a> At<'a> {
    /// The last step of the path: `inner`, `size[1]`.
    fn name(&self) -> &'a str {
        self.path.rsplit('.').next().unwrap_or(self.path)
    }

    fn wrong<T>(&self, kind: &'static Message, message: String, help: impl Into<String>) -> Read<T> {
        Err(vec![Wrong { kind, path: self.path.to_string(), place: self.node.place, texts: (message, help.into()) }])
    }

    /// The type is wrong.
    fn unlike<T>(&self) -> Read<T> {
        self.wrong(&TYPE, format!("`{}` must be {}, but it is {}", self.name(), words(self.kind), self.node.words()), like(self.key))
    }

    /// An item of this list or table.
    fn on<'b>(&self, node: &'b Node, path: &'b str) -> At<'b>
    where
        'a: 'b,
    {
        At { kind: item(self.kind), key: self.key, node, path }
    }

    /// Reads every item of a list; all faults together.
    fn each<T>(&self, items: &[Node], read: impl Fn(At<'_>) -> Read<T>) -> Read<Vec<T>> {
        let (mut values, mut wrongs) = (Vec::with_capacity(items.len()), Vec::new());
        for (index, node) in items.iter().enumerate() {
            match read(self.on(node, &format!("{}[{index}]", self.path))) {
                Ok(value) => values.push(value),
                Err(wrong) => wrongs.extend(wrong),
            }
        }
        if wrongs.is_empty() { Ok(values) } else { Err(wrongs) }
    }

    fn number(&self, dimensions: &[Dimension], range: Range, angle: bool) -> Read<(f64, Dimension)> {
        let usual = dimensions.first().copied().unwrap_or(Dimension::NONE);
        let (value, dimension) = match &self.node.value {
            Value::Integer(_, _, value) | Value::Float(_, value) => (*value, usual),
            Value::Text(text) => match units::read(text, Wanted { name: self.name(), dimensions, angle }) {
                Ok(read) => read,
                Err((message, help)) => return self.wrong(&UNIT, message, help),
            },
            _ => return self.unlike(),
        };
        if range.contains(value) {
            return Ok((value, dimension));
        }
        let unit = if matches!(self.node.value, Value::Text(_)) { String::new() } else { format!(" {}", units::si(usual, angle)) };
        let shown = format!("{}{unit}", self.node.words().trim_matches('"'));
        let words = if angle && usual == Dimension::NONE { range.of_angle() } else { range.to_string() };
        let (message, help) = out_of_range(self.name(), shown.trim_end(), value, &words);
        self.wrong(&RANGE, message, help)
    }

    fn integer(&self, least: u64) -> Read<u64> {
        match &self.node.value {
            Value::Integer(text, value, _) => match value.map(u64::try_from) {
                Some(Ok(value)) if value >= least => Ok(value),
                Some(_) if value.is_some_and(|value| value < i128::from(least)) => {
                    self.wrong(&RANGE, format!("`{}` must be at least {least}, but it is {text}", self.name()), "")
                }
                _ => self.wrong(&RANGE, format!("`{}` is too large: {}", self.name(), self.node.words()), "give a smaller number"),
            },
            _ => self.unlike(),
        }
    }

    fn text(&self) -> Read<String> {
        if let Value::Text(text) = &self.node.value { Ok(text.clone()) } else { self.unlike() }
    }

    fn choice(&self, known: &[&'static str]) -> Read<String> {
        let text = self.text()?;
        if known.contains(&text.as_str()) {
            return Ok(text);
        }
        let message = format!("`{}` can't be {}", self.name(), units::shorten(&text));
        self.wrong(&CHOICE, message, suggestion(&text, known))
    }

    /// One text or a list of texts, each once.
    fn several(&self, read: impl Fn(At<'_>) -> Read<String>) -> Read<Vec<String>> {
        let Value::List(items) = &self.node.value else {
            return if matches!(self.node.value, Value::Text(_)) { Ok(vec![read(*self)?]) } else { self.unlike() };
        };
        if items.is_empty() {
            return self.wrong(&LIST_LENGTH, format!("the list `{}` is empty", self.name()), "name something, or leave the key out");
        }
        self.each(items, read)
    }

    /// A number of any dimension; `None` where it has no unit.
    fn value(&self) -> Read<(f64, Option<Dimension>)> {
        match &self.node.value {
            Value::Text(text) => match units::read(text, Wanted { name: self.name(), dimensions: &[], angle: true }) {
                Ok((value, dimension)) if value.is_finite() => Ok((value, Some(dimension))),
                Ok((value, _)) => {
                    let (message, help) = out_of_range(self.name(), text, value, &Range::Finite.to_string());
                    self.wrong(&RANGE, message, help)
                }
                Err((message, help)) => self.wrong(&UNIT, message, help),
            },
            _ => Ok((self.number(&[Dimension::NONE], Range::Finite, false)?.0, None)),
        }
    }

    /// Numbers whose dimension the first one with a unit decides.
    fn values(&self, items: &[Node]) -> Read<Datum> {
        let values = self.each(items, |at| at.value())?;
        let first = values.iter().enumerate().find_map(|(index, (_, dimension))| Some((index, (*dimension)?)));
        if let Some((first, wanted)) = first
            && let Some((index, other)) = values.iter().enumerate().find_map(|(i, (_, it))| Some((i, it.filter(|it| *it != wanted)?)))
        {
            let unit =
                |dimension: Dimension| if dimension == Dimension::NONE { "a pure number".to_string() } else { format!("in {dimension}") };
            let path = format!("{}[{index}]", self.path);
            let message = format!("`{0}[{index}]` is {1}, but `{0}[{first}]` is {2}", self.name(), unit(other), unit(wanted));
            return self.on(&items[index], &path).wrong(&UNIT, message, "give all values in one dimension");
        }
        Ok(Datum::Values(values.iter().map(|(value, _)| *value).collect(), first.map(|(_, dimension)| dimension)))
    }

    fn vector(&self, dimension: Dimension, range: Range) -> Read<[f64; 2]> {
        match &self.node.value {
            Value::List(items) if items.len() == 2 => {
                let values = self.each(items, |at| at.number(&[dimension], range, false))?;
                Ok([values[0].0, values[1].0])
            }
            _ => self.unlike(),
        }
    }

    /// Two or three numbers; a third that is left out is zero.
    fn spatial(&self, dimension: Dimension, range: Range) -> Read<[f64; 3]> {
        match &self.node.value {
            Value::List(items) if matches!(items.len(), 2 | 3) => {
                let values = self.each(items, |at| at.number(&[dimension], range, false))?;
                Ok(std::array::from_fn(|index| values.get(index).map_or(0.0, |value| value.0)))
            }
            _ => self.unlike(),
        }
    }

    /// The items of a list that has at least so many.
    fn list(&self, least: usize) -> Read<&'a [Node]> {
        let Value::List(items) = &self.node.value else { return self.unlike() };
        if items.len() < least {
            let message = format!("`{}` must be {}, but it has {}", self.name(), words(self.kind), items.len());
            return self.wrong(&LIST_LENGTH, message, like(self.key));
        }
        Ok(items)
    }

    fn points(&self, least: usize) -> Read<Vec<[f64; 2]>> {
        self.each(self.list(least)?, |at| at.vector(Dimension::LENGTH, Range::Finite))
    }

    fn spatial_points(&self, least: usize) -> Read<Vec<[f64; 3]>> {
        self.each(self.list(least)?, |at| at.spatial(Dimension::LENGTH, Range::Finite))
    }

    /// A velocity, the name of a curve, or `"free"`. A text that begins like a number is one.
    fn course(&self, dimension: Dimension, free: bool) -> Read<Course> {
        let like_a_number = |text: &str| text.is_empty() || text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
        match &self.node.value {
            Value::Text(text) if !like_a_number(text.trim()) => {
                if text == "free" {
                    if free {
                        return Ok(Course::Free);
                    }
                    return self.wrong(&CHOICE, format!("`{}` can't be \"free\" here", self.name()), "leave it out: it is free then");
                }
                if name_is_plain(text).is_ok() { Ok(Course::Driven(Drive::Curve(text.clone()))) } else { self.unlike() }
            }
            Value::Text(_) | Value::Integer(..) | Value::Float(..) => {
                let (value, _) = self.number(&[dimension], Range::Finite, dimension == Dimension::RATE)?;
                Ok(Course::Driven(Drive::Constant(value)))
            }
            _ => self.unlike(),
        }
    }

    /// A table of courses, one for each degree of freedom; along x and y of this dimension.
    fn courses(&self, axes: &[&str], straight: Dimension, free: bool) -> Read<Datum> {
        let Value::Table(entries) = &self.node.value else { return self.unlike() };
        let mut courses = [None, None, None, None];
        let mut wrongs = Vec::new();
        let quoted: Vec<String> = axes.iter().map(|axis| format!("`{axis}`")).collect();
        let help = format!("give {}, or some of them", quoted.join(", "));
        for entry in entries {
            let path = format!("{}.{}", self.path, entry.key);
            let Some(axis) = axes.iter().position(|axis| *axis == entry.key) else {
                let texts = (format!("`{}` has no component {}", self.name(), units::shorten(&entry.key)), help.clone());
                wrongs.push(Wrong { kind: &UNKNOWN_KEY, path, place: entry.place, texts });
                continue;
            };
            let dimension = if axis == 3 { Dimension::RATE } else { straight };
            match (At { kind: Kind::Drive(dimension), ..self.on(&entry.node, &path) }).course(dimension, free) {
                Ok(course) => courses[axis] = Some(course),
                Err(wrong) => wrongs.extend(wrong),
            }
        }
        if !wrongs.is_empty() {
            return Err(wrongs);
        }
        if entries.is_empty() {
            return self.wrong(&LIST_LENGTH, format!("`{}` has no component", self.name()), help);
        }
        Ok(Datum::Courses(courses))
    }
}

/// Reads a value; tables are read by the reader.
///
/// # Errors
/// Everything that is wrong with it.
pub(super) fn read(key: &Key, node: &Node, path: &str) -> Read<Datum> {
    let at = At { kind: key.kind, key, node, path };
    Ok(match key.kind {
        Kind::Quantity(dimension, range) | Kind::MassFlow(dimension, range) => Datum::Number(at.number(&[dimension], range, false)?.0),
        Kind::Angle(dimension, range) => Datum::Number(at.number(&[dimension], range, true)?.0),
        Kind::Vector(dimension, range) => Datum::Vector(at.vector(dimension, range)?),
        Kind::Spatial(dimension, range) => Datum::Spatial(at.spatial(dimension, range)?),
        Kind::Quantities(dimension, range, least) => {
            let values = at.each(at.list(least)?, |at| at.number(&[dimension], range, false))?;
            Datum::Numbers(values.into_iter().map(|(value, _)| value).collect())
        }
        Kind::Value => {
            let (value, dimension) = at.value()?;
            Datum::Values(vec![value], dimension)
        }
        Kind::Values => at.values(at.list(1)?)?,
        Kind::Points(least) => Datum::Points(at.points(least)?),
        Kind::Outlines(least) => Datum::Outlines(at.each(at.list(1)?, |at| at.points(least))?),
        // Of one list there is no key yet: it is an item of the next.
        Kind::SpatialPoints(least) => Datum::SpatialOutlines(vec![at.spatial_points(least)?]),
        Kind::SpatialOutlines(least) => Datum::SpatialOutlines(at.each(at.list(1)?, |at| at.spatial_points(least))?),
        Kind::Components(dimension) => at.courses(&["x", "y", "z"], dimension, false)?,
        Kind::Motion => at.courses(&["x", "y", "z", "rotation"], Dimension::VELOCITY, true)?,
        Kind::Rigid => match node.value {
            Value::Flag(flag) => Datum::Flag(flag),
            _ => at.courses(&["x", "y", "z", "rotation"], Dimension::VELOCITY, true)?,
        },
        Kind::Drive(dimension) => match at.course(dimension, false)? {
            Course::Driven(drive) => Datum::Drive(drive),
            Course::Free => return at.unlike(),
        },
        Kind::Stiffness(dimension, range) => match at.number(&[dimension, Dimension::PRESSURE_PER_LENGTH], range, false)? {
            (value, Dimension::PRESSURE_PER_LENGTH) => Datum::Penalty(Penalty::Pressure(value)),
            (value, _) => Datum::Penalty(Penalty::PerNode(value)),
        },
        Kind::Integer(least) => Datum::Integer(at.integer(least)?),
        Kind::Integers(count, least) => match &node.value {
            Value::List(items) if items.len() == count => Datum::Integers(at.each(items, |at| at.integer(least))?),
            _ => return at.unlike(),
        },
        Kind::Cadence => Datum::Cadence(match &node.value {
            Value::Integer(..) => Cadence::Count(at.integer(0)?),
            _ => Cadence::Interval(at.number(&[Dimension::TIME], Range::Positive, false)?.0),
        }),
        Kind::Flag => match node.value {
            Value::Flag(flag) => Datum::Flag(flag),
            _ => return at.unlike(),
        },
        Kind::Text | Kind::Name | Kind::Reference => Datum::Text(at.text()?),
        Kind::References(count) => {
            if let (Some(count), Value::List(items)) = (count, &node.value)
                && items.len() != count
            {
                return at.unlike();
            }
            if count.is_some() && matches!(node.value, Value::Text(_)) {
                return at.unlike();
            }
            Datum::Texts(at.several(|at| at.text())?)
        }
        Kind::Choice(known) => Datum::Text(at.choice(&known.names())?),
        Kind::Choices(known) => Datum::Texts(at.several(|at| at.choice(&known.names()))?),
        Kind::Table(_) | Kind::Tables(_) => return at.unlike(),
    })
}

/// The kind of the items of a list or table.
fn item(kind: Kind) -> Kind {
    match kind {
        Kind::Vector(dimension, range) | Kind::Spatial(dimension, range) | Kind::Quantities(dimension, range, _) => {
            Kind::Quantity(dimension, range)
        }
        Kind::Values => Kind::Quantity(Dimension::NONE, Range::Finite),
        Kind::Points(_) => Kind::Vector(Dimension::LENGTH, Range::Finite),
        Kind::Outlines(least) => Kind::Points(least),
        Kind::SpatialPoints(_) => Kind::Spatial(Dimension::LENGTH, Range::Finite),
        Kind::SpatialOutlines(least) => Kind::SpatialPoints(least),
        Kind::Integers(_, least) => Kind::Integer(least),
        Kind::References(_) => Kind::Reference,
        Kind::Choices(known) => Kind::Choice(known),
        other => other,
    }
}

/// What a value must be, in words.
pub(super) fn words(kind: Kind) -> String {
    let with_unit = |dimension: Dimension| match dimension {
        Dimension::NONE => "a number".to_string(),
        _ => format!("a number with a unit of {}", units::quantity(dimension)),
    };
    match kind {
        Kind::Quantity(dimension, _) => with_unit(dimension),
        Kind::Angle(Dimension::RATE, _) => "an angular velocity".to_string(),
        Kind::Angle(..) => "an angle".to_string(),
        Kind::Vector(Dimension::NONE, _) => "a list of 2 numbers".to_string(),
        Kind::Vector(dimension, _) => format!("a list of 2 numbers with a unit of {}", units::quantity(dimension)),
        Kind::Spatial(Dimension::NONE, _) => "a list of 2 numbers (3 in 3D)".to_string(),
        Kind::Spatial(dimension, _) => format!("a list of 2 numbers (3 in 3D) with a unit of {}", units::quantity(dimension)),
        Kind::Quantities(dimension, _, 1) => format!("a list of numbers with a unit of {}", units::quantity(dimension)),
        Kind::Quantities(dimension, _, least) => {
            format!("a list of at least {least} numbers with a unit of {}", units::quantity(dimension))
        }
        Kind::Value => "a number".to_string(),
        Kind::Values => "a list of numbers".to_string(),
        Kind::Points(least) | Kind::SpatialPoints(least) => format!("a list of at least {least} points"),
        Kind::Outlines(least) | Kind::SpatialOutlines(least) => format!("a list of lists of at least {least} points"),
        Kind::Drive(Dimension::RATE) => "an angular velocity or the name of a curve".to_string(),
        Kind::Drive(dimension) => {
            let quantity = units::quantity(dimension);
            let article = if quantity.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
            format!("{article} {quantity} or the name of a curve")
        }
        Kind::Components(_) => "a table with x, y, z or some of them".to_string(),
        Kind::Motion => "a table with x, y, z, rotation or some of them".to_string(),
        Kind::Rigid => "true, false, or a table with x, y, z, rotation or some of them".to_string(),
        Kind::Stiffness(..) => "a stiffness".to_string(),
        Kind::MassFlow(..) => "a mass per time".to_string(),
        Kind::Integer(_) => "a whole number".to_string(),
        Kind::Integers(count, _) => format!("a list of {count} whole numbers"),
        Kind::Cadence => "a whole number or a time".to_string(),
        Kind::Flag => "true or false".to_string(),
        Kind::Text => "a text".to_string(),
        Kind::Name | Kind::Reference | Kind::Choice(_) => "a name".to_string(),
        Kind::References(Some(count)) => format!("a list of {count} names"),
        Kind::References(None) | Kind::Choices(_) => "a name or a list of names".to_string(),
        Kind::Table(_) => "a table".to_string(),
        Kind::Tables(_) => "a list of tables".to_string(),
    }
}

/// A value as a person writes it, in TOML.
pub(super) fn example(key: &Key) -> String {
    let number = |dimension: Dimension| match dimension {
        Dimension::NONE => "0.3".to_string(),
        _ => format!("\"{}\"", units::example(dimension)),
    };
    match key.kind {
        Kind::Quantity(dimension, _) => number(dimension),
        Kind::Angle(Dimension::RATE, _) => "\"30 rad/s\"".to_string(),
        Kind::Angle(..) => "\"30 deg\"".to_string(),
        Kind::Vector(Dimension::NONE, _) | Kind::Spatial(Dimension::NONE, _) => "[1, 0]".to_string(),
        Kind::Vector(dimension, _) | Kind::Spatial(dimension, _) => format!("[0, {}]", number(dimension)),
        Kind::Quantities(dimension, _, least) => format!("[{}]", vec![number(dimension); least].join(", ")),
        Kind::Value => "\"5 m/s\"".to_string(),
        Kind::Values => "[0, \"5 m/s\"]".to_string(),
        Kind::Points(least) => {
            let square = ["[0, 0]", "[\"3 mm\", 0]", "[\"3 mm\", \"3 mm\"]", "[0, \"3 mm\"]"];
            format!("[{}]", square.iter().cycle().take(least.max(2)).copied().collect::<Vec<_>>().join(", "))
        }
        Kind::Outlines(_) => "[[[0, 0], [\"3 mm\", 0], [0, \"3 mm\"]]]".to_string(),
        Kind::SpatialPoints(_) => "[[0, 0, 0], [0, 0, \"3 mm\"]]".to_string(),
        Kind::SpatialOutlines(_) => "[[[0, 0, 0], [0, 0, \"3 mm\"]]]".to_string(),
        Kind::Drive(Dimension::RATE) => "\"30 rad/s\"".to_string(),
        Kind::Drive(dimension) => number(dimension),
        Kind::Components(dimension) => format!("{{ x = {} }}", number(dimension)),
        Kind::Motion => "{ x = \"5 m/s\", rotation = \"free\" }".to_string(),
        Kind::Rigid => "true".to_string(),
        Kind::Stiffness(Dimension::FORCE_PER_LENGTH, _) => "\"3.5e8 N/m\"".to_string(),
        Kind::Stiffness(..) => "\"3.5e11 N/m/m\"".to_string(),
        Kind::MassFlow(Dimension::FORCE_PER_VELOCITY, _) => "\"0.5 kg/s\"".to_string(),
        Kind::MassFlow(..) => "\"0.5 kg/s/m\"".to_string(),
        Kind::Integer(_) => "12".to_string(),
        Kind::Integers(count, _) => format!("[{}]", ["12", "3", "4"].iter().cycle().take(count).copied().collect::<Vec<_>>().join(", ")),
        Kind::Cadence => "\"10 us\"".to_string(),
        Kind::Flag => "true".to_string(),
        Kind::Text | Kind::Name | Kind::Reference => "\"...\"".to_string(),
        Kind::References(count) => {
            format!("[{}]", ["\"...\"", "\"...\""].iter().cycle().take(count.unwrap_or(1)).copied().collect::<Vec<_>>().join(", "))
        }
        Kind::Choice(known) => format!("\"{}\"", known.names().first().copied().unwrap_or("...")),
        Kind::Choices(known) => format!("[\"{}\"]", known.names().first().copied().unwrap_or("...")),
        Kind::Tables(section) => format!("[{}]", example(&Key { kind: Kind::Table(section), ..*key })),
        Kind::Table(section) => {
            let required = section.keys.iter().filter(|key| key.need == embate_solver::vocabulary::Need::Required);
            format!("{{ {} }}", required.map(|key| format!("{} = {}", key.name, example(key))).collect::<Vec<_>>().join(", "))
        }
    }
}

fn like(key: &Key) -> String {
    format!("write it like `{} = {}`", key.name, example(key))
}
