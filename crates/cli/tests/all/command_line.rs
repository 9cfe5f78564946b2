//! Everything that does not step: usage, lists, schema, starter models, results in the way.

use crate::{FLIGHT, embate, fresh};
use embate_solver::{contact, element, material, output};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

fn here() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

#[test]
fn usage_errors_end_with_code_two() {
    for arguments in [
        &[][..],
        &["fly"],
        &["run"],
        &["run", "model", "--threads", "many"],
        &["run", "model", "--threads", "4000000000"],
        &["run", "model", "--set", "run.end"],
        &["run", "model", "--fast"],
        &["list", "colours"],
        &["new"],
    ] {
        let answer = embate(here(), arguments);
        assert_eq!(answer.code, Some(2), "{arguments:?}: {}", answer.err);
        assert!(answer.out.is_empty() && (answer.err.contains("Usage") || answer.err.contains("--help")), "{arguments:?}: {}", answer.err);
    }
}

#[test]
fn help_and_version_end_with_code_zero() {
    let help = embate(here(), ["--help"]);
    assert_eq!(help.code, Some(0));
    for command in ["run", "sweep", "fit", "check", "list", "new", "import", "verify", "bench", "explain", "schema", "completions", "man"] {
        assert!(help.out.contains(command), "{}", help.out);
    }
    for version in ["--version", "-V"] {
        let version = embate(here(), [version]);
        assert!(version.code == Some(0) && version.out.starts_with(concat!("embate ", env!("CARGO_PKG_VERSION"))), "{}", version.out);
    }
    assert!(embate(here(), ["run", "--help"]).out.contains("--simd"));
}

#[test]
fn a_model_that_is_not_there_ends_with_code_two() {
    let folder = fresh("no-model");
    for command in ["run", "check"] {
        let answer = embate(&folder, [command, "nowhere"]);
        assert_eq!(answer.code, Some(2));
        assert!(answer.err.contains("nowhere"), "{}", answer.err);
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0, "a faulty model leaves nothing behind");
}

#[test]
fn existing_results_are_refused() {
    let folder = fresh("in-the-way");
    fs::write(folder.join("summary.json"), "{}").unwrap();
    let answer = embate(&folder, ["run", "nowhere", "--out", "."]);
    assert_eq!(answer.code, Some(2));
    assert!(answer.err.contains("--force") && answer.err.contains("summary.json"), "{}", answer.err);
    assert_eq!(fs::read_to_string(folder.join("summary.json")).unwrap(), "{}");
}

#[test]
fn a_faulty_model_does_not_cost_earlier_results() {
    let folder = fresh("faulty-forced");
    fs::write(folder.join("summary.json"), "{}").unwrap();
    assert_eq!(embate(&folder, ["run", "nowhere", "--out", ".", "--force"]).code, Some(2));
    assert!(folder.join("summary.json").exists());
}

#[test]
fn lists_hold_everything_in_the_registries() {
    let text = embate(here(), ["list"]).out;
    let mut names: Vec<&str> = output::FIELDS.iter().map(|field| field.name).collect();
    names.extend(element::registry().iter().map(|kind| kind.name));
    names.extend(contact::search::registry::<2>().iter().map(|search| search.name));
    for law in material::registry() {
        names.push(law.name);
        names.extend(law.parameters.iter().map(|parameter| parameter.name));
    }
    for kind in material::eos::EQUATIONS {
        names.push(kind.name);
        names.extend(kind.parameters.iter().map(|parameter| parameter.name));
    }
    for name in names {
        assert!(text.contains(name), "{name} is missing in\n{text}");
    }
}

#[test]
fn one_list_can_be_chosen() {
    for (what, title) in [
        ("elements", "Elements"),
        ("materials", "Materials"),
        ("equations-of-state", "Equations of state"),
        ("stress-states", "Stress states"),
        ("searches", "Searches"),
        ("formulations", "Contact formulations"),
        ("fields", "Fields"),
    ] {
        let answer = embate(here(), ["list", what]);
        assert_eq!(answer.code, Some(0));
        assert!(answer.out.starts_with(title));
        assert_eq!(answer.out.contains("von_mises  "), what == "fields", "{}", answer.out);
    }
}

