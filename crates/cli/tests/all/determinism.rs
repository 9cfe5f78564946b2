//! The same bits whatever a model runs on: every example with any number of threads and each instruction set
//! that the machine has.

use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::fs;
use std::path::{Path, PathBuf};

/// Instruction sets of this machine.
pub(crate) fn instruction_sets() -> Vec<String> {
    let there = |name: &&str| {
        let model = Model::default();
        let options = Options { threads: 1, simd: Some((*name).into()) };
        // An empty model has other faults.
        Simulation::new(&model, &options).err().is_none_or(|error| !error.to_string().contains("instruction set"))
    };
    ["scalar", "avx2", "avx512"].into_iter().filter(there).map(String::from).collect()
}

/// The models that people copy.
pub(crate) fn examples() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut models: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    models.sort();
    models
}

/// Steps that tests do of an example: of solids, which are larger, fewer.
pub(crate) fn steps_of(model: &Model) -> u64 {
    if model.dimension() == 3 { 300 } else { 1500 }
}

#[test]
fn every_example_has_the_same_bits_on_any_threads_and_each_instruction_set() {
    let (levels, is_long) = (instruction_sets(), std::env::var_os("EMBATE_LONG").is_some());
    let models = examples();
    assert!(models.len() >= 17 && levels.contains(&"scalar".to_string()));
    let best = levels.len() - 1;
    for (number, folder) in models.into_iter().enumerate() {
        let model = embate_files::model_file::load(&folder, &[]).unwrap_or_else(|reported| panic!("{}", reported.rendered));
        let steps = steps_of(&model);
        let hash = |threads: usize, simd: &str| {
            let mut simulation = Simulation::new(&model, &Options { threads, simd: Some(simd.into()) }).unwrap();
            simulation.advance(f64::INFINITY, steps).unwrap();
            (simulation.summary().state_hash, simulation.hashes())
        };
        let wanted = hash(3, &levels[best]);
        let name = format!("examples/{} after {steps} steps", folder.file_name().unwrap().display());
        crate::hashes::is_as_before(&name.replace(' ', "-"), &wanted.0);
        // Threads share out the same work whatever computes it: all counts are tried with one set. In the
        // short form an example has one set besides the best one, which takes turns.
        for (index, simd) in levels.iter().enumerate() {
            let threads = match (is_long, index == best) {
                (true, true) => &[1, 2, 7][..],
                (true, false) => &[1, 3],
                (false, false) if number % best == index => &[1 + index],
                (false, _) => &[],
            };
            for &threads in threads {
                assert_eq!(hash(threads, simd), wanted, "{} on {threads} thread(s) with {simd}", folder.display());
            }
        }
    }
}
