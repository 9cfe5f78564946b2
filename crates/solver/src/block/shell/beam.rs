//! `beam2`: a beam of two nodes in 3D.
//!
//! Each node has a triad that is fixed to it; at the start both are those of the element, axis 1 along it, 2
//! and 3 (y and z) those of the cross-section. With their quaternions q₁ and q₂ (of the two signs of q₂ the
//! nearer to q₁) the element sees the two nodes from half way between them:
//!
//! ```text
//! q̄ = (q₁ + q₂)/2c,   c = ½ |q₁ + q₂| = cos(δ/4),   p = vec(q̄* q₂) = sin(δ/4) e
//! Γ = R̄ᵀ (x₂ − x₁) = (l, s_y, s_z),   ψ = δ e, δ = 4 atan2(|p|, c): the rotation from node 1 to node 2
//! a fibre at (y, z) is l + z ψ₂ − y ψ₃ long: a stack of bars, each with the law under uniaxial stress
//! N = Σ σ A,   M₂ = Σ σ A z,   M₃ = −Σ σ A y
//! Q_y = k_y µ A s_y/L,   Q_z = k_z µ A s_z/L,   M₁ = µ J ψ₁/L, with µ and L of the start
//! ```
//!
//! Transverse shear and torsion are elastic: potentials of the start. The arc δ itself, not its chord, so
//! that a beam rolls up exactly with any number of elements; dψ = H (dφ₂ − dφ₁) seen from half way, where
//! H = f 1 + (1 − f) e eᵀ, f = (δ/2)/sin(δ/2). With n = (N, Q_y, Q_z) and m = n × Γ the work is
//!
//! ```text
//! dW = n·d(x₂ − x₁) + (½ m − w)·dφ₁ + (½ m + w)·dφ₂,   w = H M + p × m/2c
//! ```
//!
//! whose forces and moments keep both momenta to round-off. Nothing depends on which node is the first: the
//! section is the same from behind. A rotation of both nodes is no strain, whatever its size; nearly half a
//! turn of one against the other counts as inverted, for nothing says which way it went.
//!
//! Of laws in rate form y and z follow the square root of the area; hyperelastic ones keep those of the
//! start, so that forces are the gradient of the energy.
//!
//! *Step.* At rest stretch, bending, torsion and shear are orthogonal: m ω² = max(4 E A/l, 4 E I/(α l), 4 µ
//! J/(α l), k µ A l (4/l² + 1/α)), and α is chosen such that the first is the largest: max(I/A, µ J/(E A),
//! l²/(4 (E/(k µ) − 1))). A slide s = |(s_y, s_z)| makes rotations stretch the beam: of E A/l (4 + s²/α), k µ
//! A/L (4 + (l² + s²)/α) and what both have in common, s l/α, it is the larger eigenvalue; rotations of the
//! nodes against each other join bending and shear at the cosine t = tan(δ/4). E is E + |σ| of what is
//! compressed, as of bars. Besides forces add by rotating what they add in `shell2`, and ½ (|N| s + |Q|
//! l)/α + |M|/α.
//!
//! Derived for this program; the lineage is Simo and Vu-Quoc, Comput. Meth. Appl. Mech. Engng 58 (1986)
//! 79-116, and Crisfield and Jelenić, Proc. R. Soc. A 455 (1999) 1125-1147.

use super::bound;
use super::surface::{Vector, loaded, replace, rotated, scaled};
use super::{Answer, Corners, Facts, Layers, Pose, Pulls, ShellKernel, Start, Strains};
use crate::angle::arc_of_tangent;
use crate::block::SHELL_VALUES;
use crate::material::Family;
use crate::material::points::RESPONSE;
use crate::model::beam_axes;
use crate::tensor::{Plane, cross, dot};
use crate::vector::{minus, plus};
use embate_lanes::{Batch, Lane};

/// w, x, y, z.
type Quaternion<L> = [L; 4];

/// Places in the state: triad and length at the start; now Γ, ψ, p, c and q̄; forces of the damping against
/// s_y, s_z and ψ₁, and what it has taken.
const TRIAD: usize = 0;
const LENGTH: usize = 4;
const SHAPE: usize = 5;
const PART: usize = 11;
const FRAME: usize = 15;
const DAMPED: usize = 19;
const TAKEN: usize = 22;
const STATE: usize = 23;

