//! A stretch of two runs gone over once more, side by side in memory: each from its nearest state, with its
//! own model, threads and instruction set.

use crate::checkpoint::{self, Identity};
use crate::threads::Threads;
use embate_solver::divergence::{Divergence, Pairing};
use embate_solver::error::Error;
use embate_solver::hashes::Hashes;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::path::Path;

/// Steps between two calls that say how far it is.
const PIECE: u64 = 500;

/// A run that is gone over once more.
pub struct Again {
    /// Where it stands.
    pub simulation: Simulation,
    /// Step of the state that it began from.
    pub begun: u64,
}

impl Again {
    /// A run ready at its state nearest before `step`: that of a checkpoint in its folder, or the start.
    ///
    /// # Errors
    /// Those of a simulation.
    pub fn new(model: &Model, options: &Options, results: &Path, step: u64) -> Result<Self, Error> {
        // What was run beyond, and by how many steps, is known: nothing shall end it before.
        let mut model = model.clone();
        (model.run.max_steps, model.run.checkpoint, model.run.checkpoint_steps) = (None, None, None);
        let found = checkpoint::newest(results, &Threads::new(options.thread_count()), |generation| generation.step <= step);
        let is_of_model = |identity: &Identity| Identity::of(&model).differences_in_steps(identity).is_empty();
        let simulation = match found {
            Ok((checkpoint, _)) if is_of_model(&checkpoint.identity) => Simulation::resumed(&model, options, &checkpoint.state.sections)?,
            _ => Simulation::new(&model, options)?,
        };
        Ok(Self { begun: simulation.steps(), simulation })
    }

    /// Continues to a step, if the run does not end before.
    ///
    /// # Errors
    /// Those of a step.
    pub fn go_to(&mut self, step: u64, mut on_step: impl FnMut(u64)) -> Result<(), Error> {
        while self.simulation.steps() < step && !self.simulation.is_over() {
            on_step(self.simulation.steps());
            self.simulation.advance(f64::INFINITY, PIECE.min(step - self.simulation.steps()))?;
        }
        Ok(())
    }

    /// Whether it comes to what its log says of this step; true where it says nothing.
    #[must_use]
    pub fn repeats(&self, logged: Option<&Hashes>) -> bool {
        logged.is_none_or(|logged| *logged == self.simulation.hashes())
    }
}

/// What came of going over two runs side by side.
#[derive(Debug)]
pub enum Found {
    /// They part.
    Divergence(Box<Divergence>),
    /// At least one fails in this step, and until there they are the same.
    Failure {
        /// The step that fails.
        step: u64,
        /// Of each: how.
        errors: Box<[Option<Error>; 2]>,
    },
    /// They are the same until the step that is given, at which the stretch ends or one of them does.
    Nothing(u64),
}

/// Steps both until they part, at most to the step `to`; both stand at the same step.
pub fn in_step(pairing: &Pairing, [a, b]: &mut [Again; 2], to: u64, mut on_step: impl FnMut(u64)) -> Found {
    loop {
        if let Some(divergence) = pairing.divergence(&a.simulation, &b.simulation) {
            return Found::Divergence(Box::new(divergence));
        }
        let step = a.simulation.steps();
        if step >= to || a.simulation.is_over() || b.simulation.is_over() {
            return Found::Nothing(step);
        }
        on_step(step);
        let errors = [&mut *a, &mut *b].map(|run| run.simulation.advance(f64::INFINITY, 1).err());
        if errors.iter().any(Option::is_some) {
            return Found::Failure { step: step + 1, errors: Box::new(errors) };
        }
    }
}
