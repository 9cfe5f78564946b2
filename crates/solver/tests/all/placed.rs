//! Meshes of files that are placed: mirrored, turned, moved and copied they run as the same mesh written
//! there, and as the built-in shape placed so; masses, centres and inertia in closed form; names of groups.

use crate::beams::rectangle as bar;
use crate::bodies::*;
use crate::shells::section;
use crate::solids::with_middles;
use embate_solver::model::{
    Constraint, Contact, Copies, Cuboid, Drive, Extrude, FieldValues, ImportedMesh, Interface, Line, Load, LoadTerms, MeshField, MeshGroup,
    Mirror, Model, Obstacle, Part, Partners, Placement, Probe, ProbeAt, Rectangle, Shape, ShellLayer, ShellSection, Sweep,
};
use embate_solver::simulation::Simulation;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

type Vector = [f64; 3];

/// Mirrored on x = 1/4, turned by a quarter about (1/2, 0), moved, and there twice, the second turned by
/// another quarter about (4, 0): all coordinates stay fractions of two, so that nothing rounds.
fn exact() -> Placement {
    Placement {
        mirror: Some(Mirror { normal: [2.0, 0.0, 0.0], point: [0.25, 0.0, 0.0] }),
        rotation: FRAC_PI_2,
        rotation_point: [0.5, 0.0, 0.0],
        translation: [1.5, 0.25, 0.0],
        copies: Some(Copies { count: 2, translation: [0.5, -0.125, 0.0], angle: FRAC_PI_2, point: [4.0, 0.0, 0.0], ..Copies::default() }),
        ..Placement::default()
    }
}

/// The same by hand; zero has one sign.
fn by_hand([x, y, z]: Vector, copy: usize) -> Vector {
    let mirrored = [0.5 - x, y];
    let turned = [0.5 - mirrored[1], mirrored[0] - 0.5];
    let moved = [turned[0] + 1.5, turned[1] + 0.25];
    let again = [4.0 - moved[1] + 0.5, moved[0] - 4.0 - 0.125];
    let [x, y] = if copy == 0 { moved } else { again };
    [x + 0.0, y + 0.0, z]
}

/// A cell seen in a mirror, numbered such that it is no image any more.
fn turned_over(dimension: u8, in_3d: bool, cell: &[u32]) -> Vec<u32> {
    match (dimension, cell.len()) {
        (1, 2) if in_3d => cell.to_vec(),
        (3, 4) => vec![cell[1], cell[0], cell[2], cell[3]],
        (3, 10) => [1, 0, 2, 3, 4, 6, 5, 8, 7, 9].map(|k: usize| cell[k]).to_vec(),
        (3, n) => [&cell[n / 2..], &cell[..n / 2]].concat(),
        _ => cell.iter().rev().copied().collect(),
    }
}

/// The mesh that a placed one is, written down.
fn written(mesh: &ImportedMesh, in_3d: bool) -> ImportedMesh {
    let nodes = mesh.positions.len() as u32;
    let group = |group: &MeshGroup| {
        let copies = (0..2).flat_map(|copy| group.cells.iter().map(move |cell| (copy, cell)));
        let cells = copies
            .map(|(copy, cell)| turned_over(group.dimension, in_3d, &cell.iter().map(|node| node + copy * nodes).collect::<Vec<_>>()));
        MeshGroup { cells: cells.collect(), ..group.clone() }
    };
    let field = |field: &MeshField| {
        let values = match &field.values {
            FieldValues::Nodes(values) => FieldValues::Nodes([&values[..], values].concat()),
            FieldValues::Corners(_) => panic!("by node"),
        };
        MeshField { values, ..field.clone() }
    };
    ImportedMesh {
        source: "written".into(),
        positions: (0..2).flat_map(|copy| mesh.positions.iter().map(move |&x| by_hand(x, copy))).collect(),
        groups: mesh.groups.iter().map(group).collect(),
        fields: mesh.fields.iter().map(field).collect(),
        ..ImportedMesh::default()
    }
}

