//! Whole contacts through the public face: momentum, energy, resultants, searches, threads, passes, symmetry,
//! walls, thin bodies.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::bodies::*;
use embate_solver::contact::search::registry;
use embate_solver::error::Error;
use embate_solver::model::{ContactLaw, Disk, Formulation, InitialPenetration, Model, Obstacle, Penalty, Rectangle, Shape, Symmetry};
use embate_solver::simulation::{Options, Simulation};

/// Two blocks that meet obliquely, corner against side.
fn oblique() -> Model {
    let mut model = model(2e-3);
    add(&mut model, "left", rectangle([0.0, 0.0], [0.1, 0.1], [6, 6]), [18.0, 3.0]);
    add(&mut model, "right", rectangle([0.102, 0.043], [0.12, 0.09], [9, 7]), [-12.0, -6.0]);
    touch(&mut model, "left", "right");
    model
}

/// A disk inside a box of four bars that touch it one after the other.
fn disk_in_a_box() -> Model {
    let mut model = model(8e-3);
    add(&mut model, "disk", Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.05, elements: 3 }), [31.0, 12.0]);
    for (name, corner, size) in [
        ("west", [-0.08, -0.06], [0.02, 0.12]),
        ("east", [0.06, -0.06], [0.02, 0.12]),
        ("south", [-0.06, -0.08], [0.12, 0.02]),
        ("north", [-0.06, 0.06], [0.12, 0.02]),
    ] {
        let elements = if size[0] > size[1] { [9, 2] } else { [2, 9] };
        add(&mut model, name, rectangle(corner, size, elements), [0.0, 0.0]);
        touch(&mut model, "disk", name);
    }
    model.materials.insert("heavy".into(), elastic(1e11, 1e5));
    model.parts[1..].iter_mut().for_each(|part| part.material = "heavy".into());
    model
}

/// A square that stands on its corner falls into a notch.
fn corner_in_a_notch() -> Model {
    let mut model = model(1.5e-3);
    let square = mapped([5, 5], |u, v| [0.004 + 0.05 * (u - v), 0.005 + 0.055 * (u + v)]);
    let notch = mapped([12, 4], |u, v| {
        let x = 0.3 * (u - 0.5);
        [x, -0.08 + v * (0.08 + 0.6 * x.abs())]
    });
    add_mesh(&mut model, "square", square, [0.0, -18.0]);
    add_mesh(&mut model, "notch", notch, [0.0, 0.0]);
    touch(&mut model, "square", "notch");
    model
}

/// Two toothed wheels, tooth against tooth, off centre.
fn wheels() -> Model {
    let mut model = model(3e-3);
    let wheel = |centre: [f64; 2], turned: f64| {
        closed_ring([2, 48], move |u, v| {
            let angle = std::f64::consts::TAU * u;
            let r = 0.03 + v * (0.03 + 0.006 * (8.0 * angle + turned).cos());
            [centre[0] + r * angle.cos(), centre[1] + r * angle.sin()]
        })
    };
    add_mesh(&mut model, "one", wheel([0.0, 0.0], 0.0), [8.0, 0.0]);
    add_mesh(&mut model, "two", wheel([0.134, 0.03], 0.4), [-8.0, 0.0]);
    touch(&mut model, "one", "two");
    model
}

pub(crate) fn scenes() -> Vec<(&'static str, Model, f64)> {
    // Name, model, shortest segment of its surfaces.
    vec![
        ("oblique", oblique(), 0.012),
        ("disk in a box", disk_in_a_box(), 0.01),
        ("corner in a notch", corner_in_a_notch(), 0.014),
        ("wheels", wheels(), 0.007),
    ]
}

#[test]
fn momentum_is_kept_and_the_books_close_in_every_kind_of_contact() {
    for (name, model, segment) in scenes() {
        let (simulation, history) = run(&model);
        let summary = simulation.summary();
        assert!(history.largest("energy.contact") > 1e-4 * history.first("energy.kinetic"), "{name}: they met");
        assert!(summary.momentum_drift_linear.unwrap() <= 1e-12, "{name}: {summary:?}");
        assert!(summary.momentum_drift_angular.unwrap() <= 1e-12, "{name}: {summary:?}");
        assert!(summary.ledger_residual <= 1e-12, "{name}: {summary:?}");
        assert!(summary.energy_drift <= 0.01, "{name}: {summary:?}");
        assert!(summary.penetration_max < 0.15 * segment, "{name}: {summary:?}");
    }
}

