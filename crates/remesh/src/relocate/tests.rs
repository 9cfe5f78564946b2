//! Relocation of many meshes.

use super::*;
use crate::mesher::tests::{Random, circle, polygon, star, with_hole};
use crate::mesher::{quadrilaterals, triangles};
use crate::plane::distance;
use crate::transfer::{NewNodes, OldNodes, Order, Points, Supermesh, Values, nodes, points};
use std::collections::BTreeMap;

/// A mesh with its outline.
#[derive(Clone)]
struct Made {
    positions: Vec<Point>,
    cells: Vec<Cell>,
    loops: Vec<Vec<u32>>,
    fixed: Vec<Vec<bool>>,
}

impl Made {
    fn new(positions: Vec<Point>, cells: Vec<Cell>) -> Self {
        let all: Vec<[u32; 2]> = cells.iter().flat_map(|cell| edges(corners(cell))).collect();
        let mut next: BTreeMap<u32, u32> = all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).map(|&[a, b]| (a, b)).collect();
        let mut loops = Vec::new();
        while let Some((&first, _)) = next.first_key_value() {
            let (mut chain, mut at) = (Vec::new(), first);
            while let Some(following) = next.remove(&at) {
                chain.push(at);
                at = following;
            }
            loops.push(chain);
        }
        let fixed = loops.iter().map(|nodes| vec![false; nodes.len()]).collect();
        Self { positions, cells, loops, fixed }
    }

    fn of(meshed: Meshed) -> Self {
        let loops: Vec<Vec<u32>> = meshed.loops.iter().map(|nodes| nodes.iter().map(|own| own.node).collect()).collect();
        let fixed = loops.iter().map(|nodes| vec![false; nodes.len()]).collect();
        Self { positions: meshed.positions, cells: meshed.cells, loops, fixed }
    }

    /// The image of the unit square in nx × ny quadrilaterals.
    fn grid(nx: u32, ny: u32, to: impl Fn(Point) -> Point) -> Self {
        let at = |i: u32, j: u32| to([f64::from(i) / f64::from(nx), f64::from(j) / f64::from(ny)]);
        let positions = (0..=ny).flat_map(|j| (0..=nx).map(move |i| (i, j))).map(|(i, j)| at(i, j)).collect();
        let cell = |i: u32, j: u32| {
            let a = j * (nx + 1) + i;
            [a, a + 1, a + nx + 2, a + nx + 1]
        };
        Self::new(positions, (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))).map(|(i, j)| cell(i, j)).collect())
    }

    fn body(&self) -> Body<'_> {
        Body { mesh: Mesh { positions: &self.positions, cells: &self.cells }, loops: &self.loops, fixed: &self.fixed }
    }

    fn quality(&self) -> f64 {
        quality(&self.positions, &self.cells)
    }

    fn measure(&self, measure: Measure) -> f64 {
        let place = |&node: &u32| self.positions[node as usize];
        volume::measured(measure, &self.loops.iter().map(|nodes| nodes.iter().map(place).collect()).collect::<Vec<_>>())
    }

    /// Moves nodes inside by a part of the shortest edge there at most, as far as no cell gets too bad.
    fn jitter(&mut self, part: f64, random: &mut Random) {
        let mut shortest = vec![f64::INFINITY; self.positions.len()];
        let mut around = vec![Vec::new(); self.positions.len()];
        for cell in &self.cells {
            for [a, b] in edges(corners(cell)) {
                let length = distance(self.positions[a as usize], self.positions[b as usize]);
                for node in [a, b] {
                    shortest[node as usize] = shortest[node as usize].min(length);
                }
                around[a as usize].push(*cell);
            }
        }
        let mut outer = vec![false; self.positions.len()];
        self.loops.iter().flatten().for_each(|&node| outer[node as usize] = true);
        for node in (0..self.positions.len()).filter(|&node| !outer[node]) {
            let from = self.positions[node];
            self.positions[node] = from.map(|x| x + part * shortest[node] * (2.0 * random.next() - 1.0));
            if quality(&self.positions, &around[node]) < 0.05 {
                self.positions[node] = from;
            }
        }
    }

    /// The relocated mesh, of which all that is promised has been looked at.
    fn relocated(&self, measure: Measure, better: f64) -> Result<Self, Failure> {
        let meshed = relocated(&self.body(), measure, better)?;
        assert_eq!(meshed.cells, self.cells);
        let quality = quality(&meshed.positions, &meshed.cells);
        assert!(quality >= better.max(1.0) * self.quality());
        for (nodes, old) in meshed.loops.iter().zip(&self.loops) {
            let at = old.iter().position(|&node| node == nodes[0].node).unwrap();
            let turned: Vec<u32> = (0..old.len()).map(|k| old[(at + k) % old.len()]).collect();
            assert_eq!(nodes.iter().map(|own| own.node).collect::<Vec<_>>(), turned);
            for (k, own) in nodes.iter().enumerate() {
                assert!((0.0..1.0).contains(&own.fraction));
                assert!(k == 0 || (nodes[k - 1].segment, nodes[k - 1].fraction) < (own.segment, own.fraction));
                let segment = own.segment as usize;
                let [a, b] = [old[segment], old[(segment + 1) % old.len()]].map(|node| self.positions[node as usize]);
                let x = meshed.positions[own.node as usize];
                assert!(distance(x, on_line(a, b, own.fraction)) <= 0.0501 * 2.0 * distance(a, b).max(0.1), "far from its line");
                assert!(a[0] != 0.0 || b[0] != 0.0 || x[0] == 0.0, "off the axis");
            }
        }
        for (&node, &fixed) in self.loops.iter().flatten().zip(self.fixed.iter().flatten()) {
            let [from, to] = [&self.positions, &meshed.positions].map(|all| all[node as usize].map(f64::to_bits));
            assert!(!fixed || from == to, "a fixed node moves");
        }
        let new = Self { positions: meshed.positions, fixed: self.fixed.clone(), cells: meshed.cells, loops: self.loops.clone() };
        let change = new.measure(measure) / self.measure(measure) - 1.0;
        assert!(change.abs() < 1e-13, "the measure changes by {change:e}");
        Ok(new)
    }
}

