//! Meshes in 3D: volumes are bodies, surfaces their sides; every form and every fault that the plane
//! doesn't have.

use super::{faults, group, mesh};
use embate_files::gmsh::parse;
use embate_files::model_file::load_text;
use embate_solver::error::Fault;
use embate_solver::mesh::cell::{Cell, CellKind};
use embate_solver::mesh::{Mesh, signed_volume};
use embate_solver::model::ImportedMesh;

/// An element: type of the format, physical group, nodes.
type Element = (i32, i32, Vec<usize>);

const NAMES: [(u8, i32, &str); 6] =
    [(0, 1, "corner"), (1, 2, "edge"), (2, 3, "left"), (2, 4, "upper"), (3, 5, "block"), (3, 6, "tetrahedra")];

/// Nodes of two unit cubes side by side along x (1 to 12, x first, then y, then z), and of a third one 5 m
/// above them (13 to 20).
fn nodes() -> Vec<[f64; 3]> {
    let of = |nx: usize, z0: f64| {
        (0..4 * nx).map(move |k| [(k % nx) as f64, (k / nx % 2) as f64, z0 + (k / nx / 2) as f64]).collect::<Vec<[f64; 3]>>()
    };
    [of(3, 0.0), of(2, 5.0)].concat()
}

/// A hexahedron and two prisms as one body, six tetrahedra as another, two groups of surfaces, one of a
/// curve, one of a point.
fn elements() -> Vec<Element> {
    let mut all = vec![
        (15, 1, vec![1]),
        (1, 2, vec![1, 2]),
        (1, 2, vec![2, 3]),
        (3, 3, vec![1, 4, 10, 7]),
        (2, 4, vec![8, 9, 12]),
        (2, 4, vec![8, 12, 11]),
        (3, 4, vec![7, 8, 11, 10]),
        (5, 5, vec![1, 2, 5, 4, 7, 8, 11, 10]),
        (6, 5, vec![2, 3, 6, 8, 9, 12]),
        (6, 5, vec![2, 6, 5, 8, 12, 11]),
    ];
    // From the first corner of the upper cube along the axes in every order to the last (Kuhn).
    for (p, q) in [(1, 2), (1, 4), (2, 1), (2, 4), (4, 1), (4, 2)] {
        all.push((4, 6, vec![13, 13 + p, 13 + p + q, 20]));
    }
    all
}

fn names() -> String {
    let lines: String = NAMES.iter().map(|(dimension, tag, name)| format!("{dimension} {tag} \"{name}\"\n")).collect();
    format!("$PhysicalNames\n{}\n{lines}$EndPhysicalNames\n", NAMES.len())
}

fn version_2(nodes: &[[f64; 3]], elements: &[Element]) -> Vec<u8> {
    let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{}$Nodes\n{}\n", names(), nodes.len());
    for (k, [x, y, z]) in nodes.iter().enumerate() {
        text += &format!("{} {x} {y} {z}\n", k + 1);
    }
    text += &format!("$EndNodes\n$Elements\n{}\n", elements.len());
    for (k, (kind, group, nodes)) in elements.iter().enumerate() {
        let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
        text += &format!("{} {kind} 2 {group} 1 {}\n", k + 1, nodes.join(" "));
    }
    (text + "$EndElements\n").into_bytes()
}

fn dimension_of(kind: i32) -> usize {
    match kind {
        15 => 0,
        1 | 8 => 1,
        2 | 3 | 9 | 16 => 2,
        _ => 3,
    }
}

