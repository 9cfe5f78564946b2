//! Soak: random models one after the other, without a panic, a leak, or a drift of energy or momentum that
//! nothing explains.
//!
//! `cargo test --release -p embate-solver --test embate-soak -- --seconds 7200 --first 1` (a minute from
//! model 1 if nothing is said; `--count 1 --first N` for one model). Odd numbers are models in 2D, even ones
//! in 3D; `--dimension 2` or `3` for one of them alone. Two of sixteen models run again with scalar lanes and
//! two threads and must end with the same state hash. `hashes.txt` has that of the first models as it was: a
//! change of the code that should change no result leaves it so, one that changes results makes it again
//! (`EMBATE_BLESS=1`, `--count 400`). What is found is reported with the number of the model. In 3D, where
//! all bodies meet in `double_pass`, elements say whether nodes of one body are deep in another one
//! (`inside.rs`): a run that does not say so is a finding. With `--heavy 1` every second material is 36 times
//! as heavy, with `--subcycling 1` all models run with subcycling, too, and with `--shells 1` most bodies of
//! models in 2D are shells, and models in 3D are others, of shells, beams and solids
//! (`generator_sheets.rs`): of these nothing is known before. `--show 1` prints models in full.
//!
//! A drift of energy that at most half is left of with a quarter of the step is an error of the steps: of
//! springs that are stiff against theirs, or of elements that collapse within a few. Those are counted. The
//! others of the first 2559 models are known (`drifts.txt`): one that is not there is a finding, and so is
//! one that drifts no more.

mod generator;
mod generator_sheets;
mod generator_space;
mod inside;

use embate_solver::error::Error;
use embate_solver::message::Message;
use embate_solver::model::{Formulation, Model, Partners};
use embate_solver::output::Summary;
use embate_solver::simulation::{Options, Simulation};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Largest drift of energy (fraction of the largest total) and of momentum that needs no explanation.
const ENERGY: f64 = 0.01;
/// The same with subcycling, whose vibrations between the steps of elements are in it.
const ENERGY_OF_SUBCYCLING: f64 = 0.03;
const MOMENTUM: f64 = 1e-9;
/// What is left of a drift with a quarter of the step where the step explains it.
const LEFT: f64 = 0.5;
/// Depth against the local thickness that is not reported by no run, and looks at the bodies in one.
const SILENT: f64 = 0.35;
const LOOKS: u64 = 24;
/// Models until memory has been used for the first time, and how much it may grow after them, bytes.
const WARM: u64 = 64;
const GROWTH: u64 = 64 << 20;

/// State hashes of the first models, a line each: the number and the hash.
const HASHES: &str = include_str!("hashes.txt");

/// Models whose energy is known to drift though a quarter of the step would not help: the number and the
/// drift.
const DRIFTS: &str = include_str!("drifts.txt");

/// What a table says, by the number of the model.
fn known(table: &str) -> BTreeMap<u64, String> {
    let lines = table.lines().filter_map(|line| line.split_once(' '));
    lines.filter_map(|(seed, what)| Some((seed.parse().ok()?, what.to_string()))).collect()
}

/// How models are changed.
#[derive(Clone, Copy, Default)]
struct Change {
    heavy: bool,
    subcycling: bool,
    shells: bool,
    /// Whether models are shown in full, and why they are refused.
    show: bool,
}

impl Change {
    /// Whether nothing is known of such models.
    fn is_new(self) -> bool {
        self.heavy || self.shells
    }
}

