//! Gas in closed surfaces: closed forms of pistons and vessels, the energy that goes from gas to walls, parts
//! of bodies against the whole, the stable step, equal bits, and faults.

use crate::bodies::*;
use crate::restart::continues;
use crate::sheet_models::sheet;
use crate::shells::section;
use embate_solver::model::{
    Cavity, CircularArc, Constraint, Curve, CurveShape, Drive, Inflow, Line, Material, Model, Ring, Sphere, Symmetry, Vent,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A part of shells of the material `soft` in 2D.
fn shells(model: &mut Model, name: &str, shape: impl Into<embate_solver::model::Shape>, thickness: f64, state: &str) {
    add(model, name, shape.into(), [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section, part.stress_state) = ("shell2".into(), Some(section(thickness)), state.into());
}

fn gas(on: &[&str], pressure: f64, ambient: f64) -> Cavity {
    Cavity { name: "gas".into(), on: on.iter().map(ToString::to_string).collect(), pressure: Some(pressure), ambient, ..Cavity::default() }
}

fn mirror(model: &mut Model, point: [f64; 3], normal: [f64; 3]) {
    model.symmetries.push(Symmetry { point, normal, ..Symmetry::default() });
}

/// Height and mass (per metre of depth) of the gas under the piston and of this.
const HEIGHT: f64 = 0.05;
const WIDTH: f64 = 0.01;
const PISTON: f64 = 7800.0 * WIDTH * WIDTH;

/// A block of steel on a column of gas between two planes of symmetry, over a floor that is held.
fn piston(pressure: f64, ambient: f64, exponent: f64, speed: f64, end: f64) -> Model {
    let mut model = model(end);
    model.materials.insert("soft".into(), elastic(200e9, 7800.0));
    add(&mut model, "piston", rectangle([0.0, HEIGHT], [WIDTH; 2], [2, 2]), [0.0, speed]);
    add(&mut model, "floor", rectangle([0.0, -WIDTH], [WIDTH; 2], [1, 1]), [0.0; 2]);
    for x in [0.0, WIDTH] {
        mirror(&mut model, [x, 0.0, 0.0], [1.0, 0.0, 0.0]);
    }
    model.constraints.push(Constraint {
        on: "floor".into(),
        velocity: [Some(0.0.into()), Some(0.0.into()), None],
        ..Constraint::default()
    });
    model.cavities.push(Cavity { exponent, ..gas(&["piston.bottom", "floor.top"], pressure, ambient) });
    model
}

#[test]
fn a_piston_swings_on_its_gas_with_the_frequency_of_the_closed_form() {
    for exponent in [1.4, 1.0] {
        // ω² = γ p A²/(V M).
        let omega = (exponent * 1e6 * WIDTH / (HEIGHT * PISTON)).sqrt();
        let mut model = piston(1e6, 1e6, exponent, 0.05, 2.2 * TAU / omega);
        model.output.history = embate_solver::model::Cadence::Interval(1e-3 * TAU / omega);
        let (simulation, history) = run(&model);
        let (time, volume) = (history.column("time"), history.column("cavity.volume[gas]"));
        let volume: Vec<f64> = volume.iter().map(|v| v / (WIDTH * HEIGHT) - 1.0).collect();
        // Where it comes down through the middle: once in each period.
        let falls: Vec<f64> = (1..time.len())
            .filter(|&k| volume[k - 1] > 0.0 && volume[k] <= 0.0)
            .map(|k| time[k - 1] + (time[k] - time[k - 1]) * volume[k - 1] / (volume[k - 1] - volume[k]))
            .collect();
        assert_eq!(falls.len(), 2, "{falls:?}");
        let period = falls[1] - falls[0];
        assert!((period * omega / TAU - 1.0).abs() < 1e-4, "{exponent}: {period} {}", TAU / omega);
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-6, "{:e} {:e}", summary.ledger_residual, summary.energy_drift);
    }
}

#[test]
fn a_piston_turns_where_the_work_of_its_gas_is_its_energy() {
    // ½ M v² = p₀ V₀/(γ − 1) ((V₀/V)^(γ−1) − 1) − p_a (V₀ − V); of an isothermal gas p₀ V₀ ln(V₀/V) − ….
    for (exponent, ambient) in [(1.4, 1e5), (1.25, 1e6), (1.0, 0.0)] {
        let speed = -25.0_f64;
        let mut model = piston(1e6, ambient, exponent, speed, 2.5 * HEIGHT / speed.abs());
        model.output.history = embate_solver::model::Cadence::Interval(2e-6);
        let (simulation, history) = run(&model);
        let start = WIDTH * HEIGHT;
        let energy = |volume: f64| {
            let ratio: f64 = start / volume;
            let stored = if exponent == 1.0 { ratio.ln() } else { (ratio.powf(exponent - 1.0) - 1.0) / (exponent - 1.0) };
            1e6 * start * stored - ambient * (start - volume)
        };
        // The last place where it still moves inwards.
        let (mut low, mut high) = (0.01 * start, start);
        while high - low > 1e-12 * start {
            let middle = 0.5 * (low + high);
            if energy(middle) > 0.5 * PISTON * speed * speed { low = middle } else { high = middle }
        }
        let least = history.column("cavity.volume[gas]").into_iter().fold(f64::INFINITY, f64::min);
        assert!((least / low - 1.0).abs() < 2e-4, "{exponent} {ambient}: {least} {low}");
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-4, "{:e} {:e}", summary.ledger_residual, summary.energy_drift);
        // What the walls got is what the gas says that it did, and what it lost.
        let (work, external) = (history.last("cavity.work[gas]"), history.last("energy.external"));
        let scale = 0.5 * PISTON * speed * speed;
        assert!((work - external).abs() < 1e-6 * scale, "{work} {external}");
        let volume = history.last("cavity.volume[gas]");
        assert!((work + energy(volume)).abs() < 1e-6 * scale, "{work} {}", energy(volume));
        if exponent > 1.0 {
            let lost = history.first("cavity.energy[gas]") - history.last("cavity.energy[gas]") - ambient * (volume - start);
            assert!((work - lost).abs() < 1e-6 * scale, "{work} {lost}");
        }
    }
}

