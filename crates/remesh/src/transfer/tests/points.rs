//! Tests of the values of integration points.

use super::{Kind, Made, Random, ring, turned};
use crate::plane::{Measure, Point, corners};
use crate::transfer::{Failure, Order, PointMap, Points, Side, Values, points};
use std::f64::consts::PI;

/// Places of the points of a mesh: the centre of a cell's area, or 2 × 2 in reference coordinates.
fn places(made: &Made, count: usize) -> Vec<Point> {
    let mut found = Vec::new();
    for cell in &made.cells {
        let x: Vec<Point> = corners(cell).iter().map(|&node| made.positions[node as usize]).collect();
        if count == 1 {
            let (mut sum, mut total) = ([0.0; 2], 0.0);
            for k in 1..x.len() - 1 {
                let area = (x[k][0] - x[0][0]) * (x[k + 1][1] - x[0][1]) - (x[k][1] - x[0][1]) * (x[k + 1][0] - x[0][0]);
                (0..2).for_each(|i| sum[i] += area * (x[0][i] + x[k][i] + x[k + 1][i]) / 3.0);
                total += area;
            }
            found.push([sum[0] / total, sum[1] / total]);
            continue;
        }
        let g = 1.0 / 3.0f64.sqrt();
        for [r, s] in [[-g, -g], [g, -g], [g, g], [-g, g]] {
            let shape = [(1.0 - r) * (1.0 - s), (1.0 + r) * (1.0 - s), (1.0 + r) * (1.0 + s), (1.0 - r) * (1.0 + s)];
            found.push([0, 1].map(|i| (0..4).map(|k| 0.25 * shape[k] * x[k][i]).sum()));
        }
    }
    found
}

fn of(made: &Made, points: usize) -> Points<'_> {
    Points { mesh: made.mesh(), points }
}

fn plain(values: &[f64], width: usize) -> Values<'_> {
    Values { values, width, densities: None, order: Order::Linear, limits: None }
}

/// Counts of points, kinds of cells that can have them.
const COUNTS: [(usize, Kind); 4] = [(1, Kind::Quads), (1, Kind::Triangles), (1, Kind::Both), (4, Kind::Quads)];

fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, |most: f64, value| most.max(value.abs()))
}

#[test]
fn linear_fields_pass_exactly_to_the_outline() {
    let mut random = Random::new(31);
    let field = |x: &Point| 3.0 - 2.0 * x[0] + 5.0 * x[1];
    for (count, kind) in COUNTS {
        for sizes in [[8, 8, 11, 9], [11, 9, 8, 8], [6, 6, 13, 13]] {
            let to = turned(0.7);
            let old = Made::square(sizes[0], sizes[1], 0.25, kind, &mut random).map(&to);
            let new = Made::square(sizes[2], sizes[3], 0.25, kind, &mut random).map(&to);
            let values: Vec<f64> = places(&old, count).iter().map(field).collect();
            let found = points(&of(&old, count), &of(&new, count), Measure::Plane, &plain(&values, 1)).unwrap();
            let most = largest(places(&new, count).iter().zip(&found).map(|(x, value)| value - field(x)));
            println!("linear {count} {kind:?} {sizes:?}: {most:e}");
            assert!(most < 1e-12, "{count} points, {kind:?}, {sizes:?}: {most:e}");
        }
    }
}

#[test]
fn uniform_values_pass_a_hundred_times() {
    let mut random = Random::new(32);
    for (count, kind) in COUNTS {
        let meshes: Vec<Made> = (0..5).map(|k| Made::square(8 + k, 10 - k, 0.3, kind, &mut random)).collect();
        let mut values: Vec<f64> = places(&meshes[0], count).iter().flat_map(|_| [2.5e8, -3.0]).collect();
        for k in 1..=100 {
            let (old, new) = (&meshes[(k - 1) * 3 % 5], &meshes[k * 3 % 5]);
            values = points(&of(old, count), &of(new, count), Measure::Plane, &plain(&values, 2)).unwrap();
        }
        let most = largest(values.chunks(2).flat_map(|pair| [pair[0] / 2.5e8 - 1.0, pair[1] / 3.0 + 1.0]));
        println!("uniform {count} {kind:?}: {most:e}");
        assert!(most < 1e-13, "{count} points, {kind:?}: {most:e}");
    }
}

