//! What was made of a CAD file, in words, and the lines of a model that use it.

use super::{Meshed, Unit};
use crate::abaqus::import::quoted;
use crate::numbers::{grouped, significant};
use crate::outline::{cross, dot};
use embate_solver::mesh::cell::Cell;
use embate_solver::mesh::geometry::CellGeometry;
use embate_solver::mesh::surface::{self, Corners, Facet};
use embate_solver::model::MeshGroup;
use embate_solver::tensor::Dim;
use std::collections::BTreeMap;
use std::path::Path;

/// So many faces are listed.
const FACES: usize = 60;
/// A face is flat if the normals of its triangles deviate no more than so much from their mean.
const FLAT: f64 = 1e-6;

type Vector = [f64; 3];

/// Facets with the body behind them, by their nodes in any order.
type Outside = BTreeMap<Facet<3>, Facet<3>>;

/// Columns of numbers and words.
type Rows = Vec<Vec<String>>;

impl Meshed {
    /// Nodes and elements by kind, box, and the shape of the worst element, a line each: of tetrahedra six
    /// times the volume over the third power of the longest edge, which is 0.71 for the best.
    #[must_use]
    pub fn summary(&self) -> String {
        let positions = &self.mesh.positions;
        let solids = || self.mesh.groups.iter().filter(|group| group.dimension == 3).flat_map(MeshGroup::elements).flatten();
        let mut kinds: Vec<(&str, u64)> = Vec::new();
        let mut worst: Option<(f64, Vector)> = None;
        for cell in solids() {
            let name = cell.kind.facts().plural;
            match kinds.iter_mut().find(|(known, _)| *known == name) {
                Some((_, count)) => *count += 1,
                None => kinds.push((name, 1)),
            }
            let shape = self.shape(cell);
            if worst.is_none_or(|(least, _)| shape < least) {
                worst = Some((shape, self.middle(cell)));
            }
        }
        let kinds: Vec<String> = kinds.iter().map(|(name, count)| format!("{} {name}", grouped(*count))).collect();
        let bounds = |pick: fn(f64, f64) -> f64, from: f64| [0, 1, 2].map(|d| positions.iter().fold(from, |at, x| pick(at, x[d])));
        let [low, high] = [bounds(f64::min, f64::INFINITY), bounds(f64::max, f64::NEG_INFINITY)];
        let worst = worst.map_or(String::new(), |(shape, at)| {
            format!("worst element: shape {} at {} (the best tetrahedron has 0.71)\n", significant(three(shape)), self.place(at))
        });
        format!(
            "{} nodes, {}\nbox: {} to {}\n{worst}",
            grouped(positions.len() as u64),
            kinds.join(", "),
            self.numbers(low),
            self.place(high)
        )
    }

    /// A row for each body and one for each of its faces, under a head; with how many faces are left out.
    #[must_use]
    pub fn groups(&self) -> (Rows, usize) {
        let unit = self.unit.name;
        let mut rows: Rows =
            vec![["group".to_string(), "cells".into(), format!("{unit}³, {unit}²"), format!("middle, {unit}"), "normal".into()].into()];
        let mut left = FACES;
        let mut hidden = 0;
        for body in &self.bodies {
            let outside = self.outside(&body.name);
            rows.extend(self.row(&body.name, 3, &outside));
            for face in &body.faces {
                match self.row(face, 2, &outside) {
                    Some(row) if left > 0 => rows.push(row),
                    Some(_) => hidden += 1,
                    None => continue,
                }
                left = left.saturating_sub(1);
            }
        }
        (rows, hidden)
    }

    /// The parts of a model that are these bodies; `file` is the path of the mesh from the model's folder.
    #[must_use]
    pub fn parts(&self, file: &Path) -> String {
        let file = quoted(&file.display().to_string().replace('\\', "/"));
        let part = |name: &str| {
            format!(
                "[[part]]\nname = \"{name}\"\nmaterial = \"steel\"   # a [material.NAME] section\nmesh = {{ file = {file}, group = \"{name}\", scale = \"1 {}\" }}\n",
                self.unit.name
            )
        };
        self.bodies.iter().map(|body| part(&body.name)).collect::<Vec<_>>().join("\n")
    }

