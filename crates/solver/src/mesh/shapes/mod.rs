//! Built-in shapes, one a file: parameters, keys of the model file, mesh, named sides.
//!
//! Values come from the model file or from code; bodies go to the mesh builder. To add a shape: one file with
//! `KEY` and `impl BuiltIn`, and its line in `shapes!`; the model's [`Shape`], the keys, the manual and the
//! contract tests below follow from there.

mod axes;
mod coons;
mod cut;
mod numbers;
mod sheet;
pub(crate) mod sweep;

pub(super) use axes::unit;
pub(super) use numbers::{cos_sin, quarters};
pub use quadrilateral::Edge;
pub use sweep::{Extrude, Revolve, Sweep};

use super::Meshed;
use super::cell::{Cell, CellKind};
use super::messages::UNMESHABLE;
use super::skin::{FACES, SURFACE_FACES};
use super::surface::Facet;
use crate::error::Fault;
use crate::model::{Part, Values};
use crate::quantity::Dimension;
use crate::quantity::Range::Positive;
use crate::tensor::Dim;
use crate::vocabulary::{Form, Group, Key, Kind, Need, Rule, Section, key};
use cut::cut;
use numbers::Steps;
use sheet::Skin;
use std::collections::BTreeMap;

/// The mesh of one body: nodes, elements, and named sides. Elements are numbered kind by kind, those of the
/// last kind first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// Node positions, m.
    pub positions: Vec<[f64; D]>,
    /// Nodes of the elements of each kind, one after the other.
    pub(super) elements: BTreeMap<CellKind, Vec<u32>>,
    /// Named sides as segments with the body on their right, or facets counter-clockwise seen from outside.
    pub sides: Vec<(String, Vec<Facet<D>>)>,
    /// Named sets of nodes that are no sides.
    pub points: Vec<(String, Vec<u32>)>,
}

impl<const D: usize> Body<D>
where
    Dim<D>: Meshed<D>,
{
    /// Each element.
    pub fn cells(&self) -> impl Iterator<Item = Cell<'_>> + Clone {
        self.elements.iter().rev().flat_map(|(kind, nodes)| kind.cells(nodes))
    }

    /// Nodes of each element of a kind that has `N`.
    #[must_use]
    pub fn all<const N: usize>(&self, kind: CellKind) -> &[[u32; N]] {
        debug_assert_eq!(kind.nodes(), N);
        self.elements.get(&kind).map_or(&[], |nodes| nodes.as_chunks().0)
    }

    /// Adds elements of a kind.
    fn add<'c>(&mut self, cells: impl IntoIterator<Item = Cell<'c>>) {
        for cell in cells {
            self.elements.entry(cell.kind).or_default().extend(cell.nodes);
        }
    }

    /// Adds elements of a kind, given their nodes.
    fn extend<const N: usize>(&mut self, kind: CellKind, cells: impl IntoIterator<Item = [u32; N]>) {
        debug_assert_eq!(kind.nodes(), N);
        self.elements.entry(kind).or_default().extend(cells.into_iter().flatten());
    }
}

/// How large a mesh will be. Node numbers are 32 bits wide, so a model asks before it meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// Nodes (saturating at `usize::MAX`).
    pub nodes: usize,
    /// Elements (saturating).
    pub elements: usize,
    /// Whether these are the numbers, or about these.
    pub exact: bool,
}

impl Count {
    /// Of a lattice of so many elements; `closed`: its second direction leads back to where it began.
    fn of_lattice([a, b]: [usize; 2], closed: bool) -> Self {
        let nodes = a.saturating_add(1).saturating_mul(b.saturating_add(usize::from(!closed)));
        Self { nodes, elements: a.saturating_mul(b), exact: true }
    }

    /// So many of these bodies.
    pub(crate) fn times(self, copies: usize) -> Self {
        Self { nodes: self.nodes.saturating_mul(copies), elements: self.elements.saturating_mul(copies), ..self }
    }
}

