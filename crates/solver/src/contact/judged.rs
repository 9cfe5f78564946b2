//! A contact whose bodies are looked at as they are, whatever makes its springs: pinballs, a single pass, ties. What looks holds nothing, it tells.

use super::depths::Depths;
use super::findings::Findings;
use super::overlap::Judge;
use super::springs::{Answers, Springs};
use super::tied::Ties;
use super::tracker::{Certificate, SearchReport};
use super::{Formulation, Scene, Sweep};
use crate::archive::{Archive, Kept};
use crate::motion::Motion;
use crate::tensor::Dim;
use std::any::Any;

/// Looks at bodies.
pub trait Look<const D: usize>: Any + Send + Sync
where
    Dim<D>: Motion<D>,
{
    /// Looks at the step, if it is time.
    fn look(&mut self, scene: &Scene<'_, D>);

    /// Weighs the forces of the step's springs.
    fn weigh(&mut self, solved: &Answers<'_, D>);

    /// What was found so far.
    fn findings(&self) -> &Findings;

    /// Nodes that were inside another body in the last look, and how deep, m.
    fn inside(&self) -> &[(u32, f64)];

    /// Keeps what is known of the past.
    ///
    /// # Errors
    /// What is read is of other bodies.
    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept;

    /// Goes on with what another one knew, whose surfaces were those before they changed.
    fn inherit(&mut self, old: &Self)
    where
        Self: Sized;
}

impl Look<3> for Judge {
    fn look(&mut self, scene: &Scene<'_, 3>) {
        let sweep = if self.findings().looks > 0 { scene.sweep } else { Sweep { old: scene.sweep.new, ..scene.sweep } };
        self.look(sweep, scene.time);
    }

    fn weigh(&mut self, solved: &Answers<'_, 3>) {
        self.weigh(solved);
    }

    fn findings(&self) -> &Findings {
        self.findings()
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.inside()
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        self.keep(archive)
    }

    fn inherit(&mut self, old: &Self) {
        self.inherit(old);
    }
}

impl Look<2> for Depths {
    fn look(&mut self, scene: &Scene<'_>) {
        self.begin(scene);
        self.end();
    }

    fn weigh(&mut self, _: &Answers<'_>) {}

    fn findings(&self) -> &Findings {
        self.findings()
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.inside()
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        self.keep(archive)
    }

    fn inherit(&mut self, old: &Self) {
        self.inherit(old);
    }
}

/// The contact.
pub struct Judged<J, const D: usize>
where
    Dim<D>: Motion<D>,
{
    contact: Box<dyn Formulation<D>>,
    judge: J,
}

impl<J: Look<D>, const D: usize> Judged<J, D>
where
    Dim<D>: Motion<D>,
{
    /// A contact, and what looks at its bodies.
    #[must_use]
    pub fn new(contact: Box<dyn Formulation<D>>, judge: J) -> Self {
        Self { contact, judge }
    }
}

impl<J: Look<D>, const D: usize> Formulation<D> for Judged<J, D>
where
    Dim<D>: Motion<D>,
{
    fn detect(&mut self, scene: &Scene<'_, D>, springs: &mut Springs<D>) {
        self.judge.look(scene);
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

    fn freed(&self) -> f64 {
        self.contact.freed()
    }

    fn let_go(&self) -> f64 {
        self.contact.let_go()
    }

    fn ties(&self) -> Option<Ties> {
        self.contact.ties()
    }

    fn certificate(&self) -> Certificate {
        self.contact.certificate()
    }

    fn search_report(&self) -> Option<SearchReport> {
        self.contact.search_report()
    }

    fn overlaps(&self) -> Option<&Findings> {
        Some(self.judge.findings())
    }

    fn inside(&self) -> &[(u32, f64)] {
        self.judge.inside()
    }

    fn thinnest(&self) -> f64 {
        self.contact.thinnest()
    }
}
