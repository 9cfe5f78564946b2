//! Rigid obstacles of a [`super::Model`]: `[[obstacle]]`.

use super::contact::INTERFACE;
use super::placement::ROTATION;
use super::triangles::TriangleSurface;
use super::values::LeftOut;
use super::{Interface, Motion, Values, in_3d, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Angle, Flag, Name, Points, Quantity, References, Spatial, Table};
use crate::vocabulary::Need::{Default as Written, Optional, Required};
use crate::vocabulary::{Form, Key, Kind, Rule, Section, key};
use std::sync::Arc;

section! {
    /// `[[obstacle]]`: a rigid body without elements.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Obstacle in OBSTACLE = Section {
        name: "obstacle",
        doc: "A rigid body without elements that parts can't go through: fixed, moved, or free with a mass. Exactly one \
            of `plane`, `circle` and `polyline`, in 3D of `plane`, `sphere`, `cylinder` and `stl`, is its shape.",
        form: Form::Repeated,
        groups: &[&INTERFACE],
        rules: &[Rule::OneOf(&["plane", "circle", "polyline", "sphere", "cylinder", "stl"])],
        ..Section::EMPTY
    };
    name: String = Name, Optional("`obstacle`, `obstacle2`, ..."), "Unique name.";
    parts: Vec<String> = References(None), Optional("all parts"), "Parts that it stops.";
    "plane" = Table(&PLANE), Optional("another shape"), "A straight line.";
    "circle" = Table(&CIRCLE), Optional("another shape"), "A circle.";
    "polyline" = Table(&POLYLINE), Optional("another shape"), "Straight lines from point to point.";
    "sphere" = Table(&SPHERE), Optional("another shape"), "In 3D: a sphere.";
    "cylinder" = Table(&CYLINDER), Optional("another shape"), "In 3D: a cylinder without ends.";
    "stl" = Table(&STL), Optional("another shape"), "In 3D: the triangles of an STL file.";
    motion: Motion = Kind::Motion, Optional("fixed"),
        "How it moves: velocities `x` and `y` of its reference point, and `rotation` about it. What is left out \
            is fixed. In an axisymmetric model only `y` can move.",
        read Motion::of_obstacle;
    reference: Option<[f64; 3]> = Spatial(Dimension::LENGTH, Finite),
        Optional("the plane's point, the circle's centre, the mean of the polyline's points, the middle of the box around the triangles"),
        "Reference point of rotation and moments.";
    mass: Option<f64> = Quantity(Dimension::MASS_PER_LENGTH, Positive), Optional("needed where, and only where, `x` or `y` is free"),
        "Mass per depth; of an axisymmetric model and among solids the whole mass, kg.";
    inertia: Option<f64> = Quantity(Dimension::INERTIA_PER_LENGTH, Positive), Optional("needed where, and only where, `rotation` is free"),
        "Moment of inertia about the reference point per depth; among solids the whole, kg m^2, the same about all axes.";
    velocity: [f64; 3] = Spatial(Dimension::VELOCITY, Finite), Default("[0, 0]"),
        "Initial velocity where it is free.";
    spin: f64 = Angle(Dimension::RATE, Finite), Default("0"),
        "Initial angular velocity where it is free, counter-clockwise.";
    /// Shape.
    shape: ObstacleShape, read ObstacleShape::read;
    /// Law, friction and so on.
    interface: Interface, read Interface::read;
}

impl Obstacle {
    /// A fixed plane without end that stops all parts; `normal` points to the free side. Vectors have two or
    /// three components.
    #[must_use]
    pub fn wall<const D: usize>(name: &str, point: [f64; D], normal: [f64; D]) -> Self {
        Self::fixed(name, ObstacleShape::Plane { point: in_3d(point), normal: in_3d(normal), length: None })
    }

    /// A fixed obstacle that stops all parts.
    #[must_use]
    pub fn fixed(name: &str, shape: ObstacleShape) -> Self {
        Self { name: name.into(), shape, ..Self::default() }
    }
}

