//! No contact between solids is missed: bullets and edges that go through plates and beams are caught where
//! the contact is blind, and what sleeps is proven as by a look at all pairs.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::long::samples;
use embate_solver::contact::law::penalty::Penalty;
use embate_solver::contact::missed_contacts::MissedContactCheck;
use embate_solver::contact::node_facet::NodeFacet;
use embate_solver::contact::node_facet::tracker::{ContactPoint, Tracker};
use embate_solver::contact::projection::node_facet::{Placed, Vector};
use embate_solver::contact::projection::swept::entries;
use embate_solver::contact::search::{Pair, Query, Search, registry};
use embate_solver::contact::slaves::{PassInput, Slave};
use embate_solver::contact::springs::{Springs, Tangential, Terms};
use embate_solver::contact::tracker::Certificate;
use embate_solver::contact::{Formulation, Scene, Sweep};
use embate_solver::mesh::cell::CellKind;
use embate_solver::mesh::surface::{Corners, SpaceSurface, Surface};
use embate_solver::model::Interface;
use embate_solver::rigid::Bodies;
use proptest::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const R: f64 = std::f64::consts::FRAC_1_SQRT_2;
const BOTH: &[(usize, usize)] = &[(0, 1), (1, 0)];

/// A search that finds nothing while it is blind.
struct Eye {
    is_blind: Arc<AtomicBool>,
    search: Box<dyn Search<3>>,
}

impl Search<3> for Eye {
    fn pairs(&mut self, query: &Query<'_, 3>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        if !self.is_blind.load(Ordering::Relaxed) {
            self.search.pairs(query, pairs);
        }
    }
}

fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|d| a[d] - b[d])
}

fn length(a: Vector) -> f64 {
    a.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// A triangle of a facet: of four nodes a corner, the next one and the middle.
fn triangle(surface: &SpaceSurface, facet: usize, k: usize, positions: &[Vector]) -> [Vector; 3] {
    let x = surface.facets[facet].map(|node| positions[node as usize]);
    let middle = [0, 1, 2].map(|d| 0.25 * (x[0][d] + x[1][d] + x[2][d] + x[3][d]));
    if surface.facets[facet].corners().len() == 3 { [x[0], x[1], x[2]] } else { [x[k], x[(k + 1) % 4], middle] }
}

/// Hexahedra of a grid from the origin, whose nodes are put in their places.
fn grid(first: u32, [nx, ny, nz]: [usize; 3], place: impl Fn(Vector) -> Vector) -> (Vec<Vec<u32>>, Vec<Vector>) {
    let node = |i: usize, j: usize, k: usize| first + ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let places = (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k])));
    let positions = places.map(|at| place(at.map(|k| k as f64))).collect();
    let square = |i: usize, j: usize, k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
    let cells = (0..nx * ny * nz).map(|cell| (cell % nx, cell / nx % ny, cell / nx / ny));
    (cells.map(|(i, j, k)| [square(i, j, k), square(i, j, k + 1)].concat()).collect(), positions)
}

/// Two bodies in contact, of which the first `count` nodes move, followed by a contact that is blind or not.
struct Pairing {
    contact: NodeFacet,
    springs: Springs<3>,
    bodies: Bodies<3>,
    positions: Vec<Vector>,
    count: usize,
    travel: f64,
    is_known: bool,
    is_blind: Arc<AtomicBool>,
}

/// What two bodies are made of: cells of each, and all positions.
type Two = ([Vec<Vec<u32>>; 2], Vec<Vector>, usize);

fn two(first: impl Fn(u32) -> (Vec<Vec<u32>>, Vec<Vector>), second: impl Fn(u32) -> (Vec<Vec<u32>>, Vec<Vector>)) -> Two {
    let (cells, mut positions) = first(0);
    let count = positions.len();
    let (others, more) = second(count as u32);
    positions.extend(more);
    ([cells, others], positions, count)
}

