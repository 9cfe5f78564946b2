//! Random models in 3D: bodies of any shape, element and law in cells, and scenes in which contact is
//! hard: crossed bars, wires, sheets of one element, chains of rings, coils, tetrahedra, thin bodies under
//! thick ones. The same seed gives the same model.

use crate::generator::{Dice, contact_of_all, elements_of, interface, material_of, softened};
use embate_solver::contact::search;
use embate_solver::element::ELEMENTS_OF_SPACE;
use embate_solver::model::{
    Contact, Cuboid, Cylinder, Disk, Extrude, Formulation, ImportedMesh, Load, MeshGroup, Model, Motion, Obstacle, ObstacleShape, Part,
    Placement, Rectangle, Run, Shape, Sphere, Sweep, Trapezoid, Tube,
};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
use std::sync::Arc;

pub(crate) type Vector = [f64; 3];

/// Side of the cell that a body gets, and width of bars and wires, m.
const CELL: f64 = 0.01;
const WIDTH: f64 = 0.002;
/// Laws for bodies that are to deform much.
const SOFT: [&str; 4] = ["neo_hookean", "neo_hookean", "mooney_rivlin", "elastic"];
/// About the speed of sound of all laws before their stresses are made smaller, m/s.
const SPEED_OF_SOUND: f64 = 5000.0;

/// Model number `seed`.
pub(crate) fn model(seed: u64) -> Model {
    let dice = &mut Dice::new(seed);
    let softness = dice.order(1e-6, 1.0);
    let sound = SPEED_OF_SOUND * softness.sqrt();
    let mut scene = Scene { softness, sound, speed: dice.order(0.02, 1.0) * sound, travel: 4.0 * WIDTH, model: Model::default() };
    scene.model.name = format!("soak in 3D {seed}");
    scene.model.output.pictures = false;
    let families: [fn(&mut Scene, &mut Dice); 9] =
        [any_bodies, any_bodies, crossed_bars, wires, thin_sheet, chain, coil, tetrahedra, under_a_thick_body];
    families[dice.whole(0, families.len() - 1)](&mut scene, dice);
    if scene.model.contacts.is_empty() {
        let mut contact = contact_of_all(interface(dice));
        if dice.chance(0.3) {
            let searches: Vec<&str> = search::registry::<3>().iter().map(|kind| kind.name).collect();
            contact.search = dice.choice(&searches).into();
        }
        scene.model.contacts.push(contact);
    }
    let viscosity = if dice.chance(0.3) { [0.06, 1.2] } else { [0.0; 2] };
    let max_steps = Some(dice.whole(50, 600) as u64);
    scene.model.run = Run { end: scene.travel / scene.speed, max_steps, bulk_viscosity: viscosity, ..Run::default() };
    scene.model
}

/// A model that grows.
struct Scene {
    model: Model,
    /// What stresses of laws are multiplied by, and the speed of sound then, m/s.
    softness: f64,
    sound: f64,
    /// How fast bodies meet, m/s, and how far they are to move against each other, m.
    speed: f64,
    travel: f64,
}

impl Scene {
    /// A part of this mesh; its material has its name.
    fn add(&mut self, dice: &mut Dice, mesh: Solid, velocity: Vector) {
        let name = format!("body{}", self.model.parts.len());
        let nodes = mesh.cells.iter().map(Vec::len).max().unwrap_or(0);
        let groups = vec![MeshGroup { name: "body".into(), dimension: 3, cells: mesh.cells }];
        self.model.meshes.push(Arc::new(ImportedMesh {
            source: name.clone(),
            positions: mesh.positions,
            groups,
            ..ImportedMesh::default()
        }));
        let law = dice.choice(&SOFT);
        let own = if dice.chance(0.3) { dice.order(0.05, 20.0) } else { 1.0 };
        self.model.materials.insert(name.clone(), softened(law, self.softness * own));
        let mut element = dice.choice(&elements_of(ELEMENTS_OF_SPACE, nodes));
        // Every second body of averaged pressure has ten nodes instead: without a die, so that all others
        // stay as they were.
        if element == "tet4_anp" && self.model.parts.len() % 2 == 1 {
            element = "tet10".into();
        }
        self.model.parts.push(Part {
            material: name.clone(),
            name,
            element,
            shape: Shape::Group { mesh: self.model.meshes.len() - 1, group: "body".into() },
            velocity,
            ..Part::default()
        });
    }

