//! Sections against closed forms: areas, centroids, values.

use super::*;

/// Cells of one kind over a block of the unit cube, each hexahedron divided; `size` along each axis.
fn block(kind: CellKind, size: [u32; 3]) -> (Cells, Vec<[f64; 3]>) {
    let [nx, ny, nz] = size;
    // Nodes at double distances: the middles of edges lie between.
    let (mx, my, mz) = (2 * nx + 1, 2 * ny + 1, 2 * nz + 1);
    let node = |[i, j, k]: [u32; 3]| i + mx * (j + my * k);
    let place =
        |n: u32| [n % mx, n / mx % my, n / (mx * my)].iter().zip(size).map(|(&i, n)| f64::from(i) / f64::from(2 * n)).collect::<Vec<_>>();
    let places = (0..mx * my * mz).map(|n| place(n).try_into().unwrap()).collect();
    let mut cells = Cells { offsets: vec![0], part_names: vec!["block".into()], ..Cells::default() };
    let hexahedron = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    let divisions: Vec<Vec<usize>> = match kind {
        CellKind::Wedge => vec![vec![0, 1, 2, 4, 5, 6], vec![0, 2, 3, 4, 6, 7]],
        CellKind::Tetrahedron | CellKind::Tetrahedron10 => {
            [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]].map(|[a, b]| vec![0, a, b, 6]).to_vec()
        }
        _ => vec![(0..8).collect()],
    };
    for cell in 0..nx * ny * nz {
        let corner = [cell % nx, cell / nx % ny, cell / (nx * ny)];
        for division in &divisions {
            let at = |c: usize| [0, 1, 2].map(|k| 2 * (corner[k] + hexahedron[c][k]));
            cells.nodes.extend(division.iter().map(|&c| node(at(c))));
            if kind == CellKind::Tetrahedron10 {
                let middle = |[a, b]: [u8; 2]| {
                    let (a, b) = (at(division[usize::from(a)]), at(division[usize::from(b)]));
                    node([0, 1, 2].map(|k| (a[k] + b[k]) / 2))
                };
                cells.nodes.extend(CellKind::Tetrahedron.facts().edges.iter().map(|&edge| middle(edge)));
            }
            cells.offsets.push(cells.nodes.len() as u32);
            cells.kinds.push(kind);
            cells.parts.push(0);
        }
    }
    (cells, places)
}

/// The middle and the area of all triangles, and the largest error of a linear field at their corners.
fn measured(section: &Section, places: &[[f64; 3]]) -> ([f64; 3], f64, f64) {
    let along = |k: usize| section.with_middles(section.points.iter().map(|p| p.between(p.nodes.map(|n| places[n as usize][k]))).collect());
    let [x, y, z] = [0, 1, 2].map(along);
    let linear = |x: [f64; 3]| 3.0 - 2.0 * x[0] + 5.0 * x[1] + 0.25 * x[2];
    let values = section.with_middles(section.points.iter().map(|p| p.between(p.nodes.map(|n| linear(places[n as usize])))).collect());
    let (mut middle, mut whole, mut worst) = ([0.0; 3], 0.0, 0.0f64);
    for (corners, _) in section.triangles() {
        let [a, b, c] = corners.map(|corner| [x[corner as usize], y[corner as usize], z[corner as usize]]);
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let area = 0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        middle = [0, 1, 2].map(|k| middle[k] + area * (a[k] + b[k] + c[k]) / 3.0);
        whole += area;
        for (corner, at) in corners.iter().zip([a, b, c]) {
            worst = worst.max((values[*corner as usize] - linear(at)).abs());
        }
    }
    (middle.map(|m| m / whole), whole, worst)
}

fn section(cells: &Cells, places: &[[f64; 3]], normal: [f64; 3], offset: f64) -> Section {
    let plane = Plane::new(normal, offset).unwrap();
    Section::new(cells, &[], &heights(&plane, places.iter().copied()))
}

const SOLIDS: [CellKind; 4] = [CellKind::Hexahedron, CellKind::Wedge, CellKind::Tetrahedron, CellKind::Tetrahedron10];

