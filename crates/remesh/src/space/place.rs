//! Where the material at a place is among the nodes of a mesh: on its outline, and within.

use super::boundary::on_triangle;
use super::cut::{Cut, Plan};
use super::face::{Face, Triangle};
use super::tets::Tets;
use super::vector::{dot, six_volumes};
use super::{Failure, Mesh, Point};
use crate::shared::grid::{Bounds, Grid, bounds};

/// The nearest place on an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// Its face.
    pub face: usize,
    /// Nodes of the face with their shares, which add up to one.
    pub shares: Vec<(u32, f64)>,
    /// How far it is, m.
    pub distance: f64,
}

/// Faces of an outline, as triangles by their boxes. A quadrilateral is four about the mean of its corners.
pub struct Outside<'a> {
    positions: &'a [Point],
    triangles: Vec<(usize, Triangle)>,
    grid: Grid<3>,
    /// Half the side of the box in which is looked first, m, and one that holds everything.
    first: f64,
    whole: f64,
    near: Vec<u32>,
    mark: u32,
}

/// A share of a node that is less is none: the place is on the edge, or in the corner.
const SLIGHT: f64 = 1e-4;

impl<'a> Outside<'a> {
    /// Faces of nodes in these places; a triangle repeats its last node.
    #[must_use]
    pub fn new(positions: &'a [Point], faces: &[[u32; 4]]) -> Self {
        let of = |(index, face): (usize, &Face)| Triangle::of(face).map(move |triangle| (index, triangle)).collect::<Vec<_>>();
        let triangles: Vec<(usize, Triangle)> = faces.iter().enumerate().flat_map(of).collect();
        let boxes: Vec<Bounds<3>> = triangles.iter().map(|(_, triangle)| bounds(&triangle.places(positions))).collect();
        let side = |[low, high]: &Bounds<3>| (0..3).fold(0.0, |most: f64, k| most.max(high[k] - low[k]));
        let first = boxes.iter().map(side).sum::<f64>() / boxes.len().max(1) as f64;
        let [low, high] = boxes.iter().fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], own| {
            [[0, 1, 2].map(|k| low[k].min(own[0][k])), [0, 1, 2].map(|k| high[k].max(own[1][k]))]
        });
        let whole = side(&[low, high]).max(0.0);
        Self { positions, triangles, grid: Grid::new(boxes), first, whole, near: Vec::new(), mark: 0 }
    }

    /// The place of the outline that is nearest to another one; `None` without faces.
    pub fn nearest(&mut self, place: Point) -> Option<Nearest> {
        let mut half = self.first;
        loop {
            let within = [place.map(|x| x - half), place.map(|x| x + half)];
            self.grid.near(&within, self.mark, &mut self.near);
            self.mark = self.mark.wrapping_add(1);
            // What is nearer than the sides of the box is the nearest of all.
            let is_all = self.near.len() == self.triangles.len();
            match self.best(place) {
                Some(found) if found.distance <= half || is_all => return Some(found),
                None if !(half < f64::MAX) || self.triangles.is_empty() => return None,
                Some(_) | None => half = (2.0 * half).max(self.whole * f64::EPSILON).max(f64::MIN_POSITIVE),
            }
        }
    }

    /// The nearest of the triangles that were found.
    fn best(&self, place: Point) -> Option<Nearest> {
        let mut best: Option<(f64, usize, [f64; 3])> = None;
        for &index in &self.near {
            let x = self.triangles[index as usize].1.places(self.positions);
            let weights = on_triangle(&x, place);
            let arm = [0, 1, 2].map(|k| place[k] - weights[0] * x[0][k] - weights[1] * x[1][k] - weights[2] * x[2][k]);
            let square = dot(arm, arm);
            if best.is_none_or(|(least, ..)| square < least) {
                best = Some((square, index as usize, weights));
            }
        }
        let (square, index, weights) = best?;
        let (face, triangle) = &self.triangles[index];
        let mut shares = triangle.shares(weights);
        shares.retain(|(_, share)| *share > SLIGHT);
        let whole: f64 = shares.iter().map(|(_, share)| share).sum();
        shares.iter_mut().for_each(|(_, share)| *share /= whole);
        Some(Nearest { face: *face, shares, distance: square.sqrt() })
    }
}

/// The cells of a mesh, as tetrahedra by their boxes.
pub struct Within {
    tets: Tets,
    grid: Grid<3>,
    near: Vec<u32>,
    mark: u32,
}

