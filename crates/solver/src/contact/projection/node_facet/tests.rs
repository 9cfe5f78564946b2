use super::pseudo_normal::angle_of;
use super::*;
use crate::bench::Random;
use crate::mesh::cell::CellKind;
use crate::mesh::surface::Surface;
use proptest::prelude::*;

/// A grid of hexahedra with some left out, its nodes moved a little: (surface, positions). `flat`: nodes
/// stay.
fn blocks(count: [usize; 3], is_there: impl Fn([usize; 3]) -> bool, shift: impl Fn(usize) -> Vector) -> (SpaceSurface, Vec<Vector>) {
    let [nx, ny, nz] = count;
    let node = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let mut positions = Vec::new();
    for (k, j, i) in (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| (k, j, i)))) {
        let by = shift(positions.len());
        positions.push([i as f64 + by[0], j as f64 + by[1], k as f64 + by[2]]);
    }
    let mut cells: Vec<Vec<u32>> = Vec::new();
    for (k, j, i) in (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| (k, j, i)))) {
        if is_there([i, j, k]) {
            let square = |k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
            cells.push([square(k), square(k + 1)].concat());
        }
    }
    (Surface::<3>::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap(), positions)
}

fn all(surface: &SpaceSurface) -> std::ops::Range<u32> {
    0..surface.facets.len() as u32
}

/// Whether a point is inside, by rays: how often a line from it goes through the triangles.
fn is_inside(placed: &Placed<'_>, x: Vector, direction: Vector) -> bool {
    let mut count = 0;
    for facet in all(placed.surface) {
        for k in 0..placed.triangles(facet) {
            let [a, b, c] = placed.triangle(facet, k).map(|corner| minus(corner, x));
            let volumes = [(a, b), (b, c), (c, a)].map(|(p, q)| dot(direction, cross(p, q)));
            let through = volumes.iter().all(|&v| v > 0.0) || volumes.iter().all(|&v| v < 0.0);
            let normal = cross(minus(b, a), minus(c, a));
            count += usize::from(through && dot(normal, a) / dot(normal, direction) > 0.0);
        }
    }
    count % 2 == 1
}

/// Least distance over dense samples of every triangle.
fn sampled(placed: &Placed<'_>, x: Vector) -> f64 {
    let (mut least, n) = (f64::INFINITY, 24);
    for facet in all(placed.surface) {
        for k in 0..placed.triangles(facet) {
            let [a, b, c] = placed.triangle(facet, k);
            for (i, j) in (0..=n).flat_map(|i| (0..=n - i).map(move |j| (i, j))) {
                let (u, v) = (i as f64 / n as f64, j as f64 / n as f64);
                let away = [0, 1, 2].map(|d| x[d] - ((1.0 - u - v) * a[d] + u * b[d] + v * c[d]));
                least = least.min(dot(away, away));
            }
        }
    }
    least.sqrt()
}

#[test]
fn a_node_against_a_box_is_where_the_closed_form_says_from_all_sides() {
    let (surface, positions) = blocks([2, 3, 2], |_| true, |_| [0.0; 3]);
    let placed = Placed { surface: &surface, positions: &positions };
    let (half, middle) = ([1.0, 1.5, 1.0], [1.0, 1.5, 1.0]);
    for i in 0..=20 {
        for j in 0..=20 {
            for k in 0..=20 {
                let x = [0.31 * i as f64 - 2.03, 0.33 * j as f64 - 1.97, 0.29 * k as f64 - 2.01];
                let q = [0, 1, 2].map(|d| (x[d] - middle[d]).abs() - half[d]);
                let outside = q.map(|q| q.max(0.0));
                let expected = dot(outside, outside).sqrt() + q[0].max(q[1]).max(q[2]).min(0.0);
                let found = placed.project(x, all(&surface)).unwrap();
                assert!((found.gap - expected).abs() < 1e-13, "{x:?}: {found:?} {expected}");
                assert!((found.weights.iter().sum::<f64>() - 1.0).abs() < 1e-14 && (dot(found.normal, found.normal) - 1.0).abs() < 1e-13);
                let foot = (0..4).map(|a| (found.weights[a], positions[surface.facets[found.facet as usize][a] as usize]));
                let foot = foot.fold([0.0; 3], |sum, (w, x)| [0, 1, 2].map(|d| sum[d] + w * x[d]));
                assert!(
                    (0..3).all(|d| (x[d] - foot[d] - found.gap * found.normal[d]).abs() < 1e-13),
                    "x is at its gap along the normal: {found:?}"
                );
            }
        }
    }
}

