//! One look at bodies and obstacles in 3D, as an image within an SVG: what `near` and `spot` write their
//! lines and names on.
//!
//! Bodies are drawn as in all pictures in 3D; the image is a PNG in the text of the SVG itself, so that a
//! picture stays one file.

use super::camera::Directions;
use super::drawing::{Colour, Drawing, Scratch, Style};
use super::obstacle::Solid;
use super::raster::{FINE, Samples};
use super::scene::AXES;
use super::skin::{Facet, Skin};
use crate::picture::body::floats;
use crate::picture::colour::{Rgb, SOLID};
use crate::picture::raster::Canvas;
use crate::picture::svg::{hex, write_text};
use std::fmt::Write;

/// Pixels of the image for one of the SVG.
const SHARP: f64 = 1.5;
/// Lines of obstacles: thickness, pixels, and strength, of edges and of outlines.
const OBSTACLE: Style = Style { edge: [1.0, 0.0], outline: [1.3, 0.5] };
/// Strength of a grid on an obstacle.
const GRID: f32 = 0.2;

/// What is seen in a panel.
pub(super) struct Shot {
    directions: Directions,
    /// Width and height, pixels of the SVG.
    size: [f64; 2],
    /// Samples for a metre, and for a pixel of the SVG.
    scale: f64,
    fine: f64,
    /// Place that the picture is laid out from, m, and where it lies in the panel, pixels of the SVG from its
    /// upper left corner.
    origin: [f64; 3],
    at: [f64; 2],
    bodies: Samples,
    obstacles: Option<Samples>,
    room: Scratch,
}

impl Shot {
    /// An empty one: `scale` pixels for a metre, the place `origin` at the point `at` of the panel.
    pub(super) fn new(directions: Directions, size: [f64; 2], scale: f64, origin: [f64; 3], at: [f64; 2]) -> Self {
        let fine = SHARP * FINE as f64;
        let [wide, high] = size.map(|side| (SHARP * side).ceil().clamp(1.0, 4096.0) as usize);
        let bodies = Samples::new(wide, high);
        Self { directions, size, scale: fine * scale, fine, origin, at, bodies, obstacles: None, room: Scratch::default() }
    }

    /// To the right, downwards and towards the viewer, samples.
    fn sample(&self, place: [f64; 3]) -> [f32; 3] {
        let [right, up, towards] = self.directions.seen([0, 1, 2].map(|k| place[k] - self.origin[k]));
        [self.fine * self.at[0] + self.scale * right, self.fine * self.at[1] - self.scale * up, self.scale * towards].map(|v| v as f32)
    }

    /// Where a place is in the panel, pixels of the SVG from its upper left corner; what is far away is held
    /// back.
    pub(super) fn spot(&self, place: [f64; 3]) -> [f64; 2] {
        let [x, y, _] = self.sample(place);
        [x, y].map(|v| (f64::from(v) / self.fine).clamp(-9e4, 9e4))
    }

    /// Whether nothing hides a place by more than `lift`, pixels of the SVG.
    pub(super) fn is_seen(&self, place: [f64; 3], lift: f64) -> bool {
        self.bodies.is_seen(self.sample(place), (self.fine * lift) as f32)
    }

    fn points(&self, places: impl Iterator<Item = [f64; 3]>) -> Vec<[f32; 3]> {
        places.map(|place| self.sample(place)).collect()
    }

    fn axes(&self) -> [[f32; 3]; 3] {
        let Directions { right, up, towards } = self.directions;
        [0, 1, 2].map(|k| [right[k], up[k], towards[k]].map(|v| v as f32))
    }

    /// Draws bodies with their skin's nodes at these places, m.
    pub(super) fn bodies(&mut self, skin: &Skin, places: &[[f64; 3]], style: Style, colour: impl Fn(usize, &Facet) -> Colour) {
        let points = self.points(places.iter().copied());
        let style = self.style(style);
        let drawing = Drawing { skin, points: &points, planes: &[], axes: self.axes(), is_turned: false };
        drawing.draw(&mut self.bodies, &mut self.room, &[], style, colour);
    }

