//! Decks of solids: faces, instances in 3D, and what does not go with solids.

use super::{group, read};
use embate_files::PathPolicy;
use embate_files::abaqus::import::{Units, import};
use embate_files::model_file::load_text;
use embate_solver::mesh::cell::CellKind;
use embate_solver::mesh::{Mesh, signed_volume};
use embate_solver::model::{Constraint, CurveShape, Drive, ImportedMesh, InitialPenetration, Load, Model, Motion, Partners};
use std::fs;

/// A cube on [0, 1]³, a wedge beside it (x from 1 to 2) and a tetrahedron above it.
const SOLID: &str = "*NODE
 1, 0,0,0
 2, 1,0,0
 3, 1,1,0
 4, 0,1,0
 5, 0,0,1
 6, 1,0,1
 7, 1,1,1
 8, 0,1,1
 9, 2,0,0
10, 2,0,1
11, 0,0,2
99, 9,9,9
*ELEMENT, TYPE=C3D8R, ELSET=cube
 1, 1,2,3,4,
 5,6,7,8
*ELEMENT, TYPE=C3D6, ELSET=wedge
 2, 2,9,3, 6,10,7
*ELEMENT, TYPE=C3D4, ELSET=tip
 3, 5,6,8,11
*ELSET, ELSET=body
 cube, wedge
*SURFACE, NAME=bottom
 cube, S1
 wedge, S1
*SURFACE, NAME=top
 cube, S2
*SURFACE, NAME=outside
 ,
*NSET, NSET=edge
 1, 2, 9
";

fn positions(mesh: &ImportedMesh, cell: &[u32]) -> Vec<[f64; 3]> {
    cell.iter().map(|&node| mesh.positions[node as usize]).collect()
}

#[test]
fn hexahedra_wedges_and_tetrahedra_become_solids_and_faces_their_surfaces() {
    let mesh = read(SOLID).unwrap();
    assert_eq!((mesh.dimension(), mesh.positions.len()), (3, 11));
    assert_eq!(group(&mesh, "cube").cells, [vec![0, 1, 2, 3, 4, 5, 6, 7]]);
    assert_eq!((group(&mesh, "wedge").dimension, &group(&mesh, "wedge").cells), (3, &vec![vec![1, 8, 2, 5, 9, 6]]));
    assert_eq!(group(&mesh, "body").cells.len(), 2);
    assert_eq!((group(&mesh, "bottom").dimension, &group(&mesh, "bottom").cells), (2, &vec![vec![0, 1, 2, 3], vec![1, 8, 2]]));
    assert!(positions(&mesh, &group(&mesh, "top").cells[0]).iter().all(|x| x[2] == 1.0));
    // Six and five faces but for the two where cube and wedge meet, and four of the tetrahedron, which shares
    // no whole face.
    assert_eq!(group(&mesh, "outside").cells.len(), 6 + 5 - 2 + 4);
    assert_eq!(group(&mesh, "edge").dimension, 0);
}

#[test]
fn every_face_of_a_type_is_that_of_the_manual() {
    // What the nodes of a face have in common, from S1 on.
    let all = [
        ("cube", vec![(2, 0.0), (2, 1.0), (1, 0.0), (0, 1.0), (1, 1.0), (0, 0.0)]),
        ("tip", vec![(2, 1.0), (1, 0.0)]),
        ("wedge", vec![(2, 0.0), (2, 1.0), (1, 0.0)]),
    ];
    for (set, faces) in all {
        for (face, (axis, at)) in (1..).zip(faces) {
            let mesh = read(&format!("{SOLID}*SURFACE, NAME=face\n{set}, S{face}\n")).unwrap();
            let cell = &group(&mesh, "face").cells[0];
            assert!(positions(&mesh, cell).iter().all(|x| x[axis] == at), "{set} S{face}: {cell:?}");
        }
    }
    let faults = read(&format!("{SOLID}*SURFACE, NAME=face\ntip, S5\n")).unwrap_err();
    assert!(
        faults[0].message.contains("an element C3D4 has no face \"S5\"") && faults[0].help == "its faces are S1 to S4",
        "{}",
        faults[0]
    );
}

