//! Good files: the same mesh from every format, with the right groups, areas and places.

use super::{FORMATS, area, bytes, group, length, mesh, path};
use embate_files::gmsh::{parse, read};
use embate_solver::model::ImportedMesh;

/// Same groups and cells; positions equal to the 16 digits of a text file.
fn assert_same(a: &ImportedMesh, b: &ImportedMesh, what: &str) {
    assert_eq!(a.groups, b.groups, "{what}");
    assert_eq!(a.positions.len(), b.positions.len(), "{what}");
    for (x, y) in a.positions.iter().flatten().zip(b.positions.iter().flatten()) {
        assert!((x - y).abs() <= 5e-16 * x.abs(), "{what}: {x} and {y}");
    }
}

fn shape_of(mesh: &ImportedMesh) -> Vec<(&str, u8, usize)> {
    mesh.groups.iter().map(|group| (group.name.as_str(), group.dimension, group.cells.len())).collect()
}

#[test]
fn tube_and_plate_are_the_same_in_all_four_formats() {
    let exact = mesh("bodies-v4-binary", 1.0);
    assert_eq!(shape_of(&exact), [("tube_outer", 1, 40), ("plate_top", 1, 120), ("tube", 2, 40), ("plate", 2, 360)]);
    assert_eq!(exact.positions.len(), 82 + 484);
    for format in FORMATS {
        assert_same(&exact, &mesh(&format!("bodies-{format}"), 1.0), format);
    }
    assert_eq!(exact, mesh("bodies-v2-binary", 1.0), "binary files keep every bit");
}

#[test]
fn tube_and_plate_lie_where_the_built_in_shapes_put_them() {
    let mesh = mesh("bodies-v4-binary", 1.0);
    let nodes_of = |name: &str| {
        let mut nodes: Vec<u32> = group(&mesh, name).cells.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    };
    let (tube, plate) = (nodes_of("tube"), nodes_of("plate"));
    assert_eq!((tube.len(), plate.len()), (82, 484));
    for &node in &tube {
        let [x, y, _] = mesh.positions[node as usize];
        let r = if x.hypot(y - 0.1) < 0.097 { 0.094 } else { 0.1 };
        let step = std::f64::consts::PI / 40.0;
        let angle = ((y - 0.1).atan2(x) / step).round() * step;
        assert!((x - r * angle.cos()).abs() < 3e-17 && (y - 0.1 - r * angle.sin()).abs() < 3e-17, "({x}, {y})");
    }
    for &node in &plate {
        let [x, y, _] = mesh.positions[node as usize];
        assert!((x - (x * 200.0).round() / 200.0).abs() < 2e-16 && (y - (y * 1000.0).round() / 1000.0).abs() < 2e-18, "({x}, {y})");
    }
    let on_axis = |nodes: &[u32]| nodes.iter().filter(|node| mesh.positions[**node as usize][0] == 0.0).count();
    assert_eq!((on_axis(&tube), on_axis(&plate)), (4, 4), "exactly on the line of symmetry");
    assert!(tube.iter().any(|&node| mesh.positions[node as usize] == [0.0; 3]));
}

#[test]
fn tube_and_plate_have_their_areas_and_lengths() {
    let mesh = mesh("bodies-v4-binary", 1.0);
    let step = std::f64::consts::PI / 40.0;
    let polygon = 0.5 * 40.0 * step.sin() * (0.1 * 0.1 - 0.094 * 0.094);
    assert!((area(&mesh, "tube") - polygon).abs() < 1e-16);
    assert!((area(&mesh, "plate") - 0.6 * 0.003).abs() < 1e-16);
    assert!((length(&mesh, "tube_outer") - 40.0 * 0.2 * (0.5 * step).sin()).abs() < 1e-15);
    assert!((length(&mesh, "plate_top") - 0.6).abs() < 1e-15);
}

#[test]
fn quadrilaterals_start_at_the_corner_where_those_of_the_built_in_shapes_do() {
    let mesh = mesh("bodies-v4-binary", 1.0);
    let radius = |node: u32| mesh.positions[node as usize][0].hypot(mesh.positions[node as usize][1] - 0.1);
    for cell in &group(&mesh, "tube").cells {
        assert!(radius(cell[0]) < 0.097 && radius(cell[1]) > 0.097, "inside, then outside");
    }
    for cell in &group(&mesh, "plate").cells {
        let x = |k: usize| mesh.positions[cell[k] as usize];
        assert!(x(0)[0] < x(2)[0] && x(0)[1] < x(2)[1] && x(1)[0] > x(0)[0], "lower left, then lower right");
    }
}

#[test]
fn a_mixed_mesh_is_the_same_in_all_formats_and_byte_orders() {
    let exact = mesh("plate-v4-binary", 1e-3);
    let expected = [("left corners", 0, 2), ("hole", 1, 8), ("curve-7", 1, 2), ("plate", 2, 36), ("strip", 2, 4)];
    assert_eq!(shape_of(&exact), expected);
    assert_eq!(exact.positions.len(), 30);
    assert_eq!(mesh("plate-v4-binary-big", 1e-3), exact);
    assert_eq!(mesh("plate-v2-binary-big", 1e-3), mesh("plate-v2-binary", 1e-3));
    for format in FORMATS {
        assert_same(&exact, &mesh(&format!("plate-{format}"), 1e-3), format);
        assert_same(&exact, &mesh(&format!("plate-parametric-{format}"), 1e-3), &format!("{format} with parameters"));
    }
}

