//! Values of the integration points of a new mesh.
//!
//! Sub-cells are cells with one point, and quarters of quadrilaterals with four. What an old and a new
//! sub-cell have in common is found by pieces of their triangles; `shared::limiter` says what values follow.

use super::boundary::{boundary, slivers};
use super::clip::{Cut, Twin, moments, pieces, twins};
use super::quarters::SubCells;
use super::supermesh::{cell_volumes, from_axis};
use super::{Failure, Side};
use crate::plane::{Measure, Mesh, Point, corners, minus};
use crate::shared::limiter::{Map, Share, merged, neighbours};
use crate::shared::uncovered;

/// Integration points of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a> {
    /// The mesh.
    pub mesh: Mesh<'a>,
    /// Points of each cell: 1, or 4 in quadrilaterals, at ±1/√3 in the order of the corners.
    pub points: usize,
}

/// How values vary within a sub-cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Not at all: new values are means of old ones with positive weights. First order.
    Constant,
    /// With limited slopes. Second order where fields are smooth.
    Linear,
}

/// Values of the points of the old mesh.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    /// `width` numbers by point, points by cell.
    pub values: &'a [f64],
    /// Numbers by point.
    pub width: usize,
    /// Mass by volume of each old cell, kg/m³, for what goes with mass, such as plastic strain; `None` for
    /// what goes with volume, such as stress.
    pub densities: Option<&'a [f64]>,
    /// How they vary.
    pub order: Order,
    /// Lowest and highest value that each of the `width` numbers can have, which old values have to keep.
    pub limits: Option<&'a [[f64; 2]]>,
}

/// The overlaps of the sub-cells of two meshes.
#[derive(Debug)]
pub struct PointMap {
    map: Map<2>,
}

/// The values of the new mesh's points, `width` numbers by point.
///
/// # Errors
/// As `PointMap::new` and `PointMap::values`.
pub fn points(old: &Points<'_>, new: &Points<'_>, measure: Measure, values: &Values<'_>) -> Result<Vec<f64>, Failure> {
    PointMap::new(old, new, measure)?.values(values)
}

