use super::*;
use crate::bench::Random;

/// Two crooked facets near each other, of three or four nodes: the first looks down on the second.
fn some(random: &mut Random) -> (Vec<Vector>, [[u32; 4]; 2]) {
    let mut unit = |size: f64| size * (2.0 * random.unit() - 1.0);
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let shift = [unit(0.4), unit(0.4)];
    let mut positions = Vec::new();
    for [x, y] in square {
        positions.push([y + shift[0] + unit(0.2), x + shift[1] + unit(0.2), 0.05 + unit(0.1)]);
    }
    for [x, y] in square {
        positions.push([x + unit(0.2), y + unit(0.2), unit(0.1)]);
    }
    let kinds = (unit(1.0) > 0.0, unit(1.0) > 0.0);
    let facet = |first: u32, is_triangle: bool| [first, first + 1, first + 2, if is_triangle { first + 2 } else { first + 3 }];
    (positions, [facet(0, kinds.0), facet(4, kinds.1)])
}

fn common(positions: &[Vector], facets: [[u32; 4]; 2], is_mean: bool) -> Option<Common> {
    let frames = facets.map(|facet| Frame::new(facet, positions));
    Common::new(&Facets::alone([&frames[0], &frames[1]]), is_mean, 0.0, Level::best())
}

/// Rows of the gap and both slips of a spring by node.
fn rows(common: &Common, part: &Part) -> Vec<(u32, [Vector; 3])> {
    let (tangents, mut ends) = (common.tangents(), [End::default(); 8]);
    let count = common.ends(part, tangents, &mut ends);
    let row = |end: &End<3>, along: Vector, more: Vector| [0, 1, 2].map(|d| end.share * along[d] + more[d]);
    let of = |end: &End<3>| [row(end, common.normal, end.lean), row(end, tangents[0], end.turn[0]), row(end, tangents[1], end.turn[1])];
    ends[..count].iter().map(|end| (end.at, of(end))).collect()
}

#[test]
fn forces_of_any_pair_have_neither_resultant_nor_couple() {
    let (mut random, mut met) = (Random::new(3), 0);
    for _ in 0..500 {
        let (positions, facets) = some(&mut random);
        let frames = facets.map(|facet| Frame::new(facet, &positions));
        let Some(common) = Common::new(&Facets::alone([&frames[0], &frames[1]]), false, 2.0 * random.unit() - 1.0, Level::best()) else {
            continue;
        };
        for part in common.parts() {
            let rows = rows(&common, part);
            for k in 0..3 {
                let (mut sum, mut moment) = ([0.0; 3], [0.0; 3]);
                for (node, rows) in &rows {
                    let turn = cross(positions[*node as usize], rows[k]);
                    (0..3).for_each(|d| (sum[d], moment[d]) = (sum[d] + rows[k][d], moment[d] + turn[d]));
                }
                assert!(sum.iter().chain(&moment).all(|c| c.abs() < 1e-13), "{k}: {sum:?} {moment:?}");
            }
            met += 1;
        }
    }
    assert!(met > 1000, "{met}");
}

