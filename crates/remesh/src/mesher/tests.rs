//! Meshes of many regions.

use super::*;
use crate::plane::corners;

type Make = fn(&Outline, &dyn Fn(Point) -> f64, Measure, usize) -> Result<Meshed, Failure>;

pub(crate) fn polygon(points: &[Point]) -> Outline {
    Outline { loops: vec![points.to_vec()], fixed: vec![vec![false; points.len()]] }
}

pub(crate) fn with_hole(mut outline: Outline, hole: &[Point]) -> Outline {
    outline.loops.push(hole.iter().rev().copied().collect());
    outline.fixed.push(vec![false; hole.len()]);
    outline
}

/// Part of a circle, both ends included, in quarter turns.
fn arc(centre: Point, radius: f64, from: f64, to: f64, n: usize) -> Vec<Point> {
    let at = |k: usize| {
        let angle = std::f64::consts::FRAC_PI_2 * (from + (to - from) * k as f64 / n as f64);
        [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
    };
    (0..=n).map(at).collect()
}

pub(crate) fn circle(centre: Point, radius: f64, n: usize) -> Vec<Point> {
    let mut points = arc(centre, radius, 0.0, 4.0, n);
    points.pop();
    points
}

/// A quarter of a bar that has hit a wall, with a thin lip at its foot; radius first.
fn taylor_foot() -> Vec<Point> {
    let mut points = vec![[0.0, 0.0]];
    points.extend((1..=14).map(|k| [6.95 * k as f64 / 14.0, 0.0]));
    points.extend(arc([6.95, 0.25], 0.25, -1.0, 0.9, 9).into_iter().skip(1));
    for k in 1..=40 {
        let y = 0.5 + 0.75 * k as f64;
        points.push([3.2 + 3.6 / (1.0 + 1.2 * (y - 0.5) + 0.1 * (y - 0.5) * (y - 0.5)), y]);
    }
    points.push([0.0, 30.5]);
    points
}

/// A billet with bulging sides.
fn billet(bulge: f64) -> Vec<Point> {
    let mut points = vec![[0.0, 0.0], [10.0, 0.0]];
    points.extend((1..30).map(|k| {
        let t = k as f64 / 30.0;
        [10.0 + bulge * 4.0 * t * (1.0 - t), 12.0 * t]
    }));
    points.extend([[10.0, 12.0], [0.0, 12.0]]);
    points
}

/// A forging in a closed die, with flash.
fn flash() -> Vec<Point> {
    let mut points = vec![[0.0, 0.0], [20.0, 0.0]];
    points.extend(arc([20.0, 2.0], 2.0, -1.0, 0.0, 8).into_iter().skip(1));
    points.extend([[22.0, 5.0], [30.0, 5.0], [30.0, 6.0], [22.0, 6.0]]);
    points.extend(arc([20.0, 12.0], 2.0, 0.0, 1.0, 8));
    points.extend([[14.0, 14.0], [13.0, 9.0], [0.0, 9.0]]);
    points
}

fn regions() -> Vec<(&'static str, Outline, f64)> {
    let square = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let thick: Vec<Point> = {
        let mut points = arc([0.0, 0.0], 2.0, 0.0, 1.0, 40);
        points.extend(arc([0.0, 0.0], 1.0, 1.0, 0.0, 30));
        points
    };
    vec![
        ("square", square.clone(), 0.05),
        ("square, coarse", square.clone(), 0.3),
        ("rectangle", polygon(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]), 0.08),
        ("disc", polygon(&circle([0.0, 0.0], 1.0, 80)), 0.1),
        ("disc, coarse", polygon(&circle([3.0, 0.0], 1.0, 100)), 0.5),
        ("billet", polygon(&billet(2.0)), 0.7),
        ("ring", with_hole(polygon(&circle([0.0, 0.0], 1.0, 90)), &circle([0.1, 0.0], 0.4, 50)), 0.08),
        ("quarter ring", polygon(&thick), 0.09),
        ("foot of a Taylor bar", polygon(&taylor_foot()), 0.5),
        ("flash", polygon(&flash()), 0.8),
        ("strip", polygon(&[[0.0, 0.0], [10.0, 0.0], [10.0, 0.3], [0.0, 0.3]]), 0.5),
        ("bracket", polygon(&[[0.0, 0.0], [1.5, 0.0], [1.5, 0.1], [0.4, 0.4], [0.4, 2.0], [0.0, 2.0]]), 0.06),
        ("sharp corner", polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 0.7]]), 0.08),
        ("square with a square hole", with_hole(square, &[[0.3, 0.3], [0.6, 0.3], [0.6, 0.7], [0.3, 0.7]]), 0.06),
    ]
}

