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

/// A square of 100 mm of n × n × 2 triangles.
fn square(n: usize) -> Vec<[[f32; 3]; 3]> {
    let at = |i: usize, j: usize| [100.0 * i as f32 / n as f32, 100.0 * j as f32 / n as f32, 0.0];
    let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if (i < n / 2) == (j < n / 2) { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] }
        })
        .collect()
}

#[test]
fn a_shell_of_an_stl_file_bends_as_a_plate() {
    use embate_solver::simulation::{Options, Simulation};
    // Clamped along its rim, 1 mm thick: 0.00126532 p a^4 / D in the middle (Timoshenko and Woinowsky-Krieger
    // have 0.00126; the series of Taylor and Govindjee the rest).
    let (files, n) = ([("plate.stl", text(&square(20)).into_bytes()), ("plate-binary.stl", binary(&square(20)))], 20);
    let names: Vec<(&str, &[u8])> = files.iter().map(|(name, bytes)| (*name, &bytes[..])).collect();
    let folder = folder("plate", &names);
    let mut hashes = Vec::new();
    for (file, _) in &files {
        let model = format!(
            "run = {{ end = 1, relaxation = {{ tolerance = 1e-10 }} }}\n[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"210 GPa\"\npoisson = 0.3\n\
             [[part]]\nname = \"plate\"\nmaterial = \"steel\"\nelement = \"shell3\"\nsection = {{ thickness = \"1 mm\", points = 2 }}\n\
             mesh = {{ file = \"{file}\", group = \"all\", scale = \"1 mm\" }}\n\
             [[constraint]]\non = \"rim\"\nfixed = [\"x\", \"y\", \"z\", \"rotation\"]\n[[load]]\npressure = 100\non = \"plate.lower\"\n"
        );
        let model = load_text("m", &model, &folder, &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
        let mut simulation = Simulation::new(&model, &Options::default()).unwrap_or_else(|error| panic!("{error:#?}"));
        let start = simulation.frame().positions::<3>().to_vec();
        let middle = start.iter().position(|x| (x[0] - 0.05).abs() + (x[1] - 0.05).abs() + x[2].abs() < 1e-6).unwrap();
        assert_eq!(model.meshes[0].positions.len(), (n + 1) * (n + 1));
        simulation.advance(model.run.end, u64::MAX).unwrap();
        let stiffness = 210e9 * 1e-9 / (12.0 * 0.91);
        let (found, expected) = (simulation.frame().positions::<3>()[middle][2], 0.001_265_32 * 100.0 * 1e-4 / stiffness);
        assert!((found / expected - 1.0).abs() < 0.01, "{found:e} instead of {expected:e}");
        hashes.push(simulation.summary().state_hash);
    }
    assert_eq!(hashes[0], hashes[1]);
}

#[test]
fn what_of_an_stl_file_is_no_shell_is_reported_with_its_place() {
    let mut turned = square(2);
    turned[3].swap(0, 1);
    let folder = folder("turned", &[("turned.stl", &binary(&turned)), ("sound.stl", &binary(&square(2)))]);
    let model = |file: &str, element: &str| {
        let model = format!(
            "run.end = 1\n[material.steel]\nlaw = \"elastic\"\ndensity = 7800\nyoung = \"210 GPa\"\npoisson = 0.3\n\
             [[part]]\nname = \"plate\"\nmaterial = \"steel\"\n{element}\nmesh = {{ file = \"{file}\", group = \"all\", scale = \"1 mm\" }}\n"
        );
        load_text("m", &model, &folder, &[])
    };
    let shell = "element = \"shell3\"\nsection = { thickness = \"1 mm\" }";
    assert!(model("sound.stl", shell).is_ok());
    let told = model("turned.stl", shell).unwrap_err().rendered;
    assert!(told.contains("E0241") && told.contains("look to different sides of the surface"), "{told}");
}
