//! Sizes, shapes and strains of cells from the positions of their nodes ([`CellGeometry`], on [`Dim`]).

mod plane;
mod space;

use super::Meshed;
use super::cell::Cell;
use super::surface::Facet;
use super::surface::tributary::Tributary;
use crate::tensor::Dim;

/// Geometry of cells.
pub trait CellGeometry<const D: usize>: Meshed<D> + Tributary<D> {
    /// Smallest Jacobian determinant of a cell, times that of its natural corner, over its corners (m², in
    /// 3D m³, of surfaces m²): positive in all of them where the cell is sound; `None` of lines.
    fn min_corner_jacobian(cell: Cell<'_>, positions: &[[f64; D]]) -> Option<f64>;
    /// That over the square (of volumes: the third power) of the longest side: 1 of squares and cubes, less
    /// of what is long, sheared or folded; lines have the best.
    fn shape_quality(cell: Cell<'_>, positions: &[[f64; D]]) -> f64;
    /// One over the height of a cell over a piece of its outside, 1/m: its length over the area, in 3D its
    /// area over the volume.
    fn inverse_height(facet: Facet<D>, cell: Cell<'_>, positions: &[[f64; D]]) -> f64
    where
        Dim<D>: Meshed<D>;
    /// Length of a line, area of a surface, volume of a cell in 3D that is one; m, m², m³.
    fn size(cell: Cell<'_>, positions: &[[f64; D]]) -> f64;
    /// Largest and smallest principal logarithmic strain at the centre of a cell, from the positions at the
    /// start to those now: half the logarithms of the eigenvalues of FᵀF. Of a line its one strain twice, of
    /// a surface in 3D those in it.
    fn principal_strains(cell: Cell<'_>, from: &[[f64; D]], to: &[[f64; D]]) -> [f64; 2];
    /// The pieces of the outside that a cell alone would have: in 2D they run against its own
    /// direction; in the form in which surfaces have them.
    fn cell_facets(cell: Cell<'_>) -> Vec<Facet<D>>
    where
        Dim<D>: Meshed<D>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;

    #[test]
    fn the_shape_of_squares_and_cubes_is_one_and_of_what_is_flat_or_folded_less() {
        fn of<const D: usize>(positions: &[[f64; D]]) -> f64
        where
            Dim<D>: CellGeometry<D>,
        {
            let kind = CellKind::of(D, positions.len()).unwrap();
            <Dim<D>>::shape_quality(kind.cell(&(0..positions.len() as u32).collect::<Vec<_>>()), positions)
        }
        assert_eq!(of(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]), 1.0);
        assert_eq!(of(&[[0.0, 0.0], [10.0, 0.0], [10.0, 1.0], [0.0, 1.0]]), 0.1);
        assert!((of(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]]) - 0.75f64.sqrt()).abs() < 1e-15);
        assert!(of(&[[0.0, 0.0], [1.0, 0.0], [0.2, 0.2], [0.0, 1.0]]) < 0.0);
        let prism = |base: &[[f64; 2]], height: f64| -> Vec<[f64; 3]> {
            [0.0, height].iter().flat_map(|&z| base.iter().map(move |x| [x[0], x[1], z])).collect()
        };
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        assert_eq!((of(&prism(&square, 2.0)), of(&prism(&square, -2.0)), of(&prism(&square, 1.0))), (1.0, -1.0, 0.5));
        assert!((of(&prism(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]], 1.0)) - 0.75f64.sqrt()).abs() < 1e-15);
        let (a, b) = ((1.0f64 / 3.0).sqrt(), (2.0f64 / 3.0).sqrt());
        let tetrahedron = [[a, 0.0, 0.0], [-0.5 * a, 0.5, 0.0], [-0.5 * a, -0.5, 0.0], [0.0, 0.0, b]];
        assert!((of(&tetrahedron) - 0.5f64.sqrt()).abs() < 1e-15);
    }
}
