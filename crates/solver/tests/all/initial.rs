//! Bodies that are inside each other at the start: reported with places, or their gap counts as zero, or they
//! are moved apart without stress.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use embate_solver::model::{
    Constraint, Contact, Cuboid, Disk, InitialPenetration, Model, Obstacle, ObstacleShape, Part, Partners, Ring, Shape, Symmetry,
};

use std::f64::consts::TAU;

/// Two blocks, the upper one 70 % of a segment inside the lower: more than the skin of later searches.
fn overlapping(what: InitialPenetration) -> Model {
    let mut model = model(2e-4);
    add(&mut model, "lower", rectangle([0.0, 0.0], [0.1, 0.1], [5, 5]), [0.0, 0.0]);
    add(&mut model, "upper", rectangle([0.031, 0.086], [0.04, 0.04], [2, 2]), [0.0, 0.0]);
    touch(&mut model, "lower", "upper");
    model.contacts[0].interface.initial_penetration = what;
    model
}

#[test]
fn bodies_that_overlap_at_the_start_are_refused_with_places_and_depths() {
    let found = model_faults(&overlapping(InitialPenetration::Error));
    assert!(found.iter().all(|fault| fault.path == "contact[0]" && fault.help.contains("push_out")), "{found:?}");
    assert_eq!(found.len(), 1, "one line");
    let message = "\"lower-upper\": 5 nodes are up to 1.400e-2 m inside at the start, the deepest at (3.100000e-2, 8.600000e-2) m";
    assert!(found[0].message.starts_with(message), "{found:?}");
}

/// How many nodes and edges a line says are inside.
pub(crate) fn count_inside(line: &str) -> usize {
    let before = line.split(" inside at the start").next().unwrap();
    if before.contains(": the node at") || before.contains(": the edge at") {
        return 1;
    }
    let counts = before.split(": ").last().unwrap().split(" are up to").next().unwrap();
    counts.split(" and ").map(|count| count.split(' ').next().unwrap().parse::<usize>().unwrap()).sum()
}

#[test]
fn overlaps_of_any_depth_are_found_and_long_lists_are_counted() {
    let scene = |shape: Shape, bodies: bool| {
        let mut model = model(1e-4);
        add(&mut model, "block", rectangle([-0.1, -0.1], [0.2, 0.2], [10, 10]), [0.0, 0.0]);
        add(&mut model, "other", shape, [0.0, 0.0]);
        if bodies {
            model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(vec![]), ..Contact::default() });
        } else {
            touch(&mut model, "block", "other");
        }
        model_faults(&model)
    };
    let ring = |inner: f64, outer: f64| {
        Shape::Ring(Ring { centre: [0.0, 0.0], inner, outer, from: 0.0, to: TAU, elements: [2, 30], ..Ring::default() })
    };
    for bodies in [false, true] {
        // Wholly inside, far from the surface.
        let small = scene(rectangle([-0.01, -0.01], [0.02, 0.02], [2, 2]), bodies);
        assert_eq!(small.iter().map(|fault| count_inside(&fault.message)).sum::<usize>(), 8, "{small:?}");
        assert!(small[0].message.contains("9.000e-2 m inside"), "{small:?}");
        let many = scene(Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.03, elements: 8 }), bodies);
        assert_eq!((many.len(), count_inside(&many[0].message)), (1, 32));
        // A ring around the block: inside its hole there is nothing.
        assert_eq!(scene(ring(0.15, 0.16), bodies), []);
        // The block's corners are in the wall.
        let corners = scene(ring(0.13, 0.15), bodies);
        assert!(corners.len() == 1 && count_inside(&corners[0].message) < 20, "{corners:?}");
    }
}

