//! `shell2`: a shell of two nodes in 2D, in plane strain, plane stress (a beam of rectangular section) or of
//! revolution.
//!
//! φ is the direction of the shell's tangent at a node: at the start the mean of the elements around it that
//! are smooth to each other. With φ̄ = ½ (φ₁ + φ₂), δ = φ₂ − φ₁, t̂ = (cos φ̄, sin φ̄), n̂ = (−sin φ̄, cos
//! φ̄):
//!
//! ```text
//! l = t̂·(x₂ − x₁),   s = n̂·(x₂ − x₁),   layers at z are l_z = l − z δ long: a stack of bars
//! Δε_xx = 2 (l_z − l_z,old)/(l_z + l_z,old),   2 Δε_xy = √k 2 (s − s_old)/(l + l_old),   k = 5/6
//! of revolution Δε_zz = 2 (r_z − r_z,old)/(r_z + r_z,old),   r_z = ½ (x₁ + x₂) − z ½ (sin φ₁ + sin φ₂)
//! N = Σ σ_xx A,   M = −Σ σ_xx A z,   Q = √k Σ σ_xy A l_z/l
//! ```
//!
//! δ itself, not its chord, so that the roll-up of a strip is exact with any number of elements. The work N
//! dl + Q ds + M dδ makes the force −(N t̂ + Q n̂) on the second node, its opposite on the first, and the
//! moments −½ (N s − Q l) ± M on the first and the second: both momenta are kept to round-off. The hoop
//! stress pulls inwards with ½ Σ σ_zz A/r l_z, and with moments. Stress is kept along t̂ and n̂, so nothing
//! has to be rotated.
//!
//! Of laws in rate form heights z follow the thickness; hyperelastic ones keep those of the start, so that
//! forces are the gradient of the energy.
//!
//! *Step.* Membrane, bending and shear of one element are orthogonal: with its mass m, section A, E* = E/(1 −
//! ν²) or E, m ω² = max(4 E* A/l, 4 E* A t²/(12 α l), k µ A l (4/l² + 1/α)), and besides what a normal force
//! N adds through the rotations, |N|/l (√(d² + 4 b²) ± d)/2 with d = l²/α, b = 2 l/√α (minus: taut), and a
//! transverse force |Q| (b + d |s|/l)/l. α is chosen such that the first is the largest: max(t²/12, l²/(4
//! (E*/(kµ) − 1))). Of revolution, where bending around the axis is not orthogonal to shear, max(membrane,
//! shear) + bending with a = 4/l², b = 1/r²: membrane ½ E* (a + b + √((a − b)² + 4 ν² a b)).
//!
//! A middle at o from the nodes: heights are z + o, t²/12 becomes t²/12 + o², and membrane and bending, which
//! are no longer orthogonal, are added.
//!
//! Derived for this program; the lineage is Hughes and Liu, Comput. Meth. Appl. Mech. Engng 27 (1981)
//! 167-181, and Simo and Vu-Quoc, J. Appl. Mech. 53 (1986) 849-854.

use super::{Answer, Corners, Facts, Layers, Pose, Pulls, ShellKernel, Start, Strains, Tensor};
use crate::angle::{angle_of, cos_sin_of};
use crate::block::SHELL_VALUES;
use crate::material::Family;
use crate::material::points::RESPONSE;
use crate::tensor::SymmetricTensor;
use crate::vector::{dot, minus};
use embate_lanes::{Batch, Lane};
use std::f64::consts::{PI, TAU};

/// Shear factor of a rectangular section.
const SHEAR: f64 = 5.0 / 6.0;

/// Places in the state: φ̄, δ, l, s at the start; R̄ and the mean of the normals' x there; then l, s, δ, r̄
/// and the mean of the normals' x now, cos φ̄, sin φ̄, cos φ₁, cos φ₂.
const MEAN: usize = 0;
const BEND: usize = 1;
const LENGTH: usize = 2;
const SLIDE: usize = 3;
const RADIUS: usize = 4;
const LEAN: usize = 5;
/// The last five, now.
const NOW: usize = 6;
const AXES: usize = 11;
const STATE: usize = 15;

/// The two nodes of a line.
#[derive(Clone, Copy, Debug)]
pub(in crate::block) struct Line;

/// Length, slide, bend, mean radius and mean of the normals' x.
#[derive(Clone, Copy)]
struct Shape<L> {
    length: L,
    slide: L,
    bend: L,
    radius: L,
    lean: L,
}

