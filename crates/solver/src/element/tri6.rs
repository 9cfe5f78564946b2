//! Composite six-node triangles: four subtriangles, whose gradient is projected on the linear functions and
//! taken at three points; mean dilatation of the volume that the six outer segments enclose.
//!
//! ```text
//!   2
//!   | \          λ_0 = 1 − ξ − η, λ_1 = ξ, λ_2 = η
//!   5 - 4        nodes in the middle of 01 12 20: 3 4 5
//!   | \ | \      subtriangles: one at each corner, one between the middles (A/4 each)
//!   0 - 3 - 1
//! ```
//!
//! *Gradient.* The L² projection of that of the subtriangles at the point p (λ_p = ⅔, the others ⅙) is ¾ of
//! that at the corner p and ¼ of that between the middles. Affine motions have their gradient in elements of
//! any form. Constant stress in elements with straight sides leaves inner nodes without force.
//!
//! *Volume* V of the polygon, or of its revolution ∮ π x² dy, which neighbours share; b_a = ∂V/∂x_a. Mean
//! dilatation, hyperelastic laws and volumes of points are as in [`super::tet10`]. In plane stress there is
//! none of it: the three points hold all nine motions.
//!
//! *Axisymmetric bodies.* Point p stands for the subtriangle at its corner and a third of that between:
//! x̄_p = Σ N_a x_a with ¼ of its corner, ⅓ of the middles beside it, 1/12 of the other one. 2π Σ x̄_p A_p is
//! exact with straight sides (Pappus); hoop strain Σ N_a u_a / x̄_p. The gradient is the mean over the same
//! two volumes, with the portion w = ¾ x̄_corner / x̄_p of the first in the place of ¾: so uniform stress is
//! in equilibrium on straight sides. Hyperelastic laws keep the portions of the start, the hold has ¾.
//!
//! *Hold* of the volumes of points as in [`super::tet10`]: in plane strain three deviators and one mean leave
//! two of nine motions free.
//!
//! *Masses.* Row sums of the subtriangles: m/12 at corners, m/4 between them, of an element with straight
//! sides; of axisymmetric bodies ∫ 2πx N_a dA of each subtriangle.
//!
//! *Stable step.* As in [`super::tet10`] with c = 8; a hoop strain adds Σ_p V_p (N·u)² / x̄_p² ≤ H Σ η_a
//! u_a², H = max_a Σ_p V_p N_pa / (x̄_p² η_a), since N is a mean:
//!
//! ```text
//! ω² m ≤ max(K − ⅔ µ (1 − r)², 0) β + (c/2) 2µ Λ + 2µ H + κµ (√(T c/2) + √H)²
//! ```
//!
//! with Λ, T the largest of 2 V_p / det J_p times those of point p. Portions other than ¾ take these times
//! max(1, 16 w²/9), and c times 1 + 0.9 max |w − ¾|, found by search over w = 0.3 ... 1. The step is 0.92 to
//! 1 of the exact one of equilateral and right-angled elements in the plane; of 30,000 random ones, curved
//! and on the axis too, none was above it.
//!
//! Sources: those of [`super::tet10`].

use super::stiffest::Thickness;
use super::tri3::corner_volumes;
use super::{Corners, Element, ElementKind, ElementOptions, Held, Map, Pulls, map_of};
use crate::mesh::cell::{CellKind, Facts};
use crate::stress_state::StressState;
use crate::tensor::Matrix;
use embate_lanes::{Batch, Lane, math};
use std::f64::consts::PI;

const FACTS: &Facts = CellKind::Triangle6.facts();
/// Nodes around the outside.
const AROUND: [usize; 6] = [0, 3, 1, 4, 2, 5];
const SUBTRIANGLES: [[usize; 3]; 4] = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]];
/// N of each point.
const SHARES: [[f64; 6]; 3] = {
    let (own, beside, far) = (0.25, 1.0 / 3.0, 1.0 / 12.0);
    [[own, 0.0, 0.0, beside, far, beside], [0.0, own, 0.0, beside, beside, far], [0.0, 0.0, own, far, beside, beside]]
};
/// c/2: largest eigenvalue of Σ_p w_p of the operators' squares by the shares of mass.
const STIFFNESS: f64 = 4.0;
/// The hold where the model says nothing, κ.
const HOLD: f64 = 0.1;
/// What is kept of an element: its initial volume, its initial determinants (times radii), and κµ.
const KEPT: usize = 5;