/// Least cosine of half the rotation between the nodes.
const STRAIGHT: f64 = 0.05;

/// The two nodes of a beam.
#[derive(Clone, Copy, Debug)]
pub(in crate::block) struct Beam;

/// What both nodes are to each other.
#[derive(Clone, Copy)]
struct Shape<L> {
    /// Γ and ψ.
    gamma: Vector<L>,
    psi: Vector<L>,
    /// p, c and q̄.
    part: Vector<L>,
    cosine: L,
    frame: Quaternion<L>,
}

/// a, then b, as rotations from the right to the left.
#[inline(always)]
fn product<L: Lane>(a: Quaternion<L>, b: Quaternion<L>) -> Quaternion<L> {
    let (u, v) = ([a[1], a[2], a[3]], [b[1], b[2], b[3]]);
    let axis = plus(plus(scaled(a[0], v), scaled(b[0], u)), cross(u, v));
    [a[0] * b[0] - dot(u, v), axis[0], axis[1], axis[2]]
}

impl<L: Lane> Shape<L> {
    /// From the way from node 1 to node 2, and the triads of both; beside it 1/c, t² = |p|²/c² and 1 −
    /// atan(t)/t over t².
    #[inline(always)]
    fn new(way: Vector<L>, [one, mut two]: [Quaternion<L>; 2]) -> (Self, [L; 3]) {
        let (zero, half, unit) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let along = one[0] * two[0] + one[1] * two[1] + one[2] * two[2] + one[3] * two[3];
        let sign = L::select(along.less(zero), -unit, unit);
        let (mut frame, mut square) = ([zero; 4], zero);
        for k in 0..4 {
            two[k] = sign * two[k];
            frame[k] = one[k] + two[k];
            square += frame[k] * frame[k];
        }
        let size = square.sqrt();
        let over = unit / size;
        for k in 0..4 {
            frame[k] = over * frame[k];
        }
        // vec(q₁* q₂): no rotation between equal triads, to the last bit.
        let (u, v) = ([one[1], one[2], one[3]], [two[1], two[2], two[3]]);
        let between = minus(minus(scaled(one[0], v), scaled(two[0], u)), cross(u, v));
        let part = scaled(over, between);
        let (cosine, secant) = (half * size, over + over);
        let slope = dot(part, part) * (secant * secant);
        let rest = arc_of_tangent(slope);
        let psi = scaled(L::splat(4.0) * secant * (unit - slope * rest), part);
        let back = [frame[0], -frame[1], -frame[2], -frame[3]];
        (Self { gamma: rotated(back, way), psi, part, cosine, frame }, [secant, slope, rest])
    }

    #[inline(always)]
    fn load(state: &[Batch], at: usize) -> Self {
        let (shape, part) = (loaded::<L, 6>(state, SHAPE, at), loaded::<L, 4>(state, PART, at));
        Self {
            gamma: [shape[0], shape[1], shape[2]],
            psi: [shape[3], shape[4], shape[5]],
            part: [part[0], part[1], part[2]],
            cosine: part[3],
            frame: loaded(state, FRAME, at),
        }
    }

    #[inline(always)]
    fn all(&self) -> [L; 14] {
        let Self { gamma: g, psi: s, part: p, cosine, frame: f } = *self;
        [g[0], g[1], g[2], s[0], s[1], s[2], p[0], p[1], p[2], cosine, f[0], f[1], f[2], f[3]]
    }

    /// Length of the fibre at a place.
    #[inline(always)]
    fn fibre(&self, [y, z]: [L; 2]) -> L {
        self.gamma[0] + z * self.psi[1] - y * self.psi[2]
    }

    /// H M.
    #[inline(always)]
    fn spread(&self, moment: Vector<L>, [secant, slope, rest]: [L; 3]) -> Vector<L> {
        let one = L::splat(1.0);
        let square = secant * secant;
        // f = (atan t/t)/c², and (1 − f)/|p|².
        let straight = (one - slope * rest) * square;
        let along = (rest * square - one) * square;
        plus(scaled(straight, moment), scaled(along * dot(self.part, moment), self.part))
    }
}

