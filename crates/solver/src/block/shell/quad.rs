//! `shell4`: a shell of four nodes in 3D with one point in the plane.
//!
//! Positions x_a and directors d_a = R_a D_a of the corners are all it knows of its nodes. With the patterns
//! ξ = (−1, 1, 1, −1), η = (−1, −1, 1, 1), h = ξ η: g₁ = ¼ Σ ξ_a x_a, g₂ = ¼ Σ η_a x_a, q = ¼ Σ h_a x_a, d₀ =
//! ¼ Σ d_a, d₁, d₂ and r likewise; frame, strain and stresses of the layers as in `surface.rs`.
//!
//! *Transverse shear* of MITC4 (Dvorkin and Bathe 1984) in scalar products: s₁ = g₁·d₀ + q·d₂, s₂ = g₂·d₀ +
//! q·d₁ at the centre, and their linear variation a₁ = g₁·d₂ + q·d₀, a₂ = g₂·d₁ + q·d₀.
//!
//! *Stabilisation*, elastic with the stiffness at rest, a potential of the start (index 0): with q₀ = p₁ g₁ +
//! p₂ g₂ in the plane, γ = h − p₁ ξ − p₂ η, H_ij = (A/3) Σ_α (G₀⁻¹)_αi (G₀⁻¹)_αj, and amplitudes m_i = ê_i·(q
//! − p₁ g₁ − p₂ g₂), b_i = ê_i·(r − p₁ d₁ − p₂ d₂) less what they were and what has flowed:
//!
//! ```text
//! W = ½ t E mᵀ K m + ½ (t³/12) E bᵀ K b + ½ k µ t (A/3) Σ_α g^αα (a_α − a_α,0)²
//! K = [H_xx, −ν H_xy; −ν H_xy, H_yy],   g^αα = Σ_i (G₀⁻¹)_αi²
//! ```
//!
//! with H, m and b along the natural axes of the element (K has this form in no others), of layers along ê₁
//! and ê₂; that is the assumed strain of Belytschko and Bindeman (1991) in plane stress for the membrane and
//! for bending, and what MITC4 has beside its mean. Where the layers flow, m and b flow as well: what leads
//! beyond 0.4 of their stress (the quadratic mean over the element) is no longer held, by the part that flow
//! took of the layers' last work (its mean for m, by the square of the height for b). Less would let patterns
//! of hourglass grow in hinges, an elastic stabilisation makes these too stiff. What is held and what has
//! flowed is the energy of hourglass control; the third term, a part of MITC4, is stored.
//!
//! Forces are the gradient of the energy by x_a, moments m_a = −d_a × ∂W/∂d_a: momentum and angular momentum
//! are kept to round-off, a rigid motion of any size is no strain, renumbering changes nothing. Nothing holds
//! the spin about d_a, and nothing drives it.
//!
//! *Step*, with the mass m in quarters at the corners, the volume V, C = E/(1 − ν²), s = 2 µ/C, trace T and
//! larger eigenvalue Λ of the metric g^αβ, and λ for the largest eigenvalue of a matrix:
//!
//! ```text
//! in the plane  a = C V (max(1 − s, 0) T + s Λ) + (1 + p₁² + p₂²) λ(t E K)
//! across        p = max(k µ V λ(g S), bending) + λ(k µ t (A/3) g^αα A),   bending a t²/(12 α)
//! ```
//!
//! S and A are the Gram matrices of s and of a in the norm of the mass. Both together as in
//! [`bound::joined`]; α is chosen such that a decides at the start.

use super::bound;
use super::surface::{
    self, BEGIN, COMMON, Flux, Frame, Kind, Measures, NOW, SHEAR, TURN, Vector, both, flux, loaded, replace, replace_vectors, scaled,
    times, turn_at_start, vectors,
};
use super::{Answer, Corners, Facts, Layers, Pose, Pulls, ShellKernel, Start, Strains, Tensor, rate};
use crate::block::SHELL_VALUES;
use crate::material::Family;
use crate::tensor::{Dim, Matrix, Space, cross, dot};
use crate::vector::{minus, plus};
use embate_lanes::{Batch, Lane};

/// Patterns of the corners.
pub(super) const XI: [f64; 4] = [-1.0, 1.0, 1.0, -1.0];
pub(super) const ETA: [f64; 4] = [-1.0, -1.0, 1.0, 1.0];

