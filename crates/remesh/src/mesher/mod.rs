//! Meshes of a region that is given by its outline: quadrilaterals or triangles of a wanted size.
//!
//! The outline is divided first: points that are fixed or where it turns by more than 30 degrees, and the
//! ends of straight lines, stay nodes; between them nodes are spaced as the size says, and curved pieces are
//! moved along their normals until the region's measure is exactly what it was, without nodes inside of what
//! the body presses on. Triangles fill it
//! (`delaunay`); for quadrilaterals they are twice as large, are merged in pairs, and all cells are divided
//! in the middle of their edges. A region with four corners and sides of like lengths gets rows and columns
//! where these are good. Nodes inside are smoothed. Only the four operations and square roots are
//! used, in a fixed order: the same bits everywhere.

pub mod delaunay;
pub(crate) mod crossing;
mod mapped;
mod merge;
pub(crate) mod outline;
mod quality;
pub(crate) mod rails;
pub(crate) mod smooth;
pub(crate) mod volume;

pub use quality::{qualities, quality};

use crate::plane::{Cell, Measure, Point, cross, dot, minus};
use outline::Line;
use std::collections::BTreeMap;
use std::fmt;

/// Rounds in which chains get more nodes where the triangles need them; in the last ones they get none.
const ROUNDS: usize = 10;
const OPEN: usize = 7;
/// Crossings of lines that are looked at in one round.
const MANY: usize = 1000;
/// Least scaled Jacobian of a mesh that is given.
const WORST: f64 = 0.1;
/// Least scaled Jacobian of rows and columns that are given without a look at other meshes.
const GOOD: f64 = 0.75;
/// Cosine of the angle, 130 degrees, above which a corner of the outline needs two cells.
const FLAT: f64 = -0.642_787_609_686_539_3;
/// Size of triangles by that of quadrilaterals, so that these are as many as ∫ dA / h².
const COARSE: f64 = 2.34;
/// Size of triangles for the Delaunay mesher by what is wanted.
const FINE: f64 = 1.06;

/// The outline of a region.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Closed chains of points, m, each with the body on its left: the outer one counter-clockwise, holes
    /// clockwise. The last point is joined to the first.
    pub loops: Vec<Vec<Point>>,
    /// For each point whether it must stay a node, as corners and ends of named sides must. Points where the
    /// outline turns by more than 30 degrees stay anyway.
    pub fixed: Vec<Vec<bool>>,
}

/// Where a node lies on the old outline, before it is moved along the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnOutline {
    /// Number of the node in the new mesh.
    pub node: u32,
    /// Segment of the old loop, from its point of this number to the next.
    pub segment: u32,
    /// Place on the segment, from 0 to less than 1.
    pub fraction: f64,
}

/// A node of a new outline, which is asked about before it is given a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Number of the old loop.
    pub of_loop: usize,
    /// Segment of that loop, from its point of this number to the next.
    pub segment: u32,
    /// Place on the segment, from 0 to less than 1.
    pub fraction: f64,
    /// Where the node would be, m: first on the segment, then moved along the normal too.
    pub place: Point,
}

/// Where a node of the new outline has to be, m, so that it is outside of what the body presses on; `None`
/// where it may be at its place. It is put there, but no farther from its segment than a quarter of the
/// edges' length, and held; other nodes move so that the region's measure stays. Points that stay are not
/// asked about, nor are those of an axis of revolution and those of straight lines that are nodes again.
/// Where the measure can't be kept so, nodes may be inside.
pub type KeptOut<'a> = &'a dyn Fn(Spot) -> Option<Point>;

/// Nodes may be anywhere: the body presses on nothing.
#[must_use]
pub fn anywhere(_: Spot) -> Option<Point> {
    None
}

