//! Prescribed motion by direction: symmetry lines, fixed and driven nodes, nodes that are rotated about a
//! point. After the free update the velocity is set along each direction; the impulse that this takes is the
//! reaction, and its work goes to the ledger.

use super::curve::{Curves, Meaning, Speed};
use super::join::{Joins, back};
use crate::archive::{Archive, ArchiveResult};
use crate::error::Fault;
use crate::load::messages::{HELD_TWICE, OFF_SYMMETRY};
use crate::mesh::Mesh;
use crate::mesh::geometry::CellGeometry;
use crate::mesh::surface::Corners;
use crate::model::messages::UNKNOWN_NAME;
use crate::model::{Constraint, Model, Symmetry};
use crate::rotation::{Rotate, Square, applied, axis, unit_matrix};
use crate::tensor::Dim;
use crate::vector::{self, dot, first, minus, unit};
use std::collections::BTreeMap;

/// Prescribed directions of one node, orthonormal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeConstraint<const D: usize> {
    /// Unit direction and prescribed velocity along it in v^{n+½}, m/s.
    directions: Vec<([f64; D], f64)>,
    /// The direction that the condition gave, of which the one above is what is across the earlier ones.
    given: Vec<[f64; D]>,
    /// What prescribes the velocity of each direction.
    speeds: Vec<Speed>,
    /// Which condition gave each direction: index into [`Constraints::conditions`].
    sources: Vec<u32>,
    /// Which of [`Constraints::turns`] leads it around, along all directions.
    turn: Option<u32>,
}

/// Why a direction can't be added.
struct Contradiction {
    /// Velocity that is prescribed along it already.
    earlier: Speed,
    /// The conditions that do so.
    sources: Vec<u32>,
}

/// Components of unit vectors that are less are nothing.
const SAME_DIRECTION: f64 = 1e-9;

impl<const D: usize> NodeConstraint<D> {
    /// Adds a direction of rest for a condition; nothing where all of it rests already.
    pub(crate) fn rest(&mut self, direction: [f64; D], source: u32) {
        // Rest contradicts nothing that rests.
        let _ = self.add(direction, &Speed::constant(0.0), source);
    }

    /// Prescribes a velocity along a direction for a condition, as far as no other one is there.
    pub(crate) fn prescribe(&mut self, direction: [f64; D], velocity: &Speed, source: u32) {
        let _ = self.add(direction, velocity, source);
    }

    /// Its one direction and the condition that gave it, or several that are across each other as given.
    pub(crate) fn directions(&self) -> Option<impl Iterator<Item = (u32, [f64; D])>> {
        let is_own = self.directions.iter().zip(&self.given).all(|((direction, _), given)| direction == given);
        is_own.then(|| self.sources.iter().copied().zip(self.given.iter().copied()))
    }

    /// Components of the velocity that are prescribed, each by itself; see [`Self::is_oblique`].
    pub(crate) fn components(&self) -> [bool; D] {
        std::array::from_fn(|k| {
            let mut left = [0.0; D];
            left[k] = 1.0;
            for (direction, _) in &self.directions {
                let along = direction[k];
                left.iter_mut().zip(direction).for_each(|(left, own)| *left -= along * own);
            }
            left.iter().all(|left| left.abs() < SAME_DIRECTION)
        })
    }

    /// Whether anything else than single components is prescribed.
    pub(crate) fn is_oblique(&self) -> bool {
        self.directions.len() != self.components().into_iter().filter(|&held| held).count()
    }

    /// Whether nothing of a component is prescribed.
    pub(crate) fn leaves_free(&self, component: usize) -> bool {
        self.directions.iter().all(|(direction, _)| direction[component].abs() < SAME_DIRECTION)
    }

    /// The parts of a reaction R (N/m, N) that each condition takes: along its own direction a_k, with Σ µ_k
    /// a_k = R. What two conditions hold alike goes to the first.
    pub(crate) fn share_out(&self, reaction: [f64; D], mut add: impl FnMut(u32, [f64; D])) {
        let mut along: [f64; D] = [0.0; D];
        along.iter_mut().zip(&self.directions).for_each(|(along, (direction, _))| *along = dot(reaction, *direction));
        // a_k = Σ_{i ≤ k} (a_k · d_i) d_i of orthonormal d: from the last one back.
        for k in (0..self.directions.len()).rev() {
            let given = self.given[k];
            let share = along[k] / dot(given, self.directions[k].0);
            for i in 0..k {
                along[i] -= share * dot(given, self.directions[i].0);
            }
            add(self.sources[k], given.map(|component| share * component));
        }
    }

