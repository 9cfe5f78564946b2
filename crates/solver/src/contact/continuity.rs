//! What is kept of the springs of slave nodes from step to step, in 2D and 3D: the gap that counts as zero,
//! where a spring was in the middle of the step, and its energy.

use super::initial::{is_ignored, kept, moved_by, pressing};
use super::springs::{Answer, Springs, TangentSpace};
use crate::archive::{Archive, ArchiveResult, Persist, persist_all, persist_each};
use crate::model;
use crate::tensor::Dim;

/// What is kept of the spring of a slave and a body while they touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringHistory<const D: usize> {
    /// Gap that counts as zero, m.
    pub offset: f64,
    /// Where the spring's gap was at n − ½, m.
    pub half: f64,
    /// Its normal in the step before; zero: it had none.
    pub normal: [f64; D],
    /// Its energy at n − ½, J (in 2D J/m).
    pub stored: f64,
}

impl<const D: usize> Default for SpringHistory<D> {
    fn default() -> Self {
        Self { offset: 0.0, half: 0.0, normal: [0.0; D], stored: 0.0 }
    }
}

impl<const D: usize> Persist for SpringHistory<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { offset, half, normal, stored } = self;
        persist_each!(archive; offset, half, normal, stored);
        Ok(())
    }
}

impl<const D: usize> SpringHistory<D> {
    /// Where the spring's gap was at n − ½, m; infinite: there was no spring.
    #[must_use]
    pub fn half(&self) -> f64 {
        if self.normal == [0.0; D] { f64::INFINITY } else { self.half }
    }
}

/// What all springs of a contact have in common.
pub(super) struct Continuity<const D: usize> {
    /// Distance that the surfaces keep, m.
    pub(super) thickness: f64,
    /// Largest gap at which the law pushes, m.
    pub(super) reach: f64,
    /// Whether springs store energy: multipliers do not.
    stores: bool,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    /// Initial positions, m: only where a surface meets itself at a distance.
    initial: Vec<[f64; D]>,
    pub(super) has_begun: bool,
    /// Whether elements were made again since the last step.
    is_new: bool,
    /// Energy of the springs of the last step, and of those that were not found again, J (in 2D J/m).
    closed: Closed,
    pub(super) lost_contact_energy: f64,
}

impl<const D: usize> Continuity<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Of an interface whose law pushes up to the gap `reach` (m); `initial` positions, m.
    pub(super) fn new(interface: &model::Interface, reach: f64, initial: &[[f64; D]]) -> Self {
        Self {
            thickness: interface.thickness,
            reach,
            stores: interface.law != model::ContactLaw::Multiplier,
            ignores_start: is_ignored(interface),
            initial: if interface.thickness + reach > 0.0 { initial.to_vec() } else { Vec::new() },
            has_begun: false,
            is_new: false,
            closed: Closed::default(),
            lost_contact_energy: 0.0,
        }
    }

    /// Gap less the thickness. A surface keeps no more distance from itself than half of what it had
    /// (`distance` in the initial positions, m): neighbours along a surface are near, and stay so.
    pub(super) fn gap(&self, gap: f64, own: bool, distance: impl FnOnce(&[[f64; D]]) -> f64) -> f64 {
        let gap = gap - self.thickness;
        if !own || self.initial.is_empty() {
            return gap;
        }
        gap + (self.thickness + self.reach - 0.5 * distance(&self.initial)).max(0.0)
    }

    /// Continues that of surfaces whose elements were made again since the last step.
    pub(super) fn carry(&mut self, old: &Self) {
        (self.has_begun, self.is_new) = (old.has_begun, true);
    }

    /// The history of a spring whose stiffness by area has changed, with its elements, from the first to the
    /// second of `by_area` (Pa/m): its gap is such that it presses as before.
    pub(super) fn pressing(&self, history: &SpringHistory<D>, gap: f64, by_area: [f64; 2]) -> SpringHistory<D> {
        if !(self.is_new && self.stores) || history.normal == [0.0; D] {
            return *history;
        }
        SpringHistory { offset: gap - pressing(gap - history.offset, by_area), ..*history }
    }

    /// The history of a spring that was carried over to other elements, which has where its gap was before in
    /// `half`: now that the gap is `gap`, it presses as before. Another one is as it is.
    pub(super) fn moved(&self, history: &SpringHistory<D>, gap: f64, by_area: [f64; 2]) -> SpringHistory<D> {
        if !self.is_new || history.normal == [0.0; D] {
            return *history;
        }
        let before = if self.stores { pressing(history.half, by_area) } else { history.half };
        // Where it was half a step ago, and with what energy, follows from where the node is now.
        SpringHistory { offset: moved_by(before, gap), half: f64::NAN, stored: 0.0, ..*history }
    }

    /// Gap as the spring sees it, and the gap that counts as zero. What is inside of a surface whose elements
    /// were made again, and was not in contact, came in there by no motion.
    pub(super) fn beyond(&self, gap: f64, own: bool, history: &SpringHistory<D>) -> (f64, f64) {
        let begins = self.is_new && history.normal == [0.0; D];
        let counts = (self.ignores_start && !own) || begins || history.offset != 0.0;
        let offset = if counts { kept(self.has_begun && !begins, history.offset, gap) } else { 0.0 };
        (gap - offset, offset)
    }

    /// Lets the spring that was pushed last continue where it ended.
    pub(super) fn resume(&self, history: &SpringHistory<D>, springs: &mut Springs<D>) {
        if self.stores && self.has_begun {
            springs.continues(history.half(), history.stored);
        }
    }

    /// Compares the energy of the springs that were found again with those of the step before.
    pub(super) fn found(&mut self, again: &Closed) {
        self.lost_contact_energy = self.closed.less(again);
        (self.has_begun, self.is_new) = (true, false);
    }

    /// Begins to note the solved springs of a step.
    pub(super) fn begin_notes(&mut self) -> &mut Closed {
        self.closed = Closed::default();
        &mut self.closed
    }

    /// Notes a solved spring.
    pub(super) fn note(&mut self, history: &mut SpringHistory<D>, answer: &Answer<'_, D>) {
        history.half = answer.gap_new();
        if self.stores && history.half < self.reach {
            history.stored = answer.stored_new();
            self.closed.add(history.stored);
        }
    }
}

impl<const D: usize> Persist for Continuity<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { thickness: _, reach: _, stores: _, ignores_start: _, initial: _, lost_contact_energy: _, has_begun, is_new, closed } =
            self;
        persist_each!(archive; has_begun, is_new, closed);
        Ok(())
    }
}

/// How many springs are closed, and their energy, J/m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Closed {
    count: u32,
    energy: f64,
}

persist_all!(Closed { count, energy });

impl Closed {
    /// Adds a spring.
    pub(super) fn add(&mut self, stored: f64) {
        if stored > 0.0 {
            self.count += 1;
            self.energy += stored;
        }
    }

    /// What is missing in `now`, J/m: where nothing is, sums that were added up in another order differ by
    /// round-off.
    pub(super) fn less(&self, now: &Self) -> f64 {
        if self.count > now.count { (self.energy - now.energy).max(0.0) } else { 0.0 }
    }
}
