//! Tests of masses and velocities.

use super::{Kind, Made, Random, ring, turned};
use crate::plane::{Measure, Point, cross, dot, minus};
use crate::transfer::{Failure, NewNodes, Nodes, OldNodes, Supermesh, nodes};
use std::f64::consts::PI;

/// A mesh with masses and velocities.
#[derive(Clone)]
struct Body {
    made: Made,
    corner_mass: Vec<[f64; 4]>,
    mass: Vec<f64>,
    velocities: Vec<Point>,
}

impl Body {
    fn new(made: Made, measure: Measure, velocity: impl FnMut(&Point) -> Point) -> Self {
        let (corner_mass, mass) = made.masses(measure, |_| 7800.0);
        let velocities = made.positions.iter().map(velocity).collect();
        Self { made, corner_mass, mass, velocities }
    }

    fn try_to(&self, new: &Made, measure: Measure, held: &[[Option<f64>; 2]]) -> Result<Nodes, Failure> {
        self.try_with(new, measure, held, 0.0)
    }

    fn try_with(&self, new: &Made, measure: Measure, held: &[[Option<f64>; 2]], spare: f64) -> Result<Nodes, Failure> {
        let supermesh = Supermesh::new(self.made.mesh(), new.mesh(), measure)?;
        let old =
            OldNodes { mesh: self.made.mesh(), corner_mass: &self.corner_mass, node_mass: &self.mass, velocities: &self.velocities, spare };
        nodes(&supermesh, &old, &NewNodes { mesh: new.mesh(), held })
    }

    fn to(&self, new: &Made, measure: Measure) -> (Self, Nodes) {
        self.to_with(new, measure, 0.0)
    }

    fn to_with(&self, new: &Made, measure: Measure, spare: f64) -> (Self, Nodes) {
        let found = self.try_with(new, measure, &vec![[None; 2]; new.positions.len()], spare).unwrap();
        let (corner_mass, mass, velocities) = (found.corner_mass.clone(), found.mass.clone(), found.velocities.clone());
        (Self { made: new.clone(), corner_mass, mass, velocities }, found)
    }

    fn sum(&self, of: impl Fn(Point, Point) -> f64) -> f64 {
        self.mass.iter().enumerate().map(|(a, mass)| mass * of(self.made.positions[a], self.velocities[a])).sum()
    }

    fn kinetic(&self) -> f64 {
        self.sum(|_, v| 0.5 * dot(v, v))
    }

    /// Mass, moments, momentum, angular momentum, energy, each with the sum of absolute values to compare
    /// with.
    fn totals(&self) -> [[f64; 2]; 10] {
        let both = |of: &dyn Fn(Point, Point) -> f64| [self.sum(of), self.sum(|x, v| of(x, v).abs())];
        [
            both(&|_, _| 1.0),
            both(&|x, _| x[0]),
            both(&|x, _| x[1]),
            both(&|x, _| x[0] * x[0]),
            both(&|x, _| x[0] * x[1]),
            both(&|x, _| x[1] * x[1]),
            both(&|_, v| v[0]),
            both(&|_, v| v[1]),
            both(&|x, v| cross(x, v)),
            both(&|_, v| 0.5 * dot(v, v)),
        ]
    }

    /// Largest difference of totals by their sums of absolute values, of the first so many.
    fn differs(&self, from: &Self, count: usize) -> f64 {
        let (a, b) = (self.totals(), from.totals());
        (0..count).fold(0.0, |most: f64, k| most.max((a[k][0] - b[k][0]).abs() / b[k][1]))
    }
}

fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Root of the mean square, by mass, of the difference from a field.
fn error(body: &Body, field: impl Fn(Point) -> Point) -> f64 {
    let square = body.sum(|x, v| dot(minus(v, field(x)), minus(v, field(x))));
    (square / body.mass.iter().sum::<f64>()).sqrt()
}

