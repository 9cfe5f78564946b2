//! Contact in 3D at the rims of faces: bodies that end flush, whose nodes leave the faces of the other by
//! round-off or by what they spread.

use crate::bodies::{every_step, to_end, value};
use crate::patches::{DENSITY, YOUNG, material};
use embate_solver::model::{Constraint, Contact, Cuboid, Load, Model, Part, Partners, Penalty, Probe, ProbeAt, Run, Shape};

/// A brick of the material `m`.
fn brick(name: &str, corner: [f64; 3], size: [f64; 3], elements: [usize; 3]) -> Part {
    let shape = Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() });
    Part { name: name.into(), material: "m".into(), element: "hex8".into(), shape, ..Part::default() }
}

/// Two bricks whose sides meet, or all of them.
fn pair(parts: [Part; 2], sides: Option<[&str; 2]>, poisson: f64, end: f64) -> Model {
    let partners = sides.map_or(Partners::Bodies(Vec::new()), |sides| Partners::Between(sides.map(str::to_string)));
    Model {
        name: "flush".into(),
        run: Run { end, ..Run::default() },
        materials: [("m".to_string(), material("elastic", poisson))].into(),
        probes: parts
            .iter()
            .map(|part| Probe { name: part.name.clone(), at: ProbeAt::Set { set: part.name.clone() }, ..Probe::default() })
            .collect(),
        parts: parts.into(),
        contacts: vec![Contact { name: "joint".into(), partners, ..Contact::default() }],
        ..Model::default()
    }
}

#[test]
fn blocks_of_unlike_meshes_that_end_flush_bear_each_other_to_their_rims() {
    let pressure = 5.0;
    for (poisson, sides) in [(0.0, Some(["upper.back", "lower.front"])), (0.3, Some(["upper.back", "lower.front"])), (0.3, None)] {
        let lower = brick("lower", [0.0; 3], [1.0, 1.0, 0.5], [3, 4, 2]);
        let upper = brick("upper", [0.0, 0.0, 0.5], [1.0, 1.0, 0.5], [4, 5, 2]);
        let mut model = pair([lower, upper], sides, poisson, 1.5);
        model.loads.push(Load::Pressure { on: "upper.front".into(), pressure, curve: None });
        model.loads.push(Load::Damping { parts: Vec::new(), rate: 15.0, active: [0.0, f64::INFINITY] });
        model.constraints.push(Constraint { on: "lower.back".into(), velocity: [None, None, Some(0.0.into())], ..Constraint::default() });
        model.probes.push(Probe { name: "top".into(), at: ProbeAt::Set { set: "upper.front".into() }, ..Probe::default() });
        let simulation = to_end(&model);
        let sunk = 1.0 - value(&simulation, "top.z");
        let (internal, lost) = (value(&simulation, "energy.internal"), value(&simulation, "energy.contact_damping"));
        println!("ν = {poisson}, {sides:?}: sunk by {sunk}, internal {internal}, lost {lost}");
        // σ L/E, and the springs between, of the wave modulus over the height of an element.
        let modulus = YOUNG * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        let expected = pressure / YOUNG + pressure * 0.25 / modulus;
        assert!((sunk / expected - 1.0).abs() < 0.03, "{poisson} {sides:?}: {sunk} of {expected}");
        assert!(lost.abs() < 1e-3 * internal, "{poisson} {sides:?}: {lost} of {internal}");
        if sides.is_some() {
            let force = value(&simulation, "contact.force_z[joint]");
            assert!((force / pressure - 1.0).abs() < 5e-3, "{poisson}: {force}");
        }
    }
}

#[test]
fn a_stiffness_given_for_each_node_is_that_of_its_spring() {
    let (pressure, stiffness) = (5.0, 500.0);
    let blocks = [brick("lower", [0.0; 3], [1.0, 1.0, 0.5], [1, 1, 2]), brick("upper", [0.0, 0.0, 0.5], [1.0, 1.0, 0.5], [1, 1, 2])];
    let mut model = pair(blocks, Some(["upper.back", "lower.front"]), 0.0, 1.5);
    model.contacts[0].interface = Penalty::PerNode(stiffness).into();
    model.loads.push(Load::Pressure { on: "upper.front".into(), pressure, curve: None });
    model.loads.push(Load::Damping { parts: Vec::new(), rate: 15.0, active: [0.0, f64::INFINITY] });
    model.constraints.push(Constraint { on: "lower.back".into(), velocity: [None, None, Some(0.0.into())], ..Constraint::default() });
    model.probes.push(Probe { name: "top".into(), at: ProbeAt::Set { set: "upper.front".into() }, ..Probe::default() });
    let sunk = 1.0 - value(&to_end(&model), "top.z");
    // Four springs of either side.
    let expected = pressure / YOUNG + pressure / (8.0 * stiffness);
    assert!((sunk / expected - 1.0).abs() < 1e-2, "{sunk} of {expected}");
}

#[test]
fn rods_that_hit_each_other_end_on_and_flush_exchange_their_velocities() {
    let speed = 0.01;
    let (length, wave) = (4.0, (YOUNG / DENSITY).sqrt());
    for (across, sides) in [(2, Some(["hits.right", "hit.left"])), (3, Some(["hits.right", "hit.left"])), (3, None)] {
        let hits = Part { velocity: [speed, 0.0, 0.0], ..brick("hits", [-length, -0.2, -0.2], [length, 0.4, 0.4], [20, 2, 2]) };
        let hit = brick("hit", [0.0, -0.2, -0.2], [length, 0.4, 0.4], [20, across, across]);
        let model = pair([hits, hit], sides, 0.3, 2.6 * length / wave);
        let simulation = to_end(&model);
        let summary = simulation.summary();
        let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
        let [first, second] = ["hits.vx", "hit.vx"].map(|name| value(&simulation, name) / speed);
        println!(
            "{across} {sides:?}: momenta {linear:.1e} {angular:.1e}, velocities {first} {second}, energy {:.1e}",
            summary.energy_drift
        );
        assert!(linear < 1e-12 && angular < 1e-12, "{across} {sides:?}: {linear} {angular}");
        assert!(first.abs() < 0.05 && (second - 1.0).abs() < 0.05, "{across} {sides:?}: {first} {second}");
        assert!(summary.energy_drift < 1e-3, "{across} {sides:?}: {}", summary.energy_drift);
        // No node goes deep, as one would that slips off.
        let depth = every_step(&model).column("contact.penetration[joint]").into_iter().fold(0.0, f64::max);
        assert!(depth < 0.01 * 0.2, "{across} {sides:?}: {depth}");
    }
}

#[test]
fn a_block_that_slides_down_beside_another_does_not_catch_on_its_rim() {
    // A gap of a hundredth of an edge is within the band in which a face would hold what presses on it.
    let still = brick("still", [0.0; 3], [1.0; 3], [4, 4, 4]);
    let falls = Part { velocity: [0.0, 0.0, -1.0], ..brick("falls", [1.0025, 0.0, 0.9], [1.0; 3], [4, 4, 4]) };
    for sides in [None, Some(["falls.back", "still.front"]), Some(["falls", "still"])] {
        let model = pair([still.clone(), falls.clone()], sides, 0.3, 0.6);
        let simulation = to_end(&model);
        let speed = value(&simulation, "falls.vz");
        assert!((speed + 1.0).abs() < 1e-12 && value(&simulation, "still.vz") == 0.0, "{sides:?}: {speed}");
    }
}
