//! Obstacles in pixels: a firm line on the surface and, on the solid side, a light band with the short
//! strokes by which drawings mark what is held fast; solids within a closed line are filled. Everything lies
//! on the solid side of the surface, so that it hides no body that touches it. Lines come from `film` and
//! `mesh`; everything is drawn on a [`Layer`] before the bodies.

use super::colour::SOLID;
use super::raster::{Layer, Shade, clip};
use crate::outline::Line;

/// Width of the band, pixels at the usual font.
const BAND: f64 = 8.0;
/// Distance of strokes, pixels at the usual font.
const STROKES: f64 = 7.0;
/// Thickness and strength of the surface.
const SURFACE: (f64, f32) = (1.8, 0.88);
/// Thickness and strength of a stroke.
const STROKE: (f64, f32) = (0.9, 0.5);
/// Surfaces that come this close to a mirror line, pixels, are walls of the half model and no obstacles of
/// the whole.
const ON_MIRROR: f64 = 0.75;

type Point = [f64; 2];

/// Where a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// From metres to pixels within the layer: `zero + scale · x`.
    pub(super) zero: Point,
    pub(super) scale: Point,
    /// Lower and upper corner of what may be drawn on, pixels: the part of the plot on this side of the
    /// mirror lines.
    pub(super) region: [Point; 2],
    /// x and y of mirror lines, pixels.
    pub(super) mirrors: [Option<f64>; 2],
    /// One for the usual font.
    pub(super) unit: f64,
}

/// A line made ready for drawing.
struct Drawn {
    points: Vec<Point>,
    /// Unit normal of each segment, to the solid.
    normals: Vec<Point>,
    is_closed: bool,
    is_filled: bool,
    band: f64,
}

/// Draws `line`; one that is not sound is left out.
pub(super) fn draw(layer: &mut Layer, line: &Line, frame: &Frame) {
    let Some(drawn) = Drawn::new(line, frame) else { return };
    if drawn.is_filled {
        fill(layer, &drawn.points, frame.region);
    }
    for k in 0..drawn.normals.len() {
        drawn.segment(layer, k, frame);
    }
    drawn.strokes(layer, frame);
}

fn fill(layer: &mut Layer, polygon: &[Point], [low, high]: [Point; 2]) {
    let mut inside = Vec::new();
    clip(polygon, low, high, &mut inside);
    let inside: Vec<[f32; 2]> = inside.iter().map(|p| p.map(|v| v as f32)).collect();
    layer.fill(&inside, Shade::Flat(SOLID.map(f32::from)));
}

impl Drawn {
    fn new(line: &Line, frame: &Frame) -> Option<Self> {
        let mut points: Vec<Point> =
            line.points.iter().map(|p| [frame.zero[0] + frame.scale[0] * p[0], frame.zero[1] + frame.scale[1] * p[1]]).collect();
        points.dedup();
        // Far beyond what can be computed with, and far beyond every picture.
        if points.len() < 2 || !points.iter().flatten().all(|v| v.abs() < 1e12) {
            return None;
        }
        // The solid is on the right in the model; y grows downwards in pixels, and a mirror image turns sides
        // around.
        let side = if frame.scale[0] * frame.scale[1] < 0.0 { 1.0 } else { -1.0 };
        let normal = |w: &[Point]| {
            let along = direction(w[0], w[1]);
            [-side * along[1], side * along[0]]
        };
        let normals = points.windows(2).map(normal).collect();
        let is_filled = line.is_filled();
        let mut band = BAND * frame.unit;
        if is_filled {
            let [low, high] = line.extent();
            let smaller = (0..2).map(|k| (high[k] - low[k]) * frame.scale[k].abs()).fold(f64::INFINITY, f64::min);
            band = band.min(0.3 * smaller);
        }
        Some(Self { points, normals, is_closed: line.is_closed(), is_filled, band })
    }

