//! `embate remesh`: a part of a run goes over to a mesh of the user's, and the run continues in a folder of
//! its own, stops, continues again, and says where it came from.

use crate::{Answer, FLIGHT, embate, fresh};
use embate_files::{gmsh, stl};
use std::fs;
use std::path::{Path, PathBuf};

/// A cube of metal that flies.
const CUBE: &str = r#"
run.end = "0.1 ms"
material.steel = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "300 MPa" }
part = [{ name = "cube", material = "steel", box = { corner = [0, 0, 0], size = ["10 mm", "10 mm", "10 mm"], elements = [2, 2, 2] }, velocity = [0, 0, 20] }]
probe = [{ name = "P", set = "cube" }]
output = { fields = 4, history = 20, pictures = false }
"#;

/// The text of a mesh file of n³ hexahedra in a cube of 10 mm that has flown so far, in mm.
fn grid(n: usize, flown: f64) -> String {
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n");
    let m = n + 1;
    text.push_str(&format!("{}\n", m * m * m));
    for node in 0..m * m * m {
        let [x, y, z] = [node % m, node / m % m, node / m / m].map(|k| 10.0 * k as f64 / n as f64);
        text.push_str(&format!("{} {x} {y} {}\n", node + 1, z + flown));
    }
    text.push_str(&format!("$EndNodes\n$Elements\n{}\n", n * n * n));
    for cell in 0..n * n * n {
        let [i, j, k] = [cell % n, cell / n % n, cell / n / n];
        let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
        let nodes = corners.map(|[a, b, c]| (((k + c) * m + j + b) * m + i + a + 1).to_string());
        text.push_str(&format!("{} 5 2 1 1 {}\n", cell + 1, nodes.join(" ")));
    }
    text.push_str("$EndElements\n");
    text
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
}

fn good(answer: &Answer) {
    assert_eq!(answer.code, Some(0), "{}{}", answer.out, answer.err);
}

/// A folder with results of the cube, and a mesh of it as it is at half of the time, 1 mm further.
fn flown(name: &str) -> PathBuf {
    let folder = fresh(name);
    fs::write(folder.join("model.toml"), CUBE).unwrap();
    fs::write(folder.join("finer.msh"), grid(4, 1.0)).unwrap();
    good(&embate(&folder, ["run", "model.toml", "--out", "out", "--quiet"]));
    folder
}

const HALF: [&str; 6] = ["remesh", "out", "--part", "cube", "--at", "50 us"];

#[test]
fn a_run_continues_on_another_mesh_in_a_folder_of_its_own() {
    let folder = flown("remesh");
    let more = ["--mesh", "finer.msh", "--scale", "1 mm", "--threads", "1"];
    let answer = embate(&folder, HALF.into_iter().chain(more));
    good(&answer);
    assert!(answer.err.contains("64 elements instead of 8") && answer.err.contains("part \"cube\""), "{}", answer.err);
    let own = folder.join("out-remeshed");
    let figures = summary(&own);
    assert_eq!(figures["status"], "done");
    let event = &figures["remeshings"][0];
    assert!(event["reason"] == "mesh" && event["elements"][1] == 64, "{event}");
    assert!(figures["time_end"].as_f64() > Some(0.0999e-3) && figures["ledger_residual"].as_f64() < Some(1e-12), "{figures}");
    // Its history begins there, and knows what the transfer took.
    let history = fs::read_to_string(own.join("history.csv")).unwrap();
    let head: Vec<&str> = history.lines().next().unwrap().split(',').collect();
    let column = |name: &str| head.iter().position(|own| *own == name).unwrap_or_else(|| panic!("{name} in {head:?}"));
    let value = |line: &str, name: &str| line.split(',').nth(column(name)).unwrap().parse::<f64>().unwrap();
    let (first, last) = (history.lines().nth(1).unwrap(), history.lines().last().unwrap());
    assert!((value(first, "time") - 50e-6).abs() < 2e-6 && value(first, "energy.remap").abs() < 1e-12, "{first}");
    assert!((value(last, "P.vz") - 20.0).abs() < 1e-9 && (value(last, "P.z") - 7e-3).abs() < 1e-5, "{last}");
    // What came before is as it was.
    assert!(summary(&folder.join("out"))["remeshings"].as_array().is_none_or(Vec::is_empty));
    // It may not be lost by chance.
    let again = embate(&folder, HALF.into_iter().chain(more));
    assert!(again.code == Some(2) && again.err.contains("E0702"), "{}", again.err);
    good(&embate(&folder, HALF.into_iter().chain(more).chain(["--force", "--quiet"])));
}

#[test]
fn it_stops_and_continues_with_the_same_bits_and_says_where_it_came_from() {
    let folder = flown("remesh-stopped");
    let more = ["--mesh", "finer.msh", "--scale", "1 mm", "--quiet"];
    good(&embate(&folder, HALF.into_iter().chain(more).chain(["--out", "whole"])));
    // Stopped at once: the state with which it began is kept.
    let origin = fs::read_to_string(folder.join("whole/run.json")).unwrap();
    assert!(origin.contains("\"exchanged\"") && origin.contains("finer.msh"), "{origin}");
    good(&embate(&folder, ["resume", "whole", "--until", "0.11 ms", "--quiet"]));
    let longer = summary(&folder.join("whole"));
    assert!(longer["time_end"].as_f64() > Some(0.1099e-3), "{longer}");
    let states: Vec<_> = fs::read_dir(folder.join("whole/checkpoint")).unwrap().map(|entry| entry.unwrap().path()).collect();
    assert!(!states.is_empty());
    let replay = ["replay", "whole", "--from", "60 us", "--to", "0.11 ms", "--output-every", "10 us", "--quiet"];
    good(&embate(&folder, replay));
    // Done once more, on one thread, it is the same.
    good(&embate(&folder, HALF.into_iter().chain(more).chain(["--out", "again", "--threads", "1"])));
    good(&embate(&folder, ["resume", "again", "--until", "0.11 ms", "--quiet", "--threads", "1"]));
    assert_eq!(summary(&folder.join("again"))["state_hash"], longer["state_hash"]);
    // Before it began there is nothing, and the program does not begin another run instead.
    let before = ["replay", "whole", "--from", "10 us", "--to", "20 us", "--output-every", "5 us", "--out", "none", "--quiet"];
    let answer = embate(&folder, before);
    assert!(answer.code == Some(2) && answer.err.contains("began on another mesh of part `cube`"), "{}", answer.err);
}

