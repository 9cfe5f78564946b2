//! Local search, case by case, on a target alone: nearest features, corners, ends, thin bodies, and swept
//! crossings against exact arithmetic.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use crate::long::samples;
use embate_solver::contact::projection::node_segment::{Projection, Target, Vector};
use embate_solver::mesh::surface::{NONE, Surface};
use proptest::prelude::*;

/// A chain of points, body on the right; closed: the last point is followed by the first.
fn chain(points: &[Vector], closed: bool) -> Target {
    let n = points.len() as u32;
    let count = if closed { n } else { n - 1 };
    let link = |ok: bool, s: u32| if ok { s } else { NONE };
    let surface = Surface::<2> {
        segments: (0..count).map(|s| [s, (s + 1) % n]).collect(),
        previous: (0..count).map(|s| link(closed || s > 0, (s + count - 1) % count)).collect(),
        next: (0..count).map(|s| link(closed || s + 1 < count, (s + 1) % count)).collect(),
        nodes: (0..n).collect(),
    };
    Target { surface, mirrors: Vec::new() }
}

/// A plate between y = 0 and y = `thickness`, `n` segments of length 1 on both sides, closed by its ends.
fn plate(n: usize, thickness: f64) -> (Target, Vec<Vector>) {
    let above = (0..=n).map(|i| [i as f64, thickness]);
    let below = (0..=n).rev().map(|i| [i as f64, 0.0]);
    let points: Vec<_> = above.chain(below).collect();
    (chain(&points, true), points)
}

fn everything(target: &Target) -> Vec<u32> {
    (0..target.surface.segments.len() as u32).collect()
}

fn nearest(target: &Target, x: Vector, points: &[Vector]) -> Projection {
    target.nearest(x, &everything(target), points).unwrap()
}

/// First crossing over all segments: time and segment.
fn entry(target: &Target, from: Vector, to: Vector, old: &[Vector], new: &[Vector]) -> Option<(f64, u32)> {
    let of = |&segment: &u32| Some((target.crossing(from, to, segment, old, new)?, segment));
    everything(target).iter().filter_map(of).min_by(|a, b| a.0.total_cmp(&b.0))
}

fn close(a: Vector, b: Vector) -> bool {
    (a[0] - b[0]).abs() < 1e-14 && (a[1] - b[1]).abs() < 1e-14
}

const SQUARE: [Vector; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];

#[test]
fn a_node_above_a_segment_has_the_epsilon_of_equation_8() {
    let (c1, c2, x) = ([1.0, 2.0], [4.0, 6.0], [1.1, 4.7]);
    let points = [c1, c2];
    let target = chain(&points, false);
    let t = [0.6, 0.8];
    let epsilon = ((2.0 * x[0] - c1[0] - c2[0]) * t[0] + (2.0 * x[1] - c1[1] - c2[1]) * t[1]) / 5.0;
    let projection = target.project(x, 0, &points).unwrap();
    assert!(close(projection.weights, [0.5 * (1.0 - epsilon), 0.5 * (1.0 + epsilon)]));
    assert!(close(projection.normal, [-0.8, 0.6]));
    assert!((projection.gap - (-0.8 * 0.1 + 0.6 * 2.7)).abs() < 1e-14);
    // Below it the gap is negative and the normal the same.
    let below = target.project([x[0] + 3.2, x[1] - 2.4], 0, &points).unwrap();
    assert!(close(below.normal, [-0.8, 0.6]) && (below.gap - (projection.gap - 4.0)).abs() < 1e-14);
}

#[test]
fn a_node_inside_a_concave_corner_goes_to_the_nearest_target_node() {
    // Figure 4: the notch opens upwards, the body is below; the node projects on neither side.
    let points = [[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]];
    let target = chain(&points, false);
    let x = [0.03, -0.04];
    let projection = nearest(&target, x, &points);
    assert!((projection.gap + 0.05).abs() < 1e-15);
    assert!(close(projection.normal, [-0.6, 0.8]), "X_C - X_e: {projection:?}");
    let [a, b] = target.surface.segments[projection.segment as usize];
    let weight_of_corner = if a == 1 { projection.weights[0] } else { projection.weights[1] };
    assert!((a == 1 || b == 1) && weight_of_corner == 1.0 && projection.weights[0] + projection.weights[1] == 1.0);
}

