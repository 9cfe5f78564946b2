//! Linear and angular momentum of a run on which nothing acts from outside.

use crate::archive::{Archive, ArchiveResult, Persist};
use crate::body_columns::BodyColumns;
use crate::dimension::Dimension;
use crate::rigid::{Body, RigidMotion};
use crate::rotation::{Rotate, unit_matrix};
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus, times};

/// Linear and angular momentum of a model on which nothing acts from outside.
pub(crate) struct Momentum<const D: usize> {
    start: Moments<D>,
    /// The centre of mass at the start, m: about it the angular momentum is measured, far from the origin
    /// too.
    centre: [f64; D],
    drift: [f64; 2],
    /// Whether x is a radius: forces around the axis cancel, and only what goes along it is kept.
    of_revolution: bool,
}

#[derive(Clone, Copy)]
struct Moments<const D: usize> {
    linear: [f64; D],
    /// In 2D about z alone.
    angular: [f64; 3],
    /// Σ m|v| and Σ m|x − c||v|: what the drifts are measured against.
    scale: [f64; 2],
}

impl<const D: usize> Persist for Momentum<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // The start is that of the model.
        let Self { start: _, centre: _, drift, of_revolution: _ } = self;
        drift.persist(archive)
    }
}

impl<const D: usize> Momentum<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    /// `None` where something is held or driven, or loads act.
    pub(crate) fn new(system: &System<D>) -> Option<Self> {
        let of_revolution = system.of_revolution;
        let is_free = |body: &Body<D>| if of_revolution { body.drives.as_ref()[1].is_none() } else { body.is_free() };
        let is_held = if of_revolution { system.constraints.holds_more_than(unit_matrix()[0]) } else { !system.constraints.is_empty() };
        let isolated = system.bodies.iter().all(is_free)
            && !is_held
            && system.stages.is_none()
            && system.body_forces.is_empty()
            && system.forces.is_empty()
            && system.boundary.is_empty()
            && !system.rotations.is_acted_on()
            && !system.joins.is_periodic()
            && system.damping.is_empty()
            && !system.contacts.iter().any(|contact| contact.connected().is_some_and(|found| found.grounded));
        // Forces at time zero have acted half a step already; both momenta are kept by them as well.
        isolated.then(|| {
            let centre = centre_of_mass(system);
            Self { start: Moments::of(system, centre), centre, drift: [0.0; 2], of_revolution }
        })
    }

    pub(crate) fn note(&mut self, system: &System<D>) {
        let now = Moments::of(system, self.centre);
        let mut change = minus(now.linear, self.start.linear);
        if self.of_revolution {
            change[0] = 0.0;
        }
        let turned = minus(now.angular, self.start.angular);
        let (linear, angular) = (dot(change, change).sqrt(), dot(turned, turned).sqrt());
        for (drift, (change, scales)) in
            self.drift.iter_mut().zip([(linear, [self.start.scale[0], now.scale[0]]), (angular, [self.start.scale[1], now.scale[1]])])
        {
            let scale = scales[0].max(scales[1]);
            if scale > 0.0 {
                *drift = drift.max(change / scale);
            }
        }
    }

    pub(crate) fn linear(&self) -> f64 {
        self.drift[0]
    }

    /// `None` of axisymmetric bodies: there is none.
    pub(crate) fn angular(&self) -> Option<f64> {
        (!self.of_revolution).then_some(self.drift[1])
    }
}

impl<const D: usize> Moments<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    /// Σ m v^{n+1/2} and Σ m (x^n − c) × v^{n+1/2} + Σ I ω^{n+1/2} about a point c: the latter is the one
    /// that central differences keep exactly.
    fn of(system: &System<D>, centre: [f64; D]) -> Self {
        let mut sum = Self { linear: [0.0; D], angular: [0.0; 3], scale: [0.0; 2] };
        for (node, ((&m, x), v)) in (0..).zip(system.mass.iter().zip(&system.positions).zip(&system.velocities)) {
            if system.bodies.of_node(node).is_none() {
                sum.add(m, minus(*x, centre), *v);
            }
        }
        for spin in system.rotations.momenta() {
            sum.angular = plus(sum.angular, spin);
            sum.scale[1] += dot(spin, spin).sqrt();
        }
        for body in system.bodies.iter() {
            let (m, velocity, spin) = <Dim<D>>::momenta(body);
            sum.add(m, minus(body.centre, centre), velocity);
            sum.angular = plus(sum.angular, spin);
            sum.scale[1] += dot(spin, spin).sqrt();
        }
        sum
    }

    fn add(&mut self, m: f64, arm: [f64; D], v: [f64; D]) {
        self.linear = plus(self.linear, times(m, v));
        self.angular = plus(self.angular, times(m, <Dim<D> as Rotate<D>>::moment_vector(arm, v)));
        let speed = m * dot(v, v).sqrt();
        self.scale[0] += speed;
        self.scale[1] += speed * dot(arm, arm).sqrt();
    }
}

/// Centre of the masses that `Moments` counts, m; seen from the first node, so that far from the origin no
/// digits are lost.
fn centre_of_mass<const D: usize>(system: &System<D>) -> [f64; D]
where
    Dim<D>: Dimension<D> + BodyColumns<D>,
{
    let Some(&from) = system.positions.first() else { return [0.0; D] };
    let (mut mass, mut sum) = (0.0, [0.0; D]);
    let mut add = |m: f64, x: [f64; D]| {
        mass += m;
        sum = plus(sum, times(m, minus(x, from)));
    };
    for (node, (&m, x)) in (0..).zip(system.mass.iter().zip(&system.positions)) {
        if system.bodies.of_node(node).is_none() {
            add(m, *x);
        }
    }
    system.bodies.iter().for_each(|body| add(<Dim<D>>::momenta(body).0, body.centre));
    if mass > 0.0 { plus(from, times(1.0 / mass, sum)) } else { from }
}
