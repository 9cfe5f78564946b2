//! Random models: bodies of any shape, element and law that fly at each other, with any contact between them;
//! the same seed gives the same model.

use embate_solver::bench::{self, Random};
use embate_solver::contact::search;
use embate_solver::element::{ELEMENTS, ElementKind};
use embate_solver::failure;
use embate_solver::material;
use embate_solver::model::{
    CircularArc, Contact, ContactLaw, Disk, Formulation, Friction, GAUSS, Interface, LOBATTO, Line, Load, Material, Model, Motion,
    Obstacle, ObstacleShape, Part, Partners, Penalty, PenaltySource, Placement, Rectangle, Ring, Run, Shape, ShellSection, Trapezoid,
};
use embate_solver::quantity::Dimension;
use embate_solver::stress_state::STRESS_STATES;

/// Throws for all that a model has.
pub(crate) struct Dice(Random);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Random::apart(seed))
    }

    /// Between two numbers.
    pub(crate) fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }

    /// Between two positive numbers, each order of magnitude as often.
    pub(crate) fn order(&mut self, low: f64, high: f64) -> f64 {
        self.number(low.ln(), high.ln()).exp()
    }

    pub(crate) fn whole(&mut self, low: usize, high: usize) -> usize {
        low + self.0.below(high - low + 1)
    }

    pub(crate) fn chance(&mut self, of: f64) -> bool {
        self.number(0.0, 1.0) < of
    }

    pub(crate) fn choice<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.whole(0, from.len() - 1)].clone()
    }
}

/// Side of the cell that a body gets, and the largest extent of a body, m.
const CELL: f64 = 0.01;
const BODY: f64 = 0.008;
/// Density of all laws times this is about their stiffness over the square of the speed of sound.
const SPEED_OF_SOUND: f64 = 5000.0;

/// Model number `seed`.
pub(crate) fn model(seed: u64) -> Model {
    let dice = &mut Dice::new(seed);
    let state = if dice.chance(0.6) { "plane_strain" } else { dice.choice(STRESS_STATES).name };
    let [columns, rows] = [dice.whole(1, 3), dice.whole(1, 3)];
    // All stiffnesses of a model are within four orders of magnitude of each other.
    let softness = dice.order(1e-4, 1.0);
    let speed = dice.order(1e-3, 0.06) * SPEED_OF_SOUND * softness.sqrt();
    let middle = [0.5 * CELL * columns as f64, 0.5 * CELL * rows as f64];
    let is_round = state == "axisymmetric";
    let mut model = Model { name: format!("soak {seed}"), ..Model::default() };
    model.output.pictures = false;
    for cell in 0..columns * rows {
        if cell > 0 && dice.chance(0.15) {
            continue;
        }
        let corner = [CELL * (cell % columns) as f64, CELL * (cell / columns) as f64];
        let centre = corner.map(|x| x + 0.5 * CELL);
        let name = format!("body{cell}");
        let own_softness = if dice.chance(0.2) { softness * dice.order(0.01, 1.0) } else { softness };
        model.materials.insert(name.clone(), material_of(dice, own_softness));
        let towards = [0, 1].map(|d| (middle[d] - centre[d]) / CELL + dice.number(-0.3, 0.3));
        let mut part = Part {
            material: name.clone(),
            name,
            element: dice.choice(&elements_of(ELEMENTS, 4)),
            element_triangles: dice.choice(&elements_of(ELEMENTS, 3)),
            stress_state: state.into(),
            shape: shape(dice, centre),
            velocity: embate_solver::model::in_3d(towards.map(|x| x * speed)),
            ..Part::default()
        };
        if is_round {
            part.velocity[0] = 0.0;
        } else {
            part.spin = if dice.chance(0.3) { dice.number(-1.0, 1.0) * speed / CELL } else { 0.0 };
            part.placement =
                Placement { rotation: dice.number(0.0, 6.3), rotation_point: embate_solver::model::in_3d(centre), ..Placement::default() };
            part.rigid = dice.chance(0.08).then(Motion::default);
        }
        model.parts.push(part);
    }
    contacts(dice, &mut model, is_round);
    obstacles(dice, &mut model, speed, is_round);
    if dice.chance(0.2) {
        let acceleration = [0.0, -speed * speed / CELL];
        model.loads.push(Load::Gravity { parts: Vec::new(), acceleration: embate_solver::model::in_3d(acceleration), curve: None });
    }
    let viscosity = if dice.chance(0.3) { [0.06, 1.2] } else { [0.0; 2] };
    model.run = Run { end: 4.0 * CELL / speed, max_steps: Some(dice.whole(200, 3000) as u64), bulk_viscosity: viscosity, ..Run::default() };
    model
}

