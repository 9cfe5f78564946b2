//! What `docs/adding.md` says about a material is true: its file and its line, put into a copy of the solver,
//! make a law that passes the contract tests.
//!
//! The copy lies in the target folder and is brought up to date by contents, so that only what has changed is
//! compiled again; it has a target folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Contract tests of laws; the others have nothing to do with a new one.
const TESTS: &str = "#![allow(dead_code, unused_imports)]\nmod patches;\n\nmod blocks;\nmod materials;\n";

fn write(path: &Path, contents: &[u8]) {
    if fs::read(path).ok().as_deref() != Some(contents) {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, contents).unwrap();
    }
}

/// Files below a folder, as paths within it.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect();
    all.sort();
    all
}

/// Blocks of Rust in the section about materials: the file and the line.
fn page(root: &Path) -> [String; 2] {
    let page = fs::read_to_string(root.join("docs/adding.md")).unwrap();
    let section = page.split("\n## ").find(|section| section.starts_with("A material\n")).expect("a section about materials");
    let blocks = section.split("```rust\n").skip(1).map(|rest| rest.split_once("```").expect("blocks end").0.to_string());
    blocks.collect::<Vec<_>>().try_into().expect("two blocks: a file and a line")
}

#[test]
#[ignore = "compiles the solver again: `.ci/run --long` runs it"]
fn one_file_and_one_line_add_a_law() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let copy = Path::new(env!("CARGO_TARGET_TMPDIR")).join("adding");
    let [law, line] = page(&root);
    let line = line.trim();
    assert_eq!(line.lines().count(), 1);
    let file = PathBuf::from(format!("crates/solver/src/material/{}.rs", line.split_once(':').unwrap().0));
    assert!(!root.join(&file).exists(), "it is there already");

    let mut wanted = vec![file.clone()];
    for from in ["crates/lanes", "crates/solver"].iter().flat_map(|crate_folder| files(&root.join(crate_folder))) {
        let path = from.strip_prefix(&root).unwrap().to_path_buf();
        let mut contents = fs::read(&from).unwrap();
        if path == Path::new("crates/solver/src/material/mod.rs") {
            let text = String::from_utf8(contents).unwrap();
            let (before, rest) = text.split_once("\nlaws! {\n").expect("the registry");
            contents = format!("{before}\nlaws! {{\n    {line}\n{rest}").into_bytes();
        } else if path == Path::new("crates/solver/tests/all/main.rs") {
            contents = TESTS.into();
        }
        write(&copy.join(&path), &contents);
        wanted.push(path);
    }
    write(&copy.join(&file), law.as_bytes());
    for old in files(&copy.join("crates")) {
        if !wanted.iter().any(|path| copy.join(path) == old) {
            fs::remove_file(old).unwrap();
        }
    }
    let workspace = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let members = workspace.lines().filter(|line| !line.starts_with("default-members")).map(|line| {
        if line.starts_with("members") { "members = [\"crates/lanes\", \"crates/solver\"]\n".into() } else { format!("{line}\n") }
    });
    write(&copy.join("Cargo.toml"), members.collect::<String>().as_bytes());
    write(&copy.join("Cargo.lock"), &fs::read(root.join("Cargo.lock")).unwrap());

    let name = law.split("name: \"").nth(1).and_then(|rest| rest.split('"').next()).expect("a name");
    let output = Command::new(env!("CARGO"))
        .args(["test", "--offline", "-p", "embate-solver", "--test", "all"])
        .current_dir(&copy)
        .env("CARGO_TARGET_DIR", copy.join("target"))
        .env("EMBATE_LAW", name)
        .envs(["DEV", "TEST"].map(|profile| (format!("CARGO_PROFILE_{profile}_OPT_LEVEL"), "0")))
        .envs(["DEV", "TEST"].map(|profile| (format!("CARGO_PROFILE_{profile}_DEBUG"), "0")))
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    for test in ["materials::the_stiffness_at_rest", "blocks::a_distorted_patch", "blocks::the_stable_step_bounds"] {
        assert!(told.lines().any(|line| line.contains(test) && line.ends_with("ok")), "{test}: {told}");
    }
}
