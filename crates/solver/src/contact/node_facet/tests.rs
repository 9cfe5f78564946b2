mod edges;

use super::*;
use crate::bench::Random;
use crate::contact::law::penalty::Penalty;
use crate::contact::search;
use crate::contact::slaves::Slave;
use crate::contact::springs::friction::Friction;
use crate::contact::springs::{NodeResponse, NodeResponses, Tangential, Terms, Update};
use crate::contact::traces::Traces;
use crate::contact::{Contact, ContactKind, Sweep};
use crate::contact_forces::ContactForces;
use crate::mesh::cell::CellKind;
use crate::mesh::surface::{SpaceSurface, Surface};
use crate::rigid::Bodies;
use crate::tensor::cross;
use embate_lanes::Level;

/// Nodes with masses (infinite: held) and springs between them, and a contact.
struct World {
    mass: Vec<f64>,
    positions: Vec<Vector>,
    velocities: Vec<Vector>,
    /// Nodes, length and stiffness.
    links: Vec<(usize, usize, f64, f64)>,
    /// Stiffness of a spring of each node that is not held to a point.
    pull: (f64, Vector),
    dt: f64,
    contact: Contact<3>,
    springs: Springs<3>,
    bodies: Bodies<3>,
    traces: Traces<3>,
    lost: f64,
}

impl NodeResponses<3> for (&[f64], &[Vector], &[Vector], f64) {
    fn count(&self) -> usize {
        self.0.len()
    }
    fn leader(&self, node: u32) -> (u32, Option<[[f64; 3]; 3]>) {
        (node, None)
    }
    fn response(&self, node: usize) -> NodeResponse<3> {
        let give = self.3 / self.0[node];
        NodeResponse { velocity_old: self.1[node], velocity: self.2[node], mobility: [give, 0.0, 0.0, give, 0.0, give] }
    }
}

/// What a step reported.
#[derive(Clone, Copy, Debug)]
struct Told {
    /// Kinetic, of links and pull, of contact and its friction, J; all at n.
    energy: f64,
    resultant: Vector,
    penetration: f64,
}

impl World {
    fn step(&mut self) -> Told {
        let at = self.positions.clone();
        let old: Vec<Vector> = (0..at.len()).map(|k| [0, 1, 2].map(|d| at[k][d] - self.dt * self.velocities[k][d])).collect();
        let before = self.velocities.clone();
        let mut potential = 0.0;
        let mut free = self.velocities.clone();
        let dt = self.dt;
        for &(a, b, length, k) in &self.links {
            let along = [0, 1, 2].map(|d| at[b][d] - at[a][d]);
            let size = dot(along, along).sqrt();
            potential += 0.5 * k * (size - length).powi(2);
            for d in 0..3 {
                let force = k * (size - length) * along[d] / size;
                free[a][d] += dt * force / self.mass[a];
                free[b][d] -= dt * force / self.mass[b];
            }
        }
        for (k, v) in free.iter_mut().enumerate().filter(|(k, _)| self.mass[*k].is_finite()) {
            for d in 0..3 {
                let off = at[k][d] - self.pull.1[d];
                potential += 0.5 * self.pull.0 * off * off;
                v[d] -= dt * self.pull.0 * off / self.mass[k];
            }
        }
        self.springs.clear();
        self.contact.detect(&Scene { sweep: Sweep::between(&old, &at), bodies: &self.bodies, time: 0.0 }, &mut self.springs);
        let nodes = (&self.mass[..], &before[..], &free[..], dt);
        self.springs.solve(&Update { time_steps: [dt; 2], positions: &at, nodes: &nodes, bodies: &self.bodies, level: Level::best() });
        let mut forces = ContactForces::new(at.len());
        self.contact.collect(&self.springs, &mut forces, &mut self.bodies, &mut self.traces, dt);
        let totals = self.contact.totals;
        for (k, v) in free.iter_mut().enumerate() {
            (0..3).for_each(|d| v[d] += dt * forces.of(k)[d] / self.mass[k]);
        }
        let kinetic = |k: usize| if self.mass[k].is_finite() { 0.5 * self.mass[k] * dot(before[k], free[k]) } else { 0.0 };
        let energy = (0..at.len()).map(kinetic).sum::<f64>() + potential + totals.energy + self.lost + 0.5 * totals.lost.old[0];
        self.lost += totals.lost.friction;
        self.velocities = free;
        for (x, v) in self.positions.iter_mut().zip(&self.velocities) {
            (0..3).for_each(|d| x[d] += dt * v[d]);
        }
        Told { energy, resultant: totals.resultant, penetration: self.contact.penetration }
    }

