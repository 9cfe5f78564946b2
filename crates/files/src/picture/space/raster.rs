//! Triangles, rods and lines with hidden surfaces: in each pixel nine samples keep what is nearest to the
//! viewer. Corners come from `scene` in samples, with the depth in the same measure (larger: nearer); the
//! mean of the samples goes to the [`Canvas`].
//!
//! Only + − × ÷, square roots and comparisons in a fixed order: the same picture on every machine.

use crate::picture::colour::{INK, Rgb};
use crate::picture::raster::Canvas;

/// Samples along each side of a pixel.
pub(super) const FINE: usize = 3;
/// Nothing is farther away.
const FAR: f32 = f32::NEG_INFINITY;
/// By so much, in samples, a triangle reaches beyond its sides: what rounds to neither of two neighbours
/// belongs to both.
const REACH: f32 = 0.02;
/// Longest piece in which a line is drawn, samples.
const PIECE: f32 = 48.0;
/// How opaque an obstacle is before a body, and before nothing.
const VEIL: [f32; 2] = [0.3, 0.9];

/// What is nearest at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    depth: f32,
    colour: Rgb,
    /// Strength of a line on it.
    ink: u8,
}

const EMPTY: Sample = Sample { depth: FAR, colour: [0; 3], ink: 0 };

/// Corner of a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    /// To the right, downwards and towards the viewer, samples.
    pub(super) place: [f32; 3],
    /// 0 (dark) to 1.
    pub(super) light: f32,
    /// Place in the colour map.
    pub(super) level: f32,
}

/// How a triangle is painted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paint<'a> {
    /// Colours over levels.
    pub(super) map: &'a [[f32; 3]],
    /// Strength of the line along the side from each corner to the next, 0 to 1.
    pub(super) lines: [f32; 3],
    /// Half the thickness of these lines, samples.
    pub(super) half: f32,
}

/// A number that changes linearly over the picture: at the origin, per sample to the right, per sample
/// downwards; and its least and largest value.
#[derive(Clone, Copy, Debug)]
struct Linear {
    at: f32,
    along: [f32; 2],
    range: [f32; 2],
}

impl Linear {
    #[inline]
    fn value(&self, x: f32, row: f32) -> f32 {
        (row + self.along[0] * x).max(self.range[0]).min(self.range[1])
    }

    #[inline]
    fn row(&self, y: f32) -> f32 {
        self.at + self.along[1] * y
    }
}

/// The samples of a picture of bodies, or of obstacles.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    width: usize,
    height: usize,
    samples: Vec<Sample>,
    /// Touched columns of each row: from, to (excluded).
    touched: Vec<[u32; 2]>,
}

impl Samples {
    /// Empty ones for so many pixels.
    pub(super) fn new(width: usize, height: usize) -> Self {
        let (width, height) = (FINE * width, FINE * height);
        Self { width, height, samples: vec![EMPTY; width * height], touched: vec![[u32::MAX, 0]; height] }
    }

    /// Nothing is there any more.
    pub(super) fn clear(&mut self) {
        for (row, touched) in self.samples.chunks_exact_mut(self.width.max(1)).zip(&mut self.touched) {
            let [from, to] = std::mem::replace(touched, [u32::MAX, 0]);
            if from < to {
                row[from as usize..to as usize].fill(EMPTY);
            }
        }
    }