#[test]
fn a_node_against_a_ball_is_as_far_as_from_its_centre_less_the_radius() {
    // A cube of hexahedra blown up to a ball: error of chords falls with the square of the size.
    let mut last = f64::INFINITY;
    for n in [4, 8, 16] {
        let (surface, mut positions) = blocks([n; 3], |_| true, |_| [0.0; 3]);
        for x in &mut positions {
            let from = x.map(|c| 2.0 * c / n as f64 - 1.0);
            let (most, size) = (from.iter().fold(0.0f64, |m, c| m.max(c.abs())), dot(from, from).sqrt());
            *x = if size > 0.0 { from.map(|c| c * most / size) } else { from };
        }
        let placed = Placed { surface: &surface, positions: &positions };
        let mut worst = 0.0f64;
        for k in 0..60 {
            let k = k as f64;
            let x = [(1.3 * k).sin(), (2.1 * k).cos(), (0.7 * k + 1.0).sin()];
            let found = placed.project(x, all(&surface)).unwrap();
            worst = worst.max((found.gap - (dot(x, x).sqrt() - 1.0)).abs());
        }
        assert!(worst < 0.4 * last, "{n}: {worst} {last}");
        last = worst;
    }
    assert!(last < 0.01, "{last}");
}

#[test]
fn along_a_way_over_convex_and_concave_edges_and_corners_the_gap_continues() {
    // A staircase with a corner in it.
    let (surface, positions) = blocks(
        [3, 3, 3],
        |[i, j, k]| i + k < 3 && !(j == 2 && k == 1),
        |n| [0.02 * ((n * 7) % 5) as f64, 0.015 * ((n * 3) % 7) as f64, -0.02 * ((n * 11) % 4) as f64],
    );
    let placed = Placed { surface: &surface, positions: &positions };
    let at = |t: f64| [1.7 + 1.6 * (2.0 * t).sin(), 1.5 + 1.5 * (3.1 * t).cos(), 1.6 + 1.5 * (5.3 * t).sin()];
    let mut last: Option<(f64, Vector)> = None;
    let (mut features, step) = ([0; 4], 1e-4);
    for i in 0..60_000 {
        let x = at(step * f64::from(i));
        let found = placed.project(x, all(&surface)).unwrap();
        features[match found.feature {
            Feature::Face => 0,
            Feature::Edge(_) => 1,
            Feature::Node(_) => 2,
            Feature::Crease => 3,
        }] += 1;
        if let Some((gap, before)) = last {
            let way = minus(x, before);
            assert!((found.gap - gap).abs() <= dot(way, way).sqrt() * (1.0 + 1e-9) + 1e-14, "{i}: {gap} {found:?}");
        }
        last = Some((found.gap, x));
    }
    assert!(features.iter().all(|&count| count > 20), "{features:?}");
}

#[test]
fn the_rows_are_the_gradient_of_the_gap_in_every_node() {
    let (surface, positions) = blocks(
        [2, 2, 2],
        |at| at != [1, 1, 1],
        |n| [0.05 * ((n * 7) % 5) as f64, 0.04 * ((n * 3) % 7) as f64, -0.05 * ((n * 11) % 4) as f64],
    );
    let points: [Vector; 6] = [[0.7, 0.4, 2.3], [1.4, 1.6, 1.2], [2.4, 2.5, 0.6], [0.4, 2.0, 2.5], [2.6, 1.9, 1.4], [0.8, 0.6, 1.7]];
    for x in points {
        let placed = Placed { surface: &surface, positions: &positions };
        let found = placed.project(x, all(&surface)).unwrap();
        let gap = |x: Vector, positions: &[Vector]| Placed { surface: &surface, positions }.project(x, all(&surface)).unwrap().gap;
        let h = 1e-6;
        for d in 0..3 {
            let by = |sign: f64| {
                let mut x = x;
                x[d] += sign * h;
                gap(x, &positions)
            };
            assert!(((by(1.0) - by(-1.0)) / (2.0 * h) - found.normal[d]).abs() < 1e-8, "{x:?} {found:?}");
            for (a, &node) in
                surface.facets[found.facet as usize].iter().enumerate().take(surface.facets[found.facet as usize].corners().len())
            {
                let by = |sign: f64| {
                    let mut positions = positions.clone();
                    positions[node as usize][d] += sign * h;
                    gap(x, &positions)
                };
                let slope = (by(1.0) - by(-1.0)) / (2.0 * h);
                assert!((slope + found.weights[a] * found.normal[d]).abs() < 1e-7, "{x:?} {a} {d}: {slope} {found:?}");
            }
        }
    }
}

