//! The state of a mesh on another mesh of the same body.
//!
//! Both meshes are cut into triangles, these into pieces that belong to one triangle of each (a supermesh),
//! and integrals over the pieces are exact. `nodes` gives masses and velocities: mass, momentum and angular
//! momentum are kept, and the kinetic energy never rises. `points` gives the values of integration points.
//!
//! Source of the pieces: Farrell et al., CMAME 198 (2009) 2632-2642; Sutherland & Hodgman, CACM 17 (1974)
//! 32-42. One call is one body: a mesh is connected and of one material law.

mod boundary;
mod clip;
mod nodes;
mod points;
mod quarters;
mod supermesh;
#[cfg(test)]
mod tests;

pub use nodes::{NewNodes, Nodes, OldNodes, nodes};
pub use points::{Order, PointMap, Points, Values, points};
pub use supermesh::Supermesh;

use std::fmt;

/// One of the two meshes of a transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The mesh that has the state.
    Old,
    /// The mesh that gets it.
    New,
}

/// Why a state cannot be carried over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// Lengths of two inputs disagree, or a cell has a node that is not there.
    Size,
    /// A number is not finite, or a mass is negative.
    Number,
    /// A cell has no positive area or volume, or a place that is not a finite number.
    Inverted {
        /// Its mesh.
        side: Side,
        /// Its index.
        cell: usize,
    },
    /// An old cell has no positive mass or density.
    Massless {
        /// Its index.
        cell: usize,
    },
    /// A new cell has old material in less than half of its volume.
    Uncovered {
        /// Its index.
        cell: usize,
    },
    /// Old material is in more than one new cell: in 3D, where a warped quadrilateral is joined to triangles.
    Overlap {
        /// The old cell.
        cell: usize,
    },
    /// No number of integration points but 1, and 4 for quadrilaterals, is known.
    Points {
        /// The mesh.
        side: Side,
        /// The first cell for which it holds.
        cell: usize,
    },
    /// Masses of nodes would have to change by more than this part to keep the inertia.
    Correction(
        /// Largest |q|.
        f64,
    ),
    /// The inertia of the old nodes cannot be had with the new ones: rigid motion would gain energy.
    Inertia,
}

impl fmt::Display for Failure {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Size => write!(to, "lengths of the inputs of a transfer disagree"),
            Self::Number => write!(to, "a number of the state is not finite"),
            Self::Inverted { side, cell } => write!(to, "cell {cell} of the {} mesh has no positive size", side.name()),
            Self::Massless { cell } => write!(to, "cell {cell} of the old mesh has no positive mass"),
            Self::Uncovered { cell } => write!(to, "cell {cell} of the new mesh has hardly any old material"),
            Self::Overlap { cell } => write!(to, "material of cell {cell} of the old mesh is in several new cells at once"),
            Self::Points { side, cell } => write!(to, "points of cell {cell} of the {} mesh are not known", side.name()),
            Self::Correction(q) => write!(to, "masses of nodes would change by {q:.2}"),
            Self::Inertia => write!(to, "the inertia cannot be kept on the new nodes"),
        }
    }
}

impl std::error::Error for Failure {}

impl Side {
    fn name(self) -> &'static str {
        match self {
            Self::Old => "old",
            Self::New => "new",
        }
    }
}
