//! Outlines of the cross-sections of beams: polygons, and the cells into which they are divided.
//!
//! A circle is a polygon whose corners are on it: its sides are up to (1 − cos π/n) of the radius within, 3.4
//! % with the 12 corners that it has where nothing else is said. So nothing that does not overlap does so by
//! its polygon. It is divided from its middle, for neighbours may be turned against each other; all others,
//! which are not convex or long and narrow, are divided into quadrilaterals. A tube and a box are full.

use crate::angle::cos_sin;
use crate::model::{BOX, I, Profile, RECTANGLE, ROUND, TUBE};
use std::f64::consts::TAU;

/// Sides of rectangles that are longer than so many times the other one are divided, into so many parts at
/// most.
const LONG: f64 = 2.0;
const MOST_PARTS: usize = 8;

/// The outline of a cross-section.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Outline {
    /// Its corners (y, z), counter-clockwise as who looks against the beam sees them, m.
    pub(super) corners: Vec<[f64; 2]>,
    /// The pieces into which it is divided, counter-clockwise: numbers of corners, four; or two, which make a
    /// triangle with the middle.
    pub(super) pieces: Vec<[usize; 4]>,
    /// Whether these are triangles around the middle, which has the number after the last corner.
    pub(super) has_middle: bool,
}

impl Outline {
    /// That of a section; `None`: it has none, or a size is missing.
    pub(super) fn of(profile: &Profile) -> Option<Self> {
        let size = |key: &str| profile.size(key);
        match profile.shape.as_str() {
            ROUND | TUBE => Some(Self::circle(0.5 * size("diameter")?, profile.corners())),
            RECTANGLE | BOX => Some(Self::rectangle(size("width")?, size("height")?)),
            I => {
                let (width, height, web, flange) = (size("width")?, size("height")?, size("web")?, size("flange")?);
                let is_full = web > 0.999 * width || 2.0 * flange > 0.999 * height;
                Some(if is_full { Self::rectangle(width, height) } else { Self::i(width, height, web, flange) })
            }
            _ => None,
        }
    }

    fn circle(radius: f64, count: usize) -> Self {
        let corners = (0..count).map(|k| cos_sin(TAU * k as f64 / count as f64).map(|part| radius * part)).collect();
        Self { corners, pieces: (0..count).map(|k| [count, k, (k + 1) % count, (k + 1) % count]).collect(), has_middle: true }
    }

    /// Strips across its longer side.
    fn rectangle(width: f64, height: f64) -> Self {
        let is_flat = width >= height;
        let (long, short) = if is_flat { (width, height) } else { (height, width) };
        let parts = ((long / (LONG * short)).floor() as usize).clamp(1, MOST_PARTS);
        let along = |k: usize| long * (k as f64 / parts as f64 - 0.5);
        let place = |along: f64, across: f64| if is_flat { [along, across] } else { [-across, along] };
        let there = (0..=parts).map(|k| place(along(k), -0.5 * short));
        let back = (0..=parts).rev().map(|k| place(along(k), 0.5 * short));
        let last = 2 * parts + 1;
        Self {
            corners: there.chain(back).collect(),
            pieces: (0..parts).map(|k| [k, k + 1, last - k - 1, last - k]).collect(),
            has_middle: false,
        }
    }

    fn i(width: f64, height: f64, web: f64, flange: f64) -> Self {
        let (w, h, t, f) = (0.5 * width, 0.5 * height, 0.5 * web, 0.5 * height - flange);
        // The half on the right from below to above, then that on the left, which is the same half turned.
        let right = [[-t, -h], [t, -h], [w, -h], [w, -f], [t, -f], [t, f], [w, f], [w, h]];
        let corners = right.into_iter().chain(right.map(|[y, z]| [-y, -z])).collect();
        // Corner 15 is below on the left, [−w, −h]: it is that after the turned [w, f].
        let below = [[15, 0, 13, 14], [0, 1, 4, 13], [1, 2, 3, 4]];
        let above = below.map(|piece: [usize; 4]| piece.map(|k| (k + 8) % 16));
        Self { corners, pieces: below.into_iter().chain([[13, 4, 5, 12]]).chain(above).collect(), has_middle: false }
    }

    /// Distance of the farthest corner from the middle, m.
    pub(super) fn radius(&self) -> f64 {
        self.corners.iter().map(|[y, z]| (y * y + z * z).sqrt()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Area within a closed polygon.
    fn area(points: &[[f64; 2]]) -> f64 {
        (0..points.len()).map(|k| (points[k], points[(k + 1) % points.len()])).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
    }

    #[test]
    fn pieces_are_the_whole_of_the_outline() {
        let some = |shape: &str| Profile { shape: shape.into(), ..Profile::default() };
        let sizes = |shape, width, height| Profile { width: Some(width), height: Some(height), thickness: Some(0.01), ..some(shape) };
        let i = |web, flange| Profile { web: Some(web), flange: Some(flange), ..sizes(I, 0.1, 0.3) };
        let twelve = 3.0 * 0.15 * 0.15;
        let eight = 4.0 * 0.15 * 0.15 * (PI / 4.0).sin();
        for (profile, whole, count) in [
            (Profile { diameter: Some(0.3), ..some(ROUND) }, twelve, 12),
            (Profile { diameter: Some(0.3), thickness: Some(0.02), corners: Some(8), ..some(TUBE) }, eight, 8),
            (sizes(RECTANGLE, 0.1, 0.3), 0.03, 1),
            (sizes(RECTANGLE, 0.5, 0.1), 0.05, 2),
            (sizes(BOX, 0.1, 0.1), 0.01, 1),
            (i(0.02, 0.03), 0.1 * 0.3 - 0.08 * 0.24, 7),
            (i(0.1, 0.03), 0.03, 1),
        ] {
            let outline = Outline::of(&profile).unwrap();
            let place = |k: usize| outline.corners.get(k).copied().unwrap_or_default();
            let pieces: Vec<f64> = outline.pieces.iter().map(|piece| area(&piece.map(place))).collect();
            assert!(pieces.iter().all(|piece| *piece > 0.0), "{} {pieces:?}", profile.shape);
            assert!(
                (pieces.iter().sum::<f64>() - whole).abs() < 1e-15 && (area(&outline.corners) - whole).abs() < 1e-15,
                "{}",
                profile.shape
            );
            assert_eq!(pieces.len(), count, "{}", profile.shape);
        }
        assert_eq!(Outline::of(&some("given")), None);
    }
}
