//! Viscoelasticity against closed forms: relaxation, creep, loss in a cycle, a swinging bar that loses what
//! the loss factor says.

use crate::patches::{Body, DENSITY, Spread, YOUNG, patch};
use embate_solver::material::{self, Kinematics, Law, Parameters, Response, State, Tensors, Viscoelastic};
use embate_solver::model::Material;
use embate_solver::tensor::{Plane, PlaneRotation, Solid, SymmetricTensor, Turn};

const SHEAR: f64 = YOUNG / 2.6;
const RATIOS: [f64; 2] = [0.3, 0.4];
const TIMES: [f64; 2] = [0.02, 1.5];

fn rubber(ratios: &[f64], times: &[f64]) -> Material {
    let parameters = [("density", DENSITY), ("young", YOUNG), ("poisson", 0.3)].map(|(name, value)| (name.to_string(), value));
    let lists = [("shear_ratio", ratios), ("relaxation_time", times)].map(|(name, list)| (name.to_string(), list.to_vec()));
    Material {
        law: "viscoelastic".into(),
        parameters: parameters.into_iter().collect(),
        lists: lists.into_iter().collect(),
        ..Material::default()
    }
}

fn law(ratios: &[f64], times: &[f64]) -> Viscoelastic {
    let material = rubber(ratios, times);
    Viscoelastic::new(&Parameters::new(Viscoelastic::KIND.parameters, &material.parameters, &material.lists))
}

/// A point that is strained step by step, with the book that a block keeps of it.
struct Point {
    law: Viscoelastic,
    stress: Plane<f64>,
    state: Tensors<f64, Plane<f64>, 4>,
    work: f64,
    dissipated: f64,
}

impl Point {
    fn new(ratios: &[f64], times: &[f64]) -> Self {
        let zero = Plane([0.0; 4]);
        Self { law: law(ratios, times), stress: zero, state: State::zero(), work: 0.0, dissipated: 0.0 }
    }

    fn step(&mut self, time_step: f64, strain: Plane<f64>, turn: PlaneRotation<f64>) {
        let old = self.stress.rotated(&turn);
        let kinematics = Kinematics {
            time_step,
            strain_increment: strain,
            rotation: turn,
            stress_rotated: old,
            left_cauchy_green: Plane::isotropic(1.0),
            volume_ratio: 1.0,
            viscous_heat: 0.0,
        };
        let response = self.law.update(&kinematics, &mut self.state);
        self.work += 0.5 * old.plus(response.stress).contract(strain);
        self.dissipated += response.dissipated;
        self.stress = response.stress;
    }

    /// Engineering shear γ by this much more.
    fn shear(&mut self, time_step: f64, gamma: f64) {
        self.step(time_step, Plane([0.0, 0.0, 0.0, 0.5 * gamma]), PlaneRotation::none());
    }
}

#[test]
fn stress_after_a_sudden_strain_relaxes_with_the_prony_series_for_any_step() {
    for time_step in [1e-3, 0.1, 5.0] {
        let mut point = Point::new(&RATIOS, &TIMES);
        let strain = Plane([0.02, -0.01, 0.005, 0.03]);
        point.step(1e-14, strain, PlaneRotation::none());
        let bulk = YOUNG / 1.2;
        for step in 0..200 {
            let time = f64::from(step) * time_step;
            let ratio = 1.0 - (0..2).map(|k| RATIOS[k] * (1.0 - (-time / TIMES[k]).exp())).sum::<f64>();
            let expected = strain.deviator().times(2.0 * SHEAR * ratio).plus(Plane::isotropic(bulk * strain.trace()));
            assert!((0..4).all(|c| (point.stress.0[c] - expected.0[c]).abs() < 1e-11 * YOUNG), "{time}: {:?} {expected:?}", point.stress);
            point.step(time_step, Plane([0.0; 4]), PlaneRotation::none());
        }
        // What the branches stored is gone.
        let lost: f64 = RATIOS.iter().map(|g| SHEAR * g * strain.deviator().contract(strain.deviator())).sum();
        if time_step > 0.05 {
            assert!((point.dissipated / lost - 1.0).abs() < 1e-5, "{time_step}: {} for {lost}", point.dissipated);
        }
    }
}

