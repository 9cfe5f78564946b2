//! What makes a body in 3D from a shape in 2D: it is pulled along z, or turned about a line of the
//! plane.
//!
//! Sections come from the shapes and mesh files; bodies of hexahedra, wedges and tetrahedra go back to where
//! the section would have gone, and of lines sheets of quadrilaterals and triangles.

use super::numbers::{Steps, cos_sin, dot, minus, quarters};
use super::{Body, Count, ELEMENTS, Values, Wrong};
use crate::mesh::cell::{Cell, CellKind};
use crate::mesh::sorted;
use crate::mesh::surface::Corners;
use crate::model::{ImportedMesh, MeshGroup};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive, UpTo};
use crate::vocabulary::Kind::{Angle, Integer, Quantity, Vector};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Section, key};
use std::f64::consts::TAU;

/// What becomes of a cell of the section in a layer.
type Made<'a> = dyn Fn(Cell<'_>, usize) -> Option<Vec<u32>> + 'a;

/// How a section in the plane z = 0 becomes a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Sweep {
    /// See [`Extrude`].
    Extrude(Extrude),
    /// See [`Revolve`].
    Revolve(Revolve),
}

/// The section is pulled along z: quadrilaterals become hexahedra, triangles become wedges.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrude {
    /// z of the section that becomes the side `back`, m.
    pub from: f64,
    /// Distance to that which becomes `front`, m.
    pub length: f64,
    /// Elements along z.
    pub elements: usize,
    /// Length of the last element over that of the first.
    pub grading: f64,
}

impl Default for Extrude {
    fn default() -> Self {
        Self { from: 0.0, length: 1.0, elements: 1, grading: 1.0 }
    }
}

/// The section is turned about a line of its plane, towards z first. Where it has an edge on the line,
/// quadrilaterals become wedges and triangles tetrahedra.
#[derive(Clone, Debug, PartialEq)]
pub struct Revolve {
    /// Direction of the line, of any length but zero.
    pub axis: [f64; 2],
    /// A point of the line, m.
    pub point: [f64; 2],
    /// Angle, rad, at most a full turn.
    pub angle: f64,
    /// Elements around.
    pub elements: usize,
}

impl Default for Revolve {
    fn default() -> Self {
        Self { axis: [0.0, 1.0], point: [0.0; 2], angle: TAU, elements: 4 }
    }
}

pub(crate) static EXTRUDE: Section = Section {
    name: "extrude",
    doc: "The 2D shape becomes a solid: it is extruded along z. Quadrilaterals become hexahedra, triangles become \
        wedges. Its sides keep their names; the section at `from` is the side `back`, the other end `front`. Lines \
        become a shell of quadrilaterals (`shell4`), whose face `upper` is on the right of who walks along them; its \
        edges are sets of nodes with these names.",
    keys: &[
        key("length", Quantity(Dimension::LENGTH, Positive), Required, "Length along z."),
        key(ELEMENTS, Integer(1), Required, "Elements along z."),
        key("from", Quantity(Dimension::LENGTH, Finite), Written("0"), "z at which it begins."),
        key("grading", Quantity(Dimension::NONE, Positive), Written("1"), "Length of the last element over that of the first."),
    ],
    ..Section::EMPTY
};

pub(crate) static REVOLVE: Section = Section {
    name: "revolve",
    doc: "The 2D shape becomes a solid: it is revolved about a line of the x-y plane, towards z first. Where it has \
        an edge on the line, quadrilaterals become wedges and triangles tetrahedra. Its sides keep their names; \
        unless it is turned all around, the section as it is drawn is the side `back`, the other end `front`. Lines \
        become a shell (`shell4`) as by `extrude`, of triangles where they end on the line.",
    keys: &[
        key("angle", Angle(Dimension::NONE, UpTo(0.0, TAU + 1e-9)), Written("\"360 deg\""), "Angle by which it is turned."),
        key(ELEMENTS, Integer(1), Required, "Elements around; at least 3 all around."),
        key("axis", Vector(Dimension::NONE, Finite), Written("[0, 1]"), "Direction of the line; any length but zero."),
        key("point", Vector(Dimension::LENGTH, Finite), Written("[0, 0]"), "A point of the line; the shape lies on one side of it."),
    ],
    ..Section::EMPTY
};

