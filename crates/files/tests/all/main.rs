//! Tests of the formats, one module a format.

mod model_file;
//! Tests of the formats from outside, one module a format.

#![allow(clippy::unwrap_used)]

mod results;
