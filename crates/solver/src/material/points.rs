//! Laws as blocks see them: erased, many points at a time. The kernel of a law is compiled once for all
//! elements and stress states.

use super::{Family, History, Kinematics, Law, LawVisitor, Parameters, State, Variable, with_law};
use crate::model::Material;
use crate::tensor::{Dim, Plane, Space, SymmetricTensor, Turn};
use embate_lanes::{BATCH, Batch, Kernel, Lane, Level};
use std::marker::PhantomData;

/// Batches of a response per point: stored, dissipated, bulk, shear.
pub const RESPONSE: usize = 4;

/// Points of a strip, point after point, eight elements side by side.
#[derive(Debug)]
pub struct Points<'a> {
    /// Step that led here, s.
    pub time_step: f64,
    /// Rate: strain increment Δε; hyperelastic: b = F Fᵀ.
    pub strain: &'a [Batch],
    /// Rotation over the step; empty unless [`PointLaw::needs_rotation`].
    pub rotation: &'a [Batch],
    /// Volume ratio; set for hyperelastic laws and with [`PointLaw::needs_volume`].
    pub volume_ratio: &'a [Batch],
    /// Heat of the bulk viscosity, J/m³; set with [`PointLaw::needs_volume`].
    pub viscous_heat: &'a [Batch],
    /// Rate: the old stress turned to the end of the step, Pa. Becomes the new stress.
    pub stress: &'a mut [Batch],
    /// History, [`PointLaw::state_width`] per point.
    pub state: &'a mut [Batch],
    /// [`RESPONSE`] per point. Stored: of a hyperelastic law its energy per initial volume, of a rate law
    /// (σ_old + σ_new):Δε, twice the work of the step per volume, J/m³; dissipated in the step per current
    /// volume, J/m³; bulk and shear stiffness, Pa.
    pub response: &'a mut [Batch],
    /// Room that adapters may use.
    pub scratch: &'a mut Scratch,
}

/// Room of an adapter around a law, and of what it is around; it keeps its size from step to step.
#[derive(Debug, Default)]
pub struct Scratch {
    own: Vec<Batch>,
    inner: Option<Box<Scratch>>,
}

impl Scratch {
    /// `length` batches for the adapter, with whatever they held, and the room of what it is around.
    pub fn split(&mut self, length: usize) -> (&mut [Batch], &mut Scratch) {
        self.own.resize(length, Batch::default());
        (&mut self.own, self.inner.get_or_insert_default())
    }
}

