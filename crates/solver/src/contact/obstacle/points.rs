//! Points of a surface in 3D that meet a round obstacle: the nodes and, where that may come in between
//! them, points on the facets.
//!
//! A facet is divided n times along its edges. A point has fixed shares of its facet's corners, so it has a
//! gap of its own, nothing is handed over where the obstacle slides, and its spring keeps energy and both
//! momenta as a node's does. What a node stands for goes to the facets at it, equally, and there to the
//! points by the trapezoidal rule; the node keeps a part of 1 / n².

use crate::contact::slaves::Slave;
use crate::mesh::surface::Corners;

/// A point: nodes with their shares, and what it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Nodes, as many as count.
    pub nodes: [u32; 4],
    /// Their shares.
    pub shares: [f64; 4],
    /// How many.
    pub count: usize,
    /// What it stands for.
    pub slave: Slave,
}

impl Point {
    /// A node.
    #[must_use]
    pub fn node(node: u32, slave: Slave) -> Self {
        Self { nodes: [node; 4], shares: [1.0, 0.0, 0.0, 0.0], count: 1, slave }
    }

    /// Nodes and their shares.
    pub fn ends(&self) -> impl Iterator<Item = (u32, f64)> {
        self.nodes.into_iter().zip(self.shares).take(self.count)
    }

    /// Where it is, m.
    #[must_use]
    pub fn place(&self, positions: &[[f64; 3]]) -> [f64; 3] {
        if self.count == 1 {
            return positions[self.nodes[0] as usize];
        }
        self.ends().fold([0.0; 3], |sum, (node, share)| [0, 1, 2].map(|d| sum[d] + share * positions[node as usize][d]))
    }

    /// What reports it from others.
    #[must_use]
    pub fn key(&self) -> ([u32; 4], [u64; 4]) {
        (self.nodes, self.shares.map(f64::to_bits))
    }
}

/// Shares of the corners of the points of a facet that are no corners, and the weight of each; all weights of
/// a facet with the corners' add up to one.
fn divided(corners: usize, n: usize) -> Vec<([f64; 4], f64)> {
    let size = n as f64;
    let mut points = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let (u, v) = (i as f64 / size, j as f64 / size);
            let on_rim = [i == 0, j == 0, i == n, j == n].into_iter().filter(|is_there| *is_there).count();
            if corners == 4 {
                if on_rim < 2 {
                    let shares = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
                    points.push((shares, if on_rim == 1 { 0.5 } else { 1.0 } / (size * size)));
                }
            } else if i + j <= n {
                let k = n - i - j;
                let zeros = [i, j, k].into_iter().filter(|count| *count == 0).count();
                // A point stands for a third of each small triangle at it: six within, three on an edge, one
                // at a corner.
                if zeros < 2 {
                    let shares = [1.0 - u - v, u, v, 0.0];
                    points.push((shares, if zeros == 1 { 1.0 } else { 2.0 } / (size * size)));
                }
            }
        }
    }
    points
}

