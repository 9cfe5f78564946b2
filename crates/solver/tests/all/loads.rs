//! Forces, pressures, centrifugal force, boundaries that reflect nothing, and joined nodes against closed
//! forms and against models that need none of them.

use crate::bodies::*;
use embate_solver::model::{
    Axis, Constraint, Curve, CurveShape, Drive, Image, Join, Load, Model, Motion, NonReflecting, Obstacle, Symmetry,
};
use embate_solver::simulation::Simulation;
use std::f64::consts::{FRAC_PI_2, PI};

fn curve(model: &mut Model, name: &str, text: &str) -> Option<String> {
    model.curves.insert(name.into(), Curve::from(CurveShape::Expression(text.into())));
    Some(name.into())
}

/// A smooth pulse of height one between 0 and `end`.
fn pulse(model: &mut Model, end: f64) -> Option<String> {
    let shape = CurveShape::Table { times: vec![0.0, 0.5 * end, end], values: vec![0.0, 1.0, 0.0], smooth: true };
    model.curves.insert("pulse".into(), Curve::from(shape));
    Some("pulse".into())
}

fn join(model: &mut Model, between: [&str; 2], image: Image) {
    model.joins.push(Join { between: between.map(Into::into), image, tolerance: None });
}

fn books_are_closed(simulation: &Simulation) {
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-11, "{}", summary.ledger_residual);
    assert!(summary.energy_drift < 0.01, "{}", summary.energy_drift);
}

/// Initial and final positions.
type Paths = Vec<([f64; 2], [f64; 2])>;

/// Where nodes begin and end.
fn moved(model: &Model) -> (Simulation, Paths) {
    let mut simulation = simulation(model);
    let start = simulation.frame().positions::<2>().to_vec();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap_or_else(|error| panic!("{error}"));
    let pairs = start.into_iter().zip(simulation.frame().positions::<2>().iter().copied()).collect();
    (simulation, pairs)
}

/// Largest distance between where nodes of `some` end and where those of `all` that began at the same places
/// do.
fn farthest(some: &[([f64; 2], [f64; 2])], all: &[([f64; 2], [f64; 2])]) -> f64 {
    let away = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    some.iter().fold(0.0, |worst: f64, (start, end)| {
        let twin = all.iter().find(|(other, _)| away(*start, *other) < 1e-9).unwrap_or_else(|| panic!("nothing began at {start:?}"));
        worst.max(away(*end, twin.1))
    })
}

#[test]
fn the_impulse_of_a_force_is_the_integral_of_its_curve_whatever_the_steps() {
    for (steps, safety) in [(3, 0.9), (7, 0.31)] {
        let end = 1e-4;
        let mut model = model(end);
        model.run.safety = safety;
        add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [8, steps]), [0.0, 0.0]);
        let shape = CurveShape::Table { times: vec![1e-5, 1.3e-5, 2e-5, 6.1e-5], values: vec![0.0, 2.0, 1.0, 0.0], smooth: false };
        model.curves.insert("hit".into(), Curve::from(shape));
        model.loads.push(Load::Force { on: "block.top".into(), force: [3e3, -8e3, 0.0], curve: Some("hit".into()) });
        let (simulation, history) = run(&model);
        let impulse = 0.3e-5 + 0.5 * 3.0 * 0.7e-5 + 0.5 * 4.1e-5;
        for (component, force) in [("block.vx", 3e3), ("block.vy", -8e3)] {
            let velocity = history.last(component);
            assert!((velocity / (force * impulse / 5.0) - 1.0).abs() < 1e-11, "{component}: {velocity}");
        }
        books_are_closed(&simulation);
    }
}

#[test]
fn gravity_follows_a_curve_and_so_does_what_is_rigid() {
    let end = 1e-3;
    let mut model = model(end);
    model.run.energy_limit = 10.0;
    add(&mut model, "soft", rectangle([0.0, 0.0], [0.1, 0.1], [3, 3]), [0.0, 0.0]);
    add(&mut model, "hard", rectangle([1.0, 0.0], [0.1, 0.1], [3, 3]), [0.0, 0.0]);
    model.parts[1].rigid = Some(Motion::default());
    let factor = curve(&mut model, "c", "1 + sin(2*pi*t/1e-3)");
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -10.0, 0.0], curve: factor });
    let (simulation, history) = run(&model);
    for name in ["soft", "hard"] {
        let (velocity, fallen) = (history.last(&format!("{name}.vy")), history.last(&format!("{name}.y")) - 0.05);
        assert!((velocity / (-10.0 * end) - 1.0).abs() < 1e-3, "{name}: {velocity}");
        // ∫∫ 1 + sin = t²/2 + t/k with k = 2π/end.
        assert!((fallen / (-10.0 * (0.5 + 0.5 / PI) * end * end) - 1.0).abs() < 1e-3, "{name}: {fallen}");
    }
    assert!(simulation.summary().ledger_residual < 1e-11);
}

