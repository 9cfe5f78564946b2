//! Contact springs, solved so that contact neither makes nor takes energy, whatever their stiffness and the step.
//!
//! Contacts and obstacles find where springs are; this file finds their forces, all together, because springs share nodes. With the gaps at half steps,
//! g^{n+½} = g^n + ½ dt^n ġ^{n+½} and g^{n−½} = g^n − ½ dt^{n−1} ġ^{n−½}, a force F does the work F (g^{n+½} − g^{n−½}) in the velocity update (exactly for
//! equal steps, else but for ¼ (dt^n − dt^{n−1}) F Δġ, which the slow growth of the step keeps small). So
//!
//! F = − [V(g^{n+½}) − V(g^{n−½})] / (g^{n+½} − g^{n−½})
//!
//! takes from the motion exactly what the spring's energy V stores and gives it back at release: Armero and Petőcz, Comput. Meth. Appl. Mech. Engng 158
//! (1998) 269-300, put into the explicit update. A plain explicit force −V'(g^n) does not: what a spring gives at release differs from
//! what it took at closing by up to ½ k v² dt²/4, and stiff springs pump or lose energy far below the linear stability limit.
//!
//! Stability: while a linear spring is closed, F = −k (g^{n−1} + 2 g^n + g^{n+1})/4, so it adds k to the stiffness and k dt²/4 to the mass:
//! (K + k) dt² ≤ 4 (M + k dt²/4) holds exactly if K dt² ≤ 4 M. The stable step of the elements alone is the stable step with contact.
//!
//! g^{n+½} depends on F itself and on the other springs at the same nodes: Gauss-Seidel over the springs, in their fixed order, normal force and
//! friction in turn. For linear springs the matrix (2/k on the diagonal plus compliances) is symmetric and positive definite, so the sweeps converge; pair
//! forces keep both momenta exactly at any time. Laws of the normal force are in [`super::law`], friction is in [`friction`].

pub mod friction;

use super::law::Law;
use crate::load::join;
use crate::rigid::Bodies;
use friction::{Friction, Stick};

/// A vector of the plane.
pub type Vector = [f64; 2];

/// A spring between two surfaces: it pushes along `normal` on the ends with positive shares and against it on the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spring {
    /// Unit vector.
    pub normal: Vector,
    /// g^n, m.
    pub gap: f64,
    /// k, N/m per metre of depth, of laws that have one.
    pub stiffness: f64,
    /// Length of surface that it stands for, m.
    pub area: f64,
    /// 1 where the ends with positive shares belong to the first surface, −1 where to the second, 0 in a contact of bodies with themselves.
    pub side: f64,
    /// Friction: elastic slip at n − ½ (memory of the contact), m. Tie: slip at n, m.
    pub slip: f64,
    /// F, N/m.
    pub force: f64,
    /// T, N/m: friction along the tangent.
    pub friction: f64,
    /// Elastic slip at n + ½, m.
    pub slip_new: f64,
    /// Slip rate in v^{n+½}, m/s, along the tangent.
    pub slip_rate: f64,
    /// Whether friction is at its limit, or there is none.
    pub slides: bool,
    /// Energy at the whole step n, J/m, in step with ½ Σ m v^{n-1/2}·v^{n+1/2}: ½ (V(g^{n−½}) + V(g^{n+½})) + ½ F (g^{n+½} + g^{n−½} − 2 g^n).
    pub energy: f64,
    /// Energy at n + ½ of the gap, and of a tie's slip, J/m.
    pub stored: [f64; 2],
    /// Energy of the elastic slip at n, J/m: ¼ k (s^{n−½}² + s^{n+½}²).
    pub slip_energy: f64,
    /// Work of both forces in the velocity update, J/m.
    pub work: f64,
    /// What the update took for good or for the elastic slip, J/m: minus the work of friction, damping and multipliers.
    pub lost: Lost,
    pub(super) first: u32,
    pub(super) count: u32,
}

/// Work that no normal spring stores, J/m: positive is taken from the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lost {
    /// By friction, energy of the elastic slip included.
    pub friction: f64,
    /// By damping, and by impacts on multipliers.
    pub damping: f64,
    /// The same two impulses times the old rates instead of the mean ones.
    pub old: [f64; 2],
    /// Energy at n + ½ of springs that are no more at n + 1: ties that broke.
    pub freed: f64,
}