/// What keeps a shape from being meshed, and at which of its keys (empty: the shape as a whole).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wrong {
    pub(crate) key: &'static str,
    pub(crate) message: String,
    pub(crate) help: String,
}

impl Wrong {
    /// As a fault of the shape with this key.
    pub(crate) fn at(self, shape: &str) -> Fault {
        let dot = if self.key.is_empty() { "" } else { "." };
        Fault::new(&UNMESHABLE, format!("{shape}{dot}{}", self.key), self.message, self.help)
    }

    fn new(key: &'static str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { key, message: message.into(), help: help.into() }
    }
}

/// Checks the values of a shape; keys are those of its table.
pub(crate) trait ShapeCheck {
    /// Reports a fault of the shape at a key.
    fn report(&mut self, key: &str, message: String, help: String);
    /// A number against the range of its key.
    fn number(&mut self, key: &str, value: f64);
    /// A vector that must have a direction.
    fn direction(&mut self, key: &str, value: [f64; 3]);
    /// A name that must be one of these.
    fn known(&mut self, key: &str, what: &str, name: &str, known: &[&str]);
    /// Whole numbers that must be at least one.
    fn counts(&mut self, key: &str, values: &[usize]);
}

impl dyn ShapeCheck + '_ {
    /// A fault of the shape at a key.
    pub(crate) fn fault(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.report(key, message.into(), help.into());
    }

    /// Numbers against the range of their key.
    pub(crate) fn numbers(&mut self, key: &str, values: &[f64]) {
        values.iter().enumerate().for_each(|(k, &value)| self.number(&format!("{key}[{k}]"), value));
    }

    /// A vector against the range of its key.
    pub(crate) fn vector<const N: usize>(&mut self, key: &str, value: [f64; N]) {
        self.numbers(key, &value);
    }

    /// Points; whether all are finite.
    pub(crate) fn points(&mut self, key: &str, points: &[[f64; 2]]) -> bool {
        points.iter().enumerate().for_each(|(k, point)| self.numbers(&format!("{key}[{k}]"), point));
        points.iter().flatten().all(|x| x.is_finite())
    }
}

/// A shape that makes its own mesh, in 2D or 3D.
pub(crate) trait BuiltIn<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// From its table in the model file.
    fn read(values: &dyn Values) -> Self
    where
        Self: Sized;
    /// Reports all faults that need no mesh; ranges of numbers are those of the keys.
    fn check(&self, check: &mut dyn ShapeCheck);
    /// Names of the sides that [`BuiltIn::body`] makes.
    fn sides(&self) -> Vec<String>;
    /// Names of the sets of nodes that [`BuiltIn::body`] makes besides sides.
    fn points(&self) -> Vec<String> {
        Vec::new()
    }
    /// What [`BuiltIn::body`] will make, without making it.
    fn count(&self) -> Count;
    /// The key that decides how many elements there are.
    fn size_key(&self) -> &'static str {
        ELEMENTS
    }
    /// What it is made of.
    fn cell_kind(&self) -> CellKind {
        if D == 2 { CellKind::Quadrilateral } else { CellKind::Hexahedron }
    }
    /// Of a solid: the skin of which a shell can be made, if there is one.
    fn skin(&self) -> Option<Skin> {
        None
    }
    /// The mesh.
    fn body(&self) -> Result<Body<D>, Wrong>;
    /// Shapes for the contract tests, with their areas (m²) or volumes (m³); the larger `n`, the finer.
    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)>
    where
        Self: Sized;
}

