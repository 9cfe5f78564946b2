//! The whole step without contact: `cargo bench -p embate-solver --bench step [-- ELEMENT...]`.
//!
//! A square block that flies and stretches, in cache and out of it: million element-steps per second of the elements alone and of the whole step, whose rest is
//! assembly, nodes and the books.

use embate_solver::bench::spinning_block;
use embate_solver::simulation::{Options, Simulation};
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let wanted = |element: &str| words.iter().all(|word| word.parse::<usize>().is_ok()) || words.iter().any(|word| word == element);
    let sizes: Vec<usize> = words.iter().filter_map(|word| word.parse().ok()).collect();
    println!("million element-steps per second of the whole step, least of the rounds of a second");
    for n in if sizes.is_empty() { vec![20, 32, 64, 100, 2000] } else { sizes } {
        for element in ["quad4", "quad4_reduced"].into_iter().filter(|element| wanted(element)) {
            let model = spinning_block(element, "j2", n);
            let mut line = format!("  {:>9} elements  {element:<14}", n * n);
            let mut single = 0.0;
            for threads in [1, 2] {
                let mut simulation = Simulation::new(&model, &Options { threads, simd: None }).expect("the model is sound");
                let steps = (20_000 / (n * n)).clamp(1, 50).max(if n < 300 { 20 } else { 1 }) as u64;
                simulation.advance(f64::INFINITY, 4).expect("it runs");
                // Many short rounds: some of them are undisturbed by what else the machine does.
                let (mut least, began) = (f64::INFINITY, Instant::now());
                while began.elapsed().as_secs_f64() < 1.0 {
                    let start = Instant::now();
                    simulation.advance(f64::INFINITY, steps).expect("it runs");
                    least = least.min(start.elapsed().as_secs_f64() / steps as f64);
                }
                let rate = 1e-6 * (n * n) as f64 / least;
                single = if threads == 1 { rate } else { single };
                line += &format!("  {threads} thread(s) {rate:6.1} ({:.2}), {:.2} us a step", rate / single, least * 1e6);
            }
            println!("{line}");
        }
    }
}
