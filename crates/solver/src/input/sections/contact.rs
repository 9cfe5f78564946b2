//! The sections of the model file that say what bodies meet: contacts, obstacles, and the keys that both
//! share, described once.

use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::vocabulary::Kind::{Angle, Choice, Flag, Name, Points, Quantities, Quantity, Reference, References, Spatial, Stiffness, Table};
use crate::vocabulary::Need::{Default, Optional, Required};
use crate::vocabulary::{Choices, Form, Group, Kind, Rule, Section, key};

pub(super) static CONTACT: Section = Section {
    name: "contact",
    doc: "Bodies that can't go through each other: two surfaces, or several bodies, each of which meets each other \
        and itself. A surface is a part (its whole outside), a side such as `plate.top`, or a group of lines (in 3D \
        of surfaces) of a mesh file.",
    form: Form::Repeated,
    keys: &[
        key("name", Name, Optional("the names of the surfaces or parts joined by `-`, or `all`"), "Unique name."),
        key("between", References(Some(2)), Optional("`bodies`"), "The two surfaces."),
        key("bodies", References(None), Optional("`between`"), "Parts that meet each other and themselves; `\"all\"` for all parts."),
        key(
            "formulation",
            Choice(Choices::Formulations),
            Default("\"double_pass\""),
            "What is checked: the nodes of each surface against the segments of the other, only the nodes of \
                `slave`, segments against segments, or disks in the elements. In 3D nodes meet facets, in a double \
                pass also edges edges, and the elements have balls; there are no segments.",
        ),
        key("slave", Reference, Optional("needed for, and only for, `single_pass`"), "The surface of `between` whose nodes are checked."),
        key("tied", Flag, Default("false"), "Whether what touches at the start stays together."),
        key("tie_strength", Quantity(Dimension::PRESSURE, Positive), Optional("it never breaks"), "Traction above which a tie breaks."),
        key("search", Choice(Choices::Searches), Optional("`grid`"), "How near pairs are found; changes no result."),
    ],
    groups: &[&INTERFACE],
    rules: &[Rule::OneOf(&["between", "bodies"]), Rule::Only { keys: &["tie_strength"], by: "tied", value: "true" }],
    ..Section::EMPTY
};

pub(super) static OBSTACLE: Section = Section {
    name: "obstacle",
    doc: "A rigid body without elements that parts can't go through: fixed, moved, or free with a mass. Exactly one \
        of `plane`, `circle` and `polyline`, in 3D of `plane`, `sphere`, `cylinder` and `stl`, is its shape.",
    form: Form::Repeated,
    keys: &[
        key("name", Name, Optional("`obstacle`, `obstacle2`, ..."), "Unique name."),
        key("parts", References(None), Optional("all parts"), "Parts that it stops."),
        key("plane", Table(&PLANE), Optional("another shape"), "A straight line."),
        key("circle", Table(&CIRCLE), Optional("another shape"), "A circle."),
        key("polyline", Table(&POLYLINE), Optional("another shape"), "Straight lines from point to point."),
        key("sphere", Table(&SPHERE), Optional("another shape"), "In 3D: a sphere."),
        key("cylinder", Table(&CYLINDER), Optional("another shape"), "In 3D: a cylinder without ends."),
        key("stl", Table(&STL), Optional("another shape"), "In 3D: the triangles of an STL file."),
        key(
            "motion",
            Kind::Motion,
            Optional("fixed"),
            "How it moves: velocities `x` and `y` of its reference point, and `rotation` about it. What is left out \
                is fixed. In an axisymmetric model only `y` can move.",
        ),
        key(
            "reference",
            Spatial(Dimension::LENGTH, Finite),
            Optional(
                "the plane's point, the circle's centre, the mean of the polyline's points, the middle of the box around the triangles",
            ),
            "Reference point of rotation and moments.",
        ),
        key(
            "mass",
            Quantity(Dimension::MASS_PER_LENGTH, Positive),
            Optional("needed where, and only where, `x` or `y` is free"),
            "Mass per depth; of an axisymmetric model and among solids the whole mass, kg.",
        ),
        key(
            "inertia",
            Quantity(Dimension::INERTIA_PER_LENGTH, Positive),
            Optional("needed where, and only where, `rotation` is free"),
            "Moment of inertia about the reference point per depth; among solids the whole, kg m^2, the same about all axes.",
        ),
        key("velocity", Spatial(Dimension::VELOCITY, Finite), Default("[0, 0]"), "Initial velocity where it is free."),
        key("spin", Angle(Dimension::RATE, Finite), Default("0"), "Initial angular velocity where it is free, counter-clockwise."),
    ],
    groups: &[&INTERFACE],
    rules: &[Rule::OneOf(&["plane", "circle", "polyline", "sphere", "cylinder", "stl"])],
    ..Section::EMPTY
};

