//! Whole models in 3D against their halves and quarters: what symmetry planes cut off, in nodes, edges and
//! images, moves as the whole does.

use crate::bodies::*;
use crate::edge_edge::{Block, DEPTH, HALF, WIDTH, meet};
use embate_solver::model::{
    Contact, ContactLaw, Drive, Formulation, ImportedMesh, Interface, Material, Model, Motion, Partners, Penalty, Symmetry,
};
use embate_solver::simulation::Simulation;
use std::sync::Arc;

type Vector = [f64; 3];

const AXES: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn plane(model: &mut Model, point: Vector, normal: Vector) {
    model.symmetries.push(Symmetry { point, normal, ..Symmetry::default() });
}

/// What the columns of two runs, step by step, differ by, relative to the largest one; `count` times the part
/// is the whole.
fn is_so_many_times(whole: &Model, part: &Model, count: f64, tolerance: f64, case: &str) {
    let [whole, part] = [whole, part].map(every_step);
    let most = ["energy.kinetic", "energy.internal"].into_iter().flat_map(|column| whole.column(column)).fold(0.0, f64::max);
    let mut worst = 0.0f64;
    for column in ["energy.kinetic", "energy.internal", "energy.contact", "energy.friction", "energy.eroded"] {
        let (all, one) = (whole.column(column), part.column(column));
        assert_eq!(all.len(), one.len(), "{case}: {column}");
        for (all, one) in all.iter().zip(&one) {
            worst = worst.max((all - count * one).abs() / most);
        }
    }
    println!("{case}: energies differ by {worst:.1e}");
    assert!(worst < tolerance, "{case}: {worst}");
}

/// How far the nodes of a part of a model are at the end from those of the whole which were where they were
/// at the start, m.
fn apart(whole: &Simulation, part: &Simulation, starts: [Vec<Vector>; 2]) -> f64 {
    let distance = |x: Vector, y: Vector| (0..3).map(|d| (x[d] - y[d]).powi(2)).sum::<f64>().sqrt();
    let [all, one] = [whole, part].map(|simulation| simulation.frame().positions::<3>().to_vec());
    let mut worst = 0.0f64;
    for (start, end) in starts[1].iter().zip(one) {
        let same = starts[0].iter().zip(&all).filter(|(there, _)| distance(*start, **there) < 1e-9);
        worst = worst.max(same.map(|(_, there)| distance(end, *there)).fold(f64::INFINITY, f64::min));
    }
    worst
}

fn starts(models: [&Model; 2]) -> [Vec<Vector>; 2] {
    models.map(|model| simulation(model).frame().positions::<3>().to_vec())
}

/// A half or quarter does what the whole does; how far their nodes are apart at the end, m.
fn compare(whole: &Model, part: &Model, count: f64, [way, energy]: [f64; 2], case: &str) -> [Simulation; 2] {
    let starts = starts([whole, part]);
    let both = [whole, part].map(to_end);
    for simulation in &both {
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-11 && summary.contact.unverified == 0, "{case}: {summary:?}");
    }
    // Nothing is held in a whole model, unless it is driven.
    let summary = both[0].summary();
    assert!(summary.momentum_drift_linear.is_none_or(|drift| drift < 1e-12), "{case}: {summary:?}");
    assert!(summary.momentum_drift_angular.is_none_or(|drift| drift < 1e-11), "{case}: {summary:?}");
    let by = apart(&both[0], &both[1], starts);
    println!("{case}: {by:.1e} m apart");
    assert!(by < way, "{case}: {by}");
    is_so_many_times(whole, part, count, energy, case);
    both
}

/// A small body beside what moves, on the planes x = 0 and, in a quarter, y = 0: without a node on it a plane
/// is none.
fn anchor(model: &mut Model, [x, y]: [bool; 2], size: f64, place: Vector) {
    let half = |is_cut: bool| if is_cut { [0.5 * size, 0.25 * size] } else { [size, 0.0] };
    let ([along, dx], [across, dy]) = (half(x), half(y));
    let cells = [x, y].map(|is_cut| if is_cut { 1 } else { 2 });
    let middle = [place[0] + dx, place[1] + dy, place[2]];
    Block { size: [along, across, size], cells: [cells[0], cells[1], 1], axes: AXES, middle }.add_to(model, "anchor", [0.0; 3]);
}

