//! Rubbers against closed forms: shear, biaxial tension of a sheet, known special cases, and parameters that
//! are refused.

use crate::patches::{Body, Spread, material, patch};
use embate_solver::block::BlockInput;
use embate_solver::material::{self, ArrudaBoyce, Kinematics, LAWS, Law, MooneyRivlin, NeoHookean, Ogden, Parameters, Response, Yeoh};
use embate_solver::tensor::{Plane, Solid, SymmetricTensor, Turn};
use std::collections::BTreeMap;

fn map(values: &[(&str, f64)]) -> BTreeMap<String, f64> {
    values.iter().map(|(name, value)| ((*name).to_string(), *value)).collect()
}

fn law<M: Law>(values: &[(&str, f64)], lists: &[(&str, &[f64])]) -> M {
    let lists: BTreeMap<String, Vec<f64>> = lists.iter().map(|(name, list)| ((*name).to_string(), list.to_vec())).collect();
    M::new(&Parameters::new(M::KIND.parameters, &map(values), &lists))
}

fn respond<M: Law, T: SymmetricTensor<f64>>(law: &M, b: T) -> Response<f64, T> {
    let zero = T::isotropic(0.0);
    let kinematics = Kinematics {
        time_step: 0.0,
        viscous_heat: 0.0,
        strain_increment: zero,
        rotation: T::Rotation::none(),
        stress_rotated: zero,
        left_cauchy_green: b,
        volume_ratio: b.determinant().sqrt(),
    };
    law.update(&kinematics, &mut law.start())
}

fn ogden(mu: &[f64], alpha: &[f64], bulk: f64) -> Ogden {
    law(&[("bulk", bulk)], &[("mu", mu), ("alpha", alpha)])
}

fn same(a: &Response<f64, Solid<f64>>, b: &Response<f64, Solid<f64>>, size: f64, what: &str) {
    assert!((0..6).all(|c| (a.stress.0[c] - b.stress.0[c]).abs() < 1e-12 * size), "{what}: {a:?} {b:?}");
    assert!((a.stored - b.stored).abs() < 1e-12 * size && (a.bulk / b.bulk - 1.0).abs() < 1e-12, "{what}: {a:?} {b:?}");
}

#[test]
fn special_cases_of_one_law_are_another() {
    let (bulk, c10, c01) = (3.0, 0.4, 0.15);
    let shear = 2.0 * c10;
    let young = 9.0 * bulk * shear / (3.0 * bulk + shear);
    let poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
    let neo_hookean: NeoHookean = law(&[("young", young), ("poisson", poisson)], &[]);
    let without: MooneyRivlin = law(&[("c10", c10), ("c01", 0.0), ("bulk", bulk)], &[]);
    let mooney_rivlin: MooneyRivlin = law(&[("c10", c10), ("c01", c01), ("bulk", bulk)], &[]);
    let linear: Yeoh = law(&[("c10", c10), ("bulk", bulk)], &[]);
    let mut numbers = Spread::new(31);
    for _ in 0..500 {
        let mut f = [[0.0; 3]; 3];
        for (i, row) in f.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = f64::from(u8::from(i == j)) + numbers.between(-0.25, 0.25);
            }
        }
        let dot = |i: usize, j: usize| (0..3).map(|k| f[i][k] * f[j][k]).sum::<f64>();
        let b = Solid([dot(0, 0), dot(1, 1), dot(2, 2), dot(0, 1), dot(1, 2), dot(2, 0)]);
        let plain = respond(&neo_hookean, b);
        same(&plain, &respond(&without, b), 10.0, "Mooney-Rivlin without C01");
        same(&plain, &respond(&linear, b), 10.0, "Yeoh with C10 alone");
        same(&plain, &respond(&ogden(&[shear], &[2.0], bulk), b), 10.0, "Ogden with the exponent 2");
        same(&respond(&mooney_rivlin, b), &respond(&ogden(&[shear, -2.0 * c01], &[2.0, -2.0], bulk), b), 10.0, "Ogden with 2 and -2");
    }
}

