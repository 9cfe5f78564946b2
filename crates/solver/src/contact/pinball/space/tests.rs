use super::geometry::balls_under;
use super::*;
use crate::contact::formulation::ContactSurface;
use crate::mesh::cell::Cell;
use crate::mesh::surface::{SpaceSurface, Surface};

/// A block of cells (m, elements) as hexahedra, or cut into two wedges or six tetrahedra each.
fn block(size: Vector, elements: [usize; 3], nodes: usize) -> (Vec<Vec<u32>>, Vec<Vector>) {
    let [nx, ny, nz] = elements;
    let number = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let places = (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k])));
    let positions = places.map(|at| [0, 1, 2].map(|d| size[d] * at[d] as f64 / elements[d] as f64)).collect();
    let mut cells = Vec::new();
    for cell in 0..nx * ny * nz {
        let (i, j, k) = (cell % nx, cell / nx % ny, cell / nx / ny);
        let corner = |c: [usize; 3]| number(i + c[0], j + c[1], k + c[2]);
        let hexahedron = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(corner);
        match nodes {
            8 => cells.push(hexahedron.to_vec()),
            6 => cells.extend([[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]].map(|wedge: [usize; 6]| wedge.map(|c| hexahedron[c]).to_vec())),
            _ => cells.extend(
                [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
                    .map(|tet| tet.map(|c| hexahedron[c]).to_vec()),
            ),
        }
    }
    (cells, positions)
}

fn balls_of((cells, positions): &(Vec<Vec<u32>>, Vec<Vector>)) -> (SpaceSurface, Vec<Ball>) {
    let cells = || cells.iter().filter_map(|nodes| Cell::of(3, nodes));
    let surface = Surface::<3>::outside(cells()).unwrap();
    let holds = |facet: &[u32; 4]| cells().find(|cell| facet.corners().iter().all(|node| cell.nodes.contains(node)));
    let (cells, stiffness) = (surface.facets.iter().map(holds).collect(), vec![1.0; surface.facets.len()]);
    let target = ContactSurface { target: surface.clone(), lids: Vec::new() };
    let balls = balls_under(&Side { surface: target, cells, stiffness, ..Side::default() }, positions);
    (surface, balls)
}

#[test]
fn cubes_have_one_ball_each_that_touches_the_surface_from_inside() {
    let body = block([4.0, 3.0, 3.0], [4, 3, 3], 8);
    let (_, balls) = balls_of(&body);
    // All but the two in the middle.
    assert_eq!(balls.len(), 34);
    for ball in &balls {
        let centre = ball.centre(&body.1);
        assert!((ball.radius - 0.5).abs() < 1e-15 && centre.iter().all(|x| (x.fract() - 0.5).abs() < 1e-14), "{ball:?}");
    }
}

#[test]
fn equal_elements_get_equal_balls_wherever_they_are() {
    // L/h = 1.5, a tie that round-off of the place could decide otherwise.
    let count = |z: f64| {
        let (cells, mut positions) = block([6.0, 6.0, 2.0], [4, 4, 2], 8);
        positions.iter_mut().for_each(|x| x[2] += z);
        balls_of(&(cells, positions)).1.len()
    };
    for z in [0.1, 0.5, 0.7, 1.0 / 3.0, 12.3] {
        assert_eq!(count(z), count(0.0), "{z}");
    }
}

#[test]
fn balls_of_every_element_touch_their_facets_and_stick_out_of_none() {
    for (size, elements) in [([3.0, 3.0, 3.0], [3, 3, 3]), ([6.0, 3.0, 1.0], [3, 3, 2]), ([2.0, 2.0, 6.0], [4, 3, 2])] {
        for nodes in [8, 6, 4] {
            let body = block(size, elements, nodes);
            let (surface, balls) = balls_of(&body);
            let placed = Placed { surface: &surface, positions: &body.1 };
            let room = |ball: &Ball| {
                let centre = ball.centre(&body.1);
                (0..surface.facets.len() as u32).filter_map(|facet| placed.distance(centre, facet)).fold(f64::INFINITY, f64::min)
            };
            for ball in &balls {
                let (sum, [x, y, z]) = (ball.shares.iter().sum::<f64>(), ball.centre(&body.1));
                assert!((sum - 1.0).abs() < 1e-14 && x > 0.0 && y > 0.0 && z > 0.0 && x < size[0] && y < size[1] && z < size[2]);
                assert!((room(ball) / ball.radius - 1.0).abs() < 1e-8, "{nodes} {size:?}: {ball:?} has {}", room(ball));
                assert!(ball.shares.iter().all(|&share| share >= 0.0));
            }
            // Every place on the surface has a ball of its element below it: a ball as large as the largest
            // comes no nearer than what the head of the geometry says, at rims less.
            let largest = balls.iter().map(|ball| ball.radius).fold(0.0, f64::max);
            let mut deepest = 0.0_f64;
            for k in 0..400 {
                let [u, v] = [(k % 20) as f64 + 0.5, (k / 20) as f64 + 0.5].map(|part| 0.2 + 0.6 * part / 20.0);
                let [x, y] = [u * size[0], v * size[1]];
                let top = balls.iter().filter_map(|ball| {
                    let ([cx, cy, cz], reach) = (ball.centre(&body.1), ball.radius + largest);
                    let square = reach * reach - (x - cx).powi(2) - (y - cy).powi(2);
                    (square >= 0.0).then(|| cz + square.sqrt() - largest)
                });
                let top = top.fold(f64::NEG_INFINITY, f64::max);
                assert!(top <= size[2] * (1.0 + 1e-9), "{nodes} {size:?}: {top}");
                deepest = deepest.max(size[2] - top);
            }
            println!("{nodes} {size:?}: {} balls, {:.3} of the diameter", balls.len(), 0.5 * deepest / largest);
            assert!(deepest < 2.0 * largest, "{nodes} {size:?}: {deepest} {largest}");
        }
    }
}

