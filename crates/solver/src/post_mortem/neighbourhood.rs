//! The elements around a failure location: three rings of those that share nodes, and what else is near.
//!
//! Found once, in the state of the failure; the trace then takes its positions step by step.

use super::FailureEntity;
use crate::dimension::Dimension;
use crate::material::variable::PLASTIC_STRAIN;
use crate::mesh::cell::CellKind;
use crate::simulation::Runs;
use crate::simulation::run::Run;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{dot, minus};

/// Rings of elements around the failure location.
pub const RINGS: u8 = 3;
/// What acts on elements within this ring acts on the failure location.
const NEXT: u8 = 1;
/// Elements are near that lie in the box around the rings, and by this fraction of its size beyond.
const BEYOND: f64 = 0.2;
/// Other elements near it that are shown, at most.
const BESIDE: usize = 400;

/// An element near the failure location.
#[derive(Clone, Debug, PartialEq)]
pub struct NearCell {
    /// Its part, in model order.
    pub part: usize,
    /// Its number in the part.
    pub element: usize,
    /// Elements that lie between it and the failure location, plus one; zero: the failure location's own;
    /// `None`: it does not hang together with the failure location so closely, but is near.
    pub ring: Option<u8>,
    /// Which kind of cell it is.
    pub kind: CellKind,
    /// Its nodes, as places in [`Neighbourhood::nodes`], in the order of the element.
    pub nodes: Vec<usize>,
}

/// The elements around a failure location.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Neighbourhood {
    /// Names of all parts of the model.
    pub part_names: Vec<String>,
    /// Numbers of the nodes in results.
    pub nodes: Vec<usize>,
    /// The elements, the failure location's first.
    pub cells: Vec<NearCell>,
    /// The failure location among them, and its node among `nodes`; where a node is the cause, that of its
    /// elements which is worst off.
    pub element: Option<usize>,
    /// See `element`.
    pub node: Option<usize>,
    /// What [`super::Moment::values`] are: name and unit of a field.
    pub field: (&'static str, &'static str),
}

