//! One number out of a run: a figure of the summary, something of a column of the history, something of a
//! field.
//!
//! A run's samples come from `run.rs`; numbers go to `judge.rs`. A number that is not there, or is not
//! finite, is an error and never a value: no check passes by it.

use super::case::{How, Place, Source, Take};
use embate_solver::channel::{Channels, Figures};
use embate_solver::model::Model;
use embate_solver::output::{Cells, Field, Frame, Location};
use embate_solver::simulation::Simulation;
use embate_solver::vocabulary::suggestion;

/// A frame that is further than this fraction of the run from the time that is wanted is another one.
const FRAME_TOLERANCE: f64 = 1e-2;

/// What is kept of a run.
#[derive(Debug)]
pub(crate) struct Samples {
    columns: Vec<String>,
    pub(crate) rows: Vec<Vec<f64>>,
    /// The cells of the model, and those of each mesh that a part got in the run.
    meshes: Vec<Mesh>,
    /// Wanted times, and the frames nearest to them, each with the number of its mesh.
    frames: Vec<(f64, Option<(usize, Frame)>)>,
    pub(crate) summary: serde_json::Value,
}

/// Cells, and where their nodes are at the start, by which nodes and elements are chosen.
#[derive(Debug, Default)]
struct Mesh {
    cells: Cells,
    /// Of the model its frame at the start. Of a later mesh from its first frame: nodes have displacements
    /// from where their material was at the start.
    start: Option<Frame>,
}