#[test]
fn one_thing_is_listed_by_its_name() {
    for (name, [with, without]) in [
        ("j2", ["rate_exponent", "saturation"]),
        ("hex8_reduced", ["Elements", "hex8_full"]),
        ("von_mises", ["Pa", "pressure"]),
        ("ring", ["inner", "extrude"]),
        ("steel DP600", ["EN 10346", "steel S355"]),
    ] {
        let answer = embate(here(), ["list", name]);
        assert_eq!(answer.code, Some(0), "{name}: {}", answer.err);
        assert!(answer.out.contains(with) && !answer.out.contains(without), "{name}: {}", answer.out);
    }
    let answer = embate(here(), ["list", "j3"]);
    assert!(answer.code == Some(2) && answer.err.contains("did you mean `j2`"), "{}", answer.err);
}

#[test]
fn the_library_of_materials_is_listed() {
    let all = embate(here(), ["list", "materials", "--library"]);
    assert_eq!(all.code, Some(0), "{}", all.err);
    for material in embate_files::model_file::library() {
        assert!(all.out.contains(&format!("\n  {} (", material.name)), "{}", material.name);
    }
    assert_eq!(embate(here(), ["list", "--library"]).out, all.out);
    let one = embate(here(), ["list", "materials", "--library", "steel DP600"]);
    assert!(one.code == Some(0) && one.out.contains("hardening_exponent") && one.out.contains("source of"), "{}", one.out);
    assert_eq!(embate(here(), ["list", "steel DP600"]).out, one.out);
    let wrong = embate(here(), ["list", "--library", "DP600"]);
    assert!(wrong.code == Some(2) && wrong.err.contains("did you mean `steel DP600`?"), "{}", wrong.err);
    assert_eq!(embate(here(), ["list", "elements", "--library"]).code, Some(2));
}

#[test]
fn the_schema_is_json() {
    let answer = embate(here(), ["schema"]);
    assert_eq!(answer.code, Some(0));
    if !answer.out.trim().is_empty() {
        let schema: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
        assert!(schema.is_object());
    }
}

#[test]
fn a_starter_model_is_made_once() {
    let folder = fresh("starter");
    let answer = embate(&folder, ["new", "deep/tube"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("embate run deep/tube"), "{}", answer.out);
    let file = folder.join("deep/tube/model.toml");
    fs::write(&file, "mine").unwrap();
    let again = embate(&folder, ["new", "deep/tube"]);
    assert_eq!(again.code, Some(2));
    assert!(again.err.contains("--force"), "{}", again.err);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(embate(&folder, ["new", "deep/tube", "--force"]).code, Some(0));
    assert_ne!(fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(embate(&folder, ["new", ".."]).code, Some(2));
}

#[test]
fn every_template_is_checked_without_a_warning_and_makes_pictures() {
    let folder = fresh("templates");
    for starter in embate_files::model_file::STARTERS {
        let name = starter.name;
        let made = embate(&folder, ["new", name, "--template", name]);
        assert_eq!(made.code, Some(0), "{}", made.err);
        let schema = fs::read_to_string(folder.join(name).join("embate.schema.json")).unwrap();
        assert!(serde_json::from_str::<serde_json::Value>(&schema).unwrap()["properties"]["part"].is_object());
        let checked = embate(&folder, ["check", name]);
        assert!(checked.code == Some(0) && checked.err.is_empty(), "{name}: {}", checked.err);
        assert!(checked.out.contains("no initial penetrations"), "{name}: {}", checked.out);
        let ran = embate(&folder, ["run", name, "--quiet", "--set", "run.max_steps=40"]);
        assert!(ran.code == Some(0) && ran.err.is_empty(), "{name}: {}", ran.err);
        let results = folder.join("results").join(name);
        assert!(["final.png", "animation.gif", "energy.svg", "history.svg"].iter().all(|file| results.join(file).exists()), "{name}");
    }
    let unknown = embate(&folder, ["new", "x", "--template", "cube"]);
    assert!(unknown.code == Some(2) && unknown.err.contains("drop-test"), "{}", unknown.err);
}

#[test]
fn check_draws_what_is_left_of_a_faulty_model() {
    let folder = fresh("check-faulty");
    fs::write(folder.join("model.toml"), FLIGHT.replace("material = \"steel\"", "material = \"steal\"")).unwrap();
    let answer = embate(&folder, ["check", "model.toml", "--out", "out"]);
    assert!(
        answer.code == Some(2) && answer.err.contains("steal") && answer.out.contains("picture: out/check.png"),
        "{}{}",
        answer.out,
        answer.err
    );
    assert!(folder.join("out/check.png").is_file());
    // Where nothing is left nothing is drawn.
    fs::write(folder.join("model.toml"), FLIGHT.replace("[2, 2]", "[0, 2]")).unwrap();
    let answer = embate(&folder, ["check", "model.toml", "--out", "none"]);
    assert!(answer.code == Some(2) && answer.out.is_empty() && !folder.join("none").exists(), "{}{}", answer.out, answer.err);
}

#[test]
fn a_closed_pipe_is_quiet() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_embate")).arg("list").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty() && output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_embate")).arg("list").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("standard output"));
}

