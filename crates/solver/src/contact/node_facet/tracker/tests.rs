//! Groups that are measured eight at a time, and continue as they were, against groups that are looked at one
//! by one.

use super::*;
use crate::bench::Random;
use crate::contact::Sweep;
use crate::contact::search;
use crate::mesh::cell::CellKind;

/// Nodes and hexahedra of a plate of n × n × 1 unit cells with its lower corner at a place; with a `step`,
/// one corner of it is missing.
fn plate(n: usize, corner: Vector, step: bool) -> (Vec<Vec<u32>>, Vec<Vector>) {
    let node = |i: usize, j: usize, k: usize| ((k * (n + 1) + j) * (n + 1) + i) as u32;
    let places = (0..2).flat_map(|k| (0..=n).flat_map(move |j| (0..=n).map(move |i| [i, j, k])));
    let positions = places.map(|at| [0, 1, 2].map(|d| corner[d] + at[d] as f64)).collect();
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).filter(|at| !(step && *at == (0, 0)));
    let square = |i: usize, j: usize, k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
    (cells.map(|(i, j)| [square(i, j, 0), square(i, j, 1)].concat()).collect(), positions)
}

/// What a motion is like.
#[derive(Clone, Copy, Debug)]
struct Motion {
    /// Where the upper plate begins beside the lower one.
    shift: [f64; 2],
    /// How far nodes are moved at random at the start, and in each step.
    crooked: f64,
    noise: f64,
    /// How the upper plate goes in a step: aside, and down and up again so deep.
    aside: f64,
    depth: f64,
    /// What both are turned by.
    turned: bool,
}

/// Steps of a motion: positions.
fn steps(motion: Motion, upper: &[Vector], lower: &[Vector], count: usize, random: &mut Random) -> Vec<Vec<Vector>> {
    let mut still: Vec<Vector> = [upper, lower].concat();
    still.iter_mut().flatten().for_each(|c| *c += motion.crooked * (random.unit() - 0.5));
    let turn = |[x, y, z]: Vector| if motion.turned { [0.6 * x - 0.8 * z, y, 0.8 * x + 0.6 * z] } else { [x, y, z] };
    let mut walk = vec![[0.0; 3]; still.len()];
    let mut at = |step: usize| {
        walk.iter_mut().flatten().for_each(|c| *c += motion.noise * (random.unit() - 0.5));
        let (time, aside) = (step as f64 / count as f64, motion.aside * step as f64);
        let down = motion.depth * (0.2 - (3.0 * std::f64::consts::TAU * time).sin());
        let moved = |k: usize| {
            let by = if k < upper.len() { [aside, 0.7 * aside, down] } else { [0.0; 3] };
            turn([0, 1, 2].map(|d| still[k][d] + walk[k][d] + by[d]))
        };
        (0..still.len()).map(moved).collect()
    };
    (0..count).map(&mut at).collect()
}

/// Notes of each touch what the formulation notes.
fn note(tracker: &mut Tracker, positions: &[Vector]) {
    for touch in tracker.touches().to_vec() {
        let rest = Placed { surface: tracker.target(touch.pass), positions }.rests_on(&touch.projection);
        let spring = SpringHistory { normal: touch.projection.normal, half: touch.projection.gap, ..SpringHistory::default() };
        let memory = *tracker.kept(&touch);
        *tracker.kept_mut(&touch) = ContactHistory { spring, facet: touch.projection.facet, rest, ..memory };
    }
}

/// Follows a motion in both ways and compares everything that is found and kept; how many touches there were,
/// and how many continued as they were. Both plates are bodies, or parts of one.
fn compare(motion: Motion, n: usize, count: usize, are_one: bool, random: &mut Random) -> [usize; 2] {
    let [sx, sy] = motion.shift;
    let (upper_cells, upper) = plate(n, [sx, sy, 1.0], true);
    let (lower_cells, lower) = plate(n, [0.0; 3], false);
    let first = upper.len() as u32;
    let lower_cells: Vec<Vec<u32>> = lower_cells.iter().map(|cell| cell.iter().map(|node| node + first).collect()).collect();
    let surface = |cells: &[Vec<u32>]| SpaceSurface::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap();
    let surfaces =
        if are_one { vec![surface(&[upper_cells, lower_cells].concat())] } else { vec![surface(&upper_cells), surface(&lower_cells)] };
    let passes = if are_one { &[(0, 0)][..] } else { &[(0, 1), (1, 0)] };
    let all = steps(motion, &upper, &lower, count, random);
    let bodies: Vec<u32> = (0..all[0].len()).map(|k| u32::from(k >= first as usize && !are_one)).collect();
    let make = |level: Option<Level>| {
        let search = (search::registry::<3>()[0].make)();
        Tracker { level, ..Tracker::new(surfaces.clone(), passes, &bodies, search, &all[0]) }
    };
    let (mut one_by_one, mut in_lanes) = (make(None), Level::available().into_iter().map(|level| make(Some(level))).collect::<Vec<_>>());
    let (mut travel, mut sums) = (0.0, [0; 2]);
    for step in 0..count {
        let (old, new) = (&all[step.saturating_sub(1)], &all[step]);
        travel += old.iter().zip(new).map(|(a, b)| length(minus(*b, *a))).fold(0.0, f64::max);
        let sweep = Sweep { old, new, travel };
        let expected = one_by_one.track(sweep, 0.01).to_vec();
        note(&mut one_by_one, new);
        sums[0] += expected.len();
        for tracker in &mut in_lanes {
            assert_eq!(tracker.track(sweep, 0.01), expected, "{motion:?}, step {step}");
            note(tracker, new);
            for (pass, other) in tracker.passes.iter().zip(&one_by_one.passes) {
                assert!(pass.groups == other.groups && pass.clear == other.clear && pass.wakes == other.wakes, "{motion:?}, step {step}");
            }
        }
        sums[1] += in_lanes[0].task.stayed;
    }
    sums
}