/// Sides of a unit square with nodes at random places, and nodes inside of it.
fn jittered(nx: u32, ny: u32, part: f64, random: &mut Random) -> Made {
    let mut made = Made::grid(nx, ny, |x| x);
    for x in &mut made.positions {
        for (d, n) in [(0, nx), (1, ny)] {
            let by = part * (2.0 * random.next() - 1.0) / f64::from(n);
            if x[d] != 0.0 && x[d] != 1.0 {
                x[d] += by;
            }
        }
    }
    made
}

/// Each quadrilateral as two triangles.
fn cut(made: &Made) -> Made {
    let halves = made.cells.iter().flat_map(|&[a, b, c, d]| [[a, b, c, c], [a, c, d, d]]).collect();
    Made::new(made.positions.clone(), halves)
}

/// A quarter of an upset billet: its side bulges, its rows are pressed together at the bottom of the axis and
/// at the top of the side, and its columns lean.
fn upset(n: u32) -> Made {
    Made::grid(n, n, |[u, v]| {
        let pressed = u * v * (2.0 - v) + (1.0 - u) * v * v;
        let side = 1.0 + 0.06 * pressed * (2.0 - pressed);
        [side * (u + 0.9 * u * (1.0 - u) * v), 0.4 * pressed]
    })
}

/// Longest edge of the outline.
fn longest(made: &Made) -> f64 {
    let all = made.loops.iter().flat_map(|nodes| edges(nodes));
    all.map(|[a, b]| distance(made.positions[a as usize], made.positions[b as usize])).fold(0.0, f64::max)
}

