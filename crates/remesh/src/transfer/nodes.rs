//! Masses and velocities of the nodes of a new mesh.
//!
//! 1. Consistent masses of the corners of new cells, m_a = ∫ ρ N_a, and of momentum, p_a = ∫ ρ N_a v, over
//!    the pieces of the supermesh.
//! 2. Masses of nodes get a factor 1 + q(x), q a quadratic polynomial, so that mass, centre and second
//!    moments are those of the old nodes: then affine velocities keep momentum, angular momentum and energy.
//! 3. Velocities by the consistent mass matrix, M v = p (exact for affine fields), limited where a component
//!    leaves the bounds of the old nodes near: fluxes f_ab = M_ab (v_a − v_b) between nodes are lessened as
//!    those of Zalesak, J. Comput. Phys. 31 (1979) 335-362, only at nodes where they have to be.
//! 4. The rigid motion is replaced by that of the old nodes' momentum and angular momentum, and the rest is
//!    multiplied by s ≤ 1 such that the kinetic energy does not rise (by more than what is to spare).

use super::Failure;
use super::clip::Twin;
use super::supermesh::Supermesh;
use crate::plane::{Measure, Mesh, Point, corners, cross, dot, minus};
use crate::shared::matrix::Matrix;
use crate::shared::motion::{Component, Energies, WIDER, match_moments, moment};

/// What the nodes of the old mesh have.
#[derive(Clone, Copy, Debug)]
pub struct OldNodes<'a> {
    /// The mesh.
    pub mesh: Mesh<'a>,
    /// Mass of each corner of each cell, kg (per metre of depth in 2D); only the sum over a cell
    /// counts.
    pub corner_mass: &'a [[f64; 4]],
    /// Mass of each node, kg.
    pub node_mass: &'a [f64],
    /// Velocity of each node, m/s.
    pub velocities: &'a [Point],
    /// Kinetic energy that earlier transfers lost and this one may give back, J; 0 for none. Between meshes
    /// to and fro the energy of lumped masses goes down and up, and without it only down.
    pub spare: f64,
}

/// What is known of the nodes of the new mesh.
#[derive(Clone, Copy, Debug)]
pub struct NewNodes<'a> {
    /// The mesh.
    pub mesh: Mesh<'a>,
    /// Prescribed components of velocity (supports, lines of symmetry) of each node, m/s.
    pub held: &'a [[Option<f64>; 2]],
}

/// What the nodes of the new mesh get.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// Mass of each corner of each new cell, kg: ∫ ρ N. Their sum is that of the old cells.
    pub corner_mass: Vec<[f64; 4]>,
    /// Mass of each node, kg: the sum of its corners times 1 + q.
    pub mass: Vec<f64>,
    /// Velocity of each node, m/s.
    pub velocities: Vec<Point>,
    /// Kinetic energy of the old nodes less that of the new ones, J. Not less than −`spare` but for rounding,
    /// unless components other than zero are held.
    pub kinetic_lost: f64,
    /// Largest |q|.
    pub correction: f64,
    /// Factor s of what is not rigid motion.
    pub scale: f64,
}

/// Largest |q| for all second moments; above it those are matched that rigid motion needs.
const SMALL: f64 = 0.1;
/// Largest |q| at all.
const LARGEST: f64 = 0.5;

