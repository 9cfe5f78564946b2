//! Colours: the map from a field's value to a colour, and the distinct colours of parts and curves. The map
//! is laid out in OKLCH (Ottosson 2020, "A perceptual color space for image processing"), so equal steps of
//! the value look equal and lightness alone reports high from low (also in grey print and for colour-blind
//! readers). Read by `body`, `scene`, `animation`, `svg`.

use std::sync::LazyLock;

/// Red, green, blue, each 0 to 255.
pub(crate) type Rgb = [u8; 3];

/// Number of colours in the map.
pub(crate) const LEVELS: usize = 256;

pub(crate) const WHITE: Rgb = [255, 255, 255];
/// Text.
pub(crate) const TEXT: Rgb = [34, 38, 46];
/// Less important text.
pub(crate) const TEXT_FAINT: Rgb = [92, 98, 110];
/// Element edges and outlines.
pub(crate) const INK: Rgb = [16, 18, 28];
/// Border of the plot.
pub(crate) const BORDER: Rgb = [168, 174, 184];
/// Grid.
pub(crate) const GRID: Rgb = [233, 236, 240];
/// Obstacles.
pub(crate) const SOLID: Rgb = [227, 230, 235];
/// Bodies without a value.
pub(crate) const NO_VALUE: Rgb = [178, 184, 192];

/// Colour-blind-safe set of Okabe and Ito (2008), without its yellow, which is lost on white.
pub(crate) const DISTINCT: [Rgb; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [110, 110, 120]];

/// Colour of part `index`: softened so that mesh lines stay visible on it.
pub(crate) fn part(index: usize) -> Rgb {
    let round = (index / DISTINCT.len()) % 3;
    let lighter = [0.30, 0.62, 0.05][round];
    DISTINCT[index % DISTINCT.len()].map(|c| (f64::from(c) + (255.0 - f64::from(c)) * lighter).round() as u8)
}

/// The map from low (dark violet) over blue and green to high (light yellow).
pub(crate) static MAP: LazyLock<[Rgb; LEVELS]> = LazyLock::new(|| std::array::from_fn(|i| map_colour(i as f64 / (LEVELS - 1) as f64)));

fn map_colour(t: f64) -> Rgb {
    let lightness = 0.37 + 0.56 * t;
    let hue = (296.0 - 190.0 * t).to_radians();
    // The largest chroma that the screen can show at this lightness and hue, at most the wanted one.
    let (mut low, mut high) = (0.0, 0.102 + 0.055 * (2.0 * t - 1.0).powi(2));
    if in_gamut(linear(lightness, high, hue)) {
        low = high;
    }
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if in_gamut(linear(lightness, middle, hue)) { low = middle } else { high = middle }
    }
    linear(lightness, low, hue).map(|c| (255.0 * gamma(c.clamp(0.0, 1.0))).round() as u8)
}

fn in_gamut(rgb: [f64; 3]) -> bool {
    rgb.iter().all(|c| (-1e-9..=1.0 + 1e-9).contains(c))
}

/// OKLCH to linear sRGB.
fn linear(lightness: f64, chroma: f64, hue: f64) -> [f64; 3] {
    let (a, b) = (chroma * hue.cos(), chroma * hue.sin());
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
}

/// Linear to sRGB (IEC 61966-2-1).
fn gamma(c: f64) -> f64 {
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

/// `under` seen through `over` of opacity `alpha`.
pub(crate) fn mix(under: Rgb, over: Rgb, alpha: f32) -> Rgb {
    let alpha = alpha.clamp(0.0, 1.0);
    std::array::from_fn(|k| {
        let (u, o) = (f32::from(under[k]), f32::from(over[k]));
        (u + (o - u) * alpha + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brightness(c: Rgb) -> f64 {
        0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2])
    }

    #[test]
    fn the_map_grows_lighter_all_the_way() {
        for pair in MAP.windows(2) {
            assert!(brightness(pair[1]) >= brightness(pair[0]) - 0.5, "{pair:?}");
        }
        assert!(brightness(MAP[LEVELS - 1]) - brightness(MAP[0]) > 150.0);
    }

    #[test]
    fn parts_beyond_the_set_get_other_shades() {
        let first: Vec<Rgb> = (0..21).map(part).collect();
        for i in 0..first.len() {
            for j in 0..i {
                assert_ne!(first[i], first[j], "{i} and {j}");
            }
        }
    }
}
