//! What every registered element in 3D promises, with every law: shape functions, constant strain, rigid
//! motion, stiffness, masses, energy, momentum, the stable step, and the same bits on every instruction set.

use crate::blocks::largest;
use crate::long::is_long;
use crate::patches::{
    Body, DENSITY, Patch, Spread, YOUNG, eigenvalues, every_pair_of, frequency_squared, is_damped, material, nodes_of, solids, stiffness,
};
use crate::solids::*;
use embate_lanes::{Level, Team};
use embate_solver::block::{BlockInput, make};
use embate_solver::element::{
    ELEMENTS, ELEMENTS_OF_SPACE, Element, ElementKind, ElementOptions, ElementVisitor, Pulls, Tet10, elements_of, map_of, registry,
    with_element,
};
use embate_solver::material::variable::PLASTIC_STRAIN;
use embate_solver::stress_state::StressState;
use embate_solver::tensor::{Matrix, product};

/// A test that calls `$check::<E, N, P>()` for every element of the registry.
macro_rules! every_element {
    ($name:ident, $check:ident) => {
        #[test]
        fn $name() {
            struct Check;
            impl ElementVisitor<3> for Check {
                type Output = ();
                fn visit<E: Element<3, N, P>, const N: usize, const P: usize>(self) {
                    $check::<E, N, P>();
                }
            }
            for kind in ELEMENTS_OF_SPACE {
                with_element(kind.name, Check).unwrap();
            }
        }
    };
}

fn every_solid_pair(check: impl FnMut(&'static str, &'static str)) {
    every_pair_of(ELEMENTS_OF_SPACE, check);
}

/// Every element with every law.
fn all_pairs(mut check: impl FnMut(&'static ElementKind, &'static str)) {
    ELEMENTS_OF_SPACE.iter().for_each(|element| solids().for_each(|law| check(element, law.name)));
}

fn element_of<E: Element<3, N, P>, const N: usize, const P: usize>(numbers: &mut Spread) -> [Vector; N] {
    distorted(E::KIND.name, 0.7, 10.0, numbers).try_into().unwrap()
}

#[test]
fn each_dimension_has_its_own_elements() {
    assert_eq!(elements_of(2).len(), ELEMENTS.len());
    assert_eq!(elements_of(3).len(), ELEMENTS_OF_SPACE.len());
    assert!(elements_of(1).is_empty());
    assert!(elements_of(2).iter().all(|kind| kind.dimension == 2) && elements_of(3).iter().all(|kind| kind.dimension == 3));
    let mut names: Vec<&str> = registry().iter().map(|kind| kind.name).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert!(names.len() == count && ELEMENTS_OF_SPACE.iter().all(|kind| names.contains(&kind.name)));
}

#[test]
fn a_block_of_another_dimension_or_in_a_state_of_2d_is_not_made() {
    let (x, material) = (reference_nodes("tet4"), material("elastic", 0.3));
    let input = BlockInput::new("tet4", &material, &[0, 1, 2, 3], &x);
    assert!(make(&input).is_some());
    assert!(make(&BlockInput { stress_state: "plane_stress", ..input }).is_none());
    assert!(make(&BlockInput { element: "quad4", ..input }).is_none());
    let flat: Vec<[f64; 2]> = x.iter().map(|x| [x[0], x[1]]).collect();
    assert!(make(&BlockInput::new("tet4", &material, &[0, 1, 2, 3], &flat)).is_none());
}

