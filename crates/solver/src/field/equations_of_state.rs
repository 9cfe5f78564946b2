//! The history variables of equations of state, as far as no law has them too.

use super::Description;
use crate::material::{self, eos};

pub(super) fn fields() -> Vec<Description> {
    let of_laws = material::variables();
    eos::variables().into_iter().filter(|variable| !of_laws.contains(variable)).map(Description::of).collect()
}
