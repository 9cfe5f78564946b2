//! Units between solids: masses, forces and stiffness are whole ones there, and not those of a metre of depth.

use super::{faults, read};
use embate_solver::model::{ContactLaw, Model, Penalty, PointMass, Spring};

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
fn told(sections: &str) -> Vec<String> {
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
        let found = told(&format!("{BETWEEN}{line}"));
        assert!(found.len() == 1 && found[0].starts_with(&format!("{path}: ")), "{line}: {found:#?}");
    }
    let found = told(&format!("{BETWEEN}stiffness = \"2 kN/m/m\""));
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
    assert_eq!(told(&format!("{ball}mass = \"2 kg/m\"\ninertia = \"30 kg m\"")).len(), 2);
}

#[test]
fn a_contact_stiffness_of_solids_is_per_node_or_per_area() {
    let floor = "[[obstacle]]\nplane.normal = [0, 0, 1]\n";
    let law = |value: &str| sound(&format!("{floor}penalty = {value}")).obstacles.pop().unwrap().interface.law;
    let per_node = ContactLaw::Penalty(Penalty::PerNode(2e9));
    assert_eq!(law("\"2e9 N/m\""), per_node);
    assert_eq!(law("2e9"), per_node);
    assert_eq!(law("\"2e9 Pa/m\""), ContactLaw::Penalty(Penalty::Pressure(2e9)));
    let found = told(&format!("{floor}penalty = \"2e9 N/m/m\""));
    assert!(
        found.len() == 1 && found[0].starts_with("obstacle[0].penalty: ") && found[0].contains("in N/m/m | write it like \"1 N/m\""),
        "{found:?}"
    );
}

#[test]
fn bars_beside_solids_have_an_area() {
    // A box is no bar, which is told too.
    let bars = |area: &str| {
        let part = "[[part]]\nname = \"bars\"\nmaterial = \"steel\"\nelement = \"bar2\"\n";
        let text = format!("{part}box = {{ corner = [5, 0, 0], size = [1, 1, 1], elements = [1, 1, 1] }}\narea = {area}");
        told(&text).into_iter().filter(|fault| fault.starts_with("part[2].area")).collect::<Vec<_>>()
    };
    assert_eq!(bars("\"1 cm^2\""), Vec::<String>::new());
    assert_eq!(bars("\"1 cm\"").len(), 1);
}
