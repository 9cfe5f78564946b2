//! Friction, contact damping and multipliers through the public face: momentum, energy, work that is lost,
//! and where it shows up.

use crate::bodies::*;
use embate_solver::contact::node_segment::ends;
use embate_solver::contact::projection::node_segment::Target;
use embate_solver::contact::springs::tangent;
use embate_solver::mesh::cell::CellKind;
use embate_solver::mesh::surface::Surface;
use embate_solver::model::{ContactLaw, Formulation, Friction, Interface, Model, Obstacle, Penalty};

const ROUGH: Friction = Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };

/// A block that comes down on another one obliquely; nothing else acts.
fn oblique(interface: Interface) -> Model {
    let mut model = model(1.5e-3);
    add(&mut model, "block", rectangle([0.02, 0.0], [0.08, 0.05], [8, 5]), [6.0, -4.0]);
    add(&mut model, "floor", rectangle([0.0, -0.051], [0.3, 0.05], [21, 3]), [0.0, 0.0]);
    touch(&mut model, "block", "floor");
    model.contacts[0].interface = interface;
    model
}

fn history_end(simulation: &embate_solver::simulation::Simulation, column: &str) -> f64 {
    let index = simulation.history_columns().iter().position(|it| it == column).unwrap();
    simulation.history_row()[index]
}

#[test]
fn the_slip_rate_does_not_see_rotation_of_both_surfaces_together() {
    // A node above and below a segment, beyond its end too; every point moves as in a rigid rotation about
    // some centre.
    let cell: [u32; 3] = [1, 2, 3];
    let surface = Surface::<2>::outside([CellKind::Triangle.cell(&cell)]).unwrap();
    let target = Target { surface, mirrors: vec![] };
    for x in [[0.3, 0.2], [0.7, -0.01], [1.4, 0.5], [-0.2, 0.1]] {
        let positions = [x, [0.0, 0.0], [1.0, 0.1], [0.4, 0.9]];
        for segment in 0..3 {
            let Some(projection) = target.project(x, segment, &positions) else { continue };
            let velocity = |node: u32| {
                let x = positions[node as usize];
                [-3.0 * (x[1] - 2.0) + 0.5, 3.0 * (x[0] + 1.0) - 0.7]
            };
            let t = tangent(projection.normal);
            let rate: f64 = ends(0, &projection, &target, &positions)
                .iter()
                .map(|end| {
                    let v = velocity(end.at);
                    (0..2).map(|d| (end.share * t[d] + end.turn[0][d]) * v[d]).sum::<f64>()
                })
                .sum();
            assert!(rate.abs() < 1e-13, "{x:?} on {segment}: {rate}");
        }
    }
}

#[test]
fn friction_keeps_both_momenta_and_what_it_takes_is_in_the_ledger() {
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 0 }, Formulation::SinglePass { slave: 1 }] {
        for law in [ContactLaw::default(), ContactLaw::Penalty(Penalty::automatic(20.0))] {
            let mut model = oblique(Interface { law: law.clone(), friction: Some(ROUGH), ..Interface::default() });
            model.contacts[0].formulation = formulation;
            let mut simulation = simulation(&model);
            simulation.advance(f64::INFINITY, u64::MAX).unwrap();
            let summary = simulation.summary();
            assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
            assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{formulation:?} {law:?}: {}", summary.energy_drift);
            let stores = simulation.ledger().stores;
            assert!(stores.friction > 0.02 * stores.total(), "{formulation:?} {law:?}: friction {}", stores.friction);
            assert!(stores.contact_damping == 0.0 && stores.contact.abs() < 1e-3 * stores.total());
            // The floor is dragged along, the block is held back: the impulses' ratio is at most µ, but for
            // the tilt of the dented floor.
            let (vx, vy) = (history_end(&simulation, "floor.vx"), history_end(&simulation, "floor.vy"));
            assert!(vx > 0.0 && vx <= 0.302 * -vy, "{formulation:?} {law:?}: {vx} {vy}");
            assert!(vx > 0.25 * -vy, "{formulation:?} {law:?}: it slides nearly all the time, {vx} {vy}");
        }
    }
}

#[test]
fn friction_heat_on_the_surfaces_is_what_friction_took() {
    let model = oblique(Interface { friction: Some(ROUGH), ..Interface::default() });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let frame = simulation.frame();
    let heat = &frame.fields.iter().find(|field| field.kind.name == "friction_heat").unwrap().values;
    // Initial lengths of surface: both outsides.
    let length = |node: usize| {
        let (x, y) = (model_start(&model)[node][0], model_start(&model)[node][1]);
        let body: ([f64; 2], [f64; 2], [usize; 2]) =
            if y > -0.0005 { ([0.02, 0.0], [0.08, 0.05], [8, 5]) } else { ([0.0, -0.051], [0.3, 0.05], [21, 3]) };
        let (corner, size, elements) = body;
        let end = |d: usize, at: f64| (at - corner[d]).abs() < 1e-9 || (at - corner[d] - size[d]).abs() < 1e-9;
        let h = [size[0] / elements[0] as f64, size[1] / elements[1] as f64];
        match (end(0, x), end(1, y)) {
            (true, true) => 0.5 * (h[0] + h[1]),
            (true, false) => h[1],
            (false, true) => h[0],
            (false, false) => 0.0,
        }
    };
    let sum: f64 = heat.iter().enumerate().map(|(node, heat)| heat * length(node)).sum();
    let lost = simulation.ledger().stores.friction;
    assert!((sum / lost - 1.0).abs() < 1e-3, "{sum} {lost}");
}

