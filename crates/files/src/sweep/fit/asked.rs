//! What a fit is asked for: keys with their bounds, and what was measured.

use super::super::values::{path_and_unit, table, with_unit};
use super::super::{SweepError, Wrong};
use crate::model_file::{number_and_unit, quantity_in_si, value_in_si};
use crate::plain;
use crate::sweep::messages::{BOUNDS, MEASURED};
use embate_solver::message::Message;
use std::path::Path;

/// A key that varies, SI.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parameter {
    pub(super) path: String,
    pub(super) low: f64,
    pub(super) first: f64,
    pub(super) high: f64,
    pub(super) unit: String,
}

/// Something that was measured.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    pub(super) what: What,
    /// What was measured, SI: one number, or one for each place of a curve.
    pub(super) values: Vec<f64>,
    /// The largest of them.
    pub(super) size: f64,
}

/// What a run gives for it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum What {
    /// An output of a sweep.
    Number(String),
    /// A column over another one, which is followed.
    Curve { column: String, over: String, places: Vec<f64>, file: String },
}

/// Between the columns of a curve.
const OVER: &str = " over ";
/// What a file of a curve is like.
const FORM: &str = "a curve has two columns: time, or the column that it is over, and value";
/// The column that a curve is over where none is named.
const TIME: &str = "time";

impl Target {
    /// What of it has to be there, as outputs of a sweep.
    pub(super) fn outputs(&self) -> Vec<String> {
        match &self.what {
            What::Number(output) => vec![output.clone()],
            What::Curve { column, over, places, .. } if over == TIME => {
                vec![format!("at={:?}({column})", places.iter().fold(0.0, |last: f64, time| last.max(*time)))]
            }
            What::Curve { column, over, .. } => [column, over].map(|name| format!("last({name})")).to_vec(),
        }
    }
}

/// Reads `KEY=LOWEST:HIGHEST` and `KEY=LOWEST:FIRST:HIGHEST`.
pub(super) fn parameters(texts: &[String]) -> Result<Vec<Parameter>, SweepError> {
    let all = texts.iter().map(|text| parameter(text).map_err(|wrong| asked(&BOUNDS, text, wrong)));
    let all: Vec<Parameter> = all.collect::<Result<_, _>>()?;
    match all.iter().enumerate().find(|(number, it)| all[..*number].iter().any(|other| other.path == it.path)) {
        Some((number, it)) => {
            Err(asked(&BOUNDS, &texts[number], (format!("`{}` varies twice", it.path), "give it bounds once".to_string())))
        }
        None => Ok(all),
    }
}

fn asked(kind: &'static Message, text: &str, (message, help): Wrong) -> SweepError {
    SweepError::Asked { kind, text: format!("`{text}`: {message}; {help}") }
}

fn parameter(text: &str) -> Result<Parameter, Wrong> {
    let form = "write it like material.steel.yield=200MPa:600MPa, or with the first value between both";
    let (path, bounds) = text.split_once('=').ok_or_else(|| ("there are no bounds".to_string(), form.to_string()))?;
    let parts: Vec<&str> = bounds.split(':').map(str::trim).collect();
    let values: Option<Vec<(f64, String)>> = parts.iter().map(|part| number(part)).collect();
    let values = values.ok_or_else(|| (format!("`{}` are not all numbers", bounds.trim()), form.to_string()))?;
    if values.iter().any(|(_, unit)| *unit != values[0].1) {
        return Err((format!("the bounds `{}` have different units", bounds.trim()), "give all the same unit".to_string()));
    }
    let (low, first, high) = match values[..] {
        // Of what spans decades the middle is that of the logarithms.
        [(low, _), (high, _)] if low > 0.0 && high > 10.0 * low => (low, (low * high).sqrt(), high),
        [(low, _), (high, _)] => (low, 0.5 * (low + high), high),
        [(low, _), (first, _), (high, _)] => (low, first, high),
        _ => return Err((format!("these are {} numbers", values.len()), form.to_string())),
    };
    if !(low <= first && first <= high && low < high) {
        return Err(("the bounds are not in ascending order".to_string(), form.to_string()));
    }
    Ok(Parameter { path: path.trim().to_string(), low, first, high, unit: values[0].1.clone() })
}

