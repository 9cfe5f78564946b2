//! Relocation of random meshes: what stays, and what gets better.

use super::super::Cell;
use super::super::tests::{Kinds, Made};
use super::super::vector::cross;
use super::*;
use crate::shared::random::Random;

/// No marks.
fn free(mesh: Mesh<'_>) -> (Vec<bool>, Vec<Vec<u32>>, Vec<Vec<u32>>) {
    let count = mesh.positions.len();
    (vec![false; count], vec![Vec::new(); count], vec![Vec::new(); faces(mesh).len()])
}

fn moved(mesh: Mesh<'_>) -> Result<Relocated, Failure> {
    let (fixed, nodes, faces) = free(mesh);
    relocated(mesh, &Marks { fixed: &fixed, nodes: &nodes, faces: &faces }, 1.02)
}

fn volume_of(mesh: Mesh<'_>) -> f64 {
    volume::volume(&faces(mesh), mesh.positions, [0.0; 3])
}

fn at(shares: &[(u32, f64)], positions: &[Point]) -> Point {
    shares.iter().fold([0.0; 3], |sum, &(node, share)| [0, 1, 2].map(|k| sum[k] + share * positions[node as usize][k]))
}

/// A block with round sides and a bulge.
fn barrel(n: [usize; 3], part: f64, kinds: Kinds, random: &mut Random) -> Made {
    let mut made = Made::cube(n, part, kinds, random);
    for x in &mut made.positions {
        let [a, b, z] = [2.0 * x[0] - 1.0, 2.0 * x[1] - 1.0, x[2]];
        let [u, v] = [a * (1.0 - 0.15 * b * b), b * (1.0 - 0.15 * a * a)];
        let bulge = 1.0 + 0.6 * z * (1.0 - z);
        *x = [bulge * u, bulge * v, z + 0.1 * u * u];
    }
    made
}

