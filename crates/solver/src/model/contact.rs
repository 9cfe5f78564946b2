//! Contacts of a [`super::Model`]: formulations, laws, friction, what touches what; and the keys that they
//! share with obstacles, described once.
//!
//! Values come from the model file, checked by `input`; contacts are made of them by
//! [`crate::build`].

use super::load::window;
use super::stage::STAGES;
use super::values::LeftOut;
use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, NotNegative, Positive};
use crate::vocabulary::Kind::{Choice, Flag, Name, Quantities, Quantity, Reference, References, Stiffness};
use crate::vocabulary::Need::{Default as Written, Optional};
use crate::vocabulary::{Choices, Form, Group, Rule, Section, key};

/// What a contact makes of its surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formulation {
    /// Nodes against segments; each surface is slave once and target once in every force evaluation.
    #[default]
    DoublePass,
    /// Nodes against segments; only the nodes of `slave` (0 or 1: index into the two surfaces) are checked
    /// against the other surface.
    SinglePass {
        /// Index of the slave surface.
        slave: usize,
    },
    /// Segments against segments, in 3D facets against facets, integrated over their common part.
    Segment,
    /// Disks in the elements under the surfaces against each other (Belytschko and Neal 1991).
    Pinball,
}

impl Formulation {
    /// Name in the model file and in [`crate::contact::formulation::FORMULATIONS`].
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::DoublePass => "double_pass",
            Self::SinglePass { .. } => "single_pass",
            Self::Segment => "segment",
            Self::Pinball => "pinball",
        }
    }
}

/// What an automatic penalty is made from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PenaltySource {
    /// Modulus of plane waves K + 4µ/3 over the height of the element under the surface.
    #[default]
    WaveModulus,
    /// Bulk modulus over the height of the element under the surface.
    BulkModulus,
    /// Mass over the square of the first stable step.
    TimeStep,
}

/// How stiff a penalty contact is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Penalty {
    /// `scale` times what `source` says.
    Automatic {
        /// Where it comes from.
        source: PenaltySource,
        /// Factor, 1 by default.
        scale: f64,
    },
    /// Stiffness per slave node and metre of depth, N/m/m = Pa (the paper's k_n).
    PerNode(f64),
    /// Pressure per penetration, Pa/m; a node has its tributary length's share.
    Pressure(f64),
}

impl Penalty {
    /// `scale` times the stiffness of the elements under the surface.
    #[must_use]
    pub fn automatic(scale: f64) -> Self {
        Self::Automatic { source: PenaltySource::default(), scale }
    }
}

impl Default for Penalty {
    fn default() -> Self {
        Self::automatic(1.0)
    }
}

/// What keeps the surfaces apart.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactLaw {
    /// A force proportional to the penetration.
    Penalty(Penalty),
    /// A pressure as a function of the gap.
    PressureGap {
        /// Gaps, m, strictly ascending; negative is penetration.
        gaps: Vec<f64>,
        /// Pressures, Pa, descending to zero at the last gap.
        pressures: Vec<f64>,
    },
    /// Whatever force it takes to have no penetration at the end of the step.
    Multiplier,
}

impl Default for ContactLaw {
    fn default() -> Self {
        Self::Penalty(Penalty::default())
    }
}

/// Coulomb friction: |τ| ≤ min(µ(v) p + c v, τ_max) at slip rate v, µ(v) = µ_d + (µ_s − µ_d) exp(−β v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// µ_s.
    pub coefficient: f64,
    /// µ_d; `None`: as the static one.
    pub dynamic: Option<f64>,
    /// β, s/m.
    pub decay: f64,
    /// c, Pa s/m.
    pub viscosity: f64,
    /// τ_max, Pa; infinite: none.
    pub limit: f64,
}

/// What is done with penetrations at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InitialPenetration {
    /// The model is refused.
    #[default]
    Error,
    /// The gap at the start counts as zero until the surfaces part.
    Ignore,
    /// Nodes are moved to the surface before anything is strained.
    PushOut,
}

