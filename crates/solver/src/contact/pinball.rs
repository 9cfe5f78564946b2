//! Pinballs: disks in the elements under the surfaces, a spring between each two that come near. No segments, no sides, no projections.
//!
//! Belytschko and Neal, Int. J. Numer. Meth. Engng 31 (1991) 547-572, put a ball of the element's volume at the mean of the element's nodes; Belytschko and Yeh, Comput. Meth. Appl.
//! Mech. Engng 105 (1993) 375-393, split balls of elongated elements. Here the disk is the one that touches the surface from inside: a segment of length L over an element of height h
//! gets n = round(L/h) ≥ 1 disks of radius R = ½ min(h, L/n), at the depth R, each for the length L/n; one at the mean of the nodes where the element is square. Reasons:
//! disks of the element's area, R = √(A/π), reach out of flat surfaces by 13 % of the height, so bodies that touch would be pushed apart, and disks of long elements would leave holes.
//! The centre is a fixed point of the element, c = Σ N_k x_k, the radius is constant: so the gap |c₁ − c₂| − R₁ − R₂ has the rows N_k n, its spring keeps the energy, and the
//! forces keep both momenta exactly. (Scaling R by the element's area would change next to nothing where material flows, and pump energy where it is elastic.)
//!
//! Surfaces of disks are bumpy by 0.13 of the disks' diameter: bodies on each other's disks stand nearer or farther by that, and sliding is rough. Good for impact and penetration, not for
//! pressures. Stiffness of a pair: that of the automatic penalty, min(κ₁, κ₂) times the shorter of the two lengths (the penalty form); with the law `multiplier` the Lagrangian form.

pub mod space;

use super::formulation::{FormulationKind, Setup, Side, both_passes};
use super::initial::kept;
use super::law::penalty;
use super::search::{Pair, Query, Search};
use super::springs::{Answers, End, Spring, Springs};
use super::tracker::SKIN;
use super::{Formulation, Scene, Sweep, Vector, length};
use crate::archive::{Archive, Kept, keep_all, keep_each};
use crate::model;
use std::any::Any;

/// Registry entry.
pub const KIND: FormulationKind = FormulationKind {
    name: "pinball",
    doc: "disks (in space balls) in the elements under the surfaces against each other: simple and robust, bumpy where bodies slide",
    source: "Belytschko and Neal (1991), split as by Belytschko and Yeh (1993); disks and balls that touch the surface from inside",
    passes: both_passes,
    make: |setup| Ok(Box::new(Pinball::of(&setup))),
};

/// Disks of one element nearer than this fraction of their radii are one: at a corner, and where both sides of a thin body are in one element.
/// A little more than a half, which elements with L/h = 1.5 have in their corners: round-off is not to decide.
const SAME: f64 = 0.500001;

/// The formulation.
pub struct Pinball {
    disks: Vec<Disk>,
    /// Disks of the first surface come first; of a contact of bodies with themselves all.
    first: usize,
    search: Box<dyn Search<2>>,
    penalty: model::Penalty,
    /// Distance that the disks keep and largest gap at which the law pushes, m.
    thickness: f64,
    reach: f64,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    has_begun: bool,
    /// How far disks may move before the next search, m: half of it.
    skin: f64,
    centres_old: Vec<Vector>,
    centres: Vec<Vector>,
    /// Centres at the last search; empty before the first.
    searched: Vec<Vector>,
    /// Centres at the start, m, and the body of each disk.
    initial: Vec<Vector>,
    bodies: Vec<u32>,
    pairs: Vec<Pair>,
    near: Vec<Near>,
    before: Vec<Near>,
}

/// A disk: its centre as shares of nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Disk {
    nodes: [u32; 4],
    shares: [f64; 4],
    /// Nodes that count.
    count: usize,
    radius: f64,
    /// Length of surface that it stands for, m.
    length: f64,
    /// κ of the element, Pa/m.
    stiffness: f64,
}

/// Two disks that are near each other.
#[derive(Clone, Copy, Debug, Default)]
struct Near {
    pair: [u32; 2],
    /// Elastic slip, m.
    slip: f64,
    /// Gap that counts as zero, m; not positive.
    offset: f64,
    /// Whether the pair was there before the surfaces changed.
    known: bool,
}

keep_all!(Near { pair, slip, offset, known });

