//! Notes the commit that the program is built from: of the repository, or of the package that was made from
//! one. Where neither reports, the program has its version alone.
//!
//! What is watched changes with each commit and no more often: a build after which nothing was committed
//! compiles nothing again.

use std::path::Path;
use std::process::Command;

/// Digits of a commit that are shown.
const DIGITS: usize = 12;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // Cargo leaves out links to where the sources are; the package is where this script runs.
    let commit = of_package().or_else(of_repository).unwrap_or_default();
    println!("cargo::rustc-env=EMBATE_COMMIT={commit}");
    let target = std::env::var("TARGET").unwrap_or_default();
    let linked = std::env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    let is_static = linked.split(',').any(|feature| feature == "crt-static");
    println!("cargo::rustc-env=EMBATE_TARGET={target}{}", if is_static { ", linked statically" } else { "" });
}

/// What `cargo package` has noted.
fn of_package() -> Option<String> {
    let path = Path::new(".cargo_vcs_info.json");
    if !path.exists() {
        return None;
    }
    println!("cargo::rerun-if-changed={}", path.display());
    let text = std::fs::read_to_string(path).ok()?;
    let hash = text.split("\"sha1\"").nth(1)?.split('"').nth(1)?;
    shown(hash, "")
}

/// What git says, if these sources are where they are in the repository of embate.
fn of_repository() -> Option<String> {
    if git(&["rev-parse", "--show-prefix"])? != "crates/cli/" {
        return None;
    }
    // The log of HEAD grows with each commit and each checkout; without one, the file of the branch changes.
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]);
    for name in ["HEAD", "logs/HEAD", "packed-refs"].into_iter().chain(branch.as_deref()) {
        if let Some(path) = git(&["rev-parse", "--git-path", name]).filter(|path| Path::new(path).exists()) {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    let said = git(&["-c", "log.showSignature=false", "show", "--no-patch", "--format=%H %cs", "HEAD"])?;
    let (hash, day) = said.split_once(' ')?;
    shown(hash, day)
}

fn shown(hash: &str, day: &str) -> Option<String> {
    let is_hash = hash.len() >= DIGITS && hash.bytes().all(|digit| digit.is_ascii_hexdigit());
    is_hash.then(|| format!("{} {day}", &hash[..DIGITS]).trim_end().to_string())
}

/// The first line that git prints; `None`: there is none, no repository, or it is not to be trusted.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()?.lines().next().map(ToString::to_string)
}
