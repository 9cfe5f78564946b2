//! Local search: where a slave node lies with respect to its target surface. One primitive pair a file.

pub mod edge_edge;
pub mod node_facet;
pub mod node_segment;
pub mod swept;
