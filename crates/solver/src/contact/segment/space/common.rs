//! The common part of two facets that face each other: where it is, the gaps in it, and how they vary with
//! the nodes.
//!
//! Nodes and positions come from the formulation ([`super`], which has the equations); rows of rates go to
//! its springs.

use super::fan::{Fans, MIDDLE, NEAR, PIECES, Sector, are_beside};
use super::polygon::{Linear, Moments};
use crate::contact::Sweep;
use crate::contact::projection::node_facet::unit;
use crate::contact::spin;
use crate::contact::springs::{End, TangentSpace};
use crate::mesh::surface::Corners;
use crate::tensor::{Dim, cross, dot};
use crate::vector::{any_tangent, length, minus};
use embate_lanes::Level;

type Vector = [f64; 3];

/// Common parts smaller than this fraction of the smaller facet are round-off.
const SLIVER: f64 = 1e-12;
/// Springs that stand for less than this fraction of the smaller facet are round-off.
const NOTHING: f64 = 1e-24;
/// Facets count whole where the cosine of the angle between them is more than this, and fade out towards a
/// right angle.
const FACING: f64 = 0.5;
/// A common part that covers less of the smaller facet than the first number needs no springs at corners for
/// that, from the second on it has them alone.
const COVERS: [f64; 2] = [0.5, 0.8];
/// The same for the square of its extent, against that of a facet in the direction in which that is most.
const SPANS: [f64; 2] = [0.6, 0.9];

/// A common part smaller than the first fraction of the smaller facet has no springs at corners, whatever it
/// spans: facets that lie corner on corner overlap their neighbours by strips that come and go.
const NARROW: [f64; 2] = [1e-4, 1e-2];

/// Cosine of the angle between a facet and one across an edge beyond which its surface turns away there.
const TURNS: f64 = 0.5;
/// The same above which it continues there in part, and in full.
const CONTINUES: [f64; 2] = [0.8, 0.95];

/// Springs of a pair at most: of the mean gap, and at the corners of a facet.
pub(super) const PARTS: usize = 5;

/// A facet as it is in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    pub(super) nodes: [u32; 4],
    pub(super) corners: [Vector; 4],
    pub(super) by_axis: [[f64; 4]; 3],
    count: usize,
    /// Mean of the corners, m.
    pub(super) middle: Vector,
    /// Unit outward normal: of four nodes that of the diagonals.
    pub(super) normal: Vector,
    /// m².
    pub(super) area: f64,
    /// All corners are nearer to the middle than this, m.
    pub(super) radius: f64,
    /// Across each edge in its own plane, as long as that, to the inner side, m, and how far along that the
    /// edge is, m².
    pub(super) inwards: [(Vector, f64); 4],
}

/// What is beyond the edges of a facet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Borders {
    /// What is nearer to an edge than this fraction of the lengths there is on it, and the same for edges
    /// within.
    pub(super) soft: [f64; 4],
    pub(super) inner: f64,
    /// Edges at which the surface ends or turns away, as bits.
    pub(super) rims: u8,
}

impl Borders {
    /// Nothing is known of the surface: all is as it is.
    pub(super) const ALONE: Self = Self { soft: [0.0; 4], inner: 0.0, rims: 0xf };

    /// With the cosines between a facet and those beyond its edges, −1 where there is none.
    pub(super) fn new(cosines: [f64; 4]) -> Self {
        let rims = (0..4).map(|k| u8::from(cosines[k] < TURNS) << k).sum();
        Self { soft: cosines.map(|cosine| NEAR * between(CONTINUES, cosine)), inner: NEAR, rims }
    }

    /// The same where nothing that is near is on an edge.
    pub(super) fn as_it_is(self) -> Self {
        Self { rims: self.rims, ..Self::ALONE }
    }
}

/// Two facets that may have something in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facets<'a> {
    pub(super) frames: [&'a Frame; 2],
    pub(super) borders: [Borders; 2],
    /// Which of both has corners that count as on edges of the other one where they are near: the same for
    /// all pairs of two surfaces or bodies.
    pub(super) cut: usize,
}