/// An entity for each group, a block of elements for each element.
fn version_4(nodes: &[[f64; 3]], elements: &[Element], binary: bool) -> Vec<u8> {
    let mut out = format!("$MeshFormat\n4.1 {} 8\n", u8::from(binary)).into_bytes();
    if binary {
        out.extend(1_i32.to_le_bytes());
        out.push(b'\n');
    }
    out.extend(format!("$EndMeshFormat\n{}$Entities\n", names()).bytes());
    let put = |out: &mut Vec<u8>, what: &[f64], sizes: &str| {
        for (value, size) in what.iter().zip(sizes.chars()) {
            match (binary, size) {
                (false, _) => out.extend(format!("{value} ").bytes()),
                (true, 'i') => out.extend((*value as i32).to_le_bytes()),
                (true, 's') => out.extend((*value as u64).to_le_bytes()),
                (true, _) => out.extend(value.to_le_bytes()),
            }
        }
        if !binary {
            out.push(b'\n');
        }
    };
    put(&mut out, &[1.0, 1.0, 2.0, 2.0], "ssss");
    for (dimension, tag, _) in NAMES {
        let tag = f64::from(tag);
        match dimension {
            0 => put(&mut out, &[tag, 0.0, 0.0, 0.0, 1.0, tag], "idddsi"),
            _ => put(&mut out, &[tag, 0.0, 0.0, 0.0, 9.0, 9.0, 9.0, 1.0, tag, 0.0], "iddddddsis"),
        }
    }
    out.extend(b"$EndEntities\n$Nodes\n");
    let count = nodes.len() as f64;
    put(&mut out, &[1.0, count, 1.0, count], "ssss");
    put(&mut out, &[3.0, 5.0, 0.0, count], "iiis");
    (1..=nodes.len()).for_each(|tag| put(&mut out, &[tag as f64], "s"));
    nodes.iter().for_each(|x| put(&mut out, x, "ddd"));
    out.extend(b"$EndNodes\n$Elements\n");
    let count = elements.len() as f64;
    put(&mut out, &[count, count, 1.0, count], "ssss");
    for (k, (kind, group, nodes)) in elements.iter().enumerate() {
        put(&mut out, &[dimension_of(*kind) as f64, f64::from(*group), f64::from(*kind), 1.0], "iiis");
        let numbers: Vec<f64> = [k + 1].iter().chain(nodes).map(|tag| *tag as f64).collect();
        put(&mut out, &numbers, &"s".repeat(numbers.len()));
    }
    out.extend(b"$EndElements\n");
    out
}

fn read(elements: &[Element]) -> ImportedMesh {
    parse(&version_2(&nodes(), elements), "m.msh", 1.0).unwrap_or_else(|faults| panic!("{faults:#?}"))
}

fn volume(mesh: &ImportedMesh, name: &str) -> f64 {
    let of = |cell: Cell<'_>| {
        let volume = signed_volume(cell.kind, &cell.nodes.iter().map(|&node| mesh.positions[node as usize]).collect::<Vec<_>>());
        assert!(volume > 0.0, "a cell of {name} is inside out");
        volume
    };
    group(mesh, name).elements().flatten().map(of).sum()
}

#[test]
fn volumes_surfaces_curves_and_points_are_the_same_from_every_format() {
    let mesh = read(&elements());
    let shape: Vec<_> = mesh.groups.iter().map(|group| (group.name.as_str(), group.dimension, group.cells.len())).collect();
    assert_eq!(shape, [("corner", 0, 1), ("edge", 1, 2), ("left", 2, 1), ("upper", 2, 3), ("block", 3, 3), ("tetrahedra", 3, 6)]);
    assert_eq!((mesh.dimension(), mesh.positions.len()), (3, 20));
    assert_eq!(mesh.positions[19], [1.0, 1.0, 6.0]);
    assert_eq!(volume(&mesh, "block"), 2.0);
    assert!((volume(&mesh, "tetrahedra") - 1.0).abs() < 1e-15);
    let lengths: Vec<usize> = group(&mesh, "block").cells.iter().map(Vec::len).collect();
    assert_eq!(lengths, [6, 6, 8], "those of fewer nodes first");
    for binary in [false, true] {
        assert_eq!(parse(&version_4(&nodes(), &elements(), binary), "m.msh", 1.0).unwrap(), mesh);
    }
    let half = parse(&version_2(&nodes(), &elements()), "m.msh", 0.5).unwrap();
    assert_eq!(half.positions[19], [0.5, 0.5, 3.0]);
}

#[test]
fn elements_of_negative_volume_are_turned_about_their_first_node() {
    let plain = read(&elements());
    let mirrored: Vec<Element> = elements()
        .into_iter()
        .map(|(kind, group, mut nodes)| {
            match kind {
                4 => nodes.swap(2, 3),
                5 => (nodes[1..4].reverse(), nodes[5..].reverse()).0,
                6 => (nodes.swap(1, 2), nodes.swap(4, 5)).0,
                _ => {}
            }
            (kind, group, nodes)
        })
        .collect();
    let turned = read(&mirrored);
    for name in ["block", "tetrahedra"] {
        assert_eq!(volume(&turned, name), volume(&plain, name));
        let firsts = |mesh: &ImportedMesh| group(mesh, name).cells.iter().map(|cell| cell[0]).collect::<Vec<u32>>();
        assert_eq!(firsts(&turned), firsts(&plain));
    }
    assert_eq!(group(&turned, "block"), group(&plain, "block"));
}

