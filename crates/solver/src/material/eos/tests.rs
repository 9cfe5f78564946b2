use super::*;
use crate::material::points::{self, Points, RESPONSE, Scratch};
use crate::material::registry;
use crate::material::variable::DENSITY;
use embate_lanes::{Batch, Level};

/// A material with each equation.
fn material(law: &str, eos: &str) -> Material {
    let values: &[(&str, f64)] = match eos {
        "linear" => &[("density", 1000.0), ("bulk_modulus", 2.2e9)],
        "mie_gruneisen" => &[
            ("density", 8930.0),
            ("c0", 3940.0),
            ("s1", 1.489),
            ("s2", 0.2),
            ("s3", 0.1),
            ("gamma0", 2.02),
            ("gamma_slope", 0.47),
            ("energy_initial", 1e6),
        ],
        "polynomial" => &[("density", 1000.0), ("energy_initial", 1e5)],
        "ideal_gas" => &[("density", 1.25), ("gamma", 1.4), ("pressure_initial", 1e5)],
        "jwl" => &[
            ("density", 1630.0),
            ("pressure_a", 371.2e9),
            ("pressure_b", 3.231e9),
            ("r1", 4.15),
            ("r2", 0.95),
            ("omega", 0.30),
            ("energy_initial", 7e9),
        ],
        other => panic!("no values for {other}"),
    };
    let mut material = Material { law: law.into(), eos: eos.into(), ..Material::default() };
    material.parameters = values.iter().map(|&(name, value)| (name.to_string(), value)).collect();
    if eos == "polynomial" {
        material.lists.insert("coefficients".into(), vec![1e5, 2.2e9, 9.5e9, 14.5e9]);
        material.lists.insert("coefficients_energy".into(), vec![0.28, 0.1, 0.05]);
    }
    let solid = [("young", 2e9), ("poisson", 0.3), ("yield", 1e7)];
    if law != "null" {
        material.parameters.extend(solid.map(|(name, value)| (name.to_string(), value)));
    }
    material
}

fn parameters<'a>(material: &'a Material, kind: &EquationKind) -> Parameters<'a> {
    Parameters::new(kind.parameters, &material.parameters, &material.lists)
}

/// A point that is driven through strains.
struct Point {
    law: Box<dyn PointLaw>,
    stress: [Batch; 4],
    state: Vec<Batch>,
    ratio: f64,
    response: [Batch; RESPONSE],
    /// ∫ σ:dε per initial volume.
    work: f64,
    dissipated: f64,
}

impl Point {
    fn new(material: &Material) -> Self {
        let law = points::plane(material).unwrap();
        let mut state = vec![Batch::default(); law.state_width()];
        law.start(&mut state);
        let mut point =
            Self { law, stress: Default::default(), state, ratio: 1.0, response: Default::default(), work: 0.0, dissipated: 0.0 };
        point.step([0.0; 4], 1.0, 0.0);
        point
    }

    fn step(&mut self, strain: [f64; 4], ratio: f64, viscous_heat: f64) {
        let points = Points {
            time_step: 1e-6,
            strain: &strain.map(Batch::splat),
            rotation: &[],
            volume_ratio: &[Batch::splat(ratio)],
            viscous_heat: &[Batch::splat(viscous_heat)],
            stress: &mut self.stress,
            state: &mut self.state,
            response: &mut self.response,
            scratch: &mut Scratch::default(),
        };
        self.law.respond(Level::SCALAR, points);
        let middle = 0.5 * (self.ratio + ratio);
        self.work += 0.5 * self.response[0].0[3] * middle;
        self.dissipated += self.response[1].0[3] * middle;
        self.ratio = ratio;
    }

    /// To the volume ratio in one step, along x.
    fn squeeze(&mut self, ratio: f64) {
        let strain = (ratio - self.ratio) / (0.5 * (ratio + self.ratio));
        self.step([strain, 0.0, 0.0, 0.0], ratio, 0.0);
    }

