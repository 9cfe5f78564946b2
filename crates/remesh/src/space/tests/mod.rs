//! Meshes for the tests, and tests of the pieces.

mod nodes;
mod points;

use super::vector::{dot, minus, six_volumes};
use super::{Cell, Failure, Kind, Mesh, NewNodes, OldNodes, Order, Point, PointMap, Points, Rule, Side, Values};
use crate::shared::random::Random;

#[derive(Clone, Debug)]
pub(super) struct Made {
    pub(super) positions: Vec<Point>,
    pub(super) cells: Vec<Cell>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kinds {
    Hexahedra,
    Wedges,
    Tetrahedra,
    /// Tetrahedra of ten nodes.
    Tens,
    /// Columns of hexahedra and of wedges, tetrahedra above them.
    All,
}

impl Made {
    pub(super) fn mesh(&self) -> Mesh<'_> {
        Mesh { positions: &self.positions, cells: &self.cells }
    }

    /// The unit cube in so many cells along each side; nodes are moved by a part of a cell's side, those of
    /// the outline along it.
    pub(super) fn cube(n: [usize; 3], part: f64, kinds: Kinds, random: &mut Random) -> Self {
        let mut made = Self { positions: Vec::new(), cells: Vec::new() };
        let middle = n[2] / 2;
        for k in 0..=n[2] {
            for j in 0..=n[1] {
                for i in 0..=n[0] {
                    let at = [i, j, k];
                    let mut x = [0.0; 3];
                    for d in 0..3 {
                        let shift = part * random.next();
                        let is_fixed = at[d] == 0 || at[d] == n[d] || kinds == Kinds::All && d == 2 && k == middle;
                        x[d] = (at[d] as f64 + if is_fixed { 0.0 } else { shift }) / n[d] as f64;
                    }
                    made.positions.push(x);
                }
            }
        }
        let columns: Vec<bool> = (0..n[0] * n[1]).map(|_| random.next() > 0.0).collect();
        for k in 0..n[2] {
            for j in 0..n[1] {
                for i in 0..n[0] {
                    let node = |a: usize, b: usize, c: usize| (((k + c) * (n[1] + 1) + j + b) * (n[0] + 1) + i + a) as u32;
                    let all = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
                        .map(|[a, b, c]| node(a, b, c));
                    let kind = match kinds {
                        Kinds::Hexahedra => Kind::Hexahedron,
                        Kinds::Wedges => Kind::Wedge,
                        Kinds::Tetrahedra | Kinds::Tens => Kind::Tetrahedron,
                        Kinds::All if k >= middle => Kind::Tetrahedron,
                        Kinds::All if columns[j * n[0] + i] => Kind::Wedge,
                        Kinds::All => Kind::Hexahedron,
                    };
                    made.add(kind, all);
                }
            }
        }
        if kinds == Kinds::Tens {
            made.with_middles();
        }
        made
    }

