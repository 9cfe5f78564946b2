//! Warnings at their places in the file: line, column, excerpt, consequence and remedy.

use super::SOUND;
use embate_files::model_file::{Diagnostics, Loaded, load_text_with_places};
use std::path::Path;

/// A sound model with one more line in its material.
fn loaded(line: &str, set: &[String]) -> Loaded {
    let text = SOUND.replace("yield = \"100 MPa\"", &format!("yield = \"100 MPa\"\n{line}"));
    load_text_with_places("model.toml", &text, Path::new("."), set).unwrap_or_else(|diagnostics| panic!("{}", diagnostics.rendered))
}

fn reported(loaded: &Loaded) -> Diagnostics {
    loaded.reported(&loaded.model.warnings())
}

#[test]
fn a_warning_has_its_line_column_excerpt_consequence_and_cure() {
    let reported = reported(&loaded("hardening = \"-1 GPa\"", &[]));
    assert_eq!(reported.count, 1);
    let entry = &reported.entries[0];
    assert_eq!((entry.line, entry.column, entry.path.as_str()), (10, 13, "material.steel.hardening"));
    let text = &reported.rendered;
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].starts_with(
            "warning[W0301]: the flow stress falls by up to 1.0000e9 Pa per plastic strain; nothing is left of it at a plastic strain of 0.1"
        ),
        "{text}"
    );
    assert!(text.contains("--> model.toml:10:13") && text.contains("10 | hardening = \"-1 GPa\""), "{text}");
    assert!(text.contains("= note: the equations lose ellipticity") && text.contains("= help: fit the fall"), "{text}");
    assert!(text.ends_with("1 warning: the model is accepted\n"), "{text}");
}

#[test]
fn a_warning_of_an_override_points_to_it() {
    let reported = reported(&loaded("", &["material.steel.hardening=-1 GPa".into()]));
    assert_eq!(reported.entries[0].file, "--set");
}

#[test]
fn without_warnings_there_is_no_text() {
    let reported = reported(&loaded("", &[]));
    assert_eq!((reported.count, reported.rendered.as_str()), (0, ""));
}
