use super::*;
use crate::mesh::cell::CellKind;
use crate::random::Random;

/// The outside of a box of n³ hexahedra with its pieces turned to look inwards, as walls around a gas do, and
/// its inner nodes and those on its faces shaken, but for those on planes that are named.
fn hollow_box(n: usize, size: f64, shake: f64, without: impl Fn([f64; 3]) -> bool) -> (Vec<[u32; 4]>, Vec<[f64; 3]>) {
    let number = |i: usize, j: usize, k: usize| (i + (n + 1) * (j + (n + 1) * k)) as u32;
    let mut positions: Vec<[f64; 3]> = Vec::new();
    for k in 0..=n {
        for j in 0..=n {
            for i in 0..=n {
                positions.push([i, j, k].map(|x| x as f64 * size / n as f64));
            }
        }
    }
    let mut cells = Vec::new();
    for k in 0..n {
        for j in 0..n {
            for i in 0..n {
                let at = |a, b, c| number(i + a, j + b, k + c);
                cells.push([at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)]);
            }
        }
    }
    let facets = crate::mesh::surface::exterior::<3>(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap();
    let centre = |facet: &[u32; 4]| facet.iter().fold([0.0; 3], |sum, &node| plus(sum, times(0.25, positions[node as usize])));
    let facets = facets.into_iter().filter(|facet| !without(centre(facet))).map(Corners::reversed).collect();
    let mut random = Random::new(7);
    for x in &mut positions {
        for d in 0..3 {
            // Where a wall is left out a plane of symmetry is: rims stay on it.
            let mut on_plane = [0.5 * size; 3];
            on_plane[d] = x[d];
            if !without(on_plane) {
                x[d] += shake * (2.0 * random.unit() - 1.0);
            }
        }
    }
    (facets, positions)
}

fn plane(point: [f64; 3], normal: [f64; 3], positions: &[[f64; 3]]) -> Plane<3> {
    let on = |&node: &u32| dot(minus(positions[node as usize], point), normal).abs() < 1e-9;
    Plane { point, normal: unit(normal).unwrap(), nodes: (0..positions.len() as u32).filter(on).collect() }
}

/// ∂V/∂x by differences of the volume against what pushes, of nodes along the directions that are free.
fn differs<const D: usize>(surface: &Closed<D>, positions: &[[f64; D]], is_free: impl Fn(u32, usize) -> bool) -> f64
where
    Dim<D>: Tributary<D>,
{
    let mut worst: f64 = 0.0;
    for (node, gradient, _) in surface.gradient().collect::<Vec<_>>() {
        for d in (0..D).filter(|&d| is_free(node, d)) {
            let volume = |by: f64| {
                let mut moved = positions.to_vec();
                moved[node as usize][d] += by;
                surface.clone().measure(&moved)
            };
            worst = worst.max((volume(1e-4) - volume(-1e-4) - 2e-4 * gradient[d]).abs() / 2e-4);
        }
    }
    worst
}

#[test]
fn a_closed_box_of_warped_facets_has_its_volume_and_gradient() {
    let (facets, positions) = hollow_box(3, 2.0, 0.0, |_| false);
    let (_, volume) = Closed::<3>::new(facets.clone(), &positions, &[], Depth::Plane).unwrap();
    assert!((volume - 8.0).abs() < 1e-13, "{volume}");
    let (facets, positions) = hollow_box(3, 2.0, 0.15, |_| false);
    let (surface, volume) = Closed::<3>::new(facets.clone(), &positions, &[], Depth::Plane).unwrap();
    // V is cubic in a coordinate at most: central differences of a multilinear form are exact.
    let error = differs(&surface, &positions, |_, _| true);
    assert!(error < 1e-10, "{error}");
    // Far away, and seen from the wrong side.
    let far: Vec<[f64; 3]> = positions.iter().map(|x| plus(*x, [1e6, -3e5, 2e6])).collect();
    let (_, there) = Closed::<3>::new(facets.clone(), &far, &[], Depth::Plane).unwrap();
    assert!((there / volume - 1.0).abs() < 1e-8, "{there} {volume}");
    let turned = facets.iter().map(|facet| facet.reversed()).collect();
    assert!(matches!(Closed::<3>::new(turned, &positions, &[], Depth::Plane), Err(Open::Outside(found)) if (found + volume).abs() < 1e-12));
}

