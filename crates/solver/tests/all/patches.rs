//! What the contract tests are made on: numbers, materials for any registered law, patches for any registered
//! element, and a block with its nodes.

use embate_lanes::{Level, Team};
use embate_solver::block::{Block, BlockInput, Blocks, Motion, NO_NODE, Report, make};
use embate_solver::element::{ELEMENTS, ELEMENTS_OF_SPACE, Element, ElementKind, ElementVisitor, Tri6, with_element};
use embate_solver::material::{LAWS, Law, LawKind, LawVisitor, equation_of_state, with_law};
use embate_solver::model::Material;
use embate_solver::quantity::{Parameter, Range};
use embate_solver::tensor::{Dim, Space};
use std::collections::BTreeMap;

pub(crate) const YOUNG: f64 = 1000.0;
pub(crate) const DENSITY: f64 = 2.0;

/// A deterministic spread of numbers.
pub(crate) struct Spread(u64);

impl Spread {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }
    /// Uniform between the two.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
    pub(crate) fn vector(&mut self, size: f64) -> [f64; 2] {
        [self.between(-size, size), self.between(-size, size)]
    }
    pub(crate) fn in_3d(&mut self, size: f64) -> [f64; 3] {
        std::array::from_fn(|_| self.between(-size, size))
    }
}

/// The index at the end of a name, from zero.
fn last(name: &str) -> usize {
    name.bytes().last().map_or(0, |digit| usize::from(digit - b'1'))
}

/// A value for any parameter: known ones as above, stresses a small part of Young's modulus, the rest by
/// their range. What makes a law of another kind of it (dependence on the rate) is left out, `options` has
/// it.
fn value(parameter: &Parameter, poisson: f64) -> f64 {
    match (parameter.name, parameter.range) {
        ("density", _) => DENSITY,
        ("young", _) => YOUNG,
        ("poisson", _) => poisson,
        ("rate_reference", _) => parameter.default.unwrap_or(1.0),
        ("rate_exponent", _) => 5.0,
        ("saturation", _) => 0.02 * YOUNG,
        ("saturation_rate", _) => 20.0,
        ("strength", _) => 0.04 * YOUNG,
        ("strain_offset", _) => 0.01,
        ("hardening_exponent", _) => 0.3,
        ("rate_coefficient", _) => parameter.default.unwrap_or(0.0),
        ("temperature" | "temperature_reference", _) => 300.0,
        ("temperature_melt", _) => 1000.0,
        ("specific_heat" | "softening_exponent", _) => 1.0,
        ("friction_angle", _) => 0.5,
        ("dilation_angle", _) => 0.2,
        ("bulk", _) => YOUNG / (3.0 * (1.0 - 2.0 * poisson)),
        // Rubber: shear stiffness of the order of the bulk stiffness.
        ("c10" | "c01", _) => 0.1 * YOUNG,
        ("shear", _) => 0.3 * YOUNG,
        ("locking_stretch", _) => 2.0,
        ("young_1" | "young_2" | "young_3", _) => YOUNG * [1.0, 0.5, 0.7][last(parameter.name)],
        ("poisson_12" | "poisson_23" | "poisson_31", _) => [0.25, 0.3, 0.2][last(parameter.name)],
        ("shear_12" | "shear_23" | "shear_31", _) => YOUNG * [0.25, 0.3, 0.2][last(parameter.name)],
        ("angle", _) => 0.4,
        (_, Range::Between(low, high)) => 0.5 * (low + high),
        (_, Range::UpTo(_, high)) => high,
        _ => 0.01 * YOUNG,
    }
}

pub(crate) fn parameters(kind: &LawKind, poisson: f64) -> BTreeMap<String, f64> {
    let numbers = kind.parameters.iter().filter(|parameter| parameter.list == 0);
    numbers.map(|parameter| (parameter.name.to_string(), value(parameter, poisson))).collect()
}