#[test]
fn a_node_inside_a_convex_corner_goes_to_the_nearest_side() {
    // Figure 5: it projects on the upper and on the right side.
    let target = chain(&SQUARE, true);
    let up = nearest(&target, [0.8, 0.9], &SQUARE);
    assert!(close(up.normal, [0.0, 1.0]) && (up.gap + 0.1).abs() < 1e-15 && up.segment == 1);
    let right = nearest(&target, [0.9, 0.8], &SQUARE);
    assert!(close(right.normal, [1.0, 0.0]) && (right.gap + 0.1).abs() < 1e-15 && right.segment == 2);
}

#[test]
fn a_node_below_a_ridge_is_pushed_straight_to_it() {
    // Equally near to both sides: taking the first would push a symmetric body aside.
    let points = [[0.0, 0.0], [1.0, 0.1], [2.0, 0.0]];
    let target = chain(&points, false);
    for projection in [nearest(&target, [1.0, 0.05], &points), target.follow([1.0, 0.05], 1, &points).unwrap()] {
        assert!(close(projection.normal, [0.0, 1.0]) && (projection.gap + 0.05 / 1.01_f64.sqrt()).abs() < 1e-15, "{projection:?}");
    }
    let beside = nearest(&target, [1.0 + 1e-6, 0.05], &points);
    assert!(beside.segment == 1 && beside.normal[0] > 0.0, "{beside:?}");
}

#[test]
fn a_node_outside_a_convex_corner_is_outside() {
    let target = chain(&SQUARE, true);
    // With the sides that meet in the corner, 0 being the left side.
    let top_right = [[1.1, 0.9], [0.9, 1.1], [1.1, 1.1], [1.3, 1.1], [1.1, 1.3]].map(|x| (x, [1, 2]));
    for (x, sides) in top_right.into_iter().chain([([-0.1, -0.1], [0, 3]), ([-0.1, 1.2], [0, 1])]) {
        assert!(nearest(&target, x, &SQUARE).gap > 0.0, "{x:?}");
        for start in sides {
            assert!(target.follow(x, start, &SQUARE).unwrap().gap > 0.0, "{x:?} from {start}");
        }
    }
    // A sharp wedge: this point is behind the plane of the upper side and still outside.
    let wedge = [[0.0, 0.0], [4.0, 1.0], [1.0, -1.0]];
    let target = chain(&wedge, true);
    let beyond = nearest(&target, [4.3, 1.0], &wedge);
    assert!(beyond.gap > 0.0 && (beyond.gap - 0.3).abs() < 1e-14 && close(beyond.normal, [1.0, 0.0]));
}

#[test]
fn a_node_beyond_an_open_end_has_no_contact() {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    let target = chain(&points, false);
    for x in [[2.001, -0.01], [2.001, 0.01], [-0.001, -0.01], [-5.0, 0.0]] {
        assert_eq!(target.nearest(x, &[0, 1], &points), None, "{x:?}");
        assert_eq!(target.follow(x, 1, &points), None, "{x:?}");
    }
    // Exactly at the end, and beyond it by round-off, it has.
    for x in [[2.0, -0.01], [2.0 + 1e-13, -0.01], [0.0, -0.01], [-1e-13, -0.01]] {
        let projection = target.nearest(x, &[0, 1], &points).unwrap();
        assert!((projection.gap + 0.01).abs() < 1e-12 && projection.normal[1] > 0.999, "{projection:?}");
    }
}