#[test]
fn a_square_with_random_nodes_becomes_better() {
    let mut random = Random(3);
    let (mut least, mut gain) = (1.0_f64, f64::INFINITY);
    for k in 0..120 {
        let old = jittered(4 + k % 13, 4 + k % 7, 0.4, &mut random);
        let made = if k % 3 == 0 { cut(&old) } else { old };
        let before = made.quality();
        let [one, other] = [Measure::Plane, Measure::Revolution].map(|measure| {
            if !(before > 0.0) {
                assert!(matches!(made.relocated(measure, 1.0), Err(Failure::Inverted { .. })));
                return None;
            }
            Some(made.relocated(measure, 1.1).unwrap())
        });
        let Some(new) = one else { continue };
        // Straight lines need no correction of the measure.
        assert_eq!(new.positions, other.unwrap().positions);
        assert!((new.measure(Measure::Plane) - 1.0).abs() < 1e-14);
        let sides = |x: &Point| x.iter().filter(|x| **x == 0.0 || **x == 1.0).count();
        assert!(made.positions.iter().zip(&new.positions).all(|(old, new)| sides(old) == sides(new)));
        let regular = Made::grid(4 + k % 13, 4 + k % 7, |x| x);
        least = least.min(new.quality() / if k % 3 == 0 { cut(&regular).quality() } else { 1.0 });
        gain = gain.min(new.quality() / before);
    }
    println!("least by that of regular cells {least:.3}, by that before {gain:.3}");
    assert!(least > 0.8);
}

#[test]
fn an_upset_billet_becomes_better() {
    for n in [6, 12, 24] {
        let made = upset(n);
        let whole = made.measure(Measure::Revolution);
        let mut now = made.clone();
        let mut all = vec![made.quality()];
        for _ in 0..4 {
            let Ok(new) = now.relocated(Measure::Revolution, 1.0) else { break };
            assert!(new.positions.iter().zip(&made.positions).all(|(new, old)| (new[0] == 0.0) == (old[0] == 0.0)));
            all.push(new.quality());
            now = new;
        }
        let change = now.measure(Measure::Revolution) / whole - 1.0;
        println!("{n}: {all:.3?}, volume {change:e}");
        assert!(all[1] > 1.3 * all[0] && change.abs() < 1e-13);
    }
}

#[test]
fn discs_and_rings_stay_round() {
    let disc = polygon(&circle([0.0, 0.0], 1.0, 60));
    let ring = with_hole(disc.clone(), &circle([0.0, 0.0], 0.4, 40));
    let mut random = Random(5);
    for (outline, measure, shift) in [(&disc, Measure::Plane, 0.0), (&ring, Measure::Plane, 0.0), (&disc, Measure::Revolution, 2.0)] {
        let place = |x: &Point| [x[0] + shift, x[1]];
        let loops = outline.loops.iter().map(|points| points.iter().map(place).collect()).collect();
        let outline = Outline { loops, fixed: outline.fixed.clone() };
        let mut now = Made::of(quadrilaterals(&outline, &|_| 0.12, measure, 10_000).unwrap());
        let whole = now.measure(measure);
        let start = now.quality();
        let mut most = 0.0_f64;
        for round in 0..50 {
            now.jitter(0.5, &mut random);
            now = now.relocated(measure, 1.1).unwrap();
            assert!(now.quality() > 0.8 * start, "{}", now.quality());
            for (nodes, radius) in now.loops.iter().zip([1.0, 0.4]) {
                let sag = longest(&Made { loops: vec![nodes.clone()], ..now.clone() }).powi(2) / 8.0 / radius;
                let far = |&node: &u32| (distance(now.positions[node as usize], [shift, 0.0]) - radius).abs() / sag;
                let off = nodes.iter().map(far).fold(0.0, f64::max);
                most = most.max(off);
                assert!(off < 1.0, "round {round}: off the circle by {off:.2} of the sag");
            }
        }
        let change = now.measure(measure) / whole - 1.0;
        println!("{} loops, {measure:?}: {start:.3} to {:.3}, off by {most:.3} of the sag, {change:e}", now.loops.len(), now.quality());
        assert!(change.abs() < 1e-13);
    }
}

