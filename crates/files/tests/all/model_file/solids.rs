//! Units between solids: masses, forces and stiffness are whole ones there, and not those of a metre of
//! depth.

use super::{faults, read};
use embate_solver::model::{Camera, ContactLaw, Model, Penalty, PointMass, Spring};

/// Two boxes, one above the other, and further sections.
fn boxes(sections: &str) -> String {
    let part = |name: &str, z: f64| {
        format!(
            "[[part]]\nname = \"{name}\"\nmaterial = \"steel\"\nbox = {{ corner = [0, 0, {z}], size = [1, 1, 1], elements = [1, 1, 1] }}\n"
        )
    };
    let steel = "[run]\nend = \"1 ms\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = 7800\n";
    format!("{steel}{}{}{sections}\n", part("low", 0.0), part("high", 2.0))
}

fn sound(sections: &str) -> Model {
    read(&boxes(sections)).unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
}

/// Path and words of the faults.
fn reported(sections: &str) -> Vec<String> {
    faults(&boxes(sections)).iter().map(|fault| format!("{}: {} | {}", fault.path, fault.message, fault.help)).collect()
}

const BETWEEN: &str = "[[spring]]\nbetween = [\"low.top\", \"high.bottom\"]\n";

#[test]
fn springs_between_solids_are_whole_ones() {
    let spring = |lines: &str| sound(&format!("{BETWEEN}{lines}")).springs.pop().unwrap();
    let between = ["low.top".to_string(), "high.bottom".to_string()];
    let expected = Spring { between, stiffness: 2000.0, damping: 3.0, strength: Some(5.0), ..Spring::default() };
    assert_eq!(spring("stiffness = \"2 kN/m\"\ndamping = \"3 N s/m\"\nstrength = \"5 N\""), expected);
    assert_eq!(spring("stiffness = 2000\ndamping = \"3 kg/s\"\nstrength = 5"), expected);
    let curve = spring("elongation = [0, \"1 mm\"]\nforce = [0, \"5 kN\"]");
    assert_eq!((curve.elongation, curve.force), (vec![0.0, 0.001], vec![0.0, 5000.0]));
    for (line, path) in [
        ("stiffness = \"2 kN/m/m\"", "spring[0].stiffness"),
        ("damping = \"3 Pa s\"", "spring[0].damping"),
        ("elongation = [0, 1]\nforce = [0, \"5 N/m\"]", "spring[0].force[1]"),
        ("stiffness = 1\nstrength = \"5 N/m\"", "spring[0].strength"),
    ] {
        let found = reported(&format!("{BETWEEN}{line}"));
        assert!(found.len() == 1 && found[0].starts_with(&format!("{path}: ")), "{line}: {found:#?}");
    }
    let found = reported(&format!("{BETWEEN}stiffness = \"2 kN/m/m\""));
    assert!(found[0].contains("N/m") && !found[0].contains("Pa\""), "{found:?}");
}

#[test]
fn masses_of_solids_are_whole_ones() {
    let model = sound("[[point_mass]]\non = \"low\"\nmass = \"2 kg\"");
    assert_eq!(model.point_masses, [PointMass { on: "low".into(), mass: 2.0 }]);
    let ball =
        "[[obstacle]]\nname = \"ball\"\nsphere = { centre = [0, 0, 9], radius = 1 }\nmotion = { x = \"free\", rotation = \"free\" }\n";
    let obstacle = sound(&format!("{ball}mass = \"2 kg\"\ninertia = \"30 kg m^2\"")).obstacles.pop().unwrap();
    assert_eq!((obstacle.mass, obstacle.inertia), (Some(2.0), Some(30.0)));
    assert_eq!(reported(&format!("{ball}mass = \"2 kg/m\"\ninertia = \"30 kg m\"")).len(), 2);
}

#[test]
fn a_contact_stiffness_of_solids_is_per_node_or_per_area() {
    let floor = "[[obstacle]]\nplane.normal = [0, 0, 1]\n";
    let law = |value: &str| sound(&format!("{floor}penalty = {value}")).obstacles.pop().unwrap().interface.law;
    let per_node = ContactLaw::Penalty(Penalty::PerNode(2e9));
    assert_eq!(law("\"2e9 N/m\""), per_node);
    assert_eq!(law("2e9"), per_node);
    assert_eq!(law("\"2e9 Pa/m\""), ContactLaw::Penalty(Penalty::Pressure(2e9)));
    let found = reported(&format!("{floor}penalty = \"2e9 N/m/m\""));
    assert!(
        found.len() == 1 && found[0].starts_with("obstacle[0].penalty: ") && found[0].contains("in N/m/m | write it like \"1 N/m\""),
        "{found:?}"
    );
}

