//! The same results as before, to the last bit: `hashes.txt` has the `state_hash` of every example and of
//! every case of verification.
//!
//! A change of the code that should change no result leaves the table as it is. One that changes results
//! makes it again with `EMBATE_BLESS=1`, and its lines say which models those are. The runs are those of
//! other tests.

use crate::root;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Mutex;

/// One test after the other.
static TABLE: Mutex<()> = Mutex::new(());

/// Holds that the model `name` ends in the state with this hash.
pub(crate) fn is_as_before(name: &str, hash: &str) {
    let _one = TABLE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let path = root().join("crates/cli/tests/hashes.txt");
    let table = fs::read_to_string(&path).unwrap_or_default();
    let mut kept: BTreeMap<&str, &str> = table.lines().filter_map(|line| line.split_once(' ')).collect();
    if std::env::var_os("EMBATE_BLESS").is_some() {
        kept.insert(name, hash);
        let lines: Vec<String> = kept.iter().map(|(name, hash)| format!("{name} {hash}\n")).collect();
        fs::write(&path, lines.concat()).unwrap();
    }
    assert_eq!(
        kept.get(name),
        Some(&hash),
        "{name} does not end as it did: where that is meant, run this test with EMBATE_BLESS=1 and tell in CHANGELOG.md what changes"
    );
}

/// The same for all cases of verification of which results are in a folder, as `embate verify --out` leaves
/// them.
pub(crate) fn cases_are_as_before(results: &Path) {
    let mut count = 0;
    for case in fs::read_dir(results).unwrap().map(|entry| entry.unwrap().path()) {
        for model in fs::read_dir(&case).unwrap().map(|entry| entry.unwrap().path()) {
            let summary: serde_json::Value = serde_json::from_str(&fs::read_to_string(model.join("summary.json")).unwrap()).unwrap();
            let name = format!("verification/{}", model.strip_prefix(results).unwrap().display());
            is_as_before(&name, summary["state_hash"].as_str().unwrap());
            count += 1;
        }
    }
    assert!(count > 100, "{count} models");
}
