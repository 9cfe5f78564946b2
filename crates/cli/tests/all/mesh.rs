//! `embate mesh`: with a program that stands in for Gmsh, how it is called and what becomes of its failures;
//! with Gmsh itself, where it is there, a box with a hole from a STEP file to a model.
#![cfg(unix)]

use crate::{Answer, fresh};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// What the stand-in writes: a tetrahedron in mm with two of its faces.
const MESH: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 5 \"s5\"\n2 6 \"s6\"\n3 1 \"v1\"\n$EndPhysicalNames\n$Nodes\n4\n\
    1 0 0 0\n2 10 0 0\n3 0 10 0\n4 0 0 10\n$EndNodes\n$Elements\n3\n1 2 2 5 5 1 2 3\n2 2 2 6 6 1 2 4\n3 4 2 1 1 1 2 3 4\n$EndElements\n";
const FOUND: &str = "surfaces 2\nvolume 1\nlabel Shapes/Assembly/1/Left bracket\nface 5\nlabel \nface 6\nlabel Shapes/x/front\n";

const MATERIAL: &str = "run.end = \"1 us\"\nmaterial.steel = { law = \"elastic\", density = 7800, young = \"200 GPa\", poisson = 0.3 }\n";

/// A folder with a CAD file and a program in place of Gmsh that does this.
fn stand_in(name: &str, script: &str) -> PathBuf {
    let folder = fresh(name);
    fs::write(folder.join("part.step"), "ISO-10303-21;\n").unwrap();
    fs::write(folder.join("mesh.txt"), MESH).unwrap();
    fs::write(folder.join("found.txt"), FOUND).unwrap();
    let program = folder.join("fake");
    fs::write(&program, format!("#!/bin/sh\nhere='{}'\n{script}\n", folder.display())).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

const DOES_ITS_WORK: &str = "printf '%s\\n' \"$@\" > \"$here/arguments.txt\"; cp job.geo \"$here/job.txt\"; ls > \"$here/files.txt\"\n\
                             pwd > \"$here/folder.txt\"; cp \"$here/found.txt\" found.txt; cp \"$here/mesh.txt\" made.msh";

/// Calls the program with this folder for what is temporary.
fn embate(folder: &Path, arguments: &[&str]) -> Answer {
    fs::create_dir_all(folder.join("tmp")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_embate"));
    command.args(arguments).current_dir(folder).env("TMPDIR", folder.join("tmp")).env_remove("EMBATE_GMSH");
    let output = command.output().unwrap();
    // Nothing is left there.
    assert_eq!(fs::read_dir(folder.join("tmp")).unwrap().count(), 0);
    Answer { code: output.status.code(), out: String::from_utf8(output.stdout).unwrap(), err: String::from_utf8(output.stderr).unwrap() }
}

#[test]
fn gmsh_is_called_without_a_shell_and_its_mesh_is_named_and_described() {
    // No name of a file is part of a command.
    let folder = stand_in("mesh-called", DOES_ITS_WORK);
    let cad = "a \"$(touch oops)\"; b.STEP";
    fs::rename(folder.join("part.step"), folder.join(cad)).unwrap();
    let answer = embate(&folder, &["mesh", cad, "--size", "2.5 mm", "--gmsh", "./fake", "--out", "made.msh"]);
    assert_eq!((answer.code, answer.err.as_str()), (Some(0), ""), "{}", answer.out);
    let text = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    assert_eq!(text("arguments.txt"), "job.geo\n-3\n-v\n3\n-nt\n1\n-o\nmade.msh\n");
    assert_eq!(text("files.txt"), "geometry.step\njob.geo\nlog.txt\n");
    assert!(text("job.txt").contains("shapes() = ShapeFromFile(\"geometry.step\");") && text("job.txt").contains("MeshSizeMax = 2.5e0;"));
    assert!(text("job.txt").contains("OCCTargetUnit = \"MM\";") && !text("job.txt").contains("oops") && !folder.join("oops").exists());
    let words = answer.out.split_whitespace().collect::<Vec<_>>().join(" ");
    for wanted in [
        "made.msh: 4 nodes, 1 tetrahedra ",
        "box: (0, 0, 0) to (10, 10, 10) mm ",
        // One corner spans 10³ mm³, its longest side is 10 √2 mm.
        "worst element: shape 0.3536 at (2.5, 2.5, 2.5) mm",
        " Left_bracket 1 166.7 (2.5, 2.5, 2.5) ",
        " Left_bracket-face1 1 50 (3.333, 3.333, 0) (0, 0, -1) ",
        " Left_bracket-front 1 50 (3.333, 0, 3.333) (0, -1, 0) ",
        "name = \"Left_bracket\" ",
        "mesh = { file = \"made.msh\", group = \"Left_bracket\", scale = \"1 mm\" }",
    ] {
        assert!(words.contains(wanted), "{wanted}: {}", answer.out);
    }
    // The lines make a model, and the names are those of the file.
    let parts = answer.out.split("parts for a model beside it:\n\n").nth(1).unwrap();
    let probe = "[[probe]]\nname = \"front\"\nset = \"Left_bracket-front\"\n[[constraint]]\non = \"Left_bracket.Left_bracket-face1\"\nfixed = [\"z\"]\n";
    fs::write(folder.join("model.toml"), format!("{MATERIAL}{parts}{probe}")).unwrap();
    let checked = embate(&folder, &["check", "model.toml"]);
    assert_eq!(checked.code, Some(0), "{}{}", checked.out, checked.err);
    assert!(checked.out.contains("1 tet10") && checked.out.contains("10 x 10 x 10 mm"), "{}", checked.out);
}

#[test]
fn a_unit_a_program_of_the_environment_and_a_mesh_that_is_there() {
    let folder = stand_in("mesh-unit", DOES_ITS_WORK);
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_embate"));
        let output = command.args(arguments).current_dir(&folder).env("EMBATE_GMSH", folder.join("fake")).output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap())
    };
    let (code, out) = run(&["mesh", "part.step", "--size", "0.0254 m", "--unit", "in"]);
    assert_eq!(code, Some(0), "{out}");
    assert!(out.contains("part.msh: 4 nodes") && out.contains("(10, 10, 10) in") && out.contains("scale = \"1 in\""), "{out}");
    let job = fs::read_to_string(folder.join("job.txt")).unwrap();
    assert!(job.contains("OCCTargetUnit = \"INCH\";") && job.contains("MeshSizeMax = 1e0;"), "{job}");
    let (code, out) = run(&["mesh", "part.step", "--size", "1 mm"]);
    assert!(code == Some(2) && out.contains("E0702") && out.contains("part.msh exists"), "{out}");
    assert!(job.contains("Mesh.ElementOrder = 1;"), "{job}");
    assert_eq!(run(&["mesh", "part.step", "--size", "1 mm", "--force", "--order", "2"]).0, Some(0));
    let job = fs::read_to_string(folder.join("job.txt")).unwrap();
    assert!(job.contains("Mesh.ElementOrder = 2;"), "{job}");
    assert_eq!(run(&["mesh", "part.step", "--size", "1 mm", "--force", "--order", "3"]).0, Some(2));
}

