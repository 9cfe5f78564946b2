//! Ties of surfaces (`formulation = "segment"`): the patch test between meshes that differ, under tension,
//! compression and shear; rigid motion, objectivity, sides that are exchanged; all at once at the strength.

use crate::bodies::*;
use crate::segment_in_3d::{add_grid, apart, crooked, rotated};
use embate_solver::model::{
    Axis, Constraint, Contact, Cuboid, Curve, Drive, Formulation, Interface, Model, Part, Partners, Penalty, Relaxation, Rotation, Shape,
};

type Vector = [f64; 3];

fn tie(formulation: Formulation, penalty: Penalty, between: [&str; 2]) -> Contact {
    let [first, second] = between;
    Contact { formulation, tied: Some(f64::INFINITY), interface: penalty.into(), ..Contact::between("seam", first, second) }
}

/// Two blocks above each other, 1 m wide and high together, with a seam of this slope, that are pulled apart
/// (or pressed) by 5 mm at the top until they rest: the stress is uniaxial whatever the seam, on which it
/// pulls and shears. The largest spread of a component among all elements, against the mean of σ_vv; `up` is
/// v.
fn spread(mut model: Model, up: usize, by: f64) -> f64 {
    // Without a path: what waves do on the way leaves nothing.
    model.materials.get_mut("soft").unwrap().law = "neo_hookean".into();
    model.curves.insert("pull".into(), Curve::table(vec![0.0, 0.1, 0.1001], vec![10.0 * by, 10.0 * by, 0.0]));
    for (on, drive) in [("lower-bottom", Drive::from(0.0)), ("upper-top", Drive::Curve("pull".into()))] {
        let mut velocity = [None, None, None];
        velocity[up] = Some(drive);
        model.constraints.push(Constraint { on: on.into(), velocity, ..Constraint::default() });
    }
    model.run.relaxation = Some(Relaxation { tolerance: 1e-24, from: 0.11 });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    assert!(simulation.time() < 29.0, "it rests");
    assert_eq!(simulation.sweeps().1, 0, "forces that were not solved");
    let frame = simulation.frame();
    let stresses = &frame.fields.iter().find(|field| field.kind.name == "stress").unwrap().values;
    let components = if up == 2 { 6 } else { 4 };
    let all: Vec<&[f64]> = stresses.chunks_exact(components).collect();
    let mean = all.iter().map(|s| s[up]).sum::<f64>() / all.len() as f64;
    assert!(mean.abs() > 1.5e3 && mean * by > 0.0, "{mean}");
    let spread = |k: usize| {
        let [low, high] = all.iter().map(|s| s[k]).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
        (high - low) / mean.abs()
    };
    (0..components).map(spread).fold(0.0, f64::max)
}

/// In 2D, with so many elements along the seam.
fn plane(formulation: Formulation, penalty: Penalty, across: [usize; 2], slope: f64, by: f64) -> f64 {
    let mut model = slender(30.0, 1e6, 1000.0);
    let seam = move |u: f64| 0.5 + slope * (u - 0.5);
    let mut block = |name: &str, count: usize, is_upper: bool| {
        let wave = |a: f64| (std::f64::consts::PI * a).sin();
        let mut mesh = mapped([count, 3], |u, v| {
            // Nodes within are moved aside, and along the seam.
            let u = u + if is_upper { -0.05 } else { 0.06 } * wave(u) * (1.0 + v);
            let v = v + 0.05 * wave(u) * wave(v);
            [u, if is_upper { seam(u) + (1.0 - seam(u)) * v } else { seam(u) * v }]
        });
        let row = |j: usize| (0..count).map(move |i| vec![(j * (count + 1) + i) as u32, (j * (count + 1) + i + 1) as u32]);
        mesh.groups.push(group(&format!("{name}-bottom"), 1, row(0)));
        mesh.groups.push(group(&format!("{name}-top"), 1, row(3)));
        add_mesh(&mut model, name, mesh, [0.0; 2]);
    };
    block("lower", across[0], false);
    block("upper", across[1], true);
    model.contacts.push(tie(formulation, penalty, ["lower-top", "upper-bottom"]));
    spread(model, 1, by)
}

