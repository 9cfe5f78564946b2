//! Models made by code, each with one fault.

use super::*;
use crate::model::Sine;
use crate::model::{
    Axis, Constraint, Contact, ContactLaw, Curve, CurveShape, Drive, Formulation, Friction, Image, ImportedMesh, Join, Load, Material,
    MeshGroup, Motion, NonReflecting, Obstacle, ObstacleShape, Partners, Penalty, Ring, Rotation, Symmetry,
};
use std::sync::Arc;

/// A sound model made by code: a ring, a block of a mesh, everything that acts on them.
fn sound() -> Model {
    let parameters = [("density", 7800.0), ("young", 2e11), ("poisson", 0.3)].map(|(key, value)| (key.to_string(), value));
    let part = |name: &str, shape| Part { name: name.into(), material: "steel".into(), shape, ..Part::default() };
    let group = |name: &str, dimension, cells| MeshGroup { name: name.into(), dimension, cells };
    let mesh = ImportedMesh {
        source: "block.msh".into(),
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        groups: vec![group("body", 2, vec![vec![0, 1, 2, 3]]), group("upper", 1, vec![vec![2, 3]])],
        ..ImportedMesh::default()
    };
    let ring = Shape::Ring(Ring {
        centre: [0.0; 2],
        inner: 1.0,
        outer: 2.0,
        from: 0.0,
        to: std::f64::consts::PI,
        elements: [1, 8],
        ..Ring::default()
    });
    let mut model = Model { name: "test".into(), meshes: vec![Arc::new(mesh)], ..Model::default() };
    model.run.end = 1.0;
    model
        .materials
        .insert("steel".into(), Material { law: "elastic".into(), parameters: parameters.into_iter().collect(), ..Material::default() });
    model.parts = vec![part("ring", ring), part("block", Shape::Group { mesh: 0, group: "body".into() })];
    model.contacts = vec![Contact::between("hit", "ring.outer", "upper")];
    model.obstacles = vec![Obstacle::wall("wall", [0.0; 3], [1.0, 0.0, 0.0])];
    let times = vec![0.0, 1.0];
    model.curves.insert("ramp".into(), Curve::table(times.clone(), times));
    model.symmetries = vec![Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() }];
    model.constraints = vec![Constraint { on: "upper".into(), velocity: [Some(0.0.into()), None, None], ..Constraint::default() }];
    model.loads = vec![Load::Gravity { parts: vec![], acceleration: [0.0, -9.81, 0.0], curve: None }];
    model.probes = vec![Probe { name: "A".into(), at: ProbeAt::Point { part: "ring".into(), point: [0.0; 3] }, ..Probe::default() }];
    model
}

/// Times and values of the sound model's curve.
fn points(model: &mut Model) -> [&mut Vec<f64>; 2] {
    match &mut model.curves.get_mut("ramp").expect("ramp").shape {
        CurveShape::Table { times, values, .. } => [times, values],
        _ => unreachable!("it has points"),
    }
}

/// Friction of the sound model's contact.
fn friction(model: &mut Model) -> &mut Friction {
    model.contacts[0].interface.friction.get_or_insert(Friction {
        coefficient: 0.3,
        dynamic: None,
        decay: 0.0,
        viscosity: 0.0,
        limit: f64::INFINITY,
    })
}

/// The paths of the faults of a sound model after a change.
fn paths(change: impl FnOnce(&mut Model)) -> Vec<String> {
    let mut model = sound();
    change(&mut model);
    model.check().into_iter().map(|fault| fault.path).collect()
}

#[test]
fn a_sound_model_has_no_fault() {
    assert_eq!(sound().check(), []);
}