impl Disk {
    fn centre(&self, positions: &[Vector]) -> Vector {
        let mut centre = [0.0; 2];
        for (&node, share) in self.nodes[..self.count].iter().zip(self.shares) {
            let x = positions[node as usize];
            centre = [centre[0] + share * x[0], centre[1] + share * x[1]];
        }
        centre
    }

    fn shares_a_node_with(&self, other: &Self) -> bool {
        self.nodes[..self.count].iter().any(|node| other.nodes[..other.count].contains(node))
    }

    /// Whether both are in one element, and nearly in one place.
    fn is_as(&self, other: &Self, positions: &[Vector]) -> bool {
        let (mut mine, mut theirs) = (self.nodes, other.nodes);
        mine.sort_unstable();
        theirs.sort_unstable();
        let (a, b) = (self.centre(positions), other.centre(positions));
        mine == theirs && (a[0] - b[0]).hypot(a[1] - b[1]) < SAME * self.radius.min(other.radius)
    }

    /// Ends of a spring that pushes the disk along `sign` n; friction's couple of `moment` per force is taken by the element's nodes around their mean.
    fn ends(&self, positions: &[Vector], sign: f64, moment: f64) -> [End; 4] {
        let nodes = &self.nodes[..self.count];
        let mut mean = [0.0; 2];
        for &node in nodes {
            let x = positions[node as usize];
            mean = [mean[0] + x[0] / self.count as f64, mean[1] + x[1] / self.count as f64];
        }
        let arm = |node: u32| [positions[node as usize][0] - mean[0], positions[node as usize][1] - mean[1]];
        let square: f64 = nodes.iter().map(|&node| arm(node)[0].powi(2) + arm(node)[1].powi(2)).sum();
        let mut ends = [End::default(); 4];
        for (k, end) in ends.iter_mut().enumerate().take(self.count) {
            let [x, y] = arm(self.nodes[k]);
            let turn = [-moment * y / square, moment * x / square];
            *end = End { at: self.nodes[k], share: sign * self.shares[k], turn: [turn], ..End::default() };
        }
        ends
    }
}

/// How deep a place is below a segment, m.
fn depth(x: Vector, [a, b]: [u32; 2], positions: &[Vector]) -> f64 {
    let whole = length([a, b], positions);
    let [a, b] = [a, b].map(|node| positions[node as usize]);
    ((b[0] - a[0]) * (a[1] - x[1]) - (b[1] - a[1]) * (a[0] - x[0])) / whole
}

/// The disks under a surface, segment by segment.
fn disks_under(side: &Side<'_>, positions: &[Vector], disks: &mut Vec<Disk>) {
    let first = disks.len();
    let mut above: Vec<[u32; 2]> = Vec::new();
    for ((&segment, &cell), &stiffness) in side.target.surface.segments.iter().zip(&side.cells).zip(&side.segments) {
        for disk in disks_of_segment(segment, cell, stiffness, positions) {
            let same = disks[first..].iter().position(|other| disk.is_as(other, positions));
            let Some(at) = same else {
                disks.push(disk);
                above.push(segment);
                continue;
            };
            // The larger one stays, whatever the order of the segments, and keeps within both.
            let other = &mut disks[first + at];
            let mut within = segment;
            if other.radius < disk.radius {
                *other = disk;
                std::mem::swap(&mut above[at], &mut within);
            }
            other.radius = other.radius.min(depth(other.centre(positions), within, positions));
        }
    }
}

/// The disks of one segment over the element `cell`.
fn disks_of_segment(segment: [u32; 2], cell: &[u32], stiffness: f64, positions: &[Vector]) -> Vec<Disk> {
    let [a, b] = segment;
    // The element runs through the segment the other way round: b, a, what is beyond a, what is beyond b.
    let Some(place) = cell.iter().position(|&node| node == b) else { return Vec::new() };
    let corner = |k: usize| cell[(place + k) % cell.len()];
    let (beyond_a, beyond_b) = (corner(2), corner(cell.len() - 1));
    let whole = length(segment, positions);
    let height = 0.5 * [beyond_a, beyond_b].iter().map(|&node| depth(positions[node as usize], segment, positions)).sum::<f64>();
    if !(whole > 0.0 && height > 0.0) {
        return Vec::new();
    }
    // A little less, so that round-off does not give equal elements with L/h = 1.5 one disk here and two there.
    let count = (whole / height - 1e-6).round().max(1.0);
    let down = 0.5 * (whole / count / height).min(1.0);
    let disk = |k: usize| {
        let along = (k as f64 + 0.5) / count;
        let weights = [(1.0 - along) * (1.0 - down), along * (1.0 - down), (1.0 - along) * down, along * down];
        let mut disk = Disk { stiffness, length: whole / count, ..Disk::default() };
        for (node, share) in [a, b, beyond_a, beyond_b].into_iter().zip(weights) {
            match disk.nodes[..disk.count].iter().position(|&other| other == node) {
                Some(same) => disk.shares[same] += share,
                None => {
                    (disk.nodes[disk.count], disk.shares[disk.count]) = (node, share);
                    disk.count += 1;
                }
            }
        }
        disk.radius = depth(disk.centre(positions), segment, positions);
        disk
    };
    (0..count as usize).map(disk).collect()
}