/// Why a quantity can't be: key of its table, message, help.
type Missing = (&'static str, String, String);

impl Samples {
    /// Nothing yet but what is known at the start; the frames nearest to these times will be kept.
    pub(crate) fn new(simulation: &Simulation, mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        times.dedup();
        Self {
            columns: simulation.history_columns(),
            rows: Vec::new(),
            meshes: vec![Mesh { cells: simulation.cells(), start: Some(simulation.frame()) }],
            frames: times.into_iter().map(|time| (time, None)).collect(),
            summary: serde_json::Value::Null,
        }
    }

    /// Of a run that has been recorded: its history and its summary, without frames.
    pub(crate) fn recorded(columns: Vec<String>, rows: Vec<Vec<f64>>, summary: serde_json::Value) -> Self {
        Self { columns, rows, meshes: vec![Mesh::default()], frames: Vec::new(), summary }
    }

    /// Adds the channels of a model as columns.
    pub(crate) fn add_channels(&mut self, model: &Model) {
        // The simulation has read them already.
        let channels = Channels::new(model, &self.columns).unwrap_or_default();
        if channels.is_empty() {
            return;
        }
        let of_column = |index: usize| self.rows.iter().map(|row| row[index]).collect();
        let found = channels.evaluate(&(0..self.columns.len()).map(of_column).collect::<Vec<_>>());
        for Figures { name, values, .. } in found {
            self.columns.push(name);
            self.rows.iter_mut().zip(values).for_each(|(row, value)| row.push(value));
        }
    }

    /// A text of the summary; `None` where the source is no text.
    pub(crate) fn text(&self, source: &Source) -> Option<&str> {
        let Source::Summary(path) = source else { return None };
        path.split('.').try_fold(&self.summary, |here, key| here.get(key))?.as_str()
    }

    /// Names of the history's columns.
    pub(crate) fn columns(&self) -> &[String] {
        &self.columns
    }

    /// What a name may have meant that is neither a column nor a figure.
    pub(crate) fn suggested(&self, name: &str) -> String {
        let figures = self.summary.as_object().into_iter().flatten().map(|(key, _)| key.as_str());
        let known: Vec<&str> = self.columns.iter().map(String::as_str).chain(figures).collect();
        suggestion(name, &known)
    }

    /// Keeps the frame where it is nearer to a wanted time than what is there; of the time infinity, the
    /// last.
    pub(super) fn note_frame(&mut self, frame: &Frame) {
        let mesh = self.meshes.len() - 1;
        let start = &mut self.meshes[mesh].start;
        if start.is_none() {
            *start = at_the_start(frame);
        }
        for (time, kept) in &mut self.frames {
            let nearer = kept.as_ref().is_none_or(|(_, kept)| time.is_infinite() || (frame.time - *time).abs() < (kept.time - *time).abs());
            if nearer {
                *kept = Some((mesh, frame.clone()));
            }
        }
    }

    /// Frames are of these cells from here on.
    pub(super) fn note_cells(&mut self, cells: Cells) {
        self.meshes.push(Mesh { cells, start: None });
    }

    /// What is at rest stays as it is: the last row once more at the end.
    pub(crate) fn stay_until(&mut self, end: f64) {
        if let Some(mut row) = self.rows.last().cloned() {
            row[0] = end;
            self.rows.push(row);
        }
    }

    /// Whether a quantity will be there, as far as can be reported before the run.
    pub(crate) fn examine(&self, source: &Source, end: f64) -> Result<(), Missing> {
        if let Some(late) = source.times().into_iter().find(|time| *time > end) {
            let key = if matches!(source, Source::History { during: [Some(begin), _], .. } if *begin == late) {
                "from"
            } else if matches!(source, Source::History { .. }) {
                "to"
            } else {
                "at"
            };
            return Err((
                key,
                format!("the run ends at {end} s, before {late} s"),
                "take an earlier time, or let the run be longer".into(),
            ));
        }
        match source {
            Source::Summary(path) => self.figure(path).map(|_| ()),
            Source::HistoryAt(column, _) | Source::History { column, .. } => self.column(column).map(|_| ()),
            Source::Field { name, part, place, .. } => {
                let none = Frame::default();
                let (field, _) = field(self.meshes[0].start.as_ref().unwrap_or(&none), name)?;
                self.meshes[0].chosen(field, part.as_deref(), *place).map(|_| ())
            }
        }
    }

    /// The number.
    ///
    /// # Errors
    /// Why there is none.
    pub(crate) fn number(&self, source: &Source) -> Result<f64, String> {
        let reported = |(_, message, _): Missing| message;
        let value = match source {
            Source::Summary(path) => self.figure(path).map_err(reported)?.ok_or_else(|| format!("`{path}` is null in summary.json"))?,
            Source::HistoryAt(column, at) => {
                let curve = self.curve(column, [Some(*at), None])?;
                curve.first().map_or(f64::NAN, |point| point[1])
            }
            Source::History { column, take, during, level } => taken(&self.curve(column, *during)?, take, *level)
                .ok_or_else(|| format!("`{column}` is never there: {} {level}", take.name))?,
            Source::Field { name, at, part, place, take } => {
                let (mesh, frame) = self.frame(*at)?;
                let (field, component) = field(frame, name).map_err(reported)?;
                let values: Vec<f64> = self.meshes[*mesh]
                    .chosen(field, part.as_deref(), *place)
                    .map_err(reported)?
                    .into_iter()
                    .map(|index| field.values[index * field.kind.width() + component])
                    .collect();
                of_field(&values, take.how)
            }
        };
        if value.is_finite() { Ok(value) } else { Err(format!("it is {value}")) }
    }

    /// A figure of the summary; `None` for null.
    fn figure(&self, path: &str) -> Result<Option<f64>, Missing> {
        let mut here = &self.summary;
        for key in path.split('.') {
            if here.is_null() {
                return Ok(None); // What has no value at the start may have one, with keys in it, at the end.
            }
            let Some(next) = here.get(key) else {
                let known: Vec<&str> = here.as_object().into_iter().flatten().map(|(key, _)| key.as_str()).collect();
                return Err(("summary", format!("summary.json has no `{path}`"), suggestion(key, &known)));
            };
            here = next;
        }
        match here {
            serde_json::Value::Null => Ok(None),
            here => here
                .as_f64()
                .map(Some)
                .ok_or_else(|| ("summary", format!("`{path}` of summary.json is no number"), "name a figure".to_string())),
        }
    }

    fn column(&self, name: &str) -> Result<usize, Missing> {
        self.columns.iter().position(|column| column == name).ok_or_else(|| {
            let known: Vec<&str> = self.columns.iter().map(String::as_str).collect();
            ("history", format!("the history has no column `{name}`"), suggestion(name, &known))
        })
    }

    /// All values of a column.
    ///
    /// # Errors
    /// That there is no such column.
    pub(crate) fn values(&self, name: &str) -> Result<Vec<f64>, String> {
        let index = self.column(name).map_err(|(_, message, _)| message)?;
        Ok(self.rows.iter().map(|row| row[index]).collect())
    }

    /// Time and value of a column from one time to another, both interpolated on straight lines.
    pub(super) fn curve(&self, name: &str, [begin, end]: [Option<f64>; 2]) -> Result<Vec<[f64; 2]>, String> {
        let index = self.column(name).map_err(|(_, message, _)| message)?;
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else { return Err("the history is empty".to_string()) };
        let (begin, end) = (begin.unwrap_or(first[0]), end.unwrap_or(last[0]));
        for time in [begin, end] {
            if !(first[0] <= time && time <= last[0] * (1.0 + 1e-12)) {
                return Err(format!("the history has no time {time} s: it ends at {} s", last[0]));
            }
        }
        let inside = self.rows.iter().filter(|row| begin < row[0] && row[0] < end).map(|row| [row[0], row[index]]);
        let ends = [begin, end].map(|time| [time, interpolated(&self.rows, index, time)]);
        Ok(std::iter::once(ends[0]).chain(inside).chain(std::iter::once(ends[1])).collect())
    }

    /// The frame at a time, and the number of its mesh.
    fn frame(&self, at: Option<f64>) -> Result<&(usize, Frame), String> {
        let wanted = at.unwrap_or(f64::INFINITY);
        let kept = self.frames.iter().find(|(time, _)| *time == wanted).and_then(|(_, kept)| kept.as_ref());
        let found = kept.ok_or_else(|| "there is no frame".to_string())?;
        let frame = &found.1;
        let end = self.rows.last().map_or(0.0, |row| row[0]);
        match at {
            Some(at) if !((frame.time - at).abs() <= FRAME_TOLERANCE * end) => {
                Err(format!("no frame at {at} s: the nearest is at {} s; see `output.fields` of the model", frame.time))
            }
            _ => Ok(found),
        }
    }
}

impl Mesh {
    /// Nodes or cells of a field by part and place at the start.
    fn chosen(&self, field: &Field, part: Option<&str>, place: Place) -> Result<Vec<usize>, Missing> {
        let unknown = || ("field", "nodes have no displacement".to_string(), "name it in `output.include`".to_string());
        let start = self.start.as_ref().ok_or_else(unknown)?;
        let names = &self.cells.part_names;
        let part = match part {
            None => None,
            Some(name) => Some(names.iter().position(|known| known == name).ok_or_else(|| {
                let known: Vec<&str> = names.iter().map(String::as_str).collect();
                ("part", format!("there is no part `{name}`"), suggestion(name, &known))
            })?),
        };
        let cells = (0..self.cells.len()).filter(|&cell| part.is_none_or(|part| self.cells.parts[cell] as usize == part));
        let points: Vec<(usize, [f64; 3])> = match field.kind.location {
            Location::Cell => cells.map(|cell| (cell, self.centre(start, cell))).collect(),
            Location::Node => {
                let mut nodes: Vec<usize> = cells.flat_map(|cell| self.cells.cell(cell)).map(|node| *node as usize).collect();
                nodes.sort_unstable();
                nodes.dedup();
                nodes.into_iter().map(|node| (node, start.place(node))).collect()
            }
        };
        let chosen: Vec<usize> = match place {
            Place::All => points.into_iter().map(|(index, _)| index).collect(),
            Place::Box { low, high } => {
                let inside = |x: &[f64; 3]| (0..3).all(|d| low[d] <= x[d] && x[d] <= high[d]);
                points.into_iter().filter(|(_, x)| inside(x)).map(|(index, _)| index).collect()
            }
            Place::Nearest(to) => {
                let distance = |x: &[f64; 3]| (x[0] - to[0]).hypot(x[1] - to[1]).hypot(x[2] - to[2]);
                let nearest = points.into_iter().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
                nearest.into_iter().map(|(index, _)| index).collect()
            }
        };
        let what = if field.kind.location == Location::Cell { "element" } else { "node" };
        if chosen.is_empty() { Err(("box", format!("there is no {what} in the box"), "take a larger box".to_string())) } else { Ok(chosen) }
    }

    fn centre(&self, start: &Frame, cell: usize) -> [f64; 3] {
        let nodes = self.cells.cell(cell);
        [0, 1, 2].map(|d| nodes.iter().map(|node| start.place(*node as usize)[d]).sum::<f64>() / nodes.len() as f64)
    }
}

/// Nodes where they are at the start; `None` where the frame has no displacements.
fn at_the_start(frame: &Frame) -> Option<Frame> {
    let moved = frame.fields.iter().find(|field| field.kind.name == "displacement")?;
    let coordinates = frame.coordinates.iter().zip(&moved.values).map(|(at, moved)| at - moved).collect();
    Some(Frame { dimension: frame.dimension, coordinates, ..Frame::default() })
}

/// The field and the component that a name such as `stress.yy` means.
fn field<'a>(frame: &'a Frame, name: &str) -> Result<(&'a Field, usize), Missing> {
    let (base, component) = name.split_once('.').map_or((name, None), |(base, component)| (base, Some(component)));
    let Some(field) = frame.fields.iter().find(|field| field.kind.name == base) else {
        let known: Vec<&str> = frame.fields.iter().map(|field| field.kind.name).collect();
        return Err(("field", format!("the model records no field `{base}`"), suggestion(base, &known)));
    };
    match (component, field.kind.components) {
        (None, []) => Ok((field, 0)),
        (None, known) => Err(("field", format!("`{base}` has components"), format!("name one of them, such as `{base}.{}`", known[0]))),
        (Some(component), known) => known
            .iter()
            .position(|name| *name == component)
            .map(|index| (field, index))
            .ok_or_else(|| ("field", format!("`{base}` has no component `{component}`"), suggestion(component, known))),
    }
}

