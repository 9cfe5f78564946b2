//! What pinballs in 2D and 3D have in common: disks or balls in elements, where they go, and
//! which of them are near each other.
//!
//! The balls come from the elements under the surfaces ([`super`] and [`super::space`] say where they are and
//! how large), pairs from the global search. Springs are made of what is near by the formulations, which know
//! friction; slips are kept here, pair by pair.

use super::super::Sweep;
use super::super::initial::{is_ignored, kept};
use super::super::law::penalty;
use super::super::search::{Pair, Query, Search};
use super::super::springs::Spring;
use super::super::tracker::{SKIN, SearchReport};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact::springs::TangentSpace;
use crate::model;
use crate::tensor::Dim;
use crate::vector::{length, minus};

/// Balls of one element nearer than this fraction of their radii are one: at a corner, and where both sides
/// of a thin body are in one element. A little more than a half, which elements with L/h = 1.5 have in their
/// corners: round-off is not to decide.
const SAME: f64 = 0.500001;

/// What differs between the dimensions.
pub(super) trait Round<const D: usize>: TangentSpace<D> {
    /// What is kept of the elastic slip of two balls, m.
    type Slip: Copy + Default + Persist;
    /// So many times the last motion is searched ahead.
    const AHEAD: f64;

    /// Length of a vector: in 2D as the platform's `hypot` rounds it, which its results depend on.
    fn length(vector: [f64; D]) -> f64;
    /// Length of surface that a disk stands for, or the side of the square of a ball's area, m.
    fn width(area: f64) -> f64;
    /// The slip of the second against the first.
    fn reversed(slip: Self::Slip) -> Self::Slip;
}

impl Round<2> for Dim<2> {
    type Slip = f64;
    const AHEAD: f64 = 4.0;

    fn length([x, y]: [f64; 2]) -> f64 {
        x.hypot(y)
    }
    fn width(area: f64) -> f64 {
        area
    }
    /// The tangent turns over with the normal.
    fn reversed(slip: f64) -> f64 {
        slip
    }
}

impl Round<3> for Dim<3> {
    type Slip = [f64; 3];
    const AHEAD: f64 = 8.0;

    fn length(vector: [f64; 3]) -> f64 {
        length(vector)
    }
    fn width(area: f64) -> f64 {
        area.sqrt()
    }
    fn reversed(slip: [f64; 3]) -> [f64; 3] {
        slip.map(|s| -s)
    }
}

/// A disk or a ball in an element of at most N nodes: its centre as shares of nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ball<const N: usize> {
    pub(super) nodes: [u32; N],
    pub(super) shares: [f64; N],
    /// Nodes that count.
    pub(super) count: usize,
    /// m.
    pub(super) radius: f64,
    /// Length or area of surface that it stands for, m or m².
    pub(super) area: f64,
    /// κ of the element, Pa/m.
    pub(super) stiffness: f64,
}

impl<const N: usize> Default for Ball<N> {
    fn default() -> Self {
        Self { nodes: [0; N], shares: [0.0; N], count: 0, radius: 0.0, area: 0.0, stiffness: 0.0 }
    }
}

impl<const N: usize> Ball<N> {
    /// Adds a share of a node.
    pub(super) fn add(&mut self, node: u32, share: f64) {
        match self.nodes[..self.count].iter().position(|&other| other == node) {
            Some(same) => self.shares[same] += share,
            None => {
                (self.nodes[self.count], self.shares[self.count]) = (node, share);
                self.count += 1;
            }
        }
    }

    pub(super) fn centre<const D: usize>(&self, positions: &[[f64; D]]) -> [f64; D] {
        let mut centre = [0.0; D];
        for (&node, share) in self.nodes[..self.count].iter().zip(self.shares) {
            let x = positions[node as usize];
            (0..D).for_each(|d| centre[d] += share * x[d]);
        }
        centre
    }

