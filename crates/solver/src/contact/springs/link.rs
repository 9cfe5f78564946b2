//! What springs act on, and how: nodes and rigid bodies with their velocities and mobilities, and the rows of
//! every spring on them.
//!
//! Springs and the state of the step come from [`super::Springs`]; links and arms, island by island, go to
//! [`super::relax`]. Velocities are counted from those that there are without springs: what a force changes
//! is then exact to its own last digits, however fast the bodies move.

use super::couple::{Couplings, Forces};
use super::ends::Ends;
use super::islands::NONE;
use super::{Along, Carrier, KeptEnd, NodeResponse, NodeResponses, Slip, Spring, TangentSpace, Tangential, Terms, Update, sum_along};
use crate::contact::law::Law;
use crate::rigid::RigidMotion;
use crate::tensor::Dim;
use std::ops::Range;

/// A value for each velocity of a node or rigid body.
pub(super) type Row<const D: usize> = <Dim<D> as RigidMotion<D>>::Generalized<f64>;
/// Rows of the slip along each tangent.
pub(super) type Slips<const D: usize> = <Dim<D> as TangentSpace<D>>::TangentVector<Row<D>>;

/// A node or rigid body that springs act on.
#[derive(Clone, Copy)]
pub(super) struct Movable<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// x, y (and z) and, of a rigid body, angular.
    pub(super) velocity_old: Row<D>,
    /// v^{n+½} without springs.
    pub(super) velocity_free: Row<D>,
    pub(super) mobility: <Dim<D> as TangentSpace<D>>::Mobility,
    /// Centre of a rigid body; `None`: a node.
    centre: Option<[f64; D]>,
}

impl<const D: usize> Default for Movable<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        Self { velocity_old: Default::default(), velocity_free: Default::default(), mobility: Default::default(), centre: None }
    }
}

impl<const D: usize> Movable<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// The node or (from `nodes` on) rigid body, or (beyond those) carrier `at` at the beginning of the
    /// solution.
    pub(super) fn new<M: NodeResponses<D>>(at: u32, nodes: usize, update: &Update<'_, M, D>) -> Self {
        let node = at as usize;
        if let Some(carrier) = node.checked_sub(nodes + update.bodies.len()) {
            let Carrier { node: NodeResponse { velocity_old, velocity, mobility }, spins, spin_mobility, centre } =
                update.nodes.carried(carrier);
            let [velocity_old, velocity_free] =
                [(velocity_old, spins[0]), (velocity, spins[1])].map(|(v, spin)| Dim::<D>::generalized_with(v, Dim::<D>::moment_of(spin)));
            let mobility = Dim::<D>::mobility_with_spin(Dim::<D>::mobility_of_node(&mobility), &spin_mobility);
            return Self { velocity_old, velocity_free, mobility, centre: Some(centre) };
        }
        if node >= nodes {
            let mean_step = 0.5 * (update.time_steps[0] + update.time_steps[1]);
            let body = update.bodies.state(node - nodes);
            let (velocity_old, velocity_free) = (body.velocity_old, body.velocity_free);
            return Self { velocity_old, velocity_free, mobility: Dim::<D>::mobility_of_body(body, mean_step), centre: Some(body.centre) };
        }
        let NodeResponse { velocity_old, velocity, mobility } = update.nodes.response(node);
        let [velocity_old, velocity_free] = [velocity_old, velocity].map(|velocity| Dim::<D>::generalized_of(velocity, None));
        Self { velocity_old, velocity_free, mobility: Dim::<D>::mobility_of_node(&mobility), centre: None }
    }

    /// Whether forces move the node or rigid body `at` at all.
    pub(super) fn moves<M: NodeResponses<D>>(at: u32, nodes: usize, update: &Update<'_, M, D>) -> bool {
        if (at as usize) < nodes {
            return update.nodes.moves(at as usize);
        }
        Self::new(at, nodes, update).mobility != Default::default()
    }

    /// Rates of the row `row` at an end, before and without springs, m/s.
    pub(super) fn rates(&self, row: [f64; D], end: &KeptEnd<'_, D>) -> [f64; 2] {
        let row = self.row(row, end);
        [self.velocity_old, self.velocity_free].map(|velocity| Dim::<D>::dot(&row, &velocity))
    }

    /// A row of force `row` at an end, with its moment on a rigid body; of the image of a node as its leader
    /// feels it.
    #[inline]
    pub(super) fn row(&self, mut row: [f64; D], end: &KeptEnd<'_, D>) -> Row<D> {
        if let Some(turn) = end.image() {
            row = Dim::<D>::pull_back(turn, row);
        }
        let arm = |centre: [f64; D]| std::array::from_fn(|d| end.point()[d] - centre[d]);
        Dim::<D>::generalized_of(row, self.centre.map(arm))
    }
}

