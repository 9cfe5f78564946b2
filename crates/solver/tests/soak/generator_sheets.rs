//! Random models of shells and beams in 3D: sheets, tubes, spheres, cones, folded and branched sheets and
//! frames of any section and law, beside solids, in contact with each other; held, pressed and twisted at
//! their edges. The same seed gives the same model.

use crate::generator::{Dice, contact_of_all, elements_of, interface, material_of};
use crate::generator_space::{self, Vector};
use embate_solver::element::ELEMENTS_OF_SPACE;
use embate_solver::model::{
    CircularArc, Constraint, Contact, Disk, Drive, Extrude, Formulation, GAUSS, ImportedMesh, Join, LOBATTO, Line, Load, MeshGroup, Model,
    Motion, Obstacle, ObstacleShape, PROFILES, Part, Placement, Polygon, Profile, Rectangle, Revolve, Run, Shape, ShellSection, SpaceTruss,
    Sphere, Sweep,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Side of the cell that a body gets, m.
const CELL: f64 = 0.01;
/// About the speed of sound of all laws before their stresses are made smaller, m/s.
const SPEED_OF_SOUND: f64 = 5000.0;

/// Model number `seed`.
pub(crate) fn model(seed: u64) -> Model {
    let dice = &mut Dice::new(seed ^ 0x5ee7_1e55);
    let softness = dice.order(1e-4, 1.0);
    let speed = dice.order(1e-3, 0.06) * SPEED_OF_SOUND * softness.sqrt();
    let cells = [dice.whole(1, 2), dice.whole(1, 2), dice.whole(1, 2)];
    let middle = cells.map(|n| 0.5 * CELL * n as f64);
    let mut model = Model { name: format!("soak of shells in 3D {seed}"), ..Model::default() };
    model.output.pictures = false;
    for cell in 0..cells.iter().product() {
        let place = [cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]];
        let centre = place.map(|n| CELL * (n as f64 + 0.5));
        let towards = [0, 1, 2].map(|d| (middle[d] - centre[d]) / CELL + dice.number(-0.3, 0.3));
        let own = softness * if dice.chance(0.2) { dice.order(0.01, 1.0) } else { 1.0 };
        let start = Part { velocity: towards.map(|x| x * speed), ..Part::default() };
        match dice.whole(0, 9) {
            0 | 1 if cell > 0 => solid(dice, &mut model, centre, start, own),
            2 => frame(dice, &mut model, centre, start, own),
            3 | 4 => branches(dice, &mut model, centre, start, own),
            _ => sheet(dice, &mut model, centre, start, own),
        }
    }
    for part in &mut model.parts {
        part.spin = if dice.chance(0.3) && part.rigid.is_none() { dice.number(-1.0, 1.0) * speed / CELL } else { 0.0 };
    }
    contacts(dice, &mut model);
    acting(dice, &mut model, softness, speed);
    if dice.chance(0.25) {
        let shape = ObstacleShape::Plane { point: [0.0, 0.0, -0.1 * CELL], normal: [0.0, 0.0, 1.0], length: None };
        model.obstacles.push(Obstacle { interface: interface(dice), ..Obstacle::fixed("floor", shape) });
    }
    model.run = Run { end: 3.0 * CELL / speed, max_steps: Some(dice.whole(50, 600) as u64), ..Run::default() };
    model
}

/// A part with a material of its own.
fn add(dice: &mut Dice, model: &mut Model, part: Part, softness: f64) {
    let name = format!("body{}", model.parts.len());
    model.materials.insert(name.clone(), material_of(dice, softness));
    model.parts.push(Part { material: name.clone(), name, ..part });
}

/// Turned anyhow, and then moved to a point.
fn anywhere(dice: &mut Dice, to: Vector) -> Placement {
    let rotation_axis = [0; 3].map(|_| dice.number(0.05, 1.0));
    Placement { rotation: dice.number(0.0, TAU), rotation_axis, translation: to, ..Placement::default() }
}

