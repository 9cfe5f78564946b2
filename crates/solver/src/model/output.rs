//! What a run of a [`super::Model`] writes: `[output]` and `[[probe]]`.

use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Choice, Flag, Integer, Name, Quantity, Reference, References, Spatial, Table, Text, Vector};
use crate::vocabulary::{Choices, Form, Kind, Rule, Section};

/// How often something is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cadence {
    /// So many equal intervals over the run, or over each of its stages; of fields 0: none.
    Count(u64),
    /// Every so many seconds.
    Interval(f64),
}

impl Cadence {
    /// Time between two outputs of what lasts `duration`, both in s.
    #[must_use]
    pub fn interval(self, duration: f64) -> f64 {
        match self {
            Self::Count(count) => duration / count.max(1) as f64,
            Self::Interval(interval) => interval,
        }
    }
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
        "How often the fields are written: a count (of each stage), or an interval such as `\"0.1 ms\"`; 0: not at all, and no pictures of bodies.";
    history: Cadence = Kind::Cadence, Default("1000"),
        "How often a row of the history is written: a count (of each stage) or an interval.";
    forces: Forces = Choice(Choices::Words(&["mean", "sample"])), Default("\"mean\""),
        "What rows of the history have of forces, moments and accelerations: the mean over the interval since the row before, \
            of which nothing is missed, or the value at the row's time.",
        read Forces::read;
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

/// What rows of the history have of forces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Forces {
    /// The mean over the interval since the row before: impulse by time.
    #[default]
    Mean,
    /// The value at the row's time.
    Sample,
}

impl Forces {
    fn read(values: &dyn Values) -> Self {
        if values.get::<String>("forces") == "sample" { Self::Sample } else { Self::Mean }
    }
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
        doc: "A place whose position, velocity and acceleration are written to the history as `NAME.x`, `NAME.vx`, \
            `NAME.ax` and so on: the node of `part` nearest to `point`, node number `node` of `part`, or the mean over `set`, \
            which has its `NAME.spin` too. With `fields` also values of fields, such as `NAME.von_mises`, `NAME.stress_xx`: \
            those of elements as the mean over the elements at the node, or of `element` alone, or the `extreme` in a set.",
        form: Form::Repeated,
        rules: &[
            Rule::OneOf(&["point", "node", "element", "set"]),
            Rule::Needs("point", "part"),
            Rule::Needs("node", "part"),
            Rule::Needs("element", "part"),
            Rule::NotBoth("set", "part"),
            Rule::Needs("extreme", "set"),
            Rule::Needs("extreme", "fields"),
            Rule::Needs("place", "extreme"),
            Rule::Needs("position", "fields"),
            Rule::NotBoth("position", "element"),
            Rule::Needs("kind", "point"),
        ],
        ..Section::EMPTY
    };
    name: String = Name, Required, "Unique name.";
    "part" = Reference, Optional("only with `set`"), "Part of `point`, `node` or `element`.";
    "point" = Spatial(Dimension::LENGTH, Finite), Optional("`node`, `element` or `set`"),
        "Initial position; the nearest node is taken, in a part whose elements are made again the material at the point.";
    kind: ProbeKind = Choice(Choices::Words(&["material", "place"])), Default("\"material\""),
        "Whether the probe follows the material at the point, or watches this place: then the history has the velocity and the fields of \
            what of the part is there, `NaN` where nothing is, and no position or acceleration.",
        read ProbeKind::read;
    "node" = Integer(0), Optional("`point`, `element` or `set`"), "Number of the node in its part, from 0.";
    "element" = Integer(0), Optional("`point`, `node` or `set`"), "Number of the element in its part, from 0: its fields alone.";
    "set" = Reference, Optional("`point`, `node` or `element`"),
        "A part, a side such as `plate.top`, or a group of a mesh file.";
    fields: Vec<String> = Kind::Choices(Choices::Fields), Optional("none; of `element` stress and plastic strain"),
        "Fields whose values are written, of whole tensors and vectors all components.";
    extreme: Option<Extreme> = Choice(Choices::Words(&["max", "min"])), Optional("the mean"),
        "Whether the largest or the smallest value of each field in the set is written, of elements that are there.",
        read Extreme::read;
    place: bool = Flag, Default("false"),
        "Whether the history also has the place of each extreme, as `NAME.FIELD_at_x` and so on: of its node, or of the middle of its element.";
    position: Position = Choice(Choices::Words(&["element", "node"])), Default("\"element\""),
        "What the values of fields of elements are of: elements, or nodes, each with the mean over the elements at it by their volumes.",
        read Position::read;
    /// Where.
    at: ProbeAt, read ProbeAt::read;
}

