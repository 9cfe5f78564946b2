//! The values of a table of the model file, and how fields of a [`super::Model`] are read from them.
//!
//! Tables come from the reader of the file, without values that are not sound: their faults are reported
//! already. Where a value is missing a placeholder stands in: NaN, the largest count, nothing.

use super::{Cadence, Drive, Penalty};
use crate::quantity::Dimension;
use crate::vocabulary::{Key, Kind, Need};
use std::collections::BTreeMap;

/// A value that is sound, SI.
#[derive(Clone, Debug)]
#[allow(missing_docs)] // Each is a kind of value, or several.
pub enum Datum {
    Number(f64),
    Vector([f64; 2]),
    Spatial([f64; 3]),
    Numbers(Vec<f64>),
    /// Numbers of one dimension; `None` where none has a unit.
    Values(Vec<f64>, Option<Dimension>),
    Points(Vec<[f64; 2]>),
    Outlines(Vec<Vec<[f64; 2]>>),
    SpatialOutlines(Vec<Vec<[f64; 3]>>),
    /// A number or the name of a curve.
    Drive(Drive),
    /// Prescribed motion along x, y and z and around.
    Courses([Option<Course>; 4]),
    Integer(u64),
    Integers(Vec<u64>),
    Flag(bool),
    Text(String),
    Texts(Vec<String>),
    Cadence(Cadence),
    Penalty(Penalty),
}

/// What is prescribed for a degree of freedom.
#[derive(Clone, Debug)]
pub enum Course {
    /// Nothing.
    Free,
    /// A velocity or the like.
    Driven(Drive),
}

/// A table of the model file.
pub trait Values {
    /// Whether the table has the key, sound or not.
    fn has(&self, key: &str) -> bool;
    /// Its sound values by their keys, with the defaults of those that are left out.
    fn values(&self) -> &BTreeMap<String, Datum>;
    /// Its tables with their keys, in the order of the keys.
    fn tables(&self) -> Vec<(&str, &dyn Values)>;
    /// The tables of the list that a key stands for; `None` where it has none.
    fn list(&self, key: &str) -> Option<Vec<&dyn Values>>;
}

impl dyn Values + '_ {
    /// The value of a key, or its placeholder; of an `Option` nothing.
    #[must_use]
    pub fn get<T: Field>(&self, key: &str) -> T {
        T::sound(self, key).unwrap_or_else(T::placeholder)
    }

    /// The table that a key stands for.
    #[must_use]
    pub fn table(&self, key: &str) -> Option<&dyn Values> {
        self.tables().into_iter().find(|(name, _)| *name == key).map(|(_, table)| table)
    }

    /// The value of a key; where the table has none, this one.
    #[must_use]
    pub fn or<T: Field>(&self, key: &str, left_out: T) -> T {
        if self.has(key) { self.get(key) } else { left_out }
    }
}

/// What a key's value can be read as.
pub trait Field: Sized {
    /// The value of a key, if there is one.
    fn sound(values: &dyn Values, key: &str) -> Option<Self>;
    /// What stands in where there is none.
    fn placeholder() -> Self;
}

impl<T: Field> Field for Option<T> {
    fn sound(values: &dyn Values, key: &str) -> Option<Self> {
        T::sound(values, key).map(Some)
    }

    fn placeholder() -> Self {
        None
    }
}

/// Types, each with the datum and what it makes of it, and its placeholder.
macro_rules! fields {
    ($($type:ty: $datum:pat => $value:expr, $placeholder:expr;)*) => {$(
        impl Field for $type {
            fn sound(values: &dyn Values, key: &str) -> Option<Self> {
                if let $datum = values.values().get(key)? { Some($value) } else { None }
            }

            fn placeholder() -> Self {
                $placeholder
            }
        }
    )*};
}

fields! {
    f64: Datum::Number(value) => *value, f64::NAN;
    [f64; 2]: Datum::Vector(value) => *value, [f64::NAN; 2];
    [f64; 3]: Datum::Spatial(value) => *value, [f64::NAN; 3];
    Vec<f64>: Datum::Numbers(values) => values.clone(), Vec::new();
    (Vec<f64>, Option<Dimension>): Datum::Values(values, dimension) => (values.clone(), *dimension), (Vec::new(), None);
    Vec<[f64; 2]>: Datum::Points(points) => points.clone(), Vec::new();
    Vec<Vec<[f64; 2]>>: Datum::Outlines(outlines) => outlines.clone(), Vec::new();
    Vec<Vec<[f64; 3]>>: Datum::SpatialOutlines(outlines) => outlines.clone(), Vec::new();
    u64: Datum::Integer(value) => *value, u64::MAX;
    usize: Datum::Integer(value) => whole(*value), usize::MAX;
    [usize; 2]: Datum::Integers(values) => counts(values), [usize::MAX; 2];
    [usize; 3]: Datum::Integers(values) => counts(values), [usize::MAX; 3];
    bool: Datum::Flag(value) => *value, false;
    String: Datum::Text(value) => value.clone(), String::new();
    Vec<String>: Datum::Texts(values) => values.clone(), Vec::new();
    [String; 2]: Datum::Texts(values) => [0, 1].map(|index| values.get(index).cloned().unwrap_or_default()), Default::default();
    Cadence: Datum::Cadence(value) => *value, Cadence::Count(1);
    Drive: Datum::Drive(value) => value.clone(), Drive::Constant(f64::NAN);
    Penalty: Datum::Penalty(value) => *value, Penalty::default();
    [Option<Course>; 4]: Datum::Courses(courses) => courses.clone(), [None, None, None, None];
}

