//! Last part of the element kernel: corner forces from the stresses, energies, the stable step. One text for
//! every element, stress state, dimension and instruction set.
//!
//! With mean dilatation (B-bar) the volumetric part of the force is averaged as that of the strain is:
//! f_a = Σ_p w_p (dev σ_p) adj(J_p) ∇_ξ N_a + p̄ Σ_p adj(J_p) ∇_ξ N_a, the exact transpose of the averaged
//! strain. In axisymmetric bodies every term carries 2πx_p, and the hoop stress adds Σ_p 2π w_p σ_zz det J_p
//! N_a to the radial force.
//!
//! Stable step: dt = h √(ρ/M) with the modulus M = K + 4µ/3 of waves in the bulk; in plane stress that of a
//! sheet, E/(1 − ν²) ([`sheet_modulus`], of rubber [`rubber_sheet_modulus`]).
//!
//! Bulk viscosity: a pressure q = ρ l (Q² l ε̇² + L c |ε̇|) where the volume shrinks (ε̇ < 0), with l² the
//! element's area, c² = M/ρ; the stable step shrinks by √(1 + ζ²) − ζ = 1 / (√(1 + ζ²) + ζ), ζ = (L + 2 Q² l
//! |ε̇| / c) l / h, the part of the critical damping that small motions of the fastest mode (ω = 2c/h) see:
//! dq/dε̇ = ρ l c (L + 2 Q² l |ε̇| / c). The linear part shortens the step of what grows, too: a step that is
//! cut when its fastest mode turns round changes the energy of that mode by ω² (dt² − dt_old²)/4 of what it
//! stores. For the same reason the rate at time zero is that of the velocities there. Source: von Neumann and
//! Richtmyer, J. Appl. Phys. 21 (1950) 232-237; Landshoff, LA-1930 (1955).

use super::Report;
use super::batch::{ElementBatch, Resistance};
use super::damping::step_squared;
use super::kernel::FixedState;
use super::strain::{Tensor, averages, circumference, deformation, encloses, flow, gradients, initial_portions, initial_width, matrix};
use super::strip::{Parts, StripBuffers, prefetch_next};
use crate::element::{Corners, Element, Held, Map, PATTERNS, Pulls, map};
use crate::material::Family;
use crate::material::points::RESPONSE;
use crate::reductions;
use crate::stress_state::{rubber_sheet_modulus, sheet_modulus};
use crate::tensor::{Dim, Space, SymmetricTensor, product, scaled};
use embate_lanes::{Batch, Indices, Lane, math};
use std::f64::consts::TAU;
use std::marker::PhantomData;

/// Elements of a strip after their law has answered. Their forces, N/m in 2D, are added to those on
/// the nodes of the chunk.
pub(super) struct Forces<'a, const D: usize> {
    pub(super) family: Family,
    /// Whether the law bears shear at rest.
    pub(super) is_solid: bool,
    /// Whether bulk and shear stiffness are those of an isotropic elastic body.
    pub(super) is_elastic: bool,
    /// See [`crate::material::points::PointLaw::least_sheet_modulus`].
    pub(super) least_sheet_modulus: f64,
    pub(super) time_step: f64,
    /// Coefficients L and Q of the bulk viscosity; none: no work is done for it.
    pub(super) viscosity: Option<[f64; 2]>,
    /// Time β of the damping in proportion to the stiffness, s; 0: none.
    pub(super) damping: f64,
    /// Its stresses, where they are not in those of the points; else empty.
    pub(super) damped: &'a [Batch],
    /// Stresses of the points.
    pub(super) stress: &'a [Batch],
    /// History of the points, batches per point in it, and the place of the thickness ratio.
    pub(super) history: &'a [Batch],
    pub(super) history_width: usize,
    pub(super) thickness: usize,
    /// Hyperelastic laws: initial geometry of the points.
    pub(super) initial: &'a [Batch],
    /// What the element keeps: [`Element::HOURGLASS`] per element.
    pub(super) hourglass: &'a mut [Batch],
    pub(super) strip: &'a mut StripBuffers<D>,
    pub(super) elements: &'a mut [ElementBatch],
    /// What bulk viscosity and damping remember; empty without them.
    pub(super) resistance: &'a mut [Resistance],
    /// `N` rows of places among the nodes of the chunk per batch, from `first` on.
    pub(super) places: &'a Indices,
    pub(super) first: usize,
    /// Forces of the elements, where they are kept; else empty.
    pub(super) kept: &'a mut [Batch],
    /// Squares of their stable steps when these were marked, s²; empty before.
    pub(super) marks: &'a [Batch],
    pub(super) sums: &'a mut Sums,
    /// Whether the next strip follows in memory and should be fetched.
    pub(super) prefetches: bool,
}

