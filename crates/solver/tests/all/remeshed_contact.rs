//! Contact of bodies whose elements are made again while they press on each other: forces, friction, sides,
//! momenta, and the count of entries and exits continue.

use crate::bodies::*;
use crate::remeshing::{every, metal};
use embate_solver::model::{
    Cadence, Constraint, Contact, Curve, CurveShape, Disk, Drive, Formulation, Interface, Load, Material, Model, Motion, Obstacle,
    ObstacleShape, Partners, Remesh, Shape,
};
use embate_solver::output::Summary;
use embate_solver::simulation::{Options, Simulation};

/// Holds a side in both directions.
fn hold(model: &mut Model, on: &str) {
    let fixed = Some(Drive::Constant(0.0));
    model.constraints.push(Constraint { on: on.into(), velocity: [fixed.clone(), fixed, None], ..Constraint::default() });
}

/// A curve `ramp` to 1 at this time, and a damping.
fn settle(model: &mut Model, until: f64, rate: f64) {
    let shape = CurveShape::Table { times: vec![0.0, until], values: vec![0.0, 1.0], smooth: true };
    model.curves.insert("ramp".into(), Curve::from(shape));
    model.loads.push(Load::Damping { parts: vec![], rate, active: [0.0, f64::INFINITY] });
}

fn pull(model: &mut Model, part: &str, acceleration: [f64; 2]) {
    let acceleration = in_3d(acceleration);
    model.loads.push(Load::Gravity { parts: vec![part.into()], acceleration, curve: Some("ramp".into()) });
}

fn all_bodies(interface: Interface) -> Contact {
    Contact { name: "all".into(), partners: Partners::Bodies(vec![]), interface, ..Contact::default() }
}

/// What holds for any of them; momentum where nothing is held.
fn sound(summary: &Summary, events: usize, is_free: bool) {
    assert!(summary.remeshings.len() >= events, "{} events", summary.remeshings.len());
    assert_eq!(summary.contact.unverified, 0);
    assert!(summary.ledger_residual < 1e-12, "{}", summary.ledger_residual);
    for event in &summary.remeshings {
        assert!((!is_free || event.momentum_change[0] < 1e-12) && event.volume_change.abs() < 1e-12, "{event:?}");
    }
}

/// Largest change of a column in the rows from a time on, over its value there.
fn change(history: &History, column: &str, from: f64) -> f64 {
    let (times, values) = (history.column("time"), history.column(column));
    let first = times.iter().position(|&time| time >= from).unwrap();
    let at = values[first];
    values[first..].iter().map(|value| (value / at - 1.0).abs()).fold(0.0, f64::max)
}

/// A block that weighs on another one, and is held on it by friction.
fn on_a_slope(formulation: Formulation) -> Model {
    let mut model = model(20e-3);
    add(&mut model, "ground", rectangle([0.0, 0.0], [0.2, 0.04], [20, 4]), [0.0; 2]);
    add(&mut model, "block", rectangle([0.063, 0.04], [0.08, 0.04], [11, 5]), [0.0; 2]);
    hold(&mut model, "ground.bottom");
    settle(&mut model, 3e-3, 2000.0);
    pull(&mut model, "block", [3000.0, -10000.0]);
    let between = Contact::between("c", "block.bottom", "ground.top");
    model.contacts.push(Contact { formulation, interface: rough(0.5), ..between });
    model.remeshes.push(Remesh { begin: 13e-3, ..every("block", 1.5e-3) });
    model.remeshes.push(Remesh { begin: 13.7e-3, ..every("ground", 1.5e-3) });
    model.output.history = Cadence::Interval(20e-6);
    model
}