/// Stress that the stabilisation may have where the layers flow, in the quadratic mean over the element, over
/// theirs.
const STRENGTH: f64 = 0.4;
/// See [`surface::arc`].
pub(super) const ARC: f64 = 3.0;

/// Places in the state, after what all shells in 3D have: p and a at the start, and (1 + p₁² + p₂²) λ(t E K);
/// amplitudes m and b now, what of them has flowed, and the work of that, J; ê₁ and ê₂ now.
const SKEW: usize = COMMON;
const SHEARED: usize = SKEW + 2;
const WARPING: usize = SHEARED + 2;
const AMPLITUDES: usize = WARPING + 1;
const FLOWN: usize = AMPLITUDES + 4;
const LOST: usize = FLOWN + 4;
const AXES: usize = LOST + 1;
const STATE: usize = AXES + 6;

/// Places of what passes from strain to forces: g₁ g₂ q d₀ d₁ d₂ r, n̂ and both natural axes, 1/trace, |d₀|,
/// 1/|d₀|, and the arc of [`surface::arc`].
const FORM: usize = 0;
const FRAME: usize = FORM + 21;
const SIZES: usize = FRAME + 9;
const PASSED: usize = SIZES + 5;

/// A quadrilateral.
#[derive(Clone, Copy, Debug)]
pub(in crate::block) struct Quad;

/// g₁, g₂, q and d₀, d₁, d₂, r.
#[derive(Clone, Copy)]
pub(super) struct Form<L> {
    pub(super) g: [Vector<L>; 2],
    pub(super) q: Vector<L>,
    pub(super) mean: Vector<L>,
    pub(super) d: [Vector<L>; 2],
    pub(super) r: Vector<L>,
}

/// ¼ Σ over the corners, plain and with each pattern: the mean, by ξ, by η, by h.
#[inline(always)]
fn parts<L: Lane>(v: &[Vector<L>; 4]) -> [Vector<L>; 4] {
    let quarter = L::splat(0.25);
    let mut out = [[L::splat(0.0); 3]; 4];
    for k in 0..3 {
        let (near, far) = (v[0][k] + v[1][k], v[3][k] + v[2][k]);
        let (near_step, far_step) = (v[1][k] - v[0][k], v[2][k] - v[3][k]);
        out[0][k] = quarter * (near + far);
        out[1][k] = quarter * (near_step + far_step);
        out[2][k] = quarter * (far - near);
        out[3][k] = quarter * (far_step - near_step);
    }
    out
}

impl<L: Lane> Form<L> {
    #[inline(always)]
    pub(super) fn new(x: &[Vector<L>; 4], d: &[Vector<L>; 4]) -> Self {
        let ([_, g1, g2, q], [mean, d1, d2, r]) = (parts(x), parts(d));
        Self { g: [g1, g2], q, mean, d: [d1, d2], r }
    }

    #[inline(always)]
    pub(super) fn load(from: &[Batch], first: usize, at: usize) -> Self {
        let [g1, g2, q, mean, d1, d2, r] = vectors(from, first, at);
        Self { g: [g1, g2], q, mean, d: [d1, d2], r }
    }

    #[inline(always)]
    pub(super) fn all(&self) -> [Vector<L>; 7] {
        [self.g[0], self.g[1], self.q, self.mean, self.d[0], self.d[1], self.r]
    }

    #[inline(always)]
    fn frame(&self, turn: [L; 2]) -> Frame<L> {
        Frame::new(&self.g, self.mean, turn)
    }

    #[inline(always)]
    fn measures(&self, frame: &Frame<L>, w: L) -> Measures<L> {
        let slide = self.slide();
        Measures { map: frame.matrix(&self.g), bend: crate::tensor::scaled(frame.matrix(&self.d), w), slide }
    }

    /// s₁ and s₂.
    #[inline(always)]
    pub(super) fn slide(&self) -> [L; 2] {
        [dot(self.g[0], self.mean) + dot(self.q, self.d[1]), dot(self.g[1], self.mean) + dot(self.q, self.d[0])]
    }

    /// a₁ and a₂.
    #[inline(always)]
    pub(super) fn sheared(&self) -> [L; 2] {
        let both = dot(self.q, self.mean);
        [dot(self.g[0], self.d[1]) + both, dot(self.g[1], self.d[0]) + both]
    }

