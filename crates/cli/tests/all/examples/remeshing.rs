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

#[test]
fn a_mill_in_operation_needs_the_force_and_the_torque_of_a_strip_that_goes_through() {
    let results = run("rolling-mill", "example-rolling-mill");
    results.is_sound(1e-3);
    let end = *results.column("time").last().unwrap();
    assert!(end > 2e-3 && end < 8e-3, "it is steady at {end}");
    let flow = &results.summary["flows"][0];
    let of = |name: &str| flow[name].as_f64().unwrap();
    assert!(of("change") < 0.01 && of("steady") == end, "{flow}");
    // Those of `strip-rolling`, whose strip moves.
    let [force, torque] = ["obstacle.force_y[roll]", "obstacle.moment[roll]"].map(|name| results.mean(name, end - 1e-3, end));
    is_near(-force, 2.253e6, 0.02 * 2.253e6);
    is_near(torque, 10.46e3, 0.02 * 10.46e3);
    // Those of the slab theory.
    let pass = Pass { from: 4e-3, to: 2.8e-3, radius: 100e-3, mu: 0.15 };
    let [plastic, expected, slip] = pass.slab();
    let spring_back = (1.0 - 0.33 * 0.33) * pass.strength(0.0) / 70e9 * pass.to;
    let elastic = 2.0 / 3.0 * pass.strength(0.0) * (pass.radius * spring_back).sqrt();
    is_near(-force, plastic + elastic, 0.04 * (plastic + elastic));
    is_near(torque, expected, 0.03 * expected);
    let [fast, thin] = ["outlet.vx", "outlet.y"].map(|name| results.mean(name, end - 1e-3, end));
    is_near(fast / 20.0 - 1.0, slip, 0.005);
    is_near(2.0 * thin, pass.to + spring_back, 10e-6);
    // What goes in comes out.
    let [slow, thick] = ["inlet.vx", "inlet.y"].map(|name| results.mean(name, end - 1e-3, end));
    is_near(slow * thick, fast * thin, 0.005 * fast * thin);
    is_near(of("mass_in"), of("mass_out"), 0.005 * of("mass_in"));
    let [work, remap] = ["energy.external", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    assert!(remap.abs() < 0.002 * work, "{remap} of {work}");
}

#[test]
fn a_punch_makes_a_cup_of_a_billet() {
    let results = run("cup-extrusion", "example-cup-extrusion");
    results.is_sound(1e-3);
    let [inner, outer] = ["inner.y", "outer.y"].map(|name| *results.column(name).last().unwrap());
    is_near(0.5 * (inner + outer), 36.8e-3, 0.8e-3);
    let [punch, die] = ["obstacle.force_y[punch]", "obstacle.force_y[die]"].map(|name| results.mean(name, 1.4e-3, 1.6e-3));
    assert!(-punch > 56.5e3, "{punch}");
    is_near(die, -punch, -0.01 * punch);
    let [kinetic, plastic, remap] = ["energy.kinetic", "energy.plastic", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    assert!(kinetic < 0.005 * plastic && remap.abs() < 0.005 * plastic, "{kinetic} {plastic} {remap}");
}

#[test]
fn a_forging_fills_its_die_and_has_a_flash() {
    let results = run("closed-die", "example-closed-die");
    results.is_sound(1e-3);
    let [flash, rib] = ["flash.x", "rib.y"].map(|name| *results.column(name).last().unwrap());
    assert!((18.6e-3..19.7e-3).contains(&flash), "{flash}");
    is_near(rib, 13.4e-3, 0.1e-3);
    let [before, end] = [[195e-6, 205e-6], [300e-6, 305e-6]].map(|[from, to]| results.mean("obstacle.force_y[die]", from, to));
    assert!(end / before > 5.0, "{end} {before}");
    let [kinetic, plastic, remap] = ["energy.kinetic", "energy.plastic", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    assert!(kinetic < 0.03 * plastic && remap.abs() < 0.005 * plastic, "{kinetic} {plastic} {remap}");
}

#[test]
fn the_sides_of_a_rubber_block_roll_onto_the_plates() {
    let results = run("rubber-block", "example-rubber-block");
    results.is_sound(1e-4);
    // Without new elements, 32 × 32.
    for (millimetres, force) in [(2.0, 27.96e3), (4.0, 95.21e3), (5.0, 198.99e3), (6.0, 482.99e3)] {
        let time = 0.5e-3 + millimetres * 1.25e-3;
        is_near(-results.mean("obstacle.force_y[plate]", time - 40e-6, time + 60e-6), force, 0.015 * force);
    }
    let force = -*results.column("obstacle.force_y[plate]").last().unwrap();
    is_near(force, 1372.1e3, 0.015 * 1372.1e3);
    is_near(*results.column("middle.x").last().unwrap(), 31.17e-3, 0.15e-3);
    let [work, kinetic, internal, remap] =
        ["energy.external", "energy.kinetic", "energy.internal", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    is_near(work, 1428.3, 14.0);
    assert!(kinetic < 0.001 * internal && remap.abs() < 0.006 * work, "{kinetic} {internal} {work} {remap}");
    assert!(!results.summary["remeshings"].as_array().unwrap().is_empty());
}

#[test]
fn a_rubber_block_without_friction_is_compressed_as_its_law_says() {
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/rubber-block");
    let set = ["obstacle.plate.friction=0", "remesh[0].interval=\"0.5 ms\"", "run.end=\"5.6 ms\""];
    let results = run_model_with(&model, fresh("example-rubber-block-smooth"), &set);
    results.is_sound(1e-4);
    assert!(results.summary["remeshings"].as_array().unwrap().len() >= 10, "{}", results.summary["remeshings"]);
    // Homogeneous compression in plane strain, with no stress across.
    for (millimetres, force) in [(2.0, 22.92e3), (4.0, 79.80e3)] {
        let time = 0.5e-3 + millimetres * 1.25e-3;
        is_near(-results.mean("obstacle.force_y[plate]", time - 40e-6, time + 60e-6), force, 0.005 * force);
    }
}

#[test]
#[ignore = "takes fifteen seconds: the long form"]
fn a_tool_cuts_a_steady_chip_with_the_force_of_its_shear_plane_and_of_its_edge() {
    let results = run("cutting", "example-cutting");
    results.is_sound(1e-3);
    let (begin, end, speed, rake) = (45e-6, 85e-6, 40.0, 20_f64.to_radians());
    let force = -results.mean("obstacle.force_x[tool]", begin, end);
    let [x, y] = ["chip.vx", "chip.vy"].map(|name| results.mean(name, begin, end) / speed);
    let ratio = (x + 1.0).hypot(y);
    is_near(ratio, 0.744, 0.04);
    let shear = 500e6 / 3_f64.sqrt();
    // Force in the shear plane at an angle, of a layer of 1 mm.
    let plane = |angle: f64| shear * 1e-3 * rake.cos() / (angle.sin() * (angle - rake).cos());
    let angle = (ratio * rake.cos() / (1.0 - ratio * rake.sin())).atan();
    assert!(force > plane(PI / 4.0 + rake / 2.0), "{force}");
    assert!((1.05..1.2).contains(&(force / plane(angle))), "{force} and {}", plane(angle));
    let [early, late] = [[45e-6, 65e-6], [65e-6, 85e-6]].map(|[from, to]| results.mean("obstacle.force_x[tool]", from, to));
    is_near(late / early, 1.0, 0.03);
    // Plastic work from the one time to the other.
    let times = results.column("time");
    let [from, to] = [begin, end].map(|time| times.partition_point(|it| *it < time));
    let change = |name: &str| results.column(name)[to] - results.column(name)[from];
    let work = -change("energy.plastic") / change("obstacle.x[tool]");
    is_near(work, force, 0.02 * force);
    let [kinetic, plastic, remap] = ["energy.kinetic", "energy.plastic", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    assert!(kinetic < 0.015 * plastic && remap.abs() < 0.005 * plastic, "{kinetic} {plastic} {remap}");
}

#[test]
#[ignore = "takes fifteen seconds: the long form"]
fn a_rod_goes_six_diameters_deep_against_a_steady_force() {
    let results = run("deep-penetration", "example-deep-penetration");
    results.is_sound(1e-3);
    let places = results.column("rod.y");
    let depth = places[0] - places.iter().copied().fold(f64::INFINITY, f64::min);
    is_near(depth, 38.9e-3, 0.8e-3);
    let [early, late] = [[100e-6, 150e-6], [150e-6, 200e-6]].map(|[from, to]| -results.mean("contact.force_y[hit:block-rod]", from, to));
    is_near(late / early, 1.0, 0.03);
    // Pressures that widen a cylindrical cavity in a block of 60 mm radius, and a spherical one.
    let (yields, young, poisson, radius) = (400e6, 70e9, 0.33, 3e-3);
    let zone = 3_f64.sqrt() * young / ((5.0 - 4.0 * poisson) * yields);
    let cylinder = yields / 3_f64.sqrt() * (1.0 + zone.ln() - zone * (radius / 60e-3_f64).powi(2));
    let sphere = 2.0 / 3.0 * yields * (1.0 + (young / (3.0 * (1.0 - poisson) * yields)).ln());
    let area = PI * radius * radius;
    assert!(early > cylinder * area && early > sphere * area, "{early} {cylinder} {sphere}");
    let energy = results.column("energy.kinetic")[0];
    assert!(depth < energy / (cylinder * area), "{depth}");
    let [plastic, remap] = ["energy.plastic", "energy.remap"].map(|name| *results.column(name).last().unwrap());
    assert!((0.9..1.0).contains(&(plastic / energy)) && remap.abs() < 0.005 * energy, "{plastic} {remap} of {energy}");
}
