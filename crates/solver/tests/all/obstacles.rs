//! Obstacles: planes, circles and polylines that are fixed, driven or free; what goes through them, and
//! bodies behind them at the start.

use crate::bodies::*;
use embate_solver::model::{
    Constraint, Curve, Disk, Drive, InitialPenetration, Interface, Motion, Obstacle, ObstacleShape, Penalty, Shape, Symmetry,
};

#[test]
fn a_free_plane_that_is_hit_keeps_both_momenta_and_the_energy() {
    let mut model = model(4e-3);
    add(&mut model, "ball", Shape::Disk(Disk { centre: [0.02, 0.0], radius: 0.03, elements: 4 }), [0.0, -12.0]);
    model.obstacles.push(Obstacle {
        motion: Motion::default(),
        mass: Some(4.0),
        inertia: Some(0.02),
        spin: 2.0,
        interface: rough(0.2),
        ..Obstacle::fixed("plate", ObstacleShape::Plane { point: [0.0, -0.031, 0.0], normal: [0.0, 1.0, 0.0], length: Some(0.2) })
    });
    let simulation = to_end(&model);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{summary:?}");
    assert!(value(&simulation, "obstacle.vy[plate]") < -1.0 && value(&simulation, "obstacle.spin[plate]") < 1.0, "it was hit on the right");
}

#[test]
fn a_driven_plane_gives_a_block_the_energy_that_is_found_in_it() {
    let mut model = model(2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [8, 4]), [0.0, 0.0]);
    model.constraints.push(Constraint {
        on: "block.bottom".into(),
        velocity: [Some(0.0.into()), Some(0.0.into()), None],
        ..Constraint::default()
    });
    model.curves.insert("press".into(), Curve::table(vec![0.0, 1e-3], vec![0.0, -2.0]));
    let mut motion = Motion::fixed();
    motion.velocity[1] = Some(Drive::Curve("press".into()));
    model.obstacles.push(Obstacle { motion, ..Obstacle::wall("press", [0.02, 0.05], [0.0, -1.0]) });
    let (simulation, history) = run(&model);
    // 1 mm while it speeds up, 2 mm after it.
    assert!((history.last("obstacle.y[press]") - (0.05 - 3e-3)).abs() < 1e-15, "{}", history.last("obstacle.y[press]"));
    assert_eq!((history.last("obstacle.x[press]"), history.last("obstacle.vy[press]")), (0.02, -2.0));
    let energy = |name: &str| history.last(&format!("energy.{name}"));
    assert!(energy("external") > 10.0 && (energy("total") / energy("external")).abs() < 2e-3, "{}", energy("total"));
    assert!((energy("kinetic") + energy("internal") + energy("contact")) / energy("external") > 0.999);
    assert!(simulation.summary().ledger_residual < 1e-12);
    // By the column of forces: ∫ F v dt with F the force on the block.
    let (force, time, v) = (history.column("obstacle.force_y[press]"), history.column("time"), history.column("obstacle.vy[press]"));
    let work: f64 = (1..time.len()).map(|k| 0.5 * (time[k] - time[k - 1]) * (force[k] * v[k] + force[k - 1] * v[k - 1])).sum();
    assert!((work / energy("external") - 1.0).abs() < 0.01, "{work} {}", energy("external"));
    // The block is pressed symmetrically: with respect to the plane's point its middle has an arm of 30 mm.
    let (moment, last) = (history.last("obstacle.moment[press]"), *force.last().unwrap());
    assert!((moment / (0.03 * last) - 1.0).abs() < 1e-3, "{moment} {last}");
}

#[test]
fn a_circle_is_pressed_into_a_block_and_comes_out_again_with_nothing_lost() {
    // Large beside the elements, and smaller than one of them.
    for (radius, elements) in [(0.04, [24, 10]), (0.004, [9, 4])] {
        let mut model = model(2e-3);
        add(&mut model, "block", rectangle([-0.06, -0.05], [0.12, 0.05], elements), [0.0, 0.0]);
        model.constraints.push(Constraint {
            on: "block.bottom".into(),
            velocity: [Some(0.0.into()), Some(0.0.into()), None],
            ..Constraint::default()
        });
        model.obstacles.push(Obstacle {
            motion: Motion { velocity: [Some(0.0.into()), None, None], spin: Some(0.0.into()) },
            mass: Some(10.0),
            velocity: [0.0, -4.0, 0.0],
            ..Obstacle::fixed("ball", ObstacleShape::Circle { centre: [0.0, radius + 1e-4, 0.0], radius, hollow: false })
        });
        let (simulation, history) = run(&model);
        let deepest = history.column("obstacle.y[ball]").into_iter().fold(f64::INFINITY, f64::min) - radius;
        assert!(deepest < -5e-4, "{radius}: {deepest}");
        assert!(history.last("obstacle.vy[ball]") > 2.0, "{radius}: it comes back with {}", history.last("obstacle.vy[ball]"));
        assert!(history.column("obstacle.force_x[ball]").iter().all(|f| f.abs() < 1.0), "{radius}");
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{radius}: {summary:?}");
        // Between the nodes it does not go in deeper than at them.
        assert!(summary.penetration_max < 2e-3, "{radius}: {}", summary.penetration_max);
    }
}

