//! Examples of shells and beams.

use super::*;

#[test]
fn the_tube_and_the_plate_as_shells_are_where_fine_solids_are() {
    let results = run("tube-plate-shells", "example-tube-plate-shells");
    results.is_sound(1e-3);
    // 4 × 320 and 600 × 4 solids: see the README.
    for (probe, expected) in [("A.y", -0.1206), ("T.y", 0.0704), ("B.y", -0.1225)] {
        let at = results.rows_where(probe, |_| true).into_iter().find(|(time, _)| *time >= 8e-3).unwrap();
        assert!((at.1 - expected).abs() < 2e-3, "{probe}: {at:?} for {expected}");
    }
    let held = results.rows_where("obstacle.force_x[wall]", |force| force > 0.0);
    is_near(held[0].0, 8.23e-3, 0.1e-3);
    assert!(results.figure("penetration_max") <= 1e-4, "{}", results.summary);
}

#[test]
fn a_frame_of_tubes_rolls_over_as_gravity_and_friction_let_it() {
    let results = run("roll-over-frame", "example-roll-over-frame");
    results.is_sound(1e-3);
    // Mass of 18.737 m of tube, and what it carries.
    let mass = 100.0 + 7800.0 * 18.736_931_687_685 * 0.25 * PI * (0.06f64.powi(2) - 0.057f64.powi(2));
    is_near(results.column("energy.kinetic")[0], 50.0 * mass, 1e-6);
    let [vx, vy, vz] = ["x", "y", "z"].map(|axis| results.column(&format!("frame.v{axis}")));
    let times = results.column("time");
    let row = |time: f64| times.iter().position(|own| *own >= time).unwrap();
    // It falls freely after its roof has hit the ground.
    let (from, to) = (row(0.16), row(0.4));
    assert!(results.column("obstacle.force_z[ground]")[from..=to].iter().all(|force| *force == 0.0));
    is_near(vz[to] - vz[from], -9.81 * (times[to] - times[from]), 1e-9);
    is_near(vy[to], vy[from], 1e-9);
    // Friction brings no more than its coefficient of what the ground pushes.
    let (pushed, braked) = (vz[from] + 8.0 + 9.81 * times[from], (vx[from].powi(2) + (6.0 - vy[from]).powi(2)).sqrt());
    assert!(braked < 0.5 * pushed * (1.0 + 1e-9) && braked > 0.1 * pushed, "{braked} {pushed}");
    let plastic = *results.column("energy.plastic").last().unwrap();
    is_near(plastic, 3245.0, 60.0);
}

#[test]
#[ignore = "takes half a minute: the long form"]
fn a_ball_pierces_a_sheet_whose_layers_fail() {
    let results = run("ball-through-sheet", "example-ball-through-sheet");
    results.is_sound(1e-3);
    is_near(-results.column("ball.vz").last().unwrap(), 128.5, 3.5);
    assert!(*results.column("energy.eroded").last().unwrap() > 0.0);
}

#[test]
#[ignore = "takes half a minute: the long form"]
fn a_box_section_of_shells_does_so_too() {
    is_crushed_as_expected("box-section-shells", 2e-3);
}

/// Alexander's mean force of a tube that folds as a concertina, with the mean flow stress of its folds.
#[test]
fn a_round_tube_folds_as_a_concertina_under_the_mean_force_of_alexander() {
    let results = run("circular-tube", "example-circular-tube");
    results.is_sound_but(600, 1e-3);
    let [way, work] = ["obstacle.y[ram]", "energy.external"].map(|name| results.column(name));
    let (way, work) = (way[0] - way.last().unwrap(), 4.0 * work.last().unwrap());
    is_near(way, 40.5e-3, 1e-6);
    let (flow, thickness, diameter): (f64, f64, f64) = (269e6, 1e-3, 50e-3);
    let expected = 5.98 * flow * thickness * (diameter * thickness).sqrt();
    is_near(work / way, expected, 0.12 * expected);
    // The same of shells of revolution.
    is_near(work / way, 11.89e3, 0.07 * 11.89e3);
    assert!(results.column("contact.penetration[folds]").into_iter().fold(0.0, f64::max) < 0.05 * thickness);
    let [kinetic, internal] = ["energy.kinetic", "energy.internal"].map(|name| *results.column(name).last().unwrap());
    assert!(kinetic < 0.05 * internal, "{kinetic} of {internal}");
}

/// The mean force on the pole is that of plastic hinges in the middle and at both ends.
#[test]
#[ignore = "takes half a minute: the long form"]
fn a_bumper_stops_a_pole_with_the_force_of_its_plastic_hinges() {
    let results = run("pole-bumper", "example-pole-bumper");
    results.is_sound(1e-3);
    let way = results.column("obstacle.x[pole]").into_iter().map(|x| x + 0.128).fold(0.0, f64::max);
    // Four quarters of 25 kg at 8 m/s.
    let energy = 4.0 * 0.5 * 25.0 * 8.0_f64.powi(2);
    let (yields, thickness, depth, height, length): (f64, f64, f64, f64, f64) = (400e6, 2e-3, 60e-3, 100e-3, 1.0);
    let moment = yields * thickness * depth * (height + 0.5 * depth);
    let expected = 8.0 * moment / length;
    is_near(energy / way, expected, 0.15 * expected);
    is_near(way, 72e-3, 2e-3);
    // What is not plastic is elastic, and gives the pole some of its velocity back.
    let back = -results.column("obstacle.vx[pole]").last().unwrap();
    assert!((0.5..2.5).contains(&back), "{back}");
}

/// The work of a bar on a can is that of a finer mesh.
#[test]
#[ignore = "takes half a minute: the long form"]
fn a_can_is_squeezed_with_the_work_that_finer_shells_take() {
    let results = run("squeezed-can", "example-squeezed-can");
    results.is_sound(1e-3);
    let way = results.column("obstacle.x[bar]");
    is_near(way[0] - way.last().unwrap(), 36e-3, 1e-6);
    let [work, internal, hourglass] =
        ["energy.external", "energy.internal", "energy.hourglass"].map(|name| *results.column(name).last().unwrap());
    is_near(4.0 * work, 29.8, 0.1 * 29.8);
    assert!(hourglass < 0.12 * internal, "{hourglass} of {internal}");
}

/// The same of axisymmetric solids, 100 × 4 of them: `verification/shell-cup`.
#[test]
#[ignore = "takes half a minute: the long form"]
fn a_cup_is_drawn_from_a_round_blank_as_of_solids_of_revolution() {
    let results = run("cup-from-blank", "example-cup-from-blank");
    results.is_sound(1e-3);
    for (from, to, expected) in [(0.7e-3, 1.1e-3, 36.8e3), (0.9e-3, 1.1e-3, 38.2e3)] {
        is_near(4.0 * results.mean("contact.force_y[punch]", from, to), expected, 0.03 * expected);
    }
    // It stays round, and is drawn in by 3 % of the way as far.
    let last = |column: &str| *results.column(column).last().unwrap();
    let (rim, diagonal) = (last("rim.x"), last("diagonal.x").hypot(last("diagonal.z")));
    is_near(rim, 34.10e-3, 0.03 * 10.9e-3);
    is_near(diagonal, rim, 2e-5);
    let [kinetic, internal, hourglass] = ["energy.kinetic", "energy.internal", "energy.hourglass"].map(last);
    assert!(kinetic < 0.03 * internal && hourglass < 0.02 * internal, "{kinetic} {hourglass} of {internal}");
}