#[test]
fn a_cube_of_the_real_gmsh_is_read() {
    let mesh = mesh("cube", 1e-3);
    let shape: Vec<_> = mesh.groups.iter().map(|group| (group.name.as_str(), group.dimension)).collect();
    assert_eq!(shape, [("face", 2), ("cube", 3)]);
    let cube = volume(&mesh, "cube");
    assert!((cube - 1e-9).abs() < 1e-20, "{cube:e}");
}

#[test]
fn volumes_without_any_group_are_the_group_all_and_what_bounds_them_is_none() {
    let without: Vec<Element> = elements().into_iter().map(|(kind, _, nodes)| (kind, 0, nodes)).collect();
    let text = String::from_utf8(version_2(&nodes(), &without)).unwrap().replace(&names(), "");
    let mesh = parse(text.as_bytes(), "m.msh", 1.0).unwrap();
    let shape: Vec<_> = mesh.groups.iter().map(|group| (group.name.as_str(), group.dimension, group.cells.len())).collect();
    assert_eq!(shape, [("all", 3, 9)]);
}

/// Of second order, as Gmsh writes them: a tetrahedron with its side and an edge of it, a hexahedron, a
/// prism.
#[test]
fn tetrahedra_of_second_order_keep_their_nodes_and_others_their_corners() {
    let middle = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { std::array::from_fn(|d| 0.5 * (a[d] + b[d])) };
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // The last two of Gmsh are exchanged in Abaqus and VTK.
    let sides = [[0, 1], [1, 2], [0, 2], [0, 3], [2, 3], [1, 3]];
    let nodes: Vec<[f64; 3]> = corners.into_iter().chain(sides.map(|[a, b]| middle(corners[a], corners[b]))).collect();
    let read = |elements: &[Element], nodes: &[[f64; 3]]| {
        let files = [version_2(nodes, elements), version_4(nodes, elements, false), version_4(nodes, elements, true)];
        let [one, rest @ ..] = files.map(|file| parse(&file, "m.msh", 1.0).unwrap_or_else(|faults| panic!("{faults:#?}")));
        assert!(rest.iter().all(|other| *other == one));
        one
    };
    for turned in [false, true] {
        let mut own: Vec<usize> = (1..=10).collect();
        if turned {
            // The same seen in a mirror: corners 1 and 2 exchanged, and the nodes beside them.
            own = [1, 3, 2, 4, 7, 6, 5, 8, 9, 10].into();
            own.swap(8, 9);
        }
        let mesh = read(&[(11, 6, own), (9, 4, vec![1, 2, 3, 5, 6, 7]), (8, 2, vec![1, 2, 5])], &nodes);
        let of = |name: &str| &mesh.groups.iter().find(|group| group.name == name).unwrap().cells;
        let cell = CellKind::Tetrahedron10.cell(&of("tetrahedra")[0]);
        let place = |node: u32| mesh.positions[node as usize];
        assert!(signed_volume(cell.kind, &cell.nodes.iter().map(|&node| place(node)).collect::<Vec<_>>()) > 0.0);
        for (edge, &node) in cell.edges().zip(&cell.nodes[4..]) {
            assert_eq!(place(node), middle(place(edge[0]), place(edge[1])), "turned {turned}");
        }
        assert!(mesh.notes.is_empty() && mesh.positions.len() == 10);
        let names: Vec<(&str, usize)> = mesh.groups.iter().map(|group| (group.name.as_str(), group.cells[0].len())).collect();
        assert_eq!(names.iter().map(|(_, nodes)| *nodes).collect::<Vec<_>>(), [2, 3, 10], "{names:?}");
    }
    // In 2D triangles keep theirs, too, and quadrilaterals their corners.
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let flat: Vec<[f64; 3]> = corners.into_iter().chain([[0, 1], [1, 2], [2, 0]].map(|[a, b]| middle(corners[a], corners[b]))).collect();
    for own in [vec![1, 2, 3, 4, 5, 6], vec![1, 3, 2, 6, 5, 4]] {
        let mesh = read(&[(9, 4, own.clone()), (8, 2, vec![1, 2, 4])], &flat);
        let cells: Vec<&Vec<u32>> = mesh.groups.iter().flat_map(|group| &group.cells).collect();
        let cell = CellKind::Triangle6.cell(cells.iter().find(|cell| cell.len() == 6).unwrap());
        for (edge, &node) in cell.edges().zip(&cell.nodes[3..]) {
            let [a, b, c] = [edge[0], edge[1], node].map(|node| mesh.positions[node as usize]);
            assert_eq!(c, middle(a, b), "{own:?}");
        }
        assert!(mesh.notes.is_empty() && mesh.positions.len() == 6 && cells.iter().any(|cell| cell.len() == 2), "{own:?}");
    }
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]];
    let mesh = read(&[(16, 4, (1..=8).collect())], &square.map(|[x, y]| [x, y, 0.0]));
    assert!(mesh.positions.len() == 4 && mesh.notes[0].contains("which become quadrilaterals of 4 nodes"), "{:?}", mesh.notes);
    // A cube of 20 nodes is one of 8, whatever the others are.
    let cube = CellKind::Hexahedron.facts().reference;
    let more: Vec<[f64; 3]> = cube.iter().copied().chain((0..12).map(|k| [0.1 * f64::from(k), 0.5, 0.5])).collect();
    let mesh = read(&[(17, 5, (1..=20).collect())], &more);
    assert_eq!((mesh.positions.len(), mesh.groups[0].cells[0].len()), (8, 8));
    assert!(mesh.notes[0].contains("1 elements of the type \"20-node hexahedron\", which become hexahedra of 8 nodes"), "{:?}", mesh.notes);
}

