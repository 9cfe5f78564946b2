//! Values of the integration points of a new mesh from those of the old one, when what their sub-cells have
//! in common is known: the same in 2D and 3D.
//!
//! Means over sub-cells go to new sub-cells by φ_k = Σ w (φ_e + g_e·(x − x_e)) / Σ w, with the slopes g_e of
//! least squares over the sub-cells that share a vertex. Where a new value is outside the range of the old
//! sub-cells it overlaps and their neighbours, the slopes that it has come from are lessened, so that the
//! integral is kept whatever the slopes are.
//!
//! A sub-cell at the outline may pass the range of its neighbours by what its slope makes up to the outline,
//! if all neighbours slope the same way: half as much again as the smallest slope of them gives.
//!
//! Sources: Barth & Jespersen, AIAA 89-0366 (the range); Clain, Diot & Loubère, J. Comput. Phys. 230 (2011)
//! 4028-4050 (limiting afterwards).

use crate::transfer::{Failure, Order, Values};

/// What an old and a new sub-cell have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Share<const D: usize> {
    pub(crate) old: u32,
    pub(crate) new: u32,
    /// m³ (per metre of depth in 2D).
    pub(crate) volume: f64,
    /// ∫ (x − x_e) dV about the old sub-cell's centre.
    pub(crate) moment: [f64; D],
}

/// What the values of a cell's points say about means over its sub-cells, one for each point.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    /// Means over sub-cells from values of points, by rows.
    means: Vec<f64>,
    /// Values of points from means over sub-cells.
    values: Vec<f64>,
    /// Volume that each point stands for, m³.
    volumes: Vec<f64>,
}

impl Rule {
    /// From means over sub-cells by values of points. `None` if these do not follow from the means, or a
    /// volume is not positive.
    pub(crate) fn of<const N: usize>(means: &[[f64; N]; N], volumes: &[f64; N]) -> Option<Self> {
        let values = inverse(means)?;
        let flat = |matrix: &[[f64; N]; N]| matrix.iter().flatten().copied().collect();
        let is_positive = volumes.iter().all(|&volume| volume > 0.0);
        is_positive.then(|| Self { means: flat(means), values: flat(&values), volumes: volumes.to_vec() })
    }
}

/// The inverse by elimination with the largest pivots; `None` if there is none.
fn inverse<const N: usize>(of: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut a = *of;
    let mut b: [[f64; N]; N] = std::array::from_fn(|row| std::array::from_fn(|column| f64::from(u8::from(row == column))));
    for k in 0..N {
        let pivot = (k + 1..N).fold(k, |best, row| if a[row][k].abs() > a[best][k].abs() { row } else { best });
        a.swap(k, pivot);
        b.swap(k, pivot);
        if !(a[k][k].abs() > 1e-6) {
            return None;
        }
        let scale = a[k][k];
        for column in 0..N {
            a[k][column] /= scale;
            b[k][column] /= scale;
        }
        for row in (0..N).filter(|&row| row != k) {
            let factor = a[row][k];
            for column in 0..N {
                a[row][column] -= factor * a[k][column];
                b[row][column] -= factor * b[k][column];
            }
        }
    }
    Some(b)
}

/// The sub-cells of a mesh: those of a cell follow one another.
#[derive(Debug, Default)]
pub(crate) struct Layout {
    /// Of each cell the first sub-cell; one more at the end.
    pub(crate) starts: Vec<u32>,
    /// Of each sub-cell its cell.
    pub(crate) parents: Vec<u32>,
    /// Of each cell; `None` where values of points are taken as means.
    pub(crate) rules: Vec<Option<Rule>>,
}

impl Layout {
    /// Cells with so many sub-cells each.
    pub(crate) fn new(counts: impl Iterator<Item = usize>, rules: Vec<Option<Rule>>) -> Self {
        let mut all = Self { starts: vec![0], parents: Vec::new(), rules };
        for (cell, count) in counts.enumerate() {
            all.parents.extend(std::iter::repeat_n(cell as u32, count));
            all.starts.push(all.parents.len() as u32);
        }
        all
    }

    /// Number of sub-cells.
    pub(crate) fn len(&self) -> usize {
        self.parents.len()
    }

    fn cells(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        self.starts.windows(2).map(|pair| pair[0] as usize..pair[1] as usize)
    }

    /// Cells whose points are not their sub-cells.
    fn ruled(&self) -> impl Iterator<Item = (std::ops::Range<usize>, &Rule)> {
        self.cells().zip(&self.rules).filter_map(|(range, rule)| rule.as_ref().map(|rule| (range, rule)))
    }
}

