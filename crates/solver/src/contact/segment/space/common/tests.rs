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
    Common::new([&frames[0], &frames[1]], is_mean, 0.0)
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
        let Some(common) = Common::new([&frames[0], &frames[1]], false, 2.0 * random.unit() - 1.0) else { continue };
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
