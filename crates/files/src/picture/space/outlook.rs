//! From where a place in a model in 3D is seen best, and what must be cut away where it is seen from
//! nowhere: for the pictures of a post-mortem.
//!
//! Cells and places come from `near` and `spot`. Of the model's own camera and the eight corners of a box
//! that is taken from which least veils the place; where something does, a crater is cut, and the mesh shows
//! its inside around it.

use super::camera::Directions;
use super::sides::{corners, is_sound, sides_of};
use crate::outline::dot;
use embate_solver::model::Camera;
use embate_solver::output::Cells;

/// Half the opening of a crater over its depth.
const CRATER: f64 = 0.8;
/// What an obstacle before the place counts, in cells: it is drawn as a veil, and can't be cut.
const VEIL: f64 = 4.0;
/// What it counts that a direction is not that of the model's camera.
const UNUSUAL: f64 = 0.5;

/// What is looked at.
pub(super) struct Target {
    /// Its middle, m.
    pub(super) centre: [f64; 3],
    /// Points of it that shall be seen, with the direction in which its surface faces there; none: seen from
    /// anywhere.
    pub(super) points: Vec<([f64; 3], Option<[f64; 3]>)>,
    /// Cells that are it.
    pub(super) own: Vec<u32>,
}

/// A direction, and the cells (ascending) that are left out.
pub(super) struct Outlook {
    pub(super) directions: Directions,
    pub(super) gone: Vec<u32>,
}

/// All cells of a moment, their places, and triangles of obstacles.
pub(super) struct Sights<'a> {
    pub(super) cells: &'a Cells,
    pub(super) places: &'a [[f64; 3]],
    pub(super) obstacles: &'a [[[f64; 3]; 3]],
}

/// The directions that are tried: that of the camera first.
fn tried(camera: &Camera) -> Vec<Directions> {
    let usual = Camera::default();
    let own = Directions::of(camera);
    let mut tried = vec![own];
    for octant in 0..8usize {
        let from = [0, 1, 2].map(|k| if octant >> k & 1 == 1 { -usual.from[k] } else { usual.from[k] });
        let other = Directions::of(&Camera { from, up: camera.up, ..usual });
        if dot(other.towards, own.towards) < 1.0 - 1e-9 {
            tried.push(other);
        }
    }
    tried
}

