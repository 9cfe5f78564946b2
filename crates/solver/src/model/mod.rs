//! What the user wrote, as plain data in SI units. Comes from a model file or from code; goes to the mesh builder.
//!
//! Nothing here is checked on construction: [`Model::check`] returns *all* faults, each with its path in the input.

pub mod check;
pub mod describe;
mod discrete;
mod initial;
mod load;
pub mod reference;

pub use discrete::{PointMass, Spring};
pub use initial::InitialStress;
pub use load::{Constraint, Image, Join, Load, NonReflecting, Rotation, Symmetry};

use crate::block::stress_state::STRESS_STATES;
use crate::element::{BARS, ELEMENTS, ElementKind};
use crate::load::curve::sine::Sine;
pub use crate::mesh::placement::{Copies, Mirror, Placement};
use crate::mesh::shapes::Count;
pub use crate::mesh::shapes::{Disk, Edge, Path, Polygon, Quadrilateral, Rectangle, Ring, Shape, Trapezoid, Truss};
use crate::quantity::Dimension;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A model: bodies, their materials, what acts on them, and what is recorded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Short name: the model folder's or file's name.
    pub name: String,
    /// Title for pictures and reports; the name when empty.
    pub title: String,
    /// `[run]`.
    pub run: Run,
    /// `[material.NAME]`.
    pub materials: BTreeMap<String, Material>,
    /// `[[part]]`.
    pub parts: Vec<Part>,
    /// Mesh files that parts refer to by index, already read.
    pub meshes: Vec<Arc<ImportedMesh>>,
    /// `[[contact]]`.
    pub contacts: Vec<Contact>,
    /// `[[obstacle]]`.
    pub obstacles: Vec<Obstacle>,
    /// `[curve.NAME]`.
    pub curves: BTreeMap<String, Curve>,
    /// `[[symmetry]]`.
    pub symmetries: Vec<Symmetry>,
    /// `[[constraint]]`.
    pub constraints: Vec<Constraint>,
    /// `[[load]]`.
    pub loads: Vec<Load>,
    /// `[[non_reflecting]]`.
    pub non_reflecting: Vec<NonReflecting>,
    /// `[[join]]`.
    pub joins: Vec<Join>,
    /// `[[spring]]`.
    pub springs: Vec<Spring>,
    /// `[[point_mass]]`.
    pub point_masses: Vec<PointMass>,
    /// `[[probe]]`.
    pub probes: Vec<Probe>,
    /// `[output]`.
    pub output: Output,
}

/// `[run]`: how long and how carefully.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// End time, s.
    pub end: f64,
    /// Fraction of the element bound of the stable step, 0 to 1.
    pub safety: f64,
    /// Energy drift at which the run stops, as a fraction of the largest total energy.
    pub energy_limit: f64,
    /// Time step (s) below which the run stops; `None`: a thousandth of the first stable step.
    pub step_limit: Option<f64>,
    /// Largest time step (s), and that of a model of rigid parts alone; `None`: what the elements need, also those of rigid parts if there are no others.
    pub time_step: Option<f64>,
    /// Largest number of steps; `None`: no limit.
    pub max_steps: Option<u64>,
    /// Linear and quadratic coefficient of the bulk viscosity; both zero: none.
    pub bulk_viscosity: [f64; 2],
    /// Mass that is added for a longer step.
    pub mass_scaling: Option<MassScaling>,
    /// Damping that brings everything to rest.
    pub relaxation: Option<Relaxation>,
}

/// Dynamic relaxation: damping that adapts itself, and an end when all is at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    /// Kinetic energy over internal energy at which the state counts as at rest.
    pub tolerance: f64,
    /// Time from which rest ends the run, s: loads must be complete.
    pub from: f64,
}

/// Makes elements with a small stable step heavier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassScaling {
    /// Step that every element shall allow at the start, safety included, s.
    pub time_step: f64,
    /// Largest mass that may be added, as a fraction of the mass of the deformable parts.
    pub limit: f64,
}

impl Model {
    /// Whether the model is a body of revolution: its parts are all axisymmetric, or none is.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        self.parts.iter().any(Part::is_axisymmetric)
    }
}

impl Model {
    /// Time β of the damping of a part in proportion to its stiffness, s: the sum over the loads that say so.
    #[must_use]
    pub fn stiffness_damping(&self, part: &Part) -> f64 {
        let of = |load: &Load| match load {
            Load::StiffnessDamping { parts, time } if parts.is_empty() || parts.contains(&part.name) => *time,
            _ => 0.0,
        };
        self.loads.iter().map(of).sum()
    }
}

impl Default for Run {
    fn default() -> Self {
        Self {
            end: 0.0,
            safety: 0.9,
            energy_limit: 0.05,
            step_limit: None,
            time_step: None,
            max_steps: None,
            bulk_viscosity: [0.0; 2],
            mass_scaling: None,
            relaxation: None,
        }
    }
}

