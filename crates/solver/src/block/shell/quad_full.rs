//! `shell4_full`: the shell of four nodes with 2 × 2 points in the plane and without stabilisation; the
//! control of `shell4`.
//!
//! With the vectors g₁ g₂ q d₀ d₁ d₂ r of `quad.rs`, at the point (ξ, η) = (±1, ±1)/√3:
//!
//! ```text
//! ∂x/∂ξ = g₁ + η q,  ∂x/∂η = g₂ + ξ q,   ∂d/∂ξ = d₁ + η r,  ∂d/∂η = d₂ + ξ r,   d = d₀ + ξ d₁ + η d₂ + ξ η r
//! s₁(η) = s₁ + η a₁,  s₂(ξ) = s₂ + ξ a₂   (MITC4)
//! ```
//!
//! and from these frame, strain and stresses of the layers of that point as in `surface.rs`; w of the arcs
//! between directors is that of the centre. The membrane is that of plain bilinear displacements: it is stiff
//! where an element bends in its plane.
//!
//! *Step*: m ω² is at most the sum of those of the points. At one of them, patterns ξ, η and h of the corners
//! change ∂x/∂ξ and ∂x/∂η by 1, 0, η and 0, 1, ξ, whose Gram matrix is Γ = [4/3, ±1/3; ±1/3, 4/3]: so the
//! bounds of `quad.rs` hold there with √Γ G⁻¹ in the place of G⁻¹, in the plane and for bending; those of the
//! transverse shear have the Gram matrix of the s above. Bending and shear are added.

use super::bound;
use super::quad::{ARC, ETA, Form, XI, put};
use super::surface::{self, Frame, Kind, Measures, SHEAR, Vector, flux, loaded, moved, replace, replace_vectors, scaled, turn_at_start};
use super::{Answer, Corners, Facts, Layers, Pose, Pulls, ShellKernel, Start, Strains, Tensor};
use crate::block::SHELL_VALUES;
use crate::tensor::{Dim, Matrix, Space, dot};
use crate::vector::{minus, plus};
use embate_lanes::{Batch, Lane};

/// Places in the state: of each point what is measured at the start and now, and the turn of its axes; then
/// directors of the corners at the start, and g₁ g₂ q d₀ d₁ d₂ r now.
const EACH: usize = 2 * Measures::<f64>::WIDTH + 2;
const DIRECTORS: usize = Full::POINTS * EACH;
const FORM: usize = DIRECTORS + 12;
const STATE: usize = FORM + 21;

/// Natural coordinate of the points.
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// A quadrilateral with 2 × 2 points.
#[derive(Clone, Copy, Debug)]
pub(in crate::block) struct Full;

/// The element at one of its points.
#[derive(Clone, Copy)]
struct Point<L> {
    xi: L,
    eta: L,
    g: [Vector<L>; 2],
    d: [Vector<L>; 2],
    director: Vector<L>,
    slide: [L; 2],
}

impl<L: Lane> Point<L> {
    #[inline(always)]
    fn new(form: &Form<L>, number: usize) -> Self {
        let (xi, eta) = (L::splat(GAUSS * XI[number]), L::splat(GAUSS * ETA[number]));
        let beside = plus(scaled(xi, form.d[0]), plus(scaled(eta, form.d[1]), scaled(xi * eta, form.r)));
        let [a1, a2] = form.sheared();
        let [s1, s2] = form.slide();
        Self {
            xi,
            eta,
            g: [plus(form.g[0], scaled(eta, form.q)), plus(form.g[1], scaled(xi, form.q))],
            d: [plus(form.d[0], scaled(eta, form.r)), plus(form.d[1], scaled(xi, form.r))],
            director: plus(form.mean, beside),
            slide: [s1 + eta * a1, s2 + xi * a2],
        }
    }

    #[inline(always)]
    fn frame(&self, turn: [L; 2]) -> Frame<L> {
        Frame::new(&self.g, self.director, turn)
    }

    #[inline(always)]
    fn measures(&self, frame: &Frame<L>, w: L) -> Measures<L> {
        Measures { map: frame.matrix(&self.g), bend: crate::tensor::scaled(frame.matrix(&self.d), w), slide: self.slide }
    }