#[test]
fn at_a_symmetry_line_the_mirrored_half_continues() {
    // Half a wedge that points up (convex), then half a notch (concave), cut at x = 0.
    for (slope, x, inside) in [(-1.0, [-0.02, 0.03], false), (-1.0, [-0.02, 0.01], false), (1.0, [0.0, -0.05], true)] {
        let points = [[0.0, 0.0], [1.0, slope]];
        let mut target = chain(&points, false);
        target.mirrors = vec![(0, [1.0, 0.0])];
        let full = [[-1.0, slope], [0.0, 0.0], [1.0, slope]];
        let whole = chain(&full, false);
        let (half, all) = (target.nearest(x, &[0], &points).unwrap(), nearest(&whole, x, &full));
        assert_eq!(half.gap < 0.0, inside, "{half:?}");
        // Points on the line (and on this side of it) see the same in both.
        if x[0] >= 0.0 {
            assert!(close(half.normal, all.normal) && (half.gap - all.gap).abs() < 1e-15, "{half:?} {all:?}");
        }
    }
    // The normal need not point away from the body.
    let points = [[0.0, 0.0], [1.0, 1.0]];
    let mut target = chain(&points, false);
    target.mirrors = vec![(0, [-1.0, 0.0])];
    let projection = target.nearest([0.0, -0.05], &[0], &points).unwrap();
    assert!((projection.gap + 0.05).abs() < 1e-15 && close(projection.normal, [0.0, 1.0]));
    // On the node itself there is a direction too.
    let on = target.project([0.0, 0.0], 0, &points).unwrap();
    assert!(on.gap == 0.0 && (on.normal[0].hypot(on.normal[1]) - 1.0).abs() < 1e-15);
}

#[test]
fn both_ends_of_a_chain_can_lie_on_symmetry_lines() {
    let points = [[0.0, 2.0], [1.0, 1.0], [2.0, 2.0]];
    let mut target = chain(&points, false);
    target.mirrors = vec![(0, [1.0, 0.0]), (2, [1.0, 0.0])];
    for x in [[0.0, 2.1], [2.0, 2.1]] {
        let projection = nearest(&target, x, &points);
        assert!(projection.gap > 0.0 && projection.normal[1] > 0.7, "{projection:?}");
    }
    for x in [[0.05, 1.8], [1.95, 1.8]] {
        assert!(nearest(&target, x, &points).gap < 0.0, "{x:?}");
    }
}

#[test]
fn a_node_above_a_thin_plate_is_not_seen_by_its_far_side() {
    let (target, points) = plate(4, 0.01);
    for height in [0.001, 0.1, 3.0] {
        let above = nearest(&target, [1.3, 0.01 + height], &points);
        assert!((above.gap - height).abs() < 1e-14 && above.normal[1] == 1.0, "{above:?}");
        let below = nearest(&target, [1.3, -height], &points);
        assert!((below.gap - height).abs() < 1e-14 && below.normal[1] == -1.0, "{below:?}");
    }
}

#[test]
fn a_node_pushed_beyond_half_the_thickness_keeps_its_side() {
    let (target, points) = plate(6, 0.1);
    // In through segment 1 of the upper side, then deeper and along, below the lower side at last.
    let mut segment = 1;
    for k in 1..40 {
        let x = [1.5 + 0.08 * f64::from(k), 0.1 - 0.005 * f64::from(k)];
        let projection = target.follow(x, segment, &points).unwrap();
        assert!((projection.gap + 0.005 * f64::from(k)).abs() < 1e-14 && projection.normal[1] == 1.0, "{k}: {projection:?}");
        assert_eq!(projection.segment, x[0] as u32);
        segment = projection.segment;
    }
    // The nearest feature alone would push it out on the wrong side.
    assert_eq!(nearest(&target, [2.5, 0.03], &points).normal[1], -1.0);
    assert_eq!(target.follow([2.5, 0.03], 2, &points).unwrap().normal[1], 1.0);
}

#[test]
fn a_node_is_followed_around_a_corner_to_the_outside() {
    let (target, points) = plate(4, 0.5);
    // In through the upper side, out through the right end.
    let inside = target.follow([3.9, 0.45], 3, &points).unwrap();
    assert!(inside.gap < 0.0 && inside.normal[1] == 1.0);
    // The right end is nearer now, but the node came in through the upper side and still projects on it.
    let at_end = target.follow([3.98, 0.4], inside.segment, &points).unwrap();
    assert!((at_end.gap + 0.1).abs() < 1e-14 && at_end.normal[1] == 1.0);
    assert_eq!(nearest(&target, [3.98, 0.4], &points).normal[0], 1.0);
    for x in [[4.02, 0.4], [4.3, -0.2], [4.0001, 0.25]] {
        assert!(target.follow(x, inside.segment, &points).unwrap().gap > 0.0, "{x:?}");
    }
}

