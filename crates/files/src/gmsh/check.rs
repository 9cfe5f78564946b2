//! The checks of the cells of a group that need more than one line of the file: forms, twins, bodies that
//! they lie on.
//!
//! `mesh.rs` hands in the cells with node indices and the places of nodes; faults go into its list.

use super::faults::Faults;
use super::form::{area, cross, cross_in_3d};
use super::mesh::{AGAIN, Cell, Nodes, described};
use super::reader::Reader;
use crate::gmsh::messages::CELL;
use embate_solver::mesh::cell::{CellKind, MOST_NODES};
use embate_solver::mesh::signed_volume;

/// Area (volume), as a fraction of the square (cube) of an element's longest diagonal or side, below which it
/// counts as none.
const NOTHING: f64 = 1e-12;

/// The checks of the cells of one group.
pub(super) struct Check<'a> {
    group: &'a str,
    nodes: &'a Nodes<'a>,
    reader: &'a Reader<'a>,
    faults: &'a mut Faults,
}

impl<'a> Check<'a> {
    pub(super) fn new(group: &'a str, nodes: &'a Nodes<'a>, reader: &'a Reader<'a>, faults: &'a mut Faults) -> Self {
        Self { group, nodes, reader, faults }
    }

    fn fault(&mut self, kind: &'static str, cell: &Cell, message: impl FnOnce() -> String, help: &str) {
        let (group, reader) = (self.group, self.reader);
        self.faults.add(kind, || reader.fault(&CELL, cell.file.at, format!("{} {}", described(cell.file, group), message()), help));
    }

    /// Checks one cell; the first thing that is wrong with it is reported.
    pub(super) fn cell(&mut self, cell: &Cell) {
        let nodes = cell.nodes();
        let tag = |node: u32| self.nodes.file[node as usize].tag;
        if let Some(node) = (1..nodes.len()).find(|&k| nodes[..k].contains(&nodes[k])).map(|k| tag(nodes[k])) {
            return self.fault("elements with a node twice", cell, || format!("has node {node} twice"), AGAIN);
        }
        if cell.file.kind.dimension < self.nodes.least
            && let Some(node) = nodes.iter().find(|node| !self.nodes.used[**node as usize]).map(|node| tag(*node))
        {
            return self.away(cell, node);
        }
        let x = self.nodes.corners(cell);
        if !x.iter().flatten().all(|x| x.is_finite()) {
            return; // The node has its fault.
        }
        let square = |[a, b]: [[f64; 3]; 2]| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2) + (b[2] - a[2]).powi(2);
        let longest = x.iter().enumerate().flat_map(|(k, a)| x[..k].iter().map(|b| square([*a, *b]))).fold(0.0, f64::max);
        match (cell.file.kind.dimension, self.nodes.dimension) {
            (1, _) if longest == 0.0 => {
                let message = || "has no length: its nodes lie on one another".to_string();
                self.fault("lines without length", cell, message, "remove it, or merge the nodes and mesh again");
            }
            (2, 2) => {
                let area = area(cell.shape, &x);
                let n = cell.shape.corners();
                let turns_left = (0..n).filter(|&k| cross(x[k], x[(k + 1) % n], x[(k + 1) % n], x[(k + 2) % n]) > 0.0).count();
                self.surface(cell, cell.shape == CellKind::Quadrilateral && turns_left == 2, area, longest);
            }
            (2, 3) => {
                let (crosses, area) = of_3d(cell.shape, &x);
                self.surface(cell, crosses, area, longest);
            }
            (3, _) => {
                let volume = signed_volume(cell.shape, &x);
                if volume.abs() <= NOTHING * longest * longest.sqrt() {
                    let message = || format!("has no volume ({volume:e} m³)");
                    let help = "its nodes lie in a plane, on one another, or not in order; mesh again";
                    self.fault("elements without volume", cell, message, help);
                }
            }
            _ => {}
        }
    }

    /// What bounds no body: nothing could act there.
    fn away(&mut self, cell: &Cell, node: u64) {
        if self.nodes.dimension == 2 {
            let help = "put the surface that it bounds into a physical group too, or take it out of this group";
            let message = || format!("lies at node {node}, which no triangle or quadrilateral of a physical group has");
            self.fault("points and lines away from every surface", cell, message, help);
        } else {
            let help = "put the volume that it bounds into a physical group too, or take it out of this group";
            let bodies = if self.nodes.least == 2 { "no volume and no surface" } else { "no volume" };
            let message = || format!("lies at node {node}, which {bodies} of a physical group has");
            self.fault("points, lines and surfaces away from every volume", cell, message, help);
        }
    }

    fn surface(&mut self, cell: &Cell, crosses: bool, area: f64, longest: f64) {
        if crosses {
            let message = || "has sides that cross each other".to_string();
            self.fault("elements with crossing sides", cell, message, "its nodes are not in order around it; mesh again");
        } else if area.abs() <= NOTHING * longest {
            let message = || format!("has no area ({area:e} m²)");
            self.fault("elements without area", cell, message, "its nodes lie on a line or on one another; mesh again");
        }
    }

    /// A cell that is there twice would have its mass and stiffness twice.
    pub(super) fn repeated(&mut self, cells: &[Cell]) {
        let mut sorted: Vec<([u32; MOST_NODES], usize)> = cells.iter().enumerate().map(|(place, cell)| (key(cell), place)).collect();
        sorted.sort_unstable();
        for pair in sorted.windows(2) {
            if pair[0].0 == pair[1].0 {
                let other = cells[pair[0].1].file.tag;
                self.fault("elements that are there twice", &cells[pair[1].1], || format!("has the nodes of element {other}"), AGAIN);
            }
        }
    }
}

/// Whether the sides of a quadrilateral in 3D cross (seen along the normal at its first corner two corners
/// turn each way), and the area of a triangle or quadrilateral, m².
fn of_3d(kind: CellKind, x: &[[f64; 3]]) -> (bool, f64) {
    let (n, is_quadrilateral) = (kind.corners(), kind == CellKind::Quadrilateral);
    let turn = |k: usize| cross_in_3d(x[k], x[(k + 1) % n], x[(k + 1) % n], x[(k + 2) % n]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let first = turn(0);
    let like_the_first = (0..n).filter(|&k| dot(first, turn(k)) > 0.0).count();
    let twice = if is_quadrilateral { cross_in_3d(x[0], x[2], x[1], x[3]) } else { first };
    (is_quadrilateral && like_the_first == 2, 0.5 * dot(twice, twice).sqrt())
}

/// The nodes of a cell in ascending order, filled up with the largest number.
fn key(cell: &Cell) -> [u32; MOST_NODES] {
    let mut key = [u32::MAX; MOST_NODES];
    key[..cell.nodes().len()].copy_from_slice(cell.nodes());
    key.sort_unstable();
    key
}