    /// A hexahedron, two wedges or six tetrahedra.
    fn add(&mut self, kind: Kind, n: [u32; 8]) {
        let parts: &[&[usize]] = match kind {
            Kind::Wedge => &[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]],
            Kind::Tetrahedron => &[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]],
            _ => &[&[0, 1, 2, 3, 4, 5, 6, 7]],
        };
        for part in parts {
            let nodes: Vec<u32> = part.iter().map(|&k| n[k]).collect();
            self.cells.push(Cell::new(kind, &nodes).unwrap());
        }
    }

    /// Gives tetrahedra nodes in the middles of their edges.
    fn with_middles(&mut self) {
        let ends = |cell: &Cell, [a, b]: [u8; 2]| {
            let (a, b) = (cell.nodes()[usize::from(a)], cell.nodes()[usize::from(b)]);
            [a.min(b), a.max(b)]
        };
        let mut edges: Vec<[u32; 2]> = self.cells.iter().flat_map(|cell| super::kind::EDGES.map(|edge| ends(cell, edge))).collect();
        edges.sort_unstable();
        edges.dedup();
        let first = self.positions.len() as u32;
        for [a, b] in &edges {
            let (a, b) = (self.positions[*a as usize], self.positions[*b as usize]);
            self.positions.push([0, 1, 2].map(|k| 0.5 * (a[k] + b[k])));
        }
        for cell in &mut self.cells {
            let mut nodes = cell.nodes().to_vec();
            nodes.extend(super::kind::EDGES.map(|edge| first + edges.binary_search(&ends(cell, edge)).unwrap() as u32));
            *cell = Cell::new(Kind::Tetrahedron10, &nodes).unwrap();
        }
    }

    pub(super) fn map(mut self, to: impl Fn(Point) -> Point) -> Self {
        self.positions.iter_mut().for_each(|x| *x = to(*x));
        self
    }

    /// By the triangles of its faces.
    pub(super) fn volume(&self, cell: usize) -> f64 {
        let cell = &self.cells[cell];
        let x: Vec<Point> = cell.nodes().iter().map(|&node| self.positions[node as usize]).collect();
        let mean = |all: &[Point]| [0, 1, 2].map(|k| all.iter().map(|x| x[k]).sum::<f64>() / all.len() as f64);
        let centre = mean(&x);
        let mut sum = 0.0;
        let mut add = |a: Point, b: Point, c: Point| sum -= six_volumes(&[a, b, c, centre]) / 6.0;
        for face in cell.kind().faces() {
            let corners: Vec<Point> = face.iter().map(|&k| x[usize::from(k)]).collect();
            let count = corners.len();
            if cell.kind() == Kind::Tetrahedron10 {
                let middles: Vec<Point> = (0..3)
                    .map(|k| {
                        let (a, b) = (face[k], face[(k + 1) % 3]);
                        x[4 + super::kind::EDGES.iter().position(|edge| edge.contains(&a) && edge.contains(&b)).unwrap()]
                    })
                    .collect();
                (0..3).for_each(|k| add(corners[k], middles[k], middles[(k + 2) % 3]));
                add(middles[0], middles[1], middles[2]);
            } else {
                let middle = mean(&corners);
                (0..count).for_each(|k| add(corners[k], corners[(k + 1) % count], middle));
            }
        }
        sum
    }

    /// Masses of cells and nodes (alike in a cell; ∫ ρ N of straight tetrahedra) for densities of cells.
    pub(super) fn masses(&self, density: impl Fn(usize) -> f64) -> (Vec<f64>, Vec<f64>) {
        let mut nodal = vec![0.0; self.positions.len()];
        let of_cells: Vec<f64> = (0..self.cells.len()).map(|cell| density(cell) * self.volume(cell)).collect();
        for (cell, mass) in self.cells.iter().zip(&of_cells) {
            let count = cell.nodes().len();
            for (k, &node) in cell.nodes().iter().enumerate() {
                nodal[node as usize] += mass
                    * if count < 10 {
                        1.0 / count as f64
                    } else if k < 4 {
                        1.0 / 32.0
                    } else {
                        7.0 / 48.0
                    };
            }
        }
        (of_cells, nodal)
    }
}

/// Turned about an axis that is none of the coordinates'.
pub(super) fn turned(angle: f64) -> impl Fn(Point) -> Point {
    let axis = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
    move |x| {
        let (across, along) = (super::vector::cross(axis, x), dot(axis, x));
        [0, 1, 2].map(|k| angle.cos() * x[k] + angle.sin() * across[k] + (1.0 - angle.cos()) * along * axis[k])
    }
}

/// A quarter of a pipe of radii 1 and 2 and of length 1, in cells across, around and along.
pub(super) fn pipe(n: [usize; 3], kinds: Kinds, random: &mut Random) -> Made {
    Made::cube(n, 0.15, kinds, random).map(|x| {
        let (angle, r) = (0.5 * std::f64::consts::PI * x[1], 1.0 + x[0]);
        [r * angle.cos(), r * angle.sin(), x[2]]
    })
}

pub(super) fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, |most: f64, value| most.max(value.abs()))
}

pub(super) const KINDS: [Kinds; 5] = [Kinds::Hexahedra, Kinds::Wedges, Kinds::Tetrahedra, Kinds::Tens, Kinds::All];