/// Composite, with mean dilatation and a small hold of the volumes of its points.
#[derive(Clone, Copy, Debug)]
pub struct Tri6 {
    hold: f64,
}

impl Element<2, 6, 3> for Tri6 {
    const KIND: ElementKind = ElementKind {
        name: "tri6",
        doc: "six-node triangle made of four, three points, mean dilatation; no locking in plastic flow or rubber: the right one \
              for meshes of triangles (volume hold 0.1)",
        source: "Thoutireddy, Molinari, Repetto and Ortiz, Int. J. Numer. Meth. Engng 53 (2002) 1337-1351; Ostien, Foulk, Mota and \
                 Veilleux, Int. J. Numer. Meth. Engng 107 (2016) 1145-1170",
        cell: CellKind::Triangle6,
        dimension: 2,
        extruded: None,
        is_default: true,
    };
    const POINTS: [[f64; 2]; 3] = [[1.0 / 6.0; 2], [2.0 / 3.0, 1.0 / 6.0], [1.0 / 6.0, 2.0 / 3.0]];
    const WEIGHTS: [f64; 3] = [1.0 / 6.0; 3];
    const NODES: [[f64; 2]; 6] = {
        let (mut all, mut at) = ([[0.0; 2]; 6], 0);
        while at < 6 {
            (all[at], at) = ([FACTS.reference[at][0], FACTS.reference[at][1]], at + 1);
        }
        all
    };
    const MASS_RATIOS: [f64; 6] = [12.0, 12.0, 12.0, 4.0, 4.0, 4.0];
    const MEAN_DILATATION: bool = true;
    const COMPOSITE: bool = true;
    const HOURGLASS: usize = KEPT;

    fn new(options: &ElementOptions) -> Self {
        Self { hold: options.hourglass.unwrap_or(HOLD) }
    }

    /// Of the quadratic element: for what is interpolated.
    fn shape([xi, eta]: [f64; 2]) -> [f64; 6] {
        let [p, q, r] = [1.0 - xi - eta, xi, eta];
        [p * (2.0 * p - 1.0), q * (2.0 * q - 1.0), r * (2.0 * r - 1.0), 4.0 * p * q, 4.0 * q * r, 4.0 * r * p]
    }

    #[inline(always)]
    fn shares(point: usize) -> [f64; 6] {
        SHARES[point]
    }

    #[inline(always)]
    fn gradients<L: Lane>(u: &[[L; 2]; 6]) -> [Matrix<L, 2>; 3] {
        let (half, most, two) = (L::splat(0.5), L::splat(1.5), L::splat(2.0));
        let mut out = [[[L::splat(0.0); 2]; 2]; 3];
        let [p, q, r, pq, qr, rp] = u;
        for i in 0..2 {
            let between = [qr[i] - rp[i], qr[i] - pq[i]];
            let own = [between[0] * half, between[1] * half];
            out[0][i] = [(pq[i] - p[i]) * most + own[0], (rp[i] - p[i]) * most + own[1]];
            out[1][i] = [(q[i] - pq[i]) * most + own[0], between[1] * two];
            out[2][i] = [between[0] * two, (r[i] - rp[i]) * most + own[1]];
        }
        out
    }

    #[inline(always)]
    fn divergence<L: Lane>(flux: &[Matrix<L, 2>; 3]) -> [[L; 2]; 6] {
        let (half, most, two) = (L::splat(0.5), L::splat(1.5), L::splat(2.0));
        let mut out = [[L::splat(0.0); 2]; 6];
        for i in 0..2 {
            let [[a, b], [c, d], [e, f]] = [flux[0][i], flux[1][i], flux[2][i]];
            let between = [(a + c) * half + e * two, (b + f) * half + d * two];
            out[0][i] = -((a + b) * most);
            out[1][i] = c * most;
            out[2][i] = f * most;
            out[3][i] = (a - c) * most - between[1];
            out[4][i] = between[0] + between[1];
            out[5][i] = (b - f) * most - between[0];
        }
        out
    }

