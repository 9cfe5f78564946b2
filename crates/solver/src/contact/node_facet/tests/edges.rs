//! Edges against edges: bars that cross, momenta, energy, what slides from edge to edge, what leaves it to
//! the nodes, and the search against all pairs.

use super::*;
use crate::contact::projection::edge_edge::distance;
use proptest::prelude::*;

const R: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A bar along x (or turned by a quarter about z along y) of square cross section, on edge: turned by 45
/// degrees about its axis; its middle is at `middle`.
fn bar(cells: usize, along: usize, middle: Vector) -> Blocks {
    bar_of(3.0, cells, along, middle)
}

/// The same of any length.
fn bar_of(length: f64, cells: usize, along: usize, middle: Vector) -> Blocks {
    let mut bar = grid([-0.5 * length, -0.1, -0.1], [length / cells as f64, 0.2, 0.2], [cells, 1, 1], |_| true);
    for x in &mut bar.positions {
        let [a, b, c] = *x;
        let (b, c) = (R * (b - c), R * (b + c));
        let turned = if along == 0 { [a, b, c] } else { [-b, a, c] };
        *x = [0, 1, 2].map(|d| turned[d] + middle[d]);
    }
    bar
}

fn bars(edges: bool, friction: f64, stiffness: f64) -> Recipe {
    Recipe { held: false, bond: 4e3, stiffness, friction, dt: 4e-3, passes: BOTH, edges }
}

/// Height of the first body's middle above the second one's.
fn height(world: &World, first: usize) -> f64 {
    let mean = |nodes: &[Vector]| nodes.iter().map(|x| x[2]).sum::<f64>() / nodes.len() as f64;
    mean(&world.positions[..first]) - mean(&world.positions[first..])
}

#[test]
fn bars_that_cross_on_edge_come_back_and_go_through_each_other_with_nodes_alone() {
    // Off the middle of both, so that they turn.
    let upper = bar(5, 0, [0.37, 0.11, 0.3]);
    let lower = bar(5, 1, [0.0; 3]);
    let first = upper.positions.len();
    for (friction, stiffness) in [(0.0, 2e2), (0.0, 2e3), (0.0, 2e4), (0.3, 2e3)] {
        for edges in [true, false] {
            let mut world = world([&upper, &lower], bars(edges, friction, stiffness), [0.2, 0.1, -1.0]);
            let scale = world.mass.iter().sum::<f64>();
            let (begin, mut energies, mut deepest) = (world.momenta(), Vec::new(), 0.0f64);
            let above = height(&world, first);
            for _ in 0..300 {
                let reported = world.step();
                energies.push(reported.energy);
                deepest = deepest.max(reported.penetration);
                for (a, b) in world.momenta().iter().flatten().zip(begin.iter().flatten()) {
                    assert!((a - b).abs() < 1e-13 * scale, "{friction} {stiffness}: {:?} {begin:?}", world.momenta());
                }
            }
            let worst = energies.iter().map(|energy| (energy / energies[0] - 1.0).abs()).fold(0.0, f64::max);
            let now = height(&world, first);
            println!("{edges} {friction} {stiffness}: height {above} {now}, deepest {deepest}, energy off by {worst}");
            if edges {
                assert!(deepest > 1e-4 && now > 0.9 * above, "{friction} {stiffness}: {deepest} {now}");
                assert!(worst < 5e-3, "{friction} {stiffness}: {worst}");
                assert!(friction == 0.0 || world.lost > 0.0);
            } else {
                assert!(now < 0.0, "nodes alone do not see it: {now}");
            }
        }
    }
}

