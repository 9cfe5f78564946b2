//! Whether nodes of one body are inside another one, from elements alone: a check of contact in 3D that
//! shares nothing with it.
//!
//! A node is inside an element where the element's shape functions say so. Its depth is its distance from the
//! nearest facet of that body; the local thickness is the way from there through the node to where the body
//! ends, or from the node through its own body to the other side, if that is less. That is little near every
//! edge, so the depth must be much against 2 V / S of both bodies, too: the thickness of a plate, half the
//! width of a rod, a third of that of a ball. Surfaces are the faces that one element alone has,
//! quadrilaterals as four triangles around their mean: of two the choice decides where the face is bent.

use crate::generator_space::{Vector, cross, difference as minus, dot};
use embate_solver::output::{CellKind, Cells};
use std::collections::HashMap;

/// Facets of an element by its number of nodes, and the corners of its reference element.
const TETRAHEDRON: [&[usize]; 4] = [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]];
const TETRAHEDRON10: [&[usize]; 16] = [
    &[0, 6, 4],
    &[6, 2, 5],
    &[4, 5, 1],
    &[6, 5, 4],
    &[0, 4, 7],
    &[4, 1, 8],
    &[7, 8, 3],
    &[4, 8, 7],
    &[1, 5, 8],
    &[5, 2, 9],
    &[8, 9, 3],
    &[5, 9, 8],
    &[2, 6, 9],
    &[6, 0, 7],
    &[9, 7, 3],
    &[6, 7, 9],
];
/// The parts of one of ten nodes: 10 is the middle of those between its corners.
const PARTS: [[usize; 4]; 12] = [
    [0, 4, 6, 7],
    [1, 5, 4, 8],
    [2, 6, 5, 9],
    [3, 9, 8, 7],
    [10, 4, 7, 6],
    [10, 5, 8, 4],
    [10, 6, 9, 5],
    [10, 9, 7, 8],
    [10, 5, 9, 8],
    [10, 6, 7, 9],
    [10, 4, 8, 7],
    [10, 5, 4, 6],
];
const WEDGE: [&[usize]; 5] = [&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];
const HEXAHEDRON: [&[usize]; 6] = [&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];

fn faces(nodes: usize) -> &'static [&'static [usize]] {
    match nodes {
        4 => &TETRAHEDRON,
        6 => &WEDGE,
        8 => &HEXAHEDRON,
        10 => &TETRAHEDRON10,
        _ => &[],
    }
}

/// What is the deepest of all nodes.
pub(crate) struct Deepest {
    /// The parts of the node and of the body around it.
    pub(crate) parts: [u32; 2],
    /// Depth as a fraction of the local thickness.
    pub(crate) ratio: f64,
}

/// Depth as a fraction of 2 V / S of the thinner body from which on a node counts.
const MUCH: f64 = 0.3;

/// The surfaces of the parts of a model.
pub(crate) struct Surfaces {
    cells: Cells,
    /// Faces, a triangle repeats its last node, and nodes of each part.
    faces: Vec<Vec<[u32; 4]>>,
    nodes: Vec<Vec<u32>>,
}

impl Surfaces {
    pub(crate) fn of(cells: Cells) -> Self {
        let mut seen: HashMap<Vec<u32>, (usize, Vec<u32>, u32)> = HashMap::new();
        for cell in 0..cells.len() {
            let nodes = cells.cell(cell);
            for face in faces(nodes.len()) {
                let face: Vec<u32> = face.iter().map(|&corner| nodes[corner]).collect();
                let mut key = face.clone();
                key.sort_unstable();
                seen.entry(key).or_insert((0, face, cells.parts[cell])).0 += 1;
            }
        }
        let mut outside: Vec<(Vec<u32>, u32)> = seen.into_values().filter(|it| it.0 == 1).map(|(_, face, part)| (face, part)).collect();
        outside.sort_unstable();
        let parts = cells.part_names.len();
        let (mut faces, mut nodes) = (vec![Vec::new(); parts], vec![Vec::new(); parts]);
        for (face, part) in outside {
            faces[part as usize].push([0, 1, 2, face.len() - 1].map(|k| face[k]));
            nodes[part as usize].extend(face);
        }
        nodes.iter_mut().for_each(|nodes: &mut Vec<u32>| {
            nodes.sort_unstable();
            nodes.dedup();
        });
        Self { cells, faces, nodes }
    }

    /// The triangles of a part.
    fn triangles(&self, part: u32, x: &[Vector]) -> Vec<[Vector; 3]> {
        let of = |face: &[u32; 4]| {
            let [a, b, c, d] = face.map(|node| x[node as usize]);
            let mean = std::array::from_fn(|k| 0.25 * (a[k] + b[k] + c[k] + d[k]));
            if face[2] == face[3] { vec![[a, b, c]] } else { vec![[a, b, mean], [b, c, mean], [c, d, mean], [d, a, mean]] }
        };
        self.faces[part as usize].iter().flat_map(of).collect()
    }

