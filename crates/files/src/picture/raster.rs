//! The two surfaces of a 2D picture: the canvas, and the layer on which cells and lines are drawn by their
//! exact coverage of pixels. Coverage of cells that share an edge adds up to one there, so a mesh shows
//! neither seams nor steps. Polygons come from `body` and `obstacle`; the finished [`Canvas`] goes to the
//! encoders.

use super::colour::{INK, Rgb, WHITE, mix};
use ab_glyph_rasterizer::{Rasterizer, point};

/// A picture of RGB pixels, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Canvas {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<Rgb>,
}

impl Canvas {
    /// A white canvas.
    pub(super) fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![WHITE; width * height] }
    }
    /// Lays `colour` over a pixel; outside the canvas nothing happens.
    pub(super) fn blend(&mut self, x: i64, y: i64, colour: Rgb, alpha: f32) {
        if x >= 0 && y >= 0 && (x as usize) < self.width && (y as usize) < self.height {
            let pixel = &mut self.pixels[y as usize * self.width + x as usize];
            *pixel = mix(*pixel, colour, alpha);
        }
    }
    /// Fills the rectangle, its borders included by the part of a pixel that they cover.
    pub(super) fn rectangle(&mut self, x0: f32, y0: f32, x1: f32, y1: f32, colour: Rgb, alpha: f32) {
        let clamp = |v: f32, limit: usize| v.clamp(0.0, limit as f32);
        let (x0, x1) = (clamp(x0, self.width), clamp(x1, self.width));
        let (y0, y1) = (clamp(y0, self.height), clamp(y1, self.height));
        let share = |low: f32, high: f32, pixel: usize| (high.min(pixel as f32 + 1.0) - low.max(pixel as f32)).max(0.0);
        for y in y0 as usize..y1.ceil() as usize {
            for x in x0 as usize..x1.ceil() as usize {
                self.blend(x as i64, y as i64, colour, alpha * share(x0, x1, x) * share(y0, y1, y));
            }
        }
    }
    /// A one-pixel line (or `thick` pixels) from left to right, snapped to whole pixels.
    pub(super) fn horizontal(&mut self, x0: f32, x1: f32, y: f32, thick: f32, colour: Rgb) {
        let top = (y - 0.5 * thick).round();
        self.rectangle(x0, top, x1, top + thick, colour, 1.0);
    }
    /// A line from top to bottom, snapped to whole pixels.
    pub(super) fn vertical(&mut self, x: f32, y0: f32, y1: f32, thick: f32, colour: Rgb) {
        let left = (x - 0.5 * thick).round();
        self.rectangle(left, y0, left + thick, y1, colour, 1.0);
    }
}

/// Exact coverage of one closed outline inside a small window. A copy is an empty one: there is nothing in it
/// between two outlines.
#[derive(Debug)]
struct Coverage(Rasterizer);

impl Default for Coverage {
    fn default() -> Self {
        Self(Rasterizer::new(0, 0))
    }
}

impl Clone for Coverage {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Coverage {
    /// Takes the outline of a polygon, whose points are from `corner` of a window of `wide` × `high` pixels.
    /// There is a column on its left: the rasteriser loses an edge that rounding puts beyond it.
    fn begin(&mut self, polygon: &[[f32; 2]], corner: [f32; 2], wide: usize, high: usize) {
        self.0.reset(wide + 1, high);
        let place = |p: [f32; 2]| point(p[0] - corner[0] + 1.0, p[1] - corner[1]);
        let mut last = place(polygon[polygon.len() - 1]);
        for p in polygon {
            let next = place(*p);
            self.0.draw_line(last, next);
            last = next;
        }
    }

