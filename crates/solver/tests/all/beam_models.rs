//! Models of beams that touch: on obstacles, solids, shells and each other, by the outline of their section;
//! both momenta, ledgers, frames that begin without contact, erosion, equal bits.

use crate::beams::{beams, rectangle, round, shape};
use crate::bodies::*;
use crate::sheet_models::steel;
use crate::shells::section;
use crate::solids::Vector;
use embate_solver::model::{
    Contact, Cuboid, Drive, Image, Interface, Join, Load, Model, Motion, Obstacle, Partners, Placement, Probe, ProbeAt, Profile, Rectangle,
    Shape, SpaceTruss, Symmetry,
};
use embate_solver::simulation::Simulation;
use std::f64::consts::PI;

/// Beams and their contact.
fn rod(model: &mut Model, name: &str, line: Vec<Vector>, elements: usize, profile: Profile, velocity: Vector) {
    beams(model, name, line, elements, profile);
    model.parts.last_mut().unwrap().velocity = velocity;
    model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: name.into() }, ..Probe::default() });
}

fn all_touch(model: &mut Model, friction: f64) {
    model.contacts.push(Contact {
        name: "all".into(),
        partners: Partners::Bodies(Vec::new()),
        interface: if friction > 0.0 { rough(friction) } else { Interface::default() },
        ..Contact::default()
    });
}

fn block(model: &mut Model, name: &str, corner: Vector, size: Vector, elements: [usize; 3], velocity: Vector) {
    add(model, name, Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() }), [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.velocity) = ("hex8".into(), velocity);
}

fn place(simulation: &Simulation, name: &str) -> Vector {
    ["x", "y", "z"].map(|axis| value(simulation, &format!("{name}.{axis}")))
}

fn is_sound(simulation: &Simulation, case: &str) {
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12, "{case}: ledger {:e}", summary.ledger_residual);
    assert_eq!(summary.contact.unverified, 0, "{case}");
    if let (Some(linear), Some(angular)) = (summary.momentum_drift_linear, summary.momentum_drift_angular) {
        assert!(linear < 1e-12 && angular < 1e-12, "{case}: {linear:e} {angular:e}");
    }
}

fn keeps_momenta(simulation: &Simulation, case: &str) {
    is_sound(simulation, case);
    assert!(simulation.summary().momentum_drift_angular.is_some(), "{case} is not isolated");
}

#[test]
fn a_rod_that_falls_flat_on_a_plane_touches_with_its_radius_and_rebounds() {
    let (radius, gap, speed) = (0.01, 2e-4, 5.0);
    // Corners of the polygon are below: those of the others are so, too, and the box.
    let tube = Profile { diameter: Some(2.0 * radius), thickness: Some(0.002), ..shape("tube") };
    let high = Profile { width: Some(0.01), height: Some(2.0 * radius), thickness: Some(0.001), ..shape("box") };
    let i = Profile { width: Some(0.015), height: Some(2.0 * radius), web: Some(0.002), flange: Some(0.003), ..shape("i") };
    for profile in [round(2.0 * radius), tube, high, i, rectangle(0.03, 2.0 * radius)] {
        let mut model = model(4e-4);
        rod(&mut model, "rod", vec![[-0.1, 0.0, radius + gap], [0.1, 0.0, radius + gap]], 10, profile.clone(), [0.0, 0.0, -speed]);
        model.obstacles.push(Obstacle::wall("floor", [0.0; 3], [0.0, 0.0, 1.0]));
        let steps = every_step(&model);
        let (times, energies) = (steps.column("time"), steps.column("obstacle.energy[floor]"));
        let first = energies.iter().position(|energy| *energy > 0.0).unwrap();
        let at = gap / speed;
        // Springs of obstacles act in the step in which they close.
        assert!(times[first] <= at * (1.0 + 1e-9) && times[first + 1] > at * (1.0 - 1e-9), "{}: {}", profile.shape, times[first]);
        let change = steps.masses[0] * steps.change("rod.vz");
        let impulse = steps.impulse("obstacle.force_z[floor]").abs();
        let simulation = to_end(&model);
        println!("{}: {} rebounds, impulse {impulse} for {change}", profile.shape, value(&simulation, "rod.vz"));
        assert!((impulse / change - 1.0).abs() < 1e-12, "{}: {impulse} {change}", profile.shape);
        assert!(value(&simulation, "rod.vz") > 0.9 * speed, "{}: {}", profile.shape, value(&simulation, "rod.vz"));
        assert!(simulation.summary().energy_drift < 5e-3, "{}: {:e}", profile.shape, simulation.summary().energy_drift);
        is_sound(&simulation, &profile.shape);
    }
}