#[test]
fn random_stars_that_are_distorted_become_better() {
    let mut random = Random(17);
    let (mut count, mut refused, mut worse, mut gain) = (0, 0, 0, 0.0);
    for k in 0..300 {
        let outline = star(&mut random);
        let h = 0.1 + 0.2 * random.next();
        let measure = if k % 2 == 0 { Measure::Plane } else { Measure::Revolution };
        let make = if k % 3 == 0 { triangles } else { quadrilaterals };
        let Ok(meshed) = make(&outline, &|_| h, measure, 20_000) else { continue };
        let good = Made::of(meshed);
        let mut bad = good.clone();
        bad.jitter(0.6, &mut random);
        for (nodes, fixed) in bad.loops.iter().zip(&mut bad.fixed) {
            fixed.iter_mut().for_each(|fixed| *fixed = random.next() < 0.05);
            assert_eq!(nodes.len(), fixed.len());
        }
        count += 1;
        match bad.relocated(measure, 1.0) {
            Ok(new) => {
                gain += new.quality() / good.quality();
                worse += usize::from(new.quality() < 0.9 * good.quality());
            }
            Err(_) => refused += 1,
        }
    }
    println!("{count} meshes, {refused} refused, {worse} worse than before the distortion, mean gain {:.3}", gain / f64::from(count));
    assert!(count > 280 && refused == 0 && worse * 50 < count as usize);
}

#[test]
fn a_mesh_that_is_perfect_stays_as_it_is() {
    let made = Made::grid(7, 5, |[u, v]| [1.4 * u, v]);
    assert_eq!(made.relocated(Measure::Plane, 1.0).unwrap().positions, made.positions);
    let refused = made.relocated(Measure::Plane, 1.01);
    assert!(matches!(refused, Err(Failure::NotBetter { before, best }) if before == best && before > 1.0 - 1e-12), "{:?}", refused.err());
    // A graded one has only right angles, too.
    let graded = Made::grid(8, 8, |[u, v]| [u * u, v]);
    assert!(matches!(graded.relocated(Measure::Plane, 1.01), Err(Failure::NotBetter { .. })));
}

#[test]
fn relocated_again_and_again_it_comes_to_rest() {
    let mut now = upset(12);
    let mut ways = Vec::new();
    for _ in 0..40 {
        let Ok(new) = now.relocated(Measure::Plane, 0.0) else { break };
        ways.push(now.positions.iter().zip(&new.positions).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max));
        now = new;
    }
    println!("{ways:.6?}");
    assert!(ways.last().is_some_and(|way| *way < 2e-3));
}

#[test]
fn scale_and_place_do_not_matter() {
    let mut random = Random(23);
    let mut disc = Made::of(quadrilaterals(&polygon(&circle([1.5, 0.0], 1.0, 50)), &|_| 0.2, Measure::Plane, 1_000).unwrap());
    disc.jitter(0.5, &mut random);
    for made in [upset(9), disc, jittered(6, 8, 0.35, &mut random)] {
        for measure in [Measure::Plane, Measure::Revolution] {
            let new = made.relocated(measure, 1.0).unwrap();
            assert_eq!(new.positions, made.relocated(measure, 1.0).unwrap().positions);
            for by in [2.0_f64.powi(40), 2.0_f64.powi(-40)] {
                let mut scaled = made.clone();
                scaled.positions.iter_mut().for_each(|x| *x = x.map(|x| by * x));
                let scaled = relocated(&scaled.body(), measure, 1.0).unwrap().positions;
                assert!(new.positions.iter().zip(&scaled).all(|(one, other)| one.map(|x| by * x) == *other));
            }
        }
        let mut shifted = made.clone();
        shifted.positions.iter_mut().for_each(|x| *x = [x[0] + 4.0, x[1] - 2.0]);
        let (new, shifted) = (made.relocated(Measure::Plane, 1.0).unwrap(), shifted.relocated(Measure::Plane, 1.0).unwrap());
        let off = |(one, other): (&Point, &Point)| distance([one[0] + 4.0, one[1] - 2.0], *other);
        let most = new.positions.iter().zip(&shifted.positions).map(off).fold(0.0, f64::max);
        println!("shifted: {most:e}");
        assert!(most < 1e-9);
    }
}

