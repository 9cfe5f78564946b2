//! The 255 colours of an animation: those of the colour map and its mixtures, or those of some pictures.
//! Canvases come from `film`; indices go to `animation`.

use super::body::Look;
use super::colour::{BORDER, GRID, INK, MAP, NO_VALUE, Rgb, SOLID, TEXT, TEXT_FAINT, WHITE, mix};
use super::raster::Canvas;

/// Colours of the film: the map itself, the map under element edges and outlines, the map fading into the
/// white background, greys.
#[derive(Clone, Debug)]
pub(super) struct Palette {
    colours: Vec<Rgb>,
    /// Index for each colour of six bits a channel; `UNKNOWN` until it is first needed.
    nearest: Vec<u8>,
}

/// Colours of the map, without light, in the palette of pictures in 3D.
const OF_MAP: usize = 64;

/// Index that stands for "as in the frame before" in files, and for "not looked up" in the palette.
pub(super) const UNKNOWN: u8 = 255;

impl Palette {
    pub(super) fn new(looks: &[Look]) -> Self {
        let edge = looks.iter().map(|look| look.edge).fold(0.0, f32::max);
        let outline = looks.iter().map(|look| look.outline).fold(0.3, f32::max);
        let mut colours = vec![WHITE, GRID, BORDER, SOLID, NO_VALUE, TEXT, TEXT_FAINT];
        let of_map = |colours: &mut Vec<Rgb>, count: usize, over: Rgb, alpha: f32| {
            colours.extend((0..count).map(|k| mix(MAP[k * (MAP.len() - 1) / (count - 1)], over, alpha)));
        };
        of_map(&mut colours, 96, INK, 0.0);
        of_map(&mut colours, 40, INK, 0.85 * edge.max(0.1));
        of_map(&mut colours, 32, INK, 0.5 * outline);
        of_map(&mut colours, 14, INK, outline);
        of_map(&mut colours, 28, WHITE, 0.5);
        of_map(&mut colours, 8, WHITE, 0.8);
        let greys = 255 - colours.len();
        colours.extend((0..greys).map(|k| mix(INK, WHITE, (k as f32 + 0.5) / greys as f32)));
        Self::with(colours)
    }

    fn with(colours: Vec<Rgb>) -> Self {
        let mut palette = Self { colours, nearest: vec![UNKNOWN; 1 << 18] };
        // Its own colours are found exactly; of those with the same six bits the first.
        for index in (0..palette.colours.len()).rev() {
            palette.nearest[key(palette.colours[index])] = index as u8;
        }
        palette
    }

    /// The colours of some pictures. Their boxes in the cube of colours are halved until there are enough
    /// (median cut; Heckbert 1982).
    pub(super) fn of(pictures: &[Canvas]) -> Self {
        let mut counts = vec![0u32; 1 << 18];
        for pixel in pictures.iter().flat_map(|picture| &picture.pixels) {
            counts[key(*pixel)] += 1;
        }
        let bin =
            |(key, &count): (usize, &u32)| (count > 0).then(|| Bin { colour: [12, 6, 0].map(|bits| (key >> bits & 63) as u8), count });
        let mut fixed = vec![WHITE, GRID, BORDER, SOLID, NO_VALUE, TEXT, TEXT_FAINT, INK];
        // The colour bar must be smooth even where few pixels have its colours.
        fixed.extend((0..OF_MAP).map(|k| MAP[k * (MAP.len() - 1) / (OF_MAP - 1)]));
        let mut boxes = vec![counts.iter().enumerate().filter_map(bin).collect::<Vec<Bin>>()];
        while boxes.len() + fixed.len() < 255 {
            let largest = (0..boxes.len()).max_by_key(|&k| (spread(&boxes[k]), std::cmp::Reverse(k)));
            let Some(largest) = largest.filter(|&k| boxes[k].len() > 1) else { break };
            let half = halved(&mut boxes[largest]);
            boxes.push(half);
        }
        let mut colours = fixed;
        colours.extend(boxes.iter().filter(|bins| !bins.is_empty()).map(|bins| mean(bins)));
        colours.resize(255, WHITE);
        Self::with(colours)
    }

    pub(super) fn bytes(&self) -> Vec<u8> {
        self.colours.as_flattened().to_vec()
    }

    #[inline]
    fn index(&mut self, colour: Rgb) -> u8 {
        let known = self.nearest[key(colour)];
        if known == UNKNOWN { self.look_up(colour) } else { known }
    }

    #[cold]
    fn look_up(&mut self, colour: Rgb) -> u8 {
        let key = key(colour);
        // The middle of the colours with these bits: which of them is asked for first must not matter.
        let colour = colour.map(|c| c & !3 | 2);
        let distance = |other: &Rgb| -> i32 { (0..3).map(|k| (i32::from(other[k]) - i32::from(colour[k])).pow(2)).sum() };
        let best = self.colours.iter().enumerate().min_by_key(|(_, other)| distance(other));
        self.nearest[key] = best.map_or(0, |(index, _)| index as u8);
        self.nearest[key]
    }
}

