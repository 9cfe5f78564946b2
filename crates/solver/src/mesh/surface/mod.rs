//! The outside of bodies, and what a piece of it is: a segment of two nodes in 2D, a facet of three or
//! four in 3D.
//!
//! Cells come from the shapes and mesh files; surfaces go to contact, loads and boundaries. What is written
//! once for both dimensions sees [`Corners`] and [`Sided`]; what differs in kind (chains in 2D, edges
//! and fans in 3D) is in `plane.rs` and `space.rs`.

mod plane;
mod space;
pub mod tributary;

pub use plane::PlaneSurface;
pub use space::{SpaceSurface, SurfaceEdge};

use super::Meshed;
use super::cell::Cell;
use crate::archive::Persist;
use crate::error::Fault;
use crate::mesh::messages::NOT_A_SURFACE;
use std::collections::BTreeMap;
use std::fmt::Debug;

/// No neighbour.
pub const NONE: u32 = u32::MAX;

/// A piece of the outside of a body of dimension `D`: the segment `[a, b]` with the body on the right of a →
/// b, or the facet `[a, b, c, d]`, counter-clockwise seen from outside; a triangle repeats its last node.
pub type Facet<const D: usize> = <super::Dim<D> as Meshed<D>>::Facet;

/// An oriented surface of bodies of dimension `D`.
pub type Surface<const D: usize> = <super::Dim<D> as Meshed<D>>::Surface;

/// What all pieces of an outside have: their nodes.
pub trait Corners: Copy + Debug + Default + Ord + Persist + Send + Sync + 'static {
    /// Its nodes, each once.
    fn corners(&self) -> &[u32];

    /// The same with other nodes.
    #[must_use]
    fn renamed(self, number: impl Fn(u32) -> u32) -> Self;

    /// The form in which surfaces have it: a segment as it is; a facet with its lowest node first.
    #[must_use]
    fn canonical(self) -> Self;

    /// From the nodes of a cell; `None` where it has not so many.
    fn of_cell(cell: &[u32]) -> Option<Self>;

    /// Its other side.
    #[must_use]
    fn reversed(self) -> Self;

    /// The same nodes, whatever the direction.
    #[must_use]
    fn undirected(self) -> Self;
}

impl Corners for [u32; 2] {
    fn corners(&self) -> &[u32] {
        self
    }

    fn renamed(self, number: impl Fn(u32) -> u32) -> Self {
        self.map(number)
    }

    fn canonical(self) -> Self {
        self
    }

    fn of_cell(cell: &[u32]) -> Option<Self> {
        cell.try_into().ok()
    }

    fn reversed(self) -> Self {
        [self[1], self[0]]
    }

    fn undirected(self) -> Self {
        [self[0].min(self[1]), self[0].max(self[1])]
    }
}

impl Corners for [u32; 4] {
    fn corners(&self) -> &[u32] {
        if self[2] == self[3] { &self[..3] } else { self }
    }

    fn renamed(self, number: impl Fn(u32) -> u32) -> Self {
        self.map(number)
    }

    fn canonical(self) -> Self {
        let n = self.corners().len();
        let lowest = (0..n).min_by_key(|&k| self[k]).unwrap_or(0);
        std::array::from_fn(|k| self[(lowest + k.min(n - 1)) % n])
    }

    fn of_cell(cell: &[u32]) -> Option<Self> {
        match *cell {
            [a, b, c] => Some([a, b, c, c]),
            [a, b, c, d] => Some([a, b, c, d]),
            _ => None,
        }
    }

    fn reversed(self) -> Self {
        let [a, b, c, d] = self;
        if c == d { [a, c, b, b] } else { [a, d, c, b] }
    }

    fn undirected(self) -> Self {
        let [a, b, c, d] = self.canonical();
        match self.corners().len() {
            3 => [a, b.min(c), b.max(c), b.max(c)],
            _ => [a, b.min(d), c, b.max(d)],
        }
    }
}

