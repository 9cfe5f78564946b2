//! Contacts, obstacles, and what moves: which models their keys make, and what is refused with which words.

use super::{MORE, SOUND, changed, faults, read};
use embate_solver::model::Sine;
use embate_solver::model::{
    Axis, Constraint, Contact, ContactLaw, Curve, CurveShape, Drive, Formulation, Friction, Image, InitialPenetration, Interface, Join,
    Load, Model, Motion, NonReflecting, Obstacle, ObstacleShape, Partners, Penalty, PenaltySource, Rotation,
};
use embate_solver::quantity::Dimension;

fn sound(text: &str) -> Model {
    read(text).unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
}

const BETWEEN: &str = "between = [\"tube\", \"plate\"]\n";

/// [`SOUND`] with further lines in its contact.
fn with(lines: &str) -> String {
    changed(BETWEEN, &format!("{BETWEEN}{lines}\n"))
}

fn contact(lines: &str) -> Contact {
    sound(&with(lines)).contacts[0].clone()
}

/// [`SOUND`] with further sections.
fn and(sections: &str) -> String {
    format!("{SOUND}{sections}\n")
}

fn obstacle(lines: &str) -> Obstacle {
    sound(&and(&format!("[[obstacle]]\n{lines}"))).obstacles.pop().unwrap()
}

/// Path, message and help of every fault.
fn shown(text: &str) -> Vec<String> {
    faults(text).iter().map(|fault| format!("{}: {} | {}", fault.path, fault.message, fault.help)).collect()
}

