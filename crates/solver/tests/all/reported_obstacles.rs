//! What bodies do in rigid obstacles is held or reported: what lies between nodes, what is pressed too
//! softly, what goes through within a step; and contacts whose springs know nothing of overlaps, pinballs and
//! single passes, are looked at too.

use crate::bodies::{add, model, rectangle, simulation, touch};
use embate_solver::model::{
    Contact, Cuboid, Formulation, Friction, Interface, Model, Motion, Obstacle, ObstacleShape, Part, Penalty, Shape, TriangleSurface,
};
use embate_solver::output::Summary;
use embate_solver::simulation::Simulation;
use std::sync::Arc;

type Vector = [f64; 3];

fn brick(name: &str, corner: Vector, size: Vector, elements: [usize; 3], velocity: Vector) -> Part {
    let shape = Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() });
    Part { name: name.into(), material: "soft".into(), element: "hex8".into(), shape, velocity, ..Part::default() }
}

/// A plate of one layer of coarse elements that falls.
fn plate(end: f64, speed: f64) -> Model {
    let mut model = model(end);
    model.run.energy_limit = 1.0;
    model.parts.push(brick("plate", [-0.03, -0.03, 0.0], [0.06, 0.06, 0.01], [3, 3, 1], [0.0, 0.0, -speed]));
    model
}

fn soft() -> Interface {
    Penalty::automatic(1e-5).into()
}

/// Runs it, sees each step, and whether it ended before its end.
fn watch(model: &Model, mut see: impl FnMut(&Simulation)) -> (Summary, bool) {
    let (mut simulation, mut is_cut) = (simulation(model), false);
    while simulation.time() < model.run.end && !is_cut {
        is_cut = simulation.advance(f64::INFINITY, 1).is_err();
        see(&simulation);
    }
    (simulation.summary(), is_cut)
}

/// The nodes of the lower side of the plate, 4 x 4.
fn lower_side(model: &Model) -> Vec<usize> {
    let frame = simulation(model).frame();
    let initial = frame.positions::<3>();
    let at = |x: Vector| initial.iter().position(|node| (0..3).all(|d| (node[d] - x[d]).abs() < 1e-9)).unwrap();
    let of = |k: usize| -0.03 + 0.02 * k as f64;
    (0..16).map(|k| at([of(k % 4), of(k / 4), 0.0])).collect()
}

/// How deep it is in a solid at most, m, by 41 x 41 places on each of its facets.
fn deepest(simulation: &Simulation, nodes: &[usize], distance: impl Fn(Vector) -> f64) -> f64 {
    let frame = simulation.frame();
    let x = |i: usize, j: usize| frame.positions::<3>()[nodes[4 * j + i]];
    let mut deepest = f64::NEG_INFINITY;
    for (i, j) in (0..9).map(|facet| (facet % 3, facet / 3)) {
        let [a, b, c, d] = [x(i, j), x(i + 1, j), x(i + 1, j + 1), x(i, j + 1)];
        for (u, v) in (0..1681).map(|k| (f64::from(k % 41) / 40.0, f64::from(k / 41) / 40.0)) {
            let place = [0, 1, 2].map(|e| (1.0 - v) * ((1.0 - u) * a[e] + u * b[e]) + v * ((1.0 - u) * d[e] + u * c[e]));
            deepest = deepest.max(-distance(place));
        }
    }
    deepest
}

#[test]
fn a_ball_and_a_cylinder_that_come_in_between_nodes_are_held() {
    let down = -0.0032;
    let ball = ObstacleShape::Sphere { centre: [0.001, 0.0, down], radius: 0.003, hollow: false };
    let along = ObstacleShape::Cylinder { point: [0.001, 0.0, down], axis: [0.0, 1.0, 0.0], radius: 0.003, hollow: false };
    let to_ball = |[x, y, z]: Vector| ((x - 0.001).powi(2) + y * y + (z - down).powi(2)).sqrt() - 0.003;
    let to_axis = |[x, _, z]: Vector| ((x - 0.001).powi(2) + (z - down).powi(2)).sqrt() - 0.003;
    let distances: [&dyn Fn(Vector) -> f64; 2] = [&to_ball, &to_axis];
    for (shape, distance) in [ball, along].into_iter().zip(distances) {
        for speed in [1.0, 20.0] {
            let mut model = plate(1.5e-3 / speed * 2.0, speed);
            model.obstacles.push(Obstacle::fixed("tool", shape.clone()));
            let (mut most, nodes) = (f64::NEG_INFINITY, lower_side(&model));
            let (summary, is_cut) = watch(&model, |simulation| most = most.max(deepest(simulation, &nodes, distance)));
            assert!(!is_cut && summary.contact.unverified == 0 && summary.ledger_residual < 1e-11, "{shape:?} {speed}: {summary:?}");
            // It is met, and no deeper than a fifth of the obstacle's 6 mm; from a twentieth on the run knows
            // how deep, but for what a facet is bent and what comes between two looks.
            assert!(most > 2e-5 && most < 1.2e-3, "{shape:?} {speed}: {most}");
            let share = summary.penetration_max / most;
            assert!(most < 3e-4 || (0.7..1.05).contains(&share), "{shape:?} {speed}: {most} {share}");
        }
    }
}

