//! What becomes of a culprit and its neighbourhood, step by step.
//!
//! A [`Tracer`] looks at the system after every step of a simulation that goes to a failure for the second time, and changes nothing; what it saw is a [`Trace`].

use super::{Near, Neighbourhood, Suspect};
use crate::error::Error;
use crate::material::Variable;
use crate::output::Outline;
use crate::record::{Recorded, von_mises};
use crate::simulation::Simulation;
use crate::step::System;
use crate::watch::shape;

/// Figures of the culprit at one step; what it does not have is not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vitals {
    /// Stable step of the element, s.
    pub time_step: f64,
    /// Its shape: smallest Jacobian determinant at a corner over the square of the longest side; 1 for a square, zero or less when it is inside out.
    pub shape: f64,
    /// Its area (of a bar: length) over that at the start.
    pub area_ratio: f64,
    /// Largest and smallest principal logarithmic strain at its centre, from the initial to the current nodes.
    pub strains: [f64; 2],
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Temperature, K.
    pub temperature: f64,
    /// Damage.
    pub damage: f64,
    /// Equivalent stress, Pa.
    pub von_mises: f64,
    /// Pressure, Pa.
    pub pressure: f64,
    /// Elastic energy per initial volume, J/m³.
    pub energy_density: f64,
    /// Largest speed of its nodes (of a node: its own), m/s.
    pub speed: f64,
    /// Largest contact force on its nodes (of a node: its own), N/m.
    pub contact_force: f64,
    /// Depth of the contact, m.
    pub penetration: f64,
}

/// The neighbourhood after one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Step number.
    pub step: u64,
    /// Time, s.
    pub time: f64,
    /// The step that led here, s.
    pub time_step: f64,
    /// Energy drift so far, fraction.
    pub drift: f64,
    /// The row of the history, by [`Simulation::history_columns`]; empty where the step failed before its books were closed.
    pub row: Vec<f64>,
    /// Of the culprit.
    pub vitals: Vitals,
    /// Places of [`Neighbourhood::nodes`], m.
    pub positions: Vec<[f64; 2]>,
    /// Contact forces on them, N/m.
    pub forces: Vec<[f64; 2]>,
    /// What each of [`Trace::contacts`] presses with on the culprit and the elements next to it, summed over their nodes, N/m.
    pub pressing: Vec<f64>,
    /// The field of each of [`Neighbourhood::cells`].
    pub values: Vec<f64>,
    /// Obstacles.
    pub outlines: Vec<Outline>,
}

/// The step in which the sum of all energies changed most, which it should not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Step number.
    pub step: u64,
    /// Change, as a fraction of the largest total energy.
    pub size: f64,
    /// The node whose energy changed most then, with the contact that pressed on it.
    pub suspect: Suspect,
}

/// What was seen on the way to a failure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Names of the columns of [`Moment::row`].
    pub columns: Vec<String>,
    /// Contacts and obstacles: `contact` or `obstacle`, and their names.
    pub contacts: Vec<(&'static str, String)>,
    /// What is followed.
    pub near: Neighbourhood,
    /// The last steps, one after the other; the last one is that which failed.
    pub moments: Vec<Moment>,
    /// First step that was looked at, and the energy drift before it, fraction.
    pub begin: (u64, f64),
    /// The worst step for the balance of energies.
    pub jump: Option<Jump>,
}

/// Looks at a system after every step.
pub(crate) struct Tracer {
    suspect: Suspect,
    near: Near,
    /// First step that is kept.
    from: u64,
    /// Sum of all energies after the last step, J/m.
    total: f64,
    trace: Trace,
}

impl Tracer {
    fn new(suspect: Suspect, near: Near, from: u64, columns: Vec<String>, system: &System) -> Self {
        let contacts = system.contacts.iter().map(|contact| (contact.kind.name(), contact.name.clone())).collect();
        let trace = Trace { columns, contacts, near: near.shown.clone(), begin: (system.step, system.ledger.drift()), ..Trace::default() };
        Self { suspect, near, from, total: balance(system), trace }
    }

