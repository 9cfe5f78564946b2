//! `--allow-outside` at every command that reads a model; without it files outside of the model's folder are
//! refused.

use crate::{Answer, embate, fresh};
use std::fs;
use std::path::{Path, PathBuf};

const MESH: &str = "*NODE\n1, 0, 0\n2, 0.01, 0\n3, 0.01, 0.01\n4, 0, 0.01\n*ELEMENT, TYPE=CPE4, ELSET=body\n1, 1, 2, 3, 4\n";
const MODEL: &str = r#"
run = { end = "0.1 ms", checkpoint_steps = 20 }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [{ name = "block", material = "steel", mesh = { file = "../mesh.inp", group = "body" }, velocity = [1, 0] }]
output.pictures = false
"#;

/// A folder `m` with a model whose mesh lies beside it.
fn laid_out(name: &str) -> PathBuf {
    let folder = fresh(name);
    fs::create_dir_all(folder.join("m")).unwrap();
    fs::write(folder.join("mesh.inp"), MESH).unwrap();
    fs::write(folder.join("m/model.toml"), MODEL).unwrap();
    folder
}

/// Refused before anything is done.
#[track_caller]
fn is_refused(answer: &Answer, whose: &str) {
    assert_eq!(answer.code, Some(2), "{}", answer.err);
    let reason = format!("leads out of the {whose} folder");
    assert!(
        answer.err.contains("error[E0124]") && answer.err.contains(&reason) && answer.err.contains("--allow-outside"),
        "{}",
        answer.err
    );
}

#[track_caller]
fn needs_leave(folder: &Path, arguments: &[&str], code: i32, whose: &str) {
    is_refused(&embate(folder, arguments), whose);
    let answer = embate(folder, [arguments, &["--allow-outside"]].concat());
    assert_eq!(answer.code, Some(code), "{}", answer.err);
}

#[test]
fn run_check_and_sweep_need_leave() {
    let folder = laid_out("outside-run");
    needs_leave(&folder, &["run", "m", "--out", "out", "--quiet"], 0, "model's");
    needs_leave(&folder, &["check", "m", "--out", "checked"], 0, "model's");
    needs_leave(&folder, &["sweep", "m", "--vary", "material.steel.young=100GPa,200GPa", "--out", "swept", "--quiet"], 0, "model's");
}

#[test]
fn a_checkpoint_gives_no_leave() {
    let folder = laid_out("outside-resume");
    let run = ["run", "m", "--out", "out", "--quiet", "--allow-outside", "--set", "run.max_steps=30"];
    assert_eq!(embate(&folder, run).code, Some(0));
    let replay = ["replay", "out", "--from", "0 s", "--to", "1 us", "--output-every", "1 us", "--quiet"];
    needs_leave(&folder, &replay, 0, "model's");
    needs_leave(&folder, &["resume", "out", "--quiet", "--set", "run.max_steps=40"], 0, "model's");
}

#[test]
fn cases_of_verification_need_leave() {
    let folder = laid_out("outside-verify");
    fs::create_dir_all(folder.join("cases")).unwrap();
    fs::rename(folder.join("m"), folder.join("cases/m")).unwrap();
    fs::rename(folder.join("mesh.inp"), folder.join("cases/mesh.inp")).unwrap();
    let expected = "title = \"flight\"\ntier = \"every\"\n\n[[check]]\nname = \"speed\"\nquantity = { history = \"energy.kinetic\", at = \"50 us\" }\nexpect = 0.39\ntolerance = 1e-9\nreason = \"nothing acts\"\n";
    fs::write(folder.join("cases/m/expected.toml"), expected).unwrap();
    needs_leave(&folder, &["verify", "--in", "cases", "--quiet"], 0, "model's");
}

#[test]
fn a_deck_that_is_imported_needs_leave() {
    let folder = fresh("outside-import");
    fs::create_dir_all(folder.join("m")).unwrap();
    fs::write(folder.join("mesh.inp"), MESH).unwrap();
    let deck = "*INCLUDE, INPUT=../mesh.inp\n*SOLID SECTION, ELSET=body, MATERIAL=steel\n*MATERIAL, NAME=steel\n*DENSITY\n7800.\n*ELASTIC\n200e9, 0.3\n*STEP\n*DYNAMIC, EXPLICIT\n, 1e-4\n*END STEP\n";
    fs::write(folder.join("m/deck.inp"), deck).unwrap();
    needs_leave(&folder, &["import", "m/deck.inp", "--out", "imported"], 0, "deck's");
    // A deck named without a folder lies in the one where the program is.
    is_refused(&embate(&folder.join("m"), ["import", "deck.inp", "--out", "../again"]), "deck's");
}
