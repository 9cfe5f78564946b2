//! See README.md.
#![no_main]

embate_fuzz::fuzz!(fields);
