//! Obstacles of triangles against the obstacles whose surfaces they are, over edges and corners, with
//! friction, moved and free, at the start, kept and resumed.

use crate::bodies::{continues_to, faults, hash_of_equal_bits, model, simulation, to_end, value};
use crate::initial::count_inside;
use embate_solver::model::{
    Cuboid, Friction, InitialPenetration, Interface, Model, Motion, Obstacle, ObstacleShape, Part, Placement, Shape, Sphere, Symmetry,
    TriangleSurface,
};
use embate_solver::simulation::Simulation;
use std::sync::Arc;

type Vector = [f64; 3];

fn surface(triangles: &[[Vector; 3]]) -> TriangleSurface {
    TriangleSurface::welded("test.stl", triangles)
}

fn obstacle(name: &str, surface: TriangleSurface) -> Obstacle {
    Obstacle::fixed(name, ObstacleShape::Triangles(Arc::new(surface)))
}

/// A box, outward.
fn cube(low: Vector, high: Vector) -> TriangleSurface {
    let x = |k: usize| [0, 1, 2].map(|d| if k >> d & 1 == 0 { low[d] } else { high[d] });
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = sides.map(|[a, b, c, d]| [[x(a), x(b), x(c)], [x(a), x(c), x(d)]]);
    surface(halves.as_flattened())
}

/// A sphere: an octahedron whose triangles are cut in four so many times.
fn sphere(centre: Vector, radius: f64, cuts: usize) -> TriangleSurface {
    let onto = |x: Vector| {
        let size = x.iter().map(|c| c * c).sum::<f64>().sqrt();
        x.map(|c| c / size)
    };
    let mut triangles = Vec::new();
    for octant in 0..8 {
        let sign = |d: usize| if octant >> d & 1 == 0 { 1.0 } else { -1.0 };
        let [a, b, c] = [[sign(0), 0.0, 0.0], [0.0, sign(1), 0.0], [0.0, 0.0, sign(2)]];
        triangles.push(if sign(0) * sign(1) * sign(2) > 0.0 { [a, b, c] } else { [a, c, b] });
    }
    for _ in 0..cuts {
        let quarter = |&[a, b, c]: &[Vector; 3]| {
            let middle = |p: Vector, q: Vector| onto([0, 1, 2].map(|d| p[d] + q[d]));
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.iter().flat_map(quarter).collect();
    }
    triangles.iter_mut().flatten().for_each(|x| *x = [0, 1, 2].map(|d| centre[d] + radius * x[d]));
    surface(&triangles)
}

fn body(name: &str, shape: Shape, velocity: Vector) -> Part {
    Part { name: name.into(), material: "soft".into(), element: "hex8_reduced".into(), shape, velocity, ..Part::default() }
}

fn brick(corner: Vector, size: Vector, elements: [usize; 3]) -> Shape {
    Shape::Cuboid(Cuboid { corner, size, elements, ..Cuboid::default() })
}

fn friction(coefficient: f64) -> Friction {
    Friction { coefficient, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY }
}

/// A ball of radius 0.05 above z = 0.
fn ball(end: f64, velocity: Vector) -> Model {
    let mut model = model(end);
    let shape = Shape::Sphere(Sphere { centre: [0.003, 0.002, 0.0505], radius: 0.05, elements: 4, ..Sphere::default() });
    model.parts.push(body("ball", shape, velocity));
    model
}

fn with(mut model: Model, obstacle: Obstacle) -> Simulation {
    model.obstacles.push(obstacle);
    to_end(&model)
}

/// The largest difference of coordinates, m.
fn difference(a: &Simulation, b: &Simulation) -> f64 {
    let (a, b) = (a.frame().coordinates, b.frame().coordinates);
    assert_eq!(a.len(), b.len());
    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn a_ball_on_a_plate_of_triangles_does_what_it_does_on_a_plane() {
    for coefficient in [None, Some(friction(0.3))] {
        let interface = Interface { friction: coefficient, ..Interface::default() };
        let on = |shape: ObstacleShape| {
            let obstacle = Obstacle { interface: interface.clone(), ..Obstacle::fixed("floor", shape) };
            with(ball(2.5e-4, [2.0, 1.0, -10.0]), obstacle)
        };
        let plane = on(ObstacleShape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], length: None });
        let plate = on(ObstacleShape::Triangles(Arc::new(cube([-1.0, -1.2, -0.3], [1.1, 0.9, 0.0]))));
        let turned = Placement { rotation: 0.4, ..Placement::default() };
        let oblique = on(ObstacleShape::Triangles(Arc::new(cube([-1.0, -1.2, -0.3], [1.1, 0.9, 0.0]).placed(&turned))));
        assert!(plane.summary().penetration_max > 1e-5);
        for other in [plate, oblique] {
            let off = difference(&plane, &other);
            assert!(off < 1e-9 * 0.05, "{coefficient:?}: {off}");
            for column in ["obstacle.force_z[floor]", "obstacle.force_x[floor]", "obstacle.energy[floor]", "obstacle.friction_work[floor]"]
            {
                let (a, b) = (value(&plane, column), value(&other, column));
                assert!((a - b).abs() <= 1e-7 * a.abs().max(1e-9), "{column}: {a} {b}");
            }
            assert!(other.summary().ledger_residual < 1e-11);
        }
    }
}

