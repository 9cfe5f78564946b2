//! Relocation: nodes of a mesh moved to better places, the cells staying what they are (rezoning).
//!
//! Nodes inside move to where the cells around them have the best shape; those of the outline slide along it,
//! between nodes that are fixed or where it turns by more than 30 degrees, for the same. Curved pieces are
//! then moved along their normals until the region's measure is exactly what it was, as those of a new mesh
//! are, and nodes inside follow. Where the worst cell is not good then, parts of the way and no way for the
//! outline are tried, and the mesh with the best worst cell is given.
//!
//! Source: Knupp, SIAM J. Sci. Comput. 23 (2001) 193-218; for relocation in explicit codes Benson, Comput.
//! Methods Appl. Mech. Eng. 72 (1989) 305-350.

use crate::mesher::outline::{self, Line};
use crate::mesher::rails::Rails;
use crate::mesher::{self, KeptOut, Meshed, Outline, crossing, qualities, quality, smooth, volume};
use crate::plane::{Cell, Measure, Mesh, Point, corners, on_line};
use std::fmt;

/// Sweeps at most in which nodes of the outline slide, and the step by the length of edges below which a node
/// is still.
const SWEEPS: usize = 60;
const STILL: f64 = 1e-3;
/// Parts of the way of the outline's nodes that are tried.
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.0];
/// Least scaled Jacobian of a mesh that is given without a try of the other parts.
const GOOD: f64 = 0.6;
/// A curved chain whose nodes would slide by less than this part of their edges stays as it is.
const SLIGHT: f64 = 1e-3;

/// A mesh of one region.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// Nodes and cells.
    pub mesh: Mesh<'a>,
    /// Nodes along each closed line of its outline, the body on the left: all edges that are of one cell
    /// only.
    pub loops: &'a [Vec<u32>],
    /// For each of these nodes whether it must stay where it is. Nodes where the outline turns by more than
    /// 30 degrees, and ends of straight lines, stay anyway.
    pub fixed: &'a [Vec<bool>],
}

/// Why no node is moved.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// Lengths or numbers do not fit each other.
    Input(&'static str),
    /// A cell has a corner that is not turned to the left, or a place that is not a number.
    Inverted {
        /// Its index.
        cell: usize,
    },
    /// The outline can't be one of a region.
    Outline(mesher::Failure),
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
            Self::Input(why) => write!(f, "the mesh and its outline do not fit: {why}"),
            Self::Inverted { cell } => write!(f, "cell {cell} is inside out or has a corner of 180 degrees or more"),
            Self::Outline(failure) => failure.fmt(f),
            Self::NotBetter { before, best } => {
                write!(f, "the least scaled Jacobian is {before:.3}, and the best that moved nodes give is {best:.3}")
            }
        }
    }
}

impl std::error::Error for Failure {}

/// The mesh with its nodes in better places. Cells and numbers of nodes stay, and so do the places of fixed
/// nodes and the region's measure; `loops` of the result says where the nodes of the outline lie on that of
/// `body`, segments being counted as nodes are in its loops.
///
/// The least scaled Jacobian s becomes s′ ≥ `better` · s, or the mesh is not given; a factor below 1 counts
/// as 1, so that no mesh is given that is worse than it was.
///
/// # Errors
///
/// [`Failure::Input`] for lengths, numbers or loops that do not fit; `Inverted` for a cell with a corner of
/// 180 degrees or more; `Outline` where lines cross or have the body on their right; `NotBetter`.
pub fn relocated(body: &Body<'_>, measure: Measure, better: f64) -> Result<Meshed, Failure> {
    relocated_outside(body, measure, better, &mesher::anywhere)
}

/// The same with nodes of the outline outside of what the body presses on.
///
/// # Errors
///
/// As those of [`relocated`].
pub fn relocated_outside(body: &Body<'_>, measure: Measure, better: f64, kept_out: KeptOut<'_>) -> Result<Meshed, Failure> {
    if !better.is_finite() {
        return Err(Failure::Input("the factor for the quality is not a number"));
    }
    check(body)?;
    let Mesh { positions, cells } = body.mesh;
    let each = qualities(positions, cells);
    if let Some(cell) = each.iter().position(|quality| !(*quality > 0.0)) {
        return Err(Failure::Inverted { cell });
    }
    let before = each.into_iter().fold(f64::INFINITY, f64::min);
    let wanted = better.max(1.0) * before;
    let place = |&node: &u32| positions[node as usize];
    let outline = Outline { loops: body.loops.iter().map(|nodes| nodes.iter().map(place).collect()).collect(), fixed: body.fixed.to_vec() };
    let lines = outline::of_nodes(&outline).map_err(Failure::Outline)?;
    mesher::check(&lines, measure).map_err(Failure::Outline)?;
    let slid = Slid::new(body, &lines);
    let mut best: Option<(f64, Meshed)> = None;
    for part in PARTS {
        let Some(meshed) = slid.meshed(part, measure, kept_out) else { continue };
        let quality = quality(&meshed.positions, &meshed.cells);
        if best.as_ref().is_none_or(|(most, _)| quality > *most) {
            best = Some((quality, meshed));
        }
        if quality >= GOOD && quality >= wanted {
            break;
        }
    }
    match best {
        Some((quality, meshed)) if quality >= wanted => Ok(meshed),
        best => Err(Failure::NotBetter { before, best: best.map_or(before, |(quality, _)| quality) }),
    }
}