/// In 3D.
fn solid(formulation: Formulation, elements: [&str; 2], cells: [[usize; 3]; 2], slope: f64, by: f64) -> f64 {
    let mut model = slender(30.0, 1e6, 1000.0);
    let seam = move |x: f64| 0.5 + slope * (x - 0.5);
    let lower = |x: Vector| {
        let [x, y, z] = crooked(x, 0.06);
        [x, y, seam(x) * z]
    };
    let upper = |x: Vector| {
        let [x, y, z] = crooked(x, -0.05);
        [x, y, seam(x) + (1.0 - seam(x)) * z]
    };
    add_grid(&mut model, "lower", elements[0], cells[0], false, [0.0; 3], lower);
    add_grid(&mut model, "upper", elements[1], cells[1], false, [0.0; 3], upper);
    model.contacts.push(tie(formulation, Penalty::automatic(1.0), ["lower-top", "upper-bottom"]));
    spread(model, 2, by)
}

#[test]
fn tied_segments_pass_the_patch_test_on_any_two_meshes() {
    for across in [[3, 4], [8, 11], [5, 5]] {
        for (slope, by) in [(0.0, 5e-3), (0.0, -5e-3), (0.6, 5e-3)] {
            for penalty in [Penalty::automatic(1.0), Penalty::Pressure(1e8)] {
                let error = plane(Formulation::Segment, penalty, across, slope, by);
                println!("{across:?} {slope} {by} {penalty:?}: {error:.1e}");
                assert!(error < 1e-10, "{across:?} {slope} {by} {penalty:?}: {error}");
            }
        }
        // Nodes that are tied disturb the stress, on fine meshes too.
        let error = plane(Formulation::DoublePass, Penalty::automatic(1.0), across, 0.0, 5e-3);
        println!("{across:?}, nodes: {error:.1e}");
        assert!(error > 0.01, "{across:?}: {error}");
    }
}

#[test]
fn tied_facets_pass_the_patch_test_on_any_two_meshes() {
    let cells = [[3, 3, 2], [4, 4, 2]];
    for (elements, slope, by) in [
        (["hex8", "hex8"], 0.0, 5e-3),
        (["hex8", "hex8"], 0.0, -5e-3),
        (["hex8", "hex8"], 0.6, 5e-3),
        (["tet4", "hex8"], 0.0, 5e-3),
        (["hex8", "tet4"], 0.6, 5e-3),
        (["wedge6", "tet4"], 0.0, 5e-3),
    ] {
        let error = solid(Formulation::Segment, elements, cells, slope, by);
        println!("{elements:?} {slope} {by}: {error:.1e}");
        assert!(error < 1e-10, "{elements:?} {slope} {by}: {error}");
    }
    // Corner on corner, where means alone would not see corners move in and out.
    let error = solid(Formulation::Segment, ["hex8", "hex8"], [[3, 3, 2]; 2], 0.0, 5e-3);
    assert!(error < 1e-10, "{error}");
    let error = solid(Formulation::DoublePass, ["hex8", "hex8"], cells, 0.0, 5e-3);
    println!("nodes: {error:.1e}");
    assert!(error > 0.01, "{error}");
}

/// Two blocks of unlike meshes that are tied at a distance (m), the upper one with a velocity and a spin
/// about its middle; turned by an angle about the line x = y = z.
fn pair(gap: f64, velocity: Vector, spin: f64, angle: f64) -> Model {
    let turn = move |v: Vector| rotated([1.0 / 3f64.sqrt(); 3], angle, v);
    let mut model = model(2e-3);
    add_grid(&mut model, "lower", "hex8", [3, 3, 2], false, [0.0; 3], move |[x, y, z]| turn([0.1 * x, 0.1 * y, 0.05 * z]));
    add_grid(&mut model, "upper", "tet4", [4, 3, 2], false, turn(velocity), move |[x, y, z]| {
        turn([0.01 + 0.08 * x, 0.02 + 0.07 * y, 0.05 + gap + 0.05 * z])
    });
    model.parts[1].spin = spin;
    model.contacts.push(tie(Formulation::Segment, Penalty::automatic(1.0), ["lower-top", "upper-bottom"]));
    model
}