impl std::ops::AddAssign for Lost {
    fn add_assign(&mut self, other: Self) {
        self.friction += other.friction;
        self.damping += other.damping;
        self.old[0] += other.old[0];
        self.old[1] += other.old[1];
        self.freed += other.freed;
    }
}

/// What a spring does to one node or rigid body: rows of the rates of gap and slip.
///
/// ġ = Σ (share n + lean)·v, ṡ = Σ (share t + turn)·v with t = (n₂, −n₁). On a rigid body v is its velocity at `point`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct End {
    /// Node, or number of nodes + rigid body.
    pub at: u32,
    /// Share in the gap.
    pub share: f64,
    /// What the gap's rate has beyond: of points that move along segments which are inclined to the tangent.
    pub lean: Vector,
    /// What makes the slip rate blind to rotation of both surfaces together, and friction keep the angular momentum.
    pub turn: Vector,
    /// Where the forces act on a rigid body without nodes, m.
    pub point: Vector,
    /// Cosine and sine of the rotation from the motion of the node that moves in its stead; `None`: no rotation.
    pub image: Option<Vector>,
}

impl End {
    /// A node with a share of the gap.
    #[must_use]
    pub fn node(node: u32, share: f64) -> Self {
        Self { at: node, share, ..Self::default() }
    }

    /// Force of a solved spring on this end, N/m.
    #[must_use]
    pub fn force(&self, spring: &Spring) -> Vector {
        let (gap_row, slip_row) = (self.gap_row(spring.normal), self.slip_row(tangent(spring.normal)));
        [0, 1].map(|d| gap_row[d] * spring.force + slip_row[d] * spring.friction)
    }

    /// Row of the gap's rate.
    #[inline]
    fn gap_row(&self, normal: Vector) -> Vector {
        [0, 1].map(|d| self.share * normal[d] + self.lean[d])
    }

    /// Row of the slip's rate.
    #[inline]
    fn slip_row(&self, tangent: Vector) -> Vector {
        [0, 1].map(|d| self.share * tangent[d] + self.turn[d])
    }
}

/// Tangent of a spring: the normal turned clockwise, along the target segment.
#[must_use]
pub fn tangent(normal: Vector) -> Vector {
    [normal[1], -normal[0]]
}

/// What acts in the springs of a contact.
pub struct Terms {
    /// Law of the normal force.
    pub law: Box<dyn Law>,
    /// Along the surface.
    pub tangential: Tangential,
    /// Fraction of critical damping while closed.
    pub damping: f64,
}

/// What acts along the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangential {
    /// Nothing.
    Free,
    /// Coulomb friction.
    Friction(Friction),
    /// A spring on the slip that never gives way; as stiff as that on the gap.
    Tied,
}

/// The springs of all contacts and obstacles in one step.
#[derive(Default)]
pub struct Springs {
    /// In the order in which contacts and obstacles found them.
    pub list: Vec<Spring>,
    ends: Vec<End>,
    /// First spring of each contact, and what acts in it.
    groups: Vec<Group>,
    /// Place of each node (then of each rigid body) in `movables`; `u32::MAX`: not touched.
    place: Vec<u32>,
    movables: Vec<Movable>,
    places: Vec<u32>,
    links: Vec<Link>,
    /// Springs that push.
    live: Vec<u32>,
    /// Most sweeps that a step took so far.
    pub sweeps_max: usize,
    /// Steps whose forces still changed after the last sweep that is allowed.
    pub unsolved: u64,
}

/// The springs of one contact.
#[derive(Clone, Copy)]
struct Group {
    end: usize,
    terms: usize,
}

/// A node or rigid body that springs act on.
#[derive(Clone, Copy)]
struct Movable {
    at: u32,
    /// x, y and, of a rigid body, angular.
    velocity_old: [f64; 3],
    velocity: [f64; 3],
    /// Change of velocity per force: xx, xy, yy and, of a rigid body, angular.
    mobility: [f64; 4],
    /// Centre of a rigid body; `None`: a node.
    centre: Option<Vector>,
}

impl Movable {
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

    #[inline]
    fn response(&self, row: [f64; 3]) -> [f64; 3] {
        let [xx, xy, yy, spin] = self.mobility;
        [xx * row[0] + xy * row[1], xy * row[0] + yy * row[1], spin * row[2]]
    }
}

