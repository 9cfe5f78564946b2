//! Frames of beams with a closed potential, on the nodes of bars that have next to no stiffness: what a node
//! with rotations must do, whatever the elements are that use it.

use super::*;
use crate::archive::{Archive, ArchiveResult};
use crate::block::{ElementState, Initial, Motion, NodalForces, Report, Wrong};
use crate::build;
use crate::failure::Criterion;
use crate::material::points::PointLaw;
use crate::model::{ImportedMesh, Join, Load, Material, MeshGroup, Model, Motion as Rigid, Part, Shape, SpaceTruss, Symmetry, Truss};
use crate::record::{Momentum, state_hash};
use crate::simulation::Runs;
use crate::vector::minus;
use embate_lanes::{Level, Team};
use std::sync::Arc;

const STEP: f64 = 1e-3;
const INERTIA: f64 = 0.02;

/// Beams between pairs of nodes.
struct Frame<const D: usize> {
    links: Vec<[u32; 2]>,
    /// Vector from the first node to the second at the start.
    vectors: Vec<[f64; D]>,
    nodes: Vec<u32>,
    report: Report,
}

impl<const D: usize> Frame<D> {
    fn new(positions: &[[f64; D]], lines: &[[[f64; D]; 2]]) -> Self {
        let find = |x: [f64; D]| positions.iter().position(|y| dot(minus(x, *y), minus(x, *y)) < 1e-18).unwrap() as u32;
        let links: Vec<[u32; 2]> = lines.iter().map(|line| line.map(find)).collect();
        let vectors = lines.iter().map(|[a, b]| minus(*b, *a)).collect();
        Self { nodes: links.iter().flatten().copied().collect(), links, vectors, report: Report::NOTHING }
    }
}

/// Energy of a beam, the force on its second node, and the moments on both.
type Answer<const D: usize> = (f64, [f64; D], [[f64; 3]; 2]);

/// A stretch l of the mean direction, a slide s across it, and a bend δ: W = ½ (a (l − L)² + c s² + b δ²)
/// with l = t·Δx, s = n·Δx, t and n those of the mean angle from the start.
fn beam_of_2d(start: [f64; 2], vector: [f64; 2], [one, two]: [f64; 2]) -> Answer<2> {
    let (a, b, c) = (40.0, 3.0, 15.0);
    let length = dot(start, start).sqrt();
    let first = start.map(|x| x / length);
    let (mean, bend) = (0.5 * (one + two), two - one);
    let (sin, cos) = mean.sin_cos();
    let t = [cos * first[0] - sin * first[1], sin * first[0] + cos * first[1]];
    let n = [-t[1], t[0]];
    let (l, s) = (dot(t, vector), dot(n, vector));
    let (axial, shear, moment) = (a * (l - length), c * s, b * bend);
    let force = [0, 1].map(|d| -(axial * t[d] + shear * n[d]));
    let common = -0.5 * (axial * s - shear * l);
    let energy = 0.5 * (a * (l - length).powi(2) + c * s * s + b * bend * bend);
    (energy, force, [[0.0, 0.0, common + moment], [0.0, 0.0, common - moment]])
}

/// W = ¼ a Σ ((Δx·d − c)² of both nodes) + ½ b Σ |d_one − d_two|² with the axes d of each node: scalar
/// products alone.
fn beam_of_3d(start: [f64; 3], vector: [f64; 3], attitudes: [crate::rigid::space::Attitude; 2]) -> Answer<3> {
    let (a, b) = (30.0, 1.5);
    let (mut energy, mut pull, mut moments) = (0.0, [0.0; 3], [[0.0; 3]; 2]);
    for (k, axis) in unit_matrix::<3>().into_iter().enumerate() {
        let d = attitudes.map(|attitude| attitude.turned(axis));
        for one in 0..2 {
            let gap = dot(vector, d[one]) - start[k];
            energy += 0.25 * a * gap * gap;
            pull = plus(pull, times(0.5 * a * gap, d[one]));
            let g = plus(times(-0.5 * a * gap, vector), times(b, minus(d[1 - one], d[one])));
            moments[one] = plus(moments[one], cross(d[one], g));
        }
        energy += 0.5 * b * dot(minus(d[0], d[1]), minus(d[0], d[1]));
    }
    (energy, times(-1.0, pull), moments)
}

