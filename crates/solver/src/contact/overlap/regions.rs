//! Regions where bodies overlap: what of each surface lies inside the other body, the volume between, and how
//! that changes with each node.
//!
//! Contours come from [`super::piercing`]. On either surface the part beyond a contour is found by flood over
//! edges that nothing pierces, from the ends that pierced edges have inside. With P_A, P_B those parts, n
//! their outward normals and φ_a the shape functions of vertices,
//!
//! - N = ∫_{P_A} n dA = −∫_{P_B} n dA, the gradient of the volume for a shift of A;
//! - V = ⅓ (∫_{P_A} x·n dA + ∫_{P_B} x·n dA), the volume of the overlap;
//! - ∂V/∂x_a = ∫ φ_a n dA: the motion of the contour itself adds nothing, so V is once continuously
//!   differentiable whatever features come and go.
//!
//! Integrals over parts of triangles go along their rims (Green): Σ ½ n·((p − o) × (q − o)) over straight
//! pieces from p to q, with any point o of the triangle's plane.

use super::piercing::{Piece, Piercing, contours, runs_with};
use super::skin::Skin;
use crate::contact::projection::node_facet::Vector;
use crate::forest;
use crate::mesh::surface::NONE;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};

/// An overlap of two bodies, or of two parts of one.
#[derive(Clone, Debug, Default)]
pub(super) struct Region {
    /// Both bodies, ascending.
    pub(super) bodies: [u32; 2],
    /// Triangles that lie in it as a whole or in part, ascending, and to which side each belongs.
    pub(super) triangles: Vec<(u32, bool)>,
    /// Vertices that are inside, ascending.
    pub(super) inside: Vec<u32>,
    /// Parts of pierced edges that are inside: the edge, and both ends, m.
    pub(super) chords: Vec<(u32, [Vector; 2])>,
    /// Of a body in itself, where the contour is not closed: the triangles that are pierced, ascending.
    /// Chords are those beside them then.
    pub(super) pierced: Vec<u32>,
    /// N of the first side, m².
    pub(super) area: Vector,
    /// Area, the mean of both sides, m².
    pub(super) size: f64,
    /// V, m³.
    pub(super) volume: f64,
    /// ∂V/∂x of each node (its vertex, ascending), m².
    pub(super) gradient: Vec<(u32, Vector)>,
    /// Whether the contour is not closed, or the same place is inside and outside: at borders of surfaces,
    /// and where a surface folds onto itself.
    pub(super) is_open: bool,
    /// Whether its surface is: no translation and no rotation changes V. Where a body overlaps itself, what
    /// lies in another one has no closed surface.
    pub(super) is_closed: bool,
}

impl Region {
    /// Whether a body lies in itself.
    pub(super) fn is_own(&self) -> bool {
        self.bodies[0] == self.bodies[1]
    }

    /// Whether it is of a body in itself whose contour is not closed: the flood says nothing, and piercings
    /// decide.
    pub(super) fn is_torn(&self) -> bool {
        self.is_own() && self.is_open
    }

    /// To which side a triangle of it belongs.
    pub(super) fn side(&self, triangle: u32) -> Option<bool> {
        let at = self.triangles.binary_search_by_key(&triangle, |&(triangle, _)| triangle);
        at.ok().map(|at| self.triangles[at].1)
    }
}

/// What ∂V/∂x of all nodes adds up to at most, force and moment, where the surface is closed, as a fraction
/// of their sizes. What is so small that it is all rounding is not.
const CLOSED: f64 = 1e-9;

/// Piercings of an edge that are nearer to each other than this fraction of its length have no order.
const SAME_PLACE: f64 = 1e-9;

/// Memory of the search for regions.
#[derive(Debug, Default)]
pub(super) struct Work {
    /// Per vertex, edge and triangle: the number of the pair of bodies for which it was last marked.
    inside: Vec<u32>,
    outside: Vec<u32>,
    leaky: Vec<u32>,
    pierced: Vec<u32>,
    listed: Vec<u32>,
    /// Place of each listed triangle in the list of its pair.
    slots: Vec<u32>,
    /// Row of each vertex in the gradient of a region while that is found; [`NONE`]: it has none yet.
    rows: Vec<u32>,
    pair: u32,
}

/// Disjoint sets.
#[derive(Debug, Default)]
struct Sets(Vec<u32>);

impl Sets {
    fn add(&mut self) {
        self.0.push(self.0.len() as u32);
    }

