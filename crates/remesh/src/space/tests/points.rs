//! Tests of the values of integration points.

use super::{KINDS, Kinds, Made, Random, largest, pipe, turned};
use crate::space::kind::SIGNS;
use crate::space::vector::{dot, six_volumes};
use crate::space::{Cell, Failure, Kind, Order, Point, PointMap, Points, Rule, Values, points};

/// Places of the points of a cell: the centre of its volume, or those of the rule.
fn of_cell(made: &Made, cell: &Cell, rule: Rule) -> Vec<Point> {
    let x: Vec<Point> = cell.nodes().iter().map(|&node| made.positions[node as usize]).collect();
    let at = |weights: &[f64]| [0, 1, 2].map(|d| weights.iter().zip(&x).map(|(weight, x)| weight * x[d]).sum());
    match (rule, cell.kind()) {
        (_, Kind::Tetrahedron) | (Rule::One, Kind::Tetrahedron10) => vec![at(&[0.25; 4])],
        (Rule::One, kind) => {
            // By the triangles of the faces.
            let middle: Point = at(&vec![1.0 / x.len() as f64; x.len()]);
            let (mut sum, mut total) = ([0.0; 3], 0.0);
            for face in kind.faces() {
                let corners: Vec<Point> = face.iter().map(|&k| x[usize::from(k)]).collect();
                let centre = [0, 1, 2].map(|d| corners.iter().map(|x| x[d]).sum::<f64>() / corners.len() as f64);
                for k in 0..corners.len() {
                    let tet = [corners[(k + 1) % corners.len()], corners[k], centre, middle];
                    let volume = six_volumes(&tet);
                    (0..3).for_each(|d| sum[d] += volume * tet.iter().map(|x| x[d]).sum::<f64>() / 4.0);
                    total += volume;
                }
            }
            vec![sum.map(|sum| sum / total)]
        }
        (Rule::Full, Kind::Hexahedron) => {
            let g = 1.0 / 3.0f64.sqrt();
            let shape = |p: Point| SIGNS.map(|s| (0..3).map(|k| 0.5 * (1.0 + s[k] * p[k] * g)).product());
            SIGNS.map(|point| at(&shape(point))).to_vec()
        }
        (Rule::Full, Kind::Wedge) => {
            let g = 1.0 / 3.0f64.sqrt();
            (0..6)
                .map(|point| {
                    let weights: Vec<f64> = (0..6)
                        .map(|node| {
                            let across = if (node < 3) == (point < 3) { 1.0 + g } else { 1.0 - g };
                            0.5 * across * if node % 3 == point % 3 { 2.0 / 3.0 } else { 1.0 / 6.0 }
                        })
                        .collect();
                    at(&weights)
                })
                .collect()
        }
        (Rule::Full, Kind::Tetrahedron10) => {
            let (near, far) = ((5.0 + 3.0 * 5.0f64.sqrt()) / 20.0, (5.0 - 5.0f64.sqrt()) / 20.0);
            (0..4).map(|point| at(&[0, 1, 2, 3].map(|node| if node == point { near } else { far }))).collect()
        }
    }
}

fn places(made: &Made, rule: Rule) -> Vec<Point> {
    made.cells.iter().flat_map(|cell| of_cell(made, cell, rule)).collect()
}

fn of(made: &Made, rule: Rule) -> Points<'_> {
    Points { mesh: made.mesh(), rule }
}

fn plain(values: &[f64], width: usize) -> Values<'_> {
    Values { values, width, densities: None, order: Order::Linear, limits: None }
}

const RULES: [Rule; 2] = [Rule::One, Rule::Full];

fn carried(old: &Made, new: &Made, rule: Rule, values: &[f64], width: usize) -> Vec<f64> {
    points(&of(old, rule), &of(new, rule), &plain(values, width)).unwrap()
}

#[test]
fn linear_fields_pass_exactly_to_the_outline() {
    let mut random = Random::new(31);
    let field = |x: &Point| 3.0 - 2.0 * x[0] + 5.0 * x[1] + x[2];
    for rule in RULES {
        for kinds in KINDS {
            let to = turned(0.7);
            let [old, new] = [[3, 3, 4], [4, 3, 2]].map(|n| Made::cube(n, 0.2, kinds, &mut random).map(&to));
            let values: Vec<f64> = places(&old, rule).iter().map(field).collect();
            let found = carried(&old, &new, rule, &values, 1);
            let most = largest(places(&new, rule).iter().zip(&found).map(|(x, value)| value - field(x)));
            println!("linear {rule:?} {kinds:?}: {most:e}");
            assert!(most < 1e-12, "{rule:?}, {kinds:?}: {most:e}");
        }
    }
}

