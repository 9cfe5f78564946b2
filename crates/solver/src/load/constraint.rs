//! Prescribed motion by direction: symmetry lines, fixed and driven nodes. After the free update the velocity is set along each direction;
//! the impulse that this takes is the reaction, and its work goes to the ledger.

use super::curve::{Curves, Speed};
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::model::{Model, Symmetry};

/// Prescribed directions of one node, orthonormal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Held<const D: usize> {
    /// Unit direction and prescribed velocity along it in v^{n+½}, m/s.
    directions: Vec<([f64; D], f64)>,
    /// What prescribes the velocity of each direction.
    speeds: Vec<Speed>,
}

impl<const D: usize> Held<D> {
    /// Adds a direction; `Err` holds the velocity that the earlier directions already prescribe along it.
    fn add(&mut self, direction: [f64; D], velocity: &Speed) -> Result<(), Speed> {
        let size = |speed: &Speed| speed.as_constant().unwrap_or(0.0).abs();
        let (mut rest, mut speed, mut largest) = (direction, velocity.clone(), size(velocity));
        for ((held, _), held_speed) in self.directions.iter().zip(&self.speeds) {
            let along: f64 = (0..D).map(|d| held[d] * direction[d]).sum();
            speed = speed.plus(-along, held_speed);
            largest = largest.max(size(held_speed));
            for d in 0..D {
                rest[d] -= along * held[d];
            }
        }
        let length = (0..D).map(|d| rest[d] * rest[d]).sum::<f64>().sqrt();
        if length > 1e-9 {
            let speed = speed.times(1.0 / length);
            self.directions.push((rest.map(|r| r / length), speed.as_constant().unwrap_or(0.0)));
            self.speeds.push(speed);
            Ok(())
        } else if speed.is_round_off(largest) {
            Ok(())
        } else {
            Err(velocity.plus(-1.0, &speed))
        }
    }

    /// The part of a direction along which the node is free to move.
    #[must_use]
    pub fn free_part(&self, mut direction: [f64; D]) -> [f64; D] {
        for (held, _) in &self.directions {
            let along: f64 = (0..D).map(|d| direction[d] * held[d]).sum();
            for d in 0..D {
                direction[d] -= along * held[d];
            }
        }
        direction
    }

    /// The velocity with the prescribed components.
    #[inline]
    #[must_use]
    pub fn apply(&self, mut velocity: [f64; D]) -> [f64; D] {
        for (direction, speed) in &self.directions {
            let change = speed - (0..D).map(|d| velocity[d] * direction[d]).sum::<f64>();
            for d in 0..D {
                velocity[d] += change * direction[d];
            }
        }
        velocity
    }
}

/// All nodes with prescribed motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constraints<const D: usize> {
    /// Index into `held` per node; `u32::MAX`: free. Empty when nothing is held.
    index: Vec<u32>,
    held: Vec<Held<D>>,
    /// Those in `held` whose velocity follows a curve.
    driven: Vec<u32>,
    /// Nodes on symmetry lines, ascending.
    mirrors: Vec<Mirror<D>>,
}

/// A node on a symmetry line.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mirror<const D: usize> {
    node: u32,
    /// Number of the symmetry: two lines can have the same normal.
    line: usize,
    normal: [f64; D],
}

/// Nodes nearer to a symmetry line than this fraction of the model's size lie on it.
const ON_LINE: f64 = 1e-9;

impl Constraints<2> {
    /// From the symmetries and constraints of a model.
    ///
    /// # Errors
    /// Names without nodes, symmetry lines that hold no node, velocities that contradict each other on a node.
    pub fn new(model: &Model, mesh: &Mesh<2>, curves: &Curves) -> Result<Self, Vec<Fault>> {
        let mut result = Self::default();
        let mut faults = Vec::new();
        if model.symmetries.is_empty() && model.constraints.is_empty() {
            return Ok(result);
        }
        result.index = vec![u32::MAX; mesh.positions.len()];
        for (i, symmetry) in model.symmetries.iter().enumerate() {
            let path = format!("symmetry[{i}]");
            let Some(normal) = unit(symmetry.normal) else { continue };
            let nodes = on_line(symmetry, normal, mesh);
            if nodes.is_empty() {
                faults.push(Fault::new(
                    &path,
                    "no node lies on this symmetry line",
                    "move the line or the bodies; nodes must lie on it within 1e-9 of the model's size",
                ));
            }
            for node in nodes {
                result.mirrors.push(Mirror { node, line: i, normal });
                result.hold(node, normal, &Speed::constant(0.0), &path, mesh, &mut faults);
            }
        }
        result.mirrors.sort_by_key(|mirror| mirror.node);
        for (i, constraint) in model.constraints.iter().enumerate() {
            let path = format!("constraint[{i}]");
            let Some(nodes) = mesh.nodes(&constraint.on) else {
                faults.push(Fault::new(
                    format!("{path}.on"),
                    format!("there is nothing called \"{}\"", constraint.on),
                    "name a part, a side as part.side, or a group",
                ));
                continue;
            };
            let speeds = [0, 1].map(|d| constraint.velocity[d].as_ref().and_then(|drive| curves.speed(drive)));
            for node in nodes {
                for (speed, direction) in speeds.iter().zip([[1.0, 0.0], [0.0, 1.0]]) {
                    if let Some(speed) = speed {
                        result.hold(node, direction, speed, &path, mesh, &mut faults);
                    }
                }
            }
        }
        let driven = |held: &Held<2>| held.speeds.iter().any(|speed| speed.as_constant().is_none());
        result.driven = (0..).zip(&result.held).filter(|(_, held)| driven(held)).map(|(index, _)| index).collect();
        faults.dedup();
        if faults.is_empty() { Ok(result) } else { Err(faults) }
    }