impl<'a> Facets<'a> {
    /// Those of which nothing else is known.
    pub(super) fn alone(frames: [&'a Frame; 2]) -> Self {
        Self { frames, borders: [Borders::ALONE; 2], cut: 0 }
    }
}

impl Frame {
    pub(super) fn new(nodes: [u32; 4], positions: &[Vector]) -> Self {
        let (corners, count) = (nodes.map(|node| positions[node as usize]), nodes.corners().len());
        let [a, b, c, d] = corners;
        let twice = if count == 3 { cross(minus(b, a), minus(c, a)) } else { cross(minus(c, a), minus(d, b)) };
        let middle = [0, 1, 2].map(|k| corners[..count].iter().map(|x| x[k]).sum::<f64>() / count as f64);
        let radius = corners.into_iter().map(|x| length(minus(x, middle))).fold(0.0, f64::max);
        let by_axis = [0, 1, 2].map(|k| corners.map(|x| x[k]));
        let normal = unit(twice);
        let mut inwards = [([0.0; 3], 0.0); 4];
        for k in 0..count {
            let across = cross(normal, minus(corners[if k + 1 == count { 0 } else { k + 1 }], corners[k]));
            inwards[k] = (across, dot(across, corners[k]));
        }
        Self { nodes, corners, by_axis, count, middle, normal, area: 0.5 * length(twice), radius, inwards }
    }

    /// Its nodes, each once.
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes[..self.count]
    }

    /// By what of the velocities of its corners the direction `along` × its spin goes: rows of ω·`by` with
    /// the spin ω = Θ⁻¹ Σ r × v of every rigid motion.
    pub(super) fn spins<const N: usize>(&self, by: [Vector; N]) -> [[Vector; 4]; N] {
        let arms = self.corners.map(|x| minus(x, self.middle));
        let mut inertia = [[0.0; 3]; 3];
        arms[..self.count].iter().for_each(|&arm| spin::add_arm(arm, &mut inertia));
        by.map(|by| {
            let about = spin::solved(&inertia, by);
            arms.map(|arm| cross(about, arm))
        })
    }
}

/// What a spring of a pair stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Part {
    /// Which: 0 the mean gap, then those at the corners of a facet.
    pub(super) slot: usize,
    /// m².
    pub(super) area: f64,
    /// Mean gap, m.
    pub(super) gap: f64,
    /// Shares of the corners of both facets in its mean points.
    pub(super) shares: [[f64; 4]; 2],
}

/// A piece of the common part, of one triangle of each facet.
#[derive(Clone, Copy, Default)]
struct Piece {
    sectors: [u8; 2],
    moments: Moments,
}

/// All pieces of a common part.
#[derive(Default)]
struct Pieces {
    list: [Piece; PIECES],
    count: usize,
    /// What they have together.
    whole: Moments,
    /// Deepest gap, m.
    lowest: f64,
    /// Rims of both facets at which they end, as bits.
    edges: [u8; 2],
}

/// What is found on the way to a common part.
#[derive(Default)]
pub(super) struct Room {
    fans: Fans,
    pieces: Pieces,
}

impl Pieces {
    fn set(&mut self, fans: &Fans, rims: [u8; 2]) {
        (self.count, self.whole, self.lowest, self.edges) = (0, Moments::default(), f64::INFINITY, [0; 2]);
        fans.meet(|sectors, polygon| {
            let moments = polygon.moments();
            if !(moments.area() > 0.0) {
                return;
            }
            let [a, b] = [0, 1].map(|k| fans.height(k, sectors[k]));
            let gap = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
            for [x, y] in polygon.corners() {
                let here = gap[0] + gap[1] * x + gap[2] * y;
                self.lowest = if here < self.lowest { here } else { self.lowest };
            }
            if rims != [0; 2] {
                (0..2).for_each(|k| self.edges[k] |= fans.ends(k, sectors[k], rims[k], polygon));
            }
            self.whole.add(&moments);
            self.list[self.count] = Piece { sectors: sectors.map(|sector| sector as u8), moments };
            self.count += 1;
        });
    }
}

