//! Where the body of a part goes: mirrored, turned, moved, copied.
//!
//! Bodies come from the shapes and from mesh files, placements from the model; placed bodies go to the mesh.
//! Turns use the shapes' own sine: the same bits everywhere. In 2D the third components are zero, and turns
//! are about z.

use super::cell::CellKind;
use super::shapes::{Body, cos_sin, quarters, unit};
use super::surface::Corners;
use super::{Dim, Meshed};
use crate::model::TriangleSurface;
use crate::model::placement::{ALONG_Z, Placement};

/// A turn by an angle (rad) about an axis.
pub(crate) struct Turn {
    pub(crate) angle: f64,
    pub(crate) about: [f64; 3],
    pub(crate) axis: [f64; 3],
}

impl Placement {
    /// The body, placed: first mirrored, then turned, then moved; copies follow each other, and their
    /// elements and nodes are numbered so.
    pub(super) fn applied<const D: usize>(&self, mut body: Body<D>) -> Body<D>
    where
        Dim<D>: Meshed<D>,
    {
        if self.mirror.is_some() {
            body.turn_over();
        }
        let one = body.clone();
        self.place(&mut body.positions, 0);
        for copy in 1..self.count() {
            let mut next = one.clone();
            self.place(&mut next.positions, copy);
            body.append(next);
        }
        body
    }

    /// Moves points to where they are in one of the bodies, which are counted from 0.
    pub(super) fn place<const D: usize>(&self, positions: &mut [[f64; D]], copy: usize) {
        if let Some(mirror) = &self.mirror {
            let n = unit(mirror.normal).unwrap_or_default();
            for x in positions.iter_mut() {
                let along = (1..D).fold((x[0] - mirror.point[0]) * n[0], |sum, d| sum + (x[d] - mirror.point[d]) * n[d]);
                *x = std::array::from_fn(|d| x[d] - 2.0 * along * n[d]);
            }
        }
        turn(positions, &Turn { angle: self.rotation, about: self.rotation_point, axis: self.rotation_axis }, 1);
        shift(positions, self.translation, 1);
        if let Some(copies) = self.copies.as_ref().filter(|_| copy > 0) {
            turn(positions, &Turn { angle: copies.angle, about: copies.point, axis: copies.axis }, copy);
            shift(positions, copies.translation, copy);
        }
    }
}

/// Numbers the nodes of a cell again after their positions were mirrored: what was on the left, or above,
/// still is. Lines have a left in 2D only.
pub(super) fn turn_over<const D: usize>(kind: CellKind, nodes: &mut [u32]) {
    if D == 2 && kind == CellKind::Line {
        nodes.reverse();
    } else {
        kind.reflect(nodes);
    }
}

/// The same of pieces of a surface, which follow each other the other way round.
pub(super) fn turn_pieces_over<F: Corners>(facets: &mut [F]) {
    facets.reverse();
    facets.iter_mut().for_each(|facet| *facet = facet.reversed());
}

impl TriangleSurface {
    /// The same turned and moved; mirrors and copies don't count.
    #[must_use]
    pub fn placed(mut self, placement: &Placement) -> Self {
        let by = Turn { angle: placement.rotation, about: placement.rotation_point, axis: placement.rotation_axis };
        turn(&mut self.positions, &by, 1);
        shift(&mut self.positions, placement.translation, 1);
        self
    }
}

impl<const D: usize> Body<D>
where
    Dim<D>: Meshed<D>,
{
    /// Numbers the nodes of elements and sides again for positions that are mirrored.
    fn turn_over(&mut self) {
        for (&kind, nodes) in &mut self.elements {
            nodes.chunks_exact_mut(kind.nodes()).for_each(|cell| turn_over::<D>(kind, cell));
        }
        self.sides.iter_mut().for_each(|(_, facets)| turn_pieces_over(facets));
    }

    /// Adds another body of the same shape: its elements after those that there are, its sides to those of
    /// the same name.
    fn append(&mut self, other: Self) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        for (kind, nodes) in &other.elements {
            self.elements.entry(*kind).or_default().extend(nodes.iter().map(|node| node + first));
        }
        for ((_, all), (_, own)) in self.points.iter_mut().zip(other.points) {
            all.extend(own.iter().map(|node| node + first));
        }
        for ((_, all), (_, own)) in self.sides.iter_mut().zip(other.sides) {
            all.extend(own.into_iter().map(|facet| facet.renamed(|node| node + first)));
        }
    }
}

