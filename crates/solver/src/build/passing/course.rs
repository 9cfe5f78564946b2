//! Ways of bodies that are known for the whole run: straight, with a velocity and an acceleration that do not
//! change.
//!
//! A body has such a way if it flies freely, or under gravity, or if all that is prescribed of it agrees with
//! its velocity. Of what anything else acts on nothing is known.

use super::super::{Builder, Builds};
use super::is_nothing;
use crate::model::{Constraint, Drive, Load, Model, Part};
use crate::tensor::Dim;
use crate::vector::{dot, first, length, minus, plus, times};

/// x(t) = x₀ + v t + ½ a t².
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course<const D: usize> {
    /// v, m/s.
    pub(super) velocity: [f64; D],
    /// a, m/s².
    pub(super) acceleration: [f64; D],
}

/// The straight way of one body as another one sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way<const D: usize> {
    /// From the start to the end of the run, m.
    pub(super) whole: [f64; D],
    /// m/s.
    speed: f64,
    /// m/s².
    acceleration: f64,
}

impl<const D: usize> Way<D> {
    /// Until `end` (s); `None` where it is bent, turns back, or is no way.
    pub(super) fn between(one: Course<D>, other: Course<D>, end: f64) -> Option<Self> {
        let (v, a) = (minus(one.velocity, other.velocity), minus(one.acceleration, other.acceleration));
        let (speed, acceleration) = (length(v), length(a));
        let is_straight = dot(v, a) >= (1.0 - 1e-9) * speed * acceleration;
        let whole = plus(times(end, v), times(0.5 * end * end, a));
        (is_straight && !is_nothing(whole) && whole.iter().all(|x| x.is_finite())).then_some(Self { whole, speed, acceleration })
    }

    /// Time at which a share of it is behind, s.
    pub(super) fn time_at(&self, share: f64) -> f64 {
        let (way, v, a) = (share.max(0.0) * length(self.whole), self.speed, self.acceleration);
        // The root without a difference.
        2.0 * way / (v + (v * v + 2.0 * a * way).sqrt())
    }
}

/// What is gathered of a body.
#[derive(Clone, Copy, Debug)]
struct Gathered<const D: usize> {
    is_known: bool,
    velocity: [f64; D],
    gravity: [f64; D],
    /// Components that are prescribed.
    held: [bool; D],
}

