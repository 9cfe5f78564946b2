//! The sections of the model file about what holds nodes and what acts on them: symmetry, constraints, joins,
//! loads.

use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::vocabulary::Kind::{Angle, Quantity, Reference, References, Spatial, Table};
use crate::vocabulary::Need::{Default, Optional, Required};
use crate::vocabulary::{Choices, Form, Kind, Rule, Section, key};

pub(super) static SYMMETRY: Section = Section {
    name: "symmetry",
    doc: "A line of symmetry: nodes that lie on it at the start stay on it.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("normal", Spatial(Dimension::NONE, Finite), Required, "Normal of the line; any length but zero."),
        key("point", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line."),
        key("parts", References(None), Optional("all parts"), "Parts that it holds."),
    ],
    ..Section::EMPTY
};

pub(super) static CONSTRAINT: Section = Section {
    name: "constraint",
    doc: "Prescribed motion of a set of nodes: a part, a side such as `plate.left`, or a group of a mesh file.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("on", Reference, Required, "The set."),
        key("fixed", Kind::Choices(Choices::Words(&["x", "y", "z"])), Optional("none"), "Components that don't move."),
        key(
            "velocity",
            Kind::Components(Dimension::VELOCITY),
            Optional("none"),
            "Prescribed velocity of components: a number or a curve, such as `{ x = \"1 m/s\", y = \"ramp\" }`.",
        ),
        key(
            "displacement",
            Kind::Components(Dimension::LENGTH),
            Optional("none"),
            "Prescribed displacement of components from the initial position: curves that begin with 0.",
        ),
        key(
            "acceleration",
            Kind::Components(Dimension::ACCELERATION),
            Optional("none"),
            "Prescribed acceleration of components, from the initial velocity on.",
        ),
        key("rotation", Table(&TURN_OF_NODES), Optional("none"), "Leads the nodes around a point."),
    ],
    rules: &[
        Rule::SomeOf(&["fixed", "velocity", "displacement", "acceleration", "rotation"]),
        Rule::NotBoth("rotation", "fixed"),
        Rule::NotBoth("rotation", "velocity"),
        Rule::NotBoth("rotation", "displacement"),
        Rule::NotBoth("rotation", "acceleration"),
    ],
    ..Section::EMPTY
};