/// Beams of a dimension.
trait Beam<const D: usize>: Runs<D> {
    fn beam(start: [f64; D], vector: [f64; D], rotations: &Rotations, places: [usize; 2]) -> Answer<D>;
}

impl Beam<2> for Dim<2> {
    fn beam(start: [f64; 2], vector: [f64; 2], rotations: &Rotations, places: [usize; 2]) -> Answer<2> {
        beam_of_2d(start, vector, places.map(|place| rotations.angles[place]))
    }
}

impl Beam<3> for Dim<3> {
    fn beam(start: [f64; 3], vector: [f64; 3], rotations: &Rotations, places: [usize; 2]) -> Answer<3> {
        beam_of_3d(start, vector, places.map(|place| rotations.attitudes[place]))
    }
}

impl<const D: usize> Block<D> for Frame<D>
where
    Dim<D>: Beam<D>,
{
    fn elements(&self) -> usize {
        self.links.len()
    }
    fn slots(&self) -> &[u32] {
        &self.nodes
    }
    fn moment_slots(&self) -> &[u32] {
        &self.nodes
    }
    fn rotating_nodes(&self) -> Vec<(u32, f64)> {
        self.nodes.iter().map(|&node| (node, 0.5 * INERTIA)).collect()
    }
    fn advance(&mut self, motion: &Motion<'_, D>, _: Level, pulls: NodalForces<'_, D>, _: &mut Team) -> Report {
        self.report = Report::NOTHING;
        for (k, link) in self.links.iter().enumerate() {
            let [a, b] = link.map(|node| motion.positions[node as usize]);
            let places = link.map(|node| motion.rotations.place(node).unwrap());
            let (energy, force, moments) = <Dim<D>>::beam(self.vectors[k], minus(b, a), motion.rotations, places);
            self.report.stored += energy;
            (pulls.forces[2 * k], pulls.forces[2 * k + 1]) = (times(-1.0, force), force);
            pulls.moments[2 * k..2 * k + 2].copy_from_slice(&moments);
        }
        self.report
    }
    fn force(&self, element: usize, corner: usize, slots: &[[f64; D]]) -> [f64; D] {
        slots[2 * element + corner]
    }
    fn mass(&self, _: usize) -> f64 {
        0.0
    }
    fn corner_mass(&self, _: usize, _: usize) -> f64 {
        0.0
    }
    fn time_step_squared(&self, _: usize) -> f64 {
        f64::INFINITY
    }
    fn bound_stiffness(&self, _: f64, _: &mut dyn FnMut(u32, f64, f64)) {}
    fn mark_time_steps(&mut self) {}
    fn state(&self, _: usize) -> ElementState {
        ElementState::default()
    }
    fn law(&self) -> Option<&dyn PointLaw> {
        None
    }
    fn scale_mass(&mut self, _: usize, _: f64) {}
    fn begin(&mut self, _: &Initial<'_>, _: &[[f64; D]]) -> Result<(), Wrong> {
        Ok(())
    }
    fn is_alive(&self, _: usize) -> bool {
        true
    }
    fn failed(&self, _: &[Criterion], _: bool) -> Vec<(u32, u32)> {
        Vec::new()
    }
    fn determinant(&self, _: usize, _: &[[f64; D]]) -> f64 {
        f64::INFINITY
    }
    fn erode(&mut self, _: &[u32], _: NodalForces<'_, D>) -> Vec<f64> {
        Vec::new()
    }
    fn report(&self, _: &[[f64; D]]) -> Report {
        self.report
    }
    fn persist(&mut self, _: &mut Archive<'_>) -> ArchiveResult {
        Ok(())
    }
}