    /// Takes the velocities that change with time, as their mean between two times, s.
    pub(crate) fn drive(&mut self, curves: &Curves, [from, to]: [f64; 2]) {
        for ((_, velocity), speed) in self.directions.iter_mut().zip(&self.speeds) {
            *velocity = curves.mean(speed, from, to);
        }
    }

    /// Whether nothing is prescribed.
    pub(crate) fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    /// Adds a direction, unless the earlier directions prescribe another velocity along it.
    fn add(&mut self, direction: [f64; D], velocity: &Speed, source: u32) -> Result<(), Contradiction> {
        let (mut rest, mut speed, mut largest) = (direction, velocity.clone(), velocity.size());
        let mut sources = Vec::new();
        for (((held, _), held_speed), source) in self.directions.iter().zip(&self.speeds).zip(&self.sources) {
            let along: f64 = (0..D).map(|d| held[d] * direction[d]).sum();
            speed = speed.plus(-along, held_speed);
            largest = largest.max(held_speed.size());
            if along.abs() > 1e-9 && !sources.contains(source) {
                sources.push(*source);
            }
            for d in 0..D {
                rest[d] -= along * held[d];
            }
        }
        let length = (0..D).map(|d| rest[d] * rest[d]).sum::<f64>().sqrt();
        if length > 1e-9 {
            let speed = speed.times(1.0 / length);
            self.directions.push((rest.map(|r| r / length), speed.as_constant().unwrap_or(0.0)));
            self.given.push(direction);
            self.speeds.push(speed);
            self.sources.push(source);
            Ok(())
        } else if speed.is_round_off(largest) {
            Ok(())
        } else {
            Err(Contradiction { earlier: velocity.plus(-1.0, &speed), sources })
        }
    }

    /// Whether nothing but the rest along one direction is prescribed.
    #[must_use]
    pub fn holds_only(&self, direction: [f64; D]) -> bool {
        self.turn.is_none()
            && self.speeds.iter().all(|speed| speed.as_constant() == Some(0.0))
            && self.directions.iter().all(|(held, _)| (0..D).map(|d| held[d] * direction[d]).sum::<f64>().abs() == 1.0)
    }

    /// The part of a direction along which the node is free to move.
    #[must_use]
    pub fn free_part(&self, mut direction: [f64; D]) -> [f64; D] {
        for (held, _) in &self.directions {
            let along: f64 = (0..D).map(|d| direction[d] * held[d]).sum();
            for d in 0..D {
                direction[d] -= along * held[d];
            }
        }
        direction
    }

    /// The same of something that yields to impulses by a symmetric matrix: the reactions act along the
    /// held directions.
    #[must_use]
    pub fn apply_in(&self, mut velocity: [f64; D], mut mobility: Square<D>) -> [f64; D] {
        for (direction, speed) in &self.directions {
            let change = speed - dot(velocity, *direction);
            let response = applied(&mobility, *direction);
            let along = dot(response, *direction);
            for d in 0..D {
                velocity[d] += change / along * response[d];
            }
            mobility = without(mobility, *direction);
        }
        velocity
    }

    /// What is left of a symmetric mobility along what is free.
    #[must_use]
    pub fn mobility(&self, mobility: Square<D>) -> Square<D> {
        self.directions.iter().fold(mobility, |mobility, (direction, _)| without(mobility, *direction))
    }

    /// The velocity with the prescribed components.
    #[inline]
    #[must_use]
    pub fn apply(&self, mut velocity: [f64; D]) -> [f64; D] {
        for (direction, speed) in &self.directions {
            let change = speed - (0..D).map(|d| velocity[d] * direction[d]).sum::<f64>();
            for d in 0..D {
                velocity[d] += change * direction[d];
            }
        }
        velocity
    }
}

