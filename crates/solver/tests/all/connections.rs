//! Ties of the rims of shells, spot welds and joints: closed forms, conservation, failure, equal bits,
//! continued runs, and faults.

use crate::bodies::*;
use crate::long::is_long;
use crate::restart::continues;
use embate_solver::model::{
    Constraint, Contact, ContactLaw, Cuboid, Curve, CurveShape, Formulation, Image, Interface, Join, Joint, Line, Load, Model, Motion,
    Part, Partners, Probe, ProbeAt, Profile, Rectangle, Relaxation, Shape, ShellSection, SpaceTruss, Weld,
};
use embate_solver::simulation::Simulation;
use std::f64::consts::TAU;

fn ramp(model: &mut Model, end: f64) -> Option<String> {
    let shape = CurveShape::Table { times: vec![0.0, end], values: vec![0.0, 1.0], smooth: true };
    model.curves.insert("ramp".into(), Curve::from(shape));
    Some("ramp".into())
}

fn fix(model: &mut Model, on: &str, axes: [bool; 4]) {
    let still = |on: bool| on.then(|| 0.0.into());
    let velocity = [0, 1, 2].map(|d| still(axes[d]));
    let spin = [still(axes[3]), still(axes[3]), still(axes[3])];
    model.constraints.push(Constraint { on: on.into(), velocity, spin, ..Constraint::default() });
}

fn part(model: &mut Model, name: &str, element: &str, shape: Shape) -> usize {
    let section = element.starts_with("shell").then(|| ShellSection { thickness: 0.1, points: 2, ..ShellSection::default() });
    model.parts.push(Part {
        name: name.into(),
        material: "soft".into(),
        element: element.into(),
        section,
        shape,
        stress_state: if matches!(element, "shell2") || element.starts_with("quad4") {
            "plane_stress".into()
        } else {
            "plane_strain".into()
        },
        ..Part::default()
    });
    model.parts.len() - 1
}

fn cuboid(corner: [f64; 3], size: [f64; 3], elements: [usize; 3]) -> Shape {
    Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() })
}

/// The nodes of the solid are the slaves: all of them follow the section of the shell, and not only those at
/// its faces.
fn tied(model: &mut Model, one: &str, other: &str) {
    model.contacts.push(Contact {
        name: "tie".into(),
        partners: Partners::Between([one.into(), other.into()]),
        formulation: Formulation::SinglePass { slave: 0 },
        tied: Some(f64::INFINITY),
        interface: Interface { law: ContactLaw::Multiplier, ..Interface::default() },
        ..Contact::default()
    });
}

/// A cantilever of two halves of half a metre: a solid at the wall, a shell at the free end, where a force of
/// 0.1 N per metre of width acts across.
fn halves(dimension: usize) -> Model {
    let mut model = slender(30.0, 1.2e6, 1000.0);
    let curve = ramp(&mut model, 4.0);
    model.run.relaxation = Some(Relaxation { tolerance: 1e-14, from: 4.0 });
    if dimension == 2 {
        part(&mut model, "solid", "quad4_reduced_assumed_strain", rectangle([0.0, -0.05], [0.5, 0.1], [20, 4]));
        part(
            &mut model,
            "shell",
            "shell2",
            Shape::Line(Line { points: vec![[0.5, 0.0], [1.0, 0.0]], radius: 0.0, closed: false, elements: 8 }),
        );
        model.loads.push(Load::Force { on: "shell.end".into(), force: [0.0, 0.1, 0.0], curve });
    } else {
        part(&mut model, "solid", "hex8_reduced_assumed_strain", cuboid([0.0, 0.0, -0.05], [0.5, 0.1, 0.1], [16, 2, 4]));
        let sheet = Rectangle { corner: [0.5, 0.0], size: [0.5, 0.1], elements: [8, 2], ..Rectangle::default() };
        part(&mut model, "shell", "shell4", Shape::Rectangle(sheet));
        model.loads.push(Load::Force { on: "shell.right".into(), force: [0.0, 0.0, 0.01], curve });
    }
    fix(&mut model, "solid.left", [true, true, dimension == 3, false]);
    let end = if dimension == 2 { "shell.end" } else { "shell.right" };
    model.probes.push(Probe { name: "tip".into(), at: ProbeAt::Set { set: end.into() }, ..Probe::default() });
    model
}

