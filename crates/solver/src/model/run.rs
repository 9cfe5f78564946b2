//! How long and how carefully a [`super::Model`] runs: `[run]`.

use super::section;
use crate::quantity::Dimension;
use crate::quantity::Range::{NotNegative, Positive, UpTo};
use crate::vocabulary::Kind::{Choice, Flag, Integer, Quantity, Table, Vector};
use crate::vocabulary::{Choices, Form, Section};

/// What bounds the stable step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StableStep {
    /// The element that alone would need the shortest.
    #[default]
    Elements,
    /// The node at which the stiffness of its elements together is the largest for its mass.
    Nodes,
    /// The fastest motion of the assembled mesh, by Lanczos' method.
    Assembled,
}

section! {
    /// `[run]`: how long and how carefully.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Run in RUN = Section {
        name: "run",
        doc: "How long the simulation runs and what stops it.",
        form: Form::Single,
        required: true,
        ..Section::EMPTY
    };
    end: f64 = Quantity(Dimension::TIME, Positive), Optional("only with stages: their durations together"), "End time.",
        read |values| values.get::<Option<f64>>("end").unwrap_or_default();
    safety: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("0.9"),
        "Fraction of the stable time step that is used.";
    stable_step: StableStep = Choice(Choices::Words(&["elements", "nodes", "assembled"])), Default("\"elements\""),
        "What bounds the stable step: the element that alone would need the shortest, the node at which the stiffness \
            of its elements together is the largest for its mass, or the largest frequency of the assembled mesh, \
            which Lanczos' method finds, with what the deformation may have added since. By nodes the step is never \
            shorter, and longer where bad elements lie among good ones; by the assembled mesh it is the longest.",
        read |values| match values.get::<String>("stable_step").as_str() {
            "nodes" => StableStep::Nodes,
            "assembled" => StableStep::Assembled,
            _ => StableStep::Elements,
        };
    energy_limit: f64 = Quantity(Dimension::NONE, Positive), Default("0.05"),
        "Energy drift at which the run stops, as a fraction of the largest total energy.";
    step_limit: Option<f64> = Quantity(Dimension::TIME, Positive), Optional("a thousandth of the first stable step"),
        "Time step below which the run stops.";
    velocity_limit: Option<f64> = Quantity(Dimension::VELOCITY, Positive), Optional("twenty times the fastest wave and the fastest node or obstacle at the start together"),
        "Speed of a node above which the run stops: faster than waves, no body moves in a sound model.";
    penetration_limit: Option<f64> = Quantity(Dimension::LENGTH, Positive), Optional("the longest segment of the surfaces, and the local thickness of the thinner body"),
        "Depth of a contact at which the run stops.";
    memory_limit: Option<f64> = Quantity(Dimension::INFORMATION, Positive), Optional("what the machine has to spare, if the system reports it"),
        "Memory that the model may need, such as `8 GB`: one that needs more is refused before it is meshed.";
    time_step: Option<f64> = Quantity(Dimension::TIME, Positive), Optional("what the elements need"),
        "Largest time step. A model of rigid parts alone takes just this one, and without it the step that their \
            elements would need if they were not rigid.";
    max_steps: Option<u64> = Integer(1), Optional("no limit"), "Largest number of steps.";
    checkpoint: Option<f64> = Quantity(Dimension::TIME, NotNegative), Optional("after 5 s, then at doubling intervals up to 2 min"),
        "Wall time between two checkpoints, from which `embate resume` continues a run that was stopped; with it \
            the last good state of a run that fails is kept as well. 0: none by the clock. Without it, and without \
            `checkpoint_steps`, intervals are so long that checkpoints cost less than a hundredth of the run.";
    checkpoint_steps: Option<u64> = Integer(1), Optional("none by number"),
        "Steps between two checkpoints; then there are none by the clock unless `checkpoint` is there, too.";
    bulk_viscosity: [f64; 2] = Vector(Dimension::NONE, NotNegative), Default("[0, 0]"),
        "Linear and quadratic coefficient of the pressure that resists compression: `[0.06, 1.2]` spreads shocks \
            over a few elements and keeps them from ringing.";
    relaxation: Option<Relaxation> = Table(&RELAXATION), Optional("none"),
        "Damping that brings everything to rest, and an end of the run when it is.";
    subcycling: bool = Flag, Default("false"),
        "Evaluates elements that allow a longer step in every second, third, ... up to 60th step only, and those that \
            need the shortest in all: for meshes in which sizes or materials differ much.";
    mass_scaling: Option<MassScaling> = Table(&MASS_SCALING), Optional("none"),
        "Makes elements with a small stable step heavier, at the start and, if wanted, in the run.";
}

section! {
    /// Dynamic relaxation: damping that adapts itself, and an end when all is at rest.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Relaxation in RELAXATION = Section {
        name: "relaxation",
        doc: "Dynamic relaxation: a damping of mass that adapts itself to the slowest motion brings everything to rest, \
            and the run ends when it is. For quasi-static states; what happens on the way means nothing.",
        ..Section::EMPTY
    };
    tolerance: f64 = Quantity(Dimension::NONE, Positive), Default("1e-6"),
        "Kinetic energy over internal energy at which the state counts as at rest; it must stay below for half a \
            period of the slowest motion.";
    from: f64 = Quantity(Dimension::TIME, NotNegative), Default("0"),
        "Time from which rest ends the run, or the stage: when loads that grow are complete.";
}

section! {
    /// Makes elements with a small stable step heavier.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct MassScaling in MASS_SCALING = Section {
        name: "mass_scaling",
        doc: "Raises the density of elements whose stable step is too small, so that all allow one step at the start. \
            The added mass resists motion; what gravity pulls at stays the true mass. Later steps may be smaller, as \
            elements change their shape; `in_run` adds mass then, too.",
        ..Section::EMPTY
    };
    time_step: f64 = Quantity(Dimension::TIME, Positive), Required,
        "Step that every element shall allow, `safety` included.";
    limit: f64 = Quantity(Dimension::NONE, Positive), Default("0.05"),
        "Largest mass that may be added, as a fraction of the mass of the deformable parts; more at the start is a fault.";
    in_run: bool = Flag, Default("false"),
        "Whether elements whose step falls below `time_step` in the run get mass then, until they would need more than \
            `limit`; after that the step falls. The mass comes with the velocity of its node.";
}
