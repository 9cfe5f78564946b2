//! The program `embate`.
fn main() {}
