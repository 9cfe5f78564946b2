//! The only part of a block that is compiled for each element: [`ElementKernel`].
//!
//! The store ([`super::store`]) holds the state of the elements in plain batches and knows an element by
//! numbers alone ([`Facts`]). A kernel has no state: it turns the motion of the nodes into strains and
//! stresses into forces, strip by strip. Another way to do that (a shell, a device) is another
//! implementation.

use super::forces::{Forces, ForcesKernel};
use super::strain::{Strain, StrainKernel, Tensor, averages, encloses, gradients, initial_width, point_volume, radius};
use super::strip::{ForEachBatch, StripBuffers};
use crate::element::{Element, ElementOptions, Map, map, map_of};
use crate::stress_state::StressState;
use crate::tensor::{Dim, Matrix, Space, SymmetricTensor, Turn, product};
use embate_lanes::{BATCH, Batch, Lane, Level};
use std::marker::PhantomData;

/// An element in a stress state, by numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facts {
    /// Nodes and quadrature points of an element.
    pub(super) nodes: usize,
    pub(super) points: usize,
    /// Natural parts of its positions that mean something ([`Element::PARTS`]).
    pub(super) parts: usize,
    /// Components of its stress, and of its rotation.
    pub(super) components: usize,
    pub(super) turn: usize,
    /// Batches that hourglass control keeps per element.
    pub(super) hourglass: usize,
    /// Whether that control damps.
    pub(super) damps: bool,
    /// Batches of initial geometry per point, for hyperelastic laws.
    pub(super) initial: usize,
    /// Weight of its first point.
    pub(super) weight: f64,
    /// Its mass over that of each node ([`Element::MASS_RATIOS`]).
    pub(super) mass_ratios: &'static [f64],
    /// Whether dilatations are averaged over the nodes of the block ([`super::nodal`]).
    pub(super) averages_at_nodes: bool,
    /// Its stress state.
    pub(super) state: StressState,
}

/// A stress state that a kernel is compiled for: asked at run time the two booleans cost a tenth of a 2D
/// kernel.
pub(super) trait FixedState {
    /// The state.
    const STATE: StressState;
}

/// Plane strain, and solids in 3D.
struct Solid;
struct PlaneStress;
struct Axisymmetric;

impl FixedState for Solid {
    const STATE: StressState = StressState::SPACE;
}

impl FixedState for PlaneStress {
    const STATE: StressState = StressState { is_plane_stress: true, ..StressState::SPACE };
}

impl FixedState for Axisymmetric {
    const STATE: StressState = StressState { is_axisymmetric: true, ..StressState::SPACE };
}

/// Runs what a kernel does in its stress state, which is a type there; in 3D there is one. The condition is
/// constant, so that nothing is compiled for the others.
macro_rules! in_state {
    ($state:expr, $D:ident, $S:ident => $run:expr) => {
        if const { $D == 2 } {
            if $state.is_plane_stress {
                type $S = PlaneStress;
                $run
            } else if $state.is_axisymmetric {
                type $S = Axisymmetric;
                $run
            } else {
                type $S = Solid;
                $run
            }
        } else {
            type $S = Solid;
            $run
        }
    };
}

/// Geometry of one element: what an [`ElementKernel`] finds from the positions of its nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct ElementGeometry<const D: usize> {
    /// Of each point: place, m, and volume, m² (m³).
    pub(super) places: Vec<[f64; D]>,
    pub(super) volumes: Vec<f64>,
    /// What hyperelastic laws need of each point: [`Facts::initial`] values.
    pub(super) initial: Vec<f64>,
    /// Share of each node in the volume, m² (m³).
    pub(super) corner_volumes: Vec<f64>,
}