/// `[material.NAME]`: a law of the registry and its parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Name in the material registry.
    pub law: String,
    /// Name in the registry of equations of state; empty: none, the pressure is the law's own.
    pub eos: String,
    /// Parameters by key, SI, `density` included.
    pub parameters: BTreeMap<String, f64>,
    /// Parameters that are lists.
    pub lists: BTreeMap<String, Vec<f64>>,
    /// Limits at which its elements fail and are eroded, by key of the failure registry; empty: never.
    pub failure: BTreeMap<String, f64>,
}

/// `[[part]]`: a body of one material and one element kind for each number of nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unique name.
    pub name: String,
    /// Key of [`Model::materials`].
    pub material: String,
    /// Name in the element registry: what its quadrilaterals are.
    pub element: String,
    /// The same for its triangles, if it has any.
    pub element_triangles: String,
    /// Cross-section of its bars per metre of depth, m²/m; bars need it, and nothing else has it.
    pub area: Option<f64>,
    /// Coefficient of its hourglass control, where it has one; `None`: that of the control's source.
    pub hourglass: Option<f64>,
    /// Name in the registry of stress states; empty: plane strain.
    pub stress_state: String,
    /// Where its elements come from.
    pub shape: Shape,
    /// Where the body of a built-in shape goes.
    pub placement: Placement,
    /// Initial velocity of the centre of mass, m/s.
    pub velocity: [f64; 2],
    /// Initial spin about the centre of mass, rad/s, counter-clockwise.
    pub spin: f64,
    /// Stress at the start; `None`: none.
    pub stress_initial: Option<InitialStress>,
    /// Temperature at the start, K; `None`: that of the material.
    pub temperature_initial: Option<f64>,
    /// `Some`: the part is a rigid body and moves so.
    pub rigid: Option<Motion>,
    /// Factor on its mass where mass resists motion; what it weighs stays.
    pub mass_scale: f64,
}

/// A still `quad4` and `tri3` part of nothing, to build on.
impl Default for Part {
    fn default() -> Self {
        Self {
            name: String::new(),
            material: String::new(),
            element: "quad4".into(),
            element_triangles: "tri3".into(),
            area: None,
            hourglass: None,
            stress_state: String::new(),
            shape: Shape::Group { mesh: usize::MAX, group: String::new() },
            placement: Placement::default(),
            velocity: [0.0; 2],
            spin: 0.0,
            stress_initial: None,
            temperature_initial: None,
            rigid: None,
            mass_scale: 1.0,
        }
    }
}

impl Part {
    /// Whether x is its radius.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        STRESS_STATES.iter().any(|kind| kind.name == self.stress_state && kind.axisymmetric)
    }

    /// Dimension of the cells of a mesh file that it is made of.
    #[must_use]
    pub fn cells_dimension(&self) -> u8 {
        if self.is_of_bars() { 1 } else { 2 }
    }

    /// Whether it consists of bars: lines without a surface.
    #[must_use]
    pub fn is_of_bars(&self) -> bool {
        BARS.iter().any(|kind| kind.name == self.element)
    }

    /// How large its mesh will be, where it has a built-in shape.
    #[must_use]
    pub fn count(&self) -> Option<Count> {
        Some(self.shape.count()?.times(self.placement.copies.map_or(1, |copies| copies.count)))
    }

    /// The element that has so many nodes; `None` when the part names none.
    #[must_use]
    pub fn element_of(&self, nodes: usize) -> Option<&'static ElementKind> {
        ELEMENTS.iter().chain(BARS).find(|kind| kind.nodes == nodes && (kind.name == self.element || kind.name == self.element_triangles))
    }
}

/// How a rigid body may move: per degree of freedom driven (zero is fixed), or free (`None`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Velocity of its centre of mass (of an obstacle: of its reference point), m/s.
    pub velocity: [Option<Drive>; 2],
    /// Angular velocity, rad/s, counter-clockwise.
    pub spin: Option<Drive>,
}

impl Motion {
    /// No motion at all.
    #[must_use]
    pub fn fixed() -> Self {
        Self { velocity: [Some(Drive::Constant(0.0)), Some(Drive::Constant(0.0))], spin: Some(Drive::Constant(0.0)) }
    }
}

/// A prescribed velocity, m/s (or rad/s).
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// The same at all times.
    Constant(f64),
    /// Key of [`Model::curves`].
    Curve(String),
}

impl From<f64> for Drive {
    fn from(velocity: f64) -> Self {
        Self::Constant(velocity)
    }
}

/// `[curve.NAME]`: a function of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// What it looks like.
    pub shape: CurveShape,
    /// Dimension of the values as they were written; `None`: bare numbers, SI of whatever uses them.
    pub dimension: Option<Dimension>,
}

