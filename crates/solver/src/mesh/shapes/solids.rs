//! Contract tests of solids: every shape in 3D, and every shape in 2D that is pulled or turned.

use super::*;
use crate::mesh::Mesh;
use crate::mesh::cell::{Cell, CellKind};
use crate::mesh::dimension::corner_volumes;
use crate::mesh::surface::tributary::vector_shares;
use crate::mesh::surface::{Corners, exterior};
use crate::model::{ImportedMesh, MeshGroup, Model};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// ∫ dV by the outside: ⅓ Σ x_a · ∫ N_a n dA, exact for these elements.
fn volume(body: &Body<3>) -> f64 {
    let of_facet = |facet: &[u32; 4]| {
        let corners = facet.map(|node| body.positions[node as usize]);
        let shares = vector_shares(corners, facet.corners().len() == 3);
        corners.iter().zip(shares).map(|(x, n)| (x[0] * n[0] + x[1] * n[1] + x[2] * n[2]) / 3.0).sum::<f64>()
    };
    exterior::<3>(body.cells()).unwrap().iter().map(of_facet).sum()
}

/// Smallest Jacobian at a corner of an element over the mean of the element's corners.
fn quality(body: &Body<3>) -> f64 {
    let of_cell = |cell: Cell<'_>| {
        let corners: Vec<[f64; 3]> = cell.nodes.iter().map(|&node| body.positions[node as usize]).collect();
        let volumes: Vec<f64> = corner_volumes(cell.kind, &corners).collect();
        volumes.iter().copied().fold(f64::INFINITY, f64::min) / (volumes.iter().sum::<f64>() / volumes.len() as f64)
    };
    body.cells().map(of_cell).fold(f64::INFINITY, f64::min)
}

fn part(shape: &Shape, sweep: Option<Sweep>) -> Part {
    Part { name: "body".into(), shape: shape.clone(), sweep, ..Part::default() }
}

fn body(part: &Part) -> Body<3> {
    part.solid_body().unwrap().unwrap_or_else(|fault| panic!("{:?} {:?}: {fault}", part.shape, part.sweep))
}

/// What must hold for every body of a part.
fn is_sound(part: &Part) -> Body<3> {
    let body = body(part);
    let what = format!("{:?} {:?}", part.shape, part.sweep);
    assert!(quality(&body) > 0.0, "{} {what}", quality(&body));
    // Sides together are the whole outside, each piece seen from outside; a side may be a part of another.
    let of_sides: BTreeSet<[u32; 4]> = body.sides.iter().flat_map(|side| side.1.iter().map(|facet| facet.canonical())).collect();
    let of_cells: BTreeSet<[u32; 4]> = exterior::<3>(body.cells()).unwrap().into_iter().collect();
    assert_eq!(of_sides, of_cells, "{what}");
    for (name, facets) in &body.sides {
        let once: BTreeSet<[u32; 4]> = facets.iter().map(|facet| facet.canonical()).collect();
        assert_eq!(once.len(), facets.len(), "{name} of {what}");
    }
    let names: Vec<&String> = body.sides.iter().map(|side| &side.0).chain(body.points.iter().map(|it| &it.0)).collect();
    let mut promised = part.sides();
    promised.sort_unstable();
    let mut made: Vec<String> = names.into_iter().cloned().collect();
    made.sort_unstable();
    assert_eq!(made, promised, "{what}");
    let (count, made) = (part.count().unwrap(), [body.positions.len(), body.cells().count()]);
    if count.exact {
        assert_eq!([count.nodes, count.elements], made, "{what}");
    } else {
        let about = |count: usize, made: usize| made <= 2 * count && count <= 10 * made;
        assert!(about(count.nodes, made[0]) && about(count.elements, made[1]), "{count:?} {made:?} {what}");
    }
    let used: BTreeSet<u32> = body.cells().flat_map(|cell| cell.nodes).copied().collect();
    assert_eq!(used.len(), body.positions.len(), "every node is used: {what}");
    let size = body.positions.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    let places: BTreeSet<[i64; 3]> = body.positions.iter().map(|x| x.map(|x| (x / size * 1e8).round() as i64)).collect();
    assert_eq!(places.len(), body.positions.len(), "no two nodes are in one place: {what}");
    body
}

#[test]
fn every_solid_is_sound_and_none_has_flat_corners() {
    for n in [1, 2, 3, 4, 7] {
        for (shape, _) in Shape::solid_examples(n) {
            let body = is_sound(&part(&shape, None));
            assert!(body.cells().all(|cell| cell.kind == CellKind::Hexahedron));
            if matches!(shape, Shape::Sphere(_) | Shape::Cylinder(_)) {
                assert!(quality(&body) > 0.2, "{} {shape:?}", quality(&body));
            }
        }
    }
}

