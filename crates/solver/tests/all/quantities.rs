//! Reactions, resultants, cuts, accelerations, spins and fields of probes: against balances that share
//! nothing with how they are found, and closed forms.

use crate::bodies::*;
use embate_solver::model::{
    Axis, Cadence, Constraint, Contact, Cuboid, Curve, CurveShape, Cut, Drive, Extreme, Forces, Load, LoadTerms, Model, Obstacle, Partners,
    Probe, ProbeAt, Relaxation, Rotation, Shape, Symmetry,
};

fn close(found: f64, wanted: f64, scale: f64, what: &str) {
    assert!((found - wanted).abs() <= scale, "{what}: {found:e} for {wanted:e}");
}

/// A cantilever of solids in 2D, held by a symmetry line and a constraint, under pressure, force and gravity,
/// that falls on an obstacle.
fn scene(forces: Forces) -> Model {
    let mut model = model(3e-4);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.05], [10, 5]), [3.0, -20.0]);
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], name: "axis".into(), ..Symmetry::default() });
    model.constraints.push(Constraint {
        on: "block.right".into(),
        name: "end".into(),
        velocity: [None, Some(Drive::Constant(-5.0)), None],
        ..Constraint::default()
    });
    model.loads.push(Load::Pressure { on: "block.top".into(), pressure: 4e6, curve: None });
    model.loads.push(Load::Force { on: "block.bottom".into(), force: [2e4, 1e4, 0.0], curve: None });
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -9.81, 0.0], curve: None });
    model.load_terms = ["press", "push", "weight"].map(|name| LoadTerms { name: name.into(), stages: vec![] }).to_vec();
    model.obstacles.push(Obstacle::wall("floor", [0.0, -0.0005], [0.0, 1.0]));
    model.output.forces = forces;
    model
}

#[test]
fn mass_times_mean_acceleration_is_the_sum_of_the_mean_forces_in_every_interval() {
    // Five rows, each over many steps: Newton's second law for the whole body.
    let mut model = scene(Forces::Mean);
    model.output.history = Cadence::Count(5);
    let (simulation, history) = run(&model);
    assert!(simulation.steps() > 50);
    let mass = simulation.overview().parts[0].mass;
    for axis in ["x", "y"] {
        let of = |name: &str| history.column(&name.replace('@', axis));
        let forces = [
            "symmetry.force_@[axis]",
            "constraint.force_@[end]",
            "load.force_@[press]",
            "load.force_@[push]",
            "load.force_@[weight]",
            "obstacle.force_@[floor]",
        ]
        .map(of);
        for (row, acceleration) in of("block.a@").iter().enumerate() {
            let sum: f64 = forces.iter().map(|force| force[row]).sum();
            let scale: f64 = forces.iter().map(|force| force[row].abs()).sum();
            close(mass * acceleration, sum, 1e-11 * scale, &format!("{axis}, row {row}"));
        }
    }
    assert!(history.column("obstacle.force_y[floor]").iter().any(|force| *force > 1e5));
    assert!(history.column("symmetry.force_y[axis]").iter().all(|force| *force == 0.0));
    assert!(history.column("constraint.force_x[end]").iter().all(|force| *force == 0.0));
    // The mean of the velocity's change: rows are dense in impulse.
    let (time, speed) = (history.column("time"), history.column("block.vx"));
    assert_eq!(time.len(), speed.len());
    let forces = simulation.summary().forces;
    let floor = forces.iter().find(|it| it.name == "obstacle[floor]").unwrap();
    let [x, y] = ["x", "y"].map(|axis| history.column(&format!("obstacle.force_{axis}[floor]")));
    let largest = x.iter().zip(&y).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    assert_eq!(floor.largest, largest);
    assert_eq!(floor.last, [*x.last().unwrap(), *y.last().unwrap()]);
}

#[test]
fn samples_are_those_of_the_row_and_differ_from_means() {
    let history = |forces| {
        let mut model = scene(forces);
        model.output.history = Cadence::Count(5);
        run(&model).1.column("obstacle.force_y[floor]")
    };
    let (mean, sample) = (history(Forces::Mean), history(Forces::Sample));
    // Rows at every step are the same both ways.
    let dense = |forces| {
        let mut model = scene(forces);
        model.output.history = Cadence::Interval(1e-10);
        run(&model).1.column("constraint.force_y[end]")
    };
    assert_eq!(mean.len(), sample.len());
    assert_ne!(mean, sample);
    for (mean, sample) in dense(Forces::Mean).into_iter().zip(dense(Forces::Sample)) {
        close(mean, sample, 1e-12 * sample.abs(), "every step");
    }
}