/// A law with its parameters, for whichever kind of point it was made for.
pub trait PointLaw: Send + Sync {
    /// Which measures it works on.
    fn family(&self) -> Family;
    /// Batches of history per point.
    fn state_width(&self) -> usize;
    /// See [`Law::NEEDS_ROTATION`].
    fn needs_rotation(&self) -> bool;
    /// See [`Law::NEEDS_VOLUME`].
    fn needs_volume(&self) -> bool;
    /// History variables that are output, at most [`super::VARIABLES_MOST`].
    fn variables(&self) -> &[History];
    /// Place of a variable in the history of a point, if it is output.
    fn place(&self, variable: &Variable) -> Option<usize> {
        self.variables().iter().find(|own| own.variable == variable).map(|own| own.place)
    }
    /// Bulk and shear stiffness at rest, Pa.
    fn stiffness(&self) -> [f64; 2];
    /// Whether the bulk and shear stiffness that it reports are those of an isotropic elastic body, which it
    /// is never stiffer than; else they bound the speed of the waves alone.
    fn is_elastic(&self) -> bool {
        false
    }
    /// Whether it is never stiffer, whatever was before, than the isotropic elastic body of its stiffness at
    /// rest.
    fn is_stiffest_at_rest(&self) -> bool {
        false
    }
    /// Whether the stiffness that it reports is that of an isotropic body, and always that at rest.
    fn has_constant_stiffness(&self) -> bool {
        false
    }
    /// Least modulus of waves in plane stress, Pa, where it may be more than K and µ, taken as those of an
    /// isotropic body, say; of what bears no shear at rest infinite: it is that of waves in the bulk.
    fn least_sheet_modulus(&self) -> f64 {
        f64::INFINITY
    }
    /// Energy stored at the start per initial volume, J/m³: of an equation of state.
    fn stored(&self) -> f64 {
        0.0
    }
    /// See [`Law::energy`].
    fn energy(&self, stress: [f64; 6]) -> f64;
    /// Writes the history of a point at the start.
    fn start(&self, state: &mut [Batch]);
    /// See [`Law::CAN_BE_AVERAGED`].
    fn can_be_averaged(&self) -> bool {
        false
    }
    /// Renews in the history of a point, a mean of others, what follows from the rest of it.
    fn renew(&self, _state: &mut [Batch]) {}
    /// Place of the thickness ratio λ = t/t₀ (plane stress) or of the ratio of cross-sections (uniaxial
    /// stress) in the history.
    fn thickness(&self) -> Option<usize> {
        None
    }
    /// Places in the history of λ across a layer of a shell, or of λ² where it is also that out of the plane,
    /// and of λ out of the plane where that is another.
    fn ratios(&self) -> [Option<usize>; 2] {
        [self.thickness(), None]
    }
    /// Stresses at the end of the step; the result does not depend on `level`.
    fn respond(&self, level: Level, points: Points<'_>);
    /// Whether it has [`PointLaw::respond_layer`].
    fn has_layer(&self) -> bool {
        false
    }
    /// The same of layers without stress in the component `across` (yy or zz), whose strain it finds; the
    /// last of the state of a point is λ across, which follows.
    fn respond_layer(&self, _level: Level, _across: usize, _points: Points<'_>) {}
    /// Whether it has [`PointLaw::respond_fibre`].
    fn has_fibre(&self) -> bool {
        false
    }
    /// The same in 2D without stress yy and zz; the last of the state of a point is the ratio of
    /// cross-sections.
    fn respond_fibre(&self, _level: Level, _points: Points<'_>) {}
}

/// The law of a material for points in 2D or 3D, with its equation of state; `None` when one of
/// them is unknown.
#[must_use]
pub fn of<const D: usize>(material: &Material) -> Option<Box<dyn PointLaw>>
where
    Dim<D>: Space<D>,
{
    struct Make<'a, const D: usize>(&'a Material);
    impl<const D: usize> LawVisitor for Make<'_, D>
    where
        Dim<D>: Space<D>,
    {
        type Output = Box<dyn PointLaw>;
        fn visit<M: Law>(self) -> Self::Output {
            let law = M::new(&Parameters::new(M::KIND.parameters, &self.0.parameters, &self.0.lists));
            Box::new(DynLaw::<M, D> { law })
        }
    }
    super::eos::around::<D>(with_law(&material.law, Make::<D>(material))?, material)
}

/// The law of a material for points in 2D: [`of`] it.
#[must_use]
pub fn plane(material: &Material) -> Option<Box<dyn PointLaw>> {
    of::<2>(material)
}

/// The law of a material for points in plane stress.
#[must_use]
pub fn plane_stress(material: &Material) -> Option<Box<dyn PointLaw>> {
    plane(material).map(|law| Box::new(super::stress_constrained::StressConstrained::plane_stress(law)) as Box<dyn PointLaw>)
}

/// The law of a material for points under uniaxial stress along x: of bars, whose own axis x is.
#[must_use]
pub fn uniaxial(material: &Material) -> Option<Box<dyn PointLaw>> {
    plane(material).map(|law| Box::new(super::stress_constrained::StressConstrained::uniaxial(law)) as Box<dyn PointLaw>)
}

/// The law of a material for layers of shells in 2D: x along the layer, y across it, where there is no
/// stress; nor along z in `plane_stress`.
#[must_use]
pub fn layer(material: &Material, plane_stress: bool) -> Option<Box<dyn PointLaw>> {
    use super::stress_constrained::StressConstrained;
    let law = plane(material)?;
    let is_uniaxial = plane_stress && law.family() == Family::Rate && super::bears_uniaxial_stress(&material.law) == Some(true);
    Some(match (plane_stress, is_uniaxial) {
        // Both directions across have the same strain.
        (true, true) => Box::new(StressConstrained::uniaxial(law)),
        (true, false) => Box::new(StressConstrained::layer(Box::new(StressConstrained::plane_stress(law)))),
        (false, _) => Box::new(StressConstrained::layer(law)),
    })
}

/// The law of a material for layers of shells in 3D: z across the layer, where there is no stress.
#[must_use]
pub fn layer_in_3d(material: &Material) -> Option<Box<dyn PointLaw>> {
    Some(Box::new(super::stress_constrained::StressConstrained::layer_in_3d(of::<3>(material)?)))
}

struct DynLaw<M, const D: usize> {
    law: M,
}

type Tensor<const D: usize, L> = <Dim<D> as Space<D>>::Tensor<L>;
type Rotation<const D: usize, L> = <Tensor<D, L> as SymmetricTensor<L>>::Rotation;

impl<M: Law, const D: usize> PointLaw for DynLaw<M, D>
where
    Dim<D>: Space<D>,
{
    fn family(&self) -> Family {
        M::FAMILY
    }
    fn state_width(&self) -> usize {
        <M::State<f64, Tensor<D, f64>> as State<f64>>::COUNT
    }
    fn needs_rotation(&self) -> bool {
        M::NEEDS_ROTATION
    }
    fn needs_volume(&self) -> bool {
        M::NEEDS_VOLUME
    }
    fn variables(&self) -> &[History] {
        M::VARIABLES
    }
    fn stiffness(&self) -> [f64; 2] {
        self.law.stiffness()
    }
    fn is_elastic(&self) -> bool {
        M::FAMILY == Family::Rate && M::ISOTROPIC
    }
    fn is_stiffest_at_rest(&self) -> bool {
        self.is_elastic() && self.law.stiffness()[1] > 0.0
    }
    fn least_sheet_modulus(&self) -> f64 {
        if self.law.stiffness()[1] > 0.0 { self.law.sheet_modulus() } else { f64::INFINITY }
    }
    fn energy(&self, stress: [f64; 6]) -> f64 {
        self.law.energy(stress)
    }
    fn start(&self, state: &mut [Batch]) {
        for at in 0..BATCH {
            self.law.start::<f64, Tensor<D, f64>>().store(state, at);
        }
    }
    fn can_be_averaged(&self) -> bool {
        M::CAN_BE_AVERAGED
    }
    fn renew(&self, state: &mut [Batch]) {
        for at in 0..BATCH {
            let mut own = <M::State<f64, Tensor<D, f64>> as State<f64>>::load(state, at);
            self.law.renew::<f64, Tensor<D, f64>>(&mut own);
            own.store(state, at);
        }
    }
    fn respond(&self, level: Level, points: Points<'_>) {
        level.run(Respond::<M, D> { law: &self.law, points, dimension: PhantomData });
    }
    fn has_layer(&self) -> bool {
        self.law.has_layer()
    }
    fn respond_layer(&self, level: Level, across: usize, points: Points<'_>) {
        level.run(RespondLayer::<M, D> { law: &self.law, across, points, dimension: PhantomData });
    }
    fn has_fibre(&self) -> bool {
        self.law.has_fibre()
    }
    fn respond_fibre(&self, level: Level, points: Points<'_>) {
        level.run(RespondFibre { law: &self.law, points });
    }
}

/// The law at many points of layers.
struct RespondLayer<'a, M, const D: usize> {
    law: &'a M,
    across: usize,
    points: Points<'a>,
    dimension: PhantomData<Dim<D>>,
}

/// Components of a tensor as a layer with this one across has them.
#[inline(always)]
fn as_layer<L: Lane>([xx, yy, zz, xy, yz, zx]: [L; 6], across: usize) -> [L; 6] {
    if across == 1 { [xx, zz, yy, zx, yz, xy] } else { [xx, yy, zz, xy, yz, zx] }
}

impl<M: Law, const D: usize> Kernel for RespondLayer<'_, M, D>
where
    Dim<D>: Space<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Points { strain, stress, state, response, .. } = self.points;
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let inner = <M::State<L, Tensor<D, L>> as State<L>>::COUNT;
        // A copy, which no store can change: what follows from it is worked out once.
        let law = *self.law;
        let [bulk, shear] = law.stiffness();
        let [bulk, shear] = [L::splat(bulk), L::splat(shear)];
        let (half, one) = (L::splat(0.5), L::splat(1.0));
        for p in 0..strain.len() / components {
            let strain = &strain[p * components..(p + 1) * components];
            let stress = &mut stress[p * components..(p + 1) * components];
            let (state, thickness) = state[p * (inner + 1)..(p + 1) * (inner + 1)].split_at_mut(inner);
            let out = &mut response[p * RESPONSE..(p + 1) * RESPONSE];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let strain = as_layer(<Tensor<D, L> as SymmetricTensor<L>>::load(strain, at).components(), self.across);
                let old = as_layer(<Tensor<D, L> as SymmetricTensor<L>>::load(stress, at).components(), self.across);
                let mut history = <M::State<L, Tensor<D, L>> as State<L>>::load(state, at);
                let found = law.layer::<L, Tensor<D, L>>(strain, old, &mut history);
                history.store(state, at);
                let new = found.stress;
                let mut work = (old[0] + new[0]) * strain[0] + (old[1] + new[1]) * strain[1];
                for k in 3..6 {
                    let part = (old[k] + new[k]) * strain[k];
                    work += part + part;
                }
                <Tensor<D, L> as SymmetricTensor<L>>::from_components(as_layer(new, self.across)).store(stress, at);
                // Δε is the change of thickness over the mean thickness.
                let (before, change) = (L::load(&thickness[0], at), half * found.across);
                let after = before * (one + change) / (one - change);
                after.store(&mut thickness[0], at);
                let mean = half * (before + after);
                (work * mean).store(&mut out[0], at);
                (found.dissipated * mean).store(&mut out[1], at);
                bulk.store(&mut out[2], at);
                shear.store(&mut out[3], at);
            }
        }
    }
}