#[test]
fn creep_under_constant_stress_follows_the_standard_solid() {
    // J(t) = 1/µ∞ − (1/µ∞ − 1/µ) e^{−t/τ_c}, τ_c = τ µ/µ∞.
    let (ratio, time, stress) = (0.6, 0.5, 0.01 * SHEAR);
    let last = SHEAR * (1.0 - ratio);
    let error = |steps: u32| {
        let time_step = 4.0 / f64::from(steps);
        let mut point = Point::new(&[ratio], &[time]);
        point.shear(1e-14, stress / SHEAR);
        let (mut gamma, mut worst) = (stress / SHEAR, 0.0f64);
        for step in 1..=steps {
            // The stress is linear in the strain of the step.
            let mut trial = Point { ..point };
            let slope = {
                let (mut a, mut b) = (Point { ..point }, Point { ..point });
                a.shear(time_step, 0.0);
                b.shear(time_step, 1e-3);
                (b.stress.0[3] - a.stress.0[3]) / 1e-3
            };
            trial.shear(time_step, 0.0);
            let more = (stress - trial.stress.0[3]) / slope;
            point.shear(time_step, more);
            gamma += more;
            let t = time_step * f64::from(step);
            let expected = stress * (1.0 / last - (1.0 / last - 1.0 / SHEAR) * (-t * last / (time * SHEAR)).exp());
            worst = worst.max((gamma / expected - 1.0).abs());
        }
        worst
    };
    let (coarse, fine) = (error(100), error(400));
    assert!(fine < 1e-5 && fine < coarse / 12.0, "second order: {coarse:e} {fine:e}");
}

#[test]
fn the_loss_of_a_cycle_is_that_of_the_loss_modulus_at_every_frequency() {
    // µ' = µ∞ + Σ µ g (ωτ)²/(1 + (ωτ)²), µ'' = Σ µ g ωτ/(1 + (ωτ)²); a cycle takes π µ'' γ².
    const STEPS: i32 = 2000;
    let amplitude = 0.01;
    let mut worst = 0.0f64;
    for decade in -6..=8 {
        let omega = 10f64.powf(0.5 * f64::from(decade));
        let at = |k: usize| omega * TIMES[k];
        let stored: f64 = (0..2).map(|k| RATIOS[k] * at(k) * at(k) / (1.0 + at(k) * at(k))).sum::<f64>() + 1.0 - RATIOS.iter().sum::<f64>();
        let lost: f64 = (0..2).map(|k| RATIOS[k] * at(k) / (1.0 + at(k) * at(k))).sum();
        let time_step = std::f64::consts::TAU / omega / f64::from(STEPS);
        let mut point = Point::new(&RATIOS, &TIMES);
        // The stationary state at γ = 0 and rising: h_k is the imaginary part of µ g iωτ/(1 + iωτ) γ e^{iωt},
        // so its start is µ g ωτ/(1 + (ωτ)²) γ.
        for k in 0..2 {
            point.state.0[k] = Plane([0.0, 0.0, 0.0, amplitude * SHEAR * RATIOS[k] * at(k) / (1.0 + at(k) * at(k))]);
            point.stress = point.stress.plus(point.state.0[k]);
        }
        let mut quarter = 0.0;
        for step in 1..=STEPS {
            let gamma = |step: i32| amplitude * (std::f64::consts::TAU * f64::from(step) / f64::from(STEPS)).sin();
            point.shear(time_step, gamma(step) - gamma(step - 1));
            if step == STEPS / 4 {
                quarter = point.stress.0[3];
            }
        }
        let end = point.stress.0[3];
        let right = std::f64::consts::PI * SHEAR * lost * amplitude * amplitude;
        worst = worst.max((point.dissipated / right - 1.0).abs()).max((point.work / right - 1.0).abs());
        assert!((point.dissipated / right - 1.0).abs() < 1e-5, "ω = {omega}: {} for {right}", point.dissipated);
        assert!((point.work / right - 1.0).abs() < 1e-4, "ω = {omega}: {} for {right}", point.work);
        assert!((end / quarter / (lost / stored) - 1.0).abs() < 1e-4, "ω = {omega}: tan δ = {} for {}", end / quarter, lost / stored);
    }
    println!("largest fault of the loss in a cycle: {worst:e}");
}

#[test]
fn what_is_not_dissipated_is_the_energy_of_the_springs() {
    let mut fault = [0.0f64; 2];
    for (which, steps) in [(0, 200), (1, 800)] {
        let mut point = Point::new(&RATIOS, &TIMES);
        let time_step = 0.2 / f64::from(steps);
        let mut total = Plane([0.0; 4]);
        for step in 0..steps {
            let angle = 40.0 * time_step * f64::from(step);
            let rate = Plane([0.4 * angle.sin(), -0.3 * angle.cos(), 0.1, 0.5 * (1.7 * angle).cos()]);
            // Turning as a whole changes nothing of energies.
            let (sin, cos) = (3.0 * time_step).sin_cos();
            let turn = PlaneRotation::new(cos, sin);
            total = total.rotated(&turn).plus(rate.times(time_step));
            point.step(time_step, rate.times(time_step), turn);
            let bulk = YOUNG / 1.2;
            let deviator = total.deviator();
            let springs = 0.5 * bulk * total.trace().powi(2)
                + SHEAR * (1.0 - RATIOS.iter().sum::<f64>()) * deviator.contract(deviator)
                + (0..2).map(|k| point.state.0[k].contract(point.state.0[k]) / (4.0 * SHEAR * RATIOS[k])).sum::<f64>();
            fault[which] = fault[which].max((point.work - point.dissipated - springs).abs() / point.work.abs().max(1.0));
        }
        assert!(point.dissipated > 0.05 * point.work);
    }
    println!("energy of the springs: {fault:?}");
    assert!(fault[1] < 2e-5 && fault[1] < fault[0] / 12.0, "second order in the step: {fault:?}");
}

