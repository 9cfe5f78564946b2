//! Reports of folders as runs leave them, half finished, damaged, and with names that would be code of a
//! page.

use embate_files::report::{REPORT, page, write};
use embate_files::results::ResultsError;
use std::fs;
use std::path::{Path, PathBuf};

const SUMMARY: &str = r#"{"status": "done", "error": null, "model": "tube", "version": "0.1.0", "parts": ["bar"], "threads": 2, "simd": "avx2", "elements": 4, "nodes": 9,
"steps": 120, "time_end": 1e-4, "wall_seconds": 0.5, "element_steps_per_second": 2e6, "stable_time_step_min": 8e-7, "stable_time_step_governor": "element 3 of part \"bar\"",
"energy_drift": 1e-5, "ledger_residual": 2e-15, "momentum_drift": {"linear": 1e-16, "angular": null}, "penetration_max": 1e-6,
"contact": {"pairs_swept": 100, "crossings_found": 3, "unverified": 0}, "mass_added": 0.25, "erosion": {"elements": {"bar": 2}, "mass_loose": 0.1},
"state_hash": "00ff00ff00ff00ff", "warnings": ["W0611: part \"bar\": hourglass energy is 10 %"]}"#;

const RUN: &str = r#"{"version": "0.1.0", "model": "/models/a tube.toml", "set": ["run.end=\"5 ms\""], "keys": {"name": "\"tube\"", "part[0].name": "\"bar\"",
"part[0].element": "\"quad4\"", "part[0].material": "\"steel\"", "material.steel.law": "\"elastic\"", "material.steel.parameters.young": "200000000000.0",
"contact[0].name": "\"hit\"", "contact[0].formulation": "Segment", "contact[0].interface.law.kind": "Automatic"}}"#;

const HISTORY: &str = "time,time_step,energy.kinetic,energy.internal,energy.total,contact.force_x[hit],P.x\n0,1e-6,50,0,50,0,0\n5e-5,1e-6,30,20,50,7,1e-3\n1e-4,1e-6,45,5,50,0,2e-3\n";

/// A folder of one test with these files.
fn folder(name: &str, files: &[(&str, &[u8])]) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("report-{name}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    files.iter().for_each(|(name, bytes)| fs::write(path.join(name), bytes).unwrap());
    path
}

fn of(name: &str, files: &[(&str, &str)]) -> Result<String, ResultsError> {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    page(&folder(name, &files))
}

/// Elements that have no end.
const VOID: [&str; 3] = ["meta", "img", "!DOCTYPE"];

/// Each element ends, in the order in which all began; nothing acts, and nothing is fetched.
fn assert_is_sound(page: &str) {
    for forbidden in ["<script", "http://", "https://", " src=\"//", "javascript:", " onload", "@import", "url("] {
        assert!(!page.contains(forbidden), "{forbidden}");
    }
    let mut open: Vec<&str> = Vec::new();
    for tag in page.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').unwrap();
        let name = tag.trim_start_matches('/').split([' ', '/', '\n']).next().unwrap();
        match tag.starts_with('/') {
            true => assert_eq!(open.pop(), Some(name), "<{tag}> ends another element"),
            false if !VOID.contains(&name) && !tag.ends_with('/') => open.push(name),
            false => {}
        }
    }
    assert!(open.is_empty(), "{open:?}");
    assert!(page.split("<img").skip(1).all(|image| image.split('>').next().unwrap().contains(" alt=\"")), "a picture is not told in words");
}