#[test]
fn a_corner_that_meets_a_corner_end_on_is_pushed_back() {
    // The end of a bar of the same height comes in at the right end: its corner runs along the lower side, a
    // round-off above or below.
    let (target, points) = plate(4, 0.5);
    for offset in [0.0, 1e-17, -1e-17, 1e-9, -1e-9] {
        let (time, segment) = entry(&target, [4.01, offset], [3.99, offset], &points, &points).unwrap();
        assert!((time - 0.5).abs() < 1e-12);
        let inside = target.follow([3.99, offset], segment, &points).unwrap();
        assert!((inside.gap + 0.01).abs() < 1e-12 && inside.normal[0] == 1.0, "{offset}: {inside:?}");
    }
}

#[test]
fn a_node_that_crosses_a_plate_within_one_step_is_found_at_any_speed() {
    let thickness = 0.01;
    let (target, points) = plate(4, thickness);
    for thicknesses in [0.1, 0.6, 1.5, 10.0, 1e3, 1e6] {
        let to = thickness - thicknesses * thickness;
        for x in [0.3, 1.0, 2.0, 2.7, 3.0] {
            let (time, segment) = entry(&target, [x, thickness + 1e-3], [x, to], &points, &points).unwrap();
            assert!((time - 1e-3 / (1e-3 + thicknesses * thickness)).abs() < 1e-12, "{thicknesses} {time}");
            let projection = target.follow([x, to], segment, &points).unwrap();
            assert!(projection.normal[1] == 1.0 && (projection.gap + thicknesses * thickness).abs() < 1e-9);
            // From below it comes in through the lower side.
            let (_, segment) = entry(&target, [x, -1e-3], [x, thickness - to], &points, &points).unwrap();
            assert_eq!(target.follow([x, thickness - to], segment, &points).unwrap().normal[1], -1.0);
        }
    }
}

#[test]
fn a_node_far_below_a_thin_plate_is_not_led_around_its_rounded_tip() {
    // Thickness 0.01, a half circle of eight facets at the right end: no sharp edge anywhere near.
    let mut points = vec![[0.0, 0.01], [0.5, 0.01], [0.9, 0.01]];
    points.extend((0..=8).map(|k| {
        let (s, c) = (std::f64::consts::PI * f64::from(k) / 8.0).sin_cos();
        [1.0 + 0.005 * s, 0.005 + 0.005 * c]
    }));
    points.extend([[0.9, 0.0], [0.5, 0.0], [0.0, 0.0]]);
    let target = chain(&points, true);
    for depth in [0.03, 0.1, 0.3] {
        for x in [0.95, 0.98, 0.995] {
            let to = [x, 0.01 - depth];
            let (_, segment) = entry(&target, [x, 0.02], to, &points, &points).unwrap();
            let inside = target.follow(to, segment, &points).unwrap();
            assert!((inside.gap + depth).abs() < 1e-12 && inside.normal[1] == 1.0, "{x} {depth}: {inside:?}");
        }
    }
    // Within the thickness the nearest facet of something round decides.
    let near = target.follow([1.004, 0.005], 2, &points).unwrap();
    assert!(near.gap < 0.0 && near.gap > -0.0015 && near.normal[0] > 0.9, "{near:?}");
}

#[test]
fn a_plate_that_moves_and_turns_over_a_node_finds_it() {
    let (target, old) = plate(4, 0.01);
    // Through 0.3 rad about (2, 0) while it rises by 0.5: ten or more thicknesses wherever the node is.
    let (s, c) = 0.3_f64.sin_cos();
    let new: Vec<Vector> = old.iter().map(|p| [2.0 + c * (p[0] - 2.0) - s * p[1], s * (p[0] - 2.0) + c * p[1] + 1.0]).collect();
    for k in 0..=30 {
        let x = [0.6 + 0.1 * f64::from(k), 0.1];
        let to = [x[0] + 0.05, x[1] - 0.02];
        let (_, segment) = entry(&target, x, to, &old, &new).unwrap_or_else(|| panic!("{x:?}"));
        assert!(segment < 4, "the upper side meets it first: {segment}");
        assert!(target.follow(to, segment, &new).unwrap().gap < -0.05);
    }
}