/// The law at many points in 2D under uniaxial stress.
struct RespondFibre<'a, M> {
    law: &'a M,
    points: Points<'a>,
}

impl<M: Law> Kernel for RespondFibre<'_, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        const XX: usize = 0;
        const XY: usize = 3;
        let Points { strain, stress, state, response, .. } = self.points;
        let inner = <M::State<L, Plane<L>> as State<L>>::COUNT;
        // A copy, which no store can change: what follows from it is worked out once.
        let law = *self.law;
        let [bulk, shear] = law.stiffness();
        let [bulk, shear] = [L::splat(bulk), L::splat(shear)];
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        for p in 0..strain.len() / PLANE {
            let strain = &strain[p * PLANE..(p + 1) * PLANE];
            let stress = &mut stress[p * PLANE..(p + 1) * PLANE];
            let (state, section) = state[p * (inner + 1)..(p + 1) * (inner + 1)].split_at_mut(inner);
            let out = &mut response[p * RESPONSE..(p + 1) * RESPONSE];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let strain = [L::load(&strain[XX], at), L::load(&strain[XY], at)];
                let old = [L::load(&stress[XX], at), L::load(&stress[XY], at)];
                let mut history = <M::State<L, Plane<L>> as State<L>>::load(state, at);
                let found = law.fibre::<L, Plane<L>>(strain, old, &mut history);
                history.store(state, at);
                let new = found.stress;
                let beside = (old[1] + new[1]) * strain[1];
                let work = (old[0] + new[0]) * strain[0] + (beside + beside);
                Plane([new[0], zero, zero, new[1]]).store(stress, at);
                let (before, change) = (L::load(&section[0], at), half * found.across);
                let factor = (one + change) / (one - change);
                let after = before * (factor * factor);
                after.store(&mut section[0], at);
                let mean = half * (before + after);
                (work * mean).store(&mut out[0], at);
                (found.dissipated * mean).store(&mut out[1], at);
                bulk.store(&mut out[2], at);
                shear.store(&mut out[3], at);
            }
        }
    }
}

