//! The elements of a block as those of an isotropic elastic body, for the stiffness of the assembled mesh.
//!
//! A law in rates has a tangent that is at most its elastic stiffness: flow only takes from it. So the same
//! elements, made again of an elastic body of the same moduli in their present form, without stress, are at
//! least as stiff, and their forces under a small displacement are the product of that stiffness with it: for
//! every element, without a kernel of its own. They keep what holds the shapes that their points do not feel,
//! their thickness, and their masses.

use super::batch::element_of;
use super::make::BlockInput;
use super::store::ElementStore;
use super::{Block, evaluate_at_rest};
use crate::material::young_and_poisson;
use crate::model::Material;
use crate::stress_state::sheet_modulus;
use crate::tensor::{Dim, Space};
use embate_lanes::{BATCH, Level};

/// Some elements of a block in a form.
#[derive(Clone, Copy, Debug)]
pub struct ElasticInput<'a, const D: usize> {
    /// The elements.
    pub elements: &'a [u32],
    /// Their nodes.
    pub connectivity: &'a [u32],
    /// Positions of all nodes, m.
    pub positions: &'a [[f64; D]],
    /// Linear coefficient of the bulk viscosity, where the block has one.
    pub viscosity: f64,
}

/// A block whose elements are never stiffer than those of an isotropic elastic body.
pub trait Elastic<const D: usize> {
    /// Some of its elements, made of that body, at rest in that form.
    fn made(&self, input: &ElasticInput<'_, D>, level: Level) -> Option<Box<dyn Block<D>>>;
    /// Linear and quadratic coefficient of its bulk viscosity; `None`: none.
    fn viscosity(&self) -> Option<[f64; 2]>;
    /// Whether there is other damping that lags behind the motion.
    fn damps(&self) -> bool;
    /// Largest square of the stiffness against a displacement gradient over that against waves, M: 3K or 2µ,
    /// in the plane 2 (M − µ); nine times that where dilatations are averaged over nodes.
    fn spread(&self) -> f64;
    /// Whether dilatations are averaged over nodes: what is left of them may be stiffer without some
    /// elements.
    fn averages_at_nodes(&self) -> bool;
    /// Largest singular value of the nodal gradients of every element, 1/m; zero of those that are gone.
    fn slopes(&self, positions: &[[f64; D]]) -> Vec<f64>;
    /// Hands over how far each element that is left is from a reference form with its [`Elastic::slopes`]:
    /// ‖F⁻¹ − 1‖, and the ratio of volumes.
    fn deformations(&self, slopes: &[f64], forms: [&[[f64; D]]; 2], see: &mut dyn FnMut(usize, [f64; 2]));
}

/// Batch and lane of elements of a block, and those that they have in a block made of them alone: lanes that
/// fill its last batch up too.
fn sources(elements: &[u32]) -> impl Iterator<Item = ([usize; 2], [usize; 2])> {
    let lanes = (0..elements.len().div_ceil(BATCH)).flat_map(|batch| (0..BATCH).map(move |lane| [batch, lane]));
    lanes.map(|[batch, lane]| {
        let source = elements[element_of(batch, lane, elements.len())] as usize;
        ([source / BATCH, source % BATCH], [batch, lane])
    })
}

impl<const D: usize> ElementStore<D>
where
    Dim<D>: Space<D>,
{
    /// Holds the shapes that its points do not feel as those elements of another block do.
    fn take_hourglass(&mut self, other: &Self, elements: &[u32]) {
        let width = self.facts().hourglass;
        for ([from, from_lane], [to, to_lane]) in sources(elements) {
            for k in 0..width {
                self.hourglass[to * width + k].0[to_lane] = other.hourglass[from * width + k].0[from_lane];
            }
        }
    }

    /// Takes over masses and thickness of those elements of another block.
    fn take_masses(&mut self, other: &Self, elements: &[u32]) {
        let (points, widths) = (self.facts().points, [self.law.state_width(), other.law.state_width()]);
        let thickness = self.law.thickness().zip(other.law.thickness());
        for ([from, from_lane], [to, to_lane]) in sources(elements) {
            self.elements[to].mass_least.0[to_lane] = other.elements[from].mass_least.0[from_lane];
            if self.resists() {
                self.resistance[to].mass.0[to_lane] = other.resistance[from].mass.0[from_lane];
            }
            for p in 0..points {
                let Some(places) = thickness else { break };
                let there = other.history[(from * points + p) * widths[1] + places.1].0[from_lane];
                self.history[(to * points + p) * widths[0] + places.0].0[to_lane] = there;
            }
        }
    }
}

impl<const D: usize> Elastic<D> for ElementStore<D>
where
    Dim<D>: Space<D>,
{
    fn made(&self, input: &ElasticInput<'_, D>, level: Level) -> Option<Box<dyn Block<D>>> {
        let [young, poisson] = young_and_poisson(self.law.stiffness());
        let parameters = [("density", self.density), ("young", young), ("poisson", poisson)];
        let material = Material {
            law: "elastic".into(),
            parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(),
            ..Material::default()
        };
        let ElasticInput { elements, connectivity, positions, viscosity } = *input;
        let input = BlockInput {
            damping: self.damping,
            viscosity: self.viscosity.map(|_| [viscosity, 0.0]),
            ..BlockInput::new("", &material, connectivity, positions)
        };
        let mut made = Self::new(self.source, self.kernel.copied(), &input)?;
        made.take_masses(self, elements);
        evaluate_at_rest(&mut made, positions, level);
        // The start has filled it with the present form.
        made.take_hourglass(self, elements);
        Some(Box::new(made))
    }

    fn viscosity(&self) -> Option<[f64; 2]> {
        self.viscosity
    }

    fn damps(&self) -> bool {
        self.damping > 0.0 || self.facts().damps
    }

    fn spread(&self) -> f64 {
        let [bulk, shear] = self.law.stiffness();
        let state = self.facts().state.of::<D>();
        let waves = if state.is_plane_stress { sheet_modulus(bulk, shear) } else { bulk + shear * (4.0 / 3.0) };
        let dilating = if D == 2 && !state.is_axisymmetric { 2.0 * (waves - shear) } else { 3.0 * bulk };
        // Weights of means over nodes change with all elements there.
        let averaged = if self.facts().averages_at_nodes { 9.0 } else { 1.0 };
        averaged * f64::max(dilating, 2.0 * shear) / waves
    }

    fn averages_at_nodes(&self) -> bool {
        self.facts().averages_at_nodes
    }

    fn slopes(&self, positions: &[[f64; D]]) -> Vec<f64> {
        let mut corners = Vec::new();
        let mut of = |element: usize| {
            self.corners(element / BATCH, element % BATCH, positions, &mut corners);
            self.kernel.slope(&corners)
        };
        (0..self.count).map(|element| if self.is_alive(element) { of(element) } else { 0.0 }).collect()
    }

    fn deformations(&self, slopes: &[f64], [reference, positions]: [&[[f64; D]]; 2], see: &mut dyn FnMut(usize, [f64; 2])) {
        let (mut before, mut now) = (Vec::new(), Vec::new());
        for (element, &slope) in slopes.iter().enumerate().filter(|(element, _)| self.is_alive(*element)) {
            self.corners(element / BATCH, element % BATCH, reference, &mut before);
            self.corners(element / BATCH, element % BATCH, positions, &mut now);
            see(element, self.kernel.deformation(slope, &before, &now));
        }
    }
}
