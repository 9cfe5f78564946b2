//! Layout of a picture in 3D: the plot on its sheet, below it a cross of the axes and a scale; then one
//! moment after the other on a copy. `film` and `mesh` say what there is to show; `drawing` draws bodies and
//! obstacles, the canvas goes to `animation` or to a PNG.

use super::camera::{Directions, Sight};
use super::drawing::{Colour, Drawing, Scratch, Style};
use super::obstacle::Solid;
use super::raster::{FINE, Samples};
use super::skin::{Facet, Skin};
use crate::picture::body::{Values, floats, level};
use crate::picture::colour::{self, BORDER, DISTINCT, MAP, NO_VALUE, Rgb, SOLID, TEXT, TEXT_FAINT};
use crate::picture::glyphs::{self, Look};
use crate::picture::raster::{Canvas, Layer, Shade};
use crate::picture::scale::{number, ticks, unit};
use crate::picture::sheet::{Plan, Sheet, key_height, key_width, measures, padded};
use crate::picture::text::{self, Align, Pen, Weight};
use crate::preview::Glyph;

/// Lines of bodies and of obstacles at the usual font: thickness, pixels, and strength, of edges of elements
/// and of outlines.
const BODY: Style = Style { edge: [0.9, 0.34], outline: [1.25, 0.8] };
const OBSTACLE: Style = Style { edge: [0.9, 0.0], outline: [1.1, 0.5] };
/// Thickness and strength of a grid on an obstacle.
const GRID: [f32; 2] = [0.9, 0.22];
/// Half the thickness of a bar, pixels.
const ROD: f32 = 1.7;
/// A glyph is seen where nothing is nearer by more than this, pixels.
const LIFT: f32 = 4.0;
/// Nodes that are closer to a mirror plane than this fraction of the picture lie on it.
const ON_PLANE: f64 = 1e-5;

/// A laid-out picture.
#[derive(Clone, Debug)]
pub(in crate::picture) struct Scene {
    sheet: Sheet,
    sight: Sight,
    mirror: [bool; 3],
    /// Samples per metre, and the place in the picture (right, up, m) that is in the middle of the plot.
    scale: f64,
    centre: [f64; 2],
    bodies: Samples,
    obstacles: Samples,
    points: Vec<[f32; 3]>,
    planes: Vec<u8>,
    room: Scratch,
}

/// One moment of a film.
#[derive(Clone, Copy, Debug)]
pub(in crate::picture) struct Moment<'a> {
    pub(in crate::picture) skin: &'a Skin,
    /// Places of the skin's nodes, m, from `origin`.
    pub(in crate::picture) positions: &'a [[f32; 3]],
    pub(in crate::picture) origin: [f64; 3],
    pub(in crate::picture) obstacles: &'a [Solid],
    /// Of nodes of the skin, or of its facets and then its bars.
    pub(in crate::picture) values: Values<'a>,
    /// Text at the upper right.
    pub(in crate::picture) note: &'a str,
}

impl Scene {
    /// Lays out and draws what does not change. The picture has the wanted width; it is as high as the bodies
    /// need, at most the wanted height.
    pub(in crate::picture) fn new(plan: &Plan<'_>, sight: &Sight) -> Self {
        let (width, height_max, font) = measures(plan.size);
        let view = padded(plan.view);
        let span = [view[1][0] - view[0][0], view[1][1] - view[0][1]];
        let (top, below) = ((4.6 * font).round(), (5.4 * font).round());
        let left = font.round();
        let right = (width - key_width(plan, font, width)).round().max(left + 20.0);
        let wide = right - left;
        let most = (height_max - top - below).max(20.0);
        let natural = (f64::from(wide) * span[1] / span[0]).min(1e5) as f32;
        let high = natural.clamp((13.0 * font).max(key_height(&plan.key, font)).min(most), most).round();
        let scale = (f64::from(wide) / span[0]).min(f64::from(high) / span[1]);
        let plot = [left as usize, top as usize, right as usize, (top + high) as usize];
        let still = Canvas::new(width as usize, (top + high + below).round() as usize);
        let [wide, high] = [plot[2].min(still.width) - plot[0], plot[3] - plot[1]];
        let mut scene = Self {
            sheet: Sheet { still, plot, font },
            sight: sight.clone(),
            mirror: plan.mirror,
            scale: FINE as f64 * scale,
            centre: [0, 1].map(|k| 0.5 * (view[0][k] + view[1][k])),
            bodies: Samples::new(wide, high),
            obstacles: Samples::new(wide, high),
            points: Vec::new(),
            planes: Vec::new(),
            room: Scratch::default(),
        };
        scene.draw_border();
        scene.draw_cross();
        scene.draw_scale(scale);
        scene.sheet.write(plan);
        scene
    }

