//! Faults and warnings of a model, errors and notices of a run. All faults of a model are reported at once; a
//! model with warnings is accepted; the first error ends a run; a notice is for the user of a run that
//! continues. Each is of a kind that is in the catalogue of messages (`message.rs`); those of runs are here.

use crate::archive::ArchiveError;
use crate::message::{Example, Message};
use std::fmt;
use thiserror::Error;

pub(crate) static MESSAGES: &[&Message] = &[
    &INVERTED,
    &COLLAPSED,
    &ENERGY_DRIFT,
    &NOT_FINITE,
    &STATE,
    &OUTPUT,
    &MASS_SCALING,
    &TOO_DEEP,
    &RUNAWAY,
    &MEMORY,
    &INSTRUCTIONS,
    &STEERING,
    &MASS_ADDED,
    &ERODED,
    &RELAXED,
    &STEERED,
    &SQUEEZED,
    &OPENED,
    &FEW_STEPS,
    &FAR_PROBE,
    &REMESH_ENERGY,
    &NOT_REMESHED,
    &REMESH_LOSS,
    &STUCK,
    &NO_EXCHANGE,
    &FLOW_STATE,
];

static INVERTED: Message = Message {
    code: "E0601",
    title: "an element turned inside out",
    example: Example::Model(
        "[[constraint]]\non = \"wall.right\"\nvelocity = { x = \"-3 km/s\" }\n\n[[constraint]]\non = \"wall.left\"\nfixed = \"x\"\n",
    ),
    cause: "The element was squeezed or sheared until its volume was gone at some point: a load or velocity that the \
        material can't bear, wrong units, or hourglass motion.",
    remedy: "Refine the mesh at the place that the message names, lower the load or velocity, check the units of the \
        material, or let elements fail before (`failure`).",
};

static COLLAPSED: Message = Message {
    code: "E0602",
    title: "the stable time step collapsed",
    example: Example::Model("[run]\nstep_limit = \"5 us\"\n"),
    cause: "The step goes with the smallest element over the speed of sound in it: an element was squeezed flat, or grew very stiff.",
    remedy: "Look at the element that the message names in the last written state; or lower `run.step_limit`.",
};

static ENERGY_DRIFT: Message = Message {
    code: "E0603",
    title: "energy came from nowhere or was lost",
    example: Example::Words(
        "Contact penalties far stiffer than the bodies, or a step that is not stable (`safety` near 1 with strong contact).",
    ),
    cause: "The sum of all energies is not the sum of all works: the run is not a solution of its equations.",
    remedy: "Lower `run.safety`, check contact penalties and initial penetrations; raise `run.energy_limit` only if \
        the loss is understood.",
};

static NOT_FINITE: Message = Message {
    code: "E0604",
    title: "a number is no longer finite",
    example: Example::Model(
        "[curve.push]\ntime = [0, \"1 us\"]\nvalue = [0, \"1e300 m/s\"]\n\n[[constraint]]\non = \"wall.right\"\nvelocity \
            = { x = \"push\" }\n",
    ),
    cause: "Parameters, loads or units are wrong by powers of ten, so that a value overflowed or zero was divided by zero.",
    remedy: "Check material parameters, loads and units of what the message names.",
};

static TOO_DEEP: Message = Message {
    code: "E0606",
    title: "a contact is too deep",
    example: Example::Model(
        "[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\npenalty_scale = 1e-9\n\n[run]\nend = \"2 ms\"\n",
    ),
    cause: "A surface is deeper inside another than the longest segment, or than the thinner body there is thick (or \
        than `run.penetration_limit`): the contact is far too soft for what presses on it, or began to act when the \
        bodies were already inside each other.",
    remedy: "Raise `penalty_scale` or `penalty` of the contact, or take the law `multiplier`; raise \
        `run.penetration_limit` where so much depth is meant.",
};

static RUNAWAY: Message = Message {
    code: "E0607",
    title: "a node runs away",
    example: Example::Model("[[load]]\ngravity = [\"9.81e13 m/s^2\", 0]\n"),
    cause: "No body moves many times as fast as its waves, unless it was thrown so: a load, a velocity or a unit is \
        wrong by powers of ten, a spring or a contact shot a node away, or a light node has nothing that holds it.",
    remedy: "Look at the node that the message names, and at the units of loads on its part; raise \
        `run.velocity_limit` where such speeds are meant.",
};

