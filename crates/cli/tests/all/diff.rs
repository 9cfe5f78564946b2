//! `embate diff`: it names the step, part and node at which two runs diverge. Cases whose answer is known
//! without it, and the answer by brute force: logs of every step.

use crate::{Answer, embate, fresh};
use std::fs;
use std::path::Path;

/// Two blocks apart from each other; from 12.34 µs on a force pulls at the right side of the second. Steps
/// are given: step n is at n times 0.1 µs.
const PULLED: &str = r#"
run = { end = "1 ms", max_steps = 330, time_step = "0.1 µs" }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [
    { name = "still", material = "steel", rectangle = { corner = [0, 0], size = ["40 mm", "20 mm"], elements = [4, 2] }, velocity = [0, 1] },
    { name = "pulled", material = "steel", rectangle = { corner = ["0.1 m", 0], size = ["40 mm", "20 mm"], elements = [4, 2] } },
]
curve.later = { time = [0, "12.34 µs", "20 µs", 1], value = [0, 0, 1, 1] }
load = [{ on = "pulled.right", force = ["1 kN/m", 0], curve = "later" }]
output = { fields = 1, history = 10, pictures = false, hash_steps = 50 }
"#;

/// A block that is thrown onto a floor and at another block.
const THROWN: &str = r#"
run = { end = "0.3 ms" }
material.metal = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "300 MPa", hardening = "1 GPa" }
part = [
    { name = "thrown", material = "metal", rectangle = { corner = [0, "0.1 mm"], size = ["20 mm", "20 mm"], elements = [12, 12] }, velocity = [60, -120] },
    { name = "hit", material = "metal", rectangle = { corner = ["22 mm", "0.05 mm"], size = ["10 mm", "25 mm"], elements = [6, 15] } },
]
contact = [{ name = "all", bodies = "all", friction = 0.2 }]
obstacle = [{ name = "floor", plane = { point = [0, 0], normal = [0, 1] }, friction = 0.3 }]
output = { fields = 1, history = 10, pictures = false }
"#;

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

fn run<'a>(folder: &Path, model: &'a str, out: &'a str, more: impl IntoIterator<Item = &'a str>) {
    let answer = embate(folder, ["run", model, "--quiet", "--force", "--out", out].into_iter().chain(more));
    assert_eq!(answer.code, Some(0), "{}", answer.err);
}

fn diff<'a>(folder: &Path, code: i32, more: impl IntoIterator<Item = &'a str>) -> Answer {
    let answer = embate(folder, ["diff", "a", "b"].into_iter().chain(more));
    assert_eq!(answer.code, Some(code), "{}{}", answer.out, answer.err);
    answer
}

/// The text between two others.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let from = text.find(before).unwrap_or_else(|| panic!("no \"{before}\" in {text}")) + before.len();
    &text[from..from + text[from..].find(after).unwrap()]
}

#[test]
fn runs_with_other_threads_and_instruction_sets_are_the_same() {
    let folder = fresh("diff-same");
    // Large enough for more than one thread.
    write(&folder, "model.toml", &THROWN.replace("[12, 12]", "[60, 60]").replace("[6, 15]", "[30, 40]"));
    let keys = ["--set", "run.max_steps=40", "--set", "output.hash_steps=7"];
    run(&folder, "model.toml", "a", keys.into_iter().chain(["--threads=1"]));
    run(&folder, "model.toml", "b", keys.into_iter().chain(["--threads=2", "--simd", "scalar"]));
    let answer = diff(&folder, 0, []);
    for text in
        ["the models are the same", "the same in all 7 lines that both have, the last at step 40", "the runs are the same; last state"]
    {
        assert!(answer.out.contains(text), "{}", answer.out);
    }
    assert!(answer.out.contains("2 threads, scalar"), "{}", answer.out);
    let [a, b] = ["a", "b"].map(|out| fs::read(folder.join(out).join("hashes.csv")).unwrap());
    assert!(a == b);
}

