//! Cost of contact in a step: `cargo bench -p embate-solver --bench contact [ELEMENTS [THREADS]]`.
//!
//! A stack of long strips, each so near to the next that every node of their long sides is in reach of the next strip; all in one contact of bodies with each other and
//! with themselves. At rest nothing presses; in motion every second strip moves against its neighbours. Told are the shares of the step that contact, its
//! tracking and the swept check take, and the time of a global search.

use embate_solver::bench::{shortest, step_times, strips};
use embate_solver::contact::Sweep;
use embate_solver::contact::projection::node_segment::Target;
use embate_solver::contact::search::registry;
use embate_solver::contact::tracker::Tracker;
use embate_solver::mesh::Mesh;
use embate_solver::model::{Contact, Friction, Interface, Model, Partners};
use embate_solver::simulation::Options;
use std::hint::black_box;

/// Size of an element of the strips, m.
const SIZE: f64 = 1e-3;

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    let elements = numbers.first().copied().unwrap_or(1_000_000);
    let threads = numbers.get(1).copied().unwrap_or(1);
    let all = Contact { name: "all".into(), partners: Partners::Bodies(Vec::new()), ..Contact::default() };
    for (name, speed, friction) in [("at rest", 0.0, 0.0), ("in motion", 2.0, 0.0), ("in motion with friction", 2.0, 0.3)] {
        let plain = strips(elements, speed);
        let mut touching = plain.clone();
        let interface = Interface {
            friction: (friction > 0.0).then_some(Friction {
                coefficient: friction,
                dynamic: None,
                decay: 0.0,
                viscosity: 0.0,
                limit: f64::INFINITY,
            }),
            ..Interface::default()
        };
        touching.contacts.push(Contact { interface, ..all.clone() });
        let options = Options { threads, simd: None };
        // 44 steps: so long the strips press on each other, once they have met.
        let ([without, with], [_, simulation]) = step_times([&plain, &touching], &options, 9, f64::INFINITY).expect("the models are sound");
        let [without, with] = [without, with].map(|seconds| 1e3 * seconds);
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