impl<L: Lane> Shape<L> {
    #[inline(always)]
    fn load(state: &[Batch], first: usize, at: usize) -> Self {
        Self {
            length: L::load(&state[first], at),
            slide: L::load(&state[first + 1], at),
            bend: L::load(&state[first + 2], at),
            radius: L::load(&state[first + 3], at),
            lean: L::load(&state[first + 4], at),
        }
    }

    #[inline(always)]
    fn store(self, state: &mut [Batch], at: usize) {
        self.length.store(&mut state[NOW], at);
        self.slide.store(&mut state[NOW + 1], at);
        self.bend.store(&mut state[NOW + 2], at);
        self.radius.store(&mut state[NOW + 3], at);
        self.lean.store(&mut state[NOW + 4], at);
    }

    /// At the start.
    #[inline(always)]
    fn start(state: &[Batch], at: usize) -> Self {
        Self {
            length: L::load(&state[LENGTH], at),
            slide: L::load(&state[SLIDE], at),
            bend: L::load(&state[BEND], at),
            radius: L::load(&state[RADIUS], at),
            lean: L::load(&state[LEAN], at),
        }
    }

    /// Length of the layer at a height.
    #[inline(always)]
    fn layer(&self, height: L) -> L {
        self.length - height * self.bend
    }

    /// Radius of the layer at a height.
    #[inline(always)]
    fn radius_at(&self, height: L) -> L {
        self.radius + height * self.lean
    }

    /// That where it is there.
    #[inline(always)]
    fn or(self, live: L, other: Self) -> Self {
        let there = L::splat(0.5).less(live);
        Self {
            length: L::select(there, self.length, other.length),
            slide: L::select(there, self.slide, other.slide),
            bend: L::select(there, self.bend, other.bend),
            radius: L::select(there, self.radius, other.radius),
            lean: L::select(there, self.lean, other.lean),
        }
    }
}

/// The shape of an element, and its axes: cos φ̄, sin φ̄, cos φ₁, cos φ₂.
#[inline(always)]
fn shape<L: Lane>([x, y]: [[L; 2]; 2], mean: L, bend: L) -> (Shape<L>, [L; 4]) {
    let [cos, sin] = cos_sin_of(mean);
    let half = L::splat(0.5);
    let [cos_half, sin_half] = cos_sin_of(half * bend);
    let (dx, dy) = (y[0] - x[0], y[1] - x[1]);
    let shape =
        Shape { length: cos * dx + sin * dy, slide: cos * dy - sin * dx, bend, radius: half * (x[0] + y[0]), lean: -(sin * cos_half) };
    (shape, [cos, sin, cos * cos_half + sin * sin_half, cos * cos_half - sin * sin_half])
}

impl Line {
    /// Inertia of a node by its mass, m²: see the head of the file.
    fn inertia(facts: &Facts, thickness: f64, [length, radius]: [f64; 2]) -> f64 {
        let [membrane, shear, _] = facts.moduli;
        let shear = SHEAR * shear;
        let reach = thickness * facts.reach();
        let least = reach * reach / 12.0;
        if !facts.is_axisymmetric {
            return least.max(length * length / (4.0 * (membrane / shear - 1.0)));
        }
        let all = Self::of_revolution(membrane, facts.contracting(shear / SHEAR), [length, radius]);
        let rest = all - 4.0 * shear / (length * length);
        if rest > 0.0 { least.max((shear + all * least) / rest) } else { least.max(0.25 * length * length) }
    }

    /// ½ E* (a + b + √((a − b)² + 4 ν² a b)).
    #[inline(always)]
    fn of_revolution<L: Lane>(membrane: L, shear: L, [length, radius]: [L; 2]) -> L {
        let (one, four, half) = (L::splat(1.0), L::splat(4.0), L::splat(0.5));
        let (a, b) = (four / (length * length), one / (radius * radius));
        // 1 − ν with E/(1 − ν²) = 2 µ/(1 − ν).
        let poisson = one - L::splat(2.0) * shear / membrane;
        half * membrane * (a + b + ((a - b) * (a - b) + four * poisson * poisson * a * b).sqrt())
    }
}

impl ShellKernel<2> for Line {
    type Tensor = Tensor<2, f64>;
    const NODES: usize = 2;
    const STATE: usize = STATE;
    const POSE: Pose = Pose::Angle;