/// [`Forces`] by an element.
pub(super) struct ForcesKernel<'a, E, S, const D: usize, const N: usize, const P: usize> {
    pub(super) element: &'a E,
    pub(super) input: Forces<'a, D>,
    pub(super) state: PhantomData<S>,
}

/// Running minima and sums of a task, one per lane position so that the result does not depend on the lane
/// width.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums {
    stored: Batch,
    dissipated: Batch,
    hourglass: Batch,
    viscous: Batch,
    damping: Batch,
    time_step_squared: Batch,
    step_change: Batch,
    viscosity: Batch,
    determinant: Batch,
}

impl Sums {
    pub(super) fn new() -> Self {
        let (zero, infinite) = (Batch::default(), Batch::splat(f64::INFINITY));
        Self {
            stored: zero,
            dissipated: zero,
            hourglass: zero,
            viscous: zero,
            damping: zero,
            time_step_squared: infinite,
            step_change: infinite,
            viscosity: zero,
            determinant: infinite,
        }
    }

    pub(super) fn report<const D: usize>(&self, strip: &StripBuffers<D>) -> Report {
        let sum = |batch: &Batch| batch.0.iter().sum();
        Report {
            time_step_squared: least(&self.time_step_squared),
            step_change: least(&self.step_change),
            motion: reductions::max(strip.motion.0),
            viscosity: reductions::max(self.viscosity.0),
            determinant: least(&self.determinant),
            stored: sum(&self.stored),
            dissipated: sum(&self.dissipated),
            hourglass: sum(&self.hourglass),
            viscous: sum(&self.viscous),
            damping: sum(&self.damping),
        }
    }
}

/// Smallest of the eight values.
fn least(batch: &Batch) -> f64 {
    batch.0.iter().fold(f64::INFINITY, |least, &value| if value < least { value } else { least })
}

/// Geometry of the elements in a lane.
struct Geometry<L, const D: usize, const N: usize, const P: usize> {
    /// Positions in natural parts.
    x: [[L; D]; N],
    map: Map<L, D, P>,
    /// Volume per area of each point: circumference, thickness, or one.
    depth: [L; P],
    area: L,
    volume: L,
    /// Of an element that is composite: slope of its volume, and its volume over the sum of its points'.
    slope: [[L; D]; N],
    scale: L,
    /// See [`Element::portions`].
    portions: [L; P],
}