#[test]
fn without_the_stiffness_of_the_gas_the_step_would_be_too_long() {
    // A block of one element that is so soft that only the gas holds its lower nodes: ω² = γ p/V Σ A_i²/m_i.
    let (height, pressure) = (1e-3, 1e6);
    let mut model = model(0.05);
    model.materials.insert("soft".into(), elastic(1e4, 1e3));
    add(&mut model, "block", rectangle([0.0, height], [WIDTH; 2], [1, 1]), [0.0, -0.01]);
    add(&mut model, "floor", rectangle([0.0, -WIDTH], [WIDTH; 2], [1, 1]), [0.0; 2]);
    for x in [0.0, WIDTH] {
        mirror(&mut model, [x, 0.0, 0.0], [1.0, 0.0, 0.0]);
    }
    let still = Constraint { on: "floor".into(), velocity: [Some(0.0.into()), Some(0.0.into()), None], ..Constraint::default() };
    model.constraints.push(still);
    let mut elements = model.clone();
    elements.cavities.clear();
    model.cavities.push(gas(&["block.bottom", "floor.top"], pressure, pressure));
    let (free, held) = (simulation(&elements).time_step(), simulation(&model));
    // Both blocks count as if they moved.
    let omega = (1.4 * pressure / (WIDTH * height) * 4.0 * 0.25 * WIDTH * WIDTH / (0.25 * 1e3 * WIDTH * WIDTH)).sqrt();
    let bound = 0.9 * 2.0 / omega;
    assert!(held.time_step() < bound && held.time_step() > 0.95 * bound && free > 3.0 * bound, "{} {bound} {free}", held.time_step());
    assert!(held.overview().governor.contains("cavity \"gas\""), "{}", held.overview().governor);
    let summary = to_end(&model).summary();
    assert!(summary.energy_drift < 1e-2 && summary.steps > 100, "{:e} {}", summary.energy_drift, summary.steps);
}

/// A ball of rubber with more pressure inside than outside; as much of it as is asked for.
fn ball(portion: &str, elements: usize, end: f64) -> Model {
    let mut model = model(end);
    model.materials.insert("soft".into(), elastic(50e6, 1e3));
    let sphere = Sphere { radius: 0.1, elements, portion: portion.into(), ..Sphere::default() };
    sheet(&mut model, "ball", sphere, 0.002, [0.0; 3], [0.0; 3]);
    model.cavities.push(gas(&["ball.lower"], 1.05e5, 1e5));
    model
}

