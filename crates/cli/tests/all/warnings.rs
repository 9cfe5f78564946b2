//! Warnings as a user meets them: printed once on standard error, the model accepted, and listed in the
//! summary.

use crate::{embate, fresh, root};
use embate_files::model_file;
use embate_solver::simulation::{Options, Simulation};
use std::fs;
use std::path::PathBuf;

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

/// Warnings of what is wrong beyond doubt: a model that is right has none of them.
const SLIPS: [&str; 7] = ["W0204", "W0304", "W0305", "W0408", "W0502", "W0605", "W0703"];
/// Larger models are made ready by the tests that run them.
const ELEMENTS_MOST: u128 = 30_000;

/// Models that say of themselves that they are of no real material: their density sets the time alone.
const MEANT: &[(&str, &str)] = &[("von-mises-truss/pendulum.toml", "W0304"), ("shell-obstacles/cylinder.toml", "W0305")];

#[test]
fn no_example_and_no_case_of_verification_looks_like_a_slip() {
    let folders = ["examples", "verification"].map(|name| fs::read_dir(root().join(name)).unwrap());
    let folders = folders.into_iter().flatten().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir());
    let files = folders.flat_map(|folder| fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path());
    let is_model = |path: &PathBuf| path.extension().is_some_and(|it| it == "toml") && !path.ends_with("expected.toml");
    let (mut looked, mut found) = (0, Vec::new());
    for path in files.filter(is_model) {
        let Ok(model) = model_file::load(&path, &[]) else { continue };
        let mut warnings = model.warnings();
        if model.parts.iter().map(|part| model.element_count(part)).sum::<u128>() <= ELEMENTS_MOST {
            let simulation =
                Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            warnings = simulation.model_warnings().to_vec();
        }
        looked += 1;
        let is_meant = |code: &str| MEANT.iter().any(|(model, own)| path.ends_with(model) && *own == code);
        let slips = warnings.iter().filter(|warning| SLIPS.contains(&warning.kind.code) && !is_meant(warning.kind.code));
        found.extend(slips.map(|warning| format!("{}: {}: {warning}", path.display(), warning.kind.code)));
    }
    assert!(looked > 150, "{looked}");
    assert!(found.is_empty(), "{}", found.join("\n"));
}
