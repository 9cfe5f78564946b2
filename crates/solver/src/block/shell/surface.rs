//! What shells in 3D have in common: the frame of an element, the strain of its layers and what their
//! stresses pull with, from positions and directors at the centre.
//!
//! g_α = ∂x/∂ξ_α and d_α = ∂d/∂ξ_α are derivatives at the centre with respect to natural coordinates, d₀ the
//! mean director. n̂ = d₀/|d₀|; ê₁ and ê₂ turn with the natural axes such that the matrix ê_i·g_α, without
//! the turn that was given at the start, is symmetric: so renumbering the corners changes nothing. At the
//! start ê₁ is the projection of x on the shell (of z where x is normal to it).
//!
//! ```text
//! layer at z: F = G + z D,   G_iα = ê_i·g_α,   D_iα = w ê_i·d_α;   |F| its area
//! rate: Δε and the turn in the plane from F_old and F_new as in 2D (Hughes and Winget 1980)
//! transverse: 2 Δε_i3 = √k Σ_α Δs_α (G⁻¹)_αi at mid-step,   k = 5/6
//! hyperelastic: [F F₀⁻¹, 0; γ, λ] with γ_i = √k Σ_α (s_α − s_α,0) (G₀⁻¹)_αi
//! N_iα = Σ V σ_ij (F⁻¹)_αj,   M_iα = Σ z V σ_ij (F⁻¹)_αj,   Q_α = √k Σ V σ_3i (G⁻¹)_αi
//! ```
//!
//! With the middle at o from the nodes z is o more; t²/12 becomes t²/12 + o² in what follows from it, and
//! bounds in the plane and across it are added. V is the volume of a layer, s_α the covariant transverse
//! shear of the kernel. Derived for this program; the lineage is Simo and Fox, Comput. Meth. Appl. Mech.
//! Engng 72 (1989) 267-304.

use super::bound;
use super::{Answer, Corners, Facts, Layers, Strains, Tensor};
use crate::block::SHELL_VALUES;
use crate::material::Family;
use crate::material::points::RESPONSE;
use crate::tensor::{Dim, Matrix, Plane, Space, SymmetricTensor, Turn, cross, dot, product};
use crate::vector::{minus, plus};
use embate_lanes::{Batch, Lane};

/// A vector of lanes.
pub(super) type Vector<L> = [L; 3];

/// Shear factor of a rectangular section.
pub(super) const SHEAR: f64 = 5.0 / 6.0;

/// Places in the state of every shell in 3D: what is measured at the start and now, and the turn from the
/// natural axes to ê₁ and ê₂, as cosine and sine.
pub(super) const BEGIN: usize = 0;
pub(super) const NOW: usize = Measures::<f64>::WIDTH;
pub(super) const TURN: usize = 2 * Measures::<f64>::WIDTH;
/// The first place after them.
pub(super) const COMMON: usize = TURN + 2;

/// a times a vector.
#[inline(always)]
pub(super) fn scaled<L: Lane>(a: L, v: Vector<L>) -> Vector<L> {
    [a * v[0], a * v[1], a * v[2]]
}

/// Numbers of the state, one after the other.
#[inline(always)]
pub(super) fn loaded<L: Lane, const N: usize>(state: &[Batch], first: usize, at: usize) -> [L; N] {
    let mut all = [L::splat(0.0); N];
    for k in 0..N {
        all[k] = L::load(&state[first + k], at);
    }
    all
}

/// Replaces numbers of the state where `there`.
#[inline(always)]
pub(super) fn replace<L: Lane, const N: usize>(there: L::Mask, new: &[L; N], state: &mut [Batch], first: usize, at: usize) {
    for k in 0..N {
        L::select(there, new[k], L::load(&state[first + k], at)).store(&mut state[first + k], at);
    }
}

/// Vectors of the state, one after the other.
#[inline(always)]
pub(super) fn vectors<L: Lane, const N: usize>(state: &[Batch], first: usize, at: usize) -> [Vector<L>; N] {
    let mut all = [[L::splat(0.0); 3]; N];
    for k in 0..N {
        all[k] = loaded(state, first + 3 * k, at);
    }
    all
}