static TURN_OF_NODES: Section = Section {
    name: "rotation",
    doc: "Rotation of nodes about a fixed point, on exact circles.",
    form: Form::Inline,
    required: false,
    keys: &[
        key("speed", Kind::Drive(Dimension::RATE), Required, "Angular velocity, counter-clockwise: a number or a curve."),
        key("centre", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "The point; in 3D one of the axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Optional("along z"), "Direction of the axis, in 3D."),
    ],
    ..Section::EMPTY
};

pub(super) static LOAD: Section = Section {
    name: "load",
    doc: "What acts on parts, sets of nodes or surfaces from outside. With `curve` a load is multiplied by the \
        curve's values, which must be pure numbers.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key(
            "gravity",
            Spatial(Dimension::ACCELERATION, Finite),
            Optional("another load"),
            "Uniform acceleration of parts, such as `[0, \"-9.81 m/s^2\"]`; in an axisymmetric model along y.",
        ),
        key(
            "centrifugal",
            Angle(Dimension::RATE, Finite),
            Optional("another load"),
            "Angular velocity of a frame in which the model is seen: its parts feel the acceleration centrifugal^2 * \
                (x - centre), and no Coriolis force, so they should move slowly in it.",
        ),
        key(
            "centre",
            Spatial(Dimension::LENGTH, Finite),
            Optional("[0, 0]"),
            "The point about which the frame turns, in 3D one of its axis; an axisymmetric model turns about its axis.",
        ),
        key("axis", Spatial(Dimension::NONE, Finite), Optional("along z"), "Direction of the axis of `centrifugal`, in 3D."),
        key(
            "force",
            Spatial(Dimension::FORCE_PER_LENGTH, Finite),
            Optional("another load"),
            "Force on a set in all, per metre of depth (of an axisymmetric model in N over the whole circumference, \
                of solids in N): shared by length, of solids by area, over a side or a group on the outside, equally \
                over other groups.",
        ),
        key(
            "pressure",
            Quantity(Dimension::PRESSURE, Finite),
            Optional("another load"),
            "Pressure on a surface, always against its current normal and on its current length; negative pulls.",
        ),
        key(
            "damping",
            Quantity(Dimension::RATE, Positive),
            Optional("another load"),
            "Rate of a force -rate * mass * velocity on parts: what moves slowly comes to rest.",
        ),
        key(
            "damping_stiffness",
            Quantity(Dimension::TIME, Positive),
            Optional("another load"),
            "Time beta of a stress beta * C * strain rate in the elements of parts, with their elastic stiffness C: \
                a mode of angular frequency omega is damped by beta * omega / 2 of the critical. It shortens the \
                step from dt to sqrt(beta^2 + dt^2) - beta, and acts during the whole run.",
        ),
        key(
            "on",
            Reference,
            Optional("only with `force` and `pressure`"),
            "Where it acts: a side such as `plate.top`, a group of a mesh file; of a pressure also a part, its whole outside.",
        ),
        key("parts", References(None), Optional("all parts"), "Parts that it acts on."),
        key(
            "curve",
            Reference,
            Optional("constant"),
            "Name of a curve by whose value it is multiplied (the angular velocity of `centrifugal`).",
        ),
        key("from", Quantity(Dimension::TIME, NotNegative), Optional("the start"), "Time at which the damping begins."),
        key("until", Quantity(Dimension::TIME, Positive), Optional("the end"), "Time at which it ends."),
    ],
    rules: &[
        Rule::OneOf(&["gravity", "centrifugal", "force", "pressure", "damping", "damping_stiffness"]),
        Rule::Needs("centre", "centrifugal"),
        Rule::Needs("axis", "centrifugal"),
        Rule::Needs("force", "on"),
        Rule::Needs("pressure", "on"),
        Rule::NotBoth("on", "gravity"),
        Rule::NotBoth("on", "centrifugal"),
        Rule::NotBoth("on", "damping"),
        Rule::NotBoth("on", "damping_stiffness"),
        Rule::NotBoth("parts", "force"),
        Rule::NotBoth("parts", "pressure"),
        Rule::NotBoth("curve", "damping"),
        Rule::NotBoth("curve", "damping_stiffness"),
        Rule::Needs("from", "damping"),
        Rule::Needs("until", "damping"),
    ],
    ..Section::EMPTY
};

pub(super) static NON_REFLECTING: Section = Section {
    name: "non_reflecting",
    doc: "A surface that takes waves up as if the body continued behind it, by dashpots for plane waves across it: \
        what meets it at an angle is reflected in part. It doesn't hold the body in place.",
    form: Form::Repeated,
    required: false,
    keys: &[key("on", Reference, Required, "A side such as `soil.bottom`, a line group of a mesh file, or a part, its whole outside.")],
    ..Section::EMPTY
};

pub(super) static JOIN: Section = Section {
    name: "join",
    doc: "Nodes of two sets that move as one: tied where the sets coincide, periodic where the second set is the \
        image of the first by `translation` or `rotation`. Each node of the first set has its partner in the second \
        one, and of images also the other way round. A tied contact joins meshes that differ.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("between", References(Some(2)), Required, "The two sets: each a part, a side such as `plate.left`, or a group of a mesh file."),
        key(
            "translation",
            Spatial(Dimension::LENGTH, Finite),
            Optional("none"),
            "Leads from the first set to the second: both have the same velocity.",
        ),
        key(
            "rotation",
            Angle(Dimension::NONE, Finite),
            Optional("none"),
            "Leads from the first set to the second, counter-clockwise: the velocity of the second is that of the first, turned.",
        ),
        key("centre", Spatial(Dimension::LENGTH, Finite), Optional("[0, 0]"), "Centre of the rotation; in 3D a point of its axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Optional("along z"), "Direction of the axis, in 3D."),
        key(
            "tolerance",
            Quantity(Dimension::LENGTH, Positive),
            Optional("1e-6 of the model's extent"),
            "Distance within which nodes are partners.",
        ),
    ],
    rules: &[Rule::NotBoth("translation", "rotation"), Rule::Needs("centre", "rotation"), Rule::Needs("axis", "rotation")],
    ..Section::EMPTY
};