#[test]
fn planes_of_symmetry_close_a_part_of_a_box() {
    // One, two and three planes through a corner, in any place and direction; two that are parallel; all but
    // one wall.
    type Wall = fn([f64; 3]) -> bool;
    let cases: [(Wall, &[usize], &[usize]); 6] = [
        (|x| x[0] < 1e-9, &[0], &[]),
        (|x| x[0] < 1e-9 || x[1] < 1e-9, &[0, 1], &[]),
        (|x| x.iter().any(|x| *x < 1e-9), &[0, 1, 2], &[]),
        (|x| x[0] < 1e-9 || x[0] > 2.0 - 1e-9, &[0], &[0]),
        (|x| x[0] < 1e-9 || x[0] > 2.0 - 1e-9 || x[1] < 1e-9, &[0, 1], &[0]),
        // Without the wall at the bottom there is no rim at all there: the plane that the top faces closes
        // it.
        (|x| x[2] < 2.0 - 1e-9, &[0, 1, 2], &[0, 1]),
    ];
    let ([c, s], [d, e]) = ([0.8, 0.6], [5.0 / 13.0, 12.0 / 13.0]);
    let turn: Square<3> =
        crate::tensor::product(&[[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], &[[1.0, 0.0, 0.0], [0.0, d, -e], [0.0, e, d]]);
    for (number, (without, low, high)) in cases.iter().enumerate() {
        for is_turned in [false, true] {
            let (facets, mut positions) = hollow_box(3, 2.0, 0.12, without);
            let place = |x: [f64; 3]| if is_turned { plus(applied(&turn, x), [0.3, -5.0, 2.0]) } else { x };
            let direction = |axis: usize| {
                let axis = crate::rotation::unit_matrix::<3>()[axis];
                if is_turned { applied(&turn, axis) } else { axis }
            };
            // What is missing, by hand: the whole box with its shaken walls, planes where they are.
            let exact = whole_volume(&facets, &positions);
            positions.iter_mut().for_each(|x| *x = place(*x));
            let mut planes: Vec<Plane<3>> = low.iter().map(|&axis| plane(place([0.0; 3]), direction(axis), &positions)).collect();
            planes.extend(high.iter().map(|&axis| plane(place([2.0; 3]), times(-1.0, direction(axis)), &positions)));
            let (surface, volume) =
                Closed::<3>::new(facets, &positions, &planes, Depth::Plane).unwrap_or_else(|open| panic!("case {number}: {open:?}"));
            assert!((volume - exact).abs() < 1e-12, "case {number}, turned {is_turned}: {volume} {exact}");
            if !is_turned {
                let is_free =
                    |node: u32, d: usize| planes.iter().all(|plane| plane.normal[d] == 0.0 || plane.nodes.binary_search(&node).is_err());
                let error = differs(&surface, &positions, is_free);
                assert!(error < 1e-10, "case {number}: {error}");
            }
        }
    }
}

/// Volume of a box 2 × 2 × 2 whose walls are these, closed by caps on the faces of the box: by z of all
/// pieces (caps below at z = 0 give nothing, those at the sides are upright, and above there is always a
/// wall).
fn whole_volume(facets: &[[u32; 4]], positions: &[[f64; 3]]) -> f64 {
    let mut volume = 0.0;
    for &facet in facets {
        for (&node, (inward, share)) in facet.corners().iter().zip(<Dim<3>>::presses(Depth::Plane, facet, positions)) {
            volume += positions[node as usize][2] * inward[2] * share;
        }
    }
    volume
}

#[test]
fn what_is_open_is_named() {
    let without_a_wall: fn([f64; 3]) -> bool = |x| x[0] < 1e-9;
    let (facets, positions) = hollow_box(2, 2.0, 0.0, without_a_wall);
    assert_eq!(Closed::<3>::new(facets.clone(), &positions, &[], Depth::Plane), Err(Open::Rim(8, [0.0, 0.5, 0.0])));
    // The plane is elsewhere.
    let elsewhere = [plane([0.0; 3], [0.0, 1.0, 0.0], &positions)];
    assert!(matches!(Closed::<3>::new(facets, &positions, &elsewhere, Depth::Plane), Err(Open::Rim(6, _))));
    // One wall between planes on all sides, and nothing in front of it.
    let (facets, positions) =
        hollow_box(2, 2.0, 0.0, |x| x[1] < 1e-9 || x[1] > 2.0 - 1e-9 || x[2] < 1e-9 || x[2] > 2.0 - 1e-9 || x[0] < 1e-9);
    let planes: Vec<Plane<3>> =
        [0.0, 2.0].iter().flat_map(|&x| [plane([x; 3], [0.0, 1.0, 0.0], &positions), plane([x; 3], [0.0, 0.0, 1.0], &positions)]).collect();
    assert_eq!(Closed::<3>::new(facets, &positions, &planes, Depth::Plane), Err(Open::Towards([-1.0, 0.0, 0.0])));
}

#[test]
fn rims_at_the_same_places_close_each_other() {
    // Each facet with nodes of its own, in one place but for rounding.
    let (facets, positions) = hollow_box(2, 2.0, 0.1, |_| false);
    let (_, volume) = Closed::<3>::new(facets.clone(), &positions, &[], Depth::Plane).unwrap();
    let mut random = Random::new(3);
    let mut own = Vec::new();
    for facet in &facets {
        own.extend(facet.iter().map(|&node| positions[node as usize].map(|x| x + 1e-9 * random.unit())));
    }
    let apart: Vec<[u32; 4]> = (0..facets.len() as u32).map(|k| std::array::from_fn(|c| 4 * k + c as u32)).collect();
    let (_, found) = Closed::<3>::new(apart, &own, &[], Depth::Plane).unwrap();
    assert!((found / volume - 1.0).abs() < 1e-8, "{found} {volume}");
}

/// A closed polygon around a gas, body outside: the gas is on the left of each segment.
fn polygon(corners: &[[f64; 2]]) -> (Vec<[u32; 2]>, Vec<[f64; 2]>) {
    let n = corners.len() as u32;
    ((0..n).map(|k| [k, (k + 1) % n]).collect(), corners.to_vec())
}

#[test]
fn in_2d_a_polygon_has_its_area_and_an_axisymmetric_one_its_volume() {
    let corners = [[1.0, 0.0], [3.0, 0.5], [3.5, 2.0], [2.0, 3.0], [0.5, 1.5]];
    let (segments, positions) = polygon(&corners);
    let area: f64 = 0.5
        * (0..5)
            .map(|k| {
                let (a, b) = (corners[k], corners[(k + 1) % 5]);
                a[0] * b[1] - a[1] * b[0]
            })
            .sum::<f64>();
    let (surface, found) = Closed::<2>::new(segments.clone(), &positions, &[], Depth::Plane).unwrap();
    assert!((found - area).abs() < 1e-14, "{found} {area}");
    assert!(differs(&surface, &positions, |_, _| true) < 1e-10);
    // Pappus: 2π times the first moment ∫ x dA = Σ (a_x² + a_x b_x + b_x²)(b_y − a_y)/6.
    let moment: f64 = (0..5)
        .map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 5]);
            (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) * (b[1] - a[1]) / 6.0
        })
        .sum();
    let (surface, found) = Closed::<2>::new(segments, &positions, &[], Depth::Revolution).unwrap();
    assert!((found / (std::f64::consts::TAU * moment) - 1.0).abs() < 1e-14, "{found}");
    assert!(differs(&surface, &positions, |_, _| true) < 1e-8);
}

