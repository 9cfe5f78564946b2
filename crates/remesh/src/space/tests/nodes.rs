//! Tests of masses and velocities.

use super::{KINDS, Kinds, Made, Random, largest, pipe, turned};
use crate::space::vector::{cross, dot, minus};
use crate::space::{Failure, NewNodes, Nodes, OldNodes, Point, nodes};

/// A mesh with masses and velocities.
#[derive(Clone)]
struct Body {
    made: Made,
    cell_mass: Vec<f64>,
    mass: Vec<f64>,
    velocities: Vec<Point>,
}

impl Body {
    fn new(made: Made, velocity: impl FnMut(&Point) -> Point) -> Self {
        let (cell_mass, mass) = made.masses(|cell| if cell % 3 == 0 { 8000.0 } else { 7000.0 });
        let velocities = made.positions.iter().map(velocity).collect();
        Self { made, cell_mass, mass, velocities }
    }

    fn try_to(&self, new: &Made, held: &[[Option<f64>; 3]], spare: f64) -> Result<Nodes, Failure> {
        let old =
            OldNodes { mesh: self.made.mesh(), cell_mass: &self.cell_mass, node_mass: &self.mass, velocities: &self.velocities, spare };
        nodes(&old, &NewNodes { mesh: new.mesh(), held })
    }

    fn to_with(&self, new: &Made, spare: f64) -> (Self, Nodes) {
        let found = self.try_to(new, &vec![[None; 3]; new.positions.len()], spare).unwrap();
        let (cell_mass, mass, velocities) = (found.cell_mass.clone(), found.mass.clone(), found.velocities.clone());
        (Self { made: new.clone(), cell_mass, mass, velocities }, found)
    }

    fn to(&self, new: &Made) -> (Self, Nodes) {
        self.to_with(new, 0.0)
    }

    fn sum(&self, of: impl Fn(Point, Point) -> f64) -> f64 {
        self.mass.iter().enumerate().map(|(a, mass)| mass * of(self.made.positions[a], self.velocities[a])).sum()
    }

    fn kinetic(&self) -> f64 {
        self.sum(|_, v| 0.5 * dot(v, v))
    }

    /// Mass, first moments, momentum, angular momentum, second moments and energy, each with the sum of
    /// absolute values to compare with.
    fn totals(&self) -> Vec<[f64; 2]> {
        let both = |of: &dyn Fn(Point, Point) -> f64| [self.sum(of), self.sum(|x, v| of(x, v).abs())];
        let mut found = vec![both(&|_, _| 1.0)];
        (0..3).for_each(|k| found.push(both(&|x, _| x[k])));
        (0..3).for_each(|k| found.push(both(&|_, v| v[k])));
        (0..3).for_each(|k| found.push([self.sum(|x, v| cross(x, v)[k]), self.sum(|x, v| (dot(x, x) * dot(v, v)).sqrt())]));
        (0..3).for_each(|k| found.push(both(&|x, _| x[k] * x[k])));
        (0..3).for_each(|k| found.push(both(&|x, _| x[k] * x[(k + 1) % 3])));
        found.push(both(&|_, v| 0.5 * dot(v, v)));
        found
    }

    /// Largest difference of totals by their sums of absolute values, of some of them.
    fn differs(&self, from: &Self, of: std::ops::Range<usize>) -> f64 {
        let (a, b) = (self.totals(), from.totals());
        of.fold(0.0, |most: f64, k| most.max((a[k][0] - b[k][0]).abs() / b[k][1]))
    }
}

/// Totals without second moments and energy; all.
const MOMENTA: std::ops::Range<usize> = 0..10;
const ALL: std::ops::Range<usize> = 0..17;

/// Root of the mean square, by mass, of the difference from a field.
fn error(body: &Body, field: impl Fn(Point) -> Point) -> f64 {
    let square = body.sum(|x, v| dot(minus(v, field(x)), minus(v, field(x))));
    (square / body.mass.iter().sum::<f64>()).sqrt()
}

fn smooth(x: Point) -> Point {
    [(2.0 * x[0]).sin() * (2.0 * x[1]).cos(), (2.0 * x[1]).sin() * x[2], (2.0 * x[2] + x[0]).cos()]
}