    /// The canvas to start each frame from.
    pub(in crate::picture) fn still(&self) -> &Canvas {
        &self.sheet.still
    }

    /// Draws a moment on `canvas`, which is overwritten.
    pub(in crate::picture) fn draw(&mut self, moment: &Moment<'_>, canvas: &mut Canvas) {
        canvas.clone_from(&self.sheet.still);
        let map: Vec<[f32; 3]> = MAP.iter().map(|c| floats(*c)).collect();
        self.bodies.clear();
        self.obstacles.clear();
        let images = self.sight.images.clone();
        for sign in &images {
            self.place(moment.origin, moment.positions.iter().map(|p| p.map(f64::from)), *sign);
            let mut samples = std::mem::replace(&mut self.bodies, Samples::new(0, 0));
            let mut room = std::mem::take(&mut self.room);
            for (index, bar) in moment.skin.bars.iter().enumerate() {
                let colour = self.bar_colour(index, moment, &map);
                let ends = bar.nodes.map(|node| self.points[node as usize]);
                samples.rod(ends, ROD * self.sheet.unit() * FINE as f32, colour);
            }
            let colour = |index: usize, facet: &Facet| facet_colour(index, facet, moment.values, &map);
            self.drawing(moment.skin, *sign).draw(&mut samples, &mut room, &map, self.style(BODY), colour);
            (self.bodies, self.room) = (samples, room);
        }
        for sign in &images {
            moment.obstacles.iter().for_each(|obstacle| self.draw_obstacle(obstacle, *sign));
        }
        let obstacles = (!moment.obstacles.is_empty()).then_some(&self.obstacles);
        self.bodies.compose(obstacles, canvas, self.sheet.plot[0], self.sheet.plot[1]);
        self.sheet.note(canvas, moment.note);
    }

    /// Draws glyphs over a moment; those behind bodies are pale.
    pub(in crate::picture) fn draw_glyphs(&self, glyphs: &[Glyph], canvas: &mut Canvas) {
        let [left, top, right, bottom] = self.sheet.plot;
        let middle = [0.5 * (FINE * (right - left)) as f64, 0.5 * (FINE * (bottom - top)) as f64];
        let directions = &self.sight.directions;
        let spot = |place: [f64; 3]| {
            let [x, y, z] = directions.seen(place);
            let sample = [middle[0] + self.scale * (x - self.centre[0]), middle[1] - self.scale * (y - self.centre[1]), self.scale * z];
            let sample = sample.map(|v| v as f32);
            ([sample[0] / FINE as f32, sample[1] / FINE as f32], self.bodies.is_seen(sample, LIFT * FINE as f32))
        };
        let seen = |vector: [f64; 3]| {
            let [x, y, _] = directions.seen(vector);
            [x as f32, -y as f32]
        };
        let pixels = self.scale / FINE as f64;
        let look = Look { spot: &spot, seen: &seen, pixels, plot: self.sheet.plot, unit: self.sheet.unit(), font: self.sheet.font };
        glyphs::draw(canvas, glyphs, &look);
    }