    fn momenta(&self) -> [Vector; 2] {
        let mut sums = [[0.0; 3]; 2];
        for k in 0..self.mass.len() {
            let p = self.velocities[k].map(|v| self.mass[k] * v);
            let moment = cross(self.positions[k], p);
            (0..3).for_each(|d| (sums[0][d], sums[1][d]) = (sums[0][d] + p[d], sums[1][d] + moment[d]));
        }
        sums
    }
}

/// Hexahedra of a grid whose corner is at `corner` and whose cells have the edges `size`.
#[derive(Clone)]
struct Blocks {
    cells: Vec<Vec<u32>>,
    positions: Vec<Vector>,
}

fn grid(corner: Vector, size: Vector, [nx, ny, nz]: [usize; 3], is_there: impl Fn([usize; 3]) -> bool) -> Blocks {
    let node = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let places = (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k])));
    let positions = places.map(|at| [0, 1, 2].map(|d| corner[d] + size[d] * at[d] as f64)).collect();
    let mut cells = Vec::new();
    for (k, j, i) in (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| (k, j, i)))) {
        if is_there([i, j, k]) {
            let square = |k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
            cells.push([square(k), square(k + 1)].concat());
        }
    }
    Blocks { cells, positions }
}

impl Blocks {
    fn surface(&self, first: u32) -> SpaceSurface {
        let cells: Vec<Vec<u32>> = self.cells.iter().map(|cell| cell.iter().map(|node| node + first).collect()).collect();
        Surface::<3>::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap()
    }

    /// Springs between all nodes of each cell.
    fn links(&self, first: usize, stiffness: f64) -> Vec<(usize, usize, f64, f64)> {
        let mut pairs: Vec<(usize, usize)> = Vec::new();
        for cell in &self.cells {
            pairs.extend(
                (0..8)
                    .flat_map(|a| (0..a).map(move |b| (a, b)))
                    .map(|(a, b)| (cell[a].min(cell[b]) as usize, cell[a].max(cell[b]) as usize)),
            );
        }
        pairs.sort_unstable();
        pairs.dedup();
        let length = |a: usize, b: usize| {
            let along = [0, 1, 2].map(|d| self.positions[b][d] - self.positions[a][d]);
            dot(along, along).sqrt()
        };
        pairs.into_iter().map(|(a, b)| (a + first, b + first, length(a, b), stiffness)).collect()
    }
}

/// How a world is made.
#[derive(Clone, Copy)]
struct Recipe {
    /// Whether the second body is held, and the first one is in one piece.
    held: bool,
    /// Stiffness of the springs within bodies; zero: nodes are free.
    bond: f64,
    /// Stiffness of contact springs of each slave, N/m.
    stiffness: f64,
    friction: f64,
    dt: f64,
    passes: &'static [(usize, usize)],
    /// Whether edges meet too.
    edges: bool,
}