#[test]
fn the_same_mesh_changes_nothing() {
    let mut random = Random::new(33);
    for measure in [Measure::Plane, Measure::Revolution] {
        for (count, kind) in COUNTS {
            let made = Made::square(9, 7, 0.3, kind, &mut random);
            let densities: Vec<f64> = made.cells.iter().map(|_| 2.0 + random.next()).collect();
            let values: Vec<f64> = (0..3 * count * made.cells.len()).map(|_| random.next()).collect();
            for order in [Order::Linear, Order::Constant] {
                for densities in [None, Some(&densities[..])] {
                    let of_points = Values { values: &values, width: 3, densities, order, limits: None };
                    let found = points(&of(&made, count), &of(&made, count), measure, &of_points).unwrap();
                    let most = largest(found.iter().zip(&values).map(|(a, b)| a - b));
                    assert!(most < 1e-13, "{measure:?}, {count} points, {kind:?}, {order:?}: {most:e}");
                }
            }
        }
    }
}

#[test]
fn smooth_values_are_of_second_order() {
    let field = |x: &Point| (PI * x[0]).sin() * (2.0 * x[1]).cos();
    for (count, kind) in COUNTS {
        for ratio in [1.0, 1.4] {
            for order in [Order::Linear, Order::Constant] {
                let errors: Vec<f64> = [10, 20, 40]
                    .iter()
                    .map(|&n| {
                        // The mean of some meshes.
                        let of_mesh = |seed: u64| {
                            let mut random = Random::new(300 + seed);
                            let old = Made::square(n, n, 0.25, kind, &mut random);
                            let m = (ratio * n as f64) as usize;
                            let new = Made::square(m, m, 0.25, kind, &mut random);
                            let values: Vec<f64> = places(&old, count).iter().map(field).collect();
                            let of_old = Values { order, ..plain(&values, 1) };
                            let found = points(&of(&old, count), &of(&new, count), Measure::Plane, &of_old).unwrap();
                            let errors = places(&new, count).iter().zip(&found).map(|(x, value)| (value - field(x)).powi(2)).sum::<f64>();
                            (errors / found.len() as f64).sqrt()
                        };
                        (0..4).map(of_mesh).sum::<f64>() / 4.0
                    })
                    .collect();
                let slopes = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
                println!("values {count} {kind:?} {ratio} {order:?}: {errors:.6?}, order {slopes:.2?}");
                let least = if order == Order::Linear { 1.8 } else { 0.8 };
                assert!(slopes.iter().all(|&slope| slope >= least), "{count} {kind:?} {ratio} {order:?}: {errors:?}, order {slopes:?}");
            }
        }
    }
}

/// A disc of 1 in 0, to and fro: sums are kept, bounds too but for the widening, and no less than expected of
/// the variance stays.
#[test]
fn sums_and_bounds_of_a_jump_are_kept() {
    let mut random = Random::new(34);
    for measure in [Measure::Plane, Measure::Revolution] {
        for (count, kind) in COUNTS {
            for order in [Order::Linear, Order::Constant] {
                let meshes = [Made::square(20, 20, 0.25, kind, &mut random), Made::square(21, 19, 0.25, kind, &mut random)];
                let densities: Vec<Vec<f64>> = meshes.iter().map(|made| made.cells.iter().map(|_| 2.0 + random.next()).collect()).collect();
                let maps = [0, 1].map(|k| PointMap::new(&of(&meshes[k], count), &of(&meshes[1 - k], count), measure).unwrap());
                for is_by_mass in [false, true] {
                    let is_in = |x: &Point| if (x[0] - 0.5).powi(2) + (x[1] - 0.5).powi(2) < 0.09 { 1.0 } else { 0.0 };
                    let mut values: Vec<f64> = places(&meshes[0], count).iter().map(is_in).collect();
                    let variance = |values: &[f64]| {
                        let mean = values.iter().sum::<f64>() / values.len() as f64;
                        values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64
                    };
                    let (before, mut most, mut over) = (variance(&values), 0.0f64, 0.0f64);
                    for k in 0..20 {
                        let of_old = is_by_mass.then_some(&densities[k % 2][..]);
                        let weights = maps[k % 2].weights(of_old, order).unwrap();
                        let sum = |values: &[f64], weights: &[f64]| values.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>();
                        let found = maps[k % 2].values(&Values { densities: of_old, order, ..plain(&values, 1) }).unwrap();
                        let change = sum(&found, &weights[1]) / sum(&values, &weights[0]) - 1.0;
                        most = most.max(change.abs());
                        let low = values.iter().fold(f64::INFINITY, |low, &v| low.min(v));
                        let high = values.iter().fold(f64::NEG_INFINITY, |high, &v| high.max(v));
                        let wider = 1.001e-3 * (high - low);
                        for value in &found {
                            over = over.max(value - high - wider).max(low - wider - value);
                        }
                        values = found;
                    }
                    let kept = variance(&values) / before;
                    println!(
                        "jump {measure:?} {count} {kind:?} {order:?} mass {is_by_mass}: sums {most:e}, over {over:e}, variance {kept:.3}"
                    );
                    assert!(most < 1e-13, "{count} {kind:?} {order:?}: the sum changes by {most:e}");
                    assert!(over <= 0.0, "{count} {kind:?} {order:?}: over by {over:e}");
                    let least = match (order, count) {
                        (Order::Linear, 1) => 0.75,
                        (Order::Linear, _) => 0.85,
                        (Order::Constant, _) => 0.5,
                    };
                    assert!(kept > least, "{count} {kind:?} {order:?}: {kept}");
                }
            }
        }
    }
}

