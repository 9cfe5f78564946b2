//! What holds, moves and loads bodies from outside, as plain data: symmetry, constraints, loads, boundaries
//! that reflect nothing, joins. Vectors have three components; in 2D the third is zero.
//!
//! Part of the [`Model`](super::Model); curves and rigid motion are in `motion.rs`.

use super::stage::STAGES;
use super::values::Course;
use super::{Drive, Motion, Values, in_3d, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::vocabulary::Kind::{Angle, Name, Quantity, Reference, References, Spatial, Table};
use crate::vocabulary::Need::Optional;
use crate::vocabulary::{Choices, Form, Kind, Rule, Section, key};

section! {
    /// `[[symmetry]]`: nodes that lie on a line (in 3D: on a plane) at the start stay on it.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Symmetry in SYMMETRY = Section {
        name: "symmetry",
        doc: "A line of symmetry: nodes that lie on it at the start stay on it.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    name: String = Name, Optional("`symmetry`, `symmetry2`, ..."), "Unique name, by which the history has its reaction.";
    normal: [f64; 3] = Spatial(Dimension::NONE, Finite), Required, "Normal of the line; any length but zero.";
    point: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line.";
    parts: Vec<String> = References(None), Optional("all parts"), "Parts that it holds.";
}

section! {
    /// `[[constraint]]`: prescribed motion of a set of nodes, by component, or around a point.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Constraint in CONSTRAINT = Section {
        name: "constraint",
        doc: "Prescribed motion of a set of nodes: a part, a side such as `plate.left`, or a group of a mesh file.",
        form: Form::Repeated,
        rules: &[
            Rule::SomeOf(&["fixed", "velocity", "displacement", "acceleration", "rotation", "spin"]),
            Rule::NotBoth("rotation", "fixed"),
            Rule::NotBoth("rotation", "velocity"),
            Rule::NotBoth("rotation", "displacement"),
            Rule::NotBoth("rotation", "acceleration"),
            Rule::NotBoth("rotation", "spin"),
        ],
        ..Section::EMPTY
    };
    name: String = Name, Optional("the name of the set"), "Unique name, by which the history has its reaction.";
    on: String = Reference, Required, "The set.";
    stages: Vec<String> = References(None), Optional("all stages"), "Stages in which it acts, one after the other.";
    "fixed" = Kind::Choices(Choices::Words(&["x", "y", "z", "rotation"])), Optional("none"),
        "Components that don't move; `rotation`: nodes of shells and beams don't rotate either, so that they are clamped.";
    velocity: [Option<Drive>; 3] = Kind::Components(Dimension::VELOCITY), Optional("none"),
        "Prescribed velocity of components: a number or a curve, such as `{ x = \"1 m/s\", y = \"ramp\" }`.",
        read velocities;
    displacement: [Option<Drive>; 3] = Kind::Components(Dimension::LENGTH), Optional("none"),
        "Prescribed displacement of components from the initial position: curves that begin with 0.",
        read |values| components(values, "displacement");
    acceleration: [Option<Drive>; 3] = Kind::Components(Dimension::ACCELERATION), Optional("none"),
        "Prescribed acceleration of components, from the initial velocity on.",
        read |values| components(values, "acceleration");
    rotation: Option<Rotation> = Table(&TURN_OF_NODES), Optional("none"), "Leads the nodes around a point; those of shells and beams rotate with it.";
    spin: [Option<Drive>; 3] = Kind::Components(Dimension::RATE), Optional("none"),
        "Prescribed angular velocity of the nodes of shells and beams, such as `{ z = \"2 rad/s\" }`; in 2D about z.",
        read spins;
}

/// Prescribed components of a kind; none where the nodes are driven around a point.
fn components(values: &dyn Values, key: &str) -> [Option<Drive>; 3] {
    let given = values.table("rotation").is_none().then(|| values.get::<Option<[Option<Course>; 4]>>(key)).flatten();
    given.map_or([None, None, None], |courses| Motion::of(&courses, &Motion::default()).velocity)
}