    /// Calls `paint(column, row, coverage)` for each pixel that is covered.
    fn pixels(&self, mut paint: impl FnMut(usize, usize, f32)) {
        let wide = self.0.dimensions().0;
        let (mut column, mut row) = (0, 0);
        self.0.for_each_pixel(|_, coverage| {
            if coverage > 1e-4 && column > 0 {
                paint(column - 1, row, coverage.min(1.0));
            }
            column += 1;
            if column == wide {
                (column, row) = (0, row + 1);
            }
        });
    }
}

/// The next whole number, as `ceil`, which is a call where processors may be old; 0 for negative ones.
#[inline]
fn up(value: f32) -> usize {
    let whole = value as usize;
    whole + usize::from((whole as f32) < value)
}

/// How a polygon is coloured; components 0 to 255.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shade<'a> {
    /// One colour.
    Flat([f32; 3]),
    /// Colour `map[value]`, `value = at + along · (x, y)` in map positions, held between `low` and `high`.
    Gradient { map: &'a [[f32; 3]], at: f32, along: [f32; 2], low: f32, high: f32 },
}

/// What is drawn of the bodies in one frame, before it is laid over the background: sums of colour ×
/// coverage, and lines.
///
/// Only what was touched is cleared and composed, so empty regions cost nothing.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    width: usize,
    height: usize,
    /// Colour × coverage, and coverage.
    colour: Vec<[f32; 4]>,
    /// Strongest line in each pixel, 0 to 1.
    ink: Vec<f32>,
    /// Touched columns of each row: from, to (excluded).
    touched: Vec<[usize; 2]>,
    coverage: Coverage,
    clipped: Vec<[f32; 2]>,
}

impl Layer {
    /// An empty layer.
    pub(super) fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            colour: vec![[0.0; 4]; width * height],
            ink: vec![0.0; width * height],
            touched: vec![[width, 0]; height],
            coverage: Coverage::default(),
            clipped: Vec::new(),
        }
    }

    /// Fills a polygon.
    pub(super) fn fill(&mut self, polygon: &[[f32; 2]], shade: Shade<'_>) {
        let width = self.width;
        if let Some((x, y)) = self.one_pixel(polygon) {
            let index = y * width + x;
            add(&mut self.colour[index], shade, x, y, area(polygon).abs());
            self.touch(y, x, x + 1);
        } else if let Some((left, top)) = self.cover(polygon) {
            let colour = &mut self.colour;
            self.coverage.pixels(|column, row, coverage| {
                let (x, y) = (left + column, top + row);
                add(&mut colour[y * width + x], shade, x, y, coverage);
            });
        }
    }

    /// Draws a line of `thick` pixels; where lines meet, the stronger one counts.
    pub(super) fn line(&mut self, from: [f32; 2], to: [f32; 2], thick: f32, strength: f32) {
        let Some(corners) = (if strength > 0.0 { thickened(from, to, thick) } else { None }) else { return };
        let width = self.width;
        if let Some((left, top)) = self.cover(&corners) {
            let ink = &mut self.ink;
            self.coverage.pixels(|column, row, coverage| {
                let pixel = &mut ink[(top + row) * width + left + column];
                *pixel = pixel.max(coverage * strength);
            });
        }
    }

    /// Fills a line of `thick` pixels as if it were a body.
    pub(super) fn stroke(&mut self, from: [f32; 2], to: [f32; 2], thick: f32, shade: Shade<'_>) {
        if let Some(corners) = thickened(from, to, thick) {
            self.fill(&corners, shade);
        }
    }

    /// Lays everything over `canvas` with the layer's corner at (`left`, `top`), and empties the layer.
    pub(super) fn compose(&mut self, canvas: &mut Canvas, left: usize, top: usize) {
        for y in 0..self.height {
            let [from, to] = std::mem::replace(&mut self.touched[y], [self.width, 0]);
            if from >= to {
                continue;
            }
            let (own, row) = (y * self.width, (top + y) * canvas.width + left);
            let pixels = &mut canvas.pixels[row + from..row + to];
            let (colour, inks) = (&mut self.colour[own + from..own + to], &mut self.ink[own + from..own + to]);
            for ((pixel, colour), ink) in pixels.iter_mut().zip(colour).zip(inks) {
                let (sum, ink) = (std::mem::take(colour), std::mem::take(ink));
                if sum[3] > 0.0 {
                    // One cell that covers all of the pixel needs no mean.
                    let mean = if sum[3] == 1.0 { [sum[0], sum[1], sum[2]] } else { [sum[0], sum[1], sum[2]].map(|c| c / sum[3]) };
                    let body = mean.map(|c| (c + 0.5) as u8);
                    *pixel = if sum[3] > 0.998 { body } else { mix(*pixel, body, sum[3]) };
                }
                if ink > 0.0 {
                    *pixel = mix(*pixel, INK, ink);
                }
            }
        }
    }

    fn touch(&mut self, row: usize, from: usize, to: usize) {
        let touched = &mut self.touched[row];
        *touched = [touched[0].min(from), touched[1].max(to)];
    }

    /// The pixel that holds the whole polygon, if one does.
    fn one_pixel(&self, polygon: &[[f32; 2]]) -> Option<(usize, usize)> {
        let first = polygon.first()?;
        let (x, y) = (first[0] as usize, first[1] as usize);
        let (left, top) = (x as f32, y as f32);
        let is_in = |p: &[f32; 2]| p[0] >= left && p[0] < left + 1.0 && p[1] >= top && p[1] < top + 1.0;
        (x < self.width && y < self.height && polygon.iter().all(is_in)).then_some((x, y))
    }

    /// Fills `coverage` with the part of the polygon inside the layer; returns the window's corner.
    fn cover(&mut self, polygon: &[[f32; 2]]) -> Option<(usize, usize)> {
        let limit = [self.width as f32, self.height as f32];
        let [mut low, mut high] = bounds(polygon)?;
        let mut polygon = polygon;
        if low[0] < 0.0 || low[1] < 0.0 || high[0] > limit[0] || high[1] > limit[1] {
            if high[0] <= 0.0 || high[1] <= 0.0 || low[0] >= limit[0] || low[1] >= limit[1] {
                return None;
            }
            let corners: Vec<[f64; 2]> = polygon.iter().map(|p| p.map(f64::from)).collect();
            let mut inside = Vec::new();
            clip(&corners, [0.0; 2], limit.map(f64::from), &mut inside);
            self.clipped.clear();
            self.clipped.extend(inside.iter().map(|p| p.map(|v| v as f32)));
            polygon = &self.clipped;
            [low, high] = bounds(polygon)?;
        }
        let (left, top) = (low[0].max(0.0) as usize, low[1].max(0.0) as usize);
        let (right, bottom) = (up(high[0]).min(self.width), up(high[1]).min(self.height));
        if right <= left || bottom <= top {
            return None;
        }
        self.coverage.begin(polygon, [left as f32, top as f32], right - left, bottom - top);
        for row in top..bottom {
            self.touch(row, left, right);
        }
        Some((left, top))
    }
}

