//! Obstacles in 3D in pictures: facets as they are; of a plane without end a finite piece around the
//! bodies, with a grid on it. Surfaces come from `outline`, boxes around bodies from `film` and `mesh`;
//! drawings go to `scene`.

use super::skin::Skin;
use crate::outline::{Extent, Surface, dot};
use crate::picture::scale::ticks;
use std::sync::Arc;

/// A plane without end is shown if bodies come closer to it than this fraction of their size.
const NEAR: f64 = 0.5;
/// Other obstacles as far as this fraction of the bodies' size beside them.
const ROOM: f64 = 0.5;
/// Obstacles that are more than so many times as large as the bodies don't make the picture larger than this
/// fraction beside them.
const LARGE: (f64, f64) = (2.5, 0.1);
/// Lines of a grid across the longer side.
const GRID: usize = 12;

/// What does not change of an obstacle during a run.
#[derive(Clone, Debug)]
pub(in crate::picture) struct Shape {
    pub(in crate::picture) facets: Vec<[u32; 4]>,
    pub(in crate::picture) is_endless: bool,
    skin: Arc<Skin>,
}

/// An obstacle of one moment.
#[derive(Clone, Debug)]
pub(in crate::picture) struct Solid {
    pub(super) skin: Arc<Skin>,
    /// Places of the skin's nodes, m.
    pub(super) points: Vec<[f64; 3]>,
    /// Lines on it, m.
    pub(super) grid: Vec<[[f64; 3]; 2]>,
    is_endless: bool,
}

impl Shape {
    /// That of a surface.
    pub(in crate::picture) fn of(surface: &Surface) -> Self {
        let piece = [[0, 1, 2, 3]];
        let (facets, points) = if surface.is_endless { (&piece[..], 4) } else { (&surface.facets[..], surface.points.len()) };
        Self { facets: surface.facets.clone(), is_endless: surface.is_endless, skin: Arc::new(Skin::of_obstacle(facets, points)) }
    }

    /// The obstacle with its points at these places, m, beside these bodies; none for what is gone,
    /// and for a plane without end that they are far from.
    pub(in crate::picture) fn solid(&self, points: &[[f64; 3]], bodies: Extent<3>) -> Option<Solid> {
        if points.is_empty() {
            return None;
        }
        let skin = Arc::clone(&self.skin);
        if !self.is_endless {
            let points = skin.nodes.iter().map(|&node| points.get(node as usize).copied().unwrap_or([f64::NAN; 3])).collect();
            return Some(Solid { skin, points, grid: Vec::new(), is_endless: false });
        }
        let surface = Surface { points: points.to_vec(), facets: self.facets.clone(), is_endless: true };
        let plane = surface.plane()?;
        let heights = corners(bodies).map(|corner| dot(plane.normal, minus(corner, plane.foot)));
        let (low, high) = heights.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &h| (low.min(h), high.max(h)));
        if !(low < NEAR * size(bodies) && high > -NEAR * size(bodies)) {
            return None;
        }
        let sides = plane.sides(bodies);
        let points = plane.rectangle(sides).to_vec();
        let step = ticks(0.0, (0..2).map(|k| sides[1][k] - sides[0][k]).fold(0.0, f64::max), GRID).step;
        let mut grid = Vec::new();
        for across in 0..2 {
            let along = 1 - across;
            let (first, last) = ((sides[0][across] / step).ceil(), (sides[1][across] / step).floor());
            for k in 0..((last - first + 1.0).clamp(0.0, 100.0) as usize) {
                let mut ends = [[0.0; 2]; 2];
                for end in 0..2 {
                    ends[end][across] = (first + k as f64) * step;
                    ends[end][along] = sides[end][along];
                }
                grid.push(ends.map(|end| plane.place(end)));
            }
        }
        Some(Solid { skin, points, grid, is_endless: true })
    }
}

impl Solid {
    /// What is to be seen of it beside these bodies.
    pub(in crate::picture) fn seen(&self, bodies: Extent<3>) -> impl Iterator<Item = [f64; 3]> + '_ {
        let own = self.points.iter().fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |box_, p| {
            [[0, 1, 2].map(|k| box_[0][k].min(p[k])), [0, 1, 2].map(|k| box_[1][k].max(p[k]))]
        });
        let room = size(bodies) * if size(own) > LARGE.0 * size(bodies) { LARGE.1 } else { ROOM };
        let is_seen = move |p: &&[f64; 3]| (0..3).all(|k| p[k] >= bodies[0][k] - room && p[k] <= bodies[1][k] + room);
        let is_endless = self.is_endless;
        self.points.iter().filter(move |p| is_endless || is_seen(p)).copied()
    }
}

/// The corners of a box.
fn corners(box_: Extent<3>) -> [[f64; 3]; 8] {
    std::array::from_fn(|corner| [0, 1, 2].map(|k| box_[corner >> k & 1][k]))
}

/// The longest side.
fn size(box_: Extent<3>) -> f64 {
    (0..3).map(|k| box_[1][k] - box_[0][k]).fold(0.0, f64::max)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODIES: Extent<3> = [[0.0, 0.0, 0.0], [2.0, 1.0, 1.0]];

    /// A large square at this height.
    fn floor(z: f64) -> Vec<[f64; 3]> {
        vec![[-1e4, -1e4, z], [1e4, -1e4, z], [1e4, 1e4, z], [-1e4, 1e4, z]]
    }

    fn solid(z: f64) -> Option<Solid> {
        let surface = Surface { points: floor(z), facets: vec![[0, 1, 2, 3]], is_endless: true };
        Shape::of(&surface).solid(&surface.points, BODIES)
    }

    #[test]
    fn a_floor_without_end_is_a_piece_under_the_bodies_with_a_grid() {
        let solid = solid(-0.2).unwrap();
        assert!(
            solid.points.iter().all(|p| (p[2] + 0.2).abs() < 1e-9 && p[0] > -1.0 && p[0] < 3.0 && p[1] > -1.0 && p[1] < 2.0),
            "{solid:?}"
        );
        assert!(solid.points.iter().any(|p| p[0] < 0.0 && p[1] > 1.0) && solid.points.iter().any(|p| p[0] > 2.0 && p[1] < 0.0));
        assert!((6..40).contains(&solid.grid.len()), "{}", solid.grid.len());
        assert!(solid.grid.iter().flatten().all(|p| (p[2] + 0.2).abs() < 1e-9 && p[0] > -1.0 && p[0] < 3.0));
        assert_eq!(solid.seen(BODIES).count(), 4);
    }

    #[test]
    fn a_floor_far_below_is_not_shown() {
        assert!(solid(-0.9).is_some() && solid(-1.1).is_none());
    }

    #[test]
    fn of_a_long_obstacle_what_is_near_makes_the_picture_larger() {
        let points: Vec<[f64; 3]> = [-50.0, 0.5, 2.1, 3.0].map(|x| [x, 0.0, -0.05]).into();
        let surface = Surface { points, facets: vec![[0, 1, 2, 3]], is_endless: false };
        let solid = Shape::of(&surface).solid(&surface.points, BODIES).unwrap();
        assert_eq!(solid.seen(BODIES).map(|p| p[0]).collect::<Vec<_>>(), [0.5, 2.1]);
    }
}