#[test]
fn a_rim_that_is_tied_carries_the_moment_and_one_that_is_joined_is_a_hinge() {
    // P L³/3EI + P L/(k G A).
    let beam = 0.1 / (3.0 * 1.2e6 * 1e-3 / 12.0) + 0.1 / (5.0 / 6.0 * 0.6e6 * 0.1);
    for dimension in [2, 3] {
        let mut model = halves(dimension);
        tied(&mut model, "solid.right", "shell");
        let simulation = to_end(&model);
        let found = value(&simulation, if dimension == 2 { "tip.y" } else { "tip.z" });
        assert!((found / beam - 1.0).abs() < 0.01, "{dimension}D: {found:e} for {beam:e}");
        assert!(!simulation.summary().warnings.iter().any(|warning| warning.kind.code == "W0501"));
    }
    let mut model = halves(2);
    model.joins.push(Join { between: ["shell.start".into(), "solid.right".into()], image: Image::Same, tolerance: None });
    model.run.relaxation = None;
    model.run.end = 4.0;
    let simulation = to_end(&model);
    assert!(value(&simulation, "tip.y") > 20.0 * beam, "{:e}", value(&simulation, "tip.y"));
    assert!(simulation.summary().warnings.iter().any(|warning| warning.kind.code == "W0501"));
}

/// A block and a sheet that are welded at two points, spin and fly, and are not at rest against each other.
fn flight(tie: bool) -> Model {
    let mut model = model(4e-3);
    model.materials.insert("soft".into(), elastic(200e6, 1000.0));
    let block = part(&mut model, "block", "hex8", cuboid([0.0; 3], [0.3, 0.2, 0.1], [4, 3, 2]));
    (model.parts[block].velocity, model.parts[block].spin) = ([3.0, 1.0, -2.0], 60.0);
    let sheet = Rectangle { corner: [0.0; 2], size: [0.3, 0.3], elements: [4, 4], ..Rectangle::default() };
    let sheet = part(&mut model, "sheet", "shell4", Shape::Rectangle(sheet));
    model.parts[sheet].velocity = [0.0, 0.0, 5.0];
    if tie {
        // The rim stands on the block's side.
        model.parts[sheet].placement.translation = [0.3, -0.05, 0.05];
        tied(&mut model, "block.right", "sheet");
    } else {
        model.parts[sheet].placement.translation = [0.0, 0.0, 0.15];
        let at = vec![[0.1, 0.1, 0.1], [0.2, 0.12, 0.1]];
        model.welds.push(Weld { name: "spot".into(), between: ["block.front".into(), "sheet".into()], at, ..Weld::default() });
    }
    model
}

fn keeps(simulation: &Simulation, drift: f64, case: &str) {
    let summary = simulation.summary();
    let momenta = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
    assert!(momenta.iter().all(|drift| *drift < 1e-12), "{case}: {momenta:?}");
    assert!(
        summary.ledger_residual < 1e-12 && summary.energy_drift < drift,
        "{case}: {:e} {:e}",
        summary.ledger_residual,
        summary.energy_drift
    );
    assert!(!summary.warnings.iter().any(|warning| warning.kind.code == "W0405"), "{case}");
}

#[test]
fn what_is_welded_or_tied_by_its_rim_keeps_momenta_energy_and_bits_in_flight() {
    for tie in [false, true] {
        let model = flight(tie);
        let simulation = to_end(&model);
        keeps(&simulation, 2e-4, &format!("tied: {tie}"));
        hash_of_equal_bits(&model, &[1, 2, 3], &format!("tied: {tie}"));
        continues(&format!("tied: {tie}"), &model, 60);
    }
}

