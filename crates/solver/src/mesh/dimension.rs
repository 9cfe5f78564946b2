//! What a mesh knows of its dimension: the pieces of its outside, its elements' forms and orientation, its curve.
//!
//! [`Mesh`](super::Mesh) is written once for the plane and for space and asks here where the two differ in kind.

use super::shapes::Body;
use super::surface::space::facets_of;
use super::surface::{Corners, PlaneSurface, Sided, SpaceSurface};
use crate::error::Fault;
use crate::model::Part;
use crate::tensor::Dim;

/// A dimension in which there are meshes.
pub trait Meshed<const D: usize> {
    /// A piece of an outside: a segment `[u32; 2]`, or a facet `[u32; 4]`.
    type Facet: Corners;
    /// An oriented surface.
    type Surface: Sided<Facet = Self::Facet>;
    /// Bits of each coordinate along the curve on which nodes and elements are sorted; `D` times as many are 62 or 63.
    const CURVE_BITS: u32;

    /// See [`exterior`](super::surface::exterior).
    ///
    /// # Errors
    /// As there.
    fn exterior<'a>(cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>) -> Result<Vec<Self::Facet>, Fault>;

    /// The whole outside of cells without the pieces that `leave_out` names, which is asked once for each in order.
    ///
    /// # Errors
    /// As [`exterior`](super::surface::exterior).
    fn outside_without<'a>(
        cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>,
        leave_out: impl Fn(Self::Facet) -> bool,
    ) -> Result<Self::Surface, Fault>;

    /// The part of the outside of cells that consists of these pieces, kept in their order.
    ///
    /// # Errors
    /// As [`PlaneSurface::new`] and [`SpaceSurface::new`].
    fn surface<'a>(facets: Vec<Self::Facet>, cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>) -> Result<Self::Surface, Fault>;

    /// The components of a point of space that this dimension has.
    fn of_space(point: [f64; 3]) -> [f64; D];

    /// Body of a part with a built-in shape, placed; `None` for a group of a mesh file.
    ///
    /// # Errors
    /// A fault, its path from the part on.
    fn body(part: &Part) -> Option<Result<Body<D>, Fault>>
    where
        Dim<D>: Meshed<D>;

    /// What is wrong with the form of an element with these corners, if anything, and what to do about it.
    fn wrong_form(corners: &[[f64; D]]) -> Option<[&'static str; 2]>;

    /// Distance along a Hilbert curve of a cell of a grid of 2^[`Meshed::CURVE_BITS`] cells in each direction.
    fn along_curve(cell: [u32; D]) -> u64;

    /// Renumbers the corners of an element such that it is the same element and begins with its lowest node.
    fn begin_with_lowest(cell: &mut [u32]);

    /// Adds to `sums`, at each node of an element, what gives zero when the node is inside and the elements all around it have added theirs. (Where two fans meet
    /// in a point of the plane it may look as if it were inside: it only lies elsewhere in memory.)
    fn add_around(cell: &[u32], sums: &mut [u64]);

    /// The form of an element that is mirrored: the same nodes, turned right side out.
    fn turn_over(cell: &mut [u32]);
}

const MEND: &str = "mend the mesh there";

impl Meshed<2> for Dim<2> {
    type Facet = [u32; 2];
    type Surface = PlaneSurface;
    const CURVE_BITS: u32 = 31;

