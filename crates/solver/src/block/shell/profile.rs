//! Cross-sections of beams: their integrals, and fibres that have the same area and moments of inertia.
//!
//! *Torsion constant J.* Rectangle, a ≥ b: a b³/3 (1 − (192/π⁵)(b/a) Σ tanh(n π a/2b)/n⁵), n odd; circle π
//! (d⁴ − d_i⁴)/32; box 2 b² h² t/(b + h) between the middles of its walls (Bredt); I Σ b t³/3. Source:
//! Timoshenko and Goodier, Theory of Elasticity (1970), 104-119.
//!
//! *Shear factors* k (the shear stiffness is k µ A): those of Cowper, J. Appl. Mech. 33 (1966) 335-340, for ν
//! = 0, which makes that of the rectangle 5/6. With m = b/h between the middles of the walls, c = 10 (1 +
//! 3m)²: circle 6 (1 + q²)²/(7 (1 + q²)² + 20 q²), q = d_i/d; box c/(12 + 72 m + 150 m² + 120 m³ + 30 m⁴). Of
//! thin walls these are I²/(A ∫ S²/t ds) of the shear flow with the static moment S, and so is that of an I
//! along its web; across it its flanges alone are two rectangles.
//!
//! *Fibres.* Rectangle: Gauss' points along both sides. Circle: Gauss' points in r², two of them where there
//! is no hole, with equally spaced angles. Walls of the box and the I: Gauss' points along each; what is
//! missing to the moments of inertia of the whole, for they have no thickness, is made up for by moving all
//! of them from the middle. Four fibres at the radii of gyration stand for any other section.

use super::section::Points;
use crate::angle::cos_sin;
use crate::model::{self, BOX, GIVEN, I, RECTANGLE, ROUND, TUBE};
use embate_lanes::math;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Integrals of a cross-section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Profile {
    /// Area, m².
    pub(super) area: f64,
    /// ∫ z² dA and ∫ y² dA: moments of inertia about y and z, m⁴.
    pub(super) inertia: [f64; 2],
    /// Torsion constant, m⁴.
    pub(super) torsion: f64,
    /// Shear factors along y and z.
    pub(super) shear: [f64; 2],
    /// Where its height points, as far as it is across; `None`: z, of beams along z x.
    pub(super) up: Option<[f64; 3]>,
}

/// Shear factor of a rectangle.
const RECTANGULAR: f64 = 5.0 / 6.0;

/// Torsion constant of a rectangle.
fn torsion_of_rectangle(width: f64, height: f64) -> f64 {
    let (a, b) = (width.max(height), width.min(height));
    let tanh = |x: f64| {
        let e = math::exp(-2.0 * x);
        (1.0 - e) / (1.0 + e)
    };
    let sum: f64 = (0..200).rev().map(|k| f64::from(2 * k + 1)).map(|n| tanh(n * FRAC_PI_2 * a / b) / n.powi(5)).sum();
    a * b * b * b / 3.0 * (1.0 - 192.0 / PI.powi(5) * (b / a) * sum)
}

/// Area, and moments of inertia about y and z, of a rectangle.
fn rectangle(width: f64, height: f64) -> [f64; 3] {
    let area = width * height;
    [area, area * height * height / 12.0, area * width * width / 12.0]
}

/// Shear factor of a box along its height: its middle is `m` times as wide as high.
fn shear_of_box(m: f64) -> f64 {
    let c = 1.0 + 3.0 * m;
    10.0 * c * c / (12.0 + m * (72.0 + m * (150.0 + m * (120.0 + 30.0 * m))))
}

/// Shear factor of an I along its web, from width, height and thicknesses of web and flanges between middles.
fn shear_of_web(width: f64, height: f64, web: f64, flange: f64, area: f64) -> f64 {
    let inertia = web * height.powi(3) / 12.0 + 0.5 * width * flange * height * height;
    // Static moments: flange (h/2) s in four halves of flanges; s₀ + web (h²/4 − z²)/2 in the web.
    let first = 0.5 * flange * height * width;
    let flanges = flange * height * height * width.powi(3) / 24.0;
    let within = first * first * height / web + first * height.powi(3) / 6.0 + web * height.powi(5) / 120.0;
    (inertia * inertia / (area * (flanges + within))).min(1.0)
}

