//! The swept check against an exact oracle: no way into a body is missed, and none is reported that is not
//! there.
//!
//! Bodies, their motions and the nodes' paths lie on a small lattice, so degenerate ones are common: through
//! vertices, along sides, grazing, sides that collapse. The oracle decides in whole numbers, roots of
//! quadratics as p + q √D. Maps that keep orientation then make thin, sheared and turned bodies of them; they
//! keep what is a crossing. Powers of two keep every bit as well, so there the oracle is exact; other maps
//! round, and a path that touches may then be seen on either side.
#![allow(clippy::unwrap_used)] // what tests call may stop a test like the tests themselves

use embate_solver::bench::Random;
use embate_solver::contact::projection::node_segment::{Target, Vector};
use embate_solver::mesh::surface::{NONE, Surface};

type Point = [i128; 2];

/// What the swept check must say of a node and a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// The node goes from in front of the segment to behind it, over the segment or one of its ends.
    Enters,
    /// The same, from a place on the segment at the beginning of the step.
    EntersFromOn,
    /// It meets the segment but does not change sides, or ends on it, or meets it while it has no length, or
    /// passes its end by rounding.
    Touches,
    /// None of these.
    Free,
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Point, b: Point) -> i128 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Point, b: Point) -> i128 {
    a[0] * b[0] + a[1] * b[1]
}

/// (p + q √d) / m with m > 0, d ≥ 0.
#[derive(Clone, Copy, Debug)]
struct Time {
    p: i128,
    q: i128,
    d: i128,
    m: i128,
}

impl Time {
    fn value(self) -> f64 {
        (self.p as f64 + self.q as f64 * (self.d as f64).sqrt()) / self.m as f64
    }

    /// Sign of c₀ + c₁ t + c₂ t².
    fn sign_of(self, [c0, c1, c2]: [i128; 3]) -> i128 {
        let Self { p, q, d, m } = self;
        let whole = c2 * (p * p + q * q * d) + c1 * m * p + c0 * m * m;
        let root = 2 * c2 * p * q + c1 * m * q;
        let (whole_squared, root_squared) = (whole * whole, root * root * d);
        match (whole.signum(), root.signum() * d.signum()) {
            (w, 0) => w,
            (0, r) => r,
            (w, r) if w == r => w,
            (w, r) => match whole_squared.cmp(&root_squared) {
                std::cmp::Ordering::Greater => w,
                std::cmp::Ordering::Less => r,
                std::cmp::Ordering::Equal => 0,
            },
        }
    }
}

/// Coefficients of the product of two linear functions of time.
fn product(of: fn(Point, Point) -> i128, [a0, da]: [Point; 2], [b0, db]: [Point; 2]) -> [i128; 3] {
    [of(a0, b0), of(a0, db) + of(da, b0), of(da, db)]
}

/// Ends are passed by rounding within 1 / `END` of the segment's length.
const END: i128 = 500_000;