/// All nodes with prescribed motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constraints<const D: usize> {
    /// Index into `held` per node; `u32::MAX`: free. Empty when nothing is held.
    index: Vec<u32>,
    held: Vec<NodeConstraint<D>>,
    /// The node of each: of joined nodes the leader.
    nodes: Vec<u32>,
    /// Those in `held` whose velocity changes with time, and their nodes.
    driven: Vec<(u32, u32)>,
    /// Nodes on symmetry lines, ascending.
    mirrors: Vec<Mirror<D>>,
    /// Rotations about points.
    turns: Vec<Turn<D>>,
    /// Nodes with prescribed spins: axis, angular velocity (rad/s), and the condition that gave it.
    spins: BTreeMap<u32, Vec<([f64; 3], Speed, u32)>>,
    /// What the conditions are called in messages.
    conditions: Vec<String>,
}

/// A node on a symmetry line.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mirror<const D: usize> {
    node: u32,
    /// Number of the symmetry: two lines can have the same normal.
    line: usize,
    normal: [f64; D],
}

/// A prescribed rotation about a point.
#[derive(Clone, Debug, PartialEq)]
struct Turn<const D: usize> {
    centre: [f64; D],
    /// A unit vector.
    axis: [f64; 3],
    speed: Speed,
}

/// At most so many contradictions of a condition are reported one by one.
const REPORTED_MAX: usize = 20;