impl Profile {
    /// Integrals of a section, and its fibres; `None` where a size is missing.
    pub(super) fn of(profile: &model::Profile) -> Option<(Self, Points)> {
        let size = |key: &str| profile.size(key);
        let count = profile.fibres();
        let whole = |[area, y, z]: [f64; 3], torsion: f64, shear: [f64; 2]| Self { area, inertia: [y, z], torsion, shear, up: profile.up };
        Some(match profile.shape.as_str() {
            RECTANGLE => {
                let (width, height) = (size("width")?, size("height")?);
                let own = whole(rectangle(width, height), torsion_of_rectangle(width, height), [RECTANGULAR; 2]);
                (own, Points::grid(count, [width, height]))
            }
            ROUND => Self::round(profile, size("diameter")?, 0.0),
            TUBE => Self::round(profile, size("diameter")?, (size("diameter")? - 2.0 * size("thickness")?).max(0.0)),
            BOX => {
                let (width, height, thickness) = (size("width")?, size("height")?, size("thickness")?);
                let (b, h) = (width - thickness, height - thickness);
                let inner = rectangle(b - thickness, h - thickness);
                let outer = rectangle(width, height);
                let torsion = 2.0 * b * b * h * h * thickness / (b + h);
                let own = whole([0, 1, 2].map(|k| outer[k] - inner[k]), torsion, [shear_of_box(h / b), shear_of_box(b / h)]);
                let flange = ([0.0, 0.5 * h], [width, 0.0], width * thickness);
                let web = ([0.5 * b, 0.0], [0.0, h - thickness], (h - thickness) * thickness);
                (own, own.walls(count, &[flange, web]))
            }
            I => {
                let (width, height, web, flange) = (size("width")?, size("height")?, size("web")?, size("flange")?);
                let (h, within) = (height - flange, height - 2.0 * flange);
                let [outer, gap] = [rectangle(width, height), rectangle(width - web, within)];
                let [flanges, between] = [rectangle(width, flange), rectangle(web, within)];
                let area = outer[0] - gap[0];
                let torsion = (2.0 * width * flange.powi(3) + h * web.powi(3)) / 3.0;
                let shear = [RECTANGULAR * 2.0 * flanges[0] / area, shear_of_web(width, h, web, flange, area)];
                let own = whole([area, outer[1] - gap[1], 2.0 * flanges[2] + between[2]], torsion, shear);
                let walls = [([0.0, 0.5 * h], [width, 0.0], flanges[0]), ([0.0; 2], [0.0, within], between[0])];
                (own, own.walls(count, &walls))
            }
            GIVEN => {
                let own = whole([size("area")?, size("inertia_y")?, size("inertia_z")?], size("torsion")?, [RECTANGULAR; 2]);
                let [z, y] = own.inertia.map(|inertia| (inertia / own.area).sqrt());
                let corners = [[y, z], [-y, z], [-y, -z], [y, -z]];
                (own, Points::at(corners.map(|place| (place, 1.0))))
            }
            _ => return None,
        })
    }

    /// A circle with a hole.
    fn round(profile: &model::Profile, outer: f64, inner: f64) -> (Self, Points) {
        let count = profile.fibres();
        let (two, within) = (outer * outer, inner * inner);
        let area = 0.25 * PI * (two - within);
        let inertia = area * (two + within) / 16.0;
        let q = within / two;
        let both = (1.0 + q) * (1.0 + q);
        let shear = 6.0 * both / (7.0 * both + 20.0 * q);
        let own = Self { area, inertia: [inertia; 2], torsion: 2.0 * inertia, shear: [shear; 2], up: profile.up };
        let rings = Points::new(if inner > 0.0 { 1 } else { 2 }, false);
        let fibres = rings.heights.iter().zip(&rings.weights).enumerate().flat_map(|(ring, (place, weight))| {
            let radius = 0.5 * (within + (place + 0.5) * (two - within)).sqrt();
            // Every other ring is half a step further.
            let at = move |k: usize| cos_sin(TAU * (k as f64 + 0.5 * ring as f64) / count as f64).map(|part| radius * part);
            (0..count).map(move |k| (at(k), *weight))
        });
        (own, Points::at(fibres))
    }

