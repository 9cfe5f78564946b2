//! Text in pixel pictures: outlines of the embedded DejaVu Sans, filled by the same rasteriser as the bodies.
//! Strings come from `scene`; widths also serve `svg`, whose readers use fonts that are no wider.

use super::colour::Rgb;
use super::raster::{Canvas, Coverage};
use std::sync::LazyLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Which cut of the font.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Weight {
    Regular,
    Bold,
}

/// Which point of the text stands at the given x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

/// Size, cut and colour of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    /// Height of the em square, pixels.
    pub(super) size: f32,
    pub(super) weight: Weight,
    pub(super) colour: Rgb,
}

static REGULAR: LazyLock<Face<'static>> =
    LazyLock::new(|| Face::parse(dejavu::sans::regular(), 0).expect("the font is a whole file inside the program"));
static BOLD: LazyLock<Face<'static>> =
    LazyLock::new(|| Face::parse(dejavu::sans::bold(), 0).expect("the font is a whole file inside the program"));

fn face(weight: Weight) -> &'static Face<'static> {
    match weight {
        Weight::Regular => &REGULAR,
        Weight::Bold => &BOLD,
    }
}

/// Glyphs of a line with their advances in font units; control characters become spaces.
fn glyphs(face: &'static Face<'static>, line: &str) -> impl Iterator<Item = (GlyphId, f32)> {
    line.chars().map(move |c| {
        let glyph = face.glyph_index(if c.is_control() { ' ' } else { c }).unwrap_or(GlyphId(0));
        (glyph, f32::from(face.glyph_hor_advance(glyph).unwrap_or(0)))
    })
}

/// Width of a line, pixels.
pub(super) fn width(line: &str, size: f32, weight: Weight) -> f32 {
    let face = face(weight);
    glyphs(face, line).map(|(_, advance)| advance).sum::<f32>() * size / f32::from(face.units_per_em())
}

/// `line`, shortened with an ellipsis if it is wider than `room` pixels.
pub(super) fn fitted(line: &str, size: f32, weight: Weight, room: f32) -> String {
    if width(line, size, weight) <= room {
        return line.to_string();
    }
    let mut short = String::new();
    for c in line.chars() {
        let longer = format!("{short}{c}…");
        if width(&longer, size, weight) > room {
            break;
        }
        short.push(c);
    }
    format!("{}…", short.trim_end())
}

/// Draws `line` with its baseline at `baseline`, aligned at `x`; parts outside the canvas are cut off.
pub(super) fn draw(canvas: &mut Canvas, line: &str, x: f32, baseline: f32, align: Align, pen: Pen) {
    let face = face(pen.weight);
    let scale = pen.size / f32::from(face.units_per_em());
    let shift = match align {
        Align::Left => 0.0,
        Align::Centre => 0.5,
        Align::Right => 1.0,
    };
    let mut x = x - shift * width(line, pen.size, pen.weight);
    let baseline = baseline.round();
    let mut coverage = Coverage::default();
    for (glyph, advance) in glyphs(face, line) {
        if let Some(bounds) = face.glyph_bounding_box(glyph) {
            let left = (x + scale * f32::from(bounds.x_min)).floor() - 1.0;
            let top = (baseline - scale * f32::from(bounds.y_max)).floor() - 1.0;
            let wide = (scale * f32::from(bounds.x_max - bounds.x_min)).ceil() as usize + 3;
            let high = (scale * f32::from(bounds.y_max - bounds.y_min)).ceil() as usize + 3;
            coverage.begin(wide, high);
            let mut outline = Outline { coverage: &mut coverage, scale, origin: [x - left, baseline - top], at: [0.0; 2], start: [0.0; 2] };
            let _ = face.outline_glyph(glyph, &mut outline);
            coverage.pixels(|column, row, alpha| canvas.blend(left as i64 + column as i64, top as i64 + row as i64, pen.colour, alpha));
        }
        x += advance * scale;
    }
}

/// Turns an outline into straight edges.
struct Outline<'a> {
    coverage: &'a mut Coverage,
    scale: f32,
    origin: [f32; 2],
    at: [f32; 2],
    start: [f32; 2],
}

impl Outline<'_> {
    fn pixel(&self, x: f32, y: f32) -> [f32; 2] {
        [self.origin[0] + self.scale * x, self.origin[1] - self.scale * y]
    }
    fn line(&mut self, to: [f32; 2]) {
        self.coverage.edge(self.at, to);
        self.at = to;
    }
}

/// Pieces per curve: below a twentieth of a pixel off at the sizes in use.
const PIECES: u8 = 6;

impl OutlineBuilder for Outline<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.at = self.pixel(x, y);
        self.start = self.at;
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.line(self.pixel(x, y));
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (a, b, c) = (self.at, self.pixel(x1, y1), self.pixel(x, y));
        for piece in 1..=PIECES {
            let t = f32::from(piece) / f32::from(PIECES);
            let s = 1.0 - t;
            self.line(std::array::from_fn(|k| s * s * a[k] + 2.0 * s * t * b[k] + t * t * c[k]));
        }
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.at, self.pixel(x1, y1), self.pixel(x2, y2), self.pixel(x, y));
        for piece in 1..=PIECES {
            let t = f32::from(piece) / f32::from(PIECES);
            let s = 1.0 - t;
            self.line(std::array::from_fn(|k| s * s * s * a[k] + 3.0 * s * t * (s * b[k] + t * c[k]) + t * t * t * d[k]));
        }
    }
    fn close(&mut self) {
        self.line(self.start);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::colour::WHITE;

    #[test]
    fn letters_leave_ink_where_they_stand() {
        let mut canvas = Canvas::new(120, 40);
        draw(&mut canvas, "t = 3.10 µs", 10.0, 28.0, Align::Left, Pen { size: 16.0, weight: Weight::Regular, colour: [0, 0, 0] });
        let dark =
            |range: std::ops::Range<usize>| canvas.pixels.chunks(120).flat_map(|row| &row[range.clone()]).filter(|p| p[0] < 100).count();
        assert!(dark(10..110) > 60);
        assert_eq!(dark(0..9), 0);
        assert!(canvas.pixels[..120 * 8].iter().all(|p| *p == WHITE));
    }

    #[test]
    fn text_off_the_canvas_is_cut_and_strange_characters_do_no_harm() {
        let mut canvas = Canvas::new(30, 10);
        let pen = Pen { size: 20.0, weight: Weight::Bold, colour: [0, 0, 0] };
        draw(&mut canvas, "左\u{0}\n🙂 far too long for this", -15.0, 2.0, Align::Left, pen);
        draw(&mut canvas, "", 1e9, -1e9, Align::Right, pen);
    }

    #[test]
    fn long_lines_end_in_an_ellipsis() {
        let short = fitted("a very long title of a very long model", 14.0, Weight::Bold, 120.0);
        assert!(short.ends_with('…') && width(&short, 14.0, Weight::Bold) <= 120.0, "{short}");
        assert_eq!(fitted("ring", 14.0, Weight::Bold, 120.0), "ring");
        assert_eq!(fitted("ring", 14.0, Weight::Bold, 0.0), "…");
    }
}
