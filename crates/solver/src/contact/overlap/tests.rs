//! Regions against closed forms, differences and turned copies of themselves.

use super::*;
use crate::contact::springs::Springs;
use crate::mesh::cell::Cell;
use crate::mesh::surface::SpaceSurface;
use crate::tensor::cross;
use crate::vector::minus;
use proptest::prelude::*;

/// A block of n × n × n hexahedra between two corners, or six tetrahedra in each.
pub(super) fn block(low: Vector, high: Vector, counts: [usize; 3], is_tet: bool, nodes: &mut Vec<Vector>, cells: &mut Vec<Vec<u32>>) {
    let first = nodes.len() as u32;
    let [a, b, c] = counts;
    for k in 0..=c {
        for j in 0..=b {
            for i in 0..=a {
                let part = [i as f64 / a as f64, j as f64 / b as f64, k as f64 / c as f64];
                nodes.push([0, 1, 2].map(|d| low[d] + part[d] * (high[d] - low[d])));
            }
        }
    }
    let at = |i: usize, j: usize, k: usize| first + (i + (a + 1) * (j + (b + 1) * k)) as u32;
    for (i, j, k) in (0..c).flat_map(|k| (0..b).flat_map(move |j| (0..a).map(move |i| (i, j, k)))) {
        let x = [
            at(i, j, k),
            at(i + 1, j, k),
            at(i + 1, j + 1, k),
            at(i, j + 1, k),
            at(i, j, k + 1),
            at(i + 1, j, k + 1),
            at(i + 1, j + 1, k + 1),
            at(i, j + 1, k + 1),
        ];
        if is_tet {
            // Around the diagonal from 0 to 6.
            for [p, q] in [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]] {
                cells.push(vec![x[0], x[p], x[q], x[6]]);
            }
        } else {
            cells.push(x.to_vec());
        }
    }
}

/// Two blocks: the first from the origin to `size`, the second from `low` to `high`, of so many elements.
fn two(size: Vector, [low, high]: [Vector; 2], counts: [[usize; 3]; 2], are_tets: [bool; 2]) -> (OverlapCheck, Vec<Vector>) {
    let (mut nodes, mut cells) = (Vec::new(), Vec::new());
    block([0.0; 3], size, counts[0], are_tets[0], &mut nodes, &mut cells);
    let second = nodes.len() as u32;
    block(low, high, counts[1], are_tets[1], &mut nodes, &mut cells);
    let surface = SpaceSurface::outside(cells.iter().filter_map(|nodes| Cell::of(3, nodes))).unwrap();
    let body_of = |node: u32| u32::from(node >= second);
    let bodies = Bodies { outside: &surface, is_mirror: &|_| false, body_of: &body_of, side_of: None };
    (OverlapCheck::new(&bodies, &nodes, false), nodes)
}

pub(super) fn look(overlap_check: &mut OverlapCheck, nodes: &[Vector]) {
    overlap_check.look(Sweep::between(nodes, nodes), 0.0);
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-12 * scale
}