#[test]
fn the_outline_of_a_part_is_written_as_it_is_then() {
    let folder = flown("remesh-outline");
    let outline = ["--outline", "cube.stl", "--scale", "1 mm"];
    let answer = embate(&folder, HALF.into_iter().chain(outline));
    good(&answer);
    assert!(answer.out.contains("96 triangles of part \"cube\""), "{}", answer.out);
    let surface = stl::read(&folder.join("cube.stl"), "cube.stl", 1e-3).unwrap();
    let (low, high) = surface.positions.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x[2]), high.max(x[2])));
    assert!((high - low - 10e-3).abs() < 1e-9 && (low - 1e-3).abs() < 1e-4, "{low} {high}");
    let again = embate(&folder, HALF.into_iter().chain(outline));
    assert!(again.code == Some(2) && again.err.contains("E0702"), "{}", again.err);
    // In 2D elements are made again without it.
    fs::write(folder.join("flat.toml"), FLIGHT).unwrap();
    good(&embate(&folder, ["run", "flat.toml", "--out", "flat", "--quiet"]));
    let answer = embate(&folder, ["remesh", "flat", "--part", "block", "--at", "50 us", "--outline", "flat.stl"]);
    assert!(answer.code == Some(2) && answer.err.contains("2D"), "{}", answer.err);
}

#[test]
fn wrong_meshes_and_arguments_are_refused_before_anything_is_written() {
    let folder = flown("remesh-wrong");
    fs::write(folder.join("early.msh"), grid(3, 20.0)).unwrap();
    let refused = |more: &[&str], wanted: &str| {
        let answer = embate(&folder, HALF.iter().chain(more));
        assert!(answer.code == Some(2) && answer.err.contains(wanted), "{more:?}: {}", answer.err);
        assert!(!folder.join("out-remeshed").exists());
    };
    refused(&["--mesh", "finer.msh"], "m³");
    refused(&["--mesh", "early.msh", "--scale", "1 mm"], "E0613");
    refused(&["--mesh", "nowhere.msh"], "nowhere.msh");
    refused(&["--mesh", "finer.msh", "--scale", "1 mm", "--group", "rough"], "`volume-1`");
    refused(&["--mesh", "finer.msh", "--size", "1 mm"], "--size");
    refused(&[], "--mesh");
    let answer = embate(&folder, ["remesh", "out", "--part", "cub", "--at", "50 us", "--mesh", "finer.msh", "--scale", "1 mm"]);
    assert!(answer.code == Some(2) && answer.err.contains("`cube`"), "{}", answer.err);
    let answer = embate(&folder, ["remesh", "out", "--part", "cube", "--mesh", "finer.msh", "--scale", "1 mm"]);
    assert!(answer.code == Some(2) && answer.err.contains("no checkpoint"), "{}", answer.err);
    let answer = embate(&folder, ["remesh", "out", "--part", "cube", "--at", "1 ms", "--mesh", "finer.msh", "--scale", "1 mm"]);
    assert!(answer.code == Some(2) && answer.err.contains("--at"), "{}", answer.err);
}

/// With Gmsh itself, where it is there: the outline of a cube that has hit a wall, filled again.
#[test]
fn gmsh_fills_the_outline_of_a_part() {
    let program = std::env::var("EMBATE_GMSH").unwrap_or_else(|_| "gmsh".into());
    let is_there = std::process::Command::new(&program).arg("--version").output().is_ok_and(|output| output.status.success());
    if !is_there {
        println!("gmsh is not there");
        return;
    }
    let folder = fresh("remesh-gmsh");
    let wall = "\nobstacle = [{ name = \"wall\", plane = { normal = [0, 0, -1], point = [0, 0, \"10.1 mm\"] } }]\n";
    fs::write(folder.join("model.toml"), format!("{CUBE}{wall}").replace("velocity = [0, 0, 20]", "velocity = [0, 0, 150]")).unwrap();
    good(&embate(&folder, ["run", "model.toml", "--out", "out", "--quiet"]));
    let answer = embate(&folder, ["remesh", "out", "--part", "cube", "--at", "20 us", "--size", "2 mm", "--gmsh", &program]);
    good(&answer);
    let figures = summary(&folder.join("out-remeshed"));
    let event = &figures["remeshings"][0];
    assert!(event["elements"][1].as_u64() > Some(300) && event["volume_change"].as_f64().map(f64::abs) < Some(0.01), "{event}");
    assert!(figures["ledger_residual"].as_f64() < Some(1e-12) && figures["energy_drift"].as_f64() < Some(0.02), "{figures}");
    assert_eq!(figures["contact"]["unverified"], 0);
}

#[test]
fn meshes_of_the_test_are_cubes() {
    let mesh = gmsh::parse(grid(2, 1.0).as_bytes(), "grid", 1e-3).unwrap();
    assert_eq!((mesh.positions.len(), mesh.groups.len()), (27, 1));
}
