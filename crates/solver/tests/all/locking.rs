//! Elements in 3D do not lock: beams of one element through the thickness, Cook's membrane as a slab, a
//! pressed block that can hardly change its volume; by the tangent stiffness at rest, against closed forms
//! and the elements in 2D. The slab's frame is that of `nodal_pressure.rs`.

use crate::nodal_pressure::{deflection, membrane, solve};
use crate::patches::{Body, Patch, Spread, YOUNG, material, nodes_of, stiffness};
use crate::solids::{Vector, apply, distorted, plus, rotation, with_middles};
use embate_solver::block::BlockInput;

const ASSUMED: &str = "hex8_reduced_assumed_strain";

/// A patch of quadrilaterals as a slab of so many layers of this height.
fn slab(plane: &Patch, layers: usize, height: f64) -> Patch<3> {
    let count = plane.positions.len();
    let level = |k: usize| plane.positions.iter().map(move |&[x, y]| [x, y, k as f64 * height]);
    let cells = |k: usize| {
        plane
            .connectivity
            .chunks(4)
            .flat_map(move |cell| [k, k + 1].into_iter().flat_map(move |k| cell.iter().map(move |&a| a + (k * count) as u32)))
    };
    Patch { positions: (0..=layers).flat_map(level).collect(), connectivity: (0..layers).flat_map(cells).collect(), inner: Vec::new() }
}

/// Hexahedra cut into the cells of the element.
fn cut(mut patch: Patch<3>, element: &str) -> Patch<3> {
    let kuhn: &[[usize; 4]] = &[[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]];
    if [4, 10].contains(&nodes_of(element)) {
        patch.connectivity = patch.connectivity.chunks(8).flat_map(|cell| kuhn.iter().flatten().map(|&a| cell[a])).collect();
    }
    if nodes_of(element) == 10 {
        patch.connectivity = with_middles(&mut patch.positions, &patch.connectivity);
    }
    patch
}

/// Displacements under `load(position)` (a force on each node) where only what `is_free(position, direction)`
/// moves.
fn displaced(
    element: &str,
    law: &str,
    poisson: f64,
    patch: Patch<3>,
    is_free: impl Fn(Vector, usize) -> bool,
    load: impl Fn(Vector) -> Vector,
) -> Vec<Vector> {
    let (material, patch) = (material(law, poisson), cut(patch, element));
    let whole = stiffness(|| Body::made(&BlockInput::new(element, &material, &patch.connectivity, &patch.positions)));
    let free: Vec<usize> = (0..whole.len()).filter(|i| is_free(patch.positions[i / 3], i % 3)).collect();
    let k = free.iter().map(|&i| free.iter().map(|&j| 0.5 * (whole[i][j] + whole[j][i])).collect()).collect();
    let u = solve(k, free.iter().map(|&i| load(patch.positions[i / 3])[i % 3]).collect());
    let mut out = vec![[0.0; 3]; patch.positions.len()];
    free.iter().zip(u).for_each(|(&i, u)| out[i / 3][i % 3] = u);
    out
}

/// Cells on [0, length] × [0, width] × [0, height].
fn bricks([along, across, through]: [usize; 3], [length, width, height]: [f64; 3]) -> Patch<3> {
    let row = along + 1;
    let place = |k: usize| [(k % row) as f64 / along as f64 * length, (k / row) as f64 / across as f64 * width];
    let cell = |k: usize| {
        let a = (k / along * row + k % along) as u32;
        [a, a + 1, a + 1 + row as u32, a + row as u32]
    };
    let plane = Patch {
        positions: (0..row * (across + 1)).map(place).collect(),
        connectivity: (0..along * across).flat_map(cell).collect(),
        inner: Vec::new(),
    };
    slab(&plane, through, height / through as f64)
}

