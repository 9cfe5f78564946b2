//! Contact in 3D where edges cross between their nodes: beams on edge that hit each other, and the edge of
//! a box. Nodes against facets alone would let them through.

use crate::bodies::*;
use embate_solver::model::{
    Contact, ContactLaw, Drive, ImportedMesh, InitialPenetration, Interface, Material, Model, Motion, Part, Partners, Penalty, Probe,
    ProbeAt, Shape,
};
use embate_solver::output::Frame;
use embate_solver::simulation::{Options, Simulation};
use std::sync::Arc;

type Vector = [f64; 3];

pub(crate) const R: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Width of the beams, and half of the diagonal of their section, m.
pub(crate) const WIDTH: f64 = 0.1;
pub(crate) const HALF: f64 = R * WIDTH;

/// Column of the deepest penetration.
pub(crate) const DEPTH: &str = "contact.penetration[hit]";

/// A block of hexahedra around `middle` (m) whose edges have these directions.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    pub(crate) size: Vector,
    pub(crate) cells: [usize; 3],
    pub(crate) axes: [Vector; 3],
    pub(crate) middle: Vector,
}

impl Block {
    /// A beam at this angle (degrees) to the x-axis in a plane of constant z, turned by 45 degrees about its
    /// axis.
    pub(crate) fn on_edge(length: f64, cells: usize, degrees: f64, middle: Vector) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let axes = [[cos, sin, 0.0], [-R * sin, R * cos, R], [R * sin, -R * cos, R]];
        Self { size: [length, WIDTH, WIDTH], cells: [cells, 2, 2], axes, middle }
    }

    /// The place with these parts along its axes, m from its middle.
    fn place(&self, parts: Vector) -> Vector {
        [0, 1, 2].map(|d| self.middle[d] + (0..3).map(|k| parts[k] * self.axes[k][d]).sum::<f64>())
    }

    pub(crate) fn add_to(&self, model: &mut Model, name: &str, velocity: Vector) {
        let Self { size, cells: [nx, ny, nz], .. } = *self;
        let part = |k: usize, count: usize, size: f64| size * (k as f64 / count as f64 - 0.5);
        let places = (0..=nz).flat_map(|k| (0..=ny).flat_map(move |j| (0..=nx).map(move |i| [i, j, k])));
        let positions = places.map(|[i, j, k]| self.place([part(i, nx, size[0]), part(j, ny, size[1]), part(k, nz, size[2])])).collect();
        let node = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
        let square = |i: usize, j: usize, k: usize| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
        let cells = (0..nx * ny * nz).map(|cell| (cell % nx, cell / nx % ny, cell / nx / ny));
        let groups = vec![group("body", 3, cells.map(|(i, j, k)| [square(i, j, k), square(i, j, k + 1)].concat()))];
        model.meshes.push(Arc::new(ImportedMesh { source: "test".into(), positions, groups, ..ImportedMesh::default() }));
        model.parts.push(Part {
            name: name.into(),
            material: "soft".into(),
            element: "hex8".into(),
            shape: Shape::Group { mesh: model.meshes.len() - 1, group: "body".into() },
            velocity,
            ..Part::default()
        });
        model.probes.push(Probe { name: name.into(), at: ProbeAt::Set { set: name.into() }, ..Probe::default() });
    }

    /// How deep a place is in it, were it with its middle `here`, m: negative outside.
    fn depth(&self, place: Vector, here: Vector) -> f64 {
        let off = [0, 1, 2].map(|d| place[d] - here[d]);
        let part = |k: usize| (0..3).map(|d| off[d] * self.axes[k][d]).sum::<f64>();
        (0..3).map(|k| 0.5 * self.size[k] - part(k).abs()).fold(f64::INFINITY, f64::min)
    }
}

/// A contact of two named bodies, or of all with each other and themselves.
pub(crate) fn meet(model: &mut Model, named: bool, interface: Interface) {
    let partners = if named { Partners::Between(["upper".into(), "lower".into()]) } else { Partners::Bodies(Vec::new()) };
    model.contacts.push(Contact { name: "hit".into(), partners, interface, ..Contact::default() });
}

