//! Parts of runs that go over to meshes of the user's own: what is kept, that the run continues as it did,
//! and that it is the same on any machine and after a stop.

use crate::bodies::*;
use crate::relocated::{Bricks, Point, XYZ, add_bricks, bricks, rod, skew};
use crate::remeshing::{close, events, taylor};
use embate_solver::error::Error;
use embate_solver::model::{Contact, Formulation, ImportedMesh, MeshGroup, Model, Partners};
use embate_solver::output::Remeshing;
use embate_solver::simulation::{Options, Simulation};
use std::collections::BTreeMap;

/// What elements are divided into.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Division {
    /// Quadrilaterals into four, hexahedra into eight.
    Finer,
    /// Hexahedra into 24 tetrahedra about their centre and those of their faces.
    Tetrahedra,
}

/// Nodes of a mesh that are means of nodes of another one.
struct Means<'a> {
    of: &'a [Point],
    numbers: BTreeMap<Vec<u32>, u32>,
    positions: Vec<Point>,
}

impl Means<'_> {
    fn of(&mut self, nodes: &[u32]) -> u32 {
        let mut key = nodes.to_vec();
        key.sort_unstable();
        key.dedup();
        let mean = |k: usize| key.iter().map(|&node| self.of[node as usize][k]).sum::<f64>() / key.len() as f64;
        let place = [0, 1, 2].map(mean);
        *self.numbers.entry(key).or_insert_with(|| {
            self.positions.push(place);
            self.positions.len() as u32 - 1
        })
    }
}

