//! Linear benchmarks of shells in 3D: the stiffness of meshes by differences, solved directly, against values
//! of the literature and closed forms.

use crate::shells::section;
use crate::shells_in_space::Driven;
use embate_solver::block::BlockInput;
use embate_solver::model::{Material, ShellSection};
use embate_solver::rigid::space::Attitude;
use std::f64::consts::FRAC_PI_2;

type Vector = [f64; 3];

/// A mesh of n × m quadrilaterals (or twice as many triangles), held and loaded.
pub(crate) struct Problem {
    sheet: Driven,
    /// More of the same nodes.
    pub(crate) twins: Vec<Driven>,
    pub(crate) start: Vec<Vector>,
    pub(crate) cells: Vec<u32>,
    corners: usize,
    size: [usize; 2],
    held: Vec<bool>,
    pub(crate) load: Vec<f64>,
}

pub(crate) fn elastic(young: f64, poisson: f64) -> Material {
    let mut material = crate::patches::material("elastic", poisson);
    material.parameters.insert("young".into(), young);
    material
}

impl Problem {
    fn new(
        element: &str,
        size: [usize; 2],
        material: &Material,
        thickness: f64,
        smooth: bool,
        at: impl Fn(f64, f64) -> [Vector; 2],
    ) -> Self {
        Self::of(element, size, material, (&section(thickness), &[]), smooth, at)
    }

    /// With a section, and the materials of its layers.
    pub(crate) fn of(
        element: &str,
        [n, m]: [usize; 2],
        material: &Material,
        (section, layers): (&ShellSection, &[&Material]),
        smooth: bool,
        at: impl Fn(f64, f64) -> [Vector; 2],
    ) -> Self {
        let points: Vec<[Vector; 2]> =
            (0..=m).flat_map(|j| (0..=n).map(move |i| (i, j))).map(|(i, j)| at(i as f64 / n as f64, j as f64 / m as f64)).collect();
        let start: Vec<Vector> = points.iter().map(|point| point[0]).collect();
        let node = |i: usize, j: usize| (j * (n + 1) + i) as u32;
        let quads = (0..m).flat_map(|j| (0..n).map(move |i| (i, j)));
        let quads = quads.map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
        let corners = if element == "shell3" { 3 } else { 4 };
        let cells: Vec<u32> = quads.flat_map(|[a, b, c, d]| if corners == 4 { vec![a, b, c, d] } else { vec![a, b, c, a, c, d] }).collect();
        // Else the mean of the elements around each node.
        let directions: Vec<Vector> = cells.iter().filter(|_| smooth).map(|&node| points[node as usize][1]).collect();
        let input =
            BlockInput { section: Some(section), layers, directions: &directions, ..BlockInput::new(element, material, &cells, &start) };
        let sheet = Driven::of(&input);
        let count = 6 * start.len();
        Self { sheet, twins: Vec::new(), start, cells, corners, size: [n, m], held: vec![false; count], load: vec![0.0; count] }
    }

    pub(crate) fn node(&self, i: usize, j: usize) -> usize {
        j * (self.size[0] + 1) + i
    }

    /// Holds these of u_x u_y u_z ω_x ω_y ω_z at all nodes where `on` says so.
    pub(crate) fn hold(&mut self, on: impl Fn(usize, usize) -> bool, which: &[usize]) {
        for j in 0..=self.size[1] {
            for i in (0..=self.size[0]).filter(|&i| on(i, j)) {
                let node = self.node(i, j);
                which.iter().for_each(|k| self.held[6 * node + k] = true);
            }
        }
    }

