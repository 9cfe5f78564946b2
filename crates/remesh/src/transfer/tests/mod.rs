//! Meshes for the tests, and tests of the pieces.

mod nodes;
mod points;

use super::clip::TURN;
use super::supermesh::weights;
use super::{Failure, NewNodes, OldNodes, Order, PointMap, Points, Side, Supermesh, Values};
use crate::plane::{Cell, Measure, Mesh, Point, corners, cross, minus};
use crate::shared::random::Random;

#[derive(Clone, Debug)]
pub(super) struct Made {
    pub(super) positions: Vec<Point>,
    pub(super) cells: Vec<Cell>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Quads,
    Triangles,
    Both,
}

impl Made {
    pub(super) fn mesh(&self) -> Mesh<'_> {
        Mesh { positions: &self.positions, cells: &self.cells }
    }

    /// The unit square in nx × ny cells; nodes are moved by a part of a cell's side, those of the outline
    /// along it.
    pub(super) fn square(nx: usize, ny: usize, part: f64, kind: Kind, random: &mut Random) -> Self {
        let mut positions = Vec::new();
        for j in 0..=ny {
            for i in 0..=nx {
                let mut x = [i as f64 / nx as f64, j as f64 / ny as f64];
                let (dx, dy) = (part * random.next() / nx as f64, part * random.next() / ny as f64);
                if i > 0 && i < nx {
                    x[0] += dx;
                }
                if j > 0 && j < ny {
                    x[1] += dy;
                }
                positions.push(x);
            }
        }
        let mut cells = Vec::new();
        for j in 0..ny {
            for i in 0..nx {
                let a = (j * (nx + 1) + i) as u32;
                let up = nx as u32 + 1;
                let [a, b, c, d] = [a, a + 1, a + 1 + up, a + up];
                let is_cut = kind == Kind::Triangles || kind == Kind::Both && random.next() > 0.0;
                if !is_cut {
                    cells.push([a, b, c, d]);
                } else if random.next() > 0.0 {
                    cells.extend([[a, b, c, c], [a, c, d, d]]);
                } else {
                    cells.extend([[a, b, d, d], [b, c, d, d]]);
                }
            }
        }
        Self { positions, cells }
    }

    pub(super) fn map(mut self, to: impl Fn(Point) -> Point) -> Self {
        self.positions.iter_mut().for_each(|x| *x = to(*x));
        self
    }

    /// Masses of corners (all alike in a cell) and nodes for densities of cells.
    pub(super) fn masses(&self, measure: Measure, density: impl Fn(usize) -> f64) -> (Vec<[f64; 4]>, Vec<f64>) {
        let mut nodal = vec![0.0; self.positions.len()];
        let mut of_corners = Vec::new();
        for (index, cell) in self.cells.iter().enumerate() {
            let nodes = corners(cell);
            let mass = density(index) * self.volume(index, measure) / nodes.len() as f64;
            let mut masses = [0.0; 4];
            for (mass_of, &node) in masses.iter_mut().zip(nodes) {
                *mass_of = mass;
                nodal[node as usize] += mass;
            }
            of_corners.push(masses);
        }
        (of_corners, nodal)
    }

    pub(super) fn volume(&self, cell: usize, measure: Measure) -> f64 {
        let nodes = corners(&self.cells[cell]);
        let at = |k: usize| self.positions[nodes[k] as usize];
        (1..nodes.len() - 1)
            .map(|k| {
                let area = 0.5 * cross(minus(at(k), at(0)), minus(at(k + 1), at(0)));
                area * if measure == Measure::Plane { 1.0 } else { TURN / 3.0 * (at(0)[0] + at(k)[0] + at(k + 1)[0]) }
            })
            .sum()
    }

    pub(super) fn total(&self, measure: Measure) -> f64 {
        (0..self.cells.len()).map(|cell| self.volume(cell, measure)).sum()
    }
}

pub(super) fn turned(angle: f64) -> impl Fn(Point) -> Point {
    move |x| [angle.cos() * x[0] - angle.sin() * x[1], angle.sin() * x[0] + angle.cos() * x[1]]
}

/// A ring sector of radii 1 and 2, and half a turn, in cells across and along.
pub(super) fn ring(across: usize, along: usize, random: &mut Random) -> Made {
    Made::square(along, across, 0.2, Kind::Quads, random).map(|x| {
        let (angle, r) = (std::f64::consts::PI * (1.0 - x[0]), 1.0 + x[1]);
        [r * angle.cos(), r * angle.sin()]
    })
}