    fn own(&self, place: usize) -> f64 {
        self.state[self.state.len() - 3 + place].0[3]
    }
    fn energy(&self) -> f64 {
        self.own(1)
    }
    fn pressure(&self) -> f64 {
        -(self.stress[0].0[3] + self.stress[1].0[3] + self.stress[2].0[3]) / 3.0
    }
    fn bulk(&self) -> f64 {
        self.response[2].0[3]
    }
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs())
}

#[test]
fn the_slopes_are_those_of_the_terms() {
    struct Slopes<'a>(&'a Material);
    impl EquationVisitor for Slopes<'_> {
        type Output = ();
        fn visit<Q: Equation>(self) {
            let equation = Q::new(&parameters(self.0, &Q::KIND));
            for ratio in [0.7, 0.95, 1.0 - 1e-4, 1.0 + 1e-4, 1.3, 3.0] {
                let (h, at) = (1e-6, equation.terms(ratio));
                let (plus, minus) = (equation.terms(ratio + h), equation.terms(ratio - h));
                let (cold, heat) = ((plus.cold - minus.cold) / (2.0 * h), (plus.heat - minus.heat) / (2.0 * h));
                assert!(close(cold, at.cold_slope, 1e-6), "{} at {ratio}: {cold} {}", Q::KIND.name, at.cold_slope);
                assert!(close(heat, at.heat_slope, 1e-6) || (heat - at.heat_slope).abs() < 1e-8, "{} at {ratio}", Q::KIND.name);
            }
        }
    }
    for kind in EQUATIONS {
        with_equation(kind.name, Slopes(&material("null", kind.name))).unwrap();
    }
}

#[test]
fn the_reported_stiffness_is_the_slope_of_the_isentrope() {
    for kind in EQUATIONS {
        for ratio in [0.8, 1.0 - 1e-3, 1.2] {
            let mut point = Point::new(&material("null", kind.name));
            for k in 1..=1000 {
                point.squeeze(1.0 + (ratio - 1.0) * f64::from(k) / 1000.0);
            }
            let (bulk, pressure) = (point.bulk(), point.pressure());
            point.squeeze(ratio * (1.0 - 1e-6));
            let slope = (point.pressure() - pressure) / 1e-6;
            assert!(close(slope, bulk, 1e-4), "{} at {ratio}: {slope} for {bulk}", kind.name);
        }
    }
}

#[test]
fn at_rest_there_are_the_pressure_and_energy_of_the_start() {
    for kind in EQUATIONS {
        let material = material("null", kind.name);
        let point = Point::new(&material);
        let [bulk, shear] = point.law.stiffness();
        assert!(close(point.bulk(), bulk, 1e-12) && shear == 0.0 && bulk > 0.0, "{}", kind.name);
        assert!(close(point.energy(), point.law.stored(), 1e-15), "{}", kind.name);
        assert!((point.pressure() - point.own(2)).abs() < 1e-9 * bulk && point.work == 0.0, "{}", kind.name);
        assert_eq!(point.law.variables().last(), Some(&DENSITY.at(0)));
        assert_eq!(point.own(0), material.parameters["density"]);
    }
    assert!(close(Point::new(&material("null", "ideal_gas")).pressure(), 1e5, 1e-12));
    assert!(close(Point::new(&material("null", "ideal_gas")).law.stiffness()[0], 1.4e5, 1e-12));
}

#[test]
fn a_gas_follows_its_isentrope_to_second_order() {
    let error = |steps: i32| {
        let mut point = Point::new(&material("null", "ideal_gas"));
        for k in 1..=steps {
            point.squeeze(1.0 - 0.5 * f64::from(k) / f64::from(steps));
        }
        assert!(close(point.own(0), 2.5, 1e-14), "density {}", point.own(0));
        point.pressure() / (1e5 * 2f64.powf(1.4)) - 1.0
    };
    let [coarse, fine] = [error(50), error(100)];
    assert!(coarse.abs() < 1e-3 && (3.8..4.2).contains(&(coarse / fine)), "{coarse} {fine}");
}