/// The common part of two facets.
#[derive(Clone, Debug, Default)]
pub(super) struct Common {
    pub(super) frames: [Frame; 2],
    /// Unit normal of the common plane, from the second facet to the first.
    pub(super) normal: Vector,
    /// Area that counts, m².
    pub(super) area: f64,
    /// Deepest gap, m.
    pub(super) lowest: f64,
    /// Of which facet the corners have springs.
    pub(super) owner: u8,
    /// Edges of both facets at which it and its surface end, as bits.
    pub(super) edges: [u8; 2],
    parts: [Part; PARTS],
    count: usize,
}

impl Common {
    /// As [`Self::find`] says.
    pub(super) fn new(facets: &Facets<'_>, is_mean: bool, lead: f64, level: Level) -> Option<Self> {
        let mut common = Self::default();
        common.find(facets, is_mean, lead, &mut Room::default(), level).then_some(common)
    }

    /// False where facets don't face each other or have nothing in common; `is_mean`: the mean gap alone gets
    /// a spring. `lead` is 0 where the normal halves the angle between both facets, 1 where it is that of the
    /// second, −1 where that of the first.
    pub(super) fn find(&mut self, facets: &Facets<'_>, is_mean: bool, lead: f64, room: &mut Room, level: Level) -> bool {
        let frames = facets.frames;
        let [a, b] = frames;
        let facing = -dot(a.normal, b.normal);
        let apart = minus(a.middle, b.middle);
        let near = a.radius + b.radius;
        // No number fails the comparisons too.
        if !(facing > 0.0 && dot(apart, apart) <= near * near) {
            return false;
        }
        let normal = unit([0, 1, 2].map(|d| (1.0 + lead) * b.normal[d] - (1.0 - lead) * a.normal[d]));
        // A strip so narrow is a sliver of the smaller facet.
        let width = SLIVER * a.area.min(b.area) / (2.0 * a.radius.min(b.radius));
        if are_beside(facets, 1, normal, width) || are_beside(facets, 0, normal, width) {
            return false;
        }
        let origin = [0, 1, 2].map(|d| 0.5 * (a.middle[d] + b.middle[d]));
        let first = any_tangent(normal);
        let axes = [first, cross(normal, first), normal];
        let Room { fans, pieces } = room;
        if !fans.set(facets, origin, axes, width, level) {
            return false;
        }
        pieces.set(fans, facets.borders.map(|borders| borders.rims));
        let Pieces { list, count, whole, lowest, edges } = &*pieces;
        let pieces = &list[..*count];
        if !(whole.area() > SLIVER * a.area.min(b.area)) {
            return false;
        }
        let weight = smooth(facing / FACING) * 2.0 / (1.0 + facing);
        let owner = owner(frames);
        self.frames.iter_mut().zip(frames).for_each(|(own, frame)| *own = *frame);
        (self.normal, self.area, self.lowest) = (normal, weight * whole.area(), *lowest);
        (self.owner, self.edges, self.count) = (owner as u8, *edges, 0);
        let corners = if is_mean { 0.0 } else { at_corners(whole, frames, owner, axes) };
        if corners < 1.0 {
            self.add_mean(fans, pieces, weight * (1.0 - corners));
        }
        if corners > 0.0 {
            self.add_corners(fans, pieces, weight * corners);
        }
        true
    }

    pub(super) fn parts(&self) -> &[Part] {
        &self.parts[..self.count]
    }

    /// Adds what has integrals of the shares of corners and middles; `weight` of the area.
    fn add(&mut self, slot: usize, fans: &Fans, [area, weight]: [f64; 2], sums: &[[f64; 5]; 2]) {
        if !(weight * area > NOTHING * self.frames[0].area.min(self.frames[1].area)) {
            return;
        }
        let means = sums.map(|sums| sums.map(|sum| sum / area));
        let height = |k: usize| {
            let heights = fans.heights(k);
            (0..5).map(|i| means[k][i] * heights[i]).sum::<f64>()
        };
        let shares = [0, 1].map(|k| fans.spread(k, &means[k]));
        self.parts[self.count] = Part { slot, area: weight * area, gap: height(0) - height(1), shares };
        self.count += 1;
    }

