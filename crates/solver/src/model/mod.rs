//! The model: what the user wrote, as plain data in SI units. It comes from a model file or from code and
//! goes to the mesh builder.
//!
//! Nothing here is checked on construction: [`Model::check`] returns *all* faults, each with its path in the
//! input.

pub mod messages;
mod contact;
mod discrete;
mod initial;
mod load;
mod motion;
pub(crate) mod placement;
pub mod reference;
mod triangles;

pub use contact::{
    Contact, ContactLaw, Formulation, Friction, InitialPenetration, Interface, Obstacle, ObstacleShape, Partners, Penalty, PenaltySource,
};
pub use discrete::{PointMass, Spring};
pub use initial::InitialStress;
pub use load::{Axis, Constraint, Image, Join, Load, NonReflecting, Rotation, Symmetry};
pub use motion::{Curve, CurveShape, Drive, Motion, Sine};
pub use placement::{Copies, Mirror, Placement};
pub use triangles::TriangleSurface;

pub use crate::mesh::shapes::{
    Cuboid, Cylinder, Disk, Edge, Extrude, Path, Polygon, Quadrilateral, Rectangle, Revolve, Ring, Shape, SpaceTruss, Sphere, Sweep,
    Trapezoid, Truss, Tube,
};
use crate::stress_state::STRESS_STATES;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A vector in 2D or 3D as the model keeps it: with three components, of which those that it
/// lacks are zero (nothing, where they are prescribed).
#[must_use]
pub fn in_3d<T: Default, const D: usize>(vector: [T; D]) -> [T; 3] {
    let mut components = vector.into_iter();
    std::array::from_fn(|_| components.next().unwrap_or_default())
}

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
    /// Speed of a node (m/s) above which the run stops; `None`: [`crate::step::RUNAWAY`] times the fastest
    /// wave and the fastest node at the start together.
    pub velocity_limit: Option<f64>,
    /// Depth of a contact (m) at which the run stops; `None`: the longest segment of the surfaces.
    pub penetration_limit: Option<f64>,
    /// Memory (bytes) that the model may need; `None`: no limit.
    pub memory_limit: Option<f64>,
    /// Largest time step (s), and that of a model of rigid parts alone; `None`: what the elements need, also
    /// those of rigid parts if there are no others.
    pub time_step: Option<f64>,
    /// Largest number of steps; `None`: no limit.
    pub max_steps: Option<u64>,
    /// Linear and quadratic coefficient of the bulk viscosity; both zero: none.
    pub bulk_viscosity: [f64; 2],
    /// Mass that is added for a longer step.
    pub mass_scaling: Option<MassScaling>,
    /// Damping that brings everything to rest.
    pub relaxation: Option<Relaxation>,
    /// Wall time (s) between two checkpoints; `None`: none by the clock.
    pub checkpoint: Option<f64>,
    /// Steps between two checkpoints; `None`: none by number.
    pub checkpoint_steps: Option<u64>,
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
    /// 2 in 2D, 3 in 3D: what its first part is whose mesh is there; the check finds models with
    /// parts of both kinds.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.parts.iter().find(|part| !self.lacks_mesh(part)).map_or(2, |part| self.dimension_of(part))
    }

    /// Whether the mesh file of a part is not there, so that no one knows its dimension.
    pub(crate) fn lacks_mesh(&self, part: &Part) -> bool {
        matches!(part.shape, Shape::Group { mesh, .. } if part.sweep.is_none() && mesh >= self.meshes.len())
    }

    /// Dimension of a part: of a group of a mesh file that of the file, unless it is swept.
    #[must_use]
    pub fn dimension_of(&self, part: &Part) -> usize {
        match &part.shape {
            Shape::Group { mesh, .. } if part.sweep.is_none() => self.meshes.get(*mesh).map_or(2, |imported| imported.dimension()),
            _ => part.dimension(),
        }
    }
}

impl ImportedMesh {
    /// 3 where it has volumes or nodes outside of the plane z = 0, else 2.
    #[must_use]
    pub fn dimension(&self) -> usize {
        let is_of_3d = self.groups.iter().any(|group| group.dimension == 3) || self.positions.iter().any(|x| x[2] != 0.0);
        if is_of_3d { 3 } else { 2 }
    }
}

impl Model {
    /// Whether masses, forces and energies are those of whole bodies (of revolution, or solids), and not per
    /// metre of depth.
    #[must_use]
    pub fn is_of_whole_bodies(&self) -> bool {
        self.is_axisymmetric() || self.dimension() == 3
    }

