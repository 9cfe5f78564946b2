//! Bars: uniaxial stress of every law, turns without strain, waves, the stable step, and trusses and cables
//! against closed forms.

use crate::bodies::*;
use crate::patches::{Spread, YOUNG, is_isotropic, material, solids};
use crate::point::Point;
use embate_lanes::{Level, Team};
use embate_solver::block::{Block, BlockInput, Initial, Motion, Report, make};
use embate_solver::material::variable::{PLASTIC_STRAIN, TEMPERATURE};
use embate_solver::material::{Family, Law, LawVisitor, with_law};
use embate_solver::model::{
    Constraint, Contact, Curve, CurveShape, Drive, Image, InitialStress, Join, Load, Material, Model, NonReflecting, Obstacle, Part, Probe,
    ProbeAt, Shape, Truss,
};
use std::f64::consts::TAU;

const AREA: f64 = 0.01;

/// One bar from the origin, driven by the place of its second node.
struct OneBar {
    block: Box<dyn Block<2>>,
    slots: Vec<[f64; 2]>,
    positions: [[f64; 2]; 2],
    report: Report,
    time_step: f64,
}

impl OneBar {
    fn new(material: &Material, end: [f64; 2]) -> Self {
        let positions = [[0.0; 2], end];
        let block = make(&BlockInput { area: AREA, ..BlockInput::new("bar2", material, &[0, 1], &positions) }).unwrap();
        let slots = vec![[0.0; 2]; block.slots().len()];
        Self { block, slots, positions, report: Report::NOTHING, time_step: 1e-3 }
    }

    fn go(&mut self, end: [f64; 2]) {
        let positions = [[0.0; 2], end];
        let velocities = [[0.0; 2], [0, 1].map(|d| (end[d] - self.positions[1][d]) / self.time_step)];
        let motion = Motion::new(&positions, &velocities, self.time_step);
        self.report =
            self.block.advance(&motion, Level::best(), embate_solver::block::NodalForces::new(&mut self.slots), &mut Team::alone());
        self.positions = positions;
    }

    /// Force on the first node.
    fn force(&self) -> [f64; 2] {
        self.slots[0]
    }
}

#[test]
fn a_bar_has_the_uniaxial_stress_of_every_law_that_is_alike_in_all_directions() {
    /// The stress along of a point that is pulled by the same strains while nothing pulls across.
    struct Pulled<'a>(&'a [f64], &'a Material);
    impl LawVisitor for Pulled<'_> {
        type Output = Option<f64>;
        fn visit<M: Law>(self) -> Option<f64> {
            let numbers: Vec<(&str, f64)> = self.1.parameters.iter().map(|(name, value)| (name.as_str(), *value)).collect();
            let lists: Vec<(&str, &[f64])> = self.1.lists.iter().map(|(name, list)| (name.as_str(), &list[..])).collect();
            (M::FAMILY == Family::Rate).then(|| {
                let mut point = Point::<M>::new(&numbers, &lists);
                self.0.iter().for_each(|strain| point.pull(*strain));
                point.stress[0]
            })
        }
    }
    let mut seen = 0;
    for law in solids().filter(|law| is_isotropic(law.name)) {
        let material = material(law.name, 0.3);
        let mut bar = OneBar::new(&material, [1.0, 0.0]);
        // Pulled until it flows, pushed back.
        let ways: Vec<f64> =
            (0..60).map(|k| if k < 40 { 1.0 + 1e-3 * f64::from(k + 1) } else { 1.04 - 1e-3 * f64::from(k - 39) }).collect();
        let mut old = 1.0;
        let strains: Vec<f64> = ways.iter().map(|l| 2.0 * (l - old) / (l + std::mem::replace(&mut old, *l))).collect();
        ways.iter().for_each(|&l| bar.go([l, 0.0]));
        let state = bar.block.state(0);
        let Some(expected) = with_law(law.name, Pulled(&strains, &material)).unwrap() else { continue };
        assert!((state.stress[0] - expected).abs() < 1e-8 * YOUNG, "{}: {} for {expected}", law.name, state.stress[0]);
        assert!(state.stress[1..].iter().all(|s| *s == 0.0));
        seen += 1;
    }
    assert!(seen > 7, "{seen}");
}