fn smooth(x: Point) -> Point {
    [(PI * x[0]).sin() * (PI * x[1]).cos(), (2.0 * x[0]).cos() * (PI * x[1]).sin()]
}

#[test]
fn affine_velocities_keep_all_sums() {
    let mut random = Random::new(11);
    let affine = |x: &Point| [3.0 + 2.0 * x[0] - 5.0 * x[1], -1.0 + 4.0 * x[0] + 0.5 * x[1]];
    let mut worst = [0.0, 0.0, 0.0f64];
    for (kind, new_kind) in
        [(Kind::Quads, Kind::Quads), (Kind::Triangles, Kind::Quads), (Kind::Both, Kind::Both), (Kind::Quads, Kind::Triangles)]
    {
        for scale in [1.0, 1e-9, 1e9] {
            let to = |x: Point| turned(0.4)([scale * (x[0] + 0.2), scale * 0.7 * x[1]]);
            let old = Made::square(8, 8, 0.3, kind, &mut random);
            let new = Made::square(11, 9, 0.3, new_kind, &mut random).map(to);
            let field = |x: &Point| affine(&[x[0] / scale, x[1] / scale]);
            let mut body = Body::new(old.map(to), Measure::Plane, field);
            // Densities that jump between cells.
            (body.corner_mass, body.mass) = body.made.masses(Measure::Plane, |cell| if cell % 3 == 0 { 8000.0 } else { 1000.0 });
            let (got, found) = body.to(&new, Measure::Plane);
            let sums = got.differs(&body, 10);
            let velocities = largest(new.positions.iter().zip(&got.velocities).flat_map(|(x, v)| minus(*v, field(x))));
            assert!(sums < 1e-13, "{kind:?} to {new_kind:?}, scale {scale:e}: sums differ by {sums:e}; {found:?}");
            assert!(velocities < 1e-12, "{kind:?} to {new_kind:?}: velocities differ by {velocities:e}");
            worst = [worst[0].max(sums), worst[1].max(velocities), worst[2].max(found.correction)];
        }
    }
    println!("affine: sums {:e}, velocities {:e}, largest q {:e}", worst[0], worst[1], worst[2]);
}

/// Where all second moments need too large a q, rigid motion passes still.
#[test]
fn rigid_motion_passes_between_very_different_meshes() {
    let mut random = Random::new(12);
    let rigid = |x: &Point| [3.0 - 5.0 * x[1], -1.0 + 5.0 * x[0]];
    for (old, new) in [([4, 40], [8, 80]), ([8, 80], [4, 40]), ([2, 20], [4, 40]), ([4, 20], [2, 20]), ([1, 20], [2, 40])] {
        let to = |x: Point| [x[0], x[1] * 8.0];
        let body = Body::new(Made::square(old[0], old[1], 0.2, Kind::Quads, &mut random).map(to), Measure::Plane, rigid);
        let new = Made::square(new[0], new[1], 0.2, Kind::Quads, &mut random).map(to);
        let (got, found) = body.to(&new, Measure::Plane);
        let sums = got.differs(&body, 3).max((got.kinetic() / body.kinetic() - 1.0).abs());
        let velocities = largest(new.positions.iter().zip(&got.velocities).flat_map(|(x, v)| minus(*v, rigid(x))));
        println!("rigid {old:?}: q {:.3e}, sums {sums:e}, velocities {velocities:e}", found.correction);
        assert!(sums < 1e-13 && velocities < 1e-11, "{old:?}: {sums:e} {velocities:e}");
    }
}

#[test]
fn uniform_motion_passes_a_hundred_times() {
    let mut random = Random::new(13);
    let meshes: Vec<Made> = [Kind::Quads, Kind::Triangles, Kind::Both, Kind::Quads, Kind::Both]
        .iter()
        .enumerate()
        .map(|(k, &kind)| Made::square(10 + k, 12 - k, 0.3, kind, &mut random))
        .collect();
    let mut body = Body::new(meshes[0].clone(), Measure::Plane, |_| [123.0, -45.0]);
    for k in 1..=100 {
        body = body.to(&meshes[k * 3 % 5], Measure::Plane).0;
    }
    let most = largest(body.velocities.iter().flat_map(|v| [v[0] / 123.0 - 1.0, v[1] / 45.0 + 1.0]));
    println!("uniform: {most:e}");
    assert!(most < 1e-13, "{most:e}");
}