#[test]
fn a_rod_that_falls_on_a_block_keeps_the_momenta_of_both() {
    let mut model = model(6e-4);
    block(&mut model, "block", [-0.06, -0.03, -0.03], [0.12, 0.06, 0.03], [6, 4, 2], [0.0; 3]);
    rod(&mut model, "rod", vec![[-0.1, 0.003, 0.0102], [0.1, 0.01, 0.0102]], 10, round(0.02), [0.0, 0.0, -5.0]);
    all_touch(&mut model, 0.3);
    let (simulation, history) = run(&model);
    keeps_momenta(&simulation, "block");
    println!("rod {} block {}", value(&simulation, "rod.vz"), value(&simulation, "block.vz"));
    assert!(history.largest("contact.energy[all]") > 0.0);
    assert!(value(&simulation, "block.vz") < -0.5 && value(&simulation, "rod.vz") > value(&simulation, "block.vz") + 1.0);
    assert!(simulation.summary().energy_drift < 5e-3, "{:e}", simulation.summary().energy_drift);
}

/// Two round rods that cross at an angle, the upper one turned about its own axis.
fn crossed(end: f64, radius: f64, gap: f64, speed: f64, [offset, roll]: [f64; 2], friction: f64) -> Model {
    let mut model = model(end);
    rod(&mut model, "lower", vec![[-0.1, 0.0, 0.0], [0.1, 0.0, 0.0]], 9, round(2.0 * radius), [0.0, 0.0, speed]);
    let high = 2.0 * radius + gap;
    let up = Some([roll.sin(), 0.0, roll.cos()]);
    rod(&mut model, "upper", vec![[offset, -0.1, high], [offset, 0.1, high]], 9, Profile { up, ..round(2.0 * radius) }, [0.0, 0.0, -speed]);
    all_touch(&mut model, friction);
    model
}

#[test]
fn crossed_rods_touch_where_the_sum_of_their_radii_says_and_exchange_their_momenta() {
    let (radius, gap, speed) = (0.01, 1e-3, 2.0);
    // Corner on corner, and side on side of both polygons.
    let side = radius * (1.0 - (PI / 12.0).cos());
    for (roll, nearer) in [(0.0, 0.0), (PI / 12.0, side)] {
        let model = crossed(1.5e-3, radius, gap, speed, [0.0, roll], 0.0);
        let steps = every_step(&model);
        let (times, energy) = (steps.column("time"), steps.column("contact.energy[all]"));
        let first = energy.iter().position(|energy| *energy > 0.0).unwrap();
        let at = (gap + nearer) / (2.0 * speed);
        assert!(times[first - 1] <= at * (1.0 + 1e-9) && times[first] > at * (1.0 - 1e-9), "{roll}: {} {at}", times[first]);
        let simulation = to_end(&model);
        let [lower, upper] = ["lower.vz", "upper.vz"].map(|column| value(&simulation, column));
        println!("{roll}: {lower} {upper}");
        assert!((lower + upper).abs() < 1e-9 && upper > 0.5, "{lower} {upper}");
        keeps_momenta(&simulation, "crossed");
        assert!(simulation.summary().energy_drift < 5e-3, "{:e}", simulation.summary().energy_drift);
    }
}

