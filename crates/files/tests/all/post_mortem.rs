//! Post-mortems without the program: a search that is stopped, and where keys stand.

use embate_files::PathPolicy;
use embate_files::model_file::{self, KeyPlace};
use embate_files::post_mortem::{Failed, PAGE};
use embate_solver::output::Frame;
use embate_solver::simulation::{Control, Observer, ObserverError, Options, Progress, Simulation};
use std::fs;
use std::path::Path;

/// Listens to nothing.
struct Deaf;

impl Observer for Deaf {
    fn frame(&mut self, _: Frame) -> Result<(), ObserverError> {
        Ok(())
    }
    fn row(&mut self, _: &[f64]) -> Result<(), ObserverError> {
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        Control::Continue
    }
}

#[test]
fn a_search_that_is_stopped_leaves_a_page_of_the_failure_alone() {
    let results = Path::new(env!("CARGO_TARGET_TMPDIR")).join("post-mortem-stopped");
    let _ = fs::remove_dir_all(&results);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../failures/inverted-element");
    let loaded = model_file::load_with_places(&path, &[], PathPolicy::Folder).unwrap();
    let options = Options { threads: 1, simd: None };
    let mut simulation = Simulation::new(&loaded.model, &options).unwrap();
    let error = simulation.run(&mut Deaf).unwrap_err();
    let failed = Failed {
        model: &loaded.model,
        loaded: &loaded,
        options: &options,
        simulation: &simulation,
        error: &error,
        checkpoints: &results,
        keeps_last_good: true,
        is_steered: false,
    };
    let stopped = failed.findings(|| false);
    assert!(stopped.trace.moments.len() == 1 && stopped.last_good.is_none() && stopped.fault.is_none(), "{}", stopped.how);
    failed.write(&stopped, &results).unwrap();
    let page = fs::read_to_string(results.join(PAGE)).unwrap();
    assert!(page.contains("element 181 of part \"pad\"") && page.contains("going to it once more was stopped"), "{page}");
    assert!(results.join("post-mortem/neighbourhood.svg").exists() && !results.join("post-mortem/failure-location.svg").exists());

    // The whole search replaces it, and has the state of the last good step.
    let found = failed.findings(|| true);
    assert_eq!(found.last_good.as_ref().map(|state| state.step), Some(simulation.steps() - 1));
    failed.write(&found, &results).unwrap();
    let page = fs::read_to_string(results.join(PAGE)).unwrap();
    assert!(page.contains("once more from the start") && page.contains("](failure-location.svg)"), "{page}");
    assert!(results.join("post-mortem/failure-location.svg").exists() && !results.join("post-mortem.part").exists());
}

#[test]
fn keys_are_found_with_their_values_and_lines() {
    let text = "run = { end = \"1 ms\" }\n\n[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n\n[[part]]\nname = \"block\"\nmaterial = \"steel\"\n\
                rectangle = { corner = [0, 0], size = [1, 1], elements = [2, 2] }\n";
    let loaded = model_file::load_text_with_places("m.toml", text, Path::new("."), &["part.block.velocity=[0, -1]".into()]).unwrap();
    let at = |path: &str| loaded.key(path);
    let place = |line, written: &str| KeyPlace { file: "m.toml".into(), line, written: Some(written.into()) };
    assert_eq!(at("run.end"), place(1, "\"1 ms\""));
    assert_eq!(at("part[0].rectangle.elements"), place(12, "[2, 2]"));
    assert_eq!(at("material.steel.young"), place(6, "\"200 GPa\""));
    assert_eq!(at("part[0].velocity"), KeyPlace { file: "--set".into(), line: 0, written: Some("[0, -1]".into()) });
    // What is not there: the line of the nearest thing above it.
    assert_eq!((at("run.safety").line, at("run.safety").written), (1, None));
    assert_eq!((at("part[0].spin").line, at("part[0].spin").written), (9, None));
    assert_eq!((at("output.fields").line, at("output.fields").written), (0, None));
}
