//! Result folders, filled by a make-believe simulation.

use embate_files::results::{OnProgress, Outcome, Recorder, ResultFolder, ResultsError, RunStatus};
use embate_solver::model::Model;
use embate_solver::output::{CellKind, Cells, FIELDS, Field, Frame, Location, Outline, Summary};
use embate_solver::simulation::{Control, Observer, Options, Progress, Simulation};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A path of this test alone, empty.
fn fresh(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn model() -> Model {
    let mut model = Model { name: "fake".into(), ..Model::default() };
    model.run.end = 1e-3;
    model
}

/// A quadrilateral and a triangle on its right.
fn cells() -> Cells {
    Cells {
        nodes: vec![0, 1, 2, 3, 1, 4, 2],
        offsets: vec![0, 4, 7],
        kinds: vec![CellKind::Quadrilateral, CellKind::Triangle],
        parts: vec![0, 1],
        part_names: vec!["left".into(), "right".into()],
        revision: 0,
    }
}

/// Everything moves with 3 m/s along x and -1 m/s along y.
fn frame(step: u64) -> Frame {
    let time = step as f64 * 1e-4;
    let initial = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5]];
    let moved = [3.0 * time, -time];
    let positions: Vec<[f64; 2]> = initial.iter().map(|x| [x[0] + moved[0], x[1] + moved[1]]).collect();
    let values = |name: &str, location, width| match (name, location) {
        ("displacement", _) => moved.repeat(5),
        ("velocity", _) => [3.0, -1.0].repeat(5),
        (_, Location::Node) => vec![0.5; 5 * width],
        (_, Location::Cell) => vec![0.25; 2 * width],
    };
    let fields = FIELDS.iter().map(|kind| Field { kind, values: values(kind.name, kind.location, kind.width()) }).collect();
    Frame { time, step, fields, ..Frame::of(&positions) }
}

fn summary(steps: u64) -> Summary {
    Summary {
        dimension: 2,
        elements: 2,
        nodes: 5,
        steps,
        time_end: steps as f64 * 1e-4,
        end: 1e-3,
        rest: None,
        stages: vec![],
        remeshings: vec![],
        flows: vec![],
        stable_time_step_min: 1e-4,
        stable_time_step_governor: "element 0 of part \"left\"".into(),
        energy_drift: 0.001,
        ledger_residual: 1e-15,
        momentum_drift_linear: Some(1e-16),
        momentum_drift_angular: None,
        erosion: None,
        forces: Vec::new(),
        mass_added: 0.0,
        mass_added_in_run: None,
        element_evaluations: None,
        penetration_max: 0.0,
        contact: embate_solver::contact::tracker::Certificate::default(),
        state_hash: "0123456789abcdef".into(),
        threads: 1,
        simd: "scalar".into(),
        warnings: vec![],
    }
}

fn columns() -> Vec<String> {
    vec!["time".into(), "energy.kinetic".into()]
}

/// Ten steps with a frame and a row each, or until the caller's progress says stop.
fn record(folder: &Path, on_progress: OnProgress<'_>, error: Option<&str>) -> Outcome {
    let folder = ResultFolder::create(folder, false).unwrap();
    let mut recorder = Recorder::new(folder, &model(), columns(), cells(), 1, on_progress).unwrap();
    let mut done = 0;
    for step in 0..=10 {
        recorder.frame(frame(step)).unwrap();
        recorder.row(&[step as f64 * 1e-4, 5.0]).unwrap();
        done = step;
        let progress =
            Progress { step, time: step as f64 * 1e-4, end: 1e-3, time_step: 1e-4, governor: "x", energy_drift: 0.0, notices: &[] };
        if recorder.progress(&progress) == Control::Stop {
            break;
        }
    }
    recorder.finish(error.map(ToString::to_string), &summary(done), || Some(0.5))
}

fn continue_run<'a>() -> OnProgress<'a> {
    Box::new(|_| Control::Continue)
}