#[test]
fn an_offset_impact_with_friction_keeps_the_angular_momentum() {
    let mut model = crossed(1.5e-3, 0.01, 1e-3, 4.0, [0.06, 0.1], 0.4);
    model.parts[1].velocity = [3.0, 4.0, -4.0];
    let (simulation, history) = run(&model);
    assert!(history.last("contact.friction_work[all]") > 0.0);
    keeps_momenta(&simulation, "offset");
}

#[test]
fn a_thin_fast_rod_is_not_missed() {
    // 2 mm thick, 200 m/s: elements of 100 mm have steps of two diameters.
    for (sideways, roll) in [(0.013, 0.2), (0.021, 0.1), (0.05, 0.0), (0.085, 0.3)] {
        let mut model = crossed(5e-4, 1e-3, 5e-3, 100.0, [sideways, roll], 0.0);
        model.materials = steel(1.0, 1e12).materials;
        model.parts[0].shape = Shape::SpaceTruss(SpaceTruss { lines: vec![vec![[-0.1, 0.0, 0.0], [0.1, 0.0, 0.0]]], elements: 2 });
        let (simulation, _) = run(&model);
        let [lower, upper] = ["lower.vz", "upper.vz"].map(|column| value(&simulation, column));
        println!("{sideways}: {lower} {upper} of {:?}", simulation.summary().contact);
        assert!(lower < 70.0 && (lower + upper).abs() < 1e-9, "{lower} {upper}");
        keeps_momenta(&simulation, "fast");
        assert!(simulation.summary().energy_drift < 1e-2, "{:e}", simulation.summary().energy_drift);
    }
}

/// A cube's frame with diagonals and a bent foot.
fn frame() -> Vec<Vec<Vector>> {
    let at = |k: usize| [0, 1, 2].map(|d| 0.4 * ((k >> d & 1) as f64) - 0.2);
    let mut lines: Vec<Vec<Vector>> = Vec::new();
    for k in 0..8usize {
        lines.extend([1, 2, 4].into_iter().filter(|bit| k & bit == 0).map(|bit| vec![at(k), at(k | bit)]));
    }
    lines.push(vec![at(0), at(3)]);
    lines.push(vec![at(0), at(7)]);
    lines.push(vec![at(7), [0.45, 0.3, 0.5], [0.2, 0.7, 0.5]]);
    lines
}

#[test]
fn a_frame_with_joints_begins_and_moves_without_contact_within_itself() {
    let square = Profile { width: Some(0.03), height: Some(0.03), thickness: Some(0.003), ..shape("box") };
    let flat = rectangle(0.08, 0.01);
    for (profile, elements) in [(round(0.04), 4), (round(0.04), 14), (square, 6), (flat, 5)] {
        let mut model = steel(2e-3, 1e12);
        let name = profile.shape.clone();
        rod(&mut model, "frame", vec![], elements, profile, [1.0, 2.0, -3.0]);
        model.parts[0].shape = Shape::SpaceTruss(SpaceTruss { lines: frame(), elements });
        model.parts[0].spin = 60.0;
        all_touch(&mut model, 0.2);
        let (simulation, history) = run(&model);
        assert_eq!(history.largest("contact.energy[all]"), 0.0, "{name} {elements}");
        keeps_momenta(&simulation, &name);
    }
}

#[test]
fn parts_joined_at_a_point_begin_without_contact() {
    let mut model = steel(2e-4, 1e12);
    rod(&mut model, "post", vec![[0.0; 3], [0.0, 0.0, 0.3]], 6, round(0.03), [0.0; 3]);
    rod(&mut model, "arm", vec![[0.0, 0.0, 0.3], [0.3, 0.0, 0.3]], 6, round(0.02), [0.0; 3]);
    model.joins.push(Join { between: ["post.point1".into(), "arm.point0".into()], image: Image::Same, tolerance: None });
    all_touch(&mut model, 0.0);
    let (simulation, history) = run(&model);
    assert_eq!(history.largest("contact.energy[all]"), 0.0);
    is_sound(&simulation, "joined");
}

