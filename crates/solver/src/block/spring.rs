//! Springs and dampers between pairs of nodes, as a block of two-node elements without mass.
//!
//! F = k (l − l₀) or a curve F(l − l₀), constant beyond its ends, and c l̇, along the line between the nodes
//! (N per metre of depth, between solids N). A spring breaks for good when |F| exceeds its strength. Work by
//! the trapezoidal rule, as the nodal works of the ledger: that of the spring is stored until it breaks, that
//! of the damper is dissipated.
//!
//! Stable step of springs alone: by Gershgorin ω² ≤ 2 Σ k / m over the springs of a node, a damper that lags
//! half a step takes part as 2c/Δt: dt² Σ k / (2m) + dt Σ c / m ≤ 1. [`together`] joins it to that of the
//! elements.

use super::{Block, ElementState, Initial, Motion, NodalForces, Report, Wrong};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::failure::Criterion;
use crate::load::curve::table::Table;
use crate::material::points::PointLaw;
use crate::model::Spring;
use crate::tensor::{Dim, Space};
use crate::vector::{dot, minus};
use embate_lanes::{Level, Team};

/// A pair of nodes with its state.
#[derive(Clone, Debug)]
struct Pair {
    nodes: [u32; 2],
    /// Index of its law.
    law: usize,
    /// Length without force, m, and that of the last step.
    rest: f64,
    length: f64,
    /// Forces of spring and damper in the last step, N/m.
    forces: [f64; 2],
    /// Energies, J/m.
    stored: f64,
    dissipated: f64,
    is_whole: bool,
    time_step_squared: f64,
}

impl Persist for Pair {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { nodes: _, law: _, rest: _, time_step_squared: _, length, forces, stored, dissipated, is_whole } = self;
        persist_each!(archive; length, forces, stored, dissipated, is_whole);
        Ok(())
    }
}

/// What acts between the nodes of a pair.
#[derive(Clone, Debug)]
struct Law {
    table: Option<Table>,
    stiffness: f64,
    damping: f64,
    strength: f64,
}

impl Law {
    fn new(spring: &Spring) -> Self {
        let table = (!spring.elongation.is_empty()).then(|| Table {
            times: spring.elongation.clone(),
            values: spring.force.clone(),
            smooth: false,
        });
        let slopes = |(x, f): (&[f64], &[f64])| ((f[1] - f[0]) / (x[1] - x[0])).abs();
        let steepest = spring.elongation.windows(2).zip(spring.force.windows(2)).map(slopes).fold(0.0, f64::max);
        Self {
            stiffness: if table.is_some() { steepest } else { spring.stiffness },
            table,
            damping: spring.damping,
            strength: spring.strength.unwrap_or(f64::INFINITY),
        }
    }

    fn force(&self, elongation: f64) -> f64 {
        self.table.as_ref().map_or(self.stiffness * elongation, |table| table.value(elongation))
    }
}

/// The springs of a model.
pub(crate) struct SpringBlock {
    pairs: Vec<Pair>,
    /// Their nodes, two by two: the slots of the forces.
    slots: Vec<u32>,
    laws: Vec<Law>,
    /// What the last step reported.
    report: Report,
}

impl SpringBlock {
    /// Of springs with their pairs of nodes; `mass` of every node, kg/m (kg).
    pub(crate) fn new<const D: usize>(springs: &[(&Spring, Vec<[u32; 2]>)], positions: &[[f64; D]], mass: &[f64]) -> Self {
        let laws: Vec<Law> = springs.iter().map(|(spring, _)| Law::new(spring)).collect();
        let mut pairs = Vec::new();
        for (law, (spring, nodes)) in springs.iter().enumerate() {
            for &nodes in nodes {
                let length = line(positions, nodes).0;
                pairs.push(Pair {
                    nodes,
                    law,
                    rest: spring.length.unwrap_or(length),
                    length,
                    forces: [0.0; 2],
                    stored: 0.0,
                    dissipated: 0.0,
                    is_whole: true,
                    time_step_squared: 0.0,
                });
            }
        }
        let mut sums = vec![[0.0; 2]; mass.len()];
        for pair in &pairs {
            for node in pair.nodes {
                let sum = &mut sums[node as usize];
                *sum = [sum[0] + laws[pair.law].stiffness, sum[1] + laws[pair.law].damping];
            }
        }
        let of_node = |node: u32| {
            let ([k, c], m) = (sums[node as usize], mass[node as usize]);
            let (k, c) = (0.5 * k / m, c / m); // k dt² + c dt = 1
            let step = 2.0 / (c + (c * c + 4.0 * k).sqrt());
            step * step
        };
        for pair in &mut pairs {
            pair.time_step_squared = of_node(pair.nodes[0]).min(of_node(pair.nodes[1]));
            // What is stretched at the start has been stretched from its rest.
            pair.stored = start(&laws[pair.law], pair.length - pair.rest);
            pair.forces[0] = laws[pair.law].force(pair.length - pair.rest);
        }
        Self { slots: pairs.iter().flat_map(|pair| pair.nodes).collect(), pairs, laws, report: Report::NOTHING }
    }
}

