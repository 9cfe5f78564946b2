//! The tetrahedra of a mesh, and the pieces that they have in common with those of another mesh.

use super::clip::{Piece, Tet};
use super::cut::{Cut, Local, Plan, Uncut};
use super::{Failure, Mesh, Point, Side};
use crate::shared::grid::{Grid, bounds};

/// A tetrahedron of the old mesh.
pub(super) struct OldTet {
    pub(super) cell: u32,
    /// Sub-cell of the cell.
    pub(super) part: u8,
    /// Vertices: nodes of the mesh, or further ones.
    pub(super) vertices: [u32; 4],
    /// m³.
    pub(super) volume: f64,
}

/// The tetrahedra of the old mesh, by cells.
pub(super) struct Tets {
    pub(super) all: Vec<OldTet>,
    /// Places of the nodes and of further vertices.
    pub(super) places: Vec<Point>,
    /// Weights of the nodes at the further vertices: of each the first, one more at the end.
    starts: Vec<u32>,
    weights: Vec<(u32, f64)>,
    nodes: usize,
}

/// A cell that is cut, or why the transfer fails.
pub(super) fn local<'a>(plans: &'a [Plan; 4], mesh: Mesh<'_>, cell: usize, side: Side) -> Result<Local<'a>, Failure> {
    Local::of(plans, mesh, cell).map_err(|uncut| match uncut {
        Uncut::Node => Failure::Size,
        Uncut::Inverted => Failure::Inverted { side, cell },
    })
}

/// Volume of each cell of a mesh, m³.
///
/// # Errors
/// `Size` for a node that is not there; `Inverted`.
pub fn volumes(mesh: Mesh<'_>) -> Result<Vec<f64>, Failure> {
    let plans = Plan::all(Cut::Cells);
    (0..mesh.cells.len()).map(|cell| Ok(local(&plans, mesh, cell, Side::Old)?.volumes.iter().sum())).collect()
}

impl Tets {
    pub(super) fn of(plans: &[Plan; 4], mesh: Mesh<'_>) -> Result<Self, Failure> {
        let nodes = mesh.positions.len();
        let mut tets = Self { all: Vec::new(), places: mesh.positions.to_vec(), starts: vec![0], weights: Vec::new(), nodes };
        for cell in 0..mesh.cells.len() {
            let local = local(plans, mesh, cell, Side::Old)?;
            let (own, further) = (mesh.cells[cell].nodes(), tets.places.len());
            for vertex in own.len()..local.places.len() {
                let shape = local.shape(vertex as u8);
                tets.places.push(local.places[vertex]);
                tets.weights.extend(own.iter().zip(shape).filter(|(_, weight)| **weight != 0.0).map(|(&node, &weight)| (node, weight)));
                tets.starts.push(u32::try_from(tets.weights.len()).map_err(|_| Failure::Size)?);
            }
            let number =
                |vertex: u8| own.get(usize::from(vertex)).map_or_else(|| further + usize::from(vertex) - own.len(), |&node| node as usize);
            for (index, vertices) in local.plan.tets.iter().enumerate() {
                let vertices = vertices.map(|vertex| number(vertex) as u32);
                tets.all.push(OldTet { cell: cell as u32, part: local.plan.parts[index], vertices, volume: local.volumes[index] });
            }
        }
        if u32::try_from(tets.places.len().max(tets.all.len())).is_err() {
            return Err(Failure::Size);
        }
        Ok(tets)
    }

    /// The values of a field of the nodes at all vertices.
    pub(super) fn field(&self, of_nodes: &[Point]) -> Vec<Point> {
        let mut found = of_nodes.to_vec();
        found.resize(self.places.len(), [0.0; 3]);
        for (value, range) in found[self.nodes..].iter_mut().zip(self.starts.windows(2)) {
            for &(node, weight) in &self.weights[range[0] as usize..range[1] as usize] {
                (0..3).for_each(|k| value[k] += weight * of_nodes[node as usize][k]);
            }
        }
        found
    }

    /// Nodes with their shares at weights of a tetrahedron's vertices.
    pub(super) fn of_nodes(&self, tet: &OldTet, weights: [f64; 4]) -> Vec<(u32, f64)> {
        let mut found: Vec<(u32, f64)> = Vec::new();
        let mut add = |node: u32, share: f64| match found.iter_mut().find(|(own, _)| *own == node) {
            Some((_, sum)) => *sum += share,
            None => found.push((node, share)),
        };
        for (&vertex, weight) in tet.vertices.iter().zip(weights) {
            match (vertex as usize).checked_sub(self.nodes) {
                None => add(vertex, weight),
                Some(further) => {
                    let range = self.starts[further] as usize..self.starts[further + 1] as usize;
                    self.weights[range].iter().for_each(|&(node, share)| add(node, weight * share));
                }
            }
        }
        found
    }

    pub(super) fn places_of(&self, tet: &OldTet) -> [Point; 4] {
        let [a, b, c, d] = tet.vertices;
        [self.places[a as usize], self.places[b as usize], self.places[c as usize], self.places[d as usize]]
    }
}

/// Finds the pieces of old tetrahedra in new ones.
pub(super) struct Search<'a> {
    tets: &'a Tets,
    grid: Grid<3>,
    near: Vec<u32>,
    piece: Piece,
    mark: u32,
}

impl<'a> Search<'a> {
    pub(super) fn new(tets: &'a Tets) -> Self {
        let boxes = tets.all.iter().map(|tet| bounds(&tets.places_of(tet))).collect();
        Self { tets, grid: Grid::new(boxes), near: Vec::new(), piece: Piece::new(), mark: 0 }
    }

    /// Calls `visit` with the index of an old tetrahedron and the piece that it has in common with a new one,
    /// for all that have any, ascending.
    pub(super) fn pieces(&mut self, new: &Tet, mut visit: impl FnMut(usize, &Piece)) {
        self.grid.near(&bounds(&new.places), self.mark, &mut self.near);
        self.mark = self.mark.wrapping_add(1);
        for &index in &self.near {
            let old = &self.tets.all[index as usize];
            let places = self.tets.places_of(old);
            if self.piece.set(&places, old.volume, new) {
                visit(index as usize, &self.piece);
            }
        }
    }
}
