//! What every global search promises, for whatever the registry holds, in 2D and 3D: a superset
//! of the true pairs and a subset of brute force's, sorted, each pair once, no facet with its own node, and
//! the same result from a fresh object as from a used one.
//!
//! True pairs come from distances of points and simplices at many times of the step, the ends and the times
//! of coplanarity among them.

use crate::long::samples;
use embate_solver::contact::search::{Pair, Query, registry};
use proptest::prelude::*;

/// What a query borrows.
#[derive(Clone, Debug)]
struct Scene<const D: usize> {
    old: Vec<[f64; D]>,
    new: Vec<[f64; D]>,
    slaves: Vec<u32>,
    facets: Vec<[u32; D]>,
    reach: f64,
}

impl<const D: usize> Scene<D> {
    /// Every node a slave, nothing moves.
    fn still(positions: Vec<[f64; D]>, facets: Vec<[u32; D]>, reach: f64) -> Self {
        Self { slaves: (0..positions.len() as u32).collect(), new: positions.clone(), old: positions, facets, reach }
    }
    fn moved(mut self, by: impl Fn(usize, [f64; D]) -> [f64; D]) -> Self {
        self.new = self.old.iter().enumerate().map(|(i, &x)| by(i, x)).collect();
        self
    }
    fn query(&self) -> Query<'_, D> {
        Query { positions_old: &self.old, positions_new: &self.new, slaves: &self.slaves, facets: &self.facets, reach: self.reach }
    }
    fn pairs(&self, name: &str) -> Vec<Pair> {
        let mut pairs = vec![Pair { slave: 7, facet: 7 }];
        let Some(kind) = registry::<D>().into_iter().find(|s| s.name == name) else { panic!("no search is called {name}") };
        (kind.make)().pairs(&self.query(), &mut pairs);
        pairs
    }
    /// Position at time t of 0..1; exact at the ends.
    fn at(&self, node: u32, t: f64) -> [f64; D] {
        let (a, b) = (&self.old[node as usize], &self.new[node as usize]);
        std::array::from_fn(|d| if t == 1.0 { b[d] } else { a[d] + t * (b[d] - a[d]) })
    }
    fn is_finite(&self, node: u32) -> bool {
        self.old[node as usize].iter().chain(&self.new[node as usize]).all(|x| x.is_finite())
    }
    /// Least distance of a node and a facet during the step, from above.
    fn distance(&self, node: u32, facet: &[u32; D]) -> f64 {
        let at = |t: f64| distance(&self.at(node, t), &facet.map(|n| self.at(n, t)));
        const TIMES: usize = 24;
        let (mut least, mut best) = (f64::INFINITY, 0.0);
        for k in 0..=TIMES {
            let t = k as f64 / TIMES as f64;
            let d = at(t);
            (least, best) = if d < least { (d, t) } else { (least, best) };
        }
        for t in self.coplanar_times(node, facet) {
            least = least.min(at(t));
        }
        // Ternary search in the intervals beside the best time.
        let (mut a, mut b) = ((best - 1.0 / TIMES as f64).max(0.0), (best + 1.0 / TIMES as f64).min(1.0));
        for _ in 0..40 {
            let (p, q) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            let (dp, dq) = (at(p), at(q));
            least = least.min(dp).min(dq);
            (a, b) = if dp < dq { (a, q) } else { (p, b) };
        }
        least
    }
    /// Times at which a node lies on the line of a segment (plane only): roots of a quadratic.
    fn coplanar_times(&self, node: u32, facet: &[u32; D]) -> Vec<f64> {
        if D != 2 {
            return vec![];
        }
        let side = |t: f64| {
            let [x, a, b] = [node, facet[0], facet[1]].map(|n| self.at(n, t));
            (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0])
        };
        let (c, half, end) = (side(0.0), side(0.5), side(1.0));
        let (a, b) = (2.0 * (c - 2.0 * half + end), 4.0 * half - 3.0 * c - end);
        let root = (b * b - 4.0 * a * c).sqrt();
        [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a), -c / b].into_iter().filter(|t| (0.0..=1.0).contains(t)).collect()
    }
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).map(|d| a[d] * b[d]).sum()
}
fn minus<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|d| a[d] - b[d])
}
fn segment_distance<const D: usize>(p: &[f64; D], a: &[f64; D], b: &[f64; D]) -> f64 {
    let (ab, ap) = (minus(b, a), minus(p, a));
    let length = dot(&ab, &ab);
    let t = if length > 0.0 { (dot(&ap, &ab) / length).clamp(0.0, 1.0) } else { 0.0 };
    let rest: [f64; D] = std::array::from_fn(|d| ap[d] - t * ab[d]);
    dot(&rest, &rest).sqrt()
}
/// Distance of a point and a segment (D = 2) or triangle (D = 3).
fn distance<const D: usize>(p: &[f64; D], nodes: &[[f64; D]; D]) -> f64 {
    let mut least = (0..D).map(|i| segment_distance(p, &nodes[i], &nodes[(i + 1) % D])).fold(f64::INFINITY, f64::min);
    if D == 3 {
        let (u, v, w) = (minus(&nodes[1], &nodes[0]), minus(&nodes[2], &nodes[0]), minus(p, &nodes[0]));
        let (uu, uv, vv, wu, wv) = (dot(&u, &u), dot(&u, &v), dot(&v, &v), dot(&w, &u), dot(&w, &v));
        let det = uu * vv - uv * uv;
        let (s, t) = ((vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det);
        if det > 0.0 && s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
            let rest: [f64; D] = std::array::from_fn(|d| w[d] - s * u[d] - t * v[d]);
            least = least.min(dot(&rest, &rest).sqrt());
        }
    }
    least
}

