//! A contact whose bodies are looked at as they are, whatever makes its springs: pinballs, ties. What looks
//! holds nothing, it tells.

use super::findings::Findings;
use super::springs::{Answers, Springs};
use super::{Formulation, Scene};
use crate::archive::{Archive, Kept};
use crate::contact::springs::TangentSpace;
use crate::tensor::Dim;
use std::any::Any;

/// Looks at bodies.
pub trait Look<const D: usize>: Send + Sync + 'static
where
    Dim<D>: TangentSpace<D>,
{
    /// Looks at the step, if it is time.
    fn see_step(&mut self, scene: &Scene<'_, D>);

    /// Weighs the forces of the step's springs, if it was looked at.
    fn weigh(&mut self, _: &Answers<'_, D>) {}

    /// What was found so far.
    fn findings(&self) -> &Findings;

    /// Nodes that were inside another body in the last look, and how deep, m.
    fn inside(&self) -> &[(u32, f64)];

    /// Keeps what is known of the past.
    ///
    /// # Errors
    /// What is read is of other bodies.
    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept;

    /// Goes on with what another one knew, whose surfaces were those before they changed; the bodies are
    /// looked at anew.
    fn inherit(&mut self, old: &Self);
}

/// The contact.
pub struct Judged<J, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    contact: Box<dyn Formulation<D>>,
    judge: J,
}

impl<J: Look<D>, const D: usize> Judged<J, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// A contact, and what looks at its bodies.
    #[must_use]
    pub fn new(contact: Box<dyn Formulation<D>>, judge: J) -> Self {
        Self { contact, judge }
    }
}

impl<J: Look<D>, const D: usize> Formulation<D> for Judged<J, D>
where
    Dim<D>: TangentSpace<D>,
{
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        self.judge.see_step(scene);
        self.contact.detect(scene, springs);
    }

    fn remember(&mut self, solved: Answers<'_, D>) {
        self.judge.weigh(&solved);
        self.contact.remember(solved);
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        let Self { contact, judge } = self;
        contact.keep(archive)?;
        judge.keep(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.contact.inherit(old.contact);
            self.judge.inherit(&old.judge);
        }
    }

    fn within(&self) -> Option<&dyn Formulation<D>> {
        Some(&*self.contact)
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.judge.findings())
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.judge.inside()
    }
}
