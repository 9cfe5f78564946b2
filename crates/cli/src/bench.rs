//! `embate bench`: how fast this machine is: kernels, whole steps and contact, beside what its memory and its
//! arithmetic could do at best.
//!
//! Bodies and rates are those of `embate_solver::bench`; here are the choice of rows, the time that each may
//! take, the tables and the JSON.

use crate::cli_error::CliError;
use crate::interrupt::Interrupt;
use crate::numbers::{grouped, table};
use crate::{Failure, machine, terminal, version};
use clap::Args;
use embate_files::results::write_whole;
use embate_solver::bench::{self, Level, Patch};
use embate_solver::error::Error;
use embate_solver::material;
use embate_solver::mesh::cell::CellKind;
use embate_solver::model::{Model, Partners};
use embate_solver::simulation::{Options, Simulation};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::time::Instant;

/// What is measured, and for how long.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Every law with `quad4`, and not only the usual ones
    #[arg(long)]
    all: bool,
    /// Time for all measurements together, s; making large bodies comes on top. Below 5 s these are left out
    #[arg(long, value_name = "S", default_value_t = 20.0, value_parser = seconds)]
    seconds: f64,
    /// Write all figures and the machine to this file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No tables
    #[arg(long, short, requires = "json")]
    quiet: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..=3600.0).contains(&seconds) => Ok(seconds),
        _ => Err("give seconds from 0 to 3600".to_string()),
    }
}

/// Elements along a side of a body that stays in a cache, of one of about 100,000, and of one of about a
/// million, in 2D and 3D.
const SMALL: [usize; 2] = [32, 10];
const MIDDLE: [usize; 2] = [316, 46];
const LARGE: [usize; 2] = [1024, 101];
/// Elements of the stack of strips with contact, and along the long sides of slabs of ten layers.
const STRIPS: usize = 100_000;
const SLABS: usize = 71;
/// Memory that an element may take while large bodies are made, bytes: with some to spare.
const BYTES_PER_ELEMENT: u64 = 2000;
/// Shortest time for all measurements with which large bodies are measured, s.
const SECONDS_FOR_LARGE: f64 = 5.0;
/// Bytes of an array of the triad.
const TRIAD: u64 = 128 << 20;

const ELEMENTS: [&str; 3] = ["quad4", "quad4_full", "quad4_reduced"];
/// Elements in 3D, and the cells of their patches.
const SOLIDS: [(&str, CellKind); 3] =
    [("hex8", CellKind::Hexahedron), ("hex8_reduced", CellKind::Hexahedron), ("tet4", CellKind::Tetrahedron)];
/// Coefficients of bulk viscosity, where a row has it.
const VISCOSITY: [f64; 2] = [0.06, 1.2];

/// Whole steps that are measured: element, law, elements along a side in 2D and 3D, all threads, bulk
/// viscosity.
#[rustfmt::skip]
const STEPS: &[(&str, &str, [usize; 2], bool, bool)] = &[
    ("quad4", "elastic", SMALL, false, false),
    ("quad4", "j2", SMALL, false, false),
    ("quad4_reduced", "elastic", SMALL, false, false),
    ("quad4_reduced", "j2", SMALL, false, false),
    ("quad4_reduced", "j2", SMALL, false, true),
    ("hex8", "j2", SMALL, false, false),
    ("hex8_reduced", "j2", SMALL, false, false),
    ("hex8_reduced", "j2", SMALL, false, true),
    ("quad4", "j2", MIDDLE, false, false),
    ("quad4_reduced", "j2", MIDDLE, false, false),
    ("hex8", "j2", MIDDLE, false, false),
    ("hex8_reduced", "j2", MIDDLE, false, false),
    ("hex8_reduced", "j2", MIDDLE, true, false),
    ("quad4", "j2", LARGE, false, false),
    ("quad4", "j2", LARGE, true, false),
    ("quad4_reduced", "j2", LARGE, false, false),
    ("quad4_reduced", "j2", LARGE, true, false),
    ("hex8_reduced", "j2", LARGE, false, false),
    ("hex8_reduced", "j2", LARGE, true, false),
];
const LAWS: [&str; 3] = ["elastic", "j2", "neo_hookean"];

