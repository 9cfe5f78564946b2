//! Makes a block from an element kind, a law and a connectivity: the one place where element and law types meet and are erased.

use super::batch::{ElementBatch, element_of};
use super::kernel::{Advance, initial_width, point_width};
use super::{Block, ElementState, Motion, Report};
use crate::element::{Element, ElementVisitor, with_element};
use crate::material::{Family, Law, LawVisitor, Parameters, with_law};
use crate::model::Material;
use crate::tensor::{Dim, Space, SymmetricTensor};
use embate_lanes::{BATCH, Batch, Indices, Level};
use rayon::prelude::*;
use std::marker::PhantomData;

/// Batches that one task advances: small enough to share, large enough to be worth it; fixed, so that sums do not depend on threads.
const CHUNK: usize = 64;

/// What a block is made from.
#[derive(Clone, Copy, Debug)]
pub struct BlockInput<'a> {
    /// Name in the element registry.
    pub element: &'a str,
    /// Law and parameters.
    pub material: &'a Material,
    /// Node indices, `nodes` per element.
    pub connectivity: &'a [u32],
    /// Initial positions of all nodes, m.
    pub positions: &'a [[f64; 2]],
}

/// Makes the block; `None` when the element or the law is unknown.
#[must_use]
pub fn make(input: &BlockInput<'_>) -> Option<Box<dyn Block<2>>> {
    with_element(input.element, ChosenElement(input)).flatten()
}

struct ChosenElement<'a>(&'a BlockInput<'a>);

impl ElementVisitor for ChosenElement<'_> {
    type Output = Option<Box<dyn Block<2>>>;
    fn visit<E: Element<2, N, P>, const N: usize, const P: usize>(self) -> Self::Output {
        with_law(&self.0.material.law, ChosenLaw::<E, N, P>(self.0, PhantomData))
    }
}

struct ChosenLaw<'a, E, const N: usize, const P: usize>(&'a BlockInput<'a>, PhantomData<E>);

impl<E: Element<2, N, P>, const N: usize, const P: usize> LawVisitor for ChosenLaw<'_, E, N, P> {
    type Output = Box<dyn Block<2>>;
    fn visit<M: Law>(self) -> Self::Output {
        let parameters = Parameters::new(M::KIND.parameters, &self.0.material.parameters);
        Box::new(Elements::<M, E, 2, N, P>::new(M::new(&parameters), parameters.value("density"), self.0.connectivity, self.0.positions))
    }
}

/// What one task advances: points, elements, corners and the report of a chunk, as the iterators hand them over.
type ChunkOf<'a> = (((&'a mut [Batch], &'a mut [ElementBatch]), &'a mut [Batch]), &'a mut Report);

/// The elements of a block with their state.
struct Elements<M: Law, E, const D: usize, const N: usize, const P: usize> {
    law: M,
    count: usize,
    nodes: Indices,
    points: Vec<Batch>,
    initial: Vec<Batch>,
    elements: Vec<ElementBatch>,
    /// Share of each corner in the element's mass: `N` batches per batch of elements.
    corner_mass: Vec<Batch>,
    /// Initial volume of each element, one batch per batch of elements.
    volume_initial: Vec<Batch>,
    reports: Vec<Report>,
    element: PhantomData<E>,
}

impl<M: Law, E: Element<D, N, P>, const D: usize, const N: usize, const P: usize> Elements<M, E, D, N, P>
where
    Dim<D>: Space<D>,
{
    fn new(law: M, density: f64, connectivity: &[u32], positions: &[[f64; D]]) -> Self {
        let count = connectivity.len() / N;
        let batches = count.div_ceil(BATCH);
        let rows = (0..batches * N).map(|row| std::array::from_fn(|lane| connectivity[element_of(row / N, lane, count) * N + row % N]));
        let mut block = Self {
            law,
            count,
            nodes: Indices::new(rows.collect()),
            points: vec![Batch::default(); batches * P * point_width::<D, M>()],
            initial: vec![Batch::default(); batches * P * initial_width::<D, M>()],
            elements: vec![ElementBatch::default(); batches],
            corner_mass: vec![Batch::default(); batches * N],
            volume_initial: vec![Batch::default(); batches],
            reports: vec![Report::NOTHING; batches.div_ceil(CHUNK)],
            element: PhantomData,
        };
        for batch in 0..batches {
            for lane in 0..BATCH {
                block.set_up(batch, lane, density, connectivity, positions);
            }
        }
        block
    }

    /// Initial geometry and masses of one lane.
    fn set_up(&mut self, batch: usize, lane: usize, density: f64, connectivity: &[u32], positions: &[[f64; D]]) {
        let element = element_of(batch, lane, self.count);
        let x: [[f64; D]; N] = std::array::from_fn(|a| positions[connectivity[element * N + a] as usize]);
        let jacobians = E::gradients(&x);
        let width = initial_width::<D, M>();
        let mut volume = 0.0;
        for p in 0..P {
            let determinant = Dim::<D>::determinant(&jacobians[p]);
            let point_volume = determinant * E::WEIGHTS[p];
            volume += point_volume;
            let shape = E::shape(E::POINTS[p]);
            for a in 0..N {
                self.corner_mass[batch * N + a].0[lane] += density * point_volume * shape[a];
            }
            if M::FAMILY == Family::Hyperelastic {
                let adjugate = Dim::<D>::adjugate(&jacobians[p]);
                let initial = &mut self.initial[(batch * P + p) * width..][..width];
                for i in 0..D {
                    for j in 0..D {
                        initial[i * D + j].0[lane] = adjugate[i][j] / determinant;
                    }
                }
                initial[D * D].0[lane] = point_volume;
            }
        }
        let least = (0..N).map(|a| self.corner_mass[batch * N + a].0[lane]).fold(f64::INFINITY, f64::min);
        self.elements[batch].mass_least.0[lane] = N as f64 * least;
        self.elements[batch].live.0[lane] = if batch * BATCH + lane < self.count { 1.0 } else { 0.0 };
        self.volume_initial[batch].0[lane] = volume;
    }
}