/// What all surfaces have: their pieces and nodes.
pub trait Sided: Clone + Debug + Default + PartialEq + Send + Sync + 'static {
    /// A segment, or a facet.
    type Facet: Corners;

    /// Its pieces.
    fn facets(&self) -> &[Self::Facet];

    /// All nodes, ascending, each once.
    fn nodes(&self) -> &[u32];
}

impl Sided for PlaneSurface {
    type Facet = [u32; 2];

    fn facets(&self) -> &[[u32; 2]] {
        &self.segments
    }

    fn nodes(&self) -> &[u32] {
        &self.nodes
    }
}

impl Sided for SpaceSurface {
    type Facet = [u32; 4];

    fn facets(&self) -> &[[u32; 4]] {
        &self.facets
    }

    fn nodes(&self) -> &[u32] {
        &self.nodes
    }
}

/// Outside pieces of `cells` (in 2D 3 or 4 nodes each, counter-clockwise; in 3D tetrahedra, wedges
/// and hexahedra): those that occur once, with the body on the right of a segment and behind a facet.
///
/// Order in 2D: closed chains one after another, each following its own element fans, beginning with
/// its lowest node; chains by that node. In 3D: by the nodes of the facets, of which the lowest is the
/// first.
///
/// # Errors
/// A fault that names nodes when a cell is not one of these or has a node twice, when an edge (in 3D a
/// facet) belongs to more than two cells, or to two cells that have it in the same direction (one of them is
/// inside out, or they overlap).
pub fn exterior<'a, const D: usize>(cells: impl IntoIterator<Item = Cell<'a>, IntoIter: Clone>) -> Result<Vec<Facet<D>>, Fault>
where
    super::Dim<D>: Meshed<D>,
{
    <super::Dim<D> as Meshed<D>>::exterior(cells)
}

/// `facets` in any direction, turned so that they match those of `exterior`; order kept, repeated ones
/// dropped.
///
/// # Errors
/// A fault that names the nodes of the first one that is not on the outside.
pub fn oriented<F: Corners>(facets: &[F], exterior: &[F]) -> Result<Vec<F>, Fault> {
    let mut outside: BTreeMap<F, Vec<(F, bool)>> = BTreeMap::new();
    for &facet in exterior {
        outside.entry(facet.undirected()).or_default().push((facet, false));
    }
    let mut result = Vec::with_capacity(facets.len());
    for &given in facets {
        // Where a slit of no width has both directions outside, the one as given wins.
        let both = outside.get_mut(&given.undirected());
        let found = both.and_then(|both| {
            let at = both.iter().position(|(facet, _)| *facet == given.canonical()).unwrap_or(0);
            both.get_mut(at)
        });
        let Some((facet, taken)) = found else {
            let (what, nodes) = (if given.corners().len() == 2 { "line" } else { "facet" }, named(&given));
            return Err(Fault::new(
                &NOT_A_SURFACE,
                "",
                format!("{what} {nodes} is not on the outside of a body"),
                if given.corners().len() == 2 {
                    "take lines that bound the elements of one part; contact acts on the outside only"
                } else {
                    "take facets that bound the elements of one part; contact acts on the outside only"
                },
            ));
        };
        if !std::mem::replace(taken, true) {
            result.push(*facet);
        }
    }
    Ok(result)
}

/// The nodes of a piece, for messages.
fn named(facet: &impl Corners) -> String {
    facet.corners().iter().map(u32::to_string).collect::<Vec<_>>().join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_facet_is_the_same_wherever_it_begins() {
        assert_eq!([7, 3, 9, 5].canonical(), [3, 9, 5, 7]);
        assert_eq!([7, 3, 5, 5].canonical(), [3, 5, 7, 7]);
        assert_eq!([5, 7, 3, 3].canonical(), [3, 5, 7, 7]);
        assert_eq!([7, 3, 9, 5].undirected(), [5, 9, 3, 7].undirected());
        assert_eq!([7, 3, 5, 5].undirected(), [5, 3, 7, 7].undirected());
        assert_eq!([7, 3, 5, 5].corners(), [7, 3, 5]);
    }
}