/// The sections of a swept body: where the nodes of each are, and which number they have.
struct Layers<'p> {
    section: &'p [[f64; 2]],
    elements: usize,
    /// Whether the last section is the first.
    closed: bool,
    /// Of each node of the section its number among those that move; [`FIXED`] on the axis.
    rank: Vec<u32>,
    moving: u32,
}

/// What becomes of a line on the axis.
const NO_SURFACE: &str = "lies on the axis, where it becomes no surface";

/// Of a node that stays where it is.
const FIXED: u32 = u32::MAX;

impl Layers<'_> {
    /// Number of a node in a section: the first one has all nodes in their order, the others those that move.
    fn number(&self, node: u32, layer: usize) -> u32 {
        let (layer, rank) = (if self.closed { layer % self.elements } else { layer }, self.rank[node as usize]);
        if layer == 0 || rank == FIXED { node } else { self.section.len() as u32 + (layer as u32 - 1) * self.moving + rank }
    }

    fn is_fixed(&self, node: u32) -> bool {
        self.rank[node as usize] == FIXED
    }

    /// Positions of all sections, given where `at` puts a node of the section.
    fn positions(&self, at: impl Fn(usize, usize) -> [f64; 3]) -> Vec<[f64; 3]> {
        let sections = if self.closed { self.elements } else { self.elements + 1 };
        let mut positions: Vec<[f64; 3]> = (0..self.section.len()).map(|node| at(node, 0)).collect();
        for layer in 1..sections {
            positions.extend((0..self.section.len()).filter(|&node| self.rank[node] != FIXED).map(|node| at(node, layer)));
        }
        positions
    }

    /// The element between a section and the next that a cell of the section becomes; what it is that the
    /// axis does not allow.
    fn cell(&self, Cell { kind, nodes }: Cell<'_>, layer: usize) -> Result<(CellKind, Vec<u32>), &'static str> {
        let n = kind.nodes();
        let here = |k: usize| self.number(nodes[k % n], layer);
        let next = |k: usize| self.number(nodes[k % n], layer + 1);
        let fixed = |k: usize| self.is_fixed(nodes[k % n]);
        let on_axis = (0..n).filter(|&k| fixed(k)).count();
        match (on_axis, kind, kind.facts().extruded) {
            (0, _, Some(extruded)) => Ok((extruded, (0..n).map(here).chain((0..n).map(next)).collect())),
            (1, ..) => Err("has one corner on the axis: it would become a body for which there is no element"),
            (2, CellKind::Triangle, _) if let Some(k) = self.side_on_axis(nodes) => {
                Ok((CellKind::Tetrahedron, vec![here(k), here(k + 1), here(k + 2), next(k + 2)]))
            }
            (2, CellKind::Quadrilateral, _) if let Some(k) = self.side_on_axis(nodes) => {
                Ok((CellKind::Wedge, vec![here(k), here(k + 3), next(k + 3), here(k + 1), here(k + 2), next(k + 2)]))
            }
            _ => Err("has corners on the axis that are no side: it would become a body for which there is no element"),
        }
    }

    /// The corner at which a side on the axis begins.
    fn side_on_axis(&self, corners: &[u32]) -> Option<usize> {
        let n = corners.len();
        (0..n).find(|&k| self.is_fixed(corners[k]) && self.is_fixed(corners[(k + 1) % n]))
    }

    /// The facet between a section and the next that a segment with the body on its right becomes; none on
    /// the axis.
    fn facet(&self, [a, b]: [u32; 2], layer: usize) -> Option<[u32; 4]> {
        let here = |node| self.number(node, layer);
        let next = |node| self.number(node, layer + 1);
        match (self.is_fixed(a), self.is_fixed(b)) {
            (false, false) => Some([here(b), here(a), next(a), next(b)]),
            (true, false) => Some([here(b), here(a), next(b), next(b)]),
            (false, true) => Some([here(b), here(a), next(a), next(a)]),
            (true, true) => None,
        }
    }

    /// The quadrilateral between a section and the next that a line becomes, on the right of who walks along
    /// it; a triangle (its last node twice) where one end is on the axis, nothing where both are.
    fn strip(&self, [a, b]: [u32; 2], layer: usize) -> Option<[u32; 4]> {
        self.facet([b, a], layer)
    }

    /// All nodes of the first and of the last section that nodes become, ascending.
    fn end_columns(&self, nodes: impl Iterator<Item = u32> + Clone) -> [Vec<u32>; 2] {
        [0, self.elements].map(|layer| sorted(nodes.clone().map(|node| self.number(node, layer))))
    }

    /// Cells of the first and of the last section as facets counter-clockwise seen from outside.
    fn ends<'c>(&self, cells: impl Iterator<Item = Cell<'c>> + Clone) -> [Vec<[u32; 4]>; 2] {
        let facet = |nodes: Vec<u32>| std::array::from_fn(|k| nodes[k.min(nodes.len() - 1)]);
        let back = cells.clone().map(|cell| facet(cell.corners().iter().rev().map(|&node| self.number(node, 0)).collect()));
        let front = cells.map(|cell| facet(cell.corners().iter().map(|&node| self.number(node, self.elements)).collect()));
        [back.collect(), front.collect()]
    }
}