#[test]
fn finer_and_finer_triangles_come_to_the_sphere() {
    let block = |obstacle: ObstacleShape| {
        let mut model = model(3e-4);
        model.parts.push(body("block", brick([-0.05, -0.04, 0.0], [0.1, 0.08, 0.04], [20, 16, 8]), [0.0, 0.0, -8.0]));
        with(model, Obstacle::fixed("ball", obstacle))
    };
    // The centre is beside the symmetry of the mesh. The last are finer than the block: then both press on
    // each other, half in each pass.
    let (centre, radius) = ([0.003, -0.002, -0.0402], 0.04);
    let exact = block(ObstacleShape::Sphere { centre, radius, hollow: false });
    let force = |simulation: &Simulation| value(simulation, "obstacle.force_z[ball]");
    let of = |cuts: usize| block(ObstacleShape::Triangles(Arc::new(sphere(centre, radius, cuts))));
    let all = [2, 3, 4].map(of);
    let off = all.each_ref().map(|it| difference(&exact, it));
    // It came down by 2.4 mm.
    assert!(off[1] < 0.5 * off[0] && off[2] < 0.5 * off[1] && off[2] < 1e-4, "{off:?}");
    assert!(force(&exact) > 1e4 && (force(&all[2]) / force(&exact) - 1.0).abs() < 0.005, "{} {}", force(&exact), force(&all[2]));
}

/// A cube of triangles of side `side` with a corner, an edge or a side up at the origin.
fn upward(side: f64, edges: usize) -> TriangleSurface {
    let cube = cube([-side, -side, -side], [0.0; 3]);
    let quarter = std::f64::consts::FRAC_PI_4;
    let edge = Placement { rotation: quarter, rotation_axis: [1.0, 0.0, 0.0], ..Placement::default() };
    let tilt = (1.0_f64 / 3.0).sqrt().asin();
    let corner = Placement { rotation: -tilt, rotation_axis: [0.0, 1.0, 0.0], ..Placement::default() };
    match edges {
        1 => cube.placed(&Placement { translation: [0.5 * side, 0.0, 0.0], ..edge }),
        _ => cube.placed(&edge).placed(&corner),
    }
}

#[test]
fn edges_and_corners_hold_a_coarse_block_and_give_its_energy_back() {
    // The corner comes up between the nodes of a side; the ridge meets the edges of a block, and the edge of
    // one that stands on it.
    let flat = brick([-0.047, -0.043, 2e-4], [0.1, 0.09, 0.05], [1, 1, 1]);
    let upright = brick([0.0, -0.053, 0.0], [0.04, 0.1, 0.04], [1, 1, 1]);
    let cases: [(&str, TriangleSurface, Shape, f64); 3] = [
        ("corner", upward(0.3, 3), flat.clone(), 0.0),
        ("ridge", upward(0.3, 1), flat, 0.0),
        ("edges", upward(0.3, 1), upright, -std::f64::consts::FRAC_PI_4),
    ];
    for (what, surface, shape, roll) in cases {
        let mut model = model(6e-4);
        let velocity = [0.0, 0.0, -3.0];
        let lift = if roll == 0.0 { [0.0; 3] } else { [0.0, 0.0, 2e-4] };
        let placement = Placement { rotation: roll, rotation_axis: [0.0, 1.0, 0.0], translation: lift, ..Placement::default() };
        model.parts.push(Part { placement, ..body("block", shape, velocity) });
        let top = surface.positions.iter().map(|x| x[2]).fold(f64::NEG_INFINITY, f64::max);
        assert!(top.abs() < 1e-12, "{what}: {top}");
        let simulation = with(model, obstacle("die", surface));
        let summary = simulation.summary();
        assert!(summary.penetration_max > 1e-6 && summary.penetration_max < 2e-3, "{what}: {summary:?}");
        assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-11, "{what}: {summary:?}");
        let lowest = simulation.frame().coordinates.chunks(3).map(|x| x[2]).fold(f64::INFINITY, f64::min);
        assert!(lowest > -0.05, "{what}: {lowest}");
    }
}