#[test]
fn a_jump_in_one_step_lies_on_the_hugoniot() {
    // ½ p Δv is what a shock leaves as energy, and the balance of one step is just this.
    let mut material = material("null", "mie_gruneisen");
    for name in ["s2", "s3", "energy_initial"] {
        material.parameters.insert(name.into(), 0.0);
    }
    for particle in [100.0, 500.0, 1500.0] {
        let shock = 3940.0 + 1.489 * particle;
        let mut point = Point::new(&material);
        point.squeeze(1.0 - particle / shock);
        let expected = 8930.0 * shock * particle;
        assert!(close(point.pressure(), expected, 1e-12), "{particle}: {} for {expected}", point.pressure());
    }
    let mut gas = Point::new(&self::material("null", "ideal_gas"));
    gas.squeeze(0.5);
    // p/p₀ = ((γ+1) − (γ−1) v) / ((γ+1) v − (γ−1))
    assert!(close(gas.pressure(), 1e5 * (2.4 - 0.2) / (1.2 - 0.4), 1e-12), "{}", gas.pressure());
}

#[test]
fn energy_is_work_and_heat_whatever_the_way() {
    let mut numbers = 1u64;
    let mut random = |low: f64, high: f64| {
        numbers = numbers.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((numbers >> 11) as f64 / (1u64 << 53) as f64)
    };
    for kind in EQUATIONS {
        let mut point = Point::new(&material("null", kind.name));
        let (start, mut heat) = (point.energy(), 0.0);
        for _ in 0..300 {
            let ratio = random(0.85, 1.15);
            let dilatation = (ratio - point.ratio) / (0.5 * (ratio + point.ratio));
            let added = random(0.0, 1e-5) * point.law.stiffness()[0];
            heat += added;
            point.step([dilatation, 0.0, 0.0, 0.0], ratio, added);
        }
        let (left, size) = (start + point.work + heat - point.energy(), point.energy().abs().max(heat));
        assert!(left.abs() < 1e-12 * size, "{}: {left} of {size}", kind.name);
    }
}

#[test]
fn what_a_solid_dissipates_heats_it() {
    for kind in EQUATIONS {
        let mut point = Point::new(&material("j2", kind.name));
        let start = point.energy();
        for k in 1..=2000 {
            let ratio = 1.0 - 0.1 * f64::from(k) / 2000.0;
            let dilatation = (ratio - point.ratio) / (0.5 * (ratio + point.ratio));
            point.step([0.5 * dilatation, 0.5 * dilatation, 0.0, 1e-4], ratio, 0.0);
        }
        // What is left of the work is the elastic energy of the deviator at its limit, σ_y² / 6µ.
        let left = start + point.work - point.energy();
        let elastic = 1e14 / 6.0 / (2e9 / 2.6);
        assert!(point.dissipated > 1e6, "{}: {}", kind.name, point.dissipated);
        assert!((left / elastic - 1.0).abs() < 0.1, "{}: {left} for {elastic}", kind.name);
    }
}

#[test]
fn the_deviator_is_that_of_the_law() {
    let with = material("j2", "linear");
    let without = Material { eos: String::new(), ..with.clone() };
    let (mut with, mut without) = (Point::new(&with), Point::new(&without));
    for _ in 0..20 {
        for point in [&mut with, &mut without] {
            let ratio = point.ratio * 0.998;
            point.step([-0.003, 0.001, 0.0, 0.004], ratio, 0.0);
        }
        let deviator = |point: &Point, c: usize| point.stress[c].0[0] + if c < 3 { point.pressure() } else { 0.0 };
        for c in 0..4 {
            assert!((deviator(&with, c) - deviator(&without, c)).abs() < 1e-6 * 1e7);
        }
    }
    assert!(close(with.pressure(), 2.2e9 * (1.0 / with.ratio - 1.0), 1e-12));
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for kind in EQUATIONS {
        let outcome = |level: Level| {
            let mut point = Point::new(&material("j2", kind.name));
            for k in 0..20 {
                let ratio = Batch(std::array::from_fn(|lane| 1.0 + 0.02 * f64::sin((k * (lane + 1)) as f64)));
                let strain =
                    [0.01, -0.02, 0.0, 0.01].map(|size: f64| Batch(std::array::from_fn(|lane| size * f64::cos((k * lane) as f64))));
                let points = Points {
                    time_step: 1e-6,
                    strain: &strain,
                    rotation: &[],
                    volume_ratio: &[ratio],
                    viscous_heat: &[Batch::splat(1.0)],
                    stress: &mut point.stress,
                    state: &mut point.state,
                    response: &mut point.response,
                    scratch: &mut Scratch::default(),
                };
                point.law.respond(level, points);
            }
            let all = point.stress.iter().chain(&point.state).chain(&point.response);
            all.flat_map(|batch| batch.0).map(f64::to_bits).collect::<Vec<_>>()
        };
        let reference = outcome(Level::SCALAR);
        assert!(Level::available().into_iter().all(|level| outcome(level) == reference), "{}", kind.name);
    }
}

