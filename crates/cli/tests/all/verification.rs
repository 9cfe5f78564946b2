//! `embate verify`: the cases of `verification/` hold, and the command itself says what is wrong.

use crate::{Answer, FLIGHT, embate, fresh};
use std::fs;
use std::path::{Path, PathBuf};

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification")
}

/// A case with this check of a block that flies with 1 m/s.
fn verify(name: &str, checks: &str, more: &[&str]) -> Answer {
    verify_of(FLIGHT, name, checks, more)
}

fn verify_of(model: &str, name: &str, checks: &str, more: &[&str]) -> Answer {
    let folder = fresh(name);
    let case = folder.join("verification/block");
    fs::create_dir_all(&case).unwrap();
    fs::write(case.join("model.toml"), model).unwrap();
    fs::write(case.join("expected.toml"), format!("title = \"Block\"\ntier = \"every\"\n{checks}")).unwrap();
    embate(&folder, ["verify"].iter().chain(more))
}

fn check(text: &str) -> String {
    format!("[[check]]\nname = \"it\"\nreason = \"flight\"\n{text}\n")
}

#[test]
fn every_case_of_tier_every_holds() {
    hold("verify-every", &[]);
}

#[test]
#[ignore = "takes minutes: the long form"]
fn every_case_of_all_tiers_holds() {
    hold("verify-all", &["--all"]);
}

/// Cases hold, and their models end as they did.
fn hold(name: &str, which: &[&str]) {
    let (folder, cases) = (fresh(name), cases());
    let command = ["verify", "--quiet", "--in", cases.to_str().unwrap(), "--out", "out"];
    let answer = embate(&folder, command.iter().chain(which));
    assert_eq!(answer.code, Some(0), "{}{}", answer.out, answer.err);
    crate::hashes::cases_are_as_before(&folder.join("out"));
}

#[test]
fn every_case_says_what_it_is_and_stands_in_the_book() {
    let page = fs::read_to_string(cases().join("../docs/verification.md")).unwrap();
    assert!(
        page.contains(&embate_files::verification::expected_markdown()),
        "docs/verification.md lacks the tables of keys as they are:\n{}",
        embate_files::verification::expected_markdown()
    );
    for entry in fs::read_dir(cases()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        let readme = fs::read_to_string(path.join("README.md")).unwrap_or_else(|error| panic!("{name} has no README.md: {error}"));
        assert!(readme.starts_with("# ") && readme.contains("Tolerances"), "{name}/README.md");
        assert!(page.contains(&format!("[{name}](../verification/{name}/README.md)")), "docs/verification.md lacks the case {name}");
    }
}