#[test]
fn the_volume_of_every_solid_is_exact_or_converges_with_the_square_of_the_element_size() {
    let errors = |n| -> Vec<f64> {
        Shape::solid_examples(n).iter().map(|(shape, exact)| (volume(&body(&part(shape, None))) / exact - 1.0).abs()).collect()
    };
    for ((coarse, fine), (shape, _)) in errors(6).into_iter().zip(errors(12)).zip(Shape::solid_examples(12)) {
        assert!(fine < 1e-12 || (fine < 0.05 && (3.0..5.5).contains(&(coarse / fine))), "{coarse} {fine} {shape:?}");
    }
}

/// Area and ∫ x dA of a section.
fn section(body: &Body<2>) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for cell in body.cells() {
        for t in 1..cell.nodes.len() - 1 {
            let [p, q, r] = [0, t, t + 1].map(|k| body.positions[cell.nodes[k] as usize]);
            let area = 0.5 * numbers::cross(numbers::minus(q, p), numbers::minus(r, p));
            sum = [sum[0] + area, sum[1] + area * (p[0] + q[0] + r[0]) / 3.0];
        }
    }
    sum
}

#[test]
fn every_shape_of_2d_becomes_a_solid() {
    for (shape, _) in [3, 7].iter().flat_map(|&n| Shape::examples(n)) {
        let plane = shape.built_in().unwrap().0.body().unwrap();
        let extrude = Sweep::Extrude(Extrude { from: -0.5, length: 2.0, elements: 3, grading: 2.0 });
        if !plane.all::<2>(CellKind::Line).is_empty() {
            continue; // the check refuses bars
        }
        let [area, moment] = section(&plane);
        let body = is_sound(&part(&shape, Some(extrude.clone())));
        assert!((volume(&body) / (2.0 * area) - 1.0).abs() < 1e-11, "{shape:?}");
        for (name, z) in [("back", -0.5), ("front", 1.5)] {
            let side = &body.sides.iter().find(|side| side.0 == name).unwrap().1;
            assert!(side.len() == plane.cells().count() && side.iter().flatten().all(|&node| body.positions[node as usize][2] == z));
        }
        // About a line beside it, from either side: each layer has the volume ∫ d dA sin δ.
        let x = plane.positions.iter().map(|x| x[0]).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        for (beside, axis) in [(x[0] - 0.3, [0.0, 2.0]), (x[1] + 0.4, [0.0, 1.0]), (x[0] - 0.3, [0.0, -1.0])] {
            for (angle, elements) in [(0.25 * TAU, 3), (TAU, 5)] {
                let turned = part(&shape, Some(Sweep::Revolve(Revolve { axis, point: [beside, 7.0], angle, elements })));
                let body = is_sound(&turned);
                let exact = (moment - beside * area).abs() * elements as f64 * (angle / elements as f64).sin();
                assert!((volume(&body) / exact - 1.0).abs() < 1e-11, "{shape:?} {angle}");
                assert!(angle > 6.0 || body.positions.iter().all(|x| x[2] >= 0.0), "towards z first: {shape:?}");
            }
        }
    }
}

#[test]
fn elements_with_a_side_on_the_axis_become_wedges_and_tetrahedra() {
    let rectangle = Shape::Rectangle(Rectangle { corner: [1.0, 0.0], size: [2.0, 1.0], elements: [3, 2], ..Rectangle::default() });
    for (point, axis) in [([1.0, 0.0], [0.0, 1.0]), ([3.0, 0.0], [0.0, -1.0])] {
        let revolve = |angle, elements| Some(Sweep::Revolve(Revolve { axis, point, angle, elements }));
        let body = is_sound(&part(&rectangle, revolve(TAU, 8)));
        assert_eq!((body.all::<8>(CellKind::Hexahedron).len(), body.all::<6>(CellKind::Wedge).len()), (4 * 8, 2 * 8));
        let volume_of = |elements: f64, angle: f64| 2.0 * elements * (angle / elements).sin();
        assert!((volume(&body) - volume_of(8.0, TAU)).abs() < 1e-13);
        let body = is_sound(&part(&rectangle, revolve(FRAC_PI_2, 2)));
        assert!((volume(&body) - volume_of(2.0, FRAC_PI_2)).abs() < 1e-13);
        let vanished = if point[0] == 1.0 { "left" } else { "right" };
        assert!(body.sides.iter().all(|(name, facets)| facets.is_empty() == (name == vanished)));
    }
    // Two triangles with one side on the axis: a double cone.
    let mut section = Body { positions: vec![[0.0, -1.0], [0.0, 1.0], [1.0, 0.0]], ..Body::default() };
    section.extend(CellKind::Triangle, [[0, 2, 1]]);
    section.sides.push(("outer".into(), vec![[1, 2], [2, 0]]));
    let sweep = Sweep::Revolve(Revolve { elements: 6, ..Revolve::default() });
    let body = sweep.swept(&section).unwrap();
    assert_eq!((body.all::<4>(CellKind::Tetrahedron).len(), body.positions.len()), (6, 8));
    assert!(quality(&body) > 0.0);
    assert!((volume(&body) - 6.0 * (TAU / 6.0).sin() / 3.0).abs() < 1e-15);
    let outside: BTreeSet<[u32; 4]> = exterior::<3>(body.cells()).unwrap().into_iter().collect();
    assert_eq!(outside, body.sides[0].1.iter().map(|facet| facet.canonical()).collect());
}