    /// √Γ G⁻¹.
    #[inline(always)]
    fn sharpened(&self, inverse: &Matrix<L, 2>) -> Matrix<L, 2> {
        let half = L::splat(0.5);
        // Eigenvalues of Γ: 5/3 and 1.
        let (root, one) = (L::splat(5.0 / 3.0).sqrt(), L::splat(1.0));
        let (own, mixed) = (half * (root + one), half * (root - one) * L::splat(3.0) * self.xi * self.eta);
        let [a, b] = *inverse;
        [[own * a[0] + mixed * b[0], own * a[1] + mixed * b[1]], [mixed * a[0] + own * b[0], mixed * a[1] + own * b[1]]]
    }

    /// m ω² in the plane and across it, N/m.
    #[inline(always)]
    fn bounds(&self, form: &Form<L>, inverse: &Matrix<L, 2>, thickness: L, moduli: [L; 3], [inertia, volume]: [L; 2]) -> [L; 2] {
        let Self { xi, eta, .. } = *self;
        let along = bound::membrane(&bound::metric(&self.sharpened(inverse)), [moduli[0], moduli[1]], volume);
        let bend = bound::folding(form.mean, &self.d, ARC) * thickness * thickness / (L::splat(12.0) * inertia);
        let turning = L::splat(1.0) / inertia;
        // What g₁ and q, and d₀ and d₂, change of s₁(η); g₂ and q, d₀ and d₁ of s₂(ξ).
        let (d1, d2) = (plus(form.mean, scaled(eta, form.d[1])), plus(form.d[1], scaled(eta, form.mean)));
        let (e1, e2) = (plus(form.mean, scaled(xi, form.d[0])), plus(form.d[0], scaled(xi, form.mean)));
        let (x1, x2) = (plus(form.g[0], scaled(eta, form.q)), plus(form.q, scaled(eta, form.g[0])));
        let (y1, y2) = (plus(form.g[1], scaled(xi, form.q)), plus(form.q, scaled(xi, form.g[1])));
        let mixed = dot(d2, e2) + turning * dot(x1, y1);
        let slid = [[squares(d1, d2) + turning * squares(x1, x2), mixed], [mixed, squares(e1, e2) + turning * squares(y1, y2)]];
        let across = L::splat(SHEAR) * moduli[2] * volume * bound::largest(&bound::metric(inverse), &slid);
        [along, along * bend + across]
    }
}

/// a·a + b·b.
#[inline(always)]
fn squares<L: Lane>(a: Vector<L>, b: Vector<L>) -> L {
    dot(a, a) + dot(b, b)
}

/// The cosine of [`bound::joined`].
#[inline(always)]
fn cosine<L: Lane>(form: &Form<L>) -> L {
    let most = dot(form.d[0], form.d[0]) + dot(form.d[1], form.d[1]) + dot(form.r, form.r);
    L::splat(1.0).min(L::splat(2.0) * most.sqrt())
}

impl Full {
    const POINTS: usize = 4;

    /// A point stands for a unit of the natural axes.
    #[inline(always)]
    fn kind<L: Lane>() -> Kind<L> {
        Kind { area: 1.0, shear: L::splat(SHEAR.sqrt()) }
    }
}

impl ShellKernel<3> for Full {
    type Tensor = Tensor<3, f64>;
    const NODES: usize = 4;
    const STATE: usize = STATE;
    const POSE: Pose = Pose::Attitude;
    const ROTATES: bool = true;
    const PLANES: usize = Self::POINTS;

    fn directions(connectivity: &[u32], positions: &[[f64; 3]], fold: f64) -> Vec<[f64; 3]> {
        surface::directions::<4>(connectivity, positions, fold)
    }

