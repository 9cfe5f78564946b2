//! Pinballs: disks in the elements under the surfaces, a spring between each two that come near. No segments,
//! no sides, no projections.
//!
//! Belytschko and Neal, Int. J. Numer. Meth. Engng 31 (1991) 547-572, put a ball of the element's volume at
//! the mean of the element's nodes; Belytschko and Yeh, Comput. Meth. Appl. Mech. Engng 105 (1993) 375-393,
//! split balls of elongated elements. Here the disk is the one that touches the surface from inside: a
//! segment of length L over an element of height h gets n = round(L/h) ≥ 1 disks of radius R = ½ min(h, L/n),
//! at the depth R, each for the length L/n; one at the mean of the nodes where the element is square.
//! Reasons: disks of the element's area, R = √(A/π), reach out of flat surfaces by 13 % of the height, so
//! bodies that touch would be pushed apart, and disks of long elements would leave holes. The centre is a
//! fixed point of the element, c = Σ N_k x_k, the radius is constant: so the gap |c₁ − c₂| − R₁ − R₂ has the
//! rows N_k n, its spring keeps the energy, and the forces keep both momenta exactly. (Scaling R by the
//! element's area would change next to nothing where material flows, and pump energy where it is elastic.)
//!
//! Surfaces of disks are bumpy by 0.13 of the disks' diameter: bodies on each other's disks stand nearer or
//! farther by that, and sliding is rough. Good for impact and penetration, not for pressures. Stiffness of a
//! pair: that of the automatic penalty, min(κ₁, κ₂) times the shorter of the two lengths (the penalty form);
//! with the law `multiplier` the Lagrangian form.

mod follower;
pub mod space;

use super::checked::Checked;
use super::formulation::{FormulationKind, Setup, Side, both_passes};
use super::springs::{Answers, End, Slip, Springs};
use super::tied::Beside;
use super::{Formulation, Scene, Vector, length};
use crate::archive::{Archive, ArchiveResult};
use crate::mesh::surface::Corners;
use follower::{Ball, Follower};
use std::any::Any;

/// Registry entry.
pub const KIND: FormulationKind = FormulationKind {
    name: "pinball",
    doc: "disks (in 3D balls) in the elements under the surfaces against each other: simple and robust, bumpy where bodies slide",
    source: "Belytschko and Neal (1991), split as by Belytschko and Yeh (1993); disks and balls that touch the surface from inside",
    passes: both_passes,
    tied: None,
    is_carried: false,
    in_2d: Some(|setup| Ok(Box::new(Checked::new(Box::new(Pinball::of(&setup)), setup.overlap_check)))),
    in_3d: Some(|setup| Ok(Box::new(Checked::new(Box::new(space::Pinball::of(&setup)), setup.overlap_check.without_nets())))),
};

/// A disk in an element of at most four nodes; its area is the length of surface that it stands for, m.
type Disk = Ball<4>;

/// The formulation.
pub struct Pinball {
    follower: Follower<2, 4>,
}