/// One wrong element in place of (or beside) a good one, and the fault that is expected.
#[test]
fn every_fault_of_a_solid_has_its_message() {
    let with = |at: usize, element: Element| {
        let mut all = elements();
        all[at] = element;
        all
    };
    let more = |element: Element| [elements(), vec![element]].concat();
    let upper = |k: usize| 12 + k;
    let cases: Vec<(Vec<Element>, &str, &str)> = vec![
        (
            more((7, 5, vec![1, 2, 5, 4, 8])),
            "group \"block\" has 1 element of the type \"pyramid\" (number 7)",
            "pyramids are not computed",
        ),
        (more((19, 5, (1..14).collect())), "group \"block\" has 1 element of the type \"13-node pyramid\"", "pyramids are not computed"),
        (
            more((29, 6, (1..21).collect())),
            "group \"tetrahedra\" has 1 element of the type \"20-node tetrahedron\"",
            "elements of first and second order are read",
        ),
        (
            more((92, 5, (1..65).collect())),
            "group \"block\" has 1 element of the type \"64-node hexahedron\"",
            "elements of first and second order are read",
        ),
        (
            with(7, (5, 5, vec![1, 2, 5, 4, 1, 2, 5, 4])),
            "element 8 (hexahedron) of group \"block\" has node 1 twice",
            "the file is damaged",
        ),
        (
            with(10, (4, 6, vec![13, 14, 15, 16])),
            "element 11 (tetrahedron) of group \"tetrahedra\" has no volume (0e0 m³)",
            "its nodes lie in a plane",
        ),
        (
            with(8, (6, 5, vec![1, 2, 3, 4, 5, 6])),
            "element 9 (prism) of group \"block\" has no volume (0e0 m³)",
            "its nodes lie in a plane",
        ),
        (
            with(9, (6, 5, vec![3, 6, 2, 9, 12, 8])),
            "element 10 (prism) of group \"block\" has the nodes of element 9",
            "the file is damaged",
        ),
        (
            with(3, (3, 3, vec![1, 4, 7, 10])),
            "element 4 (quadrilateral) of group \"left\" has sides that cross each other",
            "its nodes are not in order",
        ),
        (with(4, (2, 4, vec![7, 8, 9])), "element 5 (triangle) of group \"upper\" has no area (0e0 m²)", "its nodes lie on a line"),
        (with(7, (5, 5, vec![1, 2, 5, 4, 7, 8, 11, 99])), "element 8 (hexahedron) of group \"block\" needs node 99", "the file is damaged"),
        (
            elements().into_iter().filter(|element| element.1 != 5).chain([(2, 3, vec![upper(1), upper(2), upper(3)])]).collect(),
            "element 1 (point) of group \"corner\" lies at node 1, which no volume of a physical group has",
            "put the volume that it bounds into a physical group too",
        ),
    ];
    for (elements, message, help) in cases {
        let found = faults(&version_2(&nodes(), &elements));
        let is_it = |fault: &Fault| fault.message.starts_with(message) && fault.help.starts_with(help);
        assert!(found.iter().any(is_it), "{message}: {found:#?}");
    }
    // A node that is nowhere.
    let mut places = nodes();
    places[19][2] = f64::NAN;
    assert!(faults(&version_2(&places, &elements()))[0].message.starts_with("node 20 is at (1e0, 1e0, NaN) m: not a place"));
    // Solids whose volumes are in no group look like 2D bodies off the plane.
    let surfaces: Vec<Element> = elements().into_iter().filter(|element| element.0 == 3).collect();
    let found = faults(&version_2(&nodes(), &surfaces));
    assert!(found[0].message.contains("off the plane z = 0") && found[0].help.contains("Physical Volume"), "{found:#?}");
}

