//! Columns of the history, by what they are of: one file a group, one line in [`of_system`].
//!
//! A column is a value at a time (a *sample*), or a mean over the interval between two rows: what is rough
//! would be missed between two samples. The mean of a force or moment is Σ f Δt / Σ Δt over the steps of the
//! interval, with the Δt of the velocity updates, so that a mean force times the interval is the impulse; the
//! mean of an acceleration is the *change* of v^{n+½} over the interval by the same time.

mod bodies;
mod conditions;
mod contacts;
mod energies;
mod probes;
mod sections;

pub(super) use probes::Probes;

use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::error::{Fault, Warning};
use crate::field::NodeFields;
use crate::model::Model;
use crate::step::System;
use crate::tensor::Dim;

/// Axes of the components of a vector.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// A column of the history.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(crate) kind: Kind,
}

/// What rows have of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The value at their time.
    Sample,
    /// The mean over their interval.
    Mean,
    /// The change of a level over their interval by its time.
    Change,
}

/// Columns that have a sample.
fn samples(names: impl IntoIterator<Item = String>) -> impl Iterator<Item = Column> {
    names.into_iter().map(|name| Column { name, kind: Kind::Sample })
}

/// Columns that have a mean.
fn means(names: impl IntoIterator<Item = String>) -> impl Iterator<Item = Column> {
    names.into_iter().map(|name| Column { name, kind: Kind::Mean })
}

/// Columns that have a change.
fn changes(names: impl IntoIterator<Item = String>) -> impl Iterator<Item = Column> {
    names.into_iter().map(|name| Column { name, kind: Kind::Change })
}

/// A group of columns.
pub(crate) trait Channel<const D: usize>: Send + Sync
where
    Dim<D>: Dimension<D>,
{
    /// Its columns. Each of the other functions adds values of those of one kind, in their order.
    fn columns(&self, system: &System<D>) -> Vec<Column>;
    /// Adds values now of columns with a sample.
    fn samples(&self, _system: &System<D>, _row: &mut Vec<f64>) {}
    /// Adds values in the last update of columns with a mean, after every step.
    fn rates(&self, _system: &System<D>, _row: &mut Vec<f64>) {}
    /// Adds levels before and after the last update of columns with a change.
    fn levels(&self, _system: &System<D>, _levels: &mut Vec<[f64; 2]>) {}
    /// What the user should know of its columns, once forces at time zero are known.
    fn warnings(&self, _system: &System<D>) -> Vec<Warning> {
        Vec::new()
    }
    /// Contacts that push now across cuts, whose forces have nothing of them.
    fn pushing(&self, _system: &System<D>) -> Vec<Pushing> {
        Vec::new()
    }
}

/// A contact that pushes across the plane of a cut.
pub(crate) struct Pushing {
    /// Number of the cut.
    pub(crate) index: usize,
    /// Names of both.
    pub(crate) cut: String,
    pub(crate) contact: String,
}

/// All groups of a system.
///
/// # Errors
/// Cuts and probes of nothing.
pub(super) fn of_system<const D: usize>(model: &Model, system: &System<D>, probes: Probes) -> Result<Vec<Box<dyn Channel<D>>>, Vec<Fault>>
where
    Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
{
    let mut channels: Vec<Box<dyn Channel<D>>> =
        vec![Box::new(energies::Energies), Box::new(contacts::Contacts::new(model, system)), Box::new(bodies::Bodies)];
    channels.extend(conditions::of_system(model, system));
    channels.push(Box::new(sections::Sections::new(model, system)?));
    channels.push(Box::new(probes));
    Ok(channels)
}

/// Names of the components of forces.
fn forces<const D: usize>() -> &'static [&'static str] {
    &["force_x", "force_y", "force_z"][..D]
}

/// Components of a moment that the dimension has: in 2D that about z alone.
fn moment<const D: usize>(moment: [f64; 3]) -> impl Iterator<Item = f64> {
    moment.into_iter().skip(if D == 2 { 2 } else { 0 })
}