/// The quaternion of a matrix with these columns.
fn of_columns([x, y, z]: [[f64; 3]; 3]) -> [f64; 4] {
    // Four times the square of each part; the largest is at least one.
    let squares = [1.0 + x[0] + y[1] + z[2], 1.0 + x[0] - y[1] - z[2], 1.0 - x[0] + y[1] - z[2], 1.0 - x[0] - y[1] + z[2]];
    let largest = (0..4).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    let half = 0.5 / squares[largest].sqrt();
    let (wx, wy, wz) = (y[2] - z[1], z[0] - x[2], x[1] - y[0]);
    let (xy, yz, zx) = (x[1] + y[0], y[2] + z[1], z[0] + x[2]);
    let all = match largest {
        0 => [squares[0], wx, wy, wz],
        1 => [wx, squares[1], xy, zx],
        2 => [wy, xy, squares[2], yz],
        _ => [wz, zx, yz, squares[3]],
    };
    all.map(|part| half * part)
}

/// Stiffness against s_y, s_z and ψ₁ by their change: k µ A/L and µ J/L.
#[inline(always)]
fn besides<L: Lane>(facts: &Facts, length: L) -> Vector<L> {
    let (profile, shear) = (&facts.profile, facts.at_rest[1]);
    let of = [shear * profile.shear[0] * profile.area, shear * profile.shear[1] * profile.area, shear * profile.torsion];
    let over = L::splat(1.0) / length;
    [L::splat(of[0]) * over, L::splat(of[1]) * over, L::splat(of[2]) * over]
}

impl ShellKernel<3> for Beam {
    type Tensor = Plane<f64>;
    const NODES: usize = 2;
    const STATE: usize = STATE;
    /// What [`Shape::new`] gives beside the shape.
    const PASSED: usize = 3;
    const POSE: Pose = Pose::Attitude;

    /// None: its triads follow from the section.
    fn directions(connectivity: &[u32], _: &[[f64; 3]], _: f64) -> Vec<[f64; 3]> {
        vec![[0.0; 3]; connectivity.len()]
    }

