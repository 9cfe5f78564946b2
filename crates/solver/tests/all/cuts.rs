//! Cuts: discs that cut one wall of a ring against closed forms, and against whole planes, which find their
//! forces in another way; connections that cross the plane against the momentum of what is beyond.

use crate::beams::{beams, round};
use crate::bodies::*;
use crate::shells::section;
use embate_solver::model::{
    Constraint, Contact, Cuboid, Cut, Drive, ImportedMesh, Join, Joint, Load, Model, Motion, Part, Polygon, Probe, ProbeAt, Relaxation,
    Ring, Shape, SpaceTruss, Spring, Symmetry, Truss, Weld,
};
use embate_solver::simulation::Simulation;

fn close(found: f64, wanted: f64, scale: f64, what: &str) {
    assert!((found - wanted).abs() <= scale, "{what}: {found:e} for {wanted:e}");
}

fn cut(model: &mut Model, name: &str, point: [f64; 3], normal: [f64; 3], radius: Option<f64>) {
    model.cuts.push(Cut { name: name.into(), point, normal, radius, ..Cut::default() });
}

/// Forces and moment of a cut in 2D in the last row.
fn last(history: &History, name: &str) -> [f64; 3] {
    ["force_x", "force_y", "moment"].map(|value| history.last(&format!("cut.{value}[{name}]")))
}

#[test]
fn one_wall_of_a_ring_under_internal_pressure_has_pressure_times_radius() {
    let (inner, outer, pressure) = (0.5, 0.6, 1e4);
    let mut model = model(0.1);
    add(&mut model, "ring", Shape::Ring(Ring { inner, outer, elements: [4, 96], ..Ring::default() }), [0.0; 2]);
    model.symmetries.push(Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() });
    model.loads.push(Load::Pressure { on: "ring.inner".into(), pressure, curve: None });
    model.run.relaxation = Some(Relaxation { tolerance: 1e-16, from: 0.0 });
    let normal = [0.0, 1.0, 0.0];
    cut(&mut model, "whole", [0.0, 0.01, 0.0], normal, None);
    cut(&mut model, "right", [0.55, 0.01, 0.0], normal, Some(0.1));
    cut(&mut model, "left", [-0.55, 0.01, 0.0], normal, Some(0.1));
    let (_, history) = run(&model);
    let whole = history.column("cut.force_y[whole]");
    let [right, left] = ["right", "left"].map(|name| history.column(&format!("cut.force_y[{name}]")));
    for (row, whole) in whole.iter().enumerate() {
        close(right[row] + left[row], *whole, 1e-10 * pressure, "both walls in every row");
    }
    let [x, y, moment] = last(&history, "right");
    // The nodes beyond begin at one side of the polygon: it has half of the pressure on that.
    let (sine, cosine) = (std::f64::consts::TAU / 96.0).sin_cos();
    close(y, pressure * inner * 0.5 * (1.0 + cosine), 2e-4 * pressure * inner, "N = p r");
    close(x, -0.5 * pressure * inner * sine, 2e-4 * pressure * inner, "of a tension that leans");
    close(y, 0.5 * whole.last().unwrap(), 1e-7 * pressure, "half of the whole plane");
    let [.., other] = last(&history, "left");
    close(moment, -other, 1e-7 * pressure, "the walls are images of each other");
}

/// A ring of shells about the origin, with its top and bottom as sets.
fn hoop(radius: f64, elements: u32) -> ImportedMesh {
    let place = |k: u32| (f64::from(k) / f64::from(elements) * std::f64::consts::TAU).sin_cos();
    let positions = (0..elements).map(place).map(|(s, c)| [radius * c, radius * s, 0.0]).collect();
    let groups = vec![
        group("body", 1, (0..elements).map(|k| vec![k, (k + 1) % elements])),
        group("top", 0, std::iter::once(vec![elements / 4])),
        group("bottom", 0, std::iter::once(vec![3 * elements / 4])),
    ];
    ImportedMesh { source: "hoop".into(), positions, groups, ..Default::default() }
}