/// Bars of a density that gives unit masses to a frame, of next to no stiffness.
fn bars(name: &str, shape: impl Into<Shape>) -> Part {
    Part { name: name.into(), material: "feather".into(), element: "bar2".into(), area: Some(1.0), shape: shape.into(), ..Part::default() }
}

fn model(parts: Vec<Part>) -> Model {
    let parameters = [("young", 1e-9), ("poisson", 0.3), ("density", 1.0)];
    let feather = Material {
        law: "elastic".into(),
        parameters: parameters.map(|(key, value)| (key.to_string(), value)).into(),
        ..Material::default()
    };
    let mut model = Model { parts, ..Model::default() };
    model.materials.insert("feather".into(), feather);
    (model.run.end, model.run.time_step, model.run.energy_limit) = (1e3, Some(STEP), 0.5);
    model
}

/// The system of a model with a frame along `lines`, ready to start.
fn framed<const D: usize>(model: &Model, lines: &[[[f64; D]; 2]]) -> System<D>
where
    Dim<D>: Beam<D>,
{
    let (mut system, _) = build::system::<D>(model, None, Level::best(), 1).unwrap();
    system.blocks.push(Box::new(Frame::new(&system.mesh.positions, lines)));
    system.rigid.push(false);
    system.reports.push(Report::NOTHING);
    system.assembly = Assembly::new(system.positions.len(), &system.blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
    system.slots = vec![[0.0; D]; system.assembly.count];
    let spin = model.parts.iter().map(|part| part.spin).fold(0.0, f64::max);
    system.find_rotations(|_| [0.0, 0.0, spin]);
    system
}

/// Pieces of a polygon.
fn pieces<const D: usize>(points: &[[f64; D]]) -> Vec<[[f64; D]; 2]> {
    points.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

fn node<const D: usize>(system: &System<D>, at: [f64; D]) -> usize
where
    Dim<D>: Dimension<D>,
{
    system.mesh.positions.iter().position(|x| dot(minus(*x, at), minus(*x, at)) < 1e-18).unwrap()
}

const BENT: [[f64; 2]; 5] = [[0.0, 0.0], [1.0, 0.1], [1.9, 0.6], [2.2, 1.6], [2.0, 2.5]];
const BENT_3D: [[f64; 3]; 5] = [[0.0, 0.0, 0.2], [1.0, 0.1, 0.0], [1.9, 0.6, 0.5], [2.2, 1.6, 0.9], [2.0, 2.5, 0.3]];

/// Linear momentum, angular momentum, residual of the ledger and drift of the energy after some steps.
fn conserved<const D: usize>(system: &mut System<D>, steps: usize) -> [f64; 4]
where
    Dim<D>: Beam<D>,
{
    system.start().unwrap();
    let mut momentum = Momentum::new(system).expect("nothing acts from outside");
    for _ in 0..steps {
        system.step().unwrap();
        momentum.note(system);
    }
    [momentum.linear(), momentum.angular().unwrap(), system.ledger.residual(), system.ledger.drift()]
}

#[test]
fn a_frame_that_flies_and_spins_keeps_both_momenta_and_its_energy_in_2d() {
    let truss = Truss { lines: vec![BENT.to_vec()], elements: 1 };
    let mut part = bars("frame", truss);
    (part.velocity, part.spin) = ([0.4, -0.2, 0.0], 1.5);
    let mut system = framed::<2>(&model(vec![part]), &pieces(&BENT));
    // Struck at one end, so that it bends.
    let end = node(&system, BENT[4]);
    system.velocities[end] = [0.9, 1.1];
    system.rotations.now.spins[0] = [0.0, 0.0, -4.0];
    let [linear, angular, residual, drift] = conserved(&mut system, 20_000);
    assert!(linear < 1e-12 && angular < 1e-12 && residual < 1e-12, "{linear:e} {angular:e} {residual:e}");
    assert!(drift < 2e-5, "{drift:e}");
    // It has turned almost three times around.
    assert!(system.rotations.now.angles.iter().all(|angle| angle.abs() > 5.5 * std::f64::consts::PI), "{:?}", system.rotations.now.angles);
}

#[test]
fn a_frame_that_flies_and_spins_keeps_both_momenta_and_its_energy_in_3d() {
    let truss = SpaceTruss { lines: vec![BENT_3D.to_vec()], elements: 1 };
    let mut part = bars("frame", truss);
    (part.velocity, part.spin) = ([0.4, -0.2, 0.1], 1.5);
    let mut system = framed::<3>(&model(vec![part]), &pieces(&BENT_3D));
    let end = node(&system, BENT_3D[4]);
    system.velocities[end] = [0.9, 1.1, -0.7];
    system.rotations.now.spins[0] = [2.0, -1.0, -4.0];
    let [linear, angular, residual, drift] = conserved(&mut system, 20_000);
    assert!(linear < 1e-12 && angular < 1e-11 && residual < 1e-12, "{linear:e} {angular:e} {residual:e}");
    assert!(drift < 1e-4, "{drift:e}");
}

#[test]
fn two_nodes_that_only_rotate_vibrate_as_central_differences_do() {
    // W = ½ b δ²: ω² = 2 b / I, and sin(θ/2) = ω dt/2 for the angle θ of a step.
    let line = [[0.0, 0.0], [1.0, 0.0]];
    let mut system = framed::<2>(&model(vec![bars("beam", Truss { lines: vec![line.to_vec()], elements: 1 })]), &pieces(&line));
    let amplitude = 0.05;
    let [one, two] = line.map(|x| system.rotations.now.place(node(&system, x) as u32).unwrap());
    (system.rotations.now.angles[one], system.rotations.now.angles[two]) = (-amplitude, amplitude);
    system.start().unwrap();
    let inertia = 0.5 * INERTIA;
    let theta = 2.0 * (0.5 * STEP * (2.0 * 3.0 / inertia).sqrt()).asin();
    for step in 1..=2000 {
        system.step().unwrap();
        let wanted = amplitude * (f64::from(step) * theta).cos();
        let found = [one, two].map(|place| system.rotations.now.angles[place]);
        assert!((found[1] - wanted).abs() < 1e-11 && (found[0] + wanted).abs() < 1e-11, "{step}: {found:?} {wanted}");
    }
    assert!(system.positions.iter().zip(&system.mesh.positions).all(|(x, y)| dot(minus(*x, *y), minus(*x, *y)) < 1e-24));
}

#[test]
fn a_free_spin_turns_a_node_about_its_axis_for_good() {
    // No link between the two: nothing pulls.
    let line = [[0.0; 3], [1.0, 0.0, 0.0]];
    let mut system = framed::<3>(&model(vec![bars("beam", SpaceTruss { lines: vec![line.to_vec()], elements: 1 })]), &[]);
    let mut alone = Frame::new(&system.mesh.positions, &pieces(&line));
    alone.links.clear();
    system.blocks.pop();
    system.blocks.push(Box::new(alone));
    system.find_rotations(|_| [0.0; 3]);
    system.slots = vec![[0.0; 3]; system.slots.len() + 2];
    system.assembly = Assembly::new(2, &system.blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
    let spin = [3.0, -2.0, 6.0];
    system.rotations.now.spins = vec![spin; 2];
    system.start().unwrap();
    (0..5000).for_each(|_| system.step().unwrap());
    let angle = 5000.0 * STEP * 7.0;
    let axis = spin.map(|x| x / 7.0);
    let wanted = <Dim<3> as crate::rotation::Rotate<3>>::rotation(axis, angle);
    for (k, direction) in unit_matrix::<3>().into_iter().enumerate() {
        let found = system.rotations.now.attitudes[0].turned(direction);
        assert!((0..3).all(|d| (found[d] - wanted[d][k]).abs() < 1e-11), "{found:?}");
    }
    assert_eq!(system.rotations.now.spins[1], spin);
}

/// A square or a cube as a rigid part, and bars from one of its corners.
fn rigid_with_frame(dimension: usize) -> Model {
    let lift = |[x, y]: [f64; 2], z: f64| [x, y, z];
    let square = [[-1.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-1.0, 0.0]];
    let mut positions: Vec<[f64; 3]> = square.iter().map(|&x| lift(x, 0.0)).collect();
    let corner = 2_u32;
    let (block, first) = if dimension == 3 {
        positions.extend(square.iter().map(|&x| lift(x, 1.0)));
        ((0..8).collect::<Vec<u32>>(), 8)
    } else {
        ((0..4).collect(), 4)
    };
    let points: Vec<[f64; 3]> = if dimension == 3 { BENT_3D.to_vec() } else { BENT.map(|x| lift(x, 0.0)).to_vec() };
    positions.extend(points[1..].iter().copied());
    let line = std::iter::once(corner).chain(first..first + points.len() as u32 - 1).collect::<Vec<_>>();
    let groups = vec![
        MeshGroup { name: "die".into(), dimension: dimension as u8, cells: vec![block] },
        MeshGroup { name: "frame".into(), dimension: 1, cells: line.windows(2).map(<[u32]>::to_vec).collect() },
    ];
    let group = |name: &str| Shape::Group { mesh: 0, group: name.into() };
    let mut die = Part { name: "die".into(), material: "feather".into(), shape: group("die"), ..Part::default() };
    die.element = if dimension == 3 { "hex8".into() } else { "quad4".into() };
    die.rigid = Some(Rigid::default());
    (die.spin, die.velocity) = (0.8, [0.1, 0.3, 0.0]);
    let mut model = model(vec![die, bars("frame", group("frame"))]);
    model.meshes = vec![Arc::new(ImportedMesh { source: "test".into(), positions, groups, ..ImportedMesh::default() })];
    model
}

#[test]
fn a_rigid_part_takes_the_moments_of_a_frame_that_is_built_into_it() {
    let mut system = framed::<2>(&rigid_with_frame(2), &pieces(&BENT));
    let [linear, angular, residual, drift] = conserved(&mut system, 10_000);
    assert!(linear < 1e-12 && angular < 1e-12 && residual < 1e-12 && drift < 1e-4, "{linear:e} {angular:e} {residual:e} {drift:e}");
    let root = system.rotations.now.place(node(&system, BENT[0]) as u32).unwrap();
    assert_eq!(system.rotations.now.angles[root], system.bodies.state(0).angle);
    assert!(system.bodies.state(0).angle.abs() > 0.1, "{}", system.bodies.state(0).angle);

    let mut points = BENT_3D;
    points[0] = [0.0; 3];
    let mut system = framed::<3>(&rigid_with_frame(3), &pieces(&points));
    let [linear, angular, residual, drift] = conserved(&mut system, 10_000);
    assert!(linear < 1e-12 && angular < 1e-10 && residual < 1e-11 && drift < 1e-4, "{linear:e} {angular:e} {residual:e} {drift:e}");
}

#[test]
fn half_a_frame_with_a_symmetry_does_what_the_whole_does() {
    let half = [[0.0, 0.0], [0.7, 0.1], [1.5, 0.0], [2.2, 0.4]];
    let whole: Vec<[f64; 2]> = half.iter().rev().map(|&[x, y]| [-x, y]).chain(half[1..].iter().copied()).collect();
    let push = |system: &mut System<2>, at: [f64; 2], velocity: [f64; 2]| {
        let end = node(system, at);
        system.velocities[end] = velocity;
    };
    let mut all = framed::<2>(&model(vec![bars("frame", Truss { lines: vec![whole.clone()], elements: 1 })]), &pieces(&whole));
    push(&mut all, half[3], [0.1, 0.8]);
    push(&mut all, [-half[3][0], half[3][1]], [-0.1, 0.8]);
    let mut symmetric = model(vec![bars("frame", Truss { lines: vec![half.to_vec()], elements: 1 })]);
    symmetric.symmetries = vec![Symmetry { normal: [1.0, 0.0, 0.0], ..Symmetry::default() }];
    let mut one = framed::<2>(&symmetric, &pieces(&half));
    push(&mut one, half[3], [0.1, 0.8]);
    // The half of a bar that is not there weighs nothing here, and its half of the inertia is missing: both
    // halves of the middle node yield alike, so neither is seen.
    for system in [&mut all, &mut one] {
        system.start().unwrap();
        (0..3000).for_each(|_| system.step().unwrap());
    }
    for x in half {
        let [a, b] =
            [&all, &one].map(|system| (system.positions[node(system, x)], system.rotations.now.place(node(system, x) as u32).unwrap()));
        let apart = minus(a.0, b.0);
        assert!(dot(apart, apart).sqrt() < 1e-10, "{x:?}: {apart:?}");
        assert!((all.rotations.now.angles[a.1] - one.rotations.now.angles[b.1]).abs() < 1e-10);
    }
    let tip = one.rotations.now.place(node(&one, half[3]) as u32).unwrap();
    assert!(one.rotations.now.angles[tip].abs() > 1e-2, "it has bent");
    assert!(one.ledger.residual() < 1e-12, "{:e}", one.ledger.residual());
}

#[test]
fn in_3d_a_symmetry_leaves_the_spin_about_its_normal_alone() {
    fn held<const D: usize>(normals: &[[f64; D]]) -> NodeConstraint<3> {
        let mut held = NodeConstraint::default();
        normals.iter().flat_map(|&normal| held_by(normal)).for_each(|direction| held.rest(direction, 0));
        held
    }
    let spin = held(&[[0.0, 0.6, 0.8]]).apply([1.0, 2.0, 3.0]);
    let along = 0.6 * 2.0 + 0.8 * 3.0;
    assert!((0..3).all(|d| (spin[d] - along * [0.0, 0.6, 0.8][d]).abs() < 1e-15), "{spin:?}");
    assert_eq!(held(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).apply([1.0, 2.0, 3.0]).map(|x| x.abs() < 1e-15), [true; 3]);
    assert_eq!(held(&[[0.0, 1.0]]).apply([0.0, 0.0, 3.0]), [0.0; 3]);
    assert!(held::<3>(&[]).is_empty());
}

#[test]
fn two_frames_that_are_joined_move_as_one() {
    let (first, second) = (&BENT[..3], &BENT[2..]);
    let mut whole = framed::<2>(&model(vec![bars("frame", Truss { lines: vec![BENT.to_vec()], elements: 1 })]), &pieces(&BENT));
    let [one, two] =
        [("one", first), ("two", second)].map(|(name, points)| bars(name, Truss { lines: vec![points.to_vec()], elements: 1 }));
    let mut model = model(vec![one, two]);
    model.joins = vec![Join { between: ["one.point2".into(), "two.point0".into()], ..Join::default() }];
    let mut halves = framed::<2>(&model, &pieces(first));
    // The second frame begins at the node of the second part.
    let offset = halves.mesh.parts[1].nodes.clone();
    let own: Vec<[f64; 2]> =
        halves.mesh.positions.iter().zip(0_u32..).map(|(&x, node)| if offset.contains(&node) { x } else { [1e9; 2] }).collect();
    halves.blocks.push(Box::new(Frame::new(&own, &pieces(second))));
    halves.rigid.push(false);
    halves.reports.push(Report::NOTHING);
    halves.assembly = Assembly::new(halves.positions.len(), &halves.blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
    halves.slots = vec![[0.0; 2]; halves.assembly.count];
    halves.find_rotations(|_| [0.0; 3]);
    for system in [&mut whole, &mut halves] {
        let end = node(system, BENT[4]);
        system.velocities[end] = [0.9, 1.1];
        let end = node(system, BENT[0]) as u32;
        let place = system.rotations.now.place(end).unwrap();
        system.rotations.now.spins[place] = [0.0, 0.0, 2.0];
        system.start().unwrap();
        (0..5000).for_each(|_| system.step().unwrap());
    }
    for x in BENT {
        let [a, b] = [&whole, &halves].map(|system| system.positions[node(system, x)]);
        assert!(dot(minus(a, b), minus(a, b)).sqrt() < 1e-9, "{x:?}: {a:?} {b:?}");
    }
    assert!(halves.ledger.residual() < 1e-12);
}

#[test]
fn a_state_that_is_kept_and_filled_in_continues_with_the_same_bits() {
    let made = || {
        let mut part = bars("frame", SpaceTruss { lines: vec![BENT_3D.to_vec()], elements: 1 });
        part.spin = 1.5;
        let mut system = framed::<3>(&model(vec![part]), &pieces(&BENT_3D));
        system.rotations.now.spins[1] = [1.0, 0.5, -3.0];
        system.start().unwrap();
        system
    };
    let (mut first, mut second) = (made(), made());
    (0..300).for_each(|_| first.step().unwrap());
    let mut archive = Archive::new();
    first.persist(&mut archive).unwrap();
    let sections = archive.finish().unwrap();
    assert!(sections.iter().any(|section| section.name == "rotations"));
    let mut archive = Archive::of(&sections);
    second.persist(&mut archive).unwrap();
    archive.finish().unwrap();
    assert_eq!(first.rotations.now, second.rotations.now);
    (0..300).for_each(|_| [&mut first, &mut second].into_iter().for_each(|system| system.step().unwrap()));
    assert_eq!(state_hash(&first), state_hash(&second));
    // Rotations are part of what a state is.
    second.rotations.now.spins[0][1] += 1e-9;
    assert_ne!(state_hash(&first), state_hash(&second));
}

#[test]
fn damping_of_mass_slows_spins_as_it_slows_velocities() {
    let line = [[0.0, 0.0], [1.0, 0.0]];
    let mut damped = model(vec![bars("beam", Truss { lines: vec![line.to_vec()], elements: 1 })]);
    damped.loads = vec![Load::Damping { parts: Vec::new(), rate: 2.0, active: [0.0, f64::INFINITY] }];
    let mut system = framed::<2>(&damped, &pieces(&line));
    // All of it turns alike, and flies along: no part of the beam is strained where its spin is none.
    system.velocities = vec![[0.0, 1.0]; 2];
    system.rotations.now.spins = vec![[0.0; 3]; 2];
    system.start().unwrap();
    (0..500).for_each(|_| system.step().unwrap());
    let velocity = system.velocities[0][1];
    let mut turning = framed::<2>(&damped, &[]);
    let mut alone = Frame::new(&turning.mesh.positions, &pieces(&line));
    alone.links.clear();
    turning.blocks.pop();
    turning.blocks.push(Box::new(alone));
    turning.assembly = Assembly::new(2, &turning.blocks.iter().map(|block| block.slots()).collect::<Vec<_>>());
    turning.slots = vec![[0.0; 2]; turning.assembly.count];
    turning.find_rotations(|_| [0.0, 0.0, 1.0]);
    turning.start().unwrap();
    (0..500).for_each(|_| turning.step().unwrap());
    let spin = turning.rotations.now.spins[0][2];
    // (1 − a)/(1 + a) in each update, of which the first has half a step.
    let slowed = |step: f64| (1.0 - step) / (1.0 + step);
    let wanted = slowed(0.5 * STEP) * slowed(STEP).powi(500);
    assert!((velocity - wanted).abs() < 1e-13 && (spin - wanted).abs() < 1e-13, "{velocity} {spin} {wanted}");
    assert!(turning.ledger.residual() < 1e-12 && turning.ledger.drift() < 1e-6, "{:e}", turning.ledger.drift());
}

#[test]
fn a_model_without_such_elements_has_no_rotations() {
    let system = build::system::<2>(&model(vec![bars("frame", Truss { lines: vec![BENT.to_vec()], elements: 1 })]), None, Level::best(), 1)
        .unwrap()
        .0;
    assert!(system.rotations.now.is_empty() && system.rotations.slots.is_empty() && system.rotations.momenta().next().is_none());
}
