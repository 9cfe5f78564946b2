//! Welds and joints of a model: which nodes take part, where the point is, and along which axes they act.

use super::contacts::below;
use super::{Builder, Builds};
use crate::contact::connection::strength::Strength;
use crate::contact::connection::{Connection, Setup, axes_of};
use crate::contact::law::tie::Tie;
use crate::contact::projection::node_facet::place_on_triangle;
use crate::contact::springs::{Tangential, Terms};
use crate::contact::{Contact, ContactKind};
use crate::error::Fault;
use crate::load::messages::{CONNECTION, TO_ITSELF};
use crate::mesh::surface::{Corners, Sided};
use crate::model::Window;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{EXPONENT, Joint, Weld, in_3d};
use crate::tensor::{Dim, cross};
use crate::vector::{dot, length, minus, place, plus, times, unit};
use std::collections::BTreeMap;

/// Nodes that are as near as the last one that is needed, but for this part, take part too.
const SAME: f64 = 1e-6;
/// How many times as far as its nodes are from each other a weld may be from them.
const FAR: f64 = 2.0;

/// A set of a connection.
#[derive(Clone)]
struct Set {
    nodes: Vec<u32>,
    /// Corners of its surface, if it has one.
    facets: Vec<Vec<u32>>,
}

/// Nodes that take part, the nearest point of the surface, and its normal there.
struct Near {
    nodes: Vec<u32>,
    point: [f64; 3],
    normal: Option<[f64; 3]>,
}