/// Linear velocities and uniform stresses pass exactly to a relocated mesh.
#[test]
fn a_state_passes_to_a_relocated_mesh() {
    let mut random = Random(29);
    let mut disc = Made::of(quadrilaterals(&polygon(&circle([1.5, 0.0], 1.0, 50)), &|_| 0.2, Measure::Plane, 1_000).unwrap());
    disc.jitter(0.5, &mut random);
    let leaning = Made::grid(9, 7, |[u, v]| {
        let y = v * v * (1.0 - u) + v * u;
        [u + 0.3 * y + 0.6 * u * (1.0 - u) * y, y]
    });
    let field = |x: Point| [3.0 + 2.0 * x[0] - 5.0 * x[1], -1.0 + 4.0 * x[0] + 0.5 * x[1]];
    for (old, is_straight) in [(leaning, true), (jittered(8, 8, 0.35, &mut random), true), (disc, false)] {
        let new = old.relocated(Measure::Plane, 1.1).unwrap();
        let [before, after] = [&old, &new].map(|made| Mesh { positions: &made.positions, cells: &made.cells });
        let mut node_mass = vec![0.0; old.positions.len()];
        let mut corner_mass = Vec::new();
        for cell in &old.cells {
            let polygon = corners(cell).iter().map(|&node| old.positions[node as usize]).collect();
            let mass = 0.25 * 7800.0 * volume::measured(Measure::Plane, &[polygon]);
            cell.iter().for_each(|&node| node_mass[node as usize] += mass);
            corner_mass.push([mass; 4]);
        }
        let velocities: Vec<Point> = old.positions.iter().map(|&x| field(x)).collect();
        let supermesh = Supermesh::new(before, after, Measure::Plane).unwrap();
        let state = OldNodes { mesh: before, corner_mass: &corner_mass, node_mass: &node_mass, velocities: &velocities, spare: 0.0 };
        let held = vec![[None; 2]; new.positions.len()];
        let found = nodes(&supermesh, &state, &NewNodes { mesh: after, held: &held }).unwrap();
        let sum = |mass: &[f64], all: &[Point], d: usize| mass.iter().zip(all).map(|(mass, v)| mass * v[d]).sum::<f64>();
        let whole: f64 = node_mass.iter().sum();
        for d in 0..2 {
            let gained = sum(&found.mass, &found.velocities, d) - sum(&node_mass, &velocities, d);
            assert!(gained.abs() < 1e-12 * 10.0 * whole, "momentum: {gained:e}");
        }
        let off = |(x, v): (&Point, &Point)| distance(field(*x), *v);
        let most = new.positions.iter().zip(&found.velocities).map(off).fold(0.0, f64::max);
        println!("velocities off by {most:e}, masses by {:.1e}", found.correction);
        assert!(most < if is_straight { 1e-12 } else { 2e-2 });
        for count in [1, 4] {
            let stress = vec![2.5e8; count * old.cells.len()];
            let values = Values { values: &stress, width: 1, densities: None, order: Order::Linear, limits: None };
            let [from, to] = [before, after].map(|mesh| Points { mesh, points: count });
            let found = points(&from, &to, Measure::Plane, &values).unwrap();
            assert!(found.iter().all(|value| (value / 2.5e8 - 1.0).abs() < 1e-12));
        }
    }
}