/// A node or rigid body of an island, as the springs move it.
#[derive(Clone, Copy)]
pub(super) struct Slot<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Of a hub, what the springs have added to the velocity.
    pub(super) change: Row<D>,
    pub(super) mobility: <Dim<D> as TangentSpace<D>>::Mobility,
    pub(super) is_body: bool,
    /// Whether springs there know the slot instead of each other; see [`super::couple`].
    pub(super) is_hub: bool,
}

/// A spring's row of the gap on something that moves.
#[derive(Clone, Copy, Default)]
pub(super) struct Arm<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) slot: u32,
    pub(super) row: Row<D>,
}

/// A spring while it is solved.
#[derive(Clone, Copy)]
pub(super) struct Link<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Number of the spring.
    pub(super) spring: u32,
    /// Its arms in the island.
    pub(super) first: u32,
    pub(super) count: u32,
    /// Change of g^{n+½} per normal force.
    pub(super) compliance: f64,
    /// What its own forces do to its rates, arm by arm: the gap's per normal force, either per the other, the
    /// slips' per friction.
    pub(super) own: <Dim<D> as TangentSpace<D>>::Symmetric,
    pub(super) is_at_hub: bool,
    /// g^n, g^{n−½}.
    pub(super) gap: f64,
    pub(super) gap_old: f64,
    /// g^{n+½} without any force.
    pub(super) gap_free: f64,
    pub(super) rate_old: f64,
    pub(super) rate_free: f64,
    pub(super) slip_rate_old: Along<D>,
    pub(super) slip_rate_free: Along<D>,
    /// Compliances of normal force and friction beyond the spring's own, and the forces at which they change
    /// nothing; see [`super::relax`].
    pub(super) lent: [f64; 2],
    pub(super) centre: Forces<D>,
    /// Elastic slip at n + ½.
    pub(super) slip_new: Along<D>,
    pub(super) slides: bool,
}

impl<const D: usize> Link<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Of a spring whose arms begin at number `first`.
    fn new(spring: u32, first: u32) -> Self {
        let (own, [slip_rate_old, slip_rate_free, slip_new]) = Default::default();
        #[rustfmt::skip]
        let link = Self {
            spring, first, own, slip_rate_old, slip_rate_free, slip_new, count: 0, compliance: 0.0, is_at_hub: false, gap: 0.0,
            gap_old: 0.0, gap_free: 0.0, rate_old: 0.0, rate_free: 0.0, lent: [0.0; 2], centre: [0.0; D], slides: false,
        };
        link
    }

    /// What its own force number `by` does to its rate number `on`; 0 is the normal.
    #[inline(always)]
    pub(super) fn own(&self, on: usize, by: usize) -> f64 {
        self.own[Dim::<D>::AT[on][by]]
    }

    /// What friction in a direction along the surface does to the slip's rate in that direction.
    pub(super) fn own_along(&self, direction: &Along<D>) -> f64 {
        sum_along::<D>(|a| direction[a] * sum_along::<D>(|b| self.own(a + 1, b + 1) * direction[b]))
    }

    #[inline]
    pub(super) fn arms(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// Springs, and what acts in them.
#[derive(Clone, Copy)]
pub(super) struct Laws<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) list: &'a [Spring<D>],
    pub(super) slips: &'a [Slip<D>],
    pub(super) terms: &'a [Terms],
    pub(super) terms_of: &'a [u32],
    pub(super) time_steps: [f64; 2],
}

impl<const D: usize> Laws<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// What acts in a spring.
    #[inline]
    pub(super) fn terms(&self, number: u32) -> &Terms {
        &self.terms[self.terms_of[number as usize] as usize]
    }

    /// Where a spring is along the surface.
    #[inline]
    pub(super) fn slip(&self, number: u32) -> Slip<D> {
        self.slips.get(number as usize).copied().unwrap_or_default()
    }

    /// The directions along the surface of a spring; none where nothing acts along it.
    #[inline]
    pub(super) fn tangents(&self, number: u32) -> <Dim<D> as TangentSpace<D>>::Tangents {
        match self.terms(number).tangential {
            Tangential::Free => Default::default(),
            _ => Dim::<D>::tangents(self.list[number as usize].normal, &self.slip(number).tangent),
        }
    }
}

/// Ends of springs, and what is at them.
pub(super) struct Joints<'a, M: NodeResponses<D>, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) laws: Laws<'a, D>,
    /// Where springs ended; see [`super::Springs::continues`].
    pub(super) ended: &'a [[f64; 2]],
    pub(super) ends: &'a Ends<D>,
    /// Place of each end.
    pub(super) places: &'a [u32],
    /// Node or rigid body of each place.
    pub(super) at: &'a [u32],
    /// Slot of each place in its island; [`NONE`]: it does not move.
    pub(super) slots: &'a [u32],
    pub(super) update: &'a Update<'a, M, D>,
}