/// A grid of hexahedra, of wedges or of tetrahedra, with the face at x = 0 and a node of the opposite one.
pub(crate) fn block(nodes: usize) -> ImportedMesh {
    let [nx, ny, nz] = [4, 2, 2];
    let number = |[i, j, k]: [usize; 3]| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let mut positions = Vec::new();
    for (k, j) in (0..=nz).flat_map(|k| (0..=ny).map(move |j| (k, j))) {
        positions.extend((0..=nx).map(|i| [i as f64 / 8.0, j as f64 / 8.0, k as f64 / 16.0]));
    }
    let (mut cells, mut face) = (Vec::new(), Vec::new());
    for [i, j, k] in (0..nx * ny * nz).map(|cell| [cell % nx, cell / nx % ny, cell / nx / ny]) {
        let hexahedron = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
        let hexahedron = hexahedron.map(|c| number([i + c[0], j + c[1], k + c[2]]));
        let of = |cell: &[usize]| cell.iter().map(|&c| hexahedron[c]).collect::<Vec<u32>>();
        match nodes {
            8 => cells.push(hexahedron.to_vec()),
            6 => cells.extend([of(&[0, 1, 2, 4, 5, 6]), of(&[0, 2, 3, 4, 6, 7])]),
            _ => {
                let ways = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]];
                cells.extend(ways.iter().map(|way| of(way)));
            }
        }
        if i == 0 {
            match nodes {
                4 => face.extend([of(&[0, 3, 7]), of(&[0, 7, 4])]),
                _ => face.push(of(&[0, 3, 7, 4])),
            }
        }
    }
    let far = vec![number([nx, ny, nz])];
    let groups = vec![group("body", 3, cells.into_iter()), group("face", 2, face.into_iter()), group("far", 0, [far].into_iter())];
    ImportedMesh { source: "block".into(), positions, groups, ..ImportedMesh::default() }
}

/// The same of ten nodes: those between the corners in the middles of the edges, in the order of Abaqus.
pub(crate) fn ten(mut mesh: ImportedMesh) -> ImportedMesh {
    let body = mesh.groups.iter_mut().find(|group| group.name == "body").unwrap();
    let cells = with_middles(&mut mesh.positions, &body.cells.concat());
    body.cells = cells.chunks(10).map(<[u32]>::to_vec).collect();
    mesh
}

