//! Meshes of four-node tetrahedra that become ones of ten nodes, and meshes that have ten.

use crate::bodies::*;
use crate::placed::{block, ten};
use embate_solver::model::{Constraint, Drive, ImportedMesh, Load, LoadTerms, Model, Motion, Part, Probe, ProbeAt, Shape};
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
