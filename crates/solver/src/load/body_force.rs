//! Forces on mass: gravity, and the centrifugal force of a frame that turns.
//!
//! gravity:      f = m g c(t)
//! centrifugal:  f = m ω² (x − p),  ω = ω₀ c(t),  with the current position x
//!
//! with a factor c(t) of a curve. A axisymmetric body turns about its axis: m ω² x along x alone. The
//! centrifugal force is that of a frame that turns with ω about p, in which a part at rest is seen;
//! velocities are those seen in the frame, and are meant to be small: there is no Coriolis force, and none of
//! ω̇. Each part gives its share of a node's mass. Works are external.

use super::curve::Curves;
use super::curve::factor::Factor;
use crate::archive::{Archive, ArchiveResult, Persist};
use crate::mesh::Mesh;
use crate::mesh::geometry::CellGeometry;
use crate::model::{Load, Model};
use crate::rotation::{Rotate, axis};
use crate::tensor::Dim;
use crate::vector::{first, minus, plus, times};

/// The forces on mass of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyForces<const D: usize> {
    loads: Vec<Acting<D>>,
    /// Acceleration of every node now, m/s²; empty when the model has no such load.
    now: Vec<[f64; D]>,
}

/// One load.
#[derive(Clone, Debug, PartialEq)]
struct Acting<const D: usize> {
    field: Field<D>,
    /// c.
    factor: Factor,
    /// c now.
    factor_now: f64,
    /// Share of the load's parts in the mass of each node.
    shares: Vec<f64>,
    /// Sum of these parts of the masses of the nodes, kg/m.
    whole: f64,
    /// Whether it acts on all parts, and so on free obstacles too.
    everywhere: bool,
    /// Place in the model.
    index: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Field<const D: usize> {
    Uniform([f64; D]),
    Centrifugal {
        centre: [f64; D],
        /// A unit vector.
        axis: [f64; 3],
        speed: f64,
    },
    /// About the axis of an axisymmetric body.
    Axial {
        speed: f64,
    },
}

impl<const D: usize> Field<D>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    fn at(self, factor: f64, x: [f64; D]) -> [f64; D] {
        match self {
            Self::Uniform(acceleration) => times(factor, acceleration),
            Self::Axial { speed } => std::array::from_fn(|d| if d == 0 { (factor * speed).powi(2) * x[0] } else { 0.0 }),
            Self::Centrifugal { centre, axis, speed } => times((factor * speed).powi(2), <Dim<D>>::perpendicular(minus(x, centre), axis)),
        }
    }
}

impl<const D: usize> BodyForces<D>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    /// `part_mass` lists the nodes of each part with the part's mass on them (kg/m), `mass` the whole mass of
    /// each node, all in their initial positions.
    #[must_use]
    pub fn new(model: &Model, mesh: &Mesh<D>, curves: &Curves, mass: &[f64], part_mass: &[Vec<(u32, f64)>]) -> Self {
        let load = |(index, load): (usize, &Load)| {
            let (parts, field) = match load {
                Load::Gravity { parts, acceleration, .. } => (parts, Field::Uniform(first(*acceleration))),
                Load::Centrifugal { parts, speed, .. } if model.is_axisymmetric() => (parts, Field::Axial { speed: *speed }),
                Load::Centrifugal { parts, about, speed, .. } => {
                    (parts, Field::Centrifugal { centre: first(about.centre), axis: axis(about.direction), speed: *speed })
                }
                Load::Damping { .. } | Load::StiffnessDamping { .. } | Load::Force { .. } | Load::Moment { .. } | Load::Pressure { .. } => {
                    return None;
                }
            };
            let mut shares = vec![0.0; mesh.positions.len()];
            for (part, masses) in mesh.parts.iter().zip(part_mass) {
                if parts.is_empty() || parts.contains(&part.name) {
                    for &(node, share) in masses {
                        shares[node as usize] += share / mass[node as usize];
                    }
                }
            }
            let factor = curves.factor_on(index, load);
            let whole = shares.iter().zip(mass).map(|(share, mass)| share * mass).sum();
            Some(Acting { field, factor, factor_now: 1.0, shares, whole, everywhere: parts.is_empty(), index })
        };
        let mut forces = Self { loads: model.loads.iter().enumerate().filter_map(load).collect(), now: Vec::new() };
        forces.prepare(curves, [0.0; 2], &mesh.positions);
        forces
    }

    /// Whether the model has no such load.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.loads.is_empty()
    }

    /// Whether they change with time or place.
    #[must_use]
    pub fn varies(&self) -> bool {
        self.loads.iter().any(|load| load.factor.varies() || !matches!(load.field, Field::Uniform(_)))
    }

    /// Takes their means between two times (s) at these positions (m).
    pub fn prepare(&mut self, curves: &Curves, update: [f64; 2], positions: &[[f64; D]]) {
        let nodes = self.loads.first().map_or(0, |load| load.shares.len());
        self.now.clear();
        self.now.resize(nodes, [0.0; D]);
        for load in &mut self.loads {
            load.factor_now = curves.factor(load.factor, update);
            for ((sum, &share), x) in self.now.iter_mut().zip(&load.shares).zip(positions) {
                if share > 0.0 {
                    let acceleration = load.field.at(load.factor_now, *x);
                    *sum = plus(*sum, acceleration.map(|component| component * share));
                }
            }
        }
    }

    /// Takes for the true mass of a node this part of what it was so far.
    pub(crate) fn dilute(&mut self, node: usize, part: f64) {
        self.loads.iter_mut().for_each(|load| load.shares[node] *= part);
        if let Some(now) = self.now.get_mut(node) {
            *now = times(part, *now);
        }
    }

    /// Keeps the parts of true masses, and what follows.
    pub(crate) fn persist_shares(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.loads.iter_mut().try_for_each(|load| load.shares[..].persist(archive))?;
        self.now[..].persist(archive)
    }

    /// Sum of the forces on nodes of the load at a place of the model now, N/m; `mass` of the nodes, kg/m,
    /// and their positions, m.
    pub(crate) fn resultant(&self, index: usize, mass: &[f64], positions: &[[f64; D]]) -> [f64; D] {
        let Some(load) = self.loads.iter().find(|load| load.index == index) else { return [0.0; D] };
        if let Field::Uniform(acceleration) = load.field {
            return times(load.factor_now * load.whole, acceleration);
        }
        let force = |((&m, &share), &x): ((&f64, &f64), &[f64; D])| times(m * share, load.field.at(load.factor_now, x));
        mass.iter().zip(&load.shares).zip(positions).map(force).fold([0.0; D], plus)
    }

    /// Acceleration of every node now, m/s²; empty when the model has no such load.
    #[must_use]
    pub fn accelerations(&self) -> &[[f64; D]] {
        &self.now
    }

    /// Acceleration now at a point of a free obstacle, m/s².
    #[must_use]
    pub fn everywhere(&self, x: [f64; D]) -> [f64; D] {
        self.loads.iter().filter(|load| load.everywhere).fold([0.0; D], |sum, load| plus(sum, load.field.at(load.factor_now, x)))
    }
}