#[test]
fn a_corner_an_edge_and_a_face_in_a_block_have_their_volumes_areas_and_depths() {
    for are_tets in [[false, false], [true, false], [true, true]] {
        for counts in [[[1; 3]; 2], [[3, 2, 4], [2, 3, 1]]] {
            // Box, overlap of it with the unit cube, N of the cube's surface inside.
            let cases = [
                ([[0.9, 0.85, 0.8], [2.0, 2.1, 2.2]], [0.1, 0.15, 0.2], [0.03, 0.02, 0.015], 0.1),
                ([[0.9, 0.85, -0.3], [2.0, 2.1, 1.3]], [0.1, 0.15, 1.0], [0.15, 0.1, 0.0], 0.1),
                ([[0.9, -0.2, -0.3], [2.0, 1.1, 1.3]], [0.1, 1.0, 1.0], [1.0, 0.0, 0.0], 0.1),
                ([[0.9, 0.2, 0.3], [2.0, 0.7, 0.6]], [0.1, 0.5, 0.3], [0.15, 0.0, 0.0], 0.1),
            ];
            for ([low, high], sizes, area, depth) in cases {
                let (mut overlap_check, nodes) = two([1.0; 3], [low, high], counts, are_tets);
                look(&mut overlap_check, &nodes);
                let found: Vec<&Region> = overlap_check.regions.iter().collect();
                assert_eq!(found.len(), 1, "{low:?} {are_tets:?} {counts:?}");
                let region = found[0];
                assert!(!region.is_open);
                assert!(close(region.volume, sizes[0] * sizes[1] * sizes[2], 1.0), "{low:?} {}", region.volume);
                assert!((0..3).all(|d| close(region.area[d], area[d], 1.0)), "{low:?} {:?}", region.area);
                // Vertices of one element alone need not be where it is deepest.
                assert!(overlap_check.findings.now.depth <= depth * (1.0 + 1e-12), "{:?}", overlap_check.findings.now);
                if low[1] > -0.1 {
                    assert!(
                        close(overlap_check.findings.now.depth, depth, 1.0),
                        "{low:?} {are_tets:?} {counts:?} {:?}",
                        overlap_check.findings.now
                    );
                }
            }
        }
    }
}

#[test]
fn a_bar_through_a_bar_is_a_region_that_turns_round_and_what_only_touches_is_none() {
    let (mut overlap_check, nodes) = two([1.0; 3], [[-1.0, 0.3, 0.7], [2.0, 0.6, 0.8]], [[2; 3], [4, 1, 1]], [false; 2]);
    look(&mut overlap_check, &nodes);
    let region = &overlap_check.regions[0];
    assert!(close(region.volume, 0.03, 1.0) && length(region.area) < 1e-12, "{region:?}");
    assert!(
        (overlap_check.findings.now.depth - 0.3).abs() < 0.11 && close(overlap_check.findings.now.thickness, 0.1, 1.0),
        "{:?}",
        overlap_check.findings.now
    );
    for low in [[1.0, 0.0, 0.0], [1.0, 0.5, 0.0], [1.0, 1.0, 1.0], [0.0, 0.0, 1.0]] {
        let (mut overlap_check, nodes) = two([1.0; 3], [low, low.map(|c| c + 1.0)], [[2; 3], [2; 3]], [false; 2]);
        look(&mut overlap_check, &nodes);
        // Ties are broken one way or the other: nothing, or something without a volume.
        assert!(overlap_check.regions.iter().all(|region| region.volume.abs() < 1e-15), "{low:?}");
        assert!(overlap_check.findings.now.depth < 1e-15);
    }
}

#[test]
fn a_place_is_in_a_block_or_beside_it_as_its_coordinates_say() {
    let (overlap_check, _) = two([1.0; 3], [[2.0; 3], [3.0; 3]], [[2, 3, 1], [1; 3]], [true, false]);
    let at = |k: u32| f64::from(k) / 8.0 - 0.25 + 1e-3;
    let mut count = [0; 2];
    for k in 0..13 * 13 * 13 {
        let place = [k % 13, k / 13 % 13, k / 169].map(at);
        let is_in = place.iter().all(|c| (0.0..1.0).contains(c));
        // What lies in it is never missed.
        assert!(!is_in || overlap_check.may_be_in(0, place), "{place:?}");
        count[0] += usize::from(!is_in);
        count[1] += usize::from(!is_in && overlap_check.may_be_in(0, place));
    }
    // A ray through an edge may say that what is beside it lies in it.
    assert!(count[1] * 50 < count[0], "{count:?}");
}

