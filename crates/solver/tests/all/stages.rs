//! Stages of a run: what acts and holds in each, rest between them, initial velocities behind them.

use crate::bodies::*;
use embate_solver::model::{
    Cadence, Constraint, Cuboid, Curve, CurveShape, Drive, Load, LoadTerms, Model, Motion, Obstacle, Part, Relaxation, Shape, Stage, in_3d,
};

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} and not {expected}");
}

fn at_rest(name: &str, duration: f64, from: f64) -> Stage {
    Stage { name: name.into(), duration, relaxation: Some(Relaxation { tolerance: 1e-12, from }), release: None }
}

fn moving(name: &str, duration: f64) -> Stage {
    Stage { name: name.into(), duration, relaxation: None, release: None }
}

fn set_stages(model: &mut Model, stages: &[Stage]) {
    model.stages = stages.to_vec();
    model.run.end = stages.iter().map(|stage| stage.duration).sum();
}

fn in_stages(names: &[&str]) -> LoadTerms {
    LoadTerms { name: String::new(), stages: names.iter().map(ToString::to_string).collect() }
}

fn held(on: &str, stages: &[&str]) -> Constraint {
    let velocity = [Some(Drive::Constant(0.0)), None, None];
    Constraint { on: on.into(), velocity, stages: stages.iter().map(ToString::to_string).collect(), ..Constraint::default() }
}

/// A bar of 0.1 m with c = 1000 m/s that a force stretches by 1e-4 m in its first stage and leaves alone in
/// the second.
fn stretched_bar() -> Model {
    let mut model = slender(1.0, 1e9, 1e3);
    add(&mut model, "bar", rectangle([0.0, 0.0], [0.1, 0.005], [80, 2]), [0.0; 2]);
    probe(&mut model, "tip", "bar", [0.1, 0.0025]);
    model.constraints.push(held("bar.left", &[]));
    model.loads.push(Load::Force { on: "bar.right".into(), force: [5e3, 0.0, 0.0], curve: None });
    model.load_terms.push(in_stages(&["pull"]));
    set_stages(&mut model, &[at_rest("pull", 0.1, 0.0), moving("swing", 8e-4)]);
    model.output.history = Cadence::Count(200);
    model
}

#[test]
fn a_bar_that_is_released_swings_as_a_triangular_wave() {
    let (simulation, history) = run(&stretched_bar());
    let summary = simulation.summary();
    let [pull, swing] = &summary.stages[..] else { panic!("{:?}", summary.stages) };
    assert_eq!((pull.name.as_str(), pull.begin, pull.is_at_rest, swing.is_at_rest), ("pull", 0.0, Some(true), None));
    assert!(pull.end < 0.1 && swing.begin == pull.end && !summary.is_early() && summary.rest.is_none());
    close(swing.end - swing.begin, 8e-4, 1e-15, "duration");
    let (times, tip) = (history.column("time"), history.column("tip.x"));
    let shift = |time: f64| {
        let after = times.iter().position(|&it| it >= swing.begin + time * (1.0 - 1e-9)).unwrap();
        tip[after] - 0.1
    };
    // u₀ = L (exp(F / (E h)) − 1); the wave is at −u₀ after 2 L/c, and back after 4 L/c.
    close(shift(0.0), 0.1 * 1e-3f64.exp_m1(), 1e-9, "statically");
    for (time, expected) in [(1e-4, 0.0), (2e-4, -1e-4), (3e-4, 0.0), (4e-4, 1e-4), (6e-4, -1e-4), (8e-4, 1e-4)] {
        close(shift(time), expected, 4e-6, &format!("{time} s after the release"));
    }
    assert!(summary.energy_drift < 1e-3 && summary.ledger_residual < 1e-12, "{} {}", summary.energy_drift, summary.ledger_residual);
    // A count of outputs is one of each stage.
    let of_swing = times.iter().filter(|&&time| time > swing.begin).count();
    // With the first step, in which nothing pulls any more.
    assert_eq!(of_swing, 201);
}