/// The registry: one line per shape.
macro_rules! shapes {
    (in the plane: $($module:ident: $shape:ident),*; in space: $($solid_module:ident: $solid:ident),*;) => {
        $(mod $module; pub use $module::$shape;)*
        $(mod $solid_module; pub use $solid_module::$solid;)*

        /// Where the elements of a part come from. Angles in radians, lengths in metres.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape {
            $(#[doc = concat!("See [`", stringify!($shape), "`].")] $shape($shape),)*
            $(#[doc = concat!("See [`", stringify!($solid), "`].")] $solid($solid),)*
            /// A group of an imported mesh.
            Group {
                /// Index into [`crate::model::Model::meshes`].
                mesh: usize,
                /// Name of a group of surfaces (of bars: of lines; of solids: of volumes).
                group: String,
            },
        }

        $(impl From<$shape> for Shape {
            fn from(shape: $shape) -> Self {
                Self::$shape(shape)
            }
        })*

        $(impl From<$solid> for Shape {
            fn from(shape: $solid) -> Self {
                Self::$solid(shape)
            }
        })*

        impl Shape {
            /// The built-in shape in 2D, and the key of a part that has its table; `None` for all
            /// others.
            pub(crate) fn built_in(&self) -> Option<(&dyn BuiltIn<2>, &'static str)> {
                match self {
                    $(Self::$shape(shape) => Some((shape, $module::KEY.name)),)*
                    $(Self::$solid(_) => None,)*
                    Self::Group { .. } => None,
                }
            }

            /// The built-in shape in 3D, and the key of a part that has its table; `None` for all others.
            pub(crate) fn solid(&self) -> Option<(&dyn BuiltIn<3>, &'static str)> {
                match self {
                    $(Self::$solid(shape) => Some((shape, $solid_module::KEY.name)),)*
                    _ => None,
                }
            }

            /// Whether a key of a part says that it is a solid: a solid shape, or what makes one of a shape
            /// in 2D.
            #[must_use]
            pub fn is_solid_key(name: &str) -> bool {
                ["extrude", "revolve", $($solid_module::KEY.name),*].contains(&name)
            }

            /// The built-in shape that a key of a part stands for.
            #[must_use]
            pub fn read(name: &str, values: &dyn Values) -> Option<Self> {
                $(if name == $module::KEY.name {
                    return Some($shape::read(values).into());
                })*
                $(if name == $solid_module::KEY.name {
                    return Some($solid::read(values).into());
                })*
                None
            }

            #[cfg(test)]
            fn solid_examples(n: usize) -> Vec<(Self, f64)> {
                let mut all = Vec::new();
                $(all.extend($solid::examples(n).into_iter().map(|(shape, volume)| (Self::from(shape), volume)));)*
                all
            }

            #[cfg(test)]
            fn examples(n: usize) -> Vec<(Self, f64)> {
                let mut all = Vec::new();
                $(all.extend($shape::examples(n).into_iter().map(|(shape, area)| (Self::from(shape), area)));)*
                all
            }
        }

        /// The keys of a part of which exactly one says where its elements come from.
        pub(crate) static SHAPES: Group = Group {
            title: "Shapes",
            doc: "Where the elements of a part come from.",
            keys: &[$($module::KEY,)* $($solid_module::KEY,)* MESH],
            rules: &[Rule::OneOf(&[$($module::KEY.name,)* $($solid_module::KEY.name,)* MESH.name])],
        };
    };
}

shapes!(
    in the plane:
        rectangle: Rectangle,
        ring: Ring,
        disk: Disk,
        trapezoid: Trapezoid,
        quadrilateral: Quadrilateral,
        polygon: Polygon,
        path: Path,
        truss: Truss,
        line: Line,
        arc: CircularArc;
    in space:
        cuboid: Cuboid,
        cylinder: Cylinder,
        tube: Tube,
        sphere: Sphere,
        space_truss: SpaceTruss;
);

impl Shape {
    /// Names of the sides, then of the sets of nodes, that `part.side` can mean.
    #[must_use]
    pub fn sides(&self) -> Vec<String> {
        let plane = self.built_in().map(|(shape, _)| (shape.sides(), shape.points()));
        let (sides, points) = plane.or_else(|| self.solid().map(|(shape, _)| (shape.sides(), shape.points()))).unwrap_or_default();
        sides.into_iter().chain(points).collect()
    }

    /// What a built-in shape is made of; `None` for a group of a mesh file.
    pub(crate) fn cell_kind(&self) -> Option<CellKind> {
        self.built_in().map(|(shape, _)| shape.cell_kind()).or_else(|| self.solid().map(|(shape, _)| shape.cell_kind()))
    }

    /// The group that it is of a mesh file's.
    pub(crate) fn group_of(&self, file: usize) -> Option<&str> {
        match self {
            Self::Group { mesh, group } if *mesh == file => Some(group),
            _ => None,
        }
    }

    /// Path, from the part on, of what decides how many elements there are.
    #[must_use]
    pub fn size_path(&self) -> String {
        let plane = self.built_in().map(|(shape, key)| format!("{key}.{}", shape.size_key()));
        let either = plane.or_else(|| self.solid().map(|(shape, key)| format!("{key}.{}", shape.size_key())));
        either.unwrap_or_else(|| "mesh.group".to_string())
    }

    /// How large the mesh of a built-in shape will be; `None` for a group of an imported mesh.
    #[must_use]
    pub fn count(&self) -> Option<Count> {
        self.built_in().map(|(shape, _)| shape.count()).or_else(|| self.solid().map(|(shape, _)| shape.count()))
    }
}

impl Part {
    /// How large its mesh will be, where it has a built-in shape.
    #[must_use]
    pub fn count(&self) -> Option<Count> {
        let skin = self.shape.solid().filter(|_| self.is_of_sheets()).and_then(|(shape, _)| shape.skin());
        let shape = skin.map(|skin| skin.count).or_else(|| self.shape.count())?;
        let one = self.sweep.as_ref().map_or(shape, |sweep| sweep.count(shape));
        Some(one.times(self.placement.count()))
    }

    /// Its body in 2D, placed; `None` for a group of a mesh file.
    pub(super) fn plane_body(&self) -> Option<Result<Body<2>, Fault>> {
        let (shape, key) = self.shape.built_in()?;
        Some(shape.body().map(|body| self.placement.applied(body)).map_err(|wrong| wrong.at(key)))
    }

    /// Its body in 3D, placed; `None` for a group of a mesh file.
    pub(super) fn solid_body(&self) -> Option<Result<Body<3>, Fault>> {
        let body = if self.is_of_sheets() {
            self.sheet()?
        } else if let Some((shape, key)) = self.shape.solid() {
            shape.body().map_err(|wrong| wrong.at(key))
        } else {
            let (shape, key) = self.shape.built_in()?;
            let sweep = self.sweep.as_ref()?;
            shape.body().map_err(|wrong| wrong.at(key)).and_then(|body| sweep.swept(&body).map_err(|wrong| wrong.at(sweep.key())))
        };
        Some(body.map(|body| self.placement.applied(body)))
    }

    /// Names of the sides, then of the sets of nodes, that `part.side` can mean.
    #[must_use]
    pub fn sides(&self) -> Vec<String> {
        let swept = self.sweep.as_ref().map_or(Vec::new(), Sweep::sides);
        let faces = match self {
            part if part.is_of_sheets() => &SURFACE_FACES[..],
            part if part.is_of_shells() => &FACES,
            _ => &[],
        };
        self.shape.sides().into_iter().chain(swept).chain(faces.iter().map(|face| (*face).to_string())).collect()
    }

    /// What its built-in shape is made of, away from an axis that it is turned about; `None` for a group of a
    /// mesh file, for bars that are swept, and for shapes of which no shell in 3D can be that is one.
    pub(crate) fn cell_kind(&self) -> Option<CellKind> {
        let kind = self.shape.cell_kind()?;
        let is_solid = self.shape.solid().is_some();
        if self.is_of_sheets() {
            let made = if is_solid || self.sweep.is_some() { CellKind::Quadrilateral } else { kind };
            return self.makes_sheet().then_some(made);
        }
        if self.sweep.is_some() && !is_solid { kind.facts().extruded } else { Some(kind) }
    }
}

/// The key that decides how many elements most shapes have.
const ELEMENTS: &str = "elements";

/// Geometric growth of the elements.
const GRADING: Key = key(
    "grading",
    Kind::Vector(Dimension::NONE, Positive),
    Need::Default("[1, 1]"),
    "Length of the last element over that of the first, in the directions of `elements`; they grow by equal factors.",
);

const fn shape_key(name: &'static str, section: &'static Section, doc: &'static str) -> Key {
    key(name, Kind::Table(section), Need::Optional("another shape"), doc)
}

const MESH: Key = shape_key("mesh", &MESH_SECTION, "A group of a mesh file.");

static MESH_SECTION: Section = Section {
    name: "mesh",
    doc: "A group of a mesh file (Gmsh `.msh` 2.2 or 4.1, 3D if it has a group of volumes, or a part is made of its surfaces as a shell with `shell4`; Abaqus or CalculiX \
        `.inp`; STL `.stl` for a shell of triangles, `shell3`), triangles, wedges and tetrahedra too. Its other groups can be named in contacts, constraints \
        and probes, as `group` or `part.group`. Parts of one file that are mirrored, turned, moved and copied alike share its nodes; those of different places do not.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("file", Kind::Text, Need::Required, "Path of the file, from the model file's folder."),
        key(
            "group",
            Kind::Text,
            Need::Required,
            "Name of a physical group of surfaces (of solids of volumes, of bars, beams and of shells in 2D of lines), or of an element set; of an STL file `all`, \
            and its open edges are the group `rim`.",
        ),
        key(
            "scale",
            Kind::Quantity(Dimension::LENGTH, Positive),
            Need::Default("\"1 m\""),
            "Length of one unit of the file, such as `\"1 mm\"`: its unit, or a scale.",
        ),
        key(
            "tolerance",
            Kind::Quantity(Dimension::LENGTH, Positive),
            Need::Optional("a millionth of its extent"),
            "Distance within which corners of the triangles of an STL file are one node.",
        ),
    ],
    ..Section::EMPTY
};