#[test]
fn a_number_that_is_not_finite_is_found_wherever_it_is() {
    type Place = fn(&mut Model) -> &mut f64;
    fn ring(model: &mut Model, which: usize) -> &mut f64 {
        let Shape::Ring(Ring { centre, inner, outer, from, to, .. }) = &mut model.parts[0].shape else {
            unreachable!("part 0 is the ring")
        };
        [&mut centre[1], inner, outer, from, to].into_iter().nth(which).expect("five numbers")
    }
    let places: [(&str, Place); 34] = [
        ("run.end", |m| &mut m.run.end),
        ("run.safety", |m| &mut m.run.safety),
        ("run.energy_limit", |m| &mut m.run.energy_limit),
        ("run.step_limit", |m| m.run.step_limit.insert(0.0)),
        ("run.velocity_limit", |m| m.run.velocity_limit.insert(0.0)),
        ("run.penetration_limit", |m| m.run.penetration_limit.insert(0.0)),
        ("run.memory_limit", |m| m.run.memory_limit.insert(0.0)),
        ("run.time_step", |m| m.run.time_step.insert(0.0)),
        ("material.steel.young", |m| m.materials.get_mut("steel").and_then(|it| it.parameters.get_mut("young")).expect("young")),
        ("part[0].velocity[1]", |m| &mut m.parts[0].velocity[1]),
        ("part[0].ring.centre[1]", |m| ring(m, 0)),
        ("part[0].ring.inner", |m| ring(m, 1)),
        ("part[0].ring.outer", |m| ring(m, 2)),
        ("part[0].ring.from", |m| ring(m, 3)),
        ("part[0].ring.to", |m| ring(m, 4)),
        ("symmetry[0].point[1]", |m| &mut m.symmetries[0].point[1]),
        ("symmetry[0].normal[1]", |m| &mut m.symmetries[0].normal[1]),
        ("constraint[0].velocity.x", |m| match m.constraints[0].velocity[0].get_or_insert(0.0.into()) {
            Drive::Constant(velocity) => velocity,
            Drive::Curve(_) => unreachable!("it is constant"),
        }),
        ("load[0].gravity[0]", |m| match &mut m.loads[0] {
            Load::Gravity { acceleration, .. } => &mut acceleration[0],
            _ => unreachable!("it is gravity"),
        }),
        ("part[0].spin", |m| &mut m.parts[0].spin),
        ("contact[0].damping", |m| &mut m.contacts[0].interface.damping),
        ("contact[0].thickness", |m| &mut m.contacts[0].interface.thickness),
        ("contact[0].birth", |m| &mut m.contacts[0].interface.active[0]),
        ("contact[0].friction", |m| &mut friction(m).coefficient),
        ("contact[0].friction_dynamic", |m| friction(m).dynamic.insert(0.1)),
        ("contact[0].friction_decay", |m| &mut friction(m).decay),
        ("contact[0].friction_viscosity", |m| &mut friction(m).viscosity),
        ("obstacle[0].plane.normal[0]", |m| match &mut m.obstacles[0].shape {
            ObstacleShape::Plane { normal, .. } => &mut normal[0],
            _ => unreachable!("it is a plane"),
        }),
        ("obstacle[0].reference[1]", |m| &mut m.obstacles[0].reference.insert([0.0; 3])[1]),
        ("obstacle[0].mass", |m| {
            m.obstacles[0].motion = Motion::default();
            m.obstacles[0].mass.insert(1.0)
        }),
        ("obstacle[0].velocity[0]", |m| &mut m.obstacles[0].velocity[0]),
        ("curve.ramp.time[1]", |m| &mut points(m)[0][1]),
        ("curve.ramp.value[0]", |m| &mut points(m)[1][0]),
        ("probe[0].point[0]", |m| match &mut m.probes[0].at {
            ProbeAt::Point { point, .. } => &mut point[0],
            _ => unreachable!("the probe is at a point"),
        }),
    ];
    for (path, place) in places {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let found = paths(|model| *place(model) = value);
            assert!(found.iter().any(|it| it == path), "{path} = {value}: {found:?}");
        }
    }
    for value in [f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(paths(|model| model.contacts[0].tied = Some(value)), ["contact[0].tie_strength"]);
        assert_eq!(paths(|model| friction(model).limit = value), ["contact[0].friction_limit"]);
        assert_eq!(paths(|model| model.contacts[0].interface.active[1] = value), ["contact[0].death"]);
    }
    for penalty in [Penalty::PerNode(f64::NAN), Penalty::Pressure(-1.0)] {
        assert_eq!(paths(|model| model.contacts[0].interface = penalty.into()), ["contact[0].penalty"]);
    }
    assert_eq!(paths(|model| model.obstacles[0].interface = Penalty::automatic(0.0).into()), ["obstacle[0].penalty_scale"]);
    assert_eq!(paths(|model| model.output.history = Cadence::Interval(f64::NAN)), ["output.history"]);
}