fn terms(friction: f64) -> Terms {
    let law = Friction { coefficient: friction, dynamic: friction, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    Terms { law: Box::new(Penalty), tangential: if friction > 0.0 { Tangential::Friction(law) } else { Tangential::Free }, damping: 0.0 }
}

/// A first and a second body; the first moves with `velocity` and spins.
fn world(bodies: [&Blocks; 2], recipe: Recipe, velocity: Vector) -> World {
    let Recipe { held, bond, stiffness, friction, dt, passes, edges } = recipe;
    let first = bodies[0].positions.len();
    let positions = [&bodies[0].positions[..], &bodies[1].positions[..]].concat();
    let surfaces = vec![bodies[0].surface(0), bodies[1].surface(first as u32)];
    let of: Vec<u32> = (0..positions.len()).map(|k| u32::from(k >= first)).collect();
    let slaves = |&(slave, _): &(usize, usize)| PassInput {
        slaves: vec![Slave { stiffness, area: 1.0, of_mass: 0.0 }; surfaces[slave].nodes.len()],
        ..PassInput::default()
    };
    let inputs = passes.iter().map(slaves).collect();
    let search = (search::registry::<3>()[0].make)();
    let tracker = Tracker::new(surfaces, passes, &of, search, &positions);
    let sliding = model::Friction { coefficient: friction, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    let interface = model::Interface { friction: (friction > 0.0).then_some(sliding), ..model::Interface::default() };
    let formulation = NodeFacet::new(tracker, inputs, &interface, 0.0, &positions);
    let formulation = if edges { formulation.with_edges((search::registry::<3>()[0].make)()) } else { formulation };
    let contact =
        Contact::new("contact".into(), ContactKind::Contact, Box::new(formulation), 0, crate::model::Window::between([0.0, f64::INFINITY]));
    let links = if bond > 0.0 {
        let mut links = bodies[0].links(0, bond);
        links.extend(if held { Vec::new() } else { bodies[1].links(first, bond) });
        links
    } else {
        Vec::new()
    };
    World {
        mass: (0..positions.len()).map(|k| if held && k >= first { f64::INFINITY } else { 1.0 + 0.1 * (k % 3) as f64 }).collect(),
        velocities: (0..positions.len()).map(|k| if k < first { velocity } else { [0.0; 3] }).collect(),
        springs: Springs::new(positions.len(), 0, vec![terms(friction)]),
        positions,
        links,
        pull: (0.0, [0.0; 3]),
        dt,
        contact,
        bodies: Bodies::default(),
        traces: Traces::default(),
        lost: 0.0,
    }
}

const ONE: &[(usize, usize)] = &[(0, 1)];
const BOTH: &[(usize, usize)] = &[(0, 1), (1, 0)];

fn free_nodes(stiffness: f64) -> Recipe {
    Recipe { held: true, bond: 0.0, stiffness, friction: 0.0, dt: 0.01, passes: ONE, edges: false }
}

#[test]
fn nodes_that_fly_at_a_box_come_back_from_all_its_faces_edges_and_corners_with_their_energy() {
    let target = grid([-1.0; 3], [1.0; 3], [2; 3], |_| true);
    // k dt² / m
    for ratio in [0.1, 1.0, 10.0, 100.0] {
        for direction in 0..27i32 {
            let from = [direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1].map(f64::from);
            let faces = from.iter().filter(|c| **c != 0.0).count() == 1;
            // Springs that turn a node back within a step lose some 7 % of its energy at an edge: what they
            // meet is not resolved.
            if from == [0.0; 3] || (!faces && ratio > 1.0) {
                continue;
            }
            // Eight nodes about a place out there, all on their way to the middle of the box.
            let size = dot(from, from).sqrt();
            let corner = from.map(|c| 1.3 * c - 0.02);
            let slaves = grid(corner, [0.041, 0.039, 0.043], [1; 3], |_| true);
            let mut world = world([&slaves, &target], free_nodes(ratio * 1e4), from.map(|c| -1.0 / size * c));
            let begin = world.velocities.clone();
            let mut touched = false;
            for _ in 0..160 {
                let reported = world.step();
                touched |= reported.penetration > 0.0;
            }
            assert!(touched, "{from:?}");
            for k in 0..8 {
                let energy = dot(world.velocities[k], world.velocities[k]) / dot(begin[k], begin[k]);
                let outside = world.positions[k].iter().any(|c| c.abs() > 1.0);
                // What meets an edge or a corner turns about it while it is inside, within a step or two:
                // half steps see chords of that.
                let allowed = if faces { 1e-9 } else { 0.05 };
                assert!((energy - 1.0).abs() < allowed && outside, "{ratio} {from:?}: {energy} {:?}", world.positions[k]);
                assert!(!faces || dot(world.velocities[k], from) > 1.0 - 1e-9, "{ratio} {from:?}: {:?}", world.velocities[k]);
            }
        }
    }
}

#[test]
fn a_node_that_slides_around_a_box_over_edges_and_corners_keeps_its_energy() {
    let target = grid([-0.5; 3], [0.5; 3], [2; 3], |_| true);
    let slaves = grid([0.1, 0.05, 0.515], [0.02, 0.03, 0.01], [1; 3], |_| true);
    let mut world = world([&slaves, &target], Recipe { dt: 2e-3, ..free_nodes(2e3) }, [1.7, 1.1, 0.0]);
    world.pull = (2.0, [0.0; 3]);
    let (mut begin, mut worst, mut sides) = (None, 0.0f64, [false; 6]);
    for _ in 0..6000 {
        let reported = world.step();
        let energy = *begin.get_or_insert(reported.energy);
        worst = worst.max((reported.energy / energy - 1.0).abs());
        for spring in world.springs.list.iter().filter(|spring| spring.gap < 0.0) {
            for d in 0..3 {
                sides[2 * d] |= spring.normal[d] > 0.95;
                sides[2 * d + 1] |= spring.normal[d] < -0.95;
            }
        }
    }
    assert!(worst < 0.01 && sides.iter().filter(|side| **side).count() >= 4, "{worst} {sides:?}");
}

#[test]
fn nodes_on_a_symmetry_plane_that_fly_through_a_plate_in_one_step_are_seen_at_its_border() {
    // The plate rises from x = 0, the symmetry plane, so that its border there is nearest from below; y = 0
    // is another one.
    let slope = 0.3;
    for y in [0.0, 0.1, 0.33, 0.5] {
        let mut plate = grid([0.0; 3], [0.5, 0.5, 0.1], [2, 2, 1], |_| true);
        plate.positions.iter_mut().for_each(|x| x[2] += slope * x[0]);
        let slaves = grid([0.0, y, 0.3], [0.02, 0.03, 0.01], [1; 3], |_| true);
        let first = slaves.positions.len();
        let before = [&slaves.positions[..], &plate.positions[..]].concat();
        let cells: Vec<Vec<u32>> = plate.cells.iter().map(|cell| cell.iter().map(|node| node + first as u32).collect()).collect();
        let on = |nodes: &[u32], d: usize| nodes.iter().all(|&node| before[node as usize][d] == 0.0);
        let target =
            Surface::<3>::outside_without(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell)), |facet| on(&facet, 0) || on(&facet, 1))
                .unwrap();
        let axis = |d: usize| [0, 1, 2].map(|e| if d == e { 1.0 } else { 0.0 });
        let target = target.with_mirrors(|edge| (0..2).filter(|&d| on(&edge, d)).map(axis).collect::<Vec<_>>(), &before);
        let of: Vec<u32> = (0..before.len()).map(|k| u32::from(k >= first)).collect();
        let search = (search::registry::<3>()[0].make)();
        let mut tracker = Tracker::new(vec![slaves.surface(0), target], ONE, &of, search, &before);
        let mut after = before.clone();
        after[..first].iter_mut().for_each(|x| x[2] -= 0.9);
        tracker.track(Sweep::between(&before, &before), 0.0);
        let touches = tracker.track(Sweep::between(&before, &after), 0.0).to_vec();
        assert_eq!(touches.len(), 8, "slope {slope}, y = {y}: {touches:?}");
        // The lower side of the slaves, which faces the plate.
        for touch in touches.iter().filter(|touch| touch.node < 4 && before[touch.node as usize][0] == 0.0) {
            let depth = 0.1 - after[touch.node as usize][2];
            let Projection { gap, normal, .. } = touch.projection;
            assert!((gap + depth).abs() < 1e-12 && (normal[2] - 1.0).abs() < 1e-12, "slope {slope}, y = {y}: {touch:?}");
        }
    }
}