    /// A force by area at the corners of the elements.
    fn press(&mut self, force: Vector) {
        let area = |a: Vector, b: Vector| {
            let c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            0.5 * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]).sqrt()
        };
        let between = |a: u32, b: u32, x: &[Vector]| std::array::from_fn(|k| x[b as usize][k] - x[a as usize][k]);
        for nodes in self.cells.chunks_exact(self.corners) {
            let x = &self.start;
            let whole = if self.corners == 4 {
                area(between(nodes[0], nodes[2], x), between(nodes[1], nodes[3], x))
            } else {
                area(between(nodes[0], nodes[1], x), between(nodes[0], nodes[2], x))
            };
            for &node in nodes {
                (0..3).for_each(|k| self.load[6 * node as usize + k] += force[k] * whole / self.corners as f64);
            }
        }
    }

    /// Displacements and rotations.
    pub(crate) fn solve(&mut self) -> Vec<f64> {
        let count = self.load.len();
        let still = vec![Attitude::default(); self.start.len()];
        let mut matrix = vec![vec![0.0; count]; count];
        let h = 1e-6;
        for k in (0..count).filter(|&k| !self.held[k]) {
            let mut pulls = [1.0, -1.0].map(|sign| {
                let (mut places, mut turns) = (self.start.clone(), still.clone());
                if k % 6 < 3 {
                    places[k / 6][k % 3] += sign * h;
                } else {
                    let mut axis = [0.0; 3];
                    axis[k % 3] = sign * h;
                    turns[k / 6] = Attitude::exponential(axis);
                }
                // Elastic in rate form: from the start again.
                let mut pulls = vec![0.0; count];
                for sheet in std::iter::once(&mut self.sheet).chain(&mut self.twins) {
                    sheet.go(&places, &turns);
                    pulls.iter_mut().zip(sheet.pulls()).for_each(|(sum, own)| *sum += own);
                    sheet.go(&self.start, &still);
                }
                pulls
            });
            let [plus, minus] = &mut pulls;
            for (i, (plus, minus)) in plus.iter().zip(minus.iter()).enumerate() {
                matrix[i][k] = (minus - plus) / (2.0 * h);
            }
        }
        // The spin about a director holds nothing.
        let most = (0..count).filter(|k| k % 6 > 2).map(|k| matrix[k][k]).fold(0.0, f64::max);
        for k in 0..count {
            if self.held[k] {
                matrix[k].fill(0.0);
                matrix.iter_mut().for_each(|row| row[k] = 0.0);
                matrix[k][k] = 1.0;
            } else if k % 6 > 2 {
                matrix[k][k] += 1e-10 * most;
            }
        }
        let load: Vec<f64> = self.load.iter().zip(&self.held).map(|(load, held)| if *held { 0.0 } else { *load }).collect();
        cholesky(matrix, load)
    }

    fn displacement(&mut self, i: usize, j: usize, k: usize) -> f64 {
        let node = self.node(i, j);
        self.solve()[6 * node + k]
    }
}

/// Solves A x = b, with the symmetric part of A.
fn cholesky(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for i in 0..n {
        for j in 0..i {
            a[i][j] = 0.5 * (a[i][j] + a[j][i]);
        }
    }
    for i in 0..n {
        let (before, rest) = a.split_at_mut(i);
        let row = &mut rest[0];
        for j in 0..=i {
            let other: &[f64] = if j == i { &row[..] } else { &before[j] };
            let sum: f64 = row[..j].iter().zip(&other[..j]).map(|(x, y)| x * y).sum();
            row[j] = if i == j { (row[i] - sum).sqrt() } else { (row[j] - sum) / other[j] };
        }
    }
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| a[i][k] * b[k]).sum();
        b[i] = (b[i] - sum) / a[i][i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| a[k][i] * b[k]).sum();
        b[i] = (b[i] - sum) / a[i][i];
    }
    b
}