fn section(dice: &mut Dice, size: f64) -> ShellSection {
    let rule = if dice.chance(0.3) { LOBATTO } else { GAUSS };
    let points = if rule == GAUSS && dice.chance(0.1) { 1 } else { dice.whole(3, 7) };
    let mut section = ShellSection {
        thickness: size * dice.order(0.01, 0.2),
        points,
        rule: rule.into(),
        failed_points: dice.number(0.1, 1.0),
        ..ShellSection::default()
    };
    if dice.chance(0.3) {
        section.fold_angle = dice.number(0.05, 1.5);
    }
    section
}

/// A solid, as in models of solids alone.
fn solid(dice: &mut Dice, model: &mut Model, centre: Vector, start: Part, softness: f64) {
    let (shape, sweep) = generator_space::shape(dice, centre);
    let element = dice.choice(&elements_of(ELEMENTS_OF_SPACE, 8));
    let placement = Placement { rotation_point: centre, ..anywhere(dice, [0.0; 3]) };
    add(dice, model, Part { element, shape, sweep, placement, ..start }, softness);
}

/// A sheet of any built-in shape.
fn sheet(dice: &mut Dice, model: &mut Model, centre: Vector, start: Part, softness: f64) {
    let half = 0.25 * CELL * dice.number(0.6, 1.5);
    let (n, m) = (dice.whole(1, 8), dice.whole(1, 8));
    let extrude = Some(Sweep::Extrude(Extrude { from: -half, length: 2.0 * half, elements: m, ..Extrude::default() }));
    let (shape, sweep): (Shape, Option<Sweep>) = match dice.whole(0, 6) {
        0 | 1 => (Rectangle { corner: [-half; 2], size: [2.0 * half; 2], elements: [n, m], ..Rectangle::default() }.into(), None),
        2 => {
            let count = dice.whole(3, 6);
            let corner = |k: usize| [half * (TAU * k as f64 / count as f64).cos(), half * (TAU * k as f64 / count as f64).sin()];
            let outline = (0..count).map(corner).collect();
            (Polygon { outline, size: half * dice.number(0.3, 1.0), ..Polygon::default() }.into(), None)
        }
        3 => (Disk { centre: [0.0; 2], radius: half, elements: dice.whole(1, 3) }.into(), None),
        4 => {
            // Folded, and perhaps a profile that is closed.
            let points = vec![[-half, 0.0], [0.0, half * dice.number(-1.0, 1.0)], [half, 0.0], [0.0, -1.5 * half]];
            (Line { points, radius: 0.0, closed: dice.chance(0.5), elements: n.max(4) }.into(), extrude)
        }
        5 => {
            let to = if dice.chance(0.6) { TAU } else { dice.number(0.5, 6.0) };
            let arc = CircularArc { centre: [0.0; 2], radius: half, to, elements: n.max(4) + 2, ..CircularArc::default() };
            if dice.chance(0.7) {
                (arc.into(), extrude)
            } else {
                // A dome, or a whole sphere with two poles.
                let (from, to) = (-0.5 * PI, if dice.chance(0.5) { 0.5 * PI } else { dice.number(-1.0, 1.2) });
                let arc = CircularArc { from, to, elements: n.max(3), ..arc };
                (arc.into(), Some(Sweep::Revolve(Revolve { elements: dice.whole(5, 10), ..Revolve::default() })))
            }
        }
        _ => {
            let portion = dice.choice(&["whole", "half", "quarter", "eighth"]).into();
            (Sphere { centre: [0.0; 3], radius: half, elements: 2 * dice.whole(1, 2), portion }.into(), None)
        }
    };
    let part = Part {
        element: "shell4".into(),
        hourglass: dice.chance(0.1).then(|| dice.number(0.0, 2.0)),
        section: Some(section(dice, half)),
        placement: anywhere(dice, centre),
        rigid: dice.chance(0.08).then(Motion::default),
        shape,
        sweep,
        ..start
    };
    add(dice, model, part, softness);
}