#[test]
fn the_last_row_of_a_step_that_fails_has_the_forces_of_the_step_before() {
    // A bar that is thrown on its held end until an element turns inside out, away from the origin; each step
    // has its row.
    let mut model = model(6e-5);
    let soft = model.materials.get_mut("soft").unwrap();
    soft.law = "j2".into();
    soft.parameters.insert("yield".into(), 1e6);
    add(&mut model, "bar", rectangle([0.0, 0.1], [0.003, 0.03], [3, 30]), [0.0, -300.0]);
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    model.constraints.push(Constraint {
        on: "bar.bottom".into(),
        velocity: [None, Some(Drive::Constant(0.0)), None],
        ..Constraint::default()
    });
    model.output.history = Cadence::Count(600_000);
    for forces in [Forces::Mean, Forces::Sample] {
        model.output.forces = forces;
        let (error, history) = run_to_failure(&model);
        assert!(matches!(error, embate_solver::error::Error::Inverted { .. }), "{error}");
        for name in ["symmetry.force_x[0]", "constraint.force_y[0]"] {
            let column = history.column(name);
            let [.., before, last] = column[..] else { panic!("there are two rows") };
            assert!(before.abs() > 1.0, "{name}: {before}");
            close(last, before, 1e-12 * before.abs(), name);
        }
    }
}

#[test]
fn two_oblique_planes_take_what_acts_along_their_own_normals() {
    // A wedge-shaped corner at the origin is held by planes 60 degrees apart and pulled at by a force: only
    // normal forces, N₁ n₁ + N₂ n₂ + F = 0 at rest.
    let mut model = model(2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.02, 0.02], [2, 2]), [0.0; 2]);
    let (c, s) = (0.5, 3f64.sqrt() / 2.0);
    for (name, normal) in [("one", [1.0, 0.0, 0.0]), ("two", [c, s, 0.0])] {
        model.symmetries.push(Symmetry { name: name.into(), normal, ..Symmetry::default() });
    }
    // Of the second plane only the origin is a node: nothing else holds the block along y.
    model.constraints.push(Constraint {
        on: "block.bottom".into(),
        velocity: [None, Some(Drive::Constant(0.0)), None],
        ..Constraint::default()
    });
    model.run.relaxation = Some(Relaxation { tolerance: 1e-20, from: 0.0 });
    model.loads.push(Load::Force { on: "block.right".into(), force: [700.0, 0.0, 0.0], curve: None });
    model.loads.push(Load::Force { on: "block.top".into(), force: [0.0, -300.0, 0.0], curve: None });
    let (_, history) = run(&model);
    let last = |name: &str| history.last(name);
    // The line x = 0 alone takes the force along x; the second one, which has nothing left to do at the
    // corner but along y, takes with it what pushes there along its own normal.
    let [two_x, two_y] = [last("symmetry.force_x[two]"), last("symmetry.force_y[two]")];
    close(two_y * c, two_x * s, 1e-9 * 700.0, "along its own normal");
    assert!(two_y.abs() > 1.0, "{two_y}");
    close(last("symmetry.force_y[one]"), 0.0, 1e-9, "the line x = 0 along y");
    close(last("symmetry.force_x[one]") + two_x, -700.0, 1e-6 * 700.0, "along x");
    close(two_y + last("constraint.force_y[0]"), 300.0, 1e-6 * 300.0, "along y");
}

/// A cantilever along x that a force at its end bends, of an element.
fn cantilever(element: &str) -> (Model, [f64; 3]) {
    let mut model = slender(4.0, 1.2e6, 30.0);
    let shape = if element.starts_with("hex") {
        Shape::Cuboid(Cuboid { corner: [0.0, -0.05, -0.05], size: [1.0, 0.1, 0.1], elements: [10, 4, 2], ..Cuboid::default() })
    } else {
        rectangle([0.0, -0.05], [1.0, 0.1], [20, 4])
    };
    add(&mut model, "arm", shape, [0.0; 2]);
    model.parts[0].element = element.into();
    (model, [0.02, 0.1, 0.0])
}

