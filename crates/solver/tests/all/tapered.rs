//! Shells whose thickness grows from place to place.

use crate::bodies::*;
use crate::patches::Spread;
use crate::sheet_models::crash;
use crate::shell_benchmarks::{Problem, elastic, is_near};
use crate::shells::section;
use crate::shells_in_space::{Driven, motion, moved, random};
use embate_solver::model::{FieldValues, ImportedMesh, Line, MeshField, Model, Obstacle, Rectangle, ShellSection};

fn growing(thickness: f64, growth: [f64; 3]) -> ShellSection {
    ShellSection { thickness_growth: growth, ..section(thickness) }
}

#[test]
fn a_tapered_cantilever_bends_as_its_integral_says() {
    // P at the end of a strip with t = t0 (1 − c x/L): w = 12 P L³/(E b t0³) (−ln(1 − c) − c − c²/2)/c³, and
    // by shear −P L ln(1 − c)/(c k G b t0).
    let (length, width, thickness, young, taper, elements) = (1.0_f64, 0.1_f64, 0.05_f64, 2e6, 0.5_f64, 20);
    let section = growing(thickness, [-taper * thickness / length, 0.0, 0.0]);
    let tip = |element: &str| {
        let mut beam = Problem::of(element, [elements, 2], &elastic(young, 0.0), (&section, &[]), false, |u, v| {
            [[length * u, width * v, 0.0], [0.0, 0.0, 1.0]]
        });
        beam.hold(|i, _| i == 0, &[0, 1, 2, 3, 4, 5]);
        for (j, part) in [0.25, 0.5, 0.25].into_iter().enumerate() {
            let node = beam.node(elements, j);
            beam.load[6 * node + 2] = part;
        }
        let node = beam.node(elements, 1);
        beam.solve()[6 * node + 2]
    };
    let log = -(1.0 - taper).ln();
    let bending = 12.0 * length.powi(3) / (young * width * thickness.powi(3)) * (log - taper - 0.5 * taper * taper) / taper.powi(3);
    let shear = length * log / (taper * 5.0 / 6.0 * 0.5 * young * width * thickness);
    is_near("shell4", tip("shell4"), bending + shear, 5e-3);
    is_near("shell3", tip("shell3"), bending + shear, 1e-2);
}