#[test]
fn what_can_not_be_turned_is_reported_with_the_place() {
    let wrong = |section: &Body<2>, revolve: Revolve| Sweep::Revolve(revolve).swept(section).unwrap_err().message;
    let square = rectangle([0.0, 0.0], [1.0, 1.0], [1, 1]);
    assert!(wrong(&square, Revolve { axis: [1.0, 1.0], ..Revolve::default() }).contains("both sides of the axis"));
    assert!(wrong(&square, Revolve { axis: [1.0, -1.0], ..Revolve::default() }).contains("one corner on the axis"));
    let flat = Body { positions: vec![[0.0, 0.0], [0.0, 1.0]], ..Body::default() };
    assert!(wrong(&flat, Revolve::default()).contains("no extent"));
}

/// A mesh file with two quadrilaterals side by side in groups of their own, lines and points.
fn plane_mesh() -> ImportedMesh {
    let group = |name: &str, dimension, cells| MeshGroup { name: name.into(), dimension, cells };
    ImportedMesh {
        source: "two.msh".into(),
        positions: [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]].map(|[x, y]| [f64::from(x), f64::from(y), 0.0]).to_vec(),
        groups: vec![
            group("one", 2, vec![vec![0, 1, 4, 3]]),
            group("two", 2, vec![vec![1, 2, 5, 4]]),
            group("floor", 1, vec![vec![0, 1], vec![1, 2]]),
            group("between", 1, vec![vec![1, 4]]),
            group("corner", 0, vec![vec![0]]),
        ],
        ..ImportedMesh::default()
    }
}

#[test]
fn groups_of_a_mesh_file_that_are_swept_alike_share_nodes_and_keep_their_names() {
    let part = |name: &str, sweep: Option<Sweep>| Part {
        name: format!("part-{name}"),
        shape: Shape::Group { mesh: 0, group: name.into() },
        sweep,
        ..Part::default()
    };
    let extrude = |length| Some(Sweep::Extrude(Extrude { length, elements: 2, ..Extrude::default() }));
    let model = |parts| Model { meshes: vec![Arc::new(plane_mesh())], parts, ..Model::default() };
    let mesh = Mesh::<3>::new(&model(vec![part("one", extrude(2.0)), part("two", extrude(2.0))])).unwrap();
    assert_eq!((mesh.positions.len(), mesh.bodies().into_iter().max()), (18, Some(0)));
    assert_eq!(mesh.surface("floor", |_| false).unwrap().facets.len(), 4);
    assert_eq!(mesh.nodes("between").unwrap().len(), 6);
    assert!(mesh.surface("between", |_| false).is_err(), "it is inside");
    assert_eq!(mesh.nodes("corner").unwrap().len(), 3);
    let front = mesh.surface("part-two.front", |_| false).unwrap();
    assert!(front.facets.len() == 1 && front.nodes.iter().all(|&node| mesh.positions[node as usize][2] == 2.0));
    assert_eq!(mesh.outside(&[]).unwrap().facets.len(), 2 + 2 + 4 + 4 + 2 + 2);
    // Swept otherwise, each has its own.
    let mesh = Mesh::<3>::new(&model(vec![part("one", extrude(2.0)), part("two", extrude(3.0))])).unwrap();
    assert_eq!((mesh.positions.len(), mesh.bodies().into_iter().max()), (24, Some(1)));
    let faults =
        Mesh::<3>::new(&model(vec![part("one", Some(Sweep::Revolve(Revolve { axis: [1.0, 1.0], ..Revolve::default() })))])).unwrap_err();
    assert!(faults[0].path == "part[0].revolve.axis" && faults[0].message.contains("both sides"), "{faults:?}");
}

