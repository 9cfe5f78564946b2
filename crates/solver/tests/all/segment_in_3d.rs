//! Facets against facets: the patch test between meshes that differ, flat and curved; conservation with every
//! element, law and friction; objectivity, sides that are exchanged, states.

use crate::bodies::*;
use crate::long::is_long;
use embate_solver::element::ELEMENTS_OF_SPACE;
use embate_solver::model::{
    Constraint, Contact, ContactLaw, Curve, Drive, Formulation, Friction, ImportedMesh, Interface, Model, Part, Partners, Penalty, Probe,
    ProbeAt, Relaxation, Shape,
};
use embate_solver::simulation::Simulation;
use std::sync::Arc;

type Vector = [f64; 3];

const FRICTION: Friction = Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };

/// A grid of cells of any element on the unit cube, mapped by `place`, with groups of its bottom, top and all
/// of the body. A grid `around` closes in its first direction.
pub(crate) fn add_grid(
    model: &mut Model,
    name: &str,
    element: &str,
    cells: [usize; 3],
    around: bool,
    velocity: Vector,
    place: impl Fn(Vector) -> Vector,
) {
    let [nx, ny, nz] = cells;
    let columns = if around { nx } else { nx + 1 };
    let number = move |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * columns + i % columns) as u32;
    let places = (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..columns).map(move |i| [i, j, k])));
    let positions = places.map(|at| place([0, 1, 2].map(|d| at[d] as f64 / cells[d] as f64))).collect();
    let nodes = ELEMENTS_OF_SPACE.iter().find(|kind| kind.name == element).unwrap().nodes();
    let [mut all, mut bottom, mut top] = [const { Vec::<Vec<u32>>::new() }; 3];
    for (i, j, k) in (0..nx * ny * nz).map(|cell| (cell % nx, cell / nx % ny, cell / nx / ny)) {
        let corner = |c: [usize; 3]| number(i + c[0], j + c[1], k + c[2]);
        let hexahedron = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(corner);
        let (cut, faces): (&[&[usize]], &[&[usize]]) = match nodes {
            8 => (&[&[0, 1, 2, 3, 4, 5, 6, 7]], &[&[0, 1, 2, 3]]),
            6 => (&[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]], &[&[0, 1, 2], &[0, 2, 3]]),
            _ => (&[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]], &[&[0, 1, 2], &[0, 2, 3]]),
        };
        let of = |cell: &[usize]| cell.iter().map(|&c| hexahedron[c]).collect::<Vec<u32>>();
        all.extend(cut.iter().map(|cell| of(cell)));
        if k == 0 {
            bottom.extend(faces.iter().map(|face| of(face)));
        }
        if k == nz - 1 {
            top.extend(faces.iter().map(|face| of(&face.iter().map(|&c| c + 4).collect::<Vec<_>>())));
        }
    }
    let groups = vec![
        group(&format!("{name}-body"), 3, all.into_iter()),
        group(&format!("{name}-bottom"), 2, bottom.into_iter()),
        group(&format!("{name}-top"), 2, top.into_iter()),
    ];
    model.meshes.push(Arc::new(ImportedMesh { source: "test".into(), positions, groups, ..ImportedMesh::default() }));
    model.parts.push(Part {
        name: name.into(),
        material: "soft".into(),
        element: element.into(),
        shape: Shape::Group { mesh: model.meshes.len() - 1, group: format!("{name}-body") },
        velocity,
        ..Part::default()
    });
    model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: name.into() }, ..Probe::default() });
}

fn segments(name: &str, first: &str, second: &str, interface: Interface) -> Contact {
    Contact { formulation: Formulation::Segment, interface, ..Contact::between(name, first, second) }
}

pub(crate) fn rotated(n: Vector, angle: f64, v: Vector) -> Vector {
    let (sin, cos) = angle.sin_cos();
    let across = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
    let along = (1.0 - cos) * (0..3).map(|d| n[d] * v[d]).sum::<f64>();
    [0, 1, 2].map(|d| cos * v[d] + sin * across[d] + along * n[d])
}

