//! Every file that the program writes, with a symbolic link in its way: what the link leads to stays as it
//! was. And folders of results with pipes in place of files: no one waits for them.

use crate::{FLIGHT, embate, fresh};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// What must come of it.
enum Comes {
    /// The program refuses, with E0707.
    Refused,
    /// It reports what it could not write, and the link, and continues.
    Told,
    /// It does its work, and this is no link any more.
    Replaced(&'static str),
}
use Comes::{Refused, Replaced, Told};

const CASE: &str = r#"
title = "a block flies"
tier = "every"

[[check]]
name = "kinetic energy at the start, J/m"
quantity = { history = "energy.kinetic", at = "0 s" }
expect = 0.39
tolerance = 1e-9
reason = "half of 0.78 kg/m times the square of 1 m/s"
"#;

const DECK: &str = "*NODE\n1, 0, 0\n2, 0.01, 0\n3, 0.01, 0.01\n4, 0, 0.01\n*ELEMENT, TYPE=CPE4, ELSET=body\n1, 1, 2, 3, 4\n*SOLID SECTION, ELSET=body, MATERIAL=steel\n\
    *MATERIAL, NAME=steel\n*DENSITY\n7800\n*ELASTIC\n200e9, 0.3\n*STEP\n*DYNAMIC, EXPLICIT\n, 1e-4\n*END STEP\n";

const RUN: &str = "run model.toml --out out --quiet --threads 1";
const FORCE: &str = "run model.toml --out out --quiet --threads 1 --force";
/// Needs more mass than its limit: there is a page, but no run.
const HEAVY: &str = "run model.toml --out out --quiet --set run.mass_scaling.time_step=1ms --set run.mass_scaling.limit=0.1";
const RESUME: &str = "resume out --quiet --threads 1";
const SWEEP: &str = "sweep model.toml --vary part.block.velocity[0]=1,2 --out s --quiet";

/// The link, what it leads to from where it lies, what is done before, and the command. `out` has results of
/// a run that was stopped by its number of steps; of a path with `!` it is removed before.
const CASES: &[(&str, &str, &str, Comes)] = &[
    // A run that begins.
    ("!out/fields", "elsewhere", RUN, Refused),
    ("!out/checkpoint", "elsewhere", RUN, Refused),
    ("!out/post-mortem", "elsewhere", RUN, Refused),
    ("!out/post-mortem.part", "elsewhere", RUN, Refused),
    ("!out/pictures.part", "elsewhere", RUN, Refused),
    ("!out/run.lock", "secret", RUN, Refused),
    ("!out/run.lock", "nowhere", RUN, Refused),
    ("!out/post-mortem", "elsewhere", HEAVY, Told),
    ("!out/post-mortem.part", "elsewhere", HEAVY, Told),
    ("!results/flight", "elsewhere", "run flight.toml --quiet", Refused),
    ("!results/flight", "elsewhere", "check flight.toml", Refused),
    ("!results/flight-sweep", "elsewhere", "sweep flight.toml --vary run.end=1us,2us --quiet", Refused),
    // One that takes the place of another.
    ("out/fields", "elsewhere", FORCE, Refused),
    ("out/checkpoint", "elsewhere", FORCE, Refused),
    ("out/post-mortem", "elsewhere", FORCE, Refused),
    ("out/pictures.part", "elsewhere", FORCE, Refused),
    ("out/run.lock", "secret", FORCE, Refused),
    ("out/history.csv.part", "secret", FORCE, Replaced("out/history.csv")),
    ("out/history.csv", "secret", FORCE, Replaced("out/history.csv")),
    ("out/hashes.csv.part", "secret", FORCE, Replaced("out/hashes.csv")),
    ("out/run.json.part", "secret", FORCE, Replaced("out/run.json")),
    ("out/run.json", "secret", FORCE, Replaced("out/run.json")),
    ("out/summary.json.part", "nowhere", FORCE, Replaced("out/summary.json")),
    ("out/summary.json", "secret", FORCE, Replaced("out/summary.json")),
    ("out/fields.pvd.part", "secret", FORCE, Replaced("out/fields.pvd")),
    ("out/final.png.part", "secret", FORCE, Replaced("out/final.png")),
    ("out/final.png", "secret", FORCE, Replaced("out/final.png")),
    ("out/animation.gif", "secret", FORCE, Replaced("out/animation.gif")),
    ("out/energy.svg", "secret", FORCE, Replaced("out/energy.svg")),
    ("out/fields/frame-00000.vtu.part", "secret", FORCE, Replaced("out/fields/frame-00000.vtu")),
    ("out/fields/frame-00001.vtu", "secret", FORCE, Replaced("out/fields/frame-00001.vtu")),
    ("out/checkpoint/000000000184.embate.part", "secret", FORCE, Replaced("out/checkpoint/000000000184.embate")),
    ("out/checkpoint/000000000184.embate", "secret", FORCE, Replaced("out/checkpoint/000000000184.embate")),
    // One that continues.
    ("out/fields", "elsewhere", RESUME, Refused),
    ("out/post-mortem", "elsewhere", RESUME, Refused),
    ("out/pictures.part", "elsewhere", RESUME, Refused),
    ("out/run.lock", "secret", RESUME, Refused),
    ("out/history.csv.part", "secret", RESUME, Refused),
    ("out/history.csv.part", "nowhere", RESUME, Refused),
    ("out/hashes.csv.part", "secret", RESUME, Refused),
    ("out/run.json.part", "secret", RESUME, Replaced("out/run.json")),
    ("out/fields.pvd.part", "secret", RESUME, Replaced("out/fields.pvd")),
    ("out/summary.json.part", "secret", RESUME, Replaced("out/summary.json")),
    ("out/fields/frame-00004.vtu.part", "secret", RESUME, Replaced("out/fields/frame-00004.vtu")),
    ("out/replay", "elsewhere", "replay out --from 0 --to 10us --output-every 1us --quiet", Refused),
    // What looks at results, and what stands alone.
    ("out/report.html.part", "secret", "report out", Refused),
    ("out/report.html.part", "nowhere", "report out", Refused),
    ("out/report.html", "secret", "report out", Replaced("out/report.html")),
    ("r.html.part", "secret", "report out --out r.html", Refused),
    ("c/check.png.part", "secret", "check model.toml --out c", Told),
    ("c/check.png", "secret", "check model.toml --out c", Replaced("c/check.png")),
    ("n/model.toml.part", "secret", "new n", Refused),
    ("n/model.toml", "secret", "new n --force", Replaced("n/model.toml")),
    ("n/model.toml", "nowhere", "new n", Replaced("n/model.toml")),
    ("i/model.toml.part", "secret", "import deck.inp --out i", Refused),
    ("i/mesh.inp.part", "secret", "import deck.inp --out i", Refused),
    ("i/import.txt.part", "secret", "import deck.inp --out i", Refused),
    ("i/mesh.inp", "secret", "import deck.inp --out i --force", Replaced("i/mesh.inp")),
    ("m/embate-run.1.part", "secret", "man --out m", Refused),
    ("m/embate-run.1", "secret", "man --out m", Replaced("m/embate-run.1")),
    ("b.json.part", "secret", "bench --seconds 0 --quiet --json b.json", Refused),
    // Sweeps.
    ("s/sweep.journal", "secret", SWEEP, Refused),
    ("s/sweep.journal", "nowhere", SWEEP, Refused),
    ("s/sweep.json.part", "secret", SWEEP, Refused),
    ("s/sweep.csv.part", "secret", SWEEP, Refused),
    ("s/sweep.svg.part", "secret", SWEEP, Refused),
    ("s/0001", "elsewhere", SWEEP, Refused),
    ("s/0001/history.csv.part", "secret", SWEEP, Refused),
    ("s/0001/summary.json.part", "secret", SWEEP, Refused),
    ("s/0001", "elsewhere", "sweep model.toml --vary run.end=1us,2us --out s --quiet --keep-frames", Refused),
    ("s/0001/fields", "elsewhere", "sweep model.toml --vary run.end=1us,2us --out s --quiet --keep-frames", Refused),
    ("s/0007", "elsewhere", "sweep model.toml --vary run.end=1us,2us --out s --quiet --force", Refused),
    // Verification.
    ("v.html.part", "secret", "verify --in cases --quiet --report v.html", Refused),
    ("v.md.part", "secret", "verify --in cases --quiet --report v.md", Refused),
    ("j.json.part", "secret", "verify --in cases --quiet --json j.json", Refused),
    ("o/flight", "elsewhere", "verify --in cases --quiet --out o", Refused),
    ("o/flight/model", "elsewhere", "verify --in cases --quiet --out o --force", Refused),
    ("o/flight/model/fields", "elsewhere", "verify --in cases --quiet --out o", Refused),
];

/// All files below a folder.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.clone(), fs::read(path).unwrap_or_default()))
        .collect()
}

