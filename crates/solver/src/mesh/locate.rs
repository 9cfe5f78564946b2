//! The element that a place is in, and the shares of its corners there.

use super::cell::CellKind;
use super::{Dim, ElementGroup, Mesh, Meshed};
use crate::tensor::Space;
use crate::vector::minus;

/// Shares that are less are none.
const SLIGHT: f64 = 1e-9;
/// Part of its size by which a place may be beside an element that it is near.
const BESIDE: f64 = 0.25;

/// An element at a place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Located {
    /// Its group, and its number in that.
    pub(crate) element: (usize, u32),
    /// Corners with their shares, which add up to one.
    pub(crate) nodes: Vec<(u32, f64)>,
    /// The least share of a corner of the simplex that the place is in, or nearest to be in: negative
    /// outside.
    pub(crate) least: f64,
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D> + Space<D>,
{
    /// The element of a part that a place is in, or is nearest to be in by the shares of its corners, with
    /// nodes in these positions; `counts` says which elements are there. Elements are divided into simplices
    /// from their first corner.
    pub(crate) fn located(
        &self,
        part: usize,
        positions: &[[f64; D]],
        place: [f64; D],
        counts: impl Fn(&ElementGroup, usize) -> bool,
    ) -> Option<Located> {
        let mut best: Option<Located> = None;
        for (index, group) in self.groups.iter().enumerate().filter(|(_, group)| group.part == part) {
            if group.kind.facts().dimension != D {
                continue;
            }
            let simplices = simplices::<D>(group.kind);
            for element in (0..group.elements()).filter(|&element| counts(group, element)) {
                let nodes = group.nodes_of(element);
                let first = positions[nodes[0] as usize];
                for others in &simplices {
                    let others = others.map(|corner| nodes[corner]);
                    let Some(shares) = shares(first, others.map(|node| positions[node as usize]), place) else { continue };
                    let own = 1.0 - shares.iter().sum::<f64>();
                    let least = shares.into_iter().fold(own, f64::min);
                    if best.as_ref().is_none_or(|best| least > best.least) {
                        let nodes = std::iter::once((nodes[0], own)).chain(others.into_iter().zip(shares)).collect();
                        best = Some(Located { element: (index, element as u32), nodes, least });
                    }
                }
            }
        }
        best.map(Located::inside)
    }
}

impl Located {
    /// Without corners that have no share: those of a place outside end on the nearest side.
    fn inside(mut self) -> Self {
        self.nodes.retain(|&(_, share)| share > SLIGHT);
        let sum: f64 = self.nodes.iter().map(|(_, share)| share).sum();
        self.nodes.iter_mut().for_each(|(_, share)| *share /= sum);
        self
    }

    /// Whether the place is in the element, or not far beside it.
    pub(crate) fn is_near(&self) -> bool {
        self.least >= -BESIDE
    }

    /// Whether the place is in the element.
    pub(crate) fn is_inside(&self) -> bool {
        self.least >= -SLIGHT
    }
}

/// Corners of the simplices into which a cell can be divided, each beside its first corner: with the sides
/// that do not have that one.
fn simplices<const D: usize>(kind: CellKind) -> Vec<[usize; D]> {
    let facts = kind.facts();
    let without_first = |side: &[u8]| !side.contains(&0);
    let corners = |side: &[u8]| std::array::from_fn(|k| usize::from(side[k]));
    if D == 2 {
        return facts.edges.iter().filter(|edge| without_first(&edge[..])).map(|edge| corners(edge)).collect();
    }
    let halves = |face: &[u8; 4]| {
        let [a, b, c, d] = *face;
        let second = (c != d).then_some([a, c, d]);
        std::iter::once([a, b, c]).chain(second)
    };
    facts.faces.iter().filter(|face| without_first(&face[..])).flat_map(halves).map(|half| corners(&half)).collect()
}

/// Shares of the other corners of a simplex at a place; `None`: it has no volume.
fn shares<const D: usize>(first: [f64; D], others: [[f64; D]; D], place: [f64; D]) -> Option<[f64; D]>
where
    Dim<D>: Space<D>,
{
    let edges = others.map(|other| minus(other, first));
    let determinant = <Dim<D>>::determinant(&edges);
    let adjugate = <Dim<D>>::adjugate(&edges);
    let way = minus(place, first);
    // Σ s_k e_k = way: rows of the matrix are edges.
    let share = |k: usize| (0..D).map(|d| way[d] * adjugate[d][k]).sum::<f64>() / determinant;
    (determinant != 0.0).then(|| std::array::from_fn(share)).filter(|shares: &[f64; D]| shares.iter().all(|share| share.is_finite()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn simplices_fill_each_kind_of_cell() {
        for kind in CellKind::ALL {
            let facts = kind.facts();
            let place = |corner: usize| facts.reference[corner];
            let volume = |all: [[f64; 3]; 3], factor: f64| <Dim<3>>::determinant(&all) / factor;
            let sum: f64 = match facts.dimension {
                2 => {
                    let of = |others: &[usize; 2]| {
                        volume([minus(place(others[0]), place(0)), minus(place(others[1]), place(0)), [0.0, 0.0, 1.0]], 2.0)
                    };
                    simplices::<2>(kind).iter().map(of).sum()
                }
                3 => simplices::<3>(kind).iter().map(|others| volume(others.map(|corner| minus(place(corner), place(0))), 6.0).abs()).sum(),
                _ => continue,
            };
            assert!((sum - facts.size).abs() < 1e-14, "{kind:?}: {sum} and not {}", facts.size);
        }
    }

    #[test]
    fn shares_bring_a_place_back() {
        let mut random = Random::new(7);
        for _ in 0..1000 {
            let [first, a, b, c, place] = std::array::from_fn(|_| std::array::from_fn(|_| random.unit()));
            let Some(found) = shares::<3>(first, [a, b, c], place) else { continue };
            let own = 1.0 - found.iter().sum::<f64>();
            for d in 0..3 {
                let again = own * first[d] + found[0] * a[d] + found[1] * b[d] + found[2] * c[d];
                let size = found.iter().fold(own.abs(), |most, share| most.max(share.abs()));
                assert!((again - place[d]).abs() < 1e-12 * size.max(1.0), "{again} {}", place[d]);
            }
        }
    }
}