fn roof(element: &str, n: usize, smooth: bool) -> f64 {
    let mut roof = Problem::new(element, [n, n], &elastic(4.32e8, 0.0), 0.25, smooth, |u, v| {
        let (sin, cos) = (40.0f64.to_radians() * u).sin_cos();
        [[25.0 * sin, 25.0 * v, 25.0 * cos], [sin, 0.0, cos]]
    });
    roof.hold(|_, j| j == 0, &[0, 2]);
    roof.hold(|_, j| j == n, &[1, 3, 5]);
    roof.hold(|i, _| i == 0, &[0, 4, 5]);
    roof.press([0.0, 0.0, -90.0]);
    -roof.displacement(n, n, 2) / 0.3024
}

fn cylinder(element: &str, n: usize, smooth: bool) -> f64 {
    let mut cylinder = Problem::new(element, [n, n], &elastic(3e6, 0.3), 3.0, smooth, |u, v| {
        let (sin, cos) = (FRAC_PI_2 * u).sin_cos();
        [[300.0 * sin, 300.0 * v, 300.0 * cos], [sin, 0.0, cos]]
    });
    cylinder.hold(|_, j| j == 0, &[0, 2]);
    cylinder.hold(|_, j| j == n, &[1, 3, 5]);
    cylinder.hold(|i, _| i == 0, &[0, 4, 5]);
    cylinder.hold(|i, _| i == n, &[2, 3, 4]);
    let node = cylinder.node(0, n);
    cylinder.load[6 * node + 2] = -0.25;
    -cylinder.displacement(0, n, 2) / 1.8248e-5
}

/// With directors that lean by half an element at its free rims it would lock: 0.08 with n = 4.
fn hemisphere(element: &str, n: usize) -> f64 {
    let mut shell = Problem::new(element, [n, n], &elastic(6.825e7, 0.3), 0.04, true, |u, v| {
        let ((sin, cos), (up, out)) = ((FRAC_PI_2 * u).sin_cos(), (72.0f64.to_radians() * v).sin_cos());
        let normal = [out * cos, out * sin, up];
        [normal.map(|x| 10.0 * x), normal]
    });
    shell.hold(|i, _| i == 0, &[1, 3, 5]);
    shell.hold(|i, _| i == n, &[0, 4, 5]);
    shell.hold(|i, j| i == 0 && j == 0, &[2]);
    let (one, other) = (shell.node(0, 0), shell.node(n, 0));
    (shell.load[6 * one], shell.load[6 * other + 1]) = (1.0, -1.0);
    shell.displacement(0, 0, 0) / 0.094
}

/// Tip displacement in the plane of its end and across it.
fn twisted_beam(element: &str, thickness: f64, [n, m]: [usize; 2]) -> [f64; 2] {
    [2, 1].map(|along| {
        let mut beam = Problem::new(element, [n, m], &elastic(29e6, 0.22), thickness, true, |u, v| {
            let (sin, cos) = (FRAC_PI_2 * u).sin_cos();
            let width = 1.1 * (v - 0.5);
            // x_u × x_v.
            let (du, dv) = ([12.0, -FRAC_PI_2 * width * sin, FRAC_PI_2 * width * cos], [0.0, cos, sin]);
            let n = [du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2], du[0] * dv[1] - du[1] * dv[0]];
            let size = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            [[12.0 * u, width * cos, width * sin], n.map(|x| x / size)]
        });
        beam.hold(|i, _| i == 0, &[0, 1, 2, 3, 4, 5]);
        let tip = beam.node(n, m / 2);
        beam.load[6 * tip + along] = 1.0;
        beam.displacement(n, m / 2, along)
    })
}