impl<E: Element<D, N, P>, S: FixedState, const D: usize, const N: usize, const P: usize> Parts for ForcesKernel<'_, E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    #[inline(always)]
    fn batches(&self) -> usize {
        self.input.elements.len()
    }

    #[inline(always)]
    fn part<L: Lane>(&mut self, batch: usize, at: usize) {
        if at == 0 && self.input.prefetches {
            prefetch_next(self.input.elements, batch, 1);
            prefetch_next(self.input.history, batch, P * self.input.history_width);
            prefetch_next(self.input.resistance, batch, usize::from(!self.input.resistance.is_empty()));
        }
        let zero = L::splat(0.0);
        let geometry = self.geometry::<L>(batch, at);
        // Sums begin with -0: the first addition is none.
        let (mut stored, mut dissipated, mut modulus, mut shear) = (L::splat(-0.0), L::splat(-0.0), zero, zero);
        let mut bulk_waves = zero;
        let mut shear_least = L::splat(f64::INFINITY);
        for p in 0..P {
            let point = batch * P + p;
            let response = &self.input.strip.response[point * RESPONSE..(point + 1) * RESPONSE];
            let volume = L::load(&self.input.strip.volume[point], at);
            stored += L::load(&response[0], at) * volume;
            let current = match self.input.family {
                Family::Rate => volume,
                Family::Hyperelastic => {
                    let own = geometry.map.determinants[p] * L::splat(E::WEIGHTS[p]);
                    if S::STATE.is_axisymmetric { own * geometry.depth[p] } else { own }
                }
            };
            dissipated += L::load(&response[1], at) * current;
            let (bulk, own) = (L::load(&response[2], at), L::load(&response[3], at));
            let mut waves = bulk + own * L::splat(4.0 / 3.0);
            if S::STATE.is_plane_stress {
                bulk_waves = bulk_waves.max(waves);
                let sheet = match self.input.family {
                    Family::Rate => sheet_modulus(bulk, own),
                    Family::Hyperelastic => rubber_sheet_modulus(bulk, own),
                };
                waves = sheet.max(L::splat(self.input.least_sheet_modulus)).min(waves);
            }
            modulus = modulus.max(waves);
            shear = shear.max(own);
            shear_least = shear_least.min(own);
        }
        if matches!(self.input.family, Family::Rate) {
            stored = stored * L::splat(0.5);
        }
        let live = L::load(&self.input.elements[batch].live, at);
        // In 2D all counts as if it were dilatation, but of elements that are composite.
        let size = if encloses::<E, D, N, P>(S::STATE) { geometry.volume } else { geometry.area };
        let thickness = E::thickness(&geometry.x, &geometry.map, size, &geometry.slope, S::STATE);
        let dilating_squared = thickness.squared();
        let characteristic_length_squared = if (D == 3 || E::COMPOSITE) && self.input.is_elastic {
            thickness.squared_with((shear_least + shear_least) / modulus)
        } else {
            dilating_squared
        };
        let mass = L::load(&self.input.elements[batch].mass_least, at);
        let (mut pressure, mut stiffening) = (zero, L::splat(1.0));
        if let Some(coefficients) = self.input.viscosity {
            (pressure, stiffening) =
                self.viscous(batch, at, coefficients, &geometry, modulus, [characteristic_length_squared, dilating_squared]);
        }
        let mut held = Held { forces: [[zero; D]; N], flux: [[zero; D]; D], pulls: Pulls::none(), work: zero, stiffening };
        if E::HOURGLASS > 0 {
            held = self.hourglass_forces(
                batch,
                at,
                &geometry,
                [modulus, bulk_waves, shear, mass],
                [characteristic_length_squared, dilating_squared],
            );
            stiffening = if D == 2 && !E::COMPOSITE { stiffening.max(held.stiffening) } else { stiffening * held.stiffening };
        }
        let mut nodal = self.nodal(batch, at, &geometry, pressure, &held);
        if E::HOURGLASS > 0 && !E::WARPED {
            for a in 0..N {
                for i in 0..D {
                    nodal[a][i] = nodal[a][i] - held.forces[a][i];
                }
            }
        }
        // dt² = h² ρ / M with ρ = m / V, as if all corners were as heavy as the lightest
        let time_step_squared =
            characteristic_length_squared[0] * mass / (characteristic_length_squared[1] * (geometry.volume * modulus) * stiffening);
        let time_step_squared = step_squared(time_step_squared, self.input.damping);
        // Nearly every batch is whole.
        let is_whole = !L::any(live.less(L::splat(1.0)));
        if !is_whole {
            for a in 0..N {
                for i in 0..D {
                    nodal[a][i] = nodal[a][i] * live;
                }
            }
        }
        if !self.input.kept.is_empty() {
            for a in 0..N {
                for i in 0..D {
                    nodal[a][i].store(&mut self.input.kept[(batch * N + a) * D + i], at);
                }
            }
        }
        L::scatter(&nodal, &mut self.input.strip.pulls, self.input.places, (self.input.first + batch) * N, at);
        let element = &mut self.input.elements[batch];
        time_step_squared.store(&mut element.time_step_squared, at);
        let stored = match self.input.family {
            Family::Rate => L::load(&element.stored, at) + (stored - dissipated),
            Family::Hyperelastic => stored,
        };
        let dissipated = L::load(&element.dissipated, at) + dissipated;
        stored.store(&mut element.stored, at);
        dissipated.store(&mut element.dissipated, at);

        let sums = &mut *self.input.sums;
        (L::load(&sums.stored, at) + stored * live).store(&mut sums.stored, at);
        (L::load(&sums.dissipated, at) + dissipated * live).store(&mut sums.dissipated, at);
        if E::HOURGLASS > 0 {
            (L::load(&sums.hourglass, at) + L::load(&element.hourglass, at) * live).store(&mut sums.hourglass, at);
        }
        if self.input.viscosity.is_some() {
            (L::load(&sums.viscous, at) + L::load(&self.input.resistance[batch].viscous, at) * live).store(&mut sums.viscous, at);
        }
        if self.input.damping > 0.0 {
            (L::load(&sums.damping, at) + L::load(&self.input.resistance[batch].damping, at) * live).store(&mut sums.damping, at);
        }
        time_step_squared.min(L::load(&sums.time_step_squared, at)).store(&mut sums.time_step_squared, at);
        if let Some(mark) = self.input.marks.get(batch) {
            let change = time_step_squared / L::load(mark, at);
            change.min(L::load(&sums.step_change, at)).store(&mut sums.step_change, at);
        }
        let mut worst = L::load(&sums.determinant, at);
        for p in 0..P {
            worst = geometry.map.determinants[p].min(worst);
        }
        worst.store(&mut sums.determinant, at);
    }
}

