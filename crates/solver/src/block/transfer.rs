//! What elements that are made again in the run get from those before them: stresses and states of their
//! points, densities, and the energies of the block so far.
//!
//! Hyperelastic laws have no stress of their own: their points hand on the logarithmic strain h = ½ ln(F Fᵀ),
//! whose means are those of stretches and of the logarithm of the volume ratio. A new point continues with
//! F = ΔF exp(h), where ΔF is the deformation since its element was made: the rotation before is of no
//! interest to an isotropic law. The trace of h is corrected within each element, so that the element's mass
//! by the density at the start is its volume at the start.

use super::Report;
use super::kernel::{ElementGeometry, Facts};
use super::store::ElementStore;
use crate::material::Family;
use crate::tensor::{Dim, Space};
use embate_lanes::{BATCH, Batch, math};

/// Where the radius of a point is in the initial geometry of an axisymmetric element in 2D: behind the
/// inverse Jacobian and the volume.
const RADIUS: usize = 5;
/// Eigenvalues that differ by less than this part are equal.
const EQUAL: f64 = 1e-5;

/// ½ ln of a symmetric positive tensor in the plane, xx yy xy.
fn half_logarithm([xx, yy, xy]: [f64; 3]) -> [f64; 3] {
    let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let radius = (half * half + xy * xy).sqrt();
    let large = mean + radius;
    let small = (xx * yy - xy * xy) / large;
    let [large, small] = [large, small].map(|own| 0.5 * math::ln(own));
    // (ln λ₁ − ln λ₂) / (λ₁ − λ₂), of equal eigenvalues the slope of the logarithm.
    let slope = if radius > EQUAL * mean { 0.5 * (large - small) / radius } else { 0.5 / mean };
    let middle = 0.5 * (large + small);
    [middle + slope * half, middle - slope * half, slope * xy]
}

/// The exponential of a symmetric tensor in the plane, xx yy xy.
fn exponential([xx, yy, xy]: [f64; 3]) -> [f64; 3] {
    let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let radius = (half * half + xy * xy).sqrt();
    let [large, small] = [mean + radius, mean - radius].map(math::exp::<f64>);
    let slope = if radius > EQUAL { 0.5 * (large - small) / radius } else { math::exp(mean) };
    let middle = 0.5 * (large + small);
    [middle + slope * half, middle - slope * half, slope * xy]
}