/// A mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Meshed {
    /// Places of the nodes, m.
    pub positions: Vec<Point>,
    /// Nodes of the cells.
    pub cells: Vec<Cell>,
    /// Nodes along each loop, in its direction, the one nearest after its first point first.
    pub loops: Vec<Vec<OnOutline>>,
}

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The outline can't be one of a region.
    Outline(&'static str),
    /// The outline crosses or touches itself.
    Crossing {
        /// Near this point, m.
        at: Point,
    },
    /// The wanted size is not a positive number.
    Size {
        /// Where, m.
        at: Point,
    },
    /// More cells would be needed than are allowed, or ever more as pieces of the outline nearly touch.
    Limit,
    /// Curved pieces can't be moved so that the region keeps its measure.
    Measure,
    /// The best mesh that was found has too bad cells.
    Quality {
        /// Least scaled Jacobian.
        least: f64,
    },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Outline(why) => write!(f, "the outline is not that of a region: {why}"),
            Self::Crossing { at: [x, y] } => write!(f, "the outline crosses or touches itself at ({x:.6e}, {y:.6e}) m"),
            Self::Size { at: [x, y] } => write!(f, "the wanted size of cells at ({x:.6e}, {y:.6e}) m is not a positive number"),
            Self::Limit => write!(f, "more cells would be needed than are allowed"),
            Self::Measure => write!(f, "the outline can't be divided again with the same area or volume"),
            Self::Quality { least } => write!(f, "the best mesh found has a least scaled Jacobian of {least:.3}"),
        }
    }
}

impl std::error::Error for Failure {}

/// Quadrilaterals inside an outline with edges about as long as `size` says, m, `limit` at most. The region's
/// measure stays what it was.
///
/// # Errors
///
/// Where the outline is not that of a region, or no good mesh is found; see [`Failure`].
pub fn quadrilaterals(outline: &Outline, size: &dyn Fn(Point) -> f64, measure: Measure, limit: usize) -> Result<Meshed, Failure> {
    quadrilaterals_outside(outline, size, measure, limit, &anywhere)
}

/// The same with nodes of the outline outside of what the body presses on.
///
/// # Errors
///
/// As those of [`quadrilaterals`].
pub fn quadrilaterals_outside(
    outline: &Outline,
    size: &dyn Fn(Point) -> f64,
    measure: Measure,
    limit: usize,
    kept_out: KeptOut<'_>,
) -> Result<Meshed, Failure> {
    let lines = outline::lines(outline, size, 1.0, limit)?;
    check(&lines, measure)?;
    let mapped = if let [line] = &lines[..] { mapped::mapped(line, size, measure, limit, kept_out) } else { None };
    let of = |meshed: &Meshed| quality(&meshed.positions, &meshed.cells);
    match mapped {
        Some(mapped) if of(&mapped) >= GOOD => Ok(mapped),
        Some(mapped) => match mesh(outline, size, measure, limit, true, kept_out) {
            Err(_) if of(&mapped) >= WORST => Ok(mapped),
            Ok(other) if of(&mapped) > of(&other) => Ok(mapped),
            other => other,
        },
        None => mesh(outline, size, measure, limit, true, kept_out),
    }
}

/// The same of triangles.
///
/// # Errors
///
/// As those of [`quadrilaterals`].
pub fn triangles(outline: &Outline, size: &dyn Fn(Point) -> f64, measure: Measure, limit: usize) -> Result<Meshed, Failure> {
    mesh(outline, size, measure, limit, false, &anywhere)
}

