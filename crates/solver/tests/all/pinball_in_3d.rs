//! Pinballs between solids: balls in the elements. Conservation with every element, law and friction, closed
//! forms, objectivity, every search, states, erosion, and what is inside at the start.

use crate::bodies::*;
use embate_solver::contact::search::registry;
use embate_solver::element::ELEMENTS_OF_SPACE;
use embate_solver::model::{
    Contact, ContactLaw, Formulation, Friction, ImportedMesh, InitialPenetration, Interface, Material, Model, Part, Partners, Penalty,
    Shape,
};
use embate_solver::simulation::Simulation;
use std::sync::Arc;

type Vector = [f64; 3];

const FRICTION: Friction = Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
const DEPTH: &str = "contact.penetration[hit]";

/// A box whose corner and axes are mapped by `place`, of any element.
fn add_box(
    model: &mut Model,
    name: &str,
    element: &str,
    (size, cells): (Vector, [usize; 3]),
    velocity: Vector,
    place: impl Fn(Vector) -> Vector,
) {
    let [nx, ny, nz] = cells;
    let number = move |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let places = (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k])));
    let positions = places.map(|at| place([0, 1, 2].map(|d| size[d] * at[d] as f64 / cells[d] as f64))).collect();
    let nodes = ELEMENTS_OF_SPACE.iter().find(|kind| kind.name == element).unwrap().nodes();
    let mut all: Vec<Vec<u32>> = Vec::new();
    for (i, j, k) in (0..nx * ny * nz).map(|cell| (cell % nx, cell / nx % ny, cell / nx / ny)) {
        let corner = |c: [usize; 3]| number(i + c[0], j + c[1], k + c[2]);
        let hexahedron = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(corner);
        let cut: &[&[usize]] = match nodes {
            8 => &[&[0, 1, 2, 3, 4, 5, 6, 7]],
            6 => &[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]],
            _ => &[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]],
        };
        all.extend(cut.iter().map(|cell| cell.iter().map(|&c| hexahedron[c]).collect::<Vec<u32>>()));
    }
    let groups = vec![group("body", 3, all.into_iter())];
    model.meshes.push(Arc::new(ImportedMesh { source: "test".into(), positions, groups, ..ImportedMesh::default() }));
    model.parts.push(Part {
        name: name.into(),
        material: "soft".into(),
        element: element.into(),
        shape: Shape::Group { mesh: model.meshes.len() - 1, group: "body".into() },
        velocity,
        ..Part::default()
    });
}

fn meet(model: &mut Model, named: bool, interface: Interface) {
    let partners = if named { Partners::Between(["upper".into(), "lower".into()]) } else { Partners::Bodies(Vec::new()) };
    model.contacts.push(Contact { name: "hit".into(), partners, formulation: Formulation::Pinball, interface, ..Contact::default() });
}

/// Two boxes that hit each other obliquely and off their middles, all turned by an angle about the line
/// x = y = z.
fn oblique(element: &str, named: bool, interface: Interface, angle: f64) -> Model {
    let mut model = model(3e-3);
    let turn = move |v: Vector| rotated([1.0 / 3f64.sqrt(); 3], angle, v);
    let tilt = |v: Vector| rotated([0.6, 0.8, 0.0], 0.4, v);
    add_box(&mut model, "lower", element, ([0.2, 0.2, 0.1], [4, 4, 2]), turn([0.0, 0.0, 1.0]), turn);
    let upper = move |x: Vector| {
        let [a, b, c] = tilt([x[0] - 0.05, x[1] - 0.05, x[2] - 0.05]);
        turn([a + 0.13, b + 0.12, c + 0.175])
    };
    add_box(&mut model, "upper", element, ([0.1; 3], [2; 3]), turn([2.0, 1.0, -9.0]), upper);
    meet(&mut model, named, interface);
    model
}

/// Rotation by an angle about a unit axis.
fn rotated(n: Vector, angle: f64, v: Vector) -> Vector {
    let (sin, cos) = angle.sin_cos();
    let across = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
    let along = (1.0 - cos) * (0..3).map(|d| n[d] * v[d]).sum::<f64>();
    [0, 1, 2].map(|d| cos * v[d] + sin * across[d] + along * n[d])
}

fn laws() -> Vec<ContactLaw> {
    let soft_layer = ContactLaw::PressureGap { gaps: vec![-1e-3, -2e-4, 1e-4], pressures: vec![3e8, 2e7, 0.0] };
    vec![ContactLaw::default(), soft_layer, ContactLaw::Multiplier]
}

fn is_sound(simulation: &Simulation, drift: f64, case: &str) {
    let summary = simulation.summary();
    let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
    println!("{case}: momenta {linear:.1e} {angular:.1e}, ledger {:.1e}, energy {:.1e}", summary.ledger_residual, summary.energy_drift);
    assert!(linear < 1e-12 && angular < 1e-12, "{case}: {linear} {angular}");
    assert!(summary.ledger_residual < 1e-10, "{case}: {}", summary.ledger_residual);
    assert!(summary.energy_drift < drift, "{case}: {}", summary.energy_drift);
    assert_eq!(simulation.sweeps().1, 0, "{case}: forces that were not solved");
}