/// An island while it is solved. It stays in the caches where islands are small.
#[derive(Default)]
pub(super) struct Bench<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    pub(super) links: Vec<Link<D>>,
    pub(super) arms: Vec<Arm<D>>,
    /// Rows of the slips, as `arms`; empty where no spring cares.
    pub(super) slips: Vec<Slips<D>>,
    pub(super) slots: Vec<Slot<D>>,
    pub(super) forces: Vec<Forces<D>>,
    pub(super) couplings: Couplings<D>,
    /// What is in each slot.
    movables: Vec<Movable<D>>,
}

/// Links of an island that one task fills, with the arms that are theirs.
struct Part<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    links: &'a mut [Link<D>],
    /// Number of the first arm.
    first: usize,
    arms: &'a mut [Arm<D>],
    slips: &'a mut [Slips<D>],
}

impl<const D: usize> Part<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// The links before number `middle`, and the others.
    fn split(self, middle: usize) -> [Self; 2] {
        let Part { links, first, arms, slips } = self;
        let to = links.get(middle).map_or(arms.len(), |link| link.first as usize - first);
        let (links, arms, slips) = (links.split_at_mut(middle), arms.split_at_mut(to), slips.split_at_mut(to.min(slips.len())));
        [
            Part { links: links.0, first, arms: arms.0, slips: slips.0 },
            Part { links: links.1, first: first + to, arms: arms.1, slips: slips.1 },
        ]
    }
}

impl<const D: usize> Bench<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// The links of the `springs` of an island, their arms, what is in the slots, and what springs do to each
    /// other; no force acts yet. Parts of `length` links each are filled at the same time.
    pub(super) fn fill<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, springs: &[u32], length: usize) {
        self.links.clear();
        self.slots.clear();
        self.movables.clear();
        let slides = springs.iter().any(|&number| !matches!(joints.laws.terms(number).tangential, Tangential::Free));
        let (mut arms, mut met) = (0, Vec::new());
        for &number in springs {
            let mut link = Link::new(number, arms);
            let joins_ends = joints.laws.terms(number).law.joins_ends();
            met.clear();
            for k in joints.laws.list[number as usize].ends() {
                let slot = joints.slots[joints.places[k] as usize];
                if slot == NONE {
                    continue;
                }
                if joins_ends {
                    if met.contains(&slot) {
                        continue;
                    }
                    met.push(slot);
                }
                arms += 1;
                // Slots are met in the order of their numbers.
                if slot as usize == self.movables.len() {
                    let movable = joints.movable(k);
                    let (mobility, is_body) = (movable.mobility, movable.centre.is_some());
                    self.slots.push(Slot { change: Default::default(), mobility, is_body, is_hub: false });
                    self.movables.push(movable);
                }
            }
            link.count = arms - link.first;
            self.links.push(link);
        }
        self.arms.resize(arms as usize, Arm::default());
        self.slips.resize(if slides { arms as usize } else { 0 }, Slips::<D>::default());
        joints.fill(Part { links: &mut self.links, first: 0, arms: &mut self.arms, slips: &mut self.slips }, &self.movables, length);
        self.forces.clear();
        self.forces.resize(self.links.len(), [0.0; D]);
        self.couplings.find(&mut self.links, &self.arms, &self.slips, &mut self.slots, length);
    }
}

