//! Triangles with averaged nodal pressure do not lock: Cook's membrane near incompressibility, by the tangent
//! stiffness at rest.

use crate::patches::*;
use embate_solver::block::BlockInput;

/// Cook's membrane: (0,0) (48,44) (48,60) (0,44), `n` × `n` cells, quadrilaterals cut by the shorter diagonal
/// for triangles; with nodes between their corners half as many, so that the nodes are the same.
pub(crate) fn membrane(n: usize, corners: usize) -> Patch {
    if corners == 6 {
        let mut patch = membrane(n / 2, 3);
        patch.connectivity = with_middles(&mut patch.positions, &patch.connectivity);
        return patch;
    }
    let side = n + 1;
    let place = |k: usize| {
        let (s, t) = ((k % side) as f64 / n as f64, (k / side) as f64 / n as f64);
        [48.0 * s, (1.0 - t) * 44.0 * s + t * (44.0 + 16.0 * s)]
    };
    let cell = |k: usize| {
        let a = (k / n * side + k % n) as u32;
        [a, a + 1, a + 1 + side as u32, a + side as u32]
    };
    let connectivity = match corners {
        3 => (0..n * n).map(cell).flat_map(|[a, b, c, d]| [a, b, d, b, c, d]).collect(),
        _ => (0..n * n).flat_map(cell).collect(),
    };
    Patch { positions: (0..side * side).map(place).collect(), connectivity, inner: Vec::new() }
}

/// Solution of K u = f by elimination without pivots: K is positive.
pub(crate) fn solve(mut k: Vec<Vec<f64>>, mut f: Vec<f64>) -> Vec<f64> {
    for p in 0..f.len() {
        let (top, rest) = k.split_at_mut(p + 1);
        let pivot = &top[p];
        for (i, row) in rest.iter_mut().enumerate() {
            let factor = row[p] / pivot[p];
            if factor != 0.0 {
                row[p..].iter_mut().zip(&pivot[p..]).for_each(|(a, b)| *a -= factor * b);
                f[p + 1 + i] -= factor * f[p];
            }
        }
    }
    for p in (0..f.len()).rev() {
        let known: f64 = (p + 1..f.len()).map(|j| k[p][j] * f[j]).sum();
        f[p] = (f[p] - known) / k[p][p];
    }
    f
}

/// Deflection of the upper right corner under a unit shear force.
pub(crate) fn deflection(element: &str, law: &str, n: usize, poisson: f64) -> f64 {
    let (material, patch) = (material(law, poisson), membrane(n, nodes_of(element)));
    let whole = stiffness(|| Body::made(&BlockInput::new(element, &material, &patch.connectivity, &patch.positions)));
    let free: Vec<usize> = (0..whole.len()).filter(|i| patch.positions[i / 2][0] > 1e-9).collect();
    let is_at = |i: usize, place: [f64; 2]| (0..2).all(|d| (patch.positions[i / 2][d] - place[d]).abs() < 1e-9);
    let load = |i: usize| {
        let share = if is_at(i, [48.0, 44.0]) || is_at(i, [48.0, 60.0]) { 0.5 } else { 1.0 };
        if i % 2 == 1 && (patch.positions[i / 2][0] - 48.0).abs() < 1e-9 { share / n as f64 } else { 0.0 }
    };
    let k = free.iter().map(|&i| free.iter().map(|&j| 0.5 * (whole[i][j] + whole[j][i])).collect()).collect();
    let u = solve(k, free.iter().map(|&i| load(i)).collect());
    free.iter().zip(u).find(|(i, _)| **i % 2 == 1 && is_at(**i, [48.0, 60.0])).unwrap().1
}

#[test]
fn cooks_membrane_does_not_lock_with_averaged_nodal_pressure() {
    const POISSON: f64 = 0.4999;
    let fine = deflection("quad4", "elastic", 20, POISSON);
    for law in ["elastic", "neo_hookean"] {
        let of = |element: &str| deflection(element, law, 10, POISSON) / fine - 1.0;
        let (quad, full, tri, anp) = (of("quad4"), of("quad4_full"), of("tri3"), of("tri3_anp"));
        println!("{law}: quad4 {quad:.3}, quad4_full {full:.3}, tri3 {tri:.3}, tri3_anp {anp:.3} of the fine deflection {fine:.4}");
        // Springs of K + 4µ/3 against hourglass shapes would lock.
        for (element, error) in ["quad4_reduced", "quad4_reduced_assumed_strain"].map(|element| (element, of(element))) {
            println!("{law}: {element} {error:.3}");
            assert!(error.abs() < 0.1, "{law} {element}: {error}");
        }
        // On as many nodes as the others; it is softer than the body, not stiffer.
        let six = of("tri6");
        println!("{law}: tri6 {six:.4}");
        assert!(six > 0.0 && six < 0.1, "{law}: {six}");
        assert!(tri < -0.4 && full < -0.3, "{law}: the plain elements lock: {tri} {full}");
        assert!(anp.abs() < 0.1 && quad.abs() < 0.1, "{law}: {anp} {quad}");
    }
}

#[test]
fn a_compressible_membrane_is_the_same_for_all_elements() {
    let fine = deflection("quad4", "elastic", 20, 0.3);
    for element in ["quad4", "tri6", "tri3_anp", "quad4_reduced", "quad4_reduced_assumed_strain"] {
        let error = deflection(element, "elastic", 14, 0.3) / fine - 1.0;
        println!("{element}: {error:.4}");
        assert!(error.abs() < 0.06, "{element}: {error}");
    }
}

/// Cook's membrane with Young's modulus 1.125: its corner. From above these numbers go towards 17.3 at ν =
/// 0.4999 and 20.5 at 0.3, those of quadrilaterals from below.
#[test]
fn cooks_membrane_of_six_node_triangles_has_the_numbers_of_the_manual() {
    for (poisson, expected) in [(0.4999, [18.269, 17.696]), (0.3, [21.203, 20.788])] {
        let of = |element: &str, n: usize| deflection(element, "elastic", n, poisson) * YOUNG / 1.125;
        let [coarse, fine] = [4, 8].map(|n| of("tri6", 2 * n));
        println!(
            "ν = {poisson}: tri6 of 4 and 8 cells {coarse:.3} {fine:.3}, quad4 of 8 and 16 {:.3} {:.3}",
            of("quad4", 8),
            of("quad4", 16)
        );
        // As an independent assembly of the same element has them.
        assert!((coarse / expected[0] - 1.0).abs() < 1e-4 && (fine / expected[1] - 1.0).abs() < 1e-4, "{coarse} {fine}");
    }
}
