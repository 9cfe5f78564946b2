//! Rigid plane wall: the paper's rigid contact element. It acts on nodes only, with a penalty spring where a node is behind it.

use crate::contact::springs::{Spring, Springs};
use std::ops::Range;

/// A wall and the nodes that can't cross it.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Name.
    pub name: String,
    /// A point of the wall, m.
    pub point: [f64; 2],
    /// Unit normal that points to the free side.
    pub normal: [f64; 2],
    /// Nodes, with their spring stiffness, N/m per metre of depth.
    pub nodes: Vec<(u32, f64)>,
    /// Force of the wall on the bodies, N/m.
    pub resultant: [f64; 2],
    /// Energy of its springs, J/m.
    pub energy: f64,
    /// Work of its forces in the last velocity update, J/m.
    pub work: f64,
    /// Deepest penetration in the last evaluation, m.
    pub penetration: f64,
    /// Nodes within this distance get a spring, m.
    reach: f64,
    /// Where its springs of this step lie in the list of all.
    found: Range<usize>,
}

impl Wall {
    /// A wall that has not acted yet; `reach` is a fraction of the nodes' spacing, m.
    #[must_use]
    pub fn new(name: String, point: [f64; 2], normal: [f64; 2], nodes: Vec<(u32, f64)>, reach: f64) -> Self {
        Self { name, point, normal, nodes, resultant: [0.0; 2], energy: 0.0, penetration: 0.0, work: 0.0, reach, found: 0..0 }
    }

    /// Adds the springs of the step: of nodes that are behind the wall or will soon be.
    pub fn detect(&mut self, old: &[[f64; 2]], new: &[[f64; 2]], springs: &mut Springs) {
        self.penetration = 0.0;
        let first = springs.list.len();
        let gap_at = |x: [f64; 2]| (x[0] - self.point[0]) * self.normal[0] + (x[1] - self.point[1]) * self.normal[1];
        for &(node, stiffness) in &self.nodes {
            let gap = gap_at(new[node as usize]);
            // Well before it touches: a spring that closes unseen would give back what it never took.
            if gap <= self.reach + 4.0 * (gap - gap_at(old[node as usize])).abs() {
                let (nodes, shares) = ([node; 3], [1.0, 0.0, 0.0]);
                springs.list.push(Spring { nodes, shares, normal: self.normal, gap, stiffness, ..Spring::default() });
                self.penetration = self.penetration.max(-gap);
            }
        }
        self.found = first..springs.list.len();
    }

    /// Sums up the solved springs: adds their forces to `forces`, keeps resultant, energy and work.
    pub fn collect(&mut self, springs: &Springs, forces: &mut [[f64; 2]]) {
        (self.resultant, self.energy, self.work) = ([0.0; 2], 0.0, 0.0);
        for spring in &springs.list[self.found.clone()] {
            self.energy += spring.energy;
            self.work += spring.work;
            for d in 0..2 {
                let force = spring.force * self.normal[d];
                self.resultant[d] += force;
                forces[spring.nodes[0] as usize][d] += force;
            }
        }
    }
}
