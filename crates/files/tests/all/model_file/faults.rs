//! Malformed models, each with its messages: line, column, text and help.

use super::{SOUND, changed, faults, read};
use embate_files::model_file::load_text;
use std::path::Path;

/// One changed place of [`SOUND`] and all faults that it must give: `line:column message | help`.
type Case = (&'static str, &'static str, &'static [&'static str]);

const CASES: &[Case] = &[
    // syntax
    (
        "\"1 ms\"",
        "1 ms",
        &[
            "3:7 string values must be quoted, expected literal string | texts and numbers with units stand in quotes, for example \"10 ms\"",
        ],
    ),
    ("[run]", "[run", &["2:5 unclosed table, expected `]` | see https://toml.io for the syntax"]),
    (
        "poisson = 0.3",
        "law = \"j2\"",
        &["7:1 duplicate key | each key and each [section] stands once; [[part]] and its like may be repeated"],
    ),
    // keys
    ("end = ", "edn = ", &["2:1 [run] has no `end` | add `end = \"10 us\"`: end time", "3:1 [run] has no key `edn` | did you mean `end`?"]),
    ("title = ", "titel = ", &["1:1 a model has no key `titel` | did you mean `title`?"]),
    ("[[load]]", "[[loads]]", &["32:3 a model has no key `loads` | did you mean `load`?"]),
    ("end = \"1 ms\"", "end = \"1 ms\"\nvelocity = [0, 0]", &["4:1 [run] has no key `velocity` | `velocity` belongs in [[part]]"]),
    ("end = \"1 ms\"", "end = \"1 ms\"\ntitle = \"a\"", &["4:1 [run] has no key `title` | `title` stands above all sections"]),
    (
        "radius = ",
        "radus = ",
        &["21:8 `disk` has no `radius` | add `radius = \"3 mm\"`: radius", "21:29 `disk` has no key `radus` | did you mean `radius`?"],
    ),
    (
        "yield",
        "yeild",
        &[
            "4:1 [material.steel] has no `yield` | add `yield = \"355 MPa\"`: initial yield stress",
            "9:1 [material.steel] has no key `yeild` | did you mean `yield`?",
        ],
    ),
    ("[[load]]", "[load]", &["32:1 `load` must be written as [[load]] | in double brackets, because there may be several"]),
    ("[run]", "[[run]]", &["2:1 `run` must be written as [run] | "]),
    (
        "[material.steel]",
        "[material]",
        &[
            "5:1 `law` stands in `material` without a name | give it a name: write [material.NAME]",
            "6:1 `young` stands in `material` without a name | give it a name: write [material.NAME]",
            "7:1 `poisson` stands in `material` without a name | give it a name: write [material.NAME]",
            "8:1 `density` stands in `material` without a name | give it a name: write [material.NAME]",
            "9:1 `yield` stands in `material` without a name | give it a name: write [material.NAME]",
            "12:12 there is no material `steel` | there is none",
            "16:12 there is no material `steel` | there is none",
            "20:12 there is no material `steel` | there is none",
        ],
    ),
    // values
    ("\"1 ms\"", "\"1 mss\"", &["3:7 `end`: \"mss\" is not a unit | did you mean `ms`?"]),
    ("\"1 ms\"", "\"1 mm\"", &["3:7 `end` needs a unit of time, but \"1 mm\" is in mm | write it like \"10 us\", or as a number in s"]),
    (
        "\"1 ms\"",
        "\"1\"",
        &["3:7 `end` needs a unit of time, but \"1\" has none | write \"1 s\", or the number without quotes if it is in s"],
    ),
    ("\"1 ms\"", "0", &["3:7 `end` must be greater than 0, but it is 0 s | "]),
    ("\"1 ms\"", "nan", &["3:7 `end` is not a number | give a number that is greater than 0"]),
    ("poisson = 0.3", "poisson = 0.5", &["7:11 `poisson` must be between -1 and 0.5, both excluded, but it is 0.5 | "]),
    ("law = \"j2\"", "law = \"j3\"", &["5:7 `law` can't be \"j3\" | did you mean `j2`?"]),
    ("[1, 40]", "[1, 40.0]", &["13:112 `elements[1]` must be a whole number, but it is 40.0 | write it like `elements = [12, 3]`"]),
    ("[1, 40]", "[1, -40]", &["13:112 `elements[1]` must be at least 1, but it is -40 | "]),
    ("[1, 40]", "[100000, 40000]", &["13:108 the model has more than 100 million elements | take fewer elements"]),
    ("\"3 mm\"]", "\"-3 mm\"]", &["17:56 `size[1]` must be greater than 0, but it is -3 mm | "]),
    // names and references
    (
        "name = \"plate\"",
        "name = \"tube\"",
        &[
            "15:8 the name `tube` is taken by part[0] | give each its own name",
            "23:20 there is no part, side or group `plate` | known are `tube`, `ball`",
            "25:10 there is no part `plate` | known are `tube`, `ball`",
            "30:6 there is no part, side or group `plate.left` | known are `tube`, `ball`",
        ],
    ),
    (
        "name = \"ball\"",
        "name = \"a.b\"",
        &["19:8 the name `a.b` has a character that names can't have: '.' | use letters, digits, `_` and `-`, at most 64 of them"],
    ),
    ("material = \"steel\"", "material = \"stel\"", &["12:12 there is no material `stel` | did you mean `steel`?"]),
    ("\"plate.left\"", "\"plate.leff\"", &["30:6 part `plate` has no side `leff` | did you mean `left`?"]),
    ("\"plate.left\"", "\"tube.begin\"", &["30:6 part `tube` has no side `begin` | known are `inner`, `outer`, `start`, `end`"]),
    (
        "[\"plate\"]",
        "[\"plate\", \"plat\", \"plate\"]",
        &["25:19 there is no part `plat` | did you mean `plate`?", "25:27 part `plate` is named twice | name it once"],
    ),
    // contradictions
    (
        "inner = \"94 mm\"",
        "inner = \"104 mm\"",
        &["13:37 the inner radius 0.104 m is not smaller than the outer radius 0.1 m | swap or correct the radii"],
    ),
    (
        "to = \"90 deg\"",
        "to = \"-90 deg\"",
        &[
            "13:87 it ends at -90 deg, not after its beginning at -90 deg | it runs counter-clockwise: add \"360 deg\" to `to`, or swap the two",
        ],
    ),
    (
        "to = \"90 deg\"",
        "to = \"271 deg\"",
        &["13:87 it runs over 361 deg, more than a full turn | let `to` exceed `from` by at most 360 deg"],
    ),
    (
        "disk = ",
        "rectangle = { corner = [0, 0], size = [1, 1], elements = [1, 1] }\ndisk = ",
        &["22:8 [[part]] has `rectangle` and `disk` at once | leave all but one of them out"],
    ),
    (
        "disk = { centre = [0, 0.1], radius = \"9 mm\", elements = 4 }\n",
        "",
        &[
            "18:1 [[part]] needs one of `rectangle`, `ring`, `disk`, `trapezoid`, `quadrilateral`, `polygon`, `path`, `truss`, `line`, `arc`, `box`, `cylinder`, `tube`, `sphere`, `space_truss` and `mesh` | add one of them",
        ],
    ),
    (
        "[\"tube\", \"plate\"]",
        "[\"tube\", \"tube.inner\"]",
        &[
            "23:11 `tube` and `tube.inner` share a surface | name two different surfaces; for the contact of a body with itself use `bodies = [\"tube\"]`",
        ],
    ),
    (
        "[\"tube\", \"plate\"]\n",
        "[\"tube\", \"plate\"]\n[[contact]]\nbetween = [\"plate\", \"tube\"]\n",
        &["25:11 `plate` and `tube` are already joined by contact[0] | leave one of the two contacts out: their forces would add up"],
    ),
    (
        "[\"tube\", \"plate\"]\n",
        "[\"tube\", \"plate\"]\npenalty = 1\npenalty_scale = 1\n",
        &["25:17 [[contact]] has `penalty` and `penalty_scale` at once | leave one of them out"],
    ),
    (
        "[\"tube\", \"plate\"]\n",
        "[\"tube\", \"plate\"]\nformulation = \"single_pass\"\n",
        &["24:15 a single pass contact needs `slave` | add `slave = \"tube\"`: usually the surface with the finer mesh or the softer body"],
    ),
    (
        "[\"tube\", \"plate\"]\n",
        "[\"tube\", \"plate\"]\nslave = \"tube\"\n",
        &[
            "24:9 `slave` is given, but in a double pass contact both surfaces are slaves | add `formulation = \"single_pass\"`, or leave `slave` out",
        ],
    ),
    (
        "[\"tube\", \"plate\"]\n",
        "[\"tube\", \"plate\"]\nformulation = \"single_pass\"\nslave = \"ball\"\n",
        &["25:9 the slave \"ball\" is not one of the two surfaces | take \"tube\" or \"plate\""],
    ),
    ("normal = [1, 0]", "normal = [0.0, 0]", &["26:20 the normal is zero, so it has no direction | give a vector such as [1, 0]"]),
    ("fixed = \"x\"", "fixed = [\"x\", \"w\"]", &["31:15 `fixed[1]` can't be \"w\" | did you mean `x`?"]),
    (
        "fixed = \"x\"",
        "fixed = [\"x\", \"z\"]",
        &["31:9 there is no `z` in 2D | leave it out, or make the parts solid: `extrude` them, or give them a 3D shape"],
    ),
    (
        "fixed = \"x\"",
        "",
        &["29:1 [[constraint]] needs `fixed`, `velocity`, `displacement`, `acceleration`, `rotation` or `spin` | add one of them"],
    ),
    (
        "fixed = \"x\"",
        "fixed = \"x\"\nvelocity = { x = 0 }",
        &["31:9 component `x` is both fixed and given a velocity | leave it out of one of the two"],
    ),
    ("point = [0, 0]", "", &["34:1 [[probe]] needs one of `point`, `node`, `element` and `set` | add one of them"]),
    ("part = \"tube\"\n", "", &["36:9 [[probe]] has `point` but no `part` | add `part`"]),
    ("point = [0, 0]", "node = 82", &["37:8 part `tube` has 82 nodes, so there is no node 82 | nodes are numbered from 0 to 81"]),
    ("fields = 10", "include = [\"stress\", \"stres\"]", &["39:22 `include[1]` can't be \"stres\" | did you mean `stress`?"]),
    ("fields = 10", "picture_field = \"vonmises\"", &["39:17 `picture_field` can't be \"vonmises\" | did you mean `von_mises`?"]),
    (
        "fields = 10",
        "history = \"1 ps\"",
        &["39:11 this would be written 1000000000 times, more than 100000000 | give a smaller count or a longer interval"],
    ),
    (
        "end = \"1 ms\"",
        "end = \"1 ms\"\nstep_limit = 1",
        &["4:14 the step limit is not smaller than the end time, so no step could be taken | "],
    ),
];