#[test]
fn a_finished_run_has_all_its_files_and_no_parts() {
    let folder = fresh("finished");
    let outcome = record(&folder, continue_run(), None);
    assert!(outcome.unwritten.is_none());
    assert_eq!(outcome.report.status, RunStatus::Done);
    let found = names(&folder);
    for name in ["fields", "fields.pvd", "history.csv", "summary.json"] {
        assert!(found.contains(&name.to_string()), "{name} is missing in {found:?}");
    }
    assert!(found.iter().chain(&names(&folder.join("fields"))).all(|name| !name.ends_with(".part")));
    assert_eq!(names(&folder.join("fields")).len(), 11);
    let history = fs::read_to_string(folder.join("history.csv")).unwrap();
    assert!(history.starts_with("time,energy.kinetic\n0,5\n0.0001,5\n"));
    assert_eq!(history.lines().count(), 12);
}

#[test]
fn the_summary_has_its_keys_in_order() {
    let folder = fresh("summary");
    record(&folder, continue_run(), None);
    let text = fs::read_to_string(folder.join("summary.json")).unwrap();
    let keys: Vec<&str> =
        text.lines().filter(|l| l.starts_with("  \"")).map(|l| l.trim().split('"').nth(1).unwrap()).filter(|k| !k.is_empty()).collect();
    assert_eq!(
        keys,
        [
            "status",
            "error",
            "model",
            "version",
            "parts",
            "threads",
            "simd",
            "elements",
            "nodes",
            "steps",
            "time_end",
            "wall_seconds",
            "user_cpu_seconds",
            "output_seconds",
            "output_wait_seconds",
            "element_steps_per_second",
            "stable_time_step_min",
            "stable_time_step_governor",
            "energy_drift",
            "ledger_residual",
            "momentum_drift",
            "penetration_max",
            "contact",
            "state_hash",
            "warnings"
        ]
    );
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["status"], "done");
    assert_eq!(value["error"], serde_json::Value::Null);
    assert_eq!(value["momentum_drift"]["linear"], 1e-16);
    assert_eq!(value["momentum_drift"]["angular"], serde_json::Value::Null);
    assert!(value["element_steps_per_second"].as_f64().unwrap() > 0.0);
}

#[test]
fn a_failed_run_keeps_its_results_and_says_why() {
    let folder = fresh("failed");
    let outcome = record(&folder, continue_run(), Some("element 3 turned inside out"));
    assert_eq!(outcome.report.status, RunStatus::Failed);
    let value: serde_json::Value = serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap();
    assert_eq!((value["status"].as_str(), value["error"].as_str()), (Some("failed"), Some("element 3 turned inside out")));
    assert!(folder.join("history.csv").exists() && folder.join("fields.pvd").exists());
}

#[test]
fn a_stopped_run_keeps_its_results() {
    let folder = fresh("stopped");
    let outcome = record(&folder, Box::new(|p| if p.step < 4 { Control::Continue } else { Control::Stop }), None);
    assert_eq!(outcome.report.status, RunStatus::Stopped);
    assert_eq!(names(&folder.join("fields")).len(), 5);
}

#[test]
fn an_existing_result_is_refused_and_untouched() {
    let folder = fresh("existing");
    record(&folder, continue_run(), None);
    let before = fs::read(folder.join("summary.json")).unwrap();
    let error = ResultFolder::create(&folder, false).unwrap_err();
    assert!(matches!(error, ResultsError::Exists { .. }));
    assert!(error.to_string().contains("--force") && error.to_string().contains("summary.json"), "{error}");
    assert_eq!(fs::read(folder.join("summary.json")).unwrap(), before);
}

#[test]
fn a_run_that_was_killed_counts_as_a_result() {
    let folder = fresh("killed");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("history.csv.part"), "time\n").unwrap();
    assert!(ResultFolder::create(&folder, false).is_err());
    ResultFolder::create(&folder, true).unwrap();
    assert_eq!(names(&folder), ["fields"]);
}

#[test]
fn force_removes_only_files_that_embate_makes() {
    let folder = fresh("forced");
    record(&folder, continue_run(), None);
    fs::write(folder.join("notes.txt"), "mine").unwrap();
    fs::write(folder.join("fields/frame-old.vtu"), "mine").unwrap();
    ResultFolder::create(&folder, true).unwrap();
    assert_eq!(names(&folder), ["fields", "notes.txt"]);
    assert_eq!(names(&folder.join("fields")), ["frame-old.vtu"]);
}

#[test]
fn a_folder_with_foreign_files_takes_results() {
    let folder = fresh("foreign");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("model.toml"), "").unwrap();
    fs::write(folder.join("check.png"), "").unwrap();
    ResultFolder::create(&folder, false).unwrap();
}