pub(crate) fn is_sound(simulation: &Simulation, drift: f64, case: &str) {
    let summary = simulation.summary();
    let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
    println!("{case}: momenta {linear:.1e} {angular:.1e}, ledger {:.1e}, energy {:.1e}", summary.ledger_residual, summary.energy_drift);
    assert!(linear < 1e-12 && angular < 1e-12, "{case}: {linear} {angular}");
    assert!(summary.ledger_residual < 1e-10, "{case}: {}", summary.ledger_residual);
    assert!(summary.energy_drift < drift, "{case}: {}", summary.energy_drift);
}

#[test]
fn beams_that_cross_on_edge_exchange_their_velocities() {
    // A soft contact: beside its time their vibrations are fast, so that they hit each other like rigid
    // bodies.
    let speed = 0.1;
    for (degrees, named) in [(90.0, true), (40.0, true), (90.0, false), (40.0, false)] {
        let mut model = model(0.05);
        let upper = Block::on_edge(0.5, 5, degrees, [0.0, 0.0, 2.0 * HALF + 5e-4]);
        let lower = Block::on_edge(0.5, 5, 0.0, [0.0; 3]);
        upper.add_to(&mut model, "upper", [0.0, 0.0, -speed]);
        lower.add_to(&mut model, "lower", [0.0; 3]);
        meet(&mut model, named, Penalty::Pressure(1.2e7).into());
        let mut simulation = simulation(&model);
        let above: Vec<bool> = simulation.frame().positions::<3>().iter().map(|x| x[2] > HALF + 2e-4).collect();
        let (mut pressed, mut deepest) = (0, 0.0f64);
        for part in 1..=50 {
            simulation.advance(1e-3 * f64::from(part), u64::MAX).unwrap();
            let [up, low] = ["upper", "lower"].map(|name| ["x", "y", "z"].map(|x| value(&simulation, &format!("{name}.{x}"))));
            for (x, above) in simulation.frame().positions::<3>().iter().zip(&above) {
                let depth = if *above { lower.depth(*x, low) } else { upper.depth(*x, up) };
                assert!(depth < 0.0, "{degrees} {named}: a node is {depth} m within the other beam");
            }
            let depth = value(&simulation, DEPTH);
            pressed += usize::from(depth > 0.0);
            deepest = deepest.max(depth);
        }
        let [up, low] = ["upper", "lower"].map(|name| ["vx", "vy", "vz"].map(|v| value(&simulation, &format!("{name}.{v}"))));
        let case = format!("{degrees} {named}: {up:?} {low:?} {pressed} {deepest}");
        is_sound(&simulation, 1e-2, &case);
        assert!((5..40).contains(&pressed) && deepest > 1e-4 && deepest < 2e-3, "{case}");
        for d in 0..3 {
            let given = if d == 2 { -speed } else { 0.0 };
            assert!(up[d].abs() < 0.01 * speed && (low[d] - given).abs() < 0.01 * speed, "{case}");
        }
    }
}

/// Beams that hit each other off their middles, hard, and spin then.
fn off_centre(named: bool, interface: Interface) -> Model {
    let mut model = model(6e-3);
    Block::on_edge(0.6, 7, 70.0, [0.1, 0.12, 2.0 * HALF + 1e-3]).add_to(&mut model, "upper", [0.5, 0.3, -4.0]);
    Block::on_edge(0.6, 7, 0.0, [0.0; 3]).add_to(&mut model, "lower", [0.0, 0.0, 1.0]);
    meet(&mut model, named, interface);
    model
}

fn start_of(model: &Model) -> Frame {
    Simulation::new(model, &Options { threads: 1, simd: None }).unwrap().frame()
}

/// How far the upper beam is above the lower one where they cross (m), and how fast it goes away there (m/s):
/// of the nodes that were near at the start.
fn at_crossing(model: &Model, frame: &Frame) -> [f64; 2] {
    let start = start_of(model);
    let crossing = [0.1 - 0.12 / 70.0f64.to_radians().tan(), 0.0];
    let is_near = |x: &Vector| (x[0] - crossing[0]).hypot(x[1] - crossing[1]) < 0.1;
    let velocity = frame.fields.iter().find(|field| field.kind.name == "velocity").unwrap();
    let mut means = [[0.0; 3]; 2];
    for ((x, now), v) in start.positions::<3>().iter().zip(frame.positions::<3>()).zip(velocity.values.chunks(3)) {
        if is_near(x) {
            let of = &mut means[usize::from(x[2] < HALF + 5e-4)];
            (of[0], of[1], of[2]) = (of[0] + 1.0, of[1] + now[2], of[2] + v[2]);
        }
    }
    let [upper, lower] = means.map(|[count, z, v]| [z / count, v / count]);
    [upper[0] - lower[0], upper[1] - lower[1]]
}

