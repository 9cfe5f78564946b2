//! How far nodes turn together in a step in 3D, and a slip that turns with them: whatever their numbering,
//! and exactly in every rigid motion.
//!
//! Nodes come from the elements of balls, from facets and from edges that touch, positions from the step;
//! friction's elastic slip of the step before is turned by it.

use super::Sweep;
use crate::tensor::{cross, dot};
use crate::vector::minus;

type Vector = [f64; 3];

/// Adds what nodes turn about their mean in the step: Σ r × Δx, and Θ = Σ r² 1 − r ⊗ r with r half way.
pub(super) fn add_turn(nodes: &[u32], sweep: Sweep<'_, 3>, sum: &mut Vector, inertia: &mut [Vector; 3]) {
    let half_way = |node: u32| [0, 1, 2].map(|d| 0.5 * (sweep.old[node as usize][d] + sweep.new[node as usize][d]));
    let mut mean = [0.0; 3];
    for &node in nodes {
        let x = half_way(node);
        (0..3).for_each(|d| mean[d] += x[d] / nodes.len() as f64);
    }
    for &node in nodes {
        let r = minus(half_way(node), mean);
        let more = cross(r, minus(sweep.new[node as usize], sweep.old[node as usize]));
        (0..3).for_each(|d| sum[d] += more[d]);
        add_arm(r, inertia);
    }
}

/// Adds r² 1 − r ⊗ r.
pub(super) fn add_arm(r: Vector, inertia: &mut [Vector; 3]) {
    let square = dot(r, r);
    for i in 0..3 {
        (0..3).for_each(|j| inertia[i][j] -= r[i] * r[j]);
        inertia[i][i] += square;
    }
}

/// How groups of nodes, each about its mean, turn together in a step: Θ⁻¹ Σ r × Δx, along the axis 2 tan ½φ
/// of the angle φ of every rigid motion. Zero where all are on one line.
pub(super) fn turn<'a>(groups: impl IntoIterator<Item = &'a [u32]>, sweep: Sweep<'_, 3>) -> Vector {
    let (mut sum, mut inertia) = ([0.0; 3], [[0.0; 3]; 3]);
    for nodes in groups {
        add_turn(nodes, sweep, &mut sum, &mut inertia);
    }
    solved(&inertia, sum)
}

/// A vector that turns by 2 tan ½φ along an axis: Cayley's map, a rotation of any angle φ below half a turn.
pub(super) fn turned(vector: Vector, by: Vector) -> Vector {
    if vector == [0.0; 3] {
        return vector;
    }
    let half = by.map(|c| 0.5 * c);
    let once = cross(half, vector);
    let twice = cross(half, once);
    let scale = 2.0 / (1.0 + dot(half, half));
    [0, 1, 2].map(|d| vector[d] + scale * (once[d] + twice[d]))
}

/// The solution of a symmetric system, zero where it has none.
pub(super) fn solved([a, b, c]: &[Vector; 3], right: Vector) -> Vector {
    let (bc, ca, ab) = (cross(*b, *c), cross(*c, *a), cross(*a, *b));
    let whole = dot(*a, bc);
    if whole.abs() > f64::MIN_POSITIVE { [dot(bc, right), dot(ca, right), dot(ab, right)].map(|part| part / whole) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::length;

    const AXIS: Vector = [0.48, 0.6, 0.64];

    fn rotated(degrees: f64, v: Vector) -> Vector {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (across, along) = (cross(AXIS, v), (1.0 - cos) * dot(AXIS, v));
        [0, 1, 2].map(|d| cos * v[d] + sin * across[d] + along * AXIS[d])
    }

    #[test]
    fn triangles_squares_and_crossing_edges_turn_as_every_rigid_motion_does() {
        let old = [[0.1, 0.0, 0.2], [1.0, 0.3, 0.0], [1.2, 1.1, 0.4], [-0.1, 0.9, -0.3]];
        let slip = [0.3, -0.7, 0.2];
        for degrees in [1e-3, 1.0, 40.0, 120.0_f64] {
            let new = old.map(|x| rotated(degrees, x)).map(|x| [x[0] + 3.0, x[1] - 1.0, x[2] + 0.1]);
            let sweep = Sweep::between(&old, &new);
            for groups in [&[&[0, 1, 2][..]][..], &[&[0, 1, 2, 3]], &[&[0, 2], &[1, 3]]] {
                let found = turned(slip, turn(groups.iter().copied(), sweep));
                assert!(length(minus(found, rotated(degrees, slip))) < 1e-13, "{degrees} {groups:?}: {found:?}");
            }
        }
    }

    #[test]
    fn however_nodes_are_numbered_what_deforms_turns_the_same() {
        let old = [[0.1, 0.0, 0.2], [1.0, 0.3, 0.0], [1.2, 1.1, 0.4], [-0.1, 0.9, -0.3]];
        let new = [[0.3, 0.1, 0.2], [1.0, 0.5, 0.1], [1.1, 1.1, 0.3], [-0.1, 0.6, -0.2]];
        let sweep = Sweep::between(&old, &new);
        let found = turn([&[0, 1, 2, 3][..]], sweep);
        assert!(length(found) > 0.1);
        for nodes in [[1, 2, 3, 0], [2, 3, 0, 1], [3, 2, 1, 0]] {
            assert!(length(minus(turn([&nodes[..]], sweep), found)) < 1e-15);
        }
        let found = turn([&[0, 2][..], &[1, 3]], sweep);
        assert!(length(found) > 0.1);
        for edges in [[[2, 0], [1, 3]], [[1, 3], [0, 2]], [[3, 1], [2, 0]]] {
            assert!(length(minus(turn([&edges[0][..], &edges[1]], sweep), found)) < 1e-15);
        }
    }
}