/// Each text has exactly one fault, which begins and contains so.
fn each_has(cases: &[(String, &str, &str)]) {
    let mut wrong = String::new();
    for (text, path, says) in cases {
        let all = shown(text);
        if all.len() != 1 || !all[0].starts_with(&format!("{path}: ")) || !all[0].contains(says) {
            let tail: Vec<&str> = text.lines().filter(|line| !SOUND.contains(line)).collect();
            wrong.push_str(&format!("{tail:?}\n  expected {path}: ... {says}\n  found {all:#?}\n"));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn all_bodies_or_some_meet_each_other_and_themselves() {
    let contact = |bodies: &str| sound(&changed(BETWEEN, &format!("bodies = {bodies}\n"))).contacts[0].clone();
    let all = contact("\"all\"");
    assert_eq!((all.name.as_str(), all.partners), ("all", Partners::Bodies(vec![])));
    let some = contact("[\"tube\", \"ball\"]");
    assert_eq!((some.name.as_str(), some.partners), ("tube-ball", Partners::Bodies(vec!["tube".into(), "ball".into()])));
    assert_eq!(contact("\"tube\"").partners, Partners::Bodies(vec!["tube".into()]));
}

#[test]
fn two_sides_of_one_body_may_meet() {
    let model = sound(&SOUND.replace("[\"tube\", \"plate\"]", "[\"tube.start\", \"tube.end\"]"));
    assert_eq!(model.contacts[0].partners, Partners::Between(["tube.start".into(), "tube.end".into()]));
}

#[test]
fn formulations_and_laws_are_read() {
    assert_eq!(contact("formulation = \"segment\"").formulation, Formulation::Segment);
    assert_eq!(contact("formulation = \"pinball\"").formulation, Formulation::Pinball);
    let law = |lines: &str| contact(lines).interface.law;
    assert_eq!(law("law = \"multiplier\""), ContactLaw::Multiplier);
    assert_eq!(law("law = \"penalty\"\npenalty = 1e9"), ContactLaw::Penalty(Penalty::PerNode(1e9)));
    let automatic = |source, scale| ContactLaw::Penalty(Penalty::Automatic { source, scale });
    assert_eq!(law("penalty_from = \"time_step\"\npenalty_scale = 0.1"), automatic(PenaltySource::TimeStep, 0.1));
    assert_eq!(law("penalty_from = \"bulk_modulus\""), automatic(PenaltySource::BulkModulus, 1.0));
    let table = ContactLaw::PressureGap { gaps: vec![-0.001, 0.0, 0.002], pressures: vec![3e6, 1e6, 0.0] };
    assert_eq!(law("law = \"pressure_gap\"\ngaps = [\"-1 mm\", 0, 0.002]\npressures = [\"3 MPa\", \"1 MPa\", 0]"), table);
}

#[test]
fn friction_ties_and_times_are_read() {
    let plain = Interface::default();
    assert_eq!(contact("").interface, plain);
    let friction = Friction { coefficient: 0.3, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    assert_eq!(contact("friction = 0.3").interface, Interface { friction: Some(friction), ..plain.clone() });
    let all = Friction { dynamic: Some(0.2), decay: 0.1, viscosity: 1e4, limit: 1e6, ..friction };
    let lines = "friction = 0.3\nfriction_dynamic = 0.2\nfriction_decay = \"0.1 s/m\"\nfriction_viscosity = \"10 kPa s/m\"\n\
        friction_limit = \"1 MPa\"\ndamping = \"20 %\"\ninitial_penetration = \"push_out\"\nthickness = \"1 mm\"\nbirth = \"1 ms\"\ndeath = 1";
    let expected = Interface {
        friction: Some(all),
        damping: 0.2,
        initial_penetration: InitialPenetration::PushOut,
        thickness: 0.001,
        active: [0.001, 1.0],
        ..plain
    };
    assert_eq!(contact(lines).interface, expected);
    assert_eq!(obstacle(&format!("plane.normal = [0, 1]\n{lines}")).interface, expected);
    assert_eq!(contact("initial_penetration = \"ignore\"").interface.initial_penetration, InitialPenetration::Ignore);
    assert_eq!((contact("").tied, contact("tied = false").tied), (None, None));
    assert_eq!((contact("tied = true").tied, contact("tied = true\ntie_strength = \"1 MPa\"").tied), (Some(f64::INFINITY), Some(1e6)));
}

#[test]
fn obstacles_have_three_shapes() {
    let wall = obstacle("name = \"wall\"\nplane = { point = [0, 1], normal = [0, 2] }");
    assert_eq!(wall, Obstacle::wall("wall", [0.0, 1.0, 0.0], [0.0, 2.0, 0.0]));
    let plane = ObstacleShape::Plane { point: [0.0, 0.0, 0.0], normal: [1.0, 0.0, 0.0], length: Some(0.01) };
    assert_eq!(obstacle("plane = { normal = [1, 0], length = \"10 mm\" }").shape, plane);
    let circle = |hollow| ObstacleShape::Circle { centre: [0.0, 1.0, 0.0], radius: 0.5, hollow };
    assert_eq!(obstacle("circle = { centre = [0, 1], radius = \"50 cm\" }").shape, circle(false));
    assert_eq!(obstacle("circle = { centre = [0, 1], radius = 0.5, hollow = true }").shape, circle(true));
    let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
    assert_eq!(obstacle("polyline.points = [[0, 0], [\"1 m\", 0], [1, 1], [0, 0]]").shape, ObstacleShape::Polyline { points });
}

#[test]
fn obstacles_are_fixed_driven_or_free() {
    let circle = "circle = { centre = [0, 1], radius = 0.5 }";
    let moved = obstacle(&format!("{circle}\nmotion = {{ x = \"-5 m/s\", y = \"ramp\" }}\nreference = [0, 2]"));
    let velocity = [Some(Drive::Constant(-5.0)), Some(Drive::Curve("ramp".into())), Some(Drive::Constant(0.0))];
    assert_eq!((moved.motion, moved.reference), (Motion { velocity, ..Motion::fixed() }, Some([0.0, 2.0, 0.0])));
    let free = obstacle(&format!(
        "{circle}\nmotion = {{ x = \"free\", rotation = \"free\" }}\nmass = \"2 kg/m\"\ninertia = \"30 kg m\"\nvelocity = [3, 0]\nspin = \"60 rpm\""
    ));
    assert_eq!(free.motion, Motion { velocity: [None, Some(Drive::Constant(0.0)), Some(Drive::Constant(0.0))], spin: None });
    assert_eq!((free.mass, free.inertia, free.velocity, free.spin), (Some(2.0), Some(30.0), [3.0, 0.0, 0.0], std::f64::consts::TAU));
}

#[test]
fn rigid_parts_are_free_where_nothing_is_said() {
    let rigid = |line: &str| sound(&changed("name = \"ball\"\n", &format!("name = \"ball\"\n{line}\n"))).parts[2].rigid.clone();
    assert_eq!((rigid(""), rigid("rigid = false"), rigid("rigid = true")), (None, None, Some(Motion::default())));
    let held = Motion { velocity: [Some(Drive::Constant(0.0)), None, None], spin: Some(Drive::Constant(30.0)) };
    assert_eq!(rigid("rigid = { x = 0, y = \"free\", rotation = \"30 rad/s\" }"), Some(held));
    let spin = |text: &str| sound(&changed("name = \"ball\"\n", &format!("name = \"ball\"\nspin = {text}\n"))).parts[2].spin;
    assert_eq!((spin("-2"), spin("\"90 deg/s\""), spin("\"30 rpm\"")), (-2.0, std::f64::consts::FRAC_PI_2, std::f64::consts::PI));
}

#[test]
fn curves_drive_constraints_and_keep_their_dimension() {
    let model = sound(&changed("fixed = \"x\"", "fixed = \"x\"\nvelocity.y = \"ramp\""));
    assert_eq!(model.constraints[0].velocity, [Some(Drive::Constant(0.0)), Some(Drive::Curve("ramp".into())), None]);
    let curve = |value: &str| sound(&changed("[0, \"5 m/s\"]", value)).curves["ramp"].clone();
    let ramp = |values, dimension| Curve { dimension, ..Curve::table(vec![0.0, 0.001], values) };
    assert_eq!(curve("[0, \"5 m/s\"]"), ramp(vec![0.0, 5.0], Some(Dimension::VELOCITY)));
    assert_eq!(curve("[1, 2.5]"), ramp(vec![1.0, 2.5], None));
    assert_eq!(curve("[\"90 deg/s\", 0]"), ramp(vec![std::f64::consts::FRAC_PI_2, 0.0], Some(Dimension::RATE)));
}

#[test]
fn curves_have_shapes() {
    let curve = |text: &str| sound(&and(&format!("[curve.c]\n{text}"))).curves["c"].clone();
    let steps = curve("time = [0, \"1 ms\"]\nvalue = [0, \"3 mm\"]\nbetween = \"smooth_steps\"");
    let shape = CurveShape::Table { times: vec![0.0, 0.001], values: vec![0.0, 0.003], smooth: true };
    assert_eq!(steps, Curve { dimension: Some(Dimension::LENGTH), ..Curve::from(shape) });
    let wave = curve("sine = { amplitude = \"2 mm\", frequency = \"1 kHz\", phase = \"90 deg\" }");
    let sine = Sine { amplitude: 0.002, frequency: 1000.0, phase: std::f64::consts::FRAC_PI_2, offset: 0.0 };
    assert_eq!(wave, Curve { dimension: Some(Dimension::LENGTH), ..CurveShape::Sine(sine).into() });
    assert_eq!(curve("expression = \"2*t\""), Curve::from(CurveShape::Expression("2*t".into())));
    each_has(&[
        (and("[curve.c]\nbetween = \"lines\""), "curve.c", "needs one of `value`, `sine` and `expression`"),
        (and("[curve.c]\ntime = [0]"), "curve.c", "needs one of `value`, `sine` and `expression`"),
        (and("[curve.c]\nvalue = [0]"), "curve.c", "has `value` but no `time`"),
        (and("[curve.c]\nexpression = \"t\"\nbetween = \"lines\""), "curve.c", "has `between` and `expression` at once"),
        (and("[curve.c]\nexpression = \"t\"\nsine = { amplitude = 1, frequency = 1 }"), "curve.c", "at once"),
        (and("[curve.c]\nexpression = \"2*sin(3*t\""), "curve.c.expression", "at character 6 of `2*sin(3*t`: this `(` is never closed"),
        (and("[curve.c]\nexpression = \"1/(t - 5e-4)\""), "curve.c.expression", "is inf at 0.0005 s"),
        (
            and("[curve.c]\nsine = { amplitude = \"2 mm\", frequency = 5, offset = \"1 s\" }"),
            "curve.c.sine.offset",
            "`offset` is in s, but `amplitude` is in m",
        ),
    ]);
}

#[test]
fn constraints_move_nodes_in_every_way() {
    let constraint = |text: &str| {
        sound(&and(&format!("[[constraint]]\non = \"plate.right\"\n{text}\n[curve.c]\nexpression = \"t\""))).constraints.pop().unwrap()
    };
    let curve = || Some(Drive::Curve("c".into()));
    let empty = || Constraint { on: "plate.right".into(), name: "plate_right".into(), ..Constraint::default() };
    assert_eq!(constraint("displacement.y = \"c\""), Constraint { displacement: [None, curve(), None], ..empty() });
    let both = Constraint {
        velocity: [None, Some(Drive::Constant(0.0)), None],
        acceleration: [Some(Drive::Constant(3.0)), None, None],
        ..empty()
    };
    assert_eq!(constraint("fixed = \"y\"\nacceleration = { x = \"3 m/s^2\" }"), both);
    let rotation = |centre: [f64; 2], speed| Constraint { rotation: Some(Rotation { about: Axis::through(centre), speed }), ..empty() };
    assert_eq!(constraint("rotation = { speed = \"c\", centre = [1, \"2 mm\"] }"), rotation([1.0, 0.002], Drive::Curve("c".into())));
    assert_eq!(constraint("rotation = { speed = \"60 rpm\" }"), rotation([0.0; 2], Drive::Constant(std::f64::consts::TAU)));
    let on = |text: &str| and(&format!("[[constraint]]\non = \"plate.right\"\n{text}"));
    each_has(&[
        (on("fixed = \"x\"\nacceleration.x = 1"), "constraint[1].fixed", "component `x` is both fixed and given an acceleration"),
        (on("rotation = { speed = 1 }\nfixed = \"x\""), "constraint[1]", "`rotation` and `fixed`"),
        (on("rotation = { centre = [0, 0] }"), "constraint[1].rotation.speed", "has no `speed`"),
        (on("displacement.x = \"3 mm\""), "constraint[1].displacement.x", "would move the nodes at once"),
        (on("displacement.x = \"ramp\""), "constraint[1].displacement.x", "the values of curve `ramp` are in m/s, but `x` is in m"),
        (on("velocity.x = 1\nacceleration.x = 1"), "constraint[1].acceleration.x", "prescribed by both `velocity` and `acceleration`"),
    ]);
}

#[test]
fn a_load_can_damp() {
    let load = |lines: &str| sound(&and(&format!("[[load]]\n{lines}"))).loads.pop().unwrap();
    assert_eq!(load("damping_stiffness = \"2 us\""), Load::StiffnessDamping { parts: vec![], time: 2e-6 });
    assert_eq!(load("damping = 100"), Load::Damping { parts: vec![], rate: 100.0, active: [0.0, f64::INFINITY] });
    let part = load("damping = \"1 1/ms\"\nparts = \"ball\"\nfrom = \"1 ms\"\nuntil = \"2 ms\"");
    assert_eq!(part, Load::Damping { parts: vec!["ball".into()], rate: 1000.0, active: [0.001, 0.002] });
}

#[test]
fn loads_boundaries_and_joins_are_read() {
    let load = |lines: &str| sound(&and(&format!("[[load]]\n{lines}\n[curve.c]\nexpression = \"t\""))).loads.pop().unwrap();
    let curve = || Some("c".to_string());
    let gravity = Load::Gravity { parts: vec!["ball".into()], acceleration: [1.0, 2.0, 0.0], curve: curve() };
    assert_eq!(load("gravity = [1, 2]\nparts = \"ball\"\ncurve = \"c\""), gravity);
    let spin =
        |centre: [f64; 2], curve| Load::Centrifugal { parts: vec![], about: Axis::through(centre), speed: std::f64::consts::TAU, curve };
    assert_eq!(load("centrifugal = \"60 rpm\""), spin([0.0; 2], None));
    assert_eq!(load("centrifugal = \"60 rpm\"\ncentre = [1, 2]\ncurve = \"c\""), spin([1.0, 2.0], curve()));
    let force = Load::Force { on: "plate.top".into(), force: [3.0, -2000.0, 0.0], curve: None };
    assert_eq!(load("force = [3, \"-2 kN/m\"]\non = \"plate.top\""), force);
    assert_eq!(load("pressure = \"2 MPa\"\non = \"ball\""), Load::Pressure { on: "ball".into(), pressure: 2e6, curve: None });
    let model = sound(&and(&format!(
        "{MORE}[[join]]\nbetween = [\"plate.top\", \"plate.bottom\"]\ntranslation = [0, \"-3 mm\"]\ntolerance = \"1 um\""
    )));
    assert_eq!(model.non_reflecting, [NonReflecting { on: "ball.outer".into() }]);
    let image = Image::Turned { about: Axis::through([0.0, 0.1]), angle: std::f64::consts::PI };
    let turned = Join { between: ["tube.start".into(), "tube.end".into()], image, tolerance: None };
    let image = Image::Translated([0.0, -0.003, 0.0]);
    let moved = Join { between: ["plate.top".into(), "plate.bottom".into()], image, tolerance: Some(1e-6) };
    assert_eq!(model.joins, [turned, moved]);
    let of = |section: &str, lines: &str| and(&format!("{MORE}[[{section}]]\n{lines}"));
    each_has(&[
        (of("load", "pressure = 1"), "load[1]", "has `pressure` but no `on`"),
        (of("load", "pressure = 1\non = \"plate.tpo\""), "load[1].on", "part `plate` has no side `tpo` | did you mean `top`?"),
        (of("load", "force = [1, 1]\non = \"plate\""), "load[1].on", "`plate` is a part, but a force acts on a set of its nodes"),
        (of("load", "gravity = [1, 1]\ncurve = \"ramp\""), "load[1].curve", "the values of curve `ramp` are in m/s, but `curve` is"),
        (of("load", "gravity = [1, 1]\ncurve = \"rmap\""), "load[1].curve", "there is no curve `rmap` | did you mean `ramp`?"),
        (of("load", "force = [1, 1]\npressure = 1\non = \"plate.top\""), "load[1]", "has `force` and `pressure` at once"),
        (of("non_reflecting", "on = \"ball.outer\""), "non_reflecting[1].on", "reflects nothing by non_reflecting[0] already"),
        (of("join", "between = [\"tube.start\", \"tube.start\"]"), "join[1].between", "is joined to itself"),
        (
            of("join", "between = [\"tube.start\", \"tube.end\"]\nrotation = 1\ntranslation = [1, 0]"),
            "join[1]",
            "`translation` and `rotation`",
        ),
    ]);
}

#[test]
fn what_is_turned_alone_is_not_held() {
    let strip = "run.end = 1\n[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n\
        [[part]]\nname = \"strip\"\nmaterial = \"steel\"\nelement = \"shell2\"\nsection = { thickness = \"1 mm\" }\n\
        line = { points = [[0, 0], [1, 0]], elements = 4 }\n";
    let turned = sound(&format!("{strip}[[constraint]]\non = \"strip.end\"\nspin = {{ z = \"2 rad/s\" }}\n")).constraints.pop().unwrap();
    assert_eq!((turned.velocity, turned.spin), ([None, None, None], [None, None, Some(Drive::Constant(2.0))]));
    // With a stage, which says when it acts.
    let stages = "[[stage]]\nname = \"turn\"\nduration = \"1 ms\"\n[[stage]]\nduration = \"2 ms\"\nrelaxation = {}\n";
    let text = format!("{}{stages}", strip.replace("run.end = 1", "run.safety = 0.8"));
    let model = sound(&format!("{text}[[constraint]]\non = \"strip.end\"\nspin = {{ z = 1 }}\nstages = \"turn\"\n"));
    let names: Vec<&str> = model.stages.iter().map(|stage| stage.name.as_str()).collect();
    assert_eq!((model.constraints[0].stages.as_slice(), names.as_slice()), (&["turn".to_string()][..], &["turn", "stage"][..]));
    assert!((model.run.end - 3e-3).abs() < 1e-18 && model.stages[1].relaxation.is_some() && model.stages[0].relaxation.is_none());
    each_has(&[
        (
            text.replace("run.safety = 0.8", "run.end = 1"),
            "run.end",
            "the model has stages, and their durations say when it ends | leave `end` out",
        ),
        (strip.replace("run.end = 1", "run.safety = 0.8"), "run.end", "[run] has no `end` | add `end = "),
    ]);
}

#[test]
fn a_message_says_that_a_wall_is_an_obstacle_now() {
    let help = "walls are obstacles now: [[obstacle]] with plane = { point, normal }";
    each_has(&[
        (and("[[wall]]\nnormal = [1, 0]"), "wall", &format!("a model has no key `wall` | {help}")),
        (and("[[obstacle]]\nplane.normal = [0, 1]\nnormal = [1, 0]"), "obstacle[3].normal", "`normal` belongs in `plane = { ... }`"),
    ]);
}

#[test]
fn keys_of_contacts_that_contradict_each_other_are_refused() {
    let table = "law = \"pressure_gap\"\ngaps = [-1, 0]\npressures = [1, 0]";
    each_has(&[
        (changed(BETWEEN, ""), "contact[0]", "[[contact]] needs one of `between` and `bodies`"),
        (with("bodies = \"all\""), "contact[0]", "[[contact]] has `between` and `bodies` at once"),
        (changed(BETWEEN, "bodies = [\"tube\", \"plat\"]\n"), "contact[0].bodies[1]", "did you mean `plate`?"),
        (changed(BETWEEN, "bodies = \"all\"\nslave = \"tube\"\n"), "contact[0].slave", "bodies have none"),
        (changed(BETWEEN, "bodies = \"all\"\nformulation = \"single_pass\"\n"), "contact[0].formulation", "a single pass contact needs"),
        (changed(BETWEEN, "bodies = \"all\"\ntied = true\n"), "contact[0].tied", "a tie joins two surfaces"),
        (with("formulation = \"segment\"\nslave = \"tube\""), "contact[0].slave", "both surfaces are alike"),
        (with("penalty = 1\npenalty_from = \"time_step\""), "contact[0]", "has `penalty` and `penalty_from` at once"),
        (with("law = \"multiplier\"\npenalty = 1"), "contact[0].penalty", "goes only with `law = \"penalty\"`"),
        (with(&format!("{table}\npenalty_scale = 2")), "contact[0].penalty_scale", "goes only with `law = \"penalty\"`"),
        (
            with("gaps = [-1, 0]"),
            "contact[0].gaps",
            "goes only with `law = \"pressure_gap\"` | add `law = \"pressure_gap\"`, or leave `gaps` out",
        ),
        (with("law = \"pressure_gap\"\ngaps = [-1, 0]"), "contact[0]", "has `law = \"pressure_gap\"` but no `pressures`"),
        (with(&table.replace("[1, 0]", "[1, 0, 0]")), "contact[0].pressures", "there are 2 gaps, but 3 pressures"),
        (with(&table.replace("[-1, 0]", "[0, -1]")), "contact[0].gaps[1]", "-1 m does not follow 0 m: the gaps must ascend"),
        (with(&table.replace("[1, 0]", "[1, 2]")), "contact[0].pressures[1]", "the pressure rises with the gap"),
        (with(&table.replace("[1, 0]", "[2, 1]")), "contact[0].pressures[1]", "over any distance"),
        (with(&table.replace("[1, 0]", "[0, 0]")), "contact[0].pressures", "all pressures are zero"),
        (with(&table.replace("[1, 0]", "[1]")), "contact[0].pressures", "must be a list of at least 2 numbers"),
        (with("law = \"multiplier\"\ndamping = 0.1"), "contact[0].damping", "a multiplier contact has no spring"),
        (with("friction = -0.1"), "contact[0].friction", "it would drive it, and the contact would make energy"),
        (with("friction_limit = 1"), "contact[0]", "has `friction_limit` but no `friction`"),
        (with("friction_viscosity = 1"), "contact[0]", "has `friction_viscosity` but no `friction`"),
        (with("friction = 0.2\nfriction_dynamic = 0.1"), "contact[0]", "has `friction_dynamic` but no `friction_decay`"),
        (with("friction = 0.2\nfriction_decay = 0.1"), "contact[0]", "has `friction_decay` but no `friction_dynamic`"),
        (
            with("friction = 0.2\nfriction_dynamic = 0.3\nfriction_decay = 1"),
            "contact[0].friction_dynamic",
            "dynamic friction 0.3 is more than the static one, 0.2",
        ),
        (with("birth = \"2 ms\"\ndeath = \"1 ms\""), "contact[0].death", "it ends at 0.001 s, not after its beginning at 0.002 s"),
        (with("tie_strength = 1"), "contact[0].tie_strength", "goes only with `tied = true`"),
        (with("formulation = \"segment\"\npenalty = \"1 N/m/m\""), "contact[0].penalty", "no slave nodes"),
        (with("tied = true\nformulation = \"segment\"\nlaw = \"multiplier\""), "contact[0].law", "more springs than their nodes can meet"),
        (with("tied = true\nformulation = \"pinball\""), "contact[0].formulation", "pinballs only push"),
        (with(&format!("tied = true\n{table}")), "contact[0].law", "a pressure can't hold"),
    ]);
}

#[test]
fn surfaces_that_two_contacts_join_at_once_are_refused() {
    let bodies = |first: &str, second: &str| {
        let text = changed(BETWEEN, &format!("bodies = {first}\n"));
        format!("{text}[[contact]]\nname = \"more\"\nbodies = {second}\n")
    };
    each_has(&[
        (and("[[contact]]\nbetween = [\"plate\", \"tube\"]"), "contact[1].between", "`plate` and `tube` are already joined by contact[0]"),
        (bodies("\"all\"", "\"all\""), "contact[1].bodies", "contact[0] already joins the same bodies"),
        (bodies("\"all\"", "\"ball\""), "contact[1].bodies", "contact[0] already joins the same bodies"),
        (bodies("\"ball\"", "\"all\""), "contact[1].bodies", "contact[0] already joins the same bodies"),
        (
            bodies("[\"tube\", \"ball\"]", "[\"plate\", \"ball\"]"),
            "contact[1].bodies",
            "part `ball` already meets itself and others in contact[0]",
        ),
        (and("[[contact]]\nbodies = \"all\""), "contact[0].between", "`tube` and `plate` already meet as bodies of contact[1]"),
        (with("[[contact]]\nbodies = [\"plate\", \"tube\"]"), "contact[0].between", "already meet as bodies of contact[1]"),
        (
            SOUND.replace("[\"tube\", \"plate\"]", "[\"tube\", \"tube\"]"),
            "contact[0].between",
            "for the contact of a body with itself use `bodies = [\"tube\"]`",
        ),
    ]);
    for text in [
        bodies("\"tube\"", "[\"plate\", \"ball\"]"),
        and("[[contact]]\nbodies = [\"tube\", \"ball\"]"),
        with("death = \"1 ms\"\n[[contact]]\nname = \"later\"\nbetween = [\"plate\", \"tube\"]\nbirth = \"1 ms\""),
        with("tied = true\n[[contact]]\nbodies = \"all\""),
    ] {
        sound(&text);
    }
}

#[test]
fn obstacles_and_moving_parts_that_make_no_sense_are_refused() {
    let circle = |lines: &str| and(&format!("[[obstacle]]\ncircle = {{ centre = [0, 1], radius = 0.5 }}\n{lines}"));
    let polyline = |points: &str| and(&format!("[[obstacle]]\npolyline.points = {points}"));
    let ball = |lines: &str| changed("name = \"ball\"\n", &format!("name = \"ball\"\n{lines}\n"));
    let held = "rigid = { x = 0, y = 0, rotation = 0 }\n";
    let both = SOUND.replace("name = \"tube\"\nm", &format!("name = \"tube\"\n{held}m"));
    let both = both.replace("name = \"ball\"\nm", &format!("name = \"ball\"\n{held}m"));
    each_has(&[
        (
            and("[[obstacle]]\nparts = \"ball\""),
            "obstacle[3]",
            "needs one of `plane`, `circle`, `polyline`, `sphere`, `cylinder` and `stl`",
        ),
        (circle("plane.normal = [0, 1]"), "obstacle[3]", "has `plane` and `circle` at once"),
        (circle("motion = { x = \"free\" }"), "obstacle[3].mass", "the obstacle is free to move, so it needs `mass`"),
        (circle("motion = { rotation = \"free\" }"), "obstacle[3].inertia", "the obstacle is free to turn, so it needs `inertia`"),
        (circle("mass = 1"), "obstacle[3].mass", "`mass` has no effect, because the obstacle is not free to move"),
        (circle("inertia = 1"), "obstacle[3].inertia", "`inertia` has no effect"),
        (circle("velocity = [1, 0]"), "obstacle[3].velocity[0]", "`x` is not free, so it can't begin with 1"),
        (circle("spin = 1"), "obstacle[3].spin", "`rotation` is not free"),
        (circle("motion = { y = \"2 mm\" }\nmass = 1"), "obstacle[3].motion.y", "`y` needs a unit of velocity"),
        (circle("motion = { rotation = \"30 Hz\" }"), "obstacle[3].motion.rotation", "radians or revolutions per second"),
        (
            circle("motion = { rotation = \"ramp\" }"),
            "obstacle[3].motion.rotation",
            "the values of curve `ramp` are in m/s, but `rotation` is in rad/s",
        ),
        (polyline("[[0, 0], [0, 0], [1, 0]]"), "obstacle[3].polyline.points[1]", "point 1 is the same as the one before it"),
        (polyline("[[0, 0], [1, 0], [0, 0]]"), "obstacle[3].polyline.points", "goes back on its own line"),
        (
            changed("fixed = \"x\"", "velocity.x = \"rampe\""),
            "constraint[0].velocity.x",
            "there is no curve `rampe` | did you mean `ramp`?",
        ),
        (changed("fixed = \"x\"", "velocity.x = \"free\""), "constraint[0].velocity.x", "can't be \"free\" here"),
        (ball("rigid = { x = 0 }\nvelocity = [1, 0]"), "part[2].velocity[0]", "`x` is not free"),
        (ball("rigid = { z = 1 }"), "part[2].rigid.z", "there is no `z` in 2D"),
        (ball("rigid = { w = 0 }"), "part[2].rigid.w", "give `x`, `y`, `z`, `rotation`, or some of them"),
        (ball("rigid = true\n").replace("\"plate.left\"", "\"ball.outer\""), "constraint[0].on", "part `ball` is rigid"),
        (both.replace("[\"tube\", \"plate\"]", "[\"tube.outer\", \"ball\"]"), "contact[0].between", "nothing can deform"),
        (both.replace(BETWEEN, "bodies = [\"tube\", \"ball\"]\n"), "contact[0].bodies", "nothing can deform"),
        (both.replace("parts = [\"plate\"]", "parts = [\"ball\"]"), "obstacle[0].parts", "nothing can deform"),
        (changed("[0, \"1 ms\"]", "[0, 0]"), "curve.ramp.time[1]", "0 s does not follow 0 s: the times must ascend"),
        (changed("[0, \"5 m/s\"]", "[0]"), "curve.ramp.value", "there are 2 times, but 1 values"),
        (and("[curve.free]\ntime = [0]\nvalue = [0]"), "curve.free", "a curve can't be called `free`"),
        (and("[curve.2b]\ntime = [0]\nvalue = [0]"), "curve.2b", "must begin with a letter"),
        (and("[[load]]\ngravity = [0, -9]\nfrom = 1"), "load[1]", "has `from` but no `damping`"),
        (and("[[load]]\ndamping = 1\nfrom = 2\nuntil = 1"), "load[1].until", "it ends at 1 s, not after its beginning at 2 s"),
        (
            and("[[load]]\nparts = \"ball\""),
            "load[1]",
            "needs one of `gravity`, `centrifugal`, `force`, `moment`, `pressure`, `damping` and `damping_stiffness`",
        ),
    ]);
}

#[test]
fn bodies_of_revolution_have_masses_and_forces_of_the_whole() {
    let around = and(
        "[[obstacle]]\nname = \"die\"\nplane = { normal = [0, 1] }\nmotion = { y = \"free\" }\nmass = \"30 g\"\n\n[[load]]\nforce = [0, \"2 kN\"]\non = \"tube.outer\"",
    );
    let plane = faults(&around);
    assert!(plane.iter().any(|fault| fault.path.starts_with("obstacle") && fault.path.ends_with("mass")), "{plane:?}");
    assert!(plane.iter().any(|fault| fault.path == "load[1].force[1]"), "{plane:?}");
    let around = around.replace("[[part]]\n", "[[part]]\nstress_state = \"axisymmetric\"\n");
    let model = read(&around).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    assert_eq!(model.obstacles.last().and_then(|die| die.mass), Some(0.03));
    assert!(matches!(model.loads[1], Load::Force { force: [0.0, 2000.0, 0.0], .. }), "{:?}", model.loads);
}
