//! Ties of surfaces: each two segments or facets that are near each other are bound over their common part.
//!
//! The integrals of `formulation = "segment"` are taken once: a spring holds the mean points x_a = Σ N_k x_k
//! and x_b = Σ M_k x_k, whose shares N and M stay as they were at the start, when one was above the other.
//! With d = x_a − x_b and the present normal n of the pair its gap is n·d less that of the start, its slip
//! t·d along the tangents t. As these turn with the mean spin ω of both segments or facets,
//!
//! ġ = n·ḋ + ω·(n × d),   ṡ = t·ḋ + ω·(t × d):
//!
//! which are zero in every rigid motion, so that forces keep both momenta: the terms of ω are the forces
//! across both that balance the couple. The shares of all springs sum up to ∫ N_k dA: under a uniform
//! traction d is the same for all, and their forces are the consistent loads on both meshes. After Puso, Int.
//! J. Numer. Meth. Engng 59 (2004) 315-336, with springs instead of multipliers.

use super::{Hold, Tie};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact::formulation::Surfaces;
use crate::contact::search::{Query, Search};
use crate::contact::segment::pairs_again;
use crate::mesh::surface::{Corners, Facet};
use crate::tensor::Dim;
use crate::vector::{length, minus};

/// A segment or facet that is bound over more than this fraction of its area meets no other: what gets beside
/// it as springs yield is not there.
const WHOLE: f64 = 0.95;

/// Mean points of two segments or facets of `N` corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::contact) struct PairHold<const N: usize> {
    /// Indices in both surfaces.
    pub(in crate::contact) pair: [u32; 2],
    /// Of each corner.
    pub(in crate::contact) shares: [[f64; N]; 2],
    /// Which part of both areas it stands for.
    pub(in crate::contact) parts: [f64; 2],
}

impl<const N: usize> Default for PairHold<N> {
    fn default() -> Self {
        Self { pair: [0; 2], shares: [[0.0; N]; 2], parts: [0.0; 2] }
    }
}

impl<const N: usize> Persist for PairHold<N> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { pair, shares, parts } = self;
        persist_each!(archive; pair, shares, parts);
        Ok(())
    }
}

impl<const N: usize> Hold for PairHold<N> {
    fn unit(&self) -> [u32; 2] {
        self.pair
    }

    fn node(&self) -> Option<u32> {
        None
    }
}

impl<const N: usize> PairHold<N> {
    /// x_a − x_b, m, where the corners are at these places.
    pub(in crate::contact) fn apart<const D: usize>(&self, places: &[[[f64; D]; N]; 2]) -> [f64; D] {
        let at = |k: usize, d: usize| (0..N).fold(0.0, |sum, i| sum + self.shares[k][i] * places[k][i][d]);
        std::array::from_fn(|d| at(0, d) - at(1, d))
    }

    /// Whether surfaces with so many segments or facets have the pair.
    pub(in crate::contact) fn is_within(&self, counts: [usize; 2]) -> bool {
        (0..2).all(|k| (self.pair[k] as usize) < counts[k])
    }
}

/// What is bound of two surfaces.
#[derive(Default)]
pub(in crate::contact) struct Bound {
    /// Ascending.
    pairs: Vec<[u32; 2]>,
    /// Which segments or facets are bound as a whole.
    whole: [Vec<bool>; 2],
}

impl Bound {
    /// By ties of surfaces with so many segments or facets.
    pub(in crate::contact) fn new<const N: usize>(ties: &[Tie<PairHold<N>>], counts: [usize; 2]) -> Self {
        let mut pairs: Vec<[u32; 2]> = ties.iter().map(|tie| tie.hold.pair).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let whole = [0, 1].map(|k| {
            let mut parts = vec![0.0; counts[k]];
            ties.iter().for_each(|tie| parts[tie.hold.pair[k] as usize] += tie.hold.parts[k]);
            parts.into_iter().map(|part| part > WHOLE).collect()
        });
        Self { pairs, whole }
    }

    /// Whether a pair is in ordinary contact.
    pub(in crate::contact) fn frees(&self, pair: [u32; 2]) -> bool {
        let is_whole = |k: usize| self.whole[k].get(pair[k] as usize).copied().unwrap_or(false);
        !is_whole(0) && !is_whole(1) && self.pairs.binary_search(&pair).is_err()
    }
}

/// Nodes of both surfaces that ties hold.
pub(in crate::contact) fn sides<F: Corners, const N: usize>(ties: &[Tie<PairHold<N>>], facets: [&[F]; 2]) -> [Vec<u32>; 2] {
    [0, 1].map(|k| ties.iter().flat_map(|tie| facets[k][tie.hold.pair[k] as usize].corners()).copied().collect())
}

/// Pairs, ascending, among which are all of which a point of one is nearer to the other than `reach`, m;
/// those that share a node are not among them. Each of the second facets is `cuts` of the `simplices`.
pub(in crate::contact) fn candidates<const D: usize>(
    search: &mut dyn Search<D>,
    positions: &[[f64; D]],
    facets: [&[Facet<D>]; 2],
    (simplices, cuts): (&[[u32; D]], u32),
    reach: f64,
) -> Vec<[u32; 2]>
where
    Dim<D>: Surfaces<D>,
{
    // All of a facet is as near to its middle as its corners are.
    let (mut places, mut radius) = (positions.to_vec(), 0.0);
    for facet in facets[0] {
        let corners = facet.corners();
        let sum = |d: usize| corners.iter().map(|&node| positions[node as usize][d]).sum::<f64>();
        let middle = std::array::from_fn(|d| sum(d) / corners.len() as f64);
        radius = corners.iter().map(|&node| length(minus(positions[node as usize], middle))).fold(radius, f64::max);
        places.push(middle);
    }
    let middles: Vec<u32> = (positions.len() as u32..places.len() as u32).collect();
    let (at, reach) = (&places[..], reach + radius);
    let query = Query { positions_old: at, positions_new: at, slaves: &middles, facets: simplices, reach };
    let mut found = Vec::new();
    search.pairs(&query, &mut found);
    let mut pairs: Vec<[u32; 2]> = found.iter().map(|pair| [pair.slave, pair.facet / cuts]).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs.retain(|&[a, b]| !facets[0][a as usize].corners().iter().any(|node| facets[1][b as usize].corners().contains(node)));
    pairs
}

/// Finds pairs of surfaces that were `before` again.
pub(in crate::contact) fn again<'a, F: Copy + Ord, const N: usize>(
    now: [&[F]; 2],
    before: [&'a [F]; 2],
) -> impl Fn(&PairHold<N>) -> Option<PairHold<N>> + use<'a, F, N> {
    let again = pairs_again(now, before);
    move |hold| Some(PairHold { pair: again(hold.pair)?, ..*hold })
}
