//! Title, time and the like of a deck.

use super::Importer;
use super::report::Outcome::{Approximated, Ignored, Used};
use crate::abaqus::messages::NO_COUNTERPART;
use embate_solver::error::Fault;

pub(super) fn heading(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    if let Some(line) = importer.block(at).data.first() {
        importer.title = importer.text.line(*line).trim().to_string();
    }
    Ok(())
}

pub(super) fn step(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    importer.steps += 1;
    importer.step_at.get_or_insert(at);
    if importer.steps > 1 {
        importer.note(at, Ignored, "a second step; the run ends with the first");
        return Ok(());
    }
    if importer.block(at).is("NLGEOM", "NO") {
        importer.approximated(at, "NLGEOM=NO: embate always computes large displacements");
    }
    if importer.block(at).has("INC") {
        importer.approximated(at, "INC: the number of steps follows from the time step (`run.max_steps` limits it)");
    }
    Ok(())
}

pub(super) fn dynamic(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let numbers = importer.first_numbers(at, "a time")?;
    let end = importer.needed(at, &numbers, 1, "the time period, its second number")?;
    importer.end = Some(end);
    if !importer.block(at).has("EXPLICIT") {
        importer.note(
            at,
            Approximated,
            "an implicit step; it is computed explicitly over the same time, with a time step that follows from the elements",
        );
    } else if ["DIRECT", "ELEMENT BY ELEMENT", "FIXED TIME INCREMENTATION"].iter().any(|name| importer.block(at).has(name)) {
        importer.approximated(
            at,
            "the time step is not the one that it asks for: embate's follows from the elements (`run.time_step` limits it)",
        );
    }
    Ok(())
}

pub(super) fn bulk_viscosity(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let numbers = importer.first_numbers(at, "a coefficient of bulk viscosity")?;
    importer.bulk_viscosity = Some([numbers.first().copied().flatten().unwrap_or(0.06), numbers.get(1).copied().flatten().unwrap_or(1.2)]);
    importer.note(at, Used, "`run.bulk_viscosity`");
    Ok(())
}

/// Leaving these out would make another model.
pub(super) fn refused(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let (why, help) = match block.keyword.as_str() {
        "TRANSFORM" => {
            ("conditions would act in axes that embate doesn't have", "write them in x and y, or take [[symmetry]] for a skew line")
        }
        _ => (
            "nodes would move apart that belong together",
            "tie surfaces with *TIE, or join coinciding nodes in the mesh; remove it and add [[join]] to the model",
        ),
    };
    Err(importer.text.fault(&NO_COUNTERPART, block.line, format!("*{} has no counterpart: {why}", block.keyword), help))
}