/// A body of `elements` quadrilaterals between the points `at(i, j)`, of which those with i + 1 lie on the
/// right of those with j + 1. `closed`: the last row is the first. Nodes run along i first. Sides at the
/// lowest and highest i, then at the lowest and highest j.
fn lattice(elements: [usize; 2], closed: bool, sides: [&str; 4], at: impl Fn(usize, usize) -> [f64; 2]) -> Body<2> {
    let [nx, ny] = elements;
    let row = nx + 1;
    let rows = if closed { ny } else { ny + 1 };
    let number = |i: usize, j: usize| node(if closed && j == ny { i } else { j * row + i });
    let mut body = Body::default();
    for j in 0..rows {
        body.positions.extend((0..=nx).map(|i| at(i, j)));
    }
    for j in 0..ny {
        body.extend(CellKind::Quadrilateral, (0..nx).map(|i| [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]));
    }
    let mut side = |name: &str, segments| body.sides.push((name.to_string(), segments));
    side(sides[0], (0..ny).map(|j| [number(0, j), number(0, j + 1)]).collect());
    side(sides[1], (0..ny).rev().map(|j| [number(nx, j + 1), number(nx, j)]).collect());
    if !closed {
        side(sides[2], (0..nx).rev().map(|i| [number(i + 1, 0), number(i, 0)]).collect());
        side(sides[3], (0..nx).map(|i| [number(i, ny), number(i + 1, ny)]).collect());
    }
    body
}

