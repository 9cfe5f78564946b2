use super::super::polygon::{Moments, doubled};
use super::*;
use crate::bench::Random;

fn has_area(corners: [Point; 3]) -> bool {
    let [a, b, c] = corners;
    let square = |p: Point, q: Point| (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2);
    [square(a, b), square(b, c), square(c, a)].into_iter().all(|square| doubled(corners) > FLAT * square)
}

/// Two triangles laid into the plane that they are in; `None` where they are apart.
fn laid([a, b, c]: [Point; 3], [d, e, f]: [Point; 3]) -> Option<Fans> {
    let positions = [c, b, a, d, e, f].map(|[x, y]| [x, y, 0.0]);
    let frames = [[0, 1, 2, 2], [3, 4, 5, 5]].map(|nodes| Frame::new(nodes, &positions));
    let (mut fans, axes) = (Fans::default(), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    fans.set(&Facets::alone([&frames[0], &frames[1]]), [0.0; 3], axes, 0.0, Level::best()).then_some(fans)
}

/// Moments of what two have in common.
fn common(one: [Point; 3], other: [Point; 3]) -> Moments {
    let mut sum = Moments::default();
    if let Some(fans) = laid(one, other) {
        assert_eq!(fans.sectors, 0x11);
        fans.meet(|_, polygon| sum.add(&polygon.moments()));
    }
    sum
}

/// Area that two triangles have in common as a sum over strips between the ordinates of all corners and
/// crossings, in which it is a trapezoid: no polygon is cut.
fn by_strips(one: [Point; 3], other: [Point; 3]) -> f64 {
    let edges = |t: [Point; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut heights: Vec<f64> = one.iter().chain(&other).map(|p| p[1]).collect();
    for [a, b] in edges(one) {
        for [c, d] in edges(other) {
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
            let whole = u[0] * v[1] - u[1] * v[0];
            if whole != 0.0 {
                let t = ((c[0] - a[0]) * v[1] - (c[1] - a[1]) * v[0]) / whole;
                if (0.0..=1.0).contains(&t) {
                    heights.push(a[1] + t * u[1]);
                }
            }
        }
    }
    heights.sort_by(f64::total_cmp);
    // Width of a triangle along a line of constant y.
    let range = |t: [Point; 3], y: f64| {
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        for [p, q] in edges(t) {
            if (p[1] - y) * (q[1] - y) < 0.0 {
                let x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
                found = [found[0].min(x), found[1].max(x)];
            }
        }
        found
    };
    let strip = |two: &[f64]| {
        let middle = 0.5 * (two[0] + two[1]);
        let (a, b) = (range(one, middle), range(other, middle));
        (a[1].min(b[1]) - a[0].max(b[0])).max(0.0) * (two[1] - two[0])
    };
    heights.windows(2).map(strip).sum()
}

fn some(random: &mut Random, sort: usize) -> [Point; 3] {
    let mut unit = || random.unit();
    let mut corners = [0, 1, 2].map(|_| [unit(), unit()]);
    match sort {
        // A needle, a sliver, corners on a grid, so that edges coincide.
        1 => corners[2] = [corners[0][0] + 1e-7 * unit(), corners[0][1] + 1e-7 * unit()],
        2 => {
            let along = unit();
            corners[2] = [0, 1].map(|d| corners[0][d] + along * (corners[1][d] - corners[0][d]) + 1e-9 * unit());
        }
        3 => corners = corners.map(|p| p.map(|c| (3.0 * c).round() / 3.0)),
        _ => {}
    }
    if doubled(corners) < 0.0 { [corners[0], corners[2], corners[1]] } else { corners }
}

#[test]
fn common_areas_are_those_of_strips_for_needles_slivers_and_edges_that_coincide() {
    let mut random = Random::new(11);
    let mut met = 0;
    for round in 0..40_000 {
        let (a, b) = (some(&mut random, round % 4), some(&mut random, round / 4 % 4));
        if !(has_area(a) && has_area(b)) {
            continue;
        }
        let (found, expected) = (common(a, b).area(), by_strips(a, b));
        assert!((found - expected).abs() < 1e-13, "{a:?} {b:?}: {found} {expected}");
        assert!((found - common(b, a).area()).abs() < 1e-13);
        met += usize::from(expected > 0.0);
    }
    assert!(met > 10_000, "{met}");
}

#[test]
fn what_covers_a_triangle_has_all_of_its_moments_at_any_scale() {
    let mut random = Random::new(5);
    for round in 0..2_000 {
        let scale = [1.0, 1e-12, 1e12][round % 3];
        let scaled = |t: [Point; 3]| t.map(|p| p.map(|c| scale * c));
        let one = scaled(some(&mut random, round / 3 % 4));
        if !has_area(one) {
            continue;
        }
        // The unit square in a fan about any of its points, some of which are on its rim or a corner.
        let mut unit = || random.unit();
        let middle = match round % 5 {
            0 => [0.0, unit()],
            1 => [1.0, 1.0],
            _ => [0.1 + 0.8 * unit(), 0.1 + 0.8 * unit()],
        };
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mut sum = Moments::default();
        for k in 0..4 {
            let other = scaled([corners[k], corners[(k + 1) % 4], middle]);
            if has_area(other) {
                sum.add(&common(one, other));
            }
        }
        let whole = Moments::around(&one);
        for (k, (found, expected)) in sum.0.iter().zip(whole.0).enumerate() {
            let size = scale.powi([2, 3, 3, 4, 4, 4][k]);
            assert!((found - expected).abs() < 1e-14 * size, "{k}: {found} {expected}");
        }
        assert!((sum.area() - whole.area()).abs() < 1e-12 * whole.area().max(1e-2 * scale * scale));
    }
}

#[test]
fn shares_are_one_at_their_own_corner_and_none_at_others_and_flat_triangles_have_none() {
    let (one, other) = ([[0.2, 0.1], [1.4, 0.3], [0.5, 1.1]], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    let fans = laid(one, other).unwrap();
    for k in 0..2 {
        let Sector { labels, shares } = fans.sector(k, 0);
        for (i, share) in shares.into_iter().enumerate() {
            for corner in labels {
                let [x, y] = fans.place(k, corner);
                let found = share[0] + share[1] * x + share[2] * y;
                assert!((found - f64::from(corner == labels[i])).abs() < 1e-15, "{k} {i}: {found}");
            }
        }
    }
    for flat in [[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], [[0.5, 0.5]; 3], [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]] {
        assert!(laid(one, flat).is_none_or(|fans| fans.sectors >> 4 == 0), "{flat:?}");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(laid(one, [[0.0, 0.0], [1.0, 0.0], [0.3, bad]]).is_none_or(|fans| fans.sectors >> 4 == 0));
    }
}

#[test]
fn distances_near_an_edge_count_as_none_and_beyond_that_grow_to_what_they_are_without_a_jump() {
    assert!([0.0, 1.0, -1.0, 0.3].into_iter().all(|near| soft(near, 1.0) == 0.0));
    assert!([2.0, -2.5, 1e6].into_iter().all(|far| soft(far, 1.0) == far) && soft(-1.5, 1.0) == -1.0);
    let steps = (0..=4000).map(|k| soft(1e-3 * f64::from(k) - 2.0, 1.0)).collect::<Vec<_>>();
    assert!(steps.windows(2).all(|two| (0.0..2.1e-3).contains(&(two[1] - two[0]))));
}