/// What happens between two surfaces, whatever they belong to.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Normal law.
    pub law: ContactLaw,
    /// Viscous damping of closed contacts, fraction of critical.
    pub damping: f64,
    /// Friction; `None`: none.
    pub friction: Option<Friction>,
    /// Penetrations at the start.
    pub initial_penetration: InitialPenetration,
    /// Distance that the surfaces keep, m.
    pub thickness: f64,
    /// Times between which it acts, s.
    pub active: [f64; 2],
    /// Stages in which it acts; empty: all.
    pub stages: Vec<String>,
}

/// What happens between surfaces, of any body.
pub(crate) static INTERFACE: Group = Group {
    title: "Where surfaces meet",
    doc: "Keys of contacts and of obstacles alike. Friction is at most min(µ p + c v, τ) at pressure p and slip rate \
        v, with µ = µ_d + (µ_s - µ_d) exp(-β v).",
    keys: &[
        key(
            "law",
            Choice(Choices::ContactLaws),
            Written("\"penalty\""),
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
            Written("0"),
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
            Written("\"error\""),
            "What is done with penetrations at the start: the model is refused, the gap counts as zero, or nodes are moved to the surface.",
        ),
        key("thickness", Quantity(Dimension::LENGTH, NotNegative), Written("0"), "Distance that the surfaces keep."),
        key("birth", Quantity(Dimension::TIME, NotNegative), Written("0"), "Time from which it acts."),
        key("death", Quantity(Dimension::TIME, Positive), Optional("the end"), "Time until which it acts."),
        STAGES,
    ],
    rules: &[
        Rule::NotBoth("stages", "birth"),
        Rule::NotBoth("stages", "death"),
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

impl Interface {
    /// From the table of a contact or an obstacle.
    #[must_use]
    pub fn read(values: &dyn Values) -> Self {
        Self {
            law: ContactLaw::read(values),
            damping: values.get("damping"),
            friction: values.has("friction").then(|| Friction::read(values)),
            initial_penetration: match values.get::<String>("initial_penetration").as_str() {
                "ignore" => InitialPenetration::Ignore,
                "push_out" => InitialPenetration::PushOut,
                _ => InitialPenetration::Error,
            },
            thickness: values.get("thickness"),
            active: window(values, ["birth", "death"]),
            stages: values.get("stages"),
        }
    }
}

impl ContactLaw {
    fn read(values: &dyn Values) -> Self {
        match values.get::<String>("law").as_str() {
            "pressure_gap" => Self::PressureGap { gaps: values.get("gaps"), pressures: values.get("pressures") },
            "multiplier" => Self::Multiplier,
            _ => Self::Penalty(values.get::<Option<Penalty>>("penalty").unwrap_or_else(|| Penalty::Automatic {
                source: match values.get::<String>("penalty_from").as_str() {
                    "bulk_modulus" => PenaltySource::BulkModulus,
                    "time_step" => PenaltySource::TimeStep,
                    _ => PenaltySource::WaveModulus,
                },
                scale: values.get::<Option<f64>>("penalty_scale").unwrap_or(1.0),
            })),
        }
    }
}

impl Friction {
    fn read(values: &dyn Values) -> Self {
        let or = |key, left_out| values.get::<Option<f64>>(key).unwrap_or(left_out);
        Self {
            coefficient: values.get("friction"),
            dynamic: values.get("friction_dynamic"),
            decay: or("friction_decay", 0.0),
            viscosity: or("friction_viscosity", 0.0),
            limit: or("friction_limit", f64::INFINITY),
        }
    }
}

impl Default for Interface {
    fn default() -> Self {
        Self::read(&LeftOut::of(INTERFACE.keys))
    }
}

impl From<Penalty> for Interface {
    /// A penalty contact without anything else.
    fn from(penalty: Penalty) -> Self {
        Self { law: ContactLaw::Penalty(penalty), ..Self::default() }
    }
}

/// Who meets whom in a contact.
#[derive(Clone, Debug, PartialEq)]
pub enum Partners {
    /// Two surfaces: each a part (its whole outside), `part.side`, or a one-dimensional group of a mesh file.
    Between([String; 2]),
    /// The outside of these parts (empty: of all), each against each and against itself.
    Bodies(Vec<String>),
}

impl Partners {
    fn read(values: &dyn Values) -> Self {
        if !values.has("bodies") || values.has("between") {
            return Self::Between(values.get("between"));
        }
        // Faulty names: one that no other contact has.
        let names = values.get::<Option<Vec<String>>>("bodies").unwrap_or_else(|| vec![String::new()]);
        Self::Bodies(if names == ["all"] { Vec::new() } else { names })
    }
}

impl Default for Partners {
    fn default() -> Self {
        Self::Between(Default::default())
    }
}

section! {
    /// `[[contact]]`: surfaces that can't go through each other.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Contact in CONTACT = Section {
        name: "contact",
        doc: "Bodies that can't go through each other: two surfaces, or several bodies, each of which meets each other \
            and itself. A surface is a part (its whole outside), a side such as `plate.top`, or a group of lines (in 3D \
            of surfaces) of a mesh file, which of shells is the face that it looks from: in 3D where its cells run counter-clockwise, in 2D \
            the left of its lines.",
        form: Form::Repeated,
        groups: &[&INTERFACE],
        rules: &[Rule::OneOf(&["between", "bodies"]), Rule::Needs("pairs", "bodies"), Rule::Only { keys: &["tie_strength"], by: "tied", value: "true" }],
        ..Section::EMPTY
    };
    name: String = Name, Optional("the names of the surfaces or parts joined by `-`, or `all`"), "Unique name.";
    "between" = References(Some(2)), Optional("`bodies`"), "The two surfaces.";
    "bodies" = References(None), Optional("`between`"),
        "Parts that meet each other and themselves; `\"all\"` for all parts.";
    "formulation" = Choice(Choices::Formulations), Default("\"double_pass\""),
        "What is checked: the nodes of each surface against the segments of the other, only the nodes of \
            `slave`, segments against segments, or disks in the elements. In 3D nodes meet facets, in a double \
            pass also edges edges; segments are facets, and the elements have balls.";
    "slave" = Reference, Optional("needed for, and only for, `single_pass`"),
        "The surface of `between` whose nodes are checked.";
    "tied" = Flag, Default("false"), "Whether what touches at the start stays together: nodes of one surface on segments or facets of the other, with \
            `segment` both surfaces over what they have in common.";
    "tie_strength" = Quantity(Dimension::PRESSURE, Positive), Optional("it never breaks"),
        "Traction above which a tie breaks.";
    pairs: Option<bool> = Flag, Optional("up to four bodies"),
        "Whether the history has the forces of `bodies` by pair, as `contact.force_x[NAME:ONE-OTHER]`: of the second on the first.";
    search: String = Choice(Choices::Searches), Optional("`grid`"), "How near pairs are found; changes no result.";
    /// The surfaces.
    partners: Partners, read Partners::read;
    /// Nodes, segments or pinballs; the reader of the file knows which surface is the slave.
    formulation: Formulation, read |_| Formulation::default();
    /// Law, friction and so on.
    interface: Interface, read Interface::read;
    /// `Some`: what touches at the start stays together until the traction (Pa) exceeds this.
    tied: Option<f64>,
        read |values| values.get::<bool>("tied").then(|| values.get::<Option<f64>>("tie_strength").unwrap_or(f64::INFINITY));
}

impl Contact {
    /// A penalty contact between two surfaces, everything else by default.
    #[must_use]
    pub fn between(name: &str, first: &str, second: &str) -> Self {
        Self { name: name.into(), partners: Partners::Between([first.into(), second.into()]), ..Self::default() }
    }
}