#[test]
fn a_load_that_begins_later_parts_the_runs_where_and_when_it_begins() {
    let folder = fresh("diff-load");
    write(&folder, "a.toml", PULLED);
    write(&folder, "b.toml", &PULLED.replace("1 kN/m", "2 kN/m"));
    run(&folder, "a.toml", "a", []);
    run(&folder, "b.toml", "b", []);
    let answer = diff(&folder, 1, []);
    // A load means the update, from half a step before to half a step after: the first that sees it is that
    // around 12.3 µs. The right side has three of 5 times 3 nodes, the lowest is the fifth.
    for text in [
        "load[0].force[0]: A has 1000.0, B has 2000.0",
        "the same at step 100 (1.000000e-5 s), not at step 150",
        "the runs diverge at step 123, t = 1.2",
        "part \"pulled\": 3 of 15 nodes differ",
        "the first is node 4 of the part (node 19 of the fields) at (1.400000e-1, 0.000000e0) m",
        "farthest apart is node 9 of the part",
    ] {
        assert!(answer.out.contains(text), "{text}: {}", answer.out);
    }
    assert!(!answer.out.contains("\"still\""), "{}", answer.out);
    // A quarter of the force, at rest until then: v = ¼ F c(t) dt / m.
    let line = answer.out.lines().find(|line| line.trim_start().starts_with("velocity x")).unwrap();
    let [a, b] = [2, 3].map(|column| line.split_whitespace().nth(column).unwrap().parse::<f64>().unwrap());
    assert!(a > 0.0 && (b / a - 2.0).abs() < 1e-12, "{line}");
}

#[test]
fn a_velocity_that_is_another_by_one_ulp_parts_the_runs_at_the_start() {
    let folder = fresh("diff-ulp");
    write(&folder, "a.toml", PULLED);
    write(&folder, "b.toml", &PULLED.replace("velocity = [0, 1]", "velocity = [0, 1.0000000000000002]"));
    run(&folder, "a.toml", "a", []);
    run(&folder, "b.toml", "b", []);
    let answer = diff(&folder, 1, []);
    for text in [
        "logs: not the same from step 0 (0.000000e0 s) on: part \"still\"",
        "the runs diverge at step 0, t = 0e0 s",
        "part \"still\": 15 of 15 nodes differ",
        "the first is node 0 of the part",
    ] {
        assert!(answer.out.contains(text), "{text}: {}", answer.out);
    }
    let line = answer.out.lines().find(|line| line.trim_start().starts_with("velocity y")).unwrap();
    assert_eq!(line.split_whitespace().skip(2).collect::<Vec<_>>(), ["1e0", "1.0000000000000002e0", "1", "ulp"]);
    assert!(!answer.out.contains("\"pulled\""), "{}", answer.out);
}

#[test]
fn the_answer_is_that_of_logs_of_every_step() {
    let folder = fresh("diff-brute");
    write(&folder, "a.toml", THROWN);
    for (name, change) in
        [("friction", ("friction = 0.2", "friction = 0.21")), ("yield", ("yield = \"300 MPa\"", "yield = \"300.00000000000006 MPa\""))]
    {
        write(&folder, "b.toml", &THROWN.replace(change.0, change.1));
        for out in ["a", "b"] {
            run(&folder, &format!("{out}.toml"), out, ["--set", "output.hash_steps=1"]);
        }
        let answer = diff(&folder, 1, ["--logs"]);
        let brute = between(&answer.out, "not at step ", " ").to_string();
        let parts: Vec<&str> = ["thrown", "hit"].into_iter().filter(|part| answer.out.contains(&format!("part \"{part}\""))).collect();
        let step: u64 = brute.parse().unwrap();
        assert!(step > 3 && !parts.is_empty(), "{name}: {}", answer.out);
        // From the start, and from a checkpoint before it.
        for keys in [
            vec!["--set", "output.hash_steps=60"],
            vec!["--set", "output.hash_steps=64", "--set", "run.checkpoint_steps=9", "--set", "run.max_steps=25"],
        ] {
            for out in ["a", "b"] {
                run(&folder, &format!("{out}.toml"), out, keys.iter().copied());
                if keys.len() > 2 {
                    let until = ["resume", out, "--quiet", "--set", "run.max_steps=1000000", "--set", "run.checkpoint_steps=1000000"];
                    assert_eq!(embate(&folder, until).code, Some(0));
                }
            }
            let answer = diff(&folder, 1, []);
            assert_eq!(between(&answer.out, "the runs diverge at step ", ","), brute, "{name}: {}", answer.out);
            for part in ["thrown", "hit"] {
                assert_eq!(answer.out.contains(&format!("\npart \"{part}\": ")), parts.contains(&part), "{name}: {}", answer.out);
            }
            assert!(!answer.out.contains("does not come to"), "{}", answer.out);
            // A stretch that begins at 64 is reached from the checkpoints of steps 9 and 18.
            let is_from_checkpoint = answer.out.contains("A from step 18, B from step 18");
            assert_eq!(is_from_checkpoint, step > 64 && keys.len() > 2, "{}", answer.out);
        }
    }
}

