//! The history variables that material laws declare.

use super::Description;
use crate::material;

pub(super) fn fields() -> Vec<Description> {
    material::variables().into_iter().map(Description::of).collect()
}