/// Where a body of quadrilaterals folds over: the first element with a corner that does not turn
/// counter-clockwise, and the place.
fn fold(body: &Body<2>) -> Option<(usize, [f64; 2])> {
    let turns = |quad: &[u32; 4], k: usize| {
        let x = |k: usize| body.positions[quad[k % 4] as usize];
        numbers::cross(numbers::minus(x(k + 1), x(k)), numbers::minus(x(k + 3), x(k))) > 0.0
    };
    let (element, quad) = body.all::<4>(CellKind::Quadrilateral).iter().enumerate().find(|(_, quad)| !(0..4).all(|k| turns(quad, k)))?;
    Some((element, body.positions[quad[0] as usize]))
}

/// A body of quadrilaterals that must not fold; `help` says what to do about it.
fn unfolded(body: Body<2>, help: &str) -> Result<Body<2>, Wrong> {
    match fold(&body) {
        None => Ok(body),
        Some((element, [x, y])) => Err(Wrong::new("", format!("the mesh folds over at ({x:.6e}, {y:.6e}) m, in element {element}"), help)),
    }
}

/// What [`chain`] makes.
fn chain_count(elements: usize, closed: bool) -> Count {
    Count { nodes: elements.saturating_add(usize::from(!closed)), elements, exact: true }
}