    fn find(&mut self, at: u32) -> u32 {
        forest::root(&mut self.0, at)
    }

    fn join(&mut self, a: u32, b: u32) {
        forest::join(&mut self.0, a, b);
    }
}

impl Work {
    /// All regions, in the order of their bodies and first triangles.
    pub(super) fn find(&mut self, skin: &Skin, piercings: &mut [Piercing]) -> Vec<Region> {
        let bodies = |piercing: &Piercing| {
            let [a, b] = [skin.edges[piercing.edge as usize].triangles[0], piercing.triangle].map(|triangle| skin.body(triangle));
            [a.min(b), a.max(b)]
        };
        // `along` is a number from 0 to 1: its bits ascend with it.
        piercings.sort_by_cached_key(|piercing| (bodies(piercing), piercing.edge, (piercing.along + 0.0).to_bits(), piercing.triangle));
        [&mut self.inside, &mut self.outside, &mut self.leaky].into_iter().for_each(|marks| marks.resize(skin.x.len(), 0));
        self.pierced.resize(skin.edges.len(), 0);
        self.listed.resize(skin.triangles.len(), 0);
        self.slots.resize(skin.triangles.len(), 0);
        let mut regions = Vec::new();
        for here in piercings.chunk_by(|a, b| bodies(a) == bodies(b)) {
            self.pair += 1;
            self.of_pair(skin, bodies(&here[0]), here, &mut regions);
        }
        regions
    }

    /// Marks what is inside, part by part of what nothing pierces; the inside vertices, and those where a
    /// part is outside as well: no contour closes it off. Of a body in itself such a part says nothing of the
    /// others and counts as outside.
    fn flood(&mut self, skin: &Skin, piercings: &[Piercing], is_own: bool) -> (Vec<u32>, Vec<u32>) {
        let mut seeds = Vec::new();
        for here in piercings.chunk_by(|a, b| a.edge == b.edge) {
            self.pierced[here[0].edge as usize] = self.pair;
            let Some(are_inside) = ends_inside(here) else { continue };
            for (vertex, is_inside) in skin.edges[here[0].edge as usize].ends.into_iter().zip(are_inside) {
                if is_inside {
                    seeds.push(vertex);
                } else {
                    self.outside[vertex as usize] = self.pair;
                }
            }
        }
        let (mut inside, mut stack) = (Vec::new(), Vec::new());
        for &seed in &seeds {
            if self.leaky[seed as usize] == self.pair {
                continue;
            }
            let (begin, mut leaks) = (inside.len(), false);
            stack.push(seed);
            while let Some(vertex) = stack.pop() {
                if std::mem::replace(&mut self.inside[vertex as usize], self.pair) == self.pair {
                    continue;
                }
                inside.push(vertex);
                leaks |= self.outside[vertex as usize] == self.pair;
                for &edge in skin.around.of(vertex as usize) {
                    if self.pierced[edge as usize] != self.pair {
                        let [a, b] = skin.edges[edge as usize].ends;
                        stack.push(if a == vertex { b } else { a });
                    }
                }
            }
            if leaks && is_own {
                for vertex in inside.drain(begin..) {
                    (self.inside[vertex as usize], self.leaky[vertex as usize]) = (0, self.pair);
                }
            }
        }
        inside.sort_unstable();
        if !is_own {
            let torn = inside.iter().copied().filter(|vertex| self.outside[*vertex as usize] == self.pair).collect();
            return (inside, torn);
        }
        seeds.retain(|seed| self.leaky[*seed as usize] == self.pair);
        (inside, seeds)
    }

    fn is_inside(&self, edge: u32, skin: &Skin) -> bool {
        self.pierced[edge as usize] != self.pair && skin.edges[edge as usize].ends.iter().all(|end| self.inside[*end as usize] == self.pair)
    }

    /// Puts a triangle on the list of the pair.
    fn list(&mut self, triangle: u32, all: &mut Vec<u32>) {
        if std::mem::replace(&mut self.listed[triangle as usize], self.pair) != self.pair {
            self.slots[triangle as usize] = all.len() as u32;
            all.push(triangle);
        }
    }