/// With limits values are within them, at the outline too.
#[test]
fn limits_are_kept() {
    let mut random = Random::new(35);
    for (count, kind) in COUNTS {
        let (old, new) = (Made::square(7, 7, 0.25, kind, &mut random), Made::square(15, 15, 0.25, kind, &mut random));
        let values: Vec<f64> = places(&old, count).iter().map(|x| (0.9 - x[0] - x[1]).max(0.0)).collect();
        let map = PointMap::new(&of(&old, count), &of(&new, count), Measure::Plane).unwrap();
        let found = map.values(&Values { limits: Some(&[[0.0, 1.0]]), ..plain(&values, 1) }).unwrap();
        let least = found.iter().fold(f64::INFINITY, |least, &value| least.min(value));
        assert!(least >= -1e-15, "{count} points, {kind:?}: {least:e}");
        let free = map.values(&plain(&values, 1)).unwrap();
        let least_free = free.iter().fold(f64::INFINITY, |least, &value| least.min(value));
        println!("limits {count} {kind:?}: {least:e}, without {least_free:e}");
    }
}

/// Outlines of different chords: sums with the weights of what is there, uniform values, whole mass.
#[test]
fn other_chords_of_an_arc_keep_sums() {
    let mut random = Random::new(36);
    for measure in [Measure::Plane, Measure::Revolution] {
        let quarter = |made: Made| made.map(|x| if measure == Measure::Plane { x } else { [x[0] + 2.5, x[1]] });
        for (old, new) in [((6, 20), (7, 31)), ((7, 31), (6, 20)), ((4, 24), (5, 25))] {
            let (old, new) = (quarter(ring(old.0, old.1, &mut random)), quarter(ring(new.0, new.1, &mut random)));
            for count in [1, 4] {
                let densities: Vec<f64> = old.cells.iter().map(|_| 2.0 + random.next()).collect();
                let map = PointMap::new(&of(&old, count), &of(&new, count), measure).unwrap();
                let values: Vec<f64> = places(&old, count).iter().map(|x| 1.0 + x[0] * x[1]).collect();
                for densities in [None, Some(&densities[..])] {
                    let found = map.values(&Values { densities, ..plain(&values, 1) }).unwrap();
                    let weights = map.weights(densities, Order::Linear).unwrap();
                    let sum = |values: &[f64], weights: &[f64]| values.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>();
                    let change = sum(&found, &weights[1]) / sum(&values, &weights[0]) - 1.0;
                    let whole = weights[1].iter().sum::<f64>() / weights[0].iter().sum::<f64>() - 1.0;
                    let mass: f64 = (0..old.cells.len()).map(|e| densities.map_or(1.0, |d| d[e]) * old.volume(e, measure)).sum();
                    let of_cells = weights[0].iter().sum::<f64>() / mass - 1.0;
                    assert!(change.abs() < 1e-13 && whole.abs() < 1e-13, "{measure:?} {count}: {change:e} {whole:e}");
                    assert!(of_cells.abs() < 1e-13, "{measure:?} {count}: {of_cells:e}");
                    let uniform = vec![7.0; values.len()];
                    let found = map.values(&Values { densities, ..plain(&uniform, 1) }).unwrap();
                    let most = largest(found.iter().map(|value| value / 7.0 - 1.0));
                    assert!(most < 1e-13, "{measure:?} {count}: {most:e}");
                }
            }
        }
    }
}