#[test]
fn beams_that_hit_each_other_off_their_middles_part_again_and_keep_both_momenta_and_the_energy() {
    for named in [true, false] {
        for interface in [Interface::default(), rough(0.3), Penalty::automatic(0.1).into()] {
            let model = off_centre(named, interface.clone());
            let (simulation, history) = run(&model);
            let case = format!("{named} {:?} {:?}", interface.friction.is_some(), interface.law);
            is_sound(&simulation, 1e-2, &case);
            assert!(history.largest(DEPTH) > 1e-5 && history.last(DEPTH) == 0.0, "{case} {}", history.last(DEPTH));
            let [[before, approach], [after, separation]] = [start_of(&model), simulation.frame()].map(|frame| at_crossing(&model, &frame));
            println!("{before} {after} m, {approach} {separation} m/s, {}", history.largest(DEPTH));
            assert!((approach + 5.0).abs() < 1e-9 && after > before, "{case}: {before} {after} {separation}");
            assert!(interface.friction.is_none() || history.last("energy.friction") > 0.0);
        }
    }
}

#[test]
fn a_beam_that_hits_the_edge_of_a_box_off_its_middle_spins_and_keeps_the_angular_momentum() {
    let mut model = model(6e-3);
    // The edge of the box is along y; the beam crosses it, at right angles to what leaves the edge half way
    // between both faces.
    let at = R * (0.3 * 0.5f64.sqrt() + HALF + 1e-3);
    let tilted = [[-R, 0.0, R], [0.5, R, 0.5], [-0.5, R, -0.5]];
    let off = 0.17;
    let middle = [at - off * R, 0.031, at + off * R];
    Block { size: [0.6, WIDTH, WIDTH], cells: [7, 2, 2], axes: tilted, middle }.add_to(&mut model, "upper", [-3.0, 0.0, -3.0]);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Block { size: [0.3; 3], cells: [3; 3], axes, middle: [0.0; 3] }.add_to(&mut model, "lower", [0.0; 3]);
    meet(&mut model, true, Interface::default());
    let (simulation, history) = run(&model);
    is_sound(&simulation, 1e-2, "box");
    assert!(history.largest(DEPTH) > 1e-5 && history.last(DEPTH) == 0.0);
    // It continues towards the box with the end that is farther away: its middle was hardly slowed.
    let frame = simulation.frame();
    let velocity = frame.fields.iter().find(|field| field.kind.name == "velocity").unwrap();
    let start = start_of(&model);
    let ends = [1.0, -1.0].map(|side| {
        let of = |x: &Vector| (0..3).map(|d| side * (x[d] - middle[d]) * tilted[0][d]).sum::<f64>();
        let is_end = |x: &Vector| of(x) > 0.29 && (0..3).all(|d| (x[d] - middle[d] - side * 0.3 * tilted[0][d]).abs() < WIDTH);
        let all: Vec<&[f64]> =
            start.positions::<3>().iter().zip(velocity.values.chunks(3)).filter(|(x, _)| is_end(x)).map(|(_, v)| v).collect();
        assert_eq!(all.len(), 9);
        all.iter().map(|v| R * (v[0] + v[2])).sum::<f64>() / 9.0
    });
    println!("{ends:?}");
    assert!(ends[1] - ends[0] > 2.0, "{ends:?}");
}

#[test]
fn threads_and_instruction_sets_and_a_stop_between_change_no_bit_of_edges() {
    let mut model = off_centre(false, rough(0.3));
    model.run.end = 1.2e-3;
    let alone = hash_of_equal_bits(&model, &[1, 2, 3], "edges");
    // The edges touch then, and stick.
    let mut first = simulation(&model);
    while value(&first, DEPTH) <= 0.0 {
        first.advance(f64::INFINITY, 1).unwrap();
    }
    for more in [0, 1, 5] {
        first.advance(f64::INFINITY, more).unwrap();
        assert!(value(&first, DEPTH) > 0.0);
        continues_to(&alone, &model, &mut first, "edges");
    }
}

