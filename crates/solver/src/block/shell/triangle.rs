//! `shell3`: a shell of three nodes in 3D.
//!
//! Natural coordinates are those of an equilateral triangle, g₁ = x₂ − x₁, g₂ = (2 x₃ − x₂ − x₁)/√3, likewise
//! for the directors, d₀ their mean: so renumbering changes nothing. Membrane and bending are constant;
//! frame, strain and stresses of the layers as in `surface.rs`.
//!
//! *Transverse shear* of MITC3 at the centre (Lee and Bathe 2004): with c_ij = (x_j − x_i)·½ (d_i + d_j)
//! along the sides, s₁ = (2 c₁₂ + c₁₃ − c₂₃)/3 and s₂ = (2 c₁₃ + c₁₂ + c₂₃)/3 along x₂ − x₁ and x₃ − x₁; its
//! stiffness times t²/(t² + 0.1 l²) with the longest side l (Lyly, Stenberg and Vihinen 1993), by the root of
//! it on the strain and on the stress. One motion of a lone triangle is not held (a twist in the plane); in a
//! mesh it is.
//!
//! Forces are the gradient of the energy by x_a, moments m_a = −d_a × ∂W/∂d_a. *Step*: as that of `shell4`
//! without stabilisation, with the mass in thirds at the corners.

use super::bound;
use super::surface::{
    self, BEGIN, COMMON, Frame, Kind, Measures, NOW, SHEAR, TURN, Vector, flux, loaded, moved, replace, replace_vectors, scaled,
    turn_at_start, vectors,
};
use super::{Answer, Corners, Facts, Layers, Pose, Pulls, ShellKernel, Start, Strains, Tensor};
use crate::tensor::{Dim, Matrix, Space, cross, dot};
use crate::vector::{minus, plus};
use embate_lanes::{Batch, Lane};

/// Weight of the longest side against the thickness.
const STABILIZING: f64 = 0.1;

/// Least inertia of a corner by its mass over the area: less would let the membrane rotate the nodes of thin
/// shells that are not normal to their directors faster than it moves them.
const INERTIA: f64 = 1.0 / 6.0;

/// See [`surface::arc`].
const ARC: f64 = 2.0;

/// Sum of the squares of the natural derivatives of the shape functions, 2, over the third of the mass at a
/// corner.
const SHARP: f64 = 6.0;

/// Places in the state, after what all shells in 3D have: directors of the corners at the start, root of the
/// factor of the shear, positions and directors now.
const DIRECTORS: usize = COMMON;
const FACTOR: usize = DIRECTORS + 9;
const FORM: usize = FACTOR + 1;
const STATE: usize = FORM + 18;

/// A triangle.
#[derive(Clone, Copy, Debug)]
pub(in crate::block) struct Triangle;

/// Positions (from the first) and directors of the corners.
#[derive(Clone, Copy)]
struct Form<L> {
    x: [Vector<L>; 3],
    d: [Vector<L>; 3],
}

/// Of both natural components of the shear what they feel of the positions, and of the directors.
type ShearRows<L> = [[[Vector<L>; 3]; 2]; 2];

/// Natural derivatives of a vector.
#[inline(always)]
fn natural<L: Lane>(v: &[Vector<L>; 3]) -> [Vector<L>; 2] {
    let root = L::splat(1.0 / 3.0f64.sqrt());
    [minus(v[1], v[0]), scaled(root, plus(minus(v[2], v[0]), minus(v[2], v[1])))]
}

/// The transpose of [`natural`]: what comes to a corner.
#[inline(always)]
fn spread<L: Lane>(v: &[Vector<L>; 2], corner: usize) -> Vector<L> {
    let root = L::splat(1.0 / 3.0f64.sqrt());
    match corner {
        0 => minus(scaled(L::splat(-1.0), v[0]), scaled(root, v[1])),
        1 => minus(v[0], scaled(root, v[1])),
        _ => scaled(root + root, v[1]),
    }
}

impl<L: Lane> Form<L> {
    #[inline(always)]
    fn mean(&self) -> Vector<L> {
        scaled(L::splat(1.0 / 3.0), plus(self.d[0], plus(self.d[1], self.d[2])))
    }

    #[inline(always)]
    fn frame(&self, turn: [L; 2]) -> Frame<L> {
        Frame::new(&natural(&self.x), self.mean(), turn)
    }

    /// Sides 12, 13 and 23, and their mean directors.
    #[inline(always)]
    fn sides(&self) -> [[Vector<L>; 2]; 3] {
        let half = L::splat(0.5);
        let (x, d) = (&self.x, &self.d);
        [
            [minus(x[1], x[0]), scaled(half, plus(d[0], d[1]))],
            [minus(x[2], x[0]), scaled(half, plus(d[0], d[2]))],
            [minus(x[2], x[1]), scaled(half, plus(d[1], d[2]))],
        ]
    }

