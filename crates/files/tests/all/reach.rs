//! Files that a model or a deck names lie in its folder, unless leave is given to go outside; where a path
//! ends decides.

use embate_files::abaqus::import::{Units, import};
use embate_files::model_file::{Diagnostics, load, load_text, load_with_places};
use embate_files::{PathPolicy, abaqus};
use std::fs;
use std::path::{Path, PathBuf};

const MESH: &str = "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPE3, ELSET=body\n1, 1, 2, 3\n";

/// A folder with a mesh beside it, and in it a model's folder with a mesh, and one below.
fn laid_out(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("model/below")).unwrap();
    ["mesh.inp", "model/mesh.inp", "model/below/mesh.inp"].iter().for_each(|file| fs::write(folder.join(file), MESH).unwrap());
    folder.canonicalize().unwrap()
}

fn model(file: &str) -> String {
    let file = file.replace('\\', "\\\\");
    format!(
        "run.end = \"1 ms\"\nmaterial.m = {{ law = \"elastic\", density = 1, young = 1, poisson = 0 }}\n\n\
         [[part]]\nname = \"p\"\nmaterial = \"m\"\nmesh = {{ file = \"{file}\", group = \"body\" }}\n"
    )
}

/// Reads a model whose mesh is this file.
fn named(folder: &Path, file: &str, reach: PathPolicy) -> Result<(), Diagnostics> {
    let path = folder.join("model/model.toml");
    fs::write(&path, model(file)).unwrap();
    load_with_places(&path, &[], reach).map(drop)
}

/// It is refused with its place, reason and remedy, and read where leave is given.
#[track_caller]
fn is_outside(folder: &Path, file: &str, reason: &str) {
    let reported = named(folder, file, PathPolicy::Folder).unwrap_err();
    let [fault] = &reported.entries[..] else { panic!("{}", reported.rendered) };
    assert_eq!(
        (fault.kind.code, fault.line, fault.column, fault.path.as_str()),
        ("E0124", 7, 17, "part[0].mesh.file"),
        "{}",
        reported.rendered
    );
    assert!(fault.message.contains("leads out of the model's folder") && fault.message.contains(reason), "{}", reported.rendered);
    assert!(reported.rendered.contains("mesh = { file = ") && fault.help.contains("--allow-outside"), "{}", reported.rendered);
    named(folder, file, PathPolicy::Anywhere).unwrap_or_else(|reported| panic!("{}", reported.rendered));
}

#[track_caller]
fn is_inside(folder: &Path, file: &str) {
    named(folder, file, PathPolicy::Folder).unwrap_or_else(|reported| panic!("{}", reported.rendered));
}

#[test]
fn dots_that_lead_out_are_refused_and_those_that_come_back_are_not() {
    let folder = laid_out("reach-dots");
    is_outside(&folder, "../mesh.inp", "\"../mesh.inp\"");
    is_outside(&folder, "below/../../mesh.inp", "");
    is_outside(&folder, "./.././mesh.inp", "");
    is_inside(&folder, "mesh.inp");
    is_inside(&folder, "./below/../below/mesh.inp");
    is_inside(&folder, "../model/mesh.inp");
}

#[test]
fn a_folder_whose_name_begins_alike_is_another() {
    let folder = laid_out("reach-alike");
    fs::create_dir_all(folder.join("model-2")).unwrap();
    fs::write(folder.join("model-2/mesh.inp"), MESH).unwrap();
    is_outside(&folder, "../model-2/mesh.inp", "");
}