#[test]
fn sections_of_the_unit_cube_have_the_area_and_centroid_of_closed_forms() {
    let third = 1.0 / 3f64.sqrt();
    for kind in SOLIDS {
        let (cells, places) = block(kind, [3, 2, 4]);
        // Along an axis: a unit square. Diagonal of two axes: a rectangle √2 by 1. Through the middle across
        // the diagonal of the cube: a regular hexagon of side √2/2, area 3√3/4. Near a corner: the triangle
        // x + y + z = s, area s²√3/2, centroid s/3.
        for (normal, offset, area, centroid) in [
            ([0.0, 0.0, 1.0], 0.3, 1.0, [0.5, 0.5, 0.3]),
            ([1.0, -1.0, 0.0], 0.0, 2f64.sqrt(), [0.5; 3]),
            ([1.0, 1.0, 1.0], 1.5 * third, 0.75 * 3f64.sqrt(), [0.5; 3]),
            ([1.0, 1.0, 1.0], 0.4 * third, 0.08 * 3f64.sqrt(), [0.4 / 3.0; 3]),
            ([-1.0, -1.0, -1.0], -0.4 * third, 0.08 * 3f64.sqrt(), [0.4 / 3.0; 3]),
        ] {
            let section = section(&cells, &places, normal, offset);
            let (middle, whole, worst) = measured(&section, &places);
            assert!((whole - area).abs() < 1e-12, "{kind:?} {normal:?}: area {whole}, not {area}");
            assert!(middle.iter().zip(centroid).all(|(a, b)| (a - b).abs() < 1e-12), "{kind:?} {normal:?}: {middle:?}");
            assert!(worst < 1e-13, "a linear field is exact: {worst}");
        }
    }
}

#[test]
fn planes_through_nodes_cut_once_and_planes_beside_the_body_nothing() {
    for kind in SOLIDS {
        let (cells, places) = block(kind, [2, 2, 2]);
        let (_, mut shaken) = block(kind, [2, 2, 2]);
        for (place, sign) in shaken.iter_mut().zip([1.0, -1.0].into_iter().cycle()) {
            place[0] += 1e-16 * sign;
        }
        let (_, area, _) = measured(&section(&cells, &shaken, [-1.0, 0.0, 0.0], 0.0), &shaken);
        assert!((area - 1.0).abs() < 1e-12, "{kind:?} at its outside: {area}");
        for offset in [0.5, 1.0] {
            let (_, area, _) = measured(&section(&cells, &places, [1.0, 0.0, 0.0], offset), &places);
            assert!((area - 1.0).abs() < 1e-12, "{kind:?} at {offset}: {area}");
        }
        for offset in [-0.1, 0.0, 1.0001] {
            assert_eq!(section(&cells, &places, [1.0, 0.0, 0.0], offset), Section::default(), "{kind:?} at {offset}");
        }
    }
}

#[test]
fn distorted_hexahedra_close_without_gaps() {
    // The area enclosed by the outer sides of the polygons is that of all triangles: no gap, no overlap.
    let (cells, mut places) = block(CellKind::Hexahedron, [4, 4, 4]);
    let mut seed = 1u32;
    for place in &mut places {
        if place.iter().all(|x| (0.01..0.99).contains(x)) {
            for x in place {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                *x += 0.12 * (f64::from(seed >> 8) / f64::from(1u32 << 24) - 0.5);
            }
        }
    }
    for normal in [[0.0, 0.0, 1.0], [1.0, 2.0, 0.5]] {
        let plane = Plane::new(normal, 0.5 * normal.iter().sum::<f64>() / normal.iter().map(|n| n * n).sum::<f64>().sqrt() + 1e-3).unwrap();
        let section = Section::new(&cells, &[], &heights(&plane, places.iter().copied()));
        let mut sides: HashMap<[u32; 2], i32> = HashMap::new();
        for polygon in &section.polygons {
            let own = &section.corners[polygon.corners.clone()];
            for (k, &a) in own.iter().enumerate() {
                let b = own[(k + 1) % own.len()];
                *sides.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
            }
        }
        // What two cells share is walked in both directions; the rest lies on the outside of the cube.
        for ([a, b], balance) in sides {
            let outside = [a, b].iter().all(|&corner| {
                let point = section.points[corner as usize];
                (0..3).any(|k| [0.0, 1.0].iter().any(|end| point.nodes.iter().all(|&n| places[n as usize][k] == *end)))
            });
            assert!(balance == 0 || outside, "{normal:?}: a side inside belongs to one cell alone");
        }
    }
}

#[test]
fn parts_have_points_of_their_own_and_cells_that_have_gone_or_are_damaged_are_not_cut() {
    let (mut cells, mut places) = block(CellKind::Hexahedron, [2, 1, 1]);
    cells.parts = vec![0, 1];
    let whole = section(&cells, &places, [0.0, 0.0, 1.0], 0.5);
    assert_eq!((whole.polygons.len(), whole.points.len()), (2, 8));
    assert_eq!(whole.parts, [0, 0, 0, 0, 1, 1, 1, 1]);
    let plane = Plane::new([0.0, 0.0, 1.0], 0.5).unwrap();
    let rest = Section::new(&cells, &[0], &heights(&plane, places.iter().copied()));
    assert_eq!((rest.polygons.len(), rest.polygons[0].cell), (1, 1));
    places[cells.nodes[0] as usize] = [f64::NAN; 3];
    assert_eq!(section(&cells, &places, [0.0, 0.0, 1.0], 0.5).polygons.len(), 1);
    cells.nodes[9] = 9999;
    assert!(section(&cells, &places, [0.0, 0.0, 1.0], 0.5).polygons.is_empty());
}
