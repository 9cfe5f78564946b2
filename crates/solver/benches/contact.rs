//! Cost of contact in a step:
//! `cargo bench -p embate-solver --bench contact [plane|space] [MOTION…] [ELEMENTS [THREADS [ROUNDS]]]`; a
//! MOTION is a part of a name that is reported, such as `shifted`, or after `=` a whole one; a round is four
//! steps.
//!
//! A stack of long strips, each so near to the next that every node of their long sides is in reach of the
//! next strip; all in one contact of bodies with each other and with themselves. At rest nothing presses; in
//! motion every second strip moves against its neighbours. Reported are the shares of the step that contact,
//! its tracking and the swept check take, and the time of a global search. In 3D two slabs lie on each other,
//! node on node or shifted, also facets on facets.

use embate_solver::bench::{contact, shortest, slabs, step_times, strips};
use embate_solver::contact::Sweep;
use embate_solver::contact::projection::node_segment::Target;
use embate_solver::contact::search::registry;
use embate_solver::contact::tracker::Tracker;
use embate_solver::mesh::Mesh;
use embate_solver::model::{Contact, Formulation, Model, Partners, Shape};
use embate_solver::simulation::Options;
use std::hint::black_box;

/// Size of an element of the strips, m.
const SIZE: f64 = 1e-3;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<usize> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let elements = numbers.first().copied().unwrap_or(1_000_000);
    let rounds = numbers.get(2).copied().unwrap_or(9);
    let options = Options { threads: numbers.get(1).copied().unwrap_or(1), simd: None };
    let is_wanted =
        |dimension: &str| words.iter().any(|word| word == dimension) || !words.iter().any(|word| word == "plane" || word == "space");
    let others: Vec<&String> = words
        .iter()
        .filter(|word| word.parse::<usize>().is_err() && !word.starts_with("--") && *word != "plane" && *word != "space")
        .collect();
    let names = |word: &str, name: &str| word.strip_prefix('=').map_or_else(|| name.contains(word), |whole| name == whole);
    let is_named = |name: &str| others.is_empty() || others.iter().any(|word| names(word, name));
    if is_wanted("plane") {
        for (name, speed, friction) in [("at rest", 0.0, 0.0), ("in motion", 2.0, 0.0), ("in motion with friction", 2.0, 0.3)]
            .into_iter()
            .filter(|(name, ..)| is_named(name))
        {
            let plain = strips(elements, speed);
            // 44 steps: so long the strips press on each other, once they have met.
            let with = compare(name, &plain, contact(Partners::Bodies(Vec::new()), friction), &options, rounds);
            if speed == 0.0 {
                track_alone(&plain, with);
            }
        }
    }
    if is_wanted("space") {
        let n = (elements as f64 / 20.0).sqrt().round() as usize;
        let between = || Partners::Between(["upper".into(), "lower".into()]);
        let bodies = || Partners::Bodies(Vec::new());
        let facets = |contact: Contact| Contact { formulation: Formulation::Segment, ..contact };
        for (name, speed, shift, contact) in [
            ("slabs at rest, 1 mm apart", 0.0, 0.0, contact(bodies(), 0.0)),
            ("slabs node on node", 2.0, 0.0, contact(between(), 0.0)),
            ("slabs node on node, facets", 2.0, 0.0, facets(contact(between(), 0.0))),
            ("slabs shifted", 2.0, 0.3, contact(between(), 0.0)),
            ("slabs shifted, facets", 2.0, 0.3, facets(contact(between(), 0.0))),
            ("slabs shifted, bodies", 2.0, 0.3, contact(bodies(), 0.0)),
            ("slabs shifted, with friction", 2.0, 0.3, contact(between(), 0.3)),
            ("slabs shifted, with friction, facets", 2.0, 0.3, facets(contact(between(), 0.3))),
        ]
        .into_iter()
        .filter(|(name, ..)| is_named(name))
        {
            let mut plain = slabs(n, speed, shift);
            if speed == 0.0 {
                lift(&mut plain, SIZE);
            }
            compare(name, &plain, contact, &options, rounds);
        }
    }
}

/// Moves the upper slab up, m.
fn lift(model: &mut Model, by: f64) {
    if let Shape::Cuboid(cuboid) = &mut model.parts[1].shape {
        cuboid.corner[2] += by;
    }
}

/// Times of steps with and without contact, and their shares; the time of a step with contact, ms.
fn compare(name: &str, plain: &Model, contact: Contact, options: &Options, rounds: usize) -> f64 {
    let mut touching = plain.clone();
    touching.contacts.push(contact);
    let ([without, with], [_, simulation]) = step_times([plain, &touching], options, rounds, f64::INFINITY).expect("the models are sound");
    let [without, with] = [without, with].map(|seconds| 1e3 * seconds);
    let summary = simulation.summary();
    println!(
        "{name}: {} elements, {} thread(s): {without:.2} ms per step without contact, {with:.2} ms with it ({:.0} %); {:?}; at most {} sweeps over the springs",
        summary.elements,
        options.threads,
        100.0 * (with - without) / with,
        summary.contact,
        simulation.sweeps().0
    );
    for search in simulation.searches() {
        println!("  {search:?}");
    }
    with
}

/// Tracking, sweeping and searching by themselves.
fn track_alone(model: &Model, step: f64) {
    let mesh = Mesh::new(model).expect("the mesh is sound");
    let target = Target { surface: mesh.outside(&[]).expect("elements do not overlap"), mirrors: Vec::new() };
    let (segments, positions) = (target.surface.segments.len(), &mesh.positions);
    let make = || Tracker::new(vec![target.clone()], &[(0, 0)], (registry::<2>()[0].make)(), positions).with_bodies(&mesh.bodies(), &[]);
    let mut tracker = make();
    let still = Sweep::between(positions, positions);
    tracker.track(still, 0.0);
    let tracked = 1e3
        * shortest(7, || {
            black_box(tracker.track(still, 0.0).len());
        });
    let candidates = tracker.search_report().candidates;
    let far: Vec<_> = positions.iter().map(|x| [x[0] + 0.2 * SIZE, x[1]]).collect();
    let mut turn = false;
    let searched = 1e3
        * shortest(7, || {
            turn = !turn;
            let new = if turn { &far } else { positions };
            black_box(tracker.track(Sweep::between(new, new), 0.0).len());
        });
    let touches = tracker.track(still, SIZE).to_vec();
    let swept = 1e3
        * shortest(7, || {
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