#[test]
fn counts_that_are_too_large_are_refused_before_anything_is_allocated() {
    let text = String::from_utf8(version_2(&nodes(), &elements())).unwrap();
    for (from, to) in [("$Elements\n16\n", "$Elements\n4000000000000000\n"), ("$Nodes\n20\n", "$Nodes\n4000000000000000\n")] {
        assert!(text.contains(from));
        let found = faults(text.replace(from, to).as_bytes());
        assert!(found[0].message.starts_with("the file announces 4000000000000000 "), "{found:#?}");
    }
}

/// A folder with the mesh of these tests and a square in 2D.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("solids.msh"), version_2(&nodes(), &elements())).unwrap();
    let square = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"square\"\n$EndPhysicalNames\n\
        $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 1 1 1 2 3 4\n$EndElements\n";
    std::fs::write(folder.path().join("square.msh"), square).unwrap();
    folder
}

const MODEL: &str = "run.end = \"1 us\"\n[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n\
    [[part]]\nname = \"a\"\nmaterial = \"steel\"\nelement = \"hex8_reduced\"\nmesh = { file = \"solids.msh\", group = \"block\" }\n\
    [[part]]\nname = \"b\"\nmaterial = \"steel\"\nelement = \"tet4\"\nmesh = { file = \"solids.msh\", group = \"tetrahedra\" }\n\
    [[constraint]]\non = \"left\"\nfixed = [\"x\", \"y\", \"z\"]\n[[constraint]]\non = \"edge\"\nfixed = [\"z\"]\n\
    [[load]]\npressure = 1e6\non = \"upper\"\n[[contact]]\nbetween = [\"upper\", \"b\"]\n[[probe]]\nname = \"p\"\npart = \"a\"\npoint = [0, 0, 0]\n";

