//! Bodies that a round tool presses on, meshed again and again.

use super::tests::{Random, polygon, star};
use super::*;
use crate::plane::{Mesh, distance};
use crate::relocate::{Body, relocated_outside};

/// Radius of the tool and of the free surface beside it, m, and the slope at the rim of the dent.
const TOOL: f64 = 4.0;
const FREE: f64 = 12.0;
const RIM: f64 = 0.5;
/// Size of the elements.
const SIZE: f64 = 0.5;

/// A body with a dent: its surface follows the tool, whose middle is at (`x`, 0), as far as the rim at the
/// angle `RIM`, and continues without a kink, curved the other way, to a corner. The left half is left out
/// where `x` is 0 and the body is one of revolution.
struct Dent {
    x: f64,
    measure: Measure,
}

impl Dent {
    /// Middle of the circle of the free surface, on the right.
    fn free(&self) -> Point {
        [self.x + (TOOL + FREE) * RIM.sin(), -(TOOL + FREE) * RIM.cos()]
    }

    fn depth(&self, x: Point) -> f64 {
        TOOL - distance(x, [self.x, 0.0])
    }

    /// The place on the tool for one inside of it.
    fn outside(&self, spot: Spot) -> Option<Point> {
        let (middle, x) = ([self.x, 0.0], spot.place);
        (self.depth(x) > 0.0).then(|| [0, 1].map(|d| middle[d] + (x[d] - middle[d]) * (TOOL / distance(x, middle))))
    }

    /// The outline, its nodes on both circles as long as edges are.
    fn outline(&self) -> Outline {
        let mut half: Vec<Point> = Vec::new();
        let count = (TOOL * RIM / SIZE).round() as usize;
        for k in 0..=count {
            let angle = RIM * k as f64 / count as f64;
            half.push([TOOL * angle.sin(), -TOOL * angle.cos()]);
        }
        let end = RIM + 0.2;
        let count = (FREE * end / SIZE).round() as usize;
        for k in 1..=count {
            let angle = RIM - end * k as f64 / count as f64;
            half.push([self.free()[0] - self.x - FREE * angle.sin(), self.free()[1] + FREE * angle.cos()]);
        }
        let side = half[half.len() - 1][0];
        half.push([side, -12.0]);
        let is_half = self.measure == Measure::Revolution && self.x == 0.0;
        let mut points: Vec<Point> = if is_half { vec![[0.0, -12.0]] } else { half[1..].iter().map(|x| [self.x - x[0], x[1]]).collect() };
        if !is_half {
            points.reverse();
            points.extend(half.iter().map(|x| [self.x + x[0], x[1]]));
        } else {
            points = half.iter().copied().chain(points).collect();
        }
        points.reverse();
        polygon(&points)
    }

    /// Farthest off the circle of the free surface, of nodes more than `beside` away from the rim and from
    /// the corner at the end.
    fn off(&self, outline: &Outline, beside: f64) -> f64 {
        let rim = self.x + TOOL * RIM.sin() + beside;
        let end = outline.loops[0].iter().map(|x| x[0]).fold(0.0, f64::max) - beside;
        let is_there = |x: &&Point| x[0] > rim && x[0] < end && x[1] > -8.0;
        outline.loops[0].iter().filter(is_there).map(|x| (distance(*x, self.free()) - FREE).abs()).fold(0.0, f64::max)
    }
}

/// What has become of a dent.
struct Seen {
    /// Greatest depth of a node in the tool, and height of one over it in the middle of the dent at last, m.
    depth: f64,
    gap: f64,
    /// Greatest relative change of the measure in one event, and in all.
    event: f64,
    all: f64,
    /// Farthest off the free surface two edges beside the rim at last, and half an edge beside it, m.
    off: f64,
    near: f64,
    measures: [f64; 2],
}

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { depth, gap, event, all, off, near, .. } = self;
        write!(f, "{depth:.1e} m deep, {gap:.1e} m over it, measure by {event:.0e} and {all:.0e}, off by {off:.1e} m, near {near:.1e} m")
    }
}

impl Seen {
    fn new(dent: &Dent, outline: &Outline) -> Self {
        let whole = volume::measured(dent.measure, &outline.loops);
        Self { depth: 0.0, gap: 0.0, event: 0.0, all: 0.0, off: 0.0, near: 0.0, measures: [whole; 2] }
    }

