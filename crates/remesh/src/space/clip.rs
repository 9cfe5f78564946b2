//! What two tetrahedra have in common, and integrals over it.
//!
//! The old tetrahedron is cut at the four planes of the new one. The polyhedron is a graph of vertices with
//! three neighbours each, in the order in which its faces run around them; a cut puts a vertex on each edge
//! that it meets, from the inner to the outer end, and joins them around the new face. Source: Powell & Abel,
//! J. Comput. Phys. 297 (2015) 340-356.

use super::Point;
use super::vector::{cross, dot, minus};

/// A vertex: its barycentric coordinates in both tetrahedra, and its neighbours.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    old: [f64; 4],
    new: [f64; 4],
    next: [u8; 3],
}

const NONE: Vertex = Vertex { old: [0.0; 4], new: [0.0; 4], next: [u8::MAX; 3] };

/// Most vertices while a tetrahedron is cut four times: eight faces have twelve vertices, of ten one cut
/// takes some and adds seven at most.
const MOST: usize = 24;

/// Neighbours of the vertices of a tetrahedron.
const START: [[u8; 3]; 4] = [[1, 3, 2], [2, 3, 0], [0, 3, 1], [1, 2, 0]];

/// The plane of a face of a tetrahedron.
#[derive(Clone, Copy, Debug)]
struct Plane {
    from: Point,
    normal: Point,
}

impl Plane {
    /// The face opposite a vertex; its normal points inwards.
    fn of(x: &[Point; 4], opposite: usize) -> Self {
        let [a, b, c] = FACES[opposite];
        let (a, b, c) = (x[a], x[b], x[c]);
        Self { from: a, normal: cross(minus(b, a), minus(c, a)) }
    }

    /// Height of a place above the plane, times twice the face's area.
    fn height(&self, place: Point) -> f64 {
        dot(self.normal, minus(place, self.from))
    }
}

/// Vertices of the face opposite each vertex, counter-clockwise seen from that.
const FACES: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// A tetrahedron of the new mesh.
pub(super) struct Tet {
    pub(super) places: [Point; 4],
    /// m³.
    pub(super) volume: f64,
    planes: [Plane; 4],
}

impl Tet {
    pub(super) fn new(places: [Point; 4], volume: f64) -> Self {
        Self { places, volume, planes: [0, 1, 2, 3].map(|k| Plane::of(&places, k)) }
    }
}

/// Integrals over a piece: ∫ N_a λ_j dV, N of the new tetrahedron, λ of the old one; and ∫ N_a N_b dV.
#[derive(Clone, Copy, Debug)]
pub(super) struct Products {
    pub(super) mixed: [[f64; 4]; 4],
    pub(super) own: [[f64; 4]; 4],
}

/// The convex polyhedron that two tetrahedra have in common.
pub(super) struct Piece {
    vertices: [Vertex; MOST],
    count: usize,
    /// Volumes of the tetrahedra, m³.
    volumes: [f64; 2],
}

impl Piece {
    pub(super) fn new() -> Self {
        Self { vertices: [NONE; MOST], count: 0, volumes: [0.0; 2] }
    }

    /// Sets it to what two tetrahedra have in common; false if that has no volume.
    pub(super) fn set(&mut self, old: &[Point; 4], volume: f64, new: &Tet) -> bool {
        let mut heights = [[0.0; 4]; 4];
        for side in 0..4 {
            let mut is_in = false;
            for vertex in 0..4 {
                heights[vertex][side] = new.planes[side].height(old[vertex]);
                is_in |= heights[vertex][side] > 0.0;
            }
            if !is_in {
                return false;
            }
        }
        for side in 0..4 {
            let plane = Plane::of(old, side);
            if !new.places.iter().any(|&place| plane.height(place) > 0.0) {
                return false;
            }
        }
        self.count = 4;
        self.volumes = [volume, new.volume];
        let scale = 1.0 / (6.0 * new.volume);
        for vertex in 0..4 {
            let mut made = NONE;
            made.old[vertex] = 1.0;
            (0..4).for_each(|side| made.new[side] = scale * heights[vertex][side]);
            made.next = START[vertex];
            self.vertices[vertex] = made;
        }
        (0..4).all(|side| self.cut(side))
    }