/// Nodes (ascending) and the points on facets, each divided so many times (`divisions`, by its number), with
/// the numbers of the points of each facet that is divided. Where the obstacle is smaller than a facet few
/// points meet it: they are stiffer by a factor, `gain`, that an area has (m²), so that they hold what the
/// whole facet would.
#[must_use]
pub fn points(
    nodes: &[(u32, Slave)],
    facets: &[[u32; 4]],
    divisions: &[usize],
    gain: impl Fn(f64) -> f64,
) -> (Vec<Point>, Vec<std::ops::Range<usize>>) {
    let scaled =
        |Slave { stiffness, area, of_mass }: Slave, by: f64| Slave { stiffness: by * stiffness, area: by * area, of_mass: by * of_mass };
    let sum = |a: Slave, b: Slave| Slave { stiffness: a.stiffness + b.stiffness, area: a.area + b.area, of_mass: a.of_mass + b.of_mass };
    let gained = |slave: Slave, area: f64| Slave { stiffness: gain(area) * slave.stiffness, ..slave };
    let at = |node: u32| nodes.binary_search_by_key(&node, |&(node, _)| node).ok();
    let mut counts = vec![0.0; nodes.len()];
    facets.iter().flat_map(Corners::corners).filter_map(|&node| at(node)).for_each(|rank| counts[rank] += 1.0);
    let mut points: Vec<Point> = nodes.iter().map(|&(node, slave)| Point::node(node, slave)).collect();
    // What is divided takes its part from the nodes.
    let (mut kept, mut is_divided) = (vec![Slave::default(); nodes.len()], vec![false; nodes.len()]);
    let mut ranges = Vec::new();
    for (facet, &n) in facets.iter().zip(divisions) {
        let corners = facet.corners();
        let ranks = || corners.iter().filter_map(|&node| at(node));
        let own = |rank: usize| scaled(nodes[rank].1, 1.0 / counts[rank]);
        let first = points.len();
        if n < 2 {
            ranks().for_each(|rank| kept[rank] = sum(kept[rank], own(rank)));
        } else {
            let whole = ranks().map(own).fold(Slave::default(), sum);
            let area = whole.area;
            for rank in ranks() {
                (kept[rank], is_divided[rank]) = (sum(kept[rank], scaled(gained(own(rank), area), 1.0 / (n * n) as f64)), true);
            }
            let whole = gained(whole, area);
            let make =
                |(shares, weight): ([f64; 4], f64)| Point { nodes: *facet, shares, count: corners.len(), slave: scaled(whole, weight) };
            points.extend(divided(corners.len(), n).into_iter().map(make));
            ranges.push(first..points.len());
        }
    }
    for (point, (kept, _)) in points.iter_mut().zip(kept.into_iter().zip(is_divided)).filter(|(_, (_, is_divided))| *is_divided) {
        point.slave = kept;
    }
    (points, ranges)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_share_what_the_nodes_stand_for_and_lie_on_their_facets() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.1], [1.0, 1.0, 0.3], [0.0, 1.0, 0.2], [2.0, 0.5, 0.0]];
        let facets = [[0, 1, 2, 3], [1, 4, 2, 2]];
        let nodes: Vec<(u32, Slave)> =
            (0..5).map(|node| (node, Slave { stiffness: 2.0 + f64::from(node), area: 1.0, of_mass: 0.5 })).collect();
        for n in 1..=5 {
            let (points, ranges) = points(&nodes, &facets, &[n; 2], |_| 1.0);
            let sum = |of: fn(&Slave) -> f64| points.iter().map(|point| of(&point.slave)).sum::<f64>();
            // Of stiffness and area nothing is lost where all corners of a facet stand for the same; else by
            // how far they differ.
            assert!((sum(|slave| slave.area) - 5.0).abs() < 0.2 && (sum(|slave| slave.stiffness) - 20.0).abs() < 1.5, "{n}");
            let inner: [usize; 2] = [(n + 1) * (n + 1) - 4, (n + 1) * (n + 2) / 2 - 3];
            assert_eq!(ranges.iter().map(ExactSizeIterator::len).collect::<Vec<_>>(), inner[..if n > 1 { 2 } else { 0 }]);
            for (range, facet) in ranges.iter().zip(facets) {
                for point in &points[range.clone()] {
                    assert!((point.shares.iter().sum::<f64>() - 1.0).abs() < 1e-15 && point.nodes == facet);
                    let place = point.place(&positions);
                    assert!(place.iter().all(|c| (-1e-15..=2.0).contains(c)), "{place:?}");
                }
            }
        }
        // A square: the nodes have a quarter of the area each before, and the trapezoidal rule's part after.
        let four: Vec<(u32, Slave)> = (0..4).map(|node| (node, Slave { stiffness: 1.0, area: 0.25, of_mass: 0.0 })).collect();
        let (points, _) = super::points(&four, &facets[..1], &[3], |_| 1.0);
        let integral: f64 = points.iter().map(|point| point.slave.area * point.place(&positions)[0].powi(2)).sum();
        // ∫ x² = 1/3, by the trapezoidal rule h² / 6 more.
        assert!((integral - 1.0 / 3.0 - 1.0 / 54.0).abs() < 1e-14, "{integral}");
    }
}
