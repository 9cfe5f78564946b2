//! What elements that are made again in the run get from those before them: stresses and states of their
//! points, densities, and the energies of the block so far.

use super::Report;
use super::kernel::{ElementGeometry, Facts};
use super::store::ElementStore;
use crate::tensor::{Dim, Space};
use embate_lanes::{BATCH, Batch};

/// Stresses and states of the points of a block, element by element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointValues {
    /// Points of an element.
    pub points: usize,
    /// Components of a stress: xx yy zz xy (yz zx), Pa.
    pub components: usize,
    /// Numbers of a point: its stress, then what its law remembers.
    pub width: usize,
    /// `width` numbers for each point, point by point and element by element.
    pub values: Vec<f64>,
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// See [`super::Block::point_values`].
    pub(super) fn values_of_points(&self) -> Option<PointValues> {
        if !self.law.can_be_averaged() || self.nodal.is_some() {
            return None;
        }
        let (Facts { points, components, .. }, state) = (*self.facts(), self.law.state_width());
        let mut values = Vec::with_capacity(self.count * points * (components + state));
        for element in 0..self.count {
            let (batch, lane) = (element / BATCH, element % BATCH);
            for point in batch * points..(batch + 1) * points {
                let own = self.stress[point * components..][..components].iter().chain(&self.history[point * state..][..state]);
                values.extend(own.map(|batch| batch.0[lane]));
            }
        }
        Some(PointValues { points, components, width: components + state, values })
    }

    /// See [`super::Block::elastic_energy`].
    pub(super) fn energy_of_stresses(&self, positions: &[[f64; D]]) -> f64 {
        let Facts { points, components, .. } = *self.facts();
        let (mut corners, mut geometry) = (Vec::new(), ElementGeometry::default());
        let mut energy = 0.0;
        for element in 0..self.count {
            let (batch, lane) = (element / BATCH, element % BATCH);
            self.corners(batch, lane, positions, &mut corners);
            self.kernel.geometry(&corners, &mut geometry);
            for p in 0..points {
                let stress = &self.stress[(batch * points + p) * components..][..components];
                let all = std::array::from_fn(|c| stress.get(c).map_or(0.0, |batch| batch.0[lane]));
                energy += self.law.energy(all) * geometry.volumes[p];
            }
        }
        energy
    }

    /// See [`super::Block::take_point_values`].
    pub(super) fn fill_points(&mut self, given: &PointValues, before: &Report, positions: &[[f64; D]]) {
        let (Facts { points, components, .. }, state) = (*self.facts(), self.law.state_width());
        let (mut corners, mut geometry) = (Vec::new(), ElementGeometry::default());
        for batch in 0..self.elements.len() {
            for lane in 0..BATCH {
                // Lanes that fill the last batch are copies of the last element.
                let element = (batch * BATCH + lane).min(self.count - 1);
                self.corners(batch, lane, positions, &mut corners);
                self.kernel.geometry(&corners, &mut geometry);
                self.elements[batch].stored.0[lane] = 0.0;
                for p in 0..points {
                    let point = batch * points + p;
                    let (stress, history) = given.values[(element * points + p) * given.width..][..given.width].split_at(components);
                    let write = |to: &mut [Batch], from: &[f64]| to.iter_mut().zip(from).for_each(|(to, from)| to.0[lane] = *from);
                    write(&mut self.stress[point * components..][..components], stress);
                    write(&mut self.history[point * state..][..state], history);
                    let all = std::array::from_fn(|c| stress.get(c).copied().unwrap_or(0.0));
                    self.elements[batch].stored.0[lane] += self.law.energy(all) * geometry.volumes[p];
                }
            }
            for point in batch * points..(batch + 1) * points {
                self.law.renew(&mut self.history[point * state..][..state]);
            }
        }
        self.leave(before);
    }

    /// See [`super::Block::scale_density`].
    pub(super) fn scale_densities(&mut self, element: usize, factor: f64) {
        self.scale_corner_masses(element, factor);
        if self.resists() {
            self.lanes_of(element).for_each(|(batch, lane)| self.resistance[batch].mass.0[lane] *= factor);
        }
    }
}