/// A model needs more memory than there may be.
pub static MEMORY: Message = Message {
    code: "E0608",
    title: "more memory than there may be",
    example: Example::Model("[run]\nmemory_limit = \"1 kB\"\n"),
    cause: "The model has so many elements that they would not fit into the memory that `run.memory_limit` allows, \
        or that the machine has to spare.",
    remedy: "Take larger elements, and fine ones only where something happens (`grading`), or a machine with more \
        memory; raise `run.memory_limit`.",
};

static STATE: Message = Message {
    code: "E0710",
    title: "a kept state that does not fit its model",
    example: Example::Words("A checkpoint that another version of embate wrote, with check sums that are right."),
    cause: "The state of a run has other parts than the model that continues it.",
    remedy: "Continue with the version that began the run, or start it again with `embate run --force`.",
};

static OUTPUT: Message = Message {
    code: "E0701",
    title: "results can't be written",
    example: Example::Words("The disk becomes full while a run writes its fields."),
    cause: "The system refused to write; its own words are in the message.",
    remedy: "Free some space, or write to another disk with --out.",
};

/// Mass scaling would add more than its limit.
pub static MASS_SCALING: Message = Message {
    code: "E0605",
    title: "mass scaling would add more than its limit",
    example: Example::Model("[run]\nmass_scaling = { time_step = \"10 us\", limit = 0.01 }\n"),
    cause: "The step that is asked for needs more mass than `limit` allows: inertia would be wrong.",
    remedy: "Take a smaller step, fix the smallest elements, or raise `limit` where inertia does not matter.",
};

pub(crate) static INSTRUCTIONS: Message = Message {
    code: "E0801",
    title: "an instruction set that this machine does not have",
    example: Example::Command("run model.toml --simd sse9"),
    cause: "The processor, or the program as it was built for it, does not know the set.",
    remedy: "Take one of those that the message lists, or leave --simd out; results do not depend on it.",
};

pub(crate) static STEERING: Message = Message {
    code: "E0609",
    title: "a change of a running simulation that can't be made",
    example: Example::Words(
        "Python gives a velocity to a node of a rigid part, a force that is not a number, or a value to a curve that the model does not have.",
    ),
    cause: "Between two steps nodes may be given other velocities and forces: finite numbers, a vector for each \
        node; velocities only where nothing else leads the node. Curves of the model may be given other values, from now or from a later time on.",
    remedy: "Look at the numbers, nodes and curves that the message names; a rigid part is moved by forces or by a curve, joined nodes by forces.",
};

pub(crate) static MASS_ADDED: Message = Message {
    code: "W0601",
    title: "mass scaling added mass",
    example: Example::Model("[run]\nmass_scaling = { time_step = \"600 ns\", limit = 2 }\n"),
    cause: "`mass_scaling` makes the smallest elements heavier, so that a longer step is stable.",
    remedy: "Nothing, where the mass is small and inertia does not matter; else a smaller `time_step`.",
};

pub(crate) static ERODED: Message = Message {
    code: "W0602",
    title: "elements were eroded",
    example: Example::Model(
        "[run]\nend = \"20 us\"\n\n[material.steel]\nlaw = \"j2\"\nyield = \"100 MPa\"\nhardening = \"1 \
            GPa\"\nfailure = { plastic_strain = 0.01 }\n\n[[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity \
            = [\"200 m/s\", 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] \
            }\n\n[[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle = { corner = [\"10.01 mm\", \"-5 mm\"], \
            size = [\"10 mm\", \"20 mm\"], elements = [2, 4] }\n",
    ),
    cause: "Elements reached the limit of a criterion and were taken out; the message names the first.",
    remedy: "Nothing, where that is what is computed; else look at the place and time of the first.",
};