#[test]
fn bars_beside_solids_have_an_area() {
    // A box is no bar, which is reported too.
    let bars = |area: &str| {
        let part = "[[part]]\nname = \"bars\"\nmaterial = \"steel\"\nelement = \"bar2\"\n";
        let text = format!("{part}box = {{ corner = [5, 0, 0], size = [1, 1, 1], elements = [1, 1, 1] }}\narea = {area}");
        reported(&text).into_iter().filter(|fault| fault.starts_with("part[2].area")).collect::<Vec<_>>()
    };
    assert_eq!(bars("\"1 cm^2\""), Vec::<String>::new());
    assert_eq!(bars("\"1 cm\"").len(), 1);
}

/// A deck with a cube, and one whose cube has no eighth corner.
const CUBE: &str = "*NODE\n1, 0,0,0\n2, 1,0,0\n3, 1,1,0\n4, 0,1,0\n5, 0,0,1\n6, 1,0,1\n7, 1,1,1\n8, 0,1,1\n*ELEMENT, TYPE=C3D8, ELSET=cube\n1, 1,2,3,4,5,6,7,8\n*NSET, NSET=low\n1,2,3,4\n*NSET, NSET=high\n5,6,7,8\n";

#[test]
fn parts_that_are_solids_by_their_mesh_alone_have_the_units_of_solids() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.inp"), CUBE).unwrap();
    std::fs::write(folder.path().join("flat.inp"), "*NODE\n1, 0,0\n2, 1,0\n3, 0,1\n*ELEMENT, TYPE=CPE3, ELSET=cube\n1, 1,2,3\n").unwrap();
    std::fs::write(folder.path().join("wrong.inp"), CUBE.replace("6,7,8\n", "6,7,9\n")).unwrap();
    let load = |file: &str, sections: &str| {
        let steel = "[run]\nend = \"1 ms\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = 7800\n";
        let part = |name: &str, file: &str| {
            format!("[[part]]\nname = \"{name}\"\nmaterial = \"steel\"\nmesh = {{ file = \"{file}\", group = \"cube\" }}\n")
        };
        let text = format!("{steel}{}{}{sections}\n", part("one", file), part("two", "cube.inp"));
        embate_files::model_file::load_text("model.toml", &text, folder.path(), &[])
    };
    let reported = |file: &str, sections: &str| {
        let entries = load(file, sections).map_or_else(|diagnostics| diagnostics.entries, |_| Vec::new());
        entries.iter().map(|fault| format!("{}: {} | {}", fault.path, fault.message, fault.help)).collect::<Vec<_>>()
    };
    let model = load("cube.inp", "[[point_mass]]\non = \"one\"\nmass = \"2 kg\"\n[[load]]\non = \"low\"\nforce = [0, 0, \"3 N\"]").unwrap();
    assert!(model.is_of_whole_bodies());
    assert_eq!(model.point_masses, [PointMass { on: "one".into(), mass: 2.0 }]);
    // What is wrong is reported once, and with the unit of solids.
    let found = reported("cube.inp", "[[point_mass]]\non = \"one\"\nmass = \"2 kg/m\"");
    assert!(found.len() == 1 && found[0].starts_with("point_mass[0].mass: ") && !found[0].contains("\"1 kg/m\""), "{found:?}");
    // One of the meshes is faulty: it is reported, and the other one decides.
    let found = reported("wrong.inp", "[[point_mass]]\non = \"two\"\nmass = \"2 kg\"");
    assert!(found.len() == 1 && found[0].starts_with("part[0].mesh.file: "), "{found:?}");
    // Of the plane nothing changes.
    let plane = |mass: &str| {
        let found = reported("flat.inp", &format!("[[point_mass]]\non = \"one\"\nmass = \"{mass}\""));
        found.into_iter().filter(|fault| fault.starts_with("point_mass")).count()
    };
    assert_eq!((plane("2 kg"), plane("2 kg/m")), (0, 1));
}