impl<const D: usize> Constraints<D>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    /// From the symmetries and constraints of a model.
    ///
    /// `joins` says which nodes move as one: what holds one of them holds its leader. Constraints of other
    /// stages than `stage` hold nothing.
    ///
    /// # Errors
    /// Names without nodes, symmetry lines that hold no node, motions that contradict each other on a node.
    pub fn new(model: &Model, mesh: &Mesh<D>, curves: &Curves, joins: &Joins<D>, stage: usize) -> Result<Self, Vec<Fault>> {
        let mut result = Self::default();
        if model.symmetries.is_empty() && model.constraints.is_empty() && joins.is_empty() {
            return Ok(result);
        }
        result.index = vec![u32::MAX; mesh.positions.len()];
        let mut faults = Vec::new();
        let place = Place { mesh, joins };
        for (i, symmetry) in model.symmetries.iter().enumerate() {
            result.mirror(i, symmetry, place, &mut faults);
        }
        result.mirrors.sort_by_key(|mirror| mirror.node);
        for (i, constraint) in model.constraints.iter().enumerate() {
            let is_of_stage = model.acts_in(&constraint.stages, stage);
            result.constrain(i, constraint, is_of_stage, place, curves, &mut faults);
        }
        result.fix_tips(place, &mut faults);
        let changes = |held: &NodeConstraint<D>| held.turn.is_some() || held.speeds.iter().any(|speed| speed.as_constant().is_none());
        for (node, &index) in (0..).zip(&result.index) {
            if result.held.get(index as usize).is_some_and(changes) {
                result.driven.push((index, node));
            }
        }
        result.driven.sort_unstable();
        if faults.is_empty() { Ok(result) } else { Err(faults) }
    }

    /// Holds the nodes on a symmetry line.
    fn mirror(&mut self, i: usize, symmetry: &Symmetry, place: Place<'_, D>, faults: &mut Vec<Fault>) {
        let mut found = Telling::new(format!("symmetry[{i}]"));
        self.conditions.push(format!("symmetry[{i}]"));
        let Some(normal) = unit(first(symmetry.normal)) else { return };
        let nodes = place.mesh.on_symmetry(symmetry);
        if nodes.is_empty() {
            let what = if D == 2 { "line" } else { "plane" };
            let help = format!("move the {what} or the bodies; nodes must lie on it within 1e-9 of the model's extent");
            faults.push(Fault::new(&OFF_SYMMETRY, &found.path, format!("no node lies on this symmetry {what}"), help));
        }
        for node in nodes {
            self.mirrors.push(Mirror { node, line: i, normal });
            self.hold(node, normal, &Speed::constant(0.0), place, &mut found);
        }
        found.report(faults);
    }

    /// Holds the nodes of a constraint.
    fn constrain(
        &mut self,
        i: usize,
        constraint: &Constraint,
        is_of_stage: bool,
        place: Place<'_, D>,
        curves: &Curves,
        faults: &mut Vec<Fault>,
    ) {
        let mut found = Telling::new(format!("constraint[{i}]"));
        self.conditions.push(format!("constraint[{i}] on \"{}\"", constraint.on));
        let Some(nodes) = place.mesh.nodes(&constraint.on) else {
            faults.push(Fault::new(
                &UNKNOWN_NAME,
                format!("{}.on", found.path),
                format!("there is nothing called \"{}\"", constraint.on),
                "name a part, a side as part.side, or a group",
            ));
            return;
        };
        if !is_of_stage {
            return;
        }
        if let Some(speed) = constraint.rotation.as_ref().and_then(|rotation| curves.speed(&rotation.speed)) {
            let about = constraint.rotation.as_ref().map(|rotation| rotation.about).unwrap_or_default();
            self.turns.push(Turn { centre: first(about.centre), axis: axis(about.direction), speed });
            let (axis, speed) = self.turns.last().map(|turn| (turn.axis, turn.speed.clone())).unwrap_or_default();
            for &node in &nodes {
                self.turn(node, place, &mut found);
                self.spin(node, axis, &speed, place, &mut found);
            }
        }
        let axes = unit_matrix::<3>().into_iter().zip(&constraint.spin).skip(if D == 2 { 2 } else { 0 });
        for (axis, speed) in axes.filter_map(|(axis, drive)| Some((axis, curves.speed(drive.as_ref()?)?))) {
            for &node in &nodes {
                self.spin(node, axis, &speed, place, &mut found);
            }
        }
        for (meaning, drives) in [
            (Meaning::Velocity, &constraint.velocity),
            (Meaning::Displacement, &constraint.displacement),
            (Meaning::Acceleration, &constraint.acceleration),
        ] {
            let speeds: [_; D] = std::array::from_fn(|d| drives[d].as_ref().and_then(|drive| curves.meant(drive, meaning)));
            for &node in &nodes {
                for (speed, direction) in speeds.iter().zip(unit_matrix::<D>()) {
                    let Some(speed) = speed else { continue };
                    if meaning == Meaning::Acceleration {
                        self.hold(
                            node,
                            direction,
                            &speed.clone().from_initial(back(place.joins.leader(node).1, direction)),
                            place,
                            &mut found,
                        );
                    } else {
                        self.hold(node, direction, speed, place, &mut found);
                    }
                }
            }
        }
        found.report(faults);
    }

    /// Holds the nodes that a rotation leads to themselves.
    fn fix_tips(&mut self, place: Place<'_, D>, faults: &mut Vec<Fault>) {
        let mut found = Telling::new("join".to_string());
        self.conditions.push("a join around it".to_string());
        for group in place.joins.groups().iter().filter(|group| group.fixed) {
            for direction in unit_matrix::<D>() {
                self.hold(group.members[0].node, direction, &Speed::constant(0.0), place, &mut found);
            }
        }
        found.report(faults);
    }

    fn slot(&mut self, node: u32) -> &mut NodeConstraint<D> {
        let slot = &mut self.index[node as usize];
        if *slot == u32::MAX {
            *slot = self.held.len() as u32;
            self.held.push(NodeConstraint::default());
            self.nodes.push(node);
        }
        &mut self.held[*slot as usize]
    }

    /// Prescribes a velocity along a direction, by the last of the conditions.
    fn hold(&mut self, node: u32, direction: [f64; D], velocity: &Speed, place: Place<'_, D>, found: &mut Telling) {
        let source = self.conditions.len() as u32 - 1;
        let (leader, turn) = place.joins.leader(node);
        let direction = back(turn, direction);
        let held = self.slot(leader);
        let reported = |speed: &Speed| speed.as_constant().map_or("as a curve says".to_string(), |velocity| format!("at {velocity} m/s"));
        if held.turn.is_some() {
            let others = held.sources.clone();
            found.note(
                place.mesh.positions[node as usize],
                &format!("shall move {}", reported(velocity)),
                &self.names(&others),
                "leads it around a point",
            );
        } else if let Err(Contradiction { earlier, sources }) = held.add(direction, velocity, source) {
            let does = format!("already moves it {} there", reported(&earlier));
            found.note(place.mesh.positions[node as usize], &format!("shall move {}", reported(velocity)), &self.names(&sources), &does);
        }
    }

    /// Prescribes the spin of a node about an axis.
    fn spin(&mut self, node: u32, axis: [f64; 3], speed: &Speed, place: Place<'_, D>, found: &mut Telling) {
        let rests = speed.as_constant() == Some(0.0);
        let is_other = |(other, before, _): ([f64; 3], &Speed, u32)| dot(other, axis).abs() > 1e-9 && before != speed;
        let x = place.mesh.positions[node as usize];
        if !rests && self.mirror_normals(node).next().is_some() {
            found.note(x, "shall spin", "a symmetry", "keeps it from rotating");
        } else if self.spins_of(node).any(is_other) {
            found.note(x, "shall spin", "another constraint", "already says how it rotates");
        } else {
            let source = self.conditions.len() as u32 - 1;
            self.spins.entry(node).or_default().push((axis, speed.clone(), source));
        }
    }

    /// Leads a node around by the last of the turns.
    fn turn(&mut self, node: u32, place: Place<'_, D>, found: &mut Telling) {
        let (source, turn) = (self.conditions.len() as u32 - 1, self.turns.len() as u32 - 1);
        let x = place.mesh.positions[node as usize];
        let at_centre = self.turns.last().is_some_and(|turn| <Dim<D>>::perpendicular(minus(x, turn.centre), turn.axis) == [0.0; D]);
        if at_centre {
            // What is on the axis rests.
            return unit_matrix::<D>().into_iter().for_each(|direction| self.hold(node, direction, &Speed::constant(0.0), place, found));
        }
        let (leader, _) = place.joins.leader(node);
        if place.joins.is_periodic() && place.mesh.positions[leader as usize] != place.mesh.positions[node as usize] {
            return found.note(
                place.mesh.positions[node as usize],
                "shall be led around a point",
                "a join",
                "lets it move like another place",
            );
        }
        let held = self.slot(leader);
        if held.turn == Some(turn) {
            return; // through another node of the group
        }
        if held.sources.is_empty() {
            held.directions = unit_matrix::<D>().map(|direction| (direction, 0.0)).into();
            held.given = unit_matrix::<D>().into();
            held.speeds = vec![Speed::default(); D];
            held.sources = vec![source; D];
            held.turn = Some(turn);
        } else {
            let others = held.sources.clone();
            found.note(
                place.mesh.positions[node as usize],
                "shall be led around a point",
                &self.names(&others),
                "already holds or moves it",
            );
        }
    }

    /// What conditions are called.
    fn names(&self, sources: &[u32]) -> String {
        let mut sources = sources.to_vec();
        sources.dedup();
        sources.iter().map(|&source| self.conditions[source as usize].as_str()).collect::<Vec<_>>().join(" and ")
    }

    /// Takes the velocities that change with time, as their mean between two times, s; `positions` at the
    /// first of them, m.
    pub fn drive(&mut self, curves: &Curves, [from, to]: [f64; 2], positions: &[[f64; D]]) {
        for &(index, node) in &self.driven {
            let held = &mut self.held[index as usize];
            if let Some(Turn { centre, axis, speed }) = held.turn.and_then(|turn| self.turns.get(turn as usize)) {
                let x = positions[node as usize];
                let velocity = <Dim<D>>::chord_velocity(minus(x, *centre), *axis, curves.mean(speed, from, to), to - from);
                held.directions.iter_mut().zip(velocity).for_each(|(direction, along)| direction.1 = along);
                continue;
            }
            held.drive(curves, [from, to]);
        }
    }

    /// Reports what accelerates from which velocities (m/s) it begins at a time (s).
    pub fn begin(&mut self, velocities: &[[f64; D]], curves: &Curves, time: f64) {
        for &(index, node) in &self.driven {
            for speed in &mut self.held[index as usize].speeds {
                speed.begin(velocities[node as usize], curves, time);
            }
        }
    }

    /// What [`Constraints::begin`] has found, in a kept state.
    pub(crate) fn persist_begun(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        for &(index, _) in &self.driven {
            self.held[index as usize].speeds.iter_mut().try_for_each(|speed| speed.persist_begun(archive))?;
        }
        Ok(())
    }
}