#[test]
fn the_same_mesh_changes_nothing() {
    let mut random = Random::new(14);
    for measure in [Measure::Plane, Measure::Revolution] {
        for kind in [Kind::Triangles, Kind::Quads, Kind::Both] {
            let made = Made::square(9, 7, 0.3, kind, &mut random);
            let start = Body::new(made.clone(), measure, |_| [random.next(), random.next()]);
            // Masses consistent with the pieces.
            let mut body = start.to(&made, measure).0;
            (body.mass.iter_mut()).for_each(|mass| *mass = 0.0);
            for (cell, masses) in made.cells.iter().zip(&body.corner_mass) {
                crate::plane::corners(cell).iter().zip(masses).for_each(|(&node, mass)| body.mass[node as usize] += mass);
            }
            body.velocities = start.velocities.clone();
            let (got, found) = body.to(&made, measure);
            let velocities = largest(got.velocities.iter().zip(&body.velocities).flat_map(|(a, b)| minus(*a, *b)));
            let masses = largest(got.mass.iter().zip(&body.mass).map(|(a, b)| a / b - 1.0));
            let of_corners = largest(got.corner_mass.iter().flatten().zip(body.corner_mass.iter().flatten()).map(|(a, b)| a - b)) / 7800.0;
            let kinetic = got.kinetic() / body.kinetic() - 1.0;
            println!("same mesh {measure:?} {kind:?}: v {velocities:e}, m {masses:e}, K {kinetic:e}, s {}", found.scale);
            assert!(velocities < 1e-13, "{measure:?} {kind:?}: velocities differ by {velocities:e}");
            assert!(masses < 1e-13 && of_corners < 1e-13, "{measure:?} {kind:?}: {masses:e} {of_corners:e}");
            assert!(kinetic.abs() < 1e-13, "{measure:?} {kind:?}: {kinetic:e}");
        }
    }
}

#[test]
fn smooth_velocities_are_of_second_order() {
    for (kind, ratio) in [(Kind::Triangles, 1.0), (Kind::Quads, 1.0), (Kind::Quads, 1.3)] {
        let errors: Vec<f64> = [10, 20, 40]
            .iter()
            .map(|&n| {
                // The mean of some meshes.
                (0..4)
                    .map(|seed| {
                        let mut random = Random::new(100 + seed);
                        let body = Body::new(Made::square(n, n, 0.25, kind, &mut random), Measure::Plane, |x| smooth(*x));
                        let m = (ratio * n as f64) as usize;
                        error(&body.to(&Made::square(m, m, 0.25, kind, &mut random), Measure::Plane).0, smooth) / 4.0
                    })
                    .sum()
            })
            .collect();
        let slopes = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
        println!("velocities {kind:?} {ratio}: {errors:?}, order {slopes:?}");
        assert!(slopes.iter().all(|&slope| slope >= 1.8), "{kind:?}, {ratio}: errors {errors:?}, order {slopes:?}");
    }
}