#[test]
fn a_ring_between_two_opposite_forces_has_half_of_them_and_the_moment_of_a_thin_ring_in_each_wall() {
    // At the angle φ from the load N = ½ F sin φ and M = F R (1/π − ½ sin φ): Timoshenko, Strength of
    // Materials II. Outwards it bends the outside at the loads and the inside at the sides.
    let (radius, thickness, force) = (1.0, 0.05, 0.1);
    let mut model = slender(60.0, 1.2e6, 30.0);
    add_mesh(&mut model, "ring", hoop(radius, 80), [0.0; 2]);
    let part = &mut model.parts[0];
    (part.element, part.section) = ("shell2".into(), Some(section(thickness)));
    for (on, sign) in [("top", 1.0), ("bottom", -1.0)] {
        model.loads.push(Load::Force { on: on.into(), force: [0.0, sign * force, 0.0], curve: None });
        model.constraints.push(Constraint { on: on.into(), velocity: [Some(Drive::Constant(0.0)), None, None], ..Constraint::default() });
    }
    model.run.relaxation = Some(Relaxation { tolerance: 1e-18, from: 0.0 });
    let across = 0.3 * radius;
    cut(&mut model, "both", [0.0, 0.01, 0.0], [0.0, 1.0, 0.0], None);
    cut(&mut model, "right", [radius, 0.01, 0.0], [0.0, 1.0, 0.0], Some(0.2));
    cut(&mut model, "left", [-radius, 0.01, 0.0], [0.0, 1.0, 0.0], Some(0.2));
    cut(&mut model, "roof", [across, 0.95, 0.0], [1.0, 0.0, 0.0], Some(0.2));
    let (_, history) = run(&model);
    close(history.last("cut.normal_force[both]"), force, 1e-6 * force, "both walls");
    let moment = |sine: f64| force * radius * (std::f64::consts::FRAC_1_PI - 0.5 * sine);
    for (name, sign) in [("right", 1.0), ("left", -1.0)] {
        let [x, y, m] = last(&history, name);
        close(x, 0.0, 1e-6 * force, name);
        close(y, 0.5 * force, 1e-6 * force, name);
        close(m, sign * moment(1.0), 2e-3 * force * radius, name);
    }
    let [x, y, m] = last(&history, "roof");
    close(x, 0.0, 1e-6 * force, "normal force");
    close(y, -0.5 * force, 1e-6 * force, "shear force");
    close(m, -moment(across / radius), 2e-3 * force * radius, "moment");
}

/// Two bars beside each other, of which the first is made by `part` at y = 0 and the second at y = 1.
fn pair(part: impl Fn(&mut Model, &str, f64)) -> Model {
    let mut model = model(2e-3);
    for (name, y) in [("one", 0.0), ("other", 1.0)] {
        part(&mut model, name, y);
        model.parts.last_mut().unwrap().velocity = [30.0, 10.0 * y - 4.0, 0.0];
    }
    model.run.bulk_viscosity = [0.06, 1.2];
    model.loads.push(Load::StiffnessDamping { parts: vec![], time: 1e-6 });
    model
}

/// Pairs of bars of all kinds of elements, with the names of the sets at their ends at x = 0 and 1.
fn pairs() -> Vec<(&'static str, [&'static str; 2], Model)> {
    let (sides, points) = (["left", "right"], ["point0", "point1"]);
    let mut all: Vec<(&str, [&str; 2], Model)> = Vec::new();
    for element in ["quad4", "quad4_reduced_assumed_strain"] {
        let part = |model: &mut Model, name: &str, y: f64| {
            add(model, name, rectangle([0.0, y], [1.0, 0.1], [10, 2]), [0.0; 2]);
            model.parts.last_mut().unwrap().element = element.into();
        };
        all.push((element, sides, pair(part)));
    }
    for element in ["tri3", "tri3_anp"] {
        let part = |model: &mut Model, name: &str, y: f64| {
            let outline = vec![[0.0, y], [1.0, y], [1.0, y + 0.1], [0.0, y + 0.1]];
            add(model, name, Shape::Polygon(Polygon { outline, size: 0.06, ..Polygon::default() }), [0.0; 2]);
            model.parts.last_mut().unwrap().element_triangles = element.into();
        };
        all.push((element, ["edge4", "edge2"], pair(part)));
    }
    for element in ["hex8", "hex8_reduced_assumed_strain"] {
        let part = |model: &mut Model, name: &str, y: f64| {
            let shape = Cuboid { corner: [0.0, y, 0.0], size: [1.0, 0.1, 0.1], elements: [10, 2, 2], ..Cuboid::default() };
            add(model, name, Shape::Cuboid(shape), [0.0; 2]);
            model.parts.last_mut().unwrap().element = element.into();
        };
        all.push((element, sides, pair(part)));
    }
    let line = |y: f64| vec![[0.0, y], [1.0, y]];
    let shells = |model: &mut Model, name: &str, y: f64| {
        add(model, name, Shape::Truss(Truss { lines: vec![line(y)], elements: 10 }), [0.0; 2]);
        let part = model.parts.last_mut().unwrap();
        (part.element, part.section) = ("shell2".into(), Some(section(0.05)));
    };
    all.push(("shell2", points, pair(shells)));
    let bars = |model: &mut Model, name: &str, y: f64| {
        add(model, name, Shape::Truss(Truss { lines: vec![line(y)], elements: 10 }), [0.0; 2]);
        let part = model.parts.last_mut().unwrap();
        (part.element, part.area) = ("bar2".into(), Some(0.1));
    };
    all.push(("bar2", points, pair(bars)));
    for element in ["shell4", "shell4_full"] {
        let sheets = |model: &mut Model, name: &str, y: f64| {
            add(model, name, rectangle([0.0, y], [1.0, 0.2], [10, 2]), [0.0; 2]);
            let part = model.parts.last_mut().unwrap();
            (part.element, part.section) = (element.into(), Some(section(0.05)));
        };
        all.push((element, sides, pair(sheets)));
    }
    let rods = |model: &mut Model, name: &str, y: f64| beams(model, name, vec![[0.0, y, 0.0], [1.0, y, 0.0]], 10, round(0.05));
    all.push(("beam2", points, pair(rods)));
    let space = |model: &mut Model, name: &str, y: f64| {
        let shape = Shape::SpaceTruss(SpaceTruss { lines: vec![vec![[0.0, y, 0.0], [1.0, y, 0.0]]], elements: 10 });
        let part = Part { name: name.into(), material: "soft".into(), element: "bar2".into(), area: Some(0.1), shape, ..Part::default() };
        model.parts.push(part);
    };
    all.push(("bar2 in 3D", points, pair(space)));
    all
}