impl<M: NodeResponses<D> + Sync, const D: usize> Joints<'_, M, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// What is at the end `k`.
    pub(super) fn movable(&self, k: usize) -> Movable<D> {
        Movable::new(self.at[self.places[k] as usize], self.update.nodes.count(), self.update)
    }

    /// Fills links and their arms, in parts of `length` links that are shared among the threads.
    fn fill(&self, part: Part<'_, D>, movables: &[Movable<D>], length: usize) {
        let count = part.links.len().div_ceil(length);
        if count > 1 {
            let [low, high] = part.split(count / 2 * length);
            rayon::join(|| self.fill(low, movables, length), || self.fill(high, movables, length));
            return;
        }
        let Part { links, first, arms, slips } = part;
        for link in links {
            let own = link.arms().start - first..link.arms().end - first;
            let slips = if slips.is_empty() { &mut [][..] } else { &mut slips[own.clone()] };
            self.link(link, &mut arms[own], slips, movables);
        }
    }

    /// Fills the link of a spring and its arms.
    fn link(&self, link: &mut Link<D>, arms: &mut [Arm<D>], slips: &mut [Slips<D>], movables: &[Movable<D>]) {
        let number = link.spring;
        let (spring, terms) = (&self.laws.list[number as usize], self.laws.terms(number));
        let [before, after] = self.laws.time_steps;
        let has_slip = !matches!(terms.tangential, Tangential::Free);
        let tangents = self.laws.tangents(number);
        let joins_ends = terms.law.joins_ends();
        let mut next = 0;
        for k in spring.ends() {
            let (end, slot) = (self.ends.get(k), self.slots[self.places[k] as usize]);
            let held = (slot == NONE).then(|| self.movable(k));
            let movable = held.as_ref().unwrap_or_else(|| &movables[slot as usize]);
            let row = movable.row(end.gap_row(spring.normal), &end);
            let mut slip_row = Slips::<D>::default();
            link.rate_old += Dim::<D>::dot(&row, &movable.velocity_old);
            link.rate_free += Dim::<D>::dot(&row, &movable.velocity_free);
            if has_slip {
                let rows = end.slip_rows(&tangents);
                for a in 0..D - 1 {
                    slip_row[a] = movable.row(rows[a], &end);
                    link.slip_rate_old[a] += Dim::<D>::dot(&slip_row[a], &movable.velocity_old);
                    link.slip_rate_free[a] += Dim::<D>::dot(&slip_row[a], &movable.velocity_free);
                }
            }
            if slot == NONE {
                continue;
            }
            if joins_ends {
                if let Some(arm) = arms[..next].iter_mut().find(|arm| arm.slot == slot) {
                    arm.row = Dim::<D>::generalized(|d| arm.row[d] + row[d]);
                } else {
                    arms[next] = Arm { slot, row };
                    next += 1;
                }
                continue;
            }
            let response = Dim::<D>::response(&movable.mobility, &row);
            link.own[0] += Dim::<D>::dot(&row, &response);
            if has_slip {
                for a in 0..D - 1 {
                    link.own[Dim::<D>::AT[0][a + 1]] += Dim::<D>::dot(&slip_row[a], &response);
                }
                for a in 0..D - 1 {
                    let response = Dim::<D>::response(&movable.mobility, &slip_row[a]);
                    for b in a..D - 1 {
                        link.own[Dim::<D>::AT[a + 1][b + 1]] += Dim::<D>::dot(&slip_row[b], &response);
                    }
                }
            }
            arms[next] = Arm { slot, row };
            if let Some(slips) = slips.get_mut(next) {
                *slips = slip_row;
            }
            next += 1;
        }
        if joins_ends {
            let own = |arm: &Arm<D>| Dim::<D>::dot(&arm.row, &Dim::<D>::response(&movables[arm.slot as usize].mobility, &arm.row));
            link.own[0] = arms.iter().map(own).sum();
        }
        link.compliance = 0.5 * after * link.own[0];
        (link.gap, link.gap_old) = begins(self, number, link.rate_old, before);
        link.gap_free = link.gap + 0.5 * after * link.rate_free;
    }
}

/// Gaps g^n and g^{n−½} with which a spring begins the update, m, where its gap changed at `rate_old` (m/s)
/// in the step `before` (s).
pub(super) fn begins<M: NodeResponses<D>, const D: usize>(joints: &Joints<'_, M, D>, number: u32, rate_old: f64, before: f64) -> (f64, f64)
where
    Dim<D>: TangentSpace<D>,
{
    let spring = &joints.laws.list[number as usize];
    let begins = spring.gap - 0.5 * before * rate_old;
    match joints.ended.get(number as usize) {
        Some(&[half, stored]) if !half.is_nan() => {
            let law = joints.laws.terms(number).law.as_ref();
            let open = law.reach();
            let old = if half < open { gap_of(law, spring, half, stored) } else { begins.max(open) };
            (old + 0.5 * before * rate_old, old)
        }
        _ => (spring.gap, begins),
    }
}

/// The gap at which a spring stores what it had at the gap `half` (m): elsewhere if it is as stiff as another
/// face now. Newton's iteration; energies are convex.
fn gap_of<const D: usize>(law: &dyn Law, spring: &Spring<D>, half: f64, stored: f64) -> f64
where
    Dim<D>: TangentSpace<D>,
{
    let (patch, mut gap) = (spring.patch(), half);
    for _ in 0..50 {
        let more = law.stored(&patch, gap) - stored;
        // Nearly always at once.
        if !(more.abs() > 4.0 * f64::EPSILON * stored) {
            break;
        }
        let force = law.mean_force(&patch, gap, gap);
        if !(force > 0.0) {
            break;
        }
        gap += more / force;
    }
    gap
}
