//! Examples in which elements are made again in the run.

use super::*;

#[test]
fn a_copper_rod_at_340_metres_per_second_is_less_than_half_as_long_after_its_impact() {
    let results = run("taylor-bar-fast", "example-taylor-bar-fast");
    results.is_sound(1e-3);
    is_near(*results.column("tail.y").last().unwrap(), 13.82e-3, 0.14e-3);
    is_near(results.mean("tail.y", 34.7e-6, 35.3e-6), 21.415e-3, 0.021e-3);
    assert!(results.summary["remeshings"].as_array().unwrap().len() >= 3, "{}", results.summary["remeshings"]);
    assert!(results.column("energy.remap").last().unwrap().abs() < 0.01 * 535.0);
}

#[test]
fn a_billet_between_rough_dies_takes_the_force_that_it_takes_without_new_elements() {
    let results = run("billet", "example-billet");
    results.is_sound(1e-3);
    let die = "obstacle.force_y[die]";
    for (millimetres, force) in [(1.0, 247.3e3), (2.0, 274.9e3), (3.0, 305.6e3), (4.0, 339.7e3)] {
        let time = 10e-6 + millimetres * 50e-6;
        is_near(-results.mean(die, time - 5e-6, time + 5e-6), force, 0.015 * force);
    }
    let force = -results.mean(die, 450e-6, 460e-6);
    assert!((749e3..1120e3).contains(&force), "{force}");
    is_near(*results.column("belly.x").last().unwrap(), 16.50e-3, 0.08e-3);
    let work = *results.column("energy.external").last().unwrap();
    is_near(work, 3698.0, 37.0);
    assert!(results.column("energy.remap").last().unwrap().abs() < 0.01 * work);
    assert!(!results.summary["remeshings"].as_array().unwrap().is_empty());
}

#[test]
fn friction_closes_the_hole_of_a_flat_ring() {
    let results = run("ring-compression", "example-ring-compression");
    results.is_sound(1e-3);
    is_near(*results.column("middle.x").last().unwrap(), 2.27e-3, 0.06e-3);
    let force = -results.mean("obstacle.force_y[die]", 205e-6, 210e-6);
    assert!((83.8e3..112.8e3).contains(&force), "{force}");
    let [kinetic, internal, work, remap] =
        ["energy.kinetic", "energy.internal", "energy.external", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    assert!(kinetic < 0.005 * internal && remap.abs() < 0.01 * work, "{kinetic} {internal} {work} {remap}");
}