#[test]
fn a_half_model_knows_what_is_inside() {
    // The model may lie on any side of its symmetry line.
    for (axis, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let scene = |along: f64| {
            // A box from 0 to `size` off the line, from `along` on along it.
            let on = |size: f64, along: f64, elements: usize| {
                let mut corner = [along; 2];
                corner[axis] = if side > 0.0 { 0.0 } else { -size };
                rectangle(corner, [size; 2], [elements; 2])
            };
            let mut model = model(1e-4);
            add(&mut model, "block", on(0.2, 0.0, 4), [0.0, 0.0]);
            add(&mut model, "other", on(0.02, along, 2), [0.0, 0.0]);
            touch(&mut model, "block", "other");
            let mut normal = [0.0; 2];
            normal[axis] = 1.0;
            model.symmetries.push(Symmetry { normal: embate_solver::model::in_3d(normal), ..Symmetry::default() });
            model_faults(&model).iter().map(|fault| count_inside(&fault.message)).sum::<usize>()
        };
        assert_eq!(scene(0.2), 0);
        // All nodes but the one in the middle and that on the line between two others.
        assert_eq!(scene(0.09), 7, "{axis} {side}");
    }
}

#[test]
fn ignored_penetrations_are_the_zero_until_the_surfaces_part() {
    // At rest: nothing happens at all.
    let (simulation, history) = run(&overlapping(InitialPenetration::Ignore));
    assert_eq!(history.largest("energy.contact"), 0.0);
    assert!(history.largest("energy.internal") < 1e-20 && simulation.summary().contact.unverified == 0);
    let reported = simulation.overview().initial_penetrations;
    assert!(reported.iter().any(|line| line.contains("1.400e-2 m inside") && line.contains("counts as zero")), "{reported:?}");
    // Pressed together, they push from there on.
    let mut model = overlapping(InitialPenetration::Ignore);
    model.parts[1].velocity = [0.0, -10.0, 0.0];
    let (simulation, history) = run(&model);
    assert!(history.largest("energy.contact") > 1.0 && history.last("upper.vy") > 0.0, "{}", history.last("upper.vy"));
    assert!(simulation.summary().penetration_max < 2e-3);
    assert!(simulation.summary().energy_drift < 0.01);
    // Apart and back again, they meet at the surface.
    let mut model = overlapping(InitialPenetration::Ignore);
    model.parts[1].velocity = [0.0, 20.0, 0.0];
    model.run.end = 2.4e-3;
    model.obstacles.push(Obstacle::wall("ceiling", [0.0, 0.15], [0.0, -1.0]));
    model.obstacles[0].parts = vec!["upper".into()];
    let (_, history) = run(&model);
    let (up, force) = (history.column("upper.y"), history.column("contact.force_y[lower-upper]"));
    let touches = force.iter().zip(&up).filter(|(force, _)| **force != 0.0);
    assert!(touches.clone().count() > 0 && touches.clone().all(|(_, y)| *y > 0.119), "{:?}", touches.collect::<Vec<_>>());
}

#[test]
fn a_contact_that_begins_late_takes_what_is_there_as_zero() {
    let mut model = overlapping(InitialPenetration::Error);
    model.contacts[0].interface.active = [1e-4, f64::INFINITY];
    let (_, history) = run(&model);
    assert_eq!(history.largest("energy.contact"), 0.0);
}

#[test]
fn pushed_out_bodies_are_apart_and_free_of_stress() {
    let round = |what: InitialPenetration| {
        let mut model = model(1e-4);
        add(&mut model, "disk", Shape::Disk(Disk { centre: [0.0, 0.052], radius: 0.05, elements: 6 }), [0.0, 0.0]);
        add(&mut model, "plate", rectangle([-0.1, -0.02], [0.2, 0.023], [31, 4]), [0.0, 0.0]);
        model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(vec![]), ..Contact::default() });
        model.contacts[0].interface.initial_penetration = what;
        model
    };
    for mut model in [round(InitialPenetration::PushOut), overlapping(InitialPenetration::PushOut)] {
        if model.parts[0].name == "lower" {
            // Not deeper than an element can give.
            model.parts[1].shape = rectangle([0.031, 0.097], [0.04, 0.04], [2, 2]);
        }
        let simulation = simulation(&model);
        assert!(simulation.overview().initial_penetrations.iter().any(|line| line.contains("pushed out")));
        let (simulation, history) = run(&model);
        assert!(simulation.summary().penetration_max < 1.2e-10, "{}", simulation.summary().penetration_max);
        assert!(history.largest("energy.internal") < 1e-9, "{}", history.largest("energy.internal"));
    }
}