#[test]
fn pictures_of_solids_have_a_camera() {
    let camera = sound("[output]\ncamera = { from = [1, -1, 0.6], at = [0, \"5 mm\", 1], zoom = 2 }\n").output.camera;
    assert_eq!(camera, Some(Camera { from: [1.0, -1.0, 0.6], at: Some([0.0, 0.005, 1.0]), zoom: 2.0, ..Camera::default() }));
}

/// Each of these lines is refused alone, at its path and on a line of the text.
fn each_is_refused(text: &dyn Fn(&str) -> String, cases: &[(&str, &str, &str)]) {
    for (lines, path, words) in cases {
        let found = faults(&text(lines));
        assert_eq!(found.len(), 1, "{lines}: {found:#?}");
        let shown = format!("{} | {}", found[0].message, found[0].help);
        assert!(found[0].path == *path && shown == *words && found[0].line > 0, "{lines}: {found:#?}");
    }
}

#[test]
fn what_only_the_plane_knows_is_refused_in_3d_on_its_line() {
    let cases = [
        (
            "[[obstacle]]\ncircle = { centre = [0, -2, 0], radius = 1 }",
            "obstacle[0].circle",
            "there are no circles in 3D | take `sphere` or `cylinder`",
        ),
        (
            "[[obstacle]]\npolyline = { points = [[0, -2], [1, -2]] }",
            "obstacle[0].polyline",
            "there are no polylines in 3D | take `plane`, `sphere`, `cylinder` or `stl`, or a rigid part",
        ),
        (
            "[[obstacle]]\nplane = { point = [0, 0, -1], normal = [0, 0, 1], length = 2 }",
            "obstacle[0].plane.length",
            "a plane in 3D has no end | leave `length` out",
        ),
    ];
    each_is_refused(&boxes, &cases);
}

#[test]
fn what_only_space_knows_is_refused_in_2d_on_its_line() {
    let flat = |sections: &str| {
        let part = "[[part]]\nname = \"flat\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [1, 1], elements = [1, 1] }\n";
        let steel = "[run]\nend = \"1 ms\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = 7800\n";
        format!("{steel}{part}{sections}\n")
    };
    assert!(read(&flat("rigid = { x = 0, y = 0, rotation = 0 }\n[output]\nmirror = [\"x\", \"y\"]")).is_ok());
    let remedy = "leave it out, or make the parts solid: `extrude` them, or give them a 3D shape";
    let (no_z, no_camera, no_half) = (
        format!("there is no `z` in 2D | {remedy}"),
        format!("pictures of 2D models are seen along z: they have no camera | {remedy}"),
        format!("a picture of a 2D model has no other half at z = 0 | {remedy}"),
    );
    let cases = [
        ("rigid = { z = 0 }", "part[0].rigid.z", no_z.as_str()),
        ("rigid = { x = 0, z = \"1 m/s\" }", "part[0].rigid.z", no_z.as_str()),
        ("[output]\ncamera = { from = [1, 1, 1] }", "output.camera", no_camera.as_str()),
        ("[output]\nmirror = [\"x\", \"z\"]", "output.mirror", no_half.as_str()),
    ];
    each_is_refused(&flat, &cases);
}

#[test]
fn bars_beside_parts_of_another_dimension_are_called_bars_with_their_shape() {
    let area = |unit: &str| format!("[[part]]\nname = \"net\"\nmaterial = \"steel\"\nelement = \"bar2\"\narea = \"1e-4 {unit}\"\n");
    // In 2D beside solids.
    let found = reported(&format!("{}truss.lines = [[[0, 0], [1, 0]]]", area("m^2")));
    let help = "take `space_truss` with `element = \"bar2\"`: bars in 3D";
    assert!(found.contains(&format!("part[2].truss: the part is 2D, but part `low` is a solid | {help}")), "{found:#?}");
    // In 3D beside what is flat.
    let flat = "[[part]]\nname = \"flat\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [1, 1], elements = [1, 1] }\n";
    let steel = "[run]\nend = \"1 ms\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = 7800\n";
    let text = format!("{steel}{flat}{}space_truss.lines = [[[0, 0, 0], [1, 0, 1]]]\n", area("m^2"));
    let found: Vec<String> = faults(&text).iter().map(|fault| format!("{}: {} | {}", fault.path, fault.message, fault.help)).collect();
    let help = "take `truss`: bars in 2D; or make the other parts solids, such as by `extrude`";
    assert!(found.contains(&format!("part[1].space_truss: the part is of bars in 3D, but part `flat` is 2D | {help}")), "{found:#?}");
}