#[test]
fn what_a_soft_spring_lets_into_an_obstacle_is_reported_and_ends_the_run() {
    let needle = {
        let (tip, base) = ([0.003, 0.001, -2e-4], [[-0.002, -0.002], [0.008, -0.002], [0.008, 0.006], [-0.002, 0.006]]);
        let base = base.map(|[x, y]| [x, y, -0.03]);
        let side = |k: usize| [base[k], base[(k + 1) % 4], tip];
        let triangles = [side(0), side(1), side(2), side(3), [base[0], base[2], base[1]], [base[0], base[3], base[2]]];
        ObstacleShape::Triangles(Arc::new(TriangleSurface::welded("needle.stl", &triangles)))
    };
    let shapes = [
        ObstacleShape::Plane { point: [0.0, 0.0, -2e-4], normal: [0.0, 0.0, 1.0], length: None },
        ObstacleShape::Sphere { centre: [0.001, 0.0, -0.0082], radius: 0.008, hollow: false },
        ObstacleShape::Sphere { centre: [0.0, 0.0, 1.0 - 2e-3], radius: 1.0, hollow: true },
        ObstacleShape::Cylinder { point: [0.0, 0.001, -0.0082], axis: [1.0, 0.0, 0.0], radius: 0.008, hollow: false },
        needle,
    ];
    for (number, shape) in shapes.into_iter().enumerate() {
        // Nothing is deeper in a ball than its radius.
        let has_end = ![1, 3].contains(&number);
        let mut model = plate(2e-3, 20.0);
        model.obstacles.push(Obstacle { interface: soft(), ..Obstacle::fixed("tool", shape.clone()) });
        let (summary, is_cut) = watch(&model, |_| {});
        assert!(summary.contact.unverified > 0 && is_cut == has_end, "{shape:?}: {summary:?}");
        let reported = summary.warnings.iter().map(|notice| notice.text.as_str()).collect::<String>();
        assert!(reported.contains("obstacle \"tool\"") && reported.contains("part \"plate\" in the obstacle"), "{reported}");
        // A limit of one's own counts alone.
        model.run.penetration_limit = Some(1.0);
        let (summary, is_cut) = watch(&model, |_| {});
        assert!(summary.contact.unverified > 0 && !is_cut, "{shape:?}: {summary:?}");
    }
}

#[test]
fn the_same_in_2d() {
    let square = |x: [f64; 2], size: f64| vec![x, [x[0], x[1] + size], [x[0] + size, x[1] + size], [x[0] + size, x[1]], x];
    let shapes = [
        ObstacleShape::Plane { point: [0.0, -2e-4, 0.0], normal: [0.0, 1.0, 0.0], length: None },
        ObstacleShape::Plane { point: [0.0, -2e-4, 0.0], normal: [0.0, 1.0, 0.0], length: Some(0.021) },
        ObstacleShape::Circle { centre: [0.001, -0.0062, 0.0], radius: 0.006, hollow: false },
        ObstacleShape::Circle { centre: [0.0, 1.0 - 8e-4, 0.0], radius: 1.0, hollow: true },
        ObstacleShape::Polyline { points: square([-0.009, -0.0202], 0.02) },
    ];
    for shape in shapes {
        let mut model = model(2e-3);
        model.run.energy_limit = 1.0;
        add(&mut model, "plate", rectangle([-0.03, 0.0], [0.06, 0.01], [3, 1]), [0.0, -20.0]);
        model.obstacles.push(Obstacle { interface: soft(), ..Obstacle::fixed("tool", shape.clone()) });
        let (summary, is_cut) = watch(&model, |_| {});
        let is_round = matches!(shape, ObstacleShape::Circle { hollow: false, .. });
        assert!(summary.contact.unverified > 0 && (is_cut || is_round), "{shape:?}: {summary:?}");
        model.obstacles[0].interface = Interface::default();
        let (summary, is_cut) = watch(&model, |_| {});
        assert!(summary.contact.unverified == 0 && !is_cut, "{shape:?}: {summary:?}");
    }
}

