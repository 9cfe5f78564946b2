use super::*;
use crate::plane::{Measure, minus};
use crate::transfer::{NewNodes, OldNodes, Supermesh, nodes};

/// A channel of n × m cells from 0 to 2 along s, its surfaces at t = −½ and `up(s)`.
fn channel([n, m]: [usize; 2], up: impl Fn(f64) -> f64) -> (Vec<Point>, Vec<Cell>) {
    let mut positions = Vec::new();
    for i in 0..=n {
        let s = 2.0 * i as f64 / n as f64;
        positions.extend((0..=m).map(|j| [s, -0.5 + (up(s) + 0.5) * j as f64 / m as f64]));
    }
    let node = |i: usize, j: usize| (i * (m + 1) + j) as u32;
    let cells =
        (0..n * m).map(|k| [(k / m, k % m), (k / m + 1, k % m), (k / m + 1, k % m + 1), (k / m, k % m + 1)].map(|(i, j)| node(i, j)));
    (positions, cells.collect())
}

fn turned([c, s]: Point, positions: &[Point]) -> Vec<Point> {
    positions.iter().map(|&[x, y]| [c * x - s * y, s * x + c * y]).collect()
}

fn area(positions: &[Point], cells: &[Cell]) -> f64 {
    let of = |cell: &Cell| {
        let [a, b, c, d] = cell.map(|node| positions[node as usize]);
        0.5 * cross(minus(c, a), minus(d, b))
    };
    cells.iter().map(of).sum()
}

const DIRECTIONS: [Point; 5] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [0.6, 0.8]];

/// A mesh with a row beside it.
fn with(row: &Row, positions: &[Point], cells: &[Cell]) -> (Vec<Point>, Vec<Cell>) {
    let positions = positions.iter().chain(&row.positions).copied().collect();
    (positions, cells.iter().chain(&row.cells).copied().collect())
}

#[test]
fn a_block_that_has_moved_goes_back_to_where_it_was() {
    for direction in DIRECTIONS {
        let (places, cells) = channel([8, 3], |_| 0.5);
        let places = turned(direction, &places);
        let window = Window::new(Mesh { positions: &places, cells: &cells }, direction).unwrap();
        assert!((window.length() - 2.0).abs() < 1e-15);
        let way = 0.15;
        let moved: Vec<Point> = places.iter().map(|&[x, y]| [x + way * direction[0], y + way * direction[1]]).collect();
        let travel = window.travel(&moved);
        assert!(
            (travel.mean - way).abs() < 1e-15 && (travel.most - way / 0.25).abs() < 1e-14 && (travel.least_of_ends - way).abs() < 1e-15
        );
        let back = window.returned(&moved).unwrap();
        let off = back.positions.iter().zip(&places).map(|(&a, &b)| dot(minus(a, b), minus(a, b)).sqrt()).fold(0.0, f64::max);
        assert!(off < 2e-15, "{off}");
        if direction[0].abs() == 1.0 || direction[1].abs() == 1.0 {
            assert!(off == 0.0);
        }
        // What has come in, and what has gone out.
        for (row, positions) in [(&back.inflow, &moved), (&back.outflow, &back.positions)] {
            assert_eq!((row.cells.len(), row.positions.len()), (3, 4));
            let (positions, all) = with(row, positions, &cells);
            let each = row.cells.iter().map(|&cell| area(&positions, &[cell]));
            each.for_each(|own| assert!((own - way / 3.0).abs() < 1e-14, "{own}"));
            assert!((area(&positions, &all) - 2.0 - way).abs() < 1e-14);
        }
        // A surface node is 0.15/0.25 of an edge behind where it was.
        let shares: Vec<&[(u32, f64)]> = back.between.iter().map(|own| &own[..]).filter(|own| own.len() == 2).collect();
        assert_eq!(shares.len(), 2 * 8);
        assert!(shares.iter().all(|own| (own[0].1 - 0.6).abs() < 1e-14 && own[1].0 == own[0].0 + 4));
        assert_eq!(back.between.iter().filter(|own| own.is_empty()).count(), 7 * 2);
    }
}

#[test]
fn a_steady_surface_stays_where_it_is() {
    // Material moves along the surface t = up(s), which stays: of third order where its curvature has one
    // sign.
    let up = |s: f64| 0.5 + 0.1 * (s - 0.8) * (s - 0.8) + 0.02 * s * s * s;
    let mut last = f64::INFINITY;
    for n in [10, 20, 40] {
        let (places, cells) = channel([n, 2], up);
        let window = Window::new(Mesh { positions: &places, cells: &cells }, [1.0, 0.0]).unwrap();
        let way = 1.0 / n as f64;
        let (extended, _) = channel([n, 2], |s| up(s + way));
        let moved: Vec<Point> = extended.iter().map(|&[s, t]| [s + way, t]).collect();
        let back = window.returned(&moved).unwrap();
        let off = back.positions.iter().zip(&places).map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max);
        assert!(off < last / 6.0, "{off} after {last}");
        last = off;
    }
    assert!(last < 2e-6, "{last}");
}

#[test]
fn a_kink_of_the_surface_bulges_neither_way() {
    let up = |s: f64| if s < 1.0 { 0.5 } else { 0.5 - 0.3 * (s - 1.0) };
    let (places, cells) = channel([10, 2], up);
    let window = Window::new(Mesh { positions: &places, cells: &cells }, [1.0, 0.0]).unwrap();
    let (extended, _) = channel([10, 2], |s| up(s + 0.1));
    let moved: Vec<Point> = extended.iter().map(|&[s, t]| [s + 0.1, t]).collect();
    for [s, t] in window.returned(&moved).unwrap().positions {
        let off = t - (-0.5 + (up(s) + 0.5) * ((t + 0.5) / (up(s) + 0.5) * 2.0).round() / 2.0);
        // The kink lies within an edge now: there the chord cuts it off.
        assert!(off < 1e-15 && off > -0.3 * 0.05 - 1e-12 && (off.abs() < 1e-14 || (s - 1.0).abs() < 0.11), "{s} {t} {off}");
    }
}