impl<const D: usize> Builder<'_, D>
where
    Dim<D>: Builds<D>,
{
    /// All welds, then all joints; notes faults.
    pub(super) fn connections(&mut self) -> Vec<Contact<D>> {
        let model = self.model;
        if model.welds.is_empty() && model.joints.is_empty() {
            return Vec::new();
        }
        let terms =
            self.add_terms(Terms { law: Box::new(Tie { rigid: true, joins_ends: true }), tangential: Tangential::Free, damping: 0.0 });
        let mut sets = BTreeMap::new();
        let mut made = Vec::new();
        for (i, weld) in model.welds.iter().enumerate() {
            for point in 0..weld.at.len() {
                let found = self.weld(weld, point, &mut sets);
                made.push((format!("weld[{i}]"), weld.name_of(point), ContactKind::Weld, found));
            }
        }
        for (i, joint) in model.joints.iter().enumerate() {
            let found = self.joint(joint, &mut sets);
            made.push((format!("joint[{i}]"), joint.name.clone(), ContactKind::Joint, found));
        }
        let mut contacts = Vec::new();
        for (path, name, kind, found) in made {
            match found {
                Ok(connection) => {
                    contacts.push(Contact::new(name, kind, Box::new(connection), terms, Window::between([0.0, f64::INFINITY])))
                }
                Err(fault) => self.faults.push(below(&path, fault)),
            }
        }
        contacts
    }

    /// Lets welds and joints go of nodes without elements.
    pub(super) fn rebuild_connections(&self, contacts: &mut [Contact<D>]) {
        if !contacts.iter().any(|contact| contact.kind.is_connection()) {
            return;
        }
        let has_elements = self.mesh.has_elements();
        let has = |node: u32| has_elements[self.mesh.leader_of(node) as usize];
        contacts.iter_mut().for_each(|contact| contact.lose(&has));
    }

    fn weld(&self, weld: &Weld, number: usize, sets: &mut BTreeMap<String, Set>) -> Result<Connection, Fault> {
        let at = weld.at[number];
        let near = [0, 1].map(|side| {
            let near = self.near(&weld.between[side], at, weld.radius, sets).map_err(|fault| at_side(side, fault))?;
            let size = self.size(&near.nodes);
            let far = length(minus(near.point, at));
            if far > FAR * size {
                let message = format!(
                    "the point {number} is {far:.3e} m away from \"{}\", whose nodes there are {size:.3e} m apart",
                    weld.between[side]
                );
                return Err(Fault::new(&CONNECTION, format!("at[{number}]"), message, "give a point between the two surfaces"));
            }
            Ok(near)
        });
        let [one, other] = near;
        let near = [one?, other?];
        let limits = [weld.normal_strength, weld.shear_strength, weld.moment_strength];
        let normal = weld.normal.or(near[0].normal).or(near[1].normal.map(|normal| times(-1.0, normal))).and_then(unit);
        if normal.is_none() && limits[..2].iter().any(Option::is_some) {
            let message = "no surface says where its normal is";
            return Err(Fault::new(&CONNECTION, "normal", message, "give the direction of the normal force as `normal`"));
        }
        let exponents = std::array::from_fn(|k| weld.exponents.get(k).copied().unwrap_or(EXPONENT));
        let strength = Strength { limits: limits.map(|limit| limit.unwrap_or(f64::INFINITY)), exponents, filter: weld.filter };
        let setup = Setup {
            kind: "fixed".into(),
            at: times(0.5, plus(near[0].point, near[1].point)),
            axes: axes_of(normal.unwrap_or([1.0, 0.0, 0.0]), D),
            strength: limits.iter().any(Option::is_some).then_some(strength),
            nodes: near.map(|near| near.nodes),
        };
        self.connection(setup, &weld.between)
    }

    fn joint(&self, joint: &Joint, sets: &mut BTreeMap<String, Set>) -> Result<Connection, Fault> {
        let mut nodes = [Vec::new(), Vec::new()];
        let count = joint.between.len();
        for (side, name) in joint.between.iter().enumerate() {
            nodes[side + 2 - count] = self.near(name, joint.at, joint.radius, sets).map_err(|fault| at_side(side, fault))?.nodes;
        }
        // In 2D what turns about z has no axis in the plane.
        let axis = if D == 2 && joint.axis[2] != 0.0 { [1.0, 0.0, 0.0] } else { joint.axis };
        let axes = axes_of(unit(axis).unwrap_or([1.0, 0.0, 0.0]), D);
        self.connection(Setup { kind: joint.kind.clone(), nodes, at: joint.at, axes, strength: None }, &joint.between)
    }

    fn connection(&self, setup: Setup, between: &[String]) -> Result<Connection, Fault> {
        if let Some(&node) = setup.nodes[0].iter().find(|node| setup.nodes[1].contains(node)) {
            let at = place(self.mesh.positions[node as usize]);
            let message = format!("the node at {at} m takes part on both sides");
            return Err(Fault::new(&TO_ITSELF, "between", message, "name sets without common nodes, or take a smaller `radius`"));
        }
        let of = setup.nodes.each_ref().map(Vec::len);
        Connection::new(setup, &self.mesh.positions).map_err(|side| {
            let name = &between[(side + between.len()).saturating_sub(2).min(between.len() - 1)];
            let message = format!("the {} nodes of \"{name}\" near its point are on one line: they hold no rigid body", of[side]);
            Fault::new(&CONNECTION, "radius", message, "take a larger `radius`, or leave it out")
        })
    }

    /// Nodes of a set that take part in a connection at a point.
    fn near(&self, name: &str, at: [f64; 3], radius: Option<f64>, sets: &mut BTreeMap<String, Set>) -> Result<Near, Fault> {
        if !sets.contains_key(name) {
            sets.insert(name.to_string(), self.set_of(name)?);
        }
        let set = &sets[name];
        let positions = &self.mesh.positions;
        let mut sorted: Vec<(f64, u32)> =
            set.nodes.iter().map(|&node| (length(minus(in_3d(positions[node as usize]), at)), node)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let count = match radius {
            Some(radius) => sorted.partition_point(|(distance, _)| *distance <= radius),
            None => {
                let holds = |count: &usize| Connection::holds(sorted[..*count].iter().map(|&(_, node)| node).collect(), positions);
                let least = (D..=sorted.len()).find(holds).unwrap_or(sorted.len());
                let farthest = sorted.get(least - 1).map_or(0.0, |last| last.0 * (1.0 + SAME));
                sorted.partition_point(|(distance, _)| *distance <= farthest)
            }
        };
        if count < D {
            let nearest = sorted.first().map_or(0.0, |first| first.0);
            let message = format!("only {count} nodes of \"{name}\" take part: the nearest is {nearest:.3e} m away from the point");
            return Err(Fault::new(&CONNECTION, "radius", message, "take a larger `radius`, or leave it out; or name a larger set"));
        }
        let mut nodes: Vec<u32> = sorted[..count].iter().map(|&(_, node)| node).collect();
        nodes.sort_unstable();
        let closest = set.facets.iter().map(|facet| closest(facet, positions, at));
        let (point, normal) = match closest.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, point, normal)) => (point, normal),
            None => (sorted.first().map_or(at, |&(_, node)| in_3d(positions[self.mesh.leader_of(node) as usize])), None),
        };
        Ok(Near { nodes, point, normal })
    }

    /// The nodes of a name: of its surface if it has one, else each node, or those that it leads.
    fn set_of(&self, name: &str) -> Result<Set, Fault> {
        if let Ok(surface) = self.mesh.surface(name, |_| false)
            && !surface.facets().is_empty()
        {
            let facets = surface.facets().iter().map(|facet| facet.corners().to_vec()).collect();
            return Ok(Set { nodes: surface.nodes().to_vec(), facets });
        }
        let Some(nodes) = self.mesh.nodes(name).filter(|nodes| !nodes.is_empty()) else {
            let message = format!("there is nothing called \"{name}\"");
            return Err(Fault::new(&UNKNOWN_NAME, "", message, "name a part, a side as part.side, or a group of a mesh file"));
        };
        let mut led: Vec<u32> = self.mesh.faces_of(&nodes).collect();
        let owners: Vec<u32> = led.iter().map(|&node| self.mesh.leader_of(node)).collect();
        led.extend(nodes.iter().filter(|node| !owners.contains(node)));
        Ok(Set { nodes: led, facets: Vec::new() })
    }

    /// Largest distance of nodes from the first of them, m.
    fn size(&self, nodes: &[u32]) -> f64 {
        let x = |node: u32| self.mesh.positions[node as usize];
        nodes.iter().map(|&node| length(minus(x(node), x(nodes[0])))).fold(0.0, f64::max)
    }
}

fn at_side(side: usize, fault: Fault) -> Fault {
    if fault.path.is_empty() { Fault { path: format!("between[{side}]"), ..fault } } else { fault }
}

/// Distance of a point from a facet (m), the nearest point of that, and its unit normal, away from the body.
fn closest<const D: usize>(facet: &[u32], positions: &[[f64; D]], x: [f64; 3]) -> (f64, [f64; 3], Option<[f64; 3]>) {
    let corner = |k: usize| in_3d(positions[facet[k] as usize]);
    if D == 2 {
        let (a, b) = (corner(0), corner(1));
        let way = minus(b, a);
        let part = (dot(minus(x, a), way) / dot(way, way)).clamp(0.0, 1.0);
        let point = plus(a, times(part, way));
        // Segments have the body on their right.
        return (length(minus(x, point)), point, unit([-way[1], way[0], 0.0]));
    }
    let triangles = (2..facet.len()).map(|k| [corner(0), corner(k - 1), corner(k)]);
    let of = |triangle: [[f64; 3]; 3]| {
        let point = place_on_triangle(x, triangle);
        let [a, b, c] = triangle;
        (length(minus(x, point)), point, unit(cross(minus(b, a), minus(c, a))))
    };
    triangles.map(of).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, x, None))
}