/// Turns points `times` times: x ← p + (r·u) u + cos α (r − (r·u) u) + sin α u × r with r = x − p.
pub(crate) fn turn<const D: usize>(positions: &mut [[f64; D]], turn: &Turn, times: usize) {
    if turn.angle == 0.0 {
        return;
    }
    let ([c, s], about) = (cos_sin(quarters(turn.angle) * times as f64), turn.about);
    let [u, v, w] = unit(turn.axis).unwrap_or(ALONG_Z);
    for x in positions {
        let mut r = [0.0; 3];
        (0..D).for_each(|d| r[d] = x[d] - about[d]);
        let [a, b, z] = r;
        if D == 2 {
            (x[0], x[1]) = (about[0] + (c * a - s * b), about[1] + (s * a + c * b));
            continue;
        }
        let along = a * u + b * v + z * w;
        let (axis, crossed) = ([u, v, w], [v * z - w * b, w * a - u * z, u * b - v * a]);
        for d in 0..D {
            let fixed = along * axis[d];
            x[d] = about[d] + (fixed + c * (r[d] - fixed) + s * crossed[d]);
        }
    }
}

pub(crate) fn shift<const D: usize>(positions: &mut [[f64; D]], by: [f64; 3], times: usize) {
    if by != [0.0; 3] {
        positions.iter_mut().for_each(|x| *x = std::array::from_fn(|d| x[d] + times as f64 * by[d]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{BuiltIn, Cuboid, rectangle, ring};
    use crate::mesh::surface::{Surface, exterior};
    use crate::model::{Copies, Mirror};

    fn is_sound(body: &Body<2>) {
        for cell in body.cells() {
            let n = cell.nodes.len();
            let x = |k: usize| body.positions[cell.nodes[k % n] as usize];
            for k in 0..n {
                let (a, b, d) = (x(k), x(k + 1), x(k + n - 1));
                assert!((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) > 0.0);
            }
        }
        let mut outside = exterior::<2>(body.cells()).unwrap();
        let mut sides: Vec<_> = body.sides.iter().flat_map(|side| side.1.clone()).collect();
        outside.sort_unstable();
        sides.sort_unstable();
        assert_eq!(outside, sides);
        assert!(body.sides.iter().all(|(_, segments)| Surface::<2>::new(segments.clone(), body.cells()).is_ok()));
    }

    #[test]
    fn a_mirrored_body_keeps_its_orientation_and_its_sides_their_names() {
        let mirror = Some(Mirror { point: [1.0, 0.0, 0.0], normal: [2.0, 0.0, 0.0] });
        let body = Placement { mirror, ..Placement::default() }.applied(rectangle([0.0, 0.0], [0.5, 1.0], [2, 3]));
        is_sound(&body);
        let left = &body.sides.iter().find(|side| side.0 == "left").unwrap().1;
        assert!(left.iter().flatten().all(|&node| body.positions[node as usize][0] == 2.0), "what was left is on the right");
        assert!(left.windows(2).all(|pair| pair[0][1] == pair[1][0]));
        let skew = Some(Mirror { point: [0.0; 3], normal: [1.0, -1.0, 0.0] });
        let body = Placement { mirror: skew, ..Placement::default() }.applied(rectangle([1.0, 0.0], [2.0, 0.5], [1, 1]));
        let far = body.positions[3];
        assert!((far[0] - 0.5).abs() < 1e-15 && (far[1] - 3.0).abs() < 1e-15, "x and y change places: {far:?}");
    }

    #[test]
    fn a_quarter_turn_is_exact() {
        let rotation = std::f64::consts::FRAC_PI_2;
        let placement = Placement { rotation, rotation_point: [1.0, 1.0, 0.0], translation: [0.0, -1.0, 0.0], ..Placement::default() };
        let body = placement.applied(rectangle([1.0, 1.0], [2.0, 0.5], [2, 1]));
        is_sound(&body);
        assert_eq!([body.positions[2], body.positions[5]], [[1.0, 2.0], [0.5, 2.0]]);
    }

    #[test]
    fn a_solid_is_mirrored_turned_about_any_axis_and_copied() {
        let cuboid = || Cuboid { corner: [1.0, 0.0, 0.0], size: [1.0, 2.0, 3.0], elements: [2, 2, 2], ..Cuboid::default() }.body().unwrap();
        let is_sound = |body: &Body<3>| {
            let at = |cell: &[u32]| cell.iter().map(|&node| body.positions[node as usize]).collect::<Vec<_>>();
            assert!(body.cells().all(|cell| Dim::<3>::wrong_form(cell.kind, &at(cell.nodes)).is_none()));
            let mut outside = exterior::<3>(body.cells()).unwrap();
            let mut sides: Vec<_> = body.sides.iter().flat_map(|side| side.1.iter().map(|facet| facet.canonical())).collect();
            outside.sort_unstable();
            sides.sort_unstable();
            assert_eq!(outside, sides);
        };
        let mirror = Some(Mirror { point: [0.0; 3], normal: [1.0, 0.0, 0.0] });
        let body = Placement { mirror, ..Placement::default() }.applied(cuboid());
        is_sound(&body);
        let left = &body.sides.iter().find(|side| side.0 == "left").unwrap().1;
        assert!(left.iter().flatten().all(|&node| body.positions[node as usize][0] == -1.0));
        // A third of a turn about the diagonal exchanges the axes.
        let rotation = std::f64::consts::TAU / 3.0;
        let body = Placement { rotation, rotation_axis: [1.0; 3], ..Placement::default() }.applied(cuboid());
        is_sound(&body);
        assert!(cuboid().positions.iter().zip(&body.positions).all(|(x, y)| (0..3).all(|d| (y[d] - x[(d + 2) % 3]).abs() < 4e-15)));
        let angle = std::f64::consts::FRAC_PI_2;
        let copies = Some(Copies { count: 4, angle, axis: [0.0, 2.0, 0.0], point: [-1.0, 0.0, -1.0], ..Copies::default() });
        let body = Placement { copies, translation: [0.5, 0.5, 0.5], ..Placement::default() }.applied(cuboid());
        is_sound(&body);
        assert_eq!((body.positions.len(), body.positions[0], body.positions[27]), (108, [1.5, 0.5, 0.5], [0.5, 0.5, -3.5]));
    }

    #[test]
    fn copies_stand_in_a_row_or_around_a_point() {
        let one = ring([3.0, 0.0], 0.2, 0.5, 0.0, std::f64::consts::TAU, [1, 8]);
        let angle = std::f64::consts::FRAC_PI_2;
        let around = Copies { count: 4, angle, ..Copies::default() };
        let body = Placement { copies: Some(around), ..Placement::default() }.applied(one.clone());
        is_sound(&body);
        let (nodes, elements) = (one.positions.len(), one.cells().count());
        assert_eq!((body.positions.len(), body.cells().count()), (4 * nodes, 4 * elements));
        assert_eq!(body.positions[2 * nodes], [-one.positions[0][0], 0.0 - one.positions[0][1]]);
        let row = Copies { count: 3, translation: [2.0, 0.25, 0.0], ..Copies::default() };
        let body = Placement { copies: Some(row), ..Placement::default() }.applied(one.clone());
        assert_eq!(body.positions[2 * nodes], [one.positions[0][0] + 4.0, one.positions[0][1] + 0.5]);
    }
}