    /// q − p₁ g₁ − p₂ g₂ and r − p₁ d₁ − p₂ d₂.
    #[inline(always)]
    fn warped(&self, [p1, p2]: [L; 2]) -> [Vector<L>; 2] {
        let warp = minus(minus(self.q, scaled(p1, self.g[0])), scaled(p2, self.g[1]));
        [warp, minus(minus(self.r, scaled(p1, self.d[0])), scaled(p2, self.d[1]))]
    }
}

impl Form<f64> {
    /// Areas of the corners: integrals of their shape functions over the element as d₀ sees it.
    pub(super) fn areas(&self) -> Vec<f64> {
        let normal = scaled(1.0 / dot(self.mean, self.mean).sqrt(), self.mean);
        let [g1, g2] = self.g;
        let area = dot(normal, cross(g1, g2));
        let (along, across) = (dot(normal, cross(g1, self.q)), dot(normal, cross(self.q, g2)));
        (0..4).map(|k| area + (XI[k] * along + ETA[k] * across) / 3.0).collect()
    }
}

/// Stiffnesses of the stabilisation.
#[derive(Clone, Copy)]
struct Held<L> {
    /// t E K and (t³/12) E K, N/m and N m.
    membrane: Matrix<L, 2>,
    bending: Matrix<L, 2>,
    /// k µ t (A/3) g^αα.
    shear: [L; 2],
}

impl<L: Lane> Held<L> {
    #[inline(always)]
    fn new(facts: &Facts, begin: &Measures<L>, turn: [L; 2], thickness: L) -> Self {
        let crate::block::shell::Held { young, side, poisson, bending: bent, shear, shear_side } = facts.held;
        let third = L::splat(4.0 / 3.0) * Dim::<2>::determinant(&begin.map);
        // Layers have their own axes; else those of the element, to which alone this form of K belongs.
        let [cos, sin] = if facts.is_layered { [L::splat(1.0), L::splat(0.0)] } else { turn };
        let [one, two] = begin.inverse();
        let g = [[cos * one[0] - sin * one[1], sin * one[0] + cos * one[1]], [cos * two[0] - sin * two[1], sin * two[0] + cos * two[1]]];
        let stiff = L::splat(young) * thickness * third;
        let mixed = -(L::splat(poisson) * stiff * (g[0][0] * g[0][1] + g[1][0] * g[1][1]));
        let along = stiff * (g[0][0] * g[0][0] + g[1][0] * g[1][0]);
        let other = stiff * (g[0][1] * g[0][1] + g[1][1] * g[1][1]) * L::splat(side);
        // As ê₁ and ê₂ see it.
        let (square, both, rest) = (cos * cos, cos * sin, sin * sin);
        let off = both * (other - along) + (square - rest) * mixed;
        let twice = L::splat(2.0) * both * mixed;
        let membrane = [[square * along + twice + rest * other, off], [off, rest * along - twice + square * other]];
        let shear = L::splat(SHEAR * shear) * thickness * third;
        let [[a, b], [_, d]] = crate::tensor::scaled(membrane, thickness * thickness * L::splat(1.0 / 12.0));
        let bending = [[a * L::splat(bent[0]), b * L::splat(bent[1])], [b * L::splat(bent[1]), d * L::splat(bent[2])]];
        // Written out: a closure over lanes is not compiled for them.
        let shear_side = L::splat(shear_side);
        let shear =
            [shear * (g[0][0] * g[0][0] + g[0][1] * g[0][1] * shear_side), shear * (g[1][0] * g[1][0] + g[1][1] * g[1][1] * shear_side)];
        Self { membrane, bending, shear }
    }
}

impl Quad {
    const AREA: f64 = 4.0;

    #[inline(always)]
    fn kind<L: Lane>() -> Kind<L> {
        Kind { area: Self::AREA, shear: L::splat(SHEAR.sqrt()) }
    }

