//! The sheet of a pixel picture: what stands around the plot of a model in 2D or 3D. Title,
//! note, colour bar or names of parts, all drawn once. `film` and `mesh` say what there is; `scene` and
//! `space` lay out the plot and draw in it.

use super::colour::{self, INK, MAP, TEXT, TEXT_FAINT};
use super::glyphs;
use super::raster::Canvas;
use super::scale::{Unit, ticks, unit};
use super::text::{self, Align, Pen, Weight};
use crate::preview::GlyphKind;

/// Height of the arrows at the ends of a colour bar, in widths of the bar.
const ARROW: f32 = 0.8;

/// What stands right of the plot.
#[derive(Clone, Debug)]
pub(super) enum Key {
    /// Nothing.
    Empty,
    /// A colour bar: name of the field, SI unit, range, whether values lie below or above it, and names of
    /// the values 0, 1, ... if they are states.
    Bar { label: String, si: &'static str, range: [f64; 2], beyond: [bool; 2], states: &'static [&'static str] },
    /// Names of parts, and what glyphs stand for.
    Parts { names: Vec<String>, glyphs: Vec<(&'static GlyphKind, String)> },
}

/// What a picture is made for.
#[derive(Clone, Debug)]
pub(super) struct Plan<'a> {
    pub(super) title: &'a str,
    pub(super) mirror: [bool; 3],
    /// In 2D: on which side of each mirror line the model lies, 1 or −1.
    pub(super) sides: [f64; 2],
    /// Largest size, pixels.
    pub(super) size: [u32; 2],
    /// Lower and upper corner of everything that must be seen, m, mirrored bodies included; in 3D to the
    /// right and upwards in the picture.
    pub(super) view: [[f64; 2]; 2],
    pub(super) key: Key,
    /// The longest text that stands at the upper right.
    pub(super) note: &'a str,
}

/// A picture with what does not change.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub(super) still: Canvas,
    /// Plot: left, top, right, bottom, pixels.
    pub(super) plot: [usize; 4],
    pub(super) font: f32,
}

/// Width, largest height and font size, pixels, of a picture of this size.
pub(super) fn measures(size: [u32; 2]) -> (f32, f32, f32) {
    let width = size[0].clamp(240, 8192) as f32;
    (width, (size[1].clamp(160, 8192) as f32).max(160.0), (6.0 + 0.0092 * width).max(10.5).round())
}

impl Sheet {
    /// Draws what belongs to the plan, around a plot that was laid out.
    pub(super) fn write(&mut self, plan: &Plan<'_>) {
        self.draw_title(plan);
        self.draw_key(&plan.key);
    }

    /// Writes the text of a moment on a canvas that began as this sheet.
    pub(super) fn note(&self, canvas: &mut Canvas, note: &str) {
        let pen = Pen { size: self.font, weight: Weight::Regular, colour: TEXT };
        text::draw(canvas, note, self.still.width as f32 - self.font, 1.95 * self.font, Align::Right, pen);
    }

    /// One for the usual font: lines grow with it.
    pub(super) fn unit(&self) -> f32 {
        (self.font / 15.0).max(0.8)
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
                // Arrows stand within the height of the plot: above it is the name.
                let arrow = |is_there: bool| if is_there { (ARROW * (x1 - x0)).floor() } else { 0.0 };
                let (top, bottom) = (top + arrow(beyond[1]), bottom - arrow(beyond[0]));
                self.draw_bar(x0, x1, top, bottom, *beyond);
                for (value, label) in bar.values.iter().zip(&bar.labels) {
                    let share = (value / bar.unit.factor - range[0]) / (range[1] - range[0]);
                    let y = bottom - (f64::from(bottom - top) * share) as f32;
                    self.still.horizontal(x1, x1 + 0.3 * font, y, (font / 16.0).round().max(1.0), TEXT_FAINT);
                    let baseline = (y + 0.36 * font).clamp(top + 0.6 * font, bottom + 0.2 * font);
                    text::draw(&mut self.still, label, x1 + 0.6 * font, baseline, Align::Left, pen);
                }
            }
            Key::Parts { names, glyphs } => {
                // Glyphs stand below the parts, half a row further.
                let rows =
                    (((bottom - top) / (1.7 * font)) as usize).saturating_sub(if glyphs.is_empty() { 0 } else { glyphs.len() + 1 }).max(1);
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
                let first = shown as f32 + if shown < names.len() { 1.5 } else { 0.5 };
                let unit = self.unit();
                for (row, (kind, label)) in glyphs.iter().enumerate() {
                    let y = top + 1.7 * font * (first + row as f32);
                    let side = (1.3 * font) as usize;
                    glyphs::sample(&mut self.still, kind, [(x - 0.15 * font) as usize, (y - 0.05 * font).max(0.0) as usize, side], unit);
                    let label = text::fitted(label, font, Weight::Regular, room);
                    text::draw(&mut self.still, &label, x + 1.5 * font, y + 0.97 * font, Align::Left, pen);
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
        let high = (ARROW * (x1 - x0)).floor();
        for (is_beyond, colour, edge, direction) in [(beyond[1], MAP[last], top, -1.0), (beyond[0], MAP[0], bottom, 1.0)] {
            for row in 0..if is_beyond { high as usize } else { 0 } {
                let inset = 0.5 * (x1 - x0) * (row as f32 + 0.5) / high;
                let y = if direction < 0.0 { edge - row as f32 - 1.0 } else { edge + row as f32 };
                self.still.rectangle(x0 + inset, y, x1 - inset, y + 1.0, colour, 1.0);
            }
        }
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
pub(super) fn key_width(plan: &Plan<'_>, font: f32, width: f32) -> f32 {
    let widest = |labels: &[String]| labels.iter().map(|l| text::width(l, font, Weight::Regular)).fold(0.0, f32::max);
    match &plan.key {
        Key::Empty => 1.5 * font,
        Key::Bar { si, range, states, .. } => 4.0 * font + widest(&Bar::new(si, *range, states).labels),
        Key::Parts { names, glyphs } => {
            let labels: Vec<String> = glyphs.iter().map(|(_, label)| label.clone()).collect();
            (4.2 * font + widest(names).max(widest(&labels))).min(0.3 * width)
        }
    }
}

/// Height that the names of parts and glyphs need right of the plot, pixels; of many parts no more than some.
pub(super) fn key_height(key: &Key, font: f32) -> f32 {
    match key {
        Key::Parts { names, glyphs } if !glyphs.is_empty() => 1.7 * font * (names.len().min(8) + glyphs.len() + 1) as f32,
        _ => 0.0,
    }
}

/// The box with some air around; a box without size gets one.
pub(super) fn padded(view: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let sound = view.iter().flatten().all(|v| v.is_finite() && v.abs() < 1e30) && view[0][0] <= view[1][0] && view[0][1] <= view[1][1];
    let [low, high] = if sound { view } else { [[-1.0; 2], [1.0; 2]] };
    let largest = (0..2).map(|k| low[k].abs().max(high[k].abs())).fold(0.0, f64::max);
    let size = (high[0] - low[0]).max(high[1] - low[1]).max(1e-6 * largest).max(1e-9);
    let half = |k: usize| 0.5 * (high[k] - low[k]).max(0.05 * size) + 0.04 * size;
    let centre = |k: usize| 0.5 * (low[k] + high[k]);
    [[centre(0) - half(0), centre(1) - half(1)], [centre(0) + half(0), centre(1) + half(1)]]
}
