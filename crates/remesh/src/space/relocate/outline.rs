//! The outline of a mesh as its nodes slide on it: faces as triangles about their centres, the lines where it
//! turns, and what each node may do.
//!
//! A node stays within the faces (on a line the pieces) that it is a corner of: what it slides on is known
//! without a search, and it can't leave the side of a line that it is on.

use super::super::boundary::on_triangle;
use super::super::face::{Face, Triangle, corners, faces};
use super::super::vector::{cross, dot, minus};
use super::super::{Mesh, Point};
use super::shape::Ways;

/// Cosine of the angle (30 degrees) by which the outline turns at an edge, or a line at a node.
const SHARP: f64 = 0.866_025_403_784_438_6;
/// The flatter of two sides of a line counts as plane when it turns by less than this part of the other.
const FLATTER: f64 = 0.1;

/// What a node may do.
#[derive(Clone, Debug)]
pub(super) enum Role {
    /// It is inside.
    Inner,
    /// It stays.
    Fixed,
    /// It slides on these triangles; their normals turn from the mean one by an angle of this sine.
    Patch { triangles: Vec<Triangle>, normal: Point, turn: f64 },
    /// It slides along the edges to two nodes, of this mean direction, which turn by an angle of this sine.
    /// Of both sides of the line the mean normals, and the sines by which they turn.
    Line { ends: [u32; 2], along: Point, turn: f64, sides: [(Point, f64); 2] },
}

/// What the model says of nodes and faces.
#[derive(Clone, Copy, Debug)]
pub struct Marks<'a> {
    /// Whether each node must stay.
    pub fixed: &'a [bool],
    /// Of each node ascending numbers of sets that it is in: it moves only among nodes of them all.
    pub nodes: &'a [Vec<u32>],
    /// Of each face of the outline (as `faces` has them) ascending numbers of sets that it is in: where two
    /// faces differ is a line.
    pub faces: &'a [Vec<u32>],
}

/// The outline of the mesh as it is.
pub(super) struct Outline<'a> {
    pub(super) positions: &'a [Point],
    pub(super) faces: Vec<Face>,
    pub(super) roles: Vec<Role>,
    /// Components that all have in common among which a node slides: it keeps them to the last digit.
    keeps: Vec<[bool; 3]>,
}

/// An edge at a node: the other end, its faces, and whether a line goes along it.
struct Edge {
    other: u32,
    faces: [usize; 2],
    is_line: bool,
}

impl<'a> Outline<'a> {
    pub(super) fn new(mesh: Mesh<'a>, marks: &Marks<'_>, near: impl Fn(usize) -> Vec<usize>) -> Self {
        let (positions, faces) = (mesh.positions, faces(mesh));
        let normals: Vec<Point> = faces.iter().map(|face| unit(normal(face, positions))).collect();
        let mut around: Vec<Vec<usize>> = vec![Vec::new(); positions.len()];
        for (index, face) in faces.iter().enumerate() {
            corners(face).iter().for_each(|&node| around[node as usize].push(index));
        }
        let known = Known { positions, faces: &faces, normals: &normals, marks };
        let role = |node: usize| {
            if marks.fixed[node] {
                Role::Fixed
            } else if around[node].is_empty() {
                let moves =
                    marks.nodes[node].is_empty() || near(node).iter().all(|&other| contains(&marks.nodes[other], &marks.nodes[node]));
                if moves { Role::Inner } else { Role::Fixed }
            } else {
                known.role(node, &around[node])
            }
        };
        let roles: Vec<Role> = (0..positions.len()).map(role).collect();
        let keeps = (0..positions.len()).map(|node| known.keeps(node, &roles[node])).collect();
        Self { positions, faces, roles, keeps }
    }

    /// The directions in which a node may go. On the outline the mean ones: where it is now, several
    /// triangles can be equally near.
    pub(super) fn ways(&self, node: usize) -> Option<Ways> {
        match self.roles[node] {
            Role::Inner => Some(Ways::All),
            Role::Fixed => None,
            Role::Patch { normal, .. } => Some(Ways::Across(normal)),
            Role::Line { along, .. } => Some(Ways::Along(along)),
        }
    }

    /// The place of the outline that a node may have and that is nearest to `place`.
    pub(super) fn onto(&self, node: usize, place: Point) -> Point {
        let found = match &self.roles[node] {
            Role::Inner => return place,
            Role::Fixed => return self.positions[node],
            Role::Patch { triangles, .. } => self.nearest(triangles, place).map_or(self.positions[node], |(_, _, found)| found),
            Role::Line { ends, .. } => {
                let (end, share) = self.on_line(node, *ends, place);
                let (from, to) = (self.positions[node], self.positions[end as usize]);
                [0, 1, 2].map(|k| from[k] + share * (to[k] - from[k]))
            }
        };
        self.kept(node, found)
    }