fn partition_of_unity<E: Element<3, N, P>, const N: usize, const P: usize>() {
    assert_eq!((E::KIND.nodes(), E::KIND.dimension), (N, 3));
    let mut numbers = Spread::new(1);
    for a in 0..N {
        let shape = E::shape(E::NODES[a]);
        assert!((0..N).all(|b| (shape[b] - f64::from(u8::from(a == b))).abs() < 1e-15), "{} node {a}: {shape:?}", E::KIND.name);
    }
    for _ in 0..100 {
        let weights: [f64; N] = std::array::from_fn(|_| numbers.between(0.0, 1.0));
        let total: f64 = weights.iter().sum();
        let mean = |by: &[f64; N]| -> Vector { std::array::from_fn(|d| (0..N).map(|a| by[a] * E::NODES[a][d]).sum()) };
        let at = mean(&weights.map(|w| w / total));
        let shape = E::shape(at);
        assert!((shape.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        // The map of the element onto itself is the identity.
        assert!((0..3).all(|d| (mean(&shape)[d] - at[d]).abs() < 1e-14), "{} at {at:?}", E::KIND.name);
    }
}
every_element!(shape_functions_sum_to_one_and_are_one_at_their_own_node_only, partition_of_unity);

fn gradients_by_differences<E: Element<3, N, P>, const N: usize, const P: usize>() {
    const H: f64 = 1e-5;
    if E::COMPOSITE {
        return; // a projection, see below
    }
    for (a, i) in (0..N).flat_map(|a| (0..3).map(move |i| (a, i))) {
        let mut nodal = [[0.0; 3]; N];
        nodal[a][i] = 1.0;
        for (p, gradient) in E::gradients(&E::natural(&nodal)).iter().enumerate() {
            for k in 0..3 {
                let at = |sign: f64| {
                    let mut natural = E::POINTS[p];
                    natural[k] += sign * H;
                    E::shape(natural)[a]
                };
                let expected = (at(1.0) - at(-1.0)) / (2.0 * H);
                assert!((gradient[i][k] - expected).abs() < 1e-9, "{}: node {a}, point {p}, ∂/∂ξ_{k}: {gradient:?}", E::KIND.name);
                assert!((0..3).all(|j| j == i || gradient[j][k] == 0.0));
            }
        }
    }
}
every_element!(gradients_are_the_differences_of_the_shape_functions, gradients_by_differences);

/// Of an element with straight edges the L² projection on the linear functions of the gradients that are
/// constant in its twelve tetrahedra, by their integrals: A g = r, A_ab = ∫ λ_a λ_b, r_a = Σ_s V_s λ_a(s)
/// ∇u|_s.
#[test]
fn gradients_of_a_composite_element_are_projections_of_those_of_its_parts() {
    let mut numbers = Spread::new(31);
    let x: [Vector; 10] = Tet10::NODES;
    let middle: Vector = std::array::from_fn(|d| x[4..].iter().map(|x| x[d]).sum::<f64>() / 6.0);
    let mut parts: Vec<[usize; 4]> = vec![[0, 4, 6, 7], [1, 4, 5, 8], [2, 5, 6, 9], [3, 7, 8, 9]];
    parts.extend([[4, 6, 7, 10], [4, 5, 8, 10], [5, 6, 9, 10], [7, 8, 9, 10], [4, 5, 6, 10], [4, 7, 8, 10], [5, 8, 9, 10], [6, 7, 9, 10]]);
    for _ in 0..20 {
        let mut u: Vec<Vector> = (0..10).map(|_| numbers.in_3d(1.0)).collect();
        u.push(std::array::from_fn(|d| u[4..10].iter().map(|u| u[d]).sum::<f64>() / 6.0));
        let place = |k: usize| if k == 10 { middle } else { x[k] };
        let mut moments = [[[0.0; 3]; 3]; 4];
        let mut volume = 0.0;
        for part in &parts {
            let edges: Gradient = std::array::from_fn(|e| plus(place(part[e + 1]), -1.0, place(part[0])));
            let changes: Gradient = std::array::from_fn(|e| plus(u[part[e + 1]], -1.0, u[part[0]]));
            let determinant = dot(edges[0], cross(edges[1], edges[2]));
            // Dual vectors of the edges: ∇u = Σ_e Δu_e ⊗ dual_e.
            let dual =
                [cross(edges[1], edges[2]), cross(edges[2], edges[0]), cross(edges[0], edges[1])].map(|d| d.map(|d| d / determinant));
            let own = determinant.abs() / 6.0;
            volume += own;
            let centre: Vector = std::array::from_fn(|d| part.iter().map(|&k| place(k)[d]).sum::<f64>() / 4.0);
            let lambda = [1.0 - centre.iter().sum::<f64>(), centre[0], centre[1], centre[2]];
            for (a, i, k) in (0..4).flat_map(|a| (0..9).map(move |k| (a, k / 3, k % 3))) {
                moments[a][i][k] += own * lambda[a] * (0..3).map(|e| changes[e][i] * dual[e][k]).sum::<f64>();
            }
        }
        assert!((volume - 1.0 / 6.0).abs() < 1e-15);
        // ∫ λ_a λ_b = V (1 + δ_ab) / 20, whose inverse is (20 δ_ab − 4) / V.
        let nodal: [Vector; 10] = std::array::from_fn(|k| u[k]);
        for (gradient, at) in Tet10::gradients(&nodal).iter().zip(Tet10::POINTS) {
            let lambda = [1.0 - at.iter().sum::<f64>(), at[0], at[1], at[2]];
            for (i, k) in (0..9).map(|k| (k / 3, k % 3)) {
                let all: f64 = (0..4).map(|a| moments[a][i][k]).sum();
                let expected: f64 = (0..4).map(|a| lambda[a] * (20.0 * moments[a][i][k] - 4.0 * all) / volume).sum();
                assert!((gradient[i][k] - expected).abs() < 1e-14, "{} {expected}", gradient[i][k]);
            }
        }
    }
}

fn volume_is_exact<E: Element<3, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(2);
    for _ in 0..200 {
        let x = element_of::<E, N, P>(&mut numbers);
        let map = map_of::<E, f64, 3, N, P>(&x);
        let of_points: f64 = (0..P).map(|p| E::WEIGHTS[p] * map.determinants[p]).sum();
        let own = if E::COMPOSITE { E::enclosed(&x, StressState::SPACE).0 } else { of_points };
        assert!((own / volume(&x) - 1.0).abs() < 1e-12, "{}: {own} for {}", E::KIND.name, volume(&x));
    }
}
every_element!(the_volume_of_an_element_with_warped_faces_is_that_of_its_surface, volume_is_exact);

fn mean_is_the_slope_of_the_volume<E: Element<3, N, P>, const N: usize, const P: usize>() {
    const H: f64 = 1e-5;
    let mut numbers = Spread::new(22);
    for _ in 0..20 {
        let x = element_of::<E, N, P>(&mut numbers);
        let size = volume(&x).cbrt();
        let map = map_of::<E, f64, 3, N, P>(&x);
        // A pressure of one pushes with ∂V/∂x_a.
        let transposed = |m: &Gradient, w: f64| -> Gradient { std::array::from_fn(|i| std::array::from_fn(|k| w * m[k][i])) };
        let flux: [Gradient; P] = std::array::from_fn(|p| transposed(&map.adjugates[p], E::WEIGHTS[p]));
        let pulls = Pulls { warp: transposed(&map.warped, E::WEIGHTS[0]), rest: [0.0; 3] };
        let forces = match (E::COMPOSITE, E::WARPED) {
            (true, _) => E::enclosed(&x, StressState::SPACE).1,
            (_, true) => E::divergence_warped(&flux, &pulls),
            _ => E::divergence(&flux),
        };
        for (a, d) in (0..N).flat_map(|a| (0..3).map(move |d| (a, d))) {
            let at = |sign: f64| {
                let mut moved = x;
                moved[a][d] += sign * H * size;
                volume(&moved)
            };
            let slope = (at(1.0) - at(-1.0)) / (2.0 * H * size);
            assert!((forces[a][d] - slope).abs() < 1e-7 * size * size * 10.0, "{} {a} {d}: {} {slope}", E::KIND.name, forces[a][d]);
        }
    }
}
every_element!(a_pressure_pushes_the_nodes_with_the_slope_of_the_volume, mean_is_the_slope_of_the_volume);

fn divergence_is_the_adjoint<E: Element<3, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(3);
    for _ in 0..100 {
        let nodal: [Vector; N] = std::array::from_fn(|_| numbers.in_3d(1.0));
        let flux: [Matrix<f64, 3>; P] = std::array::from_fn(|_| std::array::from_fn(|_| numbers.in_3d(1.0)));
        let warp: Matrix<f64, 3> = std::array::from_fn(|_| numbers.in_3d(if E::WARPED { 1.0 } else { 0.0 }));
        let power = |a: &Matrix<f64, 3>, b: &Matrix<f64, 3>| (0..3).map(|i| dot(a[i], b[i])).sum::<f64>();
        let gradients = E::gradients(&E::natural(&nodal));
        let straight: f64 = (0..P).map(|p| power(&gradients[p], &flux[p])).sum();
        let at_points = straight + power(&E::warp(&E::natural(&nodal)), &warp);
        let at_nodes = |forces: &[Vector; N]| (0..N).map(|a| dot(nodal[a], forces[a])).sum::<f64>();
        let all = E::divergence_warped(&flux, &Pulls { warp, rest: [0.0; 3] });
        assert!((at_points - at_nodes(&all)).abs() < 1e-12, "{}: {at_points}", E::KIND.name);
        assert!((straight - at_nodes(&E::divergence(&flux))).abs() < 1e-12, "{}: {straight}", E::KIND.name);
        // Nothing is pushed as a whole.
        assert!((0..3).all(|i| all.iter().map(|f| f[i]).sum::<f64>().abs() < 1e-12));
    }
}
every_element!(the_divergence_is_the_exact_transpose_of_the_gradients, divergence_is_the_adjoint);

