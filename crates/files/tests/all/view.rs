//! What a page shows of result folders that a simulation has filled, held against the simulation itself;
//! damaged folders.

use embate_files::checkpoint::Origin;
use embate_files::model_file;
use embate_files::results::{Checkpoints, History, Recorder, ResultFolder, ResultsError};
use embate_files::view::{Bodies, FrameRequest, ProbePlace, RangeOf, ResultView, SectionRequest, frame, gone, outlines};
use embate_solver::output::{Frame, Shown};
use embate_solver::simulation::{Control, Observer, ObserverError, Options, Progress, Simulation, State};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A block that loses its tip on a wall.
const PLANE: &str = r#"
title = "a block <b>"
run = { end = "60 us" }
material.steel = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "100 MPa", hardening = "1 GPa", failure = { plastic_strain = 0.15 } }
part = [{ name = "block", material = "steel", rectangle = { corner = ["1 mm", 0], size = [0.02, 0.01], elements = [8, 4] }, velocity = [-300, 0] }]
obstacle = [{ name = "wall", plane = { point = [0, 0], normal = [1, 0] } }]
output = { fields = 12, history = 30, pictures = false }
"#;

/// Two cubes that meet.
const SPACE: &str = r#"
run = { end = "20 us" }
material.steel = { law = "elastic", density = 7800, young = "200 GPa", poisson = 0.3 }
part = [
    { name = "a", material = "steel", box = { corner = [0, 0, 0], size = [0.01, 0.01, 0.01], elements = [3, 3, 3] }, velocity = [50, 0, 0] },
    { name = "b", material = "steel", box = { corner = [0.0101, 0.001, 0.002], size = [0.01, 0.01, 0.01], elements = [3, 3, 3] } },
]
contact = [{ name = "all", bodies = "all" }]
output = { fields = 4, history = 10, pictures = false, camera = { from = [1, -1, 0.6] } }
"#;

fn fresh(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    path
}

/// Keeps the frames that go to the recorder.
struct Kept<'a> {
    recorder: Recorder<'a>,
    frames: Vec<Frame>,
}

impl Observer for Kept<'_> {
    fn frame(&mut self, frame: Frame) -> Result<(), ObserverError> {
        self.frames.push(frame.clone());
        self.recorder.frame(frame)
    }
    fn row(&mut self, row: &[f64]) -> Result<(), ObserverError> {
        self.recorder.row(row)
    }
    fn state(&mut self, state: State) -> Result<(), ObserverError> {
        self.recorder.state(state)
    }
    fn progress(&mut self, progress: &Progress<'_>) -> Control {
        self.recorder.progress(progress)
    }
}

/// Runs a model into a folder; its frames.
fn run(text: &str, folder: &Path) -> (Vec<Frame>, Simulation) {
    let model = model_file::load_text("model.toml", text, folder, &[]).unwrap_or_else(|reported| panic!("{}", reported.rendered));
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    let results = ResultFolder::create(folder, true).unwrap();
    let shown = (simulation.history_columns(), simulation.cells());
    let checkpoints =
        Checkpoints::of(&model, Origin { path: "models/model.toml".into(), set: vec!["run.safety=0.9".into()], ..Origin::default() });
    let recorder = Recorder::keeping(results, &model, shown, 1, Some(checkpoints), Box::new(|_| Control::Continue)).unwrap();
    let mut kept = Kept { recorder, frames: Vec::new() };
    simulation.run(&mut kept).unwrap();
    let outcome = kept.recorder.finish(None, &simulation.summary(), || None);
    assert!(outcome.unwritten.is_none());
    (kept.frames, simulation)
}

fn frame_request(scalar: &str) -> FrameRequest {
    FrameRequest { scalar: Some(scalar.into()), arrows: true, ..FrameRequest::default() }
}

/// Head of a container.
fn head(bytes: &[u8]) -> Value {
    let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[8..8 + length]).unwrap()
}

fn array<'a>(bytes: &'a [u8], name: &str) -> &'a [[u8; 4]] {
    let begin = 8 + u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
    let head = head(bytes);
    let number = |key: &str| head["arrays"][name][key].as_u64().unwrap() as usize;
    bytes[begin + number("offset")..][..4 * number("count")].as_chunks().0
}