/// The parts of an old and a new mesh that pieces fill, each cell by its volume.
#[test]
fn pieces_fill_both_meshes() {
    let mut random = Random::new(1);
    let mut worst: f64 = 0.0;
    for (k, kinds) in KINDS.into_iter().enumerate() {
        for scale in [1.0, 1e-9, 1e9] {
            let to = |x: Point| turned(0.7)([scale * (x[0] + 1.0), 0.1 * scale * x[1], scale * x[2]]);
            let old = Made::cube([3, 2, 3], 0.25, kinds, &mut random).map(to);
            let new = Made::cube([2, 3, 3], 0.25, KINDS[(k + 2) % 5], &mut random).map(to);
            let (cell_mass, node_mass) = old.masses(|_| 1.0);
            let (velocities, held) = (vec![[1.0; 3]; old.positions.len()], vec![[None; 3]; new.positions.len()]);
            let of_old = OldNodes { mesh: old.mesh(), cell_mass: &cell_mass, node_mass: &node_mass, velocities: &velocities, spare: 0.0 };
            let found = super::nodes(&of_old, &NewNodes { mesh: new.mesh(), held: &held }).unwrap();
            let of_new = largest(found.cell_mass.iter().enumerate().map(|(cell, mass)| mass / new.volume(cell) - 1.0));
            let map =
                PointMap::new(&Points { mesh: old.mesh(), rule: Rule::Full }, &Points { mesh: new.mesh(), rule: Rule::Full }).unwrap();
            let [before, after] = map.weights(None, Order::Constant).unwrap();
            let whole = 0.1 * scale * scale * scale;
            let sums = [&before, &after].map(|all| all.iter().sum::<f64>() / whole - 1.0);
            let s: Vec<f64> = (0..new.cells.len())
                .map(|c| {
                    let l =
                        super::tets::local(Box::leak(Box::new(super::cut::Plan::all(super::cut::Cut::Cells))), new.mesh(), c, Side::New)
                            .unwrap();
                    l.volumes.iter().sum::<f64>() / new.volume(c) - 1.0
                })
                .collect();
            if found.mismatch[1] > 1e-13 * whole {
                println!("DEBUG {s:?}");
            }
            let mismatch = largest(found.mismatch.into_iter()) / whole;
            assert!(of_new < 1e-13, "{kinds:?} {scale:e}: {of_new:e}");
            assert!(mismatch < 1e-13 && found.mismatch[0] == 0.0, "{kinds:?} {scale:e}: {:?}", found.mismatch);
            assert!(largest(sums.into_iter()) < 1e-13, "{kinds:?} {scale:e}: {sums:?}");
            worst = worst.max(of_new).max(largest(sums.into_iter()));
        }
    }
    println!("closure: {worst:e}");
}

/// The volume of a warped hexahedron is that of 2 × 2 × 2 points, in parts too.
#[test]
fn warped_hexahedra_have_their_trilinear_volume() {
    let mut random = Random::new(2);
    let made = Made::cube([3, 3, 3], 0.3, Kinds::Hexahedra, &mut random);
    let of = Points { mesh: made.mesh(), rule: Rule::Full };
    let [by_points, _] = PointMap::new(&of, &of).unwrap().weights(None, Order::Linear).unwrap();
    let [by_parts, _] = PointMap::new(&of, &of).unwrap().weights(None, Order::Constant).unwrap();
    for cell in 0..made.cells.len() {
        let sum = |all: &[f64]| all[8 * cell..8 * cell + 8].iter().sum::<f64>() / made.volume(cell) - 1.0;
        assert!(sum(&by_points).abs() < 1e-13 && sum(&by_parts).abs() < 1e-13);
        let x: Vec<Point> = made.cells[cell].nodes().iter().map(|&node| made.positions[node as usize]).collect();
        assert!((jacobians(&x) / made.volume(cell) - 1.0).abs() < 1e-13);
    }
}

/// Sum of the Jacobians at the points of 2 × 2 × 2.
fn jacobians(x: &[Point]) -> f64 {
    let gauss = 1.0 / 3.0f64.sqrt();
    let at = |point: Point| {
        let mut sides = [[0.0; 3]; 4];
        for (corner, sign) in super::kind::SIGNS.iter().enumerate() {
            let along: [f64; 3] = [0, 1, 2].map(|k| 1.0 + sign[k] * point[k] * gauss);
            let slopes = [sign[0] * along[1] * along[2], sign[1] * along[2] * along[0], sign[2] * along[0] * along[1]];
            (0..3).for_each(|d| (0..3).for_each(|k| sides[d + 1][k] += 0.125 * slopes[d] * x[corner][k]));
        }
        six_volumes(&sides)
    };
    super::kind::SIGNS.map(at).iter().sum()
}