#[test]
fn turns_of_a_coil_meet_each_other() {
    // Six turns, pressed together: the pitch is 1.6 diameters.
    let (diameter, mean, per_turn, turns) = (0.004, 0.02, 20, 4);
    let at = |k: usize| {
        let angle = 2.0 * PI * k as f64 / per_turn as f64;
        [mean * angle.cos(), mean * angle.sin(), 1.6 * diameter * k as f64 / per_turn as f64]
    };
    let mut model = steel(0.65e-3, 1e12);
    rod(&mut model, "coil", (0..=per_turn * turns).map(at).collect(), 1, round(diameter), [0.0; 3]);
    // Two places of the middle turns that are above each other.
    for (name, node) in [("one", 35), ("other", 55)] {
        model.probes.push(Probe { name: name.into(), at: ProbeAt::Node { part: "coil".into(), node }, ..Probe::default() });
    }
    all_touch(&mut model, 0.1);
    let height = 1.6 * diameter * turns as f64;
    for (name, z, velocity) in [("lower", -0.004, 0.0), ("upper", height + 0.0021, -15.0)] {
        block(&mut model, name, [-0.03, -0.03, z], [0.06, 0.06, 0.0018], [3, 3, 1], [0.0, 0.0, velocity]);
        let driven = |speed: f64| Some(Drive::from(speed));
        let velocity = [driven(0.0), driven(0.0), driven(velocity)];
        stiffen(&mut model, name, Motion { velocity, spin: driven(0.0) });
    }
    let (simulation, history) = run(&model);
    let apart: Vec<f64> = history.column("other.z").iter().zip(history.column("one.z")).map(|(above, below)| above - below).collect();
    let least = apart.iter().copied().fold(f64::INFINITY, f64::min) / diameter;
    println!("least {least} diameters, energy {}", history.largest("contact.energy[all]"));
    // They come on each other, no nearer than the polygons let them, and are held there.
    assert!((0.93..1.1).contains(&least), "{least}");
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12 && summary.penetration_max < diameter / 10.0, "{summary:?}");
}

/// A block, a sheet and three beams that hit each other.
fn crash(end: f64) -> Model {
    let mut model = steel(end, 300e6);
    block(&mut model, "block", [-0.02, -0.02, -0.05], [0.04, 0.04, 0.02], [3, 3, 2], [0.0, 0.0, 20.0]);
    add(
        &mut model,
        "sheet",
        Shape::Rectangle(Rectangle { corner: [-0.05; 2], size: [0.1; 2], elements: [8; 2], ..Rectangle::default() }),
        [0.0; 2],
    );
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section) = ("shell4".into(), Some(section(0.002)));
    part.placement = Placement { translation: [0.0, 0.0, -0.005], ..Placement::default() };
    rod(&mut model, "tee", vec![], 4, round(0.008), [0.0, 5.0, -30.0]);
    let lines = vec![vec![[-0.06, 0.0, 0.002], [0.0, 0.002, 0.002], [0.06, 0.0, 0.002]], vec![[0.0, 0.002, 0.002], [0.0, 0.05, 0.01]]];
    model.parts[2].shape = Shape::SpaceTruss(SpaceTruss { lines, elements: 4 });
    rod(&mut model, "bar", vec![[0.01, -0.05, 0.012], [0.02, 0.05, 0.016]], 8, rectangle(0.006, 0.008), [0.0, 0.0, -60.0]);
    all_touch(&mut model, 0.3);
    model
}

#[test]
fn solids_shells_and_beams_hit_each_other_with_equal_bits_and_continue_where_they_were_kept() {
    let model = crash(2e-4);
    let (simulation, history) = run(&model);
    assert!(history.largest("contact.energy[all]") > 0.0 && history.last("energy.plastic") > 0.1);
    keeps_momenta(&simulation, "crash");
    assert!(simulation.summary().energy_drift < 5e-3, "{:e}", simulation.summary().energy_drift);
    let hash = hash_of_equal_bits(&model, &[1, 2], "crash");
    let mut half = crate::bodies::simulation(&model);
    half.advance(0.9e-4, u64::MAX).unwrap();
    continues_to(&hash, &model, &mut half, "crash");
}