    /// How far `depth` below the surface lies from vertex `vertex` of segment `k`: along the bisector, so
    /// that bands join without gap or overlap.
    fn below(&self, k: usize, vertex: usize, depth: f64) -> Point {
        let (own, is_start) = (self.normals[k], vertex == k);
        let Some(neighbour) = self.neighbour(k, is_start) else { return own.map(|v| depth * v) };
        let other = self.normals[neighbour];
        let share = 1.0 + own[0] * other[0] + own[1] * other[1];
        let joint = [0, 1].map(|a| (own[a] + other[a]) / share.max(1e-6));
        let along = direction(self.points[k], self.points[k + 1]);
        let back = (joint[0] * along[0] + joint[1] * along[1]) * if is_start { 1.0 } else { -1.0 };
        if back > 0.0 {
            // Solid within less than half a turn: never beyond the shorter side.
            let length = |k: usize| (self.points[k + 1][0] - self.points[k][0]).hypot(self.points[k + 1][1] - self.points[k][1]);
            let room = length(k).min(length(neighbour));
            joint.map(|v| v * depth.min(room / back))
        } else if share > 0.3 {
            joint.map(|v| depth * v)
        } else {
            // A needle of free space.
            own.map(|v| depth * v)
        }
    }

    /// The segment before (or after) segment `k`.
    fn neighbour(&self, k: usize, is_before: bool) -> Option<usize> {
        let last = self.normals.len() - 1;
        match (is_before, self.is_closed) {
            (true, closed) if k == 0 => closed.then_some(last),
            (true, _) => Some(k - 1),
            (false, closed) if k == last => closed.then_some(0),
            (false, _) => Some(k + 1),
        }
    }

    /// Band and surface of segment `k`.
    fn segment(&self, layer: &mut Layer, k: usize, frame: &Frame) {
        let [low, high] = frame.region;
        let (a, b) = (self.points[k], self.points[k + 1]);
        let grown = [low.map(|v| v - 3.0 * self.band), high.map(|v| v + 3.0 * self.band)];
        let Some((near_a, near_b)) = cut(a, b, grown) else { return };
        if let Some((seen_a, seen_b)) = cut(a, b, frame.region)
            && is_on_mirror([seen_a, seen_b], frame)
        {
            return;
        }
        let below = |depth: f64, near: Point, vertex: usize| {
            let joint = if near == self.points[vertex] { self.below(k, vertex, depth) } else { self.normals[k].map(|v| depth * v) };
            [near[0] + joint[0], near[1] + joint[1]]
        };
        if !self.is_filled {
            fill(layer, &[near_a, near_b, below(self.band, near_b, k + 1), below(self.band, near_a, k)], frame.region);
        }
        let thick = SURFACE.0 * frame.unit;
        let middle = (below(0.5 * thick, near_a, k), below(0.5 * thick, near_b, k + 1));
        if let Some((from, to)) = cut(middle.0, middle.1, frame.region) {
            layer.line(from.map(|v| v as f32), to.map(|v| v as f32), thick as f32, SURFACE.1);
        }
    }

