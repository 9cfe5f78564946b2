//! What `docs/adding.md` says about a material and a field is true: their files and lines, put into a copy of
//! the solver, make a law with two variables that are output, and a field, which pass the contract tests.
//!
//! The copy lies in the target folder and is brought up to date by contents, so that only what has changed is
//! compiled again; it has a target folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Contract tests of laws and fields; the others have nothing to do with a new one.
const TESTS: &str = "#![allow(dead_code, unused_imports)]\nmod patches;\n\nmod blocks;\nmod fields;\nmod materials;\n";

/// What the page adds to a registry.
struct Added {
    /// The file with the registry, and the macro.
    registry: &'static str,
    list: &'static str,
    /// The new file and its contents.
    file: PathBuf,
    contents: String,
    line: String,
}

impl Added {
    /// The blocks of Rust in a section of the page: the file and the line, which begins with the name of the
    /// file.
    fn of(root: &Path, title: &str, registry: &'static str, list: &'static str) -> Self {
        let page = fs::read_to_string(root.join("docs/adding.md")).unwrap();
        let section = page.split("\n## ").find(|section| section.lines().next() == Some(title)).expect("the section");
        let blocks = section.split("```rust\n").skip(1).map(|rest| rest.split_once("```").expect("blocks end").0.to_string());
        let [contents, line]: [String; 2] = blocks.collect::<Vec<_>>().try_into().expect("two blocks: a file and a line");
        let line = line.trim().to_string();
        assert_eq!(line.lines().count(), 1, "{line}");
        let name = line.split([':', ';']).next().unwrap();
        let file = Path::new(registry).with_file_name(name).with_extension("rs");
        assert!(!root.join(&file).exists(), "{} is there already", file.display());
        Self { registry, list, file, contents, line }
    }

    /// The registry with the line.
    fn listed(&self, text: &str) -> String {
        let begin = format!("\n{} {{\n", self.list);
        let (before, rest) = text.split_once(&begin).expect("the registry");
        format!("{before}{begin}    {}\n{rest}", self.line)
    }
}

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

#[test]
#[ignore = "compiles the solver again: `.ci/run --long` runs it"]
fn one_file_and_one_line_add_a_law_and_a_field() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let copy = Path::new(env!("CARGO_TARGET_TMPDIR")).join("adding");
    let added = [
        Added::of(&root, "A material", "crates/solver/src/material/mod.rs", "laws!"),
        Added::of(&root, "A field", "crates/solver/src/field/mod.rs", "fields!"),
    ];

    let mut wanted: Vec<PathBuf> = added.iter().map(|added| added.file.clone()).collect();
    for from in ["crates/lanes", "crates/remesh", "crates/solver"].iter().flat_map(|crate_folder| files(&root.join(crate_folder))) {
        let path = from.strip_prefix(&root).unwrap().to_path_buf();
        let mut contents = fs::read(&from).unwrap();
        if let Some(added) = added.iter().find(|added| path == Path::new(added.registry)) {
            contents = added.listed(&String::from_utf8(contents).unwrap()).into_bytes();
        } else if path == Path::new("crates/solver/tests/all/main.rs") {
            contents = TESTS.into();
        }
        write(&copy.join(&path), &contents);
        wanted.push(path);
    }
    added.iter().for_each(|added| write(&copy.join(&added.file), added.contents.as_bytes()));
    for old in files(&copy.join("crates")) {
        if !wanted.iter().any(|path| copy.join(path) == old) {
            fs::remove_file(old).unwrap();
        }
    }
    let workspace = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let members = workspace.lines().filter(|line| !line.starts_with("default-members")).map(|line| {
        if line.starts_with("members") {
            "members = [\"crates/lanes\", \"crates/remesh\", \"crates/solver\"]\n".into()
        } else {
            format!("{line}\n")
        }
    });
    write(&copy.join("Cargo.toml"), members.collect::<String>().as_bytes());
    write(&copy.join("Cargo.lock"), &fs::read(root.join("Cargo.lock")).unwrap());

    // Of the law: its variables stand before it.
    let (_, law) = added[0].contents.split_once("LawKind {").expect("a law");
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
    let reported = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{reported}");
    let tests = [
        "materials::the_stiffness_at_rest",
        "blocks::a_distorted_patch",
        "blocks::the_stable_step_bounds",
        "fields::every_variable_of_a_law_is_output",
        "fields::every_field_has_a_value",
    ];
    for test in tests {
        assert!(reported.lines().any(|line| line.contains(test) && line.ends_with("ok")), "{test}: {reported}");
    }
}
