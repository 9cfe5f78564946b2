//! How the springs of an island feel each other: what a force at one adds to the rates of gap and slip at
//! another, by way of the nodes that both act on.
//!
//! Arms come from [`super::link`], the rates go to [`super::relax`] in every sweep. With row·v the rate of a
//! spring's gap (or slip) and M the mobility of a node, a force F_j with the row r_j changes the rate of i by
//! r_i · M r_j F_j. These numbers do not change while an island is solved, so a sweep reads them and the
//! forces only: two springs that follow each other wait for one multiplication, not for a velocity to be
//! written and read again. Where many springs meet (rigid bodies, the nodes of a segment that is much longer
//! than those on it) pairs would be too many: such hubs keep what the springs have added to their velocity.

use super::link::{Arm, Link, Slips, Slot};
use crate::contact::springs::TangentSpace;
use crate::rigid::RigidMotion;
use crate::rows::Rows;
use crate::tensor::Dim;
use crate::vector::dot;
use rayon::prelude::*;
use std::ops::Range;

/// Springs at a node that know each other one by one; with more it is a hub.
const PAIRS: usize = 8;

/// An arm at a slot.
#[derive(Clone, Copy)]
pub(super) struct SlotArm<const D: usize> {
    pub(super) link: u32,
    pub(super) arm: u32,
    /// The force in its row: all that there is at a node.
    force: [f64; D],
}

impl<const D: usize> Default for SlotArm<D> {
    fn default() -> Self {
        Self { link: 0, arm: 0, force: [0.0; D] }
    }
}

/// Springs by what they share.
#[derive(Default)]
pub(super) struct Couplings<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// What touches each slot, in the order of the links.
    touches: Rows<SlotArm<D>>,
    /// Parts of the links, each but the last of 2^`shift`.
    parts: Vec<Part<D>>,
    shift: u32,
    /// Whether anything cares for slip.
    slides: bool,
}

/// What is at the links of a part, row by row.
#[derive(Default)]
struct Part<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Where the neighbours of each link end.
    rows: Vec<u32>,
    neighbours: Vec<u32>,
    /// Rate of the gap per normal force of each neighbour.
    normal: Vec<f64>,
    /// What has to do with friction and slip; empty where nothing cares for slip.
    along: Vec<Cross<D>>,
    /// Where each link of the island was last found among the neighbours.
    found: Vec<u32>,
}

/// An island as all parts see it.
#[derive(Clone, Copy)]
struct Whole<'a, const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    touches: &'a Rows<SlotArm<D>>,
    arms: &'a [Arm<D>],
    slips: &'a [Slips<D>],
    slots: &'a [Slot<D>],
    links: usize,
}

/// What friction does to a gap, and what forces do to slips.
#[derive(Clone, Copy)]
struct Cross<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Rate of the gap per friction along each tangent.
    gap: <Dim<D> as TangentSpace<D>>::TangentVector<f64>,
    /// Rate of each slip per normal force.
    slip: <Dim<D> as TangentSpace<D>>::TangentVector<f64>,
    /// The same per friction along each tangent.
    along: <Dim<D> as TangentSpace<D>>::TangentVector<<Dim<D> as TangentSpace<D>>::TangentVector<f64>>,
}

impl<const D: usize> Default for Cross<D>
where
    Dim<D>: TangentSpace<D>,
{
    fn default() -> Self {
        Self { gap: Default::default(), slip: Default::default(), along: Default::default() }
    }
}

/// Normal force and friction of a spring along each tangent, N/m.
pub(super) type Forces<const D: usize> = [f64; D];
/// Rates of the gap and of the slip along each tangent, m/s.
pub(super) type Rates<const D: usize> = [f64; D];