/// What parameters may have besides [`parameters`]: each set makes a law of another kind.
pub(crate) fn options(kind: &LawKind) -> Vec<Vec<(&'static str, f64)>> {
    let all = [
        vec![],
        vec![("rate_reference", 50.0)],
        vec![("rate_coefficient", 0.02)],
        vec![("hardening", -0.3 * YOUNG)],
        vec![("hardening", -0.3 * YOUNG), ("rate_reference", 50.0)],
        vec![("saturation", 0.004 * YOUNG)],
        vec![("isotropic_stress", -0.005 * YOUNG)],
    ];
    let has = |name: &str| kind.parameters.iter().any(|parameter| parameter.name == name);
    all.into_iter().filter(|set| set.iter().all(|(name, _)| has(name))).collect()
}

/// Values for parameters that are lists: two ascending ones unless they must go together; curves begin at
/// zero.
fn list(parameter: &Parameter) -> Vec<f64> {
    match parameter.name {
        "plastic_strain" => vec![0.0, 0.1],
        "stress" => vec![0.01 * YOUNG, 0.02 * YOUNG],
        "damage" => vec![0.05, 3.0, -2.0, 0.02, 0.5],
        "mu" => vec![0.2 * YOUNG, -0.05 * YOUNG],
        "alpha" => vec![2.5, -3.0],
        "shear_ratio" => vec![0.3, 0.2],
        "relaxation_time" => vec![0.05, 2.0],
        _ => [0.4, 0.5].map(|factor| factor * value(parameter, 0.3)).to_vec(),
    }
}

pub(crate) fn lists(kind: &LawKind) -> BTreeMap<String, Vec<f64>> {
    let lists = kind.parameters.iter().filter(|parameter| parameter.list > 0);
    lists.map(|parameter| (parameter.name.to_string(), list(parameter))).collect()
}

pub(crate) fn material(law: &str, poisson: f64) -> Material {
    let kind = LAWS.iter().find(|kind| kind.name == law).unwrap();
    let mut lists = lists(kind);
    // What is said about bodies holds while they stand still: nothing may relax meanwhile. Laws by themselves
    // are tested with short times.
    lists.entry("relaxation_time".into()).and_modify(|times| times.fill(1e12));
    Material { law: law.into(), parameters: parameters(kind, poisson), lists, ..Material::default() }
}

/// Every law that stands by itself: a fluid has no pressure without an equation of state. With the
/// environment variable `EMBATE_LAW` only the law of that name, for who writes it.
pub(crate) fn solids() -> impl Iterator<Item = &'static LawKind> {
    let only = std::env::var("EMBATE_LAW").ok();
    assert!(only.as_ref().is_none_or(|only| LAWS.iter().any(|law| law.name == only)), "there is no law {only:?}");
    LAWS.iter()
        .filter(move |law| only.as_ref().is_none_or(|only| law.name == only))
        .filter(|law| equation_of_state(law.name).is_some_and(|[needs, _]| !needs))
}

/// Strength far beyond every load: a law that flows stays elastic.
pub(crate) fn stay_elastic(material: &mut Material) {
    let strengths = ["yield", "saturation", "strength", "cohesion", "tension_cutoff"];
    material.parameters.iter_mut().filter(|(name, _)| strengths.contains(&name.as_str())).for_each(|(_, value)| *value *= 1e5);
    material.lists.iter_mut().filter(|(name, _)| *name == "stress").for_each(|(_, list)| list.iter_mut().for_each(|value| *value *= 1e5));
}

/// One law of each family.
const ONE_OF_EACH_FAMILY: [&str; 2] = ["elastic", "neo_hookean"];

/// Calls `check(element, law)` for every element with a law of each family, and for every law in the first
/// element: elements and laws meet only in what the contract between them says, so no other pair can fail.
pub(crate) fn every_pair(check: impl FnMut(&'static str, &'static str)) {
    every_pair_of(ELEMENTS, check);
}

/// The same of these elements.
pub(crate) fn every_pair_of(elements: &'static [ElementKind], mut check: impl FnMut(&'static str, &'static str)) {
    for (number, element) in elements.iter().enumerate() {
        for law in solids().filter(|law| number == 0 || ONE_OF_EACH_FAMILY.contains(&law.name)) {
            check(element.name, law.name);
        }
    }
}

/// Whether hourglass shapes of this element meet dampers, which have no potential and no stiffness.
pub(crate) fn is_damped(element: &str) -> bool {
    element.ends_with("_viscous")
}

pub(crate) fn nodes_of(element: &str) -> usize {
    ELEMENTS.iter().chain(ELEMENTS_OF_SPACE).find(|kind| kind.name == element).unwrap().nodes()
}