/// One layer of cells: slopes in it.
#[test]
fn linear_fields_pass_in_a_layer_and_a_row() {
    let mut random = Random::new(40);
    for (n, m, slopes) in [([4, 3, 1], [3, 4, 1], [2.0, -3.0, 0.0]), ([5, 1, 1], [4, 1, 1], [2.0, 0.0, 0.0])] {
        let [old, new] = [n, m].map(|n| Made::cube(n, 0.0, Kinds::Hexahedra, &mut random).map(turned(0.4)));
        let field = |x: &Point| 1.0 + dot(slopes, turned(-0.4)(*x));
        let values: Vec<f64> = places(&old, Rule::One).iter().map(field).collect();
        let found = carried(&old, &new, Rule::One, &values, 1);
        let most = largest(places(&new, Rule::One).iter().zip(&found).map(|(x, value)| value - field(x)));
        assert!(most < 1e-12, "{n:?}: {most:e}");
    }
}

#[test]
fn uniform_values_pass_thirty_times() {
    let mut random = Random::new(32);
    for rule in RULES {
        let mut old = Made::cube([2, 2, 2], 0.3, Kinds::Hexahedra, &mut random);
        let mut values: Vec<f64> = places(&old, rule).iter().flat_map(|_| [2.5e8, -3.0]).collect();
        for k in 0..30 {
            let new = Made::cube([2, 2, 2], 0.3, KINDS[k % 5], &mut random);
            values = carried(&old, &new, rule, &values, 2);
            old = new;
        }
        let most = largest(values.chunks(2).flat_map(|pair| [pair[0] / 2.5e8 - 1.0, pair[1] / 3.0 + 1.0]));
        println!("uniform {rule:?}: {most:e}");
        assert!(most < 1e-12, "{rule:?}: {most:e}");
    }
}

#[test]
fn the_same_mesh_changes_nothing() {
    let mut random = Random::new(33);
    for rule in RULES {
        for kinds in KINDS {
            let made = Made::cube([2, 2, 2], 0.25, kinds, &mut random);
            let densities: Vec<f64> = made.cells.iter().map(|_| 2.0 + random.next()).collect();
            let values: Vec<f64> = (0..3 * places(&made, rule).len()).map(|_| random.next()).collect();
            let map = PointMap::new(&of(&made, rule), &of(&made, rule)).unwrap();
            for order in [Order::Linear, Order::Constant] {
                for densities in [None, Some(&densities[..])] {
                    let found = map.values(&Values { values: &values, width: 3, densities, order, limits: None }).unwrap();
                    let most = largest(found.iter().zip(&values).map(|(a, b)| a - b));
                    assert!(most < 1e-12, "{rule:?}, {kinds:?}, {order:?}: {most:e}");
                }
            }
        }
    }
}

#[test]
fn smooth_values_are_of_second_order() {
    let field = |x: &Point| (2.0 * x[0]).sin() * (1.5 * x[1] + x[2]).cos();
    for (rule, kinds, sizes) in [
        (Rule::One, Kinds::Hexahedra, [4, 8]),
        (Rule::Full, Kinds::Hexahedra, [4, 8]),
        (Rule::Full, Kinds::Wedges, [3, 6]),
        (Rule::One, Kinds::Tetrahedra, [4, 8]),
        (Rule::Full, Kinds::Tens, [3, 6]),
    ] {
        let errors = sizes.map(|n| {
            let mut random = Random::new(300 + n as u64);
            let [old, new] = [n, n].map(|n| Made::cube([n; 3], 0.2, kinds, &mut random));
            let values: Vec<f64> = places(&old, rule).iter().map(field).collect();
            let (map, to) = (PointMap::new(&of(&old, rule), &of(&new, rule)).unwrap(), places(&new, rule));
            [Order::Linear, Order::Constant].map(|order| {
                let found = map.values(&Values { order, ..plain(&values, 1) }).unwrap();
                let errors = to.iter().zip(&found).map(|(x, value)| (value - field(x)).powi(2)).sum::<f64>();
                (errors / found.len() as f64).sqrt()
            })
        });
        let slopes = [0, 1].map(|k| (errors[0][k] / errors[1][k]).log2());
        println!("values {rule:?} {kinds:?}: {errors:.6?}, order {slopes:.2?}");
        assert!(slopes[0] >= 1.8 && slopes[1] >= 0.8, "{rule:?} {kinds:?}: {errors:?}, order {slopes:?}");
    }
}