/// Quadrilaterals and triangles in a plane, with the line at x = 0 and a node of the opposite one.
fn plate() -> ImportedMesh {
    let mut mesh = mapped([4, 2], |u, v| [0.5 * u, 0.25 * v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    for (number, cell) in cells.into_iter().enumerate() {
        match number % 3 {
            0 => mesh.groups[0].cells.extend([vec![cell[0], cell[1], cell[2]], vec![cell[0], cell[2], cell[3]]]),
            _ => mesh.groups[0].cells.push(cell),
        }
    }
    mesh.groups.push(group("face", 1, [vec![0, 5], vec![5, 10]].into_iter()));
    mesh.groups.push(group("far", 0, [vec![14]].into_iter()));
    mesh
}

/// A chain of lines, its first piece, and its end.
fn chain(in_3d: bool) -> ImportedMesh {
    let mut positions: Vec<Vector> = (0..5).map(|k| [k as f64 / 8.0, (k * k) as f64 / 64.0, 0.0]).collect();
    if in_3d {
        positions.iter_mut().enumerate().for_each(|(k, x)| x[2] = k as f64 / 16.0);
    }
    let body = group("body", 1, (0..4).map(|k| vec![k, k + 1]));
    let groups = vec![body, group("face", 1, [vec![0, 1]].into_iter()), group("far", 0, [vec![4]].into_iter())];
    ImportedMesh { source: "chain".into(), positions, groups, ..ImportedMesh::default() }
}

/// A shell that is stiff below and soft above.
fn layered() -> ShellSection {
    let layer = |material: &str, thickness: f64| ShellLayer { material: material.into(), thickness, angle: 0.0, points: None };
    ShellSection { reference: "lower".into(), ..ShellSection::of_layers(vec![layer("stiff", 0.01), layer("soft", 0.03)]) }
}

/// A body of a mesh that moves, with a pressure on its face, unless it has none, and a force on its far node.
fn loaded(mesh: ImportedMesh, part: Part, has_face: bool) -> Model {
    let mut model = model(4e-3);
    model.materials.insert("stiff".into(), elastic(5e9, 2e3));
    model.meshes.push(Arc::new(mesh));
    let shape = Shape::Group { mesh: 0, group: "body".into() };
    let velocity = [3.0, -2.0, 0.0];
    model.parts.push(Part { name: "part".into(), material: "soft".into(), shape, velocity, spin: 20.0, ..part });
    if has_face {
        model.loads.push(Load::Pressure { on: "face".into(), pressure: 1e6, curve: None });
    }
    model.loads.push(Load::Force { on: "part.far".into(), force: [2e4, 1e4, 0.0], curve: None });
    model.load_terms = vec![LoadTerms::default(); model.loads.len()];
    model
}

/// Every kind of body that a mesh file can be.
fn every_body(mut check: impl FnMut(&str, ImportedMesh, Part, bool, bool)) {
    let of = |element: &str| Part { element: element.into(), ..Part::default() };
    check("plane", plate(), of("quad4"), true, false);
    check("hexahedra", block(8), of("hex8_reduced"), true, true);
    check("wedges", block(6), of("wedge6"), true, true);
    check("tetrahedra", block(4), of("tet4"), true, true);
    check("tetrahedra that get their middles", block(4), of("tet10"), true, true);
    check("ten-node tetrahedra", ten(block(4)), of("tet10"), true, true);
    check("shell in 2D", chain(false), Part { section: Some(layered()), ..of("shell2") }, true, false);
    let mut sheet = plate();
    sheet.positions.iter_mut().for_each(|x| x[2] = x[0] * x[0] / 2.0);
    let cells = sheet.groups[0].cells[..3].to_vec();
    sheet.groups[1] = group("face", 2, cells.into_iter());
    check("shell in 3D", sheet.clone(), Part { section: Some(layered()), ..of("shell4") }, true, true);
    let thicknesses = (0..sheet.positions.len()).map(|node| Some(0.01 + 0.001 * node as f64)).collect();
    sheet.fields = vec![MeshField { name: "t".into(), values: FieldValues::Nodes(thicknesses) }];
    let by_field = ShellSection { thickness: 0.0, thickness_field: "t".into(), ..section(0.0) };
    check("shell by a field", sheet, Part { section: Some(by_field), ..of("shell4") }, true, true);
    let mut profile = bar(0.02, 0.03);
    profile.up = Some([0.0, 0.5, 1.0]);
    check("beams", chain(true), Part { profile: Some(profile), ..of("beam2") }, false, true);
    check("bars", chain(false), Part { area: Some(1e-4), ..of("bar2") }, false, false);
}

/// Places and velocities of all nodes, bit by bit, whatever their numbers.
fn bits(simulation: &Simulation) -> Vec<Vec<u64>> {
    let (places, velocity) = (simulation.coordinates(), simulation.field("velocity").unwrap());
    let dimension = simulation.dimension();
    let rows = places.chunks(dimension).zip(velocity.values.chunks(dimension));
    let mut all: Vec<Vec<u64>> = rows.map(|(x, v)| x.iter().chain(v).map(|value| (value + 0.0).to_bits()).collect()).collect();
    all.sort();
    all
}

#[test]
fn a_placed_mesh_runs_bit_for_bit_as_the_same_mesh_written_there() {
    every_body(|case, mesh, part, has_face, in_3d| {
        let placed = loaded(mesh.clone(), Part { placement: exact(), ..part.clone() }, has_face);
        let other = loaded(written(&mesh, in_3d), part.clone(), has_face);
        let [one, two] = [&placed, &other].map(to_end);
        assert!(one.summary().steps > 20, "{case}: {}", one.summary().steps);
        assert!(bits(&one) == bits(&two), "{case}");
        for (column, (a, b)) in one.history_columns().iter().zip(one.history_row().iter().zip(two.history_row())) {
            assert!((a - b).abs() <= 1e-12 * b.abs().max(1e-9), "{case}, {column}: {a} {b}");
        }
        // What is not there is another body.
        let plain = to_end(&loaded(mesh, part, has_face));
        assert!(bits(&plain) != bits(&one), "{case}");
        let hash = hash_of_equal_bits(&placed, &[2], case);
        let mut half = simulation(&placed);
        half.advance(2e-3, u64::MAX).unwrap();
        continues_to(&hash, &placed, &mut half, case);
    });
}

#[test]
fn a_placed_mesh_runs_bit_for_bit_as_the_built_in_shape_placed_so() {
    let placement = Placement {
        mirror: Some(Mirror { normal: [1.0, 0.7, 0.0], point: [0.1, 0.0, 0.0] }),
        rotation: 0.3,
        rotation_point: [0.2, -0.1, 0.0],
        translation: [0.013, 0.007, 0.0],
        copies: Some(Copies { count: 3, angle: 0.4, point: [3.0, 0.0, 0.0], ..Copies::default() }),
        ..Placement::default()
    };
    let check = |case: &str, shape: Shape, mesh: ImportedMesh, sweep: Option<Sweep>, part: Part| {
        let of = |shape: Shape, on: &str| {
            let mut model = model(2e-3);
            model.materials.insert("stiff".into(), elastic(5e9, 2e3));
            model.meshes.extend((matches!(shape, Shape::Group { .. })).then(|| Arc::new(mesh.clone())));
            let part = Part { sweep: sweep.clone(), placement: placement.clone(), ..part.clone() };
            model.parts.push(Part { name: "part".into(), material: "soft".into(), shape, velocity: [3.0, 1.0, 0.0], ..part });
            // Forces on a surface in 3D add up in the order of its facets, which a file has as it likes.
            if model.dimension() == 2 {
                model.loads.push(Load::Pressure { on: on.into(), pressure: 1e6, curve: None });
                model.load_terms = vec![LoadTerms::default()];
            } else {
                let velocity = [0; 3].map(|_| Some(Drive::Constant(0.0)));
                model.constraints.push(Constraint { on: on.into(), velocity, ..Constraint::default() });
            }
            to_end(&model).summary().state_hash
        };
        let group = Shape::Group { mesh: 0, group: "body".into() };
        assert_eq!(of(group.clone(), "part.left"), of(shape, "part.left"), "{case}");
        assert_ne!(of(group, "part.right"), of(Shape::Group { mesh: 0, group: "body".into() }, "part.left"), "{case}");
    };
    let element = |name: &str| Part { element: name.into(), ..Part::default() };
    let line = |name: &str, [i, n]: [u32; 2]| group(name, 1, (0..n).map(move |j| vec![j * 4 + i, (j + 1) * 4 + i]));
    let rectangle = Rectangle { size: [0.3, 0.2], elements: [3, 2], ..Rectangle::default() };
    let mut flat = mapped([3, 2], |u, v| [0.3 * u, 0.2 * v]);
    flat.positions = (0..3).flat_map(|j| (0..4).map(move |i| [0.3 * i as f64 / 3.0, 0.2 * j as f64 / 2.0, 0.0])).collect();
    flat.groups.extend([line("left", [0, 2]), line("right", [3, 2])]);
    check("plane", rectangle.clone().into(), flat.clone(), None, element("quad4"));
    let along = Sweep::Extrude(Extrude { from: 0.0, length: 0.2, elements: 2, grading: 1.0 });
    check("extruded", rectangle.into(), flat, Some(along), element("hex8"));
    let points = vec![[0.0, 0.0], [0.4, 0.0]];
    let mut lines = chain(false);
    lines.positions = (0..5).map(|k| [0.4 * k as f64 / 4.0, 0.0, 0.0]).collect();
    lines.groups.truncate(1);
    let shell = Part { section: Some(layered()), ..element("shell2") };
    check("shell", Shape::Line(Line { points, radius: 0.0, closed: false, elements: 4 }), lines, None, shell);
    // The sides of a box are groups of a file that has the same box.
    let size = [0.5, 0.25, 0.125];
    let mut solid = block(8);
    solid.groups[1].name = "left".into();
    let far = solid.groups[1].cells.iter().map(|cell| cell.iter().map(|node| node + 4).collect()).collect();
    solid.groups.push(MeshGroup { name: "right".into(), dimension: 2, cells: far });
    let cuboid = Cuboid { corner: [0.0; 3], size, elements: [4, 2, 2], ..Cuboid::default() };
    check("solid", Shape::Cuboid(cuboid), solid, None, element("hex8"));
}

/// A bar of the mesh `bar`, which is 1 m long and has the ends `left` and `right`.
fn bars(end: f64) -> Model {
    let mut model = slender(end, 1e9, 1e3);
    let mut mesh = mapped([50, 1], |u, v| [u, 0.02 * v]);
    mesh.groups.push(group("left", 1, [vec![0, 51]].into_iter()));
    mesh.groups.push(group("right", 1, [vec![50, 101]].into_iter()));
    model.meshes.push(Arc::new(mesh));
    model
}

fn add_bar(model: &mut Model, name: &str, translation: Vector, velocity: f64) {
    add(model, name, Shape::Group { mesh: 0, group: "body".into() }, [velocity, 0.0]);
    model.parts.last_mut().unwrap().placement.translation = translation;
}

#[test]
fn two_parts_of_one_mesh_in_different_places_hit_each_other_and_exchange_their_velocities() {
    // Equal bars in plane strain without lateral strain: after 2 L/c each has the velocity of the other.
    let (gap, speed, celerity) = (1e-3, 1.0, 1e3);
    for by_names in [false, true] {
        let mut model = bars(gap / speed + 2.6 / celerity);
        add_bar(&mut model, "one", [0.0; 3], speed);
        add_bar(&mut model, "two", [1.0 + gap, 0.0, 0.0], 0.0);
        if by_names {
            touch(&mut model, "one.right", "two.left");
        } else {
            model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() });
        }
        let simulation = to_end(&model);
        let [one, two] = ["one.vx", "two.vx"].map(|column| value(&simulation, column));
        println!("{one} {two}");
        assert!(one.abs() < 0.02 * speed && (two - speed).abs() < 0.02 * speed, "{one} {two}");
        assert!(simulation.summary().momentum_drift_linear.unwrap() < 1e-12);
        // Without contact nothing happens: they share no node.
        model.contacts.clear();
        let alone = to_end(&model);
        assert!((value(&alone, "one.vx") - speed).abs() < 1e-12 && value(&alone, "two.vx").abs() < 1e-12);
    }
}