#[test]
fn what_the_contacts_take_is_in_their_springs() {
    for (name, model, _) in scenes() {
        let mut simulation = simulation(&model);
        let (mut largest, mut off) = (0.0_f64, 0.0_f64);
        while simulation.time() < model.run.end {
            let before = simulation.ledger().works.contact;
            simulation.advance(f64::INFINITY, 1).unwrap();
            let ledger = simulation.ledger();
            // Works are known at half steps, springs at whole ones.
            let works = 0.5 * (before + ledger.works.contact);
            largest = largest.max(ledger.stores.contact);
            off = off.max((works + ledger.stores.contact).abs());
        }
        let all = simulation.ledger().largest;
        assert!(largest > 1e-3 * all && off < 0.05 * all, "{name}: {off} of {largest}, {all}");
    }
}

#[test]
fn the_force_of_a_contact_is_the_change_of_both_momenta() {
    for (name, model, _) in [("oblique", oblique(), 0.0), ("corner in a notch", corner_in_a_notch(), 0.0), ("wheels", wheels(), 0.0)] {
        let parts: Vec<String> = model.parts.iter().map(|part| part.name.clone()).collect();
        let steps = every_step(&model);
        let contact = format!("{}-{}", parts[0], parts[1]);
        for (d, axis) in ["x", "y"].iter().enumerate() {
            let impulse = steps.impulse(&format!("contact.force_{axis}[{contact}]"));
            let largest = steps.masses[0] * 40.0;
            for (part, sign) in [(0, 1.0), (1, -1.0)] {
                let change = steps.masses[part] * steps.change(&format!("{}.v{axis}", parts[part]));
                assert!((sign * impulse - change).abs() < 1e-10 * largest, "{name} {axis} {part}: {impulse} {change}");
            }
            assert!(d == 1 || impulse.abs() > 1e-3 * largest, "{name}: {impulse} of {largest}");
        }
    }
}

#[test]
fn every_contact_has_its_own_columns() {
    let model = disk_in_a_box();
    let (_, history) = run(&model);
    let names = ["disk-west", "disk-east", "disk-south", "disk-north"];
    for name in names {
        assert!(history.largest(&format!("contact.energy[{name}]")) > 0.0, "{name} was touched");
        let force = history.column(&format!("contact.force_{}[{name}]", if name.ends_with("st") { "x" } else { "y" }));
        // The force on the disk points away from the bar.
        let sign = if name.ends_with("west") || name.ends_with("south") { 1.0 } else { -1.0 };
        assert!(force.iter().all(|f| sign * f >= 0.0) && force.iter().any(|f| sign * f > 0.0), "{name}");
    }
    let total = history.column("energy.contact");
    for (row, total) in total.iter().enumerate() {
        let sum: f64 = names.iter().map(|name| history.column(&format!("contact.energy[{name}]"))[row]).sum();
        assert!((sum - total).abs() <= 1e-12 * total.abs());
    }
}

#[test]
fn every_search_gives_the_same_bits() {
    let mut overlapping = oblique();
    // Almost two segments inside at the start: some nodes are deeper than any search need look, and no search
    // may see more than another.
    if let Shape::Rectangle(Rectangle { corner, .. }) = &mut overlapping.parts[1].shape {
        corner[0] = 0.07;
    }
    overlapping.contacts[0].interface.initial_penetration = InitialPenetration::Ignore;
    overlapping.run.end = 3e-4;
    let mut fast = wheels();
    fast.parts.iter_mut().for_each(|part| part.velocity = part.velocity.map(|v| 10.0 * v));
    fast.run.end = 2e-4;
    for (name, model) in scenes().into_iter().map(|(name, model, _)| (name, model)).chain([("overlapping", overlapping), ("fast", fast)]) {
        let mut hashes = vec![];
        for kind in registry::<2>() {
            let mut model = model.clone();
            model.contacts.iter_mut().for_each(|contact| contact.search = kind.name.into());
            let (simulation, history) = run(&model);
            assert!(history.largest("energy.contact") > 0.0);
            hashes.push((kind.name, simulation.summary().state_hash));
        }
        assert!(hashes.iter().all(|(_, hash)| *hash == hashes[0].1), "{name}: {hashes:?}");
    }
}

