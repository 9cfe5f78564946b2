//! Contact in 3D with friction depends on no numbering: corners of elements, nodes, elements and parts in
//! another order, or the whole model turned, give the same motion.

use crate::bodies::*;
use crate::edge_edge::{Block, DEPTH, HALF, WIDTH, meet};
use crate::patches::material;
use embate_solver::model::{ImportedMesh, Interface, Model, Partners};
use std::sync::Arc;

type Vector = [f64; 3];

/// Rotation by an angle about a unit axis.
fn rotated(n: Vector, angle: f64, v: Vector) -> Vector {
    let (sin, cos) = angle.sin_cos();
    let across = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
    let along = (1.0 - cos) * (0..3).map(|d| n[d] * v[d]).sum::<f64>();
    [0, 1, 2].map(|d| cos * v[d] + sin * across[d] + along * n[d])
}

const AXIS: Vector = [0.48, 0.6, 0.64];

/// Beams on edge that hit each other off their middles and slide: edges meet.
fn of_edges(interface: Interface) -> Model {
    let mut model = model(4e-3);
    Block::on_edge(0.5, 6, 70.0, [0.03, 0.04, 2.0 * HALF + 1e-3]).add_to(&mut model, "upper", [9.0, 5.0, -20.0]);
    Block::on_edge(0.5, 6, 0.0, [0.0; 3]).add_to(&mut model, "lower", [0.0; 3]);
    meet(&mut model, true, interface);
    model
}

/// A block that comes down on another one with a corner ahead, slides and turns: nodes meet facets.
fn of_nodes(interface: Interface) -> Model {
    let mut model = model(4e-3);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let tilted = axes.map(|axis| rotated([0.6, 0.8, 0.0], 0.3, rotated([0.0, 0.0, 1.0], 0.5, axis)));
    Block { size: [WIDTH; 3], cells: [2; 3], axes: tilted, middle: [0.011, 0.007, 0.122] }.add_to(&mut model, "upper", [9.0, 5.0, -20.0]);
    Block { size: [0.3, 0.25, 0.1], cells: [5, 4, 2], axes, middle: [0.0; 3] }.add_to(&mut model, "lower", [0.0; 3]);
    meet(&mut model, true, interface);
    model
}

/// The same of rubber, which folds: nodes lie in the bottoms of folds, where no facet is nearest.
fn of_folds(interface: Interface) -> Model {
    let mut model = of_nodes(interface);
    let mut rubber = material("neo_hookean", 0.45);
    rubber.parameters.insert("density".into(), 1e3);
    rubber.parameters.insert("young".into(), 4e6);
    model.materials.values_mut().for_each(|it| *it = rubber.clone());
    model
}

/// The corners of a hexahedron in an order that leaves it what it is.
fn corners(cell: &[u32], turns: usize) -> Vec<u32> {
    let quarter = [1, 2, 3, 0, 5, 6, 7, 4];
    // About the line from corner 0 to corner 6.
    let third = [0, 3, 7, 4, 1, 2, 6, 5];
    let mut cell = cell.to_vec();
    for turn in 0..turns {
        let order = if turn % 2 == 0 { quarter } else { third };
        cell = order.iter().map(|&k| cell[k]).collect();
    }
    cell
}

/// The same model with each mesh made again.
fn remade(model: &Model, make: impl Fn(&mut ImportedMesh)) -> Model {
    let mut model = model.clone();
    for mesh in &mut model.meshes {
        let mut made = ImportedMesh::clone(mesh);
        make(&mut made);
        *mesh = Arc::new(made);
    }
    model
}

fn with_other_corners(model: &Model) -> Model {
    remade(model, |mesh| {
        for (number, cell) in mesh.groups[0].cells.iter_mut().enumerate() {
            *cell = corners(cell, 1 + number % 5);
        }
    })
}

fn with_other_nodes(model: &Model) -> Model {
    remade(model, |mesh| {
        let last = mesh.positions.len() as u32 - 1;
        mesh.positions.reverse();
        for cell in &mut mesh.groups[0].cells {
            cell.iter_mut().for_each(|node| *node = last - *node);
        }
    })
}

