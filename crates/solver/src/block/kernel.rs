//! The element kernel: gather, strain, stress, corner forces; one text for every element, law, dimension and instruction set.
//!
//! Rate laws: the displacement increment's gradient is taken in the mid-step configuration (zero strain for a rigid rotation) and turned
//! to the end of the step by half the step's rotation (second order), forces in the end-of-step configuration. Hyperelastic laws: F from the stored inverse of the initial Jacobian.
//! With mean dilatation (B-bar) the volumetric part of the strain and, consistently, of the force is averaged over the element:
//! f_a = Σ_p w_p (dev σ_p) adj(J_p) ∇_ξ N_a + p̄ Σ_p adj(J_p) ∇_ξ N_a, which is the exact transpose of the averaged strain.

use super::batch::ElementBatch;
use super::{Motion, Report};
use crate::element::Element;
use crate::material::{Family, Kinematics, Law, Response, State};
use crate::tensor::{Dim, Matrix, Space, SymmetricTensor, product, scaled};
use embate_lanes::{BATCH, Batch, Indices, Kernel, Lane};
use std::marker::PhantomData;

type Tensor<const D: usize, L> = <Dim<D> as Space<D>>::Tensor<L>;
type Rotation<const D: usize, L> = <Tensor<D, L> as SymmetricTensor<L>>::Rotation;

/// Batches `first..first + elements.len()` of a block, ready to advance.
pub(super) struct Advance<'a, M: Law, E: Element<D, N, P>, const D: usize, const N: usize, const P: usize>
where
    Dim<D>: Space<D>,
{
    pub(super) law: &'a M,
    pub(super) motion: Motion<'a, D>,
    pub(super) first: usize,
    /// `N` rows of node indices per batch.
    pub(super) nodes: &'a Indices,
    /// Per point: stress components, then the law's state.
    pub(super) points: &'a mut [Batch],
    /// Hyperelastic laws: per point the inverse initial Jacobian (row by row) and the initial volume.
    pub(super) initial: &'a [Batch],
    pub(super) elements: &'a mut [ElementBatch],
    pub(super) corners: &'a mut [Batch],
    pub(super) element: PhantomData<E>,
}

/// Batches stored per point.
pub(super) const fn point_width<const D: usize, M: Law>() -> usize
where
    Dim<D>: Space<D>,
{
    <Tensor<D, f64> as SymmetricTensor<f64>>::COMPONENTS + <M::State<f64> as State<f64>>::COUNT
}

/// Batches of initial geometry per point.
pub(super) const fn initial_width<const D: usize, M: Law>() -> usize {
    match M::FAMILY {
        Family::Hyperelastic => D * D + 1,
        Family::Rate => 0,
    }
}

/// Running minima and sums, one per lane position so that the result does not depend on the lane width.
#[derive(Default)]
struct Sums {
    stored: Batch,
    dissipated: Batch,
    time_step_squared: Batch,
    determinant: Batch,
}

impl<M: Law, E: Element<D, N, P>, const D: usize, const N: usize, const P: usize> Kernel for Advance<'_, M, E, D, N, P>
where
    Dim<D>: Space<D>,
{
    type Output = Report;

    #[inline(always)]
    fn run<L: Lane>(mut self) -> Report {
        let mut sums = Sums { time_step_squared: Batch::splat(f64::INFINITY), determinant: Batch::splat(f64::INFINITY), ..Sums::default() };
        for batch in 0..self.elements.len() {
            for at in (0..BATCH).step_by(L::WIDTH) {
                self.part::<L>(batch, at, &mut sums);
            }
        }
        Report {
            time_step_squared: least(&sums.time_step_squared),
            determinant: least(&sums.determinant),
            stored: sums.stored.0.iter().sum(),
            dissipated: sums.dissipated.0.iter().sum(),
        }
    }
}

/// Stresses of all points of one part of a batch, with what the forces and the ledger need of them.
struct Stresses<T, L, const P: usize> {
    stress: [T; P],
    /// Quadrature weight of the stress: its volume in the force integral is `weight` times det J.
    weight: [L; P],
    stored: L,
    dissipated: L,
    modulus: L,
}

impl<T: SymmetricTensor<L>, L: Lane, const P: usize> Stresses<T, L, P> {
    /// Takes the response of point `p`: its stored energy (J/m), and its dissipation over the current `volume`.
    #[inline(always)]
    fn add(&mut self, p: usize, response: &Response<L, T>, stored: L, volume: L) {
        self.stress[p] = response.stress;
        self.stored += stored;
        self.dissipated += response.dissipated * volume;
        self.modulus = self.modulus.max(response.bulk + response.shear * L::splat(4.0 / 3.0));
    }
}

