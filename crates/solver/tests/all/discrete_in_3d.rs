//! Springs, bars and boundaries that reflect nothing in 3D, against closed forms and against conservation.

use crate::bodies::{elastic, every_step, group, model, simulation, to_end, value};
use crate::patches::material;
use crate::solids::{Vector, cross, dot, plus};
use embate_lanes::{Level, Team};
use embate_solver::block::{BlockInput, Motion as Step, make};
use embate_solver::model::{
    Constraint, ContactLaw, Cuboid, Curve, CurveShape, Drive, ImportedMesh, Interface, Load, MeshGroup, Model, Motion, NonReflecting,
    Obstacle, Part, Penalty, Placement, Probe, ProbeAt, Shape, SpaceTruss, Spring, Symmetry,
};
use embate_solver::simulation::Simulation;
use std::sync::Arc;

/// A direction that is along no axis, of length 7.
const SKEW: Vector = [2.0, 3.0, 6.0];

fn unit(v: Vector) -> Vector {
    v.map(|component| component / dot(v, v).sqrt())
}

fn distance(a: Vector, b: Vector) -> f64 {
    let way = plus(b, -1.0, a);
    dot(way, way).sqrt()
}

fn cuboid(corner: Vector, size: Vector, elements: [usize; 3]) -> Shape {
    Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() })
}

fn part(name: &str, shape: Shape) -> Part {
    Part { name: name.into(), material: "soft".into(), element: "hex8".into(), shape, ..Part::default() }
}

/// Nodes of a brick from its lowest to its highest corner.
fn brick(low: Vector, size: Vector) -> [Vector; 8] {
    let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    corners.map(|corner: [u8; 3]| std::array::from_fn(|d| low[d] + f64::from(corner[d]) * size[d]))
}

/// Two rigid bricks of 1e3 kg/m³, 0.2 × 0.3 × 0.6 m and twice that, with a spring between the corners that
/// look at each other, along the line through their centres.
fn two_bricks(spring: Spring) -> Model {
    let mut model = model(1.0);
    let small = SKEW.map(|component| 0.1 * component);
    let from = plus(small, 0.1, SKEW);
    let positions = brick([0.0; 3], small).into_iter().chain(brick(from, small.map(|size| 2.0 * size))).collect();
    let cells = |range: std::ops::Range<u32>| std::iter::once(range.collect::<Vec<u32>>());
    let groups = vec![
        group("small", 3, cells(0..8)),
        group("large", 3, cells(8..16)),
        group("near", 0, std::iter::once(vec![6])),
        group("far", 0, std::iter::once(vec![8])),
    ];
    model.meshes.push(Arc::new(ImportedMesh { source: "bricks".into(), positions, groups, ..ImportedMesh::default() }));
    for name in ["small", "large"] {
        let shape = Shape::Group { mesh: 0, group: name.into() };
        model.parts.push(Part { rigid: Some(Motion::default()), ..part(name, shape) });
    }
    model.springs.push(Spring { between: ["near".into(), "far".into()], ..spring });
    model
}

#[test]
fn two_bricks_on_a_spring_swing_with_the_frequency_of_their_masses_along_any_line() {
    // Masses 36 and 288 kg: ω² = k (1/36 + 1/288) = k/32.
    let (stiffness, speed) = (3200.0, 0.1);
    let omega = 10.0;
    let mut model = two_bricks(Spring { stiffness, ..Spring::default() });
    model.run.time_step = Some(1e-3);
    model.parts[1].velocity = unit(SKEW).map(|n| speed * n);
    let mut simulation = simulation(&model);
    let mut worst = 0.0f64;
    while simulation.time() < 1.0 {
        simulation.advance(1.0, 1).unwrap();
        let frame = simulation.frame();
        let x = frame.positions::<3>();
        let elongation = distance(x[6], x[8]) - 0.7;
        worst = worst.max((elongation - speed / omega * (omega * simulation.time()).sin()).abs());
    }
    assert!(worst < 1e-3 * speed / omega, "{worst:e} of {:e}", speed / omega);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-13 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3, "{summary:?}");
    // The kinetic energy of the relative motion goes in and out of the spring; that of the common one stays.
    let total = 0.5 * 288.0 * speed * speed;
    assert!((simulation.ledger().stores.total() / total - 1.0).abs() < 1e-3, "{:?}", simulation.ledger().stores);
}

