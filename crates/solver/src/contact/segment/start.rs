//! What pairs of segments or facets know of the beginning: the distance that a body keeps from itself, and
//! gaps that count as zero.

use super::super::formulation::{Setup, Surfaces};
use super::super::initial::kept;
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::tensor::Dim;
use crate::vector::{dot, minus};

/// What is known of the beginning.
pub(super) struct Start<const D: usize> {
    /// Whether gaps that are negative when the contact begins to act count as zero.
    pub(super) ignored: bool,
    pub(super) has_begun: bool,
    /// Distance that the surfaces keep, and largest gap at which the law pushes, m.
    thickness: f64,
    pub(super) reach: f64,
    /// Initial positions (m) and body of each node: only where surfaces keep a distance.
    positions: Vec<[f64; D]>,
    bodies: Vec<u32>,
}

/// What a new pair did that was there unseen at the beginning of the step: how far its nodes moved with
/// respect to each other, and by how much its gap grew, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unseen {
    pub(super) moved: f64,
    pub(super) way: f64,
}

/// Segments or facets by their nodes, to find them again after a surface was rebuilt.
pub(in crate::contact) struct ByNodes<F>(Vec<(F, u32)>);

impl<F: Copy + Ord> ByNodes<F> {
    pub(in crate::contact) fn new(list: &[F]) -> Self {
        let mut list: Vec<(F, u32)> = list.iter().copied().zip(0..).collect();
        list.sort_unstable();
        Self(list)
    }

    /// The number of the one with these nodes.
    pub(in crate::contact) fn number_of(&self, nodes: F) -> Option<u32> {
        self.0.binary_search_by_key(&nodes, |&(nodes, _)| nodes).ok().map(|at| self.0[at].1)
    }
}

/// Finds pairs of segments or facets of two surfaces, as they were `before` and are `now`, again.
pub(in crate::contact) fn pairs_again<'a, F: Copy + Ord>(
    now: [&[F]; 2],
    before: [&'a [F]; 2],
) -> impl Fn([u32; 2]) -> Option<[u32; 2]> + use<'a, F> {
    let by_nodes = now.map(ByNodes::new);
    let again = move |k: usize, pair: [u32; 2]| by_nodes[k].number_of(before[k][pair[k] as usize]);
    move |pair| Some([again(0, pair)?, again(1, pair)?])
}

impl<const D: usize> Start<D>
where
    Dim<D>: Surfaces<D>,
{
    pub(super) fn of(setup: &Setup<'_, D>, reach: f64) -> Self {
        let thickness = setup.contact.interface.thickness;
        let at_a_distance = thickness + reach > 0.0;
        Self {
            ignored: setup.ignores_start(),
            has_begun: false,
            thickness,
            reach,
            positions: if at_a_distance { setup.positions.to_vec() } else { Vec::new() },
            bodies: if at_a_distance { setup.bodies.to_vec() } else { Vec::new() },
        }
    }

    /// Gap up to which the law pushes, m.
    pub(super) fn within(&self) -> f64 {
        self.thickness + self.reach
    }

    /// Distance that two segments or facets with these nodes keep, m. A body keeps no more distance from
    /// itself than half of what it had: neighbours along a surface are near, and stay so.
    pub(super) fn distance(&self, [first, second]: [&[u32]; 2]) -> f64 {
        let Self { positions, bodies, thickness, reach, .. } = self;
        if bodies.is_empty() || bodies[first[0] as usize] != bodies[second[0] as usize] {
            return *thickness;
        }
        let apart = first.iter().flat_map(|&a| second.iter().map(move |&b| minus(positions[a as usize], positions[b as usize])));
        let nearest = apart.map(|apart| dot(apart, apart)).fold(f64::INFINITY, f64::min).sqrt();
        thickness - (thickness + reach - 0.5 * nearest).max(0.0)
    }

    /// The gap that counts as zero (m, not positive), now that the gap less the distance is `gap`; `before`
    /// is that of the step before.
    pub(super) fn offset(&self, before: f64, gap: f64, unseen: Option<Unseen>) -> f64 {
        let (begun, reach) = (self.has_begun, self.reach);
        let offset = match unseen {
            Some(Unseen { moved, way }) if gap < reach - moved => gap - reach - 0.5 * way.max(0.0),
            _ => kept(begun, before, if begun { gap - reach } else { gap }),
        };
        if self.ignored || begun { offset } else { 0.0 }
    }
}

impl<const D: usize> Persist for Start<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { ignored: _, thickness: _, reach: _, positions: _, bodies: _, has_begun } = self;
        has_begun.persist(archive)
    }
}
