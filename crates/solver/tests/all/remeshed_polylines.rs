//! Obstacles that are polylines, and bodies whose elements are made again while they are pressed into or
//! around them. What must hold is said by geometry alone: no node lies deep in the tool.

use crate::bodies::*;
use crate::remeshing::{every, metal};
use embate_solver::model::{Constraint, ContactLaw, Curve, CurveShape, Drive, Interface, Model, Motion, Obstacle, ObstacleShape, Remesh};
use embate_solver::simulation::Simulation;

/// Distance of a place from a line between two points, m.
fn distance(x: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (t, r) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
    let place = ((r[0] * t[0] + r[1] * t[1]) / (t[0] * t[0] + t[1] * t[1])).clamp(0.0, 1.0);
    (r[0] - place * t[0]).hypot(r[1] - place * t[1])
}

/// Whether a place is in a polygon: a ray to the right crosses its sides an odd number of times.
fn is_in(x: [f64; 2], polygon: &[[f64; 2]]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crosses =
        |(a, b): &(&[f64; 2], &[f64; 2])| (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]);
    sides.filter(crosses).count() % 2 == 1
}

/// How deep nodes are in an obstacle that is a polyline, m, and where the deepest is. `solid` are the points
/// that close its solid.
fn depth(simulation: &Simulation, obstacle: usize, solid: &[[f64; 2]]) -> (f64, [f64; 2]) {
    let frame = simulation.frame();
    let lines: Vec<[f64; 2]> = frame.outlines[obstacle].points.iter().map(|&[x, y, _]| [x, y]).collect();
    let polygon: Vec<[f64; 2]> = lines.iter().chain(solid).copied().collect();
    let depth = |x: [f64; 2]| lines.windows(2).map(|ends| distance(x, [ends[0], ends[1]])).fold(f64::INFINITY, f64::min);
    let inside = frame.positions::<2>().iter().filter(|x| is_in(**x, &polygon));
    inside.map(|&x| (depth(x), x)).fold((0.0, [0.0; 2]), |most, own| if own.0 > most.0 { own } else { most })
}

/// An obstacle of a polyline, points in mm.
fn polyline(name: &str, law: &ContactLaw, points: &[[f64; 2]]) -> Obstacle {
    let points = points.iter().map(|point| point.map(|x| 1e-3 * x)).collect();
    let obstacle = Obstacle::fixed(name, ObstacleShape::Polyline { points });
    Obstacle { interface: Interface { law: law.clone(), ..Interface::default() }, ..obstacle }
}

/// A block that a ram presses through a square die to half its height; plane strain, no friction. Container
/// and die are one polyline: its corner is where the block's is, and the edge of the die has a radius of 0.5
/// mm.
fn extrusion(law: &ContactLaw, elements: [usize; 2]) -> Model {
    let mut model = model(1.5e-4);
    model.materials.insert("soft".into(), metal(200e9, 7800.0, 500e6, 0.0));
    add(&mut model, "billet", rectangle([0.0, 0.0], [15e-3, 10e-3], elements), [0.0; 2]);
    let held = Some(Drive::Constant(0.0));
    model.constraints.push(Constraint { on: "billet.bottom".into(), velocity: [None, held, None], ..Constraint::default() });
    let shape = CurveShape::Table { times: vec![0.0, 20e-6, 1e-3], values: vec![0.0, 10.0, 10.0], smooth: true };
    model.curves.insert("press".into(), Curve::from(shape));
    let motion = Motion { velocity: [Some(Drive::Curve("press".into())), Some(0.0.into()), None], spin: Some(0.0.into()) };
    model.obstacles.push(Obstacle { motion, ..Obstacle::wall("ram", [0.0; 3], [1.0, 0.0, 0.0]) });
    let edge = [[15.371, 5.017], [15.25, 5.067], [15.146, 5.146], [15.067, 5.25], [15.017, 5.371], [15.0, 5.5]];
    let points = [&[[40.0, 5.3], [17.0, 5.3], [15.5, 5.0]][..], &edge, &[[15.0, 10.0], [-10.0, 10.0]]].concat();
    model.obstacles.push(polyline("die", law, &points));
    model
}

/// The greatest depth of nodes in an obstacle in so many looks at a run, m, and its end.
fn deepest(model: &Model, looks: u32, obstacle: usize, solid: &[[f64; 2]]) -> (f64, Simulation) {
    let (mut simulation, mut most) = (simulation(model), 0.0f64);
    for look in 1..=looks {
        simulation.advance(model.run.end * f64::from(look) / f64::from(looks), u64::MAX).unwrap();
        let (found, at) = depth(&simulation, obstacle, solid);
        if found > most {
            println!("{:.1} us: {:.2} um at {at:?}", 1e6 * simulation.time(), 1e6 * found);
        }
        most = most.max(found);
    }
    (most, simulation)
}

fn is_sound(simulation: &Simulation, events: usize) {
    let summary = simulation.summary();
    println!("{} events, drift {:.1e}, {:.2e} m by springs", summary.remeshings.len(), summary.energy_drift, summary.penetration_max);
    assert!(summary.remeshings.len() >= events, "{} events", summary.remeshings.len());
    assert_eq!(summary.contact.unverified, 0);
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 2e-3, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn what_is_beside_the_corner_of_a_die_does_not_sink_into_it() {
    let solid = [[-10e-3, 20e-3], [40e-3, 20e-3]];
    for law in [ContactLaw::default(), ContactLaw::Multiplier] {
        let mut model = extrusion(&law, [30, 20]);
        // At the start, where the block fills the corner, and as elements need it. A node that is lost there
        // is 0.3 mm deep after 36 us.
        model.remeshes.push(Remesh { size_contact: Some(0.25e-3), size: Some(0.5e-3), ..every("billet", 1.0) });
        let (depth, simulation) = deepest(&model, 50, 1, &solid);
        println!("{law:?}: {depth:.2e} m");
        is_sound(&simulation, 4);
        assert!(depth < 0.05 * 0.25e-3, "{law:?}: {depth} m deep");
        // The whole block is before the die or in its exit: the pressure is that of slip lines, 7.42 MN/m.
        let force = -value(&simulation, "obstacle.force_x[die]");
        println!("{:.3} MN/m", 1e-6 * force);
        assert!((force / 7.42e6 - 1.0).abs() < 0.15, "{law:?}: {force} N/m");
    }
}
