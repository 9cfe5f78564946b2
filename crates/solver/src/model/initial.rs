//! What a part holds at the start besides its motion, as plain data: stress that varies linearly in
//! 2D.
//!
//! Part of [`super::Part`]; blocks take it over in `block/initial.rs`.

/// A Cauchy stress that varies linearly: σ(x) = σ₀ + (x − x₀) ∂σ/∂x + (y − y₀) ∂σ/∂y. Components xx, yy, zz,
/// xy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InitialStress {
    /// σ₀, Pa. Of bars xx is the stress along the bar, and there is no other.
    pub value: [f64; 4],
    /// ∂σ/∂x, Pa/m.
    pub per_x: [f64; 4],
    /// ∂σ/∂y, Pa/m.
    pub per_y: [f64; 4],
    /// (x₀, y₀), m.
    pub point: [f64; 2],
}

impl InitialStress {
    /// The same everywhere, Pa.
    #[must_use]
    pub fn uniform(value: [f64; 4]) -> Self {
        Self { value, ..Self::default() }
    }

    /// The stress at a place, Pa.
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 4] {
        let [x, y] = [x - self.point[0], y - self.point[1]];
        std::array::from_fn(|c| self.value[c] + x * self.per_x[c] + y * self.per_y[c])
    }

    /// Whether a component is zero everywhere.
    #[must_use]
    pub fn lacks(&self, component: usize) -> bool {
        [self.value, self.per_x, self.per_y].iter().all(|of| of[component] == 0.0)
    }
}
