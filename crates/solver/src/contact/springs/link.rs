//! What springs act on, and how: nodes and rigid bodies with their velocities and mobilities, and the rows of every spring on them.
//!
//! Springs and the state of the step come from [`super::Springs`]; links and arms, island by island, go to [`super::relax`]. Velocities are counted from those that there are
//! without springs: what a force changes is then exact to its own last digits, however fast the bodies move.

use super::couple::{Couplings, Forces};
use super::ends::Ends;
use super::islands::NONE;
use super::{End, Mover, Movers, Spring, Tangential, Update, Vector, tangent};
use crate::load::join;
use std::ops::Range;

/// A node or rigid body that springs act on.
#[derive(Clone, Copy, Default)]
pub(super) struct Movable {
    /// x, y and, of a rigid body, angular.
    velocity_old: [f64; 3],
    /// v^{n+½} without springs.
    velocity_free: [f64; 3],
    mobility: Mobility,
    /// Centre of a rigid body; `None`: a node.
    centre: Option<Vector>,
}

/// Change of velocity per force: xx, xy, yy and, of a rigid body, angular.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Mobility(pub(super) [f64; 4]);

impl Mobility {
    #[inline]
    pub(super) fn response(&self, row: [f64; 3]) -> [f64; 3] {
        let [xx, xy, yy, spin] = self.0;
        [xx * row[0] + xy * row[1], xy * row[0] + yy * row[1], spin * row[2]]
    }
}

impl Movable {
    /// The node or (from `nodes` on) rigid body `at` at the beginning of the solution.
    pub(super) fn new<M: Movers>(at: u32, nodes: usize, update: &Update<'_, M>) -> Self {
        let mean_step = 0.5 * (update.time_steps[0] + update.time_steps[1]);
        let node = at as usize;
        if node >= nodes {
            let body = update.bodies.state(node - nodes);
            let [x, y, spin] = body.inverse_mass.map(|inverse| mean_step * inverse);
            let (velocity_old, velocity_free) = (body.velocity_old, body.velocity_free);
            return Self { velocity_old, velocity_free, mobility: Mobility([x, 0.0, y, spin]), centre: Some(body.centre) };
        }
        let Mover { velocity_old: [ox, oy], velocity: [vx, vy], mobility: [xx, xy, yy] } = update.nodes.mover(node);
        Self { velocity_old: [ox, oy, 0.0], velocity_free: [vx, vy, 0.0], mobility: Mobility([xx, xy, yy, 0.0]), centre: None }
    }

    /// Whether forces move the node or rigid body `at` at all.
    pub(super) fn moves<M: Movers>(at: u32, nodes: usize, update: &Update<'_, M>) -> bool {
        if (at as usize) < nodes {
            return update.nodes.moves(at as usize);
        }
        Self::new(at, nodes, update).mobility != Mobility::default()
    }

    /// A row of force `row` at an end, with its moment on a rigid body; of the image of a node as its leader feels it.
    #[inline]
    fn row(&self, mut row: Vector, end: &End) -> [f64; 3] {
        let point = end.point;
        if let Some(turn) = end.image {
            row = join::back(turn, row);
        }
        let moment = self.centre.map_or(0.0, |centre| (point[0] - centre[0]) * row[1] - (point[1] - centre[1]) * row[0]);
        [row[0], row[1], moment]
    }
}

/// A node or rigid body of an island, as the springs move it.
#[derive(Clone, Copy, Default)]
pub(super) struct Slot {
    /// Of a hub, what the springs have added to the velocity.
    pub(super) change: [f64; 3],
    pub(super) mobility: Mobility,
    pub(super) is_body: bool,
    /// Whether springs there know the slot instead of each other; see [`super::couple`].
    pub(super) is_hub: bool,
}

/// A spring's row of the gap on something that moves.
#[derive(Clone, Copy, Default)]
pub(super) struct Arm {
    pub(super) slot: u32,
    pub(super) row: [f64; 3],
}

/// A spring while it is solved.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Link {
    /// Number of the spring.
    pub(super) spring: u32,
    /// Its arms in the island.
    pub(super) first: u32,
    pub(super) count: u32,
    /// Change of g^{n+½} per normal force.
    pub(super) compliance: f64,
    /// What its own forces do to its rates, arm by arm: the gap's per normal force, either per the other, the slip's per friction.
    pub(super) own: [f64; 3],
    pub(super) is_at_hub: bool,
    pub(super) gap_old: f64,
    /// g^{n+½} without any force.
    pub(super) gap_free: f64,
    pub(super) rate_old: f64,
    pub(super) rate_free: f64,
    pub(super) slip_rate_old: f64,
    pub(super) slip_rate_free: f64,
    /// Compliances of normal force and friction beyond the spring's own, and the forces at which they change nothing; see [`super::relax`].
    pub(super) lent: [f64; 2],
    pub(super) centre: [f64; 2],
    /// Elastic slip at n + ½.
    pub(super) slip_new: f64,
    pub(super) slides: bool,
}

