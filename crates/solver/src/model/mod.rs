//! What the user wrote, as plain data in SI units. Comes from a model file or from code; goes to the mesh builder.
//!
//! Nothing here is checked on construction: [`Model::check`] returns *all* faults, each with its path in the input.

pub mod check;
pub mod describe;
pub mod reference;

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
    /// `[[wall]]`.
    pub walls: Vec<Wall>,
    /// `[[symmetry]]`.
    pub symmetries: Vec<Symmetry>,
    /// `[[constraint]]`.
    pub constraints: Vec<Constraint>,
    /// `[[load]]`.
    pub loads: Vec<Load>,
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
    /// Largest number of steps; `None`: no limit.
    pub max_steps: Option<u64>,
}

impl Default for Run {
    fn default() -> Self {
        Self { end: 0.0, safety: 0.9, energy_limit: 0.05, step_limit: None, max_steps: None }
    }
}

/// `[material.NAME]`: a law of the registry and its parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Name in the material registry.
    pub law: String,
    /// Parameters by key, SI, `density` included.
    pub parameters: BTreeMap<String, f64>,
}

/// `[[part]]`: a body of one material and one element kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unique name.
    pub name: String,
    /// Key of [`Model::materials`].
    pub material: String,
    /// Name in the element registry.
    pub element: String,
    /// Where its elements come from.
    pub shape: Shape,
    /// Initial velocity, m/s.
    pub velocity: [f64; 2],
}

/// Where the elements of a part come from. Angles in radians, lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Axis-parallel rectangle; sides `left`, `right`, `bottom`, `top`.
    Rectangle {
        /// Lower left corner.
        corner: [f64; 2],
        /// Width and height.
        size: [f64; 2],
        /// Elements along x and y.
        elements: [usize; 2],
    },
    /// Ring or sector, counter-clockwise from angle `from` to angle `to` (full circle when they differ by 2π);
    /// sides `inner`, `outer` and, for a sector, `start`, `end`.
    Ring {
        /// Centre.
        centre: [f64; 2],
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
        /// First angle, from +x counter-clockwise.
        from: f64,
        /// Last angle, greater than `from` by at most 2π.
        to: f64,
        /// Elements through the wall and around.
        elements: [usize; 2],
    },
    /// Full disk without needle elements: a square core and a ring of quadrilaterals around it; side `outer`.
    Disk {
        /// Centre.
        centre: [f64; 2],
        /// Radius.
        radius: f64,
        /// Elements around a quarter of the circumference.
        elements: usize,
    },
    /// A group of an imported mesh.
    Group {
        /// Index into [`Model::meshes`].
        mesh: usize,
        /// Name of a two-dimensional group.
        group: String,
    },
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

/// How the two surfaces of a contact play slave and target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formulation {
    /// Each surface is slave once and target once in every force evaluation.
    #[default]
    DoublePass,
    /// Only the nodes of `slave` (0 or 1: index into `between`) are checked against the other surface.
    SinglePass {
        /// Index of the slave surface.
        slave: usize,
    },
}

/// How stiff a penalty contact is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Penalty {
    /// `scale` times the stiffness of the elements under the surface.
    Automatic {
        /// Factor, 1 by default.
        scale: f64,
    },
    /// Stiffness per slave node and metre of depth, N/m/m = Pa (the paper's k_n).
    PerNode(f64),
    /// Pressure per penetration, Pa/m; a node has its tributary length's share.
    Pressure(f64),
}

impl Default for Penalty {
    fn default() -> Self {
        Self::Automatic { scale: 1.0 }
    }
}

/// `[[contact]]`: two surfaces that can't go through each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contact {
    /// Unique name.
    pub name: String,
    /// Two surfaces: a part (its whole outside), `part.side`, or a one-dimensional group of a mesh file.
    pub between: [String; 2],
    /// Double or single pass.
    pub formulation: Formulation,
    /// Stiffness.
    pub penalty: Penalty,
    /// Name in the search registry; empty: `grid`.
    pub search: String,
}

/// `[[wall]]`: a rigid plane wall that acts on slave nodes only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wall {
    /// Unique name.
    pub name: String,
    /// Parts that can't cross it; empty: all.
    pub parts: Vec<String>,
    /// A point of the wall, m.
    pub point: [f64; 2],
    /// Normal that points to the free side; any length.
    pub normal: [f64; 2],
    /// Stiffness.
    pub penalty: Penalty,
}

/// `[[symmetry]]`: nodes that lie on a line at the start stay on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Symmetry {
    /// Parts; empty: all.
    pub parts: Vec<String>,
    /// A point of the line, m.
    pub point: [f64; 2],
    /// Normal of the line; any length.
    pub normal: [f64; 2],
}

/// `[[constraint]]`: prescribed velocity of a set of nodes, by component; zero is fixed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constraint {
    /// A part, `part.side`, or a group of a mesh file.
    pub on: String,
    /// Prescribed velocity per component, m/s; `None`: free.
    pub velocity: [Option<f64>; 2],
}

/// `[[load]]`.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// Uniform acceleration of the mass of some parts.
    Gravity {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// Acceleration, m/s².
        acceleration: [f64; 2],
    },
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
        }
    }
}
