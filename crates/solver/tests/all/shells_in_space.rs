//! Shells in 3D: forces against the slope of the energy, momenta, turns without strain, renumbering, the
//! stable step against true frequencies, patches.

use crate::patches::{Spread, YOUNG, eigenvalues, material, solids};
use crate::shells::section;
use crate::solids::{cross, dot};
use embate_lanes::{Level, Team};
use embate_solver::block::{Block, BlockInput, Motion, NodalForces, Report, evaluate_at_rest, make};
use embate_solver::model::{Material, ShellSection};
use embate_solver::rigid::space::Attitude;
use embate_solver::rotations::Rotations;

type Vector = [f64; 3];

const ELEMENTS: [(&str, usize); 3] = [("shell4", 4), ("shell4_full", 4), ("shell3", 3)];

pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
pub(crate) fn unit(a: Vector) -> Vector {
    a.map(|x| x / dot(a, a).sqrt())
}

/// Elements whose nodes rotate, driven by places and rotations of these.
pub(crate) struct Driven {
    pub(crate) block: Box<dyn Block<3>>,
    pub(crate) forces: Vec<Vector>,
    pub(crate) moments: Vec<Vector>,
    pub(crate) positions: Vec<Vector>,
    rotations: Rotations,
    pub(crate) report: Report,
    time_step: f64,
}

impl Driven {
    pub(crate) fn new(
        element: &str,
        material: &Material,
        section: &ShellSection,
        positions: &[Vector],
        connectivity: &[u32],
        directions: &[Vector],
    ) -> Self {
        let input = BlockInput { section: Some(section), directions, ..BlockInput::new(element, material, connectivity, positions) };
        Self::of(&input)
    }

    pub(crate) fn of(input: &BlockInput<'_, 3>) -> Self {
        let positions = input.positions;
        let mut block = make(input).unwrap();
        let slots = block.slots().len();
        let report = evaluate_at_rest(block.as_mut(), positions, Level::best());
        Self {
            forces: vec![[0.0; 3]; slots],
            moments: vec![[0.0; 3]; slots],
            positions: positions.to_vec(),
            rotations: Rotations::at_rest(0..positions.len() as u32, 3),
            report,
            time_step: 1e-3,
            block,
        }
    }

    /// A step to places and rotations.
    pub(crate) fn go(&mut self, positions: &[Vector], turns: &[Attitude]) {
        let velocities: Vec<Vector> =
            positions.iter().zip(&self.positions).map(|(x, old)| minus(*x, *old).map(|d| d / self.time_step)).collect();
        self.rotations.attitudes.copy_from_slice(turns);
        let motion = Motion { rotations: &self.rotations, ..Motion::new(positions, &velocities, self.time_step) };
        let pulls = NodalForces { forces: &mut self.forces, moments: &mut self.moments };
        self.report = self.block.advance(&motion, Level::best(), pulls, &mut Team::alone());
        self.positions.copy_from_slice(positions);
    }

    /// Force and moment of each node, summed over its slots.
    pub(crate) fn pulls(&self) -> Vec<f64> {
        let mut all = vec![0.0; 6 * self.positions.len()];
        for (slot, &node) in self.block.slots().iter().enumerate().filter(|(_, node)| (**node as usize) < self.positions.len()) {
            for k in 0..3 {
                all[6 * node as usize + k] += self.forces[slot][k];
                all[6 * node as usize + 3 + k] += self.moments[slot][k];
            }
        }
        all
    }

    pub(crate) fn energy(&self) -> f64 {
        self.report.stored + self.report.hourglass
    }
}

/// Where nodes are after six numbers each: a way and a rotation vector.
pub(crate) fn moved(start: &[Vector], by: &[f64]) -> (Vec<Vector>, Vec<Attitude>) {
    let own = |k: usize, first: usize| [by[6 * k + first], by[6 * k + first + 1], by[6 * k + first + 2]];
    let places = start.iter().enumerate().map(|(k, x)| minus(*x, own(k, 0).map(|d| -d)));
    (places.collect(), (0..start.len()).map(|k| Attitude::exponential(own(k, 3))).collect())
}

