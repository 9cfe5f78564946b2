//! Layout of a pixel picture: title, axes with grid, colour bar or legend, all drawn once; then one frame after the other on a copy of it.
//! `film` and `mesh` say what there is to show; obstacles and bodies are drawn by `obstacle` and `body`, the canvas goes to `animation` or to a PNG.

use super::body::{Look, Mesh, Values};
use super::colour::{self, BORDER, GRID, INK, MAP, TEXT, TEXT_FAINT};
use super::obstacle;
use super::raster::{Canvas, Layer};
use super::scale::{Ticks, Unit, ticks, unit};
use super::text::{self, Align, Pen, Weight};
use crate::outline::Line;

/// What stands right of the plot.
#[derive(Clone, Debug)]
pub(super) enum Key {
    /// Nothing.
    Empty,
    /// A colour bar: name of the field, SI unit, range, whether values lie below or above it, and names of the values 0, 1, ... if they are states.
    Bar { label: String, si: &'static str, range: [f64; 2], beyond: [bool; 2], states: &'static [&'static str] },
    /// Names of parts.
    Parts(Vec<String>),
}

/// What a picture is made for.
#[derive(Clone, Debug)]
pub(super) struct Plan<'a> {
    pub(super) title: &'a str,
    pub(super) mirror: [bool; 2],
    /// On which side of each mirror line the model lies: 1 or −1.
    pub(super) sides: [f64; 2],
    /// Largest size, pixels.
    pub(super) size: [u32; 2],
    /// Lower and upper corner of everything that must be seen, m, mirrored bodies included.
    pub(super) view: [[f64; 2]; 2],
    pub(super) key: Key,
    /// The longest text that stands at the upper right.
    pub(super) note: &'a str,
}

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
    still: Canvas,
    camera: Camera,
    /// Plot: left, top, right, bottom, pixels.
    plot: [usize; 4],
    font: f32,
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
    /// Lays out and draws what does not change. The picture has the wanted width; it is as high as the bodies need, at most the wanted height.
    pub(super) fn new(plan: &Plan<'_>) -> Self {
        let width = plan.size[0].clamp(240, 8192) as f32;
        let height_max = (plan.size[1].clamp(160, 8192) as f32).max(160.0);
        let font = (6.0 + 0.0092 * width).max(10.5).round();
        let view = padded(plan.view);
        let span = [view[1][0] - view[0][0], view[1][1] - view[0][1]];
        let top = (4.6 * font).round();
        let below = (3.9 * font).round();
        let right = (width - key_width(plan, font, width)).round();
        // The width of the labels on the y axis follows from the layout and the layout from it: the second round settles.
        let mut left = (4.0 * font).round();
        let mut axes = None;
        for _ in 0..2 {
            let wide = (right - left).max(20.0);
            let natural = (f64::from(wide) * span[1] / span[0]).min(1e5) as f32;
            let high = natural.clamp((13.0 * font).min(height_max - top - below).max(20.0), (height_max - top - below).max(20.0)).round();
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
        let mut scene = Self { still, camera, plot, font, mirror: plan.mirror, sides: plan.sides, layer, looks: None, points: Vec::new() };
        scene.draw_axes(&axes);
        scene.draw_title(plan);
        scene.draw_key(&plan.key);
        scene
    }

    /// The canvas to start each frame from.
    pub(super) fn still(&self) -> &Canvas {
        &self.still
    }

    /// How parts are drawn; decided by the first moment that was drawn.
    pub(super) fn looks(&self) -> &[Look] {
        self.looks.as_deref().unwrap_or_default()
    }

    /// Draws a moment on `canvas`, which is overwritten.
    pub(super) fn draw(&mut self, mesh: &Mesh, moment: &Moment<'_>, canvas: &mut Canvas) {
        canvas.clone_from(&self.still);
        let zero = self.camera.pixel([0.0, 0.0]);
        let planes = [0, 1].map(|k| self.mirror[k].then_some((zero[k] - self.plot[k] as f64) as f32));
        let signs = |mirrored: bool| if mirrored { &[1.0, -1.0][..] } else { &[1.0][..] };
        for y_sign in signs(self.mirror[1]) {
            for x_sign in signs(self.mirror[0]) {
                let frame = self.obstacle_frame([*x_sign, *y_sign]);
                moment.obstacles.iter().for_each(|line| obstacle::draw(&mut self.layer, line, &frame));
            }
        }
        self.layer.compose(canvas, self.plot[0], self.plot[1]);
        for y_sign in signs(self.mirror[1]) {
            for x_sign in signs(self.mirror[0]) {
                self.place(moment, [*x_sign, *y_sign]);
                let unit = self.unit();
                let looks = self.looks.get_or_insert_with(|| mesh.looks(&self.points, unit));
                mesh.draw(&mut self.layer, &self.points, planes, moment.values, looks);
            }
        }
        self.layer.compose(canvas, self.plot[0], self.plot[1]);
        self.draw_symmetry(canvas);
        let pen = Pen { size: self.font, weight: Weight::Regular, colour: TEXT };
        text::draw(canvas, moment.note, self.still.width as f32 - self.font, 1.95 * self.font, Align::Right, pen);
    }

    /// Where obstacles are drawn in one of the mirror images: on its side of the mirror lines, or a floor would be drawn twice.
    fn obstacle_frame(&self, sign: [f64; 2]) -> obstacle::Frame {
        let zero = self.camera.pixel([0.0, 0.0]);
        let zero = [0, 1].map(|k| zero[k] - self.plot[k] as f64);
        let mut region = [[0.0; 2], [(self.plot[2] - self.plot[0]) as f64, (self.plot[3] - self.plot[1]) as f64]];
        for axis in (0..2).filter(|k| self.mirror[*k]) {
            // y grows downwards in pixels.
            let is_upper = (self.sides[axis] * sign[axis] > 0.0) == (axis == 0);
            let limit = zero[axis].clamp(0.0, region[1][axis]);
            region[usize::from(!is_upper)][axis] = limit;
        }
        let scale = [self.camera.scale * sign[0], -self.camera.scale * sign[1]];
        let mirrors = [0, 1].map(|k| self.mirror[k].then_some(zero[k]));
        obstacle::Frame { zero, scale, region, mirrors, unit: f64::from(self.unit()) }
    }

    /// One for the usual font: lines grow with it.
    fn unit(&self) -> f32 {
        (self.font / 15.0).max(0.8)
    }

    /// Turns positions into pixels within the layer.
    fn place(&mut self, moment: &Moment<'_>, sign: [f64; 2]) {
        let zero = self.camera.pixel([0.0, 0.0]);
        let [x0, y0] = [zero[0] - self.plot[0] as f64, zero[1] - self.plot[1] as f64];
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
        let [left, top, right, bottom] = self.plot.map(|v| v as f32);
        let font = self.font;
        let pen = Pen { size: font, weight: Weight::Regular, colour: TEXT };
        let thick = (font / 16.0).round().max(1.0);
        for (value, label) in axes.x.values.iter().zip(axes.x.labels()) {
            let x = self.camera.pixel([value / axes.unit.factor, 0.0])[0] as f32;
            self.still.vertical(x, top, bottom, thick, GRID);
            self.still.vertical(x, bottom, bottom + 0.3 * font, thick, BORDER);
            text::draw(&mut self.still, &label, x, bottom + 1.45 * font, Align::Centre, pen);
        }
        for (value, label) in axes.y.values.iter().zip(axes.y.labels()) {
            let y = self.camera.pixel([0.0, value / axes.unit.factor])[1] as f32;
            self.still.horizontal(left, right, y, thick, GRID);
            self.still.horizontal(left - 0.3 * font, left, y, thick, BORDER);
            text::draw(&mut self.still, &label, left - 0.55 * font, y + 0.36 * font, Align::Right, pen);
        }
        for y in [top, bottom] {
            self.still.horizontal(left, right, y, thick, BORDER);
        }
        for x in [left, right] {
            self.still.vertical(x, top, bottom, thick, BORDER);
        }
        let faint = Pen { colour: TEXT_FAINT, ..pen };
        let name = |axis: &str| format!("{axis}{}", axes.unit.bracket());
        text::draw(&mut self.still, &name("x"), 0.5 * (left + right), bottom + 2.9 * font, Align::Centre, faint);
        text::draw(&mut self.still, &name("y"), left, top - 0.6 * font, Align::Left, faint);
    }

    fn draw_title(&mut self, plan: &Plan<'_>) {
        let font = self.font;
        let pen = Pen { size: (1.22 * font).round(), weight: Weight::Bold, colour: TEXT };
        let room = self.still.width as f32 - 3.0 * font - text::width(plan.note, font, Weight::Regular);
        let title = text::fitted(plan.title, pen.size, pen.weight, room);
        text::draw(&mut self.still, &title, font, 1.95 * font, Align::Left, pen);
    }

    fn draw_key(&mut self, key: &Key) {
        let font = self.font;
        let pen = Pen { size: font, weight: Weight::Regular, colour: TEXT };
        let [_, top, right, bottom] = self.plot.map(|v| v as f32);
        let width = self.still.width as f32;
        match key {
            Key::Empty => {}
            Key::Bar { label, si, range, beyond, states } => {
                let bar = Bar::new(si, *range, states);
                let name = format!("{label}{}", bar.unit.bracket());
                let room = width - 6.0 * font;
                let name = text::fitted(&name, font, Weight::Regular, room);
                text::draw(&mut self.still, &name, width - font, top - 0.6 * font, Align::Right, pen);
                let (x0, x1) = ((right + 1.4 * font).round(), (right + 2.4 * font).round());
                self.draw_bar(x0, x1, top, bottom, *beyond);
                for (value, label) in bar.values.iter().zip(&bar.labels) {
                    let share = (value / bar.unit.factor - range[0]) / (range[1] - range[0]);
                    let y = bottom - (f64::from(bottom - top) * share) as f32;
                    self.still.horizontal(x1, x1 + 0.3 * font, y, (font / 16.0).round().max(1.0), TEXT_FAINT);
                    let baseline = (y + 0.36 * font).clamp(top + 0.6 * font, bottom + 0.2 * font);
                    text::draw(&mut self.still, label, x1 + 0.6 * font, baseline, Align::Left, pen);
                }
            }
            Key::Parts(names) => {
                let rows = (((bottom - top) / (1.7 * font)) as usize).max(1);
                let shown = if names.len() > rows { rows - 1 } else { names.len() };
                let x = right + 1.2 * font;
                let room = width - x - 2.0 * font;
                for (row, name) in names.iter().take(shown).enumerate() {
                    let y = top + 1.7 * font * row as f32;
                    self.still.rectangle(x, y + 0.1 * font, x + font, y + 1.1 * font, INK, 0.85);
                    self.still.rectangle(x + 1.0, y + 0.1 * font + 1.0, x + font - 1.0, y + 1.1 * font - 1.0, colour::part(row), 1.0);
                    let name = text::fitted(name, font, Weight::Regular, room);
                    text::draw(&mut self.still, &name, x + 1.5 * font, y + 0.97 * font, Align::Left, pen);
                }
                if shown < names.len() {
                    let more = format!("and {} more", names.len() - shown);
                    let pen = Pen { colour: TEXT_FAINT, ..pen };
                    text::draw(&mut self.still, &more, x, top + 1.7 * font * shown as f32 + 0.97 * font, Align::Left, pen);
                }
            }
        }
    }

    /// The bar itself, with arrow ends where values lie beyond its range.
    fn draw_bar(&mut self, x0: f32, x1: f32, top: f32, bottom: f32, beyond: [bool; 2]) {
        let rows = top as usize..bottom as usize;
        let last = MAP.len() - 1;
        for y in rows.clone() {
            let share = 1.0 - (y - rows.start) as f32 / (rows.len().max(2) - 1) as f32;
            self.still.rectangle(x0, y as f32, x1, y as f32 + 1.0, MAP[((share * last as f32) + 0.5) as usize], 1.0);
        }
        let high = 0.8 * (x1 - x0);
        for (is_beyond, colour, edge, direction) in [(beyond[1], MAP[last], top, -1.0), (beyond[0], MAP[0], bottom, 1.0)] {
            for row in 0..if is_beyond { high as usize } else { 0 } {
                let inset = 0.5 * (x1 - x0) * (row as f32 + 0.5) / high;
                let y = if direction < 0.0 { edge - row as f32 - 1.0 } else { edge + row as f32 };
                self.still.rectangle(x0 + inset, y, x1 - inset, y + 1.0, colour, 1.0);
            }
        }
    }

    /// Dash-dotted lines at x = 0 and y = 0 where the picture is mirrored there.
    fn draw_symmetry(&self, canvas: &mut Canvas) {
        let [left, top, right, bottom] = self.plot.map(|v| v as f32);
        let zero = self.camera.pixel([0.0, 0.0]).map(|v| v as f32);
        let font = self.font;
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

/// Ticks of the colour bar.
struct Bar {
    unit: Unit,
    values: Vec<f64>,
    labels: Vec<String>,
}

impl Bar {
    fn new(si: &str, range: [f64; 2], states: &[&str]) -> Self {
        let unit = unit(si, range[0].abs().max(range[1].abs()));
        if states.is_empty() {
            let ticks = ticks(range[0] * unit.factor, range[1] * unit.factor, 6);
            return Self { labels: ticks.labels(), values: ticks.values, unit };
        }
        Self { values: (0..states.len()).map(|k| k as f64).collect(), labels: states.iter().map(ToString::to_string).collect(), unit }
    }
}

/// Room right of the plot.
fn key_width(plan: &Plan<'_>, font: f32, width: f32) -> f32 {
    let widest = |labels: &[String]| labels.iter().map(|l| text::width(l, font, Weight::Regular)).fold(0.0, f32::max);
    match &plan.key {
        Key::Empty => 1.5 * font,
        Key::Bar { si, range, states, .. } => 4.0 * font + widest(&Bar::new(si, *range, states).labels),
        Key::Parts(names) => (4.2 * font + widest(names)).min(0.3 * width),
    }
}

/// The box with some air around; a box without size gets one.
fn padded(view: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let sound = view.iter().flatten().all(|v| v.is_finite() && v.abs() < 1e30) && view[0][0] <= view[1][0] && view[0][1] <= view[1][1];
    let [low, high] = if sound { view } else { [[-1.0; 2], [1.0; 2]] };
    let largest = (0..2).map(|k| low[k].abs().max(high[k].abs())).fold(0.0, f64::max);
    let size = (high[0] - low[0]).max(high[1] - low[1]).max(1e-6 * largest).max(1e-9);
    let half = |k: usize| 0.5 * (high[k] - low[k]).max(0.05 * size) + 0.04 * size;
    let centre = |k: usize| 0.5 * (low[k] + high[k]);
    [[centre(0) - half(0), centre(1) - half(1)], [centre(0) + half(0), centre(1) + half(1)]]
}