/// Square of the step that is stable for elements and springs on the same nodes, from those of each alone:
/// (dt/dt_e)² + dt/dt_s ≤ 1, which is enough for stiffness and for damping.
pub(crate) fn together(elements: f64, springs: f64) -> f64 {
    let half = 0.5 * (elements / springs).sqrt();
    let factor = (half * half + 1.0).sqrt() - half;
    if half.is_finite() { elements * factor * factor } else { springs }
}

/// ∫ F du from rest, by the trapezoidal rule over the corners of a curve.
fn start(law: &Law, elongation: f64) -> f64 {
    let (low, high) = (elongation.min(0.0), elongation.max(0.0));
    let corners = law.table.iter().flat_map(|table| table.times.iter().copied().filter(|&x| low < x && x < high));
    let places: Vec<f64> = [low].into_iter().chain(corners).chain([high]).collect();
    let sum: f64 = places.windows(2).map(|x| 0.5 * (law.force(x[0]) + law.force(x[1])) * (x[1] - x[0])).sum();
    if elongation < 0.0 { -sum } else { sum }
}

/// Length and direction from the first node to the second; no direction where they coincide.
fn line<const D: usize>(x: &[[f64; D]], nodes: [u32; 2]) -> (f64, [f64; D]) {
    let [a, b] = nodes.map(|node| x[node as usize]);
    let d = minus(b, a);
    let length = dot(d, d).sqrt();
    (length, if length > 0.0 { d.map(|d| d / length) } else { [0.0; D] })
}

impl<const D: usize> Block<D> for SpringBlock
where
    Dim<D>: Space<D>,
{
    fn elements(&self) -> usize {
        self.pairs.len()
    }

    fn slots(&self) -> &[u32] {
        &self.slots
    }

    fn advance(
        &mut self,
        motion: &Motion<'_, D>,
        _level: Level,
        NodalForces { forces: slots, .. }: NodalForces<'_, D>,
        _team: &mut Team,
    ) -> Report {
        let mut report = Report::NOTHING;
        for (element, pair) in self.pairs.iter_mut().enumerate() {
            let law = &self.laws[pair.law];
            let (length, direction) = line(motion.positions, pair.nodes);
            let [v, w] = pair.nodes.map(|node| motion.velocities[node as usize]);
            let rate = dot(minus(w, v), direction);
            let mut forces = [law.force(length - pair.rest), law.damping * rate];
            if pair.is_whole && forces[0].abs() > law.strength {
                pair.is_whole = false;
            }
            if !pair.is_whole {
                forces = [0.0; 2];
            }
            let change = length - pair.length;
            pair.stored += 0.5 * (forces[0] + pair.forces[0]) * change;
            pair.dissipated += 0.5 * (forces[1] + pair.forces[1]) * change;
            if !pair.is_whole {
                pair.dissipated += std::mem::take(&mut pair.stored);
            }
            (pair.length, pair.forces) = (length, forces);
            for (slot, sign) in slots[2 * element..2 * element + 2].iter_mut().zip([1.0, -1.0]) {
                *slot = direction.map(|component| sign * (forces[0] + forces[1]) * component);
            }
            if pair.is_whole {
                report.time_step_squared = report.time_step_squared.min(pair.time_step_squared);
            }
            report.stored += pair.stored;
            report.dissipated += pair.dissipated;
        }
        self.report = report;
        report
    }

    fn mass(&self, _element: usize) -> f64 {
        0.0
    }
    fn corner_mass(&self, _element: usize, _corner: usize) -> f64 {
        0.0
    }
    fn time_step_squared(&self, element: usize) -> f64 {
        self.pairs[element].time_step_squared
    }
    // The step of springs counts besides that of the elements ([`together`]).
    fn bound_stiffness(&self, _shortest: f64, _add: &mut dyn FnMut(u32, f64, f64)) {}
    fn mark_time_steps(&mut self) {}
    fn state(&self, _element: usize) -> ElementState {
        ElementState::default()
    }
    fn law(&self) -> Option<&dyn PointLaw> {
        None
    }
    // Springs have no mass, and break by their strength: no criterion of a material takes them out.
    fn scale_mass(&mut self, _element: usize, _factor: f64) {}
    // They have a length without force instead.
    fn begin(&mut self, _initial: &Initial<'_>, _positions: &[[f64; D]]) -> Result<(), Wrong> {
        Ok(())
    }
    fn is_alive(&self, element: usize) -> bool {
        self.pairs[element].is_whole
    }
    fn failed(&self, _criteria: &[Criterion], _parallel: bool) -> Vec<(u32, u32)> {
        Vec::new()
    }
    fn determinant(&self, _element: usize, _positions: &[[f64; D]]) -> f64 {
        f64::INFINITY
    }
    fn force(&self, element: usize, corner: usize, slots: &[[f64; D]]) -> [f64; D] {
        slots[2 * element + corner]
    }
    fn erode(&mut self, _elements: &[u32], _: NodalForces<'_, D>) -> Vec<f64> {
        Vec::new()
    }
    fn report(&self, _positions: &[[f64; D]]) -> Report {
        self.report
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { pairs, slots: _, laws: _, report } = self;
        pairs[..].persist(archive)?;
        report.persist(archive)
    }
}