/// One element that goes there in `steps` equal steps.
fn led(
    element: &str,
    material: &Material,
    section: &ShellSection,
    start: &[Vector],
    directions: &[Vector],
    by: &[f64],
    steps: usize,
) -> Driven {
    let nodes: Vec<u32> = (0..start.len() as u32).collect();
    let mut one = Driven::new(element, material, section, start, &nodes, directions);
    for k in 1..=steps {
        let part: Vec<f64> = by.iter().map(|x| x * k as f64 / steps as f64).collect();
        let (places, turns) = moved(start, &part);
        one.go(&places, &turns);
    }
    one
}

/// A random element about one metre in size, warped by `rough`, with directors that differ from its normals.
pub(crate) fn random(numbers: &mut Spread, corners: usize, rough: f64) -> (Vec<Vector>, Vec<Vector>) {
    let frame = Attitude::exponential(numbers.in_3d(3.0));
    let flat: &[Vector] = if corners == 4 {
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    } else {
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.9, 0.0]]
    };
    let start: Vec<Vector> = flat.iter().map(|x| frame.turned(minus(*x, numbers.in_3d(rough)))).collect();
    let normal = frame.turned([0.0, 0.0, 1.0]);
    let directors = start.iter().map(|_| unit(minus(normal, numbers.in_3d(rough)))).collect();
    (start, directors)
}

pub(crate) fn motion(numbers: &mut Spread, corners: usize, size: f64) -> Vec<f64> {
    (0..6 * corners).map(|_| numbers.between(-size, size)).collect()
}

#[test]
fn forces_and_moments_of_rubber_are_the_slope_of_the_energy() {
    let mut numbers = Spread::new(1);
    for (element, corners) in ELEMENTS {
        for law in ["neo_hookean", "yeoh"] {
            for _ in 0..12 {
                let (start, directors) = random(&mut numbers, corners, 0.15);
                let by = motion(&mut numbers, corners, 0.15);
                let (rubber, section) = (material(law, 0.3), section(numbers.between(0.02, 0.3)));
                let at = |by: &[f64]| led(element, &rubber, &section, &start, &directors, by, 1);
                let pulls = at(&by).pulls();
                let size = pulls.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
                for k in 0..6 * corners {
                    // A small rotation after the large one.
                    let near = |step: f64| {
                        let (mut places, mut turns) = moved(&start, &by);
                        let mut axis = [0.0; 3];
                        axis[k % 3] = step;
                        if k % 6 < 3 {
                            places[k / 6][k % 3] += step;
                        } else {
                            turns[k / 6] = Attitude::exponential(axis).after(&turns[k / 6]);
                        }
                        let nodes: Vec<u32> = (0..corners as u32).collect();
                        let mut one = Driven::new(element, &rubber, &section, &start, &nodes, &directors);
                        one.go(&places, &turns);
                        one.energy()
                    };
                    let slope = (near(1e-5) - near(-1e-5)) / 2e-5;
                    assert!(
                        (pulls[k] + slope).abs() < 1e-6 * size + 1e-8 * YOUNG * section.thickness,
                        "{element} {law} {k}: {} for {} of {size}",
                        pulls[k],
                        -slope
                    );
                }
            }
        }
    }
}