    fn of_pair(&mut self, skin: &Skin, bodies: [u32; 2], piercings: &[Piercing], regions: &mut Vec<Region>) {
        let is_own = bodies[0] == bodies[1];
        let (inside, torn) = self.flood(skin, piercings, is_own);
        let (mut pieces, mut pairs, mut loose) = (Vec::new(), Vec::new(), Vec::new());
        contours(skin, piercings, &mut pieces, &mut pairs, &mut loose);
        let chords = self.chords(skin, piercings, is_own, &mut pieces);
        // All triangles that are inside as a whole or in part; those in part have pieces.
        let mut triangles = Vec::new();
        let cut = pieces.iter().map(|piece| piece.triangle).chain(loose.iter().copied());
        cut.for_each(|triangle| self.list(triangle, &mut triangles));
        let parts = triangles.len();
        for &vertex in &inside {
            skin.at_vertex.of(vertex as usize).iter().for_each(|&triangle| self.list(triangle, &mut triangles));
        }
        for &triangle in &triangles[..parts] {
            for (k, &edge) in skin.edges_of[triangle as usize].iter().enumerate() {
                if self.is_inside(edge, skin) {
                    let x = skin.corners(triangle);
                    pieces.push(Piece { triangle, from: x[k], to: x[(k + 1) % 3] });
                }
            }
        }
        let (mut sides, mut whole) = (Sets::default(), Sets::default());
        for _ in &triangles {
            sides.add();
            whole.add();
        }
        for &triangle in &triangles {
            for &edge in &skin.edges_of[triangle as usize] {
                let is_open = self.pierced[edge as usize] == self.pair || self.is_inside(edge, skin);
                for other in skin.edges[edge as usize].triangles {
                    if is_open && other != NONE && self.listed[other as usize] == self.pair {
                        let [a, b] = [triangle, other].map(|triangle| self.slots[triangle as usize]);
                        sides.join(a, b);
                        whole.join(a, b);
                    }
                }
            }
        }
        pairs.iter().for_each(|pair| {
            let [a, b] = pair.map(|triangle| self.slots[triangle as usize]);
            whole.join(a, b);
        });
        let colours = if is_own {
            self.colours(&mut sides, &pairs, triangles.len())
        } else {
            triangles.iter().map(|&triangle| Some(skin.body(triangle) == bodies[1])).collect()
        };
        // Regions in the order of their first triangles.
        let mut number = vec![NONE; triangles.len()];
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        order.sort_unstable_by_key(|&slot| triangles[slot as usize]);
        let begin = regions.len();
        for &slot in &order {
            let root = whole.find(slot) as usize;
            if number[root] == NONE {
                number[root] = regions.len() as u32;
                regions.push(Region { bodies, ..Region::default() });
            }
            let region = &mut regions[number[root] as usize];
            region.is_open |= colours[slot as usize].is_none();
            region.triangles.push((triangles[slot as usize], colours[slot as usize].unwrap_or(false)));
        }
        let mut region_of = |triangle: u32, listed: &[u32], slots: &[u32]| {
            (listed[triangle as usize] == self.pair).then(|| number[whole.find(slots[triangle as usize]) as usize] as usize)
        };
        for triangle in loose.into_iter().chain(torn.iter().flat_map(|&vertex| skin.at_vertex.of(vertex as usize).iter().copied())) {
            if let Some(region) = region_of(triangle, &self.listed, &self.slots) {
                regions[region].is_open = true;
            }
        }
        for &vertex in &inside {
            let first = skin.at_vertex.of(vertex as usize).first();
            if let Some(region) = first.and_then(|&triangle| region_of(triangle, &self.listed, &self.slots)) {
                regions[region].inside.push(vertex);
            }
        }
        for chord in chords {
            let own = skin.edges[chord.0 as usize].triangles[0];
            if let Some(region) = region_of(own, &self.listed, &self.slots).filter(|&region| !regions[region].is_torn()) {
                regions[region].chords.push(chord);
            }
        }
        if regions[begin..].iter().any(Region::is_torn) {
            for (chord, pierced) in beside(skin, piercings) {
                let own = skin.edges[chord.0 as usize].triangles[0];
                if let Some(region) = region_of(own, &self.listed, &self.slots).filter(|&region| regions[region].is_torn()) {
                    regions[region].chords.push(chord);
                    regions[region].pierced.push(pierced);
                }
            }
            regions[begin..].iter_mut().for_each(|region| {
                region.pierced.sort_unstable();
                region.pierced.dedup();
            });
        }
        pieces.sort_by_key(|piece| piece.triangle);
        self.rows.resize(skin.x.len(), NONE);
        regions[begin..].iter_mut().for_each(|region| integrate(skin, region, &pieces, &mut self.rows));
    }

