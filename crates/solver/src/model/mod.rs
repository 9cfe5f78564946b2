//! The model: what the user wrote, as plain data in SI units. It comes from a model file or from code and
//! goes to the mesh builder.
//!
//! Each section of the model file is one text (`section.rs`): the struct, the description of its keys and how
//! they are read. Nothing here is checked on construction: [`Model::check`] returns *all* faults, each with
//! its path in the input.

mod section;
pub mod values;
pub mod messages;
mod cavity;
mod connection;
mod contact;
mod discrete;
mod initial;
mod load;
mod motion;
mod obstacle;
mod output;
mod part;
pub(crate) mod placement;
mod profile;
pub mod reference;
mod remesh;
mod run;
mod sharing;
mod shell;
mod stage;
mod triangles;
mod window;

pub use cavity::{Cavity, Inflow, Vent};
pub use connection::{EXPONENT, Joint, KINDS, Weld};
pub use contact::{Contact, ContactLaw, Formulation, Friction, InitialPenetration, Interface, Partners, Penalty, PenaltySource};
pub use discrete::{PointMass, Spring};
pub use initial::{InitialStress, RadialVelocity};
pub use load::{Axis, Constraint, Image, Join, Load, LoadTerms, NonReflecting, Rotation, Symmetry};
pub use motion::{Curve, CurveShape, Drive, Motion, Sine};
pub use obstacle::{Obstacle, ObstacleShape};
pub use output::{Cadence, Camera, Channel, Cut, Extreme, Filter, Forces, Output, PictureView, Position, Probe, ProbeAt, ProbeKind};
pub use part::Part;
pub use placement::{Copies, Mirror, Placement};
pub use profile::{BOX, GIVEN, I, PROFILES, Profile, RECTANGLE, ROUND, TUBE};
pub(crate) use profile::{PROFILE, beam_axes};
pub use remesh::{Flow, Relocate, Remesh};
pub use run::{MassScaling, Relaxation, Run, StableStep};
pub(crate) use shell::SHELL_SECTION;
pub use shell::{GAUSS, LOBATTO, LOWER, MIDDLE, ShellLayer, ShellSection, UPPER};
pub(crate) use stage::STAGE;
pub use stage::Stage;
pub use triangles::TriangleSurface;
pub use values::Values;
pub use window::Window;

pub(crate) use crate::mesh::shapes::SHAPES;
pub(crate) use crate::mesh::shapes::sweep::{EXTRUDE, REVOLVE};
pub use crate::mesh::shapes::{
    CircularArc, Cuboid, Cylinder, Disk, Edge, Extrude, Line, Path, Polygon, Quadrilateral, Rectangle, Revolve, Ring, Shape, SpaceTruss,
    Sphere, Sweep, Trapezoid, Truss, Tube,
};
pub(crate) use cavity::CAVITY;
pub(crate) use connection::{JOINT, WELD};
pub(crate) use contact::CONTACT;
pub(crate) use discrete::{POINT_MASS, SPRING};
pub(crate) use load::{CONSTRAINT, JOIN, LOAD, NON_REFLECTING, SYMMETRY};
pub(crate) use motion::CURVE;
pub(crate) use obstacle::OBSTACLE;
pub(crate) use output::{CHANNEL, CUT, OUTPUT, PROBE};
pub(crate) use part::PART;
pub(crate) use remesh::{FLOW, RELOCATE, REMESH, Rule};
pub(crate) use run::RUN;
pub(crate) use section::section;
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
    /// `[run]`; with stages its end is the sum of their durations.
    pub run: Run,
    /// `[[stage]]`.
    pub stages: Vec<Stage>,
    /// `[[remesh]]`.
    pub remeshes: Vec<Remesh>,
    /// `[[relocate]]`.
    pub relocations: Vec<Relocate>,
    /// `[[flow]]`.
    pub flows: Vec<Flow>,
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
    /// Names and stages of the loads; what is left out has none.
    pub load_terms: Vec<LoadTerms>,
    /// `[[cavity]]`.
    pub cavities: Vec<Cavity>,
    /// `[[non_reflecting]]`.
    pub non_reflecting: Vec<NonReflecting>,
    /// `[[join]]`.
    pub joins: Vec<Join>,
    /// `[[weld]]`.
    pub welds: Vec<Weld>,
    /// `[[joint]]`.
    pub joints: Vec<Joint>,
    /// `[[spring]]`.
    pub springs: Vec<Spring>,
    /// `[[point_mass]]`.
    pub point_masses: Vec<PointMass>,
    /// `[[probe]]`.
    pub probes: Vec<Probe>,
    /// `[[cut]]`.
    pub cuts: Vec<Cut>,
    /// `[[channel]]`.
    pub channels: Vec<Channel>,
    /// `[output]`.
    pub output: Output,
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

    /// Dimension of a part: of a group of a mesh file that of the file, unless it is swept, or of beams.
    #[must_use]
    pub fn dimension_of(&self, part: &Part) -> usize {
        match &part.shape {
            Shape::Group { mesh, .. } if part.sweep.is_none() && !part.is_of_sheets() && !part.is_of_beams() => {
                self.meshes.get(*mesh).map_or(2, |imported| imported.dimension())
            }
            _ => part.dimension(),
        }
    }

    /// Dimension of a mesh file: 3 also where a part is made of its surfaces as shells in 3D, or of its lines
    /// as beams.
    pub(crate) fn dimension_of_mesh(&self, mesh: usize) -> usize {
        let is_sheet =
            |part: &Part| part.sweep.is_none() && (part.is_of_sheets() || part.is_of_beams()) && part.shape.group_of(mesh).is_some();
        if self.parts.iter().any(is_sheet) { 3 } else { self.meshes.get(mesh).map_or(2, |imported| imported.dimension()) }
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

/// `[material.NAME]`: a law of the registry and its parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Name in the library of materials of that which its values began with; empty: none.
    pub from: String,
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

/// A mesh that came from a file: nodes and named groups of cells. Parts that use the same mesh in the same
/// place share its nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportedMesh {
    /// Where it came from, for messages.
    pub source: String,
    /// Node positions, m; z is zero in 2D.
    pub positions: Vec<[f64; 3]>,
    /// Groups by name.
    pub groups: Vec<MeshGroup>,
    /// Lengths by place that the file has besides, such as the thickness of shells.
    pub fields: Vec<MeshField>,
    /// What became of it that its user should know.
    pub notes: Vec<String>,
}

/// A named length by place, as a mesh file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshField {
    /// Unique name.
    pub name: String,
    /// m.
    pub values: FieldValues,
}

/// Where the values of a field are.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValues {
    /// One for each node of the mesh, where it is there.
    Nodes(Vec<Option<f64>>),
    /// By group, cell of it and node of that; of cells without values nothing.
    Corners(Vec<Vec<Vec<f64>>>),
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
