//! What contacts leave on the surfaces: sliding distance and friction heat of every node, and pressure, gap
//! and status at an output time.
//!
//! Springs come solved; fields go to the record. Each spring stands for a length of surface on both sides,
//! and a node has its shares of the springs at it.

use super::Origins;
use super::springs::{Answer, Springs};
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::contact::springs::TangentSpace;
use crate::contact_forces::ContactForces;
use crate::energy::Lost;
use crate::mesh::surface::tributary::{Depth, shares, vector_shares};
use crate::mesh::surface::{Corners, Sided, Surface};
use crate::tensor::{Dim, dot};

/// Sums over the run, and the outside that they belong to.
#[derive(Clone, Debug)]
pub struct Traces<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    outside: Surface<D>,
    depth: Depth,
    /// Initial area of surface at each node, m (of an axisymmetric body m²); zero inside.
    area: Vec<f64>,
    /// Sliding distance of each node, m.
    slip: Vec<f64>,
    /// Friction work taken at each node, J/m.
    heat: Vec<f64>,
}

impl State {
    /// Of a node where nothing is near.
    pub const OPEN: Self = Self { gap: f64::NAN, status: 0.0 };
}

/// State of the surface at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Mean gap of the springs at the node by their shares, m; NaN where there is none. Of a node that is
    /// inside a body without a closed spring: minus its distance to the body's surface when the bodies were
    /// last looked at.
    pub gap: f64,
    /// 0 open, 1 stick, 2 slip (also without friction).
    pub status: f64,
}

impl<const D: usize> Default for Traces<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        Self { outside: Surface::<D>::default(), depth: Depth::default(), area: Vec::new(), slip: Vec::new(), heat: Vec::new() }
    }
}

impl<const D: usize> Persist for Traces<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { outside: _, depth: _, area: _, slip, heat } = self;
        slip[..].persist(archive)?;
        heat[..].persist(archive)
    }
}

impl Traces<3> {
    /// Contact pressure and shear stress (Pa) of every node, from the contact forces on the nodes (N) at
    /// their current positions: −f·n and |f + p n A| by current area A, n the normal of the surface at the
    /// node. In pairs, as far as the nodes of the surface go; zero inside.
    #[must_use]
    pub fn tractions(&self, forces: &ContactForces<3>, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
        let nodes = self.nodes();
        let mut normals = vec![[0.0; 3]; nodes];
        let mut area = vec![0.0; nodes];
        for &facet in self.outside.facets() {
            let vectors = vector_shares(facet.map(|node| positions[node as usize]), facet.corners().len() == 3);
            for ((node, share), vector) in shares::<3>(self.depth, facet, positions).zip(vectors) {
                (0..3).for_each(|d| normals[node as usize][d] += vector[d]);
                area[node as usize] += share;
            }
        }
        let traction = |((node, &normal), area): ((usize, &[f64; 3]), &f64)| {
            let norm = dot(normal, normal).sqrt();
            if norm == 0.0 {
                return [0.0; 2];
            }
            let (force, normal) = (forces.of(node), normal.map(|n| n / norm));
            let across = dot(force, normal);
            let along = [0, 1, 2].map(|d| force[d] - across * normal[d]);
            [-across / area, dot(along, along).sqrt() / area]
        };
        normals.iter().enumerate().zip(&area).map(traction).collect()
    }
}

impl Traces<2> {
    /// Contact pressure and shear stress (Pa) of every node, from the contact forces on the nodes (N/m) at
    /// their current positions: −f·n and f·t by current area, t along the surface with the body on its right.
    /// In pairs, as far as the nodes of the surface go; zero inside.
    #[must_use]
    pub fn tractions(&self, forces: &ContactForces<2>, positions: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let nodes = self.nodes();
        let mut along = vec![[0.0; 2]; nodes];
        let mut area = vec![0.0; nodes];
        for &segment in &self.outside.segments {
            let ends @ [a, b] = segment.map(|node| positions[node as usize]);
            let length = super::length(segment, positions);
            for (node, share) in segment.into_iter().zip(self.depth.shares(ends)) {
                let part = if length > 0.0 { share / length } else { 0.0 };
                along[node as usize][0] += part * (b[0] - a[0]);
                along[node as usize][1] += part * (b[1] - a[1]);
                area[node as usize] += share;
            }
        }
        let traction = |((node, t), area): ((usize, &[f64; 2]), &f64)| {
            let norm = (t[0] * t[0] + t[1] * t[1]).sqrt();
            if norm == 0.0 {
                return [0.0; 2];
            }
            let (f, per) = (forces.of(node), 1.0 / (norm * area));
            // n = (−t₂, t₁)
            [(f[0] * t[1] - f[1] * t[0]) * per, (f[0] * t[0] + f[1] * t[1]) * per]
        };
        along.iter().enumerate().zip(&area).map(traction).collect()
    }
}

