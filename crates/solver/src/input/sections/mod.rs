//! Every section and key of the model file, described once: name, kind of value, range, default, one line of
//! explanation.
//!
//! Names to choose from come from the registries. A new key is one line here and its use in the builder of
//! `embate-files`.

mod conditions;
mod contact;
mod discrete;
mod initial;

use crate::contact::{formulation, law, search};
use crate::failure::CRITERIA;
use crate::mesh::shapes::SHAPES;
use crate::mesh::shapes::sweep::{EXTRUDE, REVOLVE};
use crate::quantity::Range::{Finite, NotNegative, Positive, UpTo};
use crate::quantity::{Dimension, Parameter};
use crate::stress_state::STRESS_STATES;
use crate::vocabulary::Kind::{Angle, Choice, Flag, Integer, Name, Quantities, Quantity, Reference, Spatial, Table, Text, Vector};
use crate::vocabulary::Need::{self, Default, Optional, Required};
use crate::vocabulary::{Choices, Form, Key, Kind, More, Rule, Section, key};
use crate::{element, material, output};
use conditions::{CONSTRAINT, JOIN, LOAD, NON_REFLECTING, SYMMETRY};
use contact::{CONTACT, OBSTACLE};
use discrete::{POINT_MASS, SPRING};
use initial::STRESS_INITIAL;

/// Largest number of elements of a model.
pub const ELEMENTS_MAX: u128 = 100_000_000;

/// Keys outside all sections.
pub static TOP: Section = Section {
    name: "",
    doc: "Keys that stand above all sections.",
    form: Form::Single,
    required: false,
    keys: &[key("title", Text, Optional("the model's name"), "Title for pictures and reports.")],
    ..Section::EMPTY
};

/// Every section, in the order of the documentation.
pub static SECTIONS: &[&Section] = &[
    &RUN,
    &MATERIAL,
    &PART,
    &CONTACT,
    &OBSTACLE,
    &SYMMETRY,
    &CONSTRAINT,
    &JOIN,
    &LOAD,
    &NON_REFLECTING,
    &SPRING,
    &POINT_MASS,
    &CURVE,
    &PROBE,
    &OUTPUT,
];

/// Keys that people know from elsewhere or from before, and what stands for them now.
pub static MOVED: &[(&str, &str)] = &[("wall", "walls are obstacles now: [[obstacle]] with plane = { point, normal }")];