/// Makes shells of most bodies of a model.
pub(crate) fn thin(seed: u64, model: &mut Model) {
    let dice = &mut Dice::new(seed ^ 0x5ce1_1e55);
    for part in &mut model.parts {
        // Axisymmetric bodies have no point that they are turned about.
        if dice.chance(0.25) || part.stress_state == "axisymmetric" {
            continue;
        }
        let [x, y, _] = part.placement.rotation_point;
        let half = 0.5 * BODY * dice.number(0.2, 0.9);
        let elements = dice.whole(1, 30);
        part.shape = match dice.whole(0, 2) {
            0 => Line { points: vec![[x - half, y], [x + half, y + 0.3 * half]], radius: 0.0, closed: false, elements }.into(),
            1 => {
                let points = vec![[x - half, y], [x, y + half * dice.number(-1.0, 1.0)], [x + half, y], [x, y - half]];
                let closed = dice.chance(0.5);
                Line { points, radius: 0.0, closed, elements: elements.max(4) }.into()
            }
            _ => {
                let to = if dice.chance(0.6) { std::f64::consts::TAU } else { dice.number(0.5, 6.0) };
                CircularArc { centre: [x, y], radius: half, to, elements: elements.max(3), ..CircularArc::default() }.into()
            }
        };
        let rule = if dice.chance(0.3) { LOBATTO } else { GAUSS };
        let section = ShellSection {
            thickness: half * dice.order(0.004, 0.3),
            points: dice.whole(3, 7),
            rule: rule.into(),
            failed_points: dice.number(0.1, 1.0),
            ..ShellSection::default()
        };
        (part.element, part.section) = ("shell2".into(), Some(section));
    }
}

/// Names of the elements with so many nodes.
pub(crate) fn elements_of(kinds: &[ElementKind], nodes: usize) -> Vec<String> {
    kinds.iter().filter(|kind| kind.nodes() == nodes).map(|kind| kind.name.to_string()).collect()
}

fn shape(dice: &mut Dice, centre: [f64; 2]) -> Shape {
    let n = dice.whole(1, 7);
    let radius = 0.5 * BODY / std::f64::consts::SQRT_2 * dice.number(0.5, 1.0);
    let size = [2.0 * radius * dice.number(0.3, 1.0), 2.0 * radius * dice.number(0.3, 1.0)];
    let corner = [centre[0] - 0.5 * size[0], centre[1] - 0.5 * size[1]];
    match dice.whole(0, 3) {
        0 => Rectangle { corner, size, elements: [n, dice.whole(1, 7)], ..Rectangle::default() }.into(),
        1 => Disk { centre, radius, elements: n }.into(),
        2 => {
            let inner = radius * dice.number(0.3, 0.9);
            Ring { centre, inner, outer: radius, elements: [dice.whole(1, 3), dice.whole(8, 40)], ..Ring::default() }.into()
        }
        _ => {
            let (bottom, top, height) = (size[0], size[0] * dice.number(0.2, 1.0), size[1]);
            Trapezoid { corner, bottom, top, height, shift: None, elements: [n, dice.whole(1, 7)], grading: [1.0; 2] }.into()
        }
    }
}

/// A material of any law, with all its stresses times `softness`; it may fail.
pub(crate) fn material_of(dice: &mut Dice, softness: f64) -> Material {
    // A fluid needs an equation of state besides.
    let laws: Vec<_> = material::registry().into_iter().filter(|kind| kind.name != "null").collect();
    let mut material = softened(dice.choice(&laws).name, softness);
    if dice.chance(0.1) {
        let limit = dice.choice(failure::CRITERIA);
        material.failure.insert(limit.limit.name.into(), dice.order(0.01, 1.0));
    }
    material
}

