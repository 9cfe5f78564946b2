//! Damaged inputs one after the other: whatever a file holds, its reader answers, and soon.
//!
//! `cargo test -p embate-files --test embate-fuzz -- --seconds 600 [--first N] [--count N] [--only TARGET]`,
//! where TARGET is model, gmsh, deck, checkpoint, state or fields
//! (two seconds each if nothing is said). Inputs are those of the other tests (`--write DIR` writes them
//! there) with bytes flipped, cut out, doubled, put in from elsewhere, and numbers made large, negative or
//! none; input number N is always the same. States and checkpoints are damaged behind their check sums.
#![allow(clippy::unwrap_used)] // what is found is reported with its number

mod damage;
mod targets;

use damage::Damage;
use embate_solver::bench::Random;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};
use targets::{Target, checkpoint, deck, fields, gmsh, model, state};

/// Folder of this crate.
const FILES: &str = env!("CARGO_MANIFEST_DIR");
/// Longest time that an answer may take, s.
const SLOW: f64 = 5.0;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| words.iter().position(|word| word == key).and_then(|at| words.get(at + 1)).cloned();
    let seconds = value("--seconds").and_then(|word| word.parse().ok()).unwrap_or(2.0);
    let first: u64 = value("--first").and_then(|word| word.parse().ok()).unwrap_or(1);
    let count: u64 = value("--count").and_then(|word| word.parse().ok()).unwrap_or(u64::MAX);
    let mut found = Vec::new();
    let targets = [model(), gmsh(), deck(), checkpoint(), state(), fields()];
    if let Some(folder) = value("--write") {
        targets.iter().for_each(|target| write(target, &Path::new(&folder).join(target.name)));
        return;
    }
    // Of one input alone the panic reports its place.
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

/// Writes the inputs that are damaged, one a file: what `fuzz/` begins with.
fn write(target: &Target, folder: &Path) {
    fs::create_dir_all(folder).unwrap();
    for (number, seed) in target.seeds.iter().enumerate() {
        fs::write(folder.join(format!("seed-{number:03}")), seed).unwrap();
    }
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