    fn shares_a_node_with(&self, other: &Self) -> bool {
        self.nodes[..self.count].iter().any(|node| other.nodes[..other.count].contains(node))
    }

    /// Whether both are in one element, and nearly in one place.
    pub(super) fn is_as<const D: usize>(&self, other: &Self, positions: &[[f64; D]]) -> bool
    where
        Dim<D>: Round<D>,
    {
        let (mut mine, mut theirs) = (self.nodes, other.nodes);
        mine.sort_unstable();
        theirs.sort_unstable();
        let away = minus(self.centre(positions), other.centre(positions));
        mine == theirs && Dim::<D>::length(away) < SAME * self.radius.min(other.radius)
    }
}

/// Two balls that are near each other.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Near<S> {
    pub(super) pair: [u32; 2],
    /// Elastic slip, m.
    pub(super) slip: S,
    /// Gap that counts as zero, m; not positive.
    offset: f64,
    /// Whether the pair was there before the surfaces changed.
    known: bool,
}

impl<S: Persist> Persist for Near<S> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { pair, slip, offset, known } = self;
        persist_each!(archive; pair, slip, offset, known);
        Ok(())
    }
}

/// How two balls lie in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lying<const D: usize> {
    /// From the centre of the second to that of the first, m, and its length.
    pub(super) away: [f64; D],
    pub(super) distance: f64,
    /// Gap less the thickness and what counts as zero, m.
    pub(super) gap: f64,
}

/// Follows the balls of one surface along those of another one, or of the same.
pub(super) struct Follower<const D: usize, const N: usize>
where
    Dim<D>: Round<D>,
{
    pub(super) balls: Vec<Ball<N>>,
    /// Balls of the first surface come first; of a contact of bodies with themselves all.
    first: usize,
    search: Box<dyn Search<D>>,
    penalty: model::Penalty,
    /// Distance that the balls keep and largest gap at which the law pushes, m.
    thickness: f64,
    pub(super) reach: f64,
    /// Whether gaps that are negative when the contact begins to act count as zero.
    ignores_start: bool,
    pub(super) has_begun: bool,
    /// How far balls may move before the next search, m: half of it.
    pub(super) skin: f64,
    centres_old: Vec<[f64; D]>,
    centres: Vec<[f64; D]>,
    /// Centres at the last search; empty before the first.
    searched: Vec<[f64; D]>,
    /// Centres at the start, m, and the body of each ball.
    initial: Vec<[f64; D]>,
    bodies: Vec<u32>,
    pairs: Vec<Pair>,
    /// Ascending by pairs.
    pub(super) near: Vec<Near<<Dim<D> as Round<D>>::Slip>>,
    before: Vec<Near<<Dim<D> as Round<D>>::Slip>>,
    pub(super) report: SearchReport,
}

