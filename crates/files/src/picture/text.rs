//! Text in pixel pictures, in the embedded DejaVu Sans.
//! Strings come from `scene`; widths also serve `svg`, whose readers use fonts that are no wider.

use super::colour::Rgb;
use super::raster::Canvas;
use ab_glyph::{Font, FontRef, GlyphId, point};
use std::sync::LazyLock;

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

static REGULAR: LazyLock<FontRef<'static>> = LazyLock::new(|| font(dejavu::sans::regular()));
static BOLD: LazyLock<FontRef<'static>> = LazyLock::new(|| font(dejavu::sans::bold()));

fn font(file: &'static [u8]) -> FontRef<'static> {
    FontRef::try_from_slice(file).expect("the font is a whole file inside the program")
}

impl Weight {
    fn font(self) -> &'static FontRef<'static> {
        match self {
            Self::Regular => &REGULAR,
            Self::Bold => &BOLD,
        }
    }
}

/// Font units of the em square.
fn units(font: &FontRef<'_>) -> f32 {
    font.units_per_em().unwrap_or(1.0)
}

/// Glyphs of a line with their advances in font units; control characters become spaces.
fn glyphs(font: &'static FontRef<'static>, line: &str) -> impl Iterator<Item = (GlyphId, f32)> {
    line.chars().map(move |c| {
        let glyph = font.glyph_id(if c.is_control() { ' ' } else { c });
        (glyph, font.h_advance_unscaled(glyph))
    })
}

/// Width of a line, pixels.
pub(super) fn width(line: &str, size: f32, weight: Weight) -> f32 {
    let font = weight.font();
    glyphs(font, line).map(|(_, advance)| advance).sum::<f32>() * size / units(font)
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
    let font = pen.weight.font();
    let scale = pen.size / units(font);
    let shift = match align {
        Align::Left => 0.0,
        Align::Centre => 0.5,
        Align::Right => 1.0,
    };
    let mut x = x - shift * width(line, pen.size, pen.weight);
    let baseline = baseline.round();
    // The crate measures sizes from the lowest to the highest line of the font.
    let height = scale * font.height_unscaled();
    for (glyph, advance) in glyphs(font, line) {
        if let Some(outline) = font.outline_glyph(glyph.with_scale_and_position(height, point(x, baseline))) {
            let corner = outline.px_bounds().min;
            outline.draw(|column, row, coverage| {
                canvas.blend(corner.x as i64 + i64::from(column), corner.y as i64 + i64::from(row), pen.colour, coverage);
            });
        }
        x += advance * scale;
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
