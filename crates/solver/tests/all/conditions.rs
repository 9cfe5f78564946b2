//! Prescribed motion, symmetry, walls and gravity through the public face.

use crate::bodies::*;
use embate_solver::error::Error;
use embate_solver::model::{Axis, Constraint, Curve, CurveShape, Drive, Load, Model, Obstacle, Penalty, Ring, Rotation, Shape, Symmetry};

fn fix(model: &mut Model, on: &str, velocity: [Option<f64>; 2]) {
    model.constraints.push(Constraint {
        on: on.into(),
        velocity: embate_solver::model::in_3d(velocity.map(|velocity| velocity.map(Into::into))),
        ..Constraint::default()
    });
}

#[test]
fn nodes_on_a_symmetry_line_stay_exactly_on_it() {
    let mut model = model(2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.06], [6, 4]), [0.0, -15.0]);
    add(&mut model, "floor", rectangle([0.0, -0.051], [0.2, 0.05], [10, 3]), [0.0, 0.0]);
    touch(&mut model, "block", "floor");
    model.symmetries.push(Symmetry { normal: [3.0, 0.0, 0.0], ..Symmetry::default() });
    let mut simulation = simulation(&model);
    let start = simulation.frame().positions::<2>().to_vec();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let end = simulation.frame().positions::<2>().to_vec();
    let on_line: Vec<usize> = (0..start.len()).filter(|&i| start[i][0] == 0.0).collect();
    assert_eq!(on_line.len(), 5 + 4);
    assert!(on_line.iter().all(|&i| end[i][0] == 0.0));
    assert!(on_line.iter().any(|&i| (end[i][1] - start[i][1]).abs() > 1e-3), "they slide along it");
    assert!(simulation.ledger().stores.elastic > 0.0 && simulation.summary().energy_drift < 0.02);
    assert!(simulation.ledger().works.constraint.abs() < 1e-20, "a symmetry line does no work");
}

#[test]
fn a_skew_symmetry_line_is_as_good_as_a_straight_one() {
    // The same body and line, turned by 30 degrees: a wedge flies along the line towards a wall across it.
    let run = |angle: f64| {
        let (s, c) = angle.sin_cos();
        let turn = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
        let mut model = model(8e-4);
        let mesh = mapped([6, 4], |u, v| turn([0.08 * u, v * (0.03 + 0.02 * u)]));
        add_mesh(&mut model, "wedge", mesh, turn([-20.0, 0.0]));
        model.symmetries.push(Symmetry { normal: embate_solver::model::in_3d(turn([0.0, 1.0])), ..Symmetry::default() });
        model.obstacles.push(Obstacle::wall("end", turn([-0.001, 0.0]), turn([1.0, 0.0])));
        let mut simulation = simulation(&model);
        let on_line: Vec<usize> = (0..35).filter(|&i| across(simulation.frame().positions::<2>()[i], angle).abs() < 1e-15).collect();
        assert_eq!(on_line.len(), 7);
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let positions = simulation.frame().positions::<2>().to_vec();
        assert!(on_line.iter().all(|&i| across(positions[i], angle).abs() < 1e-15));
        assert!(simulation.summary().penetration_max > 0.0);
        positions.into_iter().map(move |[x, y]| [c * x + s * y, c * y - s * x]).collect::<Vec<_>>()
    };
    let (straight, skew) = (run(0.0), run(std::f64::consts::FRAC_PI_6));
    let worst = straight.iter().flatten().zip(skew.iter().flatten()).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
    assert!(worst < 1e-12, "{worst}");
}

fn across([x, y]: [f64; 2], angle: f64) -> f64 {
    angle.cos() * y - angle.sin() * x
}