    #[inline(always)]
    fn portions<L: Lane>(x: &[[L; 2]; 6]) -> [L; 3] {
        let mut out = [L::splat(0.0); 3];
        let between = x[3][0] + x[4][0] + x[5][0];
        for p in 0..3 {
            let [a, b, c] = SUBTRIANGLES[p];
            let own = (x[a][0] + x[b][0] + x[c][0]) * L::splat(3.0);
            out[p] = own / (own + between);
        }
        out
    }

    #[inline(always)]
    fn gradients_around<L: Lane>(u: &[[L; 2]; 6], portions: &[L; 3]) -> [Matrix<L, 2>; 3] {
        let (one, two) = (L::splat(1.0), L::splat(2.0));
        let mut out = [[[L::splat(0.0); 2]; 2]; 3];
        let ([p, q, r, pq, qr, rp], [k, l, m]) = (u, *portions);
        for i in 0..2 {
            let between = [qr[i] - rp[i], qr[i] - pq[i]];
            out[0][i] = [((pq[i] - p[i]) * k + between[0] * (one - k)) * two, ((rp[i] - p[i]) * k + between[1] * (one - k)) * two];
            out[1][i] = [((q[i] - pq[i]) * l + between[0] * (one - l)) * two, between[1] * two];
            out[2][i] = [between[0] * two, ((r[i] - rp[i]) * m + between[1] * (one - m)) * two];
        }
        out
    }

    #[inline(always)]
    fn divergence_around<L: Lane>(flux: &[Matrix<L, 2>; 3], portions: &[L; 3]) -> [[L; 2]; 6] {
        let (one, two) = (L::splat(1.0), L::splat(2.0));
        let mut out = [[L::splat(0.0); 2]; 6];
        let [k, l, m] = *portions;
        for i in 0..2 {
            let [[a, b], [c, d], [e, f]] = [flux[0][i], flux[1][i], flux[2][i]];
            let between = [(a * (one - k) + c * (one - l) + e) * two, (b * (one - k) + d + f * (one - m)) * two];
            let [a, b, c, f] = [a * k * two, b * k * two, c * l * two, f * m * two];
            out[0][i] = -(a + b);
            out[1][i] = c;
            out[2][i] = f;
            out[3][i] = a - c - between[1];
            out[4][i] = between[0] + between[1];
            out[5][i] = b - f - between[0];
        }
        out
    }

    /// From differences of positions: exact for small elements far away.
    #[inline(always)]
    fn enclosed<L: Lane>(x: &[[L; 2]; 6], state: StressState) -> (L, [[L; 2]; 6]) {
        let (half, third, two) = (L::splat(0.5), L::splat(PI / 3.0), L::splat(2.0));
        let mut slope = [[L::splat(0.0); 2]; 6];
        // V is linear in the heights, and Σ b_a = 0 of them.
        let mut volume = L::splat(-0.0);
        for k in 0..6 {
            let (before, a, after) = (x[AROUND[(k + 5) % 6]], x[AROUND[k]], x[AROUND[(k + 1) % 6]]);
            let own = if state.is_axisymmetric {
                let (up, down) = (after[1] - a[1], a[1] - before[1]);
                [
                    ((a[0] * two + after[0]) * up + (a[0] * two + before[0]) * down) * third,
                    (before[0] - after[0]) * (before[0] + a[0] + after[0]) * third,
                ]
            } else {
                [(after[1] - before[1]) * half, (before[0] - after[0]) * half]
            };
            volume += own[1] * (a[1] - x[0][1]);
            slope[AROUND[k]] = own;
        }
        (volume, slope)
    }

