//! Plot of a sweep: outputs over inputs.
//!
//! Inputs and outputs come from the table of a sweep; this file chooses panels and curves, `svg` draws them.
//! One input: a panel for each output. Two inputs of which every value meets every other one: the same with a
//! curve for each value of the second. Else: the first output over each input.

use super::colour::DISTINCT;
use super::scale::{number, unit};
use super::svg::{Abscissa, Curve, Group, Panel, chart};
use super::{PictureError, write_whole};
use std::path::Path;

pub(crate) use super::svg::Spacing;

/// An input.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) name: String,
    pub(crate) si: String,
    /// Value of each item; of texts their places.
    pub(crate) values: Vec<f64>,
    pub(crate) spacing: Spacing,
}

/// An output.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    pub(crate) name: String,
    pub(crate) si: &'static str,
}

/// A run: its item of each input, its value of each output.
#[derive(Clone, Debug)]
pub(crate) struct Run<'a> {
    pub(crate) items: &'a [usize],
    pub(crate) outputs: Vec<f64>,
}

/// Panels of one plot.
const PANELS_MAX: usize = 6;
/// Numbers smaller than this beside the largest of their unit, and changes smaller than this beside the
/// numbers, are round-off.
const ROUND_OFF: f64 = 1e-9;
/// Curves of one panel.
const CURVES_MAX: usize = 9;

/// The unit of an output: of a column of the history, of a time, of a figure of the summary.
pub(crate) fn unit_of(column: Option<&str>, name: &str, is_time: bool, of_whole_bodies: bool) -> &'static str {
    let [energy, force] = if of_whole_bodies { ["J", "N"] } else { ["J/m", "N/m"] };
    let Some(column) = column else {
        return match name {
            _ if is_time => "s",
            "penetration_max" => "m",
            _ => "",
        };
    };
    let bare = column.split('[').next().unwrap_or(column);
    match bare.rsplit('.').next().unwrap_or(bare) {
        _ if bare.starts_with("energy.") => energy,
        _ if bare.starts_with("cavity.") => crate::results::unit(column, of_whole_bodies),
        "force_x" | "force_y" => force,
        "energy" | "friction_work" => energy,
        "penetration" | "x" | "y" => "m",
        "vx" | "vy" => "m/s",
        "angle" => "rad",
        "spin" => "rad/s",
        "moment" => {
            if of_whole_bodies {
                ""
            } else {
                "N"
            }
        }
        "time" | "time_step" => "s",
        _ => "",
    }
}

/// Writes the plot.
pub(crate) fn plot(
    title: &str,
    axes: &[Axis],
    outputs: &[Output],
    runs: &[Run<'_>],
    is_factorial: bool,
    path: &Path,
) -> Result<(), PictureError> {
    let shown = shown(outputs, runs);
    let groups = match (axes, is_factorial) {
        ([axis], _) => {
            vec![Group { abscissa: axis.abscissa(), panels: shown.iter().map(|&k| over_one(axis, k, &outputs[k], runs)).collect() }]
        }
        ([axis, other], true) => {
            vec![Group { abscissa: axis.abscissa(), panels: shown.iter().map(|&k| over_two(axis, other, k, &outputs[k], runs)).collect() }]
        }
        _ => {
            let first = shown.first().copied();
            let panel = |(input, axis): (usize, &Axis)| Group {
                abscissa: axis.abscissa(),
                panels: first.iter().map(|&k| over_each(axis, input, k, &outputs[k], runs, is_factorial)).collect(),
            };
            axes.iter().enumerate().map(panel).collect()
        }
    };
    let text = chart(&format!("{title} – {} runs", runs.len()), &groups);
    write_whole(path, |out| out.write_all(text.as_bytes()).map_err(|source| PictureError::Io { path: path.to_path_buf(), source }))
}

/// Outputs that have numbers; those that are round-off or the same in all runs only if there are no others.
fn shown(outputs: &[Output], runs: &[Run<'_>]) -> Vec<usize> {
    let range = |k: usize| {
        let values = runs.iter().map(|run| run.outputs[k]).filter(|value| value.is_finite());
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    };
    let size = |k: usize| range(k).into_iter().map(f64::abs).fold(0.0, f64::max);
    let finite: Vec<usize> = (0..outputs.len()).filter(|&k| range(k)[0] <= range(k)[1]).collect();
    let changes = |k: &usize| {
        let of_unit = finite.iter().filter(|&&other| outputs[other].si == outputs[*k].si && !outputs[*k].si.is_empty());
        let largest = of_unit.map(|&other| size(other)).fold(0.0, f64::max);
        size(*k) > ROUND_OFF * largest && range(*k)[1] - range(*k)[0] > ROUND_OFF * size(*k)
    };
    let mut shown: Vec<usize> = finite.iter().copied().filter(changes).collect();
    if shown.is_empty() {
        shown.clone_from(&finite);
    }
    shown.truncate(PANELS_MAX);
    shown
}

impl Axis {
    fn abscissa(&self) -> Abscissa {
        Abscissa { name: self.name.clone(), si: self.si.clone(), spacing: self.spacing.clone() }
    }

    /// The name of an item in a legend.
    fn label(&self, item: usize) -> String {
        if let Spacing::Names(names) = &self.spacing {
            return names.get(self.values[item] as usize).cloned().unwrap_or_default();
        }
        let unit = unit(&self.si, self.values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs())));
        let value = self.values[item] * unit.factor;
        // Three digits distinguish the values of most lists; the table has all digits.
        let step = if value == 0.0 { 1.0 } else { 10f64.powi(value.abs().log10().floor() as i32 - 2) };
        let text = number((value / step).round() * step, step);
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        if unit.name.is_empty() { text.to_string() } else { format!("{text} {}", unit.name) }
    }
}