impl Outlook {
    /// The best one for a target in these moments; `gone` (ascending) are not there.
    pub(super) fn best(moments: &[(Sights<'_>, Target)], camera: &Camera, gone: &[u32]) -> Self {
        let mut best: Option<(f64, Self)> = None;
        for (index, directions) in tried(camera).into_iter().enumerate() {
            let (mut hiding, mut veils) = (Vec::new(), 0);
            for (sights, target) in moments {
                let seen = seen_points(target, &directions);
                hiding.extend(sights.hiding(target, &seen, &directions, gone));
                veils +=
                    usize::from(sights.obstacles.iter().any(|triangle| seen.iter().any(|&x| is_behind(triangle, x, &directions, 0.0))));
            }
            hiding.sort_unstable();
            hiding.dedup();
            let score = hiding.len() as f64 + VEIL * veils as f64 / moments.len().max(1) as f64 + if index > 0 { UNUSUAL } else { 0.0 };
            if best.as_ref().is_none_or(|(least, _)| score < *least) {
                best = Some((score, Self { directions, gone: hiding }));
            }
        }
        let mut best = best.map_or_else(|| Self { directions: Directions::of(camera), gone: Vec::new() }, |(_, best)| best);
        if !best.gone.is_empty() {
            for (sights, target) in moments {
                let crater = sights.crater(target, &best.directions, gone);
                best.gone.extend(crater);
            }
            best.gone.sort_unstable();
            best.gone.dedup();
        }
        best
    }
}

/// Points of the side of a target that faces the viewer.
fn seen_points(target: &Target, directions: &Directions) -> Vec<[f64; 3]> {
    let faces = |facing: &Option<[f64; 3]>| facing.is_none_or(|normal| dot(normal, directions.towards) > 0.0);
    let seen: Vec<[f64; 3]> = target.points.iter().filter(|(_, facing)| faces(facing)).map(|&(x, _)| x).collect();
    // Of what is inside out all is looked for.
    if seen.is_empty() { target.points.iter().map(|&(x, _)| x).collect() } else { seen }
}

impl Sights<'_> {
    fn is_there(&self, cell: usize, target: &Target, gone: &[u32]) -> bool {
        is_sound(self.cells, cell) && !target.own.contains(&(cell as u32)) && gone.binary_search(&(cell as u32)).is_err()
    }

    fn at(&self, node: u32) -> [f64; 3] {
        self.places.get(node as usize).copied().unwrap_or([f64::NAN; 3])
    }

    /// Cells before one of these points.
    fn hiding(&self, target: &Target, points: &[[f64; 3]], directions: &Directions, gone: &[u32]) -> Vec<u32> {
        let is_hiding = |&cell: &usize| {
            self.is_there(cell, target, gone) && {
                let nodes = || self.cells.cell(cell).iter().map(|&node| self.at(node));
                let depth = |x: [f64; 3]| dot(directions.towards, x);
                let (back, front) = nodes().map(depth).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
                // Beyond its own roundness nothing lies against a point.
                let least = 1e-3 * (front - back);
                points.iter().filter(|&&x| front > depth(x) + least).any(|&x| {
                    sides_of(self.cells.kinds[cell]).iter().any(|side| {
                        let [a, b, c, d] = corners(self.cells, cell, side).map(|node| self.at(node));
                        is_behind(&[a, b, c], x, directions, least) || is_behind(&[a, c, d], x, directions, least)
                    })
                })
            }
        };
        (0..self.cells.len()).filter(is_hiding).map(|cell| cell as u32).collect()
    }

    /// Cells whose middles lie in a cone that opens from the target to the viewer.
    fn crater(&self, target: &Target, directions: &Directions, gone: &[u32]) -> Vec<u32> {
        let [x, y, z] = directions.seen(target.centre);
        let is_within = |&cell: &usize| {
            let nodes = self.cells.cell(cell);
            let sum = nodes.iter().map(|&node| self.at(node)).fold([0.0; 3], |sum, x| [0, 1, 2].map(|k| sum[k] + x[k]));
            let [right, up, towards] = directions.seen(sum.map(|v| v / nodes.len().max(1) as f64));
            let (aside, before) = ((right - x).hypot(up - y), towards - z);
            before > 0.0 && aside < CRATER * before && self.is_there(cell, target, gone)
        };
        (0..self.cells.len()).filter(is_within).map(|cell| cell as u32).collect()
    }
}

/// Whether a point is behind a triangle, to who looks at it, by more than a distance, m. The border of the
/// triangle does not hide.
fn is_behind(triangle: &[[f64; 3]; 3], x: [f64; 3], directions: &Directions, least: f64) -> bool {
    let place = directions.seen(x);
    let p = triangle.map(|corner| {
        let seen = directions.seen(corner);
        [0, 1, 2].map(|k| seen[k] - place[k])
    });
    let twice = |a: [f64; 3], b: [f64; 3]| a[0] * b[1] - a[1] * b[0];
    let shares = [twice(p[1], p[2]), twice(p[2], p[0]), twice(p[0], p[1])];
    let area = shares[0] + shares[1] + shares[2];
    // What is no number hides nothing.
    let inside = shares.iter().all(|share| share / area > 1e-6);
    inside && (0..3).map(|k| shares[k] / area * p[k][2]).sum::<f64>() > least
}

impl Target {
    /// A cell: its sides.
    pub(super) fn cell(cells: &Cells, places: &[[f64; 3]], cell: u32) -> Self {
        let nodes = cells.cell(cell as usize);
        let at = |node: u32| places.get(node as usize).copied().unwrap_or([f64::NAN; 3]);
        let mean = |points: &[[f64; 3]]| {
            let sum = points.iter().fold([0.0; 3], |sum, x| [0, 1, 2].map(|k| sum[k] + x[k]));
            sum.map(|v| v / points.len().max(1) as f64)
        };
        let centre = mean(&nodes.iter().map(|&node| at(node)).collect::<Vec<_>>());
        let mut points = Vec::new();
        let sides = if is_sound(cells, cell as usize) { sides_of(cells.kinds[cell as usize]) } else { Default::default() };
        for side in sides {
            let own = corners(cells, cell as usize, side).map(at);
            let middle = mean(&own);
            let facing = [0, 1, 2].map(|k| middle[k] - centre[k]);
            // Near its corners and in its middle.
            let near = own.map(|x| [0, 1, 2].map(|k| x[k] + 0.2 * (middle[k] - x[k])));
            points.extend(near.into_iter().chain([middle]).map(|x| (x, Some(facing))));
        }
        if points.is_empty() {
            points.push((centre, None));
        }
        Self { centre, points, own: vec![cell] }
    }

