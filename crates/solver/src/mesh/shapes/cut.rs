//! A part of a body: the elements whose centres lie there, with new sides where it was cut.

use super::Body;
use crate::mesh::Meshed;
use crate::mesh::surface::{Corners, exterior};
use crate::tensor::Dim;
use std::collections::BTreeSet;

/// What is left of a body where `is_kept` holds at the centre of an element. Its own sides keep their names;
/// a new outside is named by the centre of its pieces.
pub(super) fn cut<const D: usize>(body: &Body<D>, is_kept: impl Fn([f64; D]) -> bool, name: impl Fn([f64; D]) -> &'static str) -> Body<D>
where
    Dim<D>: Meshed<D>,
{
    let centre = |nodes: &[u32]| -> [f64; D] {
        std::array::from_fn(|d| nodes.iter().map(|&node| body.positions[node as usize][d]).sum::<f64>() / nodes.len() as f64)
    };
    let keeps = |nodes: &[u32]| is_kept(centre(nodes));
    let mut left = Body::default();
    left.add(body.cells().filter(|cell| keeps(cell.nodes)));
    let outside: Vec<_> = exterior::<D>(left.cells()).unwrap_or_default();
    let all: BTreeSet<_> = outside.iter().map(|facet| facet.canonical()).collect();
    let mut old = BTreeSet::new();
    for (side, facets) in &body.sides {
        let facets: Vec<_> = facets.iter().filter(|facet| all.contains(&facet.canonical())).copied().collect();
        old.extend(facets.iter().map(|facet| facet.canonical()));
        left.sides.push((side.clone(), facets));
    }
    for facet in outside {
        if !old.contains(&facet.canonical()) {
            let side = name(centre(facet.corners()));
            match left.sides.iter_mut().find(|it| it.0 == side) {
                Some((_, facets)) => facets.push(facet),
                None => left.sides.push((side.to_string(), vec![facet])),
            }
        }
    }
    left.only_used(&body.positions);
    left
}

impl<const D: usize> Body<D>
where
    Dim<D>: Meshed<D>,
{
    /// Takes the positions of the nodes that elements have, in their order, and numbers everything so.
    pub(super) fn only_used(&mut self, positions: &[[f64; D]]) {
        let mut used = vec![false; positions.len()];
        self.cells().flat_map(|cell| cell.nodes).for_each(|&node| used[node as usize] = true);
        let mut numbers = vec![0; positions.len()];
        for (node, (number, &position)) in numbers.iter_mut().zip(positions).enumerate() {
            if used[node] {
                *number = self.positions.len() as u32;
                self.positions.push(position);
            }
        }
        let number = |node: &mut u32| *node = numbers[*node as usize];
        self.elements.values_mut().flatten().for_each(number);
        for (_, facets) in &mut self.sides {
            facets.iter_mut().for_each(|facet| *facet = facet.renamed(|node| numbers[node as usize]));
        }
        self.points.iter_mut().flat_map(|(_, nodes)| nodes).for_each(number);
    }
}