/// The ways of all bodies, of each of which `parts` are its parts; `None`: no one knows.
pub(super) fn of_bodies<const D: usize>(builder: &Builder<'_, D>, parts: &[Vec<usize>]) -> Vec<Option<Course<D>>>
where
    Dim<D>: Builds<D>,
{
    let model = builder.model;
    let mut all: Vec<Gathered<D>> = parts.iter().map(|parts| at_start(model, parts)).collect();
    let touched = |name: &str| {
        let mut bodies: Vec<usize> =
            builder.mesh.nodes(name).unwrap_or_default().iter().map(|&node| builder.body_of_node[node as usize] as usize).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    };
    for name in pulled(model) {
        touched(name).into_iter().for_each(|body| all[body].is_known = false);
    }
    for constraint in &model.constraints {
        for body in touched(&constraint.on) {
            let is_whole = parts[body].len() == 1 && builder.mesh.parts[parts[body][0]].name == constraint.on;
            all[body].hold(constraint, is_whole);
        }
    }
    for (node, &body) in builder.body_of_node.iter().enumerate() {
        let own = &mut all[body as usize];
        let crosses = |normal: [f64; D]| dot(normal, own.velocity) != 0.0;
        if builder.constraints.mirror_normals(node as u32).any(crosses) {
            own.is_known = false;
        }
    }
    for load in &model.loads {
        for (own, parts) in all.iter_mut().zip(parts) {
            own.load(load, parts.iter().map(|&part| model.parts[part].name.as_str()));
        }
    }
    all.iter().map(Gathered::course).collect()
}

/// Velocities of the parts of a body, which must be one, and what is prescribed of rigid ones.
fn at_start<const D: usize>(model: &Model, parts: &[usize]) -> Gathered<D> {
    let own = || parts.iter().map(|&part| &model.parts[part]);
    let velocity = own().next().map_or([0.0; 3], |part| part.velocity);
    let holds_nothing = |part: &Part| {
        let has_pressure = model.materials.get(&part.material).is_none_or(|it| !it.eos.is_empty());
        part.stress_initial.is_none() && part.temperature_initial.is_none() && !has_pressure
    };
    let flies = |part: &Part| part.velocity == velocity && part.spin == 0.0 && holds_nothing(part);
    let mut gathered = Gathered { is_known: own().all(flies), velocity: first(velocity), gravity: [0.0; D], held: [false; D] };
    for motion in own().filter_map(|part| part.rigid.as_ref()) {
        gathered.is_known &= matches!(motion.spin, None | Some(Drive::Constant(0.0))) && parts.len() == 1;
        for d in 0..D {
            match &motion.velocity[d] {
                None => {}
                Some(Drive::Constant(speed)) => (gathered.velocity[d], gathered.held[d]) = (*speed, true),
                Some(Drive::Curve(_)) => gathered.is_known = false,
            }
        }
    }
    gathered
}

/// Sets of nodes on which something acts of which no one knows where it moves them.
fn pulled(model: &Model) -> impl Iterator<Item = &str> {
    let loaded = model.loads.iter().filter_map(|load| match load {
        Load::Force { on, .. } | Load::Moment { on, .. } | Load::Pressure { on, .. } => Some(on),
        _ => None,
    });
    let pairs = model.joins.iter().map(|join| &join.between).chain(model.springs.iter().map(|spring| &spring.between)).flatten();
    let welded = model.welds.iter().flat_map(|weld| &weld.between).chain(model.joints.iter().flat_map(|joint| &joint.between));
    let pressed = model.cavities.iter().flat_map(|cavity| &cavity.on).chain(model.non_reflecting.iter().map(|it| &it.on));
    loaded.chain(pairs).chain(welded).chain(pressed).map(String::as_str)
}

impl<const D: usize> Gathered<D> {
    /// Something is prescribed of some of its nodes, or of all where the constraint `is_whole`.
    fn hold(&mut self, constraint: &Constraint, is_whole: bool) {
        let Constraint { velocity, displacement, acceleration, rotation, .. } = constraint;
        self.is_known &= rotation.is_none();
        for d in 0..D {
            match &velocity[d] {
                None => {}
                Some(Drive::Constant(speed)) if is_whole => (self.velocity[d], self.held[d]) = (*speed, true),
                Some(Drive::Constant(speed)) if *speed == self.velocity[d] => self.held[d] = true,
                Some(_) => self.is_known = false,
            }
            for drive in [&displacement[d], &acceleration[d]].into_iter().flatten() {
                self.is_known &= *drive == Drive::Constant(0.0) && self.velocity[d] == 0.0;
                self.held[d] = true;
            }
        }
    }

    /// Loads on lists of parts; `names` are those of its own.
    fn load<'n>(&mut self, load: &Load, mut names: impl Iterator<Item = &'n str>) {
        let has = |parts: &[String], name: &str| parts.is_empty() || parts.iter().any(|part| part == name);
        match load {
            Load::Gravity { parts, acceleration, curve } => {
                let pulls: Vec<bool> = names.map(|name| has(parts, name)).collect();
                if pulls.iter().any(|pulls| *pulls) {
                    self.is_known &= pulls.iter().all(|pulls| *pulls) && curve.is_none();
                    self.gravity = plus(self.gravity, first(*acceleration));
                }
            }
            Load::Centrifugal { parts, .. } => self.is_known &= !names.any(|name| has(parts, name)),
            Load::Damping { parts, .. } if names.any(|name| has(parts, name)) => {
                self.is_known &= is_nothing(self.velocity) && is_nothing(self.gravity);
            }
            _ => {}
        }
    }

    fn course(&self) -> Option<Course<D>> {
        let acceleration = std::array::from_fn(|d| if self.held[d] { 0.0 } else { self.gravity[d] });
        self.is_known.then_some(Course { velocity: self.velocity, acceleration })
    }
}
