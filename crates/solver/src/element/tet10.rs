//! Composite ten-node tetrahedra: twelve subtetrahedra, whose gradient is projected on the linear functions
//! and taken at four points; mean dilatation of the volume that the sixteen outer triangles enclose.
//!
//! ```text
//!             3
//!            /|\         λ_0 = 1 − ξ − η − ζ, λ_1 = ξ, λ_2 = η, λ_3 = ζ
//!           7 | 9        nodes in the middle of 01 12 20 03 13 23: 4 5 6 7 8 9
//!          /  8  \
//!         0---|6--2      subtetrahedra: four at the corners (V/8), and around an eleventh node, the mean of
//!          4  |  5       the six in the middle, four towards the corners and four towards the faces (V/16)
//!            \|/
//!             1
//! ```
//!
//! *Gradient.* That of the subtetrahedra is constant in each; its L² projection on the span of λ_0 … λ_3 is
//! at the point p (λ_p = (5 + 3√5)/20, the others (5 − √5)/20) Σ_s V_s (1 + √5 (4 λ_p(s) − 1)) ∇u|_s with the
//! places λ(s) of their centroids. With the sums S_a of the three middle nodes at a corner, and M of all six:
//!
//! ```text
//! z_a = a₀ u_a + b₀ S_a + g₀ u_ap   (a ≠ p)        a₀ = (2 − √5)/8     b₀ = (3 − √5)/4    g₀ = 3√5/4
//! z_p = a₁ u_p + b₁ S_p + c₁ (M − S_p)             a₁ = (2 + 3√5)/8    b₁ = (9 − √5)/12   c₁ = −√5/12
//! ∂u/∂ξ_k = z_k − z_0,  k = 1, 2, 3
//! ```
//!
//! Affine motions have their gradient in elements of any form. Constant stress in elements with straight
//! sides leaves inner nodes without force.
//!
//! *Volume* V = ⅙ Σ x_i · (x_j × x_k) over the triangles, which neighbours share; b_a = ∂V/∂x_a. Rate laws
//! see dev d_p + ⅓ θ̄ I with θ̄ = Σ b_a · Δu_a / V, hyperelastic ones F̄_p = (J̄/J_p)^⅓ F_p with J̄ = V/V⁰;
//! point p has the volume V det J_p / Σ det J.
//!
//! *Hold.* Four deviators and one mean leave three of 24 motions free (of a straight element 2 (b·x) x − |x|²
//! b). They meet U = ½ κ µ Σ V_p⁰ l_p², l_p = ln(J_p / J̄), whose barrier keeps points from turning inside
//! out: κ = 0.1 by default (`hourglass`), µ that at the start; of a fluid a tenth of M.
//!
//! *Masses.* Row sums of the subtetrahedra, the eleventh node's given to the middle nodes: m/32 at corners,
//! 7m/48 between them, of an element with straight sides.
//!
//! *Stable step.* Σ_p |∂u_p|² w_p of the four operators is at most (c/6) Σ η_a |u_a|² with the shares η of
//! mass and c = 10; so with Λ, T from the points as in [`super::stiffest`], β = Σ |b_a|² / (η_a V), and the
//! part r² of β by which θ̄ is no mean of the points,
//!
//! ```text
//! ω² m ≤ max(K − ⅔ µ (1 − r)², 0) β + (c/6) (2µ Λ + κµ T)
//! ```
//!
//! Proof: V K θ̄² + Σ V_p 2µ (|ε_p|² − ⅓ tr²) with Σ V_p tr² ≥ V θ̂² of their mean θ̂, and (θ̄ − θ̂)² ≤ r² β
//! Σ η
//! |u|² / V. It is 0.93 to 1.00 of the exact step of elements with straight sides, 0.65 to 1 of curved ones.
//!
//! Sources: Thoutireddy, Molinari, Repetto, Ortiz, Int. J. Numer. Meth. Engng 53 (2002) 1337-1351; Ostien,
//! Foulk, Mota, Veilleux, Int. J. Numer. Meth. Engng 107 (2016) 1145-1170.

