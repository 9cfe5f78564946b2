//! Shocks in gases and metals against Rankine and Hugoniot; bulk viscosity: no ringing, its work in the
//! ledger, its stable step.

use crate::bodies::{add, faults, model, rectangle};
use embate_solver::bench;
use embate_solver::element::{ELEMENTS, ELEMENTS_OF_SPACE};
use embate_solver::material::points;
use embate_solver::mesh::cell::CellKind;
use embate_solver::model::{Constraint, Cuboid, Material, Model, Obstacle, ObstacleShape, Shape};
use embate_solver::simulation::{Options, Simulation};
use embate_solver::stress_state::STRESS_STATES;

fn fluid(eos: &str, values: &[(&str, f64)]) -> Material {
    let parameters = values.iter().map(|&(name, value)| (name.to_string(), value)).collect();
    Material { law: "null".into(), eos: eos.into(), parameters, ..Material::default() }
}

fn gas() -> Material {
    fluid("ideal_gas", &[("density", 1.0), ("gamma", 1.4), ("pressure_initial", 1.0)])
}

/// A tube between slip walls, its left end driven at `speed`.
fn piston(material: Material, size: [f64; 2], elements: usize, speed: f64, end: f64) -> Model {
    let mut model = model(end);
    model.materials.insert("soft".into(), material);
    model.run.bulk_viscosity = [0.06, 1.2];
    // A wall faster than sound would go through the first element in its first step.
    model.run.time_step = Some(0.1 * size[0] / elements as f64 / speed);
    add(&mut model, "tube", rectangle([0.0; 2], size, [elements, 1]), [0.0; 2]);
    for (side, velocity) in [
        ("tube.left", [Some(speed), None]),
        ("tube.right", [Some(0.0), None]),
        ("tube.bottom", [None, Some(0.0)]),
        ("tube.top", [None, Some(0.0)]),
    ] {
        let velocity = velocity.map(|velocity| velocity.map(Into::into));
        model.constraints.push(Constraint { on: side.into(), velocity: embate_solver::model::in_3d(velocity), ..Constraint::default() });
    }
    model
}

/// Runs it in many parts; every number of the ledger is asked on the way.
fn run(model: &Model) -> Simulation {
    let mut simulation = Simulation::new(model, &Options { threads: 1, simd: None }).unwrap();
    let mut viscous = 0.0;
    for part in 1..=50 {
        simulation.advance(model.run.end * f64::from(part) / 50.0, u64::MAX).unwrap();
        let stores = simulation.ledger().stores;
        assert!(stores.bulk_viscosity >= viscous, "{} after {viscous}", stores.bulk_viscosity);
        viscous = stores.bulk_viscosity;
    }
    simulation
}

fn field(simulation: &Simulation, name: &str) -> Vec<f64> {
    simulation.frame().fields.into_iter().find(|field| field.kind.name == name).unwrap().values
}

#[test]
fn a_piston_drives_a_shock_into_a_gas_without_ringing() {
    // W = u(γ+1)/4 + √((u(γ+1)/4)² + c²), p = p₀ + ρ₀ W u, ρ = ρ₀ W/(W − u)
    let speed = 2.0;
    let shock: f64 = 1.2 + (1.2f64 * 1.2 + 1.4).sqrt();
    let (pressure, density) = (1.0 + shock * speed, shock / (shock - speed));
    let model = piston(gas(), [1.0, 0.005], 200, speed, 0.25);
    let simulation = run(&model);
    let (found, dense) = (field(&simulation, "pressure"), field(&simulation, "density"));
    // The front is at 0.72 of the tube; next to the piston the gas is too hot ("wall heating"), at the right
    // pressure.
    let behind = &found[4..125];
    let mean = behind.iter().sum::<f64>() / behind.len() as f64;
    let largest = behind.iter().fold(0.0f64, |most, p| most.max((p / pressure - 1.0).abs()));
    let density_mean = dense[20..125].iter().sum::<f64>() / 105.0;
    let front = found.iter().position(|&p| p < 0.5 * (1.0 + pressure)).unwrap() as f64 / 200.0;
    let (residual, drift) = (simulation.ledger().residual(), simulation.ledger().drift());
    println!("pressure {mean} of {pressure}, off by {largest}; density {density_mean} of {density}; front {front}; {residual} {drift}");
    assert!((mean / pressure - 1.0).abs() < 2e-3 && largest < 0.02, "{mean} {largest} of {pressure}");
    assert!((density_mean / density - 1.0).abs() < 5e-3, "{density_mean} of {density}");
    assert!((front - 0.25 * shock).abs() < 0.01, "{front}");
    assert!(residual < 1e-12 && drift < 5e-3, "{residual} {drift}");
    assert!(simulation.ledger().stores.bulk_viscosity > 1e-3);
}

