//! What reads files, with inputs that it takes: for the damaged inputs of the tests beside, and for those
//! that `fuzz/` finds by coverage.
#![allow(clippy::unwrap_used)] // inputs are those of the source
#![allow(missing_docs, unreachable_pub)] // another crate has it as a file of its own

use embate_files::checkpoint::{self, Checkpoint};
use embate_files::results::{Recorder, ResultFolder};
use embate_files::threads::Threads;
use embate_files::view::{FrameRequest, ProbePlace, RangeOf, ResultView, SectionRequest};
use embate_files::{abaqus, gmsh, model_file};
use embate_solver::archive::Section;
use embate_solver::model::Model;
use embate_solver::simulation::{Control, Observer, Options, Simulation};
use std::fs;
use std::path::{Path, PathBuf};

/// Reads bytes; panics where the answer is wrong.
pub type Read = Box<dyn Fn(&[u8])>;

/// A reader with inputs that it takes.
pub struct Target {
    pub name: &'static str,
    pub seeds: Vec<Vec<u8>>,
    pub read: Read,
}

/// Files of a folder and those below with this ending, not longer than a few pages.
fn files(folder: &Path, ending: &str) -> Vec<Vec<u8>> {
    let mut found: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    let of = |path: PathBuf| {
        if path.is_dir() {
            files(&path, ending)
        } else {
            Vec::from_iter(path.to_str().unwrap().ends_with(ending).then(|| fs::read(path).unwrap()))
        }
    };
    found.into_iter().flat_map(of).filter(|bytes| bytes.len() < 10_000).collect()
}

fn here(path: &str) -> PathBuf {
    Path::new(crate::FILES).join(path)
}

pub fn model() -> Target {
    let seeds = [files(&here("../../examples"), ".toml"), files(&here("../../verification"), ".toml")].concat();
    let folder = here("../../examples/tube-plate-gmsh");
    let read = move |bytes: &[u8]| {
        if let Ok(text) = std::str::from_utf8(bytes) {
            let _ = model_file::load_text("model.toml", text, &folder, &[]);
        }
    };
    Target { name: "model", seeds, read: Box::new(read) }
}

pub fn gmsh() -> Target {
    let read = |bytes: &[u8]| {
        if let Ok(mesh) = gmsh::parse(bytes, "m.msh", 1.0) {
            let nodes = mesh.positions.len();
            assert!(
                mesh.groups.iter().flat_map(|group| &group.cells).flatten().all(|&node| (node as usize) < nodes),
                "a node that is not there"
            );
            assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()), "a place that is nowhere");
        }
    };
    Target { name: "gmsh", seeds: files(&here("tests/gmsh"), ".msh"), read: Box::new(read) }
}

pub fn deck() -> Target {
    let folder = here("tests/abaqus");
    let seeds = files(&folder, ".inp");
    let read = move |bytes: &[u8]| drop(abaqus::parse(bytes, "m.inp", &folder, 1.0));
    Target { name: "deck", seeds, read: Box::new(read) }
}

/// Two blocks that meet, with friction, failure and a wall.
const MEETING: &str = r#"
run.end = "1 ms"
material.steel = { law = "j2", density = 7800, young = "200 GPa", poisson = 0.3, yield = "100 MPa", hardening = "1 GPa", failure = { plastic_strain = 0.5 } }
part = [
    { name = "a", material = "steel", element = "quad4_reduced", rectangle = { corner = [0, 0], size = [0.01, 0.01], elements = [1, 1] }, velocity = [50, 0] },
    { name = "b", material = "steel", rectangle = { corner = [0.01, 0.001], size = [0.01, 0.01], elements = [1, 1] } },
]
contact = [{ name = "all", bodies = "all", friction = 0.3 }]
obstacle = [{ name = "wall", plane = { point = [0.0201, 0], normal = [-1, 0] } }]
output.pictures = false
"#;

/// The meeting after some steps.
fn met() -> (Model, Simulation) {
    let model: Model =
        model_file::load_text("model.toml", MEETING, Path::new("."), &[]).unwrap_or_else(|reported| panic!("{}", reported.rendered));
    let mut simulation = Simulation::new(&model, &ALONE).unwrap();
    simulation.advance(f64::INFINITY, 30).unwrap();
    (model, simulation)
}

const ALONE: Options = Options { threads: 1, simd: None };