    fn draw_obstacle(&mut self, obstacle: &Solid, sign: [f64; 3]) {
        self.place([0.0; 3], obstacle.points.iter().copied(), sign);
        let mut samples = std::mem::replace(&mut self.obstacles, Samples::new(0, 0));
        let mut room = std::mem::take(&mut self.room);
        let colour = |_: usize, _: &Facet| Colour::Flat(floats(SOLID));
        self.drawing(&obstacle.skin, sign).draw(&mut samples, &mut room, &[], self.style(OBSTACLE), colour);
        let half = 0.5 * GRID[0] * self.sheet.unit() * FINE as f32;
        self.place([0.0; 3], obstacle.grid.iter().flatten().copied(), sign);
        for ends in self.points.as_chunks().0 {
            // On a plane that is seen at a small angle its depth changes much across a line.
            samples.line(*ends, half, GRID[1], 6.0 * half + 1.0);
        }
        (self.obstacles, self.room) = (samples, room);
    }

    fn style(&self, style: Style) -> Style {
        let unit = self.sheet.unit();
        Style { edge: [unit * style.edge[0], style.edge[1]], outline: [unit * style.outline[0], style.outline[1]] }
    }

    /// Turns places from `origin` (m) into samples from the plot's corner, and reports on which mirror planes
    /// they lie.
    fn place(&mut self, origin: [f64; 3], places: impl Iterator<Item = [f64; 3]>, sign: [f64; 3]) {
        let directions = self.sight.directions.mirrored(sign);
        let [x0, y0, z0] = directions.seen(origin);
        let [left, top, right, bottom] = self.sheet.plot;
        let middle = [0.5 * (FINE * (right - left)) as f64, 0.5 * (FINE * (bottom - top)) as f64];
        let near = ON_PLANE * (right - left) as f64 * FINE as f64 / self.scale;
        let has_mirror = self.mirror.contains(&true);
        self.points.clear();
        self.planes.clear();
        for place in places {
            let [x, y, z] = directions.seen(place);
            let at = [
                middle[0] + self.scale * (x0 + x - self.centre[0]),
                middle[1] - self.scale * (y0 + y - self.centre[1]),
                self.scale * (z0 + z),
            ];
            self.points.push(at.map(|v| v as f32));
            if has_mirror {
                let on = |k: usize| u8::from(self.mirror[k] && (origin[k] + place[k]).abs() <= near) << k;
                self.planes.push(on(0) | on(1) | on(2));
            }
        }
    }

    fn drawing<'a>(&'a self, skin: &'a Skin, sign: [f64; 3]) -> Drawing<'a> {
        let Directions { right, up, towards } = self.sight.directions;
        let axes = [0, 1, 2].map(|k| [right[k], up[k], towards[k]].map(|v| v as f32));
        Drawing { skin, points: &self.points, planes: &self.planes, axes, is_turned: sign[0] * sign[1] * sign[2] < 0.0 }
    }

    fn bar_colour(&self, index: usize, moment: &Moment<'_>, map: &[[f32; 3]]) -> Rgb {
        let bar = &moment.skin.bars[index];
        let of_level = |level: Option<f32>| level.map_or(NO_VALUE, |level| map[(level + 0.5) as usize].map(|c| c as u8));
        match moment.values {
            Values::Plain => NO_VALUE,
            Values::Parts => colour::part(bar.part as usize),
            Values::Cells(values, range) => of_level(values.get(moment.skin.facets.len() + index).and_then(|v| level(*v, range))),
            Values::Nodes(values, range) => {
                let ends = bar.nodes.map(|node| values.get(node as usize).and_then(|v| level(*v, range)));
                of_level(ends[0].zip(ends[1]).map(|(a, b)| 0.5 * (a + b)))
            }
        }
    }