    fn start(facts: &Facts, positions: &[[f64; 3]], _: &[[f64; 3]], area: f64) -> Start {
        let profile = &facts.profile;
        let way = minus(positions[1], positions[0]);
        let length = dot(way, way).sqrt();
        let along = scaled(1.0 / length, way);
        // That its height is across is seen before.
        let triad = of_columns(beam_axes(along, profile.up).or_else(|| beam_axes(along, None)).unwrap_or_default());
        let (shape, _) = Shape::<f64>::new(way, [triad; 2]);
        let mut state: Vec<f64> = triad.into_iter().chain([length]).chain(shape.all()).collect();
        state.resize(STATE, 0.0);
        let [young, shear, _] = facts.moduli;
        let (round, factor) = (profile.inertia[0].max(profile.inertia[1]), profile.shear[0].max(profile.shear[1]));
        let by_shear = young / (factor * shear) - 1.0;
        let sheared = if by_shear > 0.0 { length * length / (4.0 * by_shear) } else { 0.25 * length * length };
        let inertia = (round / area).max(shear * profile.torsion / (young * area)).max(sheared);
        let volumes = facts.section.weights.iter().map(|weight| area * weight * length).collect();
        Start { state, areas: vec![0.5 * length; 2], volumes, inertia }
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
        let (half, one, two, zero) = (L::splat(0.5), L::splat(1.0), L::splat(2.0), L::splat(0.0));
        let there = half.less(L::load(strains.live, at));
        let triad = loaded::<L, 4>(state, TRIAD, at);
        let (mut x, mut q) = ([[zero; 3]; 2], [triad; 2]);
        for a in 0..2 {
            let (own, rotation) = corners.of(a, at);
            (x[a], q[a]) = (own, product(rotation, triad));
        }
        let before = Shape::<L>::load(state, at);
        let (now, arc) = Shape::new(minus(x[1], x[0]), q);
        for k in 0..3 {
            arc[k].store(&mut passed[k], at);
        }
        replace(there, &now.all(), state, SHAPE, at);
        damp(facts, [&before, &now], strains.damping, there, state, at);
        let length = L::load(&state[LENGTH], at);
        let (section, initial) = (L::load(strains.thickness[0], at), L::load(strains.thickness[1], at));
        let is_rate = matches!(facts.family, Family::Rate);
        let scale = if is_rate { (section / initial).sqrt() } else { one };
        let over = one / length;
        for p in 0..facts.section.weights.len() {
            let place = [L::splat(facts.section.sides[p]) * scale, L::splat(facts.section.heights[p]) * scale];
            let (new, old) = (now.fibre(place), before.fibre(place));
            let stretch = new * over;
            let area = initial * L::splat(facts.section.weights[p]);
            let (along, rest, volume) = if is_rate {
                (two * (new - old) / (new + old), zero, area * half * (new + old))
            } else {
                (stretch * stretch, one, area * length)
            };
            // What is not there, or only fills the batch up, is not strained.
            let own = &mut strains.strain[p * facts.components..][..facts.components];
            L::select(there, along, rest).store(&mut own[0], at);
            rest.store(&mut own[1], at);
            rest.store(&mut own[2], at);
            zero.store(&mut own[3], at);
            L::select(there, volume, zero).store(&mut strains.volume[p], at);
            L::select(there, stretch, one).store(&mut strains.ratio[p], at);
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
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let now = Shape::<L>::load(state, at);
        let length = L::load(&state[LENGTH], at);
        let initial = L::load(layers.thickness, at);
        let mut section = zero;
        for (p, &weight) in facts.section.weights.iter().enumerate() {
            let [_, stretch] = layers.stretches::<L>(facts, p, at);
            section += L::splat(weight) * stretch;
        }
        let square = if matches!(facts.family, Family::Rate) { section } else { one };
        let section = initial * section;
        let scale = square.sqrt();
        let (mut force, mut moment) = ([zero; 3], [zero; 3]);
        let (mut young, mut shortest) = (zero, now.gamma[0]);
        for (p, &weight) in facts.section.weights.iter().enumerate() {
            let [_, stretch] = layers.stretches::<L>(facts, p, at);
            let [along, ..] = layers.stress_of::<Plane<L>, L>(p, at).0;
            let (bulk, stiff) = (L::load(&layers.response[p * RESPONSE + 2], at), L::load(&layers.response[p * RESPONSE + 3], at));
            let [y, z] = [L::splat(facts.section.sides[p]) * scale, L::splat(facts.section.heights[p]) * scale];
            let pull = along * initial * L::splat(weight) * stretch;
            force[0] += pull;
            moment[1] += pull * z;
            moment[2] += -(pull * y);
            // The section of what is compressed grows: bars have E + |σ|.
            young = young.max(facts.membrane_modulus(bulk, stiff) + (-along).max(zero));
            shortest = shortest.min(now.fibre([y, z]));
        }
        let (held, damped) = (besides(facts, length), loaded::<L, 3>(state, DAMPED, at));
        let slides = [now.gamma[1], now.gamma[2], now.psi[0]];
        let mut stored = zero;
        for k in 0..3 {
            let elastic = held[k] * slides[k];
            stored += half * elastic * slides[k];
            if k < 2 { force[k + 1] = elastic + damped[k] } else { moment[0] = elastic + damped[k] }
        }
        let arc = loaded::<L, 3>(passed, 0, at);
        pull(&now, force, moment, arc, pulls);
        let halved = L::splat(2.0) * now.cosine * now.cosine - one - L::splat(STRAIGHT);
        Answer {
            stiffness: bound(facts, &now, arc, [force, moment], [section, square, young], [length, inertia]),
            determinant: (shortest / now.gamma[0]).min(now.gamma[0] / length).min(halved),
            thickness: section,
            hourglass: zero,
            besides: [stored, L::load(&state[TAKEN], at)],
            flow: [zero; 3],
            resultants: resultants(force, moment),
        }
    }

    #[inline(always)]
    fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], [bulk, shear]: [L; 2], at: usize) -> [L; 6] {
        let mut stress = [L::splat(0.0); 6];
        stress[0] = facts.membrane_modulus(bulk, shear) * L::load(&strain[0], at);
        stress
    }

    fn turned(state: &[Batch], [along, ..]: [f64; 6], _: usize, lane: usize) -> [f64; 6] {
        let [x, y, z] = rotated(loaded::<f64, 4>(state, FRAME, lane), [1.0, 0.0, 0.0]);
        [x * x, y * y, z * z, x * y, y * z, z * x].map(|part| part * along)
    }
}