/// A finite number, SI, with its unit.
fn number(text: &str) -> Option<(f64, String)> {
    let (value, unit) = match number_and_unit(text)? {
        (value, "") => (value, String::new()),
        _ => value_in_si(text)?,
    };
    value.is_finite().then_some((value, unit))
}

/// Reads `OUTPUT=VALUE`, `COLUMN=FILE` and `COLUMN over COLUMN=FILE`.
pub(super) fn targets(texts: &[String]) -> Result<Vec<Target>, SweepError> {
    texts.iter().map(|text| target(text).map_err(|wrong| asked(&MEASURED, text, wrong))).collect()
}

fn target(text: &str) -> Result<Target, Wrong> {
    let form = "write it like at=1ms(tip.y)=3.2mm, tip.y=measured.csv for a curve over time, or force over tip.y=measured.csv";
    let (name, measured) = text.rsplit_once('=').ok_or_else(|| ("nothing was measured".to_string(), form.to_string()))?;
    let (name, measured) = (name.trim(), measured.trim());
    if name.is_empty() || measured.is_empty() {
        return Err(("nothing was measured".to_string(), form.to_string()));
    }
    let (what, values) = match (number(measured), name.split_once(OVER)) {
        (Some((value, _)), None) => (What::Number(name.to_string()), vec![value]),
        (Some(_), Some(_)) => return Err((format!("a curve was measured at more than one place, not `{measured}`"), form.to_string())),
        (None, _) if number_and_unit(measured).is_some() && !Path::new(measured).exists() => {
            return Err((format!("`{measured}` has no unit that is known"), form.to_string()));
        }
        (None, columns) => {
            let (column, over) = columns.unwrap_or((name, TIME));
            let (places, values): (Vec<f64>, Vec<f64>) =
                curve(Path::new(measured))?.into_iter().map(|[place, value]| (place, value)).unzip();
            if over == TIME && places.iter().any(|time| *time < 0.0) {
                return Err((
                    format!("{measured} has times before 0, when the run begins"),
                    "shift the times, or leave these rows out".into(),
                ));
            }
            let [column, over, file] = [column.trim(), over.trim(), measured].map(ToString::to_string);
            (What::Curve { column, over, places, file }, values)
        }
    };
    let size = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    Ok(Target { what, values, size: if size > 0.0 { size } else { 1.0 } })
}