#[test]
fn pieces_fill_both_meshes() {
    let mut random = Random::new(1);
    for measure in [Measure::Plane, Measure::Revolution] {
        for kind in [Kind::Quads, Kind::Triangles, Kind::Both] {
            let old = Made::square(8, 8, 0.3, kind, &mut random);
            let new = Made::square(11, 9, 0.3, Kind::Both, &mut random);
            let whole = if measure == Measure::Plane { 1.0 } else { 0.5 * TURN };
            let supermesh = Supermesh::new(old.mesh(), new.mesh(), measure).unwrap();
            let error = supermesh.volume() / whole - 1.0;
            assert!(error.abs() < 1e-14, "{measure:?} {kind:?}: {error:e}");
            let [outside, missing] = supermesh.mismatch();
            assert!(outside == 0.0 && missing < 1e-14, "{outside:e} {missing:e}");
            let mut of_old = vec![0.0; old.cells.len()];
            let mut of_new = vec![0.0; new.cells.len()];
            for overlap in &supermesh.overlaps {
                let volume: f64 = overlap.own.iter().flatten().sum();
                of_old[supermesh.old[overlap.old as usize].cell as usize] += volume;
                of_new[supermesh.new[overlap.new as usize].cell as usize] += volume;
            }
            for (made, sums) in [(&old, &of_old), (&new, &of_new)] {
                for (cell, sum) in sums.iter().enumerate() {
                    let error = sum / made.volume(cell, measure) - 1.0;
                    assert!(error.abs() < 2e-14, "{measure:?} {kind:?} cell {cell}: {error:e}");
                }
            }
        }
    }
}

/// λ_i³ gives A/10, λ_i² λ_j A/30, λ_1 λ_2 λ_3 A/60; in the plane λ_i² A/6 and λ_i λ_j A/12.
#[test]
fn weights_are_integrals_of_products() {
    let area = 0.7;
    let c = weights(area, [1.0, 0.0, 0.0], Measure::Revolution);
    let expected = [[10.0, 30.0, 30.0], [30.0, 30.0, 60.0], [30.0, 60.0, 30.0]];
    let plane = weights(area, [1.0, 0.0, 0.0], Measure::Plane);
    for i in 0..3 {
        for j in 0..3 {
            let error = c[i][j] * expected[i][j] / (TURN * area) - 1.0;
            assert!(error.abs() < 1e-15, "{i} {j}: {error:e}");
            assert_eq!(plane[i][j], area / if i == j { 6.0 } else { 12.0 });
        }
    }
}

/// Time by piece and by new cell, for 10,000 cells of 4 points.
#[test]
#[ignore = "a measurement of time"]
fn time_of_ten_thousand_cells() {
    let mut random = Random::new(5);
    let old = Made::square(100, 100, 0.25, Kind::Quads, &mut random);
    let new = Made::square(97, 103, 0.25, Kind::Quads, &mut random);
    let velocities: Vec<Point> = old.positions.iter().map(|x| [x[0] * x[1], x[1] * x[1] - x[0]]).collect();
    let (corner_mass, node_mass) = old.masses(Measure::Plane, |_| 1.0);
    let held = vec![[None; 2]; new.positions.len()];
    for measure in [Measure::Plane, Measure::Revolution] {
        let start = std::time::Instant::now();
        let supermesh = Supermesh::new(old.mesh(), new.mesh(), measure).unwrap();
        let cut = start.elapsed().as_secs_f64();
        let of_old = OldNodes { mesh: old.mesh(), corner_mass: &corner_mass, node_mass: &node_mass, velocities: &velocities, spare: 0.0 };
        if measure == Measure::Plane {
            super::nodes(&supermesh, &of_old, &NewNodes { mesh: new.mesh(), held: &held }).unwrap();
        }
        let solved = start.elapsed().as_secs_f64();
        let of = |made| Points { mesh: Made::mesh(made), points: 4 };
        let map = PointMap::new(&of(&old), &of(&new), measure).unwrap();
        let mapped = start.elapsed().as_secs_f64();
        let values: Vec<f64> = (0..8 * 4 * old.cells.len()).map(|_| random.next()).collect();
        map.values(&Values { values: &values, width: 8, densities: None, order: Order::Linear, limits: None }).unwrap();
        let all = start.elapsed().as_secs_f64();
        let cells = new.cells.len() as f64;
        println!(
            "{measure:?}: {} pieces, {:.0} ns each; by cell: pieces {:.1} µs, nodes {:.1} µs, points {:.1} µs, 8 values {:.1} µs",
            supermesh.pieces(),
            1e9 * cut / supermesh.pieces() as f64,
            1e6 * cut / cells,
            1e6 * (solved - cut) / cells,
            1e6 * (mapped - solved) / cells,
            1e6 * (all - mapped) / cells
        );
        assert!(cut / (supermesh.pieces() as f64) < 3e-6, "{cut} s for {} pieces", supermesh.pieces());
    }
}

