//! The catalogue of messages: complete, each code once, and provoked by its example. What is printed then is
//! kept in `tests/messages/`, one file for each area.

#[path = "../../src/messages.rs"]
mod own;

use crate::{embate, fresh, held, root};
use embate_files::messages::{self, markdown};
use embate_solver::message::{AREAS, BASE, Example, Message};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

fn catalogue() -> Vec<&'static Message> {
    let mut all = messages::all();
    all.extend(own::MESSAGES);
    all.sort_by_key(|message| message.code);
    all
}

/// Messages that no short input of the program provokes, and why; all others have examples that are run.
const IN_WORDS: &[(&str, &str)] = &[
    ("E0123", "only programs that make models themselves come to it: of a model file it is E0104, E0107 or E0110 before"),
    ("E0208", "of a model file such lines are no surface but a set of nodes; crates/solver/src/mesh/surface/plane.rs tests it"),
    ("E0301", "only programs that make models themselves come to it: of a model file it is E0107 before"),
    ("E0302", "only programs that make models themselves come to it: of a model file it is E0106 before"),
    ("E0603", "contact that makes energy is a fault of the solver rather than of a short model"),
    ("E0609", "only programs that change a simulation between its steps come to it"),
    ("E0611", "models that lose so much by remeshing are neither short nor sensible"),
    ("E0701", "it takes a disk that is full; restart.rs has one"),
    ("E0705", "only programs that write fields themselves come to it"),
    ("E0706", "only programs that draw frames themselves come to it"),
    ("E0710", "a state of another version comes with the header of that version, which is E0712"),
    ("E0731", "a field file is damaged by hand in the tests of the viewer, and the page tells of it, not the program"),
    ("E0733", "the page of the viewer tells of it, not the program"),
    ("E0799", "it is a bug by definition"),
    ("W0405", "of the random models of embate-soak a few come to it, and none of them is short"),
    ("W0406", "no model is known in which contact misses a node; locate.rs counts, and the tests of contact hold that there are none"),
    ("W0606", "only programs that change a simulation between its steps come to it"),
    ("W0617", "a part of which no mesh is found is far deformed, and its run not short"),
    ("W0618", "the same as of E0611, with less loss"),
    ("W0702", "it takes a disk that is full, or a folder that is gone while the run fails"),
    ("W0704", "it takes a disk that is full when the run ends"),
    ("W0712", "a disk that is full, or a run that fails earlier the second time, which the same bits forbid"),
    ("W0713", "it takes a disk that is full while a run of more than five seconds keeps a checkpoint"),
];

#[test]
fn examples_in_words_are_those_that_no_input_provokes() {
    let words: Vec<&str> = catalogue().iter().filter(|it| matches!(it.example, Example::Words(_))).map(|it| it.code).collect();
    let reasons: Vec<&str> = IN_WORDS.iter().map(|(code, _)| *code).collect();
    assert_eq!(words, reasons, "make an example that a test runs, or say why there is none");
    assert!(IN_WORDS.iter().all(|(_, reason)| reason.len() > 15));
}

/// Texts of all files of source below a folder.
fn sources(folder: &Path, texts: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            sources(&entry, texts);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            texts.push(fs::read_to_string(entry).unwrap());
        }
    }
}

#[test]
fn every_entry_in_the_source_is_in_the_catalogue_and_no_code_is_used_twice() {
    let codes: Vec<&str> = catalogue().iter().map(|message| message.code).collect();
    let mut texts = Vec::new();
    ["solver", "files", "cli"].iter().for_each(|name| sources(&root().join("crates").join(name).join("src"), &mut texts));
    let mut written: Vec<&str> =
        texts.iter().flat_map(|text| text.split("    code: \"").skip(1)).filter_map(|rest| rest.split('"').next()).collect();
    written.sort_unstable();
    assert_eq!(codes, written, "an entry is in no MESSAGES list, or in two; or two entries have one code");
    assert_eq!(codes.iter().collect::<BTreeSet<_>>().len(), codes.len(), "a code is used twice: {codes:?}");
}