/// Replaces vectors of the state where `there`.
#[inline(always)]
pub(super) fn replace_vectors<L: Lane, const N: usize>(there: L::Mask, new: &[Vector<L>; N], state: &mut [Batch], first: usize, at: usize) {
    for k in 0..N {
        replace(there, &new[k], state, first + 3 * k, at);
    }
}

/// Positions of the corners, and their directors, which are at `first` of the state as they were at the
/// start.
#[inline(always)]
pub(super) fn moved<L: Lane, const N: usize>(corners: &Corners<'_, 3>, state: &[Batch], first: usize, at: usize) -> [[Vector<L>; N]; 2] {
    let (mut x, mut d) = ([[L::splat(0.0); 3]; N], vectors::<L, N>(state, first, at));
    for a in 0..N {
        let (own, rotation) = corners.of(a, at);
        (x[a], d[a]) = (own, rotated(rotation, d[a]));
    }
    [x, d]
}

/// m v.
#[inline(always)]
pub(super) fn times<L: Lane>(m: &Matrix<L, 2>, v: [L; 2]) -> [L; 2] {
    [m[0][0] * v[0] + m[0][1] * v[1], m[1][0] * v[0] + m[1][1] * v[1]]
}

/// mᵀ v.
#[inline(always)]
fn across<L: Lane>(m: &Matrix<L, 2>, v: [L; 2]) -> [L; 2] {
    [m[0][0] * v[0] + m[1][0] * v[1], m[0][1] * v[0] + m[1][1] * v[1]]
}

/// a·b.
#[inline(always)]
pub(super) fn both<L: Lane>(a: [L; 2], b: [L; 2]) -> L {
    a[0] * b[0] + a[1] * b[1]
}

/// A director where the quaternion w, x, y, z takes it: v + 2 w u × v + 2 u × (u × v).
#[inline(always)]
pub(super) fn rotated<L: Lane>([w, x, y, z]: [L; 4], v: Vector<L>) -> Vector<L> {
    let u = [x, y, z];
    let once = cross(u, v);
    plus(v, scaled(L::splat(2.0), plus(scaled(w, once), cross(u, once))))
}

/// What an element is, as far as layers are concerned: G, D and s.
#[derive(Clone, Copy)]
pub(super) struct Measures<L> {
    pub(super) map: Matrix<L, 2>,
    pub(super) bend: Matrix<L, 2>,
    pub(super) slide: [L; 2],
}

impl<L> Measures<L> {
    pub(super) const WIDTH: usize = 10;
}

impl<L: Lane> Measures<L> {
    #[inline(always)]
    pub(super) fn load(state: &[Batch], first: usize, at: usize) -> Self {
        let all: [L; Measures::<f64>::WIDTH] = loaded(state, first, at);
        Self { map: [[all[0], all[1]], [all[2], all[3]]], bend: [[all[4], all[5]], [all[6], all[7]]], slide: [all[8], all[9]] }
    }

    #[inline(always)]
    pub(super) fn all(&self) -> [L; Measures::<f64>::WIDTH] {
        let [[a, b], [c, d]] = self.map;
        let [[e, f], [g, h]] = self.bend;
        [a, b, c, d, e, f, g, h, self.slide[0], self.slide[1]]
    }

    /// F of the layer at a height.
    #[inline(always)]
    fn layer(&self, z: L) -> Matrix<L, 2> {
        by_height(&self.map, &self.bend, z)
    }

    /// |F| of the layer at z is the first, z times the second and z² times the third.
    #[inline(always)]
    fn areas(&self) -> [L; 3] {
        let (g, d) = (&self.map, &self.bend);
        let mixed = g[0][0] * d[1][1] + d[0][0] * g[1][1] - (g[0][1] * d[1][0] + d[0][1] * g[1][0]);
        [Dim::<2>::determinant(g), mixed, Dim::<2>::determinant(d)]
    }

    /// G⁻¹.
    #[inline(always)]
    pub(super) fn inverse(&self) -> Matrix<L, 2> {
        let inverse = L::splat(1.0) / Dim::<2>::determinant(&self.map);
        crate::tensor::scaled(Dim::<2>::adjugate(&self.map), inverse)
    }
}

/// a + b.
#[inline(always)]
fn sum<L: Lane>(a: &Matrix<L, 2>, b: &Matrix<L, 2>) -> Matrix<L, 2> {
    [plus(a[0], b[0]), plus(a[1], b[1])]
}