impl<E: Element<D, N, P>, S: FixedState, const D: usize, const N: usize, const P: usize> ForcesKernel<'_, E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    #[inline(always)]
    fn geometry<L: Lane>(&self, batch: usize, at: usize) -> Geometry<L, D, N, P> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut x = [[zero; D]; N];
        let parts = &self.input.strip.parts[batch * (E::PARTS * D)..][..E::PARTS * D];
        for a in 0..E::PARTS {
            for i in 0..D {
                x[a][i] = L::load(&parts[a * D + i], at);
            }
        }
        let nothing = L::splat(-0.0);
        let portions = match self.input.family {
            Family::Rate => E::portions(&x),
            Family::Hyperelastic => initial_portions::<E, _, D, N, P>(S::STATE, self.input.initial, batch, at),
        };
        let mut geometry = Geometry {
            x,
            map: self.map(batch, at, &x, &portions),
            depth: [one; P],
            area: nothing,
            volume: nothing,
            slope: [[zero; D]; N],
            scale: one,
            portions,
        };
        for p in 0..P {
            let own = geometry.map.determinants[p] * L::splat(E::WEIGHTS[p]);
            geometry.area += own;
            if S::STATE.is_plane_stress {
                geometry.depth[p] = L::load(&self.input.history[(batch * P + p) * self.input.history_width + self.input.thickness], at);
            } else if S::STATE.is_axisymmetric {
                geometry.depth[p] = circumference(&x, &E::shares(p));
            }
            geometry.volume += if S::STATE.is_plane_stress || S::STATE.is_axisymmetric { own * geometry.depth[p] } else { own };
        }
        if encloses::<E, D, N, P>(S::STATE) {
            let of_points = geometry.volume;
            (geometry.volume, geometry.slope) = E::enclosed(&x, S::STATE);
            geometry.scale = geometry.volume / of_points;
            if !S::STATE.is_axisymmetric {
                geometry.area = geometry.volume;
            }
        }
        geometry
    }

    /// The map of the elements. Where the gradient is a mean and the law hyperelastic, that which makes
    /// forces the slope of the energy: F of the mean is no ratio of present and initial maps, but adj(F)
    /// takes adjugates of the start to those of now.
    #[inline(always)]
    fn map<L: Lane>(&self, batch: usize, at: usize, x: &[[L; D]; N], portions: &[L; P]) -> Map<L, D, P> {
        let mut map = map::<E, L, D, N, P>(gradients::<E, _, D, N, P>(S::STATE, x, portions), &E::warp(x));
        if E::WARPED && matches!(self.input.family, Family::Hyperelastic) {
            let (width, jacobians) = (initial_width::<E, D, N, P>(S::STATE), E::gradients(x));
            for p in 0..P {
                let initial = &self.input.initial[(batch * P + p) * width..][..width];
                let f = deformation::<E, L, D, N, P>(&jacobians[p], x, initial, at);
                let (turn, size) = (Dim::<D>::adjugate(&f), L::load(&initial[D * D], at) * L::splat(1.0 / E::WEIGHTS[p]));
                map.determinants[p] = Dim::<D>::determinant(&f) * size;
                map.adjugates[p] = scaled(product(&matrix(initial, at), &turn), size);
                map.warped = scaled(product(&matrix(&initial[D * D + 1..], at), &turn), size);
            }
        }
        map
    }

    /// Stress of a point, and its weight in the forces.
    #[inline(always)]
    fn stress_and_weight<L: Lane>(&self, point: usize, p: usize, at: usize, geometry: &Geometry<L, D, N, P>) -> (Tensor<D, L>, L) {
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let mut stress = Tensor::<D, L>::load(&self.input.stress[point * components..(point + 1) * components], at);
        if !self.input.damped.is_empty() {
            stress = stress.plus(Tensor::<D, L>::load(&self.input.damped[point * components..(point + 1) * components], at));
        }
        let mut weight = match self.input.family {
            Family::Rate if encloses::<E, D, N, P>(S::STATE) => geometry.scale * L::splat(E::WEIGHTS[p]),
            Family::Rate => L::splat(E::WEIGHTS[p]),
            Family::Hyperelastic => L::load(&self.input.strip.weight[point], at),
        };
        if S::STATE.is_plane_stress || S::STATE.is_axisymmetric {
            weight = weight * geometry.depth[p];
        }
        (stress, weight)
    }

    /// Forces of the stresses, and of an additional `pressure`, on the nodes, which they pull back; of an
    /// element that is warped those of hourglass control too.
    #[inline(always)]
    fn nodal<L: Lane>(&self, batch: usize, at: usize, geometry: &Geometry<L, D, N, P>, pressure: L, held: &Held<L, D, N>) -> [[L; D]; N] {
        let (zero, third) = (L::splat(0.0), L::splat(1.0 / 3.0));
        let Geometry { map: Map { adjugates, warped, determinants }, depth, .. } = geometry;
        let mut mean = L::splat(-0.0);
        if averages::<E, D, N, P>(S::STATE) {
            for p in 0..P {
                let (stress, weight) = self.stress_and_weight(batch * P + p, p, at, geometry);
                mean += stress.trace() * third * (determinants[p] * weight);
            }
            mean = mean / geometry.volume;
        }
        let mut flux = [[[zero; D]; D]; P];
        let mut pulls = Pulls::none();
        let mut hoop = [zero; P];
        for p in 0..P {
            let (stress, weight) = self.stress_and_weight(batch * P + p, p, at, geometry);
            let mut weighted = stress.times(-weight);
            let share = L::splat(E::WEIGHTS[p]);
            // In plane stress nothing is averaged, and the pressure of the bulk viscosity has the thickness.
            let share = if S::STATE.is_axisymmetric { share * depth[p] } else { share };
            if averages::<E, D, N, P>(S::STATE) {
                let own = stress.trace() * third * weight;
                weighted = weighted.plus_isotropic(if E::COMPOSITE { own } else { own - mean * share });
            }
            if self.input.viscosity.is_some() && !encloses::<E, D, N, P>(S::STATE) {
                weighted = weighted.plus_isotropic(pressure * share);
            }
            flux[p] = Dim::<D>::flux(&weighted, &adjugates[p]);
            if E::WARPED {
                let warp = Dim::<D>::flux(&weighted, warped);
                for i in 0..D {
                    for k in 0..D {
                        flux[p][i][k] = flux[p][i][k] - held.flux[i][k];
                        pulls.warp[i][k] = warp[i][k] - held.pulls.warp[i][k];
                    }
                }
            }
            if S::STATE.is_axisymmetric {
                // The weight has 2πx already; the hoop strain is u/x.
                hoop[p] = weighted.zz() * determinants[p] * (L::splat(TAU) / depth[p]);
            }
        }
        for i in 0..D {
            pulls.rest[i] = -held.pulls.rest[i];
        }
        let mut nodal = if E::WARPED {
            E::divergence_warped(&flux, &pulls)
        } else if E::COMPOSITE && S::STATE.is_axisymmetric {
            E::divergence_around(&flux, &geometry.portions)
        } else {
            E::divergence(&flux)
        };
        if encloses::<E, D, N, P>(S::STATE) {
            let all = if self.input.viscosity.is_some() { pressure - mean } else { -mean };
            for a in 0..N {
                for i in 0..D {
                    nodal[a][i] += geometry.slope[a][i] * all;
                }
            }
        }
        if S::STATE.is_axisymmetric {
            for p in 0..P {
                let shape = E::shares(p);
                for a in 0..N {
                    nodal[a][0] += hoop[p] * L::splat(shape[a]);
                }
            }
        }
        nodal
    }

    /// Pressure of the bulk viscosity, and the square of the stable step without it over that with it; adds
    /// its work to the ledger.
    ///
    /// Of a sheet in plane stress the pressure acts in 2D alone, and what it takes is −p t dA: so it
    /// follows the rate of the area, not of the volume, and comes as p t with the mean thickness t.
    #[inline(always)]
    fn viscous<L: Lane>(
        &mut self,
        batch: usize,
        at: usize,
        [linear, quadratic]: [f64; 2],
        geometry: &Geometry<L, D, N, P>,
        modulus: L,
        [characteristic_length_squared, dilating_squared]: [[L; 2]; 2],
    ) -> (L, L) {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let is_plane_stress = S::STATE.is_plane_stress;
        let (old, live) = (L::load(&self.input.resistance[batch].volume, at), L::load(&self.input.elements[batch].live, at));
        let (size, depth) = if is_plane_stress { (geometry.area, geometry.volume / geometry.area) } else { (geometry.volume, one) };
        let half = L::splat(0.5);
        let (change, rate) = if self.input.time_step > 0.0 {
            (size - old, (size - old) / ((size + old) * half * L::splat(self.input.time_step)))
        } else {
            (zero, self.growth_at_start(batch, at, geometry) / size)
        };
        let (shrinks, rate) = (rate.less(zero), rate.abs());
        let element = &mut self.input.resistance[batch];
        let density = L::load(&element.mass, at) / geometry.volume;
        let length = if D == 2 { geometry.area.sqrt() } else { math::cbrt(geometry.volume) };
        let speed = (modulus / density).sqrt();
        let [linear, growing] = [L::splat(linear), L::splat(quadratic * quadratic) * length * rate / speed];
        let pressure = L::select(shrinks, density * length * speed * rate * (linear + growing), zero);
        let pressure = if is_plane_stress { pressure * depth } else { pressure };
        let coefficient = L::select(shrinks, linear + growing + growing, zero) * live;
        let largest = &mut self.input.sums.viscosity;
        coefficient.max(L::load(largest, at)).store(largest, at);
        let damping = (linear + L::select(shrinks, growing + growing, zero))
            * length
            * (characteristic_length_squared[1] / characteristic_length_squared[0]).sqrt();
        // ζ = (…) l h / h₀² with the thickness h₀ of what dilates alone: the damping is that of the
        // dilatation.
        let damping = if D == 2 && !E::COMPOSITE {
            damping
        } else {
            damping * (characteristic_length_squared[0] * dilating_squared[1] / (characteristic_length_squared[1] * dilating_squared[0]))
        };
        let stiffening = (one + damping * damping).sqrt() + damping;
        // Trapezoidal rule, as the nodal works of the ledger.
        let work = -(change * (pressure + L::load(&element.viscous_pressure, at)) * half) * live;
        pressure.store(&mut element.viscous_pressure, at);
        size.store(&mut element.volume, at);
        work.store(&mut element.viscous_step, at);
        (L::load(&element.viscous, at) + work).store(&mut element.viscous, at);
        (pressure, stiffening * stiffening)
    }

    /// Rate of the volume, in plane stress of the area, at time zero, from the velocities there, m²/s (m³/s).
    #[inline(always)]
    fn growth_at_start<L: Lane>(&self, batch: usize, at: usize, geometry: &Geometry<L, D, N, P>) -> L {
        let row = (self.input.first + batch) * N;
        let mut v = [[L::splat(0.0); D]; N];
        if D == 2 {
            for a in 0..N {
                [_, v[a]] = L::gather(&self.input.strip.moving, self.input.places, row + a, at);
            }
        } else {
            v = L::gather_one::<D, N, true>(&self.input.strip.moving, self.input.places, row, at);
        }
        if encloses::<E, D, N, P>(S::STATE) {
            return flow(&geometry.slope, &v);
        }
        let v = E::natural(&v);
        let (rates, warp) = (E::gradients(&v), E::warp(&v));
        let Map { adjugates, warped, determinants } = &geometry.map;
        let mut growth = L::splat(-0.0);
        for p in 0..P {
            let (flat, more) = (product(&rates[p], &adjugates[p]), product(&warp, warped));
            let mut own = L::splat(-0.0);
            for i in 0..D {
                own += if E::WARPED { flat[i][i] + more[i][i] } else { flat[i][i] };
            }
            if S::STATE.is_axisymmetric {
                own = own * geometry.depth[p] + determinants[p] * circumference(&v, &E::shares(p));
            }
            growth += own * L::splat(E::WEIGHTS[p]);
        }
        growth
    }

    /// Forces of hourglass control, whose work is entered.
    #[inline(always)]
    fn hourglass_forces<L: Lane>(
        &mut self,
        batch: usize,
        at: usize,
        geometry: &Geometry<L, D, N, P>,
        [modulus, bulk_waves, shear, mass]: [L; 4],
        [characteristic_length_squared, dilating_squared]: [[L; 2]; 2],
    ) -> Held<L, D, N> {
        let own = batch * E::HOURGLASS..(batch + 1) * E::HOURGLASS;
        let (changes, keep) = (&self.input.strip.hourglass_rates[own.clone()], &mut self.input.hourglass[own]);
        let mut hourglass_rates = [[L::splat(0.0); D]; PATTERNS];
        for pattern in 0..E::HOURGLASS_MODES {
            for i in 0..D {
                hourglass_rates[pattern][i] = L::load(&changes[pattern * D + i], at);
            }
        }
        // Nothing else holds the shape of a fluid; of a solid that can't change its volume, K would lock it.
        let shape_modulus = if self.input.is_solid { modulus.min(L::splat(4.0) * shear) } else { modulus };
        let corners = Corners {
            x: geometry.x,
            hourglass_rates,
            characteristic_length_squared,
            dilating_squared,
            area: geometry.area,
            volume: geometry.volume,
            slope: geometry.slope,
            modulus,
            shear,
            contraction: if S::STATE.is_plane_stress {
                (bulk_waves - shear - shear) / (L::splat(2.0) * (bulk_waves - shear))
            } else {
                (modulus - shear - shear) / modulus
            },
            shape_modulus,
            mass,
            rate: L::splat(if self.input.time_step > 0.0 { 1.0 / self.input.time_step } else { 0.0 }),
            is_start: self.input.time_step <= 0.0,
            state: S::STATE,
        };
        let held = self.element.hourglass_forces(&corners, &geometry.map, keep, at);
        let element = &mut self.input.elements[batch];
        let booked = if E::HOURGLASS_MODES > 0 { L::load(&element.hourglass, at) + held.work } else { held.work };
        booked.store(&mut element.hourglass, at);
        held
    }
}