fn measure_of(meshed: &Meshed, measure: Measure) -> f64 {
    let polygons: Vec<Vec<Point>> =
        meshed.cells.iter().map(|cell| corners(cell).iter().map(|&node| meshed.positions[node as usize]).collect()).collect();
    volume::measured(measure, &polygons)
}

/// Faults of a mesh, and the least quality and its lowest twentieth.
fn judge(outline: &Outline, meshed: &Meshed, measure: Measure) -> (f64, f64) {
    let (old, new) = (volume::measured(measure, &outline.loops), measure_of(meshed, measure));
    assert!((new / old - 1.0).abs() < 1e-13, "measure {old} has become {new}: {:e}", new / old - 1.0);
    // Each edge is one of two cells in opposite directions, or of a loop.
    let mut edges = std::collections::BTreeMap::new();
    let mut used = vec![false; meshed.positions.len()];
    for cell in &meshed.cells {
        let nodes = corners(cell);
        for k in 0..nodes.len() {
            used[nodes[k] as usize] = true;
            assert!(edges.insert([nodes[k], nodes[(k + 1) % nodes.len()]], ()).is_none(), "an edge twice");
        }
    }
    assert!(used.iter().all(|&used| used), "a node without a cell");
    let mut outer = 0;
    for (nodes, points) in meshed.loops.iter().zip(&outline.loops) {
        for (k, node) in nodes.iter().enumerate() {
            let next = &nodes[(k + 1) % nodes.len()];
            assert!(edges.contains_key(&[node.node, next.node]) && !edges.contains_key(&[next.node, node.node]));
            assert!(k == 0 || (nodes[k - 1].segment, nodes[k - 1].fraction) < (node.segment, node.fraction));
            let (a, b) = (points[node.segment as usize], points[(node.segment as usize + 1) % points.len()]);
            let x = meshed.positions[node.node as usize];
            assert!((0.0..1.0).contains(&node.fraction));
            for d in 0..2 {
                assert!(a[d] != 0.0 || b[d] != 0.0 || d == 1 || x[d] == 0.0, "off the axis: {x:?}");
            }
        }
        outer += nodes.len();
    }
    assert_eq!(edges.keys().filter(|[a, b]| !edges.contains_key(&[*b, *a])).count(), outer);
    // Euler: vertices − edges + faces = 2 (outer loops) − loops.
    let count = meshed.positions.len() as i64 - (edges.len() as i64 + outer as i64) / 2 + meshed.cells.len() as i64;
    let outers = outline.loops.iter().filter(|points| volume::measured(Measure::Plane, &[points.to_vec()]) > 0.0).count() as i64;
    assert_eq!(count, 2 * outers - outline.loops.len() as i64);
    let mut all = qualities(&meshed.positions, &meshed.cells);
    all.sort_by(f64::total_cmp);
    assert!(all[0] >= WORST);
    (all[0], all[all.len() / 20])
}