impl<M: Law, E: Element<D, N, P>, const D: usize, const N: usize, const P: usize> Advance<'_, M, E, D, N, P>
where
    Dim<D>: Space<D>,
{
    /// Advances the elements of `batch` in lanes `at..at + WIDTH`.
    #[inline(always)]
    fn part<L: Lane>(&mut self, batch: usize, at: usize, sums: &mut Sums) {
        let row = (self.first + batch) * N;
        let zero = L::splat(0.0);
        let mut x = [[zero; D]; N];
        for a in 0..N {
            x[a] = L::gather(self.motion.positions, self.nodes, row + a, at);
        }
        let jacobians = E::gradients(&x);
        let mut determinants = [zero; P];
        let mut weights = [zero; P];
        let mut volume = zero;
        for p in 0..P {
            determinants[p] = Dim::<D>::determinant(&jacobians[p]);
            weights[p] = L::splat(E::WEIGHTS[p]);
            volume += determinants[p] * weights[p];
        }

        let stresses = match M::FAMILY {
            Family::Rate => self.rate(batch, row, at, &jacobians, &weights),
            Family::Hyperelastic => self.hyperelastic(batch, at, &jacobians, &determinants, volume, &weights),
        };
        self.forces(batch, at, &jacobians, &determinants, volume, &stresses);

        let element = &mut self.elements[batch];
        let (mass, live) = (L::load(&element.mass_least, at), L::load(&element.live, at));
        // dt² = h² ρ / (K + 4µ/3) with ρ = m / V, as if all corners were as heavy as the lightest
        let time_step_squared = E::thickness_squared(&x, &determinants, volume) * mass / (volume * stresses.modulus);
        time_step_squared.store(&mut element.time_step_squared, at);
        let stored = match M::FAMILY {
            Family::Rate => L::load(&element.stored, at) + (stresses.stored - stresses.dissipated),
            Family::Hyperelastic => stresses.stored,
        };
        let dissipated = L::load(&element.dissipated, at) + stresses.dissipated;
        stored.store(&mut element.stored, at);
        dissipated.store(&mut element.dissipated, at);

        (L::load(&sums.stored, at) + stored * live).store(&mut sums.stored, at);
        (L::load(&sums.dissipated, at) + dissipated * live).store(&mut sums.dissipated, at);
        time_step_squared.min(L::load(&sums.time_step_squared, at)).store(&mut sums.time_step_squared, at);
        let mut worst = L::load(&sums.determinant, at);
        for p in 0..P {
            worst = determinants[p].min(worst);
        }
        worst.store(&mut sums.determinant, at);
    }

    /// Stresses of a rate law: strain increment and rotation from the mid-step configuration.
    #[inline(always)]
    fn rate<L: Lane>(
        &mut self,
        batch: usize,
        row: usize,
        at: usize,
        jacobians: &[Matrix<L, D>; P],
        weights: &[L; P],
    ) -> Stresses<Tensor<D, L>, L, P> {
        let (zero, half, third) = (L::splat(0.0), L::splat(0.5), L::splat(1.0 / 3.0));
        let dt = L::splat(self.motion.time_step);
        let mut step = [[zero; D]; N];
        for a in 0..N {
            step[a] = L::gather(self.motion.velocities, self.nodes, row + a, at);
            for i in 0..D {
                step[a][i] = step[a][i] * dt;
            }
        }
        let increments = E::gradients(&step);
        // Positions at mid-step are x − ½ step, so the same holds for their gradients.
        let mut middle = *jacobians;
        for p in 0..P {
            for i in 0..D {
                for k in 0..D {
                    middle[p][i][k] = middle[p][i][k] - increments[p][i][k] * half;
                }
            }
        }
        let mut volumes = [zero; P];
        let mut gradients = increments;
        let (mut dilatation, mut volume) = (zero, zero);
        for p in 0..P {
            let determinant = Dim::<D>::determinant(&middle[p]);
            volumes[p] = determinant * weights[p];
            let inverse = scaled(Dim::<D>::adjugate(&middle[p]), L::splat(1.0) / determinant);
            gradients[p] = product(&increments[p], &inverse);
            if E::MEAN_DILATATION {
                dilatation += Dim::<D>::symmetric(&gradients[p]).trace() * volumes[p];
                volume += volumes[p];
            }
        }
        if E::MEAN_DILATATION {
            dilatation = dilatation / volume;
        }
        let width = point_width::<D, M>();
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let points = &mut self.points[batch * P * width..(batch + 1) * P * width];
        let mut stresses =
            Stresses { stress: [Tensor::<D, L>::isotropic(zero); P], weight: *weights, stored: zero, dissipated: zero, modulus: zero };
        for p in 0..P {
            let point = &mut points[p * width..(p + 1) * width];
            let [half_way, rotation] = Dim::<D>::rotations(&gradients[p]);
            let unturned = Dim::<D>::symmetric(&gradients[p]);
            // Strain increment and old stress meet at the end of the step; without its half rotation the update is of first order only.
            let mut strain = unturned.rotated(&half_way);
            if E::MEAN_DILATATION {
                strain = strain.plus(Tensor::<D, L>::isotropic((dilatation - unturned.trace()) * third));
            }
            let rotated = Tensor::<D, L>::load(point, at).rotated(&rotation);
            let kinematics =
                Kinematics { strain_increment: strain, rotation, stress_rotated: rotated, left_cauchy_green: strain, volume_ratio: zero };
            let response = respond::<M, L, D>(self.law, &kinematics, &mut point[components..], at);
            response.stress.store(point, at);
            // Work of the stress over the step by the trapezoidal rule, as the nodal works of the ledger.
            stresses.add(p, &response, rotated.plus(response.stress).contract(strain) * volumes[p], volumes[p]);
        }
        stresses.stored = stresses.stored * half;
        stresses
    }

    /// Stresses of a hyperelastic law from the deformation gradient, its volume ratio averaged over the element with mean dilatation.
    #[inline(always)]
    fn hyperelastic<L: Lane>(
        &mut self,
        batch: usize,
        at: usize,
        jacobians: &[Matrix<L, D>; P],
        determinants: &[L; P],
        volume: L,
        weights: &[L; P],
    ) -> Stresses<Tensor<D, L>, L, P> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let (width, initial_width) = (point_width::<D, M>(), initial_width::<D, M>());
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let initial = &self.initial[batch * P * initial_width..(batch + 1) * P * initial_width];
        let mut volumes_initial = [zero; P];
        let mut volume_initial = zero;
        for p in 0..P {
            volumes_initial[p] = L::load(&initial[p * initial_width + D * D], at);
            volume_initial += volumes_initial[p];
        }
        let ratio_mean = volume / volume_initial;
        let [_, rotation]: [Rotation<D, L>; 2] = Dim::<D>::rotations(&[[zero; D]; D]);
        let points = &mut self.points[batch * P * width..(batch + 1) * P * width];
        let mut stresses =
            Stresses { stress: [Tensor::<D, L>::isotropic(zero); P], weight: *weights, stored: zero, dissipated: zero, modulus: zero };
        for p in 0..P {
            let point = &mut points[p * width..(p + 1) * width];
            let mut inverse = [[zero; D]; D];
            for i in 0..D {
                for j in 0..D {
                    inverse[i][j] = L::load(&initial[p * initial_width + i * D + j], at);
                }
            }
            let f = product(&jacobians[p], &inverse);
            let ratio_point = Dim::<D>::determinant(&f);
            let (mut ratio, mut scale) = (ratio_point, one);
            if E::MEAN_DILATATION {
                // F̄ = (J̄/J)^{1/3} F; the deviatoric Kirchhoff stress τ̄ V₀ then weighs J̄ V₀ = (J̄/J) w det J.
                let change = ratio_mean / ratio_point;
                let root = embate_lanes::math::cbrt(change);
                stresses.weight[p] = weights[p] * change;
                (ratio, scale) = (ratio_mean, root * root);
            }
            let b = Dim::<D>::left_cauchy_green(&f, scale);
            let kinematics = Kinematics { strain_increment: b, rotation, stress_rotated: b, left_cauchy_green: b, volume_ratio: ratio };
            let response = respond::<M, L, D>(self.law, &kinematics, &mut point[components..], at);
            response.stress.store(point, at);
            stresses.add(p, &response, response.stored * volumes_initial[p], determinants[p] * weights[p]);
        }
        stresses
    }

    /// Corner forces from the stresses.
    #[inline(always)]
    fn forces<L: Lane>(
        &mut self,
        batch: usize,
        at: usize,
        jacobians: &[Matrix<L, D>; P],
        determinants: &[L; P],
        volume: L,
        stresses: &Stresses<Tensor<D, L>, L, P>,
    ) {
        let zero = L::splat(0.0);
        let mut mean = zero;
        if E::MEAN_DILATATION {
            for p in 0..P {
                mean += stresses.stress[p].trace() * L::splat(1.0 / 3.0) * (determinants[p] * stresses.weight[p]);
            }
            mean = mean / volume;
        }
        let mut flux = [[[zero; D]; D]; P];
        for p in 0..P {
            let mut weighted = stresses.stress[p].times(stresses.weight[p]);
            if E::MEAN_DILATATION {
                let own = stresses.stress[p].trace() * L::splat(1.0 / 3.0) * stresses.weight[p];
                weighted = weighted.plus(Tensor::<D, L>::isotropic(mean * L::splat(E::WEIGHTS[p]) - own));
            }
            flux[p] = Dim::<D>::flux(&weighted, &Dim::<D>::adjugate(&jacobians[p]));
        }
        let nodal = E::divergence(&flux);
        let corners = &mut self.corners[batch * N * D..(batch + 1) * N * D];
        for a in 0..N {
            for i in 0..D {
                (-nodal[a][i]).store(&mut corners[a * D + i], at);
            }
        }
    }
}

/// Smallest of the eight values.
fn least(batch: &Batch) -> f64 {
    batch.0.iter().fold(f64::INFINITY, |least, &value| if value < least { value } else { least })
}

/// Loads the law's state of a point, asks the law, stores the state.
#[inline(always)]
fn respond<M: Law, L: Lane, const D: usize>(
    law: &M,
    kinematics: &Kinematics<L, Tensor<D, L>>,
    values: &mut [Batch],
    at: usize,
) -> Response<L, Tensor<D, L>>
where
    Dim<D>: Space<D>,
{
    let mut state = <M::State<L> as State<L>>::load(values, at);
    let response = law.update(kinematics, &mut state);
    state.store(values, at);
    response
}
