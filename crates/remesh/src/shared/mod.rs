//! What the transfers in 2D and 3D have in common.

pub(crate) mod grid;
pub(crate) mod limiter;
pub(crate) mod matrix;
pub(crate) mod motion;
#[cfg(test)]
pub(crate) mod random;

use crate::transfer::Failure;

/// Volume of new cells without old material; `Uncovered` if that is more than half of one.
pub(crate) fn uncovered(covered: &[f64], volumes: &[f64]) -> Result<f64, Failure> {
    match covered.iter().zip(volumes).position(|(part, whole)| !(2.0 * part >= *whole)) {
        Some(cell) => Err(Failure::Uncovered { cell }),
        None => Ok(covered.iter().zip(volumes).map(|(part, whole)| (whole - part).max(0.0)).sum()),
    }
}