#[test]
fn rubber_bars_follow_the_closed_form_of_incompressible_rubber() {
    // K = 1e4 µ: N = A₀ µ (λ − λ⁻²) but for what compresses.
    let mut rubber = material("neo_hookean", 0.3);
    let shear = 1.0;
    let (bulk, young) = (1e4 * shear, 9.0 * 1e4 / (3.0 * 1e4 + 1.0));
    rubber.parameters.insert("young".into(), young);
    rubber.parameters.insert("poisson".into(), (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear));
    let mut bar = OneBar::new(&rubber, [0.0, 1.0]);
    for k in 1..=200 {
        let stretch = 1.0 + 0.01 * f64::from(k);
        bar.go([0.0, stretch]);
        let expected = AREA * shear * (stretch - stretch.powi(-2));
        assert!((bar.force()[1] / expected - 1.0).abs() < 5e-4, "{stretch}: {:?} for {expected}", bar.force());
    }
    let stored = AREA * 0.5 * shear * (9.0 + 2.0 / 3.0 - 3.0);
    assert!((bar.report.stored / stored - 1.0).abs() < 1e-3, "{} {stored}", bar.report.stored);
}

#[test]
fn a_thousand_turns_are_no_strain() {
    for law in ["elastic", "j2", "neo_hookean"] {
        let mut bar = OneBar::new(&material(law, 0.3), [1.3, 0.0]);
        for k in 0..100_000 {
            let (sin, cos) = (TAU * f64::from(k + 1) / 100.0).sin_cos();
            bar.go([1.3 * cos, 1.3 * sin]);
        }
        let state = bar.block.state(0);
        assert!(state.stress[0].abs() < 1e-14 * YOUNG && bar.report.stored.abs() < 1e-25 * YOUNG, "{law}: {state:?}");
        // In one step half around.
        bar.go([-1.3, 0.0]);
        assert!(bar.block.state(0).stress[0].abs() < 1e-14 * YOUNG, "{law}");
    }
}

#[test]
fn the_force_is_the_slope_of_the_energy_and_the_step_bounds_the_frequency() {
    let mut numbers = Spread::new(3);
    for law in ["elastic", "neo_hookean", "ogden", "j2"] {
        for _ in 0..20 {
            let (stretch, angle) = (numbers.between(0.6, 1.8), numbers.between(0.0, TAU));
            let mut material = material(law, numbers.between(0.0, 0.45));
            crate::patches::stay_elastic(&mut material);
            let stretched = |length: f64| {
                let mut bar = OneBar::new(&material, [angle.cos(), angle.sin()]);
                for k in 1..=200 {
                    let l = 1.0 + (length - 1.0) * f64::from(k) / 200.0;
                    bar.go([l * angle.cos(), l * angle.sin()]);
                }
                bar
            };
            let [low, bar, high] = [stretch - 1e-4, stretch, stretch + 1e-4].map(stretched);
            let along = |bar: &OneBar| bar.force()[0] * angle.cos() + bar.force()[1] * angle.sin();
            let slope = (high.report.stored - low.report.stored) / 2e-4;
            assert!(
                (along(&bar) - slope).abs() < 1e-4 * along(&bar).abs() + 1e-6 * YOUNG * AREA,
                "{law} {stretch}: {} {slope}",
                along(&bar)
            );
            // Both nodes free: ω² = 4 k/m along, 4 N/(l m) across.
            let stiffness = ((along(&high) - along(&low)) / 2e-4).max(along(&bar) / stretch);
            let dt2 = 4.0 / (4.0 * stiffness / bar.block.mass(0));
            assert!(bar.report.time_step_squared < 1.001 * dt2, "{law} {stretch}: {} for {dt2}", bar.report.time_step_squared);
            if law == "elastic" && (stretch - 1.0).abs() < 0.1 {
                assert!(bar.report.time_step_squared > 0.7 * dt2);
            }
        }
    }
}

fn truss(model: &mut Model, name: &str, lines: Vec<Vec<[f64; 2]>>, elements: usize) {
    let shape = Shape::Truss(Truss { lines, elements });
    let part = Part { name: name.into(), material: "soft".into(), element: "bar2".into(), area: Some(AREA), shape, ..Part::default() };
    model.parts.push(part);
}

fn see(model: &mut Model, name: &str, set: &str) {
    model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: set.into() }, ..Probe::default() });
}

fn hold(model: &mut Model, on: &str, held: [bool; 2]) {
    let velocity = held.map(|held| held.then_some(Drive::Constant(0.0)));
    model.constraints.push(Constraint { on: on.into(), velocity: embate_solver::model::in_3d(velocity), ..Constraint::default() });
}

