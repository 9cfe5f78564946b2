//! Bodies that will go through each other, or through an obstacle, because no contact names them: found
//! before the run.
//!
//! Only where it is certain. `course.rs` says which bodies move on straight ways that are known for the whole
//! run, `meeting.rs` when two of them meet. What another contact may stop before is not reported, nor what
//! loads, springs, joints or curves move.

mod course;
mod meeting;

use super::{Builder, Builds};
use crate::contact::messages::PASSING;
use crate::contact::obstacle::space::Solid;
use crate::error::Warning;
use crate::mesh::surface::{Corners, Sided};
use crate::model::{Drive, Model, Motion, Obstacle, ObstacleShape, Partners, in_3d};
use crate::tensor::Dim;
use crate::vector::{first, minus, unit};
use course::{Course, Way};
use meeting::{Box3, Piece};
use std::collections::{BTreeMap, BTreeSet};

/// Models of more bodies are heaps, whose contact no one forgets.
const BODIES_MOST: usize = 2000;
/// What may stop a body before this share of the time until it meets another makes that uncertain.
const BEFORE: f64 = 1.05;

/// What is known of the bodies of a model.
struct Bodies<'a, 'b, const D: usize>
where
    Dim<D>: Builds<D>,
{
    builder: &'b Builder<'a, D>,
    /// Parts of each body.
    parts: Vec<Vec<usize>>,
    courses: Vec<Option<Course<D>>>,
    boxes: Vec<Box3>,
    /// For each contact which bodies are on its two sides.
    contacts: Vec<[Vec<bool>; 2]>,
    outsides: BTreeMap<usize, Vec<Piece>>,
}

