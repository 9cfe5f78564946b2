//! Where the body of a built-in shape goes: mirrored, turned, moved, copied.
//!
//! Bodies come from the shapes, placements from the model; placed bodies go to the mesh. Turns use the shapes' own sine: the same bits everywhere.

use super::shapes::{Body, cos_sin, quarters};
use crate::load::constraint::unit;

/// Where the body of a built-in shape goes: it is mirrored, then turned, then moved, then copied.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placement {
    /// A line that it is mirrored on.
    pub mirror: Option<Mirror>,
    /// Angle by which it is turned, rad, counter-clockwise.
    pub rotation: f64,
    /// Point about which it is turned, m.
    pub rotation_point: [f64; 2],
    /// How far it is moved, m.
    pub translation: [f64; 2],
    /// How often it is there.
    pub copies: Option<Copies>,
}

/// A line to mirror on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mirror {
    /// A point of it, m.
    pub point: [f64; 2],
    /// Its normal, of any length but zero.
    pub normal: [f64; 2],
}

/// Bodies of one part that follow each other: each is turned and then moved as often as there are others before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Copies {
    /// How many bodies there are in all.
    pub count: usize,
    /// How far each is moved from the one before, m.
    pub translation: [f64; 2],
    /// Angle by which each is turned from the one before, rad, counter-clockwise.
    pub angle: f64,
    /// Point about which they are turned, m.
    pub point: [f64; 2],
}

impl Placement {
    /// The body, placed: first mirrored, then turned, then moved; copies follow each other, and their elements and nodes are numbered so.
    pub(super) fn applied(&self, mut body: Body) -> Body {
        if let Some(mirror) = &self.mirror {
            let n = unit(mirror.normal).unwrap_or_default();
            for x in &mut body.positions {
                let twice = 2.0 * ((x[0] - mirror.point[0]) * n[0] + (x[1] - mirror.point[1]) * n[1]);
                *x = [x[0] - twice * n[0], x[1] - twice * n[1]];
            }
            // What was on the left is on the right now.
            body.quads.iter_mut().for_each(|quad| quad.reverse());
            body.triangles.iter_mut().for_each(|triangle| triangle.reverse());
            for (_, segments) in &mut body.sides {
                segments.reverse();
                segments.iter_mut().for_each(|segment| segment.reverse());
            }
        }
        turn(&mut body.positions, self.rotation, self.rotation_point, 1);
        shift(&mut body.positions, self.translation, 1);
        let Some(copies) = &self.copies else { return body };
        let one = body.clone();
        let nodes = one.positions.len() as u32;
        for copy in 1..copies.count {
            let first = copy as u32 * nodes;
            let mut positions = one.positions.clone();
            turn(&mut positions, copies.angle, copies.point, copy);
            shift(&mut positions, copies.translation, copy);
            body.positions.extend(positions);
            body.quads.extend(one.quads.iter().map(|quad| quad.map(|node| node + first)));
            body.triangles.extend(one.triangles.iter().map(|triangle| triangle.map(|node| node + first)));
            body.bars.extend(one.bars.iter().map(|bar| bar.map(|node| node + first)));
            for ((_, all), (_, own)) in body.points.iter_mut().zip(&one.points) {
                all.extend(own.iter().map(|node| node + first));
            }
            for ((_, all), (_, own)) in body.sides.iter_mut().zip(&one.sides) {
                all.extend(own.iter().map(|segment| segment.map(|node| node + first)));
            }
        }
        body
    }
}

/// Turns points `times` times by an angle (rad) about a point.
fn turn(positions: &mut [[f64; 2]], angle: f64, about: [f64; 2], times: usize) {
    if angle == 0.0 {
        return;
    }
    let [c, s] = cos_sin(quarters(angle) * times as f64);
    for x in positions {
        let [a, b] = [x[0] - about[0], x[1] - about[1]];
        *x = [about[0] + (c * a - s * b), about[1] + (s * a + c * b)];
    }
}