/// Whether all numbers are there and the loops are the edges of one cell.
fn check(body: &Body<'_>) -> Result<(), Failure> {
    let Mesh { positions, cells } = body.mesh;
    let count = positions.len();
    let fail = |why| Err(Failure::Input(why));
    if cells.is_empty() || u32::try_from(count).is_err() {
        return fail("there are no cells, or too many nodes");
    }
    if !positions.iter().flatten().all(|x| x.is_finite()) {
        return fail("a coordinate is not a number");
    }
    let mut used = vec![false; count];
    for &node in cells.iter().flatten() {
        match used.get_mut(node as usize) {
            Some(used) => *used = true,
            None => return fail("a cell has a node that is not there"),
        }
    }
    if used.contains(&false) {
        return fail("a node is of no cell");
    }
    if body.loops.len() != body.fixed.len() || body.loops.iter().zip(body.fixed).any(|(nodes, fixed)| nodes.len() != fixed.len()) {
        return fail("there are not as many flags of fixed nodes as nodes of the outline");
    }
    let mut nodes: Vec<u32> = body.loops.iter().flatten().copied().collect();
    nodes.sort_unstable();
    if nodes.windows(2).any(|pair| pair[0] == pair[1]) {
        return fail("the outline has a node twice");
    }
    let mut around: Vec<[u32; 2]> = body.loops.iter().flat_map(|nodes| edges(nodes)).collect();
    around.sort_unstable();
    let mut all: Vec<[u32; 2]> = cells.iter().flat_map(|cell| edges(corners(cell))).collect();
    all.sort_unstable();
    if all.windows(2).any(|pair| pair[0] == pair[1]) {
        return fail("two cells have an edge in the same direction");
    }
    let outer = all.iter().filter(|[a, b]| all.binary_search(&[*b, *a]).is_err());
    if !outer.eq(&around) {
        return fail("its loops are not the edges that only one cell has");
    }
    Ok(())
}

/// Edges of a closed chain of nodes.
fn edges(nodes: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..nodes.len()).map(|k| [nodes[k], nodes[(k + 1) % nodes.len()]])
}

/// A mesh whose nodes have slid and been moved, without regard to the region's measure.
struct Slid<'a> {
    body: &'a Body<'a>,
    lines: &'a [Line],
    /// Which nodes are of the outline.
    outer: Vec<bool>,
    positions: Vec<Point>,
    /// Places of nodes along the lines.
    places: Vec<Vec<f64>>,
}

impl<'a> Slid<'a> {
    fn new(body: &'a Body<'a>, lines: &'a [Line]) -> Self {
        let mut positions = body.mesh.positions.to_vec();
        let mut outer = vec![false; positions.len()];
        body.loops.iter().flatten().for_each(|&node| outer[node as usize] = true);
        let mut rails = Rails::new(lines, body.loops, positions.len());
        let held: Vec<bool> = outer.iter().enumerate().map(|(node, &outer)| outer && !rails.has(node)).collect();
        smooth::slide(&mut positions, body.mesh.cells, &held, &mut rails, SWEEPS, STILL);
        Self { body, lines, outer, positions, places: rails.places }
    }

    /// The mesh with so much of the way of the nodes of the outline; `None` where the measure can't be kept
    /// or lines would cross.
    fn meshed(&self, part: f64, measure: Measure, kept_out: KeptOut<'_>) -> Option<Meshed> {
        let mut lines = self.lines.to_vec();
        for (line, slid) in lines.iter_mut().zip(&self.places) {
            set_places(line, slid, part);
        }
        let nodes = volume::corrected(&mut lines, measure, false, kept_out)?;
        let mut positions: Vec<Point> =
            self.body.mesh.positions.iter().zip(&self.positions).map(|(&from, &to)| on_line(from, to, part)).collect();
        let mut loops = Vec::new();
        for (l, (line, chains)) in lines.iter().zip(&nodes).enumerate() {
            let mut own = Vec::new();
            for (chain, points) in line.chains.iter().zip(chains) {
                let [from, to] = chain.points;
                if points.len() != to + 1 - from {
                    return None; // divided, as it turns too much
                }
                for k in from..to {
                    let node = self.body.loops[l][line.segments[k] as usize];
                    let place = chain.places[k - from];
                    let is_end = k == from && !chain.is_closed;
                    let stays = is_end || chain.is_straight && place == line.arc[k];
                    positions[node as usize] = if stays { self.body.mesh.positions[node as usize] } else { points[k - from] };
                    own.push(line.on_outline(place, node));
                }
            }
            mesher::from_the_first(&mut own);
            loops.push(own);
        }
        let around: Vec<Vec<Point>> = loops.iter().map(|nodes| nodes.iter().map(|own| positions[own.node as usize]).collect()).collect();
        if !crossing::crossings(&around, 1).is_empty() {
            return None;
        }
        let cells: Vec<Cell> = self.body.mesh.cells.to_vec();
        smooth::smooth(&mut positions, &cells, &self.outer);
        Some(Meshed { positions, cells, loops })
    }
}

/// Gives a line's nodes a part of their way from its points. A chain whose nodes stay needs no correction, as
/// a straight one.
fn set_places(line: &mut Line, slid: &[f64], part: f64) {
    let arc = &line.arc;
    let n = slid.len();
    for chain in &mut line.chains {
        let [from, to] = chain.points;
        let is_slight = |k: usize| (slid[k] - arc[k]).abs() <= SLIGHT * (arc[k + 1] - arc[k]);
        if part == 0.0 || (from..to).all(is_slight) {
            chain.is_straight = true;
            continue;
        }
        for k in from..to {
            chain.places[k - from] = if part == 1.0 { slid[k] } else { arc[k] + part * (slid[k] - arc[k]) };
        }
        if chain.is_closed {
            chain.places[to - from] = chain.places[0] + arc[n];
        }
    }
}

#[cfg(test)]
mod tests;