#[test]
fn a_free_circle_in_a_hollow_one_keeps_momenta_and_energy() {
    let mut model = model(6e-3);
    add(&mut model, "ball", Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.03, elements: 4 }), [12.0, 5.0]);
    let free = |name: &str, shape: ObstacleShape, mass: f64| Obstacle {
        motion: Motion::default(),
        mass: Some(mass),
        inertia: Some(0.01 * mass),
        interface: rough(0.3),
        ..Obstacle::fixed(name, shape)
    };
    model.obstacles.push(free("drum", ObstacleShape::Circle { centre: [0.0, 0.0, 0.0], radius: 0.08, hollow: true }, 5.0));
    model.obstacles.push(free("pin", ObstacleShape::Circle { centre: [0.05, 0.05, 0.0], radius: 0.005, hollow: false }, 0.5));
    model.obstacles[1].spin = 300.0;
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.02, "{summary:?}");
    for body in ["drum", "pin"] {
        assert!(history.column(&format!("obstacle.force_x[{body}]")).iter().any(|f| f.abs() > 0.0), "{body} was hit");
    }
    let [x, y] = ["x", "y"].map(|d| history.last(&format!("ball.{d}")) - history.last(&format!("obstacle.{d}[drum]")));
    assert!(x.hypot(y) < 0.052, "it stays inside");
}

#[test]
fn a_free_circle_without_friction_gets_no_spin() {
    // Of a node that it meets with its outside or inside, and of segments that it meets with its edge; soft
    // and stiff.
    for (radius, scale) in [(0.04, 1.0), (0.04, 1e3), (0.004, 1.0), (0.004, 100.0), (-0.12, 1.0), (-0.12, 100.0)] {
        let mut model = model(2e-3);
        model.run.energy_limit = 0.1;
        add(&mut model, "block", rectangle([-0.06, -0.05], [0.12, 0.05], [9, 4]), [3.0, 0.0]);
        model.parts[0].spin = 10.0;
        let shape = if radius > 0.0 {
            ObstacleShape::Circle { centre: [0.0123, radius + 1e-4, 0.0], radius, hollow: false }
        } else {
            ObstacleShape::Circle { centre: [0.0, 0.05, 0.0], radius: -radius, hollow: true }
        };
        model.obstacles.push(Obstacle {
            motion: Motion::default(),
            mass: Some(2.0),
            inertia: Some(1e-3),
            velocity: [0.0, if radius > 0.0 { -4.0 } else { 8.0 }, 0.0],
            interface: Penalty::automatic(scale).into(),
            ..Obstacle::fixed("ball", shape)
        });
        let (simulation, history) = run(&model);
        assert!(history.column("obstacle.force_y[ball]").iter().any(|f| f.abs() > 1e3), "{radius} {scale}: it was hit");
        // Impulse times rounding of the arm, over the inertia.
        let spin = history.column("obstacle.spin[ball]").into_iter().map(f64::abs).fold(0.0, f64::max);
        assert!(spin < 1e-9, "{radius} {scale}: {spin:e}");
        let summary = simulation.summary();
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    }
}