    /// Goes to the `new` amplitudes, and lets what is held of them flow as far as the layers have done:
    /// `part` of what leads beyond the energy `most` (J). What is held, and the work of the flow.
    #[inline(always)]
    fn flow<L: Lane>(
        state: &mut [Batch],
        stiffness: &Matrix<L, 2>,
        which: usize,
        new: [L; 2],
        [part, most]: [L; 2],
        there: L::Mask,
        at: usize,
    ) -> ([L; 2], L) {
        let (half, zero, one) = (L::splat(0.5), L::splat(0.0), L::splat(1.0));
        let old = loaded::<L, 2>(state, AMPLITUDES + 2 * which, at);
        let gone = loaded::<L, 2>(state, FLOWN + 2 * which, at);
        let mut held = minus(new, gone);
        replace(there, &new, state, AMPLITUDES + 2 * which, at);
        let force = times(stiffness, held);
        let twice = both(force, held);
        let energy = half * twice;
        let leads = most.less(energy);
        if !L::any(leads) {
            return (held, zero);
        }
        let before = both(times(stiffness, minus(old, gone)), held);
        let flows = L::select(leads, part * (one - (most / energy).sqrt()), zero);
        for k in 0..2 {
            let new = L::select(leads, gone[k] + flows * held[k], gone[k]);
            L::select(there, new, gone[k]).store(&mut state[FLOWN + 2 * which + k], at);
            held[k] = L::select(leads, held[k] - flows * held[k], held[k]);
        }
        // The mean of the forces before and after does the work.
        (held, L::select(there, half * flows * (before + (one - flows) * twice), zero))
    }
}

impl ShellKernel<3> for Quad {
    type Tensor = Tensor<3, f64>;
    const NODES: usize = 4;
    const STATE: usize = STATE;
    const PASSED: usize = PASSED;
    const POSE: Pose = Pose::Director;
    const ROTATES: bool = true;

    fn directions(connectivity: &[u32], positions: &[[f64; 3]], fold: f64) -> Vec<[f64; 3]> {
        surface::directions::<4>(connectivity, positions, fold)
    }

    fn start(facts: &Facts, positions: &[[f64; 3]], directions: &[[f64; 3]], thickness: f64) -> Start {
        let x: [[f64; 3]; 4] = std::array::from_fn(|k| positions[k]);
        let d: [[f64; 3]; 4] = std::array::from_fn(|k| directions[k]);
        let form = Form::<f64>::new(&x, &d);
        let turn = turn_at_start(&form.g, form.mean);
        let frame = form.frame(turn);
        let arc = surface::arc(frame.size, ARC);
        let measures = form.measures(&frame, arc[0]);
        let skew = times(&measures.inverse(), frame.seen(form.q));
        let [warp, twist] = form.warped(skew);
        let bent = frame.seen(twist);
        let above = facts.section.middle * thickness;
        let flat = if above == 0.0 { [0.0; 2] } else { frame.seen(plus(warp, scaled(above, twist))) };
        let of_layers = [measures.all(); 2].into_iter().flatten().chain(turn);
        let (inverse, held) = (measures.inverse(), Held::new(facts, &measures, turn, thickness));
        let warping = bound::steepest(&held.membrane) * (1.0 + skew[0] * skew[0] + skew[1] * skew[1]);
        let stabilised = skew.into_iter().chain(form.sheared()).chain([warping]);
        // Amplitudes, what has flowed of them, and the work of that: bent as it is, it holds nothing.
        let amplitudes = [flat, bent, flat, bent].into_iter().flatten().chain([0.0]);
        let axes = [frame.axes[0], frame.axes[1]].into_iter().flatten();
        let state = of_layers.chain(stabilised).chain(amplitudes).chain(axes).collect();
        let area = Dim::<2>::determinant(&measures.map);
        let volumes = surface::volumes(facts, Self::AREA, &measures, thickness);
        let volume = volumes.iter().sum();
        let reach = thickness * facts.reach();
        let inertia = bound::inertia(reach, Self::AREA * area, 0.0, |inertia| {
            bounds(&form, &inverse, &held, warping, arc, [reach; 2], facts.moduli, [inertia, volume])
        });
        Start { state, areas: form.areas(), volumes, inertia }
    }

    #[inline(always)]
    fn strain<L: Lane>(
        facts: &Facts,
        corners: &Corners<'_, 3>,
        state: &mut [Batch],
        passed: &mut [Batch],
        strains: &mut Strains<'_>,
        at: usize,
    ) {
        let (mut x, mut d) = ([[L::splat(0.0); 3]; 4], [[L::splat(0.0); 3]; 4]);
        for a in 0..4 {
            let (own, [u, v, w, _]) = corners.of(a, at);
            (x[a], d[a]) = (own, [u, v, w]);
        }
        let there = L::splat(0.5).less(L::load(strains.live, at));
        let form = Form::new(&x, &d);
        let frame = form.frame(loaded(state, TURN, at));
        let arc = surface::arc(frame.size, ARC);
        let (begin, before) = (Measures::<L>::load(state, BEGIN, at), Measures::<L>::load(state, NOW, at));
        let now = form.measures(&frame, arc[0]);
        replace(there, &now.all(), state, NOW, at);
        replace_vectors(there, &[frame.axes[0], frame.axes[1]], state, AXES, at);
        pass(&form, &frame, arc, passed, at);
        if matches!(facts.family, Family::Rate) {
            rate::strain(facts, Self::kind(), [&begin, &before, &now], strains, at);
        } else {
            surface::strain(facts, Self::kind(), [&begin, &before, &now], strains, at);
        }
    }