#[test]
fn without_viscosity_the_same_shock_rings() {
    let mut model = piston(gas(), [1.0, 0.005], 200, 2.0, 0.1);
    model.run.bulk_viscosity = [0.0; 2];
    model.run.energy_limit = 0.9;
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    let _ = simulation.advance(0.1, u64::MAX);
    let largest = field(&simulation, "pressure").into_iter().fold(0.0f64, f64::max);
    assert!(largest > 1.15 * 6.77, "{largest}");
    assert_eq!(simulation.ledger().stores.bulk_viscosity, 0.0);
}

#[test]
fn tall_elements_have_a_stable_step_under_viscosity() {
    // The length in the viscosity is √area, three times the thickness: so much more damping does the fastest
    // mode feel.
    let mut model = piston(gas(), [1.0, 0.05], 200, 2.0, 0.2);
    // The wall starts with a jerk.
    model.run.energy_limit = 0.5;
    let simulation = run(&model);
    let found = field(&simulation, "pressure");
    let largest = found.iter().copied().fold(0.0f64, f64::max);
    println!("{largest} {}", simulation.ledger().drift());
    assert!(largest < 1.02 * 6.7705 && found[30..80].iter().all(|p| (p / 6.7705 - 1.0).abs() < 0.01), "{largest}");
}

#[test]
fn a_body_of_one_element_that_is_thrown_on_its_held_side_keeps_its_energy_under_viscosity() {
    let elements = ELEMENTS.iter().map(|kind| (kind, STRESS_STATES.len())).chain(ELEMENTS_OF_SPACE.iter().map(|kind| (kind, 1)));
    for (element, states) in elements.filter(|(kind, _)| matches!(kind.cell, CellKind::Quadrilateral | CellKind::Hexahedron)) {
        for state in STRESS_STATES.iter().take(states).map(|state| if states > 1 { state.name } else { "" }) {
            for mach in [1e-6, 1e-3, 0.03] {
                let material = bench::material("elastic");
                let [bulk, shear] = points::plane(&material).unwrap().stiffness();
                let sound = ((bulk + 4.0 / 3.0 * shear) / material.parameters["density"]).sqrt();
                let mut model = model(5.0 / sound);
                model.run.bulk_viscosity = [0.06, 1.2];
                model.materials.insert("soft".into(), material);
                let is_flat = element.dimension == 2;
                let solid = Shape::Cuboid(Cuboid { size: [0.1; 3], elements: [1; 3], ..Cuboid::default() });
                let shape = if is_flat { rectangle([0.0; 2], [0.1, 0.1], [1, 1]) } else { solid };
                add(&mut model, "block", shape, [0.0; 2]);
                let part = &mut model.parts[0];
                (part.element, part.stress_state, part.velocity) =
                    (element.name.into(), if is_flat { state.into() } else { String::from("plane_strain") }, [0.0, -mach * sound, 0.0]);
                model.constraints.push(Constraint {
                    on: "block.bottom".into(),
                    velocity: [None, Some(0.0.into()), None],
                    ..Constraint::default()
                });
                let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
                let end = simulation.advance(f64::INFINITY, u64::MAX);
                let ledger = simulation.ledger();
                let taken = ledger.stores.bulk_viscosity / ledger.largest;
                println!("{} {state} {mach}: drift {:.1e}, {taken:.3} taken, {} steps", element.name, ledger.drift(), simulation.steps());
                assert!(
                    end.is_ok() && ledger.drift() < 0.01 && taken > 0.1,
                    "{} {state} {mach}: {end:?} {} {taken}",
                    element.name,
                    ledger.drift()
                );
            }
        }
    }
}