    /// The short strokes below the surface, at fixed places of the obstacle, so that they move and turn with
    /// it.
    fn strokes(&self, layer: &mut Layer, frame: &Frame) {
        let lengths = self.points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]));
        let ends: Vec<f64> = std::iter::once(0.0)
            .chain(lengths.scan(0.0, |sum, length| {
                *sum += length;
                Some(*sum)
            }))
            .collect();
        let whole = ends[ends.len() - 1];
        let spacing = STROKES * frame.unit;
        // A closed line has a whole number of them.
        let spacing = if self.is_closed { whole / (whole / spacing).round().max(3.0) } else { spacing };
        let grown = [frame.region[0].map(|v| v - self.band), frame.region[1].map(|v| v + self.band)];
        for k in 0..self.normals.len() {
            let (a, b) = (self.points[k], self.points[k + 1]);
            let Some((from, to)) = cut(a, b, grown) else { continue };
            if cut(a, b, frame.region).is_some_and(|(a, b)| is_on_mirror([a, b], frame)) {
                continue;
            }
            let along = direction(a, b);
            let arc = |p: Point| ends[k] + (p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1];
            // Slanted backwards, strokes at the beginning of an open line would stand beyond it.
            let begin = if self.is_closed { 0.0 } else { self.band };
            let (first, last) = ((arc(from).max(begin) / spacing).ceil(), (arc(to) / spacing).ceil());
            for index in 0..(last - first).clamp(0.0, 1e4) as usize {
                let at = (first + index as f64) * spacing - ends[k];
                self.stroke(layer, k, [a[0] + at * along[0], a[1] + at * along[1]], along, frame);
            }
        }
    }

    /// A stroke from `base` on segment `k`, slanted backwards; it ends where it meets another part of the
    /// surface.
    fn stroke(&self, layer: &mut Layer, k: usize, base: Point, along: Point, frame: &Frame) {
        let normal = self.normals[k];
        let reach = [0, 1].map(|a| self.band * (normal[a] - along[a]));
        let meets = |i: usize| (i != k).then(|| crossing(base, reach, self.points[i], self.points[i + 1])).flatten();
        // It begins and is cut off within surface lines, which are thicker.
        let start = 0.5 * SURFACE.0 * frame.unit / self.band;
        let end = (0..self.normals.len()).filter_map(meets).map(|share| share - start).fold(1.0, f64::min);
        if start >= end {
            return;
        }
        let [root, tip] = [start, end].map(|share| [base[0] + share * reach[0], base[1] + share * reach[1]]);
        if let Some((from, to)) = cut(root, tip, frame.region) {
            layer.line(from.map(|v| v as f32), to.map(|v| v as f32), (STROKE.0 * frame.unit) as f32, STROKE.1);
        }
    }
}

fn is_on_mirror(ends: [Point; 2], frame: &Frame) -> bool {
    (0..2).any(|axis| frame.mirrors[axis].is_some_and(|mirror| ends.iter().all(|p| (p[axis] - mirror).abs() < ON_MIRROR)))
}

/// Unit vector from `a` to `b`, which differ.
fn direction(a: Point, b: Point) -> Point {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
    along.map(|v| v / length)
}

/// Where on `base + t · span` (t from 0 to 1) the segment from `a` to `b` is met.
fn crossing(base: Point, span: Point, a: Point, b: Point) -> Option<f64> {
    let (edge, arm) = ([b[0] - a[0], b[1] - a[1]], [a[0] - base[0], a[1] - base[1]]);
    let cross = |u: Point, v: Point| u[0] * v[1] - u[1] * v[0];
    let determinant = cross(span, edge);
    let (t, s) = (cross(arm, edge) / determinant, cross(arm, span) / determinant);
    (t > -1e-6 && t < 1.0 && (0.0..=1.0).contains(&s)).then_some(t)
}