/// A warning for each pair of parts, and of a part and an obstacle, that will go through each other; and the
/// parts of these pairs.
pub(super) fn warnings<const D: usize>(builder: &Builder<'_, D>) -> (Vec<Warning>, BTreeSet<usize>)
where
    Dim<D>: Builds<D>,
{
    let model = builder.model;
    let meets_all = |partners: &Partners| matches!(partners, Partners::Bodies(parts) if parts.is_empty());
    let all_meet = model.contacts.iter().any(|contact| meets_all(&contact.partners));
    let all_stop = model.obstacles.iter().all(|obstacle| obstacle.parts.is_empty());
    let count = builder.body_of_node.iter().max().map_or(0, |last| *last as usize + 1);
    if (all_meet && all_stop) || model.run.relaxation.is_some() || !model.stages.is_empty() || count > BODIES_MOST {
        return Default::default();
    }
    let mut bodies = Bodies::new(builder, count);
    let (mut warnings, parts) = if all_meet { Default::default() } else { bodies.through_each_other() };
    warnings.extend(bodies.through_obstacles());
    (warnings, parts)
}

impl<'a, 'b, const D: usize> Bodies<'a, 'b, D>
where
    Dim<D>: Builds<D>,
{
    fn new(builder: &'b Builder<'a, D>, count: usize) -> Self {
        let (model, mesh) = (builder.model, &builder.mesh);
        let mut parts = vec![BTreeSet::new(); count];
        let mut boxes = vec![Box3::EMPTY; count];
        for (index, part) in mesh.parts.iter().enumerate() {
            for node in part.with_faces() {
                let body = builder.body_of_node[node as usize] as usize;
                parts[body].insert(index);
                boxes[body].add(in_3d(mesh.positions[node as usize]));
            }
        }
        let parts: Vec<Vec<usize>> = parts.into_iter().map(|own| own.into_iter().collect()).collect();
        let of = |name: &str| {
            let mut named = vec![false; count];
            mesh.nodes(name).unwrap_or_default().iter().for_each(|&node| named[builder.body_of_node[node as usize] as usize] = true);
            named
        };
        let sides = |partners: &Partners| match partners {
            Partners::Between(names) => names.each_ref().map(|name| of(name)),
            Partners::Bodies(names) if names.is_empty() => [vec![true; count], vec![true; count]],
            Partners::Bodies(names) => {
                let own: Vec<bool> = parts.iter().map(|parts| parts.iter().any(|&part| names.contains(&mesh.parts[part].name))).collect();
                [own.clone(), own]
            }
        };
        let contacts = model.contacts.iter().map(|contact| sides(&contact.partners)).collect();
        let courses = course::of_bodies(builder, &parts);
        Self { builder, parts, courses, boxes, contacts, outsides: BTreeMap::new() }
    }

    /// Whether a contact has to do with both.
    fn are_related(&self, a: usize, b: usize) -> bool {
        self.contacts.iter().any(|[one, other]| (one[a] && other[b]) || (one[b] && other[a]))
    }

    fn name(&self, body: usize) -> &'a str {
        let model: &'a Model = self.builder.model;
        self.parts[body].first().map_or("", |&part| model.parts[part].name.as_str())
    }

    /// The outside of a body, without what lies on symmetries.
    fn outside(&mut self, body: usize) -> &[Piece] {
        let (builder, parts) = (self.builder, &self.parts[body]);
        self.outsides.entry(body).or_insert_with(|| {
            let names: Vec<String> = parts.iter().map(|&part| builder.mesh.parts[part].name.clone()).collect();
            let is_other = |node: u32| builder.body_of_node[node as usize] as usize != body;
            let left_out = |facet: crate::mesh::surface::Facet<D>| {
                facet.corners().first().is_some_and(|&node| is_other(node)) || builder.constraints.is_mirror(facet)
            };
            let Ok(surface) = builder.mesh.outside_without(&names, left_out) else { return Vec::new() };
            let at = |&node: &u32| in_3d(builder.mesh.positions[node as usize]);
            surface.facets().iter().flat_map(|facet| Piece::of(&facet.corners().iter().map(at).collect::<Vec<_>>())).collect()
        })
    }

    /// Time at which two bodies meet, s; `None`: not within the run, or not on ways that are known.
    fn meeting(&mut self, a: usize, b: usize) -> Option<f64> {
        let way = Way::between(self.courses[a]?, self.courses[b]?, self.builder.model.run.end)?;
        let along = in_3d(way.whole);
        if !self.boxes[a].sweeps(along, &self.boxes[b]) {
            return None;
        }
        self.outside(a);
        self.outside(b);
        let (one, other) = (self.outsides.get(&a)?, self.outsides.get(&b)?);
        Some(way.time_at(meeting::share(one, other, along)?))
    }

    /// Time at which a body meets an obstacle, s; `Err`: no one knows how the obstacle moves, or what it is.
    fn meeting_obstacle(&mut self, body: usize, obstacle: &Obstacle) -> Result<Option<f64>, ()> {
        let (course, solid) = (self.courses[body].ok_or(())?, solid(obstacle).ok_or(())?);
        let own = Course::of_obstacle(&obstacle.motion).ok_or(())?;
        let Some(way) = Way::between(course, own, self.builder.model.run.end) else { return Ok(None) };
        let along = in_3d(way.whole);
        Ok(meeting::share_of_obstacle(&solid, self.outside(body), along).map(|share| way.time_at(share)))
    }

    /// Whether something that a body touches may change its way before `time`, s.
    fn may_be_stopped(&mut self, body: usize, time: f64) -> bool {
        for other in (0..self.parts.len()).filter(|&other| other != body) {
            if self.are_related(body, other)
                && (self.courses[other].is_none() || self.meeting(body, other).is_some_and(|met| met <= BEFORE * time))
            {
                return true;
            }
        }
        let model: &'a Model = self.builder.model;
        let names: Vec<&str> = self.parts[body].iter().map(|&part| model.parts[part].name.as_str()).collect();
        let stops = |obstacle: &&Obstacle| obstacle.parts.is_empty() || obstacle.parts.iter().any(|part| names.contains(&part.as_str()));
        model.obstacles.iter().filter(stops).any(|obstacle| match self.meeting_obstacle(body, obstacle) {
            Ok(met) => met.is_some_and(|met| met <= BEFORE * time),
            Err(()) => true,
        })
    }

    fn through_each_other(&mut self) -> (Vec<Warning>, BTreeSet<usize>) {
        let mut found: BTreeMap<[usize; 2], f64> = BTreeMap::new();
        for a in 0..self.parts.len() {
            for b in a + 1..self.parts.len() {
                if self.parts[a].is_empty() || self.parts[b].is_empty() || self.are_related(a, b) {
                    continue;
                }
                let Some(time) = self.meeting(a, b) else { continue };
                if self.may_be_stopped(a, time) || self.may_be_stopped(b, time) {
                    continue;
                }
                let [one, other] = [self.parts[a][0], self.parts[b][0]];
                let first = found.entry([one.min(other), one.max(other)]).or_insert(time);
                *first = first.min(time);
            }
        }
        let model = self.builder.model;
        let warning = |([a, b], time): ([usize; 2], f64)| {
            let [one, other] = [a, b].map(|part| model.parts[part].name.as_str());
            let between = if a == b { format!("bodies of part `{one}`") } else { format!("parts `{one}` and `{other}`") };
            let pair = if a == b { String::new() } else { format!(", or `between = [\"{one}\", \"{other}\"]`") };
            Warning {
                kind: &PASSING,
                path: format!("part[{b}]"),
                message: format!("{between} meet at {time:.4e} s, and no contact keeps them apart"),
                consequence: "they go through each other as if the other were not there".into(),
                help: format!("add a [[contact]] with `bodies = \"all\"`{pair}"),
            }
        };
        let parts = found.keys().flatten().copied().collect();
        (found.into_iter().map(warning).collect(), parts)
    }

    fn through_obstacles(&mut self) -> Vec<Warning> {
        let model: &'a Model = self.builder.model;
        let mut warnings = Vec::new();
        for (index, obstacle) in model.obstacles.iter().enumerate().filter(|(_, obstacle)| !obstacle.parts.is_empty()) {
            let mut reported = BTreeSet::new();
            for body in 0..self.parts.len() {
                let name = self.name(body);
                let is_stopped = self.parts[body].iter().any(|&part| obstacle.parts.contains(&model.parts[part].name));
                if is_stopped || reported.contains(name) {
                    continue;
                }
                let Ok(Some(time)) = self.meeting_obstacle(body, obstacle) else { continue };
                if self.may_be_stopped(body, time) {
                    continue;
                }
                reported.insert(name);
                warnings.push(Warning {
                    kind: &PASSING,
                    path: format!("obstacle[{index}].parts"),
                    message: format!("part `{name}` meets obstacle `{}` at {time:.4e} s, and is none of its `parts`", obstacle.name),
                    consequence: "it goes through the obstacle as if that were not there".into(),
                    help: "name it in `parts` too, or leave `parts` out: then the obstacle stops all".into(),
                });
            }
        }
        warnings
    }
}