#[test]
fn cuts_transmit_force_and_moment_of_a_cantilever_at_rest() {
    for element in ["quad4_reduced_assumed_strain", "hex8_reduced_assumed_strain"] {
        let (mut model, force) = cantilever(element);
        let is_solid = element.starts_with("hex");
        let fixed = || Some(Drive::Constant(0.0));
        model.constraints.push(Constraint {
            on: "arm.left".into(),
            velocity: [fixed(), fixed(), if is_solid { fixed() } else { None }],
            ..Constraint::default()
        });
        model.curves.insert("ramp".into(), Curve::from(CurveShape::Table { times: vec![0.0, 2.0], values: vec![0.0, 1.0], smooth: true }));
        model.loads.push(Load::Force { on: "arm.right".into(), force, curve: Some("ramp".into()) });
        model.run.relaxation = Some(Relaxation { tolerance: 1e-15, from: 2.0 });
        for (name, x, normal) in [("near", 0.26, [1.0, 0.0, 0.0]), ("far", 0.71, [1.0, 0.0, 0.0]), ("back", 0.26, [-3.0, 0.0, 0.0])] {
            model.cuts.push(Cut { name: name.into(), point: [x, 0.0, 0.0], normal, ..Cut::default() });
        }
        model.probes = vec![Probe { name: "tip".into(), at: ProbeAt::Set { set: "arm.right".into() }, ..Probe::default() }];
        let (_, history) = run(&model);
        let last = |name: &str| history.last(name);
        let about_z = if is_solid { "moment_z" } else { "moment" };
        for name in ["near", "far"] {
            close(last(&format!("cut.force_x[{name}]")), force[0], 1e-6, &format!("{element} {name} N"));
            close(last(&format!("cut.force_y[{name}]")), force[1], 1e-6, &format!("{element} {name} Q"));
            close(last(&format!("cut.normal_force[{name}]")), force[0], 1e-6, name);
        }
        close(last("cut.normal_force[back]"), force[0], 1e-6, "normal forces are the same from both sides");
        close(last("cut.force_y[back]"), -force[1], 1e-6, "the other side");
        // Lever arms in the deformed state are not known here but for equilibrium of the piece between: the
        // moments differ by Q times the distance of the centres along x, less N times that along y.
        let (near, far) = (last(&format!("cut.{about_z}[near]")), last(&format!("cut.{about_z}[far]")));
        close(near - far, force[1] * 0.45, 2e-3, &format!("{element}: near {near} far {far}"));
        close(far, force[1] * 0.29, 2e-3, &format!("{element}: far {far}"));
        // The wall: all of both, and the moment about the middle of the left side.
        close(last("constraint.force_x[0]"), -force[0], 1e-6, "wall");
        close(last("constraint.force_y[0]"), -force[1], 1e-6, "wall");
        let wall = last(&format!("constraint.{about_z}[0]"));
        let lever = force[1] * last("tip.x") - force[0] * last("tip.y");
        close(wall, -lever, 1e-5, &format!("{element}: the wall's moment"));
    }
}

#[test]
fn a_rod_that_spins_is_pulled_at_by_what_lies_beyond_the_cut() {
    // N(r) = ½ ρ A ω² (L² − r²), of a rod that begins in the frame that spins: at rest in it.
    let mut model = model(2e-2);
    add(&mut model, "rod", rectangle([0.0, 0.0], [1.0, 0.02], [50, 1]), [0.0; 2]);
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    model.run.relaxation = Some(Relaxation { tolerance: 1e-14, from: 0.0 });
    model.loads.push(Load::Centrifugal { parts: vec![], about: Axis::default(), speed: 10.0, curve: None });
    model.constraints.push(Constraint {
        on: "rod.bottom".into(),
        velocity: [None, Some(Drive::Constant(0.0)), None],
        ..Constraint::default()
    });
    model.cuts.push(Cut {
        name: "half".into(),
        point: [0.51, 0.01, 0.0],
        normal: [1.0, 0.0, 0.0],
        parts: vec!["rod".into()],
        ..Cut::default()
    });
    let (simulation, history) = run(&model);
    let mass = simulation.overview().parts[0].mass;
    let wanted = 0.5 * mass * 1e2;
    close(history.last("symmetry.force_x[0]"), -wanted, 1e-3 * wanted, "hub");
    // The nodes at 0.52 and beyond, with half an element's mass at each end.
    let beyond: f64 = (26..=50).map(|k| f64::from(k) * 0.02 * if k == 50 { 0.5 } else { 1.0 }).sum::<f64>() * 0.02 * mass * 1e2;
    close(history.last("cut.normal_force[half]"), beyond, 1e-3 * wanted, "half");
    close(history.last("load.force_x[0]"), wanted, 1e-3 * wanted, "load");
}

