//! Four-node quadrilaterals with one point: fast, free of locking, and blind to hourglass shapes, which need a control of their own.
//!
//! A nodal vector u has a constant, a linear and an hourglass part; the point feels the linear one. The amplitude of the hourglass pattern h = (1, −1, 1, −1) is
//! q = ¼ γ·u, γ = h − Σ_j (h·x_j) b_j, b_j = ∂N/∂x_j at the centre: γ is blind to constant and linear fields on any quadrilateral (Flanagan and Belytschko 1981). Nodes feel
//! the forces f_a = ¼ γ_a Q. Q and the rate of q are kept in axes that turn with the line through the middles of two opposite sides, so rigid motion changes nothing.
//!
//! - `stiffness`: Q̇ = k q̇, k = 2 κ (K + 4µ/3) (b·b) V. Keeps shapes, at the price of a little stiffness in bending.
//! - `viscous`: Q = c q̇, c = 2 κ √(k₁ m) with k₁ the k of κ = 1. Shapes that are there remain, but no energy is stored; for high rates.
//! - `assumed_strain`: Q̇ = V/A Ē [[H_xx, −ν̄ H_xy], [−ν̄ H_xy, H_yy]] q̇ with H_ij = ∫ h,i h,j dA ≈ A/3 (ξ,i ξ,j + η,i η,j), Ē = 2µ (1 + ν̄), ν̄ = ν/(1 − ν): the bending of elastic
//!   beams, exact on rectangles (Belytschko and Bindeman 1991, ASQBI). While a point flows, its bending stays elastic: `quad4` is the better choice there. Its coefficient scales Q.
//!
//! Work of Q is booked as `hourglass`, by the trapezoidal rule. Largest frequency of the pattern: ω² = k γ·γ / (4 m).
//! Sources: Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706; Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 88 (1991) 311-340.

use super::{Corners, Element, ElementKind, ElementOptions, Held};
use crate::tensor::Matrix;
use embate_lanes::{Batch, Lane};

/// Natural coordinates of the nodes.
const NODES: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
/// The hourglass pattern.
const H: [f64; 4] = [1.0, -1.0, 1.0, -1.0];

/// The pattern in an element.
struct Pattern<L> {
    gamma: [L; 4],
    /// Σ b·b, 1/m².
    slopes: L,
    /// Unit vector through the middles of two opposite sides.
    axis: [L; 2],
    /// ∂ξ/∂x and ∂η/∂x in these axes, 1/m.
    inverse: Matrix<L, 2>,
}

impl<L: Lane> Pattern<L> {
    #[inline(always)]
    fn new(x: &[[L; 2]; 4], area: L) -> Self {
        let half = L::splat(0.5) / area;
        // ∂N_a/∂x and ∂N_a/∂y at the centre, of nodes 1 and 2; those of 3 and 4 are their negatives.
        let b = [
            [(x[1][1] - x[3][1]) * half, (x[3][0] - x[1][0]) * half],
            [(x[2][1] - x[0][1]) * half, (x[0][0] - x[2][0]) * half],
        ];
        let mut twist = [L::splat(0.0); 2];
        for i in 0..2 {
            twist[i] = (x[0][i] - x[1][i]) + (x[2][i] - x[3][i]);
        }
        let first = twist[0] * b[0][0] + twist[1] * b[0][1];
        let second = twist[0] * b[1][0] + twist[1] * b[1][1];
        let one = L::splat(1.0);
        let gamma = [one - first, -one - second, one + first, second - one];
        let slopes = (b[0][0] * b[0][0] + b[0][1] * b[0][1] + b[1][0] * b[1][0] + b[1][1] * b[1][1]) * L::splat(2.0);
        let mut along = [L::splat(0.0); 2];
        for i in 0..2 {
            along[i] = (x[1][i] - x[0][i]) + (x[2][i] - x[3][i]);
        }
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let axis = [along[0] / length, along[1] / length];
        // ξ = Σ ξ_a N_a, so ∂ξ/∂x = Σ ξ_a b_a: ξ_a = (−1, 1, 1, −1), η_a = (−1, −1, 1, 1).
        let mut inverse = [[L::splat(0.0); 2]; 2];
        let two = L::splat(2.0);
        for (k, sign) in [(0, -1.0), (1, 1.0)] {
            // ξ: 2 (b₂ − b₁); η: −2 (b₁ + b₂)
            let (gx, gy) = if sign < 0.0 {
                ((b[1][0] - b[0][0]) * two, (b[1][1] - b[0][1]) * two)
            } else {
                (-((b[0][0] + b[1][0]) * two), -((b[0][1] + b[1][1]) * two))
            };
            inverse[k] = [gx * axis[0] + gy * axis[1], gy * axis[0] - gx * axis[1]];
        }
        Self { gamma, slopes, axis, inverse }
    }

    /// Amplitude of a nodal vector, in the turning axes.
    #[inline(always)]
    fn amplitude(&self, u: &[[L; 2]; 4]) -> [L; 2] {
        let mut q = [L::splat(0.0); 2];
        for i in 0..2 {
            q[i] = (self.gamma[0] * u[0][i] + self.gamma[1] * u[1][i] + self.gamma[2] * u[2][i] + self.gamma[3] * u[3][i])
                * L::splat(0.25);
        }
        let [c, s] = self.axis;
        [c * q[0] + s * q[1], c * q[1] - s * q[0]]
    }

    /// Nodal forces of a Q in the turning axes.
    #[inline(always)]
    fn forces(&self, force: [L; 2]) -> [[L; 2]; 4] {
        let ([c, s], quarter) = (self.axis, L::splat(0.25));
        let global = [(c * force[0] - s * force[1]) * quarter, (s * force[0] + c * force[1]) * quarter];
        let mut forces = [[L::splat(0.0); 2]; 4];
        for a in 0..4 {
            forces[a] = [self.gamma[a] * global[0], self.gamma[a] * global[1]];
        }
        forces
    }

    #[inline(always)]
    fn square(&self) -> L {
        let [a, b, c, d] = self.gamma;
        (a * a + b * b) + (c * c + d * d)
    }

    /// Stiffness of the pattern by Flanagan and Belytschko for a coefficient of one.
    #[inline(always)]
    fn stiffness(&self, corners: &Corners<L, 2, 4>) -> L {
        L::splat(2.0) * corners.modulus * self.slopes * corners.area * corners.volume / corners.area * corners.area
    }
}