fn linear_fields<E: Element<3, N, P>, const N: usize, const P: usize>() {
    let mut numbers = Spread::new(4);
    for _ in 0..100 {
        let x = element_of::<E, N, P>(&mut numbers);
        let (g, c): (Gradient, Vector) = (std::array::from_fn(|_| numbers.in_3d(1.0)), numbers.in_3d(1.0));
        let nodal = x.map(|x| plus(apply(&g, x), 1.0, c));
        let (map, natural, warp) = (map_of::<E, f64, 3, N, P>(&x), E::gradients(&E::natural(&nodal)), E::warp(&E::natural(&nodal)));
        for p in 0..P {
            let (straight, more) = (product(&natural[p], &map.adjugates[p]), product(&warp, &map.warped));
            for k in 0..9 {
                let more = if E::WARPED { more[k / 3][k % 3] } else { 0.0 };
                let gradient = (straight[k / 3][k % 3] + more) / map.determinants[p];
                assert!((gradient - g[k / 3][k % 3]).abs() < 1e-10, "{}: {gradient:?} for {g:?}", E::KIND.name);
            }
        }
    }
}
every_element!(a_linear_field_has_its_gradient_in_any_element, linear_fields);

#[test]
fn a_distorted_patch_in_uniform_strain_has_uniform_stress_and_no_force_on_inner_nodes() {
    every_solid_pair(|element, law| {
        let patch = patch(element, 3, 0.25);
        let mut body = Body::of(element, &material(law, 0.3), &patch);
        let mut numbers = Spread::new(11);
        for step in 0..10 {
            let (f, shift) = (near_one(0.02, &mut numbers), numbers.in_3d(1.0));
            body.map(|x| plus(apply(&f, x), 1.0, shift));
            let first = body.block.state(0).stress;
            let size = largest(&first);
            assert!(size > 1e-4 * YOUNG, "{element} {law}: there is stress");
            for k in 1..body.block.elements() {
                let stress = body.block.state(k).stress;
                assert!((0..6).all(|c| (stress[c] - first[c]).abs() < 1e-11 * YOUNG), "{element} {law} step {step}: {stress:?} {first:?}");
            }
            let forces = body.forces();
            let (outer, inner) = (largest(forces.iter().flatten()), largest(patch.inner.iter().flat_map(|&node| &forces[node])));
            assert!(outer > 0.1 * size && inner < 1e-11 * YOUNG, "{element} {law} step {step}: {inner} of {outer}");
        }
    });
}

