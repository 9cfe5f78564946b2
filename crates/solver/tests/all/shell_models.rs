//! Models of shells: closed forms, contact on their faces, ledgers, and faults of models that make no sense.

use crate::bodies::*;
use crate::patches::material;
use crate::shells::section;
use embate_solver::model::{
    CircularArc, Constraint, Contact, Curve, CurveShape, Image, InitialPenetration, Interface, Join, Line, Load, Model, NonReflecting,
    Obstacle, Partners, PointMass, Probe, ProbeAt, Shape, ShellSection, Spring, Symmetry, Truss,
};
use std::f64::consts::{PI, TAU};

/// A part of shells of the material `soft`.
fn shells(model: &mut Model, name: &str, shape: impl Into<Shape>, thickness: f64, state: &str) {
    add(model, name, shape.into(), [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section, part.stress_state) = ("shell2".into(), Some(section(thickness)), state.into());
}

fn clamp(model: &mut Model, on: &str) {
    let still = || Some(0.0.into());
    model.constraints.push(Constraint {
        on: on.into(),
        velocity: [still(), still(), None],
        spin: [None, None, still()],
        ..Constraint::default()
    });
}

fn straight(length: f64, elements: usize) -> Line {
    Line { points: vec![[0.0, 0.0], [length, 0.0]], radius: 0.0, closed: false, elements }
}

fn set(model: &mut Model, name: &str, of: &str) {
    model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: of.into() }, ..Probe::default() });
}

/// Loads that grow smoothly until half of the run.
fn slowly(model: &mut Model, end: f64) -> Option<String> {
    let shape = CurveShape::Table { times: vec![0.0, 0.5 * end], values: vec![0.0, 1.0], smooth: true };
    model.curves.insert("slowly".into(), Curve::from(shape));
    Some("slowly".into())
}

#[test]
fn a_strip_with_a_moment_at_its_end_rolls_up_to_a_circle_with_five_elements() {
    // M = 2π E I / L; density such that the strip is at rest at the end.
    let (length, thickness, young) = (10.0, 0.1_f64, 1.2e6);
    for elements in [5, 10] {
        let end = 400.0;
        let mut model = slender(end, young, 1.0);
        shells(&mut model, "strip", straight(length, elements), thickness, "plane_stress");
        clamp(&mut model, "strip.start");
        let curve = slowly(&mut model, end);
        let moment = TAU * young * thickness.powi(3) / 12.0 / length;
        model.loads.push(Load::Moment { on: "strip.end".into(), moment: [0.0, 0.0, moment], curve });
        model.loads.push(Load::Damping { parts: vec![], rate: 0.2, active: [0.0, f64::INFINITY] });
        set(&mut model, "tip", "strip.end");
        let simulation = to_end(&model);
        let tip = [value(&simulation, "tip.x"), value(&simulation, "tip.y")];
        // A polygon of chords of the circle, whose end is where it began.
        assert!(tip.iter().all(|x| x.abs() < 0.01), "{elements}: {tip:?}");
    }
}

#[test]
fn a_cantilever_bends_as_a_beam_with_linear_rotations() {
    // w = P L³/3EI (1 − 1/(4 n²)) + P L/(k G A).
    let (length, thickness, young, elements) = (1.0_f64, 0.05_f64, 2e6, 8);
    let end = 20.0;
    let mut model = slender(end, young, 10.0);
    shells(&mut model, "strip", straight(length, elements), thickness, "plane_stress");
    clamp(&mut model, "strip.start");
    let curve = slowly(&mut model, end);
    let force = 1e-4;
    model.loads.push(Load::Force { on: "strip.end".into(), force: [0.0, force, 0.0], curve });
    model.loads.push(Load::Damping { parts: vec![], rate: 10.0, active: [0.0, f64::INFINITY] });
    set(&mut model, "tip", "strip.end");
    let simulation = to_end(&model);
    let bending = force * length.powi(3) / (3.0 * young * thickness.powi(3) / 12.0) * (1.0 - 0.25 / (elements * elements) as f64);
    let shear = force * length / (5.0 / 6.0 * 0.5 * young * thickness);
    let found = value(&simulation, "tip.y");
    assert!((found / (bending + shear) - 1.0).abs() < 1e-4, "{found} for {}", bending + shear);
}