pub(crate) static RELAXED: Message = Message {
    code: "W0603",
    title: "how a relaxation ended",
    example: Example::Model("[run]\nrelaxation = {}\n"),
    cause: "A run with `relaxation` ends at rest, or at its end time without having come to rest.",
    remedy: "Give a later `end`, or a larger `tolerance`, where it is not at rest.",
};

pub(crate) static STEERED: Message = Message {
    code: "W0606",
    title: "a run that the program changed on its way",
    example: Example::Words("A callback of Python gives nodes other velocities or forces, or a curve other values."),
    cause: "The program that drove the run has changed velocities, forces or curves between its steps. What it did is \
        in the results, works included, and not in the model: `embate run` of the model gives another run, and \
        `embate resume` continues without the changes to come.",
    remedy: "Run the program again to repeat the run: the same changes at the same steps have the same bits.",
};

static SQUEEZED: Message = Message {
    code: "E0610",
    title: "a cavity without volume",
    example: Example::File(
        "[run]\nend = \"1 ms\"\n\n[material.steel]\nlaw = \"elastic\"\ndensity = \"7800 kg/m^3\"\nyoung = \"200 GPa\"\npoisson = 0.3\n\n\
         [[part]]\nname = \"piston\"\nmaterial = \"steel\"\nvelocity = [0, \"-500 m/s\"]\nrectangle = { corner = [0, \"20 mm\"], size = [\"10 mm\", \"10 mm\"], elements = [1, 1] }\n\n\
         [[part]]\nname = \"floor\"\nmaterial = \"steel\"\nrectangle = { corner = [0, \"-10 mm\"], size = [\"10 mm\", \"10 mm\"], elements = [1, 1] }\n\n\
         [[symmetry]]\nnormal = [1, 0]\n\n[[symmetry]]\npoint = [\"10 mm\", 0]\nnormal = [1, 0]\n\n[[constraint]]\non = \"floor\"\nfixed = [\"x\", \"y\"]\n\n\
         [[cavity]]\nname = \"gas\"\non = [\"piston.bottom\", \"floor.top\"]\nambient = \"1 kPa\"\n\n[output]\npictures = false\n",
    ),
    cause: "The surface of the gas turned inside out within a step: as its volume goes to zero its pressure has no limit, \
        so the walls were too fast for the step, or there was nothing in the way of walls of little mass.",
    remedy: "Give the surface a contact with itself, and `run.time_step` a smaller value where walls are fast; look at units of pressure and mass.",
};

pub(crate) static OPENED: Message = Message {
    code: "W0604",
    title: "a cavity that opened",
    example: Example::File(
        "[run]\nend = \"200 us\"\n\n[material.steel]\nlaw = \"j2\"\ndensity = \"7800 kg/m^3\"\nyoung = \"200 GPa\"\npoisson = 0.3\nyield = \"300 MPa\"\nhardening = \"1 GPa\"\n\
         failure = { plastic_strain = 0.05 }\n\n\
         [[part]]\nname = \"tank\"\nmaterial = \"steel\"\nring = { centre = [0, 0], inner = \"99 mm\", outer = \"101 mm\", elements = [1, 24] }\n\n\
         [[cavity]]\nname = \"gas\"\non = \"tank.inner\"\npressure = \"20 MPa\"\nambient = \"100 kPa\"\n\n[output]\npictures = false\n",
    ),
    cause: "A piece of the surface that encloses the gas was eroded. From then on the gas has the pressure outside: it pushes \
        no more, and its values in the history stay as they were.",
    remedy: "Nothing, where the wall is meant to burst; the gas that would blow out through the hole for a while is not modelled.",
};

pub(crate) static FEW_STEPS: Message = Message {
    code: "W0605",
    title: "a run of a few steps, or of far too many",
    example: Example::Model("[run]\nend = \"1 us\"\n"),
    cause: "The end is less than ten stable steps away, in which no wave crosses more than a few elements, or more than 1e9. \
        Most often the end, or the size of the elements, is in another unit than it was meant in.",
    remedy: "Look at the units of `run.end` and of lengths; of a mesh file `scale` is the unit of its lengths. Fix what makes \
        the step short, which `embate check --time-step` shows.",
};