    /// The deepest node of a part in another one against the local thickness.
    pub(crate) fn deepest(&self, x: &[Vector]) -> Option<Deepest> {
        let mut deepest: Option<Deepest> = None;
        for cell in 0..self.cells.len() {
            let (part, nodes) = (self.cells.parts[cell], self.cells.cell(cell));
            let corners: Vec<Vector> = nodes.iter().map(|&node| x[node as usize]).collect();
            let low: Vector = std::array::from_fn(|d| corners.iter().map(|c| c[d]).fold(f64::INFINITY, f64::min));
            let high: Vector = std::array::from_fn(|d| corners.iter().map(|c| c[d]).fold(f64::NEG_INFINITY, f64::max));
            for (own, nodes) in (0..).zip(&self.nodes).filter(|(own, _)| *own != part) {
                for &node in nodes {
                    let p = x[node as usize];
                    if (0..3).all(|d| low[d] < p[d] && p[d] < high[d]) && is_within(&corners, p) {
                        let Some(found) = self.depth([own, part], p, x) else { continue };
                        if deepest.as_ref().is_none_or(|most| found.ratio > most.ratio) {
                            deepest = Some(found);
                        }
                    }
                }
            }
        }
        deepest
    }

    /// 2 V / S of a part, m.
    fn thickness(&self, part: u32, x: &[Vector]) -> f64 {
        let origin = x[self.nodes[part as usize][0] as usize];
        let [six_volumes, double_surface] = self.triangles(part, x).into_iter().fold([0.0; 2], |[volume, surface], corners| {
            let [a, b, c] = corners.map(|x| minus(x, origin));
            let double = cross(minus(b, a), minus(c, a));
            [volume + dot(a, double), surface + size(double)]
        });
        2.0 / 3.0 * six_volumes / double_surface
    }

    /// How deep a node of the first part is in the second, if that is much.
    fn depth(&self, parts: [u32; 2], p: Vector, x: &[Vector]) -> Option<Deepest> {
        let [own, other] = parts.map(|part| self.triangles(part, x).into_iter());
        let nearest = other.clone().map(|corners| nearest(p, corners)).min_by(|a, b| size(minus(*a, p)).total_cmp(&size(minus(*b, p))));
        let foot = nearest.unwrap_or(p);
        let depth = size(minus(p, foot));
        if !(depth > MUCH * f64::min(self.thickness(parts[0], x), self.thickness(parts[1], x))) {
            return None;
        }
        let inward = minus(p, foot).map(|c| c / depth);
        // Beyond the node, and back through its own body.
        let first =
            |ways: &mut dyn Iterator<Item = Option<f64>>| ways.flatten().filter(|way| *way > 1e-6 * depth).fold(f64::INFINITY, f64::min);
        let through = depth + first(&mut other.map(|corners| meets(p, inward, corners)));
        let back = first(&mut own.map(|corners| meets(p, inward.map(|c| -c), corners)));
        Some(Deepest { parts, ratio: depth / through.min(back) })
    }
}

/// A bar of 0.5 x 0.2 x 0.2 whose end is 0.25 deep in a unit cube is so by half of its length, of whatever
/// elements; beside it it is not.
pub(crate) fn checks_itself() {
    let corners: [Vector; 8] =
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(|c| c.map(f64::from));
    let split: [(&[&[u32]], CellKind); 3] = [
        (&[&[0, 1, 2, 3, 4, 5, 6, 7]], CellKind::Hexahedron),
        (&[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]], CellKind::Wedge),
        (&[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]], CellKind::Tetrahedron),
    ];
    let reference = CellKind::Tetrahedron10.facts().reference;
    assert!(is_within(reference, [0.1, 0.1, 0.1]) && is_within(reference, [0.3, 0.3, 0.3]) && !is_within(reference, [0.4, 0.4, 0.3]));
    for (cube, bar) in (0..9).map(|k| (split[k / 3], split[k % 3])) {
        let mut cells = Cells { offsets: vec![0], part_names: vec!["cube".into(), "bar".into()], ..Cells::default() };
        for (part, (all, kind)) in (0..).zip([cube, bar]) {
            for cell in all {
                cells.nodes.extend(cell.iter().map(|node| node + 8 * part));
                cells.offsets.push(cells.nodes.len() as u32);
                cells.kinds.push(kind);
                cells.parts.push(part);
            }
        }
        let surfaces = Surfaces::of(cells);
        let found = |from: f64| {
            let bar = corners.map(|[x, y, z]| [from + 0.5 * x, 0.43 + 0.2 * y, 0.41 + 0.2 * z]);
            surfaces.deepest(&[corners, bar].concat()).map(|found| (found.ratio, found.parts))
        };
        assert!(found(0.75).is_some_and(|(ratio, parts)| (ratio - 0.5).abs() < 1e-12 && parts == [1, 0]) && found(1.01).is_none());
    }
}

