//! The order in which nodes and elements are stored and summed: along a Hilbert curve through the initial
//! positions.
//!
//! Neighbours in 3D are neighbours in memory, and the order depends on the bodies alone, not on who
//! numbered them: the same positions from a shape and from a mesh file give the same results to the last bit.
//! Outputs and messages speak the user's numbering.
//!
//! Nodes on outlines come before all others, each kind in the order of the curve: what contact reads of them
//! lies side by side and stays in the caches, however large the bodies are.

use super::cell::CellKind;
use super::surface::Corners;
use super::{Dim, ElementGroup, Mesh, Meshed};
use std::cmp::Ordering;

/// Bits per coordinate of the curve in 2D.
const BITS: u32 = <Dim<2> as Meshed<2>>::CURVE_BITS;

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Renumbers nodes, elements and corners; `user_nodes` and `user_elements` lead back. Lines of parts that
    /// are `directed` keep their direction: shells have a left and a right, beams a first node.
    pub(super) fn reorder(&mut self, directed: impl Fn(usize) -> bool) {
        let mut owner = vec![u32::MAX; self.positions.len()];
        for (index, part) in self.parts.iter().enumerate().rev() {
            part.nodes.iter().for_each(|&node| owner[node as usize] = index as u32);
        }
        // Bodies that touch have nodes in one place: the part's rank in the model decides, then the
        // coordinates behind the curve's resolution.
        let order = sorted(codes(self.positions.iter().copied()), |a, b| {
            let (a, b) = (a as usize, b as usize);
            let place = |n: usize| self.positions[n];
            let exact = || (0..D).fold(Ordering::Equal, |order, d| order.then(place(a)[d].total_cmp(&place(b)[d])));
            owner[a].cmp(&owner[b]).then_with(exact)
        });
        drop(owner);
        self.renumber(&order);
        self.user_nodes = order;
        for group in &mut self.groups {
            group.reorder(&self.positions, directed(group.part));
        }
        self.put_outlines_first();
    }

    /// Numbers the nodes in the order that names their present numbers.
    fn renumber(&mut self, order: &[u32]) {
        let mut number = vec![0u32; order.len()];
        for (&old, new) in order.iter().zip(0..) {
            number[old as usize] = new;
        }
        self.positions = order.iter().map(|&old| self.positions[old as usize]).collect();
        let rename = |nodes: &mut [u32]| nodes.iter_mut().for_each(|node| *node = number[*node as usize]);
        self.parts.iter_mut().for_each(|part| rename(&mut part.nodes));
        self.groups.iter_mut().for_each(|group| rename(&mut group.connectivity));
        let surfaces = self.surfaces.values_mut().flatten().flat_map(|(_, facets)| facets);
        for facet in self.sides.values_mut().flatten().chain(surfaces) {
            *facet = facet.renamed(|node| number[node as usize]).canonical();
        }
        for nodes in self.points.values_mut().chain(self.sets.values_mut().flatten().map(|(_, nodes)| nodes)) {
            rename(nodes);
            nodes.sort_unstable();
        }
    }

    /// Moves the nodes on outlines before the others.
    fn put_outlines_first(&mut self) {
        let mut around = vec![0u64; self.positions.len()];
        for cell in self.groups.iter().flat_map(ElementGroup::cells) {
            Dim::<D>::add_around(cell, &mut around);
        }
        self.outlines = around.iter().map(|&sum| sum != 0).collect();
        drop(around);
        let of = |wanted: bool| (0..).zip(&self.outlines).filter(move |&(_, &is_outer)| is_outer == wanted).map(|(node, _)| node);
        let order: Vec<u32> = of(true).chain(of(false)).collect();
        self.renumber(&order);
        self.user_nodes = order.iter().map(|&node| self.user_nodes[node as usize]).collect();
    }

    /// The nodes in the order of the curve.
    pub(crate) fn along_curve(&self) -> impl Iterator<Item = usize> {
        let mut next = [self.outlines.iter().filter(|&&is_outer| is_outer).count(), 0];
        self.outlines.iter().map(move |&is_outer| {
            let next = &mut next[usize::from(is_outer)];
            *next += 1;
            *next - 1
        })
    }
}

/// Nodes in the order of the curve through these places.
pub(super) fn along<const D: usize>(places: &[[f64; D]]) -> Vec<u32>
where
    Dim<D>: Meshed<D>,
{
    let exact = |a: u32, b: u32| {
        let [a, b] = [a, b].map(|node| places[node as usize]);
        (0..D).fold(Ordering::Equal, |order, d| order.then(a[d].total_cmp(&b[d])))
    };
    sorted(codes(places.iter().copied()), exact)
}

