//! Fields of elements at nodes: against linear stresses, which are exact there, and against the elements at
//! the node.

use crate::bodies::*;
use embate_solver::model::{Constraint, Drive, Extreme, ImportedMesh, Load, Model, Position, Probe, ProbeAt, Rectangle, Relaxation, Shape};

fn close(found: f64, wanted: f64, scale: f64, what: &str) {
    assert!((found - wanted).abs() <= scale, "{what}: {found:e} for {wanted:e}");
}

fn probe(model: &mut Model, name: &str, at: ProbeAt, fields: &[&str], position: Position, extreme: Option<Extreme>) {
    let fields = fields.iter().map(ToString::to_string).collect();
    model.probes.push(Probe { name: name.into(), at, fields, position, extreme, ..Probe::default() });
}

fn point(part: &str, [x, y]: [f64; 2]) -> ProbeAt {
    ProbeAt::Point { part: part.into(), point: [x, y, 0.0] }
}

fn element(part: &str, element: usize) -> ProbeAt {
    ProbeAt::Element { part: part.into(), element }
}

fn set(set: &str) -> ProbeAt {
    ProbeAt::Set { set: set.into() }
}

/// A column that stands under its weight: σ = −ρ g (h − y), which elements have in their middles.
fn column(grading: f64) -> Model {
    let mut model = slender(1.0, 1e9, 1e3);
    let shape = Rectangle { size: [0.1, 1.0], elements: [2, 10], grading: [1.0, grading], ..Rectangle::default() };
    add(&mut model, "column", Shape::Rectangle(shape), [0.0; 2]);
    model.constraints.push(Constraint {
        on: "column.bottom".into(),
        velocity: [None, Some(Drive::Constant(0.0)), None],
        ..Constraint::default()
    });
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -10.0, 0.0], curve: None });
    model.run.relaxation = Some(Relaxation { tolerance: 1e-18, from: 0.0 });
    model
}

#[test]
fn a_linear_stress_is_exact_at_nodes_inside() {
    let mut model = column(1.0);
    let at = |height: f64| -1e4 * (1.0 - height);
    for (name, place) in [("low", [0.05, 0.2]), ("high", [0.05, 0.9]), ("side", [0.1, 0.5])] {
        probe(&mut model, name, point("column", place), &["stress"], Position::Node, None);
    }
    probe(&mut model, "all", set("column"), &["stress"], Position::Node, None);
    probe(&mut model, "least", set("column"), &["stress"], Position::Node, Some(Extreme::Min));
    probe(&mut model, "middle", set("column.left"), &["stress"], Position::Node, Some(Extreme::Max));
    let (_, history) = run(&model);
    let last = |name: &str| history.last(&format!("{name}.stress_yy"));
    for (name, height) in [("low", 0.2), ("high", 0.9), ("side", 0.5), ("all", 0.5)] {
        close(last(name), at(height), 1e-3, name);
    }
    // At the ends it is that of the elements there.
    close(last("least"), at(0.05), 1e-3, "bottom");
    close(last("middle"), at(0.95), 1e-3, "top");
}

#[test]
fn means_at_nodes_are_weighted_by_volumes() {
    // Of unlike elements the node has the mean by their volumes, and not that of their numbers.
    let mut model = column(4.0);
    let height = |k: i32| (1..=k).map(|j| 4f64.powf(f64::from(j - 1) / 9.0)).sum::<f64>();
    let places: Vec<f64> = (0..=10).map(|k| height(k) / height(10)).collect();
    let place = [0.05, places[4]];
    probe(&mut model, "node", point("column", place), &["stress"], Position::Node, None);
    probe(&mut model, "plain", point("column", place), &["stress"], Position::Element, None);
    probe(&mut model, "number", ProbeAt::Node { part: "column".into(), node: 0 }, &["stress"], Position::Node, None);
    let (_, history) = run(&model);
    let middle = |k: usize| -1e4 * (1.0 - 0.5 * (places[k] + places[k + 1]));
    let sizes = [places[4] - places[3], places[5] - places[4]];
    let wanted = (sizes[0] * middle(3) + sizes[1] * middle(4)) / (sizes[0] + sizes[1]);
    close(history.last("node.stress_yy"), wanted, 1e-3, "by volumes");
    close(history.last("plain.stress_yy"), 0.5 * (middle(3) + middle(4)), 1e-3, "by numbers");
    assert!((wanted - 0.5 * (middle(3) + middle(4))).abs() > 10.0);
    close(history.last("number.stress_yy"), middle(0), 1e-3, "a corner has one element");
}

/// Two squares beside each other with a common side, of which the first may fail.
fn two_squares() -> Model {
    let positions = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]].map(|[x, y]: [f64; 2]| [x, y, 0.0]).to_vec();
    let one = |cell: Vec<u32>| std::iter::once(cell);
    let groups = vec![
        group("weak", 2, one(vec![0, 1, 4, 3])),
        group("strong", 2, one(vec![1, 2, 5, 4])),
        group("seam", 0, [1, 4].into_iter().map(|node| vec![node])),
        group("end", 0, [0, 3].into_iter().map(|node| vec![node])),
        group("rim", 0, [2, 5].into_iter().map(|node| vec![node])),
    ];
    let mut model = model(0.02);
    add_groups(
        &mut model,
        ImportedMesh { source: "squares".into(), positions, groups, ..ImportedMesh::default() },
        &["weak", "strong"],
        [0.0; 2],
    );
    let mut weak = model.materials["soft"].clone();
    weak.law = "j2".into();
    weak.parameters.insert("yield".into(), 1e6);
    weak.failure.insert("plastic_strain".into(), 0.01);
    model.materials.insert("weak".into(), weak);
    model.parts[0].material = "weak".into();
    model.parts[1].velocity = [15.0, 0.0, 0.0];
    model
}