/// Whether a place is within an element: its coordinates by Newton's method.
fn is_within(corners: &[Vector], p: Vector) -> bool {
    if corners.len() == 10 {
        let middle: Vector = std::array::from_fn(|d| corners[4..].iter().map(|x| x[d]).sum::<f64>() / 6.0);
        let at = |k: usize| if k == 10 { middle } else { corners[k] };
        return PARTS.iter().any(|part| is_within(&part.map(at), p));
    }
    let mut r = if corners.len() == 8 { [0.0; 3] } else { [0.25, 0.25, if corners.len() == 6 { 0.0 } else { 0.25 }] };
    for _ in 0..30 {
        let (shapes, slopes) = shapes(corners.len(), r);
        let sum =
            |of: &dyn Fn(usize) -> f64| -> Vector { std::array::from_fn(|d| (0..corners.len()).map(|k| of(k) * corners[k][d]).sum()) };
        let miss = minus(p, sum(&|k| shapes[k]));
        let [a, b, c] = [0, 1, 2].map(|e| sum(&|k| slopes[k][e]));
        let volume = dot(a, cross(b, c));
        if !(volume > 0.0) {
            return false;
        }
        let by = [dot(miss, cross(b, c)), dot(miss, cross(c, a)), dot(miss, cross(a, b))].map(|c| c / volume);
        r = [0, 1, 2].map(|d| r[d] + by[d]);
        if by.iter().all(|c| c.abs() < 1e-10) {
            return match corners.len() {
                8 => r.iter().all(|c| c.abs() < 1.0),
                6 => r[0] > 0.0 && r[1] > 0.0 && r[0] + r[1] < 1.0 && r[2].abs() < 1.0,
                _ => r.iter().all(|c| *c > 0.0) && r.iter().sum::<f64>() < 1.0,
            };
        }
        if r.iter().any(|c| !(c.abs() < 3.0)) {
            return false;
        }
    }
    false
}

/// Shape functions and their slopes.
fn shapes(nodes: usize, [r, s, t]: Vector) -> (Vec<f64>, Vec<Vector>) {
    let triangle = ([1.0 - r - s, r, s], [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]]);
    match nodes {
        8 => {
            let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            (0..8)
                .map(|k| {
                    let ([a, b], c) = (signs[k % 4], if k < 4 { -1.0 } else { 1.0 });
                    let [u, v, w] = [1.0 + a * r, 1.0 + b * s, 1.0 + c * t];
                    (u * v * w / 8.0, [a * v * w / 8.0, b * u * w / 8.0, c * u * v / 8.0])
                })
                .unzip()
        }
        6 => (0..6)
            .map(|k| {
                let c = if k < 3 { -0.5 } else { 0.5 };
                let (h, [a, b]) = (0.5 + c * t, triangle.1[k % 3]);
                (triangle.0[k % 3] * h, [a * h, b * h, triangle.0[k % 3] * c])
            })
            .unzip(),
        _ => (vec![1.0 - r - s - t, r, s, t], vec![[-1.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    }
}

/// The place of a triangle that is nearest to a point: that of its plane, or of an edge.
fn nearest(p: Vector, [a, b, c]: [Vector; 3]) -> Vector {
    let normal = cross(minus(b, a), minus(c, a));
    let square = dot(normal, normal);
    let away = dot(minus(p, a), normal) / square;
    let foot = [0, 1, 2].map(|d| p[d] - away * normal[d]);
    let edges = [[a, b], [b, c], [c, a]];
    if square > 0.0 && edges.iter().all(|[q, r]| dot(cross(minus(*r, *q), minus(foot, *q)), normal) >= 0.0) {
        return foot;
    }
    let on = |[q, r]: [Vector; 2]| {
        let along = minus(r, q);
        let share = (dot(minus(p, q), along) / dot(along, along)).clamp(0.0, 1.0);
        [0, 1, 2].map(|d| q[d] + share * along[d])
    };
    edges.map(on).into_iter().min_by(|a, b| size(minus(*a, p)).total_cmp(&size(minus(*b, p)))).unwrap_or(foot)
}

/// How far along a direction a triangle is.
fn meets(from: Vector, direction: Vector, [a, b, c]: [Vector; 3]) -> Option<f64> {
    let normal = cross(minus(b, a), minus(c, a));
    let falls = dot(normal, direction);
    let way = dot(minus(a, from), normal) / falls;
    let foot = [0, 1, 2].map(|d| from[d] + way * direction[d]);
    let is_there = [[a, b], [b, c], [c, a]].iter().all(|[q, r]| dot(cross(minus(*r, *q), minus(foot, *q)), normal) >= 0.0);
    (falls != 0.0 && is_there).then_some(way)
}

fn size(a: Vector) -> f64 {
    dot(a, a).sqrt()
}