#[test]
fn a_plate_that_flies_spins_and_swings_keeps_momenta_and_energy() {
    let mut model = model(0.012);
    model.materials.insert("soft".into(), elastic(200e9, 7800.0));
    shells(&mut model, "plate", straight(0.5, 20), 0.006, "plane_strain");
    model.parts[0].spin = 200.0;
    model.parts[0].velocity = [3.0, -5.0, 0.0];
    let mut simulation = simulation(&model);
    let nodes = simulation.nodes_of("plate").unwrap();
    let places = simulation.coordinates();
    // Spin and flight, and a wave of 30 m/s across.
    let velocity = |&node: &u32| {
        let x = places[2 * node as usize] - 0.25;
        [3.0, -5.0 + 200.0 * x + 30.0 * (TAU * (x + 0.25) / 0.5).cos()]
    };
    let velocities: Vec<f64> = nodes.iter().flat_map(velocity).collect();
    simulation.set_velocities(&nodes, &velocities).unwrap();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-13 && summary.energy_drift < 2e-5, "{:e} {:e}", summary.ledger_residual, summary.energy_drift);
    assert!(simulation.steps() > 2_000);
}

#[test]
fn a_ring_breathes_and_ovalizes_with_its_frequencies() {
    let (radius, thickness, young, poisson, density) = (0.097_f64, 0.006, 200e9, 0.3, 7800.0);
    let plate = young / (1.0 - poisson * poisson);
    // Breathing: ω² = E*/(ρ R²). Inextensional n = 2: ω² = E* I/(ρ A R⁴) n² (n² − 1)²/(n² + 1).
    let breathing = (plate / (density * radius * radius)).sqrt() / TAU;
    let oval = (plate * thickness * thickness / 12.0 / (density * radius.powi(4)) * 36.0 / 5.0).sqrt() / TAU;
    assert!((breathing - 8709.5).abs() < 1.0 && (oval - 417.30).abs() < 0.05, "{breathing} {oval}");
    for (n, expected, tolerance) in [(0, breathing, 5e-3), (2, oval, 8e-3)] {
        let mut model = model(2.25 / expected);
        model.materials.insert("soft".into(), elastic(young, density));
        shells(&mut model, "ring", CircularArc { radius, elements: 80, ..CircularArc::default() }, thickness, "plane_strain");
        probe(&mut model, "right", "ring", [radius, 0.0]);
        let mut simulation = simulation(&model);
        // v = r̂ cos nθ − θ̂ sin nθ / n: without extension where n > 0.
        let nodes = simulation.nodes_of("ring").unwrap();
        let (places, mut velocities) = (simulation.coordinates(), Vec::new());
        for &node in &nodes {
            let [x, y] = [0, 1].map(|d| places[2 * node as usize + d] / radius);
            let (radial, around) = if n == 0 { (1.0, 0.0) } else { (x * x - y * y, -x * y) };
            velocities.extend([radial * x - around * y, radial * y + around * x].map(|v| 0.1 * v));
        }
        simulation.set_velocities(&nodes, &velocities).unwrap();
        let (mut times, mut x) = (vec![0.0], vec![radius]);
        while simulation.time() < model.run.end {
            simulation.advance(f64::INFINITY, 1).unwrap();
            times.push(simulation.time());
            x.push(value(&simulation, "right.x"));
        }
        let crossings: Vec<f64> = (1..x.len())
            .filter(|&k| (x[k - 1] - radius) * (x[k] - radius) < 0.0)
            .map(|k| times[k - 1] + (times[k] - times[k - 1]) * (radius - x[k - 1]) / (x[k] - x[k - 1]))
            .collect();
        let found = 1.0 / (crossings[3] - crossings[1]);
        assert!((found / expected - 1.0).abs() < tolerance, "{n}: {found} for {expected}");
    }
}