    /// Draws a line that bodies before it hide; `half` its thickness, pixels of the SVG.
    pub(super) fn rod(&mut self, ends: [[f64; 3]; 2], half: f64, colour: Rgb) {
        let half = (self.fine * half) as f32;
        // On an edge half of it would lie within the body.
        let ends = ends.map(|end| {
            let [x, y, depth] = self.sample(end);
            [x, y, depth + 2.0 * half + 1.0]
        });
        self.bodies.rod(ends, half, colour);
    }

    /// Draws an obstacle: a veil.
    pub(super) fn obstacle(&mut self, solid: &Solid) {
        let points = self.points(solid.points.iter().copied());
        let grid = self.points(solid.grid.iter().flatten().copied());
        let style = self.style(OBSTACLE);
        let [wide, high] = self.size.map(|side| (SHARP * side).ceil().clamp(1.0, 4096.0) as usize);
        let axes = self.axes();
        let samples = self.obstacles.get_or_insert_with(|| Samples::new(wide, high));
        let drawing = Drawing { skin: &solid.skin, points: &points, planes: &[], axes, is_turned: false };
        drawing.draw(samples, &mut self.room, &[], style, |_, _| Colour::Flat(floats(SOLID)));
        let half = (0.5 * self.fine) as f32;
        grid.as_chunks().0.iter().for_each(|ends| samples.line(*ends, half, GRID, 6.0 * half + 1.0));
    }

    /// As thick in the image as in the SVG.
    fn style(&self, style: Style) -> Style {
        let thick = |[thick, strength]: [f32; 2]| [SHARP as f32 * thick, strength];
        Style { edge: thick(style.edge), outline: thick(style.outline) }
    }

    /// Writes the image with its upper left corner here.
    pub(super) fn write(&self, out: &mut String, [left, top]: [f64; 2]) {
        let [wide, high] = self.size.map(|side| (SHARP * side).ceil().clamp(1.0, 4096.0) as usize);
        let mut canvas = Canvas::new(wide, high);
        self.bodies.compose(self.obstacles.as_ref(), &mut canvas, 0, 0);
        let Some(bytes) = png(&canvas) else { return };
        let _ = writeln!(
            out,
            "<image x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.2}\" height=\"{:.2}\" preserveAspectRatio=\"none\" \
                href=\"data:image/png;base64,{}\"/>",
            wide as f64 / SHARP,
            high as f64 / SHARP,
            base64(&bytes)
        );
    }

    /// The axes as they are seen, around a point of the SVG.
    pub(super) fn cross(&self, out: &mut String, [x, y]: [f64; 2]) {
        // Numbers of elements would run into its names.
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"33\" fill=\"#ffffff\" fill-opacity=\"0.85\"/>");
        let Directions { right, up, towards } = self.directions;
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| towards[i].total_cmp(&towards[j]));
        for axis in order {
            let along = [right[axis], -up[axis]];
            let length = along[0].hypot(along[1]);
            let colour = hex(AXES[axis]);
            let tip = [x + 20.0 * along[0], y + 20.0 * along[1]];
            let _ = writeln!(
                out,
                "<path d=\"M{x:.1} {y:.1}L{:.1} {:.1}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>",
                tip[0], tip[1]
            );
            let name = if length > 0.15 { [0, 1].map(|k| tip[k] + 7.0 * along[k] / length) } else { [x + 8.0, y + 8.0] };
            write_text(
                out,
                ["x", "y", "z"][axis],
                [name[0], name[1] + 4.0],
                "middle",
                AXES[axis],
                " font-size=\"12\" font-weight=\"bold\"",
            );
        }
    }
}

/// A canvas as the bytes of a PNG.
fn png(canvas: &Canvas) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, canvas.width as u32, canvas.height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(canvas.pixels.as_flattened()).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}

/// Bytes as text: RFC 4648, section 4.
pub(crate) fn base64(bytes: &[u8]) -> String {
    const SIGNS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let value = (0..3).fold(0u32, |value, k| value << 8 | u32::from(group.get(k).copied().unwrap_or(0)));
        for k in 0..4 {
            let sign = SIGNS[(value >> (18 - 6 * k) & 63) as usize];
            text.push(if k > group.len() { '=' } else { char::from(sign) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_the_text_of_the_standard() {
        // RFC 4648, section 10.
        let wanted = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (count, wanted) in wanted.into_iter().enumerate() {
            assert_eq!(base64(&b"foobar"[..count]), wanted);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xfe]), "+//+");
    }
}
