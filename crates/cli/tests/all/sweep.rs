//! `embate sweep`: which runs it makes, what its table says, and that it continues where it was.

use crate::{Answer, FLIGHT, embate, fresh};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The same with this key's values.
fn sweep(name: &str, arguments: &[&str]) -> (Answer, std::path::PathBuf) {
    let folder = fresh(name);
    fs::write(folder.join("flight.toml"), FLIGHT).unwrap();
    (again(&folder, arguments), folder)
}

fn again(folder: &Path, arguments: &[&str]) -> Answer {
    embate(folder, ["sweep", "flight.toml", "--out", "out", "--quiet"].iter().chain(arguments))
}

/// Header and rows of the table; no cell of these tests has a comma in it.
fn table(folder: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("out/sweep.csv")).unwrap();
    text.lines().map(|line| line.split(',').map(ToString::to_string).collect()).collect()
}

fn column(table: &[Vec<String>], name: &str) -> Vec<f64> {
    let at = table[0].iter().position(|it| it == name).unwrap_or_else(|| panic!("no {name} in {:?}", table[0]));
    table[1..].iter().map(|row| row[at].parse().unwrap_or(f64::NAN)).collect()
}

fn near(found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= 1e-9 * b.abs()), "{found:?}, not {wanted:?}");
}