struct ReferenceNodes;

impl ElementVisitor<2> for ReferenceNodes {
    type Output = Vec<[f64; 2]>;
    fn visit<E: Element<2, N, P>, const N: usize, const P: usize>(self) -> Self::Output {
        E::NODES.to_vec()
    }
}

/// Nodes of one undistorted element.
pub(crate) fn reference_nodes(element: &str) -> Vec<[f64; 2]> {
    with_element(element, ReferenceNodes).unwrap()
}

/// How far nodes of an element in 2D can move, over what those of one without nodes between its corners can.
pub(crate) fn room(element: &str) -> f64 {
    if nodes_of(element) == 6 { 0.4 } else { 1.0 }
}

/// Nodes of an element in their order around it.
pub(crate) fn around(x: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if x.len() == 6 { [0, 3, 1, 4, 2, 5].map(|k| x[k]).to_vec() } else { x.to_vec() }
}

/// Area of a polygon, counter-clockwise, by the shoelace formula.
pub(crate) fn shoelace(x: &[[f64; 2]]) -> f64 {
    let edge = |a: usize, b: usize| x[a][0] * x[b][1] - x[a][1] * x[b][0];
    0.5 * (0..x.len()).map(|a| edge(a, (a + 1) % x.len())).sum::<f64>()
}

/// Centroid of a polygon, counter-clockwise.
pub(crate) fn centroid(x: &[[f64; 2]]) -> [f64; 2] {
    let edge = |a: [f64; 2], b: [f64; 2]| (a[0] * b[1] - a[1] * b[0]) / (6.0 * shoelace(x));
    let pairs = || x.iter().zip(x.iter().cycle().skip(1));
    [0, 1].map(|d| pairs().map(|(a, b)| (a[d] + b[d]) * edge(*a, *b)).sum())
}

/// Smallest cross product of the two edges at a corner: positive for a convex polygon.
fn convexity(x: &[[f64; 2]]) -> f64 {
    let n = x.len();
    let corner = |a: usize| {
        let (b, c) = (x[(a + 1) % n], x[(a + n - 1) % n]);
        (b[0] - x[a][0]) * (c[1] - x[a][1]) - (b[1] - x[a][1]) * (c[0] - x[a][0])
    };
    (0..n).map(corner).fold(f64::INFINITY, f64::min)
}

/// A random convex element: corners moved by up to `roughness` of its half size, stretched by up to `aspect`,
/// sheared, turned.
pub(crate) fn distorted(element: &str, roughness: f64, aspect: f64, numbers: &mut Spread) -> Vec<[f64; 2]> {
    let reference = reference_nodes(element);
    if reference.len() == 6 {
        return distorted_with_middles(roughness, aspect, numbers);
    }
    loop {
        let rough = numbers.between(0.0, roughness);
        let (stretch, shear) = (numbers.between(0.0, aspect.ln()).exp(), numbers.between(-1.0, 1.0) * numbers.between(0.0, 1.5).floor());
        let (sin, cos) = numbers.between(0.0, 6.3).sin_cos();
        let corner = |&[xi, eta]: &[f64; 2], [dx, dy]: [f64; 2]| {
            let (x, y) = (xi + dx, (eta + dy) * stretch);
            let (x, y) = (x + shear * y, y);
            [cos * x - sin * y, sin * x + cos * y]
        };
        let moved: Vec<_> = reference.iter().map(|x| corner(x, numbers.vector(rough))).collect();
        if convexity(&moved) > 0.02 * stretch {
            return moved;
        }
    }
}