#[test]
fn copies_of_a_mesh_hit_each_other() {
    // A tower of three blocks that falls on a floor: each stops the one above it.
    let mut model = model(4e-3);
    add_mesh(&mut model, "tower", mapped([4, 4], |u, v| [0.1 * u, 0.1 * v]), [0.0, -2.0]);
    model.parts[0].placement.copies = Some(Copies { count: 3, translation: [0.0, 0.101, 0.0], ..Copies::default() });
    model.obstacles.push(Obstacle::wall("floor", [0.0, -0.001, 0.0], [0.0, 1.0, 0.0]));
    // Bottom and top of each, whose nodes follow each other.
    let heights = |simulation: &Simulation| {
        let places = simulation.coordinates();
        let of = |block: &[f64]| {
            let y = || block.as_chunks::<2>().0.iter().map(|x| x[1]);
            [y().fold(f64::INFINITY, f64::min), y().fold(f64::NEG_INFINITY, f64::max)]
        };
        places.chunks(50).map(of).collect::<Vec<[f64; 2]>>()
    };
    let through = heights(&to_end(&model));
    assert!(through.len() == 3 && through[1][0] < through[0][1] - 2e-3, "without contact they overlap: {through:?}");
    model.contacts.push(Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() });
    let (simulation, history) = run(&model);
    let on_each_other = heights(&simulation);
    println!("{on_each_other:?}");
    assert!(on_each_other.windows(2).all(|two| two[1][0] > two[0][1] - 1e-4), "{on_each_other:?}");
    assert!(history.largest("energy.contact") > 0.0);
    let summary = simulation.summary();
    assert!(summary.energy_drift < 5e-3 && summary.ledger_residual < 1e-12 && summary.contact.unverified == 0, "{summary:?}");
}