/// Overlaps of cells against the share of points of a fine grid that are in both.
#[test]
fn overlaps_are_those_of_counted_points() {
    let mut random = Random::new(2);
    let old = Made::square(3, 2, 0.35, Kind::Quads, &mut random);
    let new = Made::square(2, 4, 0.35, Kind::Both, &mut random);
    let is_in = |made: &Made, cell: usize, x: Point| {
        let nodes = corners(&made.cells[cell]);
        let at = |k: usize| made.positions[nodes[k % nodes.len()] as usize];
        (0..nodes.len())
            .filter(|&k| {
                let (a, b) = (at(k), at(k + 1));
                (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
            })
            .count()
            % 2
            == 1
    };
    let side = 1500;
    let mut counted = vec![vec![0u32; new.cells.len()]; old.cells.len()];
    for i in 0..side {
        for j in 0..side {
            let x = [(i as f64 + 0.5) / side as f64, (j as f64 + 0.5) / side as f64];
            let e = (0..old.cells.len()).find(|&e| is_in(&old, e, x)).unwrap();
            let k = (0..new.cells.len()).find(|&k| is_in(&new, k, x)).unwrap();
            counted[e][k] += 1;
        }
    }
    let supermesh = Supermesh::new(old.mesh(), new.mesh(), Measure::Plane).unwrap();
    let mut areas = vec![vec![0.0; new.cells.len()]; old.cells.len()];
    for overlap in &supermesh.overlaps {
        let (old, new) = (supermesh.old[overlap.old as usize].cell, supermesh.new[overlap.new as usize].cell);
        areas[old as usize][new as usize] += overlap.own.iter().flatten().sum::<f64>();
    }
    for (e, (areas, counted)) in areas.iter().zip(&counted).enumerate() {
        for (k, (area, &count)) in areas.iter().zip(counted).enumerate() {
            let error = area - f64::from(count) / (side * side) as f64;
            assert!(error.abs() < 1e-4, "cells {e} and {k}: {area} differs by {error:e}");
        }
    }
}

/// Cells of an aspect of 100, turned, of 1e-9 and 1e9 m, far from the origin.
#[test]
fn pieces_of_slender_tiny_and_huge_cells_fill_both_meshes() {
    let mut random = Random::new(3);
    for scale in [1e-9, 1.0, 1e9] {
        for angle in [0.0, 0.3, 1.1] {
            let to = |x: Point| turned(angle)([scale * (x[0] + 3.0), 0.01 * scale * (x[1] - 2.0)]);
            let old = Made::square(9, 7, 0.3, Kind::Quads, &mut random).map(to);
            let new = Made::square(6, 10, 0.3, Kind::Both, &mut random).map(to);
            let supermesh = Supermesh::new(old.mesh(), new.mesh(), Measure::Plane).unwrap();
            let error = supermesh.volume() / (0.01 * scale * scale) - 1.0;
            assert!(error.abs() < 2e-13, "scale {scale:e}, angle {angle}: {error:e}");
        }
    }
}

#[test]
fn a_corner_that_turns_inwards_is_cut_from_there() {
    let old = Made { positions: vec![[0.0, 0.0], [1.0, 0.0], [0.3, 0.3], [0.0, 1.0]], cells: vec![[0, 1, 2, 3]] };
    let new = Made { positions: old.positions.clone(), cells: vec![[1, 2, 0, 0], [0, 2, 3, 3]] };
    let supermesh = Supermesh::new(old.mesh(), new.mesh(), Measure::Plane).unwrap();
    assert!((supermesh.volume() - 0.3).abs() < 1e-15, "{}", supermesh.volume());
}

#[test]
fn what_cannot_be_carried_over_is_told() {
    let mut random = Random::new(4);
    let old = Made::square(3, 3, 0.2, Kind::Quads, &mut random);
    let failure = |old: &Made, new: &Made| Supermesh::new(old.mesh(), new.mesh(), Measure::Plane).unwrap_err();
    let larger = old.clone().map(|x| [1.5 * x[0], x[1]]);
    assert_eq!(failure(&old, &larger), Failure::Uncovered { cell: 2 });
    let mirrored = old.clone().map(|x| [-x[0], x[1]]);
    assert_eq!(failure(&old, &mirrored), Failure::Inverted { side: Side::New, cell: 0 });
    let broken = Made { positions: old.positions.clone(), cells: vec![[0, 1, 99, 99]] };
    assert_eq!(failure(&broken, &old), Failure::Size);
    let endless = old.clone().map(|x| [x[0] / 0.0, x[1]]);
    assert!(matches!(failure(&endless, &old), Failure::Inverted { side: Side::Old, .. }));
    let none = Made { positions: Vec::new(), cells: Vec::new() };
    assert_eq!(failure(&none, &old), Failure::Uncovered { cell: 0 });
    assert_eq!(failure(&old, &none), Failure::Size);
    let beyond = old.clone().map(|x| [x[0] - 2.0, x[1]]);
    let found = Supermesh::new(beyond.mesh(), beyond.mesh(), Measure::Revolution).unwrap_err();
    assert_eq!(found, Failure::Inverted { side: Side::Old, cell: 0 });
}