#[test]
fn affine_velocities_keep_all_sums() {
    let mut random = Random::new(11);
    let affine = |x: &Point| [3.0 + 2.0 * x[0] - 5.0 * x[1], -1.0 + 4.0 * x[0] + 0.5 * x[2], x[1] - 3.0 * x[2]];
    let mut worst = [0.0f64; 3];
    let [hexahedra, wedges, tetrahedra, tens, all] = KINDS;
    for (from, to, scale, sizes) in [
        (hexahedra, hexahedra, 1.0, [[4, 3, 3], [4, 4, 3]]),
        (hexahedra, hexahedra, 1e-9, [[4, 3, 3], [4, 4, 3]]),
        (hexahedra, hexahedra, 1e9, [[4, 3, 3], [4, 4, 3]]),
        (tetrahedra, hexahedra, 1.0, [[7, 7, 7], [4, 4, 4]]),
        (wedges, tetrahedra, 1.0, [[5, 5, 5], [7, 7, 7]]),
        (hexahedra, wedges, 1.0, [[4, 3, 3], [4, 4, 3]]),
        (tens, hexahedra, 1.0, [[3, 3, 3], [5, 5, 5]]),
        (hexahedra, tens, 1.0, [[5, 5, 5], [3, 3, 3]]),
        (tens, tens, 1.0, [[4, 3, 3], [4, 4, 3]]),
        (all, all, 1.0, [[4, 3, 4], [4, 4, 4]]),
    ] {
        let place = |x: Point| turned(0.4)([scale * (x[0] + 0.2), scale * 0.7 * x[1], scale * x[2]]);
        let old = Made::cube(sizes[0], 0.2, from, &mut random).map(place);
        let new = Made::cube(sizes[1], 0.2, to, &mut random).map(place);
        let field = |x: &Point| affine(&x.map(|x| x / scale));
        let mut body = Body::new(old, field);
        // Densities that jump between cells.
        (body.cell_mass, body.mass) = body.made.masses(|cell| if cell % 3 == 0 { 2000.0 } else { 1000.0 });
        let (got, found) = body.to(&new);
        let sums = got.differs(&body, ALL);
        let velocities = largest(new.positions.iter().zip(&got.velocities).flat_map(|(x, v)| minus(*v, field(x))));
        println!("affine {from:?} {to:?} {scale:e}: sums {sums:e}, v {velocities:e}, q {}", found.correction);
        assert!(sums < 1e-12 && found.matched == 1.0, "{from:?} to {to:?}, {scale:e}: {sums:e}, q {}", found.correction);
        assert!(velocities < 1e-12, "{from:?} to {to:?}: {velocities:e}");
        worst = [worst[0].max(sums), worst[1].max(velocities), worst[2].max(found.correction)];
    }
    println!("affine: sums {:e}, velocities {:e}, largest q {:e}", worst[0], worst[1], worst[2]);
}

#[test]
fn uniform_motion_passes_thirty_times() {
    let mut random = Random::new(13);
    let mut body = Body::new(Made::cube([3, 3, 3], 0.3, Kinds::Hexahedra, &mut random), |_| [123.0, -45.0, 7.0]);
    for k in 0..30 {
        body = body.to(&Made::cube([3, 3, 3], 0.3, KINDS[k % 5], &mut random)).0;
    }
    let most = largest(body.velocities.iter().flat_map(|v| [v[0] / 123.0 - 1.0, v[1] / 45.0 + 1.0, v[2] / 7.0 - 1.0]));
    println!("uniform: {most:e}");
    assert!(most < 1e-12, "{most:e}");
}

/// Spin about any axis of a body whose second moments differ, with mass and energy.
#[test]
fn rigid_motion_keeps_its_energy() {
    let mut random = Random::new(12);
    let spin = [3.0, -2.0, 5.0];
    for (from, to) in [(Kinds::Hexahedra, Kinds::Hexahedra), (Kinds::Tens, Kinds::Tens)] {
        let place = |x: Point| turned(1.0)([2.0 * x[0] + 5.0, x[1], 0.5 * x[2]]);
        let field = |x: &Point| [0, 1, 2].map(|k| cross(spin, *x)[k] + [1.0, 20.0, -3.0][k]);
        let mut body = Body::new(Made::cube([3, 3, 2], 0.25, from, &mut random).map(place), field);
        let start = body.clone();
        for k in 0..6 {
            let new = Made::cube([3, 3, 2], 0.25, if k % 2 == 0 { to } else { from }, &mut random).map(place);
            body = body.to(&new).0;
        }
        let sums = body.differs(&start, ALL);
        let velocities = largest(body.made.positions.iter().zip(&body.velocities).flat_map(|(x, v)| minus(*v, field(x))));
        println!("rigid {from:?}: sums {sums:e}, v {velocities:e}");
        assert!(sums < 1e-12 && velocities < 1e-11, "{from:?}: {sums:e} {velocities:e}");
    }
}