/// A patch that has been brought under stress (below yield where there is one).
fn prestressed(element: &str, law: &str) -> Body<3> {
    let mut body = Body::of(element, &material(law, 0.3), &patch(element, 2, 0.2));
    for _ in 0..10 {
        body.map(|[x, y, z]| [x * 1.0003 + 0.0002 * y, y * 0.9998 + 1e-5 * x * y - 1e-4 * z, z * 1.0001 + 2e-5 * x * z]);
    }
    body.map(|x| x); // dampers of hourglass control come to rest
    body
}

#[test]
fn a_rigid_translation_changes_no_force() {
    every_solid_pair(|element, law| {
        let mut body = prestressed(element, law);
        let before = body.forces();
        assert!(largest(before.iter().flatten()) > 2e-4 * YOUNG);
        for _ in 0..10 {
            body.map(|x| plus(x, 1.0, [3.0, -2.0, 1.0]));
        }
        for (a, b) in body.forces().iter().zip(&before) {
            assert!((0..3).all(|d| (a[d] - b[d]).abs() < 1e-11 * YOUNG), "{element} {law}");
        }
    });
}

#[test]
fn stress_and_forces_turn_with_the_body() {
    const STEPS: u32 = 180;
    every_solid_pair(|element, law| {
        let mut body = prestressed(element, law);
        let (start, forces, energy) = (body.block.state(0).stress, body.forces(), body.energy());
        let positions = body.positions.clone();
        for step in 1..=STEPS {
            let q = rotation([1.0, -0.5, 2.0], std::f64::consts::TAU * f64::from(step) / f64::from(STEPS));
            body.move_to(&positions.iter().map(|&x| apply(&q, x)).collect::<Vec<_>>());
            let (stress, expected) = (body.block.state(0).stress, turned(start, &q));
            assert!((0..6).all(|k| (stress[k] - expected[k]).abs() < 1e-8 * YOUNG), "{element} {law} step {step}: {stress:?} {expected:?}");
            for (f, &f0) in body.forces().iter().zip(&forces) {
                assert!((0..3).all(|d| (f[d] - apply(&q, f0)[d]).abs() < 1e-8 * YOUNG), "{element} {law} step {step}");
            }
        }
        assert!((body.energy() - energy).abs() < 1e-9 * energy, "{element} {law}");
    });
}