/// Prescribed velocities: those of `velocity`, and zero where a component is fixed and not prescribed in
/// another way; none where the nodes are driven around a point.
fn velocities(values: &dyn Values) -> [Option<Drive>; 3] {
    let [mut velocity, displacement, acceleration] = ["velocity", "displacement", "acceleration"].map(|key| components(values, key));
    let fixed: Vec<String> = if values.table("rotation").is_some() { Vec::new() } else { values.get("fixed") };
    for (index, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let is_free = [&velocity, &displacement, &acceleration].iter().all(|drives| drives[index].is_none());
        if is_free && fixed.iter().any(|it| it == axis) {
            velocity[index] = Some(Drive::Constant(0.0));
        }
    }
    velocity
}

/// Prescribed angular velocities: those of `spin`, and zero where rotation is fixed and not prescribed.
fn spins(values: &dyn Values) -> [Option<Drive>; 3] {
    let mut spins = components(values, "spin");
    let is_clamped = values.table("rotation").is_none() && values.get::<Vec<String>>("fixed").iter().any(|it| it == "rotation");
    if is_clamped {
        spins.iter_mut().for_each(|spin| *spin = spin.take().or(Some(Drive::Constant(0.0))));
    }
    spins
}

section! {
    /// Prescribed rotation of nodes about a fixed axis.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Rotation in TURN_OF_NODES = Section {
        name: "rotation",
        doc: "Rotation of nodes about a fixed point, on exact circles.",
        ..Section::EMPTY
    };
    speed: Drive = Kind::Drive(Dimension::RATE), Required,
        "Angular velocity, counter-clockwise: a number or a curve.";
    "centre" = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "The point; in 3D one of the axis.";
    "axis" = Spatial(Dimension::NONE, Finite), Optional("along z"), "Direction of the axis, in 3D.";
    /// The axis.
    about: Axis, read Axis::read;
}

/// What something turns about: in 2D a point, in 3D the line through it along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// A point of it, m.
    pub centre: [f64; 3],
    /// Its direction, of any length but zero; in the plane that of z.
    pub direction: [f64; 3],
}

impl Axis {
    /// Along z through a point, m.
    #[must_use]
    pub fn through<const D: usize>(centre: [f64; D]) -> Self {
        Self { centre: in_3d(centre), direction: [0.0, 0.0, 1.0] }
    }

    /// What the keys `centre` and `axis` say; left out: along z through the origin.
    fn read(values: &dyn Values) -> Self {
        let Self { centre, direction } = Self::default();
        Self { centre: values.or("centre", centre), direction: values.or("axis", direction) }
    }
}

/// Along z through the origin.
impl Default for Axis {
    fn default() -> Self {
        Self::through([0.0; 3])
    }
}