/// The same of a triangle with nodes between its corners: these leave the middles by up to a quarter of the
/// roughness, and no part of it is turned over.
fn distorted_with_middles(roughness: f64, aspect: f64, numbers: &mut Spread) -> Vec<[f64; 2]> {
    loop {
        let mut x = distorted("tri3", roughness, aspect, numbers);
        let rough = numbers.between(0.0, 0.25 * roughness);
        for k in 0..3 {
            let (a, b) = (x[k], x[(k + 1) % 3]);
            // Along all sides, so that slender ones have their share.
            let off: [f64; 2] = [numbers.vector(rough), numbers.vector(rough)].map(|[u, v]| u + v);
            let (e, f) = ([x[1][0] - x[0][0], x[1][1] - x[0][1]], [x[2][0] - x[0][0], x[2][1] - x[0][1]]);
            x.push([0, 1].map(|d| 0.5 * (a[d] + b[d]) + 0.5 * (off[0] * e[d] + off[1] * f[d])));
        }
        let whole = shoelace(&x[..3]);
        let parts = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]].map(|part| shoelace(&part.map(|k: usize| x[k])));
        let points = Tri6::gradients(&x.clone().try_into().unwrap()).map(|g| 0.5 * Dim::<2>::determinant(&g));
        if parts.into_iter().chain(points.map(|own| 0.25 * own)).all(|part| part > 0.02 * whole) {
            return x;
        }
    }
}

/// A patch of `n` × `n` unit cells with displaced inner nodes.
#[derive(Clone)]
pub(crate) struct Patch<const D: usize = 2> {
    pub(crate) positions: Vec<[f64; D]>,
    pub(crate) connectivity: Vec<u32>,
    pub(crate) inner: Vec<usize>,
}

pub(crate) fn patch(element: &str, n: usize, roughness: f64) -> Patch {
    let mut numbers = Spread::new(7);
    let side = n + 1;
    let is_inner = |k: usize| (1..n).contains(&(k % side)) && (1..n).contains(&(k / side));
    let place = |k: usize| {
        let [dx, dy] = if is_inner(k) { numbers.vector(roughness) } else { [0.0; 2] };
        [(k % side) as f64 + dx, (k / side) as f64 + dy]
    };
    let mut positions: Vec<[f64; 2]> = (0..side * side).map(place).collect();
    let cells = (0..n * n).map(|k| ((k / n) * side + k % n) as u32);
    let corners = cells.map(|a| [a, a + 1, a + 1 + side as u32, a + side as u32]);
    let connectivity = match nodes_of(element) {
        3 => corners.flat_map(|[a, b, c, d]| [a, b, c, a, c, d]).collect(),
        4 => corners.flatten().collect(),
        6 => {
            let cells: Vec<u32> = corners.flat_map(|[a, b, c, d]| [a, b, c, a, c, d]).collect();
            with_middles(&mut positions, &cells)
        }
        nodes => panic!("teach the patch an element of {nodes} nodes"),
    };
    let is_within = |x: &[f64; 2]| x.iter().all(|x| (1e-9..n as f64 - 1e-9).contains(x));
    let inner = (0..positions.len()).filter(|&k| if k < side * side { is_inner(k) } else { is_within(&positions[k]) }).collect();
    Patch { positions, connectivity, inner }
}

/// Triangles of six nodes from those of three, with straight edges.
pub(crate) fn with_middles(positions: &mut Vec<[f64; 2]>, connectivity: &[u32]) -> Vec<u32> {
    let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let mut all = Vec::new();
    for &[a, b, c] in connectivity.as_chunks().0 {
        all.extend([a, b, c]);
        for [a, b] in [[a, b], [b, c], [c, a]] {
            all.push(*middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                let (a, b) = (positions[a as usize], positions[b as usize]);
                positions.push([0, 1].map(|d| 0.5 * (a[d] + b[d])));
                positions.len() as u32 - 1
            }));
        }
    }
    all
}

/// A block with the state that its nodes have brought it to.
pub(crate) struct Body<const D: usize = 2> {
    pub(crate) block: Box<dyn Block<D>>,
    pub(crate) positions: Vec<[f64; D]>,
    pub(crate) slots: Vec<[f64; D]>,
    pub(crate) report: Report,
    pub(crate) level: Level,
    pub(crate) team: Team,
    connectivity: Vec<u32>,
    nodes_per_element: usize,
}