    #[inline(always)]
    fn forces<L: Lane>(
        facts: &Facts,
        state: &mut [Batch],
        passed: &[Batch],
        layers: &Layers<'_>,
        inertia: L,
        pulls: &mut Pulls<'_, L, 3>,
        at: usize,
    ) -> Answer<L> {
        let half = L::splat(0.5);
        let (begin, now) = (Measures::<L>::load(state, BEGIN, at), Measures::<L>::load(state, NOW, at));
        let to = flux(facts, Self::kind(), [&begin, &now], layers, layers.thickness_now(facts, at), at);
        let form = Form::<L>::load(passed, FORM, at);
        let (frame, over_trace, arc) = passed_frame::<L>(state, passed, at);
        let skew = loaded::<L, 2>(state, SKEW, at);
        let initial = L::load(layers.thickness, at);
        let held = Held::new(facts, &begin, loaded(state, TURN, at), initial);
        let [warp, twist] = form.warped(skew);
        let (seen, bent) = (frame.seen(warp), frame.seen(twist));
        // The amplitude of the middle, which may be beside the nodes.
        let above = L::splat(facts.section.middle) * initial;
        let new = if facts.section.middle == 0.0 { seen } else { [seen[0] + above * bent[0], seen[1] + above * bent[1]] };
        let [mean, bending, stress] = loaded::<L, 3>(layers.flow, 0, at);
        let volume = initial * L::splat(Self::AREA) * Dim::<2>::determinant(&begin.map);
        let most = L::splat(STRENGTH * STRENGTH / (2.0 * facts.held.young)) * stress * stress * volume;
        let (m, lost) = Self::flow(state, &held.membrane, 0, new, [mean, most], pulls.there, at);
        let (b, lost_in_bending) = Self::flow(state, &held.bending, 1, bent, [bending, most], pulls.there, at);
        let lost = L::load(&state[LOST], at) + (lost + lost_in_bending);
        lost.store(&mut state[LOST], at);
        let (w, u) = (times(&held.membrane, m), times(&held.bending, b));
        // What the amplitude of the middle has of b.
        let on_bent = if facts.section.middle == 0.0 { u } else { [u[0] + above * w[0], u[1] + above * w[1]] };
        let (sheared, start) = (form.sheared(), loaded::<L, 2>(state, SHEARED, at));
        let change = minus(sheared, start);
        let a = [held.shear[0] * change[0], held.shear[1] * change[1]];
        let hourglass = half * (both(w, m) + both(u, b)) + lost;
        // The turn of the frame in its plane, which the stabilisation alone feels.
        let turn = (w[0] * seen[1] - w[1] * seen[0] + on_bent[0] * bent[1] - on_bent[1] * bent[0]) * over_trace;
        pull(&form, &frame, &to, [skew, arc], [warp, twist], [w, on_bent, a], turn, pulls);
        let inverse = now.inverse();
        let reach = L::splat(facts.reach());
        let (thick, warping) = ([reach * initial, reach * to.thickness], L::load(&state[WARPING], at));
        let bounds = facts.coupled(bounds(&form, &inverse, &held, warping, arc, thick, to.moduli, [inertia, to.volume]));
        let answer = surface::answer(&to, &frame, &form.g, &inverse, bounds, 1.0, inertia);
        Answer { hourglass, besides: [half * both(a, change), L::splat(0.0)], ..answer }
    }

    fn resultants(facts: &Facts, state: &[Batch], layers: &Layers<'_>, lane: usize) -> [f64; SHELL_VALUES] {
        let (begin, now) = (Measures::<f64>::load(state, BEGIN, lane), Measures::<f64>::load(state, NOW, lane));
        flux(facts, Self::kind(), [&begin, &now], layers, layers.thickness_now(facts, lane), lane).resultants
    }

