//! A straight line, infinite or of some length: the paper's rigid contact element.

use super::Shape;
use crate::contact::Vector;

/// The line through the body's origin.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Unit normal that points to the free side.
    pub normal: Vector,
    /// Half of its length, m; infinite: no ends.
    pub half: f64,
}

impl Shape for Plane {
    fn project(&self, x: Vector) -> Option<(f64, Vector)> {
        let n = self.normal;
        let along = x[0] * n[1] - x[1] * n[0];
        (along.abs() <= self.half).then(|| (x[0] * n[0] + x[1] * n[1], n))
    }
}