#[test]
fn energy_never_rises_and_momentum_stays() {
    let mut random = Random::new(15);
    let kinds = [Kind::Quads, Kind::Triangles, Kind::Both];
    let (mut worst, mut refused) = ([0.0f64; 3], 0);
    for trial in 0..1000 {
        let size = |random: &mut Random| 4 + (4.0 * random.next().abs()) as usize;
        let sizes = [size(&mut random), size(&mut random), size(&mut random), size(&mut random)];
        let old = Made::square(sizes[0], sizes[1], 0.24, kinds[trial % 3], &mut random);
        let new = Made::square(sizes[2], sizes[3], 0.24, kinds[trial / 3 % 3], &mut random);
        // Any velocities, or quadratic ones, whose lumped energy would rise in half of the trials.
        let c: Vec<f64> = (0..8).map(|_| random.next()).collect();
        let body = Body::new(old, Measure::Plane, |x| {
            if trial % 2 == 0 {
                return [random.next() + 0.3, random.next()];
            }
            let terms = [1.0, x[0] * x[0], x[0] * x[1], x[1] * x[1]];
            [0, 4].map(|first| (0..4).map(|k| c[first + k] * terms[k]).sum())
        });
        let held = vec![[None; 2]; new.positions.len()];
        let found = match body.try_to(&new, Measure::Plane, &held) {
            Ok(found) => found,
            // Between 4 and 7 cells on a side the inertia may differ too much.
            Err(failure) => {
                assert!(matches!(failure, Failure::Correction(_)), "{failure}");
                refused += 1;
                continue;
            }
        };
        assert!(found.mass.iter().all(|&mass| mass > 0.0), "trial {trial}: a mass is not positive");
        let got = Body { made: new, corner_mass: found.corner_mass, mass: found.mass, velocities: found.velocities };
        let (a, b) = (got.totals(), body.totals());
        let gain = got.kinetic() / body.kinetic() - 1.0;
        let momenta = [6, 7, 8].map(|k| (a[k][0] - b[k][0]).abs() / b[k][1]);
        assert!(gain <= 1e-13, "trial {trial}: energy rises by {gain:e}");
        assert!(momenta.iter().all(|&change| change <= 1e-12), "trial {trial}: momenta change by {momenta:?}");
        let lost = found.kinetic_lost / body.kinetic();
        assert!((lost + gain).abs() < 1e-13, "trial {trial}: {lost:e} told lost, {gain:e} gained");
        worst = [worst[0].max(gain), worst[1].max(momenta[0].max(momenta[1])), worst[2].max(momenta[2])];
    }
    println!("random: gain {:e}, dP {:e}, dL {:e}, refused {refused}", worst[0], worst[1], worst[2]);
    assert!(refused <= 5, "{refused} of 1,000 refused");
}

/// Without energy to spare the differences between the lumped energies of the four meshes add up.
#[test]
fn fifty_transfers_keep_the_energy_of_a_smooth_field() {
    for (kind, has_spare, least) in
        [(Kind::Triangles, true, 0.9995), (Kind::Quads, true, 0.9995), (Kind::Triangles, false, 0.998), (Kind::Quads, false, 0.998)]
    {
        let mut random = Random::new(16);
        let meshes: Vec<Made> = (0..4).map(|_| Made::square(24, 24, 0.15, kind, &mut random)).collect();
        let mut body = Body::new(meshes[0].clone(), Measure::Plane, |x| smooth(*x));
        let (before, mut over, mut lost, mut most) = (body.kinetic(), 0.0f64, 0.0f64, 0.0f64);
        let start = body.clone();
        for k in 1..=50 {
            let spare = if has_spare { lost.max(0.0) } else { 0.0 };
            let (next, found) = body.to_with(&meshes[k % 4], Measure::Plane, spare);
            lost += found.kinetic_lost;
            most = most.max(-found.kinetic_lost - spare);
            body = next;
            over = over.max(largest(body.velocities.iter().flatten().copied()) - 1.0);
        }
        let kept = body.kinetic() / before;
        let sums = body.differs(&start, 9);
        println!("fifty {kind:?}, spare {has_spare}: K/K0 {kept}, over {over:e}, sums {sums:e}");
        assert!(kept >= least && kept <= 1.0 + 1e-13, "{kind:?}, spare {has_spare}: {kept}");
        assert!(most < 1e-13 * before, "{kind:?}: energy rises by {most:e} J");
        assert!((lost / before - (1.0 - kept)).abs() < 1e-12, "{kind:?}: {lost:e} J told lost");
        assert!(over < 1e-3, "{kind:?}: the largest velocity is exceeded by {over:e}");
        assert!(sums < 1e-12, "{kind:?}: sums differ by {sums:e}");
    }
}