#[test]
fn a_ball_breathes_alone_with_both_momenta_and_the_ledger_kept() {
    let mut model = ball("whole", 4, 4e-3);
    model.parts[0].velocity = [3.0, -2.0, 5.0];
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.energy_drift < 1e-5, "{:e}", summary.energy_drift);
    // p V^γ; the work of the gas is what it lost, less what the pressure outside got, and what the ball got.
    let [pressure, volume, energy] = ["pressure", "volume", "energy"].map(|name| history.column(&format!("cavity.{name}[gas]")));
    let start = pressure[0] * volume[0].powf(1.4);
    assert!(pressure.iter().zip(&volume).all(|(p, v)| (p * v.powf(1.4) / start - 1.0).abs() < 1e-13));
    let (least, most) = volume.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), &v| (low.min(v), high.max(v)));
    assert!(most / least > 1.003, "{least} {most}");
    let last = volume.len() - 1;
    let lost = energy[0] - energy[last] - 1e5 * (volume[last] - volume[0]);
    let largest = history.largest("energy.external");
    assert!((history.last("cavity.work[gas]") - lost).abs() < 1e-4 * largest, "{} {lost}", history.last("cavity.work[gas]"));
    assert!((history.last("energy.external") - lost).abs() < 1e-4 * largest, "{} {lost}", history.last("energy.external"));
}

#[test]
fn a_ball_has_the_period_of_a_membrane_on_its_gas() {
    // ρ t ü = −(2 E t/((1 − ν) R²) + 3 γ p/R) u: half a meridian of cones, closed by the axis and a plane.
    let (radius, thickness): (f64, f64) = (0.1, 0.002);
    let mut model = model(4e-3);
    model.materials.insert("soft".into(), elastic(50e6, 1e3));
    let arc = CircularArc { radius, from: 0.0, to: FRAC_PI_2, elements: 40, ..CircularArc::default() };
    shells(&mut model, "wall", arc, thickness, "axisymmetric");
    mirror(&mut model, [0.0; 3], [0.0, 1.0, 0.0]);
    model.cavities.push(gas(&["wall.left"], 1.001e5, 1e5));
    model.output.history = embate_solver::model::Cadence::Interval(1e-5);
    let (_, history) = run(&model);
    let (time, volume) = (history.column("time"), history.column("cavity.volume[gas]"));
    let inner = radius - 0.5 * thickness;
    assert!((volume[0] / (2.0 / 3.0 * PI * inner.powi(3)) - 1.0).abs() < 1e-3, "{}", volume[0]);
    let omega2 = 2.0 * 50e6 / (0.7 * 1e3 * radius * radius);
    // The inner face moves as the middle; on its area and radius the gas acts.
    let of_gas = 3.0 * 1.4 * 1.001e5 / (inner * 1e3 * thickness) * (inner / radius).powi(2);
    let exact = TAU / (omega2 + of_gas).sqrt();
    let (low, high) = volume.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), &v| (low.min(v), high.max(v)));
    let middle = 0.5 * (low + high);
    let rises: Vec<f64> = (1..time.len())
        .filter(|&k| volume[k - 1] < middle && volume[k] >= middle)
        .map(|k| time[k - 1] + (time[k] - time[k - 1]) * (middle - volume[k - 1]) / (volume[k] - volume[k - 1]))
        .collect();
    let period = (rises[rises.len() - 1] - rises[0]) / (rises.len() - 1) as f64;
    assert!((period / exact - 1.0).abs() < 3e-3 && (period / (TAU / omega2.sqrt()) - 1.0).abs() > 0.05, "{period} {exact}");
}

#[test]
fn an_eighth_of_a_ball_between_planes_of_symmetry_does_as_the_whole() {
    let end = 1e-3;
    let whole = run(&ball("whole", 4, end)).1;
    for (portion, axes, share) in [("half", 1, 0.5), ("quarter", 2, 0.25), ("eighth", 3, 0.125)] {
        let mut model = ball(portion, 4, end);
        for axis in 0..axes {
            mirror(&mut model, [0.0; 3], std::array::from_fn(|d| f64::from(u8::from(d == axis))));
        }
        let part = run(&model).1;
        for (name, factor) in [("pressure", 1.0), ("volume", share), ("mass", share), ("energy", share)] {
            let [all, own] = [&whole, &part].map(|history| history.last(&format!("cavity.{name}[gas]")));
            assert!((own / (factor * all) - 1.0).abs() < 1e-6, "{portion} {name}: {own} {all}");
        }
    }
}

