//! Models before they run: where glyphs stand and point, what is left of faulty models, and the picture.

use embate_files::PathPolicy;
use embate_files::picture::model_png;
use embate_files::preview::{Glyph, Preview, Source};
use embate_files::results::film_settings;
use embate_files::view::{FrameRequest, ModelView, ProbePlace, RangeOf};
use embate_solver::simulation::{Options, Simulation};
use std::fs;
use std::path::{Path, PathBuf};

/// A block on a plate: held below, symmetric at x = 0, pressed on its right side, thrown downwards.
const PLANE: &str = r#"
run = { end = "60 us" }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [
    { name = "block", material = "steel", rectangle = { corner = [0, "20 mm"], size = [0.02, 0.01], elements = [40, 20] }, velocity = [0, "-5 m/s"] },
    { name = "plate", material = "steel", rectangle = { corner = [0, 0], size = [0.03, 0.0199], elements = [60, 20] } },
]
symmetry = [{ normal = [1, 0] }]
constraint = [{ on = "plate.bottom", fixed = ["x", "y"] }, { on = "plate.right", fixed = ["x"] }, { on = "block.top", velocity = { y = "-5 m/s" } }]
load = [{ on = "block.right", pressure = "1 MPa" }, { gravity = [0, -9.81] }]
contact = [{ name = "hit", between = ["block.bottom", "plate.top"] }]
probe = [{ name = "tip", part = "block", point = [0, "30 mm"] }]
"#;

/// A cube that is pressed and glued.
const SPACE: &str = r#"
run = { end = "20 us" }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [
    { name = "upper", material = "steel", box = { corner = [0, 0, 0.01], size = [0.01, 0.01, 0.01], elements = [12, 12, 12] }, spin = 100 },
    { name = "lower", material = "steel", box = { corner = [0, 0, 0], size = [0.01, 0.01, 0.01], elements = [12, 12, 12] } },
]
constraint = [{ on = "lower.back", fixed = ["z"] }]
load = [{ on = "upper.front", pressure = "1 MPa" }]
contact = [{ name = "glue", between = ["upper.back", "lower.front"], tied = true }]
cut = [{ name = "middle", point = [0, 0, 0.005], normal = [0, 0, 1] }]
"#;

fn written(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("preview").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("model.toml"), text).unwrap();
    folder
}

fn read(folder: &Path) -> Preview {
    Source::read(folder, &[], PathPolicy::Folder).preview(&|model| Simulation::new(model, &Options::default())).0
}

fn of<'a>(preview: &'a Preview, kind: &str, path: &str) -> &'a Glyph {
    let found = preview.glyphs.iter().find(|glyph| glyph.kind.name == kind && glyph.path == path);
    found.unwrap_or_else(|| panic!("no {kind} of {path}: {:?}", preview.glyphs))
}

fn is_near(a: [f64; 3], b: [f64; 3]) -> bool {
    (0..3).all(|d| (a[d] - b[d]).abs() < 1e-9)
}

#[test]
fn glyphs_stand_where_things_act_and_point_as_they_do() {
    let preview = read(&written("plane", PLANE));
    assert_eq!((preview.faults.count, preview.warnings.count), (0, 0), "{}", preview.faults.rendered);
    let held = of(&preview, "support", "constraint[0]");
    assert!(held.points.len() > 20 && held.points.len() < 61, "of 61 nodes some: {}", held.points.len());
    assert!(held.points.iter().all(|x| x[1] == 0.0) && held.vectors.iter().all(|v| *v == [0.0; 3]), "held along all axes");
    assert_eq!(held.text, "fixed = [\"x\", \"y\"]");
    assert!(of(&preview, "support", "constraint[1]").vectors.iter().all(|v| *v == [1.0, 0.0, 0.0]));
    let driven = of(&preview, "motion", "constraint[2]");
    assert!(driven.vectors.iter().all(|v| *v == [0.0, -1.0, 0.0]) && driven.points.iter().all(|x| (x[1] - 0.03).abs() < 1e-12));
    let pressed = of(&preview, "pressure", "load[0]");
    assert!(pressed.points.iter().all(|x| (x[0] - 0.02).abs() < 1e-12) && pressed.vectors.iter().all(|v| is_near(*v, [-1.0, 0.0, 0.0])));
    // The block moves as one: one arrow in its middle.
    let flies = of(&preview, "velocity", "part[0]");
    assert!(flies.points.len() == 1 && is_near(flies.points[0], [0.01, 0.025, 0.0]) && is_near(flies.vectors[0], [0.0, -1.0, 0.0]));
    assert_eq!(flies.text, "velocity = [0, \"-5 m/s\"]");
    let falls = of(&preview, "gravity", "load[1]");
    assert!(falls.points.len() == 2 && falls.vectors.iter().all(|v| is_near(*v, [0.0, -1.0, 0.0])));
    let touches = of(&preview, "contact", "contact[0]");
    assert!(touches.points.iter().all(|x| x[1] == 0.02 || (x[1] - 0.0199).abs() < 1e-12) && touches.points.len() > 40);
    let line = of(&preview, "symmetry", "symmetry[0]");
    assert!(line.points.len() == 2 && line.points.iter().all(|x| x[0].abs() < 1e-12) && line.points[1][1] > 0.03);
    assert_eq!(of(&preview, "probe", "probe[0]").points, [[0.0, 0.03, 0.0]]);
    let governor = of(&preview, "governor", "run");
    assert!(preview.overview.as_ref().unwrap().governor.contains("element") && governor.points.len() == 1);
}

