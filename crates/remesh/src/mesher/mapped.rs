//! Rows and columns of quadrilaterals in a region with four corners, by transfinite interpolation.
//!
//! Source: Gordon & Hall, Int. J. Numer. Meth. Eng. 7 (1973) 461-477.

use super::outline::Line;
use super::{KeptOut, Meshed, OnOutline, smooth, volume};
use crate::plane::{Cell, Measure, Point, cross, dot, minus};

/// Cosine of the turn, 45 degrees, that makes a corner.
const CORNER: f64 = 0.707_106_781_186_547_5;
/// A side may have this many times the edges of the one opposite.
const UNLIKE: f64 = 2.2;
/// Longest and shortest edge by the wanted one; the shortest ones across a strip may be shorter.
const LONG: f64 = 1.8;
const SHORT: f64 = 0.45;

/// The mesh; `None` where the region is not one with four corners and sides of like lengths. The line has
/// places for all edges.
pub(super) fn mapped(line: &Line, size: &dyn Fn(Point) -> f64, measure: Measure, limit: usize, kept_out: KeptOut<'_>) -> Option<Meshed> {
    let corners = corners(line)?;
    let mut line = line.clone();
    let count = line.chains.len();
    line.chains.rotate_left(corners[0]);
    // Chains of each side.
    let first = corners.map(|corner| corner - corners[0]);
    let sides: [std::ops::Range<usize>; 4] = [0, 1, 2, 3].map(|k| first[k]..if k < 3 { first[k + 1] } else { count });
    let edges = |line: &Line, side: &std::ops::Range<usize>| -> usize {
        line.chains[side.clone()].iter().map(|chain| chain.places.len() - 1).sum()
    };
    let mut counts = [0; 2];
    for k in 0..2 {
        let [one, other] = [&sides[k], &sides[k + 2]].map(|side| edges(&line, side));
        if one.max(other) as f64 > UNLIKE * one.min(other) as f64 {
            return None;
        }
        counts[k] = (one + other).div_ceil(2).max(sides[k].len()).max(sides[k + 2].len()).max(2);
    }
    let [columns, rows] = counts;
    if columns.checked_mul(rows)? > limit {
        return None;
    }
    for (k, side) in sides.iter().enumerate() {
        let chains = &mut line.chains[side.clone()];
        let shares = shared(&chains.iter().map(|chain| chain.places.len() - 1).collect::<Vec<_>>(), counts[k % 2]);
        for (chain, share) in chains.iter_mut().zip(shares) {
            chain.places = respaced(&chain.places, share);
        }
    }
    let before = line.chains.iter().map(|chain| chain.places.len()).sum::<usize>();
    let mut lines = [line];
    let nodes = volume::corrected(&mut lines, measure, false, kept_out)?;
    let [line] = lines;
    if line.chains.iter().map(|chain| chain.places.len()).sum::<usize>() != before {
        return None;
    }
    // Around, from the first corner on.
    let places = line.chains.iter().flat_map(|chain| &chain.places[..chain.places.len() - 1]);
    let around: Vec<Point> = nodes[0].iter().flat_map(|nodes| nodes[..nodes.len() - 1].iter().copied()).collect();
    let all = around.len();
    let side = |k: usize, i: usize| match k {
        0 => around[i],
        1 => around[columns + i],
        2 => around[2 * columns + rows - i],
        _ => around[(all - i) % all],
    };
    // Nodes inside follow those around.
    let number = |i: usize, j: usize| -> u32 {
        (if j == 0 {
            i
        } else if i == columns {
            columns + j
        } else if j == rows {
            2 * columns + rows - i
        } else if i == 0 {
            all - j
        } else {
            all + (j - 1) * (columns - 1) + i - 1
        }) as u32
    };
    let [low, right, high, left] = [0, columns, columns + rows, 2 * columns + rows].map(|k| around[k]);
    let mut positions = around.clone();
    for j in 1..rows {
        for i in 1..columns {
            let (u, v) = (i as f64 / columns as f64, j as f64 / rows as f64);
            positions.push([0, 1].map(|d| {
                let sides = (1.0 - v) * side(0, i)[d] + v * side(2, i)[d] + (1.0 - u) * side(3, j)[d] + u * side(1, j)[d];
                sides - (1.0 - v) * ((1.0 - u) * low[d] + u * right[d]) - v * ((1.0 - u) * left[d] + u * high[d])
            }));
        }
    }
    let cell = |k: usize| {
        let (i, j) = (k % columns, k / columns);
        [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
    };
    let cells: Vec<Cell> = (0..columns * rows).map(cell).collect();
    let held: Vec<bool> = (0..positions.len()).map(|node| node < all).collect();
    smooth::smooth(&mut positions, &cells, &held);
    let fits = |cell: &Cell| {
        let x = cell.map(|node| positions[node as usize]);
        let wanted = size(x[0]);
        (0..4).all(|k| {
            let edge = minus(x[(k + 1) % 4], x[k]);
            let length = dot(edge, edge).sqrt();
            length <= LONG * wanted && (length >= SHORT * wanted || columns.min(rows) == 2)
        })
    };
    if !cells.iter().all(fits) {
        return None;
    }
    let mut loops: Vec<OnOutline> = places.zip(0..).map(|(&place, node)| line.on_outline(place, node)).collect();
    super::from_the_first(&mut loops);
    Some(Meshed { positions, cells, loops: vec![loops] })
}

/// The chains that begin at the four corners, where there are four and no other point turns as much.
fn corners(line: &Line) -> Option<[usize; 4]> {
    let n = line.points.len();
    let mut found = Vec::new();
    for (k, chain) in line.chains.iter().enumerate() {
        let at = chain.points[0];
        let x = line.points[at];
        let (back, on) = (minus(x, line.points[(at + n - 1) % n]), minus(line.points[(at + 1) % n], x));
        if dot(back, on) < CORNER * (dot(back, back) * dot(on, on)).sqrt() {
            if cross(back, on) < 0.0 {
                return None;
            }
            found.push(k);
        }
    }
    found.try_into().ok()
}

/// Shares of `whole` in the proportion of `parts`, each one at least, `whole` being no less than their
/// number.
fn shared(parts: &[usize], whole: usize) -> Vec<usize> {
    let sum: usize = parts.iter().sum();
    let mut shares: Vec<usize> = parts.iter().map(|part| (part * whole / sum).max(1)).collect();
    loop {
        let now: usize = shares.iter().sum();
        // How much more than its share a part has.
        let excess = |k: &usize| shares[*k] as f64 - parts[*k] as f64 * whole as f64 / sum as f64;
        let most = |a: usize, b: usize| if excess(&b) > excess(&a) { b } else { a };
        let least = |a: usize, b: usize| if excess(&b) < excess(&a) { b } else { a };
        let change = if now > whole { (0..parts.len()).filter(|&k| shares[k] > 1).reduce(most) } else { (0..parts.len()).reduce(least) };
        match change {
            Some(k) if now > whole => shares[k] -= 1,
            Some(k) if now < whole => shares[k] += 1,
            _ => return shares,
        }
    }
}

/// So many edges with the density of the old ones.
fn respaced(places: &[f64], count: usize) -> Vec<f64> {
    let old = places.len() - 1;
    let at = |i: usize| {
        let (k, rest) = (i * old / count, (i * old % count) as f64 / count as f64);
        if rest == 0.0 { places[k] } else { places[k] + rest * (places[k + 1] - places[k]) }
    };
    (0..=count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_in_proportion_and_none_is_empty() {
        assert_eq!(shared(&[2, 2], 5), [3, 2]);
        assert_eq!(shared(&[1, 10, 1], 3), [1, 1, 1]);
        assert_eq!(shared(&[1, 10, 1], 24), [2, 20, 2]);
        assert_eq!(shared(&[7], 3), [3]);
    }

    #[test]
    fn edges_spaced_anew_keep_their_density() {
        assert_eq!(respaced(&[0.0, 1.0, 3.0], 4), [0.0, 0.5, 1.0, 2.0, 3.0]);
        assert_eq!(respaced(&[0.0, 1.0, 3.0], 1), [0.0, 3.0]);
        assert_eq!(respaced(&[0.0, 1.0, 3.0], 2), [0.0, 1.0, 3.0]);
    }
}
