//! First part of the element kernel: gather the motion, find what the law wants to know of it. One text for
//! every element, stress state, dimension and instruction set.
//!
//! Rate laws: the displacement increment's gradient is taken in the mid-step configuration (zero strain for a
//! rigid rotation) and turned to the end of the step by half the step's rotation (second order); the old
//! stress is turned by all of it. Hyperelastic laws: F from the stored inverse of the initial Jacobian. With
//! mean dilatation (B-bar) the volumetric part of the strain is averaged over the element.

use super::batch::Resistance;
use super::kernel::FixedState;
use super::strip::{Parts, StripBuffers, prefetch_next};
use crate::element::{Element, PATTERNS, map, map_at};
use crate::material::Family;
use crate::stress_state::StressState;
use crate::tensor::{Dim, Matrix, Space, SymmetricTensor, Turn, Turns, product};
use embate_lanes::{Batch, Indices, Lane};
use std::marker::PhantomData;

pub(super) type Tensor<const D: usize, L> = <Dim<D> as Space<D>>::Tensor<L>;
type Rotation<const D: usize, L> = <Tensor<D, L> as SymmetricTensor<L>>::Rotation;

/// What a law wants to know.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures {
    pub(super) family: Family,
    pub(super) rotation: bool,
    pub(super) volume: bool,
}

/// Batches of initial geometry per point of a hyperelastic block: inverse Jacobian row by row, volume, and
/// the radius of an axisymmetric body, and the portion of a composite element ([`Element::portions`]); of an
/// element that is warped the second matrix.
pub(super) const fn initial_width<E: Element<D, N, P>, const D: usize, const N: usize, const P: usize>(state: StressState) -> usize
where
    Dim<D>: Space<D>,
{
    let is_axisymmetric = state.of::<D>().is_axisymmetric;
    D * D + 1 + is_axisymmetric as usize + (is_axisymmetric && E::COMPOSITE) as usize + if E::WARPED { D * D } else { 0 }
}

/// Deformation gradient of a point from the Jacobian (and the second matrix of an element that is warped) and
/// the inverse of the start.
#[inline(always)]
pub(super) fn deformation<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    jacobian: &Matrix<L, D>,
    x: &[[L; D]; N],
    initial: &[Batch],
    at: usize,
) -> Matrix<L, D>
where
    Dim<D>: Space<D>,
{
    let mut f = product(jacobian, &matrix(initial, at));
    if E::WARPED {
        let more = product(&E::warp(x), &matrix(&initial[D * D + 1..], at));
        for i in 0..D {
            for j in 0..D {
                f[i][j] += more[i][j];
            }
        }
    }
    f
}

/// What the motion of the nodes adds to a volume with these slopes.
#[inline(always)]
pub(super) fn flow<L: Lane, const D: usize, const N: usize>(slope: &[[L; D]; N], motion: &[[L; D]; N]) -> L {
    let mut sum = L::splat(-0.0);
    for a in 0..N {
        for i in 0..D {
            sum += slope[a][i] * motion[a][i];
        }
    }
    sum
}

/// A matrix from batches, row by row.
#[inline(always)]
pub(super) fn matrix<L: Lane, const D: usize>(from: &[Batch], at: usize) -> Matrix<L, D> {
    let mut out = [[L::splat(0.0); D]; D];
    for i in 0..D {
        for j in 0..D {
            out[i][j] = L::load(&from[i * D + j], at);
        }
    }
    out
}

/// Determinants of an element from its Jacobians.
#[inline(always)]
pub(super) fn determinants<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    x: &[[L; D]; N],
    jacobians: &[Matrix<L, D>; P],
) -> [L; P]
where
    Dim<D>: Space<D>,
{
    map::<E, L, D, N, P>(*jacobians, &E::warp(x)).determinants
}

/// Radius x of a point from the nodes.
#[inline(always)]
pub(super) fn radius<L: Lane, const D: usize, const N: usize>(x: &[[L; D]; N], shape: &[f64; N]) -> L {
    let mut sum = x[0][0] * L::splat(shape[0]);
    for a in 1..N {
        sum += x[a][0] * L::splat(shape[a]);
    }
    sum
}

/// Volume of an axisymmetric body per area of its section: the circumference.
#[inline(always)]
pub(super) fn circumference<L: Lane, const D: usize, const N: usize>(x: &[[L; D]; N], shape: &[f64; N]) -> L {
    radius(x, shape) * L::splat(std::f64::consts::TAU)
}