/// Holds every search of the registry to its promises on one scene.
fn check<const D: usize>(scene: &Scene<D>) {
    let own = |p: &Pair| scene.facets[p.facet as usize].contains(&scene.slaves[p.slave as usize]);
    let oracle = scene.pairs("brute_force");
    let largest = scene.old.iter().chain(&scene.new).flatten().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
    let must: Vec<Pair> = oracle
        .iter()
        .copied()
        .filter(|p| {
            let (node, facet) = (scene.slaves[p.slave as usize], &scene.facets[p.facet as usize]);
            let finite = scene.is_finite(node) && facet.iter().all(|&n| scene.is_finite(n));
            // The tolerance is the rounding of this test's own distances.
            finite && scene.distance(node, facet) < scene.reach * (1.0 - 1e-12) - 32.0 * f64::EPSILON * largest
        })
        .collect();
    for kind in registry::<D>() {
        let name = kind.name;
        let mut search = (kind.make)();
        let mut found = vec![];
        search.pairs(&scene.query(), &mut found);
        assert!(found.windows(2).all(|w| w[0] < w[1]), "{name}: sorted, each once");
        assert!(!found.iter().any(own), "{name}: no facet with its own node");
        assert!(found.iter().all(|p| oracle.binary_search(p).is_ok()), "{name}: within brute force");
        for pair in &must {
            assert!(found.binary_search(pair).is_ok(), "{name} loses {pair:?}");
        }
        let other = Scene::<D> {
            old: scene.old.iter().map(|x| x.map(|c| 3.0 - 0.5 * c)).collect(),
            new: scene.old.clone(),
            slaves: scene.slaves.iter().rev().copied().collect(),
            facets: scene.facets.iter().step_by(2).copied().collect(),
            reach: 2.0 * scene.reach,
        };
        search.pairs(&other.query(), &mut vec![]);
        let mut again = found.clone();
        search.pairs(&scene.query(), &mut again);
        assert_eq!(found, again, "{name}: a used object finds the same");
        let mut parts: Vec<Vec<Pair>> = vec![];
        search.by_and_by(&scene.query(), &mut again, &mut |pairs| parts.push(pairs.to_vec()));
        assert!(
            parts.windows(2).all(|w| w[0].last().is_none_or(|last| w[1].iter().all(|pair| pair.slave > last.slave))),
            "{name}: all of a slave at once"
        );
        assert_eq!(found, parts.concat(), "{name}: by and by the same");
        search.pairs(&scene.query(), &mut again);
        assert_eq!(found, again, "{name}: and once more");
    }
    assert_eq!(scene.pairs("grid"), scene.pairs("boxes"), "the grid finds exactly the pairs of the boxes");
}

/// A closed chain around a centre.
fn ring(scene: &mut (Vec<[f64; 2]>, Vec<[u32; 2]>), centre: [f64; 2], radius: f64, n: usize) {
    let first = scene.0.len() as u32;
    for k in 0..n {
        let (s, c) = (k as f64 * std::f64::consts::TAU / n as f64).sin_cos();
        scene.0.push([centre[0] + radius * c, centre[1] + radius * s]);
        scene.1.push([first + k as u32, first + (k as u32 + 1) % n as u32]);
    }
}