/// Nodes within the joint and within the blocks moved aside; the rims stay where they are.
pub(crate) fn crooked([x, y, z]: Vector, by: f64) -> Vector {
    let wave = |a: f64| (std::f64::consts::PI * a).sin();
    let bump = by * wave(x) * wave(y);
    [x + bump * (1.0 + z), y - 0.7 * bump * (1.0 - 0.5 * z), z + 0.5 * bump * wave(z)]
}

/// Two blocks of 1 m × 1 m × 0.5 m, one on the other, pressed together by 5 mm at the top until they rest:
/// the largest spread of a component of the stress among all elements, against the mean of σ_zz. The blocks
/// are `crooked` by so much.
fn patch_error(elements: [&str; 2], cells: [[usize; 3]; 2], crookedness: [f64; 2], penalty: Penalty) -> f64 {
    let mut model = slender(30.0, 1e6, 1000.0);
    // Without a path: what waves do on the way leaves nothing.
    model.materials.get_mut("soft").unwrap().law = "neo_hookean".into();
    let block = |from: f64, by: f64| {
        move |x: Vector| {
            let [x, y, z] = crooked(x, by);
            [x, y, from + 0.5 * z]
        }
    };
    add_grid(&mut model, "lower", elements[0], cells[0], false, [0.0; 3], block(0.0, crookedness[0]));
    add_grid(&mut model, "upper", elements[1], cells[1], false, [0.0; 3], block(0.5, crookedness[1]));
    model.curves.insert("press".into(), Curve::table(vec![0.0, 0.1, 0.1001], vec![-0.05, -0.05, 0.0]));
    let still = || Some(Drive::from(0.0));
    let mut hold = |on: &str, velocity| model.constraints.push(Constraint { on: on.into(), velocity, ..Constraint::default() });
    hold("lower-bottom", [still(), still(), still()]);
    hold("upper-top", [still(), still(), Some(Drive::Curve("press".into()))]);
    // Smooth contact does not hold the blocks above each other.
    hold("lower", [still(), still(), None]);
    hold("upper", [still(), still(), None]);
    model.contacts.push(segments("seam", "lower-top", "upper-bottom", penalty.into()));
    model.run.relaxation = Some(Relaxation { tolerance: 1e-20, from: 0.11 });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    assert!(simulation.time() < 29.0, "it rests");
    assert_eq!(simulation.sweeps().1, 0, "{elements:?} {cells:?}: forces that were not solved");
    let frame = simulation.frame();
    let stresses = &frame.fields.iter().find(|field| field.kind.name == "stress").unwrap().values;
    let all: Vec<&[f64]> = stresses.chunks_exact(6).collect();
    let mean = all.iter().map(|s| s[2]).sum::<f64>() / all.len() as f64;
    assert!(mean < -2e3, "{mean}");
    let spread = |k: usize| {
        let [low, high] = all.iter().map(|s| s[k]).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
        (high - low) / mean.abs()
    };
    (0..6).map(spread).fold(0.0, f64::max)
}

#[test]
fn facets_pass_the_patch_test_on_any_two_meshes() {
    let cells = [[3, 3, 2], [4, 5, 2]];
    let cases = [
        (["hex8", "hex8"], cells, Penalty::automatic(1.0)),
        (["tet4", "hex8"], cells, Penalty::automatic(1.0)),
        (["wedge6", "tet4"], cells, Penalty::automatic(1.0)),
        (["hex8", "hex8"], cells, Penalty::Pressure(1e9)),
        (["hex8", "hex8"], [[3, 3, 2]; 2], Penalty::automatic(1.0)),
        (["hex8", "tet4"], cells, Penalty::automatic(1.0)),
        (["wedge6", "hex8"], cells, Penalty::automatic(1.0)),
    ];
    let count = if is_long() { cases.len() } else { 3 };
    for (elements, cells, penalty) in cases.into_iter().take(count) {
        let error = patch_error(elements, cells, [0.06, -0.05], penalty);
        println!("{elements:?} {cells:?} {penalty:?}: {error:.1e}");
        assert!(error < 1e-10, "{elements:?} {cells:?} {penalty:?}: {error}");
    }
    // Facets nearly corner on corner: some 0.4, 0.9, 1.4 and 9 millionths of each lie over its neighbours.
    let crooked: &[f64] = if is_long() { &[2e-7, 4e-7, 6e-7, 4e-6] } else { &[4e-7, 4e-6] };
    for &crookedness in crooked {
        let error = patch_error(["hex8", "hex8"], [[3, 3, 2]; 2], [0.0, crookedness], Penalty::automatic(1.0));
        println!("nearly alike, {crookedness}: {error:.1e}");
        assert!(error < 1e-10, "nearly alike, {crookedness}: {error}");
    }
}