    fn directions(connectivity: &[u32], positions: &[[f64; 2]], fold: f64) -> Vec<[f64; 2]> {
        let lines = connectivity.as_chunks::<2>().0;
        let own: Vec<[f64; 2]> = lines
            .iter()
            .map(|&[a, b]| {
                let d = minus(positions[b as usize], positions[a as usize]);
                let length = dot(d, d).sqrt();
                d.map(|d| d / length)
            })
            .collect();
        // Elements at each node.
        let mut at: Vec<(u32, usize)> = connectivity.iter().enumerate().map(|(k, &node)| (node, k)).collect();
        at.sort_unstable();
        let mut directions = vec![[0.0; 2]; connectivity.len()];
        for around in at.chunk_by(|a, b| a.0 == b.0) {
            for &(_, k) in around {
                let tangent = own[k / 2];
                // A neighbour may run the other way.
                let mut sum = [0.0; 2];
                for &(_, other) in around {
                    let sign = if other % 2 == k % 2 && other != k { -1.0 } else { 1.0 };
                    let theirs = own[other / 2].map(|t| sign * t);
                    if other == k || dot(tangent, theirs) >= fold {
                        sum = [sum[0] + theirs[0], sum[1] + theirs[1]];
                    }
                }
                let length = dot(sum, sum).sqrt();
                directions[k] = sum.map(|s| s / length);
            }
        }
        directions
    }

    fn start(facts: &Facts, positions: &[[f64; 2]], directions: &[[f64; 2]], thickness: f64) -> Start {
        let [x, y] = [positions[0], positions[1]];
        let d = minus(y, x);
        let chord = dot(d, d).sqrt();
        // Angles of the nodes' tangents against the chord: exact for any direction of it.
        let turned = |[a, b]: [f64; 2]| angle_of([a * d[0] + b * d[1], b * d[0] - a * d[1]]);
        let [one, two] = [turned(directions[0]), turned(directions[1])];
        let (mean, bend) = (angle_of(d) + 0.5 * (one + two), two - one);
        let (now, axes) = shape::<f64>([x, y], mean, bend);
        let mut state = vec![mean, bend, now.length, now.slide, now.radius, now.lean];
        state.extend([now.length, now.slide, now.bend, now.radius, now.lean]);
        state.extend(axes);
        let areas = if facts.is_axisymmetric {
            [(x[0], y[0]), (y[0], x[0])].map(|(own, other)| TAU * chord * (2.0 * own + other) / 6.0)
        } else {
            [0.5 * chord; 2]
        };
        let layers = facts.section.heights.iter().zip(&facts.section.weights);
        let volumes = layers.map(|(height, weight)| {
            let height = height * thickness;
            let around = if facts.is_axisymmetric { TAU * now.radius_at(height) } else { 1.0 };
            thickness * weight * now.layer(height) * around
        });
        Start { state, areas: areas.to_vec(), volumes: volumes.collect(), inertia: Self::inertia(facts, thickness, [chord, now.radius]) }
    }

    #[inline(always)]
    fn strain<L: Lane>(
        facts: &Facts,
        corners: &Corners<'_, 2>,
        state: &mut [Batch],
        _: &mut [Batch],
        strains: &mut Strains<'_>,
        at: usize,
    ) {
        let (half, one, two, zero) = (L::splat(0.5), L::splat(1.0), L::splat(2.0), L::splat(0.0));
        let ((one_place, [one_angle, ..]), (other_place, [other_angle, ..])) = (corners.of::<L>(0, at), corners.of::<L>(1, at));
        let (places, angles) = ([one_place, other_place], [one_angle, other_angle]);
        let live = L::load(strains.live, at);
        let there = half.less(live);
        let begin = Shape::<L>::start(state, at);
        let before = Shape::<L>::load(state, NOW, at);
        let mean = L::load(&state[MEAN], at) + half * (angles[0] + angles[1]);
        let (now, axes) = shape(places, mean, begin.bend + (angles[1] - angles[0]));
        let now = now.or(live, before);
        now.store(state, at);
        for k in 0..4 {
            let kept = L::load(&state[AXES + k], at);
            L::select(there, axes[k], kept).store(&mut state[AXES + k], at);
        }
        let shear = L::splat(SHEAR.sqrt());
        let (thickness, initial) = (L::load(strains.thickness[0], at), L::load(strains.thickness[1], at));
        let is_rate = matches!(facts.family, Family::Rate);
        let heights = if is_rate { thickness } else { initial };
        let slip = if is_rate {
            shear * (now.slide - before.slide) / (now.length + before.length)
        } else {
            shear * (now.slide / begin.length - begin.slide / begin.length)
        };
        for (p, (&height, &weight)) in facts.section.heights.iter().zip(&facts.section.weights).enumerate() {
            let z = L::splat(height) * heights;
            let (new, old) = (now.layer(z), before.layer(z));
            let (xx, mut yy, mut zz, mut xy) = (if is_rate { two * (new - old) / (new + old) } else { zero }, zero, zero, slip);
            let (mut volume, mut ratio, mut along) = (initial * L::splat(weight), one, xx);
            let (start, r_new, r_old, r_start) = (begin.layer(z), now.radius_at(z), before.radius_at(z), begin.radius_at(z));
            if is_rate {
                volume = volume * half * (new + old);
                if facts.is_axisymmetric {
                    zz = two * (r_new - r_old) / (r_new + r_old);
                    volume = volume * L::splat(PI) * (r_new + r_old);
                }
                if facts.needs_ratio {
                    ratio = new / start;
                    ratio = if facts.is_axisymmetric { ratio * (r_new / r_start) } else { ratio };
                }
            } else {
                let stretch = new / start;
                volume = volume * start;
                (along, yy, zz, xy) = (stretch * stretch, slip * slip, one, stretch * slip);
                ratio = stretch;
                if facts.is_axisymmetric {
                    let around = r_new / r_start;
                    (zz, ratio) = (around * around, ratio * around);
                    volume = volume * L::splat(TAU) * r_start;
                }
            }
            // What is not there, or only fills the batch up, is not strained.
            let rest = if is_rate { zero } else { one };
            let own = &mut strains.strain[p * facts.components..][..facts.components];
            L::select(there, along, rest).store(&mut own[0], at);
            L::select(there, yy, zero).store(&mut own[1], at);
            L::select(there, zz, rest).store(&mut own[2], at);
            L::select(there, xy, zero).store(&mut own[3], at);
            L::select(there, volume, zero).store(&mut strains.volume[p], at);
            L::select(there, ratio, one).store(&mut strains.ratio[p], at);
        }
    }