    fn exterior<'a>(cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>) -> Result<Vec<[u32; 2]>, Fault> {
        PlaneSurface::exterior(cells)
    }

    fn outside_without<'a>(
        cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>,
        leave_out: impl Fn([u32; 2]) -> bool,
    ) -> Result<PlaneSurface, Fault> {
        PlaneSurface::outside_without(cells, leave_out)
    }

    fn surface<'a>(segments: Vec<[u32; 2]>, cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>) -> Result<PlaneSurface, Fault> {
        PlaneSurface::new(segments, cells)
    }

    fn of_space([x, y, _]: [f64; 3]) -> [f64; 2] {
        [x, y]
    }

    fn body(part: &Part) -> Option<Result<Body<2>, Fault>> {
        part.plane_body()
    }

    /// Every corner must turn counter-clockwise: then the Jacobian is positive in the whole element, and so is a triangle's area.
    fn wrong_form(corners: &[[f64; 2]]) -> Option<[&'static str; 2]> {
        let n = corners.len();
        let x = |corner: usize| corners[corner % n];
        if n == 2 {
            return has_no_length(corners);
        }
        let turns = || {
            (0..n).map(|c| {
                let (a, b, d) = (x(c), x(c + 1), x(c + n - 1));
                (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0])
            })
        };
        if turns().all(|turn| turn > 0.0) {
            None
        } else if turns().all(|turn| turn < 0.0) {
            Some(["has negative area: its nodes run clockwise", "number its nodes counter-clockwise"])
        } else {
            // NaN too.
            Some(["is degenerate or not convex", MEND])
        }
    }

    fn along_curve(cell: [u32; 2]) -> u64 {
        super::order::hilbert(cell)
    }

    fn begin_with_lowest(cell: &mut [u32]) {
        // The direction of turning stays.
        let lowest = (0..cell.len()).min_by_key(|&corner| cell[corner]).unwrap_or(0);
        cell.rotate_left(lowest);
    }

    fn add_around(cell: &[u32], sums: &mut [u64]) {
        // Around a node inside each neighbour is once the next one and once the one before.
        for (corner, &node) in cell.iter().enumerate() {
            let [before, next] = [cell.len() - 1, 1].map(|by| u64::from(cell[(corner + by) % cell.len()]));
            let sum = &mut sums[node as usize];
            *sum = sum.wrapping_add(next).wrapping_sub(before);
        }
    }

    fn turn_over(cell: &mut [u32]) {
        if cell.len() > 2 {
            cell.reverse();
        }
    }
}

impl Meshed<3> for Dim<3> {
    type Facet = [u32; 4];
    type Surface = SpaceSurface;
    const CURVE_BITS: u32 = 21;

    fn exterior<'a>(cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>) -> Result<Vec<[u32; 4]>, Fault> {
        SpaceSurface::exterior(cells)
    }

    fn outside_without<'a>(
        cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>,
        leave_out: impl Fn([u32; 4]) -> bool,
    ) -> Result<SpaceSurface, Fault> {
        SpaceSurface::outside_without(cells, leave_out)
    }

    fn surface<'a>(facets: Vec<[u32; 4]>, cells: impl IntoIterator<Item = &'a [u32], IntoIter: Clone>) -> Result<SpaceSurface, Fault> {
        SpaceSurface::new(facets, cells)
    }

    fn of_space(point: [f64; 3]) -> [f64; 3] {
        point
    }

    fn body(part: &Part) -> Option<Result<Body<3>, Fault>> {
        part.solid_body()
    }

    /// The edges from every corner must span a positive volume: then the Jacobian is positive at the corners, and in a tetrahedron everywhere.
    fn wrong_form(corners: &[[f64; 3]]) -> Option<[&'static str; 2]> {
        if corners.len() == 2 {
            return has_no_length(corners);
        }
        let volumes = || corner_volumes(corners);
        if volumes().all(|volume| volume > 0.0) {
            None
        } else if volumes().all(|volume| volume < 0.0) {
            Some(["has negative volume: its nodes run the wrong way round", "exchange its lower and its upper nodes"])
        } else {
            // NaN too.
            Some(["is degenerate or folds over at a corner", MEND])
        }
    }

    fn along_curve(cell: [u32; 3]) -> u64 {
        super::order::hilbert_in_space(cell)
    }

    fn begin_with_lowest(cell: &mut [u32]) {
        // Of all ways to turn the element as it is, that with the lowest nodes first.
        let turned = |way: &&[u8]| way.iter().map(|&k| cell[usize::from(k)]).collect::<Vec<u32>>();
        let best = turns_of(cell.len()).map(|way| turned(&way)).min();
        if let Some(best) = best {
            cell.copy_from_slice(&best);
        } else if cell.first() > cell.last() {
            cell.reverse();
        }
    }

    fn add_around(cell: &[u32], sums: &mut [u64]) {
        // A facet inside is seen once from each side: what it adds for one cell it takes for the other.
        for facet in facets_of(cell.len()) {
            let facet = facet.map(|k| cell[usize::from(k)]);
            let [lowest, next, c, d] = facet.canonical();
            let (opposite, before) = if c == d { (0, c) } else { (c, d) };
            let mixed = [lowest, next.min(before), opposite, next.max(before)].iter().fold(0, |mixed, &node| mix(mixed ^ u64::from(node)));
            let signed = if next > before { mixed } else { mixed.wrapping_neg() };
            for &node in facet.corners() {
                let sum = &mut sums[node as usize];
                *sum = sum.wrapping_add(signed);
            }
        }
    }

    fn turn_over(cell: &mut [u32]) {
        match cell.len() {
            4 => cell.swap(1, 2),
            n @ (6 | 8) => (0..n / 2).for_each(|k| cell.swap(k, k + n / 2)),
            _ => {}
        }
    }
}