/// Tubes in each other, the inner one under pressure from inside, with unlike elements around: the largest
/// deviation of the pressure from its mean among the nodes of the joint. It is deep against the chords of
/// both.
fn curved_error(elements: [&str; 2], cells: [[usize; 3]; 2]) -> f64 {
    let mut model = slender(6.0, 1e6, 1000.0);
    let tube = |inner: f64, outer: f64| {
        move |[u, v, w]: Vector| {
            // Around clockwise, so that elements run outwards.
            let (sin, cos) = (-std::f64::consts::TAU * u).sin_cos();
            let r = inner + (outer - inner) * w;
            [r * cos, r * sin, -0.1 * v]
        }
    };
    add_grid(&mut model, "inner", elements[0], cells[0], true, [0.0; 3], tube(0.5, 0.75));
    add_grid(&mut model, "outer", elements[1], cells[1], true, [0.0; 3], tube(0.75, 1.0));
    for part in ["inner", "outer"] {
        let velocity = [None, None, Some(Drive::from(0.0))];
        model.constraints.push(Constraint { on: part.into(), velocity, ..Constraint::default() });
    }
    model.curves.insert("grow".into(), Curve::table(vec![0.0, 0.3, 100.0], vec![0.0, 1.0, 1.0]));
    let load = embate_solver::model::Load::Pressure { on: "inner-bottom".into(), pressure: 2e4, curve: Some("grow".into()) };
    model.loads.push(load);
    let mut interface: Interface = Penalty::Pressure(2e6).into();
    interface.initial_penetration = embate_solver::model::InitialPenetration::Ignore;
    model.contacts.push(segments("joint", "inner-top", "outer-bottom", interface));
    model.run.relaxation = Some(Relaxation { tolerance: 1e-8, from: 0.31 });
    let mut simulation = simulation(&model);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let frame = simulation.frame();
    let pressure = &frame.fields.iter().find(|field| field.kind.name == "contact_pressure").unwrap().values;
    // At the ends nodes have the normal and the area of the ends too.
    let at = pressure.iter().zip(frame.positions::<3>()).filter(|(p, x)| **p > 0.0 && (x[2] + 0.05).abs() < 0.02);
    let on: Vec<f64> = at.map(|(p, _)| *p).collect();
    assert!(on.len() >= cells[0][0] + cells[1][0], "{}", on.len());
    let mean = on.iter().sum::<f64>() / on.len() as f64;
    on.iter().map(|p| (p / mean - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn on_curved_interfaces_the_pressure_is_even() {
    let pairs: &[[&str; 2]] = if is_long() { &[["hex8", "tet4"], ["wedge6", "hex8"]] } else { &[["hex8", "tet4"]] };
    for &elements in pairs {
        // The error falls with the square of the chords.
        let (cells, most) = if is_long() { ([[120, 2, 1], [150, 2, 1]], 0.01) } else { ([[60, 2, 1], [75, 2, 1]], 0.04) };
        let error = curved_error(elements, cells);
        println!("{elements:?} {cells:?}: {error:.1e}");
        assert!(error < most, "{elements:?} {cells:?}: {error}");
    }
}

fn turned(angle: f64) -> impl Fn(Vector) -> Vector {
    move |v| rotated([1.0 / 3f64.sqrt(); 3], angle, v)
}

/// Two boxes that hit each other obliquely and off their middles, all turned by an angle about the line
/// x = y = z.
fn oblique(element: &str, named: bool, interface: Interface, angle: f64) -> Model {
    let mut model = model(3e-3);
    let turn = turned(angle);
    let velocity = [[0.0, 0.0, 1.0], [2.0, 1.0, -9.0]].map(&turn);
    let lower = |[x, y, z]: Vector| turn([0.2 * x, 0.2 * y, 0.1 * z]);
    add_grid(&mut model, "lower", element, [4, 4, 2], false, velocity[0], lower);
    let upper = |x: Vector| {
        let [a, b, c] = rotated([0.6, 0.8, 0.0], 0.1, x.map(|x| 0.1 * x - 0.05));
        turn([a + 0.11, b + 0.12, c + 0.16])
    };
    add_grid(&mut model, "upper", element, [3, 3, 2], false, velocity[1], upper);
    let partners = if named { Partners::Between(["upper".into(), "lower".into()]) } else { Partners::Bodies(Vec::new()) };
    model.contacts.push(Contact { name: "hit".into(), partners, formulation: Formulation::Segment, interface, ..Contact::default() });
    model
}

fn laws() -> Vec<ContactLaw> {
    let soft_layer = ContactLaw::PressureGap { gaps: vec![-1e-3, -2e-4, 1e-4], pressures: vec![3e8, 2e7, 0.0] };
    vec![ContactLaw::default(), soft_layer, ContactLaw::Multiplier]
}

fn is_sound(simulation: &Simulation, drift: f64, case: &str) {
    let summary = simulation.summary();
    let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
    println!(
        "{case}: momenta {linear:.1e} {angular:.1e}, ledger {:.1e}, energy {:.1e}, depth {:.1e}, unverified {}, sweeps {:?}",
        summary.ledger_residual,
        summary.energy_drift,
        summary.penetration_max,
        summary.contact.unverified,
        simulation.sweeps()
    );
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
                assert!(history.last("upper.vz") > -7.0, "{case}: they met");
                assert!(friction.is_none() || history.last("energy.friction") > 0.0, "{case}");
            }
        }
    }
}