/// A hexahedron from whose mean of corners a face is seen from outside has a centre elsewhere.
#[test]
fn badly_distorted_cells_have_another_centre() {
    let mut random = Random::new(3);
    let mut old = Made::cube([3, 3, 3], 0.0, Kinds::Hexahedra, &mut random);
    // A corner far within: the three faces at it look away from the middle.
    let node = old.cells[13].nodes()[6] as usize;
    old.positions[node] = [(1.0 + 0.36) / 3.0; 3];
    let new = Made::cube([3, 3, 3], 0.1, Kinds::Hexahedra, &mut random);
    let field = |x: &Point| [x[1], 2.0 * x[2], x[0]];
    let held = vec![[None; 3]; new.positions.len()];
    for (old, new) in [(&old, &new), (&new, &old)] {
        let (cell_mass, node_mass) = old.masses(|_| 1.0);
        let velocities: Vec<Point> = old.positions.iter().map(field).collect();
        let of_old = OldNodes { mesh: old.mesh(), cell_mass: &cell_mass, node_mass: &node_mass, velocities: &velocities, spare: 0.0 };
        let found = super::nodes(&of_old, &NewNodes { mesh: new.mesh(), held: &held }).unwrap();
        let most = largest(new.positions.iter().zip(&found.velocities).flat_map(|(x, v)| minus(*v, field(x))));
        assert!(most < 1e-12, "{most:e}");
        let masses = largest(found.cell_mass.iter().enumerate().map(|(cell, mass)| mass / new.volume(cell) - 1.0));
        assert!(masses < 1e-13, "{masses:e}");
    }
}

#[test]
fn what_cannot_be_carried_over_is_told() {
    let mut random = Random::new(4);
    let old = Made::cube([2, 2, 2], 0.2, Kinds::Hexahedra, &mut random);
    let failure = |old: &Made, new: &Made| {
        let [old, new] = [old, new].map(|made| Points { mesh: Made::mesh(made), rule: Rule::Full });
        PointMap::new(&old, &new).unwrap_err()
    };
    let larger = old.clone().map(|x| [3.0 * x[0], x[1], x[2]]);
    assert_eq!(failure(&old, &larger), Failure::Uncovered { cell: 1 });
    let mirrored = old.clone().map(|x| [-x[0], x[1], x[2]]);
    assert_eq!(failure(&old, &mirrored), Failure::Inverted { side: Side::New, cell: 0 });
    let mut broken = old.clone();
    broken.cells[3] = Cell::new(Kind::Tetrahedron, &[0, 1, 3, 99]).unwrap();
    assert_eq!(failure(&broken, &old), Failure::Size);
    assert_eq!(failure(&old, &broken), Failure::Size);
    for value in [f64::NAN, f64::INFINITY, 1e300] {
        let endless = old.clone().map(|x| [if x[0] == 0.0 { value } else { x[0] }, x[1], x[2]]);
        assert!(matches!(failure(&endless, &old), Failure::Inverted { side: Side::Old, .. }));
        assert!(matches!(failure(&old, &endless), Failure::Inverted { side: Side::New, .. }));
    }
    let flat = old.clone().map(|x| [x[0], x[1], 0.0]);
    assert_eq!(failure(&flat, &old), Failure::Inverted { side: Side::Old, cell: 0 });
    let none = Made { positions: Vec::new(), cells: Vec::new() };
    assert_eq!(failure(&none, &old), Failure::Uncovered { cell: 0 });
    assert_eq!(failure(&old, &none), Failure::Size);
    assert!(Cell::new(Kind::Wedge, &[0; 5]).is_none() && Cell::new(Kind::Hexahedron, &[0; 11]).is_none());
    // Tetrahedra on a warped face of hexahedra overlap them.
    let [hexahedra, all] = [Kinds::Hexahedra, Kinds::All]
        .map(|kinds| Made::cube([2, 2, 2], 0.0, kinds, &mut random).map(|x| [x[0], x[1], x[2] - 0.5 * x[0] * x[1]]));
    assert!(matches!(failure(&hexahedra, &all), Failure::Overlap { .. }));
    let same = Made { positions: old.positions.clone(), cells: vec![Cell::new(Kind::Hexahedron, &[0; 8]).unwrap()] };
    assert_eq!(failure(&same, &old), Failure::Inverted { side: Side::Old, cell: 0 });
}