fn with_other_elements(model: &Model) -> Model {
    remade(model, |mesh| mesh.groups[0].cells.reverse())
}

fn with_other_parts(model: &Model) -> Model {
    let mut model = model.clone();
    model.parts.reverse();
    for contact in &mut model.contacts {
        if let Partners::Between(both) = &mut contact.partners {
            both.reverse();
        }
    }
    model
}

fn turned(model: &Model, angle: f64) -> Model {
    let mut model = remade(model, |mesh| mesh.positions.iter_mut().for_each(|x| *x = rotated(AXIS, angle, *x)));
    model.parts.iter_mut().for_each(|part| part.velocity = rotated(AXIS, angle, part.velocity));
    model
}

/// Mirrored at x = 0.
fn mirrored(model: &Model) -> Model {
    let flip = |[x, y, z]: Vector| [-x, y, z];
    let mut model = remade(model, |mesh| {
        mesh.positions.iter_mut().for_each(|x| *x = flip(*x));
        for cell in &mut mesh.groups[0].cells {
            *cell = [4, 5, 6, 7, 0, 1, 2, 3].iter().map(|&k| cell[k]).collect();
        }
    });
    model.parts.iter_mut().for_each(|part| part.velocity = flip(part.velocity));
    model
}

const WAY: Vector = [1.3, -0.7, 2.1];

fn moved(model: &Model) -> Model {
    remade(model, |mesh| mesh.positions.iter_mut().for_each(|x| (0..3).for_each(|d| x[d] += WAY[d])))
}

/// Places at the start and at the end of each node, taken back to where the model was, m; and the deepest
/// penetration.
fn motion(model: &Model, back: impl Fn(&Vector) -> Vector) -> (Vec<[Vector; 2]>, f64) {
    let start = simulation(model).frame();
    let (simulation, history) = run(model);
    assert!(simulation.ledger().stores.friction > 0.0);
    let end = simulation.frame();
    let both = start.positions::<3>().iter().zip(end.positions::<3>());
    (both.map(|(x, y)| [back(x), back(y)]).collect(), history.largest(DEPTH))
}

/// How far the nodes of two runs are apart at the end, at most, m.
fn apart(one: &[[Vector; 2]], other: &[[Vector; 2]]) -> f64 {
    let distance = |x: Vector, y: Vector| (0..3).map(|d| (x[d] - y[d]).powi(2)).sum::<f64>().sqrt();
    let of = |[start, end]: &[Vector; 2]| {
        let same = other.iter().filter(|[there, _]| distance(*start, *there) < 1e-9);
        same.map(|[_, there]| distance(*end, *there)).fold(f64::INFINITY, f64::min)
    };
    one.iter().map(of).fold(0.0, f64::max)
}

#[test]
fn friction_of_nodes_and_edges_hangs_on_no_numbering_and_on_no_direction() {
    let mut worst = Vec::new();
    for (name, of) in [("nodes", of_nodes as fn(Interface) -> Model), ("edges", of_edges), ("folds", of_folds)] {
        for coefficient in [0.05, 0.6] {
            let model = of(rough(coefficient));
            let (straight, deepest) = motion(&model, |x| *x);
            assert!(deepest > 1e-4, "{name}: {deepest}");
            type Back = fn(&Vector) -> Vector;
            let cases: [(&str, Model, Back); 7] = [
                ("corners", with_other_corners(&model), |x| *x),
                ("nodes", with_other_nodes(&model), |x| *x),
                ("elements", with_other_elements(&model), |x| *x),
                ("parts", with_other_parts(&model), |x| *x),
                ("turned", turned(&model, 0.7), |x| rotated(AXIS, -0.7, *x)),
                ("mirrored", mirrored(&model), |&[x, y, z]| [-x, y, z]),
                ("moved", moved(&model), |x| [0, 1, 2].map(|d| x[d] - WAY[d])),
            ];
            for (case, other, back) in cases {
                let by = apart(&straight, &motion(&other, back).0);
                println!("{name} {coefficient}: other {case}: {by:.1e} m");
                worst.push((name, coefficient, case, by));
            }
        }
    }
    for (name, coefficient, case, by) in worst {
        assert!(by < 1e-10, "{name} {coefficient}: other {case}: {by}");
    }
}