/// The shape of an obstacle where it stands at the start; `None` of those that have ends.
pub(super) fn solid(obstacle: &Obstacle) -> Option<Solid> {
    Some(match obstacle.shape {
        ObstacleShape::Plane { point, normal, length: None } => Solid::HalfSpace { point, normal: unit(normal)? },
        ObstacleShape::Circle { centre, radius, hollow } | ObstacleShape::Sphere { centre, radius, hollow } => {
            Solid::Ball { centre, radius, is_hollow: hollow }
        }
        ObstacleShape::Cylinder { point, axis, radius, hollow } => Solid::Cylinder { point, axis: unit(axis)?, radius, is_hollow: hollow },
        ObstacleShape::Plane { .. } | ObstacleShape::Polyline { .. } | ObstacleShape::Triangles(_) => return None,
    })
}

impl<const D: usize> Course<D> {
    /// Of an obstacle whose velocity is prescribed and does not change.
    fn of_obstacle(motion: &Motion) -> Option<Self> {
        let Motion { velocity, spin } = motion;
        let constant = |drive: &Option<Drive>| match drive {
            Some(Drive::Constant(speed)) => Some(*speed),
            _ => None,
        };
        if constant(spin)? != 0.0 {
            return None;
        }
        let mut own = [0.0; 3];
        for (component, drive) in own.iter_mut().zip(velocity).take(D) {
            *component = constant(drive)?;
        }
        Some(Self { velocity: first(own), acceleration: [0.0; D] })
    }
}

/// Whether a way has no length.
fn is_nothing<const D: usize>(way: [f64; D]) -> bool {
    minus(way, [0.0; D]) == [0.0; D]
}