/// Corners of a line with a thickness, half of which it reaches beyond its ends (so that a chain of short
/// ones has no gaps); none for a line without length.
fn thickened(from: [f32; 2], to: [f32; 2], thick: f32) -> Option<[[f32; 2]; 4]> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    if length <= 1e-3 || !length.is_finite() {
        return None;
    }
    let ahead = along.map(|a| 0.5 * thick * a / length);
    let side = [-ahead[1], ahead[0]];
    Some([
        [from[0] - ahead[0] + side[0], from[1] - ahead[1] + side[1]],
        [to[0] + ahead[0] + side[0], to[1] + ahead[1] + side[1]],
        [to[0] + ahead[0] - side[0], to[1] + ahead[1] - side[1]],
        [from[0] - ahead[0] - side[0], from[1] - ahead[1] - side[1]],
    ])
}

/// Adds `coverage` of a shade at pixel (`x`, `y`).
#[inline]
fn add(sum: &mut [f32; 4], shade: Shade<'_>, x: usize, y: usize, coverage: f32) {
    let colour = match shade {
        Shade::Flat(colour) => colour,
        Shade::Gradient { map, at, along, low, high } => {
            let value = (at + along[0] * (x as f32 + 0.5) + along[1] * (y as f32 + 0.5)).clamp(low, high);
            map[(value.max(0.0) as usize).min(map.len() - 1)]
        }
    };
    for k in 0..3 {
        sum[k] += coverage * colour[k];
    }
    sum[3] += coverage;
}

/// Lower and upper corner; none for no points or points that are not finite.
fn bounds(polygon: &[[f32; 2]]) -> Option<[[f32; 2]; 2]> {
    let first = *polygon.first()?;
    let mut bounds = [first, first];
    for p in polygon {
        if !(p[0].is_finite() && p[1].is_finite()) {
            return None;
        }
        for k in 0..2 {
            bounds[0][k] = bounds[0][k].min(p[k]);
            bounds[1][k] = bounds[1][k].max(p[k]);
        }
    }
    Some(bounds)
}

fn area(polygon: &[[f32; 2]]) -> f32 {
    let Some(origin) = polygon.first() else { return 0.0 };
    let side = |p: &[f32; 2]| [p[0] - origin[0], p[1] - origin[1]];
    polygon
        .windows(2)
        .map(|w| {
            let (a, b) = (side(&w[0]), side(&w[1]));
            0.5 * (a[0] * b[1] - a[1] * b[0])
        })
        .sum()
}

