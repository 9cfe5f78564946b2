//! Curves of a post-mortem: what became of the failure location and of all energies over the last steps.
//!
//! Values come from the trace; [`crate::picture::svg`] draws them.

use crate::picture::colour::{DISTINCT, Rgb, TEXT};
use crate::picture::svg::{Abscissa, Curve, Group, Panel, Spacing, chart};
use embate_solver::post_mortem::{MassNeeded, Moment, Trace, Vitals};

/// Panels over the steps before a failure.
fn over_steps(title: &str, panels: Vec<Panel>) -> Option<String> {
    let panels: Vec<Panel> = panels.into_iter().filter(|panel| !panel.curves.is_empty()).collect();
    if panels.is_empty() {
        return None;
    }
    let abscissa = Abscissa { name: "step, from the one that failed".into(), si: String::new(), spacing: Spacing::Even };
    Some(chart(title, &[Group { abscissa, panels }]))
}

fn curve(name: &str, colour: Rgb, points: Vec<[f64; 2]>) -> Curve {
    Curve { name: name.into(), colour, dashes: "", width: 1.8, dots: false, points }
}

/// A panel of the curves that have two values and change or are not zero.
fn panel(name: &str, si: &'static str, from_zero: bool, curves: Vec<Curve>) -> Panel {
    let is_shown = |curve: &Curve| {
        let values = || curve.points.iter().map(|p| p[1]).filter(|v| v.is_finite());
        // Strains smaller than this are rounding.
        let nothing = if si.is_empty() { 1e-12 } else { 0.0 };
        values().count() > 1 && values().any(|value| value.abs() > nothing)
    };
    let curves: Vec<Curve> = curves.into_iter().filter(is_shown).collect();
    let height = 130.0 + 14.0 * curves.len().saturating_sub(4) as f64;
    Panel { name: name.into(), si, from_zero, height, curves, remark: String::new() }
}

/// The failure location's step, shape, strains, stresses, energy, speed and contact; `None` where there are
/// no two steps.
pub(super) fn failure_location(title: &str, trace: &Trace, failed: u64, is_of_whole_bodies: bool) -> Option<String> {
    let of = |value: &dyn Fn(&Vitals) -> f64| -> Vec<[f64; 2]> {
        trace.moments.iter().map(|moment| [moment.step as f64 - failed as f64, value(&moment.vitals)]).collect()
    };
    let one = |name: &str, si: &'static str, from_zero: bool, value: &dyn Fn(&Vitals) -> f64| {
        panel(name, si, from_zero, vec![curve("", DISTINCT[0], of(value))])
    };
    let panels = vec![
        one("stable step of the element", "s", true, &|v| v.time_step),
        panel(
            "shape at the worst corner (1: square, below 0: folded over) and size (over that at the start)",
            "",
            true,
            vec![curve("shape", DISTINCT[1], of(&|v| v.shape)), curve("size", DISTINCT[0], of(&|v| v.area_ratio))],
        ),
        panel(
            "strain",
            "",
            true,
            vec![
                curve("largest", DISTINCT[1], of(&|v| v.strains[0])),
                curve("smallest", DISTINCT[0], of(&|v| v.strains[1])),
                curve("plastic", DISTINCT[4], of(&|v| v.plastic_strain)),
            ],
        ),
        panel(
            "stress",
            "Pa",
            true,
            vec![curve("von Mises", DISTINCT[1], of(&|v| v.von_mises)), curve("pressure", DISTINCT[0], of(&|v| v.pressure))],
        ),
        one("elastic energy by volume", "J/m^3", true, &|v| v.energy_density),
        one("speed", "m/s", true, &|v| v.speed),
        one("contact force", if is_of_whole_bodies { "N" } else { "N/m" }, true, &|v| v.contact_force),
        one("depth of the contact", "m", true, &|v| v.penetration),
        one("temperature", "K", false, &|v| v.temperature),
        one("damage", "", true, &|v| v.damage),
    ];
    (trace.moments.len() > 1).then(|| over_steps(title, panels)).flatten()
}

/// Columns of energies of the whole model with their colours.
const WHOLE: [(&str, Rgb); 9] = [
    ("kinetic", DISTINCT[0]),
    ("internal", DISTINCT[1]),
    ("hourglass", DISTINCT[5]),
    ("contact", DISTINCT[2]),
    ("friction", DISTINCT[4]),
    ("contact_damping", DISTINCT[6]),
    ("damping", DISTINCT[6]),
    ("external", DISTINCT[3]),
    ("total", TEXT),
];
/// Curves of parts and contacts in one panel.
const MOST: usize = 6;