#[test]
fn a_file_in_the_way_is_named() {
    let path = fresh("in-the-way");
    fs::write(&path, "").or_else(|_| fs::create_dir_all(path.parent().unwrap()).and_then(|()| fs::write(&path, ""))).unwrap();
    let direct = ResultFolder::create(&path, true).unwrap_err().to_string();
    assert!(direct.contains("in-the-way") && direct.contains("not a folder"), "{direct}");
    let below = ResultFolder::create(&path.join("below"), true).unwrap_err().to_string();
    assert!(below.contains("in-the-way") && below.contains("--out"), "{below}");
    fs::remove_file(path).unwrap();
}

#[test]
fn two_runs_never_share_a_folder() {
    let folder = fresh("two-runs");
    let first = ResultFolder::create(&folder, false).unwrap();
    for force in [false, true] {
        assert!(matches!(ResultFolder::create(&folder, force).unwrap_err(), ResultsError::InUse { path } if path == folder));
    }
    // Until the last file is there.
    let running = Recorder::new(first, &model(), columns(), cells(), 1, continue_run()).unwrap();
    assert!(matches!(ResultFolder::create(&folder, true), Err(ResultsError::InUse { .. })));
    assert!(running.finish(None, &summary(10), || None).unwritten.is_none());
    ResultFolder::create(&folder, true).unwrap();
    assert_eq!(names(&folder), ["fields"], "the lock leaves nothing");
}

#[test]
fn a_row_of_the_wrong_length_is_an_error() {
    let folder = ResultFolder::create(&fresh("row"), false).unwrap();
    let mut recorder = Recorder::new(folder, &model(), columns(), cells(), 1, continue_run()).unwrap();
    assert!(recorder.row(&[1.0]).unwrap_err().to_string().contains("1 values for 2 columns"));
}

#[test]
fn the_last_state_is_not_written_twice() {
    let folder = ResultFolder::create(&fresh("twice"), false).unwrap();
    let path = folder.path().to_path_buf();
    let mut recorder = Recorder::new(folder, &model(), columns(), cells(), 1, continue_run()).unwrap();
    for step in [0, 5, 5] {
        recorder.frame(frame(step)).unwrap();
    }
    assert_eq!(names(&path.join("fields")).len(), 2);
}

/// Three triangles in a fan.
fn other_cells() -> Cells {
    Cells {
        nodes: vec![0, 1, 2, 0, 2, 3, 0, 3, 4],
        offsets: vec![0, 3, 6, 9],
        kinds: vec![CellKind::Triangle; 3],
        parts: vec![0, 0, 1],
        part_names: vec!["left".into(), "right".into()],
        revision: 0,
    }
}

#[test]
fn after_a_body_is_meshed_again_files_have_the_new_cells() {
    let made = [1, 2].map(|threads| {
        let path = fresh(&format!("meshed-again-{threads}"));
        let folder = ResultFolder::create(&path, false).unwrap();
        let mut recorder = Recorder::new(folder, &model(), columns(), cells(), threads, continue_run()).unwrap();
        recorder.frame(frame(0)).unwrap();
        recorder.cells(other_cells()).unwrap();
        let mut last = frame(5);
        last.fields.iter_mut().filter(|field| field.kind.location == Location::Cell).for_each(|field| {
            field.values = vec![0.25; 3 * field.kind.width()];
        });
        recorder.frame(last).unwrap();
        let outcome = recorder.finish(None, &summary(10), || None);
        assert!(outcome.unwritten.is_none() && outcome.report.warnings.is_empty(), "{:?}", outcome.report.warnings);
        let count = |name: &str| {
            let text = String::from_utf8_lossy(&fs::read(path.join(name)).unwrap()).into_owned();
            text.split("NumberOfCells=\"").nth(1).unwrap().split('"').next().unwrap().to_string()
        };
        assert_eq!(["fields/frame-00000.vtu", "fields/frame-00001.vtu"].map(count), ["2", "3"]);
        ["fields/frame-00001.vtu", "animation.gif", "final.png"].map(|name| fs::read(path.join(name)).unwrap())
    });
    assert!(made[0] == made[1], "beside the run as in turn with it");
}

