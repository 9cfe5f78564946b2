//! Runs that are stopped, killed, or run out of room, and continue: what they leave is what one that was
//! never stopped leaves, byte by byte.
//!
//! The long form of the test that kills: `cargo test -p embate --test all -- --ignored two_hundred`.

use crate::determinism::{examples, instruction_sets, steps_of};
use crate::{Answer, embate, fresh};
use embate_solver::output::Summary;
use embate_solver::simulation::{Options, Simulation};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// A block that is thrown into a corner and at another block.
const MODEL: &str = r#"
title = "A block in a corner"
run = { end = "0.6 ms" }
material.metal = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "300 MPa", hardening = "1 GPa" }
part = [
    { name = "thrown", material = "metal", rectangle = { corner = [0, "0.1 mm"], size = ["20 mm", "20 mm"], elements = [12, 12] }, velocity = [60, -120] },
    { name = "hit", material = "metal", rectangle = { corner = ["20.5 mm", "0.05 mm"], size = ["10 mm", "25 mm"], elements = [6, 15] } },
]
contact = [{ name = "all", bodies = "all", friction = 0.2 }]
obstacle = [{ name = "floor", plane = { point = [0, 0], normal = [0, 1] }, friction = 0.3 }]
probe = [{ name = "P", part = "thrown", point = [0, 0] }]
output = { fields = 23, history = 300 }
"#;

fn model(folder: &Path) {
    fs::write(folder.join("model.toml"), MODEL).unwrap();
}

fn run<'a>(folder: &Path, out: &'a str, more: impl IntoIterator<Item = &'a str>) -> Answer {
    embate(folder, ["run", "model.toml", "--quiet", "--threads", "1", "--out", out].into_iter().chain(more))
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
}

/// All files of results below a folder but those of checkpoints and the one that says with which keys it was
/// started; of the summary what is no time of the machine.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = PathBuf::from(entry.file_name().unwrap());
        if entry.is_dir() && name != Path::new("checkpoint") {
            all.extend(files(&entry).into_iter().map(|(path, bytes)| (name.join(path), bytes)));
        } else if name == Path::new("summary.json") {
            let mut figures = summary(folder);
            for key in
                ["wall_seconds", "user_cpu_seconds", "output_seconds", "output_wait_seconds", "element_steps_per_second", "threads", "simd"]
            {
                figures.as_object_mut().unwrap().remove(key);
            }
            all.insert(name, figures.to_string().into_bytes());
        } else if !entry.is_dir() && name != Path::new("run.json") {
            all.insert(name, fs::read(&entry).unwrap());
        }
    }
    all
}

fn is_the_same(whole: &Path, resumed: &Path) {
    let [whole, resumed] = [whole, resumed].map(files);
    assert_eq!(whole.keys().collect::<Vec<_>>(), resumed.keys().collect::<Vec<_>>());
    for (path, bytes) in &whole {
        assert!(*bytes == resumed[path], "{} differs", path.display());
    }
    assert!(whole[Path::new("hashes.csv")].len() > 500);
    assert!(whole.len() > 50 && whole.contains_key(Path::new("animation.gif")) && whole.contains_key(Path::new("obstacles.pvd")));
}

/// The same run, never stopped.
fn whole(folder: &Path) -> PathBuf {
    model(folder);
    let answer = run(folder, "whole", []);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    folder.join("whole")
}

/// The checkpoints of a run, the newest last.
fn checkpoints(out: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir(out.join("checkpoint")).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    found
}