#[test]
fn what_the_viscosity_books_is_what_it_takes_in_every_stress_state() {
    for state in STRESS_STATES {
        for law in ["elastic", "neo_hookean", "crushable_foam"] {
            let material = bench::material(law);
            let [bulk, shear] = points::plane(&material).unwrap().stiffness();
            let sound = ((bulk + 4.0 / 3.0 * shear) / material.parameters["density"]).sqrt();
            // Thrown on the floor, its waves go through it some forty times.
            let mut model = model(4.0 / sound);
            model.run.safety = 0.3;
            model.run.bulk_viscosity = [0.06, 1.2];
            model.materials.insert("soft".into(), material);
            add(&mut model, "block", rectangle([0.01, 0.0], [0.1, 0.1], [8, 8]), [0.0, -0.05 * sound]);
            model.parts[0].stress_state = state.name.into();
            let floor = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 1.0, 0.0], length: None };
            model.obstacles.push(Obstacle::fixed("floor", floor));
            let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
            simulation.advance(f64::INFINITY, u64::MAX).unwrap();
            let (ledger, taken) = (simulation.ledger(), simulation.ledger().stores.bulk_viscosity / simulation.ledger().largest);
            println!("{} {law}: {taken:.3} of the energy taken, drift {:.1e}", state.name, ledger.drift());
            assert!(taken > 0.05 && ledger.drift() < 1e-3, "{} {law}: {taken} {}", state.name, ledger.drift());
        }
    }
}

#[test]
fn a_shock_in_copper_has_the_speed_and_pressure_of_the_hugoniot() {
    let copper = fluid("mie_gruneisen", &[("density", 8930.0), ("c0", 3940.0), ("s1", 1.489), ("gamma0", 2.02)]);
    let (speed, length) = (500.0, 0.1);
    let shock = 3940.0 + 1.489 * speed;
    let simulation = run(&piston(copper, [length, 0.0005], 200, speed, 0.7 * length / shock));
    let (pressure, density) = (8930.0 * shock * speed, 8930.0 * shock / (shock - speed));
    let (found, dense) = (field(&simulation, "pressure"), field(&simulation, "density"));
    let mean = |values: &[f64]| values[20..120].iter().sum::<f64>() / 100.0;
    let front = found.iter().position(|&p| p < 0.5 * pressure).unwrap() as f64 / 200.0;
    println!("{} {} {front} {}", mean(&found) / pressure, mean(&dense) / density, simulation.ledger().drift());
    assert!((mean(&found) / pressure - 1.0).abs() < 5e-3 && (mean(&dense) / density - 1.0).abs() < 5e-3);
    assert!((front - 0.7).abs() < 0.01 && simulation.ledger().drift() < 5e-3);
}

#[test]
fn the_viscosity_of_a_fluid_takes_the_power_of_its_shear() {
    // Couette: the upper wall moves; after the start the shear is v/h, and what the walls give is µ (v/h)²
    // per volume.
    let (viscosity, speed, end) = (0.05, 0.1, 14.0);
    let water = fluid("linear", &[("density", 1.0), ("bulk_modulus", 10.0), ("viscosity", viscosity)]);
    let mut model = model(end);
    // The walls start with a jerk.
    model.run.energy_limit = 0.5;
    model.materials.insert("soft".into(), water);
    add(&mut model, "water", rectangle([0.0; 2], [1.0, 1.0], [8, 8]), [0.0; 2]);
    for (side, velocity) in [("water.bottom", [Some(0.0), Some(0.0)]), ("water.top", [Some(speed), Some(0.0)])] {
        let velocity = velocity.map(|velocity| velocity.map(Into::into));
        model.constraints.push(Constraint { on: side.into(), velocity: embate_solver::model::in_3d(velocity), ..Constraint::default() });
    }
    for side in ["water.left", "water.right"] {
        model.constraints.push(Constraint { on: side.into(), velocity: [None, Some(0.0.into()), None], ..Constraint::default() });
    }
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    simulation.advance(12.0, u64::MAX).unwrap();
    let before = simulation.ledger().stores.plastic;
    simulation.advance(end, u64::MAX).unwrap();
    let power = (simulation.ledger().stores.plastic - before) / (end - 12.0);
    println!("{power} {} {}", simulation.ledger().drift(), simulation.ledger().residual());
    assert!((power / (viscosity * speed * speed) - 1.0).abs() < 0.02, "{power}");
    assert!(simulation.ledger().residual() < 1e-12);
}