impl<const D: usize> Traces<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// For `outside`, the outside of all bodies; `positions` are the initial ones. Of a model without
    /// contacts both are empty: nothing is remembered.
    #[must_use]
    pub fn new(outside: Surface<D>, positions: &[[f64; D]], depth: Depth) -> Self {
        let mut area = vec![0.0; positions.len()];
        for &facet in outside.facets() {
            shares::<D>(depth, facet, positions).for_each(|(node, share)| area[node as usize] += share);
        }
        Self { outside, depth, area, slip: vec![0.0; positions.len()], heat: vec![0.0; positions.len()] }
    }

    /// Continues with another outside; `positions` are the initial ones. Sums stay with the nodes.
    pub fn renew(&mut self, outside: Surface<D>, positions: &[[f64; D]]) {
        let Self { slip, heat, depth, .. } = std::mem::take(self);
        *self = Self { slip, heat, ..Self::new(outside, positions, depth) };
    }

    /// Takes over what contacts left at the old nodes that each node lies between: by surface, what lies
    /// between is a mean.
    pub(crate) fn carry(&mut self, old: &Self, origins: &Origins<'_, D>) {
        for (node, (slip, heat)) in self.slip.iter_mut().zip(&mut self.heat).enumerate() {
            let Some(origin) = origins.nodes.get(node).filter(|_| self.area[node] > 0.0) else { continue };
            *slip = origin.iter().map(|&(from, share)| share * old.slip(from as usize)).sum();
            *heat = origin.iter().map(|&(from, share)| share * old.heat(from as usize)).sum::<f64>() * self.area[node];
        }
    }

    /// Adds what a solved spring does in the coming update, which takes `lost` from the motion.
    pub fn mark(&mut self, answer: &Answer<'_, D>, lost: &Lost) {
        if answer.solved.force == 0.0 {
            return;
        }
        let slid = answer.slides_by() * answer.spring.area;
        for end in answer.ends() {
            let (node, share) = (end.at as usize, end.share.abs());
            if let (Some(slip), Some(heat)) = (self.slip.get_mut(node), self.heat.get_mut(node)) {
                if self.area[node] > 0.0 {
                    *slip += share * slid / self.area[node];
                }
                *heat += 0.5 * share * lost.friction;
            }
        }
    }

    /// Sliding distance of a node, m.
    #[must_use]
    pub fn slip(&self, node: usize) -> f64 {
        self.slip.get(node).copied().unwrap_or_default()
    }

    /// Friction work taken at a node by initial surface, J/m².
    #[must_use]
    pub fn heat(&self, node: usize) -> f64 {
        self.area.get(node).filter(|&&area| area > 0.0).map_or(0.0, |area| self.heat[node] / area)
    }

    /// Number behind the last node of the surface: nodes on outlines come first.
    fn nodes(&self) -> usize {
        self.outside.nodes().last().map_or(0, |&node| node as usize + 1)
    }

    /// State of nodes from the solved springs of the step, as far as any of the first `nodes` has one, and of
    /// nodes that are `inside` a body by so much, m: those beyond are open.
    #[must_use]
    pub fn states<'a>(springs: &Springs<D>, nodes: usize, inside: impl Iterator<Item = &'a (u32, f64)>) -> Vec<State> {
        let ends = || springs.list.iter().flat_map(|spring| springs.ends(spring)).map(|end| end.at as usize);
        let mut sums = vec![(0.0, 0.0, 0.0f64); ends().filter(|&at| at < nodes).max().map_or(0, |last| last + 1)];
        for answer in springs.answers(0..springs.list.len()) {
            let Answer { spring, solved, .. } = answer;
            let status = if solved.force == 0.0 { 0.0 } else { 1.0 + f64::from(u8::from(answer.slid().slides)) };
            for end in springs.ends(spring) {
                if let Some((gap, share, most)) = sums.get_mut(end.at as usize) {
                    *gap += end.share.abs() * solved.gap;
                    *share += end.share.abs();
                    if end.share != 0.0 {
                        *most = most.max(status);
                    }
                }
            }
        }
        let state = |(gap, share, status)| State { gap: if share > 0.0 { gap / share } else { f64::NAN }, status };
        let mut states: Vec<State> = sums.into_iter().map(state).collect();
        for &(node, depth) in inside {
            let node = node as usize;
            if node >= states.len() && node < nodes {
                states.resize(node + 1, State::OPEN);
            }
            if let Some(state) = states.get_mut(node).filter(|state| !(state.gap < 0.0)) {
                state.gap = -depth;
            }
        }
        states
    }
}

/// Contact pressure and shear stress by dimension.
pub trait Tractions<const D: usize>: TangentSpace<D> {
    /// Pressure and shear stress of every node, Pa.
    fn tractions(traces: &Traces<D>, forces: &ContactForces<D>, positions: &[[f64; D]]) -> Vec<[f64; 2]>
    where
        Dim<D>: TangentSpace<D>;
}

impl Tractions<2> for Dim<2> {
    fn tractions(traces: &Traces<2>, forces: &ContactForces<2>, positions: &[[f64; 2]]) -> Vec<[f64; 2]> {
        traces.tractions(forces, positions)
    }
}

impl Tractions<3> for Dim<3> {
    fn tractions(traces: &Traces<3>, forces: &ContactForces<3>, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
        traces.tractions(forces, positions)
    }
}