#[test]
fn threads_and_instruction_sets_change_no_bit() {
    // Enough elements for threads to be used at all.
    let mut model = model(1.0);
    model.run.max_steps = Some(60);
    add(&mut model, "lower", rectangle([0.0, 0.0], [0.4, 0.1], [80, 30]), [0.0, 20.0]);
    add(&mut model, "upper", rectangle([0.03, 0.1001], [0.3, 0.1], [70, 30]), [5.0, -20.0]);
    touch(&mut model, "lower", "upper");
    let of = |threads: usize, simd: Option<&str>| {
        let mut simulation = Simulation::new(&model, &Options { threads, simd: simd.map(String::from) }).unwrap();
        simulation.advance(f64::INFINITY, 60).unwrap();
        assert_eq!(simulation.steps(), 60);
        assert_eq!(simulation.summary().threads, threads);
        (simulation.ledger().stores.contact.to_bits(), simulation.summary().state_hash)
    };
    let one = of(1, None);
    assert!(f64::from_bits(one.0) > 0.0);
    for threads in [2, 3, 7] {
        assert_eq!(of(threads, None), one, "{threads} threads");
    }
    for level in embate_lanes::Level::available() {
        assert_eq!(of(1, Some(level.name())), one, "{}", level.name());
    }
}

/// A wedge whose tip comes down between two nodes of a coarse plate: figure 1 of the paper.
fn tip_between_nodes(formulation: Formulation) -> Model {
    let mut model = model(1e-3);
    add(&mut model, "plate", rectangle([-0.15, -0.1], [0.3, 0.1], [3, 1]), [0.0, 0.0]);
    let wedge = mapped([4, 4], |u, v| {
        let y = 0.001 + 0.06 * v;
        [(u - 0.5) * (0.01 + 0.9 * y), y]
    });
    add_mesh(&mut model, "wedge", wedge, [0.0, -10.0]);
    touch(&mut model, "plate", "wedge");
    model.contacts[0].formulation = formulation;
    model
}

#[test]
fn a_single_pass_sees_only_its_slaves_and_a_double_pass_sees_both() {
    let lowest = |formulation| {
        let (simulation, history) = run(&tip_between_nodes(formulation));
        (history.largest("energy.contact"), history.last("wedge.vy"), simulation.summary().penetration_max)
    };
    // The plate's nodes are far from the wedge: nothing is seen, the wedge falls through.
    let (energy, speed, _) = lowest(Formulation::SinglePass { slave: 0 });
    assert!(energy == 0.0 && (speed + 10.0).abs() < 1e-12, "{energy} {speed}");
    for formulation in [Formulation::SinglePass { slave: 1 }, Formulation::DoublePass] {
        let (energy, speed, depth) = lowest(formulation);
        assert!(energy > 0.0 && speed > 0.0 && depth < 0.01, "{formulation:?}: {energy} {speed} {depth}");
    }
}

#[test]
fn named_sides_meet_and_others_do_not() {
    let between = |first: &str, second: &str| {
        let mut model = model(8e-4);
        add(&mut model, "lower", rectangle([0.0, 0.0], [0.1, 0.1], [5, 5]), [0.0, 0.0]);
        add(&mut model, "upper", rectangle([0.01, 0.101], [0.06, 0.05], [4, 3]), [0.0, -20.0]);
        touch(&mut model, first, second);
        let (simulation, history) = run(&model);
        assert!(simulation.summary().momentum_drift_angular.unwrap() < 1e-12);
        (history.largest("energy.contact"), history.last("upper.vy"))
    };
    let (energy, speed) = between("lower.top", "upper.bottom");
    assert!(energy > 0.0 && speed > 0.0, "{energy} {speed}");
    for (first, second) in [("lower.left", "upper.bottom"), ("lower.top", "upper.top")] {
        let (energy, speed) = between(first, second);
        assert!(energy == 0.0 && (speed + 20.0).abs() < 1e-12, "{first} {second}: {energy} {speed}");
    }
}