#[test]
fn a_node_that_goes_exactly_through_a_vertex_is_found() {
    // Two segments that meet at any angle; the path goes through the shared vertex, from many directions and
    // offsets.
    for turn in [-0.9, -0.5, -1e-3, 0.0, 1e-9, 1e-3, 0.3, 0.5, 0.9] {
        for origin in [[0.0, 0.0], [0.1, 0.7], [1e3, -1e3], [1.0 / 3.0, 1e4 / 7.0]] {
            let at = |x: f64, y: f64| [origin[0] + x, origin[1] + y];
            let points = [at(-0.7, -0.7 * turn), at(0.0, 0.0), at(0.9, -0.9 * turn)];
            let target = chain(&points, false);
            for k in -20..=20 {
                let lean = 0.02 * f64::from(k);
                let (from, to) = (at(0.31 * lean, 0.31), at(-0.23 * lean, -0.23));
                assert!(entry(&target, from, to, &points, &points).is_some(), "{turn} {origin:?} {lean}");
            }
        }
    }
}

#[test]
fn a_node_that_starts_on_the_surface_and_goes_in_is_found() {
    let (target, points) = plate(4, 0.25);
    for x in [0.5, 1.0, 1.3, 2.0, 2.999] {
        for depth in [1e-9, 0.1, 0.5, 7.0] {
            let (time, segment) = entry(&target, [x, 0.25], [x, 0.25 - depth], &points, &points).unwrap();
            assert!(time == 0.0 && segment < 4);
            let (_, segment) = entry(&target, [x, 0.0], [x, depth], &points, &points).unwrap();
            assert!((5..9).contains(&segment));
        }
    }
    // On a surface that is not parallel to an axis, where round-off decides about on, above and below.
    let mut found = 0;
    for k in 1..200 {
        let angle = 0.031 * f64::from(k);
        let (s, c) = angle.sin_cos();
        let points = [[0.3 - c, 0.7 - s], [0.3 + c, 0.7 + s]];
        let target = chain(&points, false);
        let x = [0.3 + 0.37 * c, 0.7 + 0.37 * s];
        // Outside is whatever the local search says at the step's beginning: then the crossing must be seen.
        if target.project(x, 0, &points).unwrap().gap >= 0.0 {
            found += 1;
            assert!(entry(&target, x, [x[0] + 5.0 * s, x[1] - 5.0 * c], &points, &points).is_some(), "{angle}");
        }
    }
    assert!(found > 50);
}

#[test]
fn a_node_that_grazes_or_leaves_does_not_come_in() {
    let (target, points) = plate(4, 0.25);
    let stays_out: [(Vector, Vector); 7] = [
        ([1.0, 0.25], [3.0, 0.25]),    // along the surface
        ([1.0, 0.25], [1.0, 0.25]),    // at rest on it
        ([1.0, 0.25], [1.5, 0.9]),     // away from it
        ([1.0, 0.5], [1.5, 0.9]),      // away, above
        ([1.0, 0.5], [1.5, 0.250001]), // towards it, not yet there
        ([5.0, 0.2], [4.5, 0.1]),      // beside it
        ([-1.0, 0.35], [1.0, 0.351]),  // past its corner
    ];
    for (from, to) in stays_out {
        assert_eq!(entry(&target, from, to, &points, &points), None, "{from:?} {to:?}");
    }
    // Out of it: no way in.
    assert_eq!(entry(&target, [1.2, 0.2], [1.3, 0.4], &points, &points), None);
    assert_eq!(entry(&target, [1.2, 0.25 - 1e-12], [1.3, 4.0], &points, &points), None);
    // Everything in rigid motion together: no one meets anybody.
    let moved: Vec<Vector> = points.iter().map(|p| [p[0] + 7.0, p[1] - 3.0]).collect();
    assert_eq!(entry(&target, [1.25, 0.5], [8.25, -2.5], &points, &moved), None);
}

#[test]
fn a_node_that_cuts_a_corner_and_is_outside_again_is_outside() {
    let target = chain(&SQUARE, true);
    let to = [1.1, 0.8];
    if let Some((_, segment)) = entry(&target, [0.8, 1.1], to, &SQUARE, &SQUARE) {
        assert!(target.follow(to, segment, &SQUARE).unwrap().gap > 0.0);
    }
}