/// For a look at the meshes: `EMBATE_MESHES=folder cargo test look -- --ignored`.
#[test]
#[ignore = "writes files"]
fn look() {
    let Ok(folder) = std::env::var("EMBATE_MESHES") else { return };
    for (name, outline, h) in regions() {
        for (kind, make) in [("quads", quadrilaterals as Make), ("triangles", triangles)] {
            let made: Result<Meshed, Failure> = make(&outline, &|_: Point| h, Measure::Plane, 100_000);
            match made {
                Ok(meshed) => {
                    let mut all = qualities(&meshed.positions, &meshed.cells);
                    all.sort_by(f64::total_cmp);
                    let wanted = measure_of(&meshed, Measure::Plane) / (h * h) / if kind == "quads" { 1.0 } else { 0.433 };
                    println!(
                        "{name:28} {kind:10} {:6} cells, {:.2} of wanted, least {:.3}, 5 % {:.3}, mean {:.3}",
                        all.len(),
                        all.len() as f64 / wanted,
                        all[0],
                        all[all.len() / 20],
                        all.iter().sum::<f64>() / all.len() as f64
                    );
                    let text = format!("{:?}\n{:?}\n{:?}\n", meshed.positions, meshed.cells, outline.loops);
                    std::fs::write(format!("{folder}/{name}, {kind}.txt"), text).unwrap();
                }
                Err(failure) => println!("{name:28} {kind:10} {failure}"),
            }
        }
    }
}

#[test]
fn regions_are_filled_with_good_cells() {
    for (name, outline, h) in regions() {
        for measure in [Measure::Plane, Measure::Revolution] {
            if measure == Measure::Revolution && outline.loops.iter().flatten().any(|x| x[0] < 0.0) {
                assert!(matches!(quadrilaterals(&outline, &|_| h, measure, 10_000), Err(Failure::Outline(_))));
                continue;
            }
            for (kind, make) in [quadrilaterals as Make, triangles].into_iter().enumerate() {
                let meshed = make(&outline, &|_| h, measure, 10_000).unwrap_or_else(|failure| panic!("{name}: {failure}"));
                let (least, low) = judge(&outline, &meshed, measure);
                // The sharp corner has 19 degrees, of which the sine is 0.33.
                assert!(least >= if name == "sharp corner" { 0.32 } else { 0.35 }, "{name}: {least}");
                // Few cells, or a region that is narrower than they should be.
                let is_short = name == "disc, coarse" || (name == "strip" && kind == 1);
                assert!(low >= if is_short { 0.55 } else { 0.7 }, "{name}: {low}");
                assert_eq!(make(&outline, &|_| h, measure, 10_000), Ok(meshed), "{name}");
            }
        }
    }
}

#[test]
fn there_are_as_many_cells_as_the_size_asks_for() {
    for (name, outline, h) in regions() {
        if ["strip", "disc, coarse", "square, coarse", "sharp corner"].contains(&name) {
            continue; // narrow, or of few cells
        }
        let [x, y] = outline.loops[0][0];
        let extent = outline.loops[0].iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        let uniform = |_: Point| 0.7 * h;
        let graded = |at: Point| h * (0.3 + 0.7 * ((at[0] - x).abs() + (at[1] - y).abs()) / extent).min(1.0);
        for (way, size) in [("uniform", &uniform as &dyn Fn(Point) -> f64), ("graded", &graded)] {
            for (kind, make) in [quadrilaterals as Make, triangles].into_iter().enumerate() {
                let meshed = make(&outline, size, Measure::Plane, 20_000).expect(name);
                let (least, _) = judge(&outline, &meshed, Measure::Plane);
                let wanted = |cell: &Cell| {
                    let points: Vec<Point> = corners(cell).iter().map(|&node| meshed.positions[node as usize]).collect();
                    let middle = [0, 1].map(|d| points.iter().map(|x| x[d]).sum::<f64>() / points.len() as f64);
                    let one = if kind == 0 { 1.0 } else { 0.433 };
                    volume::measured(Measure::Plane, &[points]) / (one * size(middle) * size(middle))
                };
                let part = meshed.cells.len() as f64 / meshed.cells.iter().map(wanted).sum::<f64>();
                assert!((0.85..1.2).contains(&part) && least > 0.3, "{name}, {way}: {part}, {least}");
            }
        }
    }
}