/// Energy of a beam of one element through, bent to a curvature, over that of the closed form; `free`: its
/// sides curve the other way.
fn bent(element: &str, poisson: f64, size: [f64; 3], along: usize, free: bool) -> f64 {
    const CURVATURE: f64 = 1e-6;
    let (material, beam) = (material("elastic", poisson), bricks([along, 1, 1], size));
    let mut body = Body::of(element, &material, &beam);
    let [length, width, height] = size;
    let (cross, up) = if free { (poisson, poisson) } else { (0.0, poisson / (1.0 - poisson)) };
    body.map(|[x, y, z]| {
        let (y, z) = (y - 0.5 * width, z - 0.5 * height);
        let rise = -0.5 * CURVATURE * (x * x + up * z * z - cross * y * y);
        [x + CURVATURE * x * z, y - cross * CURVATURE * y * z, z + rise]
    });
    let modulus = if free { YOUNG } else { YOUNG / (1.0 - poisson * poisson) };
    body.energy() / (0.5 * modulus * width * height.powi(3) / 12.0 * CURVATURE * CURVATURE * length)
}

#[test]
fn a_beam_of_one_brick_through_bends_as_beam_theory_says_with_free_and_with_held_sides() {
    for (poisson, size) in [(0.3, [10.0, 1.0, 1.0]), (0.0, [10.0, 2.0, 0.5]), (0.4999, [6.0, 0.7, 1.3]), (-0.4, [10.0, 1.0, 1.0])] {
        for free in [true, false] {
            let ratio = bent(ASSUMED, poisson, size, 6, free);
            assert!((ratio - 1.0).abs() < 1e-4, "ν = {poisson}, {size:?}, free {free}: {ratio}");
        }
    }
    // Others are as soft as their springs, or lock in shear.
    let (soft, full) = (bent("hex8_reduced", 0.3, [10.0, 1.0, 1.0], 6, true), bent("hex8", 0.3, [10.0, 1.0, 1.0], 6, true));
    println!("hex8_reduced {soft}, hex8 {full}");
    assert!(soft < 0.5 && full > 1.5, "{soft} {full}");
}

#[test]
fn twisted_and_warped_bricks_cost_what_torsion_and_uniaxial_stress_do() {
    // u_y = −θ x z, u_z = θ x y: shear strains θ z and θ y. u_x = w x' y' z' about the middle: ε_xx = w y'
    // z'.
    let size = [2.0, 1.0, 0.6];
    let energy = |to: &dyn Fn(Vector) -> Vector| {
        let mut body = Body::of(ASSUMED, &material("elastic", 0.3), &bricks([1, 1, 1], size));
        body.map(|x| plus(x, 1e-6, to(plus(x, -0.5, size))));
        body.energy() / 1e-12
    };
    let ([length, width, height], shear) = (size, YOUNG / 2.6);
    let polar = width * height * (width * width + height * height) / 12.0;
    let twist = energy(&|[x, y, z]| [0.0, -x * z, x * y]) / (0.5 * shear * polar * length);
    let warp = energy(&|[x, y, z]| [x * y * z, 0.0, 0.0]) / (0.5 * YOUNG * (width * height).powi(3) / 144.0 * length);
    assert!((twist - 1.0).abs() < 1e-4 && (warp - 1.0).abs() < 1e-4, "{twist} {warp}");
}

#[test]
fn a_held_slab_of_rectangles_is_as_stiff_as_the_plane() {
    for (law, poisson) in [("elastic", 0.3), ("elastic", 0.49), ("neo_hookean", 0.2)] {
        let row = |k: usize| [(k % 4) as f64 * 1.5, (k / 4) as f64 * 0.8];
        let cell = |k: u32| [k / 3 * 4 + k % 3, k / 3 * 4 + k % 3 + 1, k / 3 * 4 + k % 3 + 5, k / 3 * 4 + k % 3 + 4];
        let plane = Patch { positions: (0..12).map(row).collect(), connectivity: (0..6).flat_map(cell).collect(), inner: Vec::new() };
        let material = material(law, poisson);
        let flat = stiffness(|| Body::of("quad4_reduced_assumed_strain", &material, &plane));
        let deep = slab(&plane, 1, 0.9);
        let solid = stiffness(|| Body::of(ASSUMED, &material, &deep));
        let size = flat.iter().flatten().fold(0.0f64, |size, k| size.max(k.abs()));
        for (i, row) in flat.iter().enumerate() {
            for (j, &expected) in row.iter().enumerate() {
                let at = |level: usize, i: usize| 3 * (level * 12 + i / 2) + i % 2;
                let sum: f64 = [0, 1].into_iter().flat_map(|a| [0, 1].map(|b| solid[at(a, i)][at(b, j)])).sum();
                assert!((sum / 0.9 - expected).abs() < 1e-6 * size, "{law} {poisson}: {i} {j}: {} and {expected}", sum / 0.9);
            }
        }
    }
}