/// Masses and velocities of the nodes of the new mesh.
///
/// In the plane momentum and angular momentum about any point are kept, unless components are held: a
/// direction in which any node is held keeps no momentum (its supports take it), and angular momentum is kept
/// only if no component is held. In an axisymmetric body only axial momentum is.
///
/// # Errors
/// `Size`; `Number`; `Massless`; `Correction` if masses would change by more than half; `Inertia`.
pub fn nodes(supermesh: &Supermesh, old: &OldNodes<'_>, new: &NewNodes<'_>) -> Result<Nodes, Failure> {
    let count = new.mesh.positions.len();
    let is_fit = old.corner_mass.len() == old.mesh.cells.len()
        && supermesh.volumes.len() == old.mesh.cells.len()
        && supermesh.new_cells == new.mesh.cells.len()
        && old.node_mass.len() == old.mesh.positions.len()
        && old.velocities.len() == old.mesh.positions.len()
        && new.held.len() == count
        && old.mesh.cells.iter().flatten().all(|&node| (node as usize) < old.velocities.len())
        && new.mesh.cells.iter().flatten().all(|&node| (node as usize) < count);
    if !is_fit {
        return Err(Failure::Size);
    }
    let is_finite = |v: &Point| v[0].is_finite() && v[1].is_finite();
    let total = old.node_mass.iter().sum::<f64>();
    let is_massive = old.node_mass.iter().all(|&mass| mass >= 0.0) && total > 0.0 && total.is_finite() && old.spare >= 0.0;
    let has_numbers = [old.velocities, old.mesh.positions, new.mesh.positions].iter().all(|all| all.iter().all(is_finite));
    if !(is_massive && has_numbers && new.held.iter().flatten().flatten().all(|value| value.is_finite())) {
        return Err(Failure::Number);
    }
    let gathered = Gathered::new(supermesh, old, new)?;
    let frame = Frame::of(supermesh.measure, old, new);
    let (mass, correction) = frame.match_masses(old, new, &gathered.mass)?;
    let mut velocities = vec![[0.0; 2]; count];
    for k in 0..2 {
        let found = gathered.velocities(k, new.held, old.velocities);
        velocities.iter_mut().zip(found).for_each(|(velocity, found)| velocity[k] = found);
    }
    let (kinetic_lost, scale) = frame.settle(old, new, &mass, &mut velocities)?;
    Ok(Nodes { corner_mass: gathered.corner_mass, mass, velocities, kinetic_lost, correction, scale })
}

/// Sums over pieces and slivers.
struct Gathered {
    corner_mass: Vec<[f64; 4]>,
    mass: Vec<f64>,
    momentum: [Vec<f64>; 2],
    matrix: Matrix,
    /// Lowest and highest old velocities near each new node.
    bounds: Vec<[Point; 2]>,
}

impl Gathered {
    fn new(supermesh: &Supermesh, old: &OldNodes<'_>, new: &NewNodes<'_>) -> Result<Self, Failure> {
        let count = new.mesh.positions.len();
        let mut densities = Vec::with_capacity(supermesh.volumes.len());
        for (cell, (mass, volume)) in old.corner_mass.iter().zip(&supermesh.volumes).enumerate() {
            let mass = mass[0] + mass[1] + mass[2] + mass[3];
            if !(mass > 0.0 && mass.is_finite()) {
                return Err(Failure::Massless { cell });
            }
            densities.push(mass / volume);
        }
        let near: Vec<[Point; 2]> = old.mesh.cells.iter().map(|cell| hull(corners(cell), old.velocities)).collect();
        let mut all = Self {
            corner_mass: vec![[0.0; 4]; new.mesh.cells.len()],
            mass: vec![0.0; count],
            momentum: [vec![0.0; count], vec![0.0; count]],
            matrix: Matrix::of(new.mesh.cells.iter().map(corners), count),
            bounds: vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; count],
        };
        // Of each new triangle its mass matrix and momentum: its pieces follow one another.
        for same in supermesh.overlaps.chunk_by(|a, b| a.new == b.new) {
            let twin = &supermesh.new[same[0].new as usize];
            let nodes = corners(&new.mesh.cells[twin.cell as usize]);
            let (mut matrix, mut momentum) = ([[0.0; 3]; 3], [[0.0; 2]; 3]);
            for overlap in same {
                let from = &supermesh.old[overlap.old as usize];
                let density = densities[from.cell as usize];
                let velocities = at_vertices(from, old);
                for a in 0..3 {
                    for b in 0..3 {
                        matrix[a][b] += density * overlap.own[a][b];
                        let part = density * overlap.mixed[a][b];
                        (0..2).for_each(|k| momentum[a][k] += part * velocities[b][k]);
                    }
                }
                nodes.iter().for_each(|&node| widen(&mut all.bounds[node as usize], &near[from.cell as usize]));
            }
            for (i, &node) in nodes.iter().enumerate() {
                for a in 0..3 {
                    let row = twin.shape[a][i];
                    (0..2).for_each(|k| all.momentum[k][node as usize] += row * momentum[a][k]);
                    all.corner_mass[twin.cell as usize][i] += row * (matrix[a][0] + matrix[a][1] + matrix[a][2]);
                }
                for (j, &other) in nodes.iter().enumerate() {
                    let mut entry = 0.0;
                    for a in 0..3 {
                        (0..3).for_each(|b| entry += twin.shape[a][i] * twin.shape[b][j] * matrix[a][b]);
                    }
                    all.matrix.add(node, other, entry);
                }
            }
        }
        for sliver in &supermesh.slivers {
            let from = &supermesh.old[sliver.old as usize];
            let density = densities[from.cell as usize];
            let mass = density * (sliver.moments[0] + sliver.moments[1] + sliver.moments[2]);
            let shape = [1.0 - sliver.part, sliver.part];
            let velocities = at_vertices(from, old);
            for a in 0..2 {
                let node = sliver.edge.nodes[a];
                (0..2).for_each(|b| all.matrix.add(node, sliver.edge.nodes[b], mass * shape[a] * shape[b]));
                all.corner_mass[sliver.edge.cell as usize][usize::from(sliver.edge.corners[a])] += mass * shape[a];
                for k in 0..2 {
                    let sum = (0..3).fold(0.0, |sum, j| sum + sliver.moments[j] * velocities[j][k]);
                    all.momentum[k][node as usize] += density * shape[a] * sum;
                }
                widen(&mut all.bounds[node as usize], &near[from.cell as usize]);
            }
        }
        for (cell, masses) in new.mesh.cells.iter().zip(&all.corner_mass) {
            corners(cell).iter().zip(masses).for_each(|(&node, mass)| all.mass[node as usize] += mass);
        }
        Ok(all)
    }

    /// One component of the velocities before rigid motion is settled.
    fn velocities(&self, k: usize, held: &[[Option<f64>; 2]], old: &[Point]) -> Vec<f64> {
        let largest = old.iter().fold(0.0, |largest: f64, v| largest.max(v[0].abs()).max(v[1].abs()));
        let bounds: Vec<[f64; 2]> = self.bounds.iter().map(|b| [b[0][k] - WIDER * largest, b[1][k] + WIDER * largest]).collect();
        let held: Vec<Option<f64>> = held.iter().map(|held| held[k]).collect();
        Component { matrix: &self.matrix, mass: &self.mass, momentum: &self.momentum[k], held: &held, bounds: &bounds }.velocities()
    }
}

