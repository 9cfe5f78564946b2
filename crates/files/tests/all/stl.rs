//! Obstacles of STL files in model files: how they are named, scaled, turned and moved, and what is said of
//! files that are none.

use embate_files::model_file::{load_text, load_text_with_places};
use embate_solver::model::{ObstacleShape, TriangleSurface};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A tetrahedron of an STL file, in mm.
const FACETS: [[[f32; 3]; 3]; 4] = {
    let x = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 30.0]];
    [[x[0], x[2], x[1]], [x[0], x[1], x[3]], [x[1], x[2], x[3]], [x[2], x[0], x[3]]]
};

fn text(facets: &[[[f32; 3]; 3]]) -> String {
    let vertex = |x: &[f32; 3]| format!("      vertex {} {} {}\n", x[0], x[1], x[2]);
    let facet = |facet: &[[f32; 3]; 3]| {
        format!("  facet normal 0 0 0\n    outer loop\n{}    endloop\n  endfacet\n", facet.iter().map(vertex).collect::<String>())
    };
    format!("solid die\n{}endsolid die\n", facets.iter().map(facet).collect::<String>())
}

fn binary(facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0.0; 3].iter().chain(facet.as_flattened()).flat_map(|number: &f32| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// A folder with these files.
fn folder(name: &str, files: &[(&str, &[u8])]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stl").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    files.iter().for_each(|(file, bytes)| fs::write(folder.join(file), bytes).unwrap());
    folder
}

fn model(obstacle: &str) -> String {
    let steel = "[run]\nend = \"1 ms\"\n[material.steel]\nlaw = \"elastic\"\nyoung = \"200 GPa\"\npoisson = 0.3\ndensity = 7800\n";
    let part = "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nbox = { corner = [1, 1, 1], size = [1, 1, 1], elements = [1, 1, 1] }\n";
    format!("{steel}{part}[[obstacle]]\nname = \"die\"\n{obstacle}\n")
}

/// The surface of the obstacle.
fn surface(folder: &Path, obstacle: &str) -> Arc<TriangleSurface> {
    let model = load_text("model.toml", &model(obstacle), folder, &[]).unwrap_or_else(|reported| panic!("{reported}"));
    let ObstacleShape::Triangles(surface) = &model.obstacles[0].shape else { panic!("{:?}", model.obstacles[0].shape) };
    Arc::clone(surface)
}

/// Code, path and words of the faults.
fn reported(folder: &Path, obstacle: &str) -> Vec<String> {
    let entries = load_text("model.toml", &model(obstacle), folder, &[]).map_or_else(|reported| reported.entries, |_| Vec::new());
    entries.iter().map(|fault| format!("{} {}: {}", fault.kind.code, fault.path, fault.message)).collect()
}

#[test]
fn an_obstacle_is_the_surface_of_its_file_scaled_turned_and_moved() {
    let folder = folder("sound", &[("a.stl", text(&FACETS).as_bytes()), ("b.STL", &binary(&FACETS))]);
    let one = surface(&folder, "stl = { file = \"a.stl\", scale = \"1 mm\" }");
    assert_eq!((one.source.as_str(), one.positions.len(), one.triangles.len()), ("a.stl", 4, 4));
    assert_eq!(one.positions.iter().map(|x| x[2]).fold(0.0, f64::max), 0.03);
    let other = surface(&folder, "stl.file = \"b.STL\"\nstl.scale = 0.001");
    assert_eq!((&other.positions, &other.triangles), (&one.positions, &one.triangles));
    let placed = "rotation = { angle = \"90 deg\", axis = [0, 1, 0] }, translation = [0, 0, \"1 m\"], hollow = true";
    let placed = surface(&folder, &format!("stl = {{ file = \"a.stl\", scale = \"1 mm\", {placed} }}"));
    for (x, y) in one.positions.iter().zip(&placed.positions) {
        let expected = [x[2], x[1], 1.0 - x[0]];
        assert!(expected.iter().zip(y).all(|(a, b)| (a - b).abs() < 1e-15), "{x:?} {y:?}");
    }
    assert!(one.triangles.iter().zip(&placed.triangles).all(|(a, b)| [a[0], a[2], a[1]] == *b));
}

#[test]
fn files_that_make_no_obstacle_are_reported_at_their_key() {
    let mut turned = FACETS;
    turned[2].swap(0, 1);
    let mut flat = FACETS;
    flat[1][2] = [5.0, 0.0, 0.0];
    let (whole, bytes) = (text(&FACETS), binary(&FACETS));
    let folder = folder(
        "faulty",
        &[
            ("cut.stl", &whole.as_bytes()[..whole.len() / 2]),
            ("cut-binary.stl", &bytes[..bytes.len() - 60]),
            ("nan.stl", whole.replacen("20", "nan", 1).as_bytes()),
            ("empty.stl", b""),
            ("none.stl", b"solid die\nendsolid die\n"),
            ("turned.stl", text(&turned).as_bytes()),
            ("flat.stl", text(&flat).as_bytes()),
        ],
    );
    let file = |file: &str| reported(&folder, &format!("stl.file = \"{file}\""));
    for (name, code, words) in [
        ("cut.stl", "E0240", "the file ends where"),
        ("cut-binary.stl", "E0240", "its header announces 4 triangles, but the file holds 2 and 40 bytes of another one"),
        ("nan.stl", "E0240", "here stands `nan`, but a finite number should"),
        ("empty.stl", "E0240", "the file has 0 bytes"),
        ("none.stl", "E0240", "the file holds no triangles"),
        ("turned.stl", "E0413", "look to opposite sides at 3 edges"),
        ("flat.stl", "E0411", "1 triangle has no area"),
        ("nowhere.stl", "E0220", "there is no file"),
        ("../a.stl", "E0124", "leads out of the model's folder"),
    ] {
        let found = file(name);
        let head = format!("{code} obstacle[0].stl.file: ");
        assert!(!found.is_empty() && found[0].starts_with(&head) && found[0].contains(words), "{name}: {found:?}");
    }
    assert_eq!(reported(&folder, "stl = { file = \"cut.stl\", scale = \"1 s\" }").len(), 1);
    assert!(reported(&folder, "stl.scale = 1")[0].contains("has no `file`"));
}

#[test]
fn a_surface_with_a_hole_is_warned_of() {
    let folder = folder("open", &[("open.stl", &binary(&FACETS[1..])), ("closed.stl", &binary(&FACETS))]);
    let warnings = |file: &str| {
        let loaded = load_text_with_places("model.toml", &model(&format!("stl.file = \"{file}\"")), &folder, &[]).unwrap();
        loaded
            .model
            .warnings()
            .into_iter()
            .map(|warning| format!("{} {}: {}", warning.kind.code, warning.path, warning.message))
            .collect::<Vec<_>>()
    };
    assert_eq!(warnings("closed.stl"), Vec::<String>::new());
    let found = warnings("open.stl");
    assert!(
        found.len() == 1 && found[0].starts_with("W0407 obstacle[0].stl.file: open.stl: 3 edges belong to one triangle alone"),
        "{found:?}"
    );
}