#[test]
fn segments_without_length_and_values_that_are_no_numbers_do_no_harm() {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    let target = chain(&points, false);
    assert_eq!(target.project([1.0, -0.1], 1, &points), None);
    for x in [[0.5, -0.1], [1.0, -0.1], [1.0 + 1e-12, -0.1], [1.0 - 1e-12, -0.1], [1.5, -0.1]] {
        let projection = target.nearest(x, &[0, 1, 2], &points).unwrap();
        assert!((projection.gap + 0.1).abs() < 1e-11 && projection.normal[1] > 0.999, "{x:?} {projection:?}");
        let start = if x[0] < 1.0 { 0 } else { 2 };
        assert!(target.follow(x, start, &points).unwrap().gap < -0.09);
        assert!(entry(&target, [x[0], 0.1], x, &points, &points).is_some(), "{x:?}");
    }
    // Around the fold of no length the corner still has an inside.
    let bent = [[0.0, 1.0], [1.0, 0.0], [1.0, 0.0], [2.0, 1.0]];
    let target = chain(&bent, false);
    let below = target.nearest([1.0, -0.1], &[0, 1, 2], &bent).unwrap();
    assert!((below.gap + 0.1).abs() < 1e-14, "{below:?}");
    for bad in [f64::NAN, f64::INFINITY] {
        let x = [0.5, bad];
        assert!(target.nearest(x, &[0, 1, 2], &bent).is_none_or(|p| !(p.gap < 0.0)));
        assert!(target.follow(x, 0, &bent).is_none_or(|p| !(p.gap < 0.0)));
        assert_eq!(target.crossing([0.5, 1.0], x, 0, &bent, &bent), None);
        let mut gone = bent.to_vec();
        gone[1][0] = bad;
        assert!(target.project([0.5, 0.1], 0, &gone).is_none_or(|p| !(p.gap < 0.0)));
        assert_eq!(target.crossing([0.5, 1.0], [0.5, 0.0], 0, &bent, &gone), None);
    }
}

#[test]
fn gaps_are_continuous_around_corners() {
    // A closed path around a block with a notch, close to its surface, inside and outside: the gap moves by
    // no more than the node does.
    let points = [[0.0, 0.0], [0.0, 2.0], [1.0, 2.0], [1.5, 1.2], [2.0, 2.0], [3.0, 2.0], [3.0, 0.0]];
    let target = chain(&points, true);
    for offset in [-0.11, -0.03, 0.02, 0.09] {
        let mut last: Option<(Vector, f64)> = None;
        let mut signs = [0, 0];
        for k in 0..=7 * 2000 {
            let (side, s) = ((k / 2000) % 7, f64::from(k % 2000) / 2000.0);
            let (a, b) = (points[side as usize], points[(side as usize + 1) % 7]);
            let x = [a[0] + s * (b[0] - a[0]) + offset, a[1] + s * (b[1] - a[1]) + 0.5 * offset];
            let gap = nearest(&target, x, &points).gap;
            signs[usize::from(gap < 0.0)] += 1;
            if let Some((x_last, gap_last)) = last {
                let moved = (x[0] - x_last[0]).hypot(x[1] - x_last[1]);
                assert!((gap - gap_last).abs() <= moved + 1e-12, "{x:?}: {gap_last} {gap}");
            }
            last = Some((x, gap));
        }
        assert!(signs[0] > 100 && signs[1] > 100, "{signs:?}");
    }
}

