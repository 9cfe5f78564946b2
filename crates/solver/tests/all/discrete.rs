//! Springs, dampers and point masses against closed forms.

use super::patches::material;
use embate_solver::model::{Constraint, Drive, Load, Model, Motion, Part, PointMass, Rectangle, Run, Shape, Spring};
use embate_solver::simulation::{Options, Simulation};

const SIDE: f64 = 1.0;

/// Two squares of one metre, two metres apart, `springs` between them; the left one is held, the right one
/// rigid with 2 kg/m.
fn model(spring: Spring, velocity: f64) -> Model {
    let mut model = Model { run: Run { end: 10.0, ..Run::default() }, ..Model::default() };
    model.materials.insert("m".into(), material("elastic", 0.3));
    for (name, x) in [("left", 0.0), ("right", 3.0)] {
        let shape = Shape::Rectangle(Rectangle { corner: [x, 0.0], size: [SIDE; 2], elements: [1, 1], ..Rectangle::default() });
        model.parts.push(Part { name: name.into(), material: "m".into(), shape, ..Part::default() });
    }
    let still = Some(Drive::Constant(0.0));
    model.constraints.push(Constraint { on: "left".into(), velocity: [still.clone(), still, None], ..Constraint::default() });
    model.parts[1].rigid = Some(Motion::default());
    model.parts[1].velocity = [velocity, 0.0, 0.0];
    model.springs.push(Spring { between: ["left.right".into(), "right.left".into()], ..spring });
    model.output.pictures = false;
    model
}

fn run(model: &Model, time: f64, mut see: impl FnMut(&Simulation, f64)) -> Simulation {
    let mut simulation = Simulation::new(model, &Options { threads: 1, simd: None }).unwrap();
    while simulation.time() < time {
        simulation.advance(time, 1).unwrap();
        let left = simulation.frame().positions::<2>().iter().map(|x| x[0]).filter(|x| *x > 1.5).fold(f64::INFINITY, f64::min);
        see(&simulation, left - 3.0);
    }
    simulation
}

#[test]
fn a_mass_on_springs_swings_with_its_frequency() {
    // Two springs of 50 N/m/m on 2 kg/m: ω² = 50.
    let mut model = model(Spring { stiffness: 50.0, ..Spring::default() }, 0.1);
    model.run.time_step = Some(1e-3);
    let omega = 50.0f64.sqrt();
    let mut worst = 0.0f64;
    let simulation = run(&model, 3.0, |simulation, u| worst = worst.max((u - 0.1 / omega * (omega * simulation.time()).sin()).abs()));
    println!("off by {worst:.2e} of {:.2e}, drift {:.1e}", 0.1 / omega, simulation.ledger().drift());
    assert!(worst < 2e-3 * 0.1 / omega && simulation.ledger().drift() < 1e-3);
}

#[test]
fn a_point_mass_makes_a_body_slower_and_heavier() {
    let mut model = model(Spring { stiffness: 50.0, ..Spring::default() }, 0.1);
    model.run.time_step = Some(1e-3);
    model.point_masses.push(PointMass { on: "right".into(), mass: 6.0 });
    let omega = 12.5f64.sqrt();
    let mut worst = 0.0f64;
    let simulation = run(&model, 3.0, |simulation, u| worst = worst.max((u - 0.1 / omega * (omega * simulation.time()).sin()).abs()));
    assert!(worst < 2e-3 * 0.1 / omega, "{worst}");
    let kinetic = 0.5 * 8.0 * 0.01;
    let stores = simulation.ledger().stores;
    assert!((stores.total() / kinetic - 1.0).abs() < 1e-3, "{} of {kinetic}", stores.total());
    // Gravity pulls on it too.
    let mut falling = model.clone();
    falling.springs.clear();
    falling.loads.push(Load::Gravity { parts: Vec::new(), acceleration: [2.0, 0.0, 0.0], curve: None });
    let mut at = 0.0;
    run(&falling, 0.5, |_, u| at = u);
    assert!((at - (0.05 + 0.25)).abs() < 2e-3, "{at}");
}

#[test]
fn a_damper_takes_the_energy_and_books_it() {
    // Two dampers of 2 Pa s on 2 kg/m: v = v₀ exp(−2 t).
    let mut model = model(Spring { damping: 2.0, ..Spring::default() }, 0.1);
    model.run.time_step = Some(1e-3);
    let mut at = 0.0;
    let simulation = run(&model, 1.0, |_, u| at = u);
    let expected = 0.05 * (1.0 - (-2.0f64).exp());
    println!("{at} for {expected}, drift {:.1e}", simulation.ledger().drift());
    assert!((at / expected - 1.0).abs() < 5e-3 && simulation.ledger().drift() < 5e-3, "{at} for {expected}");
}

#[test]
fn a_spring_breaks_at_its_strength_and_its_energy_is_gone_into_dissipation() {
    let mut model = model(Spring { stiffness: 50.0, strength: Some(0.25), ..Spring::default() }, 0.1);
    model.run.time_step = Some(1e-3);
    let simulation = run(&model, 2.0, |_, _| ());
    // Broken at 5 mm: ½ · 50 · 0.005² each.
    let stores = simulation.ledger().stores;
    println!("{} dissipated, drift {:.1e}", stores.plastic, simulation.ledger().drift());
    assert!((stores.plastic / (50.0 * 0.005f64.powi(2)) - 1.0).abs() < 0.1 && stores.elastic.abs() < 1e-9, "{stores:?}");
    assert!(simulation.ledger().drift() < 0.02);
}

#[test]
fn a_curve_of_force_over_elongation_is_followed_and_stored() {
    // A stop: soft to 10 mm, ten times as stiff beyond.
    let curve = Spring { elongation: vec![-1.0, 0.0, 0.01, 1.01], force: vec![-50.0, 0.0, 0.5, 500.5], ..Spring::default() };
    let mut model = model(curve, 0.2);
    model.run.time_step = Some(5e-4);
    let mut most = 0.0f64;
    let simulation = run(&model, 0.6, |_, u| most = most.max(u));
    // 2 (½ 50 0.01² + 0.5 d + ½ 500 d²) = ½ 2 0.2², d beyond 10 mm.
    let (energy, at_corner): (f64, f64) = (0.02, 25.0 * 1e-4);
    let d = (-0.5 + (0.25 + 1000.0 * (energy - at_corner)).sqrt()) / 500.0;
    println!("{most} for {}", 0.01 + d);
    assert!((most / (0.01 + d) - 1.0).abs() < 1e-2 && simulation.ledger().drift() < 1e-2);
}

#[test]
fn stiff_springs_shorten_the_step_and_the_run_stays_stable() {
    let mut model = model(Spring { stiffness: 1e6, damping: 1.0, ..Spring::default() }, 0.1);
    model.parts[1].rigid = None;
    let governor = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap().overview().governor;
    assert!(governor.contains("springs"), "{governor}");
    let simulation = run(&model, 0.05, |_, _| ());
    assert!(simulation.ledger().drift() < 0.02, "{}", simulation.ledger().drift());
}
