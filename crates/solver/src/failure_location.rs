//! Failure locations: names elements, nodes and contacts with their positions, for errors, progress and the
//! summary. Called rarely.

use crate::contact::Contact;
use crate::contact::findings::{Findings, Overlap};
use crate::dimension::Dimension;
use crate::error::Error;
use crate::mesh::ElementGroup;
use crate::mesh::geometry::CellGeometry;
use crate::step::{Governor, System};
use crate::tensor::Dim;
use crate::vector::{dot, place, plus};

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Who sets the time step, in words.
    pub(crate) fn governor_name(&self, governor: Governor) -> String {
        match governor {
            Governor::Element(squared) => self.element_with_step(squared),
            Governor::Node(node) => format!("the elements at {}", self.node_place(node as usize)),
            Governor::Assembled(node) => format!("the assembled mesh, fastest at {}", self.node_place(node as usize)),
            Governor::Cavity(number) => {
                let name = self.cavities.iter().nth(number as usize).map_or("", |cavity| &cavity.name);
                format!("the gas of cavity \"{name}\"")
            }
            Governor::Given => "`run.time_step`".into(),
            Governor::Contact => "bodies that come at each other fast".into(),
            Governor::Schedule => "the step before".into(),
        }
    }

    /// Who sets the time step, in words; while it grows, or leads to the end of the run, who will set it, or
    /// would.
    pub(crate) fn governor_in_words(&self) -> String {
        self.governor_name(if self.governor == Governor::Schedule { self.bound_by } else { self.governor })
    }

    /// Where the element is that sets the time step, m, if one does.
    pub(crate) fn governor_place(&self) -> Option<[f64; D]> {
        let governor = if self.governor == Governor::Schedule { self.bound_by } else { self.governor };
        let Governor::Element(squared) = governor else { return None };
        let (g, element) = self.governing_element(squared)?;
        Some(self.centre(self.mesh.groups[g].nodes_of(element)))
    }

    /// An element by group and number, with its part and place, in words.
    pub(crate) fn element_name(&self, g: usize, element: usize) -> String {
        let group = &self.mesh.groups[g];
        let at = place(self.centre(group.nodes_of(element)));
        format!("element {} of part \"{}\" {at}", group.user_elements[element], self.mesh.parts[group.part].name)
    }

    fn element_with_step(&self, squared: f64) -> String {
        if let Some((g, element)) = self.governing_element(squared) {
            return self.element_name(g, element);
        }
        let what = if self.has_springs { "springs and the elements that they hold" } else { "an element" };
        what.into()
    }

    /// The element, by group and number, whose squared step this is.
    pub(crate) fn governing_element(&self, squared: f64) -> Option<(usize, usize)> {
        self.blocks.iter().enumerate().find_map(|(g, block)| block.governing_element(squared).map(|element| (g, element)))
    }

    /// Squares of the stable steps of the live elements in the groups that are `wanted` and strained, s²,
    /// with the group and the number in it.
    pub(crate) fn element_steps(&self, wanted: impl Fn(&ElementGroup) -> bool) -> impl Iterator<Item = (f64, usize, usize)> {
        let groups = self.mesh.groups.iter().zip(&self.blocks).enumerate().filter(move |(g, (group, _))| !self.rigid[*g] && wanted(group));
        groups.flat_map(|(g, (group, block))| {
            let live = (0..group.elements()).filter(|&element| group.is_alive(element));
            live.map(move |element| (block.time_step_squared(element), g, element))
        })
    }

    pub(crate) fn centre(&self, nodes: &[u32]) -> [f64; D] {
        let sum = nodes.iter().fold([0.0; D], |sum, &node| plus(sum, self.positions[node as usize]));
        sum.map(|component| component / nodes.len() as f64)
    }

    pub(crate) fn inverted(&self) -> Error {
        let (g, element) = self.most_inverted();
        let group = &self.mesh.groups[g];
        let at = self.centre(group.nodes_of(element)).to_vec();
        let (part, element) = (self.mesh.parts[group.part].name.clone(), group.user_elements[element] as usize);
        Error::Inverted { part, element, at, time: self.time, step: self.step }
    }

    /// The element, by group and number, that is most inside out. The Jacobian of a quadrilateral is smallest
    /// in a corner.
    pub(crate) fn most_inverted(&self) -> (usize, usize) {
        let mut worst = (f64::INFINITY, 0, 0);
        for (g, (group, block)) in self.mesh.groups.iter().zip(&self.blocks).enumerate() {
            for (element, cell) in group.cells().enumerate().filter(|(element, _)| group.is_alive(*element)) {
                let corners = <Dim<D>>::min_corner_jacobian(cell, &self.positions).unwrap_or_else(|| {
                    let determinant = block.determinant(element, &self.positions);
                    if cell.kind.dimension() == 1 && determinant <= 0.0 { f64::NEG_INFINITY } else { determinant }
                });
                if corners < worst.0 {
                    worst = (corners, g, element);
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
        let square = |v: &[f64; D]| dot(*v, *v);
        self.velocities.iter().enumerate().max_by(|(_, a), (_, b)| square(a).total_cmp(&square(b))).map(|(node, _)| node)
    }

    /// The fastest of all nodes.
    pub(crate) fn runaway(&self) -> Error {
        let node = self.fastest_node().unwrap_or(0);
        Error::Runaway { place: self.node_place(node), speed: self.speed, limit: self.limits.velocity, time: self.time, step: self.step }
    }

    /// The node of a contact that is deepest inside, and how deep, m: of a body that has gone through
    /// another, a node there.
    pub(crate) fn deepest(&self, contact: &Contact<D>) -> Option<(usize, f64)> {
        if let Some(through) = contact.gone_through().filter(|_| self.limits.is_local) {
            return Some((through.nodes[0] as usize, through.depth));
        }
        let deepest = contact.penetrations(&self.springs).map(|(_, depth)| depth).fold(0.0, f64::max);
        // Of nodes that are equally deep to the digits that are reported, such as those of both bodies, the
        // fastest: what moves is what to look at.
        let equal = contact.penetrations(&self.springs).filter(|&(_, depth)| depth >= (1.0 - 1e-3) * deepest);
        let speed = |node: u32| self.velocities.get(node as usize).map_or(0.0, |&v| dot(v, v));
        equal.max_by(|&(a, _), &(b, _)| speed(a).total_cmp(&speed(b))).map(|(node, depth)| (node as usize, depth))
    }

    /// The contact that is too deep, at its deepest node.
    pub(crate) fn too_deep(&self, contact: &Contact<D>) -> Error {
        let (node, depth) = self.deepest(contact).unwrap_or((0, contact.penetration));
        Error::TooDeep {
            contact: format!("{} \"{}\"", contact.kind.name(), contact.name).into(),
            place: self.node_place(node).into(),
            depth,
            limit: contact.gone_through().filter(|_| self.limits.is_local).map_or(self.limits.penetration, |through| through.thickness),
            time: self.time,
            step: self.step,
        }
    }

    /// Where bodies in contact overlapped without being held, first and worst, in words.
    pub(crate) fn overlaps_in_words(&self, contact: &Contact<D>, found: &Findings) -> Option<String> {
        let of = |node: u32| self.mesh.parts.iter().find(|part| part.with_faces().any(|own| own == node)).map(|part| &part.name);
        let who = |nodes: [u32; 2]| match nodes.map(of) {
            [Some(a), Some(b)] => format!("parts \"{a}\" and \"{b}\""),
            [Some(part), None] | [None, Some(part)] => format!("part \"{part}\" in the obstacle"),
            [None, None] => "the obstacle".into(),
        };
        let words = |Overlap { place: at, depth, thickness, nodes, time }: Overlap| {
            let who = who(nodes);
            let at = at.map(|c| format!("{c:.4e}")).join(", ");
            format!("{depth:.3e} m deep where the bodies are {thickness:.3e} m thick, {who} at ({at}), {time:.4e} s")
        };
        let first = found.first?;
        let Contact { kind, name, .. } = contact;
        Some(format!("; {} \"{name}\": first {}; worst {}", kind.name(), words(first), words(found.worst)))
    }

    /// A node and where it is.
    fn node_place(&self, node: usize) -> String {
        format!("{} at {}", self.node_name(node), place(self.positions[node]))
    }

    /// A node by the user's number, and the parts that it belongs to.
    fn node_name(&self, node: usize) -> String {
        let Some(user) = self.mesh.user_nodes.get(node) else { return "a point of an obstacle".into() };
        let parts = self.mesh.parts.iter().filter(|part| part.with_faces().any(|own| own == node as u32));
        let parts: Vec<_> = parts.map(|part| format!("\"{}\"", part.name)).collect();
        format!("node {user} of part {}", parts.join(" and "))
    }

    pub(crate) fn not_finite(&self) -> Error {
        let bad = self.node_not_finite();
        let (what, place) = match bad {
            Some(node) => {
                // Positions of the step before are there as long as those of this one are not.
                let is_seen = self.positions[node].iter().all(|x| x.is_finite());
                let at = place(if is_seen { self.positions[node] } else { self.positions_old[node] });
                let name = self.node_name(node);
                ("the motion of a node".to_string(), format!("{name}, last seen at {at}"))
            }
            None => ("an energy".to_string(), "no node is affected yet".to_string()),
        };
        Error::NotFinite { what, place, time: self.time, step: self.step }
    }
}