    /// Whether the model is an axisymmetric body: its parts are all axisymmetric, or none is.
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
            velocity_limit: None,
            penetration_limit: None,
            memory_limit: None,
            time_step: None,
            max_steps: None,
            bulk_viscosity: [0.0; 2],
            mass_scaling: None,
            relaxation: None,
            checkpoint: None,
            checkpoint_steps: None,
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

/// `[[part]]`: a body of one material and one element kind for each kind of cell.
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
    /// Cross-section of its bars, m² (per metre of depth, m²/m); bars need it, and nothing else has it.
    pub area: Option<f64>,
    /// Coefficient of its hourglass control, where it has one; `None`: that of the control's source.
    pub hourglass: Option<f64>,
    /// Name in the registry of stress states; empty: plane strain.
    pub stress_state: String,
    /// Where its elements come from.
    pub shape: Shape,
    /// How a shape in 2D becomes a solid; `None`: it stays in 2D, or is a solid as it is.
    pub sweep: Option<Sweep>,
    /// Where the body of a built-in shape goes.
    pub placement: Placement,
    /// Initial velocity of the centre of mass, m/s.
    pub velocity: [f64; 3],
    /// Initial spin about the centre of mass, rad/s, counter-clockwise (in 3D: about the direction of z).
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
            sweep: None,
            placement: Placement::default(),
            velocity: [0.0; 3],
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
        STRESS_STATES.iter().any(|kind| kind.name == self.stress_state && kind.state.is_axisymmetric)
    }

    /// 3 where it is swept or has a solid shape, else 2; of a group of a mesh file its model knows
    /// ([`Model::dimension_of`]).
    #[must_use]
    pub fn dimension(&self) -> usize {
        if self.sweep.is_some() || self.shape.solid().is_some() { 3 } else { 2 }
    }
}

/// A mesh that came from a file: nodes and named groups of cells. Parts that use the same mesh share its
/// nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportedMesh {
    /// Where it came from, for messages.
    pub source: String,
    /// Node positions, m; z is zero in 2D.
    pub positions: Vec<[f64; 3]>,
    /// Groups by name.
    pub groups: Vec<MeshGroup>,
}

/// A named group of cells of one dimension.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshGroup {
    /// Unique name.
    pub name: String,
    /// 0 points, 1 lines, 2 surfaces, 3 volumes.
    pub dimension: u8,
    /// Node indices of each cell, which with the dimension say of which kind it is. Surfaces run
    /// counter-clockwise or not.
    pub cells: Vec<Vec<u32>>,
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
    /// Steps between two hashes of the state; `None`: none.
    pub hash_steps: Option<u64>,
    /// Names of the fields to write; empty: all.
    pub include: Vec<String>,
    /// Pictures show the mirrored half at x = 0 (the first), at y = 0 and, in 3D, at z = 0.
    pub mirror: [bool; 3],
    /// Whether pictures and the animation are made.
    pub pictures: bool,
    /// Field that colours the pictures; empty: chosen from what the model has.
    pub picture_field: String,
    /// What pictures show; none: the bodies, and obstacles near them.
    pub picture_view: Option<PictureView>,
    /// From where pictures in 3D look; none: so that three sides are seen.
    pub camera: Option<Camera>,
}

/// `output.picture_view`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureView {
    /// Lower left corner, m.
    pub corner: [f64; 2],
    /// Width and height, m.
    pub size: [f64; 2],
}

/// `output.camera`: how pictures look at a model in 3D. Lines that are parallel stay so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Direction from the model to the camera, of any length.
    pub from: [f64; 3],
    /// What is in the middle of the picture, m; none: the middle of all that is seen.
    pub at: Option<[f64; 3]>,
    /// Direction that is upwards in the picture, of any length.
    pub up: [f64; 3],
    /// How many times larger than so that everything is seen.
    pub zoom: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { from: [0.6, -1.0, 0.5], at: None, up: [0.0, 0.0, 1.0], zoom: 1.0 }
    }
}

impl Default for Output {
    fn default() -> Self {
        Self {
            fields: Cadence::Count(100),
            history: Cadence::Count(1000),
            hash_steps: Some(100),
            include: Vec::new(),
            mirror: [false; 3],
            pictures: true,
            picture_field: String::new(),
            picture_view: None,
            camera: None,
        }
    }
}