/// A run that was stopped after 700 steps, with checkpoints at 500 and 600.
fn stopped(folder: &Path, out: &str) -> PathBuf {
    let answer = run(folder, out, ["--set", "run.checkpoint_steps=100", "--set", "run.max_steps=690"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(summary(&folder.join(out))["status"], "stopped");
    let names: Vec<_> = checkpoints(&folder.join(out)).iter().map(|path| path.file_name().unwrap().to_str().unwrap().to_string()).collect();
    assert_eq!(names, ["000000000500.embate", "000000000600.embate"]);
    folder.join(out)
}

fn resume(folder: &Path, out: &str) -> Answer {
    embate(folder, ["resume", out, "--threads", "3", "--simd", "scalar", "--set", "run.max_steps=1000000"])
}

#[test]
fn a_run_that_continues_leaves_the_files_of_one_that_was_never_stopped() {
    let folder = fresh("resume");
    let whole = whole(&folder);
    let out = stopped(&folder, "out");
    let answer = resume(&folder, "out");
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.err.contains("continuing from step 600"), "{}", answer.err);
    is_the_same(&whole, &out);
    // From the end as well, to another end: the same as a run with that end from the start, as the steps
    // before it had not begun to land.
    let answer =
        run(&folder, "long", ["--set", "run.end=\"0.7 ms\"", "--set", "output.fields=\"20 us\"", "--set", "output.history=\"1 us\""]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let answer = run(
        &folder,
        "short",
        ["--set", "run.checkpoint_steps=700", "--set", "output.fields=\"20 us\"", "--set", "output.history=\"1 us\""],
    );
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let answer = embate(&folder, ["resume", "short", "--until", "0.7 ms", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    is_the_same(&folder.join("long"), &folder.join("short"));
    let answer = embate(&folder, ["resume", "short", "--until", "0.1 ms"]);
    assert!(answer.code == Some(2) && answer.err.contains("replay"), "{}", answer.err);
}

#[test]
fn checkpoints_that_a_run_replaces_while_they_are_looked_for_are_looked_for_again() {
    let folder = fresh("replaced");
    model(&folder);
    let out = stopped(&folder, "out");
    let threads = embate_files::threads::Threads::one();
    // Between the list of the folder and the reading the run writes a newer one and removes the two that are
    // listed.
    let is_replaced = std::cell::Cell::new(false);
    let fits = |_: &embate_files::checkpoint::Generation| {
        if !is_replaced.replace(true) {
            let [older, newest]: [PathBuf; 2] = checkpoints(&out).try_into().unwrap();
            fs::rename(newest, out.join("checkpoint/000000000900.embate")).unwrap();
            fs::remove_file(older).unwrap();
        }
        true
    };
    let (found, faults) = embate_files::checkpoint::newest(&out, &threads, fits).unwrap();
    assert!(found.state.step == 600 && faults.is_empty(), "{faults:?}");
    // Where there is none it says so.
    fs::remove_dir_all(out.join("checkpoint")).unwrap();
    assert!(embate_files::checkpoint::newest(&out, &threads, |_| true).is_err_and(|faults| faults.is_empty()));
}

#[test]
fn a_damaged_checkpoint_is_reported_and_the_one_before_it_is_used() {
    let folder = fresh("damaged");
    let whole = whole(&folder);
    let out = stopped(&folder, "out");
    let [older, newest]: [PathBuf; 2] = checkpoints(&out).try_into().unwrap();
    let mut bytes = fs::read(&newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    fs::write(&newest, &bytes).unwrap();
    let answer = resume(&folder, "out");
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.err.contains("000000000600.embate is damaged") && answer.err.contains("of step 500"), "{}", answer.err);
    is_the_same(&whole, &out);

    // Torn at any length, and none that is sound.
    let out = stopped(&folder, "torn");
    for length in [0, 7, 30, bytes.len() / 3, bytes.len() - 1] {
        checkpoints(&out).iter().for_each(|path| fs::write(path, &fs::read(&older).unwrap_or_else(|_| bytes.clone())[..length]).unwrap());
        let answer = resume(&folder, "torn");
        assert!(answer.code == Some(2) && answer.err.matches("is damaged").count() == 2, "{length}: {}", answer.err);
    }
    let answer = resume(&folder, "whole");
    assert!(answer.code == Some(2) && answer.err.contains("there is no checkpoint in whole"), "{}", answer.err);
    let answer = embate(&folder, ["resume", "whole"]);
    assert!(answer.code == Some(0) && answer.err.contains("is done"), "{}", answer.err);
}

#[test]
fn a_changed_model_is_refused_with_what_has_changed_and_changed_results_too() {
    let folder = fresh("changed");
    model(&folder);
    let out = stopped(&folder, "out");
    let before = files(&out);
    fs::write(folder.join("model.toml"), MODEL.replace("velocity = [60, -120]", "velocity = [60, -125]").replace("300 MPa", "301 MPa"))
        .unwrap();
    let answer = resume(&folder, "out");
    assert_eq!(answer.code, Some(2), "{}", answer.err);
    for line in ["part[0].velocity[1]: was -120.0, is -125.0", "material.metal.parameters.yield: was 300000000.0, is 301000000.0"] {
        assert!(answer.err.contains(line), "{}", answer.err);
    }
    assert!(files(&out) == before, "nothing was touched");
    // What may change: limits, output, title.
    fs::write(folder.join("model.toml"), MODEL.replace("fields = 23", "fields = 5, pictures = false").replace("A block", "The block"))
        .unwrap();
    let history = out.join("history.csv");
    let text = fs::read_to_string(&history).unwrap();
    fs::write(&history, text.replacen(",", ", ", 1)).unwrap();
    let answer = resume(&folder, "out");
    assert!(answer.code == Some(2) && answer.err.contains("is not as the checkpoint knows it"), "{}", answer.err);
    fs::remove_file(folder.join("out/history.csv.part")).unwrap();
    fs::write(&history, text).unwrap();
    let answer = resume(&folder, "out");
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(summary(&out)["status"], "done");
}

#[test]
fn a_stretch_is_shown_again_with_the_same_bits() {
    let folder = fresh("replay");
    let whole = whole(&folder);
    stopped(&folder, "out");
    // From before the checkpoints: from the start; from after them: from the nearest.
    for (from, to) in [("0.1 ms", "0.11 ms"), ("0.4 ms", "0.41 ms")] {
        let answer = embate(
            &folder,
            ["replay", "out", "--from", from, "--to", to, "--output-every", "1 us", "--out", "stretch", "--force", "--quiet"],
        );
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        let figures = summary(&folder.join("stretch"));
        assert_eq!(figures["status"], "done");
        let steps = figures["steps"].to_string();
        let frames = fs::read_to_string(folder.join("stretch/fields.pvd")).unwrap().matches("<DataSet").count();
        assert!((10..=12).contains(&frames), "{frames}");
        let answer = run(&folder, "until", ["--force", "--set", &format!("run.max_steps={steps}")]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert_eq!(summary(&folder.join("until"))["state_hash"], figures["state_hash"]);
    }
    assert!(summary(&whole)["steps"].as_u64().unwrap() > 800);
    for wrong in [["--from", "2 ms", "--to", "1 ms"], ["--from", "soon", "--to", "1 ms"]] {
        let answer = embate(&folder, ["replay", "out", "--output-every", "1 us"].into_iter().chain(wrong));
        assert_eq!(answer.code, Some(2), "{}", answer.err);
    }
}

#[test]
fn a_run_that_fails_keeps_its_last_good_state_and_may_continue_with_another_limit() {
    let folder = fresh("last-good");
    model(&folder);
    let crush = [
        "--set",
        "part.thrown.velocity=[60, -900]",
        "--set",
        "run.energy_limit=0.9",
        "--set",
        "run.step_limit=\"60 ns\"",
        "--set",
        "run.checkpoint_steps=40",
    ];
    let answer = run(&folder, "out", crush);
    assert!(answer.code == Some(1) && answer.err.contains("time step fell"), "{}", answer.err);
    let failed = summary(&folder.join("out"))["steps"].as_u64().unwrap();
    let newest = checkpoints(&folder.join("out")).pop().unwrap();
    assert_eq!(newest.file_name().unwrap().to_str().unwrap(), format!("{:012}.embate", failed - 1));
    let again = embate(&folder, ["resume", "out", "--quiet"]);
    assert!(again.code == Some(1) && again.err.contains("time step fell"), "{}", again.err);
    assert_eq!(summary(&folder.join("out"))["steps"], failed);
    let further = embate(
        &folder,
        ["resume", "out", "--quiet", "--set", "run.step_limit=\"1 ns\"", "--set", &format!("run.max_steps={}", failed + 3)],
    );
    assert_eq!(further.code, Some(0), "{}", further.err);
    assert_eq!(summary(&folder.join("out"))["steps"], failed + 3);
}

#[test]
fn every_example_continues_from_its_state() {
    // `tests/all/restart.rs` of the solver has contacts of all kinds in action.
    let levels = instruction_sets();
    for (number, folder) in examples().into_iter().enumerate() {
        let model = embate_files::model_file::load(&folder, &[]).unwrap_or_else(|reported| panic!("{}", reported.rendered));
        let steps = steps_of(&model);
        let options = |number: usize| Options { threads: 1 + number % 3, simd: Some(levels[number % levels.len()].clone()) };
        let mut whole = Simulation::new(&model, &options(number)).unwrap();
        whole.advance(f64::INFINITY, steps / 2).unwrap();
        let state = whole.state().unwrap();
        let mut resumed = Simulation::resumed(&model, &options(number + 1), &state.sections).unwrap();
        for _ in 0..2 {
            let seen = [&whole, &resumed].map(|simulation| {
                let frame = simulation.frame();
                let fields = frame.fields.iter().flat_map(|field| &field.values).chain(&frame.coordinates);
                let bits: Vec<u64> = fields.copied().chain(simulation.history_row()).map(f64::to_bits).collect();
                (bits, Summary { threads: 0, simd: String::new(), ..simulation.summary() })
            });
            assert!(seen[0] == seen[1], "{} at step {}", folder.display(), whole.steps());
            whole.advance(f64::INFINITY, steps - steps / 2).unwrap();
            resumed.advance(f64::INFINITY, steps - steps / 2).unwrap();
        }
    }
}

/// A program in the background; ends with the test.
pub(crate) struct Running(pub(crate) Child);

impl Running {
    pub(crate) fn start(folder: &Path, arguments: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_embate"));
        Self(command.args(arguments).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
    }

    #[cfg(unix)]
    fn report(&self, signal: &str) {
        assert!(Command::new("kill").args([signal, &self.0.id().to_string()]).status().unwrap().success());
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Waits until the history of a run has begun.
fn has_begun(out: &Path) {
    while !out.join("history.csv.part").exists() {
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[cfg(unix)]
#[test]
fn a_signal_stops_a_run_with_its_state_kept() {
    let folder = fresh("signal");
    let whole = whole(&folder);
    for signal in ["-TERM", "-INT"] {
        let mut running = Running::start(&folder, &["run", "model.toml", "--out", "out", "--force", "--threads", "2"]);
        has_begun(&folder.join("out"));
        running.report(signal);
        let code = running.0.wait().unwrap().code();
        // It may have been done already on a slow day.
        if code == Some(130) {
            assert_eq!((checkpoints(&folder.join("out")).len(), summary(&folder.join("out"))["status"].as_str()), (1, Some("stopped")));
            let answer = embate(&folder, ["resume", "out", "--quiet"]);
            assert_eq!(answer.code, Some(0), "{}", answer.err);
        }
        is_the_same(&whole, &folder.join("out"));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_hangup_stops_a_run_unless_it_was_started_to_live_through_it() {
    let folder = fresh("hangup");
    model(&folder);
    for (trap, codes) in [("", [130, 0]), ("trap '' HUP;", [0, 0])] {
        let script = format!("{trap} exec {} run model.toml --out out --force --quiet --set run.end=1e-3", env!("CARGO_BIN_EXE_embate"));
        let _ = fs::remove_dir_all(folder.join("out"));
        let mut running = Running(Command::new("sh").args(["-c", &script]).current_dir(&folder).spawn().unwrap());
        has_begun(&folder.join("out"));
        running.report("-HUP");
        let code = running.0.wait().unwrap().code().unwrap();
        assert!(codes.contains(&code), "{trap}: {code}");
    }
}

/// What collections name is there.
fn collections_are_true(out: &Path) {
    for of in ["fields.pvd", "obstacles.pvd"] {
        let collection = fs::read_to_string(out.join(of)).unwrap_or_default();
        for name in collection.split("file=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
            assert!(out.join(name).exists(), "{of} names {name}");
        }
    }
}

#[test]
fn collections_name_no_frame_that_is_removed_however_far_the_removal_of_later_frames_comes() {
    let folder = fresh("removed");
    let whole = whole(&folder);
    let out = stopped(&folder, "out");
    let [_, newest]: [PathBuf; 2] = checkpoints(&out).try_into().unwrap();
    fs::remove_file(newest).unwrap();
    let frames = || fs::read_dir(out.join("fields")).unwrap().count();
    let before = frames();
    // What can't be removed stands behind all others.
    let obstacle = out.join("fields/obstacles-99999.vtu");
    fs::create_dir(&obstacle).unwrap();
    let answer = resume(&folder, "out");
    assert!(answer.code != Some(0) && answer.err.contains("can't remove"), "{:?} {}", answer.code, answer.err);
    assert!(frames() < before, "later frames were removed");
    collections_are_true(&out);
    fs::remove_dir(&obstacle).unwrap();
    let answer = resume(&folder, "out");
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    is_the_same(&whole, &out);
}

/// Everything under its final name is whole, and tables hold the first lines of those of the run that was
/// never stopped.
fn nothing_is_torn(out: &Path, whole: &Path) {
    for (path, bytes) in files(out) {
        let (name, text) = (path.to_str().unwrap(), String::from_utf8_lossy(&bytes));
        let is_whole = match path.extension().and_then(|ending| ending.to_str()) {
            Some("part") => true,
            Some("vtu" | "pvd") => text.trim_end().ends_with("</VTKFile>"),
            Some("csv") => text.ends_with('\n') && fs::read(whole.join(&path)).unwrap().starts_with(&bytes),
            Some("svg") => text.trim_end().ends_with("</svg>"),
            Some("gif") => bytes.last() == Some(&0x3b),
            Some("png") => bytes.ends_with(b"IEND\xaeB`\x82"),
            Some("json") => true, // parsed by `files`
            // Of a run that was killed; nothing is ever in it.
            Some("lock") => bytes.is_empty(),
            _ => false,
        };
        assert!(is_whole, "{name} is torn");
    }
    collections_are_true(out);
    let one = embate_files::threads::Threads::one();
    for generation in embate_files::checkpoint::generations(out) {
        embate_files::checkpoint::Checkpoint::read(&generation.path, &one).unwrap_or_else(|fault| panic!("{fault}"));
    }
}

/// Kills runs so many times, and until there is a state to resume from, at moments that a fixed sequence
/// spreads over the first `longest` milliseconds of each.
fn killed(name: &str, times: usize, longest: u64) {
    let folder = fresh(name);
    let whole = whole(&folder);
    let (mut random, mut kills, mut ends) = (1_u64, 0, 0);
    let out = folder.join("out");
    let has_state = || !embate_files::checkpoint::generations(&out).is_empty();
    while kills < times || !has_state() {
        // On a slow machine no run may come to its first state in that time.
        let longest = longest * (1 + (kills / times) as u64);
        let has_checkpoint = has_state();
        let arguments: &[&str] = if has_checkpoint {
            &["resume", "out", "--quiet"]
        } else {
            &["run", "model.toml", "--out", "out", "--force", "--quiet", "--set", "run.checkpoint_steps=25"]
        };
        let mut running = Running::start(&folder, arguments);
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_micros(random % (1000 * longest)));
        match running.0.try_wait().unwrap() {
            None => {
                running.0.kill().unwrap();
                kills += 1;
                let _ = running.0.wait();
                if out.exists() {
                    nothing_is_torn(&out, &whole);
                }
            }
            Some(status) => {
                assert!(status.success(), "after {kills} kills: {status}");
                is_the_same(&whole, &out);
                ends += 1;
                fs::remove_dir_all(&out).unwrap();
            }
        }
    }
    let answer = embate(&folder, ["resume", "out", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    is_the_same(&whole, &out);
    println!("{kills} kills, {} runs that came to their end all the same", ends + 1);
}

#[test]
fn whoever_is_killed_at_any_moment_continues_and_nothing_is_torn() {
    killed("killed", 10, 250);
}

#[test]
#[ignore = "minutes; see the head of the file"]
fn two_hundred_kills_change_no_byte() {
    killed("killed-often", 200, 300);
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_reported_the_state_is_kept_and_with_room_the_run_continues() {
    let folder = fresh("full");
    let whole = whole(&folder);
    // No file may grow beyond so many blocks of 512 or 1024 bytes; the system refuses the write as on a full
    // disk.
    let program = env!("CARGO_BIN_EXE_embate");
    let limited = |blocks: u32, command: &str| {
        let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} {command}");
        let output = Command::new("sh").args(["-c", &script]).current_dir(&folder).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, reported) = [200, 100]
        .into_iter()
        .map(|blocks| limited(blocks, "run model.toml --out out --force --quiet --set run.checkpoint_steps=25"))
        .find(|(code, _)| *code != Some(0))
        .unwrap();
    assert_eq!(code, Some(1), "{reported}");
    assert!(reported.contains("can't write") && reported.contains("out/"), "{reported}");
    assert!(!checkpoints(&folder.join("out")).is_empty());
    nothing_is_torn(&folder.join("out"), &whole);
    // Still none.
    let (code, reported) = limited(60, "resume out --quiet");
    assert!(code != Some(0) && reported.contains("can't write"), "{reported}");
    let answer = embate(&folder, ["resume", "out", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    is_the_same(&whole, &folder.join("out"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_small_disk_that_is_full_says_so_where_the_system_lets_one_be_made() {
    let folder = fresh("tmpfs");
    let whole = whole(&folder);
    let program = env!("CARGO_BIN_EXE_embate");
    // A disk of its own that no one else sees; results are copied out of it before it is gone.
    let script = format!(
        "mkdir disk && mount -t tmpfs -o size=700k none disk || exit 77
         {program} run model.toml --out disk/out --quiet --set run.checkpoint_steps=25; code=$?
         cp -r disk/out out; exit $code"
    );
    let output = Command::new("unshare").args(["--user", "--map-root-user", "--mount", "sh", "-c", &script]).current_dir(&folder).output();
    let Ok(output) = output else { return };
    let reported = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.code() != Some(1) {
        assert!(output.status.code() != Some(0), "700 kB were enough");
        println!("no disk of its own here: {reported}");
        return;
    }
    assert!(reported.contains("No space left on device") && reported.contains("free some space"), "{reported}");
    nothing_is_torn(&folder.join("out"), &whole);
    let answer = embate(&folder, ["resume", "out", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    is_the_same(&whole, &folder.join("out"));
}