#[test]
fn what_keeps_gmsh_from_making_a_mesh_is_told_with_a_remedy() {
    let told = |name: &str, script: &str, arguments: &[&str], words: &[&str]| {
        let folder = stand_in(name, script);
        let begin = Instant::now();
        let all = [&["mesh", "part.step", "--size", "2 mm", "--gmsh", "./fake"][..], arguments].concat();
        let answer = embate(&folder, &all);
        assert!(begin.elapsed() < Duration::from_secs(30), "{name}");
        assert_eq!(answer.code, Some(2), "{name}: {}", answer.out);
        assert!(words.iter().all(|word| answer.err.contains(word)), "{name}, {words:?}: {}", answer.err);
        assert!(!folder.join("part.msh").exists(), "{name}");
    };
    told(
        "mesh-fails",
        "echo 'Info: a'; echo 'Error   : Invalid STEP' >&2; exit 3",
        &[],
        &["E0931", "exit status: 3", "| Error   : Invalid STEP"],
    );
    told(
        "mesh-library",
        "echo 'OSError: libGLU.so.1: cannot open shared object file' >&2; exit 1",
        &[],
        &["E0931", "libGLU.so.1", "libglu1-mesa"],
    );
    told("mesh-hangs", "echo meshing; exec sleep 60", &["--timeout", "0.3 s"], &["E0931", "stopped after 0.3 s", "| meshing", "--timeout"]);
    told("mesh-nothing", "cp \"$here/found.txt\" found.txt", &[], &["E0931", "wrote no mesh of part.step", "--size"]);
    told("mesh-surfaces", "echo 'surfaces 12' > found.txt", &[], &["E0932", "holds 12 surface(s), but no volume", "as a solid"]);
    told("mesh-empty", "echo 'Error : x'; echo 'surfaces 0' > found.txt", &[], &["E0932", "neither volumes nor surfaces", "| Error : x"]);
    told("mesh-unread", "echo 'Warning : Syntax error'", &[], &["E0932", "could not read part.step", "| Warning : Syntax error"]);
    told("mesh-damaged", &format!("{DOES_ITS_WORK}; head -c 150 \"$here/mesh.txt\" > made.msh"), &[], &["E0222", "the mesh of Gmsh"]);
    // Before Gmsh is called.
    let folder = stand_in("mesh-before", "exit 1");
    for (arguments, words) in [
        (
            &["part.step", "--size", "2 mm", "--gmsh", "./nowhere"][..],
            &["E0930", "`./nowhere`: there is no such program", "EMBATE_GMSH", "pip install gmsh"][..],
        ),
        (&["part.step", "--size", "2 mm", "--gmsh", "part.step"], &["E0930", "`part.step`"]),
        (&["none.step", "--size", "2 mm"], &["E0932", "none.step can't be read", "check its path"]),
        (&["fake", "--size", "2 mm"], &["E0932", "fake is no CAD file by its name", ".step, .stp"]),
        (&["part.step", "--size", "2"], &["E0930"]),
        (&["part.step", "--size", "0 mm"], &["E0802", "no length greater than 0"]),
        (&["part.step", "--size", "2 s"], &["E0802", "length"]),
        (&["part.step"], &["E0802", "--size"]),
        (&["part.step", "--size", "2 mm", "--unit", "km"], &["E0802", "mm, cm, m, in, ft"]),
    ] {
        let mut all = vec!["mesh"];
        all.extend(arguments);
        if !arguments.contains(&"--gmsh") {
            all.extend(["--gmsh", "./nowhere"]);
        }
        let answer = embate(&folder, &all);
        assert_eq!(answer.code, Some(2), "{arguments:?}: {}", answer.out);
        assert!(words.iter().all(|word| answer.err.contains(word)), "{arguments:?}, {words:?}: {}", answer.err);
    }
}