/// a + z b.
#[inline(always)]
pub(super) fn by_height<L: Lane>(a: &Matrix<L, 2>, b: &Matrix<L, 2>, z: L) -> Matrix<L, 2> {
    [[a[0][0] + z * b[0][0], a[0][1] + z * b[0][1]], [a[1][0] + z * b[1][0], a[1][1] + z * b[1][1]]]
}

/// The axes of an element.
#[derive(Clone, Copy)]
pub(super) struct Frame<L> {
    /// ê₁, ê₂, n̂.
    pub(super) axes: [Vector<L>; 3],
    /// The natural axes, before the turn.
    pub(super) natural: [Vector<L>; 2],
    /// Trace of the natural axes' G, m.
    pub(super) trace: L,
    /// |d₀| and 1/|d₀|.
    pub(super) size: L,
    pub(super) shortening: L,
}

impl<L: Lane> Frame<L> {
    #[inline(always)]
    pub(super) fn new(g: &[Vector<L>; 2], director: Vector<L>, [cos, sin]: [L; 2]) -> Self {
        let one = L::splat(1.0);
        let size = dot(director, director).sqrt();
        let shortening = one / size;
        let normal = scaled(shortening, director);
        let sum = plus(minus(g[0], scaled(dot(normal, g[0]), normal)), cross(g[1], normal));
        let trace = dot(sum, sum).sqrt();
        let first = scaled(one / trace, sum);
        let second = cross(normal, first);
        let axes = [plus(scaled(cos, first), scaled(sin, second)), minus(scaled(cos, second), scaled(sin, first)), normal];
        Self { axes, natural: [first, second], trace, size, shortening }
    }

    /// ê_i·v in the plane.
    #[inline(always)]
    pub(super) fn seen(&self, v: Vector<L>) -> [L; 2] {
        [dot(self.axes[0], v), dot(self.axes[1], v)]
    }

    /// ê_i·v_α.
    #[inline(always)]
    pub(super) fn matrix(&self, v: &[Vector<L>; 2]) -> Matrix<L, 2> {
        let [a, b] = [self.seen(v[0]), self.seen(v[1])];
        [[a[0], b[0]], [a[1], b[1]]]
    }

    /// Σ_i c_i ê_i.
    #[inline(always)]
    pub(super) fn vector(&self, [a, b]: [L; 2]) -> Vector<L> {
        plus(scaled(a, self.axes[0]), scaled(b, self.axes[1]))
    }
}

/// Cosine and sine of the turn from the natural axes to those that a shell has at the start.
pub(super) fn turn_at_start(g: &[[f64; 3]; 2], director: [f64; 3]) -> [f64; 2] {
    let frame = Frame::<f64>::new(g, director, [1.0, 0.0]);
    let normal = frame.axes[2];
    // As good as normal to x: 0.1 degrees.
    let along = if normal[0].abs() > 1.0 - 1.5e-6 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    let [a, b] = frame.seen(along);
    let length = (a * a + b * b).sqrt();
    [a / length, b / length]
}

/// How far the barrier of [`arc`] reaches.
const BARRIER: f64 = 0.02;

/// What makes of the chord d_α between directors the arc between them, and its derivative by the size c of
/// the mean director: w = n/(n − 1 + c) + ε (1 − c²)/c. With n = 3 it is 3 sin x/(2 + cos x), x but for
/// x⁵/180, for directors at ±x (n = 2: the same of triangles): chords alone would let a hinge become the
/// softer the more it has turned. The second term keeps an element from folding over (1 % at x = 45°, 5 % at
/// 75°).
#[inline(always)]
pub(super) fn arc<L: Lane>(c: L, n: f64) -> [L; 2] {
    let (one, barrier) = (L::splat(1.0), L::splat(BARRIER));
    let (sum, over) = (one / (L::splat(n - 1.0) + c), one / c);
    let w = L::splat(n) * sum + barrier * (over - c);
    [w, -(L::splat(n) * sum * sum) - barrier * (over * over + one)]
}

/// What is the same of all elements of a kernel, or belongs to one of them: area of the natural axes' unit,
/// and the square root of the factor of the transverse shear.
#[derive(Clone, Copy)]
pub(super) struct Kind<L> {
    pub(super) area: f64,
    pub(super) shear: L,
}