#[test]
fn who_continues_as_it_was_is_where_it_would_be_found_alone() {
    let mut random = Random::new(11);
    let (mut all, mut most, mut own) = ([0; 2], [0; 2], [0; 2]);
    for round in 0..108 {
        let shift = [[0.0, 0.0], [0.3, 0.3], [0.41, 0.17], [0.5, 0.5]][round % 4];
        let (crooked, noise) = ([0.0, 1e-3, 0.1][round / 4 % 3], [1e-9, 1e-4, 0.02][round / 12 % 3]);
        let (aside, depth) = ([0.0, 0.02][round / 36 % 2], [0.002, 0.05][round % 2]);
        let motion = Motion { shift, crooked, noise, aside, depth, turned: round % 5 == 0 };
        let are_one = round >= 72;
        let sums = compare(motion, 4, 60, are_one, &mut random);
        let is_steady = noise < 1e-3 && depth < 0.01 && aside == 0.0;
        let of = if are_one {
            &mut own
        } else if is_steady {
            &mut most
        } else {
            &mut all
        };
        (of[0], of[1]) = (of[0] + sums[0], of[1] + sums[1]);
    }
    // Who slides and flies about changes more often.
    assert!(most[1] > most[0] / 2 && all[1] > all[0] / 10 && all[0] > 10_000, "{most:?} {all:?}");
    assert!(own[1] > own[0] / 4 && own[0] > 10_000, "{own:?}");
}

#[test]
fn who_goes_through_a_plate_to_another_one_that_looks_alike_has_gone_through() {
    // A small cube hovers over the lower one of two plates of one body, and goes through the upper one to
    // its upper side.
    let square = |at: u32| [at, at + 1, at + 2, at + 3];
    let cell = |at: u32| [square(at), square(at + 4)].concat();
    let block = |corner: Vector, size: Vector| {
        (0..8)
            .map(move |k| [(k ^ k >> 1) & 1, k >> 1 & 1, k >> 2].map(f64::from))
            .map(move |at| [0, 1, 2].map(|d| corner[d] + size[d] * at[d]))
    };
    let plates = block([0.0; 3], [1.0, 1.0, 0.1]).chain(block([0.0, 0.0, 0.3], [1.0, 1.0, 0.02]));
    let old: Vec<Vector> = block([0.3, 0.2, 0.105], [0.03, 0.03, 0.03]).chain(plates).collect();
    let mut new = old.clone();
    new[..8].iter_mut().for_each(|x| x[2] += 0.22);
    let surface = |cells: &[Vec<u32>]| SpaceSurface::outside(cells.iter().map(|cell| CellKind::Hexahedron.cell(cell))).unwrap();
    let surfaces = [surface(&[cell(0)]), surface(&[cell(8), cell(16)])];
    let bodies: Vec<u32> = (0..24).map(|node| u32::from(node >= 8)).collect();
    let found = [None, Some(Level::SCALAR), Some(Level::best())].map(|level| {
        let tracker = Tracker::new(surfaces.to_vec(), &[(0, 1)], &bodies, (search::registry::<3>()[0].make)(), &old);
        let mut tracker = Tracker { level, ..tracker };
        for travel in [0.0, 0.0] {
            let hovers = tracker.track(Sweep { old: &old, new: &old, travel }, 0.01);
            assert!(hovers.len() >= 4 && hovers.iter().all(|touch| touch.projection.gap > 0.0), "{hovers:?}");
            note(&mut tracker, &old);
        }
        tracker.track(Sweep { old: &old, new: &new, travel: 0.22 }, 0.01).to_vec()
    });
    assert!(found[0].iter().filter(|touch| touch.node < 4 && touch.projection.gap < 0.0).count() == 4, "{:?}", found[0]);
    assert_eq!(found[1], found[0]);
    assert_eq!(found[2], found[0]);
}