static RUN: Section = Section {
    name: "run",
    doc: "How long the simulation runs and what stops it.",
    form: Form::Single,
    required: true,
    keys: &[
        key("end", Quantity(Dimension::TIME, Positive), Required, "End time."),
        key("safety", Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.9"), "Fraction of the stable time step that is used."),
        key(
            "energy_limit",
            Quantity(Dimension::NONE, Positive),
            Default("0.05"),
            "Energy drift at which the run stops, as a fraction of the largest total energy.",
        ),
        key(
            "step_limit",
            Quantity(Dimension::TIME, Positive),
            Optional("a thousandth of the first stable step"),
            "Time step below which the run stops.",
        ),
        key(
            "velocity_limit",
            Quantity(Dimension::VELOCITY, Positive),
            Optional("twenty times the fastest wave and the fastest node or obstacle at the start together"),
            "Speed of a node above which the run stops: faster than waves, no body moves in a sound model.",
        ),
        key(
            "penetration_limit",
            Quantity(Dimension::LENGTH, Positive),
            Optional("the longest segment of the surfaces, and the local thickness of the thinner body"),
            "Depth of a contact at which the run stops.",
        ),
        key(
            "memory_limit",
            Quantity(Dimension::INFORMATION, Positive),
            Optional("what the machine has to spare, if the system reports it"),
            "Memory that the model may need, such as `8 GB`: one that needs more is refused before it is meshed.",
        ),
        key(
            "time_step",
            Quantity(Dimension::TIME, Positive),
            Optional("what the elements need"),
            "Largest time step. A model of rigid parts alone takes just this one, and without it the step that their \
                elements would need if they were not rigid.",
        ),
        key("max_steps", Integer(1), Optional("no limit"), "Largest number of steps."),
        key(
            "checkpoint",
            Quantity(Dimension::TIME, Positive),
            Optional("none by the clock"),
            "Wall time between two checkpoints, from which `embate resume` continues a run that was stopped; with it \
                the last good state of a run that fails is kept as well.",
        ),
        key("checkpoint_steps", Integer(1), Optional("none by number"), "Steps between two checkpoints, besides those by the clock."),
        key(
            "bulk_viscosity",
            Vector(Dimension::NONE, NotNegative),
            Default("[0, 0]"),
            "Linear and quadratic coefficient of the pressure that resists compression: `[0.06, 1.2]` spreads shocks \
                over a few elements and keeps them from ringing.",
        ),
        key(
            "relaxation",
            Table(&RELAXATION),
            Optional("none"),
            "Damping that brings everything to rest, and an end of the run when it is.",
        ),
        key("mass_scaling", Table(&MASS_SCALING), Optional("none"), "Makes elements with a small stable step heavier, once at the start."),
    ],
    ..Section::EMPTY
};

static RELAXATION: Section = Section {
    name: "relaxation",
    doc: "Dynamic relaxation: a damping of mass that adapts itself to the slowest motion brings everything to rest, \
        and the run ends when it is. For quasi-static states; what happens on the way means nothing.",
    keys: &[
        key(
            "tolerance",
            Quantity(Dimension::NONE, Positive),
            Default("1e-6"),
            "Kinetic energy over internal energy at which the state counts as at rest; it must stay below for half a \
                period of the slowest motion.",
        ),
        key(
            "from",
            Quantity(Dimension::TIME, NotNegative),
            Default("0"),
            "Time from which rest ends the run: when loads that grow are complete.",
        ),
    ],
    ..Section::EMPTY
};

static MASS_SCALING: Section = Section {
    name: "mass_scaling",
    doc: "Raises the density of elements whose stable step is too small, so that all allow one step at the start. \
        The added mass resists motion; what gravity pulls at stays the true mass. Later steps may be smaller, as \
        elements change their shape.",
    keys: &[
        key("time_step", Quantity(Dimension::TIME, Positive), Required, "Step that every element shall allow, `safety` included."),
        key(
            "limit",
            Quantity(Dimension::NONE, Positive),
            Default("0.05"),
            "Largest mass that may be added, as a fraction of the mass of the deformable parts; more is a fault.",
        ),
    ],
    ..Section::EMPTY
};

static MATERIAL: Section = Section {
    name: "material",
    doc: "A material: a law and its parameters. Parts refer to it by its name.",
    form: Form::Named,
    required: true,
    keys: &[
        key("law", Choice(Choices::Laws), Required, "Name of the law."),
        key("failure", Table(&FAILURE), Optional("nothing fails"), "When elements of this material fail: they are taken out of the model."),
        key(
            "eos",
            Choice(Choices::EquationsOfState),
            Optional("the law's own pressure"),
            "Equation of state: gives the pressure in place of the law, which keeps what is without volume. Not with \
                hyperelastic laws, nor where flow changes the volume (`drucker_prager`, `crushable_foam`); `null` \
                needs it.",
        ),
    ],
    more: &[More { by: "law", keys: law_keys }, More { by: "eos", keys: equation_keys }],
    ..Section::EMPTY
};

static FAILURE: Section = Section {
    name: "failure",
    doc: "Limits at which an element fails. What counts is the mean over its points, as in the result files, after \
        every step; any one limit is enough. A failed element pulls no more, contact sees the surfaces behind it at \
        once, and its mass stays on its nodes.",
    keys: &FAILURE_KEYS,
    ..Section::EMPTY
};

/// One key per criterion of the registry.
const FAILURE_KEYS: [Key; CRITERIA.len()] = {
    let mut keys = [key("", Flag, Required, ""); CRITERIA.len()];
    let mut at = 0;
    while at < CRITERIA.len() {
        let Parameter { name, dimension, range, doc, .. } = CRITERIA[at].limit;
        keys[at] = key(name, Quantity(dimension, range), Optional("no limit"), doc);
        at += 1;
    }
    keys
};

static PART: Section = Section {
    name: "part",
    doc: "A body of one material, and how it moves at the start. A shape, or a mesh file, says where its elements come from.",
    form: Form::Repeated,
    required: true,
    keys: &[
        key("name", Name, Required, "Unique name."),
        key("material", Reference, Required, "Name of a `[material.NAME]` section."),
        key("element", Choice(Choices::Elements), Default("\"quad4\""), "Kind of element: what quadrilaterals are; `bar2` for bars."),
        key("element_triangles", Choice(Choices::Triangles), Optional("`tri3`"), "What triangles are, where the part has some."),
        key(
            "area",
            Quantity(Dimension::LENGTH, Positive),
            Optional("only with bars"),
            "Cross-section of bars per metre of depth, such as `\"1e-4 m\"` for one square centimetre in each metre; \
                between solids whole, `\"1e-4 m^2\"`.",
        ),
        key(
            "hourglass",
            Quantity(Dimension::NONE, NotNegative),
            Optional("that of the control's source"),
            "Coefficient of the hourglass control of elements that have one.",
        ),
        key(
            "stress_state",
            Choice(Choices::StressStates),
            Default("\"plane_strain\""),
            "What the plane stands for. In an axisymmetric part x is the radius and y the axis; forces, masses and \
                energies are those of the whole circumference.",
        ),
        key("velocity", Spatial(Dimension::VELOCITY, Finite), Default("[0, 0]"), "Initial velocity."),
        key(
            "spin",
            Angle(Dimension::RATE, Finite),
            Default("0"),
            "Initial angular velocity about the centre of mass, counter-clockwise; not of an axisymmetric part.",
        ),
        key("stress_initial", Table(&STRESS_INITIAL), Optional("none"), "Stress at the start."),
        key(
            "temperature_initial",
            Quantity(Dimension::TEMPERATURE, Positive),
            Optional("that of the material"),
            "Temperature at the start, of laws that have one (`johnson_cook`).",
        ),
        key(
            "rigid",
            Kind::Rigid,
            Default("false"),
            "Whether the part is rigid, free to move; or how it moves: `x` and `y` of its centre of mass, `rotation` \
                about it. What is left out is free. An axisymmetric part moves along `y` only.",
        ),
        key(
            "mass_scale",
            Quantity(Dimension::NONE, Positive),
            Default("1"),
            "Factor on the mass of the part where mass resists motion: 100 makes steps ten times as long. What \
                gravity pulls at stays the true mass.",
        ),
        key(
            "mirror",
            Table(&MIRROR),
            Optional("not mirrored"),
            "A line, in 3D a plane, that the shape is mirrored on, before it is turned.",
        ),
        key("rotation", Table(&ROTATION), Optional("not turned"), "An angle by which the shape is turned, before it is moved."),
        key("extrude", Table(&EXTRUDE), Optional("the part stays 2D"), "Extrudes a 2D shape along z: the part becomes a solid."),
        key("revolve", Table(&REVOLVE), Optional("the part stays 2D"), "Revolves a 2D shape about a line: the part becomes a solid."),
        key("translation", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "How far the shape is moved."),
        key("copies", Table(&COPIES), Optional("one body"), "More bodies of the same shape, in a row or around a point."),
    ],
    groups: &[&SHAPES],
    rules: &[
        Rule::NotBoth("extrude", "revolve"),
        Rule::NotBoth("mesh", "mirror"),
        Rule::NotBoth("mesh", "rotation"),
        Rule::NotBoth("mesh", "translation"),
        Rule::NotBoth("mesh", "copies"),
    ],
    ..Section::EMPTY
};

static MIRROR: Section = Section {
    name: "mirror",
    doc: "The shape is mirrored on a line, in 3D on a plane.",
    keys: &[
        key("normal", Spatial(Dimension::NONE, Finite), Required, "Normal of the line or plane; any length but zero."),
        key("point", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "A point of the line or plane."),
    ],
    ..Section::EMPTY
};

pub(super) static ROTATION: Section = Section {
    name: "rotation",
    doc: "The shape is turned about a point, in 3D about an axis.",
    keys: &[
        key("angle", Angle(Dimension::NONE, Finite), Required, "Angle, counter-clockwise; about an axis by the right-hand rule."),
        key("point", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "The point; in 3D one of the axis."),
        key("axis", Spatial(Dimension::NONE, Finite), Default("[0, 0, 1]"), "Direction of the axis, of a solid; any length but zero."),
    ],
    ..Section::EMPTY
};

static COPIES: Section = Section {
    name: "copies",
    doc: "The part consists of several bodies of one shape, each turned and moved from the one before. Sides are those of all of them.",
    keys: &[
        key("count", Integer(1), Required, "Number of bodies in all."),
        key("translation", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "How far each is moved."),
        key("angle", Angle(Dimension::NONE, Finite), Default("0"), "Angle by which each is turned, counter-clockwise."),
        key("point", Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "Point about which they are turned; in 3D one of the axis."),
        key(
            "axis",
            Spatial(Dimension::NONE, Finite),
            Default("[0, 0, 1]"),
            "Direction of the axis about which they are turned, of solids; any length but zero.",
        ),
    ],
    rules: &[Rule::SomeOf(&["translation", "angle"])],
    ..Section::EMPTY
};

static CURVE: Section = Section {
    name: "curve",
    doc: "A function of time, named where something follows it: by points (`time` and `value`; constant before the \
        first and after the last), a `sine`, or a formula (`expression`). The name begins with a letter.",
    form: Form::Named,
    required: false,
    keys: &[
        key("time", Kind::Quantities(Dimension::TIME, Finite, 1), Optional("`sine` or `expression`"), "Times, ascending."),
        key(
            "value",
            Kind::Values,
            Optional("`sine` or `expression`"),
            "Values, as many: of one dimension, or bare numbers in the SI unit of what uses the curve.",
        ),
        key(
            "between",
            Choice(Choices::Words(&["lines", "smooth_steps"])),
            Default("\"lines\""),
            "What leads from point to point: straight lines, or steps without velocity and acceleration at their ends.",
        ),
        key("sine", Table(&SINE), Optional("points or `expression`"), "A wave."),
        key(
            "expression",
            Text,
            Optional("points or `sine`"),
            "A formula of the time `t` in s, such as `\"2*sin(3*t) + exp(-t)\"`, in the SI unit of what uses the \
                curve: numbers, `+ - * / ^`, parentheses, `pi`, `sin`, `cos`, `exp`, `ln`, `sqrt`, `abs`, `min`, \
                `max`, and `step(x)`, which is 0 for x < 0, else 1.",
        ),
    ],
    rules: &[
        Rule::OneOf(&["value", "sine", "expression"]),
        Rule::Needs("value", "time"),
        Rule::NotBoth("time", "sine"),
        Rule::NotBoth("time", "expression"),
        Rule::NotBoth("between", "sine"),
        Rule::NotBoth("between", "expression"),
    ],
    ..Section::EMPTY
};

static SINE: Section = Section {
    name: "sine",
    doc: "offset + amplitude * sin(2 pi frequency t + phase).",
    form: Form::Inline,
    required: false,
    keys: &[
        key("amplitude", Kind::Value, Required, "Height of the wave: a quantity, or a bare number in the SI unit of what uses the curve."),
        key("frequency", Quantity(Dimension::RATE, Positive), Required, "Waves per time."),
        key("phase", Angle(Dimension::NONE, Finite), Default("0"), "Angle at time zero."),
        key("offset", Kind::Value, Default("0"), "Mean value, of the same dimension."),
    ],
    ..Section::EMPTY
};

static PROBE: Section = Section {
    name: "probe",
    doc: "A place whose position and velocity are written to the history as `NAME.x`, `NAME.y`, `NAME.vx`, \
        `NAME.vy`: the node of `part` nearest to `point`, node number `node` of `part`, or the mean over `set`.",
    form: Form::Repeated,
    required: false,
    keys: &[
        key("name", Name, Required, "Unique name."),
        key("part", Reference, Optional("only with `set`"), "Part of `point` or `node`."),
        key("point", Spatial(Dimension::LENGTH, Finite), Optional("`node` or `set`"), "Initial position; the nearest node is taken."),
        key("node", Integer(0), Optional("`point` or `set`"), "Number of the node in its part, from 0."),
        key("set", Reference, Optional("`point` or `node`"), "A part, a side such as `plate.top`, or a group of a mesh file."),
    ],
    rules: &[
        Rule::OneOf(&["point", "node", "set"]),
        Rule::Needs("point", "part"),
        Rule::Needs("node", "part"),
        Rule::NotBoth("set", "part"),
    ],
    ..Section::EMPTY
};

static OUTPUT: Section = Section {
    name: "output",
    doc: "What is written.",
    form: Form::Single,
    required: false,
    keys: &[
        key("fields", Kind::Cadence, Default("100"), "How often the fields are written: a count, or an interval such as `\"0.1 ms\"`."),
        key("history", Kind::Cadence, Default("1000"), "How often a row of the history is written: a count or an interval."),
        key(
            "hash_steps",
            Integer(0),
            Default("100"),
            "Steps between two lines of `hashes.csv`, by which `embate diff` finds where two runs diverge; 0: none are written.",
        ),
        key("include", Kind::Choices(Choices::Fields), Optional("all"), "Fields to write."),
        key(
            "mirror",
            Kind::Choices(Choices::Words(&["x", "y", "z"])),
            Optional("none"),
            "Pictures also show the model mirrored at the line (in 3D the plane) x = 0 (`\"x\"`), y = 0 (`\"y\"`), \
                in 3D z = 0 (`\"z\"`), or several of them.",
        ),
        key("pictures", Flag, Default("true"), "Whether pictures and the animation are made."),
        key("picture_field", Choice(Choices::Fields), Optional("what suits the model"), "Field that colours the pictures."),
        key(
            "picture_view",
            Table(&PICTURE_VIEW),
            Optional("all bodies, and obstacles near them"),
            "What pictures and animation show; `embate check` draws the whole mesh all the same.",
        ),
        key("camera", Table(&CAMERA), Optional("three sides are seen"), "From where pictures of a 3D model look at it."),
    ],
    ..Section::EMPTY
};

static CAMERA: Section = Section {
    name: "camera",
    doc: "How pictures look at a 3D model: from afar, so that parallel lines stay parallel, and with everything in sight.",
    keys: &[
        key(
            "from",
            Spatial(Dimension::NONE, Finite),
            Default("[0.6, -1, 0.5]"),
            "Direction from the model to the camera; any length but zero.",
        ),
        key("at", Spatial(Dimension::LENGTH, Finite), Optional("the middle of all that is seen"), "What is in the middle of the picture."),
        key("up", Spatial(Dimension::NONE, Finite), Default("[0, 0, 1]"), "Direction that is upwards in the picture; not that of `from`."),
        key("zoom", Quantity(Dimension::NONE, Positive), Default("1"), "How many times larger than so that everything is seen."),
    ],
    ..Section::EMPTY
};

static PICTURE_VIEW: Section = Section {
    name: "picture_view",
    doc: "The rectangle that pictures show, mirror images included; in 3D in the plane of the picture, from the image of the origin.",
    keys: &[
        key("corner", Vector(Dimension::LENGTH, Finite), Required, "Lower left corner."),
        key("size", Vector(Dimension::LENGTH, Positive), Required, "Width and height."),
    ],
    ..Section::EMPTY
};

impl Choices {
    /// The names.
    #[must_use]
    pub fn names(self) -> Vec<&'static str> {
        match self {
            Self::Words(words) => words.to_vec(),
            Self::Listed(list) => list(),
            Self::Laws => material::registry().iter().map(|kind| kind.name).collect(),
            Self::EquationsOfState => material::eos::EQUATIONS.iter().map(|kind| kind.name).collect(),
            Self::Elements => element::registry().iter().filter(|kind| !kind.is_triangle()).map(|kind| kind.name).collect(),
            Self::Triangles => element::registry().iter().filter(|kind| kind.is_triangle()).map(|kind| kind.name).collect(),
            Self::StressStates => STRESS_STATES.iter().map(|kind| kind.name).collect(),
            Self::ContactLaws => law::LAWS.iter().map(|kind| kind.name).collect(),
            Self::Formulations => formulation::FORMULATIONS.iter().map(|kind| kind.name).collect(),
            Self::Searches => search::registry::<2>().iter().map(|kind| kind.name).collect(),
            Self::Fields => output::FIELDS.iter().map(|kind| kind.name).collect(),
        }
    }
}