#[test]
fn two_symmetry_lines_with_one_normal_do_not_swallow_what_lies_between() {
    // A bar one element high between two lines: its end is a segment with a node on each.
    let mut model = model(3e-4);
    for (name, x, speed) in [("left", -0.1005, 10.0), ("right", 0.0005, -10.0)] {
        add(&mut model, name, rectangle([x, 0.0], [0.1, 0.01], [20, 1]), [speed, 0.0]);
    }
    for y in [0.0, 0.01] {
        model.symmetries.push(Symmetry { point: [0.0, y, 0.0], normal: [0.0, 1.0, 0.0], ..Symmetry::default() });
    }
    touch(&mut model, "left", "right");
    let (simulation, history) = run(&model);
    assert!(history.last("left.vx") < -9.0 && history.last("right.vx") > 9.0, "{} {}", history.last("left.vx"), history.last("right.vx"));
    assert!(simulation.summary().energy_drift < 0.01);
}

#[test]
fn fixed_sides_stay_and_driven_sides_move_as_given() {
    let mut model = model(5e-4);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [8, 4]), [0.0, 0.0]);
    fix(&mut model, "block.left", [Some(0.0), Some(0.0)]);
    fix(&mut model, "block.right", [Some(3.0), None]);
    let mut simulation = simulation(&model);
    let start = simulation.frame().positions::<2>().to_vec();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let end = simulation.frame().positions::<2>().to_vec();
    for (a, b) in start.iter().zip(&end) {
        if a[0] == 0.0 {
            assert_eq!(a, b);
        }
        if a[0] == 0.1 {
            assert!((b[0] - a[0] - 3.0 * 5e-4).abs() < 1e-15, "{a:?} {b:?}");
        }
    }
    let moved = |i: usize| (end[i][1] - start[i][1]).abs();
    assert!((0..start.len()).filter(|&i| start[i][0] == 0.1).any(|i| moved(i) > 1e-6), "free across");
    // What the drive gave is in the block.
    let ledger = simulation.ledger();
    assert!(ledger.external > 0.0 && simulation.summary().energy_drift < 0.01, "{ledger:?}");
    assert!(simulation.summary().ledger_residual < 1e-12);
    assert_eq!(simulation.summary().momentum_drift_linear, None);
}

#[test]
fn contradictions_are_reported_with_condition_and_place() {
    let mut model = model(1e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [2, 1]), [0.0, 0.0]);
    fix(&mut model, "block.left", [Some(1.0), None]);
    fix(&mut model, "block.top", [Some(0.0), Some(0.0)]);
    let reported = faults(&model);
    assert_eq!(reported.len(), 1, "only the corner is in both: {reported:?}");
    for word in ["constraint[1]", "(0.000000e0, 5.000000e-2)", "0 m/s", "constraint[0] on \"block.left\" already moves it at 1 m/s"] {
        assert!(reported[0].contains(word), "{word}: {reported:?}");
    }
    // The same velocity twice is no contradiction, nor is another direction.
    model.constraints[1].velocity = [Some(1.0.into()), Some(0.0.into()), None];
    assert_eq!(faults(&model), Vec::<String>::new());
    // A symmetry line and a drive across it; where nothing lies on a line; a name of nothing.
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    let reported = faults(&model);
    assert!(reported.iter().any(|fault| fault.contains("constraint[0]") && fault.contains("(0.000000e0, 0.000000e0)")), "{reported:?}");
    model.symmetries[0].point = [0.03, 0.0, 0.0];
    assert!(faults(&model)[0].contains("no node lies on this symmetry line"), "{:?}", faults(&model));
}

#[test]
fn of_many_contradictions_twenty_are_reported_and_the_others_counted() {
    let mut model = model(1e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [2, 30]), [0.0, 0.0]);
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    fix(&mut model, "block.left", [Some(1.0), None]);
    let reported = faults(&model);
    assert_eq!(reported.len(), 21);
    assert!(
        reported[0].contains("but symmetry[0] already moves it at 0 m/s there") && reported[20].contains("at 11 more nodes"),
        "{reported:?}"
    );
}

