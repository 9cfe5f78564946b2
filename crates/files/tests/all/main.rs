//! Tests of the formats, one module a format.

mod model_file;
