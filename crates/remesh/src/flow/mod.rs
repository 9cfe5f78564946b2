//! A mesh that stays in place along the direction in which its material flows (quasi-Eulerian): where its
//! nodes go back to, and what has come in and gone out on the way.
//!
//! In coordinates s along the flow and t across it the region has an inlet, an outlet, and two surfaces t(s).
//! Its nodes have moved with the material. They go back to their s; those of the surfaces to where the
//! surface is there now, the others to the same share of the height, and those of the inlet to where they
//! were. What the mesh leaves behind the outlet, and what it is short of at the inlet, are rows of cells of
//! their own: the old cells with those of the inlet, and the new cells with those of the outlet, fill the
//! same region, so that a transfer between them keeps all sums.

use crate::plane::{self, Cell, Mesh, Point, corners, cross, dot};
use std::fmt;

/// Why nodes can't go back.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The region has holes, or its outline meets itself in a node.
    Outline,
    /// Along the flow the region has not one inlet and one outlet with a surface t(s) on either side of it.
    Surfaces,
    /// The direction has no length, or lengths of the inputs disagree.
    Input,
    /// A node of the inlet or of the outlet is not ahead of its place: there the material does not flow along
    /// the direction.
    Backwards,
    /// The surface overhangs: it is no function of s any more.
    Overhang,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Outline => "its outline is not one closed line",
            Self::Surfaces => "along the flow it is not a channel with one inlet, one outlet and a surface on either side",
            Self::Input => "the direction of the flow is none, or numbers of nodes disagree",
            Self::Backwards => "at an end of it material does not flow along the direction",
            Self::Overhang => "its surface overhangs across the flow",
        })
    }
}

impl std::error::Error for Failure {}

/// The places to which nodes go back, and what each node is for the flow.
#[derive(Clone, Debug)]
pub struct Window<'a> {
    mesh: Mesh<'a>,
    /// Unit vector along the flow.
    direction: Point,
    /// Places as s, t.
    places: Vec<Point>,
    /// Nodes of the inlet downwards in t, and of the outlet upwards.
    ends: [Vec<u32>; 2],
    /// Nodes of the lower and the upper surface along the flow.
    surfaces: [Vec<u32>; 2],
    /// Share of the height of each node.
    shares: Vec<f64>,
    /// Width of each cell along the flow, m.
    widths: Vec<f64>,
}

/// How far nodes are from their places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Travel {
    /// Mean way along the flow, m.
    pub mean: f64,
    /// Largest way over the width of a cell there.
    pub most: f64,
    /// Least way of a node of the inlet or the outlet, m.
    pub least_of_ends: f64,
}

/// A row of cells at an end of the mesh.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Places of nodes that it has beyond those of the mesh, numbered after them, m.
    pub positions: Vec<Point>,
    /// The node of the mesh that each of them is a twin of.
    pub twins: Vec<u32>,
    /// Its cells.
    pub cells: Vec<Cell>,
    /// The cell of the mesh that each of them is beside, and the corner of it that each of its corners is, or
    /// is a twin of.
    pub beside: Vec<(u32, [u8; 4])>,
}

/// Nodes back in place.
#[derive(Clone, Debug)]
pub struct Returned {
    /// Their places, m.
    pub positions: Vec<Point>,
    /// Of nodes of the outline the nodes between which the material there is, with their shares; none of
    /// those inside.
    pub between: Vec<Vec<(u32, f64)>>,
    /// What has come in: cells beside those of the mesh as it was.
    pub inflow: Row,
    /// What has gone out: cells beside those of the mesh with its nodes in place.
    pub outflow: Row,
}

/// Cosine of the angle to the flow of the normal of what can be an end.
const END: f64 = 0.7;

