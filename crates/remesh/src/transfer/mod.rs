//! The state of a mesh on another one.
