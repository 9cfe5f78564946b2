//! What every registered element promises by itself: shape functions, gradients, their transpose, volume.

use crate::patches::{Spread, distorted, shoelace};
use embate_solver::element::{ELEMENTS, Element, ElementVisitor, with_element};
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

fn volume_is_exact<E: Element<2, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(2);
    for _ in 0..200 {
        let x = random_element::<E, N, P>(&mut numbers);
        let jacobians = E::gradients(&x);
        let volume: f64 = (0..P).map(|p| E::WEIGHTS[p] * Dim::<2>::determinant(&jacobians[p])).sum();
        let expected = shoelace(&x);
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