    fn add_mean(&mut self, fans: &Fans, pieces: &[Piece], weight: f64) {
        // Integrals of 1, x and y over each triangle's share of it.
        let (mut area, mut of) = (0.0, [[[0.0; 3]; 4]; 2]);
        for Piece { sectors, moments } in pieces {
            area += moments.area();
            for k in 0..2 {
                let of = &mut of[k][usize::from(sectors[k]) % 4];
                (0..3).for_each(|i| of[i] += moments.0[i]);
            }
        }
        let mut sums = [[0.0; 5]; 2];
        for k in 0..2 {
            for sector in fans.sectors(k) {
                let of = of[k][sector];
                if of[0] == 0.0 {
                    continue;
                }
                let Sector { labels, shares } = fans.sector(k, sector);
                let [first, second] = shares.map(|share| integral(share, of));
                // Of a needle too all three are the whole.
                let all = [first, second, of[0] - first - second];
                (0..3).for_each(|i| sums[k][labels[i]] += all[i]);
            }
        }
        self.add(0, fans, [area, weight], &sums);
    }

    /// The same of the gap that is weighted by the shares of each corner of the owner.
    fn add_corners(&mut self, fans: &Fans, pieces: &[Piece], weight: f64) {
        let owner = self.owner as usize;
        // By the owner's corners and middle: area, and the sums of both facets.
        let (mut areas, mut sums) = ([0.0; 5], [[[0.0; 5]; 2]; 5]);
        for Piece { sectors, moments } in pieces {
            let of = [0, 1].map(|k| fans.sector(k, usize::from(sectors[k])));
            let own = &of[owner];
            let [first, second] = own.shares.map(|share| moments.weighted(share));
            let third = [0, 1, 2].map(|i| moments.0[i] - first[i] - second[i]);
            for (by, corner) in [first, second, third].into_iter().zip(own.labels) {
                areas[corner] += by[0];
                for k in 0..2 {
                    let Sector { shares, labels } = of[k];
                    let [first, second] = shares.map(|share| integral(share, by));
                    let all = [first, second, by[0] - first - second];
                    (0..3).for_each(|i| sums[corner][k][labels[i]] += all[i]);
                }
            }
        }
        let corners = fans.corners[owner];
        let part = if corners == 3 { 0.0 } else { 0.25 };
        for corner in 0..corners {
            let area = areas[corner] + part * areas[MIDDLE];
            let all = [0, 1].map(|k| std::array::from_fn(|i| sums[corner][k][i] + part * sums[MIDDLE][k][i]));
            self.add(1 + corner, fans, [area, weight], &all);
        }
    }