    /// A place.
    pub(super) fn point(centre: [f64; 3]) -> Self {
        Self { centre, points: vec![(centre, None)], own: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sides::tests::block;
    use super::*;

    /// Looks at a cell of a block of unit cubes.
    fn looked_at(size: [u32; 3], cell: u32, obstacles: &[[[f64; 3]; 3]]) -> Outlook {
        let cells = block(size);
        let count = size.map(|n| n + 1);
        let places: Vec<[f64; 3]> = (0..count[0] * count[1] * count[2])
            .map(|node| [node % count[0], node / count[0] % count[1], node / (count[0] * count[1])].map(f64::from))
            .collect();
        let target = Target::cell(&cells, &places, cell);
        Outlook::best(&[(Sights { cells: &cells, places: &places, obstacles }, target)], &Camera::default(), &[])
    }

    #[test]
    fn a_cell_at_a_corner_is_seen_from_that_corner_and_nothing_is_cut() {
        for corner in 0..8u32 {
            let [x, y, z] = [0, 1, 2].map(|k| 4 * (corner >> k & 1));
            let outlook = looked_at([5; 3], x + 5 * y + 25 * z, &[]);
            assert!(outlook.gone.is_empty(), "{corner}: {:?}", outlook.gone);
            // It is seen from where at least one of its three free sides is.
            let free = [x, y, z].map(|at| if at > 0 { 1.0 } else { -1.0 });
            assert!((0..3).any(|k| free[k] * outlook.directions.towards[k] > 0.0));
        }
        // To the right, in front and on top: that is where the usual camera is.
        assert_eq!(looked_at([5; 3], 104, &[]).directions, Directions::of(&Camera::default()), "the camera of the model where it will do");
    }

    #[test]
    fn a_crater_opens_to_a_cell_within_a_block() {
        let outlook = looked_at([5; 3], 62, &[]);
        assert!(!outlook.gone.is_empty() && !outlook.gone.contains(&62));
        let towards = outlook.directions.towards;
        for &cell in &outlook.gone {
            let arm = [cell % 5, cell / 5 % 5, cell / 25].map(|at| f64::from(at) - 2.0);
            assert!(dot(arm, towards) > 0.0, "what is behind it stays: {arm:?}");
        }
        assert!(outlook.gone.len() < 62, "{}", outlook.gone.len());
    }

    #[test]
    fn an_obstacle_before_the_place_turns_the_camera() {
        // A wall without cells behind it on the usual side.
        let far = 100.0;
        let wall = [[[-far, -1.0, -far], [far, -1.0, -far], [0.0, -1.0, far]]];
        let outlook = looked_at([1; 3], 0, &wall);
        assert!(outlook.gone.is_empty() && outlook.directions.towards[1] > 0.0, "{:?}", outlook.directions);
    }
}