    /// The parts of pierced edges that are inside, which are pieces of the rims of the triangles beside them.
    fn chords(&self, skin: &Skin, piercings: &[Piercing], is_own: bool, pieces: &mut Vec<Piece>) -> Vec<(u32, [Vector; 2])> {
        let mut chords = Vec::new();
        for here in piercings.chunk_by(|a, b| a.edge == b.edge) {
            let edge = here[0].edge;
            let ends = skin.edges[edge as usize].ends;
            let [begin, end] = ends.map(|vertex| skin.x[vertex as usize]);
            let mut add = |from: Vector, to: Vector| {
                for triangle in skin.edges[edge as usize].triangles.into_iter().filter(|&triangle| triangle != NONE) {
                    let (from, to) = if runs_with(skin, edge, triangle) { (from, to) } else { (to, from) };
                    pieces.push(Piece { triangle, from, to });
                }
                if !here.iter().any(|piercing| piercing.is_flat) {
                    chords.push((edge, [from, to]));
                }
            };
            // How many times it is inside.
            let says = if is_own { ends_inside(here) } else { None };
            let begins_inside = says.map_or(self.inside[ends[0] as usize] == self.pair, |[first, _]| first);
            let mut count = i32::from(begins_inside);
            let mut since = begin;
            for piercing in here {
                let before = count;
                count += if piercing.enters { 1 } else { -1 };
                match (before > 0, count > 0) {
                    (false, true) => since = piercing.place,
                    (true, false) => add(since, piercing.place),
                    _ => {}
                }
            }
            if count > 0 {
                add(since, end);
            }
        }
        chords
    }

    /// To which side of its region each triangle of one body belongs: pairs that cut each other are on
    /// different ones. `None`: that can't be.
    fn colours(&self, sides: &mut Sets, pairs: &[[u32; 2]], count: usize) -> Vec<Option<bool>> {
        let mut links: Vec<[u32; 2]> = pairs.iter().map(|pair| pair.map(|triangle| sides.find(self.slots[triangle as usize]))).collect();
        links.extend(links.clone().iter().map(|[a, b]| [*b, *a]));
        links.sort_unstable();
        links.dedup();
        let mut of: Vec<Option<bool>> = vec![None; count];
        let mut is_torn = vec![false; count];
        for start in 0..count as u32 {
            if sides.find(start) != start || of[start as usize].is_some() {
                continue;
            }
            of[start as usize] = Some(false);
            let (mut stack, mut met, mut torn) = (vec![start], vec![start], false);
            while let Some(at) = stack.pop() {
                let here = links.partition_point(|link| link[0] < at);
                for &[_, other] in links[here..].iter().take_while(|link| link[0] == at) {
                    match of[other as usize] {
                        None => {
                            of[other as usize] = of[at as usize].map(|colour| !colour);
                            stack.push(other);
                            met.push(other);
                        }
                        colour => torn |= colour == of[at as usize],
                    }
                }
            }
            met.iter().for_each(|&at| is_torn[at as usize] = torn);
        }
        (0..count as u32)
            .map(|slot| {
                let root = sides.find(slot) as usize;
                if is_torn[root] { None } else { of[root] }
            })
            .collect()
    }
}

/// Whether the ends of an edge are inside, by its piercings in their order; `None`: they don't say.
fn ends_inside(here: &[Piercing]) -> Option<[bool; 2]> {
    let entries = 2 * here.iter().filter(|piercing| piercing.enters).count();
    if entries != here.len() {
        return Some([entries < here.len(), entries > here.len()]);
    }
    // Where it goes in as often as out, the order says how; what lies at one place has none, and other edges
    // decide.
    let are_apart = here.windows(2).all(|two| two[1].along - two[0].along > SAME_PLACE);
    let is_certain = are_apart && !here.iter().any(|piercing| piercing.is_flat);
    is_certain.then(|| [!here[0].enters, here[here.len() - 1].enters])
}