impl<M: Law, E: Element<D, N, P>, const D: usize, const N: usize, const P: usize> Block<D> for Elements<M, E, D, N, P>
where
    Dim<D>: Space<D>,
{
    fn elements(&self) -> usize {
        self.count
    }

    fn corner_batches(&self) -> usize {
        self.elements.len() * N * D
    }

    fn advance(&mut self, motion: &Motion<'_, D>, level: Level, corners: &mut [Batch], parallel: bool) -> Report {
        let (width, initial_width) = (P * point_width::<D, M>(), P * initial_width::<D, M>());
        let (law, nodes, initial) = (&self.law, &self.nodes, &self.initial[..]);
        let chunk = |(index, (((points, elements), corners), report)): (usize, ChunkOf<'_>)| {
            let first = index * CHUNK;
            let initial = &initial[first * initial_width..(first + elements.len()) * initial_width];
            *report = level.run(Advance::<M, E, D, N, P> {
                law,
                motion: *motion,
                first,
                nodes,
                points,
                initial,
                elements,
                corners,
                element: PhantomData,
            });
        };
        if parallel {
            self.points
                .par_chunks_mut(CHUNK * width)
                .zip(self.elements.par_chunks_mut(CHUNK))
                .zip(corners.par_chunks_mut(CHUNK * N * D))
                .zip(self.reports.par_iter_mut())
                .enumerate()
                .for_each(chunk);
        } else {
            self.points
                .chunks_mut(CHUNK * width)
                .zip(self.elements.chunks_mut(CHUNK))
                .zip(corners.chunks_mut(CHUNK * N * D))
                .zip(self.reports.iter_mut())
                .enumerate()
                .for_each(chunk);
        }
        self.reports.iter().fold(Report::NOTHING, |sum, &report| sum.join(report))
    }

    fn mass(&self, element: usize) -> f64 {
        (0..N).map(|corner| self.corner_mass(element, corner)).sum()
    }

    fn corner_mass(&self, element: usize, corner: usize) -> f64 {
        self.corner_mass[element / BATCH * N + corner].0[element % BATCH]
    }

    fn time_step_squared(&self, element: usize) -> f64 {
        self.elements[element / BATCH].time_step_squared.0[element % BATCH]
    }

    fn state(&self, element: usize) -> ElementState {
        let (batch, lane) = (element / BATCH, element % BATCH);
        let width = point_width::<D, M>();
        let components = <<Dim<D> as Space<D>>::Tensor<f64> as SymmetricTensor<f64>>::COMPONENTS;
        let mean = |value: usize| (0..P).map(|p| self.points[(batch * P + p) * width + value].0[lane]).sum::<f64>() / P as f64;
        let mut state = ElementState::default();
        for c in 0..components {
            state.stress[c] = mean(c);
        }
        if let Some(index) = M::PLASTIC_STRAIN {
            state.plastic_strain = mean(components + index);
        }
        state.energy_density = self.elements[batch].stored.0[lane] / self.volume_initial[batch].0[lane];
        state
    }

    fn wave_modulus(&self) -> f64 {
        let [bulk, shear] = self.law.stiffness();
        bulk + 4.0 / 3.0 * shear
    }

    fn bulk_modulus(&self) -> f64 {
        self.law.stiffness()[0]
    }

    fn is_plastic(&self) -> bool {
        M::PLASTIC_STRAIN.is_some()
    }
}