#[test]
fn two_blocks_that_collide_keep_momentum_and_angular_momentum_to_round_off_and_their_energy() {
    let lower = grid([0.0; 3], [0.5; 3], [3, 3, 1], |_| true);
    let upper = grid([0.13, 0.21, 0.53], [0.31, 0.37, 0.4], [3, 2, 2], |at| at != [2, 1, 0]);
    for (friction, bond, stiffness) in [(0.0, 1e3, 1e3), (0.3, 1e3, 1e3), (0.0, 1e3, 1e5), (2.0, 1e3, 1e4)] {
        let recipe = Recipe { held: false, bond, stiffness, friction, dt: 4e-3, passes: BOTH, edges: true };
        let mut world = world([&upper, &lower], recipe, [0.4, -0.3, -1.5]);
        let scale = world.mass.iter().sum::<f64>();
        let (begin, mut energies) = (world.momenta(), Vec::new());
        let mut deepest = 0.0f64;
        for _ in 0..400 {
            let reported = world.step();
            energies.push(reported.energy);
            deepest = deepest.max(reported.penetration);
            let now = world.momenta();
            for (a, b) in now.iter().flatten().zip(begin.iter().flatten()) {
                assert!((a - b).abs() < 1e-13 * scale, "{friction} {stiffness}: {now:?} {begin:?}");
            }
        }
        let worst = energies.iter().map(|energy| (energy / energies[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(deepest > 1e-4 && world.contact.has_pressed, "they meet: {deepest}");
        assert!(worst < 0.02, "{friction} {stiffness}: {worst}");
        assert!(friction == 0.0 || world.lost > 0.0);
    }
}

#[test]
fn two_blocks_with_like_meshes_that_are_pressed_carry_the_pressure_of_their_depth() {
    let lower = grid([0.0; 3], [0.5; 3], [2, 2, 1], |_| true);
    let upper = grid([0.0, 0.0, 0.499], [0.5; 3], [2, 2, 1], |_| true);
    let surfaces = vec![upper.surface(0), lower.surface(upper.positions.len() as u32)];
    let positions = [&upper.positions[..], &lower.positions[..]].concat();
    let modulus = 3e4;
    let areas = |surface: &SpaceSurface| {
        let mut areas = vec![0.0; surface.nodes.len()];
        for &facet in &surface.facets {
            for (node, share) in
                crate::mesh::surface::tributary::shares::<3>(crate::mesh::surface::tributary::Depth::Plane, facet, &positions)
            {
                // Of the sides that meet only.
                let flat = facet.iter().all(|&node| (positions[node as usize][2] - 0.5).abs() < 0.01);
                areas[surface.nodes.binary_search(&node).unwrap()] += if flat { share } else { 0.0 };
            }
        }
        areas
    };
    let of: Vec<u32> = (0..positions.len()).map(|k| u32::from(k >= upper.positions.len())).collect();
    let inputs = (0..2).map(|side| PassInput {
        slaves: areas(&surfaces[side])
            .iter()
            .map(|area| Slave { stiffness: 0.5 * modulus * area, area: 0.5 * area, of_mass: 0.0 })
            .collect(),
        per_modulus: areas(&surfaces[side]).iter().map(|area| 0.5 * area).collect(),
        // The lower one is softer.
        moduli: vec![if side == 0 { 0.5 * modulus } else { modulus }; surfaces[1 - side].facets.len()],
        ..PassInput::default()
    });
    let inputs = inputs.collect();
    let tracker = Tracker::new(surfaces.clone(), BOTH, &of, (search::registry::<3>()[0].make)(), &positions);
    let mut formulation = NodeFacet::new(tracker, inputs, &model::Interface::default(), 0.0, &positions);
    let mut springs = Springs::<3>::new(positions.len(), 0, vec![terms(0.0)]);
    let bodies = Bodies::default();
    formulation.detect(&Scene { sweep: Sweep::between(&positions, &positions), bodies: &bodies, time: 0.0 }, &mut springs);
    let closed: Vec<_> = springs.list.iter().filter(|spring| spring.gap < -1e-4).collect();
    assert_eq!(closed.len(), 18);
    let force: Vector = closed.iter().fold([0.0; 3], |sum, spring| {
        [0, 1, 2].map(|d| sum[d] - f64::from(spring.side) * spring.stiffness * spring.gap * spring.normal[d])
    });
    // Upper nodes feel half the softer modulus, lower ones half of theirs: the first meet the lower one.
    let expected = (0.25 + 0.5) * modulus * 1e-3;
    assert!((force[2] / expected - 1.0).abs() < 1e-10 && force[0].abs() + force[1].abs() < 1e-9, "{force:?} {expected}");
}

#[test]
fn what_goes_into_a_thin_plate_comes_out_where_it_came_in_however_deep_and_fast_it_is() {
    // A plate of thickness 0.1 and cells of 0.5; nodes go 0.07 deep, and a step takes them through all of it.
    let plate = grid([-1.0, -1.0, 0.0], [0.5, 0.5, 0.1], [4, 4, 1], |_| true);
    for (speed, stiffness, dt) in [(1.0, 200.0, 0.01), (30.0, 2e4, 0.01), (80.0, 1e5, 0.01)] {
        // Some steps before it, so that its speed is known.
        let slaves = grid([0.07, 0.11, 0.13 + 3.7 * dt * speed], [0.02, 0.03, 0.005], [1; 3], |_| true);
        let mut world = world([&slaves, &plate], Recipe { dt, ..free_nodes(stiffness) }, [0.0, 0.0, -speed]);
        let mut deepest = 0.0f64;
        for _ in 0..60 {
            deepest = deepest.max(world.step().penetration);
        }
        assert!(deepest > 0.06, "{speed}: {deepest}");
        for v in &world.velocities[..8] {
            assert!((v[2] / speed - 1.0).abs() < 1e-6, "{speed}: {v:?}");
        }
    }
}

#[test]
fn a_body_does_not_meet_itself_where_it_is_whole_and_does_where_it_folds() {
    // A clamp: two jaws about a gap of 0.2, joined at one end; thin enough for the far sides to be near.
    let size = [0.4, 0.4, 0.2];
    let clamp = grid([0.0; 3], size, [4, 2, 3], |[i, _, k]| k != 1 || i == 0);
    let surface = clamp.surface(0);
    let tracker = Tracker::new(
        vec![surface.clone()],
        &[(0, 0)],
        &vec![0; clamp.positions.len()],
        (search::registry::<3>()[0].make)(),
        &clamp.positions,
    );
    let input = PassInput { slaves: vec![Slave { stiffness: 1.0, area: 1.0, of_mass: 0.0 }; surface.nodes.len()], ..PassInput::default() };
    let mut formulation = NodeFacet::new(tracker, vec![input], &model::Interface::default(), 0.0, &clamp.positions);
    let bodies = Bodies::default();
    let mut positions = clamp.positions.clone();
    // The upper jaw comes down on the lower one by bending: nodes above the gap by a way that grows with x.
    for step in 0..60 {
        let old = positions.clone();
        for (x, x0) in positions.iter_mut().zip(&clamp.positions) {
            if x0[2] > 0.35 && x0[0] > 0.5 {
                x[2] = x0[2] - 0.004 * f64::from(step) * (x0[0] - 0.4);
            }
        }
        let mut springs = Springs::<3>::new(positions.len(), 0, vec![terms(0.0)]);
        formulation.detect(&Scene { sweep: Sweep::between(&old, &positions), bodies: &bodies, time: 0.0 }, &mut springs);
        springs.close_group(0);
        let nodes = (&vec![1.0; positions.len()][..], &vec![[0.0; 3]; positions.len()][..], &vec![[0.0; 3]; positions.len()][..], 0.0);
        springs.solve(&Update { time_steps: [0.01; 2], positions: &positions, nodes: &nodes, bodies: &bodies, level: Level::best() });
        let gaps: Vec<(u32, f64)> = springs.list.iter().map(|spring| (springs.ends(spring).next().unwrap().at, spring.gap)).collect();
        for &(node, gap) in gaps.iter().filter(|(_, gap)| *gap < 0.0) {
            let x = clamp.positions[node as usize];
            assert!(x[0] > 0.5 && (x[2] == 0.2 || x[2] == 2.0 * 0.2) && gap > -0.1, "only what is at the gap meets: {x:?} {gap}");
        }
        let depth = 0.004 * f64::from(step) * 1.2 - 0.2;
        let deepest = gaps.iter().fold(0.0f64, |deepest, (_, gap)| deepest.max(-gap));
        assert!((deepest - depth.max(0.0)).abs() < 0.1 * depth.max(0.0) + 1e-9, "step {step}: {deepest} {depth}");
        formulation.remember(springs.answers(0..springs.list.len()));
    }
}

#[test]
fn who_sleeps_would_have_been_found_as_it_was() {
    let lower = grid([0.0; 3], [0.5; 3], [4, 4, 2], |[i, j, _]| i + j < 6);
    let upper = grid([0.13, 0.21, 1.03], [0.31, 0.37, 0.4], [3, 2, 2], |_| true);
    let first = lower.positions.len();
    let mut positions = [&lower.positions[..], &upper.positions[..]].concat();
    let bodies: Vec<u32> = (0..positions.len()).map(|k| u32::from(k >= first)).collect();
    let all = [lower.surface(0), upper.surface(first as u32)];
    for passes in [&[(0, 1), (1, 0)][..], &[(0, 0), (1, 1)]] {
        let make = || Tracker::new(all.to_vec(), passes, &bodies, (search::registry::<3>()[0].make)(), &positions);
        let (mut sleepy, mut awake, mut random, mut travel, mut met) = (make(), make(), Random::new(3), 0.0, 0);
        for step in 0..600 {
            // The upper one swings down and up again, sideways too, and both shake.
            let old = positions.clone();
            let swing =
                [0.02 * (0.05 * f64::from(step)).cos(), 0.013 * (0.031 * f64::from(step)).sin(), -0.02 * (0.043 * f64::from(step)).sin()];
            let mut longest = 0.0_f64;
            for (k, x) in positions.iter_mut().enumerate() {
                let by = [0, 1, 2].map(|d| 2e-4 * (random.unit() - 0.5) + if k >= first { swing[d] } else { 0.0 });
                (0..3).for_each(|d| x[d] += by[d]);
                longest = longest.max(dot(by, by).sqrt());
            }
            travel += longest;
            let sweep = Sweep { old: &old, new: &positions, travel };
            let found = sleepy.track(sweep, 0.01).to_vec();
            assert_eq!(awake.track(Sweep::between(&old, &positions), 0.01), &found[..], "step {step}");
            assert_eq!(sleepy.search_report().searches, awake.search_report().searches);
            met += found.len();
            for tracker in [&mut sleepy, &mut awake] {
                for touch in &found {
                    let Projection { normal, facet, .. } = touch.projection;
                    let kept = *tracker.kept(touch);
                    *tracker.kept_mut(touch) = ContactHistory { spring: SpringHistory { normal, ..kept.spring }, facet, ..kept };
                }
            }
        }
        assert!(passes[0].0 == passes[0].1 || met > 2000, "{met}");
    }
}

#[test]
fn what_is_kept_continues_bit_by_bit() {
    let lower = grid([0.0; 3], [0.5; 3], [3, 3, 1], |_| true);
    let upper = grid([0.13, 0.21, 0.53], [0.31, 0.37, 0.4], [3, 2, 2], |_| true);
    let recipe = Recipe { held: false, bond: 1e3, stiffness: 1e4, friction: 0.3, dt: 4e-3, passes: BOTH, edges: true };
    let make = || world([&upper, &lower], recipe, [0.4, -0.3, -1.5]);
    let mut whole = make();
    for _ in 0..40 {
        whole.step();
    }
    let mut archive = Archive::new();
    archive.section("contact").unwrap();
    whole.contact.persist(&mut archive, usize::MAX).unwrap();
    let sections = archive.finish().unwrap();
    let mut again = make();
    (again.positions, again.velocities, again.lost) = (whole.positions.clone(), whole.velocities.clone(), whole.lost);
    let mut archive = Archive::of(&sections);
    archive.section("contact").unwrap();
    again.contact.persist(&mut archive, usize::MAX).unwrap();
    archive.finish().unwrap();
    for step in 0..60 {
        let (a, b) = (whole.step(), again.step());
        assert!(whole.positions == again.positions && a.resultant == b.resultant, "step {step}: {a:?} {b:?}");
    }
}
