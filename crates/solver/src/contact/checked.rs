//! A contact whose bodies are looked at as they are, whatever makes its springs: pinballs, ties. What looks
//! holds nothing, it reports.

use super::findings::Findings;
use super::springs::{Answers, Springs};
use super::{Formulation, Scene, both};
use crate::archive::{Archive, ArchiveResult};
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
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult;

    /// Continues with what another one knew, whose surfaces were those before they changed; the bodies are
    /// looked at again.
    fn inherit(&mut self, old: &Self);
}

/// The contact.
pub struct Checked<J, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    contact: Box<dyn Formulation<D>>,
    overlap_check: J,
}

impl<J: Look<D>, const D: usize> Checked<J, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// A contact, and what looks at its bodies.
    #[must_use]
    pub fn new(contact: Box<dyn Formulation<D>>, overlap_check: J) -> Self {
        Self { contact, overlap_check }
    }
}

impl<J: Look<D>, const D: usize> Formulation<D> for Checked<J, D>
where
    Dim<D>: TangentSpace<D>,
{
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        let Self { contact, overlap_check } = self;
        both(|| overlap_check.see_step(scene), || contact.detect(scene, springs));
    }

    fn remember(&mut self, solved: Answers<'_, D>) {
        self.overlap_check.weigh(&solved);
        self.contact.remember(solved);
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { contact, overlap_check } = self;
        contact.persist(archive)?;
        overlap_check.persist(archive)
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.contact.inherit(old.contact);
            self.overlap_check.inherit(&old.overlap_check);
        }
    }

    fn within(&self) -> Option<&dyn Formulation<D>> {
        Some(&*self.contact)
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.overlap_check.findings())
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.overlap_check.inside()
    }
}
