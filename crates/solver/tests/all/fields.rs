//! What every output field promises by itself, and every history variable that a law declares: it has a place
//! in the history, a unit and a field, and is output.

use crate::patches::{DENSITY, YOUNG, material, solids};
use embate_solver::material::{History, LAWS, Law, LawVisitor, State, VARIABLES_MOST, Variable, eos, with_law};
use embate_solver::model::{Cuboid, Material, Model, Obstacle, Part, Placement, Rectangle, Run, Shape};
use embate_solver::output::{FieldKind, Location, Needs, fields_of};
use embate_solver::simulation::{Options, Simulation};
use embate_solver::tensor::{Plane, Solid};

/// The variables that a law declares, and how many numbers its history has in 2D and in 3D.
fn declared(law: &str) -> (&'static [History], [usize; 2]) {
    struct Ask;
    impl LawVisitor for Ask {
        type Output = (&'static [History], [usize; 2]);
        fn visit<M: Law>(self) -> Self::Output {
            let plane = <M::State<f64, Plane<f64>> as State<f64>>::COUNT;
            (M::VARIABLES, [plane, <M::State<f64, Solid<f64>> as State<f64>>::COUNT])
        }
    }
    with_law(law, Ask).unwrap()
}

fn kind(dimension: usize, name: &str) -> &'static FieldKind {
    fields_of(dimension).iter().find(|kind| kind.name == name).unwrap_or_else(|| panic!("no field {name}"))
}

/// Whether a unit is made of SI symbols: products, quotients and powers.
fn is_unit(unit: &str) -> bool {
    let symbol =
        |part: &str| ["m", "s", "kg", "K", "N", "Pa", "J", "W", "Hz", "rad", "1"].contains(&part.split('^').next().unwrap_or_default());
    unit.is_empty() || unit.split(['/', ' ']).all(symbol)
}

/// A square or cube of unit size that flies at a wall; at rest at first where there is no speed.
fn thrown(dimension: usize, material: Material, speed: f64) -> Model {
    let shape = if dimension == 3 {
        Shape::Cuboid(Cuboid { size: [1.0; 3], elements: [3; 3], ..Cuboid::default() })
    } else {
        Shape::Rectangle(Rectangle { size: [1.0; 2], elements: [3; 2], ..Rectangle::default() })
    };
    let mut model = Model {
        run: Run { end: 1.0, ..Run::default() },
        materials: [("m".to_string(), material)].into(),
        parts: vec![Part { name: "body".into(), material: "m".into(), shape, velocity: [0.0, -speed, 0.0], ..Part::default() }],
        ..Model::default()
    };
    let element = if dimension == 3 { "hex8" } else { "quad4" };
    model.parts[0].element = element.into();
    model.output.pictures = false;
    let wall = |normal: [f64; 3]| Obstacle::wall("wall", [0.0, -1e-3, 0.0], normal);
    model.obstacles = vec![if dimension == 3 { wall([0.0, 1.0, 0.0]) } else { Obstacle::wall("wall", [0.0, -1e-3], [0.0, 1.0]) }];
    model
}