#[test]
fn a_factorial_sweep_meets_the_closed_form_in_every_run() {
    let arguments = ["--vary", "part.block.velocity[0]=1m/s:9 m/s:3", "--vary", "material.steel.density=1000,2000"];
    let (answer, folder) = sweep("sweep-factorial", &arguments);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let table = table(&folder);
    assert_eq!(table[0][..4], ["run", "part.block.velocity[0] [m/s]", "material.steel.density [kg/m^3]", "status"]);
    near(&column(&table, "run"), &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    near(&column(&table, "part.block.velocity[0] [m/s]"), &[1.0, 1.0, 5.0, 5.0, 9.0, 9.0]);
    let place = |velocity: f64| 0.005 + 1e-4 * velocity;
    near(&column(&table, "last(P.x)"), &[1.0, 1.0, 5.0, 5.0, 9.0, 9.0].map(place));
    let energy = |density: f64, velocity: f64| 0.5 * density * 1e-4 * velocity * velocity;
    let energies = [(1e3, 1.0), (2e3, 1.0), (1e3, 5.0), (2e3, 5.0), (1e3, 9.0), (2e3, 9.0)].map(|(d, v)| energy(d, v));
    near(&column(&table, "last(energy.kinetic)"), &energies);
    assert!(folder.join("out/sweep.svg").is_file());
    assert!(folder.join("out/0006/summary.json").is_file() && folder.join("out/0006/history.csv").is_file());
    assert!(!folder.join("out/0006/fields").exists(), "no frames unless they are wanted");
}

#[test]
fn lists_go_together_and_outputs_are_chosen() {
    let arguments = [
        "--zip",
        "--vary",
        "part.block.velocity=[1, 0],[0, \"2 m/s\"]",
        "--vary",
        "part.block.element=quad4,quad4_reduced",
        "--output",
        "at=50us(P.x)",
        "--output",
        "first_above=5.1mm(P.y)",
        "--output",
        "elements",
        "--output",
        "state_hash",
        "--output",
        "P.vy",
        "--summary-only",
    ];
    let (answer, folder) = sweep("sweep-zip", &arguments);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let text = fs::read_to_string(folder.join("out/sweep.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "run,part.block.velocity,part.block.element,status,at=50us(P.x),first_above=5.1mm(P.y),elements,state_hash,P.vy,error"
    );
    assert!(lines[1].starts_with("1,\"[1, 0]\",quad4,done,") && lines[1].contains(",,4,"), "it never rises: {text}");
    assert!(lines[2].starts_with("2,\"[0, \"\"2 m/s\"\"]\",quad4_reduced,done,0.005,"), "{text}");
    let cell = |line: &str, from_the_end: usize| line.rsplit(',').nth(from_the_end).unwrap().parse::<f64>().unwrap();
    near(&[cell(lines[1], 5), cell(lines[2], 4)], &[0.005 + 5e-5, 5e-5]);
    assert!(lines[2].ends_with(",2,"), "the last velocity: {text}");
    assert!(!folder.join("out/0001").exists(), "nothing but the table");
}

#[test]
fn a_table_of_runs_has_its_units_in_the_header() {
    let folder = fresh("sweep-table");
    fs::write(folder.join("flight.toml"), FLIGHT).unwrap();
    fs::write(folder.join("runs.csv"), "part.block.velocity[0] [km/s],run.end\n0.001,\"0.1 ms\"\n\n0.002,\"0.2 ms\"\n").unwrap();
    let answer = again(&folder, &["--table", "runs.csv", "--output", "P.x"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let table = table(&folder);
    near(&column(&table, "part.block.velocity[0] [m/s]"), &[1.0, 2.0]);
    near(&column(&table, "run.end [s]"), &[1e-4, 2e-4]);
    near(&column(&table, "P.x"), &[0.005 + 1e-4, 0.005 + 4e-4]);
    fs::write(folder.join("short.csv"), "run.end,run.safety\n0.001\n1,2,3\n").unwrap();
    let short = again(&folder, &["--table", "short.csv"]);
    assert_eq!(short.code, Some(2));
    assert!(
        short.err.contains("short.csv:2:1") && short.err.contains("1 values for 2 keys") && short.err.contains("short.csv:3:1"),
        "{}",
        short.err
    );
}

#[test]
fn all_faults_are_reported_at_once_with_their_runs_and_nothing_is_run() {
    let arguments = [
        "--vary",
        "material.stel.density=1:2:3",
        "--vary",
        "material.steel.poisson=0.3,0.6",
        "--vary",
        "material.steel.yung=1",
        "--vary",
        "part.block.velocity[0]=1 m/s,2 mm",
        "--output",
        "last(P.z)",
        "--output",
        "maxi(P.x)",
    ];
    let (answer, folder) = sweep("sweep-faults", &arguments);
    assert_eq!(answer.code, Some(2));
    for word in [
        "did you mean `steel`",
        "did you mean `young`",
        "but it is 0.6",
        "2 mm",
        "did you mean `max`",
        "--vary:1:1",
        "(in runs 3, 4, 7, 8 and 2 more)",
    ] {
        assert!(answer.err.contains(word), "{word} in\n{}", answer.err);
    }
    assert!(answer.err.contains("5 faults: nothing was run"), "{}", answer.err);
    assert!(!folder.join("out").exists());
    for (vary, word) in
        [("run.end", "no `=`"), ("run.end=1:2", "three parts"), ("run.end=1 ms:2 m:3", "different units"), ("run.end=", "empty")]
    {
        let answer = again(&folder, &["--vary", vary]);
        assert!(answer.code == Some(2) && answer.err.contains(word), "{vary}: {}", answer.err);
    }
    let twice = again(&folder, &["--vary", "run.end=1,2", "--vary", "run.end=3"]);
    assert!(twice.code == Some(2) && twice.err.contains("varies twice"), "{}", twice.err);
    let unlike = again(&folder, &["--zip", "--vary", "run.end=1,2", "--vary", "run.safety=0.5"]);
    assert!(unlike.code == Some(2) && unlike.err.contains("has 1 values"), "{}", unlike.err);
}

#[test]
fn a_missing_output_is_reported_with_what_it_may_have_meant() {
    let (answer, _) = sweep(
        "sweep-output",
        &["--vary", "run.safety=0.5,0.6", "--output", "last(P.z)", "--output", "energy_drft", "--output", "at=1s(P.x)"],
    );
    assert_eq!(answer.code, Some(2));
    for word in ["did you mean `P.x`", "did you mean `energy_drift`", "the run ends at 0.0001 s"] {
        assert!(answer.err.contains(word), "{word} in\n{}", answer.err);
    }
}

#[test]
fn the_table_is_the_same_for_any_number_of_jobs() {
    let vary = ["--vary", "part.block.velocity[0]=1:40:40"];
    let tables: Vec<Vec<u8>> = ["1", "3"]
        .map(|jobs| {
            let (answer, folder) = sweep(&format!("sweep-jobs-{jobs}"), &[&vary[..], &["--jobs", jobs]].concat());
            assert_eq!(answer.code, Some(0), "{}", answer.err);
            fs::read(folder.join("out/sweep.csv")).unwrap()
        })
        .into();
    assert!(!tables[0].is_empty() && tables[0] == tables[1]);
}

#[test]
fn a_run_that_fails_is_a_row_and_the_others_continue() {
    // The second limit is longer than the first stable step.
    let (answer, folder) = sweep("sweep-failed", &["--vary", "run.step_limit=1e-12,9.9e-5,1e-11", "--output", "P.x"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert!(answer.err.contains("1 run of 3 failed; the first is run 2"), "{}", answer.err);
    let table = table(&folder);
    let status: Vec<&str> = table[1..].iter().map(|row| row[2].as_str()).collect();
    assert_eq!(status, ["done", "failed", "done"]);
    assert!(table[2][3].is_empty() && !table[2][4].is_empty(), "no figure, but a reason: {:?}", table[2]);
    assert_eq!(again(&folder, &["--vary", "run.step_limit=1e-12,9.9e-5,1e-11", "--output", "P.x"]).code, Some(1), "and is not forgotten");
}

#[test]
fn the_same_command_runs_nothing_twice_and_another_one_is_refused() {
    let vary = ["--vary", "run.safety=0.5,0.6,0.7"];
    let (_, folder) = sweep("sweep-again", &vary);
    let first = fs::read(folder.join("out/sweep.csv")).unwrap();
    let stamp = |run: &str| fs::metadata(folder.join("out").join(run).join("summary.json")).unwrap().modified().unwrap();
    let before = ["0001", "0002", "0003"].map(stamp);
    assert_eq!(again(&folder, &vary).code, Some(0));
    assert_eq!(before, ["0001", "0002", "0003"].map(stamp));
    // One run is lost: it alone is done again.
    fs::remove_file(folder.join("out/0002/summary.json")).unwrap();
    assert_eq!(again(&folder, &vary).code, Some(0));
    assert!(before[0] == stamp("0001") && before[1] != stamp("0002"));
    assert_eq!(fs::read(folder.join("out/sweep.csv")).unwrap(), first);
    // Another output needs no run.
    assert_eq!(
        again(&folder, &[&vary[..], &["--output", "max(P.x)", "--output", "state_hash", "--output", "energy_drift"]].concat()).code,
        Some(0)
    );
    assert!(before[0] == stamp("0001") && table(&folder)[0].contains(&"max(P.x)".to_string()));
    assert_eq!(again(&folder, &vary).code, Some(0));
    assert_eq!(fs::read(folder.join("out/sweep.csv")).unwrap(), first, "read back from the runs: the same bytes");

    let other = again(&folder, &["--vary", "run.safety=0.5,0.6,0.8"]);
    assert!(
        other.code == Some(2) && other.err.contains("values of 1 of 3 runs have changed") && other.err.contains("--force"),
        "{}",
        other.err
    );
    let fewer = again(&folder, &["--vary", "run.safety=0.5,0.7"]);
    assert!(fewer.code == Some(2) && fewer.err.contains("1 of its 3 runs are not among the 2"), "{}", fewer.err);
    fs::write(folder.join("flight.toml"), FLIGHT.replace("200 GPa", "201 GPa")).unwrap();
    let changed = again(&folder, &vary);
    assert!(changed.code == Some(2) && changed.err.contains("of 3 of 3 runs have changed"), "{}", changed.err);
    assert_eq!(again(&folder, &["--vary", "run.safety=0.5", "--force"]).code, Some(0));
    assert!(!folder.join("out/0002").exists(), "runs of the earlier sweep are gone");
}

#[test]
fn a_sweep_is_extended_by_further_points_and_runs_only_these() {
    let few = ["--vary", "part.block.velocity[0]=1:3:3"];
    let all = ["--vary", "part.block.velocity[0]=1:3:5"];
    let (_, fresh) = sweep("sweep-all", &all);
    let (_, folder) = sweep("sweep-few", &few);
    let stamp = |run: &str| fs::metadata(folder.join("out").join(run).join("summary.json")).unwrap().modified().unwrap();
    let before = ["0001", "0002", "0003"].map(stamp);
    // What lies about where a run will be is of no one.
    fs::create_dir(folder.join("out/0005")).unwrap();
    let answer = again(&folder, &all);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(before, ["0001", "0003", "0005"].map(stamp), "those that were there were not run again");
    let bytes = |folder: &Path, name: &str| fs::read(folder.join("out").join(name)).unwrap();
    assert_eq!(bytes(&folder, "sweep.csv"), bytes(&fresh, "sweep.csv"));
    for run in ["0001", "0002", "0003", "0004", "0005"] {
        assert_eq!(bytes(&folder, &format!("{run}/history.csv")), bytes(&fresh, &format!("{run}/history.csv")), "{run}");
    }
    assert!(fs::read_dir(folder.join("out")).unwrap().flatten().all(|entry| !entry.file_name().to_string_lossy().contains("moved")));
    // The same in another order, and again.
    let turned = ["--vary", "part.block.velocity[0]=3,2.5,2,1.5,1"];
    assert_eq!(again(&folder, &turned).code, Some(0));
    assert_eq!(before, ["0005", "0003", "0001"].map(stamp));
    assert_eq!(bytes(&folder, "0001/history.csv"), bytes(&fresh, "0005/history.csv"));
}

#[test]
fn a_sweep_that_was_killed_continues_where_it_was() {
    let vary = ["--vary", "part.block.velocity[0]=1:300:300", "--set", "run.end=1 ms"];
    let (whole, folder) = sweep("sweep-whole", &[&vary[..], &["--summary-only"]].concat());
    assert_eq!(whole.code, Some(0), "{}", whole.err);
    let wanted = fs::read(folder.join("out/sweep.csv")).unwrap();
    fs::remove_dir_all(folder.join("out")).unwrap();
    let arguments = [&["sweep", "flight.toml", "--out", "out", "--quiet", "--summary-only"][..], &vary].concat();
    let mut child = Command::new(env!("CARGO_BIN_EXE_embate")).args(&arguments).current_dir(&folder).stderr(Stdio::null()).spawn().unwrap();
    let journal = folder.join("out/sweep.journal");
    let lines = || fs::read(&journal).map_or(0, |text| text.iter().filter(|byte| **byte == b'\n').count());
    let begin = Instant::now();
    while lines() < 5 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let done = lines();
    assert!(done >= 5);
    // A line that was cut off does not count.
    let mut text = fs::read(&journal).unwrap();
    text.extend_from_slice(b"{\"run\":299,\"end\":\"done\",\"error\":\"\",\"ce");
    fs::write(&journal, text).unwrap();
    let rest = embate(&folder, ["sweep", "flight.toml", "--out", "out", "--summary-only"].iter().chain(&vary));
    assert_eq!(rest.code, Some(0), "{}", rest.err);
    assert!(done == 300 || rest.out.contains(&format!("from before  {done}\n")), "{done}: {}", rest.out);
    assert_eq!(fs::read(folder.join("out/sweep.csv")).unwrap(), wanted);
}

#[test]
#[cfg(unix)]
fn an_interrupted_sweep_keeps_its_rows() {
    let folder = fresh("sweep-interrupted");
    fs::write(folder.join("flight.toml"), FLIGHT).unwrap();
    let arguments =
        ["sweep", "flight.toml", "--out", "out", "--quiet", "--vary", "part.block.velocity[0]=1:300:300", "--set", "run.end=1 ms"];
    let child = Command::new(env!("CARGO_BIN_EXE_embate")).args(arguments).current_dir(&folder).stderr(Stdio::piped()).spawn().unwrap();
    let journal = folder.join("out/sweep.journal");
    let begin = Instant::now();
    while fs::metadata(&journal).map_or(0, |data| data.len()) == 0 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let rows = table(&folder).len() - 1;
    match output.status.code() {
        Some(130) => assert!(rows > 0 && String::from_utf8_lossy(&output.stderr).contains(&format!("{} of 300 runs left", 300 - rows))),
        code => assert_eq!((code, rows), (Some(0), 300), "it was faster than the signal"),
    }
}

#[test]
fn two_sweeps_never_write_into_one_folder() {
    let (_, folder) = sweep("sweep-busy", &["--vary", "run.safety=0.5"]);
    let journal = fs::File::open(folder.join("out/sweep.journal")).unwrap();
    journal.lock().unwrap();
    let answer = again(&folder, &["--vary", "run.safety=0.5"]);
    assert!(answer.code == Some(2) && answer.err.contains("another sweep is writing"), "{}", answer.err);
}

#[test]
fn frames_are_kept_where_they_are_wanted() {
    let (answer, folder) = sweep("sweep-frames", &["--vary", "run.safety=0.5", "--keep-frames"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(folder.join("out/0001/fields.pvd").is_file() && folder.join("out/0001/fields/frame-00004.vtu").is_file());
}
