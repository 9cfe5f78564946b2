//! Bodies to measure with: a patch in a given motion for the kernels alone, a spinning block for whole steps,
//! a stack of strips for contact.

use crate::material;
use crate::mesh::cell::CellKind;
use crate::model::{
    Contact, Cuboid, Friction, Interface, Line, Material, Model, Output, Part, Partners, Profile, RECTANGLE, Rectangle, Run, Shape,
    ShellSection, SpaceTruss,
};
use crate::vector::{plus, times};
use std::collections::BTreeMap;

/// Parameters of any law: steel that flows at once and hardens strongly; rubbers and orthotropic bodies of
/// its stiffness.
const NUMBERS: &[(&str, f64)] = &[
    ("density", 7800.0),
    ("young", 2e11),
    ("poisson", 0.3),
    ("yield", 1e8),
    ("hardening", 5e10),
    ("saturation", 5e8),
    ("saturation_rate", 20.0),
    ("strength", 5e8),
    ("strain_offset", 0.002),
    ("hardening_exponent", 0.3),
    ("isotropic_stress", 1e8),
    ("rate_coefficient", 0.02),
    ("temperature_melt", 1800.0),
    ("specific_heat", 460.0),
    ("cohesion", 1e8),
    ("friction_angle", 0.5),
    ("dilation_angle", 0.1),
    ("bulk", 2e11),
    ("shear", 8e10),
    ("c10", 3e10),
    ("c20", 1e10),
    ("c30", 1e9),
    ("c01", 1e10),
    ("locking_stretch", 5.0),
    ("young_1", 2e11),
    ("young_2", 1e11),
    ("young_3", 1e11),
    ("poisson_12", 0.3),
    ("poisson_23", 0.3),
    ("poisson_31", 0.1),
    ("shear_12", 5e10),
    ("angle", 0.5),
];
const LISTS: &[(&str, &[f64])] = &[
    ("plastic_strain", &[0.0, 0.1, 0.2, 0.5]),
    ("stress", &[1e8, 2e8, 3e8, 4e8]),
    ("backstress_modulus", &[5e10, 1e10, 1e9]),
    ("backstress_recall", &[500.0, 50.0, 0.0]),
    ("mu", &[6e10, -1e10, 1e9]),
    ("alpha", &[2.0, -2.0, 5.0]),
    ("shear_ratio", &[0.2, 0.3]),
    ("relaxation_time", &[1e-3, 1e-6]),
];

/// A material of this law with the parameters that it has.
#[must_use]
pub fn material(law: &str) -> Material {
    let kind = material::registry().into_iter().find(|kind| kind.name == law);
    let knows = |name: &str| kind.is_some_and(|kind| kind.parameters.iter().any(|parameter| parameter.name == name));
    let parameters = NUMBERS.iter().filter(|(name, _)| knows(name)).map(|(name, value)| ((*name).to_string(), *value)).collect();
    let lists = LISTS.iter().filter(|(name, _)| knows(name)).map(|(name, list)| ((*name).to_string(), list.to_vec())).collect();
    Material { law: law.into(), parameters, lists, ..Material::default() }
}

/// A square of quadrilaterals, or a cube of solid elements, in a swirling, stretching motion that yields.
#[derive(Clone, Debug)]
pub struct Patch<const D: usize> {
    /// Positions of its nodes, m.
    pub positions: Vec<[f64; D]>,
    /// Their velocities, m/s.
    pub velocities: Vec<[f64; D]>,
    /// Nodes of its elements, one after the other.
    pub connectivity: Vec<u32>,
}

