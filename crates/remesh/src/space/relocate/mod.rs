//! Nodes of a mesh in 3D moved to better places without other cells: what `crate::relocate` does in 2D.
//!
//! Nodes inside go to where the corners around them have the best shape (`shape`), one at a time in their
//! order; those of the outline slide on it as it is (`outline`), along lines where it turns by more than 30
//! degrees, and corners stay. Where it is curved, nodes that slid are then moved along its normals, each in
//! proportion to its way and to how much the outline turns there, until the volume is exactly what it was
//! (`volume`), and nodes inside follow. Where the worst cell is not good then, parts of the way and no way
//! for the outline are tried, and the mesh with the best worst cell is given.
//!
//! Sources: Knupp, SIAM J. Sci. Comput. 23 (2001) 193-218; Dobrev et al., SIAM J. Sci. Comput. 41 (2019)
//! B50-B68 (µ₃₀₃); for relocation in explicit codes Benson, Comput. Methods Appl. Mech. Eng. 72 (1989)
//! 305-350.

mod outline;
mod shape;
mod volume;

pub use super::face::faces;
use super::place::Within;
use super::vector::{dot, minus};
use super::{Kind, Mesh, Point};
pub use outline::Marks;
use outline::{Outline, Role};
use shape::Corners;
use std::fmt;

/// Sweeps at most in which all nodes move, in which those inside follow, and the step by the length of edges
/// below which a node is still.
const SWEEPS: usize = 40;
const FOLLOW: usize = 12;
const STILL: f64 = 1e-3;
/// Parts of the way of the outline's nodes that are tried.
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.0];
/// Least scaled Jacobian of a mesh that is given without a try of the other parts.
const GOOD: f64 = 0.6;

/// A mesh whose nodes have been moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Relocated {
    /// Places of its nodes, m.
    pub positions: Vec<Point>,
    /// Of each node the old nodes, with their shares, that have the material that is there.
    pub shares: Vec<Vec<(u32, f64)>>,
    /// Least scaled Jacobian.
    pub quality: f64,
}

/// Why no node is moved.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// Lengths or numbers do not fit each other.
    Input(&'static str),
    /// A cell has a corner whose edges are not right-handed.
    Inverted {
        /// Its index.
        cell: usize,
    },
    /// No better mesh was found.
    NotBetter {
        /// Least scaled Jacobian of the mesh as it is.
        before: f64,
        /// The best one that was found.
        best: f64,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Input(why) => write!(f, "the mesh and what is known of it do not fit: {why}"),
            Self::Inverted { cell } => write!(f, "cell {cell} has a corner that is flat or inside out"),
            Self::NotBetter { before, best } => {
                write!(f, "the least scaled Jacobian is {before:.3}, and the best that moved nodes give is {best:.3}")
            }
        }
    }
}

impl std::error::Error for Failure {}

/// Least scaled Jacobian of the corners of all cells: the determinant of the edges at a corner over the
/// product of their lengths, 1 for a cube, an equilateral wedge and a regular tetrahedron.
#[must_use]
pub fn quality(mesh: Mesh<'_>) -> f64 {
    mesh.cells.iter().map(|cell| shape::of_cell(mesh.positions, cell)).fold(f64::INFINITY, f64::min)
}

/// The mesh with its nodes in better places. Cells and numbers of nodes stay, and so do the places of fixed
/// nodes and the volume.
///
/// The least scaled Jacobian s becomes s′ ≥ `better` · s, or the mesh is not given; a factor below 1 counts
/// as 1, so that no mesh is given that is worse than it was.
///
/// # Errors
/// [`Failure::Input`] for lengths or numbers that do not fit, and for tetrahedra of ten nodes; `Inverted`;
/// `NotBetter`.
pub fn relocated(mesh: Mesh<'_>, marks: &Marks<'_>, better: f64) -> Result<Relocated, Failure> {
    check(mesh, marks, better)?;
    let each = mesh.cells.iter().map(|cell| shape::of_cell(mesh.positions, cell));
    let (mut before, mut inverted) = (f64::INFINITY, None);
    for (cell, quality) in each.enumerate() {
        before = before.min(quality);
        if !(quality > 0.0) {
            inverted = inverted.or(Some(cell));
        }
    }
    if let Some(cell) = inverted {
        return Err(Failure::Inverted { cell });
    }
    let wanted = better.max(1.0) * before;
    let corners = Corners::new(mesh);
    let slid = Slid::new(mesh, marks, &corners);
    let mut best: Option<(f64, Vec<Point>, Vec<Point>)> = None;
    for part in PARTS {
        let Some((positions, places)) = slid.moved(part) else { continue };
        let quality = quality(Mesh { positions: &positions, ..mesh });
        if best.as_ref().is_none_or(|(most, ..)| quality > *most) {
            best = Some((quality, positions, places));
        }
        if quality >= GOOD && quality >= wanted {
            break;
        }
    }
    match best {
        Some((quality, positions, places)) if quality >= wanted => {
            let shares = slid.shares(&positions, &places).ok_or(Failure::Input("a node is nowhere in it"))?;
            Ok(Relocated { positions, shares, quality })
        }
        best => Err(Failure::NotBetter { before, best: best.map_or(before, |(quality, ..)| quality) }),
    }
}