#[test]
fn dampers_in_3d_slow_what_moves_along_them_and_book_what_they_take() {
    // Relative velocity v exp(−c t/µ) with µ = 32 kg.
    let (damping, speed) = (64.0, 0.1);
    let mut model = two_bricks(Spring { damping, ..Spring::default() });
    model.run.time_step = Some(1e-3);
    model.parts[1].velocity = unit(SKEW).map(|n| speed * n);
    let simulation = to_end(&model);
    let frame = simulation.frame();
    let x = frame.positions::<3>();
    let expected = speed * 0.5 * (1.0 - (-2.0f64).exp());
    let grown = distance(x[6], x[8]) - 0.7;
    assert!((grown / expected - 1.0).abs() < 2e-3, "{grown} for {expected}");
    let taken = 0.5 * 32.0 * speed * speed * (1.0 - (-4.0f64).exp());
    let summary = simulation.summary();
    assert!((simulation.ledger().stores.plastic / taken - 1.0).abs() < 5e-3, "{:?} for {taken}", simulation.ledger().stores);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-13 && summary.energy_drift < 5e-3, "{summary:?}");
}

#[test]
fn bodies_that_tumble_on_springs_and_dampers_keep_both_momenta() {
    let mut model = model(0.2);
    model.parts.push(part("one", cuboid([0.0; 3], [0.3, 0.2, 0.1], [3, 2, 1])));
    model.parts.push(part("two", cuboid([0.5, 0.1, -0.2], [0.2, 0.2, 0.3], [2, 2, 3])));
    model.parts[0].velocity = [3.0, -1.0, 0.5];
    (model.parts[1].velocity, model.parts[1].spin) = ([-2.0, 0.3, 1.0], 20.0);
    let between = ["one.right".to_string(), "two.left".to_string()];
    model.springs.push(Spring { between, stiffness: 2e4, damping: 5.0, ..Spring::default() });
    let simulation = to_end(&model);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 5e-3, "{summary:?}");
    assert!(simulation.ledger().stores.plastic > 0.0, "the dampers worked");
}

#[test]
fn stiff_springs_in_3d_shorten_the_step_and_the_run_stays_stable() {
    let mut model = two_bricks(Spring { stiffness: 1e11, damping: 10.0, ..Spring::default() });
    model.parts.iter_mut().for_each(|part| part.rigid = None);
    model.parts[1].velocity = [1.0, 0.0, 0.5];
    model.run.end = 0.01;
    let mut simulation = simulation(&model);
    let governor = simulation.overview().governor;
    assert!(governor.contains("springs"), "{governor}");
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let summary = simulation.summary();
    assert!(summary.energy_drift < 0.02 && summary.momentum_drift_angular.unwrap() < 1e-11, "{summary:?}");
}

#[test]
fn a_stiffness_per_node_of_solids_is_that_of_each_node() {
    // A rigid brick on a floor that is let go sinks twice as deep as it would lie: 2 m g / 4 k.
    let stiffness = 1e5;
    let mut model = model(0.05);
    model.parts.push(Part { rigid: Some(Motion::default()), ..part("brick", cuboid([0.0; 3], [0.2, 0.3, 0.6], [1; 3])) });
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, 0.0, -9.81], curve: None });
    let law = ContactLaw::Penalty(Penalty::PerNode(stiffness));
    let floor = Obstacle::wall("floor", [0.0; 3], [0.0, 0.0, 1.0]);
    model.obstacles.push(Obstacle { interface: Interface { law, ..Interface::default() }, ..floor });
    model.run.time_step = Some(1e-4);
    let summary = to_end(&model).summary();
    let expected = 2.0 * 36.0 * 9.81 / (4.0 * stiffness);
    assert!((summary.penetration_max / expected - 1.0).abs() < 1e-3, "{} for {expected}", summary.penetration_max);
}