fn steel_strip(model: &mut Model, name: &str, points: [[f64; 2]; 2], thickness: f64, elements: usize, velocity: [f64; 2]) {
    shells(model, name, Line { points: points.to_vec(), radius: 0.0, closed: false, elements }, thickness, "plane_strain");
    model.parts.last_mut().unwrap().velocity = embate_solver::model::in_3d(velocity);
}

fn steel(end: f64) -> Model {
    let mut model = model(end);
    model.materials.insert("soft".into(), elastic(200e9, 7800.0));
    model
}

fn all_touch(model: &mut Model, friction: Option<f64>) {
    let interface = friction.map(rough).unwrap_or_default();
    model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), interface, ..Contact::default() });
}

#[test]
fn two_sheets_that_collide_flat_touch_at_their_thickness_and_swap_their_velocities() {
    let (thickness, gap) = (0.002, 0.001);
    let mut model = steel(2e-4);
    let y = thickness + gap;
    steel_strip(&mut model, "lower", [[0.0, 0.0], [0.1, 0.0]], thickness, 10, [0.0, 10.0]);
    steel_strip(&mut model, "upper", [[0.0, y], [0.1, y]], thickness, 10, [0.0, -10.0]);
    all_touch(&mut model, None);
    let steps = every_step(&model);
    let (times, contact) = (steps.column("time"), steps.column("contact.energy[all]"));
    let first = contact.iter().position(|energy| *energy > 0.0).unwrap();
    let step = times[first] - times[first - 1];
    assert!((times[first] - gap / 20.0).abs() < 1.5 * step, "{} for {}", times[first], gap / 20.0);
    for (part, expected) in [("lower", -10.0), ("upper", 10.0)] {
        let column = steps.column(&format!("{part}.vy"));
        let found = column[column.len() - 1];
        assert!((found / expected - 1.0).abs() < 0.02, "{part}: {found}");
    }
    let total = steps.column("energy.total");
    assert!(total.iter().all(|energy| (energy / total[0] - 1.0).abs() < 1e-4), "{:?}", total[total.len() - 1] / total[0]);
}

#[test]
fn sheets_that_hit_each_other_with_friction_keep_both_momenta() {
    let mut model = steel(6e-4);
    steel_strip(&mut model, "lower", [[0.0, 0.0], [0.2, 0.02]], 0.003, 12, [0.0, 0.0]);
    steel_strip(&mut model, "upper", [[0.05, 0.02], [0.15, 0.06]], 0.002, 9, [20.0, -40.0]);
    shells(
        &mut model,
        "ring",
        CircularArc { centre: [0.16, 0.06], radius: 0.02, elements: 24, ..CircularArc::default() },
        0.001,
        "plane_strain",
    );
    model.parts[2].velocity = [-20.0, -50.0, 0.0];
    all_touch(&mut model, Some(0.3));
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.largest("contact.energy[all]") > 0.0);
    assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12, "{:?}", summary.momentum_drift_linear);
    assert!(summary.momentum_drift_angular.unwrap() < 1e-12, "{:?}", summary.momentum_drift_angular);
    assert!(summary.energy_drift < 5e-3, "{:e}", summary.energy_drift);
}