/// The keys of a law's parameters.
fn law_keys(law: &str) -> Option<Vec<Key>> {
    Some(parameter_keys(material::registry().into_iter().find(|kind| kind.name == law)?.parameters))
}

/// The keys of the parameters of an equation of state.
fn equation_keys(name: &str) -> Option<Vec<Key>> {
    let mut keys = parameter_keys(material::eos::kind(name)?.parameters);
    let Parameter { name, dimension, range, doc, .. } = material::eos::TENSION;
    keys.push(key(name, Quantity(dimension, range), Optional("no limit"), doc));
    Some(keys)
}

fn parameter_keys(parameters: &[Parameter]) -> Vec<Key> {
    let need = |default: Option<f64>| default.map_or(Required, Need::Value);
    let kind_of = |p: &Parameter| if p.list > 0 { Quantities(p.dimension, p.range, 1) } else { Quantity(p.dimension, p.range) };
    let need_of = |p: &Parameter| if p.list > 0 && p.default.is_some() { Optional("none") } else { need(p.default) };
    parameters.iter().map(|p| key(p.name, kind_of(p), need_of(p), p.doc)).collect()
}

/// The section of this name.
#[must_use]
pub fn section(name: &str) -> Option<&'static Section> {
    SECTIONS.iter().copied().find(|section| section.name == name)
}