#[test]
fn sides_that_are_flush_leave_no_hole_in_a_contour() {
    for counts in [[[1; 3]; 2], [[2; 3]; 2], [[3, 2, 4], [2, 3, 1]]] {
        for are_tets in [[false; 2], [true, false], [true; 2]] {
            for (low, high) in
                [([0.9, 0.0, 0.0], [2.0, 1.0, 1.0]), ([0.9, 0.25, 0.0], [2.0, 0.75, 1.0]), ([0.5, 0.5, 0.0], [2.0, 2.0, 0.5])]
            {
                let (mut overlap_check, nodes) = two([1.0; 3], [low, high], counts, are_tets);
                look(&mut overlap_check, &nodes);
                let expected = (1.0 - low[0]) * (high[1].min(1.0) - low[1]) * (high[2].min(1.0) - low[2]);
                let found: f64 = overlap_check.regions.iter().map(|region| region.volume).sum();
                assert!((found - expected).abs() < 1e-12, "{low:?} {counts:?} {are_tets:?}: {found} {expected}");
                assert!(overlap_check.regions.iter().all(|region| !region.is_open), "{low:?} {counts:?} {are_tets:?}");
                assert!(overlap_check.findings.now.depth < 1.0 - low[0] + 1e-12, "{:?}", overlap_check.findings.now);
            }
        }
    }
}

#[test]
fn thickness_is_that_of_the_body_and_follows_it() {
    let (overlap_check, mut nodes) = two([1.0, 2.0, 0.1], [[5.0; 3], [6.0; 3]], [[3, 3, 1], [2; 3]], [false, true]);
    let mut overlap_check = overlap_check;
    assert!(close(overlap_check.least, 0.1, 1.0));
    nodes.iter_mut().for_each(|x| x[2] *= 0.5);
    look(&mut overlap_check, &nodes);
    assert!(close(overlap_check.thickness.least(&overlap_check.skin), 0.05, 1.0));
}