#[test]
fn boxes_of_every_solid_hit_each_other_and_keep_both_momenta_and_the_energy() {
    for kind in ELEMENTS_OF_SPACE {
        for named in [true, false] {
            for (friction, law) in laws().into_iter().flat_map(|law| [(None, law.clone()), (Some(FRICTION), law)]) {
                // The laws differ in what they do along the normal, whatever the elements.
                if kind.name != "hex8" && (!named || law != ContactLaw::default()) {
                    continue;
                }
                let case = format!("{} {named} {law:?} {}", kind.name, friction.is_some());
                let model = oblique(kind.name, named, Interface { law, friction, ..Interface::default() }, 0.0);
                let (simulation, history) = run(&model);
                is_sound(&simulation, 1e-2, &case);
                assert!(history.largest("energy.contact") > 0.0 || history.largest("contact.force_z[hit]") != 0.0 || !named, "{case}");
                // Between four balls of the blocks, 0.05 m wide, another one comes nearer by 29 % of that,
                // with what the springs yield.
                let deepest = simulation.summary().penetration_max;
                assert!(history.last("energy.contact") == 0.0 && deepest < 0.02 + 0.29 * 0.05, "{case}: they part again, {deepest}");
                assert!(friction.is_none() || history.last("energy.friction") > 0.0, "{case}");
            }
        }
    }
}

#[test]
fn equal_blocks_that_meet_face_to_face_exchange_their_velocities_and_stay_symmetric() {
    // Soft beside the blocks, so that they hit each other like rigid bodies.
    let mut model = model(0.05);
    add_box(&mut model, "lower", "hex8", ([0.1; 3], [3; 3]), [0.0; 3], |x| x);
    add_box(&mut model, "upper", "hex8", ([0.1; 3], [3; 3]), [0.0, 0.0, -0.1], |[x, y, z]| [x, y, z + 0.1005]);
    meet(&mut model, true, Penalty::Pressure(1e7).into());
    let (simulation, history) = run(&model);
    is_sound(&simulation, 1e-2, "face to face");
    assert!(history.largest(DEPTH) > 1e-4 && history.last(DEPTH) == 0.0);
    let frame = simulation.frame();
    let velocity = frame.fields.iter().find(|field| field.kind.name == "velocity").unwrap();
    let [mut lower, mut upper] = [[0.0; 4]; 2];
    for (x, v) in frame.positions::<3>().iter().zip(velocity.values.chunks(3)) {
        // The blocks hardly vibrate; the upper one has stopped where it was.
        let of = if v[2] < -0.05 { &mut lower } else { &mut upper };
        of[3] += 1.0;
        (0..3).for_each(|d| of[d] += v[d]);
        assert!(x.iter().all(|x| x.is_finite()));
    }
    println!("{lower:?} {upper:?}");
    assert_eq!((lower[3], upper[3]), (64.0, 64.0));
    assert!((lower[2] / 64.0 + 0.1).abs() < 1e-3 && (upper[2] / 64.0).abs() < 1e-3);
    assert!(lower[0].abs() + lower[1].abs() + upper[0].abs() + upper[1].abs() < 1e-9);
}

#[test]
fn bars_of_solids_meet_with_the_force_of_the_closed_form() {
    // Held aside by nothing: thin beside the waves, E and not the modulus of plane waves.
    let (young, density, speed): (f64, f64, f64) = (1e9, 1000.0, 20.0);
    for element in ["hex8", "hex8_reduced", "wedge6"] {
        let mut model = slender(1.3e-4, young, density);
        let name = model.materials.keys().next().unwrap().clone();
        add_box(&mut model, "lower", element, ([0.1, 0.004, 0.004], [50, 2, 2]), [0.5 * speed, 0.0, 0.0], |x| x);
        add_box(&mut model, "upper", element, ([0.1, 0.004, 0.004], [50, 2, 2]), [-0.5 * speed, 0.0, 0.0], |[x, y, z]| {
            [x + 0.1 + 1e-6, y, z]
        });
        model.parts.iter_mut().for_each(|part| part.material.clone_from(&name));
        meet(&mut model, true, Interface::default());
        let steps = every_step(&model);
        let (times, forces) = (steps.column("time"), steps.column("contact.force_x[hit]"));
        let plateau: Vec<f64> =
            times.iter().zip(&forces).filter(|(time, _)| (0.5e-4..1.2e-4).contains(*time)).map(|(_, f)| f.abs()).collect();
        let (mean, right) = (plateau.iter().sum::<f64>() / plateau.len() as f64, 0.5 * density * (young / density).sqrt() * speed * 1.6e-5);
        println!("{element}: {} of the closed form", mean / right);
        assert!((mean / right - 1.0).abs() < 0.03, "{element}: {mean} {right}");
    }
}

