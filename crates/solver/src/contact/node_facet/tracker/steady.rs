//! Groups that continue as they were: inside by the face of a facet, or before one, after they have been
//! measured eight at a time. Nearly all that touch, in nearly every step.
//!
//! What is said of them is what `locate.rs` says, to the last bit; whatever is not plain is left to it.

use super::locate::{Chunk, Look};
use super::{ContactPoint, Found, SAME_FACE, START, Tracker};
use crate::contact::node_facet::far::{ALL, least};
use crate::contact::node_facet::groups::Group;
use crate::contact::node_facet::measured;
use crate::contact::projection::node_facet::eight::is_nearer;
use crate::contact::projection::node_facet::{Placed, Projection};
use crate::contact::tracker::sleep::{AWAKE, wake_at};
use crate::tensor::dot;

/// Candidates that are looked at without room elsewhere.
const MOST: usize = 16;

impl Tracker {
    /// Whether a group continues as it was, by what is `known` of what it has been measured against: then it
    /// is noted so.
    pub(super) fn stays(
        &self,
        look: Look<'_>,
        chunk: &mut Chunk<'_>,
        (index, known): (usize, &measured::Known<'_>),
        found: &mut Found,
    ) -> bool {
        let Look { pass: number, sweep, extra, .. } = look;
        let group = &mut chunk.groups[index];
        let first = group.begin as usize - chunk.first[1];
        let clear = &mut chunk.clear[first..first + (group.end - group.begin) as usize];
        let (memory, count) = (&mut group.known.memory, known.candidates.len());
        let was_inside = memory.side != [0.0; 3];
        if memory.is_led || count > MOST {
            return false;
        }
        // Inside it sees facets that look to the side from which it came; outside it goes through nothing.
        let is_plain = |pair: usize| {
            known.measured(pair).is_some_and(|(measured, lane)| {
                measured.is_known(lane) && if was_inside { measured.looks(lane) } else { measured.stays(lane) == ALL }
            })
        };
        if !(0..count).all(is_plain) {
            return false;
        }
        let (mut best, mut asked) = (known.likely, 1u32 << known.likely);
        let Some(mut at) = known.measured(best) else { return false };
        for pair in (0..count).filter(|&pair| pair != known.likely) {
            let (k, Some(other)) = (known.candidates[pair] as usize, known.measured(pair)) else { return false };
            let (bound, square) = (least(clear[k], sweep.travel), at.0.square(at.1));
            if bound > 0.0 && bound * bound > square {
                continue;
            }
            asked |= 1 << pair;
            let facets = [pair, best].map(|pair| known.candidates[pair]);
            if is_nearer(other, at, facets) {
                (best, at) = (pair, other);
            }
        }
        // What has not been measured would not have been either.
        let (measured, lane) = at;
        if count < clear.len() && !(known.beyond > 0.0 && known.beyond * known.beyond > measured.square(lane)) {
            return false;
        }
        let plane = measured.plane(lane);
        let (gap, normal) = (plane.height, plane.normal);
        let is_near = || gap >= 0.0 && gap <= (extra + START * self.reach.skin).min(self.radius - self.reach.skin).max(extra);
        let continues = if was_inside { gap < 0.0 } else { is_near() };
        if !continues || !measured.is_on_face(lane) || !(dot(memory.spring.normal, normal) > SAME_FACE) {
            return false;
        }
        for pair in (0..count).filter(|pair| asked >> pair & 1 == 1) {
            if let Some((measured, lane)) = known.measured(pair) {
                clear[known.candidates[pair] as usize] = wake_at(measured.square(lane).sqrt(), sweep.travel);
            }
        }
        memory.side = if was_inside { normal } else { [0.0; 3] };
        chunk.wakes[index] = AWAKE;
        found.deepest = found.deepest.max(-gap);
        let pass = &self.passes[number];
        let facet = pass.candidates[group.begin as usize + known.candidates[best] as usize];
        let placed = Placed { surface: &self.surfaces[pass.target], positions: sweep.new };
        let projection: Projection = measured.projection(lane, facet, &placed);
        let Group { slave, node, own, .. } = *group;
        found.touches.push(ContactPoint { pass: number as u32, slave, node, projection, own, group: (chunk.first[0] + index) as u32 });
        true
    }
}
