//! Cost of contact in a step: `cargo bench -p embate-solver --bench contact [ELEMENTS [THREADS]]`.
//!
//! A stack of long strips, each so near to the next that every node of their long sides is in reach of the next strip; all in one contact of bodies with each other and
//! with themselves. At rest nothing presses; in motion every second strip moves against its neighbours. Told are the shares of the step that contact, its
//! tracking and the swept check take, and the time of a global search.

use embate_solver::contact::Sweep;
use embate_solver::contact::projection::node_segment::Target;
use embate_solver::contact::search::registry;
use embate_solver::contact::tracker::Tracker;
use embate_solver::mesh::Mesh;
use embate_solver::model::{Contact, Material, Model, Part, Partners, Rectangle, Run, Shape};
use embate_solver::simulation::{Options, Simulation};
use std::hint::black_box;
use std::time::Instant;

/// Elements through a strip, and along it per element through it.
const THROUGH: usize = 20;
/// Size of an element, m, and the gap between strips.
const SIZE: f64 = 1e-3;
const GAP: f64 = 1e-5;

fn stack(elements: usize, speed: f64) -> Model {
    let strips = (elements as f64 / (THROUGH * THROUGH) as f64).sqrt().ceil().max(2.0) as usize;
    let along = (elements / (strips * THROUGH)).max(1);
    let mut model = Model { run: Run { end: 1.0, ..Run::default() }, ..Model::default() };
    let parameters = [("young", 1e9), ("poisson", 0.3), ("density", 1e3)].map(|(key, value)| (key.to_string(), value));
    model.materials.insert("soft".into(), Material { law: "elastic".into(), parameters: parameters.into(), ..Material::default() });
    for strip in 0..strips {
        let y = strip as f64 * (THROUGH as f64 * SIZE + GAP);
        let size = [along as f64 * SIZE, THROUGH as f64 * SIZE];
        let velocity = [0.0, if strip % 2 == 0 { speed } else { -speed }];
        let shape = Shape::Rectangle(Rectangle {
            corner: [0.3 * SIZE * (strip % 2) as f64, y],
            size,
            elements: [along, THROUGH],
            ..Rectangle::default()
        });
        model.parts.push(Part { name: format!("strip{strip}"), material: "soft".into(), shape, velocity, ..Part::default() });
    }
    model.output.pictures = false;
    model
}

/// Shortest time of a step, ms, of two models that take turns, so that what else the machine does meets both.
fn step_times(models: [&Model; 2], threads: usize) -> ([f64; 2], [Simulation; 2]) {
    let mut simulations = models.map(|model| Simulation::new(model, &Options { threads, simd: None }).expect("the model is sound"));
    let mut shortest = [f64::INFINITY; 2];
    for _ in 0..24 {
        for (simulation, shortest) in simulations.iter_mut().zip(&mut shortest) {
            simulation.advance(f64::INFINITY, 1).expect("it runs");
            let start = Instant::now();
            simulation.advance(f64::INFINITY, 3).expect("it runs");
            *shortest = shortest.min(start.elapsed().as_secs_f64() * 1e3 / 3.0);
        }
    }
    (shortest, simulations)
}

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let elements = numbers.first().copied().unwrap_or(1_000_000);
    let threads = numbers.get(1).copied().unwrap_or(1);
    let all = Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() };
    for (name, speed) in [("at rest", 0.0), ("in motion", 2.0)] {
        let plain = stack(elements, speed);
        let mut touching = plain.clone();
        touching.contacts.push(all.clone());
        let ([without, with], [_, simulation]) = step_times([&plain, &touching], threads);
        let summary = simulation.summary();
        println!(
            "{name}: {} elements, {threads} thread(s): {without:.2} ms per step without contact, {with:.2} ms with it ({:.0} %); {:?}",
            summary.elements,
            100.0 * (with - without) / with,
            summary.contact
        );
        for search in simulation.searches() {
            println!("  {search:?}");
        }
        if speed == 0.0 {
            track_alone(&touching, with);
        }
    }
}

/// Tracking, sweeping and searching by themselves.
fn track_alone(model: &Model, step: f64) {
    let mesh = Mesh::new(model).expect("the mesh is sound");
    let target = Target { surface: mesh.outside(&[]).expect("elements do not overlap"), mirrors: Vec::new() };
    let (segments, positions) = (target.surface.segments.len(), &mesh.positions);
    let make = || Tracker::new(vec![target.clone()], &[(0, 0)], (registry::<2>()[0].make)(), positions).with_bodies(&mesh.bodies(), &[]);
    let mut tracker = make();
    let still = Sweep { old: positions, new: positions };
    let time = |work: &mut dyn FnMut()| {
        (0..7).fold(f64::INFINITY, |shortest: f64, _| {
            let start = Instant::now();
            work();
            shortest.min(start.elapsed().as_secs_f64() * 1e3)
        })
    };
    tracker.track(still, 0.0);
    let tracked = time(&mut || {
        black_box(tracker.track(still, 0.0).len());
    });
    let candidates = tracker.search_report().candidates;
    let far: Vec<_> = positions.iter().map(|x| [x[0] + 0.2 * SIZE, x[1]]).collect();
    let mut turn = false;
    let searched = time(&mut || {
        turn = !turn;
        let new = if turn { &far } else { positions };
        black_box(tracker.track(Sweep { old: new, new }, 0.0).len());
    });
    let touches = tracker.track(still, SIZE).to_vec();
    let swept = time(&mut || {
        for touch in &touches {
            let x = positions[touch.node as usize];
            black_box(target.passage(x, x, touch.projection.segment, positions, positions));
        }
    });
    let swept = swept * candidates as f64 / touches.len().max(1) as f64;
    println!("  {segments} segments, {candidates} pairs in reach");
    println!(
        "  tracking {tracked:.2} ms ({:.0} % of the step), of it sweeping {swept:.2} ms ({:.0} %)",
        100.0 * tracked / step,
        100.0 * swept / step
    );
    println!("  tracking with a global search {searched:.1} ms");
}
