//! Sound models: values, defaults, names, overrides, mesh files, the files of the project.

use super::{SOUND, changed, read};
use embate_files::model_file::{STARTERS, load, load_text, reference_markdown, schema};
use embate_solver::input::sections::SECTIONS;
use embate_solver::model::{
    Cadence, ContactLaw, Drive, Formulation, InitialStress, Interface, Load, Model, Obstacle, Output, Part, Partners, Penalty,
    PenaltySource, PictureView, ProbeAt, Rectangle, Relaxation, Ring, Run, Shape, Symmetry,
};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::{Path, PathBuf};

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn sound(text: &str) -> Model {
    read(text).unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
}

#[test]
fn the_tube_plate_example_has_exactly_the_values_that_it_shows() {
    let model = load(&project().join("examples/tube-plate"), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    assert_eq!((model.name.as_str(), model.title.as_str()), ("tube-plate", "Tube on plate"));
    assert_eq!(model.run, Run { end: 0.01, ..Run::default() });
    let steel = &model.materials["steel"];
    assert_eq!(steel.law, "j2");
    for (key, value) in [("young", 2e11), ("poisson", 0.3), ("density", 7800.0), ("yield", 1e8), ("hardening", 5e10)] {
        assert_eq!(steel.parameters[key], value, "{key}");
    }
    let [tube, plate] = model.parts.as_slice() else { panic!("two parts") };
    let ring = Shape::Ring(Ring {
        centre: [0.0, 0.1],
        inner: 0.094,
        outer: 0.1,
        from: -FRAC_PI_2,
        to: FRAC_PI_2,
        elements: [1, 40],
        ..Ring::default()
    });
    assert_eq!((tube.name.as_str(), tube.element.as_str(), &tube.shape, tube.velocity), ("tube", "quad4", &ring, [0.0, -50.0, 0.0]));
    let rectangle = Shape::Rectangle(Rectangle { corner: [0.0, -0.003], size: [0.6, 0.003], elements: [120, 3], ..Rectangle::default() });
    assert_eq!((plate.name.as_str(), &plate.shape, plate.velocity), ("plate", &rectangle, [0.0, 50.0, 0.0]));
    let contact = &model.contacts[0];
    assert_eq!(
        (contact.name.as_str(), contact.interface.law.clone(), contact.formulation),
        ("impact", ContactLaw::Penalty(Penalty::PerNode(3.5e11)), Formulation::DoublePass)
    );
    assert_eq!(contact.partners, Partners::Between(["tube".into(), "plate".into()]));
    let wall = Obstacle { parts: vec!["plate".into()], ..Obstacle::wall("wall", [0.0; 3], [1.0, 0.0, 0.0]) };
    assert_eq!(model.obstacles, [wall]);
    assert_eq!(model.symmetries, [Symmetry { parts: vec![], point: [0.0, 0.0, 0.0], normal: [1.0, 0.0, 0.0] }]);
    let probes: Vec<_> = model.probes.iter().map(|probe| (probe.name.as_str(), probe.at.clone())).collect();
    let point = |part: &str, point| ProbeAt::Point { part: part.to_string(), point };
    assert_eq!(
        probes,
        [("A", point("tube", [0.0, 0.0, 0.0])), ("T", point("tube", [0.0, 0.2, 0.0])), ("B", point("plate", [0.0, 0.0, 0.0]))]
    );
    assert_eq!(
        model.output,
        Output { fields: Cadence::Count(100), history: Cadence::Interval(1e-5), mirror: [true, false, false], ..Output::default() }
    );
}

#[test]
fn what_is_left_out_has_the_default_of_the_solver() {
    let model = sound(SOUND);
    assert_eq!(model.run, Run { end: 1e-3, ..Run::default() });
    assert_eq!(model.output, Output { fields: Cadence::Count(10), ..Output::default() });
    assert_eq!(sound(&changed("[output]\nfields = 10\n", "")).output, Output::default());
    let view = sound(&changed("fields = 10\n", "picture_view = { corner = [\"-2 mm\", 0], size = [1, \"5 cm\"] }\n")).output.picture_view;
    assert_eq!(view, Some(PictureView { corner: [-0.002, 0.0], size: [1.0, 0.05] }));
    let part = &model.parts[0];
    let [name, material] = [&part.name, &part.material].map(String::clone);
    assert_eq!(*part, Part { name, material, shape: part.shape.clone(), ..Part::default() });
    let obstacle = &model.obstacles[0];
    assert_eq!(*obstacle, Obstacle { parts: vec!["plate".into()], ..Obstacle::fixed("obstacle", obstacle.shape.clone()) });
    assert_eq!(sound(&changed("end = \"1 ms\"\n", "end = \"1 ms\"\nrelaxation = {}\n")).run.relaxation, Some(Relaxation::default()));
    assert_eq!(model.contacts[0].interface, Interface::default());
    assert_eq!((model.contacts[0].name.as_str(), model.obstacles[0].name.as_str()), ("tube-plate", "obstacle"));
    assert_eq!(model.constraints[0].velocity, [Some(0.0.into()), None, None]);
    assert_eq!(model.loads, [Load::Gravity { parts: vec![], acceleration: [0.0, -9.81, 0.0], curve: None }]);
    let full = sound(&changed("from = \"-90 deg\", to = \"90 deg\", ", ""));
    assert!(matches!(full.parts[0].shape, Shape::Ring(Ring { from: 0.0, to: TAU, .. })), "{:?}", full.parts[0].shape);
}

#[test]
fn names_that_are_left_out_do_not_collide() {
    let text = changed(
        "[[obstacle]]\n",
        "[[obstacle]]\nname = \"obstacle2\"\nplane.normal = [0, 1]\n[[obstacle]]\nplane.normal = [0, 1]\n[[obstacle]]\n",
    );
    let text = text.replace("[[symmetry]]", "[[contact]]\nbetween = [\"tube.outer\", \"plate.top\"]\n[[symmetry]]");
    let model = sound(&text);
    assert_eq!(model.obstacles[..3].iter().map(|it| it.name.as_str()).collect::<Vec<_>>(), ["obstacle2", "obstacle", "obstacle3"]);
    assert_eq!(model.contacts[1].name, "tube_outer-plate_top");
}

#[test]
fn a_contact_can_be_single_pass_with_a_scaled_or_a_pressure_penalty() {
    let contact = |lines: &str| {
        sound(&changed("between = [\"tube\", \"plate\"]\n", &format!("between = [\"tube\", \"plate\"]\n{lines}\n"))).contacts[0].clone()
    };
    let penalty = |lines: &str| match contact(lines).interface.law {
        ContactLaw::Penalty(penalty) => penalty,
        other => panic!("{other:?}"),
    };
    assert_eq!(contact("formulation = \"single_pass\"\nslave = \"plate\"").formulation, Formulation::SinglePass { slave: 1 });
    assert_eq!(penalty("penalty_scale = 0.1"), Penalty::Automatic { source: PenaltySource::WaveModulus, scale: 0.1 });
    assert_eq!(penalty("penalty = \"1e14 Pa/m\""), Penalty::Pressure(1e14));
    assert_eq!(penalty("penalty = \"1e14 N/m^3\""), Penalty::Pressure(1e14));
    assert_eq!(penalty("penalty = 3.5e11"), Penalty::PerNode(3.5e11));
    assert_eq!(contact("search = \"boxes\"").search, "boxes");
}

#[test]
fn fixed_and_moving_components_are_joined() {
    let constraint = |lines: &str| sound(&changed("fixed = \"x\"", lines)).constraints[0].velocity.clone();
    assert_eq!(constraint("fixed = [\"x\", \"y\"]"), [Some(0.0.into()), Some(0.0.into()), None]);
    assert_eq!(constraint("fixed = \"x\"\nvelocity = { y = \"1 mm/s\" }"), [Some(0.0.into()), Some(0.001.into()), None]);
    assert_eq!(constraint("velocity.x = -2"), [Some(Drive::Constant(-2.0)), None, None]);
}

#[test]
fn probes_take_points_nodes_and_sets() {
    let probe = |lines: &str| sound(&changed("part = \"tube\"\npoint = [0, 0]", lines)).probes[0].at.clone();
    assert_eq!(probe("part = \"tube\"\nnode = 81"), ProbeAt::Node { part: "tube".into(), node: 81 });
    assert_eq!(probe("set = \"tube.start\""), ProbeAt::Set { set: "tube.start".into() });
}

#[test]
fn overrides_replace_and_add_values() {
    let set = |texts: &[&str]| {
        let texts: Vec<String> = texts.iter().map(ToString::to_string).collect();
        load_text("m", SOUND, Path::new("."), &texts).unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
    };
    assert_eq!(set(&["run.end=5 ms"]).run.end, 0.005);
    assert_eq!(set(&["run.end = \"5 ms\""]).run.end, 0.005);
    assert_eq!(set(&["part.tube.velocity=[0, \"-50 m/s\"]"]).parts[0].velocity, [0.0, -50.0, 0.0]);
    assert_eq!(set(&["part.1.velocity=[0, 7]", "part[1].velocity[0]=3"]).parts[1].velocity, [3.0, 7.0, 0.0]);
    assert_eq!(set(&["material.steel.hardening=1 GPa"]).materials["steel"].parameters["hardening"], 1e9);
    assert_eq!(set(&["part.tube.ring.elements=[2, 80]"]).parts[0].shape.sides().len(), 4);
    assert_eq!(set(&["title=a new one"]).title, "a new one");
    assert!(!set(&["output.pictures=false"]).output.pictures);
}

#[test]
fn the_starter_model_is_sound_whatever_its_name() {
    for name in ["crash", "a \"quoted\\ name\n", "Zusammenstoß", ""] {
        let model = sound(&STARTERS[0].model(name));
        assert_eq!((model.parts.len(), model.contacts.len()), (2, 1));
    }
    assert_eq!(sound(&STARTERS[0].model("crash")).title, "crash");
    for starter in STARTERS {
        let text = starter.model("crash");
        assert!(text.starts_with("#:schema ./embate.schema.json\n"), "{}", starter.name);
        let model = sound(&text);
        assert!(model.title == "crash" && model.warnings().is_empty(), "{}", starter.name);
        assert_eq!(model.dimension() == 3, !["2d", "axisymmetric"].contains(&starter.name));
    }
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_change_nothing() {
    let plain = sound(SOUND);
    assert_eq!(sound(&SOUND.replace('\n', "\r\n")), plain);
    assert_eq!(sound(&format!("\u{feff}{SOUND}")), plain);
}

#[test]
fn a_model_is_named_after_its_folder_or_file() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("crash");
    std::fs::create_dir_all(&inner).unwrap();
    std::fs::write(inner.join("model.toml"), SOUND).unwrap();
    std::fs::write(inner.join("other.toml"), SOUND).unwrap();
    assert_eq!(load(&inner, &[]).unwrap().name, "crash");
    assert_eq!(load(&inner.join("model.toml"), &[]).unwrap().name, "crash");
    assert_eq!(load(&inner.join("other.toml"), &[]).unwrap().name, "other");
}

#[test]
fn the_manual_in_the_docs_is_the_one_that_the_program_makes() {
    let path = project().join("docs/model-file.md");
    let made = reference_markdown();
    if std::env::var_os("EMBATE_BLESS").is_some() {
        std::fs::write(&path, &made).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(kept == made, "docs/model-file.md is not what the program makes: run this test with EMBATE_BLESS=1 and commit the file");
}

#[test]
fn the_schema_names_every_section_and_key() {
    let schema = schema();
    for name in [
        "\"run\"",
        "\"part\"",
        "\"material\"",
        "\"contact\"",
        "\"penalty_scale\"",
        "\"friction_decay\"",
        "\"rotation\"",
        "\"curve\"",
        "\"elements\"",
        "\"2020-12\"",
        "\"quad4\"",
        "\"const\": \"j2\"",
    ] {
        assert!(schema.contains(name.trim_matches(|c| name == "\"2020-12\"" && c == '"')), "{name}");
    }
    for key in SECTIONS.iter().flat_map(|section| section.all_keys()) {
        assert!(schema.contains(&format!("\"{}\": {{", key.name)), "{}", key.name);
    }
    assert_eq!(schema.matches('{').count(), schema.matches('}').count());
}

#[test]
fn stress_and_temperature_at_the_start_arrive() {
    let keys = "stress_initial = { xx = \"-2 MPa\", zz = -1e6, per_y = { yy = \"20 kPa/m\", xy = 3 }, point = [0, \"5 mm\"] }\ntemperature_initial = 400\nname = \"plate\"\n";
    let model = sound(&changed("name = \"plate\"\n", keys));
    let part = &model.parts[1];
    let stress =
        InitialStress { value: [-2e6, 0.0, -1e6, 0.0], per_y: [0.0, 2e4, 0.0, 3.0], point: [0.0, 5e-3], ..InitialStress::default() };
    assert_eq!((part.stress_initial.as_ref(), part.temperature_initial), (Some(&stress), Some(400.0)));
    let wrong = super::faults(&changed("name = \"plate\"\n", &keys.replace("\"20 kPa/m\"", "\"20 kPa\"")));
    assert!(
        wrong.iter().any(|fault| fault.path == "part[1].stress_initial.per_y.yy" && fault.message.contains("pressure per length")),
        "{wrong:#?}"
    );
}
