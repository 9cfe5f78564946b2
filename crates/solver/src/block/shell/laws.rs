//! The laws of the points through the thickness of shells: one for all of them, or one for each layer.
//!
//! Of one law a strip is answered at once. Of layers each answers for its points batch by batch; the history
//! of a batch has the points one after the other, each as long as its law needs.
//!
//! What bounds the step of layers, and what holds the patterns of hourglass, comes from the stiffness of each
//! layer at rest, C = ∂σ/∂ε without stress across, which is asked of its law: the form of each is at most
//! that of an isotropic sheet with C₁₂ = max(C₁₂), 2 µ = max(2 µ, λ(C) of anisotropic laws), and of
//! transverse shear the largest eigenvalue; A = Σ w C and D = 12 Σ w ζ² C of the section (ζ from −½ to ½)
//! give the moduli along and across, 1/(A⁻¹)₁₁ and 1/(A⁻¹)₂₂, and the like of D.

use super::bound;
use super::section::Points as Section;
use crate::block::BlockInput;
use crate::block::initial::{self, Wrong};
use crate::failure;
use crate::material::points::{PointLaw, Points, RESPONSE, Scratch};
use crate::material::variable::TEMPERATURE;
use crate::material::{Family, Parameters, VARIABLES_MOST, Variable};
use crate::model::{LOBATTO, Material, ShellSection};
use crate::tensor::{Dim, Matrix, Solid, Space, SymmetricTensor, Turn};
use embate_lanes::{BATCH, Batch, Level};
use std::ops::Range;

/// Makes the law of a material.
pub(super) type LawOf<'a> = &'a dyn Fn(&Material) -> Option<Box<dyn PointLaw>>;

/// The law of a layer.
struct Layer {
    law: Box<dyn PointLaw>,
    points: Range<usize>,
    /// Where the history of its points begins in that of a batch.
    history: usize,
    /// Which of the criteria of failure of its part are its own.
    criteria: Range<usize>,
    density: f64,
}

impl Layer {
    /// Where the history of one of its points begins.
    fn place(&self, point: usize) -> usize {
        self.history + (point - self.points.start) * self.law.state_width()
    }
}

/// The laws of all points.
pub(super) struct Laws {
    layers: Vec<Layer>,
    /// History variables of all, each once.
    variables: Vec<&'static Variable>,
}

fn density(material: &Material) -> f64 {
    Parameters::new(&[], &material.parameters, &material.lists).value("density")
}

/// The material with its axes turned by an angle.
fn turned(material: &Material, angle: f64) -> Material {
    let mut turned = material.clone();
    if angle != 0.0 {
        *turned.parameters.entry("angle".to_string()).or_insert(0.0) += angle;
    }
    turned
}

impl Laws {
    fn new(layers: Vec<Layer>) -> Self {
        let mut variables: Vec<&'static Variable> = Vec::new();
        for own in layers.iter().flat_map(|layer| layer.law.variables()) {
            if !variables.contains(&own.variable) && variables.len() < VARIABLES_MOST {
                variables.push(own.variable);
            }
        }
        Self { layers, variables }
    }

    /// The same at so many points.
    pub(super) fn one(material: &Material, law: Box<dyn PointLaw>, points: usize) -> Self {
        Self::new(vec![Layer { law, points: 0..points, history: 0, criteria: 0..usize::MAX, density: density(material) }])
    }

    /// Those of a section at so many points over the surface, and its points.
    pub(super) fn of<const D: usize>(
        input: &BlockInput<'_, D>,
        section: &ShellSection,
        law_of: LawOf<'_>,
        planes: usize,
    ) -> Option<(Self, Section)> {
        let is_lobatto = section.rule == LOBATTO;
        if section.layers.is_empty() {
            let points = Section::new(section.points, is_lobatto).moved(section.middle());
            return Some((Self::one(input.material, law_of(input.material)?, points.count() * planes), points));
        }
        let counts: Vec<usize> = section.layers.iter().map(|layer| section.points_of(layer)).collect();
        let shares = section.layers.iter().map(|layer| layer.thickness / section.thickness);
        let points = Section::layered(shares.zip(counts.iter().copied()), is_lobatto).moved(section.middle());
        let (mut layers, mut point, mut history) = (Vec::new(), 0, 0);
        for _ in 0..planes {
            let mut criteria = 0;
            for (k, (layer, &count)) in section.layers.iter().zip(&counts).enumerate() {
                let material = input.layers.get(k).copied().unwrap_or(input.material);
                let law = law_of(&turned(material, layer.angle))?;
                let known = material.failure.keys().filter(|name| failure::by_name(name).is_some()).count();
                let width = law.state_width();
                let own =
                    Layer { law, points: point..point + count, history, criteria: criteria..criteria + known, density: density(material) };
                (point, history, criteria) = (point + count, history + count * width, criteria + known);
                layers.push(own);
            }
        }
        Some((Self::new(layers), points))
    }

