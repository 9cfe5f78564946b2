//! The state of a mesh on another mesh of the same body, in 3D: what `transfer` does in 2D.
//!
//! Cells are cut into tetrahedra about centres of their faces (`cut`), the same from both sides of a face
//! though it is warped. Pieces that belong to a tetrahedron of each mesh (a supermesh, `clip`) give exact
//! integrals of products of linear functions. `nodes` gives masses and velocities: mass, momentum and angular
//! momentum are kept, and the kinetic energy does not rise. `PointMap` gives the values of integration
//! points. `relocate` moves nodes to better places without other cells.
//!
//! Hexahedra, wedges and tetrahedra can be mixed. A tetrahedron of ten nodes is twelve tetrahedra about the
//! mean of its middle nodes, as its composite element is: middle nodes have masses and velocities of their
//! own. Where hexahedra or wedges meet tetrahedra in a quadrilateral, it must be plane. One call is one body:
//! a mesh is connected and of one material law.
//!
//! Sources: Farrell et al., CMAME 198 (2009) 2632-2642 (pieces); Powell & Abel, J. Comput. Phys. 297 (2015)
//! 340-356 (clipping); Davies & Salmond, AIAA J. 23 (1985) 954-956 (hexahedra as 24 tetrahedra).

mod boundary;
mod clip;
mod cut;
mod face;
mod kind;
mod nodes;
mod place;
mod points;
pub mod relocate;
mod tets;
mod vector;
#[cfg(test)]
mod tests;

pub use crate::transfer::{Failure, Order, Side, Values};
pub use kind::{Cell, Kind, Mesh, Point};
pub use nodes::{NewNodes, Nodes, OldNodes, nodes};
pub use place::{Nearest, Outside, Within};
pub use points::{PointMap, Points, Rule, points};
pub use tets::volumes;