#[test]
fn a_pressure_all_around_has_no_resultant_and_gives_what_the_area_loses() {
    let mut model = model(2e-4);
    add(&mut model, "blob", rectangle([0.0, 0.0], [0.1, 0.06], [6, 4]), [0.0, 0.0]);
    model.parts[0].spin = 300.0;
    model.loads.push(Load::Pressure { on: "blob".into(), pressure: 4e7, curve: None });
    let (simulation, pairs) = moved(&model);
    let momentum = simulation.history_row();
    assert!(momentum.iter().all(|value| value.is_finite()));
    // The area of the outline in its order around: bottom, right, top, left.
    let around: Vec<[f64; 2]> = {
        let mut outline: Vec<_> =
            pairs.iter().filter(|(a, _)| a[0] < 1e-9 || a[0] > 0.1 - 1e-9 || a[1] < 1e-9 || a[1] > 0.06 - 1e-9).collect();
        outline.sort_by(|(a, _), (b, _)| (a[1] - 0.03).atan2(a[0] - 0.05).total_cmp(&(b[1] - 0.03).atan2(b[0] - 0.05)));
        outline.iter().map(|(_, b)| *b).collect()
    };
    let next = |i: usize| around[(i + 1) % around.len()];
    let area: f64 = (0..around.len()).map(|i| 0.5 * (around[i][0] * next(i)[1] - around[i][1] * next(i)[0])).sum();
    let work = simulation.ledger().external;
    assert!((work / (4e7 * (0.006 - area)) - 1.0).abs() < 2e-3, "{work} {}", 4e7 * (0.006 - area));
    books_are_closed(&simulation);
    let history = every_step(&model);
    for (component, speed) in [("blob.vx", 1e-10), ("blob.vy", 1e-10)] {
        assert!(history.column(component).iter().all(|v| v.abs() < speed), "{component}");
    }
}

#[test]
fn a_pressure_moves_a_rigid_part_and_follows_it_around() {
    // A square that spins by a quarter turn while pressure acts on one of its sides: the force turns with it.
    let (spin, end) = (FRAC_PI_2 / 1e-3, 1e-3);
    let mut model = model(end);
    add(&mut model, "square", rectangle([-0.05, -0.05], [0.1, 0.1], [2, 2]), [0.0, 0.0]);
    model.parts[0].rigid = Some(Motion::default());
    model.parts[0].spin = spin;
    model.loads.push(Load::Pressure { on: "square.left".into(), pressure: 1e5, curve: None });
    let (simulation, history) = run(&model);
    // a = p h / m (cos ωt, sin ωt); the run's own step is small against the turn.
    let speed = 1e5 * 0.1 / 10.0 / spin;
    for name in ["square.vx", "square.vy"] {
        assert!((history.last(name) / speed - 1.0).abs() < 1e-3, "{name}: {} {speed}", history.last(name));
    }
    assert!((history.last("rigid.spin[square]") / spin - 1.0).abs() < 1e-9);
    books_are_closed(&simulation);
}

#[test]
fn a_rod_in_a_turning_frame_grows_as_the_closed_form_says() {
    // u(L) = ρ ω² L³ / (3 E): fixed in the axis, seen from the frame.
    let (length, speed, end) = (0.2, 700.0, 6e-3);
    let mut model = slender(end, 1e9, 1e3);
    add(&mut model, "rod", rectangle([0.3, 0.0], [length, 0.01], [40, 1]), [0.0, 0.0]);
    model.constraints.push(Constraint {
        on: "rod.left".into(),
        velocity: [Some(0.0.into()), Some(0.0.into()), None],
        ..Constraint::default()
    });
    let shape = CurveShape::Table { times: vec![0.0, 2e-3], values: vec![0.0, 1.0], smooth: true };
    model.curves.insert("up".into(), Curve::from(shape));
    model.loads.push(Load::Centrifugal { parts: vec![], about: Axis::through([0.3, 0.005]), speed, curve: Some("up".into()) });
    model.loads.push(Load::Damping { parts: vec![], rate: 3e3, active: [0.0, f64::INFINITY] });
    probe(&mut model, "tip", "rod", [0.5, 0.0]);
    let (simulation, history) = run(&model);
    let small = 1e3 * speed * speed * length * length / 1e9; // the stretch of the rod itself: ω² grows with it
    let exact = 1e3 * speed * speed * length.powi(3) / 3e9;
    let grown = history.last("tip.x") - 0.5;
    assert!((grown / exact - 1.0).abs() < small + 1e-3, "{grown} {exact} {small}");
    books_are_closed(&simulation);
}