#[test]
fn codes_have_an_area_and_entries_have_texts() {
    for message in catalogue() {
        let (letter, digits) = message.code.split_at(1);
        assert!(matches!(letter, "E" | "W") && digits.len() == 4 && digits.bytes().all(|digit| digit.is_ascii_digit()), "{}", message.code);
        assert!(AREAS.iter().any(|(area, _)| digits.starts_with(area)), "{} belongs to no area", message.code);
        for text in [message.cause, message.remedy] {
            assert!(text.starts_with(|first: char| !first.is_lowercase()) && text.len() > 10, "{}: {text}", message.code);
        }
        assert!(!message.title.ends_with('.') && message.title.len() < 100, "{}: {}", message.code, message.title);
    }
}

#[test]
fn the_page_is_made_from_the_catalogue() {
    held(&root().join("docs/messages.md"), &markdown(&catalogue()));
}

#[test]
#[cfg_attr(
    not(target_os = "linux"),
    ignore = "lines of a shell call flock, truncate and sed as Linux has them, and the system's own words are kept"
)]
fn every_example_provokes_its_message() {
    let mut wrong = String::new();
    for (digits, area) in AREAS {
        let mut said = format!("{area}: what the program says to the examples of docs/messages.md. Made by the test `messages`.\n");
        for message in catalogue().iter().filter(|message| message.code.get(1..3) == Some(digits)) {
            let Some(text) = provoked(message) else { continue };
            if !text.contains(&format!("{message}: ")) {
                wrong.push_str(&format!("--- {} is not what comes of its example, but\n{text}\n", message.code));
            }
            said.push_str(&format!("\n=== {}\n{text}", message.code));
        }
        if wrong.is_empty() {
            held(&root().join(format!("crates/cli/tests/messages/{digits}.txt")), &said);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// What the program says to an example on standard error; `None` where there are words only.
fn provoked(message: &Message) -> Option<String> {
    let folder = fresh(&format!("message-{}", message.code));
    let (mut model, mut arguments) = (BASE.to_string(), "run model.toml --out out --threads 1".to_string());
    match message.example {
        Example::Model(lines) => model = merged(BASE, lines),
        Example::File(text) => model = text.to_string(),
        Example::Gmsh(mesh) => {
            fs::write(folder.join("mesh.msh"), mesh).unwrap();
            let part = "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nmesh = { file = \"mesh.msh\", group = \"block\" }\n";
            model = merged(BASE, &format!("{part}\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n"));
        }
        Example::Deck(deck) => {
            fs::write(folder.join("deck.inp"), deck).unwrap();
            arguments = "import deck.inp --out imported".to_string();
        }
        Example::Command(line) => arguments = line.to_string(),
        Example::Shell(lines) => {
            fs::write(folder.join("model.toml"), model).unwrap();
            return script(&folder, lines);
        }
        Example::Words(_) => return None,
    }
    fs::write(folder.join("model.toml"), model).unwrap();
    Some(reported(&embate(&folder, arguments.split_whitespace()).err))
}

/// What lines of a shell print on standard error; only the last may fail.
fn script(folder: &Path, lines: &str) -> Option<String> {
    let program = Path::new(env!("CARGO_BIN_EXE_embate")).parent().unwrap();
    let path = std::env::join_paths([program.to_path_buf()].into_iter().chain(std::env::split_paths(&std::env::var_os("PATH")?))).unwrap();
    let output = Command::new("sh").args(["-e", "-c", lines]).env("PATH", path).current_dir(folder).output().unwrap();
    Some(reported(&String::from_utf8(output.stderr).unwrap()))
}

/// The messages of a run: without its progress, and without what the machine has.
fn reported(err: &str) -> String {
    let progress = |line: &&str| line.trim_start().split_once(" %  ").is_some_and(|(share, _)| share.parse::<u32>().is_ok());
    // What the machine has is no part of the message.
    let reported = |line: &str| line.split("this machine has").next().map_or(String::new(), |start| format!("{}\n", start.trim_end()));
    err.lines().filter(|line| !progress(line)).map(reported).collect()
}

/// The sections of a text, each with its header; what stands above all has an empty one.
fn sections(text: &str) -> Vec<(String, Vec<&str>)> {
    let mut sections: Vec<(String, Vec<&str>)> = vec![(String::new(), Vec::new())];
    for line in text.lines().filter(|line| !line.is_empty()) {
        if line.starts_with('[') {
            sections.push((line.to_string(), Vec::new()));
        } else if let Some((_, lines)) = sections.last_mut() {
            lines.push(line);
        }
    }
    sections
}

/// A model in which lines take the place of those that it has: keys of a table, all tables of a list.
fn merged(model: &str, lines: &str) -> String {
    let key = |line: &str| line.split_once('=').map(|(key, _)| key.trim().to_string());
    let (mut all, new) = (sections(model), sections(lines));
    all.retain(|(header, _)| !(header.starts_with("[[") && new.iter().any(|(other, _)| other == header)));
    for (header, lines) in new {
        match all.iter_mut().find(|(other, _)| *other == header && !header.starts_with("[[")) {
            Some((_, kept)) => {
                kept.retain(|line| !lines.iter().any(|new| key(new) == key(line)));
                kept.extend(lines);
            }
            None => all.push((header, lines)),
        }
    }
    all.iter().map(|(header, lines)| format!("{header}\n{}\n", lines.join("\n"))).collect()
}

#[test]
fn explain_prints_an_entry_and_lists_all() {
    let folder = fresh("explain");
    let one = embate(&folder, ["explain", "e0110"]);
    assert_eq!(one.code, Some(0));
    assert!(one.out.starts_with("E0110\n") && one.out.contains("safety = 1.5") && one.out.contains("What to do:"), "{}", one.out);
    let all = embate(&folder, ["explain"]);
    assert!(catalogue().iter().all(|message| all.out.contains(message.code) && all.out.contains(message.title)), "{}", all.out);
    let none = embate(&folder, ["explain", "E0119x"]);
    assert!(none.code == Some(2) && none.err.contains("error[E0804]") && none.err.contains("did you mean E0119?"), "{}", none.err);
}

#[test]
fn of_each_code_twenty_messages_are_shown_and_the_rest_is_counted() {
    let folder = fresh("many-messages");
    let keys: String = (0..57).map(|k| format!("wrong_{k} = 1\n")).collect();
    fs::write(folder.join("model.toml"), format!("{BASE}{keys}")).unwrap();
    let answer = embate(&folder, ["check", "model.toml"]);
    assert_eq!(answer.err.matches("error[E0106]").count(), 20);
    assert!(answer.err.contains("\nand 37 more of E0106\n57 faults: nothing was run\n"), "{}", answer.err);
}

#[test]
fn what_is_seen_on_the_way_is_reported_once_and_counted_in_the_summary() {
    let folder = fresh("seen-on-the-way");
    let springs = catalogue().into_iter().find(|message| message.code == "W0612").unwrap();
    let Example::Model(lines) = springs.example else { panic!("its example is a model") };
    fs::write(folder.join("model.toml"), merged(BASE, lines)).unwrap();
    let answer = embate(&folder, ["run", "model.toml", "--out", "out"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(answer.err.matches("warning[W0612]").count(), 1, "{}", answer.err);
    assert!(answer.err.find("warning[W0612]").unwrap() < answer.err.find(" 90 %").unwrap(), "told while it runs: {}", answer.err);
    let summary: serde_json::Value = serde_json::from_str(&fs::read_to_string(folder.join("out/summary.json")).unwrap()).unwrap();
    let warnings: Vec<&str> = summary["warnings"].as_array().unwrap().iter().map(|text| text.as_str().unwrap()).collect();
    assert!(
        matches!(warnings[..], [text] if text.starts_with("W0612: ") && text.contains("contact \"hit\"") && text.ends_with("% at most")),
        "{warnings:?}"
    );
}

#[test]
fn of_a_run_in_which_all_is_well_nothing_is_reported() {
    let folder = fresh("all-is-well");
    fs::write(folder.join("model.toml"), BASE).unwrap();
    let answer = embate(&folder, ["run", "model.toml", "--out", "out"]);
    assert!(answer.code == Some(0) && !answer.err.contains("warning"), "{}", answer.err);
}