/// Exact answer for a node and a segment a → b, each with its positions at the beginning and at the end; and
/// the time at which the side falls.
fn verdict(node: [Point; 2], a: [Point; 2], b: [Point; 2]) -> (Verdict, f64) {
    let motion = |from: [Point; 2], to: [Point; 2]| {
        let (begin, end) = (minus(to[0], from[0]), minus(to[1], from[1]));
        [begin, minus(end, begin)]
    };
    let (e, r) = (motion(a, b), motion(a, node));
    let side = product(cross, e, r);
    let [c0, c1, c2] = side;
    let d = c1 * c1 - 4 * c2 * c0;
    // The time at which f = c₀ + c₁ t + c₂ t² falls through zero, or touches it: there is at most one.
    let time = match c2.signum() {
        _ if side == [0; 3] => return (Verdict::Touches, 0.0),
        0 if c1 < 0 => Time { p: c0, q: 0, d: 0, m: -c1 },
        0 => return (Verdict::Free, f64::NAN),
        _ if d < 0 => return (Verdict::Free, f64::NAN),
        sign => Time { p: -sign * c1, q: -sign, d, m: 2 * sign * c2 },
    };
    let (begun, left) = (time.sign_of([0, 1, 0]), time.sign_of([1, -1, 0]));
    let (along, whole) = (product(dot, r, e), product(dot, e, e));
    let rest = [0, 1, 2].map(|i| whole[i] - along[i]);
    let place = [along, rest].map(|way| (time.sign_of(way), time.sign_of([0, 1, 2].map(|i| END * way[i] + whole[i]))));
    let is_far = if time.sign_of(whole) == 0 { time.sign_of(product(dot, r, r)) != 0 } else { place.iter().any(|&(_, near)| near < 0) };
    let beside = place.iter().any(|&(within, _)| within < 0);
    let (has_no_length, grazes) = (time.sign_of(whole) == 0, c2 > 0 && d == 0);
    let verdict = if begun < 0 || left < 0 || is_far {
        Verdict::Free
    } else if left == 0 || beside || has_no_length || grazes || (begun > 0 && d == 0 && c2 < 0) {
        Verdict::Touches
    } else if begun == 0 {
        Verdict::EntersFromOn
    } else {
        Verdict::Enters
    };
    (verdict, time.value())
}

/// Winding number of a closed polygon around `x`; `None` on the polygon.
fn winding(x: Point, polygon: &[Point]) -> Option<i32> {
    let mut sum = 0;
    for (i, &p) in polygon.iter().enumerate() {
        let (a, b) = (minus(p, x), minus(polygon[(i + 1) % polygon.len()], x));
        let turn = cross(a, b);
        if turn == 0 && dot(a, b) <= 0 {
            return None;
        }
        sum += match (a[1] <= 0, b[1] <= 0) {
            (true, false) => i32::from(turn > 0),
            (false, true) => -i32::from(turn < 0),
            _ => 0,
        };
    }
    Some(sum)
}

/// Whether two closed segments have a point in common.
fn meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let turn = |a: Point, b: Point, c: Point| cross(minus(b, a), minus(c, a)).signum();
    let on = |a: Point, b: Point, c: Point| turn(a, b, c) == 0 && dot(minus(a, c), minus(b, c)) <= 0;
    (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) || on(a, b, c) || on(a, b, d) || on(c, d, a) || on(c, d, b)
}

/// Whether no sides meet but neighbours in their corner, and the body is on the right.
fn is_simple(polygon: &[Point]) -> bool {
    let n = polygon.len();
    let side = |i: usize| [polygon[i % n], polygon[(i + 1) % n]];
    let apart = (0..n).all(|i| (i + 2..n).all(|j| (j + 1) % n == i || !meet(side(i), side(j))));
    let open = (0..n).all(|i| {
        let ([a, b], [_, c]) = (side(i), side(i + 1));
        cross(minus(b, a), minus(c, b)) != 0 || dot(minus(b, a), minus(c, b)) > 0
    });
    apart && open && (0..n).map(|i| cross(polygon[i], polygon[(i + 1) % n])).sum::<i128>() < 0
}

/// Random points and polygons of whole numbers.
struct Lattice(Random);

impl Lattice {
    fn new(place: u64) -> Self {
        Self(Random::new(place))
    }

    fn below(&mut self, n: u64) -> u64 {
        self.0.bits() % n
    }

    fn point(&mut self, range: u64) -> Point {
        [0; 2].map(|_| i128::from(self.below(2 * range + 1)) - i128::from(range))
    }

