use super::*;
use crate::contact::formulation::{ContactSurface, Side};
use crate::contact::outline::Outlines;
use crate::contact::projection::node_segment::Target;
use crate::contact::search;
use crate::contact::springs::End;
use crate::contact::{Sweep, law};
use crate::model;
use crate::rigid::Bodies;
use crate::vector::dot;

/// Nodes of two facing chains: the first from x = 0 to `width` at y = 0 with the body below, the second back
/// with the body above.
struct Facing2 {
    positions: Vec<Vector>,
    surfaces: [Surface<2>; 2],
}

fn facing(first: &[f64], second: &[f64], gap: f64, angle: f64) -> Facing2 {
    let (sin, cos) = f64::sin_cos(angle);
    let turned = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
    let mut positions: Vec<Vector> = first.iter().map(|&x| turned(x, 0.0)).collect();
    positions.extend(second.iter().rev().map(|&x| turned(x, gap)));
    let chain = |from: usize, count: usize| {
        let segments: Vec<[u32; 2]> = (from..from + count - 1).map(|i| [i as u32, i as u32 + 1]).collect();
        let count = segments.len() as u32;
        Surface::<2> {
            previous: (0..count).map(|i| i.checked_sub(1).unwrap_or(NONE)).collect(),
            next: (0..count).map(|i| if i + 1 < count { i + 1 } else { NONE }).collect(),
            nodes: (from as u32..=from as u32 + count).collect(),
            segments,
        }
    };
    let surfaces = [chain(0, first.len()), chain(first.len(), second.len())];
    Facing2 { positions, surfaces }
}

fn even(count: usize) -> Vec<f64> {
    (0..=count).map(|i| i as f64 / count as f64).collect()
}

/// Springs of the formulation at rest, with what acts in it.
fn springs_of(model: &Facing2, penalty: Penalty, depth: Depth) -> Springs<2> {
    let mut springs = Springs::new(model.positions.len(), 0, Vec::new());
    detect(&mut *formulation_of(model, penalty, depth), model, &mut springs);
    springs
}

fn detect(formulation: &mut dyn Formulation<2>, model: &Facing2, springs: &mut Springs<2>) {
    let sweep = Sweep::between(&model.positions, &model.positions);
    formulation.detect(&Scene { sweep, bodies: &Bodies::default(), time: 0.0 }, springs);
}

fn formulation_of(model: &Facing2, penalty: Penalty, depth: Depth) -> Box<dyn Formulation<2>> {
    let contact = model::Contact { formulation: model::Formulation::Segment, interface: penalty.into(), ..model::Contact::default() };
    let side = |surface: &Surface<2>| Side {
        stiffness: vec![1.0; surface.segments.len()],
        surface: ContactSurface { target: Target { surface: surface.clone(), mirrors: Vec::new() }, lids: Vec::new() },
        ..Side::default()
    };
    let search = || (search::registry::<2>()[0].make)();
    let law = || -> Box<dyn Law> { Box::new(law::penalty::Penalty) };
    let bodies: Vec<u32> = (0..model.positions.len()).map(|node| u32::from(node >= model.surfaces[0].nodes.len())).collect();
    let sides: Vec<_> = model.surfaces.iter().map(side).collect();
    let overlap_check = Side::depths(&sides, &Outlines::default(), &bodies, true);
    let setup = Setup {
        contact: &contact,
        sides,
        positions: &model.positions,
        depth,
        law: &law,
        overlap_check,
        tie_terms: 0,
        rebuild: false,
        search: &search,
        bodies: &bodies,
        passes: both_passes(&contact),
    };
    KIND.in_2d.unwrap()(setup).unwrap()
}

/// Forces F = −k g at the nodes.
fn forces(model: &Facing2, springs: &Springs<2>) -> Vec<Vector> {
    let mut forces = vec![[0.0; 2]; model.positions.len()];
    for spring in &springs.list {
        let force = spring.stiffness * (-spring.gap).max(0.0);
        for end in springs.ends(spring) {
            for d in 0..2 {
                forces[end.at as usize][d] += (end.share * spring.normal[d] + end.lean()[d]) * force;
            }
        }
    }
    forces
}

