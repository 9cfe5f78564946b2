//! The energy balance of a run: energies at its beginning and end, how well they balance, and their plot.

use super::Left;
use super::html::{self, paragraph, plot, table};
use super::pictures::plots;
use crate::post_mortem::shown;

/// A residual below this is rounding.
const ROUNDING: f64 = 1e-9;
/// Energies below this fraction of the largest one are shown as zero.
const ROUND_OFF: f64 = 1e-14;

fn rows(left: &Left) -> Vec<Vec<String>> {
    let Some(history) = &left.history else { return Vec::new() };
    let si = if left.is_of_whole_bodies { "J" } else { "J/m" };
    // Below this they are rounding.
    let energies =
        || history.columns.iter().zip(&history.values).filter(|(column, _)| column.starts_with("energy.") && !column.contains('['));
    let largest =
        energies().flat_map(|(_, values)| values).filter(|value| value.is_finite()).fold(0.0, |most: f64, value| most.max(value.abs()));
    let shown = |value: f64, si: &str| shown(if value.abs() < ROUND_OFF * largest { 0.0 } else { value }, si);
    let whole = history.columns.iter().zip(&history.values).filter_map(|(column, values)| {
        let name = column.strip_prefix("energy.").filter(|name| !name.contains('['))?;
        let [first, last] = [*values.first()?, *values.last()?];
        // What is zero throughout says nothing.
        let is_there = values.iter().any(|value| *value != 0.0);
        is_there.then(|| [name.replace('_', " "), shown(first, si), shown(last, si), shown(last - first, si)].to_vec())
    });
    whole.collect()
}

/// How well the ledger balance.
fn balance(left: &Left) -> String {
    let mut text = String::new();
    if let Some(residual) = left.number("ledger_residual") {
        let verdict = if residual.abs() < ROUNDING {
            "no more than rounding"
        } else {
            "more than rounding: a fault of the program, please report it"
        };
        text += &paragraph(&format!(
            "The works of all forces and the change of kinetic energy differ by {residual:.1e} of the largest total \
                energy at most (ledger residual): {verdict}."
        ));
    }
    if let Some(drift) = left.number("energy_drift") {
        text += &paragraph(&format!(
            "What the forces took is found again in the energies to {:.2e} % of the largest total energy (energy \
                drift): the error of the steps in time.",
            100.0 * drift
        ));
    }
    if text.is_empty() { paragraph("How well the energy balance closes is known at the end of the run.") } else { text }
}

pub(super) fn section(left: &Left) -> String {
    let head = ["energy", "at the beginning", "at the end", "change"];
    let head = if left.summary.is_some() { head } else { ["energy", "at the beginning", "now", "change"] };
    let mut body = table(&head, &rows(left), 1);
    if body.is_empty() {
        body = paragraph("The history has no energies yet.");
    }
    body += &balance(left);
    if let Some([svg, _]) = plots(left) {
        body += &plot(
            &svg,
            "Energies over time: a curve for each kind, named at its end",
            "Total: kinetic and stored energies and all losses, less the work from outside. It should stay as it is.",
        );
    }
    html::section("Energies", &body)
}