    /// A simple polygon: random corners, sides that cross turned around until none do.
    fn polygon(&mut self, corners: usize, range: u64) -> Vec<Point> {
        loop {
            let mut polygon: Vec<Point> = (0..corners).map(|_| self.point(range)).collect();
            for _ in 0..4 * corners {
                let crossing = (0..corners)
                    .flat_map(|i| (i + 2..corners).map(move |j| (i, j)))
                    .find(|&(i, j)| (j + 1) % corners != i && meet([polygon[i], polygon[i + 1]], [polygon[j], polygon[(j + 1) % corners]]));
                let Some((i, j)) = crossing else { break };
                polygon[i + 1..=j].reverse();
            }
            if !is_simple(&polygon) {
                polygon.reverse();
            }
            if is_simple(&polygon) {
                let first = self.below(corners as u64) as usize;
                polygon.rotate_left(first);
                return polygon;
            }
        }
    }

    /// Where a polygon goes in a step: anywhere, bodily, turned by right angles, or with its corners shaken.
    fn moved(&mut self, old: &[Point], range: u64) -> Vec<Point> {
        let shift = self.point(range);
        let turned = |[x, y]: Point, turns: u64| [[x, y], [-y, x], [-x, -y], [y, -x]][turns as usize];
        let plus = |p: Point| [p[0] + shift[0], p[1] + shift[1]];
        match self.below(4) {
            0 => return self.polygon(old.len(), range),
            1 => return old.iter().map(|&p| plus(p)).collect(),
            2 => {
                let turns = self.below(4);
                return old.iter().map(|&p| plus(turned(p, turns))).collect();
            }
            _ => {}
        }
        for _ in 0..8 {
            let shaken: Vec<Point> = old
                .iter()
                .map(|&p| {
                    let [x, y] = self.point(2);
                    [p[0] + x, p[1] + y]
                })
                .collect();
            if is_simple(&shaken) {
                return shaken;
            }
        }
        old.to_vec()
    }
}

/// An affine map that keeps orientation.
#[derive(Clone, Copy, Debug)]
struct Map {
    matrix: [Vector; 2],
    shift: Vector,
    /// No product of lattice points rounds.
    exact: bool,
}

impl Map {
    const fn exact(matrix: [Vector; 2], shift: Vector) -> Self {
        Self { matrix, shift, exact: true }
    }

    const fn rounding(matrix: [Vector; 2], shift: Vector) -> Self {
        Self { matrix, shift, exact: false }
    }

    fn of(&self, p: Point) -> Vector {
        let p = p.map(|c| c as f64);
        [0, 1].map(|d| self.matrix[d][0] * p[0] + self.matrix[d][1] * p[1] + self.shift[d])
    }
}

/// As it is, thin, huge, sheared, far away; then the same with rounding, turned.
const MAPS: [Map; 10] = [
    Map::exact([[1.0, 0.0], [0.0, 1.0]], [0.0, 0.0]),
    Map::exact([[1.0, 0.0], [0.0, 1.0 / 4096.0]], [0.0, 0.0]),
    Map::exact([[1.0 / 1048576.0, 0.0], [0.0, 8.0]], [0.0, 0.0]),
    Map::exact([[1.0, 0.0], [3.0, 1.0 / 64.0]], [0.0, 0.0]),
    Map::exact([[0.0, -0.5], [2.0, 0.0]], [1024.0, -4096.0]),
    Map::rounding([[0.1, 0.0], [0.0, 0.1]], [0.0, 0.0]),
    Map::rounding([[0.1, 0.0], [0.0, 1e-5]], [0.0, 0.0]),
    Map::rounding(
        [[0.3 * 0.764_842_187_284_488_5, -0.3 * 0.644_217_687_237_691], [0.3 * 0.644_217_687_237_691, 0.3 * 0.764_842_187_284_488_5]],
        [0.0, 0.0],
    ),
    Map::rounding([[0.955, -2.9e-4], [0.295, 9.55e-4]], [0.0, 0.0]),
    Map::rounding([[0.1, 0.0], [0.0, 0.1]], [100.3, -70.7]),
];

/// A closed chain of corners, body on the right.
fn closed(corners: usize) -> Target {
    let n = corners as u32;
    let surface = Surface::<2> {
        segments: (0..n).map(|s| [s, (s + 1) % n]).collect(),
        previous: (0..n).map(|s| (s + n - 1) % n).collect(),
        next: (0..n).map(|s| (s + 1) % n).collect(),
        nodes: (0..n).collect(),
    };
    Target { surface, mirrors: Vec::new() }
}