#[test]
fn mass_centre_and_inertia_of_a_placed_mesh_are_those_of_the_closed_form() {
    // A rectangle a × b of n × m cells whose mass is at its nodes has I = M ((a² + b²)/12 + (h² + k²)/6) with
    // h = a/n, k = b/m; so many of them around a point that of each and M d² of each.
    let ([a, b], [n, m], spin) = ([0.6, 0.2], [6, 3], 7.0);
    let mut model = model(1e-6);
    add_mesh(&mut model, "body", mapped([n, m], |u, v| [0.3 + a * u, 0.4 + b * v]), [0.0; 2]);
    let (angle, about, translation) = (0.7, [1.0, 2.0], [-0.3, 0.9]);
    let part = &mut model.parts[0];
    part.placement = Placement {
        rotation: angle,
        rotation_point: [about[0], about[1], 0.0],
        translation: [translation[0], translation[1], 0.0],
        copies: Some(Copies { count: 5, angle: 2.0 * PI / 5.0, point: [1.0, -2.0, 0.0], ..Copies::default() }),
        ..Placement::default()
    };
    part.spin = spin;
    let turned = |[x, y]: [f64; 2]| [angle.cos() * x - angle.sin() * y, angle.sin() * x + angle.cos() * y];
    let arm = turned([0.3 + 0.5 * a - about[0], 0.4 + 0.5 * b - about[1]]);
    let centre = [about[0] + arm[0] + translation[0], about[1] + arm[1] + translation[1]];
    let distance = (centre[0] - 1.0).powi(2) + (centre[1] + 2.0).powi(2);
    let mass = 1e3 * a * b;
    let cells = (a / n as f64).powi(2) + (b / m as f64).powi(2);
    let inertia = 5.0 * mass * ((a * a + b * b) / 12.0 + cells / 6.0 + distance);
    let simulation = simulation(&model);
    assert!((simulation.overview().parts[0].mass / (5.0 * mass) - 1.0).abs() < 1e-13);
    let kinetic = value(&simulation, "energy.kinetic");
    assert!((kinetic / (0.5 * inertia * spin * spin) - 1.0).abs() < 1e-12, "{kinetic} {}", 0.5 * inertia * spin * spin);
    let [x, y] = ["body.x", "body.y"].map(|column| value(&simulation, column));
    assert!((x - 1.0).abs() < 1e-12 && (y + 2.0).abs() < 1e-12, "the middle of all is where they turn about: {x} {y}");
    // One alone, in 3D and mirrored: its centre.
    let mut solid = loaded(block(8), Part { element: "hex8".into(), ..Part::default() }, false);
    solid.probes.push(Probe { name: "all".into(), at: ProbeAt::Set { set: "part".into() }, ..Probe::default() });
    solid.parts[0].placement = Placement {
        mirror: Some(Mirror { normal: [0.0, 0.0, 1.0], point: [0.0; 3] }),
        rotation: 2.0 * PI / 3.0,
        rotation_axis: [1.0; 3],
        ..Placement::default()
    };
    let simulation = crate::bodies::simulation(&solid);
    assert!((simulation.overview().parts[0].mass / (1e3 * 0.5 * 0.25 * 0.125) - 1.0).abs() < 1e-13);
    let place = ["x", "y", "z"].map(|axis| value(&simulation, &format!("all.{axis}")));
    // (x, y, z) goes to (z, x, y) with z mirrored.
    assert!(place.iter().zip([-0.0625, 0.25, 0.125]).all(|(x, wanted)| (x - wanted).abs() < 1e-14), "{place:?}");
}