/// Slender, tiny, huge and turned cells.
#[test]
fn scales_and_aspects_do_not_matter() {
    let mut random = Random::new(37);
    for scale in [1e-9, 1.0, 1e9] {
        for angle in [0.0, 0.3, 1.1] {
            let to = |x: Point| turned(angle)([scale * x[0], 0.01 * scale * x[1]]);
            for (count, kind) in COUNTS {
                let old = Made::square(9, 7, 0.25, kind, &mut random).map(to);
                let new = Made::square(6, 10, 0.25, kind, &mut random).map(to);
                let field = |x: &Point| {
                    let y = turned(-angle)(*x);
                    1.0 + y[0] / scale - 2.0 * y[1] / (0.01 * scale)
                };
                let values: Vec<f64> = places(&old, count).iter().map(field).collect();
                let map = PointMap::new(&of(&old, count), &of(&new, count), Measure::Plane).unwrap();
                let found = map.values(&plain(&values, 1)).unwrap();
                let most = largest(places(&new, count).iter().zip(&found).map(|(x, value)| value - field(x)));
                assert!(most < 1e-10, "scale {scale:e}, angle {angle}, {count} {kind:?}: {most:e}");
            }
        }
    }
}

/// A corner that turns inwards has quarters of positive area still, and sums are kept.
#[test]
fn a_corner_that_turns_inwards_keeps_sums() {
    let mut random = Random::new(38);
    let mut old = Made::square(4, 4, 0.0, Kind::Quads, &mut random);
    old.positions[6] = [0.41, 0.41];
    let new = Made::square(5, 5, 0.2, Kind::Quads, &mut random);
    let values: Vec<f64> = (0..64).map(|_| random.next()).collect();
    let map = PointMap::new(&of(&old, 4), &of(&new, 4), Measure::Plane).unwrap();
    let found = map.values(&plain(&values, 1)).unwrap();
    let [before, after] = map.weights(None, Order::Linear).unwrap();
    let sum = |values: &[f64], weights: &[f64]| values.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>();
    let change = sum(&found, &after) - sum(&values, &before);
    assert!(change.abs() < 1e-14, "{change:e}");
    assert!(before.iter().all(|&weight| weight > 0.0));
}

#[test]
fn wrong_inputs_are_refused() {
    let mut random = Random::new(39);
    let quads = Made::square(3, 3, 0.2, Kind::Quads, &mut random);
    let triangles = Made::square(3, 3, 0.2, Kind::Triangles, &mut random);
    let failure = |old: Points<'_>, new: Points<'_>| PointMap::new(&old, &new, Measure::Plane).unwrap_err();
    assert_eq!(failure(of(&quads, 3), of(&quads, 1)), Failure::Points { side: Side::Old, cell: 0 });
    assert_eq!(failure(of(&quads, 4), of(&triangles, 4)), Failure::Points { side: Side::New, cell: 0 });
    let larger = quads.clone().map(|x| [1.5 * x[0], x[1]]);
    assert_eq!(failure(of(&quads, 4), of(&larger, 4)), Failure::Uncovered { cell: 2 });
    let mirrored = quads.clone().map(|x| [-x[0], x[1]]);
    assert_eq!(failure(of(&quads, 4), of(&mirrored, 4)), Failure::Inverted { side: Side::New, cell: 0 });
    let map = PointMap::new(&of(&quads, 1), &of(&triangles, 1), Measure::Plane).unwrap();
    assert_eq!(map.values(&plain(&[0.0; 8], 1)).unwrap_err(), Failure::Size);
    assert_eq!(map.values(&plain(&[f64::NAN; 9], 1)).unwrap_err(), Failure::Number);
    assert_eq!(map.values(&Values { densities: Some(&[0.0; 9]), ..plain(&[0.0; 9], 1) }).unwrap_err(), Failure::Massless { cell: 0 });
    assert_eq!(map.values(&Values { limits: Some(&[]), ..plain(&[0.0; 9], 1) }).unwrap_err(), Failure::Size);
}