    /// Looks at the system after a step, or after one that failed.
    pub(crate) fn note(&mut self, system: &System, recorded: &Recorded, error: Option<&Error>) {
        // These are looked for when the books are closed.
        let is_late = |error| matches!(error, &Error::EnergyDrift { .. } | &Error::TooDeep { .. } | &Error::Runaway { .. });
        let is_closed = error.is_none_or(is_late);
        if is_closed {
            let total = balance(system);
            let size = (total - self.total).abs() / system.ledger.largest;
            if self.trace.jump.is_none_or(|jump| size > jump.size) {
                self.trace.jump = Some(Jump { step: system.step, size, suspect: system.hottest() });
            }
            self.total = total;
        }
        if system.step >= self.from {
            self.trace.moments.push(system.moment(&self.suspect, &self.near, recorded, is_closed));
        }
    }
}

/// What must stay constant, J/m.
fn balance(system: &System) -> f64 {
    system.ledger.stores.total() - system.ledger.external
}

impl System {
    fn moment(&self, suspect: &Suspect, near: &Near, recorded: &Recorded, is_closed: bool) -> Moment {
        let field = |&(g, element): &(usize, usize)| {
            let state = self.blocks[g].state(element);
            if near.is_plastic { state.variables[Variable::PlasticStrain as usize] } else { von_mises(&state.stress) }
        };
        Moment {
            step: self.step,
            time: self.time,
            time_step: self.time_step_old,
            drift: self.ledger.drift(),
            row: if is_closed { recorded.row(self) } else { Vec::new() },
            vitals: self.vitals(suspect),
            positions: near.nodes.iter().map(|&node| self.positions[node as usize]).collect(),
            forces: near.nodes.iter().map(|&node| self.contact_force(node as usize)).collect(),
            pressing: self.contacts.iter().map(|contact| contact.force_on(&near.next, &self.springs)).collect(),
            values: near.cells.iter().map(field).collect(),
            outlines: self.outlines.iter().map(|outline| outline.now(&self.bodies)).collect(),
        }
    }

    /// Zero where nothing touches.
    fn contact_force(&self, node: usize) -> [f64; 2] {
        if self.contacts.is_empty() { [0.0; 2] } else { self.contact_forces.of(node) }
    }

    fn vitals(&self, suspect: &Suspect) -> Vitals {
        let norm = |v: [f64; 2]| (v[0] * v[0] + v[1] * v[1]).sqrt();
        let own: Vec<usize> = match (suspect.node, suspect.element) {
            (Some(node), _) => vec![node],
            (None, Some((g, element))) => self.mesh.groups[g].cell(element).iter().map(|&node| node as usize).collect(),
            (None, None) => Vec::new(),
        };
        let most = |value: &dyn Fn(usize) -> f64| own.iter().map(|&node| value(node)).fold(f64::NAN, f64::max);
        let mut vitals = Vitals {
            time_step: f64::NAN,
            shape: f64::NAN,
            area_ratio: f64::NAN,
            strains: [f64::NAN; 2],
            plastic_strain: f64::NAN,
            temperature: f64::NAN,
            damage: f64::NAN,
            von_mises: f64::NAN,
            pressure: f64::NAN,
            energy_density: f64::NAN,
            speed: most(&|node| norm(self.velocities[node])),
            contact_force: if self.contacts.is_empty() { f64::NAN } else { most(&|node| norm(self.contact_force(node))) },
            penetration: suspect.contact.map_or(f64::NAN, |contact| self.contacts[contact].penetration),
        };
        if let Some((g, element)) = suspect.element {
            let (block, cell) = (&self.blocks[g], self.mesh.groups[g].cell(element));
            let state = block.state(element);
            let variable = |of: Variable| if block.has(of) { state.variables[of as usize] } else { f64::NAN };
            vitals.time_step = block.time_step_squared(element).sqrt();
            vitals.shape = shape(cell, &self.positions);
            vitals.area_ratio = size(cell, &self.positions) / size(cell, &self.mesh.positions);
            vitals.strains = strains(cell, &self.mesh.positions, &self.positions);
            vitals.plastic_strain = variable(Variable::PlasticStrain);
            vitals.temperature = variable(Variable::Temperature);
            vitals.damage = variable(Variable::Damage);
            vitals.von_mises = von_mises(&state.stress);
            vitals.pressure = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3.0;
            vitals.energy_density = state.energy_density;
        }
        vitals
    }
}