    /// Keeps the part where one of the new coordinates is not negative; false if there is none.
    fn cut(&mut self, side: usize) -> bool {
        let count = self.count;
        let mut outside = 0u32;
        for (k, vertex) in self.vertices[..count].iter().enumerate() {
            outside |= u32::from(!(vertex.new[side] >= 0.0)) << k;
        }
        if outside == 0 {
            return true;
        }
        if outside.count_ones() as usize == count {
            return false;
        }
        let is_out = |k: usize| outside >> k & 1 == 1;
        let mut all = count;
        for k in (0..count).filter(|&k| !is_out(k)) {
            for slot in 0..3 {
                let next = usize::from(self.vertices[k].next[slot]);
                if is_out(next) {
                    if all == MOST {
                        return false;
                    }
                    let mut made = between(&self.vertices[k], &self.vertices[next], side);
                    made.next[0] = k as u8;
                    self.vertices[all] = made;
                    self.vertices[k].next[slot] = all as u8;
                    all += 1;
                }
            }
        }
        (count..all).all(|start| self.join(start, count)) && self.pack(outside, count, all)
    }

    /// Joins a new vertex with the one that follows it around the new face: along the old face that both are
    /// on. False if there is no way, which rounding alone can make in a piece of hardly any volume.
    fn join(&mut self, start: usize, count: usize) -> bool {
        let (mut at, mut next) = (start, usize::from(self.vertices[start].next[0]));
        for _ in 0..MOST {
            let Some(slot) = self.slot(next, at) else { return false };
            at = next;
            if at >= count {
                self.vertices[start].next[2] = at as u8;
                self.vertices[at].next[1] = start as u8;
                return true;
            }
            next = usize::from(self.vertices[at].next[(slot + 1) % 3]);
        }
        false
    }

    /// The place of a vertex among the neighbours of another one.
    fn slot(&self, of: usize, neighbour: usize) -> Option<usize> {
        self.vertices.get(of)?.next.iter().position(|&next| usize::from(next) == neighbour)
    }

    /// Takes the vertices outside away.
    fn pack(&mut self, outside: u32, count: usize, all: usize) -> bool {
        let (mut numbers, mut kept) = ([u8::MAX; MOST], 0);
        for k in 0..all {
            if k >= count || outside >> k & 1 == 0 {
                self.vertices[kept] = self.vertices[k];
                numbers[k] = kept as u8;
                kept += 1;
            }
        }
        for vertex in &mut self.vertices[..kept] {
            vertex.next = vertex.next.map(|next| numbers.get(usize::from(next)).copied().unwrap_or(u8::MAX));
        }
        self.count = kept;
        kept >= 4
    }

    /// Calls `visit` with the vertices of its tetrahedra about its first vertex, and their volumes, m³.
    /// Volumes are taken in the smaller one of the two tetrahedra, where they are exact if it lies within the
    /// other. Where planes of both coincide, rounding can leave flat parts away from the first vertex, of
    /// which some volumes are negative: they count, or these parts would have a volume.
    fn fan(&self, mut visit: impl FnMut([usize; 3], f64)) {
        let is_old = self.volumes[0] <= self.volumes[1];
        let scale = if is_old { self.volumes[0] } else { self.volumes[1] };
        let at = |k: usize| if is_old { &self.vertices[k].old } else { &self.vertices[k].new };
        let apex = at(0);
        let arm = |k: usize| {
            let x = at(k);
            [x[1] - apex[1], x[2] - apex[2], x[3] - apex[3]]
        };
        let mut seen = [0u8; MOST];
        for start in 0..self.count {
            for slot in 0..3 {
                if seen[start] >> slot & 1 == 1 {
                    continue;
                }
                // Around the face; those of the first vertex come first, and have no volume.
                seen[start] |= 1 << slot;
                let (mut at, mut next) = (start, usize::from(self.vertices[start].next[slot]));
                let mut last: Option<(usize, Point)> = None;
                let first = arm(start);
                for _ in 0..MOST {
                    let Some(back) = self.slot(next, at) else { break };
                    at = next;
                    if at == start {
                        break;
                    }
                    let onward = (back + 1) % 3;
                    seen[at] |= 1 << onward;
                    next = usize::from(self.vertices[at].next[onward]);
                    if start == 0 {
                        continue;
                    }
                    let here = arm(at);
                    if let Some((before, there)) = last {
                        let volume = scale * dot(first, cross(here, there));
                        visit([start, before, at], volume);
                    }
                    last = Some((at, here));
                }
            }
        }
    }