#[test]
fn frames_of_a_folder_are_those_that_the_simulation_has_shown() {
    for (name, model, scalars) in [
        ("view-plane", PLANE, &["velocity", "stress.xy", "von_mises", "plastic_strain", "contact_gap"][..]),
        ("view-space", SPACE, &["velocity.z", "displacement", "stress.zx", "contact_pressure"][..]),
    ] {
        let folder = fresh(name);
        let (frames, simulation) = run(model, &folder);
        let view = ResultView::open(&folder).unwrap();
        let bodies = Bodies::new(simulation.cells(), &frames[0]);
        for (number, shown) in frames.iter().enumerate() {
            for scalar in scalars {
                let from_file = view.frame(number, &frame_request(scalar)).unwrap().unwrap().bytes();
                let direct = frame(&bodies, &bodies.without(&gone(shown)), shown, &outlines(shown), &frame_request(scalar)).bytes();
                for name in ["positions", "values", "arrow_nodes", "arrows"] {
                    assert!(array(&from_file, name) == array(&direct, name), "{name} of {scalar} in frame {number}");
                }
                let (file, direct) = (head(&from_file), head(&direct));
                assert_eq!((&file["range"], &file["time"], &file["scalar"]), (&direct["range"], &direct["time"], &direct["scalar"]));
                assert!(!array(&from_file, "values").is_empty(), "{scalar}");
            }
        }
        assert!(view.frame(frames.len(), &frame_request("velocity")).unwrap().is_none());
    }
}

#[test]
fn eroded_cells_have_gone_from_the_topology_of_their_frame() {
    let folder = fresh("view-erosion");
    let (frames, simulation) = run(PLANE, &folder);
    let last = frames.len() - 1;
    assert!(!gone(&frames[last]).is_empty(), "the tip is lost");
    let view = ResultView::open(&folder).unwrap();
    let first = head(&view.frame(0, &frame_request("velocity")).unwrap().unwrap().bytes());
    let end = head(&view.frame(last, &frame_request("velocity")).unwrap().unwrap().bytes());
    assert_ne!(first["topology"], end["topology"]);
    let topology = view.bodies().numbered(end["topology"].as_u64().unwrap() as usize).unwrap();
    let bytes = view.bodies().container(&topology).bytes();
    assert_eq!(array(&bytes, "facets").len(), 4 * (simulation.elements() - gone(&frames[last]).len()));
    // A cell has values until it is gone.
    let lost = gone(&frames[last])[0] as usize;
    let probed = view.probe("von_mises", ProbePlace::Cell(lost)).unwrap().unwrap();
    assert!(probed.values[0].is_some() && probed.values[last].is_none() && probed.times.len() == frames.len());
}

fn floats(bytes: &[u8], name: &str) -> Vec<f64> {
    array(bytes, name).iter().map(|four| f64::from(f32::from_le_bytes(*four))).collect()
}

fn indices(bytes: &[u8], name: &str) -> Vec<usize> {
    array(bytes, name).iter().map(|four| u32::from_le_bytes(*four) as usize).collect()
}

/// Corners of each triangle of a section from the middle of the bodies, m, and its area.
fn triangles(bytes: &[u8]) -> Vec<([[f64; 3]; 3], f64)> {
    let points = floats(bytes, "section_points");
    let corners = indices(bytes, "section_facets");
    let triangle = |own: &[usize; 3]| {
        let corners = own.map(|corner| [0, 1, 2].map(|k| points[3 * corner + k]));
        let [u, v] = [1, 2].map(|c| [0, 1, 2].map(|k| corners[c][k] - corners[0][k]));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        (corners, 0.5 * n.iter().map(|n| n * n).sum::<f64>().sqrt())
    };
    corners.as_chunks().0.iter().map(triangle).collect()
}

