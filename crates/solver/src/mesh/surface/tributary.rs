//! How much of a surface belongs to a node: the one place where a length becomes an area, and a facet its
//! nodes' shares of it.
//!
//! A triangle is flat. A facet of four nodes is the surface x(ξ, η) = Σ N_a x_a of its bilinear shape
//! functions, flat or not: its normal times area per dξ dη, ∂x/∂ξ × ∂x/∂η = n₀ + ξ n₁ + η n₂, is linear, so
//! that what a pressure does to it is exact, and areas are taken at 2 × 2 points.

use crate::mesh::Meshed;
use crate::mesh::surface::{Corners, Facet};
use crate::tensor::{Dim, cross};
use crate::vector::length;
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

    /// Area that each of the two nodes of a segment stands for: ∫ N_a ds, half the length, or 2π ∫ N_a x
    /// ds = π L (2 x_a + x_b) / 3.
    #[must_use]
    pub fn shares(self, [a, b]: [[f64; 2]; 2]) -> [f64; 2] {
        let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
        match self {
            Self::Plane => [0.5 * length; 2],
            Self::Revolution => [2.0 * a[0] + b[0], a[0] + 2.0 * b[0]].map(|radius| TAU / 6.0 * length * radius),
        }
    }
}

/// What loads on surfaces know of their dimension.
pub trait Tributary<const D: usize>: Meshed<D> {
    /// A number for each corner of a piece of a surface; the fourth of a triangle is zero.
    type Shares: AsRef<[f64]> + Copy;
    /// A direction and an area for each corner.
    type Presses: AsRef<[([f64; D], f64)]> + Copy;

    /// Area that each node of a piece stands for: ∫ N_a dA, m² (in 2D m²/m, see [`Depth::shares`]).
    fn shares(depth: Depth, facet: Self::Facet, positions: &[[f64; D]]) -> Self::Shares;

    /// What a pressure of one does at each node: −∫ N_a n dA as a vector that points inwards, and a factor on
    /// it; the product of the two is meant. A closed surface under a constant pressure feels no resultant,
    /// and in 3D no moment, but round-off. Zero where a piece has no size.
    fn presses(depth: Depth, facet: Self::Facet, positions: &[[f64; D]]) -> Self::Presses;

    /// `across` n nᵀ + `along` (I − n nᵀ) with the normal n of a piece: a resistance to motion across it, and
    /// along it.
    fn resistance(facet: Self::Facet, positions: &[[f64; D]], along: f64, across: f64) -> [[f64; D]; D];
}

impl Tributary<2> for Dim<2> {
    type Shares = [f64; 2];
    type Presses = [([f64; 2], f64); 2];

    fn shares(depth: Depth, segment: [u32; 2], positions: &[[f64; 2]]) -> [f64; 2] {
        depth.shares(segment.map(|node| positions[node as usize]))
    }

    fn presses(depth: Depth, segment: [u32; 2], positions: &[[f64; 2]]) -> [([f64; 2], f64); 2] {
        let ends = segment.map(|node| positions[node as usize]);
        let side = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let length = (side[0] * side[0] + side[1] * side[1]).sqrt();
        if length > 0.0 {
            let inward = [side[1] / length, -side[0] / length];
            depth.shares(ends).map(|share| (inward, share))
        } else {
            [([0.0; 2], 0.0); 2]
        }
    }

    fn resistance(segment: [u32; 2], positions: &[[f64; 2]], along: f64, across: f64) -> [[f64; 2]; 2] {
        let [a, b] = segment.map(|node| positions[node as usize]);
        let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
        let [x, y] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let shear = (along - across) * x * y;
        [[across * y * y + along * x * x, shear], [shear, across * x * x + along * y * y]]
    }
}

impl Tributary<3> for Dim<3> {
    type Shares = [f64; 4];
    type Presses = [([f64; 3], f64); 4];

    fn shares(_: Depth, facet: [u32; 4], positions: &[[f64; 3]]) -> [f64; 4] {
        area_shares(facet.map(|node| positions[node as usize]), facet.corners().len() == 3)
    }

    fn presses(_: Depth, facet: [u32; 4], positions: &[[f64; 3]]) -> [([f64; 3], f64); 4] {
        let areas = vector_shares(facet.map(|node| positions[node as usize]), facet.corners().len() == 3);
        areas.map(|[x, y, z]| ([0.0 - x, 0.0 - y, 0.0 - z], 1.0))
    }