/// One layer of cells to two: second moments across cannot be had, momenta still are.
#[test]
fn a_thin_plate_keeps_its_momenta() {
    let mut random = Random::new(24);
    let place = |x: Point| [4.0 * x[0], 4.0 * x[1], 0.2 * x[2]];
    let old = Made::cube([4, 4, 1], 0.2, Kinds::Hexahedra, &mut random).map(place);
    let new = Made::cube([4, 4, 2], 0.2, Kinds::Hexahedra, &mut random).map(place);
    let body = Body::new(old, |x| [1.0 + 0.2 * x[1] * x[1], 0.3 * x[0] * x[1], x[0] * x[0]]);
    let (got, found) = body.to(&new);
    let (sums, gain) = (got.differs(&body, MOMENTA), got.kinetic() / body.kinetic() - 1.0);
    println!("plate: matched {}, q {}, sums {sums:e}, gain {gain:e}", found.matched, found.correction);
    assert!(found.matched < 1.0 && found.correction <= 0.75 + 1e-12);
    assert!(sums < 1e-12 && gain < 1e-13, "{sums:e} {gain:e}");
    // Its spin about an axis in it has to gain energy, and is refused.
    let spinning = Body::new(body.made.clone(), |x| [0.0, -(x[2] - 0.1), x[1] - 2.0]);
    assert_eq!(spinning.try_to(&new, &vec![[None; 3]; new.positions.len()], 0.0).unwrap_err(), Failure::Inertia);
}

#[test]
fn the_same_mesh_changes_nothing() {
    let mut random = Random::new(14);
    for kinds in KINDS {
        let made = Made::cube([3, 2, 2], 0.25, kinds, &mut random);
        let start = Body::new(made.clone(), |_| [random.next(), random.next(), random.next()]);
        // Masses as a transfer gives them.
        let body = Body { mass: start.to(&made).0.mass, ..start };
        let (got, found) = body.to(&made);
        let velocities = largest(got.velocities.iter().zip(&body.velocities).flat_map(|(a, b)| minus(*a, *b)));
        let cells = largest(got.cell_mass.iter().zip(&body.cell_mass).map(|(a, b)| a / b - 1.0));
        println!("same mesh {kinds:?}: v {velocities:e}, cells {cells:e}, s {}", found.scale);
        assert!(velocities < 1e-13 && cells < 1e-13, "{kinds:?}: {velocities:e} {cells:e}");
        assert!(got.differs(&body, MOMENTA) < 1e-13 && found.kinetic_lost >= -1e-13 * body.kinetic());
    }
}

#[test]
fn smooth_velocities_are_of_second_order() {
    for (from, to, sizes) in
        [(Kinds::Hexahedra, Kinds::Hexahedra, [4, 8]), (Kinds::Tetrahedra, Kinds::Tetrahedra, [4, 8]), (Kinds::Tens, Kinds::Tens, [3, 6])]
    {
        let errors = sizes.map(|n| {
            let mut random = Random::new(100 + n as u64);
            let body = Body::new(Made::cube([n; 3], 0.2, from, &mut random), |x| smooth(*x));
            error(&body.to(&Made::cube([n; 3], 0.2, to, &mut random)).0, smooth)
        });
        let slope = (errors[0] / errors[1]).log2();
        println!("velocities {from:?}: {errors:?}, order {slope:.2}");
        assert!(slope >= 1.8, "{from:?}: errors {errors:?}, order {slope}");
    }
}