/// A jump does not overshoot by more than settling and the correction of masses make.
#[test]
fn a_jump_stays_within_bounds() {
    let mut random = Random::new(17);
    let meshes: Vec<Made> = (0..4).map(|_| Made::square(24, 24, 0.25, Kind::Quads, &mut random)).collect();
    let mut body = Body::new(meshes[0].clone(), Measure::Plane, |x| [if x[0] > 0.4 { 1.0 } else { 0.0 }, 0.0]);
    let (before, mut over) = (body.kinetic(), 0.0f64);
    for k in 1..=50 {
        body = body.to(&meshes[k % 4], Measure::Plane).0;
        over = body.velocities.iter().fold(over, |over, v| over.max(v[0] - 1.0).max(-v[0]).max(v[1].abs()));
    }
    let kept = body.kinetic() / before;
    println!("jump: over {over:e}, K/K0 {kept}");
    assert!(over < 3e-3, "over by {over:e}");
    assert!(kept > 0.96, "{kept}");
}

/// No diagonal of a quadrilateral is preferred: on regular meshes all nodes within have one mass, and a field
/// that is its own mirror image stays so.
#[test]
fn regular_quadrilaterals_have_equal_masses() {
    let mut random = Random::new(23);
    let made = Made::square(9, 9, 0.0, Kind::Quads, &mut random);
    let body = Body::new(Made::square(9, 9, 0.0, Kind::Quads, &mut random), Measure::Plane, |x| [x[0] * x[1], 0.0]);
    let found = body.try_to(&made, Measure::Plane, &vec![[None; 2]; 100]).unwrap();
    let most = largest(found.corner_mass.iter().flatten().map(|mass| mass / (7800.0 / 324.0) - 1.0));
    assert!(most < 1e-13, "masses of corners differ by {most:e}");
    let new = Made::square(7, 8, 0.0, Kind::Quads, &mut random);
    let (got, _) = Body::new(made, Measure::Plane, |x| [x[1] * (x[0] - 0.5), x[0] * (1.0 - x[0])]).to(&new, Measure::Plane);
    for j in 0..9 {
        for i in 0..8 {
            let (a, b) = (got.velocities[8 * j + i], got.velocities[8 * j + 7 - i]);
            assert!((a[0] + b[0]).abs() < 1e-14 && (a[1] - b[1]).abs() < 1e-14, "{a:?} and {b:?}");
        }
    }
}

#[test]
fn held_components_stay_as_prescribed() {
    let mut random = Random::new(18);
    let (old, new) = (Made::square(8, 8, 0.3, Kind::Quads, &mut random), Made::square(9, 10, 0.3, Kind::Quads, &mut random));
    // A line of symmetry y = 0: sliding along it is free.
    let field = |x: &Point| [2.0 + 0.3 * x[0], -1.5 * x[1]];
    let body = Body::new(old, Measure::Plane, field);
    let held: Vec<_> = new.positions.iter().map(|x| [None, (x[1] == 0.0).then_some(0.0)]).collect();
    let found = body.try_to(&new, Measure::Plane, &held).unwrap();
    let most = largest(new.positions.iter().zip(&found.velocities).flat_map(|(x, v)| minus(*v, field(x))));
    assert!(most < 1e-12, "{most:e}");
    assert!(found.velocities.iter().zip(&held).all(|(v, held)| held[1].is_none_or(|held| v[1] == held)));
    let momentum = found.mass.iter().zip(&found.velocities).map(|(m, v)| m * v[0]).sum::<f64>();
    let error = momentum / body.totals()[6][0] - 1.0;
    assert!(error.abs() < 1e-13, "{error:e}");
    // Held at what moves.
    let held: Vec<_> = new.positions.iter().map(|x| [(x[0] == 0.0).then_some(2.0), None]).collect();
    let found = body.try_to(&new, Measure::Plane, &held).unwrap();
    let most = largest(new.positions.iter().zip(&found.velocities).flat_map(|(x, v)| minus(*v, field(x))));
    assert!(most < 1e-12, "{most:e}");
}