#[test]
fn an_open_surface_meets_what_is_over_it_and_nothing_beside_it() {
    let (whole, positions) = blocks([2, 2, 1], |_| true, |_| [0.0; 3]);
    let top: Vec<[u32; 4]> =
        whole.facets.iter().copied().filter(|facet| facet.iter().all(|&node| positions[node as usize][2] == 1.0)).collect();
    let cells: Vec<[u32; 8]> = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]]
        .map(|[a, b, c, d]: [u32; 4]| [a, b, c, d, a + 9, b + 9, c + 9, d + 9])
        .to_vec();
    let surface = Surface::<3>::new(top, cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap();
    let placed = Placed { surface: &surface, positions: &positions };
    assert_eq!(surface.facets.len(), 4);
    assert_eq!(placed.project([0.7, 0.4, 1.3], all(&surface)).map(|found| found.gap), Some(1.3 - 1.0));
    assert!(placed.project([-0.1, 0.4, 0.9], all(&surface)).is_none());
    // Flush with the border, but for round-off.
    let flush = placed.project([-1e-12, 0.4, 0.9], all(&surface)).unwrap();
    assert!((flush.gap + 0.1).abs() < 1e-15 && flush.normal == [0.0, 0.0, 1.0]);
}

/// A block of 4 × 2 × 4 hexahedra, symmetric in x = 0 and z = 0: the surface of all of it, that of the
/// quarter x ≥ 0, z ≥ 0 with its symmetry planes, and positions. `there` says which hexahedra of the quarter
/// are there, `shift` how its nodes are moved.
fn whole_and_quarter(
    there: impl Fn([usize; 3]) -> bool,
    shift: impl Fn([usize; 3]) -> Vector,
) -> (SpaceSurface, SpaceSurface, Vec<Vector>) {
    let node = |i: usize, j: usize, k: usize| ((k * 3 + j) * 5 + i) as u32;
    let nodes = (0..5).flat_map(|k| (0..3).flat_map(move |j| (0..5).map(move |i| [i, j, k])));
    let place = |[i, j, k]: [usize; 3]| {
        let by = shift([i.abs_diff(2), j, k.abs_diff(2)]);
        let away = |at: usize, by: f64| if at == 2 { 0.0 } else { (at as f64 - 2.0) * (1.0 + by) };
        [away(i, by[0]), j as f64 + by[1], away(k, by[2])]
    };
    let positions: Vec<Vector> = nodes.map(place).collect();
    let (mut all, mut quarter) = (Vec::new(), Vec::new());
    for (k, j, i) in (0..4).flat_map(|k| (0..2).flat_map(move |j| (0..4).map(move |i| (k, j, i)))) {
        let fold = |at: usize| if at < 2 { 1 - at } else { at - 2 };
        if there([fold(i), j, fold(k)]) {
            let square = |k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
            let cell = [square(k), square(k + 1)].concat();
            if i >= 2 && k >= 2 {
                quarter.push(cell.clone());
            }
            all.push(cell);
        }
    }
    let on = |nodes: &[u32], d: usize| nodes.iter().all(|&node| positions[node as usize][d] == 0.0);
    let whole = Surface::<3>::outside(all.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap();
    let half =
        Surface::<3>::outside_without(quarter.iter().map(|cell| CellKind::Hexahedron.cell(cell)), |facet| on(&facet, 0) || on(&facet, 2))
            .unwrap();
    // Normals away from the body are turned.
    let normals =
        |edge: [u32; 2]| [0, 2].into_iter().filter(move |&d| on(&edge, d)).map(|d| [0, 1, 2].map(|e| if d == e { -1.0 } else { 0.0 }));
    let half = half.with_mirrors(|edge| normals(edge).collect::<Vec<_>>(), &positions);
    (whole, half, positions)
}

#[test]
fn a_surface_that_ends_on_symmetry_planes_knows_their_normals_and_no_others() {
    let (whole, quarter, positions) = whole_and_quarter(|_| true, |_| [0.0; 3]);
    assert!(whole.mirrors.is_empty());
    let open = quarter.edges.iter().filter(|edge| edge.facets[1] == NONE).count();
    assert_eq!((quarter.mirrors.len(), open), (12, 12));
    for &(edge, normal) in &quarter.mirrors {
        let nodes = quarter.edges[edge as usize].nodes;
        let d = normal.iter().position(|n| *n == 1.0).unwrap();
        assert!(nodes.iter().all(|&node| positions[node as usize][d] == 0.0) && dot(normal, normal) == 1.0);
    }
    // What lies on a symmetry plane is no ridge, however sharp: others meet it in nodes.
    let bent: Vec<Vector> = positions.iter().map(|x| [x[0], x[1] - 2.0 * x[0], x[2]]).collect();
    assert!(quarter.mirrors.iter().all(|&(edge, _)| Placed { surface: &quarter, positions: &bent }.ridge(edge).is_none()));
    // A border that is on none.
    let mut bare = quarter.clone();
    bare.mirrors.clear();
    let placed = [&bare, &quarter].map(|surface| Placed { surface, positions: &positions });
    let (x, beyond) = ([0.0, 2.1, 0.4], [-0.3, 2.1, 0.4]);
    assert!(placed.iter().all(|placed| (placed.project(x, all(placed.surface)).unwrap().gap - 0.1).abs() < 1e-15));
    // What is beyond the plane is no concern of the model's.
    assert!(placed.iter().all(|placed| placed.project(beyond, all(placed.surface)).is_none()));
    // A symmetry plane is no rim.
    let corner = quarter.facets.iter().position(|facet| facet.iter().any(|&node| positions[node as usize] == [0.0, 2.0, 0.0])).unwrap();
    let at = quarter.facets[corner].iter().position(|&node| positions[node as usize] == [0.0, 2.0, 0.0]).unwrap();
    let (normal, border) = placed[1].node_normal(corner as u32, at);
    assert!(matches!(border, Border::Mirrors(_)) && normal[0] == 0.0 && normal[2] == 0.0 && normal[1] > 0.0);
    assert_eq!(placed[0].node_normal(corner as u32, at).1, Border::Cut);
    let x = [0.0, 2.1, 0.0];
    let (_, way) = placed[1].seen_over(x, placed[1].nearest_of(x, all(&quarter)).unwrap(), |_| true).unwrap();
    assert_eq!(way, [0.0; 3]);
}

#[test]
fn the_side_of_a_node_that_all_triangles_agree_on_is_that_of_its_angle_weighted_normal() {
    let (mut random, mut counts) = (Random::new(9), [0; 3]);
    for _ in 0..60 {
        let shifts: Vec<Vector> = (0..100).map(|_| [0; 3].map(|_| 0.5 * (random.unit() - 0.5))).collect();
        let gone = [0; 4].map(|_| [0; 3].map(|_| (3.0 * random.unit()) as usize));
        let (surface, positions) = blocks([3; 3], |at| !gone.contains(&at), |node| shifts[node]);
        let placed = Placed { surface: &surface, positions: &positions };
        for (facet, corner) in all(&surface).flat_map(|facet| (0..4).map(move |corner| (facet, corner))) {
            let away = [0; 3].map(|_| random.unit() - 0.5);
            let (normal, _) = placed.node_normal(facet, corner);
            match placed.side_of_node(facet, corner, away) {
                Some(side) => assert!(side * dot(away, normal) > 0.0 && side.abs() == 1.0),
                None => counts[2] += 1,
            }
            // Along a normal that all have in common, they do agree.
            counts[usize::from(placed.side_of_node(facet, corner, normal) == Some(1.0))] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 300), "{counts:?}");
}

#[test]
fn angles_are_those_of_the_platform() {
    for i in 0..=2000 {
        let angle = f64::from(i) * std::f64::consts::PI / 2000.0;
        let found = angle_of(3.0 * angle.sin().max(0.0), 3.0 * angle.cos());
        assert!((found - angle).abs() < 2e-15, "{angle} {found}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn nearest_and_inside_agree_with_samples_and_rays_on_random_surfaces(
        there in prop::collection::vec(prop::bool::weighted(0.75), 8),
        shifts in prop::collection::vec(-0.18f64..0.18, 81),
        points in prop::collection::vec((-0.8f64..2.8, -0.8f64..2.8, -0.8f64..2.8), 12),
    ) {
        // Cells that touch in an edge or a node only are no one body: the first and what has a face with it.
        let mut kept = [false; 8];
        kept[0] = true;
        for _ in 0..8 {
            for a in 0..8usize {
                kept[a] |= there[a] && (0..3).any(|d| kept[a ^ (1 << d)]);
            }
        }
        let (surface, positions) = blocks([2, 2, 2], |[i, j, k]| kept[i + 2 * j + 4 * k], |n| [shifts[3 * n], shifts[3 * n + 1], shifts[3 * n + 2]]);
        let placed = Placed { surface: &surface, positions: &positions };
        for (a, b, c) in points {
            let x = [a, b, c];
            let found = placed.project(x, all(&surface)).unwrap();
            let sampled = sampled(&placed, x);
            prop_assert!(found.gap.abs() <= sampled + 1e-12 && sampled - found.gap.abs() < 0.04, "{:?} {:?} {}", x, found, sampled);
            let inside = is_inside(&placed, x, [0.351, 0.432, 0.831]);
            let again = is_inside(&placed, x, [-0.251, 0.732, -0.631]);
            prop_assert!(inside != again || (found.gap < 0.0) == inside, "{:?} {:?} {}", x, found, inside);
        }
    }

    #[test]
    fn a_quarter_of_a_surface_with_its_symmetry_planes_is_seen_as_the_whole(
        there in prop::collection::vec(prop::bool::weighted(0.7), 8),
        shifts in prop::collection::vec(-0.18f64..0.18, 81),
        points in prop::collection::vec((-0.3f64..2.8, -0.8f64..2.8, -0.3f64..2.8), 24),
    ) {
        let mut kept = [false; 8];
        kept[0] = true;
        for _ in 0..8 {
            for a in 0..8usize {
                kept[a] |= there[a] && (0..3).any(|d| kept[a ^ (1 << d)]);
            }
        }
        let shift = |[i, j, k]: [usize; 3]| [0, 1, 2].map(|d| shifts[3 * (9 * k + 3 * j + i) + d]);
        let (whole, quarter, positions) = whole_and_quarter(|[i, j, k]| kept[i + 2 * j + 4 * k], shift);
        let [whole, quarter] = [&whole, &quarter].map(|surface| Placed { surface, positions: &positions });
        for (a, b, c) in points {
            // Many of them on a plane, or on both.
            let x = [a.max(0.0), b, c.max(0.0)];
            let [one, two] = [whole, quarter].map(|placed| placed.project(x, all(placed.surface)).unwrap());
            // A facet continues by a millionth beyond a rim, which the plane makes of a ridge.
            if two.weights.iter().any(|&weight| weight < 0.0) {
                prop_assert!((one.gap - two.gap).abs() < 1e-6, "{:?} {:?} {:?}", x, one, two);
                continue;
            }
            prop_assert!((one.gap - two.gap).abs() < 1e-12, "{:?} {:?} {:?}", x, one, two);
            // From a plane the whole may see a facet or its image: then the direction is that or its image.
            let apart = |d: usize| (one.normal[d].abs() - two.normal[d].abs()).abs();
            prop_assert!(one.gap.abs() < 1e-6 || (0..3).all(|d| apart(d) < 1e-9), "{:?} {:?} {:?}", x, one, two);
            prop_assert!(two.foot[0] >= -1e-12 && two.foot[2] >= -1e-12, "{:?} {:?}", x, two);
        }
    }
}