/// All energies, how much the sum of all is off, and the energies of parts and contacts that changed most;
/// `None` where there are no two steps.
pub(super) fn energies(title: &str, trace: &Trace, failed: u64, is_of_whole_bodies: bool) -> Option<String> {
    let si = if is_of_whole_bodies { "J" } else { "J/m" };
    let closed: Vec<&Moment> = trace.moments.iter().filter(|moment| !moment.row.is_empty()).collect();
    let of = |column: usize, from: f64| -> Vec<[f64; 2]> {
        closed.iter().map(|moment| [moment.step as f64 - failed as f64, moment.row[column] - from]).collect()
    };
    let column = |name: &str| trace.columns.iter().position(|own| own == name);
    let first = closed.first()?;
    let whole = WHOLE
        .iter()
        .filter_map(|(name, colour)| Some(curve(&name.replace('_', " "), *colour, of(column(&format!("energy.{name}"))?, 0.0))))
        .collect();
    let total = column("energy.total");
    let off = total.map(|total| curve("", TEXT, of(total, first.row[total]))).into_iter().collect();
    let mut changes: Vec<(f64, usize)> = changes(trace, [0, closed.len() - 1]);
    changes.truncate(MOST);
    let shown = |(k, (_, column)): (usize, &(f64, usize))| {
        curve(&in_words(&trace.columns[*column]), DISTINCT[k % DISTINCT.len()], of(*column, first.row[*column]))
    };
    let panels = vec![
        panel("energies of the whole model", si, true, whole),
        panel("sum of all energies less the work from outside: change over these steps, should be zero", si, true, off),
        panel("energies of parts and contacts: change over these steps", si, true, changes.iter().enumerate().map(shown).collect()),
    ];
    (closed.len() > 1).then(|| over_steps(title, panels)).flatten()
}

/// By how much each energy of a part or contact changed between two of the steps whose ledger is closed, the
/// largest change first: change, column.
pub(super) fn changes(trace: &Trace, [from, to]: [usize; 2]) -> Vec<(f64, usize)> {
    let closed: Vec<&Moment> = trace.moments.iter().filter(|moment| !moment.row.is_empty()).collect();
    let (Some(from), Some(to)) = (closed.get(from), closed.get(to)) else { return Vec::new() };
    let is_own = |name: &str| {
        name.ends_with(']') && (name.starts_with("energy.kinetic[") || name.starts_with("energy.internal[") || name.contains(".energy["))
    };
    let own =
        trace.columns.iter().enumerate().filter(|(_, name)| is_own(name)).map(|(column, _)| (to.row[column] - from.row[column], column));
    let mut changes: Vec<(f64, usize)> = own.filter(|(change, _)| change.is_finite() && *change != 0.0).collect();
    changes.sort_by(|(a, _), (b, _)| b.abs().total_cmp(&a.abs()));
    changes
}

/// `energy.kinetic[bar]` as `kinetic, bar`.
pub(super) fn in_words(column: &str) -> String {
    let (what, name) = column.trim_end_matches(']').split_once('[').unwrap_or((column, ""));
    match what.strip_prefix("energy.") {
        Some(energy) => format!("{energy}, {name}"),
        None => format!("{} {name}", what.trim_end_matches(".energy")),
    }
}

/// Mass that is needed over the step that is asked for.
pub(super) fn mass(title: &str, needed: &MassNeeded) -> String {
    let (asked, limit, longest) = (needed.scaling.time_step, needed.scaling.limit, needed.longest());
    let last = 1.1 * asked;
    let points = (0..=120).map(|k| last * f64::from(k) / 120.0).map(|step| [step, 100.0 * needed.share(step)]).collect();
    let dot = |name: &str, colour: Rgb, at: [f64; 2]| Curve { dots: true, width: 0.0, ..curve(name, colour, vec![at]) };
    let line = Curve { dashes: "6 4", ..curve("limit", DISTINCT[6], vec![[0.0, 100.0 * limit], [last, 100.0 * limit]]) };
    let curves = vec![
        curve("needed", DISTINCT[0], points),
        line,
        dot("asked for", DISTINCT[1], [asked, 100.0 * needed.share(asked)]),
        dot("within the limit", DISTINCT[2], [longest, 100.0 * needed.share(longest)]),
    ];
    let name = "mass that must be added, % of that of the deformable parts".into();
    let panel = Panel { name, si: "", from_zero: true, height: 260.0, curves, remark: String::new() };
    let abscissa = Abscissa { name: "time step that every element shall allow".into(), si: "s".into(), spacing: Spacing::Even };
    chart(title, &[Group { abscissa, panels: vec![panel] }])
}