    /// The same place with the components that the node keeps.
    pub(super) fn kept(&self, node: usize, place: Point) -> Point {
        [0, 1, 2].map(|k| if self.keeps[node][k] { self.positions[node][k] } else { place[k] })
    }

    /// Old nodes with their shares at a place of the outline that a node has slid to.
    pub(super) fn shares(&self, node: usize, place: Point) -> Vec<(u32, f64)> {
        let stays = vec![(node as u32, 1.0)];
        if place == self.positions[node] {
            return stays;
        }
        match &self.roles[node] {
            Role::Inner | Role::Fixed => stays,
            Role::Patch { triangles, .. } => {
                self.nearest(triangles, place).map_or(stays, |(best, weights, _)| triangles[best].shares(weights))
            }
            Role::Line { ends, .. } => {
                let (end, share) = self.on_line(node, *ends, place);
                if share == 0.0 { stays } else { vec![(node as u32, 1.0 - share), (end, share)] }
            }
        }
    }

    /// The nearest of some triangles, the weights of its vertices, and the place on it.
    fn nearest(&self, triangles: &[Triangle], place: Point) -> Option<(usize, [f64; 3], Point)> {
        let mut best: Option<(f64, usize, [f64; 3], Point)> = None;
        for (index, triangle) in triangles.iter().enumerate() {
            let x = triangle.places(self.positions);
            let weights = on_triangle(&x, place);
            let found = [0, 1, 2].map(|k| weights[0] * x[0][k] + weights[1] * x[1][k] + weights[2] * x[2][k]);
            let arm = minus(place, found);
            let square = dot(arm, arm);
            if best.is_none_or(|(least, ..)| square < least) {
                best = Some((square, index, weights, found));
            }
        }
        best.map(|(_, index, weights, found)| (index, weights, found))
    }

    /// The end towards which the nearest place on the line is, and its part of the way there.
    fn on_line(&self, node: usize, ends: [u32; 2], place: Point) -> (u32, f64) {
        let from = self.positions[node];
        let of = |end: u32| {
            let way = minus(self.positions[end as usize], from);
            let share = (dot(minus(place, from), way) / dot(way, way)).clamp(0.0, 1.0);
            let arm = [0, 1, 2].map(|k| place[k] - from[k] - share * way[k]);
            (dot(arm, arm), end, share)
        };
        let [first, second] = ends.map(of);
        let best = if second.0 < first.0 { second } else { first };
        (best.1, best.2)
    }

    /// The direction in which a node corrects the volume, of which `slope` is the derivative in its place,
    /// and how far it may be off: its way times the sine by which the outline turns.
    pub(super) fn correction(&self, node: usize, slope: Point, way: f64) -> Point {
        let (turn, normal) = match &self.roles[node] {
            Role::Inner | Role::Fixed => return [0.0; 3],
            Role::Patch { turn, .. } => (*turn, slope),
            Role::Line { turn, sides: [(first, by), (second, other)], .. } => {
                // What is flat stays so.
                let away = |normal: &Point| [0, 1, 2].map(|k| slope[k] - dot(slope, *normal) * normal[k]);
                let across = match (*by <= FLATTER * other, *other <= FLATTER * by) {
                    (true, true) => return [0.0; 3],
                    (true, false) => away(first),
                    (false, true) => away(second),
                    (false, false) => slope,
                };
                (*turn, across)
            }
        };
        let normal = [0, 1, 2].map(|k| if self.keeps[node][k] { 0.0 } else { normal[k] });
        unit(normal).map(|n| turn * way * n)
    }
}

/// What roles follow from.
struct Known<'a> {
    positions: &'a [Point],
    faces: &'a [Face],
    normals: &'a [Point],
    marks: &'a Marks<'a>,
}

