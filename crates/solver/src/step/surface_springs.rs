//! What contact springs stored on surfaces that changed, less what those of the new surfaces store: each
//! cause of such a change enters it in a store of its own.

use crate::archive::{Archive, ArchiveResult, Persist};

/// Energy of the contact springs before surfaces changed, J/m, until that of the new ones is known.
#[derive(Debug, Default)]
pub(crate) struct SurfaceSprings(Option<f64>);

impl Persist for SurfaceSprings {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.0.persist(archive)
    }
}

impl SurfaceSprings {
    /// Notes what they stored when surfaces changed for the first time in the step, J/m.
    pub(super) fn open(&mut self, stored: f64) {
        self.0.get_or_insert(stored);
    }

    /// Whether surfaces have changed and the new springs are not known yet.
    pub(super) fn is_open(&self) -> bool {
        self.0.is_some()
    }

    /// What went with them, J/m; `stored`: what springs of the new surfaces store.
    pub(super) fn close(&mut self, stored: impl FnOnce() -> f64) -> f64 {
        self.0.take().map_or(0.0, |before| before - stored())
    }
}