/// The part of `polygon` between the corners `low` and `high` (one side after the other; Sutherland and
/// Hodgman 1974).
pub(super) fn clip(polygon: &[[f64; 2]], low: [f64; 2], high: [f64; 2], out: &mut Vec<[f64; 2]>) {
    let mut points = polygon.to_vec();
    for (axis, bound, keep_below) in [(0, low[0], false), (0, high[0], true), (1, low[1], false), (1, high[1], true)] {
        out.clear();
        let distance = |p: &[f64; 2]| if keep_below { bound - p[axis] } else { p[axis] - bound };
        for i in 0..points.len() {
            let (a, b) = (points[i], points[(i + 1) % points.len()]);
            let (da, db) = (distance(&a), distance(&b));
            if da >= 0.0 {
                out.push(a);
            }
            if (da >= 0.0) != (db >= 0.0) {
                let t = da / (da - db);
                let mut cut = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
                cut[axis] = bound;
                out.push(cut);
            }
        }
        points.clone_from(out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(polygons: &[&[[f32; 2]]], colour: [f32; 3]) -> Canvas {
        let mut layer = Layer::new(20, 20);
        for p in polygons {
            layer.fill(p, Shade::Flat(colour));
        }
        let mut canvas = Canvas::new(20, 20);
        layer.compose(&mut canvas, 0, 0);
        canvas
    }

    #[test]
    fn a_square_covers_its_pixels_by_their_share() {
        let canvas = drawn(&[&[[2.5, 3.0], [8.0, 3.0], [8.0, 6.0], [2.5, 6.0]]], [0.0; 3]);
        let at = |x: usize, y: usize| canvas.pixels[y * 20 + x][0];
        assert_eq!((at(1, 4), at(3, 4), at(7, 5), at(8, 4), at(4, 2), at(4, 6)), (255, 0, 0, 255, 255, 255));
        assert!((126..=129).contains(&at(2, 4)), "{}", at(2, 4));
    }

    #[test]
    fn cells_that_share_an_edge_leave_no_seam() {
        let (a, b, c, d) = ([1.3, 1.7], [17.2, 3.1], [18.8, 17.9], [2.2, 16.4]);
        let m = [9.37, 8.11];
        let canvas = drawn(&[&[a, b, m], &[b, c, m], &[c, d, m], &[d, a, m]], [10.0, 20.0, 30.0]);
        for y in 5..14 {
            for x in 5..14 {
                assert_eq!(canvas.pixels[y * 20 + x], [10, 20, 30], "({x}, {y})");
            }
        }
    }

    #[test]
    fn many_cells_within_one_pixel_add_up_to_it() {
        let quad = |x: f32, y: f32| [[x, y], [x + 0.25, y], [x + 0.25, y + 0.25], [x, y + 0.25]];
        let quads: Vec<[[f32; 2]; 4]> = (0..16).map(|k| quad(5.0 + 0.25 * (k % 4) as f32, 7.0 + 0.25 * (k / 4) as f32)).collect();
        let quads: Vec<&[[f32; 2]]> = quads.iter().map(<[_; 4]>::as_slice).collect();
        let canvas = drawn(&quads, [0.0; 3]);
        assert!(canvas.pixels[7 * 20 + 5][0] < 10, "{:?}", canvas.pixels[7 * 20 + 5]);
    }

    #[test]
    fn polygons_far_outside_and_not_finite_are_cut_or_left_out() {
        let canvas =
            drawn(&[&[[-1e7, -1e7], [1e7, -1e7], [1e7, 10.0], [-1e7, 10.0]], &[[f32::NAN, 0.0], [1.0, 1.0], [2.0, 0.0]]], [0.0; 3]);
        assert!(canvas.pixels[..200].iter().all(|p| *p == [0; 3]));
        assert!(canvas.pixels[200..].iter().all(|p| *p == WHITE));
        let mut layer = Layer::new(20, 20);
        layer.line([-1e9, 5.0], [1e9, 5.0], 2.0, 1.0);
        layer.line([3.0, 3.0], [f32::INFINITY, 5.0], 2.0, 1.0);
    }

    #[test]
    fn a_cell_turned_inside_out_is_still_filled() {
        let canvas = drawn(&[&[[2.0, 2.0], [2.0, 8.0], [8.0, 8.0], [8.0, 2.0]]], [0.0; 3]);
        assert_eq!(canvas.pixels[5 * 20 + 5], [0; 3]);
    }
}