/// The largest force of two blocks that turn as one by a quarter, N, and the angle of a step.
fn force_of_turning(gap: f64) -> (f64, f64) {
    let mut model = pair(gap, [0.0; 3], 0.0, 0.4);
    model.run.end = 1e-3;
    let about = Axis { centre: [0.3, -0.1, 0.2], direction: [0.5, -1.0, 2.0] };
    let speed = Drive::from(std::f64::consts::FRAC_PI_2 / model.run.end);
    for part in ["lower", "upper"] {
        let rotation = Some(Rotation { speed: speed.clone(), about });
        model.constraints.push(Constraint { on: part.into(), rotation, ..Constraint::default() });
    }
    let (simulation, history) = run(&model);
    let moved = history.last("upper.x") - history.first("upper.x");
    assert!(moved.abs() > 0.01, "{moved}");
    let force = |d: &str| history.column(&format!("contact.force_{d}[seam]")).into_iter().fold(0.0, |most: f64, f| most.max(f.abs()));
    (["x", "y", "z"].map(force).into_iter().fold(0.0, f64::max), std::f64::consts::FRAC_PI_2 / simulation.steps() as f64)
}

#[test]
fn a_rigid_motion_of_what_is_tied_gives_no_force() {
    // What the distance would press with over the upper block's face.
    let whole = |gap: f64| 1e9 * gap / 0.025 * 0.08 * 0.07;
    let (force, _) = force_of_turning(0.0);
    println!("{force:e} of {:e}", whole(1e-4));
    assert!(force < 1e-9 * whole(1e-4), "{force}");
    // Half way through a step the distance is that of the chords, cos ½θ of it.
    let (force, angle) = force_of_turning(1e-4);
    println!("{force:e} of {:e}, by a step {:e}", whole(1e-4), 0.125 * angle * angle);
    assert!(force < 0.2 * angle * angle * whole(1e-4), "{force} {angle}");
}

/// Positions at the end, turned back.
fn places(model: &Model, angle: f64) -> Vec<Vector> {
    let simulation = to_end(model);
    let summary = simulation.summary();
    println!("momenta {:?} {:?}", summary.momentum_drift_linear, summary.momentum_drift_angular);
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{} {}", summary.ledger_residual, summary.energy_drift);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12);
    simulation.frame().positions::<3>().iter().map(|&x| rotated([1.0 / 3f64.sqrt(); 3], -angle, x)).collect()
}

#[test]
fn tied_bodies_that_are_turned_or_whose_sides_are_exchanged_move_alike() {
    let velocity = [3.0, -2.0, 4.0];
    let straight = places(&pair(1e-4, velocity, 0.0, 0.0), 0.0);
    let far = apart(&straight, &places(&pair(1e-4, velocity, 0.0, 0.9), 0.9));
    let mut exchanged = pair(1e-4, velocity, 0.0, 0.0);
    exchanged.contacts[0].partners = Partners::Between(["upper-bottom".into(), "lower-top".into()]);
    let other = apart(&straight, &places(&exchanged, 0.0));
    println!("turned {far:.1e} m, exchanged {other:.1e} m");
    assert!(far < 1e-11 && other < 1e-11, "{far} {other}");
}

#[test]
fn threads_and_a_stop_between_change_no_bit_of_tied_surfaces() {
    let mut model = pair(1e-4, [3.0, -2.0, 4.0], 50.0, 0.3);
    model.run.end = 4e-4;
    model.contacts[0].tied = Some(4e6);
    let alone = hash_of_equal_bits(&model, &[1, 3], "tied facets");
    let broken = to_end(&model).summary().warnings;
    println!("{broken:?}");
    let mut first = simulation(&model);
    for until in [5e-5, 1.5e-4, 3e-4] {
        first.advance(until, u64::MAX).unwrap();
        continues_to(&alone, &model, &mut first, "tied facets");
    }
}

/// A bar of two unlike meshes that are tied by this strength (Pa), held at the left and driven at the right
/// with 20 m/s times `by`: along it from zero on within 0.2 ms, then across it within 0.1 ms.
fn driven_bar(strength: f64, by: [f64; 2]) -> Model {
    let mut model = slender(6e-4, 1e9, 1000.0);
    add(&mut model, "left", rectangle([-0.1, 0.0], [0.1, 0.04], [20, 3]), [0.0; 2]);
    add(&mut model, "right", rectangle([0.0, 0.0], [0.1, 0.04], [20, 4]), [0.0; 2]);
    glue(&mut model, strength, by);
    model
}

