//! The program as a user meets it: what it prints, which files it leaves, which exit code it gives.
#![allow(clippy::unwrap_used)]

mod bench;
mod command_line;
mod determinism;
mod diff;
mod estimates;
mod examples;
mod far;
mod fit;
mod hashes;
mod kept;
#[cfg(unix)]
mod links;
mod lock;
mod mesh;
mod messages;
mod outside;
mod packaging;
mod post_mortem;
mod remesh;
mod report;
mod restart;
mod sweep;
mod verification;
mod view;
mod unsafe_code;
mod warnings;
mod whole_runs;

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A block that flies for a tenth of a millisecond: where it is then, and its energy, are known.
const FLIGHT: &str = r#"
run.end = "0.1 ms"
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [{ name = "block", material = "steel", rectangle = { corner = [0, 0], size = ["10 mm", "10 mm"], elements = [2, 2] }, velocity = [1, 0] }]
probe = [{ name = "P", set = "block" }]
output = { fields = 4, history = 20, pictures = false }
"#;

/// A folder of one test alone, empty.
fn fresh(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// What the program did.
struct Answer {
    code: Option<i32>,
    out: String,
    err: String,
}

/// Calls the program in `folder`.
fn embate(folder: &Path, arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Answer {
    let output = Command::new(env!("CARGO_BIN_EXE_embate")).args(arguments).current_dir(folder).output().unwrap();
    Answer { code: output.status.code(), out: String::from_utf8(output.stdout).unwrap(), err: String::from_utf8(output.stderr).unwrap() }
}

/// The repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Compares with what is kept, or keeps it.
fn held(path: &Path, text: &str) {
    if std::env::var_os("EMBATE_BLESS").is_some() {
        fs::write(path, text).unwrap();
    }
    let kept = fs::read_to_string(path).unwrap_or_default();
    let differs =
        kept.lines().zip(text.lines()).position(|(kept, now)| kept != now).unwrap_or(kept.lines().count().min(text.lines().count()));
    let line = |text: &str| text.lines().nth(differs).unwrap_or_default().to_string();
    assert!(
        kept == text,
        "{} is not what the program says, from line {} on: run this test with EMBATE_BLESS=1 and look at it\n kept: {}\n  now: {}",
        path.display(),
        differs + 1,
        line(&kept),
        line(text)
    );
}