/// One segment from node 0 to node 1.
fn alone() -> Target {
    let surface = Surface::<2> { segments: vec![[0, 1]], previous: vec![NONE], next: vec![NONE], nodes: vec![0, 1] };
    Target { surface, mirrors: Vec::new() }
}

/// How often the oracle said what, and where the swept check said otherwise.
#[derive(Debug, Default)]
struct Tally {
    enters: usize,
    enters_from_on: usize,
    touches: usize,
    free: usize,
    ends_inside: usize,
    goes_through: usize,
    faults: Vec<String>,
}

impl Tally {
    fn passes(&self) {
        assert!(self.faults.is_empty(), "{} faults, the first: {}", self.faults.len(), self.faults[0]);
    }
}

/// Compares segment `s` of `target` with the oracle, a node and the segment's ends given as they are and
/// mapped; whether a crossing is reported.
fn compare(target: &Target, s: u32, [node, a, b]: [[Point; 2]; 3], points: [&[Vector]; 2], map: &Map, tally: &mut Tally) -> bool {
    let x = node.map(|x| map.of(x));
    let found = target.crossing(x[0], x[1], s, points[0], points[1]);
    let (verdict, exact) = verdict(node, a, b);
    let right = match verdict {
        Verdict::Enters => {
            tally.enters += 1;
            found.is_some_and(|time| (time - exact).abs() < 1e-6)
        }
        Verdict::EntersFromOn => {
            tally.enters_from_on += 1;
            // Where rounding decides about on, above and below, what counts is what the local search says.
            let outside = map.exact || target.project(x[0], s, points[0]).is_some_and(|projection| projection.gap >= 0.0);
            found.is_some() || !outside
        }
        Verdict::Touches => {
            tally.touches += 1;
            true
        }
        Verdict::Free => {
            tally.free += 1;
            found.is_none()
        }
    };
    if !right || found.is_some_and(|time| !(0.0..=1.0).contains(&time)) {
        tally.faults.push(format!("{verdict:?} {exact} but {found:?}: node {node:?}, {a:?} to {b:?}, {map:?}"));
    }
    found.is_some()
}

/// Compares all segments of a body with the oracle, and the body as a whole.
fn compare_body(old: &[Point], new: &[Point], node: [Point; 2], map: &Map, tally: &mut Tally) {
    let n = old.len();
    let target = closed(n);
    let [points_old, points_new] = [old, new].map(|polygon| polygon.iter().map(|&p| map.of(p)).collect::<Vec<_>>());
    let mut reported = false;
    for s in 0..n {
        let next = (s + 1) % n;
        let pair = [node, [old[s], new[s]], [old[next], new[next]]];
        reported |= compare(&target, s as u32, pair, [&points_old, &points_new], map, tally);
    }
    // Anyone who has the body around at some time and had not at the beginning came in, however degenerate
    // the way.
    const TIMES: i128 = 12;
    let at = |time: i128, [begin, end]: [Point; 2]| [0, 1].map(|d| (TIMES - time) * begin[d] + time * end[d]);
    let around = |time: i128| {
        let polygon: Vec<Point> = (0..n).map(|i| at(time, [old[i], new[i]])).collect();
        winding(at(time, node), &polygon)
    };
    let before = match around(0) {
        // On it is outside.
        None if map.exact => 0,
        None => return,
        Some(before) => before,
    };
    let inside = |time: i128| around(time).is_some_and(|now| now < before);
    let (after, meanwhile) = (inside(TIMES), (1..TIMES).any(inside));
    tally.ends_inside += usize::from(after);
    tally.goes_through += usize::from(meanwhile && !after);
    if (after || meanwhile) && !reported {
        tally.faults.push(format!("body: {node:?}, {old:?} to {new:?}, {map:?}"));
    }
}