#[test]
fn nodes_that_are_pushed_out_stay_on_their_symmetry_line() {
    let mut model = model(1e-5);
    add(
        &mut model,
        "disk",
        Shape::Ring(Ring {
            centre: [0.0, 0.052],
            inner: 0.03,
            outer: 0.05,
            from: -0.25 * TAU,
            to: 0.25 * TAU,
            elements: [3, 20],
            ..Ring::default()
        }),
        [0.0, 0.0],
    );
    add(&mut model, "plate", rectangle([0.0, -0.02], [0.1, 0.0225], [15, 4]), [0.0, 0.0]);
    touch(&mut model, "disk", "plate");
    model.contacts[0].interface.initial_penetration = InitialPenetration::PushOut;
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    let simulation = simulation(&model);
    let on_line = simulation.frame().positions::<2>().iter().filter(|x| x[0].abs() < 1e-15).count();
    assert_eq!(on_line, 4 + 4 + 5);
    assert!(simulation.summary().penetration_max < 1e-10);
}

#[test]
fn what_can_not_be_pushed_out_is_a_fault() {
    let found = model_faults(&overlapping(InitialPenetration::PushOut));
    assert!(
        found.is_empty() || found.iter().any(|fault| fault.message.contains("not convex") || fault.message.contains("can't be pushed out"))
    );
    let mut model = overlapping(InitialPenetration::PushOut);
    model.parts[1].shape = rectangle([0.031, 0.03], [0.04, 0.04], [2, 2]);
    assert!(!model_faults(&model).is_empty());
}

#[test]
fn nodes_behind_an_obstacle_are_refused() {
    let mut model = model(1e-4);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [5, 5]), [0.0, 0.0]);
    model.obstacles.push(Obstacle::wall("wall", [0.0, 0.01], [0.0, 1.0]));
    let found = model_faults(&model);
    assert_eq!((found.len(), count_inside(&found[0].message)), (1, 6), "{found:?}");
    assert!(found[0].path == "obstacle[0]" && found[0].message.contains("1.000e-2 m inside"), "{found:?}");
}

/// Gap of a point at an obstacle, m.
type Gap = Box<dyn Fn([f64; 2]) -> f64>;

/// A block that some obstacle is a little inside of, and where its nodes may not be then.
fn with_obstacles() -> Vec<(&'static str, Model, Gap)> {
    let with = |shape: ObstacleShape| {
        let mut model = model(1e-5);
        add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [5, 5]), [0.0, 0.0]);
        model.obstacles.push(Obstacle::fixed("obstacle", shape));
        model
    };
    let away = |centre: [f64; 2]| move |x: [f64; 2]| (x[0] - centre[0]).hypot(x[1] - centre[1]);
    let plane = ObstacleShape::Plane { point: [0.0, 0.001, 0.0], normal: [0.1, 1.0, 0.0], length: None };
    let plate = ObstacleShape::Plane { point: [0.05, 0.0008, 0.0], normal: [0.0, 1.0, 0.0], length: Some(0.2) };
    let big = ObstacleShape::Circle { centre: [0.05, -0.299, 0.0], radius: 0.3, hollow: false };
    let small = ObstacleShape::Circle { centre: [0.052, -0.003, 0.0], radius: 0.004, hollow: false };
    let hollow = ObstacleShape::Circle { centre: [0.05, 0.05, 0.0], radius: 0.0702, hollow: true };
    let tip = ObstacleShape::Polyline { points: vec![[-0.2, -0.1], [0.049, 0.001], [0.2, -0.1], [-0.2, -0.1]] };
    vec![
        ("plane", with(plane), Box::new(|x| (0.1 * x[0] + x[1] - 0.001) / 1.01_f64.sqrt())),
        ("plate", with(plate), Box::new(|x| x[1] - 0.0008)),
        ("circle", with(big), Box::new(move |x| away([0.05, -0.299])(x) - 0.3)),
        ("small circle", with(small), Box::new(|_| 0.0)),
        ("hollow circle", with(hollow), Box::new(move |x| 0.0702 - away([0.05, 0.05])(x))),
        ("tip", with(tip), Box::new(|_| 0.0)),
    ]
}