/// Value of a column at a time between two rows, on a straight line.
fn interpolated(rows: &[Vec<f64>], index: usize, time: f64) -> f64 {
    let after = rows.partition_point(|row| row[0] < time);
    match (after.checked_sub(1).and_then(|before| rows.get(before)), rows.get(after)) {
        (_, Some(b)) if b[0] == time => b[index],
        (Some(a), Some(b)) => a[index] + (b[index] - a[index]) * (time - a[0]) / (b[0] - a[0]),
        (Some(row), None) | (None, Some(row)) => row[index],
        (None, None) => f64::NAN,
    }
}

/// What `take` makes of a curve; `None` where it is never above or below the level.
fn taken(curve: &[[f64; 2]], take: &Take, level: f64) -> Option<f64> {
    if curve.iter().any(|[_, value]| value.is_nan()) {
        return Some(f64::NAN);
    }
    let (first, last) = (curve.first()?[0], curve.last()?[0]);
    let extreme = |sign: f64| curve.iter().copied().reduce(|best, point| if sign * point[1] > sign * best[1] { point } else { best });
    let integral = || curve.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum::<f64>();
    match take.how {
        How::Mean => Some(integral() / (last - first)),
        How::Integral => Some(integral()),
        How::Max => extreme(1.0).map(|point| point[1]),
        How::Min => extreme(-1.0).map(|point| point[1]),
        How::MaxAbs => curve.iter().map(|point| point[1].abs()).reduce(f64::max),
        How::Last => curve.last().map(|point| point[1]),
        How::TimeOfMax => extreme(1.0).map(|point| point[0]),
        How::TimeOfMin => extreme(-1.0).map(|point| point[0]),
        How::Sum => None,
        How::FirstAbove | How::FirstBelow | How::LastAbove | How::LastBelow => {
            let [above, from_the_end] = take.how.above_and_last();
            let sign = if above { 1.0 } else { -1.0 };
            let over = |[time, value]: &[f64; 2]| [*time, sign * (value - level)];
            if from_the_end { crossing(curve.iter().rev().map(over)) } else { crossing(curve.iter().map(over)) }
        }
    }
}