/// The same in every row, by both ways: of the first bar that of a plane that cuts it alone, which has sums
/// over nodes, and that of a disc around it, which has the forces of its elements.
fn agree(model: &mut Model, case: &str) {
    let (point, normal) = ([0.47, 0.02, 0.01], [1.0, 0.1, 0.0]);
    cut(model, "disc", point, normal, Some(0.5));
    model.cuts.push(Cut { name: "alone".into(), point, normal, parts: vec!["one".into()], ..Cut::default() });
    cut(model, "both", point, normal, None);
    let (simulation, history) = run(model);
    let columns = simulation.history_columns();
    let of_disc: Vec<&String> = columns.iter().filter(|name| name.ends_with("[disc]")).collect();
    assert!(of_disc.len() >= 4, "{case}: {columns:?}");
    let mut largest = 0.0f64;
    for name in of_disc {
        let [disc, alone, both] = ["disc", "alone", "both"].map(|cut| history.column(&name.replace("disc", cut)));
        let size = alone.iter().fold(0.0f64, |size, value| size.max(value.abs()));
        largest = largest.max(size);
        for (row, (disc, alone)) in disc.iter().zip(&alone).enumerate() {
            close(*disc, *alone, 1e-11 * size.max(1.0), &format!("{case} {name}, row {row}"));
        }
        let moves = name.contains("force_x");
        assert!(!moves || both.iter().zip(&alone).any(|(both, alone)| (both - alone).abs() > 1e-3 * size), "{case} {name}");
    }
    assert!(largest > 1e3, "{case}: nothing acts, {largest}");
}

#[test]
fn a_disc_through_one_of_two_bars_has_what_a_plane_through_that_bar_alone_has() {
    for (element, [end, _], mut model) in pairs() {
        for name in ["one", "other"] {
            let velocity = [0.0, 0.0, 0.0].map(|still| Some(Drive::Constant(still)));
            let velocity = if model.dimension() == 3 { velocity } else { [velocity[0].clone(), velocity[1].clone(), None] };
            model.constraints.push(Constraint { on: format!("{name}.{end}"), velocity, ..Constraint::default() });
        }
        agree(&mut model, element);
    }
}

#[test]
fn elements_that_failed_count_for_nothing_in_a_disc() {
    for (element, ends, mut model) in pairs() {
        if !["quad4", "shell2", "hex8"].contains(&element) {
            continue;
        }
        // Pulled at both ends, slowly, until it fails.
        model.run.end = 8e-3;
        let soft = model.materials.get_mut("soft").unwrap();
        soft.law = "j2".into();
        soft.parameters.insert("yield".into(), 2e6);
        soft.failure.insert("plastic_strain".into(), 0.005);
        for part in &mut model.parts {
            part.velocity = [0.0; 3];
            for (end, speed) in ends.into_iter().zip([-1.0, 1.0]) {
                let velocity = [Some(Drive::Constant(speed)), None, None];
                model.constraints.push(Constraint { on: format!("{}.{end}", part.name), velocity, ..Constraint::default() });
            }
        }
        agree(&mut model, element);
        let summary = to_end(&model).summary();
        assert!(summary.erosion.is_some_and(|erosion| erosion.elements.iter().any(|(_, count)| *count > 0)), "{element}: nothing failed");
    }
}