#[test]
fn groups_of_a_mesh_in_several_places_are_named_with_a_part() {
    let mut model = bars(1e-3);
    add_bar(&mut model, "one", [0.0; 3], 0.0);
    add_bar(&mut model, "two", [2.0, 0.0, 0.0], 0.0);
    let places = |model: &Model, set: &str| {
        let mut model = model.clone();
        model.probes = vec![Probe { name: "set".into(), at: ProbeAt::Set { set: set.into() }, ..Probe::default() }];
        value(&simulation(&model), "set.x")
    };
    assert_eq!([places(&model, "one.left"), places(&model, "two.left"), places(&model, "two.right")], [0.0, 2.0, 3.0]);
    let held = |model: &Model, on: &str| {
        let mut model = model.clone();
        let velocity = [Some(Drive::Constant(0.0)), None, None];
        model.constraints.push(Constraint { on: on.into(), velocity, ..Constraint::default() });
        faults(&model).join("\n")
    };
    assert_eq!(held(&model, "two.left"), "");
    for (name, words) in [
        ("left", &["group `left` is in 2 places, with the parts `one` and `two`", "`one.left` or `two.left`"][..]),
        ("two.lft", &["part `two` has no side or group `lft`", "did you mean `left`?"]),
        ("two.top", &["part `two` has no side or group `top`", "known are `body`, `left`, `right`"]),
        ("three.left", &["there is no part, side or group `three.left`", "known are `one`, `two`"]),
    ] {
        let told = held(&model, name);
        assert!(words.iter().all(|word| told.contains(word)), "{told}");
    }
    // The name alone will do where only one place has the group's elements, or it is there once.
    model.parts.pop();
    assert_eq!([places(&model, "left"), places(&model, "one.left")], [0.0; 2]);
    let mut mesh = mapped([4, 1], |u, v| [4.0 * u, v]);
    let cells = std::mem::take(&mut mesh.groups[0].cells);
    mesh.groups = vec![group("a", 2, cells[..2].iter().cloned()), group("b", 2, cells[2..].iter().cloned())];
    mesh.groups.push(group("start", 1, [vec![0, 5]].into_iter()));
    mesh.groups.push(group("end", 1, [vec![4, 9]].into_iter()));
    mesh.groups.push(group("middle", 1, [vec![2, 7]].into_iter()));
    let mut model = crate::bodies::model(1e-3);
    add_groups(&mut model, mesh, &["a", "b"], [0.0; 2]);
    model.parts[1].placement.translation = [10.0, 0.0, 0.0];
    assert_eq!([places(&model, "start"), places(&model, "end"), places(&model, "b.middle")], [0.0, 14.0, 12.0]);
    assert!(held(&model, "middle").contains("in 2 places"), "{}", held(&model, "middle"));
    // In one place they are one body, and each of the two names the group.
    model.parts[0].placement.translation = [10.0, 0.0, 0.0];
    assert_eq!([places(&model, "middle"), places(&model, "a.middle"), places(&model, "b.start")], [12.0, 12.0, 10.0]);
    let nodes: usize = simulation(&model).coordinates().len() / 2;
    assert_eq!(nodes, 10);
}

