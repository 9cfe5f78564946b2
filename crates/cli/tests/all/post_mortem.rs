//! Post-mortems: each failure of `failures/` names its failure location, with pictures that are whole and
//! keys that can be found.

use crate::{Answer, embate, fresh};
use std::fs;
use std::path::{Path, PathBuf};

/// A failure: its folder, its code, its failure location, and two of the keys to change with the lines on
/// which they stand.
struct Failure {
    name: &'static str,
    code: &'static str,
    failure_location: &'static str,
    keys: [(&'static str, &'static str); 2],
    /// Pictures that must be there.
    pictures: &'static [&'static str],
}

/// Pictures of a run that failed after some steps.
const ALL: &[&str] = &["place.svg", "neighbourhood.svg", "failure-location.svg", "energies.svg"];

const FAILURES: &[Failure] = &[
    Failure {
        name: "inverted-element",
        code: "E0601",
        failure_location: "element 181 of part \"pad\"",
        keys: [("part[0].rectangle.elements", "[24, 8]"), ("obstacle[0].motion", "\"-150 m/s\"")],
        pictures: ALL,
    },
    Failure {
        name: "inverted-solid",
        code: "E0601",
        failure_location: "element 1430 of part \"pad\"",
        keys: [("part[0].box.elements", "[16, 16, 6]"), ("obstacle[0].motion", "\"-150 m/s\"")],
        pictures: ALL,
    },
    Failure {
        name: "collapsed-step",
        code: "E0602",
        failure_location: "element 0 of part \"bar\"",
        keys: [("part[0].velocity", "[0, \"-550 m/s\"]"), ("run.step_limit", "\"8 ns\"")],
        pictures: ALL,
    },
    Failure {
        name: "energy-drift",
        code: "E0603",
        failure_location: "contact \"hit\" at node 76 of part \"ball\"",
        keys: [("contact[0].penalty_scale", "1e6"), ("contact[0].formulation", "\"segment\"")],
        pictures: ALL,
    },
    Failure {
        name: "not-finite",
        code: "E0604",
        failure_location: "node 20 of part \"strip\"",
        keys: [("constraint[1].velocity", "\"measured\""), ("curve.measured.value", "1.797693e308 m/s")],
        pictures: ALL,
    },
    Failure {
        name: "mass-scaling",
        code: "E0605",
        failure_location: "of part \"skin\"",
        keys: [("run.mass_scaling.time_step", "\"100 ns\""), ("part[1].rectangle.elements", "[80, 4]")],
        pictures: &["place.svg", "neighbourhood.svg", "mass.svg"],
    },
    Failure {
        name: "deep-contact",
        code: "E0606",
        failure_location: "contact \"landing\" at node ",
        keys: [("contact[0].penalty_scale", "1e-6"), ("part[0].velocity", "[0, \"-20 m/s\"]")],
        pictures: ALL,
    },
    Failure {
        name: "runaway",
        code: "E0607",
        failure_location: "of part \"weight\"",
        keys: [("load[0].gravity", "[0, \"-9.81 Gm/s^2\"]"), ("material.lead", "[material.lead]")],
        pictures: ALL,
    },
    Failure {
        name: "memory",
        code: "E0608",
        failure_location: "**part \"plate\"** with 4000000 of 4000100 elements",
        keys: [("part[0].rectangle.elements", "[4000, 1000]"), ("run.memory_limit", "\"1 GB\"")],
        pictures: &[],
    },
];

fn failures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../failures")
}

fn run(folder: &Path, name: &str, more: &[&str]) -> Answer {
    let model = failures().join(name);
    let all = ["run", model.to_str().unwrap(), "--out", "out", "--threads", "1"];
    embate(folder, all.iter().chain(more))
}

/// Targets of all links and pictures of a page.
fn links(page: &str) -> Vec<&str> {
    page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect()
}

/// What is wrong with the form of an SVG file, if anything: tags that don't close, quotes that don't, numbers
/// that are none.
fn fault_of_svg(text: &str) -> Option<String> {
    let mut open: Vec<&str> = Vec::new();
    let body = text.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n")?;
    for piece in body.split('<').skip(1) {
        let Some((tag, after)) = piece.split_once('>') else { return Some(format!("a tag does not end: {piece:.60}")) };
        if after.contains('&') && !["&amp;", "&lt;", "&gt;", "&quot;", "&#39;"].iter().any(|entity| after.contains(entity)) {
            return Some(format!("a bare & in {after:.60}"));
        }
        // An image's bytes are letters of any kind.
        let written = tag.split(";base64,").next().unwrap_or_default();
        if tag.matches('"').count() % 2 == 1 || written.contains("NaN") || written.contains("inf") {
            return Some(format!("<{tag}>"));
        }
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap_or_default();
        if tag.starts_with('/') {
            if open.pop() != Some(name) {
                return Some(format!("<{tag}> closes nothing"));
            }
        } else if !tag.ends_with('/') {
            open.push(name);
        }
    }
    if open.is_empty() { None } else { Some(format!("left open: {open:?}")) }
}