#[test]
fn cuts_that_meet_nothing_or_what_is_rigid_are_faults() {
    let mut model = scene(Forces::Mean);
    model.cuts.push(Cut { name: "beside".into(), point: [5.0, 0.0, 0.0], normal: [1.0, 0.0, 0.0], ..Cut::default() });
    let Err(embate_solver::error::Error::Model(faults)) = embate_solver::simulation::Simulation::new(&model, &Default::default()) else {
        panic!("a cut of nothing is accepted")
    };
    assert_eq!(faults.iter().map(|fault| (fault.kind.code, fault.path.as_str())).collect::<Vec<_>>(), [("E0215", "cut[0]")]);
    model.cuts[0].parts = vec!["block".into()];
    model.parts[0].rigid = Some(Default::default());
    assert!(model.check().iter().any(|fault| fault.path == "cut[0].parts[0]" && fault.kind.code == "E0215"));
}

#[test]
fn a_body_that_falls_and_spins_has_its_acceleration_and_spin() {
    let mut model = model(1e-3);
    add(&mut model, "soft", rectangle([0.0, 0.0], [0.1, 0.1], [3, 3]), [0.0, 0.0]);
    model.parts[0].spin = 200.0;
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [1.0, -10.0, 0.0], curve: None });
    let (_, history) = run(&model);
    for (name, wanted, scale) in [("soft.ax", 1.0, 1e-8), ("soft.ay", -10.0, 1e-8), ("soft.spin", 200.0, 0.2)] {
        history.column(name).iter().for_each(|&found| close(found, wanted, scale, name));
    }
}

#[test]
fn a_driven_rotation_has_the_torque_that_turns_the_body() {
    // All nodes rotate about the middle from rest at a constant angular acceleration α: the torque is I α of
    // the lumped masses.
    let mut model = model(4e-4);
    add(&mut model, "block", rectangle([-0.05, -0.05], [0.1, 0.1], [6, 6]), [0.0, 0.0]);
    model.curves.insert("up".into(), Curve::from(CurveShape::Expression("1e6*t".into())));
    model.constraints.push(Constraint {
        on: "block".into(),
        name: "turn".into(),
        rotation: Some(Rotation { speed: Drive::Curve("up".into()), about: Axis::through([0.0; 3]) }),
        ..Constraint::default()
    });
    let (simulation, history) = run(&model);
    let mass = simulation.overview().parts[0].mass;
    // Σ m r² of the lumped masses: of a square grid of n elements (a²/6)(1 + 2/n²)... from the points.
    let n = 6.0;
    let one: f64 = (0..=6).map(|k| (-0.05 + 0.1 * f64::from(k) / n).powi(2) * if k % 6 == 0 { 0.5 } else { 1.0 }).sum::<f64>() / n;
    let inertia = 2.0 * one * mass;
    let torque = history.column("constraint.moment[turn]");
    torque[1..].iter().for_each(|&found| close(found, inertia * 1e6, 2e-3 * inertia * 1e6, "torque"));
}

#[test]
fn a_stack_has_its_weights_by_pair() {
    let mut model = model(0.05);
    for (k, name) in ["low", "middle", "high"].iter().enumerate() {
        add(&mut model, name, rectangle([0.01 * k as f64, 0.1 * k as f64], [0.1, 0.1], [3, 3]), [0.0; 2]);
    }
    model.constraints.push(Constraint {
        on: "low.bottom".into(),
        velocity: [Some(Drive::Constant(0.0)), Some(Drive::Constant(0.0)), None],
        ..Constraint::default()
    });
    model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() });
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -1e4, 0.0], curve: None });
    model.loads.push(Load::Damping { parts: vec![], rate: 3e3, active: [0.0, f64::INFINITY] });
    model.output.history = Cadence::Count(20);
    let (simulation, history) = run(&model);
    let weight = simulation.overview().parts[0].mass * 1e4;
    close(history.last("contact.force_y[all:middle-high]"), -weight, 1e-3 * weight, "one block");
    close(history.last("contact.force_y[all:low-middle]"), -2.0 * weight, 2e-3 * weight, "two blocks");
    close(history.last("contact.force_y[all:low-high]"), 0.0, 0.0, "they don't touch");
    close(history.last("constraint.force_y[0]"), 3.0 * weight, 3e-3 * weight, "ground");
    let mut other = model.clone();
    other.contacts[0].pairs = Some(false);
    let simulation = embate_solver::simulation::Simulation::new(&other, &Default::default()).unwrap();
    assert!(!simulation.history_columns().iter().any(|name| name.contains(':')));
}

