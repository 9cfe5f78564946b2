//! A mesh in which nodes of a part have been moved without other cells: numbers, names and the order of
//! elements stay.

use super::remeshed::{GONE, Piece, RemeshedPart, Renumbered};
use super::surface::Corners;
use super::{Dim, Mesh, Meshed};
use std::collections::BTreeMap;

/// Names of nodes and of pieces of the outside, by numbers.
#[derive(Clone, Debug)]
pub(crate) struct Names<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// How many names there are.
    pub(crate) count: u32,
    /// Of each node, ascending.
    pub(crate) nodes: Vec<Vec<u32>>,
    /// Of pieces in no direction, ascending.
    pub(crate) pieces: BTreeMap<Piece<D>, Vec<u32>>,
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// What named sides, points and groups name.
    pub(crate) fn names(&self) -> Names<D> {
        let mut names = Names { count: 0, nodes: vec![Vec::new(); self.positions.len()], pieces: BTreeMap::new() };
        for facets in self.sides.values().chain(self.surfaces.values().flatten().map(|(_, facets)| facets)) {
            for facet in facets {
                let own: &mut Vec<u32> = names.pieces.entry(facet.undirected()).or_default();
                if own.last() != Some(&names.count) {
                    own.push(names.count);
                }
            }
            names.count += 1;
        }
        for nodes in self.points.values().chain(self.sets.values().flatten().map(|(_, nodes)| nodes)) {
            nodes.iter().for_each(|&node| names.nodes[node as usize].push(names.count));
            names.count += 1;
        }
        names.nodes.iter_mut().for_each(Vec::dedup);
        names
    }

    /// The mesh with the nodes of a part moved: `own` is what is known of it then, in the order of its nodes,
    /// `initial` where their material was at the start, m; `nodes` are the nodes of the part in an order of
    /// the caller's. `limits` are those of [`super::remeshed::Remeshed::limits`].
    pub(crate) fn with_moved(&self, own: RemeshedPart<D>, initial: &[[f64; D]], nodes: &[u32], limits: [f64; 2]) -> (Self, Renumbered) {
        let mut mesh = self.clone();
        mesh.revision += 1;
        let mut numbers = Renumbered { of_old: (0..self.positions.len() as u32).collect(), of_new: nodes.to_vec() };
        for (&node, &place) in self.parts[own.part].nodes.iter().zip(initial) {
            mesh.positions[node as usize] = place;
            numbers.of_old[node as usize] = GONE;
        }
        mesh.remeshed.limits = limits;
        mesh.remeshed.parts.retain(|other| other.part != own.part);
        mesh.remeshed.parts.push(own);
        (mesh, numbers)
    }
}
