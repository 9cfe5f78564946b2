//! Nodes that move as one: tied where two sets coincide, periodic where one set is the image of the other by
//! a translation or a rotation.
//!
//! Joined nodes form groups. Each member's velocity is that of the group's leader, turned: v_i = R_i v. With
//! this the update of the group is that of one node
//!
//! M v^{n+½} = M v^{n−½} + ½ (dt^{n−1} + dt^n) Σ R_iᵀ f_i,   M = Σ m_i
//!
//! so a join does no work. A node that is its own image by a rotation (the tip of a sector) can't move; it is
//! held.

use crate::error::Fault;
use crate::load::messages::NO_PARTNER;
use crate::mesh::Mesh;
use crate::mesh::geometry::CellGeometry;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{Image, Join, Model};
use crate::rotation::{Rotate, Square, applied, axis, transposed, unit_matrix};
use crate::tensor::{Dim, product};
use crate::vector::{dot, first as first_of, minus, place, plus, times};

/// A rotation.
pub type Turn<const D: usize> = Square<D>;
const NONE: u32 = u32::MAX;
/// Distance at which nodes still coincide, fraction of the model's extent.
const TOLERANCE: f64 = 1e-6;
/// At most so many nodes without a partner are reported one by one.
const REPORTED_MAX: usize = 20;

/// The groups of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joins<const D: usize> {
    /// Group and place in it of each node; empty without joins.
    of_node: Vec<(u32, u32)>,
    groups: Vec<Group<D>>,
    /// Whether some set is the image of another at another place: then momenta are not kept.
    periodic: bool,
}

/// Nodes that move as one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group<const D: usize> {
    /// The leader first, without rotation.
    pub members: Vec<Member<D>>,
    /// Whether a rotation leads it to itself: then it can't move.
    pub fixed: bool,
}

/// A node of a group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member<const D: usize> {
    /// The node.
    pub node: u32,
    /// R.
    pub turn: Turn<D>,
}

/// Where a point is moved to.
type Moves<const D: usize> = Box<dyn Fn([f64; D]) -> [f64; D]>;

/// The second node moves like the first one, turned.
struct Link<const D: usize> {
    nodes: [u32; 2],
    turn: Turn<D>,
}