/// Positions at the end, turned back.
fn places(model: &Model, angle: f64) -> Vec<Vector> {
    let simulation = to_end(model);
    assert!(simulation.ledger().stores.friction > 0.0);
    let back = turned(-angle);
    simulation.frame().positions::<3>().iter().map(|&x| back(x)).collect()
}

/// How far places are from those of another list that are nearest, m.
pub(crate) fn apart(one: &[Vector], other: &[Vector]) -> f64 {
    let distance = |x: &Vector, y: &Vector| (0..3).map(|d| (x[d] - y[d]).powi(2)).sum::<f64>().sqrt();
    one.iter().map(|x| other.iter().map(|y| distance(x, y)).fold(f64::INFINITY, f64::min)).fold(0.0, f64::max)
}

#[test]
fn a_model_that_is_turned_or_whose_sides_are_exchanged_gives_the_same() {
    let interface = Interface { friction: Some(FRICTION), damping: 0.1, ..Interface::default() };
    let model = oblique("hex8", true, interface, 0.0);
    let straight = places(&model, 0.0);
    let interface = model.contacts[0].interface.clone();
    let far = apart(&straight, &places(&oblique("hex8", true, interface, 0.7), 0.7));
    let mut exchanged = model.clone();
    exchanged.contacts[0].partners = Partners::Between(["lower".into(), "upper".into()]);
    let other = apart(&straight, &places(&exchanged, 0.0));
    println!("turned {far:.1e} m, exchanged {other:.1e} m");
    assert!(far < 1e-11 && other < 1e-11, "{far} {other}");
}

#[test]
fn threads_and_a_stop_between_change_no_bit() {
    let model = oblique("hex8", true, Interface { friction: Some(FRICTION), ..Interface::default() }, 0.0);
    let alone = hash_of_equal_bits(&model, &[1, 3], "facets");
    let mut first = simulation(&model);
    while value(&first, "contact.force_z[hit]") == 0.0 {
        assert!(!first.is_over(), "they have to meet");
        first.advance(f64::INFINITY, 1).unwrap();
    }
    for more in [0, 1, 5] {
        first.advance(f64::INFINITY, more).unwrap();
        continues_to(&alone, &model, &mut first, "facets");
    }
}
