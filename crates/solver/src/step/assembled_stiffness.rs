//! The stiffness of the assembled mesh, as its product with a motion of the nodes.
//!
//! The elements are made again as those of an elastic body ([`crate::block::Elastic`]); what pulls on the
//! nodes after a small motion u, less what pulls before, is −K u. Where something damps, they go there in a
//! time τ and back in the same time: the difference of both pulls is (K + D/τ) u with bulk viscosity, which
//! acts on elements that shrink, on one of the two ways, and (K + 2D/τ) u with other damping. So with half of
//! a step dt for τ it is K + (2/dt) D, or more.

use super::System;
use crate::assembly::Assembly;
use crate::block::{Block, ElasticInput, Motion, NodalForces};
use crate::dimension::Dimension;
use crate::random::Random;
use crate::tensor::Dim;
use embate_lanes::{Level, Team};

/// Largest strain of an element in a product.
const STRAIN: f64 = 1e-6;

/// The elements of some blocks in a form, as an elastic body; its nodes in an order of their own.
pub(super) struct AssembledStiffness<const D: usize> {
    blocks: Vec<Box<dyn Block<D>>>,
    assembly: Assembly,
    /// Nodes of the mesh.
    nodes: Vec<u32>,
    /// 1/√m of each, (kg/m)^−½.
    inverse_roots: Vec<f64>,
    form: Vec<[f64; D]>,
    /// Where the nodes are, and what velocities lead to the next place.
    at: Vec<[f64; D]>,
    next: Vec<[f64; D]>,
    velocities: Vec<[f64; D]>,
    slots: Vec<[f64; D]>,
    /// What pulls in the form, or after the way there.
    pulls: Vec<[f64; D]>,
    /// Largest way of a node, m.
    way: f64,
    /// Time of a way where something damps, s.
    time: Option<f64>,
    level: Level,
}

/// What damps the elements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Damped {
    /// Linear coefficient of the bulk viscosity.
    pub(super) viscosity: f64,
    /// Time of the way there, and of that back, s; `None`: nothing damps.
    pub(super) time: Option<f64>,
}

impl<const D: usize> AssembledStiffness<D>
where
    Dim<D>: Dimension<D>,
{
    /// The live elements of those blocks of a system, as it is, with the masses of nodes of the mesh;
    /// `slope` is the largest of their nodal gradients, 1/m. `None` where one of them is no elastic body.
    pub(super) fn new(
        system: &System<D>,
        blocks: &[usize],
        masses: &[f64],
        slope: f64,
        Damped { viscosity, time }: Damped,
    ) -> Option<Self> {
        let positions = &system.positions;
        let mut place = vec![u32::MAX; positions.len()];
        for &block in blocks {
            system.mesh.groups[block].live_cells().flat_map(|cell| cell.nodes).for_each(|&node| place[node as usize] = 0);
        }
        let nodes: Vec<u32> = (0..positions.len() as u32).filter(|&node| place[node as usize] == 0).collect();
        (0..).zip(&nodes).for_each(|(local, &node)| place[node as usize] = local);
        let form: Vec<[f64; D]> = nodes.iter().map(|&node| positions[node as usize]).collect();
        let made = |&block: &usize| {
            let group = &system.mesh.groups[block];
            let elements: Vec<u32> =
                (0..group.elements()).filter(|&element| group.is_alive(element)).map(|element| element as u32).collect();
            let corners = elements.iter().flat_map(|&element| group.nodes_of(element as usize));
            let connectivity: Vec<u32> = corners.map(|&node| place[node as usize]).collect();
            let input = ElasticInput { elements: &elements, connectivity: &connectivity, positions: &form, viscosity };
            system.blocks[block].elastic()?.made(&input, system.level)
        };
        let blocks: Vec<Box<dyn Block<D>>> = blocks.iter().map(made).collect::<Option<_>>()?;
        let assembly = Assembly::new(nodes.len(), &blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
        let none = || vec![[0.0; D]; nodes.len()];
        let mut stiffness = Self {
            slots: vec![[0.0; D]; assembly.count],
            inverse_roots: nodes.iter().map(|&node| 1.0 / masses[node as usize].sqrt()).collect(),
            at: form.clone(),
            next: form.clone(),
            velocities: none(),
            pulls: none(),
            way: STRAIN / slope,
            time,
            level: system.level,
            blocks,
            assembly,
            nodes,
            form,
        };
        // What hourglass control holds in the form.
        stiffness.go(1.0, &mut Team::alone());
        stiffness.note();
        Some(stiffness)
    }

    /// A motion of random direction, the same for a node of the mesh in any order; `number` is that of the
    /// question.
    pub(super) fn random(&self, number: u64) -> Vec<f64> {
        let of = |&node: &u32| {
            let mut random = Random::apart(u64::from(node) + (number << 32));
            std::array::from_fn::<f64, D, _>(|_| random.normal())
        };
        self.nodes.iter().flat_map(of).collect()
    }

    /// Goes from where the nodes are to `next` in a time.
    fn go(&mut self, time: f64, team: &mut Team) {
        for ((v, next), at) in self.velocities.iter_mut().zip(&self.next).zip(&self.at) {
            *v = std::array::from_fn(|d| (next[d] - at[d]) / time);
        }
        let motion = Motion::new(&self.next, &self.velocities, time);
        let mut rest = &mut self.slots[..];
        for block in &mut self.blocks {
            let (own, others) = rest.split_at_mut(block.slots().len());
            block.advance(&motion, self.level, NodalForces::new(own), team);
            rest = others;
        }
        self.at.clone_from(&self.next);
    }

    /// M^−½ (K + (2/dt) D) M^−½ q.
    pub(super) fn multiply(&mut self, q: &[f64], product: &mut [f64], team: &mut Team) {
        let largest = q
            .chunks_exact(D)
            .zip(&self.inverse_roots)
            .fold(0.0, |largest, (q, root)| q.iter().fold(largest, |largest, q| f64::max(largest, (q * root).abs())));
        let scale = self.way / largest;
        let time = self.time.unwrap_or(1.0);
        for (((next, form), q), root) in self.next.iter_mut().zip(&self.form).zip(q.chunks_exact(D)).zip(&self.inverse_roots) {
            *next = std::array::from_fn(|d| form[d] + scale * (q[d] * root));
        }
        self.go(time, team);
        let mut sign = -1.0 / scale;
        if self.time.is_some() {
            self.note();
            self.next.clone_from(&self.form);
            self.go(time, team);
            sign = -sign;
        }
        for (node, (product, pull)) in product.chunks_exact_mut(D).zip(&self.pulls).enumerate() {
            let now = self.assembly.force(node, &self.slots);
            let factor = sign * self.inverse_roots[node];
            (0..D).for_each(|d| product[d] = factor * (now[d] - pull[d]));
        }
    }

    /// Keeps what pulls on the nodes.
    fn note(&mut self) {
        for (node, pull) in self.pulls.iter_mut().enumerate() {
            *pull = self.assembly.force(node, &self.slots);
        }
    }

    /// The node of the mesh that moves most in M^½ u = `q`.
    pub(super) fn fastest(&self, q: &[f64]) -> Option<u32> {
        let square = |k: usize| q[k * D..(k + 1) * D].iter().map(|q| (q * self.inverse_roots[k]).powi(2)).sum::<f64>();
        (0..self.nodes.len()).max_by(|&a, &b| square(a).total_cmp(&square(b)).then(b.cmp(&a))).map(|k| self.nodes[k])
    }
}