/// A beam on edge across two others, or the half of it across one: edges meet away from the plane x = 0.
fn beams(is_half: bool, interface: Interface) -> Model {
    let mut model = model(4e-3);
    model.run.time_step = Some(1.2e-5);
    let (length, cells) = (0.8, 8);
    let over = |from: f64, cells: usize| Block {
        size: [length - from, WIDTH, WIDTH],
        middle: [0.5 * from, 0.0, 2.0 * HALF + 1e-3],
        ..Block::on_edge(length, cells, 0.0, [0.0; 3])
    };
    let upper = if is_half { over(0.4, cells / 2) } else { over(0.0, cells) };
    upper.add_to(&mut model, "upper", [0.0, 0.6, -6.0]);
    let name = |side: f64| if side > 0.0 { "lower" } else { "beyond" };
    for side in if is_half { vec![1.0] } else { vec![1.0, -1.0] } {
        // Not across at right angles; the other one is its image.
        let beam = Block::on_edge(0.4, 5, 90.0 - 20.0 * side, [side * 0.23, 0.013, 0.0]);
        beam.add_to(&mut model, name(side), [0.0; 3]);
    }
    meet(&mut model, false, interface);
    if is_half {
        plane(&mut model, [0.0; 3], [1.0, 0.0, 0.0]);
    }
    model
}

#[test]
fn half_of_beams_that_cross_on_edge_does_what_the_whole_does() {
    for interface in [Interface::default(), rough(0.3), layer()] {
        let case = format!("{:?} {}", interface.law, interface.friction.is_some());
        let [whole, _] = compare(&beams(false, interface.clone()), &beams(true, interface), 2.0, [1e-12, 1e-11], &case);
        // They hit each other and part.
        assert!(value(&whole, "upper.vz") > -4.0 && value(&whole, DEPTH) == 0.0, "{case}");
    }
}

/// A law by a table that begins before surfaces meet.
fn layer() -> Interface {
    let law = ContactLaw::PressureGap { gaps: vec![-2e-3, -5e-4, 5e-4], pressures: vec![3e8, 4e7, 0.0] };
    Interface { law, ..Interface::default() }
}

/// A round body by its cube: the surface of the cube on that of a ball.
fn rounded(x: Vector) -> Vector {
    let most = x.iter().fold(0.0f64, |most, c| most.max(c.abs()));
    let size = x.iter().map(|c| c * c).sum::<f64>().sqrt();
    // Of a cube a ball, in the middle still a cube.
    let by = if size > 0.0 { 1.0 + most * (most / size * 1.3 - 1.0) } else { 1.0 };
    x.map(|c| c * by)
}

/// A ball between two slabs that close on it, whole or cut by x = 0 and y = 0: all in cells of the cube from
/// `low` to 1 along x and y.
fn squeezed_ball(low: f64, interface: Interface) -> Model {
    let mut model = model(6e-4);
    model.run.time_step = Some(2.5e-6);
    let cells = if low < 0.0 { 4 } else { 2 };
    let (size, middle) = (1.0 - low, 0.5 * (1.0 + low));
    let scale = 0.02;
    let mut add = |name: &str, size: Vector, cells: [usize; 3], middle: Vector, velocity: f64, place: &dyn Fn(Vector) -> Vector| {
        Block { size, cells, axes: AXES, middle }.add_to(&mut model, name, [0.0, 0.0, velocity]);
        let mut mesh = ImportedMesh::clone(model.meshes.last().unwrap());
        mesh.positions.iter_mut().for_each(|x| *x = place(*x).map(|c| c * scale));
        *model.meshes.last_mut().unwrap() = Arc::new(mesh);
    };
    add("ball", [size, size, 2.0], [cells, cells, 4], [middle, middle, 0.0], 0.0, &rounded);
    for (name, z, velocity) in [("upper", 1.6, -8.0), ("lower", -1.7, 6.0)] {
        let cells = if low < 0.0 { 6 } else { 3 };
        add(name, [size, size, 0.5], [cells, cells, 2], [middle, middle, z], velocity, &|[x, y, z]| [2.0 * x, 2.0 * y, z]);
    }
    // Slabs that stay flat, and the ball's nodes alone: on the planes nodes lie over edges of the other body,
    // and of two facets that lean there rounding would say which is the nearer one.
    for (slab, velocity) in [("upper", -8.0), ("lower", 6.0)] {
        let held = Some(Drive::from(0.0));
        stiffen(&mut model, slab, Motion { velocity: [held.clone(), held.clone(), Some(Drive::from(velocity))], spin: held });
        let formulation = Formulation::SinglePass { slave: 0 };
        model.contacts.push(Contact { formulation, interface: interface.clone(), ..Contact::between(slab, "ball", slab) });
    }
    if low == 0.0 {
        // Rigid parts are held by their motion.
        for normal in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
            model.symmetries.push(Symmetry { parts: vec!["ball".into()], normal, ..Symmetry::default() });
        }
    }
    model
}