    /// One body, and another that is thrown at it along -z from just above it.
    fn throw(&mut self, dice: &mut Dice, still: Solid, moving: Solid, aside: [f64; 2]) {
        let up = still.reach(1.0) + dice.number(0.05, 0.3) * WIDTH + moving.reach(-1.0);
        let moving = moving.moved([aside[0], aside[1], up]);
        let speed = self.speed;
        self.add(dice, still, [0.0; 3]);
        self.add(dice, moving, [0.0, 0.0, -speed]);
    }

    /// A plane across z that moves along it.
    fn plane(&mut self, dice: &mut Dice, name: &str, z: f64, up: f64, velocity: f64) {
        let shape = ObstacleShape::Plane { point: [0.0, 0.0, z], normal: [0.0, 0.0, up], length: None };
        let mut obstacle = Obstacle { interface: interface(dice), ..Obstacle::fixed(name, shape) };
        obstacle.motion.velocity[2] = Some(velocity.into());
        self.model.obstacles.push(obstacle);
    }
}

/// What the elements of a mesh are.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Hexahedra,
    Wedges,
    Tetrahedra,
    /// Some columns of hexahedra are two of wedges.
    Mixed,
}

const KINDS: [Kind; 6] = [Kind::Hexahedra, Kind::Hexahedra, Kind::Tetrahedra, Kind::Tetrahedra, Kind::Wedges, Kind::Mixed];

/// Nodes and elements of one body.
#[derive(Clone)]
struct Solid {
    positions: Vec<Vector>,
    cells: Vec<Vec<u32>>,
}

impl Solid {
    /// A grid of so many cells, its node at the parts (u, v, w) of its edges at `place(u, v, w)`; with
    /// `closed` its last axis is a ring. `place` keeps the hand.
    fn grid(dice: &mut Dice, counts: [usize; 3], closed: bool, place: impl Fn(Vector) -> Vector) -> Self {
        let kind = dice.choice(&KINDS);
        let [nx, ny, nz] = counts;
        let layers = if closed { nz } else { nz + 1 };
        let places = (0..layers).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k])));
        let positions = places.map(|at| place([0, 1, 2].map(|d| at[d] as f64 / counts[d] as f64))).collect();
        let node = |i: usize, j: usize, k: usize| ((k % layers * (ny + 1) + j) * (nx + 1) + i) as u32;
        let square = |i: usize, j: usize, k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
        let mut cells = Vec::new();
        for (i, j) in (0..nx * ny).map(|column| (column % nx, column / nx)) {
            let is_split = kind == Kind::Wedges || kind == Kind::Mixed && dice.chance(0.5);
            for k in 0..nz {
                let corners = [square(i, j, k), square(i, j, k + 1)].concat();
                let pieces: &[&[usize]] = match kind {
                    Kind::Tetrahedra => &[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]],
                    _ if is_split => &[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]],
                    _ => &[&[0, 1, 2, 3, 4, 5, 6, 7]],
                };
                cells.extend(pieces.iter().map(|piece| piece.iter().map(|&corner| corners[corner]).collect::<Vec<u32>>()));
            }
        }
        Self { positions, cells }
    }

    /// A box around the origin.
    fn cuboid(dice: &mut Dice, size: Vector, counts: [usize; 3]) -> Self {
        Self::grid(dice, counts, false, |at| [0, 1, 2].map(|d| (at[d] - 0.5) * size[d]))
    }

    /// A square wire with a frame (centre, two directions across, so that the third points along) at each
    /// part of its length.
    fn wire(dice: &mut Dice, width: f64, counts: [usize; 3], closed: bool, frame: impl Fn(f64) -> [Vector; 3]) -> Self {
        let (sin, cos) = dice.choice(&[0.0, FRAC_PI_4, 0.3]).sin_cos();
        Self::grid(dice, counts, closed, |[u, v, w]| {
            let [centre, first, second] = frame(w);
            let (x, y) = ((u - 0.5) * width, (v - 0.5) * width);
            let (x, y) = (x * cos - y * sin, x * sin + y * cos);
            [0, 1, 2].map(|d| centre[d] + x * first[d] + y * second[d])
        })
    }

    /// A tetrahedron with these corners: one element of each corner, or one in all.
    fn tetrahedron(dice: &mut Dice, corners: [Vector; 4]) -> Self {
        let [a, b, c] = [1, 2, 3].map(|k| difference(corners[k], corners[0]));
        let corners = if dot(a, cross(b, c)) > 0.0 { corners } else { [corners[0], corners[2], corners[1], corners[3]] };
        if dice.chance(0.5) {
            return Self { positions: corners.to_vec(), cells: vec![vec![0, 1, 2, 3]] };
        }
        // Corners are nodes 0 to 3, middles of edges 4 to 9, of faces 10 to 13 (without corner k), the middle
        // is 14.
        const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        let mean = |of: &[usize]| [0, 1, 2].map(|d| of.iter().map(|&k| corners[k][d]).sum::<f64>() / of.len() as f64);
        let edge =
            |a: usize, b: usize| 4 + EDGES.iter().position(|edge| *edge == [a.min(b), a.max(b)]).expect("any two of four corners") as u32;
        let mut positions = corners.to_vec();
        positions.extend(EDGES.iter().map(|edge| mean(edge)));
        positions.extend((0..4).map(|k| mean(&[(k + 1) % 4, (k + 2) % 4, (k + 3) % 4])));
        positions.push(mean(&[0, 1, 2, 3]));
        // The other three corners, counter-clockwise as seen from corner k.
        let others = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
        let cells = others.iter().enumerate().map(|(k, &[a, b, c])| {
            let face = |without: usize| 10 + without as u32;
            vec![k as u32, edge(k, a), face(c), edge(k, b), edge(k, c), face(b), 14, face(a)]
        });
        let cells = cells.collect();
        Self { positions, cells }
    }

    /// Turned about an axis through the origin, by Rodrigues' formula.
    fn turned(mut self, axis: Vector, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let axis = unit(axis);
        for x in &mut self.positions {
            let (along, around) = (dot(*x, axis) * (1.0 - cos), cross(axis, *x));
            *x = [0, 1, 2].map(|d| x[d] * cos + around[d] * sin + axis[d] * along);
        }
        self
    }

    fn turned_anyhow(self, dice: &mut Dice) -> Self {
        let axis = [0; 3].map(|_| dice.number(-1.0, 1.0));
        self.turned(axis, dice.number(0.0, TAU))
    }

    fn moved(mut self, by: Vector) -> Self {
        for x in &mut self.positions {
            *x = [0, 1, 2].map(|d| x[d] + by[d]);
        }
        self
    }

    /// How far it reaches up (1) or down (-1) from z = 0.
    fn reach(&self, up: f64) -> f64 {
        self.positions.iter().map(|x| up * x[2]).fold(f64::NEG_INFINITY, f64::max)
    }
}