/// A plate that gravity presses on a bar, at rest first; then a block flies, a rigid one besides turns.
fn preloaded() -> Model {
    let mut model = slender(1.0, 1e9, 1e3);
    add(&mut model, "bar", rectangle([0.0, 0.0], [0.1, 0.005], [40, 2]), [0.0; 2]);
    add(&mut model, "ball", rectangle([0.2, 0.0], [0.01, 0.01], [4, 4]), [-20.0, 3.0]);
    add(&mut model, "stone", rectangle([0.3, 0.0], [0.02, 0.01], [4, 2]), [5.0, 0.0]);
    model.parts[2].spin = 100.0;
    stiffen(&mut model, "stone", Motion::default());
    model.constraints.push(held("bar.left", &[]));
    model.loads.push(Load::Force { on: "bar.right".into(), force: [-5e3, 0.0, 0.0], curve: None });
    set_stages(&mut model, &[at_rest("preload", 0.1, 0.0), moving("flight", 1e-3)]);
    model
}

#[test]
fn bodies_get_their_initial_velocities_behind_a_static_preload() {
    let (simulation, history) = run(&preloaded());
    let summary = simulation.summary();
    let begin = summary.stages[1].begin;
    assert_eq!(summary.stages[0].is_at_rest, Some(true));
    for ((time, x), (y, stone)) in
        history.column("time").iter().zip(history.column("ball.x")).zip(history.column("ball.y").iter().zip(history.column("stone.x")))
    {
        let flown = (time - begin).max(0.0);
        close(x, 0.205 - 20.0 * flown, 1e-13, "x");
        close(*y, 0.005 + 3.0 * flown, 1e-13, "y");
        close(stone, 0.31 + 5.0 * flown, 1e-13, "stone");
    }
    // ½ m v² of the ball, ½ m v² + ½ I ω² of the stone; the bar rests.
    let (ball, stone) = (0.1, 0.2);
    let inertia = stone * (0.02f64.powi(2) + 0.01f64.powi(2)) / 12.0;
    let expected = 0.5 * ball * 409.0 + 0.5 * stone * 25.0 + 0.5 * inertia * 1e4;
    let last = history.last("energy.kinetic");
    assert!((last / expected - 1.0).abs() < 3e-3, "{last} and not {expected}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-6, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn a_solid_gets_its_spin_behind_a_stage_too() {
    let mut model = model(1.0);
    let cuboid = Shape::Cuboid(Cuboid { size: [0.04, 0.02, 0.01], elements: [4, 2, 1], ..Cuboid::default() });
    for (name, x) in [("soft", 0.0), ("stiff", 0.2)] {
        let mut part = Part { name: name.into(), material: "soft".into(), shape: cuboid.clone(), ..Part::default() };
        (part.velocity, part.spin, part.spin_axis) = ([1.0, 2.0, 3.0], 50.0, [0.0, 0.0, 1.0]);
        part.placement.translation = [x, 0.0, 0.0];
        part.rigid = (name == "stiff").then(Motion::default);
        model.parts.push(part);
    }
    let mut alone = model.clone();
    alone.run.end = 1e-4;
    set_stages(&mut model, &[at_rest("nothing", 1e-5, 0.0), moving("flight", 1e-4)]);
    let (staged, alone) = (to_end(&model), to_end(&alone));
    let [a, b] = [&staged, &alone].map(|it| it.coordinates());
    let off = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{off}");
    let [a, b] = [&staged, &alone].map(|it| it.ledger().stores.kinetic);
    assert!((a / b - 1.0).abs() < 1e-4, "{a} and not {b}");
    assert!(staged.summary().ledger_residual < 1e-12);
}

#[test]
fn what_holds_changes_and_follows_a_curve_of_its_stage() {
    // Clamped at the left while it is stretched; then the left goes after a curve, the right is free, and in
    // the end nothing holds it.
    let mut model = stretched_bar();
    model.loads.clear();
    model.load_terms.clear();
    model.constraints.clear();
    model.constraints.push(held("bar.left", &["pull"]));
    let shape = CurveShape::Table { times: vec![0.0, 2e-4], values: vec![0.0, 2e-3], smooth: true };
    model.curves.insert("push".into(), Curve { stage: Some("swing".into()), ..Curve::from(shape) });
    let displacement = [Some(Drive::Curve("push".into())), None, None];
    model.constraints.push(Constraint { on: "bar.left".into(), displacement, stages: vec!["swing".into()], ..Constraint::default() });
    probe(&mut model, "root", "bar", [0.0, 0.0025]);
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [1e4, 0.0, 0.0], curve: None });
    model.load_terms.push(in_stages(&["free"]));
    set_stages(&mut model, &[moving("pull", 1e-4), moving("swing", 3e-4), moving("free", 2e-4)]);
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    let begins: Vec<f64> = summary.stages.iter().map(|stage| stage.begin).collect();
    assert!((begins[1] - 1e-4).abs() < 1e-18 && (begins[2] - 4e-4).abs() < 1e-18, "{begins:?}");
    for (time, x) in history.column("time").into_iter().zip(history.column("root.x")).filter(|(time, _)| *time <= 4e-4) {
        let s = ((time - 1e-4) / 2e-4).clamp(0.0, 1.0);
        close(x, 2e-3 * s * s * s * (10.0 + s * (6.0 * s - 15.0)), 1e-12, &format!("at {time} s"));
    }
    // Nothing but gravity acts in the end: the momentum grows by m g t from what it was.
    let (times, speeds) = (history.column("time"), history.column("bar.vx"));
    let (first, last) = (times.iter().position(|&time| time > 4.4e-4).unwrap(), times.len() - 1);
    close(speeds[last] - speeds[first], 1e4 * (times[last] - times[first]), 1e-9, "speed that gravity gives");
    // No more force is needed at the left than what it held.
    let reaction = history.column("constraint.force_x[0]");
    assert!(reaction.iter().zip(&times).filter(|(_, time)| **time > 1.01e-4).all(|(force, _)| *force == 0.0));
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 2e-3, "{} {}", summary.ledger_residual, summary.energy_drift);
}