/// Shape of a rigid obstacle. Its free side is where the normal points.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleShape {
    /// A straight line; in 3D a plane without end.
    Plane {
        /// A point of the line, m; its middle where it has a length.
        point: [f64; 3],
        /// Normal that points to the free side; any length.
        normal: [f64; 3],
        /// Length, m; infinite without.
        length: Option<f64>,
    },
    /// A circle.
    Circle {
        /// Centre, m.
        centre: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Whether bodies are inside of it.
        hollow: bool,
    },
    /// In 3D: a sphere.
    Sphere {
        /// Centre, m.
        centre: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Whether bodies are inside of it.
        hollow: bool,
    },
    /// In 3D: a cylinder without ends.
    Cylinder {
        /// A point of its axis, m.
        point: [f64; 3],
        /// Direction of the axis; any length.
        axis: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Whether bodies are inside of it.
        hollow: bool,
    },
    /// Straight lines from point to point, the obstacle on their right.
    Polyline {
        /// Points, m; the first once more at the end: closed.
        points: Vec<[f64; 2]>,
    },
    /// In 3D: triangles, counter-clockwise seen from the side on which bodies are.
    Triangles(Arc<TriangleSurface>),
}

impl ObstacleShape {
    /// What the keys of an obstacle say; triangles are in a file, which its reader knows.
    fn read(values: &dyn Values) -> Self {
        if let Some(it) = values.table("circle") {
            return Self::Circle { centre: it.get("centre"), radius: it.get("radius"), hollow: it.get("hollow") };
        }
        if let Some(it) = values.table("sphere") {
            return Self::Sphere { centre: it.get("centre"), radius: it.get("radius"), hollow: it.get("hollow") };
        }
        if let Some(it) = values.table("cylinder") {
            return Self::Cylinder { point: it.get("point"), axis: it.get("axis"), radius: it.get("radius"), hollow: it.get("hollow") };
        }
        if values.table("stl").is_some() {
            return Self::Triangles(Arc::default());
        }
        if let Some(it) = values.table("polyline") {
            return Self::Polyline { points: it.get("points") };
        }
        let nothing = LeftOut::of(&[]);
        let it = values.table("plane").unwrap_or(&nothing);
        Self::Plane { point: it.get("point"), normal: it.get("normal"), length: it.get("length") }
    }
}

static PLANE: Section = Section {
    name: "plane",
    doc: "A straight line (in 3D a plane) that bodies meet from the side of its normal.",
    keys: &[
        key("point", Spatial(Dimension::LENGTH, Finite), Written("[0, 0]"), "A point of the line; its middle where it has a length."),
        key("normal", Spatial(Dimension::NONE, Finite), Required, "Normal that points to the free side; any length but zero."),
        key("length", Quantity(Dimension::LENGTH, Positive), Optional("without end"), "Length."),
    ],
    ..Section::EMPTY
};

/// The keys of a circle and of a sphere.
const ROUND: [Key; 3] = [
    key("centre", Spatial(Dimension::LENGTH, Finite), Required, "Centre."),
    key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
    HOLLOW,
];

const HOLLOW: Key = key("hollow", Flag, Written("false"), "Whether the bodies are inside of it.");

static CIRCLE: Section = Section { name: "circle", doc: "A circle.", keys: &ROUND, ..Section::EMPTY };

static SPHERE: Section = Section { name: "sphere", doc: "In 3D: a sphere.", keys: &ROUND, ..Section::EMPTY };

static CYLINDER: Section = Section {
    name: "cylinder",
    doc: "In 3D: a cylinder without ends.",
    keys: &[
        key("point", Spatial(Dimension::LENGTH, Finite), Written("[0, 0, 0]"), "A point of its axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Required, "Direction of the axis; any length but zero."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        HOLLOW,
    ],
    ..Section::EMPTY
};

static STL: Section = Section {
    name: "stl",
    doc: "In 3D: the triangles of an STL file, text or binary. Corners that are equal to the last bit are one point. \
        Bodies are on the side from which triangles are counter-clockwise, which is outside of a closed surface; the \
        normals that the file gives don't count.",
    keys: &[
        key("file", Kind::Text, Required, "Path of the file, from the model file's folder."),
        key(
            "scale",
            Quantity(Dimension::LENGTH, Positive),
            Written("\"1 m\""),
            "Length of one unit of the file; `\"1 mm\"` of most programs for construction.",
        ),
        key("rotation", Table(&ROTATION), Optional("as in the file"), "How it is turned."),
        key("translation", Spatial(Dimension::LENGTH, Finite), Written("[0, 0, 0]"), "How far it is moved after that."),
        key("hollow", Flag, Written("false"), "Whether the bodies are on the other side: inside of a closed surface."),
    ],
    ..Section::EMPTY
};

static POLYLINE: Section = Section {
    name: "polyline",
    doc: "Straight lines from point to point, the obstacle on their right: counter-clockwise around bodies, clockwise around the obstacle.",
    keys: &[key("points", Points(2), Required, "Points; the first once more at the end closes it.")],
    ..Section::EMPTY
};