    fn draw_border(&mut self) {
        let [left, top, right, bottom] = self.sheet.plot.map(|v| v as f32);
        let thick = (self.sheet.font / 16.0).round().max(1.0);
        for y in [top, bottom] {
            self.sheet.still.horizontal(left, right, y, thick, BORDER);
        }
        for x in [left, right] {
            self.sheet.still.vertical(x, top, bottom, thick, BORDER);
        }
    }

    /// The axes as the camera sees them, those that point away first.
    fn draw_cross(&mut self) {
        let font = self.sheet.font;
        let [left, _, _, bottom] = self.sheet.plot.map(|v| v as f32);
        let middle = [left + 2.7 * font, bottom + 2.95 * font];
        let Directions { right, up, towards } = self.sight.directions;
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| towards[i].total_cmp(&towards[j]));
        let mut layer = Layer::new(self.sheet.still.width, self.sheet.still.height);
        for axis in order {
            let along = [right[axis] as f32, -up[axis] as f32];
            let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
            let tip = [0, 1].map(|k| middle[k] + 1.7 * font * along[k]);
            let colour = AXES[axis];
            layer.stroke(middle, tip, 0.13 * font, Shade::Flat(floats(colour)));
            layer.compose(&mut self.sheet.still, 0, 0);
            // The name of an axis that points at the viewer stands beside the middle.
            let aside = if length > 0.15 {
                [0, 1].map(|k| tip[k] + 0.62 * font * along[k] / length)
            } else {
                [middle[0] + 0.6 * font, middle[1] + 0.6 * font]
            };
            let pen = Pen { size: 0.95 * font, weight: Weight::Bold, colour };
            text::draw(&mut self.sheet.still, ["x", "y", "z"][axis], aside[0], aside[1] + 0.28 * font, Align::Centre, pen);
        }
    }

    /// A length, with its name: parallel to the picture all lengths have one scale.
    fn draw_scale(&mut self, pixels: f64) {
        let font = self.sheet.font;
        let [left, _, right, bottom] = self.sheet.plot.map(|v| v as f32);
        let whole = f64::from(right - left) / pixels;
        let unit = unit("m", whole);
        let step = ticks(0.0, whole * unit.factor, 7).step;
        let name = format!("{} {}", number(step, step), unit.name);
        let long = (step / unit.factor * pixels) as f32;
        let (x, y) = (left + 6.6 * font, bottom + 3.4 * font);
        let thick = (font / 10.0).round().max(1.0);
        self.sheet.still.horizontal(x, x + long, y, thick, TEXT_FAINT);
        for end in [x, x + long] {
            self.sheet.still.vertical(end, y - 0.35 * font, y + 0.35 * font, thick, TEXT_FAINT);
        }
        let pen = Pen { size: font, weight: Weight::Regular, colour: TEXT };
        text::draw(&mut self.sheet.still, &name, x + 0.5 * long, y - 0.7 * font, Align::Centre, pen);
    }
}

/// Colours of x, y and z.
pub(super) const AXES: [Rgb; 3] = [DISTINCT[1], DISTINCT[2], DISTINCT[0]];

/// Colour of a facet before it is lit.
fn facet_colour(index: usize, facet: &Facet, values: Values<'_>, map: &[[f32; 3]]) -> Colour {
    let of_level = |level: Option<f32>| Colour::Flat(level.map_or(floats(NO_VALUE), |level| map[(level + 0.5) as usize]));
    match values {
        Values::Plain => of_level(None),
        Values::Parts => Colour::Flat(floats(colour::part(facet.part as usize))),
        Values::Cells(values, range) => of_level(values.get(index).and_then(|v| level(*v, range))),
        Values::Nodes(values, range) => {
            let levels = facet.corners.map(|corner| values.get(corner as usize).and_then(|v| level(*v, range)));
            match levels {
                [Some(a), Some(b), Some(c), Some(d)] => Colour::Levels([a, b, c, d]),
                _ => of_level(None),
            }
        }
    }
}