/// Volume of a point, m² (m³), from its area; in 3D the same.
#[inline(always)]
pub(super) fn point_volume<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    state: StressState,
    area: L,
    x: &[[L; D]; N],
    p: usize,
) -> L
where
    Dim<D>: Space<D>,
{
    if state.of::<D>().is_axisymmetric { area * circumference(x, &E::shares(p)) } else { area }
}

/// Whether dilatations are averaged over the element.
pub(super) const fn averages<E: Element<D, N, P>, const D: usize, const N: usize, const P: usize>(state: StressState) -> bool
where
    Dim<D>: Space<D>,
{
    E::MEAN_DILATATION && !state.of::<D>().is_plane_stress
}

/// Whether the volume is that of the whole element ([`Element::enclosed`]).
pub(super) const fn encloses<E: Element<D, N, P>, const D: usize, const N: usize, const P: usize>(state: StressState) -> bool
where
    Dim<D>: Space<D>,
{
    E::COMPOSITE && !state.of::<D>().is_plane_stress
}

/// Gradients of a nodal vector, of an axisymmetric body with these portions.
#[inline(always)]
pub(super) fn gradients<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    state: StressState,
    natural: &[[L; D]; N],
    portions: &[L; P],
) -> [Matrix<L, D>; P]
where
    Dim<D>: Space<D>,
{
    if E::COMPOSITE && state.of::<D>().is_axisymmetric { E::gradients_around(natural, portions) } else { E::gradients(natural) }
}

/// Portions of the points of a hyperelastic block, which are those of the start: so that forces are the slope
/// of the energy.
#[inline(always)]
pub(super) fn initial_portions<E: Element<D, N, P>, L: Lane, const D: usize, const N: usize, const P: usize>(
    state: StressState,
    initial: &[Batch],
    batch: usize,
    at: usize,
) -> [L; P]
where
    Dim<D>: Space<D>,
{
    let mut portions = [L::splat(0.0); P];
    if E::COMPOSITE && state.of::<D>().is_axisymmetric {
        let width = initial_width::<E, D, N, P>(state);
        for p in 0..P {
            portions[p] = L::load(&initial[(batch * P + p) * width + D * D + 2], at);
        }
    }
    portions
}

/// Elements `first..first + batches` (in batches) of a block, ready to be strained.
pub(super) struct Strain<'a, const D: usize> {
    /// Step, s.
    pub(super) time_step: f64,
    pub(super) measures: Measures,
    pub(super) first: usize,
    /// `N` rows of places among the nodes of the chunk per batch.
    pub(super) places: &'a Indices,
    pub(super) batches: usize,
    /// What bulk viscosity remembers; empty without it.
    pub(super) resistance: &'a [Resistance],
    /// Initial volume of each element.
    pub(super) volume_initial: &'a [Batch],
    /// Hyperelastic laws: [`initial_width`] per point.
    pub(super) initial: &'a [Batch],
    /// Rate laws: stresses of the points, turned in place.
    pub(super) stress: &'a mut [Batch],
    /// What hourglass control keeps, turned in place: [`Element::HOURGLASS`] per element.
    pub(super) hourglass: &'a mut [Batch],
    /// What the ways of the nodes around their mean count with, 1/m; empty: nothing.
    pub(super) weights: &'a [Batch],
    pub(super) strip: &'a mut StripBuffers<D>,
    /// Whether the next strip follows in memory and should be fetched.
    pub(super) prefetches: bool,
}

/// [`Strain`] by an element.
pub(super) struct StrainKernel<'a, E, S, const D: usize, const N: usize, const P: usize> {
    pub(super) input: Strain<'a, D>,
    pub(super) kind: PhantomData<(E, S)>,
}