#[test]
fn a_bar_on_edge_is_held_by_a_flat_one_that_is_narrower_than_its_elements() {
    // The ridge of the upper bar comes down on the face of the lower one, between the nodes of both; and the
    // other way round.
    for turned in [false, true] {
        for friction in [0.0, 0.3] {
            let flat = grid([-0.1, -1.5, -0.1], [0.2, 0.6, 0.2], [1, 5, 1], |_| true);
            let sign = if turned { -1.0 } else { 1.0 };
            let on_edge = bar(5, 0, [0.08, 0.05, sign * (0.1 + R * 0.2 + 0.01)]);
            let bodies = if turned { [&flat, &on_edge] } else { [&on_edge, &flat] };
            let first = bodies[0].positions.len();
            let mut world = world(bodies, bars(true, friction, 2e3), [0.1, 0.0, -1.0]);
            let (begin, mut energies, mut deepest) = (world.momenta(), Vec::new(), 0.0f64);
            let scale = world.mass.iter().sum::<f64>();
            for _ in 0..300 {
                let reported = world.step();
                energies.push(reported.energy);
                deepest = deepest.max(reported.penetration);
            }
            for (a, b) in world.momenta().iter().flatten().zip(begin.iter().flatten()) {
                assert!((a - b).abs() < 1e-13 * scale, "{turned} {friction}: {:?} {begin:?}", world.momenta());
            }
            let worst = energies.iter().map(|energy| (energy / energies[0] - 1.0).abs()).fold(0.0, f64::max);
            println!("{turned} {friction}: height {}, deepest {deepest}, energy off by {worst}", height(&world, first));
            assert!(height(&world, first) > 0.3 && deepest < 0.06 && deepest > 1e-3, "{turned} {friction}: {deepest}");
            assert!(worst < 5e-3, "{turned} {friction}: {worst}");
        }
    }
}

#[test]
fn bars_that_cross_come_back_wherever_their_nodes_are() {
    // Short ones, that bend little.
    for (count, cells) in [(0, 3), (1, 2), (2, 4), (0, 1)] {
        let (mut upper, lower) = (bar_of(0.6, cells, 0, [0.0, 0.0, 0.3]), bar_of(0.6, cells, 1, [0.0; 3]));
        // With an even number of cells node meets node.
        upper.positions.iter_mut().for_each(|x| x[0] += [0.0, 0.0, 1e-3][count]);
        let first = upper.positions.len();
        for (speed, bond, stiffness, dt) in [(1.0, 4e3, 2e3, 4e-3), (15.0, 4e5, 1e5, 4e-4), (40.0, 4e6, 1e6, 1.2e-4)] {
            let recipe = Recipe { dt, bond, ..bars(true, 0.0, stiffness) };
            let mut world = world([&upper, &lower], recipe, [0.0, 0.0, -speed]);
            let mut energies = Vec::new();
            for _ in 0..150 {
                energies.push(world.step().energy);
            }
            let worst = energies.iter().map(|energy| (energy / energies[0] - 1.0).abs()).fold(0.0, f64::max);
            println!("{cells} {speed}: {} energy off by {worst}", height(&world, first));
            assert!(height(&world, first) > 0.3, "{cells} {speed}: {}", height(&world, first));
            assert!(worst < 0.01, "{cells} {speed}: {worst}");
        }
    }
}

#[test]
fn what_slides_along_edges_goes_from_edge_to_edge_with_its_energy() {
    // A rigidly held bar below, and one above that is pulled down and slides along it over its nodes, and
    // over its own.
    let (upper, lower) = (bar(9, 0, [-0.9, -0.8, 2.0 * R * 0.2 + 0.01]), bar(12, 1, [0.0; 3]));
    let first = upper.positions.len();
    let recipe = Recipe { held: true, dt: 2e-3, ..bars(true, 0.0, 2e3) };
    let mut world = world([&upper, &lower], recipe, [0.9, 0.8, 0.0]);
    // Towards a point far below: a weight.
    world.pull = (0.01, [0.0, 0.0, -30.0]);
    let (mut begin, mut worst, mut springs) = (None, 0.0f64, 0);
    for _ in 0..800 {
        let reported = world.step();
        let energy = reported.energy - *begin.get_or_insert(reported.energy);
        worst = worst.max(energy.abs());
        springs += usize::from(reported.penetration > 0.0);
    }
    let kinetic = 0.5 * world.mass[..first].iter().sum::<f64>() * (0.9f64.powi(2) + 0.8f64.powi(2));
    println!("{} of {kinetic}: in contact in {springs} steps, height {}", worst, height(&world, first));
    assert!(springs > 100 && height(&world, first) > 0.2, "{springs} {}", height(&world, first));
    assert!(worst < 0.01 * kinetic, "{worst} of {kinetic}");
}