/// Damping of transverse shear and torsion, by their elastic stiffness.
#[inline(always)]
fn damp<L: Lane>(facts: &Facts, [before, now]: [&Shape<L>; 2], damping: f64, there: L::Mask, state: &mut [Batch], at: usize) {
    let held = besides(facts, L::load(&state[LENGTH], at));
    let steps = [now.gamma[1] - before.gamma[1], now.gamma[2] - before.gamma[2], now.psi[0] - before.psi[0]];
    let mut work = L::splat(0.0);
    for k in 0..3 {
        let old = L::load(&state[DAMPED + k], at);
        let new = L::select(there, L::splat(damping) * held[k] * steps[k], L::splat(0.0));
        work += L::splat(0.5) * (old + new) * steps[k];
        new.store(&mut state[DAMPED + k], at);
    }
    let taken = L::load(&state[TAKEN], at);
    L::select(there, taken + work, taken).store(&mut state[TAKEN], at);
}

/// Forces and moments of a normal and two transverse forces, and a torque and two bending moments.
#[inline(always)]
fn pull<L: Lane>(now: &Shape<L>, force: Vector<L>, moment: Vector<L>, arc: [L; 3], pulls: &mut Pulls<'_, L, 3>) {
    let (half, one) = (L::splat(0.5), L::splat(1.0));
    let lever = cross(force, now.gamma);
    let between = plus(now.spread(moment, arc), scaled(half * arc[0], cross(now.part, lever)));
    let common = scaled(half, lever);
    let force = rotated(now.frame, force);
    let couples = [rotated(now.frame, minus(between, common)), rotated(now.frame, scaled(-one, plus(common, between)))];
    pulls.put(0, force, couples[0]);
    pulls.put(1, scaled(-one, force), couples[1]);
}

/// m ω² of the head of the file, N/m; `square` is that of the present places of fibres by those of the start.
#[inline(always)]
fn bound<L: Lane>(
    facts: &Facts,
    now: &Shape<L>,
    [secant, tangent, rest]: [L; 3],
    [force, moment]: [Vector<L>; 2],
    [section, square, young]: [L; 3],
    [start, inertia]: [L; 2],
) -> L {
    let (zero, half, one, four) = (L::splat(0.0), L::splat(0.5), L::splat(1.0), L::splat(4.0));
    let (profile, shear) = (&facts.profile, facts.at_rest[1]);
    let length = now.gamma[0];
    let (over, over_start, turning) = (one / length, one / start, one / inertia);
    let slide = now.gamma[1] * now.gamma[1] + now.gamma[2] * now.gamma[2];
    let round = L::splat(profile.inertia[0].max(profile.inertia[1]) / profile.area) * square;
    // Stretch and slide by motion of the nodes and by their rotation, and what both have in common.
    let stiff = young * section * over;
    let sheared = L::splat(shear * profile.shear[0].max(profile.shear[1]) * profile.area) * over_start;
    let turned = (one + tangent) * turning;
    let along = stiff * (four + slide * turned);
    let across = sheared * (four + (length * length + slide) * turned);
    let apart = along - across;
    let common = four * stiff * sheared * slide * (length * turned) * (length * turned);
    let moved = half * (along + across + (apart * apart + common).sqrt());
    // Bending and torsion, whose rotations move the axes the more the nodes have rotated against each other.
    let spread = (one - tangent * rest) * secant * secant;
    let twist = L::splat(shear * profile.torsion) * over_start;
    let bent = four * spread * spread * (stiff * round).max(twist) * turning;
    let material = bound::joined([moved, bent, one.min(tangent.sqrt())], zero);
    // b² = 4 l²/α = 4 d.
    let d = length * length * turning;
    let b = L::splat(2.0) * d.sqrt();
    let root = (d * d + L::splat(16.0) * d).sqrt();
    let normal = force[0].abs();
    let taut = L::select(zero.less(force[0]), root - d, root + d);
    let transverse = (force[1] * force[1] + force[2] * force[2]).sqrt();
    let slide = slide.sqrt();
    let levers = half * (normal * slide + transverse * length) + dot(moment, moment).sqrt();
    material + (half * normal * taut + transverse * (b + d * slide * over)) * over + levers * turning
}

/// Forces and moments in the axes of the element; nothing is its thickness.
#[inline(always)]
fn resultants<L: Lane>(force: Vector<L>, moment: Vector<L>) -> [L; SHELL_VALUES] {
    let mut values = [L::splat(0.0); SHELL_VALUES];
    values[..3].copy_from_slice(&force);
    values[3..6].copy_from_slice(&moment);
    values
}