/// A block that is pressed on a wall, which is taken away.
fn released_from_a_wall() -> Model {
    let mut model = slender(1.0, 1e9, 1e3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.02, 0.02], [6, 6]), [0.0; 2]);
    model.obstacles.push(Obstacle::wall("floor", [0.0, 0.0], [0.0, 1.0]));
    model.obstacles[0].interface.stages = vec!["press".into()];
    model.loads.push(Load::Pressure { on: "block.top".into(), pressure: 1e6, curve: None });
    set_stages(&mut model, &[at_rest("press", 0.1, 0.0), moving("fall", 2e-4)]);
    model
}

#[test]
fn a_wall_that_is_taken_away_pushes_no_more_and_its_energy_is_booked() {
    let (simulation, history) = run(&released_from_a_wall());
    let summary = simulation.summary();
    let begin = summary.stages[1].begin;
    assert_eq!(summary.stages[0].is_at_rest, Some(true));
    // p A / m = 1e6 · 0.02 / 0.4, from the half step after that in which the wall pushes last.
    close(history.last("block.vy"), -5e4 * (2e-4 - 0.5 * summary.stable_time_step_min), 1e-3, "speed");
    let pushes = history.column("obstacle.force_y[floor]");
    let times = history.column("time");
    let row = times.iter().position(|&time| time >= begin).unwrap();
    close(pushes[row].abs(), 2e4, 2.0, "at the end of the stage");
    assert!(pushes[row + 1..].iter().all(|push| *push == 0.0));
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 2e-3, "{} {}", summary.ledger_residual, summary.energy_drift);
}

/// A bar that is held apart at both ends, and pressed on by a wall from the side, and then let go slowly.
fn let_go_slowly(release: Option<f64>) -> Model {
    let mut model = slender(1.0, 1e9, 1e3);
    add(&mut model, "bar", rectangle([0.0, 0.0], [0.1, 0.01], [40, 4]), [0.0; 2]);
    probe(&mut model, "tip", "bar", [0.1, 0.0]);
    model.constraints.push(held("bar.left", &[]));
    let shape = CurveShape::Table { times: vec![0.0, 1e-3], values: vec![0.0, 1e-4], smooth: true };
    model.curves.insert("pull".into(), shape.into());
    let displacement = [Some(Drive::Curve("pull".into())), None, None];
    model.constraints.push(Constraint { on: "bar.right".into(), displacement, stages: vec!["pull".into()], ..Constraint::default() });
    let mut floor = Obstacle::wall("floor", [0.0, 0.0], [0.0, 1.0]);
    floor.interface.stages = vec!["pull".into()];
    model.obstacles.push(floor);
    let down = vec![0.0, 5e-4];
    let shape = CurveShape::Table { times: down, values: vec![1.0, 0.0], smooth: true };
    model.curves.insert("less".into(), Curve { stage: Some("let_go".into()), ..Curve::from(shape) });
    model.loads.push(Load::Pressure { on: "bar.top".into(), pressure: 1e5, curve: Some("less".into()) });
    set_stages(&mut model, &[at_rest("pull", 0.1, 1e-3), Stage { release, ..moving("let_go", 1.6e-3) }]);
    model.stages[1].name = "let_go".into();
    model
}