#[test]
fn waves_in_a_bar_run_with_the_root_of_young_over_density_whatever_poisson_is() {
    for poisson in [0.0, 0.3, 0.49] {
        let mut model = model(0.0);
        model.materials.get_mut("soft").unwrap().parameters.insert("poisson".into(), poisson);
        let c = 1e3; // √(1e9/1e3)
        let length = 1.0;
        model.run.end = 0.6 * length / c;
        truss(&mut model, "rod", vec![vec![[0.0, 0.0], [0.6 * length, 0.8 * length]]], 400);
        model.parts[0].velocity = [-0.6, -0.8, 0.0];
        hold(&mut model, "rod.point0", [true, true]);
        see(&mut model, "mean", "rod");
        let simulation = to_end(&model);
        // The front is at c t: behind it everything is at rest.
        let moving = value(&simulation, "mean.vx") / -0.6;
        assert!((moving - 0.4).abs() < 3e-3, "{poisson}: {moving}");
        let summary = simulation.summary();
        assert!(summary.energy_drift < 1e-3 && summary.ledger_residual < 1e-12, "{summary:?}");
        let expected = length / 400.0 / c;
        assert!((simulation.time_step() / (0.9 * expected) - 1.0).abs() < 0.02, "{} of {expected}", simulation.time_step());
    }
}

/// Two bars to an apex, height 0.1 over half a span of 1.
fn von_mises_truss(end: f64) -> Model {
    let mut model = model(end);
    model.materials.get_mut("soft").unwrap().parameters.insert("poisson".into(), 0.0);
    truss(&mut model, "truss", vec![vec![[-1.0, 0.0], [0.0, 0.1], [1.0, 0.0]]], 1);
    hold(&mut model, "truss.point0", [true, true]);
    hold(&mut model, "truss.point2", [true, true]);
    model
}

/// Force down on the apex at height h: 2 E A₀ ln(l₀/l) h/l, with ν = 0.
fn apex_force(h: f64) -> f64 {
    let (rest, l) = (1.01f64.sqrt(), (1.0 + h * h).sqrt());
    2.0 * 1e9 * AREA * (rest / l).ln() * h / l
}

#[test]
fn a_von_mises_truss_has_the_energy_of_the_closed_form_through_its_snap() {
    let mut model = von_mises_truss(1e-2);
    model.run.time_step = Some(2e-5);
    let shape = CurveShape::Table { times: vec![0.0, 1e-2], values: vec![0.0, -0.25], smooth: true };
    model.curves.insert("down".into(), Curve::from(shape));
    let displacement = [None, Some(Drive::Curve("down".into()))];
    model.constraints.push(Constraint {
        on: "truss.point1".into(),
        displacement: embate_solver::model::in_3d(displacement),
        ..Constraint::default()
    });
    see(&mut model, "apex", "truss.point1");
    let (rest, steps) = (1.01f64.sqrt(), every_step(&model));
    let (heights, elastic) = (steps.column("apex.y"), steps.column("energy.internal"));
    let most = 2.0 * 1e9 * AREA * (rest - 1.0 + (1.0 / rest).ln());
    for (h, energy) in heights.iter().zip(&elastic) {
        let l = (1.0 + h * h).sqrt();
        // 2 ∫ E A₀ ln(l/l₀) dl
        let expected = 2.0 * 1e9 * AREA * (l * (l / rest).ln() - l + rest);
        assert!((energy - expected).abs() < 1e-4 * most, "{h}: {energy} for {expected}, most {most}");
    }
    assert!(heights.iter().any(|h| *h < -0.1), "through the mirror image of its start");
}

#[test]
fn a_von_mises_truss_snaps_at_its_limit_load() {
    // Largest force on the way down, by ternary search: the curve has one maximum between 0 and 0.1.
    let (mut low, mut high) = (0.0, 0.1);
    for _ in 0..200 {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if apex_force(a) < apex_force(b) { low = a } else { high = b }
    }
    let limit = apex_force(low);
    for (share, snaps) in [(0.98, false), (1.02, true)] {
        let mut model = von_mises_truss(1.5);
        let shape = CurveShape::Table { times: vec![0.0, 0.3], values: vec![0.0, 1.0], smooth: true };
        model.curves.insert("slowly".into(), Curve::from(shape));
        let force = [0.0, -share * limit];
        model.loads.push(Load::Force {
            on: "truss.point1".into(),
            force: embate_solver::model::in_3d(force),
            curve: Some("slowly".into()),
        });
        model.loads.push(Load::Damping { parts: vec![], rate: 200.0, active: [0.0, f64::INFINITY] });
        see(&mut model, "apex", "truss.point1");
        let simulation = to_end(&model);
        let height = value(&simulation, "apex.y");
        assert_eq!(height < -0.05, snaps, "{share} of {limit}: {height}");
        if !snaps {
            assert!((apex_force(height) / (share * limit) - 1.0).abs() < 1e-3, "{}", apex_force(height) / limit);
        }
    }
}