#[test]
fn a_body_without_stress_moves_as_a_whole_without_force_however_far() {
    every_solid_pair(|element, law| {
        let mut body = Body::of(element, &material(law, 0.3), &patch(element, 2, 0.2));
        let mut numbers = Spread::new(19);
        for step in 0..30 {
            let (q, shift) = (rotation(numbers.in_3d(1.0), numbers.between(0.0, 2.5)), numbers.in_3d(1.0));
            body.map(|x| plus(apply(&q, x), 1.0, shift));
            let most = largest(body.forces().iter().flatten());
            assert!(most < 1e-9 * YOUNG, "{element} {law} step {step}: {most}");
        }
    });
}

#[test]
fn the_stiffness_is_symmetric_and_only_the_six_rigid_modes_cost_nothing() {
    every_solid_pair(|element, law| {
        if is_damped(element) {
            return;
        }
        let mut numbers = Spread::new(12);
        for _ in 0..3 {
            let x = distorted(element, 0.5, 3.0, &mut numbers);
            let k = stiffness(|| Body::single(element, &material(law, 0.3), &x));
            let n = k.len();
            let size = largest(k.iter().flatten());
            let skew = (0..n * n).map(|at| (k[at / n][at % n] - k[at % n][at / n]).abs()).fold(0.0, f64::max);
            assert!(skew < 1e-6 * size, "{element} {law}: skew part {skew} of {size}");
            let values = eigenvalues(k);
            assert!(values[..6].iter().all(|v| v.abs() < 1e-6 * size), "{element} {law}: {values:?}");
            assert!(values[6] > 1e-4 * size, "{element} {law}: {values:?}");
        }
    });
}

#[test]
fn one_point_alone_is_blind_to_twelve_hourglass_shapes_and_no_more() {
    let mut numbers = Spread::new(23);
    for element in ["hex8_reduced", "hex8_reduced_viscous", "hex8_reduced_assumed_strain"] {
        let (x, material) = (distorted(element, 0.5, 3.0, &mut numbers), material("elastic", 0.3));
        let connectivity: Vec<u32> = (0..8).collect();
        let options = ElementOptions { hourglass: Some(0.0) };
        let values =
            eigenvalues(stiffness(|| Body::made(&BlockInput { options, ..BlockInput::new(element, &material, &connectivity, &x) })));
        let size = values[23];
        assert!(values[..18].iter().all(|v| v.abs() < 1e-6 * size) && values[18] > 1e-3 * size, "{element}: {values:?}");
    }
}

#[test]
fn corner_masses_are_positive_and_have_the_mass_and_its_centre() {
    for kind in ELEMENTS_OF_SPACE {
        let mut numbers = Spread::new(13);
        for _ in 0..50 {
            let x = distorted(kind.name, 0.8, 20.0, &mut numbers);
            let body = Body::single(kind.name, &material("elastic", 0.3), &x);
            let expected = DENSITY * volume(&x);
            assert!((body.masses().iter().sum::<f64>() / expected - 1.0).abs() < 1e-12, "{}", kind.name);
            assert!((body.block.mass(0) / expected - 1.0).abs() < 1e-12, "{}", kind.name);
            let size = x.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
            for (d, place) in centroid(&x).into_iter().enumerate() {
                let moment: f64 = body.masses().iter().zip(&x).map(|(m, x)| m * x[d]).sum();
                assert!((moment / expected - place).abs() < 1e-11 * size, "{}: row sums keep the centre", kind.name);
            }
            assert!(body.masses().iter().all(|&m| m > 0.05 * expected / kind.nodes() as f64), "{} {:?}", kind.name, body.masses());
        }
    }
}

/// A patch whose nodes have all been moved at random, in some steps.
fn shaken(element: &str, law: &str, patch: &Patch<3>, size: f64) -> Body<3> {
    let mut numbers = Spread::new(14);
    let bumps: Vec<Vector> = patch.positions.iter().map(|_| numbers.in_3d(size)).collect();
    let mut body = Body::of(element, &material(law, 0.3), patch);
    for step in 1..=5 {
        let to: Vec<_> = patch.positions.iter().zip(&bumps).map(|(&x, &u)| plus(x, f64::from(step), u)).collect();
        body.move_to(&to);
    }
    body
}

