//! Several programs that want one folder of results: one has it, the others say so, and what is there at the
//! end is of one run.

use crate::restart::Running;
use crate::{FLIGHT, embate, fresh};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

fn spawn(folder: &Path, arguments: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_embate"));
    command.args(arguments.split_whitespace()).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn ended(children: Vec<Child>) -> Vec<(Option<i32>, String)> {
    let outputs = children.into_iter().map(|child| child.wait_with_output().unwrap());
    outputs.map(|Output { status, stderr, .. }| (status.code(), String::from_utf8(stderr).unwrap())).collect()
}

/// All files of results but those that have times of the machine.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = PathBuf::from(entry.file_name().unwrap());
        if entry.is_dir() {
            all.extend(files(&entry).into_iter().map(|(path, bytes)| (name.join(path), bytes)));
        } else if !entry.ends_with("summary.json") && !entry.ends_with("run.json") {
            // Where a checkpoint came from may differ.
            let is_checkpoint = entry.extension().is_some_and(|extension| extension == "embate");
            let bytes = if is_checkpoint { Vec::new() } else { fs::read(&entry).unwrap() };
            all.insert(name, bytes);
        }
    }
    all
}

/// So many at once; each has it to the end, or is reported why not.
fn at_once(folder: &Path, commands: &[&str], reasons: &[&str], rounds: usize) {
    for round in 0..rounds {
        let answers = ended(commands.iter().map(|command| spawn(folder, command)).collect());
        let done = answers.iter().filter(|(code, _)| *code == Some(0)).count();
        assert!(done > 0, "round {round}: one has it: {answers:?}");
        for (code, err) in answers.iter().filter(|(code, _)| *code != Some(0)) {
            assert!(*code == Some(2) && reasons.iter().any(|reason| err.contains(reason)), "round {round}: {code:?} {err}");
        }
    }
}

const RUN: &str = "run model.toml --quiet --threads 1 --force --set output.fields=100 --set output.history=2000 --out";

#[test]
fn of_four_runs_at_once_each_has_the_folder_to_its_end_or_not_at_all() {
    let folder = fresh("lock-four");
    fs::write(folder.join("model.toml"), FLIGHT.replacen("\n", "\nrun.checkpoint_steps = 10\n", 1)).unwrap();
    let alone = ended(vec![spawn(&folder, &format!("{RUN} alone"))]);
    assert_eq!(alone[0].0, Some(0), "{}", alone[0].1);
    let command = format!("{RUN} out");
    at_once(&folder, &[command.as_str(); 4], &["error[E0714]"], 5);
    let [alone, out] = ["alone", "out"].map(|name| files(&folder.join(name)));
    assert_eq!(alone.keys().collect::<Vec<_>>(), out.keys().collect::<Vec<_>>());
    assert!(alone.len() > 100 && alone == out, "what is there is of one run");
    // Those that continue, beside one that begins again.
    let resume = "resume out --quiet --threads 1";
    // The checkpoint may go while it is looked for.
    at_once(&folder, &[&command, resume, &command, resume], &["error[E0714]", "error[E0716]", "error[E0704]"], 3);
    assert!(files(&folder.join("out")) == alone);
}

/// Until something holds, for some seconds.
fn until(mut holds: impl FnMut() -> bool) -> bool {
    let end = Instant::now() + Duration::from_secs(30);
    std::iter::repeat_with(|| std::thread::sleep(Duration::from_millis(10))).take_while(|()| Instant::now() < end).any(|()| holds())
}

#[test]
fn a_run_keeps_others_out_until_it_is_killed() {
    let folder = fresh("lock-killed");
    fs::write(folder.join("model.toml"), FLIGHT.replacen("\n", "\nrun.checkpoint_steps = 100\n", 1)).unwrap();
    let mut child = Running::start(&folder, &["run", "model.toml", "--out", "out", "--quiet", "--set", "run.end=1000s"]);
    let has_two = || fs::read_dir(folder.join("out/checkpoint")).is_ok_and(|entries| entries.count() >= 2);
    let began = until(has_two);
    for arguments in [
        "run model.toml --out out --quiet --force",
        "resume out --quiet --until 2000s",
        // A folder of a case is one of results, too.
        "replay out --from 0s --to 1us --output-every 1us --out out --force --quiet",
    ] {
        let answer = embate(&folder, arguments.split_whitespace());
        assert!(answer.code == Some(2) && answer.err.contains("error[E0714]: another run writes to out;"), "{arguments}: {}", answer.err);
    }
    // Who only looks is let in.
    let report = embate(&folder, ["report", "out"]);
    let continues = child.0.try_wait().unwrap().is_none();
    drop(child);
    assert!(began && continues, "the run continues");
    assert_eq!(report.code, Some(0), "{}", report.err);
    let answer = embate(&folder, ["resume", "out", "--quiet", "--set", "run.max_steps=1"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(folder.join("out/summary.json").is_file() && (cfg!(not(unix)) || !folder.join("out/run.lock").exists()));
}