/// What an element does in a step. Positions of nodes are in the order of the element.
pub(super) trait ElementKernel<const D: usize>: Send + Sync {
    /// The element by numbers.
    fn facts(&self) -> &Facts;
    /// Geometry from the initial positions, m, of its nodes.
    fn geometry(&self, positions: &[[f64; D]], geometry: &mut ElementGeometry<D>);
    /// Smallest Jacobian determinant over the points.
    fn determinant(&self, positions: &[[f64; D]]) -> f64;
    /// From the motion of the nodes to what the law wants to know, for a strip of elements.
    fn strain(&self, level: Level, strain: Strain<'_, D>);
    /// From the stresses to the forces, for a strip of elements.
    fn forces(&self, level: Level, forces: Forces<'_, D>);
    /// Volumes, m² (m³), of the elements of a strip at the end of the step; for elements with one point that
    /// average at nodes.
    fn volumes(&self, strip: &StripBuffers<D>, volumes: &mut [Batch]);
    /// Largest singular value of the matrix of the nodes' gradients ∇N_a over the points, 1/m, from above: no
    /// displacement gradient is larger than that times √(Σ|u_a|²).
    fn slope(&self, positions: &[[f64; D]]) -> f64;
    /// How far it is from a reference form with its slope: ‖F⁻¹ − 1‖ from above, with what its one point does
    /// not feel, and the largest ratio of volumes; infinite where it is inverted.
    fn deformation(&self, slope: f64, reference: &[[f64; D]], positions: &[[f64; D]]) -> [f64; 2];
    /// A copy.
    fn copied(&self) -> Box<dyn ElementKernel<D>>;
}

/// An element, compiled, in a stress state.
pub(super) struct Compiled<E, const D: usize, const N: usize, const P: usize> {
    element: E,
    facts: Facts,
}

impl<E: Element<D, N, P>, const D: usize, const N: usize, const P: usize> Compiled<E, D, N, P>
where
    Dim<D>: Space<D>,
{
    /// With the options of the element, in a stress state.
    pub(super) fn new(options: &ElementOptions, state: StressState) -> Self {
        let facts = Facts {
            nodes: N,
            points: P,
            parts: E::PARTS,
            components: <Tensor<D, f64> as SymmetricTensor<f64>>::COMPONENTS,
            turn: <<Tensor<D, f64> as SymmetricTensor<f64>>::Rotation as Turn<f64>>::COMPONENTS,
            hourglass: E::HOURGLASS,
            damps: E::DAMPS,
            initial: initial_width::<E, D, N, P>(state),
            weight: E::WEIGHTS[0],
            mass_ratios: const { &E::MASS_RATIOS },
            averages_at_nodes: E::NODAL_DILATATION && !state.is_plane_stress,
            state,
        };
        Self { element: E::new(options), facts }
    }
}

/// The positions of an element's nodes as a list of their number.
fn corners<const D: usize, const N: usize>(positions: &[[f64; D]]) -> [[f64; D]; N] {
    std::array::from_fn(|a| positions[a])
}

impl<E: Element<D, N, P>, const D: usize, const N: usize, const P: usize> ElementKernel<D> for Compiled<E, D, N, P>
where
    Dim<D>: Space<D>,
{
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn geometry(&self, positions: &[[f64; D]], geometry: &mut ElementGeometry<D>) {
        let (x, state): ([[f64; D]; N], _) = (corners(positions), self.facts.state);
        let portions = E::portions(&x);
        let map = map::<E, f64, D, N, P>(gradients::<E, _, D, N, P>(state, &E::natural(&x), &portions), &E::warp(&E::natural(&x)));
        let ElementGeometry { places, volumes, initial, corner_volumes } = geometry;
        places.clear();
        volumes.clear();
        initial.clear();
        let mut corner_sums = [0.0; N];
        let own = |p: usize| point_volume::<E, _, D, N, P>(state, map.determinants[p] * E::WEIGHTS[p], &x, p);
        let scale = if encloses::<E, D, N, P>(state) { E::enclosed(&x, state.of::<D>()).0 / (0..P).map(own).sum::<f64>() } else { 1.0 };
        for p in 0..P {
            let determinant = map.determinants[p];
            let shape = E::shares(p);
            let volume = scale * own(p);
            places.push(std::array::from_fn(|d| (0..N).map(|a| shape[a] * x[a][d]).sum()));
            volumes.push(volume);
            for a in 0..N {
                corner_sums[a] += volume * shape[a];
            }
            initial.extend(map.adjugates[p].as_flattened().iter().map(|adjugate| adjugate / determinant));
            initial.push(volume);
            if E::WARPED {
                initial.extend(map.warped.as_flattened().iter().map(|warped| warped / determinant));
            }
            if state.is_axisymmetric {
                initial.push(radius(&x, &shape));
            }
            if state.is_axisymmetric && E::COMPOSITE {
                initial.push(portions[p]);
            }
        }
        corner_volumes.clear();
        corner_volumes.extend(E::corner_volumes(&x, state.is_axisymmetric).unwrap_or(corner_sums));
    }

    fn determinant(&self, positions: &[[f64; D]]) -> f64 {
        let determinants = map_of::<E, f64, D, N, P>(&corners(positions)).determinants;
        determinants.into_iter().fold(f64::INFINITY, |least, own| if own < least { own } else { least })
    }

    fn strain(&self, level: Level, input: Strain<'_, D>) {
        in_state!(self.facts.state, D, S => level.run(ForEachBatch(StrainKernel::<E, S, D, N, P> { input, kind: PhantomData })));
    }

    fn forces(&self, level: Level, input: Forces<'_, D>) {
        in_state!(self.facts.state, D, S => level.run(ForEachBatch(ForcesKernel::<E, S, D, N, P> { element: &self.element, input, state: PhantomData })));
    }

    fn volumes(&self, strip: &StripBuffers<D>, volumes: &mut [Batch]) {
        if !self.facts.averages_at_nodes {
            return;
        }
        for (batch, volumes) in volumes.iter_mut().enumerate() {
            for lane in 0..BATCH {
                let x: [[f64; D]; N] =
                    std::array::from_fn(|a| std::array::from_fn(|i| f64::load(&strip.parts[(batch * N + a) * D + i], lane)));
                let area = Dim::<D>::determinant(&E::gradients(&x)[0]) * E::WEIGHTS[0];
                volumes.0[lane] = point_volume::<E, _, D, N, P>(self.facts.state, area, &x, 0);
            }
        }
    }

    fn slope(&self, positions: &[[f64; D]]) -> f64 {
        let x: [[f64; D]; N] = corners(positions);
        let reference = Reference::<D, P>::of::<E, N>(&x, self.facts.state);
        let mut slope: f64 = 0.0;
        for p in 0..P {
            let mut square = [[0.0; D]; D];
            for a in 0..N {
                let mut nodal = [[0.0; D]; N];
                nodal[a][0] = 1.0;
                let gradient = reference.gradient::<E, N>(&nodal, p)[0];
                for (row, g) in square.iter_mut().zip(gradient) {
                    row.iter_mut().zip(gradient).for_each(|(square, other)| *square += g * other);
                }
            }
            let mut own = largest_row(&square);
            if self.facts.state.of::<D>().is_axisymmetric {
                let shape = E::shares(p);
                own += shape.iter().map(|share| share * share).sum::<f64>() / radius(&x, &shape).powi(2);
            }
            slope = slope.max(own.sqrt());
        }
        slope
    }

    fn deformation(&self, slope: f64, reference: &[[f64; D]], positions: &[[f64; D]]) -> [f64; 2] {
        let (r, x): ([[f64; D]; N], [[f64; D]; N]) = (corners(reference), corners(positions));
        let (map, state) = (Reference::<D, P>::of::<E, N>(&r, self.facts.state), self.facts.state.of::<D>());
        let (mut change, mut growth, mut least): (f64, f64, f64) = (0.0, 0.0, f64::INFINITY);
        for p in 0..P {
            let f = map.gradient::<E, N>(&x, p);
            let (mut own, mut ratio) = (Dim::<D>::adjugate(&f), Dim::<D>::determinant(&f));
            if !(ratio > 0.0) {
                return [f64::INFINITY; 2];
            }
            for (i, row) in own.iter_mut().enumerate() {
                row.iter_mut().for_each(|value| *value /= ratio);
                row[i] -= 1.0;
            }
            let mut own = norm(&own);
            if P == 1 && N > D + 1 {
                own += (1.0 + own) * slope * unfelt(&f, &r, &x);
            }
            if state.is_axisymmetric {
                let shape = E::shares(p);
                let stretch = radius(&x, &shape) / radius(&r, &shape);
                own = own.max((1.0 / stretch - 1.0).abs());
                ratio *= stretch;
            }
            (change, growth, least) = (change.max(own), growth.max(ratio), least.min(ratio));
        }
        if averages::<E, D, N, P>(self.facts.state) {
            // Means over the element have other weights.
            change += growth / least - 1.0;
        }
        // A sheet that shrinks gets thicker.
        [change, if state.is_plane_stress { growth.max(1.0) } else { growth }]
    }

    fn copied(&self) -> Box<dyn ElementKernel<D>> {
        Box::new(Self { element: self.element, facts: self.facts })
    }
}

/// The maps of an element's points in a reference form.
struct Reference<const D: usize, const P: usize> {
    adjugates: [Matrix<f64, D>; P],
    warped: Matrix<f64, D>,
    determinants: [f64; P],
    portions: [f64; P],
    state: StressState,
}

impl<const D: usize, const P: usize> Reference<D, P>
where
    Dim<D>: Space<D>,
{
    fn of<E: Element<D, N, P>, const N: usize>(x: &[[f64; D]; N], state: StressState) -> Self {
        let (natural, portions) = (E::natural(x), E::portions(x));
        let jacobians = gradients::<E, _, D, N, P>(state, &natural, &portions);
        let Map { adjugates, warped, determinants } = map::<E, f64, D, N, P>(jacobians, &E::warp(&natural));
        Self { adjugates, warped, determinants, portions, state }
    }

    /// Gradient of a nodal vector by the reference positions at a point.
    fn gradient<E: Element<D, N, P>, const N: usize>(&self, nodal: &[[f64; D]; N], p: usize) -> Matrix<f64, D> {
        let natural = E::natural(nodal);
        let mut gradient = product(&gradients::<E, _, D, N, P>(self.state, &natural, &self.portions)[p], &self.adjugates[p]);
        let more = if E::WARPED { product(&E::warp(&natural), &self.warped) } else { [[0.0; D]; D] };
        for (row, more) in gradient.iter_mut().zip(more) {
            row.iter_mut().zip(more).for_each(|(value, more)| *value = (*value + more) / self.determinants[p]);
        }
        gradient
    }
}

/// Largest sum of magnitudes in a row: no eigenvalue of a symmetric matrix is larger.
fn largest_row<const D: usize>(matrix: &Matrix<f64, D>) -> f64 {
    matrix.iter().map(|row| row.iter().map(|value| value.abs()).sum()).fold(0.0, f64::max)
}

/// Spectral norm of a matrix, from above.
fn norm<const D: usize>(matrix: &Matrix<f64, D>) -> f64 {
    let of = |i: usize, j: usize| matrix.iter().map(|row| row[i] * row[j]).sum::<f64>();
    largest_row(&std::array::from_fn::<[f64; D], D, _>(|i| std::array::from_fn(|j| of(i, j)))).sqrt()
}

/// √(Σ|r_a|²) of what is left of the motion of the nodes from `r` to `x` beside the deformation F, m.
fn unfelt<const D: usize, const N: usize>(f: &Matrix<f64, D>, r: &[[f64; D]; N], x: &[[f64; D]; N]) -> f64 {
    let mean = |of: &[[f64; D]; N], d: usize| of.iter().map(|x| x[d]).sum::<f64>() / N as f64;
    let (mean_r, mean_x): ([f64; D], [f64; D]) = (std::array::from_fn(|d| mean(r, d)), std::array::from_fn(|d| mean(x, d)));
    let left = |a: usize, i: usize| x[a][i] - mean_x[i] - (0..D).map(|k| f[i][k] * (r[a][k] - mean_r[k])).sum::<f64>();
    (0..N).flat_map(|a| (0..D).map(move |i| (a, i))).map(|(a, i)| left(a, i).powi(2)).sum::<f64>().sqrt()
}