/// A row of squares that touch in their corners: every other node belongs to two of them.
fn touching_squares(n: usize) -> Scene<2> {
    let mut facets = vec![];
    let mut positions = vec![[0.0, 0.0]];
    for k in 0..n as u32 {
        let x = f64::from(k);
        positions.extend([[x + 0.5, 0.5], [x + 0.5, -0.5], [x + 1.0, 0.0]]);
        let (left, top, bottom, right) = (3 * k, 3 * k + 1, 3 * k + 2, 3 * k + 3);
        facets.extend([[left, top], [top, right], [right, bottom], [bottom, left]]);
    }
    Scene::still(positions, facets, 0.05)
}

/// A wavy sheet of triangles in 3D, n by n squares.
fn sheet(n: usize, lift: f64, reach: f64) -> Scene<3> {
    let row = n as u32 + 1;
    let positions = (0..row * row)
        .map(|i| {
            let (x, y) = (f64::from(i % row), f64::from(i / row));
            [x, y, lift + (0.7 * x).sin() + (0.4 * y).cos()]
        })
        .collect();
    let corner = |i: u32| i / n as u32 * row + i % n as u32;
    let facets = (0..(n * n) as u32)
        .flat_map(|i| [[corner(i), corner(i) + 1, corner(i) + row], [corner(i) + 1, corner(i) + row + 1, corner(i) + row]]);
    Scene::still(positions, facets.collect(), reach)
}

#[test]
fn the_default_is_the_grid_and_names_are_unique() {
    let names: Vec<_> = registry::<2>().iter().map(|s| s.name).collect();
    assert_eq!(names, ["grid", "boxes", "spheres", "nearest_node", "brute_force"]);
    assert_eq!(names, registry::<3>().iter().map(|s| s.name).collect::<Vec<_>>());
    assert!(registry::<2>().iter().all(|s| !s.doc.is_empty() && !s.source.is_empty()));
}

#[test]
fn empty_lists_have_no_pairs() {
    let nothing = Scene::<2>::still(vec![], vec![], 1.0);
    check(&nothing);
    check(&Scene { slaves: vec![], ..touching_squares(3) });
    check(&Scene { facets: vec![], ..touching_squares(3) });
}

#[test]
fn a_single_facet_is_found_from_all_around() {
    let mut positions = vec![[0.0, 0.0], [1.0, 0.0]];
    for k in 0..40 {
        let (s, c) = (f64::from(k) * 0.157).sin_cos();
        positions.extend([[0.5 + 0.7 * c, 0.7 * s], [0.5 + 2.0 * c, 2.0 * s]]);
    }
    check(&Scene::still(positions, vec![[0, 1]], 0.6));
}

#[test]
fn a_node_never_meets_its_own_facet_but_meets_its_neighbours() {
    check(&touching_squares(5));
    let wide = Scene { reach: 0.6, ..touching_squares(5) };
    check(&wide);
    // The upper tip of the second square: not its own facets 4 and 5, but the two opposite and the near one
    // of either neighbour.
    let of_tip: Vec<_> = wide.pairs("spheres").iter().filter(|p| p.slave == 4).map(|p| p.facet).collect();
    assert_eq!(of_tip, [1, 6, 7, 8]);
}

#[test]
fn a_surface_that_folds_onto_itself_is_found() {
    let n = 60;
    let positions: Vec<_> = (0..=n)
        .map(|i| {
            let s = f64::from(i) / 30.0;
            if s < 1.0 { [s, 0.0] } else { [2.0 - s, 0.01] }
        })
        .collect();
    let scene = Scene::still(positions, (0..n as u32).map(|i| [i, i + 1]).collect(), 0.02);
    check(&scene);
    assert!(scene.pairs("grid").len() > 60);
}

#[test]
fn points_for_facets_and_everything_in_one_place_are_no_trouble() {
    let point = Scene::still(vec![[0.25, -3.0]; 30], (0..29).map(|i| [i, i + 1]).collect(), 1e-3);
    check(&point);
    check(&Scene { reach: 0.0, ..point.clone() });
    let same_node = Scene { facets: vec![[3, 3], [4, 4], [4, 5]], ..point };
    check(&same_node);
    let line: Vec<_> = (0..40).map(|i| [f64::from(i % 7), 0.0]).collect();
    check(&Scene::still(line, (0..39).map(|i| [i, i + 1]).collect(), 0.1));
}

