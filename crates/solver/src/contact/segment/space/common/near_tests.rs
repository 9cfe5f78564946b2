//! Corners that are near edges of the other surface.

use super::*;
use crate::bench::Random;

/// Cells of each of two square surfaces of unit cells in each direction.
const CELLS: usize = 3;

/// Two surfaces of crooked cells, nearly corner on corner, with a gap between; the second has a fold of this
/// slope at its middle, and so has the first.
struct Two {
    positions: Vec<Vector>,
    facets: [Vec<[u32; 4]>; 2],
}

fn two(by: [f64; 2], turn: f64, fold: f64, is_split: bool) -> Two {
    let (mut random, mut positions, mut facets) = (Random::new(5), Vec::new(), [Vec::new(), Vec::new()]);
    let side = CELLS + 1;
    let plane: Vec<[f64; 2]> =
        (0..side * side).map(|k| [k % side, k / side].map(|c| c as f64 - 0.5 * CELLS as f64 + 0.2 * (random.unit() - 0.5))).collect();
    for (k, list) in facets.iter_mut().enumerate() {
        for &[x, y] in &plane {
            let [x, y] = if k == 0 { [x + by[0] - turn * y, y + by[1] + turn * x] } else { [x, y] };
            positions.push([x, y, fold * (x - 0.5).max(0.0) - if k == 0 { 1e-2 } else { 0.0 }]);
        }
        for cell in 0..CELLS * CELLS {
            let first = (k * side * side + cell / CELLS * side + cell % CELLS) as u32;
            let [a, b, c, d] = [first, first + 1, first + 1 + side as u32, first + side as u32];
            let all = if is_split { vec![[a, b, c, c], [a, c, d, d]] } else { vec![[a, b, c, d]] };
            let behind = |[a, b, c, d]: [u32; 4]| if c == d { [b, a, c, c] } else { [a, d, c, b] };
            list.extend(all.into_iter().map(|facet| if k == 0 { behind(facet) } else { facet }));
        }
    }
    Two { positions, facets }
}

impl Two {
    fn borders(&self, k: usize, facet: [u32; 4]) -> Borders {
        let normal = |facet: [u32; 4]| Frame::new(facet, &self.positions).normal;
        let edge = |facet: [u32; 4], k: usize| {
            let corners = facet.corners();
            (k < corners.len()).then(|| [corners[k], corners[(k + 1) % corners.len()]])
        };
        Borders::new([0, 1, 2, 3].map(|i| {
            let Some([a, b]) = edge(facet, i) else { return -1.0 };
            let beyond = self.facets[k].iter().find(|&&other| (0..4).any(|i| edge(other, i) == Some([b, a])));
            beyond.map_or(-1.0, |&other| dot(normal(facet), normal(other)))
        }))
    }

    /// ∫ N dA of each node over all common parts, and how many these are.
    fn loads(&self, cut: usize, is_soft: bool) -> (Vec<f64>, usize) {
        let (mut loads, mut count) = (vec![0.0; self.positions.len()], 0);
        for &a in &self.facets[0] {
            for &b in &self.facets[1] {
                let frames = [a, b].map(|facet| Frame::new(facet, &self.positions));
                let mut facets = Facets::alone([&frames[0], &frames[1]]);
                if is_soft {
                    facets = Facets { borders: [self.borders(0, a), self.borders(1, b)], cut, ..facets };
                }
                let found = |level| Common::new(&facets, false, 0.0, level);
                let parts = |level| found(level).map(|common| common.parts);
                assert!(Level::available().into_iter().all(|level| parts(level) == parts(Level::best())));
                let Some(common) = found(Level::best()) else { continue };
                for part in common.parts() {
                    common.shares(part).for_each(|(node, share)| loads[node as usize] += part.area * share);
                }
                count += 1;
            }
        }
        (loads, count)
    }
}

fn most_apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn corners_near_edges_count_as_on_them_and_loads_keep_ten_digits() {
    for (is_split, cut) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
        let alike = CELLS * CELLS * if is_split { 2 } else { 1 };
        for size in [0.0, 1e-13, 1e-9, 0.1e-6, 0.3e-6, 0.9e-6, 1.1e-6, 1.5e-6, 1e-5] {
            for (x, y, turn) in [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.6, -1.0, 0.0), (0.3, 0.2, 0.7), (0.0, 0.0, -1.0)] {
                let two = two([x * size, y * size], turn * size, 0.0, is_split);
                let ((exact, parts), (soft, few)) = (two.loads(0, false), two.loads(cut, true));
                let off = most_apart(&exact, &soft);
                assert!(off < 1e-11, "{is_split} {cut} {size} {x} {y} {turn}: {off}");
                // Those at rims are as they are.
                let is_near = size > 1e-9 && size <= if is_split { 0.1e-6 } else { 0.3e-6 };
                assert!(few <= parts && (!is_near || few == alike && parts > alike), "{size} {x} {y} {turn}: {few} of {parts}");
                assert!(size < 1e-5 || few > alike, "{size} {x} {y} {turn}: {few} of {parts}");
            }
        }
    }
}

#[test]
fn loads_have_no_jump_where_corners_come_near_edges_and_surfaces_have_a_fold() {
    for (number, fold) in [0.0, 0.1, 0.5, 0.8].into_iter().enumerate() {
        let ways = [[1.0, 0.0], [-1.0, 0.0], [0.4, 0.7]];
        // Each way with one fold at least.
        for way in ways.into_iter().enumerate().filter(|(k, _)| crate::random::long::is_long() || number % 3 == *k).map(|(_, way)| way) {
            let mut before: Option<Vec<f64>> = None;
            for step in 0..400 {
                let by = way.map(|c| c * (5e-9 * f64::from(step) + 0.3e-6));
                let two = two(by, 0.0, fold, false);
                let (exact, soft) = (two.loads(0, false).0, two.loads(0, true).0);
                let off: Vec<f64> = soft.iter().zip(&exact).map(|(soft, exact)| soft - exact).collect();
                if let Some(before) = before {
                    let jump = most_apart(&before, &off);
                    // With a fold both pairs see other distances: in a step of 5 nm no more than the width of
                    // the strips changes.
                    let allowed = if fold == 0.0 { 1e-11 } else { 3.0 * 5e-9 };
                    assert!(jump < allowed, "{fold} {way:?} {step}: {jump}");
                }
                before = Some(off);
            }
        }
    }
}