#[test]
fn a_uniform_gap_gives_the_loads_of_a_uniform_pressure_on_any_two_meshes() {
    let uneven = vec![0.0, 0.13, 0.2, 0.55, 0.81, 1.0];
    for (first, second) in
        [(even(4), even(5)), (even(8), even(11)), (even(12), even(11)), (even(5), even(5)), (uneven.clone(), even(7)), (even(1), uneven)]
    {
        for angle in [0.0, std::f64::consts::FRAC_PI_6, 2.0] {
            let (gap, stiffness) = (-1e-3, 3e5);
            let model = facing(&first, &second, gap, angle);
            let springs = springs_of(&model, Penalty::Pressure(stiffness), Depth::Plane);
            let found = forces(&model, &springs);
            let pressure = -gap * stiffness;
            let up = [-angle.sin(), angle.cos()];
            for (surface, sign) in model.surfaces.iter().zip([-1.0, 1.0]) {
                let mut consistent = vec![0.0; model.positions.len()];
                for segment in &surface.segments {
                    let [a, b] = segment.map(|node| model.positions[node as usize]);
                    let half = 0.5 * pressure * ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
                    segment.iter().for_each(|&node| consistent[node as usize] += half);
                }
                for &node in &surface.nodes {
                    for d in 0..2 {
                        let off = found[node as usize][d] - sign * up[d] * consistent[node as usize];
                        assert!(off.abs() <= 1e-12 * pressure, "{first:?} {second:?} {angle}: {off}");
                    }
                }
            }
        }
    }
}

#[test]
fn all_around_a_uniform_gap_gives_the_loads_of_a_uniform_pressure() {
    let (first, second, gap, stiffness) = (even(4), vec![0.0, 0.13, 0.2, 0.55, 0.81, 1.0], -1e-3, 3e5);
    let model = facing(&first, &second, gap, 0.0);
    let found = forces(&model, &springs_of(&model, Penalty::Pressure(stiffness), Depth::Revolution));
    for (surface, sign) in model.surfaces.iter().zip([-1.0, 1.0]) {
        let mut consistent = vec![0.0; model.positions.len()];
        for segment in &surface.segments {
            let shares = Depth::Revolution.shares(segment.map(|node| model.positions[node as usize]));
            segment.iter().zip(shares).for_each(|(&node, share)| consistent[node as usize] += share * -gap * stiffness);
        }
        for &node in &surface.nodes {
            let [x, y] = found[node as usize];
            assert!(x.abs() < 1e-9 && (y - sign * consistent[node as usize]).abs() < 1e-9, "node {node}: {x} {y} {consistent:?}");
        }
    }
}

#[test]
fn only_the_common_part_carries() {
    let model = facing(&[0.0, 1.0, 2.0], &[1.5, 2.5, 3.5], -1e-3, 0.0);
    let springs = springs_of(&model, Penalty::Pressure(1.0), Depth::Plane);
    let length: f64 = springs.list.iter().map(|spring| spring.area).sum();
    assert!((length - 0.5).abs() < 1e-14, "{length}");
}

#[test]
fn where_each_surface_overhangs_forces_are_the_slope_of_all_the_energy() {
    let penalty = Penalty::Pressure(3e5);
    for angle in [0.0, 0.7] {
        let model = facing(&[0.0, 0.4, 1.0, 2.0], &[0.7, 1.6, 2.5], -1e-2, angle);
        let springs = springs_of(&model, penalty, Depth::Plane);
        let found = forces(&model, &springs);
        let energy = |positions: Vec<Vector>| -> f64 {
            let moved = Facing2 { positions, surfaces: model.surfaces.clone() };
            springs_of(&moved, penalty, Depth::Plane).list.iter().map(|spring| 0.5 * spring.stiffness * spring.gap * spring.gap).sum()
        };
        let scale = found.iter().flatten().fold(0.0, |largest, force| f64::max(largest, force.abs()));
        for node in 0..model.positions.len() {
            for d in 0..2 {
                let [above, below] = [1e-6, -1e-6].map(|h| {
                    let mut positions = model.positions.clone();
                    positions[node][d] += h;
                    energy(positions)
                });
                let slope = (above - below) / 2e-6;
                assert!((found[node][d] + slope).abs() < 1e-6 * scale, "{angle} node {node} {d}: {} {slope}", found[node][d]);
            }
        }
    }
}