fn turn(v: Vector, by: Vector) -> Vector {
    spin::turned(v, by)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Blocks of any kind, turned and shifted so that they cut each other, with nodes that are off: contours
    /// close, N_A = −N_B, and ∂V/∂x is the difference of volumes.
    #[test]
    fn gradients_are_differences_of_volumes(
        by in prop::array::uniform3(-2.0..2.0_f64), shift in prop::array::uniform3(0.2..0.9_f64), noise in 0.0..0.08_f64,
        seed in 0..1000_u32, are_tets in prop::array::uniform2(any::<bool>()), counts in prop::array::uniform2(prop::array::uniform3(1..4_usize)),
    ) {
        let (mut overlap_check, mut nodes) = two([1.0; 3], [[0.0; 3], [1.0, 1.2, 0.7]], counts, are_tets);
        let second = counts[0].iter().map(|count| count + 1).product::<usize>();
        let mut state = seed.wrapping_mul(2_654_435_761) | 1;
        let mut random = || { state ^= state << 13; state ^= state >> 17; state ^= state << 5; f64::from(state) / f64::from(u32::MAX) - 0.5 };
        for (number, x) in nodes.iter_mut().enumerate() {
            if number >= second {
                let turned = turn(*x, by);
                *x = [0, 1, 2].map(|d| turned[d] + shift[d]);
            }
            *x = x.map(|c| c + noise * random());
        }
        look(&mut overlap_check, &nodes);
        prop_assert!(overlap_check.regions.iter().all(|region| !region.is_open && (region.is_closed || region.size < 1e-6)));
        let volume = |overlap_check: &OverlapCheck| overlap_check.regions.iter().map(|region| region.volume).sum::<f64>();
        let whole = volume(&overlap_check);
        prop_assert!(whole >= -1e-14);
        let mut rows = vec![[0.0; 3]; nodes.len()];
        for region in overlap_check.regions.iter() {
            let (mut sum, mut one) = ([0.0; 3], [0.0; 3]);
            for &(vertex, row) in &region.gradient {
                let node = overlap_check.skin.nodes[vertex as usize] as usize;
                (0..3).for_each(|d| {
                    rows[node][d] += row[d];
                    sum[d] += row[d];
                    if node < second { one[d] += row[d] }
                });
            }
            // N_A + N_B = 0, and the rows of A add up to N_A.
            prop_assert!(length(sum) < 1e-13 && length(minus(one, region.area)) < 1e-13, "{sum:?} {one:?}");
        }
        let h = 1e-6;
        let node = (seed as usize * 7) % nodes.len();
        for d in 0..3 {
            let mut at = [0.0; 2];
            for (value, step) in at.iter_mut().zip([h, -h]) {
                let mut moved = nodes.clone();
                moved[node][d] += step;
                let mut overlap_check = two([1.0; 3], [[0.0; 3], [1.0, 1.2, 0.7]], counts, are_tets).0;
                look(&mut overlap_check, &moved);
                *value = volume(&overlap_check);
            }
            let difference = (at[0] - at[1]) / (2.0 * h);
            prop_assert!((difference - rows[node][d]).abs() < 1e-8 + 3e-6 * rows[node][d].abs().max(0.01), "{node} {d}: {difference} {:?}", rows[node]);
        }
    }

    /// Bodies of any form, those that overlap themselves included: the springs of volume springs have no sum
    /// and no moment, also where they continue with their nodes.
    #[test]
    fn nets_keep_both_momenta_whatever_bodies_are_like(
        shift in prop::array::uniform3(0.2..0.9_f64), noise in 0.0..1.5_f64, seed in 0..1000_u32, are_tets in prop::array::uniform2(any::<bool>()),
        steps in 0..4_u32, by in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let (mut overlap_check, mut nodes) = two([1.0; 3], [[0.0; 3], [1.0, 1.2, 0.7]], [[3, 2, 2], [2; 3]], are_tets);
        (0..nodes.len() as u32).for_each(|node| overlap_check.set_modulus(node, 1.0, 0.0));
        let mut state = seed.wrapping_mul(2_654_435_761) | 1;
        let mut random = || { state ^= state << 13; state ^= state >> 17; state ^= state << 5; f64::from(state) / f64::from(u32::MAX) - 0.5 };
        for (number, x) in nodes.iter_mut().enumerate() {
            let by = if number >= 36 { shift } else { [0.0; 3] };
            *x = [0, 1, 2].map(|d| x[d] + by[d] + noise * random());
        }
        let (mut finds, mut travel) = (0, 0.0);
        overlap_check.look(Sweep { old: &nodes, new: &nodes, travel }, 0.0);
        for _ in 0..steps {
            let old = nodes.clone();
            for x in &mut nodes {
                let turned = turn(*x, by.map(|c| 1e-3 * c));
                *x = turned.map(|c| c + 2e-3 * random());
            }
            travel += 1e-4;
            overlap_check.look(Sweep { old: &old, new: &nodes, travel }, 0.0);
            finds += u32::from(overlap_check.found_at == travel);
        }
        // Only volume springs that can't continue were found again.
        prop_assert!(noise > 0.1 || finds == 0, "{finds} of {steps}");
        let mut springs = Springs::default();
        overlap_check.push_nets(&mut springs, |_| ());
        for spring in &springs.list {
            let ends: Vec<_> = springs.ends(spring).collect();
            let (mut sum, mut moment, mut size) = ([0.0; 3], [0.0; 3], 0.0);
            for end in &ends {
                let turned = cross(nodes[end.at as usize], end.lean());
                (0..3).for_each(|d| {
                    sum[d] += end.lean()[d];
                    moment[d] += turned[d];
                });
                size += length(end.lean());
            }
            prop_assert!(length(sum) < 1e-8 * size && length(moment) < 1e-8 * size, "{sum:?} {moment:?} {size}");
        }
    }
}