impl Pinball {
    fn of(setup: &Setup<'_>) -> Self {
        let mut disks = Vec::new();
        let mut first = 0;
        for (index, side) in setup.sides.iter().enumerate() {
            disks_under(side, setup.positions, &mut disks);
            if index == 0 {
                first = disks.len();
            }
        }
        let skin = SKIN * disks.iter().map(|disk| disk.length).sum::<f64>() / disks.len().max(1) as f64;
        Self {
            first,
            search: (setup.search)(),
            penalty: setup.penalty(),
            thickness: setup.contact.interface.thickness,
            reach: (setup.law)().reach(),
            ignores_start: setup.ignores_start(),
            has_begun: false,
            skin,
            centres_old: Vec::new(),
            centres: Vec::new(),
            searched: Vec::new(),
            initial: disks.iter().map(|disk| disk.centre(setup.positions)).collect(),
            bodies: disks.iter().map(|disk| setup.bodies[disk.nodes[0] as usize]).collect(),
            pairs: Vec::new(),
            near: Vec::new(),
            before: Vec::new(),
            disks,
        }
    }

    fn meets_itself(&self) -> bool {
        self.first == self.disks.len()
    }

    /// Moves the centres; searches again where some disk has left the skin.
    fn follow(&mut self, sweep: Sweep<'_>) {
        for (centres, positions) in [(&mut self.centres_old, sweep.old), (&mut self.centres, sweep.new)] {
            centres.clear();
            centres.extend(self.disks.iter().map(|disk| disk.centre(positions)));
        }
        let limit = 0.5 * self.skin;
        let left = |(x, from): (&Vector, &Vector)| !((x[0] - from[0]).hypot(x[1] - from[1]) <= limit); // NaN counts as moved
        if self.searched.is_empty() || self.centres.iter().zip(&self.searched).any(left) {
            self.search();
        }
    }

    fn search(&mut self) {
        let way = |(x, old): (&Vector, &Vector)| (x[0] - old[0]).hypot(x[1] - old[1]);
        let fastest = self.centres.iter().zip(&self.centres_old).map(way).fold(0.0, f64::max);
        let ahead = self.thickness + self.reach + self.skin + 4.0 * fastest;
        let largest = |disks: &[Disk]| disks.iter().map(|disk| disk.radius).fold(0.0, f64::max);
        let from = if self.meets_itself() { 0 } else { self.first };
        let slaves: Vec<u32> = (0..self.first as u32).collect();
        let facets: Vec<[u32; 2]> = (from as u32..self.disks.len() as u32).map(|disk| [disk; 2]).collect();
        let query = Query {
            positions_old: &self.centres_old,
            positions_new: &self.centres,
            slaves: &slaves,
            facets: &facets,
            reach: ahead + largest(&self.disks[..self.first]) + largest(&self.disks[from..]),
        };
        self.search.pairs(&query, &mut self.pairs);
        std::mem::swap(&mut self.near, &mut self.before);
        self.near.clear();
        for pair in &self.pairs {
            let pair = [pair.slave, pair.facet + from as u32];
            let [one, other] = pair.map(|disk| &self.disks[disk as usize]);
            if (self.meets_itself() && pair[0] >= pair[1]) || one.shares_a_node_with(other) {
                continue;
            }
            let apart = |centres: &[Vector]| {
                let [a, b] = pair.map(|disk| centres[disk as usize]);
                (a[0] - b[0]).hypot(a[1] - b[1])
            };
            // What came from afar within the step may have passed: both ends of it count.
            if apart(&self.centres).min(apart(&self.centres_old)) <= ahead + one.radius + other.radius {
                let known = self.before.binary_search_by_key(&pair, |near| near.pair).ok();
                self.near.push(known.map_or(Near { pair, ..Near::default() }, |at| self.before[at]));
            }
        }
        self.searched.clone_from(&self.centres);
    }
}