#[test]
fn edges_that_cross_at_the_start_are_reported_or_ignored() {
    let with = |initial_penetration: InitialPenetration| {
        let mut model = model(1e-3);
        Block::on_edge(0.5, 5, 90.0, [0.0, 0.0, 2.0 * HALF - 1e-3]).add_to(&mut model, "upper", [0.0; 3]);
        Block::on_edge(0.5, 5, 0.0, [0.0; 3]).add_to(&mut model, "lower", [0.0; 3]);
        meet(&mut model, true, Interface { initial_penetration, ..Interface::default() });
        model
    };
    let reported = faults(&with(InitialPenetration::Error));
    assert!(reported.len() == 1 && reported[0].contains("1.000e-3 m inside at the start"), "{reported:?}");
    let simulation = to_end(&with(InitialPenetration::Ignore));
    assert!(value(&simulation, "energy.contact") < 1e-9 && value(&simulation, "energy.kinetic") < 1e-9);
}

/// An elastic-plastic metal whose elements fail.
fn weak() -> Material {
    let parameters = [("young", 70e9), ("poisson", 0.3), ("density", 2700.0), ("yield", 200e6), ("hardening", 200e6)];
    Material {
        law: "j2".into(),
        parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(),
        failure: [("plastic_strain".to_string(), 0.2)].into(),
        ..Material::default()
    }
}