#[test]
fn what_has_failed_counts_at_no_node_that_has_other_elements() {
    let mut model = two_squares();
    probe(&mut model, "one", element("weak", 0), &["stress"], Position::Element, None);
    probe(&mut model, "other", element("strong", 0), &["stress"], Position::Element, None);
    probe(&mut model, "seam", set("seam"), &["stress"], Position::Node, None);
    probe(&mut model, "end", set("end"), &["stress"], Position::Node, None);
    probe(&mut model, "most", set("end"), &["stress"], Position::Node, Some(Extreme::Max));
    let (simulation, history) = run(&model);
    let column = |name: &str| history.column(&format!("{name}.stress_xx"));
    let [weak, strong, seam, end, most] = ["one", "other", "seam", "end", "most"].map(column);
    let failed = most.iter().position(|value| value.is_nan()).expect("the weak one fails");
    assert!(failed > 2 && failed + 2 < most.len() && simulation.summary().erosion.is_some());
    for row in 0..failed {
        close(seam[row], 0.5 * (weak[row] + strong[row]), 1e-6, "of both");
        close(most[row], weak[row], 1e-6, "of the only one");
    }
    for row in failed..most.len() {
        // The weights of the nodes sum to one but for round-off.
        close(seam[row], strong[row], 1e-15 * strong[row].abs(), "of the other one");
        close(end[row], weak[row], 1e-15 * weak[row].abs(), "as it was at the end");
        assert!(most[row].is_nan(), "row {row}");
    }
}

#[test]
fn an_extreme_has_the_place_of_its_node_or_of_the_middle_of_its_element() {
    let mut model = column(1.0);
    probe(&mut model, "least", set("column"), &["stress", "displacement"], Position::Element, Some(Extreme::Min));
    probe(&mut model, "node", set("column.left"), &["stress"], Position::Node, Some(Extreme::Max));
    probe(&mut model, "plain", set("column.left"), &["stress"], Position::Node, Some(Extreme::Max));
    model.probes.iter_mut().for_each(|probe| probe.place = ["least", "node"].contains(&probe.name.as_str()));
    let (simulation, history) = run(&model);
    let last = |name: &str| history.last(name);
    // Lowest element: half of its height; both beside each other are alike, and the first of them is taken.
    close(last("least.stress_yy_at_y"), 0.05, 1e-5, "height of the lowest element");
    assert!([0.025, 0.075].iter().any(|x| (last("least.stress_yy_at_x") - x).abs() < 1e-9), "{}", last("least.stress_yy_at_x"));
    // The top goes down most: its nodes, where they are now.
    close(last("least.displacement_y_at_y"), 1.0 + last("least.displacement_y"), 1e-15, "top");
    close(last("node.stress_yy_at_x"), 0.0, 1e-12, "left");
    close(last("node.stress_yy_at_y"), 1.0 + last("least.displacement_y"), 1e-15, "top left");
    assert_eq!(history.column("node.stress_yy"), history.column("plain.stress_yy"));
    let columns = simulation.history_columns();
    assert!(!columns.iter().any(|name| name.starts_with("plain.") && name.contains("_at_")), "{columns:?}");
    let own: Vec<&str> = columns.iter().filter_map(|name| name.strip_prefix("least.displacement")).collect();
    assert_eq!(own, ["_x", "_y", "_x_at_x", "_x_at_y", "_y_at_x", "_y_at_y"]);
}

#[test]
fn the_place_of_an_extreme_goes_with_it_and_is_none_where_nothing_is_left() {
    let mut model = two_squares();
    probe(&mut model, "both", set("seam"), &["von_mises"], Position::Element, Some(Extreme::Min));
    probe(&mut model, "first", set("weak"), &["von_mises"], Position::Element, Some(Extreme::Max));
    model.probes.iter_mut().for_each(|probe| probe.place = probe.extreme.is_some());
    for name in ["end", "seam", "rim"] {
        probe(&mut model, &format!("at_{name}"), set(name), &[], Position::Element, None);
    }
    probe(&mut model, "one", element("weak", 0), &["von_mises"], Position::Element, None);
    probe(&mut model, "other", element("strong", 0), &["von_mises"], Position::Element, None);
    let (_, history) = run(&model);
    let [both, one, other] = ["both", "one", "other"].map(|name| history.column(&format!("{name}.von_mises")));
    let [at, weak] = ["both", "first"].map(|name| history.column(&format!("{name}.von_mises_at_x")));
    let [end, seam, rim] = ["at_end", "at_seam", "at_rim"].map(|name| history.column(&format!("{name}.x")));
    let failed = weak.iter().position(|x| x.is_nan()).expect("the weak one fails");
    let mut seen = [false; 2];
    for row in 0..both.len() {
        let is_other = row >= failed || other[row] < one[row];
        assert_eq!(both[row], if is_other { other[row] } else { one[row] }, "row {row}");
        if one[row] != other[row] || row >= failed {
            let middle = 0.5 * (seam[row] + if is_other { rim[row] } else { end[row] });
            close(at[row], middle, 1e-12, &format!("row {row}"));
            seen[usize::from(is_other)] = true;
        }
    }
    assert_eq!(seen, [true, true], "each is the least at some time");
    assert!(weak[failed..].iter().all(|x| x.is_nan()) && weak[..failed].iter().all(|x| x.is_finite()));
}