    fn hold(&mut self, node: u32, direction: [f64; 2], velocity: &Speed, path: &str, mesh: &Mesh<2>, faults: &mut Vec<Fault>) {
        let slot = &mut self.index[node as usize];
        if *slot == u32::MAX {
            *slot = self.held.len() as u32;
            self.held.push(Held::default());
        }
        if let Err(earlier) = self.held[*slot as usize].add(direction, velocity) {
            let [x, y] = mesh.positions[node as usize];
            let told = |speed: &Speed| speed.as_constant().map_or("as a curve says".to_string(), |velocity| format!("at {velocity} m/s"));
            let message = format!(
                "the node at ({x:.6e}, {y:.6e}) shall move {}, but another condition already moves it {} there",
                told(velocity),
                told(&earlier)
            );
            if faults.len() < 20 {
                faults.push(Fault::new(path, message, "take the node out of one of the two"));
            }
        }
    }
}

impl<const D: usize> Constraints<D> {
    /// What holds `node`, if anything.
    #[inline]
    #[must_use]
    pub fn of(&self, node: usize) -> Option<&Held<D>> {
        self.held.get(*self.index.get(node)? as usize)
    }

    /// Takes the velocities that curves prescribe, as their mean between two times, s.
    pub fn drive(&mut self, curves: &Curves, from: f64, to: f64) {
        for &index in &self.driven {
            let held = &mut self.held[index as usize];
            for ((_, velocity), speed) in held.directions.iter_mut().zip(&held.speeds) {
                *velocity = curves.mean(speed, from, to);
            }
        }
    }

    /// Whether no node is held.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// Normals of the symmetry lines that `node` lies on.
    pub fn mirror_normals(&self, node: u32) -> impl Iterator<Item = [f64; D]> {
        self.mirrors_of(node).map(|mirror| mirror.normal)
    }

    fn mirrors_of(&self, node: u32) -> impl Iterator<Item = &Mirror<D>> {
        let start = self.mirrors.partition_point(|mirror| mirror.node < node);
        self.mirrors[start..].iter().take_while(move |mirror| mirror.node == node)
    }

    /// Part of a node that belongs to the model: a half on a symmetry line, a quarter where two lines meet.
    #[must_use]
    pub fn share(&self, node: u32) -> f64 {
        let Some(first) = self.mirror_normals(node).next() else { return 1.0 };
        let along = |normal: [f64; D]| (0..D).map(|d| first[d] * normal[d]).sum::<f64>().abs();
        if self.mirror_normals(node).any(|normal| along(normal) < 1.0 - 1e-9) { 0.25 } else { 0.5 }
    }

    /// Whether both nodes lie on the same symmetry line.
    #[must_use]
    pub fn is_mirror(&self, segment: [u32; 2]) -> bool {
        self.mirrors_of(segment[0]).any(|a| self.mirrors_of(segment[1]).any(|b| a.line == b.line))
    }
}

fn on_line(symmetry: &Symmetry, normal: [f64; 2], mesh: &Mesh<2>) -> Vec<u32> {
    let size = mesh.positions.iter().flatten().chain(&symmetry.point).fold(0.0f64, |size, x| size.max(x.abs()));
    let near = |&node: &u32| {
        let x = mesh.positions[node as usize];
        ((x[0] - symmetry.point[0]) * normal[0] + (x[1] - symmetry.point[1]) * normal[1]).abs() <= ON_LINE * size
    };
    let parts = mesh.parts.iter().filter(|part| symmetry.parts.is_empty() || symmetry.parts.contains(&part.name));
    let mut nodes: Vec<u32> = parts.flat_map(|part| part.nodes.iter().copied()).filter(near).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Unit vector; `None` for a vector without direction.
#[must_use]
pub fn unit(v: [f64; 2]) -> Option<[f64; 2]> {
    let length = (v[0] * v[0] + v[1] * v[1]).sqrt();
    (length > 0.0 && length.is_finite()).then(|| [v[0] / length, v[1] / length])
}