/// Strains the layers over the way from `before` to `now`.
#[inline(always)]
pub(super) fn strain<L: Lane>(facts: &Facts, kind: Kind<L>, [begin, before, now]: [&Measures<L>; 3], strains: &mut Strains<'_>, at: usize) {
    let (half, one, zero) = (L::splat(0.5), L::splat(1.0), L::splat(0.0));
    let there = half.less(L::load(strains.live, at));
    let is_rate = matches!(facts.family, Family::Rate);
    let (thickness, initial) = (L::load(strains.thickness[0], at), L::load(strains.thickness[1], at));
    let heights = if is_rate { thickness } else { initial };
    let change = minus(now.slide, if is_rate { before.slide } else { begin.slide });
    let base = if is_rate { Measures { map: mean(&before.map, &now.map), ..*now } } else { *begin };
    let inverse = base.inverse();
    let slip = across(&inverse, [kind.shear * change[0], kind.shear * change[1]]);
    for (p, (&height, &weight)) in facts.section.heights.iter().zip(&facts.section.weights).enumerate() {
        let z = L::splat(height) * heights;
        let (new, start) = (now.layer(z), begin.layer(z));
        let (strain, mut volume, mut ratio);
        if is_rate {
            let old = before.layer(z);
            let middle = mean(&old, &new);
            let step = [minus(new[0], old[0]), minus(new[1], old[1])];
            let determinant = Dim::<2>::determinant(&middle);
            let (gradient, turns) = Dim::<2>::displaced(&step, &Dim::<2>::adjugate(&middle), determinant);
            let flat = Dim::<2>::symmetric(&gradient).rotated(&turns[0]).0;
            // Half a turn: the mean of what it was and what it is.
            let whole = Dim::<2>::turned(slip, &turns);
            let across = [L::splat(0.25) * (slip[0] + whole[0]), L::splat(0.25) * (slip[1] + whole[1])];
            strain = [flat[0], flat[1], zero, flat[3], across[1], across[0]];
            turn::<L>(facts, strains, p, there, &turns, at);
            volume = determinant;
            ratio = one;
            if facts.needs_ratio {
                ratio = Dim::<2>::determinant(&new) / Dim::<2>::determinant(&start);
            }
        } else {
            let determinant = Dim::<2>::determinant(&start);
            let inverse = crate::tensor::scaled(Dim::<2>::adjugate(&start), one / determinant);
            let f = product(&new, &inverse);
            let b = Dim::<2>::left_cauchy_green(&f, one).0;
            let across = times(&f, slip);
            strain = [b[0], b[1], slip[0] * slip[0] + slip[1] * slip[1], b[3], across[1], across[0]];
            volume = determinant;
            ratio = Dim::<2>::determinant(&f);
        }
        volume = volume * initial * L::splat(kind.area * weight);
        ratio = L::select(there, ratio, one);
        // What is not there, or only fills the batch up, is not strained.
        let rest = if is_rate { zero } else { one };
        let rests = [rest, rest, zero, zero, zero, zero];
        let own = &mut strains.strain[p * facts.components..][..facts.components];
        for k in 0..6 {
            L::select(there, strain[k], rests[k]).store(&mut own[k], at);
        }
        L::select(there, volume, zero).store(&mut strains.volume[p], at);
        ratio.store(&mut strains.ratio[p], at);
    }
}

/// ½ (a + b).
#[inline(always)]
fn mean<L: Lane>(a: &Matrix<L, 2>, b: &Matrix<L, 2>) -> Matrix<L, 2> {
    let half = L::splat(0.5);
    [[half * (a[0][0] + b[0][0]), half * (a[0][1] + b[0][1])], [half * (a[1][0] + b[1][0]), half * (a[1][1] + b[1][1])]]
}

/// Turns the stress of a layer with the material, and says how far to laws that want to know.
#[inline(always)]
fn turn<L: Lane>(facts: &Facts, strains: &mut Strains<'_>, p: usize, there: L::Mask, turns: &crate::tensor::Turns<Plane<L>, L>, at: usize) {
    let own = &mut strains.stress[p * facts.components..][..facts.components];
    let old = Tensor::<3, L>::load(own, at).0;
    let flat = Plane([old[0], old[1], old[2], old[3]]).rotated(&turns[1]).0;
    let across = Dim::<2>::turned([old[5], old[4]], turns);
    let new = [flat[0], flat[1], old[2], flat[3], across[1], across[0]];
    for k in 0..6 {
        L::select(there, new[k], old[k]).store(&mut own[k], at);
    }
    if !strains.rotation.is_empty() {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let [cos, sin] = turns[0].0;
        let turn = <Matrix<L, 3> as Turn<L>>::about_z(L::select(there, cos, one), L::select(there, sin, zero));
        turn.store(&mut strains.rotation[p * 9..][..9], at);
    }
}

