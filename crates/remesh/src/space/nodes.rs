//! Masses and velocities of the nodes of a new mesh, as in 2D:
//!
//! 1. Consistent masses m_a = ∫ ρ N_a and momenta p_a = ∫ ρ N_a v over the pieces.
//! 2. Masses of nodes get a factor 1 + q(x), q a quadratic polynomial, so that mass, centre and the six
//!    second moments are those of the old nodes: then affine velocities keep momentum, angular momentum and
//!    energy. In 3D rigid motion needs all of them. Where |q| would be too large, second moments change as
//!    far as it may.
//! 3. Velocities by the consistent mass matrix, M v = p, limited where a component leaves the bounds of the
//!    old nodes near: fluxes M_ab (v_a − v_b) between nodes are lessened as those of Zalesak, J. Comput.
//!    Phys. 31 (1979) 335-362.
//! 4. The rigid motion is replaced by that of the old nodes' momentum and angular momentum, and the rest is
//!    multiplied by s ≤ 1 such that the kinetic energy does not rise (by more than what is to spare).

use super::boundary::slivers;
use super::clip::Tet;
use super::cut::{Cut, Local, Plan};
use super::kind::MOST;
use super::tets::{Search, Tets, local};
use super::vector::{cross, dot, minus};
use super::{Failure, Mesh, Point, Side};
use crate::shared::matrix::{Matrix, eliminate};
use crate::shared::motion::{Component, Energies, WIDER, match_moments, moment};
use crate::shared::uncovered;

/// What the nodes of the old mesh have.
#[derive(Clone, Copy, Debug)]
pub struct OldNodes<'a> {
    /// The mesh.
    pub mesh: Mesh<'a>,
    /// Mass of each cell, kg.
    pub cell_mass: &'a [f64],
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
    /// Prescribed components of velocity (supports, planes of symmetry) of each node, m/s.
    pub held: &'a [[Option<f64>; 3]],
}

/// What the nodes of the new mesh get.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// Mass of each new cell, kg: ∫ ρ dV. Their sum is that of the old cells.
    pub cell_mass: Vec<f64>,
    /// Mass of each node, kg: ∫ ρ N dV times 1 + q.
    pub mass: Vec<f64>,
    /// Velocity of each node, m/s.
    pub velocities: Vec<Point>,
    /// Kinetic energy of the old nodes less that of the new ones, J. Not less than −`spare` but for rounding,
    /// unless components other than zero are held.
    pub kinetic_lost: f64,
    /// Largest |q|.
    pub correction: f64,
    /// Part of the difference of the second moments that q makes up: 1, or less where |q| is at its limit.
    pub matched: f64,
    /// Factor s of what is not rigid motion.
    pub scale: f64,
    /// Volume of old material outside the new mesh, and of the new mesh without old material, m³.
    pub mismatch: [f64; 2],
    /// Number of pieces.
    pub pieces: usize,
}

/// Largest |q|.
const LARGEST: f64 = 0.75;

/// Masses and velocities of the nodes of the new mesh.
///
/// Momentum and angular momentum about any point are kept, unless components are held: a direction in which
/// any node is held keeps no momentum (its supports take it), and angular momentum is kept about axes for
/// which the two components across are not held.
///
/// # Errors
/// `Size`; `Number`; `Inverted`; `Massless`; `Uncovered` if less than half of a new cell has old material;
/// `Overlap`; `Correction` if masses would change by more than three quarters to keep mass and centre;
/// `Inertia` if rigid motion would gain energy because second moments are not matched.
pub fn nodes(old: &OldNodes<'_>, new: &NewNodes<'_>) -> Result<Nodes, Failure> {
    check(old, new)?;
    let plans = Plan::all(Cut::Cells);
    let tets = Tets::of(&plans, old.mesh)?;
    let gathered = Gathered::new(&plans, &tets, old, new.mesh)?;
    let frame = Frame::of(old, new);
    let (mass, correction, matched) = frame.match_masses(old, new, &gathered.mass)?;
    let mut velocities = vec![[0.0; 3]; new.mesh.positions.len()];
    let largest = old.velocities.iter().flatten().fold(0.0, |largest: f64, v| largest.max(v.abs()));
    for k in 0..3 {
        let bounds: Vec<[f64; 2]> = gathered.bounds.iter().map(|b| [b[0][k] - WIDER * largest, b[1][k] + WIDER * largest]).collect();
        let held: Vec<Option<f64>> = new.held.iter().map(|held| held[k]).collect();
        let momentum = &gathered.momentum[k];
        let found = Component { matrix: &gathered.matrix, mass: &gathered.mass, momentum, held: &held, bounds: &bounds }.velocities();
        velocities.iter_mut().zip(found).for_each(|(velocity, found)| velocity[k] = found);
    }
    let (kinetic_lost, scale) = frame.settle(old, new, &mass, &mut velocities)?;
    let (cell_mass, mismatch, pieces) = (gathered.cell_mass, gathered.mismatch, gathered.pieces);
    Ok(Nodes { cell_mass, mass, velocities, kinetic_lost, correction, matched, scale, mismatch, pieces })
}