    #[inline(always)]
    fn thickness<L: Lane>(x: &[[L; 2]; 6], map: &Map<L, 2, 3>, volume: L, slope: &[[L; 2]; 6], state: StressState) -> Thickness<L> {
        let (zero, one, four) = (L::splat(0.0), L::splat(1.0), L::splat(4.0));
        let (radii, sizes) = sizes(x, map, state);
        let share = volume / (sizes[0] + sizes[1] + sizes[2]);
        // Volume of a point over its determinant.
        let mut weights = [share; 3];
        let portions = Self::portions(x);
        let (mut trace, mut largest, mut apart) = (zero, zero, zero);
        for p in 0..3 {
            weights[p] = if state.is_axisymmetric { radii[p] * share } else { share };
            let own = spectrum(&map.adjugates[p]);
            let mut scale = weights[p] / map.determinants[p];
            if state.is_axisymmetric {
                let portion = portions[p] * L::splat(4.0 / 3.0);
                scale = scale * (portion * portion).max(one);
                apart = apart.max((portion - one).abs());
            }
            trace = trace.max(own[0] * scale);
            largest = largest.max(own[1] * scale);
        }
        // The weight of a point is ⅙ in the plane.
        let points = (one + apart * L::splat(0.9 * 0.75)) * L::splat(6.0 * STIFFNESS);
        let (trace, largest) = (trace * points, largest * points);
        let numerator = volume * four;
        if state.is_plane_stress {
            return Thickness { numerator, unknown: trace, known: [one, trace, largest] };
        }
        let (mut hoop, mut together) = (zero, trace);
        let mut flux = [[[zero; 2]; 2]; 3];
        for p in 0..3 {
            flux[p] = flux_of(&map.adjugates[p], weights[p]);
        }
        // What the points call the slope, of the same volume.
        let mut of_points = if state.is_axisymmetric { Self::divergence_around(&flux, &portions) } else { Self::divergence(&flux) };
        if state.is_axisymmetric {
            let mut pulls = [zero; 3];
            let mut squares = [zero; 3];
            for p in 0..3 {
                pulls[p] = sizes[p] * share / radii[p];
                squares[p] = pulls[p] / radii[p];
            }
            add_radial(&mut of_points, &pulls);
            let mut own = [[zero; 2]; 6];
            add_radial(&mut own, &squares);
            for a in 0..6 {
                hoop = hoop.max(own[a][0] * L::splat(Self::MASS_RATIOS[a]));
            }
            let root = trace.sqrt() + hoop.sqrt();
            together = root * root;
        }
        let (mut dilating, mut apart) = (L::splat(-0.0), L::splat(-0.0));
        for a in 0..6 {
            let ratio = L::splat(Self::MASS_RATIOS[a]);
            for d in 0..2 {
                let off = slope[a][d] - of_points[a][d];
                dilating += slope[a][d] * slope[a][d] * ratio;
                apart += off * off * ratio;
            }
        }
        let rest = (one - (apart / dilating).sqrt()).max(zero);
        dilating = dilating / volume;
        let share = (one + one + rest * rest) * L::splat(1.0 / 3.0);
        Thickness { numerator, unknown: dilating.max(together), known: [share, dilating, largest + hoop] }
    }

    fn corner_volumes(x: &[[f64; 2]; 6], is_axisymmetric: bool) -> Option<[f64; 6]> {
        let mut out = [0.0; 6];
        for nodes in SUBTRIANGLES {
            let own = corner_volumes(&nodes.map(|node| x[node]), is_axisymmetric);
            nodes.into_iter().zip(own).for_each(|(node, share)| out[node] += share);
        }
        Some(out)
    }