impl<const D: usize> Couplings<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Finds who touches which slot, which slots are hubs, and what springs do to each other, in parts of
    /// `length` links, a power of two; `slips` are empty where none of them cares for slip.
    pub(super) fn find(&mut self, links: &mut [Link<D>], arms: &[Arm<D>], slips: &[Slips<D>], slots: &mut [Slot<D>], length: usize) {
        let touch = |i: usize, k: usize| SlotArm { link: i as u32, arm: k as u32, force: Dim::<D>::force_of(&arms[k].row) };
        let at_arms = |(i, link): (usize, &Link<D>)| link.arms().map(move |k| (arms[k].slot, touch(i, k)));
        self.touches.fill(slots.len(), links.iter().enumerate().flat_map(at_arms));
        for (number, slot) in slots.iter_mut().enumerate() {
            slot.is_hub = slot.is_body || self.touches.of(number).len() > PAIRS;
        }
        (self.shift, self.slides) = (length.trailing_zeros(), !slips.is_empty());
        let count = links.len().div_ceil(length);
        if self.parts.len() < count {
            self.parts.resize_with(count, Part::default);
        }
        let whole = Whole { touches: &self.touches, arms, slips, slots, links: links.len() };
        match &mut self.parts[..count] {
            [part] => whole.fill(0, links, part),
            parts => {
                let parts = links.par_chunks_mut(length).zip(parts).enumerate();
                parts.for_each(|(number, (links, part))| whole.fill(number * length, links, part));
            }
        }
    }

    /// The arms at a slot.
    pub(super) fn touches(&self, slot: usize) -> &[SlotArm<D>] {
        self.touches.of(slot)
    }

    /// The part of a link, and where its neighbours are there.
    #[inline]
    fn row(&self, i: usize) -> (&Part<D>, Range<usize>) {
        let (part, own) = (&self.parts[i >> self.shift], i & ((1 << self.shift) - 1));
        let begin = if own == 0 { 0 } else { part.rows[own - 1] };
        (part, begin as usize..part.rows[own] as usize)
    }

    /// The links that share a slot with link `i`, but for hubs.
    pub(super) fn neighbours(&self, i: usize) -> &[u32] {
        let (part, row) = self.row(i);
        &part.neighbours[row]
    }

    /// What the forces of its neighbours do to the rates of link `i`: rows of the gap's and the slips' rates.
    pub(super) fn pairs(&self, i: usize) -> impl Iterator<Item = (usize, [[f64; D]; D])> {
        let (part, row) = self.row(i);
        row.map(|place| {
            let Cross { gap, slip, along } = part.along.get(place).copied().unwrap_or_default();
            let mut pair = [[0.0; D]; D];
            pair[0][0] = part.normal[place];
            for a in 0..D - 1 {
                (pair[0][a + 1], pair[a + 1][0]) = (gap[a], slip[a]);
                (0..D - 1).for_each(|b| pair[a + 1][b + 1] = along[a][b]);
            }
            (part.neighbours[place] as usize, pair)
        })
    }

    /// What the forces of its neighbours add to the rates of link `i`.
    #[inline]
    pub(super) fn rates(&self, i: usize, forces: &[Forces<D>]) -> Rates<D> {
        let (part, row) = self.row(i);
        let (neighbours, normal) = (&part.neighbours[row.clone()], &part.normal[row.clone()]);
        let mut rates = [0.0; D];
        if !self.slides {
            for (&j, normal) in neighbours.iter().zip(normal) {
                rates[0] += normal * forces[j as usize][0];
            }
            return rates;
        }
        for ((&j, normal), cross) in neighbours.iter().zip(normal).zip(&part.along[row]) {
            let forces = &forces[j as usize];
            let mut sum = normal * forces[0];
            for b in 0..D - 1 {
                sum += cross.gap[b] * forces[b + 1];
            }
            rates[0] += sum;
            for a in 0..D - 1 {
                let mut sum = cross.slip[a] * forces[0];
                for b in 0..D - 1 {
                    sum += cross.along[a][b] * forces[b + 1];
                }
                rates[a + 1] += sum;
            }
        }
        rates
    }
}

impl<const D: usize> Whole<'_, D>
where
    Dim<D>: TangentSpace<D>,
{
    /// What the springs of a part, the first of which has the number `first`, have to do with others.
    fn fill(self, first: usize, links: &mut [Link<D>], part: &mut Part<D>) {
        let Self { touches, arms, slips, slots, .. } = self;
        let slides = !slips.is_empty();
        let Part { rows, neighbours, normal, along, found } = part;
        rows.clear();
        neighbours.clear();
        normal.clear();
        along.clear();
        found.clear();
        found.resize(self.links, 0);
        for (i, link) in links.iter_mut().enumerate() {
            let begin = neighbours.len();
            for k in link.arms() {
                let (number, row) = (arms[k].slot as usize, arms[k].row);
                let slot = &slots[number];
                if slot.is_hub {
                    link.is_at_hub = true;
                    continue;
                }
                // No body is here: what is no hub is a node.
                let respond = |row| Dim::<D>::response_of_node(&slot.mobility, Dim::<D>::force_of(row));
                let response = respond(&row);
                let response_along = Dim::<D>::vectors(|a| if slides { respond(&slips[k][a]) } else { [0.0; D] });
                for &SlotArm { link: j, arm: other, force } in touches.of(number) {
                    // Ends that move as one leave a spring its own neighbour.
                    if j as usize == first + i && other as usize == k {
                        continue;
                    }
                    let known = found[j as usize] as usize;
                    let place = if known >= begin && neighbours.get(known) == Some(&j) { known } else { neighbours.len() };
                    if place == neighbours.len() {
                        found[j as usize] = place as u32;
                        neighbours.push(j);
                        normal.push(0.0);
                        if slides {
                            along.push(Cross::default());
                        }
                    }
                    // Mobilities are symmetric: what j does to i is what i does to j.
                    normal[place] += dot(response, force);
                    if slides {
                        let cross = &mut along[place];
                        let slip = Dim::<D>::vectors(|a| Dim::<D>::force_of(&slips[other as usize][a]));
                        for a in 0..D - 1 {
                            cross.gap[a] += dot(response, slip[a]);
                            cross.slip[a] += dot(response_along[a], force);
                            for b in 0..D - 1 {
                                cross.along[a][b] += dot(response_along[a], slip[b]);
                            }
                        }
                    }
                }
            }
            rows.push(neighbours.len() as u32);
        }
    }
}