#[test]
fn a_report_has_all_that_the_run_left() {
    let files: [(&str, &[u8]); 5] = [
        ("summary.json", SUMMARY.as_bytes()),
        ("run.json", RUN.as_bytes()),
        ("history.csv", HISTORY.as_bytes()),
        ("final.png", b"\x89PNG\r\n\x1a\nxyz"),
        ("animation.gif", b"GIF89axyz"),
    ];
    let page = page(&folder("whole", &files)).unwrap();
    assert_is_sound(&page);
    let parts = [
        "<h1>tube</h1>",
        "status good\">done",
        "embate run &#39;/models/a tube.toml&#39; --set &#39;run.end=&quot;5 ms&quot;&#39;",
        "version 0.1.0",
        "00ff00ff00ff00ff",
        "2, avx2",
        "<details><summary>All 9 keys",
        "young 200 GPa",
        "<td>hit</td>",
        "data:image/png;base64,iVBORw0KGgp4eXo=",
        "data:image/gif;base64,R0lGODlheHl6",
        "50 J/m",
        "-5 J/m",
        "no more than rounding",
        "aria-label=\"Energies over time",
        "contact force x",
        "hourglass energy is 10 %",
        "embate explain W0611",
        "element 3 of part &quot;bar&quot;",
        "100 pairs checked",
        "2 of part &quot;bar&quot;",
        "250 g/m",
        "1.0e-16",
        "2.000 million",
    ];
    for part in parts {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

#[test]
fn what_was_chosen_is_shown_as_it_is_written_with_what_holds_where_nothing_is() {
    let written = r#""appearance": {"title": "A tube falls", "dimension": 2, "axisymmetric": false, "end": 5e-3, "parts": [], "obstacles": [],
        "contacts": [], "mirror": [false, false, false], "field": "", "camera": null},
        "written": [["title", "\"A tube falls\""], ["run.end", "\"5 ms\""], ["material.steel.law", "\"elastic\""], ["material.steel.young", "\"200 GPa\""],
        ["part[0].name", "\"bar\""], ["part[0].rectangle.size", "[\"10 mm\", \"5 mm\"]"], ["part[0].velocity", "[0, \"-5 m/s\"]"],
        ["contact[0].name", "\"hit\""], ["contact[0].between", "[\"bar\", \"<b>\"]"], ["load[0].gravity", "[0, \"-9.81 m/s^2\"]"],
        ["symmetry[0].normal", "[1, 0]"]],
        "parts": [{"name": "bar", "elements": [["quad4", 1200], ["tri3", 7]], "nodes": 1300, "mass": 2.5, "sizes": [1e-3, 2e-3], "shape": 0.04, "worst": [0.5, 0.25], "stable_time_step": 1e-7}],
        "keys""#;
    let run = RUN
        .replacen("\"keys\"", written, 1)
        .replace("\"part[0].element\"", "\"part[0].stress_state\": \"\\\"plane_strain\\\"\", \"part[0].element\"");
    let page = of("chosen", &[("summary.json", SUMMARY), ("run.json", &run)]).unwrap();
    assert_is_sound(&page);
    for part in [
        "<h1>A tube falls</h1>",
        "<td>bar</td><td>1,200 quad4, 7 tri3</td><td class=\"n\">1,300</td>",
        "1 mm to 2 mm",
        "The worst element of part &quot;bar&quot;, at (0.5 m, 0.25 m), has the shape 0.040.",
        "<td>rectangle size</td><td>[10 mm, 5 mm]</td>",
        "<td>stress state</td><td>plane_strain (default)</td>",
        "<h3>Initial state</h3>\n<div class=\"chosen\"><div class=\"scroll\"><table><thead><tr><th scope=\"col\">name</th><th scope=\"col\">key</th><th scope=\"col\">value</th></tr></thead><tbody>\n<tr><td>bar</td><td>velocity</td><td>[0, -5 m/s]</td></tr>",
        "<td>hit</td><td>between</td><td>[bar, &lt;b&gt;]</td>",
        "<td>friction</td><td>none (default)</td>",
        "<td>formulation</td><td>segment (default)</td>",
        "<td>load 1</td><td>gravity</td><td>[0, -9.81 m/s^2]</td>",
        "<h3>Supports and prescribed motion</h3>",
        "<td>symmetry 1</td><td>normal</td><td>[1, 0]</td>",
        "the state hash is <code>00ff00ff00ff00ff</code> again",
    ] {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

#[test]
fn names_that_are_code_of_a_page_are_shown_as_text() {
    let evil = "</title><script>alert(1)</script><img src=x onerror=alert(1)>\\\"'";
    let summary = SUMMARY.replace("\"tube\"", &format!("\"{evil}\"")).replace("W0611: part", &format!("W0611: {evil}"));
    let run = RUN.replace("\\\"bar\\\"", &format!("\\\"{}\\\"", evil.replace('\\', "\\\\\\"))).replace("a tube", "<script>");
    let page =
        of("escape", &[("summary.json", &summary), ("run.json", &run), ("history.csv", &HISTORY.replace("[hit]", "[<script>]"))]).unwrap();
    assert_is_sound(&page);
    assert!(page.contains("<h1>&lt;/title&gt;&lt;script&gt;alert(1)") && page.contains("/models/&lt;script&gt;.toml"), "{page}");
}

#[test]
fn a_failed_run_is_reported_with_its_error_and_its_post_mortem() {
    let error = "\"failed\", \"post_mortem\": \"post-mortem/README.md\"";
    let summary =
        SUMMARY.replace("\"done\"", error).replace("\"error\": null", "\"error\": \"E0601: element 3 of part <bar> turned inside out\"");
    let page = of("failed", &[("summary.json", &summary)]).unwrap();
    assert_is_sound(&page);
    for part in [
        "status bad\">failed",
        "part &lt;bar&gt; turned",
        "embate explain E0601",
        "<code>post-mortem/README.md</code>",
        "no <code>run.json</code>",
    ] {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

#[test]
fn a_run_that_continues_is_reported_as_one_with_what_it_has_so_far() {
    let page = of("grows", &[("run.json", RUN), ("history.csv.part", &format!("{HISTORY}2e-4,1e-6,4"))]).unwrap();
    assert_is_sound(&page);
    for part in ["the run continues, or was cut off", "100 µs", "<th scope=\"col\" class=\"n\">now</th>", "none yet"] {
        assert!(page.contains(part), "{part}\n{page}");
    }
    assert!(!page.contains("Figures of the run"));
    assert_is_sound(&of("begins", &[("run.json", RUN), ("history.csv.part", "tim")]).unwrap());
}

#[test]
fn pictures_that_are_too_large_or_damaged_are_left_out_and_this_is_said() {
    let folder = folder("pictures", &[("summary.json", SUMMARY.as_bytes()), ("final.png", b"\x89PN")]);
    fs::File::create(folder.join("animation.gif")).unwrap().set_len((8 << 20) + 1).unwrap();
    let page = page(&folder).unwrap();
    assert!(page.contains("final.png (the last frame) is left out: the file is damaged"), "{page}");
    assert!(page.contains("animation.gif (the bodies in motion) is left out here: it has 8.0 MiB") && !page.contains("<img"));
}

#[test]
fn folders_that_are_none_of_a_run_and_damaged_files_are_refused_with_place_and_reason() {
    let says = |name: &str, files: &[(&str, &str)]| {
        let error = of(name, files).unwrap_err();
        (error.kind().code, error.to_string())
    };
    let (code, text) = says("foreign", &[("notes.txt", "")]);
    assert!(code == "E0722" && text.contains("holds no results of embate") && text.contains("give the folder"), "{text}");
    let (code, text) = says("broken-summary", &[("summary.json", "{\n\"status\": ")]);
    assert!(code == "E0721" && text.contains("summary.json, line 2"), "{text}");
    let (code, text) = says("no-summary", &[("summary.json", "[3]")]);
    assert!(code == "E0721" && text.contains("no summary of a run"), "{text}");
    let (code, text) = says("broken-run", &[("run.json", "7")]);
    assert!(code == "E0721" && text.contains("run.json, line 1"), "{text}");
    let (code, text) = says("broken-history", &[("summary.json", SUMMARY), ("history.csv", &HISTORY.replace("30", "3o"))]);
    assert!(code == "E0721" && text.contains("history.csv, line 3: `3o` is no number"), "{text}");
    assert_eq!(page(&folder("file", &[("a", b"")]).join("a")).unwrap_err().kind().code, "E0703");
    assert_eq!(page(Path::new("/nowhere/at/all")).unwrap_err().kind().code, "E0722");
}

#[test]
fn nothing_is_written_where_the_report_fails_and_an_older_one_stays() {
    let folder = folder("old", &[("summary.json", b"{"), (REPORT, b"old")]);
    write(&folder, &folder.join(REPORT)).unwrap_err();
    assert_eq!(fs::read(folder.join(REPORT)).unwrap(), b"old");
    fs::write(folder.join("summary.json"), SUMMARY).unwrap();
    write(&folder, &folder.join(REPORT)).unwrap();
    assert!(fs::read_to_string(folder.join(REPORT)).unwrap().starts_with("<!DOCTYPE html>"));
    assert!(!folder.join("report.html.part").exists());
}

#[test]
fn no_damage_panics_and_what_is_written_of_it_is_sound() {
    // xorshift: the same bytes on each machine.
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let whole = [("summary.json", SUMMARY), ("run.json", RUN), ("history.csv", HISTORY)];
    let mut reported = 0;
    for round in 0..600 {
        let mut files: Vec<(&str, Vec<u8>)> = whole.iter().map(|(name, text)| (*name, text.as_bytes().to_vec())).collect();
        let bytes = &mut files[round % 3].1;
        match round % 4 {
            0 => bytes.truncate(random() as usize % bytes.len()),
            1 => bytes.iter_mut().for_each(|byte| *byte = random() as u8),
            _ => (0..3).for_each(|_| {
                let at = random() as usize % bytes.len();
                bytes[at] = b"0123456789eE-+.,\"'<>[]{}:n\n\xff"[random() as usize % 28];
            }),
        }
        let files: Vec<(&str, &[u8])> = files.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
        match page(&folder("damage", &files)) {
            Ok(page) => assert_is_sound(&page),
            Err(error) => reported += usize::from(["E0721", "E0722"].contains(&error.kind().code)),
        }
    }
    assert!(reported > 300, "{reported}");
    let odd = SUMMARY
        .replace("1e-5", "1e308")
        .replace("\"done\"", "7")
        .replace("{\"bar\": 2}", "{\"bar\": \"x\"}")
        .replace("[\"W0611", "[null, \"W0611");
    let lonely = HISTORY.replace("\n0,", "\nNaN,").replace("50,7", "inf,-1e308");
    assert_is_sound(&of("odd", &[("summary.json", &odd), ("history.csv", &lonely)]).unwrap());
    assert_is_sound(&of("empty", &[("summary.json", "{}"), ("history.csv", "time\n")]).unwrap());
}
