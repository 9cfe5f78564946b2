//! Triangles of a mesh, and the pieces that triangles of two meshes have in common.

use super::{Failure, Side};
use crate::plane::{Measure, Mesh, Point, corners, cross, minus};
use crate::shared::grid::{Grid, bounds};

/// Circumference of the unit circle: an axisymmetric body has the volume ∫ 2πx dA.
pub(super) const TURN: f64 = std::f64::consts::TAU;

/// A triangle of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twin {
    pub(super) cell: u32,
    /// Of each vertex its weights of the cell's corners: 1 and 0 but at the centre of a quadrilateral.
    pub(super) shape: [[f64; 4]; 3],
    pub(super) places: [Point; 3],
    /// m².
    pub(super) area: f64,
}

impl Twin {
    /// ∫ λ_j dV for each corner j: m³ (per metre of depth in 2D).
    pub(super) fn moments(&self, measure: Measure) -> [f64; 3] {
        moments(self.area, [self.places[0][0], self.places[1][0], self.places[2][0]], measure)
    }
}

/// ∫ μ_i dV for the vertices of a triangle with a given area and distances from the axis: A/3 in 2D, of
/// revolution 2πA/12 (W + x_i) with W = Σ x_i.
pub(super) fn moments(area: f64, x: [f64; 3], measure: Measure) -> [f64; 3] {
    match measure {
        Measure::Plane => [area / 3.0; 3],
        Measure::Revolution => {
            let (scale, sum) = (TURN * area / 12.0, x[0] + x[1] + x[2]);
            [scale * (sum + x[0]), scale * (sum + x[1]), scale * (sum + x[2])]
        }
    }
}

/// How quadrilaterals are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// In two, along the diagonal whose smaller triangle is the larger one: that is within it even where a
    /// corner turns inwards.
    Two,
    /// In four, along both diagonals. A linear function has at their crossing the mean of what it has by each
    /// of them: no diagonal is preferred, so the masses of the corners of a square are equal. In two where a
    /// corner turns inwards.
    Four,
}

/// The triangles of a mesh, by cells.
pub(super) fn twins(mesh: Mesh<'_>, cut: Cut, side: Side) -> Result<Vec<Twin>, Failure> {
    let mut found = Vec::with_capacity(4 * mesh.cells.len());
    for (index, cell) in mesh.cells.iter().enumerate() {
        let nodes = corners(cell);
        // The last one is the centre.
        let mut places = [[0.0; 2]; 5];
        for (place, &node) in places.iter_mut().zip(nodes) {
            *place = *mesh.positions.get(node as usize).ok_or(Failure::Size)?;
        }
        let centre = if cut == Cut::Four && nodes.len() == 4 { crossing(&places) } else { None };
        let shape_of_centre = centre.map_or([0.0; 4], |(place, shape)| {
            places[4] = place;
            shape
        });
        let area = |[a, b, c]: [usize; 3]| 0.5 * cross(minus(places[b], places[a]), minus(places[c], places[a]));
        let four: [[usize; 3]; 4] = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let cuts: &[[usize; 3]] = if nodes.len() == 3 {
            &[[0, 1, 2]]
        } else if centre.is_some() && four.iter().all(|&of| area(of) > 0.0) {
            &four
        } else if area([0, 1, 2]).min(area([0, 2, 3])) >= area([0, 1, 3]).min(area([1, 2, 3])) {
            &[[0, 1, 2], [0, 2, 3]]
        } else {
            &[[0, 1, 3], [1, 2, 3]]
        };
        for &of in cuts {
            let area = area(of);
            if !(area > 0.0 && area.is_finite()) {
                return Err(Failure::Inverted { side, cell: index });
            }
            let shape = of.map(|vertex| {
                let mut shape = shape_of_centre;
                if vertex < 4 {
                    shape = [0.0; 4];
                    shape[vertex] = 1.0;
                }
                shape
            });
            let cell = u32::try_from(index).map_err(|_| Failure::Size)?;
            found.push(Twin { cell, shape, places: of.map(|vertex| places[vertex]), area });
        }
    }
    Ok(found)
}

/// Where the diagonals of a quadrilateral cross, and the weights of its corners there. `None` if they do not
/// cross within it.
fn crossing(x: &[Point; 5]) -> Option<(Point, [f64; 4])> {
    let (first, second, side) = (minus(x[2], x[0]), minus(x[3], x[1]), minus(x[1], x[0]));
    let whole = cross(first, second);
    let (t, u) = (cross(side, second) / whole, cross(side, first) / whole);
    let shape = [0.5 * (1.0 - t), 0.5 * (1.0 - u), 0.5 * t, 0.5 * u];
    let place = [0, 1].map(|k| shape[0] * x[0][k] + shape[1] * x[1][k] + shape[2] * x[2][k] + shape[3] * x[3][k]);
    (t > 0.0 && t < 1.0 && u > 0.0 && u < 1.0).then_some((place, shape))
}

/// A vertex of a piece: its barycentric coordinates in both triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) old: [f64; 3],
    pub(super) new: [f64; 3],
}

const NONE: Vertex = Vertex { old: [0.0; 3], new: [0.0; 3] };

/// The convex polygon that two triangles have in common: each of three cuts adds one vertex at most.
pub(super) struct Piece {
    /// Before and after a cut.
    vertices: [[Vertex; 8]; 2],
    current: usize,
    count: usize,
}