#[test]
fn an_absolute_path_is_taken_where_it_ends_inside() {
    let folder = laid_out("reach-absolute");
    is_outside(&folder, folder.join("mesh.inp").to_str().unwrap(), "");
    is_inside(&folder, folder.join("model/below/mesh.inp").to_str().unwrap());
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_their_end_decides() {
    use std::os::unix::fs::symlink;
    let folder = laid_out("reach-links");
    let own = folder.join("model");
    symlink("../mesh.inp", own.join("out.inp")).unwrap();
    symlink(&folder, own.join("up")).unwrap();
    symlink("below/mesh.inp", own.join("in.inp")).unwrap();
    symlink("out.inp", own.join("twice.inp")).unwrap();
    symlink("below", own.join("down")).unwrap();
    let end = format!(", by a link to {}", folder.join("mesh.inp").display());
    is_outside(&folder, "out.inp", &end);
    is_outside(&folder, "up/mesh.inp", &end);
    is_outside(&folder, "twice.inp", &end);
    is_inside(&folder, "in.inp");
    is_inside(&folder, "down/mesh.inp");
    is_inside(&folder, "up/model/mesh.inp");
    // After a link `..` goes up from where the link leads to: down is below, up is one too far.
    is_inside(&folder, "down/../mesh.inp");
    is_outside(&folder, "up/../reach-links/mesh.inp", "");
    // The folder itself may be reached by a link.
    symlink("model", folder.join("alias")).unwrap();
    load(&folder.join("alias"), &[]).unwrap_err();
    fs::write(own.join("model.toml"), model("below/mesh.inp")).unwrap();
    load(&folder.join("alias"), &[]).unwrap();
    // A link to nothing, and one to itself, is a file that is not there.
    symlink("nowhere", own.join("dangling.inp")).unwrap();
    symlink("round.inp", own.join("round.inp")).unwrap();
    for file in ["dangling.inp", "round.inp"] {
        let reported = named(&folder, file, PathPolicy::Folder).unwrap_err();
        assert!(reported.rendered.contains("E0220") && reported.rendered.contains("there is no file"), "{}", reported.rendered);
    }
}

#[test]
fn what_is_outside_is_reported_whether_it_is_there_or_not() {
    let folder = laid_out("reach-nothing");
    let reported = named(&folder, "../nothing.inp", PathPolicy::Folder).unwrap_err();
    assert!(reported.rendered.contains("E0124") && !reported.rendered.contains("E0220"), "{}", reported.rendered);
    let reported = named(&folder, "../nothing.inp", PathPolicy::Anywhere).unwrap_err();
    assert!(reported.rendered.contains("E0220"), "{}", reported.rendered);
}

#[cfg(unix)]
#[test]
fn backslashes_are_no_separators_and_the_cure_says_so() {
    let folder = laid_out("reach-backslashes");
    for file in [r"below\mesh.inp", r"..\mesh.inp", r"C:\mesh.inp"] {
        let reported = named(&folder, file, PathPolicy::Folder).unwrap_err();
        assert!(reported.rendered.contains("E0220") && reported.rendered.contains("stands / on every system"), "{}", reported.rendered);
    }
}

#[test]
fn a_deck_includes_files_of_the_models_folder_alone() {
    let folder = laid_out("reach-decks");
    fs::write(folder.join("model/below/deck.inp"), "*INCLUDE, INPUT=../mesh.inp\n").unwrap();
    is_inside(&folder, "below/deck.inp");
    // By itself the deck's own folder is what counts.
    let faults = abaqus::read(&folder.join("model/below/deck.inp"), 1.0).unwrap_err();
    assert!(faults[0].kind.code == "E0124" && faults[0].path.ends_with("deck.inp, line 1"), "{}", faults[0]);
    fs::write(folder.join("model/below/deck.inp"), "** meshes of all\n*INCLUDE, INPUT=\"../../mesh.inp\"\n").unwrap();
    let reported = named(&folder, "below/deck.inp", PathPolicy::Folder).unwrap_err();
    let [fault] = &reported.entries[..] else { panic!("{}", reported.rendered) };
    assert_eq!((fault.kind.code, fault.line), ("E0124", 7), "{}", reported.rendered);
    assert!(fault.message.contains("deck.inp, line 2: \"../../mesh.inp\" leads out of the model's folder"), "{}", reported.rendered);
    named(&folder, "below/deck.inp", PathPolicy::Anywhere).unwrap_or_else(|reported| panic!("{}", reported.rendered));
    // An import has the deck's folder, and the same leave.
    let units = Units::default();
    let faults = import(&folder.join("model/below/deck.inp"), &units, PathPolicy::Folder).map(drop).unwrap_err();
    assert!(faults[0].kind.code == "E0124" && faults[0].message.contains("the deck's folder"), "{}", faults[0]);
    let faults = import(&folder.join("model/below/deck.inp"), &units, PathPolicy::Anywhere).map(drop).unwrap_err();
    assert!(faults.iter().all(|fault| fault.kind.code != "E0124"), "a mesh alone is no model: {}", faults[0]);
}

#[test]
fn a_text_reads_files_of_the_folder_it_is_given() {
    let folder = laid_out("reach-text");
    assert!(load_text("m", &model("mesh.inp"), &folder, &[]).is_ok());
    assert!(load_text("m", &model("../mesh.inp"), &folder.join("model"), &[]).unwrap_err().rendered.contains("E0124"));
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_not_waited_for() {
    let folder = laid_out("reach-pipe");
    let pipe = folder.join("model/pipe.inp");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    assert!(named(&folder, "pipe.inp", PathPolicy::Folder).unwrap_err().rendered.contains("there is no file"));
    fs::write(folder.join("model/deck.inp"), "*INCLUDE, INPUT=pipe.inp\n").unwrap();
    let reported = named(&folder, "deck.inp", PathPolicy::Folder).unwrap_err();
    assert!(reported.rendered.contains("it is no file"), "{}", reported.rendered);
    assert!(abaqus::read(&pipe, 1.0).unwrap_err()[0].message.contains("it is no file"));
}