    #[inline(always)]
    fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], stiffness: [L; 2], at: usize) -> [L; 6] {
        surface::elastic(facts, strain, stiffness, at)
    }

    fn turned(state: &[Batch], stress: [f64; 6], _: usize, lane: usize) -> [f64; 6] {
        let [first, second] = vectors(state, AXES, lane);
        surface::turned(&[first, second, cross(first, second)], stress)
    }
}

/// Passes on what forces need of the kinematics.
#[inline(always)]
fn pass<L: Lane>(form: &Form<L>, frame: &Frame<L>, [w, slope]: [L; 2], passed: &mut [Batch], at: usize) {
    let vectors = form.all();
    for k in 0..7 {
        for d in 0..3 {
            vectors[k][d].store(&mut passed[FORM + 3 * k + d], at);
        }
    }
    let vectors = [frame.axes[2], frame.natural[0], frame.natural[1]];
    for k in 0..3 {
        for d in 0..3 {
            vectors[k][d].store(&mut passed[FRAME + 3 * k + d], at);
        }
    }
    let sizes = [L::splat(1.0) / frame.trace, frame.size, frame.shortening, w, slope];
    for k in 0..5 {
        sizes[k].store(&mut passed[SIZES + k], at);
    }
}

/// The frame, 1/trace of it, and the arc, as passed on; the trace is none.
#[inline(always)]
fn passed_frame<L: Lane>(state: &[Batch], passed: &[Batch], at: usize) -> (Frame<L>, L, [L; 2]) {
    let ([first, second], [normal, along, beside]) = (vectors(state, AXES, at), vectors(passed, FRAME, at));
    let [over_trace, size, shortening, w, slope] = loaded(passed, SIZES, at);
    let frame = Frame { axes: [first, second, normal], natural: [along, beside], trace: L::splat(0.0), size, shortening };
    (frame, over_trace, [w, slope])
}

/// The transpose of [`parts`] without its quarter: the mean, and what goes with each pattern, at the corners.
#[inline(always)]
fn spread<L: Lane>(sign: L, [mean, xi, eta, h]: [Vector<L>; 4]) -> [Vector<L>; 4] {
    let mut out = [mean; 4];
    for d in 0..3 {
        let (plus, minus) = (mean[d] + h[d], mean[d] - h[d]);
        let (along, across) = (xi[d] + eta[d], xi[d] - eta[d]);
        out[0][d] = sign * (plus - along);
        out[1][d] = sign * (minus + across);
        out[2][d] = sign * (plus + along);
        out[3][d] = sign * (minus - across);
    }
    out
}

/// a + b + c.
#[inline(always)]
fn join<L: Lane>(a: Vector<L>, b: Vector<L>, c: Vector<L>) -> Vector<L> {
    plus(a, plus(b, c))
}

/// v·v.
#[inline(always)]
fn square<L: Lane>(v: Vector<L>) -> L {
    dot(v, v)
}