/// A ball of 1 in 0, to and fro: sums are kept, limits too.
#[test]
fn sums_and_bounds_of_a_jump_are_kept() {
    let mut random = Random::new(34);
    for rule in RULES {
        for kinds in KINDS {
            let meshes = [[4, 3, 3], [3, 4, 3]].map(|n| Made::cube(n, 0.2, kinds, &mut random));
            let densities: Vec<Vec<f64>> = meshes.iter().map(|made| made.cells.iter().map(|_| 2.0 + random.next()).collect()).collect();
            let maps = [0, 1].map(|k| PointMap::new(&of(&meshes[k], rule), &of(&meshes[1 - k], rule)).unwrap());
            for (order, limits) in [(Order::Linear, None), (Order::Linear, Some([[0.0, 1.0]])), (Order::Constant, None)] {
                let is_in = |x: &Point| if x.iter().map(|x| (x - 0.5) * (x - 0.5)).sum::<f64>() < 0.12 { 1.0 } else { 0.0 };
                let mut values: Vec<f64> = places(&meshes[0], rule).iter().map(is_in).collect();
                for k in 0..6 {
                    let of_old = (order == Order::Linear).then_some(&densities[k % 2][..]);
                    let weights = maps[k % 2].weights(of_old, order).unwrap();
                    let sum = |values: &[f64], weights: &[f64]| values.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>();
                    let of = Values { densities: of_old, order, limits: limits.as_ref().map(|limits| &limits[..]), ..plain(&values, 1) };
                    let found = maps[k % 2].values(&of).unwrap();
                    let change = sum(&found, &weights[1]) / sum(&values, &weights[0]) - 1.0;
                    assert!(change.abs() < 1e-13, "{rule:?} {kinds:?} {order:?}: the sum changes by {change:e}");
                    let [low, high] =
                        values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| [f64::min(low, v), f64::max(high, v)]);
                    // Without limits slopes may continue to the outline, which is near everywhere.
                    let [low, high] = if order == Order::Constant { [low, high] } else { limits.map_or([-1.0, 2.0], |limits| limits[0]) };
                    let over = found.iter().fold(0.0, |over: f64, &value| over.max(value - high).max(low - value));
                    assert!(over < 1e-14, "{rule:?} {kinds:?} {order:?}: over by {over:e}");
                    values = found;
                }
            }
        }
    }
}

/// Outlines of different chords: sums with the weights of what is there, uniform values, whole mass.
#[test]
fn other_chords_of_an_arc_keep_sums() {
    let mut random = Random::new(36);
    for (old, new, kinds) in
        [([2, 5, 2], [2, 6, 2], Kinds::Hexahedra), ([2, 6, 2], [2, 5, 2], Kinds::Tens), ([2, 5, 2], [2, 4, 2], Kinds::All)]
    {
        let (old, new) = (pipe(old, kinds, &mut random), pipe(new, kinds, &mut random));
        for rule in RULES {
            let densities: Vec<f64> = old.cells.iter().map(|_| 2.0 + random.next()).collect();
            let map = PointMap::new(&of(&old, rule), &of(&new, rule)).unwrap();
            let values: Vec<f64> = places(&old, rule).iter().map(|x| 1.0 + x[0] * x[1] + x[2]).collect();
            for densities in [None, Some(&densities[..])] {
                let found = map.values(&Values { densities, ..plain(&values, 1) }).unwrap();
                let weights = map.weights(densities, Order::Linear).unwrap();
                let sum = |values: &[f64], weights: &[f64]| values.iter().zip(weights).map(|(v, w)| v * w).sum::<f64>();
                let change = sum(&found, &weights[1]) / sum(&values, &weights[0]) - 1.0;
                let mass: f64 = (0..old.cells.len()).map(|e| densities.map_or(1.0, |d| d[e]) * old.volume(e)).sum();
                let whole = largest(weights.iter().map(|weights| weights.iter().sum::<f64>() / mass - 1.0));
                assert!(change.abs() < 1e-13 && whole < 1e-13, "{kinds:?} {rule:?}: {change:e} {whole:e}");
                let found = map.values(&Values { densities, ..plain(&vec![7.0; values.len()], 1) }).unwrap();
                let most = largest(found.iter().map(|value| value / 7.0 - 1.0));
                assert!(most < 1e-12, "{kinds:?} {rule:?}: {most:e}");
            }
        }
    }
}

#[test]
fn wrong_inputs_are_refused() {
    let mut random = Random::new(39);
    let [old, new] = [Kinds::Hexahedra, Kinds::All].map(|kinds| Made::cube([2, 2, 2], 0.2, kinds, &mut random));
    let map = PointMap::new(&of(&old, Rule::Full), &of(&new, Rule::One)).unwrap();
    assert_eq!(map.values(&plain(&[0.0; 8], 1)).unwrap_err(), Failure::Size);
    assert_eq!(map.values(&plain(&[f64::NAN; 64], 1)).unwrap_err(), Failure::Number);
    assert_eq!(map.values(&Values { densities: Some(&[0.0; 8]), ..plain(&[0.0; 64], 1) }).unwrap_err(), Failure::Massless { cell: 0 });
    assert_eq!(map.values(&Values { densities: Some(&[1.0; 64]), ..plain(&[0.0; 64], 1) }).unwrap_err(), Failure::Size);
    assert_eq!(map.values(&Values { limits: Some(&[]), ..plain(&[0.0; 64], 1) }).unwrap_err(), Failure::Size);
    assert_eq!(map.weights(Some(&[1.0]), Order::Linear).unwrap_err(), Failure::Size);
}