#[test]
fn a_key_that_a_law_and_an_equation_share_means_the_same() {
    for equation in EQUATIONS {
        assert!(!equation.doc.is_empty() && !equation.source.is_empty());
        for parameter in equation.parameters {
            for law in registry() {
                let shared = law.parameters.iter().find(|own| own.name == parameter.name);
                assert!(
                    shared.is_none_or(|own| own.dimension == parameter.dimension),
                    "{} {}: {}",
                    law.name,
                    equation.name,
                    parameter.name
                );
            }
        }
    }
}

#[test]
fn a_gas_needs_one_of_pressure_and_energy_and_every_material_a_stiffness() {
    let mut gas = material("null", "ideal_gas");
    let faults_of = |it: &Material| faults(&it.eos, &parameters(it, kind(&it.eos).unwrap()));
    assert!(faults_of(&gas).is_empty());
    gas.parameters.insert("energy_initial".into(), 1.0);
    assert!(faults_of(&gas)[0].help.contains("leave one out"));
    gas.parameters.insert("pressure_initial".into(), 0.0);
    assert!(faults_of(&gas).is_empty() && Point::new(&gas).energy() == 1.0);
    gas.parameters.remove("energy_initial");
    assert!(faults_of(&gas)[0].message.contains("no stiffness"));
    let mut wrong = material("null", "polynomial");
    wrong.lists.insert("coefficients".into(), vec![0.0, -1e9]);
    assert_eq!(faults_of(&wrong)[0].name, "eos");
}

#[test]
fn the_pressure_stops_at_the_limit_in_tension_and_the_way_back_is_the_same() {
    for equation in EQUATIONS {
        for law in ["null", "j2"] {
            let mut limited = material(law, equation.name);
            let limit = 1e5;
            limited.parameters.insert(TENSION.name.into(), limit);
            let (mut free, mut point) = (Point::new(&material(law, equation.name)), Point::new(&limited));
            let start = point.energy();
            let mut way = Vec::new();
            // Out and back, past the start.
            for k in 1..=300 {
                let ratio = if k <= 100 { 1.0 + 1e-4 * f64::from(k) } else { 1.01 - 1e-4 * f64::from(k - 100) };
                free.squeeze(ratio);
                point.squeeze(ratio);
                way.push((point.pressure(), point.energy()));
                let held = (-point.pressure() - limit).abs() < 1e-6 * (limit + point.stress[0].0[3].abs());
                assert!(point.pressure() >= -limit * (1.0 + 1e-6) || held, "{} {law} {ratio}: {}", equation.name, point.pressure());
            }
            let stops = way.iter().filter(|(pressure, _)| (*pressure + limit).abs() < 1e-3 * limit).count();
            // Gases have no tension to stop.
            assert_eq!(stops > 100, free.law.stiffness()[0] > 1e9 && equation.name != "jwl", "{} {law}: {stops}", equation.name);
            if law == "null" {
                let balance = point.energy() - start - point.work;
                assert!(balance.abs() < 1e-9 * point.work.abs().max(limit), "{}: {balance}", equation.name);
                assert!(close(point.energy(), free.energy(), 1e-4), "{}: {} {}", equation.name, point.energy(), free.energy());
            }
        }
    }
}
