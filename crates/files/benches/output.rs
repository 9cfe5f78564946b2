//! What output costs: `cargo bench -p embate-files --bench output [-- ELEMENTS_ALONG_A_SIDE...]`.
//!
//! A spinning block that flows: taking a frame of all its fields, packing it with one thread and with two,
//! and drawing and encoding a frame of its film. Each is reported in milliseconds, as the number of steps of
//! the same body that take as long, and, for two threads, as the ratio to one; all in the same run.

use embate_files::picture::{Film, FilmSettings};
use embate_files::threads::Threads;
use embate_files::vtu::VtuWriter;
use embate_solver::bench::{shortest, spinning_block};
use embate_solver::output::Frame;
use embate_solver::simulation::{Options, Simulation};
use std::hint::black_box;
use std::io::Cursor;

/// Frames of the film.
const FRAMES: usize = 24;

fn main() {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    for n in if sizes.is_empty() { vec![20, 100, 316] } else { sizes } {
        let mut simulation =
            Simulation::new(&spinning_block("quad4", "j2", n), &Options { threads: 1, simd: None }).expect("the model is sound");
        let steps = (20_000 / (n * n)).clamp(2, 50);
        let mut frames: Vec<Frame> = Vec::new();
        let mut step = f64::INFINITY;
        for _ in 0..FRAMES {
            step = step.min(1e3 * shortest(1, || simulation.advance(f64::INFINITY, steps as u64).expect("it runs")) / steps as f64);
            frames.push(simulation.frame());
        }
        println!("{} elements: a step {step:.3} ms", n * n);
        let taken = 1e3 * shortest(9, || drop(black_box(simulation.frame())));
        println!("  taking a frame          {taken:8.3} ms, {:6.1} steps", taken / step);

        let cells = simulation.cells();
        let last = &frames[FRAMES - 1];
        let raw = 16 * last.positions::<2>().len() + 8 * last.fields.iter().map(|field| field.values.len()).sum::<usize>();
        let mut single = 0.0;
        for count in [1, 2] {
            let threads = Threads::new(count);
            let writer = VtuWriter::new(&cells, &threads);
            let mut file = Cursor::new(Vec::new());
            let time = 1e3
                * shortest(15, || {
                    file.set_position(0);
                    writer.file(last, &[]).expect("fields fit their cells").write(&threads, &mut file).expect("a vector takes every byte");
                });
            let packed = file.get_ref().len();
            single = if count == 1 { time } else { single };
            let (share, rate) = (packed as f64 / raw as f64, 1e-3 * raw as f64 / time);
            println!(
                "  packing, {count} thread(s)    {time:8.3} ms, {:6.1} steps; {rate:.0} MB/s to {share:.2} of the size; ratio to one thread {:.2}",
                time / step,
                single / time
            );
        }

        let folder = std::env::temp_dir().join(format!("embate-bench-{}", std::process::id()));
        for count in [1, 2] {
            let threads = Threads::new(count);
            let mut film = Film::new(simulation.cells(), FilmSettings { title: "Spinning block".into(), ..FilmSettings::default() });
            frames.iter().for_each(|frame| film.add(frame));
            let time = 1e3 * shortest(5, || film.finish(&folder, &threads).expect("the folder can be written")) / FRAMES as f64;
            single = if count == 1 { time } else { single };
            println!(
                "  film, {count} thread(s)       {time:8.3} ms a frame, {:6.1} steps; ratio to one thread {:.2}",
                time / step,
                single / time
            );
        }
        std::fs::remove_dir_all(&folder).expect("it was just made");
    }
}
