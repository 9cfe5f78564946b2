//! No contact is missed: what the tracker finds is held against winding numbers that are counted again in
//! every step, for bodies that move at random and at any speed, and whole runs certify themselves.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use crate::long::samples;
use embate_solver::contact::Sweep;
use embate_solver::contact::projection::node_segment::{Target, Vector};
use embate_solver::contact::search::registry;
use embate_solver::contact::tracker::Tracker;
use embate_solver::mesh::cell::CellKind;
use embate_solver::mesh::surface::Surface;
use embate_solver::model::{Contact, Cuboid, Disk, Part, Partners, Shape};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Rings of quadrilaterals (outer and inner chain each) with some nodes around, and their bodies.
struct Rings {
    target: Target,
    bodies: Vec<u32>,
    /// Initial positions about the centre of each ring, and where the centre is.
    shapes: Vec<Vector>,
}

/// `count` rings of `around` elements; node 2 i is inside, node 2 i + 1 outside.
fn rings(count: usize, around: usize, inner: f64, flat: f64) -> Rings {
    let (mut cells, mut bodies, mut shapes) = (Vec::new(), Vec::new(), Vec::new());
    for ring in 0..count {
        let first = shapes.len();
        let at = |i: usize, side: usize| (first + 2 * (i % around) + side) as u32;
        for i in 0..around {
            let angle = TAU * (i as f64 + 0.1 * ring as f64) / around as f64;
            for radius in [inner, 1.0] {
                shapes.push([radius * angle.cos(), flat * radius * angle.sin()]);
                bodies.push(ring as u32);
            }
            cells.push([at(i, 0), at(i, 1), at(i + 1, 1), at(i + 1, 0)]);
        }
    }
    let surface = Surface::<2>::outside(CellKind::Quadrilateral.cells(cells.as_flattened())).unwrap();
    Rings { target: Target { surface, mirrors: vec![] }, bodies, shapes }
}

impl Rings {
    /// Positions with each ring turned and moved.
    fn placed(&self, places: &[([f64; 2], f64)]) -> Vec<Vector> {
        let place = |(x, &body): (&Vector, &u32)| {
            let ([cx, cy], angle) = places[body as usize];
            let (sin, cos) = angle.sin_cos();
            [cx + cos * x[0] - sin * x[1], cy + sin * x[0] + cos * x[1]]
        };
        self.shapes.iter().zip(&self.bodies).map(place).collect()
    }

    /// How often a node is inside a body, by the ray along +x; `None` where it is too near to the surface for
    /// rounding.
    fn winding(&self, x: Vector, body: u32, positions: &[Vector]) -> Option<i32> {
        let mut sum = 0;
        for (segment, _) in self.target.surface.segments.iter().zip(0..).filter(|(segment, _)| self.bodies[segment[0] as usize] == body) {
            let [a, b] = segment.map(|node| positions[node as usize]);
            let cross = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
            if self.target.distance(x, self.target.surface.segments.iter().position(|it| it == segment)? as u32, positions)? < 1e-9 {
                return None;
            }
            // The body is on the right.
            sum += match (a[1] <= x[1], b[1] <= x[1]) {
                (true, false) if cross > 0.0 => -1,
                (false, true) if cross < 0.0 => 1,
                _ => 0,
            };
        }
        Some(sum)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(150), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whoever_is_inside_a_body_is_in_contact_with_it(
        count in 2_usize..4, around in 5_usize..14, inner in 0.3..0.9_f64, flat in 0.15..1.0_f64,
        start in prop::collection::vec((prop::array::uniform2(-1.5..1.5_f64), 0.0..TAU), 4),
        moves in prop::collection::vec((prop::array::uniform2(-1.0..1.0_f64), -0.5..0.5_f64), 4 * 12),
        speeds in prop::collection::vec(-4.0..0.3_f64, 12),
    ) {
        let rings = rings(count, around, inner, flat);
        let mut places: Vec<_> = start[..count].to_vec();
        let mut old = rings.placed(&places);
        let search = (registry::<2>()[0].make)();
        let mut tracker = Tracker::new(vec![rings.target.clone()], &[(0, 0)], search, &old).with_bodies(&rings.bodies, &[]);
        for (step, speed) in speeds.iter().enumerate() {
            let speed = 10.0_f64.powf(*speed);
            if step > 0 {
                for (body, (place, angle)) in places.iter_mut().enumerate() {
                    let (by, turn) = moves[4 * step + body];
                    *place = [place[0] + speed * by[0], place[1] + speed * by[1]];
                    *angle += speed.min(1.0) * turn;
                }
            }
            let new = rings.placed(&places);
            let touches = tracker.track(Sweep::between(&old, &new), 0.0).to_vec();
            for (node, &x) in new.iter().enumerate() {
                for body in 0..count as u32 {
                    let touch = touches.iter().find(|touch| {
                        touch.node == node as u32 && rings.bodies[rings.target.surface.segments[touch.projection.segment as usize][0] as usize] == body
                    });
                    if rings.bodies[node] == body {
                        // Rigid bodies never touch themselves.
                        prop_assert!(touch.is_none_or(|touch| touch.own && touch.projection.gap >= 0.0), "{step} {node}: {touch:?}");
                    } else if rings.winding(x, body, &new).is_some_and(|winding| winding > 0) {
                        prop_assert!(touch.is_some_and(|touch| touch.projection.gap < 0.0), "{step} {node} in {body}: {touch:?}");
                    }
                }
            }
            old = new;
        }
        prop_assert_eq!(tracker.certificate().unverified, 0);
    }
}

#[test]
fn runs_certify_themselves() {
    // A block that shatters through a pile of plates and bounces among them, everybody against everybody.
    let mut model = model(3e-3);
    model.materials.insert("heavy".into(), elastic(1e10, 1e5));
    for plate in 0..4 {
        let name = format!("plate{plate}");
        add(&mut model, &name, rectangle([-0.1, -0.004 * f64::from(plate)], [0.2, 0.002], [40, 1]), [0.0, 0.0]);
        model.parts[plate as usize].material = "heavy".into();
    }
    add(&mut model, "block", Shape::Disk(Disk { centre: [0.01, 0.05], radius: 0.03, elements: 4 }), [5.0, -60.0]);
    model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(vec![]), ..Contact::default() });
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.largest("energy.contact") > 1.0);
    assert!(summary.contact.unverified == 0 && summary.contact.crossings_found > 100, "{summary:?}");
    assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
    let searches = simulation.searches();
    assert_eq!((searches.len(), searches[0].search.as_str(), searches[0].report.steps), (1, "grid", summary.steps + 1));
    assert!(searches[0].report.searches < summary.steps / 2 && searches[0].pairs_swept == summary.contact.pairs_swept, "{searches:?}");
}