#[test]
fn a_contact_of_bodies_has_dots_on_the_outside_of_its_bodies_alone() {
    let dots = |bodies: &str| {
        let text = PLANE.replace(r#"between = ["block.bottom", "plate.top"]"#, &format!("bodies = {bodies}"));
        let preview = read(&written("bodies", &text));
        assert_eq!(preview.faults.count, 0, "{}", preview.faults.rendered);
        of(&preview, "contact", "contact[0]").clone()
    };
    let outside = |[x, y, _]: [f64; 3], [low, high]: [[f64; 2]; 2]| {
        let is_at = |value: f64, end: f64| (value - end).abs() < 1e-9;
        is_at(x, low[0]) || is_at(x, high[0]) || is_at(y, low[1]) || is_at(y, high[1])
    };
    let (block, plate) = ([[0.0, 0.02], [0.02, 0.03]], [[0.0, 0.0], [0.03, 0.0199]]);
    let one = dots(r#"["block"]"#);
    assert!(one.points.len() > 40 && one.points.iter().all(|&x| outside(x, block)));
    // Outward: away from the middle of the block.
    assert!(one.points.iter().zip(&one.vectors).all(|(x, n)| n[0] * (x[0] - 0.01) + n[1] * (x[1] - 0.025) > 0.004));
    let all = dots(r#""all""#);
    let of_plate = all.points.iter().filter(|x| x[1] < 0.01995).count();
    assert!(of_plate > 40 && of_plate < all.points.len() && all.points.iter().all(|&x| outside(x, block) || outside(x, plate)));
}

#[test]
fn in_3d_pressure_points_into_the_body_and_spins_go_around() {
    let preview = read(&written("space", SPACE));
    assert_eq!(preview.faults.count, 0, "{}", preview.faults.rendered);
    let pressed = of(&preview, "pressure", "load[0]");
    assert!(pressed.points.len() > 30 && pressed.points.len() <= 60, "{}", pressed.points.len());
    assert!(pressed.points.iter().all(|x| (x[2] - 0.02).abs() < 1e-12) && pressed.vectors.iter().all(|v| is_near(*v, [0.0, 0.0, -1.0])));
    assert!(of(&preview, "support", "constraint[0]").vectors.iter().all(|v| *v == [0.0, 0.0, 1.0]));
    assert!(of(&preview, "tie", "contact[0]").points.iter().all(|x| (x[2] - 0.01).abs() < 1e-12));
    let spin = of(&preview, "velocity", "part[0]");
    for (x, v) in spin.points.iter().zip(&spin.vectors) {
        let arm = [x[0] - 0.005, x[1] - 0.005];
        assert!((arm[0] * v[0] + arm[1] * v[1]).abs() < 1e-9 && arm[0] * v[1] - arm[1] * v[0] > 0.0, "{x:?} {v:?}");
    }
    let corners = &of(&preview, "cut", "cut[0]").points;
    assert!(corners.len() == 4 && corners.iter().all(|x| (x[2] - 0.005).abs() < 1e-12));
}

#[test]
fn faults_are_ringed_on_what_is_left_of_the_model() {
    // A name that is not there: the part is drawn all the same.
    let preview =
        read(&written("material", &PLANE.replace("name = \"block\", material = \"steel\"", "name = \"block\", material = \"steal\"")));
    assert!(preview.faults.count == 1 && preview.has_bodies() && preview.cells.len() == 2000, "{}", preview.faults.rendered);
    let ring = of(&preview, "fault", "part[0].material");
    assert!(is_near(ring.points[0], [0.01, 0.025, 0.0]) && ring.vectors[0][0] > 0.011 && ring.text.contains("steal"), "{ring:?}");
    // A part that can't be meshed is left out.
    let preview = read(&written("shape", &PLANE.replace("size = [0.02, 0.01]", "size = [0.02, -0.01]")));
    assert!(
        preview.faults.count >= 1 && preview.cells.len() == 1200 && preview.cells.part_names == ["plate"],
        "{:?}",
        preview.cells.part_names
    );
    assert!(preview.glyphs.iter().any(|glyph| glyph.kind.name == "support"));
    // Found when the simulation is made: nodes that are inside.
    let preview = read(&written("inside", &PLANE.replace("0.0199", "0.0201")));
    assert_eq!(preview.faults.entries[0].kind.code, "E0407", "{}", preview.faults.rendered);
    let rings = of(&preview, "fault", "contact[0]");
    assert!(rings.points.len() > 5 && rings.points.iter().all(|x| x[1] > 0.0199 && x[1] < 0.0202), "{:?}", rings.points);
    // A surface that is not there: the other one of the contact shows where.
    let preview = read(&written("surface", &PLANE.replace("plate.top", "plate.topp")));
    assert!(preview.faults.count == 1, "{}", preview.faults.rendered);
    let ring = preview.glyphs.iter().find(|glyph| glyph.kind.name == "fault").unwrap();
    assert!(ring.path.starts_with("contact[0]") && ring.points.iter().all(|x| (x[1] - 0.02).abs() < 1e-12), "{ring:?}");
}

#[test]
fn a_file_that_is_no_model_has_faults_and_nothing_to_see() {
    let preview = read(&written("syntax", "run = {"));
    assert!(!preview.has_bodies() && preview.faults.count == 1 && preview.faults.entries[0].line > 0 && preview.glyphs.is_empty());
    let preview = read(Path::new("nowhere.toml"));
    assert!(!preview.has_bodies() && preview.faults.count == 1 && preview.files.len() == 1);
    let view = ModelView::new(Path::new("nowhere.toml"), preview, None);
    assert_eq!((view.about()["has_bodies"].as_bool(), view.description().elements), (Some(false), 0));
    assert!(!view.frame(&FrameRequest::default()).bytes().is_empty());
}

#[test]
fn hostile_models_do_no_harm() {
    for (name, text) in [
        ("empty", String::new()),
        ("names", PLANE.replace("plate.bottom", "").replace("block.right", "block.right.left")),
        ("far", PLANE.replace("point = [0, \"30 mm\"]", "point = [1e300, -1e300]")),
        ("axis", SPACE.replace("normal = [0, 0, 1]", "normal = [0, 0, 0]")),
        ("many", PLANE.replace("elements = [40, 20]", "elements = [4000000, 4000000]")),
        ("huge", PLANE.replace("0.02, 0.01", "1e200, 1e200")),
        ("twice", PLANE.replace("\"plate\"", "\"block\"")),
    ] {
        let folder = written(name, &text);
        let preview = read(&folder);
        if preview.has_bodies() {
            let settings = film_settings(preview.model.as_ref().unwrap());
            model_png((&preview.frame, &preview.cells, &preview.glyphs), &settings, &folder.join("check.png")).unwrap();
        }
        let view = ModelView::new(&folder, preview, None);
        assert!(
            !view.frame(&FrameRequest { scalar: Some("element_quality".into()), ..FrameRequest::default() }).bytes().is_empty(),
            "{name}"
        );
    }
}

#[test]
fn the_picture_has_what_acts_in_its_colours() {
    for (name, text) in [("picture-plane", PLANE), ("picture-space", SPACE)] {
        let folder = written(name, text);
        let preview = read(&folder);
        let (settings, path) = (film_settings(preview.model.as_ref().unwrap()), folder.join("check.png"));
        model_png((&preview.frame, &preview.cells, &preview.glyphs), &settings, &path).unwrap();
        let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        for kind in ["support", "pressure", "velocity"] {
            let colour = preview.glyphs.iter().find(|glyph| glyph.kind.name == kind).unwrap().kind.colour;
            let count = pixels.as_chunks::<3>().0.iter().filter(|pixel| **pixel == colour).count();
            assert!(count > 60, "{name} {kind}: {count} pixels");
        }
    }
}

#[test]
fn states_of_a_file_have_numbers_and_bodies_of_their_own() {
    let folder = written("states", PLANE);
    let first = ModelView::new(&folder, read(&folder), None);
    assert_eq!((first.version, first.description().elements, first.bodies().without(&[]).id), (1, 2000, 0));
    let range = first.range("element_quality", RangeOf::default()).0.unwrap();
    // Squares in the block, 0.5 x 0.995 mm in the plate.
    assert!((range[0] - 0.5 / 0.995).abs() < 1e-4 && (range[1] - 1.0).abs() < 1e-4, "{range:?}");
    let probed = first.probe("stable_step", ProbePlace::Cell(0)).unwrap();
    assert!(probed.unit == "s" && probed.values[0].unwrap() > 0.0 && first.probe("stable_step", ProbePlace::Cell(2000)).is_none());
    let corner = first.track(ProbePlace::Node(0)).unwrap();
    assert_eq!((corner.positions.len(), corner.positions[0]), (1, corner.initial));
    fs::write(folder.join("model.toml"), PLANE.replace("elements = [40, 20]", "elements = [20, 20]")).unwrap();
    let second = ModelView::new(&folder, read(&folder), Some(&first));
    assert_eq!((second.version, second.description().elements, second.bodies().without(&[]).id), (2, 1600, 1));
    assert_eq!(second.description().frames[0].number, 2);
    assert!(second.about()["faults"].as_array().unwrap().is_empty());
}
