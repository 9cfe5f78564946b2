//! All tests of the formats in one program.

mod gmsh;
