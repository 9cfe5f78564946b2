//! Whole models in 3D without contact: conservation, the plane as the limit of a slice, waves, loads
//! against closed forms, rigid bodies, erosion, equal bits, states.

use crate::bodies::{continues_to, every_step, hash_of_equal_bits, simulation, to_end, value};
use crate::patches::material;
use embate_solver::element::ELEMENTS_OF_SPACE;
use embate_solver::model::{
    Axis, Constraint, Cuboid, Cylinder, Drive, Extrude, ImportedMesh, InitialStress, Load, MeshGroup, Model, Motion, Part, Probe, ProbeAt,
    Rectangle, Rotation, Run, Shape, Sphere, Sweep, Symmetry,
};
use embate_solver::simulation::Simulation;
use std::sync::Arc;

/// A body of one part called `body`; of tetrahedra and wedges such as the shapes make.
fn model(element: &str, law: &str, shape: Shape, end: f64) -> Model {
    Model {
        name: "body".into(),
        run: Run { end, ..Run::default() },
        materials: [("m".to_string(), material(law, 0.3))].into(),
        parts: vec![Part { name: "body".into(), material: "m".into(), element: element.into(), shape, ..Part::default() }],
        ..Model::default()
    }
}

fn cuboid(size: [f64; 3], elements: [usize; 3]) -> Shape {
    Shape::Cuboid(Cuboid { corner: [0.0; 3], size, elements, ..Cuboid::default() })
}

/// Cuts the hexahedra of a box into two wedges or six tetrahedra each; its sides become the groups `left` and
/// `right`.
fn cut(model: &mut Model, nodes: usize) {
    let Shape::Cuboid(Cuboid { size, elements: [nx, ny, nz], .. }) = model.parts[0].shape else { panic!("a box") };
    let number = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let mut mesh = ImportedMesh { source: "cut".into(), ..ImportedMesh::default() };
    let (mut cells, mut sides) = (Vec::new(), [Vec::new(), Vec::new()]);
    for k in 0..=nz {
        for j in 0..=ny {
            mesh.positions
                .extend((0..=nx).map(|i| [size[0] * i as f64 / nx as f64, size[1] * j as f64 / ny as f64, size[2] * k as f64 / nz as f64]));
        }
    }
    for (i, j, k) in (0..nx * ny * nz).map(|cell| (cell % nx, cell / nx % ny, cell / nx / ny)) {
        let corner = |c: [usize; 3]| number(i + c[0], j + c[1], k + c[2]);
        if nodes == 6 {
            let hexahedron = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(corner);
            cells.extend([[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]].map(|wedge: [usize; 6]| wedge.map(|c| hexahedron[c]).to_vec()));
        } else {
            for (a, b, is_even) in [(0, 1, true), (1, 2, true), (2, 0, true), (1, 0, false), (2, 1, false), (0, 2, false)] {
                let (mut one, mut two) = ([0; 3], [0; 3]);
                (one[a], two[a], two[b]) = (1, 1, 1);
                let (second, third) = if is_even { (one, two) } else { (two, one) };
                cells.push([[0; 3], second, third, [1; 3]].map(corner).to_vec());
            }
        }
    }
    for (j, k) in (0..ny * nz).map(|facet| (facet % ny, facet / ny)) {
        for (side, i) in [0, nx].into_iter().enumerate() {
            // As both cuts do it: along the diagonal of x = const from the lowest corner; of wedges the
            // whole.
            let [a, b, c, d] = [number(i, j, k), number(i, j + 1, k), number(i, j + 1, k + 1), number(i, j, k + 1)];
            sides[side].extend(if nodes == 6 { vec![vec![a, b, c, d]] } else { vec![vec![a, b, c], vec![a, c, d]] });
        }
    }
    let group = |name: &str, dimension: u8, cells: Vec<Vec<u32>>| MeshGroup { name: name.into(), dimension, cells };
    let [left, right] = sides;
    mesh.groups = vec![group("body", 3, cells), group("left", 2, left), group("right", 2, right)];
    model.parts[0].shape = Shape::Group { mesh: 0, group: "body".into() };
    model.meshes.push(Arc::new(mesh));
}

/// A box of every element in 3D.
fn every_element(law: &str, end: f64, mut check: impl FnMut(&str, Model)) {
    for kind in ELEMENTS_OF_SPACE {
        let mut model = model(kind.name, law, cuboid([1.0, 0.7, 0.5], [4, 3, 2]), end);
        if kind.nodes() != 8 {
            cut(&mut model, kind.cell.corners());
        }
        check(kind.name, model);
    }
}