#[test]
fn a_taut_cable_swings_with_the_frequency_of_the_string() {
    // Period 2L/√(σ/ρ), set going by gravity.
    let (stress, length) = (1e6, 1.0);
    let period = 2.0 * length / f64::sqrt(stress / 1e3);
    let mut model = model(period);
    truss(&mut model, "string", vec![vec![[0.0, 0.0], [0.5 * length, 0.0], [length, 0.0]]], 20);
    model.parts[0].stress_initial = Some(InitialStress::uniform([stress, 0.0, 0.0, 0.0]));
    hold(&mut model, "string.point0", [true, true]);
    hold(&mut model, "string.point2", [true, true]);
    gravity(&mut model, [0.0, -1.0]);
    see(&mut model, "middle", "string.point1");
    let steps = every_step(&model);
    let (times, y) = (steps.column("time"), steps.column("middle.y"));
    // Under a load that is there from the start the middle swings between 0 and twice its rest, ρ g L²/8σ;
    // the sum of odd modes is a triangle wave there.
    let lowest = y.iter().copied().fold(0.0, f64::min);
    let rest = -1e3 * length * length / (8.0 * stress);
    assert!((lowest / (2.0 * rest) - 1.0).abs() < 0.01, "{lowest} {rest}");
    let at = times.iter().zip(&y).find(|(_, y)| **y == lowest).map(|(time, _)| *time).unwrap();
    assert!((at / (0.5 * period) - 1.0).abs() < 0.02, "{} of half a period", at / (0.5 * period));
    assert!(y[y.len() - 1].abs() < 0.02 * lowest.abs(), "it is back after a period: {}", y[y.len() - 1]);
    let stored = 0.5 * stress * stress / 1e9 * AREA * length;
    assert!((steps.column("energy.internal")[0] / stored - 1.0).abs() < 1e-12);
}

#[test]
fn a_steel_bar_flows_at_its_yield_stress_and_books_the_plastic_work() {
    let mut steel = material("j2", 0.3);
    steel.parameters.insert("yield".into(), 2.0);
    steel.parameters.insert("hardening".into(), 0.05 * YOUNG);
    let mut bar = OneBar::new(&steel, [1.0, 0.0]);
    let (mut work, mut before) = (0.0, 0.0);
    for k in 1..=2000 {
        let l = 1.0 + 1e-5 * f64::from(k);
        bar.go([l, 0.0]);
        work += 0.5 * (bar.force()[0] + before) * 1e-5;
        before = bar.force()[0];
    }
    let state = bar.block.state(0);
    let plastic = bar.block.variable(&state, &PLASTIC_STRAIN).unwrap();
    // σ = σ_y + H ε_p, ln λ = σ/E + ε_p.
    let expected = (1.02f64.ln() - 2.0 / YOUNG) / (1.0 + 0.05);
    assert!((plastic / expected - 1.0).abs() < 1e-4 && (state.stress[0] - 2.0 - 0.05 * YOUNG * plastic).abs() < 1e-9, "{state:?}");
    assert!(((bar.report.stored + bar.report.dissipated) / work - 1.0).abs() < 1e-6 && bar.report.dissipated > 0.8 * work);
}