#[test]
fn bodies_in_motion_are_entered_where_whole_numbers_say() {
    let mut random = Lattice::new(3);
    let mut tally = Tally::default();
    for motion in 0..12_000 {
        let range = [2, 3, 5, 9][motion % 4];
        let corners = 3 + random.below(if range < 3 { 4 } else { 10 }) as usize;
        let old = random.polygon(corners, range);
        let new = random.moved(&old, range);
        for _ in 0..4 {
            let node = [random.point(range + 1), random.point(range + 1)];
            let map = &MAPS[random.below(MAPS.len() as u64) as usize];
            compare_body(&old, &new, node, map, &mut tally);
        }
    }
    tally.passes();
    let Tally { enters, enters_from_on, touches, free, ends_inside, goes_through, .. } = tally;
    assert!(enters > 20_000 && enters_from_on > 3000 && touches > 3000 && free > 200_000 && ends_inside > 4000 && goes_through > 10_000);
}

#[test]
fn lone_segments_that_do_anything_are_entered_where_whole_numbers_say() {
    // Segments without length at an end of the step too, nodes that begin or end on segments, everything on
    // few places.
    let mut random = Lattice::new(4);
    let mut tally = Tally::default();
    let target = alone();
    for motion in 0..200_000 {
        let range = [1, 2, 4, 12][motion % 4];
        let pair = [0; 3].map(|_| [random.point(range), random.point(range)]);
        let map = &MAPS[random.below(MAPS.len() as u64) as usize];
        let points = [0, 1].map(|time| [map.of(pair[1][time]), map.of(pair[2][time])]);
        compare(&target, 0, pair, [&points[0], &points[1]], map, &mut tally);
    }
    tally.passes();
    assert!(tally.enters > 20_000 && tally.enters_from_on > 5000 && tally.touches > 10_000 && tally.free > 100_000);
}

/// A lattice point, the unit a tenth and off by a few last bits, and the same in whole multiples of 2⁻⁵⁶:
/// exactly what the numbers are.
fn shaken_bits(random: &mut Lattice, p: Point) -> (Vector, Point) {
    let x = p.map(|c| c as f64 * 0.1 + (random.below(7) as f64 - 3.0) * f64::EPSILON / 2.0);
    (x, x.map(|c| (c * 2.0_f64.powi(56)) as i128))
}

#[test]
fn rounding_hides_no_way_in() {
    let mut random = Lattice::new(5);
    let (mut came_in, mut by_rounding) = (0, 0);
    for motion in 0..30_000 {
        let corners = 3 + random.below(4) as usize;
        let range = 2 + motion % 3;
        let old = random.polygon(corners, range);
        let new = random.moved(&old, range);
        let nodes = [random.point(range), random.point(range)];
        let bodies = [old, new].map(|body| body.into_iter().map(|p| shaken_bits(&mut random, p)).unzip::<_, _, Vec<_>, Vec<_>>());
        let [from, to] = nodes.map(|p| shaken_bits(&mut random, p));
        let [(old, old_exact), (new, new_exact)] = bodies;
        if winding(from.1, &old_exact).is_some_and(|around| around != 0) || winding(to.1, &new_exact) != Some(-1) {
            continue;
        }
        came_in += 1;
        let target = closed(corners);
        let all: Vec<u32> = (0..corners as u32).collect();
        if !all.iter().any(|&s| target.crossing(from.0, to.0, s, &old, &new).is_some()) {
            // The local search sees it inside from the beginning, or still outside at the end, by the last
            // bits.
            let gap = |x: Vector, points: &[Vector]| target.nearest(x, &all, points).unwrap().gap;
            let (before, after) = (gap(from.0, &old), gap(to.0, &new));
            let rounds = |gap: f64| gap.abs() < 4.0 * f64::EPSILON;
            assert!(
                (before < 0.0 && rounds(before)) || (after >= 0.0 && rounds(after)),
                "{before} {after}: {from:?} {to:?} {old:?} {new:?}"
            );
            by_rounding += 1;
        }
    }
    assert!(came_in > 3000 && by_rounding < came_in / 1000);
}