/// A tracker of the outside of these cells against itself, and the positions.
fn tracker_of(cells: &[[u32; 4]], bodies: &[u32], positions: &[Vector]) -> Tracker {
    let surface = Surface::<2>::outside(CellKind::Quadrilateral.cells(cells.as_flattened())).unwrap();
    Tracker::new(vec![Target { surface, mirrors: vec![] }], &[(0, 0)], (registry::<2>()[0].make)(), positions).with_bodies(bodies, &[])
}

#[test]
fn corners_that_begin_exactly_on_each_other_go_in_and_out_again() {
    for quarter in 0..4 {
        let (sin, cos) = (0.5 * TAU / 2.0 * f64::from(quarter)).sin_cos();
        let turned = |[x, y]: Vector| [cos.round() * x - sin.round() * y, sin.round() * x + cos.round() * y];
        let shape = [[0.0, 0.0], [1.0, 1.0], [0.0, 2.0], [-1.0, 1.0], [0.0, 0.0], [-0.3, -0.4], [0.0, -0.8], [0.3, -0.4]];
        let at = |way: f64| -> Vec<Vector> { (0..).zip(shape).map(|(k, [x, y])| turned([x, if k < 4 { y } else { y + way }])).collect() };
        let mut tracker = tracker_of(&[[0, 1, 2, 3], [4, 5, 6, 7]], &[0, 0, 0, 0, 1, 1, 1, 1], &at(0.0));
        let mut old = at(0.0);
        for way in [0.0, 0.02, 0.03, 0.01, -0.01, -0.02, -0.01] {
            let new = at(way);
            let touches = tracker.track(Sweep::between(&old, &new), 0.0).to_vec();
            for node in [0, 4] {
                let is_inside = touches.iter().any(|touch| touch.node == node && !touch.own && touch.projection.gap < 0.0);
                assert_eq!(is_inside, way > 0.0, "node {node} at {way}, turned {quarter} times: {touches:?}");
            }
            old = new;
        }
        assert_eq!(tracker.certificate().unverified, 0, "turned {quarter} times");
    }
}

#[test]
fn who_leaves_one_face_of_an_overlapping_crack_is_held_by_the_other() {
    // A block with a crack from above whose faces overlap by 4 mm, and a tip that comes down into both.
    let block =
        [[-1.0, -1.0], [0.0, -1.0], [1.0, -1.0], [-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [-1.0, 1.0], [2e-3, 1.0], [-2e-3, 1.0], [1.0, 1.0]];
    let tip = [[0.0, 1.05], [0.2, 1.5], [0.0, 1.9], [-0.2, 1.5]];
    let at = |way: Vector| -> Vec<Vector> { block.into_iter().chain(tip.map(|[x, y]| [x + way[0], y + way[1]])).collect() };
    let cells = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 9, 8], [10, 11, 12, 13]];
    let bodies: Vec<u32> = (0..14).map(|node| u32::from(node >= 10)).collect();
    let mut old = at([0.0; 2]);
    let mut tracker = tracker_of(&cells, &bodies, &old);
    for (way, depth) in [([0.0, 0.0], None), ([0.0, -0.1], Some(0.05)), ([0.0032, -0.1], Some(0.0052)), ([0.0034, -0.1], Some(0.0054))] {
        let new = at(way);
        let touches = tracker.track(Sweep::between(&old, &new), 0.0).to_vec();
        let inside = touches.iter().find(|touch| touch.node == 10 && touch.projection.gap < 0.0);
        assert_eq!(inside.is_some(), depth.is_some(), "{way:?}: {touches:?}");
        if let (Some(touch), Some(depth)) = (inside, depth) {
            assert!(-touch.projection.gap <= depth, "{way:?}: {touch:?}");
        }
        old = new;
    }
    assert_eq!(tracker.certificate().unverified, 0);
}

