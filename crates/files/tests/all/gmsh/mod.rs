//! Meshes of Gmsh. The files in tests/gmsh were written by the real Gmsh through make.py there; the malformed
//! ones are made from them here.

mod damage;
mod malformed;
mod meshes;
mod space;
mod views;

use embate_files::gmsh::parse;
use embate_solver::error::Fault;
use embate_solver::model::{ImportedMesh, MeshGroup};
use std::path::PathBuf;

const FORMATS: [&str; 4] = ["v2-text", "v2-binary", "v4-text", "v4-binary"];

fn path(name: &str) -> PathBuf {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    if name == "bodies-v4-binary" {
        root.join("../../examples/tube-plate-gmsh/bodies.msh")
    } else {
        root.join(format!("tests/gmsh/{name}.msh"))
    }
}

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The mesh of a fixture, with the same source for all.
fn mesh(name: &str, scale: f64) -> ImportedMesh {
    parse(&bytes(name), "m.msh", scale).unwrap_or_else(|faults| panic!("{name}: {faults:#?}"))
}

fn faults(bytes: &[u8]) -> Vec<Fault> {
    parse(bytes, "m.msh", 1.0).expect_err("the file is wrong")
}

fn group<'a>(mesh: &'a ImportedMesh, name: &str) -> &'a MeshGroup {
    mesh.groups.iter().find(|group| group.name == name).unwrap_or_else(|| panic!("no group {name}"))
}

/// Area of a group of surfaces; each cell's is positive.
fn area(mesh: &ImportedMesh, name: &str) -> f64 {
    let of_cell = |cell: &Vec<u32>| {
        let x: Vec<_> = cell.iter().map(|&node| mesh.positions[node as usize]).collect();
        let n = x.len();
        let twice: f64 = (0..n).map(|k| x[k][0] * x[(k + 1) % n][1] - x[k][1] * x[(k + 1) % n][0]).sum();
        assert!(twice > 0.0, "a cell of {name} is clockwise");
        0.5 * twice
    };
    group(mesh, name).cells.iter().map(of_cell).sum()
}

/// Length of a group of lines.
fn length(mesh: &ImportedMesh, name: &str) -> f64 {
    let of_cell = |cell: &Vec<u32>| {
        let [a, b] = [0, 1].map(|k| mesh.positions[cell[k] as usize]);
        (b[0] - a[0]).hypot(b[1] - a[1])
    };
    group(mesh, name).cells.iter().map(of_cell).sum()
}