#[test]
fn bodies_are_pushed_out_of_obstacles_or_left_in_peace() {
    for (name, mut model, gap) in with_obstacles() {
        let refused = model_faults(&model);
        assert!(!refused.is_empty() && refused.iter().all(|fault| fault.path == "obstacle[0]"), "{name}: {refused:?}");
        model.obstacles[0].interface.initial_penetration = InitialPenetration::PushOut;
        let (simulation, history) = run(&model);
        let summary = simulation.summary();
        assert!(summary.penetration_max < 1.1e-10 && history.largest("energy.total") < 1e-9, "{name}: {summary:?}");
        assert!(simulation.frame().positions::<2>().iter().all(|x| gap(*x) > -1.1e-10), "{name}");
        model.obstacles[0].interface.initial_penetration = InitialPenetration::Ignore;
        let (simulation, history) = run(&model);
        assert_eq!(history.largest("energy.contact"), 0.0, "{name}");
        assert_eq!(simulation.summary().penetration_max, 0.0, "{name}");
    }
}

/// A bush in a ring, polygons of 120 and 148 sides with one radius: nodes of each are behind chords of the
/// other. Of the ring a sector.
fn press_fit(sides: bool, to: f64, radius: f64) -> Model {
    let ring = |inner: f64, outer: f64, around: usize| {
        Shape::Ring(Ring { centre: [0.0, 0.0], inner, outer, from: 0.0, to, elements: [2, around], ..Ring::default() })
    };
    let mut model = model(1e-4);
    add(&mut model, "bush", ring(0.006, radius, 120), [0.0, 0.0]);
    add(&mut model, "ring", ring(0.01, 0.014, 148), [0.0, 0.0]);
    if sides {
        touch(&mut model, "bush.outer", "ring.inner")
    } else {
        touch(&mut model, "bush", "ring")
    }
    model
}

#[test]
fn the_side_of_a_hole_knows_what_is_inside_as_the_whole_body_does() {
    let reported = |model: &Model| {
        let mut reported = model_faults(model).into_iter().map(|fault| fault.message).collect::<Vec<_>>();
        reported.iter_mut().for_each(|line| *line = line.split_once(": ").map_or(String::new(), |(_, rest)| rest.to_string()));
        reported.sort();
        reported
    };
    for radius in [0.01, 0.01005] {
        let (of_sides, of_parts) = (reported(&press_fit(true, TAU, radius)), reported(&press_fit(false, TAU, radius)));
        let is_long = of_parts.len() == 1 && count_inside(&format!("{radius}: {}", of_parts[0])) > 20;
        assert!(is_long && of_sides == of_parts, "{radius}: {of_sides:?} {of_parts:?}");
    }
    assert_eq!(reported(&press_fit(true, TAU, 0.00999)), Vec::<String>::new());
    // A half on its symmetry line, whose sides end there.
    let half = |sides: bool, radius: f64| {
        let mut model = press_fit(sides, 0.5 * TAU, radius);
        model.symmetries.push(Symmetry { normal: [0.0, 1.0, 0.0], ..Symmetry::default() });
        model
    };
    assert_eq!(reported(&half(true, 0.01005)), reported(&half(false, 0.01005)));
    assert_eq!(reported(&half(true, 0.00999)), Vec::<String>::new());
}