#[test]
fn mooney_rivlin_in_simple_shear_has_the_normal_stresses_of_rivlin() {
    let (c10, c01) = (0.7, 0.2);
    let rubber: MooneyRivlin = law(&[("c10", c10), ("c01", c01), ("bulk", 50.0)], &[]);
    for gamma in [1e-6, 0.1, 1.0, 4.0] {
        let [xx, yy, zz, xy] = respond(&rubber, Plane([1.0 + gamma * gamma, 1.0, 1.0, gamma])).stress.0;
        let square = gamma * gamma;
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-13 * (1.0 + square * square);
        assert!(close(xy, 2.0 * (c10 + c01) * gamma), "γ = {gamma}: {xy}");
        assert!(close(xx - zz, 2.0 * c10 * square) && close(yy - zz, -2.0 * c01 * square), "γ = {gamma}: {xx} {yy} {zz}");
        assert!((xx + yy + zz).abs() < 1e-11 * (1.0 + square * square), "the volume is kept: no pressure");
    }
}

#[test]
fn ogden_in_pure_shear_has_the_stress_of_its_powers() {
    // λ along x, 1/λ along y, nothing along z: σ_x − σ_y = Σ µ (λ^α − λ^−α), σ_x − σ_z = Σ µ (λ^α − 1);
    // Treloar's rubber of Ogden 1972.
    let (mu, alpha) = ([0.63e6, 0.0012e6, -0.01e6], [1.3, 5.0, -2.0]);
    let rubber = ogden(&mu, &alpha, 1e9);
    let sum = |f: &dyn Fn(f64) -> f64| mu.iter().zip(alpha).map(|(mu, alpha)| mu * f(alpha)).sum::<f64>();
    for stretch in [1.0 + 1e-9, 1.5, 3.0, 7.0f64] {
        let response = respond(&rubber, Plane([stretch * stretch, 1.0 / (stretch * stretch), 1.0, 0.0]));
        let [xx, yy, zz, _] = response.stress.0;
        let sides = sum(&|a| stretch.powf(a) - stretch.powf(-a));
        let out = sum(&|a| stretch.powf(a) - 1.0);
        let tolerance = |value: f64| 1e-11 * value.abs() + 2e-10;
        assert!((xx - yy - sides).abs() < tolerance(sides) && (xx - zz - out).abs() < tolerance(out), "{stretch}: {xx} {yy} {zz}");
        let stored: f64 = mu.iter().zip(alpha).map(|(mu, a)| mu / a * (stretch.powf(a) + stretch.powf(-a) - 2.0)).sum();
        assert!((response.stored - stored).abs() < 1e-12 * stored.abs() + 1e-9, "{stretch}: {} for {stored}", response.stored);
    }
}

#[test]
fn yeoh_in_shear_stiffens_with_its_cubic() {
    let (c, bulk) = ([0.5, -0.03, 0.004], 100.0);
    let rubber: Yeoh = law(&[("c10", c[0]), ("c20", c[1]), ("c30", c[2]), ("bulk", bulk)], &[]);
    for gamma in [0.01, 0.5, 2.0, 5.0f64] {
        let x = gamma * gamma;
        let response = respond(&rubber, Plane([1.0 + x, 1.0, 1.0, gamma]));
        let expected = 2.0 * (c[0] + 2.0 * c[1] * x + 3.0 * c[2] * x * x) * gamma;
        assert!((response.stress.0[3] / expected - 1.0).abs() < 1e-12, "{gamma}: {} for {expected}", response.stress.0[3]);
        assert!((response.stored / (x * (c[0] + x * (c[1] + x * c[2]))) - 1.0).abs() < 1e-11, "{gamma}");
    }
}

