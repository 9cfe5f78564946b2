//! What a checkpoint costs: `cargo bench -p embate-files --bench checkpoint [-- ELEMENTS_ALONG_A_SIDE...]`.
//!
//! A spinning block that flows everywhere, so that no number is like another: taking the state, packing and
//! writing it (synchronised with the disk), and reading it back. Each is reported in milliseconds and as the
//! number of steps of the same body that take as long; the size as a share of the plain state.

use embate_files::checkpoint::{Checkpoint, generations};
use embate_files::threads::Threads;
use embate_solver::bench::{shortest, spinning_block};
use embate_solver::simulation::{Options, Simulation};
use std::hint::black_box;

fn main() {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    for n in if sizes.is_empty() { vec![100, 316, 1000] } else { sizes } {
        for (element, law) in [("quad4_reduced", "elastic"), ("quad4_reduced", "j2"), ("quad4", "j2")] {
            let model = spinning_block(element, law, n);
            let mut simulation = Simulation::new(&model, &Options { threads: 2, simd: None }).expect("the model is sound");
            let steps = (2_000_000 / (n * n)).clamp(5, 200) as u64;
            let step = 1e3 * shortest(1, || simulation.advance(f64::INFINITY, steps).expect("it runs")) / steps as f64;
            println!("{} elements {element} {law}: a step {step:.3} ms", n * n);
            let mut state = simulation.state().expect("every state can be kept");
            let taken = 1e3 * shortest(3, || state = simulation.state().expect("every state can be kept"));
            let plain: usize = state.sections.iter().map(|section| section.bytes.len()).sum();
            println!("  taking the state   {taken:9.2} ms, {:6.1} steps; {:.1} MB", taken / step, 1e-6 * plain as f64);
            let folder = std::env::temp_dir().join(format!("embate-bench-{}", std::process::id()));
            let checkpoint = Checkpoint::of(state, &model);
            for count in [1, 2] {
                let threads = Threads::new(count);
                let time = 1e3 * shortest(3, || checkpoint.write(&folder, &threads).expect("the folder can be written"));
                let path = &generations(&folder)[0].path;
                let size = std::fs::metadata(path).expect("it was just written").len() as f64;
                println!("  writing, {count} thread(s) {time:9.2} ms, {:6.1} steps; {:.2} of the size", time / step, size / plain as f64);
                let time = 1e3 * shortest(3, || drop(black_box(Checkpoint::read(path, &threads).expect("it was just written"))));
                println!("  reading, {count} thread(s) {time:9.2} ms, {:6.1} steps", time / step);
            }
            std::fs::remove_dir_all(&folder).expect("it was just made");
        }
    }
}