#[test]
fn a_quarter_of_a_ball_between_slabs_does_what_the_whole_does() {
    // Between soft layers the whole ball, which nothing holds, can tip: what rounding makes of that grows
    // tenfold in 0.1 ms, from 1e-14 m at 0.2 ms on.
    for (interface, way) in [(Interface::default(), 1e-12), (rough(0.3), 1e-12), (layer(), 1e-11)] {
        let case = format!("{:?} {}", interface.law, interface.friction.is_some());
        let [whole, part] = compare(&squeezed_ball(-1.0, interface.clone()), &squeezed_ball(0.0, interface), 4.0, [way, 1e-9], &case);
        let squeezed = [&whole, &part].map(|simulation| value(simulation, "energy.internal"));
        assert!(squeezed[1] > 0.0 && (squeezed[0] / squeezed[1] - 4.0).abs() < 1e-6, "{case}: {squeezed:?}");
    }
}

/// An elastic-plastic metal, whose elements fail if reported.
fn metal(fails: bool) -> Material {
    let parameters = [("young", 70e9), ("poisson", 0.3), ("density", 2700.0), ("yield", 200e6), ("hardening", 2e9)];
    Material {
        law: "j2".into(),
        parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(),
        failure: if fails { [("plastic_strain".to_string(), 0.012)].into() } else { Default::default() },
        ..Material::default()
    }
}

/// Two bars that fly against each other, or one against its image in x = 0; held aside by four planes, which
/// makes them straight.
fn bars(is_half: bool, interface: Interface, fails: bool) -> Model {
    let mut model = model(1.2e-5);
    model.run.time_step = Some(1e-7);
    model.materials.insert("soft".into(), metal(fails));
    for side in if is_half { vec![1.0] } else { vec![1.0, -1.0] } {
        let block = Block { size: [0.02, 0.004, 0.004], cells: [10, 2, 2], axes: AXES, middle: [side * 0.0106, 0.0, 0.0] };
        block.add_to(&mut model, if side > 0.0 { "right" } else { "left" }, [-150.0 * side, 0.0, 0.0]);
    }
    let parts: Vec<String> = model.parts.iter().map(|part| part.name.clone()).collect();
    for normal in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        for side in [1.0, -1.0] {
            model.symmetries.push(Symmetry { parts: parts.clone(), point: normal.map(|c| 0.002 * side * c), normal, name: String::new() });
        }
    }
    anchor(&mut model, [is_half, false], 0.002, [0.0, 0.02, 0.0]);
    if is_half {
        plane(&mut model, [0.0; 3], [1.0, 0.0, 0.0]);
    }
    model.contacts.push(Contact { name: "hit".into(), partners: Partners::Bodies(Vec::new()), interface, ..Contact::default() });
    model
}

#[test]
fn a_bar_meets_its_image_as_two_bars_meet_each_other_whatever_the_law_and_whether_elements_fail() {
    for fails in [false, true] {
        let table = ContactLaw::PressureGap { gaps: vec![-4e-5, -1e-5, 1e-4], pressures: vec![4e9, 1e9, 0.0] };
        for law in [ContactLaw::default(), ContactLaw::Penalty(Penalty::Pressure(3e13)), table, ContactLaw::Multiplier] {
            let interface = Interface { law, ..Interface::default() };
            let case = format!("{:?} fails: {fails}", interface.law);
            let (whole, half) = (bars(false, interface.clone(), fails), bars(true, interface, fails));
            let starts = starts([&whole, &half]);
            let both = [&whole, &half].map(to_end);
            let by = apart(&both[0], &both[1], starts);
            println!("{case}: {by:.1e} m apart, {:?}", both[1].summary().erosion.map(|erosion| erosion.elements));
            assert_eq!(both[1].summary().erosion.is_some(), fails, "{case}");
            for simulation in &both {
                let summary = simulation.summary();
                println!("{:.1e} {:.1e}", summary.ledger_residual, summary.energy_drift);
                assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.02, "{case}: {summary:?}");
            }
            assert!(by < 1e-10, "{case}: {by}");
            is_so_many_times(&whole, &half, 2.0, 1e-8, &case);
        }
    }
}

