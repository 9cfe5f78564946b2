//! Nodes and facets that are far from an obstacle and of which nothing is remembered: nothing comes of them
//! until both sides have gone so far that they may have come near ([`crate::contact::tracker::sleep`]).
//!
//! [`super::space`] asks before it looks at one, and notes how far it was. While the obstacle turns all are
//! looked at.

use crate::contact::tracker::sleep::{AWAKE, awake, wake_at};
use crate::rigid::Body;

/// What is within its reach and so many ways of a step gets a spring.
pub(super) const LOOK_AHEAD: f64 = 4.0;
/// Where the distance of a facet from its obstacle less twice its size shrinks by the way of one step, its
/// corners have gone a fifth of it at least.
const SIZES: f64 = 5.0;

/// What is known of the distances.
pub(super) struct Far {
    /// Of each node and each facet: its distance when it was measured, and what both sides had gone, m.
    nodes: Vec<f64>,
    facets: Vec<f64>,
    /// Ways of nodes and of the obstacle until now, m.
    travel: f64,
    gone: f64,
    /// Whether something may sleep, and what the above has to exceed then.
    may_sleep: bool,
    bounds: [f64; 2],
}

impl Far {
    /// Of so many nodes and facets, of which nothing is known.
    pub(super) fn new(nodes: usize, facets: usize) -> Self {
        let (nodes, facets) = (vec![AWAKE; nodes], vec![AWAKE; facets]);
        Self { nodes, facets, travel: 0.0, gone: 0.0, may_sleep: false, bounds: [f64::INFINITY; 2] }
    }

    /// A new step begins, at whose end nodes have gone `travel`, m.
    pub(super) fn begin(&mut self, body: &Body<3>, travel: f64, reach: f64) {
        let way = travel - std::mem::replace(&mut self.travel, travel);
        let shift = body.shift();
        self.may_sleep = shift.is_some();
        let Some(shift) = shift else {
            self.nodes.fill(AWAKE);
            self.facets.fill(AWAKE);
            self.bounds = [f64::INFINITY; 2];
            return;
        };
        self.gone += shift;
        self.bounds = [1.0, SIZES].map(|factor| awake(reach, LOOK_AHEAD, factor * self.both(), 0.5 * (way + shift)));
    }

    /// Half of what both sides have gone, m.
    fn both(&self) -> f64 {
        0.5 * (self.travel + self.gone)
    }

    /// Whether a node may be near; then nothing is known of it any more.
    pub(super) fn looks_at(&mut self, node: usize) -> bool {
        looks_at(&mut self.nodes[node], self.bounds[0])
    }

    /// The same of a facet.
    pub(super) fn looks_at_facet(&mut self, facet: usize) -> bool {
        looks_at(&mut self.facets[facet], self.bounds[1])
    }

    /// Notes a node that is so far away.
    pub(super) fn note(&mut self, node: usize, distance: f64) {
        if self.may_sleep {
            self.nodes[node] = wake_at(distance, self.both());
        }
    }

    /// Notes a facet whose corners are so far away, more than twice its size.
    pub(super) fn note_facet(&mut self, facet: usize, distance: f64) {
        if self.may_sleep {
            self.facets[facet] = wake_at(distance, SIZES * self.both());
        }
    }

    /// How many nodes and facets sleep in this step.
    #[cfg(test)]
    pub(super) fn sleeping(&self) -> usize {
        let of = |wakes: &[f64], bound: f64| wakes.iter().filter(|&&wake| wake > bound).count();
        of(&self.nodes, self.bounds[0]) + of(&self.facets, self.bounds[1])
    }
}

fn looks_at(wake: &mut f64, bound: f64) -> bool {
    let sleeps = *wake > bound;
    if !sleeps {
        *wake = AWAKE;
    }
    !sleeps
}
