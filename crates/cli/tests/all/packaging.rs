//! What goes with the program: its version, completions for shells, pages of the manual, and the book's page
//! of the command line.

use crate::{embate, fresh, held, root};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// The commands, from the help of the program; without `help`, which repeats the others.
fn commands() -> Vec<String> {
    let help = embate(Path::new(env!("CARGO_TARGET_TMPDIR")), ["--help"]).out;
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names = listed.filter_map(|line| line.split_whitespace().next().map(ToString::to_string));
    names.filter(|name| name != "help").collect()
}

fn help(arguments: &[&str]) -> String {
    let answer = embate(Path::new(env!("CARGO_TARGET_TMPDIR")), arguments.iter().copied().chain(["--help"]));
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    // Lines of options end with blanks where a text of several paragraphs is empty.
    answer.out.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

#[test]
fn the_page_of_the_command_line_is_what_help_prints() {
    let mut page = String::from(
        "# The command line\n\n\
         All commands with their arguments and options, as `embate COMMAND --help` prints them. This page is made from the program (`EMBATE_BLESS=1 cargo test -p embate --test all packaging`).\n\n\
         A command ends with 0 when all is well, with 1 when a run failed or two runs differ, with 2 when the input or the command line is at fault (nothing was done then), with 3 when a deck was imported but not all of it acts, and with 130 when\n\
         it was stopped by Ctrl-C or SIGTERM. What went wrong is told on standard error, with a code ([messages](messages.md)).\n",
    );
    page.push_str(&format!("\n## embate\n\n```text\n{}```\n", help(&[])));
    for name in commands() {
        page.push_str(&format!("\n## embate {name}\n\n```text\n{}```\n", help(&[&name])));
    }
    held(&root().join("docs/command-line.md"), &page);
}

#[test]
fn the_version_has_the_commit_and_the_target() {
    let folder = fresh("version");
    let short = embate(&folder, ["-V"]).out;
    let long = embate(&folder, ["--version"]).out;
    let own = concat!("embate ", env!("CARGO_PKG_VERSION"));
    let commit = short.trim_end().strip_prefix(own).unwrap();
    // Sources that were unpacked without their history know no commit.
    if !commit.is_empty() {
        let (hash, day) = commit.trim().strip_prefix('(').unwrap().strip_suffix(')').unwrap().split_at(12);
        assert!(hash.bytes().all(|digit| digit.is_ascii_hexdigit()), "{short}");
        assert!(day.is_empty() || day.len() == " 2026-01-31".len(), "{short}");
    }
    assert!(long.starts_with(short.trim_end()), "{long}");
    assert!(long.lines().nth(1).unwrap().contains(std::env::consts::ARCH), "{long}");
}

#[test]
fn results_have_the_commit_and_it_makes_no_difference() {
    let folder = fresh("commit");
    fs::write(folder.join("model.toml"), crate::FLIGHT).unwrap();
    for out in ["a", "b"] {
        assert_eq!(embate(&folder, ["run", "model.toml", "--quiet", "--out", out]).code, Some(0));
    }
    let version = embate(&folder, ["-V"]).out;
    for name in ["a/run.json", "a/summary.json"] {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        let commit = value.get("commit").map(|commit| format!(" ({})", commit.as_str().unwrap())).unwrap_or_default();
        assert_eq!(version.trim_end(), format!("embate {}{commit}", value["version"].as_str().unwrap()), "{name}");
        // As if another commit had made it.
        fs::write(folder.join(name), text.replace("\"commit\": \"", "\"commit\": \"0")).unwrap();
    }
    let answer = embate(&folder, ["diff", "a", "b"]);
    assert!(answer.code == Some(0) && answer.out.contains("the models are the same\n"), "{}{}", answer.out, answer.err);
    assert_eq!(embate(&folder, ["report", "a"]).code, Some(0));
}

#[test]
fn completions_know_all_commands() {
    let folder = fresh("completions");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let answer = embate(&folder, ["completions", shell]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        for name in commands() {
            assert!(answer.out.contains(&name), "{shell}: {name} is missing");
        }
        assert!(answer.out.contains("allow-outside"), "{shell}: options are missing");
        if shell == "bash" && cfg!(unix) {
            parses_in_bash(&answer.out);
        }
    }
    assert_eq!(embate(&folder, ["completions", "tcsh"]).code, Some(2));
}

/// Lets bash read a script without running it; where there is no bash, no one completes with it.
fn parses_in_bash(script: &str) {
    let Ok(mut bash) = Command::new("bash").args(["-n", "-"]).stdin(Stdio::piped()).spawn() else { return };
    bash.stdin.take().unwrap().write_all(script.as_bytes()).unwrap();
    assert!(bash.wait().unwrap().success());
}

#[test]
fn the_manual_has_a_page_for_each_command() {
    let folder = fresh("man");
    let answer = embate(&folder, ["man", "--out", "pages/man1"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let mut expected: Vec<String> = commands().iter().map(|name| format!("embate-{name}.1")).collect();
    expected.push("embate.1".into());
    expected.sort();
    let mut found: Vec<String> =
        fs::read_dir(folder.join("pages/man1")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    found.sort();
    assert_eq!(found, expected);
    for name in found {
        let text = fs::read_to_string(folder.join("pages/man1").join(&name)).unwrap();
        assert!(text.contains(".SH NAME") && text.contains(".SH SYNOPSIS") && text.contains(".SH OPTIONS"), "{name}: {text}");
    }
    let main = fs::read_to_string(folder.join("pages/man1/embate.1")).unwrap();
    assert_eq!(embate(&folder, ["man"]).out, main);
    // Pages are the same wherever the program was compiled.
    assert!(!main.contains(std::env::consts::ARCH), "{main}");
    let run = fs::read_to_string(folder.join("pages/man1/embate-run.1")).unwrap();
    assert!(run.contains("allow\\-outside") && run.contains("embate run"), "{run}");
}