fn model_start(model: &Model) -> Vec<[f64; 2]> {
    simulation(model).frame().positions::<2>().to_vec()
}

#[test]
fn damping_takes_energy_and_keeps_both_momenta() {
    for fraction in [0.05, 0.5, 5.0] {
        let mut simulation = simulation(&oblique(Interface { damping: fraction, ..Interface::default() }));
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let (summary, stores) = (simulation.summary(), simulation.ledger().stores);
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
        assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{fraction}: {}", summary.energy_drift);
        assert!(stores.contact_damping > 0.0, "{fraction}: {}", stores.contact_damping);
    }
}

#[test]
fn a_multiplier_holds_the_gap_at_round_off_and_loses_only_in_impacts() {
    let mut losses = vec![];
    for refine in [1, 4] {
        let mut model = model(3e-4);
        // No lateral strain: ends that bulge are curved, and there the gap is zero to second order of the
        // step only.
        for material in model.materials.values_mut() {
            material.parameters.insert("poisson".into(), 0.0);
        }
        add(&mut model, "left", rectangle([-0.1, 0.0], [0.1, 0.02], [25 * refine, 2]), [5.0, 0.0]);
        add(&mut model, "right", rectangle([1e-4, 0.0], [0.1, 0.02], [25 * refine, 2]), [-5.0, 0.0]);
        touch(&mut model, "left", "right");
        model.contacts[0].interface.law = ContactLaw::Multiplier;
        model.contacts[0].formulation = Formulation::SinglePass { slave: 0 };
        let mut simulation = simulation(&model);
        let mut deepest: f64 = 0.0;
        let mut lost: f64 = 0.0;
        while simulation.time() < 3e-4 {
            simulation.advance(f64::INFINITY, 1).unwrap();
            deepest = deepest.max(history_end(&simulation, "contact.penetration[left-right]"));
            let now = simulation.ledger().stores.contact_damping;
            assert!(now >= lost - 1e-12, "it gives energy back: {lost} {now} in step {} {deepest}", simulation.steps());
            lost = lost.max(now);
        }
        let (summary, stores) = (simulation.summary(), simulation.ledger().stores);
        assert!(deepest < 1e-15, "{deepest}");
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
        assert!(summary.energy_drift < 0.01, "{}", summary.energy_drift);
        losses.push(stores.contact_damping / stores.total());
        // The bars part with exchanged velocities.
        assert!((history_end(&simulation, "left.vx") + 5.0).abs() < 0.15, "{}", history_end(&simulation, "left.vx"));
    }
    assert!(losses[0] < 0.05 && losses[1] < 0.4 * losses[0], "the loss vanishes with the size of the elements: {losses:?}");
}

#[test]
fn a_layer_by_a_table_gives_back_what_it_took() {
    let law = ContactLaw::PressureGap { gaps: vec![-2e-3, -1e-3, 5e-4], pressures: vec![2e8, 2e7, 0.0] };
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }] {
        let mut model = oblique(Interface { law: law.clone(), ..Interface::default() });
        model.contacts[0].formulation = formulation;
        let mut simulation = simulation(&model);
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let summary = simulation.summary();
        assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-11, "{formulation:?}: {}", summary.energy_drift);
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
        assert!(history_end(&simulation, "block.vy") > 0.0);
    }
}

#[test]
fn a_block_on_a_rough_floor_stops_after_the_way_that_its_energy_lasts() {
    // One soft block, slow enough for its vibrations not to matter: v²/2µg of way and v/µg of time.
    let mut model = model(0.2);
    let (speed, friction, gravity) = (0.5, 0.4, 9.81);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.02], [5, 1]), [speed, 0.0]);
    model.loads.push(embate_solver::model::Load::Gravity { parts: vec![], acceleration: [0.0, -gravity, 0.0], curve: None });
    let floor = Obstacle::wall("floor", [0.0; 2], [0.0, 1.0]);
    let rough = Friction { coefficient: friction, ..ROUGH };
    model.obstacles.push(Obstacle { interface: Interface { friction: Some(rough), damping: 0.2, ..Interface::default() }, ..floor });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let way = history_end(&simulation, "block.x") - 0.05;
    assert!((way / (speed * speed / (2.0 * friction * gravity)) - 1.0).abs() < 0.01, "{way}");
    assert!(history_end(&simulation, "block.vx").abs() < 1e-3, "{}", history_end(&simulation, "block.vx"));
    let stores = simulation.ledger().stores;
    let start = 0.5 * 1000.0 * 0.1 * 0.02 * speed * speed;
    assert!((stores.friction / start - 1.0).abs() < 0.02, "{} of {start}", stores.friction);
}
