//! The whole step without contact: `cargo bench -p embate-solver --bench step [-- ELEMENT...]`.
//!
//! A square block, a plate or a strip that flies and stretches, in cache and out of it: million element-steps
//! per second of the elements alone and of the whole step, whose rest is assembly, nodes and the ledger.

use embate_solver::bench::{best_rate, spinning_block, spinning_sheet};
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};

/// Shells and beams, with the points through their thickness or the fibres along each side.
const SHEETS: &[(&str, usize)] = &[("shell4", 5), ("shell2", 5), ("beam2", 2), ("beam2", 4)];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let wanted = |element: &str| words.iter().all(|word| word.parse::<usize>().is_ok()) || words.iter().any(|word| word == element);
    let sizes: Vec<usize> = words.iter().filter_map(|word| word.parse().ok()).collect();
    println!("million element-steps per second of the whole step, best of the rounds of a second");
    for n in if sizes.is_empty() { vec![20, 32, 64, 100, 2000] } else { sizes.clone() } {
        for element in ["quad4", "quad4_reduced"].into_iter().filter(|element| wanted(element)) {
            measure(&spinning_block(element, "j2", n), element);
        }
    }
    for n in if sizes.is_empty() { vec![20, 32, 100, 1000] } else { sizes } {
        for (element, points) in SHEETS.iter().filter(|(element, _)| wanted(element)) {
            measure(&spinning_sheet(element, "j2", n * n, *points), &format!("{element}, {points}"));
        }
    }
}

fn measure(model: &Model, name: &str) {
    let mut line = String::new();
    let (mut single, mut elements) = (0.0, 0);
    for threads in [1, 2] {
        let mut simulation = Simulation::new(model, &Options { threads, simd: None }).expect("the model is sound");
        elements = simulation.summary().elements;
        let steps = (20_000 / elements).clamp(1, 50).max(if elements < 90_000 { 20 } else { 1 }) as u64;
        simulation.advance(f64::INFINITY, 4).expect("it runs");
        let rate = 1e-6
            * best_rate(1.0, || {
                simulation.advance(f64::INFINITY, steps).expect("it runs");
                steps as f64 * elements as f64
            });
        single = if threads == 1 { rate } else { single };
        line += &format!("  {threads} thread(s) {rate:6.1} ({:.2}), {:.2} us a step", rate / single, elements as f64 / rate);
    }
    println!("  {elements:>9} elements  {name:<14}{line}");
}