impl Known<'_> {
    /// The edges at a node on the outline; `None` where it is not that of one body there.
    fn edges(&self, node: usize, around: &[usize]) -> Option<Vec<Edge>> {
        let mut edges: Vec<(u32, usize)> = Vec::new();
        for &index in around {
            let own = corners(&self.faces[index]);
            let at = own.iter().position(|&corner| corner as usize == node)?;
            edges.extend([own[(at + 1) % own.len()], own[(at + own.len() - 1) % own.len()]].map(|other| (other, index)));
        }
        edges.sort_unstable();
        let pairs = edges.chunk_by(|a, b| a.0 == b.0);
        let edge = |pair: &[(u32, usize)]| {
            let &[(other, first), (_, second)] = pair else { return None };
            let differ = self.marks.faces[first] != self.marks.faces[second];
            Some(Edge { other, faces: [first, second], is_line: differ || dot(self.normals[first], self.normals[second]) < SHARP })
        };
        let edges: Vec<Edge> = pairs.map(edge).collect::<Option<_>>()?;
        (side(&edges, around[0], |_| true).len() == around.len()).then_some(edges)
    }

    fn role(&self, node: usize, around: &[usize]) -> Role {
        let Some(edges) = self.edges(node, around) else { return Role::Fixed };
        let lines: Vec<&Edge> = edges.iter().filter(|edge| edge.is_line).collect();
        let marks = &self.marks.nodes[node];
        match lines[..] {
            [] => {
                let corners = around.iter().flat_map(|&index| corners(&self.faces[index]));
                if corners.into_iter().any(|&other| !contains(&self.marks.nodes[other as usize], marks)) {
                    return Role::Fixed;
                }
                let (normal, turn) = self.mean(around);
                Role::Patch { triangles: around.iter().flat_map(|&index| Triangle::of(&self.faces[index])).collect(), normal, turn }
            }
            [first, second] => {
                let ends = [first.other, second.other];
                let [a, b] = ends.map(|end| unit(minus(self.positions[end as usize], self.positions[node])));
                let straight = -dot(a, b);
                if straight < SHARP || ends.iter().any(|&end| !contains(&self.marks.nodes[end as usize], marks)) {
                    return Role::Fixed;
                }
                let turned = cross(a, b);
                let of = |index: usize| self.mean(&side(&edges, index, |edge| !edge.is_line));
                Role::Line { ends, along: unit(minus(a, b)), turn: dot(turned, turned).sqrt(), sides: first.faces.map(of) }
            }
            _ => Role::Fixed,
        }
    }

    /// Mean normal of the triangles of some faces, and the largest sine of the angles between it and theirs.
    fn mean(&self, faces: &[usize]) -> (Point, f64) {
        let triangles = || faces.iter().flat_map(|&index| Triangle::of(&self.faces[index])).map(|own| own.area(self.positions));
        let mean = unit(triangles().fold([0.0; 3], |sum, area| [0, 1, 2].map(|k| sum[k] + area[k])));
        let turn = triangles().map(|area| cross(unit(area), mean)).fold(0.0, |most: f64, turned| most.max(dot(turned, turned)));
        (mean, turn.sqrt())
    }

    /// Components that all places have in common that a node may slide among.
    fn keeps(&self, node: usize, role: &Role) -> [bool; 3] {
        let same = |other: u32| [0, 1, 2].map(|k| self.positions[other as usize][k] == self.positions[node][k]);
        let all = |others: &mut dyn Iterator<Item = u32>| others.map(same).fold([true; 3], |all, own| [0, 1, 2].map(|k| all[k] && own[k]));
        match role {
            Role::Inner | Role::Fixed => [false; 3],
            Role::Patch { triangles, .. } => all(&mut triangles.iter().flat_map(|triangle| triangle.face)),
            Role::Line { ends, .. } => all(&mut ends.iter().copied()),
        }
    }
}

/// The faces at a node that are reached from one of them over edges that may be crossed.
fn side(edges: &[Edge], from: usize, crosses: impl Fn(&Edge) -> bool) -> Vec<usize> {
    let mut found = vec![from];
    let mut at = 0;
    while let Some(&face) = found.get(at) {
        for edge in edges.iter().filter(|edge| crosses(edge) && edge.faces.contains(&face)) {
            let next = edge.faces[usize::from(edge.faces[0] == face)];
            if !found.contains(&next) {
                found.push(next);
            }
        }
        at += 1;
    }
    found
}

/// Whether an ascending list has all numbers of another one.
fn contains(all: &[u32], some: &[u32]) -> bool {
    some.iter().all(|number| all.binary_search(number).is_ok())
}

/// Twice the area of a face times its normal.
fn normal(face: &Face, positions: &[Point]) -> Point {
    Triangle::of(face).fold([0.0; 3], |sum, own| {
        let area = own.area(positions);
        [0, 1, 2].map(|k| sum[k] + area[k])
    })
}

/// The direction of a vector; zero of zero.
pub(super) fn unit(v: Point) -> Point {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|v| v / length) } else { [0.0; 3] }
}