#[test]
fn bars_hang_on_a_block_by_joins_and_fall_with_it() {
    // A block on two bars of length 1 under gravity: it sinks by m g L / 2 E A in the mean, and momentum from
    // outside is all that there is.
    let mut model = model(0.3);
    model.materials.insert("bar".into(), elastic(1e9, 1e3));
    add(&mut model, "block", rectangle([0.0, 0.0], [0.5, 0.25], [2, 1]), [0.0; 2]);
    truss(&mut model, "left", vec![vec![[0.0, 0.25], [0.0, 1.25]]], 1);
    truss(&mut model, "right", vec![vec![[0.5, 0.25], [0.5, 1.25]]], 1);
    for side in ["left", "right"] {
        hold(&mut model, &format!("{side}.point1"), [true, true]);
        model.joins.push(Join { between: [format!("{side}.point0"), "block.top".into()], image: Image::Same, tolerance: None });
    }
    gravity(&mut model, [0.0, -9.81]);
    model.loads.push(Load::Damping { parts: vec![], rate: 60.0, active: [0.0, f64::INFINITY] });
    see(&mut model, "corner", "left.point0");
    let simulation = to_end(&model);
    let weight = 1e3 * (0.5 * 0.25 + AREA) * 9.81;
    let expected = 0.25 - weight / (2.0 * 1e9 * AREA);
    let sunk = (0.25 - value(&simulation, "corner.y")) / (0.25 - expected);
    assert!((sunk - 1.0).abs() < 0.01, "{sunk}");
    assert!(simulation.summary().energy_drift < 1e-3 && simulation.summary().ledger_residual < 1e-11);
}

#[test]
fn bars_of_a_mesh_file_share_nodes_with_its_surfaces() {
    let mut model = model(1e-3);
    let mut mesh = mapped([2, 2], |u, v| [u, v]);
    mesh.positions.push([2.0, 1.0, 0.0]);
    mesh.groups.push(group("stay", 1, [vec![2, 9], vec![8, 9]].into_iter()));
    add_groups(&mut model, mesh, &["body", "stay"], [1.0, 0.0]);
    let stay = &mut model.parts[1];
    (stay.element, stay.area) = ("bar2".into(), Some(AREA));
    let simulation = to_end(&model);
    let summary = simulation.summary();
    assert!((summary.elements, summary.nodes) == (6, 10) && summary.momentum_drift_linear.unwrap() < 1e-13, "{summary:?}");
    let mass = 1e3 * (1.0 + AREA * (1.0 + 2.0f64.sqrt()));
    let total: f64 = simulation.overview().parts.iter().map(|part| part.mass).sum();
    assert!((total / mass - 1.0).abs() < 1e-12);
}

#[test]
fn a_net_that_is_thrown_keeps_momentum_and_energy_and_its_bits() {
    let net = |threads: usize, simd: Option<&str>| {
        let mut model = model(0.02);
        model.materials.insert("soft".into(), material("neo_hookean", 0.3));
        let n = 6;
        let place = |i: i32, j: i32| [0.1 * f64::from(i), 0.1 * f64::from(j)];
        let rows = (0..=n).map(|j| (0..=n).map(|i| place(i, j)).collect());
        let columns = (0..=n).map(|i| (0..=n).map(|j| place(i, j)).collect());
        truss(&mut model, "net", rows.chain(columns).collect(), 2);
        model.parts[0].spin = 40.0;
        model.parts[0].velocity = [3.0, 1.0, 0.0];
        let options = embate_solver::simulation::Options { threads, simd: simd.map(String::from) };
        let mut simulation = embate_solver::simulation::Simulation::new(&model, &options).unwrap();
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        simulation.summary()
    };
    let one = net(1, Some("scalar"));
    assert!(one.momentum_drift_linear.unwrap() < 1e-13 && one.momentum_drift_angular.unwrap() < 1e-12, "{one:?}");
    assert!(one.energy_drift < 2e-3 && one.ledger_residual < 1e-12, "{one:?}");
    for level in Level::available() {
        assert_eq!(net(3, Some(level.name())).state_hash, one.state_hash);
    }
}

#[test]
fn a_bar_that_breaks_gives_its_energy_to_the_eroded() {
    let mut model = model(2e-3);
    model.materials.get_mut("soft").unwrap().failure.insert("principal_stress".into(), 2e6);
    truss(&mut model, "chain", vec![vec![[0.0, 0.0], [1.0, 0.0]]], 10);
    hold(&mut model, "chain.point0", [true, true]);
    model.parts[0].velocity = [3.0, 0.0, 0.0];
    let simulation = to_end(&model);
    let erosion = simulation.summary().erosion.unwrap();
    assert!(erosion.elements[0].1 >= 1, "{erosion:?}");
    let stores = simulation.ledger().stores;
    assert!(stores.eroded > 0.0 && simulation.ledger().drift() < 0.02, "{stores:?} {}", simulation.ledger().drift());
}

