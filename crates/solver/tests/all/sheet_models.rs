//! Models of shells in 3D: contact on their faces, both momenta, ledgers, rigid sheets, equal bits.

use crate::bodies::*;
use crate::patches::material;
use crate::shells::section;
use embate_solver::model::{Contact, Cylinder, Model, Motion, Partners, Placement, Rectangle, Shape, ShellSection};

/// A sheet or a skin of the material `soft`, moved to a place.
pub(crate) fn sheet(model: &mut Model, name: &str, shape: impl Into<Shape>, thickness: f64, translation: [f64; 3], velocity: [f64; 3]) {
    add(model, name, shape.into(), [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    part.element = "shell4".into();
    (part.section, part.velocity) = (Some(section(thickness)), velocity);
    part.placement = Placement { translation, ..Placement::default() };
}

pub(crate) fn square(size: f64, elements: usize) -> Rectangle {
    Rectangle { corner: [-0.5 * size; 2], size: [size; 2], elements: [elements; 2], ..Rectangle::default() }
}

/// Sheets of steel that flows.
pub(crate) fn steel(end: f64, yields: f64) -> Model {
    let mut model = model(end);
    let mut flows = material("j2", 0.3);
    for (name, value) in [("young", 200e9), ("density", 7800.0), ("yield", yields), ("hardening", 1e9)] {
        flows.parameters.insert(name.into(), value);
    }
    model.materials.insert("soft".into(), flows);
    model
}

pub(crate) fn all_touch(model: &mut Model, friction: f64) {
    model.contacts.push(Contact {
        name: "all".into(),
        partners: Partners::Bodies(Vec::new()),
        interface: rough(friction),
        ..Contact::default()
    });
}

/// Two sheets, one of them turned, and a pipe, which hit each other.
pub(crate) fn crash(end: f64, elements: usize) -> Model {
    let mut model = steel(end, 300e6);
    sheet(&mut model, "lower", square(0.1, elements), 0.002, [0.0; 3], [0.0; 3]);
    sheet(&mut model, "upper", square(0.06, elements), 0.001, [0.01, 0.005, 0.008], [30.0, 0.0, -60.0]);
    let turned = &mut model.parts[1].placement;
    (turned.rotation, turned.rotation_axis) = (0.1, [1.0, 0.3, 0.5]);
    let pipe = Cylinder {
        centre: [-0.04, 0.0, 0.0],
        axis: [1.0, 0.2, 0.1],
        radius: 0.01,
        length: 0.06,
        elements: [4, elements],
        ..Cylinder::default()
    };
    sheet(&mut model, "pipe", pipe, 0.001, [0.0, 0.0, -0.022], [0.0, 10.0, 80.0]);
    all_touch(&mut model, 0.3);
    model
}

#[test]
fn sheets_that_hit_each_other_with_friction_keep_both_momenta_and_the_ledger() {
    let (simulation, history) = run(&crash(3e-4, 8));
    let summary = simulation.summary();
    assert!(history.largest("contact.energy[all]") > 0.0 && history.last("energy.plastic") > 1.0);
    assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12, "{:?}", summary.momentum_drift_linear);
    assert!(summary.momentum_drift_angular.unwrap() < 1e-12, "{:?}", summary.momentum_drift_angular);
    assert!(summary.energy_drift < 5e-3, "{:e}", summary.energy_drift);
}

#[test]
fn sheets_that_flow_and_fail_have_equal_bits_and_continue_where_they_were_kept() {
    let mut model = crash(1.5e-4, 8);
    model.materials.get_mut("soft").unwrap().failure.insert("plastic_strain".into(), 0.03);
    model.parts[1].section = Some(ShellSection { points: 4, failed_points: 0.5, ..section(0.001) });
    let hash = hash_of_equal_bits(&model, &[1, 2], "sheets");
    let mut half = simulation(&model);
    half.advance(0.7e-4, u64::MAX).unwrap();
    continues_to(&hash, &model, &mut half, "sheets");
    let (simulation, history) = run(&model);
    assert!(history.last("energy.eroded") > 0.0);
    assert!(simulation.summary().ledger_residual < 1e-12 && simulation.summary().momentum_drift_angular.unwrap() < 1e-12);
}

#[test]
fn threads_and_instructions_change_no_bit_of_many_sheets() {
    let mut model = crash(1.0, 40);
    model.run.max_steps = Some(20);
    hash_of_equal_bits(&model, &[1, 2, 3], "many sheets");
}

#[test]
fn two_sheets_that_collide_flat_touch_at_their_thickness_and_swap_their_velocities() {
    let (thickness, gap) = (0.002, 0.001);
    let mut model = steel(2e-4, 300e6);
    sheet(&mut model, "lower", square(0.1, 8), thickness, [0.0; 3], [0.0, 0.0, 10.0]);
    sheet(&mut model, "upper", square(0.1, 8), thickness, [0.0, 0.0, thickness + gap], [0.0, 0.0, -10.0]);
    all_touch(&mut model, 0.0);
    let steps = every_step(&model);
    let (times, contact) = (steps.column("time"), steps.column("contact.energy[all]"));
    let first = contact.iter().position(|energy| *energy > 0.0).unwrap();
    // Half of the gap each.
    assert!(times[first - 1] <= 0.5 * gap / 10.0 * (1.0 + 1e-9) && times[first] > 0.5 * gap / 10.0 * (1.0 - 1e-9), "{}", times[first]);
    let simulation = to_end(&model);
    let [lower, upper] = ["lower.vz", "upper.vz"].map(|column| value(&simulation, column));
    assert!((lower + 10.0).abs() < 0.05 && (upper - 10.0).abs() < 0.05, "{lower} {upper}");
}

#[test]
fn a_rigid_sheet_carries_its_faces_along() {
    let mut model = steel(4e-4, 1e12);
    sheet(&mut model, "lower", square(0.1, 6), 0.002, [0.0; 3], [0.0; 3]);
    model.parts[0].rigid = Some(Motion::default());
    sheet(&mut model, "upper", square(0.1, 6), 0.002, [0.0, 0.0, 0.003], [0.0, 0.0, -10.0]);
    all_touch(&mut model, 0.0);
    let simulation = to_end(&model);
    let [lower, upper] = ["lower.vz", "upper.vz"].map(|column| value(&simulation, column));
    assert!((lower + upper + 10.0).abs() < 1e-9 && lower < -5.0 && upper > lower, "{lower} {upper}");
    let apart = value(&simulation, "upper.z") - value(&simulation, "lower.z");
    assert!(apart > 0.0019, "{apart}");
}