#[test]
fn where_a_mesh_can_not_be_is_told() {
    let told = |change: &dyn Fn(&mut Model), words: &[&str]| {
        let mut model = bars(1e-3);
        add_bar(&mut model, "one", [0.0; 3], 0.0);
        change(&mut model);
        let told = faults(&model).join("\n");
        assert!(words.iter().all(|word| told.contains(word)), "{words:?}: {told}");
    };
    let row = |count| Copies { count, ..Copies::default() };
    told(&|model| model.parts[0].placement.translation[2] = 1.0, &["part[0].translation", "leads out of the plane"]);
    told(&|model| model.parts[0].placement.copies = Some(row(2)), &["part[0].copies.count", "bodies 1 and 2"]);
    told(&|model| model.parts[0].placement.copies = Some(row(0)), &["part[0].copies.count"]);
    told(&|model| model.parts[0].placement.mirror = Some(Mirror { normal: [0.0; 3], point: [0.0; 3] }), &["part[0].mirror.normal"]);
    let many = Copies { count: 1 << 40, translation: [2.0, 0.0, 0.0], ..Copies::default() };
    told(&|model| model.parts[0].placement.copies = Some(many), &["million elements"]);
    // A mesh that is moved into itself.
    let all = || Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() };
    let inside = |model: &mut Model| {
        add_bar(model, "two", [0.5, 0.005, 0.0], 0.0);
        model.contacts.push(Contact { interface: Interface::default(), ..all() });
    };
    told(&inside, &["inside at the start"]);
}