    fn look(&mut self, dent: &Dent, outline: &Outline) {
        let after = volume::measured(dent.measure, &outline.loops);
        self.event = self.event.max((after / self.measures[1] - 1.0).abs());
        self.all = (after / self.measures[0] - 1.0).abs();
        self.measures[1] = after;
        let points = &outline.loops[0];
        self.depth = points.iter().map(|&x| dent.depth(x)).fold(self.depth, f64::max);
        let is_in_dent = |x: &&Point| (x[0] - dent.x).abs() < 0.7 * TOOL * RIM.sin() && x[0] > 0.0 && x[1] > -8.0;
        self.gap = points.iter().filter(is_in_dent).map(|&x| -dent.depth(x)).fold(0.0, f64::max);
        [self.off, self.near] = [2.0 * SIZE, 0.5 * SIZE].map(|beside| dent.off(outline, beside));
    }
}

/// The dent after being meshed so often, by sizes that differ by so much.
fn again(dent: &Dent, rounds: usize, by: f64, kept_out: KeptOut<'_>) -> Seen {
    let mut now = dent.outline();
    let mut seen = Seen::new(dent, &now);
    for round in 0..rounds {
        let size = SIZE * (1.0 + by * ((round * 7 % 11) as f64 / 5.0 - 1.0));
        let meshed = quadrilaterals_outside(&now, &|_| size, dent.measure, 10_000, kept_out).unwrap();
        now = polygon(&meshed.loops[0].iter().map(|own| meshed.positions[own.node as usize]).collect::<Vec<_>>());
        seen.look(dent, &now);
    }
    seen
}

const DENTS: [Dent; 3] = [
    Dent { x: 0.0, measure: Measure::Plane },
    Dent { x: 0.0, measure: Measure::Revolution },
    Dent { x: 40.0, measure: Measure::Revolution },
];

#[test]
fn nodes_never_come_into_the_tool() {
    for dent in &DENTS {
        for by in [0.02, 0.1] {
            let seen = again(dent, 80, by, &|spot| dent.outside(spot));
            println!("{:?} at {}, sizes by {by}: {seen}", dent.measure, dent.x);
            let most = if by == 0.02 { 2e-3 } else { 6e-3 };
            assert!(seen.depth < 1e-12 && seen.gap < 1e-12 && seen.event < 1e-13 && seen.all < 1e-13 && seen.off < most * SIZE);
        }
    }
}

#[test]
fn without_a_tool_they_do() {
    for dent in &DENTS {
        let seen = again(dent, 80, 0.02, &anywhere);
        println!("{:?} at {}: {seen}", dent.measure, dent.x);
        assert!(seen.depth > 0.01 && seen.event < 1e-13);
    }
}

/// The same with nodes that are moved, after those inside were put at random places, how often there was a
/// better mesh, and how far the first of them was off the free surface, m: it has other spaces between nodes.
fn moved_again(dent: &Dent, rounds: usize, kept_out: KeptOut<'_>) -> (Seen, usize, f64) {
    let mut random = Random(5);
    let start = dent.outline();
    let Meshed { mut positions, cells, loops } = quadrilaterals_outside(&start, &|_| SIZE, dent.measure, 10_000, kept_out).unwrap();
    let loops: Vec<Vec<u32>> = loops.iter().map(|nodes| nodes.iter().map(|own| own.node).collect()).collect();
    let fixed: Vec<Vec<bool>> = loops.iter().map(|nodes| vec![false; nodes.len()]).collect();
    let line = |positions: &[Point]| polygon(&loops[0].iter().map(|&node| positions[node as usize]).collect::<Vec<_>>());
    let mut seen = Seen::new(dent, &line(&positions));
    let mut before = 0.0;
    let mut count = 0;
    for _ in 0..rounds {
        let mut jittered = positions.clone();
        for node in (0..positions.len() as u32).filter(|node| !loops[0].contains(node)) {
            jittered[node as usize] = positions[node as usize].map(|x| x + 0.4 * SIZE * (random.next() - 0.5));
        }
        let body = Body { mesh: Mesh { positions: &jittered, cells: &cells }, loops: &loops, fixed: &fixed };
        let Ok(meshed) = relocated_outside(&body, dent.measure, 1.0, kept_out) else { continue };
        count += 1;
        positions = meshed.positions;
        seen.look(dent, &line(&positions));
        if count == 1 {
            before = seen.off;
        }
    }
    (seen, count, before)
}

#[test]
fn nodes_that_slide_do_not_either() {
    for dent in &DENTS[..2] {
        let (seen, count, before) = moved_again(dent, 80, &|spot| dent.outside(spot));
        let (without, _, _) = moved_again(dent, 8, &anywhere);
        println!("{:?}: {count} times, {seen}, {before:.1e} m before; without a tool {without}", dent.measure);
        assert!(count > 40 && seen.depth < 1e-12 && seen.gap < 1e-12 && seen.event < 1e-13 && seen.all < 1e-13);
        assert!(seen.off - before < 1e-3 * SIZE && without.depth > 2e-3);
    }
}