#[test]
fn sums_are_kept_between_what_was_there_and_came_in_and_what_is_there_and_went_out() {
    let up = |s: f64| 0.5 + 0.1 * (1.5 * s).sin();
    for direction in DIRECTIONS {
        let (places, cells) = channel([12, 4], up);
        let places = turned(direction, &places);
        let window = Window::new(Mesh { positions: &places, cells: &cells }, direction).unwrap();
        let swirl = |x: Point| 0.02 * (3.0 * x[0] + 2.0 * x[1]).sin();
        let moved: Vec<Point> =
            places.iter().map(|&[x, y]| [x + (0.1 + swirl([x, y])) * direction[0], y + (0.1 + swirl([x, y])) * direction[1]]).collect();
        let back = window.returned(&moved).unwrap();
        let (old, old_cells) = with(&back.inflow, &moved, &cells);
        let (new, new_cells) = with(&back.outflow, &back.positions, &cells);
        let (old, new) = (Mesh { positions: &old, cells: &old_cells }, Mesh { positions: &new, cells: &new_cells });
        // Areas differ by what chords of the curved surface cut off at most: h² κ/12 of 2.
        let sag = (2.0_f64 / 12.0).powi(2) * 0.1 * 1.5 * 1.5 / 12.0 * 2.0;
        let areas = [area(old.positions, old.cells), area(new.positions, new.cells)];
        assert!((areas[0] - areas[1]).abs() < sag, "{areas:?} {sag}");
        let supermesh = Supermesh::new(old, new, Measure::Plane).unwrap();
        let mass: Vec<[f64; 4]> = old.cells.iter().map(|&cell| [0.25 * area(old.positions, &[cell]); 4]).collect();
        let mut node_mass = vec![0.0; old.positions.len()];
        old.cells
            .iter()
            .zip(&mass)
            .for_each(|(cell, mass)| cell.iter().zip(mass).for_each(|(&node, mass)| node_mass[node as usize] += mass));
        let velocities: Vec<Point> = old.positions.iter().map(|&[x, y]| [3.0 + (2.0 * x * y).sin(), (x - y).cos()]).collect();
        let held = vec![[None; 2]; new.positions.len()];
        let from = OldNodes { mesh: old, corner_mass: &mass, node_mass: &node_mass, velocities: &velocities, spare: 0.0 };
        let found = nodes(&supermesh, &from, &NewNodes { mesh: new, held: &held }).unwrap();
        let sum = |mass: &[f64], of: &dyn Fn(usize) -> f64| mass.iter().enumerate().map(|(a, mass)| mass * of(a)).sum::<f64>();
        assert!((sum(&found.mass, &|_| 1.0) - sum(&node_mass, &|_| 1.0)).abs() < 1e-13);
        for k in 0..2 {
            let [before, after] = [sum(&node_mass, &|a| velocities[a][k]), sum(&found.mass, &|a| found.velocities[a][k])];
            assert!((before - after).abs() < 1e-13 * before.abs().max(1.0), "{before} {after}");
        }
        assert!(found.kinetic_lost > -1e-13);
    }
}

#[test]
fn what_is_no_channel_is_refused() {
    let (places, cells) = channel([6, 2], |_| 0.5);
    let mesh = Mesh { positions: &places, cells: &cells };
    assert_eq!(Window::new(mesh, [0.0, 0.0]).unwrap_err(), Failure::Input);
    assert_eq!(Window::new(mesh, [f64::NAN, 0.0]).unwrap_err(), Failure::Input);
    // A hole.
    let holed: Vec<Cell> = cells.iter().enumerate().filter(|(k, _)| *k != 4).map(|(_, cell)| *cell).collect();
    assert!(Window::new(Mesh { positions: &places, cells: &holed }, [1.0, 0.0]).is_err());
    // An overhang.
    let mut bent = places.clone();
    bent[3 * 3 + 2][0] = bent[2 * 3 + 2][0] - 0.01;
    assert_eq!(Window::new(Mesh { positions: &bent, cells: &cells }, [1.0, 0.0]).unwrap_err(), Failure::Surfaces);
    let window = Window::new(mesh, [1.0, 0.0]).unwrap();
    let moved = |way: f64| places.iter().map(|&[x, y]| [x + way, y]).collect::<Vec<_>>();
    assert_eq!(window.returned(&moved(0.0)).unwrap_err(), Failure::Backwards);
    assert_eq!(window.returned(&moved(-0.1)).unwrap_err(), Failure::Backwards);
    assert_eq!(window.returned(&places[1..]).unwrap_err(), Failure::Input);
    let mut bent = moved(0.1);
    bent[3 * 3 + 2][0] = bent[2 * 3 + 2][0] - 0.01;
    assert_eq!(window.returned(&bent).unwrap_err(), Failure::Overhang);
    // A bulge of the outlet is part of it.
    let mut bulged = places.clone();
    bulged[6 * 3 + 1][0] += 0.1;
    let window = Window::new(Mesh { positions: &bulged, cells: &cells }, [1.0, 0.0]).unwrap();
    assert_eq!((window.ends[1].len(), window.surfaces[0].len(), window.surfaces[1].len()), (3, 7, 7));
}