#[test]
fn a_node_that_slides_off_the_end_of_a_named_side_feels_nothing_more() {
    let mut model = model(1.5e-3);
    add(&mut model, "lower", rectangle([0.0, 0.0], [0.1, 0.05], [10, 5]), [0.0, 0.0]);
    // Pressed together, the upper block slides over the edge of the side.
    add(&mut model, "upper", rectangle([0.03, 0.0502], [0.06, 0.05], [6, 5]), [40.0, -4.0]);
    touch(&mut model, "lower.top", "upper.bottom");
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.largest("energy.contact") > 0.0);
    assert!(summary.energy_drift < 0.01 && summary.penetration_max < 0.001, "{summary:?}");
}

#[test]
fn a_half_model_is_half_of_the_whole() {
    for penalty in [Penalty::default(), Penalty::Pressure(3e11), Penalty::PerNode(2e9)] {
        let [half, whole] = [true, false].map(|half| {
            let mut model = model(4e-4);
            // Rounded below, and level near the line: on a ridge two sides would be equally near.
            let bottom = |x: f64| 6.0 * (x.abs() - 0.0125).max(0.0).powi(2);
            let width = if half { 0.05 } else { 0.1 };
            let block = mapped([if half { 4 } else { 8 }, 6], |u, v| {
                let x = width * u - if half { 0.0 } else { 0.05 };
                [x, (1.0 - v) * bottom(x) + 0.1 * v]
            });
            add_mesh(&mut model, "disc", block, [0.0, -20.0]);
            let plate =
                if half { rectangle([0.0, -0.011], [0.12, 0.01], [12, 2]) } else { rectangle([-0.12, -0.011], [0.24, 0.01], [24, 2]) };
            add(&mut model, "plate", plate, [0.0, 0.0]);
            touch(&mut model, "disc", "plate");
            model.contacts[0].interface = penalty.into();
            for (name, part, point) in
                [("A", "disc", [0.0, 0.0]), ("T", "disc", [0.0, 0.1]), ("B", "plate", [0.0, -0.001]), ("E", "plate", [0.12, -0.011])]
            {
                probe(&mut model, name, part, point);
            }
            if half {
                model.symmetries.push(Symmetry { normal: [-1.0, 0.0, 0.0], ..Symmetry::default() });
            }
            run(&model)
        });
        assert!(whole.1.largest("energy.contact") > 0.0);
        let force = |history: &History| history.largest("contact.force_y[disc-plate]");
        assert!((2.0 * force(&half.1) / force(&whole.1) - 1.0).abs() < 1e-6, "{penalty:?} {} {}", force(&half.1), force(&whole.1));
        for name in ["A", "T", "B", "E"] {
            for axis in ["x", "y"] {
                let column = format!("{name}.{axis}");
                let (a, b) = (half.1.column(&column), whole.1.column(&column));
                let worst = a.iter().zip(&b).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
                // Of 8 mm. Not round-off: on the slightest ridge two sides are equally near, and the whole
                // model takes one of them.
                assert!(worst < 1e-6, "{penalty:?} {column}: {worst}");
            }
        }
    }
}

#[test]
fn the_impulse_of_a_wall_is_the_change_of_momentum() {
    let mut model = model(1.2e-3);
    add(&mut model, "block", mapped_rectangle(), [8.0, -20.0]);
    model.obstacles.push(Obstacle::wall("floor", [3.0, -0.001], [0.0, 2.0]));
    let steps = every_step(&model);
    let change = steps.masses[0] * steps.change("block.vy");
    let impulse = steps.impulse("obstacle.force_y[floor]");
    assert!(change > 20.0 * steps.masses[0] && (impulse - change).abs() < 1e-10 * change, "{impulse} {change}");
    assert!(steps.impulse("obstacle.force_x[floor]") == 0.0 && steps.change("block.vx").abs() < 1e-10);
    assert!(steps.column("obstacle.penetration[floor]").into_iter().fold(0.0, f64::max) < 0.0015);
}

#[test]
fn a_disk_bounces_between_two_walls_many_times_and_keeps_its_energy() {
    let mut model = model(0.05);
    add(&mut model, "disk", Shape::Disk(Disk { centre: [0.0, 0.0], radius: 0.05, elements: 4 }), [0.0, 20.0]);
    for (name, y) in [("floor", -0.06), ("ceiling", 0.06)] {
        model.obstacles.push(Obstacle::wall(name, [0.0, y], [0.0, -y]));
    }
    let (simulation, history) = run(&model);
    let speeds = history.column("disk.vy");
    let bounces = speeds.windows(2).filter(|w| (w[0] > 0.0) != (w[1] > 0.0)).count();
    let summary = simulation.summary();
    assert!(bounces > 20, "{bounces}");
    assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-12, "{summary:?}");
}