#[test]
fn huge_and_small_bodies_in_one_scene_are_found() {
    let mut bodies = (vec![], vec![]);
    ring(&mut bodies, [0.0, 0.0], 1e6, 12);
    ring(&mut bodies, [1e6, 0.0], 1.0, 12);
    ring(&mut bodies, [1e6 + 1.0, 0.0], 1e-5, 12);
    ring(&mut bodies, [1e6 + 1.0, 1e-5], 1e-6, 12);
    for reach in [0.0, 1e-6, 1e-3, 10.0] {
        check(&Scene::still(bodies.0.clone(), bodies.1.clone(), reach));
    }
}

#[test]
fn a_far_origin_loses_no_pair() {
    for offset in [1e9, -1e9, 1e12, 123_456_789.0] {
        let mut bodies = (vec![], vec![]);
        ring(&mut bodies, [offset, -offset], 1.0, 24);
        ring(&mut bodies, [offset + 2.0, -offset], 1.0, 24);
        check(&Scene::still(bodies.0, bodies.1, 1e-3).moved(|i, x| [x[0] + 0.01 * i as f64, x[1]]));
    }
}

#[test]
fn a_fast_node_finds_every_facet_that_it_flies_over() {
    let n = 50;
    let mut positions: Vec<_> = (0..=n).map(|i| [f64::from(i), 0.0]).collect();
    positions.push([-1.0, 0.01]);
    let mut scene = Scene::still(positions, (0..n as u32).map(|i| [i, i + 1]).collect(), 0.02);
    scene.new[n as usize + 1] = [60.0, 0.005];
    check(&scene);
    let flier = |p: &&Pair| p.slave == n as u32 + 1;
    assert_eq!(scene.pairs("grid").iter().filter(flier).count(), 50);
    // Facets that fly over a resting node.
    let shifted = scene.moved(|i, x| if i <= 50 { [x[0] - 70.0, x[1]] } else { x });
    check(&shifted);
    assert_eq!(shifted.pairs("grid").iter().filter(flier).count(), 50);
}

#[test]
fn fast_nodes_over_scattered_facets_find_each_once() {
    // Few facets far apart: rows of cells share buckets, and a long path looks at several of them.
    for wide in 2..14 {
        let mut positions: Vec<[f64; 2]> = vec![];
        for k in 0..16 {
            let x = f64::from(k) * 3.0;
            positions.extend([[x, x % 4.0], [x + 1.0, x % 4.0]]);
        }
        positions.extend((0..40).map(|i| [f64::from(i) - 1.0, -1.5]));
        let facets = (0..16).map(|k| [2 * k, 2 * k + 1]).collect();
        let scene = Scene::still(positions, facets, 0.02);
        check(&scene.moved(|i, x| if i < 32 { x } else { [x[0] + f64::from(wide), 5.5] }));
    }
}

#[test]
fn a_node_that_crosses_a_thin_body_within_one_step_is_found() {
    let plate = vec![[0.0, 0.0], [0.0, 1e-4], [1.0, 1e-4], [1.0, 0.0], [0.5, 0.3]];
    let facets = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    let scene = Scene::still(plate, facets, 1e-9).moved(|i, x| if i == 4 { [0.5, -0.3] } else { x });
    check(&scene);
    let crossed: Vec<_> = scene.pairs("grid").iter().filter(|p| p.slave == 4).map(|p| p.facet).collect();
    assert_eq!(crossed, [1, 3]);
}

#[test]
fn many_threads_find_the_same_pairs() {
    let mut bodies = (vec![], vec![]);
    for k in 0..1500 {
        ring(&mut bodies, [f64::from(k % 40) * 1.9, f64::from(k / 40) * 2.1], 1.0, 17);
    }
    let scene = Scene::still(bodies.0, bodies.1, 0.1).moved(|i, x| [x[0] + 0.01 * (i % 7) as f64, x[1]]);
    let alone = scene.pairs("grid");
    assert!(alone.len() > 5000, "{}", alone.len());
    for threads in [1, 2, 3, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| scene.pairs("grid")), alone, "{threads} threads");
    }
}

#[test]
fn a_position_that_is_no_number_hides_no_facet_after_it() {
    // Wherever it lies in a long chain, the facets that follow are found.
    let positions: Vec<_> = (0..40).map(|i| [f64::from(i), 0.0]).chain((0..40).map(|i| [f64::from(i), 0.01])).collect();
    let clean = Scene::still(positions, (0..39).map(|i| [i, i + 1]).collect(), 0.02);
    for bad in 0..40 {
        let mut scene = clean.clone();
        scene.new[bad][1] = f64::NAN;
        check(&scene);
    }
}

