//! Pixel pictures in 2D: the plot with its axes and grid, drawn once on a `sheet`; then one frame
//! after the other on a copy of it. `film` and `mesh` say what there is to show; obstacles and bodies are
//! drawn by `obstacle` and `body`, the canvas goes to `animation` or to a PNG.

use super::body::{Look, Mesh, Values};
use super::colour::{BORDER, GRID, TEXT, TEXT_FAINT};
use super::glyphs::{self, Look as GlyphLook};
use super::obstacle;
use super::raster::{Canvas, Layer};
use super::scale::{Ticks, Unit, ticks, unit};
use super::sheet::{Plan, Sheet, key_height, key_width, measures, padded};
use super::text::{self, Align, Pen, Weight};
use crate::outline::Line;
use crate::preview::Glyph;

/// From metres to pixels: equal scale in both directions, y upwards.
#[derive(Clone, Copy, Debug)]
struct Camera {
    /// Pixels per metre.
    scale: f64,
    centre: [f64; 2],
    /// Middle of the plot, pixels.
    middle: [f64; 2],
}

impl Camera {
    fn pixel(&self, p: [f64; 2]) -> [f64; 2] {
        [self.middle[0] + self.scale * (p[0] - self.centre[0]), self.middle[1] - self.scale * (p[1] - self.centre[1])]
    }
}

/// A laid-out picture.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    /// Everything that does not change.
    sheet: Sheet,
    camera: Camera,
    mirror: [bool; 2],
    sides: [f64; 2],
    layer: Layer,
    looks: Option<Vec<Look>>,
    points: Vec<[f32; 2]>,
}

/// One moment of a film.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<'a> {
    /// Positions, m, from `origin`.
    pub(super) positions: &'a [[f32; 2]],
    pub(super) origin: [f64; 2],
    pub(super) obstacles: &'a [Line],
    pub(super) values: Values<'a>,
    /// Text at the upper right.
    pub(super) note: &'a str,
}

impl Scene {
    /// Lays out and draws what does not change. The picture has the wanted width; it is as high as the bodies
    /// need, at most the wanted height.
    pub(super) fn new(plan: &Plan<'_>) -> Self {
        let (width, height_max, font) = measures(plan.size);
        let view = padded(plan.view);
        let span = [view[1][0] - view[0][0], view[1][1] - view[0][1]];
        let top = (4.6 * font).round();
        let below = (3.9 * font).round();
        let right = (width - key_width(plan, font, width)).round();
        // The width of the labels on the y axis follows from the layout and the layout from it: the second
        // round settles.
        let mut left = (4.0 * font).round();
        let mut axes = None;
        for _ in 0..2 {
            let wide = (right - left).max(20.0);
            let natural = (f64::from(wide) * span[1] / span[0]).min(1e5) as f32;
            let high = natural
                .clamp(
                    (13.0 * font).max(key_height(&plan.key, font)).min(height_max - top - below).max(20.0),
                    (height_max - top - below).max(20.0),
                )
                .round();
            let scale = (f64::from(wide) / span[0]).min(f64::from(high) / span[1]);
            let centre = [0.5 * (view[0][0] + view[1][0]), 0.5 * (view[0][1] + view[1][1])];
            let middle = [f64::from(left + 0.5 * wide), f64::from(top + 0.5 * high)];
            let camera = Camera { scale, centre, middle };
            let made = Axes::new(&camera, [wide, high], font);
            let labels = made.y.labels();
            let widest = labels.iter().map(|l| text::width(l, font, Weight::Regular)).fold(0.0, f32::max);
            left = (1.5 * font + widest.min(0.3 * width)).round();
            axes = Some((camera, made, high));
        }
        let (mut camera, axes, high) = axes.expect("the loop ran twice");
        let plot = [left as usize, top as usize, right.max(left + 20.0) as usize, (top + high) as usize];
        camera.middle[0] = 0.5 * (plot[0] + plot[2]) as f64;
        let still = Canvas::new(width as usize, (top + high + below).round() as usize);
        let layer = Layer::new(plot[2].min(still.width) - plot[0], plot[3] - plot[1]);
        let sheet = Sheet { still, plot, font };
        let mirror = [plan.mirror[0], plan.mirror[1]];
        let mut scene = Self { sheet, camera, mirror, sides: plan.sides, layer, looks: None, points: Vec::new() };
        scene.draw_axes(&axes);
        scene.sheet.write(plan);
        scene
    }