#[test]
fn a_free_obstacle_of_triangles_takes_what_the_body_loses() {
    let mut model = ball(4e-4, [3.0, 0.5, -10.0]);
    let interface = Interface { friction: Some(friction(0.4)), ..Interface::default() };
    let cube = cube([-0.1, -0.1, -0.2], [0.03, 0.04, 0.0]);
    model.obstacles.push(Obstacle {
        motion: Motion::default(),
        mass: Some(2.0),
        inertia: Some(0.01),
        velocity: [0.0, 0.0, 5.0],
        interface,
        ..obstacle("anvil", cube)
    });
    let simulation = to_end(&model);
    let summary = simulation.summary();
    assert!(summary.penetration_max > 1e-5, "{summary:?}");
    assert!(summary.momentum_drift_linear.unwrap() < 1e-12 && summary.momentum_drift_angular.unwrap() < 1e-11, "{summary:?}");
    assert!(summary.energy_drift < 0.01 && summary.ledger_residual < 1e-11, "{summary:?}");
    assert!(value(&simulation, "obstacle.spin_y[anvil]").abs() > 1e-3);
}

/// A die that comes down, turning, on a block that lies on a floor.
fn die(end: f64) -> Model {
    let mut model = model(end);
    model.parts.push(body("block", brick([-0.05, -0.04, 0.0], [0.1, 0.08, 0.04], [6, 5, 3]), [0.0; 3]));
    model.symmetries.push(Symmetry { normal: [0.0, 0.0, 1.0], ..Symmetry::default() });
    let interface = Interface { friction: Some(friction(0.2)), ..Interface::default() };
    let motion = Motion { velocity: [Some(1.0.into()), Some(0.0.into()), Some((-10.0).into())], spin: Some(30.0.into()) };
    let surface = sphere([0.004, 0.003, 0.0602], 0.02, 3);
    model.obstacles.push(Obstacle { motion, interface, ..obstacle("die", surface) });
    model
}

#[test]
fn a_moved_die_has_equal_bits_on_threads_and_instruction_sets_and_continues_from_a_kept_state() {
    let model = die(2e-4);
    let whole = to_end(&model);
    assert!(value(&whole, "obstacle.force_z[die]") < -1.0 || value(&whole, "obstacle.force_z[die]") > 1.0);
    assert!(value(&whole, "obstacle.friction_work[die]") > 0.0);
    let hash = hash_of_equal_bits(&model, &[1, 3], "die");
    assert_eq!(whole.summary().state_hash, hash);
    for stop in [0.3e-4, 1.1e-4] {
        let mut first = simulation(&model);
        first.advance(stop, u64::MAX).unwrap();
        continues_to(&hash, &model, &mut first, "die");
    }
}

