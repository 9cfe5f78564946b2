//! Four-node quadrilaterals with one point: fast, free of locking, and blind to hourglass shapes, which need
//! a control of their own.
//!
//! A nodal vector u has a constant, a linear and an hourglass part; the point feels the linear one. The
//! amplitude of the hourglass pattern h = (1, −1, 1, −1) is q = ¼ γ·u, γ = h − Σ_j (h·x_j) b_j, b_j = ∂N/∂x_j
//! at the centre: γ is blind to constant and linear fields on any quadrilateral. Nodes feel the forces
//! f_a = ¼ γ_a Q, whose power is Q·q̇. q̇ is taken at mid-step and Q turns with the step's rotation (Hughes
//! and Winget's, of the point), so rigid motion changes nothing; both are done while the point is strained,
//! stiffnesses are of the end of the step. M = K + 4µ/3, in plane stress E/(1 − ν²), V the volume, h² the
//! square of the thickness, m the mass:
//!
//! - `stiffness`: Q̇ = κ k₁ q̇, k₁ = 2 M' V / h². With κ = 1 and M' = M the pattern swings as fast as the
//!   stretch of a square. Keeps shapes. The source takes M' = M; here it is at most 4µ (M at ν = 1/3, what
//!   bending costs at ν = ½), because with M a κ of 0.05 locks what is nearly incompressible. Of a fluid it
//!   is M.
//! - `viscous`: Q = 2 κ √(k₁ m) q̇: the part κ of critical damping. Shapes that are there remain.
//! - `assumed_strain`: Q = K q, K = κ (V/A) Ē [[H_xx, −ν̄ H_xy], [−ν̄ H_xy, H_yy]] in the axes along the line
//!   through the middles of two opposite sides, H_ij = ∫ h,i h,j dA ≈ A/3 (ξ,i ξ,j + η,i η,j), Ē = 2µ (1 +
//!   ν̄), ν̄ = ν/(1 − ν) or, in plane stress, ν: what elastic bending costs, exact on rectangles (ASQBI). The
//!   source has Q̇ = K q̇ with the shape of the moment; here K and γ are those of the start, and K turns with
//!   the element ([`Frame`]): W = ½ q̂·K q̂ is a potential, which gives back what it took whatever becomes of
//!   the element, where rates gave ten times as much in elements that fold. f_a = ∂W/∂x_a has besides ¼ γ_a Q
//!   the couple that turns the frame, so that angular momentum is kept. With γ of the start, h has the same
//!   share of it: every b_j is made of the two diagonals. While the point flows, the bending stays elastic.
//!
//! The stable step: the linear shapes and the pattern, each with its own largest ω² (a and b), are orthogonal
//! on parallelograms. Else they share c² = 1 − 4/γ·γ, since h is orthogonal to every b_j; for two positive
//! matrices whose ranges have at most this cosine c, ω² ≤ ½ (a + b + √((a − b)² + 4abc²)) ≤ a + abc²/(a − b),
//! which is taken where b ≤ a/2, with a/2 for a − b, and a + b elsewhere: no root. A damping d that lags half
//! a step takes part as 2 d / Δt. With the linear shapes' step, a Δt² = 4, and b Δt² is ½ κ γ·γ and √2 κ γ·γ
//! (with M for M', which is no less), and κ Ē λ h² γ·γ / 4M with the largest eigenvalue λ of H/A (of the
//! potential K's own, κ Ē V λ at the start), and what the turn of the frame adds.
//!
//! Sources: Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706; Hughes and Winget, Int. J.
//! Numer. Meth. Engng 15 (1980) 1862-1867; Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 88 (1991)
//! 311-340.

use super::quad4::{Quad4Full, distance_squared, shape};
use super::{Corners, Element, ElementKind, ElementOptions, Held, Map, PATTERNS, Pulls, Thickness};
use crate::mesh::cell::CellKind;
use crate::stress_state::StressState;
use crate::tensor::{Dim, Matrix, Space, scaled};
use embate_lanes::{Batch, Lane};
use std::f64::consts::{SQRT_2, TAU};

/// Natural coordinates along the diagonals, from corner to corner of length one: at the centre the gradient
/// is the differences between opposite nodes.
const DIAGONAL_NODES: [[f64; 2]; 4] = [[-0.5, 0.0], [0.0, -0.5], [0.5, 0.0], [0.0, 0.5]];

/// What holds an element against hourglass shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Control {
    Stiffness,
    Viscous,
    AssumedStrain,
}