#[test]
fn a_right_value_holds_and_a_wrong_one_fails() {
    let quantity = "quantity = { history = \"P.vx\", take = \"mean\" }\n";
    let right = verify("verify-right", &check(&format!("{quantity}expect = 1\ntolerance = 1e-12")), &["--json", "out.json"]);
    assert_eq!(right.code, Some(0), "{}{}", right.out, right.err);
    assert!(right.out.contains("holds") && right.out.contains("Block"), "{}", right.out);
    let json = fs::read_to_string(Path::new(env!("CARGO_TARGET_TMPDIR")).join("verify-right/out.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&json[0]["case"], &json[0]["checks"][0]["passed"]), (&"block".into(), &true.into()));
    for accepted in
        ["expect = 1.01\ntolerance_relative = \"0.5 %\"", "expect = 1.01\ntolerance = 0.005", "at_least = 1.01", "at_most = 0.99"]
    {
        let wrong = verify("verify-wrong", &check(&format!("{quantity}{accepted}")), &[]);
        assert_eq!(wrong.code, Some(1), "{accepted}: {}{}", wrong.out, wrong.err);
        assert!(wrong.out.contains("FAILS") && wrong.err.contains("1 of 1 checks"), "{}{}", wrong.out, wrong.err);
    }
}

#[test]
fn a_report_is_written_in_both_forms_whether_checks_hold_or_not() {
    let quantity = "quantity = { history = \"P.vx\", take = \"mean\", from = \"20 us\", to = \"50 us\" }\n";
    for (name, expected, code, says) in
        [("report-right", 1.0, 0, "All 1 checks of 1 cases hold."), ("report-wrong", 2.0, 1, "1 of 1 checks fail, in block.")]
    {
        let check = check(&format!("{quantity}expect = {expected:?}\ntolerance = 0.01"));
        let answer = verify(name, &check, &["--report", "verdicts.html", "--report", "pages/verdicts.md"]);
        assert_eq!(answer.code, Some(code), "{}{}", answer.out, answer.err);
        let read = |file: &str| fs::read_to_string(Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).join(file)).unwrap();
        let (html, markdown, svg) = (read("verdicts.html"), read("pages/verdicts.md"), read("pages/verdicts/block.svg"));
        assert!(html.contains(says) && html.contains("<svg"), "{html}");
        assert!(
            markdown.contains(says) && markdown.contains("(../verification/block/README.md)") && markdown.contains("(verdicts/block.svg)"),
            "{markdown}"
        );
        assert!(svg.contains("P.vx [m/s]"), "{svg}");
    }
    let answer = verify("report-other", &check(&format!("{quantity}at_most = 2")), &["--report", "verdicts.pdf"]);
    assert_eq!(answer.code, Some(2));
    assert!(answer.err.contains(".html or .md"), "{}", answer.err);
}

#[test]
fn every_source_gives_its_number() {
    let all = [
        ("summary = \"elements\"", 4.0),
        ("summary = \"momentum_drift.linear\"", 0.0),
        ("history = \"P.x\", at = \"50 us\"", 0.005 + 5e-5),
        ("history = \"P.vx\", take = \"integral\", from = \"20 us\", to = \"50 us\"", 3e-5),
        ("history = \"P.x\", take = \"first_above\", level = 0.00503", 3e-5),
        ("field = \"displacement.x\", take = \"max\"", 1e-4),
        ("field = \"displacement.x\", nearest = [0, 0]", 1e-4),
        ("field = \"velocity.x\", take = \"sum\", part = \"block\", box = { low = [0, 0], high = [1, 0.005] }", 6.0),
        ("field = \"stress.xx\", take = \"min\"", 0.0),
    ];
    let checks: Vec<String> =
        all.iter().map(|(source, value)| check(&format!("quantity = {{ {source} }}\nexpect = {value:?}\ntolerance = 1e-7"))).collect();
    let over =
        check("quantity = { history = \"P.x\", at = \"0.1 ms\" }\nover = { history = \"P.x\", at = 0 }\nexpect = 1.02\ntolerance = 1e-9");
    let minus =
        check("quantity = { history = \"P.x\", at = \"0.1 ms\" }\nminus = { history = \"P.x\", at = 0 }\nexpect = 1e-4\ntolerance = 1e-9");
    let answer = verify("verify-sources", &(checks.concat() + &over + &minus), &[]);
    assert_eq!(answer.code, Some(0), "{}{}", answer.out, answer.err);
}

#[test]
fn values_of_solids_are_chosen_by_places_in_3d() {
    let part = |name: &str, z: f64, speed: f64| {
        format!(
            "[[part]]\nname = \"{name}\"\nmaterial = \"steel\"\nbox = {{ corner = [0, 0, {z}], size = [1, 1, 1], elements = [2, 2, 2] }}\nvelocity = [0, 0, {speed}]\n"
        )
    };
    let material = "[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"200 GPa\"\npoisson = 0.3\n";
    let output = "[output]\nfields = 2\nhistory = 2\npictures = false\n";
    let model = format!("run.end = \"0.1 ms\"\n{material}{}{}{output}", part("low", 0.0, 1.0), part("high", 2.0, 3.0));
    let all = [
        ("field = \"velocity.z\", nearest = [0, 0, 1]", 1.0),
        ("field = \"velocity.z\", nearest = [0, 0, \"2 m\"]", 3.0),
        ("field = \"velocity.z\", take = \"sum\", box = { low = [0, 0, 0.5], high = [1, 1, 2] }", 18.0 + 27.0),
        ("field = \"stress.zx\", take = \"max\"", 0.0),
    ];
    let checks: String =
        all.iter().map(|(source, value)| check(&format!("quantity = {{ {source} }}\nexpect = {value:?}\ntolerance = 1e-3"))).collect();
    let answer = verify_of(&model, "verify-space", &checks, &[]);
    assert_eq!(answer.code, Some(0), "{}{}", answer.out, answer.err);
}

#[test]
fn what_is_not_there_is_reported_with_its_place() {
    let expect = "expect = 1\ntolerance = 1";
    for (quantity, says) in [
        ("history = \"P.vz\", at = 0", "no column `P.vz`"),
        ("summary = \"energy_drfit\"", "did you mean `energy_drift`"),
        ("summary = \"status\"", "no number"),
        ("field = \"stres.xx\", take = \"max\"", "did you mean `stress`"),
        ("field = \"stress\", take = \"max\"", "has components"),
        ("field = \"stress.zx\", take = \"max\"", "no component `zx`"),
        ("field = \"pressure\", take = \"max\", part = \"blok\"", "did you mean `block`"),
        ("field = \"pressure\", take = \"max\", box = { low = [5, 5], high = [6, 6] }", "no element in the box"),
        ("history = \"P.vx\", at = \"1 s\"", "the run ends at"),
        ("history = \"P.vx\"", "give `at` or `take`"),
        ("history = \"P.vx\", take = \"sum\"", "can't be taken of a history"),
        ("history = \"P.vx\", take = \"first_above\"", "needs `level`"),
        ("history = \"P.vx\", take = \"max\", level = 1", "needs no level"),
        ("history = \"P.vx\", take = \"max\", part = \"block\"", "means nothing with `history`"),
        ("history = \"P.vx\", take = \"max\", from = 1e-5, to = 1e-5", "not later than"),
        ("history = \"P.vx\", field = \"stress.xx\", take = \"max\"", "at once"),
        ("histroy = \"P.vx\", take = \"max\"", "did you mean `history`"),
    ] {
        let answer = verify("verify-missing", &check(&format!("quantity = {{ {quantity} }}\n{expect}")), &[]);
        assert_eq!(answer.code, Some(2), "{quantity}: {}{}", answer.out, answer.err);
        assert!(answer.err.contains(says) && answer.err.contains("expected.toml:6"), "{quantity}: {}", answer.err);
        assert!(answer.out.is_empty(), "nothing is run before all is known to be there: {}", answer.out);
    }
}

#[test]
fn a_case_that_proves_nothing_is_refused() {
    let quantity = "quantity = { summary = \"elements\" }\n";
    for (text, says) in [
        (String::new(), "the case has no [[check]]"),
        (check(quantity), "needs `expect`, `at_least` or `at_most`"),
        (check(&format!("{quantity}expect = 4")), "no tolerance"),
        (check(&format!("{quantity}expect = 4\ntolerance = 1\ntolerance_relative = 1")), "more than one tolerance"),
        (check(&format!("{quantity}expect = 0\ntolerance_relative = 1")), "a fraction of an expected 0"),
        (check(&format!("{quantity}expect = 4\ntolerance = nan")), "not a number"),
        (check(&format!("{quantity}expect = nan\ntolerance = 1")), "not a number"),
        (check(&format!("{quantity}expect = 4\ntolerance = 1\nmodel = \"modle\"")), "did you mean `model`"),
        (
            check(&format!("{quantity}expect = 4\ntolerance = 1")) + "[variant.fine]\nset = [\"run.end=1\"]\n",
            "no check names the model `fine`",
        ),
        ("[[check]]\n".to_string(), "has no `reason`"),
    ] {
        let answer = verify("verify-nothing", &text, &[]);
        assert_eq!(answer.code, Some(2), "{text}: {}{}", answer.out, answer.err);
        assert!(answer.err.contains(says), "{text}: {}", answer.err);
    }
}

#[test]
fn no_number_never_passes() {
    let never = "quantity = { history = \"P.vx\", take = \"first_above\", level = 5 }\nexpect = 0\ntolerance = 1e300";
    let divided = "quantity = { summary = \"elements\" }\nover = { history = \"P.vy\", at = 0 }\nat_least = -1e300";
    let unknown = "quantity = { summary = \"momentum_drift.linear\" }\nat_most = 1e300\nmodel = \"held\"";
    for (text, says) in [(never, "never there"), (divided, "FAILS: it is "), (unknown, "is null")] {
        let variant = "[variant.held]\nset = [\"constraint=[{ on = \\\"block.left\\\", velocity = { x = 1 } }]\"]\n";
        let text = if text.contains("held") { format!("{variant}{}", check(text)) } else { check(text) };
        let answer = verify("verify-none", &text, &[]);
        assert_eq!(answer.code, Some(1), "{text}: {}{}", answer.out, answer.err);
        assert!(answer.out.contains(says), "{}", answer.out);
    }
}

#[test]
fn a_run_that_fails_fails_its_checks() {
    let crushed = "[variant.crushed]\nset = [\"part.block.velocity=[2500, 0]\", \"run.energy_limit=0.9\", \"run.step_limit=\\\"0.5 us\\\"\", \"obstacle=[{ plane = { point = [\\\"10 mm\\\", 0], normal = [-1, 0] } }]\"]\n";
    let answer = verify(
        "verify-crushed",
        &(crushed.to_string() + &check("model = \"crushed\"\nquantity = { summary = \"elements\" }\nexpect = 4\ntolerance = 0")),
        &[],
    );
    assert_eq!(answer.code, Some(1), "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("FAILS") && answer.out.contains("time step fell"), "{}", answer.out);
}

#[test]
fn what_has_come_to_rest_stays_as_it_is_until_the_end() {
    // Pulled with 50 MPa: the mean displacement is half of σ L (1 − ν²) / E.
    let pulled = |relaxation: &str| {
        let set = [
            "run.end=40 ms",
            relaxation,
            "part.block.velocity=[0, 0]",
            "constraint=[{ on = \"block.left\", fixed = \"x\" }]",
            "load=[{ on = \"block.right\", pressure = \"-50 MPa\" }]",
        ];
        format!("[variant.pulled]\nset = {set:?}\n")
    };
    let displacement = check(
        "model = \"pulled\"\nquantity = { history = \"P.x\", at = \"40 ms\" }\nminus = { history = \"P.x\", at = 0 }\nexpect = 1.1375e-6\ntolerance_relative = \"0.1 %\"",
    );
    let answer = verify("verify-rest", &(pulled("run.relaxation={ tolerance = 1e-9 }") + &displacement), &["--out", "kept"]);
    assert_eq!(answer.code, Some(0), "{}{}", answer.out, answer.err);
    let summary = fs::read_to_string(Path::new(env!("CARGO_TARGET_TMPDIR")).join("verify-rest/kept/block/pulled/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!((&summary["status"], &summary["rest"]), (&"done".into(), &summary["time_end"]), "{summary}");
    assert!(summary["rest"].as_f64().unwrap() < 2e-3, "{summary}");
    // What was stopped otherwise has ended early.
    let answer = verify("verify-early", &(pulled("run.max_steps=100") + &displacement), &[]);
    assert_eq!(answer.code, Some(1), "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("ended early"), "{}", answer.out);
}

#[test]
fn convergence_is_judged_between_two_models() {
    // Half the velocity: half the deviation from rest.
    let text = |fraction: &str| {
        let variant = "[variant.slow]\nset = [\"part.block.velocity=[0.5, 0]\"]\n";
        let quantity = "model = \"slow\"\nquantity = { history = \"P.vx\", at = 0 }\nexpect = 0";
        format!("{variant}{}", check(&format!("{quantity}\nconverges = {{ model = \"model\", fraction = {fraction} }}")))
    };
    assert_eq!(verify("verify-converges", &text("0.51"), &[]).code, Some(0));
    let answer = verify("verify-converges", &text("0.49"), &[]);
    assert_eq!(answer.code, Some(1), "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("of the error of model") && answer.out.contains("50.00 %"), "{}", answer.out);
}

#[test]
fn cases_are_listed_chosen_and_kept() {
    let text = check("quantity = { summary = \"elements\" }\nexpect = 4\ntolerance = 0").replace("it\"", "elements\"");
    let listed = verify("verify-list", &text, &["--list"]);
    assert!(listed.code == Some(0) && listed.out.contains("block") && listed.out.contains("every"), "{}", listed.out);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("verify-list");
    let kept = embate(&folder, ["verify", "block", "--out", "kept"]);
    assert_eq!(kept.code, Some(0), "{}{}", kept.out, kept.err);
    assert!(folder.join("kept/block/model/summary.json").exists());
    let again = embate(&folder, ["verify", "--out", "kept"]);
    assert!(again.code == Some(2) && again.err.contains("--force"), "{}", again.err);
    assert_eq!(embate(&folder, ["verify", "--out", "kept", "--force"]).code, Some(0));
    let unknown = embate(&folder, ["verify", "blok"]);
    assert!(unknown.code == Some(2) && unknown.err.contains("did you mean `block`"), "{}", unknown.err);
    let nowhere = embate(&folder, ["verify", "--in", "nowhere"]);
    assert!(nowhere.code == Some(2) && nowhere.err.contains("--in DIR"), "{}", nowhere.err);

    let long = folder.join("verification/block/expected.toml");
    fs::write(&long, fs::read_to_string(&long).unwrap().replace("every", "all")).unwrap();
    let none = embate(&folder, ["verify"]);
    assert!(none.code == Some(2) && none.err.contains("--all"), "{}", none.err);
    assert_eq!(embate(&folder, ["verify", "--all"]).code, Some(0));
    assert_eq!(embate(&folder, ["verify", "block"]).code, Some(0));
}
