//! The order in which nodes and elements are stored and summed: along a Hilbert curve through the initial positions.
//!
//! Neighbours in space are neighbours in memory, and the order depends on the bodies alone, not on who numbered them: the same positions from
//! a shape and from a mesh file give the same results to the last bit. Outputs and messages speak the user's numbering.

use super::{ElementGroup, Mesh};

/// Bits per coordinate of the curve.
const BITS: u32 = 31;

impl Mesh<2> {
    /// Renumbers nodes, elements and corners; `user_nodes` and `user_elements` lead back.
    pub(super) fn reorder(&mut self) {
        let codes = codes(&self.positions);
        let mut owner = vec![u32::MAX; self.positions.len()];
        for (index, part) in self.parts.iter().enumerate().rev() {
            part.nodes.iter().for_each(|&node| owner[node as usize] = index as u32);
        }
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        // Bodies that touch have nodes in one place: the part's rank in the model decides, then the coordinates behind the curve's resolution.
        order.sort_by(|&a, &b| {
            let (a, b) = (a as usize, b as usize);
            let place = |n: usize| self.positions[n];
            let exact = || place(a)[0].total_cmp(&place(b)[0]).then(place(a)[1].total_cmp(&place(b)[1]));
            codes[a].cmp(&codes[b]).then(owner[a].cmp(&owner[b])).then_with(exact).then(a.cmp(&b))
        });
        let mut number = vec![0u32; order.len()];
        for (&user, new) in order.iter().zip(0..) {
            number[user as usize] = new;
        }
        self.positions = order.iter().map(|&user| self.positions[user as usize]).collect();
        let rename = |nodes: &mut [u32]| nodes.iter_mut().for_each(|node| *node = number[*node as usize]);
        self.parts.iter_mut().for_each(|part| rename(&mut part.nodes));
        for group in &mut self.groups {
            rename(&mut group.connectivity);
            group.reorder(&self.positions);
        }
        self.lines.values_mut().flatten().for_each(|line| rename(line));
        for nodes in self.points.values_mut() {
            rename(nodes);
            nodes.sort_unstable();
        }
        self.user_nodes = order;
    }
}

impl ElementGroup {
    /// Puts the elements in the order of the curve, given the new positions.
    fn reorder(&mut self, positions: &[[f64; 2]]) {
        let n = self.nodes_per_element;
        // Each element begins with its lowest node; the direction of turning stays.
        for cell in self.connectivity.chunks_exact_mut(n) {
            let lowest = (0..n).min_by_key(|&corner| cell[corner]).unwrap_or(0);
            cell.rotate_left(lowest);
        }
        let centre = |cell: &[u32]| {
            let sum = cell.iter().fold([0.0; 2], |sum: [f64; 2], &node| {
                let x = positions[node as usize];
                [sum[0] + x[0], sum[1] + x[1]]
            });
            [sum[0] / n as f64, sum[1] / n as f64]
        };
        let centres: Vec<[f64; 2]> = self.connectivity.chunks_exact(n).map(centre).collect();
        let codes = codes(&centres);
        let mut order: Vec<u32> = (0..centres.len() as u32).collect();
        order.sort_by_key(|&element| {
            let cell = &self.connectivity[element as usize * n..(element as usize + 1) * n];
            (codes[element as usize], cell[0], cell[1], element)
        });
        self.connectivity =
            order.iter().flat_map(|&user| self.connectivity[user as usize * n..(user as usize + 1) * n].iter().copied()).collect();
        self.user_elements = order.iter().map(|&user| self.user_elements[user as usize]).collect();
    }
}

/// Place of each point on a Hilbert curve through the box of all of them; points that are not finite come first.
fn codes(points: &[[f64; 2]]) -> Vec<u64> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in points {
        for d in 0..2 {
            low[d] = low[d].min(point[d]);
            high[d] = high[d].max(point[d]);
        }
    }
    // One scale for both directions, so that neighbours along the curve are near in space.
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let scale = if size > 0.0 { f64::from((1u32 << BITS) - 1) / size } else { 0.0 };
    // A float becomes a whole number by rounding towards zero; NaN becomes 0.
    points.iter().map(|point| hilbert([0, 1].map(|d| ((point[d] - low[d]) * scale) as u32))).collect()
}

/// Distance along the Hilbert curve of the cell (x, y) of a grid of 2^31 by 2^31 cells. Hilbert, Math. Annalen 38 (1891) 459-460.
fn hilbert([mut x, mut y]: [u32; 2]) -> u64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_in_space() {
        let n = 16;
        let mut cells: Vec<[u32; 2]> = (0..n * n).map(|k| [k % n, k / n]).collect();
        let shift = BITS - 4;
        cells.sort_by_key(|[x, y]| hilbert([x << shift, y << shift]));
        for pair in cells.windows(2) {
            assert_eq!(pair[0][0].abs_diff(pair[1][0]) + pair[0][1].abs_diff(pair[1][1]), 1, "{pair:?}");
        }
    }
}