/// A curve of a table with two columns, place and value, whose first line may name them with units:
/// `time [ms],tip.y [mm]`.
fn curve(file: &Path) -> Result<Vec<[f64; 2]>, Wrong> {
    let shown = file.display();
    let text =
        plain::read_to_string(file).map_err(|error| (format!("can't read {shown}: {error}"), "give a number, or a table".to_string()))?;
    let rows = table(text.trim_start_matches('\u{feff}'));
    let mut units = ["", ""];
    let has_head = rows.first().is_some_and(|row| row.iter().all(|field| number_and_unit(&field.text).is_none()));
    if let Some([time, value]) = rows.first().filter(|_| has_head).map(Vec::as_slice) {
        units = [time, value].map(|field| path_and_unit(&field.text).1);
    }
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (number, row) in rows.iter().enumerate().skip(usize::from(has_head)) {
        let wrong = |what: &str| (format!("row {} of {shown} {what}", number + 1), FORM.to_string());
        let [time, value] = row.as_slice() else { return Err(wrong("has not two columns")) };
        let [time, value] = [(time, units[0]), (value, units[1])].map(|(field, unit)| {
            let text = with_unit(field, unit).text;
            match number_and_unit(&text)? {
                (value, "") => Some(value),
                _ => quantity_in_si(&text).map(|(value, _)| value),
            }
            .filter(|value| value.is_finite())
        });
        let (Some(time), Some(value)) = (time, value) else { return Err(wrong("is not two numbers")) };
        points.push([time, value]);
    }
    if points.is_empty() { Err((format!("{shown} has no rows"), FORM.to_string())) } else { Ok(points) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_have_a_first_value_between_them() {
        let of = |text: &str| parameter(text).map(|it| (it.low, it.first, it.high, it.unit)).map_err(|(message, _)| message);
        assert_eq!(of("a.b=1:3"), Ok((1.0, 2.0, 3.0, String::new())));
        assert_eq!(of("a.b=1 MPa : 100MPa"), Ok((1e6, 1e7, 1e8, "Pa".into())));
        assert_eq!(of("a.b=-1:0:3"), Ok((-1.0, 0.0, 3.0, String::new())));
        for (text, word) in [
            ("a.b", "no bounds"),
            ("a.b=1", "1 numbers"),
            ("a.b=1:x", "not all numbers"),
            ("a.b=1 mm:2 s", "different units"),
            ("a.b=3:1", "ascending"),
            ("a.b=1:4:3", "ascending"),
            ("a.b=2:2", "ascending"),
            ("a.b=nan:2", "not all numbers"),
        ] {
            assert!(of(text).unwrap_err().contains(word), "{text}: {:?}", of(text));
        }
        assert!(parameters(&["a=1:2".into(), "a=1:3".into()]).unwrap_err().to_string().contains("varies twice"));
    }

    #[test]
    fn what_was_measured_is_a_number_or_a_curve() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path.display().to_string()
        };
        let number = target("at=1ms(tip.y) = 3.2 mm").unwrap();
        assert_eq!((number.outputs(), number.values, number.size), (vec!["at=1ms(tip.y)".to_string()], vec![3.2e-3], 3.2e-3));
        let curve = target(&format!("tip.y={}", file("a.csv", "time [ms],y [mm]\n0,0\n0.5,-2\n"))).unwrap();
        assert_eq!(curve.outputs(), ["at=0.0005(tip.y)"]);
        assert_eq!((curve.values, curve.size), (vec![0.0, -2e-3], 2e-3));
        let plain = target(&format!("tip.y={}", file("b.csv", "0,1\n1 ms,2\n"))).unwrap();
        assert_eq!((plain.outputs()[0].as_str(), plain.values[1]), ("at=0.001(tip.y)", 2.0));
        let over = target(&format!("cut.force_x[mid] over tip.x = {}", file("over.csv", "x [mm],force [kN]\n-1,2\n-2,3\n"))).unwrap();
        assert_eq!((over.outputs(), over.values), (vec!["last(cut.force_x[mid])".into(), "last(tip.x)".into()], vec![2e3, 3e3]));
        let What::Curve { places, over, column, .. } = over.what else { panic!("no curve") };
        assert_eq!((places, over.as_str(), column.as_str()), (vec![-1e-3, -2e-3], "tip.x", "cut.force_x[mid]"));
        for (text, word) in [
            ("tip.y".to_string(), "nothing was measured"),
            ("tip.y=".to_string(), "nothing was measured"),
            ("tip.y=3 parsecs".to_string(), "no unit"),
            ("tip.y=nowhere.csv".to_string(), "can't read nowhere.csv"),
            (format!("tip.y={}", file("c.csv", "t,y\n1,2,3\n")), "row 2 of"),
            (format!("tip.y={}", file("d.csv", "t,y\n1,x\n")), "is not two numbers"),
            (format!("tip.y={}", file("e.csv", "t,y\n")), "has no rows"),
            (format!("tip.y={}", file("f.csv", "-1 ms,2\n")), "times before 0"),
            ("tip.y over tip.x=3 mm".to_string(), "more than one place"),
        ] {
            let message = target(&text).unwrap_err().0;
            assert!(message.contains(word), "{text}: {message}");
        }
    }
}