    /// The law of the first points.
    pub(super) fn first(&self) -> &dyn PointLaw {
        self.layers[0].law.as_ref()
    }

    fn layer_of(&self, point: usize) -> &Layer {
        self.layers.iter().find(|layer| layer.points.contains(&point)).unwrap_or(&self.layers[0])
    }

    /// Mean density, kg/m³.
    pub(super) fn density(&self, section: &Section) -> f64 {
        if let [one] = &self.layers[..] {
            return one.density;
        }
        section.weights.iter().enumerate().map(|(point, weight)| weight * self.layer_of(point).density).sum()
    }

    /// Whether all have a flag.
    pub(super) fn all(&self, has: impl Fn(&dyn PointLaw) -> bool) -> bool {
        self.layers.iter().all(|layer| has(layer.law.as_ref()))
    }

    /// The largest of the values that laws have.
    pub(super) fn largest<const N: usize>(&self, of: impl Fn(&dyn PointLaw) -> [f64; N]) -> [f64; N] {
        let more = |most: [f64; N], own: [f64; N]| std::array::from_fn(|k| if own[k] > most[k] { own[k] } else { most[k] });
        self.layers[1..].iter().map(|layer| of(layer.law.as_ref())).fold(of(self.first()), more)
    }

    /// Bulk and shear modulus at rest, Pa: the largest.
    pub(super) fn stiffness(&self) -> [f64; 2] {
        self.largest(|law| law.stiffness())
    }

    /// Whether there is one law, which always reports the stiffness of an isotropic body at rest.
    pub(super) fn has_constant_stiffness(&self) -> bool {
        matches!(&self.layers[..], [one] if one.law.has_constant_stiffness())
    }

    /// Batches of history of a batch of elements.
    pub(super) fn width(&self) -> usize {
        self.layers.iter().map(|layer| layer.points.len() * layer.law.state_width()).sum()
    }

    /// Places of [`PointLaw::ratios`] of each point in the history of a batch.
    pub(super) fn ratios(&self) -> Vec<[Option<usize>; 2]> {
        let of = |layer: &Layer, point: usize| layer.law.ratios().map(|own| own.map(|place| layer.place(point) + place));
        self.layers.iter().flat_map(|layer| layer.points.clone().map(move |point| of(layer, point))).collect()
    }

    /// Writes the history of a batch at the start.
    pub(super) fn start(&self, history: &mut [Batch]) {
        for layer in &self.layers {
            let width = layer.law.state_width();
            history[layer.history..][..layer.points.len() * width].chunks_exact_mut(width).for_each(|point| layer.law.start(point));
        }
    }

    /// Gives all points a temperature, K.
    pub(super) fn warm(&self, history: &mut [Batch], temperature: f64) -> Result<(), Wrong> {
        let knowing = self.layers.iter().filter(|layer| layer.law.place(&TEMPERATURE).is_some());
        if knowing.clone().next().is_none() {
            return initial::warm(self.first(), &mut [], temperature);
        }
        for batch in history.chunks_exact_mut(self.width()) {
            for layer in knowing.clone() {
                let width = layer.points.len() * layer.law.state_width();
                initial::warm(layer.law.as_ref(), &mut batch[layer.history..][..width], temperature)?;
            }
        }
        Ok(())
    }

    /// Where a variable of a point is in the history of a batch.
    pub(super) fn place(&self, point: usize, variable: &Variable) -> Option<usize> {
        let layer = self.layer_of(point);
        Some(layer.place(point) + layer.law.place(variable)?)
    }