#[test]
fn a_disc_that_meets_no_wall_is_a_fault() {
    let mut model = model(1e-3);
    add(&mut model, "ring", Shape::Ring(Ring::default()), [0.0; 2]);
    cut(&mut model, "hole", [0.0, 0.01, 0.0], [0.0, 1.0, 0.0], Some(0.1));
    let found = model_faults(&model);
    assert_eq!(found.iter().map(|fault| (fault.kind.code, fault.path.as_str())).collect::<Vec<_>>(), [("E0215", "cut[0]")]);
    assert!(found[0].message.contains("within 1.000e-1 m"), "{}", found[0].message);
    // Its radius is a length.
    model.cuts[0].radius = Some(-1.0);
    assert!(model.check().iter().any(|fault| fault.path == "cut[0].radius"));
}

/// What is beyond a cut, a set of this mass (kg/m, kg), is moved by the cut alone: in every row
/// m a = −N, in the mean.
fn moves_by(history: &History, cut: &str, set: &str, mass: f64, case: &str) {
    for axis in ["x", "y"] {
        let (force, acceleration) = (history.column(&format!("cut.force_{axis}[{cut}]")), history.column(&format!("{set}.a{axis}")));
        let size = force.iter().fold(0.0f64, |size, force| size.max(force.abs()));
        assert!(size > 1.0, "{case}: nothing goes across along {axis}");
        for (row, (force, acceleration)) in force.iter().zip(&acceleration).enumerate() {
            close(mass * acceleration, -force, 1e-10 * size, &format!("{case}, {axis}, row {row}"));
        }
    }
}

/// What is left out of cuts.
fn left_out(simulation: &Simulation) -> Vec<String> {
    let own = simulation.model_warnings().iter().filter(|warning| warning.kind.code == "W0205");
    own.map(|warning| warning.message.clone()).collect()
}

#[test]
fn a_cut_through_a_spring_in_series_with_bodies_has_its_force() {
    for is_solid in [false, true] {
        let mut model = model(2e-3);
        for (name, x) in [("left", 0.0), ("right", 1.1)] {
            let solid = Cuboid { corner: [x, 0.0, 0.0], size: [1.0, 0.1, 0.1], elements: [10, 1, 1], ..Cuboid::default() };
            let shape = if is_solid { Shape::Cuboid(solid) } else { rectangle([x, 0.0], [1.0, 0.1], [10, 1]) };
            add(&mut model, name, shape, [0.0; 2]);
            model.parts.last_mut().unwrap().element = if is_solid { "hex8" } else { "quad4" }.into();
        }
        model.parts[1].velocity = [3.0, 1.0, 0.0];
        let between = ["left.right", "right.left"].map(String::from);
        model.springs.push(Spring { between, stiffness: 2e5, damping: 30.0, ..Spring::default() });
        cut(&mut model, "gap", [1.03, 0.0, 0.0], [1.0, 0.0, 0.0], None);
        let depth = if is_solid { 0.05 } else { 0.0 };
        cut(&mut model, "low", [1.05, 0.0, depth], [1.0, 0.0, 0.0], Some(0.07));
        cut(&mut model, "high", [1.05, 0.1, depth], [1.0, 0.0, 0.0], Some(0.07));
        model.cuts.push(Cut { parts: vec!["right".into(), "left".into()], name: "named".into(), ..model.cuts[0].clone() });
        let (simulation, history) = run(&model);
        let mass = simulation.overview().parts[1].mass;
        moves_by(&history, "gap", "right", mass, if is_solid { "solids" } else { "plane" });
        let of = |name: &str| history.column(&format!("cut.force_x[{name}]"));
        assert_eq!(of("gap"), of("named"));
        // Each of the discs has the pairs of nodes at one side.
        let [all, low, high] = ["gap", "low", "high"].map(of);
        for (row, all) in all.iter().enumerate() {
            close(low[row] + high[row], *all, 1e-9 * all.abs().max(1.0), &format!("row {row}"));
        }
        assert!(low.iter().zip(&high).all(|(low, high)| low.signum() == high.signum()) && low.last() != Some(&0.0));
        assert!(left_out(&simulation).is_empty());
    }
}

