//! Plots of the history: `energy.svg` and `history.svg`.
//! Columns and rows are those of `history.csv`; this file chooses and names curves, `svg` draws them.

use super::colour::{DISTINCT, Rgb, TEXT};
use super::svg::{Curve, Group, Panel, chart};
use super::{PictureError, write_whole};
use std::path::Path;

/// Writes `energy.svg` (all energies of the whole model over time) and `history.svg` (probe positions and
/// forces of contacts and obstacles, in panels over one time axis) into `folder`.
///
/// `columns`: names as in `history.csv`, one of them `time` (else the first is the time); `rows`: one value
/// per column, SI. Values that are not finite leave gaps; missing columns leave a plot without curves.
/// Energies and forces are per metre of depth, `of_whole_bodies` those of whole bodies.
///
/// # Errors
/// [`PictureError::Io`] if a file can't be written.
pub fn plots(columns: &[String], rows: &[Vec<f64>], title: &str, of_whole_bodies: bool, folder: &Path) -> Result<(), PictureError> {
    let [energy, history] = charts(columns, rows, title, of_whole_bodies);
    write_text(&folder.join("energy.svg"), &energy)?;
    write_text(&folder.join("history.svg"), &history)
}

/// The same two as texts of SVG files.
pub(crate) fn charts(columns: &[String], rows: &[Vec<f64>], title: &str, of_whole_bodies: bool) -> [String; 2] {
    let table = Table { columns, rows, of_whole_bodies };
    [("energy", vec![energy(&table)]), ("history", history(&table))]
        .map(|(what, panels)| chart(&titled(title, what), &[Group::over_time(panels)]))
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
    of_whole_bodies: bool,
}

impl Table<'_> {
    /// Time and the column's value in each row.
    fn points(&self, column: usize) -> Vec<[f64; 2]> {
        let time = self.columns.iter().position(|name| name == "time").unwrap_or(0);
        let value = |row: &[f64], k: usize| row.get(k).copied().unwrap_or(f64::NAN);
        self.rows.iter().map(|row| [value(row, time), value(row, column)]).filter(|p| p[0].is_finite()).collect()
    }

    fn is_zero(&self, column: usize) -> bool {
        self.largest(column) == 0.0
    }

    /// Largest size of a column's values; those that are not finite don't count.
    fn largest(&self, column: usize) -> f64 {
        self.values(column).fold(0.0, |largest, v| largest.max(v.abs()))
    }

    /// Smallest and largest value of a column.
    fn range(&self, column: usize) -> [f64; 2] {
        self.values(column).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
    }

    /// Whether a contact acts although its force is zero: that of one between many bodies is the sum of pairs
    /// of opposite forces.
    fn cancels(&self, contact: &str) -> bool {
        let kinds = ["energy", "penetration"].map(|kind| format!("contact.{kind}[{contact}]"));
        self.columns.iter().enumerate().any(|(column, name)| kinds.contains(name) && !self.is_zero(column))
    }

    fn values(&self, column: usize) -> impl Iterator<Item = f64> {
        self.rows.iter().filter_map(move |row| row.get(column).copied()).filter(|v| v.is_finite())
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
        curves.push(Curve { name: name.replace('_', " "), colour, dashes, width, dots: false, points: table.points(column) });
    }
    let remark = if zero.is_empty() { String::new() } else { format!("zero throughout: {}", zero.join(", ")) };
    let si = if table.of_whole_bodies { "J" } else { "J/m" };
    Panel { name: "energy".into(), si, from_zero: true, height: 380.0, curves, remark }
}

/// Curves in one panel; more would be a carpet.
const CURVES_MAX: usize = 9;

/// Components smaller than this beside the largest of their kind are round-off and not shown.
const ROUND_OFF: f64 = 1e-9;
/// Probes that move less than this fraction of the distances between them are shown by their displacements:
/// their positions would be flat lines.
const FLAT: f64 = 0.05;

/// One quantity of probes, contacts or obstacles: its columns, with the names of their curves, by axis (z,
/// then y first: the direction in which most things fall).
struct Quantity {
    name: &'static str,
    si: &'static str,
    axes: [Vec<(usize, String)>; 3],
    /// Whether curves show the change since the first row.
    from_start: bool,
}

const AXES: [&str; 3] = ["z", "y", "x"];

