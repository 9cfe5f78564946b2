//! Orthotropic elasticity against closed forms: pull along, across and aslant, known isotropy, rotation,
//! parameters that are refused.

use crate::patches::{Body, YOUNG, material, modulus_along_x, patch};
use embate_solver::block::BlockInput;
use embate_solver::material::{self, Elastic, Law, OrthotropicElastic, Parameters};
use embate_solver::model::Material;
use std::collections::BTreeMap;

const YOUNGS: [f64; 3] = [1000.0, 60.0, 90.0];
const RATIOS: [f64; 3] = [0.3, 0.25, 0.02];
const SHEARS: [f64; 3] = [40.0, 25.0, 35.0];

fn ply(angle: f64) -> Material {
    let mut ply = material("orthotropic_elastic", 0.3);
    for k in 0..3 {
        let pair = ["12", "23", "31"][k];
        ply.parameters.insert(format!("young_{}", k + 1), YOUNGS[k]);
        ply.parameters.insert(format!("poisson_{pair}"), RATIOS[k]);
        ply.parameters.insert(format!("shear_{pair}"), SHEARS[k]);
    }
    ply.parameters.insert("angle".into(), angle);
    ply
}

/// Compliance of a pull at an angle to axis 1: strains along, across and shear γ per stress. Jones, Mechanics
/// of Composite Materials (1999), 2.6.
fn compliance(angle: f64) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    let [s11, s22, s12, s66] = [1.0 / YOUNGS[0], 1.0 / YOUNGS[1], -RATIOS[0] / YOUNGS[0], 1.0 / SHEARS[0]];
    [
        s11 * c.powi(4) + (2.0 * s12 + s66) * (s * c).powi(2) + s22 * s.powi(4),
        s12 * (s.powi(4) + c.powi(4)) + (s11 + s22 - s66) * (s * c).powi(2),
        // Negative for a stiff axis 1: the fibres turn towards the pull.
        (2.0 * s11 - 2.0 * s12 - s66) * s * c.powi(3) - (2.0 * s22 - 2.0 * s12 - s66) * s.powi(3) * c,
    ]
}

fn sheet(angle: f64) -> Body {
    let (square, ply) = (patch("quad4", 1, 0.0), ply(angle));
    Body::made(&BlockInput { stress_state: "plane_stress", ..BlockInput::new("quad4", &ply, &square.connectivity, &square.positions) })
}

#[test]
fn a_sheet_pulled_along_across_and_aslant_strains_as_its_compliance_says() {
    const STRESS: f64 = 1e-5;
    for degrees in [0.0, 30.0, 45.0, 90.0, -60.0f64] {
        let angle = degrees.to_radians();
        let [along, across, shear] = compliance(angle).map(|value| value * STRESS);
        let mut sheet = sheet(angle);
        sheet.map(|[x, y]| [x + along * x + 0.5 * shear * y, y + across * y + 0.5 * shear * x]);
        let [xx, yy, zz, xy, ..] = sheet.block.state(0).stress;
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-5 * STRESS;
        assert!(close(xx, STRESS) && close(yy, 0.0) && close(zz, 0.0) && close(xy, 0.0), "{degrees}°: {xx} {yy} {zz} {xy}");
    }
}

#[test]
fn cords_in_rubber_keep_the_faces_of_a_sheet_free() {
    let mut cords = ply(0.3);
    let values = [("young_1", 1e5), ("young_2", 10.0), ("young_3", 8.0), ("shear_12", 3.0), ("shear_23", 3.0), ("shear_31", 3.0)];
    cords.parameters.extend(values.map(|(name, value)| (name.to_string(), value)));
    cords.parameters.extend([("poisson_31".to_string(), 0.3 * 8.0 / 1e5), ("poisson_23".to_string(), 0.5)]);
    let square = patch("quad4", 1, 0.0);
    let input = BlockInput { stress_state: "plane_stress", ..BlockInput::new("quad4", &cords, &square.connectivity, &square.positions) };
    let mut sheet = Body::made(&input);
    for _ in 0..20 {
        sheet.map(|[x, y]| [x + 1e-4 * x + 2e-3 * y, y - 1e-3 * y]);
        let [xx, _, zz, ..] = sheet.block.state(0).stress;
        assert!(zz.abs() < 1e-11 * 1e5 && xx.abs() > 1.0, "{xx} {zz}");
    }
}