/// Differences of a nodal vector: along the diagonals 1 to 3 and 2 to 4, as in the gradient, and h·u.
struct Differences<L> {
    first: [L; 2],
    second: [L; 2],
    twist: [L; 2],
}

impl<L: Lane> Differences<L> {
    #[inline(always)]
    fn of(u: &[[L; 2]; 4]) -> Self {
        let zero = [L::splat(0.0); 2];
        let mut out = Self { first: zero, second: zero, twist: zero };
        for i in 0..2 {
            out.first[i] = u[2][i] - u[0][i];
            out.second[i] = u[3][i] - u[1][i];
            out.twist[i] = (u[0][i] - u[1][i]) + (u[2][i] - u[3][i]);
        }
        out
    }

    /// Of positions: twice the area.
    #[inline(always)]
    fn area_twice(&self) -> L {
        self.first[0] * self.second[1] - self.second[0] * self.first[1]
    }

    /// Of positions: the line through the middles of the sides 4 1 and 2 3, twice its length.
    #[inline(always)]
    fn along(&self) -> [L; 2] {
        [self.first[0] - self.second[0], self.first[1] - self.second[1]]
    }

    /// Of positions: axes that turn with the element.
    #[inline(always)]
    fn frame(&self) -> Frame<L> {
        let (along, across) = (self.along(), [self.first[0] + self.second[0], self.first[1] + self.second[1]]);
        let p = [along[0] + across[1], along[1] - across[0]];
        let square = p[0] * p[0] + p[1] * p[1];
        let scale = L::splat(1.0) / square.sqrt();
        Frame { p, axis: [p[0] * scale, p[1] * scale], square }
    }

    /// Of positions, with one over twice the area: what γ has of the diagonals besides h.
    #[inline(always)]
    fn diagonals(&self, inverse: L) -> [L; 2] {
        [
            (self.twist[1] * self.second[0] - self.twist[0] * self.second[1]) * inverse,
            (self.twist[0] * self.first[1] - self.twist[1] * self.first[0]) * inverse,
        ]
    }
}

/// Axes of an element: with the lines through the middles of opposite sides, l along and m across, p = (l_x +
/// m_y, l_y − m_x) is the sum of l and of m turned back by a right angle. p·p = l·l + m·m + 2 l × m is
/// positive as long as the area at the centre is.
struct Frame<L> {
    p: [L; 2],
    /// p/|p|.
    axis: [L; 2],
    /// p·p.
    square: L,
}

/// γ of the nodes.
#[inline(always)]
fn gamma<L: Lane>(first: L, second: L) -> [L; 4] {
    let one = L::splat(1.0);
    [one - first, -(one + second), one + first, second - one]
}

/// What takes nodal vectors to their gradient at the centre, all of it times 2A.
struct Centre<L> {
    /// ∂N/∂x and ∂N/∂y of nodes 1 and 2; those of 3 and 4 are their negatives.
    b: Matrix<L, 2>,
}

impl<L: Lane> Centre<L> {
    /// From the positions.
    #[inline(always)]
    fn new(x: &Differences<L>) -> Self {
        let Differences { first, second, .. } = x;
        Self { b: [[-second[1], second[0]], [first[1], -first[0]]] }
    }

    /// ∂(ξ, η)/∂x.
    #[inline(always)]
    fn natural(&self) -> Matrix<L, 2> {
        let two = L::splat(2.0);
        let [first, second] = self.b;
        [[(second[0] - first[0]) * two, (second[1] - first[1]) * two], [-((first[0] + second[0]) * two), -((first[1] + second[1]) * two)]]
    }
}

/// A vector turned by the angle of `[cos, sin]`.
#[inline(always)]
fn turned<L: Lane>([x, y]: [L; 2], [cos, sin]: [L; 2]) -> [L; 2] {
    [cos * x - sin * y, sin * x + cos * y]
}

/// A vector turned back.
#[inline(always)]
fn turned_back<L: Lane>([x, y]: [L; 2], [cos, sin]: [L; 2]) -> [L; 2] {
    [cos * x + sin * y, cos * y - sin * x]
}

/// [[H_xx, −ν̄ H_xy], [−ν̄ H_xy, H_yy]] / A in the axes along `axis`, as its three different entries xx, yy,
/// xy.
#[inline(always)]
fn bending<L: Lane>(natural: &Matrix<L, 2>, axis: [L; 2], poisson: L) -> [L; 3] {
    let third = L::splat(1.0 / 3.0);
    let ([xi_x, xi_y], [eta_x, eta_y]) = (turned_back(natural[0], axis), turned_back(natural[1], axis));
    [(xi_x * xi_x + eta_x * eta_x) * third, (xi_y * xi_y + eta_y * eta_y) * third, -((xi_x * xi_y + eta_x * eta_y) * third * poisson)]
}