/// A folder with a model, results of a run that was stopped, a deck and a case.
fn prepared(name: &str) -> PathBuf {
    let folder = fresh(name);
    let checkpoints = "run.checkpoint_steps = 4\nrun.max_steps = 9\n";
    let model = FLIGHT.replace("output = { fields = 4, history = 20, pictures = false }", "output = { fields = 8, history = 20 }");
    fs::write(folder.join("model.toml"), model.replacen("\n", &format!("\n{checkpoints}"), 1)).unwrap();
    let answer = embate(&folder, RUN.split_whitespace());
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    fs::write(folder.join("model.toml"), model.replacen("\n", "\nrun.checkpoint_steps = 4\n", 1)).unwrap();
    fs::write(folder.join("flight.toml"), FLIGHT).unwrap();
    fs::write(folder.join("deck.inp"), DECK).unwrap();
    fs::create_dir_all(folder.join("cases/flight")).unwrap();
    fs::write(folder.join("cases/flight/model.toml"), FLIGHT).unwrap();
    fs::write(folder.join("cases/flight/expected.toml"), CASE).unwrap();
    folder
}

fn copy(from: &Path, to: &Path) {
    assert!(Command::new("cp").arg("-R").args([from, to]).status().unwrap().success());
}

#[test]
fn nothing_is_written_or_removed_through_a_link_by_any_writer() {
    let base = prepared("links-base");
    let mut wrong = String::new();
    for (index, (planted, target, command, comes)) in CASES.iter().enumerate() {
        let folder = base.with_file_name(format!("links-{index}"));
        let _ = fs::remove_dir_all(&folder);
        copy(&base, &folder);
        // What lies elsewhere has names that the program would write or remove.
        let elsewhere = folder.join("elsewhere");
        fs::create_dir_all(&elsewhere).unwrap();
        let names = ["frame-00000.vtu", "000000000004.embate", "README.md", "final.png", "summary.json", "mine.txt"];
        names.iter().for_each(|name| fs::write(elsewhere.join(name), "mine").unwrap());
        fs::write(folder.join("secret"), "mine").unwrap();
        if planted.starts_with('!') {
            fs::remove_dir_all(folder.join("out")).unwrap();
        }
        let link = folder.join(planted.trim_start_matches('!'));
        fs::create_dir_all(link.parent().unwrap()).unwrap();
        let _ = fs::remove_file(&link).or_else(|_| fs::remove_dir_all(&link));
        symlink(folder.join(target), &link).unwrap();
        let before = contents(&elsewhere);
        let answer = embate(&folder, command.split_whitespace());
        let mut is = |holds: bool, what: &str| {
            if !holds {
                wrong.push_str(&format!("--- {planted} -> {target}, `{command}`: {what}; it said {:?}:\n{}\n", answer.code, answer.err));
            }
        };
        is(contents(&elsewhere) == before, "what lies elsewhere has changed");
        is(fs::read_to_string(folder.join("secret")).unwrap() == "mine", "what the link leads to has changed");
        is(!folder.join("nowhere").exists(), "what the link leads to was made");
        match comes {
            Refused => is(answer.code != Some(0) && answer.err.contains("error[E0707]"), "it is not refused"),
            Told => is(answer.err.contains("symbolic link"), "it is not told"),
            Replaced(path) => {
                let is_file = fs::symlink_metadata(folder.join(path)).is_ok_and(|data| data.is_file());
                is(answer.code == Some(0) && is_file, "it is not replaced");
            }
        }
        fs::remove_dir_all(&folder).unwrap();
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_folder_that_the_user_names_may_be_a_link() {
    let folder = fresh("links-own");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    fs::create_dir(folder.join("disk")).unwrap();
    symlink("disk", folder.join("out")).unwrap();
    for _ in 0..2 {
        let answer = embate(&folder, FORCE.split_whitespace());
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert!(folder.join("disk/summary.json").is_file() && fs::symlink_metadata(folder.join("out")).unwrap().is_symlink());
    }
}

/// The answer of a program that must not wait for anything.
fn at_once(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_embate"))
        .args(arguments)
        .current_dir(folder)
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let end = Instant::now() + Duration::from_secs(20);
    while Instant::now() < end {
        if let Some(status) = child.try_wait().unwrap() {
            return (status.code(), std::io::read_to_string(child.stderr.take().unwrap()).unwrap());
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    (None, format!("{arguments:?} waits"))
}

#[test]
fn nobody_waits_for_a_pipe_in_a_folder_of_results() {
    let base = prepared("pipes-base");
    let readers: &[(&str, &[&[&str]])] = &[
        ("summary.json", &[&["report", "out"]]),
        ("run.json", &[&["report", "out"], &["diff", "out", "out"]]),
        ("history.csv", &[&["report", "out"], &["resume", "out", "--quiet"]]),
        ("hashes.csv", &[&["diff", "out", "out"], &["resume", "out", "--quiet"]]),
        ("final.png", &[&["report", "out"]]),
        ("run.lock", &[&["resume", "out", "--quiet"], &["run", "model.toml", "--out", "out", "--force", "--quiet"]]),
        ("checkpoint/000000000008.embate", &[&["resume", "out", "--quiet"]]),
        (
            "../model.toml",
            &[
                &["resume", "out", "--quiet"],
                &["check", "model.toml"],
                &["replay", "out", "--from", "0s", "--to", "1us", "--output-every", "1us"],
            ],
        ),
    ];
    for (index, (name, commands)) in readers.iter().enumerate() {
        let folder = base.with_file_name(format!("pipes-{index}"));
        for command in *commands {
            let _ = fs::remove_dir_all(&folder);
            copy(&base, &folder);
            // The model of the copy.
            let place = ["--model", "model.toml"].into_iter().filter(|_| matches!(command[0], "resume" | "replay"));
            let pipe = folder.join("out").join(name);
            let _ = fs::remove_file(&pipe);
            assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
            let (code, err) = at_once(&folder, &command.iter().copied().chain(place).collect::<Vec<_>>());
            assert!(err.contains("named pipe"), "{name}, {command:?}: {code:?} {err}");
            // In place of a checkpoint that can't be read the one before is taken.
            assert!(code.is_some_and(|code| (code == 0) == name.starts_with("checkpoint")), "{name}, {command:?}: {code:?} {err}");
        }
        let _ = fs::remove_dir_all(&folder);
    }
}
