//! Unsafe code is in `lanes` alone: every other crate takes over the lints of the workspace, which forbid it.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn manifest(path: &str) -> String {
    fs::read_to_string(root().join(path).join("Cargo.toml")).unwrap()
}

/// The lines of a table of a manifest.
fn table<'a>(manifest: &'a str, header: &str) -> Vec<&'a str> {
    let lines = manifest.lines().skip_while(|line| line.trim() != header).skip(1);
    lines.take_while(|line| !line.starts_with('[')).filter(|line| !line.is_empty()).collect()
}

#[test]
fn every_crate_but_lanes_forbids_unsafe_code() {
    let workspace = manifest("");
    // Forbidden can't be allowed again further down, in contrast to denied.
    assert!(table(&workspace, "[workspace.lints.rust]").contains(&"unsafe_code = \"forbid\""), "the workspace forbids it");
    let mut folders: Vec<String> =
        fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    folders.sort();
    assert!(folders.len() >= 4 && folders.contains(&"lanes".to_string()), "{folders:?}");
    for folder in folders {
        assert!(workspace.contains(&format!("\"crates/{folder}\"")), "crates/{folder} is no member of the workspace");
        let lints = manifest(&format!("crates/{folder}"));
        let inherits = table(&lints, "[lints]") == ["workspace = true"];
        assert_eq!(inherits, folder != "lanes", "crates/{folder} takes over the lints of the workspace");
    }
}

#[test]
fn in_lanes_every_unsafe_block_says_why_it_is_sound() {
    let lanes = manifest("crates/lanes");
    assert!(table(&lanes, "[lints.rust]").contains(&"unsafe_op_in_unsafe_fn = \"deny\""));
    // A warning, which CI takes for an error.
    assert!(table(&lanes, "[lints.clippy]").contains(&"undocumented_unsafe_blocks = \"warn\""));
}