#[test]
fn arruda_boyce_stiffens_as_the_inverse_langevin_function_says() {
    // σ_xy / γ = µ √N / 3 / λ_c · L⁻¹(λ_c / √N) with the chain stretch λ_c = √(Ī₁/3), √N = λ_m and µ = n k Θ;
    // cut after five terms it is right up to half of λ_m.
    let (shear, locking) = (0.8, 4.0f64);
    let rubber: ArrudaBoyce = law(&[("shear", shear), ("locking_stretch", locking), ("bulk", 100.0)], &[]);
    let langevin_inverse = |y: f64| {
        let (mut low, mut high) = (1e-9, 1e3);
        for _ in 0..200 {
            let x = 0.5 * (low + high);
            if 1.0 / f64::tanh(x) - 1.0 / x < y { low = x } else { high = x }
        }
        low
    };
    let chain = |stretch: f64| locking / (3.0 * stretch) * langevin_inverse(stretch / locking);
    for gamma in [1e-4, 0.5, 1.0, 2.0f64] {
        let response = respond(&rubber, Plane([1.0 + gamma * gamma, 1.0, 1.0, gamma]));
        let stretch = (1.0 + gamma * gamma / 3.0).sqrt();
        let expected = shear / chain(1.0) * chain(stretch) * gamma;
        assert!((response.stress.0[3] / expected - 1.0).abs() < 1e-3, "{gamma}: {} for {expected}", response.stress.0[3]);
    }
    // Chains that never end make the neo-Hookean rubber.
    let endless: ArrudaBoyce = law(&[("shear", shear), ("locking_stretch", 999.0), ("bulk", 100.0)], &[]);
    let [.., xy] = respond(&endless, Plane([5.0, 1.0, 1.0, 2.0])).stress.0;
    assert!((xy / (2.0 * shear) - 1.0).abs() < 1e-5, "{xy}");
}

#[test]
fn a_sheet_under_equal_biaxial_stretch_follows_the_closed_form() {
    // Nearly incompressible: σ = Σ µ (λ^α − λ^−2α) with an error of the order of σ / K.
    for (name, mu, alpha) in [("mooney_rivlin", [1.0, -0.4], [2.0, -2.0]), ("ogden", [1.2, 0.1], [1.3, 4.0])] {
        let mut rubber = material(name, 0.3);
        rubber.parameters.extend(map(&[("bulk", 1e6)]));
        if name == "ogden" {
            rubber.lists.insert("mu".into(), mu.to_vec());
            rubber.lists.insert("alpha".into(), alpha.to_vec());
        } else {
            rubber.parameters.extend(map(&[("c10", 0.5 * mu[0]), ("c01", -0.5 * mu[1])]));
        }
        let square = patch("quad4", 1, 0.0);
        let input =
            BlockInput { stress_state: "plane_stress", ..BlockInput::new("quad4", &rubber, &square.connectivity, &square.positions) };
        let mut sheet = Body::made(&input);
        for step in 1..=20 {
            let stretch = 1.0 + 0.05 * f64::from(step);
            sheet.move_to(&square.positions.iter().map(|x| x.map(|v| v * stretch)).collect::<Vec<_>>());
            let expected: f64 = mu.iter().zip(alpha).map(|(mu, a)| mu * (stretch.powf(a) - stretch.powf(-2.0 * a))).sum();
            let [xx, yy, zz, ..] = sheet.block.state(0).stress;
            assert!(
                (xx / expected - 1.0).abs() < 2e-5 && (yy - xx).abs() < 1e-9 && zz.abs() < 2e-6,
                "{name} {stretch}: {xx} {zz} for {expected}"
            );
        }
    }
}

#[test]
fn rubbers_that_would_be_unstable_are_refused_with_the_reason() {
    let fault = |name: &str, values: &[(&str, f64)], lists: &[(&str, &[f64])]| {
        let kind = LAWS.iter().find(|kind| kind.name == name).unwrap();
        let lists = lists.iter().map(|(name, list)| ((*name).to_string(), list.to_vec())).collect();
        material::faults(name, &Parameters::new(kind.parameters, &map(values), &lists))
            .into_iter()
            .map(|fault| fault.message)
            .collect::<Vec<_>>()
    };
    let terms = |mu: &[f64], alpha: &[f64]| fault("ogden", &[("bulk", 1.0)], &[("mu", mu), ("alpha", alpha)]);
    assert!(terms(&[1.0, -2.0], &[2.0, -2.0]).is_empty());
    assert!(terms(&[1.0, -2.0], &[2.0])[0].contains("1 exponents for 2 moduli"));
    assert!(terms(&[1.0, -2.0], &[2.0, 1.0])[0].contains("term 2"));
    let yeoh = |c20: f64| fault("yeoh", &[("c10", 1.0), ("c20", c20), ("c30", 0.03), ("bulk", 1.0)], &[]);
    assert!(yeoh(-0.29).is_empty() && yeoh(-0.31)[0].contains("soften"));
}
