//! Four-node quadrilaterals with one point: fast, free of locking, and blind to hourglass shapes, which need a control of their own.
//!
//! A nodal vector u has a constant, a linear and an hourglass part; the point feels the linear one. The amplitude of the hourglass pattern h = (1, −1, 1, −1) is
//! q = ¼ γ·u, γ = h − Σ_j (h·x_j) b_j, b_j = ∂N/∂x_j at the centre: γ is blind to constant and linear fields on any quadrilateral. Nodes feel the forces
//! f_a = ¼ γ_a Q, whose power is Q·q̇. Q and q̇ are kept in axes that turn with the line through the middles of two opposite sides, and q̇ is taken at mid-step, so rigid
//! motion changes nothing. M = K + 4µ/3, V the volume, h² the square of the thickness, m the mass:
//!
//! - `stiffness`: Q̇ = κ k₁ q̇, k₁ = 2 M' V / h². With κ = 1 and M' = M the pattern swings as fast as the stretch of a square. Keeps shapes. The source takes M' = M; here
//!   it is at most 4µ (M at ν = 1/3, what bending costs at ν = ½), because with M a κ of 0.05 locks what is nearly incompressible. Of a fluid it is M.
//! - `viscous`: Q = 2 κ √(k₁ m) q̇: the part κ of critical damping. Shapes that are there remain.
//! - `assumed_strain`: Q̇ = κ (V/A) Ē [[H_xx, −ν̄ H_xy], [−ν̄ H_xy, H_yy]] q̇, H_ij = ∫ h,i h,j dA ≈ A/3 (ξ,i ξ,j + η,i η,j), Ē = 2µ (1 + ν̄), ν̄ = ν/(1 − ν) or, in
//!   plane stress, ν: what elastic bending costs, exact on rectangles (ASQBI). While the point flows, the bending stays elastic.
//!
//! The stable step: the linear shapes and the pattern, each with its own largest ω² (a and b), are orthogonal on parallelograms. Else they share c² = 1 − 4/γ·γ, since
//! h is orthogonal to every b_j; for two positive matrices whose ranges have at most this cosine c, ω² ≤ ½ (a + b + √((a − b)² + 4abc²)). A damping d that lags half a
//! step takes part as 2 d / Δt.
//!
//! Sources: Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706; Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 88 (1991) 311-340.

use super::quad4::{NODES, Quad4Full, distance_squared, shape};
use super::{Corners, Element, ElementKind, ElementOptions, Held};
use crate::tensor::{Dim, Matrix, Space};
use embate_lanes::{Batch, Lane};
use std::f64::consts::TAU;

/// What holds an element against hourglass shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Control {
    Stiffness,
    Viscous,
    AssumedStrain,
}

/// The hourglass pattern of an element.
struct Pattern<L> {
    gamma: [L; 4],
    /// Unit vector through the middles of two opposite sides.
    axis: [L; 2],
    /// ∂(ξ, η)/∂x at the centre.
    inverse: Matrix<L, 2>,
}

impl<L: Lane> Pattern<L> {
    #[inline(always)]
    fn new(x: &[[L; 2]; 4]) -> Self {
        let (one, two) = (L::splat(1.0), L::splat(2.0));
        let (d13, d42) = ([x[2][0] - x[0][0], x[2][1] - x[0][1]], [x[3][0] - x[1][0], x[3][1] - x[1][1]]);
        let scale = one / (d13[0] * d42[1] - d42[0] * d13[1]); // 1 / 2A
        // ∂N/∂x and ∂N/∂y at the centre, of nodes 1 and 2; those of 3 and 4 are their negatives.
        let b = [[-(d42[1] * scale), d42[0] * scale], [d13[1] * scale, -(d13[0] * scale)]];
        let twist = [(x[0][0] - x[1][0]) + (x[2][0] - x[3][0]), (x[0][1] - x[1][1]) + (x[2][1] - x[3][1])];
        let first = twist[0] * b[0][0] + twist[1] * b[0][1];
        let second = twist[0] * b[1][0] + twist[1] * b[1][1];
        let gamma = [one - first, -(one + second), one + first, second - one];
        let along = [d13[0] - d42[0], d13[1] - d42[1]]; // (x2 − x1) + (x3 − x4)
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let inverse =
            [[(b[1][0] - b[0][0]) * two, (b[1][1] - b[0][1]) * two], [-((b[0][0] + b[1][0]) * two), -((b[0][1] + b[1][1]) * two)]];
        Self { gamma, axis: [along[0] / length, along[1] / length], inverse }
    }

    /// Amplitude of a nodal vector, in the turning axes.
    #[inline(always)]
    fn amplitude(&self, u: &[[L; 2]; 4]) -> [L; 2] {
        let mut q = [L::splat(0.0); 2];
        for i in 0..2 {
            let (odd, even) = (self.gamma[0] * u[0][i] + self.gamma[2] * u[2][i], self.gamma[1] * u[1][i] + self.gamma[3] * u[3][i]);
            q[i] = (odd + even) * L::splat(0.25);
        }
        self.along_axes(q)
    }

