//! Views of mesh files as fields: by node, by element, by node of an element, in both versions, text and
//! binary.

use embate_files::gmsh::{Bodies, parse_for};
use embate_files::model_file::load_text;
use embate_solver::error::Fault;
use embate_solver::model::{FieldValues, ImportedMesh};
use embate_solver::simulation::{Options, Simulation};

/// Two squares and a triangle beside them, nodes numbered from 11 with gaps.
const NODES: [(u64, [f64; 3]); 7] = [
    (11, [0.0, 0.0, 0.0]),
    (12, [1.0, 0.0, 0.0]),
    (14, [2.0, 0.0, 0.0]),
    (15, [0.0, 1.0, 0.0]),
    (17, [1.0, 1.0, 0.0]),
    (18, [2.0, 1.0, 0.0]),
    (20, [3.0, 0.0, 0.0]),
];
const ELEMENTS: [(u64, i32, &[u64]); 3] = [(5, 3, &[11, 12, 17, 15]), (6, 3, &[17, 12, 14, 18]), (9, 2, &[14, 20, 18])];

/// A view: section, name, components, and numbers with their values.
type View<'a> = (&'a str, &'a str, usize, Vec<(u64, Vec<f64>)>);

fn views() -> [View<'static>; 5] {
    let of = |tag: u64| tag as f64 / 10.0;
    [
        ("NodeData", "by node", 1, NODES.iter().map(|(tag, _)| (*tag, vec![of(*tag)])).collect()),
        ("ElementData", "by element", 1, ELEMENTS.iter().map(|(tag, ..)| (*tag, vec![of(*tag)])).collect()),
        ("ElementNodeData", "by corner", 1, ELEMENTS.iter().map(|(_, _, nodes)| (5, nodes.iter().map(|tag| of(*tag)).collect())).collect()),
        // A vector is no thickness, and the second step of a view is not read.
        ("NodeData", "vector", 3, NODES.iter().map(|(tag, _)| (*tag, vec![1.0, 2.0, 3.0])).collect()),
        ("NodeData", "by node", 1, NODES.iter().map(|(tag, _)| (*tag, vec![-1.0])).collect()),
    ]
}