/// The part of a segment within a box (parametric clipping; Liang and Barsky 1984). An end that lies inside
/// keeps its exact place.
fn cut(a: Point, b: Point, [low, high]: [Point; 2]) -> Option<(Point, Point)> {
    let along = [b[0] - a[0], b[1] - a[1]];
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        for (slope, room) in [(-along[axis], a[axis] - low[axis]), (along[axis], high[axis] - a[axis])] {
            if slope == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if slope < 0.0 {
                from = from.max(room / slope);
            } else {
                to = to.min(room / slope);
            }
        }
    }
    let at = |t: f64| [a[0] + t * along[0], a[1] + t * along[1]];
    (from <= to).then(|| (if from > 0.0 { at(from) } else { a }, if to < 1.0 { at(to) } else { b }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::colour::WHITE;
    use crate::picture::raster::Canvas;

    /// The line as it looks in a plot of 100 × 80 pixels with one pixel a metre and (0, 0) in the middle.
    fn drawn(points: &[Point], mirrored: bool) -> Canvas {
        let region = if mirrored { [[50.0, 0.0], [100.0, 80.0]] } else { [[0.0, 0.0], [100.0, 80.0]] };
        let mirrors = [mirrored.then_some(50.0), None];
        let frame = Frame { zero: [50.0, 40.0], scale: [1.0, -1.0], region, mirrors, unit: 1.0 };
        let mut layer = Layer::new(100, 80);
        draw(&mut layer, &Line { points: points.to_vec(), is_endless: false }, &frame);
        let mut canvas = Canvas::new(100, 80);
        layer.compose(&mut canvas, 0, 0);
        canvas
    }

    fn is_white(canvas: &Canvas, x: usize, y: usize) -> bool {
        canvas.pixels[y * 100 + x] == WHITE
    }

    #[test]
    fn a_floor_is_solid_below_and_reaches_from_border_to_border() {
        let canvas = drawn(&[[-1e9, 0.0], [1e9, 0.0]], false);
        for x in 0..100 {
            assert!(is_white(&canvas, x, 39), "above the surface at {x}");
            assert!(canvas.pixels[40 * 100 + x][0] < 60, "the surface at {x}");
            assert!(!is_white(&canvas, x, 46), "the band at {x}");
            assert!(is_white(&canvas, x, 49), "below the band at {x}");
        }
        assert!((0..100).any(|x| canvas.pixels[45 * 100 + x][0] < 190), "strokes");
    }

    #[test]
    fn the_solid_is_on_the_right_of_the_line() {
        let canvas = drawn(&[[0.0, -30.0], [0.0, 30.0]], false);
        assert!(is_white(&canvas, 48, 40) && !is_white(&canvas, 55, 40));
        let canvas = drawn(&[[0.0, 30.0], [0.0, -30.0]], false);
        assert!(!is_white(&canvas, 44, 40) && is_white(&canvas, 51, 40));
    }

    #[test]
    fn a_closed_solid_is_filled_and_a_hollow_one_shaded_outside() {
        let square = [[-20.0, -20.0], [-20.0, 20.0], [20.0, 20.0], [20.0, -20.0], [-20.0, -20.0]];
        let solid = drawn(&square, false);
        assert_eq!(solid.pixels[40 * 100 + 50], SOLID);
        assert!(is_white(&solid, 28, 40) && is_white(&solid, 72, 40) && is_white(&solid, 50, 18));
        let hollow = drawn(&square.iter().rev().copied().collect::<Vec<_>>(), false);
        for (x, y) in [(50, 40), (32, 40), (50, 22), (68, 58)] {
            assert!(is_white(&hollow, x, y), "inside at ({x}, {y})");
        }
        for (x, y) in [(25, 40), (75, 40), (50, 15), (24, 14), (76, 66)] {
            assert!(!is_white(&hollow, x, y), "the band at ({x}, {y}), its corners as well");
        }
    }

    #[test]
    fn band_and_strokes_do_not_come_out_on_the_other_side_of_a_wedge() {
        let canvas = drawn(&[[-40.0, 0.0], [30.0, 0.0], [-40.0, -10.0]], false);
        let seen: Vec<_> = (0..39 * 100).filter(|k| canvas.pixels[*k] != WHITE).map(|k| (k % 100, k / 100, canvas.pixels[k])).collect();
        assert!(seen.is_empty(), "above: {seen:?}");
    }

    #[test]
    fn a_wall_on_the_mirror_line_is_not_drawn() {
        let canvas = drawn(&[[0.0, -1e5], [0.0, 1e5]], true);
        assert!(canvas.pixels.iter().all(|p| *p == WHITE));
        let canvas = drawn(&[[-30.0, 0.0], [30.0, 0.0]], true);
        assert!((0..49).all(|x| (0..80).all(|y| is_white(&canvas, x, y))), "nothing on the other side");
        assert!(!is_white(&canvas, 60, 40));
    }

    #[test]
    fn lines_that_are_not_sound_leave_nothing() {
        for points in [vec![], vec![[0.0, 0.0]], vec![[0.0; 2]; 3], vec![[f64::NAN, 0.0], [1.0, 1.0]], vec![[-1e300, 0.0], [1e300, 1.0]]] {
            assert!(drawn(&points, false).pixels.iter().all(|p| *p == WHITE), "{points:?}");
        }
    }
}
