//! Glyphs of a model over the picture of its mesh: arrows, supports, dots, rings, lines and outlines of
//! planes. What they stand for comes from [`crate::preview`]; `scene` and `space` say where places are in the
//! picture.

use super::colour::{INK, Rgb, WHITE, mix};
use super::raster::{Canvas, Layer, Shade};
use super::text::{self, Align, Pen, Weight};
use crate::preview::{Glyph, GlyphKind, KINDS, Symbol};

/// Length of the longest arrow, and of a support, pixels at the usual font.
const ARROW: f32 = 54.0;
const SUPPORT: f32 = 12.0;
/// How much of what is hidden is left, and corners of a circle.
const HIDDEN: f32 = 0.45;
const CORNERS: usize = 48;
/// Names are written beside the first so many symbols of a kind that has one symbol each.
const NAMED: usize = 12;

/// Where a place is in the plot, pixels from its upper left corner, and whether nothing hides it.
pub(super) type Spot = ([f32; 2], bool);

/// How a picture looks at places.
pub(super) struct Look<'a> {
    /// Of a place, m.
    pub(super) spot: &'a dyn Fn([f64; 3]) -> Spot,
    /// Of a vector of length 1: as it is seen, to the right and downwards.
    pub(super) seen: &'a dyn Fn([f64; 3]) -> [f32; 2],
    /// Pixels of a length, m.
    pub(super) pixels: f64,
    /// Left, top, right and bottom of the plot.
    pub(super) plot: [usize; 4],
    /// One for the usual font.
    pub(super) unit: f32,
    pub(super) font: f32,
}

/// The kinds that a model has, with a label for the legend.
pub(super) fn legend(glyphs: &[Glyph]) -> Vec<(&'static GlyphKind, String)> {
    let of = |kind: &&'static GlyphKind| {
        let count = glyphs.iter().filter(|glyph| glyph.kind == *kind).count();
        let label = if count > 1 { format!("{} ({count})", kind.label) } else { kind.label.to_string() };
        (count > 0).then_some((*kind, label))
    };
    KINDS.iter().filter_map(of).collect()
}

/// Draws all glyphs on a canvas; faults last.
pub(super) fn draw(canvas: &mut Canvas, glyphs: &[Glyph], look: &Look<'_>) {
    let [left, top, right, bottom] = look.plot;
    let mut layer = Layer::new(right.min(canvas.width) - left, bottom.min(canvas.height) - top);
    for kind in KINDS.iter().rev() {
        for glyph in glyphs.iter().filter(|glyph| glyph.kind == *kind) {
            let mut brush = Brush { layer: &mut layer, canvas: &mut *canvas, corner: [left, top], unit: look.unit, rim: 1.0 };
            brush.glyph(glyph, look);
        }
    }
    let pen = Pen { size: 0.9 * look.font, weight: Weight::Bold, colour: INK };
    let named = glyphs.iter().filter(|glyph| glyph.kind.symbol == Symbol::Ring && glyph.points.len() == 1 && !glyph.name.is_empty());
    for glyph in named.take(NAMED) {
        let ([x, y], _) = (look.spot)(glyph.points[0]);
        let is_inside = x >= 0.0 && y >= 0.0 && x < (right - left) as f32 && y < (bottom - top) as f32;
        if is_inside {
            text::draw(canvas, &glyph.name, left as f32 + x + 10.0 * look.unit, top as f32 + y - 6.0 * look.unit, Align::Left, pen);
        }
    }
}

/// Draws one symbol of a kind in a square of a legend: left, top and side, pixels.
pub(super) fn sample(canvas: &mut Canvas, kind: &GlyphKind, [left, top, side]: [usize; 3], unit: f32) {
    if left + side > canvas.width || top + side > canvas.height {
        return;
    }
    let (middle, half) = (0.5 * side as f32, 0.5 * side as f32 - 1.0);
    let mut layer = Layer::new(side, side);
    let mut brush = Brush { layer: &mut layer, canvas, corner: [left, top], unit: unit.min(side as f32 / 18.0), rim: 1.0 };
    let ends = [[middle - half, middle], [middle + half, middle]];
    match kind.symbol {
        Symbol::Arrow | Symbol::Push => brush.arrow(ends, kind.colour),
        Symbol::Support => brush.support([middle, middle - 0.4 * half], [0.0, -1.0], kind.colour),
        Symbol::Dot => brush.disk([middle, middle], 3.4 * unit, kind.colour),
        Symbol::Ring => brush.ring([middle, middle], 0.8 * half, kind.colour),
        Symbol::Line | Symbol::Plane => brush.stroke(ends, 2.4 * unit, kind.colour),
    }
}

/// What draws on a canvas, with the corner of its layer there.
struct Brush<'a> {
    layer: &'a mut Layer,
    canvas: &'a mut Canvas,
    corner: [usize; 2],
    unit: f32,
    /// How wide the light rims are, for one.
    rim: f32,
}