/// The next step of a formulation whose springs hold 2 J/m a pair.
fn step_on(formulation: &mut dyn Formulation<2>, positions: &[Vector], springs: &mut Springs<2>) -> Vec<[u32; 2]> {
    let segments: &mut Segment = (formulation as &mut dyn Any).downcast_mut().unwrap();
    segments.facing.iter_mut().for_each(|facing| facing.stored = 2.0);
    springs.clear();
    segments.detect(&Scene { sweep: Sweep::between(positions, positions), bodies: &Bodies::default(), time: 0.0 }, springs);
    segments.facing.iter().map(|facing| facing.pair).collect()
}

#[test]
fn a_pair_that_was_there_unseen_begins_without_energy() {
    let model = facing(&even(4), &even(5), -1e-3, 0.0);
    let mut formulation = formulation_of(&model, Penalty::Pressure(3e5), Depth::Plane);
    let mut springs = Springs::new(model.positions.len(), 0, Vec::new());
    detect(&mut *formulation, &model, &mut springs);
    assert!(springs.list.iter().all(|spring| (spring.gap + 1e-3).abs() < 1e-12), "the model has them");
    let segments: &mut Segment = (&mut *formulation as &mut dyn Any).downcast_mut().unwrap();
    let unseen = segments.facing.remove(2).pair;
    let pairs = step_on(&mut *formulation, &model.positions, &mut springs);
    for (&pair, two) in pairs.iter().zip(springs.list.chunks(2)) {
        let expected = if pair == unseen { 0.0 } else { -1e-3 };
        assert!(two.iter().all(|spring| (spring.gap - expected).abs() < 1e-12), "{pair:?} {two:?}");
    }
    assert_eq!(formulation.lost_contact_energy(), 0.0);
}

#[test]
fn pairs_that_are_not_found_again_let_go_unless_they_ran_out() {
    let model = facing(&even(4), &even(5), -1e-3, 0.0);
    for (by, lets_go) in [([0.0, 0.5], true), ([5.0, 0.0], false)] {
        let mut formulation = formulation_of(&model, Penalty::Pressure(3e5), Depth::Plane);
        let mut springs = Springs::new(model.positions.len(), 0, Vec::new());
        let pairs = step_on(&mut *formulation, &model.positions, &mut springs).len();
        let mut apart = model.positions.clone();
        apart[5..].iter_mut().for_each(|x| *x = [x[0] + by[0], x[1] + by[1]]);
        assert!(step_on(&mut *formulation, &apart, &mut springs).is_empty());
        assert_eq!(formulation.lost_contact_energy(), if lets_go { 2.0 * pairs as f64 } else { 0.0 }, "{by:?}");
    }
}

/// Each node at the end of a common part once from each segment.
fn inclined() -> [[Vector; 4]; 3] {
    [
        [[0.0, 0.0], [1.0, 0.1], [1.3, 0.25], [0.2, 0.15]],
        [[0.0, 0.0], [1.0, -0.3], [0.7, 0.25], [-0.5, 0.35]],
        [[0.1, 0.0], [0.8, 0.4], [1.1, 0.05], [-0.3, -0.25]],
    ]
}

/// Difference quotient of a value in one coordinate of a node.
fn quotient(positions: &[Vector; 4], [node, d]: [usize; 2], value: impl Fn(&[Vector; 4]) -> f64) -> f64 {
    let h = 1e-6;
    let [above, below] = [h, -h].map(|h| {
        let mut positions = *positions;
        positions[node][d] += h;
        value(&positions)
    });
    (above - below) / (2.0 * h)
}