#[test]
fn a_spring_to_a_part_that_is_not_named_is_left_out_and_said() {
    let mut model = model(2e-3);
    add(&mut model, "left", rectangle([0.0, 0.0], [1.0, 0.1], [10, 1]), [0.0; 2]);
    add(&mut model, "right", rectangle([1.1, 0.0], [1.0, 0.1], [10, 1]), [3.0, 1.0]);
    let between = ["left.left", "right.left"].map(String::from);
    model.springs.push(Spring { between, stiffness: 2e5, ..Spring::default() });
    let point = [0.52, 0.0, 0.0];
    cut(&mut model, "all", point, [1.0, 0.0, 0.0], None);
    model.cuts.push(Cut { parts: vec!["left".into()], name: "one".into(), ..model.cuts[0].clone() });
    model.cuts.push(Cut { radius: Some(0.02), point: [0.52, 0.05, 0.0], name: "narrow".into(), ..model.cuts[0].clone() });
    let (simulation, history) = run(&model);
    let [message] = &left_out(&simulation)[..] else { panic!("{:?}", left_out(&simulation)) };
    assert_eq!(message, "spring[0] crosses the plane of cut `one` to a part that is none of its `parts`");
    // From node to node the springs pull with what their lengths say; the elements of the disc are all.
    let [all, one, narrow] = ["all", "one", "narrow"].map(|name| history.column(&format!("cut.force_x[{name}]")));
    assert!(all.iter().zip(&one).any(|(all, one)| (all - one).abs() > 100.0), "{all:?} {one:?}");
    for ((all, one), narrow) in all.iter().zip(&one).zip(&narrow) {
        close(*narrow, *one, 1e-6, "the springs are at the sides of the disc");
        assert!(all.is_finite());
    }
    // A rigid part goes along with any: what it is connected with counts.
    model.parts[1].rigid = Some(Motion::default());
    assert!(left_out(&made(&model)).is_empty());
}

/// A simulation at time zero.
fn made(model: &Model) -> Simulation {
    simulation(model)
}

/// Two layers of unlike meshes on each other, that of nodes beyond x = 0.47 as a set `far`, and its mass.
fn layers(columns: [u32; 2], offset: f64) -> (Model, f64) {
    let (mut positions, mut groups, mut masses) = (Vec::new(), Vec::new(), Vec::new());
    for (layer, (count, names)) in columns.into_iter().zip([["lower", "over"], ["upper", "under"]]).enumerate() {
        let (first, at) = (positions.len() as u32, |i: u32, j: u32| j * (count + 1) + i);
        for j in 0..=2 {
            for i in 0..=count {
                let share = |k: u32, last: u32| if k == 0 || k == last { 0.5 } else { 1.0 };
                let x = f64::from(i) / f64::from(count) + if (layer, j) == (1, 0) { offset } else { 0.0 };
                positions.push([x, 0.1 * layer as f64 + 0.05 * f64::from(j), 0.0]);
                masses.push(1e3 * 0.05 / f64::from(count) * share(i, count) * share(j, 2));
            }
        }
        let cells = (0..2).flat_map(|j| (0..count).map(move |i| [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]));
        groups.push(group(names[0], 2, cells.map(|cell| cell.map(|(i, j)| first + at(i, j)).to_vec())));
        let row = if layer == 0 { 2 } else { 0 };
        groups.push(group(names[1], 1, (0..count).map(|i| vec![first + at(i, row), first + at(i + 1, row)])));
    }
    let far = || (0..positions.len() as u32).filter(|node| positions[*node as usize][0] > 0.47 + 1e-6);
    groups.push(group("far", 0, far().map(|node| vec![node])));
    let mass = far().map(|node| masses[node as usize]).sum();
    let mut model = model(1e-3);
    add_groups(
        &mut model,
        ImportedMesh { source: "layers".into(), positions, groups, ..ImportedMesh::default() },
        &["lower", "upper"],
        [0.0; 2],
    );
    model.parts[1].velocity = [20.0, 5.0, 0.0];
    model.parts[1].spin = 40.0;
    model.probes.push(Probe { name: "far".into(), at: ProbeAt::Set { set: "far".into() }, ..Probe::default() });
    cut(&mut model, "section", [0.47, 0.0, 0.0], [1.0, 0.0, 0.0], None);
    (model, mass)
}

