//! Parts of quadrilaterals and triangles: numbers, masses, forces and faults.

use super::patches::material;
use embate_solver::element::ELEMENTS;
use embate_solver::error::Error;
use embate_solver::model::{ImportedMesh, Load, MeshGroup, Model, Part, Run, Shape, Symmetry};
use embate_solver::output::CellKind;
use embate_solver::simulation::{Options, Simulation};
use std::sync::Arc;

/// A block of `n` by `n` squares of which every other one is cut into two triangles, in the order of the
/// rows.
fn cells(n: u32) -> Vec<Vec<u32>> {
    let mut cells = Vec::new();
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let [a, b, c, d] = [j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i];
        match (i + j) % 3 {
            0 => cells.extend([vec![a, b, c], vec![a, c, d]]),
            1 => cells.push(vec![a, b, c, d]),
            _ => cells.extend([vec![d, a, b], vec![d, b, c]]),
        }
    }
    cells
}

/// A square of one metre made of such cells, pulled down by gravity on two lines of symmetry.
fn block(n: u32, cells: Vec<Vec<u32>>) -> Model {
    let place = |k: u32| f64::from(k) / f64::from(n);
    let positions = (0..(n + 1) * (n + 1)).map(|k| [place(k % (n + 1)), place(k / (n + 1)), 0.0]).collect();
    let line = |name: &str, cells| MeshGroup { name: name.into(), dimension: 1, cells };
    let top = line("top", (0..n).map(|i| vec![n * (n + 1) + i, n * (n + 1) + i + 1]).collect());
    let groups = vec![MeshGroup { name: "body".into(), dimension: 2, cells }, top];
    let mut model = Model { run: Run { end: 1e-3, ..Run::default() }, ..Model::default() };
    model.meshes.push(Arc::new(ImportedMesh { source: "block".into(), positions, groups, ..ImportedMesh::default() }));
    model.materials.insert("m".into(), material("elastic", 0.3));
    let shape = Shape::Group { mesh: 0, group: "body".into() };
    model.parts.push(Part { name: "block".into(), material: "m".into(), shape, ..Part::default() });
    model
}

fn faults(model: &Model) -> Vec<String> {
    match Simulation::new(model, &Options::default()) {
        Err(Error::Model(faults)) => faults.iter().map(ToString::to_string).collect(),
        other => panic!("{:?}", other.map(|_| ())),
    }
}

fn has_triangles() -> bool {
    ELEMENTS.iter().any(|kind| kind.nodes() == 3)
}

#[test]
fn triangles_without_an_element_for_them_are_named_and_counted() {
    let mut model = block(6, cells(6));
    model.parts[0].element_triangles = "tri33".into();
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("group `body` has 48 triangles"), "{reported:?}");
    let remedy = if has_triangles() { "part[0].element_triangles" } else { "Recombine Surface" };
    assert!(reported[0].contains(remedy), "{reported:?}");
}

#[test]
fn clockwise_elements_are_reported_by_their_numbers_and_counted_beyond_twenty() {
    let quads = (0..36).map(|k| [7 * (k / 6) + k % 6, 7 * (k / 6) + k % 6 + 1, 7 * (k / 6) + k % 6 + 8, 7 * (k / 6) + k % 6 + 7]);
    let mut cells: Vec<Vec<u32>> = quads.map(Vec::from).collect();
    cells[10..].iter_mut().for_each(|cell| cell.reverse());
    let reported = faults(&block(6, cells));
    assert_eq!(reported.len(), 21);
    assert!(reported[0].contains("element 10 of part \"block\" at (") && reported[0].contains("negative area"), "{}", reported[0]);
    assert!(reported[19].contains("element 29 of part") && reported[20].contains("and 6 more elements like these"), "{reported:?}");
}

#[test]
fn a_part_of_quadrilaterals_and_triangles_keeps_its_numbers_and_its_mass() {
    if !has_triangles() {
        return; // What happens then is reported above.
    }
    let (n, density) = (6, material("elastic", 0.3).parameters["density"]);
    let model = block(n, cells(n));
    let simulation = Simulation::new(&model, &Options::default()).unwrap();
    let overview = simulation.overview();
    assert_eq!((overview.parts.len(), overview.parts[0].elements, overview.parts[0].nodes), (1, 60, 49));
    assert!((overview.parts[0].mass - density).abs() < 1e-12 * density);
    let (written, read, frame) = (simulation.cells(), cells(n), simulation.frame());
    assert_eq!(written.len(), read.len());
    for (k, cell) in read.iter().enumerate() {
        let kind = if cell.len() == 3 { CellKind::Triangle } else { CellKind::Quadrilateral };
        let places = |nodes: &[u32], positions: &[[f64; 2]]| {
            let mut places: Vec<[f64; 2]> = nodes.iter().map(|&node| positions[node as usize]).collect();
            places.sort_by(|a, b| a.partial_cmp(b).unwrap());
            places
        };
        let read: Vec<[f64; 2]> = model.meshes[0].positions.iter().map(|&[x, y, _]| [x, y]).collect();
        let (place, expected) = (places(written.cell(k), frame.positions::<2>()), places(cell, &read));
        assert_eq!((written.kinds[k], place), (kind, expected), "element {k}");
    }
}

#[test]
fn a_mixed_part_has_the_energies_of_all_its_elements_and_the_same_bits_for_any_threads() {
    if !has_triangles() {
        return;
    }
    let mut model = block(4, cells(4));
    model.parts[0].velocity = [0.0, -1.0, 0.0];
    model.symmetries.push(Symmetry { normal: [0.0, 1.0, 0.0], ..Symmetry::default() });
    model.loads.push(Load::Gravity { parts: vec![], acceleration: [0.0, -9.81, 0.0], curve: None });
    let mut hashes = Vec::new();
    for threads in [1, 3] {
        let mut simulation = Simulation::new(&model, &Options { threads, ..Options::default() }).unwrap();
        simulation.advance(1e-3, 40).unwrap();
        let summary = simulation.summary();
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 1e-2, "{summary:?}");
        let (columns, row) = (simulation.history_columns(), simulation.history_row());
        let value = |name: &str| row[columns.iter().position(|column| column == name).unwrap()];
        for name in ["kinetic", "internal"] {
            let (whole, part) = (value(&format!("energy.{name}")), value(&format!("energy.{name}[block]")));
            assert!((whole - part).abs() <= 1e-12 * whole.abs(), "{name}: {whole} {part}");
        }
        let frame = simulation.frame();
        let stress = frame.fields.iter().find(|field| field.kind.name == "stress").unwrap();
        assert_eq!(stress.values.len(), 4 * cells(4).len());
        // The lowest row: two triangles, a quadrilateral, and two squares of two triangles.
        assert!(stress.values.chunks_exact(4).take(7).all(|s| s[1] < 0.0), "{:?}", stress.values);
        hashes.push(summary.state_hash);
    }
    assert_eq!(hashes[0], hashes[1]);
}