    /// Fibres along walls, each with its middle, its extent and its area, and along what they are mirrored
    /// to, where they are not in the middle themselves.
    fn walls(&self, count: usize, walls: &[([f64; 2], [f64; 2], f64)]) -> Points {
        let along = Points::new(count, false);
        let mut fibres = Vec::new();
        for &(middle, extent, area) in walls {
            let sides = if middle == [0.0; 2] { &[1.0][..] } else { &[1.0, -1.0] };
            for (sign, (place, weight)) in sides.iter().flat_map(|sign| along.heights.iter().zip(&along.weights).map(move |at| (sign, at)))
            {
                fibres.push(([0, 1].map(|k| sign * middle[k] + extent[k] * place), area * weight));
            }
        }
        let mut points = Points::at(fibres);
        for (places, inertia) in [(&mut points.heights, self.inertia[0]), (&mut points.sides, self.inertia[1])] {
            let sum: f64 = places.iter().zip(&points.weights).map(|(x, w)| w * x * x).sum();
            // One fibre in a lone web has no height.
            let factor = if sum > 0.0 { (inertia / (self.area * sum)).sqrt() } else { 1.0 };
            places.iter_mut().for_each(|x| *x *= factor);
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<model::Profile> {
        let some = |shape: &str| model::Profile { shape: shape.into(), ..model::Profile::default() };
        vec![
            model::Profile { diameter: Some(0.3), ..some(ROUND) },
            model::Profile { diameter: Some(0.3), thickness: Some(0.02), ..some(TUBE) },
            model::Profile { width: Some(0.1), height: Some(0.3), ..some(RECTANGLE) },
            model::Profile { width: Some(0.1), height: Some(0.3), thickness: Some(0.01), ..some(BOX) },
            model::Profile { width: Some(0.1), height: Some(0.3), web: Some(0.006), flange: Some(0.01), ..some(I) },
            model::Profile { area: Some(0.02), inertia_y: Some(3e-4), inertia_z: Some(2e-5), torsion: Some(1e-5), ..some(GIVEN) },
        ]
    }

    #[test]
    fn fibres_have_the_area_and_the_moments_of_inertia_of_the_section() {
        for profile in all() {
            for points in [None, Some(5), Some(8)] {
                let (own, fibres) = Profile::of(&model::Profile { points, ..profile.clone() }).unwrap();
                let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
                    (0..fibres.count()).map(|k| fibres.weights[k] * of(fibres.sides[k], fibres.heights[k])).sum()
                };
                assert!((sum(&|_, _| 1.0) - 1.0).abs() < 1e-14, "{}", profile.shape);
                for (of, expected) in [
                    (&(|y: f64, _: f64| y) as &dyn Fn(f64, f64) -> f64, 0.0),
                    (&|_, z| z, 0.0),
                    (&|y, z| y * z, 0.0),
                    (&|_, z| z * z, own.inertia[0] / own.area),
                    (&|y, _| y * y, own.inertia[1] / own.area),
                ] {
                    assert!((sum(of) - expected).abs() < 1e-14 * expected.max(1.0), "{} {points:?}: {expected}", profile.shape);
                }
                assert!(own.shear.iter().all(|&k| k > 0.1 && k <= 1.0) && own.torsion > 0.0, "{own:?}");
            }
        }
    }

    #[test]
    fn torsion_and_shear_of_known_sections_are_found() {
        // Timoshenko and Goodier: 0.1406 of a square, 0.229 of 1 to 2, 0.312 of 1 to 10.
        for (ratio, part) in [(1.0, 0.140_577), (2.0, 0.228_682), (10.0, 0.312_325)] {
            assert!(
                (torsion_of_rectangle(ratio, 1.0) / ratio - part).abs() < 1e-6,
                "{ratio}: {}",
                torsion_of_rectangle(ratio, 1.0) / ratio
            );
        }
        // A box without width, and an I without flanges, are a web.
        assert!((shear_of_box(0.0) - 5.0 / 6.0).abs() < 1e-15);
        assert!((shear_of_web(1e-9, 1.0, 0.1, 1e-9, 0.1) - 5.0 / 6.0).abs() < 1e-6);
        // A box between the middles of its walls is an I whose web is both of its own.
        let (b, h, t) = (0.7, 1.0, 0.01);
        let box_like = shear_of_box(b / h);
        let half = t * h * b / 2.0;
        let within = 2.0 * t * (h.powi(3) * b * b / 8.0 + h.powi(4) * b / 12.0 + h.powi(5) / 60.0) / 2.0;
        let energy = t * (h * h * b.powi(3) / 24.0) + within;
        let inertia = t * h.powi(3) / 6.0 + half * h;
        assert!((inertia * inertia / (2.0 * t * (b + h) * energy) / box_like - 1.0).abs() < 1e-12);
    }
}