fn check(old: &OldNodes<'_>, new: &NewNodes<'_>) -> Result<(), Failure> {
    let count = old.mesh.positions.len();
    let has_nodes = |mesh: Mesh<'_>| mesh.cells.iter().all(|cell| cell.nodes().iter().all(|&node| (node as usize) < mesh.positions.len()));
    let is_fit = old.cell_mass.len() == old.mesh.cells.len()
        && old.node_mass.len() == count
        && old.velocities.len() == count
        && new.held.len() == new.mesh.positions.len()
        && new.mesh.cells.len() < u32::MAX as usize
        && has_nodes(old.mesh)
        && has_nodes(new.mesh);
    if !is_fit {
        return Err(Failure::Size);
    }
    let total = old.node_mass.iter().sum::<f64>();
    let is_massive = old.node_mass.iter().all(|&mass| mass >= 0.0) && total > 0.0 && total.is_finite() && old.spare >= 0.0;
    let is_finite = |all: &[Point]| all.iter().flatten().all(|x| x.is_finite());
    let has_numbers = [old.velocities, old.mesh.positions, new.mesh.positions].into_iter().all(is_finite);
    if !(is_massive && has_numbers && new.held.iter().flatten().flatten().all(|value| value.is_finite())) {
        return Err(Failure::Number);
    }
    match old.cell_mass.iter().position(|&mass| !(mass > 0.0 && mass.is_finite())) {
        Some(cell) => Err(Failure::Massless { cell }),
        None => Ok(()),
    }
}

/// Sums over pieces and slivers.
struct Gathered {
    cell_mass: Vec<f64>,
    mass: Vec<f64>,
    momentum: [Vec<f64>; 3],
    matrix: Matrix,
    /// Lowest and highest old velocities near each new node.
    bounds: Vec<[Point; 2]>,
    mismatch: [f64; 2],
    pieces: usize,
}

/// What a new cell gets: its mass matrix, and the momentum of its nodes.
struct OfCell {
    matrix: [[f64; MOST]; MOST],
    momentum: [Point; MOST],
}

/// What is known of the old cells.
struct OfOld {
    /// kg/m³.
    densities: Vec<f64>,
    /// Lowest and highest velocities.
    near: Vec<[Point; 2]>,
    /// At the vertices of the tetrahedra.
    velocities: Vec<Point>,
    /// Of each tetrahedron ∫ λ_j dV over its pieces.
    within: Vec<[f64; 4]>,
}

