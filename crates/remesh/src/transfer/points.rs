//! Values of the integration points of a new mesh.
//!
//! Means over sub-cells (cells with one point, quarters of quadrilaterals with four) go to new sub-cells by
//! the pieces they have in common, φ_k = Σ w (φ_e + g_e·(x − x_e)) / Σ w, with the slopes g_e of least
//! squares over the sub-cells that share a vertex. Where a new value is outside the range of the old
//! sub-cells it overlaps and their neighbours, the slopes that it has come from are lessened, so that the
//! integral is kept whatever the slopes are.
//!
//! A sub-cell at the outline may pass the range of its neighbours by what its slope makes up to the outline,
//! if all neighbours slope the same way: half as much again as the smallest slope of them gives.
//!
//! Sources: Barth & Jespersen, AIAA 89-0366 (the range); Clain, Diot & Loubère, J. Comput. Phys. 230 (2011)
//! 4028-4050 (limiting afterwards).

use super::boundary::{boundary, slivers};
use super::clip::{Cut, Twin, moments, pieces, twins};
use super::quarters::SubCells;
use super::supermesh::{cell_volumes, from_axis, uncovered};
use super::{Failure, Side};
use crate::plane::{Measure, Mesh, Point, dot, minus};

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

/// What an old and a new sub-cell have in common.
#[derive(Clone, Copy, Debug)]
struct Share {
    old: u32,
    new: u32,
    /// m³ (per metre of depth in 2D).
    volume: f64,
    /// ∫ (x − x_e) dV about the old sub-cell's centre.
    moment: Point,
}

/// The overlaps of the sub-cells of two meshes.
#[derive(Debug)]
pub struct PointMap {
    old: SubCells,
    new: SubCells,
    shares: Vec<Share>,
    centres: Vec<Point>,
    old_volumes: Vec<f64>,
    /// Old sub-cells that share a vertex with each: of each the first, one more at the end.
    starts: Vec<u32>,
    neighbours: Vec<u32>,
    /// Old sub-cells at the outline with a vertex on it.
    outer: Vec<(u32, Point)>,
}

/// The values of the new mesh's points, `width` numbers by point.
///
/// # Errors
/// As `PointMap::new` and `PointMap::values`.
pub fn points(old: &Points<'_>, new: &Points<'_>, measure: Measure, values: &Values<'_>) -> Result<Vec<f64>, Failure> {
    PointMap::new(old, new, measure)?.values(values)
}