#[test]
fn a_body_of_revolution_keeps_mass_axial_momentum_and_affine_fields() {
    let mut random = Random::new(19);
    let measure = Measure::Revolution;
    for (start, kind) in [(0.0, Kind::Quads), (0.0, Kind::Triangles), (0.5, Kind::Both)] {
        let to = |x: Point| [x[0] + start, 2.0 * x[1] + 7.0];
        let old = Made::square(10, 9, 0.3, kind, &mut random).map(to);
        let new = Made::square(12, 11, 0.3, kind, &mut random).map(to);
        // Pappus: the area times the way of its centre.
        let pappus = 2.0 * super::TURN * (start + 0.5);
        assert!((old.total(measure) / pappus - 1.0).abs() < 1e-14);
        let field = |x: &Point| [0.4 * x[0], 2.0 - 3.0 * (x[1] - 7.0)];
        let mut body = Body::new(old.clone(), measure, field);
        // Masses ∫ ρN, which near the axis differ from equal ones.
        (body.corner_mass, body.mass) = {
            let same = body.try_to(&old, measure, &vec![[None; 2]; old.positions.len()]).unwrap();
            let mut mass = vec![0.0; old.positions.len()];
            for (cell, masses) in old.cells.iter().zip(&same.corner_mass) {
                crate::plane::corners(cell).iter().zip(masses).for_each(|(&node, m)| mass[node as usize] += m);
            }
            (same.corner_mass, mass)
        };
        let (got, found) = body.to(&new, measure);
        let (a, b) = (got.totals(), body.totals());
        let sums = [0, 2, 5, 7, 9].map(|k| (a[k][0] - b[k][0]).abs() / b[k][1]);
        assert!(sums.iter().all(|&change| change < 1e-13), "{start} {kind:?}: {sums:?}");
        let most = largest(new.positions.iter().zip(&got.velocities).flat_map(|(x, v)| minus(*v, field(x))));
        assert!(most < 1e-12, "{start} {kind:?}: {most:e}");
        let mass = found.corner_mass.iter().flatten().sum::<f64>() / (7800.0 * pappus) - 1.0;
        assert!(mass.abs() < 1e-13, "{mass:e}");
        // ∫ ρ x dV = ρ 2π ∫∫ x² dx dy, by the consistent masses alone.
        let first = |x: f64| 2.0 * super::TURN * x * x * x / 3.0;
        let mut moment = 0.0;
        for (cell, masses) in new.cells.iter().zip(&found.corner_mass) {
            let nodes = crate::plane::corners(cell);
            moment += nodes.iter().zip(masses).map(|(&node, mass)| mass * new.positions[node as usize][0]).sum::<f64>();
        }
        let error = moment / (7800.0 * (first(start + 1.0) - first(start))) - 1.0;
        assert!(error.abs() < 1e-13, "{start} {kind:?}: ∫ ρ x differs by {error:e}");
        println!("revolution {start} {kind:?}: {sums:?} v {most:e} q {:e}", found.correction);
        // Other masses, any field: axial momentum stays, energy does not rise.
        let body = Body::new(body.made, measure, |_| [random.next(), random.next()]);
        // On the axis nodes do not leave it.
        let held: Vec<_> = new.positions.iter().map(|x| [(x[0] == 0.0).then_some(0.0), None]).collect();
        let found = body.try_to(&new, measure, &held).unwrap();
        assert!(found.velocities.iter().zip(&held).all(|(v, held)| held[0].is_none_or(|held| v[0] == held)));
        let got = Body { made: new, corner_mass: found.corner_mass, mass: found.mass, velocities: found.velocities };
        let change = (got.totals()[7][0] - body.totals()[7][0]).abs() / body.totals()[7][1];
        assert!(change < 1e-13 && found.kinetic_lost > -1e-13 * body.kinetic(), "{change:e} {:e}", found.kinetic_lost);
    }
}

