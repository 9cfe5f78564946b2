//! Embate's half of the comparison with the broad phases of ipctk: `against_ipctk.py` beside this file writes
//! the geometry, runs this and prints the table.
//!
//! The folder in the first argument holds `old.f64`, `new.f64` (x and y of each node at both ends of a step)
//! and `segments.u32` (two nodes each), all little-endian. All nodes are searched against all segments,
//! within the reach in the second argument.
//!
//! `build N THREADS`: N searches, each with a new object, then N with one object, after one that isn't timed;
//! prints the nanoseconds of each, and the number of pairs, which go to `pairs.u32`. `run N PART`: moves the
//! nodes N times by `new - old`, scaled so that the fastest moves by PART of the skin; the skin is the reach.
//! Searches when a contact would: at the start, and when a node has moved by half the skin. Prints the
//! nanoseconds of all searches, those of looking whether the skin is left, and the number of searches.

use embate_solver::contact::search::{Pair, Query, Search, registry};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// What the files hold.
struct Geometry {
    old: Vec<[f64; 2]>,
    new: Vec<[f64; 2]>,
    slaves: Vec<u32>,
    facets: Vec<[u32; 2]>,
}

impl Geometry {
    fn read(folder: &str) -> Result<Self, Box<dyn Error>> {
        let bytes = |name: &str| std::fs::read(format!("{folder}/{name}"));
        let number = |b: &[u8]| b.try_into().map(f64::from_le_bytes);
        let points = |name: &str| -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
            bytes(name)?.chunks_exact(16).map(|b| Ok([number(&b[..8])?, number(&b[8..])?])).collect()
        };
        let node = |b: &[u8]| b.try_into().map(u32::from_le_bytes);
        let (old, new) = (points("old.f64")?, points("new.f64")?);
        let facets: Result<Vec<[u32; 2]>, Box<dyn Error>> =
            bytes("segments.u32")?.chunks_exact(8).map(|b| Ok([node(&b[..4])?, node(&b[4..])?])).collect();
        let facets = facets?;
        let count = old.len().min(new.len()) as u32;
        if facets.iter().flatten().any(|&n| n >= count) {
            return Err("a segment names a node that is not there".into());
        }
        Ok(Self { slaves: (0..count).collect(), old, new, facets })
    }
    fn query<'a>(&'a self, positions_old: &'a [[f64; 2]], positions_new: &'a [[f64; 2]], reach: f64) -> Query<'a, 2> {
        Query { positions_old, positions_new, slaves: &self.slaves, facets: &self.facets, reach }
    }
}

fn fresh() -> Box<dyn Search<2>> {
    (registry::<2>()[0].make)()
}

/// Times searches with new objects and with one; pairs go to a file.
fn build(geometry: &Geometry, reach: f64, times: usize, threads: usize, folder: &str) -> Result<(), Box<dyn Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let query = geometry.query(&geometry.old, &geometry.new, reach);
    let mut kept = (fresh(), Vec::new());
    let line = |name: &str, kept: Option<&mut (Box<dyn Search<2>>, Vec<Pair>)>| {
        let elapsed = pool.install(|| {
            let start = Instant::now();
            match kept {
                Some((search, pairs)) => search.pairs(black_box(&query), pairs),
                None => {
                    let (mut search, mut pairs) = (fresh(), Vec::new());
                    search.pairs(black_box(&query), &mut pairs);
                    black_box(&pairs);
                }
            }
            start.elapsed()
        });
        println!("{name} {}", elapsed.as_nanos());
    };
    // One that isn't timed: the other side's process also has its memory and its threads when it is timed.
    pool.install(|| fresh().pairs(&query, &mut Vec::new()));
    for _ in 0..times {
        line("fresh", None);
    }
    for _ in 0..times {
        line("kept", Some(&mut kept));
    }
    let bytes: Vec<u8> = kept.1.iter().flat_map(|p| [p.slave, p.facet]).flat_map(u32::to_le_bytes).collect();
    std::fs::write(format!("{folder}/pairs.u32"), bytes)?;
    println!("pairs {}", kept.1.len());
    Ok(())
}

/// Times the searches of a run, and the looks between them.
fn run(geometry: &Geometry, skin: f64, steps: usize, part: f64) {
    let length = |v: [f64; 2]| (v[0] * v[0] + v[1] * v[1]).sqrt();
    let mut velocities: Vec<_> = geometry.old.iter().zip(&geometry.new).map(|(a, b)| [b[0] - a[0], b[1] - a[1]]).collect();
    let fastest = velocities.iter().map(|&v| length(v)).fold(0.0, f64::max);
    velocities.iter_mut().flatten().for_each(|v| *v *= part * skin / fastest);
    let mut search = fresh();
    let mut pairs = Vec::new();
    let (mut old, mut new) = (geometry.old.clone(), geometry.old.clone());
    let mut at_search: Vec<[f64; 2]> = Vec::new();
    let (mut searching, mut looking, mut searches) = (0, 0, 0);
    for _ in 0..steps {
        old.copy_from_slice(&new);
        for (x, v) in new.iter_mut().zip(&velocities) {
            *x = [x[0] + v[0], x[1] + v[1]];
        }
        let start = Instant::now();
        let left = is_left(skin, black_box(&geometry.slaves), &at_search, black_box(&new));
        looking += start.elapsed().as_nanos();
        if left {
            let start = Instant::now();
            // As a contact asks: what may come within the skin, and both sides may move as far as the
            // fastest.
            let query = geometry.query(&old, &new, 1.001 * (skin + 2.0 * std::f64::consts::SQRT_2 * part * skin));
            search.pairs(black_box(&query), &mut pairs);
            at_search.clear();
            at_search.extend(geometry.slaves.iter().map(|&node| new[node as usize]));
            searching += start.elapsed().as_nanos();
            searches += 1;
        }
        black_box(&pairs);
    }
    println!("searching {searching}\nlooking {looking}\nsearches {searches}");
}

/// As the contact does it in every step: whether some node has moved by more than half the skin since the
/// last search.
fn is_left(skin: f64, nodes: &[u32], at_search: &[[f64; 2]], positions: &[[f64; 2]]) -> bool {
    let limit = 0.25 * skin * skin;
    at_search.is_empty()
        || nodes.iter().zip(at_search).any(|(&node, from)| {
            let x = positions[node as usize];
            let moved = [x[0] - from[0], x[1] - from[1]];
            !(moved[0] * moved[0] + moved[1] * moved[1] <= limit)
        })
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        [folder, reach, "build", times, threads] => {
            build(&Geometry::read(folder)?, reach.parse()?, times.parse()?, threads.parse()?, folder)
        }
        [folder, reach, "run", steps, part] => {
            run(&Geometry::read(folder)?, reach.parse()?, steps.parse()?, part.parse()?);
            Ok(())
        }
        _ => {
            println!("against_ipctk: run by crates/solver/benches/against_ipctk.py, which measures the searches against those of ipctk");
            Ok(())
        }
    }
}
