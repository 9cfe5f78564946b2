//! From triangles to quadrilaterals: pairs of triangles are merged, then each quadrilateral is divided into
//! four and each triangle that is left into three.
//!
//! The pairs are taken greedily, those that make the best quadrilateral first. All cells are quadrilaterals
//! then, whatever pairs there were, and every edge is halved.

use super::quality::scaled;
use crate::plane::{Cell, Point, minus};
use std::collections::BTreeMap;

/// The least scaled Jacobian of a quadrilateral that is worth more than two triangles.
const WORTH: f64 = 0.35;
/// The least sine of an angle of a triangle with a turned edge.
const FAIR: f64 = 0.15;

/// What a node is for the cells around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Inside: it needs three cells.
    Inner,
    /// On a nearly straight piece of the outline: it needs two.
    Flat,
    /// At a convex corner of the outline: one is enough.
    Corner,
}

/// Cells of both kinds from triangles.
pub(super) fn merged(positions: &[Point], triangles: &[[u32; 3]], kinds: &[Kind]) -> Vec<Cell> {
    let triangles = &flipped(positions, triangles, kinds);
    // Directed edges by their ends: the triangle on the left.
    let mut left: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let mut cells_at = vec![0_u32; positions.len()];
    for (t, nodes) in (0..).zip(triangles) {
        for k in 0..3 {
            left.insert([nodes[k], nodes[(k + 1) % 3]], t);
            cells_at[nodes[k] as usize] += 1;
        }
    }
    let third = |t: u32, [a, b]: [u32; 2]| triangles[t as usize].iter().copied().find(|&node| node != a && node != b);
    // Worth of each pair, with its edge.
    let mut pairs: Vec<(f64, [u32; 2], [u32; 2], Cell)> = Vec::new();
    for (&[a, b], &one) in left.range([0, 0]..) {
        let Some(&other) = left.get(&[b, a]).filter(|_| a < b) else { continue };
        let (Some(c), Some(d)) = (third(one, [a, b]), third(other, [a, b])) else { continue };
        let cell = [a, d, b, c];
        let x = cell.map(|node| positions[node as usize]);
        let corner = |k: usize| scaled(minus(x[(k + 1) % 4], x[k]), minus(x[(k + 3) % 4], x[k]));
        let worth = (0..4).map(corner).fold(f64::INFINITY, f64::min);
        if worth > WORTH {
            pairs.push((worth, [a, b], [one, other], cell));
        }
    }
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
    let mut taken = vec![false; triangles.len()];
    let mut cells = Vec::new();
    for (_, [a, b], pair, cell) in pairs {
        let least = |node: u32| match kinds[node as usize] {
            Kind::Inner => 3,
            Kind::Flat => 2,
            Kind::Corner => 1,
        };
        let poor = |node: u32| cells_at[node as usize] <= least(node);
        if pair.iter().any(|&t| taken[t as usize]) || poor(a) || poor(b) {
            continue;
        }
        pair.iter().for_each(|&t| taken[t as usize] = true);
        [a, b].iter().for_each(|&node| cells_at[node as usize] -= 1);
        cells.push(cell);
    }
    let rest = triangles.iter().zip(&taken).filter(|(_, taken)| !**taken);
    cells.extend(rest.map(|(&[a, b, c], _)| [a, b, c, c]));
    cells
}

/// Triangles such that no node on a flat piece of the outline has one only: the edge opposite it is turned.
fn flipped(positions: &[Point], triangles: &[[u32; 3]], kinds: &[Kind]) -> Vec<[u32; 3]> {
    let mut triangles = triangles.to_vec();
    let mut count = vec![0_u32; positions.len()];
    triangles.iter().flatten().for_each(|&node| count[node as usize] += 1);
    let mut left: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    for (t, nodes) in triangles.iter().enumerate() {
        (0..3).for_each(|k| {
            left.insert([nodes[k], nodes[(k + 1) % 3]], t);
        });
    }
    for t in 0..triangles.len() {
        let Some(k) = (0..3).find(|&k| {
            let node = triangles[t][k] as usize;
            count[node] == 1 && kinds[node] == Kind::Flat
        }) else {
            continue;
        };
        let [n, a, b] = [0, 1, 2].map(|j| triangles[t][(k + j) % 3]);
        let Some(&other) = left.get(&[b, a]) else { continue };
        let Some(c) = triangles[other].iter().copied().find(|&node| node != a && node != b) else { continue };
        let fair = |nodes: [u32; 3]| {
            let [x, y, z] = nodes.map(|node| positions[node as usize]);
            let corner = |o: Point, a: Point, b: Point| scaled(minus(a, o), minus(b, o));
            corner(x, y, z).min(corner(y, z, x)).min(corner(z, x, y)) > FAIR
        };
        let (one, two) = ([n, a, c], [n, c, b]);
        if !fair(one) || !fair(two) || count[a as usize] < 3 || count[b as usize] < 3 {
            continue;
        }
        [a, b].iter().for_each(|&node| count[node as usize] -= 1);
        [n, c].iter().for_each(|&node| count[node as usize] += 1);
        (triangles[t], triangles[other]) = (one, two);
        left.remove(&[a, b]);
        left.remove(&[b, a]);
        for (nodes, t) in [(one, t), (two, other)] {
            (0..3).for_each(|k| {
                left.insert([nodes[k], nodes[(k + 1) % 3]], t);
            });
        }
    }
    triangles
}

/// Quadrilaterals from cells of both kinds, with nodes in the middle of each edge and cell. Edges that
/// `middles` has, by their ends with the lower one first, have their node already.
pub(super) fn divided(positions: &mut Vec<Point>, cells: &[Cell], mut middles: BTreeMap<[u32; 2], u32>) -> Vec<Cell> {
    let mut quadrilaterals = Vec::with_capacity(4 * cells.len());
    for cell in cells {
        let nodes = crate::plane::corners(cell);
        let n = nodes.len();
        let mean = |positions: &[Point], nodes: &[u32]| {
            [0, 1].map(|d| nodes.iter().map(|&node| positions[node as usize][d]).sum::<f64>() / nodes.len() as f64)
        };
        let centre = positions.len() as u32;
        positions.push(mean(positions, nodes));
        let mut halves = [0; 4];
        for k in 0..n {
            let [a, b] = [nodes[k], nodes[(k + 1) % n]];
            halves[k] = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push(mean(positions, &[a.min(b), a.max(b)]));
                positions.len() as u32 - 1
            });
        }
        quadrilaterals.extend((0..n).map(|k| [nodes[k], halves[k], centre, halves[(k + n - 1) % n]]));
    }
    quadrilaterals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_triangles_of_a_square_become_four_squares_and_a_third_three_more() {
        let mut positions = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.5, 0.5]];
        let cells = merged(&positions, &[[0, 1, 2], [0, 2, 3], [1, 4, 2]], &[Kind::Corner; 5]);
        assert_eq!(cells, [[0, 1, 2, 3], [1, 4, 2, 2]]);
        positions.push([0.5, -0.1]);
        let quadrilaterals = divided(&mut positions, &cells, BTreeMap::from([([0, 1], 5)]));
        // Seven edges, of which one has its node, one inside the square, and two cells.
        assert_eq!((quadrilaterals.len(), positions.len()), (7, 6 + 5 + 2));
        assert!(quadrilaterals.iter().all(|cell| cell[2] != cell[3]));
        assert_eq!(quadrilaterals[0], [0, 5, 6, 9]);
    }
}