    /// Components in the turning axes.
    #[inline(always)]
    fn along_axes(&self, [x, y]: [L; 2]) -> [L; 2] {
        let [c, s] = self.axis;
        [c * x + s * y, c * y - s * x]
    }

    /// Nodal forces of a Q in the turning axes.
    #[inline(always)]
    fn forces(&self, [x, y]: [L; 2]) -> [[L; 2]; 4] {
        let ([c, s], quarter) = (self.axis, L::splat(0.25));
        let global = [(c * x - s * y) * quarter, (s * x + c * y) * quarter];
        let mut forces = [[L::splat(0.0); 2]; 4];
        for a in 0..4 {
            forces[a] = [self.gamma[a] * global[0], self.gamma[a] * global[1]];
        }
        forces
    }

    /// γ·γ
    #[inline(always)]
    fn square(&self) -> L {
        let [a, b, c, d] = self.gamma;
        (a * a + b * b) + (c * c + d * d)
    }

    /// [[H_xx, −ν̄ H_xy], [−ν̄ H_xy, H_yy]] / A in the turning axes, as its three different entries xx, yy, xy.
    #[inline(always)]
    fn bending(&self, poisson: L) -> [L; 3] {
        let third = L::splat(1.0 / 3.0);
        let ([xi_x, xi_y], [eta_x, eta_y]) = (self.along_axes(self.inverse[0]), self.along_axes(self.inverse[1]));
        [(xi_x * xi_x + eta_x * eta_x) * third, (xi_y * xi_y + eta_y * eta_y) * third, -((xi_x * xi_y + eta_x * eta_y) * third * poisson)]
    }
}

/// ν̄ and Ē of an elastic bending: see the head of the file.
#[inline(always)]
fn bending_moduli<L: Lane>(modulus: L, shear: L, is_plane_stress: bool) -> [L; 2] {
    let (one, two) = (L::splat(1.0), L::splat(2.0));
    // ν = (M − 2µ) / 2(M − µ), ν/(1 − ν) = (M − 2µ) / M
    let lame = modulus - two * shear;
    let poisson = if is_plane_stress { lame / (two * (modulus - shear)) } else { lame / modulus };
    [poisson, two * shear * (one + poisson)]
}

/// h² = 2 A² / (d₁₃² + d₂₄²): ω² ≤ M V (|∇ξ|² + |∇η|²) / m at the centre, by the two blocks of [`super::quad4`].
#[inline(always)]
fn thickness_squared<L: Lane>(x: &[[L; 2]; 4], area: L) -> L {
    L::splat(2.0) * area * area / (distance_squared(x[0], x[2]) + distance_squared(x[1], x[3]))
}

/// ∫ N_a dA at the 2 × 2 points, which one point takes for equal.
fn corner_volumes(x: &[[f64; 2]; 4], is_axisymmetric: bool) -> [f64; 4] {
    let mut volumes = [0.0; 4];
    for (jacobian, at) in Quad4Full::gradients(x).iter().zip(Quad4Full::POINTS) {
        let shape = shape(at);
        let radius: f64 = x.iter().zip(shape).map(|(x, share)| x[0] * share).sum();
        let volume = Dim::<2>::determinant(jacobian) * if is_axisymmetric { TAU * radius } else { 1.0 };
        for (corner, share) in volumes.iter_mut().zip(shape) {
            *corner += volume * share;
        }
    }
    volumes
}

#[inline(always)]
fn hold_shape<L: Lane>(control: Control, coefficient: f64, corners: &Corners<L, 2, 4>, kept: &mut [Batch], at: usize) -> Held<L, 2, 4> {
    let (half, four, coefficient) = (L::splat(0.5), L::splat(4.0), L::splat(coefficient));
    let Corners { x, v, modulus, shear, shape_modulus, mass, time_step, volume, .. } = *corners;
    let mut x_middle = x;
    for a in 0..4 {
        for i in 0..2 {
            x_middle[a][i] = x[a][i] - v[a][i] * time_step * half;
        }
    }
    let (middle, end) = (Pattern::new(&x_middle), Pattern::new(&x));
    let rate = middle.amplitude(&v);
    let change = [rate[0] * time_step, rate[1] * time_step];
    let old = [L::load(&kept[0], at), L::load(&kept[1], at)];
    let thickness_squared = thickness_squared(&x, corners.area);
    let stiffness = L::splat(2.0) * shape_modulus * volume / thickness_squared;
    let step_squared = thickness_squared * mass / (volume * modulus); // of the linear shapes
    let share = end.square() / (four * mass); // largest ω² per stiffness of the pattern
    let (force, swing) = match control {
        Control::Stiffness => {
            let k = coefficient * stiffness;
            ([old[0] + k * change[0], old[1] + k * change[1]], k * share * step_squared)
        }
        Control::Viscous => {
            let c = L::splat(2.0) * coefficient * (stiffness * mass).sqrt();
            ([c * rate[0], c * rate[1]], L::splat(2.0) * c * share * step_squared.sqrt())
        }
        Control::AssumedStrain => {
            let [poisson, young] = bending_moduli(modulus, shear, corners.is_plane_stress);
            let [xx, yy, xy] = middle.bending(poisson);
            let k = coefficient * young * volume;
            let difference = xx - yy;
            let largest = (xx + yy + (difference * difference + four * xy * xy).sqrt()) * half;
            let force = [old[0] + k * (xx * change[0] + xy * change[1]), old[1] + k * (xy * change[0] + yy * change[1])];
            (force, k * largest * share * step_squared)
        }
    };
    force[0].store(&mut kept[0], at);
    force[1].store(&mut kept[1], at);
    // ω² Δt² of both together at the linear step; it must not be more than 4.
    let difference = four - swing;
    let shared = L::splat(16.0) * swing * (L::splat(1.0) - four / end.square()).max(L::splat(0.0));
    let together = (four + swing + (difference * difference + shared).sqrt()) * half;
    let shrink = four / together;
    Held {
        forces: end.forces(force),
        work: half * ((old[0] + force[0]) * change[0] + (old[1] + force[1]) * change[1]),
        time_step_squared: step_squared * if matches!(control, Control::Viscous) { shrink * shrink } else { shrink },
    }
}