    #[inline(always)]
    fn forces<L: Lane>(
        facts: &Facts,
        state: &mut [Batch],
        _: &[Batch],
        layers: &Layers<'_>,
        inertia: L,
        pulls: &mut Pulls<'_, L, 2>,
        at: usize,
    ) -> Answer<L> {
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let (now, begin) = (Shape::<L>::load(state, NOW, at), Shape::<L>::start(state, at));
        let (cos, sin) = (L::load(&state[AXES], at), L::load(&state[AXES + 1], at));
        let (cos_one, cos_two) = (L::load(&state[AXES + 2], at), L::load(&state[AXES + 3], at));
        let initial = L::load(layers.thickness, at);
        let is_rate = matches!(facts.family, Family::Rate);
        let thickness = layers.thickness_now::<L>(facts, at);
        let heights = if is_rate { thickness } else { initial };
        // Normal force, moment, transverse force; of revolution also what pulls inwards, and its moment.
        let (mut normal, mut moment, mut transverse, mut hoop, mut hoop_moment) = (zero, zero, zero, zero, zero);
        let (mut section, mut membrane, mut shear) = (zero, zero, zero);
        let (over, over_begin) = (one / now.length, one / begin.length);
        let (mut shortest, mut nearest) = (now.length, now.radius);
        for (p, (&height, &weight)) in facts.section.heights.iter().zip(&facts.section.weights).enumerate() {
            let [_, stretch] = layers.stretches::<L>(facts, p, at);
            let [xx, _, zz, xy] = layers.stress_of::<Tensor<2, L>, L>(p, at).0;
            let (bulk, stiff) = (L::load(&layers.response[p * RESPONSE + 2], at), L::load(&layers.response[p * RESPONSE + 3], at));
            let z = L::splat(height) * heights;
            let length = now.layer(z);
            let plate = initial * L::splat(weight) * stretch;
            let area = if facts.is_axisymmetric { plate * L::splat(TAU) * now.radius_at(z) } else { plate };
            let pull = xx * area;
            normal += pull;
            moment += -(pull * z);
            // As the strain counts in it: by the length of the layer over that of the middle.
            let part = if is_rate { length * over } else { begin.layer(z) * over_begin };
            transverse += xy * area * part;
            if facts.is_axisymmetric {
                let own = zz * plate * L::splat(TAU) * length;
                hoop += own;
                hoop_moment += own * z;
                nearest = nearest.min(now.radius_at(z));
            } else {
                hoop += zz * area;
                hoop_moment += -(zz * area * z);
            }
            section += area;
            membrane = membrane.max(facts.membrane_bound(bulk, stiff));
            shear = shear.max(stiff);
            shortest = shortest.min(length);
        }
        transverse = L::splat(SHEAR.sqrt()) * transverse;
        let mut determinant = one.min(shortest * over).min(now.length * over_begin);
        if facts.is_axisymmetric {
            determinant = determinant.min(nearest / now.radius);
        }
        let (fx, fy) = (normal * cos - transverse * sin, normal * sin + transverse * cos);
        let common = half * (normal * now.slide - transverse * now.length);
        let (inwards, [one_more, two_more]) = if facts.is_axisymmetric {
            (half * hoop, [half * hoop_moment * cos_one, half * hoop_moment * cos_two])
        } else {
            (zero, [zero; 2])
        };
        pulls.put(0, [fx - inwards, fy], [zero, zero, moment - common + one_more]);
        pulls.put(1, [-fx - inwards, -fy], [zero, zero, -moment - common + two_more]);
        Answer {
            stiffness: bound(facts, &now, [normal, transverse], section, [membrane, shear], [inertia, L::splat(facts.reach()) * heights]),
            determinant,
            thickness,
            hourglass: zero,
            besides: [zero; 2],
            flow: [zero; 3],
            resultants: resultants(facts, &now, [normal, hoop, moment, hoop_moment, transverse], thickness),
        }
    }

