//! What shells show at their faces and half way through, and the directors of their nodes.

use crate::bodies::*;
use crate::patches::{Spread, material};
use crate::shells::section;
use crate::shells_in_space::Driven;
use embate_solver::block::Through;
use embate_solver::model::{Cylinder, Line, Model, Rectangle, Shape, ShellSection};
use embate_solver::rigid::space::Attitude;
use embate_solver::simulation::Simulation;

type Vector = [f64; 3];

/// Σ σ_ij a_i b_j.
fn seen(stress: [f64; 6], a: Vector, b: Vector) -> f64 {
    let [xx, yy, zz, xy, yz, zx] = stress;
    let m = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    (0..9).map(|k| a[k / 3] * m[k / 3][k % 3] * b[k % 3]).sum()
}

fn von_mises([xx, yy, zz, xy, yz, zx]: &[f64; 6]) -> f64 {
    (xx * xx + yy * yy + zz * zz - xx * yy - yy * zz - zz * xx + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
}

/// An element of size one that lies anywhere, stretched by ε and bent by the curvature κ along its first
/// side, in so many steps.
fn bent(
    element: &str,
    law: &embate_solver::model::Material,
    section: &ShellSection,
    by: [f64; 2],
    steps: usize,
) -> ([Through; 3], [Vector; 3]) {
    let frame = Attitude::exponential(Spread::new(3).in_3d(2.0));
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| frame.turned(axis));
    let all = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]];
    let corners = &all[..if element == "shell4" { 4 } else { 3 }];
    let start: Vec<Vector> = corners.iter().map(|&x| frame.turned(x)).collect();
    let nodes: Vec<u32> = (0..corners.len() as u32).collect();
    let mut one = Driven::new(element, law, section, &start, &nodes, &[]);
    for k in 1..=steps {
        let [stretch, curvature] = by.map(|by| by * k as f64 / steps as f64);
        let places: Vec<Vector> = corners.iter().map(|&[x, y, z]| frame.turned([x * (1.0 + stretch), y, z])).collect();
        // The upper face of a shell that is bent upwards is compressed.
        let turns: Vec<Attitude> =
            corners.iter().map(|&[x, ..]| Attitude::exponential(axes[1].map(|component| -component * curvature * x))).collect();
        one.go(&places, &turns);
    }
    (one.block.state(0).through, axes)
}

#[test]
fn faces_of_an_elastic_shell_that_lies_anywhere_have_the_stress_of_a_plate() {
    let (law, thickness) = (material("elastic", 0.3), 0.1);
    let plate = crate::patches::YOUNG / (1.0 - 0.09);
    let (stretch, curvature) = (2e-6, 3e-5);
    for element in ["shell4", "shell3"] {
        for (points, rule) in [(2, "gauss"), (5, "gauss"), (8, "gauss"), (3, "lobatto"), (6, "lobatto")] {
            let section = ShellSection { points, rule: rule.into(), ..section(thickness) };
            let (through, axes) = bent(element, &law, &section, [stretch, curvature], 1);
            for (own, height) in through.iter().zip([-0.5, 0.0, 0.5]) {
                let strain = stretch - height * thickness * curvature;
                for (i, j, expected) in [(0, 0, plate * strain), (1, 1, 0.3 * plate * strain), (2, 2, 0.0), (0, 1, 0.0), (1, 2, 0.0)] {
                    let found = seen(own.stress, axes[i], axes[j]);
                    assert!(
                        (found - expected).abs() < 3e-5 * plate * stretch,
                        "{element} {points} {rule} {height} {i}{j}: {found} {expected}"
                    );
                }
            }
        }
        // A membrane is the same all through.
        let (through, _) = bent(element, &law, &ShellSection { points: 1, ..section(thickness) }, [stretch, curvature], 1);
        assert_eq!(through[0], through[2]);
    }
}

#[test]
fn layers_on_the_faces_show_their_own_stress_and_plastic_strain() {
    let mut law = material("j2", 0.3);
    law.parameters.extend([("yield".to_string(), 1.0), ("hardening".to_string(), 50.0)]);
    // Elastic inside, flowing on both faces; the tension of the lower one is larger.
    let section = ShellSection { points: 7, rule: "lobatto".into(), ..section(0.1) };
    let (through, _) = bent("shell4", &law, &section, [5e-4, 0.1], 50);
    let [bottom, middle, top] = through;
    assert!(bottom.plastic_strain > top.plastic_strain && top.plastic_strain > 1e-3 && middle.plastic_strain == 0.0, "{through:?}");
    for own in [bottom, top] {
        // On the yield surface of its plastic strain.
        let yields = 1.0 + 50.0 * own.plastic_strain;
        assert!((von_mises(&own.stress) / yields - 1.0).abs() < 1e-9, "{own:?}");
    }
    assert!(von_mises(&middle.stress) < 1.0);
}