#[test]
fn a_bar_in_3d_pulls_along_its_line_and_turns_without_strain() {
    for law in ["elastic", "neo_hookean", "j2"] {
        let material = material(law, 0.3);
        let start = [[1.0, -2.0, 0.5], plus([1.0, -2.0, 0.5], 0.1, SKEW)];
        let flat = [[0.0; 2], [0.7, 0.0]];
        let mut bar = make(&BlockInput { area: 0.01, ..BlockInput::new("bar2", &material, &[0, 1], &start) }).unwrap();
        let mut same = make(&BlockInput { area: 0.01, ..BlockInput::new("bar2", &material, &[0, 1], &flat) }).unwrap();
        assert_eq!((bar.elements(), bar.slots()), (1, &[0u32, 1][..]));
        assert!((bar.mass(0) / same.mass(0) - 1.0).abs() < 1e-15);
        let (mut slots, mut others) = ([[0.0; 3]; 2], [[0.0; 2]; 2]);
        for k in 1..=100 {
            // It is pulled and goes twice around at the same time.
            let (l, angle) = (0.7 * (1.0 + 1e-3 * f64::from(k)), 4.0 * std::f64::consts::PI * f64::from(k) / 100.0);
            let (n, across) = (unit(SKEW), unit(cross(SKEW, [1.0, 0.0, 0.0])));
            let direction = plus(n.map(|n| angle.cos() * n), angle.sin(), across);
            let positions = [start[0], plus(start[0], l, direction)];
            let motion = Step::new(&positions, &[[0.0; 3]; 2], 1e-3);
            let report = bar.advance(&motion, Level::best(), embate_solver::block::NodalForces::new(&mut slots), &mut Team::alone());
            let flat_positions = [[0.0; 2], [l, 0.0]];
            let motion = Step::new(&flat_positions, &[[0.0; 2]; 2], 1e-3);
            let flat = same.advance(&motion, Level::best(), embate_solver::block::NodalForces::new(&mut others), &mut Team::alone());
            let force = others[0][0];
            assert!(force > 0.0 && distance(slots[0], direction.map(|n| force * n)) < 1e-9 * force, "{law} {k}: {slots:?} for {force}");
            assert_eq!(slots[0].map(|f| -f), slots[1]);
            assert!(
                (report.stored / flat.stored - 1.0).abs() < 1e-9 && (report.time_step_squared / flat.time_step_squared - 1.0).abs() < 1e-9
            );
            let (stress, along) = (bar.state(0).stress, same.state(0).stress[0]);
            let n = direction;
            let expected = [n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[2] * n[0]].map(|share| share * along);
            assert!(stress.iter().zip(expected).all(|(s, e)| (s - e).abs() < 1e-9 * along), "{law}: {stress:?} for {expected:?}");
        }
    }
}

/// A mesh of lines between points, with a group of all and one of each point.
fn lines(points: &[Vector], lines: &[[u32; 2]]) -> ImportedMesh {
    let mut groups = vec![group("bars", 1, lines.iter().map(|line| line.to_vec()))];
    groups.extend((0..points.len()).map(|k| MeshGroup { name: format!("point{k}"), dimension: 0, cells: vec![vec![k as u32]] }));
    ImportedMesh { source: "lines".into(), positions: points.to_vec(), groups, ..ImportedMesh::default() }
}

fn bars(model: &mut Model, mesh: ImportedMesh, area: f64) {
    model.meshes.push(Arc::new(mesh));
    let shape = Shape::Group { mesh: model.meshes.len() - 1, group: "bars".into() };
    model.parts.push(Part { element: "bar2".into(), area: Some(area), ..part("bars", shape) });
}

fn hold(model: &mut Model, on: &str) {
    let velocity = [0; 3].map(|_| Some(Drive::Constant(0.0)));
    model.constraints.push(Constraint { on: on.into(), velocity, ..Constraint::default() });
}