fn mesh(
    outline: &Outline,
    size: &dyn Fn(Point) -> f64,
    measure: Measure,
    limit: usize,
    halves: bool,
    kept_out: KeptOut<'_>,
) -> Result<Meshed, Failure> {
    let (per, scale) = if halves { (2.1, COARSE) } else { (1.0, FINE) };
    let mut lines = outline::lines(outline, size, per, limit)?;
    check(&lines, measure)?;
    let wanted = |x: Point| scale * size(x);
    // A triangle makes two quadrilaterals or more, and a vertex two triangles or less.
    let most = if halves { limit / 2 } else { limit };
    for round in 0..ROUNDS {
        lines.iter_mut().for_each(Line::level);
        let nodes = volume::corrected(&mut lines, measure, halves, kept_out).ok_or(Failure::Measure)?;
        if nodes.iter().flatten().map(Vec::len).sum::<usize>() / 2 > limit.saturating_add(100) {
            return Err(Failure::Limit);
        }
        let step = if halves { 2 } else { 1 };
        let loops: Vec<Vec<Point>> = nodes
            .iter()
            .map(|chains| chains.iter().flat_map(|nodes| nodes[..nodes.len() - 1].iter().step_by(step).copied()).collect())
            .collect();
        let mut crossings = crossing::crossings(&loops, MANY);
        if halves && crossings.is_empty() {
            let all = nodes.iter().map(|chains| chains.iter().flat_map(|nodes| nodes[..nodes.len() - 1].iter().copied()).collect());
            crossings = crossing::crossings(&all.collect::<Vec<_>>(), MANY);
            crossings.iter_mut().flatten().for_each(|edge| edge[1] /= 2);
        }
        if !crossings.is_empty() {
            divide_crossing(&mut lines, &crossings)?;
            continue;
        }
        let made = delaunay::triangles_within(&loops, &wanted, most, round >= OPEN).ok_or(Failure::Limit)?;
        if divide(&mut lines, &made) {
            continue;
        }
        let meshed = finish(&lines, &nodes, made, halves);
        if meshed.cells.len() > limit {
            return Err(Failure::Limit);
        }
        let least = quality(&meshed.positions, &meshed.cells);
        return if least >= WORST { Ok(meshed) } else { Err(Failure::Quality { least }) };
    }
    Err(Failure::Limit)
}

/// Whether the lines bound a region.
pub(crate) fn check(lines: &[Line], measure: Measure) -> Result<(), Failure> {
    let polygons: Vec<Vec<Point>> = lines.iter().map(|line| line.points.clone()).collect();
    if measure == Measure::Revolution && polygons.iter().flatten().any(|x| x[0] < 0.0) {
        return Err(Failure::Outline("it crosses the axis of revolution"));
    }
    if let Some([[p, k], _]) = crossing::crossings(&polygons, 1).first() {
        return Err(Failure::Crossing { at: polygons[*p][*k] });
    }
    for (p, polygon) in polygons.iter().enumerate() {
        let around = polygons.iter().enumerate().filter(|(other, _)| *other != p);
        let depth = around.filter(|(_, other)| delaunay::is_inside(std::slice::from_ref(*other), polygon[0])).count();
        let area = volume::measured(Measure::Plane, std::slice::from_ref(polygon));
        if (area > 0.0) != (depth % 2 == 0) {
            return Err(Failure::Outline("a loop has the body on its right"));
        }
    }
    Ok(())
}

/// New nodes on edges of the coarse lines that cross each other, and on nothing else.
fn divide_crossing(lines: &mut [Line], crossings: &[[crossing::Edge; 2]]) -> Result<(), Failure> {
    let mut edges: Vec<crossing::Edge> = crossings.iter().flatten().copied().collect();
    edges.sort_unstable();
    edges.dedup();
    let mut divided = false;
    for (p, line) in lines.iter_mut().enumerate() {
        let mut first = 0;
        for chain in &mut line.chains {
            let count = chain.places.len() - 1;
            let mut more = Vec::new();
            for k in edges.iter().filter(|edge| edge[0] == p && (first..first + count).contains(&edge[1])).map(|edge| edge[1] - first) {
                more.push(0.5 * (chain.places[k] + chain.places[k + 1]));
            }
            first += count;
            divided |= !more.is_empty() && !chain.is_straight;
            chain.add(&more);
        }
    }
    if divided { Ok(()) } else { Err(Failure::Outline("pieces of it are too near to each other")) }
}