#[test]
fn what_sticks_on_a_slope_goes_on_sticking() {
    for formulation in [Formulation::DoublePass, Formulation::SinglePass { slave: 0 }, Formulation::SinglePass { slave: 1 }] {
        let (simulation, history) = run(&on_a_slope(formulation));
        sound(&simulation.summary(), 6, false);
        // The whole weight: 3.2 kg/m.
        let (weight, pull) = (32e3, 9.6e3);
        let [across, along] = ["contact.force_y[c]", "contact.force_x[c]"].map(|column| history.last(column));
        assert!((across.abs() / weight - 1.0).abs() < 2e-3 && (along.abs() / pull - 1.0).abs() < 2e-3, "{formulation:?} {across} {along}");
        for (column, most) in [("contact.force_y[c]", 0.01), ("contact.force_x[c]", 0.02), ("block.y", 1e-6)] {
            let change = change(&history, column, 12.9e-3);
            println!("{formulation:?} {column} {change:.2e}");
            assert!(change < most, "{formulation:?} {column} changes by {change}");
        }
    }
}

#[test]
fn a_disk_that_is_pressed_on_a_block_presses_as_before() {
    let mut model = model(16e-3);
    add(&mut model, "block", rectangle([-0.06, -0.04], [0.12, 0.04], [48, 16]), [0.0; 2]);
    add(&mut model, "disk", Shape::Disk(Disk { centre: [0.0, 0.03005], radius: 0.03, elements: 14 }), [0.0; 2]);
    hold(&mut model, "block.bottom");
    settle(&mut model, 2e-3, 3000.0);
    pull(&mut model, "disk", [0.0, -1e4]);
    model.contacts.push(all_bodies(rough(0.3)));
    model.remeshes.push(Remesh { begin: 1e-3, ..every("disk", 2e-3) });
    model.output.history = Cadence::Interval(20e-6);
    let (simulation, history) = run(&model);
    sound(&simulation.summary(), 5, false);
    let change = change(&history, "contact.force_y[all:block-disk]", 10.5e-3);
    println!("{change:.2e}");
    assert!(change < 0.03, "{change}");
}

/// Two disks that hit each other askew.
fn collision(friction: f64) -> Model {
    let mut model = model(2e-3);
    model.materials.insert("soft".into(), metal(70e9, 2700.0, 100e6, 300e6));
    add(&mut model, "a", Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.05, elements: 8 }), [100.0, 0.0]);
    add(&mut model, "b", Shape::Disk(Disk { centre: [0.11, 0.03], radius: 0.05, elements: 10 }), [-100.0, 0.0]);
    model.contacts.push(all_bodies(rough(friction)));
    model.remeshes.push(Remesh { begin: 20e-6, ..every("a", 60e-6) });
    model.remeshes.push(Remesh { begin: 20e-6, ..every("b", 85e-6) });
    model
}

#[test]
fn disks_that_collide_keep_momenta_and_part_as_they_would() {
    for friction in [0.0, 0.3] {
        let model = collision(friction);
        let without = Model { remeshes: Vec::new(), ..model.clone() };
        let [(simulation, history), (_, before)] = [&model, &without].map(run);
        let summary = simulation.summary();
        sound(&summary, 20, true);
        assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12);
        let largest = history.first("energy.kinetic");
        let remap = history.last("energy.remap") / largest;
        println!("friction {friction}: remap {remap:.2e}, drift {:.2e}", summary.energy_drift);
        assert!(remap.abs() < 0.01 && summary.energy_drift < 2e-3, "{remap} {}", summary.energy_drift);
        for column in ["a.vx", "a.vy", "b.vx", "b.vy"] {
            let (found, expected) = (history.last(column), before.last(column));
            assert!((found - expected).abs() < 2.0, "{column}: {found} and not {expected}");
        }
    }
}

#[test]
fn contacts_are_the_same_on_all_threads_and_after_a_stop() {
    let mut model = collision(0.3);
    model.run.end = 0.3e-3;
    let hash = hash_of_equal_bits(&model, &[2, 3], "collision");
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    for stop in 1..12 {
        simulation.advance(25e-6 * f64::from(stop), u64::MAX).unwrap();
        continues_to(&hash, &model, &mut simulation, "collision");
    }
}