#[test]
fn ten_node_tetrahedra_keep_their_nodes_and_other_solids_of_second_order_their_corners() {
    let deck = "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n10,0,1,1\n\
        *ELEMENT, TYPE=C3D10M, ELSET=tip\n1, 1,2,3,4,5,6,7,8,\n9,10\n*SURFACE, NAME=face\ntip, S3\n*NSET, NSET=middle\n9\n";
    let mesh = read(deck).unwrap();
    assert_eq!(group(&mesh, "tip").cells, [(0..10).collect::<Vec<u32>>()]);
    assert_eq!(
        (group(&mesh, "face").cells.len(), group(&mesh, "face").cells[0].len(), &group(&mesh, "middle").cells),
        (1, 3, &vec![vec![8]])
    );
    for edge in embate_solver::mesh::cell::CellKind::Tetrahedron10.facts().edges.iter().zip(4..) {
        let ([a, b], middle) = (edge.0.map(|k| mesh.positions[usize::from(k)]), mesh.positions[edge.1]);
        assert!((0..3).all(|d| middle[d] == 0.5 * (a[d] + b[d])));
    }
    let twice: Vec<String> = (1..=20).map(|k| k.to_string()).collect();
    let nodes: String = (9..=20).map(|k| format!("{k},0.5,{k},0\n")).collect();
    let cube = "1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
    let deck = format!("*NODE\n{cube}{nodes}*ELEMENT, TYPE=C3D20R, ELSET=cube\n1, {},\n{}\n", twice[..10].join(","), twice[10..].join(","));
    let mesh = read(&deck).unwrap();
    assert_eq!((&group(&mesh, "cube").cells, mesh.positions.len()), (&vec![(0..8).collect::<Vec<u32>>()], 8));
    assert_eq!(mesh.notes, ["1 elements C3D20R, which become hexahedra of 8 nodes"]);
}

#[test]
fn six_node_triangles_keep_their_nodes_and_quadrilaterals_of_second_order_their_corners() {
    let nodes = "*NODE\n1,0,0\n2,2,0\n3,0,2\n4,1,0\n5,1,1\n6,0,1\n7,2,2\n8,2,1\n9,1,2\n";
    for name in ["CPE6", "CPE6M", "CPE6H", "CPE6MH", "CPS6", "CPS6M", "CAX6", "CAX6M", "CAX6H", "CAX6MH"] {
        let deck = format!("{nodes}*ELEMENT, TYPE={name}, ELSET=tip\n1, 1,2,3,4,5,6\n*SURFACE, NAME=face\ntip, S2\n");
        let mesh = read(&deck).unwrap();
        assert_eq!(group(&mesh, "tip").cells, [(0..6).collect::<Vec<u32>>()], "{name}");
        assert_eq!((&group(&mesh, "face").cells, mesh.notes.is_empty()), (&vec![vec![1, 2]], true), "{name}");
    }
    for name in ["CPE8", "CPS8R", "CAX8R"] {
        let mesh = read(&format!("{nodes}*ELEMENT, TYPE={name}, ELSET=all\n1, 1,2,7,3,4,8,9,6\n")).unwrap();
        assert_eq!((group(&mesh, "all").cells[0].len(), mesh.positions.len()), (4, 4), "{name}");
        assert_eq!(mesh.notes, [format!("1 elements {name}, which become quadrilaterals of 4 nodes")]);
    }
}

#[test]
fn solids_of_negative_volume_are_turned_and_flat_ones_refused() {
    let swapped = SOLID
        .replace(" 1, 1,2,3,4,\n 5,6,7,8", " 1, 5,6,7,8, 1,2,3,4")
        .replace("2,9,3, 6,10,7", "6,10,7, 2,9,3")
        .replace("5,6,8,11", "5,8,6,11");
    let mesh = read(&swapped).unwrap();
    for name in ["cube", "wedge", "tip"] {
        let cell = group(&mesh, name).elements().flatten().next().unwrap();
        assert!(signed_volume(cell.kind, &positions(&mesh, cell.nodes)) > 0.0, "{name}");
    }
    // S1 is still the face of the first nodes that are written.
    assert!(positions(&mesh, &group(&mesh, "bottom").cells[0]).iter().all(|x| x[2] == 1.0));
    let flat = read(&SOLID.replace("11, 0,0,2", "11, 1,1,1")).unwrap_err();
    assert!(flat[0].message == "element 3 has no volume" && flat[0].path == "d.inp, line 20", "{}", flat[0]);
}

#[test]
fn instances_of_solids_are_turned_about_any_axis() {
    let deck = |axis: &str| {
        format!(
            "*PART, NAME=P\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,2,0\n4,0,0,3\n*ELEMENT, TYPE=C3D4, ELSET=E\n1,1,2,3,4\n*END PART\n\
             *ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n1,0,0\n{axis}\n*END INSTANCE\n*END ASSEMBLY\n"
        )
    };
    let near = |axis: &str, expected: [[f64; 3]; 4]| {
        let mesh = read(&deck(axis)).unwrap();
        let found = mesh.positions.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-15);
        assert!(found, "{axis}: {:?}", mesh.positions);
    };
    // Shifted by 1 along x, then by the right hand about x, about y through (1, 0, 0), and a third of a turn
    // about the diagonal.
    near("0,0,0, 5,0,0, 90", [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 2.0], [1.0, -3.0, 0.0]]);
    near("1,0,0, 1,1,0, -90", [[1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 2.0, 0.0], [-2.0, 0.0, 0.0]]);
    near("0,0,0, 1,1,1, 120", [[0.0, 1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 1.0, 2.0], [3.0, 1.0, 0.0]]);
    let faults = read(&deck("1,1,1, 1,1,1, 30")).unwrap_err();
    assert!(faults[0].message.contains("axis without direction"), "{}", faults[0]);
}