use super::stiffest::{Metric, Thickness, largest};
use super::{Corners, Element, ElementKind, ElementOptions, Held, Map, Pulls};
use crate::mesh::cell::{CellKind, Facts};
use crate::stress_state::StressState;
use crate::tensor::{Dim, Matrix, Space};
use embate_lanes::{Batch, Lane, math};

const ROOT: f64 = 2.236_067_977_499_79; // √5
const A_0: f64 = (2.0 - ROOT) / 8.0;
const A_1: f64 = (2.0 + 3.0 * ROOT) / 8.0;
const B_0: f64 = (3.0 - ROOT) / 4.0;
const B_1: f64 = (9.0 - ROOT) / 12.0;
const C_1: f64 = -ROOT / 12.0;
const G_0: f64 = 3.0 * ROOT / 4.0;

const FAR: f64 = (5.0 - ROOT) / 20.0;
const NEAR: f64 = 1.0 - 3.0 * FAR;

const FACTS: &Facts = CellKind::Tetrahedron10.facts();
/// Corners at the ends of each edge with a node in its middle, from node 4 on.
const EDGES: [[usize; 2]; 6] = {
    let (mut all, mut edge) = ([[0; 2]; 6], 0);
    while edge < 6 {
        let [a, b] = FACTS.edges[edge];
        (all[edge], edge) = ([a as usize, b as usize], edge + 1);
    }
    all
};
/// The node between two corners; at the same corner what is not read.
const BETWEEN: [[usize; 4]; 4] = {
    let (mut all, mut edge) = ([[0; 4]; 4], 0);
    while edge < 6 {
        let [a, b] = EDGES[edge];
        (all[a][b], all[b][a]) = (4 + edge, 4 + edge);
        edge += 1;
    }
    all
};
/// Triangles of the outside, seen from there counter-clockwise: four on each face.
const TRIANGLES: [[usize; 3]; 16] = {
    let (mut all, mut at) = ([[0; 3]; 16], 0);
    while at < 16 {
        let [a, b, c, _] = FACTS.facets[at];
        (all[at], at) = ([a as usize, b as usize, c as usize], at + 1);
    }
    all
};

/// c/6: largest eigenvalue of Σ_p w_p of the operators' squares by the shares of mass.
const STIFFNESS: f64 = 10.0 / 6.0;

/// The hold where the model says nothing, κ.
const HOLD: f64 = 0.1;
/// What is kept of an element: its initial volume, its initial determinants, and κµ.
const KEPT: usize = 6;

/// Composite, with mean dilatation and a small hold of the volumes of its points.
#[derive(Clone, Copy, Debug)]
pub struct Tet10 {
    hold: f64,
}

impl Element<3, 10, 4> for Tet10 {
    const KIND: ElementKind = ElementKind {
        name: "tet10",
        doc: "ten-node tetrahedron made of twelve, four points, mean dilatation; no locking in plastic flow or rubber: the \
              right one for meshes of CAD parts (volume hold 0.1)",
        source: "Thoutireddy, Molinari, Repetto and Ortiz, Int. J. Numer. Meth. Engng 53 (2002) 1337-1351; Ostien, Foulk, Mota and \
                 Veilleux, Int. J. Numer. Meth. Engng 107 (2016) 1145-1170",
        cell: CellKind::Tetrahedron10,
        dimension: 3,
        extruded: None,
        is_default: true,
    };
    const POINTS: [[f64; 3]; 4] = [[FAR; 3], [NEAR, FAR, FAR], [FAR, NEAR, FAR], [FAR, FAR, NEAR]];
    const WEIGHTS: [f64; 4] = [1.0 / 24.0; 4];
    const NODES: [[f64; 3]; 10] = {
        let (mut all, mut at) = ([[0.0; 3]; 10], 0);
        while at < 10 {
            (all[at], at) = (FACTS.reference[at], at + 1);
        }
        all
    };
    const MASS_RATIOS: [f64; 10] = {
        let (corner, middle) = (32.0, 48.0 / 7.0);
        [corner, corner, corner, corner, middle, middle, middle, middle, middle, middle]
    };
    const MEAN_DILATATION: bool = true;
    const COMPOSITE: bool = true;
    const HOURGLASS: usize = KEPT;