    #[inline(always)]
    fn elastic<L: Lane>(facts: &Facts, strain: &[Batch], [bulk, shear]: [L; 2], at: usize) -> [L; 6] {
        let [xx, _, zz, xy] = Tensor::<2, L>::load(strain, at).0;
        let (zero, two) = (L::splat(0.0), L::splat(2.0));
        let modulus = facts.membrane_modulus(bulk, shear);
        // E/(1 − ν²) ν = E/(1 − ν²) − 2 µ.
        let across = if facts.is_plane_stress { zero } else { modulus - two * shear };
        let around = if facts.is_plane_stress { zero } else { modulus * zz + across * xx };
        [modulus * xx + across * zz, zero, around, two * shear * xy, zero, zero]
    }

    fn turned(state: &[Batch], [xx, yy, zz, xy, ..]: [f64; 6], _: usize, lane: usize) -> [f64; 6] {
        let [cos, sin] = [0, 1].map(|k| state[AXES + k].0[lane]);
        [
            xx * cos * cos + yy * sin * sin - 2.0 * xy * cos * sin,
            xx * sin * sin + yy * cos * cos + 2.0 * xy * cos * sin,
            zz,
            (xx - yy) * cos * sin + xy * (cos * cos - sin * sin),
            0.0,
            0.0,
        ]
    }
}

/// m ω² of the head of the file, N/m.
#[inline(always)]
fn bound<L: Lane>(
    facts: &Facts,
    now: &Shape<L>,
    [normal, transverse]: [L; 2],
    section: L,
    [membrane, shear]: [L; 2],
    [inertia, thickness]: [L; 2],
) -> L {
    let (half, one, four) = (L::splat(0.5), L::splat(1.0), L::splat(4.0));
    let length = now.length;
    let (over, turning) = (one / length, one / inertia);
    let bend = thickness * thickness * L::splat(1.0 / 12.0) * turning;
    let across = L::splat(SHEAR) * shear * section * length * (four * over * over + turning);
    let material = if facts.is_axisymmetric {
        let along = section * length * Line::of_revolution(membrane, facts.contracting(shear), [length, now.radius]);
        let apart = along.max(across) + along * bend;
        if facts.section.middle == 0.0 { apart } else { along + along * bend + across }
    } else {
        let along = four * membrane * section * over;
        // Beside the nodes a middle that is stretched bends, too.
        let both = if facts.section.middle == 0.0 { along.max(along * bend) } else { along + along * bend };
        both.max(across)
    };
    // b² = 4 l²/α = 4 d.
    let d = length * length * turning;
    let b = L::splat(2.0) * d.sqrt();
    let root = (d * d + L::splat(16.0) * d).sqrt();
    let taut = L::select(L::splat(0.0).less(normal), root - d, root + d);
    material + (half * normal.abs() * taut + transverse.abs() * (b + d * now.slide.abs() * over)) * over
}

/// Forces and moments per width: along the shell, and out of the plane or around the axis.
#[inline(always)]
fn resultants<L: Lane>(
    facts: &Facts,
    now: &Shape<L>,
    [normal, hoop, moment, hoop_moment, transverse]: [L; 5],
    thickness: L,
) -> [L; SHELL_VALUES] {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let mut values = [zero; SHELL_VALUES];
    let (around, along) =
        if facts.is_axisymmetric { (one / (L::splat(TAU) * now.radius), one / (L::splat(TAU) * now.length)) } else { (one, one) };
    values[0] = normal * around;
    values[1] = hoop * along;
    values[3] = moment * around;
    values[4] = if facts.is_axisymmetric { -(hoop_moment * along) } else { hoop_moment };
    values[6] = transverse * around;
    values[8] = thickness;
    values
}