fn whole(value: u64) -> usize {
    usize::try_from(value).unwrap_or(usize::MAX)
}

fn counts<const N: usize>(values: &[u64]) -> [usize; N] {
    std::array::from_fn(|index| values.get(index).copied().map_or(usize::MAX, whole))
}

/// A table in which nothing is written.
pub(crate) struct LeftOut(BTreeMap<String, Datum>);

impl LeftOut {
    /// With the defaults of these keys.
    pub(crate) fn of<'a>(keys: impl IntoIterator<Item = &'a Key>) -> Self {
        Self(keys.into_iter().filter_map(|key| Some((key.name.to_string(), default(key)?))).collect())
    }
}

impl Values for LeftOut {
    fn has(&self, _: &str) -> bool {
        false
    }

    fn values(&self) -> &BTreeMap<String, Datum> {
        &self.0
    }

    fn tables(&self) -> Vec<(&str, &dyn Values)> {
        Vec::new()
    }

    fn list(&self, _: &str) -> Option<Vec<&dyn Values>> {
        None
    }
}

/// The default of a key, from its description; zero where the file must have one.
fn default(key: &Key) -> Option<Datum> {
    let text = match key.need {
        Need::Default(text) => text,
        Need::Required => "",
        Need::Optional(_) | Need::Value(_) => return None,
    };
    if let Some(degrees) = text.trim_matches('"').strip_suffix(" deg").and_then(|number| number.parse::<f64>().ok()) {
        return Some(Datum::Number(degrees.to_radians()));
    }
    let numbers: Vec<f64> = text.trim_matches(['[', ']']).split(',').filter_map(|item| item.trim().parse().ok()).collect();
    let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
    Some(match key.kind {
        Kind::Quantity(..) | Kind::Angle(..) => Datum::Number(number(0)),
        Kind::Vector(..) => Datum::Vector([0, 1].map(number)),
        Kind::Spatial(..) => Datum::Spatial([0, 1, 2].map(number)),
        Kind::Integer(_) => Datum::Integer(text.parse().unwrap_or(0)),
        Kind::Cadence => Datum::Cadence(Cadence::Count(text.parse().unwrap_or(1))),
        Kind::Flag => Datum::Flag(text == "true"),
        Kind::Value => Datum::Values(vec![number(0)], None),
        Kind::Drive(_) => Datum::Drive(Drive::Constant(number(0))),
        Kind::Choice(_) => Datum::Text(text.trim_matches('"').to_string()),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use crate::model::{Camera, Copies, InitialStress, Output, Part, Relaxation, Run, Spring};

    #[test]
    fn a_struct_has_the_defaults_of_its_description() {
        let run = Run::default();
        assert_eq!((run.end, run.safety, run.energy_limit, run.step_limit, run.bulk_viscosity), (0.0, 0.9, 0.05, None, [0.0; 2]));
        assert_eq!(Relaxation::default(), Relaxation { tolerance: 1e-6, from: 0.0 });
        let camera = Camera::default();
        assert_eq!((camera.from, camera.at, camera.up, camera.zoom), ([0.6, -1.0, 0.5], None, [0.0, 0.0, 1.0], 1.0));
        let output = Output::default();
        assert_eq!((output.hash_steps, output.pictures, output.mirror), (Some(100), true, [false; 3]));
        let part = Part::default();
        assert_eq!([part.element.as_str(), &part.element_triangles, &part.stress_state, &part.name], ["quad4", "", "plane_strain", ""]);
        assert_eq!((part.mass_scale, part.rigid, part.stress_initial, part.area), (1.0, None, None, None));
        assert_eq!((Copies::default().count, Copies::default().axis), (0, [0.0, 0.0, 1.0]));
        assert_eq!((InitialStress::default().value, Spring::default().stiffness), ([0.0; 4], 0.0));
    }
}