impl<'a> Window<'a> {
    /// The window of a mesh whose nodes are in place, for a flow along `direction`.
    ///
    /// # Errors
    /// `Input`, `Outline`, `Surfaces`.
    pub fn new(mesh: Mesh<'a>, direction: Point) -> Result<Self, Failure> {
        let length = dot(direction, direction).sqrt();
        let is_known = mesh.cells.iter().flatten().all(|&node| (node as usize) < mesh.positions.len());
        if !(length > 0.0 && length.is_finite() && is_known && !mesh.cells.is_empty()) {
            return Err(Failure::Input);
        }
        let direction = direction.map(|own| own / length);
        let places: Vec<Point> = mesh.positions.iter().map(|&x| along(direction, x)).collect();
        let outline = outline(mesh.cells)?;
        let [ends, surfaces] = ends_and_surfaces(&outline, &places)?;
        let chains = surfaces.each_ref().map(|nodes| nodes.iter().map(|&node| places[node as usize]).collect::<Vec<_>>());
        let share = |&[s, t]: &Point| {
            let [low, up] = chains.each_ref().map(|chain| height(chain, s));
            if up > low { (t - low) / (up - low) } else { f64::NAN }
        };
        let shares: Vec<f64> = places.iter().map(share).collect();
        if !shares.iter().all(|share| share.is_finite()) {
            return Err(Failure::Surfaces);
        }
        let width = |cell: &Cell| {
            let of = |node: &u32| places[*node as usize][0];
            cell.iter().map(of).fold(f64::NEG_INFINITY, f64::max) - cell.iter().map(of).fold(f64::INFINITY, f64::min)
        };
        let widths = mesh.cells.iter().map(width).collect();
        Ok(Self { mesh, direction, places, ends, surfaces, shares, widths })
    }