/// Velocities at the vertices of an old triangle.
fn at_vertices(twin: &Twin, old: &OldNodes<'_>) -> [Point; 3] {
    let cell = &old.mesh.cells[twin.cell as usize];
    let mut found = [[0.0; 2]; 3];
    for (velocity, shape) in found.iter_mut().zip(&twin.shape) {
        for (&node, weight) in cell.iter().zip(shape) {
            (0..2).for_each(|k| velocity[k] += weight * old.velocities[node as usize][k]);
        }
    }
    found
}

/// Lowest and highest velocities of some nodes.
fn hull(nodes: &[u32], velocities: &[Point]) -> [Point; 2] {
    let mut found = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for &node in nodes {
        widen(&mut found, &[velocities[node as usize]; 2]);
    }
    found
}

fn widen(bounds: &mut [Point; 2], by: &[Point; 2]) {
    for k in 0..2 {
        bounds[0][k] = bounds[0][k].min(by[0][k]);
        bounds[1][k] = bounds[1][k].max(by[1][k]);
    }
}

/// Where moments are taken: about the centre of the old nodes' mass.
struct Frame {
    centre: Point,
    size: f64,
    measure: Measure,
}

impl Frame {
    fn of(measure: Measure, old: &OldNodes<'_>, new: &NewNodes<'_>) -> Self {
        let total = old.node_mass.iter().sum::<f64>();
        let centre = [0, 1].map(|k| moment(old.node_mass, |a| old.mesh.positions[a][k]) / total);
        let all = old.mesh.positions.iter().chain(new.mesh.positions);
        let size = all.fold(0.0, |size: f64, &x| size.max(dot(minus(x, centre), minus(x, centre)))).sqrt();
        Self { centre, size, measure }
    }

    /// Polynomials of q at a place, and how many: all quadratic ones, or those that rigid motion needs.
    fn basis(&self, x: Point, is_full: bool) -> ([f64; 6], usize) {
        let [x, y] = minus(x, self.centre).map(|x| x / self.size);
        match (is_full, self.measure) {
            (true, _) => ([1.0, x, y, x * x, x * y, y * y], 6),
            (false, Measure::Plane) => ([1.0, x, y, x * x + y * y, 0.0, 0.0], 4),
            (false, Measure::Revolution) => ([1.0, y, 0.0, 0.0, 0.0, 0.0], 2),
        }
    }