#[test]
fn rates_are_those_of_the_motion_and_blind_to_rotations() {
    let nodes = [[0, 1], [2, 3]];
    for positions in inclined() {
        let common = Common::new(nodes, &positions).unwrap();
        let normal = common.normal;
        let t = crate::contact::springs::tangent(normal);
        for place in [0.2, 0.9] {
            let (gap, ends) = common.point(place);
            let rates = |v: &dyn Fn(usize) -> Vector| {
                ends.iter().fold([0.0; 2], |sum: Vector, end| {
                    let v = v(end.at as usize);
                    let row = [0, 1].map(|d| end.share * t[d] + end.turn[0][d]);
                    [sum[0] + end.share * dot(normal, v) + dot(end.lean, v), sum[1] + dot(row, v)]
                })
            };
            for v in [[1.0, 0.0], [0.0, 1.0]] {
                assert!(rates(&|_| v).iter().all(|rate| rate.abs() < 1e-14));
            }
            let turned = rates(&|node| [-positions[node][1], positions[node][0]]);
            assert!(turned.iter().all(|rate| rate.abs() < 1e-14), "a rotation of both: {turned:?}");
            assert!((rates(&|node| if node < 2 { t } else { [0.0; 2] })[1] - 1.0).abs() < 1e-14);
            for node in 0..4 {
                for d in 0..2 {
                    let quotient = quotient(&positions, [node, d], |x| Common::new(nodes, x).unwrap().point(place).0);
                    let rate = rates(&|other| if other == node { [0, 1].map(|e| f64::from(e == d)) } else { [0.0; 2] })[0];
                    assert!((rate - quotient).abs() < 1e-8, "{gap} at {place} by node {node} {d}: {rate} {quotient}");
                }
            }
        }
    }
}

#[test]
fn the_area_varies_as_difference_quotients_say() {
    let nodes = [[0, 1], [2, 3]];
    for positions in inclined() {
        let area = |positions: &[Vector; 4]| Common::new(nodes, positions).unwrap().area;
        let common = Common::new(nodes, &positions).unwrap();
        let mut ends = [End::default(); 4];
        common.vary_area(&mut ends, 3.0);
        for node in 0..4 {
            for d in 0..2 {
                let quotient = 3.0 * quotient(&positions, [node, d], area) / area(&positions);
                assert!((ends[node].lean[d] - quotient).abs() < 1e-8, "{node} {d}: {} {quotient}", ends[node].lean[d]);
            }
        }
    }
}

#[test]
fn the_circumference_varies_as_difference_quotients_say() {
    let nodes = [[0, 1], [2, 3]];
    for (positions, place) in inclined().into_iter().zip([0.2, 0.9, 0.5]) {
        let radius = |positions: &[Vector; 4]| Common::new(nodes, positions).unwrap().middle(place)[0];
        let common = Common::new(nodes, &positions).unwrap();
        let mut ends = [End::default(); 4];
        common.vary_radius(&mut ends, place, 3.0);
        for node in 0..4 {
            for d in 0..2 {
                let quotient = 3.0 * quotient(&positions, [node, d], radius) / radius(&positions);
                assert!((ends[node].lean[d] - quotient).abs() < 1e-8, "{node} {d}: {} {quotient}", ends[node].lean[d]);
            }
        }
    }
}

#[test]
fn segments_that_do_not_face_each_other_have_nothing_in_common() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, -1.0], [0.0, 1e-3]];
    // One after the other, at a right angle, and turning its back.
    assert!(Common::new([[0, 1], [1, 2]], &square).is_none());
    assert!(Common::new([[0, 1], [0, 1]], &square).is_none());
    assert!(Common::new([[0, 1], [1, 1]], &square).is_none());
    assert!(Common::new([[0, 1], [1, 3]], &square).is_some());
}