impl Formulation for Pinball {
    fn detect(&mut self, scene: &Scene<'_>, springs: &mut Springs) {
        self.follow(scene.sweep);
        let side = if self.meets_itself() { 0.0 } else { 1.0 };
        let positions = scene.sweep.new;
        for near in &mut self.near {
            let [one, other] = near.pair.map(|disk| &self.disks[disk as usize]);
            let [a, b] = near.pair.map(|disk| self.centres[disk as usize]);
            let away = [a[0] - b[0], a[1] - b[1]];
            let distance = away[0].hypot(away[1]);
            // Disks in one place have no direction: any will do.
            let normal = if distance > 0.0 { [away[0] / distance, away[1] / distance] } else { [1.0, 0.0] };
            let [mine, theirs] = near.pair.map(|disk| disk as usize);
            let own = self.bodies[mine] == self.bodies[theirs];
            let touching = one.radius + other.radius;
            let mut gap = distance - touching - self.thickness;
            if own {
                // A body keeps no more distance from itself than half of what it had.
                let [a, b] = [mine, theirs].map(|disk| self.initial[disk]);
                let had = (a[0] - b[0]).hypot(a[1] - b[1]) - touching;
                gap += (self.thickness + self.reach - 0.5 * had.max(0.0)).max(0.0);
            }
            let offset = kept(self.has_begun || near.known, near.offset, gap);
            near.offset = if self.ignores_start || own { offset } else { 0.0 };
            let area = one.length.min(other.length);
            let stiffness = area * penalty::pressure(self.penalty, one.stiffness, other.stiffness);
            // Friction acts along t at both centres; each element takes the part of the couple that its radius has in the distance.
            let part = distance / touching;
            let mut ends = [End::default(); 8];
            let (mine, theirs) = (one.ends(positions, 1.0, part * one.radius), other.ends(positions, -1.0, part * other.radius));
            ends[..one.count].copy_from_slice(&mine[..one.count]);
            ends[one.count..one.count + other.count].copy_from_slice(&theirs[..other.count]);
            let spring = Spring { normal, gap: gap - near.offset, stiffness, area, side, slip: [near.slip], ..Spring::default() };
            springs.push(spring, &ends[..one.count + other.count]);
        }
        self.has_begun = true;
    }

    fn keep(&mut self, archive: &mut Archive<'_>) -> Kept {
        #[rustfmt::skip]
        let Self {
            disks, first: _, search: _, penalty: _, thickness: _, reach: _, ignores_start: _, skin: _, centres_old: _, centres: _, initial: _,
            bodies: _, pairs: _, before: _,
            has_begun, searched, near,
        } = self;
        keep_each!(archive; has_begun, searched, near);
        archive.check(searched.is_empty() || searched.len() == disks.len(), "pinballs were searched at other places")?;
        let is_there = |near: &Near| near.pair.iter().all(|&disk| (disk as usize) < disks.len());
        archive.check(near.iter().all(is_there), "a pinball is not there")
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        let Ok(old) = old.downcast::<Self>() else { return };
        let mut by_nodes: Vec<([u32; 4], usize)> = self.disks.iter().map(|disk| disk.nodes).zip(0..).collect();
        by_nodes.sort_unstable();
        let find = |disk: u32| {
            let disk = &old.disks[disk as usize];
            let first = by_nodes.partition_point(|&(nodes, _)| nodes < disk.nodes);
            let same = by_nodes[first..].iter().take_while(|&&(nodes, _)| nodes == disk.nodes).map(|&(_, index)| index);
            same.into_iter().find(|&index| self.disks[index].shares == disk.shares).map(|index| index as u32)
        };
        let now = |near: &Near| {
            let mut pair = [find(near.pair[0])?, find(near.pair[1])?];
            if self.meets_itself() {
                pair.sort_unstable();
            }
            Some(Near { pair, known: old.has_begun, ..*near })
        };
        // The first search looks what is known of its pairs up here. Disks that come to light may be in each other, where their body has been squeezed: that counts as zero.
        let mut near: Vec<Near> = old.near.iter().filter_map(now).collect();
        near.sort_by_key(|near| near.pair);
        self.near = near;
    }