pub(crate) static FAR_PROBE: Message = Message {
    code: "W0703",
    title: "a probe far from its point",
    example: Example::Model("[[probe]]\nname = \"tip\"\npart = \"block\"\npoint = [10, 5]\n"),
    cause: "A probe watches the node of its part that is nearest to the point. That is farther away than the elements there are \
        large, so the point is not in the part.",
    remedy: "Look at the unit and the coordinates of the point, or name the part that is there.",
};

static REMESH_ENERGY: Message = Message {
    code: "E0611",
    title: "too much energy was lost by making elements again",
    example: Example::Words(
        "A `[[remesh]]` with a `size` that resolves nothing of the stresses, or that is far coarser than the mesh before.",
    ),
    cause: "Each transfer of the state to new elements loses some of the kinetic and elastic energy; the sum went over `remesh.loss_limit`.",
    remedy: "Take a finer `size`, or make elements again less often (`quality`, `time_step`, `interval`); raise `loss_limit` if the loss is understood.",
};

pub(crate) static NOT_REMESHED: Message = Message {
    code: "W0617",
    title: "elements that could not be made again",
    example: Example::Words("A part is squeezed to a film that no quadrilaterals of the wanted quality fit in."),
    cause: "No better mesh was found inside the outline, or the state did not go over to it; the run continued with the old elements.",
    remedy: "Take another `size`, allow more elements (`elements_most`), or make them again earlier (`quality` nearer to 1). Where only nodes are moved (`[[relocate]]`), what helps is another mesh at the start or, in 2D, `[[remesh]]`.",
};

pub(crate) static REMESH_LOSS: Message = Message {
    code: "W0618",
    title: "energy lost by making elements again",
    example: Example::Words("A run with many events of `[[remesh]]`, whose losses sum up to more than a hundredth of its energy."),
    cause: "Each transfer of the state to new elements loses some of the kinetic and elastic energy; the history has the sum as `energy.remap`.",
    remedy: "Take a finer `size`, or make elements again less often.",
};

static STUCK: Message = Message {
    code: "E0612",
    title: "nodes of a flow that can't go back to their places",
    example: Example::Model("[run]\nend = \"1 ms\"\n\n[[flow]]\npart = \"block\"\ndirection = [1, 1]\n"),
    cause: "Nodes of a part with `[[flow]]` go with the material and back along the flow. That needs one inlet, one outlet and a surface on \
        either side of it that does not overhang, and at both ends a flow along `direction`.",
    remedy: "Look at the part in the frame before this time. Take a longer part, so that its ends lie where the flow is uniform, or a later \
        `begin`; for what folds or turns back take `[[remesh]]`.",
};

pub(crate) static NO_EXCHANGE: Message = Message {
    code: "E0613",
    title: "a mesh that a state can't go over to",
    example: Example::Shell(
        "embate run model.toml --out run --quiet\ncat > other.msh <<'END'\n$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n\
         2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 1 1 1 2 3 4\n$EndElements\nEND\n\
         embate remesh run --part block --mesh other.msh --at '5 us'\n",
    ),
    cause: "`embate remesh` continues a run with a mesh of a part that the user has made. That must be a mesh of the part in its present \
        form and place, in the unit of --scale, of elements that the state can go over to.",
    remedy: "Mesh the outline that `embate remesh DIR --part PART --outline FILE` writes. Where elements are inverted or nearly so, take an \
        earlier time with --at.",
};

pub(crate) static FLOW_STATE: Message = Message {
    code: "W0619",
    title: "how steady a flow is",
    example: Example::Model("[[flow]]\npart = \"block\"\n"),
    cause: "A part with `[[flow]]` shows the steady process only when its material, and what that remembers, has passed it.",
    remedy: "Where the state is not steady yet, take a later `end`, with `stop = true` in `[[flow]]` so that no time is lost.",
};

/// One fault of a model: where in the input, what is wrong, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Its kind.
    pub kind: &'static Message,
    /// Path of the key in the input, `part[0].ring.inner` for example; empty for the whole model.
    pub path: String,
    /// What is wrong, with the value.
    pub message: String,
    /// What to do about it; may be empty.
    pub help: String,
    /// Where in the bodies it is, m, for pictures: empty where it is at no place, or that is not known.
    pub places: Vec<[f64; 3]>,
}