#[test]
fn a_model_that_is_turned_as_a_whole_gives_turned_results() {
    // Nodes and elements of a turned model are numbered otherwise, and so which of two balls is the first:
    // nothing depends on that.
    for friction in [None, Some(FRICTION)] {
        let interface = Interface { friction, damping: 0.1, ..Interface::default() };
        let [straight, turned] = [0.0, 0.7].map(|angle| {
            let simulation = to_end(&oblique("hex8", true, interface.clone(), angle));
            assert!(simulation.summary().penetration_max > 0.0 && (friction.is_none() || simulation.ledger().stores.friction > 0.0));
            let mut positions = simulation.frame().positions::<3>().to_vec();
            positions.iter_mut().for_each(|x| *x = rotated([1.0 / 3f64.sqrt(); 3], -angle, *x));
            positions
        });
        let apart = |x: &Vector, y: &Vector| (0..3).map(|d| (x[d] - y[d]).powi(2)).sum::<f64>().sqrt();
        let mut largest = 0.0_f64;
        for x in &straight {
            let nearest = turned.iter().map(|y| apart(x, y)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-12, "{nearest}");
            largest = nearest.max(largest);
        }
        println!("{} apart by {largest:.1e} m", friction.is_some());
    }
}

#[test]
fn every_search_gives_the_same_bits() {
    let hash = |search: &str| {
        let mut model = oblique("tet4", false, Interface { friction: Some(FRICTION), ..Interface::default() }, 0.0);
        model.contacts[0].search = search.into();
        model.run.end = 1.5e-3;
        let simulation = to_end(&model);
        assert!(simulation.summary().penetration_max > 0.0);
        simulation.summary().state_hash
    };
    let all: Vec<String> = registry::<3>().iter().map(|kind| hash(kind.name)).collect();
    assert!(all.len() > 2 && all.iter().all(|hash| *hash == all[0]), "{all:?}");
}

#[test]
fn threads_and_instruction_sets_and_a_stop_between_change_no_bit() {
    let model = oblique("hex8", true, Interface { friction: Some(FRICTION), ..Interface::default() }, 0.0);
    let alone = hash_of_equal_bits(&model, &[1, 3], "balls");
    let mut first = simulation(&model);
    while value(&first, "contact.force_z[hit]") == 0.0 {
        assert!(!first.is_over(), "they have to meet");
        first.advance(f64::INFINITY, 1).unwrap();
    }
    for more in [0, 1, 5] {
        first.advance(f64::INFINITY, more).unwrap();
        continues_to(&alone, &model, &mut first, "balls");
    }
}

#[test]
fn balls_whose_elements_fail_are_gone_and_the_books_stay_closed() {
    let mut model = oblique("hex8", false, Interface::default(), 0.0);
    model.parts[1].velocity = [2.0, 1.0, -60.0];
    let failure = [("plastic_strain".to_string(), 0.05)].into();
    let parameters = [("young", 1e9), ("poisson", 0.3), ("density", 1e3), ("yield", 2e6), ("hardening", 1e7)]
        .map(|(key, value)| (key.to_string(), value))
        .into();
    model.materials.insert("weak".into(), Material { law: "j2".into(), parameters, failure, ..Material::default() });
    model.parts.iter_mut().for_each(|part| part.material = "weak".into());
    model.run.energy_limit = 1.0;
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    let eroded = summary.erosion.as_ref().map_or(0, |eroded| eroded.elements.iter().map(|(_, count)| *count).sum::<usize>());
    println!("{} eroded, ledger {:.1e}, energy {:.1e}", eroded, summary.ledger_residual, summary.energy_drift);
    assert!(
        eroded > 1 && history.largest(DEPTH) > 0.0 && summary.ledger_residual < 1e-10 && summary.momentum_drift_linear.unwrap() < 1e-12
    );
}

#[test]
fn what_is_inside_at_the_start_is_reported_or_counts_as_touching() {
    let with = |initial_penetration: InitialPenetration| {
        let mut model = model(1e-3);
        add_box(&mut model, "lower", "hex8", ([0.1; 3], [2; 3]), [0.0; 3], |x| x);
        add_box(&mut model, "upper", "hex8", ([0.1; 3], [2; 3]), [0.0; 3], |[x, y, z]| [x + 0.01, y + 0.013, z + 0.099]);
        meet(&mut model, true, Interface { initial_penetration, ..Interface::default() });
        model
    };
    let reported = faults(&with(InitialPenetration::Error));
    assert!(!reported.is_empty() && reported[0].contains("1.000e-3 m inside at the start"), "{reported:?}");
    let simulation = to_end(&with(InitialPenetration::Ignore));
    assert!(value(&simulation, "energy.contact") < 1e-9 && value(&simulation, "energy.kinetic") < 1e-9);
}

#[test]
fn a_body_in_contact_with_itself_feels_nothing_while_it_only_spins() {
    for element in ["hex8", "tet4"] {
        let mut model = model(2e-3);
        add_box(&mut model, "lower", element, ([0.3, 0.1, 0.02], [6, 2, 1]), [0.0; 3], |x| x);
        meet(&mut model, false, Interface { thickness: 0.01, ..Interface::default() });
        model.parts[0].spin = 50.0;
        let (simulation, history) = run(&model);
        assert!(history.largest(DEPTH) < 1e-5 && simulation.summary().energy_drift < 1e-3, "{element}: {} m", history.largest(DEPTH));
    }
}