#[test]
fn a_net_that_continues_with_its_nodes_is_as_deep_in_the_end_as_the_volume_grew() {
    // A block turns while it goes into another one and out again.
    let (mut overlap_check, nodes) = two([1.0; 3], [[0.2, 0.1, 0.93], [0.8, 0.9, 1.9]], [[2; 3], [3, 2, 2]], [false; 2]);
    (0..nodes.len() as u32).for_each(|node| overlap_check.set_modulus(node, 1.0, 0.0));
    let place = |step: f64| {
        let mut moved = nodes.clone();
        for x in &mut moved[27..] {
            let turned = turn(minus(*x, [0.5, 0.5, 0.9]), [0.1, 0.2, 1.0].map(|c| 2e-3 * step * c));
            *x = [turned[0] + 0.5, turned[1] + 0.5, turned[2] + 0.9 - 0.05 * (0.03 * step).sin()];
        }
        moved
    };
    let (mut cast, mut followed, mut travel, mut old) = (None, 0, 0.0, place(0.0));
    for step in 0..100 {
        let new = place(f64::from(step));
        overlap_check.look(Sweep { old: &old, new: &new, travel }, 0.0);
        let is_found = overlap_check.found_at == travel;
        let [known] = &overlap_check.known[..] else { panic!("{:?}", overlap_check.known) };
        assert!(known.area > 0.0 && overlap_check.volume_springs.len() == 1, "{step}");
        let (area, begin) = *cast.get_or_insert((known.area, known.volume));
        let mut fresh = two([1.0; 3], [[0.2, 0.1, 0.93], [0.8, 0.9, 1.9]], [[2; 3], [3, 2, 2]], [false; 2]).0;
        look(&mut fresh, &new);
        let expected = fresh.regions[0].volume - begin;
        let error = (known.depth * area - expected).abs();
        // In between what the volume bends is missing.
        assert!(error < if is_found { 1e-14 } else { 2e-4 * begin }, "{step} {is_found}: {} {expected}", known.depth * area);
        followed += u32::from(!is_found);
        (old, travel) = (new, travel + 1e-3);
    }
    assert!(followed > 60, "{followed}");
}

#[test]
fn pairs_that_are_kept_and_sleep_are_those_of_a_search_anew_in_each_look() {
    // Two blocks of facets that shake, one of them on a way through the other; all nodes within the travel
    // that is reported.
    let (mut overlap_check, start) = two([1.0; 3], [[0.2, 0.3, 1.02], [0.7, 0.9, 1.6]], [[3, 4, 2], [2, 2, 3]], [false, true]);
    let first = 4 * 5 * 3;
    let mut state = 7_u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
    };
    let (mut nodes, mut travel, mut total) = (start, 0.0, 0);
    let mut near = Near::default();
    for step in 0..400 {
        let way = if step % 50 == 49 { 0.2 } else { 0.01 };
        let down = if step < 200 { -0.4 * way } else { 0.4 * way };
        for (number, x) in nodes.iter_mut().enumerate() {
            let shift = [random(), random(), random()].map(|r| 0.5 * way * r);
            (0..3).for_each(|d| x[d] += shift[d] + if number >= first && d == 2 { down } else { 0.0 });
        }
        travel += way;
        overlap_check.skin.place(&nodes);
        let (mut kept, mut anew) = (Vec::new(), Vec::new());
        piercing::find(&overlap_check.skin, &mut overlap_check.tree, &mut near, travel, &mut kept);
        // Nearest triangles in boxes that have grown, and in new ones.
        let places: Vec<Vector> = (0..8).map(|_| [random() + 0.5, random() + 0.5, random() + 0.8]).collect();
        let nearest = |tree: &Tree, guess: u32| {
            let of = |x: &Vector| tree.nearest(&overlap_check.skin, 0, *x, (f64::INFINITY, guess), |_| true);
            places.iter().map(of).collect::<Vec<_>>()
        };
        let before = nearest(&overlap_check.tree, NONE);
        let guess = ((random() + 0.5) * overlap_check.skin.triangles.len() as f64) as u32;
        assert_eq!(before, nearest(&overlap_check.tree, guess), "{step}: guessed {guess}");
        let mut fresh = Tree::new(&overlap_check.skin);
        piercing::find(&overlap_check.skin, &mut fresh, &mut Near::default(), f64::INFINITY, &mut anew);
        for list in [&mut kept, &mut anew] {
            list.sort_by_key(|piercing| (piercing.edge, piercing.triangle));
        }
        assert_eq!(kept, anew, "{step}");
        assert_eq!(before, nearest(&fresh, NONE), "{step}");
        total += kept.len();
    }
    assert!(total > 1000, "{total}");
}