#[test]
fn corner_forces_do_the_work_that_the_energy_reports() {
    // −f·u = dU for any small motion u from a state of uneven stress. The force is the mean over the motion:
    // see the same test in 2D.
    every_solid_pair(|element, law| {
        if is_damped(element) {
            return;
        }
        let patch = patch(element, 2, 0.25);
        let mut numbers = Spread::new(20);
        let directions: Vec<Vector> = patch.positions.iter().map(|_| numbers.in_3d(1.0)).collect();
        let stressed = || shaken(element, law, &patch, 0.01);
        let power = |body: &Body<3>| body.forces().iter().zip(&directions).map(|(&f, &u)| dot(f, u)).sum::<f64>();
        let change = |h: f64| {
            let mut body = stressed();
            let to: Vec<_> = body.positions.iter().zip(&directions).map(|(&x, &u)| plus(x, h, u)).collect();
            body.move_to(&to);
            (body.energy(), power(&body))
        };
        let h = 1e-6;
        let ((energy_after, power_after), (energy_before, power_before)) = (change(h), change(-h));
        let slope = (energy_after - energy_before) / (2.0 * h);
        let power = 0.5 * power(&stressed()) + 0.25 * (power_after + power_before);
        assert!((slope + power).abs() < 1e-5 * power.abs().max(YOUNG * 0.01), "{element} {law}: {slope} against {}", -power);
    });
}

#[test]
fn hourglass_control_by_a_potential_is_the_slope_of_its_energy_and_gives_back_all_of_it() {
    ["hex8_reduced", "hex8_reduced_assumed_strain"].into_iter().for_each(is_the_slope_of_its_energy);
}

fn is_the_slope_of_its_energy(element: &str) {
    let patch = patch(element, 2, 0.2);
    let made = |coefficient: f64| {
        let options = ElementOptions { hourglass: Some(coefficient) };
        let material = material("neo_hookean", 0.3);
        Body::made(&BlockInput { options, ..BlockInput::new(element, &material, &patch.connectivity, &patch.positions) })
    };
    let mut numbers = Spread::new(24);
    let mut bumps = || -> Vec<Vector> { patch.positions.iter().map(|_| numbers.in_3d(0.2)).collect() };
    let (there, directions) = (bumps(), bumps());
    let q = rotation([1.0, 2.0, 3.0], 2.0);
    let place = |h: f64| -> Vec<Vector> {
        (0..there.len()).map(|a| apply(&q, plus(plus(patch.positions[a], 1.0, there[a]), h, directions[a]))).collect()
    };
    let at = |coefficient: f64, h: f64| {
        let mut body = made(coefficient);
        body.move_to(&place(h));
        body
    };
    let h = 1e-5;
    let slope = (at(0.1, h).report.hourglass - at(0.1, -h).report.hourglass) / (2.0 * h);
    let (with, without) = (at(0.1, 0.0), at(0.0, 0.0));
    let force =
        with.forces().iter().zip(&without.forces()).zip(&directions).map(|((&a, &b), &u)| dot(plus(a, -1.0, b), apply(&q, u))).sum::<f64>();
    assert!(with.report.hourglass > 0.0 && without.report.hourglass == 0.0);
    assert!((slope + force).abs() < 1e-7 * slope.abs(), "{element}: {slope} and {force}");
    let mut back = at(0.1, 0.0);
    back.move_to(&patch.positions.iter().map(|&x| apply(&q, x)).collect::<Vec<_>>());
    assert!(back.report.hourglass < 1e-25 * YOUNG, "{}", back.report.hourglass);
    assert!(largest(back.forces().iter().flatten()) < 1e-11 * YOUNG);
}

#[test]
fn forces_of_elements_have_no_sum_and_no_moment() {
    all_pairs(|element, law| {
        let name = element.name;
        let mut body = shaken(name, law, &patch(name, 2, 0.25), 0.02);
        body.block.keep_forces();
        let to = body.positions.clone();
        body.move_to(&to.iter().map(|&[x, y, z]| [x + 0.01 * y * z, y - 0.01 * x * z, z + 0.02 * x * y]).collect::<Vec<_>>());
        let forces = body.forces();
        let size = largest(forces.iter().flatten());
        let sum = forces.iter().fold([0.0; 3], |sum, &f| plus(sum, 1.0, f));
        let moment = forces.iter().zip(&body.positions).fold([0.0; 3], |sum, (&f, &x)| plus(sum, 1.0, cross(x, f)));
        assert!(size > 1e-3 * YOUNG, "{name} {law}");
        assert!(
            largest(&sum) < 1e-12 * size * 27.0 && largest(&moment) < 1e-12 * size * 81.0,
            "{name} {law}: {sum:?} {moment:?} of {size}"
        );
    });
}

