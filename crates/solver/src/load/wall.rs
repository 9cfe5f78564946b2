//! Rigid plane wall: the paper's rigid contact element. It acts on nodes only, with a penalty spring where a node is behind it.

use crate::time::stable::Springs;

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
    /// Deepest penetration in the last evaluation, m.
    pub penetration: f64,
    active: Vec<(u32, [f64; 2])>,
}

impl Wall {
    /// A wall that has not acted yet.
    #[must_use]
    pub fn new(name: String, point: [f64; 2], normal: [f64; 2], nodes: Vec<(u32, f64)>) -> Self {
        Self { name, point, normal, nodes, resultant: [0.0; 2], energy: 0.0, penetration: 0.0, active: Vec::new() }
    }

    /// Adds the forces on nodes behind the wall to `forces`, and the springs of those and of nodes that will soon be, to `springs`.
    pub fn evaluate(&mut self, old: &[[f64; 2]], new: &[[f64; 2]], forces: &mut [[f64; 2]], springs: &mut Springs) {
        (self.resultant, self.energy, self.penetration) = ([0.0; 2], 0.0, 0.0);
        self.active.clear();
        let gap_at = |x: [f64; 2]| (x[0] - self.point[0]) * self.normal[0] + (x[1] - self.point[1]) * self.normal[1];
        for &(node, stiffness) in &self.nodes {
            let gap = gap_at(new[node as usize]);
            if gap <= 4.0 * (gap - gap_at(old[node as usize])).abs() {
                springs.add_wall(node, stiffness);
            }
            if gap < 0.0 {
                let force = self.normal.map(|n| -gap * stiffness * n);
                self.active.push((node, force));
                self.energy += 0.5 * stiffness * gap * gap;
                self.penetration = self.penetration.max(-gap);
                for d in 0..2 {
                    forces[node as usize][d] += force[d];
                    self.resultant[d] += force[d];
                }
            }
        }
    }

    /// Power of the wall's forces with node velocities `mean(node)`, W/m.
    pub fn power(&self, mean: impl Fn(usize) -> [f64; 2]) -> f64 {
        let of = |&(node, force): &(u32, [f64; 2])| {
            let v = mean(node as usize);
            force[0] * v[0] + force[1] * v[1]
        };
        self.active.iter().map(of).sum()
    }
}
