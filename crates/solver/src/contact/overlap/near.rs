//! Pairs of facets that may meet: found by the tree, and kept until things have gone too far.
//!
//! All pairs whose boxes are nearer than a margin are kept; until both sides' ways together exceed it no
//! other one can meet. A pair whose boxes are d apart along an axis, or whose corners are along the normal of
//! one of both facets, sleeps until these ways exceed d: of the facets around each facet and across a wall
//! all but those that fold or touch sleep on.

use super::skin::Skin;
use super::tree::Tree;
use crate::contact::boxes::Aabb;
use crate::contact::projection::node_facet::Vector;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};

/// Margin, as a fraction of the mean extent of facets.
const MARGIN: f64 = 0.5;

/// What rounding may bring, as a fraction.
const ROUNDED: f64 = 1e-9;

/// Two facets, and the travel (m) until which they can't meet.
#[derive(Clone, Copy, Debug)]
struct Pair {
    facets: [u32; 2],
    wakes: f64,
}

/// The pairs.
#[derive(Debug, Default)]
pub(super) struct Near {
    pairs: Vec<Pair>,
    /// Travel when they were found, and until which no other pair can meet; m.
    found: f64,
    holds: f64,
}

impl Near {
    /// Shows all pairs of facets whose boxes meet, with their boxes, at the places of the skin and the travel
    /// there, m.
    pub(super) fn meeting(&mut self, skin: &Skin, tree: &mut Tree, travel: f64, mut meet: impl FnMut([u32; 2], [&Aabb<3>; 2])) {
        if !(self.found..self.holds).contains(&travel) {
            self.find(skin, tree, travel);
        }
        tree.grown = if travel.is_finite() { travel - self.found } else { 0.0 };
        for pair in self.pairs.iter_mut().filter(|pair| pair.wakes <= travel) {
            let [a, b] = pair.facets.map(|facet| skin.box_of(&skin.facets[facet as usize]));
            let mut away = away(&a, &b);
            if away <= 0.0 {
                away = between(skin, pair.facets);
            }
            if away > 0.0 {
                pair.wakes = travel + 0.5 * away;
            } else {
                meet(pair.facets, [&a, &b]);
            }
        }
    }

    fn find(&mut self, skin: &Skin, tree: &mut Tree, travel: f64) {
        tree.refit(skin);
        let extent = |[low, high]: &Aabb<3>| (0..3).map(|d| high[d] - low[d]).fold(0.0, f64::max);
        let sum: f64 = tree.boxes.iter().map(extent).sum();
        let margin = MARGIN * sum / tree.boxes.len().max(1) as f64;
        self.pairs.clear();
        let Self { pairs, .. } = self;
        tree.pairs(skin, margin, |i, j| {
            let facets = [i, j];
            let [a, b] = facets.map(|facet| &skin.facets[facet as usize]);
            if skin.may_meet(a, b) {
                let away = away(&tree.boxes[i as usize], &tree.boxes[j as usize]);
                pairs.push(Pair { facets, wakes: travel + 0.5 * away.max(0.0) });
            }
        });
        (self.found, self.holds) = (travel, travel + 0.5 * margin);
    }
}

/// How far the corners of facets are apart along the normal of one of both, m, less what rounds; not
/// positive: they may meet.
fn between(skin: &Skin, facets: [u32; 2]) -> f64 {
    let corners = facets.map(|facet| {
        let facet = &skin.facets[facet as usize];
        // A triangle repeats its last corner.
        [0, 1, 2, if facet.count == 1 { 2 } else { 3 }].map(|k| skin.x[facet.vertices[k] as usize])
    });
    let mut most = 0.0;
    for [a, b, c, d] in corners {
        let normal = cross(minus(c, a), minus(d, b));
        let size = length(normal);
        if !(size > 0.0) {
            continue;
        }
        let range = |corners: [Vector; 4]| {
            let heights = corners.map(|corner| dot(minus(corner, a), normal));
            heights.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], h| [low.min(h), high.max(h)])
        };
        let [[low, high], [bottom, top]] = corners.map(range);
        let reach = high.abs().max(low.abs()).max(top.abs()).max(bottom.abs());
        let apart = (bottom - high).max(low - top) - ROUNDED * reach;
        most = f64::max(most, apart / size);
    }
    most
}

/// How far boxes are apart along an axis at most, m; not positive: they meet.
fn away([low, high]: &Aabb<3>, [bottom, top]: &Aabb<3>) -> f64 {
    (0..3).map(|d| (bottom[d] - high[d]).max(low[d] - top[d])).fold(f64::NEG_INFINITY, f64::max)
}