impl Disk {
    /// Ends of a spring that pushes the disk along `sign` n; friction's couple of `moment` per force is taken
    /// by the element's nodes around their mean.
    fn ends(&self, positions: &[Vector], sign: f64, moment: f64) -> [End<2>; 4] {
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
fn disks_under(side: &Side<'_, 2>, positions: &[Vector]) -> Vec<Disk> {
    let mut disks: Vec<Disk> = Vec::new();
    let mut above: Vec<[u32; 2]> = Vec::new();
    for ((&segment, cell), &stiffness) in side.surface.target.surface.segments.iter().zip(&side.cells).zip(&side.stiffness) {
        // Of an element that is made of smaller ones the one that has the segment.
        let has_it = |part: &[u32; 4]| segment.iter().all(|node| part.contains(node));
        let Some(part) = cell.and_then(|cell| cell.facets().find(has_it)) else { continue };
        for disk in disks_of_segment(segment, part.corners(), stiffness, positions) {
            let same = disks.iter().position(|other| disk.is_as(other, positions));
            let Some(at) = same else {
                disks.push(disk);
                above.push(segment);
                continue;
            };
            // The larger one stays, whatever the order of the segments, and keeps within both.
            let other = &mut disks[at];
            let mut within = segment;
            if other.radius < disk.radius {
                *other = disk;
                std::mem::swap(&mut above[at], &mut within);
            }
            other.radius = other.radius.min(depth(other.centre(positions), within, positions));
        }
    }
    disks
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
    // A little less, so that round-off does not give equal elements with L/h = 1.5 one disk here and two
    // there.
    let count = (whole / height - 1e-6).round().max(1.0);
    let down = 0.5 * (whole / count / height).min(1.0);
    let disk = |k: usize| {
        let along = (k as f64 + 0.5) / count;
        let weights = [(1.0 - along) * (1.0 - down), along * (1.0 - down), (1.0 - along) * down, along * down];
        let mut disk = Disk { stiffness, area: whole / count, ..Disk::default() };
        for (node, share) in [a, b, beyond_a, beyond_b].into_iter().zip(weights) {
            disk.add(node, share);
        }
        disk.radius = depth(disk.centre(positions), segment, positions);
        disk
    };
    (0..count as usize).map(disk).collect()
}

impl Pinball {
    fn of(setup: &Setup<'_, 2>) -> Self {
        let layers = setup.sides.iter().map(|side| disks_under(side, setup.positions)).collect();
        let (interface, reach, search) = (&setup.contact.interface, (setup.law)().reach(), (setup.search)());
        Self { follower: Follower::new(layers, interface, setup.penalty(), reach, search, (setup.bodies, setup.positions)) }
    }
}

impl Formulation<2> for Pinball {
    fn detect(&mut self, scene: &Scene<'_, 2>, springs: &mut Springs<2>) {
        let follower = &mut self.follower;
        follower.follow(scene.sweep);
        for index in 0..follower.near.len() {
            let lying = follower.lying(index);
            let near = follower.near[index];
            let [one, other] = near.pair.map(|disk| &follower.balls[disk as usize]);
            // Friction acts along t at both centres; each element takes the part of the couple that its
            // radius has in the distance.
            let part = lying.distance / (one.radius + other.radius);
            let positions = scene.sweep.new;
            let mut ends = [End::default(); 8];
            let (mine, theirs) = (one.ends(positions, 1.0, part * one.radius), other.ends(positions, -1.0, part * other.radius));
            ends[..one.count].copy_from_slice(&mine[..one.count]);
            ends[one.count..one.count + other.count].copy_from_slice(&theirs[..other.count]);
            let spring = follower.spring(near.pair, &lying);
            springs.push(spring, Slip::of([near.slip]), &ends[..one.count + other.count]);
        }
        follower.has_begun = true;
    }

    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.follower.persist(archive)
    }

    fn beside(&self) -> Beside {
        Beside::Elements
    }

    fn inherit(&mut self, old: Box<dyn Any>) {
        if let Ok(old) = old.downcast::<Self>() {
            self.follower.inherit(&old.follower);
        }
    }

    fn remember(&mut self, solved: Answers<'_, 2>) {
        for (near, answer) in self.follower.near.iter_mut().zip(solved) {
            near.slip = answer.slid().slip_new[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::formulation::ContactSurface;
    use crate::contact::projection::node_segment::Target;
    use crate::contact::springs::tangent;
    use crate::mesh::shapes::{Body, rectangle};
    use crate::mesh::surface::Surface;

    fn disks_of(body: &Body<2>) -> Vec<Disk> {
        let surface = Surface::<2>::outside(body.cells()).unwrap();
        let cell = |segment: &[u32; 2]| body.cells().find(|quad| quad.edges().any(|[a, b]| [b, a] == *segment));
        let cells = surface.segments.iter().map(cell).collect();
        let stiffness = vec![1.0; surface.segments.len()];
        let surface = ContactSurface { target: Target { surface, mirrors: Vec::new() }, lids: Vec::new() };
        let side = Side { stiffness, cells, surface, ..Side::default() };
        disks_under(&side, &body.positions)
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
        let disk = |nodes| Disk { nodes, shares: [0.25; 4], count: 4, radius: 0.55, area: 1.0, stiffness: 1.0 };
        let (one, other) = (disk([0, 1, 2, 3]), disk([4, 5, 6, 7]));
        let (a, b) = (one.centre(&positions), other.centre(&positions));
        let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
        let t = tangent([(a[0] - b[0]) / distance, (a[1] - b[1]) / distance]);
        let ends = [one.ends(&positions, 1.0, 0.5 * distance), other.ends(&positions, -1.0, 0.5 * distance)].concat();
        let rate = |v: &dyn Fn(Vector) -> Vector| -> f64 {
            let of = |end: &End<2>| (0..2).map(|d| (end.share * t[d] + end.turn[0][d]) * v(positions[end.at as usize])[d]).sum::<f64>();
            ends.iter().map(of).sum()
        };
        assert!(rate(&|x| [-x[1], x[0]]).abs() < 1e-14 && rate(&|_| [3.0, -7.0]).abs() < 1e-14);
    }
}