    /// Masses of new nodes with the moments of the old ones, and the largest |q|.
    fn match_masses(&self, old: &OldNodes<'_>, new: &NewNodes<'_>, consistent: &[f64]) -> Result<(Vec<f64>, f64), Failure> {
        let mut largest = 0.0;
        for (is_full, limit) in [(true, SMALL), (false, LARGEST)] {
            let count = self.basis(self.centre, is_full).1;
            let bases: Vec<[f64; 6]> = new.mesh.positions.iter().map(|&x| self.basis(x, is_full).0).collect();
            let mut wanted = [0.0; 6];
            for (&x, mass) in old.mesh.positions.iter().zip(old.node_mass) {
                let basis = self.basis(x, is_full).0;
                (0..count).for_each(|i| wanted[i] += mass * basis[i]);
            }
            let (q, most) = match_moments(consistent, &bases, &wanted, count);
            largest = most;
            if largest <= limit {
                return Ok((consistent.iter().zip(&q).map(|(mass, q)| mass * (1.0 + q)).collect(), largest));
            }
        }
        Err(Failure::Correction(largest))
    }

    /// Gives the velocities the momenta of the old nodes and no more than their kinetic energy. Returns the
    /// energy lost and the factor of what is not rigid motion.
    fn settle(&self, old: &OldNodes<'_>, new: &NewNodes<'_>, mass: &[f64], velocities: &mut [Point]) -> Result<(f64, f64), Failure> {
        let is_held = [0, 1].map(|k| new.held.iter().any(|held| held[k].is_some()));
        let moves = [0, 1].map(|k| !is_held[k] && (k == 1 || self.measure == Measure::Plane));
        let turns = moves[0] && moves[1];
        let total = mass.iter().sum::<f64>();
        let centre = [0, 1].map(|k| moment(mass, |a| new.mesh.positions[a][k] - self.centre[k]) / total);
        let arms: Vec<Point> = new.mesh.positions.iter().map(|&x| minus(minus(x, self.centre), centre)).collect();
        let inertia = moment(mass, |a| dot(arms[a], arms[a]));
        // Momentum of the old nodes, and angular momentum about the new centre.
        let momentum = [0, 1].map(|k| moment(old.node_mass, |i| old.velocities[i][k]));
        let arm = |i: usize| minus(minus(old.mesh.positions[i], self.centre), centre);
        let angular = moment(old.node_mass, |i| cross(arm(i), old.velocities[i]));
        let shift = [0, 1].map(|k| if moves[k] { momentum[k] / total } else { 0.0 });
        let turn = if turns && inertia > 0.0 { angular / inertia } else { 0.0 };
        // Twice, for what rounding leaves of a small rest in a fast motion.
        for _ in 0..2 {
            let mean = [0, 1].map(|k| if moves[k] { moment(mass, |a| velocities[a][k]) / total } else { 0.0 });
            let spin = if turns && inertia > 0.0 { moment(mass, |a| cross(arms[a], velocities[a])) / inertia } else { 0.0 };
            for (velocity, arm) in velocities.iter_mut().zip(&arms) {
                *velocity = [velocity[0] - mean[0] + spin * arm[1], velocity[1] - mean[1] - spin * arm[0]];
            }
        }
        let before = kinetic(old.node_mass, |i| old.velocities[i]);
        let rigid = |a: usize| [shift[0] - turn * arms[a][1], shift[1] + turn * arms[a][0]];
        let value = |a: usize, k: usize| new.held[a][k].unwrap_or(0.0);
        let of_free = |a: usize| [0, 1].map(|k| if new.held[a][k].is_none() { velocities[a][k] } else { 0.0 });
        let (of_rest, of_rigid) = (kinetic(mass, of_free), kinetic(mass, rigid));
        let of_held = kinetic(mass, |a| [value(a, 0), value(a, 1)]);
        let energies = Energies { before, spare: old.spare, rigid: of_rigid, rest: of_rest, held: of_held };
        let scale = energies.scale().ok_or(Failure::Inertia)?;
        for (a, velocity) in velocities.iter_mut().enumerate() {
            let rigid = rigid(a);
            *velocity = [0, 1].map(|k| new.held[a][k].unwrap_or(rigid[k] + scale * velocity[k]));
        }
        Ok((before - kinetic(mass, |a| velocities[a]), scale))
    }
}

fn kinetic(mass: &[f64], of: impl Fn(usize) -> Point) -> f64 {
    0.5 * moment(mass, |a| dot(of(a), of(a)))
}