#[test]
fn names_mean_parts_before_groups_before_sides() {
    let mut model = sound();
    assert_eq!(model.reference("ring", Wanted::Nodes), Ok(Reference::Part(0)));
    assert_eq!(model.reference("ring.start", Wanted::Surface), Ok(Reference::Side { part: 0, side: 2 }));
    assert_eq!(model.reference("upper", Wanted::Surface), Ok(Reference::Group { part: 1, mesh: 0, group: 1 }));
    assert_eq!(model.reference("block.upper", Wanted::Surface), Ok(Reference::Group { part: 1, mesh: 0, group: 1 }));
    model.parts[1].name = "upper".into();
    assert_eq!(model.reference("upper", Wanted::Surface), Ok(Reference::Part(1)));
    assert!(model.reference("body", Wanted::Surface).is_err() && model.reference("block.top", Wanted::Nodes).is_err());
    let copy = model.meshes[0].clone();
    model.meshes.push(copy);
    assert!(model.reference("body", Wanted::Nodes).is_ok(), "no part has the other mesh");
    model.parts.push(Part { name: "other".into(), shape: Shape::Group { mesh: 1, group: "body".into() }, ..Part::default() });
    let said = model.reference("body", Wanted::Nodes).unwrap_err();
    assert_eq!(said.0, "group `body` is in 2 places, with the parts `upper` and `other`");
    assert_eq!(said.1, "name the part too: `upper.body` or `other.body`");
    assert_eq!(model.reference("other.body", Wanted::Nodes), Ok(Reference::Group { part: 2, mesh: 1, group: 0 }));
}

#[test]
fn faults_that_only_code_can_make_are_found() {
    assert_eq!(paths(|model| model.run.max_steps = Some(0)), ["run.max_steps"]);
    assert_eq!(paths(|model| model.run.checkpoint_steps = Some(0)), ["run.checkpoint_steps"]);
    assert_eq!(paths(|model| model.output.history = Cadence::Count(0)), ["output.history"]);
    assert!(paths(|model| model.output.fields = Cadence::Count(0)).is_empty());
    assert_eq!(paths(|model| model.contacts[0].formulation = Formulation::SinglePass { slave: 2 }), ["contact[0].slave"]);
    assert_eq!(paths(|model| model.constraints[0].velocity = [None, None, None]), ["constraint[0]"]);
    assert_eq!(paths(|model| model.parts[1].shape = Shape::Group { mesh: 3, group: "body".into() }), ["part[1].mesh"]);
    let mesh = |change: fn(&mut ImportedMesh)| paths(|model| change(Arc::make_mut(&mut model.meshes[0])));
    assert_eq!(mesh(|mesh| mesh.groups[0].cells[0] = vec![0, 1, 2, 9]), ["part[1].mesh.group"]);
    assert_eq!(mesh(|mesh| mesh.groups[0].cells[0] = vec![0, 1]), ["part[1].mesh.group"]);
    assert_eq!(mesh(|mesh| mesh.groups[0].cells.clear()), ["part[1].mesh.group"]);
    assert_eq!(mesh(|mesh| mesh.positions[0][0] = f64::NAN), ["part[1].mesh.group"]);
    assert_eq!(Model::default().check().len(), 2);
    let obstacle = |change: fn(&mut Obstacle)| paths(|model| change(&mut model.obstacles[0]));
    assert_eq!(obstacle(|it| it.shape = ObstacleShape::Polyline { points: vec![[0.0; 2]] }), ["obstacle[0].polyline.points"]);
    assert_eq!(obstacle(|it| it.motion = Motion::default()), ["obstacle[0].mass", "obstacle[0].inertia"]);
    assert_eq!(obstacle(|it| it.motion.spin = Some(Drive::Curve("none".into()))), ["obstacle[0].motion.rotation"]);
    assert_eq!(obstacle(|it| it.motion.spin = Some(Drive::Curve("ramp".into()))), Vec::<String>::new());
    let contact = |change: fn(&mut Contact)| paths(|model| change(&mut model.contacts[0]));
    let table = |it: &mut Contact| it.interface.law = ContactLaw::PressureGap { gaps: vec![0.0], pressures: vec![0.0, -1.0] };
    assert_eq!(contact(table), ["contact[0].pressures[1]", "contact[0].gaps", "contact[0].pressures"]);
    assert_eq!(contact(|it| it.partners = Partners::Bodies(vec!["ring".into(), "ring".into()])), ["contact[0].bodies[1]"]);
    assert_eq!(contact(|it| it.tied = Some(0.0)), ["contact[0].tie_strength"]);
    assert_eq!(paths(|model| friction(model).decay = 1.0), ["contact[0].friction_decay"]);
    assert_eq!(paths(|model| friction(model).dynamic = Some(0.1)), ["contact[0].friction_dynamic"]);
    let empty = |model: &mut Model| drop(model.curves.insert("empty".into(), Curve::default()));
    assert_eq!(paths(empty), ["curve.empty.time"]);
    let shaped = |shape: CurveShape| paths(|model| drop(model.curves.insert("c".into(), Curve::from(shape))));
    let sine = Sine { amplitude: 1.0, frequency: 2.0, phase: 0.0, offset: 0.0 };
    assert_eq!(shaped(CurveShape::Sine(sine)), Vec::<String>::new());
    assert_eq!(
        shaped(CurveShape::Sine(Sine { frequency: 0.0, offset: f64::NAN, ..sine })),
        ["curve.c.sine.frequency", "curve.c.sine.offset"]
    );
    for (text, sound) in [("sqrt(t)", true), ("1/(1 - t)", false), ("ln(t)", false), ("t +", false), ("exp(1e4*t)", false)] {
        let expected: &[&str] = if sound { &[] } else { &["curve.c.expression"] };
        assert_eq!(shaped(CurveShape::Expression(text.into())), expected, "{text}");
    }
}