#[test]
fn other_chords_of_an_arc_keep_mass_and_momenta() {
    let mut random = Random::new(20);
    for (old, new) in [((6, 20), (7, 31)), ((7, 31), (6, 20)), ((4, 12), (4, 13)), ((10, 60), (9, 47))] {
        let (old, new) = (ring(old.0, old.1, &mut random), ring(new.0, new.1, &mut random));
        let body = Body::new(old, Measure::Plane, |x| smooth(*x));
        let (got, found) = body.to(&new, Measure::Plane);
        let sums = got.differs(&body, 9);
        let mass = found.corner_mass.iter().flatten().sum::<f64>() / body.mass.iter().sum::<f64>() - 1.0;
        println!("ring: sums {sums:e}, mass {mass:e}, q {:e}, lost {:e}", found.correction, found.kinetic_lost / body.kinetic());
        assert!(sums < 1e-13, "{sums:e}");
        assert!(mass.abs() < 1e-13, "{mass:e}");
        assert!(found.kinetic_lost >= -1e-13 * body.kinetic());
        // Uniform motion.
        let body = Body::new(body.made, Measure::Plane, |_| [3.0, -4.0]);
        let (got, _) = body.to(&new, Measure::Plane);
        let most = largest(got.velocities.iter().flat_map(|v| [v[0] - 3.0, v[1] + 4.0]));
        assert!(most < 1e-12, "{most:e}");
    }
}

#[test]
fn slender_tiny_and_huge_cells_keep_sums() {
    let mut random = Random::new(21);
    for scale in [1e-9, 1.0, 1e9] {
        for angle in [0.0, 0.3, 1.1] {
            let to = |x: Point| turned(angle)([scale * x[0], 0.01 * scale * x[1]]);
            let old = Made::square(9, 8, 0.3, Kind::Quads, &mut random).map(to);
            let new = Made::square(8, 10, 0.3, Kind::Both, &mut random).map(to);
            let body = Body::new(old, Measure::Plane, |_| [random.next(), random.next()]);
            let (got, found) = body.to(&new, Measure::Plane);
            let sums = got.differs(&body, 9);
            let gain = got.kinetic() / body.kinetic() - 1.0;
            println!("slender {scale:e} {angle}: sums {sums:e}, gain {gain:e}, q {:e}", found.correction);
            assert!(sums < 1e-12 && gain < 1e-13, "{scale:e} {angle}: {sums:e} {gain:e}");
        }
    }
}

#[test]
fn wrong_lengths_and_numbers_are_refused() {
    let mut random = Random::new(22);
    let made = Made::square(3, 3, 0.2, Kind::Quads, &mut random);
    let body = Body::new(made.clone(), Measure::Plane, |_| [1.0, 0.0]);
    assert_eq!(body.try_to(&made, Measure::Plane, &[]).unwrap_err(), Failure::Size);
    let held = vec![[None; 2]; made.positions.len()];
    let with = |change: &dyn Fn(&mut Body)| {
        let mut body = body.clone();
        change(&mut body);
        body.try_to(&made, Measure::Plane, &held).unwrap_err()
    };
    assert_eq!(with(&|body| body.velocities[3][1] = f64::NAN), Failure::Number);
    assert_eq!(with(&|body| body.mass[3] = -1.0), Failure::Number);
    assert_eq!(with(&|body| body.corner_mass[2] = [0.0; 4]), Failure::Massless { cell: 2 });
    assert_eq!(
        with(&|body| {
            body.corner_mass.pop();
        }),
        Failure::Size
    );
    assert!(matches!(with(&|body| body.mass.iter_mut().for_each(|mass| *mass *= 3.0)), Failure::Correction(q) if q > 1.9));
}