#[test]
fn the_axis_and_a_plane_across_it_close_a_quarter_of_a_sphere() {
    let n = 400;
    let at =
        |k: usize| [(k as f64 * std::f64::consts::FRAC_PI_2 / n as f64).cos(), (k as f64 * std::f64::consts::FRAC_PI_2 / n as f64).sin()];
    let mut positions: Vec<[f64; 2]> = (0..=n).map(at).collect();
    positions[n][0] = 0.0;
    let segments: Vec<[u32; 2]> = (0..n as u32).map(|k| [k, k + 1]).collect();
    let plane = Plane { point: [0.0; 2], normal: [0.0, 1.0], nodes: vec![0] };
    let (surface, volume) = Closed::<2>::new(segments.clone(), &positions, std::slice::from_ref(&plane), Depth::Revolution).unwrap();
    assert!((volume / (2.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 1e-5, "{volume}");
    let is_free = |node: u32, d: usize| !(node == 0 && d == 1 || node as usize == n && d == 0);
    assert!(differs(&surface, &positions, is_free) < 1e-7);
    assert!(matches!(Closed::<2>::new(segments, &positions, &[], Depth::Revolution), Err(Open::Rim(1, [1.0, 0.0]))));
}

#[test]
fn the_bound_of_the_sway_holds_for_any_facet() {
    // Largest singular value of ∂(∫ N n dA)/∂x by power iteration on differences.
    fn norm<const D: usize>(depth: Depth, facet: Facet<D>, positions: &[[f64; D]]) -> f64
    where
        Dim<D>: Tributary<D>,
    {
        let count = facet.corners().len();
        let all = |positions: &[[f64; D]]| -> Vec<f64> {
            let presses = <Dim<D>>::presses(depth, facet, positions);
            presses.as_ref()[..count].iter().flat_map(|&(inward, share)| times(share, inward)).collect()
        };
        let columns: Vec<Vec<f64>> = (0..count * D)
            .map(|k| {
                let moved = |by: f64| {
                    let mut moved = positions.to_vec();
                    moved[facet.corners()[k / D] as usize][k % D] += by;
                    all(&moved)
                };
                moved(1e-5).iter().zip(moved(-1e-5)).map(|(a, b)| (a - b) / 2e-5).collect()
            })
            .collect();
        let mut x = vec![1.0; count * D];
        let mut size = 0.0;
        for k in 0..300 {
            let y: Vec<f64> = (0..count * D).map(|i| (0..count * D).map(|j| columns[j][i] * x[j]).sum()).collect();
            let mut z: Vec<f64> = (0..count * D).map(|j| (0..count * D).map(|i| columns[j][i] * y[i]).sum()).collect();
            if k == 0 {
                z.iter_mut().enumerate().for_each(|(i, z)| *z += 1e-3 * (i as f64).sin());
            }
            size = z.iter().map(|z| z * z).sum::<f64>().sqrt();
            x = z.iter().map(|z| z / size).collect();
        }
        size.sqrt()
    }
    let mut random = Random::new(11);
    let mut worst = [0.0_f64; 4];
    for _ in 0..200 {
        let mut number = || 2.0 * random.unit() - 1.0;
        let solid: Vec<[f64; 3]> = (0..4).map(|_| [number(), number(), number()]).collect();
        let flat: Vec<[f64; 2]> = (0..2).map(|_| [number() + 1.0, number()]).collect();
        for (worst, facet) in worst[2..].iter_mut().zip([[0, 1, 2, 3], [0, 1, 2, 2]]) {
            *worst = worst.max(norm::<3>(Depth::Plane, facet, &solid) / sway(Depth::Plane, facet.corners(), &solid));
        }
        worst[0] = worst[0].max(norm::<2>(Depth::Plane, [0, 1], &flat) / sway(Depth::Plane, &[0, 1], &flat));
        worst[1] = worst[1].max(norm::<2>(Depth::Revolution, [0, 1], &flat) / sway(Depth::Revolution, &[0, 1], &flat));
    }
    assert!(worst.iter().all(|&worst| worst < 1.0 + 1e-6 && worst > 0.3), "{worst:?}");
}