/// What a spring needs in every sweep.
#[derive(Clone, Copy, Debug, Default)]
struct Link {
    /// Change of g^{n+½} per normal force.
    compliance: f64,
    /// Change of the slip rate per friction.
    slip_compliance: f64,
    gap_old: f64,
    rate_old: f64,
    slip_rate_old: f64,
}

/// What the solution needs of the model.
pub struct Update<'a, M: Movers> {
    /// Steps before and after, s: v^{n+½} = v^{n−½} + ½ (dt^{n−1} + dt^n) F / m, x^{n+1} = x^n + dt^n v^{n+½}.
    pub time_steps: [f64; 2],
    /// x^n, m.
    pub positions: &'a [Vector],
    /// How nodes move and give way.
    pub nodes: &'a M,
    /// Rigid bodies.
    pub bodies: &'a Bodies,
}

/// Nodes as springs see them.
pub trait Movers {
    /// How many nodes there are.
    fn count(&self) -> usize;
    /// The node that moves in the stead of `node`, and the rotation from its motion to that of `node`, if any.
    fn leader(&self, node: u32) -> (u32, Option<Vector>);
    /// Motion of a node that leads itself.
    fn mover(&self, leader: usize) -> Mover;
}

/// A node without springs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mover {
    /// v^{n−½}, m/s.
    pub velocity_old: Vector,
    /// v^{n+½} without springs, prescribed motion included, m/s.
    pub velocity: Vector,
    /// Change of v^{n+½} per force: xx, xy, yy.
    pub mobility: [f64; 3],
}

/// A spring as laws of the normal force see it.
#[derive(Clone, Copy, Debug)]
pub struct Closing<'a> {
    /// The spring.
    pub spring: &'a Spring,
    /// g^{n−½}, m.
    pub old: f64,
    /// g^{n+½} without the force, m.
    pub free: f64,
    /// Change of g^{n+½} per force.
    pub compliance: f64,
}

/// Sums over the springs of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Force on the first surface, N/m.
    pub resultant: Vector,
    /// Sum of the normal forces, N/m: what is transmitted, also where the resultant vanishes.
    pub pressing: f64,
    /// Energy of the springs, J/m.
    pub energy: f64,
    /// Energy of the elastic slip, J/m.
    pub slip_energy: f64,
    /// Work in the velocity update, J/m.
    pub work: f64,
    /// What the update took.
    pub lost: Lost,
}

/// Sweeps stop when no force changes by more than this fraction of the largest.
const TOLERANCE: f64 = 1e-12;
/// Sweeps after which the forces are taken as they are; far beyond what penalties of 100 times the elements' stiffness need.
const SWEEPS: usize = 500;

impl Springs {
    /// For `nodes` nodes and `bodies` rigid bodies.
    #[must_use]
    pub fn new(nodes: usize, bodies: usize) -> Self {
        Self { place: vec![u32::MAX; nodes + bodies], ..Self::default() }
    }

    /// Forgets the springs of the last step.
    pub fn clear(&mut self) {
        self.list.clear();
        self.ends.clear();
        self.groups.clear();
    }

    /// Adds a spring with its ends.
    pub fn push(&mut self, spring: Spring, ends: &[End]) {
        let first = self.ends.len() as u32;
        self.ends.extend_from_slice(ends);
        self.list.push(Spring { first, count: ends.len() as u32, ..spring });
    }

    /// Ends the springs of a contact: what was pushed since the last group follows `terms`.
    pub fn close_group(&mut self, terms: usize) {
        self.groups.push(Group { end: self.list.len(), terms });
    }

    /// The ends of a spring.
    #[must_use]
    pub fn ends(&self, spring: &Spring) -> &[End] {
        &self.ends[spring.first as usize..(spring.first + spring.count) as usize]
    }