impl Gathered {
    fn new(plans: &[Plan; 4], tets: &Tets, old: &OldNodes<'_>, new: Mesh<'_>) -> Result<Self, Failure> {
        let count = new.positions.len();
        let mut volumes = vec![0.0; old.mesh.cells.len()];
        tets.all.iter().for_each(|tet| volumes[tet.cell as usize] += tet.volume);
        let mut from = OfOld {
            densities: old.cell_mass.iter().zip(&volumes).map(|(mass, volume)| mass / volume).collect(),
            near: old.mesh.cells.iter().map(|cell| hull(cell.nodes(), old.velocities)).collect(),
            velocities: tets.field(old.velocities),
            within: vec![[0.0; 4]; tets.all.len()],
        };
        let mut all = Self {
            cell_mass: vec![0.0; new.cells.len()],
            mass: vec![0.0; count],
            momentum: [0, 1, 2].map(|_| vec![0.0; count]),
            matrix: Matrix::of(new.cells.iter().map(|cell| cell.nodes()), count),
            bounds: vec![[[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]; count],
            mismatch: [0.0; 2],
            pieces: 0,
        };
        let mut search = Search::new(tets);
        let (mut covered, mut new_volumes) = (vec![0.0; new.cells.len()], Vec::with_capacity(new.cells.len()));
        for (index, cell) in new.cells.iter().enumerate() {
            let local = local(plans, new, index, Side::New)?;
            let mut of = OfCell { matrix: [[0.0; MOST]; MOST], momentum: [[0.0; 3]; MOST] };
            for tet in 0..local.volumes.len() {
                covered[index] += all.add_tet(&mut search, tets, &mut from, &local, tet, cell.nodes(), &mut of);
            }
            all.add_cell(index, cell.nodes(), &of);
            new_volumes.push(local.volumes.iter().sum());
        }
        all.mismatch[1] = uncovered(&covered, &new_volumes)?;
        all.add_slivers(plans, tets, &from, new)?;
        Ok(all)
    }

    /// Adds the pieces of a tetrahedron of a new cell; returns their volume.
    fn add_tet(
        &mut self,
        search: &mut Search<'_>,
        tets: &Tets,
        from: &mut OfOld,
        local: &Local<'_>,
        tet: usize,
        nodes: &[u32],
        of: &mut OfCell,
    ) -> f64 {
        let (mut matrix, mut momentum, mut covered) = ([[0.0; 4]; 4], [[0.0; 3]; 4], 0.0);
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        search.pieces(&Tet::new(local.tet(tet), local.volumes[tet]), |index, piece| {
            let Some(products) = piece.products() else { return };
            let old = &tets.all[index];
            let (density, velocities) = (from.densities[old.cell as usize], old.vertices.map(|vertex| from.velocities[vertex as usize]));
            for a in 0..4 {
                for b in 0..4 {
                    matrix[a][b] += density * products.own[a][b];
                    let part = density * products.mixed[a][b];
                    (0..3).for_each(|k| momentum[a][k] += part * velocities[b][k]);
                    from.within[index][b] += products.mixed[a][b];
                    covered += products.mixed[a][b];
                }
            }
            widen(&mut bounds, &from.near[old.cell as usize]);
            self.pieces += 1;
        });
        nodes.iter().for_each(|&node| widen(&mut self.bounds[node as usize], &bounds));
        let shapes = local.plan.tets[tet].map(|vertex| local.shape(vertex));
        for i in 0..nodes.len() {
            for a in 0..4 {
                let row = shapes[a][i];
                if row == 0.0 {
                    continue;
                }
                (0..3).for_each(|k| of.momentum[i][k] += row * momentum[a][k]);
                for j in 0..nodes.len() {
                    (0..4).for_each(|b| of.matrix[i][j] += row * shapes[b][j] * matrix[a][b]);
                }
            }
        }
        covered
    }

    /// Adds what a cell got to its nodes.
    fn add_cell(&mut self, cell: usize, nodes: &[u32], of: &OfCell) {
        for (i, &node) in nodes.iter().enumerate() {
            let mut mass = 0.0;
            for (j, &other) in nodes.iter().enumerate() {
                self.matrix.add(node, other, of.matrix[i][j]);
                mass += of.matrix[i][j];
            }
            self.mass[node as usize] += mass;
            self.cell_mass[cell] += mass;
            (0..3).for_each(|k| self.momentum[k][node as usize] += of.momentum[i][k]);
        }
    }

    /// Adds old material outside the new mesh to the nearest places of its outline.
    fn add_slivers(&mut self, plans: &[Plan; 4], tets: &Tets, from: &OfOld, new: Mesh<'_>) -> Result<(), Failure> {
        let (slivers, triangles) = slivers(tets, &from.within, plans, new)?;
        for sliver in &slivers {
            let (old, triangle) = (&tets.all[sliver.old as usize], &triangles[sliver.triangle as usize]);
            let (density, volume) = (from.densities[old.cell as usize], sliver.moments.iter().sum::<f64>());
            let mut momentum = [0.0; 3];
            for (&vertex, moment) in old.vertices.iter().zip(sliver.moments) {
                (0..3).for_each(|k| momentum[k] += density * moment * from.velocities[vertex as usize][k]);
            }
            let mut of = OfCell { matrix: [[0.0; MOST]; MOST], momentum: [[0.0; 3]; MOST] };
            let nodes = new.cells[triangle.cell as usize].nodes();
            let shape: [f64; MOST] = std::array::from_fn(|i| (0..3).fold(0.0, |sum, v| sum + sliver.weights[v] * triangle.shapes[v][i]));
            for i in 0..nodes.len() {
                of.momentum[i] = momentum.map(|p| shape[i] * p);
                (0..nodes.len()).for_each(|j| of.matrix[i][j] = density * volume * shape[i] * shape[j]);
                if shape[i] != 0.0 {
                    widen(&mut self.bounds[nodes[i] as usize], &from.near[old.cell as usize]);
                }
            }
            self.add_cell(triangle.cell as usize, nodes, &of);
            self.mismatch[0] += volume;
        }
        Ok(())
    }
}

/// Lowest and highest velocities of some nodes.
fn hull(nodes: &[u32], velocities: &[Point]) -> [Point; 2] {
    let mut found = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    nodes.iter().for_each(|&node| widen(&mut found, &[velocities[node as usize]; 2]));
    found
}

fn widen(bounds: &mut [Point; 2], by: &[Point; 2]) {
    for k in 0..3 {
        bounds[0][k] = bounds[0][k].min(by[0][k]);
        bounds[1][k] = bounds[1][k].max(by[1][k]);
    }
}

/// Where moments are taken: about the centre of the old nodes' mass.
struct Frame {
    centre: Point,
    size: f64,
}

impl Frame {
    fn of(old: &OldNodes<'_>, new: &NewNodes<'_>) -> Self {
        let total = old.node_mass.iter().sum::<f64>();
        let centre = [0, 1, 2].map(|k| moment(old.node_mass, |a| old.mesh.positions[a][k]) / total);
        let all = old.mesh.positions.iter().chain(new.mesh.positions);
        let size = all.fold(0.0, |size: f64, &x| size.max(dot(minus(x, centre), minus(x, centre)))).sqrt();
        Self { centre, size }
    }

