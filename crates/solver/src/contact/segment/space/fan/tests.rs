use super::super::polygon::doubled;
use super::*;
use crate::bench::Random;

/// A triangle of the plane; `None` where it has no area.
fn fan(corners: [Point; 3]) -> Option<Fan> {
    let [a, b, c] = corners;
    let middle = [0, 1].map(|d| (a[d] + b[d] + c[d]) / 3.0);
    let fan = Fan::new(&Flat { places: [a, b, c, c, middle], heights: [0.0; 5], corners: 3, is_turned: false });
    (fan.count > 0).then_some(fan)
}

/// Moments of what two have in common.
fn common(one: &Fan, other: &Fan) -> Moments {
    let size = |fan: &Fan| {
        let off = fan.places.map(|p| [p[0] - fan.places[MIDDLE][0], p[1] - fan.places[MIDDLE][1]]);
        off.into_iter().map(|[x, y]| f64::hypot(x, y)).fold(0.0, f64::max)
    };
    let mut sum = Moments::default();
    one.meet(other, size(one).min(size(other)), Level::best(), |_, polygon| sum.add(&polygon.moments()));
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
        let (Some(one), Some(other)) = (fan(a), fan(b)) else { continue };
        let (found, expected) = (common(&one, &other).area(), by_strips(a, b));
        assert!((found - expected).abs() < 1e-13, "{a:?} {b:?}: {found} {expected}");
        assert!((found - common(&other, &one).area()).abs() < 1e-13);
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
        let Some(one) = fan(scaled(some(&mut random, round / 3 % 4))) else { continue };
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
            if let Some(other) = fan(scaled([corners[k], corners[(k + 1) % 4], middle])) {
                sum.add(&common(&one, &other));
            }
        }
        let whole = one.moments();
        for (k, (found, expected)) in sum.0.iter().zip(whole.0).enumerate() {
            let size = scale.powi([2, 3, 3, 4, 4, 4][k]);
            assert!((found - expected).abs() < 1e-14 * size, "{k}: {found} {expected}");
        }
        assert!((sum.area() - whole.area()).abs() < 1e-12 * whole.area().max(1e-2 * scale * scale));
    }
}