#[test]
fn a_lap_joint_carries_the_load_and_no_moment_in_its_middle() {
    // Both strips are clamped at their far ends; a half turn about the weld maps one to the other.
    let mut model = model(0.1);
    let mut steel = elastic(200e9, 7800.0);
    steel.parameters.insert("poisson".into(), 0.3);
    model.materials.insert("soft".into(), steel);
    model.run.relaxation = Some(Relaxation { tolerance: 1e-22, from: 1e-3 });
    let (thickness, load) = (2e-3, 1000.0);
    for (name, x, z) in [("a", 0.0, 0.0), ("b", 0.04, thickness)] {
        let strip = Rectangle { corner: [x, 0.0], size: [0.06, 0.02], elements: [12, 4], ..Rectangle::default() };
        let strip = part(&mut model, name, "shell4", Shape::Rectangle(strip));
        model.parts[strip].section = Some(ShellSection { thickness, points: 2, ..ShellSection::default() });
        model.parts[strip].placement.translation = [0.0, 0.0, z];
    }
    fix(&mut model, "a.left", [true, true, true, true]);
    fix(&mut model, "b.right", [false, true, true, true]);
    let curve = ramp(&mut model, 1e-3);
    model.loads.push(Load::Force { on: "b.right".into(), force: [load, 0.0, 0.0], curve });
    model.joints.push(Joint {
        name: "spot".into(),
        between: vec!["a.upper".into(), "b.lower".into()],
        kind: "fixed".into(),
        at: [0.05, 0.01, 0.5 * thickness],
        radius: Some(7.2e-3),
        ..Joint::default()
    });
    model.probes.push(Probe { name: "left".into(), at: ProbeAt::Set { set: "a.left".into() }, ..Probe::default() });
    let simulation = to_end(&model);
    let of = |column: &str| value(&simulation, &format!("joint.{column}[spot]"));
    let (force, moment) = (["force_x", "force_y", "force_z"].map(of), ["moment_x", "moment_y", "moment_z"].map(of));
    // On the second strip it pulls back.
    assert!((force[0] / -load - 1.0).abs() < 1e-9, "{force:?}");
    assert!(force[1].abs() < 1e-9 * load, "{force:?}");
    assert!(moment.iter().all(|moment| moment.abs() < 1e-3 * load * 0.5 * thickness), "{moment:?}");
    assert!(of("gap") < 1e-14, "{}", of("gap"));
}

#[test]
fn a_weld_fails_at_its_force_across_and_along_and_leaves_the_ledger_closed() {
    for (axis, key) in [(0, "normal_force"), (1, "shear_force")] {
        let mut model = model(2.0);
        model.materials.insert("soft".into(), elastic(1e6, 1000.0));
        part(&mut model, "one", "quad4", rectangle([0.0, 0.0], [0.4, 0.4], [4, 4]));
        part(&mut model, "two", "quad4", rectangle([0.4, 0.0], [0.4, 0.4], [4, 4]));
        fix(&mut model, "one.left", [true, true, false, false]);
        // Without rotation it is pulled along, so that shear has no moment.
        fix(&mut model, "two.right", [axis == 1, axis == 0, false, false]);
        let curve = ramp(&mut model, 2.0);
        let mut force = [0.0; 3];
        force[axis] = 20.0;
        model.loads.push(Load::Force { on: "two.right".into(), force, curve });
        model.loads.push(Load::Damping { parts: vec![], rate: 30.0, active: [0.0, f64::INFINITY] });
        let mut weld =
            Weld { name: "spot".into(), between: ["one.right".into(), "two.left".into()], at: vec![[0.4, 0.2, 0.0]], ..Weld::default() };
        weld.radius = Some(0.25);
        if axis == 0 {
            weld.normal_strength = Some(10.0);
        } else {
            weld.shear_strength = Some(10.0);
        }
        model.welds.push(weld);
        let (mut simulation, mut before, mut failed) = (simulation(&model), 0.0, None);
        while simulation.advance(f64::INFINITY, 1).is_ok() && simulation.time() < 2.0 {
            let intact = value(&simulation, "weld.intact[spot]");
            if intact == 0.0 && failed.is_none() {
                failed = Some(before);
            }
            before = value(&simulation, &format!("weld.{key}[spot]"));
        }
        let failed = failed.unwrap();
        assert!((9.9..10.0).contains(&failed), "{key}: {failed}");
        assert_eq!(before, 0.0);
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
        assert!(summary.warnings.iter().any(|warning| warning.text.contains("\"spot\" failed")), "{:?}", summary.warnings);
        continues(key, &model, 400);
    }
}