impl Pairing {
    fn new((cells, positions, count): &Two, is_blind: bool, with_edges: bool, is_known: bool) -> Self {
        let surfaces: Vec<SpaceSurface> =
            cells.iter().map(|cells| Surface::<3>::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap()).collect();
        let bodies: Vec<u32> = (0..positions.len()).map(|node| u32::from(node >= *count)).collect();
        let is_blind = Arc::new(AtomicBool::new(is_blind));
        let search = || Box::new(Eye { is_blind: is_blind.clone(), search: (registry::<3>()[0].make)() });
        let slaves = |&(slave, _): &(usize, usize)| PassInput {
            slaves: vec![Slave { stiffness: 1.0, area: 1.0, of_mass: 0.0 }; surfaces[slave].nodes.len()],
            ..PassInput::default()
        };
        let inputs = BOTH.iter().map(slaves).collect();
        let proof = MissedContactCheck::new(&surfaces, BOTH, &bodies, positions, with_edges, registry::<3>()[0].make);
        let tracker = Tracker::new(surfaces, BOTH, &bodies, search(), positions);
        let contact = NodeFacet::new(tracker, inputs, &Interface::default(), 0.0, positions).with_proof(proof);
        let contact = if with_edges { contact.with_edges(search()) } else { contact };
        let terms = Terms { law: Box::new(Penalty), tangential: Tangential::Free, damping: 0.0 };
        let springs = Springs::new(positions.len(), 0, vec![terms]);
        Self { contact, springs, bodies: Bodies::default(), positions: positions.clone(), count: *count, travel: 0.0, is_known, is_blind }
    }

    /// A step in which all nodes go to new places; the certificate after it.
    fn go_to(&mut self, new: Vec<Vector>) -> Certificate {
        let old = std::mem::replace(&mut self.positions, new);
        self.travel += self.positions.iter().zip(&old).map(|(x, from)| length(minus(*x, *from))).fold(0.0, f64::max);
        let travel = if self.is_known { self.travel } else { f64::INFINITY };
        let sweep = Sweep { old: &old, new: &self.positions, travel };
        self.springs.clear();
        self.contact.detect(&Scene { sweep, bodies: &self.bodies, time: 0.0 }, &mut self.springs);
        self.contact.certificate()
    }

    /// The same where the first body goes by a way.
    fn go(&mut self, way: Vector) -> Certificate {
        let moved = |(node, x): (usize, &Vector)| if node < self.count { [0, 1, 2].map(|d| x[d] + way[d]) } else { *x };
        self.go_to(self.positions.iter().enumerate().map(moved).collect())
    }
}

/// A cube with the edge `size` above a thin plate; the plate's nodes are not under it, its edges are.
fn bullet(size: f64, height: f64) -> Two {
    let cube = |first: u32| grid(first, [1; 3], |x| [0, 1, 2].map(|d| size * (x[d] - 0.5) + [0.5 - 0.3 * size, 0.5, height][d]));
    let plate = |first: u32| grid(first, [4, 4, 1], |[x, y, z]| [0.5 * x - 0.75, 0.5 * y - 0.75, 0.02 * (z - 1.0)]);
    two(cube, plate)
}

#[test]
fn a_bullet_that_flies_through_a_plate_in_one_step_is_caught_where_the_contact_is_blind() {
    for size in [0.2, 0.45] {
        for (way, nodes) in [([0.03, -0.02, -2.0], 8), ([0.0, 0.0, -0.85 - 0.5 * size], 4), ([0.0, 0.0, -0.5], 0)] {
            let [mut blind, mut sighted] = [true, false].map(|is_blind| Pairing::new(&bullet(size, 0.9), is_blind, true, true));
            for still in 0..3 {
                assert_eq!((blind.go([0.0; 3]).unverified, sighted.go([0.0; 3]).unverified), (0, 0), "{still}");
            }
            assert_eq!(blind.go(way).unverified, nodes, "{size} {way:?}");
            // Who sees holds it, by the face that it came through: beyond the plate's own size below it the
            // side walls are nearer.
            let seen = sighted.go(way);
            assert!(seen.unverified == 0, "{size} {way:?}: {seen:?}");
            let inside = |touch: &&ContactPoint| touch.pass == 0 && touch.projection.gap < 0.0;
            let held: Vec<&ContactPoint> = sighted.contact.tracker().touches().iter().filter(inside).collect();
            assert!(held.len() as u64 == nodes && held.iter().all(|touch| touch.projection.normal == [0.0, 0.0, 1.0]), "{size} {way:?}");
            // And continues to do so, until it is before the face.
            for (by, held) in [(0.001, 8), (-0.2, 8), (0.1, 8), (2.0, 0)].into_iter().filter(|_| nodes == 8) {
                assert_eq!(sighted.go([0.0, 0.0, by]).unverified, 0);
                let inside = |touch: &&ContactPoint| touch.pass == 0 && touch.projection.gap < 0.0 && touch.projection.normal[2] > 0.99;
                let count = sighted.contact.tracker().touches().iter().filter(inside).count();
                assert_eq!(count, held, "{size} {by}");
            }
        }
    }
}

