//! Outlines of obstacles for output: lines in 2D, facets in 3D.

/// Where an obstacle is at one output time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Name of the obstacle.
    pub name: String,
    /// Points of its surface, m. In 2D (z is zero) they follow each other, the solid on the right;
    /// what is without end reaches far beyond the model, a closed line ends at its first point.
    pub points: Vec<[f64; 3]>,
    /// In 3D: facets of it, each by its points, outward by the right-hand rule; a triangle repeats its
    /// last point.
    pub facets: Vec<[u32; 4]>,
    /// Whether it acts no more (`death`): then it is not drawn.
    pub is_gone: bool,
}

impl Outline {
    /// A line in 2D.
    #[must_use]
    pub fn line(name: &str, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        Self { name: name.into(), points: points.into_iter().map(|[x, y]| [x, y, 0.0]).collect(), ..Self::default() }
    }
}