#[test]
fn levels_are_right_in_a_hole_whatever_was_inside_at_the_start() {
    for what in [InitialPenetration::Ignore, InitialPenetration::PushOut] {
        let mut model = press_fit(true, TAU, 0.01005);
        model.contacts[0].interface.initial_penetration = what;
        model.parts[0].velocity = [40.0, 15.0, 0.0];
        let (simulation, history) = run(&model);
        let summary = simulation.summary();
        assert!(history.largest("energy.contact") > 0.0 && summary.contact.unverified == 0, "{summary:?}");
        assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-12, "{summary:?}");
    }
}

/// Two cubes of which the upper one is in the lower by a part of an element, moved sideways.
fn solids_in_each_other(depth: f64, off: [f64; 2], what: InitialPenetration) -> Model {
    let mut model = model(2e-4);
    let cube = |name: &str, corner: [f64; 3], elements: [usize; 3]| Part {
        name: name.into(),
        material: "soft".into(),
        element: "hex8".into(),
        shape: Shape::Cuboid(Cuboid { corner, size: [0.1; 3], elements, ..Cuboid::default() }),
        ..Part::default()
    };
    model.parts = vec![cube("lower", [0.0; 3], [3; 3]), cube("upper", [off[0], off[1], 0.1 - depth], [2, 3, 3])];
    touch(&mut model, "lower", "upper");
    model.contacts[0].interface.initial_penetration = what;
    model
}

#[test]
fn solids_that_overlap_are_reported_ignored_or_pushed_out_without_stress() {
    // Flush below each other, beside each other, and over the rim, where only edges cross.
    for (depth, off) in [(0.01, [0.031, 0.027]), (0.002, [-0.02, 0.013]), (0.02, [0.01, 0.0]), (0.003, [0.085, -0.083])] {
        let reported = model_faults(&solids_in_each_other(depth, off, InitialPenetration::Error));
        assert!(
            !reported.is_empty() && reported.iter().all(|fault| fault.path == "contact[0]" && fault.help.contains("push_out")),
            "{reported:?}"
        );
        let deepest = format!("{depth:.3e} m inside");
        assert!(reported.iter().any(|fault| fault.message.contains(&deepest)), "{depth} {off:?}: {reported:?}");
        let model = solids_in_each_other(depth, off, InitialPenetration::PushOut);
        let begin = simulation(&model);
        let lines = begin.overview().initial_penetrations;
        assert!(lines.iter().any(|line| line.contains("it was pushed out")), "{lines:?}");
        // Moved by less than the depth, and nothing is inside any more.
        let [ignored, pushed] = [InitialPenetration::Ignore, InitialPenetration::PushOut].map(|what| {
            let simulation = to_end(&solids_in_each_other(depth, off, what));
            // Nodes are pushed out; what edges still cut off is no deeper than it was, and nothing presses
            // there.
            let left = if what == InitialPenetration::Ignore { 1e-9 } else { depth };
            assert!(simulation.summary().penetration_max < left, "{depth} {off:?} {what:?}: {}", simulation.summary().penetration_max);
            assert!(value(&simulation, "energy.kinetic") < 1e-12);
            simulation.frame().positions::<3>().to_vec()
        });
        let ways: Vec<f64> = ignored.iter().zip(&pushed).map(|(a, b)| (0..3).map(|d| (a[d] - b[d]).powi(2)).sum::<f64>().sqrt()).collect();
        let longest = ways.iter().copied().fold(0.0, f64::max);
        println!("{depth} {off:?}: {} nodes moved, {longest} m", ways.iter().filter(|way| **way > 1e-9).count());
        assert!(longest > 0.3 * depth && longest < 1.5 * depth, "{longest}");
    }
}