#[test]
fn what_goes_through_a_ball_within_a_step_is_reported() {
    let speck = |speed: f64, aside: f64| {
        let mut model = model(3e-6);
        model.run.energy_limit = 1.0;
        model.parts.push(brick("speck", [aside, -5e-4, 2e-3], [1e-3; 3], [2, 2, 2], [0.0, 0.0, -speed]));
        let ball = ObstacleShape::Sphere { centre: [0.0, 0.0, -2e-3], radius: 2e-3, hollow: false };
        model.obstacles.push(Obstacle::fixed("pin", ball));
        let dt = simulation(&model).time_step();
        model.run.end = 10.0 * dt;
        (watch(&model, |_| {}).0.contact.unverified, speed * dt)
    };
    let (reported, way) = speck(1e5, -5e-4);
    assert!(reported > 0 && way > 3e-3, "{reported} {way}");
    // Beside it there is nothing.
    assert_eq!(speck(1e5, 3e-3).0, 0);
}

#[test]
fn pinballs_and_single_passes_are_looked_at() {
    for formulation in [Formulation::Pinball, Formulation::SinglePass { slave: 0 }, Formulation::DoublePass] {
        for (scale, is_reported) in [(1e-6, true), (1.0, false)] {
            let mut model = plate(1e-3, 10.0);
            model.parts.push(brick("floor", [-0.04, -0.04, -0.0202], [0.08, 0.08, 0.02], [5, 5, 2], [0.0; 3]));
            let interface = Penalty::automatic(scale).into();
            model.contacts.push(Contact { formulation, interface, ..Contact::between("c", "plate", "floor") });
            let (summary, _) = watch(&model, |_| {});
            assert_eq!(summary.contact.unverified > 0, is_reported, "{formulation:?} in 3D: {summary:?}");
        }
        for (scale, is_reported) in [(1e-6, true), (1.0, false)] {
            let mut model = crate::bodies::model(1e-3);
            model.run.energy_limit = 1.0;
            add(&mut model, "plate", rectangle([-0.03, 0.0], [0.06, 0.01], [6, 1]), [0.0, -10.0]);
            add(&mut model, "floor", rectangle([-0.04, -0.0202], [0.08, 0.02], [9, 2]), [0.0, 0.0]);
            touch(&mut model, "plate", "floor");
            (model.contacts[0].formulation, model.contacts[0].interface) = (formulation, Penalty::automatic(scale).into());
            let (summary, _) = watch(&model, |_| {});
            assert_eq!(summary.contact.unverified > 0, is_reported, "{formulation:?} in the plane: {summary:?}");
        }
    }
}

#[test]
fn ties_in_3d_are_looked_at() {
    // The plate is glued to the floor below it, too softly, well, and until it is torn off.
    for (scale, strength, is_reported) in [(1e-6, f64::INFINITY, true), (1.0, f64::INFINITY, false), (1.0, 1e5, false)] {
        let mut model = plate(1e-3, 10.0);
        model.parts.push(brick("floor", [-0.04, -0.04, -0.0202], [0.08, 0.08, 0.02], [5, 5, 2], [0.0; 3]));
        let interface = Penalty::automatic(scale).into();
        model.contacts.push(Contact { tied: Some(strength), interface, ..Contact::between("glue", "plate", "floor") });
        let (summary, _) = watch(&model, |_| {});
        assert_eq!(summary.contact.unverified > 0, is_reported, "{scale} {strength}: {summary:?}");
    }
}

#[test]
fn a_free_ball_between_nodes_keeps_both_momenta_with_friction() {
    let mut model = plate(4e-4, 10.0);
    let friction = Friction { coefficient: 0.4, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    let ball = ObstacleShape::Sphere { centre: [0.002, 0.001, -0.0032], radius: 0.003, hollow: false };
    model.obstacles.push(Obstacle {
        motion: Motion::default(),
        mass: Some(1e-3),
        inertia: Some(4e-9),
        interface: Interface { friction: Some(friction), ..Interface::default() },
        velocity: [1.0, 0.5, 0.0],
        ..Obstacle::fixed("ball", ball)
    });
    let (summary, is_cut) = watch(&model, |_| {});
    assert!(!is_cut && summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-11, "{summary:?}");
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.02 && summary.penetration_max > 1e-5, "{summary:?}");
}