#[test]
fn energy_never_rises_and_momentum_stays() {
    let mut random = Random::new(15);
    let (mut worst, mut refused) = ([0.0f64; 3], 0);
    for trial in 0..200 {
        let mut size = || 2 + (2.0 * random.next().abs()) as usize;
        let (old, new) = ([size(), size(), size()], [size(), size(), size()]);
        let old = Made::cube(old, 0.24, KINDS[trial % 5], &mut random);
        let new = Made::cube(new, 0.24, KINDS[trial / 5 % 5], &mut random);
        // Any velocities, or quadratic ones, whose lumped energy would rise in half of the trials.
        let c: Vec<f64> = (0..12).map(|_| random.next()).collect();
        let body = Body::new(old, |x| {
            if trial % 2 == 0 {
                return [random.next() + 0.3, random.next(), random.next()];
            }
            let terms = [1.0, x[0] * x[1], x[1] * x[2], x[2] * x[0]];
            [0, 4, 8].map(|first| (0..4).map(|k| c[first + k] * terms[k]).sum())
        });
        let found = match body.try_to(&new, &vec![[None; 3]; new.positions.len()], 0.0) {
            Ok(found) => found,
            // Between two and three cells on a side the inertia may differ too much.
            Err(failure) => {
                assert!(matches!(failure, Failure::Correction(_) | Failure::Inertia), "{failure}");
                refused += 1;
                continue;
            }
        };
        assert!(found.mass.iter().all(|&mass| mass > 0.0), "trial {trial}: a mass is not positive");
        let got = Body { made: new, cell_mass: found.cell_mass, mass: found.mass, velocities: found.velocities };
        let gain = got.kinetic() / body.kinetic() - 1.0;
        let momenta = [got.differs(&body, 4..7), got.differs(&body, 7..10)];
        assert!(gain <= 1e-13, "trial {trial}: energy rises by {gain:e}");
        assert!(momenta.iter().all(|&change| change <= 1e-12), "trial {trial}: momenta change by {momenta:?}");
        let lost = found.kinetic_lost / body.kinetic();
        assert!((lost + gain).abs() < 1e-13, "trial {trial}: {lost:e} told lost, {gain:e} gained");
        worst = [worst[0].max(gain), worst[1].max(momenta[0]), worst[2].max(momenta[1])];
    }
    println!("random: gain {:e}, dP {:e}, dL {:e}, refused {refused}", worst[0], worst[1], worst[2]);
    assert!(refused <= 10, "{refused} of 200 refused");
}

/// A jump does not overshoot by more than settling and the correction of masses make.
#[test]
fn a_jump_stays_within_bounds() {
    let mut random = Random::new(17);
    let meshes: Vec<Made> = (0..2).map(|_| Made::cube([6, 3, 3], 0.2, Kinds::Hexahedra, &mut random)).collect();
    let mut body = Body::new(meshes[0].clone(), |x| [if x[0] > 0.4 { 1.0 } else { 0.0 }, 0.0, 0.0]);
    let (before, mut over) = (body.kinetic(), 0.0f64);
    for k in 1..=4 {
        body = body.to(&meshes[k % 2]).0;
        over = body.velocities.iter().fold(over, |over, v| over.max(v[0] - 1.0).max(-v[0]).max(v[1].abs()).max(v[2].abs()));
    }
    println!("jump: over {over:e}, K/K0 {}", body.kinetic() / before);
    assert!(over < 2e-2, "over by {over:e}");
    assert!(body.kinetic() > 0.9 * before);
}

#[test]
fn held_components_stay_as_prescribed() {
    let mut random = Random::new(18);
    let [old, new] = [[3, 3, 3], [3, 3, 4]].map(|n| Made::cube(n, 0.25, Kinds::Hexahedra, &mut random));
    // A plane of symmetry z = 0: sliding and turning in it are free.
    let field = |x: &Point| [2.0 + 0.3 * x[0] - 2.0 * x[1], 2.0 * x[0] + 1.0, -1.5 * x[2]];
    let body = Body::new(old, field);
    let held: Vec<_> = new.positions.iter().map(|x| [None, None, (x[2] == 0.0).then_some(0.0)]).collect();
    let found = body.try_to(&new, &held, 0.0).unwrap();
    let most = largest(new.positions.iter().zip(&found.velocities).flat_map(|(x, v)| minus(*v, field(x))));
    assert!(most < 1e-12, "{most:e}");
    assert!(found.velocities.iter().zip(&held).all(|(v, held)| held[2].is_none_or(|held| v[2] == held)));
    // Momentum in the plane, and angular momentum about its normal, of any velocities.
    let body = Body { velocities: body.velocities.iter().map(|v| [v[0] + random.next(), v[1], v[2]]).collect(), ..body };
    let found = body.try_to(&new, &held, 0.0).unwrap();
    let got = Body { made: new.clone(), cell_mass: found.cell_mass, mass: found.mass, velocities: found.velocities };
    assert!(got.differs(&body, 4..6) < 1e-13 && got.differs(&body, 9..10) < 1e-13);
    assert!(got.kinetic() <= body.kinetic() * (1.0 + 1e-13));
    // Held at what moves.
    let held: Vec<_> = new.positions.iter().map(|x| [None, (x[0] == 0.0).then_some(1.0), None]).collect();
    let body = Body::new(body.made, field);
    let found = body.try_to(&new, &held, 0.0).unwrap();
    let most = largest(new.positions.iter().zip(&found.velocities).flat_map(|(x, v)| minus(*v, field(x))));
    assert!(most < 1e-12, "{most:e}");
}