#[test]
fn what_is_held_on_both_sides_can_not_be_pushed_out_of_each_other() {
    let mut model = solids_in_each_other(0.01, [0.031, 0.027], InitialPenetration::PushOut);
    for part in ["lower", "upper"] {
        model.constraints.push(Constraint { on: part.into(), velocity: [(); 3].map(|()| Some(0.0.into())), ..Constraint::default() });
    }
    let reported = model_faults(&model);
    assert!(!reported.is_empty() && reported.iter().all(|fault| fault.message.contains("can't be pushed out")), "{reported:?}");
    // What is held on one side moves on the other.
    model.constraints.pop();
    let lower = |simulation: &embate_solver::simulation::Simulation| simulation.frame().positions::<3>().to_vec();
    let pushed = lower(&simulation(&model));
    let mut model = solids_in_each_other(0.01, [0.031, 0.027], InitialPenetration::Ignore);
    let reported = lower(&simulation(&model));
    model.constraints.clear();
    let moved = |from: f64, to: f64| {
        pushed.iter().zip(&reported).filter(|(a, b)| (from..to).contains(&b[2]) && (0..3).any(|d| (a[d] - b[d]).abs() > 1e-9)).count()
    };
    assert!(moved(0.0899, 0.0901) > 0 && moved(-1.0, 0.0899) == 0, "the lower cube stays");
}

/// A cube of 10 cm with 4 elements along each edge, and an obstacle that it is partly in.
fn cube_in(shape: ObstacleShape, thickness: f64, what: InitialPenetration) -> Model {
    let mut model = model(1e-4);
    let cuboid = Cuboid { corner: [0.0; 3], size: [0.1; 3], elements: [4; 3], ..Cuboid::default() };
    model.parts = vec![Part {
        name: "cube".into(),
        material: "soft".into(),
        element: "hex8".into(),
        shape: Shape::Cuboid(cuboid),
        ..Part::default()
    }];
    let mut obstacle = Obstacle::fixed("obstacle", shape);
    (obstacle.interface.initial_penetration, obstacle.interface.thickness) = (what, thickness);
    model.obstacles.push(obstacle);
    model
}