#[test]
fn a_run_that_went_on_is_the_same_and_a_shorter_one_is_reported() {
    let folder = fresh("diff-resumed");
    write(&folder, "model.toml", THROWN);
    run(&folder, "model.toml", "a", []);
    run(&folder, "model.toml", "b", ["--set", "run.max_steps=250", "--set", "run.checkpoint_steps=70"]);
    let answer = diff(&folder, 1, []);
    for text in ["run.max_steps: A has None, B has 250", "not equally long", "both are the same until step 250"] {
        assert!(answer.out.contains(text), "{text}: {}", answer.out);
    }
    let answer = embate(&folder, ["resume", "b", "--quiet", "--set", "run.max_steps=1000000"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    diff(&folder, 0, []);
}

#[test]
fn damaged_and_missing_logs_are_reported_with_what_to_do() {
    let folder = fresh("diff-damaged");
    write(&folder, "model.toml", PULLED);
    run(&folder, "model.toml", "a", []);
    run(&folder, "model.toml", "b", ["--set", "output.hash_steps=0"]);
    // Only one has a log: the ends are compared.
    let answer = diff(&folder, 0, []);
    assert!(answer.out.contains("the last states are the same") && answer.out.contains("hash_steps"), "{}", answer.out);
    run(&folder, "model.toml", "b", ["--set", "output.hash_steps=0", "--set", "load[0].force=[\"2 kN/m\", 0]"]);
    let answer = diff(&folder, 1, []);
    assert!(answer.out.contains("the last states differ") && answer.out.contains("--whole"), "{}", answer.out);
    let answer = diff(&folder, 1, ["--whole"]);
    assert!(answer.out.contains("the runs diverge at step 123,"), "{}", answer.out);

    let log = folder.join("a/hashes.csv");
    let text = fs::read_to_string(&log).unwrap();
    let line = text.lines().nth(3).unwrap();
    write(&folder, "a/hashes.csv", &text.replace(line, &line.replacen(|digit: char| digit.is_ascii_digit(), "8", 9)));
    let answer = diff(&folder, 2, []);
    for word in ["error[E0721]", "a/hashes.csv, line 4", "check sum", "put the file back from a copy"] {
        assert!(answer.err.contains(word), "{}", answer.err);
    }
    // Neither end nor log, nor a folder.
    fs::remove_file(log).unwrap();
    fs::remove_file(folder.join("a/summary.json")).unwrap();
    let answer = diff(&folder, 2, []);
    assert!(answer.err.contains("error[E0811]") && answer.err.contains("help:"), "{}", answer.err);
    let answer = embate(&folder, ["diff", "none", "b"]);
    assert!(answer.code == Some(2) && answer.err.contains("error[E0811]: none"), "{}", answer.err);
}

#[test]
fn a_model_that_has_changed_since_is_reported_and_another_place_helps() {
    let folder = fresh("diff-changed");
    write(&folder, "model.toml", PULLED);
    write(&folder, "as-it-was.toml", PULLED);
    run(&folder, "model.toml", "a", []);
    write(&folder, "model.toml", &PULLED.replace("1 kN/m", "2 kN/m"));
    run(&folder, "model.toml", "b", []);
    let answer = diff(&folder, 1, []);
    assert!(answer.out.contains("A has 1000.0, B has 2000.0") && answer.out.contains("not at step 150"), "{}", answer.out);
    for text in ["warning[W0811]: the model of run A is no longer", "load[0].force[0]: was 1000.0, is 2000.0", "--model-a PATH"] {
        assert!(answer.err.contains(text), "{}", answer.err);
    }
    let answer = diff(&folder, 1, ["--model-a", "as-it-was.toml"]);
    assert!(answer.out.contains("the runs diverge at step 123,") && answer.err.is_empty(), "{}{}", answer.out, answer.err);
}

/// CRC32 of the lines of `hashes.csv`, bit by bit.
fn crc(text: &str) -> u32 {
    let of_bit = |crc: u32, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1));
    !text.bytes().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(byte), of_bit))
}