#[test]
fn a_polyline_has_convex_and_concave_corners() {
    // A ridge (nodes do not see its tip) under the middle of coarse elements, and a valley that holds a ball.
    let mut model = model(4e-3);
    add(&mut model, "plank", rectangle([-0.05, 0.011], [0.1, 0.03], [5, 2]), [0.0, -8.0]);
    add(&mut model, "ball", Shape::Disk(Disk { centre: [0.2, 0.04], radius: 0.02, elements: 4 }), [0.0, -8.0]);
    let points = vec![[-0.3, 0.0], [-0.005, 0.0], [0.0, 0.01], [0.005, 0.0], [0.1, 0.0], [0.1, 0.1], [0.2, 0.0], [0.3, 0.1]];
    model.obstacles.push(Obstacle::fixed("ground", ObstacleShape::Polyline { points }));
    model.obstacles[0].parts = vec!["plank".into(), "ball".into()];
    let (simulation, history) = run(&model);
    let lowest = |column: &str| history.column(column).into_iter().fold(f64::INFINITY, f64::min);
    assert!(history.last("plank.vy") > 4.0 && history.last("ball.vy") > 4.0, "{} {}", history.last("plank.vy"), history.last("ball.vy"));
    assert!(history.last("plank.vx").abs() < 0.05 && history.last("ball.vx").abs() < 0.05);
    assert!(lowest("plank.y") > 0.02, "the tip holds the plank: {}", lowest("plank.y"));
    assert!(lowest("ball.y") > 0.02 * std::f64::consts::SQRT_2 - 4e-3, "{}", lowest("ball.y"));
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{summary:?}");
    assert!(summary.penetration_max < 2e-3, "{}", summary.penetration_max);
}

#[test]
fn the_end_of_a_plane_stops_a_segment_between_its_nodes() {
    // A plate on edge under the middle of the only segment of a block: no node of the block comes near its
    // plane. Fixed, and free with friction and a thickness.
    let plate = ObstacleShape::Plane { point: [0.0, -0.101, 0.0], normal: [1.0, 0.0, 0.0], length: Some(0.2) };
    for (free, friction, thickness) in [(false, 0.0, 0.0), (true, 0.0, 0.0), (true, 0.3, 0.0), (false, 0.0, 5e-4)] {
        let mut model = model(3e-3);
        add(&mut model, "block", rectangle([-0.051, 0.0], [0.1, 0.1], [1, 1]), [0.0, -5.0]);
        let interface = Interface { thickness, ..rough(friction) };
        let fixed = Obstacle { interface, ..Obstacle::fixed("plate", plate.clone()) };
        let loose = Obstacle { motion: Motion::default(), mass: Some(20.0), inertia: Some(0.1), ..fixed.clone() };
        model.obstacles.push(if free { loose } else { fixed });
        let (simulation, history) = run(&model);
        let lowest = history.column("block.y").into_iter().fold(f64::INFINITY, f64::min);
        let way = if free { 0.012 } else { 0.004 };
        assert!(lowest > 0.05 - way, "{free} {friction} {thickness}: {lowest}");
        let rebound = history.last("block.vy") - if free { history.last("obstacle.vy[plate]") } else { 0.0 };
        assert!(rebound > 2.0, "{free} {friction} {thickness}: {rebound}");
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{free} {friction} {thickness}: {summary:?}");
        assert!(summary.penetration_max < 2e-3 && summary.contact.unverified == 0, "{summary:?}");
        if free {
            assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
        }
        // A plate that begins in the block is reported, and pushed out of it.
        model.parts[0].shape = rectangle([-0.051, -0.003], [0.1, 0.1], [1, 1]);
        let reported = faults(&model);
        assert!(reported.len() == 1 && reported[0].contains("obstacle[0]") && reported[0].contains("inside"), "{reported:?}");
        model.obstacles[0].interface.initial_penetration = InitialPenetration::PushOut;
        model.parts[0].velocity = [0.0; 3];
        let moved = to_end(&model);
        assert!(moved.summary().penetration_max < 1e-9 && moved.ledger().stores.total() < 1e-6, "{:?}", moved.summary());
    }
}

#[test]
fn a_plane_that_ends_at_or_beyond_a_symmetry_line_continues_there() {
    // Half of a block on half of a plate, and on a whole one, as a whole block on a whole plate.
    let plate = |from: f64, to: f64| ObstacleShape::Plane {
        point: [0.5 * (from + to), -1e-4, 0.0],
        normal: [0.0, 1.0, 0.0],
        length: Some(to - from),
    };
    let outcome = |from: f64, shape: ObstacleShape| {
        let mut model = model(1e-3);
        let elements = if from < 0.0 { 12 } else { 6 };
        add(&mut model, "block", rectangle([from, 0.0], [0.06 - from, 0.05], [elements, 5]), [0.0, -5.0]);
        if from == 0.0 {
            model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
        }
        model.obstacles.push(Obstacle { interface: Penalty::PerNode(1e9).into(), ..Obstacle::fixed("plate", shape) });
        let (simulation, history) = run(&model);
        assert!(simulation.summary().energy_drift < 0.01, "{:?}", simulation.summary());
        history.last("block.y")
    };
    let whole = outcome(-0.06, plate(-0.04, 0.04));
    for half in [outcome(0.0, plate(0.0, 0.04)), outcome(0.0, plate(-0.04, 0.04))] {
        assert!((half - whole).abs() < 1e-9, "{half} {whole}");
    }
}