/// Segment and time.
type Entry = (u32, f64);

/// Segments that report a node's way from `from` to `to`, with the times.
fn entered(target: &Target, [from, to]: [Vector; 2], old: &[Vector], new: &[Vector]) -> Vec<Entry> {
    (0..target.surface.segments.len() as u32).filter_map(|s| Some((s, target.crossing(from, to, s, old, new)?))).collect()
}

#[test]
fn over_a_vertex_every_side_that_is_gone_behind_says_so() {
    // Left 0, then the notch's sides 1 to 4 above (convex corner, notch, convex corner), right 5, below 6.
    let body = [[0.0, 0.0], [0.0, 6.0], [2.0, 6.0], [4.0, 2.0], [6.0, 6.0], [8.0, 6.0], [8.0, 0.0]];
    let target = closed(body.len());
    let cases: [([Vector; 2], &[Entry]); 7] = [
        ([[10.0, 8.0], [6.0, 4.0]], &[(4, 0.5), (5, 0.5)]), // in over a convex corner
        ([[4.0, 3.0], [4.0, 1.0]], &[(2, 0.5), (3, 0.5)]),  // in over the notch
        ([[4.25, 3.0], [3.75, 1.0]], &[(2, 0.5), (3, 0.5)]),
        ([[5.0, 4.0], [3.0, 0.0]], &[(2, 0.5)]), // along the right side of the notch, in below its end
        ([[6.0, 8.0], [10.0, 4.0]], &[(4, 0.5)]), // grazing a convex corner: the side above is gone behind, beyond its end
        ([[6.0, 4.0], [10.0, 8.0]], &[]),        // out
        ([[0.25, 6.0], [1.75, 6.0]], &[]),       // along the top
    ];
    for (path, sides) in cases {
        assert_eq!(entered(&target, path, &body, &body), sides, "{path:?}");
        // The body moves instead.
        let way = [path[1][0] - path[0][0], path[1][1] - path[0][1]];
        let moved = body.map(|p| [p[0] - way[0], p[1] - way[1]]);
        assert_eq!(entered(&target, [path[0]; 2], &body, &moved), sides, "{path:?}");
    }
    // Who grazed the corner is outside, says the local search.
    assert!(target.follow([10.0, 4.0], 4, &body).is_some_and(|projection| projection.gap > 0.0));
}

#[test]
fn a_graze_is_no_way_in_and_the_slightest_dip_is() {
    // The segment turns about its first node; the side is 2 (1 − 2 t)² less twice the depth.
    let (old, new) = ([[0.0, 0.0], [2.0, 2.0]], [[0.0, 0.0], [2.0, -2.0]]);
    let target = alone();
    let side = |depth: f64| entered(&target, [[0.0, 1.0 - depth], [2.0, -1.0 - depth]], &old, &new);
    assert_eq!(side(0.0), []);
    for exponent in (2..=50).step_by(2) {
        let depth = 2.0_f64.powi(-exponent);
        assert_eq!(side(-depth), [], "{exponent}");
        let time = 0.5 - 0.5 * depth.sqrt();
        let found = side(depth);
        assert!(found.len() == 1 && (found[0].1 - time).abs() < 1e-15 / depth.sqrt(), "{exponent}: {found:?} {time}");
    }
}