    fn start(facts: &Facts, positions: &[[f64; 3]], directions: &[[f64; 3]], thickness: f64) -> Start {
        let x: [[f64; 3]; 4] = std::array::from_fn(|k| positions[k]);
        let d: [[f64; 3]; 4] = std::array::from_fn(|k| directions[k]);
        let form = Form::<f64>::new(&x, &d);
        let [w, _] = surface::arc(dot(form.mean, form.mean).sqrt(), ARC);
        let points: [Point<f64>; 4] = std::array::from_fn(|k| Point::new(&form, k));
        let turns = points.map(|point| turn_at_start(&point.g, point.director));
        let measures: [Measures<f64>; 4] = std::array::from_fn(|k| points[k].measures(&points[k].frame(turns[k]), w));
        let of_points = measures.iter().zip(turns).flat_map(|(own, turn)| [own.all(); 2].into_iter().flatten().chain(turn));
        let state = of_points.chain(d.into_iter().flatten()).chain(form.all().into_iter().flatten()).collect();
        let volumes: Vec<f64> = measures.iter().flat_map(|own| surface::volumes(facts, 1.0, own, thickness)).collect();
        let area = measures.iter().map(|own| Dim::<2>::determinant(&own.map)).sum();
        let reach = thickness * facts.reach();
        let inertia = bound::inertia(reach, area, 0.0, |inertia| {
            let mut sum = [0.0, 0.0, cosine(&form)];
            for (k, point) in points.iter().enumerate() {
                let volume = volumes.iter().skip(k * facts.section.count()).take(facts.section.count()).sum();
                let own = point.bounds(&form, &measures[k].inverse(), reach, facts.moduli, [inertia, volume]);
                (sum[0], sum[1]) = (sum[0] + own[0], sum[1] + own[1]);
            }
            sum
        });
        Start { state, areas: form.areas(), volumes, inertia }
    }

    #[inline(always)]
    fn strain<L: Lane>(
        facts: &Facts,
        corners: &Corners<'_, 3>,
        state: &mut [Batch],
        _: &mut [Batch],
        strains: &mut Strains<'_>,
        at: usize,
    ) {
        let there = L::splat(0.5).less(L::load(strains.live, at));
        let [x, d] = moved::<L, 4>(corners, state, DIRECTORS, at);
        let form = Form::new(&x, &d);
        replace_vectors(there, &form.all(), state, FORM, at);
        let [w, _] = surface::arc(dot(form.mean, form.mean).sqrt(), ARC);
        for k in 0..Self::POINTS {
            let point = Point::new(&form, k);
            let own = &mut state[k * EACH..][..EACH];
            let frame = point.frame(loaded(own, surface::TURN, at));
            let (begin, before) = (Measures::<L>::load(own, surface::BEGIN, at), Measures::<L>::load(own, surface::NOW, at));
            let now = point.measures(&frame, w);
            replace(there, &now.all(), own, surface::NOW, at);
            surface::strain(facts, Self::kind(), [&begin, &before, &now], &mut strains.plane(facts, k), at);
        }
    }