#[test]
fn a_free_polyline_keeps_both_momenta_and_moves_with_its_outline() {
    let mut model = model(3e-3);
    add(&mut model, "ball", Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.03, elements: 4 }), [15.0, 2.0]);
    // A square, clockwise.
    let points = vec![[0.035, -0.02], [0.035, 0.02], [0.075, 0.02], [0.075, -0.02], [0.035, -0.02]];
    model.obstacles.push(Obstacle {
        motion: Motion::default(),
        mass: Some(2.0),
        inertia: Some(1e-3),
        spin: -20.0,
        interface: rough(0.2),
        ..Obstacle::fixed("box", ObstacleShape::Polyline { points })
    });
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{summary:?}");
    assert!(history.last("obstacle.vx[box]") > 5.0);
    let frame = simulation.frame();
    let points = &frame.outlines[0].points;
    let (s, c) = history.last("obstacle.angle[box]").sin_cos();
    let wanted = [history.last("obstacle.x[box]") - 0.02 * c + 0.02 * s, history.last("obstacle.y[box]") - 0.02 * s - 0.02 * c];
    assert!((points[0][0] - wanted[0]).abs() < 1e-14 && (points[0][1] - wanted[1]).abs() < 1e-14 && points[4] == points[0]);
    assert_eq!(frame.positions::<2>().len(), summary.nodes, "corners of obstacles are no nodes of results");
}

#[test]
fn nothing_goes_through_a_thin_obstacle_at_any_speed() {
    // A speck that moves by many times its size and the obstacle's per step; the step is that of its
    // elements.
    let speck = |velocity: [f64; 2]| {
        let mut model = model(6e-6);
        add(&mut model, "speck", rectangle([-5e-4, -5e-4], [1e-3, 1e-3], [2, 2]), velocity);
        // Stiff springs on a round pin, a third of its radius per step and more, do not close to the last
        // digit.
        model.run.energy_limit = 0.15;
        // It is meant to come in by many of its elements.
        model.run.penetration_limit = Some(1.0);
        // It does not turn: hit off its centre it would, by whole turns per step.
        stiffen(&mut model, "speck", driven([None, None], Some(0.0)));
        model
    };
    let hard = |name: &str, shape| Obstacle { interface: Penalty::automatic(100.0).into(), ..Obstacle::fixed(name, shape) };
    let pin = |x: f64, y: f64| hard("pin", ObstacleShape::Circle { centre: [x, y, 0.0], radius: 2e-3, hollow: false });
    let plate =
        |length: f64| hard("plate", ObstacleShape::Plane { point: [0.1, 0.0, 0.0], normal: [-1.0, 0.0, 0.0], length: Some(length) });
    let dt = simulation(&speck([0.0; 2])).time_step();
    for speed in [1e3, 2.5e3, 5e3, 1e4, 1e5, 3e5] {
        assert!(speed < 5e4 || speed * dt > 0.025, "{dt}");
        let mut model = speck([speed, 0.0]);
        model.run.end = 0.3 / speed;
        model.run.end = model.run.end.max(8.0 * dt);
        for obstacle in [plate(0.05), pin(0.1, 0.0), pin(0.1, 1e-3)] {
            let name = obstacle.name.clone();
            model.obstacles = vec![obstacle];
            let (simulation, history) = run(&model);
            assert!(history.last("speck.vx") < 0.0, "{speed} {name}: {}", history.last("speck.vx"));
            assert!(
                simulation.summary().energy_drift < if name == "plate" { 1e-10 } else { 0.1 },
                "{speed} {name}: {}",
                simulation.summary().energy_drift
            );
        }
        // Beside the plate and beside the pin there is nothing; ends of a plate are seen ahead by the way of
        // a step.
        let beside = 0.02 + speed * dt;
        for obstacle in [
            Obstacle {
                shape: ObstacleShape::Plane { point: [0.1, beside, 0.0], normal: [-1.0, 0.0, 0.0], length: Some(0.03) },
                ..plate(0.0)
            },
            pin(0.1, 3e-3),
        ] {
            model.obstacles = vec![obstacle];
            let name = model.obstacles[0].name.clone();
            let after = run(&model).1.last("speck.vx");
            assert!((after - speed).abs() < 1e-9 * speed, "{speed} {name}: {after}");
        }
        // Nor is there from behind a plate; and what moves may be the obstacle.
        model.obstacles = vec![Obstacle {
            shape: ObstacleShape::Plane { point: [0.1, 0.0, 0.0], normal: [1.0, 0.0, 0.0], length: Some(0.05) },
            ..plate(0.0)
        }];
        assert_eq!(run(&model).1.last("speck.vx"), speed);
        model.parts[0].velocity = [0.0; 3];
        for obstacle in [plate(0.05), pin(0.1, 1e-3)] {
            model.obstacles = vec![Obstacle { motion: driven([Some(-speed), Some(0.0)], Some(0.0)), ..obstacle }];
            let (_, history) = run(&model);
            assert!(history.last("speck.vx") < -0.5 * speed, "{speed}: {}", history.last("speck.vx"));
        }
    }
}

