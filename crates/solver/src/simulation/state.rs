//! The state of a run: handed out as bytes, and taken over by a simulation that is made again of the same
//! model.

use super::Runs;
use super::output_cursor::OutputCursor;
use super::run::Run;
use crate::archive::{Archive, ArchiveResult, Persist, Section, persist_each};
use crate::error::Error;
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
            recorded: _, threads: _, model_warnings: _, warnings: _, history: _, fields: _, max_steps: _, state_steps: _, hash_steps: _, hashing: _, search_names: _, pool: _,
            memory: _, tracer: _,
            system, momentum, shortest, monitor, output_cursor,
        } = self;
        archive.section("run")?;
        shortest.persist(archive)?;
        monitor.persist(archive)?;
        let mut so_far = output_cursor.unwrap_or_else(|| OutputCursor::new(system.step));
        so_far.persist(archive)?;
        if archive.reads() {
            *output_cursor = Some(so_far);
        }
        let mut has_momentum = momentum.is_some();
        persist_each!(archive; &mut has_momentum);
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
        let mut archive = Archive::new();
        self.persist(&mut archive)?;
        Ok(State { step: self.steps(), time: self.time(), sections: archive.finish()? })
    }

    /// Takes over the state of another one of the same model.
    ///
    /// # Errors
    /// [`Error::State`] where the state is of another model.
    pub(crate) fn take_over(&mut self, sections: &[Section]) -> Result<(), Error> {
        let mut archive = Archive::of(sections);
        self.persist(&mut archive)?;
        archive.finish()?;
        Ok(())
    }
}
