//! Values of cells averaged at nodes, for smooth colours and lines of equal value.
//!
//! A node has the mean of the cells around it, each counted once, for each part by itself: across the border
//! of two parts nothing is averaged. Cells that have gone, and values that are not numbers, do not count.

use embate_solver::output::Cells;
use std::collections::HashMap;

/// Sum and number of values.
type Sum = (f64, u32);

/// Means at the nodes of each part.
#[derive(Debug)]
pub(super) struct Averages {
    /// The first part that has each node, and its sum.
    first: Vec<(u32, Sum)>,
    /// The sums of further parts that have the same node.
    others: HashMap<(u32, u32), Sum>,
}

/// No part yet.
const NONE: u32 = u32::MAX;

impl Averages {
    /// Of the cells that are not `gone` (ascending); `values`: one of each cell.
    pub(super) fn new(cells: &Cells, nodes: usize, gone: &[u32], values: &[f64]) -> Self {
        let mut averages = Self { first: vec![(NONE, (0.0, 0)); nodes], others: HashMap::new() };
        let mut gone = gone.iter().copied().peekable();
        for (cell, &value) in (0..cells.len()).zip(values) {
            let is_gone = gone.next_if_eq(&(cell as u32)).is_some();
            let ends = cells.offsets.get(cell).zip(cells.offsets.get(cell + 1));
            let own = ends.and_then(|(&from, &to)| cells.nodes.get(from as usize..to as usize)).unwrap_or_default();
            let part = cells.parts.get(cell).copied().unwrap_or(0);
            if is_gone || !value.is_finite() {
                continue;
            }
            for &node in own {
                let Some((first, sum)) = averages.first.get_mut(node as usize) else { continue };
                if *first == NONE {
                    *first = part;
                }
                let sum = if *first == part { sum } else { averages.others.entry((part, node)).or_default() };
                *sum = (sum.0 + value, sum.1 + 1);
            }
        }
        averages
    }

    /// The mean at a node of a part; not a number where there is none.
    pub(super) fn at(&self, part: u32, node: u32) -> f64 {
        let (sum, count) = match self.first.get(node as usize) {
            Some((first, sum)) if *first == part => *sum,
            _ => self.others.get(&(part, node)).copied().unwrap_or_default(),
        };
        if count == 0 { f64::NAN } else { sum / f64::from(count) }
    }

    /// All means, in no order.
    pub(super) fn all(&self) -> impl Iterator<Item = f64> {
        let sums = self.first.iter().map(|(_, sum)| sum).chain(self.others.values());
        sums.filter(|(_, count)| *count > 0).map(|(sum, count)| sum / f64::from(*count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::CellKind;

    #[test]
    fn a_node_has_the_mean_of_its_cells_for_each_part() {
        // Three lines in a row, the last one of another part, and one that has gone.
        let cells = Cells {
            nodes: vec![0, 1, 1, 2, 2, 3, 1, 3],
            offsets: vec![0, 2, 4, 6, 8],
            kinds: vec![CellKind::Line; 4],
            parts: vec![0, 0, 1, 0],
            part_names: vec!["a".into(), "b".into()],
            revision: 0,
        };
        let averages = Averages::new(&cells, 4, &[3], &[1.0, 3.0, 10.0, 99.0]);
        assert_eq!([0, 1, 2].map(|node| averages.at(0, node)), [1.0, 2.0, 3.0]);
        assert_eq!([2, 3].map(|node| averages.at(1, node)), [10.0, 10.0]);
        assert!(averages.at(0, 3).is_nan() && averages.at(1, 0).is_nan() && averages.at(0, 99).is_nan());
        let mut all: Vec<f64> = averages.all().collect();
        all.sort_by(f64::total_cmp);
        assert_eq!(all, [1.0, 2.0, 3.0, 10.0, 10.0]);
        let damaged = Averages::new(&cells, 2, &[], &[1.0, f64::NAN, 1.0, 1.0]);
        assert_eq!((damaged.at(0, 0), damaged.at(0, 1)), (1.0, 1.0));
    }
}