    /// Finds the force, work and energy of every spring. `terms` as the groups number them.
    pub fn solve<M: Movers>(&mut self, update: &Update<'_, M>, terms: &[Terms]) {
        if self.list.is_empty() {
            return;
        }
        self.link(update, terms);
        let mut sweep = 1;
        let mut live = std::mem::take(&mut self.live);
        // All springs, then those that push until they agree, then all again: open ones are only looked at.
        loop {
            let all = self.relax(update, terms, None);
            self.sweeps_max = self.sweeps_max.max(sweep);
            if all.0 <= TOLERANCE * all.1 {
                break;
            }
            live.clear();
            live.extend(
                (0..self.list.len() as u32).filter(|&i| self.list[i as usize].force != 0.0 || self.list[i as usize].friction != 0.0),
            );
            loop {
                sweep += 1;
                let (change, largest) = self.relax(update, terms, Some(&live));
                if change <= TOLERANCE * largest || sweep >= SWEEPS {
                    break;
                }
            }
            sweep += 1;
            if sweep > SWEEPS {
                self.unsolved += 1;
                self.sweeps_max = SWEEPS;
                break;
            }
        }
        self.live = live;
        self.book(update, terms);
        for movable in self.movables.drain(..) {
            self.place[movable.at as usize] = u32::MAX;
        }
    }

    /// One sweep over the springs (`only` those, if given): largest change of a force, largest force.
    fn relax<M: Movers>(&mut self, update: &Update<'_, M>, terms: &[Terms], only: Option<&[u32]>) -> (f64, f64) {
        let mut result = (0.0f64, 0.0f64);
        let mut begin = 0;
        let mut rest = only;
        let groups = std::mem::take(&mut self.groups);
        for group in &groups {
            let mut group_of = Relaxing { springs: self, time_steps: update.time_steps, terms: &terms[group.terms] };
            let (change, largest) = match &mut rest {
                None => group_of.sweep(begin as u32..group.end as u32),
                Some(list) => {
                    let (here, others) = list.split_at(list.partition_point(|&i| (i as usize) < group.end));
                    *list = others;
                    group_of.sweep(here.iter().copied())
                }
            };
            result = (result.0.max(change), result.1.max(largest));
            begin = group.end;
        }
        self.groups = groups;
        result
    }

    /// Gathers the nodes and bodies of the springs and what a force does to them.
    fn link<M: Movers>(&mut self, update: &Update<'_, M>, terms: &[Terms]) {
        self.links.clear();
        self.places.clear();
        let [before, after] = update.time_steps;
        let nodes = update.nodes.count();
        for end in &mut self.ends {
            let mut at = end.at;
            if let Some(body) = update.bodies.of_node(at) {
                end.point = update.positions[at as usize];
                at = (nodes + body) as u32;
            } else if (at as usize) < nodes {
                (at, end.image) = update.nodes.leader(at);
            }
            let place = &mut self.place[at as usize];
            if *place == u32::MAX {
                *place = self.movables.len() as u32;
                self.movables.push(movable(at, nodes, update));
            }
            self.places.push(*place);
        }
        let mut groups = self.groups.iter();
        let mut group = groups.next();
        for (i, spring) in self.list.iter().enumerate() {
            while group.is_some_and(|group| i >= group.end) {
                group = groups.next();
            }
            let slips = group.is_some_and(|group| !matches!(terms[group.terms].tangential, Tangential::Free));
            let t = tangent(spring.normal);
            let mut link = Link::default();
            for k in spring.first as usize..(spring.first + spring.count) as usize {
                let (end, movable) = (&self.ends[k], &self.movables[self.places[k] as usize]);
                let row = movable.row(end.gap_row(spring.normal), end);
                link.rate_old += dot(row, movable.velocity_old);
                link.compliance += 0.5 * after * dot(row, movable.response(row));
                if slips {
                    let row = movable.row(end.slip_row(t), end);
                    link.slip_rate_old += dot(row, movable.velocity_old);
                    link.slip_compliance += dot(row, movable.response(row));
                }
            }
            link.gap_old = spring.gap - 0.5 * before * link.rate_old;
            self.links.push(link);
        }
    }

