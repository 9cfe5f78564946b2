//! The faults of a mesh: at most [`PLACES`] of each kind with their places, the rest counted.
//!
//! `mesh.rs` and `check.rs` fill it while it goes through the cells and nodes; [`super::parse`] hands the
//! list to the caller.

use embate_solver::error::Fault;

/// Faults of one kind that are given with their places.
pub(super) const PLACES: usize = 20;

/// Faults by kind, in the order in which the kinds were met.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    kinds: Vec<Kind>,
}

#[derive(Debug)]
struct Kind {
    name: &'static str,
    faults: Vec<Fault>,
    more: usize,
}

impl Faults {
    /// Adds a fault to those of the kind `name`, a plural such as "elements without area".
    pub(crate) fn add(&mut self, name: &'static str, fault: impl FnOnce() -> Fault) {
        let index = self.kinds.iter().position(|kind| kind.name == name).unwrap_or_else(|| {
            self.kinds.push(Kind { name, faults: Vec::new(), more: 0 });
            self.kinds.len() - 1
        });
        let kind = &mut self.kinds[index];
        if kind.faults.len() < PLACES {
            kind.faults.push(fault());
        } else {
            kind.more += 1;
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }

    /// All faults; a last one of each kind counts those without a place.
    pub(crate) fn into_list(self, source: &str) -> Vec<Fault> {
        let mut list = Vec::new();
        for kind in self.kinds {
            let more = kind.faults.first().filter(|_| kind.more > 0);
            let more = more.map(|one| Fault::new(one.kind, source, format!("{} more {}", kind.more, kind.name), ""));
            list.extend(kind.faults);
            list.extend(more);
        }
        list
    }
}
