//! Laws that yield under pressure, Drucker and Prager's and crushable foam, against closed forms.

use crate::patches::{Spread, YOUNG};
use crate::point::Point;
use embate_solver::material::{CrushableFoam, DruckerPrager, Law};

const BULK: f64 = YOUNG / 1.2;
const COHESION: f64 = 2.0;
const FRICTION: f64 = 0.6;

fn soil(friction: f64, dilation: f64) -> Point<DruckerPrager> {
    let numbers = [("young", YOUNG), ("poisson", 0.3), ("cohesion", COHESION), ("friction_angle", friction), ("dilation_angle", dilation)];
    Point::new(&numbers, &[])
}

fn slope(angle: f64) -> f64 {
    6.0 * angle.sin() / (3.0 - angle.sin())
}

#[test]
fn soil_bears_in_compression_what_mohr_and_coulomb_say_and_less_in_tension() {
    for (friction, dilation) in [(FRICTION, FRICTION), (FRICTION, 0.2), (FRICTION, 0.0), (0.0, 0.0)] {
        let mut bar = soil(friction, dilation);
        bar.pull_by(-0.1, 50);
        let expected = -2.0 * COHESION * friction.cos() / (1.0 - friction.sin());
        assert!((bar.stress[0] / expected - 1.0).abs() < 1e-9, "{} for {expected}", bar.stress[0]);
        // The plastic volume grows by B γ, along the axis and across.
        let volume = bar.strain[0] + bar.strain[1] + bar.strain[2] - bar.mean() / BULK;
        assert!((volume - slope(dilation) * bar.state[0]).abs() < 1e-11, "{volume}");
        let mut bar = soil(friction, dilation);
        bar.pull_by(0.1, 50);
        let expected = 6.0 * COHESION * friction.cos() / (3.0 - friction.sin()) / (1.0 + slope(friction) / 3.0);
        assert!((bar.stress[0] / expected - 1.0).abs() < 1e-9, "{} for {expected}", bar.stress[0]);
    }
}

#[test]
fn soil_that_is_torn_returns_to_the_apex() {
    for dilation in [0.0, 0.3] {
        let mut body = soil(FRICTION, dilation);
        for _ in 0..5 {
            body.strain([0.01, 0.012, 0.01, 0.001, 0.0, 0.0]);
        }
        let apex = COHESION / FRICTION.tan();
        assert!((body.mean() / apex - 1.0).abs() < 1e-12 && body.mises() < 1e-11, "{:?} for {apex}", body.stress);
    }
}

/// Random steps: the stress stays inside, and work is dissipation plus elastic energy.
fn wander<M: Law>(mut body: Point<M>, inside: impl Fn(&Point<M>) -> f64) {
    let mut numbers = Spread::new(33);
    for step in 0..3000 {
        let size = [1e-4, 1e-3, 1e-2][step % 3];
        let before = body;
        body.strain(std::array::from_fn(|_| numbers.between(-size, size)));
        let excess = inside(&body);
        assert!(excess < 1e-10 * (1.0 + size * YOUNG), "{step}: {excess}");
        let dissipated = body.dissipated - before.dissipated;
        let gap = (body.work - before.work) - (body.elastic_energy() - before.elastic_energy()) - dissipated;
        // A dissipation that would be negative is reported as zero.
        assert!(gap < 1e-11 * (1.0 + body.work.abs()), "{step}: {gap}");
        assert!(gap > -1e-11 * (1.0 + body.work.abs()) || dissipated == 0.0, "{step}: {gap}");
    }
    assert!(body.dissipated > 0.0);
}

#[test]
fn soil_stays_inside_its_cone_and_keeps_the_books() {
    for dilation in [FRICTION, 0.2, 0.0] {
        let strength = 6.0 * COHESION * FRICTION.cos() / (3.0 - FRICTION.sin());
        wander(soil(FRICTION, dilation), |body| body.mises() + slope(FRICTION) * body.mean() - strength);
    }
}

fn foam(plastic_poisson: f64, cutoff: f64) -> Point<CrushableFoam> {
    let numbers = [("young", YOUNG), ("poisson", 0.1), ("plastic_poisson", plastic_poisson), ("tension_cutoff", cutoff)];
    Point::new(&numbers, &[("plastic_strain", &[0.0, 0.4, 0.8, 1.0]), ("stress", &[1.0, 1.3, 3.0, 20.0])])
}

fn curve(p: f64) -> f64 {
    match p {
        p if p < 0.4 => 1.0 + 0.75 * p,
        p if p < 0.8 => 1.3 + 4.25 * (p - 0.4),
        p if p < 1.0 => 3.0 + 85.0 * (p - 0.8),
        _ => 20.0,
    }
}

/// α².
fn shape(plastic_poisson: f64) -> f64 {
    4.5 * (1.0 - 2.0 * plastic_poisson) / (1.0 + plastic_poisson)
}

#[test]
fn foam_in_uniaxial_compression_follows_its_curve_and_its_plastic_poisson() {
    for poisson in [0.0, 0.2, -0.2] {
        for steps in [3, 100] {
            let mut bar = foam(poisson, 0.0);
            for _ in 0..3 {
                bar.pull_by(-0.3, steps);
                let p = bar.state[0];
                assert!((bar.stress[0] / -curve(p) - 1.0).abs() < 1e-9, "{} for {}", bar.stress[0], curve(p));
                let along = bar.strain[0] - bar.stress[0] / YOUNG;
                let across = bar.strain[1] + 0.1 * bar.stress[0] / YOUNG;
                assert!((along + p).abs() < 1e-9 && (across - poisson * p).abs() < 1e-9, "{along} {across} {p}");
            }
        }
    }
}

#[test]
fn foam_under_pressure_is_crushed_at_the_pressure_of_its_ellipse() {
    let mut body = foam(0.0, 0.0);
    for _ in 0..50 {
        body.strain([-0.01, -0.01, -0.01, 0.0, 0.0, 0.0]);
    }
    let expected = -curve(body.state[0]) * (1.5f64 / 4.5).sqrt();
    assert!((body.mean() / expected - 1.0).abs() < 1e-10 && body.mises() < 1e-11, "{} for {expected}", body.mean());
}

#[test]
fn foam_tears_at_its_cutoff() {
    let mut body = foam(0.0, 0.2);
    for _ in 0..10 {
        body.strain([0.01, 0.01, 0.012, 0.0, 0.0, 0.0]);
        assert!(body.mean() <= 0.2 + 1e-12);
    }
    assert!((body.mean() / 0.2 - 1.0).abs() < 1e-12);
    let elastic = body.elastic_energy();
    assert!((body.work - body.dissipated - elastic).abs() < 1e-11, "{} {} {elastic}", body.work, body.dissipated);
}

#[test]
fn foam_stays_inside_its_ellipse_and_keeps_the_books() {
    for poisson in [0.0, 0.2, -0.2] {
        let square = shape(poisson);
        let inside = |body: &Point<CrushableFoam>| {
            ((body.mises().powi(2) + square * body.mean().powi(2)) / (1.0 + square / 9.0)).sqrt() - curve(body.state[0])
        };
        wander(foam(poisson, 0.0), inside);
        wander(foam(poisson, 0.3), inside);
    }
}