impl<const D: usize> Joins<D>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    /// Of a model.
    ///
    /// # Errors
    /// Sets of nothing, nodes without a partner.
    pub fn new(model: &Model, mesh: &Mesh<D>) -> Result<Self, Vec<Fault>> {
        let (mut links, mut faults) = (Vec::new(), Vec::new());
        for (i, join) in model.joins.iter().enumerate() {
            link(&format!("join[{i}]"), join, mesh, &mut links, &mut faults);
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let periodic = model.joins.iter().any(|join| join.image != Image::Same);
        Ok(if links.is_empty() { Self::default() } else { Self { periodic, ..Self::of(&links, mesh.positions.len()) } })
    }

    /// The groups that links make of so many nodes.
    fn of(links: &[Link<D>], nodes: usize) -> Self {
        let mut beside = vec![Vec::new(); nodes];
        for Link { nodes: [a, b], turn } in links {
            beside[*a as usize].push((*b, *turn));
            beside[*b as usize].push((*a, transposed(turn)));
        }
        let mut joins = Self { of_node: vec![(NONE, 0); nodes], ..Self::default() };
        for first in 0..nodes as u32 {
            if beside[first as usize].is_empty() || joins.of_node[first as usize].0 != NONE {
                continue;
            }
            let number = joins.groups.len() as u32;
            let mut group = Group { members: vec![Member { node: first, turn: unit_matrix() }], fixed: false };
            joins.of_node[first as usize] = (number, 0);
            let mut next = 0;
            while let Some(&Member { node, turn }) = group.members.get(next) {
                next += 1;
                for &(other, step) in &beside[node as usize] {
                    let turn = product(&step, &turn);
                    let (known, place) = joins.of_node[other as usize];
                    if known == NONE {
                        joins.of_node[other as usize] = (number, group.members.len() as u32);
                        group.members.push(Member { node: other, turn });
                    } else {
                        let known = group.members[place as usize].turn.as_flattened();
                        group.fixed |= turn.as_flattened().iter().zip(known).any(|(turn, known)| (turn - known).abs() > 1e-9);
                    }
                }
            }
            joins.groups.push(group);
        }
        joins
    }

    /// Whether the model has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// Whether some set is the image of another at another place.
    #[must_use]
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// All groups.
    #[must_use]
    pub fn groups(&self) -> &[Group<D>] {
        &self.groups
    }

    /// Group of a node, and its member that the node is.
    #[inline]
    #[must_use]
    pub fn of_node(&self, node: u32) -> Option<(&Group<D>, &Member<D>)> {
        let &(group, place) = self.of_node.get(node as usize)?;
        let group = self.groups.get(group as usize)?;
        Some((group, &group.members[place as usize]))
    }

    /// The node that moves in the stead of `node`, and the rotation from its motion to that of `node`.
    #[must_use]
    pub fn leader(&self, node: u32) -> (u32, Turn<D>) {
        self.of_node(node).map_or((node, unit_matrix()), |(group, member)| (group.members[0].node, member.turn))
    }

    /// Gives each group the mean velocity of its members by mass (kg/m); fixed ones rest.
    pub fn begin(&self, mass: &[f64], velocities: &mut [[f64; D]]) {
        for group in &self.groups {
            let (mut sum, mut whole) = ([0.0; D], 0.0);
            for member in &group.members {
                let (m, v) = (mass[member.node as usize], back(member.turn, velocities[member.node as usize]));
                sum = plus(sum, times(m, v));
                whole += m;
            }
            group.lead(if group.fixed { [0.0; D] } else { sum.map(|p| p / whole) }, velocities);
        }
    }
}

impl<const D: usize> Group<D> {
    /// Gives all members the velocity of the leader.
    pub fn lead(&self, velocity: [f64; D], velocities: &mut [[f64; D]]) {
        for member in &self.members {
            velocities[member.node as usize] = turned(member.turn, velocity);
        }
    }

    /// Σ R_iᵀ f_i of what each member's node has.
    pub fn sum(&self, of: impl Fn(usize) -> [f64; D]) -> [f64; D] {
        self.members.iter().fold([0.0; D], |sum, member| plus(sum, back(member.turn, of(member.node as usize))))
    }
}

/// R v.
#[inline]
#[must_use]
pub fn turned<const D: usize>(turn: Turn<D>, v: [f64; D]) -> [f64; D] {
    if turn == unit_matrix() { v } else { applied(&turn, v) }
}

/// Rᵀ v.
#[inline]
#[must_use]
pub fn back<const D: usize>(turn: Turn<D>, v: [f64; D]) -> [f64; D] {
    turned(transposed(&turn), v)
}