/// What the stresses of the layers pull with.
#[derive(Clone, Copy)]
pub(super) struct Flux<L> {
    /// N, M and Q of the head of the file.
    pub(super) membrane: Matrix<L, 2>,
    pub(super) moment: Matrix<L, 2>,
    pub(super) transverse: [L; 2],
    /// Volume V of all layers, m³, and √(V Σ V |σ|²) of them, J.
    pub(super) volume: L,
    pub(super) strained: L,
    /// Largest modulus of a membrane, and shear moduli in the plane and across it, Pa.
    pub(super) moduli: [L; 3],
    /// Present thickness, m.
    pub(super) thickness: L,
    /// Least area of a layer over that of the middle, and of the middle over that at the start.
    pub(super) determinant: L,
    /// See [`super::Answer::flow`].
    pub(super) flow: [L; 3],
    /// See [`super::Answer::resultants`].
    pub(super) resultants: [L; SHELL_VALUES],
}

/// Sums of the layers, of an element that is now so thick.
#[inline(always)]
pub(super) fn flux<L: Lane>(
    facts: &Facts,
    kind: Kind<L>,
    [begin, now]: [&Measures<L>; 2],
    layers: &Layers<'_>,
    thickness: L,
    at: usize,
) -> Flux<L> {
    let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
    let is_rate = matches!(facts.family, Family::Rate);
    let initial = L::load(layers.thickness, at);
    let heights = if is_rate { thickness } else { initial };
    let area = Dim::<2>::determinant(&now.map);
    // Stress by height: the adjugate of F is that of G and z times that of D.
    let mut sums = [[zero; 3]; 4];
    let (flat, bent) = (Dim::<2>::adjugate(&now.map), Dim::<2>::adjugate(&now.bend));
    let areas = now.areas();
    let mut to = Flux {
        membrane: [[zero; 2]; 2],
        moment: [[zero; 2]; 2],
        transverse: [zero; 2],
        volume: zero,
        strained: zero,
        moduli: [zero; 3],
        thickness,
        determinant: area / Dim::<2>::determinant(&begin.map),
        flow: [zero; 3],
        resultants: [zero; SHELL_VALUES],
    };
    let (mut sheared, mut squares, mut least) = ([zero; 2], 0.0, area);
    for (p, (&height, &weight)) in facts.section.heights.iter().zip(&facts.section.weights).enumerate() {
        let [_, stretch] = layers.stretches::<L>(facts, p, at);
        let stress = layers.stress_of::<Tensor<3, L>, L>(p, at).0;
        let [xx, yy, _, xy, yz, zx] = stress;
        let own: [L; RESPONSE] = loaded(layers.response, p * RESPONSE, at);
        let z = L::splat(height) * heights;
        let determinant = areas[0] + z * (areas[1] + z * areas[2]);
        let plate = initial * stretch * L::splat(kind.area * weight);
        let volume = plate * determinant;
        let mut pull = [plate * xx, plate * yy, plate * xy];
        for (k, sum) in sums.iter_mut().enumerate() {
            for c in 0..3 {
                if k > 0 {
                    pull[c] = z * pull[c];
                }
                sum[c] += pull[c];
            }
        }
        let shear = [zx * plate, yz * plate];
        if is_rate {
            sheared = [sheared[0] + shear[0] * determinant, sheared[1] + shear[1] * determinant];
        } else {
            let adjugate = by_height(&flat, &bent, z);
            let more = times(&begin.layer(z), times(&adjugate, shear));
            sheared = [sheared[0] + more[0], sheared[1] + more[1]];
        }
        let norm = xx * xx + yy * yy + L::splat(2.0) * (xy * xy + yz * yz + zx * zx);
        to.strained += volume * norm;
        to.volume += volume;
        let shear = to.moduli[1].max(own[3]);
        to.moduli = [to.moduli[0].max(facts.membrane_bound(own[2], own[3])), shear, shear];
        least = least.min(determinant);
        if is_rate {
            let (work, lost) = (half * own[0], own[1]);
            // Most steps are elastic: nothing is divided then.
            if L::any(zero.less(lost)) {
                let part = L::select(zero.less(work), (lost / work).min(one).max(zero), zero);
                to.flow[0] += L::splat(weight) * part;
                to.flow[1] += L::splat(weight * height * height) * part;
            }
            let square = xx * xx + yy * yy - xx * yy + L::splat(3.0) * (xy * xy + yz * yz + zx * zx);
            to.flow[2] += L::splat(weight) * square;
            squares += weight * height * height;
        }
    }
    let (first, second) = (Dim::<2>::flux(&in_plane(&sums[1]), &flat), Dim::<2>::flux(&in_plane(&sums[1]), &bent));
    to.membrane = sum(&Dim::<2>::flux(&in_plane(&sums[0]), &flat), &second);
    to.moment = sum(&first, &Dim::<2>::flux(&in_plane(&sums[2]), &bent));
    to.determinant = to.determinant.min(least / area);
    // No less than the sum of volumes times norms.
    to.strained = (to.volume * to.strained).sqrt();
    to.flow[2] = to.flow[2].sqrt();
    if facts.is_layered {
        to.moduli = bound::of_layers(facts, to.moduli);
    }
    to.flow[1] = if squares > 0.0 { to.flow[1] * L::splat(1.0 / squares) } else { to.flow[0] };
    let inverse = if is_rate { now.inverse() } else { begin.inverse() };
    to.transverse = times(&inverse, [kind.shear * sheared[0], kind.shear * sheared[1]]);
    // By width: over the area of the middle.
    let over = one / (L::splat(kind.area) * area);
    for k in 0..3 {
        to.resultants[k] = by_areas(&areas, [sums[0][k], sums[1][k], sums[2][k]]) * over;
        to.resultants[3 + k] = -(by_areas(&areas, [sums[1][k], sums[2][k], sums[3][k]]) * over);
    }
    let force = times(&now.map, to.transverse);
    (to.resultants[6], to.resultants[7], to.resultants[8]) = (force[0] * over, force[1] * over, thickness);
    to
}