/// A file of a version, in text or binary.
fn file(version: &str, is_binary: bool, views: &[View<'_>]) -> Vec<u8> {
    let mut out = format!("$MeshFormat\n{version} {} 8\n", u8::from(is_binary)).into_bytes();
    if is_binary {
        out.extend(1_i32.to_le_bytes());
        out.push(b'\n');
    }
    out.extend(b"$EndMeshFormat\n");
    let number = |out: &mut Vec<u8>, values: &[f64], ints: &[i32]| {
        if is_binary {
            ints.iter().for_each(|it| out.extend(it.to_le_bytes()));
            values.iter().for_each(|it| out.extend(it.to_le_bytes()));
        } else {
            let words: Vec<String> = ints.iter().map(i32::to_string).chain(values.iter().map(|it| format!("{it:?}"))).collect();
            out.extend(words.join(" ").bytes());
            out.push(b'\n');
        }
    };
    if version == "2.2" {
        out.extend(format!("$Nodes\n{}\n", NODES.len()).bytes());
        for (tag, x) in NODES {
            number(&mut out, &x, &[tag as i32]);
        }
        out.extend(format!("{}$EndNodes\n$Elements\n{}\n", if is_binary { "\n" } else { "" }, ELEMENTS.len()).bytes());
        for (tag, kind, nodes) in ELEMENTS {
            let all: Vec<i32> = nodes.iter().map(|node| *node as i32).collect();
            if is_binary {
                number(&mut out, &[], &[&[kind, 1, 2, tag as i32, 0, 1][..], &all].concat());
            } else {
                number(&mut out, &[], &[&[tag as i32, kind, 2, 0, 1][..], &all].concat());
            }
        }
        out.extend(if is_binary { &b"\n$EndElements\n"[..] } else { b"$EndElements\n" });
    } else {
        assert!(!is_binary, "binary files of version 4 have the same views as those of version 2");
        out.extend(format!("$Nodes\n1 {0} 11 20\n2 1 0 {0}\n", NODES.len()).bytes());
        NODES.iter().for_each(|(tag, _)| out.extend(format!("{tag}\n").bytes()));
        NODES.iter().for_each(|(_, x)| out.extend(format!("{} {} {}\n", x[0], x[1], x[2]).bytes()));
        out.extend(format!("$EndNodes\n$Elements\n2 {} 5 9\n", ELEMENTS.len()).bytes());
        for kind in [3, 2] {
            let own = || ELEMENTS.iter().filter(move |element| element.1 == kind);
            out.extend(format!("2 1 {kind} {}\n", own().count()).bytes());
            for (tag, _, nodes) in own() {
                out.extend(format!("{tag} {}\n", nodes.iter().map(u64::to_string).collect::<Vec<_>>().join(" ")).bytes());
            }
        }
        out.extend(b"$EndElements\n");
    }
    for (section, name, components, values) in views {
        out.extend(format!("${section}\n1\n\"{name}\"\n1\n0.0\n3\n0\n{components}\n{}\n", values.len()).bytes());
        for (k, (tag, own)) in values.iter().enumerate() {
            // Of element nodes the number of the element, and how many they are.
            if *section == "ElementNodeData" {
                number(&mut out, own, &[ELEMENTS[k].0 as i32, own.len() as i32]);
            } else {
                number(&mut out, own, &[*tag as i32]);
            }
        }
        out.extend(if is_binary { &b"\n"[..] } else { b"" });
        out.extend(format!("$End{section}\n").bytes());
    }
    out
}

fn read(bytes: &[u8]) -> Result<ImportedMesh, Vec<Fault>> {
    parse_for(Bodies::Sheets, bytes, "m.msh", 1e-3)
}

#[test]
fn views_become_fields_in_every_kind_of_file() {
    let is_near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-15;
    for (version, is_binary) in [("2.2", false), ("2.2", true), ("4.1", false)] {
        let mesh = read(&file(version, is_binary, &views())).unwrap_or_else(|faults| panic!("{version} {is_binary}: {faults:#?}"));
        assert_eq!(mesh.fields.iter().map(|field| field.name.as_str()).collect::<Vec<_>>(), ["by node", "by element", "by corner"]);
        let FieldValues::Nodes(nodes) = &mesh.fields[0].values else { panic!("{:?}", mesh.fields[0]) };
        assert!(nodes.iter().zip(NODES).all(|(value, (tag, _))| is_near(value.unwrap(), 1e-4 * tag as f64)) && nodes.len() == NODES.len());
        let FieldValues::Corners(elements) = &mesh.fields[1].values else { panic!("{:?}", mesh.fields[1]) };
        let FieldValues::Corners(corners) = &mesh.fields[2].values else { panic!("{:?}", mesh.fields[2]) };
        for (cell, (element, own)) in mesh.groups[0].cells.iter().zip(elements[0].iter().zip(&corners[0])) {
            let tag = ELEMENTS.iter().find(|(_, _, nodes)| nodes.len() == cell.len() && NODES[cell[0] as usize].0 == nodes[0]).unwrap().0;
            assert!(element.len() == cell.len() && element.iter().all(|value| is_near(*value, 1e-4 * tag as f64)));
            assert!(own.iter().zip(cell).all(|(value, node)| is_near(*value, 1e-4 * NODES[*node as usize].0 as f64)), "{own:?} {cell:?}");
        }
    }
}

#[test]
fn a_model_takes_its_thickness_from_a_view_and_says_what_is_wrong_with_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.msh"), file("4.1", false, &views()[..3])).unwrap();
    let load = |section: &str| {
        let text = format!(
            "[run]\nend = \"1 us\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = 7800\n\
             [[part]]\nname = \"sheet\"\nmaterial = \"steel\"\nelement = \"shell4\"\n\
             mesh = {{ file = \"m.msh\", group = \"all\", scale = \"1 mm\" }}\nsection = {section}\n\
             [[load]]\ngravity = [0, 0, -1]\n"
        );
        load_text("model.toml", &text, folder.path(), &[])
    };
    let model = load("{ thickness_field = \"by element\" }").unwrap();
    let mass = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap().overview().parts[0].mass;
    let exact = 7800.0 * 1e-6 * (0.5e-3 + 0.6e-3 + 0.5 * 0.9e-3);
    assert!((mass / exact - 1.0).abs() < 1e-12, "{mass} {exact}");
    let refused = |section: &str, path: &str, words: &str| {
        let found = load(section).err().map_or(Vec::new(), |it| it.entries);
        assert!(found.len() == 1 && found[0].path == path, "{section}: {found:#?}");
        assert!(format!("{} | {}", found[0].message, found[0].help).contains(words), "{section}: {found:#?}");
    };
    refused("{ thickness_field = \"by nodes\" }", "part[0].section.thickness_field", "did you mean `by node`?");
    refused("{ thickness_field = \"by node\", thickness = \"1 mm\" }", "part[0].section", "thickness_field");
}

#[test]
fn damaged_views_are_refused_with_their_line() {
    let text = String::from_utf8(file("2.2", false, &views()[..1])).unwrap();
    for (from, to) in [
        ("\n3\n0\n1\n7\n", "\n3\n0\n1\n8\n"),
        ("\n3\n0\n1\n7\n", "\n2\n0\n1\n"),
        ("\n0\n1\n7\n", "\n0\n0\n7\n"),
        ("\n11 1.1\n", "\n11 x\n"),
    ] {
        assert!(text.contains(from), "{from:?}");
        let found = read(text.replacen(from, to, 1).as_bytes()).expect_err(to);
        assert!(found.len() == 1 && found[0].path.starts_with("m.msh, line "), "{found:?}");
    }
}