/// Length of a line, area of what has more corners; m, m².
pub(super) fn size(cell: &[u32], positions: &[[f64; 2]]) -> f64 {
    let x = |corner: usize| positions[cell[corner % cell.len()] as usize];
    if cell.len() == 2 {
        let [a, b] = [x(0), x(1)];
        return ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt();
    }
    let o = x(0);
    let cross = |corner: usize| {
        let (a, b) = (x(corner), x(corner + 1));
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    0.5 * (0..cell.len()).map(cross).sum::<f64>()
}

/// Principal logarithmic strains at the centre, the larger first: half the logarithms of the eigenvalues of FᵀF. Of a line its one strain twice.
fn strains(cell: &[u32], from: &[[f64; 2]], to: &[[f64; 2]]) -> [f64; 2] {
    if cell.len() == 2 {
        return [(size(cell, to) / size(cell, from)).ln(); 2];
    }
    // Of a triangle two sides, of a quadrilateral the means of two opposite sides: F maps those at the start to those now.
    let sides = |x: &[[f64; 2]]| {
        let p = |corner: usize| x[cell[corner] as usize];
        if cell.len() == 3 {
            let (a, b, c) = (p(0), p(1), p(2));
            [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]]
        } else {
            let (a, b, c, d) = (p(0), p(1), p(2), p(3));
            [[0, 1].map(|k| 0.5 * (b[k] + c[k] - a[k] - d[k])), [0, 1].map(|k| 0.5 * (c[k] + d[k] - a[k] - b[k]))]
        }
    };
    let ([u, v], [a, b]) = (sides(from), sides(to));
    let inverse = 1.0 / (u[0] * v[1] - u[1] * v[0]);
    // F = [a b] [u v]⁻¹, row by row.
    let f: [[f64; 2]; 2] = [0, 1].map(|k| [(a[k] * v[1] - b[k] * u[1]) * inverse, (b[k] * u[0] - a[k] * v[0]) * inverse]);
    let c = |i: usize, j: usize| f[0][i] * f[0][j] + f[1][i] * f[1][j];
    let (mean, half, shear) = (0.5 * (c(0, 0) + c(1, 1)), 0.5 * (c(0, 0) - c(1, 1)), c(0, 1));
    let radius = (half * half + shear * shear).sqrt();
    [0.5 * (mean + radius).ln(), 0.5 * (mean - radius).max(0.0).ln()]
}

impl Simulation {
    /// From now on looks at a suspect, with what `at_failure`, the simulation that failed, has around it, after every step from number `from` on.
    pub fn follow(&mut self, suspect: &Suspect, at_failure: &Self, from: u64) {
        let near = at_failure.system.near(suspect);
        self.tracer = Some(Box::new(Tracer::new(*suspect, near, from, self.history_columns(), &self.system)));
    }

    /// What was seen since [`Simulation::follow`]; looks no more.
    pub fn take_trace(&mut self) -> Option<Trace> {
        self.tracer.take().map(|tracer| tracer.trace)
    }

    /// The state of a failure alone.
    #[must_use]
    pub fn trace_now(&self, suspect: &Suspect, error: Option<&Error>) -> Trace {
        let mut tracer = Tracer::new(*suspect, self.system.near(suspect), 0, self.history_columns(), &self.system);
        tracer.note(&self.system, &self.recorded, error);
        Trace { jump: None, ..tracer.trace }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strains_are_those_of_the_stretch_whatever_the_rotation() {
        let from = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let (c, s) = (0.6, 0.8);
        // x stretched to twice, y to half, then turned.
        let to = from.map(|[x, y]| [2.0 * x * c - 0.5 * y * s, 2.0 * x * s + 0.5 * y * c]);
        for cell in [&[0, 1, 2, 3][..], &[0, 1, 2]] {
            let [most, least] = strains(cell, &from, &to);
            assert!((most - 2f64.ln()).abs() < 1e-12 && (least + 2f64.ln()).abs() < 1e-12, "{most} {least}");
            assert!((size(cell, &to) / size(cell, &from) - 1.0).abs() < 1e-12);
        }
        assert!((strains(&[0, 1], &from, &to)[0] - 2f64.ln()).abs() < 1e-12);
        let flat = from.map(|[x, _]| [x, 0.0]);
        assert_eq!(strains(&[0, 1, 2, 3], &from, &flat)[1], f64::NEG_INFINITY);
    }
}