/// Area or volume by that of the outline, less one.
fn change(outline: &Outline, meshed: &Meshed, measure: Measure) -> f64 {
    let place = |own: &OnOutline| meshed.positions[own.node as usize];
    let loops: Vec<Vec<Point>> = meshed.loops.iter().map(|nodes| nodes.iter().map(place).collect()).collect();
    volume::measured(measure, &loops) / volume::measured(measure, &outline.loops) - 1.0
}

#[test]
fn a_corner_of_a_tool_bends_a_straight_side_and_no_other() {
    let outline = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
    // Of the tool above: y = 0.99 + |x − 1| / 4.
    let lowest = |x: f64| 0.99 + 0.25 * (x - 1.0).abs();
    let outside = |spot: Spot| (spot.segment == 2 && spot.place[1] > lowest(spot.place[0])).then(|| [spot.place[0], lowest(spot.place[0])]);
    for measure in [Measure::Plane, Measure::Revolution] {
        let meshed = quadrilaterals_outside(&outline, &|_| 0.1, measure, 10_000, &outside).unwrap();
        assert!(change(&outline, &meshed, measure).abs() < 1e-14);
        let mut highest = 0.0_f64;
        for own in &meshed.loops[0] {
            let [x, y] = meshed.positions[own.node as usize];
            match own.segment {
                2 if own.fraction > 0.0 => {
                    assert!(y < lowest(x) + 1e-15);
                    highest = highest.max(y);
                }
                2 => assert_eq!([x, y], [2.0, 1.0]),
                side => assert!(if side == 0 { y == 0.0 } else { x == if side == 1 { 2.0 } else { 0.0 } }),
            }
        }
        assert!(highest > 1.0 && highest < 1.005, "{highest}");
    }
}

#[test]
fn a_function_without_places_changes_no_bit() {
    let mut random = Random(23);
    for k in 0..40 {
        let outline = star(&mut random);
        let measure = if k % 2 == 0 { Measure::Plane } else { Measure::Revolution };
        let [one, other] =
            [&anywhere as KeptOut<'_>, &|_| None].map(|kept_out| quadrilaterals_outside(&outline, &|_| 0.12, measure, 20_000, kept_out));
        assert_eq!(one, quadrilaterals(&outline, &|_| 0.12, measure, 20_000));
        assert_eq!(one, other);
    }
}

#[test]
fn wrong_answers_destroy_no_mesh() {
    let mut random = Random(29);
    let (mut all, mut made) = (0, [0; 2]);
    for k in 0..240 {
        let outline = star(&mut random);
        let h = 0.05 + 0.2 * random.next();
        let measure = if k % 2 == 0 { Measure::Plane } else { Measure::Revolution };
        let wrong = |spot: Spot| {
            let [x, y] = spot.place;
            let [s, t] = [f64::from(spot.segment % 7) - 3.0, spot.fraction - 0.5];
            match k % 6 {
                0 => Some([f64::NAN, y]),
                1 => Some([-x, 1e300]),
                2 => spot.segment.is_multiple_of(3).then_some([x + 0.1 * h * s, y + 0.2 * h * t]),
                3 => Some([3.0, 0.0]),
                4 => spot.segment.is_multiple_of(5).then_some([f64::INFINITY, f64::NEG_INFINITY]),
                _ => (t > 0.3).then_some([3.0 + 0.9 * (x - 3.0), 0.9 * y]),
            }
        };
        all += 1;
        made[0] += usize::from(quadrilaterals(&outline, &|_| h, measure, 20_000).is_ok());
        let Ok(meshed) = quadrilaterals_outside(&outline, &|_| h, measure, 20_000, &wrong) else { continue };
        assert!(change(&outline, &meshed, measure).abs() < 1e-13);
        assert!(quality(&meshed.positions, &meshed.cells) >= WORST);
        assert_eq!(quadrilaterals_outside(&outline, &|_| h, measure, 20_000, &wrong), Ok(meshed.clone()));
        for (k, &x) in outline.loops[0].iter().enumerate().filter(|(k, _)| outline.fixed[0][*k]) {
            let own = meshed.loops[0].iter().find(|own| own.segment as usize == k && own.fraction == 0.0).unwrap();
            assert_eq!(meshed.positions[own.node as usize], x);
        }
        made[1] += 1;
    }
    println!("{made:?} of {all}");
    assert!(made[1] * 10 > made[0] * 9);
}