/// A frame of beams from point to point.
fn frame(dice: &mut Dice, model: &mut Model, centre: Vector, start: Part, softness: f64) {
    let half = 0.3 * CELL;
    let points: Vec<Vector> = (0..dice.whole(2, 5)).map(|_| [0, 1, 2].map(|d| centre[d] + half * dice.number(-1.0, 1.0))).collect();
    let mut lines = vec![points.clone()];
    if points.len() > 2 && dice.chance(0.5) {
        lines.push(vec![points[0], points[2]]);
    }
    let (shape, keys) = dice.choice(PROFILES);
    let size = half * dice.order(0.02, 0.15);
    let mut profile = Profile { shape: shape.into(), ..Profile::default() };
    for key in keys {
        match *key {
            "diameter" => profile.diameter = Some(size),
            "width" => profile.width = Some(size * dice.number(0.3, 1.0)),
            "height" => profile.height = Some(size),
            "thickness" => profile.thickness = Some(0.1 * size),
            "web" => profile.web = Some(0.1 * size),
            "flange" => profile.flange = Some(0.15 * size),
            "area" => profile.area = Some(size * size),
            "inertia_y" => profile.inertia_y = Some(size.powi(4) / 12.0),
            "inertia_z" => profile.inertia_z = Some(size.powi(4) / 12.0 * dice.order(0.1, 1.0)),
            _ => profile.torsion = Some(size.powi(4) / 7.0),
        }
    }
    profile.failed_points = dice.number(0.1, 1.0);
    let elements = dice.whole(1, 5);
    add(
        dice,
        model,
        Part { element: "beam2".into(), profile: Some(profile), shape: SpaceTruss { lines, elements }.into(), ..start },
        softness,
    );
}

/// Two to four strips that meet at an edge at any angles, each a part of its own: they share the nodes
/// there, or are joined.
fn branches(dice: &mut Dice, model: &mut Model, centre: Vector, start: Part, softness: f64) {
    let (count, n, m) = (dice.whole(2, 4), dice.whole(1, 5), dice.whole(1, 5));
    let (length, width, is_joined) = (0.4 * CELL, 0.6 * CELL, dice.chance(0.4));
    let mut file = ImportedMesh { source: format!("branches{}", model.meshes.len()), ..ImportedMesh::default() };
    let turn = dice.number(0.0, TAU);
    let mut sections = Vec::new();
    for branch in 0..count {
        let angle = turn + TAU / count as f64 * (branch as f64 + dice.number(-0.3, 0.3));
        let own = branch == 0 || is_joined;
        let first = file.positions.len() as u32;
        let columns = if own { 0 } else { 1 };
        for i in columns..=n {
            let r = length * i as f64 / n as f64;
            for j in 0..=m {
                let z = width * (j as f64 / m as f64 - 0.5);
                file.positions.push([centre[0] + r * angle.cos(), centre[1] + r * angle.sin(), centre[2] + z]);
            }
        }
        let node = |i: usize, j: usize| {
            if own {
                first + (i * (m + 1) + j) as u32
            } else if i == 0 {
                j as u32
            } else {
                first + ((i - 1) * (m + 1) + j) as u32
            }
        };
        let is_split = dice.chance(0.3);
        let mut cells = Vec::new();
        for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            if is_split { cells.extend([vec![a, b, c], vec![a, c, d]]) } else { cells.push(vec![a, b, c, d]) }
        }
        let name = format!("body{}", model.parts.len() + branch);
        file.groups.push(MeshGroup { name: format!("{name}-foot"), dimension: 0, cells: (0..=m).map(|j| vec![node(0, j)]).collect() });
        file.groups.push(MeshGroup { name: format!("{name}-tip"), dimension: 0, cells: (0..=m).map(|j| vec![node(n, j)]).collect() });
        file.groups.push(MeshGroup { name: format!("{name}-sheet"), dimension: 2, cells });
        sections.push(section(dice, 0.5 * length));
    }
    let mesh = model.meshes.len();
    model.meshes.push(Arc::new(file));
    let first = model.parts.len();
    for section in sections {
        let group = format!("body{}-sheet", model.parts.len());
        let part = Part {
            element: "shell4".into(),
            shape: Shape::Group { mesh, group },
            section: Some(section),
            velocity: start.velocity,
            ..Part::default()
        };
        add(dice, model, part, softness);
    }
    if is_joined {
        for branch in 1..count {
            let between = [first, first + branch].map(|body| format!("body{body}-foot"));
            model.joins.push(Join { between, ..Join::default() });
        }
    }
}