pub(crate) fn difference(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|d| a[d] - b[d])
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|d| a[d] * b[d]).sum()
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Of length one; x where it has none.
fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|x| x / length) } else { [1.0, 0.0, 0.0] }
}

const X: Vector = [1.0, 0.0, 0.0];
const Z: Vector = [0.0, 0.0, 1.0];

/// Bodies of any shape, element and law in some of eight cells, that fly at each other; any obstacles and
/// contacts.
fn any_bodies(scene: &mut Scene, dice: &mut Dice) {
    let cells = [dice.whole(1, 2), dice.whole(1, 2), dice.whole(1, 2)];
    let middle = cells.map(|n| 0.5 * CELL * n as f64);
    scene.speed = dice.order(1e-3, 0.1) * scene.sound;
    scene.travel = 3.0 * CELL;
    for cell in 0..cells.iter().product() {
        if cell > 0 && dice.chance(0.15) {
            continue;
        }
        let place = [cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]];
        let centre = place.map(|n| CELL * (n as f64 + 0.5));
        let name = format!("body{}", scene.model.parts.len());
        let softness = scene.softness * if dice.chance(0.2) { dice.order(0.01, 1.0) } else { 1.0 };
        scene.model.materials.insert(name.clone(), material_of(dice, softness));
        let (shape, sweep) = shape(dice, centre);
        let towards = [0, 1, 2].map(|d| (middle[d] - centre[d]) / CELL + dice.number(-0.3, 0.3));
        scene.model.parts.push(Part {
            material: name.clone(),
            name,
            element: dice.choice(&elements_of(ELEMENTS_OF_SPACE, 8)),
            shape,
            sweep,
            velocity: towards.map(|x| x * scene.speed),
            spin: if dice.chance(0.3) { dice.number(-1.0, 1.0) * scene.speed / CELL } else { 0.0 },
            placement: Placement {
                rotation: dice.number(0.0, TAU),
                rotation_point: centre,
                rotation_axis: [0; 3].map(|_| dice.number(0.05, 1.0)),
                ..Placement::default()
            },
            rigid: dice.chance(0.08).then(Motion::default),
            ..Part::default()
        });
    }
    contacts(scene, dice);
    obstacles(scene, dice);
    if dice.chance(0.2) {
        let acceleration = [0.0, 0.0, -scene.speed * scene.speed / CELL];
        scene.model.loads.push(Load::Gravity { parts: Vec::new(), acceleration, curve: None });
    }
}