/// The overlaps of the sub-cells of two meshes.
#[derive(Debug)]
pub(crate) struct Map<const D: usize> {
    pub(crate) old: Layout,
    pub(crate) new: Layout,
    /// By new and old sub-cell, one for each pair.
    pub(crate) shares: Vec<Share<D>>,
    /// Centres of the old sub-cells, m.
    pub(crate) centres: Vec<[f64; D]>,
    /// Their volumes, m³.
    pub(crate) volumes: Vec<f64>,
    /// Old sub-cells that share a vertex with each: of each the first, one more at the end.
    pub(crate) starts: Vec<u32>,
    pub(crate) neighbours: Vec<u32>,
    /// Old sub-cells at the outline with a vertex on it.
    pub(crate) outer: Vec<(u32, [f64; D])>,
    /// Solves the normal equations of a slope; zero if they are singular.
    pub(crate) solve: fn([[f64; D]; D], [f64; D]) -> [f64; D],
}

/// Rounds in which slopes are lessened just enough; after them they are set to zero.
const ROUNDS: usize = 3;
/// A range is widened by this part of itself.
const WIDER: f64 = 1e-3;
/// What a slope may make up to the outline, by what the smallest slope near would.
const BEYOND: f64 = 1.5;

impl<const D: usize> Map<D> {
    /// Weights of points in which the integral is kept; see `PointMap::weights`.
    pub(crate) fn weights(&self, densities: Option<&[f64]>, order: Order) -> Result<[Vec<f64>; 2], Failure> {
        let density = self.densities(densities)?;
        let mut weights = vec![0.0; self.new.len()];
        for share in &self.shares {
            weights[share.new as usize] += density(share.old) * share.volume;
        }
        let mut old: Vec<f64> = (0..self.old.len()).map(|e| density(e as u32) * self.volumes[e]).collect();
        if order == Order::Linear {
            by_points(&self.old, &mut old);
            by_points(&self.new, &mut weights);
        }
        Ok([old, weights])
    }

    fn densities<'a>(&'a self, densities: Option<&'a [f64]>) -> Result<impl Fn(u32) -> f64 + use<'a, D>, Failure> {
        if densities.is_some_and(|all| all.len() + 1 != self.old.starts.len()) {
            return Err(Failure::Size);
        }
        match densities.and_then(|all| all.iter().position(|&density| !(density > 0.0 && density.is_finite()))) {
            Some(cell) => Err(Failure::Massless { cell }),
            None => Ok(move |e: u32| densities.map_or(1.0, |all| all[self.old.parents[e as usize] as usize])),
        }
    }

    /// The values of the new mesh's points; see `PointMap::values`.
    pub(crate) fn values(&self, of: &Values<'_>) -> Result<Vec<f64>, Failure> {
        let density = self.densities(of.densities)?;
        if of.values.len() != self.old.len() * of.width || of.limits.is_some_and(|limits| limits.len() != of.width) {
            return Err(Failure::Size);
        }
        if !of.values.iter().all(|value| value.is_finite()) {
            return Err(Failure::Number);
        }
        let weights: Vec<f64> = self.shares.iter().map(|share| density(share.old) * share.volume).collect();
        let mut result = vec![0.0; self.new.len() * of.width];
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
        let (mut sums, mut totals) = (vec![0.0; self.new.len()], vec![0.0; self.new.len()]);
        for (share, weight) in self.shares.iter().zip(weights) {
            sums[share.new as usize] += weight * values[share.old as usize];
            totals[share.new as usize] += weight;
        }
        for range in self.new.cells() {
            let (sums, totals) = (&mut sums[range.clone()], &totals[range]);
            let mean = sums.iter().sum::<f64>() / totals.iter().sum::<f64>();
            sums.iter_mut().zip(totals).for_each(|(sum, &total)| *sum = if total > 0.0 { *sum / total } else { mean });
        }
        sums
    }