#[test]
fn cubes_of_all_kinds_get_better_and_keep_their_sides() {
    let mut random = Random::new(11);
    for kinds in [Kinds::Hexahedra, Kinds::Wedges, Kinds::Tetrahedra, Kinds::All] {
        for part in [0.2, 0.28] {
            let made = Made::cube([5, 4, 4], part, kinds, &mut random);
            let before = quality(made.mesh());
            if !(before > 0.0) {
                continue;
            }
            let found = moved(made.mesh()).unwrap();
            println!("{kinds:?} {part}: {before:.3} to {:.3}", found.quality);
            let new = Mesh { positions: &found.positions, cells: &made.cells };
            assert!(found.quality >= 1.02 * before && (quality(new) - found.quality).abs() < 1e-15);
            assert!(found.quality > if kinds == Kinds::Hexahedra { 0.9 } else { 0.3 }, "{}", found.quality);
            assert!((volume_of(new) / volume_of(made.mesh()) - 1.0).abs() < 1e-14);
            for ((old, new), shares) in made.positions.iter().zip(&found.positions).zip(&found.shares) {
                // Sides are kept to the last digit, edges and corners with them.
                for k in 0..3 {
                    assert!(![0.0, 1.0].contains(&old[k]) || new[k] == old[k], "{old:?} to {new:?}");
                    assert!((at(shares, &made.positions)[k] - new[k]).abs() < 1e-12);
                }
                assert!((shares.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-13);
            }
        }
    }
}

#[test]
fn curved_bodies_keep_their_volume_and_nearly_their_outline() {
    let mut random = Random::new(12);
    for kinds in [Kinds::Hexahedra, Kinds::Wedges, Kinds::Tetrahedra] {
        for part in [0.0, 0.15, 0.25] {
            let made = barrel([6, 6, 6], part, kinds, &mut random);
            let before = quality(made.mesh());
            if !(before > 0.0) {
                continue;
            }
            let found = match moved(made.mesh()) {
                Ok(found) => found,
                Err(failure) => {
                    println!("{kinds:?} {part}: {failure}");
                    assert!(part == 0.0);
                    continue;
                }
            };
            let new = Mesh { positions: &found.positions, cells: &made.cells };
            let off = volume_of(new) / volume_of(made.mesh()) - 1.0;
            let way = |node: usize| {
                let moved = minus(at(&found.shares[node], &made.positions), found.positions[node]);
                dot(moved, moved).sqrt()
            };
            let most = (0..found.positions.len()).map(way).fold(0.0, f64::max);
            let slid =
                found.positions.iter().zip(&made.positions).map(|(a, b)| dot(minus(*a, *b), minus(*a, *b)).sqrt()).fold(0.0, f64::max);
            println!("{kinds:?} {part}: {before:.3} to {:.3}, volume {off:.1e}, off the outline {most:.1e}, way {slid:.1e}", found.quality);
            // The outline turns by less than 30 degrees where a node slides: it is corrected by less than
            // half of its way.
            assert!(off.abs() < 2e-14 && most < 0.5 * slid && found.quality > before);
        }
    }
}

#[test]
fn axes_in_another_order_give_the_same() {
    let mut random = Random::new(13);
    for kinds in [Kinds::Hexahedra, Kinds::Tetrahedra] {
        let made = barrel([4, 4, 5], 0.2, kinds, &mut random);
        let turned: Vec<Point> = made.positions.iter().map(|x| [x[1], x[2], x[0]]).collect();
        let quarter: Vec<Point> = made.positions.iter().map(|x| [-x[1], x[0], x[2]]).collect();
        let [first, second, third] =
            [&made.positions, &turned, &quarter].map(|positions| moved(Mesh { positions, cells: &made.cells }).unwrap().positions);
        for ((x, y), z) in first.iter().zip(&second).zip(&third) {
            let off = [x[1] - y[0], x[2] - y[1], x[0] - y[2], x[1] + z[0], x[0] - z[1], x[2] - z[2]];
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{off:?}");
        }
    }
}

#[test]
fn what_is_marked_stays_or_slides_along_its_line() {
    let mut random = Random::new(14);
    let made = Made::cube([4, 4, 4], 0.3, Kinds::Hexahedra, &mut random);
    let (mut fixed, mut nodes, mut marks) = free(made.mesh());
    let (top, middle) = (124, 62);
    fixed[middle] = true;
    // Half of the faces at the end x = 1 have a name, and all nodes at y = 0 another one.
    let half: Vec<[u32; 4]> =
        faces(made.mesh()).into_iter().filter(|face| face.iter().all(|node| node % 5 == 4 && node / 25 < 3)).collect();
    assert_eq!(half.len(), 8);
    let all = faces(made.mesh());
    (0..all.len()).filter(|&k| half.contains(&all[k])).for_each(|k| marks[k].push(3));
    (0..125).filter(|node| node / 5 % 5 == 0).for_each(|node| nodes[node].push(7));
    let found = relocated(made.mesh(), &Marks { fixed: &fixed, nodes: &nodes, faces: &marks }, 1.02).unwrap();
    assert_eq!([found.positions[middle], found.positions[top]], [made.positions[middle], made.positions[top]]);
    // Nodes between both halves of the end move between their neighbours there only.
    for node in [54, 59, 64, 69, 74] {
        let shares = &found.shares[node];
        assert!(shares.iter().all(|(node, _)| (54..75).contains(node) && node % 5 == 4), "{shares:?}");
    }
    for node in (0..125).filter(|node| node / 5 % 5 == 0) {
        assert!(found.shares[node].iter().all(|(node, _)| node / 5 % 5 == 0));
    }
}

#[test]
fn better_meshes_only_are_given_and_inputs_are_looked_at() {
    let mut random = Random::new(15);
    let made = Made::cube([3, 3, 3], 0.0, Kinds::Hexahedra, &mut random);
    assert!(matches!(moved(made.mesh()), Err(Failure::NotBetter { before, .. }) if (before - 1.0).abs() < 1e-14));
    let mut bad = made.clone();
    bad.positions[21] = [1.5, 0.4, 0.4];
    assert!(matches!(moved(bad.mesh()), Err(Failure::Inverted { .. })));
    bad.positions[21] = [f64::NAN; 3];
    assert!(matches!(moved(bad.mesh()), Err(Failure::Input(_))));
    let tens = Made::cube([2, 2, 2], 0.1, Kinds::Tens, &mut random);
    assert!(matches!(moved(tens.mesh()), Err(Failure::Input(_))));
    let mut more = made.positions.clone();
    more.push([0.0; 3]);
    assert!(matches!(moved(Mesh { positions: &more, cells: &made.cells }), Err(Failure::Input(_))));
    let cell = Cell::new(Kind::Tetrahedron, &[0, 1, 2, 99]).unwrap();
    assert!(matches!(moved(Mesh { positions: &made.positions, cells: &[cell] }), Err(Failure::Input(_))));
    assert!(cross([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]) == [0.0, 0.0, 1.0]);
}