#[test]
fn a_contact_that_transmits_nothing_is_mentioned() {
    let mut model = model(3e-4);
    add(&mut model, "one", rectangle([0.0, 0.0], [0.1, 0.1], [3, 3]), [0.0, 0.0]);
    add(&mut model, "two", rectangle([0.2, 0.0], [0.1, 0.1], [3, 3]), [0.0, 0.0]);
    touch(&mut model, "one", "two");
    let (simulation, _) = run(&model);
    let warnings = simulation.summary().warnings;
    assert_eq!(
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        ["W0402: contact \"one-two\" transmitted nothing in the whole run"]
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(300), failure_persistence: None, ..ProptestConfig::default() })]

    /// What sleeps is found as if it had been looked at: the same touches, searches and proof in every step,
    /// of bodies that dart about (some of their nodes more slowly) and of such as go straight towards each
    /// other, each as fast as the travel allows.
    #[test]
    fn what_sleeps_misses_nothing(
        moves in prop::collection::vec((prop::array::uniform2(-0.7..0.7_f64), -1.0..1.0_f64), 6 * 80),
        courses in prop::collection::vec(0..4_usize, 6),
        is_steady in any::<bool>(),
        speeds in prop::collection::vec(0.0..1.0_f64, 80),
    ) {
        let cells: Vec<[u32; 4]> = (0..6).map(|k| [0, 1, 2, 3].map(|corner| 4 * k + corner)).collect();
        let bodies: Vec<u32> = (0..24).map(|node| node / 4).collect();
        let mut old: Vec<Vector> = (0..6)
            .flat_map(|k| {
                let (x, y) = (1.05 * f64::from(k % 3), 1.05 * f64::from(k / 3));
                [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]
            })
            .collect();
        let (mut sleepy, mut awake) = (tracker_of(&cells, &bodies, &old), tracker_of(&cells, &bodies, &old));
        let mut travel = 0.0;
        for (step, speed) in speeds.iter().enumerate() {
            let way = |node: usize| {
                if is_steady {
                    let course = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]][courses[node / 4]];
                    return course.map(|part| (3e-4 + 5e-4 * speed) * part);
                }
                let ([u, v], stretch) = moves[6 * step + node / 4];
                let slow = if node.is_multiple_of(4) { stretch } else { 1.0 };
                [u, v].map(|part| 10f64.powf(4.5 * speed - 5.0) * slow * part)
            };
            let new: Vec<Vector> = old.iter().enumerate().map(|(node, x)| [x[0] + way(node)[0], x[1] + way(node)[1]]).collect();
            travel += (0..old.len()).map(way).map(|[x, y]| (x * x + y * y).sqrt()).fold(0.0, f64::max);
            let touches = awake.track(Sweep::between(&old, &new), 0.0).to_vec();
            prop_assert_eq!(sleepy.track(Sweep { old: &old, new: &new, travel }, 0.0), &touches[..], "step {}", step);
            old = new;
        }
        prop_assert_eq!(sleepy.certificate(), awake.certificate());
        prop_assert_eq!(sleepy.search_report(), awake.search_report());
    }
}

/// A block that is thrown on a pile of plates as solids, everybody against everybody.
#[test]
fn runs_of_solids_certify_themselves() {
    for element in ["hex8", "hex8_reduced"] {
        let mut model = model(4e-3);
        let solid = |name: &str, corner: [f64; 3], size: [f64; 3], elements: [usize; 3], velocity: [f64; 3]| Part {
            name: name.into(),
            material: "soft".into(),
            element: element.into(),
            shape: Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() }),
            velocity,
            ..Part::default()
        };
        for plate in 0..3 {
            let (name, z) = (format!("plate{plate}"), -0.012 * f64::from(plate));
            model.parts.push(solid(&name, [0.0, 0.0, z], [0.1, 0.1, 0.006], [8, 8, 1], [0.0; 3]));
        }
        model.parts.push(solid("block", [0.032, 0.037, 0.01], [0.035, 0.03, 0.03], [4, 3, 3], [2.0, 1.0, -20.0]));
        model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(vec![]), ..Contact::default() });
        let (simulation, history) = run(&model);
        let summary = simulation.summary();
        println!("{element}: {:?}, penetration {}", summary.contact, summary.penetration_max);
        assert!(history.largest("energy.contact") > 0.1);
        assert!(summary.contact.unverified == 0 && summary.contact.crossings_found > 50, "{summary:?}");
        assert!(summary.contact.pairs_swept > 100_000, "{:?}", summary.contact);
    }
}