/// Of what a contact is measured, how it is made, and the coefficient of friction.
type Pressing = (&'static str, fn() -> Model, f64);
const CONTACTS: &[Pressing] = &[
    ("strips in 2D", strips, 0.0),
    ("strips in 2D, with friction", strips, 0.3),
    ("slabs of hex8_reduced", slabs, 0.0),
    ("slabs of hex8_reduced, with friction", slabs, 0.3),
];

fn strips() -> Model {
    bench::strips(STRIPS, 2.0)
}

fn slabs() -> Model {
    bench::slabs(SLABS, 2.0, 0.3)
}

/// A rate of element-steps.
struct Row {
    element: &'static str,
    law: &'static str,
    elements: usize,
    threads: usize,
    level: &'static str,
    /// Whether with bulk viscosity.
    is_viscous: bool,
    /// Element-steps per second.
    rate: f64,
    /// Resident memory per element, bytes; of large bodies.
    memory: Option<f64>,
}

struct Ceilings {
    /// Threads and bytes per second.
    triad: Vec<(usize, f64)>,
    /// Instruction set and operations per second of one thread.
    arithmetic: Vec<(&'static str, f64)>,
}

/// Share of contact in a step.
struct Share {
    of: &'static str,
    elements: usize,
    without: f64,
    with: f64,
}

/// Measures one thing after the other; each takes its share of the time.
struct Bench {
    /// Time of a figure, s.
    each: f64,
    interrupt: Interrupt,
    left_out: Vec<String>,
}

pub(crate) fn bench(arguments: &Arguments) -> Result<(), Failure> {
    let begin = Instant::now();
    let interrupt = Interrupt::watch();
    let threads = machine::processors();
    let has_large = arguments.seconds >= SECONDS_FOR_LARGE;
    let laws = if arguments.all { material::registry().len() } else { LAWS.len() };
    let small = STEPS.iter().filter(|(_, _, side, ..)| *side == SMALL).count();
    // Of a large body two figures' time.
    let steps = if has_large { 2 * STEPS.len() - small + CONTACTS.len() } else { small };
    let count = 2 + Level::available().len() + LAWS.len() * (ELEMENTS.len() + SOLIDS.len()) + laws + steps;
    let mut bench = Bench { each: arguments.seconds / count as f64, interrupt, left_out: Vec::new() };
    let print = |text: &str| if arguments.quiet { Ok(()) } else { terminal::print(text) };

    print(&machine_text(threads))?;
    let ceilings = bench.ceilings(threads)?;
    print(&ceilings_text(&ceilings))?;
    let kernels = bench.kernels(arguments.all)?;
    print(&rows_text("kernels alone, one thread", &kernels, &ceilings))?;
    let steps = bench.steps(threads, has_large)?;
    print(&rows_text("whole steps without contact and output", &steps, &ceilings))?;
    let shares = if has_large { bench.contact()? } else { Vec::new() };
    if !has_large {
        bench.left_out.push(format!("large bodies and contact: they need --seconds {SECONDS_FOR_LARGE} or more"));
    }
    print(&closing_text(&shares, &bench.left_out, begin.elapsed().as_secs_f64()))?;
    let Some(file) = &arguments.json else { return Ok(()) };
    let value = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "commit": version::commit(),
        "machine": {
            "processor": machine::processor(),
            "processors": threads,
            "memory_available": machine::memory_available(),
            "levels": Level::available().iter().map(|level| level.name()).collect::<Vec<_>>(),
        },
        "ceilings": {
            "triad": ceilings.triad.iter().map(|(threads, rate)| json!({ "threads": threads, "bytes_per_second": rate })).collect::<Vec<_>>(),
            "multiply_add": ceilings.arithmetic.iter().map(|(level, rate)| json!({ "level": level, "threads": 1, "operations_per_second": rate })).collect::<Vec<_>>(),
        },
        "kernels": kernels.iter().map(|row| row.json(&ceilings)).collect::<Vec<_>>(),
        "steps": steps.iter().map(|row| row.json(&ceilings)).collect::<Vec<_>>(),
        "contact": shares.iter().map(Share::json).collect::<Vec<_>>(),
        "left_out": bench.left_out,
        "wall_seconds": begin.elapsed().as_secs_f64(),
    });
    let text = serde_json::to_string_pretty(&value).expect("plain numbers, texts and lists always have a JSON form") + "\n";
    write_whole(file, text.as_bytes()).map_err(|error| Failure::Run(CliError::new(error.kind(), error)))
}

impl Bench {
    fn continue_run(&self) -> Result<(), Failure> {
        if self.interrupt.is_pressed() { Err(Failure::Interrupted) } else { Ok(()) }
    }

    fn ceilings(&mut self, threads: usize) -> Result<Ceilings, Failure> {
        let bytes = machine::memory_available().map_or(TRIAD, |all| TRIAD.min(all / 16));
        let mut triad = Vec::new();
        for threads in if threads > 1 { vec![1, threads] } else { vec![1] } {
            self.continue_run()?;
            triad.push((threads, bench::triad(Level::best(), threads, bytes as usize, self.each)));
        }
        let arithmetic = Level::available().into_iter().map(|level| (level.name(), bench::multiply_add(level, self.each))).collect();
        Ok(Ceilings { triad, arithmetic })
    }

