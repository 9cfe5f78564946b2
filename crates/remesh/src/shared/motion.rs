//! Masses and velocities of nodes from the sums over pieces of two meshes: steps that are the same in 2D and
//! 3D.

use super::matrix::{Matrix, eliminate};

/// Bounds of velocities are widened by this part of the largest one, or rounding would end uniform motion.
pub(crate) const WIDER: f64 = 1e-12;
/// Rounds in which more nodes may be limited; after them all are.
const ROUNDS: usize = 20;

/// Σ m of(a).
pub(crate) fn moment(mass: &[f64], of: impl Fn(usize) -> f64) -> f64 {
    mass.iter().enumerate().fold(0.0, |sum, (a, mass)| sum + mass * of(a))
}

/// One component of the equations M v = p of the nodes' velocities.
pub(crate) struct Component<'a> {
    /// M, kg.
    pub(crate) matrix: &'a Matrix,
    /// Sums of the rows of M, kg.
    pub(crate) mass: &'a [f64],
    /// p, kg m/s.
    pub(crate) momentum: &'a [f64],
    /// Prescribed velocities, m/s.
    pub(crate) held: &'a [Option<f64>],
    /// Lowest and highest velocity of each node, m/s.
    pub(crate) bounds: &'a [[f64; 2]],
}

impl Component<'_> {
    /// The solution within its bounds: of second order where it keeps them, else p/m and as much of the
    /// difference as the bounds admit.
    pub(crate) fn velocities(&self) -> Vec<f64> {
        let count = self.mass.len();
        let free: Vec<bool> = self.held.iter().map(Option::is_none).collect();
        // First order, but within bounds.
        let low: Vec<f64> = (0..count).map(|a| if self.mass[a] > 0.0 { self.momentum[a] / self.mass[a] } else { 0.0 }).collect();
        let mut high: Vec<f64> = (0..count).map(|a| self.held[a].unwrap_or(low[a])).collect();
        self.matrix.solve(self.momentum, &free, &mut high);
        self.limit(&free, &low, &high)
    }

    /// The solution, with fluxes lessened where it leaves its bounds.
    fn limit(&self, free: &[bool], low: &[f64], high: &[f64]) -> Vec<f64> {
        let count = low.len();
        let mut found = high.to_vec();
        let is_out = |a: usize, value: f64| free[a] && self.mass[a] > 0.0 && !(value >= self.bounds[a][0] && value <= self.bounds[a][1]);
        // Parts of the fluxes into and out of a node that it can bear.
        let mut parts = vec![[1.0; 2]; count];
        let mut is_limited = vec![false; count];
        for round in 0..=ROUNDS {
            let mut is_more = false;
            for a in 0..count {
                let is_due = free[a] && self.mass[a] > 0.0 && (round == ROUNDS || is_out(a, found[a]));
                if is_due && !is_limited[a] {
                    let (mut gain, mut loss) = (0.0, 0.0);
                    for (b, value) in self.matrix.row(a) {
                        let flux = value * (high[a] - high[b]);
                        gain += flux.max(0.0);
                        loss += (-flux).max(0.0);
                    }
                    let room = [low[a] - self.bounds[a][0], self.bounds[a][1] - low[a]].map(|room| self.mass[a] * room.max(0.0));
                    parts[a] = [if loss > room[0] { room[0] / loss } else { 1.0 }, if gain > room[1] { room[1] / gain } else { 1.0 }];
                    (is_limited[a], is_more) = (true, true);
                }
            }
            if !is_more {
                break;
            }
            for a in (0..count).filter(|&a| free[a] && self.mass[a] > 0.0) {
                // Fluxes that are not lessened need no sum: the solution less what is missing.
                let missing = self.matrix.row(a).fold(0.0, |sum, (b, value)| {
                    let flux = value * (high[a] - high[b]);
                    let part: f64 = if flux > 0.0 { parts[a][1].min(parts[b][0]) } else { parts[a][0].min(parts[b][1]) };
                    sum + (1.0 - part) * flux
                });
                found[a] = high[a] - missing / self.mass[a];
            }
        }
        found
    }
}

/// Changes q of masses m such that Σ m (1 + q) B is what is wanted of the first `count` functions B, q a
/// combination of them; and the largest |q|.
pub(crate) fn match_moments<const N: usize>(mass: &[f64], bases: &[[f64; N]], wanted: &[f64; N], count: usize) -> (Vec<f64>, f64) {
    let mut matrix = [[0.0; N]; N];
    for (basis, mass) in bases.iter().zip(mass) {
        for i in 0..count {
            (0..count).for_each(|j| matrix[i][j] += mass * basis[i] * basis[j]);
        }
    }
    let mut coefficients = [0.0; N];
    let q = |a: usize, coefficients: &[f64; N]| (0..count).fold(0.0, |sum, i| sum + coefficients[i] * bases[a][i]);
    // Again for what rounding left.
    for _ in 0..3 {
        let mut rest = *wanted;
        for (a, mass) in mass.iter().enumerate() {
            let mass = mass * (1.0 + q(a, &coefficients));
            (0..count).for_each(|i| rest[i] -= mass * bases[a][i]);
        }
        let more = eliminate(matrix, rest, count);
        (0..count).for_each(|i| coefficients[i] += more[i]);
    }
    let found: Vec<f64> = (0..mass.len()).map(|a| q(a, &coefficients)).collect();
    let largest = (0..mass.len()).filter(|&a| mass[a] > 0.0).fold(0.0, |most: f64, a| most.max(found[a].abs()));
    (found, largest)
}

/// Kinetic energies, J.
pub(crate) struct Energies {
    /// Of the old nodes.
    pub(crate) before: f64,
    /// What may be added to it.
    pub(crate) spare: f64,
    /// Of the rigid motion of the new nodes.
    pub(crate) rigid: f64,
    /// Of the rest of their motion.
    pub(crate) rest: f64,
    /// Of their prescribed components.
    pub(crate) held: f64,
}

impl Energies {
    /// The factor of what is not rigid motion that keeps the energy from rising; `None` if there is none.
    pub(crate) fn scale(&self) -> Option<f64> {
        let room = self.before + self.spare - self.rigid - self.held;
        if self.rest <= room || self.rest <= 1e-28 * self.before {
            Some(1.0)
        } else if self.held > 0.0 {
            Some((room.max(0.25 * self.rest) / self.rest).sqrt())
        } else if room < -1e-12 * self.before {
            None
        } else {
            Some((room.max(0.0) / self.rest).sqrt())
        }
    }
}