impl Brush<'_> {
    fn glyph(&mut self, glyph: &Glyph, look: &Look<'_>) {
        let spots: Vec<Spot> = glyph.points.iter().map(|&point| (look.spot)(point)).collect();
        let pale = |is_seen: bool| if is_seen { glyph.kind.colour } else { mix(WHITE, glyph.kind.colour, HIDDEN) };
        match glyph.kind.symbol {
            Symbol::Line => {
                for pair in spots.chunks_exact(2) {
                    self.stroke([pair[0].0, pair[1].0], 2.6 * self.unit, glyph.kind.colour);
                    pair.iter().for_each(|(at, _)| self.disk(*at, 3.0 * self.unit, glyph.kind.colour));
                }
            }
            Symbol::Plane => {
                let pairs = spots.iter().zip(spots.iter().cycle().skip(1)).take(if spots.len() == 2 { 1 } else { spots.len() });
                pairs.for_each(|(a, b)| self.stroke([a.0, b.0], 1.8 * self.unit, glyph.kind.colour));
            }
            Symbol::Arrow | Symbol::Push | Symbol::Support | Symbol::Dot | Symbol::Ring => {
                // What is hidden lies under what is seen, pale and without a rim.
                for seen in [false, true] {
                    self.rim = if seen { 1.0 } else { 0.0 };
                    for (&(at, _), &vector) in spots.iter().zip(&glyph.vectors).filter(|((_, is_seen), _)| *is_seen == seen) {
                        self.symbol(glyph.kind.symbol, at, vector, pale(seen), look);
                    }
                }
                self.rim = 1.0;
            }
        }
    }

    fn symbol(&mut self, symbol: Symbol, at: [f32; 2], vector: [f64; 3], colour: Rgb, look: &Look<'_>) {
        let [x, y] = (look.seen)(vector);
        let tip = |length: f32| [at[0] + length * x, at[1] + length * y];
        match symbol {
            Symbol::Arrow => self.arrow([at, tip(ARROW * self.unit)], colour),
            Symbol::Push => self.arrow([tip(-0.6 * ARROW * self.unit), at], colour),
            Symbol::Support => self.support(at, [x, y], colour),
            Symbol::Dot => self.disk(at, 2.3 * self.unit, colour),
            Symbol::Ring => {
                let radius = (vector[0] * look.pixels) as f32;
                self.ring(at, radius.max(7.5 * self.unit), colour);
            }
            Symbol::Line | Symbol::Plane => {}
        }
    }

    /// Fills a polygon over a white rim, by which it is seen on any ground.
    fn fill(&mut self, polygon: &[[f32; 2]], colour: Rgb) {
        let count = polygon.len();
        if self.rim > 0.0 {
            for k in 0..count {
                self.layer.stroke(polygon[k], polygon[(k + 1) % count], 2.0 * self.rim * self.unit, Shade::Flat(WHITE.map(f32::from)));
            }
            self.compose();
        }
        self.layer.fill(polygon, Shade::Flat(colour.map(f32::from)));
        self.compose();
    }

    fn compose(&mut self) {
        self.layer.compose(self.canvas, self.corner[0], self.corner[1]);
    }

    fn stroke(&mut self, [a, b]: [[f32; 2]; 2], thick: f32, colour: Rgb) {
        self.layer.stroke(a, b, thick + 1.6 * self.unit, Shade::Flat(WHITE.map(f32::from)));
        self.compose();
        self.layer.stroke(a, b, thick, Shade::Flat(colour.map(f32::from)));
        self.compose();
    }

    fn arrow(&mut self, [from, to]: [[f32; 2]; 2], colour: Rgb) {
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        // One that points at the viewer.
        if !(length > 3.0 * self.unit) {
            self.disk(from, 3.0 * self.unit, colour);
            return;
        }
        let [x, y] = along.map(|v| v / length);
        let head = (11.0 * self.unit).min(0.7 * length);
        let (shaft, wide) = (1.15 * self.unit, 0.42 * head);
        let at = |s: f32, t: f32| [from[0] + s * x - t * y, from[1] + s * y + t * x];
        let neck = length - head;
        self.fill(
            &[at(0.0, shaft), at(neck, shaft), at(neck, wide), at(length, 0.0), at(neck, -wide), at(neck, -shaft), at(0.0, -shaft)],
            colour,
        );
    }

    /// A triangle whose tip is at the point and that stands against the direction; a square where there is
    /// none.
    fn support(&mut self, at: [f32; 2], [x, y]: [f32; 2], colour: Rgb) {
        let size = SUPPORT * self.unit;
        let length = x.hypot(y);
        if length < 0.2 {
            let half = 0.32 * size;
            self.fill(&[[-half, -half], [half, -half], [half, half], [-half, half]].map(|[u, v]| [at[0] + u, at[1] + v]), colour);
            return;
        }
        let [x, y] = [x / length, y / length];
        let place = |s: f32, t: f32| [at[0] - s * x - t * y, at[1] - s * y + t * x];
        self.fill(&[at, place(0.8 * size, 0.45 * size), place(0.8 * size, -0.45 * size)], colour);
    }

    fn disk(&mut self, at: [f32; 2], radius: f32, colour: Rgb) {
        self.fill(&circle(at, radius), colour);
    }

    fn ring(&mut self, at: [f32; 2], radius: f32, colour: Rgb) {
        let outline = circle(at, radius);
        for (thick, colour) in [(2.6 + 1.8 * self.rim, WHITE), (2.6, colour)] {
            for k in 0..CORNERS {
                let shade = Shade::Flat(colour.map(f32::from));
                self.layer.stroke(outline[k], outline[(k + 1) % CORNERS], thick * self.unit, shade);
            }
            self.compose();
        }
    }
}

fn circle([x, y]: [f32; 2], radius: f32) -> [[f32; 2]; CORNERS] {
    std::array::from_fn(|k| {
        let (sin, cos) = (std::f32::consts::TAU * k as f32 / CORNERS as f32).sin_cos();
        [x + radius * cos, y + radius * sin]
    })
}