#[test]
fn positions_that_are_not_numbers_meet_nothing_and_disturb_nothing() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for d in 0..2 {
            let clean = touching_squares(12);
            let mut scene = clean.clone();
            scene.new[7][d] = bad;
            scene.old[20][1 - d] = bad;
            check(&scene);
            let without =
                |p: &Pair| ![7, 20].iter().any(|n| clean.slaves[p.slave as usize] == *n || clean.facets[p.facet as usize].contains(n));
            for kind in registry::<2>().iter().filter(|k| k.name != "brute_force") {
                let expected: Vec<_> = clean.pairs(kind.name).into_iter().filter(without).collect();
                assert_eq!(scene.pairs(kind.name), expected, "{}", kind.name);
            }
            check(&Scene::<2> { old: vec![[bad; 2]; 37], ..clean });
        }
    }
}

#[test]
fn numbers_near_the_end_of_the_range_are_no_trouble() {
    for x in [1e-320, 1e-300, 1e150, 1e300, f64::MAX] {
        let positions = vec![[0.0, 0.0], [x, 0.0], [x, -x], [0.5 * x, 0.0], [0.0, x], [-x, -x], [1.0, 1.0]];
        for reach in [0.0, 1.0, x, f64::MAX, f64::INFINITY] {
            let scene = Scene::still(positions.clone(), vec![[0, 1], [2, 1], [4, 5], [5, 2]], reach);
            for kind in registry::<2>() {
                let found = scene.pairs(kind.name);
                // A node on the first facet's line, whatever the scale.
                assert!(reach == 0.0 || found.contains(&Pair { slave: 3, facet: 0 }), "{} {x:e} {reach:e}", kind.name);
                assert!(reach < f64::INFINITY || found == scene.pairs("brute_force"), "{} {x:e}", kind.name);
            }
        }
    }
    // A reach that makes no sense counts as none.
    for reach in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        assert_eq!(Scene { reach, ..touching_squares(4) }.pairs("grid"), Scene { reach: 0.0, ..touching_squares(4) }.pairs("grid"));
    }
}

#[test]
fn a_node_lost_in_3d_makes_the_grid_neither_large_nor_slow() {
    let n = 20_000_u32;
    let mut positions: Vec<_> = (0..=n).map(|i| [f64::from(i) * 1e-3, 0.0]).collect();
    positions.extend((0..=n).map(|i| [f64::from(i) * 1e-3, 5e-4]));
    let chain = |first: u32| (0..n).map(move |i| [first + i, first + i + 1]);
    let mut scene = Scene::still(positions, chain(0).collect(), 1e-4);
    scene.slaves = (n + 1..2 * n + 2).collect();
    let expected = scene.pairs("grid").len();
    scene.old[5] = [1e15, -1e14];
    scene.new[5] = [1e15, -1e14];
    // The two long facets to the lost node, where coordinates round by metres, may meet every slave; the rest
    // is as before. A quadratic search would not end here.
    let found = scene.pairs("grid").len();
    assert!(found.abs_diff(expected) <= 2 * scene.slaves.len(), "{found} {expected}");
}

#[test]
fn surfaces_in_3d_are_found() {
    let scene = sheet(5, 0.0, 0.1);
    check(&scene);
    let mut two = sheet(4, 0.0, 0.3);
    let above = sheet(4, 0.2, 0.3);
    let shift = two.old.len() as u32;
    two.old.extend(above.old);
    two.facets.extend(above.facets.iter().map(|f| f.map(|n| n + shift)));
    two.slaves = (0..two.old.len() as u32).collect();
    let two = two.moved(|i, x| if i < 25 { [x[0] + 0.6, x[1], x[2] + 0.5] } else { x });
    check(&two);
    assert!(two.pairs("grid").len() > 100);
}

#[test]
fn long_surfaces_that_wind_through_a_large_plane_are_found() {
    // A grid that is rolled up: far more cells than facets, crossed in every direction.
    let spiral = |turns: f64, shift: f64| {
        move |i: u32| {
            let phase = f64::from(i) / 500.0 * turns;
            [(30.0 * phase + shift) * phase.cos(), (30.0 * phase + shift) * phase.sin()]
        }
    };
    let positions: Vec<_> = (0..500).map(spiral(12.0, 0.0)).chain((0..500).map(spiral(12.0, 0.8))).collect();
    let scene =
        Scene::still(positions, (0..499).map(|i| [i, i + 1]).collect(), 0.4).moved(|i, x| [x[0] + 0.3, x[1] - 0.01 * (i % 7) as f64]);
    check(&scene);
    let found = scene.pairs("grid").len();
    assert!(found > 100, "{found}");
}

