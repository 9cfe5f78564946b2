//! A node of the target as what is nearest, at the bottom of a fold most often: neither segment there is
//! nearer than the other, and rounding must not choose one.
//!
//! Projections come from the tracker; stiffness and ends go to the formulation.

use super::segment_ends;
use crate::contact::projection::node_segment::{Projection, Target, Vector};
use crate::contact::springs::End;

/// A share of a node below this is none: rounding must not say which segment is the nearest one.
const SAME_PLACE: f64 = 1e-9;

/// The other segment at a node of the target at which a projection lies, if it continues there: neither is
/// nearer. None of a node's own.
pub(super) fn other_at_node(node: u32, projection: &Projection, target: &Target) -> Option<u32> {
    let [before, after] = projection.weights.map(|weight| weight.abs() <= SAME_PLACE);
    let links = match (before, after) {
        (true, false) => &target.surface.next,
        (false, true) => &target.surface.previous,
        _ => return None,
    };
    let other = links[projection.segment as usize];
    target.surface.segments.get(other as usize).filter(|nodes| !nodes.contains(&node)).map(|_| other)
}

/// Makes the slip rate at a node of the target blind to the mean spin of both segments there, instead of that
/// of the one which the projection names; the end that the `other` one adds.
pub(super) fn turn_with_both(ends: &mut [End<2>; 3], projection: &Projection, other: u32, target: &Target, positions: &[Vector]) -> End<2> {
    let [x, a, b] = [0, 1, 2].map(|k| positions[ends[k].at as usize]);
    let k = if projection.weights[0] > projection.weights[1] { 0 } else { 1 };
    let foot = [a, b][k];
    let arm = (x[0] - foot[0]) * projection.normal[0] + (x[1] - foot[1]) * projection.normal[1];
    let nodes = target.surface.segments[other as usize];
    let at_node = Projection { weights: [0.0; 2], ..*projection };
    let of_other = segment_ends(nodes, &at_node, arm, positions);
    for end in &mut ends[1..] {
        end.turn = end.turn.map(|turn| turn.map(|c| 0.5 * c));
    }
    // The other one ends where this one begins, or the other way round.
    let half = of_other.map(|end| end.turn.map(|turn| turn.map(|c| 0.5 * c)));
    for d in 0..2 {
        ends[k + 1].turn[0][d] += half[1 - k][0][d];
    }
    End { turn: half[k], ..End::node(nodes[k], 0.0) }
}

#[cfg(test)]
mod tests {
    use super::super::ends;
    use super::*;
    use crate::contact::springs::tangent;
    use crate::mesh::surface::{NONE, Surface};
    use crate::vector::dot;

    #[test]
    fn in_a_fold_it_says_nothing_which_segment_is_named() {
        // A groove with its bottom at node 2, the body below, and node 0 in it.
        let surface = Surface::<2> { segments: vec![[1, 2], [2, 3]], previous: vec![NONE, 0], next: vec![1, NONE], nodes: vec![1, 2, 3] };
        let target = Target { surface, mirrors: Vec::new() };
        let positions = [[0.05, -0.2], [-1.1, 0.4], [0.0, 0.0], [0.8, 0.7]];
        let away = [0, 1].map(|d| positions[0][d] - positions[2][d]);
        let distance = dot(away, away).sqrt();
        let normal = away.map(|c| -c / distance);
        let rows = |segment: u32, weights: [f64; 2]| {
            let projection = Projection { segment, weights, gap: -distance, normal };
            let other = other_at_node(0, &projection, &target).unwrap();
            let mut ends = ends(0, &projection, &target, &positions);
            let more = turn_with_both(&mut ends, &projection, other, &target, &positions);
            let mut rows = [[0.0; 2]; 4];
            let t = tangent(normal);
            for end in ends.iter().chain([&more]) {
                (0..2).for_each(|d| rows[end.at as usize][d] += end.share * t[d] + end.turn[0][d]);
            }
            rows
        };
        let (one, other) = (rows(0, [0.0, 1.0]), rows(1, [1.0, 0.0]));
        let (mut sum, mut moment) = ([0.0; 2], 0.0);
        for (k, x) in positions.iter().enumerate() {
            assert!((0..2).all(|d| (one[k][d] - other[k][d]).abs() < 1e-15), "{one:?} {other:?}");
            (0..2).for_each(|d| sum[d] += one[k][d]);
            moment += x[0] * one[k][1] - x[1] * one[k][0];
        }
        assert!(sum[0].abs() + sum[1].abs() + moment.abs() < 1e-15, "{sum:?} {moment}");
        assert!(one[1] != [0.0; 2] && one[3] != [0.0; 2], "both count");
    }
}