/// Rounds in which slopes are lessened just enough; after them they are set to zero.
const ROUNDS: usize = 3;
/// A range is widened by this part of itself.
const WIDER: f64 = 1e-3;
/// What a slope may make up to the outline, by what the smallest slope near would.
const BEYOND: f64 = 1.5;

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
        let shares = merged(shares);
        let (starts, neighbours) = neighbours(&from);
        let outer = outer(&from);
        Ok(Self { old: from, new: to, shares, centres, old_volumes, starts, neighbours, outer })
    }

    /// Weights of points in which the integral is kept, Σ w φ: volumes (m³), or masses (kg) with densities.
    /// Old ones, then new ones. New material weighs what it has come from, whatever the new cell's volume.
    ///
    /// # Errors
    /// `Size` if there is not one density for each old cell.
    pub fn weights(&self, densities: Option<&[f64]>, order: Order) -> Result<[Vec<f64>; 2], Failure> {
        let density = self.densities(densities)?;
        let mut weights = vec![0.0; self.new.cells.len()];
        for share in &self.shares {
            weights[share.new as usize] += density(share.old) * share.volume;
        }
        let mut old: Vec<f64> = (0..self.old.cells.len()).map(|e| density(e as u32) * self.old_volumes[e]).collect();
        if order == Order::Linear {
            by_points(&self.old, &mut old);
            by_points(&self.new, &mut weights);
        }
        Ok([old, weights])
    }

    fn densities<'a>(&self, densities: Option<&'a [f64]>) -> Result<impl Fn(u32) -> f64 + use<'a>, Failure> {
        let points = self.old.points;
        if densities.is_some_and(|all| all.len() * points != self.old.cells.len()) {
            return Err(Failure::Size);
        }
        match densities.and_then(|all| all.iter().position(|&density| !(density > 0.0 && density.is_finite()))) {
            Some(cell) => Err(Failure::Massless { cell }),
            None => Ok(move |e: u32| densities.map_or(1.0, |all| all[e as usize / points])),
        }
    }

    /// The values of the new mesh's points, `width` numbers by point. Sums Σ w φ with `weights` are kept.
    ///
    /// # Errors
    /// `Size`; `Number`; `Massless` for a density that is not positive.
    pub fn values(&self, of: &Values<'_>) -> Result<Vec<f64>, Failure> {
        let density = self.densities(of.densities)?;
        if of.values.len() != self.old.cells.len() * of.width || of.limits.is_some_and(|limits| limits.len() != of.width) {
            return Err(Failure::Size);
        }
        if !of.values.iter().all(|value| value.is_finite()) {
            return Err(Failure::Number);
        }
        let weights: Vec<f64> = self.shares.iter().map(|share| density(share.old) * share.volume).collect();
        let mut result = vec![0.0; self.new.cells.len() * of.width];
        for component in 0..of.width {
            let values: Vec<f64> = of.values.iter().skip(component).step_by(of.width).copied().collect();
            let limits = of.limits.map_or([f64::NEG_INFINITY, f64::INFINITY], |limits| limits[component]);
            let found = match of.order {
                Order::Constant => self.constant(&weights, &values),
                Order::Linear => self.linear(&weights, &density, &values, limits),
            };
            result.iter_mut().skip(component).step_by(of.width).zip(found).for_each(|(place, value)| *place = value);
        }
        Ok(result)
    }

    /// Means with the weights of the shares. A sub-cell without old material has that of the cell's others.
    fn constant(&self, weights: &[f64], values: &[f64]) -> Vec<f64> {
        let (mut sums, mut totals) = (vec![0.0; self.new.cells.len()], vec![0.0; self.new.cells.len()]);
        for (share, weight) in self.shares.iter().zip(weights) {
            sums[share.new as usize] += weight * values[share.old as usize];
            totals[share.new as usize] += weight;
        }
        for (sums, totals) in sums.chunks_mut(self.new.points).zip(totals.chunks(self.new.points)) {
            let mean = sums.iter().sum::<f64>() / totals.iter().sum::<f64>();
            sums.iter_mut().zip(totals).for_each(|(sum, &total)| *sum = if total > 0.0 { *sum / total } else { mean });
        }
        sums
    }

    fn linear(&self, weights: &[f64], density: &impl Fn(u32) -> f64, values: &[f64], limits: [f64; 2]) -> Vec<f64> {
        let mut means = values.to_vec();
        for (quarters, (means, values)) in self.old.quarters.iter().zip(means.chunks_mut(4).zip(values.chunks(4))) {
            if let Some(quarters) = quarters {
                times(&quarters.means, values, means);
            }
        }
        let slopes: Vec<Point> = (0..means.len()).map(|e| self.slope(&means, e)).collect();
        let ranges = self.ranges(values, &means, &slopes);
        let mut bounds = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.new.cells.len()];
        let mut totals = vec![0.0; self.new.cells.len()];
        for (share, weight) in self.shares.iter().zip(weights) {
            let (bounds, range) = (&mut bounds[share.new as usize], &ranges[share.old as usize]);
            *bounds = [bounds[0].min(range[0]), bounds[1].max(range[1])];
            totals[share.new as usize] += weight;
        }
        // Sub-cells without old material have the bounds of all of the cell.
        for (bounds, totals) in bounds.chunks_mut(self.new.points).zip(totals.chunks(self.new.points)) {
            let all = bounds.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |all, b| [all[0].min(b[0]), all[1].max(b[1])]);
            bounds.iter_mut().zip(totals).filter(|(_, total)| !(**total > 0.0)).for_each(|(bounds, _)| *bounds = all);
        }
        for bounds in &mut bounds {
            let wider = WIDER * (bounds[1] - bounds[0]) + 1e-14 * bounds[0].abs().max(bounds[1].abs());
            *bounds = [(bounds[0] - wider).max(limits[0]), (bounds[1] + wider).min(limits[1])];
        }
        let mut found = self.limited(weights, density, &means, &slopes, &bounds, &totals);
        self.to_points(&mut found, &bounds, &totals);
        found
    }

    /// Slope of least squares over the sub-cells that share a vertex, with the weights 1/d².
    fn slope(&self, means: &[f64], e: usize) -> Point {
        let ([mut xx, mut xy, mut yy], mut right) = ([0.0; 3], [0.0; 2]);
        for &n in self.near(e) {
            let arm = minus(self.centres[n as usize], self.centres[e]);
            let square = dot(arm, arm);
            if square > 0.0 {
                xx += arm[0] * arm[0] / square;
                xy += arm[0] * arm[1] / square;
                yy += arm[1] * arm[1] / square;
                let rise = (means[n as usize] - means[e]) / square;
                right = [right[0] + arm[0] * rise, right[1] + arm[1] * rise];
            }
        }
        let determinant = xx * yy - xy * xy;
        if determinant > 1e-9 * (xx + yy) * (xx + yy) {
            [(yy * right[0] - xy * right[1]) / determinant, (xx * right[1] - xy * right[0]) / determinant]
        } else {
            [0.0; 2]
        }
    }

    fn near(&self, e: usize) -> &[u32] {
        &self.neighbours[self.starts[e] as usize..self.starts[e + 1] as usize]
    }

    /// Of each old sub-cell the range of values of its own and its neighbours' points, and what its slope
    /// makes up to the outline.
    fn ranges(&self, values: &[f64], means: &[f64], slopes: &[Point]) -> Vec<[f64; 2]> {
        let mut ranges: Vec<[f64; 2]> = (0..values.len())
            .map(|e| {
                let own = [values[e].min(means[e]), values[e].max(means[e])];
                self.near(e).iter().fold(own, |range, &n| [range[0].min(values[n as usize]), range[1].max(values[n as usize])])
            })
            .collect();
        for &(e, place) in &self.outer {
            let e = e as usize;
            let arm = minus(place, self.centres[e]);
            let own = dot(slopes[e], arm);
            let least = self.near(e).iter().fold(own.abs(), |least, &n| {
                let other = dot(slopes[n as usize], arm);
                if other * own > 0.0 { least.min(other.abs()) } else { 0.0 }
            });
            let beyond = means[e] + BEYOND * if own > 0.0 { least } else { -least };
            ranges[e] = [ranges[e][0].min(beyond), ranges[e][1].max(beyond)];
        }
        ranges
    }

    /// Means over new sub-cells within their bounds: slopes of the old sub-cells that make a value leave them
    /// are lessened, in the last rounds to nothing.
    fn limited(
        &self,
        weights: &[f64],
        density: &impl Fn(u32) -> f64,
        means: &[f64],
        slopes: &[Point],
        bounds: &[[f64; 2]],
        totals: &[f64],
    ) -> Vec<f64> {
        let flat = self.constant(weights, means);
        let rises: Vec<f64> = self
            .shares
            .iter()
            .map(|share| {
                let total = totals[share.new as usize];
                if total > 0.0 { density(share.old) * dot(slopes[share.old as usize], share.moment) / total } else { 0.0 }
            })
            .collect();
        let mut parts = vec![1.0; means.len()];
        let mut round = 0;
        loop {
            let mut found = flat.clone();
            for (share, rise) in self.shares.iter().zip(&rises) {
                found[share.new as usize] += parts[share.old as usize] * rise;
            }
            let mut is_less = false;
            let before = parts.clone();
            for share in &self.shares {
                let (new, old) = (share.new as usize, share.old as usize);
                let [low, high] = bounds[new];
                if before[old] > 0.0 && !(found[new] >= low && found[new] <= high) {
                    let room = if found[new] > high { high - flat[new] } else { low - flat[new] };
                    let part = (room / (found[new] - flat[new])).clamp(0.0, 1.0);
                    // A little less than just enough, or rounding would make a round of its own.
                    let less = if round < ROUNDS { before[old] * (1.0 - 1e-9) * part } else { 0.0 };
                    parts[old] = f64::min(parts[old], less);
                    is_less = true;
                }
            }
            if !is_less {
                return found;
            }
            round += 1;
        }
    }

    /// From means over sub-cells to values of points with the same mean over the cell; their differences are
    /// lessened where one leaves the bounds of the cell.
    fn to_points(&self, found: &mut [f64], bounds: &[[f64; 2]], totals: &[f64]) {
        for (cell, quarters) in self.new.quarters.iter().enumerate() {
            let Some(quarters) = quarters else { continue };
            let (means, totals, bounds) = (&mut found[4 * cell..4 * cell + 4], &totals[4 * cell..], &bounds[4 * cell..]);
            let mut values = [0.0; 4];
            times(&quarters.values, means, &mut values);
            let mean = average(means, totals);
            let shift = mean - average(&values, &quarters.volumes);
            let (low, high) =
                (0..4).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), k| (bounds[k][0].min(low), bounds[k][1].max(high)));
            let mut part: f64 = 1.0;
            for value in &mut values {
                *value += shift;
                let room = if *value > high { high - mean } else { low - mean };
                if !(*value >= low && *value <= high) {
                    part = part.min((room / (*value - mean)).clamp(0.0, 1.0));
                }
            }
            for (place, value) in means.iter_mut().zip(values) {
                *place = if part < 1.0 { mean + part * (value - mean) } else { value };
            }
        }
    }
}