#[test]
fn initial_temperature_and_stress_are_those_of_the_bar() {
    let steel = material("johnson_cook", 0.3);
    let mut bar = OneBar::new(&steel, [0.0, 2.0]);
    bar.block.begin(&Initial { stress: None, temperature: Some(555.0) }, &bar.positions).unwrap();
    bar.go([0.0, 2.0]);
    assert_eq!(bar.block.variable(&bar.block.state(0), &TEMPERATURE), Some(555.0));
    let mut taut = OneBar::new(&material("elastic", 0.3), [0.0, 2.0]);
    taut.block.begin(&Initial { stress: Some(&InitialStress::uniform([3.0, 0.0, 0.0, 0.0])), temperature: None }, &taut.positions).unwrap();
    taut.go([0.0, 2.0]);
    assert_eq!((taut.block.state(0).stress[1], taut.force()), (3.0, [0.0, 3.0 * AREA]));
    assert!((taut.report.stored / (0.5 * 9.0 / YOUNG * AREA * 2.0) - 1.0).abs() < 1e-12);
}

#[test]
fn what_bars_can_not_be_is_refused_with_the_reason() {
    let base = || {
        let mut model = model(1e-3);
        truss(&mut model, "net", vec![vec![[0.0, 0.0], [1.0, 0.0]]], 2);
        add(&mut model, "block", rectangle([2.0, 0.0], [1.0, 1.0], [1, 1]), [0.0; 2]);
        model
    };
    assert_eq!(model_faults(&base()), []);
    let refused = |change: &dyn Fn(&mut Model), path: &str, says: &str| {
        let mut model = base();
        change(&mut model);
        let found = model_faults(&model);
        assert!(found.len() == 1 && found[0].path == path && found[0].message.contains(says), "{path}: {found:?}");
    };
    refused(&|model| model.parts[0].area = None, "part[0].area", "need their cross-section");
    refused(&|model| model.parts[0].area = Some(0.0), "part[0].area", "greater than 0");
    refused(&|model| model.parts[1].area = Some(1.0), "part[1].area", "cross-section of bars");
    refused(&|model| model.parts[0].stress_state = "plane_stress".into(), "part[0].stress_state", "along their line");
    let plane = |model: &mut Model| (model.parts[0].element, model.parts[0].area) = ("quad4".into(), None);
    refused(&plane, "part[0].truss", "made of bars, but element `quad4` has not");
    let shear = InitialStress::uniform([1.0, 0.0, 0.0, 1.0]);
    refused(&|model| model.parts[0].stress_initial = Some(shear), "part[0].stress_initial.xy", "along their line");
    let wood = |model: &mut Model| drop(model.materials.insert("soft".into(), material("orthotropic_elastic", 0.3)));
    refused(&wood, "part[0].material", "different directions");
    refused(&|model| touch(model, "net", "block"), "contact[0].between[0]", "no surface");
    refused(&|model| touch(model, "block", "net.point0"), "contact[0].between[1]", "no surface");
    let bodies = |model: &mut Model| {
        let partners = embate_solver::model::Partners::Bodies(vec!["block".into(), "net".into()]);
        model.contacts.push(Contact { name: "all".into(), partners, ..Contact::default() });
    };
    refused(&bodies, "contact[0].bodies[1]", "no surface");
    let wall = |model: &mut Model| {
        model.obstacles.push(Obstacle { parts: vec!["net".into()], ..Obstacle::wall("wall", [0.0, -1.0], [0.0, 1.0]) });
    };
    refused(&wall, "obstacle[0].parts[0]", "no surface");
    let press = |model: &mut Model| model.loads.push(Load::Pressure { on: "net".into(), pressure: 1.0, curve: None });
    refused(&press, "load[0].on", "no surface");
    refused(&|model| model.non_reflecting.push(NonReflecting { on: "net".into() }), "non_reflecting[0].on", "no surface");
    let lines = |lines: Vec<Vec<[f64; 2]>>| {
        move |model: &mut Model| model.parts[0].shape = Shape::Truss(Truss { lines: lines.clone(), elements: 1 })
    };
    let (a, b) = ([0.0, 0.0], [1.0, 0.0]);
    refused(&lines(vec![vec![a, b, b]]), "part[0].truss.lines", "twice running");
    refused(&lines(vec![vec![a, b], vec![b, a]]), "part[0].truss.lines", "is there twice");
    let revolved = |model: &mut Model| model.parts.iter_mut().for_each(|part| part.stress_state = "axisymmetric".into());
    refused(&revolved, "part[0].stress_state", "along their line");
}