/// A solid within a ball of 0.45 cells around a point, and how it is swept.
pub(crate) fn shape(dice: &mut Dice, centre: Vector) -> (Shape, Option<Sweep>) {
    let n = dice.whole(1, 3);
    let radius = 0.45 * CELL * dice.number(0.5, 1.0);
    // Half the length, and the radius across it that is left.
    let half = radius * dice.number(0.3, 0.8);
    let across = (radius * radius - half * half).sqrt();
    let bottom = [centre[0], centre[1], centre[2] - half];
    let extrude = Some(Sweep::Extrude(Extrude { from: bottom[2], length: 2.0 * half, elements: dice.whole(1, 3), ..Extrude::default() }));
    match dice.whole(0, 6) {
        0 => {
            let size = [0; 3].map(|_| 2.0 * radius / 3.0_f64.sqrt() * dice.number(0.3, 1.0));
            let corner = [0, 1, 2].map(|d| centre[d] - 0.5 * size[d]);
            (Cuboid { corner, size, elements: [n, dice.whole(1, 3), dice.whole(1, 3)], ..Cuboid::default() }.into(), None)
        }
        1 => (Sphere { centre, radius, elements: dice.whole(1, 2), ..Sphere::default() }.into(), None),
        2 => {
            let elements = [dice.whole(1, 2), n];
            (Cylinder { centre: bottom, radius: across, length: 2.0 * half, elements, ..Cylinder::default() }.into(), None)
        }
        3 => {
            let (inner, elements) = (across * dice.number(0.3, 0.9), [dice.whole(1, 2), dice.whole(8, 16), n]);
            (Tube { centre: bottom, inner, outer: across, length: 2.0 * half, elements, ..Tube::default() }.into(), None)
        }
        4 => (Disk { centre: [centre[0], centre[1]], radius: across, elements: n }.into(), extrude),
        5 => {
            let side = across * 2.0_f64.sqrt();
            let corner = [centre[0] - 0.5 * side, centre[1] - 0.5 * side];
            (Rectangle { corner, size: [side; 2], elements: [n, dice.whole(1, 3)], ..Rectangle::default() }.into(), extrude)
        }
        _ => {
            let (side, top) = (across * 2.0_f64.sqrt(), dice.number(0.2, 1.0));
            let corner = [centre[0] - 0.5 * side, centre[1] - 0.5 * side];
            let trapezoid = Trapezoid {
                corner,
                bottom: side,
                top: side * top,
                height: side,
                shift: None,
                elements: [n, dice.whole(1, 3)],
                grading: [1.0; 2],
            };
            (trapezoid.into(), extrude)
        }
    }
}

/// Contacts pair by pair in some models, so that all formulations meet; the others get one of all bodies
/// later.
fn contacts(scene: &mut Scene, dice: &mut Dice) {
    let names: Vec<String> = scene.model.parts.iter().map(|part| part.name.clone()).collect();
    if names.len() < 2 || dice.chance(0.6) {
        return;
    }
    for (i, first) in names.iter().enumerate() {
        for second in &names[i + 1..] {
            let pass = Formulation::SinglePass { slave: dice.whole(0, 1) };
            let formulation = dice.choice(&[Formulation::DoublePass, Formulation::DoublePass, pass, Formulation::Pinball]);
            let contact = Contact::between(&format!("{first}_{second}"), first, second);
            scene.model.contacts.push(Contact { formulation, interface: interface(dice), ..contact });
        }
    }
}

fn obstacles(scene: &mut Scene, dice: &mut Dice) {
    if dice.chance(0.3) {
        scene.plane(dice, "floor", -0.1 * CELL, 1.0, 0.0);
    }
    if dice.chance(0.1) {
        let shape = ObstacleShape::Sphere { centre: [dice.number(0.0, 2.0) * CELL, CELL, -1.1 * CELL], radius: CELL, hollow: false };
        let mut obstacle = Obstacle { interface: interface(dice), ..Obstacle::fixed("ball", shape) };
        obstacle.motion.velocity[2] = Some((dice.number(0.0, 0.5) * scene.speed).into());
        scene.model.obstacles.push(obstacle);
    }
    if dice.chance(0.1) {
        let shape = ObstacleShape::Cylinder { point: [CELL; 3], axis: [0.2, 0.1, 1.0], radius: 4.0 * CELL, hollow: true };
        scene.model.obstacles.push(Obstacle { interface: interface(dice), ..Obstacle::fixed("pipe", shape) });
    }
}

