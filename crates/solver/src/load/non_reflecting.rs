//! Boundaries that reflect nothing: dashpots on a surface that take a plane wave up as if the body continued
//! (Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859-877).
//!
//! traction t = −ρ c_p (v·n) n − ρ c_s (v − (v·n) n),   c_p² = M/ρ,   c_s² = µ/ρ
//!
//! with M = K + 4µ/3, in plane stress E/(1 − ν²),
//!
//! on the tributary length (in 3D: area) of each node, normals and sizes as they are at the start. With C
//! the sum over a node's pieces of the surface, the force −C v̄ acts on the mean velocity of the update,
//! v̄ = ½ (v^{n−½} + v^{n+½}): it only takes energy, whatever the step, and shortens none. A node yields
//! to an impulse J by (m + ½ Δt C)⁻¹ J with Δt = ½ (dt^{n−1} + dt^n).

use crate::error::Fault;
use crate::mesh::Mesh;
use crate::mesh::geometry::CellGeometry;
use crate::mesh::surface::tributary::{self, Depth, Tributary};
use crate::mesh::surface::{Facet, Sided};
use crate::model::Model;
use crate::rotation::{Rotate, Square};
use crate::tensor::Dim;

/// The medium behind a piece of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Behind {
    /// Density, kg/m³.
    pub density: f64,
    /// Moduli ρc² of pressure and shear waves, Pa.
    pub moduli: [f64; 2],
}

/// The dashpots of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NonReflecting<const D: usize> {
    /// C of every node, kg/(m s), of solids kg/s; empty when the model has no such boundary.
    dashpots: Vec<Square<D>>,
}

impl<const D: usize> NonReflecting<D>
where
    Dim<D>: CellGeometry<D> + Rotate<D>,
{
    /// `behind` gives the medium behind a piece of a surface, `is_mirror` which pieces lie on a symmetry line
    /// or plane: they are no boundary.
    ///
    /// # Errors
    /// Names of nothing, or of what is no surface.
    pub fn new(
        model: &Model,
        mesh: &Mesh<D>,
        is_mirror: impl Fn(Facet<D>) -> bool,
        behind: impl Fn(Facet<D>) -> Option<Behind>,
    ) -> Result<Self, Vec<Fault>> {
        let (mut result, mut faults, depth) = (Self::default(), Vec::new(), Depth::of(model));
        for (i, boundary) in model.non_reflecting.iter().enumerate() {
            result.dashpots.resize(mesh.positions.len(), [[0.0; D]; D]);
            match mesh.surface(&boundary.on, &is_mirror) {
                Ok(surface) => result.add(surface.facets(), mesh, depth, &behind),
                Err(fault) => faults.push(Fault { path: format!("non_reflecting[{i}].on"), ..fault }),
            }
        }
        if faults.is_empty() { Ok(result) } else { Err(faults) }
    }

    fn add(&mut self, facets: &[Facet<D>], mesh: &Mesh<D>, depth: Depth, behind: &impl Fn(Facet<D>) -> Option<Behind>) {
        for &facet in facets {
            let Some(Behind { density, moduli: [wave, shear] }) = behind(facet) else { continue };
            let (along, across) = ((density * shear).max(0.0).sqrt(), (density * wave).sqrt());
            let matrix = Dim::<D>::resistance(facet, &mesh.positions, along, across);
            for (node, share) in tributary::shares(depth, facet, &mesh.positions) {
                let sum = &mut self.dashpots[node as usize];
                *sum = std::array::from_fn(|i| std::array::from_fn(|j| sum[i][j] + share * matrix[i][j]));
            }
        }
    }
}

impl<const D: usize> NonReflecting<D> {
    /// Whether the model has no such boundary.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.dashpots.is_empty()
    }

    /// C of a node, kg/(m s); `None` without.
    #[inline]
    #[must_use]
    pub fn of(&self, node: usize) -> Option<Square<D>> {
        self.dashpots.get(node).copied().filter(|matrix| *matrix != [[0.0; D]; D])
    }
}