/// A square that stands; `{}` is what follows the step.
const DECK: &str = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPE4,ELSET=body\n1,1,2,3,4\n*SOLID SECTION,ELSET=body,MATERIAL=m\n\
    *MATERIAL,NAME=m\n*DENSITY\n1.e-9,\n*ELASTIC\n1000.,0.3\n*STEP\n*DYNAMIC,EXPLICIT\n,1.e-3\n{}*END STEP\n";

#[test]
fn a_deck_is_imported_with_a_report_and_the_exit_code_says_whether_all_of_it_acts() {
    let folder = fresh("import");
    fs::write(folder.join("whole.inp"), DECK.replace("{}", "")).unwrap();
    fs::write(folder.join("partly.inp"), DECK.replace("{}", "*FOO\n")).unwrap();
    fs::write(folder.join("wrong.inp"), DECK.replace("{}", "*EQUATION\n")).unwrap();
    let whole = embate(&folder, ["import", "whole.inp", "--out", "whole", "--units", "mm,t,s"]);
    assert_eq!(whole.code, Some(0), "{}", whole.err);
    assert!(whole.out.contains("nothing was ignored") && whole.out.contains("units of the deck: mm, t, s"), "{}", whole.out);
    assert_eq!(embate(&folder, ["check", "whole"]).code, Some(0));
    let partly = embate(&folder, ["import", "partly.inp", "--out", "partly"]);
    assert_eq!(partly.code, Some(3), "{}", partly.err);
    assert!(partly.out.contains("*FOO (partly.inp, line 17)") && partly.err.contains("import.txt"), "{}{}", partly.out, partly.err);
    assert!(fs::read_to_string(folder.join("partly/import.txt")).unwrap().contains("*FOO"));
    let wrong = embate(&folder, ["import", "wrong.inp", "--out", "wrong"]);
    assert_eq!(wrong.code, Some(2));
    assert!(wrong.err.contains("wrong.inp, line 17: *EQUATION") && !folder.join("wrong").exists(), "{}", wrong.err);
    let again = embate(&folder, ["import", "whole.inp", "--out", "whole"]);
    assert_eq!(again.code, Some(2));
    assert!(again.err.contains("--force"), "{}", again.err);
    assert_eq!(embate(&folder, ["import", "whole.inp", "--out", "units", "--units", "mm,kg"]).code, Some(2));
}