fn simulation(model: &Model) -> Simulation {
    Simulation::new(model, &Options { threads: 1, simd: None }).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn fields_have_a_name_of_their_own_and_say_what_they_are() {
    for dimension in [2, 3] {
        let kinds = fields_of(dimension);
        for (index, kind) in kinds.iter().enumerate() {
            assert!(kinds[..index].iter().all(|other| other.name != kind.name), "two fields {}", kind.name);
            assert!(!kind.doc.is_empty() && is_unit(kind.unit), "{}: {} \"{}\"", kind.name, kind.doc, kind.unit);
        }
        assert_eq!(kinds.iter().map(|kind| kind.name).collect::<Vec<_>>(), fields_of(2).iter().map(|kind| kind.name).collect::<Vec<_>>());
    }
}

#[test]
fn every_variable_of_a_law_has_a_place_in_its_history_and_a_field() {
    let mut all: Vec<&Variable> = Vec::new();
    for law in LAWS {
        let (variables, counts) = declared(law.name);
        assert!(variables.len() + eos::variables().len() <= VARIABLES_MOST);
        for (index, &History { variable, place }) in variables.iter().enumerate() {
            let name = format!("{} of {}", variable.name, law.name);
            assert!(counts.iter().all(|&count| place < count), "{name}: place {place} of {counts:?}");
            let others = &variables[..index];
            assert!(others.iter().all(|other| other.variable != variable && other.place != place), "{name} is there twice");
            all.push(variable);
        }
    }
    all.extend(eos::variables());
    for variable in all {
        for dimension in [2, 3] {
            // Variables of one name are one: they have the same unit and explanation in every law.
            let kind = kind(dimension, variable.name);
            assert_eq!((kind.unit, kind.doc), (variable.unit, variable.doc), "{}", variable.name);
            assert_eq!((kind.location, kind.width(), kind.needs), (Location::Cell, 1, Needs::History(variable)), "{}", variable.name);
        }
    }
}

#[test]
fn every_variable_of_a_law_is_output_once_the_material_is_strained() {
    for law in solids() {
        let (variables, _) = declared(law.name);
        for dimension in [2, 3].into_iter().filter(|_| !variables.is_empty()) {
            let mut simulation = simulation(&thrown(dimension, material(law.name, 0.3), 3.0));
            simulation.advance(0.04, u64::MAX).unwrap();
            let frame = simulation.frame();
            for History { variable, .. } in variables {
                let name = format!("{} of {} in {dimension}D", variable.name, law.name);
                let field = frame.fields.iter().find(|field| field.kind.name == variable.name).unwrap_or_else(|| panic!("no {name}"));
                assert_eq!(field.values.len(), 3usize.pow(dimension as u32), "{name}");
                assert!(
                    field.values.iter().all(|value| value.is_finite()) && field.values.iter().any(|&value| value != 0.0),
                    "{name}: {field:?}"
                );
            }
        }
    }
}

#[test]
fn every_field_has_a_value_for_every_node_or_cell_whether_the_model_needs_it_or_not() {
    for dimension in [2, 3] {
        let mut simulation = simulation(&thrown(dimension, material("elastic", 0.3), 1.0));
        simulation.advance(0.01, u64::MAX).unwrap();
        let [nodes, cells] = [4usize, 3].map(|along| along.pow(dimension as u32));
        for kind in fields_of(dimension) {
            let field = simulation.field(kind.name).unwrap();
            let places = if kind.location == Location::Node { nodes } else { cells };
            assert_eq!(field.values.len(), kind.width() * places, "{} in {dimension}D", kind.name);
            assert!(kind.name == "contact_gap" || field.values.iter().all(|value| value.is_finite()), "{} in {dimension}D", kind.name);
        }
        assert!(simulation.field("no_such_field").is_none());
    }
}

#[test]
fn a_variable_is_that_of_the_cells_own_law_and_zero_where_the_law_has_none() {
    // With an equation of state the density follows the variables of the law, which differ from part to part.
    let with = |law: &str| {
        let mut it = material(law, 0.3);
        it.eos = "linear".into();
        it.parameters.insert("bulk_modulus".into(), YOUNG);
        it
    };
    let mut model = thrown(2, material("elastic", 0.3), 0.0);
    for (index, (name, law)) in [("j2", with("j2")), ("hot", with("johnson_cook")), ("stiff", with("elastic"))].into_iter().enumerate() {
        let mut part = model.parts[0].clone();
        (part.name, part.material) = (name.into(), name.into());
        part.placement = Placement { translation: [2.0 * (index + 1) as f64, 0.0, 0.0], ..Placement::default() };
        model.parts.push(part);
        model.materials.insert(name.into(), law);
    }
    let simulation = simulation(&model);
    let of = |name: &str| simulation.field(name).unwrap().values.chunks(9).map(|part| part[4]).collect::<Vec<_>>();
    assert_eq!(of("density"), [0.0, DENSITY, DENSITY, DENSITY]);
    assert_eq!(of("temperature"), [0.0, 0.0, 300.0, 0.0]);
    assert_eq!(of("plastic_strain"), [0.0; 4]);
}