    fn new(options: &ElementOptions) -> Self {
        Self { hold: options.hourglass.unwrap_or(HOLD) }
    }

    /// Of the quadratic element: for places of points, and for what is interpolated.
    fn shape([xi, eta, zeta]: [f64; 3]) -> [f64; 10] {
        let l = [1.0 - xi - eta - zeta, xi, eta, zeta];
        let mut out = [0.0; 10];
        for a in 0..4 {
            out[a] = l[a] * (2.0 * l[a] - 1.0);
        }
        for (middle, [a, b]) in out[4..].iter_mut().zip(EDGES) {
            *middle = 4.0 * l[a] * l[b];
        }
        out
    }

    #[inline(always)]
    fn gradients<L: Lane>(u: &[[L; 3]; 10]) -> [Matrix<L, 3>; 4] {
        let (a_0, a_1, b_0) = (L::splat(A_0), L::splat(A_1), L::splat(B_0));
        let (b_1, c_1, g_0) = (L::splat(B_1), L::splat(C_1), L::splat(G_0));
        let mut out = [[[L::splat(0.0); 3]; 3]; 4];
        for i in 0..3 {
            let [p, q, r, s, pq, qr, pr, ps, qs, rs] = *u;
            // Sums at the corners of the nodes in the middle of sides.
            let opposite = qr[i] + qs[i] + rs[i];
            let sums = [pq[i] + pr[i] + ps[i], pq[i] + qr[i] + qs[i], qr[i] + pr[i] + rs[i], ps[i] + qs[i] + rs[i]];
            let all = sums[0] + opposite;
            let corners = [p[i], q[i], r[i], s[i]];
            let mut apart = [L::splat(0.0); 4];
            for a in 0..4 {
                apart[a] = corners[a] * a_0 + sums[a] * b_0;
            }
            for p in 0..4 {
                let mut z = apart;
                for q in 0..4 {
                    if q != p {
                        z[q] += u[BETWEEN[p][q]][i] * g_0;
                    }
                }
                z[p] = corners[p] * a_1 + sums[p] * b_1 + (all - sums[p]) * c_1;
                out[p][i] = [z[1] - z[0], z[2] - z[0], z[3] - z[0]];
            }
        }
        out
    }

    #[inline(always)]
    fn divergence<L: Lane>(flux: &[Matrix<L, 3>; 4]) -> [[L; 3]; 10] {
        let (a_0, a_1, b_0) = (L::splat(A_0), L::splat(A_1), L::splat(B_0));
        let (b_1, c_1, g_0) = (L::splat(B_1), L::splat(C_1), L::splat(G_0));
        let zero = L::splat(0.0);
        let mut out = [[zero; 3]; 10];
        for i in 0..3 {
            // By point, what each z_a gets.
            let mut pulls = [[zero; 4]; 4];
            for p in 0..4 {
                let [a, b, c] = flux[p][i];
                pulls[p] = [-(a + b + c), a, b, c];
            }
            let mut apart = [L::splat(-0.0); 4];
            for a in 0..4 {
                for p in 0..4 {
                    if p != a {
                        apart[a] += pulls[p][a];
                    }
                }
                out[a][i] = pulls[a][a] * a_1 + apart[a] * a_0;
            }
            let all = pulls[0][0] + pulls[1][1] + pulls[2][2] + pulls[3][3];
            for side in 0..6 {
                let [a, b] = EDGES[side];
                let own = pulls[a][a] + pulls[b][b];
                out[4 + side][i] = own * b_1 + (all - own) * c_1 + (apart[a] + apart[b]) * b_0 + (pulls[a][b] + pulls[b][a]) * g_0;
            }
        }
        out
    }

