//! Warnings of models that are accepted: each where it is right, none where it is not, each once.

use crate::bodies::*;
use crate::patches::material;
use embate_solver::error::{Notice, Warning};
use embate_solver::model::{Constraint, Contact, Material, Model, Obstacle, Placement, Polygon, Rectangle, Shape};

/// Path and first words of all warnings of a model that is made ready.
fn reported(model: &Model) -> Vec<(String, String)> {
    let simulation = simulation(model);
    let warnings = simulation.model_warnings();
    for Warning { message, consequence, help, .. } in warnings {
        assert!(!message.is_empty() && !consequence.is_empty() && !help.is_empty(), "{warnings:?}");
    }
    let texts: Vec<Notice> = warnings.iter().map(Notice::from).collect();
    assert_eq!(simulation.summary().warnings[..texts.len()], texts, "the summary has them");
    warnings.iter().map(|warning| (warning.path.clone(), warning.message.clone())).collect()
}

/// A block of the law at rest above a floor.
fn block(it: Material, elements: [usize; 2]) -> Model {
    // Long enough that waves of the softest cross it.
    let mut model = slender(1.0, 1e9, 1e3);
    add(&mut model, "block", Shape::Rectangle(Rectangle { size: [1.0, 1.0], elements, ..Rectangle::default() }), [0.0; 2]);
    model.obstacles = vec![Obstacle::wall("floor", [0.0, -0.1], [0.0, 1.0])];
    model.materials.insert(model.parts[0].material.clone(), it);
    model
}

fn with(law: &str, numbers: &[(&str, f64)]) -> Material {
    let mut it = material(law, 0.3);
    it.parameters.extend(numbers.iter().map(|&(name, value)| (name.to_string(), value)));
    it
}

#[test]
fn a_sound_model_has_no_warning() {
    assert_eq!(reported(&block(with("j2", &[]), [3, 3])), []);
}

#[test]
fn softening_is_reported_once_for_each_material_that_is_used() {
    let mut model = block(with("j2", &[("hardening", -20.0)]), [3, 3]);
    let name = model.parts[0].material.clone();
    let mut second = model.parts[0].clone();
    second.name = "second".into();
    second.placement = Placement { translation: [3.0, 0.0, 0.0], ..Placement::default() };
    model.parts.push(second);
    model.materials.insert("unused".into(), with("j2", &[("hardening", -20.0)]));
    let found = reported(&model);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, format!("material.{name}.hardening"));
    assert!(found[0].1.contains("nothing is left of it at a plastic strain of 0.5000"), "{found:?}");
    let voce = reported(&block(with("j2_voce", &[("yield", 10.0), ("saturation", 5.0), ("hardening", 0.0)]), [3, 3]));
    assert!(voce.len() == 1 && voce[0].0.ends_with(".saturation") && !voce[0].1.contains("nothing"), "{voce:?}");
    let mut table = with("j2_table", &[]);
    table.lists.insert("stress".into(), vec![10.0, 8.0]);
    assert!(reported(&block(table, [3, 3]))[0].0.ends_with(".stress"));
}

#[test]
fn elements_that_lock_are_reported_where_they_do() {
    for (poisson, locks) in [(0.489, false), (0.491, true)] {
        let mut model = block(material("elastic", poisson), [3, 3]);
        assert_eq!(reported(&model), [], "quad4 does not lock");
        model.parts[0].element = "quad4_full".into();
        let found = reported(&model);
        assert_eq!(found.len(), usize::from(locks), "{found:?}");
        assert!(!locks || found[0].0 == "part[0].material" && found[0].1.contains("0.4910"), "{found:?}");
        model.parts[0].stress_state = "plane_stress".into();
        assert_eq!(reported(&model), [], "a plate gets thinner");
        let polygon = Polygon { outline: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], size: 0.3, ..Polygon::default() };
        model.parts[0].stress_state.clear();
        model.parts[0].shape = Shape::Polygon(polygon);
        let found = reported(&model);
        assert_eq!(found.len(), usize::from(locks), "{found:?}");
        assert!(!locks || found[0].1.contains("`tri3`"), "{found:?}");
        model.parts[0].element_triangles = "tri3_anp".into();
        assert_eq!(reported(&model), []);
    }
    // A rubber whose bulk modulus is a hundred times its shear modulus.
    let mut rubber = block(with("neo_hookean", &[]), [3, 3]);
    rubber.parts[0].element = "quad4_full".into();
    assert_eq!(reported(&rubber), []);
    let it = rubber.materials.values_mut().next_back().unwrap();
    it.parameters.insert("poisson".into(), 0.4999);
    assert_eq!(reported(&rubber).len(), 1);
}

/// A gas at rest.
fn gas(viscosity: f64) -> Material {
    let mut it = with("null", &[("viscosity", viscosity), ("bulk_modulus", 1e6)]);
    it.eos = "linear".into();
    it.parameters.retain(|name, _| ["density", "viscosity", "bulk_modulus"].contains(&name.as_str()));
    it
}