#[test]
fn a_lost_folder_is_reported_with_its_path() {
    let folder = ResultFolder::create(&fresh("lost"), false).unwrap();
    let path = folder.path().to_path_buf();
    let mut recorder = Recorder::new(folder, &model(), columns(), cells(), 1, continue_run()).unwrap();
    fs::remove_dir_all(&path).unwrap();
    let error = recorder.frame(frame(0)).unwrap_err().to_string();
    assert!(error.contains("lost") && error.contains("frame-00000.vtu"), "{error}");
    let outcome = recorder.finish(None, &summary(10), || None);
    assert_eq!(outcome.report.status, RunStatus::Failed);
    assert!(outcome.unwritten.unwrap().to_string().contains("lost"));
}

#[test]
fn a_writer_beside_the_run_reports_a_lost_folder_too() {
    let folder = ResultFolder::create(&fresh("lost-beside"), false).unwrap();
    let path = folder.path().to_path_buf();
    let mut recorder = Recorder::new(folder, &model(), columns(), cells(), 3, continue_run()).unwrap();
    fs::remove_dir_all(&path).unwrap();
    // The queue holds a few frames that no one has tried to write yet.
    let error = (0..10).find_map(|step| recorder.frame(frame(step)).err()).expect("the run is told").to_string();
    assert!(error.contains("lost-beside") && error.contains("frame-00000.vtu"), "{error}");
    let outcome = recorder.finish(None, &summary(10), || None);
    assert_eq!(outcome.report.status, RunStatus::Failed);

    let folder = ResultFolder::create(&fresh("lost-at-the-end"), false).unwrap();
    let path = folder.path().to_path_buf();
    let mut recorder = Recorder::new(folder, &model(), columns(), cells(), 3, continue_run()).unwrap();
    fs::remove_dir_all(&path).unwrap();
    let reported = recorder.frame(frame(0)).map_err(|error| error.to_string());
    let outcome = recorder.finish(reported.as_ref().err().cloned(), &summary(10), || None);
    assert_eq!(outcome.report.status, RunStatus::Failed);
    let error = outcome.report.error.unwrap();
    assert!(error.contains("frame-00000.vtu"), "what went wrong first is told: {error}");
}

#[test]
fn rows_between_frames_are_written_in_their_order() {
    for threads in [1, 2] {
        let path = fresh(&format!("rows-{threads}"));
        let mut recorder =
            Recorder::new(ResultFolder::create(&path, false).unwrap(), &model(), columns(), cells(), threads, continue_run()).unwrap();
        for step in 0..20_000 {
            recorder.row(&[f64::from(step), 1.0]).unwrap();
            if step % 3000 == 0 {
                recorder.frame(frame(u64::from(step as u32))).unwrap();
            }
        }
        assert!(recorder.finish(None, &summary(10), || None).unwritten.is_none());
        let text = fs::read_to_string(path.join("history.csv")).unwrap();
        let times = text.lines().skip(1).map(|line| line.split(',').next().unwrap().parse::<f64>().unwrap());
        assert!(times.eq((0..20_000).map(f64::from)));
        assert_eq!(names(&path.join("fields")).len(), 7);
    }
}

/// All files below a folder with their bytes; times are taken out of the summary.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for below in [folder.to_path_buf(), folder.join("fields")] {
        for name in names(&below).into_iter().filter(|name| !below.join(name).is_dir()) {
            let mut bytes = fs::read(below.join(&name)).unwrap();
            if name == "summary.json" {
                let mut value: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
                let timed =
                    ["wall_seconds", "user_cpu_seconds", "output_seconds", "output_wait_seconds", "element_steps_per_second", "threads"];
                timed.iter().for_each(|key| assert!(value.as_object_mut().unwrap().remove(*key).is_some(), "{key}"));
                bytes = value.to_string().into_bytes();
            }
            files.push((name, bytes));
        }
    }
    files
}