#[test]
fn a_body_that_flies_and_spins_keeps_both_momenta_and_its_energy() {
    every_element("neo_hookean", 1.5, |element, mut model| {
        model.parts[0].velocity = [0.3, -0.2, 0.5];
        model.parts[0].spin = 2.0;
        let simulation = to_end(&model);
        let summary = simulation.summary();
        assert_eq!(summary.dimension, 3);
        assert!(summary.momentum_drift_linear.unwrap() < 1e-13, "{element}: {summary:?}");
        assert!(summary.momentum_drift_angular.unwrap() < 1e-13, "{element}: {summary:?}");
        assert!(summary.ledger_residual < 1e-12, "{element}: {}", summary.ledger_residual);
        assert!(summary.energy_drift < 2e-3, "{element}: {}", summary.energy_drift);
        assert!(summary.steps > 30);
    });
}

#[test]
fn threads_and_instruction_sets_change_no_bit() {
    every_element("j2", 0.4, |element, mut model| {
        // Enough elements that threads share them.
        if let Shape::Cuboid(cuboid) = &mut model.parts[0].shape {
            cuboid.elements = [24, 16, 12];
        }
        model.run.max_steps = Some(12);
        (model.parts[0].velocity, model.parts[0].spin) = ([0.0, 0.0, -3.0], 20.0);
        model.symmetries.push(Symmetry { normal: [0.0, 0.0, 1.0], ..Symmetry::default() });
        hash_of_equal_bits(&model, &[1, 2, 3], element);
    });
}

#[test]
fn a_slice_whose_faces_are_held_does_what_the_plane_does() {
    let rectangle = Shape::Rectangle(Rectangle { corner: [0.0; 2], size: [1.0, 0.4], elements: [6, 3], ..Rectangle::default() });
    for law in ["j2", "neo_hookean"] {
        let mut plane = model("quad4", law, rectangle.clone(), 0.6);
        plane.constraints.push(Constraint {
            on: "body.left".into(),
            velocity: [Some(0.0.into()), Some(0.0.into()), None],
            ..Constraint::default()
        });
        plane.parts[0].velocity = [0.4, -1.2, 0.0];
        let mut space = plane.clone();
        space.parts[0].sweep = Some(Sweep::Extrude(Extrude { from: -0.2, length: 0.5, elements: 2, ..Extrude::default() }));
        for z in [-0.2, 0.3] {
            space.symmetries.push(Symmetry { point: [0.0, 0.0, z], normal: [0.0, 0.0, 1.0], ..Symmetry::default() });
        }
        // The step of both is the same.
        for model in [&mut plane, &mut space] {
            model.run.time_step = Some(0.0015);
        }
        let (plane, space) = (to_end(&plane), to_end(&space));
        assert_eq!(plane.steps(), space.steps());
        let (flat, solid) = (plane.frame(), space.frame());
        let mut apart = 0.0f64;
        for x in solid.positions::<3>() {
            let nearest = flat.positions::<2>().iter().map(|y| (x[0] - y[0]).hypot(x[1] - y[1])).fold(f64::INFINITY, f64::min);
            apart = apart.max(nearest);
        }
        assert!(apart < 1e-11, "{law}: {apart}");
        let energy = |simulation: &Simulation| value(simulation, "energy.internal");
        assert!((energy(&space) / (0.5 * energy(&plane)) - 1.0).abs() < 1e-9, "{law}");
    }
}

#[test]
fn a_wave_runs_along_a_held_bar_with_its_speed_and_stress() {
    for element in ["hex8", "hex8_reduced", "tet4"] {
        let mut model = model(element, "elastic", cuboid([10.0, 0.2, 0.2], [100, 2, 2]), 0.0);
        if element == "tet4" {
            cut(&mut model, 4);
        }
        let m = &model.materials["m"].parameters;
        let (e, nu, rho) = (m["young"], m["poisson"], m["density"]);
        let modulus = e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let speed = (modulus / rho).sqrt();
        model.run.end = 6.0 / speed;
        let slow = 1e-3;
        model.constraints.push(Constraint {
            on: "body".into(),
            velocity: [None, Some(0.0.into()), Some(0.0.into())],
            ..Constraint::default()
        });
        model.constraints.push(Constraint {
            on: if element == "tet4" { "left" } else { "body.left" }.into(),
            velocity: [Some(slow.into()), None, None],
            ..Constraint::default()
        });
        let simulation = to_end(&model);
        let frame = simulation.frame();
        let velocity = frame.fields.iter().find(|field| field.kind.name == "velocity").unwrap();
        let half: Vec<f64> =
            frame.positions::<3>().iter().zip(velocity.values.chunks(3)).filter(|(_, v)| v[0] > 0.5 * slow).map(|(x, _)| x[0]).collect();
        let front = half.iter().copied().fold(0.0, f64::max);
        assert!((front - 6.0).abs() < 0.15, "{element}: the front is at {front}");
        let stress = frame.fields.iter().find(|field| field.kind.name == "stress").unwrap();
        assert_eq!(stress.kind.components.len(), 6);
        let cells = simulation.cells();
        let behind: Vec<f64> = (0..cells.len())
            .filter(|&cell| {
                let x = cells.cell(cell).iter().map(|&node| frame.place(node as usize)[0]).sum::<f64>() / cells.cell(cell).len() as f64;
                (1.0..4.0).contains(&x)
            })
            .map(|cell| stress.values[6 * cell])
            .collect();
        let mean = behind.iter().sum::<f64>() / behind.len() as f64;
        assert!((mean / (-rho * speed * slow) - 1.0).abs() < 0.01, "{element}: {mean} for {}", -rho * speed * slow);
    }
}