fn check(mesh: Mesh<'_>, marks: &Marks<'_>, better: f64) -> Result<(), Failure> {
    let count = mesh.positions.len();
    let fail = |why| Err(Failure::Input(why));
    if !better.is_finite() {
        return fail("the factor for the quality is not a number");
    }
    if mesh.cells.is_empty() || u32::try_from(count).is_err() {
        return fail("there are no cells, or too many nodes");
    }
    if !mesh.positions.iter().flatten().all(|x| x.is_finite()) {
        return fail("a coordinate is not a number");
    }
    if mesh.cells.iter().any(|cell| cell.kind() == Kind::Tetrahedron10) {
        return fail("nodes in the middles of edges can't be moved");
    }
    let mut used = vec![false; count];
    for &node in mesh.cells.iter().flat_map(|cell| cell.nodes()) {
        match used.get_mut(node as usize) {
            Some(used) => *used = true,
            None => return fail("a cell has a node that is not there"),
        }
    }
    if used.contains(&false) {
        return fail("a node is of no cell");
    }
    if [marks.fixed.len(), marks.nodes.len()] != [count; 2] || marks.faces.len() != faces(mesh).len() {
        return fail("there are not as many marks as nodes and faces");
    }
    Ok(())
}

/// A mesh whose nodes have been moved, without regard to the volume.
struct Slid<'a> {
    mesh: Mesh<'a>,
    corners: &'a Corners,
    outline: Outline<'a>,
    positions: Vec<Point>,
    /// A place near the mesh, and its volume.
    about: Point,
    volume: f64,
}

impl<'a> Slid<'a> {
    fn new(mesh: Mesh<'a>, marks: &Marks<'_>, corners: &'a Corners) -> Self {
        let outline = Outline::new(mesh, marks, |node| corners.near(node).collect());
        let mut positions = mesh.positions.to_vec();
        let is_free = |node: usize| !matches!(outline.roles[node], Role::Fixed);
        sweep(&mut positions, corners, &outline, is_free, SWEEPS);
        let about = mesh.positions[0];
        let volume = volume::volume(&outline.faces, mesh.positions, about);
        Self { mesh, corners, outline, positions, about, volume }
    }

    /// The mesh with so much of the way of the nodes of the outline, and where these are on the old one;
    /// `None` where the volume can't be kept or a cell would be inside out.
    fn moved(&self, part: f64) -> Option<(Vec<Point>, Vec<Point>)> {
        let (old, outline) = (self.mesh.positions, &self.outline);
        let place = |node: usize| {
            let (from, to) = (old[node], self.positions[node]);
            let x = if part == 1.0 { to } else { [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k])) };
            if x == from || part == 1.0 { x } else { outline.onto(node, x) }
        };
        let places: Vec<Point> = (0..old.len()).map(place).collect();
        let mut positions = places.clone();
        if part > 0.0 && !self.keep_volume(&mut positions) {
            return None;
        }
        if !(quality(Mesh { positions: &positions, ..self.mesh }) > 0.0) {
            return None;
        }
        sweep(&mut positions, self.corners, outline, |node| matches!(outline.roles[node], Role::Inner), FOLLOW);
        Some((positions, places))
    }

    /// Moves nodes of the outline that slid such that the volume is what it was; false if it can't be.
    fn keep_volume(&self, positions: &mut [Point]) -> bool {
        let (faces, about) = (&self.outline.faces, self.about);
        let slopes = volume::slopes(faces, positions, about);
        let way = |node: usize| {
            let moved = minus(positions[node], self.mesh.positions[node]);
            let length = dot(moved, moved).sqrt();
            self.outline.correction(node, slopes[node], length)
        };
        let ways: Vec<Point> = (0..positions.len()).map(way).collect();
        volume::correct(faces, positions, &ways, about, self.volume)
    }

    /// Old nodes with their shares at new places; those of the outline are at `places` on it.
    fn shares(&self, positions: &[Point], places: &[Point]) -> Option<Vec<Vec<(u32, f64)>>> {
        let mut located = Within::new(self.mesh).ok()?;
        let of = |node: usize| match &self.outline.roles[node] {
            Role::Inner if positions[node] != self.mesh.positions[node] => located.shares(positions[node]),
            Role::Inner => Some(vec![(node as u32, 1.0)]),
            _ => Some(self.outline.shares(node, places[node])),
        };
        (0..positions.len()).map(of).collect()
    }
}

/// Moves nodes that are free to where their corners are best, one at a time, in so many sweeps at most.
fn sweep(positions: &mut [Point], corners: &Corners, outline: &Outline<'_>, is_free: impl Fn(usize) -> bool, sweeps: usize) {
    let free: Vec<usize> = (0..positions.len()).filter(|&node| is_free(node)).collect();
    // Nodes that have moved, or next to one, in this sweep and for the next.
    let mut moved = vec![true; positions.len()];
    for _ in 0..sweeps {
        let mut next = vec![false; positions.len()];
        for &node in &free {
            let Some(ways) = outline.ways(node).filter(|_| moved[node]) else { continue };
            if corners.step(positions, node, &ways, |place| outline.onto(node, place)) > STILL {
                corners.near(node).for_each(|other| next[other] = true);
            }
        }
        if !next.contains(&true) {
            break;
        }
        moved = next;
    }
}

#[cfg(test)]
mod tests;
