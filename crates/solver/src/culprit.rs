//! Who is to blame: names elements, nodes and contacts with their places, for errors, progress and the summary. Called rarely.

use crate::contact::Contact;
use crate::error::Error;
use crate::step::{Governor, System};

impl System {
    /// Who sets the time step, in words.
    pub(crate) fn governor_name(&self, governor: Governor) -> String {
        match governor {
            Governor::Element(squared) => self.element_with_step(squared),
            Governor::Given => "`run.time_step`".into(),
            Governor::Schedule => "growth limit or end of the run".into(),
        }
    }

    fn element_with_step(&self, squared: f64) -> String {
        if let Some((g, element)) = self.governing_element(squared) {
            let group = &self.mesh.groups[g];
            let [x, y] = self.centre(group.cell(element));
            let user = group.user_elements[element];
            return format!("element {user} of part \"{}\" ({x:.6e}, {y:.6e})", self.mesh.parts[group.part].name);
        }
        let what = if self.has_springs { "springs and the elements that they hold" } else { "an element" };
        what.into()
    }

    /// The element, by group and number, whose squared step this is.
    pub(crate) fn governing_element(&self, squared: f64) -> Option<(usize, usize)> {
        self.mesh.groups.iter().zip(&self.blocks).enumerate().find_map(|(g, (_, block))| {
            // NaN equals nothing, so a block whose step is NaN is found by its own failure to compare.
            let governs = |&element: &usize| block.is_alive(element) && block.time_step_squared(element).total_cmp(&squared).is_eq();
            (0..block.elements()).find(governs).map(|element| (g, element))
        })
    }

    pub(crate) fn centre(&self, nodes: &[u32]) -> [f64; 2] {
        let n = nodes.len();
        let sum = nodes.iter().fold([0.0; 2], |s: [f64; 2], &node| {
            let x = self.positions[node as usize];
            [s[0] + x[0], s[1] + x[1]]
        });
        [sum[0] / n as f64, sum[1] / n as f64]
    }

    pub(crate) fn inverted(&self) -> Error {
        let (g, element) = self.most_inverted();
        let group = &self.mesh.groups[g];
        let at = self.centre(group.cell(element)).to_vec();
        let (part, element) = (self.mesh.parts[group.part].name.clone(), group.user_elements[element] as usize);
        Error::Inverted { part, element, at, time: self.time, step: self.step }
    }

    /// The element, by group and number, that is most inside out. The Jacobian of a quadrilateral is smallest in a corner.
    pub(crate) fn most_inverted(&self) -> (usize, usize) {
        let mut worst = (f64::INFINITY, 0, 0);
        for (g, (group, block)) in self.mesh.groups.iter().zip(&self.blocks).enumerate() {
            let n = group.nodes_per_element;
            for (element, cell) in group.cells().enumerate().filter(|(element, _)| group.is_alive(*element)) {
                let x = |corner: usize| self.positions[cell[corner % n] as usize];
                if n == 2 && block.determinant(element, &self.positions) <= 0.0 {
                    worst = (f64::NEG_INFINITY, g, element);
                }
                for c in 0..if n == 2 { 0 } else { n } {
                    let (a, b, d) = (x(c), x(c + 1), x(c + n - 1));
                    let jacobian = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
                    if jacobian < worst.0 {
                        worst = (jacobian, g, element);
                    }
                }
            }
        }
        (worst.1, worst.2)
    }

    pub(crate) fn collapsed(&self, time_step: f64, governor: Governor) -> Error {
        if time_step.is_nan() {
            return self.not_finite();
        }
        Error::Collapsed { time_step, limit: self.limits.step, governor: self.governor_name(governor), time: self.time, step: self.step }
    }

    /// The first node whose place or velocity is no number.
    pub(crate) fn node_not_finite(&self) -> Option<usize> {
        (0..self.positions.len()).find(|&node| !self.positions[node].iter().chain(&self.velocities[node]).all(|v| v.is_finite()))
    }

    pub(crate) fn fastest_node(&self) -> Option<usize> {
        let square = |v: &[f64; 2]| v[0] * v[0] + v[1] * v[1];
        self.velocities.iter().enumerate().max_by(|(_, a), (_, b)| square(a).total_cmp(&square(b))).map(|(node, _)| node)
    }

    /// The fastest of all nodes.
    pub(crate) fn runaway(&self) -> Error {
        let node = self.fastest_node().unwrap_or(0);
        Error::Runaway { place: self.node_place(node), speed: self.speed, limit: self.limits.velocity, time: self.time, step: self.step }
    }

    /// The node of a contact that is deepest inside, and how deep, m.
    pub(crate) fn deepest(&self, contact: &Contact) -> Option<(usize, f64)> {
        let deepest = contact.penetrations(&self.springs).max_by(|(_, a), (_, b)| a.total_cmp(b));
        deepest.map(|(node, depth)| (node as usize, depth))
    }

    /// The contact that is too deep, at its deepest node.
    pub(crate) fn too_deep(&self, contact: &Contact) -> Error {
        let (node, depth) = self.deepest(contact).unwrap_or((0, contact.penetration));
        Error::TooDeep {
            contact: format!("{} \"{}\"", contact.kind.name(), contact.name).into(),
            place: self.node_place(node).into(),
            depth,
            limit: self.limits.penetration,
            time: self.time,
            step: self.step,
        }
    }

    /// A node and where it is.
    fn node_place(&self, node: usize) -> String {
        let [x, y] = self.positions[node];
        format!("{} at ({x:.6e}, {y:.6e})", self.node_name(node))
    }

    /// A node by the user's number, and the parts that it belongs to.
    fn node_name(&self, node: usize) -> String {
        let Some(user) = self.mesh.user_nodes.get(node) else { return "a point of an obstacle".into() };
        let parts = self.mesh.parts.iter().filter(|part| part.nodes.contains(&(node as u32)));
        let parts: Vec<_> = parts.map(|part| format!("\"{}\"", part.name)).collect();
        format!("node {user} of part {}", parts.join(" and "))
    }

    pub(crate) fn not_finite(&self) -> Error {
        let bad = self.node_not_finite();
        let (what, place) = match bad {
            Some(node) => {
                // Positions of the step before are there as long as those of this one are not.
                let is_seen = self.positions[node].iter().all(|x| x.is_finite());
                let [x, y] = if is_seen { self.positions[node] } else { self.positions_old[node] };
                let name = self.node_name(node);
                ("the motion of a node".to_string(), format!("{name}, last seen at ({x:.6e}, {y:.6e})"))
            }
            None => ("an energy".to_string(), "no node is affected yet".to_string()),
        };
        Error::NotFinite { what, place, time: self.time, step: self.step }
    }
}