#[test]
fn parts_sum_up_to_the_whole_and_to_the_mean() {
    let mut random = Random::new(4);
    for _ in 0..500 {
        let (positions, facets) = some(&mut random);
        let (Some(split), Some(whole)) = (common(&positions, facets, false), common(&positions, facets, true)) else { continue };
        let mean = whole.parts()[0];
        let area: f64 = split.parts().iter().map(|part| part.area).sum();
        assert!((area - mean.area).abs() < 1e-14 && (area - whole.area).abs() < 1e-14);
        let gap: f64 = split.parts().iter().map(|part| part.area * part.gap).sum();
        assert!((gap - mean.area * mean.gap).abs() < 1e-14);
        for k in 0..2 {
            for i in 0..4 {
                let share: f64 = split.parts().iter().map(|part| part.area * part.shares[k][i]).sum();
                assert!((share - mean.area * mean.shares[k][i]).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn whichever_facet_is_the_first_springs_are_the_same() {
    let mut random = Random::new(9);
    for _ in 0..500 {
        let (positions, facets) = some(&mut random);
        let (one, other) = (common(&positions, facets, false), common(&positions, [facets[1], facets[0]], false));
        let (Some(one), Some(other)) = (one, other) else { continue };
        assert!(one.owner == 1 - other.owner && one.parts().len() == other.parts().len());
        for (a, b) in one.parts().iter().zip(other.parts()) {
            assert!(a.slot == b.slot && (a.area - b.area).abs() < 1e-14 && (a.gap - b.gap).abs() < 1e-13);
            for k in 0..2 {
                assert!((0..4).all(|i| (a.shares[k][i] - b.shares[1 - k][i]).abs() < 1e-12));
            }
        }
    }
}

#[test]
fn of_facets_that_cannot_be_there_is_no_number_and_no_panic() {
    let mut random = Random::new(21);
    for round in 0..20_000 {
        let (mut positions, facets) = some(&mut random);
        let scale = [1.0, 1e-9, 1e9][round % 3];
        match round / 3 % 6 {
            // Needles, slivers, equal corners, a facet on itself, a corner on an edge, one that is turned in.
            0 => positions[2] = [0, 1, 2].map(|d| positions[1][d] + 1e-12 * random.unit()),
            1 => positions[2] = [0, 1, 2].map(|d| 0.5 * (positions[0][d] + positions[1][d]) + 1e-13 * random.unit()),
            2 => positions[6] = positions[5],
            3 => (0..4).for_each(|k| positions[k] = positions[[4, 7, 6, 5][k]]),
            4 => positions[0] = [0, 1, 2].map(|d| 0.3 * positions[4][d] + 0.7 * positions[5][d]),
            _ => positions[6] = [0, 1, 2].map(|d| 0.8 * positions[4][d] + 0.2 * positions[6][d]),
        }
        positions.iter_mut().for_each(|x| *x = x.map(|c| scale * c));
        let Some(common) = common(&positions, facets, false) else { continue };
        for part in common.parts() {
            assert!(part.area > 0.0 && part.gap.is_finite() && part.shares.iter().flatten().all(|share| share.is_finite()));
            for shares in part.shares {
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{shares:?}");
                assert!(shares.iter().all(|share| (-1e-5..1.0 + 1e-5).contains(share)), "{round} {shares:?}");
            }
        }
    }
    let bad = [[f64::NAN, 0.0, 0.0], [f64::INFINITY, 0.0, 0.0]];
    for x in bad {
        let (mut positions, facets) = some(&mut random);
        positions[1] = x;
        assert!(common(&positions, facets, false).is_none());
    }
}

#[test]
fn on_facets_that_lie_on_each_other_corner_on_corner_every_gap_is_held() {
    // Of the gaps at the corners as numbers each of which moves alone: with one spring those of a chequered
    // pattern would not be seen.
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mut positions: Vec<Vector> = square.to_vec();
    positions.extend([0, 3, 2, 1].map(|k| square[k]));
    let facets = [[4, 5, 6, 7], [0, 1, 2, 3]];
    let stiffness = |is_mean: bool, pattern: [f64; 4]| -> f64 {
        let common = common(&positions, facets, is_mean).unwrap();
        let gap = |part: &Part| (0..4).map(|i| part.shares[1][i] * pattern[i]).sum::<f64>();
        common.parts().iter().map(|part| part.area * gap(part) * gap(part)).sum()
    };
    for (pattern, least) in [([1.0; 4], 1.0), ([1.0, 1.0, -1.0, -1.0], 0.1), ([1.0, -1.0, -1.0, 1.0], 0.1), ([1.0, -1.0, 1.0, -1.0], 0.02)]
    {
        assert!(stiffness(false, pattern) > least * (1.0 - 1e-12), "{pattern:?}: {}", stiffness(false, pattern));
    }
    assert!(stiffness(true, [1.0, -1.0, 1.0, -1.0]) < 1e-30);
}

/// Facets of the same mesh or of two, in all ways in which edges may coincide, at any place.
fn placed(random: &mut Random, round: usize) -> (Vec<Vector>, [[u32; 4]; 2]) {
    let digit = |by: usize, count: usize| round / by % count;
    let mut unit = |size: f64| size * (2.0 * random.unit() - 1.0);
    let (apart, crooked) = ([0.0, 0.3, 1.0, 2.0][digit(1, 4)], [0.0, 1e-14, 0.02, 0.2][digit(4, 4)]);
    let by = [unit(apart), unit(apart)].map(|by| if digit(16, 2) == 0 { (2.0 * by).round() / 2.0 } else { by });
    let tilt = if digit(32, 2) == 0 { [0.0; 2] } else { [unit(0.3), unit(0.3)] };
    let (far, size) = ([0.0, 100.0][digit(64, 2)], [1.0, 0.01][digit(128, 2)]);
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut place = |x: f64, y: f64, off: f64| {
        let [x, y] = [x + unit(off) + far, y + unit(off)];
        [x, y, unit(off) + tilt[0] * x + tilt[1] * y]
    };
    let mut positions: Vec<Vector> = square.iter().map(|[x, y]| place(size * y + by[0], size * x + by[1], size * crooked)).collect();
    positions.extend(square.iter().map(|&[x, y]| place(x, y, crooked)));
    let kinds = [unit(1.0), unit(1.0)].map(|kind| if kind > 0.5 { 2 } else { 3 });
    (positions, [[0, 1, 2, kinds[0]], [4, 5, 6, 4 + kinds[1]]])
}

/// Triangles of a facet in the common plane, with the nodes' shares at their corners.
type Slow = Vec<([[f64; 2]; 3], [[f64; 4]; 3])>;

fn triangles(frame: &Frame, axes: [Vector; 2], is_turned: bool) -> Slow {
    let place = |x: Vector| axes.map(|axis| dot(axis, minus(x, frame.middle)));
    let share = |k: usize| std::array::from_fn(|i| f64::from(i == k));
    let corner = |k: usize| (place(frame.corners[k]), share(k));
    let list: Vec<[_; 3]> = if frame.count == 3 {
        vec![[corner(0), corner(1), corner(2)]]
    } else {
        (0..4).map(|k| [corner(k), corner((k + 1) % 4), (place(frame.middle), [0.25; 4])]).collect()
    };
    let turned = |[a, b, c]: [([f64; 2], [f64; 4]); 3]| if is_turned { [b, a, c] } else { [a, b, c] };
    let all = list.into_iter().map(turned).map(|list| (list.map(|of| of.0), list.map(|of| of.1)));
    // What is folded over has no part in it.
    all.filter(|([a, b, c], _)| twice(*a, *b, *c) > 0.0).collect()
}

/// Twice the area of a triangle.
fn twice(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Shares of a facet's nodes at a place of one of its triangles.
fn shares_at(([a, b, c], of): &([[f64; 2]; 3], [[f64; 4]; 3]), p: [f64; 2]) -> [f64; 4] {
    let parts = [twice(p, *b, *c), twice(*a, p, *c), twice(*a, *b, p)].map(|part| part / twice(*a, *b, *c));
    std::array::from_fn(|i| (0..3).map(|k| parts[k] * of[k][i]).sum())
}

/// ∫ 1, ∫ N_c and ∫ N_c N_k over the common part, with the shares N_c of the owner's corners: all triangles
/// of one facet are cut by all edges of those of the other one, and of what is left the middles of edges are
/// taken, which is exact for products of linear functions.
fn slowly(common: &Common) -> (f64, [f64; 4], [[[f64; 4]; 2]; 4]) {
    let (mut area, mut weights, mut sums) = (0.0, [0.0; 4], [[[0.0; 4]; 2]; 4]);
    let along = any_tangent(common.normal);
    let axes = [along, cross(common.normal, along)];
    let off = axes.map(|axis| dot(axis, minus(common.frames[0].middle, common.frames[1].middle)));
    let mut first = triangles(&common.frames[0], axes, true);
    first.iter_mut().flat_map(|one| &mut one.0).for_each(|p| *p = [p[0] + off[0], p[1] + off[1]]);
    for one in &first {
        for other in &triangles(&common.frames[1], axes, false) {
            let mut part = one.0.to_vec();
            for k in 0..3 {
                let (a, b, whole) = (other.0[k], other.0[(k + 1) % 3], std::mem::take(&mut part));
                for (i, &to) in whole.iter().enumerate() {
                    let from = whole[(i + whole.len() - 1) % whole.len()];
                    let (before, after) = (twice(a, b, from), twice(a, b, to));
                    if before * after < 0.0 {
                        part.push([0, 1].map(|d| from[d] + before / (before - after) * (to[d] - from[d])));
                    }
                    if after >= 0.0 {
                        part.push(to);
                    }
                }
            }
            for i in 2..part.len() {
                let corners = [part[0], part[i - 1], part[i]];
                let third = twice(corners[0], corners[1], corners[2]) / 6.0;
                area += 3.0 * third;
                for k in 0..3 {
                    let p = [0, 1].map(|d| 0.5 * (corners[k][d] + corners[(k + 1) % 3][d]));
                    let shares = [shares_at(one, p), shares_at(other, p)];
                    for (c, weight) in shares[common.owner as usize].into_iter().enumerate() {
                        weights[c] += third * weight;
                        (0..2).for_each(|k| (0..4).for_each(|i| sums[c][k][i] += third * weight * shares[k][i]));
                    }
                }
            }
        }
    }
    (area, weights, sums)
}

#[test]
fn the_quick_way_to_what_facets_have_in_common_finds_what_the_slow_one_does() {
    let (mut random, mut met, mut apart) = (Random::new(8), 0, 0);
    for round in 0..40_000 {
        let (positions, facets) = placed(&mut random, round);
        let frames = facets.map(|facet| Frame::new(facet, &positions));
        let least = frames[0].area.min(frames[1].area);
        let lead = if round % 2 == 0 { 0.0 } else { 2.0 * random.unit() - 1.0 };
        let found = Common::new(&Facets::alone([&frames[0], &frames[1]]), false, lead, Level::best());
        let Some(found) = found else {
            // Nothing that the slow way finds either, in the same plane.
            let [a, b] = frames;
            let normal = unit([0, 1, 2].map(|d| (1.0 + lead) * b.normal[d] - (1.0 - lead) * a.normal[d]));
            let (owner, parts) = (owner([&a, &b]) as u8, Default::default());
            let (area, ..) = slowly(&Common { frames, normal, area: 0.0, lowest: 0.0, owner, edges: [0; 2], parts, count: 0 });
            assert!(dot(a.normal, b.normal) >= 0.0 || area < 1.01 * SLIVER * least, "{round}: {area}");
            apart += 1;
            continue;
        };
        for level in Level::available() {
            let same = Common::new(&Facets::alone([&frames[0], &frames[1]]), false, lead, level)
                .map(|common| (common.lowest, common.parts, common.edges));
            assert_eq!(same, Some((found.lowest, found.parts, found.edges)), "{round} {level:?}");
        }
        let (area, weights, sums) = slowly(&found);
        let facing = -dot(frames[0].normal, frames[1].normal);
        let counts = smooth(facing / FACING) * 2.0 / (1.0 + facing);
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-11 * least, "{round}: {a} {b}");
        near(found.area, counts * area);
        for part in found.parts() {
            for k in 0..2 {
                for i in 0..4 {
                    let (weight, sum) = match part.slot {
                        0 => (area, (0..4).map(|c| sums[c][k][i]).sum()),
                        c => (weights[c - 1], sums[c - 1][k][i]),
                    };
                    near(part.shares[k][i] * weight, sum);
                }
            }
        }
        met += 1;
    }
    assert!(met > 10_000 && apart > 5_000, "{met} {apart}");
}