/// Largest ω² dt²/4 over random elements; `later` moves the element from its initial form, in which it got
/// its masses.
fn worst_step(element: &str, law: &str, roughness: f64, later: impl Fn(&[Vector], &mut Spread) -> Vec<Vector>) -> f64 {
    let mut numbers = Spread::new(15);
    let mut worst = 0.0f64;
    for round in 0..40 {
        let material = material(law, [-0.5, 0.0, 0.3, 0.499][round % 4]);
        let x = distorted(element, roughness, 20.0, &mut numbers);
        let y = later(&x, &mut numbers);
        let make_body = || {
            let mut body = Body::single(element, &material, &x);
            body.move_to(&y);
            body
        };
        let body = make_body();
        let ratio = frequency_squared(&stiffness(make_body), &body.masses()) * body.block.time_step_squared(0) / 4.0;
        assert_eq!(body.block.time_step_squared(0), body.report.time_step_squared);
        worst = worst.max(ratio);
    }
    worst
}

#[test]
fn the_stable_step_bounds_the_largest_frequency() {
    every_solid_pair(|element, law| {
        for (roughness, name) in [(0.0, "straight"), (0.3, "moderate"), (0.8, "extreme")] {
            let worst = worst_step(element, law, roughness, |x, _| x.to_vec());
            println!("{element:<20} {law:<20} {name:<15} worst ω² dt²/4 = {worst:.4}");
            assert!(worst < 1.0 + 1e-5, "{element} {law} {name}: {worst}");
            assert!(worst > 0.8 || roughness > 0.0, "{element} {law} {name}: {worst} wastes steps");
        }
        // Under large strain the stress itself is stiff: see the same test in 2D.
        let worst = worst_step(element, law, 0.5, |x, numbers| {
            let f = near_one(0.2, numbers);
            x.iter().map(|&x| apply(&f, x)).collect()
        });
        println!("{element:<20} {law:<20} strained        worst ω² dt²/4 = {worst:.4}");
        assert!(worst < 1.2, "{element} {law} strained: {worst}");
    });
}

#[test]
fn the_stable_step_of_a_cube_and_of_a_regular_tetrahedron_is_nearly_exact() {
    for kind in ELEMENTS_OF_SPACE {
        for poisson in [-0.5, 0.0, 0.3, 0.45, 0.499] {
            let regular = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]];
            let equilateral = |h: f64| [[0.0, 0.0, h], [1.0, 0.0, h], [0.5, 0.75f64.sqrt(), h]];
            let x: Vec<Vector> = match kind.nodes() {
                4 => regular.to_vec(),
                10 => {
                    let mut x = regular.to_vec();
                    with_middles(&mut x, &[0, 1, 2, 3]);
                    x
                }
                6 => [equilateral(0.0), equilateral(0.8)].concat(),
                _ => reference_nodes(kind.name),
            };
            let law = material("elastic", poisson);
            let body = Body::single(kind.name, &law, &x);
            let exact = frequency_squared(&stiffness(|| Body::single(kind.name, &law, &x)), &body.masses());
            let ratio = (exact * body.block.time_step_squared(0) / 4.0).sqrt();
            println!("{:<20} ν = {poisson:<6} step over the exact one: {ratio:.4}", kind.name);
            assert!(ratio < 1.0 + 1e-6 && ratio > 0.9, "{} {poisson}: {ratio}", kind.name);
        }
    }
}

#[test]
fn the_stable_step_bounds_the_frequencies_of_a_strained_body() {
    every_solid_pair(|element, law| {
        let mut numbers = Spread::new(18);
        let mut worst = 0.0f64;
        for round in 0..if is_long() { 4 } else { 2 } {
            let material = material(law, [0.3, 0.499, -0.5, 0.0][round]);
            let (f, stretch) = (near_one(0.2, &mut numbers), numbers.between(0.3, 1.0));
            let mut patch = patch(element, 2, 0.2);
            patch.positions.iter_mut().for_each(|x| x[1] *= stretch);
            let make_body = || {
                let mut body = Body::of(element, &material, &patch);
                body.map(|x| apply(&f, x));
                body
            };
            let body = make_body();
            worst = worst.max(frequency_squared(&stiffness(make_body), &body.masses()) * body.report.time_step_squared / 4.0);
        }
        println!("{element:<20} {law:<20} worst ω² dt²/4 = {worst:.4}");
        assert!(worst < 1.0, "{element} {law}: {worst}");
    });
}