impl<const D: usize, const N: usize> Follower<D, N>
where
    Dim<D>: Round<D>,
{
    /// Of the balls under one surface that meets itself, or under two; `bodies` of each node of the model,
    /// `positions` the initial ones, m; `reach` of the law, m.
    pub(super) fn new(
        layers: Vec<Vec<Ball<N>>>,
        interface: &model::Interface,
        penalty: model::Penalty,
        reach: f64,
        search: Box<dyn Search<D>>,
        (bodies, positions): (&[u32], &[[f64; D]]),
    ) -> Self {
        let first = layers.first().map_or(0, Vec::len);
        let balls = layers.concat();
        let skin = SKIN * balls.iter().map(|ball| Dim::<D>::width(ball.area)).sum::<f64>() / balls.len().max(1) as f64;
        let of = |ball: &Ball<N>| bodies.get(ball.nodes[0] as usize).copied().unwrap_or(u32::MAX);
        Self {
            first,
            search,
            penalty,
            thickness: interface.thickness,
            reach,
            ignores_start: is_ignored(interface),
            has_begun: false,
            skin,
            centres_old: Vec::new(),
            centres: Vec::new(),
            searched: Vec::new(),
            initial: balls.iter().map(|ball| ball.centre(positions)).collect(),
            bodies: balls.iter().map(of).collect(),
            pairs: Vec::new(),
            near: Vec::new(),
            before: Vec::new(),
            report: SearchReport { skin, ..SearchReport::default() },
            balls,
        }
    }

    fn meets_itself(&self) -> bool {
        self.first == self.balls.len()
    }

    /// Moves the centres; searches again where some ball has left the skin.
    pub(super) fn follow(&mut self, sweep: Sweep<'_, D>) {
        for (centres, positions) in [(&mut self.centres_old, sweep.old), (&mut self.centres, sweep.new)] {
            centres.clear();
            centres.extend(self.balls.iter().map(|ball| ball.centre(positions)));
        }
        self.report.steps += 1;
        let limit = 0.5 * self.skin;
        let left = |(x, from): (&[f64; D], &[f64; D])| !(Dim::<D>::length(minus(*x, *from)) <= limit); // NaN counts as moved
        if self.searched.is_empty() || self.centres.iter().zip(&self.searched).any(left) {
            self.search();
        }
    }

    fn search(&mut self) {
        let way = |(x, old): (&[f64; D], &[f64; D])| Dim::<D>::length(minus(*x, *old));
        let fastest = self.centres.iter().zip(&self.centres_old).map(way).fold(0.0, f64::max);
        let ahead = self.thickness + self.reach + self.skin + Dim::<D>::AHEAD * fastest;
        let largest = |balls: &[Ball<N>]| balls.iter().map(|ball| ball.radius).fold(0.0, f64::max);
        let from = if self.meets_itself() { 0 } else { self.first };
        let slaves: Vec<u32> = (0..self.first as u32).collect();
        let facets: Vec<[u32; D]> = (from as u32..self.balls.len() as u32).map(|ball| [ball; D]).collect();
        let query = Query {
            positions_old: &self.centres_old,
            positions_new: &self.centres,
            slaves: &slaves,
            facets: &facets,
            reach: ahead + largest(&self.balls[..self.first]) + largest(&self.balls[from..]),
        };
        self.search.pairs(&query, &mut self.pairs);
        self.report.searches += 1;
        std::mem::swap(&mut self.near, &mut self.before);
        self.near.clear();
        for pair in &self.pairs {
            let pair = [pair.slave, pair.facet + from as u32];
            let [one, other] = pair.map(|ball| &self.balls[ball as usize]);
            if (self.meets_itself() && pair[0] >= pair[1]) || one.shares_a_node_with(other) {
                continue;
            }
            let apart = |centres: &[[f64; D]]| {
                let [a, b] = pair.map(|ball| centres[ball as usize]);
                Dim::<D>::length(minus(a, b))
            };
            // What came from afar within the step may have passed: both ends of it count.
            if apart(&self.centres).min(apart(&self.centres_old)) <= ahead + one.radius + other.radius {
                let known = self.before.binary_search_by_key(&pair, |near| near.pair).ok();
                self.near.push(known.map_or(Near { pair, ..Near::default() }, |at| self.before[at]));
            }
        }
        self.searched.clone_from(&self.centres);
    }

    /// How the balls of `near[index]` lie; what counts as zero is noted. A body keeps no more distance from
    /// itself than half of what it had.
    pub(super) fn lying(&mut self, index: usize) -> Lying<D> {
        let near = self.near[index];
        let [mine, theirs] = near.pair.map(|ball| ball as usize);
        let away = minus(self.centres[mine], self.centres[theirs]);
        let distance = Dim::<D>::length(away);
        let own = self.bodies[mine] == self.bodies[theirs];
        let touching = self.balls[mine].radius + self.balls[theirs].radius;
        let mut gap = distance - touching - self.thickness;
        if own {
            let had = Dim::<D>::length(minus(self.initial[mine], self.initial[theirs])) - touching;
            gap += (self.thickness + self.reach - 0.5 * had.max(0.0)).max(0.0);
        }
        let offset = kept(self.has_begun || near.known, near.offset, gap);
        let offset = if self.ignores_start || own { offset } else { 0.0 };
        self.near[index].offset = offset;
        Lying { away, distance, gap: gap - offset }
    }

    /// How far the balls of a pair have moved with respect to each other in the step, m.
    pub(super) fn motion(&self, pair: [u32; 2]) -> f64 {
        let away = |centres: &[[f64; D]]| {
            let [a, b] = pair.map(|ball| centres[ball as usize]);
            minus(a, b)
        };
        Dim::<D>::length(minus(away(&self.centres), away(&self.centres_old)))
    }

    /// The spring of a pair, without slip.
    pub(super) fn spring(&self, pair: [u32; 2], lying: &Lying<D>) -> Spring<D> {
        let Lying { away, distance, gap } = *lying;
        // Balls in one place have no direction: any will do.
        let mut normal = [0.0; D];
        normal[0] = 1.0;
        if distance > 0.0 {
            normal = away.map(|part| part / distance);
        }
        let [one, other] = pair.map(|ball| &self.balls[ball as usize]);
        let area = one.area.min(other.area);
        let stiffness = area * penalty::pressure(self.penalty, one.stiffness, other.stiffness);
        Spring { normal, gap, stiffness, area, side: if self.meets_itself() { 0.0 } else { 1.0 }, ..Spring::default() }
    }

    /// Keeps what is known of the past.
    pub(super) fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult
    where
        [f64; D]: Default,
    {
        #[rustfmt::skip]
        let Self {
            first: _, search: _, penalty: _, thickness: _, reach: _, ignores_start: _, skin: _, centres_old: _, centres: _, initial: _,
            bodies: _, pairs: _, before: _, report: _,
            balls, has_begun, searched, near,
        } = self;
        persist_each!(archive; has_begun, searched, near);
        archive.check(searched.is_empty() || searched.len() == balls.len(), "pinballs were searched at other places")?;
        let is_there = |near: &Near<_>| near.pair.iter().all(|&ball| (ball as usize) < balls.len());
        archive.check(near.iter().all(is_there), "a pinball is not there")
    }

    /// Takes over what another one knew whose surfaces were those before they changed: of balls that are
    /// still there.
    pub(super) fn inherit(&mut self, old: &Self) {
        let mut by_nodes: Vec<([u32; N], usize)> = self.balls.iter().map(|ball| ball.nodes).zip(0..).collect();
        by_nodes.sort_unstable();
        let find = |ball: u32| {
            let ball = &old.balls[ball as usize];
            let first = by_nodes.partition_point(|&(nodes, _)| nodes < ball.nodes);
            let same = by_nodes[first..].iter().take_while(|&&(nodes, _)| nodes == ball.nodes).map(|&(_, index)| index);
            same.into_iter().find(|&index| self.balls[index].shares == ball.shares).map(|index| index as u32)
        };
        let now = |near: &Near<<Dim<D> as Round<D>>::Slip>| {
            let mut pair = [find(near.pair[0])?, find(near.pair[1])?];
            let is_turned = self.meets_itself() && pair[0] > pair[1];
            if is_turned {
                pair.reverse();
            }
            let slip = if is_turned { Dim::<D>::reversed(near.slip) } else { near.slip };
            Some(Near { pair, slip, known: old.has_begun, ..*near })
        };
        // The first search looks what is known of its pairs up here. Balls that come to light may be in each
        // other, where their body has been squeezed: that counts as zero.
        let mut near: Vec<_> = old.near.iter().filter_map(now).collect();
        near.sort_by_key(|near| near.pair);
        self.near = near;
        self.report = SearchReport { skin: self.skin, ..old.report };
    }
}
