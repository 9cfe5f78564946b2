//! How much of a surface belongs to a node: the one place where a length becomes an area.

use std::f64::consts::TAU;

/// What a segment's length is multiplied by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// A metre of depth: areas are m²/m.
    #[default]
    Plane,
    /// The circumference at its radius x: areas are m².
    Revolution,
}

impl Depth {
    /// Of a model.
    #[must_use]
    pub fn of(model: &crate::model::Model) -> Self {
        if model.is_axisymmetric() { Self::Revolution } else { Self::Plane }
    }

    /// Area by length at a place: one, or the circumference 2π x.
    #[must_use]
    pub fn at(self, x: [f64; 2]) -> f64 {
        match self {
            Self::Plane => 1.0,
            Self::Revolution => TAU * x[0],
        }
    }

    /// Area that each of the two nodes of a segment stands for: ∫ N_a ds, half the length, or 2π ∫ N_a x ds = π L (2 x_a + x_b) / 3.
    #[must_use]
    pub fn shares(self, [a, b]: [[f64; 2]; 2]) -> [f64; 2] {
        let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
        match self {
            Self::Plane => [0.5 * length; 2],
            Self::Revolution => [2.0 * a[0] + b[0], a[0] + 2.0 * b[0]].map(|radius| TAU / 6.0 * length * radius),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_to_the_area_of_a_cone() {
        let ends = [[1.0, 0.0], [4.0, 4.0]];
        let [a, b] = Depth::Revolution.shares(ends);
        assert!((a + b - std::f64::consts::PI * (1.0 + 4.0) * 5.0).abs() < 1e-12 && a < b);
        assert_eq!(Depth::Plane.shares(ends), [2.5, 2.5]);
    }
}