    /// Paints a triangle where nothing is nearer.
    pub(super) fn triangle(&mut self, corners: [Corner; 3], paint: &Paint<'_>) {
        let p = corners.map(|corner| corner.place);
        let twice_area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        if !(twice_area.abs() > 1e-4 && p.iter().flatten().all(|v| v.abs() < 1e6)) {
            return;
        }
        // Distance from each side, samples, positive inside; the side of number k begins at corner k.
        let sign = if twice_area > 0.0 { 1.0 } else { -1.0 };
        let side = |k: usize| {
            let (a, b) = (p[k], p[(k + 1) % 3]);
            let along = [b[0] - a[0], b[1] - a[1]];
            let scale = sign / (along[0] * along[0] + along[1] * along[1]).sqrt().max(1e-12);
            let slope = [-along[1] * scale, along[0] * scale];
            Linear { at: -(slope[0] * a[0] + slope[1] * a[1]), along: slope, range: [0.0; 2] }
        };
        let sides = [side(0), side(1), side(2)];
        let linear = |v: [f32; 3]| {
            let (u, w) = (v[1] - v[0], v[2] - v[0]);
            let along = [
                (u * (p[2][1] - p[0][1]) - w * (p[1][1] - p[0][1])) / twice_area,
                (w * (p[1][0] - p[0][0]) - u * (p[2][0] - p[0][0])) / twice_area,
            ];
            let range = [v[0].min(v[1]).min(v[2]), v[0].max(v[1]).max(v[2])];
            Linear { at: v[0] - along[0] * p[0][0] - along[1] * p[0][1], along, range }
        };
        let depth = linear(p.map(|p| p[2]));
        let light = linear(corners.map(|corner| corner.light));
        let level = linear(corners.map(|corner| corner.level));
        let has_lines = paint.lines.iter().any(|strength| *strength > 0.0);
        let (top, bottom) = range([p[0][1], p[1][1], p[2][1]], self.height);
        let (left, right) = range([p[0][0], p[1][0], p[2][0]], self.width);
        for row in top..bottom {
            let y = row as f32 + 0.5;
            let starts = [sides[0].row(y), sides[1].row(y), sides[2].row(y)];
            let Some((from, to)) = span(&sides, starts, [left, right]) else { continue };
            self.touch(row, from, to);
            let (depths, lights, levels) = (depth.row(y), light.row(y), level.row(y));
            for (column, sample) in (from..to).zip(&mut self.samples[row * self.width + from..row * self.width + to]) {
                let x = column as f32 + 0.5;
                let near = depth.value(x, depths);
                if near <= sample.depth {
                    continue;
                }
                let colour = paint.map[(level.value(x, levels) as usize).min(paint.map.len() - 1)];
                let bright = light.value(x, lights);
                let mut ink = 0.0f32;
                if has_lines {
                    for k in 0..3 {
                        let distance = starts[k] + sides[k].along[0] * x;
                        ink = ink.max(paint.lines[k] * (paint.half + 0.5 - distance).clamp(0.0, 1.0));
                    }
                }
                *sample = Sample { depth: near, colour: colour.map(|c| (c * bright + 0.5) as u8), ink: (255.0 * ink) as u8 };
            }
        }
    }

    /// A line between two places with a colour of its own, `half` as thick to either side; it is hidden by
    /// what is nearer and hides what is farther.
    pub(super) fn rod(&mut self, ends: [[f32; 3]; 2], half: f32, colour: Rgb) {
        self.along(ends, half, |sample, distance, depth| {
            if distance <= half && depth > sample.depth {
                *sample = Sample { depth, colour, ink: 0 };
            }
        });
    }

    /// A line on what is drawn, where nothing is nearer by more than `lift`.
    pub(super) fn line(&mut self, ends: [[f32; 3]; 2], half: f32, strength: f32, lift: f32) {
        self.along(ends, half, |sample, distance, depth| {
            if depth + lift >= sample.depth {
                let ink = (255.0 * strength * (half + 0.5 - distance).clamp(0.0, 1.0)) as u8;
                sample.ink = sample.ink.max(ink);
            }
        });
    }