/// Gmsh on this machine; `None`: it is not there, or does not start.
fn gmsh() -> Option<String> {
    let name = std::env::var("EMBATE_GMSH").unwrap_or("gmsh".into());
    let answer = Command::new(&name).arg("--version").output().ok()?;
    answer.status.success().then_some(name)
}

#[test]
fn a_box_with_a_hole_goes_from_a_step_file_to_a_model_where_gmsh_is_there() {
    let Some(gmsh) = gmsh() else {
        println!("Gmsh is not here");
        return;
    };
    let folder = fresh("mesh-real");
    let geo = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 40, 30, 10};\nCylinder(2) = {20, 15, -1, 0, 0, 12, 6};\n\
               BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\nBox(4) = {60, 0, 0, 10, 10, 10};\n";
    fs::write(folder.join("two.geo"), geo).unwrap();
    let made = Command::new(&gmsh).args(["two.geo", "-0", "-o", "two.step"]).current_dir(&folder).output().unwrap();
    assert!(made.status.success() && folder.join("two.step").exists(), "{}", String::from_utf8_lossy(&made.stdout));
    let answer = embate(&folder, &["mesh", "two.step", "--size", "3 mm", "--gmsh", &gmsh]);
    assert_eq!((answer.code, answer.err.as_str()), (Some(0), ""), "{}", answer.out);
    println!("{}", answer.out);
    assert!(answer.out.contains("box: (0, 0, 0) to (70, 30, 10) mm") && answer.out.contains("bodies share no nodes"), "{}", answer.out);
    // A flat face of the second body, whose area and normal are known.
    let rows: Vec<Vec<&str>> =
        answer.out.lines().map(|line| line.split("  ").map(str::trim).filter(|it| !it.is_empty()).collect()).collect();
    let is_face = |row: &&Vec<&str>| row.len() == 5 && row[2] == "100" && row[3] == "(65, 5, 10)" && row[4] == "(0, 0, 1)";
    assert!(rows.iter().any(|row| is_face(&row)), "{}", answer.out);
    assert!(answer.out.contains("curved"), "{}", answer.out);
    let parts = answer.out.split("parts for a model beside it:\n\n").nth(1).unwrap();
    fs::write(folder.join("model.toml"), format!("{MATERIAL}{parts}")).unwrap();
    let checked = embate(&folder, &["check", "model.toml"]);
    assert_eq!(checked.code, Some(0), "{}{}", checked.out, checked.err);
    // 7800 kg/m³ × 10 × 10 × 10 mm³, and a box of 12000 mm³ less a polygon in a hole of 1131 mm³.
    assert!(checked.out.contains("7.8 g") && checked.out.contains("40 x 30 x 10 mm"), "{}", checked.out);
    let grams: f64 = checked
        .out
        .lines()
        .find(|line| line.contains("40 x 30"))
        .and_then(|line| line.split(" g ").next()?.rsplit(' ').next()?.parse().ok())
        .unwrap();
    assert!((grams - 7.8 * (12.0 - 1.131)).abs() < 0.7, "{grams}");
    // What is no STEP file is reported with what Gmsh says.
    fs::write(folder.join("bad.step"), "this is no step file").unwrap();
    let answer = embate(&folder, &["mesh", "bad.step", "--size", "3 mm", "--gmsh", &gmsh]);
    let words = ["E0932", "neither volumes nor surfaces in bad.step", "Could not read file"];
    assert!(answer.code == Some(2) && words.iter().all(|word| answer.err.contains(word)), "{}", answer.err);
}