/// A number that has nothing in common with the one before. Steele, Lea, Flood, OOPSLA 2014 (SplitMix).
fn mix(number: u64) -> u64 {
    let number = number.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let number = (number ^ number >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let number = (number ^ number >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    number ^ number >> 31
}

fn has_no_length<const D: usize>(ends: &[[f64; D]]) -> Option<[&'static str; 2]> {
    let length: f64 = (0..D).map(|k| (ends[1][k] - ends[0][k]) * (ends[1][k] - ends[0][k])).sum();
    // NaN too.
    if length > 0.0 { None } else { Some(["has no length", MEND]) }
}

/// Neighbours of each corner of a tetrahedron, a wedge and a hexahedron, right-handed seen from inside the element.
pub(in crate::mesh) fn neighbours_of(nodes: usize) -> &'static [[u8; 3]] {
    match nodes {
        4 => &[[1, 2, 3], [2, 0, 3], [0, 1, 3], [0, 2, 1]],
        6 => &[[1, 2, 3], [2, 0, 4], [0, 1, 5], [5, 4, 0], [3, 5, 1], [4, 3, 2]],
        8 => &[[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]],
        _ => &[],
    }
}

/// Volume a · (b × c) that the edges from each corner span, m³: of a hexahedron eight times, of a wedge four times the Jacobian there, of a tetrahedron six times its volume.
pub(in crate::mesh) fn corner_volumes(corners: &[[f64; 3]]) -> impl Iterator<Item = f64> {
    corners.iter().zip(neighbours_of(corners.len())).map(|(x, neighbours)| {
        let [a, b, c] = neighbours.map(|k| {
            let y = corners[usize::from(k)];
            [y[0] - x[0], y[1] - x[1], y[2] - x[2]]
        });
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    })
}

/// Volume of a tetrahedron, wedge or hexahedron, m³, as the mean of the Jacobians at its corners: exact for tetrahedra and where opposite edges are parallel; negative
/// for one that is turned inside out, 0 for anything else.
#[must_use]
pub fn signed_volume(corners: &[[f64; 3]]) -> f64 {
    let n = corners.len();
    let share = match n {
        4 => 1.0 / 6.0,
        6 => 0.5,
        8 => 1.0,
        _ => return 0.0,
    };
    corner_volumes(corners).sum::<f64>() * share / n as f64
}

/// All ways to number the corners of an element anew that keep its facets and its orientation.
fn turns_of(nodes: usize) -> impl Iterator<Item = &'static [u8]> {
    let (of_tetrahedron, of_wedge, of_hexahedron) = match nodes {
        4 => (&TETRAHEDRON[..], &[][..], &[][..]),
        6 => (&[][..], &WEDGE[..], &[][..]),
        8 => (&[][..], &[][..], &HEXAHEDRON[..]),
        _ => (&[][..], &[][..], &[][..]),
    };
    let short = of_tetrahedron.iter().map(<[u8; 4]>::as_slice).chain(of_wedge.iter().map(<[u8; 6]>::as_slice));
    short.chain(of_hexahedron.iter().map(<[u8; 8]>::as_slice))
}

static TETRAHEDRON: [[u8; 4]; 12] = [
    [0, 1, 2, 3],
    [0, 2, 3, 1],
    [0, 3, 1, 2],
    [1, 0, 3, 2],
    [1, 3, 2, 0],
    [1, 2, 0, 3],
    [2, 0, 1, 3],
    [2, 1, 3, 0],
    [2, 3, 0, 1],
    [3, 0, 2, 1],
    [3, 2, 1, 0],
    [3, 1, 0, 2],
];

static WEDGE: [[u8; 6]; 6] =
    [[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4], [3, 5, 4, 0, 2, 1], [5, 4, 3, 2, 1, 0], [4, 3, 5, 1, 0, 2]];