const FACES: [[usize; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
/// Places of the corners of a hexahedron.
const CORNERS: [[usize; 3]; 8] = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// The elements of a simulation of one part as they are now, divided.
fn divided(simulation: &Simulation, into: Division) -> ImportedMesh {
    let (cells, dimension) = (simulation.cells(), simulation.dimension());
    let of: Vec<Point> = simulation.coordinates().chunks(dimension).map(|x| [x[0], x[1], *x.get(2).unwrap_or(&0.0)]).collect();
    let mut means = Means { of: &of, numbers: BTreeMap::new(), positions: Vec::new() };
    let mut found: Vec<Vec<u32>> = Vec::new();
    for range in cells.offsets.windows(2) {
        let nodes = &cells.nodes[range[0] as usize..range[1] as usize];
        match (nodes.len(), into) {
            (4, _) => {
                let centre = means.of(nodes);
                for k in 0..4 {
                    let [a, b, c] = [nodes[k], nodes[(k + 1) % 4], nodes[(k + 3) % 4]];
                    found.push(vec![means.of(&[a]), means.of(&[a, b]), centre, means.of(&[a, c])]);
                }
            }
            (_, Division::Finer) => {
                // Corners of a child are means of all corners of the whole that they lie between.
                for child in CORNERS {
                    let corner = |own: &[usize; 3]| -> Vec<u32> {
                        let at = [0, 1, 2].map(|k| child[k] + own[k]);
                        let counts = |other: &[usize; 3]| (0..3).all(|k| at[k] == 1 || 2 * other[k] == at[k]);
                        CORNERS.iter().zip(nodes).filter(|(other, _)| counts(other)).map(|(_, node)| *node).collect()
                    };
                    found.push(CORNERS.iter().map(|own| means.of(&corner(own))).collect());
                }
            }
            (_, Division::Tetrahedra) => {
                let centre = means.of(nodes);
                for face in FACES {
                    let face = face.map(|k| nodes[k]);
                    let middle = means.of(&face);
                    (0..4).for_each(|k| found.push(vec![means.of(&[face[(k + 1) % 4]]), means.of(&[face[k]]), middle, centre]));
                }
            }
        }
    }
    let groups = vec![group("finer", dimension as u8, found.into_iter())];
    ImportedMesh { source: "finer.msh".into(), positions: means.positions, groups, ..ImportedMesh::default() }
}

fn exchange(simulation: &mut Simulation, model: &Model, mesh: ImportedMesh) -> Remeshing {
    let event = simulation.exchange(model, &model.parts[0].name, mesh, None).unwrap();
    println!("{event:?}");
    event
}

fn on_one_thread() -> Options {
    Options { threads: 1, simd: None }
}

#[test]
fn what_flies_and_spins_goes_over_to_other_elements_without_a_trace() {
    for (element, into, spin) in [
        ("hex8", Division::Finer, 0.0),
        ("hex8", Division::Finer, 300.0),
        ("hex8_reduced", Division::Finer, 300.0),
        ("hex8", Division::Tetrahedra, 0.0),
        ("hex8_reduced", Division::Tetrahedra, 300.0),
    ] {
        // Of a coarse mesh the lumped masses have more inertia than those of a finer one can be given.
        let n = if spin == 0.0 { 4 } else { 7 };
        println!("{element} {into:?} {spin}");
        let mut model = model(2e-3);
        add_bricks(&mut model, "block", element, bricks([n, n, n], Bricks::Hexahedra, skew), [20.0, 7.0, -5.0]);
        (model.parts[0].spin, model.parts[0].spin_axis) = (spin, [1.0, -2.0, 0.5]);
        let mut simulation = Simulation::new(&model, &on_one_thread()).unwrap();
        simulation.advance(1e-3, u64::MAX).unwrap();
        let kinetic = value(&simulation, "energy.kinetic");
        let mesh = divided(&simulation, into);
        let event = exchange(&mut simulation, &model, mesh);
        assert_eq!(event.elements, [n.pow(3), n.pow(3) * if into == Division::Finer { 8 } else { 24 }]);
        assert!(event.momentum_change.iter().all(|change| *change < 1e-12) && event.volume_change.abs() < 1e-3, "{event:?}");
        let lost = event.kinetic_lost / kinetic;
        assert!(if spin == 0.0 { lost.abs() < 1e-12 } else { (-1e-12..2e-3).contains(&lost) }, "{lost}");
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let (summary, _) = events(&simulation);
        assert!(summary.ledger_residual < 1e-12 && summary.momentum_drift_linear.unwrap() < 1e-12);
        assert!(summary.momentum_drift_angular.unwrap() < 1e-11, "{:?}", summary.momentum_drift_angular);
        if spin == 0.0 {
            assert!(summary.energy_drift < 1e-10, "{}", summary.energy_drift);
            for (column, value_at_start) in [("block.vx", 20.0), ("block.vy", 7.0), ("block.vz", -5.0)] {
                close(value(&simulation, column), value_at_start, 1e-9, column);
            }
        }
    }
}

#[test]
fn a_rod_on_finer_elements_or_tetrahedra_comes_to_rest_as_it_did() {
    let ends = |into: Option<Division>| {
        let model = rod(200.0, [2, 20], XYZ);
        let mut simulation = Simulation::new(&model, &on_one_thread()).unwrap();
        simulation.advance(30e-6, u64::MAX).unwrap();
        let kinetic = value(&simulation, "energy.kinetic");
        if let Some(into) = into {
            let mesh = divided(&simulation, into);
            let event = exchange(&mut simulation, &model, mesh);
            assert!(event.kinetic_lost > -1e-9 * kinetic && event.kinetic_lost < 0.01 * kinetic, "{event:?}");
            assert!(event.momentum_change[0] < 1e-12 && event.volume_change.abs() < 1e-3, "{event:?}");
        }
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let (summary, _) = events(&simulation);
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.02, "{}", summary.energy_drift);
        [value(&simulation, "tail.z"), value(&simulation, "rim.x")]
    };
    let [as_it_was, finer, tetrahedra] = [None, Some(Division::Finer), Some(Division::Tetrahedra)].map(ends);
    println!("{as_it_was:?} {finer:?} {tetrahedra:?}");
    for other in [finer, tetrahedra] {
        close(other[0], as_it_was[0], 0.005 * as_it_was[0], "length");
        close(other[1], as_it_was[1], 0.03 * as_it_was[1], "foot");
    }
}

#[test]
fn a_rod_in_2d_on_finer_elements_comes_to_rest_as_it_did() {
    let ends = |exchanges: bool| {
        let model = taylor(227.0, [5, 50], &[]);
        let mut simulation = Simulation::new(&model, &on_one_thread()).unwrap();
        simulation.advance(20e-6, u64::MAX).unwrap();
        if exchanges {
            let mesh = divided(&simulation, Division::Finer);
            let event = exchange(&mut simulation, &model, mesh);
            assert!(event.elements == [250, 1000] && event.volume_change.abs() < 1e-12 && event.momentum_change[0] < 1e-12);
        }
        simulation.advance(f64::INFINITY, u64::MAX).unwrap();
        let (summary, _) = events(&simulation);
        assert!(summary.ledger_residual < 1e-12 && summary.energy_drift < 0.02, "{}", summary.energy_drift);
        value(&simulation, "tail.y")
    };
    let [as_it_was, finer] = [false, true].map(ends);
    println!("{as_it_was} {finer}");
    close(finer, as_it_was, 0.004 * as_it_was, "length");
}

#[test]
fn what_went_over_is_the_same_on_all_threads_and_after_a_stop() {
    let model = rod(200.0, [2, 24], XYZ);
    let run = |options: &Options, stops: bool| {
        let mut simulation = Simulation::new(&model, options).unwrap();
        simulation.advance(10e-6, u64::MAX).unwrap();
        let mesh = divided(&simulation, Division::Finer);
        exchange(&mut simulation, &model, mesh);
        if stops {
            let state = simulation.state().unwrap();
            simulation = Simulation::resumed(&model, options, &state.sections).unwrap();
            assert_eq!(simulation.state().unwrap(), state);
        }
        simulation.advance(14e-6, u64::MAX).unwrap();
        simulation.hashes()
    };
    let alone = run(&Options { threads: 1, simd: Some("scalar".into()) }, false);
    assert_eq!(run(&Options { threads: 2, simd: None }, false), alone, "two threads");
    assert_eq!(run(&on_one_thread(), true), alone, "resumed");
}

#[test]
fn a_mesh_that_is_none_of_the_part_is_refused_and_the_run_stands_where_it_stood() {
    let mut model = model(1e-3);
    add_bricks(&mut model, "block", "hex8", bricks([3, 3, 3], Bricks::Hexahedra, skew), [20.0, 7.0, -5.0]);
    let mut simulation = Simulation::new(&model, &on_one_thread()).unwrap();
    simulation.advance(1e-4, u64::MAX).unwrap();
    let (state, mesh) = (simulation.state().unwrap(), divided(&simulation, Division::Finer));
    let mut refused = |part: &str, group: Option<&str>, change: &dyn Fn(&mut ImportedMesh)| {
        let mut mesh = mesh.clone();
        change(&mut mesh);
        match simulation.exchange(&model, part, mesh, group) {
            Err(Error::Model(faults)) => faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"),
            other => panic!("{other:?}"),
        }
    };
    let found = refused("blok", None, &|_| ());
    assert!(found.contains("no part `blok`") && found.contains("`block`"), "{found}");
    let found = refused("block", Some("rough"), &|_| ());
    assert!(found.contains("no group `rough`") && found.contains("`finer`"), "{found}");
    let found = refused("block", None, &|mesh| mesh.groups.push(MeshGroup { name: "other".into(), ..mesh.groups[0].clone() }));
    assert!(found.contains("2 groups, `finer`, `other`"), "{found}");
    let found = refused("block", None, &|mesh| mesh.groups.clear());
    assert!(found.contains("no elements of 3 dimensions"), "{found}");
    // Drawn in millimetres; as it was at the start; turned inside out.
    let found = refused("block", None, &|mesh| mesh.positions.iter_mut().flatten().for_each(|x| *x *= 1e3));
    assert!(found.contains("m³, and the part has"), "{found}");
    let found = refused("block", None, &|mesh| mesh.positions.iter_mut().for_each(|x| x[0] -= 0.2));
    assert!(found.contains("block") && found.contains("finer.msh"), "{found}");
    let found = refused("block", None, &|mesh| mesh.groups[0].cells.iter_mut().for_each(|nodes| nodes.swap(0, 1)));
    assert!(!found.is_empty());
    assert_eq!(simulation.state().unwrap().sections, state.sections);
    simulation.exchange(&model, "block", mesh, Some("finer")).unwrap();
}

#[test]
fn what_does_not_go_over_is_refused() {
    let refused = |change: &dyn Fn(&mut Model)| {
        let mut model = model(1e-3);
        add_bricks(&mut model, "block", "hex8", bricks([3, 3, 3], Bricks::Hexahedra, skew), [20.0, 7.0, -5.0]);
        change(&mut model);
        let mut simulation = Simulation::new(&model, &on_one_thread()).unwrap();
        let mesh = divided(&simulation, Division::Finer);
        let found = simulation.exchange(&model, "block", mesh, None);
        found.map(|_| ()).map_err(|error| error.to_string()).err().unwrap_or_default()
    };
    assert_eq!(refused(&|_| ()), "");
    let partners = Partners::Bodies(vec![]);
    let segments = Contact { name: "all".into(), formulation: Formulation::Segment, partners, ..Contact::default() };
    let found = refused(&|model| model.contacts.push(segments.clone()));
    assert!(found.contains("contact `all` is a `segment` one"), "{found}");
    let found = refused(&|model| model.parts[0].mass_scale = 2.0);
    assert!(found.contains("mass_scale"), "{found}");
}