#[test]
fn dies_may_be_polylines_and_rigid_parts() {
    let points = vec![[0.0, 0.03], [0.04, 0.03], [0.04, 0.015], [7e-3, 0.015], [6.2e-3, 0.0156], [6e-3, 0.019], [0.0, 0.019]];
    let motion = driven([Some(0.0), Some(-40.0)], Some(0.0));
    let pressed = |rigid: bool| {
        let mut model = model(1.2e-4);
        model.materials.insert("soft".into(), metal(200e9, 7833.0, 300e6, 300e6));
        add(&mut model, "billet", rectangle([0.0, 0.0], [10e-3, 15e-3], [12, 18]), [0.0; 2]);
        model.parts[0].stress_state = "axisymmetric".into();
        let constraint =
            Constraint { on: "billet.bottom".into(), velocity: [None, Some(Drive::Constant(0.0)), None], ..Constraint::default() };
        model.constraints.push(constraint);
        if rigid {
            add(&mut model, "die", rectangle([0.0, 15e-3], [20e-3, 4e-3], [30, 2]), [0.0; 2]);
            model.parts[1].stress_state = "axisymmetric".into();
            stiffen(
                &mut model,
                "die",
                Motion { velocity: [Some(0.0), Some(-40.0), None].map(|v| v.map(Drive::from)), spin: Some(0.0.into()) },
            );
            model.contacts.push(Contact { interface: rough(0.1), ..Contact::between("c", "billet", "die") });
        } else {
            let die = Obstacle::fixed("die", ObstacleShape::Polyline { points: points.clone() });
            model.obstacles.push(Obstacle { motion: motion.clone(), interface: rough(0.1), ..die });
        }
        model.remeshes.push(Remesh { quality: 0.4, ..every("billet", 3e-5) });
        model
    };
    for rigid in [false, true] {
        let (simulation, history) = run(&pressed(rigid));
        let summary = simulation.summary();
        sound(&summary, 2, false);
        assert!(summary.energy_drift < 0.01 && summary.penetration_max < 3e-4, "{} {}", summary.energy_drift, summary.penetration_max);
        assert!(history.last("energy.remap").abs() < 0.02 * history.last("energy.plastic"), "{}", history.last("energy.remap"));
    }
}

#[test]
fn elements_of_others_may_fail() {
    // A bar of which half of the length fails beside a rod that is meshed again.
    let mut model = crate::remeshing::taylor(200.0, [5, 50], &[Remesh { begin: 2e-6, ..every("rod", 5e-6) }]);
    model.run.end = 4e-5;
    let torn = Material { failure: [("plastic_strain".to_string(), 0.15)].into(), ..metal(117e9, 8930.0, 400e6, 100e6) };
    model.materials.insert("torn".into(), torn);
    add(&mut model, "bar", rectangle([6e-3, 0.0], [3e-3, 15e-3], [4, 20]), [0.0, -250.0]);
    model.parts[1].stress_state = "axisymmetric".into();
    model.parts[1].material = "torn".into();
    model.contacts.push(all_bodies(rough(0.1)));
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    sound(&summary, 5, false);
    let eroded = summary.erosion.clone().unwrap();
    println!("{:?} eroded, {} J, drift {:.2e}", eroded.elements, history.last("energy.eroded"), summary.energy_drift);
    assert!(eroded.elements[0].1 > 5 && summary.energy_drift < 5e-3, "{}", summary.energy_drift);
    let mut column = history.column("energy.eroded");
    column.retain(|value| *value != 0.0);
    assert!(!column.is_empty());
    let hash = hash_of_equal_bits(&model, &[2], "eroded");
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    for stop in [9e-6, 21e-6, 33e-6] {
        simulation.advance(stop, u64::MAX).unwrap();
        continues_to(&hash, &model, &mut simulation, "eroded");
    }
}