macro_rules! reduced {
    ($(#[$doc:meta])* $name:ident, $control:ident, $coefficient:literal, $kind:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name {
            coefficient: f64,
        }

        impl Element<2, 4, 1> for $name {
            const KIND: ElementKind = $kind;
            const POINTS: [[f64; 2]; 1] = [[0.0; 2]];
            const WEIGHTS: [f64; 1] = [4.0];
            const NODES: [[f64; 2]; 4] = NODES;
            const MEAN_DILATATION: bool = false;
            const HOURGLASS: usize = 2;

            fn new(options: &ElementOptions) -> Self {
                Self { coefficient: options.hourglass.unwrap_or($coefficient) }
            }
            fn shape(natural: [f64; 2]) -> [f64; 4] {
                shape(natural)
            }
            #[inline(always)]
            fn gradients<L: Lane>(u: &[[L; 2]; 4]) -> [Matrix<L, 2>; 1] {
                let quarter = L::splat(0.25);
                let mut out = [[[L::splat(0.0); 2]; 2]; 1];
                for i in 0..2 {
                    let (diagonal_13, diagonal_24) = (u[2][i] - u[0][i], u[1][i] - u[3][i]);
                    out[0][i] = [(diagonal_13 + diagonal_24) * quarter, (diagonal_13 - diagonal_24) * quarter];
                }
                out
            }
            #[inline(always)]
            fn divergence<L: Lane>(flux: &[Matrix<L, 2>; 1]) -> [[L; 2]; 4] {
                let quarter = L::splat(0.25);
                let mut out = [[L::splat(0.0); 2]; 4];
                for i in 0..2 {
                    let (sum, difference) = ((flux[0][i][0] + flux[0][i][1]) * quarter, (flux[0][i][0] - flux[0][i][1]) * quarter);
                    out[0][i] = -sum;
                    out[1][i] = difference;
                    out[2][i] = sum;
                    out[3][i] = -difference;
                }
                out
            }
            #[inline(always)]
            fn thickness_squared<L: Lane>(nodal: &[[L; 2]; 4], _: &[L; 1], area: L) -> L {
                thickness_squared(nodal, area)
            }
            fn corner_volumes(nodal: &[[f64; 2]; 4], is_axisymmetric: bool) -> Option<[f64; 4]> {
                Some(corner_volumes(nodal, is_axisymmetric))
            }
            #[inline(always)]
            fn hold_shape<L: Lane>(&self, corners: &Corners<L, 2, 4>, kept: &mut [Batch], at: usize) -> Held<L, 2, 4> {
                hold_shape(Control::$control, self.coefficient, corners, kept, at)
            }
        }
    };
}

reduced!(
    /// Held by springs.
    Quad4Reduced,
    Stiffness,
    0.05,
    ElementKind {
        name: "quad4_reduced",
        doc: "four-node quadrilateral, one point, hourglass control by stiffness (coefficient 0.05)",
        source: "Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706",
        nodes: 4,
    }
);

reduced!(
    /// Held by dampers.
    Quad4ReducedViscous,
    Viscous,
    0.05,
    ElementKind {
        name: "quad4_reduced_viscous",
        doc: "four-node quadrilateral, one point, hourglass control by damping (coefficient 0.05): for high rates; shapes that are there remain",
        source: "Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706",
        nodes: 4,
    }
);

reduced!(
    /// Held by what elastic bending costs.
    Quad4ReducedAssumedStrain,
    AssumedStrain,
    1.0,
    ElementKind {
        name: "quad4_reduced_assumed_strain",
        doc: "four-node quadrilateral, one point, hourglass control by assumed strain (coefficient 1): right in elastic bending with one element through the thickness",
        source: "Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 88 (1991) 311-340 (ASQBI)",
        nodes: 4,
    }
);