/// Numbers from 0 to 1 without a generator of the platform.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A star-shaped outline of smooth and of jagged pieces.
pub(crate) fn star(random: &mut Random) -> Outline {
    let n = 24 + (random.next() * 100.0) as usize;
    let waves: Vec<[f64; 3]> = (2..7).map(|k| [f64::from(k), 0.35 / f64::from(k) * random.next(), 6.3 * random.next()]).collect();
    let jags = 0.6 * random.next();
    let mut points: Vec<Point> = Vec::new();
    let mut is_jagged = false;
    for k in 0..n {
        if random.next() < 0.1 {
            is_jagged = random.next() < 0.4;
        }
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        let mut radius = 1.0 + waves.iter().map(|[k, a, phase]| a * (k * angle + phase).sin()).sum::<f64>();
        if is_jagged && random.next() < 0.5 {
            radius *= 1.0 + jags * (random.next() - 0.5);
        }
        points.push([3.0 + radius * angle.cos(), radius * angle.sin()]);
    }
    let fixed = points.iter().map(|_| random.next() < 0.05).collect();
    Outline { loops: vec![points], fixed: vec![fixed] }
}

#[test]
fn random_stars_are_meshed_or_refused() {
    let mut random = Random(7);
    let (mut all, mut refused, mut poor) = (0, Vec::new(), 0);
    for _ in 0..300 {
        let outline = star(&mut random);
        let h = 0.05 + 0.3 * random.next();
        let measure = if random.next() < 0.5 { Measure::Plane } else { Measure::Revolution };
        for make in [quadrilaterals, triangles] {
            all += 1;
            match make(&outline, &|_| h, measure, 20_000) {
                Ok(meshed) => {
                    let (least, _) = judge(&outline, &meshed, measure);
                    poor += usize::from(least < 0.3);
                    // Fixed points are nodes.
                    for (k, &x) in outline.loops[0].iter().enumerate().filter(|(k, _)| outline.fixed[0][*k]) {
                        let is_this = |node: &&OnOutline| node.segment as usize == k && node.fraction == 0.0;
                        let node = meshed.loops[0].iter().find(is_this).expect("a fixed point has its node");
                        assert_eq!(meshed.positions[node.node as usize], x);
                    }
                }
                Err(failure) => refused.push(failure),
            }
        }
    }
    assert!(refused.len() * 20 < all, "{refused:?}");
    assert!(poor * 20 < all, "{poor} of {all} have a scaled Jacobian below 0.3");
}

#[test]
fn a_region_that_is_meshed_again_and_again_keeps_its_form() {
    for measure in [Measure::Plane, Measure::Revolution] {
        for (name, outline, h) in regions() {
            if measure == Measure::Revolution && outline.loops.iter().flatten().any(|x| x[0] < 0.0) {
                continue;
            }
            let whole = volume::measured(measure, &outline.loops);
            let mut now = outline.clone();
            let mut counts = Vec::new();
            let mut least = 1.0_f64;
            for round in 0..18 {
                let h = h * [1.0, 1.13, 0.9][round % 3];
                let meshed = quadrilaterals(&now, &|_| h, measure, 10_000).unwrap_or_else(|failure| panic!("{name}, {round}: {failure}"));
                least = least.min(judge(&now, &meshed, measure).0);
                let place = |node: &OnOutline| meshed.positions[node.node as usize];
                now.loops = meshed.loops.iter().map(|nodes| nodes.iter().map(place).collect()).collect();
                now.fixed = now.loops.iter().map(|points| vec![false; points.len()]).collect();
                // Rounds 2, 5, 8, ... have the same size: the number of cells is about the same.
                counts.push(meshed.cells.len() as f64);
                assert!(round < 6 || (counts[round] / counts[round - 3] - 1.0).abs() < 0.15, "{name}: {counts:?}");
            }
            let drift = volume::measured(measure, &now.loops) / whole - 1.0;
            assert!(drift.abs() < 1e-12, "{name}: {drift:e}");
            assert!(least > 0.3, "{name}: {least}");
            if name == "disc" {
                let far = |x: &Point| (x[0] * x[0] + x[1] * x[1]).sqrt();
                let radii: Vec<f64> = now.loops[0].iter().map(far).collect();
                assert!(radii.iter().all(|r| (0.998..1.003).contains(r)), "{radii:?}");
            }
        }
    }
}