    /// How many bodies there are.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// The facets of a body, by their nodes in any order.
    fn outside(&self, body: &str) -> Outside {
        let group = self.mesh.groups.iter().find(|group| group.name == body && group.dimension == 3);
        // Of ten nodes the corners: faces are triangles of corners, too.
        let cells = group.into_iter().flat_map(MeshGroup::elements).flatten().map(Cell::of_corners);
        // Of what is no body there are none, and no normals.
        let facets = surface::exterior::<3>(cells).unwrap_or_default();
        facets.into_iter().map(|facet| (facet.undirected(), facet)).collect()
    }

    /// Name, number of cells, size, middle, and of a flat face its normal.
    fn row(&self, name: &str, dimension: u8, outside: &Outside) -> Option<Vec<String>> {
        let group = self.mesh.groups.iter().find(|group| group.name == name && group.dimension == dimension)?;
        let Unit { length, .. } = self.unit;
        let cells = || group.elements().flatten();
        let sizes = || cells().map(|cell| Dim::<3>::size(cell, &self.mesh.positions).abs());
        let whole: f64 = sizes().sum();
        let mut middle = [0.0; 3];
        for (cell, size) in cells().zip(sizes()) {
            let at = self.middle(cell);
            (0..3).for_each(|d| middle[d] += at[d] * size / whole);
        }
        let indent = if dimension == 3 { "" } else { "  " };
        let normal = if dimension == 2 { self.normal(group, outside) } else { String::new() };
        let size = significant(three(whole / length.powi(dimension.into())));
        Some(vec![format!("{indent}{name}"), grouped(group.cells.len() as u64), size, self.numbers(middle), normal])
    }

    /// The normal of a flat face, out of its body; else a word.
    fn normal(&self, group: &MeshGroup, outside: &Outside) -> String {
        let x = |node: u32| self.mesh.positions[node as usize];
        let mut normals: Vec<Vector> = Vec::new();
        let facets = group.elements().flatten().filter_map(|cell| Facet::<3>::of_cell(cell.nodes));
        for facet in facets.filter_map(|facet| outside.get(&facet.undirected())) {
            let [a, b, c] = [0, 1, 2].map(|k| x(facet[k]));
            let [u, v] = [[0, 1, 2].map(|d| b[d] - a[d]), [0, 1, 2].map(|d| c[d] - a[d])];
            let normal = cross(u, v);
            let length = dot(normal, normal).sqrt();
            normals.push(normal.map(|n| n / length));
        }
        let Some(&first) = normals.first() else { return String::new() };
        let is_flat = normals.iter().all(|normal| (0..3).all(|d| (normal[d] - first[d]).abs() < FLAT));
        if is_flat { format!("({})", first.map(|n| significant(three(n + 0.0))).join(", ")) } else { "curved".to_string() }
    }

    /// See [`CellGeometry::shape_quality`].
    fn shape(&self, cell: Cell<'_>) -> f64 {
        Dim::<3>::shape_quality(cell.of_corners(), &self.mesh.positions)
    }

    fn middle(&self, cell: Cell<'_>) -> Vector {
        let sum = cell.nodes.iter().fold([0.0; 3], |sum: Vector, &node| {
            let x = self.mesh.positions[node as usize];
            [0, 1, 2].map(|d| sum[d] + x[d])
        });
        sum.map(|sum| sum / cell.nodes.len() as f64)
    }

    fn numbers(&self, at: Vector) -> String {
        format!("({})", at.map(|x| significant(three(x / self.unit.length))).join(", "))
    }

    fn place(&self, at: Vector) -> String {
        format!("{} {}", self.numbers(at), self.unit.name)
    }
}

/// Four digits: what rounds to nothing beside a millionth is zero.
fn three(value: f64) -> f64 {
    if value.abs() < 1e-9 {
        return 0.0;
    }
    let digits = 10f64.powi(3 - value.abs().log10().floor() as i32);
    (value * digits).round() / digits
}