    /// History variables, each once.
    pub(super) fn variables(&self) -> &[&'static Variable] {
        &self.variables
    }

    /// Whether a criterion of failure counts at a point.
    pub(super) fn counts_at(&self, criterion: usize, point: usize) -> bool {
        self.layer_of(point).criteria.contains(&criterion)
    }

    /// Answers of all points of a strip; see [`PointLaw::respond`].
    pub(super) fn respond(&self, level: Level, points: Points<'_>, batches: usize) {
        if let [one] = &self.layers[..] {
            one.law.respond(level, points);
            return;
        }
        let Points { time_step, strain, rotation, volume_ratio, viscous_heat, stress, state, response, scratch } = points;
        let all = volume_ratio.len() / batches;
        let (components, turn, width) = (strain.len() / (batches * all), rotation.len() / (batches * all), state.len() / batches);
        for batch in 0..batches {
            for layer in &self.layers {
                let own = batch * all + layer.points.start..batch * all + layer.points.end;
                let of = |each: usize| own.start * each..own.end * each;
                let history = batch * width + layer.history;
                let history = history..history + own.len() * layer.law.state_width();
                let points = Points {
                    time_step,
                    strain: &strain[of(components)],
                    rotation: &rotation[of(turn)],
                    volume_ratio: &volume_ratio[own.clone()],
                    viscous_heat: &viscous_heat[own.clone()],
                    stress: &mut stress[of(components)],
                    state: &mut state[history],
                    response: &mut response[of(RESPONSE)],
                    scratch: &mut *scratch,
                };
                layer.law.respond(level, points);
            }
        }
    }
}

/// What holds patterns of hourglass in 3D, by moduli of the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Held {
    /// Along ê₁, Pa, and that along ê₂ over it.
    pub(super) young: f64,
    pub(super) side: f64,
    pub(super) poisson: f64,
    /// What bending has of these: along ê₁, mixed, along ê₂.
    pub(super) bending: [f64; 3],
    /// Transverse shear modulus along ê₁, Pa, and that along ê₂ over it.
    pub(super) shear: f64,
    pub(super) shear_side: f64,
}

impl Held {
    /// Of an isotropic section, Pa.
    pub(super) fn isotropic([young, poisson]: [f64; 2], shear: f64) -> Self {
        Self { young, side: 1.0, poisson, bending: [1.0; 3], shear, shear_side: 1.0 }
    }
}

/// Moduli of layers in 3D.
pub(super) struct Stiffness {
    pub(super) held: Held,
    /// Modulus of a membrane, and shear moduli in the plane and across it, Pa, that none exceeds at rest; and
    /// whether none ever does.
    pub(super) moduli: [f64; 3],
    pub(super) is_limited: bool,
}

/// Places of xx yy xy and of zx yz.
const FLAT: [usize; 3] = [0, 1, 3];
const ACROSS: [usize; 2] = [5, 4];