#[test]
fn a_ring_rolls_down_a_slope_on_its_outer_face() {
    // a = g sin θ/(1 + (R² + α)/R_o²): without couples of friction at the face it would be off by 6 %.
    let (radius, thickness, slope, elements, young) = (0.1, 0.012, 0.3_f64, 60, 4e9);
    let mut model = model(0.4);
    model.materials.insert("soft".into(), elastic(young, 7800.0));
    let outer = radius + 0.5 * thickness;
    let above = outer + 3e-6;
    let centre = [-slope.sin() * above, slope.cos() * above];
    shells(&mut model, "ring", CircularArc { centre, radius, elements, ..CircularArc::default() }, thickness, "plane_strain");
    model.obstacles.push(Obstacle { interface: rough(0.9), ..Obstacle::wall("slope", [0.0; 2], [-slope.sin(), slope.cos()]) });
    gravity(&mut model, [0.0, -9.81]);
    model.loads.push(Load::StiffnessDamping { parts: vec![], time: 3e-6 });
    let mut simulation = simulation(&model);
    // The slope of the velocity, which swings as the ring does under its weight.
    let mut seen: Vec<[f64; 2]> = Vec::new();
    for at in 100..=400 {
        simulation.advance(1e-3 * f64::from(at), u64::MAX).unwrap();
        seen.push([simulation.time(), value(&simulation, "ring.vx") / -slope.cos()]);
    }
    let [time, velocity] = [0, 1].map(|k| seen.iter().map(|row| row[k]).sum::<f64>() / seen.len() as f64);
    let product = |a: usize, b: usize| -> f64 {
        let means = [time, velocity];
        seen.iter().map(|row| (row[a] - means[a]) * (row[b] - means[b])).sum()
    };
    let found = product(0, 1) / product(0, 0);
    let stiff = young / (1.0 - 0.09) / (5.0 / 6.0 * young / 2.6) - 1.0;
    let length = 2.0 * radius * (PI / elements as f64).sin();
    let alpha = (thickness * thickness / 12.0_f64).max(length * length / (4.0 * stiff));
    let expected = 9.81 * slope.sin() / (1.0 + (radius * radius + alpha) / (outer * outer));
    // A polygon loses energy at each of its corners.
    assert!((found / expected - 1.0).abs() < 0.012, "{found} for {expected}");
}

#[test]
fn pressure_acts_on_the_face_where_it_is() {
    // N = p R_i; u = N R/(E* t).
    let (radius, thickness, pressure, elements) = (0.1, 0.01, 1e6, 60);
    let mut model = steel(2e-3);
    shells(&mut model, "pipe", CircularArc { radius, elements, ..CircularArc::default() }, thickness, "plane_strain");
    let curve = slowly(&mut model, 1e-3);
    model.loads.push(Load::Pressure { on: "pipe.left".into(), pressure, curve });
    model.loads.push(Load::Damping { parts: vec![], rate: 2e4, active: [0.0, f64::INFINITY] });
    probe(&mut model, "right", "pipe", [radius, 0.0]);
    let simulation = to_end(&model);
    let inner = radius - 0.5 * thickness;
    let expected = pressure * inner * radius / (200e9 / (1.0 - 0.09) * thickness);
    let found = value(&simulation, "right.x") - radius;
    assert!((found / expected - 1.0).abs() < 5e-3, "{found} for {expected}");
}

/// Two sheets of steel that flow and fail, and a ring between them.
fn crash(end: f64, elements: usize) -> Model {
    let mut model = steel(end);
    let mut flows = material("j2", 0.3);
    for (name, value) in [("young", 200e9), ("density", 7800.0), ("yield", 300e6), ("hardening", 1e9)] {
        flows.parameters.insert(name.into(), value);
    }
    flows.failure.insert("plastic_strain".into(), 0.05);
    model.materials.insert("soft".into(), flows);
    steel_strip(&mut model, "lower", [[0.0, 0.0], [0.2, 0.0]], 0.002, elements, [0.0, 0.0]);
    steel_strip(&mut model, "upper", [[0.02, 0.05], [0.18, 0.045]], 0.002, elements, [0.0, -200.0]);
    shells(
        &mut model,
        "ring",
        CircularArc { centre: [0.1, 0.024], radius: 0.02, elements, ..CircularArc::default() },
        0.001,
        "plane_strain",
    );
    model.parts[1].section = Some(ShellSection { points: 4, failed_points: 0.5, ..section(0.002) });
    all_touch(&mut model, Some(0.2));
    model
}

#[test]
fn sheets_that_flow_and_fail_close_the_ledger_and_continue_where_they_were_kept() {
    let model = crash(4e-4, 40);
    let hash = hash_of_equal_bits(&model, &[1, 2], "crash");
    let mut half = simulation(&model);
    half.advance(2e-4, u64::MAX).unwrap();
    continues_to(&hash, &model, &mut half, "crash");
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.last("energy.plastic") > 100.0 && history.last("energy.eroded") > 0.0);
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.02, "{:e} {:e}", summary.ledger_residual, summary.energy_drift);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12);
}