#[test]
fn sections_of_a_frame_have_the_area_of_the_bodies_and_the_values_inside() {
    let folder = fresh("view-section");
    let (frames, simulation) = run(SPACE, &folder);
    let view = ResultView::open(&folder).unwrap();
    let cells = simulation.cells();
    let section = |number: usize, planes: &str, scale: f64, scalar: &str, averaged: bool| {
        let section = Some(SectionRequest::read(planes, scale).unwrap());
        view.frame(number, &FrameRequest { scalar: Some(scalar.into()), averaged, section, ..FrameRequest::default() })
            .unwrap()
            .unwrap()
            .bytes()
    };
    // Both cubes of 10 mm at z = 4 mm, and the first one alone along its diagonal plane.
    let bytes = section(0, "0,0,1,0.004;1,-1,0,0", 1.0, "velocity.x", false);
    let heads = head(&bytes)["sections"].as_array().unwrap().clone();
    let count = heads[0]["facets"].as_u64().unwrap() as usize;
    let all = triangles(&bytes);
    let parts = indices(&bytes, "section_parts");
    let area = |range: std::ops::Range<usize>| range.map(|k| all[k].1).sum::<f64>();
    assert!((area(0..count) - 2e-4).abs() < 1e-9, "{}", area(0..count));
    let first: f64 = (count..all.len()).filter(|&k| parts[k] == 0).map(|k| all[k].1).sum();
    assert!((first - 2f64.sqrt() * 1e-4).abs() < 1e-9, "{first}");
    // Colours are those of the cells, and of the nodes in between; the range has what is seen inside.
    let last = frames.len() - 1;
    let bytes = section(last, "1,0.2,0.1,0.009", 1.0, "stress.xx", false);
    let place = frames[last].kinds().iter().position(|kind| kind.name == "stress").unwrap();
    let stress = |cell: usize| f64::from(frames[last].fields[place].values[6 * cell] as f32);
    let (values, own) = (floats(&bytes, "section_values"), indices(&bytes, "section_cells"));
    assert!(values.len() == own.len() && values.iter().zip(&own).all(|(value, &cell)| *value == stress(cell)));
    let [low, high] = [0, 1].map(|end| head(&bytes)["range"][end].as_f64().unwrap());
    assert!(values.iter().all(|value| (low..=high).contains(value)));
    // Averaged, they lie between those of the cells that meet.
    let bytes = section(last, "1,0.2,0.1,0.009", 1.0, "stress.xx", true);
    assert_eq!(head(&bytes)["location"], "corner");
    let corners = indices(&bytes, "section_facets");
    let values = floats(&bytes, "section_values");
    assert_eq!(values.len(), floats(&bytes, "section_points").len() / 3);
    let all: Vec<f64> = (0..cells.len()).map(stress).collect();
    let (least, most) = (all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    assert!(corners.iter().all(|&corner| values[corner] >= least && values[corner] <= most));
    // All that moves as a whole: magnified displacements move the section with the bodies.
    let (once, twice) = (section(last, "0,0,1,0.005", 1.0, "velocity.x", false), section(last, "0,0,1,0.005", 40.0, "velocity.x", false));
    assert!(triangles(&twice).len() >= triangles(&once).len() && floats(&once, "section_points") != floats(&twice, "section_points"));
    // Glyphs: one of each polygon, of whose triangles the middle is the third corner.
    let glyphs = |name: &str| {
        let section = Some(SectionRequest::read("0,0,1,0.005", 1.0).unwrap());
        let request = FrameRequest { glyphs: Some(name.into()), section, ..FrameRequest::default() };
        view.frame(0, &request).unwrap().unwrap().bytes()
    };
    let bytes = glyphs("velocity");
    let (vectors, nodes) = (floats(&bytes, "section_glyph_vectors"), indices(&bytes, "section_nodes"));
    let polygons = nodes.iter().filter(|&&node| node == u32::MAX as usize).count();
    assert!(polygons > 0 && vectors.len() == 3 * polygons);
    assert!(vectors.chunks(3).all(|v| v == [50.0, 0.0, 0.0] || v == [0.0; 3]) && vectors.contains(&50.0));
    assert_eq!(floats(&glyphs("stress"), "section_glyph_axes").len(), 9 * polygons);
    // The inside has a range of its own.
    let inside = view.range("stress.xx", RangeOf { inside: true, averaged: false }).unwrap().0.unwrap();
    let skin = view.range("stress.xx", RangeOf::default()).unwrap().0.unwrap();
    let averaged = view.range("stress.xx", RangeOf { inside: true, averaged: true }).unwrap().0.unwrap();
    assert!(inside[0] <= skin[0] && inside[1] >= skin[1] && averaged[0] >= inside[0] && averaged[1] <= inside[1]);
}

#[test]
fn a_track_is_where_the_node_is_and_probes_of_elements_are_the_means_of_their_nodes() {
    let folder = fresh("view-track");
    let (frames, simulation) = run(SPACE, &folder);
    let view = ResultView::open(&folder).unwrap();
    let track = view.track(ProbePlace::Node(5)).unwrap().unwrap();
    assert!(track.positions.iter().zip(&frames).all(|(place, frame)| *place == frame.place(5)));
    assert!(track.initial.iter().zip(frames[0].place(5)).all(|(a, b)| (a - b).abs() < 1e-15));
    assert!(view.track(ProbePlace::Node(1 << 20)).unwrap().is_none() && view.track(ProbePlace::Cell(1 << 20)).unwrap().is_none());
    let last = frames.len() - 1;
    let place = |name: &str| frames[last].kinds().iter().position(|kind| kind.name == name).unwrap();
    let cells = simulation.cells();
    let middle = view.track(ProbePlace::Cell(7)).unwrap().unwrap().positions[last];
    let own: Vec<[f64; 3]> = cells.cell(7).iter().map(|&node| frames[last].place(node as usize)).collect();
    assert!((0..3).all(|k| (own.iter().map(|place| place[k]).sum::<f64>() / 8.0 - middle[k]).abs() < 1e-15));
    let velocity = &frames[last].fields[place("velocity")].values;
    let mean: f64 = cells.cell(7).iter().map(|&node| velocity[3 * node as usize]).sum::<f64>() / 8.0;
    let probed = view.probe("velocity.x", ProbePlace::Cell(7)).unwrap().unwrap();
    assert!((probed.values[last].unwrap() - mean).abs() < 1e-12 * mean.abs().max(1.0));
    let around: Vec<usize> = (0..cells.len()).filter(|&cell| cells.cell(cell).contains(&21)).collect();
    let stress = &frames[last].fields[place("stress")].values;
    let mean = around.iter().map(|cell| stress[6 * cell]).sum::<f64>() / around.len() as f64;
    let probed = view.probe("stress.xx", ProbePlace::Node(21)).unwrap().unwrap();
    assert!((probed.values[last].unwrap() - mean).abs() <= 1e-9 * mean.abs(), "{:?} {mean}", probed.values[last]);
}

#[test]
fn obstacles_are_shown_until_their_death() {
    for (name, model, array_of) in [("view-death-plane", PLANE, "obstacle_lines"), ("view-death-space", SPACE, "obstacle_facets")] {
        let folder = fresh(name);
        let obstacle = if model == PLANE {
            model.replace("normal = [1, 0] } }", "normal = [1, 0] }, death = \"12 us\" }")
        } else {
            let wall = "obstacle = [{ name = \"wall\", plane = { point = [0, 0, -1e-4], normal = [0, 0, 1] }, death = \"12 us\" }]";
            format!("{model}{wall}")
        };
        let (frames, _) = run(&obstacle, &folder);
        let view = ResultView::open(&folder).unwrap();
        for (number, shown) in frames.iter().enumerate() {
            let bytes = view.frame(number, &FrameRequest::default()).unwrap().unwrap().bytes();
            assert_eq!(array(&bytes, array_of).is_empty(), shown.time > 12e-6, "{name} at {}", shown.time);
        }
    }
}

#[test]
fn a_probe_is_the_value_in_every_frame_and_the_range_is_over_all_of_them() {
    let folder = fresh("view-probe");
    let (frames, _) = run(SPACE, &folder);
    let view = ResultView::open(&folder).unwrap();
    let probed = view.probe("velocity.x", ProbePlace::Node(5)).unwrap().unwrap();
    let place = frames[0].kinds().iter().position(|kind| kind.name == "velocity").unwrap();
    let wanted: Vec<Option<f64>> = frames.iter().map(|frame| Some(frame.fields[place].values[15])).collect();
    assert_eq!((probed.values, probed.unit), (wanted, "m/s"));
    assert!(
        view.probe("velocity.x", ProbePlace::Node(1 << 20)).unwrap().is_none()
            && view.probe("smell", ProbePlace::Node(0)).unwrap().is_none()
    );
    // The blocks have no inner nodes with a velocity of their own beyond the first.
    let (range, count) = view.range("velocity.x", RangeOf::default()).unwrap();
    assert!(count == frames.len() && range.is_some_and(|[low, high]| low <= 0.0 && high >= 50.0), "{range:?}");
    assert_eq!(view.range("velocity.x", RangeOf::default()).unwrap().0, range, "what is kept");
}

#[test]
fn the_description_says_what_the_model_is_and_how_it_wants_to_be_shown() {
    let folder = fresh("view-description");
    run(PLANE, &folder);
    let description = ResultView::open(&folder).unwrap().description().unwrap();
    assert_eq!((description.title.as_str(), description.dimension, description.energy_unit), ("a block <b>", 2, "J/m"));
    assert_eq!((description.parts.len(), description.parts[0].elements, description.elements), (1, 32, 32));
    assert_eq!(
        (description.obstacles, description.end, description.scalar),
        (vec!["wall".to_string()], Some(60e-6), Some("plastic_strain".into()))
    );
    assert!(description.is_over && description.summary.is_some() && description.has_arrows);
    assert!(description.frames.windows(2).all(|pair| pair[0].time < pair[1].time));
    let keys: Vec<&str> = description.scalars.iter().map(|scalar| scalar.key.as_str()).collect();
    assert!(["velocity", "velocity.x", "stress.zz", "von_mises"].iter().all(|key| keys.contains(key)) && !keys.contains(&"stress"));

    let folder = fresh("view-description-space");
    run(SPACE, &folder);
    let description = ResultView::open(&folder).unwrap().description().unwrap();
    assert_eq!((description.dimension, description.energy_unit, description.arrow_unit), (3, "J", "N"));
    assert_eq!(description.camera.unwrap()["from"][1], -1.0);

    // Rigid bodies alone are shown in the colours of their parts, unless the model says otherwise.
    let rigid = SPACE.replace("elements = [3, 3, 3] }", "elements = [3, 3, 3] }, rigid = true");
    let chosen = rigid.replace("pictures = false", "pictures = false, picture_field = \"velocity\"");
    for (model, scalar) in [(rigid, None), (chosen, Some("velocity".to_string()))] {
        let folder = fresh("view-description-rigid");
        run(&model, &folder);
        let description = ResultView::open(&folder).unwrap().description().unwrap();
        assert!(description.parts.iter().all(|part| part.is_rigid));
        assert_eq!(description.scalar, scalar);
    }
}

#[test]
fn a_run_that_continues_is_shown_as_far_as_it_is() {
    let folder = fresh("view-going-on");
    run(PLANE, &folder);
    fs::remove_file(folder.join("summary.json")).unwrap();
    fs::remove_file(folder.join("fields.pvd")).unwrap();
    fs::remove_file(folder.join("fields/frame-00012.vtu")).unwrap();
    let history = fs::read_to_string(folder.join("history.csv")).unwrap();
    fs::write(folder.join("history.csv.part"), &history[..history.len() - 9]).unwrap();
    fs::remove_file(folder.join("history.csv")).unwrap();
    let view = ResultView::open(&folder).unwrap();
    let description = view.description().unwrap();
    assert!(!description.is_over && description.frames.len() == 12 && description.parts[0].name == "block");
    let rows = view.history(1000).unwrap().values[0].len();
    assert_eq!(rows + 1, history.lines().count() - 1, "all but the line that is being written");
    assert_eq!(History::read(&folder).unwrap().unwrap().rows(), rows);
}

#[test]
fn what_is_no_folder_of_results_is_refused_with_what_it_is() {
    let folder = fresh("view-nothing");
    let refused = |folder: &Path| match ResultView::open(folder) {
        Err(error @ ResultsError::NothingToSee { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(refused(&folder).contains("there is no such folder"));
    fs::create_dir_all(folder.join("fields")).unwrap();
    assert!(refused(&folder).contains("there are no results in it"));
    fs::write(folder.join("file"), "").unwrap();
    assert!(refused(&folder.join("file")).contains("it is a file"));
    fs::write(folder.join("summary.json"), "{}").unwrap();
    assert!(refused(&folder).contains("it has no field files"));
}

#[test]
fn damaged_files_are_reported_by_name_and_the_others_are_shown_all_the_same() {
    let folder = fresh("view-damaged");
    run(PLANE, &folder);
    let file = folder.join("fields/frame-00003.vtu");
    let sound = fs::read(&file).unwrap();
    let view = ResultView::open(&folder).unwrap();
    for damaged in [&sound[..sound.len() / 2], &sound[..200], b"", b"<VTKFile/>"] {
        fs::write(&file, damaged).unwrap();
        let error = view.frame(3, &frame_request("velocity")).unwrap_err().to_string();
        assert!(error.contains("frame-00003.vtu") && error.contains("run the model again"), "{error}");
        assert!(view.frame(4, &frame_request("velocity")).unwrap().is_some());
        assert!(view.range("velocity", RangeOf::default()).is_err() && view.probe("velocity", ProbePlace::Node(0)).is_err());
    }
    // A frame of another mesh.
    let other = fresh("view-damaged-other");
    run(&PLANE.replace("[8, 4]", "[4, 2]"), &other);
    fs::copy(other.join("fields/frame-00003.vtu"), &file).unwrap();
    assert!(view.frame(3, &frame_request("velocity")).unwrap_err().to_string().contains("the first frame has"));
    fs::write(folder.join("summary.json"), "{ \"model\":").unwrap();
    assert!(matches!(view.description(), Err(ResultsError::Damaged { .. })));
    fs::write(folder.join("history.csv"), "time,energy.total\n0,1\n1\n").unwrap();
    assert!(view.history(10).unwrap_err().to_string().contains("line 3"));
}