    /// The normal is that of the vector area.
    fn resistance(facet: [u32; 4], positions: &[[f64; 3]], along: f64, across: f64) -> [[f64; 3]; 3] {
        let area = vector_area(facet.map(|node| positions[node as usize]), facet.corners().len() == 3);
        let n = area.map(|component| component / length(area));
        std::array::from_fn(|i| std::array::from_fn(|j| (across - along) * n[i] * n[j] + if i == j { along } else { 0.0 }))
    }
}

/// Area of a piece of a surface that each of its nodes stands for; see [`Tributary::shares`].
pub fn shares<const D: usize>(depth: Depth, facet: Facet<D>, positions: &[[f64; D]]) -> impl Iterator<Item = (u32, f64)>
where
    Dim<D>: Tributary<D>,
{
    let shares = Dim::<D>::shares(depth, facet, positions);
    (0..facet.corners().len()).map(move |k| (facet.corners()[k], shares.as_ref()[k]))
}

/// Corners of a facet in ξ and η.
const NATURAL: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// ∂x/∂ξ and ∂x/∂η of a facet of four nodes at its middle, and their slope ∂²x/∂ξ∂η, all four times.
fn spanned(x: [[f64; 3]; 4]) -> [[f64; 3]; 3] {
    let sum = |signs: [f64; 4]| std::array::from_fn(|d| (0..4).map(|a| signs[a] * x[a][d]).sum());
    [sum(NATURAL.map(|[xi, _]| xi)), sum(NATURAL.map(|[_, eta]| eta)), sum(NATURAL.map(|[xi, eta]| xi * eta))]
}

/// Twice the vector area of a triangle.
fn twice_triangle([a, b, c, _]: [[f64; 3]; 4]) -> [f64; 3] {
    let from_a = |x: [f64; 3]| [x[0] - a[0], x[1] - a[1], x[2] - a[2]];
    cross(from_a(b), from_a(c))
}

/// Vector area ∫ n dA of a facet with these corners, outwards, m²: ½ Σ x_a × x_(a+1), exact also where it is
/// not flat.
#[must_use]
pub fn vector_area(corners: [[f64; 3]; 4], is_triangle: bool) -> [f64; 3] {
    if is_triangle {
        return twice_triangle(corners).map(|n| 0.5 * n);
    }
    let [p, q, _] = spanned(corners);
    cross(p, q).map(|n| 0.25 * n)
}

/// ∫ N_a n dA at each corner, m²: of a triangle a third of its vector area; else n₀ + ξ_a n₁ / 3 + η_a n₂ / 3
/// with n₀ = p × q, n₁ = p × r, n₂ = r × q from p = ∂x/∂ξ and q = ∂x/∂η at the middle and r = ∂²x/∂ξ∂η.
#[must_use]
pub fn vector_shares(corners: [[f64; 3]; 4], is_triangle: bool) -> [[f64; 3]; 4] {
    if is_triangle {
        let third = twice_triangle(corners).map(|n| n / 6.0);
        return [third, third, third, [0.0; 3]];
    }
    let [p, q, r] = spanned(corners);
    let [n0, n1, n2] = [cross(p, q), cross(p, r), cross(r, q)];
    NATURAL.map(|[xi, eta]| std::array::from_fn(|d| (n0[d] + (xi * n1[d] + eta * n2[d]) / 3.0) / 16.0))
}

