//! Probes that stay at a place, and probes that go with material whose elements are made again.

use crate::bodies::*;
use crate::remeshing::every;
use embate_solver::model::{Cuboid, Disk, Model, Probe, ProbeAt, ProbeKind, Shape};

fn watch(model: &mut Model, part: &str, point: [f64; 3]) {
    let at = ProbeAt::Point { part: part.into(), point };
    let fields = vec!["displacement".into(), "pressure".into()];
    model.probes.push(Probe { name: "watch".into(), at, kind: ProbeKind::Place, fields, ..Probe::default() });
}

#[test]
fn a_place_sees_what_passes_it_and_nothing_else() {
    let velocity = [20.0, 7.0, -5.0];
    for dimension in [2, 3] {
        let mut model = model(6e-3);
        let place = if dimension == 2 {
            add(&mut model, "block", rectangle([0.0, 0.0], [0.06, 0.05], [5, 4]), [velocity[0], velocity[1]]);
            [0.1, 0.05, 0.0]
        } else {
            let shape = Cuboid { corner: [0.0; 3], size: [0.06, 0.05, 0.04], elements: [4, 3, 2], ..Cuboid::default() };
            add(&mut model, "block", Shape::Cuboid(shape), [0.0; 2]);
            model.parts[0].velocity = velocity;
            [0.1, 0.05, 0.01]
        };
        watch(&mut model, "block", place);
        let (_, history) = run(&model);
        let (times, mut seen) = (history.column("time"), 0);
        for (row, &time) in times.iter().enumerate() {
            let value = |column: &str| history.column(&format!("watch.{column}"))[row];
            let is_in = |d: usize| {
                let x = place[d] - velocity[d] * time;
                (0.0..=[0.06, 0.05, 0.04][d]).contains(&x)
            };
            let is_inside = (0..dimension).all(is_in);
            for d in 0..dimension {
                let axis = ["x", "y", "z"][d];
                let [speed, way] = [format!("v{axis}"), format!("displacement_{axis}")].map(|column| value(&column));
                if is_inside {
                    assert!((speed - velocity[d]).abs() < 1e-9 && (way - velocity[d] * time).abs() < 1e-12, "{time}: {speed} {way}");
                } else {
                    assert!(speed.is_nan() && way.is_nan() && value("pressure").is_nan(), "{time}: {speed}");
                }
            }
            seen += usize::from(is_inside);
        }
        assert!(seen > 10 && seen < times.len() - 10, "{seen} of {}", times.len());
        assert!(history_names(&model).iter().all(|name| name != "watch.x" && name != "watch.ax"));
    }
}

fn history_names(model: &Model) -> Vec<String> {
    simulation(model).history_columns()
}

#[test]
fn a_probe_goes_with_the_material_between_the_nodes_of_new_elements() {
    let ends = |is_made: bool| {
        let mut model = model(4e-3);
        add(&mut model, "disk", Shape::Disk(Disk { centre: [0.3, -0.2], radius: 0.1, elements: 6 }), [20.0, 7.0]);
        (model.parts[0].element, model.parts[0].spin) = ("quad4".into(), 300.0);
        probe(&mut model, "rim", "disk", [0.4, -0.2]);
        probe(&mut model, "inside", "disk", [0.341, -0.177]);
        model.remeshes.push(every("disk", if is_made { 4e-4 } else { 1.0 }));
        run(&model)
    };
    let ((never, alone), (simulation, again)) = (ends(false), ends(true));
    assert!(never.summary().remeshings.is_empty() && simulation.summary().remeshings.len() >= 8);
    let (times, times_alone) = (again.column("time"), alone.column("time"));
    // Elements are 17 mm wide, and the rim is a polygon that is 0.8 mm off its circle.
    for (column, most) in [("rim.x", 2e-3), ("rim.y", 2e-3), ("inside.x", 2e-4), ("inside.y", 2e-4)] {
        let (wanted, found) = (alone.column(column), again.column(column));
        let off = |row: usize| {
            let next = times_alone.partition_point(|&time| time < times[row]).clamp(1, times_alone.len() - 1);
            let share = (times[row] - times_alone[next - 1]) / (times_alone[next] - times_alone[next - 1]);
            found[row] - (1.0 - share) * wanted[next - 1] - share * wanted[next]
        };
        let farthest = (0..times.len()).map(|row| off(row).abs()).fold(0.0, f64::max);
        let jump = (1..times.len()).map(|row| (off(row) - off(row - 1)).abs()).fold(0.0, f64::max);
        println!("{column}: off {farthest:.3e}, jumps by {jump:.3e}");
        assert!(farthest < most && jump < most, "{column}: {farthest} {jump}");
    }
}