    /// From triangles whose corners are taken relative to each other: exact for small elements far away.
    #[inline(always)]
    fn enclosed<L: Lane>(x: &[[L; 3]; 10], _: StressState) -> (L, [[L; 3]; 10]) {
        let (zero, sixth) = (L::splat(0.0), L::splat(1.0 / 6.0));
        let mut slope = [[zero; 3]; 10];
        for triangle in 0..16 {
            let [i, j, k] = TRIANGLES[triangle];
            let (mut u, mut v) = ([zero; 3], [zero; 3]);
            for d in 0..3 {
                u[d] = x[j][d] - x[i][d];
                v[d] = x[k][d] - x[i][d];
            }
            let area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            for d in 0..3 {
                slope[i][d] += area[d];
                slope[j][d] += area[d];
                slope[k][d] += area[d];
            }
        }
        // V is of third degree in the positions: Σ b_a · x_a = 3 V; and Σ b_a = 0.
        let mut volume = L::splat(-0.0);
        for d in 0..3 {
            for a in 0..10 {
                slope[a][d] = slope[a][d] * sixth;
                volume += slope[a][d] * (x[a][d] - x[0][d]);
            }
        }
        (volume * L::splat(1.0 / 3.0), slope)
    }

    #[inline(always)]
    fn thickness<L: Lane>(_: &[[L; 3]; 10], map: &Map<L, 3, 4>, volume: L, slope: &[[L; 3]; 10], _: StressState) -> Thickness<L> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let spectrum = spectrum(map);
        // What the points call the slope, of the same volume.
        let mut flux = [[[zero; 3]; 3]; 4];
        for p in 0..4 {
            flux[p] = flux_of(&map.adjugates[p], one);
        }
        let determinants = map.determinants;
        let sum = (determinants[0] + determinants[1]) + (determinants[2] + determinants[3]);
        let (scale, of_points) = (volume / sum, Self::divergence(&flux));
        // Of corners, and of nodes between them.
        let (mut squares, mut apart) = ([L::splat(-0.0); 2], [L::splat(-0.0); 2]);
        for a in 0..10 {
            let kind = if a < 4 { 0 } else { 1 };
            for d in 0..3 {
                let off = slope[a][d] - of_points[a][d] * scale;
                squares[kind] += slope[a][d] * slope[a][d];
                apart[kind] += off * off;
            }
        }
        let (corner, side) = (L::splat(Self::MASS_RATIOS[0]), L::splat(Self::MASS_RATIOS[4]));
        let mut dilating = squares[0] * corner + squares[1] * side;
        let apart = apart[0] * corner + apart[1] * side;
        let together = (one - (apart / dilating).sqrt()).max(zero);
        dilating = dilating / volume;
        // Points count with the volumes that add up to that of the element: Σ det / 24 is not quite it.
        let points = scale * L::splat(24.0 * STIFFNESS);
        let share = (one + one + together * together) * L::splat(1.0 / 3.0);
        let unknown = dilating.max(points * spectrum[0]);
        Thickness { numerator: volume * L::splat(4.0), unknown, known: [share, dilating, points * largest(spectrum)] }
    }

    fn corner_volumes(x: &[[f64; 3]; 10], _is_axisymmetric: bool) -> Option<[f64; 10]> {
        let middle: [f64; 3] = std::array::from_fn(|d| x[4..].iter().map(|x| x[d]).sum::<f64>() / 6.0);
        let mut out = [0.0; 10];
        // Quarters of the subtetrahedra on nodes `i j k`, and on a corner or the eleventh node.
        let mut add = |apex: [f64; 3], [i, j, k]: [usize; 3], corner: Option<usize>| {
            let edges: Matrix<f64, 3> = [i, j, k].map(|node| std::array::from_fn(|d| x[node][d] - apex[d]));
            let quarter = Dim::<3>::determinant(&edges) / 24.0;
            [i, j, k].into_iter().for_each(|node| out[node] += quarter);
            match corner {
                Some(corner) => out[corner] += quarter,
                None => out[4..].iter_mut().for_each(|share| *share += quarter / 6.0),
            }
        };
        for corner in 0..4 {
            // The other corners, right-handed seen from this one.
            let [a, b, c] = [[1, 2, 3], [2, 0, 3], [0, 1, 3], [2, 1, 0]][corner];
            let towards = [BETWEEN[corner][a], BETWEEN[corner][b], BETWEEN[corner][c]];
            add(x[corner], towards, Some(corner));
            add(middle, [towards[0], towards[2], towards[1]], None);
            add(middle, [BETWEEN[a][b], BETWEEN[b][c], BETWEEN[c][a]], None);
        }
        Some(out)
    }

    #[inline(always)]
    fn hourglass_forces<L: Lane>(&self, corners: &Corners<L, 3, 10>, map: &Map<L, 3, 4>, kept: &mut [Batch], at: usize) -> Held<L, 3, 10> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let determinants = map.determinants;
        if corners.is_start {
            let shear = L::select(zero.less(corners.shear), corners.shear, corners.modulus * L::splat(0.1));
            corners.volume.store(&mut kept[0], at);
            for p in 0..4 {
                determinants[p].store(&mut kept[1 + p], at);
            }
            (shear * L::splat(self.hold)).store(&mut kept[5], at);
        }
        let (volume_initial, stiffness) = (L::load(&kept[0], at), L::load(&kept[5], at));
        let (mut initial, mut sum, mut sum_initial) = ([zero; 4], L::splat(-0.0), L::splat(-0.0));
        for p in 0..4 {
            initial[p] = L::load(&kept[1 + p], at);
            sum += determinants[p];
            sum_initial += initial[p];
        }
        let (ratio, share) = (volume_initial / corners.volume, volume_initial / sum_initial);
        // Of the whole, per volume.
        let (mut mean, mut work, mut most) = (L::splat(-0.0), L::splat(-0.0), zero);
        let mut flux = [[[zero; 3]; 3]; 4];
        for p in 0..4 {
            let inverse = one / determinants[p];
            let stretch = determinants[p] / initial[p] * ratio;
            // Exactly one of an element that has kept its form.
            let l = math::ln(stretch);
            let own = stiffness * initial[p] * share;
            let pull = own * l;
            mean += pull;
            work += pull * l * L::splat(0.5);
            most = most.max(own * inverse * (one + l.abs() + l.abs()));
            flux[p] = flux_of(&map.adjugates[p], pull * inverse);
        }
        let mut forces = Self::divergence(&flux);
        let mean = mean / corners.volume;
        for a in 0..10 {
            for d in 0..3 {
                forces[a][d] = forces[a][d] - corners.slope[a][d] * mean;
            }
        }
        // κµ V_p⁰ / V_p beside M of what dilates.
        let modulus = most * (sum / corners.volume);
        let stiffening = one + modulus / corners.modulus * (corners.dilating_squared[1] / corners.characteristic_length_squared[1]);
        Held { forces, flux: [[zero; 3]; 3], pulls: Pulls::none(), work, stiffening }
    }
}

/// The flux at a point of a pressure of minus `weight`: the adjugate, transposed.
#[inline(always)]
fn flux_of<L: Lane>(adjugate: &Matrix<L, 3>, weight: L) -> Matrix<L, 3> {
    let mut flux = *adjugate;
    for i in 0..3 {
        for k in 0..3 {
            flux[i][k] = adjugate[k][i] * weight;
        }
    }
    flux
}

/// Largest trace and spread of the points' S, see [`super::stiffest`].
#[inline(always)]
fn spectrum<L: Lane>(map: &Map<L, 3, 4>) -> [L; 2] {
    let (mut trace, mut spread) = (L::splat(0.0), L::splat(0.0));
    for p in 0..4 {
        let inverse = L::splat(1.0) / map.determinants[p];
        let [a, b, c] = map.adjugates[p];
        let last = [a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]];
        let own = Metric::of(a).and(b).and(c).and(last).spectrum();
        trace = trace.max(own[0] * inverse);
        spread = spread.max(own[1] * (inverse * inverse));
    }
    [trace, spread]
}