/// A contact of all bodies, or pair by pair.
fn contacts(dice: &mut Dice, model: &mut Model) {
    let bodies = model.parts.iter().filter(|part| part.element != "beam2");
    let names: Vec<String> = bodies.map(|part| part.name.clone()).collect();
    if names.is_empty() {
        return;
    }
    if names.len() < 2 || names.len() > 5 || dice.chance(0.7) {
        model.contacts.push(contact_of_all(interface(dice)));
        return;
    }
    for (i, first) in names.iter().enumerate() {
        for second in &names[i + 1..] {
            let pass = Formulation::SinglePass { slave: dice.whole(0, 1) };
            let formulation = dice.choice(&[Formulation::DoublePass, Formulation::DoublePass, pass, Formulation::Segment]);
            let contact = Contact::between(&format!("{first}_{second}"), first, second);
            model.contacts.push(Contact { formulation, interface: interface(dice), ..contact });
        }
    }
}

/// Edges that are held, driven or twisted, faces under pressure, and weight.
fn acting(dice: &mut Dice, model: &mut Model, softness: f64, speed: f64) {
    let mut edges: Vec<(String, String)> = Vec::new();
    for part in model.parts.iter().filter(|part| part.has_rotations() && part.rigid.is_none()) {
        edges.extend(part.sides().into_iter().filter(|side| side != "upper" && side != "lower").map(|side| (part.name.clone(), side)));
    }
    let mut named: Vec<String> = edges.iter().map(|(part, side)| format!("{part}.{side}")).collect();
    named.extend(model.meshes.iter().flat_map(|mesh| &mesh.groups).filter(|group| group.name.ends_with("-tip")).map(|it| it.name.clone()));
    let spin = speed / CELL;
    if !named.is_empty() && dice.chance(0.3) {
        let on = dice.choice(&named);
        let held = Some(Drive::Constant(0.0));
        let driven = |dice: &mut Dice, size: f64| dice.chance(0.5).then(|| Drive::Constant(size * dice.number(-1.0, 1.0)));
        let mut constraint = Constraint { on, ..Constraint::default() };
        match dice.whole(0, 2) {
            0 => (constraint.velocity, constraint.spin) = ([0; 3].map(|_| held.clone()), [0; 3].map(|_| held.clone())),
            1 => constraint.spin = [driven(dice, spin), driven(dice, spin), Some(Drive::Constant(spin * dice.number(-1.0, 1.0)))],
            _ => {
                constraint.velocity = [Some(Drive::Constant(speed * dice.number(-1.0, 1.0))), driven(dice, speed), None];
                constraint.spin = [0; 3].map(|_| driven(dice, spin));
            }
        }
        model.constraints.push(constraint);
    }
    // As large as what bends the thinnest sheet by much.
    let stiffness = 2e11 * softness;
    if !named.is_empty() && dice.chance(0.2) {
        let all =
            model.parts.iter().filter_map(|part| part.section.as_ref().map(|it| it.thickness).or_else(|| part.profile.as_ref()?.height));
        let thickness = all.fold(1e-4, f64::min) * dice.order(0.3, 1.0);
        let size = stiffness * thickness.powi(3) * dice.number(0.1, 1.0);
        let moment = [0; 3].map(|_| size * dice.number(-1.0, 1.0));
        model.loads.push(Load::Moment { on: dice.choice(&named), moment, curve: None });
    }
    let sheets: Vec<String> = model.parts.iter().filter(|part| part.is_of_sheets()).map(|part| part.name.clone()).collect();
    if !sheets.is_empty() && dice.chance(0.2) {
        let on = format!("{}.{}", dice.choice(&sheets), dice.choice(&["upper", "lower"]));
        model.loads.push(Load::Pressure { on, pressure: stiffness * dice.order(1e-8, 1e-5), curve: None });
    }
    if dice.chance(0.2) {
        model.loads.push(Load::Gravity { parts: Vec::new(), acceleration: [0.0, 0.0, -speed * speed / CELL], curve: None });
    }
    if dice.chance(0.1) {
        model.loads.push(Load::StiffnessDamping { parts: Vec::new(), time: 1e-8 * dice.order(0.1, 10.0) });
    }
}