fn formulation(bodies: [&Blocks; 2]) -> (NodeFacet, Vec<Vector>) {
    let first = bodies[0].positions.len();
    let positions = [&bodies[0].positions[..], &bodies[1].positions[..]].concat();
    let surfaces = vec![bodies[0].surface(0), bodies[1].surface(first as u32)];
    let of: Vec<u32> = (0..positions.len()).map(|k| u32::from(k >= first)).collect();
    let inputs = surfaces.iter().map(|surface| PassInput {
        slaves: vec![Slave { stiffness: 1.0, area: 1.0, of_mass: 0.0 }; surface.nodes.len()],
        ..PassInput::default()
    });
    let inputs = inputs.collect();
    let search = || (search::registry::<3>()[0].make)();
    let tracker = Tracker::new(surfaces, BOTH, &of, search(), &positions);
    (NodeFacet::new(tracker, inputs, &model::Interface::default(), 0.0, &positions).with_edges(search()), positions)
}

fn detect(formulation: &mut NodeFacet, old: &[Vector], new: &[Vector]) -> Springs<3> {
    let mut springs = Springs::<3>::new(new.len(), 0, vec![terms(0.0)]);
    formulation.detect(&Scene { sweep: Sweep::between(old, new), bodies: &Bodies::default(), time: 0.0 }, &mut springs);
    springs.close_group(0);
    springs
}

#[test]
fn faces_that_lie_on_each_other_leave_their_edges_to_the_nodes() {
    // Blocks that end flush, overhang, and cross; upright and tilted by a few degrees.
    for shift in [[0.0, 0.0], [0.37, 0.21], [-0.7, 0.4]] {
        for tilt in [0.0, 0.03, -0.05] {
            let lower = grid([0.0; 3], [0.5; 3], [3, 3, 1], |_| true);
            let low = 0.499 - 0.5 * f64::abs(tilt);
            let mut upper = grid([shift[0], shift[1], low], [0.4, 0.45, 0.4], [3, 3, 1], |_| true);
            upper.positions.iter_mut().for_each(|x| x[2] += tilt * (x[0] - shift[0] - 0.4));
            let (mut formulation, positions) = formulation([&upper, &lower]);
            let springs = detect(&mut formulation, &positions, &positions);
            assert!(formulation.edges().unwrap().candidates() > 0);
            assert!(formulation.edges().unwrap().touches().is_empty(), "{shift:?} {tilt}");
            assert!(springs.list.iter().any(|spring| spring.gap < 0.0), "{shift:?} {tilt}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn the_search_of_edges_finds_what_a_look_at_all_pairs_finds(
        shift in prop::array::uniform3(-0.6..0.6_f64), size in prop::array::uniform3(0.02..0.5_f64), shake in prop::collection::vec(-0.05..0.05_f64, 3 * 48),
    ) {
        let lower = grid([0.0; 3], [0.3, 0.4, 0.2], [3, 2, 2], |at| at != [1, 1, 1]);
        let mut upper = grid(shift, size, [2, 2, 2], |at| at != [0, 1, 0]);
        for (x, by) in upper.positions.iter_mut().zip(shake.chunks(3)) {
            (0..3).for_each(|d| x[d] += size[d] * by[d]);
        }
        let (mut formulation, positions) = formulation([&upper, &lower]);
        detect(&mut formulation, &positions, &positions);
        let surfaces = formulation.tracker().surfaces().to_vec();
        let placed = [0, 1].map(|of: usize| Placed { surface: &surfaces[of], positions: &positions });
        let [radius, _] = formulation.tracker().reach();
        let ridges = [0, 1].map(|of: usize| -> Vec<u32> {
            (0..surfaces[of].edges.len() as u32).filter(|&edge| placed[of].ridge(edge).is_some_and(|ridge| ridge.may_be_sharp())).collect()
        });
        let near = |&[a, b]: &[u32; 2]| distance(placed[0].edge(a), placed[1].edge(b)) <= radius;
        let expected: Vec<[u32; 2]> = ridges[0].iter().flat_map(|&a| ridges[1].iter().map(move |&b| [a, b])).filter(near).collect();
        let found: Vec<[u32; 2]> = formulation.edges().unwrap().pairs().collect();
        prop_assert_eq!(found, expected);
    }
}
