//! Plots of the history: `energy.svg` and `history.svg`.
//! Columns and rows are those of `history.csv`; this file chooses and names curves, `svg` draws them.

use super::colour::{DISTINCT, Rgb, TEXT};
use super::svg::{Curve, Panel, chart};
use super::{PictureError, write_whole};
use std::path::Path;

/// Writes `energy.svg` (all energies of the whole model over time) and `history.svg` (probe positions and contact forces, in panels over one
/// time axis) into `folder`.
///
/// `columns`: names as in `history.csv`, one of them `time` (else the first is the time); `rows`: one value per column, SI. Values that are
/// not finite leave gaps; missing columns leave a plot without curves.
///
/// # Errors
/// [`PictureError::Io`] if a file can't be written.
pub fn plots(columns: &[String], rows: &[Vec<f64>], title: &str, folder: &Path) -> Result<(), PictureError> {
    let table = Table { columns, rows };
    write_text(&folder.join("energy.svg"), &chart(&titled(title, "energy"), &[energy(&table)]))?;
    write_text(&folder.join("history.svg"), &chart(&titled(title, "history"), &history(&table)))
}

fn titled(title: &str, what: &str) -> String {
    if title.is_empty() { what.to_string() } else { format!("{title} – {what}") }
}

fn write_text(path: &Path, text: &str) -> Result<(), PictureError> {
    write_whole(path, |out| out.write_all(text.as_bytes()).map_err(|source| PictureError::Io { path: path.to_path_buf(), source }))
}

/// Columns and rows of the history.
struct Table<'a> {
    columns: &'a [String],
    rows: &'a [Vec<f64>],
}

impl Table<'_> {
    /// Time and the column's value in each row.
    fn points(&self, column: usize) -> Vec<[f64; 2]> {
        let time = self.columns.iter().position(|name| name == "time").unwrap_or(0);
        let value = |row: &[f64], k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        self.rows.iter().map(|row| [value(row, time), value(row, column)]).filter(|p| p[0].is_finite()).collect()
    }

    fn is_zero(&self, column: usize) -> bool {
        self.rows.iter().all(|row| row.get(column).is_none_or(|v| *v == 0.0))
    }
}

/// Energies whose colour is always the same.
const ENERGY_COLOURS: [(&str, Rgb); 6] = [
    ("total", TEXT),
    ("kinetic", DISTINCT[0]),
    ("internal", DISTINCT[1]),
    ("plastic", DISTINCT[4]),
    ("contact", DISTINCT[2]),
    ("external", DISTINCT[3]),
];

/// All `energy.NAME` without a part; those that are zero throughout are named in the remark.
fn energy(table: &Table<'_>) -> Panel {
    let mut curves = Vec::new();
    let mut zero = Vec::new();
    for (column, name) in table.columns.iter().enumerate() {
        let Some(name) = name.strip_prefix("energy.").filter(|name| !name.contains('[')) else { continue };
        if ["drift", "residual"].iter().any(|fraction| name.contains(fraction)) {
            continue;
        }
        if table.is_zero(column) {
            zero.push(name.replace('_', " "));
            continue;
        }
        let fixed = ENERGY_COLOURS.iter().find(|(known, _)| *known == name);
        let colour = fixed.map_or_else(|| DISTINCT[(5 + curves.len()) % DISTINCT.len()], |(_, colour)| *colour);
        let width = if name == "total" { 2.4 } else { 1.8 };
        let dashes = if fixed.is_some() { "" } else { "6 4" };
        curves.push(Curve { name: name.replace('_', " "), colour, dashes, width, points: table.points(column) });
    }
    let remark = if zero.is_empty() { String::new() } else { format!("zero throughout: {}", zero.join(", ")) };
    // Plane models: everything is per metre of depth.
    Panel { name: "energy".into(), si: "J/m", from_zero: true, height: 380.0, curves, remark }
}

/// Curves in one panel; more would be a carpet.
const CURVES_MAX: usize = 9;

/// A panel for each kind of quantity that the history holds.
fn history(table: &Table<'_>) -> Vec<Panel> {
    let probe = |axis: &'static str| {
        move |name: &str| {
            let probe = name.strip_suffix(axis)?;
            (!probe.is_empty() && !probe.starts_with("energy.") && !probe.starts_with("contact.force")).then(|| probe.to_string())
        }
    };
    let force = |axis: &'static str| {
        let prefix = format!("contact.force_{axis}[");
        move |name: &str| Some(name.strip_prefix(&prefix)?.strip_suffix(']')?.to_string())
    };
    let mut panels: Vec<Panel> = [
        panel(table, "position y", "m", probe(".y")),
        panel(table, "position x", "m", probe(".x")),
        panel(table, "contact force y", "N/m", force("y")),
        panel(table, "contact force x", "N/m", force("x")),
    ]
    .into_iter()
    .flatten()
    .collect();
    if panels.is_empty() {
        let remark = "no probe moves and no contact acts".into();
        panels.push(Panel { name: "history".into(), si: "", from_zero: false, height: 170.0, curves: Vec::new(), remark });
    }
    panels
}

/// The panel of all columns that `name_of` names; none if there are none or all are zero.
fn panel(table: &Table<'_>, name: &str, si: &'static str, name_of: impl Fn(&str) -> Option<String>) -> Option<Panel> {
    let found: Vec<(usize, String)> = table.columns.iter().enumerate().filter_map(|(k, c)| Some((k, name_of(c)?))).collect();
    let (shown, zero): (Vec<_>, Vec<_>) = found.into_iter().partition(|(column, _)| !table.is_zero(*column));
    if shown.is_empty() {
        return None;
    }
    let mut remarks = Vec::new();
    if shown.len() > CURVES_MAX {
        remarks.push(format!("{} more in the history file", shown.len() - CURVES_MAX));
    }
    if !zero.is_empty() {
        remarks.push(format!("zero throughout: {}", zero.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>().join(", ")));
    }
    let curve = |(index, (column, name)): (usize, (usize, String))| Curve {
        name,
        colour: DISTINCT[index % DISTINCT.len()],
        dashes: if index < DISTINCT.len() { "" } else { "6 4" },
        width: 1.6,
        points: table.points(column),
    };
    let curves: Vec<Curve> = shown.into_iter().take(CURVES_MAX).enumerate().map(curve).collect();
    let height = 170.0 + 16.0 * curves.len().saturating_sub(5) as f64;
    Some(Panel { name: name.into(), si, from_zero: si != "m", height, curves, remark: remarks.join("; ") })
}