static PLANE: Section = Section {
    name: "plane",
    doc: "A straight line (in 3D a plane) that bodies meet from the side of its normal.",
    keys: &[
        key("point", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line; its middle where it has a length."),
        key("normal", Spatial(Dimension::NONE, Finite), Required, "Normal that points to the free side; any length but zero."),
        key("length", Quantity(Dimension::LENGTH, Positive), Optional("without end"), "Length."),
    ],
    ..Section::EMPTY
};

static CIRCLE: Section = Section {
    name: "circle",
    doc: "A circle.",
    keys: &[
        key("centre", Spatial(Dimension::LENGTH, Finite), Required, "Centre."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key("hollow", Flag, Default("false"), "Whether the bodies are inside of it."),
    ],
    ..Section::EMPTY
};

static SPHERE: Section = Section {
    name: "sphere",
    doc: "In 3D: a sphere.",
    keys: &[
        key("centre", Spatial(Dimension::LENGTH, Finite), Required, "Centre."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key("hollow", Flag, Default("false"), "Whether the bodies are inside of it."),
    ],
    ..Section::EMPTY
};

static CYLINDER: Section = Section {
    name: "cylinder",
    doc: "In 3D: a cylinder without ends.",
    keys: &[
        key("point", Spatial(Dimension::LENGTH, Finite), Default("[0, 0, 0]"), "A point of its axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Required, "Direction of the axis; any length but zero."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key("hollow", Flag, Default("false"), "Whether the bodies are inside of it."),
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
            Default("\"1 m\""),
            "Length of one unit of the file; `\"1 mm\"` of most programs for construction.",
        ),
        key("rotation", Table(&super::ROTATION), Optional("as in the file"), "How it is turned."),
        key("translation", Spatial(Dimension::LENGTH, Finite), Default("[0, 0, 0]"), "How far it is moved after that."),
        key("hollow", Flag, Default("false"), "Whether the bodies are on the other side: inside of a closed surface."),
    ],
    ..Section::EMPTY
};

static POLYLINE: Section = Section {
    name: "polyline",
    doc: "Straight lines from point to point, the obstacle on their right: counter-clockwise around bodies, clockwise around the obstacle.",
    keys: &[key("points", Points(2), Required, "Points; the first once more at the end closes it.")],
    ..Section::EMPTY
};

/// What happens between surfaces, whoever they belong to.
static INTERFACE: Group = Group {
    title: "Where surfaces meet",
    doc: "Keys of contacts and of obstacles alike. Friction is at most min(µ p + c v, τ) at pressure p and slip rate \
        v, with µ = µ_d + (µ_s - µ_d) exp(-β v).",
    keys: &[
        key(
            "law",
            Choice(Choices::ContactLaws),
            Default("\"penalty\""),
            "What keeps the surfaces apart: a force proportional to the penetration, a pressure that depends on the \
                gap, or whatever force it takes.",
        ),
        key(
            "penalty",
            Stiffness(Dimension::PRESSURE, Positive),
            Optional("automatic, from the elements under the surfaces"),
            "Stiffness per node and depth, or circumference (N/m/m, of solids N/m; also meant by a bare number), or \
                pressure per penetration (Pa/m).",
        ),
        key("penalty_scale", Quantity(Dimension::NONE, Positive), Optional("1"), "Factor on the automatic penalty."),
        key(
            "penalty_from",
            Choice(Choices::Words(&["wave_modulus", "bulk_modulus", "time_step"])),
            Optional("`wave_modulus`"),
            "What the automatic penalty is made from: K + 4µ/3 or K over the height of the elements, or the mass \
                over the square of the first stable step.",
        ),
        key(
            "gaps",
            Quantities(Dimension::LENGTH, Finite, 2),
            Optional("needed for, and only for, `pressure_gap`"),
            "Gaps, ascending; below zero is penetration.",
        ),
        key(
            "pressures",
            Quantities(Dimension::PRESSURE, NotNegative, 2),
            Optional("needed for, and only for, `pressure_gap`"),
            "Pressures at the gaps, never rising, zero at the last.",
        ),
        key(
            "damping",
            Quantity(Dimension::NONE, NotNegative),
            Default("0"),
            "Viscous damping of closed contacts, as a fraction of the critical one. It also resists rolling: what \
                comes in is slowed down, and what goes out is not pushed back as much.",
        ),
        key("friction", Quantity(Dimension::NONE, NotNegative), Optional("no friction"), "Coefficient µ_s of Coulomb friction, at rest."),
        key(
            "friction_dynamic",
            Quantity(Dimension::NONE, NotNegative),
            Optional("`friction`"),
            "Coefficient µ_d of fast sliding, at most µ_s.",
        ),
        key(
            "friction_decay",
            Quantity(Dimension::SLOWNESS, Positive),
            Optional("no decay"),
            "Rate β from the one to the other coefficient.",
        ),
        key("friction_viscosity", Quantity(Dimension::VISCOSITY_PER_LENGTH, Positive), Optional("none"), "Shear stress c per slip rate."),
        key("friction_limit", Quantity(Dimension::PRESSURE, Positive), Optional("none"), "Largest shear stress τ."),
        key(
            "initial_penetration",
            Choice(Choices::Words(&["error", "ignore", "push_out"])),
            Default("\"error\""),
            "What is done with penetrations at the start: the model is refused, the gap counts as zero, or nodes are moved to the surface.",
        ),
        key("thickness", Quantity(Dimension::LENGTH, NotNegative), Default("0"), "Distance that the surfaces keep."),
        key("birth", Quantity(Dimension::TIME, NotNegative), Default("0"), "Time from which it acts."),
        key("death", Quantity(Dimension::TIME, Positive), Optional("the end"), "Time until which it acts."),
    ],
    rules: &[
        Rule::NotBoth("penalty", "penalty_scale"),
        Rule::NotBoth("penalty", "penalty_from"),
        Rule::Only { keys: &["penalty", "penalty_scale", "penalty_from"], by: "law", value: "penalty" },
        Rule::Only { keys: &["gaps", "pressures"], by: "law", value: "pressure_gap" },
        Rule::With { by: "law", value: "pressure_gap", keys: &["gaps", "pressures"] },
        Rule::Needs("friction_dynamic", "friction"),
        Rule::Needs("friction_dynamic", "friction_decay"),
        Rule::Needs("friction_decay", "friction"),
        Rule::Needs("friction_decay", "friction_dynamic"),
        Rule::Needs("friction_viscosity", "friction"),
        Rule::Needs("friction_limit", "friction"),
    ],
};