/// Forces and moments of what pulls on G, D, s (`to`), on q − p₁ g₁ − p₂ g₂ and r − p₁ d₁ − p₂ d₂, on a, and
/// on the natural axes by their `turn`: the transpose of all of the kinematics.
#[inline(always)]
fn pull<L: Lane>(
    form: &Form<L>,
    frame: &Frame<L>,
    to: &Flux<L>,
    [skew, arc]: [[L; 2]; 2],
    [warp, twist]: [Vector<L>; 2],
    [w, u, a]: [[L; 2]; 3],
    turn: L,
    pulls: &mut Pulls<'_, L, 3>,
) {
    let f1 = plus(frame.vector([to.membrane[0][0], to.membrane[1][0]]), scaled(turn, frame.natural[1]));
    let f2 = minus(frame.vector([to.membrane[0][1], to.membrane[1][1]]), scaled(turn, frame.natural[0]));
    let ([k1, k2], folded) = surface::bent_by(frame, &form.d, &to.moment, arc);
    let (v, bend) = (frame.vector(w), frame.vector(u));
    let pulled = [[form.g[0], f1], [form.g[1], f2], [form.d[0], k1], [form.d[1], k2], [warp, v], [twist, bend]];
    let tilt = surface::tilt(frame, &pulled);
    let [q1, q2] = to.transverse;
    let sum = a[0] + a[1];
    let on_g1 = join(f1, scaled(q1, form.mean), scaled(a[0], form.d[1]));
    let on_g2 = join(f2, scaled(q2, form.mean), scaled(a[1], form.d[0]));
    let on_q = join(scaled(q1, form.d[1]), scaled(q2, form.d[0]), scaled(sum, form.mean));
    let on_d1 = join(k1, scaled(q2, form.q), scaled(a[1], form.g[1]));
    let on_d2 = join(k2, scaled(q1, form.q), scaled(a[0], form.g[0]));
    let on_mean = join(scaled(q1, form.g[0]), scaled(q2, form.g[1]), scaled(sum, form.q));
    let on_mean = plus(on_mean, minus(scaled(folded, frame.axes[2]), scaled(frame.shortening, tilt)));
    // By the patterns; γ = h − p₁ ξ − p₂ η.
    let quarter = L::splat(0.25);
    let x_xi = scaled(quarter, minus(on_g1, scaled(skew[0], v)));
    let x_eta = scaled(quarter, minus(on_g2, scaled(skew[1], v)));
    let x_h = scaled(quarter, plus(on_q, v));
    let d_xi = scaled(quarter, minus(on_d1, scaled(skew[0], bend)));
    let d_eta = scaled(quarter, minus(on_d2, scaled(skew[1], bend)));
    let (d_h, d_mean) = (scaled(quarter, bend), scaled(quarter, on_mean));
    put(form, &[x_xi, x_eta, x_h, d_mean, d_xi, d_eta, d_h], pulls);
}

/// Forces and moments of what is on a quarter of Σ x_a by each pattern, of Σ d_a, and of Σ d_a by each
/// pattern.
#[inline(always)]
pub(super) fn put<L: Lane>(form: &Form<L>, on: &[Vector<L>; 7], pulls: &mut Pulls<'_, L, 3>) {
    let [x_xi, x_eta, x_h, d_mean, d_xi, d_eta, d_h] = *on;
    let forces = spread(L::splat(-1.0), [[L::splat(0.0); 3], x_xi, x_eta, x_h]);
    let couples = spread(L::splat(1.0), [d_mean, d_xi, d_eta, d_h]);
    let directors = spread(L::splat(1.0), [form.mean, form.d[0], form.d[1], form.r]);
    for corner in 0..4 {
        pulls.put(corner, forces[corner], cross(couples[corner], directors[corner]));
    }
}
/// m ω² of motion in the plane and across it, N/m, and the cosine between both: see the head of the file.
#[inline(always)]
fn bounds<L: Lane>(
    form: &Form<L>,
    inverse: &Matrix<L, 2>,
    held: &Held<L>,
    warping: L,
    [w, slope]: [L; 2],
    [initial, thickness]: [L; 2],
    [membrane, shear, transverse]: [L; 3],
    [inertia, volume]: [L; 2],
) -> [L; 3] {
    let (zero, one, two) = (L::splat(0.0), L::splat(1.0), L::splat(2.0));
    let metric = bound::metric(inverse);
    let along = bound::membrane(&metric, [membrane, shear], volume);
    let turning = one / inertia;
    let flat = L::splat(1.0 / 12.0) * turning;
    // Most of a change of the directors, as in `bound::folding`.
    let apart = (square(form.d[0]) + square(form.d[1])).sqrt();
    let most = w + slope.abs() * apart;
    let bend = most * most * thickness * thickness * flat;
    let bend_held = initial * initial * flat;
    // Gram matrices of s and of a in the norm of the mass.
    let q = square(form.q);
    let (d0, d1, d2) = (square(form.mean), square(form.d[0]), square(form.d[1]));
    let (g1, g2) = (square(form.g[0]), square(form.g[1]));
    let mixed = dot(form.d[0], form.d[1]) + turning * dot(form.g[0], form.g[1]);
    let slid = [[d0 + d2 + turning * (g1 + q), mixed], [mixed, d0 + d1 + turning * (g2 + q)]];
    let mixed = d0 + turning * q;
    let varied = [[slid[0][0], mixed], [mixed, slid[1][1]]];
    let across = L::splat(SHEAR) * transverse * volume * bound::largest(&metric, &slid);
    let across_held = bound::largest(&[[held.shear[0], zero], [zero, held.shear[1]]], &varied);
    let plane = along + warping;
    let plate = across.max(along * bend + warping * bend_held) + across_held;
    [plane, plate, one.min(two * apart)]
}