#[test]
fn the_stable_step_holds_when_an_element_takes_another_form_than_its_masses() {
    for kind in ELEMENTS_OF_SPACE {
        let mut numbers = Spread::new(16);
        let material = material("elastic", 0.3);
        let mut worst = 0.0f64;
        for _ in 0..60 {
            let (x, y) = (distorted(kind.name, 0.8, 5.0, &mut numbers), distorted(kind.name, 0.8, 5.0, &mut numbers));
            let mut body = Body::single(kind.name, &material, &x);
            let masses: Vec<f64> = body.masses();
            body.move_to(&y);
            // The stiffness of the new form without the stress that the way there has left.
            let k = stiffness(|| Body::single(kind.name, &material, &y));
            worst = worst.max(frequency_squared(&k, &masses) * body.block.time_step_squared(0) / 4.0);
        }
        println!("{}: {worst:.4}", kind.name);
        assert!(worst < 1.0 + 1e-5, "{}: {worst}", kind.name);
    }
}

/// Everything that a block reports, as bits.
fn bits(body: &Body<3>) -> Vec<u64> {
    let report = body.report;
    let report = [report.time_step_squared, report.determinant, report.stored, report.dissipated, report.hourglass, report.viscous];
    let state = |k: usize| {
        let state = body.block.state(k);
        state.stress.into_iter().chain(state.variables).chain([state.energy_density, body.block.time_step_squared(k)])
    };
    let states = (0..body.block.elements()).flat_map(state);
    report.into_iter().chain(states).chain(body.slots.iter().flatten().copied()).map(f64::to_bits).collect()
}

#[test]
fn every_instruction_set_and_any_threads_give_the_same_bits_for_every_element_and_law() {
    all_pairs(|element, law| {
        let element = element.name;
        // More than one chunk, and a batch that is not full.
        let patch = patch(element, if nodes_of(element) == 8 { 9 } else { 6 }, 0.2);
        let run = |level: Level, threads: usize| {
            let material = material(law, 0.3);
            let input = BlockInput::new(element, &material, &patch.connectivity, &patch.positions);
            let mut body = Body::made(&BlockInput { viscosity: Some([0.06, 1.2]), ..input });
            (body.level, body.team) = (level, Team::new(threads));
            let mut numbers = Spread::new(17);
            for _ in 0..5 {
                let f = near_one(0.01, &mut numbers);
                let to: Vec<_> = body.positions.iter().map(|&x| plus(apply(&f, x), 1.0, numbers.in_3d(0.004))).collect();
                body.move_to(&to);
            }
            assert!(body.block.state(0).stress[0] != 0.0 && body.report.viscous > 0.0);
            assert!(!body.block.has(&PLASTIC_STRAIN) || body.report.dissipated > 0.0);
            bits(&body)
        };
        let reference = run(Level::SCALAR, 1);
        for level in Level::available() {
            assert!(run(level, 1) == reference, "{element} {law} {}", level.name());
        }
        assert!(run(Level::best(), 3) == reference, "{element} {law}, 3 threads");
    });
}

#[test]
fn a_block_pulls_without_its_eroded_elements() {
    every_solid_pair(|element, law| {
        let patch = patch(element, 4, 0.2);
        let mut body = Body::of(element, &material(law, 0.3), &patch);
        body.block.keep_forces();
        let to: Vec<_> = patch.positions.iter().map(|&[x, y, z]| [1.001 * x + 0.002 * y, 0.999 * y, z + 0.001 * x]).collect();
        body.move_to(&to);
        let (count, nodes) = (body.block.elements() as u32, nodes_of(element));
        let gone: Vec<u32> = (0..count).filter(|k| k % 3 == 0 || *k == count - 1).collect();
        let mut expected = vec![[0.0; 3]; to.len()];
        for k in (0..count).filter(|k| !gone.contains(k)) {
            for (corner, &node) in patch.connectivity[k as usize * nodes..][..nodes].iter().enumerate() {
                expected[node as usize] = plus(expected[node as usize], 1.0, body.block.force(k as usize, corner, &body.slots));
            }
        }
        let size = largest(expected.iter().flatten());
        assert!(size > 0.0);
        body.block.erode(&gone, embate_solver::block::NodalForces::new(&mut body.slots));
        let forces = body.forces();
        let worst = forces.iter().flatten().zip(expected.iter().flatten()).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(worst < 1e-12 * size, "{element} {law}: {worst} of {size}");
        body.move_to(&to);
        assert!(body.report.determinant > 0.0 && body.report.time_step_squared.is_finite() && body.report.stored.is_finite());
    });
}