#[test]
fn a_log_that_can_t_be_repeated_is_reported_with_its_run() {
    let folder = fresh("diff-unlike");
    write(&folder, "model.toml", PULLED);
    run(&folder, "model.toml", "a", []);
    run(&folder, "model.toml", "b", []);
    // As if something had disturbed run B after step 150.
    let text = fs::read_to_string(folder.join("b/hashes.csv")).unwrap();
    let mut step = 0;
    let disturbed = |line: &str| {
        step += 1;
        if step < 6 {
            return format!("{line}\n");
        }
        let (values, _) = line.rsplit_once(',').unwrap();
        let values = format!("{},0123456789abcdef,", values.rsplit_once(',').unwrap().0);
        format!("{values}{:08x}\n", crc(&values))
    };
    let lines: String = text.lines().map(disturbed).collect();
    write(&folder, "b/hashes.csv", &lines);
    let answer = diff(&folder, 1, []);
    for text in [
        "the same at step 150 (1.500000e-5 s), not at step 200",
        "both are the same until step 200",
        "run B does not come to what its log says of step 200",
    ] {
        assert!(answer.out.contains(text), "{text}: {}", answer.out);
    }
    assert!(!answer.out.contains("run A does not"), "{}", answer.out);
}

#[test]
fn other_meshes_are_left_out_and_nothing_in_common_is_refused() {
    let folder = fresh("diff-mesh");
    write(&folder, "a.toml", PULLED);
    run(&folder, "a.toml", "a", []);
    // As many nodes, other elements.
    write(&folder, "b.toml", &PULLED.replacen("elements = [4, 2]", "elements = [2, 4]", 1).replace("1 kN/m", "2 kN/m"));
    run(&folder, "b.toml", "b", []);
    let answer = diff(&folder, 1, []);
    let text = "not compared: part \"still\" has another mesh: as many nodes, but other elements";
    assert!(answer.out.contains(text), "{}", answer.out);
    // One more part, far from the others: all that both have is the same, and the hashes of their parts are,
    // too.
    let more = r#"    { name = "new", material = "steel", rectangle = { corner = ["0.05 m", 0], size = ["10 mm", "10 mm"], elements = [7, 5] }, velocity = [0, 3] },"#;
    write(&folder, "b.toml", &PULLED.replace("part = [\n", &format!("part = [\n{more}\n")));
    run(&folder, "b.toml", "b", []);
    let answer = diff(&folder, 1, []);
    for text in [
        "logs: the same in all 8 lines that both have",
        "the last states differ",
        "not compared: part \"new\" is in the second run only",
        "both are the same until step 330",
    ] {
        assert!(answer.out.contains(text), "{text}: {}", answer.out);
    }
    write(&folder, "b.toml", &PULLED.replace("elements = [4, 2]", "elements = [3, 2]"));
    run(&folder, "b.toml", "b", []);
    let answer = diff(&folder, 2, []);
    for text in ["error[E0812]", "part \"pulled\" has another mesh: 15 nodes, and 12"] {
        assert!(answer.err.contains(text), "{text}: {}", answer.err);
    }
}