/// The key at a path such as `part[0].ring.inner` or `run.end`; indices are ignored. Parameters of materials
/// are not found here.
#[must_use]
pub fn find(path: &str) -> Option<&'static Key> {
    let mut steps = path.split('.').map(|step| step.split('[').next().unwrap_or(step));
    let first = steps.next()?;
    let Some(mut here) = section(first) else { return TOP.all_keys().find(|key| key.name == first) };
    loop {
        let name = steps.next()?;
        let key = here.all_keys().find(|key| key.name == name)?;
        match (key.kind, steps.clone().next()) {
            (Kind::Table(inner), Some(_)) => here = inner,
            _ => return Some(key),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_finds_its_key() {
        assert_eq!(find("part[3].ring.inner").map(|key| key.name), Some("inner"));
        assert_eq!(find("part[3].rectangle.size[1]").map(|key| key.name), Some("size"));
        assert_eq!(find("run.end").map(|key| key.name), Some("end"));
        assert_eq!(find("constraint[0].velocity.x").map(|key| key.name), Some("velocity"));
        assert_eq!(find("title").map(|key| key.name), Some("title"));
        assert!(find("run.nothing").is_none() && find("").is_none() && find("part").is_none());
    }

    #[test]
    fn every_section_and_key_explains_itself_and_is_unique() {
        let mut all: Vec<&Section> = SECTIONS.to_vec();
        all.push(&TOP);
        for section in &mut all.clone() {
            all.extend(section.all_keys().filter_map(|key| if let Kind::Table(inner) = key.kind { Some(inner) } else { None }));
        }
        for section in all {
            assert!(section.doc.ends_with('.'), "{}", section.name);
            assert!(section.groups.iter().all(|group| group.doc.ends_with('.')), "{}", section.name);
            let mut names: Vec<&str> = section.all_keys().map(|key| key.name).collect();
            assert!(section.all_keys().all(|key| key.doc.ends_with('.')), "{}", section.name);
            for rule in section.all_rules() {
                let own: Vec<&str> = match rule {
                    Rule::OneOf(names) | Rule::SomeOf(names) => names.to_vec(),
                    Rule::NotBoth(a, b) | Rule::Needs(a, b) => vec![a, b],
                    Rule::Only { keys, by, .. } | Rule::With { by, keys, .. } => keys.iter().chain([by]).copied().collect(),
                };
                assert!(own.iter().all(|name| names.contains(name)), "{}: {rule:?}", section.name);
            }
            let count = names.len();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), count, "{} has a key twice", section.name);
        }
    }
}