#[test]
fn faces_of_a_tapered_sheet_and_its_mass_are_those_of_the_wedge() {
    let mut model = model(1e-4);
    add(&mut model, "sheet", Rectangle { size: [1.0, 0.5], elements: [4, 2], ..Rectangle::default() }.into(), [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section) = ("shell4".into(), Some(growing(0.01, [0.02, 0.01, 0.0])));
    let thickness = |x: &[f64]| 0.01 + 0.02 * x[0] + 0.01 * x[1];
    let simulation = simulation(&model);
    let places = simulation.coordinates();
    let mut counts = [0; 3];
    for x in places.as_chunks::<3>().0 {
        let side = x[2] / thickness(x);
        let which = [-0.5, 0.0, 0.5].iter().position(|at| (side - at).abs() < 1e-13);
        counts[which.unwrap_or_else(|| panic!("{x:?}"))] += 1;
    }
    assert_eq!(counts, [15; 3]);
    // 1000 kg/m³ times 0.5 m² times the thickness in the middle.
    let mass = simulation.overview().parts[0].mass;
    assert!((mass / (1000.0 * 0.5 * thickness(&[0.5, 0.25])) - 1.0).abs() < 1e-12, "{mass}");
    drop(simulation);
    model.parts[0].section = Some(growing(0.01, [-0.02, 0.0, 0.0]));
    let told = faults(&model).join("\n");
    assert!(told.contains("part[0].section.thickness_growth") && told.contains("thickness of"), "{told}");
    let mut model = crate::bodies::model(1e-4);
    add(&mut model, "line", Line { points: vec![[0.0, 0.0], [0.3, 0.0]], radius: 0.0, closed: false, elements: 3 }.into(), [0.0; 2]);
    (model.parts[0].element, model.parts[0].section) = ("shell2".into(), Some(growing(0.01, [0.02, 0.0, 0.0])));
    for [x, y] in crate::bodies::simulation(&model).coordinates().as_chunks::<2>().0 {
        let side = y / (0.01 + 0.02 * x);
        assert!([-0.5, 0.0, 0.5].iter().any(|at| (side - at).abs() < 1e-13), "{x} {y}");
    }
}

#[test]
fn a_growth_of_nothing_is_a_section_without_and_one_beside_is_that_of_its_mean() {
    let mut numbers = Spread::new(41);
    let (start, directors) = random(&mut numbers, 4, 0.1);
    let by = motion(&mut numbers, 4, 0.05);
    let pulls = |section: &ShellSection| {
        let mut one = Driven::new("shell4", &elastic(1e3, 0.3), section, &start, &[0, 1, 2, 3], &directors);
        let (places, turns) = moved(&start, &by);
        one.go(&places, &turns);
        one.pulls()
    };
    let centre: [f64; 3] = std::array::from_fn(|k| 0.25 * start.iter().map(|x| x[k]).sum::<f64>());
    let own = pulls(&section(0.1));
    let beside = pulls(&ShellSection { thickness_point: centre, ..growing(0.1, [0.05, 0.02, -0.03]) });
    let size = own.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
    assert!(own.iter().zip(&beside).all(|(a, b)| (a - b).abs() < 1e-12 * size));
    assert_eq!(own, pulls(&ShellSection { thickness_point: [7.0; 3], ..section(0.1) }));
}

#[test]
fn tapered_sheets_keep_momenta_and_the_ledger_and_have_equal_bits() {
    let mut model = crash(1e-4, 8);
    model.parts[1].section = Some(growing(0.001, [0.01, -0.005, 0.0]));
    let (simulation, history) = run(&model);
    let summary = simulation.summary();
    assert!(history.largest("contact.energy[all]") > 0.0);
    assert!(summary.ledger_residual < 1e-12, "{:e}", summary.ledger_residual);
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
    hash_of_equal_bits(&model, &[1, 2], "tapered");
}

/// A plate of quadrilaterals and triangles from a file, as a part with a section.
fn from_file(section: ShellSection, fields: Vec<MeshField>) -> Model {
    let mut file = mapped([6, 4], |u, v| [0.6 * u + 0.02 * (5.0 * v).sin(), 0.4 * v]);
    let cells = std::mem::take(&mut file.groups[0].cells);
    for (number, cell) in cells.into_iter().enumerate() {
        match number % 3 {
            0 => file.groups[0].cells.extend([vec![cell[0], cell[1], cell[2]], vec![cell[0], cell[2], cell[3]]]),
            // Nodes begin anywhere.
            turn => file.groups[0].cells.push((0..4).map(|k| cell[(k + turn) % 4]).collect()),
        }
    }
    file.fields = fields;
    let mut model = model(2e-4);
    add_mesh(&mut model, "plate", file, [0.0; 2]);
    let part = model.parts.last_mut().unwrap();
    (part.element, part.section, part.velocity) = ("shell4".into(), Some(section), [0.0, 0.0, -20.0]);
    part.spin = 50.0;
    model.obstacles.push(Obstacle::wall("floor", [0.0, 0.0, -0.012], [0.1, 0.0, 1.0]));
    model
}

#[test]
fn a_thickness_from_a_file_is_that_of_the_same_growth_to_the_last_bit() {
    let section_of = |name: &str| ShellSection { thickness: 0.0, thickness_field: name.into(), ..ShellSection::default() };
    let grows = growing(0.004, [0.01, -0.004, 0.0]);
    let plain = from_file(grows.clone(), vec![]);
    let file = &plain.meshes[0];
    let at = |node: &u32| grows.thickness_at(file.positions[*node as usize]);
    let by_node: Vec<f64> = (0..file.positions.len() as u32).map(|node| at(&node)).collect();
    let corners = vec![file.groups[0].cells.iter().map(|cell| cell.iter().map(at).collect()).collect()];
    let fields = |file: &ImportedMesh| {
        assert_eq!(file.positions.len(), by_node.len());
        vec![
            MeshField { name: "nodes".into(), values: FieldValues::Nodes(by_node.iter().copied().map(Some).collect()) },
            MeshField { name: "corners".into(), values: FieldValues::Corners(corners.clone()) },
        ]
    };
    let hash = to_end(&plain).summary().state_hash;
    assert_ne!(to_end(&from_file(section(0.004), vec![])).summary().state_hash, hash);
    for name in ["nodes", "corners"] {
        assert_eq!(to_end(&from_file(section_of(name), fields(file))).summary().state_hash, hash, "{name}");
    }
    // Each corner has its own: a step from element to element.
    let steps = (0..file.groups[0].cells.len()).map(|k| vec![0.003 + 1e-4 * k as f64; file.groups[0].cells[k].len()]).collect();
    let stepped = vec![MeshField { name: "steps".into(), values: FieldValues::Corners(vec![steps]) }];
    let mass = simulation(&from_file(section_of("steps"), stepped)).overview().parts[0].mass;
    let area = |cell: &Vec<u32>| {
        let x = |k: usize| file.positions[cell[k % cell.len()] as usize];
        (0..cell.len()).map(|k| 0.5 * (x(k)[0] * x(k + 1)[1] - x(k)[1] * x(k + 1)[0])).sum::<f64>()
    };
    let exact: f64 = file.groups[0].cells.iter().enumerate().map(|(k, cell)| 1e3 * (0.003 + 1e-4 * k as f64) * area(cell)).sum();
    assert!((mass / exact - 1.0).abs() < 1e-12, "{mass} {exact}");
    // What is not there, is not positive, or is not of a file.
    let mut lacking = fields(file);
    for field in &mut lacking {
        match &mut field.values {
            FieldValues::Nodes(values) => values[7] = None,
            FieldValues::Corners(groups) => groups[0][5][1] = 0.0,
        }
    }
    for (name, words) in [("nodes", "has no value at"), ("corners", "is 0e0 m at")] {
        let told = faults(&from_file(section_of(name), lacking.clone()));
        assert!(told.len() == 1 && told[0].contains("part[0].section.thickness_field") && told[0].contains(words), "{told:?}");
    }
    let told = faults(&from_file(section_of("node"), fields(file)));
    assert!(told.len() == 1 && told[0].contains("did you mean `nodes`?"), "{told:?}");
    let mut shape = crate::bodies::model(1e-4);
    add(&mut shape, "sheet", Rectangle::default().into(), [0.0; 2]);
    (shape.parts[0].element, shape.parts[0].section) = ("shell4".into(), Some(section_of("nodes")));
    let told = faults(&shape);
    assert!(told.len() == 1 && told[0].contains("no file gives its thickness"), "{told:?}");
}