    #[inline(always)]
    fn measures(&self, frame: &Frame<L>) -> Measures<L> {
        let [one, other, last] = self.sides();
        let (c12, c13, c23) = (dot(one[0], one[1]), dot(other[0], other[1]), dot(last[0], last[1]));
        let (third, two) = (L::splat(1.0 / 3.0), L::splat(2.0));
        let (s1, s2) = (third * (two * c12 + c13 - c23), third * (two * c13 + c12 + c23));
        let slide = [s1, L::splat(1.0 / 3.0f64.sqrt()) * (two * s2 - s1)];
        let [w, _] = surface::arc(frame.size, ARC);
        Measures { map: frame.matrix(&natural(&self.x)), bend: crate::tensor::scaled(frame.matrix(&natural(&self.d)), w), slide }
    }

    #[inline(always)]
    fn load(state: &[Batch], at: usize) -> Self {
        Self { x: vectors(state, FORM, at), d: vectors(state, FORM + 9, at) }
    }

    /// What the first, or the second, natural component of the shear feels of positions and directors.
    #[inline(always)]
    fn shear_rows(&self) -> ShearRows<L> {
        let (third, two) = (L::splat(1.0 / 3.0), L::splat(2.0));
        let root = L::splat(1.0 / 3.0f64.sqrt());
        let sides = self.sides();
        // Weights of c₁₂, c₁₃, c₂₃ in s₁, and in (2 s₂ − s₁)/√3.
        let first = [two * third, third, -third];
        let second = [L::splat(0.0), root, root];
        let mut rows = [[[[L::splat(0.0); 3]; 3]; 2]; 2];
        for (row, weights) in [first, second].into_iter().enumerate() {
            for (side, (i, j)) in [(0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
                let [along, director] = sides[side];
                let (x, d) = (scaled(weights[side], director), scaled(L::splat(0.5) * weights[side], along));
                rows[row][0][j] = plus(rows[row][0][j], x);
                rows[row][0][i] = minus(rows[row][0][i], x);
                rows[row][1][i] = plus(rows[row][1][i], d);
                rows[row][1][j] = plus(rows[row][1][j], d);
            }
        }
        rows
    }
}

impl Triangle {
    /// Area of the natural axes' triangle over that of their square.
    const AREA: f64 = 0.433_012_701_892_219_3;
}

impl ShellKernel<3> for Triangle {
    type Tensor = Tensor<3, f64>;
    const NODES: usize = 3;
    const STATE: usize = STATE;
    const POSE: Pose = Pose::Attitude;
    const ROTATES: bool = true;

    fn directions(connectivity: &[u32], positions: &[[f64; 3]], fold: f64) -> Vec<[f64; 3]> {
        surface::directions::<3>(connectivity, positions, fold)
    }