impl Sweep {
    /// The key of a part that has its table.
    pub(crate) fn key(&self) -> &'static str {
        match self {
            Self::Extrude(_) => EXTRUDE.name,
            Self::Revolve(_) => REVOLVE.name,
        }
    }

    /// From its table in the model file.
    #[must_use]
    pub fn read(name: &str, values: &dyn Values) -> Option<Self> {
        let number = |key| -> f64 { values.get(key) };
        if name == EXTRUDE.name {
            let (from, length, grading) = (number("from"), number("length"), number("grading"));
            return Some(Self::Extrude(Extrude { from, length, elements: values.get(ELEMENTS), grading }));
        }
        let turned = || {
            let (axis, point) = (values.get("axis"), values.get("point"));
            Self::Revolve(Revolve { axis, point, angle: number("angle"), elements: values.get(ELEMENTS) })
        };
        (name == REVOLVE.name).then(turned)
    }

    /// Elements from the first section to the last.
    fn elements(&self) -> usize {
        match self {
            Self::Extrude(it) => it.elements,
            Self::Revolve(it) => it.elements,
        }
    }

    /// Whether the last section is the first.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        matches!(self, Self::Revolve(it) if it.angle >= TAU - 1e-9)
    }

    /// Names of the sides that a sweep adds to those of the section.
    #[must_use]
    pub fn sides(&self) -> Vec<String> {
        let ends: &[&str] = if self.is_closed() { &[] } else { &["back", "front"] };
        ends.iter().map(|&end| end.to_string()).collect()
    }

    /// How large a body will be whose section is so large; nodes on an axis are counted as often as there are
    /// sections.
    #[must_use]
    pub fn count(&self, section: Count) -> Count {
        let sections = self.elements().saturating_add(usize::from(!self.is_closed()));
        Count {
            nodes: section.nodes.saturating_mul(sections),
            elements: section.elements.saturating_mul(self.elements()),
            exact: section.exact && matches!(self, Self::Extrude(_)),
        }
    }

    /// The line, as a point and the direction from it to the body; `None` where there is no such.
    fn outwards(&self, positions: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
        let Self::Revolve(Revolve { axis: [x, y], point, .. }) = *self else { return None };
        let length = (x * x + y * y).sqrt();
        let normal = [y / length, (0.0 - x) / length];
        let far =
            positions.iter().map(|&x| dot(minus(x, point), normal)).fold(0.0, |far: f64, d| if d.abs() > far.abs() { d } else { far });
        if far > 0.0 {
            Some([point, normal])
        } else if far < 0.0 {
            Some([point, normal.map(|n| 0.0 - n)])
        } else {
            None
        }
    }

    /// The sections of a body, and where their nodes are.
    fn layers<'p>(&self, section: &'p [[f64; 2]]) -> Result<(Layers<'p>, Vec<[f64; 3]>), Wrong> {
        let mut layers = Layers { section, elements: self.elements(), closed: self.is_closed(), rank: Vec::new(), moving: 0 };
        let mut count = 0..;
        match self {
            Self::Extrude(it) => {
                layers.rank = count.by_ref().take(section.len()).collect();
                layers.moving = section.len() as u32;
                let steps = Steps::new(it.elements, it.grading);
                let z: Vec<f64> = (0..=it.elements).map(|layer| steps.between(it.from, it.from + it.length, layer)).collect();
                let positions = layers.positions(|node, layer| [section[node][0], section[node][1], z[layer]]);
                Ok((layers, positions))
            }
            Self::Revolve(it) => {
                let Some([point, normal]) = self.outwards(section) else {
                    return Err(Wrong::new("axis", "the shape has no extent away from the axis", "give another `axis` or `point`"));
                };
                let distances: Vec<f64> = section.iter().map(|&x| dot(minus(x, point), normal)).collect();
                let near = 1e-9 * distances.iter().copied().fold(0.0, f64::max);
                if let Some(node) = distances.iter().position(|&d| d < -near) {
                    let [x, y] = section[node];
                    let message = format!("the shape lies on both sides of the axis: at ({x:.6e}, {y:.6e}) m, too");
                    return Err(Wrong::new("axis", message, "move the shape or the axis"));
                }
                layers.rank = distances.iter().map(|&d| if d <= near { FIXED } else { count.next().unwrap_or(FIXED) }).collect();
                layers.moving = layers.rank.iter().filter(|rank| **rank != FIXED).count() as u32;
                let whole = if layers.closed { 4.0 } else { quarters(it.angle) };
                let steps = Steps::new(it.elements, 1.0);
                let turns: Vec<[f64; 2]> = (0..=it.elements).map(|layer| cos_sin(steps.between(0.0, whole, layer))).collect();
                let positions = layers.positions(|node, layer| {
                    let ([x, y], d, [c, s]) = (section[node], distances[node], turns[layer]);
                    if layers.rank[node] == FIXED {
                        [x - d * normal[0], y - d * normal[1], 0.0]
                    } else if layer == 0 {
                        [x, y, 0.0]
                    } else {
                        [x + d * (c - 1.0) * normal[0], y + d * (c - 1.0) * normal[1], d * s]
                    }
                });
                Ok((layers, positions))
            }
        }
    }

    /// The body that a section becomes.
    pub(crate) fn swept(&self, section: &Body<2>) -> Result<Body<3>, Wrong> {
        let (layers, positions) = self.layers(&section.positions)?;
        let mut body = Body { positions, ..Body::default() };
        for layer in 0..layers.elements {
            for cell in section.cells() {
                let swept = layers.cell(cell, layer).map_err(|message| axis_touched(&section.positions, cell, message))?;
                body.add([swept.0.cell(&swept.1)]);
            }
        }
        let between = 0..layers.elements;
        for (name, segments) in &section.sides {
            let facets =
                segments.iter().flat_map(|&segment| between.clone().filter_map(|layer| layers.facet(segment, layer)).collect::<Vec<_>>());
            body.sides.push((name.clone(), facets.collect()));
        }
        for (name, facets) in self.sides().into_iter().zip(layers.ends(section.cells())) {
            body.sides.push((name, facets));
        }
        for (name, nodes) in &section.points {
            body.points.push((name.clone(), layers.columns(nodes)));
        }
        Ok(body)
    }

    /// The sheet that lines become; their ends, and the first and the last section, are sets of nodes.
    pub(crate) fn sheet(&self, lines: &Body<2>) -> Result<Body<3>, Wrong> {
        let (layers, positions) = self.layers(&lines.positions)?;
        let mut body = Body { positions, ..Body::default() };
        for layer in 0..layers.elements {
            for cell in lines.cells() {
                let strip = layers.strip([cell.nodes[0], cell.nodes[1]], layer);
                let strip = strip.ok_or_else(|| axis_touched(&lines.positions, cell, NO_SURFACE))?;
                body.add(Cell::of(2, strip.corners()));
            }
        }
        body.points = lines.points.iter().map(|(name, nodes)| (name.clone(), layers.columns(nodes))).collect();
        body.points.extend(self.sides().into_iter().zip(layers.end_columns(0..lines.positions.len() as u32)));
        Ok(body)
    }

    /// The mesh that a mesh in 2D becomes: groups of surfaces become volumes, of lines surfaces (on the right
    /// of who walks along them where a part is made of them), of points sets of nodes. Nodes that groups
    /// share, they still share. With it the two ends of each group of surfaces, by its place among the
    /// groups.
    pub(in crate::mesh) fn swept_mesh(&self, section: &ImportedMesh, wanted: &[&str]) -> Result<SweptMesh, Wrong> {
        let plane: Vec<[f64; 2]> = section.positions.iter().map(|&[x, y, _]| [x, y]).collect();
        let (layers, positions) = self.layers(&plane)?;
        let mut swept = SweptMesh {
            mesh: ImportedMesh { source: section.source.clone(), positions, groups: Vec::new(), ..ImportedMesh::default() },
            ..SweptMesh::default()
        };
        for group in &section.groups {
            let cells = || group.elements().flatten().map(Cell::of_corners);
            let each = |make: &Made| -> Vec<Vec<u32>> {
                (0..layers.elements).flat_map(|layer| cells().filter_map(|cell| make(cell, layer)).collect::<Vec<_>>()).collect()
            };
            let (dimension, cells) = match group.dimension {
                2 if wanted.contains(&group.name.as_str()) => {
                    swept.ends.push((group.name.clone(), layers.ends(cells())));
                    let touched = |cell: Cell<'_>| layers.cell(cell, 0).map_err(|message| axis_touched(&plane, cell, message)).map(|_| ());
                    cells().try_for_each(touched)?;
                    (3, each(&|cell, layer| layers.cell(cell, layer).ok().map(|(_, nodes)| nodes)))
                }
                1 if wanted.contains(&group.name.as_str()) => {
                    let nodes: Vec<u32> = group.cells.concat();
                    swept.rims.push((group.name.clone(), layers.end_columns(nodes.into_iter())));
                    let strip = |cell: Cell<'_>, layer| layers.strip([cell.nodes[0], cell.nodes[1]], layer);
                    if let Some(cell) = cells().find(|&cell| strip(cell, 0).is_none()) {
                        return Err(axis_touched(&plane, cell, NO_SURFACE));
                    }
                    (2, each(&|cell, layer| Some(strip(cell, layer)?.corners().to_vec())))
                }
                1 => (2, each(&|cell, layer| Some(layers.facet([cell.nodes[0], cell.nodes[1]], layer)?.corners().to_vec()))),
                _ => (0, layers.columns(&group.cells.concat()).into_iter().map(|node| vec![node]).collect()),
            };
            swept.mesh.groups.push(MeshGroup { name: group.name.clone(), dimension, cells });
        }
        Ok(swept)
    }
}

