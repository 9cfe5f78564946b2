//! What every registered element promises by itself: shape functions, gradients, their transpose, volume.

use crate::patches::{Spread, around, distorted, shoelace};
use embate_solver::element::{ELEMENTS, Element, ElementVisitor, Tri6, with_element};
use embate_solver::stress_state::StressState;
use embate_solver::tensor::{Dim, Matrix, Space, product};

/// A test that calls `$check::<E, N, P>()` for every element of the registry.
macro_rules! every_element {
    ($(#[$doc:meta])* $name:ident, $check:ident) => {
        $(#[$doc])*
        #[test]
        fn $name() {
            struct Check;
            impl ElementVisitor<2> for Check {
                type Output = ();
                fn visit<E: Element<2, N, P>, const N: usize, const P: usize>(self) {
                    $check::<E, N, P>();
                }
            }
            for kind in ELEMENTS {
                with_element(kind.name, Check).unwrap();
            }
        }
    };
}

/// A point that lies in the element: a weighted mean of its nodes.
fn inside<const N: usize>(nodes: &[[f64; 2]; N], numbers: &mut Spread) -> [f64; 2] {
    let weights: [f64; N] = std::array::from_fn(|_| numbers.between(0.0, 1.0));
    let total: f64 = weights.iter().sum();
    std::array::from_fn(|d| (0..N).map(|a| weights[a] * nodes[a][d]).sum::<f64>() / total)
}

fn random_nodal<const N: usize>(numbers: &mut Spread) -> [[f64; 2]; N] {
    std::array::from_fn(|_| numbers.vector(1.0))
}

fn random_element<E: Element<2, N, P>, const N: usize, const P: usize>(numbers: &mut Spread) -> [[f64; 2]; N] {
    distorted(E::KIND.name, 0.9, 20.0, numbers).try_into().unwrap()
}

fn partition_of_unity<E: Element<2, N, P>, const N: usize, const P: usize>() {
    assert_eq!(E::KIND.nodes(), N);
    let mut numbers = Spread::new(1);
    for a in 0..N {
        let shape = E::shape(E::NODES[a]);
        for (b, value) in shape.into_iter().enumerate() {
            assert!((value - f64::from(u8::from(a == b))).abs() < 1e-15, "{} node {a}, function {b}: {value}", E::KIND.name);
        }
    }
    for _ in 0..100 {
        let at = inside(&E::NODES, &mut numbers);
        let shape = E::shape(at);
        assert!((shape.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        // The map of the element onto itself is the identity.
        for d in 0..2 {
            let place: f64 = (0..N).map(|a| shape[a] * E::NODES[a][d]).sum();
            assert!((place - at[d]).abs() < 1e-14, "{} at {at:?}", E::KIND.name);
        }
    }
}
every_element!(shape_functions_sum_to_one_and_are_one_at_their_own_node_only, partition_of_unity);

fn gradients_by_differences<E: Element<2, N, P>, const N: usize, const P: usize>() {
    const H: f64 = 1e-5;
    if E::COMPOSITE {
        return; // a projection, see below
    }
    for a in 0..N {
        for i in 0..2 {
            let mut nodal = [[0.0; 2]; N];
            nodal[a][i] = 1.0;
            for (p, gradient) in E::gradients(&nodal).iter().enumerate() {
                for k in 0..2 {
                    let at = |sign: f64| {
                        let mut natural = E::POINTS[p];
                        natural[k] += sign * H;
                        E::shape(natural)[a]
                    };
                    let expected = (at(1.0) - at(-1.0)) / (2.0 * H);
                    assert!((gradient[i][k] - expected).abs() < 1e-10, "{}: node {a}, point {p}, ∂/∂ξ_{k}", E::KIND.name);
                    assert_eq!(gradient[1 - i][k], 0.0);
                }
            }
        }
    }
}
every_element!(gradients_are_the_differences_of_the_shape_functions, gradients_by_differences);

/// Of an element with straight edges the L² projection on the linear functions of the gradients that are
/// constant in its four triangles: A g = r, A_ab = ∫ λ_a λ_b, r_a = Σ_s A_s λ_a(s) ∇u|_s.
#[test]
fn gradients_of_a_composite_element_are_projections_of_those_of_its_parts() {
    let (mut numbers, x) = (Spread::new(31), Tri6::NODES);
    for _ in 0..20 {
        let u: [[f64; 2]; 6] = random_nodal(&mut numbers);
        let mut moments = [[[0.0; 2]; 2]; 3];
        for [a, b, c] in [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]] {
            let side = |of: &[[f64; 2]; 6], k: usize| [of[k][0] - of[a][0], of[k][1] - of[a][1]];
            let (e, f) = (side(&x, b), side(&x, c));
            let determinant = e[0] * f[1] - e[1] * f[0];
            assert!((determinant - 0.25).abs() < 1e-15);
            let dual = [[f[1] / determinant, -f[0] / determinant], [-e[1] / determinant, e[0] / determinant]];
            let centre = [0, 1].map(|d| (x[a][d] + x[b][d] + x[c][d]) / 3.0);
            let lambda = [1.0 - centre[0] - centre[1], centre[0], centre[1]];
            for (p, i, k) in (0..12).map(|n| (n / 4, n / 2 % 2, n % 2)) {
                moments[p][i][k] += 0.5 * determinant * lambda[p] * (side(&u, b)[i] * dual[0][k] + side(&u, c)[i] * dual[1][k]);
            }
        }
        // ∫ λ_a λ_b = A (1 + δ_ab) / 12, whose inverse is (12 δ_ab − 3) / A.
        for (gradient, at) in Tri6::gradients(&u).iter().zip(Tri6::POINTS) {
            let lambda = [1.0 - at[0] - at[1], at[0], at[1]];
            for (i, k) in (0..4).map(|n| (n / 2, n % 2)) {
                let all: f64 = (0..3).map(|a| moments[a][i][k]).sum();
                let expected: f64 = (0..3).map(|a| lambda[a] * (12.0 * moments[a][i][k] - 3.0 * all) / 0.5).sum();
                assert!((gradient[i][k] - expected).abs() < 1e-14, "{} {expected}", gradient[i][k]);
            }
        }
    }
}

/// The volume of what encloses an element, of its revolution too, is that of its four triangles, and changes
/// by its slope; with straight edges its points add up to it, and radii of points are means.
#[test]
fn a_composite_triangle_encloses_its_parts_and_their_revolution() {
    const H: f64 = 1e-5;
    let mut numbers = Spread::new(32);
    for round in 0..200 {
        let mut x: [[f64; 2]; 6] = distorted("tri6", if round % 2 == 0 { 0.0 } else { 0.9 }, 5.0, &mut numbers).try_into().unwrap();
        let least = x.iter().fold(f64::INFINITY, |least, x| least.min(x[0]));
        x.iter_mut().for_each(|x| x[0] -= least);
        for state in ["plane_strain", "axisymmetric"].map(|name| StressState::named(name).unwrap()) {
            let depth = |radius: f64| if state.is_axisymmetric { std::f64::consts::TAU * radius } else { 1.0 };
            let of_parts = |x: &[[f64; 2]; 6]| -> f64 {
                let part = |nodes: [usize; 3]| nodes.map(|k| x[k]);
                let volume = |x: [[f64; 2]; 3]| shoelace(&x) * depth((x[0][0] + x[1][0] + x[2][0]) / 3.0);
                [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]].map(part).map(volume).iter().sum()
            };
            let (volume, slope) = Tri6::enclosed(&x, state);
            let size = of_parts(&x);
            assert!((volume / size - 1.0).abs() < 1e-13, "{volume} {size}");
            let masses = Tri6::corner_volumes(&x, state.is_axisymmetric).unwrap();
            assert!((masses.iter().sum::<f64>() / size - 1.0).abs() < 1e-13 && masses.iter().all(|&mass| mass > 0.0));
            for (a, d) in (0..12).map(|k| (k / 2, k % 2)) {
                let at = |sign: f64| {
                    let mut moved = x;
                    moved[a][d] += sign * H;
                    of_parts(&moved)
                };
                let by_differences = (at(1.0) - at(-1.0)) / (2.0 * H);
                assert!((slope[a][d] - by_differences).abs() < 1e-7 * (1.0 + by_differences.abs()), "{} {by_differences}", slope[a][d]);
            }
            let determinants = Tri6::gradients(&x).map(|g| Dim::<2>::determinant(&g));
            let own = |p: usize| {
                let shares = Tri6::shares(p);
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                determinants[p] / 6.0 * depth((0..6).map(|a| shares[a] * x[a][0]).sum())
            };
            assert!(round % 2 == 1 || ((0..3).map(own).sum::<f64>() / size - 1.0).abs() < 1e-13, "Pappus");
        }
    }
}

fn volume_is_exact<E: Element<2, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(2);
    for _ in 0..200 {
        let x = random_element::<E, N, P>(&mut numbers);
        let jacobians = E::gradients(&x);
        let of_points: f64 = (0..P).map(|p| E::WEIGHTS[p] * Dim::<2>::determinant(&jacobians[p])).sum();
        let volume = if E::COMPOSITE { E::enclosed(&x, StressState::SPACE).0 } else { of_points };
        let expected = shoelace(&around(&x));
        assert!((volume / expected - 1.0).abs() < 1e-13, "{}: {volume} for {expected}", E::KIND.name);
        assert!(jacobians.iter().all(|j| Dim::<2>::determinant(j) > 0.0));
    }
}
every_element!(the_volume_of_a_distorted_element_is_that_of_its_polygon, volume_is_exact);

fn divergence_is_the_adjoint<E: Element<2, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(3);
    for _ in 0..100 {
        let nodal = random_nodal::<N>(&mut numbers);
        let flux: [Matrix<f64, 2>; P] = std::array::from_fn(|_| [numbers.vector(1.0), numbers.vector(1.0)]);
        let (gradients, divergence) = (E::gradients(&nodal), E::divergence(&flux));
        let at_points: f64 =
            (0..P).map(|p| (0..2).map(|i| (0..2).map(|k| gradients[p][i][k] * flux[p][i][k]).sum::<f64>()).sum::<f64>()).sum();
        let at_nodes: f64 = (0..N).map(|a| (0..2).map(|i| nodal[a][i] * divergence[a][i]).sum::<f64>()).sum();
        assert!((at_points - at_nodes).abs() < 1e-14, "{}: {at_points} and {at_nodes}", E::KIND.name);
        // Nothing is pushed as a whole.
        assert!((0..2).all(|i| divergence.iter().map(|f| f[i]).sum::<f64>().abs() < 1e-14));
    }
}
every_element!(the_divergence_is_the_exact_transpose_of_the_gradients, divergence_is_the_adjoint);

fn linear_fields<E: Element<2, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(4);
    for _ in 0..100 {
        let x = random_element::<E, N, P>(&mut numbers);
        let (g, c) = ([numbers.vector(1.0), numbers.vector(1.0)], numbers.vector(1.0));
        let nodal = x.map(|x| [g[0][0] * x[0] + g[0][1] * x[1] + c[0], g[1][0] * x[0] + g[1][1] * x[1] + c[1]]);
        let (jacobians, natural) = (E::gradients(&x), E::gradients(&nodal));
        for p in 0..P {
            let determinant = Dim::<2>::determinant(&jacobians[p]);
            let inverse = Dim::<2>::adjugate(&jacobians[p]).map(|row| row.map(|value| value / determinant));
            let gradient = product(&natural[p], &inverse);
            for i in 0..2 {
                for k in 0..2 {
                    assert!((gradient[i][k] - g[i][k]).abs() < 1e-10, "{}: {gradient:?} for {g:?}", E::KIND.name);
                }
            }
        }
    }
}
every_element!(a_linear_field_has_its_gradient_in_any_element, linear_fields);
