//! Cross-sections of beams: `profile` of a part.

use super::section;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive, UpTo};
use crate::tensor::cross;
use crate::vector::{dot, minus, times};
use crate::vocabulary::Choices;
use crate::vocabulary::Kind::{Choice, Integer, Quantity, Spatial};
use crate::vocabulary::Section;

/// A full circle.
pub const ROUND: &str = "round";
/// A circle with a hole.
pub const TUBE: &str = "tube";
/// A rectangle.
pub const RECTANGLE: &str = "rectangle";
/// A rectangle with a hole, its walls of one thickness.
pub const BOX: &str = "box";
/// Two flanges and a web between them.
pub const I: &str = "i";
/// Any section of which the integrals are known.
pub const GIVEN: &str = "given";

/// Every shape, and the keys that it needs.
pub const PROFILES: &[(&str, &[&str])] = &[
    (ROUND, &["diameter"]),
    (TUBE, &["diameter", "thickness"]),
    (RECTANGLE, &["width", "height"]),
    (BOX, &["width", "height", "thickness"]),
    (I, &["width", "height", "web", "flange"]),
    (GIVEN, &["area", "inertia_y", "inertia_z", "torsion"]),
];

section! {
    /// The cross-section of a beam, and the fibres in it.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Profile in PROFILE = Section {
        name: "profile",
        doc: "The cross-section of beams (`beam2`). Its axes are x along the beam, z across it towards `up` (the height), and y (the width), such that z is \
            x × y. Stress along the beam is found in fibres by the law, and integrates area and moments of inertia exactly; torsion and transverse shear are elastic. \
            Others touch its outline, and it is shown by it; a `given` section has none.",
        ..Section::EMPTY
    };
    shape: String = Choice(Choices::Words(&[ROUND, TUBE, RECTANGLE, BOX, I, GIVEN])), Required,
        "`round` (with `diameter`), `tube` (`diameter`, `thickness`), `rectangle` (`width`, `height`), `box` (`width`, `height`, `thickness`), \
            `i` (`width`, `height`, `web`, `flange`) or `given` (`area`, `inertia_y`, `inertia_z`, `torsion`).";
    diameter: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only of `round` and `tube`"), "Outer diameter.";
    width: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only of `rectangle`, `box` and `i`"), "Outer size along y.";
    height: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only of `rectangle`, `box` and `i`"), "Outer size along z.";
    thickness: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only of `tube` and `box`"), "Thickness of the wall.";
    web: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only of `i`"), "Thickness of the web, along y.";
    flange: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("only of `i`"), "Thickness of each flange, along z.";
    area: Option<f64> = Quantity(Dimension::AREA, Positive), Optional("only of `given`"), "Area.";
    inertia_y: Option<f64> = Quantity(Dimension::AREA_MOMENT, Positive), Optional("only of `given`"),
        "Second moment of area about y, ∫ z² dA: of bending in the plane of the height.";
    inertia_z: Option<f64> = Quantity(Dimension::AREA_MOMENT, Positive), Optional("only of `given`"), "Second moment of area about z, ∫ y² dA.";
    torsion: Option<f64> = Quantity(Dimension::AREA_MOMENT, Positive), Optional("only of `given`"), "Torsion constant J.";
    up: Option<[f64; 3]> = Spatial(Dimension::NONE, Finite), Optional("z, of beams along z x"),
        "Direction of the height as far as it is across the beam.";
    points: Option<usize> = Integer(1), Optional("4, around 12"),
        "Fibres along each direction of a rectangle, along each wall of a box and an I (1 to 10); around a circle (4 to 64).";
    corners: Option<usize> = Integer(4), Optional("12"),
        "Corners of the polygon in the circle (4 to 64) by which a round or a tube touches others and is shown. Edges of more than 16 are too flat to meet those of others: then only nodes do.";
    failed_points: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("1"),
        "Part of its fibres that have to fail until an element fails.";
}

impl Profile {
    /// A size by its key.
    #[must_use]
    pub fn size(&self, key: &str) -> Option<f64> {
        match key {
            "diameter" => self.diameter,
            "width" => self.width,
            "height" => self.height,
            "thickness" => self.thickness,
            "web" => self.web,
            "flange" => self.flange,
            "area" => self.area,
            "inertia_y" => self.inertia_y,
            "inertia_z" => self.inertia_z,
            "torsion" => self.torsion,
            _ => None,
        }
    }

    /// Whether its fibres are counted around it.
    #[must_use]
    pub fn is_circular(&self) -> bool {
        [ROUND, TUBE].contains(&self.shape.as_str())
    }

    /// Whether it has an outline that others can touch.
    #[must_use]
    pub fn has_outline(&self) -> bool {
        self.shape != GIVEN
    }

    /// Corners of the polygon that a circle is for others.
    #[must_use]
    pub fn corners(&self) -> usize {
        self.corners.unwrap_or(12)
    }

    /// Fibres as [`Self::points`] counts them.
    #[must_use]
    pub fn fibres(&self) -> usize {
        self.points.unwrap_or(if self.is_circular() { 12 } else { 4 })
    }

    /// Why there is no such section: the key that is wrong, and what is wrong with it.
    #[must_use]
    pub fn impossible(&self) -> Option<(&'static str, String)> {
        let size = |key| self.size(key).unwrap_or(f64::INFINITY);
        let part = |key: &'static str, whole: &'static str| {
            let (own, all) = (2.0 * size(key), size(whole));
            (own >= all).then(|| (key, format!("twice this is {own:e} m, not less than the {whole}, {all:e} m")))
        };
        match self.shape.as_str() {
            TUBE => (2.0 * size("thickness") > size("diameter")).then(|| ("thickness", "it is more than the radius".to_string())),
            BOX => part("thickness", "width").or_else(|| part("thickness", "height")),
            I if size("web") > size("width") => Some(("web", "it is more than the width".to_string())),
            I => part("flange", "height"),
            _ => None,
        }
    }
}

/// Axes of a beam along a unit vector, whose height points `up` as far as it is across; `None`: it is not.
pub(crate) fn beam_axes(along: [f64; 3], up: Option<[f64; 3]>) -> Option<[[f64; 3]; 3]> {
    let across = |up: [f64; 3]| {
        let part = minus(up, times(dot(up, along), along));
        let length = dot(part, part).sqrt();
        (length > 1e-6 * dot(up, up).sqrt()).then(|| times(1.0 / length, part))
    };
    let z = match up {
        Some(up) => across(up)?,
        None => across([0.0, 0.0, 1.0]).or_else(|| across([1.0, 0.0, 0.0]))?,
    };
    Some([along, cross(z, along), z])
}