#[test]
fn what_is_behind_an_obstacle_at_the_start_is_refused_ignored_or_pushed_out() {
    let shapes = [
        ObstacleShape::Plane { point: [0.0, 0.002, 0.0], normal: [0.0, 1.0, 0.0], length: None },
        ObstacleShape::Plane { point: [0.05, 0.002, 0.0], normal: [0.0, 1.0, 0.0], length: Some(0.2) },
        ObstacleShape::Circle { centre: [0.05, -0.1, 0.0], radius: 0.102, hollow: false },
        ObstacleShape::Circle { centre: [0.05, 0.1, 0.0], radius: 0.105, hollow: true },
        ObstacleShape::Polyline { points: vec![[-0.1, 0.002], [0.2, 0.002]] },
    ];
    for shape in shapes {
        let mut model = model(2e-4);
        add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [8, 4]), [0.0, 0.0]);
        model.obstacles.push(Obstacle::fixed("floor", shape.clone()));
        let reported = faults(&model);
        assert!(
            !reported.is_empty() && reported.iter().all(|fault| fault.contains("obstacle[0]") && fault.contains("inside")),
            "{shape:?}: {reported:?}"
        );

        model.obstacles[0].interface.initial_penetration = InitialPenetration::Ignore;
        let ignored = to_end(&model);
        assert!(!ignored.overview().initial_penetrations.is_empty());
        assert_eq!((value(&ignored, "block.vy"), ignored.ledger().stores.contact), (0.0, 0.0), "{shape:?}");
        // What is pressed further is resisted.
        model.parts[0].velocity = [0.0, -2.0, 0.0];
        let pressed = to_end(&model);
        assert!(value(&pressed, "block.vy") > -1.8 && pressed.summary().energy_drift < 0.02, "{shape:?}: {}", value(&pressed, "block.vy"));

        model.parts[0].velocity = [0.0; 3];
        model.obstacles[0].interface.initial_penetration = InitialPenetration::PushOut;
        let moved = to_end(&model);
        let reported = moved.overview().initial_penetrations;
        assert!(reported.iter().all(|line| line.contains("floor") && line.contains("pushed out")) && !reported.is_empty(), "{reported:?}");
        assert!(moved.summary().penetration_max < 1e-9 && moved.ledger().stores.total() < 1e-6, "{shape:?}: {:?}", moved.ledger().stores);
    }
}

#[test]
fn a_block_that_ends_flush_with_a_polyline_is_held_at_its_corners() {
    for wider in [0.0, 1e-9, -1e-9, 2e-4] {
        let mut model = slender(8e-5, 1e9, 1e3);
        add(&mut model, "block", rectangle([-wider, 5e-5], [0.1 + 2.0 * wider, 0.05], [5, 3]), [0.0, -10.0]);
        let points = vec![[0.0, -0.05], [0.0, 0.0], [0.1, 0.0], [0.1, -0.05]];
        model.obstacles.push(Obstacle::fixed("table", ObstacleShape::Polyline { points }));
        probe(&mut model, "end", "block", [0.1 + wider, 5e-5]);
        probe(&mut model, "middle", "block", [0.06 * (1.0 + 20.0 * wider) - wider, 5e-5]);
        let (simulation, history) = run(&model);
        let lowest = |name: &str| history.column(name).into_iter().fold(f64::INFINITY, f64::min);
        let summary = simulation.summary();
        // Without the table the corner falls to -7.5e-4.
        let what = format!("{wider}: {} {} {summary:?}", lowest("end.y"), lowest("middle.y"));
        assert!(lowest("middle.y") < -1e-4 && lowest("end.y") > 1.2 * lowest("middle.y"), "{what}");
        assert!(summary.energy_drift < 5e-3 && summary.ledger_residual < 1e-12 && summary.contact.unverified == 0, "{wider}: {summary:?}");
    }
}