#[test]
fn a_door_swings_about_its_leaning_hinge_with_the_period_of_a_pendulum() {
    // T = 2π √(I / m d g sin α) (1 + φ²/16).
    let (width, breadth, alpha, phi, g) = (0.8, 0.04, 0.3_f64, 0.1_f64, 9.81);
    let n = 4;
    let mut model = model(5.0);
    model.materials.insert("soft".into(), elastic(1e7, 1000.0));
    let door = part(&mut model, "door", "hex8", cuboid([0.0, -0.5 * breadth, 0.0], [width, breadth, 2.0], [n, 1, 2]));
    model.parts[door].rigid = Some(Motion::default());
    let acceleration = [g * alpha.sin() * phi.cos(), g * alpha.sin() * phi.sin(), -g * alpha.cos()];
    model.loads.push(Load::Gravity { parts: vec![], acceleration, curve: None });
    model.run.time_step = Some(2e-4);
    model.joints.push(Joint {
        name: "hinge".into(),
        between: vec!["door".into()],
        kind: "revolute".into(),
        at: [0.0, 0.0, 1.0],
        ..Joint::default()
    });
    model.probes.push(Probe {
        name: "edge".into(),
        at: ProbeAt::Point { part: "door".into(), point: [width, 0.5 * breadth, 0.0] },
        ..Probe::default()
    });
    // With the masses of the nodes: per mass width²/3 + (width/n)²/6, (breadth/2)².
    let inertia = width * width / 3.0 + (width / n as f64).powi(2) / 6.0 + 0.25 * breadth * breadth;
    let period = TAU * (inertia / (0.5 * width * g * alpha.sin())).sqrt() * (1.0 + phi * phi / 16.0);
    let (mut simulation, mut crossings, mut old) = (simulation(&model), Vec::new(), [0.0; 2]);
    let middle = phi;
    while simulation.time() < 5.0 {
        simulation.advance(f64::INFINITY, 5).unwrap();
        let [x, y] = ["edge.x", "edge.y"].map(|column| value(&simulation, column));
        let now = [simulation.time(), y.atan2(x) - (0.5 * breadth).atan2(width) - middle];
        if old[1] * now[1] < 0.0 {
            crossings.push(old[0] - old[1] * (now[0] - old[0]) / (now[1] - old[1]));
        }
        old = now;
    }
    let found = 2.0 * (crossings.last().unwrap() - crossings[0]) / (crossings.len() - 1) as f64;
    assert!(crossings.len() > 2 && (found / period - 1.0).abs() < 2e-5, "{found} for {period}: {crossings:?}");
    assert!(value(&simulation, "joint.gap[hinge]") < 1e-7);
}

