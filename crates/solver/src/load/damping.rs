//! Damping of mass: a force −rate m v on parts, so that what moves slowly comes to rest.
//!
//! It acts on the mean velocity of the update, v̄ = ½ (v^{n−½} + v^{n+½}): with a = ½ rate · ½ (dt^{n−1} +
//! dt^n)
//!
//! v^{n+½} = [(1 − a) v^{n−½} + ½ (dt^{n−1} + dt^n) f / m] / (1 + a),
//!
//! so it only takes energy, whatever the rate and the step. A node then yields to a force like one of mass
//! m (1 + a), which contact must know.

use crate::mesh::Mesh;
use crate::mesh::geometry::CellGeometry;
use crate::model::{Load, Model, Window};
use crate::rotation::Rotate;
use crate::tensor::Dim;
use embate_lanes::Batch;

/// The damping loads of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Damping {
    loads: Vec<Acting>,
    /// Rate of each node now, 1/s; empty while nothing acts.
    rates: Vec<f64>,
    /// Rate on the parts and obstacles that no load leaves out, 1/s.
    everywhere: f64,
    /// Rate of dynamic relaxation, on all nodes and free bodies, 1/s; `None` without.
    relaxation: Option<f64>,
    time_step: f64,
}

/// One load.
#[derive(Clone, Debug, PartialEq)]
struct Acting {
    window: Window,
    now: bool,
    rate: f64,
    /// Whether it acts on all parts, and so on free obstacles too.
    everywhere: bool,
    /// Share of the load's parts in the mass of each node.
    shares: Vec<f64>,
}

impl Damping {
    /// `part_mass` lists the nodes of each part with the part's mass on them (kg/m), `mass` the whole mass of
    /// each node.
    #[must_use]
    pub fn new<const D: usize>(model: &Model, mesh: &Mesh<D>, mass: &[f64], part_mass: &[Vec<(u32, f64)>]) -> Self
    where
        Dim<D>: CellGeometry<D> + Rotate<D>,
    {
        let load = |(index, load): (usize, &Load)| {
            let Load::Damping { parts, rate, active } = load else { return None };
            let window = Window::of(model, model.stages_of_load(index), *active);
            let mut shares = vec![0.0; mass.len()];
            for (part, masses) in mesh.parts.iter().zip(part_mass) {
                if parts.is_empty() || parts.contains(&part.name) {
                    for &(node, share) in masses {
                        shares[node as usize] += share / mass[node as usize];
                    }
                }
            }
            Some(Acting { window, now: false, rate: *rate, everywhere: parts.is_empty(), shares })
        };
        Self { loads: model.loads.iter().enumerate().filter_map(load).collect(), ..Self::default() }
    }

    /// Notes that a stage begins at `now`, s; whether it is relaxed.
    pub fn enter(&mut self, stage: usize, now: f64, relaxes: bool) {
        for load in &mut self.loads {
            load.window.enter(stage, now);
        }
        self.relaxation = relaxes.then_some(0.0);
    }

    /// Whether the model has no such load.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.loads.is_empty() && self.relaxation.is_none()
    }

    /// Sets the rate of dynamic relaxation, 1/s.
    pub fn relax(&mut self, rate: f64) {
        self.relaxation = Some(rate);
    }

    /// What acts at `time` (s) in an update over `time_step` = ½ (dt^{n−1} + dt^n), s, on so many nodes.
    /// Reports whether rates have changed.
    pub fn prepare(&mut self, time: f64, time_step: f64, nodes: usize) -> bool {
        // Its rate changes from step to step.
        let mut changed = self.relaxation.is_some();
        for load in &mut self.loads {
            let now = load.window.contains(time);
            changed |= now != std::mem::replace(&mut load.now, now);
        }
        if changed {
            self.everywhere = self.loads.iter().filter(|load| load.now && load.everywhere).map(|load| load.rate).sum();
            self.rates.clear();
            if self.loads.iter().any(|load| load.now) {
                self.rates.resize(nodes, 0.0);
            }
            for load in self.loads.iter().filter(|load| load.now) {
                self.rates.iter_mut().zip(&load.shares).for_each(|(rate, share)| *rate += load.rate * share);
            }
        }
        self.time_step = time_step;
        changed
    }

    /// Whether some node may be slowed now.
    #[inline]
    #[must_use]
    pub fn acts(&self) -> bool {
        !self.rates.is_empty() || self.relaxation.is_some()
    }

    /// a of a node.
    #[inline]
    #[must_use]
    pub fn factor(&self, node: usize) -> f64 {
        0.5 * self.rate(node) * self.time_step
    }

    /// a of eight nodes from `first` on.
    #[must_use]
    pub fn factors(&self, first: usize) -> Batch {
        Batch(std::array::from_fn(|lane| self.factor(first + lane)))
    }

    /// Rate of a node now, 1/s.
    #[must_use]
    pub fn rate(&self, node: usize) -> f64 {
        self.rates.get(node).copied().unwrap_or(0.0) + self.relaxation.unwrap_or(0.0)
    }

    /// Rate now on free obstacles, 1/s.
    #[must_use]
    pub fn rate_everywhere(&self) -> f64 {
        self.everywhere + self.relaxation.unwrap_or(0.0)
    }
}