/// Ties the parts of a bar, and holds and drives its ends.
fn glue(model: &mut Model, strength: f64, by: [f64; 2]) {
    let [along, across] = by.map(|by| 20.0 * by);
    model.curves.insert("along".into(), Curve::table(vec![0.0, 2e-4, 1.0], vec![0.0, along, along]));
    model.curves.insert("across".into(), Curve::table(vec![0.0, 2e-4, 3e-4, 1.0], vec![0.0, 0.0, across, across]));
    let curve = |name: &str| Some(Drive::Curve(name.into()));
    let still = Some(Drive::from(0.0));
    let ends = [("left.left", [still.clone(), still, None]), ("right.right", [curve("along"), curve("across"), None])];
    for (on, velocity) in ends {
        model.constraints.push(Constraint { on: on.into(), velocity, ..Constraint::default() });
    }
    let glue = Contact { tied: Some(strength), formulation: Formulation::Segment, ..Contact::between("glue", "right.left", "left.right") };
    model.contacts.push(Contact { interface: Interface::from(Penalty::automatic(10.0)), ..glue });
}

#[test]
fn uniform_tension_breaks_all_that_is_tied_in_one_step() {
    let strength = 5e6;
    let mut simulation = simulation(&driven_bar(strength, [1.0, 0.0]));
    let (mut force, mut lost) = (0.0, 0.0);
    while simulation.summary().warnings.is_empty() {
        assert!(!simulation.is_over(), "it breaks");
        (force, lost) = (value(&simulation, "contact.force_x[glue]"), value(&simulation, "energy.contact_damping"));
        simulation.advance(f64::INFINITY, 1).unwrap();
    }
    let warnings = simulation.summary().warnings;
    assert!(warnings[0].text.contains("6 of 6 ties broke"), "{warnings:?}");
    // The last step before held less than the strength, and not much less.
    let traction = force.abs() / 0.04;
    println!("{traction:e} of {strength:e}, lost {lost}");
    assert!(traction < strength && traction > 0.9 * strength, "{traction}");
    simulation.advance(f64::INFINITY, 2).unwrap();
    // ½ σ²/κ on the whole face, with κ = 10 E/h.
    let stored = 0.5 * strength * strength / (10.0 * 1e9 / 0.005) * 0.04;
    let lost = value(&simulation, "energy.contact_damping") - lost;
    println!("{lost} of {stored}");
    assert!(lost > 0.8 * stored && lost < 1.25 * stored, "{lost} {stored}");
}

/// Runs a bar that is pressed and sheared until its seam begins to break, and on: the force that presses
/// continues from step to step.
fn keeps_pressing(model: &Model, case: &str) {
    let mut simulation = simulation(model);
    let (mut left, mut before, mut most) = (20, 0.0, 0.0_f64);
    while left > 0 {
        assert!(!simulation.is_over(), "{case}: it breaks");
        simulation.advance(f64::INFINITY, 1).unwrap();
        let force = value(&simulation, "contact.force_x[glue]");
        if simulation.summary().warnings.iter().any(|warning| warning.text.contains("ties broke")) {
            left -= 1;
            // The step of the break has still the forces of the tie.
            most = most.max(f64::abs(force / before - 1.0));
        }
        before = force;
    }
    println!("{case}: {before} N, by a step at most {most}");
    assert!(before.abs() > 1e3 && most < 0.1, "{case}: {before} {most}");
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let summary = simulation.summary();
    println!("{case}: {:?}, ledger {:.1e}, energy {:.1e}", summary.warnings, summary.ledger_residual, summary.energy_drift);
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{case}: {summary:?}");
}

#[test]
fn what_shears_off_under_pressure_goes_on_pressing() {
    keeps_pressing(&driven_bar(5e5, [-1.0, 1.0]), "2D");
    let mut model = slender(6e-4, 1e9, 1000.0);
    for (name, from, cells) in [("left", -0.1, [10, 3, 2]), ("right", 0.0, [10, 4, 3])] {
        let shape = Shape::Cuboid(Cuboid { corner: [from, 0.0, 0.0], size: [0.1, 0.04, 0.03], elements: cells, ..Cuboid::default() });
        model.parts.push(Part { name: name.into(), material: "soft".into(), element: "hex8".into(), shape, ..Part::default() });
    }
    glue(&mut model, 5e5, [-1.0, 1.0]);
    keeps_pressing(&model, "3D");
}