impl ElementGroup {
    /// Puts the elements in the order of the curve, given the new positions.
    pub(super) fn reorder<const D: usize>(&mut self, positions: &[[f64; D]], is_directed: bool)
    where
        Dim<D>: Meshed<D>,
    {
        let n = self.kind.nodes();
        if !(is_directed && self.kind == CellKind::Line) {
            self.connectivity.chunks_exact_mut(n).for_each(|nodes| self.kind.begin_with_lowest(nodes));
        }
        let centre = |cell: &[u32]| {
            let sum = cell.iter().fold([0.0; D], |sum: [f64; D], &node| {
                let x = positions[node as usize];
                std::array::from_fn(|d| sum[d] + x[d])
            });
            sum.map(|sum| sum / n as f64)
        };
        let codes = codes(self.connectivity.chunks_exact(n).map(centre));
        let order = sorted(codes, |a, b| {
            let first = |element: u32| &self.connectivity[element as usize * n..][..2];
            first(a).cmp(first(b))
        });
        let mut connectivity = Vec::with_capacity(self.connectivity.len());
        order.iter().for_each(|&user| connectivity.extend_from_slice(&self.connectivity[user as usize * n..][..n]));
        self.connectivity = connectivity;
        self.user_elements = order.iter().map(|&user| self.user_elements[user as usize]).collect();
    }
}

/// Indices of `codes` in their order; `tie` decides between equal ones, then the index.
fn sorted(codes: Vec<u64>, tie: impl Fn(u32, u32) -> Ordering) -> Vec<u32> {
    // Side by side, so that sorting does not jump about in memory.
    let mut places: Vec<(u64, u32)> = codes.into_iter().zip(0..).collect();
    places.sort_unstable();
    for equal in places.chunk_by_mut(|a, b| a.0 == b.0).filter(|equal| equal.len() > 1) {
        equal.sort_unstable_by(|a, b| tie(a.1, b.1).then(a.1.cmp(&b.1)));
    }
    places.into_iter().map(|(_, index)| index).collect()
}

/// Place of each point on a Hilbert curve through the box of all of them; points that are not finite come
/// first.
fn codes<const D: usize>(points: impl Iterator<Item = [f64; D]> + Clone) -> Vec<u64>
where
    Dim<D>: Meshed<D>,
{
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for point in points.clone() {
        for d in 0..D {
            low[d] = low[d].min(point[d]);
            high[d] = high[d].max(point[d]);
        }
    }
    // One scale for all directions, so that neighbours along the curve are near in 3D.
    let size = (1..D).fold(high[0] - low[0], |size, d| size.max(high[d] - low[d]));
    let scale = if size > 0.0 { f64::from((1u32 << Dim::<D>::CURVE_BITS) - 1) / size } else { 0.0 };
    // A float becomes a whole number by rounding towards zero; NaN becomes 0.
    points.map(|point| Dim::<D>::along_curve(std::array::from_fn(|d| ((point[d] - low[d]) * scale) as u32))).collect()
}

/// Distance along the Hilbert curve of the cell (x, y) of a grid of 2^31 by 2^31 cells. Hilbert, Math.
/// Annalen 38 (1891) 459-460.
pub(super) fn hilbert([x, y]: [u32; 2]) -> u64 {
    let (mut distance, mut sense) = (0u64, 0usize);
    // The curve in a quarter is that of the whole, turned: 31 bits of each coordinate, one by one and then
    // three at a time.
    let mut low = BITS - 1;
    for bits in [1; 1].into_iter().chain([3; 10]) {
        let mask = (1 << bits) - 1;
        let at = (x >> low & mask) << 3 | (y >> low & mask);
        let (path, next) = STRETCH[bits as usize / 3][sense][at as usize];
        distance = distance << (2 * bits) | u64::from(path);
        sense = usize::from(next);
        low = low.saturating_sub(3);
    }
    distance
}

/// Distance along a Hilbert curve of the cell (x, y, z) of a grid of 2^21 cells in each direction:
/// coordinates are turned into the curve's digits in place. Skilling, AIP Conf. Proc. 707 (2004) 381-387.
pub(super) fn hilbert_in_3d(mut cell: [u32; 3]) -> u64 {
    const HIGHEST: u32 = 1 << (<Dim<3> as Meshed<3>>::CURVE_BITS - 1);
    // Each cube of the curve is the whole one, turned and mirrored: undone from the largest cubes to the
    // smallest.
    let mut bit = HIGHEST;
    while bit > 1 {
        let below = bit - 1;
        for d in 0..3 {
            if cell[d] & bit != 0 {
                cell[0] ^= below;
            } else {
                let exchanged = (cell[0] ^ cell[d]) & below;
                cell[0] ^= exchanged;
                cell[d] ^= exchanged;
            }
        }
        bit >>= 1;
    }
    // Gray code.
    cell[1] ^= cell[0];
    cell[2] ^= cell[1];
    let mut turned = 0;
    let mut bit = HIGHEST;
    while bit > 1 {
        if cell[2] & bit != 0 {
            turned ^= bit - 1;
        }
        bit >>= 1;
    }
    let cell = cell.map(|x| x ^ turned);
    (0..<Dim<3> as Meshed<3>>::CURVE_BITS).rev().fold(0, |distance, bit| {
        let digit = cell.iter().fold(0, |digit, x| digit << 1 | (x >> bit & 1));
        distance << 3 | u64::from(digit)
    })
}