/// Each of the six facets as the lower one (seen from inside), each of its four corners first.
static HEXAHEDRON: [[u8; 8]; 24] = {
    // Lower facets, counter-clockwise seen from inside, with the corners above them.
    const FACETS: [[u8; 8]; 6] = [
        [0, 1, 2, 3, 4, 5, 6, 7],
        [4, 7, 6, 5, 0, 3, 2, 1],
        [0, 4, 5, 1, 3, 7, 6, 2],
        [1, 5, 6, 2, 0, 4, 7, 3],
        [2, 6, 7, 3, 1, 5, 4, 0],
        [3, 7, 4, 0, 2, 6, 5, 1],
    ];
    let mut all = [[0; 8]; 24];
    let mut way = 0;
    while way < 24 {
        let mut k = 0;
        while k < 4 {
            all[way][k] = FACETS[way / 4][(way + k) % 4];
            all[way][k + 4] = FACETS[way / 4][4 + (way + k) % 4];
            k += 1;
        }
        way += 1;
    }
    all
};

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Corners of an element of its kind with positive volume.
    fn reference(nodes: usize) -> Vec<[f64; 3]> {
        match nodes {
            4 => vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            6 => vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
            _ => {
                [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(|x| x.map(f64::from)).to_vec()
            }
        }
    }

    fn directed(cell: &[u32]) -> BTreeSet<[u32; 4]> {
        facets_of(cell.len()).iter().map(|facet| facet.map(|k| cell[usize::from(k)]).canonical()).collect()
    }

    #[test]
    fn turning_an_element_keeps_its_facets_and_its_orientation() {
        for (nodes, count) in [(4, 12), (6, 6), (8, 24)] {
            let cell: Vec<u32> = (0..nodes as u32).collect();
            let ways: BTreeSet<Vec<u32>> = turns_of(nodes).map(|way| way.iter().map(|&k| u32::from(k)).collect()).collect();
            assert_eq!(ways.len(), count);
            for way in &ways {
                assert_eq!(directed(way), directed(&cell), "{way:?}");
                let x = reference(nodes);
                let turned: Vec<[f64; 3]> = way.iter().map(|&k| x[k as usize]).collect();
                assert!(corner_volumes(&turned).all(|volume| volume == 1.0), "{way:?}");
            }
            // However it is written, it becomes the same.
            let best = |cell: &[u32]| {
                let mut cell = cell.to_vec();
                Dim::<3>::begin_with_lowest(&mut cell);
                cell
            };
            let mixed: Vec<u32> = (0..nodes as u32).map(|k| (5 * k + 3) % 11).collect();
            let all: BTreeSet<Vec<u32>> =
                ways.iter().map(|way| best(&way.iter().map(|&k| mixed[k as usize]).collect::<Vec<_>>())).collect();
            assert_eq!(all.len(), 1);
            assert!(all.iter().all(|cell| cell[0] == *mixed.iter().min().unwrap()));
        }
    }

    #[test]
    fn an_element_that_is_mirrored_and_turned_over_has_its_volume() {
        for nodes in [4, 6, 8] {
            let mirrored: Vec<[f64; 3]> = reference(nodes).into_iter().map(|[x, y, z]| [-x, y, z]).collect();
            assert!(Dim::<3>::wrong_form(&mirrored).unwrap()[0].contains("negative volume"));
            let mut cell: Vec<u32> = (0..nodes as u32).collect();
            Dim::<3>::turn_over(&mut cell);
            let corners: Vec<[f64; 3]> = cell.iter().map(|&k| mirrored[k as usize]).collect();
            assert_eq!(Dim::<3>::wrong_form(&corners), None);
        }
    }

    #[test]
    fn facets_look_outwards() {
        for nodes in [4, 6, 8] {
            let x = reference(nodes);
            let centre: [f64; 3] = std::array::from_fn(|d| x.iter().map(|x| x[d]).sum::<f64>() / nodes as f64);
            for facet in facets_of(nodes) {
                let [a, b, c] = [0, 1, 2].map(|k| x[usize::from(facet[k])]);
                let corners = [centre, a, b, c];
                // The centre is behind: the tetrahedron from it has positive volume.
                assert!(corner_volumes(&corners).next().unwrap() > 0.0, "{nodes} {facet:?}");
            }
        }
    }

    #[test]
    fn an_element_that_folds_over_or_is_flat_is_wrong() {
        let mut x = reference(8);
        x[6] = [-0.5, -0.5, 0.2];
        assert!(Dim::<3>::wrong_form(&x).unwrap()[0].contains("folds over"));
        let flat: Vec<[f64; 3]> = reference(4).into_iter().map(|[x, y, _]| [x, y, 0.0]).collect();
        assert!(Dim::<3>::wrong_form(&flat).is_some());
        assert!(Dim::<3>::wrong_form(&[[f64::NAN; 3]; 4]).is_some());
    }
}