    /// From the inlet to the outlet, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let mean = |nodes: &[u32]| nodes.iter().map(|&node| self.places[node as usize][0]).sum::<f64>() / nodes.len() as f64;
        mean(&self.ends[1]) - mean(&self.ends[0])
    }

    /// The cells at the inlet, in the order of [`Returned::inflow`]: see [`Row::beside`].
    #[must_use]
    pub fn inlet(&self) -> Vec<(u32, [u8; 4])> {
        self.row(&self.ends[0], |node| self.mesh.positions[node as usize]).beside
    }

    /// How far nodes at `positions` (m) are from their places.
    #[must_use]
    pub fn travel(&self, positions: &[Point]) -> Travel {
        let way = |node: u32| dot(self.direction, positions[node as usize]) - self.places[node as usize][0];
        let mean = (0..self.places.len() as u32).map(way).sum::<f64>() / self.places.len() as f64;
        let farthest = |cell: &Cell| cell.iter().map(|&node| way(node).abs()).fold(0.0, f64::max);
        let most = self.mesh.cells.iter().zip(&self.widths).map(|(cell, width)| farthest(cell) / width).fold(0.0, f64::max);
        Travel { mean, most, least_of_ends: self.ends.iter().flatten().map(|&node| way(node)).fold(f64::INFINITY, f64::min) }
    }

    /// Coordinate across the flow of each node at `positions`, m.
    #[must_use]
    pub fn across(&self, positions: &[Point]) -> Vec<f64> {
        positions.iter().map(|&x| cross(self.direction, x)).collect()
    }

    /// The nodes, now at `positions` (m), back in place.
    ///
    /// # Errors
    /// `Input`, `Backwards`, `Overhang`.
    pub fn returned(&self, positions: &[Point]) -> Result<Returned, Failure> {
        if positions.len() != self.places.len() {
            return Err(Failure::Input);
        }
        if !(self.travel(positions).least_of_ends > 0.0) {
            return Err(Failure::Backwards);
        }
        let now: Vec<Point> = positions.iter().map(|&x| along(self.direction, x)).collect();
        let mut between = vec![Vec::new(); now.len()];
        let mut chains = [Vec::new(), Vec::new()];
        for (chain, nodes) in chains.iter_mut().zip(&self.surfaces) {
            // What has come in continues the surface to the inlet's place.
            let first = self.places[nodes[0] as usize];
            let old: Vec<Point> = [first].into_iter().chain(nodes.iter().map(|&node| now[node as usize])).collect();
            if !old.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
                return Err(Failure::Overhang);
            }
            for &node in nodes {
                let s = self.places[node as usize][0];
                let (segment, share) = segment(&old, s);
                chain.push([s, curved(&old, segment, s)]);
                // The point before the first is its twin.
                let ends = [nodes[segment.saturating_sub(1)], nodes[segment]];
                between[node as usize] = shared(ends, share);
            }
            chain[0] = first;
        }
        let mut places: Vec<Point> = self.places.clone();
        for ((place, &share), &[s, _]) in places.iter_mut().zip(&self.shares).zip(&self.places) {
            let [low, up] = chains.each_ref().map(|chain| height(chain, s));
            *place = [s, low + share * (up - low)];
        }
        for (chain, nodes) in chains.iter().zip(&self.surfaces) {
            nodes.iter().zip(chain).for_each(|(&node, &place)| places[node as usize] = place);
        }
        for &node in self.ends.iter().flatten() {
            if between[node as usize].is_empty() {
                between[node as usize] = vec![(node, 1.0)];
            }
        }
        self.ends[0].iter().for_each(|&node| places[node as usize] = self.places[node as usize]);
        let mut back: Vec<Point> = places.iter().map(|&place| self.whence(place)).collect();
        // To the last digit.
        self.ends[0].iter().for_each(|&node| back[node as usize] = self.mesh.positions[node as usize]);
        let inflow = self.row(&self.ends[0], |node| self.mesh.positions[node as usize]);
        let outflow = self.row(&self.ends[1], |node| positions[node as usize]);
        Ok(Returned { positions: back, between, inflow, outflow })
    }

    /// The place at s, t.
    fn whence(&self, [s, t]: Point) -> Point {
        let [x, y] = self.direction;
        [s * x - t * y, s * y + t * x]
    }

    /// Cells between an end and the places of its twins.
    fn row(&self, end: &[u32], twin: impl Fn(u32) -> Point) -> Row {
        let mut row = Row { positions: end.iter().map(|&node| twin(node)).collect(), twins: end.to_vec(), ..Row::default() };
        let count = self.mesh.positions.len() as u32;
        for (k, pair) in (0..).zip(end.windows(2)) {
            let [a, b] = [pair[0], pair[1]];
            let beside = self.mesh.cells.iter().position(|cell| {
                let nodes = corners(cell);
                (0..nodes.len()).any(|k| nodes[k] == a && nodes[(k + 1) % nodes.len()] == b)
            });
            let Some(cell) = beside else { continue };
            let corner = |node: u32| self.mesh.cells[cell].iter().position(|&own| own == node).unwrap_or(0) as u8;
            row.cells.push([b, a, count + k, count + k + 1]);
            row.beside.push((cell as u32, [corner(b), corner(a), corner(a), corner(b)]));
        }
        row
    }
}

/// Coordinates along the flow and across it.
fn along(direction: Point, x: Point) -> Point {
    [dot(direction, x), cross(direction, x)]
}

/// Nodes along the closed outline, the body on the left.
fn outline(cells: &[Cell]) -> Result<Vec<u32>, Failure> {
    let loops = plane::loops(cells).map_err(|_| Failure::Outline)?;
    <[Vec<u32>; 1]>::try_from(loops).map(|[only]| only).map_err(|_| Failure::Outline)
}

