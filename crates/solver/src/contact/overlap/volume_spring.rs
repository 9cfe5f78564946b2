//! The volume spring under the springs of nodes and edges: a spring on the volume of an overlap.
//!
//! Its depth grows by dV/A from zero, with the area A = |N| at which the volume spring was cast; k = κ A with
//! the pressure stiffness κ of the softer side. V is once continuously differentiable through all changes of
//! nodes, edges and faces that touch, and its rows −(∂V/∂x)/A add up to nothing, so the volume spring has no
//! hand-over, needs no normal, and keeps both momenta. It begins without force, so it brings no energy, and
//! resists whatever makes the overlap larger, combs of edges and folded nodes included. Regions that merge or
//! part share A by their volumes, and the depth is the mean. From step to step a volume spring continues
//! where it ended, as other springs do: its rows are those of the volume at a step, which bends in between.
//!
//! For a few steps a volume spring continues with the nodes that it has: V grows by its rows times their
//! ways, and the rows r lose what would turn the bodies, ω × d with (Σ d² 1 − d ⊗ d) ω = Σ d × r and d from
//! the mean of the nodes, so both momenta are kept. Then V is measured again.

use super::super::law::penalty::{factor, stiffening};
use super::super::projection::node_facet::unit;
use super::super::springs::{Answers, End, Slip, Spring, Springs};
use super::super::{Sweep, spin};
use super::{CAST, DIRECTED, Known, OverlapCheck, Region, Vector};
use crate::archive::persist_all;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};

/// Depth below which a region loses its volume spring, as a fraction of the local thickness.
const TAKEN_IN: f64 = 0.02;
/// Least area of a volume spring, as a fraction of that of the region.
const SPREAD: f64 = 0.5;
/// Regions with volume springs are found again at every so many steps, and where a body may have gone farther
/// than this fraction of the least thickness.
const EVERY: u32 = 8;
const WAY: f64 = 1.0 / 64.0;
/// How much of the rows of a volume spring what would turn the bodies may be before its region is found
/// again.
const TURNED: f64 = 0.1;
/// Moment of the rows that is left, as a fraction of that of their sizes: more than rounding, and the region
/// is found again.
const LEFT: f64 = 1e-12;

/// The volume spring of a region.
#[derive(Clone, Debug, Default)]
pub(super) struct VolumeSpring {
    /// Which of those that are known.
    pub(super) region: u32,
    /// Along the area vector of the region.
    normal: Vector,
    /// Pressure stiffness, of the elements and by their mass, Pa/m.
    modulus: [f64; 2],
    /// ∂V/∂x of nodes, m².
    pub(super) rows: Vec<(u32, Vector)>,
}

persist_all!(VolumeSpring { region, normal, modulus, rows });

impl VolumeSpring {
    /// Continues with its nodes for a step, whose way to its depth `known` takes; whether it can.
    fn follow(&mut self, known: &mut Known, sweep: Sweep<'_, 3>) -> bool {
        let at = |node: u32| sweep.new[node as usize];
        let grown = self.rows.iter().map(|&(node, row)| dot(row, minus(at(node), sweep.old[node as usize]))).sum();
        known.since += grown;
        known.grow(grown);
        let mut mean = [0.0; 3];
        for &(node, _) in &self.rows {
            (0..3).for_each(|d| mean[d] += at(node)[d] / self.rows.len() as f64);
        }
        let moment = |rows: &[(u32, Vector)]| {
            let of = |&(node, row): &(u32, Vector)| (cross(minus(at(node), mean), row), length(minus(at(node), mean)) * length(row));
            rows.iter().map(of).fold(([0.0; 3], 0.0), |(sum, size), (moment, most)| ([0, 1, 2].map(|d| sum[d] + moment[d]), size + most))
        };
        let mut inertia = [[0.0; 3]; 3];
        self.rows.iter().for_each(|&(node, _)| spin::add_arm(minus(at(node), mean), &mut inertia));
        let turn = spin::solved(&inertia, moment(&self.rows).0);
        let (mut lost, mut whole) = (0.0, 0.0);
        for (node, row) in &mut self.rows {
            let less = cross(turn, minus(at(*node), mean));
            whole += dot(*row, *row);
            lost += dot(less, less);
            *row = minus(*row, less);
        }
        let (left, size) = moment(&self.rows);
        lost <= TURNED * TURNED * whole && length(left) <= LEFT * size
    }

    /// Its spring.
    fn spring(&self, known: &Known) -> Spring<3> {
        let [modulus, of_mass] = self.modulus;
        Spring {
            normal: self.normal,
            gap: -known.depth,
            stiffness: modulus * known.area,
            area: known.area,
            stiffening: stiffening(known.thick, factor(modulus, of_mass)),
            ..Spring::default()
        }
    }
}