impl Within {
    /// The cells of a mesh.
    ///
    /// # Errors
    /// `Size` for a node that is not there; `Inverted`.
    pub fn new(mesh: Mesh<'_>) -> Result<Self, Failure> {
        let tets = Tets::of(&Plan::all(Cut::Cells), mesh)?;
        let grid = Grid::new(tets.all.iter().map(|tet| bounds(&tets.places_of(tet))).collect());
        Ok(Self { tets, grid, near: Vec::new(), mark: 0 })
    }

    /// The nodes of the cell that a place is in, or is nearest to be in, with their shares, which add up to
    /// one; `None` for a mesh without cells.
    pub fn shares(&mut self, place: Point) -> Option<Vec<(u32, f64)>> {
        self.grid.near(&bounds(&[place]), self.mark, &mut self.near);
        self.mark = self.mark.wrapping_add(1);
        let all = 0..self.tets.all.len() as u32;
        let best = self.best(self.near.iter().copied(), place).filter(|(least, ..)| *least > -1e-9).or_else(|| self.best(all, place));
        let (_, tet, weights) = best?;
        Some(self.tets.of_nodes(&self.tets.all[tet as usize], weights))
    }

    /// The tetrahedron with the greatest least weight at a place, that, and its weights.
    fn best(&self, tets: impl Iterator<Item = u32>, place: Point) -> Option<(f64, u32, [f64; 4])> {
        let mut best: Option<(f64, u32, [f64; 4])> = None;
        for index in tets {
            let x = self.tets.places_of(&self.tets.all[index as usize]);
            let whole = six_volumes(&x);
            let weights = [0, 1, 2, 3].map(|k| {
                let mut with = x;
                with[k] = place;
                six_volumes(&with) / whole
            });
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            if best.is_none_or(|(most, ..)| least > most) {
                best = Some((least, index, weights));
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::super::vector::minus;
    use super::super::{Cell, Kind};
    use super::*;
    use crate::shared::random::Random;

    #[test]
    fn the_nearest_place_is_that_of_all_triangles() {
        // A bent strip of quadrilaterals and triangles.
        let mut positions = Vec::new();
        let mut faces = Vec::new();
        for i in 0..20u32 {
            let x = f64::from(i) * 0.1;
            positions.extend([[x, 0.0, (2.0 * x).sin()], [x, 0.3, (2.0 * x).cos()]]);
            if i > 0 {
                let [a, b, c, d] = [2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1];
                faces.extend(if i % 3 == 0 { vec![[a, b, c, c], [a, c, d, d]] } else { vec![[a, b, c, d]] });
            }
        }
        let mut outside = Outside::new(&positions, &faces);
        let mut random = Random::new(7);
        for far in [0.01, 1.0, 1e6] {
            for _ in 0..50 {
                let place = [0, 1, 2].map(|_| far * (2.0 * random.next() - 1.0));
                let found = outside.nearest(place).unwrap();
                outside.near = (0..outside.triangles.len() as u32).collect();
                let all = outside.best(place).unwrap();
                assert!((found.distance - all.distance).abs() <= 1e-12 * all.distance, "{found:?} {all:?}");
                let x = found
                    .shares
                    .iter()
                    .fold([0.0; 3], |sum, &(node, share)| [0, 1, 2].map(|k| sum[k] + share * positions[node as usize][k]));
                let arm = minus(place, x);
                assert!((dot(arm, arm).sqrt() - found.distance).abs() < 1e-3 + 1e-9 * far);
            }
        }
        assert_eq!(Outside::new(&positions, &[]).nearest([0.0; 3]), None);
    }

    #[test]
    fn places_within_have_the_shares_of_linear_functions() {
        let positions: Vec<Point> =
            Kind::Hexahedron.reference().iter().map(|x| [x[0] + 0.1 * x[1], x[1] - 0.2 * x[2], 2.0 * x[2]]).collect();
        let cells = [Cell::new(Kind::Hexahedron, &[0, 1, 2, 3, 4, 5, 6, 7]).unwrap()];
        let mut within = Within::new(Mesh { positions: &positions, cells: &cells }).unwrap();
        for place in [[0.1, 0.2, 0.3], [-0.5, 0.4, 1.2], [0.0; 3]] {
            let shares = within.shares(place).unwrap();
            let x = shares.iter().fold([0.0; 3], |sum, &(node, share)| [0, 1, 2].map(|k| sum[k] + share * positions[node as usize][k]));
            assert!((0..3).all(|k| (x[k] - place[k]).abs() < 1e-14), "{x:?} {place:?}");
        }
    }
}