    #[inline(always)]
    fn hourglass_forces<L: Lane>(&self, corners: &Corners<L, 2, 6>, map: &Map<L, 2, 3>, kept: &mut [Batch], at: usize) -> Held<L, 2, 6> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut held = Held { forces: [[zero; 2]; 6], flux: [[zero; 2]; 2], pulls: Pulls::none(), work: zero, stiffening: one };
        if corners.state.is_plane_stress {
            return held;
        }
        // Exactly what the volumes of points change by: of an axisymmetric body the map has other portions.
        let own = if corners.state.is_axisymmetric { map_of::<Self, L, 2, 6, 3>(&corners.x) } else { *map };
        let map = &own;
        let (radii, sizes) = sizes(&corners.x, map, corners.state);
        if corners.is_start {
            let shear = L::select(zero.less(corners.shear), corners.shear, corners.modulus * L::splat(0.1));
            corners.volume.store(&mut kept[0], at);
            for p in 0..3 {
                sizes[p].store(&mut kept[1 + p], at);
            }
            (shear * L::splat(self.hold)).store(&mut kept[4], at);
        }
        let (volume_initial, stiffness) = (L::load(&kept[0], at), L::load(&kept[4], at));
        let (mut initial, mut sum, mut sum_initial) = ([zero; 3], L::splat(-0.0), L::splat(-0.0));
        for p in 0..3 {
            initial[p] = L::load(&kept[1 + p], at);
            sum += sizes[p];
            sum_initial += initial[p];
        }
        let (ratio, share) = (volume_initial / corners.volume, volume_initial / sum_initial);
        // Of the whole, per volume.
        let (mut mean, mut most) = (L::splat(-0.0), zero);
        let (mut flux, mut radial) = ([[[zero; 2]; 2]; 3], [zero; 3]);
        for p in 0..3 {
            let inverse = one / sizes[p];
            let stretch = sizes[p] / initial[p] * ratio;
            // Exactly one of an element that has kept its form.
            let l = math::ln(stretch);
            let own = stiffness * initial[p] * share;
            let pull = own * l;
            mean += pull;
            held.work += pull * l * L::splat(0.5);
            most = most.max(own * inverse * (one + l.abs() + l.abs()));
            flux[p] = flux_of(&map.adjugates[p], pull / map.determinants[p]);
            radial[p] = pull / radii[p];
        }
        held.forces = Self::divergence(&flux);
        if corners.state.is_axisymmetric {
            add_radial(&mut held.forces, &radial);
        }
        let mean = mean / corners.volume;
        for a in 0..6 {
            for d in 0..2 {
                held.forces[a][d] = held.forces[a][d] - corners.slope[a][d] * mean;
            }
        }
        // κµ V_p⁰ / V_p beside M of what dilates.
        let modulus = most * (sum / corners.volume);
        held.stiffening = one + modulus / corners.modulus * (corners.dilating_squared[1] / corners.characteristic_length_squared[1]);
        held
    }
}

/// Radii of the points, in the plane one; and their determinants times these.
#[inline(always)]
fn sizes<L: Lane>(x: &[[L; 2]; 6], map: &Map<L, 2, 3>, state: StressState) -> ([L; 3], [L; 3]) {
    let (mut radii, mut sizes) = ([L::splat(1.0); 3], map.determinants);
    if state.is_axisymmetric {
        for p in 0..3 {
            radii[p] = L::splat(-0.0);
            for a in 0..6 {
                radii[p] += x[a][0] * L::splat(SHARES[p][a]);
            }
            sizes[p] = sizes[p] * radii[p];
        }
    }
    (radii, sizes)
}

/// Adds to radial forces what pulls on the radii of the points.
#[inline(always)]
fn add_radial<L: Lane>(forces: &mut [[L; 2]; 6], pulls: &[L; 3]) {
    for p in 0..3 {
        for a in 0..6 {
            forces[a][0] += pulls[p] * L::splat(SHARES[p][a]);
        }
    }
}

/// The flux at a point of a pressure of minus `weight`: the adjugate, transposed.
#[inline(always)]
fn flux_of<L: Lane>(adjugate: &Matrix<L, 2>, weight: L) -> Matrix<L, 2> {
    let mut flux = *adjugate;
    for i in 0..2 {
        for k in 0..2 {
            flux[i][k] = adjugate[k][i] * weight;
        }
    }
    flux
}

/// Trace and largest eigenvalue of det times a point's S, see [`super::stiffest`].
#[inline(always)]
fn spectrum<L: Lane>([a, b]: &Matrix<L, 2>) -> [L; 2] {
    let last = [a[0] + b[0], a[1] + b[1]];
    let xx = a[0] * a[0] + b[0] * b[0] + last[0] * last[0];
    let yy = a[1] * a[1] + b[1] * b[1] + last[1] * last[1];
    let xy = a[0] * a[1] + b[0] * b[1] + last[0] * last[1];
    let (trace, apart) = (xx + yy, xx - yy);
    let root = (apart * apart + xy * xy * L::splat(4.0)).sqrt();
    [trace, (trace + root) * L::splat(0.5)]
}
