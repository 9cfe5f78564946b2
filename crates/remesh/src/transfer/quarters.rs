//! Sub-cells of integration points, and what the values of points say about means over sub-cells.
//!
//! Points of 2 × 2 stand at ±1/√3, centres of quarters at ±½: a linear field does not have the values of its
//! points as means of quarters. Within a cell a field is taken as the bilinear one (in reference coordinates)
//! with the values of the four points. Its means over the quarters are a 4 × 4 matrix times the values, with
//! the integral over the cell that the rule of 2 × 2 points gives; new values follow from new means by the
//! inverse.

use super::clip::TURN;
use super::{Failure, Side};
use crate::plane::{Cell, Measure, Mesh, Point, corners, cross, minus};
use crate::shared::limiter::{Layout, Rule};

/// Signs of reference coordinates of corners and points.
const SIGNS: [Point; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// The matrices of a quadrilateral; each point stands for its Jacobian, times 2πx in an axisymmetric body.
/// `None` if a corner turns inwards: there values are taken as means.
fn rule(x: &[Point; 4], measure: Measure) -> Option<Rule> {
    if !is_convex(x) {
        return None;
    }
    let gauss = 1.0 / 3.0f64.sqrt();
    let volume = |at: Point| {
        let shape = SIGNS.map(|s| 0.25 * (1.0 + s[0] * at[0]) * (1.0 + s[1] * at[1]));
        let (mut right, mut up, mut from_axis) = ([0.0; 2], [0.0; 2], 0.0);
        for (corner, s) in SIGNS.iter().enumerate() {
            for k in 0..2 {
                right[k] += 0.25 * s[0] * (1.0 + s[1] * at[1]) * x[corner][k];
                up[k] += 0.25 * s[1] * (1.0 + s[0] * at[0]) * x[corner][k];
            }
            from_axis += shape[corner] * x[corner][0];
        }
        cross(right, up) * if measure == Measure::Plane { 1.0 } else { TURN * from_axis }
    };
    let mut means = [[0.0; 4]; 4];
    for (quarter, row) in SIGNS.iter().zip(&mut means) {
        let mut sum = 0.0;
        for s in SIGNS {
            let at = [0, 1].map(|k| 0.5 * (quarter[k] + s[k] * gauss));
            let weight = volume(at);
            sum += weight;
            for (entry, point) in row.iter_mut().zip(SIGNS) {
                *entry += weight * 0.25 * (1.0 + point[0] * at[0] / gauss) * (1.0 + point[1] * at[1] / gauss);
            }
        }
        row.iter_mut().for_each(|entry| *entry /= sum);
    }
    let volumes = SIGNS.map(|s| volume([s[0] * gauss, s[1] * gauss]));
    Rule::of(&means, &volumes)
}

/// Whether no corner turns inwards.
fn is_convex(x: &[Point; 4]) -> bool {
    (0..4).all(|k| cross(minus(x[(k + 1) % 4], x[k]), minus(x[(k + 3) % 4], x[k])) > 0.0)
}

/// The sub-cells of integration points as a mesh.
#[derive(Debug)]
pub(super) struct SubCells {
    pub(super) positions: Vec<Point>,
    pub(super) cells: Vec<Cell>,
    pub(super) layout: Layout,
}

impl SubCells {
    pub(super) fn mesh(&self) -> Mesh<'_> {
        Mesh { positions: &self.positions, cells: &self.cells }
    }

    /// Cells themselves for one point; for four, the quarters between corners, middles of edges, and the mean
    /// of the corners (the middle of the diagonal within, if a corner turns inwards).
    pub(super) fn of(mesh: Mesh<'_>, points: usize, measure: Measure, side: Side) -> Result<Self, Failure> {
        let mut positions = mesh.positions.to_vec();
        match points {
            1 => {
                let layout = Layout::new(mesh.cells.iter().map(|_| 1), Vec::new());
                return Ok(Self { positions, cells: mesh.cells.to_vec(), layout });
            }
            4 => {}
            _ => return Err(Failure::Points { side, cell: 0 }),
        }
        if let Some(cell) = mesh.cells.iter().position(|cell| corners(cell).len() < 4) {
            return Err(Failure::Points { side, cell });
        }
        let ends = |cell: &Cell, k: usize| [cell[k].min(cell[(k + 1) % 4]), cell[k].max(cell[(k + 1) % 4])];
        let mut edges: Vec<[u32; 2]> = mesh.cells.iter().flat_map(|cell| (0..4).map(|k| ends(cell, k))).collect();
        edges.sort_unstable();
        edges.dedup();
        let at = |node: u32| mesh.positions.get(node as usize).copied().ok_or(Failure::Size);
        for &[a, b] in &edges {
            positions.push(middle(at(a)?, at(b)?));
        }
        let first = mesh.positions.len();
        let mut cells = Vec::with_capacity(4 * mesh.cells.len());
        let mut rules = Vec::with_capacity(mesh.cells.len());
        for cell in mesh.cells {
            let x = [at(cell[0])?, at(cell[1])?, at(cell[2])?, at(cell[3])?];
            let middles: [u32; 4] = std::array::from_fn(|k| (first + edges.binary_search(&ends(cell, k)).unwrap_or(0)) as u32);
            let centre = positions.len() as u32;
            positions.push(if is_convex(&x) { middle(middle(x[0], x[2]), middle(x[1], x[3])) } else { inner(&x) });
            cells.extend((0..4).map(|k| [cell[k], middles[k], centre, middles[(k + 3) % 4]]));
            rules.push(rule(&x, measure));
        }
        Ok(Self { positions, cells, layout: Layout::new(mesh.cells.iter().map(|_| 4), rules) })
    }
}

fn middle(a: Point, b: Point) -> Point {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// The middle of the diagonal whose smaller triangle is the larger one.
fn inner(x: &[Point; 4]) -> Point {
    let area = |a: usize, b: usize, c: usize| cross(minus(x[b], x[a]), minus(x[c], x[a]));
    let is_first = area(0, 1, 2).min(area(0, 2, 3)) >= area(0, 1, 3).min(area(1, 2, 3));
    if is_first { middle(x[0], x[2]) } else { middle(x[1], x[3]) }
}