/// Gives the lines the nodes that the mesher has put on their edges; whether there were any.
fn divide(lines: &mut [Line], made: &delaunay::Triangles) -> bool {
    let mut edges = made.edges.iter();
    let mut divided = false;
    for chain in lines.iter_mut().flat_map(|line| &mut line.chains) {
        let mut more = Vec::new();
        for (pair, nodes) in chain.places.windows(2).zip(&mut edges) {
            let [a, b] = [nodes[0], nodes[nodes.len() - 1]].map(|node| made.positions[node as usize]);
            for &node in &nodes[1..nodes.len() - 1] {
                let fraction = dot(minus(made.positions[node as usize], a), minus(b, a)) / dot(minus(b, a), minus(b, a));
                more.push(pair[0] + fraction * (pair[1] - pair[0]));
            }
        }
        divided |= !more.is_empty();
        chain.add(&more);
    }
    divided
}

/// Turns the nodes of a loop so that the first one after the loop's first point comes first.
pub(crate) fn from_the_first(nodes: &mut [OnOutline]) {
    let place = |node: &OnOutline| (node.segment, node.fraction);
    let first = (0..nodes.len()).reduce(|a, b| if place(&nodes[b]) < place(&nodes[a]) { b } else { a });
    nodes.rotate_left(first.unwrap_or(0));
}

/// The mesh from triangles whose outlines have no nodes besides those of the lines.
fn finish(lines: &[Line], nodes: &[Vec<Vec<Point>>], made: delaunay::Triangles, halves: bool) -> Meshed {
    let mut positions = made.positions;
    let mut edges = made.edges.iter().map(|nodes| nodes[0]);
    let mut middles = BTreeMap::new();
    let mut loops = Vec::new();
    let mut kinds = vec![merge::Kind::Inner; positions.len()];
    for (line, chains) in lines.iter().zip(nodes) {
        let coarse: Vec<u32> = line.chains.iter().flat_map(|chain| 1..chain.places.len()).zip(&mut edges).map(|(_, node)| node).collect();
        let mut nodes: Vec<OnOutline> = Vec::new();
        let mut k = 0;
        for (chain, points) in line.chains.iter().zip(chains) {
            for (i, pair) in chain.places.windows(2).enumerate() {
                let [a, b] = [coarse[k], coarse[(k + 1) % coarse.len()]];
                nodes.push(line.on_outline(pair[0], a));
                if halves {
                    let node = positions.len() as u32;
                    positions.push(points[2 * i + 1]);
                    middles.insert([a.min(b), a.max(b)], node);
                    nodes.push(line.on_outline(0.5 * (pair[0] + pair[1]), node));
                }
                k += 1;
            }
        }
        for k in (0..nodes.len()).step_by(if halves { 2 } else { 1 }) {
            let x = |k: usize| positions[nodes[k % nodes.len()].node as usize];
            let (on, back) = (minus(x(k + 1), x(k)), minus(x(k + nodes.len() - 1), x(k)));
            let is_corner = cross(on, back) > 0.0 && dot(on, back) > FLAT * (dot(on, on) * dot(back, back)).sqrt();
            kinds[nodes[k].node as usize] = if is_corner { merge::Kind::Corner } else { merge::Kind::Flat };
        }
        from_the_first(&mut nodes);
        loops.push(nodes);
    }
    let cells: Vec<Cell> = if halves {
        let cells = merge::merged(&positions, &made.triangles, &kinds);
        merge::divided(&mut positions, &cells, middles)
    } else {
        made.triangles.iter().map(|&[a, b, c]| [a, b, c, c]).collect()
    };
    let mut held = vec![false; positions.len()];
    loops.iter().flatten().for_each(|node| held[node.node as usize] = true);
    smooth::smooth(&mut positions, &cells, &held);
    Meshed { positions, cells, loops }
}

#[cfg(test)]
pub(crate) mod tests;
#[cfg(test)]
mod outside_tests;