#[test]
fn beams_that_break_leave_contact() {
    let mut model = crash(2e-4);
    model.materials.get_mut("soft").unwrap().failure.insert("plastic_strain".into(), 0.004);
    let (simulation, _) = run(&model);
    let summary = simulation.summary();
    assert!(summary.erosion.is_some(), "nothing broke");
    assert!(summary.ledger_residual < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    let hash = hash_of_equal_bits(&model, &[1, 2], "broken");
    let mut half = crate::bodies::simulation(&model);
    half.advance(1.2e-4, u64::MAX).unwrap();
    continues_to(&hash, &model, &mut half, "broken");
    // A rod between two others that fall: once it has broken, nothing holds these apart.
    let mut model = steel(4e-3, 300e6);
    let mut weak = model.materials["soft"].clone();
    weak.failure.insert("plastic_strain".into(), 1e-3);
    model.materials.insert("weak".into(), weak);
    rod(&mut model, "between", vec![[0.0, -0.03, 0.0], [0.0, 0.03, 0.0]], 6, round(0.004), [0.0; 3]);
    model.parts[0].material = "weak".into();
    for (name, y, z, v) in [("below", -0.02, -0.03, 40.0), ("above", 0.02, 0.03, -40.0)] {
        rod(&mut model, name, vec![[-0.05, y, z], [0.05, y, z]], 8, round(0.02), [0.0, 0.0, v]);
    }
    all_touch(&mut model, 0.0);
    let (simulation, history) = run(&model);
    let [below, above] = ["below", "above"].map(|name| place(&simulation, name)[2]);
    println!("{below} {above} at {:?}", simulation.summary().erosion);
    assert!(simulation.summary().erosion.is_some() && history.largest("contact.energy[all]") > 0.0 && below > above + 0.04);
    assert!(simulation.summary().ledger_residual < 1e-12);
}

#[test]
fn a_rod_pierces_a_sheet_and_is_stopped_by_a_rigid_block() {
    let mut model = steel(4e-4, 300e6);
    let mut weak = model.materials["soft"].clone();
    weak.failure.insert("plastic_strain".into(), 0.1);
    model.materials.insert("weak".into(), weak);
    add(
        &mut model,
        "sheet",
        Shape::Rectangle(Rectangle { corner: [-0.03; 2], size: [0.06; 2], elements: [10; 2], ..Rectangle::default() }),
        [0.0; 2],
    );
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section, part.material) = ("shell4".into(), Some(section(0.001)), "weak".into());
    block(&mut model, "wall", [-0.03, -0.03, -0.06], [0.06, 0.06, 0.01], [2, 2, 1], [0.0; 3]);
    let still = || Some(Drive::from(0.0));
    stiffen(&mut model, "wall", Motion { velocity: [still(), still(), still()], spin: still() });
    rod(&mut model, "rod", vec![[0.001, 0.001, 0.002], [0.001, 0.001, 0.082]], 8, round(0.01), [0.0, 0.0, -250.0]);
    model.probes.push(Probe { name: "tip".into(), at: ProbeAt::Set { set: "rod.point0".into() }, ..Probe::default() });
    all_touch(&mut model, 0.1);
    let (simulation, history) = run(&model);
    let z = history.column("rod.z").into_iter().fold(f64::INFINITY, f64::min);
    let tip = history.column("tip.z").into_iter().fold(f64::INFINITY, f64::min);
    println!("rod's middle came to {z}, its tip to {tip}");
    assert!(simulation.summary().erosion.is_some() && z < 0.0 && tip < -0.045 && tip > -0.051, "{z} {tip}");
    assert!(simulation.summary().ledger_residual < 1e-12);
}