#[test]
fn loads_and_joins_that_make_no_sense_are_found() {
    let load = |load: Load| paths(|model| model.loads = vec![load]);
    let curve = |name: &str| Some(name.to_string());
    assert_eq!(load(Load::Force { on: "upper".into(), force: [1.0, f64::NAN, 0.0], curve: curve("ramp") }), ["load[0].force[1]"]);
    assert_eq!(load(Load::Force { on: "ring".into(), force: [1.0, 0.0, 0.0], curve: None }), ["load[0].on"]);
    assert_eq!(load(Load::Pressure { on: "body".into(), pressure: 1.0, curve: curve("rmap") }), ["load[0].on", "load[0].curve"]);
    let spin = Load::Centrifugal { parts: vec![], about: Axis::through([f64::INFINITY, 0.0]), speed: f64::NAN, curve: None };
    assert_eq!(load(spin), ["load[0].centre[0]", "load[0].centrifugal"]);
    let quiet = |names: &[&str]| paths(|model| model.non_reflecting = names.iter().map(|on| NonReflecting { on: (*on).into() }).collect());
    assert_eq!(quiet(&["ring.outer", "upper"]), Vec::<String>::new());
    assert_eq!(quiet(&["upper", "body", "upper"]), ["non_reflecting[1].on", "non_reflecting[2].on"]);
    let join = |between: [&str; 2], image: Image, tolerance: Option<f64>| {
        paths(|model| model.joins = vec![Join { between: between.map(Into::into), image, tolerance }])
    };
    assert_eq!(join(["ring.start", "upper"], Image::Same, None), Vec::<String>::new());
    assert_eq!(
        join(["ring.start", "ring.start"], Image::Translated([0.0; 3]), Some(0.0)),
        ["join[0].translation", "join[0].tolerance", "join[0].between"]
    );
    let turned = Image::Turned { about: Axis::default(), angle: f64::NAN };
    assert_eq!(join(["ring.start", "ring.ned"], turned, None), ["join[0].between[1]", "join[0].rotation"]);
}

#[test]
fn a_component_is_prescribed_in_one_way_and_a_displacement_begins_with_zero() {
    let constraint = |change: fn(&mut Constraint)| paths(|model| change(&mut model.constraints[0]));
    let ramp = || Some(Drive::Curve("ramp".into()));
    assert_eq!(constraint(|it| it.acceleration[1] = Some(3.0.into())), Vec::<String>::new());
    assert_eq!(constraint(|it| it.acceleration[0] = Some(3.0.into())), ["constraint[0].acceleration.x"]);
    assert_eq!(constraint(|it| it.displacement[1] = Some(3.0.into())), ["constraint[0].displacement.y"]);
    assert_eq!(constraint(|it| it.displacement[1] = Some(f64::NAN.into())), ["constraint[0].displacement.y"]);
    let begin = |value: f64| {
        paths(|model| {
            points(model)[1][0] = value;
            model.constraints[0].displacement[1] = ramp();
        })
    };
    assert_eq!(begin(0.0), Vec::<String>::new());
    assert_eq!(begin(0.1), ["constraint[0].displacement.y"]);
    let turn = |speed: Drive| Some(Rotation { about: Axis::default(), speed });
    let rotation = |speed: f64, beside: bool| {
        paths(|model| {
            model.constraints[0].rotation = turn(speed.into());
            model.constraints[0].velocity[0].take_if(|_| !beside);
        })
    };
    assert_eq!(rotation(3.0, false), Vec::<String>::new());
    assert_eq!(rotation(3.0, true), ["constraint[0].rotation"]);
    assert_eq!(rotation(f64::INFINITY, false), ["constraint[0].rotation.speed"]);
}