#[test]
fn bodies_of_revolution_feel_pressure_and_spin_all_around() {
    let axisymmetric = |model: &mut Model| model.parts.iter_mut().for_each(|part| part.stress_state = "axisymmetric".into());
    // A disc on a cushion: p π R² t = ρ π R² h v.
    let mut disc = slender(1e-4, 1e9, 1e3);
    add(&mut disc, "disc", rectangle([0.0, 0.0], [0.05, 0.02], [5, 2]), [0.0; 2]);
    axisymmetric(&mut disc);
    let wave = curve(&mut disc, "c", "sin(pi*t/1e-4)^2");
    disc.loads.push(Load::Pressure { on: "disc.bottom".into(), pressure: 1e4, curve: wave });
    let (simulation, history) = run(&disc);
    let exact = 1e4 * 0.5e-4 / (1e3 * 0.02);
    assert!((history.last("disc.vy") / exact - 1.0).abs() < 1e-4, "{} {exact}", history.last("disc.vy"));
    books_are_closed(&simulation);
    // A thin ring that spins: u = ρ ω² R³ / E.
    let mut ring = slender(3e-3, 1e9, 1e3);
    add(&mut ring, "ring", rectangle([0.099, 0.0], [0.002, 0.002], [2, 2]), [0.0; 2]);
    axisymmetric(&mut ring);
    let shape = CurveShape::Table { times: vec![0.0, 1e-3], values: vec![0.0, 1.0], smooth: true };
    ring.curves.insert("up".into(), Curve::from(shape));
    ring.loads.push(Load::Centrifugal { parts: vec![], about: Axis::default(), speed: 500.0, curve: Some("up".into()) });
    ring.loads.push(Load::Damping { parts: vec![], rate: 1e4, active: [0.0, f64::INFINITY] });
    let (simulation, history) = run(&ring);
    let (grown, exact) = (history.last("ring.x") - history.first("ring.x"), 1e3 * 500.0 * 500.0 * 1e-3 / 1e9);
    assert!((grown / exact - 1.0).abs() < 0.01, "{grown} {exact}");
    books_are_closed(&simulation);
    ring.loads[0] = Load::Centrifugal { parts: vec![], about: Axis::through([0.0, 1.0]), speed: 500.0, curve: None };
    assert!(faults(&ring)[0].contains("turns about its axis"), "{:?}", faults(&ring));
}