#[test]
fn a_quarter_of_a_tube_between_lines_of_symmetry_does_as_the_whole() {
    let tube = |to: f64, elements: usize| {
        let mut model = model(3e-3);
        model.materials.insert("soft".into(), elastic(50e6, 1e3));
        shells(&mut model, "tube", CircularArc { radius: 0.1, to, elements, ..CircularArc::default() }, 0.002, "plane_strain");
        let inflow = vec![Inflow { rate: 30.0 * to / TAU, curve: None, temperature: Drive::Constant(500.0) }];
        let vents = vec![Vent { orifice: 0.02 * to / TAU, discharge: 0.7, opens_at: Some(1.2e5) }];
        model.cavities.push(Cavity { inflow, vents, ..gas(&["tube.left"], 1e5, 1e5) });
        model
    };
    let whole = run(&tube(TAU, 48)).1;
    let mut quarter = tube(FRAC_PI_2, 12);
    mirror(&mut quarter, [0.0; 3], [1.0, 0.0, 0.0]);
    mirror(&mut quarter, [0.0; 3], [0.0, 1.0, 0.0]);
    let quarter = run(&quarter).1;
    for (name, factor) in [("pressure", 1.0), ("volume", 0.25), ("mass", 0.25), ("temperature", 1.0)] {
        let [all, own] = [&whole, &quarter].map(|history| history.last(&format!("cavity.{name}[gas]")));
        assert!((own / (factor * all) - 1.0).abs() < 1e-9, "{name}: {own} {all}");
    }
    assert!(whole.largest("cavity.pressure[gas]") > 1.2e5 && whole.last("cavity.mass[gas]") > 1.1 * whole.first("cavity.mass[gas]"));
}

#[test]
fn runs_with_gas_continue_and_have_equal_bits() {
    let mut model = model(2e-3);
    model.materials.insert("soft".into(), elastic(50e6, 1e3));
    shells(&mut model, "tube", CircularArc { radius: 0.1, elements: 24, ..CircularArc::default() }, 0.004, "plane_strain");
    let shape = CurveShape::Table { times: vec![0.0, 1e-3], values: vec![0.0, 1.0], smooth: true };
    model.curves.insert("burn".into(), Curve::from(shape));
    let inflow = vec![Inflow { rate: 40.0, curve: Some("burn".into()), temperature: Drive::Constant(600.0) }];
    let vents =
        vec![Vent { orifice: 0.02, discharge: 0.7, opens_at: Some(1.05e5) }, Vent { orifice: 0.01, discharge: 1.0, opens_at: None }];
    model.cavities.push(Cavity { inflow, vents, ..gas(&["tube.left"], 1e5, 1e5) });
    continues("gas in a tube", &model, 400);
    hash_of_equal_bits(&model, &[1, 3], "gas in a tube");
    hash_of_equal_bits(&ball("whole", 4, 5e-4), &[1, 2], "ball");
}

#[test]
fn a_wall_that_is_eroded_lets_the_gas_go() {
    // A tube with a weak half, and twice the pressure that it bears.
    let mut model = model(3e-3);
    let mut weak = Material { law: "j2".into(), ..elastic(50e6, 1e3) };
    weak.parameters.extend([("yield".to_string(), 1e6), ("hardening".to_string(), 1e6)]);
    weak.failure.insert("plastic_strain".into(), 0.05);
    model.materials.insert("weak".into(), weak);
    model.materials.insert("soft".into(), elastic(50e6, 1e3));
    shells(&mut model, "tube", CircularArc { radius: 0.1, elements: 24, ..CircularArc::default() }, 0.002, "plane_strain");
    model.parts[0].material = "weak".into();
    model.cavities.push(gas(&["tube.left"], 3e5, 1e5));
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    let notice = summary.warnings.iter().find(|notice| notice.kind.code == "W0604");
    assert!(notice.is_some_and(|notice| notice.text.contains("cavity \"gas\"")), "{:?}", summary.warnings);
    let (work, external) = (history.column("cavity.work[gas]"), history.column("energy.external"));
    let last = work.len() - 1;
    // Nothing is done any more.
    assert!(work[last] > 0.0 && work[last] == work[last - 1] && external[last] == external[last - 1], "{work:?} {external:?}");
    assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
    // What is kept after that stays open.
    let mut half = crate::bodies::simulation(&model);
    half.advance(2.5e-3, u64::MAX).unwrap();
    continues_to(&summary.state_hash, &model, &mut half, "an open cavity");
}