    fn start(facts: &Facts, positions: &[[f64; 3]], directions: &[[f64; 3]], thickness: f64) -> Start {
        let form = Form::<f64> { x: std::array::from_fn(|k| minus(positions[k], positions[0])), d: std::array::from_fn(|k| directions[k]) };
        let turn = turn_at_start(&natural(&form.x), form.mean());
        let measures = form.measures(&form.frame(turn));
        let square = |[side, _]: [[f64; 3]; 2]| dot(side, side);
        let longest = form.sides().map(square).into_iter().fold(0.0, f64::max);
        let factor = (SHEAR * thickness * thickness / (thickness * thickness + STABILIZING * longest)).sqrt();
        let of_layers = [measures.all(); 2].into_iter().flatten().chain(turn);
        let now = [form.x, form.d].into_iter().flatten().flatten();
        let state = of_layers.chain(form.d.into_iter().flatten()).chain([factor]).chain(now).collect();
        let area = Self::AREA * Dim::<2>::determinant(&measures.map);
        let volumes = surface::volumes(facts, Self::AREA, &measures, thickness);
        let volume = volumes.iter().sum();
        let reach = thickness * facts.reach();
        let inertia = bound::inertia(reach, area, INERTIA, |inertia| {
            bounds(&form, &form.shear_rows(), &measures.inverse(), reach, facts.moduli, factor, [inertia, volume])
        });
        Start { state, areas: vec![area / 3.0; 3], volumes, inertia }
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
        let [x, d] = moved::<L, 3>(corners, state, DIRECTORS, at);
        let form = Form { x: [minus(x[0], x[0]), minus(x[1], x[0]), minus(x[2], x[0])], d };
        let frame = form.frame(loaded(state, TURN, at));
        let (begin, before) = (Measures::<L>::load(state, BEGIN, at), Measures::<L>::load(state, NOW, at));
        replace_vectors(there, &form.x, state, FORM, at);
        replace_vectors(there, &form.d, state, FORM + 9, at);
        let now = form.measures(&frame);
        replace(there, &now.all(), state, NOW, at);
        let kind = Kind { area: Self::AREA, shear: L::load(&state[FACTOR], at) };
        surface::strain(facts, kind, [&begin, &before, &now], strains, at);
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
        let (begin, now) = (Measures::<L>::load(state, BEGIN, at), Measures::<L>::load(state, NOW, at));
        let factor = L::load(&state[FACTOR], at);
        let to = flux(facts, Kind { area: Self::AREA, shear: factor }, [&begin, &now], layers, layers.thickness_now(facts, at), at);
        let form = Form::<L>::load(state, at);
        let frame = form.frame(loaded(state, TURN, at));
        let (g, d) = (natural(&form.x), natural(&form.d));
        let n = &to.membrane;
        let f = [frame.vector([n[0][0], n[1][0]]), frame.vector([n[0][1], n[1][1]])];
        let (k, folded) = surface::bent(&frame, &d, &to.moment, ARC);
        let tilt = surface::tilt(&frame, &[[g[0], f[0]], [g[1], f[1]], [d[0], k[0]], [d[1], k[1]]]);
        let tilt = scaled(L::splat(1.0 / 3.0), minus(scaled(frame.shortening, tilt), scaled(folded, frame.axes[2])));
        let rows = form.shear_rows();
        let [q1, q2] = to.transverse;
        for corner in 0..3 {
            let force = plus(spread(&f, corner), plus(scaled(q1, rows[0][0][corner]), scaled(q2, rows[1][0][corner])));
            let couple = minus(plus(spread(&k, corner), plus(scaled(q1, rows[0][1][corner]), scaled(q2, rows[1][1][corner]))), tilt);
            let moment = cross(couple, form.d[corner]);
            pulls.put(corner, scaled(L::splat(-1.0), force), moment);
        }
        let inverse = now.inverse();
        let reach = L::splat(facts.reach()) * to.thickness;
        let bounds = facts.coupled(bounds(&form, &rows, &inverse, reach, to.moduli, factor, [inertia, to.volume]));
        surface::answer(&to, &frame, &g, &inverse, bounds, SHARP, inertia)
    }

    #[inline(always)]
    fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], stiffness: [L; 2], at: usize) -> [L; 6] {
        surface::elastic(facts, strain, stiffness, at)
    }

    fn turned(state: &[Batch], stress: [f64; 6], _: usize, lane: usize) -> [f64; 6] {
        let frame = Form::<f64>::load(state, lane).frame(loaded(state, TURN, lane));
        surface::turned(&frame.axes, stress)
    }
}

/// Product of two rows of [`Form::shear_rows`] in the norm of the mass.
#[inline(always)]
fn gram<L: Lane>(a: &[[Vector<L>; 3]; 2], b: &[[Vector<L>; 3]; 2], turning: L) -> L {
    let mut sum = L::splat(0.0);
    for corner in 0..3 {
        sum += dot(a[0][corner], b[0][corner]) + turning * dot(a[1][corner], b[1][corner]);
    }
    L::splat(3.0) * sum
}

/// m ω² of motion in the plane and across it, N/m, and the cosine between both.
#[inline(always)]
fn bounds<L: Lane>(
    form: &Form<L>,
    rows: &ShearRows<L>,
    inverse: &Matrix<L, 2>,
    thickness: L,
    [membrane, shear, transverse]: [L; 3],
    factor: L,
    [inertia, volume]: [L; 2],
) -> [L; 3] {
    let metric = bound::metric(inverse);
    let plane = L::splat(SHARP) * bound::membrane(&metric, [membrane, shear], volume);
    let bend = bound::folding(form.mean(), &natural(&form.d), ARC) * thickness * thickness / (L::splat(12.0) * inertia);
    let turning = L::splat(1.0) / inertia;
    let mixed = gram(&rows[0], &rows[1], turning);
    let across = factor
        * factor
        * transverse
        * volume
        * bound::largest(&metric, &[[gram(&rows[0], &rows[0], turning), mixed], [mixed, gram(&rows[1], &rows[1], turning)]]);
    let d = natural(&form.d);
    let cosine = L::splat(1.0).min(L::splat(2.0) * (dot(d[0], d[0]) + dot(d[1], d[1])).sqrt());
    [plane, plane * bend + across, cosine]
}