/// A block of rubber between plates that stick to it.
fn rubber_block(law: &str, parameters: &[(&str, f64)], stress_state: &str) -> Model {
    let mut model = model(12e-3);
    let parameters = parameters.iter().chain(&[("density", 1e3)]).map(|(key, value)| (key.to_string(), *value)).collect();
    model.materials.insert("soft".into(), Material { law: law.into(), parameters, ..Material::default() });
    add(&mut model, "block", rectangle([0.0, 0.0], [0.02, 0.02], [20, 20]), [0.0; 2]);
    model.parts[0].stress_state = stress_state.into();
    hold(&mut model, "block.bottom");
    // 9 mm of 20, and back.
    let times = [0.0, 1.5, 4.5, 6.0, 7.5, 10.5, 12.0].map(|time| 1e-3 * time).to_vec();
    let shape = CurveShape::Table { times, values: vec![0.0, -2.0, -2.0, 0.0, 2.0, 2.0, 0.0], smooth: true };
    model.curves.insert("press".into(), Curve::from(shape));
    let velocity = [Some(Drive::Constant(0.0)), Some(Drive::Curve("press".into())), None];
    model.constraints.push(Constraint { on: "block.top".into(), name: "top".into(), velocity, ..Constraint::default() });
    // What bulges out folds onto the plates.
    let motion = Motion { velocity: [Some(0.0.into()), Some(Drive::Curve("press".into())), None], spin: Some(0.0.into()) };
    model.obstacles.push(Obstacle::wall("floor", [0.0; 3], [0.0, 1.0, 0.0]));
    model.obstacles.push(Obstacle { motion, ..Obstacle::wall("plate", [0.0, 0.02, 0.0], [0.0, -1.0, 0.0]) });
    model
}

#[test]
fn rubber_that_is_meshed_again_springs_back_as_it_would() {
    let laws: [(&str, &[(&str, f64)]); 2] =
        [("neo_hookean", &[("young", 2.99e6), ("poisson", 0.495)]), ("mooney_rivlin", &[("bulk", 2e7), ("c10", 4e5), ("c01", 1e5)])];
    for (law, parameters) in laws {
        for stress_state in ["plane_strain", "axisymmetric"] {
            let without = rubber_block(law, parameters, stress_state);
            let again = Model { remeshes: vec![Remesh { begin: 1e-3, loss_limit: 1.0, ..every("block", 2e-3) }], ..without.clone() };
            let [(simulation, history), (_, before)] = [&again, &without].map(run);
            let summary = simulation.summary();
            sound(&summary, 4, false);
            let largest = before.largest("energy.internal");
            let (times, energies, expected) = (history.column("time"), history.column("energy.internal"), before.column("energy.internal"));
            let most = energies.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
            let remap = history.last("energy.remap") / largest;
            println!("{law} {stress_state}: {most:.2e} remap {remap:.2e} drift {:.2e} of {}", summary.energy_drift, times.len());
            // At the corners of the plates stresses have no bound: 3 % with half as many elements along a
            // side.
            assert!(most < 0.03 && remap.abs() < 0.02 && summary.energy_drift < 1e-3, "{law} {stress_state} {most} {remap}");
        }
    }
}

#[test]
fn parts_with_common_nodes_and_surfaces_that_are_tied_are_refused() {
    let mut model = on_a_slope(Formulation::DoublePass);
    model.contacts[0].tied = Some(f64::INFINITY);
    assert!(faults(&model).join("\n").contains("ties surfaces"));
    let model = on_a_slope(Formulation::Segment);
    assert!(faults(&model).join("\n").contains("`segment`"));
    let mut model = embate_solver::model::Model { ..crate::bodies::model(1e-3) };
    let mut mesh = mapped([2, 1], |u, v| [2.0 * u, v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    mesh.groups = vec![group("left", 2, cells[..1].iter().cloned()), group("right", 2, cells[1..].iter().cloned())];
    add_groups(&mut model, mesh, &["left", "right"], [0.0; 2]);
    model.remeshes.push(every("left", 1e-4));
    let found = faults(&model).join("\n");
    assert!(found.contains("nodes in common with part `right`"), "{found}");
}