#[test]
fn fields_of_probes_are_those_of_frames_and_of_a_stretched_square() {
    // One square that is stretched by 20 % along x and 10 % along y at its nodes: strains are homogeneous.
    let mut model = model(1e-3);
    add(&mut model, "square", rectangle([0.0, 0.0], [1e-3, 1e-3], [2, 2]), [0.0; 2]);
    for (on, axis, speed) in [("left", 0, 0.0), ("right", 0, 0.2), ("bottom", 1, 0.0), ("top", 1, 0.1)] {
        let mut velocity = [None, None, None];
        velocity[axis] = Some(Drive::Constant(speed));
        model.constraints.push(Constraint { on: format!("square.{on}"), velocity, ..Constraint::default() });
    }
    model.run.energy_limit = 10.0;
    let soft = model.materials.get_mut("soft").unwrap();
    soft.law = "j2".into();
    soft.parameters.insert("yield".into(), 1e6);
    let fields = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Vec<_>>();
    let probe =
        |name: &str, at, names: &[&str], extreme| Probe { name: name.into(), at, fields: fields(names), extreme, ..Probe::default() };
    let set = || ProbeAt::Set { set: "square".into() };
    model.probes = vec![
        probe("one", ProbeAt::Element { part: "square".into(), element: 3 }, &["strain_log", "strain_green", "von_mises"], None),
        probe("all", set(), &["strain_log", "stress", "displacement"], None),
        probe("max", set(), &["displacement"], Some(Extreme::Max)),
        probe("min", set(), &["displacement", "plastic_strain"], Some(Extreme::Min)),
        probe("corner", ProbeAt::Point { part: "square".into(), point: [1e-3, 1e-3, 0.0] }, &["triaxiality", "velocity_gradient"], None),
        probe("plain", ProbeAt::Element { part: "square".into(), element: 0 }, &[], None),
    ];
    let (simulation, history) = run(&model);
    let last = |name: &str| history.last(name);
    let (x, y) = (1.2f64, 1.1f64);
    for name in ["one", "all"] {
        close(last(&format!("{name}.strain_log_xx")), x.ln(), 1e-3, name);
        close(last(&format!("{name}.strain_log_yy")), y.ln(), 1e-3, name);
    }
    close(last("one.strain_green_xx"), 0.5 * (x * x - 1.0), 1e-3, "Green");
    close(last("max.displacement_x"), 2e-4, 1e-6, "max");
    close(last("min.displacement_y"), 0.0, 1e-15, "min");
    close(last("all.displacement_x"), 1e-4, 1e-6, "mean");
    // ẋ = 0.2 m/s over 1.2 mm.
    close(last("corner.velocity_gradient_xx"), 0.2 / 1.2e-3, 1.0, "L");
    let stress = simulation.field("stress").unwrap().values;
    let mean: f64 = stress.chunks(4).map(|own| own[0]).sum::<f64>() / 4.0;
    close(last("all.stress_xx"), mean, 1e-9 * mean.abs(), "stress");
    assert!(last("min.plastic_strain") > 0.1 && last("plain.plastic_strain") > 0.1, "defaults of an element");
}

#[test]
fn lode_angle_and_triaxiality_tell_tension_shear_and_compression_apart() {
    let thirty = std::f64::consts::FRAC_PI_6;
    for (stress, lode, triaxiality) in [
        ([5e6, 0.0, 0.0, 0.0], 0.0, 1.0 / 3.0),
        ([-5e6, 0.0, 0.0, 0.0], 2.0 * thirty, -1.0 / 3.0),
        ([0.0, 0.0, 0.0, 4e6], thirty, 0.0),
        ([1e6, 1e6, 3e6, 0.0], 0.0, 5.0 / 6.0),
    ] {
        let mut model = model(1e-6);
        add(&mut model, "block", rectangle([0.0, 0.0], [1.0, 1.0], [1, 1]), [0.0; 2]);
        model.parts[0].stress_initial = Some(embate_solver::model::InitialStress::uniform(stress));
        let simulation = simulation(&model);
        let value = |name: &str| simulation.field(name).unwrap().values;
        close(value("lode_angle")[0], lode, 1e-9, "Lode");
        close(value("triaxiality")[0], triaxiality, 1e-12, "triaxiality");
        let principal = value("principal_stress");
        assert!(principal[0] >= principal[1] && principal[1] >= principal[2], "{principal:?}");
        close(principal.iter().sum(), stress[..3].iter().sum(), 1e-6, "trace");
    }
}