impl<E: Element<D, N, P>, S: FixedState, const D: usize, const N: usize, const P: usize> Parts for StrainKernel<'_, E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    #[inline(always)]
    fn batches(&self) -> usize {
        self.input.batches
    }

    #[inline(always)]
    fn part<L: Lane>(&mut self, batch: usize, at: usize) {
        if at == 0 && self.input.prefetches {
            prefetch_next(self.input.stress, batch, P * <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS);
            prefetch_next(self.input.hourglass, batch, E::HOURGLASS);
            if matches!(self.input.measures.family, Family::Hyperelastic) {
                prefetch_next(self.input.initial, batch, P * initial_width::<E, D, N, P>(S::STATE));
            }
        }
        let row = (self.input.first + batch) * N;
        let (mut x, mut v) = ([[L::splat(0.0); D]; N], [[L::splat(0.0); D]; N]);
        if D == 2 {
            // Position and velocity of a node in 2D are one load.
            for a in 0..N {
                [x[a], v[a]] = L::gather(&self.input.strip.moving, self.input.places, row + a, at);
            }
            self.weigh(batch, at, &v);
            (x, v) = (E::natural(&x), E::natural(&v));
        } else {
            x = E::natural(&L::gather_one::<D, N, false>(&self.input.strip.moving, self.input.places, row, at));
            v = L::gather_one::<D, N, true>(&self.input.strip.moving, self.input.places, row, at);
            self.weigh(batch, at, &v);
            v = E::natural(&v);
        }
        // One check of the bounds for all parts.
        let parts = &mut self.input.strip.parts[batch * (E::PARTS * D)..][..E::PARTS * D];
        for a in 0..E::PARTS {
            for i in 0..D {
                x[a][i].store(&mut parts[a * D + i], at);
            }
        }
        match self.input.measures.family {
            Family::Rate => self.rate(batch, at, &x, &v),
            Family::Hyperelastic => self.hyperelastic(batch, at, &x, &v),
        }
    }
}