/// Where nodes are, and which move as one.
#[derive(Clone, Copy)]
struct Place<'a, const D: usize>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    mesh: &'a Mesh<D>,
    joins: &'a Joins<D>,
}

/// Contradictions of one condition with earlier ones.
struct Telling {
    path: String,
    faults: Vec<Fault>,
    count: usize,
}

impl Telling {
    fn new(path: String) -> Self {
        Self { path, faults: Vec::new(), count: 0 }
    }

    fn note<const D: usize>(&mut self, x: [f64; D], shall: &str, others: &str, does: &str) {
        self.count += 1;
        if self.count <= REPORTED_MAX {
            let message = format!("the node at {} m {shall}, but {others} {does}", vector::place(x));
            self.faults.push(Fault::new(&HELD_TWICE, &self.path, message, "take the node out of one of the two"));
        }
    }

    fn report(self, faults: &mut Vec<Fault>) {
        faults.extend(self.faults);
        if self.count > REPORTED_MAX {
            faults.push(Fault::new(&HELD_TWICE, self.path, format!("and so on at {} more nodes", self.count - REPORTED_MAX), ""));
        }
    }
}

impl<const D: usize> Constraints<D> {
    /// What holds `node`, if anything.
    #[inline]
    #[must_use]
    pub fn of(&self, node: usize) -> Option<&NodeConstraint<D>> {
        self.held.get(*self.index.get(node)? as usize)
    }