#[test]
fn a_tripod_of_bars_has_the_energy_of_the_closed_form_through_its_snap() {
    let (young, area) = (1e9, 0.01);
    let mut model = model(1e-2);
    model.materials.get_mut("soft").unwrap().parameters.insert("poisson".into(), 0.0);
    let foot = |k: f64| [(std::f64::consts::TAU * k / 3.0).cos(), (std::f64::consts::TAU * k / 3.0).sin(), 0.0];
    bars(&mut model, lines(&[[0.0, 0.0, 0.1], foot(0.0), foot(1.0), foot(2.0)], &[[1, 0], [2, 0], [0, 3]]), area);
    (1..4).for_each(|k| hold(&mut model, &format!("point{k}")));
    model.run.time_step = Some(2e-5);
    let shape = CurveShape::Table { times: vec![0.0, 1e-2], values: vec![0.0, -0.25], smooth: true };
    model.curves.insert("down".into(), Curve::from(shape));
    let displacement = [None, None, Some(Drive::Curve("down".into()))];
    model.constraints.push(Constraint { on: "point0".into(), displacement, ..Constraint::default() });
    model.probes.push(Probe { name: "apex".into(), at: ProbeAt::Set { set: "point0".into() }, ..Probe::default() });
    let steps = every_step(&model);
    let rest = 1.01f64.sqrt();
    let most = 3.0 * young * area * (rest - 1.0 + (1.0 / rest).ln());
    for (h, energy) in steps.column("apex.z").iter().zip(&steps.column("energy.internal")) {
        let l = (1.0 + h * h).sqrt();
        // 3 ∫ E A₀ ln(l/l₀) dl
        let expected = 3.0 * young * area * (l * (l / rest).ln() - l + rest);
        assert!((energy - expected).abs() < 1e-4 * most, "{h}: {energy} for {expected}, most {most}");
    }
    assert!(*steps.column("apex.z").last().unwrap() < -0.1, "through the mirror image of its start");
}

#[test]
fn a_brick_hangs_on_bars_of_its_own_mesh() {
    // Four bars of 1 m above the corners of a brick of 0.5 × 0.4 × 0.3 m: it sinks by m g L / 4 E A.
    let (young, area) = (1e9, 1e-3);
    let mut model = model(0.5);
    model.materials.insert("soft".into(), elastic(young, 1e3));
    let mut positions = brick([0.0; 3], [0.5, 0.4, 0.3]).to_vec();
    positions.extend([4, 5, 6, 7].map(|corner| plus(brick([0.0; 3], [0.5, 0.4, 0.3])[corner], 1.0, [0.0, 0.0, 1.0])));
    let mut mesh = lines(&positions, &[[4, 8], [5, 9], [6, 10], [7, 11]]);
    mesh.groups.push(group("brick", 3, std::iter::once((0..8).collect())));
    mesh.groups.push(group("ceiling", 0, (8..12).map(|node| vec![node])));
    bars(&mut model, mesh, area);
    model.parts.push(part("brick", Shape::Group { mesh: 0, group: "brick".into() }));
    hold(&mut model, "ceiling");
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, 0.0, -9.81], curve: None });
    model.loads.push(Load::Damping { parts: vec![], rate: 60.0, active: [0.0, f64::INFINITY] });
    model.probes.push(Probe { name: "corner".into(), at: ProbeAt::Set { set: "point4".into() }, ..Probe::default() });
    let simulation = to_end(&model);
    let weight = 1e3 * (0.5 * 0.4 * 0.3 + 4.0 * 0.5 * area) * 9.81;
    let expected = weight / (4.0 * young * area);
    let sunk = (0.3 - value(&simulation, "corner.z")) / expected;
    assert!((sunk - 1.0).abs() < 0.01, "{sunk}");
    let summary = simulation.summary();
    assert!(summary.energy_drift < 1e-3 && summary.ledger_residual < 1e-11, "{summary:?}");
}

