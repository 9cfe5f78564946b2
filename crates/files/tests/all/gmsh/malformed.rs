//! Malformed files, made from good ones by one change each: every one gets its message, at its place.

use super::{bytes, faults};
use embate_files::gmsh::parse;

/// Replaces `from`, which occurs once, by `to`.
fn changed(name: &str, from: &str, to: &str) -> Vec<u8> {
    let bytes = bytes(name);
    let places: Vec<_> = (0..bytes.len()).filter(|&at| bytes[at..].starts_with(from.as_bytes())).collect();
    assert_eq!(places.len(), 1, "{from:?} occurs {} times in {name}", places.len());
    [&bytes[..places[0]], to.as_bytes(), &bytes[places[0] + from.len()..]].concat()
}

/// One wrong file: fixture, what is changed to what, and the fault that is expected: its place and how
/// message and remedy begin.
type Case = (&'static str, &'static str, &'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const CASES: &[Case] = &[
    // The file as a whole.
    ("plate-v4-text", "$MeshFormat\n4.1 0 8\n", "$MeshFormat\n4 0 8\n", "m.msh, line 2", "the file is of version \"4\"; 2.2 and 4.1 are read", "save it again with Gmsh: gmsh OLD.msh"),
    ("plate-v4-text", "$MeshFormat\n4.1 0 8\n", "$MeshFormat\n4.0 0 8\n", "m.msh, line 2", "the file is of version \"4.0\"; 2.2 and 4.1 are read", "save it again with Gmsh: gmsh OLD.msh"),
    ("plate-v2-text", "$MeshFormat\n2.2 0 8\n$EndMeshFormat", "$NOD", "m.msh, line 1", "the file is of version 1; 2.2 and 4.1 are read", "save it again with Gmsh: gmsh OLD.msh"),
    ("plate-v2-text", "$MeshFormat\n", "", "m.msh, line 1", "this is not a Gmsh mesh file", "the first line"),
    ("plate-v4-text", "$MeshFormat\n4.1 0 8\n", "$MeshFormat\n4.1 2 8\n", "m.msh, line 2", "the kind of file is 2", "it is 0 (text) or 1 (binary)"),
    ("plate-v2-text", "$MeshFormat\n2.2 0 8\n", "$MeshFormat\n2.2 0 4\n", "m.msh, line 2", "the file's numbers have 4 bytes", "save it again"),
    ("plate-v4-text", "$MeshFormat\n4.1 0 8\n", "$MeshFormat\n4.1\n", "m.msh, line 2", "the line ends where the kind of file", "a number is missing"),
    ("plate-v4-text", "$EndMeshFormat\n", "$EndMeshFormat\nhello\n", "m.msh, line 4", "expected a section such as $Nodes, found \"hello\"", "a count above is too small"),
    ("plate-v4-text", "$EndPeriodic", "", "m.msh, line 184", "section $Periodic has no $EndPeriodic", "the file was cut"),
    ("plate-v4-text", "$EndPeriodic\n", "$EndPeriodic\n$Nodes\n", "m.msh, line 201", "a second section $Nodes", "one mesh in a file"),
    ("plate-v4-text", "$EndPeriodic\n", "$EndPeriodic\n$PartitionedEntities\n", "m.msh, line 201", "section $PartitionedEntities stands after $Elements", "entities come before"),
    ("plate-v4-text", "$EndEntities\n$Nodes\n", "$EndEntities\n$Punkte\n", "m.msh, line 38", "section $Punkte has no $EndPunkte", "the file was cut"),

    // Names.
    ("plate-v4-text", "2 4 \"strip\"", "2 3 \"strip\"", "m.msh, line 9", "physical group 3 of dimension 2 has two names, the second is \"strip\"", "remove one"),
    ("plate-v4-text", "2 4 \"strip\"", "4 4 \"strip\"", "m.msh, line 9", "this is not the name of a physical group", "a line here is, for example, 2 1 \"plate\""),
    ("plate-v4-text", "2 4 \"strip\"", "2 4 strip", "m.msh, line 9", "this is not the name of a physical group", "a line here is"),
    ("plate-v4-text", "2 4 \"strip\"", "1 2 \"hole\"", "m.msh, line 9", "physical group 2 of dimension 1 has two names", "remove one"),
    ("plate-v4-text", "2 4 \"strip\"", "2 4 \"hole\"", "m.msh", "two physical groups are named \"hole\", of dimensions 1 and 2", "rename one"),
    ("plate-v4-text", "$PhysicalNames\n4\n", "$PhysicalNames\n40000\n", "m.msh, line 5", "the file announces 40000 physical names, but only", "the count is wrong"),
    ("plate-v4-text", "$PhysicalNames\n4\n", "$PhysicalNames\n3\n", "m.msh, line 9", "expected $EndPhysicalNames, found \"2\"", "the section's counts"),
    ("plate-v4-text", "$PhysicalNames\n4\n", "$PhysicalNames\n5\n", "m.msh, line 10", "expected the dimension of a physical group (0 to 3), found \"$EndPhysicalNames\"", "the file was cut, or a count"),

    // Entities.
    ("plate-v4-text", "$Entities\n11 11 2 0\n", "$Entities\n11 11 1 0\n", "m.msh, line 36", "expected $EndEntities, found \"2\"", "the section's counts"),
    ("plate-v4-text", "$Entities\n11 11 2 0\n", "$Entities\n11 11 -2 0\n", "m.msh, line 12", "expected the number of surfaces, found \"-2\"", "the file is damaged here"),
    ("plate-v4-text", "$Entities\n11 11 2 0\n", "$Entities\n11 11 18446744073709551615 0\n", "m.msh, line 12", "the file announces 18446744073709551615 surfaces", "the count is wrong"),
    ("plate-v4-text", "1 0 0 0 20 40 0 2 3 4 4 5 -4 6 7", "1 0 0 0 20 40 0 999999 3 4 4 5 -4 6 7", "m.msh, line 35", "the file announces 999999 physical groups of an entity", "the count is wrong"),
    ("plate-v4-text", "1 0 0 0 20 40 0 2 3 4 4 5 -4 6 7", "1 0 0 0 20 40 0 2 3 4 5 5 -4 6 7", "m.msh, line 35", "the line ends where a bounding entity is expected", "a number is missing"),
    ("plate-v4-text", "2 1 3 4\n13 1 15", "2 9 3 4\n13 1 15", "m.msh, line 145", "entity 9 of dimension 2 is not in $Entities", "the physical group of its elements is not known"),

    // Nodes, version 4.
    ("plate-v4-text", "$Nodes\n23 30 1 30\n", "$Nodes\n23 29 1 30\n", "m.msh, line 39", "the file announces 29 nodes, but its blocks hold 30", "the counts don't agree"),
    ("plate-v4-text", "$Nodes\n23 30 1 30\n", "$Nodes\n23 3000000 1 30\n", "m.msh, line 39", "the file announces 3000000 nodes, but only", "the count is wrong"),
    ("plate-v4-text", "$Nodes\n23 30 1 30\n", "$Nodes\n24 30 1 30\n", "m.msh, line 123", "expected the dimension of a block's entity, found \"$EndNodes\"", "the file was cut"),
    ("plate-v4-text", "$Nodes\n23 30 1 30\n", "$Nodes\n22 30 1 30\n", "m.msh, line 39", "the file announces 30 nodes, but its blocks hold 22", "the counts don't agree"),
    ("plate-v4-text", "2 2 0 8\n23\n", "2 2 0 9\n23\n", "m.msh, line 115", "expected the tag of a node, found \"53.79059959053777\"", "the file is damaged here"),
    ("plate-v4-text", "2 2 0 8\n23\n", "2 2 0 7\n23\n", "m.msh, line 114", "the line ends where y of a node is expected", "a number is missing"),
    ("plate-v4-text", "2 2 0 8\n23\n", "2 4294967295 0 4294967295\n23\n", "m.msh, line 106", "the file announces 4294967295 nodes of a block", "the count is wrong"),
    ("plate-v4-text", "2 2 0 8\n23\n", "7 2 0 8\n23\n", "m.msh, line 106", "a block of nodes of dimension 7", "the dimension is 0 to 3"),
    ("plate-v4-text", "2 2 0 8\n23\n", "2 2 1 8\n23\n", "m.msh, line 115", "the line ends where a parameter of a node is expected", "a number is missing"),
    ("plate-v4-text", "53.79059959053777 28.27314934273956 0", "53.79059959053777 28.27314934273956", "m.msh, line 115", "the line ends where z of a node is expected", "a number is missing"),
    ("plate-v4-text", "53.79059959053777 28.27314934273956 0", "53,79059959053777 28.27314934273956 0", "m.msh, line 115", "expected x of a node, found \"53,79059959053777\"", "the file is damaged here"),
    ("plate-v4-text", "53.79059959053777 28.27314934273956 0", "53.79059959053777 28.27314934273956 1e-3", "m.msh, line 115", "node 23 is at z = 1e-3 m, off the plane z = 0", "bodies lie in the plane"),
    ("plate-v4-text", "53.79059959053777 28.27314934273956 0", "nan 28.27314934273956 0", "m.msh, line 115", "node 23 is at (NaN,", "coordinates are finite"),
    ("plate-v4-text", "53.79059959053777 28.27314934273956 0", "53.79059959053777 1e999 0", "m.msh, line 115", "node 23 is at (5.379059959053777e1, inf,", "coordinates are finite"),
    ("plate-v4-text", "2 2 0 8\n23\n24\n", "2 2 0 8\n24\n24\n", "m.msh, line 116", "a second node with the tag 24", "the file is damaged"),
    ("plate-v4-text", "2 2 0 8\n23\n24\n", "2 2 0 8\n1000000000000\n24\n", "m.msh, line 160", "element 26 (triangle) of group \"plate\" needs node 23, which is not in the file", "the file is damaged"),

    // Elements, version 4.
    ("plate-v4-text", "$Elements\n9 48 1 48\n", "$Elements\n9 49 1 48\n", "m.msh, line 125", "the file announces 49 elements, but its blocks hold 48", "the counts don't agree"),
    ("plate-v4-text", "$Elements\n9 48 1 48\n", "$Elements\n8 48 1 48\n", "m.msh, line 125", "the file announces 48 elements, but its blocks hold 16", "the counts don't agree"),
    ("plate-v4-text", "2 1 3 4\n13 1 15", "2 1 34 4\n13 1 15", "m.msh, line 145", "element type 34 is not known", "known are those with a fixed number of nodes"),
    ("plate-v4-text", "2 1 3 4\n13 1 15", "2 1 1 4\n13 1 15", "m.msh, line 145", "elements of type 1 (line) in an entity of dimension 2", "the file is damaged"),
    ("plate-v4-text", "2 1 3 4\n13 1 15", "2 1 2 4\n13 1 15", "m.msh, line 146", "expected the end of the line, found \"17\"", "a number too many"),
    ("plate-v4-text", "13 1 15 22 17 \n", "13 1 15 22 1 \n", "m.msh, line 146", "element 13 (quadrilateral) of group \"plate\" has node 1 twice", "the file is damaged"),
    ("plate-v4-text", "13 1 15 22 17 \n", "13 1 22 15 17 \n", "m.msh, line 146", "element 13 (quadrilateral) of group \"plate\" has sides that cross", "its nodes are not in order"),
    ("plate-v4-text", "16 22 14 5 16 \n", "16 22 15 2 14 \n", "m.msh, line 149", "element 16 (quadrilateral) of group \"plate\" has the nodes of element 15", "the file is damaged"),
    ("plate-v4-text", "\n44 3 12 30 \n", "\n44 2 11 3 \n", "m.msh, line 178", "element 44 (triangle) of group \"plate\" has no area (0e0 m²)", "its nodes lie on a line"),
    ("plate-v4-text", "0 1 15 1\n1 1 \n", "0 1 15 1\n1 77 \n", "m.msh, line 127", "element 1 (point) of group \"left corners\" needs node 77", "the file is damaged"),

    // Version 2.
    ("plate-v2-text", "$Nodes\n30\n", "$Nodes\n31\n", "m.msh, line 43", "expected the number of a node, found \"$EndNodes\"", "the file was cut, or a count"),
    ("plate-v2-text", "$Nodes\n30\n", "$Nodes\n29\n", "m.msh, line 42", "expected $EndNodes, found \"30\"", "the section's counts"),
    ("plate-v2-text", "$Nodes\n30\n", "$Nodes\n-30\n", "m.msh, line 12", "expected the number of nodes, found \"-30\"", "the file is damaged here"),
    ("plate-v2-text", "$Nodes\n30\n1 0 0 0\n", "$Nodes\n30\n-1 0 0 0\n", "m.msh, line 13", "the number of a node is -1", "it can't be negative"),
    ("plate-v2-text", "$Nodes\n30\n1 0 0 0\n", "$Nodes\n30\n2 0 0 0\n", "m.msh, line 14", "a second node with the tag 2", "the file is damaged"),
    ("plate-v2-text", "$Elements\n52\n", "$Elements\n53\n", "m.msh, line 98", "expected the number of an element, found \"$EndElements\"", "the file was cut"),
    ("plate-v2-text", "$Elements\n52\n", "$Elements\n51\n", "m.msh, line 97", "expected $EndElements, found \"52\"", "the section's counts"),
    ("plate-v2-text", "52 3 2 4 1 22 14 5 16\n", "52 3 99999999999 4 1 22 14 5 16\n", "m.msh, line 97", "the line ends where a tag of an element is expected", "a number is missing"),
    ("plate-v2-text", "52 3 2 4 1 22 14 5 16\n", "52 3 2 4 1 22 14 5\n", "m.msh, line 97", "the line ends where a node of an element is expected", "a number is missing"),
    ("plate-v2-text", "52 3 2 4 1 22 14 5 16\n", "52 7 2 4 1 22 14 5 16 1\n", "m.msh, line 97", "group \"volume-4\" has 1 element of the type \"pyramid\" (number 7)", "pyramids are not computed"),
    ("plate-v2-text", "52 3 2 4 1 22 14 5 16\n", "52 39 2 4 1 22 14 5 16 1 2 3 4 6 7 8 9\n", "m.msh, line 97", "group \"strip\" has 1 element of the type \"12-node quadrilateral\"", "elements of first and second order are read"),
    ("plate-v2-text", "52 3 2 4 1 22 14 5 16\n", "52 x 2 4 1 22 14 5 16\n", "m.msh, line 97", "expected the type of an element, found \"x\"", "the file is damaged here"),

    // Binary: places are byte offsets.
    ("plate-v2-binary", "\n$Nodes\n30\n", "\n$Nodes\n31\n", "m.msh, byte", "expected $EndNodes, found other bytes", "the section's counts"),
    ("plate-v2-binary", "\n$Elements\n52\n", "\n$Elements\n51\n", "m.msh, byte", "expected $EndElements, found other bytes", "the section's counts"),
    ("plate-v2-binary", "\n$Elements\n52\n", "\n$Elements\n5000\n", "m.msh, byte", "the file announces 5000 elements, but only", "the count is wrong"),
    ("plate-v2-binary", "2.2 1 8\n\u{1}", "2.2 1 8\n\u{2}", "m.msh, line 3", "the file's byte order can't be derived from the bytes [2, 0, 0, 0]", "the number one is expected here"),
    ("plate-v4-binary", "$Nodes\n\u{17}\0", "$Nodes\n\u{16}\0", "m.msh, byte", "the file announces 30 nodes, but its blocks hold 22", "the counts don't agree"),
    ("plate-v4-binary", "$Nodes\n\u{17}\0\0\0\0\0\0\0", "$Nodes\n\u{17}\0\0\0\0\0\0\u{7f}", "m.msh, byte", "the file announces 9151314442816847895 blocks, but only", "the count is wrong"),
    ("plate-v4-binary", "$Elements\n\u{9}\0", "$Elements\n\u{8}\0", "m.msh, byte", "the file announces 48 elements, but its blocks hold 16", "the counts don't agree"),
    ("plate-v4-binary", "$EndElements", "$EndElement", "m.msh, byte", "expected $EndElements, found \"$EndElement\"", "the section's counts"),
];

