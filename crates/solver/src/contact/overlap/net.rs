//! The net under the springs of nodes and edges: a spring on the volume of an overlap.
//!
//! Its depth grows by dV/A from zero, with the area A = |N| at which the net was cast; k = κ A with the pressure stiffness κ of the softer
//! side. V is once continuously differentiable through all changes
//! of nodes, edges and faces that touch, and its rows −(∂V/∂x)/A add up to nothing, so the net has no hand-over, needs no normal, and keeps
//! both momenta. It begins without force, so it brings no
//! energy, and resists whatever makes the overlap larger, combs of edges and folded nodes included. Regions that merge or part share A by
//! their volumes, and the depth is the mean. From step to step a net goes on where it ended, as other springs do: its rows are those of
//! the volume at a step, which bends in between.

use super::super::law::penalty::{factor, stiffening};
use super::super::projection::node_facet::unit;
use super::super::springs::{Answers, End, Spring, Springs};
use super::{CAST, DIRECTED, Judge, Known, Vector};
use crate::vector::length;

/// Depth below which a region loses its net, as a fraction of the local thickness.
const TAKEN_IN: f64 = 0.02;
/// Least area of a net, as a fraction of that of the region.
const SPREAD: f64 = 0.5;

impl Judge {
    /// Casts or takes in the net of a region; no node has gone farther than `way` since the last look, m.
    pub(super) fn cast(&mut self, number: usize, way: f64) {
        let (region, known) = (&self.regions[number], &mut self.known[number]);
        // A volume grows by what its sides go. If by more, it is another one, and the net keeps its force.
        let grown = region.volume - known.before;
        let grown = if grown.abs() > 8.0 * way * region.size.min(known.size_before) { 0.0 } else { grown };
        if region.is_open || !region.is_closed {
            // Its volume says nothing, or its forces would not add up to nothing.
            known.area = 0.0;
        } else if known.area > 0.0 {
            known.depth += grown / known.area;
            // Where the region outgrows the net, that spreads and keeps its energy.
            let least = SPREAD * region.size;
            if known.area < least {
                known.depth *= (known.area / least).sqrt();
                known.area = least;
            }
            // What is open stores nothing: if it grows again it is resisted from here.
            if known.depth < 0.0 && grown > 0.0 {
                known.depth = 0.0;
            }
            if known.ratio < TAKEN_IN && known.depth <= 0.0 {
                known.area = 0.0;
            }
        } else if known.ratio > CAST {
            (known.area, known.depth) = (length(region.area).max(DIRECTED * region.size), 0.0);
            known.thick = known.thickness;
            (known.half, known.stored) = (f64::INFINITY, 0.0);
        }
    }

    /// Adds the springs of the nets in this step, each where it ended in the step before; `found` gets the energy that each had there, J.
    pub(in crate::contact) fn push_nets(&mut self, springs: &mut Springs<3>, mut found: impl FnMut(f64)) {
        self.netted.clear();
        let regions = if self.has_looked { self.regions.len() } else { 0 };
        for number in 0..regions {
            let Known { area, half, stored, .. } = self.known[number];
            if area > 0.0
                && let Some((spring, ends)) = self.net(number)
            {
                springs.push(spring, &ends);
                springs.goes_on(half, stored);
                found(stored);
                self.netted.push(number as u32);
            }
        }
    }

    /// Notes where the nets of this step ended; `store` gets the energy of each, J.
    pub(in crate::contact) fn note_nets(&mut self, solved: Answers<'_, 3>, mut store: impl FnMut(f64)) {
        for (&number, answer) in self.netted.iter().zip(solved) {
            let known = &mut self.known[number as usize];
            (known.half, known.stored) = (answer.gap_new(), answer.stored_new());
            store(known.stored);
        }
    }

    /// The spring of the net of a region.
    fn net(&self, number: usize) -> Option<(Spring<3>, Vec<End<3>>)> {
        let (region, known) = (&self.regions[number], &self.known[number]);
        let [modulus, of_mass] = self.modulus(region)?;
        let row = |&(vertex, row): &(u32, Vector)| {
            let lean = row.map(|c| -c / known.area);
            End { lean, ..End::node(self.skin.nodes[vertex as usize], 0.0) }
        };
        let spring = Spring {
            normal: unit(region.area),
            gap: -known.depth,
            stiffness: modulus * known.area,
            area: known.area,
            stiffening: stiffening(known.thick, factor(modulus, of_mass)),
            ..Spring::default()
        };
        Some((spring, region.gradient.iter().map(row).collect()))
    }

    /// Pressure stiffness of the softer side of a region, of its elements and by its mass, the mean of its nodes there, Pa/m.
    fn modulus(&self, region: &super::Region) -> Option<[f64; 2]> {
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