#[test]
fn nodes_of_solids_are_pushed_onto_planes_balls_and_cylinders_along_their_normals() {
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|d| a[d] - b[d]);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|d| a[d] * b[d]).sum::<f64>();
    // The point of a surface nearest to a place, in closed form: along a normal from a foot.
    let from = move |foot: [f64; 3], x: [f64; 3], radius: f64| {
        let arm = minus(x, foot);
        let size = dot(arm, arm).sqrt();
        ([0, 1, 2].map(|d| foot[d] + radius / size * arm[d]), size - radius)
    };
    let slant = [0.48, 0.36, 0.8];
    let plane = move |x: [f64; 3], thickness: f64| {
        let gap = dot(slant, x) - 0.004 - thickness;
        ([0, 1, 2].map(|d| x[d] - gap * slant[d]), gap)
    };
    let (centre, axis) = ([0.03, 0.12, 0.05], [0.0, 0.6, 0.8]);
    let foot = move |x: [f64; 3]| {
        let along = dot(minus(x, [-0.02, 0.0, 0.01]), axis);
        [0, 1, 2].map(|d| [-0.02, 0.0, 0.01][d] + along * axis[d])
    };
    let turned = |(onto, gap): ([f64; 3], f64)| (onto, -gap);
    type Nearest<'a> = Box<dyn Fn([f64; 3], f64) -> ([f64; 3], f64) + 'a>;
    let cases: [(ObstacleShape, Nearest<'_>); 5] = [
        (ObstacleShape::Plane { point: [0.0, 0.0, 0.005], normal: slant.map(|c| 2.0 * c), length: None }, Box::new(plane)),
        (ObstacleShape::Sphere { centre, radius: 0.03, hollow: false }, Box::new(move |x, t| from(centre, x, 0.03 + t))),
        (
            ObstacleShape::Sphere { centre: [0.05; 3], radius: 0.085, hollow: true },
            Box::new(move |x, t| turned(from([0.05; 3], x, 0.085 - t))),
        ),
        (
            ObstacleShape::Cylinder { point: [-0.02, 0.0, 0.01], axis, radius: 0.024, hollow: false },
            Box::new(move |x, t| from(foot(x), x, 0.024 + t)),
        ),
        (
            ObstacleShape::Cylinder { point: [-0.02, 0.0, 0.01], axis, radius: 0.134, hollow: true },
            Box::new(move |x, t| turned(from(foot(x), x, 0.134 - t))),
        ),
    ];
    for (shape, nearest) in cases {
        for thickness in [0.0, 0.001] {
            let reported = model_faults(&cube_in(shape.clone(), thickness, InitialPenetration::Error));
            assert!(!reported.is_empty() && reported.iter().all(|fault| fault.path == "obstacle[0]"), "{shape:?}: {reported:?}");
            let before = simulation(&cube_in(shape.clone(), thickness, InitialPenetration::Ignore)).frame().positions::<3>().to_vec();
            let model = cube_in(shape.clone(), thickness, InitialPenetration::PushOut);
            let begin = simulation(&model);
            let mut moved = 0;
            for (&x, &now) in before.iter().zip(begin.frame().positions::<3>()) {
                // Nodes within the body meet nothing.
                let is_outside = x.iter().any(|c| *c < 1e-9 || *c > 0.1 - 1e-9);
                let (onto, gap) = nearest(x, thickness);
                let is_inside = is_outside && gap < -1e-9;
                let wanted = if is_inside { onto } else { x };
                assert!((0..3).all(|d| (now[d] - wanted[d]).abs() < 2e-10), "{shape:?}: {x:?} to {now:?}, not {wanted:?}");
                moved += usize::from(is_inside);
            }
            assert!((1..60).contains(&moved), "{shape:?}: {moved}");
            let lines = begin.overview().initial_penetrations;
            let inside: Vec<usize> =
                lines.iter().filter(|line| line.contains("it was pushed out")).map(|line| count_inside(line)).collect();
            assert_eq!(inside, [moved], "{lines:?}");
            // Nothing is strained, and nothing is pressed.
            let end = to_end(&model);
            let summary = end.summary();
            // Facets cut into what is round and whole: √2 times 25 mm is a chord of its circle.
            let is_whole = matches!(shape, ObstacleShape::Sphere { hollow: false, .. } | ObstacleShape::Cylinder { hollow: false, .. });
            let most = if is_whole { 0.024 - (0.024_f64 * 0.024 - 0.5 * 0.025 * 0.025).sqrt() } else { 1e-9 };
            assert!(summary.penetration_max < most && summary.ledger_residual < 1e-12, "{shape:?}: {summary:?}");
            for column in ["energy.kinetic", "energy.internal", "energy.contact"] {
                assert!(value(&end, column).abs() < 1e-12, "{shape:?}: {column} {}", value(&end, column));
            }
        }
    }
}

#[test]
fn what_is_held_in_an_obstacle_of_3d_stays_there_and_is_reported() {
    let plane = || ObstacleShape::Plane { point: [0.0, 0.0, 0.003], normal: [0.0, 0.0, 1.0], length: None };
    let mut model = cube_in(plane(), 0.0, InitialPenetration::PushOut);
    model.constraints.push(Constraint { on: "cube".into(), velocity: [None, None, Some(0.0.into())], ..Constraint::default() });
    let reported = model_faults(&model);
    assert!(reported.iter().all(|fault| fault.path == "obstacle[0]"), "{reported:?}");
    let deep = reported.iter().find(|fault| fault.message.contains("3.000e-3 m inside")).expect("the lower side is");
    assert!(count_inside(&deep.message) >= 20, "{reported:?}");
    // Held across, nodes of a slanted plane go the longer way that they may.
    let slant = ObstacleShape::Plane { point: [0.0, 0.0, 0.003], normal: [0.6, 0.0, 0.8], length: None };
    let mut model = cube_in(slant, 0.0, InitialPenetration::PushOut);
    model.constraints.push(Constraint { on: "cube".into(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() });
    let positions = simulation(&model).frame().positions::<3>().to_vec();
    let corner = positions.iter().filter(|x| x[0] < 1e-12 && (x[2] - 0.003).abs() < 1e-9).count();
    assert_eq!(corner, 5, "{positions:?}");
}
