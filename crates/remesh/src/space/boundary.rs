//! Faces of a mesh that one cell has, the place on them that is nearest, and old material outside them.

use super::cut::Plan;
use super::tets::{Tets, local};
use super::vector::{dot, minus};
use super::{Failure, Mesh, Point, Side};

/// Faces that one cell has: cells and their faces, ascending.
pub(super) fn outer_faces(mesh: Mesh<'_>) -> Vec<(u32, u8)> {
    let mut all: Vec<([u32; 4], u32, u8)> = Vec::with_capacity(6 * mesh.cells.len());
    for (index, cell) in mesh.cells.iter().enumerate() {
        for (face, corners) in cell.kind().faces().iter().enumerate() {
            let mut key = [u32::MAX; 4];
            key.iter_mut().zip(*corners).for_each(|(place, &corner)| *place = cell.nodes()[usize::from(corner)]);
            key.sort_unstable();
            all.push((key, index as u32, face as u8));
        }
    }
    all.sort_unstable();
    let single = all.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
    let mut found: Vec<(u32, u8)> = single.map(|same| (same[0].1, same[0].2)).collect();
    found.sort_unstable();
    found
}

/// A triangle of the outline.
pub(super) struct Triangle {
    pub(super) cell: u32,
    /// Sub-cell of the cell.
    pub(super) part: u8,
    /// Weights of the cell's nodes at each vertex.
    pub(super) shapes: [[f64; super::kind::MOST]; 3],
    places: [Point; 3],
    centre: Point,
    radius: f64,
}

/// The triangles of the faces of one cell only.
pub(super) fn outline(plans: &[Plan; 4], mesh: Mesh<'_>) -> Result<Vec<Triangle>, Failure> {
    let mut found = Vec::new();
    for (cell, face) in outer_faces(mesh) {
        let local = local(plans, mesh, cell as usize, Side::New)?;
        for facet in local.plan.facets.iter().filter(|facet| facet.face == face) {
            let places = facet.vertices.map(|vertex| local.places[usize::from(vertex)]);
            let centre = [0, 1, 2].map(|k| (places[0][k] + places[1][k] + places[2][k]) / 3.0);
            let square = places.iter().fold(0.0, |most: f64, &x| most.max(dot(minus(x, centre), minus(x, centre))));
            let shapes = facet.vertices.map(|vertex| *local.shape(vertex));
            found.push(Triangle { cell, part: facet.part, shapes, places, centre, radius: square.sqrt() });
        }
    }
    Ok(found)
}

/// The nearest of some triangles, and the weights of its vertices at the nearest place.
fn nearest(triangles: &[Triangle], x: Point) -> Option<(u32, [f64; 3])> {
    let mut best: Option<(f64, u32, [f64; 3])> = None;
    for (index, triangle) in triangles.iter().enumerate() {
        let arm = minus(x, triangle.centre);
        if best.is_some_and(|(least, _, _)| dot(arm, arm).sqrt() - triangle.radius > least.sqrt()) {
            continue;
        }
        let weights = on_triangle(&triangle.places, x);
        let place = [0, 1, 2].map(|k| (0..3).fold(0.0, |sum, v| sum + weights[v] * triangle.places[v][k]));
        let square = dot(minus(x, place), minus(x, place));
        if best.is_none_or(|(least, _, _)| square < least) {
            best = Some((square, index as u32, weights));
        }
    }
    best.map(|(_, index, weights)| (index, weights))
}

/// Weights of the vertices at the place of a triangle that is nearest to a point: on its plane if it is
/// within, else on its nearest side.
pub(super) fn on_triangle(x: &[Point; 3], at: Point) -> [f64; 3] {
    let (b, c, p) = (minus(x[1], x[0]), minus(x[2], x[0]), minus(at, x[0]));
    let (bb, bc, cc, pb, pc) = (dot(b, b), dot(b, c), dot(c, c), dot(p, b), dot(p, c));
    let whole = bb * cc - bc * bc;
    let (v, w) = ((pb * cc - pc * bc) / whole, (pc * bb - pb * bc) / whole);
    if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
        return [1.0 - v - w, v, w];
    }
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for k in 0..3 {
        let next = (k + 1) % 3;
        let (along, arm) = (minus(x[next], x[k]), minus(at, x[k]));
        let length = dot(along, along);
        let part = if length > 0.0 { (dot(arm, along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let away = [0, 1, 2].map(|d| arm[d] - part * along[d]);
        if dot(away, away) < best.0 {
            let mut weights = [0.0; 3];
            (weights[k], weights[next]) = (1.0 - part, part);
            best = (dot(away, away), weights);
        }
    }
    best.1
}

/// Material of an old tetrahedron that is outside the new mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sliver {
    pub(super) old: u32,
    /// ∫ λ_j dV over it for each vertex j of the old tetrahedron.
    pub(super) moments: [f64; 4],
    /// The nearest triangle of the new mesh's outline, and the weights of its vertices at the nearest place.
    pub(super) triangle: u32,
    pub(super) weights: [f64; 3],
}

/// What is left of old tetrahedra when their pieces are taken from them, and is more than round-off; and the
/// outline of the new mesh if there is any. `Overlap` if pieces are more than a tetrahedron.
pub(super) fn slivers(tets: &Tets, within: &[[f64; 4]], plans: &[Plan; 4], new: Mesh<'_>) -> Result<(Vec<Sliver>, Vec<Triangle>), Failure> {
    let (mut found, mut triangles): (Vec<Sliver>, Vec<Triangle>) = (Vec::new(), Vec::new());
    for (index, tet) in tets.all.iter().enumerate() {
        let moments = within[index].map(|within| 0.25 * tet.volume - within);
        let volume = moments[0] + moments[1] + moments[2] + moments[3];
        if volume < -TWICE * tet.volume {
            return Err(Failure::Overlap { cell: tet.cell as usize });
        }
        if !(volume > ROUND_OFF * tet.volume) {
            continue;
        }
        if triangles.is_empty() {
            triangles = outline(plans, new)?;
        }
        let places = tets.places_of(tet);
        let centre = [0, 1, 2].map(|k| (0..4).fold(0.0, |sum, j| sum + moments[j] / volume * places[j][k]));
        let (triangle, weights) = nearest(&triangles, centre).ok_or(Failure::Size)?;
        found.push(Sliver { old: index as u32, moments, triangle, weights });
    }
    Ok((found, triangles))
}

/// Part of a tetrahedron's volume that pieces may miss by rounding.
const ROUND_OFF: f64 = 1e-12;
/// Part of a tetrahedron's volume that pieces may have twice by rounding.
const TWICE: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_places_are_found_within_and_on_sides() {
        let x = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for (at, expected) in [
            ([0.25, 0.25, 3.0], [0.5, 0.25, 0.25]),
            ([0.5, -1.0, 1.0], [0.5, 0.5, 0.0]),
            ([1.0, 1.0, -1.0], [0.0, 0.5, 0.5]),
            ([-1.0, -2.0, 0.0], [1.0, 0.0, 0.0]),
        ] {
            assert_eq!(on_triangle(&x, at), expected);
        }
    }
}