#[test]
fn a_bullet_that_creeps_into_a_plate_is_caught_when_it_comes_in() {
    let mut blind = Pairing::new(&bullet(0.2, 0.35), true, true, true);
    let mut found = 0;
    for step in 0..400 {
        let now = blind.go([0.0, 0.0, -1.003e-3]);
        // Its four lower nodes are at z = 0 after 250 steps.
        assert!(now.unverified == 0 || step >= 249, "{step}: {now:?}");
        found = now.unverified;
    }
    assert_eq!(found, 4);
    let mut sighted = Pairing::new(&bullet(0.2, 0.35), false, true, true);
    let last = (0..400).map(|_| sighted.go([0.0, 0.0, -1.003e-3])).last().unwrap();
    assert_eq!((last.unverified, last.crossings_found), (0, 4));
}

/// Two bars of square section on edge that cross at right angles, the first above the second by a gap.
fn bars(gap: f64) -> Two {
    let bar = |first: u32, along: usize, height: f64, off: f64| {
        grid(first, [4, 1, 1], move |[x, y, z]| {
            let (x, b, c) = (0.75 * x - 1.5 + off, 0.2 * (y - 0.5), 0.2 * (z - 0.5));
            let (b, c) = (R * (b - c), R * (b + c));
            if along == 0 { [x, b, c + height] } else { [-b, x, c + height] }
        })
    };
    two(|first| bar(first, 0, 0.4 * R + gap, 0.13), |first| bar(first, 1, 0.0, 0.21))
}

#[test]
fn edges_that_go_through_each_other_are_caught_where_the_contact_is_blind() {
    for down in [0.02, 0.05, 0.3, 2.0] {
        let [mut blind, mut sighted] = [true, false].map(|is_blind| Pairing::new(&bars(0.01), is_blind, true, true));
        assert_eq!((blind.go([0.0; 3]).unverified, sighted.go([0.0; 3]).unverified), (0, 0));
        let caught = blind.go([0.0, 0.0, -down]).unverified;
        assert_eq!(caught > 0, down > 0.01, "{down}: {caught}");
        let missed = sighted.go([0.0, 0.0, -down]).unverified;
        println!("{down}: {caught} caught, {missed} missed by edges");
        if down < 0.1 {
            assert_eq!((caught, missed), (1, 0), "{down}");
        }
    }
    // Beside each other, and with nodes alone, there is nothing.
    let mut beside = Pairing::new(&bars(0.01), true, true, true);
    beside.go([5.0, 0.0, 0.0]);
    assert_eq!(beside.go([0.0, 0.0, -0.3]).unverified, 0);
}

#[test]
fn a_node_that_is_let_go_inside_is_caught() {
    let mut pairing = Pairing::new(&bullet(0.2, 0.12), false, false, true);
    assert_eq!(pairing.go([0.0; 3]).unverified, 0);
    assert_eq!(pairing.go([0.0, 0.0, -0.03]), Certificate { unverified: 0, crossings_found: 4, ..pairing.contact.certificate() });
    // The contact goes blind with what it holds.
    pairing.is_blind.store(true, Ordering::Relaxed);
    assert_eq!(pairing.go([0.2, 0.0, 0.0]).unverified, 4);
}