impl<E: Element<D, N, P>, S: FixedState, const D: usize, const N: usize, const P: usize> StrainKernel<'_, E, S, D, N, P>
where
    Dim<D>: Space<D>,
{
    /// Notes the weighted way of the nodes around their mean; of an axisymmetric body all that is radial.
    #[inline(always)]
    fn weigh<L: Lane>(&mut self, batch: usize, at: usize, v: &[[L; D]; N]) {
        let Some(weight) = self.input.weights.get(batch) else { return };
        let mut squares = L::splat(-0.0);
        for i in 0..D {
            let mut mean = L::splat(-0.0);
            for a in 0..N {
                mean += v[a][i];
            }
            mean = if S::STATE.is_axisymmetric && i == 0 { L::splat(0.0) } else { mean * L::splat(1.0 / N as f64) };
            for a in 0..N {
                let own = v[a][i] - mean;
                squares += own * own;
            }
        }
        let way = squares.sqrt() * L::splat(self.input.time_step) * L::load(weight, at);
        let largest = &mut self.input.strip.motion;
        way.max(L::load(largest, at)).store(largest, at);
    }

    /// Strain increment and rotation from the mid-step configuration; turns the stresses.
    #[inline(always)]
    fn rate<L: Lane>(&mut self, batch: usize, at: usize, x: &[[L; D]; N], v: &[[L; D]; N]) {
        let (zero, half, third) = (L::splat(0.0), L::splat(0.5), L::splat(1.0 / 3.0));
        let dt = L::splat(self.input.time_step);
        let mut step = [[zero; D]; N];
        let mut x_middle = *x;
        for a in 0..E::PARTS {
            for i in 0..D {
                step[a][i] = v[a][i] * dt;
                x_middle[a][i] = x[a][i] - step[a][i] * half;
            }
        }
        let portions = E::portions(&x_middle);
        let increments = gradients::<E, _, D, N, P>(S::STATE, &step, &portions);
        let warp_step = E::warp(&step);
        let warp = E::warp(&x_middle);
        let jacobians = gradients::<E, _, D, N, P>(S::STATE, if E::PARTS < N { &x_middle } else { x }, &portions);
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let turn = <Rotation<D, L> as Turn<L>>::COMPONENTS;
        // Sums begin with -0: the first addition is none.
        let (mut dilatation, mut volume) = (L::splat(-0.0), L::splat(-0.0));
        let mut traces = [zero; P];
        for p in 0..P {
            let mut middle = jacobians[p];
            if E::PARTS == N {
                // Positions at mid-step are x − ½ step, so the same holds for their gradients.
                for i in 0..D {
                    for k in 0..D {
                        middle[i][k] = middle[i][k] - increments[p][i][k] * half;
                    }
                }
            }
            let ([adjugate, warped], determinant) = map_at::<E, L, D, N, P>(&middle, &warp);
            let own = point_volume::<E, _, D, N, P>(S::STATE, determinant * L::splat(E::WEIGHTS[p]), &x_middle, p);
            own.store(&mut self.input.strip.volume[batch * P + p], at);
            let mut natural = product(&increments[p], &adjugate);
            if E::WARPED {
                let more = product(&warp_step, &warped);
                for i in 0..D {
                    for k in 0..D {
                        natural[i][k] += more[i][k];
                    }
                }
            }
            let (gradient, turns) = Dim::<D>::increment(&natural, determinant);
            if E::HOURGLASS_MODES > 0 {
                self.hourglass_rates(batch, at, &E::hourglass_rates(x, &step, &gradient), &turns);
            }
            let mut strain = Dim::<D>::symmetric(&gradient);
            if S::STATE.is_axisymmetric {
                let shape = E::shares(p);
                strain = strain.plus_zz(radius(&step, &shape) / radius(&x_middle, &shape));
            }
            if averages::<E, D, N, P>(S::STATE) {
                traces[p] = strain.trace();
                dilatation += traces[p] * own;
                volume += own;
            }
            let (point, [half_way, rotation]) = (batch * P + p, turns);
            // Strain increment and old stress meet at the end of the step; without its half rotation the
            // update is of first order only.
            strain.rotated(&half_way).store(&mut self.input.strip.strain[point * components..(point + 1) * components], at);
            let stress = &mut self.input.stress[point * components..(point + 1) * components];
            Tensor::<D, L>::load(stress, at).rotated(&rotation).store(stress, at);
            if self.input.measures.rotation {
                rotation.store(&mut self.input.strip.rotation[point * turn..(point + 1) * turn], at);
            }
        }
        if encloses::<E, D, N, P>(S::STATE) {
            let (enclosed, slope) = E::enclosed(&x_middle, S::STATE);
            let scale = enclosed / volume;
            for p in 0..P {
                let own = &mut self.input.strip.volume[batch * P + p];
                (L::load(own, at) * scale).store(own, at);
            }
            (dilatation, volume) = (flow(&slope, &step), enclosed);
        }
        if averages::<E, D, N, P>(S::STATE) {
            dilatation = dilatation / volume;
            for p in 0..P {
                let strain = &mut self.input.strip.strain[(batch * P + p) * components..][..components];
                Tensor::<D, L>::load(strain, at).plus_isotropic((dilatation - traces[p]) * third).store(strain, at);
            }
        }
        if self.input.measures.volume {
            self.volume_ratio(batch, at, x);
        }
    }

    /// Notes the changes of the amplitudes of hourglass patterns in directions of the end of the step, and
    /// turns what is kept of them there. A vector in mid-step directions at the end: the mean of itself and
    /// of the turned one, which is shorter by the square of the step's angle.
    #[inline(always)]
    fn hourglass_rates<L: Lane>(&mut self, batch: usize, at: usize, changes: &[[L; D]; PATTERNS], turns: &Turns<Tensor<D, L>, L>) {
        let half = L::splat(0.5);
        for pattern in 0..E::HOURGLASS_MODES {
            let change = changes[pattern];
            let all = Dim::<D>::turned(change, turns);
            let place = batch * E::HOURGLASS + pattern * D;
            let kept = &mut self.input.hourglass[place..place + D];
            let mut old = change;
            for i in 0..D {
                ((change[i] + all[i]) * half).store(&mut self.input.strip.hourglass_rates[place + i], at);
                old[i] = L::load(&kept[i], at);
            }
            let turned = Dim::<D>::turned(old, turns);
            for i in 0..D {
                turned[i].store(&mut kept[i], at);
            }
        }
    }

    /// Volume of the element over its initial volume, and the heat of the bulk viscosity, for laws with an
    /// equation of state.
    #[inline(always)]
    fn volume_ratio<L: Lane>(&mut self, batch: usize, at: usize, x: &[[L; D]; N]) {
        let mut volume = L::splat(0.0);
        let determinants = determinants::<E, L, D, N, P>(x, &E::gradients(x));
        for p in 0..P {
            let own = determinants[p] * L::splat(E::WEIGHTS[p]);
            volume += point_volume::<E, _, D, N, P>(S::STATE, own, x, p);
        }
        if encloses::<E, D, N, P>(S::STATE) {
            volume = E::enclosed(x, S::STATE).0;
        }
        let initial = L::load(&self.input.volume_initial[batch], at);
        let ratio = volume / initial;
        let heat = match self.input.resistance.get(batch) {
            Some(resistance) => L::load(&resistance.viscous_step, at) / initial,
            None => L::splat(0.0),
        };
        for p in 0..P {
            ratio.store(&mut self.input.strip.volume_ratio[batch * P + p], at);
            heat.store(&mut self.input.strip.viscous_heat[batch * P + p], at);
        }
    }

    /// b and J from the deformation gradient, the volume ratio averaged over the element with mean
    /// dilatation.
    #[inline(always)]
    fn hyperelastic<L: Lane>(&mut self, batch: usize, at: usize, x: &[[L; D]; N], v: &[[L; D]; N]) {
        let portions = initial_portions::<E, _, D, N, P>(S::STATE, self.input.initial, batch, at);
        let jacobians = &gradients::<E, _, D, N, P>(S::STATE, x, &portions);
        let one = L::splat(1.0);
        let width = initial_width::<E, D, N, P>(S::STATE);
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let (mut volume, mut volume_initial) = (L::splat(-0.0), L::splat(-0.0));
        let determinants = determinants::<E, L, D, N, P>(x, jacobians);
        for p in 0..P {
            let own = determinants[p] * L::splat(E::WEIGHTS[p]);
            volume += point_volume::<E, _, D, N, P>(S::STATE, own, x, p);
            let own_initial = L::load(&self.input.initial[(batch * P + p) * width + D * D], at);
            own_initial.store(&mut self.input.strip.volume[batch * P + p], at);
            volume_initial += own_initial;
        }
        if encloses::<E, D, N, P>(S::STATE) {
            volume = E::enclosed(x, S::STATE).0;
        }
        let ratio_mean = volume / volume_initial;
        if E::HOURGLASS_MODES > 0 {
            let (dt, half) = (L::splat(self.input.time_step), L::splat(0.5));
            let mut step = *v;
            for a in 0..E::PARTS {
                for i in 0..D {
                    step[a][i] = v[a][i] * dt;
                }
            }
            let increment = E::gradients(&step)[0];
            let mut middle = jacobians[0];
            for i in 0..D {
                for k in 0..D {
                    middle[i][k] = middle[i][k] - increment[i][k] * half;
                }
            }
            let (gradient, turns) = Dim::<D>::displaced(&increment, &Dim::<D>::adjugate(&middle), Dim::<D>::determinant(&middle));
            self.hourglass_rates(batch, at, &E::hourglass_rates(x, &step, &gradient), &turns);
        }
        for p in 0..P {
            let point = batch * P + p;
            let initial = &self.input.initial[point * width..(point + 1) * width];
            let f = deformation::<E, L, D, N, P>(&jacobians[p], x, initial, at);
            let mut stretch = one; // across the plane
            if S::STATE.is_axisymmetric {
                stretch = radius(x, &E::shares(p)) / L::load(&initial[D * D + 1], at);
            }
            let ratio_point = Dim::<D>::determinant(&f);
            let ratio_point = if S::STATE.is_axisymmetric { ratio_point * stretch } else { ratio_point };
            let (mut ratio, mut scale, mut weight) = (ratio_point, one, L::splat(E::WEIGHTS[p]));
            if averages::<E, D, N, P>(S::STATE) {
                // F̄ = (J̄/J)^{1/3} F; the deviatoric Kirchhoff stress τ̄ V₀ then weighs J̄ V₀ = (J̄/J) w det
                // J.
                let change = ratio_mean / ratio_point;
                let root = embate_lanes::math::cbrt(change);
                weight = if E::COMPOSITE {
                    let own = point_volume::<E, _, D, N, P>(S::STATE, determinants[p], x, p);
                    L::load(&initial[D * D], at) * ratio_mean / own
                } else {
                    weight * change
                };
                (ratio, scale) = (ratio_mean, root * root);
            }
            let mut b = Dim::<D>::left_cauchy_green(&f, scale);
            if S::STATE.is_axisymmetric {
                b = b.plus_zz(scale * (stretch * stretch - one));
            }
            b.store(&mut self.input.strip.strain[point * components..(point + 1) * components], at);
            ratio.store(&mut self.input.strip.volume_ratio[point], at);
            weight.store(&mut self.input.strip.weight[point], at);
        }
    }
}