    /// The canvas to start each frame from.
    pub(super) fn still(&self) -> &Canvas {
        &self.sheet.still
    }

    /// How parts are drawn; decided by the first moment that was drawn.
    pub(super) fn looks(&self) -> &[Look] {
        self.looks.as_deref().unwrap_or_default()
    }

    /// Draws a moment on `canvas`, which is overwritten.
    pub(super) fn draw(&mut self, mesh: &Mesh, moment: &Moment<'_>, canvas: &mut Canvas) {
        canvas.clone_from(&self.sheet.still);
        let zero = self.camera.pixel([0.0, 0.0]);
        let planes = [0, 1].map(|k| self.mirror[k].then_some((zero[k] - self.sheet.plot[k] as f64) as f32));
        let signs = |mirrored: bool| if mirrored { &[1.0, -1.0][..] } else { &[1.0][..] };
        for y_sign in signs(self.mirror[1]) {
            for x_sign in signs(self.mirror[0]) {
                let frame = self.obstacle_frame([*x_sign, *y_sign]);
                moment.obstacles.iter().for_each(|line| obstacle::draw(&mut self.layer, line, &frame));
            }
        }
        self.layer.compose(canvas, self.sheet.plot[0], self.sheet.plot[1]);
        for y_sign in signs(self.mirror[1]) {
            for x_sign in signs(self.mirror[0]) {
                self.place(moment, [*x_sign, *y_sign]);
                let unit = self.sheet.unit();
                let looks = self.looks.get_or_insert_with(|| mesh.looks(&self.points, unit));
                mesh.draw(&mut self.layer, &self.points, planes, moment.values, looks);
            }
        }
        self.layer.compose(canvas, self.sheet.plot[0], self.sheet.plot[1]);
        self.draw_symmetry(canvas);
        self.sheet.note(canvas, moment.note);
    }

    /// Draws glyphs over a moment.
    pub(super) fn draw_glyphs(&self, glyphs: &[Glyph], canvas: &mut Canvas) {
        let (zero, [left, top, ..]) = (self.camera.pixel([0.0, 0.0]), self.sheet.plot);
        let spot = |[x, y, _]: [f64; 3]| {
            let at = [zero[0] - left as f64 + self.camera.scale * x, zero[1] - top as f64 - self.camera.scale * y];
            (at.map(|v| v as f32), true)
        };
        let seen = |[x, y, _]: [f64; 3]| [x as f32, -y as f32];
        let look = GlyphLook {
            spot: &spot,
            seen: &seen,
            pixels: self.camera.scale,
            plot: self.sheet.plot,
            unit: self.sheet.unit(),
            font: self.sheet.font,
        };
        glyphs::draw(canvas, glyphs, &look);
    }

    /// Where obstacles are drawn in one of the mirror images: on its side of the mirror lines, or a floor
    /// would be drawn twice.
    fn obstacle_frame(&self, sign: [f64; 2]) -> obstacle::Frame {
        let zero = self.camera.pixel([0.0, 0.0]);
        let zero = [0, 1].map(|k| zero[k] - self.sheet.plot[k] as f64);
        let mut region = [[0.0; 2], [(self.sheet.plot[2] - self.sheet.plot[0]) as f64, (self.sheet.plot[3] - self.sheet.plot[1]) as f64]];
        for axis in (0..2).filter(|k| self.mirror[*k]) {
            // y grows downwards in pixels.
            let is_upper = (self.sides[axis] * sign[axis] > 0.0) == (axis == 0);
            let limit = zero[axis].clamp(0.0, region[1][axis]);
            region[usize::from(!is_upper)][axis] = limit;
        }
        let scale = [self.camera.scale * sign[0], -self.camera.scale * sign[1]];
        let mirrors = [0, 1].map(|k| self.mirror[k].then_some(zero[k]));
        obstacle::Frame { zero, scale, region, mirrors, unit: f64::from(self.sheet.unit()) }
    }

    /// Turns positions into pixels within the layer.
    fn place(&mut self, moment: &Moment<'_>, sign: [f64; 2]) {
        let zero = self.camera.pixel([0.0, 0.0]);
        let [x0, y0] = [zero[0] - self.sheet.plot[0] as f64, zero[1] - self.sheet.plot[1] as f64];
        let scale = [self.camera.scale * sign[0], -self.camera.scale * sign[1]];
        let place = |p: &[f32; 2]| {
            let x = x0 + scale[0] * (moment.origin[0] + f64::from(p[0]));
            let y = y0 + scale[1] * (moment.origin[1] + f64::from(p[1]));
            [x as f32, y as f32]
        };
        self.points.clear();
        self.points.extend(moment.positions.iter().map(place));
    }