#[test]
fn groups_of_a_file_of_solids_are_parts_surfaces_and_nodes_of_a_model() {
    let folder = folder();
    let model = load_text("m", MODEL, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    assert_eq!(model.dimension(), 3);
    let mesh = Mesh::<3>::new(&model).unwrap_or_else(|faults| panic!("{faults:#?}"));
    assert_eq!((mesh.positions.len(), mesh.elements_of(0), mesh.elements_of(1)), (20, 3, 6));
    assert_eq!(mesh.nodes("edge").map(|nodes| nodes.len()), Some(3));
    assert_eq!(mesh.nodes("corner").map(|nodes| nodes.len()), Some(1));
    // Whichever way the file has them, surfaces look out of the body: the left one along -x, the upper one
    // along z.
    let normals = |name: &str| -> Vec<[f64; 3]> {
        let surface = mesh.surface(name, |_| false).unwrap();
        let of = |facet: &[u32; 4]| {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[facet[k] as usize]);
            let (u, v): ([f64; 3], [f64; 3]) = (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        };
        embate_solver::mesh::surface::Sided::facets(&surface).iter().map(of).collect()
    };
    assert_eq!(normals("left"), [[-1.0, 0.0, 0.0]]);
    assert_eq!(normals("upper"), [[0.0, 0.0, 1.0]; 3]);
}

#[test]
fn parts_of_2d_and_of_3d_from_files_do_not_go_together() {
    let folder = folder();
    let part = "[[part]]\nname = \"c\"\nmaterial = \"steel\"\nmesh = { file = \"square.msh\", group = \"square\" }\n";
    let found = load_text("m", &format!("{MODEL}{part}"), folder.path(), &[]).unwrap_err();
    assert!(found.entries.iter().any(|it| it.kind.code == "E0212" && it.message.contains("`c`") | it.message.contains("is 2D")), "{found}");
    let group = MODEL.replace("group = \"block\"", "group = \"upper\"");
    let found = load_text("m", &group, folder.path(), &[]).unwrap_err();
    assert!(
        found.entries.iter().any(|it| it.kind.code == "E0206" && it.message.ends_with("is a group of surfaces, not of volumes")),
        "{found}"
    );
    // The square alone stays a model in 2D; extruded it goes with the solids.
    let alone = format!("run.end = 1\n[material.steel]\nlaw = \"elastic\"\ndensity = 1\nyoung = 1\npoisson = 0\n{part}");
    assert_eq!(load_text("m", &alone, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}")).dimension(), 2);
    let extruded = format!("{MODEL}{part}extrude = {{ from = 9, length = 1, elements = 1 }}\n");
    assert_eq!(load_text("m", &extruded, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}")).dimension(), 3);
}

#[test]
fn a_group_of_surfaces_is_a_shell_in_space_beside_solids_or_alone() {
    let folder = folder();
    let shell = "element = \"shell4\"\nsection = { thickness = \"1 mm\" }\n";
    let both = MODEL.replace("group = \"tetrahedra\"", "group = \"upper\"").replace("element = \"tet4\"\n", shell);
    let both = both.replace("[[load]]\npressure = 1e6\non = \"upper\"\n[[contact]]\nbetween = [\"upper\", \"b\"]\n", "");
    let model = load_text("m", &both, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    let mesh = Mesh::<3>::new(&model).unwrap_or_else(|faults| panic!("{faults:#?}"));
    assert_eq!((mesh.elements_of(0), mesh.elements_of(1), mesh.bodies().into_iter().max()), (3, 3, Some(0)));
    // Alone, out of the plane, clockwise as the file has it.
    let tent = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"ridge\"\n2 1 \"tent\"\n$EndPhysicalNames\n\
        $Nodes\n5\n1 0 0 0\n2 1 0 2\n3 1 1 2\n4 0 1 0\n5 2 0 0\n$EndNodes\n\
        $Elements\n3\n1 3 2 1 1 1 4 3 2\n2 2 2 1 1 2 3 5\n3 1 2 2 1 2 3\n$EndElements\n";
    std::fs::write(folder.path().join("tent.msh"), tent).unwrap();
    let part = format!("[[part]]\nname = \"a\"\nmaterial = \"steel\"\n{shell}mesh = {{ file = \"tent.msh\", group = \"tent\" }}\n");
    let alone = format!("run.end = 1\n[material.steel]\nlaw = \"elastic\"\ndensity = 1\nyoung = 1\npoisson = 0\n{part}");
    let model = load_text("m", &alone, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    let mesh = Mesh::<3>::new(&model).unwrap_or_else(|faults| panic!("{faults:#?}"));
    assert_eq!((mesh.first_skin_node(), mesh.groups.len(), mesh.nodes("ridge").map(|nodes| nodes.len())), (5, 2, Some(2)));
    assert!(mesh.positions.iter().any(|x| x[2] == 2.0));
    let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[mesh.groups[0].nodes_of(0)[k] as usize]);
    assert!((b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]), "clockwise seen along z");
    // Without shells the plane has to be one.
    let plane = alone.replace(shell, "");
    let found = load_text("m", &plane, folder.path(), &[]).unwrap_err();
    assert!(
        found.entries.iter().any(|it| it.message.contains("off the plane z = 0") && it.help.contains("`element = \"shell4\"`")),
        "{found}"
    );
    // So are those of a deck.
    let deck = "*NODE\n1, 0, 0, 0\n2, 1, 0, 2\n3, 1, 1, 2\n4, 0, 1, 0\n5, 2, 0, 0\n*ELEMENT, TYPE=S4R, ELSET=tent\n1, 1, 4, 3, 2\n\
        *ELEMENT, TYPE=S3, ELSET=tent\n2, 2, 3, 5\n";
    std::fs::write(folder.path().join("tent.inp"), deck).unwrap();
    let model =
        load_text("m", &alone.replace("tent.msh", "tent.inp"), folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    assert_eq!(Mesh::<3>::new(&model).unwrap_or_else(|faults| panic!("{faults:#?}")).positions, mesh.positions);
}