/// The surface of some elements that are one body, and its overlap check.
pub(super) fn one(nodes: &[Vector], cells: &[Vec<u32>]) -> OverlapCheck {
    let surface = SpaceSurface::outside(cells.iter().filter_map(|nodes| Cell::of(3, nodes))).unwrap();
    let bodies = Bodies { outside: &surface, is_mirror: &|_| false, body_of: &|_| 0, side_of: None };
    OverlapCheck::new(&bodies, nodes, false)
}

#[test]
fn a_body_without_an_opposite_skin_is_as_thick_as_its_inscribed_ball() {
    // A regular tetrahedron of the edge a has an inscribed ball of the radius a / sqrt(24); a face looks at
    // no other one.
    let nodes = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let edge = 8.0_f64.sqrt();
    let expected = 2.0 * edge / 24.0_f64.sqrt();
    for (angle, shift) in [(0.0_f64, 0.0), (0.7, 3.0), (2.0, -1e3)] {
        let (sin, cos) = angle.sin_cos();
        let nodes = nodes.map(|[x, y, z]| [cos * x - sin * y + shift, sin * x + cos * y, z - shift]);
        let found = one(&nodes, &[vec![0, 2, 1, 3]]).thickness_at(&[0, 1, 2, 3]);
        assert!(found.iter().all(|thickness| (thickness - expected).abs() < 1e-10 * expected), "{found:?} {expected}");
    }
    // A block has an opposite skin everywhere, however long it is.
    let (mut nodes, mut cells) = (Vec::new(), Vec::new());
    block([0.0; 3], [9.0, 2.0, 1.0], [3, 2, 1], false, &mut nodes, &mut cells);
    let found = one(&nodes, &cells).thickness_at(&(0..nodes.len() as u32).collect::<Vec<_>>());
    assert!(found.iter().all(|thickness| [1.0, 2.0, 9.0].contains(thickness)), "{found:?}");
}

#[test]
fn a_region_that_slides_around_an_edge_keeps_its_depth_and_one_that_goes_through_does_not() {
    // A long bar, and a small block at its upper side that goes around the edge to its flank, 0.16 deep on
    // its way.
    let at = |x: f64, z: f64| [[x - 0.4, 0.8, z - 0.4], [x + 0.4, 1.6, z + 0.9]];
    let begin = at(0.5, 1.24);
    let (mut overlap_check, nodes) = two([1.0, 3.0, 1.0], begin, [[2, 6, 2], [2, 2, 2]], [false; 2]);
    let first = nodes.len() - 27;
    let move_to = |overlap_check: &mut OverlapCheck, x: f64, z: f64| {
        let mut moved = nodes.clone();
        moved[first..].iter_mut().for_each(|node| (node[0], node[2]) = (node[0] + x - 0.5, node[2] + z - 1.24));
        look(overlap_check, &moved);
        overlap_check.findings.now.ratio()
    };
    let way: Vec<[f64; 2]> =
        (0..=20).map(|k| [0.5 + 0.037 * f64::from(k), 1.24]).chain((0..=40).map(|k| [1.24, 1.24 - 0.02 * f64::from(k)])).collect();
    let deepest = way.iter().map(|&[x, z]| move_to(&mut overlap_check, x, z)).fold(0.0, f64::max);
    assert!((0.19..0.21).contains(&deepest), "{deepest}");
    // From the upper side down through the bar it is ever deeper from there, and beyond the thickness it is
    // reported.
    let (mut overlap_check, _) = two([1.0, 3.0, 1.0], begin, [[2, 6, 2], [2, 2, 2]], [false; 2]);
    for k in 0..=66 {
        move_to(&mut overlap_check, 0.5, 1.24 - 0.02 * f64::from(k));
    }
    assert!(
        overlap_check.findings.through.is_some_and(|through| through.depth > 0.8),
        "{:?} {:?}",
        overlap_check.findings.now,
        overlap_check.known
    );
}