impl Known {
    /// The volume grows (m³), and the volume spring with it.
    fn grow(&mut self, grown: f64) {
        self.depth += grown / self.area;
        // What is open stores nothing: if it grows again it is resisted from here.
        if self.depth < 0.0 && grown > 0.0 {
            self.depth = 0.0;
        }
    }

    /// Casts, spreads or takes in the volume spring, whose region was found again; no node has gone farther
    /// than `way` since it was found before, m.
    fn cast(&mut self, region: &Region, way: f64) {
        // A volume grows by what its sides go. If by more, it is another one, and the volume spring keeps its
        // force.
        let (grown, since) = (self.volume - self.before, std::mem::take(&mut self.since));
        let is_another = grown.abs() > 8.0 * way * region.size.min(self.size_before);
        if region.is_open || !region.is_closed {
            // Its volume says nothing, or its forces would not add up to nothing.
            self.area = 0.0;
        } else if self.area > 0.0 {
            self.grow(if is_another { 0.0 } else { grown - since });
            // Where the region outgrows the volume spring, that spreads and keeps its energy.
            let least = SPREAD * region.size;
            if self.area < least {
                self.depth *= (self.area / least).sqrt();
                self.area = least;
            }
            if self.ratio < TAKEN_IN && self.depth <= 0.0 {
                self.area = 0.0;
            }
        } else if self.ratio > CAST {
            (self.area, self.depth) = (length(region.area).max(DIRECTED * region.size), 0.0);
            self.thick = self.thickness;
            (self.half, self.stored) = (f64::INFINITY, 0.0);
        }
    }
}

impl OverlapCheck {
    /// Casts the volume springs of regions that were found again.
    pub(super) fn cast(&mut self, way: f64) {
        for number in 0..self.regions.len() {
            let (region, known) = (&self.regions[number], &mut self.known[number]);
            known.cast(region, way);
            if self.known[number].area > 0.0
                && let Some(modulus) = self.modulus(region)
            {
                let rows = region.gradient.iter().map(|&(vertex, row)| (self.skin.nodes[vertex as usize], row)).collect();
                self.volume_springs.push(VolumeSpring { region: number as u32, normal: unit(region.area), modulus, rows });
            }
        }
    }

    /// Lets the volume springs continue with their nodes for a step; whether all can.
    pub(super) fn follow(&mut self, sweep: Sweep<'_, 3>) -> bool {
        let is_due = self.steps.is_multiple_of(EVERY) || !(sweep.travel - self.found_at < WAY * self.least);
        self.volume_springs.is_empty()
            || (!is_due
                && self
                    .volume_springs
                    .iter_mut()
                    .all(|volume_spring| volume_spring.follow(&mut self.known[volume_spring.region as usize], sweep)))
    }

    /// Adds the springs of the volume springs in this step, each where it ended in the step before; `found`
    /// gets the energy that each had there, J.
    pub(in crate::contact) fn push_nets(&self, springs: &mut Springs<3>, mut found: impl FnMut(f64)) {
        let mut ends = Vec::new();
        for volume_spring in &self.volume_springs {
            let known = &self.known[volume_spring.region as usize];
            ends.clear();
            ends.extend(volume_spring.rows.iter().map(|&(node, row)| End { lean: row.map(|c| -c / known.area), ..End::node(node, 0.0) }));
            springs.push(volume_spring.spring(known), Slip::default(), &ends);
            springs.continues(known.half, known.stored);
            found(known.stored);
        }
    }

    /// Notes where the volume springs of this step ended; `store` gets the energy of each, J.
    pub(in crate::contact) fn note_nets(&mut self, solved: Answers<'_, 3>, mut store: impl FnMut(f64)) {
        for (volume_spring, answer) in self.volume_springs.iter().zip(solved) {
            let known = &mut self.known[volume_spring.region as usize];
            (known.half, known.stored) = (answer.gap_new(), answer.stored_new());
            store(known.stored);
        }
    }

    /// Pressure stiffness of the softer side of a region, of its elements and by its mass, the mean of its
    /// nodes there, Pa/m.
    fn modulus(&self, region: &Region) -> Option<[f64; 2]> {
        let (mut sums, mut counts) = ([[0.0; 2]; 2], [0.0; 2]);
        for &(triangle, is_second) in &region.triangles {
            for vertex in self.skin.triangles[triangle as usize] {
                let [modulus, of_mass] = self.moduli.get(vertex as usize).copied().unwrap_or_default();
                if modulus > 0.0 {
                    let sum: &mut [f64; 2] = &mut sums[usize::from(is_second)];
                    *sum = [sum[0] + modulus, sum[1] + of_mass];
                    counts[usize::from(is_second)] += 1.0;
                }
            }
        }
        let mean = |of: usize| (counts[of] > 0.0).then(|| sums[of].map(|sum| sum / counts[of]));
        match (mean(0), mean(1)) {
            (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].min(b[1])]),
            (one, other) => one.or(other),
        }
    }
}