/// Processor time of this thread if the system gives it, else time, s.
fn seconds(start: std::time::Instant) -> f64 {
    let own = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let spent = own.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    spent.map_or(start.elapsed().as_secs_f64(), |nanoseconds| 1e-9 * nanoseconds)
}

/// Time by piece and by new cell.
#[test]
#[ignore = "a measurement of time"]
fn time_of_some_hundred_cells() {
    let mut random = Random::new(5);
    for kinds in KINDS {
        let n = 6;
        let old = Made::cube([n; 3], 0.2, kinds, &mut random);
        let new = Made::cube([n + 1, n, n - 1], 0.2, kinds, &mut random);
        let velocities: Vec<Point> = old.positions.iter().map(|x| [x[0] * x[1], x[1] * x[1] - x[0], x[2]]).collect();
        let (cell_mass, node_mass) = old.masses(|_| 1.0);
        let held = vec![[None; 3]; new.positions.len()];
        let of_old = OldNodes { mesh: old.mesh(), cell_mass: &cell_mass, node_mass: &node_mass, velocities: &velocities, spare: 0.0 };
        let cells = new.cells.len() as f64;
        let now = std::time::Instant::now();
        let start = seconds(now);
        let found = super::nodes(&of_old, &NewNodes { mesh: new.mesh(), held: &held }).unwrap();
        let of_nodes = seconds(now) - start;
        println!(
            "{kinds:?}, {} cells: nodes {:.0} µs by cell, {:.0} pieces by cell, {:.0} ns each",
            new.cells.len(),
            1e6 * of_nodes / cells,
            found.pieces as f64 / cells,
            1e9 * of_nodes / found.pieces as f64
        );
        for rule in [Rule::One, Rule::Full] {
            let start = seconds(now);
            let map = PointMap::new(&Points { mesh: old.mesh(), rule }, &Points { mesh: new.mesh(), rule }).unwrap();
            let mapped = seconds(now) - start;
            let count: usize = old.cells.iter().map(|cell| Points::of(rule, cell.kind())).sum();
            let values: Vec<f64> = (0..8 * count).map(|_| random.next()).collect();
            map.values(&Values { values: &values, width: 8, densities: None, order: Order::Linear, limits: None }).unwrap();
            let all = seconds(now) - start;
            println!(
                "  {rule:?}: map {:.0} µs by cell, 8 values {:.0} µs; {} pairs",
                1e6 * mapped / cells,
                1e6 * (all - mapped) / cells,
                map.pairs()
            );
        }
    }
}

/// Planes of both meshes that coincide, as at the ends of a pipe, leave polyhedra with flat parts.
#[test]
fn coincident_planes_do_not_add_volume() {
    let plans = super::cut::Plan::all(super::cut::Cut::Cells);
    for seed in 34..44 {
        let mut random = Random::new(seed);
        let old = pipe([2, 6, 2], Kinds::Tens, &mut random);
        let new = pipe([2, 5, 2], Kinds::Tens, &mut random);
        let tets = super::tets::Tets::of(&plans, old.mesh()).unwrap();
        let mut within = vec![0.0; tets.all.len()];
        let mut search = super::tets::Search::new(&tets);
        for cell in 0..new.cells.len() {
            let local = super::tets::local(&plans, new.mesh(), cell, Side::New).unwrap();
            for (index, volume) in local.volumes.iter().enumerate() {
                let mut own = 0.0;
                search.pieces(&super::clip::Tet::new(local.tet(index), *volume), |old, piece| {
                    let volume: f64 = piece.moments().map_or(0.0, |moments| moments.iter().sum());
                    within[old] += volume;
                    own += volume;
                });
                assert!(own <= volume * (1.0 + 1e-12), "{seed}: {own} of {volume}");
            }
        }
        let over = within.iter().zip(&tets.all).fold(0.0, |most: f64, (within, tet)| most.max(within / tet.volume - 1.0));
        assert!(over < 1e-12, "{seed}: {over:e}");
    }
}