impl Fault {
    /// A fault of a kind at `path`.
    pub fn new(kind: &'static Message, path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { kind, path: path.into(), message: message.into(), help: help.into(), places: Vec::new() }
    }

    /// The same at these places, m.
    #[must_use]
    pub fn at<const D: usize>(self, places: impl IntoIterator<Item = [f64; D]>) -> Self {
        Self { places: places.into_iter().map(|place| std::array::from_fn(|d| place.get(d).copied().unwrap_or(0.0))).collect(), ..self }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(f, " ({})", self.help)?;
        }
        Ok(())
    }
}

/// Something of a sound model that the user should know before he trusts its results: the model is accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Its kind.
    pub kind: &'static Message,
    /// Path of the key in the input, as in [`Fault`].
    pub path: String,
    /// What it is, with the value.
    pub message: String,
    /// What follows from it.
    pub consequence: String,
    /// What to do about it.
    pub help: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        write!(f, "{}: {} ({})", self.message, self.consequence, self.help)
    }
}

/// Something of a run that continues, or has ended, that the user should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// Its kind.
    pub kind: &'static Message,
    /// What it is.
    pub text: String,
}

impl Notice {
    /// A notice of a kind.
    pub fn new(kind: &'static Message, text: impl Into<String>) -> Self {
        Self { kind, text: text.into() }
    }
}

impl From<&Warning> for Notice {
    fn from(warning: &Warning) -> Self {
        Self::new(warning.kind, warning.to_string())
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.code, self.text)
    }
}

/// Why a run failed: what, where, when, and what to try.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Error {
    /// The model has faults; nothing was run.
    #[error("the model has {} fault(s): {}", .0.len(), .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Model(Vec<Fault>),
    /// An element turned inside out.
    #[error(
        "element {element} of part \"{part}\" at ({}) turned inside out at time {time:.6e} s, step {step}; \
         refine the mesh there, lower the load or velocity, or check the material's units",
        place(.at)
    )]
    Inverted {
        #[doc = "Part name."]
        part: String,
        #[doc = "Element number within the part."]
        element: usize,
        #[doc = "Centre, m."]
        at: Vec<f64>,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// The stable time step fell below the limit.
    #[error(
        "the stable time step fell to {time_step:.3e} s, below the limit of {limit:.3e} s, at time {time:.6e} s, step {step}; it is governed by \
         {governor}; look at that place in the last written state, or lower run.step_limit"
    )]
    Collapsed {
        #[doc = "Step, s."]
        time_step: f64,
        #[doc = "Limit, s."]
        limit: f64,
        #[doc = "Who governs."]
        governor: String,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// The energy drift exceeded the limit.
    #[error(
        "the energy drift reached {:.2} % of the largest total energy, more than the limit of {:.2} %, at time {time:.6e} s, step {step}; \
         lower run.safety, check contact penalties and initial penetrations, or raise run.energy_limit if the loss is understood",
        100.0 * .drift, 100.0 * .limit
    )]
    EnergyDrift {
        #[doc = "Drift as a fraction."]
        drift: f64,
        #[doc = "Limit as a fraction."]
        limit: f64,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// Nodes of a flow can't go back to their places.
    #[error("nodes of part \"{part}\" can't go back along its flow at time {time:.6e} s, step {step}: {reason}; look at the frame before")]
    Stuck {
        #[doc = "Part name."]
        part: String,
        #[doc = "Why."]
        reason: String,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// Making elements again lost too much energy.
    #[error(
        "making elements of part \"{part}\" again has lost {:.2} % of the largest total energy, more than the limit of {:.2} %, at time {time:.6e} s, \
         step {step}; take a finer size, or raise remesh.loss_limit if the loss is understood",
        100.0 * .lost, 100.0 * .limit
    )]
    RemeshLoss {
        #[doc = "Part name."]
        part: String,
        #[doc = "Energy lost, as a fraction."]
        lost: f64,
        #[doc = "Limit as a fraction."]
        limit: f64,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// A contact is deeper than its limit.
    #[error(
        "{contact} is {depth:.3e} m deep at {place}, more than the limit of {limit:.3e} m, at time {time:.6e} s, step {step}; \
         raise its penalty, or take the law \"multiplier\"; raise run.penetration_limit if so much depth is meant"
    )]
    TooDeep {
        #[doc = "Which contact or obstacle, in words."]
        contact: Box<str>,
        #[doc = "Node and its coordinates."]
        place: Box<str>,
        #[doc = "Depth, m."]
        depth: f64,
        #[doc = "Limit, m."]
        limit: f64,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// A node is faster than its limit.
    #[error(
        "{place} runs at {speed:.3e} m/s, more than the limit of {limit:.3e} m/s, at time {time:.6e} s, step {step}; \
         check the units of loads and velocities, and what holds it; raise run.velocity_limit if such speeds are meant"
    )]
    Runaway {
        #[doc = "Node and its coordinates."]
        place: String,
        #[doc = "Speed, m/s."]
        speed: f64,
        #[doc = "Limit, m/s."]
        limit: f64,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// A number stopped being finite.
    #[error("{what} is no longer a finite number at time {time:.6e} s, step {step}; {place}; check material parameters, loads and units")]
    NotFinite {
        #[doc = "Which quantity."]
        what: String,
        #[doc = "Node or element and its coordinates."]
        place: String,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// The volume of a cavity is gone.
    #[error(
        "cavity \"{cavity}\" has a volume of {volume:.3e} m³ (in 2D m³/m) at time {time:.6e} s, step {step}: its surface turned inside out; \
         give it a contact with itself, or a smaller run.time_step"
    )]
    Squeezed {
        #[doc = "Its name."]
        cavity: Box<str>,
        #[doc = "Volume, m³ (in 2D m³/m)."]
        volume: f64,
        #[doc = "Time, s."]
        time: f64,
        #[doc = "Step number."]
        step: u64,
    },
    /// A kept state is not one of the model.
    #[error("the kept state does not fit the model: {0}; it was written by another version of embate, or it is damaged")]
    State(String),
    /// The observer could not take a result.
    #[error("results can't be written: {0}")]
    Output(String),
}