fn shift(positions: &mut [[f64; 2]], by: [f64; 2], times: usize) {
    if by != [0.0; 2] {
        positions.iter_mut().for_each(|x| *x = [x[0] + times as f64 * by[0], x[1] + times as f64 * by[1]]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::{rectangle, ring};
    use crate::mesh::surface::{Surface, exterior};

    fn is_sound(body: &Body) {
        for cell in body.cells() {
            let x = |k: usize| body.positions[cell[k % cell.len()] as usize];
            for k in 0..cell.len() {
                let (a, b, d) = (x(k), x(k + 1), x(k + cell.len() - 1));
                assert!((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) > 0.0);
            }
        }
        let mut outside = exterior(body.cells()).unwrap();
        let mut sides: Vec<_> = body.sides.iter().flat_map(|side| side.1.clone()).collect();
        outside.sort_unstable();
        sides.sort_unstable();
        assert_eq!(outside, sides);
        assert!(body.sides.iter().all(|(_, segments)| Surface::new(segments.clone(), body.cells()).is_ok()));
    }

    #[test]
    fn a_mirrored_body_keeps_its_orientation_and_its_sides_their_names() {
        let mirror = Some(Mirror { point: [1.0, 0.0], normal: [2.0, 0.0] });
        let body = Placement { mirror, ..Placement::default() }.applied(rectangle([0.0, 0.0], [0.5, 1.0], [2, 3]));
        is_sound(&body);
        let left = &body.sides.iter().find(|side| side.0 == "left").unwrap().1;
        assert!(left.iter().flatten().all(|&node| body.positions[node as usize][0] == 2.0), "what was left is on the right");
        assert!(left.windows(2).all(|pair| pair[0][1] == pair[1][0]));
        let skew = Some(Mirror { point: [0.0, 0.0], normal: [1.0, -1.0] });
        let body = Placement { mirror: skew, ..Placement::default() }.applied(rectangle([1.0, 0.0], [2.0, 0.5], [1, 1]));
        let far = body.positions[3];
        assert!((far[0] - 0.5).abs() < 1e-15 && (far[1] - 3.0).abs() < 1e-15, "x and y change places: {far:?}");
    }

    #[test]
    fn a_quarter_turn_is_exact() {
        let rotation = std::f64::consts::FRAC_PI_2;
        let placement = Placement { rotation, rotation_point: [1.0, 1.0], translation: [0.0, -1.0], ..Placement::default() };
        let body = placement.applied(rectangle([1.0, 1.0], [2.0, 0.5], [2, 1]));
        is_sound(&body);
        assert_eq!([body.positions[2], body.positions[5]], [[1.0, 2.0], [0.5, 2.0]]);
    }

    #[test]
    fn copies_stand_in_a_row_or_around_a_point() {
        let one = ring([3.0, 0.0], 0.2, 0.5, 0.0, std::f64::consts::TAU, [1, 8]);
        let angle = std::f64::consts::FRAC_PI_2;
        let around = Copies { count: 4, angle, point: [0.0; 2], translation: [0.0; 2] };
        let body = Placement { copies: Some(around), ..Placement::default() }.applied(one.clone());
        is_sound(&body);
        let (nodes, elements) = (one.positions.len(), one.quads.len());
        assert_eq!((body.positions.len(), body.quads.len()), (4 * nodes, 4 * elements));
        assert_eq!(body.positions[2 * nodes], [-one.positions[0][0], 0.0 - one.positions[0][1]]);
        let row = Copies { count: 3, angle: 0.0, point: [0.0; 2], translation: [2.0, 0.25] };
        let body = Placement { copies: Some(row), ..Placement::default() }.applied(one.clone());
        assert_eq!(body.positions[2 * nodes], [one.positions[0][0] + 4.0, one.positions[0][1] + 0.5]);
    }
}