/// Names of the ends of a [`chain`].
fn chain_ends(closed: bool) -> Vec<String> {
    if closed { Vec::new() } else { ["start", "end"].map(String::from).to_vec() }
}

/// Lines one after the other through `at` each of their ends; `start` and `end` of one that does not close.
fn chain(elements: usize, closed: bool, at: impl Fn(usize) -> [f64; 2]) -> Body<2> {
    let count = if closed { elements } else { elements + 1 };
    let mut body = Body { positions: (0..count).map(at).collect(), ..Body::default() };
    body.extend(CellKind::Line, (0..elements).map(|j| [node(j), node((j + 1) % count)]));
    if !closed {
        body.points = vec![("start".to_string(), vec![0]), ("end".to_string(), vec![node(elements)])];
    }
    body
}

fn node(index: usize) -> u32 {
    u32::try_from(index).expect("the model has limited the number of nodes to 32 bits (Shape::count)")
}

#[cfg(test)]
pub(crate) fn rectangle(corner: [f64; 2], size: [f64; 2], elements: [usize; 2]) -> Body<2> {
    Rectangle { corner, size, elements, ..Rectangle::default() }.body().expect("a rectangle never fails")
}

#[cfg(test)]
pub(crate) fn ring(centre: [f64; 2], inner: f64, outer: f64, from: f64, to: f64, elements: [usize; 2]) -> Body<2> {
    Ring { centre, inner, outer, from, to, elements, ..Ring::default() }.body().expect("a ring never fails")
}

#[cfg(test)]
pub(crate) fn disk(centre: [f64; 2], radius: f64, elements: usize) -> Body<2> {
    Disk { centre, radius, elements }.body().expect("a disk never fails")
}