/// A block that flies into the corner of two planes, without the row of elements at the corner, or all four
/// of them.
fn into_the_corner(is_quarter: bool, is_rigid: bool, interface: Interface) -> Model {
    let mut model = slender(2.5e-3, 1e9, 1e3);
    model.run.time_step = Some(1e-5);
    let sides: &[[f64; 2]] = if is_quarter { &[[1.0, 1.0]] } else { &[[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]] };
    for (number, [sx, sy]) in sides.iter().copied().enumerate() {
        let block = Block { size: [0.1; 3], cells: [4; 3], axes: AXES, middle: [0.0; 3] };
        let name = format!("block{number}");
        block.add_to(&mut model, &name, [-3.0 * sx, -2.0 * sy, 0.0]);
        if is_rigid {
            stiffen(&mut model, &name, Motion { velocity: [None, None, None], spin: Some(Drive::from(0.0)) });
        }
        let mut mesh = ImportedMesh::clone(model.meshes.last().unwrap());
        let at = |x: Vector| [sx * (x[0] + 0.052), sy * (x[1] + 0.0515), x[2]];
        let low = |cell: &Vec<u32>, d: usize| cell.iter().map(|&node| mesh.positions[node as usize][d]).sum::<f64>() / 8.0;
        let is_kept: Vec<bool> = mesh.groups[0].cells.iter().map(|cell| low(cell, 0) > -0.025 || low(cell, 1) > -0.025).collect();
        let mut kept = is_kept.iter();
        mesh.groups[0].cells.retain(|_| *kept.next().unwrap());
        mesh.positions.iter_mut().for_each(|x| *x = at(*x));
        if sx * sy < 0.0 {
            // Turned inside out by the image: the upper side of each element first.
            mesh.groups[0].cells.iter_mut().for_each(|cell| cell.rotate_left(4));
        }
        // Nodes of no element are none.
        let mut used = vec![None; mesh.positions.len()];
        mesh.groups[0].cells.iter().flatten().for_each(|&node| used[node as usize] = Some(0));
        let mut positions = Vec::new();
        for (place, x) in used.iter_mut().zip(&mesh.positions) {
            if let Some(place) = place {
                *place = positions.len() as u32;
                positions.push(*x);
            }
        }
        mesh.groups[0].cells.iter_mut().flatten().for_each(|node| *node = used[*node as usize].unwrap());
        mesh.positions = positions;
        *model.meshes.last_mut().unwrap() = Arc::new(mesh);
    }
    anchor(&mut model, [is_quarter; 2], 0.02, [0.0, 0.0, 0.3]);
    if is_quarter {
        plane(&mut model, [0.0; 3], [1.0, 0.0, 0.0]);
        plane(&mut model, [0.0; 3], [0.0, 1.0, 0.0]);
    }
    model.contacts.push(Contact { name: "hit".into(), partners: Partners::Bodies(Vec::new()), interface, ..Contact::default() });
    model
}

#[test]
fn a_block_meets_both_images_in_a_corner_of_two_planes_as_four_blocks_meet_each_other() {
    // Faces that stay flat: what is opposite is just as far as the image. Where waves bend them outward,
    // rounding says by which of four facets a node goes out of the other body: then the whole is no more
    // symmetric, and about the same.
    for (is_rigid, tolerance) in [(true, 1e-12), (false, 1e-2)] {
        for interface in [Interface::default(), Penalty::Pressure(1e12).into(), layer()] {
            let case = format!("{is_rigid} {:?}", interface.law);
            let models = [into_the_corner(false, is_rigid, interface.clone()), into_the_corner(true, is_rigid, interface)];
            let starts = starts([&models[0], &models[1]]);
            let both = [&models[0], &models[1]].map(to_end);
            let by = apart(&both[0], &both[1], starts);
            let velocities = ["block0.vx", "block0.vy", "block0.vz"].map(|column| [0, 1].map(|k| value(&both[k], column)));
            println!("{case}: {by:.1e} m apart, {velocities:?}");
            for simulation in &both {
                let summary = simulation.summary();
                println!("{:.1e} {:.1e} {:e}", summary.ledger_residual, summary.energy_drift, summary.penetration_max);
                assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{case}: {summary:?}");
                assert_eq!(summary.contact.unverified, 0, "{case}");
            }
            // It has met both planes, and flies away from both; nothing drives it along them.
            assert!(velocities[0][1] > 1.0 && velocities[1][1] > 0.5 && velocities[2][1].abs() < 1e-12, "{case}: {velocities:?}");
            for [whole, quarter] in velocities {
                assert!((whole - quarter).abs() < 3.0 * tolerance, "{case}: {velocities:?}");
            }
            assert!(by < tolerance * 3.0 * models[0].run.end, "{case}: {by}");
        }
    }
}