    /// Energies and works of the solved springs.
    fn book<M: Movers>(&mut self, update: &Update<'_, M>, terms: &[Terms]) {
        let [before, after] = update.time_steps;
        let mean_step = 0.5 * (before + after);
        let mut begin = 0;
        for group in &self.groups {
            let terms = &terms[group.terms];
            for i in begin..group.end {
                let link = self.links[i];
                let spring = self.list[i];
                let rates = self.rates(i, spring.force != 0.0 || !matches!(terms.tangential, Tangential::Free));
                let spring_new = &mut self.list[i];
                let gap_new = spring.gap + 0.5 * after * rates[0];
                let (stored_old, stored_new) = (terms.law.stored(&spring, link.gap_old), terms.law.stored(&spring, gap_new));
                // Part of the force that the energy explains; the rest is damping, or a multiplier's.
                let elastic = match terms.law.is_elastic() {
                    false => 0.0,
                    true if terms.damping == 0.0 => spring.force,
                    true => terms.law.mean_force(&spring, link.gap_old, gap_new),
                };
                let bend = gap_new + link.gap_old - 2.0 * spring.gap;
                spring_new.energy = 0.5 * (stored_old + stored_new) + 0.5 * elastic * bend;
                spring_new.stored = [stored_new, 0.0];
                let rate_mean = 0.5 * (link.rate_old + rates[0]);
                let slip_mean = 0.5 * (link.slip_rate_old + rates[1]);
                spring_new.work = mean_step * (spring.force * rate_mean + spring.friction * slip_mean);
                let inelastic = spring.force - elastic;
                spring_new.lost = Lost { damping: -mean_step * inelastic * rate_mean, ..Lost::default() };
                spring_new.lost.old[1] = -mean_step * inelastic * link.rate_old;
                spring_new.slip_rate = rates[1];
                match terms.tangential {
                    Tangential::Free => spring_new.slides = spring.force != 0.0,
                    Tangential::Friction(_) => {
                        spring_new.lost.friction = -mean_step * spring.friction * slip_mean;
                        spring_new.lost.old[0] = -mean_step * spring.friction * link.slip_rate_old;
                        let stiffness = terms.law.slip_stiffness(&spring);
                        if stiffness.is_finite() {
                            spring_new.slip_energy = 0.25 * stiffness * (spring.slip * spring.slip + spring.slip_new * spring.slip_new);
                        }
                    }
                    Tangential::Tied => {
                        let stiffness = terms.law.slip_stiffness(&spring);
                        if stiffness.is_finite() {
                            let (old, new) = (spring.slip - 0.5 * before * link.slip_rate_old, spring.slip + 0.5 * after * rates[1]);
                            spring_new.stored[1] = 0.5 * stiffness * new * new;
                            spring_new.energy +=
                                0.25 * stiffness * (old * old + new * new) + 0.5 * spring.friction * (old + new - 2.0 * spring.slip);
                        } else {
                            spring_new.lost.damping -= mean_step * spring.friction * slip_mean;
                            spring_new.lost.old[1] -= mean_step * spring.friction * link.slip_rate_old;
                        }
                    }
                }
            }
            begin = group.end;
        }
    }

    /// Rates of gap and slip with the present velocities.
    fn rates(&self, i: usize, slips: bool) -> [f64; 2] {
        let spring = &self.list[i];
        let t = tangent(spring.normal);
        let mut rates = [0.0; 2];
        for k in spring.first as usize..(spring.first + spring.count) as usize {
            let (end, movable) = (&self.ends[k], &self.movables[self.places[k] as usize]);
            rates[0] += dot(movable.row(end.gap_row(spring.normal), end), movable.velocity);
            if slips {
                let row = movable.row(end.slip_row(t), end);
                rates[1] += dot(row, movable.velocity);
            }
        }
        rates
    }

    /// Sums up the springs `range`: adds their forces to `forces` (of nodes) and `bodies` (of bodies without nodes at the ends).
    pub fn collect(&self, range: std::ops::Range<usize>, forces: &mut [Vector], bodies: &mut Bodies) -> Totals {
        let mut totals = Totals::default();
        for spring in &self.list[range] {
            totals.energy += spring.energy;
            totals.slip_energy += spring.slip_energy;
            totals.work += spring.work;
            totals.lost += spring.lost;
            if spring.force == 0.0 && spring.friction == 0.0 {
                continue;
            }
            totals.pressing += spring.force.abs();
            for end in self.ends(spring) {
                let force = end.force(spring);
                if end.share > 0.0 {
                    totals.resultant = [totals.resultant[0] + spring.side * force[0], totals.resultant[1] + spring.side * force[1]];
                }
                match forces.get_mut(end.at as usize) {
                    Some(sum) => *sum = [sum[0] + force[0], sum[1] + force[1]],
                    None => bodies.push_at(end.at as usize - forces.len(), force, end.point),
                }
            }
        }
        totals
    }
}