    fn draw_axes(&mut self, axes: &Axes) {
        let [left, top, right, bottom] = self.sheet.plot.map(|v| v as f32);
        let font = self.sheet.font;
        let pen = Pen { size: font, weight: Weight::Regular, colour: TEXT };
        let thick = (font / 16.0).round().max(1.0);
        for (value, label) in axes.x.values.iter().zip(axes.x.labels()) {
            let x = self.camera.pixel([value / axes.unit.factor, 0.0])[0] as f32;
            self.sheet.still.vertical(x, top, bottom, thick, GRID);
            self.sheet.still.vertical(x, bottom, bottom + 0.3 * font, thick, BORDER);
            text::draw(&mut self.sheet.still, &label, x, bottom + 1.45 * font, Align::Centre, pen);
        }
        for (value, label) in axes.y.values.iter().zip(axes.y.labels()) {
            let y = self.camera.pixel([0.0, value / axes.unit.factor])[1] as f32;
            self.sheet.still.horizontal(left, right, y, thick, GRID);
            self.sheet.still.horizontal(left - 0.3 * font, left, y, thick, BORDER);
            text::draw(&mut self.sheet.still, &label, left - 0.55 * font, y + 0.36 * font, Align::Right, pen);
        }
        for y in [top, bottom] {
            self.sheet.still.horizontal(left, right, y, thick, BORDER);
        }
        for x in [left, right] {
            self.sheet.still.vertical(x, top, bottom, thick, BORDER);
        }
        let faint = Pen { colour: TEXT_FAINT, ..pen };
        let name = |axis: &str| format!("{axis}{}", axes.unit.bracket());
        text::draw(&mut self.sheet.still, &name("x"), 0.5 * (left + right), bottom + 2.9 * font, Align::Centre, faint);
        text::draw(&mut self.sheet.still, &name("y"), left, top - 0.6 * font, Align::Left, faint);
    }

    /// Dash-dotted lines at x = 0 and y = 0 where the picture is mirrored there.
    fn draw_symmetry(&self, canvas: &mut Canvas) {
        let [left, top, right, bottom] = self.sheet.plot.map(|v| v as f32);
        let zero = self.camera.pixel([0.0, 0.0]).map(|v| v as f32);
        let font = self.sheet.font;
        let thick = (font / 14.0).round().max(1.0);
        let dashes = |from: f32, to: f32| {
            let period = 1.7 * font;
            let count = if to > from { ((to - from) / period).ceil() as usize } else { 0 };
            let cut = move |a: f32, b: f32| (a.min(to), b.min(to));
            (0..count).flat_map(move |k| {
                let at = from + period * k as f32;
                [cut(at, at + font), cut(at + 1.27 * font, at + 1.43 * font)]
            })
        };
        if self.mirror[0] && zero[0] > left && zero[0] < right {
            let x = (zero[0] - 0.5 * thick).round();
            for (a, b) in dashes(top, bottom) {
                canvas.rectangle(x, a, x + thick, b, TEXT_FAINT, 1.0);
            }
        }
        if self.mirror[1] && zero[1] > top && zero[1] < bottom {
            let y = (zero[1] - 0.5 * thick).round();
            for (a, b) in dashes(left, right) {
                canvas.rectangle(a, y, b, y + thick, TEXT_FAINT, 1.0);
            }
        }
    }
}

/// Ticks of both axes in their common unit.
struct Axes {
    unit: Unit,
    x: Ticks,
    y: Ticks,
}

impl Axes {
    fn new(camera: &Camera, size: [f32; 2], font: f32) -> Self {
        let half = size.map(|v| 0.5 * f64::from(v) / camera.scale);
        let unit = unit("m", half[0].max(half[1]) * 2.0);
        let range = |k: usize| [(camera.centre[k] - half[k]) * unit.factor, (camera.centre[k] + half[k]) * unit.factor];
        let ([x0, x1], [y0, y1]) = (range(0), range(1));
        let count = |length: f32, each: f32| ((length / (each * font)) as usize).clamp(2, 12);
        Self { x: ticks(x0, x1, count(size[0], 5.5)), y: ticks(y0, y1, count(size[1], 3.2)), unit }
    }
}