#[test]
fn forces_pressures_and_gravity_accelerate_a_body_by_their_sum_over_its_mass() {
    let shape = cuboid([1.0, 0.5, 0.25], [2, 2, 2]);
    let mass = 2.0 * 0.125;
    let moved = |load: Load| {
        let mut model = model("hex8", "elastic", shape.clone(), 0.05);
        model.loads.push(load);
        model.probes.push(Probe { name: "P".into(), at: ProbeAt::Set { set: "body".into() }, ..Probe::default() });
        let simulation = to_end(&model);
        ["P.vx", "P.vy", "P.vz"].map(|column| value(&simulation, column) / 0.05)
    };
    let near = |found: [f64; 3], wanted: [f64; 3]| {
        assert!((0..3).all(|d| (found[d] - wanted[d]).abs() < 1e-10), "{found:?} for {wanted:?}");
    };
    near(moved(Load::Gravity { parts: vec![], acceleration: [1.0, -2.0, 3.0], curve: None }), [1.0, -2.0, 3.0]);
    near(moved(Load::Force { on: "body.right".into(), force: [0.5, 0.25, -1.0], curve: None }), [0.5 / mass, 0.25 / mass, -1.0 / mass]);
    let push = 1e-6;
    let [x, y, z] = moved(Load::Pressure { on: "body.top".into(), pressure: push, curve: None });
    assert!((y * mass / (-push * 0.25) - 1.0).abs() < 1e-6 && x.abs().max(z.abs()) < 1e-12, "{x} {y} {z}");
    near(moved(Load::Pressure { on: "body".into(), pressure: 5.0, curve: None }), [0.0; 3]);
}

#[test]
fn nodes_are_led_around_any_axis_on_exact_circles() {
    let mut model = model("hex8", "elastic", cuboid([1.0, 0.5, 0.25], [2, 1, 1]), 1.0);
    let about = Axis { centre: [0.2, -0.3, 0.1], direction: [1.0, 2.0, -0.5] };
    model.constraints.push(Constraint {
        on: "body".into(),
        rotation: Some(Rotation { about, speed: 3.0.into() }),
        ..Constraint::default()
    });
    let mut simulation = simulation(&model);
    let before = simulation.frame();
    simulation.advance(f64::INFINITY, u64::MAX).unwrap();
    let after = simulation.frame();
    let size = about.direction.iter().map(|a| a * a).sum::<f64>().sqrt();
    let axis = about.direction.map(|a| a / size);
    let (c, s) = (3.0f64.cos(), 3.0f64.sin());
    for (x, y) in before.positions::<3>().iter().zip(after.positions::<3>()) {
        let r: [f64; 3] = std::array::from_fn(|d| x[d] - about.centre[d]);
        let along = (0..3).map(|d| r[d] * axis[d]).sum::<f64>();
        let cross = [axis[1] * r[2] - axis[2] * r[1], axis[2] * r[0] - axis[0] * r[2], axis[0] * r[1] - axis[1] * r[0]];
        for d in 0..3 {
            let wanted = about.centre[d] + c * r[d] + s * cross[d] + (1.0 - c) * along * axis[d];
            assert!((y[d] - wanted).abs() < 1e-12, "{y:?}");
        }
    }
    assert!(value(&simulation, "energy.internal").abs() < 1e-12);
}

#[test]
fn a_rigid_body_without_moments_keeps_its_angular_momentum_and_energy_while_it_tumbles() {
    // It spins about no axis of its own.
    let mut model = model("hex8", "elastic", cuboid([1.0, 0.3, 0.2], [4, 2, 2]), 20.0);
    (model.parts[0].placement.rotation, model.parts[0].placement.rotation_axis) = (0.4, [1.0, 0.5, 0.0]);
    model.parts[0].rigid = Some(Motion::default());
    model.parts[0].spin = 3.0;
    model.parts[0].velocity = [0.1, 0.0, 0.2];
    let steps = every_step(&model);
    let kinetic = steps.column("energy.kinetic");
    assert!(kinetic.iter().all(|energy| (energy / kinetic[0] - 1.0).abs() < 1e-9), "{:?}", &kinetic[..3]);
    let simulation = to_end(&model);
    let summary = simulation.summary();
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-12, "{summary:?}");
}