/// A panel for each kind of quantity that the history holds.
fn history(table: &Table<'_>) -> Vec<Panel> {
    let columns = |name_of: &dyn Fn(&str) -> Option<String>| -> Vec<(usize, String)> {
        table.columns.iter().enumerate().filter_map(|(k, column)| Some((k, name_of(column)?))).collect()
    };
    let positions = AXES.map(|axis| {
        columns(&|name| {
            let probe = name.strip_suffix(axis)?.strip_suffix('.')?;
            (!probe.is_empty() && !probe.starts_with("energy") && !probe.starts_with("contact.force")).then(|| probe.to_string())
        })
    });
    let forces = AXES.map(|axis| {
        let prefixes = ["contact", "obstacle"].map(|kind| format!("{kind}.force_{axis}["));
        let own = |name: &str| Some(prefixes.iter().find_map(|prefix| name.strip_prefix(prefix))?.strip_suffix(']')?.to_string());
        columns(&|name| {
            let own = own(name)?;
            // A contact and an obstacle of the same name.
            let is_twin = prefixes.iter().all(|prefix| table.columns.contains(&format!("{prefix}{own}]")));
            Some(if is_twin && name.starts_with("obstacle") { format!("{own} (obstacle)") } else { own })
        })
    });
    let from_start = is_flat(table, &positions);
    let name = if from_start { "displacement" } else { "position" };
    let quantities = [
        Quantity { name, si: "m", axes: positions, from_start },
        Quantity { name: "contact force", si: if table.of_whole_bodies { "N" } else { "N/m" }, axes: forces, from_start: false },
    ];
    let mut panels: Vec<Panel> = quantities.iter().flat_map(|quantity| quantity.panels(table)).collect();
    if panels.is_empty() {
        let names = quantities[1].axes.iter().flatten().map(|(_, name)| name);
        let contacts = if names.into_iter().any(|name| table.cancels(name)) {
            "the forces of each contact cancel in its sum"
        } else {
            "no contact acts"
        };
        let has_probes = quantities[0].axes.iter().any(|axis| !axis.is_empty());
        let remark = if has_probes { format!("no probe moves; {contacts}") } else { format!("there is no probe; {contacts}") };
        panels.push(Panel { name: "history".into(), si: "", from_zero: false, height: 170.0, curves: Vec::new(), remark });
    }
    panels
}

/// Whether no probe moves by more than a small part of the range that the positions of all span.
fn is_flat(table: &Table<'_>, positions: &[Vec<(usize, String)>; 3]) -> bool {
    let (mut span, mut motion) = (0.0_f64, 0.0_f64);
    for axis in positions {
        let mut all = [f64::INFINITY, f64::NEG_INFINITY];
        for [low, high] in axis.iter().map(|(column, _)| table.range(*column)) {
            all = [all[0].min(low), all[1].max(high)];
            motion = motion.max(high - low);
        }
        span = span.max(all[1] - all[0]);
    }
    motion > 0.0 && motion < FLAT * span
}

impl Quantity {
    /// One panel per axis; none for an axis without columns or with nothing but zeros.
    fn panels(&self, table: &Table<'_>) -> Vec<Panel> {
        let size = |column: usize| if self.from_start { motion(table, column) } else { table.largest(column) };
        let largest = self.axes.iter().flatten().map(|(column, _)| size(*column)).fold(0.0, f64::max);
        let is_shown = |column: usize| size(column) > ROUND_OFF * largest;
        let of_axis = |(axis, found): (&str, &Vec<(usize, String)>)| {
            let (shown, zero): (Vec<_>, Vec<_>) = found.iter().partition(|(column, _)| is_shown(*column));
            (!shown.is_empty()).then(|| self.panel(table, axis, &shown, &zero))
        };
        AXES.into_iter().zip(&self.axes).filter_map(of_axis).collect()
    }

    fn panel(&self, table: &Table<'_>, axis: &str, shown: &[&(usize, String)], zero: &[&(usize, String)]) -> Panel {
        let mut remarks = Vec::new();
        if shown.len() > CURVES_MAX {
            remarks.push(format!("{} more in the history file", shown.len() - CURVES_MAX));
        }
        let (cancel, zero): (Vec<_>, Vec<_>) = zero.iter().copied().partition(|(_, name)| self.si != "m" && table.cancels(name));
        for (what, found) in [("forces cancel in the sum", cancel), ("zero throughout", zero)] {
            if !found.is_empty() {
                remarks.push(format!("{what}: {}", found.iter().map(|(_, name)| name.as_str()).collect::<Vec<_>>().join(", ")));
            }
        }
        let points = |column: usize| {
            let mut points = table.points(column);
            if self.from_start {
                let first = table.values(column).next().unwrap_or(0.0);
                points.iter_mut().for_each(|point| point[1] -= first);
            }
            points
        };
        let curve = |(index, (column, name)): (usize, &&(usize, String))| Curve {
            name: name.clone(),
            colour: DISTINCT[index % DISTINCT.len()],
            dashes: if index < DISTINCT.len() { "" } else { "6 4" },
            width: 1.6,
            dots: false,
            points: points(*column),
        };
        let curves: Vec<Curve> = shown.iter().take(CURVES_MAX).enumerate().map(curve).collect();
        let height = 170.0 + 16.0 * curves.len().saturating_sub(5) as f64;
        let from_zero = self.from_start || self.si != "m";
        Panel { name: format!("{} {axis}", self.name), si: self.si, from_zero, height, curves, remark: remarks.join("; ") }
    }
}