#[test]
fn a_real_run_leaves_the_same_bytes_for_any_number_of_threads() {
    let folder = fresh("threads");
    fs::create_dir_all(&folder).unwrap();
    let text = r#"
        [run]
        end = "60 us"
        [material.steel]
        law = "j2"
        young = "200 GPa"
        poisson = 0.3
        density = "7800 kg/m^3"
        yield = "100 MPa"
        hardening = "1 GPa"
        [[part]]
        name = "block"
        material = "steel"
        element = "quad4"
        rectangle = { corner = [0, 0], size = ["1 m", "1 m"], elements = [72, 72] }
        velocity = [0, "-50 m/s"]
        [[obstacle]]
        name = "floor"
        parts = ["block"]
        plane = { point = [0, 0], normal = [0, 1] }
        [[probe]]
        name = "top"
        part = "block"
        point = [0, "1 m"]
        [output]
        fields = 8
        history = "1 us"
    "#;
    let path = folder.join("model.toml");
    fs::write(&path, text).unwrap();
    let model = embate_files::model_file::load(&path, &[]).unwrap_or_else(|reported| panic!("{}", reported.rendered));
    let run = |threads: usize| {
        let options = Options { threads, simd: None };
        let mut simulation = Simulation::new(&model, &options).unwrap();
        let own = folder.join(threads.to_string());
        let results = ResultFolder::create(&own, false).unwrap();
        let (columns, cells) = (simulation.history_columns(), simulation.cells());
        let mut recorder = Recorder::new(results, &model, columns, cells, threads, continue_run()).unwrap();
        simulation.run(&mut recorder).unwrap();
        let outcome = recorder.finish(None, &simulation.summary(), || Some(1.0));
        assert!(outcome.unwritten.is_none() && outcome.report.warnings.is_empty(), "{:?}", outcome.report.warnings);
        assert!(outcome.report.output_seconds > 0.0 && outcome.report.output_wait_seconds > 0.0);
        contents(&own)
    };
    let alone = run(1);
    // History, two collections, nine frames and as many of the obstacle, four pictures, the summary.
    assert_eq!(alone.len(), 26);
    for threads in [2, 4] {
        for ((name, bytes), (other, expected)) in run(threads).iter().zip(&alone) {
            assert!(name == other && bytes == expected, "{name} of {threads} threads differs from {other} of one");
        }
    }
}

/// A frame with a floor without end, a circle that moves, and a field of the surface that has no value
/// inside.
fn frame_with_obstacles(step: u64) -> Frame {
    let mut frame = frame(step);
    let turned = |k: u32| -2.0 * std::f64::consts::PI * f64::from(k % 12) / 12.0;
    let circle = (0..=12).map(|k| [3.0 + frame.time + turned(k).cos(), turned(k).sin()]);
    frame.outlines = vec![Outline::line("floor", [[-1e3, -2.0], [1e3, -2.0]]), Outline::line("ball", circle)];
    let gap = frame.fields.iter_mut().find(|field| field.kind.name == "contact_gap").unwrap();
    gap.values[2] = f64::NAN;
    frame
}

fn record_obstacles(name: &str) -> PathBuf {
    let path = fresh(name);
    let mut recorder = Recorder::new(ResultFolder::create(&path, false).unwrap(), &model(), columns(), cells(), 1, continue_run()).unwrap();
    for step in 0..=10 {
        recorder.frame(frame_with_obstacles(step)).unwrap();
        recorder.row(&[step as f64 * 1e-4, 5.0]).unwrap();
    }
    assert!(recorder.finish(None, &summary(10), || None).unwritten.is_none());
    path
}

#[test]
fn obstacles_have_a_collection_of_their_own_with_the_times_of_the_fields() {
    let folder = record_obstacles("obstacles");
    let text = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    assert_eq!(text("obstacles.pvd"), text("fields.pvd").replace("frame-", "obstacles-"));
    assert_eq!(names(&folder.join("fields")).len(), 22);
    ResultFolder::create(&folder, true).unwrap();
    assert_eq!(names(&folder), ["fields"], "all of them are removed with the others");
    assert!(names(&folder.join("fields")).is_empty());
    let without = fresh("no-obstacles");
    record(&without, continue_run(), None);
    assert!(!without.join("obstacles.pvd").exists());
}

/// Runs `tests/read_back.py` with the interpreter named by `EMBATE_PYTHON` (with meshio or vtk installed), as
/// CI does.
#[test]
fn python_reads_the_results_back() {
    let folder = fresh("read-back");
    record(&folder, continue_run(), None);
    let with_obstacles = record_obstacles("read-back-obstacles");
    let Some(python) = std::env::var_os("EMBATE_PYTHON") else {
        eprintln!("skipped: EMBATE_PYTHON names no interpreter");
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/read_back.py");
    let output = Command::new(python).arg(script).args([&folder, &with_obstacles]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
}