    #[inline(always)]
    fn forces<L: Lane>(
        facts: &Facts,
        state: &mut [Batch],
        _: &[Batch],
        layers: &Layers<'_>,
        inertia: L,
        pulls: &mut Pulls<'_, L, 3>,
        at: usize,
    ) -> Answer<L> {
        let (zero, quarter) = (L::splat(0.0), L::splat(0.25));
        let form = Form::<L>::load(state, FORM, at);
        let size = dot(form.mean, form.mean).sqrt();
        let arc = surface::arc(size, ARC);
        let mut thickness = zero;
        for k in 0..Self::POINTS {
            thickness += quarter * layers.plane(facts, k).thickness_now::<L>(facts, at);
        }
        // On g₁ g₂ q d₀ d₁ d₂ r.
        let mut on = [[zero; 3]; 7];
        let (mut sum, reach) = ([zero, zero, cosine(&form)], L::splat(facts.reach()) * thickness);
        let (mut tilted, mut taut, mut folded, mut determinant) = (zero, zero, zero, L::splat(f64::INFINITY));
        let mut resultants = [zero; SHELL_VALUES];
        for k in 0..Self::POINTS {
            let own = &state[k * EACH..][..EACH];
            let (begin, now) = (Measures::<L>::load(own, surface::BEGIN, at), Measures::<L>::load(own, surface::NOW, at));
            let to = flux(facts, Self::kind(), [&begin, &now], &layers.plane(facts, k), thickness, at);
            let point = Point::new(&form, k);
            let frame = point.frame(loaded(own, surface::TURN, at));
            folded += pull(&form, &point, &frame, &to, arc, &mut on);
            let inverse = now.inverse();
            let [plane, plate] = point.bounds(&form, &inverse, reach, to.moduli, [inertia, to.volume]);
            (sum[0], sum[1]) = (sum[0] + plane, sum[1] + plate);
            let sharp = point.sharpened(&inverse);
            tilted += bound::tilted(&frame, &point.g, &sharp, to.moduli[0] * to.volume, inertia);
            taut += bound::taut(to.strained, bound::steepest(&bound::metric(&sharp)), inertia);
            determinant = determinant.min(to.determinant);
            for (sum, own) in resultants.iter_mut().zip(to.resultants) {
                *sum += quarter * own;
            }
        }
        on[3] = plus(on[3], scaled(folded / size, form.mean));
        for own in &mut on {
            *own = scaled(quarter, *own);
        }
        put(&form, &on, pulls);
        Answer {
            stiffness: bound::joined(facts.coupled(sum), tilted) + taut,
            determinant,
            thickness,
            hourglass: zero,
            besides: [zero; 2],
            flow: [zero; 3],
            resultants,
        }
    }

    #[inline(always)]
    fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], stiffness: [L; 2], at: usize) -> [L; 6] {
        surface::elastic(facts, strain, stiffness, at)
    }

    fn turned(state: &[Batch], stress: [f64; 6], point: usize, lane: usize) -> [f64; 6] {
        let form = Form::<f64>::load(state, FORM, lane);
        let turn = loaded(&state[point * EACH..][..EACH], surface::TURN, lane);
        surface::turned(&Point::new(&form, point).frame(turn).axes, stress)
    }
}

/// Adds what the stresses at a point pull with on g₁ g₂ q d₀ d₁ d₂ r; the derivative of the energy by |d₀|,
/// on which the arcs depend.
#[inline(always)]
fn pull<L: Lane>(form: &Form<L>, point: &Point<L>, frame: &Frame<L>, to: &surface::Flux<L>, arc: [L; 2], on: &mut [Vector<L>; 7]) -> L {
    let Point { xi, eta, g, d, .. } = point;
    let (xi, eta) = (*xi, *eta);
    let n = &to.membrane;
    let f = [frame.vector([n[0][0], n[1][0]]), frame.vector([n[0][1], n[1][1]])];
    let (k, folded) = surface::bent_by(frame, d, &to.moment, arc);
    let tilt = surface::tilt(frame, &[[g[0], f[0]], [g[1], f[1]], [d[0], k[0]], [d[1], k[1]]]);
    let tilt = scaled(frame.shortening, tilt);
    let [q1, q2] = to.transverse;
    let (a, b) = (plus(form.mean, scaled(eta, form.d[1])), plus(form.mean, scaled(xi, form.d[0])));
    let (c, e) = (plus(form.d[1], scaled(eta, form.mean)), plus(form.d[0], scaled(xi, form.mean)));
    let (u, v) = (plus(form.q, scaled(eta, form.g[0])), plus(form.q, scaled(xi, form.g[1])));
    let more = [
        plus(f[0], scaled(q1, a)),
        plus(f[1], scaled(q2, b)),
        plus(plus(scaled(eta, f[0]), scaled(xi, f[1])), plus(scaled(q1, c), scaled(q2, e))),
        minus(plus(scaled(q1, g[0]), scaled(q2, g[1])), tilt),
        minus(plus(k[0], scaled(q2, v)), scaled(xi, tilt)),
        minus(plus(k[1], scaled(q1, u)), scaled(eta, tilt)),
        minus(plus(scaled(eta, k[0]), scaled(xi, k[1])), scaled(xi * eta, tilt)),
    ];
    for (sum, more) in on.iter_mut().zip(more) {
        *sum = plus(*sum, more);
    }
    folded
}