    fn linear(&self, weights: &[f64], density: &impl Fn(u32) -> f64, values: &[f64], limits: [f64; 2]) -> Vec<f64> {
        let mut means = values.to_vec();
        for (range, rule) in self.old.ruled() {
            times(&rule.means, &values[range.clone()], &mut means[range]);
        }
        let slopes: Vec<[f64; D]> = (0..means.len()).map(|e| self.slope(&means, e)).collect();
        let ranges = self.ranges(values, &means, &slopes);
        let mut bounds = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.new.len()];
        let mut totals = vec![0.0; self.new.len()];
        for (share, weight) in self.shares.iter().zip(weights) {
            let (bounds, range) = (&mut bounds[share.new as usize], &ranges[share.old as usize]);
            *bounds = [bounds[0].min(range[0]), bounds[1].max(range[1])];
            totals[share.new as usize] += weight;
        }
        // Sub-cells without old material have the bounds of all of the cell.
        for range in self.new.cells() {
            let (bounds, totals) = (&mut bounds[range.clone()], &totals[range]);
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
    fn slope(&self, means: &[f64], e: usize) -> [f64; D] {
        let (mut matrix, mut right) = ([[0.0; D]; D], [0.0; D]);
        for &n in self.near(e) {
            let arm = minus(&self.centres[n as usize], &self.centres[e]);
            let square = dot(&arm, &arm);
            if square > 0.0 {
                for i in 0..D {
                    (i..D).for_each(|j| matrix[i][j] += arm[i] * arm[j] / square);
                }
                let rise = (means[n as usize] - means[e]) / square;
                (0..D).for_each(|i| right[i] += arm[i] * rise);
            }
        }
        (self.solve)(matrix, right)
    }

    fn near(&self, e: usize) -> &[u32] {
        &self.neighbours[self.starts[e] as usize..self.starts[e + 1] as usize]
    }

    /// Of each old sub-cell the range of values of its own and its neighbours' points, and what its slope
    /// makes up to the outline.
    fn ranges(&self, values: &[f64], means: &[f64], slopes: &[[f64; D]]) -> Vec<[f64; 2]> {
        let mut ranges: Vec<[f64; 2]> = (0..values.len())
            .map(|e| {
                let own = [values[e].min(means[e]), values[e].max(means[e])];
                self.near(e).iter().fold(own, |range, &n| [range[0].min(values[n as usize]), range[1].max(values[n as usize])])
            })
            .collect();
        for (e, place) in &self.outer {
            let e = *e as usize;
            let arm = minus(place, &self.centres[e]);
            let own = dot(&slopes[e], &arm);
            let least = self.near(e).iter().fold(own.abs(), |least, &n| {
                let other = dot(&slopes[n as usize], &arm);
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
        slopes: &[[f64; D]],
        bounds: &[[f64; 2]],
        totals: &[f64],
    ) -> Vec<f64> {
        let flat = self.constant(weights, means);
        let rises: Vec<f64> = self
            .shares
            .iter()
            .map(|share| {
                let total = totals[share.new as usize];
                if total > 0.0 { density(share.old) * dot(&slopes[share.old as usize], &share.moment) / total } else { 0.0 }
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
        let mut values = Vec::new();
        for (range, rule) in self.new.ruled() {
            let (means, totals, bounds) = (&mut found[range.clone()], &totals[range.clone()], &bounds[range]);
            values.clear();
            values.resize(means.len(), 0.0);
            times(&rule.values, means, &mut values);
            let mean = average(means, totals);
            let shift = mean - average(&values, &rule.volumes);
            let (low, high) = bounds.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), b| (b[0].min(low), b[1].max(high)));
            let mut part: f64 = 1.0;
            for value in &mut values {
                *value += shift;
                let room = if *value > high { high - mean } else { low - mean };
                if !(*value >= low && *value <= high) {
                    part = part.min((room / (*value - mean)).clamp(0.0, 1.0));
                }
            }
            for (place, value) in means.iter_mut().zip(&values) {
                *place = if part < 1.0 { mean + part * (value - mean) } else { *value };
            }
        }
    }
}

fn minus<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (1..D).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

fn times(matrix: &[f64], from: &[f64], to: &mut [f64]) {
    for (place, row) in to.iter_mut().zip(matrix.chunks(from.len())) {
        *place = row.iter().zip(from).fold(0.0, |sum, (entry, value)| sum + entry * value);
    }
}

/// Σ w φ / Σ w.
fn average(values: &[f64], weights: &[f64]) -> f64 {
    let sums = values.iter().zip(weights).fold([0.0; 2], |sums, (value, weight)| [sums[0] + weight * value, sums[1] + weight]);
    sums[0] / sums[1]
}

/// Weights of sub-cells as those of points: the cell's by the points' volumes.
fn by_points(of: &Layout, weights: &mut [f64]) {
    for (range, rule) in of.ruled() {
        let weights = &mut weights[range];
        let part = weights.iter().sum::<f64>() / rule.volumes.iter().sum::<f64>();
        weights.iter_mut().zip(&rule.volumes).for_each(|(weight, volume)| *weight = part * volume);
    }
}

/// Shares by new and old sub-cell, one for each pair.
pub(crate) fn merged<const D: usize>(mut shares: Vec<Share<D>>) -> Vec<Share<D>> {
    shares.sort_by_key(|share| (share.new, share.old));
    let mut found: Vec<Share<D>> = Vec::with_capacity(shares.len());
    for share in shares {
        match found.last_mut() {
            Some(last) if (last.new, last.old) == (share.new, share.old) => {
                last.volume += share.volume;
                (0..D).for_each(|k| last.moment[k] += share.moment[k]);
            }
            _ => found.push(share),
        }
    }
    found
}

/// Sub-cells that share a vertex with each, without itself, ascending: of each the first, one more at the
/// end; and all of them.
pub(crate) fn neighbours<'a>(cells: impl Iterator<Item = &'a [u32]> + Clone, nodes: usize) -> (Vec<u32>, Vec<u32>) {
    let mut of_node: Vec<Vec<u32>> = vec![Vec::new(); nodes];
    for (index, cell) in cells.clone().enumerate() {
        cell.iter().for_each(|&node| of_node[node as usize].push(index as u32));
    }
    let (mut starts, mut found, mut near) = (vec![0], Vec::new(), Vec::new());
    for (index, cell) in cells.enumerate() {
        near.clear();
        cell.iter().for_each(|&node| near.extend_from_slice(&of_node[node as usize]));
        near.sort_unstable();
        near.dedup();
        found.extend(near.iter().copied().filter(|&n| n as usize != index));
        starts.push(found.len() as u32);
    }
    (starts, found)
}