fn shown(text: &str) -> Vec<String> {
    faults(text).iter().map(|fault| format!("{}:{} {} | {}", fault.line, fault.column, fault.message, fault.help)).collect()
}

#[test]
fn each_malformed_model_has_exactly_its_messages() {
    let mut wrong = String::new();
    for (from, to, expected) in CASES {
        let found = shown(&changed(from, to));
        if found != *expected {
            wrong.push_str(&format!("{from:?} -> {to:?}\n  expected {expected:#?}\n  found {found:#?}\n"));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn an_empty_file_gets_a_message_with_what_a_model_needs() {
    let all = shown("");
    assert_eq!(all[0], "0:0 the model has no [run] | How long the simulation runs and what stops it.");
    assert!(all.len() == 3 && all[1].contains("[material.NAME]") && all[2].contains("[[part]]"), "{all:?}");
}

#[test]
fn columns_count_characters_and_lines_may_end_as_on_windows() {
    let text = changed("title = \"all sections\"\n[run]\n", "title = \"µµ\"\r\n[run]\r\n")
        .replace("centre = [0, 0.1]", "centre = [\"0 µm\", \"1 µs\"]");
    let all = shown(&text);
    assert_eq!(all[0], "13:28 `centre[1]` needs a unit of length, but \"1 µs\" is in µs | write it like \"3 mm\", or as a number in m");
}

#[test]
fn a_fault_is_shown_with_file_line_and_excerpt() {
    let diagnostics = read(&changed("\"1 ms\"", "\"1 kg\"")).unwrap_err();
    let expected = "error[E0109]: `end` needs a unit of time, but \"1 kg\" is in kg
 --> model.toml:3:7
  |
3 | end = \"1 kg\"
  |       ^^^^^^
  |
  = help: write it like \"10 us\", or as a number in s

1 fault: nothing was run
";
    assert_eq!(diagnostics.rendered, expected);
    assert_eq!(diagnostics.render(false), expected);
    assert!(diagnostics.render(true).contains("\u{1b}["));
}

#[test]
fn faults_of_overrides_point_at_them() {
    let set = |text: &str| {
        let all = load_text("m", SOUND, Path::new("."), &[text.to_string()]).unwrap_err().entries;
        all.iter().map(|it| format!("{} {}:{} {} | {}", it.file, it.line, it.column, it.message, it.help)).collect::<Vec<_>>()
    };
    for (text, expected) in [
        ("run.end", "--set 1:1 there is no `=` between a key and its value | write it like part.tube.velocity=[0, \"-50 m/s\"]"),
        ("run..end=1", "--set 1:1 \"run..end\" is not the path of a key | write it like part.tube.velocity=[0, \"-50 m/s\"]"),
        ("run.edn=1", "--set 1:1 [run] has no key `edn` | did you mean `end`?"),
        ("runs.end=1", "--set 1:1 a model has no key `runs` | did you mean `run`?"),
        ("run.end.x=1", "--set 1:1 `run.end` is a single value, so it has no `x` | "),
        ("part.tub.velocity=[0, 0]", "--set 1:1 `part` has no `tub` | did you mean `tube`?"),
        ("part.7.velocity=[0, 0]", "--set 1:1 `part` has no `7` | numbers run from 0 to 2"),
        ("run.end=1 kg", "--set 1:9 `end` needs a unit of time, but \"1 kg\" is in kg | write it like \"10 us\", or as a number in s"),
        ("part.0.material=stel", "--set 1:17 there is no material `stel` | did you mean `steel`?"),
    ] {
        assert_eq!(set(text), [expected], "{text}");
    }
    let without = SOUND.replace("[[symmetry]]\nnormal = [1, 0]\n", "");
    let fault = &load_text("m", &without, Path::new("."), &["symmetry.0.normal=[1, 0]".to_string()]).unwrap_err().entries[0];
    assert_eq!(fault.message, "the model has no [[symmetry]]");
}

/// A folder with the smallest of Gmsh files: a square `block`, its upper side `upper`.
fn mesh_folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"upper\"\n2 1 \"block\"\n$EndPhysicalNames\n\
        $Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n2\n1 1 2 2 3 3 4\n2 3 2 1 1 1 2 3 4\n$EndElements\n";
    std::fs::write(folder.path().join("block.msh"), mesh).expect("a file");
    std::fs::write(folder.path().join("none.msh"), "nothing").expect("a file");
    folder
}

#[test]
fn parts_and_surfaces_come_from_mesh_files() {
    let folder = mesh_folder();
    let base = changed(
        "disk = { centre = [0, 0.1], radius = \"9 mm\", elements = 4 }",
        "mesh = { file = \"block.msh\", group = \"block\", scale = \"1 mm\" }",
    );
    let base = base.replace("\"plate.left\"", "\"upper\"");
    let model = load_text("m", &base, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
    assert_eq!((model.meshes.len(), model.meshes[0].positions[2]), (1, [1e-3, 1e-3, 0.0]));
    let twice = format!(
        "{base}[[part]]\nname = \"more\"\nmaterial = \"steel\"\nmesh = {{ file = \"block.msh\", group = \"block\", scale = 0.001 }}\n"
    );
    assert_eq!(load_text("m", &twice, folder.path(), &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}")).meshes.len(), 1);
    let found = |text: &str| {
        let all = load_text("m", text, folder.path(), &[]).map_or_else(|diagnostics| diagnostics.entries, |_| Vec::new());
        all.iter().map(|it| format!("{}:{} {}", it.line, it.column, it.message)).collect::<Vec<_>>()
    };
    let only = |text: &str, begins: &str, ends: &str| {
        let all = found(text);
        assert!(all.len() == 1 && all[0].starts_with(begins) && all[0].ends_with(ends), "{all:?}");
    };
    only(&base.replace("\"block\"", "\"blok\""), "21:38 ", " has no group `blok`");
    only(&base.replace("\"block\"", "\"upper\""), "21:38 `upper` in ", " is a group of lines, not of surfaces");
    assert_eq!(found(&base.replace("block.msh", "blok.msh")), ["21:17 there is no file \"blok.msh\""]);
    let nothing = found(&base.replace("block.msh", "none.msh"));
    assert!(!nothing.is_empty() && nothing.iter().all(|it| it.starts_with("21:17 \"none.msh\"")), "{nothing:?}");
    assert_eq!(found(&base.replace("\"upper\"", "\"uper\"")), ["30:6 there is no part, side or group `uper`"]);
    let contact = base.replace("[\"tube\", \"plate\"]", "[\"tube\", \"block\"]");
    assert_eq!(found(&contact), ["23:20 group `block` is a group of surfaces, not lines"]);
}

#[test]
fn a_missing_parameter_is_one_fault_and_nothing_follows_from_it() {
    for (eos, missing) in [
        ("eos = \"linear\"", "bulk_modulus"),
        ("eos = \"mie_gruneisen\"\ns1 = 1.5\ngamma0 = 2", "c0"),
        ("eos = \"polynomial\"", "coefficients"),
        ("eos = \"jwl\"\npressure_b = 1e9\nr1 = 4\nr2 = 1\nomega = 0.3\nenergy_initial = 1e9", "pressure_a"),
    ] {
        let found = faults(&changed("young = \"200 GPa\"", &format!("young = \"200 GPa\"\n{eos}")));
        let reported: Vec<String> = found.iter().map(|fault| format!("{} {}", fault.kind.code, fault.message)).collect();
        assert!(matches!(&reported[..], [one] if one.starts_with("E0107") && one.contains(&format!("`{missing}`"))), "{eos}: {reported:?}");
    }
}