/// A square bar along x that is turned about its axis, 1 to 3 elements across.
fn bar(dice: &mut Dice, width: f64) -> Solid {
    let (across, length) = (dice.choice(&[1, 1, 2, 2, 3]), dice.number(5.0, 12.0));
    let count = (length * across as f64 * dice.choice(&[0.5, 1.0])) as usize;
    let turn = dice.choice(&[0.0, FRAC_PI_4, FRAC_PI_4, 0.2]);
    Solid::cuboid(dice, [length * width, width, width], [count.clamp(3, 18), across, across]).turned(X, turn)
}

/// Two or three bars, each thrown at the one below.
fn crossed_bars(scene: &mut Scene, dice: &mut Dice) {
    let width = WIDTH * dice.choice(&[1.0, 1.0, 0.5]);
    let angle = dice.choice(&[FRAC_PI_2, FRAC_PI_2, 0.7, 0.4]);
    let (still, moving) = (bar(dice, WIDTH), bar(dice, width).turned(Z, angle));
    let aside = [dice.number(-1.0, 1.0) * WIDTH, dice.number(-0.5, 0.5) * WIDTH];
    scene.throw(dice, still, moving, aside);
    if dice.chance(0.3) {
        let top = scene.model.meshes[1].positions.iter().map(|x| x[2]).fold(f64::NEG_INFINITY, f64::max);
        let third = bar(dice, WIDTH).turned(Z, dice.number(0.5, 2.5));
        let up = top + 0.2 * WIDTH + third.reach(-1.0);
        let third = third.moved([0.0, 0.0, up]);
        let speed = scene.speed;
        scene.add(dice, third, [0.0, 0.0, -2.0 * speed]);
    }
}

/// Two to four wavy wires, one over the other.
fn wires(scene: &mut Scene, dice: &mut Dice) {
    let mut top = 0.0;
    for number in 0..dice.whole(2, 4) {
        let (length, height, phase, waves) = (12.0 * WIDTH, dice.number(0.0, 1.5) * WIDTH, dice.number(0.0, TAU), dice.number(0.5, 2.0));
        let across = dice.choice(&[1, 1, 2]);
        let counts = [across, across, dice.whole(10, 20)];
        let wire = Solid::wire(dice, 0.6 * WIDTH, counts, false, |t| {
            let (y, dy) = (height * (TAU * waves * t + phase).sin(), height * TAU * waves * (TAU * waves * t + phase).cos());
            let along = unit([length, dy, 0.0]);
            [[length * (t - 0.5), y, 0.0], [-along[1], along[0], 0.0], Z]
        });
        let wire = wire.turned(Z, dice.number(0.5, 1.2) * number as f64);
        let up = top + wire.reach(-1.0);
        let wire = wire.moved([0.0, 0.0, up]);
        top = wire.reach(1.0) + 0.2 * WIDTH;
        let speed = scene.speed;
        scene.add(dice, wire, [0.0, 0.0, -speed * number as f64]);
    }
}

/// A sheet of one element, hit by a bar, a box on its corner, a needle or a tetrahedron.
fn thin_sheet(scene: &mut Scene, dice: &mut Dice) {
    let (thickness, n) = (WIDTH * dice.order(0.1, 1.0), dice.whole(4, 10));
    let sheet = Solid::cuboid(dice, [8.0 * WIDTH, 8.0 * WIDTH, thickness], [n, n, 1]);
    let m = dice.whole(1, 3);
    let hits = match dice.whole(0, 3) {
        0 => bar(dice, WIDTH).turned(Z, dice.number(0.0, 3.0)),
        1 => Solid::cuboid(dice, [2.0 * WIDTH; 3], [m; 3]).turned_anyhow(dice),
        2 => {
            let tip = dice.number(0.1, 0.5);
            let place = |[u, v, w]: Vector| {
                let width = WIDTH * (tip + (1.0 - tip) * w);
                [(u - 0.5) * width, (v - 0.5) * width, 3.0 * WIDTH * w]
            };
            Solid::grid(dice, [2, 2, 5], false, place)
        }
        _ => shard(dice).turned_anyhow(dice),
    };
    scene.travel = thickness + 4.0 * WIDTH;
    let aside = [0; 2].map(|_| dice.number(-2.0, 2.0) * WIDTH);
    scene.throw(dice, sheet, hits, aside);
}