/// h² = 2 A² / (d₁₃² + d₂₄²), numerator and denominator: ω² ≤ M V (|∇ξ|² + |∇η|²) / m at the centre, by the
/// two blocks of [`super::quad4`].
#[inline(always)]
fn characteristic_length_squared<L: Lane>(x: &[[L; 2]; 4], area: L) -> [L; 2] {
    [L::splat(2.0) * area * area, distance_squared(x[0], x[2]) + distance_squared(x[1], x[3])]
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

/// Values that the potential of the assumed strain keeps.
const POTENTIAL: usize = 5;

/// What a control adds.
struct Answer<L> {
    /// To Q; of dampers all of it.
    added: [L; 2],
    /// b Δt² over γ·γ at the stable step of the linear shapes.
    hourglass_rates: L,
}

/// What the potential of the assumed strain keeps of the start: γ as its parts along the diagonals, and the
/// stiffness in the axes of [`frame`], N/m (N).
#[inline(always)]
fn potential<L: Lane>(coefficient: L, corners: &Corners<L, 2, 4>, start: &Differences<L>, inverse: L) -> [L; POTENTIAL] {
    let (one, two) = (L::splat(1.0), L::splat(2.0));
    let Corners { contraction: poisson, shear, volume, .. } = *corners;
    let young = two * shear * (one + poisson);
    let along = start.along();
    let scale = one / (along[0] * along[0] + along[1] * along[1]).sqrt();
    let axis = [along[0] * scale, along[1] * scale];
    let [xx, yy, xy] = bending(&scaled(Centre::new(start).natural(), inverse), axis, poisson);
    let k = coefficient * young * volume;
    // The axis along the middles as the frame sees it.
    let [cos, sin] = turned_back(axis, start.frame().axis);
    let (squares, product) = ([cos * cos, sin * sin], two * cos * sin * xy);
    let [first, second] = start.diagonals(inverse);
    [
        first,
        second,
        k * (squares[0] * xx - product + squares[1] * yy),
        k * (squares[1] * xx + product + squares[0] * yy),
        k * (cos * sin * (xx - yy) + (squares[0] - squares[1]) * xy),
    ]
}

/// The potential of the assumed strain: W = ½ q̂·K q̂, and f_a = ∂W/∂x_a with the turn of the frame.
#[inline(always)]
fn bend<L: Lane>(
    coefficient: L,
    corners: &Corners<L, 2, 4>,
    [numerator, extent]: [L; 2],
    end: &Differences<L>,
    inverse: L,
    memory: (&mut [Batch], usize),
) -> Held<L, 2, 4> {
    let (quarter, half, two, four) = (L::splat(0.25), L::splat(0.5), L::splat(2.0), L::splat(4.0));
    let (memory, at) = memory;
    if corners.is_start {
        let kept = potential(coefficient, corners, end, inverse);
        for i in 0..POTENTIAL {
            kept[i].store(&mut memory[i], at);
        }
    }
    let mut kept = [half; POTENTIAL];
    for i in 0..POTENTIAL {
        kept[i] = L::load(&memory[i], at);
    }
    let [first, second, xx, yy, xy] = kept;
    let mut amplitude = [half; 2];
    for i in 0..2 {
        amplitude[i] = (end.twist[i] + first * end.first[i] + second * end.second[i]) * quarter;
    }
    let Frame { p, axis, square } = end.frame();
    let [x, y] = turned_back(amplitude, axis);
    let [force_x, force_y] = [xx * x + xy * y, xy * x + yy * y];
    let force = turned([force_x * quarter, force_y * quarter], axis);
    // ∂θ/∂x_a = (−p_x m_a − p_y l_a, p_x l_a − p_y m_a) / p·p, and ∂W/∂θ = −q̂ × Q.
    let couple = (x * force_y - y * force_x) / square;
    let (u, w) = (couple * p[0], couple * p[1]);
    let (sum, difference) = (u + w, u - w);
    let gamma = gamma(first, second);
    let turns = [[-sum, difference], [-difference, -sum], [sum, -difference], [difference, sum]];
    let mut forces = turns;
    for a in 0..4 {
        forces[a] = [gamma[a] * force[0] + turns[a][0], gamma[a] * force[1] + turns[a][1]];
    }
    let difference = xx - yy;
    let largest = (xx + yy + (difference * difference + four * xy * xy).sqrt()) * half;
    let hourglass_rates = largest * numerator / (four * corners.modulus * corners.volume * extent);
    let more = two * (first * first + second * second);
    // |dq̂| ≤ ¼|γ||dx| + |q̂| √8/|p| |dx|, the second part at most r times the first.
    let r = (L::splat(32.0) * (x * x + y * y) / square).sqrt();
    Held {
        forces,
        flux: [[L::splat(0.0); 2]; 2],
        pulls: Pulls::none(),
        work: half * (force_x * x + force_y * y),
        stiffening: together(hourglass_rates, more) + hourglass_rates * (four + more) * quarter * (r * (two + r)),
    }
}

/// q̇ Δt at mid-step, from the twist less what is linear in it.
#[inline(always)]
fn hourglass_rates<L: Lane>(x: &[[L; 2]; 4], step: &[[L; 2]; 4], gradient: &Matrix<L, 2>) -> [L; 2] {
    let (quarter, half) = (L::splat(0.25), L::splat(0.5));
    let (end, step) = (Differences::of(x).twist, Differences::of(step).twist);
    let middle = [end[0] - step[0] * half, end[1] - step[1] * half];
    let mut out = [quarter; 2];
    for i in 0..2 {
        out[i] = (step[i] - (middle[0] * gradient[i][0] + middle[1] * gradient[i][1])) * quarter;
    }
    out
}

/// ω² Δt² of the linear shapes and of the pattern together over 4, at the step of the linear shapes, from b
/// Δt² / γ·γ and γ·γ − 4. With a Δt² = 4 the bound is ½ (a + b + √((a − b)² + 4abc²)) ≤ a + abc² / (a −
/// b) ≤ a (1 + 2bc²/a) where b is at most a/2, and at most a + b elsewhere.
#[inline(always)]
fn together<L: Lane>(hourglass_rates: L, more: L) -> L {
    let (quarter, half, one, two) = (L::splat(0.25), L::splat(0.5), L::splat(1.0), L::splat(2.0));
    let all = hourglass_rates * (L::splat(4.0) + more);
    L::select(two.less(all), one + all * quarter, one + hourglass_rates * more * half)
}

#[inline(always)]
fn hourglass_forces<L: Lane>(
    control: Control,
    coefficient: f64,
    corners: &Corners<L, 2, 4>,
    kept: &mut [Batch],
    at: usize,
) -> Held<L, 2, 4> {
    let (quarter, half, one, two, four) = (L::splat(0.25), L::splat(0.5), L::splat(1.0), L::splat(2.0), L::splat(4.0));
    let Corners { shape_modulus, mass, rate, volume, hourglass_rates: [change, ..], .. } = *corners;
    let coefficient = L::splat(coefficient);
    let end = Differences::of(&corners.x);
    let inverse = one / end.area_twice();
    // k₁ = 2 M V / h² with h² = 2 A² / (…)
    let characteristic_length_squared = characteristic_length_squared(&corners.x, corners.area);
    let stiffness = four * shape_modulus * volume * characteristic_length_squared[1] * (inverse * inverse);
    let Answer { added, hourglass_rates } = match control {
        Control::Stiffness => {
            let k = coefficient * stiffness;
            Answer { added: [k * change[0], k * change[1]], hourglass_rates: half * coefficient }
        }
        Control::Viscous => {
            let c = two * coefficient * (stiffness * mass).sqrt() * rate;
            Answer { added: [c * change[0], c * change[1]], hourglass_rates: L::splat(SQRT_2) * coefficient }
        }
        Control::AssumedStrain => return bend(coefficient, corners, characteristic_length_squared, &end, inverse, (kept, at)),
    };
    let old = [L::load(&kept[0], at), L::load(&kept[1], at)];
    let force = if matches!(control, Control::Viscous) { added } else { [old[0] + added[0], old[1] + added[1]] };
    let [first, second] = end.diagonals(inverse);
    let gamma = gamma(first, second);
    let quarters = [force[0] * quarter, force[1] * quarter];
    let mut forces = [[one; 2]; 4];
    for a in 0..4 {
        forces[a] = [gamma[a] * quarters[0], gamma[a] * quarters[1]];
    }
    force[0].store(&mut kept[0], at);
    force[1].store(&mut kept[1], at);
    // γ·γ − 4
    let together = together(hourglass_rates, two * (first * first + second * second));
    Held {
        forces,
        flux: [[L::splat(0.0); 2]; 2],
        pulls: Pulls::none(),
        work: half * ((old[0] + force[0]) * change[0] + (old[1] + force[1]) * change[1]),
        stiffening: if matches!(control, Control::Viscous) { together * together } else { together },
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
            const WEIGHTS: [f64; 1] = [0.5];
            const NODES: [[f64; 2]; 4] = DIAGONAL_NODES;
            const MEAN_DILATATION: bool = false;
            const HOURGLASS: usize = if matches!(Control::$control, Control::AssumedStrain) { POTENTIAL } else { 2 };
            const DAMPS: bool = matches!(Control::$control, Control::Viscous);
            const HOURGLASS_MODES: usize = if matches!(Control::$control, Control::AssumedStrain) { 0 } else { 1 };

            fn new(options: &ElementOptions) -> Self {
                Self { coefficient: options.hourglass.unwrap_or($coefficient) }
            }
            fn shape([r, s]: [f64; 2]) -> [f64; 4] {
                shape([2.0 * (r - s), 2.0 * (r + s)])
            }
            #[inline(always)]
            fn gradients<L: Lane>(u: &[[L; 2]; 4]) -> [Matrix<L, 2>; 1] {
                let mut out = [[[L::splat(0.0); 2]; 2]; 1];
                for i in 0..2 {
                    out[0][i] = [u[2][i] - u[0][i], u[3][i] - u[1][i]];
                }
                out
            }
            #[inline(always)]
            fn divergence<L: Lane>(flux: &[Matrix<L, 2>; 1]) -> [[L; 2]; 4] {
                let mut out = [[L::splat(0.0); 2]; 4];
                for i in 0..2 {
                    out[0][i] = -flux[0][i][0];
                    out[1][i] = -flux[0][i][1];
                    out[2][i] = flux[0][i][0];
                    out[3][i] = flux[0][i][1];
                }
                out
            }
            #[inline(always)]
            fn thickness<L: Lane>(nodal: &[[L; 2]; 4], _: &Map<L, 2, 1>, area: L, _: &[[L; 2]; 4], _: StressState) -> Thickness<L> {
                let [numerator, denominator] = characteristic_length_squared(nodal, area);
                Thickness::of_waves(numerator, denominator)
            }
            fn corner_volumes(nodal: &[[f64; 2]; 4], is_axisymmetric: bool) -> Option<[f64; 4]> {
                Some(corner_volumes(nodal, is_axisymmetric))
            }
            #[inline(always)]
            fn hourglass_rates<L: Lane>(x: &[[L; 2]; 4], step: &[[L; 2]; 4], gradient: &Matrix<L, 2>) -> [[L; 2]; PATTERNS] {
                let mut all = [[L::splat(0.0); 2]; PATTERNS];
                all[0] = hourglass_rates(x, step, gradient);
                all
            }
            #[inline(always)]
            fn hourglass_forces<L: Lane>(&self, corners: &Corners<L, 2, 4>, _: &Map<L, 2, 1>, kept: &mut [Batch], at: usize) -> Held<L, 2, 4> {
                hourglass_forces(Control::$control, self.coefficient, corners, kept, at)
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
        cell: CellKind::Quadrilateral,
        dimension: 2,
        extruded: Some("hex8_reduced"),
        is_default: false,
    }
);

reduced!(
    /// Held by dampers.
    Quad4ReducedViscous,
    Viscous,
    0.05,
    ElementKind {
        name: "quad4_reduced_viscous",
        doc: "four-node quadrilateral, one point, hourglass control by damping (coefficient 0.05): for high rates; \
            shapes that are there remain",
        source: "Flanagan and Belytschko, Int. J. Numer. Meth. Engng 17 (1981) 679-706",
        cell: CellKind::Quadrilateral,
        dimension: 2,
        extruded: Some("hex8_reduced_viscous"),
        is_default: false,
    }
);

reduced!(
    /// Held by what elastic bending costs.
    Quad4ReducedAssumedStrain,
    AssumedStrain,
    1.0,
    ElementKind {
        name: "quad4_reduced_assumed_strain",
        doc: "four-node quadrilateral, one point, hourglass control by assumed strain (coefficient 1): right in \
            elastic bending with one element through the thickness",
        source: "Belytschko and Bindeman, Comput. Meth. Appl. Mech. Engng 88 (1991) 311-340 (ASQBI)",
        cell: CellKind::Quadrilateral,
        dimension: 2,
        extruded: Some("hex8_reduced_assumed_strain"),
        is_default: false,
    }
);