#[test]
fn what_is_no_mesh_is_refused() {
    let good = jittered(4, 4, 0.3, &mut Random(1));
    let refused = |change: &dyn Fn(&mut Made)| {
        let mut bad = good.clone();
        change(&mut bad);
        relocated(&bad.body(), Measure::Plane, 1.0).expect_err("it is bad")
    };
    let inputs: [&dyn Fn(&mut Made); 16] = [
        &|bad| bad.positions[6][0] = f64::NAN,
        &|bad| bad.positions[0][1] = f64::INFINITY,
        &|bad| bad.positions.clear(),
        &|bad| bad.positions.truncate(20),
        &|bad| bad.positions.push([0.5, 0.5]),
        &|bad| bad.cells.clear(),
        &|bad| bad.cells[3][2] = 1_000,
        &|bad| bad.cells.truncate(15),
        &|bad| bad.cells.push(bad.cells[0]),
        &|bad| bad.loops.clear(),
        &|bad| bad.loops[0].truncate(3),
        &|bad| bad.loops[0].reverse(),
        &|bad| bad.loops[0][2] = 7_777,
        &|bad| bad.loops.push(bad.loops[0].clone()),
        &|bad| bad.fixed[0].truncate(15),
        &|bad| bad.fixed.push(Vec::new()),
    ];
    for (k, change) in inputs.iter().enumerate() {
        assert!(matches!(refused(*change), Failure::Input(_)), "{k}: {:?}", refused(*change));
    }
    let inverted: [&dyn Fn(&mut Made); 4] = [
        &|bad| bad.positions[6] = [0.9, 0.9],
        &|bad| bad.positions[6] = bad.positions[7],
        &|bad| bad.positions.iter_mut().for_each(|x| x[0] = -x[0]),
        &|bad| bad.positions.fill([1.0, 2.0]),
    ];
    for (k, change) in inverted.iter().enumerate() {
        assert!(matches!(refused(*change), Failure::Inverted { .. }), "{k}: {:?}", refused(*change));
    }
    let far = refused(&|bad| bad.positions.iter_mut().for_each(|x| *x = x.map(|x| 1e70 * x)));
    assert!(matches!(far, Failure::Outline(mesher::Failure::Outline(_))), "{far}");
    assert!(matches!(relocated(&good.body(), Measure::Plane, f64::NAN), Err(Failure::Input(_))));
    let mut beyond = good.clone();
    beyond.positions.iter_mut().for_each(|x| x[0] -= 0.5);
    assert!(matches!(relocated(&beyond.body(), Measure::Revolution, 1.0), Err(Failure::Outline(_))));
    // A strip that is wound around and lies on itself.
    let wound = Made::grid(60, 2, |[u, v]| {
        let (angle, radius) = (7.5 * u, 1.0 + 0.5 * v + 0.1 * u);
        [radius * angle.sin(), radius * angle.cos()]
    });
    assert!(wound.quality() > 0.9);
    assert!(matches!(relocated(&wound.body(), Measure::Plane, 1.0), Err(Failure::Outline(mesher::Failure::Crossing { .. }))));
}

#[test]
fn nothing_makes_it_panic() {
    let mut random = Random(31);
    let (mut given, mut refused) = (0, 0);
    for k in 0..400 {
        let part = [0.3, 0.5, 0.8][k % 3];
        let mut made = jittered(1 + k as u32 % 5, 1 + k as u32 / 5 % 5, part, &mut random);
        // Nodes of the outline off it, too, and some cells as triangles.
        let (bend, by) = (0.3 * random.next(), [1.0, 1e8, 1e-8][k % 3]);
        made.positions.iter_mut().for_each(|x| *x = [by * (x[0] + bend * x[1] * (1.0 - x[1])), by * (x[1] + bend * x[0] * (1.0 - x[0]))]);
        if k % 4 == 0 {
            made = cut(&made);
        }
        if k % 7 == 0 {
            let node = (random.next() * made.positions.len() as f64) as usize;
            made.positions[node] = made.positions[node / 2];
        }
        let measure = if k % 2 == 0 { Measure::Plane } else { Measure::Revolution };
        match made.relocated(measure, 1.0) {
            Ok(_) => given += 1,
            Err(_) => refused += 1,
        }
    }
    println!("{given} given, {refused} refused");
    assert!(given > 150);
}

#[test]
#[ignore = "takes time"]
fn speed() {
    let mut random = Random(37);
    for n in [30, 100] {
        let made = jittered(n, n, 0.3, &mut random);
        let start = std::time::Instant::now();
        let new = relocated(&made.body(), Measure::Plane, 1.0).unwrap();
        println!("{} cells in {:.1} ms", new.cells.len(), 1e3 * start.elapsed().as_secs_f64());
    }
}