#[test]
fn other_chords_of_an_arc_keep_mass_and_momenta() {
    let mut random = Random::new(20);
    for (old, new, kinds) in
        [([2, 6, 2], [2, 7, 2], Kinds::Hexahedra), ([2, 7, 2], [2, 5, 2], Kinds::Tens), ([2, 5, 2], [2, 6, 2], Kinds::All)]
    {
        let (old, new) = (pipe(old, kinds, &mut random), pipe(new, kinds, &mut random));
        let body = Body::new(old, |x| smooth(*x));
        let (got, found) = body.to(&new);
        let sums = got.differs(&body, MOMENTA);
        let mass = found.cell_mass.iter().sum::<f64>() / body.mass.iter().sum::<f64>() - 1.0;
        println!("pipe {kinds:?}: sums {sums:e}, mass {mass:e}, q {:e}, mismatch {:?}", found.correction, found.mismatch);
        assert!(found.mismatch[0] > 1e-4 && found.mismatch[1] > 1e-4);
        assert!(sums < 1e-12 && mass.abs() < 1e-13, "{sums:e} {mass:e}");
        assert!(found.kinetic_lost >= -1e-13 * body.kinetic());
        // Uniform motion.
        let body = Body::new(body.made, |_| [3.0, -4.0, 1.0]);
        let most = largest(body.to(&new).0.velocities.iter().flat_map(|v| [v[0] - 3.0, v[1] + 4.0, v[2] - 1.0]));
        assert!(most < 1e-12, "{most:e}");
    }
}

#[test]
fn slender_cells_keep_sums() {
    let mut random = Random::new(21);
    for scale in [1e-9, 1e9] {
        let to = |x: Point| turned(0.3)([scale * x[0], 0.01 * scale * x[1], 0.1 * scale * x[2]]);
        let old = Made::cube([3, 3, 3], 0.25, Kinds::Hexahedra, &mut random).map(to);
        let new = Made::cube([3, 3, 3], 0.25, Kinds::All, &mut random).map(to);
        let body = Body::new(old, |_| [random.next(), random.next(), random.next()]);
        let (got, found) = body.to(&new);
        let (sums, gain) = (got.differs(&body, MOMENTA), got.kinetic() / body.kinetic() - 1.0);
        println!("slender {scale:e}: sums {sums:e}, gain {gain:e}, q {:e}", found.correction);
        assert!(sums < 1e-12 && gain < 1e-13, "{scale:e}: {sums:e} {gain:e}");
    }
}

#[test]
fn wrong_lengths_and_numbers_are_refused() {
    let mut random = Random::new(22);
    let made = Made::cube([2, 2, 2], 0.2, Kinds::Hexahedra, &mut random);
    let body = Body::new(made.clone(), |_| [1.0, 0.0, 2.0]);
    assert_eq!(body.try_to(&made, &[], 0.0).unwrap_err(), Failure::Size);
    let held = vec![[None; 3]; made.positions.len()];
    assert_eq!(body.try_to(&made, &held, f64::NAN).unwrap_err(), Failure::Number);
    assert_eq!(body.try_to(&made, &vec![[Some(f64::NAN); 3]; made.positions.len()], 0.0).unwrap_err(), Failure::Number);
    let with = |change: &dyn Fn(&mut Body)| {
        let mut body = body.clone();
        change(&mut body);
        body.try_to(&made, &held, 0.0).unwrap_err()
    };
    assert_eq!(with(&|body| body.velocities[3][1] = f64::NAN), Failure::Number);
    assert_eq!(with(&|body| body.made.positions[3][1] = f64::NAN), Failure::Number);
    assert_eq!(with(&|body| body.mass[3] = -1.0), Failure::Number);
    assert_eq!(with(&|body| body.cell_mass[2] = 0.0), Failure::Massless { cell: 2 });
    assert_eq!(with(&|body| body.cell_mass.truncate(1)), Failure::Size);
    assert_eq!(with(&|body| body.velocities.truncate(1)), Failure::Size);
    assert!(matches!(with(&|body| body.mass.iter_mut().for_each(|mass| *mass *= 3.0)), Failure::Correction(q) if q > 1.9));
}