#[test]
fn slip_is_blind_to_rigid_motions_of_both_and_its_rows_keep_the_angular_momentum() {
    let (_, first) = block([1.0; 3], [1; 3], 8);
    let place = |k: usize, off: f64| {
        [0, 1, 2].map(|d| first[k][d] * (1.0 + 0.1 * (d as f64 + off)) + 0.07 * ((7 * k + 3 * d) % 5) as f64 + off * [0.3, 0.2, 1.1][d])
    };
    let positions: Vec<Vector> = (0..8).map(|k| place(k, 0.0)).chain((0..8).map(|k| place(k, 1.0))).collect();
    for count in [4, 6, 8] {
        let ball = |from: u32| {
            let mut ball = Ball { count, radius: 0.5 + 0.05 * f64::from(from), ..Ball::default() };
            (0..count).for_each(|k| (ball.nodes[k], ball.shares[k]) = (from + k as u32, 1.0 / count as f64));
            ball
        };
        let (one, other) = (ball(0), ball(8));
        let away = minus(one.centre(&positions), other.centre(&positions));
        let (distance, normal) = (length(away), away.map(|c| c / length(away)));
        let tangents = Dim::<3>::tangents(normal, &[0.0; 3]);
        let part = distance / (one.radius + other.radius);
        let arms = tangents.map(|tangent| cross(normal, tangent));
        let mut ends = [End::<3>::default(); 16];
        let mine = one.add_ends(&positions, 1.0, arms.map(|arm| arm.map(|c| part * one.radius * c)), &mut ends);
        let all = mine + other.add_ends(&positions, -1.0, arms.map(|arm| arm.map(|c| part * other.radius * c)), &mut ends[mine..]);
        for a in 0..2 {
            let row = |end: &End<3>| [0, 1, 2].map(|d| end.share * tangents[a][d] + end.turn[a][d]);
            let rate =
                |v: &dyn Fn(Vector) -> Vector| ends[..all].iter().map(|end| dot(row(end), v(positions[end.at as usize]))).sum::<f64>();
            for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
                assert!(rate(&|x| cross(axis, x)).abs() < 1e-13 && rate(&|_| axis).abs() < 1e-14, "{count}");
            }
            // It sees the one slide on the other.
            let slide: f64 = ends[..mine].iter().map(|end| dot(row(end), tangents[a])).sum();
            assert!((slide - 1.0).abs() < 1e-13);
        }
    }
}

#[test]
fn a_slip_turns_with_both_elements_whichever_is_the_first_and_however_their_nodes_are_numbered() {
    let (_, cube) = block([1.0, 0.8, 0.6], [1; 3], 8);
    let ball = |nodes: [u32; 8]| Ball { nodes, shares: [0.125; 8], count: 8, radius: 0.3, ..Ball::default() };
    let (one, other) = (ball([0, 1, 2, 3, 4, 5, 6, 7]), ball([8, 9, 10, 11, 12, 13, 14, 15]));
    let old: Vec<Vector> = cube.iter().copied().chain(cube.iter().map(|x| [x[0] + 0.2, x[1] - 0.1, x[2] + 0.6])).collect();
    // Rigid: about any axis and by up to half a turn, exactly.
    let (axis, slip) = ([0.48, 0.6, 0.64], [0.3, -0.7, 0.2]);
    for degrees in [1e-3, 1.0, 40.0, 120.0, 170.0_f64] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let rotated = |v: Vector| {
            let (across, along) = (cross(axis, v), (1.0 - cos) * dot(axis, v));
            [0, 1, 2].map(|d| cos * v[d] + sin * across[d] + along * axis[d])
        };
        let new: Vec<Vector> = old.iter().map(|x| rotated(*x)).map(|x| [x[0] + 3.0, x[1] - 1.0, x[2]]).collect();
        let found = turned_with([&one, &other], slip, Sweep::between(&old, &new));
        assert!(length(minus(found, rotated(slip))) < 1e-13 / (0.5 * (1.0 + cos)), "{degrees}: {found:?}");
    }
    // Elements that deform: the numbering of their nodes, and which is the first, is no matter.
    let bent = |k: usize, x: &Vector| [0, 1, 2].map(|d| x[d] + 0.1 * ((5 * k + 3 * d) % 7) as f64);
    let new: Vec<Vector> = old.iter().enumerate().map(|(k, x)| bent(k, x)).collect();
    let sweep = Sweep::between(&old, &new);
    let found = turned_with([&one, &other], slip, sweep);
    assert!((length(found) - length(slip)).abs() < 1e-15 && length(minus(found, slip)) > 0.01, "{found:?}");
    let numbered = ball([5, 3, 0, 6, 2, 7, 1, 4]);
    for pair in [[&other, &one], [&numbered, &other], [&other, &numbered]] {
        assert!(length(minus(turned_with(pair, slip, sweep), found)) < 1e-15);
    }
}