#[test]
fn parts_that_share_nodes_may_have_a_contact_and_feel_nothing_at_the_seam() {
    // Two blocks bonded along their lower half; a fine mesh beside a coarse one, so that neighbours at the
    // seam are nearer than the skin.
    let mut model = model(3e-4);
    let n = 8;
    let mut mesh = mapped([n, n], |u, v| [0.1 * u, 0.1 * v * v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    let (left, right): (Vec<_>, Vec<_>) = cells.into_iter().enumerate().partition(|(i, _)| i % n < n / 2);
    mesh.groups = [("left", left), ("right", right)].map(|(name, cells)| group(name, 2, cells.into_iter().map(|(_, cell)| cell))).into();
    add_groups(&mut model, mesh, &["left", "right"], [3.0, 2.0]);
    touch(&mut model, "left", "right");
    let (simulation, history) = run(&model);
    assert_eq!(history.largest("energy.contact"), 0.0);
    assert_eq!(simulation.overview().initial_penetrations, Vec::<String>::new());
}

#[test]
fn a_projectile_that_moves_several_plate_thicknesses_in_a_step_does_not_pass() {
    // A soft heavy foil, a light block that comes at a third of its own sound speed: four thicknesses in a
    // step, from many heights.
    let speed = 0.33 * 1160.0;
    for k in 0..8 {
        let mut model = model(6e-4);
        add(&mut model, "foil", rectangle([-0.1, 0.0], [0.2, 0.0005], [40, 1]), [0.0, 0.0]);
        model.parts[0].material = "heavy".into();
        model.materials.insert("heavy".into(), elastic(1e10, 1e8));
        let height = 0.005 + 0.0003 * f64::from(k);
        add(&mut model, "block", rectangle([-0.0231, height], [0.05, 0.03], [5, 3]), [0.0, -speed]);
        touch(&mut model, "foil", "block");
        model.contacts[0].interface = Penalty::Pressure(1e11).into();
        model.contacts[0].formulation = Formulation::SinglePass { slave: 1 };
        model.run.energy_limit = 0.5;
        let mut simulation = simulation(&model);
        assert!(speed * simulation.time_step() > 4.0 * 0.0005);
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let positions = simulation.frame().positions::<2>().to_vec();
        let foil = positions[..82].iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
        assert!(positions[82..].iter().all(|x| x[1] > foil + 0.01), "{height}: it is back above the foil");
    }
}

#[test]
fn a_contact_that_gives_way_is_reported_with_its_deepest_node() {
    // A block meets a wall with next to no penalty: it continues with its velocity, so the depth after t is v
    // (t − t0).
    let mut model = model(2e-3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.01, 0.01], [2, 2]), [10.0, 0.0]);
    add(&mut model, "wall", rectangle([0.011, -0.01], [0.02, 0.03], [4, 6]), [0.0, 0.0]);
    touch(&mut model, "block", "wall");
    model.contacts[0].interface.law = ContactLaw::Penalty(Penalty::PerNode(1.0));
    let fail = |model: &Model| simulation(model).advance(f64::INFINITY, u64::MAX).unwrap_err();
    for given in [None, Some(0.002)] {
        model.run.penetration_limit = given;
        let Error::TooDeep { contact, place, depth, limit, time, .. } = fail(&model) else { panic!("it is too deep") };
        assert!(contact.starts_with("contact ") && place.starts_with("node "), "{contact}: {place}");
        // The wall has the longest segment that looks outside.
        assert!((limit - given.unwrap_or(0.005)).abs() < 1e-15, "{limit:e}");
        let step = simulation(&model).time_step();
        assert!(depth > limit + 20.0 * step * 0.98 && depth < limit + 30.0 * step * 1.02, "{depth:e}");
        assert!((10.0f64 * time - 0.001 - depth).abs() < 1e-6, "{time:e}");
    }
    model.run.penetration_limit = Some(1.0);
    assert!(simulation(&model).advance(f64::INFINITY, u64::MAX).is_ok());
}