    /// Polynomials of q at a place: linear ones first.
    fn basis(&self, x: Point) -> [f64; 10] {
        let [x, y, z] = minus(x, self.centre).map(|x| x / self.size);
        [1.0, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x]
    }

    /// Masses of new nodes with the moments of the old ones, the largest |q|, and the part of the second
    /// moments' difference that it makes up.
    fn match_masses(&self, old: &OldNodes<'_>, new: &NewNodes<'_>, consistent: &[f64]) -> Result<(Vec<f64>, f64, f64), Failure> {
        let bases: Vec<[f64; 10]> = new.mesh.positions.iter().map(|&x| self.basis(x)).collect();
        let mut wanted = [0.0; 10];
        for (&x, mass) in old.mesh.positions.iter().zip(old.node_mass) {
            let basis = self.basis(x);
            (0..10).for_each(|i| wanted[i] += mass * basis[i]);
        }
        let masses = |q: &[f64]| consistent.iter().zip(q).map(|(mass, q)| mass * (1.0 + q)).collect();
        let (full, most) = match_moments(consistent, &bases, &wanted, 10);
        if most <= LARGEST {
            return Ok((masses(&full), most, 1.0));
        }
        // Mass and centre, and as much of the rest as the limit admits.
        let (least, most) = match_moments(consistent, &bases, &wanted, 4);
        if !(most <= LARGEST) {
            return Err(Failure::Correction(most));
        }
        let mut part: f64 = 1.0;
        for a in (0..consistent.len()).filter(|&a| consistent[a] > 0.0) {
            let more = full[a] - least[a];
            let room = if more > 0.0 { LARGEST - least[a] } else { -LARGEST - least[a] };
            if more.abs() > room.abs() {
                part = part.min(room / more);
            }
        }
        let q: Vec<f64> = full.iter().zip(&least).map(|(full, least)| least + part * (full - least)).collect();
        Ok((masses(&q), LARGEST, part))
    }