fn panel(output: &Output, curves: Vec<Curve>, remark: String) -> Panel {
    Panel { name: output.name.clone(), si: output.si, from_zero: false, height: 170.0, curves, remark }
}

fn curve(name: String, index: usize, mut points: Vec<[f64; 2]>) -> Curve {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let dashes = if index < DISTINCT.len() { "" } else { "6 4" };
    Curve { name, colour: DISTINCT[index % DISTINCT.len()], dashes, width: 1.6, dots: true, points }
}

fn over_one(axis: &Axis, k: usize, output: &Output, runs: &[Run<'_>]) -> Panel {
    let points = runs.iter().map(|run| [axis.values[run.items[0]], run.outputs[k]]).collect();
    panel(output, vec![curve(String::new(), 0, points)], String::new())
}

fn over_two(axis: &Axis, other: &Axis, k: usize, output: &Output, runs: &[Run<'_>]) -> Panel {
    let count = other.values.len();
    // Of many curves some, evenly, the first and the last among them.
    let chosen: Vec<usize> =
        if count <= CURVES_MAX { (0..count).collect() } else { (0..CURVES_MAX).map(|i| i * (count - 1) / (CURVES_MAX - 1)).collect() };
    let of = |(index, &item): (usize, &usize)| {
        let points = runs.iter().filter(|run| run.items[1] == item).map(|run| [axis.values[run.items[0]], run.outputs[k]]).collect();
        curve(other.label(item), index, points)
    };
    let left_out = if count > chosen.len() { format!("; {} of {count} values", chosen.len()) } else { String::new() };
    panel(output, chosen.iter().enumerate().map(of).collect(), format!("a curve for each {}{left_out}", other.name))
}

/// All runs as dots; of a factorial their mean at each value, too.
fn over_each(axis: &Axis, input: usize, k: usize, output: &Output, runs: &[Run<'_>], is_factorial: bool) -> Panel {
    let points: Vec<[f64; 2]> = runs.iter().map(|run| [axis.values[run.items[input]], run.outputs[k]]).collect();
    let dots = Curve { width: 0.0, ..curve(String::new(), 0, points) };
    if !is_factorial {
        return panel(output, vec![dots], String::new());
    }
    let mean = |item: usize| {
        let values: Vec<f64> =
            runs.iter().filter(|run| run.items[input] == item).map(|run| run.outputs[k]).filter(|v| v.is_finite()).collect();
        [axis.values[item], values.iter().sum::<f64>() / values.len() as f64]
    };
    let means = curve("mean".into(), 1, (0..axis.values.len()).map(mean).filter(|point| point[1].is_finite()).collect());
    panel(output, vec![dots, means], "each dot is a run".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(name: &str, values: &[f64]) -> Axis {
        Axis { name: name.into(), si: "Pa".into(), values: values.to_vec(), spacing: Spacing::Even }
    }

    #[test]
    fn two_inputs_give_a_curve_for_each_value_of_the_second() {
        let (a, b) = (axis("a", &[1e8, 2e8, 3e8]), axis("b", &[1e6, 2.5e6]));
        let items: Vec<[usize; 2]> = (0..3).flat_map(|i| (0..2).map(move |j| [i, j])).collect();
        let runs: Vec<Run<'_>> = items.iter().map(|items| Run { items, outputs: vec![a.values[items[0]] + b.values[items[1]]] }).collect();
        let panel = over_two(&a, &b, 0, &Output { name: "sum".into(), si: "Pa" }, &runs);
        let names: Vec<&str> = panel.curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!(names, ["1 MPa", "2.5 MPa"]);
        assert_eq!(panel.curves[1].points, [[1e8, 1.025e8], [2e8, 2.025e8], [3e8, 3.025e8]]);
    }

    #[test]
    fn of_many_inputs_each_has_its_mean() {
        let a = axis("a", &[1.0, 2.0]);
        let items = [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]];
        let runs: Vec<Run<'_>> = items.iter().zip([1.0, 3.0, 5.0, f64::NAN]).map(|(items, v)| Run { items, outputs: vec![v] }).collect();
        let panel = over_each(&a, 0, 0, &Output { name: "o".into(), si: "" }, &runs, true);
        assert_eq!(panel.curves[1].points, [[1.0, 2.0], [2.0, 5.0]]);
    }

    #[test]
    fn outputs_that_never_change_are_left_out() {
        let outputs = ["steps", "force", "nothing"].map(|name| Output { name: name.into(), si: "" });
        let runs = [[5.0, 1.0, f64::NAN], [5.0, 2.0, f64::NAN]].map(|o| Run { items: &[0], outputs: o.to_vec() });
        assert_eq!(shown(&outputs, &runs), [1]);
        assert_eq!(shown(&outputs, &runs[..1]), [0, 1], "a single run");
    }
}