/// xx yy xy as a tensor. No closure: these are not compiled for the lanes.
#[inline(always)]
fn in_plane<L: Lane>(&[xx, yy, xy]: &[L; 3]) -> Plane<L> {
    Plane([xx, yy, L::splat(0.0), xy])
}

/// a₀ s₀ + a₁ s₁ + a₂ s₂.
#[inline(always)]
fn by_areas<L: Lane>(areas: &[L; 3], sums: [L; 3]) -> L {
    areas[0] * sums[0] + areas[1] * sums[1] + areas[2] * sums[2]
}

/// Stress of an elastic body with K and µ, Pa, that is strained like a layer.
#[inline(always)]
pub(super) fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], [bulk, shear]: [L; 2], at: usize) -> [L; 6] {
    let [xx, yy, _, xy, yz, zx] = Tensor::<3, L>::load(strain, at).0;
    let (zero, two) = (L::splat(0.0), L::splat(2.0));
    let modulus = facts.membrane_modulus(bulk, shear);
    // E/(1 − ν²) ν = E/(1 − ν²) − 2 µ.
    let across = modulus - two * shear;
    [modulus * xx + across * yy, modulus * yy + across * xx, zero, two * shear * xy, two * shear * yz, two * shear * zx]
}

/// A stress in the frame as the model sees it: xx yy zz xy yz zx.
pub(super) fn turned(axes: &[[f64; 3]; 3], stress: [f64; 6]) -> [f64; 6] {
    let columns = std::array::from_fn(|i| std::array::from_fn(|k| axes[k][i]));
    crate::tensor::Solid(stress).rotated(&columns).0
}

/// Forces on d₁ and d₂ of moments M, and what the size of the mean director does to the arcs between them.
#[inline(always)]
pub(super) fn bent<L: Lane>(frame: &Frame<L>, d: &[Vector<L>; 2], moment: &Matrix<L, 2>, n: f64) -> ([Vector<L>; 2], L) {
    bent_by(frame, d, moment, arc(frame.size, n))
}