#[test]
fn a_node_that_is_led_around_a_point_is_moved_by_nothing_else() {
    let mut model = model(1e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [2, 1]), [0.0, 0.0]);
    let turn = |on: &str| {
        let rotation = Some(Rotation { about: Axis::through([0.0; 2]), speed: 3.0.into() });
        Constraint { on: on.into(), rotation, ..Constraint::default() }
    };
    model.constraints.push(turn("block.left"));
    fix(&mut model, "block.top", [None, Some(0.0)]);
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("but constraint[0] on \"block.left\" leads it around a point"), "{reported:?}");
    model.constraints.reverse();
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("but constraint[0] on \"block.top\" already holds or moves it"), "{reported:?}");
    // The centre rests: to hold it is no contradiction.
    model.constraints = vec![turn("block.left")];
    fix(&mut model, "block.bottom", [None, Some(0.0)]);
    assert_eq!(faults(&model), Vec::<String>::new());
}

fn curve(model: &mut Model, name: &str, shape: CurveShape) -> Option<Drive> {
    model.curves.insert(name.into(), Curve::from(shape));
    Some(Drive::Curve(name.into()))
}

#[test]
fn displacements_and_accelerations_lead_nodes_where_they_say() {
    let end = 1e-3;
    let mut model = model(end);
    for (name, y) in [("smooth", 0.0), ("formula", 1.0), ("thrown", 2.0), ("pushed", 3.0)] {
        add(&mut model, name, rectangle([0.0, y], [0.02, 0.02], [2, 2]), [0.0, if y > 1.5 { 4.0 } else { 0.0 }]);
        model.constraints.push(Constraint { on: format!("{name}.top"), ..Constraint::default() });
    }
    let smooth = CurveShape::Table { times: vec![0.2e-3, 0.7e-3], values: vec![0.0, 3e-3], smooth: true };
    model.constraints[0].displacement[1] = curve(&mut model, "smooth", smooth);
    model.constraints[1].displacement[0] = curve(&mut model, "formula", CurveShape::Expression("1e-3*sin(pi*t/2e-3)".into()));
    model.constraints[2].acceleration = [Some(5e3.into()), Some((-8e3).into()), None];
    let push = curve(&mut model, "pushed", CurveShape::Table { times: vec![0.0, end], values: vec![0.0, 6e3], smooth: false });
    model.constraints[3].acceleration[1] = push;
    let mut simulation = simulation(&model);
    let start = simulation.frame().positions::<2>().to_vec();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let now = simulation.frame().positions::<2>().to_vec();
    let expected = [
        [None, Some(3e-3)],
        [Some(1e-3), None],
        [Some(0.5 * 5e3 * end * end), Some(4.0 * end - 0.5 * 8e3 * end * end)],
        [None, Some(4.0 * end + 6e3 * end * end / 6.0)],
    ];
    let mut seen = 0;
    for (a, b) in start.iter().zip(&now) {
        let which = a[1].floor() as usize;
        if a[1] - which as f64 > 0.0199 {
            for (d, wanted) in expected[which].iter().enumerate() {
                if let Some(wanted) = wanted {
                    assert!((b[d] - a[d] - wanted).abs() < 1e-15 + 1e-15 * a[1], "{which} {d}: {} {wanted}", b[d] - a[d]);
                    seen += 1;
                }
            }
        }
    }
    assert_eq!(seen, 15);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.01, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn nodes_that_are_led_around_a_point_turn_exactly() {
    // A ring whose inside is rotated by three and a half turns: a rigid rotation once it has begun so.
    let (speed, end): (f64, f64) = (700.0 * std::f64::consts::PI, 1e-2);
    let mut model = model(end);
    let ring = Shape::Ring(Ring {
        centre: [0.3, 0.1],
        inner: 0.02,
        outer: 0.03,
        from: 0.0,
        to: std::f64::consts::TAU,
        elements: [2, 24],
        ..Ring::default()
    });
    add(&mut model, "ring", ring, [0.0, 0.0]);
    model.parts[0].spin = speed;
    let rotation = Some(Rotation { about: Axis::through([0.3, 0.1]), speed: speed.into() });
    model.constraints.push(Constraint { on: "ring.inner".into(), rotation, ..Constraint::default() });
    let mut simulation = simulation(&model);
    let start = simulation.frame().positions::<2>().to_vec();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let mut inner = 0;
    for (a, b) in start.iter().zip(simulation.frame().positions::<2>()) {
        let arm = [a[0] - 0.3, a[1] - 0.1];
        if arm[0].hypot(arm[1]) < 0.0201 {
            inner += 1;
            let away = (b[0] - 0.3 - (-arm[0] * (speed * end).cos().abs())).hypot(b[1] - 0.1 + arm[1] * (speed * end).cos().abs());
            assert!(away < 5e-14, "{away:e}");
        }
    }
    assert_eq!(inner, 24);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn round_off_of_a_skew_line_is_no_contradiction() {
    let mut model = model(1e-5);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [2, 1]), [0.0, 0.0]);
    // As cos(90°) comes out of a program.
    model.symmetries.push(Symmetry { normal: [6.123_233_995_736_766e-17, 1.0, 0.0], ..Symmetry::default() });
    fix(&mut model, "block.bottom", [Some(1.0), Some(0.0)]);
    assert_eq!(faults(&model), Vec::<String>::new());
}