/// A pipe in 3D; in 2D a straight sheet and a block.
fn scene(dimension: usize) -> Model {
    let mut model = model(4e-3);
    let round: Shape = if dimension == 3 {
        Cylinder { radius: 0.1, length: 0.2, elements: [4, 16], ..Cylinder::default() }.into()
    } else {
        Line { points: vec![[0.0, 0.0], [0.3, 0.4]], radius: 0.0, closed: false, elements: 4 }.into()
    };
    add(&mut model, "sheet", round, [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section) = (if dimension == 3 { "shell4" } else { "shell2" }.into(), Some(section(0.01)));
    if dimension == 2 {
        add(&mut model, "block", rectangle([1.0, 0.0], [0.1, 0.1], [1, 1]), [0.0; 2]);
    }
    model
}

fn values(simulation: &Simulation, name: &str) -> Vec<f64> {
    simulation.field(name).unwrap_or_else(|| panic!("no {name}")).values
}

#[test]
fn fields_of_faces_are_there_for_who_asks() {
    let mut model = scene(3);
    assert!(simulation(&model).frame().fields.iter().all(|field| !["stress_top", "director"].contains(&field.kind.name)));
    model.output.include = vec!["stress_top".into(), "director".into()];
    let names: Vec<&str> = simulation(&model).frame().fields.iter().map(|field| field.kind.name).collect();
    assert_eq!(names, ["stress_top", "director"]);
}

#[test]
fn directors_of_a_pipe_point_outwards_and_turn_with_it() {
    let mut model = scene(3);
    model.parts[0].spin = 100.0;
    let mut simulation = simulation(&model);
    let start = simulation.coordinates();
    let check = |simulation: &Simulation, tolerance: f64| {
        let (places, directors) = (simulation.coordinates(), values(simulation, "director"));
        assert_eq!(places.len(), directors.len());
        for (x, d) in places.as_chunks::<3>().0.iter().zip(directors.as_chunks::<3>().0) {
            let radius = x[0].hypot(x[1]);
            let off = [d[0] - x[0] / radius, d[1] - x[1] / radius, d[2]];
            assert!(off.iter().all(|off| off.abs() < tolerance), "{x:?} {d:?}");
        }
    };
    check(&simulation, 1e-12);
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let turned = (start[0] * simulation.coordinates()[1] - start[1] * simulation.coordinates()[0]) / 0.01;
    assert!((turned - 0.4f64.sin()).abs() < 0.2, "{turned}");
    check(&simulation, 1e-3);
}

#[test]
fn directors_in_2d_are_normal_to_the_line_and_zero_elsewhere() {
    let simulation = simulation(&scene(2));
    let (places, directors) = (simulation.coordinates(), values(&simulation, "director"));
    for (x, d) in places.as_chunks::<2>().0.iter().zip(directors.as_chunks::<2>().0) {
        let expected = if x[0] > 0.9 { [0.0; 2] } else { [-0.8, 0.6] };
        assert!((d[0] - expected[0]).abs() < 1e-12 && (d[1] - expected[1]).abs() < 1e-12, "{x:?} {d:?}");
    }
}

#[test]
fn a_sheet_that_is_pulled_grows_thinner_by_what_the_law_says() {
    let law = material("elastic", 0.3);
    let mut model = model(1.0);
    model.materials.insert("soft".into(), law);
    add(&mut model, "sheet", Rectangle { size: [1.0; 2], elements: [2; 2], ..Rectangle::default() }.into(), [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section) = ("shell4".into(), Some(section(0.01)));
    let mut simulation = simulation(&model);
    assert!(values(&simulation, "thinning").iter().all(|&value| value == 0.0));
    let nodes = simulation.nodes_of("sheet").unwrap();
    let places = simulation.coordinates();
    // A homogeneous stretch in the first step.
    let rate = 1e-3;
    let velocities: Vec<f64> = nodes.iter().flat_map(|&node| [rate * places[3 * node as usize], 0.0, 0.0]).collect();
    simulation.set_velocities(&nodes, &velocities).unwrap();
    simulation.advance(f64::INFINITY, 1).unwrap();
    let stretch = rate * simulation.time();
    for value in values(&simulation, "thinning") {
        assert!((value / (0.3 / 0.7 * stretch) - 1.0).abs() < 1e-3, "{value} {stretch}");
    }
}
