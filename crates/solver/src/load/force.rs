//! Forces on nodes: given forces on sets, and pressures on surfaces.
//!
//! force:     F c(t) in all, shared over a surface by tributary length, over other sets equally
//! pressure:  −p c(t) n per current length of each segment, n its current outward normal, half to each node: it follows the surface
//!
//! with a factor c(t) of a curve. Works are external. A closed surface under pressure feels no resultant.

use super::curve::Curves;
use super::tributary::Depth;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{Load, Model};
use crate::vector::first;

type Vector = [f64; 2];

/// The forces on nodes of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    loads: Vec<Acting>,
    /// Force on every node now, N/m; empty when the model has no such load.
    now: Vec<Vector>,
    depth: Depth,
}

#[derive(Clone, Debug, PartialEq)]
struct Acting {
    what: What,
    curve: Option<usize>,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    /// Nodes and their forces, N/m.
    Given(Vec<(u32, Vector)>),
    /// Segments with the body on the right, and the pressure, Pa.
    Pressure(Vec<[u32; 2]>, f64),
}

impl Forces {
    /// `is_mirror` tells which segments lie on a symmetry line: they are no surface.
    ///
    /// # Errors
    /// Names of nothing, or of what is no surface.
    pub fn new(model: &Model, mesh: &Mesh<2>, curves: &Curves, is_mirror: impl Fn([u32; 2]) -> bool) -> Result<Self, Vec<Fault>> {
        let (mut loads, mut faults, depth) = (Vec::new(), Vec::new(), Depth::of(model));
        for (i, load) in model.loads.iter().enumerate() {
            let (what, curve) = match load {
                Load::Force { on, force, curve } => (given(mesh, on, first(*force), depth, &is_mirror), curve),
                Load::Pressure { on, pressure, curve } => {
                    (mesh.surface(on, &is_mirror).map(|surface| What::Pressure(surface.segments, *pressure)), curve)
                }
                Load::Gravity { .. } | Load::Centrifugal { .. } | Load::Damping { .. } | Load::StiffnessDamping { .. } => continue,
            };
            match what {
                Ok(what) => loads.push(Acting { what, curve: curve.as_ref().and_then(|name| curves.find(name)) }),
                Err(fault) => faults.push(Fault { path: format!("load[{i}].on"), ..fault }),
            }
        }
        if faults.is_empty() { Ok(Self { loads, now: Vec::new(), depth }) } else { Err(faults) }
    }

    /// Whether the model has no such load.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.loads.is_empty()
    }

    /// Takes their means between two times (s) at these positions (m).
    pub fn prepare(&mut self, curves: &Curves, [from, to]: [f64; 2], positions: &[Vector]) {
        if self.loads.is_empty() {
            return;
        }
        self.now.clear();
        self.now.resize(positions.len(), [0.0; 2]);
        for load in &self.loads {
            let factor = load.curve.map_or(1.0, |curve| curves.curve(curve).mean(from, to));
            let mut add = |node: u32, [x, y]: Vector, factor: f64| {
                let sum = &mut self.now[node as usize];
                *sum = [sum[0] + factor * x, sum[1] + factor * y];
            };
            match &load.what {
                What::Given(forces) => forces.iter().for_each(|&(node, force)| add(node, force, factor)),
                What::Pressure(segments, pressure) => {
                    for &[a, b] in segments {
                        let ends = [a, b].map(|node| positions[node as usize]);
                        let side = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
                        let length = (side[0] * side[0] + side[1] * side[1]).sqrt();
                        if length > 0.0 {
                            let inward = [side[1] / length, -side[0] / length];
                            for (node, share) in [a, b].into_iter().zip(self.depth.shares(ends)) {
                                add(node, inward, factor * pressure * share);
                            }
                        }
                    }
                }
            }
        }
    }

    /// Leaves nodes without elements alone, and surfaces that are outside no more.
    pub fn renew(&mut self, is_free: impl Fn(u32) -> bool, is_outside: impl Fn([u32; 2]) -> bool) {
        for load in &mut self.loads {
            match &mut load.what {
                What::Given(forces) => forces.retain(|&(node, _)| !is_free(node)),
                What::Pressure(segments, _) => segments.retain(|&segment| is_outside(segment)),
            }
        }
    }

    /// Force on every node now, N/m; empty when the model has no such load.
    #[must_use]
    pub fn now(&self) -> &[Vector] {
        &self.now
    }
}

/// Shares a force over a set.
fn given(mesh: &Mesh<2>, on: &str, force: Vector, depth: Depth, is_mirror: &impl Fn([u32; 2]) -> bool) -> Result<What, Fault> {
    let nodes = mesh.nodes(on).filter(|nodes| !nodes.is_empty());
    let Some(nodes) = nodes else {
        return Err(Fault::new(
            &UNKNOWN_NAME,
            "",
            format!("there is nothing called \"{on}\""),
            "name a side as part.side, or a group of a mesh file",
        ));
    };
    let mut shares: Vec<(u32, f64)> = nodes.into_iter().map(|node| (node, 0.0)).collect();
    // A group of lines inside a body is no surface: its nodes are equal.
    match mesh.surface(on, is_mirror) {
        Ok(surface) if !surface.segments.is_empty() => {
            for segment in surface.segments {
                for (node, part) in segment.into_iter().zip(depth.shares(segment.map(|node| mesh.positions[node as usize]))) {
                    if let Ok(at) = shares.binary_search_by_key(&node, |&(node, _)| node) {
                        shares[at].1 += part;
                    }
                }
            }
        }
        _ => shares.iter_mut().for_each(|(_, share)| *share = 1.0),
    }
    let sum: f64 = shares.iter().map(|(_, share)| share).sum();
    Ok(What::Given(shares.into_iter().map(|(node, share)| (node, force.map(|component| component * share / sum))).collect()))
}