/// By bits per coordinate (1 or 3), sense and place (x · 8 + y): the way along the curve through the squares
/// of those bits, and the sense in the last one.
static STRETCH: [[[(u8, u8); 64]; 4]; 2] = [stretch(1), stretch(3)];

/// A sense says how the curve lies in a square: 1 turned by half a turn, 2 with x and y exchanged, 3 both.
const fn stretch(bits: u32) -> [[(u8, u8); 64]; 4] {
    let mut table = [[(0, 0); 64]; 4];
    let mut sense = 0;
    while sense < 4 {
        let mut at = 0;
        while at < 64 {
            let (mut turned, mut exchanged) = (sense & 1, sense >> 1);
            let (mut path, mut bit) = (0, bits);
            while bit > 0 {
                bit -= 1;
                let (x, y) = (at >> (3 + bit) & 1 ^ turned, at >> bit & 1 ^ turned);
                let (right, upper) = if exchanged == 1 { (y, x) } else { (x, y) };
                path = path << 2 | (3 * right) ^ upper;
                if upper == 0 {
                    turned ^= right;
                    exchanged ^= 1;
                }
            }
            table[sense][at] = (path as u8, (turned | exchanged << 1) as u8);
            at += 1;
        }
        sense += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Model, Part, Rectangle, Shape};

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_3d() {
        let n = 16;
        let mut cells: Vec<[u32; 2]> = (0..n * n).map(|k| [k % n, k / n]).collect();
        let shift = BITS - 4;
        cells.sort_by_key(|[x, y]| hilbert([x << shift, y << shift]));
        for pair in cells.windows(2) {
            assert_eq!(pair[0][0].abs_diff(pair[1][0]) + pair[0][1].abs_diff(pair[1][1]), 1, "{pair:?}");
        }
    }

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_3d_also_in_three_dimensions() {
        let n = 8;
        let mut cells: Vec<[u32; 3]> = (0..n * n * n).map(|k| [k % n, k / n % n, k / n / n]).collect();
        for shift in [0, <Dim<3> as Meshed<3>>::CURVE_BITS - 3] {
            cells.sort_by_key(|cell| hilbert_in_3d(cell.map(|x| x << shift)));
            for pair in cells.windows(2) {
                assert_eq!((0..3).map(|d| pair[0][d].abs_diff(pair[1][d])).sum::<u32>(), 1, "{pair:?}");
            }
        }
        assert_eq!(hilbert_in_3d([0; 3]), 0);
    }

    #[test]
    fn outlines_come_first_and_the_curve_is_still_known() {
        let shape = |elements: [usize; 2]| Shape::Rectangle(Rectangle { size: [3.0, 2.0], elements, ..Rectangle::default() });
        let part = |name: &str, elements| Part { name: name.into(), shape: shape(elements), ..Part::default() };
        let mesh = Mesh::new(&Model { parts: vec![part("coarse", [3, 2]), part("fine", [7, 5])], ..Model::default() }).unwrap();
        let is_outer = |[x, y]: [f64; 2]| x.min(y).min(3.0 - x).min(2.0 - y) < 1e-9;
        let outer: Vec<bool> = mesh.positions.iter().map(|&x| is_outer(x)).collect();
        assert!(outer.is_sorted_by(|a, b| a >= b) && outer.iter().filter(|&&outer| outer).count() == 10 + 24, "{outer:?}");
        let along: Vec<usize> = mesh.along_curve().collect();
        let codes = codes(along.iter().map(|&node| mesh.positions[node]));
        assert!(codes.is_sorted(), "{codes:?}");
        let mut all = along;
        all.sort_unstable();
        assert!(all.into_iter().eq(0..mesh.positions.len()));
    }

    /// The definition, one bit at a time.
    fn hilbert_by_bits([mut x, mut y]: [u32; 2]) -> u64 {
        let mut distance = 0u64;
        let full = (1u32 << BITS) - 1;
        for bit in (0..BITS).rev() {
            let side = 1u32 << bit;
            let (right, upper) = (x & side != 0, y & side != 0);
            let quadrant = (3 * u64::from(right)) ^ u64::from(upper);
            distance += quadrant << (2 * bit);
            if !upper {
                if right {
                    (x, y) = (full - x, full - y);
                }
                std::mem::swap(&mut x, &mut y);
            }
        }
        distance
    }

    #[test]
    fn three_bits_at_a_time_give_the_same_place() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32
        };
        let last = (1u32 << BITS) - 1;
        for place in [[0, 0], [last, 0], [0, last], [last, last]].into_iter().chain((0..10_000).map(|_| [random(), random()])) {
            assert_eq!(hilbert(place), hilbert_by_bits(place), "{place:?}");
        }
    }
}