impl<const D: usize> Body<D>
where
    Dim<D>: Blocks<D>,
{
    pub(crate) fn new(element: &str, material: &Material, positions: &[[f64; D]], connectivity: &[u32]) -> Self {
        Self::made(&BlockInput::new(element, material, connectivity, positions))
    }

    /// Whatever block was asked for.
    pub(crate) fn made(input: &BlockInput<'_, D>) -> Self {
        let BlockInput { element, connectivity, positions, .. } = *input;
        let block = make(input).unwrap();
        let slots = vec![[0.0; D]; block.slots().len()];
        let mut body = Self {
            block,
            positions: positions.to_vec(),
            slots,
            report: Report::NOTHING,
            level: Level::SCALAR,
            team: Team::alone(),
            connectivity: connectivity.to_vec(),
            nodes_per_element: nodes_of(element),
        };
        body.go(positions, &vec![[0.0; D]; positions.len()], 0.0);
        body
    }

    /// One element with its own nodes.
    pub(crate) fn single(element: &str, material: &Material, positions: &[[f64; D]]) -> Self {
        Self::new(element, material, positions, &(0..positions.len() as u32).collect::<Vec<_>>())
    }

    pub(crate) fn of(element: &str, material: &Material, patch: &Patch<D>) -> Self {
        Self::new(element, material, &patch.positions, &patch.connectivity)
    }

    /// One step to the new positions.
    pub(crate) fn move_to(&mut self, positions: &[[f64; D]]) {
        let time_step = 1.0 / 64.0; // exact, so that velocities are as exact as displacements
        let velocity = |(x, old): (&[f64; D], &[f64; D])| std::array::from_fn(|d| (x[d] - old[d]) / time_step);
        let velocities: Vec<_> = positions.iter().zip(&self.positions).map(velocity).collect();
        self.go(positions, &velocities, time_step);
    }

    fn go(&mut self, positions: &[[f64; D]], velocities: &[[f64; D]], time_step: f64) {
        let motion = Motion::new(positions, velocities, time_step);
        self.report = self.block.advance(&motion, self.level, embate_solver::block::NodalForces::new(&mut self.slots), &mut self.team);
        self.positions = positions.to_vec();
    }

    /// One step with these velocities.
    pub(crate) fn advance(&mut self, velocities: &[[f64; D]], time_step: f64) {
        for (x, v) in self.positions.iter_mut().zip(velocities) {
            *x = std::array::from_fn(|d| x[d] + v[d] * time_step);
        }
        let motion = Motion::new(&self.positions, velocities, time_step);
        self.report = self.block.advance(&motion, self.level, embate_solver::block::NodalForces::new(&mut self.slots), &mut self.team);
    }

    /// One step in which every node goes to `to(x)`.
    pub(crate) fn map(&mut self, to: impl Fn([f64; D]) -> [f64; D]) {
        let positions: Vec<_> = self.positions.iter().map(|&x| to(x)).collect();
        self.move_to(&positions);
    }

    /// Sum of the forces at every node.
    pub(crate) fn forces(&self) -> Vec<[f64; D]> {
        let mut forces = vec![[0.0; D]; self.positions.len()];
        for (&node, force) in self.block.slots().iter().zip(&self.slots).filter(|(node, _)| **node != NO_NODE) {
            for d in 0..D {
                forces[node as usize][d] += force[d];
            }
        }
        forces
    }

    /// Mass of every node.
    pub(crate) fn masses(&self) -> Vec<f64> {
        let mut masses = vec![0.0; self.positions.len()];
        for (k, &node) in self.connectivity.iter().enumerate() {
            masses[node as usize] += self.block.corner_mass(k / self.nodes_per_element, k % self.nodes_per_element);
        }
        masses
    }

    /// Stored and dissipated energy, with that of hourglass control.
    pub(crate) fn energy(&self) -> f64 {
        self.report.stored + self.report.dissipated + self.report.hourglass
    }
}

/// Slope of the stress in uniaxial strain along x, from rest: K + 4µ/3, where all directions are alike.
pub(crate) fn modulus_along_x(element: &str, material: &Material) -> f64 {
    const STRAIN: f64 = 1e-7;
    let mut body = Body::single(element, material, &reference_nodes(element));
    body.map(|[x, y]| [x * (1.0 + STRAIN), y]);
    body.block.state(0).stress[0] / STRAIN
}

/// Whether the law answers alike in all directions at rest.
pub(crate) fn is_isotropic(law: &str) -> bool {
    struct Ask;
    impl LawVisitor for Ask {
        type Output = bool;
        fn visit<M: Law>(self) -> bool {
            M::ISOTROPIC
        }
    }
    with_law(law, Ask).unwrap()
}