#[test]
fn what_is_inside_of_triangles_at_the_start_is_reported() {
    let at = |z: f64, obstacle: Obstacle| {
        let mut model = model(1e-5);
        model.parts.push(body("block", brick([-0.05, -0.04, z], [0.1, 0.08, 0.04], [4, 3, 2]), [0.0; 3]));
        model.obstacles.push(obstacle);
        model
    };
    let ground = || obstacle("ground", cube([-1.0; 3], [1.0, 1.0, 0.0]));
    assert_eq!(faults(&at(0.0, ground())), Vec::<String>::new());
    let reported = faults(&at(-0.001, ground()));
    assert_eq!((reported.len(), count_inside(&reported[0])), (1, 20), "{reported:?}");
    assert!(reported[0].contains("20 nodes are up to 1.000e-3 m inside at the start"), "{reported:?}");
    // A point between nodes.
    let reported = faults(&at(-0.001, obstacle("tip", upward(0.3, 3))));
    assert!(reported.len() == 1 && reported[0].contains("inside at the start"), "{reported:?}");
    // Altogether inside, far from the surface, and outside of a hollow one.
    let reported = faults(&at(-0.5, ground()));
    assert!(reported.len() == 1 && reported[0].contains("m inside at the start"), "{reported:?}");
    let hollow = |z: f64| faults(&at(z, obstacle("vessel", cube([-1.0; 3], [1.0, 1.0, 0.0]).turned_over())));
    assert_eq!((hollow(-0.5).len(), hollow(0.2).len()), (0, 1));
    // Within the thickness.
    let thick = Obstacle { interface: Interface { thickness: 0.002, ..Interface::default() }, ..ground() };
    assert!(faults(&at(0.001, thick))[0].contains("up to 1.000e-3 m inside"));
    let ignored = Obstacle { interface: Interface { initial_penetration: InitialPenetration::Ignore, ..Interface::default() }, ..ground() };
    let simulation = to_end(&at(-0.001, ignored));
    assert_eq!(simulation.overview().initial_penetrations.iter().map(|line| count_inside(line)).collect::<Vec<_>>(), [20]);
    assert!(value(&simulation, "obstacle.force_z[ground]").abs() < 1e-9);
}

#[test]
fn what_is_inside_of_triangles_is_pushed_out_of_them_without_stress() {
    let pushed = |mut obstacle: Obstacle, thickness: f64| {
        obstacle.interface = Interface { initial_penetration: InitialPenetration::PushOut, thickness, ..Interface::default() };
        obstacle
    };
    let at = |z: f64, obstacle: Obstacle| {
        let mut model = model(1e-4);
        model.parts.push(body("block", brick([-0.05, -0.04, z], [0.1, 0.08, 0.04], [4, 3, 2]), [0.0; 3]));
        model.obstacles.push(obstacle);
        model
    };
    let ground = || obstacle("ground", cube([-1.0; 3], [1.0, 1.0, 0.0]));
    for thickness in [0.0, 0.0005] {
        let model = at(-0.001, pushed(ground(), thickness));
        let begin = simulation(&model);
        assert!(begin.overview().initial_penetrations.iter().any(|line| line.contains("it was pushed out")));
        // The 20 nodes of the lower side are on the surface, all others where they were.
        let positions = begin.frame().positions::<3>().to_vec();
        let lower = positions.iter().filter(|x| (x[2] - thickness).abs() < 1e-9).count();
        let others = positions.iter().filter(|x| (x[2] - 0.019).abs() < 1e-15 || (x[2] - 0.039).abs() < 1e-15).count();
        assert_eq!((lower, others), (20, 40), "{positions:?}");
        let end = to_end(&model);
        assert!(end.summary().penetration_max < 1e-9 && value(&end, "energy.kinetic") < 1e-12 && value(&end, "energy.contact") < 1e-12);
        assert!(end.summary().ledger_residual < 1e-12);
    }
    // A point that comes in between nodes moves the four corners of the facet that it is behind.
    let model = at(-0.001, pushed(obstacle("tip", upward(0.3, 3)), 0.0));
    let begin = simulation(&model);
    let moved = begin.frame().positions::<3>().iter().filter(|x| x[2] < 0.01 && (x[2] + 0.001).abs() > 1e-9).count();
    assert!((1..=4).contains(&moved), "{moved}");
    assert!(value(&to_end(&model), "energy.kinetic") < 1e-12);
    // What is altogether inside stays there, and is reported.
    let reported = faults(&at(-0.5, pushed(ground(), 0.0)));
    assert!(!reported.is_empty() && reported.iter().all(|fault| fault.contains("can't be pushed out")), "{reported:?}");
}

#[test]
fn triangles_are_not_for_the_plane() {
    let mut model = model(1e-5);
    model.parts.push(Part { name: "strip".into(), material: "soft".into(), shape: crate::bodies::mapped_rectangle(), ..Part::default() });
    model.obstacles.push(obstacle("die", cube([-1.0; 3], [1.0, 1.0, -0.1])));
    let reported = faults(&model);
    assert!(reported.len() == 1 && reported[0].contains("obstacle[0].stl") && reported[0].contains("take `polyline`"), "{reported:?}");
}