impl Patch<3> {
    /// `n` × `n` × `n` cubes of 1 mm, each divided into cells of a kind: one hexahedron, two wedges or six
    /// tetrahedra; nodes between corners are in the middles of edges.
    #[must_use]
    pub fn solid(kind: CellKind, n: usize) -> Self {
        let side = n + 1;
        let place = |k: usize| [k % side, k / side % side, k / (side * side)].map(|i| i as f64 * 1e-3);
        let mut positions: Vec<[f64; 3]> = (0..side * side * side).map(place).collect();
        let corners = (0..n * n * n).flat_map(|cell| {
            let first = (cell / (n * n) * side + cell / n % n) * side + cell % n;
            let node = move |corner: usize| {
                let [i, j, k] = [usize::from(matches!(corner % 4, 1 | 2)), corner % 4 / 2, corner / 4];
                (first + (k * side + j) * side + i) as u32
            };
            kind.facts().division.iter().map(move |&corner| node(usize::from(corner)))
        });
        let corners: Vec<u32> = corners.collect();
        let mut connectivity = Vec::new();
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for cell in corners.chunks_exact(kind.corners()) {
            connectivity.extend_from_slice(cell);
            for edge in kind.facts().edges.iter().take(kind.nodes() - kind.corners()) {
                let [a, b] = edge.map(|corner| cell[usize::from(corner)]);
                let middle = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    positions.push(times(0.5, plus(positions[a as usize], positions[b as usize])));
                    positions.len() as u32 - 1
                });
                connectivity.push(middle);
            }
        }
        let velocities = positions.iter().map(|[x, y, z]| [100.0 * y + 20.0 * x, 60.0 * z - 80.0 * x + 5.0 * y, 10.0 * z - 50.0 * y]);
        Self { velocities: velocities.collect(), connectivity, positions }
    }
}