impl Laws {
    /// Moduli of layers in 3D.
    pub(super) fn measured(&self, section: &Section) -> Stiffness {
        let (mut mixed, mut doubled, mut transverse) = (0.0f64, 0.0f64, 0.0f64);
        let (mut plane, mut bend, mut across) = ([[0.0; 3]; 3], [[0.0; 3]; 3], [0.0; 2]);
        for layer in &self.layers {
            let c = tangent(layer.law.as_ref());
            // By engineering shear: C of xx yy xy.
            let flat: Matrix<f64, 3> = FLAT.map(|i| FLAT.map(|j| if j == 3 { 0.5 * c[i][j] } else { c[i][j] }));
            let shear = ACROSS.map(|i| ACROSS.map(|j| 0.5 * c[i][j]));
            transverse = transverse.max(bound::steepest(&shear));
            if layer.law.is_stiffest_at_rest() {
                (mixed, doubled) = (mixed.max(flat[0][1]), doubled.max(2.0 * flat[2][2]));
            } else {
                // By √2 times the shear strain.
                let root = 2f64.sqrt();
                let form = Solid([flat[0][0], flat[1][1], 2.0 * flat[2][2], flat[0][1], root * flat[1][2], root * flat[0][2]]);
                doubled = doubled.max(form.principal().0.into_iter().fold(0.0, f64::max));
            }
            for point in layer.points.clone().take_while(|&point| point < section.count()) {
                let (weight, height) = (section.weights[point], section.heights[point] - section.middle);
                for i in 0..3 {
                    for j in 0..3 {
                        plane[i][j] += weight * flat[i][j];
                        bend[i][j] += 12.0 * weight * height * height * flat[i][j];
                    }
                }
                across = [0, 1].map(|k| across[k] + weight * shear[k][k]);
            }
        }
        let [young, other, shared] = along(&plane).unwrap_or([mixed + doubled; 3]);
        let bent = along(&bend).unwrap_or([young, other, shared]);
        let part = |bent: f64, plane: f64| if plane == 0.0 { 0.0 } else { bent / plane };
        let held = Held {
            young,
            side: other / young,
            poisson: shared / young,
            bending: [part(bent[0], young), part(bent[2], shared), part(bent[1], other)],
            shear: across[0],
            shear_side: across[1] / across[0],
        };
        let moduli = [mixed + doubled, 0.5 * doubled, transverse];
        Stiffness { held, moduli, is_limited: self.all(|law| law.family() == Family::Rate) }
    }
}

/// E₁ and E₂ of a stiffness by xx yy xy, and ν₁₂ E₂; `None` where it has no inverse.
fn along(c: &Matrix<f64, 3>) -> Option<[f64; 3]> {
    let determinant = Dim::<3>::determinant(c);
    let size = c[0][0] * c[1][1] * c[2][2];
    if determinant.is_nan() || determinant <= 1e-9 * size {
        return None;
    }
    // The adjugate of a symmetric matrix is symmetric.
    let inverse = crate::tensor::scaled(Dim::<3>::adjugate(c), 1.0 / determinant);
    let (a, b) = (inverse[0][0], inverse[1][1]);
    Some([1.0 / a, 1.0 / b, -inverse[0][1] / (a * b)])
}

/// ∂σ_i/∂ε_j of a layer at rest, by the strains (not the angles) xx yy zz xy yz zx, Pa.
fn tangent(law: &dyn PointLaw) -> [[f64; 6]; 6] {
    const SIZE: f64 = 1e-6;
    let is_rate = law.family() == Family::Rate;
    let mut strain = [Batch::default(); 6];
    let mut ratio = Batch::splat(1.0);
    for lane in 0..BATCH {
        // Of hyperelastic laws b = F Fᵀ with no stretch across, which is still to come.
        let mut own = if is_rate { [0.0; 6] } else { [1.0, 1.0, 0.0, 0.0, 0.0, 0.0] };
        let (h, twice) = (SIZE, 2.0 * SIZE);
        match (lane, is_rate) {
            (0..6, true) => own[lane] = if lane == 2 { 0.0 } else { h },
            (0 | 1, false) => (own[lane], ratio.0[lane]) = ((1.0 + h) * (1.0 + h), 1.0 + h),
            (3, false) => (own[0], own[3]) = (1.0 + twice * twice, twice),
            (4 | 5, false) => (own[2], own[lane]) = (twice * twice, twice),
            _ => {}
        }
        strain.iter_mut().zip(own).for_each(|(batch, value)| batch.0[lane] = value);
    }
    let mut rotation = [Batch::default(); 9];
    (0..BATCH).for_each(|lane| Matrix::<f64, 3>::none().store(&mut rotation, lane));
    let mut state = vec![Batch::default(); law.state_width()];
    law.start(&mut state);
    let (mut stress, mut response) = ([Batch::default(); 6], [Batch::default(); RESPONSE]);
    law.respond(
        Level::SCALAR,
        Points {
            time_step: 1e-12,
            strain: &strain,
            rotation: &rotation,
            volume_ratio: &[ratio],
            viscous_heat: &[Batch::default()],
            stress: &mut stress,
            state: &mut state,
            response: &mut response,
            scratch: &mut Scratch::default(),
        },
    );
    std::array::from_fn(|i| std::array::from_fn(|j| stress[i].0[j] / SIZE))
}