#[test]
fn plane_elements_do_not_go_with_solids() {
    let faults = read(&format!("{SOLID}*ELEMENT, TYPE=CPE4\n7, 1,2,3,4\n")).unwrap_err();
    assert!(faults[0].message == "element type CPE4 is one of 2D, beside bodies in 3D", "{}", faults[0]);
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("solid.inp"), SOLID).unwrap();
    // As a mesh they are parts of a model.
    let model = "run.end = \"1 us\"\n[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n\
        [[part]]\nname = \"a\"\nmaterial = \"steel\"\nelement = \"hex8_reduced\"\nmesh = { file = \"solid.inp\", group = \"body\", scale = \"1 mm\" }\n\
        [[part]]\nname = \"b\"\nmaterial = \"steel\"\nelement = \"tet4\"\nmesh = { file = \"solid.inp\", group = \"tip\", scale = \"1 mm\" }\n\
        [[constraint]]\non = \"bottom\"\nfixed = [\"x\", \"y\", \"z\"]\n[[load]]\npressure = 1e6\non = \"bottom\"\n";
    let model = load_text("m", model, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    let mesh = Mesh::<3>::new(&model).unwrap_or_else(|faults| panic!("{faults:#?}"));
    assert_eq!((mesh.elements_of(0), mesh.elements_of(1), mesh.positions.len()), (2, 1, 11));
    assert!(mesh.positions.iter().flatten().all(|x| *x <= 0.002));
    let surface = mesh.surface("bottom", |_| false).unwrap();
    assert_eq!(embate_solver::mesh::surface::Sided::facets(&surface).len(), 2);
}

/// A cube of C3D8R that flies at a rigid plate of C3D8I and a held bar of C3D6 and C3D4, in mm, t, s.
const DECK: &str = "*HEADING
two blocks
*NODE
 1, 0,0,0
 2, 1,0,0
 3, 1,1,0
 4, 0,1,0
 5, 0,0,1
 6, 1,0,1
 7, 1,1,1
 8, 0,1,1
11, 0,0,-2
12, 1,0,-2
13, 1,1,-2
14, 0,1,-2
15, 0,0,-1
16, 1,0,-1
17, 1,1,-1
18, 0,1,-1
21, 5,0,0
22, 6,0,0
23, 5,1,0
24, 5,0,1
25, 6,0,1
26, 5,1,1
27, 5,0,3
99, 0.5,0.5,-2
*ELEMENT, TYPE=C3D8R, ELSET=CUBE
1, 1,2,3,4,5,6,7,8
*ELEMENT, TYPE=C3D8I, ELSET=PLATE
2, 11,12,13,14,15,16,17,18
*ELEMENT, TYPE=C3D6, ELSET=BAR
3, 21,22,23,24,25,26
*ELEMENT, TYPE=C3D4, ELSET=BAR
4, 24,25,26,27
*NSET, NSET=REF
99
*NSET, NSET=FOOT
21, 22, 23
*NSET, NSET=TIP
27
*NSET, NSET=ALL-CUBE
1,2,3,4,5,6,7,8
*SURFACE, NAME=UNDER
CUBE, S1
*SURFACE, NAME=OVER
PLATE, S2
*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL
*SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL
*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL
*MATERIAL, NAME=STEEL
*DENSITY
7.85e-9
*ELASTIC
210000, 0.3
*RIGID BODY, REF NODE=REF, ELSET=PLATE
*AMPLITUDE, NAME=RAMP
0, 0, 1e-3, 1
*SURFACE INTERACTION, NAME=ROUGH
*FRICTION
0.2
*BOUNDARY
REF, 1, 2
REF, 4, 6
FOOT, ENCASTRE
TIP, ZSYMM
*INITIAL CONDITIONS, TYPE=VELOCITY
ALL-CUBE, 1, 10
ALL-CUBE, 3, -5000
*STEP
*DYNAMIC, EXPLICIT
, 1e-5
*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=RAMP
REF, 3, 3, 200
*CLOAD
TIP, 2, 3
*DLOAD
CUBE, GRAV, 9810, 0, 0, -1
BAR, P1, 4
*CONTACT PAIR, INTERACTION=ROUGH
UNDER, OVER
*END STEP
";