#[test]
fn surfaces_that_enclose_no_gas_are_refused_with_place_and_cure() {
    let tube = |on: &[&str], to: f64| {
        let mut model = model(1e-3);
        shells(&mut model, "tube", CircularArc { radius: 0.1, to, ..CircularArc::default() }, 0.002, "plane_strain");
        add(&mut model, "solid", Ring { inner: 0.2, outer: 0.3, ..Ring::default() }.into(), [0.0; 2]);
        model.cavities.push(gas(on, 2e5, 1e5));
        model
    };
    let found = |model: &Model| model_faults(model).iter().map(|fault| (fault.kind.code, fault.path.clone())).collect::<Vec<_>>();
    let one = |code: &'static str, path: &str| vec![(code, path.to_string())];
    for sound in [&["tube.left"][..], &["solid.inner"], &["solid.inner", "tube.right"]] {
        assert_eq!(found(&tube(sound, TAU)), [], "{sound:?}");
    }
    let open = tube(&["tube.left"], PI);
    assert_eq!(found(&open), one("E0516", "cavity[0].on"));
    assert!(faults(&open)[0].contains("2 piece(s)") && faults(&open)[0].contains("[[symmetry]]"), "{:?}", faults(&open));
    for wrong in [&["tube.right"][..], &["solid.outer"], &["solid"], &["tube.left", "tube.right"]] {
        assert_eq!(found(&tube(wrong, TAU)), one("E0517", "cavity[0].on"), "{wrong:?}");
    }
    assert_eq!(found(&tube(&["solid.inner", "solid"], TAU)), one("E0117", "cavity[0].on"));
    assert_eq!(found(&tube(&["nothing"], TAU)), one("E0116", "cavity[0].on[0]"));
    let wrong = |change: &dyn Fn(&mut Model)| {
        let mut model = tube(&["tube.left"], TAU);
        change(&mut model);
        found(&model)
    };
    assert_eq!(wrong(&|model| model.cavities[0].exponent = 0.9), one("E0110", "cavity[0].exponent"));
    assert_eq!(wrong(&|model| model.cavities[0].temperature = -1.0), one("E0110", "cavity[0].temperature"));
    assert_eq!(wrong(&|model| (model.cavities[0].pressure, model.cavities[0].ambient) = (None, 0.0)), one("E0110", "cavity[0].pressure"));
    assert_eq!(wrong(&|model| model.cavities.push(model.cavities[0].clone())), one("E0117", "cavity[1].name"));
    assert_eq!(wrong(&|model| model.run.subcycling = true), one("E0113", "run.subcycling"));
    let inflow = |temperature: f64| Inflow { rate: 1.0, curve: None, temperature: Drive::Constant(temperature) };
    assert_eq!(wrong(&|model| model.cavities[0].inflow.push(inflow(0.0))), one("E0110", "cavity[0].inflow[0].temperature"));
    let falls = |model: &mut Model| {
        model.curves.insert("falls".into(), Curve::table(vec![0.0, 1e-3], vec![1.0, -0.5]));
        model.cavities[0].inflow.push(Inflow { curve: Some("falls".into()), ..inflow(300.0) });
    };
    assert_eq!(wrong(&falls), one("E0110", "cavity[0].inflow[0].curve"));
    let vent = Vent { orifice: 1e-3, discharge: 1.5, opens_at: None };
    assert_eq!(wrong(&|model| model.cavities[0].vents.push(vent.clone())), one("E0110", "cavity[0].vents[0].discharge"));
}

#[test]
fn a_surface_that_turns_inside_out_ends_the_run_and_says_so() {
    // A floor and a lid that nothing holds apart but gas that is too thin.
    let mut model = piston(100.0, 100.0, 1.4, -2000.0, 1e-3);
    model.cavities[0].exponent = 1.0;
    model.run.time_step = Some(1e-6);
    let mut simulation = simulation(&model);
    let error = simulation.advance(f64::INFINITY, u64::MAX).unwrap_err();
    assert_eq!(error.kind().unwrap().code, "E0610", "{error}");
    assert!(error.to_string().contains("cavity \"gas\""), "{error}");
}

#[test]
fn shells_that_meet_in_folds_and_at_joints_enclose_gas() {
    // A square of four lines, in one part, and with a wall between: two cavities.
    let (size, thickness) = (0.1, 0.002);
    let mut model = model(1e-4);
    let frame = Line { points: vec![[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]], radius: 0.0, closed: true, elements: 16 };
    shells(&mut model, "frame", frame, thickness, "plane_strain");
    model.cavities.push(gas(&["frame.left"], 1.1e5, 1e5));
    let inner = size - thickness;
    let found = value(&simulation(&model), "cavity.volume[gas]");
    assert!((found / (inner * inner) - 1.0).abs() < 1e-12, "{found}");
}