/// Tangent stiffness K_ij = −∂f_i/∂x_j by central differences; `make_body` must give the same body every
/// time.
pub(crate) fn stiffness<const D: usize>(make_body: impl Fn() -> Body<D>) -> Vec<Vec<f64>>
where
    Dim<D>: Blocks<D>,
{
    let start = make_body().positions;
    let size = start.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
    let h = 1e-6 * size;
    let columns = (0..D * start.len()).map(|j| {
        let side = |sign: f64| {
            let mut body = make_body();
            let mut positions = start.clone();
            positions[j / D][j % D] += sign * h;
            body.move_to(&positions);
            body.forces()
        };
        let (plus, minus) = (side(1.0), side(-1.0));
        (0..D * start.len()).map(|i| (minus[i / D][i % D] - plus[i / D][i % D]) / (2.0 * h)).collect()
    });
    columns.collect()
}

/// Eigenvalues of a symmetric matrix, ascending.
pub(crate) fn eigenvalues(a: Vec<Vec<f64>>) -> Vec<f64> {
    let n = a.len();
    eigenvalues_at(a, 0..n)
}

/// Some of the eigenvalues of a symmetric matrix, by their places in ascending order: Householder's
/// reflections make it tridiagonal, and bisection with Sturm's sequence finds each value to the rounding of
/// the largest one.
fn eigenvalues_at(a: Vec<Vec<f64>>, places: std::ops::Range<usize>) -> Vec<f64> {
    let n = a.len();
    let (diagonal, beside) = tridiagonal(a);
    let reach = |k: usize| beside[k].abs() + if k > 0 { beside[k - 1].abs() } else { 0.0 };
    let bound = (0..n).map(|k| diagonal[k].abs() + reach(k)).fold(0.0, f64::max);
    let count_below = |x: f64| {
        let (mut count, mut q) = (0, 1.0);
        for k in 0..n {
            q = diagonal[k] - x - if k > 0 { beside[k - 1] * beside[k - 1] / q } else { 0.0 };
            count += usize::from(q < 0.0);
            if q == 0.0 {
                q = f64::EPSILON * bound;
            }
        }
        count
    };
    let value = |k: usize| {
        let (mut low, mut high) = (-bound, bound);
        while high - low > f64::EPSILON * bound {
            let middle = 0.5 * (low + high);
            if count_below(middle) > k {
                high = middle;
            } else {
                low = middle;
            }
        }
        0.5 * (low + high)
    };
    places.map(value).collect()
}

/// Diagonal, and what is beside it (the last entry is 0), of a tridiagonal matrix with the eigenvalues of a
/// symmetric one.
fn tridiagonal(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<f64>) {
    let n = a.len();
    let mut beside = vec![0.0; n];
    for k in 0..n.saturating_sub(1) {
        let mut v: Vec<f64> = a[k + 1..].iter().map(|row| row[k]).collect();
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        beside[k] = -length.copysign(v[0]);
        v[0] -= beside[k];
        let square = v.iter().map(|x| x * x).sum::<f64>();
        if square == 0.0 {
            continue;
        }
        let of = |row: &[f64], v: &[f64]| row.iter().zip(v).map(|(a, b)| a * b).sum::<f64>();
        let mut w: Vec<f64> = a[k + 1..].iter().map(|row| 2.0 * of(&row[k + 1..], &v) / square).collect();
        let along = of(&w, &v) / square;
        w.iter_mut().zip(&v).for_each(|(w, v)| *w -= along * v);
        for (i, row) in a[k + 1..].iter_mut().enumerate() {
            row[k + 1..].iter_mut().enumerate().for_each(|(j, a)| *a -= v[i] * w[j] + w[i] * v[j]);
        }
    }
    ((0..n).map(|k| a[k][k]).collect(), beside)
}

/// Largest eigenvalue of M⁻¹K.
pub(crate) fn frequency_squared(stiffness: &[Vec<f64>], masses: &[f64]) -> f64 {
    let d = stiffness.len() / masses.len();
    let entry = |i: usize, j: usize| 0.5 * (stiffness[i][j] + stiffness[j][i]) / (masses[i / d] * masses[j / d]).sqrt();
    let n = stiffness.len();
    let scaled = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    eigenvalues_at(scaled, n - 1..n)[0]
}