#[test]
fn edges_whose_elements_fail_are_gone_and_those_of_the_new_surface_meet_and_the_books_stay_closed() {
    for named in [true, false] {
        let mut model = model(6e-4);
        model.materials.insert("soft".into(), weak());
        let upper = Block { cells: [7, 4, 4], ..Block::on_edge(0.6, 7, 75.0, [0.03, 0.02, 2.0 * HALF + 1e-3]) };
        upper.add_to(&mut model, "upper", [0.0, 0.0, -180.0]);
        Block { cells: [7, 4, 4], ..Block::on_edge(0.6, 7, 0.0, [0.0; 3]) }.add_to(&mut model, "lower", [0.0; 3]);
        meet(&mut model, named, Interface::default());
        let mut simulation = simulation(&model);
        let (mut lost, mut pressed, mut at_first) = (0, 0, 0.0);
        while simulation.time() < model.run.end {
            simulation.advance(f64::INFINITY, 1).unwrap();
            let count = simulation.summary().erosion.map_or(0, |erosion| erosion.elements.iter().map(|(_, count)| *count).sum::<usize>());
            pressed += usize::from(count > 0 && count == lost && value(&simulation, DEPTH) > 0.0);
            if lost == 0 {
                at_first = value(&simulation, "lower.vz");
            }
            lost = count;
        }
        let summary = simulation.summary();
        let case = format!("{named}: {lost} elements, {pressed} steps pressed after");
        let [linear, angular] = [summary.momentum_drift_linear, summary.momentum_drift_angular].map(|drift| drift.unwrap());
        println!("{case} {linear:.1e} {angular:.1e} {:.1e} {:.1e}", summary.ledger_residual, summary.energy_drift);
        assert!(linear < 1e-12 && angular < 1e-11 && summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{case}: {summary:?}");
        assert!(lost >= 4 && pressed > 20 && summary.contact.unverified == 0, "{case}");
        // What is left of both continues to push.
        let last = value(&simulation, "lower.vz");
        assert!(at_first < 0.0 && last < 3.0 * at_first, "{case}: {at_first} {last}");
    }
}

/// A beam on edge that goes straight along x, around a loop and back over itself at right angles: one body,
/// of two parts that share nodes.
fn loop_over_itself(gap: f64, speed: f64) -> Model {
    let (straight, radius, cells) = (0.5, 0.22, 26);
    let arc = 1.5 * std::f64::consts::PI * radius;
    let length = 2.0 * straight + arc;
    let mut model = model(8e-3);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Block { size: [length, WIDTH, WIDTH], cells: [cells, 2, 2], axes, middle: [0.5 * length, 0.0, 0.0] }
        .add_to(&mut model, "all", [0.0; 3]);
    let mut mesh = ImportedMesh::clone(&model.meshes[0]);
    for x in &mut mesh.positions {
        let [s, b, c] = *x;
        let along = ((s - straight) / arc).clamp(0.0, 1.0);
        let (angle, after) = (1.5 * std::f64::consts::PI * along, (s - straight - arc).max(0.0));
        let (sin, cos) = angle.sin_cos();
        let rise = along * along * (3.0 - 2.0 * along) * (2.0 * HALF + gap);
        let middle = [s.min(straight) - straight + radius * sin + after * cos, radius - radius * cos + after * sin, rise];
        let across = Block::on_edge(1.0, 1, angle.to_degrees(), [0.0; 3]).axes;
        *x = [0, 1, 2].map(|d| middle[d] + b * across[1][d] + c * across[2][d]);
    }
    let cells_all = std::mem::take(&mut mesh.groups[0].cells);
    let part =
        |is_upper: bool| cells_all.iter().enumerate().filter(move |(k, _)| (k % cells >= 18) == is_upper).map(|(_, cell)| cell.clone());
    mesh.groups = vec![group("lower", 3, part(false)), group("upper", 3, part(true))];
    model.meshes[0] = Arc::new(mesh);
    let whole = model.parts.remove(0);
    model.probes.clear();
    for (name, velocity) in [("lower", 0.0), ("upper", -speed)] {
        let shape = Shape::Group { mesh: 0, group: name.into() };
        model.parts.push(Part { name: name.into(), shape, velocity: [0.0, 0.0, velocity], ..whole.clone() });
    }
    model
}

#[test]
fn one_body_whose_legs_cross_meets_itself_by_its_edges_alone() {
    let gap = 2e-3;
    for interface in [Interface::default(), rough(0.3)] {
        let mut model = loop_over_itself(gap, 3.0);
        let free = to_end(&model);
        meet(&mut model, false, interface.clone());
        let (simulation, history) = run(&model);
        let case = format!("{}", interface.friction.is_some());
        is_sound(&simulation, 1e-2, &case);
        assert!(history.largest(DEPTH) > 1e-5 && history.largest(DEPTH) < 2e-3, "{case} {}", history.largest(DEPTH));
        assert!(simulation.summary().contact.unverified == 0);
        let start = start_of(&model);
        let crossing = [-0.22, 0.0];
        let is_near = |x: &Vector| (x[0] - crossing[0]).abs().max((x[1] - crossing[1]).abs()) < 0.12;
        // The lowest ridge of the upper leg and the highest of the lower one.
        let apart = |frame: &Frame| {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for (x, now) in start.positions::<3>().iter().zip(frame.positions::<3>()).filter(|(x, _)| is_near(x)) {
                let side = if x[2] > HALF + 0.5 * gap { &mut low } else { &mut high };
                *side = if x[2] > HALF + 0.5 * gap { side.min(now[2]) } else { side.max(now[2]) };
            }
            low - high
        };
        let [before, after, through] = [apart(&start), apart(&simulation.frame()), apart(&free.frame())];
        println!("{case}: {before} {after} {through}, {}", history.largest(DEPTH));
        assert!((before - gap).abs() < 1e-9 && after > -5e-4 && through < -5e-3, "{case}: {before} {after} {through}");
    }
}

#[test]
fn a_layer_between_edges_presses_on_half_of_what_their_four_nodes_stand_for_and_once() {
    // Of a ridge each node has two half strips of facets as long as an edge: both passes together one of each
    // pair of edges.
    let (reach, pressure, speed) = (5e-4, 4e6, 0.2);
    let law = ContactLaw::PressureGap { gaps: vec![-5e-4, reach], pressures: vec![2.0 * pressure, 0.0] };
    let mut parted = Vec::new();
    for (degrees, named) in [(50.0, true), (90.0, true), (90.0, false)] {
        let mut model = model(0.012);
        Block::on_edge(0.5, 5, degrees, [0.0, 0.0, 2.0 * HALF + 1e-3]).add_to(&mut model, "upper", [0.0, 0.0, -speed]);
        Block::on_edge(0.5, 5, 0.0, [0.0; 3]).add_to(&mut model, "lower", [0.0; 3]);
        meet(&mut model, named, Interface { law: law.clone(), ..Interface::default() });
        for (name, side) in [("up", -1.0), ("down", 1.0)] {
            let part = if side < 0.0 { "upper" } else { "lower" };
            let at = [0.0, 0.0, if side < 0.0 { 2.0 * HALF + 1e-3 } else { 0.0 }];
            let near = if side < 0.0 {
                let (sin, cos) = f64::to_radians(degrees).sin_cos();
                [0.05 * cos, 0.05 * sin, at[2] - HALF]
            } else {
                [0.05, 0.0, HALF]
            };
            model.probes.push(Probe { name: name.into(), at: ProbeAt::Point { part: part.into(), point: near }, ..Probe::default() });
        }
        let mut simulation = simulation(&model);
        let (area, mut worst, mut most) = (0.5 * WIDTH * 0.1, 0.0f64, 0.0f64);
        while simulation.time() < model.run.end {
            simulation.advance(f64::INFINITY, 1).unwrap();
            // The crossing is half way between the nodes of both edges, which stay level.
            let gap = value(&simulation, "up.z") - value(&simulation, "down.z");
            let expected = area * pressure * ((reach - gap) / reach).max(0.0);
            let force = value(&simulation, "contact.force_z[hit]").abs();
            (worst, most) = (worst.max((force - expected).abs()), most.max(expected));
        }
        let case = format!("{degrees} {named}: {worst} of {most}");
        is_sound(&simulation, 1e-2, &case);
        // Bodies that meet each other and themselves have no first and second side, and no resultant.
        assert!(most > 0.05 * area * pressure && (!named || worst < 0.03 * most), "{case}");
        parted.push(value(&simulation, "lower.vz"));
    }
    assert!(parted[1] < -0.8 * speed && (parted[1] - parted[2]).abs() < 1e-12 * speed, "{parted:?}");
}

#[test]
fn the_force_of_an_edge_continues_where_the_line_of_the_other_one_bends_however_much() {
    // A rigid blade slides along a rigid ridge that bends in plan, and sinks a little: the crossing is level
    // on both of its edges, and the force only grows with the depth.
    for degrees in [30.0, 60.0, 80.0_f64] {
        for interface in [Penalty::Pressure(1e10).into(), Interface { friction: rough(0.2).friction, ..Penalty::Pressure(1e10).into() }] {
            let (speed, sinks) = (10.0, 0.5);
            let mut model = model(8e-3);
            model.run.time_step = Some(1e-5);
            let upper = Block::on_edge(0.5, 5, 90.0, [-0.04, 0.013, 2.0 * HALF + 1e-4]);
            upper.add_to(&mut model, "upper", [0.0; 3]);
            Block::on_edge(0.5, 4, 0.0, [0.0; 3]).add_to(&mut model, "lower", [0.0; 3]);
            let mut mesh = ImportedMesh::clone(model.meshes.last().unwrap());
            let slope = (0.5 * degrees).to_radians().tan();
            mesh.positions.iter_mut().for_each(|x| x[1] -= slope * x[0].abs());
            *model.meshes.last_mut().unwrap() = Arc::new(mesh);
            let still = |velocity: Vector| Motion { velocity: velocity.map(|v| Some(Drive::from(v))), spin: Some(Drive::from(0.0)) };
            stiffen(&mut model, "upper", still([speed, 0.0, -sinks]));
            // Something has to be free, though nothing pushes it that way.
            let mut held = still([0.0; 3]);
            held.velocity[1] = None;
            stiffen(&mut model, "lower", held);
            meet(&mut model, true, interface.clone());
            let steps = every_step(&model);
            let force: Vec<f64> = steps.column("contact.force_z[hit]").iter().map(|force| force.abs()).collect();
            let x = steps.column("upper.x");
            let most = force.iter().copied().fold(0.0, f64::max);
            let jump = force.windows(2).map(|two| (two[1] - two[0]).abs()).fold(0.0, f64::max);
            let passed = x.iter().zip(&force).filter(|(x, force)| x.abs() < 0.02 && **force == 0.0).count();
            println!("{degrees} {}: most {most}, jump {jump}, {passed} steps without force", interface.friction.is_some());
            assert!(most > 0.0 && x[0] < -0.03 && x[x.len() - 1] > 0.03 && passed == 0, "{degrees}: {passed}");
            assert!(jump < 0.02 * most, "{degrees}: {jump} of {most}");
        }
    }
}