impl Patch<2> {
    /// `n` × `n` elements of 1 mm.
    #[must_use]
    pub fn new(n: usize) -> Self {
        let node = |i: usize, j: usize| (j * (n + 1) + i) as u32;
        let positions: Vec<[f64; 2]> = (0..(n + 1) * (n + 1)).map(|k| [(k % (n + 1)) as f64 * 1e-3, (k / (n + 1)) as f64 * 1e-3]).collect();
        let velocities = positions.iter().map(|[x, y]| [100.0 * y + 20.0 * x, -80.0 * x + 5.0 * y]).collect();
        let quads = (0..n * n).flat_map(|k| {
            let (i, j) = (k % n, k / n);
            [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
        });
        Self { positions, velocities, connectivity: quads.collect() }
    }
}

/// Speed at the middle of the sides of a spinning block, m/s: the forces that hold it together make metals of
/// [`material`] yield.
const SPEED: f64 = 300.0;

/// A block of `n` × `n` elements of 1 mm that spins and touches nothing.
#[must_use]
pub fn spinning_block(element: &str, law: &str, n: usize) -> Model {
    let size = n as f64 * 1e-3;
    let shape = Rectangle { corner: [-0.5 * size; 2], size: [size; 2], elements: [n, n], ..Rectangle::default() };
    spinning(element, law, Shape::Rectangle(shape), size)
}

/// The same in 3D: a cube of `n` × `n` × `n` elements.
#[must_use]
pub fn spinning_cube(element: &str, law: &str, n: usize) -> Model {
    let size = n as f64 * 1e-3;
    let shape = Cuboid { corner: [-0.5 * size; 3], size: [size; 3], elements: [n; 3], ..Cuboid::default() };
    spinning(element, law, Shape::Cuboid(shape), size)
}

/// A shell or a beam of about so many elements of 1 mm that spins and touches nothing: `shell2` and `beam2`
/// are a straight strip, `shell4` a square plate. Half a millimetre thick (a beam one millimetre wide), with
/// so many points through the thickness (fibres along each side).
#[must_use]
pub fn spinning_sheet(element: &str, law: &str, elements: usize, points: usize) -> Model {
    let is_line = ["shell2", "beam2"].contains(&element);
    let n = if is_line { elements } else { (elements as f64).sqrt() as usize };
    let half = 0.5e-3 * n as f64;
    let shape = match element {
        "shell2" => Shape::Line(Line { points: vec![[-half, 0.0], [half, 0.0]], radius: 0.0, closed: false, elements: n }),
        "beam2" => Shape::SpaceTruss(SpaceTruss { lines: vec![vec![[-half, 0.0, 0.0], [half, 0.0, 0.0]]], elements: n }),
        _ => Shape::Rectangle(Rectangle { corner: [-half; 2], size: [2.0 * half; 2], elements: [n, n], ..Rectangle::default() }),
    };
    let mut model = spinning(element, law, shape, 2.0 * half);
    let part = &mut model.parts[0];
    if element == "beam2" {
        let (width, height) = (Some(1e-3), Some(0.5e-3));
        part.profile = Some(Profile { shape: RECTANGLE.into(), width, height, points: Some(points), ..Profile::default() });
    } else {
        part.section = Some(ShellSection { thickness: 0.5e-3, points, ..ShellSection::default() });
    }
    model
}

/// A body with sides of a `size`, m, about the origin.
fn spinning(element: &str, law: &str, shape: Shape, size: f64) -> Model {
    let part = Part {
        name: "block".into(),
        material: "block".into(),
        element: element.into(),
        shape,
        spin: SPEED / (0.5 * size),
        ..Part::default()
    };
    Model {
        name: "spinning block".into(),
        run: Run { end: 1.0, ..Run::default() },
        materials: [("block".to_string(), material(law))].into(),
        parts: vec![part],
        output: Output { pictures: false, ..Output::default() },
        ..Model::default()
    }
}

/// A contact with a coefficient of friction.
#[must_use]
pub fn contact(partners: Partners, friction: f64) -> Contact {
    let friction = Friction { coefficient: friction, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    let interface = Interface { friction: (friction.coefficient > 0.0).then_some(friction), ..Interface::default() };
    Contact { name: "all".into(), partners, interface, ..Contact::default() }
}

/// Elements through a strip, and along it per element through it.
const THROUGH: usize = 20;
/// Size of an element of a strip, m, and the gap between strips.
const SIZE: f64 = 1e-3;
const GAP: f64 = 1e-5;

/// A stack of long strips of about so many elements, each so near to the next that every node of their long
/// sides is in reach of the next strip; every second one moves up with this speed, the others down. There is
/// no contact yet.
#[must_use]
pub fn strips(elements: usize, speed: f64) -> Model {
    let strips = (elements as f64 / (THROUGH * THROUGH) as f64).sqrt().ceil().max(2.0) as usize;
    let along = (elements / (strips * THROUGH)).max(1);
    let mut model = Model { run: Run { end: 1.0, ..Run::default() }, ..Model::default() };
    let parameters = [("young", 1e9), ("poisson", 0.3), ("density", 1e3)].map(|(key, value)| (key.to_string(), value));
    model.materials.insert("soft".into(), Material { law: "elastic".into(), parameters: parameters.into(), ..Material::default() });
    for strip in 0..strips {
        let y = strip as f64 * (THROUGH as f64 * SIZE + GAP);
        let size = [along as f64 * SIZE, THROUGH as f64 * SIZE];
        let velocity = [0.0, if strip % 2 == 0 { speed } else { -speed }, 0.0];
        let shape = Shape::Rectangle(Rectangle {
            corner: [0.3 * SIZE * (strip % 2) as f64, y],
            size,
            elements: [along, THROUGH],
            ..Rectangle::default()
        });
        model.parts.push(Part { name: format!("strip{strip}"), material: "soft".into(), shape, velocity, ..Part::default() });
    }
    model.output.pictures = false;
    model
}

/// Layers of elements in a slab.
const LAYERS: usize = 10;

/// Two slabs of `n` × `n` × 10 bricks of one point, one on the other, which move against each other at this
/// speed each (m/s). The upper one is shifted along both sides of its bricks by a fraction of one: 0 lets
/// nodes meet nodes. There is no contact yet.
#[must_use]
pub fn slabs(n: usize, speed: f64, shift: f64) -> Model {
    let mut model = Model { run: Run { end: 1.0, ..Run::default() }, ..Model::default() };
    let parameters = [("young", 2e11), ("poisson", 0.3), ("density", 7800.0), ("yield", 3e8), ("hardening", 1e9)];
    let parameters = parameters.map(|(key, value)| (key.to_string(), value));
    model.materials.insert("steel".into(), Material { law: "j2".into(), parameters: parameters.into(), ..Material::default() });
    for (k, name) in ["lower", "upper"].into_iter().enumerate() {
        let [side, height] = [n, LAYERS].map(|count| count as f64 * SIZE);
        let (shift, up) = (shift * SIZE * k as f64, k as f64);
        let shape = Shape::Cuboid(Cuboid {
            corner: [shift, shift, up * height],
            size: [side, side, height],
            elements: [n, n, LAYERS],
            ..Cuboid::default()
        });
        let velocity = [0.0, 0.0, speed * (1.0 - 2.0 * up)];
        model.parts.push(Part {
            name: name.into(),
            material: "steel".into(),
            element: "hex8_reduced".into(),
            shape,
            velocity,
            ..Part::default()
        });
    }
    model.output.pictures = false;
    model
}