#[test]
fn a_fluid_that_nothing_holds_is_reported_but_not_a_row_of_it() {
    let found = reported(&block(gas(0.0), [3, 3]));
    assert!(found.len() == 1 && found[0].0 == "part[0].material" && found[0].1.contains("`quad4`"), "{found:?}");
    assert_eq!(reported(&block(gas(1.0), [3, 3])), []);
    assert_eq!(reported(&block(gas(0.0), [9, 1])), []);
    let mut held = block(gas(0.0), [3, 3]);
    held.parts[0].element = "quad4_reduced".into();
    assert_eq!(reported(&held), []);
}

#[test]
fn a_drop_on_a_wall_folds_in_quad4_and_not_with_hourglass_control() {
    // What the warning says, and that its remedy is one.
    let drop = |element: &str| {
        let mut model = block(gas(0.0), [1, 1]);
        let disk = embate_solver::model::Disk { centre: [0.0, 0.0101], radius: 0.01, elements: 6 };
        model.parts[0].shape = Shape::Disk(disk);
        model.parts[0].element = element.into();
        model.parts[0].velocity = [0.0, -20.0, 0.0];
        let it = model.materials.values_mut().next_back().unwrap();
        it.parameters.extend([("bulk_modulus".to_string(), 2.2e9), ("density".to_string(), 1000.0)]);
        model.obstacles = vec![Obstacle::wall("floor", [0.0, 0.0], [0.0, 1.0])];
        model.run.bulk_viscosity = [0.06, 1.2];
        model.run.end = 3e-4;
        simulation(&model).advance(model.run.end, u64::MAX).is_ok()
    };
    assert!(!drop("quad4"));
    assert!(drop("quad4_reduced"));
}

#[test]
fn a_part_that_nothing_can_reach_is_reported() {
    let mut model = slender(4e-3, 1e9, 1e3);
    let square = |x: f64| rectangle([x, 0.0], [1.0, 1.0], [2, 2]);
    add(&mut model, "ball", square(0.0), [1.0, 0.0]);
    add(&mut model, "target", square(2.0), [0.0; 2]);
    // Held, and forgotten in the contacts.
    model.constraints.push(Constraint { on: "target.right".into(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() });
    let found = reported(&model);
    assert!(found.len() == 1 && found[0].0 == "part[1]" && found[0].1.contains("`target`"), "{found:?}");
    let without = |change: &dyn Fn(&mut Model)| {
        let mut model = model.clone();
        change(&mut model);
        reported(&model).is_empty()
    };
    assert!(without(&|model| model.contacts.push(Contact::between("hit", "ball", "target"))));
    assert!(without(&|model| gravity(model, [0.0, -10.0])));
    assert!(without(&|model| model.parts[1].velocity = [0.0, 1.0, 0.0]));
    assert!(without(&|model| model.obstacles = vec![Obstacle::wall("floor", [0.0, -1.0], [0.0, 1.0])]));
    let pull = Constraint { on: "target.left".into(), velocity: [Some(1.0.into()), None, None], ..Constraint::default() };
    assert!(without(&|model| model.constraints.push(pull.clone())));
    // What shares nodes with a part that moves is reached.
    let mut shared = slender(4e-3, 1e9, 1e3);
    let mesh = mapped([4, 1], |u, v| [u, v]);
    let groups =
        vec![group("one", 2, mesh.groups[0].cells[..2].iter().cloned()), group("two", 2, mesh.groups[0].cells[2..].iter().cloned())];
    add_groups(&mut shared, embate_solver::model::ImportedMesh { groups, ..mesh }, &["one", "two"], [0.0; 2]);
    shared.parts[0].velocity = [1.0, 0.0, 0.0];
    assert_eq!(reported(&shared), []);
}

#[test]
fn a_corner_beside_an_edge_is_reported_with_its_element_and_the_steps_that_it_takes() {
    for (height, is_reported) in [(0.05, false), (1e-17, true)] {
        let mut model = block(with("elastic", &[]), [3, 3]);
        let outline = vec![[0.0, 0.0], [1.0, 0.0], [0.5, height], [0.0, 1.0]];
        model.parts[0].shape = Shape::Polygon(Polygon { outline, size: 0.1, ..Polygon::default() });
        let found = reported(&model);
        assert_eq!(found.len(), usize::from(is_reported), "{height}: {found:?}");
        assert!(
            !is_reported || found[0].0 == "part[0]" && found[0].1.contains("of part \"block\"") && found[0].1.contains("times shorter"),
            "{found:?}"
        );
    }
    // A grading is no fault of the mesh.
    let mut model = block(with("elastic", &[]), [3, 3]);
    model.parts[0].shape =
        Shape::Rectangle(Rectangle { size: [1.0, 1.0], elements: [60, 3], grading: [200.0, 1.0], ..Rectangle::default() });
    assert_eq!(reported(&model), []);
}