/// The same by the numbers of the solver.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    pub(crate) shown: Neighbourhood,
    pub(crate) nodes: Vec<u32>,
    /// Group and element.
    pub(crate) cells: Vec<(usize, usize)>,
    pub(crate) is_plastic: bool,
    /// Nodes of the failure location and the elements next to it, ascending.
    pub(crate) next: Vec<u32>,
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// What is around a suspect now.
    pub(crate) fn near(&self, failure_entity: &FailureEntity) -> Near {
        let found = self.cells_near(failure_entity);
        let mut near = Near::default();
        let mut place = vec![usize::MAX; self.mesh.user_nodes.len()];
        for &((g, element), ring) in &found {
            let group = &self.mesh.groups[g];
            let mut local = |&node: &u32| {
                let at = &mut place[node as usize];
                if *at == usize::MAX {
                    *at = near.nodes.len();
                    near.nodes.push(node);
                }
                *at
            };
            let nodes = group.nodes_of(element).iter().map(&mut local).collect();
            near.shown.cells.push(NearCell {
                part: group.part,
                element: group.user_elements[element] as usize,
                ring,
                kind: group.kind,
                nodes,
            });
            near.cells.push((g, element));
        }
        near.shown.nodes = near.nodes.iter().map(|&node| self.mesh.user_nodes[node as usize] as usize).collect();
        near.shown.part_names = self.mesh.parts.iter().map(|part| part.name.clone()).collect();
        near.shown.element = failure_entity.element.and_then(|own| near.cells.iter().position(|cell| *cell == own));
        near.shown.node = failure_entity.node.and_then(|own| near.nodes.iter().position(|&node| node as usize == own));
        let is_next = |ring: Option<u8>| ring.is_some_and(|ring| ring <= NEXT);
        near.next = found
            .iter()
            .filter(|(_, ring)| is_next(*ring))
            .flat_map(|((g, element), _)| self.mesh.groups[*g].nodes_of(*element))
            .copied()
            .collect();
        near.next.sort_unstable();
        near.next.dedup();
        near.is_plastic = near.cells.iter().any(|&(g, _)| self.blocks[g].has(&PLASTIC_STRAIN));
        near.shown.field = if near.is_plastic { ("plastic strain", "") } else { ("von Mises stress", "Pa") };
        near
    }

    /// Elements by group and number, with their rings.
    fn cells_near(&self, failure_entity: &FailureEntity) -> Vec<((usize, usize), Option<u8>)> {
        let mut is_marked = vec![false; self.mesh.user_nodes.len()];
        let mut is_taken: Vec<Vec<bool>> = self.mesh.groups.iter().map(|group| vec![false; group.elements()]).collect();
        let mut found = Vec::new();
        match *failure_entity {
            FailureEntity { node: Some(node), .. } if node < is_marked.len() => is_marked[node] = true,
            FailureEntity { element: Some((g, element)), .. } => {
                self.mesh.groups[g].nodes_of(element).iter().for_each(|&node| is_marked[node as usize] = true);
                is_taken[g][element] = true;
                found.push(((g, element), Some(0)));
            }
            _ => return found,
        }
        // The elements at a node are its own.
        let first = u8::from(!found.is_empty());
        for ring in first..=RINGS {
            let from = found.len();
            for (g, group) in self.mesh.groups.iter().enumerate() {
                for (element, cell) in group.cells().enumerate() {
                    if !is_taken[g][element] && group.is_alive(element) && cell.nodes.iter().any(|&node| is_marked[node as usize]) {
                        is_taken[g][element] = true;
                        found.push(((g, element), Some(ring)));
                    }
                }
            }
            for &((g, element), _) in &found[from..] {
                self.mesh.groups[g].nodes_of(element).iter().for_each(|&node| is_marked[node as usize] = true);
            }
        }
        found.extend(self.cells_beside(&found, &is_taken).into_iter().map(|cell| (cell, None)));
        found
    }

    /// Further elements in the box around those that were found, the nearest to its middle first.
    fn cells_beside(&self, found: &[((usize, usize), Option<u8>)], is_taken: &[Vec<bool>]) -> Vec<(usize, usize)> {
        let seen = |node: u32| Some(self.positions[node as usize]).filter(|x| x.iter().all(|v| v.is_finite()));
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for x in found.iter().flat_map(|&((g, element), _)| self.mesh.groups[g].nodes_of(element)).filter_map(|&node| seen(node)) {
            for d in 0..D {
                (low[d], high[d]) = (low[d].min(x[d]), high[d].max(x[d]));
            }
        }
        let more = BEYOND * minus(high, low).into_iter().fold(f64::NEG_INFINITY, f64::max);
        (low, high) = (low.map(|v| v - more), high.map(|v| v + more));
        let is_inside = |x: [f64; D]| (0..D).all(|k| (low[k]..=high[k]).contains(&x[k]));
        let mut beside = Vec::new();
        for (g, group) in self.mesh.groups.iter().enumerate() {
            for (element, cell) in group.cells().enumerate() {
                if !is_taken[g][element] && group.is_alive(element) && cell.nodes.iter().any(|&node| seen(node).is_some_and(is_inside)) {
                    let x = self.centre(cell.nodes);
                    let away: [f64; D] = std::array::from_fn(|k| x[k] - 0.5 * (low[k] + high[k]));
                    beside.push((dot(away, away), (g, element)));
                }
            }
        }
        beside.sort_by(|(a, one), (b, other)| a.total_cmp(b).then(one.cmp(other)));
        beside.truncate(BESIDE);
        beside.into_iter().map(|(_, cell)| cell).collect()
    }
}

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// What is around a suspect now.
    pub(crate) fn neighbourhood(&self, failure_entity: &FailureEntity) -> Neighbourhood {
        self.system.near(failure_entity).shown
    }
}