#[test]
fn half_of_a_rod_at_a_symmetry_plane_moves_as_the_whole() {
    let fall = |whole: bool| {
        let mut model = model(3e-4);
        let from = if whole { -0.1 } else { 0.0 };
        rod(&mut model, "rod", vec![[from, 0.0, 0.0101], [0.1, 0.0, 0.0101]], if whole { 10 } else { 5 }, round(0.02), [0.0, 0.0, -5.0]);
        model.obstacles.push(Obstacle::wall("floor", [0.0; 3], [0.0, 0.0, 1.0]));
        model.probes.push(Probe {
            name: "end".into(),
            at: ProbeAt::Point { part: "rod".into(), point: [0.1, 0.0, 0.0201] },
            ..Probe::default()
        });
        if !whole {
            model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], point: [0.0; 3], parts: Vec::new(), name: String::new() });
        }
        let simulation = to_end(&model);
        is_sound(&simulation, "half");
        value(&simulation, "end.z")
    };
    let [whole, half] = [fall(true), fall(false)];
    assert!((whole - half).abs() < 1e-9, "{whole} {half}");
}

#[test]
fn a_rod_rolls_down_a_slope_as_its_inertia_says() {
    // A polygon of 64 corners rolls from corner to corner, by 5.6 degrees. The node rotates with α m about
    // its axis, α = max(I/A, µ J/(E A), l²/(4 (E/(k µ) − 1))): a solid cylinder's R²/2 for one length of
    // elements.
    let (radius, g, slope, poisson) = (0.01_f64, 10.0, 0.3_f64, 0.3);
    let shear = 6.0 / 7.0;
    let length = (2.0 * radius * radius * (2.0 * (1.0 + poisson) / shear - 1.0)).sqrt();
    let mut model = model(0.12);
    model.materials.insert("soft".into(), elastic(1e6, 1e3));
    let profile = Profile { corners: Some(64), ..round(2.0 * radius) };
    rod(&mut model, "rod", vec![[0.0, 0.0, radius], [4.0 * length, 0.0, radius]], 4, profile, [0.0; 3]);
    model.obstacles.push(Obstacle { interface: rough(0.5), ..Obstacle::wall("slope", [0.0; 3], [0.0, 0.0, 1.0]) });
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, g * slope.sin(), -g * slope.cos()], curve: None });
    let simulation = to_end(&model);
    let way = value(&simulation, "rod.y");
    let ideal = 0.5 * g * slope.sin() / 1.5 * 0.12 * 0.12;
    println!("length {length}: {way} of {ideal}, friction {}", value(&simulation, "obstacle.friction_work[slope]"));
    assert!((way / ideal - 1.0).abs() < 0.1, "{way} {ideal}");
    is_sound(&simulation, "roll");
}

#[test]
fn what_can_not_touch_is_reported() {
    let given = Profile { area: Some(1e-4), inertia_y: Some(1e-9), inertia_z: Some(1e-9), torsion: Some(1e-9), ..shape("given") };
    let mut bare = model(1e-4);
    rod(&mut bare, "mast", vec![[0.0; 3], [0.0, 0.0, 1.0]], 4, given, [0.0; 3]);
    all_touch(&mut bare, 0.0);
    let found = faults(&bare);
    assert!(found[0].contains("`given`"), "{found:?}");
    let mut many = model(1e-4);
    rod(&mut many, "mast", vec![[0.0; 3], [0.0, 0.0, 1.0]], 4, Profile { corners: Some(3), ..round(0.1) }, [0.0; 3]);
    assert!(faults(&many)[0].contains("4 to 64"), "{:?}", faults(&many));
    // A hairpin whose outline has no room.
    let mut tight = model(1e-4);
    let bend = (0..9).map(|k| [0.02 * (PI * k as f64 / 8.0).cos(), 0.02 * (PI * k as f64 / 8.0).sin(), 0.0]).collect();
    rod(&mut tight, "hook", bend, 1, round(0.08), [0.0; 3]);
    all_touch(&mut tight, 0.0);
    let found = faults(&tight);
    assert!(found.iter().any(|fault| fault.contains("too thick")), "{found:?}");
    tight.contacts.clear();
    assert!(faults(&tight).is_empty(), "{:?}", faults(&tight));
}