/// The same with known [`arc`].
#[inline(always)]
pub(super) fn bent_by<L: Lane>(frame: &Frame<L>, d: &[Vector<L>; 2], moment: &Matrix<L, 2>, [w, slope]: [L; 2]) -> ([Vector<L>; 2], L) {
    let on = [scaled(w, frame.vector([moment[0][0], moment[1][0]])), scaled(w, frame.vector([moment[0][1], moment[1][1]]))];
    let chord = frame.matrix(d);
    (on, slope * (both(chord[0], moment[0]) + both(chord[1], moment[1])))
}

/// What tilts the frame with the mean director: forces on vectors, by the heights of these over the plane.
#[inline(always)]
pub(super) fn tilt<L: Lane, const N: usize>(frame: &Frame<L>, pulled: &[[Vector<L>; 2]; N]) -> Vector<L> {
    let normal = frame.axes[2];
    let mut sum = scaled(dot(normal, pulled[0][0]), pulled[0][1]);
    for k in 1..N {
        sum = plus(sum, scaled(dot(normal, pulled[k][0]), pulled[k][1]));
    }
    sum
}

/// What an element answers without hourglass control, given its bounds for [`bound::joined`]; `sharp` is the
/// sum of the squares of the derivatives of the shape functions over the mass of a corner, by natural axes.
#[inline(always)]
pub(super) fn answer<L: Lane>(
    to: &Flux<L>,
    frame: &Frame<L>,
    g: &[Vector<L>; 2],
    inverse: &Matrix<L, 2>,
    bounds: [L; 3],
    sharp: f64,
    inertia: L,
) -> Answer<L> {
    let tilted = bound::tilted(frame, g, inverse, to.moduli[0] * to.volume, inertia);
    let taut = bound::taut(to.strained, L::splat(sharp) * bound::steepest(&bound::metric(inverse)), inertia);
    Answer {
        stiffness: bound::joined(bounds, tilted) + taut,
        determinant: to.determinant,
        thickness: to.thickness,
        hourglass: L::splat(0.0),
        besides: [L::splat(0.0); 2],
        flow: to.flow,
        resultants: to.resultants,
    }
}

/// Volumes of the layers at the start.
pub(super) fn volumes(facts: &Facts, area: f64, begin: &Measures<f64>, thickness: f64) -> Vec<f64> {
    let layers = facts.section.heights.iter().zip(&facts.section.weights);
    layers.map(|(height, weight)| area * thickness * weight * Dim::<2>::determinant(&begin.layer(height * thickness))).collect()
}

/// Directors of the corners of each element: the mean of the normals of the elements around a node, as far as
/// these differ by less than an angle with the cosine `fold`.
pub(super) fn directions<const N: usize>(connectivity: &[u32], positions: &[[f64; 3]], fold: f64) -> Vec<[f64; 3]> {
    let unit = |v: [f64; 3]| scaled(1.0 / dot(v, v).sqrt(), v);
    let corner = |k: usize| {
        let (first, at) = (k / N * N, k % N);
        let x = |a: usize| positions[connectivity[first + a % N] as usize];
        let (a, b) = (minus(x(at + 1), x(at)), minus(x(at + N - 1), x(at)));
        let across = cross(a, b);
        let size = dot(across, across).sqrt();
        // Weighted by the angle there.
        (scaled(1.0 / size, across), crate::angle::angle_of([dot(a, b), size]))
    };
    let (own, angles): (Vec<[f64; 3]>, Vec<f64>) = (0..connectivity.len()).map(corner).unzip();
    let mut at: Vec<(u32, usize)> = connectivity.iter().enumerate().map(|(k, &node)| (node, k)).collect();
    at.sort_unstable();
    let mut directions = own.clone();
    for around in at.chunk_by(|a, b| a.0 == b.0) {
        for &(_, k) in around {
            // A neighbour may be turned over.
            let signed = |other: usize| if dot(own[k], own[other]) < 0.0 { -1.0 } else { 1.0 };
            let smooth = around.iter().filter(|(_, other)| signed(*other) * dot(own[k], own[*other]) >= fold);
            directions[k] = unit(smooth.fold([0.0; 3], |sum, &(_, other)| plus(sum, scaled(signed(other) * angles[other], own[other]))));
        }
    }
    directions
}
