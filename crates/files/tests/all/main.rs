//! Tests of the formats through the crate's public face, one module a format.

mod picture;