fn times(matrix: &[[f64; 4]; 4], from: &[f64], to: &mut [f64]) {
    for (place, row) in to.iter_mut().zip(matrix) {
        *place = row.iter().zip(from).fold(0.0, |sum, (entry, value)| sum + entry * value);
    }
}

/// Σ w φ / Σ w of the four first.
fn average(values: &[f64], weights: &[f64]) -> f64 {
    let sums = values.iter().zip(weights).take(4).fold([0.0; 2], |sums, (value, weight)| [sums[0] + weight * value, sums[1] + weight]);
    sums[0] / sums[1]
}

/// Weights of quarters as those of points: the cell's by the points' volumes.
fn by_points(of: &SubCells, weights: &mut [f64]) {
    for (weights, quarters) in weights.chunks_mut(4).zip(&of.quarters) {
        if let Some(quarters) = quarters {
            let part = weights.iter().sum::<f64>() / quarters.volumes.iter().sum::<f64>();
            weights.iter_mut().zip(&quarters.volumes).for_each(|(weight, volume)| *weight = part * volume);
        }
    }
}

/// Shares by new and old sub-cell, one for each pair.
fn merged(mut shares: Vec<Share>) -> Vec<Share> {
    shares.sort_by_key(|share| (share.new, share.old));
    let mut found: Vec<Share> = Vec::with_capacity(shares.len());
    for share in shares {
        match found.last_mut() {
            Some(last) if (last.new, last.old) == (share.new, share.old) => {
                last.volume += share.volume;
                (0..2).for_each(|k| last.moment[k] += share.moment[k]);
            }
            _ => found.push(share),
        }
    }
    found
}

