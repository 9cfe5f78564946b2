//! What was checked in a run, for those who have to trust it: pairs, crossings, and what could not be
//! explained.

use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use std::ops::AddAssign;

/// More than any run counts: what is added to a count that was read can't overflow.
const COUNT_MOST: u64 = 1 << 62;

impl Persist for Certificate {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { pairs_swept, crossings_found, unverified } = self;
        persist_each!(archive; pairs_swept, crossings_found, unverified);
        let counts = [*pairs_swept, *crossings_found, *unverified];
        archive.check(counts.into_iter().all(|count| count < COUNT_MOST), "a certificate counts more than any run can")
    }
}

/// Proof that no contact was missed: every pair in reach is swept in every step, and the entries and exits of
/// a node through the segments of a body, counted in whole numbers that lose nothing, must agree with the
/// contacts that it has. In 3D who goes through a facet, or with an edge through another one, must be in
/// contact ([`crate::contact::missed_contacts`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certificate {
    /// Pairs of a node and a segment (in 3D a facet, and of two edges) whose paths within a step were
    /// checked for crossing, over all steps.
    pub pairs_swept: u64,
    /// Nodes that were found to go into a body.
    pub crossings_found: u64,
    /// Nodes that are inside a body, by the count of entries and exits, but not in contact with it, over all
    /// steps; in 3D nodes that went in or through, or were let go inside, and edges that went through each
    /// other, without contact. Must be zero.
    pub unverified: u64,
}

impl AddAssign for Certificate {
    fn add_assign(&mut self, other: Self) {
        self.pairs_swept += other.pairs_swept;
        self.crossings_found += other.crossings_found;
        self.unverified += other.unverified;
    }
}

/// What the global search of a contact did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SearchReport {
    /// Steps in which the contact was looked at.
    pub steps: u64,
    /// Searches in these steps.
    pub searches: u64,
    /// Distance beyond which pairs are not kept, m.
    pub skin: f64,
    /// Pairs of a node and a segment at the end.
    pub candidates: usize,
}