/// A bar along `angle`, whose left end gets a pulse, and whose right end reflects nothing: energy that has
/// come and that is left when the pulse has gone.
fn bar(state: &str, [angle, height]: [f64; 2], poisson: f64, shear: bool) -> (Simulation, f64, f64) {
    let (s, c) = angle.sin_cos();
    let turn = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
    let mut model = slender(0.0, 1e9, 1e3);
    model.materials.get_mut("soft").unwrap().parameters.insert("poisson".into(), poisson);
    let mut mesh = mapped([100, 2], |u, v| turn([0.1 * u, height * v]));
    let lines = |cells: &[[u32; 2]]| cells.iter().map(|cell| cell.to_vec()).collect::<Vec<_>>();
    mesh.groups.push(group("start", 1, lines(&[[0, 101], [101, 202]]).into_iter()));
    mesh.groups.push(group("end", 1, lines(&[[100, 201], [201, 302]]).into_iter()));
    add_mesh(&mut model, "bar", mesh, [0.0; 2]);
    model.parts[0].stress_state = state.into();
    let wave = 1e9 / (1.0 - poisson * poisson);
    let wave = if state == "plane_stress" { wave } else { wave * (1.0 - poisson) * (1.0 - poisson) / (1.0 - 2.0 * poisson) };
    let speed = (if shear { 0.5e9 / (1.0 + poisson) } else { wave } / 1e3).sqrt();
    model.run.end = 0.16 / speed;
    let curve = pulse(&mut model, 0.04 / speed);
    if shear {
        model.constraints.push(Constraint { on: "bar".into(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() });
        model.loads.push(Load::Force { on: "start".into(), force: [0.0, 1e5 * height, 0.0], curve });
    } else {
        for y in [0.0, height] {
            model.symmetries.push(Symmetry {
                point: embate_solver::model::in_3d(turn([0.0, y])),
                normal: embate_solver::model::in_3d(turn([0.0, 1.0])),
                ..Symmetry::default()
            });
        }
        model.loads.push(Load::Pressure { on: "start".into(), pressure: 1e5, curve });
    }
    model.non_reflecting.push(NonReflecting { on: "end".into() });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let ledger = simulation.ledger();
    let left = ledger.stores.kinetic + ledger.stores.elastic;
    // ∫ p² dt / (ρ c) of the pulse: each smooth step has ∫ s² = 181/462 of its length.
    let exact = 1e5 * 1e5 * (181.0 / 462.0) * (0.04 / speed) / (1e3 * speed) * height;
    assert!((ledger.external / exact - 1.0).abs() < 0.01, "{} {exact}", ledger.external);
    let taken = ledger.stores.damping;
    assert!((taken / ledger.external - 1.0).abs() < 0.01, "{taken}");
    books_are_closed(&simulation);
    let external = simulation.ledger().external;
    (simulation, external, left)
}

#[test]
fn a_wave_leaves_a_bar_through_a_boundary_that_reflects_nothing() {
    for (state, poisson, shear) in [
        ("", 0.0, false),
        ("", 0.3, false),
        ("", 0.3, true),
        ("plane_stress", 0.3, false),
        ("plane_stress", 0.48, false),
        ("plane_stress", 0.48, true),
    ] {
        let (_, given, left) = bar(state, [0.0, 2e-3], poisson, shear);
        // Energy goes with the square: less than 1 % of the amplitude comes back.
        println!("{state} poisson {poisson}, shear {shear}: {:.2e} of the amplitude is reflected", (left.abs() / given).sqrt());
        assert!(left.abs() < 1e-4 * given, "{left} of {given}");
    }
    // The same of a bar in a skew position: its dashpots are full matrices, and its sides are symmetry lines.
    let (_, given, left) = bar("", [0.5, 2e-3], 0.3, false);
    let (_, straight, _) = bar("", [0.0, 2e-3], 0.3, false);
    assert!((given / straight - 1.0).abs() < 1e-9 && left.abs() < 1e-4 * given);
}

#[test]
fn two_blocks_that_are_tied_bounce_like_one() {
    let fall = |cut: bool| {
        let mut model = model(6e-4);
        if cut {
            add(&mut model, "left", rectangle([0.0, 0.001], [0.05, 0.05], [3, 3]), [0.0, -10.0]);
            add(&mut model, "right", rectangle([0.05, 0.001], [0.05, 0.05], [3, 3]), [0.0, -10.0]);
            join(&mut model, ["left.right", "right.left"], Image::Same);
        } else {
            add(&mut model, "whole", rectangle([0.0, 0.001], [0.1, 0.05], [6, 3]), [0.0, -10.0]);
        }
        model.loads.push(Load::Gravity { parts: vec![], acceleration: [5.0, -9.81, 0.0], curve: None });
        let top: &[&str] = if cut { &["left.top", "right.top"] } else { &["whole.top"] };
        model.loads.extend(top.iter().map(|on| Load::Pressure { on: (*on).into(), pressure: 1e5, curve: None }));
        model.loads.push(Load::Damping { parts: vec![], rate: 100.0, active: [0.0, f64::INFINITY] });
        model.obstacles.push(Obstacle::wall("floor", [0.0; 2], [0.1, 1.0]));
        moved(&model)
    };
    let ((one, whole), (two, cut)) = (fall(false), fall(true));
    assert!(one.summary().penetration_max > 0.0 && cut.len() == whole.len() + 4);
    // The seam's nodes have a spring each, half as stiff.
    assert!(farthest(&cut, &whole) < 2e-6, "{:e}", farthest(&cut, &whole));
    books_are_closed(&two);
    assert!((two.ledger().external / one.ledger().external - 1.0).abs() < 1e-3);
}

#[test]
fn tied_blocks_in_flight_move_exactly_like_one_and_keep_their_momentum() {
    let fly = |cut: bool| {
        let mut model = model(5e-4);
        let mut part = |name: &str, x: f64, width: f64, count: usize, velocity: f64| {
            add(&mut model, name, rectangle([x, 0.0], [width, 0.05], [count, 3]), [0.0, velocity]);
        };
        part("a", 0.0, 0.05, 3, 40.0);
        part("b", 0.05, 0.05, 3, -40.0);
        if cut {
            join(&mut model, ["a.right", "b.left"], Image::Same);
        } else {
            model.parts.clear();
            model.probes.clear();
            let mut mesh = mapped([6, 3], |u, v| [0.1 * u, 0.05 * v]);
            let cells = std::mem::take(&mut mesh.groups[0].cells);
            let (left, right): (Vec<_>, Vec<_>) = cells.into_iter().enumerate().partition(|(i, _)| i % 6 < 3);
            mesh.groups = [("a", left), ("b", right)].map(|(name, cells)| group(name, 2, cells.into_iter().map(|(_, cell)| cell))).into();
            add_groups(&mut model, mesh, &["a", "b"], [0.0, 0.0]);
            model.parts[0].velocity = [0.0, 40.0, 0.0];
            model.parts[1].velocity = [0.0, -40.0, 0.0];
        }
        moved(&model)
    };
    let ((_, whole), (tied, cut)) = (fly(false), fly(true));
    assert!(farthest(&cut, &whole) < 1e-12, "{:e}", farthest(&cut, &whole));
    let summary = tied.summary();
    let drifts = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(Option::unwrap);
    assert!(drifts.iter().all(|drift| *drift < 1e-12), "{drifts:?}");
    books_are_closed(&tied);
}

#[test]
fn one_period_moves_like_two() {
    let strip = |periods: usize| {
        let mut model = model(4e-4);
        for k in 0..periods {
            let x = 0.1 * k as f64;
            add(&mut model, &format!("a{k}"), rectangle([x, 0.0], [0.05, 0.04], [4, 3]), [0.0, 15.0]);
            add(&mut model, &format!("b{k}"), rectangle([x + 0.05, 0.0], [0.05, 0.04], [4, 3]), [10.0, -15.0]);
            join(&mut model, [&format!("a{k}.right"), &format!("b{k}.left")], Image::Same);
            if k > 0 {
                join(&mut model, [&format!("b{}.right", k - 1), &format!("a{k}.left")], Image::Same);
            }
        }
        let last = format!("b{}.right", periods - 1);
        join(&mut model, ["a0.left", &last], Image::Translated([0.1 * periods as f64, 0.0, 0.0]));
        moved(&model)
    };
    let ((_, one), (two, both)) = (strip(1), strip(2));
    assert!(farthest(&one, &both) < 1e-12, "{:e}", farthest(&one, &both));
    books_are_closed(&two);
    let ends = |x: f64| one.iter().filter(move |(a, _)| (a[0] - x).abs() < 1e-9);
    for ((_, left), (_, right)) in ends(0.0).zip(ends(0.1)) {
        assert!((right[0] - left[0] - 0.1).abs() < 1e-15 && (right[1] - left[1]).abs() < 1e-15);
    }
}

#[test]
fn a_quarter_moves_like_the_whole_that_spins() {
    // A square that spins about its centre under pressure; its quarter with the tip in the centre; and a ring
    // with its sector.
    let spin = 800.0;
    let flying = |model: &mut Model, centre: [f64; 2]| {
        let part = model.parts.last_mut().unwrap();
        part.spin = spin;
        part.velocity = [-spin * centre[1], spin * centre[0], 0.0];
    };
    let turned = Image::Turned { about: Axis::default(), angle: FRAC_PI_2 };
    let square = |quarter: bool| {
        let mut model = model(3e-4);
        let (corner, size, count) = if quarter { (0.0, 0.05, 4) } else { (-0.05, 0.1, 8) };
        add(&mut model, "square", rectangle([corner; 2], [size; 2], [count; 2]), [0.0; 2]);
        flying(&mut model, if quarter { [0.025; 2] } else { [0.0; 2] });
        let sides: &[&str] = if quarter { &["top", "right"] } else { &["top", "right", "bottom", "left"] };
        model.loads.extend(sides.iter().map(|side| Load::Pressure { on: format!("square.{side}"), pressure: 2e7, curve: None }));
        if quarter {
            join(&mut model, ["square.bottom", "square.left"], turned);
        }
        moved(&model)
    };
    let ring = |quarter: bool| {
        let mut model = model(3e-4);
        let (to, count) = if quarter { (FRAC_PI_2, 8) } else { (4.0 * FRAC_PI_2, 32) };
        let shape = embate_solver::model::Shape::Ring(embate_solver::model::Ring {
            centre: [0.0; 2],
            inner: 0.04,
            outer: 0.05,
            from: 0.0,
            to,
            elements: [2, count],
            ..embate_solver::model::Ring::default()
        });
        add(&mut model, "ring", shape, [0.0; 2]);
        let overview = simulation(&model).history_row();
        let at = simulation(&model).history_columns().iter().position(|name| name == "ring.x").unwrap();
        flying(&mut model, if quarter { [overview[at], overview[at + 1]] } else { [0.0; 2] });
        model.loads.push(Load::Pressure { on: "ring.inner".into(), pressure: 1e7, curve: None });
        model.non_reflecting.push(NonReflecting { on: "ring.outer".into() });
        model.obstacles.push(Obstacle {
            shape: embate_solver::model::ObstacleShape::Circle { centre: [0.0; 3], radius: 0.0502, hollow: true },
            ..Obstacle::wall("around", [0.0; 2], [1.0, 0.0])
        });
        if quarter {
            join(&mut model, ["ring.start", "ring.end"], turned);
        }
        moved(&model)
    };
    for (name, bodies, tolerance) in [("square", [square(true), square(false)], 1e-12), ("ring", [ring(true), ring(false)], 1e-5)] {
        let [(part, some), (whole, all)] = bodies;
        assert!(farthest(&some, &all) < tolerance, "{name}: {:e}", farthest(&some, &all));
        books_are_closed(&part);
        let ratio = whole.ledger().external / part.ledger().external;
        assert!((ratio / 4.0 - 1.0).abs() < 1e-2, "{name}: {ratio}");
    }
}

#[test]
fn joins_that_do_not_fit_and_motions_that_tear_them_are_reported() {
    let mut model = model(1e-3);
    add(&mut model, "a", rectangle([0.0, 0.0], [0.1, 0.05], [2, 2]), [0.0; 2]);
    add(&mut model, "b", rectangle([0.1, 0.0], [0.1, 0.05], [2, 3]), [0.0; 2]);
    join(&mut model, ["a.right", "b.left"], Image::Same);
    let reported = faults(&model);
    assert_eq!(reported.len(), 1, "{reported:?}");
    assert!(
        reported[0]
            .contains("(1.000000e-1, 2.500000e-2) m of \"a.right\" has no partner in \"b.left\": the nearest node is 8.333e-3 m away"),
        "{reported:?}"
    );
    // Images must fit in both directions.
    model.joins.clear();
    join(&mut model, ["a.left", "b.right"], Image::Translated([0.2, 0.0, 0.0]));
    assert_eq!(faults(&model).len(), 3, "one of a, two of b");
    // Two ends of one period that shall move differently; the message names both conditions.
    model.joins.clear();
    join(&mut model, ["a.left", "a.right"], Image::Translated([0.1, 0.0, 0.0]));
    let hold =
        |on: &str, velocity: f64| Constraint { on: on.into(), velocity: [Some(velocity.into()), None, None], ..Constraint::default() };
    model.constraints = vec![hold("a.left", 0.0), hold("a.right", 2.0)];
    let reported = faults(&model);
    assert!(reported.len() == 3 && reported[0].contains("constraint[0] on \"a.left\" already moves it at 0 m/s"), "{reported:?}");
    model.constraints = vec![hold("a.left", 2.0), hold("a.right", 2.0)];
    assert_eq!(faults(&model), Vec::<String>::new());
    // A drive of one side moves the other one too.
    let (_, pairs) = moved(&model);
    assert!(
        pairs
            .iter()
            .filter(|(a, _)| a[0] < 1e-9 || (a[0] - 0.1).abs() < 1e-9 && a[1] < 0.026)
            .all(|(a, b)| (b[0] - a[0] - 2e-3).abs() < 1e-14 || a[0] > 0.05)
    );
    // Rigid parts have no nodes of their own.
    model.constraints.clear();
    model.parts[0].rigid = Some(Motion { spin: Some(Drive::Constant(0.0)), ..Motion::default() });
    assert!(faults(&model)[0].contains("part `a` is rigid"), "{:?}", faults(&model));
}