/// A clamped square plate under a uniform load, over the thin plate's middle.
fn plate(element: &str, n: usize, slenderness: f64, rough: f64) -> f64 {
    let (young, poisson) = (1e6, 0.3);
    let mut numbers = crate::patches::Spread::new(17);
    let shift: Vec<[f64; 2]> = (0..(n + 1) * (n + 1)).map(|_| numbers.vector(0.5 * rough / n as f64)).collect();
    let mut plate = Problem::new(element, [n, n], &elastic(young, poisson), slenderness, true, |u, v| {
        let inside = [u, v].iter().all(|x| *x > 0.0 && *x < 1.0);
        let [a, b] = if inside { shift[((v * n as f64).round() as usize) * (n + 1) + (u * n as f64).round() as usize] } else { [0.0; 2] };
        [[0.5 * (u + a), 0.5 * (v + b), 0.0], [0.0, 0.0, 1.0]]
    });
    plate.hold(|i, j| i == n || j == n, &[0, 1, 2, 3, 4, 5]);
    plate.hold(|i, _| i == 0, &[0, 4, 5]);
    plate.hold(|_, j| j == 0, &[1, 3, 5]);
    plate.press([0.0, 0.0, 1.0]);
    let stiffness = young * slenderness.powi(3) / (12.0 * (1.0 - poisson * poisson));
    plate.displacement(0, 0, 2) * stiffness / 0.001_265_32
}

pub(crate) fn is_near(what: &str, value: f64, expected: f64, tolerance: f64) {
    println!("{what}: {value:.4}, expected {expected}");
    assert!((value / expected - 1.0).abs() < tolerance, "{what}: {value} instead of {expected}");
}

#[test]
fn roofs_cylinders_and_hemispheres_bend_as_in_the_literature() {
    for (n, expected) in [(4, 0.961), (8, 1.003)] {
        is_near("roof, shell4", roof("shell4", n, false), expected, 0.01);
    }
    for (n, expected) in [(4, 0.371), (8, 0.750)] {
        is_near("pinched cylinder, shell4", cylinder("shell4", n, false), expected, 0.01);
    }
    // With the normals of the surface itself, as symmetry planes give them, they are as near.
    is_near("roof, its normals", roof("shell4", 12, true), 1.0, 0.012);
    is_near("hemisphere, its normals", hemisphere("shell4", 12), 0.994, 0.01);
    is_near("roof, shell4_full", roof("shell4_full", 12, false), 1.0, 0.03);
    is_near("hemisphere, shell4_full", hemisphere("shell4_full", 12), 1.0, 0.05);
    is_near("roof, shell3", roof("shell3", 8, false), 0.853, 0.02);
    // Triangles of constant strain come from below: 0.737 with mean directions (a prototype), less of it with
    // the normals.
    is_near("pinched cylinder, shell3", cylinder("shell3", 8, true), 1.0, 0.12);
}

#[test]
fn a_twisted_beam_is_right_though_its_elements_are_warped() {
    let [inside, across] = twisted_beam("shell4", 0.32, [12, 2]);
    is_near("in the plane", inside, 5.400e-3, 0.005);
    is_near("across", across, 1.727e-3, 0.005);
    let [inside, across] = twisted_beam("shell4", 0.0032, [12, 2]).map(|x| 1e-6 * x);
    is_near("in the plane, thin", inside, 5.147e-3, 0.01);
    is_near("across, thin", across, 1.266e-3, 0.01);
}

#[test]
fn clamped_plates_neither_lock_nor_soften() {
    for (n, expected) in [(4, 0.996), (8, 1.000)] {
        is_near("plate, shell4", plate("shell4", n, 0.01, 0.0), expected, 0.004);
    }
    is_near("very thin plate, shell4", plate("shell4", 8, 0.001, 0.0), 0.998, 0.004);
    is_near("distorted plate, shell4", plate("shell4", 8, 0.01, 0.3), 1.0, 0.01);
    is_near("plate, shell4_full", plate("shell4_full", 8, 0.01, 0.0), 1.0, 0.01);
    is_near("very thin plate, shell4_full", plate("shell4_full", 8, 0.001, 0.0), 1.0, 0.01);
    is_near("distorted plate, shell4_full", plate("shell4_full", 8, 0.01, 0.3), 1.0, 0.015);
    for (n, expected) in [(4, 1.012), (8, 1.005)] {
        is_near("plate, shell3", plate("shell3", n, 0.01, 0.0), expected, 0.01);
    }
}
