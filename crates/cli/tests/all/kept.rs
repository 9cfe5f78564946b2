//! Work that is not lost: states that a run keeps without any key, what `resume` and `replay` say of folders
//! that they can't continue, and when a run replaces results that are there.

use crate::restart::Running;
use crate::{Answer, FLIGHT, embate, fresh};
use embate_files::checkpoint::{Checkpoint, generations};
use embate_files::threads::Threads;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

fn run<'a>(folder: &Path, more: impl IntoIterator<Item = &'a str>) -> Answer {
    embate(folder, ["run", "model.toml", "--out", "out", "--threads", "1"].into_iter().chain(more))
}

fn figures(folder: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
}

#[test]
fn a_run_without_keys_that_is_killed_continues_from_a_state_of_its_first_seconds_with_the_same_bits() {
    let folder = fresh("kept");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let begin = Instant::now();
    let endless = ["run", "model.toml", "--out", "out", "--quiet", "--threads", "1", "--set", "run.end=1000s"];
    let mut running = Running::start(&folder, &endless);
    let out = folder.join("out");
    while generations(&out).is_empty() && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(begin.elapsed() >= Duration::from_secs(5), "short runs keep nothing");
    // SIGKILL: nothing can be put in order.
    running.0.kill().unwrap();
    let _ = running.0.wait();
    assert!(!out.join("summary.json").exists());
    let [kept] = &generations(&out)[..] else { panic!("one state is kept") };
    let spent = Checkpoint::read(&kept.path, &Threads::one()).unwrap().reported.spent;
    assert!(spent.wall >= 5.0 && spent.user_cpu.is_none_or(|seconds| seconds > 0.0), "{spent:?}");
    let steps = format!("run.max_steps={}", kept.step + 1000);
    let answer = embate(&folder, ["resume", "out", "--quiet", "--threads", "2", "--set", steps.as_str()]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let resumed = figures(&out);
    // All stretches count, as all steps do.
    assert!(resumed["wall_seconds"].as_f64() > Some(spent.wall) && resumed["steps"] == kept.step + 1000);
    // A system's clock may be so coarse that the last stretch took none of it.
    if let Some(seconds) = resumed["user_cpu_seconds"].as_f64() {
        assert!(Some(seconds) >= spent.user_cpu, "{seconds} s after {spent:?}");
    }
    // The same without the state, and without any: neither the clock nor the stop leaves a trace.
    let whole = ["run", "model.toml", "--out", "whole", "--quiet", "--set", "run.end=1000s", "--set", &steps, "--set", "run.checkpoint=0"];
    let answer = embate(&folder, whole);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(generations(&folder.join("whole")).is_empty(), "0 switches them off");
    assert_eq!(figures(&folder.join("whole"))["state_hash"], resumed["state_hash"]);
    for table in ["hashes.csv", "history.csv"] {
        assert!(fs::read(folder.join("whole").join(table)).unwrap() == fs::read(out.join(table)).unwrap(), "{table}");
    }
}

#[test]
fn states_by_the_clock_change_no_bit() {
    let folder = fresh("kept-clock");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    for (out, pause) in [("never", "0"), ("always", "1e-9")] {
        let answer = embate(
            &folder,
            [
                "run",
                "model.toml",
                "--out",
                out,
                "--quiet",
                "--threads",
                "1",
                "--set",
                "run.max_steps=3000",
                "--set",
                &format!("run.checkpoint={pause}"),
                "--set",
                "run.end=1",
            ],
        );
        assert_eq!(answer.code, Some(0), "{}", answer.err);
    }
    assert_eq!(generations(&folder.join("always")).len(), 2, "two are kept");
    for name in ["hashes.csv", "history.csv"] {
        assert!(fs::read(folder.join("never").join(name)).unwrap() == fs::read(folder.join("always").join(name)).unwrap(), "{name}");
    }
}

#[test]
fn resume_says_what_a_folder_is_that_it_cannot_continue() {
    let folder = fresh("kept-words");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let says = |arguments: &[&str], code: i32, words: &[&str]| {
        let answer = embate(&folder, ["resume"].iter().chain(arguments));
        assert_eq!(answer.code, Some(code), "{}", answer.err);
        assert!(words.iter().all(|word| answer.err.contains(word)), "{words:?}: {}", answer.err);
    };
    says(&["nowhere"], 2, &["E0716", "there is no folder nowhere"]);
    fs::create_dir(folder.join("empty")).unwrap();
    says(&["empty"], 2, &["E0716", "empty holds no results"]);
    assert_eq!(run(&folder, ["--quiet"]).code, Some(0));
    // Done: there is nothing to do.
    says(&["out"], 0, &["is done", "--until"]);
    says(&["out", "--until", "1 ms"], 2, &["E0716", "no checkpoint in out", "status \"done\""]);
    fs::write(folder.join("model.toml"), FLIGHT.replace("0.1 ms", "0.2 ms")).unwrap();
    says(&["out"], 2, &["no checkpoint in out"]);
    fs::remove_file(folder.join("out/summary.json")).unwrap();
    says(&["out"], 2, &["it was cut off", "embate replay"]);
    // Another end was reached before; from a state the run continues to the new one.
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    assert_eq!(run(&folder, ["--quiet", "--force", "--set", "run.checkpoint_steps=10"]).code, Some(0));
    says(&["out"], 0, &["is done"]);
    fs::write(folder.join("model.toml"), FLIGHT.replace("0.1 ms", "0.2 ms")).unwrap();
    says(&["out"], 0, &["continuing from step"]);
    says(&["out"], 0, &["is done"]);
}

#[test]
fn a_run_without_states_is_replayed_from_its_start() {
    let folder = fresh("kept-replay");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    assert_eq!(run(&folder, ["--quiet", "--set", "run.safety=0.8"]).code, Some(0));
    let replay = ["replay", "out", "--from", "40 us", "--to", "1 ms", "--output-every", "1 us", "--quiet"];
    let answer = embate(&folder, replay);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let hash = |of: &str| figures(&folder.join(of))["state_hash"].clone();
    assert_eq!(hash("out/replay"), hash("out"), "with the keys of the run");
    fs::write(folder.join("model.toml"), FLIGHT.replace("7800", "7900")).unwrap();
    let answer = embate(&folder, replay.iter().chain(&["--force"]));
    assert!(answer.code == Some(2) && answer.err.contains("density: was 7800.0, is 7900.0"), "{}", answer.err);
    let answer = embate(&folder, ["replay", "nowhere", "--from", "0", "--to", "1", "--output-every", "1"]);
    assert!(answer.code == Some(2) && answer.err.contains("E0716"), "{}", answer.err);
}

#[test]
fn results_of_the_same_model_are_replaced_when_it_was_edited_and_others_are_not() {
    let folder = fresh("kept-again");
    let write = |text: &str| fs::write(folder.join("model.toml"), text).unwrap();
    write(FLIGHT);
    assert_eq!(run(&folder, ["--quiet"]).code, Some(0));
    let refused = |answer: &Answer, words: &str| {
        assert!(answer.code == Some(2) && answer.err.contains("E0702") && answer.err.contains(words), "{}", answer.err);
        assert!(answer.err.contains("--force"), "{}", answer.err);
    };
    refused(&run(&folder, []), "which is as it was: it is done");
    // By another way to the same file; a key that only output hears of is a change, too.
    let by_folder = embate(&folder, ["run", ".", "--out", "out", "--quiet"]);
    refused(&by_folder, "as it was");
    let answer = run(&folder, ["--set", "output.history=30"]);
    assert!(answer.code == Some(0) && answer.err.contains("earlier state of this model in out are replaced"), "{}", answer.err);
    write(&FLIGHT.replace("200 GPa", "100 GPa"));
    let answer = run(&folder, []);
    assert!(answer.code == Some(0) && answer.err.contains("are replaced"), "{}", answer.err);
    // What took long asks, whatever has changed.
    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    let wall = figures(&folder.join("out"))["wall_seconds"].to_string();
    fs::write(folder.join("out/summary.json"), summary.replace(&format!("\"wall_seconds\": {wall}"), "\"wall_seconds\": 9e3")).unwrap();
    write(FLIGHT);
    refused(&run(&folder, []), "took 9 ks");
    fs::write(folder.join("out/summary.json"), summary).unwrap();
    // Another model, before it is even read.
    fs::write(folder.join("other.toml"), "no model").unwrap();
    refused(&embate(&folder, ["run", "other.toml", "--out", "out"]), "of another model");
    fs::remove_file(folder.join("out/run.json")).unwrap();
    refused(&run(&folder, []), "already holds results");
    assert!(folder.join("out/summary.json").exists());
}

#[test]
fn an_unfinished_run_that_is_run_again_continues() {
    let folder = fresh("kept-continued");
    let write = |steps: u32| {
        fs::write(folder.join("model.toml"), FLIGHT.replacen('\n', &format!("\nrun.checkpoint_steps = {steps}\n"), 1)).unwrap()
    };
    write(10);
    assert_eq!(run(&folder, ["--quiet"]).code, Some(0));
    let whole = figures(&folder.join("out"));
    // As one that was killed leaves it: tables that grow, no summary.
    let out = folder.join("out");
    fs::remove_file(out.join("summary.json")).unwrap();
    for table in ["history.csv", "hashes.csv"] {
        fs::rename(out.join(table), out.join(format!("{table}.part"))).unwrap();
    }
    let answer = run(&folder, []);
    assert!(
        answer.code == Some(0) && answer.err.contains("holds this run unfinished") && answer.err.contains("continuing from step"),
        "{}",
        answer.err
    );
    assert_eq!(figures(&out)["state_hash"], whole["state_hash"]);
    // Edited, or without a state, it begins again.
    fs::remove_file(out.join("summary.json")).unwrap();
    write(20);
    let answer = run(&folder, []);
    assert!(answer.code == Some(0) && answer.err.contains("are replaced") && !answer.err.contains("continuing"), "{}", answer.err);
    fs::remove_file(out.join("summary.json")).unwrap();
    fs::remove_dir_all(out.join("checkpoint")).unwrap();
    let answer = run(&folder, []);
    assert!(answer.code == Some(0) && answer.err.contains("results of an unfinished run in out are replaced"), "{}", answer.err);
    assert_eq!(figures(&out)["state_hash"], whole["state_hash"]);
}

#[test]
fn fields_can_be_left_out_and_the_plots_stay() {
    let folder = fresh("kept-no-fields");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let answer = run(&folder, ["--set", "output.fields=0", "--set", "output.pictures=true"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let out = folder.join("out");
    assert_eq!(fs::read_dir(out.join("fields")).unwrap().count(), 0);
    assert!(out.join("energy.svg").exists() && out.join("history.svg").exists());
    assert!(["fields.pvd", "animation.gif", "final.png"].iter().all(|name| !out.join(name).exists()));
    assert_eq!(figures(&out)["warnings"], serde_json::json!([]));
    assert!(!answer.err.contains("warning"), "{}", answer.err);
}

#[test]
fn who_asks_for_more_threads_than_are_used_is_told_why() {
    let folder = fresh("kept-threads");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let told = "one thread instead of 2: the model has 4 elements, and below 4,096 more threads cost more than they bring";
    let answer = embate(&folder, ["run", "model.toml", "--out", "out", "--threads", "2"]);
    assert!(answer.code == Some(0) && answer.err.contains(told), "{}", answer.err);
    let answer = embate(&folder, ["run", "model.toml", "--out", "out", "--force"]);
    assert!(answer.code == Some(0) && !answer.err.contains("instead of"), "{}", answer.err);
    // Nor does any line of progress speak of a schedule.
    assert!(
        answer.err.contains("element") && !answer.err.contains("growth limit") && !answer.err.contains("the step before"),
        "{}",
        answer.err
    );
}

#[test]
fn an_obstacle_that_acts_no_more_is_not_drawn() {
    let folder = fresh("kept-gone");
    for (name, model) in [
        ("plane", FLIGHT.to_string()),
        (
            "solid",
            FLIGHT
                .replace(
                    "rectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }",
                    "box = { corner = [0, 0, 0], size = [0.01, 0.01, 0.01], elements = [2, 2, 2] }",
                )
                .replace("velocity = [1, 0]", "velocity = [1, 0, 0]"),
        ),
    ] {
        let (normal, hidden) = if name == "solid" { ("[0, 0, 1]", "[0, 0, -9]") } else { ("[0, 1]", "[0, -9]") };
        let obstacles = format!(
            "\nobstacle = [{{ name = \"gone\", plane = {{ point = {hidden}, normal = {normal} }}, death = \"50 us\" }}, \
             {{ name = \"stays\", plane = {{ point = {hidden}, normal = {normal} }} }}]\n"
        );
        fs::write(folder.join("model.toml"), model.replacen('\n', &obstacles, 1).replace("pictures = false", "pictures = true")).unwrap();
        let answer = embate(&folder, ["run", "model.toml", "--out", name, "--quiet"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        let cells = |frame: usize| {
            let text = fs::read(folder.join(name).join(format!("fields/obstacles-{frame:05}.vtu"))).unwrap();
            let text = String::from_utf8_lossy(&text).into_owned();
            let (_, after) = text.split_once("NumberOfCells=\"").unwrap();
            after.split('"').next().unwrap().parse::<usize>().unwrap()
        };
        assert!(cells(1) == 2 * cells(3) && cells(3) > 0, "{name}: {} and {}", cells(1), cells(3));
        assert!(folder.join(name).join("animation.gif").exists());
    }
}
