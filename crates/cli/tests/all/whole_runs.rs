//! Whole runs of a block of four elements that flies through space.

use crate::{Answer, embate, fresh};
use std::fs;
use std::path::Path;

const MODEL: &str = r#"
[run]
end = "0.1 ms"

[material.steel]
law = "elastic"
young = "200 GPa"
poisson = 0.3
density = "7800 kg/m^3"

[[part]]
name = "block"
material = "steel"
element = "quad4"
rectangle = { corner = [0, 0], size = ["10 mm", "10 mm"], elements = [2, 2] }
velocity = [1, 0]

[[probe]]
name = "P"
part = "block"
point = [0, 0]

[output]
fields = 4
history = 20
"#;

fn run(folder: &Path, more: &[&str]) -> Answer {
    fs::write(folder.join("model.toml"), MODEL).unwrap();
    embate(folder, ["run", "model.toml", "--out", "out", "--threads", "1"].iter().chain(more))
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(folder.join("out/summary.json")).unwrap()).unwrap()
}

#[test]
fn a_run_leaves_its_results_and_says_where() {
    let folder = fresh("whole");
    let answer = run(&folder, &[]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("results in out") && answer.out.contains("energy drift"), "{}", answer.out);
    let figures = summary(&folder);
    assert_eq!(figures["status"], "done");
    assert_eq!(figures["elements"], 4);
    assert!((figures["time_end"].as_f64().unwrap() - 1e-4).abs() < 1e-12);
    assert!(fs::read_to_string(folder.join("out/history.csv")).unwrap().starts_with("time,"));
    assert_eq!(fs::read_dir(folder.join("out/fields")).unwrap().count(), 5);
    let files = fs::read_dir(folder.join("out")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    assert!(files.into_iter().all(|name| !name.ends_with(".part")));

    let again = run(&folder, &[]);
    assert_eq!(again.code, Some(2), "{}", again.err);
    let forced = run(&folder, &["--force", "--quiet"]);
    assert_eq!(forced.code, Some(0), "{}", forced.err);
    assert!(forced.out.is_empty() && forced.err.is_empty(), "{}{}", forced.out, forced.err);
    assert_eq!(summary(&folder)["state_hash"], figures["state_hash"]);
}

#[test]
fn a_run_reports_the_search_when_asked() {
    let folder = fresh("search");
    let model = format!("{MODEL}\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n");
    fs::write(folder.join("model.toml"), model).unwrap();
    let answer = embate(&folder, ["run", "model.toml", "--out", "out", "--verbose"].iter());
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let line = answer.out.lines().find(|line| line.starts_with("self")).unwrap_or_else(|| panic!("{}", answer.out));
    assert!(answer.out.contains("pairs swept") && line.contains("grid"), "{}", answer.out);
    assert!(answer.err.contains("transmitted nothing"), "{}", answer.err);
    let figures = summary(&folder);
    assert_eq!(figures["contact"]["unverified"], 0);
}

#[test]
fn a_run_that_fails_keeps_its_results() {
    let folder = fresh("collapsed");
    // At half the speed of sound the block is crushed at the wall: its elements get thinner, and their step
    // falls below the limit.
    let wall = "obstacle=[{ plane = { point = [\"10 mm\", 0], normal = [-1, 0] } }]";
    let crush =
        ["--set", wall, "--set", "part.block.velocity=[2500, 0]", "--set", "run.energy_limit=0.9", "--set", "run.step_limit=\"0.5 us\""];
    let answer = run(&folder, &crush);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert!(
        answer.err.contains("time step fell") && answer.err.contains("part \"block\"") && answer.err.contains("results until then: out"),
        "{}",
        answer.err
    );
    let figures = summary(&folder);
    assert_eq!(figures["status"], "failed");
    assert!(figures["error"].as_str().unwrap().contains("time step fell"));
    assert!(folder.join("out/history.csv").exists() && folder.join("out/fields.pvd").exists());
}

#[test]
fn a_fault_in_the_model_ends_with_code_two_and_leaves_nothing() {
    let folder = fresh("faulty");
    for fault in ["material.steel.young=\"-1 Pa\"", "part[0].material=\"stele\"", "run.edn=1"] {
        let answer = run(&folder, &["--set", fault]);
        assert_eq!(answer.code, Some(2), "{fault}: {}", answer.err);
        assert!(!folder.join("out").exists(), "{fault}");
    }
    let answer = run(&folder, &["--simd", "abacus"]);
    assert_eq!(answer.code, Some(2), "{}", answer.err);
}

#[test]
fn a_check_reports_parts_and_steps() {
    let folder = fresh("checked");
    fs::write(folder.join("model.toml"), MODEL).unwrap();
    let answer = embate(&folder, ["check", "model.toml", "--out", "out"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("block") && answer.out.contains("780 g/m") && answer.out.contains("steps to 100 µs"), "{}", answer.out);
    assert!(!answer.out.contains("by nodes"), "{}", answer.out);
    let answer = embate(&folder, ["check", "model.toml", "--out", "out", "--time-step"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for words in ["shortest stable steps", "without it and those above", "by nodes (run.stable_step = \"nodes\") the first step is"] {
        assert!(answer.out.contains(words), "{}", answer.out);
    }
    // A picture of the mesh is not a result in the way of a run.
    assert_eq!(run(&folder, &[]).code, Some(0));
}

#[test]
#[cfg(unix)]
fn the_first_interrupt_stops_a_run_cleanly() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let folder = fresh("interrupted");
    fs::write(folder.join("model.toml"), MODEL).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_embate"))
        .args(["run", "model.toml", "--out", "out", "--threads", "1", "--set", "run.end=\"100 s\""])
        .current_dir(&folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    while !folder.join("out/fields.pvd").exists() && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    // A second one at once belongs to it: `timeout` sends both. It may find nobody.
    let press = || Command::new("kill").args(["-INT", &child.id().to_string()]).stderr(Stdio::null()).status().unwrap();
    assert!(press().success());
    press();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(summary(&folder)["status"], "stopped");
}