/// Two rigid plates, the first of them hung up, the second at its end.
fn pendulum(dimension: usize) -> Model {
    let mut model = model(2.0);
    model.run.time_step = Some(1e-4);
    model.materials.insert("soft".into(), elastic(1e9, 1000.0));
    if dimension == 2 {
        part(&mut model, "one", "quad4", rectangle([0.0, -0.05], [1.0, 0.1], [10, 1]));
        part(&mut model, "two", "quad4", rectangle([1.0, -0.15], [1.0, 0.1], [10, 1]));
    } else {
        part(&mut model, "one", "hex8", cuboid([0.0; 3], [1.0, 0.5, 0.1], [8, 4, 1]));
        part(&mut model, "two", "hex8", cuboid([1.1, 0.0, 0.0], [1.0, 0.5, 0.1], [8, 4, 1]));
    }
    model.parts.iter_mut().for_each(|part| part.rigid = Some(Motion::default()));
    let down = if dimension == 2 { [0.0, -9.81, 0.0] } else { [0.0, 0.0, -9.81] };
    model.loads.push(Load::Gravity { parts: vec![], acceleration: down, curve: None });
    let hung = Joint { name: "top".into(), between: vec!["one".into()], kind: "spherical".into(), ..Joint::default() };
    let elbow = Joint { name: "elbow".into(), between: vec!["one".into(), "two".into()], kind: "revolute".into(), ..Joint::default() };
    if dimension == 2 {
        model.joints = vec![hung, Joint { at: [1.0, -0.05, 0.0], ..elbow }];
    } else {
        model.joints = vec![Joint { at: [0.0, 0.0, 0.05], ..hung }, Joint { at: [1.05, 0.25, 0.05], axis: [0.3, 1.0, 0.2], ..elbow }];
    }
    model
}

#[test]
fn a_double_pendulum_of_rigid_plates_keeps_its_energy_and_its_joints_closed() {
    for dimension in [2, 3] {
        let mut simulation = simulation(&pendulum(dimension));
        let (mut gap, mut off, mut kinetic) = (0.0_f64, 0.0_f64, 0.0_f64);
        let end = if is_long() { 2.0 } else { 1.0 };
        while simulation.time() < end {
            simulation.advance(f64::INFINITY, 200).unwrap();
            gap = gap.max(value(&simulation, "joint.gap[top]")).max(value(&simulation, "joint.gap[elbow]"));
            // What the joints took counts as damping.
            off = off.max((value(&simulation, "energy.total") - value(&simulation, "energy.contact_damping")).abs());
            kinetic = kinetic.max(value(&simulation, "energy.kinetic"));
        }
        assert!(kinetic > 100.0 && off < 1e-5 * kinetic, "{dimension}D: {off:e} of {kinetic:e}");
        assert!(gap < 1e-6, "{dimension}D: {gap:e}");
    }
}

#[test]
fn rigid_bodies_that_are_joined_fly_with_their_momenta() {
    for kind in ["spherical", "revolute", "cylindrical", "translational", "fixed"] {
        let mut model = pendulum(3);
        model.run.end = 0.2;
        model.loads.clear();
        model.joints.remove(0);
        model.joints[0].kind = kind.into();
        (model.parts[0].velocity, model.parts[0].spin) = ([1.0, 2.0, 3.0], 5.0);
        model.parts[1].spin = -3.0;
        let simulation = to_end(&model);
        let summary = simulation.summary();
        let momenta = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
        assert!(momenta.iter().all(|drift| *drift < 1e-12), "{kind}: {momenta:?}");
        assert!(summary.ledger_residual < 1e-12, "{kind}: {:e}", summary.ledger_residual);
    }
}