/// Stresses and states of the points of a block, element by element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointValues {
    /// Points of an element.
    pub points: usize,
    /// Components of a stress: xx yy zz xy (yz zx), Pa.
    pub components: usize,
    /// Numbers of a point: its stress, then what its law remembers.
    pub width: usize,
    /// Whether there are logarithmic strains instead of stresses, of hyperelastic laws.
    pub is_strain: bool,
    /// Mass of each element, kg/m (axisymmetric: kg), where it is needed: with strains that are taken over.
    pub masses: Vec<f64>,
    /// `width` numbers for each point, point by point and element by element.
    pub values: Vec<f64>,
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// See [`super::Block::point_values`].
    pub(super) fn values_of_points(&self, positions: &[[f64; D]]) -> Option<PointValues> {
        let is_strain = self.law.family() == Family::Hyperelastic;
        if !self.law.can_be_averaged() || self.nodal.is_some() || (is_strain && D != 2) {
            return None;
        }
        let (Facts { points, components, .. }, state) = (*self.facts(), self.law.state_width());
        let mut values = Vec::with_capacity(self.count * points * (components + state));
        let (mut corners, mut geometry) = (Vec::new(), ElementGeometry::default());
        for element in 0..self.count {
            let (batch, lane) = (element / BATCH, element % BATCH);
            if is_strain {
                self.corners(batch, lane, positions, &mut corners);
                self.kernel.geometry(&corners, &mut geometry);
            }
            for p in 0..points {
                let point = batch * points + p;
                if is_strain {
                    values.extend(self.logarithmic_strain(point, lane, p, &geometry));
                } else {
                    values.extend(self.stress[point * components..][..components].iter().map(|batch| batch.0[lane]));
                }
                values.extend(self.history[point * state..][..state].iter().map(|batch| batch.0[lane]));
            }
        }
        Some(PointValues { points, components, width: components + state, is_strain, masses: Vec::new(), values })
    }

    /// ½ ln(F Fᵀ) of a point in 2D, xx yy zz xy, with the geometry of its element now.
    fn logarithmic_strain(&self, point: usize, lane: usize, p: usize, geometry: &ElementGeometry<D>) -> [f64; 4] {
        let width = self.facts().initial;
        let start = |k: usize| self.initial[point * width + k].0[lane];
        let now = &geometry.initial[p * width..][..width];
        // F = J J₀⁻¹; both are kept as inverses.
        let whole = now[0] * now[3] - now[1] * now[2];
        let jacobian = [[now[3] / whole, -now[1] / whole], [-now[2] / whole, now[0] / whole]];
        let f: [[f64; 2]; 2] = std::array::from_fn(|i| std::array::from_fn(|k| jacobian[i][0] * start(k) + jacobian[i][1] * start(2 + k)));
        let b = |i: usize, k: usize| f[i][0] * f[k][0] + f[i][1] * f[k][1];
        let [xx, yy, xy] = half_logarithm([b(0, 0), b(1, 1), b(0, 1)]);
        let zz = if self.facts().state.is_axisymmetric { math::ln(now[RADIUS] / start(RADIUS)) } else { 0.0 };
        [xx, yy, zz, xy]
    }

    /// Gives the points of an element of this mass (kg/m) in 2D these logarithmic strains, with their
    /// geometry now.
    fn begin_strained(&mut self, batch: usize, lane: usize, strains: &[[f64; 4]], mass: f64, geometry: &ElementGeometry<D>) {
        let Facts { initial: width, points, state, .. } = *self.facts();
        let at_start = |strain: &[f64; 4], volume: f64| volume / math::exp(strain[0] + strain[1] + strain[2]);
        let volume: f64 = strains.iter().zip(&geometry.volumes).map(|(strain, &volume)| at_start(strain, volume)).sum();
        let more = math::ln(volume * self.density / mass);
        // Nothing is stretched across the plane.
        let more = if state.is_axisymmetric { [more / 3.0; 3] } else { [0.5 * more, 0.5 * more, 0.0] };
        let mut whole = 0.0;
        for (p, strain) in strains.iter().enumerate() {
            let [xx, yy, zz] = [0, 1, 2].map(|d| strain[d] + more[d]);
            let [a, b, c] = exponential([xx, yy, strain[3]]);
            let now = &geometry.initial[p * width..][..width];
            let volume = at_start(&[xx, yy, zz, 0.0], geometry.volumes[p]);
            whole += volume;
            let own = &mut self.initial[(batch * points + p) * width..][..width];
            let inverse = [now[0] * a + now[1] * c, now[0] * c + now[1] * b, now[2] * a + now[3] * c, now[2] * c + now[3] * b];
            own.iter_mut().zip(inverse.into_iter().chain([volume])).for_each(|(to, from)| to.0[lane] = from);
            if state.is_axisymmetric {
                own[RADIUS].0[lane] = now[RADIUS] / math::exp(zz);
            }
        }
        self.volume_initial[batch].0[lane] = whole;
    }

    /// See [`super::Block::elastic_energy`].
    pub(super) fn energy_of_stresses(&self, positions: &[[f64; D]]) -> f64 {
        let Facts { points, components, .. } = *self.facts();
        if self.law.family() == Family::Hyperelastic {
            return (0..self.count).map(|element| self.elements[element / BATCH].stored.0[element % BATCH]).sum();
        }
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
        self.is_strained |= given.is_strain;
        for batch in 0..self.elements.len() {
            for lane in 0..BATCH {
                // Lanes that fill the last batch are copies of the last element.
                let element = (batch * BATCH + lane).min(self.count - 1);
                self.corners(batch, lane, positions, &mut corners);
                self.kernel.geometry(&corners, &mut geometry);
                if given.is_strain {
                    let of = |p: usize| std::array::from_fn(|c| given.values[(element * points + p) * given.width + c]);
                    self.begin_strained(batch, lane, &(0..points).map(of).collect::<Vec<_>>(), given.masses[element], &geometry);
                    continue;
                }
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