    /// Gives the velocities the momenta of the old nodes and no more than their kinetic energy. Returns the
    /// energy lost and the factor of what is not rigid motion.
    fn settle(&self, old: &OldNodes<'_>, new: &NewNodes<'_>, mass: &[f64], velocities: &mut [Point]) -> Result<(f64, f64), Failure> {
        let rigid = Rigid::of(self, new, mass);
        let arm = |i: usize| minus(minus(old.mesh.positions[i], self.centre), rigid.centre);
        let (shift, turn) = rigid.motion(old.node_mass, arm, |i| old.velocities[i]);
        // Twice, for what rounding leaves of a small rest in a fast motion.
        for _ in 0..2 {
            let (mean, spin) = rigid.motion(mass, |a| rigid.arms[a], |a| velocities[a]);
            for (velocity, &arm) in velocities.iter_mut().zip(&rigid.arms) {
                let turning = cross(spin, arm);
                (0..3).for_each(|k| velocity[k] -= mean[k] + turning[k]);
            }
        }
        let at = |a: usize| {
            let turning = cross(turn, rigid.arms[a]);
            [shift[0] + turning[0], shift[1] + turning[1], shift[2] + turning[2]]
        };
        let of_free = |a: usize| [0, 1, 2].map(|k| if new.held[a][k].is_none() { velocities[a][k] } else { 0.0 });
        let energies = Energies {
            before: kinetic(old.node_mass, |i| old.velocities[i]),
            spare: old.spare,
            rigid: kinetic(mass, at),
            rest: kinetic(mass, of_free),
            held: kinetic(mass, |a| new.held[a].map(|value| value.unwrap_or(0.0))),
        };
        // What does not match second moments can give rigid motion more energy, though it is all there is.
        if energies.held == 0.0 && energies.rigid > (1.0 + 1e-12) * (energies.before + energies.spare) {
            return Err(Failure::Inertia);
        }
        let scale = energies.scale().ok_or(Failure::Inertia)?;
        for (a, velocity) in velocities.iter_mut().enumerate() {
            let rigid = at(a);
            *velocity = [0, 1, 2].map(|k| new.held[a][k].unwrap_or(rigid[k] + scale * velocity[k]));
        }
        Ok((energies.before - kinetic(mass, |a| velocities[a]), scale))
    }
}

/// The rigid motions of the new nodes that no support prevents.
struct Rigid {
    /// Components in which no node is held.
    moves: [bool; 3],
    /// Axes about which the body can turn: no node is held across them.
    turns: [bool; 3],
    /// kg.
    total: f64,
    /// Centre of mass from that of the old nodes, m.
    centre: Point,
    /// From the centre to each node, m.
    arms: Vec<Point>,
    /// About the centre, kg m².
    inertia: [[f64; 3]; 3],
}

impl Rigid {
    fn of(frame: &Frame, new: &NewNodes<'_>, mass: &[f64]) -> Self {
        let moves = [0, 1, 2].map(|k| !new.held.iter().any(|held| held[k].is_some()));
        let turns = [0, 1, 2].map(|k| moves[(k + 1) % 3] && moves[(k + 2) % 3]);
        let total = mass.iter().sum::<f64>();
        let x = new.mesh.positions;
        let centre = [0, 1, 2].map(|k| moment(mass, |a| x[a][k] - frame.centre[k]) / total);
        let arms: Vec<Point> = x.iter().map(|&x| minus(minus(x, frame.centre), centre)).collect();
        let mut inertia = [[0.0; 3]; 3];
        for i in (0..3).filter(|&i| turns[i]) {
            for j in (0..3).filter(|&j| turns[j]) {
                inertia[i][j] = moment(mass, |a| {
                    let arm = arms[a];
                    if i == j { dot(arm, arm) - arm[i] * arm[i] } else { -arm[i] * arm[j] }
                });
            }
        }
        Self { moves, turns, total, centre, arms, inertia }
    }

    /// Velocity of the centre and angular velocity of the rigid motion with the momenta of some masses.
    fn motion(&self, mass: &[f64], arm: impl Fn(usize) -> Point, velocity: impl Fn(usize) -> Point) -> (Point, Point) {
        let shift = [0, 1, 2].map(|k| if self.moves[k] { moment(mass, |i| velocity(i)[k]) / self.total } else { 0.0 });
        let angular = [0, 1, 2].map(|k| if self.turns[k] { moment(mass, |i| cross(arm(i), velocity(i))[k]) } else { 0.0 });
        (shift, eliminate(self.inertia, angular, 3))
    }
}

fn kinetic(mass: &[f64], of: impl Fn(usize) -> Point) -> f64 {
    0.5 * moment(mass, |a| dot(of(a), of(a)))
}
