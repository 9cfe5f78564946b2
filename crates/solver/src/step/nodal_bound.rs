//! The stable step by nodes: a bound of the largest frequency of the assembled mesh.
//!
//! The stiffness of an element is at most k_e 1, k_e = 4 m_c / dt_e² with the mass m_c of its lightest corner
//! and its own stable step, so that of the mesh is at most the diagonal matrix of the sums of k_e at each
//! node:
//!
//! ω² ≤ max_i (Σ_{e at i} k_e) / m_i, dt = 2/ω, with the whole mass m_i of the node.
//!
//! That is a mean of the elements' squares of frequencies at a node, weighted by masses: never more than the
//! largest of them. It is longer than the step by elements where bad elements lie among good ones, where
//! sizes differ, and where corners of an element are not equally heavy. What damps an element lags behind:
//! K_e + (2/dt) D_e ≤ k_e max(1, dt_e/dt) 1, so that k_e of such elements is 4 m_c / (dt_e dt) with the step
//! by elements for dt.
//!
//! The sums are not made in every step. With the least ratio r ≤ dt_e²/dt_e²(then) over all elements, k_e ≤
//! k_e(then) / r at each of them, so dt² ≥ r dt²(then): elements report r, and sums are made again when the
//! step would be cut; where they gained less than a hundredth, not for a hundred steps. Nodes of rigid bodies
//! count with what their elements weigh.

use super::{Governor, System};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::block::Report;
use crate::dimension::Dimension;
use crate::reductions;
use crate::tensor::Dim;

/// Squares of steps that differ by less are the same but for rounding.
const LONGER: f64 = 1.0 + 1e-9;

/// Squares of steps by nodes over those by elements below which sums are not worth it, and the steps for
/// which none are made then.
const WORTH: f64 = 1.02;
const REST: u32 = 100;

/// The stable step by nodes when the sums were made last.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodalBound {
    /// Its square, s²; 0: not yet.
    squared: f64,
    /// Node that sets it.
    node: u32,
    /// Steps for which no sums are made.
    rest: u32,
    /// Of each node the sum of k_e, N/m, and of the masses of the corners, kg/m.
    sums: Vec<[f64; 2]>,
}

impl Persist for NodalBound {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { squared, node, rest, sums: _ } = self;
        persist_each!(archive; squared, node, rest);
        archive.check((*node as usize) < archive.nodes, "a node that there is not")
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Square of the stable step, s², by elements, by nodes or by the assembled mesh, whatever is longer, and
    /// who sets it.
    pub(super) fn stable_step_squared(&mut self, elements: &Report) -> (f64, Governor) {
        let by_elements = (elements.time_step_squared, Governor::Element(elements.time_step_squared));
        if let Some(by_mesh) = self.squared_by_assembled_mesh(elements).filter(|(squared, _)| *squared > by_elements.0) {
            return by_mesh;
        }
        let Some(mut bound) = self.nodal_bound.take() else { return by_elements };
        let change = reductions::min(self.reports.iter().map(|report| report.step_change));
        let mut squared = self.with_springs(bound.squared * change);
        let is_cut = self.limits.safety * squared.sqrt() < self.time_step_old;
        bound.rest = bound.rest.saturating_sub(1);
        if bound.squared == 0.0 || (is_cut && bound.rest == 0) {
            (bound.squared, bound.node) = self.squared_by_nodes(&mut bound.sums);
            squared = self.with_springs(bound.squared);
            self.mark_time_steps();
            bound.rest = if squared > WORTH * by_elements.0 { 0 } else { REST };
        }
        let by_nodes = (squared, Governor::Node(bound.node));
        self.nodal_bound = Some(bound);
        if squared.is_finite() && squared > by_elements.0 { by_nodes } else { by_elements }
    }

    /// Lets all elements that are strained report from here on how their steps change.
    pub(super) fn mark_time_steps(&mut self) {
        let strained = self.blocks.iter_mut().zip(&self.rigid).filter(|(_, rigid)| !**rigid);
        strained.for_each(|(block, _)| block.mark_time_steps());
    }

    /// Square of the stable step by nodes, s², as elements are now, and the node that sets it; infinite
    /// without elements. `sums` is memory to work in.
    pub(super) fn squared_by_nodes(&self, sums: &mut Vec<[f64; 2]>) -> (f64, u32) {
        let shortest = reductions::min(self.reports.iter().map(|report| report.time_step_squared)).sqrt();
        sums.clear();
        sums.resize(self.positions.len(), [0.0; 2]);
        for (index, block) in self.blocks.iter().enumerate() {
            if self.rigid[index] || self.is_gone(index) {
                continue;
            }
            block.bound_stiffness(shortest, &mut |node, stiffness, mass| {
                let sum = &mut sums[node as usize];
                *sum = [sum[0] + stiffness, sum[1] + mass];
            });
        }
        let mut least = (f64::INFINITY, 0);
        for (node, &[stiffness, mass]) in (0..).zip(&*sums) {
            let mass = if self.bodies.of_node(node).is_some() { mass } else { self.mass[node as usize] };
            let squared = 4.0 * mass / stiffness;
            if stiffness > 0.0 && !(squared >= least.0) {
                least = (squared, node);
            }
        }
        least
    }

    /// The first step by nodes, `safety` included, s, and who sets it, in words; `None` where it is not
    /// longer than that by elements.
    pub(crate) fn step_by_nodes(&self) -> Option<(f64, String)> {
        let (squared, node) = self.squared_by_nodes(&mut Vec::new());
        let squared = self.with_springs(squared);
        let is_longer = squared.is_finite() && squared > LONGER * self.joined_reports().time_step_squared;
        is_longer.then(|| (self.limits.safety * squared.sqrt(), self.governor_name(Governor::Node(node))))
    }
}