/// Six bits of each channel.
fn key(colour: Rgb) -> usize {
    colour.iter().fold(0, |key, c| key << 6 | usize::from(c >> 2))
}

/// The pixels of a frame as places in the palette, row by row.
pub(super) type Indices = Vec<u8>;

impl Palette {
    /// A canvas in the colours of the palette. `like`: another one and its indices; rows that are the same
    /// are not looked up again.
    pub(super) fn indices(&mut self, canvas: &Canvas, like: Option<(&Canvas, &[u8])>) -> Indices {
        let mut indices = Vec::with_capacity(canvas.pixels.len());
        let mut last = (WHITE, self.index(WHITE));
        for (number, row) in canvas.pixels.chunks_exact(canvas.width.max(1)).enumerate() {
            let range = number * canvas.width..(number + 1) * canvas.width;
            if let Some((like, known)) = like
                && like.pixels.get(range.clone()) == Some(row)
            {
                indices.extend_from_slice(&known[range]);
                continue;
            }
            indices.extend(row.iter().map(|pixel| {
                if *pixel != last.0 {
                    last = (*pixel, self.index(*pixel));
                }
                last.1
            }));
        }
        indices
    }
}

/// Colours with the same six bits a channel.
#[derive(Clone, Copy, Debug)]
struct Bin {
    colour: [u8; 3],
    count: u32,
}

/// Lowest and highest value of a channel.
fn ends(bins: &[Bin], channel: usize) -> [u8; 2] {
    bins.iter().fold([u8::MAX, 0], |[low, high], bin| [low.min(bin.colour[channel]), high.max(bin.colour[channel])])
}

/// How much is to be won by halving: the longest side, and for how many pixels.
fn spread(bins: &[Bin]) -> u64 {
    let longest = (0..3).map(|channel| ends(bins, channel)).map(|[low, high]| u64::from(high.saturating_sub(low))).max().unwrap_or(0);
    // Rare colours count too: a small body must not be lost beside a large one.
    longest * longest * bins.iter().map(|bin| u64::from(bin.count)).sum::<u64>().isqrt()
}

/// Halves a box across its longest side so that each half has as many pixels; returns one half.
fn halved(bins: &mut Vec<Bin>) -> Vec<Bin> {
    let side = |channel: &usize| {
        let [low, high] = ends(bins, *channel);
        (high.saturating_sub(low), 3 - channel)
    };
    let channel = (0..3).max_by_key(side).unwrap_or(0);
    bins.sort_by_key(|bin| bin.colour[channel]);
    let whole: u64 = bins.iter().map(|bin| u64::from(bin.count)).sum();
    let mut sum = 0;
    let middle = bins.iter().position(|bin| {
        sum += u64::from(bin.count);
        2 * sum >= whole
    });
    bins.split_off((middle.unwrap_or(0) + 1).min(bins.len() - 1))
}

/// Mean of a box's pixels.
fn mean(bins: &[Bin]) -> Rgb {
    let whole: u64 = bins.iter().map(|bin| u64::from(bin.count)).sum();
    [0, 1, 2].map(|k| {
        let sum: u64 = bins.iter().map(|bin| u64::from(bin.count) * u64::from(4 * u16::from(bin.colour[k]) + 2)).sum();
        (sum / whole.max(1)) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_palette_is_full_and_knows_its_own_colours() {
        let mut palette = Palette::new(&[]);
        assert_eq!(palette.colours.len(), 255);
        for colour in [WHITE, GRID, BORDER, MAP[0], MAP[255], TEXT] {
            let index = usize::from(palette.index(colour));
            let off: i32 = (0..3).map(|k| (i32::from(palette.colours[index][k]) - i32::from(colour[k])).abs()).sum();
            assert!(off <= 6, "{colour:?} became {:?}", palette.colours[index]);
        }
        assert_eq!(palette.index(WHITE), 0);
    }

    #[test]
    fn a_palette_of_pictures_has_their_colours_also_rare_ones() {
        let mut canvas = Canvas::new(100, 100);
        for (k, pixel) in canvas.pixels.iter_mut().enumerate().take(9000) {
            *pixel = mix(MAP[k % 256], [0; 3], (k / 256) as f32 / 90.0);
        }
        canvas.pixels[9500] = [255, 0, 0];
        let mut palette = Palette::of(std::slice::from_ref(&canvas));
        assert_eq!(palette.colours.len(), 255);
        let off = |palette: &mut Palette, colour: Rgb| -> i32 {
            let index = usize::from(palette.index(colour));
            (0..3).map(|k| (i32::from(palette.colours[index][k]) - i32::from(colour[k])).abs()).sum()
        };
        assert!(off(&mut palette, [255, 0, 0]) < 12 && off(&mut palette, WHITE) == 0);
        let mean = canvas.pixels.iter().map(|pixel| off(&mut palette, *pixel)).sum::<i32>() / 10_000;
        assert!(mean < 12, "{mean}");
    }
}