/// How one model ended.
enum End {
    Refused(&'static Message),
    Failed(Option<&'static Message>),
    Done,
}

fn main() {
    let (mut seconds, mut first, mut count, mut dimension, mut change) = (60.0, 1u64, u64::MAX, 0u64, Change::default());
    let words: Vec<String> = std::env::args().skip(1).collect();
    for pair in words.chunks(2) {
        match (pair[0].as_str(), pair.get(1).and_then(|word| word.parse::<f64>().ok())) {
            ("--seconds", Some(value)) => seconds = value,
            ("--first", Some(value)) => first = value as u64,
            ("--count", Some(value)) => count = value as u64,
            ("--dimension", Some(value)) => dimension = value as u64,
            ("--heavy", Some(value)) => change.heavy = value > 0.0,
            ("--subcycling", Some(value)) => (change.heavy, change.subcycling) = (value > 0.0, value > 0.0),
            ("--shells", Some(value)) => change.shells = value > 0.0,
            ("--show", Some(value)) => change.show = value > 0.0,
            // Those of the test runner.
            _ => {}
        }
    }
    inside::checks_itself();
    let begin = Instant::now();
    let (mut ends, mut found) = (BTreeMap::<String, u64>::new(), Vec::new());
    let (mut steps, mut longer, mut warm, mut done, mut drifting, mut stepping) = (0, 0, 0, 0, 0u64, 0u64);
    let (mut hashes, drifts) = if change.is_new() { Default::default() } else { (known(HASHES), known(DRIFTS)) };
    std::panic::set_hook(Box::new(|_| {}));
    let numbers = (first..u64::MAX).filter(|seed| dimension == 0 || dimension == dimension_of(*seed));
    for seed in numbers.take(count.try_into().unwrap_or(usize::MAX)) {
        if begin.elapsed() > Duration::from_secs_f64(seconds) {
            break;
        }
        match catch_unwind(AssertUnwindSafe(|| run(seed, change, [&mut steps, &mut longer], &mut hashes))) {
            Ok((end, drift, mut faults)) => {
                let by_step = drift.as_ref().is_some_and(|drift| drift.left < LEFT);
                stepping += u64::from(by_step);
                let drift = drift.filter(|_| !by_step);
                drifting += u64::from(drift.is_some());
                match (drift, drifts.contains_key(&seed)) {
                    (Some(Drift { reported, left }), false) => {
                        faults.push(format!("{reported}, {left:.2} of it with a quarter of the step"));
                    }
                    (None, true) => faults.push("drifts no more: take it from drifts.txt".into()),
                    _ => {}
                }
                // Said at once: a soak takes hours.
                faults.iter().for_each(|fault| println!("model {seed}: {fault}; {}", reported(seed, change)));
                let name = match end {
                    End::Refused(why) => format!("refused: {} {}", why.code, why.title),
                    End::Failed(why) => why.map_or("failed".into(), |why| format!("failed: {} {}", why.code, why.title)),
                    End::Done => "done".into(),
                };
                *ends.entry(name).or_default() += 1;
                found.extend(faults.into_iter().map(|fault| format!("model {seed}: {fault}; {}", reported(seed, change))));
            }
            Err(panic) => {
                let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
                found.push(format!("model {seed}: panic: {}", text.unwrap_or("without a text")));
            }
        }
        done += 1;
        if done == WARM {
            warm = resident();
        }
    }
    let grown = if warm > 0 { resident().saturating_sub(warm) } else { 0 };
    if grown > GROWTH {
        found.push(format!("memory grew by {} MiB after {WARM} models", grown >> 20));
    }
    println!(
        "soak: {done} models from {first} on, {steps} steps, {:.0} s, {drifting} drift, {stepping} more by the step, memory grew by {} kiB",
        begin.elapsed().as_secs_f64(),
        grown >> 10
    );
    if change.subcycling {
        println!("  {longer} with regions that are evaluated less often");
    }
    for (end, count) in &ends {
        println!("  {count:>6} {end}");
    }
    if is_blessed() && !change.is_new() {
        // Those of models that did not run stay.
        let lines: String = hashes.iter().map(|(seed, hash)| format!("{seed} {hash}\n")).collect();
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/soak/hashes.txt"), lines).expect("the table can be written");
    }
    found.iter().for_each(|fault| println!("FOUND {fault}"));
    assert!(found.is_empty(), "{} finding(s)", found.len());
}

/// Whether the table of hashes is to be made again.
fn is_blessed() -> bool {
    std::env::var_os("EMBATE_BLESS").is_some()
}

/// Of which dimension a model is.
fn dimension_of(seed: u64) -> u64 {
    if seed.is_multiple_of(2) { 3 } else { 2 }
}

/// Model number `seed`.
fn model(seed: u64, change: Change) -> Model {
    let mut model = match (dimension_of(seed), change.shells) {
        (3, true) => generator_sheets::model(seed),
        (3, false) => generator_space::model(seed),
        _ => generator::model(seed),
    };
    model.run.subcycling = change.subcycling;
    if change.shells && dimension_of(seed) == 2 {
        generator::thin(seed, &mut model);
    }
    if change.heavy {
        let heavy = model.materials.values_mut().skip(1).step_by(2);
        heavy.filter_map(|material| material.parameters.get_mut("density")).for_each(|density| *density *= 36.0);
    }
    model
}

/// A drift of energy that neither erosion nor forces that were not solved explain.
struct Drift {
    reported: String,
    /// What is left of it with a quarter of the step.
    left: f64,
}

/// Runs a model; its drift where that is large, and what is wrong with it.
fn run(seed: u64, change: Change, [steps, longer]: [&mut u64; 2], hashes: &mut BTreeMap<u64, String>) -> (End, Option<Drift>, Vec<String>) {
    let model = model(seed, change);
    let options = Options { threads: 1, simd: None };
    if change.show {
        println!("model {seed}: {model:#?}");
    }
    let mut simulation = match Simulation::new(&model, &options) {
        Err(Error::Model(faults)) if change.show => {
            faults.iter().for_each(|fault| println!("model {seed} is refused: {fault}"));
            return (End::Refused(faults[0].kind), None, Vec::new());
        }
        Ok(simulation) => simulation,
        Err(Error::Model(faults)) => return (End::Refused(faults[0].kind), None, Vec::new()),
        Err(error) => return (End::Failed(error.kind()), None, Vec::new()),
    };
    let (result, deepest) = looked_at(&model, &mut simulation);
    *steps += simulation.steps();
    let summary = simulation.summary();
    let drift = drift(&summary, &result, simulation.sweeps().1 > 0).or_else(|| borrowed(&simulation));
    let drift = drift.map(|(size, reported)| Drift { reported, left: finer(&model, &simulation) / size });
    let mut faults = wrong(&summary, &result);
    if is_blessed() {
        hashes.insert(seed, summary.state_hash.clone());
    } else if let Some(kept) = hashes.get(&seed).filter(|kept| **kept != summary.state_hash) {
        faults.push(format!("ends in the state {}, not in {kept} as before", summary.state_hash));
    }
    if let Some(inside::Deepest { parts: [own, other], ratio }) = deepest.filter(|deepest| deepest.ratio > SILENT)
        && summary.contact.unverified == 0
        && summary.erosion.is_none()
    {
        faults.push(format!("body {own} was {ratio:.2} of the thickness deep in body {other} in silence"));
    }
    if (seed / 2).is_multiple_of(8) && result.is_ok() {
        let again = Options { threads: 2, simd: Some("scalar".into()) };
        let other = Simulation::new(&model, &again).and_then(|mut other| other.advance(f64::INFINITY, u64::MAX).map(|()| other.summary()));
        match other {
            Ok(other) if other.state_hash == summary.state_hash => {}
            Ok(_) => faults.push("other bits with scalar lanes and two threads".into()),
            Err(error) => faults.push(format!("fails with scalar lanes and two threads: {error}")),
        }
    }
    if summary.element_evaluations.is_some_and(|count| count < summary.steps * summary.elements as u64) {
        *longer += 1;
    }
    (result.err().map_or(End::Done, |error| End::Failed(error.kind())), drift, faults)
}

/// Runs a model to its end; in 3D, where contact is that of all bodies, the deepest node of a body in
/// another one.
fn looked_at(model: &Model, simulation: &mut Simulation) -> (Result<(), Error>, Option<inside::Deepest>) {
    let is_of_all = |contact: &embate_solver::model::Contact| {
        contact.formulation == Formulation::DoublePass && matches!(&contact.partners, Partners::Bodies(parts) if parts.is_empty())
    };
    if simulation.dimension() != 3 || !model.contacts.iter().any(is_of_all) {
        return (simulation.advance(f64::INFINITY, u64::MAX), None);
    }
    let surfaces = inside::Surfaces::of(simulation.cells());
    let every = (model.run.max_steps.unwrap_or(600) / LOOKS).max(1);
    let mut deepest: Option<inside::Deepest> = None;
    loop {
        let before = simulation.steps();
        let result = simulation.advance(f64::INFINITY, every);
        if result.is_err() || simulation.steps() == before {
            return (result, deepest);
        }
        let found = surfaces.deepest(simulation.frame().positions());
        deepest = deepest.into_iter().chain(found).max_by(|a, b| a.ratio.total_cmp(&b.ratio));
    }
}

/// A drift of energy that neither erosion nor contact forces which were `unsolved` explain.
fn drift(summary: &Summary, result: &Result<(), Error>, unsolved: bool) -> Option<(f64, String)> {
    let most = if summary.element_evaluations.is_some() { ENERGY_OF_SUBCYCLING } else { ENERGY };
    let drifted = summary.energy_drift > most || matches!(result, Err(Error::EnergyDrift { .. }));
    let reported = || (summary.energy_drift, format!("energy drift {:.2e} after {} steps", summary.energy_drift, summary.steps));
    (drifted && summary.erosion.is_none() && !unsolved).then(reported)
}

/// Drift of energy until the same time with a quarter of the step; NaN if that does not come so far.
fn finer(model: &Model, coarse: &Simulation) -> f64 {
    let mut model = model.clone();
    model.run.safety *= 0.25;
    model.run.max_steps = None;
    let Ok(mut fine) = Simulation::new(&model, &Options { threads: 1, simd: None }) else { return f64::NAN };
    let _ = fine.advance(coarse.time(), 8 * coarse.steps());
    if fine.time() < 0.9 * coarse.time() {
        return f64::NAN;
    }
    fine.summary().energy_drift.max(-fine.ledger().stores.hourglass / fine.ledger().largest)
}

/// Energy that hourglass control has given without having taken it: the ledger close, and yet it comes from
/// nowhere.
fn borrowed(simulation: &Simulation) -> Option<(f64, String)> {
    let ledger = simulation.ledger();
    let share = ledger.stores.hourglass / ledger.largest;
    let reported = || format!("hourglass energy is {share:.2e} of the largest total after {} steps", simulation.steps());
    (share < -ENERGY).then(|| (-share, reported()))
}

/// Drifts of momentum, and numbers that are none.
fn wrong(summary: &Summary, result: &Result<(), Error>) -> Vec<String> {
    let mut faults = Vec::new();
    for (name, drift) in [("linear", summary.momentum_drift_linear), ("angular", summary.momentum_drift_angular)] {
        if let Some(drift) = drift.filter(|drift| !(*drift <= MOMENTUM)) {
            faults.push(format!("{name} momentum drifts by {drift:.2e} after {} steps", summary.steps));
        }
    }
    if let Err(error @ Error::NotFinite { .. }) = result {
        faults.push(error.to_string());
    }
    faults
}

/// What a model is made of.
fn reported(seed: u64, change: Change) -> String {
    let model = model(seed, change);
    let parts = model.parts.iter().map(|part| format!("{} of {}", part.element, model.materials[&part.material].law));
    let contacts = model.contacts.iter().map(|contact| format!("{:?} {:?}", contact.formulation, contact.interface));
    let obstacles = model.obstacles.iter().map(|obstacle| format!("{} {:?}", obstacle.name, obstacle.interface));
    let state = model.parts.first().map_or("", |part| part.stress_state.as_str());
    format!("{state}: {}", parts.chain(contacts).chain(obstacles).collect::<Vec<_>>().join(", "))
}

/// Memory in use, bytes; 0 where the system does not report it.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    status.split_whitespace().nth(1).and_then(|pages| pages.parse::<u64>().ok()).map_or(0, |pages| pages * 4096)
}