/// Deflection of the corner of Cook's membrane as a slab one element thick, per depth.
fn cook(element: &str, law: &str, n: usize, poisson: f64, held: bool) -> f64 {
    // As thick as an element of the middle is wide.
    let height = 48.0 / n as f64;
    let last = 48.0 - 1e-9;
    // Nodes that load the right side along its height and across, where there are some between corners too.
    let [along, across] = if nodes_of(element) == 10 { [2 * n, 2] } else { [n, 1] };
    let share = |y: f64| {
        let end = (y - 44.0).abs() < 1e-9 || (y - 60.0).abs() < 1e-9;
        if end { 0.5 / along as f64 } else { 1.0 / along as f64 }
    };
    let depth = |z: f64| if z < 1e-9 || z > height - 1e-9 { 0.5 * height / across as f64 } else { height / across as f64 };
    let is_free = |[x, _, z]: Vector, d: usize| x > 0.0 && (d < 2 || !held && z > 0.0);
    let patch = slab(&membrane(n, 4), 1, height);
    let load = |[x, y, z]: Vector| [0.0, if x > last { depth(z) * share(y) } else { 0.0 }, 0.0];
    let u = displaced(element, law, poisson, patch, is_free, load);
    u[(n + 1) * (n + 1) - 1][1]
}

#[test]
fn cooks_membrane_as_a_slab_converges_to_the_plane_and_faster_with_assumed_strain_than_with_full_integration() {
    let fine = deflection("quad4", "elastic", 24, 0.3);
    let error = |element: &str, n: usize| cook(element, "elastic", n, 0.3, true) / fine - 1.0;
    let errors = [ASSUMED, "hex8", "hex8_reduced"].map(|element| [2, 4, 8].map(|n| error(element, n)));
    println!("{errors:.4?}");
    for [coarse, middle, good] in errors {
        assert!(good.abs() < 0.06 && good.abs() < 0.6 * middle.abs() && middle.abs() < 0.6 * coarse.abs(), "{coarse} {middle} {good}");
    }
    for (n, (assumed, full)) in [2, 4, 8].into_iter().zip(errors[0].into_iter().zip(errors[1])) {
        assert!(assumed.abs() < 0.5 * full.abs(), "{n}: {assumed} and {full}");
    }
    // Free to change its thickness it is as good.
    let thin = cook(ASSUMED, "elastic", 4, 0.3, false) / cook("hex8", "elastic", 10, 0.3, false) - 1.0;
    println!("free: {thin:.4}");
    assert!(thin.abs() < 0.08, "{thin}");
}