/// A mesh in 3D that came from one in 2D.
#[derive(Default)]
pub(in crate::mesh) struct SweptMesh {
    pub(in crate::mesh) mesh: ImportedMesh,
    /// Facets at the two ends of each group of volumes, by its name.
    pub(in crate::mesh) ends: Vec<(String, [Vec<[u32; 4]>; 2])>,
    /// Nodes at the two ends of each group of lines that became a sheet, by its name.
    pub(in crate::mesh) rims: Vec<(String, [Vec<u32>; 2])>,
}

impl Layers<'_> {
    /// All nodes that nodes of the section become, ascending.
    fn columns(&self, nodes: &[u32]) -> Vec<u32> {
        sorted(nodes.iter().flat_map(|&node| (0..=self.elements).map(move |layer| self.number(node, layer))))
    }
}

impl Body<3> {
    /// Other names for the ends of a body that was swept.
    pub(super) fn name_ends(&mut self, names: [&str; 2]) {
        for (name, _) in &mut self.sides {
            if let Some(end) = ["back", "front"].iter().position(|end| end == name) {
                *name = names[end].to_string();
            }
        }
    }
}

fn axis_touched(positions: &[[f64; 2]], cell: Cell<'_>, message: &str) -> Wrong {
    let [x, y] = positions[cell.nodes[0] as usize];
    let help = "move the shape away from the axis, or let its elements have whole sides there";
    Wrong::new("axis", format!("an element at ({x:.6e}, {y:.6e}) m {message}"), help)
}