    /// ∫ λ_j dV of the old tetrahedron's coordinates; `None` if the volume is not positive.
    pub(super) fn moments(&self) -> Option<[f64; 4]> {
        let mut found = [0.0; 4];
        self.fan(|[a, b, c], volume| {
            let [p, a, b, c] = [0, a, b, c].map(|k| &self.vertices[k].old);
            (0..4).for_each(|j| found[j] += 0.25 * volume * (p[j] + a[j] + b[j] + c[j]));
        });
        (found.iter().sum::<f64>() > 0.0).then_some(found)
    }

    /// Integrals of products: ∫ f g = V/20 (Σ f_i g_i + Σ f_i Σ g_i) in each of its tetrahedra; `None` if the
    /// volume is not positive.
    pub(super) fn products(&self) -> Option<Products> {
        let mut found = Products { mixed: [[0.0; 4]; 4], own: [[0.0; 4]; 4] };
        let mut weights = [0.0; MOST];
        let mut add = |weight: f64, new: &[f64; 4], old: &[f64; 4]| {
            for a in 0..4 {
                let factor = weight * new[a];
                for j in 0..4 {
                    found.mixed[a][j] += factor * old[j];
                    found.own[a][j] += factor * new[j];
                }
            }
        };
        self.fan(|corners, volume| {
            let weight = 0.05 * volume;
            let (mut old, mut new) = (self.vertices[0].old, self.vertices[0].new);
            weights[0] += weight;
            for k in corners {
                weights[k] += weight;
                for j in 0..4 {
                    old[j] += self.vertices[k].old[j];
                    new[j] += self.vertices[k].new[j];
                }
            }
            add(weight, &new, &old);
        });
        for (vertex, &weight) in self.vertices[..self.count].iter().zip(&weights) {
            add(weight, &vertex.new, &vertex.old);
        }
        (found.mixed.iter().flatten().sum::<f64>() > 0.0).then_some(found)
    }
}

/// Where the line from a vertex within to one outside meets a plane.
fn between(inner: &Vertex, outer: &Vertex, side: usize) -> Vertex {
    let part = inner.new[side] / (inner.new[side] - outer.new[side]);
    let mut vertex = NONE;
    for k in 0..4 {
        vertex.old[k] = inner.old[k] + part * (outer.old[k] - inner.old[k]);
        vertex.new[k] = inner.new[k] + part * (outer.new[k] - inner.new[k]);
    }
    vertex.new[side] = 0.0;
    vertex
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::vector::six_volumes;

    /// A tetrahedron with itself, and with one moved by half of an edge: V/8.
    #[test]
    fn pieces_of_equal_tetrahedra() {
        let x = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut piece = Piece::new();
        for (shift, part) in [(0.0, 1.0), (0.5, 0.125), (0.25, 27.0 / 64.0)] {
            let y = x.map(|x: Point| [x[0] + shift, x[1], x[2]]);
            let new = Tet::new(y, six_volumes(&y) / 6.0);
            assert!(piece.set(&x, 1.0 / 6.0, &new));
            let volume: f64 = piece.moments().unwrap().iter().sum();
            assert!((6.0 * volume - part).abs() < 1e-15, "{shift}: {volume}");
            let products = piece.products().unwrap();
            let sums = [&products.mixed, &products.own].map(|all| all.iter().flatten().sum::<f64>());
            assert!(sums.iter().all(|sum| (6.0 * sum - part).abs() < 1e-15), "{shift}: {sums:?}");
        }
        // λ_i² gives V/10, λ_i λ_j V/20.
        let new = Tet::new(x, 1.0 / 6.0);
        assert!(piece.set(&x, 1.0 / 6.0, &new));
        let products = piece.products().unwrap();
        for a in 0..4 {
            for b in 0..4 {
                let expected = if a == b { 1.0 / 60.0 } else { 1.0 / 120.0 };
                assert!((products.mixed[a][b] - expected).abs() < 1e-17 && (products.own[a][b] - expected).abs() < 1e-17);
            }
        }
    }
}
