//! What holds, moves and loads bodies from outside, as plain data: symmetry, constraints, loads, boundaries
//! that reflect nothing, joins. Vectors have three components; in 2D the third is zero.
//!
//! Part of the [`Model`](super::Model); curves and rigid motion are in `mod.rs`.

use super::{Drive, in_3d};

/// `[[symmetry]]`: nodes that lie on a line (in 3D: on a plane) at the start stay on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Symmetry {
    /// Parts; empty: all.
    pub parts: Vec<String>,
    /// A point of the line (in 3D: of a plane), m.
    pub point: [f64; 3],
    /// Its normal; any length.
    pub normal: [f64; 3],
}

/// `[[constraint]]`: prescribed motion of a set of nodes, by component, or around a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Constraint {
    /// A part, `part.side`, or a group of a mesh file.
    pub on: String,
    /// Prescribed velocity per component, m/s, zero is fixed; `None`: free, or prescribed in another way.
    pub velocity: [Option<Drive>; 3],
    /// Prescribed displacement from the initial position per component, m: curves that begin with zero.
    pub displacement: [Option<Drive>; 3],
    /// Prescribed acceleration per component, m/s²: the velocity begins with the initial one.
    pub acceleration: [Option<Drive>; 3],
    /// Prescribed rotation about a point: then nothing else.
    pub rotation: Option<Rotation>,
}

/// Prescribed rotation of nodes about a fixed axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// The axis.
    pub about: Axis,
    /// Angular velocity, rad/s, counter-clockwise where the axis points to the reader.
    pub speed: Drive,
}

/// What something turns about: in 2D a point, in 3D the line through it along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// A point of it, m.
    pub centre: [f64; 3],
    /// Its direction, of any length but zero; in the plane that of z.
    pub direction: [f64; 3],
}

impl Axis {
    /// Along z through a point, m.
    #[must_use]
    pub fn through<const D: usize>(centre: [f64; D]) -> Self {
        Self { centre: in_3d(centre), direction: [0.0, 0.0, 1.0] }
    }
}

/// Along z through the origin.
impl Default for Axis {
    fn default() -> Self {
        Self::through([0.0; 3])
    }
}

/// `[[load]]`.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// Uniform acceleration of the mass of some parts.
    Gravity {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// Acceleration, m/s².
        acceleration: [f64; 3],
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// The centrifugal force of a frame that turns about a point: acceleration speed² (x − centre) of the
    /// mass of some parts.
    Centrifugal {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// What it turns about; an axisymmetric model turns about its axis.
        about: Axis,
        /// Angular velocity of the frame, rad/s.
        speed: f64,
        /// Key of [`super::Model::curves`]: a factor of the angular velocity.
        curve: Option<String>,
    },
    /// A force on a set of nodes, shared by tributary length on a surface, else equally.
    Force {
        /// A side as `part.side`, or a group of a mesh file.
        on: String,
        /// The whole force, N/m; of an axisymmetric model N.
        force: [f64; 3],
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// A pressure on a surface, against its current normal and on its current length.
    Pressure {
        /// A part (its whole outside), `part.side`, or a one-dimensional group of a mesh file.
        on: String,
        /// Pressure, Pa.
        pressure: f64,
        /// Key of [`super::Model::curves`]: a factor.
        curve: Option<String>,
    },
    /// Force −rate · m · v on the mass of some parts: what is quasi-static comes to rest.
    Damping {
        /// Parts; empty: all.
        parts: Vec<String>,
        /// Rate, 1/s.
        rate: f64,
        /// Times between which it acts, s.
        active: [f64; 2],
    },
    /// A stress β C:ε̇ in the elements of some parts, with the elastic stiffness C: what swings fast is
    /// damped.
    StiffnessDamping {
        /// Parts; empty: all that deform.
        parts: Vec<String>,
        /// β, s.
        time: f64,
    },
}

/// `[[non_reflecting]]`: a surface that takes waves up as if the body continued.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NonReflecting {
    /// `part.side`, a part (its whole outside), or a one-dimensional group of a mesh file.
    pub on: String,
}

/// `[[join]]`: nodes of two sets that move as one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Join {
    /// The sets: each a part, `part.side`, or a group of a mesh file.
    pub between: [String; 2],
    /// How the second set comes from the first.
    pub image: Image,
    /// Distance within which nodes are partners, m; `None`: 1e-6 of the model's extent.
    pub tolerance: Option<f64>,
}

/// How one set of nodes is the image of another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Image {
    /// They coincide.
    #[default]
    Same,
    /// Moved by this, m.
    Translated([f64; 3]),
    /// Turned about an axis.
    Turned {
        /// The axis.
        about: Axis,
        /// By this angle, rad, counter-clockwise.
        angle: f64,
    },
}
