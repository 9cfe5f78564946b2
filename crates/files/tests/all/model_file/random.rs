//! No text makes the reader panic: random, mutated, deep, long and large ones.

use super::{SOUND, faults, read};
use embate_files::model_file::{load, load_text};
use proptest::prelude::*;
use std::path::Path;

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_answered(text in any::<String>()) {
        let _ = read(&text);
    }

    #[test]
    fn a_sound_model_with_a_piece_replaced_is_answered(at in 0usize..1600, length in 0usize..40, piece in "[\\PC\n]{0,12}|free|ramp|multiplier|bodies|\\[\\[part\\]\\]|= *|\\{|\"|\n|nan|-1|1e999|µ") {
        let mut text = SOUND.to_string();
        let at = at.min(text.len());
        text.replace_range(at..(at + length).min(text.len()), &piece);
        if let Err(diagnostics) = read(&text) {
            prop_assert!(diagnostics.count == diagnostics.entries.len() && diagnostics.count > 0);
            prop_assert!(diagnostics.entries.iter().all(|entry| !entry.message.is_empty()));
            let _ = diagnostics.render(true);
        }
    }

    #[test]
    fn any_line_of_a_sound_model_may_be_lost_or_doubled(line in 0usize..52, doubled: bool) {
        let lines: Vec<&str> = SOUND.lines().collect();
        let text: Vec<&str> = lines.iter().enumerate().flat_map(|(at, text)| {
            let count = if at != line { 1 } else if doubled { 2 } else { 0 };
            std::iter::repeat_n(*text, count)
        }).collect();
        let _ = read(&text.join("\n"));
    }

    #[test]
    fn any_unit_text_is_answered(value in "[-+0-9.e]{0,8} ?[a-zA-Zµ%°²⁻^*/· 0-9-]{0,12}") {
        let _ = read(&super::changed("\"1 ms\"", &format!("'{value}'")));
    }

    #[test]
    fn any_override_is_answered(path in "(part|run|material|output|\\[|\\]|\\.|0|1|tube|end|ring|velocity|=|\"| ){1,8}", value in any::<String>()) {
        let _ = load_text("m", SOUND, Path::new("."), &[format!("{path}={value}"), path]);
    }
}

#[test]
fn deep_nesting_is_refused() {
    for text in [
        "[".repeat(100_000),
        "a = ".to_string() + &"[".repeat(100_000),
        "a = ".to_string() + &"{a=".repeat(50_000),
        format!("{}a = 1", "a.".repeat(100_000)),
    ] {
        assert_eq!(faults(&text).len(), 1);
    }
    let set = format!("{}=1", vec!["run"; 1000].join("."));
    assert_eq!(load_text("m", SOUND, Path::new("."), &[set]).unwrap_err().count, 1);
}

#[test]
fn huge_texts_and_numbers_are_refused_shortly() {
    let long = "x".repeat(1_000_000);
    for text in [
        super::changed("name = \"tube\"", &format!("name = \"{long}\"")),
        super::changed("\"1 ms\"", &format!("\"1 {long}\"")),
        super::changed("\"1 ms\"", &format!("\"{} ms\"", "1".repeat(1_000_000))),
        super::changed("law = ", &format!("{long} = ")),
        super::changed("[1, 40]", "[1000000000, 1000000000]"),
        super::changed("elements = 4", "elements = 9223372036854775807"),
        super::changed("fields = 10", "fields = 9223372036854775807"),
        super::changed("fields = 10", "history = \"1e-30 s\""),
    ] {
        let diagnostics = read(&text).unwrap_err();
        assert!(diagnostics.rendered.len() < 5000, "{}", diagnostics.rendered.len());
    }
}

#[test]
fn of_many_faults_of_one_kind_twenty_are_shown() {
    let lines: String = (0..5000).map(|index| format!("unknown_{index} = {index}\n")).collect();
    let diagnostics = read(&super::changed("[material.steel]\n", &format!("{lines}[material.steel]\n"))).unwrap_err();
    assert_eq!(diagnostics.count, 5000);
    assert_eq!(diagnostics.rendered.matches("error[E0106]: ").count(), 20);
    assert!(diagnostics.rendered.ends_with("and 4980 more of E0106\n5000 faults: nothing was run\n"));
}

#[test]
fn files_that_are_none_are_answered() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("inner")).unwrap();
    let message = |path: &Path| {
        let diagnostics = load(path, &[]).unwrap_err();
        assert_eq!(diagnostics.count, diagnostics.entries.len());
        (diagnostics.entries[0].message.clone(), diagnostics.entries[0].help.clone())
    };
    assert_eq!(message(folder.path()).0, "there is no such file");
    assert!(message(&folder.path().join("inner/nothing.toml")).1.starts_with("make one with `embate new NAME`"));
    assert!(message(&folder.path().join("none/nothing.toml")).1.starts_with("there is no folder "));
    std::fs::write(folder.path().join("model.toml"), b"").unwrap();
    assert_eq!(message(folder.path()).0, "the model has no [run]");
    assert!(message(&folder.path().join("nothing.toml")).1.contains("model.toml"));
    std::fs::write(folder.path().join("latin.toml"), b"title = \"caf\xe9\"\n").unwrap();
    let latin = load(&folder.path().join("latin.toml"), &[]).unwrap_err();
    assert_eq!((latin.entries[0].line, latin.entries[0].column, latin.entries[0].message.as_str()), (1, 13, "the file is not UTF-8 text"));
    std::fs::write(folder.path().join("large.toml"), vec![b'#'; (16 << 20) + 1]).unwrap();
    assert_eq!(message(&folder.path().join("large.toml")).0, "the file is larger than 16 MiB");
    #[cfg(unix)]
    assert!(message(Path::new("/dev/zero")).0.starts_with("the file can't be read: it is a device, not a file"));
}