/// The law at many points.
struct Respond<'a, M, const D: usize> {
    law: &'a M,
    points: Points<'a>,
    dimension: PhantomData<Dim<D>>,
}

impl<M: Law, const D: usize> Kernel for Respond<'_, M, D>
where
    Dim<D>: Space<D>,
{
    type Output = ();

    #[inline(always)]
    fn run<L: Lane>(self) {
        let Points { time_step, strain, rotation, volume_ratio, viscous_heat, stress, state, response, .. } = self.points;
        let components = <Tensor<D, L> as SymmetricTensor<L>>::COMPONENTS;
        let turn = <Rotation<D, L> as Turn<L>>::COMPONENTS;
        let width = <M::State<L, Tensor<D, L>> as State<L>>::COUNT;
        let zero = L::splat(0.0);
        let needs_ratio = M::NEEDS_VOLUME || matches!(M::FAMILY, Family::Hyperelastic);
        for p in 0..strain.len() / components {
            let strain = &strain[p * components..(p + 1) * components];
            let stress = &mut stress[p * components..(p + 1) * components];
            let state = &mut state[p * width..(p + 1) * width];
            let out = &mut response[p * RESPONSE..(p + 1) * RESPONSE];
            for at in (0..BATCH).step_by(L::WIDTH) {
                let strain = <Tensor<D, L> as SymmetricTensor<L>>::load(strain, at);
                let old = <Tensor<D, L> as SymmetricTensor<L>>::load(stress, at);
                let kinematics = Kinematics {
                    time_step: L::splat(time_step),
                    strain_increment: strain,
                    rotation: if M::NEEDS_ROTATION {
                        <Rotation<D, L> as Turn<L>>::load(&rotation[p * turn..(p + 1) * turn], at)
                    } else {
                        <Rotation<D, L> as Turn<L>>::none()
                    },
                    stress_rotated: old,
                    left_cauchy_green: strain,
                    volume_ratio: if needs_ratio { L::load(&volume_ratio[p], at) } else { zero },
                    viscous_heat: if M::NEEDS_VOLUME { L::load(&viscous_heat[p], at) } else { zero },
                };
                let mut history = <M::State<L, Tensor<D, L>> as State<L>>::load(state, at);
                let found = self.law.update(&kinematics, &mut history);
                history.store(state, at);
                found.stress.store(stress, at);
                let stored = match M::FAMILY {
                    Family::Rate => old.plus(found.stress).contract(strain),
                    Family::Hyperelastic => found.stored,
                };
                stored.store(&mut out[0], at);
                found.dissipated.store(&mut out[1], at);
                found.bulk.store(&mut out[2], at);
                found.shear.store(&mut out[3], at);
            }
        }
    }
}

/// Components of a tensor in 2D, and in 3D.
pub(in crate::material) const PLANE: usize = <Plane<f64> as SymmetricTensor<f64>>::COMPONENTS;
pub(in crate::material) const SOLID: usize = <crate::tensor::Solid<f64> as SymmetricTensor<f64>>::COMPONENTS;