impl PointMap {
    /// The overlaps of two meshes.
    ///
    /// # Errors
    /// `Size`; `Inverted`; `Uncovered`; `Points` for numbers of points that are not known.
    pub fn new(old: &Points<'_>, new: &Points<'_>, measure: Measure) -> Result<Self, Failure> {
        let parents = |twin: &Twin, points: usize| twin.cell as usize / points;
        let of_cell = |points: usize, side: Side| {
            move |failure| match failure {
                Failure::Inverted { cell, .. } => Failure::Inverted { side, cell: cell / points },
                other => other,
            }
        };
        let from = SubCells::of(old.mesh, old.points, measure, Side::Old)?;
        let to = SubCells::of(new.mesh, new.points, measure, Side::New)?;
        let old_twins = twins(from.mesh(), Cut::Two, Side::Old).map_err(of_cell(old.points, Side::Old))?;
        let new_twins = twins(to.mesh(), Cut::Two, Side::New).map_err(of_cell(new.points, Side::New))?;
        let whole: Vec<[f64; 3]> = old_twins.iter().map(|twin| twin.moments(measure)).collect();
        let old_volumes = cell_volumes(&old_twins, &whole, from.cells.len(), Side::Old).map_err(of_cell(old.points, Side::Old))?;
        let mut centres = vec![[0.0; 2]; from.cells.len()];
        for (twin, moments) in old_twins.iter().zip(&whole) {
            for k in 0..2 {
                let sum = (0..3).fold(0.0, |sum, j| sum + moments[j] * twin.places[j][k]);
                centres[twin.cell as usize][k] += sum / old_volumes[twin.cell as usize];
            }
        }
        let share = |i: usize, new: u32, moments: &[f64; 3]| {
            let (twin, mut moment) = (&old_twins[i], [0.0; 2]);
            for (part, &place) in moments.iter().zip(&twin.places) {
                let arm = minus(place, centres[twin.cell as usize]);
                (0..2).for_each(|k| moment[k] += part * arm[k]);
            }
            Share { old: twin.cell, new, volume: moments[0] + moments[1] + moments[2], moment }
        };
        let mut within = vec![[0.0; 3]; old_twins.len()];
        let mut covered = vec![0.0; new.mesh.cells.len()];
        let mut shares = Vec::with_capacity(8 * new_twins.len());
        pieces(&old_twins, &new_twins, |i, k, piece| {
            let (twin, mut sums) = (&old_twins[i], [0.0; 3]);
            piece.fan(twin, &new_twins[k], |[p, q, r], area| {
                let of = moments(area, [from_axis(p, twin), from_axis(q, twin), from_axis(r, twin)], measure);
                (0..3).for_each(|j| sums[j] += of[0] * p.old[j] + of[1] * q.old[j] + of[2] * r.old[j]);
            });
            let found = share(i, new_twins[k].cell, &sums);
            if found.volume > 0.0 {
                (0..3).for_each(|j| within[i][j] += sums[j]);
                covered[parents(&new_twins[k], new.points)] += found.volume;
                shares.push(found);
            }
        });
        let mut volumes = vec![0.0; new.mesh.cells.len()];
        for twin in &new_twins {
            volumes[parents(twin, new.points)] += twin.moments(measure).iter().sum::<f64>();
        }
        uncovered(&covered, &volumes)?;
        for sliver in slivers(&old_twins, &whole, &within, to.mesh()).ok_or(Failure::Size)? {
            shares.push(share(sliver.old as usize, sliver.edge.cell, &sliver.moments));
        }
        let (starts, neighbours) = neighbours(from.cells.iter().map(corners), from.positions.len());
        let outer = outer(&from);
        let shares = merged(shares);
        let map = Map { old: from.layout, new: to.layout, shares, centres, volumes: old_volumes, starts, neighbours, outer, solve: slope };
        Ok(Self { map })
    }

    /// Weights of points in which the integral is kept, Σ w φ: volumes (m³), or masses (kg) with densities.
    /// Old ones, then new ones. New material weighs what it has come from, whatever the new cell's volume.
    ///
    /// # Errors
    /// `Size` if there is not one density for each old cell.
    pub fn weights(&self, densities: Option<&[f64]>, order: Order) -> Result<[Vec<f64>; 2], Failure> {
        self.map.weights(densities, order)
    }

    /// The values of the new mesh's points, `width` numbers by point. Sums Σ w φ with `weights` are kept.
    ///
    /// # Errors
    /// `Size`; `Number`; `Massless` for a density that is not positive.
    pub fn values(&self, of: &Values<'_>) -> Result<Vec<f64>, Failure> {
        self.map.values(of)
    }
}

/// Solves the normal equations of a slope.
fn slope([[xx, xy], [_, yy]]: [[f64; 2]; 2], right: Point) -> Point {
    let determinant = xx * yy - xy * xy;
    if determinant > 1e-9 * (xx + yy) * (xx + yy) {
        [(yy * right[0] - xy * right[1]) / determinant, (xx * right[1] - xy * right[0]) / determinant]
    } else {
        [0.0; 2]
    }
}

/// Sub-cells with each of their vertices on the outline.
fn outer(of: &SubCells) -> Vec<(u32, Point)> {
    let mut is_outer = vec![false; of.positions.len()];
    boundary(&of.cells).iter().for_each(|edge| edge.nodes.iter().for_each(|&node| is_outer[node as usize] = true));
    let mut found = Vec::new();
    for (index, cell) in of.cells.iter().enumerate() {
        let on = corners(cell).iter().filter(|&&node| is_outer[node as usize]);
        found.extend(on.map(|&node| (index as u32, of.positions[node as usize])));
    }
    found
}
