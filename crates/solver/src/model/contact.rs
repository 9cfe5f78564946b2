//! Contacts and obstacles of a [`super::Model`]: formulations, laws, friction, what touches what.
//!
//! Values come from the model file, checked by `input`; contacts are made of them by
//! [`crate::build`].

use super::in_3d;
use super::motion::Motion;
use super::triangles::TriangleSurface;
use std::sync::Arc;

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
    /// Segments against segments, integrated over their common part.
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
}

impl Default for Interface {
    fn default() -> Self {
        Self {
            law: ContactLaw::default(),
            damping: 0.0,
            friction: None,
            initial_penetration: InitialPenetration::default(),
            thickness: 0.0,
            active: [0.0, f64::INFINITY],
        }
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

impl Default for Partners {
    fn default() -> Self {
        Self::Between(Default::default())
    }
}

/// `[[contact]]`: surfaces that can't go through each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contact {
    /// Unique name.
    pub name: String,
    /// The surfaces.
    pub partners: Partners,
    /// Nodes, segments or pinballs.
    pub formulation: Formulation,
    /// Law, friction and so on.
    pub interface: Interface,
    /// `Some`: what touches at the start stays together until the traction (Pa) exceeds this.
    pub tied: Option<f64>,
    /// Name in the search registry; empty: `grid`.
    pub search: String,
}

impl Contact {
    /// A penalty contact between two surfaces, everything else by default.
    #[must_use]
    pub fn between(name: &str, first: &str, second: &str) -> Self {
        Self { name: name.into(), partners: Partners::Between([first.into(), second.into()]), ..Self::default() }
    }
}

/// Shape of a rigid obstacle. Its free side is where the normal points.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleShape {
    /// A straight line; in 3D a plane without end.
    Plane {
        /// A point of the line, m; its middle where it has a length.
        point: [f64; 3],
        /// Normal that points to the free side; any length.
        normal: [f64; 3],
        /// Length, m; infinite without.
        length: Option<f64>,
    },
    /// A circle.
    Circle {
        /// Centre, m.
        centre: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Whether bodies are inside of it.
        hollow: bool,
    },
    /// In 3D: a sphere.
    Sphere {
        /// Centre, m.
        centre: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Whether bodies are inside of it.
        hollow: bool,
    },
    /// In 3D: a cylinder without ends.
    Cylinder {
        /// A point of its axis, m.
        point: [f64; 3],
        /// Direction of the axis; any length.
        axis: [f64; 3],
        /// Radius, m.
        radius: f64,
        /// Whether bodies are inside of it.
        hollow: bool,
    },
    /// Straight lines from point to point, the obstacle on their right.
    Polyline {
        /// Points, m; the first once more at the end: closed.
        points: Vec<[f64; 2]>,
    },
    /// In 3D: triangles, counter-clockwise seen from the side on which bodies are.
    Triangles(Arc<TriangleSurface>),
}

/// `[[obstacle]]`: a rigid body without elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Unique name.
    pub name: String,
    /// Parts that can't cross it; empty: all.
    pub parts: Vec<String>,
    /// Shape.
    pub shape: ObstacleShape,
    /// How it moves.
    pub motion: Motion,
    /// Reference point of rotation and moments, m; `None`: the plane's point, the circle's centre, the mean
    /// of the polyline's points, the middle of the box around triangles.
    pub reference: Option<[f64; 3]>,
    /// Mass per metre of depth, kg/m; needed where it is free to move.
    pub mass: Option<f64>,
    /// Moment of inertia about the reference point per metre of depth, kg m; needed where it is free to turn.
    pub inertia: Option<f64>,
    /// Initial velocity where it is free, m/s.
    pub velocity: [f64; 3],
    /// Initial spin where it is free, rad/s.
    pub spin: f64,
    /// Law, friction and so on.
    pub interface: Interface,
}

impl Obstacle {
    /// A fixed plane without end that stops all parts; `normal` points to the free side. Vectors have two or
    /// three components.
    #[must_use]
    pub fn wall<const D: usize>(name: &str, point: [f64; D], normal: [f64; D]) -> Self {
        Self::fixed(name, ObstacleShape::Plane { point: in_3d(point), normal: in_3d(normal), length: None })
    }

    /// A fixed obstacle that stops all parts.
    #[must_use]
    pub fn fixed(name: &str, shape: ObstacleShape) -> Self {
        Self {
            name: name.into(),
            parts: Vec::new(),
            shape,
            motion: Motion::fixed(),
            reference: None,
            mass: None,
            inertia: None,
            velocity: [0.0; 3],
            spin: 0.0,
            interface: Interface::default(),
        }
    }
}