/// What connects the layers of a model.
type Connect = fn(&mut Model);

/// Sets of the layers that lie on each other, and a point between them.
fn seam() -> ([String; 2], [f64; 3]) {
    (["over", "under"].map(String::from), [0.47, 0.1, 0.0])
}

fn tie(model: &mut Model) {
    model.contacts.push(Contact { tied: Some(f64::INFINITY), ..Contact::between("glue", "under", "over") });
}

fn weld(model: &mut Model) {
    let (between, at) = seam();
    model.welds.push(Weld { name: "spot".into(), between, at: vec![at], radius: Some(0.2), ..Weld::default() });
}

fn joint(model: &mut Model) {
    let (between, at) = seam();
    let (name, kind) = ("pin".into(), "fixed".into());
    model.joints.push(Joint { name, between: between.to_vec(), kind, at, radius: Some(0.2), ..Joint::default() });
}

fn join(model: &mut Model) {
    model.joins.push(Join { between: seam().0, ..Join::default() });
}

#[test]
fn ties_welds_joints_and_joined_nodes_across_the_plane_count() {
    // Of joined nodes the upper one is a little beyond the plane, the lower one in it.
    let cases: [(&str, [u32; 2], f64, Connect); 4] =
        [("tie", [10, 7], 0.0, tie), ("weld", [10, 7], 0.0, weld), ("joint", [10, 7], 0.0, joint), ("join", [100, 100], 1e-7, join)];
    for (case, columns, offset, connect) in cases {
        let (mut model, mass) = layers(columns, offset);
        connect(&mut model);
        let (simulation, history) = run(&model);
        moves_by(&history, "section", "far", mass, case);
        assert!(left_out(&simulation).is_empty(), "{case}");
        // Of the lower layer alone it is left out; nodes that are one can't be.
        model.cuts[0].parts = vec!["lower".into()];
        let found = left_out(&made(&model));
        if case == "join" {
            assert!(found.is_empty(), "{found:?}");
        } else {
            let what = ["contact `glue`", "weld `spot`", "joint `pin`"].into_iter().find(|what| found[0].starts_with(what));
            assert!(found.len() == 1 && what.is_some(), "{case}: {found:?}");
        }
    }
}

#[test]
fn a_joint_with_the_ground_is_a_support_and_no_connection() {
    let (mut model, _) = layers([10, 10], 0.0);
    join(&mut model);
    let with = |model: &Model| run(model).1.column("cut.force_x[section]");
    model.joints.push(Joint {
        name: "foot".into(),
        between: vec!["lower".into()],
        kind: "fixed".into(),
        at: [0.47, 0.0, 0.0],
        radius: Some(0.12),
        ..Joint::default()
    });
    let whole = with(&model);
    // Elements alone, by a disc that takes them all.
    model.cuts[0].radius = Some(1.0);
    for (row, (disc, whole)) in with(&model).into_iter().zip(whole).enumerate() {
        close(disc, whole, 1e-6, &format!("row {row}"));
    }
}

#[test]
fn rigid_parts_across_a_plane_and_contacts_that_push_across_it_are_named() {
    let mut model = model(1e-3);
    add(&mut model, "left", rectangle([0.0, 0.0], [0.1, 0.1], [4, 4]), [0.0; 2]);
    add(&mut model, "right", rectangle([0.1001, 0.02], [0.1, 0.1], [4, 4]), [-5.0, 0.0]);
    touch(&mut model, "left.right", "right.left");
    cut(&mut model, "section", [0.0, 0.05, 0.0], [0.0, 1.0, 0.0], None);
    let (simulation, _) = run(&model);
    assert!(left_out(&simulation).is_empty());
    let pushed = |simulation: &Simulation| {
        let warnings = simulation.summary().warnings;
        warnings.iter().filter(|it| it.text.contains("pushes across the plane of cut \"section\"")).count()
    };
    assert_eq!(pushed(&simulation), 1);
    // Of one of the two that is no matter.
    model.cuts[0].parts = vec!["left".into()];
    assert_eq!(pushed(&run(&model).0), 0);
    model.cuts[0].parts.clear();
    model.parts[1].rigid = Some(Motion::default());
    let found = left_out(&made(&model));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0], "rigid part `right` lies across the plane of cut `section`, and forces in it are not known");
    model.cuts[0].radius = Some(0.11);
    model.cuts[0].point = [0.0, 0.05, 0.0];
    assert!(left_out(&made(&model)).is_empty());
}