/// Sub-cells that share a vertex with each, without itself, ascending.
fn neighbours(of: &SubCells) -> (Vec<u32>, Vec<u32>) {
    let mut cells: Vec<Vec<u32>> = vec![Vec::new(); of.positions.len()];
    for (index, cell) in of.cells.iter().enumerate() {
        crate::plane::corners(cell).iter().for_each(|&node| cells[node as usize].push(index as u32));
    }
    let (mut starts, mut found, mut near) = (vec![0], Vec::new(), Vec::new());
    for (index, cell) in of.cells.iter().enumerate() {
        near.clear();
        crate::plane::corners(cell).iter().for_each(|&node| near.extend_from_slice(&cells[node as usize]));
        near.sort_unstable();
        near.dedup();
        found.extend(near.iter().copied().filter(|&n| n as usize != index));
        starts.push(found.len() as u32);
    }
    (starts, found)
}

/// Sub-cells with each of their vertices on the outline.
fn outer(of: &SubCells) -> Vec<(u32, Point)> {
    let mut is_outer = vec![false; of.positions.len()];
    boundary(&of.cells).iter().for_each(|edge| edge.nodes.iter().for_each(|&node| is_outer[node as usize] = true));
    let mut found = Vec::new();
    for (index, cell) in of.cells.iter().enumerate() {
        let on = crate::plane::corners(cell).iter().filter(|&&node| is_outer[node as usize]);
        found.extend(on.map(|&node| (index as u32, of.positions[node as usize])));
    }
    found
}
