//! What a run of a [`super::Model`] writes: `[output]` and `[[probe]]`.

use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Choice, Flag, Integer, Name, Quantity, Reference, Spatial, Table, Vector};
use crate::vocabulary::{Choices, Form, Kind, Rule, Section};

/// How often something is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cadence {
    /// So many equal intervals over the run; of fields 0: none.
    Count(u64),
    /// Every so many seconds.
    Interval(f64),
}

section! {
    /// `[output]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Output in OUTPUT = Section {
        name: "output",
        doc: "What is written.",
        form: Form::Single,
        ..Section::EMPTY
    };
    fields: Cadence = Kind::Cadence, Default("100"),
        "How often the fields are written: a count, or an interval such as `\"0.1 ms\"`; 0: not at all, and no pictures of bodies.";
    history: Cadence = Kind::Cadence, Default("1000"),
        "How often a row of the history is written: a count or an interval.";
    hash_steps: Option<u64> = Integer(0), Default("100"),
        "Steps between two lines of `hashes.csv`, by which `embate diff` finds where two runs diverge; 0: none are written.",
        read |values| values.get::<Option<u64>>("hash_steps").filter(|&steps| steps > 0);
    include: Vec<String> = Kind::Choices(Choices::Fields), Optional("all"), "Fields to write.";
    mirror: [bool; 3] = Kind::Choices(Choices::Words(&["x", "y", "z"])), Optional("none"),
        "Pictures also show the model mirrored at the line (in 3D the plane) x = 0 (`\"x\"`), y = 0 (`\"y\"`), \
            in 3D z = 0 (`\"z\"`), or several of them.",
        read axes;
    pictures: bool = Flag, Default("true"), "Whether pictures and the animation are made.";
    picture_field: String = Choice(Choices::Fields), Optional("what suits the model"),
        "Field that colours the pictures.";
    picture_view: Option<PictureView> = Table(&PICTURE_VIEW), Optional("all bodies, and obstacles near them"),
        "What pictures and animation show; `embate check` draws the whole mesh all the same.";
    camera: Option<Camera> = Table(&CAMERA), Optional("three sides are seen"),
        "From where pictures of a 3D model look at it.";
}

/// Which axes the output is mirrored along.
fn axes(values: &dyn Values) -> [bool; 3] {
    let named: Vec<String> = values.get("mirror");
    ["x", "y", "z"].map(|axis| named.iter().any(|it| it == axis))
}

section! {
    /// `output.picture_view`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct PictureView in PICTURE_VIEW = Section {
        name: "picture_view",
        doc: "The rectangle that pictures show, mirror images included; in 3D in the plane of the picture, from the image of the origin.",
        ..Section::EMPTY
    };
    corner: [f64; 2] = Vector(Dimension::LENGTH, Finite), Required, "Lower left corner.";
    size: [f64; 2] = Vector(Dimension::LENGTH, Positive), Required, "Width and height.";
}

section! {
    /// `output.camera`: how pictures look at a model in 3D. Lines that are parallel stay so.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Camera in CAMERA = Section {
        name: "camera",
        doc: "How pictures look at a 3D model: from afar, so that parallel lines stay parallel, and with everything in sight.",
        ..Section::EMPTY
    };
    from: [f64; 3] = Spatial(Dimension::NONE, Finite), Default("[0.6, -1, 0.5]"),
        "Direction from the model to the camera; any length but zero.";
    at: Option<[f64; 3]> = Spatial(Dimension::LENGTH, Finite), Optional("the middle of all that is seen"),
        "What is in the middle of the picture.";
    up: [f64; 3] = Spatial(Dimension::NONE, Finite), Default("[0, 0, 1]"),
        "Direction that is upwards in the picture; not that of `from`.";
    zoom: f64 = Quantity(Dimension::NONE, Positive), Default("1"),
        "How many times larger than so that everything is seen.";
}

section! {
    /// `[[probe]]`: what is recorded in the history.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Probe in PROBE = Section {
        name: "probe",
        doc: "A place whose position and velocity are written to the history as `NAME.x`, `NAME.y`, `NAME.vx`, \
            `NAME.vy`: the node of `part` nearest to `point`, node number `node` of `part`, or the mean over `set`.",
        form: Form::Repeated,
        rules: &[
            Rule::OneOf(&["point", "node", "set"]),
            Rule::Needs("point", "part"),
            Rule::Needs("node", "part"),
            Rule::NotBoth("set", "part"),
        ],
        ..Section::EMPTY
    };
    name: String = Name, Required, "Unique name.";
    "part" = Reference, Optional("only with `set`"), "Part of `point` or `node`.";
    "point" = Spatial(Dimension::LENGTH, Finite), Optional("`node` or `set`"),
        "Initial position; the nearest node is taken.";
    "node" = Integer(0), Optional("`point` or `set`"), "Number of the node in its part, from 0.";
    "set" = Reference, Optional("`point` or `node`"),
        "A part, a side such as `plate.top`, or a group of a mesh file.";
    /// Where.
    at: ProbeAt, read ProbeAt::read;
}

/// Where a probe sits.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbeAt {
    /// The node of `part` nearest to `point` at the start.
    Point {
        /// Part name.
        part: String,
        /// Initial position, m.
        point: [f64; 3],
    },
    /// Node number `node` (from 0) of `part`.
    Node {
        /// Part name.
        part: String,
        /// Number within the part.
        node: usize,
    },
    /// Mass-weighted mean over a part, `part.side` or group.
    Set {
        /// Set name.
        set: String,
    },
}

impl ProbeAt {
    fn read(values: &dyn Values) -> Self {
        if values.has("point") {
            Self::Point { part: values.get("part"), point: values.get("point") }
        } else if values.has("node") {
            Self::Node { part: values.get("part"), node: values.get("node") }
        } else {
            Self::Set { set: values.get("set") }
        }
    }
}
