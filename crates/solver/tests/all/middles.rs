//! Meshes of four-node tetrahedra that become ones of ten nodes, and meshes that have ten; in 2D triangles of
//! three and six.

use crate::bodies::*;
use crate::patches::with_middles;
use crate::placed::{block, ten};
use embate_solver::model::{
    Constraint, Drive, Formulation, ImportedMesh, Load, LoadTerms, Model, Motion, Part, Polygon, Probe, ProbeAt, Shape,
};
use embate_solver::simulation::{Options, Simulation};
use std::sync::Arc;

/// Bodies of a mesh, each a group of its name with an element or what is taken for none, that are held at
/// `face`.
fn held(mesh: ImportedMesh, parts: &[(&str, &str)]) -> Model {
    let mut model = model(4e-3);
    model.meshes.push(Arc::new(mesh));
    for (name, element) in parts {
        let part = Part {
            name: (*name).into(),
            material: "soft".into(),
            shape: Shape::Group { mesh: 0, group: (*name).into() },
            velocity: [3.0, -2.0, 1.0],
            ..Part::default()
        };
        model.parts.push(if element.is_empty() { part } else { Part { element: (*element).into(), ..part } });
    }
    let velocity = [0; 3].map(|_| Some(Drive::Constant(0.0)));
    model.constraints.push(Constraint { on: "face".into(), velocity, ..Constraint::default() });
    model
}

fn nodes(simulation: &Simulation) -> usize {
    simulation.coordinates().len() / 3
}