#[test]
fn threads_and_instructions_change_no_bit_of_many_shells() {
    let mut model = crash(1.0, 2000);
    model.run.max_steps = Some(40);
    model.parts[1].shape = Line { points: vec![[0.02, 0.0021], [0.18, 0.00215]], radius: 0.0, closed: false, elements: 2000 }.into();
    model.parts.pop();
    model.probes.pop();
    shells(&mut model, "third", straight(0.1, 1000), 0.002, "plane_strain");
    hash_of_equal_bits(&model, &[1, 2, 3], "many");
}

#[test]
fn what_is_said_of_a_face_holds_for_the_middle() {
    let thrown = || {
        let mut model = steel(1e-4);
        steel_strip(&mut model, "strip", [[0.0, 0.0], [0.1, 0.0]], 0.002, 10, [1.0, 0.0]);
        model
    };
    let mut held = thrown();
    held.constraints.push(Constraint { on: "strip.left".into(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() });
    assert_eq!(value(&to_end(&held), "strip.vx"), 0.0);
    let mut heavy = thrown();
    heavy.point_masses.push(PointMass { on: "strip.right".into(), mass: 1.0 });
    let kinetic = value(&to_end(&heavy), "energy.kinetic");
    assert!((kinetic / (0.5 * (0.1 * 0.002 * 7800.0 + 1.0)) - 1.0).abs() < 1e-9, "{kinetic}");
    // Joined to another strip along the whole of both: they fly as one.
    let mut joined = thrown();
    steel_strip(&mut joined, "other", [[0.0, 0.0], [0.1, 0.0]], 0.002, 10, [0.0, 2.0]);
    joined.joins.push(Join { between: ["strip".into(), "other.left".into()], image: Image::Same, tolerance: None });
    let (simulation, _) = run(&joined);
    assert!((value(&simulation, "strip.vx") - 0.5).abs() < 1e-12 && (value(&simulation, "other.vy") - 1.0).abs() < 1e-12);
    // A spring between the faces of two strips pulls at both.
    let mut sprung = thrown();
    steel_strip(&mut sprung, "other", [[0.0, 0.02], [0.1, 0.02]], 0.002, 10, [0.0, 2.0]);
    let between = ["strip.left".to_string(), "other.right".to_string()];
    sprung.springs.push(Spring { between, stiffness: 1e6, ..Spring::default() });
    let (simulation, _) = run(&sprung);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3);
    assert!(value(&simulation, "strip.vy") > 1e-4, "{}", value(&simulation, "strip.vy"));
    // A force on a face moves the whole: v = F t/m.
    let mut pulled = thrown();
    pulled.loads.push(Load::Force { on: "strip.left".into(), force: [0.0, 156.0, 0.0], curve: None });
    let velocity = value(&to_end(&pulled), "strip.vy");
    assert!((velocity / (156.0 * 1e-4 / (0.1 * 0.002 * 7800.0)) - 1.0).abs() < 1e-2, "{velocity}");
}

#[test]
fn a_rigid_sheet_carries_its_faces_along() {
    // Momentum of a sheet that is thrown at a rigid one, both free: no face stays behind.
    let mut model = steel(4e-4);
    steel_strip(&mut model, "lower", [[0.0, 0.0], [0.1, 0.0]], 0.002, 10, [0.0, 0.0]);
    model.parts[0].rigid = Some(embate_solver::model::Motion::default());
    steel_strip(&mut model, "upper", [[0.0, 0.003], [0.1, 0.003]], 0.002, 10, [0.0, -10.0]);
    all_touch(&mut model, None);
    let simulation = to_end(&model);
    let (lower, upper) = (value(&simulation, "lower.vy"), value(&simulation, "upper.vy"));
    assert!((lower + upper + 10.0).abs() < 1e-9 && lower < -5.0 && upper > lower, "{lower} {upper}");
    let y = value(&simulation, "upper.y") - value(&simulation, "lower.y");
    assert!(y > 0.0019, "{y}");
}