#[test]
fn nodes_stay_on_straight_lines_and_near_curved_ones() {
    for (name, outline, h) in regions() {
        for make in [quadrilaterals as Make, triangles] {
            let meshed = make(&outline, &|_| h, Measure::Plane, 10_000).expect(name);
            for (nodes, points) in meshed.loops.iter().zip(&outline.loops) {
                for (k, node) in nodes.iter().enumerate() {
                    let segment = node.segment as usize;
                    let (a, b) = (points[segment], points[(segment + 1) % points.len()]);
                    let x = meshed.positions[node.node as usize];
                    let old = crate::plane::on_line(a, b, node.fraction);
                    let off = crate::plane::distance(x, old);
                    let [back, on] = [k + nodes.len() - 1, k + 1].map(|k| meshed.positions[nodes[k % nodes.len()].node as usize]);
                    let edges = 0.5 * (crate::plane::distance(back, x) + crate::plane::distance(x, on));
                    assert!(off <= 0.0501 * edges, "{name}: {off} of {edges}");
                    if crate::plane::distance(a, b) > 1.5 * h {
                        assert!(off < 1e-14 * 30.0, "{name}: {off:e} off the line");
                        assert!((0..2).all(|d| a[d] != b[d] || x[d] == a[d]), "{name}: {x:?}");
                    }
                }
            }
        }
    }
}

fn scaled(outline: &Outline, by: f64, shift: Point) -> Outline {
    let place = |x: &Point| [x[0] * by + shift[0], x[1] * by + shift[1]];
    Outline { loops: outline.loops.iter().map(|points| points.iter().map(place).collect()).collect(), fixed: outline.fixed.clone() }
}

#[test]
fn huge_and_tiny_regions_are_meshed_as_others_are() {
    for (name, outline, h) in regions() {
        let [one, huge, tiny] = [1.0, 2.0_f64.powi(30), 2.0_f64.powi(-30)].map(|by| {
            let outline = scaled(&outline, by, [0.0; 2]);
            let meshed = quadrilaterals(&outline, &|_| by * h, Measure::Plane, 10_000).expect(name);
            judge(&outline, &meshed, Measure::Plane);
            meshed.cells
        });
        assert!(one == huge && one == tiny, "{name}");
        let outline = scaled(&outline, 1e9, [1e9, -1e9]);
        let meshed = quadrilaterals(&outline, &|_| 1e9 * h, Measure::Plane, 10_000).expect(name);
        judge(&outline, &meshed, Measure::Plane);
    }
}