#[test]
fn the_axes_turn_with_the_body_over_a_hundred_turns() {
    let angle = 0.5f64;
    let mut sheet = sheet(angle);
    const STEPS: i32 = 3600;
    let start: Vec<_> = sheet.positions.clone();
    // Strained along x, then turned while strained: the stress turns and the energy stays.
    sheet.map(|[x, y]| [x * 1.0005, y]);
    let (first, energy) = (sheet.block.state(0).stress, sheet.energy());
    for step in 1..=STEPS {
        let (s, c) = (100.0 * std::f64::consts::TAU * f64::from(step) / f64::from(STEPS)).sin_cos();
        sheet.move_to(&start.iter().map(|[x, y]| [c * 1.0005 * x - s * y, s * 1.0005 * x + c * y]).collect::<Vec<_>>());
    }
    let last = sheet.block.state(0).stress;
    assert!((0..6).all(|c| (first[c] - last[c]).abs() < 1e-10 * YOUNG), "{first:?} {last:?}");
    assert!((sheet.energy() / energy - 1.0).abs() < 1e-9, "{} for {energy}", sheet.energy());
    // A further pull meets the fibres where they lie now: pulled back to rest, nothing is left.
    sheet.map(|[x, y]| [x / 1.0005, y]);
    let rest = sheet.block.state(0).stress;
    assert!(rest.iter().all(|s| s.abs() < 1e-10 * YOUNG) && sheet.energy().abs() < 1e-9 * energy, "{rest:?} {}", sheet.energy());
    // Quarter of a turn: what was along x is along y.
    let pulled = |mut body: Body, along_y: bool| {
        body.map(|[x, y]| if along_y { [x, y * 1.0002] } else { [x * 1.0002, y] });
        let [xx, yy, ..] = body.block.state(0).stress;
        if along_y { yy } else { xx }
    };
    let mut turned = self::sheet(angle);
    for step in 1..=90 {
        let (s, c) = f64::from(step).to_radians().sin_cos();
        turned.move_to(&start.iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect::<Vec<_>>());
    }
    let (straight, turned) = (pulled(self::sheet(angle), false), pulled(turned, true));
    assert!((turned / straight - 1.0).abs() < 1e-9, "{turned} {straight}");
}

#[test]
fn with_equal_axes_it_is_the_isotropic_law() {
    let mut values: BTreeMap<String, f64> = ["young_1", "young_2", "young_3"].map(|name| (name.to_string(), YOUNG)).into();
    values.extend(["poisson_12", "poisson_23", "poisson_31"].map(|name| (name.to_string(), 0.3)));
    values.extend([("shear_12".to_string(), YOUNG / 2.6), ("young".to_string(), YOUNG), ("poisson".to_string(), 0.3)]);
    let lists = BTreeMap::new();
    let law = OrthotropicElastic::new(&Parameters::new(OrthotropicElastic::KIND.parameters, &values, &lists));
    let isotropic = Elastic::new(&Parameters::new(Elastic::KIND.parameters, &values, &lists));
    for k in 0..2 {
        assert!((law.stiffness()[k] / isotropic.stiffness()[k] - 1.0).abs() < 1e-14, "{:?} {:?}", law.stiffness(), isotropic.stiffness());
    }
    assert!((modulus_along_x("quad4", &material("elastic", 0.3)) / (YOUNG * 0.7 / (1.3 * 0.4)) - 1.0).abs() < 1e-6);
}

#[test]
fn ratios_that_would_release_energy_are_refused_with_the_reason() {
    let messages = |change: &[(&str, f64)]| {
        let mut ply = ply(0.0);
        ply.parameters.extend(change.iter().map(|(name, value)| ((*name).to_string(), *value)));
        let parameters = Parameters::new(OrthotropicElastic::KIND.parameters, &ply.parameters, &ply.lists);
        material::faults("orthotropic_elastic", &parameters).into_iter().map(|fault| fault.message).collect::<Vec<_>>()
    };
    assert!(messages(&[]).is_empty());
    // ν₂₁ for ν₁₂ where axis 2 is the stiff one.
    let swapped = messages(&[("young_1", 60.0), ("young_2", 1000.0)]);
    assert!(swapped.len() == 1 && swapped[0].contains("poisson_12"), "{swapped:?}");
    let equal = [("young_2", 1000.0), ("young_3", 1000.0)];
    let ratios = |nu: f64| messages(&[equal[0], equal[1], ("poisson_12", nu), ("poisson_23", nu), ("poisson_31", nu)]);
    assert!(ratios(0.49).is_empty() && ratios(0.51)[0].contains("positive definite"), "{:?}", ratios(0.51));
}
