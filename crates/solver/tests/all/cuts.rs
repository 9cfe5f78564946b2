//! Cuts: discs that cut one wall of a ring against closed forms, and against whole planes, which find their
//! forces in another way.

use crate::beams::{beams, round};
use crate::bodies::*;
use crate::shells::section;
use embate_solver::model::{
    Constraint, Cuboid, Cut, Drive, ImportedMesh, Load, Model, Part, Polygon, Relaxation, Ring, Shape, SpaceTruss, Symmetry, Truss,
};

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