/// `[[load]]`.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// Uniform acceleration of the mass of some parts.
    Gravity {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// Acceleration, m/s².
        acceleration: [f64; 3],
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// The centrifugal force of a frame that turns about a point: acceleration speed² (x − centre) of the
    /// mass of some parts.
    Centrifugal {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// What it turns about; an axisymmetric model turns about its axis.
        about: Axis,
        /// Angular velocity of the frame, rad/s.
        speed: f64,
        /// Key of [`super::Model::curves`]: a factor of the angular velocity.
        curve: Option<String>,
    },
    /// A force on a set of nodes, shared by tributary length on a surface, else equally.
    Force {
        /// A side as `part.side`, or a group of a mesh file.
        on: String,
        /// The whole force, N/m; of an axisymmetric model N.
        force: [f64; 3],
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// A moment on a set of nodes of shells or beams, shared equally.
    Moment {
        /// A set of nodes.
        on: String,
        /// The whole moment about x, y and z, N (of solids N m); of an axisymmetric model N m.
        moment: [f64; 3],
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// A pressure on a surface, against its current normal and on its current length.
    Pressure {
        /// A part (its whole outside), `part.side`, or a one-dimensional group of a mesh file.
        on: String,
        /// Pressure, Pa.
        pressure: f64,
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// Force −rate · m · v on the mass of some parts: what is quasi-static comes to rest.
    Damping {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// Rate, 1/s.
        rate: f64,
        /// Times between which it acts, s.
        active: [f64; 2],
    },
    /// A stress β C:ε̇ in the elements of some parts, with the elastic stiffness C: what swings fast is
    /// damped.
    StiffnessDamping {
        /// Parts; empty: all that deform.
        parts: Vec<String>,
        /// β, s.
        time: f64,
    },
}

pub(crate) static LOAD: Section = Section {
    name: "load",
    doc: "What acts on parts, sets of nodes or surfaces from outside. With `curve` a load is multiplied by the \
        curve's values, which must be pure numbers.",
    form: Form::Repeated,
    keys: &[
        key(
            "name",
            Name,
            Optional("the name of the set, or `gravity`, `centrifugal`"),
            "Unique name, by which the history has its resultant.",
        ),
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
            "moment",
            Spatial(Dimension::FORCE, Finite),
            Optional("another load"),
            "Moment on a set of nodes of shells or beams in all, about x, y and z (in 2D `[0, 0, \"5 N\"]`: N m per metre of depth), shared \
                equally: its axes do not rotate with the nodes.",
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
            Optional("only with `force`, `moment` and `pressure`"),
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
        STAGES,
    ],
    rules: &[
        Rule::OneOf(&["gravity", "centrifugal", "force", "moment", "pressure", "damping", "damping_stiffness"]),
        Rule::Needs("centre", "centrifugal"),
        Rule::Needs("axis", "centrifugal"),
        Rule::Needs("force", "on"),
        Rule::Needs("moment", "on"),
        Rule::Needs("pressure", "on"),
        Rule::NotBoth("on", "gravity"),
        Rule::NotBoth("on", "centrifugal"),
        Rule::NotBoth("on", "damping"),
        Rule::NotBoth("on", "damping_stiffness"),
        Rule::NotBoth("parts", "force"),
        Rule::NotBoth("parts", "moment"),
        Rule::NotBoth("parts", "pressure"),
        Rule::NotBoth("curve", "damping"),
        Rule::NotBoth("curve", "damping_stiffness"),
        Rule::NotBoth("stages", "damping_stiffness"),
        Rule::NotBoth("stages", "from"),
        Rule::NotBoth("stages", "until"),
        Rule::Needs("from", "damping"),
        Rule::Needs("until", "damping"),
    ],
    ..Section::EMPTY
};

/// What a load is called, and when it acts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadTerms {
    /// Unique name, by which the history has its resultant; empty: its number.
    pub name: String,
    /// Stages in which it acts; empty: all.
    pub stages: Vec<String>,
}

impl Load {
    /// The curve that it is multiplied by, if there is one.
    #[must_use]
    pub fn curve(&self) -> Option<&String> {
        match self {
            Self::Gravity { curve, .. }
            | Self::Centrifugal { curve, .. }
            | Self::Force { curve, .. }
            | Self::Moment { curve, .. }
            | Self::Pressure { curve, .. } => curve.as_ref(),
            Self::Damping { .. } | Self::StiffnessDamping { .. } => None,
        }
    }
}

impl super::Model {
    /// Names of the stages in which the load of this number acts; none: all.
    #[must_use]
    pub fn stages_of_load(&self, index: usize) -> &[String] {
        self.load_terms.get(index).map_or(&[], |terms| &terms.stages)
    }
}

impl LoadTerms {
    /// From the load's table in the model file.
    #[must_use]
    pub fn read(values: &dyn Values) -> Self {
        Self { name: values.get("name"), stages: values.get("stages") }
    }
}

impl Load {
    /// From its table in the model file.
    #[must_use]
    pub fn read(values: &dyn Values) -> Self {
        let (parts, on, curve) = (values.get("parts"), values.get("on"), values.get("curve"));
        if values.has("centrifugal") {
            Self::Centrifugal { parts, about: Axis::read(values), speed: values.get("centrifugal"), curve }
        } else if values.has("force") {
            Self::Force { on, force: values.get("force"), curve }
        } else if values.has("moment") {
            Self::Moment { on, moment: values.get("moment"), curve }
        } else if values.has("pressure") {
            Self::Pressure { on, pressure: values.get("pressure"), curve }
        } else if values.has("damping") {
            Self::Damping { parts, rate: values.get("damping"), active: window(values, ["from", "until"]) }
        } else if values.has("damping_stiffness") {
            Self::StiffnessDamping { parts, time: values.get("damping_stiffness") }
        } else {
            Self::Gravity { parts, acceleration: values.get("gravity"), curve }
        }
    }
}

impl Load {
    /// What it is called where it has no name: by the set that it acts on, or what it is.
    #[must_use]
    pub fn usual_name(&self) -> &str {
        match self {
            Self::Force { on, .. } | Self::Moment { on, .. } | Self::Pressure { on, .. } => on,
            Self::Gravity { .. } => "gravity",
            Self::Centrifugal { .. } => "centrifugal",
            Self::Damping { .. } | Self::StiffnessDamping { .. } => "damping",
        }
    }
}

/// Times of beginning and end; left out: from the start, for ever.
pub(super) fn window(values: &dyn Values, [from, until]: [&str; 2]) -> [f64; 2] {
    [values.get::<Option<f64>>(from).unwrap_or(0.0), values.get::<Option<f64>>(until).unwrap_or(f64::INFINITY)]
}

section! {
    /// `[[non_reflecting]]`: a surface that takes waves up as if the body continued.
    #[derive(Clone, Debug, PartialEq)]
    pub struct NonReflecting in NON_REFLECTING = Section {
        name: "non_reflecting",
        doc: "A surface that takes waves up as if the body continued behind it, by dashpots for plane waves across it: \
            what meets it at an angle is reflected in part. It doesn't hold the body in place.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    on: String = Reference, Required,
        "A side such as `soil.bottom`, a line group of a mesh file, or a part, its whole outside.";
}

section! {
    /// `[[join]]`: nodes of two sets that move as one.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Join in JOIN = Section {
        name: "join",
        doc: "Nodes of two sets that move as one: tied where the sets coincide, periodic where the second set is the \
            image of the first by `translation` or `rotation`. Each node of the first set has its partner in the second \
            one, and of images also the other way round. A tied contact joins meshes that differ.",
        form: Form::Repeated,
        rules: &[Rule::NotBoth("translation", "rotation"), Rule::Needs("centre", "rotation"), Rule::Needs("axis", "rotation")],
        ..Section::EMPTY
    };
    between: [String; 2] = References(Some(2)), Required,
        "The two sets: each a part, a side such as `plate.left`, or a group of a mesh file.";
    "translation" = Spatial(Dimension::LENGTH, Finite), Optional("none"),
        "Leads from the first set to the second: both have the same velocity.";
    "rotation" = Angle(Dimension::NONE, Finite), Optional("none"),
        "Leads from the first set to the second, counter-clockwise: the velocity of the second is that of the first, turned.";
    "centre" = Spatial(Dimension::LENGTH, Finite), Optional("[0, 0]"),
        "Centre of the rotation; in 3D a point of its axis.";
    "axis" = Spatial(Dimension::NONE, Finite), Optional("along z"), "Direction of the axis, in 3D.";
    tolerance: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("1e-6 of the model's extent"),
        "Distance within which nodes are partners.";
    /// How the second set comes from the first.
    image: Image, read Image::read;
}

/// How one set of nodes is the image of another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Image {
    /// They coincide.
    #[default]
    Same,
    /// Moved by this, m.
    Translated([f64; 3]),
    /// Turned about an axis.
    Turned {
        /// The axis.
        about: Axis,
        /// By this angle, rad, counter-clockwise.
        angle: f64,
    },
}

impl Image {
    fn read(values: &dyn Values) -> Self {
        if values.has("rotation") {
            Self::Turned { about: Axis::read(values), angle: values.get("rotation") }
        } else if values.has("translation") {
            Self::Translated(values.get("translation"))
        } else {
            Self::Same
        }
    }
}