#[cfg(test)]
mod solids;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::surface::exterior;

    pub(super) fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        numbers::minus(a, b)
    }
    pub(super) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
        numbers::cross(a, b)
    }

    fn jacobians(body: &Body<2>) -> impl Iterator<Item = f64> + '_ {
        body.cells().flat_map(|cell| {
            let x: Vec<[f64; 2]> = cell.nodes.iter().map(|&n| body.positions[n as usize]).collect();
            let n = x.len();
            (0..n).map(move |k| cross(minus(x[(k + 1) % n], x[k]), minus(x[(k + n - 1) % n], x[k])))
        })
    }

    /// Area, ∫x², ∫y² and ∫xy, exact for the polygons (triangle formula).
    pub(super) fn moments(body: &Body<2>) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for cell in body.cells() {
            for t in 1..cell.nodes.len() - 1 {
                let [p, q, r] = [0, t, t + 1].map(|k| body.positions[cell.nodes[k] as usize]);
                let area = 0.5 * cross(minus(q, p), minus(r, p));
                let product = |i: usize, j: usize| {
                    let (s, t) = (p[i] + q[i] + r[i], p[j] + q[j] + r[j]);
                    area / 12.0 * (s * t + p[i] * p[j] + q[i] * q[j] + r[i] * r[j])
                };
                let more = [area, product(0, 0), product(1, 1), product(0, 1)];
                for (s, m) in sum.iter_mut().zip(more) {
                    *s += m;
                }
            }
        }
        sum
    }

    pub(super) fn is_its_mirror_image(body: &Body<2>) {
        let mut ours = body.positions.clone();
        let mut mirrored: Vec<_> = ours.iter().map(|&[x, y]| [x, 0.0 - y]).collect();
        let order = |a: &[f64; 2], b: &[f64; 2]| a.partial_cmp(b).unwrap();
        ours.sort_by(order);
        mirrored.sort_by(order);
        assert_eq!(ours, mirrored);
    }

    fn body(shape: &Shape) -> Body<2> {
        let made = shape.built_in().unwrap().0.body();
        made.unwrap_or_else(|wrong| panic!("{shape:?}: {wrong:?}"))
    }

    fn every_shape() -> Vec<Shape> {
        [2, 3, 4, 7, 12, 33].iter().flat_map(|&n| Shape::examples(n)).map(|(shape, _)| shape).collect()
    }

    #[test]
    fn every_corner_of_every_shape_has_a_positive_jacobian() {
        for shape in every_shape() {
            let body = body(&shape);
            assert!(body.cells().count() > 0);
            assert!(jacobians(&body).all(|j| j > 0.0), "{shape:?}");
            assert!(body.cells().all(|cell| Some(cell.kind) == shape.cell_kind()));
        }
    }

    #[test]
    fn the_sides_of_every_shape_cover_its_outside_with_the_body_on_the_right_and_have_the_promised_names_and_counts() {
        for shape in every_shape() {
            let body = body(&shape);
            let mut of_sides: Vec<_> = body.sides.iter().flat_map(|(_, segments)| segments.iter().copied()).collect();
            let mut of_cells = exterior::<2>(body.cells()).unwrap();
            of_sides.sort_unstable();
            of_sides.dedup(); // a side may be a part of another
            of_cells.sort_unstable();
            assert_eq!(of_sides, of_cells, "{shape:?}");
            for (name, segments) in &body.sides {
                assert!(segments.windows(2).all(|pair| pair[0][1] == pair[1][0]), "the segments of {name} follow each other: {shape:?}");
            }
            let names: Vec<_> = body.sides.iter().map(|side| side.0.clone()).collect();
            assert_eq!(names, shape.sides());
            let (count, made) = (shape.count().unwrap(), [body.positions.len(), body.cells().count()]);
            if count.exact {
                assert_eq!([count.nodes, count.elements], made, "{shape:?}");
            } else {
                let about = |count: usize, made: usize| made <= 2 * count && count <= 10 * made;
                assert!(about(count.nodes, made[0]) && about(count.elements, made[1]), "{count:?} {made:?} {shape:?}");
            }
            let mut used: Vec<u32> = body.cells().flat_map(|cell| cell.nodes).copied().collect();
            used.sort_unstable();
            used.dedup();
            assert_eq!(used.len(), body.positions.len(), "every node is used");
        }
    }

    #[test]
    fn the_area_of_every_shape_is_exact_or_converges_with_the_square_of_the_element_size() {
        let errors =
            |n| -> Vec<f64> { Shape::examples(n).iter().map(|(shape, area)| (moments(&body(shape))[0] / area - 1.0).abs()).collect() };
        for ((coarse, fine), (shape, _)) in errors(12).into_iter().zip(errors(24)).zip(Shape::examples(24)) {
            assert!(fine < 1e-12 || (fine < 0.02 && (3.0..5.5).contains(&(coarse / fine))), "{coarse} {fine} {shape:?}");
        }
    }

    #[test]
    fn a_group_of_a_file_is_no_built_in_shape() {
        let group = Shape::Group { mesh: 0, group: "tube".into() };
        assert_eq!((group.built_in().is_none(), group.sides().len(), group.count()), (true, 0, None));
    }

    #[test]
    fn the_sides_of_a_rectangle_lie_where_their_names_say() {
        let body = rectangle([1.0, 2.0], [3.0, 0.5], [6, 2]);
        for (name, d, value) in [("left", 0, 1.0), ("right", 0, 4.0), ("bottom", 1, 2.0), ("top", 1, 2.5)] {
            let side = &body.sides.iter().find(|s| s.0 == name).unwrap().1;
            assert!(side.iter().flatten().all(|&n| body.positions[n as usize][d] == value), "{name}");
        }
    }
}