#[test]
fn what_holds_lets_go_slowly_where_that_is_wanted() {
    let swing = |release: Option<f64>| {
        let (simulation, history) = run(&let_go_slowly(release));
        let summary = simulation.summary();
        assert_eq!(summary.stages[0].is_at_rest, Some(true));
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3, "{} {}", summary.ledger_residual, summary.energy_drift);
        let begin = summary.stages[1].begin + 1.05e-3;
        let late = history.column("time").into_iter().zip(history.column("tip.x")).filter(|(time, _)| *time > begin);
        late.map(|(_, x)| (x - 0.1).abs()).fold(0.0, f64::max)
    };
    // At once the bar swings about its length as far as it was stretched; let go over two and a half of its
    // periods it hardly does.
    let (sudden, slow) = (swing(None), swing(Some(1e-3)));
    assert!(sudden > 0.9e-4 && slow < 0.1 * sudden, "{sudden} {slow}");
}

#[test]
fn every_stage_has_the_same_bits_on_all_threads_and_continues_from_its_state() {
    for (case, model) in
        [("bar", stretched_bar()), ("preload", preloaded()), ("wall", released_from_a_wall()), ("slow", let_go_slowly(Some(5e-4)))]
    {
        let hash = hash_of_equal_bits(&model, &[2, 3], case);
        let mut run = simulation(&model);
        let first = to_end(&model).summary().stages[1].begin;
        for time in [0.3 * first, first, first + 1e-6, first + 1e-4] {
            run.advance(time, u64::MAX).unwrap();
            continues_to(&hash, &model, &mut run, case);
        }
    }
}

#[test]
fn stages_that_cannot_be_are_reported() {
    let mut model = stretched_bar();
    model.stages.push(moving("swing", 1e-3));
    model.stages.push(Stage { relaxation: Some(Relaxation { from: 2.0, ..Relaxation::default() }), ..moving("end", 1.0) });
    model.stages[0].release = Some(1.0);
    model.run.relaxation = Some(Relaxation::default());
    model.load_terms[0].stages = vec!["pull".into(), "end".into(), "pul".into()];
    model.constraints[0].stages = vec!["pull".into(), "pull".into()];
    model.curves.insert("c".into(), Curve { stage: Some("none".into()), ..Curve::table(vec![0.0], vec![1.0]) });
    let found = faults(&model).join("\n");
    for expected in [
        "stage[2].name: the name `swing` is taken by stage[1]",
        "stage[3].relaxation.from: rest counts from 2 s on, and the stage is over after 1 s",
        "stage[0].release: it takes 1 s to let go, and the stage is over after 0.1 s",
        "stage[0].release: nothing ends before the first stage",
        "run.end: the run ends at 0.1008 s, and its stages last",
        "run.relaxation: the model has stages",
        "load[0].stages: there is no stage `pul`",
        "load[0].stages: stage `swing` lies between those that are named",
        "constraint[0].stages: stage `pull` is named twice",
        "curve.c.stage: there is no stage `none`",
    ] {
        assert!(found.contains(expected), "{expected}\n\n{found}");
    }
    let mut model = preloaded();
    set_stages(&mut model, &[at_rest("preload", 0.1, 0.0)]);
    assert!(faults(&model)[0].contains("part[1].velocity: all stages are relaxed, so part `ball` never gets its initial velocity"));
    let part = |model: &Model| in_3d::<f64, 2>([model.parts[0].velocity[0], 0.0]);
    assert_eq!(part(&model), [0.0; 3]);
}