impl Curve {
    /// Straight lines between points, of bare numbers.
    #[must_use]
    pub fn table(times: Vec<f64>, values: Vec<f64>) -> Self {
        Self { shape: CurveShape::Table { times, values, smooth: false }, dimension: None }
    }
}

/// The shape of a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum CurveShape {
    /// Through points; constant before the first and after the last.
    Table {
        /// Times, s, strictly ascending.
        times: Vec<f64>,
        /// Values, SI.
        values: Vec<f64>,
        /// Whether smooth steps lead from point to point; else straight lines.
        smooth: bool,
    },
    /// A wave.
    Sine(Sine),
    /// A formula of the time `t`: see [`crate::load::curve::expression`].
    Expression(String),
}

impl Default for CurveShape {
    fn default() -> Self {
        Self::Table { times: Vec::new(), values: Vec::new(), smooth: false }
    }
}

/// A mesh that came from a file: plane nodes and named groups of cells. Parts that use the same mesh share its nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportedMesh {
    /// Where it came from, for messages.
    pub source: String,
    /// Node positions, m.
    pub positions: Vec<[f64; 2]>,
    /// Groups by name.
    pub groups: Vec<MeshGroup>,
}

/// A named group of cells of one dimension.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshGroup {
    /// Unique name.
    pub name: String,
    /// 0 points, 1 lines, 2 surfaces.
    pub dimension: u8,
    /// Node indices of each cell: 1 for a point, 2 for a line, 3 for a triangle, 4 for a quadrilateral (counter-clockwise or not).
    pub cells: Vec<Vec<u32>>,
}

/// What a contact makes of its surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formulation {
    /// Nodes against segments; each surface is slave once and target once in every force evaluation.
    #[default]
    DoublePass,
    /// Nodes against segments; only the nodes of `slave` (0 or 1: index into the two surfaces) are checked against the other surface.
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
    /// A straight line.
    Plane {
        /// A point of the line, m; its middle where it has a length.
        point: [f64; 2],
        /// Normal that points to the free side; any length.
        normal: [f64; 2],
        /// Length, m; infinite without.
        length: Option<f64>,
    },
    /// A circle.
    Circle {
        /// Centre, m.
        centre: [f64; 2],
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
    /// Reference point of rotation and moments, m; `None`: the plane's point, the circle's centre, the mean of the polyline's points.
    pub reference: Option<[f64; 2]>,
    /// Mass per metre of depth, kg/m; needed where it is free to move.
    pub mass: Option<f64>,
    /// Moment of inertia about the reference point per metre of depth, kg m; needed where it is free to turn.
    pub inertia: Option<f64>,
    /// Initial velocity where it is free, m/s.
    pub velocity: [f64; 2],
    /// Initial spin where it is free, rad/s.
    pub spin: f64,
    /// Law, friction and so on.
    pub interface: Interface,
}

impl Obstacle {
    /// A fixed plane without end that stops all parts; `normal` points to the free side.
    #[must_use]
    pub fn wall(name: &str, point: [f64; 2], normal: [f64; 2]) -> Self {
        Self::fixed(name, ObstacleShape::Plane { point, normal, length: None })
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
            velocity: [0.0; 2],
            spin: 0.0,
            interface: Interface::default(),
        }
    }
}

/// `[[probe]]`: what is recorded in the history.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Unique name; the columns are `NAME.x`, `NAME.y`, `NAME.vx`, `NAME.vy`.
    pub name: String,
    /// Where.
    pub at: ProbeAt,
}

/// Where a probe sits.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbeAt {
    /// The node of `part` nearest to `point` at the start.
    Point {
        /// Part name.
        part: String,
        /// Initial position, m.
        point: [f64; 2],
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

/// How often something is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cadence {
    /// So many equal intervals over the run.
    Count(u64),
    /// Every so many seconds.
    Interval(f64),
}

/// `[output]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Field files (and picture frames).
    pub fields: Cadence,
    /// Rows of the history.
    pub history: Cadence,
    /// Names of the fields to write; empty: all.
    pub include: Vec<String>,
    /// Pictures show the mirrored half at x = 0 (`[true, _]`) and at y = 0 (`[_, true]`).
    pub mirror: [bool; 2],
    /// Whether pictures and the animation are made.
    pub pictures: bool,
    /// Field that colours the pictures; empty: chosen from what the model has.
    pub picture_field: String,
    /// What pictures show; none: the bodies, and obstacles near them.
    pub picture_view: Option<PictureView>,
}

/// `output.picture_view`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureView {
    /// Lower left corner, m.
    pub corner: [f64; 2],
    /// Width and height, m.
    pub size: [f64; 2],
}

impl Default for Output {
    fn default() -> Self {
        Self {
            fields: Cadence::Count(100),
            history: Cadence::Count(1000),
            include: Vec::new(),
            mirror: [false, false],
            pictures: true,
            picture_field: String::new(),
            picture_view: None,
        }
    }
}