/// What a probe at a point goes with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ProbeKind {
    /// The material that was there at the start.
    #[default]
    Material,
    /// Nothing: it stays where it is.
    Place,
}

impl ProbeKind {
    fn read(values: &dyn Values) -> Self {
        if values.get::<String>("kind") == "place" { Self::Place } else { Self::Material }
    }
}

/// Which value of a field in a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The largest.
    Max,
    /// The smallest.
    Min,
}

impl Extreme {
    fn read(values: &dyn Values) -> Option<Self> {
        let word: Option<String> = values.get("extreme");
        word.map(|word| if word == "min" { Self::Min } else { Self::Max })
    }
}

/// What values of fields of elements are of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Position {
    /// Elements.
    #[default]
    Element,
    /// Nodes: means over the elements at each.
    Node,
}

impl Position {
    fn read(values: &dyn Values) -> Self {
        if values.get::<String>("position") == "node" { Self::Node } else { Self::Element }
    }
}

section! {
    /// `[[cut]]`: a plane through parts, and what it transmits.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Cut in CUT = Section {
        name: "cut",
        doc: "A plane (in 2D a line) through deformable parts at the start, or with `radius` a disc (a piece of the line), which moves \
            with the elements that it cuts: the history has the force and the moment that the side to which the normal points exerts \
            on the other one, by elements and by springs, welds, joints and ties. Contacts and loads do not count.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    name: String = Name, Required, "Unique name.";
    point: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Required, "A point of the plane.";
    normal: [f64; 3] = Spatial(Dimension::NONE, Finite), Required, "Its normal; any length but zero. Tension is a force along it.";
    radius: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("the whole plane"),
        "Elements are cut only where the middle of what the plane cuts of them is so near `point`: one wall of a ring or a frame.";
    parts: Vec<String> = References(None), Optional("all deformable parts that it cuts"), "Parts that it cuts, and whose connections count.";
}

impl Cut {
    /// Whether it goes through a part of this name.
    #[must_use]
    pub fn takes(&self, part: &str) -> bool {
        self.parts.is_empty() || self.parts.iter().any(|name| name == part)
    }
}

section! {
    /// `[[channel]]`: a formula of the history's columns.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Channel in CHANNEL = Section {
        name: "channel",
        doc: "A formula of the history's columns, found after the run: `channels.csv` has its values, `summary.json` its largest, \
            smallest and last one. Later channels may use earlier ones.",
        form: Form::Repeated,
        rules: &[Rule::NotBoth("filter", "corner")],
        ..Section::EMPTY
    };
    name: String = Name, Required, "Unique name.";
    expression: String = Text, Required,
        "A formula, such as `\"A.y - B.y\"`: names of columns, `t`, numbers, `+ - * / ^`, parentheses, the functions of curves, and \
            those of whole columns that [results](output.md#channels) lists, such as `cfc60(A.ax)`, `integral`, `hic15`.";
    "filter" = Choice(Choices::Words(&["CFC 60", "CFC 180", "CFC 600", "CFC 1000"])), Optional("none"),
        "Channel frequency class of SAE J211 and ISO 6487 by which the values are filtered, without phase.";
    "corner" = Quantity(Dimension::RATE, Positive), Optional("none"),
        "Frequency at which a Butterworth filter of fourth order without phase damps the values by 3 dB.";
    /// What filters the values.
    filter: Option<Filter>, read filter;
}

/// What filters the values of a channel, without phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// A channel frequency class: 60, 180, 600, 1000.
    Class(f64),
    /// Damps by 3 dB at this frequency, Hz.
    Corner(f64),
}

/// The filter of a channel.
fn filter(values: &dyn Values) -> Option<Filter> {
    if values.has("corner") {
        return Some(Filter::Corner(values.get("corner")));
    }
    let class = values.get::<Option<String>>("filter")?;
    class.strip_prefix("CFC ").and_then(|class| class.parse().ok()).map(Filter::Class)
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
    /// Element number `element` (from 0) of `part`.
    Element {
        /// Part name.
        part: String,
        /// Number within the part.
        element: usize,
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
        } else if values.has("element") {
            Self::Element { part: values.get("part"), element: values.get("element") }
        } else {
            Self::Set { set: values.get("set") }
        }
    }
}
