//! How the springs of an island feel each other: what a force at one adds to the rates of gap and slip at another, by way of the nodes that both act on.
//!
//! Arms come from [`super::link`], the rates go to [`super::relax`] in every sweep. With row·v the rate of a spring's gap (or slip) and M the mobility of a node, a force F_j with the
//! row r_j changes the rate of i by r_i · M r_j F_j. These numbers do not change while an island is solved, so a sweep reads them and the forces only: two springs that follow
//! each other wait for one multiplication, not for a velocity to be written and read again. Where many springs meet (rigid bodies, the nodes of a segment that is much longer than those
//! on it) pairs would be too many: such hubs keep what the springs have added to their velocity.

use super::link::{Arm, Link, Slot, dot};
use crate::rows::Rows;
use std::ops::Range;

/// Springs at a node that know each other one by one; with more it is a hub.
const PAIRS: usize = 8;

/// Springs by what they share.
#[derive(Default)]
pub(super) struct Couplings {
    /// The (link, arm) at each slot, in the order of the links.
    touches: Rows<[u32; 2]>,
    /// Where the neighbours of each link end.
    rows: Vec<u32>,
    neighbours: Vec<u32>,
    /// Rate of the gap per normal force of each neighbour.
    normal: Vec<f64>,
    /// Rate of the gap per friction, of the slip per normal force and per friction; empty where nothing cares for slip.
    along: Vec<[f64; 3]>,
    /// Where each link was last found among the neighbours.
    found: Vec<u32>,
}

/// Normal force and friction of a spring, N/m.
pub(super) type Forces = [f64; 2];
/// Rates of the gap and of the slip, m/s.
pub(super) type Rates = [f64; 2];

impl Couplings {
    /// Finds who touches which slot, which slots are hubs, and what springs do to each other; `slides`: whether any of them cares for slip.
    pub(super) fn find(&mut self, links: &mut [Link], arms: &[Arm], slips: &[[f64; 3]], slots: &mut [Slot], slides: bool) {
        let at_arms = |(i, link): (usize, &Link)| link.arms().map(move |k| (arms[k].slot, [i as u32, k as u32]));
        self.touches.fill(slots.len(), links.iter().enumerate().flat_map(at_arms));
        for (number, slot) in slots.iter_mut().enumerate() {
            slot.is_hub = slot.is_body || self.touches.of(number).len() > PAIRS;
        }
        let Self { touches, rows, neighbours, normal, along, found } = self;
        rows.clear();
        neighbours.clear();
        normal.clear();
        along.clear();
        found.clear();
        found.resize(links.len(), 0);
        for (i, link) in links.iter_mut().enumerate() {
            let begin = neighbours.len();
            for k in link.arms() {
                let (number, row) = (arms[k].slot as usize, arms[k].row);
                let slot = &slots[number];
                if slot.is_hub {
                    link.is_at_hub = true;
                    continue;
                }
                let response = slot.mobility.response(row);
                let response_along = if slides { slot.mobility.response(slips[k]) } else { [0.0; 3] };
                for &[j, other] in touches.of(number) {
                    // Ends that move as one leave a spring its own neighbour.
                    if j as usize == i && other as usize == k {
                        continue;
                    }
                    let known = found[j as usize] as usize;
                    let place = if known >= begin && neighbours.get(known) == Some(&j) { known } else { neighbours.len() };
                    if place == neighbours.len() {
                        found[j as usize] = place as u32;
                        neighbours.push(j);
                        normal.push(0.0);
                        if slides {
                            along.push([0.0; 3]);
                        }
                    }
                    // Mobilities are symmetric: what j does to i is what i does to j.
                    let row = &arms[other as usize].row;
                    normal[place] += dot(response, *row);
                    if slides {
                        let (along, slip) = (&mut along[place], slips[other as usize]);
                        along[0] += dot(response, slip);
                        along[1] += dot(response_along, *row);
                        along[2] += dot(response_along, slip);
                    }
                }
            }
            rows.push(neighbours.len() as u32);
        }
    }

    /// The springs at a slot: (link, arm).
    pub(super) fn touches(&self, slot: usize) -> &[[u32; 2]] {
        self.touches.of(slot)
    }

    fn row(&self, i: usize) -> Range<usize> {
        let begin = if i == 0 { 0 } else { self.rows[i - 1] };
        begin as usize..self.rows[i] as usize
    }

    /// The links that share a slot with link `i`, but for hubs.
    pub(super) fn neighbours(&self, i: usize) -> &[u32] {
        &self.neighbours[self.row(i)]
    }

    /// What the forces of its neighbours do to the rates of link `i`: rows of the gap's and the slip's rate.
    pub(super) fn pairs(&self, i: usize) -> impl Iterator<Item = (usize, [[f64; 2]; 2])> {
        self.row(i).map(|place| {
            let [cross, cross_along, along] = self.along.get(place).copied().unwrap_or_default();
            (self.neighbours[place] as usize, [[self.normal[place], cross], [cross_along, along]])
        })
    }

    /// What the forces of its neighbours add to the rates of link `i`.
    #[inline]
    pub(super) fn rates(&self, i: usize, forces: &[Forces]) -> Rates {
        let row = self.row(i);
        let (neighbours, normal) = (&self.neighbours[row.clone()], &self.normal[row.clone()]);
        let mut rates = [0.0; 2];
        if self.along.is_empty() {
            for (&j, normal) in neighbours.iter().zip(normal) {
                rates[0] += normal * forces[j as usize][0];
            }
            return rates;
        }
        for ((&j, normal), along) in neighbours.iter().zip(normal).zip(&self.along[row]) {
            let [force, friction] = forces[j as usize];
            rates[0] += normal * force + along[0] * friction;
            rates[1] += along[1] * force + along[2] * friction;
        }
        rates
    }
}