#[test]
fn forces_and_their_moments_vanish_together_for_every_law() {
    let mut numbers = Spread::new(3);
    for (element, corners) in ELEMENTS {
        for law in solids() {
            let (start, directors) = random(&mut numbers, corners, 0.1);
            let by = motion(&mut numbers, corners, 0.1);
            let one = led(element, &material(law.name, 0.3), &section(0.1), &start, &directors, &by, 20);
            let pulls = one.pulls();
            let size = pulls.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
            assert!(size > 1e-4 * YOUNG * 0.1 && pulls.iter().all(|pull| pull.is_finite()), "{}: {pulls:?}", law.name);
            let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
            for (x, pull) in one.positions.iter().zip(pulls.as_chunks::<6>().0) {
                let [a, b, c, l, m, n] = *pull;
                let lever = cross(*x, [a, b, c]);
                force = [force[0] + a, force[1] + b, force[2] + c];
                moment = [moment[0] + lever[0] + l, moment[1] + lever[1] + m, moment[2] + lever[2] + n];
            }
            assert!(force.iter().all(|f| f.abs() < 2e-14 * size), "{element} {}: {force:?} of {size}", law.name);
            assert!(moment.iter().all(|f| f.abs() < 5e-14 * size), "{element} {}: {moment:?} of {size}", law.name);
        }
    }
}

#[test]
fn a_turn_of_any_size_in_one_step_is_no_strain() {
    let mut numbers = Spread::new(5);
    for (element, corners) in ELEMENTS {
        for law in ["elastic", "j2", "neo_hookean", "orthotropic_elastic", "viscoelastic", "chaboche"] {
            for turn in [0.3, 1.0, 3.0, 40.0] {
                let (start, directors) = random(&mut numbers, corners, 0.2);
                let turn = Attitude::exponential(unit(numbers.in_3d(1.0)).map(|x| turn * x));
                let nodes: Vec<u32> = (0..corners as u32).collect();
                let mut one = Driven::new(element, &material(law, 0.3), &section(0.05), &start, &nodes, &directors);
                let turned: Vec<Vector> = start.iter().map(|x| minus(turn.turned(*x), [3.0, -7.0, 1.0])).collect();
                one.go(&turned, &vec![turn; corners]);
                let state = one.block.state(0);
                assert!(state.stress.iter().all(|s| s.abs() < 1e-12 * YOUNG), "{element} {law}: {:?}", state.stress);
                assert!(one.pulls().iter().all(|pull| pull.abs() < 1e-12 * YOUNG * 0.05), "{element} {law}");
            }
        }
    }
}

#[test]
fn results_do_not_depend_on_how_corners_are_numbered() {
    let mut numbers = Spread::new(7);
    for (element, corners) in ELEMENTS {
        for law in ["j2", "orthotropic_elastic", "neo_hookean"] {
            let (start, directors) = random(&mut numbers, corners, 0.1);
            let by = motion(&mut numbers, corners, 0.1);
            let of = |order: &[usize], flip: f64| {
                let pick = |all: &[Vector]| -> Vec<Vector> { order.iter().map(|&k| all[k]).collect() };
                let by: Vec<f64> = order.iter().flat_map(|&k| by[6 * k..6 * k + 6].to_vec()).collect();
                let directors: Vec<Vector> = pick(&directors).into_iter().map(|d| d.map(|x| flip * x)).collect();
                let pulls = led(element, &material(law, 0.3), &section(0.1), &pick(&start), &directors, &by, 20).pulls();
                let mut back = vec![0.0; 6 * corners];
                for (place, &k) in order.iter().enumerate() {
                    back[6 * k..6 * k + 6].copy_from_slice(&pulls[6 * place..6 * place + 6]);
                }
                back
            };
            let own: Vec<usize> = (0..corners).collect();
            let first = of(&own, 1.0);
            let size = first.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
            let reversed: Vec<usize> = own.iter().rev().copied().collect();
            for shift in 0..corners {
                // The axes of a material are turned about the normal.
                let sides = if law == "orthotropic_elastic" { 1 } else { 2 };
                for (order, flip) in [(&own, 1.0), (&reversed, -1.0)].into_iter().take(sides) {
                    let mut order = order.clone();
                    order.rotate_left(shift);
                    let other = of(&order, flip);
                    let worst = first.iter().zip(&other).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
                    assert!(worst < 1e-11 * size, "{element} {law} {order:?}: {worst} of {size}");
                }
            }
        }
    }
}