#[test]
fn every_malformed_file_gets_its_message_at_its_place() {
    let mut wrong = Vec::new();
    for (name, from, to, place, message, help) in CASES {
        match parse(&changed(name, from, to), "m.msh", 1.0) {
            Ok(_) => wrong.push(format!("{from:?} -> {to:?}: read without a fault")),
            Err(faults) => {
                let first = &faults[0];
                let same_place = first.path == *place || place.ends_with("byte") && first.path.starts_with(place);
                if !same_place || !first.message.starts_with(message) || !first.help.starts_with(help) || first.help.is_empty() {
                    wrong.push(format!("{name}: {from:?} -> {to:?}\n    {first}\n    expected {place}: {message} ({help}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A square of `n` × `n` cells of side 1 as a version 2 text file; `cell` gives an element's line from its
/// number and corners.
fn square(n: usize, tag: impl Fn(usize) -> usize, cell: impl Fn(usize, [usize; 4]) -> String) -> String {
    let row = n + 1;
    let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", row * row);
    for k in 0..row * row {
        text += &format!("{} {} {} 0\n", tag(k), k % row, k / row);
    }
    text += &format!("$EndNodes\n$Elements\n{}\n", n * n);
    for k in 0..n * n {
        let corner = k / n * row + k % n;
        text += &cell(k + 1, [corner, corner + 1, corner + row + 1, corner + row].map(&tag));
    }
    text + "$EndElements\n"
}

fn quadrilateral(number: usize, [a, b, c, d]: [usize; 4]) -> String {
    format!("{number} 3 2 5 1 {a} {b} {c} {d}\n")
}

#[test]
fn at_most_twenty_faults_of_a_kind_are_given_and_the_rest_counted() {
    let text = square(6, |k| k + 1, |number, [a, b, c, d]| quadrilateral(number, if number == 1 { [a, a, b, c] } else { [a, c, b, d] }));
    let faults = faults(text.as_bytes());
    assert_eq!(faults.len(), 1 + 20 + 1);
    assert_eq!(faults[0].message, "element 1 (quadrilateral) of group \"surface-5\" has node 1 twice");
    let crossing = faults[1..21].iter().all(|fault| fault.message.ends_with("has sides that cross each other"));
    assert!(crossing, "{faults:#?}");
    assert_eq!(faults[21].to_string(), "m.msh: 15 more elements with crossing sides");
}

#[test]
fn tags_may_be_sparse_large_and_in_any_order() {
    let plain = parse(square(4, |k| k + 1, quadrilateral).as_bytes(), "m.msh", 2.0).unwrap();
    assert_eq!((plain.positions.len(), plain.groups[0].cells.len()), (25, 16));
    assert_eq!(plain.groups[0].cells[0], [0, 1, 6, 5]);
    assert_eq!(plain.positions[6], [2.0, 2.0, 0.0]);
    for tag in [|k: usize| 1000 - 7 * k, |k| 1_usize << (2 * k), |k| k * 7 % 25] {
        assert_eq!(parse(square(4, tag, quadrilateral).as_bytes(), "m.msh", 2.0).unwrap(), plain);
    }
}

#[test]
fn clockwise_cells_are_turned_about_their_first_node() {
    let plain = parse(square(3, |k| k + 1, quadrilateral).as_bytes(), "m.msh", 1.0).unwrap();
    let turned = square(3, |k| k + 1, |number, [a, b, c, d]| quadrilateral(number, [a, d, c, b]));
    assert_eq!(parse(turned.as_bytes(), "m.msh", 1.0).unwrap(), plain);
    let triangles = |clockwise: bool| {
        let cell = |number, [a, b, c, _]: [usize; 4]| {
            if clockwise { format!("{number} 2 2 5 1 {a} {c} {b}\n") } else { format!("{number} 2 2 5 1 {a} {b} {c}\n") }
        };
        parse(square(3, |k| k + 1, cell).as_bytes(), "m.msh", 1.0).unwrap()
    };
    assert_eq!(triangles(true), triangles(false));
}

#[test]
fn negative_physical_tags_name_the_same_group() {
    let cell = |number, [a, b, c, d]: [usize; 4]| format!("{number} 3 2 {}5 1 {a} {b} {c} {d}\n", if number % 2 == 0 { "-" } else { "" });
    let mesh = parse(square(3, |k| k + 1, cell).as_bytes(), "m.msh", 1.0).unwrap();
    assert_eq!((mesh.groups.len(), mesh.groups[0].name.as_str(), mesh.groups[0].cells.len()), (1, "surface-5", 9));
}

#[test]
fn elements_of_second_order_in_2d_are_read_by_their_corners_which_is_said() {
    let mesh = parse(&bytes("plate-order-2"), "m.msh", 1.0).unwrap_or_else(|faults| panic!("{faults:#?}"));
    let of = |name: &str| mesh.groups.iter().find(|group| group.name == name).map(|group| (group.cells.len(), group.cells[0].len()));
    assert_eq!([of("plate"), of("hole"), of("strip")], [Some((36, 3)), Some((8, 2)), Some((4, 4))]);
    let message = "group \"plate\" has 32 elements of the type \"6-node triangle\", which become triangles of 3 nodes";
    assert!(mesh.notes.iter().any(|note| note == message), "{:?}", mesh.notes);
    let used: std::collections::BTreeSet<u32> = mesh.groups.iter().flat_map(|group| &group.cells).flatten().copied().collect();
    assert_eq!(used.len(), mesh.positions.len(), "none is left over");
}

#[test]
fn groups_of_curves_alone_make_no_mesh() {
    let text = square(2, |k| k + 1, |number, [a, b, ..]| format!("{number} 1 2 5 1 {a} {b}\n"));
    assert_eq!(faults(text.as_bytes())[0].message, "no triangle or quadrilateral belongs to a physical group");
    let nothing = square(2, |k| k + 1, |number, [a, b, ..]| format!("{number} 1 2 0 1 {a} {b}\n"));
    assert_eq!(faults(nothing.as_bytes())[0].message, "the file holds no triangles or quadrilaterals");
}

#[test]
fn lines_and_points_away_from_every_surface_are_faults() {
    let cell = |number, [a, b, c, d]: [usize; 4]| match number {
        7 => format!("7 15 2 9 1 {c}\n"),
        8 => format!("8 1 2 9 1 {c} {d}\n"),
        9 => format!("9 1 2 9 1 {a} {b}\n"),
        _ => quadrilateral(number, [a, b, c, d]),
    };
    let found = faults(square(3, |k| k + 1, cell).as_bytes());
    assert_eq!(found.len(), 2, "{found:#?}");
    assert_eq!(
        found[0].message,
        "element 7 (point) of group \"point-9\" lies at node 14, which no triangle or quadrilateral of a physical group has"
    );
    assert_eq!(
        found[1].message,
        "element 8 (line) of group \"curve-9\" lies at node 15, which no triangle or quadrilateral of a physical group has"
    );
}

#[test]
fn a_line_without_length_is_a_fault() {
    let text = square(
        3,
        |k| k + 1,
        |number, [a, b, c, d]| if number == 9 { format!("9 1 2 9 1 {a} {b}\n") } else { quadrilateral(number, [a, b, c, d]) },
    );
    let text = text.replace("\n11 2 2 0\n", "\n11 3 2 0\n");
    let found = faults(text.as_bytes());
    assert!(
        found.iter().any(|fault| fault.message == "element 9 (line) of group \"curve-9\" has no length: its nodes lie on one another"),
        "{found:#?}"
    );
}

#[test]
fn a_unit_that_is_no_length_is_a_fault() {
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = parse(&bytes("plate-v4-text"), "m.msh", scale).unwrap_err();
        assert_eq!(found[0].message, format!("the mesh's unit is {scale} m"));
    }
    let found = parse(&bytes("plate-v4-text"), "m.msh", 1e307).unwrap_err();
    assert!(found[0].message.contains("not a place") && found.len() == 21, "{found:#?}");
}

#[test]
fn files_that_are_no_mesh_say_so() {
    for text in ["", "\n", "hello", "$", "\u{feff}$MeshFormat", "<?xml version=\"1.0\"?>", "\0\0\0\0", "$MeshFormatting\n"] {
        assert_eq!(faults(text.as_bytes())[0].message, "this is not a Gmsh mesh file", "{text:?}");
    }
    let empty = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    assert_eq!(faults(empty.as_bytes())[0].message, "the file has no section $Nodes");
}