/// ∫ N_a dA at each corner, m²: of a triangle a third of its area; else by 2 × 2 points, exact where the
/// facet is flat.
#[must_use]
pub fn area_shares(corners: [[f64; 3]; 4], is_triangle: bool) -> [f64; 4] {
    if is_triangle {
        let third = length(twice_triangle(corners)) / 6.0;
        return [third, third, third, 0.0];
    }
    let [p, q, r] = spanned(corners);
    let [n0, n1, n2] = [cross(p, q), cross(p, r), cross(r, q)];
    let place = (1.0_f64 / 3.0).sqrt();
    let mut shares = [0.0; 4];
    for [xi, eta] in NATURAL.map(|point| point.map(|sign| sign * place)) {
        let area = length::<3>(std::array::from_fn(|d| n0[d] + xi * n1[d] + eta * n2[d])) / 16.0;
        for (share, corner) in shares.iter_mut().zip(NATURAL) {
            *share += 0.25 * (1.0 + corner[0] * xi) * (1.0 + corner[1] * eta) * area;
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::cell::CellKind;
    use crate::mesh::surface::Surface;
    use proptest::prelude::*;

    fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    }

    #[test]
    fn a_flat_facet_is_shared_by_its_area() {
        let slanted = |[x, y]: [f64; 2]| [x, y, 2.0 * x];
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(slanted);
        let area = 5.0_f64.sqrt();
        assert!(area_shares(square, false).iter().all(|share| (share - 0.25 * area).abs() < 1e-15));
        assert!(vector_shares(square, false).iter().flatten().zip([-0.5, 0.0, 0.25].iter().cycle()).all(|(a, b)| (a - b).abs() < 1e-15));
        let triangle = [square[0], square[1], square[2], square[2]];
        assert!(area_shares(triangle, true)[..3].iter().all(|share| (share - area / 6.0).abs() < 1e-15));
        // A trapezoid: by hand ∫ N_0 dA = ∫ (1 − η) (3 − η) dη / 16 = 5/12.
        let wide = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let shares = area_shares(wide, false);
        assert!((shares.iter().sum::<f64>() - 1.5).abs() < 1e-15 && (shares[0] - 5.0 / 12.0).abs() < 1e-15, "{shares:?}");
    }

    #[test]
    fn the_vector_area_is_the_sum_of_its_shares_and_of_the_outline() {
        let x = [[0.1, 0.2, 0.3], [1.4, -0.2, 0.5], [1.1, 1.3, -0.6], [-0.2, 0.9, 0.4]];
        let outline = (0..4).map(|k| cross(x[k], x[(k + 1) % 4]).map(|n| 0.5 * n)).fold([0.0; 3], plus);
        let shares = vector_shares(x, false).into_iter().fold([0.0; 3], plus);
        let area = vector_area(x, false);
        assert!((0..3).all(|d| (area[d] - outline[d]).abs() < 1e-15 && (shares[d] - outline[d]).abs() < 1e-15));
    }

    proptest! {
        #[test]
        fn a_closed_surface_under_pressure_feels_no_resultant_and_no_moment(shift in prop::collection::vec(-0.4..0.4_f64, 39)) {
            // A hexahedron with a wedge on it and a tetrahedron on that: facets of both kinds, none of them
            // flat.
            let cells = [
                CellKind::Hexahedron.cell(&[0, 1, 2, 3, 4, 5, 6, 7]),
                CellKind::Wedge.cell(&[4, 8, 5, 7, 9, 6]),
                CellKind::Tetrahedron.cell(&[4, 5, 8, 10]),
            ];
            let places = [
                [0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2], [1, 0, 4], [1, 2, 4], [1, -2, 3],
            ];
            let position = |(i, x): (usize, &[i32; 3])| std::array::from_fn(|d| f64::from(x[d]) + shift[3 * i + d]);
            let positions: Vec<[f64; 3]> = places.iter().enumerate().map(position).collect();
            let surface = Surface::<3>::outside(cells).unwrap();
            prop_assert_eq!(surface.facets.len(), 5 + 3 + 3);
            let (mut resultant, mut moment, mut volume) = ([0.0; 3], [0.0; 3], 0.0);
            for &facet in &surface.facets {
                for (&node, (direction, factor)) in facet.corners().iter().zip(Dim::<3>::presses(Depth::Plane, facet, &positions)) {
                    let (x, force) = (positions[node as usize], direction.map(|n| factor * n));
                    resultant = plus(resultant, force);
                    moment = plus(moment, cross(x, force));
                    volume -= (0..3).map(|d| x[d] * force[d]).sum::<f64>() / 3.0;
                }
            }
            prop_assert!(resultant.iter().chain(&moment).all(|f| f.abs() < 1e-13), "{:?} {:?}", resultant, moment);
            prop_assert!(volume > 2.0 && volume < 30.0);
        }
    }

    #[test]
    fn in_2d_a_pressure_acts_along_the_normal_on_each_nodes_share() {
        let positions = [[1.0, 0.0], [4.0, 4.0]];
        for depth in [Depth::Plane, Depth::Revolution] {
            let presses = Dim::<2>::presses(depth, [0, 1], &positions);
            let mut shares = presses.iter().map(|press| press.1).zip(depth.shares(positions));
            assert!(shares.all(|(a, b)| a == b) && presses.iter().all(|press| press.0 == [0.8, -0.6]));
        }
        assert_eq!(Dim::<2>::presses(Depth::Plane, [0, 0], &positions), [([0.0; 2], 0.0); 2]);
    }

    #[test]
    fn shares_add_up_to_the_area_of_a_cone() {
        let ends = [[1.0, 0.0], [4.0, 4.0]];
        let [a, b] = Depth::Revolution.shares(ends);
        assert!((a + b - std::f64::consts::PI * (1.0 + 4.0) * 5.0).abs() < 1e-12 && a < b);
        assert_eq!(Depth::Plane.shares(ends), [2.5, 2.5]);
    }
}