/// The parts of edges behind the triangles that they pierce, as far as the next piercing or the end of the
/// edge, and those triangles.
fn beside(skin: &Skin, piercings: &[Piercing]) -> Vec<((u32, [Vector; 2]), u32)> {
    let mut parts = Vec::new();
    for here in piercings.chunk_by(|a, b| a.edge == b.edge) {
        let edge = here[0].edge;
        let ends = skin.edges[edge as usize].ends.map(|vertex| skin.x[vertex as usize]);
        for (k, piercing) in here.iter().enumerate().filter(|(_, piercing)| !piercing.is_flat) {
            let other = if piercing.enters {
                here.get(k + 1).map_or(ends[1], |next| next.place)
            } else {
                if k > 0 { here[k - 1].place } else { ends[0] }
            };
            parts.push(((edge, [piercing.place, other]), piercing.triangle));
        }
    }
    parts
}

/// N, V and its gradient; `row_of` is memory to work in: a [`NONE`] for each vertex.
fn integrate(skin: &Skin, region: &mut Region, pieces: &[Piece], row_of: &mut [u32]) {
    let Some(&(first, _)) = region.triangles.first() else { return };
    // A place of the region: what is flat then has no volume, however ties place the contour in its plane.
    let own = pieces[pieces.partition_point(|piece| piece.triangle < first)..].first().filter(|piece| piece.triangle == first);
    let origin = own.map_or(skin.corners(first)[0], |piece| piece.from);
    let mut closing = Closing::default();
    for &(triangle, second) in &region.triangles {
        let x = skin.corners(triangle);
        let (along, across) = (minus(x[1], x[0]), minus(x[2], x[0]));
        let double = cross(along, across);
        let square = dot(double, double);
        if !(square > 0.0) {
            continue;
        }
        let begin = pieces.partition_point(|piece| piece.triangle < triangle);
        let own = pieces[begin..].iter().take_while(|piece| piece.triangle == triangle);
        // Shares of the corners in the area, of the whole one as the unit.
        let (mut shares, mut is_cut) = ([0.0; 3], false);
        for piece in own {
            is_cut = true;
            let (p, q) = (minus(piece.from, x[0]), minus(piece.to, x[0]));
            let part = dot(double, cross(p, q)) / square;
            let of = |r: Vector| [dot(double, cross(r, across)) / square, dot(double, cross(along, r)) / square];
            let ([p1, p2], [q1, q2]) = (of(p), of(q));
            let (one, two) = ((p1 + q1) / 3.0, (p2 + q2) / 3.0);
            shares[1] += part * one;
            shares[2] += part * two;
            shares[0] += part * (1.0 - one - two);
        }
        if !is_cut {
            shares = [1.0 / 3.0; 3];
        }
        let covered = shares[0] + shares[1] + shares[2];
        let area = double.map(|c| 0.5 * covered * c);
        if !skin.is_mirror(triangle) {
            region.size += 0.25 * covered * square.sqrt();
            if !second {
                (0..3).for_each(|d| region.area[d] += area[d]);
            }
        }
        region.volume += dot(minus(x[0], origin), area) / 3.0;
        for (vertex, share) in skin.triangles[triangle as usize].into_iter().zip(shares) {
            let (carriers, count) = skin.shares(vertex);
            let share = 0.5 * share / count as f64;
            for &node in &carriers[..count] {
                let row = double.map(|c| share * c);
                closing.add(minus(skin.x[node as usize], origin), row);
                let at = &mut row_of[node as usize];
                if *at == NONE {
                    *at = region.gradient.len() as u32;
                    region.gradient.push((node, row));
                } else {
                    let sum = &mut region.gradient[*at as usize].1;
                    (0..3).for_each(|d| sum[d] += row[d]);
                }
            }
        }
    }
    region.is_closed = closing.is_closed();
    region.gradient.iter().for_each(|&(node, _)| row_of[node as usize] = NONE);
    region.gradient.sort_unstable_by_key(|row| row.0);
}

/// Whether the rows ∂V/∂x are those of a closed surface: their sum and their moment vanish.
#[derive(Default)]
struct Closing {
    sum: Vector,
    moment: Vector,
    /// Sums of the sizes of the rows, and of those of their moments.
    size: f64,
    arm_size: f64,
}

impl Closing {
    /// Adds a row at an arm.
    fn add(&mut self, arm: Vector, row: Vector) {
        let turned = cross(arm, row);
        (0..3).for_each(|d| {
            self.sum[d] += row[d];
            self.moment[d] += turned[d];
        });
        self.size += length(row);
        self.arm_size += length(arm) * length(row);
    }

    fn is_closed(&self) -> bool {
        length(self.sum) <= CLOSED * self.size && length(self.moment) <= CLOSED * self.arm_size
    }
}
