//! Warnings as a user meets them: printed once on standard error, the model accepted, and listed in the
//! summary.

use crate::{embate, fresh};
use std::fs;

/// A block that falls onto a floor and softens, and one that was forgotten.
const MODEL: &str = r#"
[run]
end = "10 us"
[material.steel]
law = "j2"
density = 7800
young = "200 GPa"
poisson = 0.3
yield = "200 MPa"
hardening = "-1 GPa"
[[part]]
name = "block"
material = "steel"
rectangle = { corner = [0, "1 mm"], size = ["10 mm", "10 mm"], elements = [2, 2] }
velocity = [0, -10]
[[part]]
name = "forgotten"
material = "steel"
rectangle = { corner = ["20 mm", "1 mm"], size = ["10 mm", "10 mm"], elements = [2, 2] }
[[obstacle]]
parts = ["block"]
plane = { normal = [0, 1] }
[output]
fields = 1
pictures = false
"#;

#[test]
fn check_and_run_report_warnings_once_and_accept_the_model() {
    let folder = fresh("warned");
    fs::write(folder.join("model.toml"), MODEL).unwrap();
    for arguments in [
        &["check", "model.toml", "--out", "looked"][..],
        &["run", "model.toml", "--out", "out"],
        &["run", "model.toml", "--out", "quiet", "--quiet"],
    ] {
        let answer = embate(&folder, arguments);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        for (text, line) in [("the flow stress falls", 10), ("nothing acts on part `forgotten`", 16)] {
            assert_eq!(answer.err.matches(text).count(), 1, "{arguments:?}: {}", answer.err);
            assert!(answer.err.contains(&format!("model.toml:{line}:")), "{}", answer.err);
            assert!(!answer.out.contains(text), "{}", answer.out);
        }
        assert!(answer.err.contains("2 warnings: the model is accepted"), "{}", answer.err);
        assert!(arguments[0] == "check" || answer.err.contains("transmitted nothing") != arguments.contains(&"--quiet"), "{}", answer.err);
    }
    let summary: serde_json::Value = serde_json::from_str(&fs::read_to_string(folder.join("out/summary.json")).unwrap()).unwrap();
    let warnings: Vec<&str> = summary["warnings"].as_array().unwrap().iter().map(|text| text.as_str().unwrap()).collect();
    assert_eq!(warnings.len(), 3, "{warnings:?}");
    assert!(
        warnings[0].starts_with("W0301: material.steel.hardening: the flow stress falls") && warnings[0].contains("lose ellipticity"),
        "{warnings:?}"
    );
    assert!(warnings[1].starts_with("W0401: part[1]: nothing acts") && warnings[2].contains("transmitted nothing"), "{warnings:?}");
}

#[test]
fn of_a_model_with_faults_those_alone_are_reported() {
    let folder = fresh("warned-and-faulty");
    fs::write(folder.join("model.toml"), MODEL.replace("poisson = 0.3", "poisson = 0.5")).unwrap();
    let answer = embate(&folder, ["check", "model.toml"]);
    assert_eq!(answer.code, Some(2));
    assert!(answer.err.contains("1 fault: nothing was run") && !answer.err.contains("warning"), "{}", answer.err);
}