/// The model that is made of a deck, and the report.
fn imported(deck: &str) -> (Model, String, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("deck.inp"), deck).unwrap();
    let units = Units::parse("mm,t,s").unwrap();
    let made = import(&folder.path().join("deck.inp"), &units, PathPolicy::Folder).unwrap_or_else(|faults| panic!("{faults:#?}"));
    fs::write(folder.path().join("mesh.inp"), &made.mesh).unwrap();
    let model = load_text("m", &made.model, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}\n{}", made.model));
    (model, made.model, made.report.text())
}

#[test]
fn a_deck_of_solids_becomes_a_model_of_3d() {
    let (model, text, report) = imported(DECK);
    assert!(report.contains("nothing was ignored"), "{report}");
    assert!(model.is_of_whole_bodies() && Mesh::<3>::new(&model).is_ok());
    let part = |name: &str| model.parts.iter().find(|part| part.name == name).unwrap_or_else(|| panic!("{name}: {text}"));
    let elements: Vec<&str> = ["CUBE", "PLATE"].iter().map(|name| part(name).element.as_str()).collect();
    assert_eq!(elements, ["hex8_reduced", "hex8_reduced_assumed_strain"]);
    let bar: Vec<&str> = [CellKind::Wedge, CellKind::Tetrahedron]
        .into_iter()
        .filter_map(|cell| part("BAR").element_in(3, cell))
        .map(|kind| kind.name)
        .collect();
    assert_eq!(bar, ["wedge6", "tet4"]);
    assert!([[0.01, 0.0, -5.0]].iter().all(|v| part("CUBE").velocity.iter().zip(v).all(|(a, b)| (a - b).abs() < 1e-12)), "{text}");
    assert_eq!(part("BAR").velocity, [0.0; 3]);
    // Held along x and y and against turning; along z it follows the amplitude.
    let still = || Some(Drive::Constant(0.0));
    let velocity = [still(), still(), Some(Drive::Curve("RAMP".into()))];
    assert_eq!(part("PLATE").rigid, Some(Motion { velocity, spin: still() }));
    let CurveShape::Table { values, .. } = &model.curves["RAMP"].shape else { panic!("{text}") };
    assert!((values[1] - 0.2).abs() < 1e-12 && model.curves.len() == 1, "{text}");
    let fixed = |on: &str| {
        let all: Vec<&Constraint> = model.constraints.iter().filter(|it| it.on == on).collect();
        assert_eq!(all.len(), 1, "{on}: {text}");
        all[0].velocity.clone()
    };
    assert_eq!((fixed("FOOT"), fixed("TIP")), ([still(), still(), still()], [None, None, still()]));
    assert_eq!(model.contacts.len(), 1);
    let contact = &model.contacts[0];
    assert_eq!(contact.partners, Partners::Between(["UNDER".into(), "OVER".into()]));
    assert_eq!(contact.interface.friction.map(|it| it.coefficient), Some(0.2));
    assert_eq!(contact.interface.initial_penetration, InitialPenetration::Ignore);
    let loads = |wanted: fn(&Load) -> bool| model.loads.iter().filter(|load| wanted(load)).count();
    assert_eq!(model.loads.len(), 3, "{text}");
    assert_eq!(loads(|load| matches!(load, Load::Force { force: [0.0, f, 0.0], .. } if (f - 3.0).abs() < 1e-12)), 1, "{text}");
    assert_eq!(loads(|load| matches!(load, Load::Gravity { acceleration: [0.0, 0.0, g], .. } if (g + 9.81).abs() < 1e-12)), 1, "{text}");
    assert_eq!(loads(|load| matches!(load, Load::Pressure { .. })), 1);
}

#[test]
fn what_solids_can_not_have_is_reported() {
    let (model, text, report) =
        imported(&DECK.replace("*CONTACT PAIR, INTERACTION=ROUGH\nUNDER, OVER\n", "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n"));
    assert!(matches!(&model.contacts[0].partners, Partners::Bodies(parts) if parts.is_empty()), "{text}");
    assert!(report.contains("nothing was ignored"), "{report}");
    // Turned about x alone: held about all axes.
    let (model, _, report) = imported(&DECK.replace("REF, 4, 6\n", "REF, 4, 4\n"));
    let plate = model.parts.iter().find(|part| part.name == "PLATE").unwrap();
    assert_eq!(plate.rigid.as_ref().unwrap().spin, Some(Drive::Constant(0.0)));
    assert!(report.contains("rotations are held about all axes or about none"), "{report}");
    // A spin at the start has no place in the import.
    let (_, _, report) = imported(&DECK.replace("ALL-CUBE, 1, 10\n", "ALL-CUBE, 1, 10\nALL-CUBE, 6, 3\n"));
    assert!(report.contains("an angular velocity"), "{report}");
}