/// A rod of hexahedra, turned by an angle about a skew axis, whose left end gets a pulse, and whose right end
/// reflects nothing; its sides are held. Energy that has come, and that is left when the pulse has gone.
fn rod(element: &str, angle: f64, poisson: f64, shear: bool) -> (f64, f64) {
    let (length, width) = (0.1, 2e-3);
    let axis = unit([1.0, 2.0, -0.5]);
    let turn = |x: Vector| crate::solids::apply(&crate::solids::rotation(axis, angle), x);
    let mut model = model(0.0);
    model.materials.get_mut("soft").unwrap().parameters.insert("poisson".into(), poisson);
    let placement = Placement { rotation: angle, rotation_axis: axis, ..Placement::default() };
    let shape = cuboid([0.0; 3], [length, width, width], [100, 2, 2]);
    model.parts.push(Part { element: element.into(), placement, ..part("rod", shape) });
    let wave = 1e9 * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let speed = (if shear { 0.5e9 / (1.0 + poisson) } else { wave } / 1e3).sqrt();
    let duration = 0.04 / speed;
    model.run.end = 0.16 / speed;
    let values = vec![0.0, 1.0, 0.0];
    let curve = CurveShape::Table { times: vec![0.0, 0.5 * duration, duration], values, smooth: true };
    model.curves.insert("pulse".into(), Curve::from(curve));
    let curve = Some("pulse".to_string());
    if shear {
        // Only what moves along y moves.
        let still = || Some(Drive::Constant(0.0));
        model.constraints.push(Constraint { on: "rod".into(), velocity: [still(), None, still()], ..Constraint::default() });
        model.loads.push(Load::Force { on: "rod.left".into(), force: [0.0, 1e5 * width * width, 0.0], curve });
    } else {
        for (point, normal) in [([0.0; 3], 1), ([0.0; 3], 2), ([0.0, width, 0.0], 1), ([0.0, 0.0, width], 2)] {
            let along: Vector = std::array::from_fn(|d| f64::from(u8::from(d == normal)));
            model.symmetries.push(Symmetry { point: turn(point), normal: turn(along), ..Symmetry::default() });
        }
        model.loads.push(Load::Pressure { on: "rod.left".into(), pressure: 1e5, curve });
    }
    model.non_reflecting.push(NonReflecting { on: "rod.right".into() });
    let simulation = to_end(&model);
    let ledger = simulation.ledger();
    // ∫ p² dt / (ρ c) of the pulse: each smooth step has ∫ s² = 181/462 of its length.
    let exact = 1e5 * 1e5 * (181.0 / 462.0) * duration / (1e3 * speed) * width * width;
    assert!((ledger.external / exact - 1.0).abs() < 0.01, "{element}: {} {exact}", ledger.external);
    assert!((ledger.stores.damping / ledger.external - 1.0).abs() < 0.01, "{element}: {:?}", ledger.stores);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.01, "{element}: {summary:?}");
    (ledger.external, ledger.stores.kinetic + ledger.stores.elastic)
}

#[test]
fn pressure_and_shear_waves_leave_a_rod_through_a_boundary_that_reflects_nothing() {
    for element in ["hex8", "hex8_reduced", "hex8_reduced_assumed_strain"] {
        for (poisson, shear) in [(0.0, false), (0.3, false), (0.3, true)] {
            let (given, left) = rod(element, 0.0, poisson, shear);
            println!("{element} {poisson} shear {shear}: {:.2e} of the amplitude is reflected", (left.abs() / given).sqrt());
            // Energy goes with the square: less than 1 % of the amplitude comes back.
            assert!(left.abs() < 1e-4 * given, "{element} {poisson} {shear}: {left} of {given}");
        }
    }
    // In a skew position the dashpots are full matrices.
    let (given, left) = rod("hex8", 0.7, 0.3, false);
    let (straight, _) = rod("hex8", 0.0, 0.3, false);
    assert!((given / straight - 1.0).abs() < 1e-9 && left.abs() < 1e-4 * given, "{given} {straight} {left}");
}

/// Bars from point to point, as a model file has them.
fn truss(model: &mut Model, points: Vec<Vec<Vector>>, elements: usize, area: f64) {
    let shape = Shape::SpaceTruss(SpaceTruss { lines: points, elements });
    model.parts.push(Part { element: "bar2".into(), area: Some(area), ..part("bars", shape) });
}