#[test]
fn what_does_not_go_together_is_reported() {
    let reported = |change: &dyn Fn(&mut Material), expected: &str| {
        let mut model = piston(gas(), [1.0, 0.1], 10, 1.0, 1e-3);
        change(model.materials.get_mut("soft").unwrap());
        let faults = faults(&model).join("\n");
        assert!(faults.contains(expected), "{expected}: {faults}");
    };
    reported(&|it| it.eos.clear(), "has no pressure of its own");
    reported(&|it| it.law = "neo_hookean".into(), "an equation of state would contradict it");
    reported(&|it| it.law = "drucker_prager".into(), "an equation of state would contradict it");
    reported(&|it| it.eos = "ideal_gass".into(), "did you mean `ideal_gas`?");
    reported(&|it| it.parameters.retain(|name, _| name != "gamma"), "equation of state `ideal_gas` needs `gamma`");
    reported(&|it| it.parameters.extend([("gama".into(), 1.0)]), "did you mean `gamma`?");
    reported(&|it| it.parameters.extend([("gamma".into(), 1.0)]), "`gamma` must be");
    reported(&|it| it.parameters.extend([("pressure_initial".into(), 0.0)]), "no stiffness");
    let mut plain = piston(gas(), [1.0, 0.1], 10, 1.0, 1e-3);
    let elastic = crate::bodies::elastic(1e9, 1e3);
    plain.materials.insert("soft".into(), elastic);
    plain.materials.get_mut("soft").unwrap().parameters.insert("gamma".into(), 1.4);
    assert!(faults(&plain).join("\n").contains("add `eos = \"ideal_gas\"`"));
}

#[test]
fn water_that_is_pulled_off_a_wall_pulls_back_with_its_limit_and_no_more() {
    // Without a limit the wall would feel ρ c v = 15 bar; with one the rest of the water is held back by 1
    // bar, until the wave has run through.
    let (speed_of_sound, length, limit, wall) = (f64::sqrt(2.2e9 / 1e3), 1.0, 1e5, 1.0);
    let water = fluid("linear", &[("density", 1e3), ("bulk_modulus", 2.2e9), ("tension", limit)]);
    let end = 0.9 * length / speed_of_sound;
    let mut model = piston(water, [length, 0.02], 200, wall, end);
    model.run.bulk_viscosity = [0.0; 2];
    model.constraints[0].velocity[0] = Some((-wall).into());
    let simulation = run(&model);
    let momentum = 1e3 * length * crate::bodies::value(&simulation, "tube.vx");
    // The wall's own nodes have half an element.
    let expected = -limit * end - 1e3 * 0.5 * length / 200.0 * wall;
    assert!((momentum / expected - 1.0).abs() < 0.01, "{momentum} for {expected}");
    let least = field(&simulation, "pressure").into_iter().fold(0.0, f64::min);
    assert!((least + limit).abs() < 1e-6 * limit, "{least}");
    // What the wall spends is all there.
    let work = limit * wall * end * 0.02;
    let summary = simulation.summary();
    assert!((simulation.ledger().external / work - 1.0).abs() < 0.05 && summary.energy_drift < 0.01, "{summary:?} {work}");
    let mut wrong = model.clone();
    wrong.materials.get_mut("soft").unwrap().parameters.insert("tension".into(), -1.0);
    assert!(faults(&wrong)[0].contains("tension"), "{:?}", faults(&wrong));
    let solid = wrong.materials.get_mut("soft").unwrap();
    (solid.law, solid.eos) = ("elastic".into(), String::new());
    solid.parameters =
        [("density", 1.0), ("young", 1.0), ("poisson", 0.3), ("tension", 1.0)].map(|(name, value)| (name.to_string(), value)).into();
    assert!(faults(&wrong)[0].contains("add `eos`"), "{:?}", faults(&wrong));
}