/// The row of a page's table that begins with a key.
fn row<'a>(page: &'a str, key: &str) -> Option<&'a str> {
    page.lines().find(|line| line.starts_with(&format!("| `{key}` |")))
}

#[test]
fn each_failure_has_an_example_whose_page_names_the_failure_location_and_the_keys_to_change() {
    let mut names: Vec<String> = fs::read_dir(failures())
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    names.sort();
    let mut listed: Vec<&str> = FAILURES.iter().map(|failure| failure.name).collect();
    listed.sort_unstable();
    assert_eq!(names, listed);
    let read_me = fs::read_to_string(failures().join("README.md")).unwrap();
    for Failure { name, code, failure_location, keys, pictures } in FAILURES {
        let folder = fresh(&format!("post-mortem-{name}"));
        let answer = run(&folder, name, &[]);
        assert!(answer.code.is_some_and(|code| code != 0) && answer.err.contains(&format!("error[{code}]")), "{name}: {}", answer.err);
        assert!(answer.err.contains("post-mortem: out/post-mortem/README.md"), "{name}: {}", answer.err);
        assert!(read_me.contains(&format!("`{name}`")) && read_me.contains(code), "{name} is not in failures/README.md");
        let results = folder.join("out");
        let page = fs::read_to_string(results.join("post-mortem/README.md")).unwrap();
        let named = page.lines().find(|line| line.contains("**failure location**")).unwrap_or_default();
        assert!(named.contains(failure_location) && page.contains(&format!("({code})")), "{name}: {named}");
        let model = fs::read_to_string(failures().join(name).join("model.toml")).unwrap();
        for (key, value) in keys {
            let row = row(&page, key).unwrap_or_else(|| panic!("{name}: no {key} in\n{page}"));
            let (_, line) = row.split_once("model.toml, line ").unwrap_or_else(|| panic!("{name}: {row}"));
            let line: usize = line.split_once(' ').unwrap().0.parse().unwrap();
            let there = model.lines().nth(line - 1).unwrap();
            let (_, last) = key.rsplit_once('.').unwrap();
            assert!(there.contains(last) && there.contains(value) && row.contains(value), "{name}: {row}\n{there}");
        }
        let linked = links(&page);
        for picture in *pictures {
            assert!(linked.contains(picture), "{name}: no {picture} in {linked:?}");
        }
        for link in linked {
            let text = fs::read_to_string(results.join("post-mortem").join(link)).unwrap_or_else(|_| panic!("{name}: {link} is not there"));
            assert_eq!(fault_of_svg(&text), None, "{name}: {link}");
        }
        assert!(!page.contains("NaN") && !results.join("post-mortem.part").exists(), "{name}");
        if results.join("history.csv").exists() {
            let summary: serde_json::Value = serde_json::from_str(&fs::read_to_string(results.join("summary.json")).unwrap()).unwrap();
            assert_eq!(
                (summary["status"].as_str(), summary["post_mortem"].as_str()),
                (Some("failed"), Some("post-mortem/README.md")),
                "{name}"
            );
            let near = fs::read_to_string(results.join("post-mortem/neighbourhood.svg")).unwrap();
            assert!(near.contains("the step that failed") && near.contains("the last good step"), "{name}");
        }
    }
}