#[test]
fn a_model_that_is_turned_has_turned_forces() {
    let mut numbers = Spread::new(9);
    for (element, corners) in ELEMENTS {
        for law in ["j2", "neo_hookean", "viscoelastic"] {
            for _ in 0..5 {
                let (start, directors) = random(&mut numbers, corners, 0.25);
                let by = motion(&mut numbers, corners, 0.1);
                let turn = Attitude::exponential(numbers.in_3d(3.0));
                let turned = |all: &[Vector]| -> Vec<Vector> { all.iter().map(|x| turn.turned(*x)).collect() };
                let six = |all: &[f64]| -> Vec<f64> { turned(all.as_chunks::<3>().0).as_flattened().to_vec() };
                let of = |start: &[Vector], directors: &[Vector], by: &[f64]| {
                    led(element, &material(law, 0.3), &section(0.1), start, directors, by, 20).pulls()
                };
                let first = six(&of(&start, &directors, &by));
                let other = of(&turned(&start), &turned(&directors), &six(&by));
                let size = first.iter().fold(0.0, |size: f64, pull| size.max(pull.abs()));
                let worst = first.iter().zip(&other).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
                assert!(worst < 1e-11 * size, "{element} {law}: {worst} of {size}");
            }
        }
    }
}

/// Largest of M⁻¹K at the start of an element, by the response to small motions, and four over the square of
/// the step.
pub(crate) fn frequency_and_bound(make: impl Fn() -> Driven) -> [f64; 2] {
    let one = make();
    let (start, corners) = (one.positions.clone(), one.positions.len());
    let masses: Vec<f64> = (0..corners).map(|corner| one.block.corner_mass(0, corner)).collect();
    let inertia: Vec<f64> = one.block.rotating_nodes().iter().map(|(_, inertia)| *inertia).collect();
    let mass: Vec<f64> = (0..6 * corners).map(|k| if k % 6 < 3 { masses[k / 6] } else { inertia[k / 6] }).collect();
    let h = 1e-7;
    let columns: Vec<Vec<f64>> = (0..6 * corners)
        .map(|k| {
            let mut by = vec![0.0; 6 * corners];
            by[k] = h;
            let (mut own, (places, turns)) = (make(), moved(&start, &by));
            own.go(&places, &turns);
            own.pulls().iter().map(|pull| -pull / h).collect()
        })
        .collect();
    let k = |i: usize, j: usize| 0.5 * (columns[j][i] + columns[i][j]) / (mass[i] * mass[j]).sqrt();
    let matrix = (0..6 * corners).map(|i| (0..6 * corners).map(|j| k(i, j)).collect()).collect();
    let largest = eigenvalues(matrix).into_iter().fold(0.0, f64::max);
    [largest, 4.0 / one.report.time_step_squared]
}

#[test]
fn the_step_bounds_the_frequency_of_any_element() {
    let mut numbers = Spread::new(11);
    for (element, corners) in ELEMENTS {
        let (mut most, mut least) = (0.0f64, f64::INFINITY);
        for case in 0..150 {
            let thickness = 10f64.powf(numbers.between(-3.0, 0.3));
            let rough = [0.0, 0.1, 0.2, 0.25][case % 4];
            let (mut start, directions) = random(&mut numbers, corners, rough);
            // Long ones too.
            let stretch = [1.0, 3.0, 10.0][case % 3];
            let along = unit(minus(start[1], start[0]));
            start.iter_mut().for_each(|x| {
                let part = (stretch - 1.0) * dot(*x, along);
                *x = minus(*x, along.map(|a| -part * a));
            });
            let directions = if case % 2 == 0 || stretch > 1.0 { Vec::new() } else { directions };
            let elastic = material("elastic", numbers.between(0.0, 0.49));
            let [frequency, bound] = frequency_and_bound(|| {
                let nodes: Vec<u32> = (0..corners as u32).collect();
                Driven::new(element, &elastic, &section(thickness), &start, &nodes, &directions)
            });
            assert!(frequency < 1.0001 * bound, "{element} {case} {start:?} {thickness}: {frequency} over {bound}");
            (most, least) = (most.max(frequency / bound), least.min(frequency / bound));
        }
        println!("{element}: true over bound {least} to {most}");
        assert!(least > 0.25, "{element}: {least}");
    }
}