    fn kernels(&mut self, all: bool) -> Result<Vec<Row>, Failure> {
        let patch = Patch::new(SMALL[0]);
        let registered: Vec<&'static str> = material::registry().iter().map(|kind| kind.name).collect();
        let best = Level::best();
        let usual = |element: &'static str| LAWS.map(|law| (element, law, best));
        let mut wanted: Vec<(&str, &str, Level)> = ELEMENTS.into_iter().flat_map(usual).collect();
        wanted.extend(Level::available().into_iter().filter(|level| *level != best).map(|level| ("quad4", "j2", level)));
        if all {
            wanted.extend(registered.into_iter().filter(|law| !LAWS.contains(law)).map(|law| ("quad4", law, best)));
        }
        let mut rows = Vec::new();
        for (element, law, level) in wanted {
            self.continue_run()?;
            let rate = bench::kernel(element, law, &patch, level, self.each).map_err(failed)?;
            rows.push(Row::new((element, law), SMALL[0] * SMALL[0], level, rate));
        }
        for (element, cell) in SOLIDS {
            let patch = Patch::solid(cell, SMALL[1]);
            for law in LAWS {
                self.continue_run()?;
                let rate = bench::kernel(element, law, &patch, best, self.each).map_err(failed)?;
                rows.push(Row::new((element, law), patch.connectivity.len() / cell.facts().nodes, best, rate));
            }
        }
        Ok(rows)
    }

    fn steps(&mut self, threads: usize, has_large: bool) -> Result<Vec<Row>, Failure> {
        let mut rows = Vec::new();
        let side = self.large(has_large);
        for &(element, law, wanted, on_all, is_viscous) in STEPS {
            let (is_small, is_solid) = (wanted == SMALL, SOLIDS.iter().any(|(solid, _)| *solid == element));
            if (!has_large && !is_small) || (on_all && threads == 1) {
                continue;
            }
            self.continue_run()?;
            let dimension = usize::from(is_solid);
            let n = wanted[dimension].min(side[dimension]);
            let mut model = if is_solid { bench::spinning_cube(element, law, n) } else { bench::spinning_block(element, law, n) };
            if is_viscous {
                model.run.bulk_viscosity = VISCOSITY;
            }
            let threads = if on_all { threads } else { 1 };
            let options = Options { threads, simd: None };
            let elements = if is_solid { n * n * n } else { n * n };
            let mut memory = None;
            let rate = if is_small {
                bench::step(&model, &options, self.each).map_err(failed)?
            } else {
                let before = machine::memory_used();
                let mut simulation = Simulation::new(&model, &options).map_err(failed)?;
                let rate = bench::steps_of(&mut simulation, 2.0 * self.each).map_err(failed)?;
                let used =
                    machine::memory_used().zip(before).and_then(|(after, before)| after.checked_sub(before)).filter(|used| *used > 0);
                // Smaller ones take what others have left.
                memory = used.filter(|_| wanted == LARGE).map(|used| used as f64 / elements as f64);
                rate
            };
            rows.push(Row { threads, is_viscous, memory, ..Row::new((element, law), elements, Level::best(), rate) });
        }
        Ok(rows)
    }

    /// Most elements along a side of a body in 2D and 3D, as memory allows.
    fn large(&mut self, is_wanted: bool) -> [usize; 2] {
        let room = machine::memory_available().map_or(f64::INFINITY, |bytes| (bytes / BYTES_PER_ELEMENT) as f64);
        let most = [room.sqrt(), room.cbrt()];
        let sides = [0, 1].map(|k| LARGE[k].min(most[k] as usize).max(SMALL[k]));
        if is_wanted && sides != LARGE {
            let all = LARGE[0] * LARGE[0];
            self.left_out.push(format!("bodies of {} elements: memory is enough for {}", grouped(all as u64), grouped(room as u64)));
        }
        sides
    }

    fn contact(&mut self) -> Result<Vec<Share>, Failure> {
        let mut shares = Vec::new();
        for &(of, make, friction) in CONTACTS {
            self.continue_run()?;
            let plain = make();
            let mut touching = plain.clone();
            touching.contacts.push(bench::contact(Partners::Bodies(Vec::new()), friction));
            let one = Options { threads: 1, simd: None };
            let ([without, with], [simulation, _]) = bench::step_times([&plain, &touching], &one, 9, self.each).map_err(failed)?;
            shares.push(Share { of, elements: simulation.summary().elements, without, with });
        }
        Ok(shares)
    }
}

fn failed(error: Error) -> Failure {
    Failure::Run(CliError::from(&error))
}

impl Ceilings {
    /// Operations per second of so many threads, if each had what one has.
    fn arithmetic(&self, level: &str, threads: usize) -> Option<f64> {
        self.arithmetic.iter().find(|(name, _)| *name == level).map(|(_, rate)| rate * threads as f64)
    }