#[test]
fn pictures_of_solids_are_cut_open_to_the_failure_location_and_number_it() {
    let folder = fresh("post-mortem-solids");
    let answer = run(&folder, "inverted-solid", &["--quiet", "--set", "output.pictures=false"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    let picture = |name: &str| fs::read_to_string(folder.join("out/post-mortem").join(name)).unwrap();
    let near = picture("neighbourhood.svg");
    // Four panels, each with its image and with the failure location's number on one of its sides.
    assert_eq!((near.matches("<image ").count(), near.matches("data:image/png;base64,iVBORw0KGgo").count()), (4, 4));
    assert_eq!(near.matches("font-weight=\"bold\">1430</text>").count(), 4);
    assert!(near.contains("cut open: ") && near.contains("contact force, up to "));
    let place = picture("place.svg");
    assert!(place.matches("<image ").count() == 1 && place.contains(">element 1430</text>") && place.contains(" mm</text>"));
}

#[test]
fn a_page_goes_when_its_run_is_replaced_or_comes_to_its_end() {
    let folder = fresh("post-mortem-gone");
    let page = folder.join("out/post-mortem/README.md");
    let checkpoints = ["--quiet", "--set", "run.checkpoint_steps=100", "--set", "output.pictures=false", "--set", "run.max_steps=260"];
    assert_eq!(run(&folder, "collapsed-step", &checkpoints).code, Some(1));
    assert!(page.exists());
    fs::write(folder.join("out/post-mortem/note.txt"), "mine").unwrap();
    let answer = embate(&folder, ["resume", "out", "--quiet", "--set", "run.step_limit=\"0.1 ns\""]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(!page.exists() && folder.join("out/post-mortem/note.txt").exists(), "what embate has not made stays");
    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    assert!(!summary.contains("post_mortem"), "{summary}");

    assert_eq!(run(&folder, "collapsed-step", &["--quiet", "--force"]).code, Some(1));
    assert!(page.exists());
    assert_eq!(run(&folder, "collapsed-step", &["--quiet", "--force", "--set", "run.max_steps=20"]).code, Some(0));
    assert!(!page.exists());

    // A page of a model that could not begin is no result that is in the way.
    let folder = fresh("post-mortem-begun");
    assert_eq!(run(&folder, "mass-scaling", &[]).code, Some(2));
    assert!(folder.join("out/post-mortem/README.md").exists());
    let answer = run(
        &folder,
        "mass-scaling",
        &["--quiet", "--set", "run.mass_scaling.limit=2", "--set", "run.max_steps=3", "--set", "output.pictures=false"],
    );
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(!folder.join("out/post-mortem").exists());
}

#[test]
fn a_page_that_cannot_be_written_hides_nothing() {
    let folder = fresh("post-mortem-refused");
    fs::create_dir_all(folder.join("out")).unwrap();
    fs::write(folder.join("out/post-mortem"), "a file").unwrap();
    let answer = run(&folder, "inverted-element", &["--set", "output.pictures=false"]);
    assert!(answer.code == Some(1) && answer.err.contains("error[E0601]: element 181"), "{}", answer.err);
    assert!(answer.err.contains("warning[W0702]: the post-mortem is missing: "), "{}", answer.err);
    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    assert!(summary.contains("E0601: element 181") && !summary.contains("post_mortem"), "{summary}");
}

#[test]
fn looking_at_a_failure_changes_nothing_of_its_results() {
    let folder = fresh("post-mortem-same");
    let answer = run(&folder, "inverted-element", &["--quiet"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    let figures = |out: &str| -> serde_json::Value {
        serde_json::from_str(&fs::read_to_string(folder.join(out).join("summary.json")).unwrap()).unwrap()
    };
    let failed = figures("out");
    // On other threads and another instruction set: the same failure with the same page.
    let page = fs::read_to_string(folder.join("out/post-mortem/README.md")).unwrap();
    let picture = fs::read(folder.join("out/post-mortem/neighbourhood.svg")).unwrap();
    let model = failures().join("inverted-element");
    let answer = embate(&folder, ["run", model.to_str().unwrap(), "--out", "other", "--quiet", "--threads", "3", "--simd", "scalar"]);
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    assert_eq!(figures("other")["state_hash"], failed["state_hash"]);
    assert!(fs::read_to_string(folder.join("other/post-mortem/README.md")).unwrap() == page);
    assert!(fs::read(folder.join("other/post-mortem/neighbourhood.svg")).unwrap() == picture);
}

#[test]
fn a_model_that_can_not_begin_leaves_no_folder_and_takes_no_results_away() {
    let folder = fresh("post-mortem-no-begin");
    fs::write(folder.join("flight.toml"), crate::FLIGHT).unwrap();
    let run = |out: &str, set: &[&str]| {
        let set = set.iter().flat_map(|set| ["--set", set]);
        embate(&folder, ["run", "flight.toml", "--quiet", "--out", out].into_iter().chain(set))
    };
    // Inside an obstacle at the start; elements that are inside out at rest; an impossible value.
    let inside = "obstacle=[{ name = \"wall\", plane = { point = [0.005, 0], normal = [1, 0] } }]";
    let inverted = "part=[{ name = \"block\", material = \"steel\", velocity = [1, 0], quadrilateral = { corners = [[0, 0], [0.01, 0], \
                    [0.001, 0.001], [0, 0.01]], elements = [3, 3] } }]";
    assert_eq!(run("kept", &[]).code, Some(0));
    let summary = fs::read(folder.join("kept/summary.json")).unwrap();
    for (set, code) in [(inside, "E0407"), (inverted, "E0201"), ("material.steel.poisson=0.5", "E0110")] {
        for out in ["none", "kept"] {
            let answer = run(out, &[set]);
            assert_eq!(answer.code, Some(2), "{set}: {}", answer.err);
            assert!(answer.err.contains(code) && answer.err.contains("nothing was run"), "{set}: {}", answer.err);
            assert!(!answer.err.contains("post-mortem"), "{set}: {}", answer.err);
        }
        assert!(!folder.join("none").exists(), "{set}");
        assert!(fs::read(folder.join("kept/summary.json")).unwrap() == summary && !folder.join("kept/post-mortem").exists(), "{set}");
    }
}