#[test]
fn internal_stresses_turn_with_the_body() {
    // Two points, one of them turned by 0.3 rad in each step of a random history: the same energies, the
    // stress turned by the sum.
    let (mut still, mut turned) = (Point::new(&RATIOS, &TIMES), Point::new(&RATIOS, &TIMES));
    let mut numbers = Spread::new(41);
    for step in 1..=100 {
        let strain = Plane(std::array::from_fn(|_| numbers.between(-0.01, 0.01)));
        let rotation = |angle: f64| PlaneRotation::new(angle.cos(), angle.sin());
        let whole = rotation(0.3 * f64::from(step));
        still.step(0.01, strain, PlaneRotation::none());
        turned.step(0.01, strain.rotated(&whole), rotation(0.3));
        let expected = still.stress.rotated(&whole);
        assert!((0..4).all(|c| (turned.stress.0[c] - expected.0[c]).abs() < 1e-11 * YOUNG));
    }
    assert!((still.dissipated / turned.dissipated - 1.0).abs() < 1e-12 && (still.work / turned.work - 1.0).abs() < 1e-11);
}

#[test]
fn a_block_that_is_held_relaxes_as_the_point_does() {
    let square = patch("quad4", 2, 0.2);
    let mut body = Body::of("quad4", &rubber(&RATIOS, &[0.5, 4.0]), &square);
    body.map(|[x, y]| [x + 0.002 * y, y]);
    let first = body.block.state(0).stress[3];
    let before = body.energy();
    for _ in 0..64 {
        body.map(|x| x);
    }
    // One second later; the step that strains, 1/64 s at a constant rate, relaxes too.
    let at = |t: f64| {
        1.0 - [0.3, 0.4]
            .iter()
            .zip([0.5, 4.0])
            .map(|(g, tau)| g * (1.0 - (-t / tau).exp() * tau * 64.0 * (1.0 - (-1.0 / 64.0 / tau).exp())))
            .sum::<f64>()
    };
    let found = body.block.state(0).stress[3] / first;
    assert!((found / (at(1.0) / at(0.0)) - 1.0).abs() < 1e-10, "{found} for {}", at(1.0) / at(0.0));
    assert!(
        body.report.dissipated > 0.0 && (body.energy() / before - 1.0).abs() < 1e-13,
        "nothing moves: what the store loses is dissipated"
    );
}

#[test]
fn series_that_leave_nothing_or_do_not_match_are_refused() {
    let messages = |ratios: &[f64], times: &[f64]| {
        let material = rubber(ratios, times);
        let parameters = Parameters::new(Viscoelastic::KIND.parameters, &material.parameters, &material.lists);
        material::faults("viscoelastic", &parameters).into_iter().map(|fault| fault.message).collect::<Vec<_>>()
    };
    assert!(messages(&RATIOS, &TIMES).is_empty());
    assert!(messages(&RATIOS, &TIMES[..1])[0].contains("1 relaxation times for 2 shear ratios"));
    assert!(messages(&[0.6, 0.4], &TIMES)[0].contains("nothing"));
}

#[test]
fn a_branch_that_relaxes_within_a_step_is_a_dashpot() {
    // Δt ≫ τ: h = 2 µ g τ dev d.
    let law = law(&[0.5], &[1e-6]);
    let mut state = State::zero();
    let strain = Solid([1e-3, -1e-3, 0.0, 2e-3, 0.0, 0.0]);
    let zero = Solid([0.0; 6]);
    let kinematics = Kinematics {
        time_step: 1.0,
        strain_increment: strain,
        rotation: Turn::none(),
        stress_rotated: zero,
        left_cauchy_green: zero,
        volume_ratio: 1.0,
        viscous_heat: 0.0,
    };
    let Response { stress, dissipated, .. } = law.update(&kinematics, &mut state);
    let dashpot = 2.0 * SHEAR * 0.5 * 1e-6;
    assert!((stress.0[3] / ((2.0 * SHEAR * 0.5 + dashpot) * 2e-3) - 1.0).abs() < 1e-12, "{stress:?}");
    // From rest the first τ is missing: 2 µ g τ |e|² (1 − 3/2 τ/Δt).
    assert!((dissipated / (dashpot * strain.contract(strain)) - 1.0 + 1.5e-6).abs() < 1e-9, "{dissipated}");
}