#[test]
fn gravity_acts_on_the_parts_it_names_and_on_their_share_of_common_nodes() {
    let mut model = model(1e-3);
    // From rest, the first step's drift is large as a fraction of next to nothing.
    model.run.energy_limit = 10.0;
    add(&mut model, "apple", rectangle([0.0, 0.0], [0.1, 0.1], [2, 2]), [0.0, 0.0]);
    add(&mut model, "moon", rectangle([1.0, 0.0], [0.1, 0.1], [2, 2]), [0.0, 0.0]);
    let mut mesh = mapped([4, 2], |u, v| [2.0 + 0.2 * u, 0.1 * v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    let (left, right): (Vec<_>, Vec<_>) = cells.into_iter().enumerate().partition(|(i, _)| i % 4 < 2);
    mesh.groups = [("left", left), ("right", right)].map(|(name, cells)| group(name, 2, cells.into_iter().map(|(_, cell)| cell))).into();
    add_groups(&mut model, mesh, &["left", "right"], [0.0, 0.0]);
    let gravity =
        |parts: &[&str], acceleration| Load::Gravity { parts: parts.iter().map(|p| (*p).to_string()).collect(), acceleration, curve: None };
    model.loads = vec![gravity(&["apple", "left"], [0.0, -10.0, 0.0]), gravity(&["apple"], [2.0, 0.0, 0.0])];
    let steps = every_step(&model);
    let velocity = |name: &str| ["vx", "vy"].map(|v| *steps.column(&format!("{name}.{v}")).last().unwrap());
    let time = model.run.end;
    let apple = velocity("apple");
    assert!((apple[0] - 2.0 * time).abs() < 1e-4 * time && (apple[1] + 10.0 * time).abs() < 1e-4 * time, "{apple:?}");
    assert_eq!(velocity("moon"), [0.0, 0.0]);
    // The bonded pair: only the left half is heavy, so the two together get half of it. Their probes share
    // the common nodes.
    let mut model = model.clone();
    model.parts.drain(..2);
    model.probes.clear();
    model.loads = vec![gravity(&["left"], [0.0, -10.0, 0.0])];
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let frame = simulation.frame();
    let velocities = &frame.fields.iter().find(|field| field.kind.name == "velocity").unwrap().values;
    let column = |x: f64| if (x - 2.0).abs() < 1e-6 || (x - 2.2).abs() < 1e-6 { 0.5 } else { 1.0 };
    let row = |y: f64| if (y - 0.05).abs() < 0.02 { 1.0 } else { 0.5 };
    let weigh = |i: usize| column(frame.positions::<2>()[i][0]) * row(frame.positions::<2>()[i][1]);
    let (mut mass, mut momentum) = (0.0, 0.0);
    for i in 0..frame.positions::<2>().len() {
        mass += weigh(i);
        momentum += weigh(i) * velocities[2 * i + 1];
    }
    assert!((momentum / mass + 5.0 * time).abs() < 1e-4 * time, "{}", momentum / mass / time);
}

#[test]
fn a_wall_holds_the_nodes_of_bonded_parts_with_one_spring_each() {
    // One block cut in two bonded parts bounces off a wall exactly like the uncut one.
    let run = |cut: bool, penalty: Penalty| {
        let mut model = model(6e-4);
        let mut mesh = mapped([6, 3], |u, v| [0.1 * u, 0.001 + 0.05 * v]);
        if cut {
            let cells = std::mem::take(&mut mesh.groups[0].cells);
            let (left, right): (Vec<_>, Vec<_>) = cells.into_iter().enumerate().partition(|(i, _)| i % 6 < 3);
            mesh.groups =
                [("left", left), ("right", right)].map(|(name, cells)| group(name, 2, cells.into_iter().map(|(_, cell)| cell))).into();
            add_groups(&mut model, mesh, &["left", "right"], [0.0, -10.0]);
        } else {
            add_mesh(&mut model, "whole", mesh, [0.0, -10.0]);
        }
        model.obstacles.push(Obstacle { interface: penalty.into(), ..Obstacle::wall("floor", [0.0; 2], [0.0, 1.0]) });
        let mut simulation = simulation(&model);
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        assert!(simulation.summary().penetration_max > 0.0);
        let mut positions = simulation.frame().positions::<2>().to_vec();
        positions.sort_by(|a, b| (a[0] + 1e-3 * a[1]).total_cmp(&(b[0] + 1e-3 * b[1])));
        positions
    };
    for penalty in [Penalty::PerNode(5e8), Penalty::Pressure(5e10), Penalty::default()] {
        let (whole, cut) = (run(false, penalty), run(true, penalty));
        let worst = whole.iter().flatten().zip(cut.iter().flatten()).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(worst < 1e-12, "{penalty:?}: {worst}");
    }
}

#[test]
fn a_body_that_falls_far_faster_than_its_waves_is_reported_with_node_and_speed() {
    // From v0, under gravity g, the first step with v > limit is known: the block is at rest inside.
    let mut model = model(1e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [2, 2]), [3.0, 0.0]);
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -1e9, 0.0], curve: None });
    let fall = |model: &Model| simulation(model).advance(f64::INFINITY, u64::MAX).unwrap_err();
    let Error::Runaway { place, speed, limit, time, .. } = fall(&model) else { panic!("it runs away") };
    assert!(place.starts_with("node ") && place.contains("\"block\""), "{place}");
    let modulus = 1e9 * 0.7 / (1.3 * 0.4); // of the bodies of these tests, 1000 kg/m³
    let fastest = 20.0 * ((modulus / 1000.0f64).sqrt() + 3.0);
    assert!((limit / fastest - 1.0).abs() < 1e-2, "{limit:e} of {fastest:e}");
    let step = simulation(&model).time_step();
    assert!(speed > limit && speed < limit + 1.01e9 * step, "{speed:e}");
    assert!((1e9 * time - speed).abs() < 2.0 * 1e9 * step, "{time:e}");
    // A limit of its own.
    model.run.velocity_limit = Some(1e3);
    assert!(matches!(fall(&model), Error::Runaway { limit: 1e3, .. }));
    model.run.velocity_limit = Some(1e12);
    assert!(simulation(&model).advance(f64::INFINITY, u64::MAX).is_ok());
}