impl Link {
    #[inline]
    pub(super) fn arms(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// Ends of springs, and what is at them.
pub(super) struct Joints<'a, M: Movers> {
    pub(super) list: &'a [Spring],
    pub(super) ends: &'a Ends,
    /// Place of each end.
    pub(super) places: &'a [u32],
    /// Node or rigid body of each place.
    pub(super) at: &'a [u32],
    /// Slot of each place in its island; [`NONE`]: it does not move.
    pub(super) slots: &'a [u32],
    pub(super) update: &'a Update<'a, M>,
}

/// An island while it is solved. It stays in the caches where islands are small.
#[derive(Default)]
pub(super) struct Bench {
    pub(super) links: Vec<Link>,
    pub(super) arms: Vec<Arm>,
    /// Rows of the slip, as `arms`.
    pub(super) slips: Vec<[f64; 3]>,
    pub(super) slots: Vec<Slot>,
    pub(super) forces: Vec<Forces>,
    pub(super) couplings: Couplings,
    /// Whether a spring cares for slip.
    slides: bool,
    /// What is in each slot.
    movables: Vec<Movable>,
}

impl Bench {
    pub(super) fn clear(&mut self) {
        self.links.clear();
        self.arms.clear();
        self.slips.clear();
        self.slots.clear();
        self.movables.clear();
        self.slides = false;
    }

    /// Once all links are there: what they do to each other; no force acts yet.
    pub(super) fn close(&mut self) {
        self.forces.clear();
        self.forces.resize(self.links.len(), [0.0; 2]);
        self.couplings.find(&mut self.links, &self.arms, &self.slips, &mut self.slots, self.slides);
    }
}

impl<M: Movers> Joints<'_, M> {
    /// Adds the link of a spring, with its arms and the slots that come with it.
    pub(super) fn link(&self, number: u32, tangential: Tangential, bench: &mut Bench) {
        let spring = &self.list[number as usize];
        let [before, after] = self.update.time_steps;
        let t = tangent(spring.normal);
        let has_slip = !matches!(tangential, Tangential::Free);
        let mut held = Movable::default();
        bench.slides |= has_slip;
        let mut link = Link { spring: number, first: bench.arms.len() as u32, ..Link::default() };
        for k in spring.ends() {
            let (end, slot) = (self.ends.get(k), self.slots[self.places[k] as usize]);
            let movable = self.movable(k, slot, &mut held, bench);
            let row = movable.row(end.gap_row(spring.normal), &end);
            let slip_row = if has_slip { movable.row(end.slip_row(t), &end) } else { [0.0; 3] };
            link.rate_old += dot(row, movable.velocity_old);
            link.rate_free += dot(row, movable.velocity_free);
            link.slip_rate_old += dot(slip_row, movable.velocity_old);
            link.slip_rate_free += dot(slip_row, movable.velocity_free);
            if slot == NONE {
                continue;
            }
            let response = movable.mobility.response(row);
            link.own[0] += dot(row, response);
            if has_slip {
                link.own[1] += dot(slip_row, response);
                link.own[2] += dot(slip_row, movable.mobility.response(slip_row));
            }
            bench.arms.push(Arm { slot, row });
            bench.slips.push(slip_row);
            link.count += 1;
        }
        link.compliance = 0.5 * after * link.own[0];
        link.gap_old = spring.gap - 0.5 * before * link.rate_old;
        link.gap_free = spring.gap + 0.5 * after * link.rate_free;
        bench.links.push(link);
    }

    /// What is at the end `k`. Slots are filled in the order in which they are met, which is that of their numbers.
    fn movable<'b>(&self, k: usize, slot: u32, held: &'b mut Movable, bench: &'b mut Bench) -> &'b Movable {
        let make = || Movable::new(self.at[self.places[k] as usize], self.update.nodes.count(), self.update);
        if slot == NONE {
            *held = make();
            return held;
        }
        if slot as usize == bench.movables.len() {
            let movable = make();
            bench.slots.push(Slot { change: [0.0; 3], mobility: movable.mobility, is_body: movable.centre.is_some(), is_hub: false });
            bench.movables.push(movable);
        }
        &bench.movables[slot as usize]
    }
}

#[inline]
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