/// Nodes of the inlet downwards and the outlet upwards in t, and those of both surfaces along s.
fn ends_and_surfaces(outline: &[u32], places: &[Point]) -> Result<[[Vec<u32>; 2]; 2], Failure> {
    let n = outline.len();
    let place = |k: usize| places[outline[k % n] as usize];
    // The normal of an edge, outwards, along the flow.
    let facing = |k: usize| {
        let [a, b] = [place(k), place(k + 1)];
        let (ds, dt) = (b[0] - a[0], b[1] - a[1]);
        dt / (ds * ds + dt * dt).sqrt()
    };
    // The edges of an end: those around the one that lies farthest out.
    let end = |sign: f64| {
        let faces = |k: usize| sign * facing(k) > END;
        let middle = |k: usize| sign * (place(k)[0] + place(k + 1)[0]);
        let farthest = (0..n).filter(|&k| faces(k)).reduce(|most, k| if middle(k) > middle(most) { k } else { most })?;
        let before = (0..n).take_while(|back| faces((farthest + n - back) % n)).count();
        let after = (1..n).take_while(|on| faces((farthest + on) % n)).count();
        let edges = before + after;
        (edges < n).then(|| ((farthest + n + 1 - before) % n, edges))
    };
    let [(inlet, of_inlet), (outlet, of_outlet)] = [end(-1.0), end(1.0)].map(|end| end.unwrap_or((0, 0)));
    let nodes = |from: usize, edges: usize| -> Vec<u32> { (0..=edges).map(|k| outline[(from + k) % n]).collect() };
    let between = |from: usize, to: usize| (to + n - from % n) % n;
    let lower = nodes(inlet + of_inlet, between(inlet + of_inlet, outlet));
    let mut upper = nodes(outlet + of_outlet, between(outlet + of_outlet, inlet));
    upper.reverse();
    let rises =
        |chain: &Vec<u32>| chain.len() >= 2 && chain.windows(2).all(|pair| places[pair[0] as usize][0] < places[pair[1] as usize][0]);
    if of_inlet == 0 || of_outlet == 0 || !rises(&lower) || !rises(&upper) {
        return Err(Failure::Surfaces);
    }
    Ok([[nodes(inlet, of_inlet), nodes(outlet, of_outlet)], [lower, upper]])
}

/// The segment of a chain at s, and the part of it up to there; beyond its ends of the first or the last one.
fn segment(chain: &[Point], s: f64) -> (usize, f64) {
    let k = chain[1..chain.len() - 1].partition_point(|point| point[0] <= s);
    (k, (s - chain[k][0]) / (chain[k + 1][0] - chain[k][0]))
}

/// The height of a chain at s, m.
fn height(chain: &[Point], s: f64) -> f64 {
    let (k, share) = segment(chain, s);
    let [a, b] = [chain[k][1], chain[k + 1][1]];
    if share == 1.0 { b } else { a + share * (b - a) }
}

/// The height at s of the curve whose points a chain has, m: that of the segment k, and a parabola of the
/// smaller curvature at its ends where both are of one sign.
fn curved(chain: &[Point], k: usize, s: f64) -> f64 {
    let slope = |k: usize| (chain[k + 1][1] - chain[k][1]) / (chain[k + 1][0] - chain[k][0]);
    let curvature = |k: usize| (k > 0 && k + 1 < chain.len()).then(|| (slope(k) - slope(k - 1)) / (chain[k + 1][0] - chain[k - 1][0]));
    let own = match (curvature(k), curvature(k + 1)) {
        (Some(a), Some(b)) if a * b > 0.0 => {
            if a.abs() < b.abs() {
                a
            } else {
                b
            }
        }
        (Some(_), Some(_)) | (None, None) => 0.0,
        (Some(one), None) | (None, Some(one)) => one,
    };
    let [a, b] = [chain[k][0], chain[k + 1][0]];
    let height = height(chain, s);
    if s > a && s < b { height + own * (s - a) * (s - b) } else { height }
}

/// Shares of the ends of a segment.
fn shared([a, b]: [u32; 2], share: f64) -> Vec<(u32, f64)> {
    let share = share.clamp(0.0, 1.0);
    match (a == b, share) {
        (true, _) => vec![(a, 1.0)],
        (_, 0.0) => vec![(a, 1.0)],
        (_, 1.0) => vec![(b, 1.0)],
        _ => vec![(a, 1.0 - share), (b, share)],
    }
}

#[cfg(test)]
mod tests;
