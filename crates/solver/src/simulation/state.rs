//! The state of a run: handed out as bytes, and taken over by a simulation that is made again of the same
//! model.

use super::output_cursor::OutputCursor;
use super::run::Run;
use super::{Options, Runs};
use crate::archive::{Archive, ArchiveResult, Persist, Section, persist_each};
use crate::error::Error;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::tensor::Dim;

/// All that a simulation of the same model needs to continue as if nothing had happened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Steps done.
    pub step: u64,
    /// Time reached, s.
    pub time: f64,
    /// What is to be kept, byte by byte.
    pub sections: Vec<Section>,
}

impl<const D: usize> Persist for Run<D>
where
    Dim<D>: Runs<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        #[rustfmt::skip]
        let Self {
            threads: _, model_warnings: _, warnings: _, history: _, fields: _, max_steps: _, state_steps: _, hash_steps: _, hashing: _, search_names: _, pool: _,
            known_cells: _, memory: _, tracer: _, remesher: _, known_parts: _, contact_lines: _,
            system, recorded, momentum, shortest, monitor, output_cursor, is_steered,
        } = self;
        archive.section("run")?;
        recorded.persist(archive)?;
        shortest.persist(archive)?;
        monitor.persist(archive)?;
        let mut so_far = output_cursor.unwrap_or_else(|| OutputCursor::new(system.step));
        so_far.persist(archive)?;
        if archive.reads() {
            *output_cursor = Some(so_far);
        }
        let mut has_momentum = momentum.is_some();
        persist_each!(archive; is_steered, &mut has_momentum);
        archive.check(!has_momentum || momentum.is_some(), "momentum is kept in it and not in the model")?;
        if !has_momentum {
            // Somebody pushed the bodies.
            *momentum = None;
        }
        if let Some(momentum) = momentum {
            momentum.persist(archive)?;
        }
        system.persist(archive)
    }
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// The state now, between two steps.
    ///
    /// # Errors
    /// None that a state which is there can have; what is written is checked as what is read.
    pub(crate) fn state(&mut self) -> Result<State, Error> {
        let mut sections = self.system.mesh.section()?;
        let mut archive = Archive::new();
        self.persist(&mut archive)?;
        sections.extend(archive.finish()?);
        Ok(State { step: self.steps(), time: self.time(), sections })
    }

    /// A run of a model: at its start, or resumed in a state.
    ///
    /// # Errors
    /// Those of [`Run::new`] or [`Run::resumed`].
    pub(crate) fn made(model: &Model, options: &Options, state: Option<&[Section]>) -> Result<Self, Error> {
        state.map_or_else(|| Self::new(model, options), |sections| Self::resumed(model, options, sections))
    }

    /// A run of a model in the state of another one of the same model.
    ///
    /// # Errors
    /// Those of [`Run::new`]; [`Error::State`] where the state is of another model.
    pub(crate) fn resumed(model: &Model, options: &Options, sections: &[Section]) -> Result<Self, Error> {
        let (mesh, sections) = Mesh::of_state(sections)?;
        let is_meshed_again = mesh.as_ref().is_some_and(|mesh| !mesh.remeshed.is_empty());
        let mut run = Self::on(model, mesh, options)?;
        if is_meshed_again {
            // What is said of a model is said of its own mesh, and momenta change from those of its own
            // start.
            let start = Self::on(model, None, options)?;
            (run.model_warnings, run.warnings, run.momentum) = (start.model_warnings, start.warnings, start.momentum);
            run.system.initial_penetrations = start.system.initial_penetrations;
        }
        let mut archive = Archive::of(sections);
        run.persist(&mut archive)?;
        archive.finish()?;
        Ok(run)
    }
}

#[cfg(all(test, feature = "whole-runs"))]
mod tests;