#[test]
fn elements_that_fail_are_taken_out_and_the_books_stay_closed() {
    let mut model = model("hex8", "j2", cuboid([4.0, 1.0, 1.0], [8, 2, 2]), 0.0);
    let metal = model.materials.get_mut("m").unwrap();
    metal.failure = [("plastic_strain".to_string(), 0.15)].into();
    let yielding = metal.parameters["yield"] / metal.parameters["young"];
    model.run.end = 4.0;
    let pull = (0.3 + yielding) * 4.0 / 4.0;
    for (side, speed) in [("body.left", -pull), ("body.right", pull)] {
        model.constraints.push(Constraint {
            on: side.into(),
            velocity: [Some(speed.into()), Some(0.0.into()), Some(0.0.into())],
            ..Constraint::default()
        });
    }
    model.output.pictures = false;
    let simulation = to_end(&model);
    let summary = simulation.summary();
    let eroded = summary.erosion.expect("some elements fail");
    assert!(eroded.elements[0].1 >= 4, "{eroded:?}");
    assert!(summary.ledger_residual < 1e-11 && summary.energy_drift < 0.03, "{} {}", summary.ledger_residual, summary.energy_drift);
}

#[test]
fn a_kept_state_continues_to_the_same_bits() {
    every_element("j2", 0.6, |element, mut model| {
        (model.parts[0].velocity, model.parts[0].spin) = ([0.5, 0.2, -1.0], 4.0);
        model.symmetries.push(Symmetry { normal: [0.0, 0.0, 1.0], ..Symmetry::default() });
        let whole = to_end(&model).summary().state_hash;
        let mut first = simulation(&model);
        first.advance(0.25, u64::MAX).unwrap();
        continues_to(&whole, &model, &mut first, element);
    });
}

#[test]
fn spheres_and_cylinders_swing_with_the_mass_of_their_volume() {
    let whole = [
        (Shape::Sphere(Sphere { radius: 0.5, elements: 6, ..Sphere::default() }), std::f64::consts::PI / 6.0, 0.03),
        (
            Shape::Cylinder(Cylinder { radius: 0.5, length: 2.0, elements: [6, 8], ..Cylinder::default() }),
            std::f64::consts::FRAC_PI_2,
            0.02,
        ),
    ];
    for (shape, volume, tolerance) in whole {
        let model = model("hex8_reduced", "elastic", shape, 0.1);
        let simulation = simulation(&model);
        let mass = simulation.overview().parts[0].mass;
        assert!((mass / (2.0 * volume) - 1.0).abs() < tolerance, "{mass} for {}", 2.0 * volume);
    }
}

#[test]
fn what_points_out_of_2d_is_refused_in_2d() {
    let rectangle = Shape::Rectangle(Rectangle { corner: [0.0; 2], size: [1.0, 0.4], elements: [6, 3], ..Rectangle::default() });
    let paths = |change: &dyn Fn(&mut Model)| {
        let mut model = model("quad4", "elastic", rectangle.clone(), 1.0);
        change(&mut model);
        model.check().into_iter().map(|fault| fault.path).collect::<Vec<_>>()
    };
    assert_eq!(paths(&|_| {}), Vec::<String>::new());
    assert_eq!(paths(&|model| model.parts[0].velocity[2] = 1.0), ["part[0].velocity[2]"]);
    let gravity = Load::Gravity { parts: vec![], acceleration: [0.0, 0.0, 9.81], curve: None };
    assert_eq!(paths(&|model| model.loads.push(gravity.clone())), ["load[0].gravity[2]"]);
    for (speed, path) in [(0.0, "constraint[0].fixed"), (1.0, "constraint[0].velocity.z")] {
        let held = Constraint { on: "body.left".into(), velocity: [None, None, Some(Drive::Constant(speed))], ..Constraint::default() };
        assert_eq!(paths(&|model| model.constraints.push(held.clone())), [path]);
    }
}

#[test]
fn stress_at_the_start_is_there_in_3d() {
    let mut model = model("hex8", "elastic", cuboid([1.0; 3], [2; 3]), 1e-3);
    model.parts[0].stress_initial = Some(InitialStress::uniform([1.0, -2.0, 0.5, 0.25]));
    let simulation = simulation(&model);
    let frame = simulation.frame();
    let stress = frame.fields.iter().find(|field| field.kind.name == "stress").unwrap();
    assert!(stress.values.chunks(6).all(|own| own == [1.0, -2.0, 0.5, 0.25, 0.0, 0.0]));
}