/// Where a curve first rises above zero, on straight lines; its first time if it begins there.
fn crossing(curve: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
    let mut before: Option<[f64; 2]> = None;
    for [time, value] in curve {
        if value > 0.0 {
            return Some(before.map_or(time, |[t, v]| t + (time - t) * v / (v - value)));
        }
        before = Some([time, value]);
    }
    None
}

/// What `how` makes of the values of a field.
fn of_field(values: &[f64], how: How) -> f64 {
    let extreme = |sign: f64| {
        // A NaN stays once it is there: no comparison with it holds.
        let better = |best: f64, value: f64| if best.is_nan() || sign * best >= sign * value { best } else { value };
        values.iter().copied().reduce(better).unwrap_or(f64::NAN)
    };
    let sum = || values.iter().sum::<f64>();
    match how {
        How::Mean => sum() / values.len() as f64,
        How::Sum => sum(),
        How::Max => extreme(1.0),
        How::Min => extreme(-1.0),
        How::MaxAbs => [extreme(1.0), extreme(-1.0)]
            .map(f64::abs)
            .into_iter()
            .reduce(|a, b| if a.is_nan() || a > b { a } else { b })
            .unwrap_or(f64::NAN),
        // `read.rs` takes nothing else of a field.
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verification::case::TAKES;

    const CURVE: [[f64; 2]; 5] = [[0.0, 0.0], [1.0, 2.0], [2.0, 4.0], [3.0, 0.0], [5.0, -2.0]];

    fn of(curve: &[[f64; 2]], name: &str, level: f64) -> Option<f64> {
        taken(curve, TAKES.iter().find(|take| take.name == name).unwrap(), level)
    }

    #[test]
    fn a_column_becomes_one_number() {
        let exact = [
            ("integral", 1.0 + 3.0 + 2.0 - 2.0),
            ("mean", 0.8),
            ("max", 4.0),
            ("min", -2.0),
            ("max_abs", 4.0),
            ("last", -2.0),
            ("time_of_max", 2.0),
            ("time_of_min", 5.0),
            ("first_above", 0.5),
            ("last_above", 2.75),
        ];
        for (name, value) in exact {
            assert_eq!(of(&CURVE, name, 1.0), Some(value), "{name}");
        }
        assert_eq!(of(&CURVE, "first_below", -1.0), Some(4.0));
        assert_eq!(of(&CURVE, "last_below", -1.0), Some(5.0), "below at the end");
        assert_eq!(of(&CURVE, "first_above", 4.0), None, "equal is not above");
    }

    #[test]
    fn a_nan_among_the_values_makes_the_number_nan() {
        let mut curve = CURVE;
        curve[3][1] = f64::NAN;
        for take in TAKES {
            if take.of_history {
                assert!(taken(&curve, take, 1.0).unwrap().is_nan(), "{}", take.name);
            }
            if take.of_field {
                for values in [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]] {
                    assert!(of_field(&values, take.how).is_nan(), "{}", take.name);
                }
            }
        }
    }

    #[test]
    fn a_value_between_two_rows_lies_on_a_straight_line() {
        let rows = [vec![0.0, 1.0], vec![2.0, 5.0], vec![3.0, 5.0]];
        assert_eq!([0.0, 0.5, 2.0, 2.5, 3.0].map(|time| interpolated(&rows, 1, time)), [1.0, 2.0, 5.0, 5.0, 5.0]);
    }
}