impl Piece {
    pub(super) fn vertices(&self) -> &[Vertex] {
        &self.vertices[self.current & 1][..self.count.min(8)]
    }

    /// Calls `visit` with its triangles about its first vertex and their areas, m². Areas are taken in the
    /// smaller one of the two triangles, where they are exact if it lies within the other one.
    #[inline]
    pub(super) fn fan(&self, old: &Twin, new: &Twin, mut visit: impl FnMut([&Vertex; 3], f64)) {
        let [first, rest @ ..] = self.vertices() else { return };
        let is_old = old.area <= new.area;
        for ends in rest.windows(2) {
            let (b, c) = (&ends[0], &ends[1]);
            let area = if is_old { old.area * double(&first.old, &b.old, &c.old) } else { new.area * double(&first.new, &b.new, &c.new) };
            if area > 0.0 {
                visit([first, b, c], area);
            }
        }
    }

    /// Sets it to what two triangles have in common; false if that has no area. Sutherland & Hodgman: the old
    /// triangle is cut at the three sides of the new one, from the inner to the outer vertex.
    fn set(&mut self, old: &Twin, new: &Twin, sides: &[Line; 3]) -> bool {
        let mut heights = [[0.0; 3]; 3];
        for side in 0..3 {
            let mut is_in = false;
            for vertex in 0..3 {
                let height = sides[side].height(old.places[vertex]);
                heights[vertex][side] = height;
                is_in |= height > 0.0;
            }
            if !is_in {
                return false;
            }
        }
        for side in 0..3 {
            let line = Line::of(old, side);
            if !new.places.iter().any(|&place| line.height(place) > 0.0) {
                return false;
            }
        }
        self.current = 0;
        self.count = 3;
        for vertex in 0..3 {
            let mut made = NONE;
            made.old[vertex] = 1.0;
            for side in 0..3 {
                made.new[side] = heights[vertex][side] / sides[side].whole;
            }
            self.vertices[0][vertex] = made;
        }
        for side in 0..3 {
            self.cut(side);
            if self.count < 3 {
                return false;
            }
        }
        true
    }

    /// Keeps the part where one of the new coordinates is not negative.
    fn cut(&mut self, side: usize) {
        let [first, second] = &mut self.vertices;
        let (all, to) = if self.current == 0 { (first, second) } else { (second, first) };
        let all = &all[..self.count.min(8)];
        if all.iter().all(|vertex| vertex.new[side] >= 0.0) {
            return;
        }
        self.current = 1 - self.current;
        let mut places = to.iter_mut();
        self.count = 0;
        let mut put = |vertex: Vertex| {
            if let Some(place) = places.next() {
                *place = vertex;
                self.count += 1;
            }
        };
        for (k, vertex) in all.iter().enumerate() {
            let next = &all[if k + 1 == all.len() { 0 } else { k + 1 }];
            let (is_in, is_next_in) = (vertex.new[side] >= 0.0, next.new[side] >= 0.0);
            if is_in {
                put(*vertex);
            }
            if is_in != is_next_in {
                put(if is_in { between(vertex, next, side) } else { between(next, vertex, side) });
            }
        }
    }
}

/// Twice the area of a triangle in barycentric coordinates, by that of the whole.
fn double(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A side of a triangle.
struct Line {
    from: Point,
    along: Point,
    /// Height of the opposite corner, times the side's length.
    whole: f64,
}

impl Line {
    /// The side opposite a corner.
    fn of(twin: &Twin, opposite: usize) -> Self {
        let (from, to) = (twin.places[(opposite + 1) % 3], twin.places[(opposite + 2) % 3]);
        let along = minus(to, from);
        Self { from, along, whole: cross(along, minus(twin.places[opposite], from)) }
    }

    /// Height of a place above the side, times the side's length.
    fn height(&self, place: Point) -> f64 {
        cross(self.along, minus(place, self.from))
    }
}

/// Where the line from a vertex within to one outside meets a side.
fn between(inner: &Vertex, outer: &Vertex, side: usize) -> Vertex {
    let part = inner.new[side] / (inner.new[side] - outer.new[side]);
    let mut vertex = NONE;
    for k in 0..3 {
        vertex.old[k] = inner.old[k] + part * (outer.old[k] - inner.old[k]);
        vertex.new[k] = inner.new[k] + part * (outer.new[k] - inner.new[k]);
    }
    vertex.new[side] = 0.0;
    vertex
}

/// Calls `visit` with the indices of an old and a new triangle and what they have in common, for all that
/// have any: new triangles in their order, old ones ascending for each.
pub(super) fn pieces(old: &[Twin], new: &[Twin], mut visit: impl FnMut(usize, usize, &Piece)) {
    let mut grid = Grid::new(old.iter().map(|twin| bounds(&twin.places)).collect());
    let mut near: Vec<u32> = Vec::new();
    let mut piece = Piece { vertices: [[NONE; 8]; 2], current: 0, count: 0 };
    for (index, twin) in new.iter().enumerate() {
        let sides = [Line::of(twin, 0), Line::of(twin, 1), Line::of(twin, 2)];
        grid.near(&bounds(&twin.places), index as u32, &mut near);
        for &candidate in &near {
            let candidate = candidate as usize;
            if piece.set(&old[candidate], twin, &sides) {
                visit(candidate, index, &piece);
            }
        }
    }
}