#[test]
fn slanted_layers_meet_their_neighbours_only() {
    // Ten layers at 1 in 4, a fifth of a segment apart, so that a box along the axes around a segment would
    // reach through five or six.
    let (wide, layers) = (50_u32, 10_u32);
    let (sin, cos) = 0.25_f64.atan().sin_cos();
    let at = |i: u32| {
        let (s, n) = (f64::from(i % (wide + 1)), 0.2 * f64::from(i / (wide + 1)));
        [s * cos - n * sin, s * sin + n * cos]
    };
    let facets = (0..layers).flat_map(|l| (0..wide).map(move |i| [l * (wide + 1) + i, l * (wide + 1) + i + 1]));
    let scene =
        Scene::still((0..layers * (wide + 1)).map(at).collect(), facets.collect(), 0.25).moved(|i, x| [x[0] + 1e-3 * (i % 3) as f64, x[1]]);
    check(&scene);
    for pair in scene.pairs("grid") {
        assert!(
            (scene.slaves[pair.slave as usize] / (wide + 1)).abs_diff(scene.facets[pair.facet as usize][0] / (wide + 1)) <= 1,
            "{pair:?}"
        );
    }
}

/// Coordinates of several scales around several places.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -1.0..1.0, 2 => -10.0..10.0, 1 => -1e-6..1e-6, 1 => (0..4_i32).prop_map(f64::from), 1 => -1e4..1e4]
}

fn any_scene<const D: usize>() -> impl Strategy<Value = Scene<D>> {
    let point = || prop::collection::vec(coordinate(), D).prop_map(|v| -> [f64; D] { std::array::from_fn(|d| v[d]) });
    let reach = prop_oneof![Just(0.0), 1e-6..1e-3, 0.01..1.0_f64, Just(5.0)];
    (2_usize..30, reach, prop_oneof![Just(0.0), Just(0.01), Just(1.0), Just(1e3)], prop_oneof![4 => Just(0.0), 1 => Just(1e9)])
        .prop_flat_map(move |(n, reach, speed, offset)| {
            let nodes = prop::collection::vec((point(), point()), n);
            let index = 0..n as u32;
            let facets = prop::collection::vec(prop::collection::vec(index.clone(), D), 0..40);
            let slaves = prop::collection::vec(index, 0..40);
            (nodes, facets, slaves, any::<bool>()).prop_map(move |(nodes, facets, slaves, chain)| Scene {
                old: nodes.iter().map(|(x, _)| x.map(|c| c + offset)).collect(),
                new: nodes.iter().map(|(x, v)| std::array::from_fn(|d| x[d] + offset + speed * v[d])).collect(),
                slaves,
                // Either any nodes or chains, as surfaces have them.
                facets: facets
                    .iter()
                    .enumerate()
                    .map(|(i, f)| std::array::from_fn(|d| if chain { ((i + d) % n) as u32 } else { f[d] }))
                    .collect(),
                reach,
            })
        })
}

/// Rings of many sizes in random places that move and grow.
fn any_bodies() -> impl Strategy<Value = Scene<2>> {
    let body = (-8.0..8.0_f64, -8.0..8.0_f64, prop_oneof![0.5..3.0_f64, 0.01..0.1_f64], 3_usize..20, -2.0..2.0_f64, -2.0..2.0_f64);
    (prop::collection::vec(body, 1..7), 0.0..0.5_f64, prop_oneof![Just(0.01), Just(1.0), Just(20.0)]).prop_map(|(bodies, reach, speed)| {
        let mut all = (vec![], vec![]);
        let mut velocity = vec![];
        for (x, y, radius, n, u, v) in bodies {
            ring(&mut all, [x, y], radius, n);
            velocity.resize(all.0.len(), [u * speed, v * speed]);
        }
        Scene::still(all.0, all.1, reach).moved(|i, x| [x[0] + velocity[i][0], x[1] + velocity[i][1]])
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: samples(192), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_search_keeps_its_promises_on_any_segments(scene in any_scene::<2>()) {
        check(&scene);
    }
    #[test]
    fn every_search_keeps_its_promises_on_any_triangles(scene in any_scene::<3>()) {
        check(&scene);
    }
    #[test]
    fn every_search_keeps_its_promises_on_any_bodies(scene in any_bodies()) {
        check(&scene);
    }
}