#[test]
fn the_end_of_a_beam_that_is_welded_to_a_block_is_clamped() {
    let (length, young) = (1.0_f64, 2e6);
    let mut model = slender(12.0, young, 100.0);
    model.run.relaxation = Some(Relaxation { tolerance: 1e-14, from: 4.0 });
    let block = part(&mut model, "block", "hex8", cuboid([-0.2, -0.1, -0.1], [0.2, 0.2, 0.2], [2, 2, 2]));
    let still = || Some(0.0.into());
    model.parts[block].rigid = Some(Motion { velocity: [still(), still(), still()], spin: still() });
    let beam =
        part(&mut model, "beam", "beam2", Shape::SpaceTruss(SpaceTruss { lines: vec![vec![[0.0; 3], [length, 0.0, 0.0]]], elements: 8 }));
    model.parts[beam].profile = Some(Profile { shape: "rectangle".into(), width: Some(0.06), height: Some(0.1), ..Profile::default() });
    model.welds.push(Weld { name: "foot".into(), between: ["block".into(), "beam.point0".into()], at: vec![[0.0; 3]], ..Weld::default() });
    let curve = ramp(&mut model, 4.0);
    let force = 1e-3;
    model.loads.push(Load::Force { on: "beam.point1".into(), force: [0.0, force, force], curve });
    model.probes.push(Probe { name: "tip".into(), at: ProbeAt::Set { set: "beam.point1".into() }, ..Probe::default() });
    let simulation = to_end(&model);
    let area = 0.06 * 0.1;
    let deflection = |inertia: f64| force * length.powi(3) / (3.0 * young * inertia) + force * length / (5.0 / 6.0 * 0.5 * young * area);
    let inertias = [0.06 * 0.1_f64.powi(3) / 12.0, 0.1 * 0.06_f64.powi(3) / 12.0].map(deflection);
    let mut found = ["tip.y", "tip.z"].map(|column| value(&simulation, column));
    found.sort_by(f64::total_cmp);
    // The chord element of eight pieces: 1 − 1/(4 n²).
    assert!((0..2).all(|k| (found[k] / inertias[k] - 1.0).abs() < 6e-3), "{found:?} for {inertias:?}");
    let moment = value(&simulation, "weld.moment[foot]");
    assert!((moment / (force * 2.0_f64.sqrt() * length) - 1.0).abs() < 1e-4, "{moment}");
}

#[test]
fn welds_and_joints_that_can_not_be_are_refused() {
    let found = |change: &dyn Fn(&mut Model)| {
        let mut model = model(1.0);
        part(&mut model, "one", "quad4", rectangle([0.0, 0.0], [0.4, 0.4], [4, 4]));
        part(&mut model, "two", "quad4", rectangle([0.4, 0.0], [0.4, 0.4], [4, 4]));
        let between = ["one.right".to_string(), "two.left".to_string()];
        model.welds.push(Weld { name: "spot".into(), between: between.clone(), at: vec![[0.4, 0.2, 0.0]], ..Weld::default() });
        model.joints.push(Joint {
            name: "pin".into(),
            between: between.to_vec(),
            kind: "revolute".into(),
            at: [0.4, 0.3, 0.0],
            ..Joint::default()
        });
        change(&mut model);
        faults(&model)
    };
    assert_eq!(found(&|_| {}), Vec::<String>::new());
    type Case<'a> = (&'a dyn Fn(&mut Model), &'a str);
    let cases: [Case; 12] = [
        (&|model| model.welds[0].at = vec![], "weld[0].at"),
        (&|model| model.welds[0].at = vec![[0.4, 0.2, 0.1]], "weld[0].at[0]"),
        (&|model| model.welds[0].at = vec![[4.0, 0.2, 0.0]], "weld[0].at[0]"),
        (&|model| model.welds[0].radius = Some(1e-3), "weld[0].radius"),
        (&|model| model.welds[0].between[1] = "one.right".into(), "weld[0].between"),
        (&|model| model.welds[0].between[1] = "one".into(), "weld[0].between"),
        (&|model| model.welds[0].between[1] = "three".into(), "weld[0].between[1]"),
        (&|model| model.welds[0].exponents = vec![1.0, 2.0], "weld[0].exponents"),
        (&|model| model.welds[0].normal = Some([0.0; 3]), "weld[0].normal"),
        (&|model| model.joints[0].kind = "cylindrical".into(), "joint[0].kind"),
        (&|model| model.joints[0].kind = "ball".into(), "joint[0].kind"),
        (&|model| model.joints[0].between = vec![], "joint[0].between"),
    ];
    for (change, path) in cases {
        let faults = found(change);
        assert!(faults.iter().any(|fault| fault.starts_with(path)), "{path}: {faults:?}");
    }
}