#[test]
fn a_solid_has_the_same_nodes_in_the_same_order_from_a_shape_and_from_a_file() {
    let shape = Shape::Sphere(Sphere { elements: 4, portion: "quarter".into(), ..Sphere::default() });
    let made = body(&part(&shape, None));
    let model = Model { parts: vec![part(&shape, None)], ..Model::default() };
    let first = Mesh::<3>::new(&model).unwrap();
    // The file has everything the other way round, and each element begins elsewhere.
    let n = made.positions.len() as u32;
    let turned = |cell: Cell<'_>| [6, 7, 3, 2, 5, 4, 0, 1].map(|k: usize| n - 1 - cell.nodes[k]).to_vec();
    let outer = made.sides[0].1.iter().rev().map(|facet| facet.map(|node| n - 1 - node).to_vec()).collect();
    let group = |name: &str, dimension, cells| MeshGroup { name: name.into(), dimension, cells };
    let file = ImportedMesh {
        source: "file".into(),
        positions: made.positions.iter().rev().copied().collect(),
        groups: vec![group("all", 3, made.cells().map(turned).collect::<Vec<_>>().into_iter().rev().collect()), group("skin", 2, outer)],
        ..ImportedMesh::default()
    };
    let parts = vec![Part { name: "body".into(), shape: Shape::Group { mesh: 0, group: "all".into() }, ..Part::default() }];
    let second = Mesh::<3>::new(&Model { parts, meshes: vec![Arc::new(file)], ..Model::default() }).unwrap();
    assert_eq!(first.positions, second.positions);
    assert_eq!(first.groups[0].connectivity, second.groups[0].connectivity);
    let [mut one, mut two] = [first.surface("body.outer", |_| false), second.surface("skin", |_| false)].map(|it| it.unwrap().facets);
    one.sort_unstable();
    two.sort_unstable();
    assert_eq!(one, two);
    // Nodes outside come first, and the user's numbers lead back.
    let outside = first.outside(&[]).unwrap();
    assert_eq!(outside.nodes, (0..outside.nodes.len() as u32).collect::<Vec<_>>());
    assert!(first.user_nodes.iter().zip(&first.positions).all(|(&user, x)| made.positions[user as usize] == *x));
    assert!(first.positions.len() > outside.nodes.len());
}

#[test]
fn erosion_uncovers_what_was_behind() {
    let shape = Shape::Cuboid(Cuboid { elements: [3, 3, 3], ..Cuboid::default() });
    let mut mesh = Mesh::<3>::new(&Model { parts: vec![part(&shape, None)], ..Model::default() }).unwrap();
    let top = mesh.surface("body.top", |_| false).unwrap();
    assert_eq!(top.facets.len(), 9);
    let at_top: Vec<usize> = (0..27)
        .filter(|&element| top.facets.iter().any(|facet| facet.iter().all(|node| mesh.groups[0].nodes_of(element).contains(node))))
        .collect();
    // The one whose other neighbours are all there: in the middle of the top.
    let middle = at_top.iter().copied().find(|&element| {
        let centre = mesh.groups[0]
            .nodes_of(element)
            .iter()
            .map(|&node| mesh.positions[node as usize])
            .fold([0.0; 3], |s, x| [s[0] + x[0], s[1] + x[1], s[2] + x[2]]);
        (centre[0] / 8.0 - 0.5).abs() < 1e-9 && (centre[2] / 8.0 - 0.5).abs() < 1e-9
    });
    mesh.groups[0].erode(middle.unwrap());
    assert_eq!((mesh.surface("body.top", |_| false).unwrap().facets.len(), mesh.outside(&[]).unwrap().facets.len()), (8, 54 - 1 + 5));
}

#[test]
fn an_element_that_is_inside_out_is_reported_with_its_number_and_place() {
    let cells: BTreeMap<&str, Vec<u32>> = [("good", vec![0, 1, 2, 3]), ("bad", vec![0, 2, 1, 3])].into();
    for (name, cell) in cells {
        let group = |name: &str, dimension, cells| MeshGroup { name: name.into(), dimension, cells };
        let file = ImportedMesh {
            source: "file".into(),
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            groups: vec![group("all", 3, vec![cell])],
            ..ImportedMesh::default()
        };
        let parts = vec![Part { name: "body".into(), shape: Shape::Group { mesh: 0, group: "all".into() }, ..Part::default() }];
        let model = Model { parts, meshes: vec![Arc::new(file)], ..Model::default() };
        assert_eq!(model.dimension(), 3);
        match Mesh::<3>::new(&model) {
            Ok(mesh) => assert!(name == "good" && mesh.groups[0].kind == CellKind::Tetrahedron10),
            Err(faults) => {
                let reported = &faults[0].message;
                assert!(
                    name == "bad"
                        && reported.contains("element 0")
                        && reported.contains("(0.000000e0, 0.000000e0, 0.000000e0) has negative volume")
                );
            }
        }
    }
}