/// A material of this law, with all its stresses times `softness`.
pub(crate) fn softened(law: &str, softness: f64) -> Material {
    let registry = material::registry();
    let kind = registry.iter().find(|kind| kind.name == law);
    let is_stress = |name: &String| {
        let parameter = kind.and_then(|kind| kind.parameters.iter().find(|parameter| parameter.name == name));
        parameter.is_some_and(|parameter| parameter.dimension == Dimension::PRESSURE)
    };
    let mut material = bench::material(law);
    material.parameters.iter_mut().filter(|(name, _)| is_stress(name)).for_each(|(_, value)| *value *= softness);
    material
        .lists
        .iter_mut()
        .filter(|(name, _)| is_stress(name))
        .for_each(|(_, list)| list.iter_mut().for_each(|value| *value *= softness));
    material
}

/// A contact of all bodies with each other and themselves.
pub(crate) fn contact_of_all(interface: Interface) -> Contact {
    Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), interface, ..Contact::default() }
}

pub(crate) fn interface(dice: &mut Dice) -> Interface {
    let law = match dice.whole(0, 7) {
        0 => ContactLaw::Multiplier,
        1 => ContactLaw::Penalty(Penalty::Automatic { source: PenaltySource::TimeStep, scale: 1.0 }),
        2 => ContactLaw::Penalty(Penalty::Automatic { source: PenaltySource::BulkModulus, scale: dice.order(0.1, 10.0) }),
        _ => ContactLaw::Penalty(Penalty::automatic(dice.order(0.03, 100.0))),
    };
    let friction = dice.chance(0.4).then(|| Friction {
        coefficient: dice.number(0.0, 1.0),
        dynamic: None,
        decay: 0.0,
        viscosity: 0.0,
        limit: f64::INFINITY,
    });
    let damping = if law != ContactLaw::Multiplier && dice.chance(0.2) { dice.number(0.0, 1.0) } else { 0.0 };
    Interface { law, friction, damping, ..Interface::default() }
}

fn contacts(dice: &mut Dice, model: &mut Model, is_round: bool) {
    let searches: Vec<&str> = search::registry::<2>().iter().map(|kind| kind.name).collect();
    let names: Vec<String> = model.parts.iter().map(|part| part.name.clone()).collect();
    if names.len() < 2 || dice.chance(0.6) {
        let contact = contact_of_all(interface(dice));
        let search = if dice.chance(0.7) { String::new() } else { dice.choice(&searches).into() };
        model.contacts.push(Contact { search, ..contact });
        return;
    }
    for (i, first) in names.iter().enumerate() {
        for second in &names[i + 1..] {
            let pass = Formulation::SinglePass { slave: dice.whole(0, 1) };
            // Pinballs are cylinders in 2D.
            let last = if is_round { Formulation::DoublePass } else { Formulation::Pinball };
            let formulation = dice.choice(&[Formulation::DoublePass, Formulation::DoublePass, pass, Formulation::Segment, last]);
            let contact = Contact::between(&format!("{first}_{second}"), first, second);
            model.contacts.push(Contact { formulation, interface: interface(dice), ..contact });
        }
    }
}

fn obstacles(dice: &mut Dice, model: &mut Model, speed: f64, is_round: bool) {
    let extent = 3.0 * CELL;
    if dice.chance(0.3) {
        let plane = ObstacleShape::Plane { point: [0.0, -0.1 * CELL, 0.0], normal: [0.0, 1.0, 0.0], length: None };
        model.obstacles.push(Obstacle { interface: interface(dice), ..Obstacle::fixed("floor", plane) });
    }
    if !is_round && dice.chance(0.15) {
        let points =
            vec![[-0.5 * CELL, extent + CELL], [-0.5 * CELL, -0.5 * CELL], [0.3 * extent, -0.2 * CELL], [extent + CELL, -0.5 * CELL]];
        model.obstacles.push(Obstacle { interface: interface(dice), ..Obstacle::fixed("trough", ObstacleShape::Polyline { points }) });
    }
    if dice.chance(0.15) {
        let x = if is_round { 0.0 } else { dice.number(0.0, 2.0) * CELL };
        let circle = ObstacleShape::Circle { centre: [x, -1.1 * CELL, 0.0], radius: CELL, hollow: false };
        let mut obstacle = Obstacle { interface: interface(dice), ..Obstacle::fixed("ball", circle) };
        obstacle.motion.velocity[1] = Some((dice.number(0.0, 0.5) * speed).into());
        model.obstacles.push(obstacle);
    }
}