    fn remember(&mut self, solved: Answers<'_>) {
        for (near, answer) in self.near.iter_mut().zip(solved) {
            near.slip = answer.solved.slip_new[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::projection::node_segment::Target;
    use crate::contact::springs::tangent;
    use crate::mesh::shapes::{Body, rectangle};
    use crate::mesh::surface::Surface;

    fn disks_of(body: &Body) -> Vec<Disk> {
        let surface = Surface::<2>::outside(body.quads.iter().map(<[u32; 4]>::as_slice)).unwrap();
        let cell = |segment: &[u32; 2]| {
            let quad = body.quads.iter().find(|quad| (0..4).any(|k| [quad[(k + 1) % 4], quad[k]] == *segment));
            quad.unwrap().as_slice()
        };
        let cells = surface.segments.iter().map(cell).collect();
        let side =
            Side { segments: vec![1.0; surface.segments.len()], cells, target: Target { surface, mirrors: Vec::new() }, ..Side::default() };
        let mut disks = Vec::new();
        disks_under(&side, &body.positions, &mut disks);
        disks
    }

    #[test]
    fn square_elements_have_one_disk_each_that_touches_the_surface_from_inside() {
        let body = rectangle([0.0, 0.0], [4.0, 3.0], [4, 3]);
        let disks = disks_of(&body);
        assert_eq!(disks.len(), 10);
        for disk in &disks {
            let [x, y] = disk.centre(&body.positions);
            assert!((disk.radius - 0.5).abs() < 1e-15 && (x.fract() - 0.5).abs() < 1e-14 && (y.fract() - 0.5).abs() < 1e-14);
        }
    }

    #[test]
    fn equal_elements_get_equal_disks_wherever_they_are() {
        // L/h = 1.5, a tie that round-off of the place decided otherwise.
        let count = |y: f64| disks_of(&rectangle([-0.5, y], [1.0, 0.5], [4, 3])).len();
        for y in [0.0, 0.1, 0.5, 0.7, 1.0 / 3.0, 12.3] {
            assert_eq!(count(y), count(0.0), "{y}");
        }
    }

    #[test]
    fn long_and_tall_elements_are_covered_without_holes_or_humps() {
        for (size, elements) in [([8.0, 1.0], [2, 1]), ([4.0, 6.0], [4, 2]), ([3.0, 0.5], [5, 1])] {
            let body = rectangle([0.0, 0.0], size, elements);
            let disks = disks_of(&body);
            // The surface as a disk of the same size sees it.
            for k in 0..200 {
                let x = size[0] * (k as f64 + 0.5) / 200.0;
                let top = disks.iter().filter_map(|disk| {
                    let ([cx, cy], reach) = (disk.centre(&body.positions), 2.0 * disk.radius);
                    let square = reach * reach - (x - cx) * (x - cx);
                    (square >= 0.0).then(|| cy + square.sqrt() - disk.radius)
                });
                let top = top.fold(f64::NEG_INFINITY, f64::max);
                let diameter = disks.iter().map(|disk| 2.0 * disk.radius).fold(0.0, f64::max);
                assert!(top <= size[1] * (1.0 + 1e-12) && top > size[1] - 0.25 * diameter, "{size:?} {elements:?} at {x}: {top}");
            }
        }
    }

    #[test]
    fn slip_is_blind_to_rotations_of_both() {
        let positions = [[0.0, 0.0], [1.0, 0.1], [1.1, 1.0], [0.1, 0.9], [0.2, 1.2], [1.0, 1.1], [1.2, 2.0], [0.0, 2.1]];
        let disk = |nodes| Disk { nodes, shares: [0.25; 4], count: 4, radius: 0.55, length: 1.0, stiffness: 1.0 };
        let (one, other) = (disk([0, 1, 2, 3]), disk([4, 5, 6, 7]));
        let (a, b) = (one.centre(&positions), other.centre(&positions));
        let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
        let t = tangent([(a[0] - b[0]) / distance, (a[1] - b[1]) / distance]);
        let ends = [one.ends(&positions, 1.0, 0.5 * distance), other.ends(&positions, -1.0, 0.5 * distance)].concat();
        let rate = |v: &dyn Fn(Vector) -> Vector| -> f64 {
            let of = |end: &End| (0..2).map(|d| (end.share * t[d] + end.turn[0][d]) * v(positions[end.at as usize])[d]).sum::<f64>();
            ends.iter().map(of).sum()
        };
        assert!(rate(&|x| [-x[1], x[0]]).abs() < 1e-14 && rate(&|_| [3.0, -7.0]).abs() < 1e-14);
    }
}