    /// Writes the ends of a spring that does care for slip along tangents.
    ///
    /// Both mean points are the gap apart, along the normal: what friction has of a couple is taken by forces
    /// across both facets, half of it each, so that the slip rate ṡ = t·(v_a − v_b) − g (ω_a + ω_b)·(n × t)/2
    /// does not see rotations of both together.
    pub(super) fn ends(&self, part: &Part, tangents: [Vector; 2], ends: &mut [End<3>; 8]) -> usize {
        let by = tangents.map(|t| cross(self.normal, t).map(|c| -0.5 * part.gap * c));
        let mut count = 0;
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            let frame = &self.frames[k];
            let [first, second] = frame.spins(by);
            for i in 0..frame.count {
                ends[count] = End { turn: [first[i], second[i]], ..End::node(frame.nodes[i], sign * part.shares[k][i]) };
                count += 1;
            }
        }
        count
    }

    /// Shares of the nodes in the gap of a part.
    pub(super) fn shares(&self, part: &Part) -> impl Iterator<Item = (u32, f64)> {
        let of = |k: usize, sign: f64| {
            let shares = part.shares[k];
            self.frames[k].nodes().iter().zip(shares).map(move |(&node, share)| (node, sign * share))
        };
        of(0, 1.0).chain(of(1, -1.0))
    }

    /// By how much the gap of a part grew in a step, m.
    pub(super) fn way(&self, part: &Part, sweep: Sweep<'_, 3>) -> f64 {
        let moved = |node: u32| minus(sweep.new[node as usize], sweep.old[node as usize]);
        self.shares(part).map(|(node, share)| share * dot(self.normal, moved(node))).sum()
    }

    /// How far the nodes moved in a step, less what they moved together, m.
    pub(super) fn moved(&self, sweep: Sweep<'_, 3>) -> f64 {
        let nodes = || self.frames.iter().flat_map(|frame| frame.nodes().iter().copied());
        let way = |node: u32| minus(sweep.new[node as usize], sweep.old[node as usize]);
        let count = nodes().count() as f64;
        let mut mean = [0.0; 3];
        for node in nodes() {
            let way = way(node);
            (0..3).for_each(|d| mean[d] += way[d] / count);
        }
        nodes().map(|node| length(minus(way(node), mean))).sum()
    }

    /// Area that counts as a fraction of that of the smaller facet.
    pub(super) fn fraction(&self) -> f64 {
        self.area / self.frames[0].area.min(self.frames[1].area)
    }

    /// How both facets turn in a step.
    pub(super) fn turn(&self, sweep: Sweep<'_, 3>) -> Vector {
        spin::turn(self.frames.iter().map(Frame::nodes), sweep)
    }

    /// Length of the larger facet, m.
    pub(super) fn size(&self) -> f64 {
        self.frames[0].radius.max(self.frames[1].radius)
    }

    /// Two tangents of the common plane.
    pub(super) fn tangents(&self) -> [Vector; 2] {
        Dim::<3>::tangents(self.normal, &[0.0; 3])
    }
}

/// That of a linear function, from those of 1, x and y.
fn integral([c0, c1, c2]: Linear, [one, x, y]: [f64; 3]) -> f64 {
    c0 * one + c1 * x + c2 * y
}

/// From 0 to 1 without a kink at either end.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// From 0 at the first of two numbers to 1 at the second.
fn between([low, high]: [f64; 2], x: f64) -> f64 {
    smooth((x - low) / (high - low))
}

/// The smaller facet, of equal ones that with the lower nodes: whichever is the first of the pair.
fn owner([a, b]: [&Frame; 2]) -> usize {
    let least = a.area.min(b.area);
    if (a.area - b.area).abs() > 1e-9 * least { usize::from(b.area < a.area) } else { usize::from(b.nodes < a.nodes) }
}

/// How much of a common part has springs at corners: all of it where it covers the smaller facet (m²), or
/// spans either facet in some direction, in which its mean gap would not see that facet's corners move
/// against each other.
fn at_corners(whole: &Moments, frames: [&Frame; 2], owner: usize, [first, second, _]: [Vector; 3]) -> f64 {
    let covered = whole.area() / frames[owner].area;
    let (covers, is_wide) = (between(COVERS, covered), between(NARROW, covered));
    if covers == 1.0 || is_wide == 0.0 {
        return covers;
    }
    let part = whole.covariance();
    let span = |frame: &Frame| {
        let [a, b, c, d] = frame.corners;
        // Of four nodes the parallelogram with these diagonals.
        let (ways, by) = if frame.count == 3 {
            ([minus(b, a), minus(c, b), minus(a, c)], 1.0 / 36.0)
        } else {
            ([minus(c, a), minus(d, b), [0.0; 3]], 1.0 / 24.0)
        };
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for way in ways {
            let (x, y) = (dot(first, way), dot(second, way));
            (xx, xy, yy) = (xx + by * x * x, xy + by * x * y, yy + by * y * y);
        }
        // Largest eigenvalue of part/side.
        let (det, trace) = (xx * yy - xy * xy, yy * part[0] - 2.0 * xy * part[1] + xx * part[2]);
        let product = (part[0] * part[2] - part[1] * part[1]) * det;
        let root = (trace * trace - 4.0 * product).max(0.0).sqrt();
        if det > 0.0 { 0.5 * (trace + root) / det } else { 0.0 }
    };
    covers.max(is_wide * between(SPANS, span(frames[0]).max(span(frames[1]))))
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod near_tests;