/// A node that enters a plate near its rim deeper than it is from the side stays with the face that it came
/// through, and one that cuts the corner is out.
#[test]
fn a_node_that_comes_in_near_a_rim_is_led_by_its_face_and_one_that_cuts_the_corner_is_not() {
    let cube = |first: u32| grid(first, [1; 3], |[x, y, z]| [0.3 * x + 0.65, 0.3 * y - 0.15, 0.3 * z + 0.1]);
    let plate =
        |thickness: f64| move |first: u32| grid(first, [2, 2, 1], |[x, y, z]| [0.7 * x - 0.7, 0.6 * y - 0.6, thickness * (z - 1.0)]);
    for thickness in [0.05, 1.0] {
        for with_edges in [false, true] {
            // The node at x = 0.65 is 0.05 from the rim at x = 0.7, and goes 0.4 below it, twice.
            let mut sighted = Pairing::new(&two(cube, plate(thickness)), false, with_edges, true);
            assert_eq!(sighted.go([0.0; 3]).unverified, 0);
            for depth in [0.4, 0.41, 0.2] {
                let down = depth - 0.1 + sighted.positions[0][2];
                assert_eq!(sighted.go([0.0, 0.0, -(down + 0.1)]).unverified, 0);
                let touches = sighted.contact.tracker().touches();
                let of = |node: u32| touches.iter().find(|touch| touch.node == node).map(|touch| touch.projection);
                let held = of(0).unwrap();
                assert!((held.gap + depth).abs() < 1e-12 && held.normal == [0.0, 0.0, 1.0], "{thickness} {depth}: {held:?}");
                // The node at x = 0.95 goes down beside the plate.
                assert!(of(1).is_none_or(|beside| beside.gap > 0.0), "{thickness}: {:?}", of(1));
            }
            // Aside, by its side, it is out.
            let out = sighted.go([0.1, 0.0, 0.0]);
            let held = sighted.contact.tracker().touches().iter().find(|touch| touch.node == 0 && touch.projection.gap < 0.0);
            assert!(out.unverified == 0 && (thickness < 0.5 || held.is_none()), "{thickness}: {out:?} {held:?}");
            let mut cutting = Pairing::new(&two(cube, plate(thickness)), false, with_edges, true);
            cutting.go([0.0; 3]);
            let cut = cutting.go([0.06, 0.0, -0.101]);
            let held = cutting.contact.tracker().touches().iter().find(|touch| touch.node == 0 && touch.projection.gap < 0.0);
            assert!(cut.unverified == 0 && held.is_none(), "{cut:?} {held:?}");
        }
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|d| a[d] * b[d]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The side from which each node came in that goes into the other body in a step and does not come out again
/// by that side or beside it, nor comes around the body before the face there, by a look at all pairs: (pass,
/// node, side).
fn all_that_enter(surfaces: &[SpaceSurface], [old, new]: [&[Vector]; 2]) -> Vec<(u32, u32, Vector)> {
    let mut all = Vec::new();
    for (pass, &(slave, target)) in BOTH.iter().enumerate() {
        let target = &surfaces[target];
        for &node in &surfaces[slave].nodes {
            let path = [old[node as usize], new[node as usize]];
            let mut met: Vec<(f64, bool, Vector)> = Vec::new();
            for facet in 0..target.facets.len() {
                let [a, b, c, d] = target.facets[facet].map(|node| new[node as usize]);
                let normal = cross(minus(c, a), minus(d, b)).map(|n| n / length(cross(minus(c, a), minus(d, b))));
                for k in 0..4 {
                    let ([a, b, c], [p, q, r]) = (triangle(target, facet, k, old), triangle(target, facet, k, new));
                    met.extend(entries(path, [a, b, c], [p, q, r]).iter().map(|time| (time, false, normal)));
                    met.extend(entries(path, [a, c, b], [p, r, q]).iter().map(|time| (time, true, normal)));
                }
            }
            met.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut side = None;
            for (_, is_out, normal) in met {
                side = match side {
                    None if !is_out => Some(normal),
                    Some(side) if is_out && dot(side, normal) > -0.5 => None,
                    same => same,
                };
            }
            let placed = Placed { surface: target, positions: new };
            let is_behind = |side: &Vector| {
                let of_face = |facet: &u32| dot(*side, placed.facet_normal(*facet)) > 0.5;
                let far = |facet: u32| placed.nearest_triangle(path[1], facet).map(|(distance, k)| (distance, facet, k));
                let near = (0..target.facets.len() as u32).filter(of_face).filter_map(far).min_by(|a, b| a.0.total_cmp(&b.0));
                near.is_none_or(|(_, facet, k)| {
                    let [a, b, c] = triangle(target, facet as usize, k, new);
                    dot(minus(path[1], a), cross(minus(b, a), minus(c, a))) < 0.0
                })
            };
            all.extend(side.filter(is_behind).map(|side| (pass as u32, node, side)));
        }
    }
    all
}

/// A rigid motion: a way, and a turn by Cayley's map about a place.
fn moved(x: Vector, way: Vector, turn: Vector, about: Vector) -> Vector {
    let (half, arm) = (turn.map(|c| 0.5 * c), minus(x, about));
    let (once, scale) = (cross(half, arm), 2.0 / (1.0 + dot(half, half)));
    let twice = cross(half, once);
    [0, 1, 2].map(|d| about[d] + arm[d] + scale * (once[d] + twice[d]) + way[d])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(250), failure_persistence: None, ..ProptestConfig::default() })]

    /// A rigid body darts about, by up to a metre a step, around, into and through a plate: who sees misses
    /// nothing, and a node that goes in, by a look at all pairs, is held on the side where it came in; who is
    /// blind is reported for each.
    #[test]
    fn a_rigid_body_that_darts_through_a_plate_is_held_wherever_it_goes_in(
        ways in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 25),
        turns in prop::collection::vec(prop::array::uniform3(-0.6..0.6_f64), 25),
        speeds in prop::collection::vec(-3.0..0.0_f64, 25),
        start in prop::array::uniform3(-0.2..0.2_f64),
        thickness in 0.01..0.4_f64,
        does_turn: bool,
        with_edges: bool,
    ) {
        let cube = |first: u32| grid(first, [2, 1, 1], |[x, y, z]| [0.3 * x + start[0], 0.3 * y + start[1], 0.3 * z + 0.7 + start[2]]);
        let plate = |first: u32| grid(first, [2, 2, 1], |[x, y, z]| [0.7 * x - 0.7, 0.6 * y - 0.6, thickness * z]);
        let bodies = two(cube, plate);
        let surfaces: Vec<SpaceSurface> = bodies.0.iter().map(|cells| Surface::<3>::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap()).collect();
        let mut sighted = Pairing::new(&bodies, false, with_edges, true);
        let mut blind = Pairing::new(&bodies, true, false, true);
        sighted.go([0.0; 3]);
        blind.go([0.0; 3]);
        let mut all = 0;
        for (step, speed) in speeds.iter().enumerate() {
            let (speed, old) = (10f64.powf(*speed), sighted.positions.clone());
            let by = if does_turn { turns[step].map(|c| speed * c) } else { [0.0; 3] };
            let middle = [0, 1, 2].map(|d| old[..bodies.2].iter().map(|x| x[d]).sum::<f64>() / bodies.2 as f64);
            let go = |(node, x): (usize, &Vector)| if node < bodies.2 { moved(*x, ways[step].map(|c| speed * c), by, middle) } else { *x };
            let new: Vec<Vector> = old.iter().enumerate().map(go).collect();
            let mut entered = all_that_enter(&surfaces, [&old, &new]);
            all += entered.len() as u64;
            // Who is inside already, or has gone through the far side, is held on the side where it came in
            // first.
            let was_inside: Vec<(u32, u32)> =
                sighted.contact.tracker().touches().iter().filter(|touch| touch.projection.gap < 0.0).map(|touch| (touch.pass, touch.node)).collect();
            entered.retain(|&(pass, node, _)| !was_inside.contains(&(pass, node)));
            prop_assert_eq!(blind.go_to(new.clone()).unverified, all, "blind, step {}", step);
            let reported = sighted.go_to(new);
            prop_assert_eq!(reported.unverified, 0, "step {} {:?}", step, ways[step].map(|c| speed * c));
            for (pass, node, side) in entered {
                let touches = sighted.contact.tracker().touches().iter();
                let held = touches.clone().any(|touch| touch.pass == pass && touch.node == node && touch.projection.gap < 0.0 && dot(touch.projection.normal, side) > -0.5);
                prop_assert!(held, "step {step}: node {node} of pass {pass} came in from {side:?} and is not held");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(60), failure_persistence: None, ..ProptestConfig::default() })]

    /// Of two bodies that dart about and change their shapes every node that goes into the other is caught,
    /// as by a look at all pairs without a search and without sleep.
    #[test]
    fn what_sleeps_and_is_not_searched_is_proven_as_by_a_look_at_all_pairs(
        ways in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 30),
        shakes in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 30 * 8),
        speeds in prop::collection::vec(-3.5..0.0_f64, 30),
        start in prop::array::uniform3(-0.2..0.2_f64),
    ) {
        let cube = |first: u32| grid(first, [2, 1, 1], |[x, y, z]| [0.3 * x + start[0], 0.3 * y + start[1], 0.3 * z + 0.5 + start[2]]);
        let plate = |first: u32| grid(first, [2, 2, 1], |[x, y, z]| [0.7 * x - 0.7, 0.6 * y - 0.6, 0.2 * z]);
        let bodies = two(cube, plate);
        let mut blind = Pairing::new(&bodies, true, false, true);
        let mut awake = Pairing::new(&bodies, true, false, false);
        let count = bodies.2;
        let surfaces: Vec<SpaceSurface> = bodies.0.iter().map(|cells| Surface::<3>::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap()).collect();
        let mut all = 0;
        blind.go([0.0; 3]);
        awake.go([0.0; 3]);
        for (step, speed) in speeds.iter().enumerate() {
            let speed = 10f64.powf(*speed);
            let old = blind.positions.clone();
            let new: Vec<Vector> = old.iter().enumerate().map(|(node, x)| {
                let (way, shake) = (ways[step], shakes[(8 * step + node) % shakes.len()]);
                let whole = if node < count { 1.0 } else { 0.0 };
                [0, 1, 2].map(|d| x[d] + speed * (whole * way[d] + 0.05 * shake[d]))
            }).collect();
            all += all_that_enter(&surfaces, [&old, &new]).len() as u64;
            let reported = blind.go_to(new.clone());
            prop_assert_eq!(reported.unverified, all, "step {}", step);
            prop_assert_eq!(awake.go_to(new).unverified, all, "step {}", step);
        }
    }
}