    /// Visits all samples near a line: their distance from it, and its depth there. Long lines are cut into
    /// pieces, or their boxes would be large.
    fn along(&mut self, [a, b]: [[f32; 3]; 2], half: f32, mut visit: impl FnMut(&mut Sample, f32, f32)) {
        if !a.iter().chain(&b).all(|v| v.abs() < 1e6) {
            return;
        }
        let reach = half + 0.5;
        let Some([from, to]) = within(a, b, [self.width as f32, self.height as f32], reach) else { return };
        let at = |t: f32| [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
        let length = |a: [f32; 3], b: [f32; 3]| ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt();
        let pieces = (length(at(from), at(to)) / PIECE) as usize + 1;
        let cut = |k: usize| at(from + (to - from) * k as f32 / pieces as f32);
        for k in 0..pieces {
            let (a, b) = (cut(k), cut(k + 1));
            let along = [b[0] - a[0], b[1] - a[1]];
            let square = (along[0] * along[0] + along[1] * along[1]).max(1e-12);
            let (left, right) = range([a[0].min(b[0]) - reach, a[0], a[0].max(b[0]) + reach], self.width);
            let (top, bottom) = range([a[1].min(b[1]) - reach, a[1], a[1].max(b[1]) + reach], self.height);
            if left >= right {
                continue;
            }
            for row in top..bottom {
                self.touch(row, left, right);
                for column in left..right {
                    let arm = [column as f32 + 0.5 - a[0], row as f32 + 0.5 - a[1]];
                    let t = ((arm[0] * along[0] + arm[1] * along[1]) / square).clamp(0.0, 1.0);
                    let off = [arm[0] - t * along[0], arm[1] - t * along[1]];
                    let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
                    if distance < reach {
                        visit(&mut self.samples[row * self.width + column], distance, a[2] + t * (b[2] - a[2]));
                    }
                }
            }
        }
    }

    /// Whether what is at a place is not hidden by anything that is nearer by more than `lift`, samples;
    /// beyond the picture nothing is seen.
    pub(super) fn is_seen(&self, [x, y, depth]: [f32; 3], lift: f32) -> bool {
        let is_inside = x >= 0.0 && y >= 0.0 && x < self.width as f32 && y < self.height as f32;
        is_inside && depth + lift >= self.samples[y as usize * self.width + x as usize].depth
    }

    #[inline]
    fn touch(&mut self, row: usize, from: usize, to: usize) {
        let touched = &mut self.touched[row];
        *touched = [touched[0].min(from as u32), touched[1].max(to as u32)];
    }

    /// Lays the means over `canvas` with the upper left corner at (`left`, `top`); obstacles are a veil
    /// before bodies that they hide.
    pub(super) fn compose(&self, obstacles: Option<&Self>, canvas: &mut Canvas, left: usize, top: usize) {
        for y in 0..self.height / FINE {
            let rows = FINE * y..FINE * (y + 1);
            let touched =
                |samples: &Self| samples.touched[rows.clone()].iter().fold([u32::MAX, 0], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
            let ([a, b], [c, d]) = (touched(self), obstacles.map_or([u32::MAX, 0], touched));
            let (from, to) = (a.min(c) as usize, b.max(d) as usize);
            if from >= to {
                continue;
            }
            let first = (top + y) * canvas.width + left;
            for x in from / FINE..to.div_ceil(FINE) {
                let pixel = &mut canvas.pixels[first + x];
                *pixel = self.mean(obstacles, [x, y], *pixel);
            }
        }
    }

    /// Mean of the samples of a pixel in front of the background.
    fn mean(&self, obstacles: Option<&Self>, [x, y]: [usize; 2], behind: Rgb) -> Rgb {
        let mut sums = [0.0f32; 3];
        for row in FINE * y..FINE * (y + 1) {
            let place = row * self.width + FINE * x;
            for k in place..place + FINE {
                let sample = &self.samples[k];
                let mut seen =
                    on(if sample.depth > FAR { sample.colour } else { behind }.map(f32::from), INK, f32::from(sample.ink) / 255.0);
                if let Some(veil) = obstacles.map(|obstacles| &obstacles.samples[k]) {
                    let opaque = VEIL[usize::from(sample.depth == FAR)];
                    if veil.depth > sample.depth {
                        seen = on(seen, veil.colour, opaque);
                    }
                    if veil.depth > sample.depth || (veil.depth == FAR && sample.depth == FAR) {
                        seen = on(seen, INK, opaque * f32::from(veil.ink) / 255.0);
                    }
                }
                for (sum, seen) in sums.iter_mut().zip(seen) {
                    *sum += seen;
                }
            }
        }
        sums.map(|sum| (sum / (FINE * FINE) as f32 + 0.5) as u8)
    }
}

#[inline]
fn on(under: [f32; 3], over: Rgb, alpha: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| under[k] + (f32::from(over[k]) - under[k]) * alpha)
}

/// Samples whose middles lie between the least and the largest of these, within `0..limit`.
#[inline]
fn range(v: [f32; 3], limit: usize) -> (usize, usize) {
    let low = (v[0].min(v[1]).min(v[2]) - 0.5 - REACH).max(0.0);
    let high = v[0].max(v[1]).max(v[2]) + 0.5 + REACH;
    // A cast takes what is negative as 0; the loop runs to before `high`.
    let first = low as usize;
    (first + usize::from((first as f32) < low), (high as usize).min(limit))
}

/// Columns of a row that lie inside all three sides.
#[inline]
fn span(sides: &[Linear; 3], starts: [f32; 3], [left, right]: [usize; 2]) -> Option<(usize, usize)> {
    let (mut low, mut high) = (left as f32, right as f32);
    for k in 0..3 {
        let (slope, need) = (sides[k].along[0], -REACH - starts[k]);
        if slope > 1e-9 {
            low = low.max(need / slope - 0.5);
        } else if slope < -1e-9 {
            high = high.min(need / slope + 0.5);
        } else if need > 0.0 {
            return None;
        }
    }
    let first = low as usize;
    let (from, to) = (first + usize::from((first as f32) < low), high as usize);
    (from < to).then_some((from, to))
}

/// From where to where (0 to 1) a line lies in the picture, `reach` beyond its border included (Liang and
/// Barsky 1984).
fn within(a: [f32; 3], b: [f32; 3], size: [f32; 2], reach: f32) -> Option<[f32; 2]> {
    let (mut from, mut to) = (0.0f32, 1.0f32);
    for k in 0..2 {
        let along = b[k] - a[k];
        for (slope, room) in [(-along, a[k] + reach), (along, size[k] + reach - a[k])] {
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
    (from <= to).then_some([from, to])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::colour::WHITE;

    const PLAIN: Paint<'static> = Paint { map: &[[200.0, 100.0, 50.0], [10.0, 20.0, 30.0]], lines: [0.0; 3], half: 1.0 };

    fn corner(x: f32, y: f32, depth: f32, level: f32) -> Corner {
        Corner { place: [x, y, depth], light: 1.0, level }
    }

    fn canvas(samples: &Samples, obstacles: Option<&Samples>) -> Canvas {
        let mut canvas = Canvas::new(samples.width / FINE, samples.height / FINE);
        samples.compose(obstacles, &mut canvas, 0, 0);
        canvas
    }

    #[test]
    fn what_is_nearer_is_seen_in_whichever_order_it_is_drawn() {
        let low = [corner(0.0, 0.0, 0.0, 0.0), corner(90.0, 0.0, 0.0, 0.0), corner(0.0, 90.0, 0.0, 0.0)];
        // Nearer on the left, farther on the right: the two go through each other at x = 30 samples.
        let slanted = [corner(0.0, 0.0, 30.0, 1.0), corner(90.0, 0.0, -60.0, 1.0), corner(0.0, 90.0, 30.0, 1.0)];
        for order in [[low, slanted], [slanted, low]] {
            let mut samples = Samples::new(30, 30);
            order.iter().for_each(|triangle| samples.triangle(*triangle, &PLAIN));
            let canvas = canvas(&samples, None);
            assert_eq!((canvas.pixels[4 * 30 + 8], canvas.pixels[4 * 30 + 11]), ([10, 20, 30], [200, 100, 50]));
            assert_eq!(canvas.pixels[29 * 30 + 29], WHITE);
        }
    }

    #[test]
    fn triangles_that_share_sides_leave_no_hole() {
        // A fan around a place within, turned step by step.
        for turn in 0..50 {
            let mut samples = Samples::new(20, 20);
            let at = |k: usize| {
                let angle = 0.037 * turn as f32 + std::f32::consts::FRAC_PI_4 * k as f32;
                corner(30.0 + 28.0 * angle.cos(), 30.0 + 28.0 * angle.sin(), 0.0, 1.0)
            };
            for k in 0..8 {
                samples.triangle([corner(31.3, 28.7, 0.0, 1.0), at(k), at(k + 1)], &PLAIN);
            }
            for y in 14..46 {
                assert!((14..46).all(|x| samples.samples[y * 60 + x].depth == 0.0), "row {y}, turn {turn}");
            }
        }
    }

    #[test]
    fn a_line_behind_a_body_is_hidden_and_one_on_it_is_seen() {
        let front = [corner(-90.0, 0.0, 5.0, 0.0), corner(90.0, 0.0, 5.0, 0.0), corner(90.0, 180.0, 5.0, 0.0)];
        for (depth, is_seen) in [(5.0, true), (4.8, true), (0.0, false)] {
            let mut samples = Samples::new(30, 30);
            samples.triangle(front, &PLAIN);
            samples.line([[0.0, 30.0, depth], [90.0, 30.0, depth]], 2.0, 1.0, 0.5);
            assert_eq!(canvas(&samples, None).pixels[10 * 30 + 20][0] < 100, is_seen, "{depth}");
        }
    }

    #[test]
    fn an_obstacle_before_a_body_lets_it_be_seen_and_one_behind_changes_nothing() {
        let triangle = |depth: f32| [corner(0.0, 0.0, depth, 0.0), corner(180.0, 0.0, depth, 0.0), corner(0.0, 180.0, depth, 0.0)];
        let seen = |depth: f32| {
            let (mut samples, mut obstacles) = (Samples::new(30, 30), Samples::new(30, 30));
            samples.triangle(triangle(0.0), &PLAIN);
            obstacles.triangle(triangle(depth), &Paint { map: &[[230.0; 3]], ..PLAIN });
            canvas(&samples, Some(&obstacles)).pixels[5 * 30 + 5]
        };
        assert_eq!(seen(-1.0), [200, 100, 50]);
        assert!(seen(1.0)[2] > 60 && seen(1.0)[2] < 150, "{:?}", seen(1.0));
    }

    #[test]
    fn what_is_cleared_or_not_a_number_or_far_outside_leaves_nothing() {
        let mut samples = Samples::new(10, 10);
        samples.triangle([corner(0.0, 0.0, 0.0, 0.0), corner(30.0, 0.0, 0.0, 0.0), corner(0.0, 30.0, 0.0, 0.0)], &PLAIN);
        samples.line([[0.0, 0.0, 0.0], [30.0, 30.0, 0.0]], 1.0, 1.0, 0.0);
        samples.clear();
        let nan = corner(f32::NAN, 1.0, 0.0, 0.0);
        samples.triangle([nan, corner(30.0, 0.0, 0.0, 0.0), corner(0.0, 30.0, 0.0, 0.0)], &PLAIN);
        samples.triangle([corner(1e30, 1.0, 0.0, 0.0), corner(30.0, 0.0, 0.0, 0.0), corner(0.0, 30.0, 0.0, 0.0)], &PLAIN);
        samples.line([[-50.0, -5.0, 0.0], [-40.0, f32::NAN, 0.0]], 1.0, 1.0, 0.0);
        samples.rod([[-500.0, 50.0, 0.0], [-400.0, 50.0, 0.0]], 3.0, [1, 2, 3]);
        assert!(samples.samples.iter().all(|sample| *sample == EMPTY));
        assert!(canvas(&samples, None).pixels.iter().all(|pixel| *pixel == WHITE));
    }
}