    fn triad(&self, threads: usize) -> Option<f64> {
        self.triad.iter().find(|(count, _)| *count == threads).map(|(_, rate)| *rate)
    }
}

impl Row {
    /// On one thread, without bulk viscosity.
    fn new((element, law): (&'static str, &'static str), elements: usize, level: Level, rate: f64) -> Self {
        Self { element, law, elements, threads: 1, level: level.name(), is_viscous: false, rate, memory: None }
    }

    /// Multiplications and additions that the ceiling has time for in one element-step.
    fn operations(&self, ceilings: &Ceilings) -> Option<f64> {
        Some(ceilings.arithmetic(self.level, self.threads)? / self.rate)
    }

    /// Fraction of the triad's bandwidth that it takes to read each byte of the body once a step.
    fn pass(&self, ceilings: &Ceilings) -> Option<f64> {
        Some(self.memory? * self.rate / ceilings.triad(self.threads)?)
    }

    fn json(&self, ceilings: &Ceilings) -> Value {
        json!({
            "element": self.element,
            "law": self.law,
            "elements": self.elements,
            "threads": self.threads,
            "level": self.level,
            "bulk_viscosity": self.is_viscous,
            "element_steps_per_second": self.rate,
            "operations_at_ceiling": self.operations(ceilings),
            "bytes_per_element": self.memory,
            "pass_over_triad": self.pass(ceilings),
        })
    }
}

impl Share {
    fn json(&self) -> Value {
        let (without, with) = (self.without, self.with);
        json!({ "of": self.of, "elements": self.elements, "seconds_without": without, "seconds_with": with, "share": self.fraction() })
    }

    fn fraction(&self) -> f64 {
        1.0 - self.without / self.with
    }
}

fn machine_text(threads: usize) -> String {
    let name = machine::processor();
    let name = if name.is_empty() { String::new() } else { format!("{name}, ") };
    let levels: Vec<&str> = Level::available().iter().map(|level| level.name()).collect();
    format!("machine: {name}{threads} processor(s), {}\n\n", levels.join(", "))
}

fn ceilings_text(ceilings: &Ceilings) -> String {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (threads, rate) in &ceilings.triad {
        rows.push(vec!["memory, triad".into(), format!("{threads} thread(s)"), format!("{:.1} GB/s", rate * 1e-9)]);
    }
    for (level, rate) in &ceilings.arithmetic {
        rows.push(vec!["multiply and add".into(), (*level).to_string(), format!("{:.1} Gflop/s, one thread", rate * 1e-9)]);
    }
    format!("ceilings\n{}\n", table(&rows, "  "))
}

fn rows_text(title: &str, rows: &[Row], ceilings: &Ceilings) -> String {
    let has_memory = rows.iter().any(|row| row.memory.is_some());
    let mut head = vec!["element", "law", "elements", "threads", "level", "million/s", "operations"];
    if has_memory {
        head.extend(["bytes/element", "one pass of triad"]);
    }
    let mut lines = vec![head.into_iter().map(String::from).collect::<Vec<_>>()];
    for row in rows {
        let mut line = vec![
            row.element.to_string(),
            if row.is_viscous { format!("{}, bulk viscosity", row.law) } else { row.law.to_string() },
            grouped(row.elements as u64),
            row.threads.to_string(),
            row.level.to_string(),
            format!("{:.1}", row.rate * 1e-6),
            row.operations(ceilings).map_or(String::new(), |count| format!("{count:.0}")),
        ];
        line.push(row.memory.map_or(String::new(), |bytes| format!("{bytes:.0}")));
        line.push(row.pass(ceilings).map_or(String::new(), |fraction| format!("{:.0} %", 100.0 * fraction)));
        lines.push(line);
    }
    format!("{title}: million element-steps per second\n{}\n", table(&lines, "  "))
}

fn closing_text(shares: &[Share], left_out: &[String], seconds: f64) -> String {
    let mut text = String::new();
    if !shares.is_empty() {
        let mut rows =
            vec![["bodies in motion, one thread", "elements", "ms without contact", "ms with it", "share"].map(String::from).to_vec()];
        rows.extend(shares.iter().map(|share| {
            let milliseconds = |seconds: f64| format!("{:.2}", 1e3 * seconds);
            let (without, with) = (milliseconds(share.without), milliseconds(share.with));
            vec![share.of.into(), grouped(share.elements as u64), without, with, format!("{:.0} %", 100.0 * share.fraction())]
        }));
        text.push_str(&format!("contact of all bodies with each other and themselves\n{}\n", table(&rows, "  ")));
    }
    text.push_str("operations: multiplications and additions for which the ceiling has time in one element-step\n");
    for what in left_out {
        text.push_str(&format!("left out: {what}\n"));
    }
    text + &format!("measured in {seconds:.0} s\n")
}
