//! `embate report`: of a short run, of one that failed, and of what is none.

use crate::{FLIGHT, embate, fresh};
use std::fs;
use std::path::Path;

#[test]
fn a_report_of_a_run_is_one_file_that_holds_all() {
    let folder = fresh("report");
    fs::write(folder.join("model.toml"), FLIGHT).unwrap();
    let ran = embate(
        &folder,
        ["run", "model.toml", "--out", "out", "--quiet", "--threads", "1", "--set", "run.safety=0.8", "--set", "output.pictures=true"],
    );
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let answer = embate(&folder, ["report", "out"]);
    assert_eq!((answer.code, answer.out.as_str()), (Some(0), "report in out/report.html\n"), "{}", answer.err);
    let page = fs::read_to_string(folder.join("out/report.html")).unwrap();
    for part in [
        "status good\">done",
        "--set run.safety=0.8",
        "state hash",
        "data:image/png;base64,",
        "data:image/gif;base64,",
        "Energies",
        "Histories",
        "Figures of the run",
        "<td>block</td>",
        "<td>4 quad4</td>",
        "<td>young</td><td>200 GPa</td>",
        "<td>safety</td><td>0.8</td>",
        "is <code>",
    ] {
        assert!(page.contains(part), "{part}");
    }
    for forbidden in ["<script", "http://", "https://"] {
        assert!(!page.contains(forbidden), "{forbidden}");
    }
    let other = embate(&folder, ["report", "out", "--out", "sent.html"]);
    assert_eq!((other.code, other.out.as_str()), (Some(0), "report in sent.html\n"), "{}", other.err);
    assert_eq!(fs::read_to_string(folder.join("sent.html")).unwrap(), page);
    // A report does not keep a run from being replaced, and the results stay as they are.
    assert!(folder.join("out/summary.json").exists());
}

#[test]
fn the_report_of_a_failed_run_has_its_error_and_names_the_post_mortem() {
    let folder = fresh("report-failed");
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../failures/inverted-element");
    let ran = embate(&folder, ["run", model.to_str().unwrap(), "--out", "out", "--quiet"]);
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert_eq!(embate(&folder, ["report", "out"]).code, Some(0));
    let page = fs::read_to_string(folder.join("out/report.html")).unwrap();
    for part in ["status bad\">failed", "embate explain E0601", "post-mortem/README.md"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn what_is_no_result_folder_and_what_is_damaged_is_refused() {
    let folder = fresh("report-refused");
    let none = embate(&folder, ["report", "."]);
    assert!(none.code == Some(2) && none.err.contains("error[E0722]: . holds no results"), "{}", none.err);
    fs::write(folder.join("history.csv"), "time,a\n0,1\n1\n").unwrap();
    let damaged = embate(&folder, ["report", "."]);
    assert!(
        damaged.code == Some(2) && damaged.err.contains("error[E0721]: ./history.csv, line 3: 1 values for 2 columns"),
        "{}",
        damaged.err
    );
    assert!(!folder.join("report.html").exists());
    fs::write(folder.join("history.csv"), "time,a\n0,1\n").unwrap();
    let nowhere = embate(&folder, ["report", ".", "--out", "history.csv/report.html"]);
    assert!(nowhere.code == Some(1) && nowhere.err.contains("error[E0704]"), "{}", nowhere.err);
}