/// A node or rigid body at the beginning of the solution.
fn movable<M: Movers>(at: u32, nodes: usize, update: &Update<'_, M>) -> Movable {
    let mean_step = 0.5 * (update.time_steps[0] + update.time_steps[1]);
    let node = at as usize;
    if node >= nodes {
        let body = update.bodies.state(node - nodes);
        let [x, y, spin] = body.inverse_mass.map(|inverse| mean_step * inverse);
        let (velocity_old, velocity) = (body.velocity_old, body.velocity_free);
        return Movable { at, velocity_old, velocity, mobility: [x, 0.0, y, spin], centre: Some(body.centre) };
    }
    let Mover { velocity_old: [ox, oy], velocity: [vx, vy], mobility: [xx, xy, yy] } = update.nodes.mover(node);
    Movable { at, velocity_old: [ox, oy, 0.0], velocity: [vx, vy, 0.0], mobility: [xx, xy, yy, 0.0], centre: None }
}

/// The sweep over the springs of one contact.
struct Relaxing<'a> {
    springs: &'a mut Springs,
    time_steps: [f64; 2],
    terms: &'a Terms,
}

impl Relaxing<'_> {
    fn sweep(&mut self, indices: impl Iterator<Item = u32>) -> (f64, f64) {
        let (mut change, mut largest) = (0.0f64, 0.0f64);
        let [before, after] = self.time_steps;
        let terms = self.terms;
        let slips = !matches!(terms.tangential, Tangential::Free);
        for i in indices.map(|i| i as usize) {
            let [rate, _] = self.springs.rates(i, false);
            let (spring, link) = (self.springs.list[i], self.springs.links[i]);
            let free = spring.gap + 0.5 * after * rate - link.compliance * spring.force;
            let closing = Closing { spring: &spring, old: link.gap_old, free, compliance: link.compliance };
            let force = if terms.damping > 0.0 {
                super::law::damped(terms.law.as_ref(), &closing, terms.damping, link.rate_old, self.time_steps)
            } else {
                terms.law.force(&closing, self.time_steps)
            };
            let step = force - spring.force;
            if step != 0.0 {
                self.push(i, step, 0.0);
            }
            self.springs.list[i].force = force;
            change = change.max(step.abs());
            largest = largest.max(force.abs());
            if !slips || (force == 0.0 && spring.friction == 0.0 && matches!(terms.tangential, Tangential::Friction(_))) {
                continue;
            }
            let [_, slip_rate] = self.springs.rates(i, true);
            let spring = &mut self.springs.list[i];
            let stick = Stick {
                old: link.slip_rate_old,
                free: slip_rate - link.slip_compliance * spring.friction,
                compliance: link.slip_compliance,
                stiffness: terms.law.slip_stiffness(spring),
                time_steps: [before, after],
            };
            let friction_old = spring.friction;
            match terms.tangential {
                Tangential::Friction(law) => {
                    let limit = law.limit(force, spring.area, link.slip_rate_old);
                    let found = friction::slide(&stick, spring.slip, limit);
                    (spring.friction, spring.slip_new, spring.slides) = (found.friction, found.slip, found.slides);
                }
                _ => spring.friction = friction::tie(&stick, spring.slip),
            }
            let step = spring.friction - friction_old;
            if step != 0.0 {
                self.push(i, 0.0, step);
            }
            change = change.max(step.abs());
        }
        (change, largest)
    }

    /// Adds to the forces of a spring: the velocities at its ends follow.
    #[inline]
    fn push(&mut self, i: usize, force: f64, friction: f64) {
        let springs = &mut *self.springs;
        let spring = &springs.list[i];
        let (n, t) = (spring.normal, tangent(spring.normal));
        for k in spring.first as usize..(spring.first + spring.count) as usize {
            let (end, movable) = (&springs.ends[k], &mut springs.movables[springs.places[k] as usize]);
            let (gap_row, slip_row) = (end.gap_row(n), end.slip_row(t));
            let row = [0, 1].map(|d| gap_row[d] * force + slip_row[d] * friction);
            let response = movable.response(movable.row(row, end));
            for d in 0..3 {
                movable.velocity[d] += response[d];
            }
        }
    }
}

#[inline]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests;