#[test]
fn an_element_of_two_groups_is_in_both() {
    for format in FORMATS {
        let mesh = mesh(&format!("plate-{format}"), 1e-3);
        let plate = &group(&mesh, "plate").cells;
        assert!(group(&mesh, "strip").cells.iter().all(|cell| plate.contains(cell)), "{format}");
    }
}

#[test]
fn areas_lengths_and_corners_of_the_mixed_mesh_are_right() {
    let mesh = mesh("plate-v4-binary", 1e-3);
    let hole = 4.0 * std::f64::consts::SQRT_2 * 1e-4 * 0.5; // a regular octagon, 0.5 · 8 · r² · sin 45°
    assert!((area(&mesh, "plate") - (60e-3 * 40e-3 - hole)).abs() < 1e-11);
    assert!((area(&mesh, "strip") - 20e-3 * 40e-3).abs() < 1e-13);
    assert!((length(&mesh, "hole") - 16.0 * 10e-3 * (std::f64::consts::PI / 8.0).sin()).abs() < 1e-10);
    assert!((length(&mesh, "curve-7") - 40e-3).abs() < 1e-13);
    let corners: Vec<_> = group(&mesh, "left corners").cells.iter().map(|cell| mesh.positions[cell[0] as usize]).collect();
    assert_eq!(corners, [[0.0; 3], [0.0, 40.0 * 1e-3, 0.0]]);
    assert!(group(&mesh, "plate").cells.iter().any(|cell| cell.len() == 3));
    assert!(group(&mesh, "plate").cells.iter().any(|cell| cell.len() == 4));
}

#[test]
fn a_partitioned_mesh_keeps_its_groups() {
    let whole = mesh("plate-v4-binary", 1e-3);
    for format in FORMATS {
        let mesh = mesh(&format!("plate-partitioned-{format}"), 1e-3);
        assert_eq!(shape_of(&mesh), shape_of(&whole), "{format}");
        for name in ["plate", "strip"] {
            assert!((area(&mesh, name) - area(&whole, name)).abs() < 1e-17, "{format}");
        }
    }
}

#[test]
fn a_file_without_physical_groups_is_one_group_of_all_surfaces() {
    for format in FORMATS {
        let mesh = mesh(&format!("plate-without-groups-{format}"), 1e-3);
        assert_eq!(shape_of(&mesh), [("all", 2, 36)], "{format}");
        assert_eq!(mesh.positions.len(), 30, "{format}: the hole's centre is dropped");
    }
}

#[test]
fn windows_line_ends_are_read() {
    for format in ["v2-text", "v4-text"] {
        let name = format!("plate-{format}");
        let text = String::from_utf8(bytes(&name)).unwrap().replace('\n', "\r\n");
        assert_eq!(parse(text.as_bytes(), "m.msh", 1e-3).unwrap(), mesh(&name, 1e-3));
    }
}

#[test]
fn sections_that_are_not_needed_are_stepped_over() {
    let foreign = b"$Periodic\n1\n\"speed\"\n1\n0.0\n3\n0\n1\n1\n1 2.5\n$EndPeriodic\n";
    let binary = b"$Periodic\n\x00\xff$End\n$Nodes\x01\n$EndPeriodic\n";
    for format in FORMATS {
        let name = format!("plate-{format}");
        let mut longer = bytes(&name);
        longer.extend_from_slice(if format.ends_with("text") { foreign } else { binary });
        assert_eq!(parse(&longer, "m.msh", 1e-3).unwrap(), mesh(&name, 1e-3), "{format}");
    }
}

#[test]
fn a_mesh_is_read_from_its_file_and_says_where_it_came_from() {
    let path = path("plate-v2-text");
    let mesh = read(&path, 1.0).unwrap();
    assert_eq!(mesh.source, path.display().to_string());
    let fault = &read(&path.with_extension("lost"), 1.0).unwrap_err()[0];
    assert!(fault.message.starts_with("the mesh file can't be read") && fault.path.ends_with("plate-v2-text.lost"), "{fault}");
}

#[test]
fn binary_files_of_a_32_bit_gmsh_are_read() {
    for big_endian in [false, true] {
        let int = |x: i32| if big_endian { x.to_be_bytes() } else { x.to_le_bytes() };
        let mut file = b"$MeshFormat\n4.1 1 4\n".to_vec();
        file.extend(int(1));
        file.extend(b"\n$EndMeshFormat\n$Nodes\n");
        file.extend([1, 4, 10, 13, 2, 1, 0, 4, 10, 11, 12, 13].map(int).concat());
        for x in [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 1.0, 0.0_f64] {
            file.extend(if big_endian { x.to_be_bytes() } else { x.to_le_bytes() });
        }
        file.extend(b"\n$EndNodes\n$Elements\n");
        file.extend([1, 1, 7, 7, 2, 1, 3, 1, 7, 10, 11, 12, 13].map(int).concat());
        file.extend(b"\n$EndElements\n");
        let mesh = parse(&file, "m.msh", 1.0).unwrap();
        assert_eq!(mesh.positions, [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!((mesh.groups[0].name.as_str(), &mesh.groups[0].cells[..]), ("all", &[vec![0, 1, 2, 3]][..]));
    }
}