fn shard(dice: &mut Dice) -> Solid {
    loop {
        let corners = [0; 4].map(|_| unit([0; 3].map(|_| dice.number(-1.0, 1.0))).map(|x| 2.0 * WIDTH * x));
        let [a, b, c] = [1, 2, 3].map(|k| difference(corners[k], corners[0]));
        if dot(a, cross(b, c)).abs() > 10.0 * WIDTH.powi(3) {
            return Solid::tetrahedron(dice, corners);
        }
    }
}

/// Rings linked with each other that are pulled apart.
fn chain(scene: &mut Scene, dice: &mut Dice) {
    let (count, width, radius) = (dice.whole(2, 3), 0.8 * WIDTH, 2.5 * WIDTH);
    for number in 0..count {
        let across = dice.choice(&[1, 1, 2]);
        let counts = [across, across, dice.choice(&[12, 16])];
        let ring = Solid::wire(dice, width, counts, true, |t| {
            let (sin, cos) = (TAU * t).sin_cos();
            // Across: down, then outward, so that the third points along.
            [[radius * cos, radius * sin, 0.0], [0.0, 0.0, -1.0], [-cos, -sin, 0.0]]
        });
        let x = number as f64 * (2.0 * radius - 2.2 * width);
        let ring = ring.turned(X, FRAC_PI_2 * (number % 2) as f64).moved([x, 0.0, 0.0]);
        let speed = scene.speed * (number as f64 / (count - 1) as f64 - 0.5);
        scene.add(dice, ring, [speed, 0.0, 0.0]);
    }
}

/// A coil that is pressed together between two planes.
fn coil(scene: &mut Scene, dice: &mut Dice) {
    let (turns, radius, pitch) = (dice.number(1.5, 2.5), 2.5 * WIDTH, dice.number(1.7, 2.6) * WIDTH);
    let across = dice.choice(&[1, 1, 2]);
    let counts = [across, across, (turns * 12.0) as usize];
    let coil = Solid::wire(dice, WIDTH, counts, false, |t| {
        let (sin, cos) = (TAU * turns * t).sin_cos();
        [[radius * cos, radius * sin, pitch * turns * t], [0.0, 0.0, -1.0], [-cos, -sin, 0.0]]
    });
    let (low, high) = (-coil.reach(-1.0), coil.reach(1.0));
    scene.speed = dice.order(0.02, 0.5) * scene.sound;
    scene.travel = (high - low - 0.9 * (turns + 1.0) * WIDTH).max(WIDTH);
    scene.add(dice, coil, [0.0; 3]);
    scene.plane(dice, "floor", low - 0.05 * WIDTH, 1.0, 0.0);
    let speed = scene.speed;
    scene.plane(dice, "ram", high + 0.05 * WIDTH, -1.0, -speed);
}

/// Tetrahedra that fly at each other.
fn tetrahedra(scene: &mut Scene, dice: &mut Dice) {
    scene.travel = 8.0 * WIDTH;
    for number in 0..dice.whole(2, 8) {
        let at = [number % 2, number / 2 % 2, number / 4].map(|n| 4.2 * WIDTH * (n as f64 - 0.5));
        let towards = at.map(|x| -x / (4.2 * WIDTH) + dice.number(-0.3, 0.3));
        let shard = shard(dice).moved(at);
        let speed = scene.speed;
        scene.add(dice, shard, towards.map(|x| x * speed));
    }
}

/// A thin body on a floor, and a thick one that falls on it.
fn under_a_thick_body(scene: &mut Scene, dice: &mut Dice) {
    let (thickness, n, m) = (WIDTH * dice.order(0.2, 1.0), dice.whole(3, 8), dice.whole(1, 3));
    let thin = Solid::cuboid(dice, [8.0 * WIDTH, 8.0 * WIDTH, thickness], [n, n, 1]);
    let tilt = dice.choice(&[0.0, 0.0, 0.3]);
    let thick = Solid::cuboid(dice, [3.0 * WIDTH; 3], [m; 3]).turned(X, tilt).turned(Z, dice.number(0.0, 1.5));
    scene.travel = 3.0 * thickness;
    let aside = [dice.number(-1.0, 1.0) * WIDTH, 0.0];
    scene.throw(dice, thin, thick, aside);
    scene.plane(dice, "floor", -0.5 * thickness - 0.01 * WIDTH, 1.0, 0.0);
}