    /// Whether no node is held.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.held.is_empty()
    }

    /// Whether something is prescribed across a direction, or a motion along it.
    #[must_use]
    pub fn holds_more_than(&self, direction: [f64; D]) -> bool {
        self.held.iter().any(|held| !held.holds_only(direction))
    }

    /// Normals of the symmetry lines that `node` lies on.
    pub fn mirror_normals(&self, node: u32) -> impl Iterator<Item = [f64; D]> {
        self.mirrors_of(node).map(|mirror| mirror.normal)
    }

    /// Symmetry lines that `node` lies on: the condition and the normal.
    pub(crate) fn mirrors_at(&self, node: u32) -> impl Iterator<Item = (u32, [f64; D])> {
        self.mirrors_of(node).map(|mirror| (mirror.line as u32, mirror.normal))
    }

    /// Prescribed spins of `node`: axis, angular velocity (rad/s), and condition.
    pub(crate) fn spins_of(&self, node: u32) -> impl Iterator<Item = ([f64; 3], &Speed, u32)> {
        self.spins.get(&node).into_iter().flatten().map(|(axis, speed, source)| (*axis, speed, *source))
    }

    /// Nodes that are held, and what holds them: of joined nodes the leader.
    pub(crate) fn held(&self) -> impl Iterator<Item = (u32, &NodeConstraint<D>)> {
        self.nodes.iter().copied().zip(&self.held)
    }

    fn mirrors_of(&self, node: u32) -> impl Iterator<Item = &Mirror<D>> {
        let start = self.mirrors.partition_point(|mirror| mirror.node < node);
        self.mirrors[start..].iter().take_while(move |mirror| mirror.node == node)
    }

    /// Part of a node that belongs to the model: a half on a symmetry line, a quarter where two lines meet
    /// (in 3D: planes; an eighth where three do).
    #[must_use]
    pub fn share(&self, node: u32) -> f64 {
        let mut different: Vec<[f64; D]> = Vec::new();
        for normal in self.mirror_normals(node) {
            if different.iter().all(|other| dot(*other, normal).abs() < 1.0 - 1e-9) {
                different.push(normal);
            }
        }
        0.5f64.powi(different.len().min(D) as i32)
    }

    /// Whether all nodes of a segment or facet lie on the same symmetry line (in 3D: plane).
    #[must_use]
    pub fn is_mirror(&self, facet: impl Corners) -> bool {
        self.common_mirrors(facet.corners()).next().is_some()
    }

    /// Normals of the symmetry lines (in 3D: planes) on which all these nodes lie.
    pub fn common_mirrors<'a>(&'a self, nodes: &'a [u32]) -> impl Iterator<Item = [f64; D]> + 'a {
        let (first, others) = nodes.split_first().map_or((u32::MAX, nodes), |(&first, others)| (first, others));
        let is_common = |a: &&Mirror<D>| others.iter().all(|&node| self.mirrors_of(node).any(|b| a.line == b.line));
        self.mirrors_of(first).filter(is_common).map(|mirror| mirror.normal)
    }
}

/// A mobility without what yields along a direction.
fn without<const D: usize>(mobility: Square<D>, direction: [f64; D]) -> Square<D> {
    let response = applied(&mobility, direction);
    let along = dot(response, direction);
    std::array::from_fn(|i| std::array::from_fn(|j| mobility[i][j] - response[i] * response[j] / along))
}
