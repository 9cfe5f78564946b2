//! Connections at points, as plain data: spot welds and joints.

use super::section;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::vocabulary::Kind::{Choice, Name, Quantities, Quantity, References, Spatial, SpatialPoints};
use crate::vocabulary::{Choices, Form, Rule, Section};

section! {
    /// `[[weld]]`: points at which two parts are rigidly connected until they fail.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Weld in WELD = Section {
        name: "weld",
        doc: "Spot welds, rivets and the like: points at which two sets of nodes are rigidly connected, so that forces \
            and moments go from one to the other. A set takes part with its nodes near the point, of shells with \
            those of their faces; they move as a rigid body in the mean. A weld fails for good when \
            (N/N_f)^a + (Q/Q_f)^b + (M/M_f)^c reaches 1, with the tensile force N along the normal, the shear force Q \
            and the moment M.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    name: String = Name, Optional("`weld`, `weld2`, ..."), "Unique name; of several points they are called `NAME_1`, `NAME_2`, ....";
    between: [String; 2] = References(Some(2)), Required,
        "The two sets: each a part, a side such as `plate.top`, or a group of a mesh file; the end of a beam as `beam.point1`.";
    at: Vec<[f64; 3]> = SpatialPoints(1), Required,
        "The points, such as `[[0.1, 0.2, 0]]`; in 2D z is left out.",
        read |values| values.get::<Vec<Vec<[f64; 3]>>>("at").into_iter().flatten().collect();
    radius: Option<f64> = Quantity(Dimension::LENGTH, Positive),
        Optional("the nearest nodes that hold a rigid body"),
        "Nodes of each set within this distance of the point take part.";
    normal: Option<[f64; 3]> = Spatial(Dimension::NONE, Finite), Optional("that of the surface of the first set there"),
        "Direction of the normal force, from the first to the second set.";
    normal_strength: Option<f64> = Quantity(Dimension::FORCE_PER_LENGTH, Positive), Optional("no limit"),
        "N_f: tensile force at which it fails; pressing does no harm.";
    shear_strength: Option<f64> = Quantity(Dimension::FORCE_PER_LENGTH, Positive), Optional("no limit"),
        "Q_f: shear force at which it fails.";
    moment_strength: Option<f64> = Quantity(Dimension::FORCE, Positive), Optional("no limit"),
        "M_f: moment at which it fails, bending and torsion together.";
    exponents: Vec<f64> = Quantities(Dimension::NONE, Positive, 3), Optional("2 each"),
        "a, b and c, such as `[1.5, 1.5, 2]`.";
    filter: f64 = Quantity(Dimension::TIME, NotNegative), Default("0"),
        "Time of a low-pass filter of first order through which the forces go before they are compared; 0: they are compared as they are.";
}

section! {
    /// `[[joint]]`: what leaves two bodies some ways to move.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Joint in JOINT = Section {
        name: "joint",
        doc: "Joints between two sets of nodes, or of one with the ground: a point that both share, an axis about or \
            along which they can move. They are constraints and not springs. A set takes part with \
            its nodes near the point, of a rigid part any of them; they move as a rigid body in the mean.",
        form: Form::Repeated,
        rules: &[
            Rule::With { by: "kind", value: "cylindrical", keys: &["axis"] },
            Rule::With { by: "kind", value: "translational", keys: &["axis"] },
        ],
        ..Section::EMPTY
    };
    name: String = Name, Optional("`joint`, `joint2`, ..."), "Unique name.";
    between: Vec<String> = References(None), Required,
        "The two sets: each a part, a side such as `door.left`, or a group of a mesh file; one alone is joined to the ground.";
    kind: String = Choice(Choices::Words(&KINDS)), Required,
        "`spherical` and (in 2D the same) `revolute`, which turns about `axis`; `cylindrical`, which also slides along it; \
            `translational`, which only slides; `fixed`: nothing.";
    at: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Required, "The point.";
    axis: [f64; 3] = Spatial(Dimension::NONE, Finite), Optional("along z, needed in 3D by `revolute`"),
        "Direction of the axis; it goes with the first set.",
        read |values| values.or("axis", [0.0, 0.0, 1.0]);
    radius: Option<f64> = Quantity(Dimension::LENGTH, Positive),
        Optional("the nearest nodes that hold a rigid body"),
        "Nodes of each set within this distance of the point take part.";
}

/// Names of kinds of joints.
pub const KINDS: [&str; 5] = ["spherical", "revolute", "cylindrical", "translational", "fixed"];

/// Exponents of the criterion of a weld without others.
pub const EXPONENT: f64 = 2.0;

impl Weld {
    /// The name of one of its points.
    #[must_use]
    pub fn name_of(&self, point: usize) -> String {
        if self.at.len() == 1 { self.name.clone() } else { format!("{}_{}", self.name, point + 1) }
    }
}