#[test]
fn along_a_segment_and_together_with_it_there_is_no_way_in() {
    let target = alone();
    let [a, b] = [[-3.0, -1.0], [5.0, 3.0]];
    let on = |s: f64| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
    for [from, to] in [[0.25, 0.75], [0.75, 0.25], [-0.5, 1.5], [1.5, -0.5], [0.0, 1.0], [1.0, 0.0], [0.5, 0.5], [0.0, 0.0], [1.0, 1.0]] {
        assert_eq!(entered(&target, [on(from), on(to)], &[a, b], &[a, b]), [], "{from} {to}");
    }
    // Bodily motion, as far as it goes: on it, a last bit above it, and clear of it.
    for far in [0.25, 1024.0, 1048576.0] {
        let moved = |p: Vector| [p[0] + far, p[1] - far];
        for above in [0.0, 2.0_f64.powi(-30), 1.0] {
            let x = [1.0, 1.0 + above];
            assert_eq!(entered(&target, [x, moved(x)], &[a, b], &[moved(a), moved(b)]), [], "{far} {above}");
        }
    }
}

#[test]
fn a_segment_that_shrinks_to_a_point_is_met_there_only() {
    let target = alone();
    let (wide, point, turned) = ([[-2.0, 0.0], [2.0, 0.0]], [[0.0, 0.0]; 2], [[2.0, 0.0], [-2.0, 0.0]]);
    let down = [[0.5, 1.0], [0.5, -1.0]];
    // It opens or closes while the node comes down: between its ends half way.
    assert_eq!(entered(&target, down, &point, &wide), [(0, 0.5)]);
    assert_eq!(entered(&target, down, &wide, &point), [(0, 0.5)]);
    assert_eq!(entered(&target, down, &point, &point), []);
    // It turns over in its own line: outside becomes inside with no one going through.
    for x in [0.0, 0.5, 1.0, 3.0] {
        for y in [1e-6, 0.1, 1.0, 7.0] {
            assert_eq!(entered(&target, [[x, y]; 2], &wide, &turned), [], "{x} {y}");
            let shaken = turned.map(|p| [p[0] + 0.1, p[1] + 0.1 * y]);
            assert_eq!(entered(&target, [[x, y]; 2], &wide, &shaken), [], "{x} {y}");
        }
    }
}

#[test]
fn a_node_that_comes_from_far_away_meets_a_tiny_segment_between_its_ends_only() {
    let length = 1e-9;
    let target = alone();
    let segment = [[0.0, 0.0], [length, 0.0]];
    for far in [1e-6, 1.0, 1e3, 1e6] {
        for (s, is_met) in [(-1e-5, false), (1e-5, true), (0.5, true), (1.0 - 1e-5, true), (1.0 + 1e-5, false)] {
            let to = [s * length, -1e-6 * length];
            let found = entered(&target, [[-0.8 * far, 0.6 * far], to], &segment, &segment);
            assert_eq!(found.len(), usize::from(is_met), "{far} {s}");
        }
    }
}

#[test]
fn who_dips_by_a_last_bit_or_between_last_bits_is_found() {
    // Slides on a segment that moves: whether in front or behind, rounding decides, and the next step must
    // not find an intruder that no one saw come. On the other segment, which turns, the node goes far behind
    // in between, and ends on it.
    let slides = ([[0.1, -0.3], [0.8, 0.1]], [[0.1, -0.29], [0.8, 0.09]], false);
    let turns = ([[0.1, -0.3], [0.5, 0.5]], [[0.1, -0.3], [0.9, -0.7]], true);
    let mut random = Lattice::new(6);
    let target = alone();
    for (old, new, dips) in [slides, turns] {
        let mut found = 0;
        for _ in 0..50_000 {
            let mut near = |p: Vector| p.map(|c| c + (random.below(5) as f64 - 2.0) * f64::EPSILON / 4.0);
            let (old, new) = (old.map(&mut near), new.map(&mut near));
            let on = |[a, b]: [Vector; 2], s: f64| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
            let path = [near(on(old, 0.3)), near(on(new, 0.7))];
            let gap = |x: Vector, points: &[Vector]| target.project(x, 0, points).unwrap().gap;
            if gap(path[0], &old) >= 0.0 && (dips || gap(path[1], &new) < 0.0) {
                found += 1;
                assert_eq!(entered(&target, path, &old, &new).len(), 1, "{path:?} {old:?} {new:?}");
            }
        }
        assert!(found > 5000, "{found}");
    }
}