/// MacNeal and Harder's patch: its nodes, quadrilaterals or triangles.
fn patch(corners: usize) -> (Vec<Vector>, Vec<u32>) {
    let x = [[0.0, 0.0], [0.24, 0.0], [0.24, 0.12], [0.0, 0.12], [0.04, 0.02], [0.18, 0.03], [0.16, 0.08], [0.08, 0.08]];
    let quads: [[u32; 4]; 5] = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]];
    let cells =
        if corners == 4 { quads.as_flattened().to_vec() } else { quads.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect() };
    (x.iter().map(|&[x, y]| [x, y, 0.0]).collect(), cells)
}

#[test]
fn patches_have_the_stress_and_the_moments_of_their_motion() {
    let mut steel = material("elastic", 0.25);
    steel.parameters.insert("young".into(), 1e6);
    let section = section(0.001);
    for (element, corners) in ELEMENTS {
        let (start, cells) = patch(corners);
        let small = 1e-3;
        let at = |place: &dyn Fn(Vector) -> [f64; 6]| {
            let mut sheet = Driven::new(element, &steel, &section, &start, &cells, &[]);
            let by: Vec<f64> = start.iter().flat_map(|x| place(*x).map(|value| small * value)).collect();
            let (places, turns) = moved(&start, &by);
            sheet.go(&places, &turns);
            let elements = sheet.block.elements();
            let all: Vec<[f64; 9]> = (0..elements).map(|element| sheet.block.state(element).shell).collect();
            (all, sheet)
        };
        let check = |all: &[[f64; 9]], expected: &[(usize, f64)], what: &str, tolerance: f64| {
            for values in all {
                for &(k, value) in expected {
                    assert!((values[k] / small - value).abs() < tolerance * value.abs().max(1e-9), "{element} {what} {k}: {values:?}");
                }
            }
        };
        // Membrane.
        let (all, _) = at(&|[x, y, _]| [1e-3 * (x + 0.5 * y), 1e-3 * (y + 0.5 * x), 0.0, 0.0, 0.0, 0.0]);
        check(&all, &[(0, 4.0 / 3.0), (1, 4.0 / 3.0), (2, 0.4)], "membrane", 1e-5);
        // Bending: w and its slopes; the node turns by (∂w/∂y, −∂w/∂x).
        let (all, sheet) = at(&|[x, y, _]| [0.0, 0.0, 5e-4 * (x * x + x * y + y * y), 1e-3 * (y + 0.5 * x), -1e-3 * (x + 0.5 * y), 0.0]);
        // Convex downwards: the upper face is compressed.
        check(&all, &[(3, 1e-6 / 9.0), (4, 1e-6 / 9.0), (5, 1e-7 / 3.0)], "bending", 1e-4);
        let inner = |k: usize, size: f64| sheet.pulls()[6 * k..6 * k + 6].iter().map(move |pull| pull.abs() / size).fold(0.0, f64::max);
        println!("{element}: bending, unbalanced at inner nodes {:?}", [4, 5, 6, 7].map(|k| inner(k, small * 1e-7)));
        // Transverse shear.
        let (all, _) = at(&|[x, ..]| [0.0, 0.0, 1e-3 * x, 0.0, 0.0, 0.0]);
        let factor = 5.0 / 6.0;
        if corners == 4 {
            check(&all, &[(6, factor * 0.4e6 * 1e-3 * 1e-3)], "shear", 1e-4);
        }
        // Twist: κ_xy alone; no transverse shear in rectangles.
        let (all, _) = at(&|[x, y, _]| [0.0, 0.0, 1e-3 * x * y, 1e-3 * x, -1e-3 * y, 0.0]);
        check(&all, &[(5, 2e-7 / 3.0)], "twist", 1e-4);
    }
}