#[test]
fn outlines_that_are_none_are_refused() {
    let refused = |outline: &Outline, h: f64| quadrilaterals(outline, &|_| h, Measure::Plane, 1_000).expect_err("no mesh");
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let turned: Vec<Point> = square.iter().rev().copied().collect();
    for outline in [
        Outline::default(),
        Outline { loops: vec![square.to_vec()], fixed: vec![] },
        Outline { loops: vec![square.to_vec()], fixed: vec![vec![false; 3]] },
        polygon(&[]),
        polygon(&square[..2]),
        polygon(&[[1.0, 2.0]; 7]),
        polygon(&[[0.0, f64::NAN], [1.0, 0.0], [1.0, 1.0]]),
        polygon(&[[0.0, 0.0], [f64::INFINITY, 0.0], [1.0, 1.0]]),
        polygon(&[[0.0, 0.0], [1e200, 0.0], [1e200, 1e200]]),
        polygon(&[[0.0, 0.0], [1e-200, 0.0], [1e-200, 1e-200]]),
        polygon(&turned),
        Outline { loops: vec![square.to_vec(), vec![[0.2, 0.2], [0.4, 0.2], [0.4, 0.4]]], fixed: vec![vec![false; 4], vec![false; 3]] },
    ] {
        assert!(matches!(refused(&outline, 0.2), Failure::Outline(_)), "{outline:?}");
    }
    for points in [
        vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]],
        vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]],
        vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [3.0, 0.5], [1.0, 0.5], [1.0, 1.0], [0.0, 1.0]],
        vec![[0.0, 0.0], [1.0, 0.0], [0.5, 0.5], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]],
    ] {
        assert!(matches!(refused(&polygon(&points), 0.2), Failure::Crossing { .. }), "{points:?}");
    }
    for h in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(&polygon(&square), h), Failure::Size { .. }), "{h}");
    }
    for h in [1e-2, 1e-5, 1e-300] {
        assert_eq!(refused(&polygon(&square), h), Failure::Limit, "{h}");
    }
    // A needle of one degree is no place for a good quadrilateral.
    let needle = polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0175]]);
    assert!(matches!(refused(&needle, 0.2), Failure::Quality { least } if least < 0.02));
}

#[test]
fn nothing_makes_it_panic() {
    let mut random = Random(11);
    let mut counts = std::collections::BTreeMap::new();
    for k in 0..1000 {
        let n = 1 + (random.next() * 12.0) as usize;
        // Of few coordinates, so that points coincide, lie on one line, and edges touch.
        let steps = [2.0, 4.0, 1e6][k % 3];
        let by = [1.0, 1e9, 1e-9][k / 3 % 3];
        let mut coordinate = || (random.next() * steps).floor() / steps * by;
        let mut points: Vec<Point> = (0..n).map(|_| [coordinate(), coordinate()]).collect();
        if k % 2 == 0 && n > 3 {
            // Without crossings: by angle around the middle.
            points.sort_by(|a, b| (a[1] - 0.5 * by).atan2(a[0] - 0.5 * by).total_cmp(&(b[1] - 0.5 * by).atan2(b[0] - 0.5 * by)));
        }
        let mut outline = Outline { fixed: vec![points.iter().map(|_| random.next() < 0.3).collect()], loops: vec![points] };
        if random.next() < 0.3 {
            let x = [0.5 * by, 0.5 * by];
            let r = 0.3 * by * random.next();
            outline = with_hole(outline, &circle(x, r, 3 + k % 20));
        }
        let h = by * [0.3, 0.05, 3.0][k % 3] * (0.2 + random.next());
        let slope = 2.0 * random.next();
        let measure = if k % 5 == 0 { Measure::Revolution } else { Measure::Plane };
        for make in [quadrilaterals as Make, triangles] {
            let made = make(&outline, &|x| h * (1.0 + slope * x[0] / by), measure, 3_000);
            let what = match &made {
                Ok(meshed) => {
                    judge(&outline, meshed, measure);
                    "meshed"
                }
                Err(Failure::Outline(why)) => why,
                Err(Failure::Crossing { .. }) => "crossing",
                Err(Failure::Size { .. }) => "size",
                Err(Failure::Limit) => "limit",
                Err(Failure::Measure) => "measure",
                Err(Failure::Quality { .. }) => "quality",
            };
            *counts.entry(what).or_insert(0) += 1;
        }
    }
    assert!(counts["meshed"] > 400 && !counts.contains_key("measure") && !counts.contains_key("size"), "{counts:?}");
}

#[test]
#[ignore = "takes time"]
fn speed() {
    let outline = polygon(&flash());
    for count in [1_000.0, 10_000.0, 100_000.0] {
        let h = (volume::measured(Measure::Plane, &outline.loops) / count).sqrt();
        let start = std::time::Instant::now();
        let meshed = quadrilaterals(&outline, &|_| h, Measure::Plane, 1_000_000).expect("a mesh");
        println!("{} cells in {:.1} ms", meshed.cells.len(), 1e3 * start.elapsed().as_secs_f64());
    }
}