#[test]
fn three_sheets_at_one_line_have_an_outside_without_a_hole() {
    // A foot stands on a sheet; a third one comes from the side in which no sheet leaves the joint.
    let mut model = steel(2e-4);
    let lines = vec![vec![[-0.05, 0.0], [0.0, 0.0], [0.05, 0.0]], vec![[0.0, 0.0], [0.0, 0.05]]];
    shells(&mut model, "foot", Shape::Truss(Truss { lines, elements: 5 }), 0.002, "plane_strain");
    steel_strip(&mut model, "thrown", [[-0.03, -0.003], [0.03, -0.003]], 0.002, 6, [0.0, 20.0]);
    all_touch(&mut model, None);
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.last("energy.total").is_finite() && summary.energy_drift < 5e-3, "{:e}", summary.energy_drift);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.ledger_residual < 1e-12);
    assert!(value(&simulation, "foot.vy") > 1.0, "{}", value(&simulation, "foot.vy"));
}

#[test]
fn models_of_shells_that_make_no_sense_are_told_what_is_wrong() {
    let sound = || {
        let mut model = model(1e-3);
        shells(&mut model, "strip", straight(0.1, 4), 0.002, "plane_strain");
        model
    };
    assert_eq!(faults(&sound()), Vec::<String>::new());
    let told = |change: &dyn Fn(&mut Model), words: &str| {
        let mut model = sound();
        change(&mut model);
        let faults = faults(&model);
        assert!(faults.iter().any(|fault| fault.contains(words)), "{words}: {faults:?}");
    };
    told(&|model| model.parts[0].section = None, "shells need their thickness");
    told(&|model| model.parts[0].section = Some(ShellSection { points: 11, ..section(0.1) }), "1 to 10 points");
    told(&|model| model.parts[0].section = Some(ShellSection { points: 2, rule: "lobatto".into(), ..section(0.1) }), "3 to 10 points");
    told(&|model| model.parts[0].section = Some(section(-0.1)), "section.thickness");
    told(&|model| model.parts[0].element = "bar2".into(), "that of shells");
    told(&|model| model.parts[0].shape = mapped_rectangle(), "shell2");
    told(&|model| model.run.stable_step = embate_solver::model::StableStep::Nodes, "knows no rotations");
    told(&|model| model.loads.push(Load::Moment { on: "strip.end".into(), moment: [1.0, 0.0, 0.0], curve: None }), "about z");
    let on_solid = |model: &mut Model| {
        add(model, "block", mapped_rectangle(), [0.0; 2]);
        model.loads.push(Load::Moment { on: "block.left".into(), moment: [0.0, 0.0, 1.0], curve: None });
    };
    told(&on_solid, "no rotations");
    let on_rigid = |model: &mut Model| {
        model.parts[0].rigid = Some(embate_solver::model::Motion::default());
        model.loads.push(Load::Moment { on: "strip.end".into(), moment: [0.0, 0.0, 1.0], curve: None });
    };
    told(&on_rigid, "rigid");
    let too_thick = |model: &mut Model| {
        model.parts[0].shape = CircularArc { radius: 0.01, elements: 20, ..CircularArc::default() }.into();
        model.parts[0].section = Some(section(0.025));
    };
    told(&too_thick, "too thick for its bend");
    let quiet = |model: &mut Model| model.non_reflecting.push(NonReflecting { on: "strip.left".into() });
    told(&quiet, "no waves come through its faces");
    told(&|model| model.parts[0].hourglass = Some(0.1), "no hourglass control");
    let pushed = |model: &mut Model| {
        let interface = Interface { initial_penetration: InitialPenetration::PushOut, ..Interface::default() };
        model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(vec![]), interface, ..Contact::default() });
    };
    told(&pushed, "pushed out one by one");
    let spun = |model: &mut Model| {
        model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], point: [0.0; 3], parts: vec![], name: String::new() });
        model.constraints.push(Constraint { on: "strip.start".into(), spin: [None, None, Some(1.0.into())], ..Constraint::default() });
    };
    told(&spun, "keeps it from rotating");
}