/// Twice the signed area of three lattice points.
fn turn(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i128 {
    i128::from(b[0] - a[0]) * i128::from(c[1] - a[1]) - i128::from(b[1] - a[1]) * i128::from(c[0] - a[0])
}

/// 1 strictly inside a clockwise triangle, 0 on its boundary, −1 outside.
fn side(x: [i64; 2], triangle: &[[i64; 2]; 3]) -> i128 {
    -(0..3).map(|i| turn(triangle[i], triangle[(i + 1) % 3], x).signum()).max().unwrap()
}

fn real(p: [i64; 2]) -> Vector {
    // The scale makes products round.
    p.map(|c| c as f64 * 0.1)
}

fn lattice(range: i64) -> impl Strategy<Value = [i64; 2]> {
    (-range..=range, -range..=range).prop_map(|(x, y)| [x, y])
}

fn triangle(range: i64) -> impl Strategy<Value = [[i64; 2]; 3]> {
    (lattice(range), lattice(range), lattice(range)).prop_filter_map("degenerate", |(a, b, c)| match turn(a, b, c).signum() {
        0 => None,
        -1 => Some([a, b, c]),
        _ => Some([a, c, b]),
    })
}

fn no_way_in_is_missed(old: &[[i64; 2]; 3], new: &[[i64; 2]; 3], from: [i64; 2], to: [i64; 2]) -> Result<(), TestCaseError> {
    let (points_old, points_new) = (old.map(real), new.map(real));
    let target = chain(&points_old, true);
    // On the boundary round-off decides; what counts there is what the local search said about the beginning.
    let outside = side(from, old) < 0 || (side(from, old) == 0 && nearest(&target, real(from), &points_old).gap >= 0.0);
    if outside && side(to, new) > 0 {
        prop_assert!(entry(&target, real(from), real(to), &points_old, &points_new).is_some(), "{:?} {:?} {:?} {:?}", old, new, from, to);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(20_000), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn who_is_outside_before_and_inside_after_came_in_somewhere(
        old in triangle(4), new in triangle(4), from in lattice(4), to in lattice(4),
    ) {
        no_way_in_is_missed(&old, &new, from, to)?;
    }

    #[test]
    fn who_is_outside_a_triangle_at_rest_and_inside_after_came_in_somewhere(
        old in triangle(5), shift in lattice(2), from in lattice(5), to in lattice(4),
    ) {
        let new = old.map(|p| [p[0] + shift[0], p[1] + shift[1]]);
        no_way_in_is_missed(&old, &new, from, to)?;
    }
}

/// Position at time t of a straight motion.
fn at(t: f64, a: Vector, b: Vector) -> Vector {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(4000), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_crossing_is_where_dense_sampling_sees_the_node_go_in(coordinates in prop::collection::vec(-1.0..1.0_f64, 12)) {
        let p: Vec<Vector> = coordinates.chunks_exact(2).map(|c| [c[0], c[1]]).collect();
        let (old, new) = ([p[0], p[1]], [p[2], p[3]]);
        let target = chain(&old, false);
        let found = target.crossing(p[4], p[5], 0, &old, &new);
        // f > 0 above the line, s along it; sampled, with the first change of sign from above to below within
        // the segment.
        let state = |t: f64| {
            let (a, b, x) = (at(t, old[0], new[0]), at(t, old[1], new[1]), at(t, p[4], p[5]));
            let (e, r) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
            (e[0] * r[1] - e[1] * r[0], (e[0] * r[0] + e[1] * r[1]) / (e[0] * e[0] + e[1] * e[1]))
        };
        const TIMES: usize = 4000;
        let (mut sampled, mut doubtful) = (None, false);
        for k in 0..TIMES {
            let (t0, t1) = (k as f64 / TIMES as f64, (k + 1) as f64 / TIMES as f64);
            let ((f0, s0), (f1, s1)) = (state(t0), state(t1));
            // Near a vertex, or a segment that nearly vanishes, samples decide nothing.
            let jump = (s1 - s0).abs() + 1e-3;
            let near_end = |s: f64| s.abs() < 4.0 * jump || (s - 1.0).abs() < 4.0 * jump;
            if (f0 > 0.0) != (f1 > 0.0) {
                doubtful |= near_end(s0) || near_end(s1);
                if f0 > 0.0 && (0.0..=1.0).contains(&s0) && sampled.is_none() {
                    sampled = Some(t0);
                }
            }
            doubtful |= f0.abs() < 1e-5 && f1.abs() < 1e-5;
        }
        doubtful |= state(0.0).0.abs() < 1e-4 || state(1.0).0.abs() < 1e-4;
        if !doubtful {
            prop_assert_eq!(found.is_some(), sampled.is_some(), "{:?} {:?}", found, sampled);
            if let (Some(a), Some(b)) = (found, sampled) {
                prop_assert!((a - b).abs() <= 1.1 / TIMES as f64);
            }
        }
    }
}