impl Error {
    /// Whether it was found when the step was complete: its forces are known, and its energies are in the
    /// ledger.
    pub(crate) fn is_of_complete_step(&self) -> bool {
        matches!(self, Self::EnergyDrift { .. } | Self::TooDeep { .. } | Self::Runaway { .. })
    }

    /// Its kind; `None` for a model, whose faults are of many.
    #[must_use]
    pub fn kind(&self) -> Option<&'static Message> {
        match self {
            Self::Model(_) => None,
            Self::Inverted { .. } => Some(&INVERTED),
            Self::Collapsed { .. } => Some(&COLLAPSED),
            Self::EnergyDrift { .. } => Some(&ENERGY_DRIFT),
            Self::RemeshLoss { .. } => Some(&REMESH_ENERGY),
            Self::Stuck { .. } => Some(&STUCK),
            Self::NotFinite { .. } => Some(&NOT_FINITE),
            Self::TooDeep { .. } => Some(&TOO_DEEP),
            Self::Runaway { .. } => Some(&RUNAWAY),
            Self::Squeezed { .. } => Some(&SQUEEZED),
            Self::State(_) => Some(&STATE),
            Self::Output(_) => Some(&OUTPUT),
        }
    }

    /// As files have it: its code, a colon, what it is; of a model the first fault.
    #[must_use]
    pub fn with_code(&self) -> String {
        match (self, self.kind()) {
            (_, Some(kind)) => format!("{}: {self}", kind.code),
            (Self::Model(faults), _) if !faults.is_empty() => {
                let Fault { kind, path, message, .. } = &faults[0];
                format!("{}: {path}: {message}", kind.code)
            }
            _ => self.to_string(),
        }
    }
}

impl From<ArchiveError> for Error {
    fn from(ArchiveError(what): ArchiveError) -> Self {
        Self::State(what.into())
    }
}

fn place(at: &[f64]) -> String {
    at.iter().map(|x| format!("{x:.6e}")).collect::<Vec<_>>().join(", ")
}