#[test]
fn a_tripod_of_a_model_file_is_that_of_a_mesh_file() {
    let top = [0.1, -0.2, 0.4];
    let feet = [[1.0, 0.0, 0.0], [-0.5, 0.8, 0.1], [-0.4, -0.9, -0.2]];
    let run = |of_file: bool| {
        let mut model = model(2e-3);
        if of_file {
            bars(&mut model, lines(&[feet[0], top, feet[1], feet[2]], &[[0, 1], [2, 1], [3, 1]]), 0.01);
        } else {
            truss(&mut model, feet.map(|foot| vec![foot, top]).to_vec(), 1, 0.01);
        }
        let name = |k: usize| if of_file { format!("point{k}") } else { format!("bars.point{k}") };
        [0, 2, 3].into_iter().for_each(|k| hold(&mut model, &name(k)));
        model.loads.push(Load::Force { on: name(1), force: [2e3, 1e3, -4e3], curve: None });
        to_end(&model).frame().positions::<3>().to_vec()
    };
    let (ours, theirs) = (run(false), run(true));
    assert!(distance(ours[1], top) > 1e-6, "{ours:?}");
    assert_eq!(ours, theirs);
}

/// A rod of 400 bars whose first point gets a pulse of velocity along it: displacements along and across it,
/// m, and energies at each step.
fn pulse(along: Vector) -> (Vec<[f64; 2]>, Vec<f64>, Simulation) {
    let (young, density, from) = (1e9, 1e3, [0.3, -0.1, 0.2]);
    let speed = f64::sqrt(young / density);
    let mut model = model(0.6 / speed);
    model.materials.insert("soft".into(), elastic(young, density));
    let direction = unit(along);
    truss(&mut model, vec![vec![from, plus(from, 1.0, direction)]], 400, 1e-4);
    let velocity = 1e-3;
    for axis in 0..3 {
        let own = CurveShape::Table {
            times: vec![0.0, 0.05 / speed, 0.1 / speed],
            values: vec![0.0, velocity * direction[axis], 0.0],
            smooth: true,
        };
        model.curves.insert(["px", "py", "pz"][axis].into(), Curve::from(own));
    }
    let velocity = ["px", "py", "pz"].map(|name| Some(Drive::Curve(name.into())));
    model.constraints.push(Constraint { on: "bars.point0".into(), velocity, ..Constraint::default() });
    let start = simulation(&model).frame().positions::<3>().to_vec();
    let end = to_end(&model);
    let now = end.frame().positions::<3>().to_vec();
    let moved = start.iter().zip(&now).map(|(a, b)| {
        let way: Vector = [0, 1, 2].map(|d| b[d] - a[d]);
        let share: f64 = (0..3).map(|d| way[d] * direction[d]).sum();
        let rest: f64 = (0..3).map(|d| (way[d] - share * direction[d]).powi(2)).sum();
        [share, rest.sqrt()]
    });
    let energies = ["energy.internal", "energy.kinetic"].map(|name| value(&end, name)).to_vec();
    (moved.collect(), energies, end)
}

#[test]
fn a_wave_runs_along_a_rod_of_bars_at_its_speed_whatever_its_direction() {
    let (straight, energies, simulation) = pulse([1.0, 0.0, 0.0]);
    let summary = simulation.summary();
    assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-3, "{summary:?}");
    // A smooth pulse of a tenth of the length leaves a way of half of 1e-3 m/s · 0.1 m / (1000 m/s) behind;
    // half of it is made where its middle is, 0.05 m behind its front.
    let whole = 0.5 * 1e-3 * 0.1 / 1e3;
    // Both ends come first, then what is between them; k in hundredths of the length.
    let at = |k: usize| 4 * k + 1;
    assert!((straight[at(10)][0] / whole - 1.0).abs() < 0.01, "{straight:?}");
    let half = (1..100).find(|&k| straight[at(k)][0] < 0.5 * whole).unwrap();
    assert!((54..=56).contains(&half), "the middle of the pulse is at {half} %");
    assert!(straight[at(70)][0].abs() < 0.01 * whole);
    // A wave that runs one way has as much of either energy.
    assert!((energies[0] / energies[1] - 1.0).abs() < 0.01, "{energies:?}");
    for direction in [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], SKEW, [1.0, 1.0, 0.0], [-0.3, 0.2, 0.9]] {
        let (turned, others, _) = pulse(direction);
        for (a, b) in straight.iter().zip(&turned) {
            assert!((a[0] - b[0]).abs() < 1e-6 * whole && b[1] < 1e-6 * whole, "{direction:?}: {a:?} {b:?}");
        }
        assert!(energies.iter().zip(&others).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{direction:?}: {energies:?} {others:?}");
    }
}