#[test]
fn cooks_membrane_as_a_slab_does_not_lock_near_incompressibility() {
    const POISSON: f64 = 0.4999;
    let [fine, easy] = [POISSON, 0.3].map(|poisson| deflection("quad4", "elastic", 20, poisson));
    for law in ["elastic", "neo_hookean"] {
        for element in [ASSUMED, "hex8", "hex8_reduced"] {
            let error = cook(element, law, 8, POISSON, true) / fine - 1.0;
            println!("{law} {element}: {error:.3}");
            assert!(error.abs() < 0.06, "{law} {element}: {error}");
        }
        // With four nodes between corners in the volume it takes a quarter of the cells.
        let ten = [(4, POISSON, fine), (4, 0.3, easy)].map(|(n, poisson, exact)| cook("tet10", law, n, poisson, true) / exact - 1.0);
        println!("{law} tet10: {:.3}, at 0.3 {:.3}", ten[0], ten[1]);
        assert!(ten.iter().all(|error| (-0.08..0.02).contains(error)), "{law} tet10: {ten:?}");
        // Tetrahedra are stiff in bending whatever ν is; that volumes stay adds little.
        let [error, stiff] = [cook("tet4_anp", law, 8, POISSON, true) / fine - 1.0, cook("tet4", law, 8, 0.3, true) / easy - 1.0];
        println!("{law} tet4_anp: {error:.3}, tet4 at 0.3 {stiff:.3}");
        assert!(error > stiff - 0.05 && error < 0.0, "{law}: {error} {stiff}");
        let locked = cook("tet4", law, 8, POISSON, true) / fine - 1.0;
        println!("{law} tet4: {locked:.3}");
        assert!(locked < -0.4, "plain tetrahedra lock: {locked}");
    }
}

/// Mean sinking of the pressed quarter of the top of a block whose sides are held across (half of each shown
/// by symmetry).
fn pressed(element: &str, poisson: f64) -> f64 {
    const N: usize = 4;
    let is_free = |[x, y, z]: Vector, d: usize| match d {
        0 => x > 0.0 && x < 1.0,
        1 => y > 0.0 && y < 1.0,
        _ => z > 0.0,
    };
    let is_pressed = |[x, y, z]: Vector| z > 0.99 && x < 0.51 && y < 0.51;
    let share = |x: f64| if (0.01..0.49).contains(&x) { 1.0 } else { 0.5 };
    let load = |at: Vector| [0.0, 0.0, if is_pressed(at) { -share(at[0]) * share(at[1]) } else { 0.0 }];
    let patch = bricks([N, N, N], [1.0; 3]);
    let places = patch.positions.clone();
    let u = displaced(element, "elastic", poisson, patch, is_free, load);
    // The work of the load.
    places.iter().zip(u).map(|(&x, u)| load(x)[2] * u[2]).sum()
}

#[test]
fn a_block_that_cannot_change_its_volume_still_gives_way_under_half_of_its_top() {
    let reference = pressed("hex8", 0.4999);
    for element in [ASSUMED, "hex8_reduced", "tet4_anp"] {
        let ratio = pressed(element, 0.4999) / reference;
        let easy = pressed(element, 0.3) / pressed("hex8", 0.3);
        println!("{element}: {ratio:.3} of hex8 at ν = 0.4999, {easy:.3} at 0.3");
        assert!(ratio > 0.8 && ratio < 1.6, "{element}: {ratio}");
    }
    let locked = pressed("tet4", 0.4999) / reference;
    assert!(locked < 0.5, "plain tetrahedra lock: {locked}");
}

#[test]
fn assumed_strain_in_3d_gives_back_what_it_took_however_an_element_is_folded() {
    let mut numbers = Spread::new(31);
    for round in 0..20 {
        let start = distorted(ASSUMED, 0.3, 2.0, &mut numbers);
        let mut body = Body::single(ASSUMED, &material("neo_hookean", 0.3), &start);
        assert!(body.report.hourglass.abs() < 1e-25 * YOUNG, "nothing is stored at the start: {}", body.report.hourglass);
        for _ in 0..5 {
            let there: Vec<Vector> = start.iter().map(|&x| plus(x, 1.0, numbers.in_3d(0.6))).collect();
            body.move_to(&there);
        }
        assert!(body.report.hourglass > 0.0);
        let q = rotation(numbers.in_3d(1.0), 2.0);
        body.move_to(&start.iter().map(|&x| apply(&q, x)).collect::<Vec<_>>());
        let force = body.forces().into_iter().flatten().fold(0.0f64, |most, f| most.max(f.abs()));
        assert!(body.report.hourglass.abs() < 1e-25 * YOUNG && force < 1e-11 * YOUNG, "{round}: {} {force}", body.report.hourglass);
    }
}