/// Distance between the smallest and the largest value of a column; zero without values.
fn motion(table: &Table<'_>, column: usize) -> f64 {
    let [low, high] = table.range(column);
    (high - low).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_of(columns: &[&str], rows: &[Vec<f64>]) -> Vec<String> {
        let columns: Vec<String> = columns.iter().map(ToString::to_string).collect();
        history(&Table { columns: &columns, rows, of_whole_bodies: false }).into_iter().map(|panel| panel.name).collect()
    }

    #[test]
    fn round_off_gets_no_panel() {
        let columns = ["time", "A.x", "A.y", "contact.force_x[c]", "contact.force_y[c]"];
        let rows: Vec<Vec<f64>> = (0..9).map(f64::from).map(|t| vec![t, 1e-17 * t, 0.1 * t, 1e3 * t, 1e-8 * t]).collect();
        assert_eq!(names_of(&columns, &rows), ["position y", "contact force x"]);
    }

    #[test]
    fn a_contact_whose_forces_cancel_is_not_said_to_be_idle() {
        let columns: Vec<String> = ["time", "contact.force_x[all]", "contact.energy[all]"].map(String::from).into();
        let of = |energy: f64| {
            let rows: Vec<Vec<f64>> = (0..9).map(f64::from).map(|t| vec![t, 0.0, energy * t]).collect();
            history(&Table { columns: &columns, rows: &rows, of_whole_bodies: false }).remove(0).remark
        };
        assert_eq!(of(0.0), "there is no probe; no contact acts");
        assert_eq!(of(2.0), "there is no probe; the forces of each contact cancel in its sum");
    }

    #[test]
    fn what_continues_along_z_is_shown_in_3d() {
        let columns = ["time", "A.x", "A.y", "A.z", "contact.force_z[c]"];
        let rows: Vec<Vec<f64>> = (0..9).map(f64::from).map(|t| vec![t, 0.0, 0.1 * t, -0.2 * t, 1e3 * t]).collect();
        assert_eq!(names_of(&columns, &rows), ["position z", "position y", "contact force z"]);
    }

    #[test]
    fn obstacles_are_shown_beside_contacts() {
        let columns = ["time", "contact.force_y[a]", "obstacle.force_y[floor]", "obstacle.force_y[a]", "obstacle.force_x[floor]"];
        let columns: Vec<String> = columns.iter().map(ToString::to_string).collect();
        let rows: Vec<Vec<f64>> = (0..9).map(f64::from).map(|t| vec![t, t, 2.0 * t, 3.0 * t, 0.0]).collect();
        let panels = history(&Table { columns: &columns, rows: &rows, of_whole_bodies: false });
        let curves: Vec<&str> = panels[0].curves.iter().map(|curve| curve.name.as_str()).collect();
        assert_eq!((panels.len(), panels[0].name.as_str()), (1, "contact force y"));
        assert_eq!(curves, ["a", "floor", "a (obstacle)"]);
    }

    #[test]
    fn probes_that_hardly_move_are_shown_by_their_displacement() {
        let columns = ["time", "A.x", "A.y", "B.x", "B.y"];
        let rows: Vec<Vec<f64>> = (0..9).map(f64::from).map(|t| vec![t, -1.0, 2.0, 1.0 + 1e-4 * t, 2.0]).collect();
        assert_eq!(names_of(&columns, &rows), ["displacement x"]);
        let moved: Vec<Vec<f64>> = (0..9).map(f64::from).map(|t| vec![t, -1.0, 2.0, 1.0 + t, 2.0]).collect();
        assert_eq!(names_of(&columns, &moved), ["position y", "position x"]);
        assert_eq!(names_of(&columns, &rows[..1]), ["position y", "position x"], "one row has no displacement");
    }
}