/// Finds the partner of each node of the first set in the second one; of images also the other way round.
fn link<const D: usize>(path: &str, join: &Join, mesh: &Mesh<D>, links: &mut Vec<Link<D>>, faults: &mut Vec<Fault>)
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    let mut sets = Vec::new();
    for (side, name) in join.between.iter().enumerate() {
        match mesh.nodes(name).filter(|nodes| !nodes.is_empty()) {
            Some(nodes) => sets.push(nodes),
            None => faults.push(Fault::new(
                &UNKNOWN_NAME,
                format!("{path}.between[{side}]"),
                format!("there is nothing called \"{name}\""),
                "name a part, a side as part.side, or a group",
            )),
        }
    }
    let [first, second] = &sets[..] else { return };
    let (turn, image): (Turn<D>, Moves<D>) = match join.image {
        Image::Same => (unit_matrix(), Box::new(|x| x)),
        Image::Translated(by) => (unit_matrix(), Box::new(move |x| plus(x, first_of(by)))),
        Image::Turned { about, angle } => {
            let (turn, centre) = (<Dim<D>>::rotation(axis(about.direction), angle), first_of(about.centre));
            (turn, Box::new(move |x| plus(centre, turned(turn, minus(x, centre)))))
        }
    };
    let size = crate::mesh::extent(&mesh.positions);
    let tolerance = join.tolerance.unwrap_or(TOLERANCE * size);
    let place = |node: u32| mesh.positions[node as usize];
    let pairs = partners(first.iter().map(|&node| (node, image(place(node)))), second.iter().map(|&node| (node, place(node))), tolerance);
    let mut lonely: Vec<Lonely> = pairs.iter().filter(|pair| pair.partner.is_none()).map(|pair| Lonely { pair: *pair, side: 0 }).collect();
    if join.image != Image::Same {
        let other =
            partners(second.iter().map(|&node| (node, place(node))), first.iter().map(|&node| (node, image(place(node)))), tolerance);
        lonely.extend(other.into_iter().filter(|pair| pair.partner.is_none()).map(|pair| Lonely { pair, side: 1 }));
    }
    report(path, join, &lonely, mesh, faults);
    let moves = |pair: &Pair| pair.partner.is_some_and(|partner| partner != pair.node || turn != unit_matrix());
    links.extend(pairs.iter().filter(|pair| moves(pair)).map(|pair| Link { nodes: [pair.node, pair.partner.unwrap_or(pair.node)], turn }));
}

/// A node and its partner within the tolerance.
#[derive(Clone, Copy)]
struct Pair {
    node: u32,
    partner: Option<u32>,
    /// To the nearest node of the other set that was looked at, m.
    distance: f64,
}

/// A node of one of the sets without a partner.
struct Lonely {
    pair: Pair,
    side: usize,
}

fn partners<const D: usize>(
    nodes: impl Iterator<Item = (u32, [f64; D])>,
    others: impl Iterator<Item = (u32, [f64; D])>,
    tolerance: f64,
) -> Vec<Pair> {
    let mut sorted: Vec<(u32, [f64; D])> = others.collect();
    sorted.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    let nearest = |x: [f64; D], among: &[(u32, [f64; D])]| {
        let distance = |&(node, y): &(u32, [f64; D])| {
            let way = minus(y, x);
            (dot(way, way).sqrt(), node)
        };
        among.iter().map(distance).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    nodes
        .map(|(node, x)| {
            let window =
                sorted.partition_point(|(_, y)| y[0] < x[0] - tolerance)..sorted.partition_point(|(_, y)| y[0] <= x[0] + tolerance);
            match nearest(x, &sorted[window]) {
                Some((distance, partner)) if distance <= tolerance => Pair { node, partner: Some(partner), distance },
                _ => Pair { node, partner: None, distance: nearest(x, &sorted).map_or(f64::INFINITY, |(distance, _)| distance) },
            }
        })
        .collect()
}

fn report<const D: usize>(path: &str, join: &Join, lonely: &[Lonely], mesh: &Mesh<D>, faults: &mut Vec<Fault>)
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    for Lonely { pair, side } in lonely.iter().take(REPORTED_MAX) {
        let at = place(mesh.positions[pair.node as usize]);
        let (own, other) = (&join.between[*side], &join.between[1 - side]);
        let what = if join.image == Image::Same { "" } else { " of the image" };
        let message = format!(
            "the node at {at} m of \"{own}\" has no partner in \"{other}\": the nearest node{what} is {:.3e} m away",
            pair.distance
        );
        faults.push(Fault::new(
            &NO_PARTNER,
            format!("{path}.between"),
            message,
            "mesh the two alike, or give a larger `tolerance`; a tied contact joins meshes that differ",
        ));
    }
    if lonely.len() > REPORTED_MAX {
        faults.push(Fault::new(
            &NO_PARTNER,
            format!("{path}.between"),
            format!("and {} more nodes without a partner", lonely.len() - REPORTED_MAX),
            "",
        ));
    }
}