/// Files of checkpoints. Who damages one may make its check sums again: they are set right where the reader
/// looks for them.
pub fn checkpoint() -> Target {
    let (model, mut simulation) = met();
    let folder = tempfile::tempdir().unwrap();
    let threads = Threads::one();
    Checkpoint::of(simulation.state().unwrap(), &model).write(folder.path(), &threads).unwrap();
    let seeds = vec![fs::read(&checkpoint::generations(folder.path())[0].path).unwrap()];
    let read = move |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        let _ = sign(&mut bytes);
        let _ = Checkpoint::parse(&bytes, Path::new("c"), &threads);
    };
    Target { name: "checkpoint", seeds, read: Box::new(read) }
}

/// Sets the check sums of a file of a checkpoint right, as far as its lengths lead.
fn sign(bytes: &mut [u8]) -> Option<()> {
    let number = |bytes: &[u8], at: usize| Some(u64::from_le_bytes(bytes.get(at..at.checked_add(8)?)?.try_into().ok()?));
    let short = |bytes: &[u8], at: usize| Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?) as usize);
    let sum = |bytes: &mut [u8], of: std::ops::Range<usize>, at: usize| {
        let mut crc = flate2::Crc::new();
        crc.update(bytes.get(of)?);
        bytes.get_mut(at..at.checked_add(4)?)?.copy_from_slice(&crc.sum().to_le_bytes());
        Some(())
    };
    let mut at = 16usize.checked_add(short(bytes, 12)?)?;
    sum(bytes, 0..at, at)?;
    at += 4;
    while at < bytes.len() {
        let lead = at;
        let name = at.checked_add(4)?.checked_add(short(bytes, at)?)?;
        let packed = usize::try_from(number(bytes, name.checked_add(8)?)?).ok()?;
        let begin = name.checked_add(24)?;
        at = begin.checked_add(packed)?;
        sum(bytes, begin..at.min(bytes.len()), begin - 8)?;
        sum(bytes, lead..begin - 4, begin - 4)?;
    }
    Some(())
}

/// States behind their check sums: who damages those, too, gets an error or another run, but no panic.
pub fn state() -> Target {
    let (model, mut simulation) = met();
    let sections = simulation.state().unwrap().sections;
    let seeds = vec![sections.iter().flat_map(|section| section.bytes.clone()).collect()];
    let read = move |bytes: &[u8]| {
        // Lengths of the sections are the container's: what is damaged is within.
        let mut rest = bytes;
        let last = sections.len() - 1;
        let cut = |(i, section): (usize, &Section)| {
            let (own, others) = rest.split_at(if i == last { rest.len() } else { section.bytes.len().min(rest.len()) });
            rest = others;
            Section { name: section.name.clone(), bytes: own.to_vec() }
        };
        let damaged: Vec<Section> = sections.iter().enumerate().map(cut).collect();
        if let Ok(mut simulation) = Simulation::resumed(&model, &ALONE, &damaged) {
            let _ = simulation.advance(f64::INFINITY, 3);
            let _ = simulation.summary();
        }
    };
    Target { name: "state", seeds, read: Box::new(read) }
}

/// Field files: whatever stands in one, it is shown or refused.
pub fn fields() -> Target {
    let (model, simulation) = met();
    let folder = tempfile::tempdir().unwrap();
    let results = ResultFolder::create(folder.path(), true).unwrap();
    let shown = (simulation.history_columns(), simulation.cells());
    let mut recorder = Recorder::keeping(results, &model, shown, 1, None, Box::new(|_| Control::Continue)).unwrap();
    recorder.frame(simulation.frame()).unwrap();
    drop(recorder);
    let files = [0, 1].map(|number| folder.path().join(format!("fields/frame-0000{number}.vtu")));
    let sound = fs::read(&files[0]).unwrap();
    let seeds = vec![sound.clone()];
    let read = move |bytes: &[u8]| {
        // Damaged is the first frame, which reports the mesh, or a later one.
        for damaged in 0..2 {
            fs::write(&files[damaged], bytes).unwrap();
            fs::write(&files[1 - damaged], &sound).unwrap();
            let Ok(view) = ResultView::open(folder.path()) else { continue };
            for scalar in ["velocity", "stress.xy"] {
                let section = SectionRequest::read("1,0.5,0.2,0", 2.0).ok();
                let request =
                    FrameRequest { scalar: Some(scalar.into()), averaged: true, arrows: true, glyphs: Some("stress".into()), section };
                let _ = [0, 1].map(|number| view.frame(number, &request));
                let _ = [ProbePlace::Node(3), ProbePlace::Cell(3)].map(|place| view.probe(scalar, place));
                let _ = [false, true].map(|inside| view.range(scalar, RangeOf { inside, averaged: inside }));
                let _ = view.track(ProbePlace::Cell(3));
            }
            let _ = view.description();
        }
    };
    Target { name: "fields", seeds, read: Box::new(read) }
}
