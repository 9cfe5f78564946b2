//! Damaged inputs one after the other: whatever a file holds, its reader answers, and soon.
//!
//! `cargo test --release -p embate-files --test embate-fuzz -- --seconds 600 [--only model|gmsh|deck|state] [--first N] [--count N]` (two seconds each if nothing is said). Inputs are those of the other
//! tests with bytes flipped, cut out, doubled, put in from elsewhere, and numbers made large, negative or none; input number N is always the same. States are damaged behind their check sums.
#![allow(clippy::unwrap_used)] // what is found is told with its number

mod damage;

use damage::Damage;
use embate_files::{abaqus, gmsh, model_file};
use embate_solver::archive::Section;
use embate_solver::bench::Random;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Longest time that an answer may take, s.
const SLOW: f64 = 5.0;

/// Reads bytes; panics where the answer is wrong.
type Read = Box<dyn Fn(&[u8])>;

/// A reader with inputs that it takes.
struct Target {
    name: &'static str,
    seeds: Vec<Vec<u8>>,
    read: Read,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| words.iter().position(|word| word == key).and_then(|at| words.get(at + 1)).cloned();
    let seconds = value("--seconds").and_then(|word| word.parse().ok()).unwrap_or(2.0);
    let first: u64 = value("--first").and_then(|word| word.parse().ok()).unwrap_or(1);
    let count: u64 = value("--count").and_then(|word| word.parse().ok()).unwrap_or(u64::MAX);
    let mut found = Vec::new();
    let targets = [model(), gmsh(), deck(), state()];
    // Of one input alone the panic tells its place.
    if count > 1 {
        std::panic::set_hook(Box::new(|_| {}));
    }
    for target in targets {
        if value("--only").is_none_or(|only| only == target.name) {
            found.extend(fuzz(&target, Duration::from_secs_f64(seconds), first, count));
        }
    }
    found.iter().for_each(|fault| println!("FOUND {fault}"));
    assert!(found.is_empty(), "{} finding(s)", found.len());
}

/// Reads damaged inputs until the time is over; what went wrong.
fn fuzz(target: &Target, time: Duration, first: u64, count: u64) -> Vec<String> {
    let (begin, mut found, mut done) = (Instant::now(), Vec::new(), 0);
    for number in first..first.saturating_add(count) {
        if begin.elapsed() > time {
            break;
        }
        let bytes = Damage::new(&target.seeds).of(&mut Random::apart(number));
        let start = Instant::now();
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| (target.read)(&bytes))) {
            let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
            found.push(format!("{} {number}: panic: {}", target.name, text.unwrap_or("without a text")));
        }
        let took = start.elapsed().as_secs_f64();
        if took > SLOW {
            found.push(format!("{} {number}: {took:.1} s for {} bytes", target.name, bytes.len()));
        }
        done += 1;
    }
    println!("{:>6}: {done} inputs from {first} on, {:.0} s", target.name, begin.elapsed().as_secs_f64());
    found
}

/// Files of a folder and those below with this ending, not longer than a few pages.
fn files(folder: &Path, ending: &str) -> Vec<Vec<u8>> {
    let mut found: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    let of = |path: PathBuf| {
        if path.is_dir() {
            files(&path, ending)
        } else {
            Vec::from_iter(path.to_str().unwrap().ends_with(ending).then(|| fs::read(path).unwrap()))
        }
    };
    found.into_iter().flat_map(of).filter(|bytes| bytes.len() < 10_000).collect()
}

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn model() -> Target {
    let seeds = [files(&here("../../examples"), ".toml"), files(&here("../../verification"), ".toml")].concat();
    let folder = here("../../examples/tube-plate-gmsh");
    let read = move |bytes: &[u8]| {
        if let Ok(text) = std::str::from_utf8(bytes) {
            let _ = model_file::load_text("model.toml", text, &folder, &[]);
        }
    };
    Target { name: "model", seeds, read: Box::new(read) }
}

fn gmsh() -> Target {
    let read = |bytes: &[u8]| {
        if let Ok(mesh) = gmsh::parse(bytes, "m.msh", 1.0) {
            let nodes = mesh.positions.len();
            assert!(
                mesh.groups.iter().flat_map(|group| &group.cells).flatten().all(|&node| (node as usize) < nodes),
                "a node that is not there"
            );
            assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()), "a place that is nowhere");
        }
    };
    Target { name: "gmsh", seeds: files(&here("tests/gmsh"), ".msh"), read: Box::new(read) }
}

fn deck() -> Target {
    let folder = here("tests/abaqus");
    let seeds = files(&folder, ".inp");
    let read = move |bytes: &[u8]| drop(abaqus::parse(bytes, "m.inp", &folder, 1.0));
    Target { name: "deck", seeds, read: Box::new(read) }
}

/// Two blocks that meet, with friction, failure and a wall.
const MEETING: &str = r#"
run.end = "1 ms"
material.steel = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "100 MPa", hardening = "1 GPa", failure = { plastic_strain = 0.5 } }
part = [
    { name = "a", material = "steel", element = "quad4_reduced", rectangle = { corner = [0, 0], size = [0.01, 0.01], elements = [2, 2] }, velocity = [50, 0] },
    { name = "b", material = "steel", rectangle = { corner = [0.01, 0.001], size = [0.01, 0.01], elements = [2, 2] } },
]
contact = [{ name = "all", bodies = "all", friction = 0.3 }]
obstacle = [{ name = "wall", plane = { point = [0.0201, 0], normal = [-1, 0] } }]
output.pictures = false
"#;

/// States behind their check sums: who damages those, too, gets an error or another run, but no panic.
fn state() -> Target {
    let model: Model = model_file::load_text("model.toml", MEETING, Path::new("."), &[]).unwrap_or_else(|told| panic!("{}", told.rendered));
    let options = Options { threads: 1, simd: None };
    let mut simulation = Simulation::new(&model, &options).unwrap();
    simulation.advance(f64::INFINITY, 30).unwrap();
    let sections = simulation.state().unwrap().sections;
    let seeds = vec![sections.iter().flat_map(|section| section.bytes.clone()).collect()];
    let read = move |bytes: &[u8]| {
        // Lengths of the sections are the container's: what is damaged is within.
        let mut rest = bytes;
        let last = sections.len() - 1;
        let cut = |(i, section): (usize, &Section)| {
            let (own, others) = rest.split_at(if i == last { rest.len() } else { section.bytes.len().min(rest.len()) });
            rest = others;
            Section { name: section.name.clone(), bytes: own.to_vec() }
        };
        let damaged: Vec<Section> = sections.iter().enumerate().map(cut).collect();
        if let Ok(mut simulation) = Simulation::resumed(&model, &options, &damaged) {
            let _ = simulation.advance(f64::INFINITY, 3);
            let _ = simulation.summary();
        }
    };
    Target { name: "state", seeds, read: Box::new(read) }
}