fn fault(model: &Model) -> String {
    match Simulation::new(model, &Options { threads: 1, simd: None }) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_mesh_of_four_nodes_runs_bit_for_bit_as_that_of_ten_with_straight_edges() {
    for element in ["tet10", ""] {
        let mut hashes = Vec::new();
        for mesh in [block(4), ten(block(4))] {
            let mut model = held(mesh, &[("body", element)]);
            model.probes.push(Probe { name: "far".into(), at: ProbeAt::Set { set: "far".into() }, ..Probe::default() });
            let simulation = to_end(&model);
            // 5 × 3 × 3 corners, a node in the middle of every edge: those of the grid twice as fine.
            assert_eq!(nodes(&simulation), 9 * 5 * 5, "{element}");
            assert!(simulation.summary().steps > 20 && value(&simulation, "far.x") != 0.0);
            hashes.push(simulation.summary().state_hash);
        }
        assert_eq!(hashes[0], hashes[1], "{element}");
    }
}

#[test]
fn sides_and_sets_get_the_middles_and_a_pressure_acts_on_all_of_a_side() {
    for mesh in [block(4), ten(block(4))] {
        let mut model = held(mesh, &[("body", "")]);
        model.constraints.clear();
        model.loads.push(Load::Pressure { on: "face".into(), pressure: 1e5, curve: None });
        model.load_terms = vec![LoadTerms::default()];
        model.probes.push(Probe { name: "all".into(), at: ProbeAt::Set { set: "body".into() }, ..Probe::default() });
        let mut one = simulation(&model);
        let mass = one.overview().parts[0].mass;
        assert_eq!(one.nodes_of("face").unwrap().len(), 5 * 5);
        assert_eq!(one.nodes_of("far").unwrap().len(), 1);
        // The force p A along x moves the centre of mass.
        let before = value(&one, "all.x");
        one.advance(1e-3, u64::MAX).unwrap();
        let (force, time) = (1e5 * 0.25 * 0.125, one.time());
        let way = value(&one, "all.x") - before - 3.0 * time;
        assert!((way / (0.5 * force / mass * time * time) - 1.0).abs() < 0.02, "{way} {}", 0.5 * force / mass * time * time);
    }
    // A set of nodes that all edges at the face join is the whole face.
    let mut mesh = block(4);
    mesh.groups[1].dimension = 0;
    mesh.groups[1].cells = mesh.groups[1].cells.concat().into_iter().map(|node| vec![node]).collect();
    assert_eq!(simulation(&held(mesh, &[("body", "")])).nodes_of("face").unwrap().len(), 5 * 5);
}

#[test]
fn four_nodes_stay_where_they_are_wanted_and_ten_become_four() {
    for mesh in [block(4), ten(block(4))] {
        let simulation = to_end(&held(mesh, &[("body", "tet4")]));
        assert_eq!(nodes(&simulation), 5 * 3 * 3);
    }
}

#[test]
fn tetrahedra_beside_others_stay_as_they_are_and_nothing_hangs_in_silence() {
    // The first cell of the grid is two wedges; its six tetrahedra share edges with it.
    let wedges = {
        let mut mesh = block(4);
        let six = block(6).groups[0].cells[..2].to_vec();
        mesh.groups[0].cells.drain(..6);
        mesh.groups.push(group("wedges", 3, six.into_iter()));
        mesh
    };
    // A face of wedges is one quadrilateral, which two triangles do not close: they are apart there.
    let model = held(wedges.clone(), &[("body", ""), ("wedges", "")]);
    let left = simulation(&model);
    assert_eq!(nodes(&left), 5 * 3 * 3, "none has a node between corners");
    assert!(fault(&held(wedges.clone(), &[("body", "tet10"), ("wedges", "wedge6")])).contains("can't become `tet10`"));
    let mut hanging = ten(wedges);
    hanging.groups.iter_mut().for_each(|group| group.cells.iter_mut().for_each(|cell| cell.shrink_to_fit()));
    let message = fault(&held(hanging, &[("body", ""), ("wedges", "")]));
    assert!(message.contains("would hang free"), "{message}");
    // Two bodies of tetrahedra that share nodes change together, or not at all.
    let mut halves = block(4);
    let second = halves.groups[0].cells.split_off(48);
    halves.groups.push(group("half", 3, second.into_iter()));
    assert_eq!(nodes(&simulation(&held(halves.clone(), &[("body", ""), ("half", "")]))), 9 * 5 * 5);
    assert_eq!(nodes(&simulation(&held(halves.clone(), &[("body", ""), ("half", "tet4")]))), 5 * 3 * 3);
    assert!(fault(&held(halves.clone(), &[("body", "tet10"), ("half", "tet4")])).contains("can't become `tet10`"));
    // What is rigid needs none, unless it is connected with what has them.
    let rigid = |mut model: Model, parts: &[usize]| {
        model.constraints.clear();
        parts.iter().for_each(|&part| model.parts[part].rigid = Some(Motion::default()));
        nodes(&simulation(&model))
    };
    assert_eq!(rigid(held(block(4), &[("body", "")]), &[0]), 5 * 3 * 3);
    assert_eq!(rigid(held(block(4), &[("body", "tet10")]), &[0]), 9 * 5 * 5, "it is named");
    assert_eq!(rigid(held(halves, &[("body", ""), ("half", "")]), &[1]), 9 * 5 * 5);
}

/// A plate of triangles with its left side, of three nodes or six.
fn plate(is_six: bool) -> ImportedMesh {
    let mut mesh = mapped([4, 2], |u, v| [0.5 * u, 0.25 * v + 0.02 * u * v]);
    let halves = |cell: &Vec<u32>| [vec![cell[0], cell[1], cell[2]], vec![cell[0], cell[2], cell[3]]];
    mesh.groups[0].cells = mesh.groups[0].cells.iter().flat_map(halves).collect();
    if is_six {
        let mut plane: Vec<[f64; 2]> = mesh.positions.iter().map(|x| [x[0], x[1]]).collect();
        let cells = with_middles(&mut plane, &mesh.groups[0].cells.concat());
        mesh.groups[0].cells = cells.chunks(6).map(<[u32]>::to_vec).collect();
        mesh.positions = plane.into_iter().map(in_3d).collect();
    }
    mesh.groups.truncate(1);
    mesh.groups.push(group("face", 1, [vec![0, 5], vec![5, 10]].into_iter()));
    mesh.groups.push(group("far", 0, [vec![14]].into_iter()));
    mesh
}

/// The same as [`held`] with what triangles are.
fn of_triangles(mesh: ImportedMesh, parts: &[(&str, &str)], state: &str) -> Model {
    let mut model = held(mesh, parts);
    for (part, (_, triangles)) in model.parts.iter_mut().zip(parts) {
        part.velocity = [3.0, -2.0, 0.0];
        part.stress_state = state.into();
        if !triangles.is_empty() {
            (part.element, part.element_triangles) = ("quad4".into(), (*triangles).into());
        }
    }
    model.constraints.iter_mut().for_each(|constraint| constraint.velocity[2] = None);
    model
}

#[test]
fn triangles_of_three_nodes_get_their_middles_where_they_are_named_and_run_as_those_of_six() {
    for state in ["plane_strain", "plane_stress", "axisymmetric"] {
        let name = plate(false).groups[0].name.clone();
        let run = |is_six: bool, triangles: &str| to_end(&of_triangles(plate(is_six), &[(&name, triangles)], state));
        let plane = |simulation: &Simulation| simulation.coordinates().len() / 2;
        let hashes = [(false, "tri6"), (true, "tri6"), (true, "")].map(|(is_six, triangles)| {
            let simulation = run(is_six, triangles);
            assert_eq!(plane(&simulation), 9 * 5, "{state} {triangles}");
            assert!(simulation.summary().steps > 20);
            assert_eq!(simulation.nodes_of("face").unwrap().len(), 5);
            simulation.summary().state_hash
        });
        assert!(hashes.iter().all(|hash| *hash == hashes[0]), "{state}: {hashes:?}");
        for (is_six, triangles) in [(false, ""), (false, "tri3"), (true, "tri3"), (true, "tri3_anp")] {
            assert_eq!(plane(&run(is_six, triangles)), 5 * 3, "{state} {triangles}");
        }
        // Of a part of triangles alone it may be the element, too.
        let mut model = of_triangles(plate(false), &[(&name, "")], state);
        model.parts[0].element = "tri6".into();
        assert_eq!(to_end(&model).summary().state_hash, hashes[0]);
    }
}

#[test]
fn a_pressure_acts_on_both_halves_of_a_side_and_triangles_beside_quadrilaterals_stay_as_they_are() {
    let name = plate(false).groups[0].name.clone();
    for is_six in [false, true] {
        let mut model = of_triangles(plate(is_six), &[(&name, "tri6")], "plane_strain");
        model.constraints.clear();
        model.loads.push(Load::Pressure { on: "face".into(), pressure: 1e5, curve: None });
        model.load_terms = vec![LoadTerms::default()];
        model.probes.push(Probe { name: "all".into(), at: ProbeAt::Set { set: name.clone() }, ..Probe::default() });
        let mut one = simulation(&model);
        let (mass, before) = (one.overview().parts[0].mass, value(&one, "all.x"));
        one.advance(1e-3, u64::MAX).unwrap();
        let (force, time) = (1e5 * 0.25, one.time());
        let way = value(&one, "all.x") - before - 3.0 * time;
        assert!((way / (0.5 * force / mass * time * time) - 1.0).abs() < 0.02, "{way}");
    }
    let mut mesh = mapped([4, 2], |u, v| [0.5 * u, 0.25 * v]);
    let name = mesh.groups[0].name.clone();
    let first = mesh.groups[0].cells.remove(0);
    mesh.groups[0].cells.extend([vec![first[0], first[1], first[2]], vec![first[0], first[2], first[3]]]);
    mesh.groups.truncate(1);
    mesh.groups.push(group("face", 0, [vec![0], vec![5], vec![10]].into_iter()));
    assert_eq!(to_end(&of_triangles(mesh.clone(), &[(&name, "")], "plane_strain")).coordinates().len() / 2, 15);
    assert!(fault(&of_triangles(mesh, &[(&name, "tri6")], "plane_strain")).contains("can't become `tri6`"));
}

#[test]
fn bodies_of_six_node_triangles_meet_and_keep_momentum_and_the_books() {
    let formulations = [Formulation::DoublePass, Formulation::SinglePass { slave: 1 }, Formulation::Segment, Formulation::Pinball];
    for formulation in formulations {
        let mut model = model(4e-4);
        for (name, [x, y], size, velocity) in [("lower", [0.0, 0.0], 0.03, [1.0, 6.0]), ("upper", [0.013, 0.1005], 0.021, [-2.0, -5.0])] {
            let outline = vec![[x, y], [x + 0.1, y + 0.003], [x + 0.1, y + 0.1], [x, y + 0.1]];
            add(&mut model, name, Shape::Polygon(Polygon { outline, size, ..Polygon::default() }), velocity);
            model.parts.last_mut().unwrap().element_triangles = "tri6".into();
        }
        touch(&mut model, "lower", "upper");
        model.contacts[0].formulation = formulation;
        let summary = to_end(&model).summary();
        let what = format!("{formulation:?}: {summary:?}");
        assert!(summary.penetration_max > 0.0 && summary.penetration_max < 1e-3, "{what}");
        assert!(summary.momentum_drift_linear.unwrap() <= 1e-12 && summary.momentum_drift_angular.unwrap() <= 1e-12, "{what}");
        assert!(summary.ledger_residual <= 1e-12 && summary.energy_drift <= 0.01, "{what}");
    }
}
