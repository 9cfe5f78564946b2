//! Local thickness of bodies: how far the surface opposite is, along the inward normal.
//!
//! For each facet the ray from its middle finds the opposite skin once, in the initial places; what lies
//! there is followed as it moves, so that a crushed body is as thin as it is. What bulges is no thicker than
//! it was. Where the ray leaves the body at less than 30 degrees to the surface there, as in a wedge, the
//! body is as thick as 6 V / S with its volume V and its surface S: twice the radius of the inscribed ball of
//! polyhedra that have one, one and a half times the diameter of a long rod.

use super::skin::{Bodies, Facet, Skin};
use super::tree::Tree;
use crate::contact::obstacle::behind::{See, Thick};
use crate::contact::projection::node_facet::{Vector, unit};
use crate::mesh::surface::NONE;
use crate::tensor::{cross, dot};
use crate::vector::{length, minus};

/// Cosine between a normal and that of the opposite skin.
const OPPOSITE: f64 = -0.5;
/// How far beside a triangle a ray may pass and still meet it, as a share.
const BESIDE: f64 = 1e-9;

/// What is opposite of a facet: a triangle, or [`NONE`], and the shares of its corners; and how thick the
/// body was, m. On a symmetry plane the body continues as its image.
#[derive(Debug)]
struct Opposite {
    triangle: u32,
    shares: [f64; 3],
    most: f64,
}

/// What is opposite of each facet.
#[derive(Debug, Default)]
pub(super) struct Thickness(Vec<Opposite>);

/// 6 V / S of each body, m: of a half on a symmetry plane as of the whole. Infinite where the surface is not
/// closed.
fn stout(skin: &Skin) -> Vec<f64> {
    let mut sums = vec![(None, 0.0, 0.0); skin.bodies as usize];
    for facet in &skin.facets {
        let (origin, six_volumes, surface): &mut (Option<Vector>, f64, f64) = &mut sums[facet.body as usize];
        for triangle in facet.triangles() {
            let ([a, _, _], double) = (skin.corners(triangle), skin.double(triangle));
            *six_volumes += dot(minus(a, *origin.get_or_insert(a)), double);
            *surface += if facet.is_mirror { 0.0 } else { 0.5 * length(double) };
        }
    }
    for (sum, is_closed) in sums.iter_mut().zip(skin.are_closed()) {
        sum.1 = if is_closed { sum.1 } else { 0.0 };
    }
    let of = |(_, six_volumes, surface)| if six_volumes > 0.0 && surface > 0.0 { six_volumes / surface } else { f64::INFINITY };
    sums.into_iter().map(of).collect()
}

impl Thickness {
    /// Of the facets of a skin in its places.
    pub(super) fn new(skin: &Skin, tree: &Tree) -> Self {
        let of = |facet: &Facet| {
            if skin.is_labelled(facet) {
                return opposite_of_beam(skin, tree, facet);
            }
            let (from, normal) = middle(skin, facet.first);
            let mut nearest = (f64::INFINITY, (NONE, [0.0; 3]));
            let inward = normal.map(|n| -n);
            tree.along(skin, facet.body, from, inward, |triangle| {
                if let Some((away, shares)) = meets(from, inward, skin.corners(triangle))
                    && away < nearest.0
                    && !facet.triangles().contains(&triangle)
                {
                    nearest = (away, (triangle, shares));
                }
            });
            let (triangle, shares) = nearest.1;
            Opposite { triangle, shares, most: f64::INFINITY }
        };
        let mut made = Self(skin.facets.iter().map(of).collect());
        let stout = stout(skin);
        for at in 0..skin.facets.len() {
            let facet = &skin.facets[at];
            made.0[at].most = if made.0[at].triangle == NONE { stout[facet.body as usize] } else { made.of(skin, facet.first) };
        }
        made
    }

    /// Thickness of the body behind a triangle now, m.
    pub(super) fn of(&self, skin: &Skin, triangle: u32) -> f64 {
        let facet = skin.facet_of[triangle as usize] as usize;
        let Opposite { triangle, shares, most } = self.0[facet];
        if triangle == NONE {
            return most;
        }
        let x = skin.corners(triangle);
        let foot = [0, 1, 2].map(|d| shares[0] * x[0][d] + shares[1] * x[1][d] + shares[2] * x[2][d]);
        let way = length(minus(foot, centre(skin, &skin.facets[facet])));
        if skin.is_mirror(triangle) { 2.0 * way } else { way }.min(most)
    }

    /// The same of each facet.
    pub(super) fn of_all(&self, skin: &Skin) -> Vec<f64> {
        skin.facets.iter().map(|facet| self.of(skin, facet.first)).collect()
    }

    /// The least of the facets that share these vertices now, m: whichever of them is taken for the nearest.
    pub(super) fn sharing(&self, skin: &Skin, vertices: &[u32]) -> f64 {
        least_sharing(skin, vertices, |triangle| self.of(skin, triangle))
    }

    /// The largest of each body, m.
    pub(super) fn thickest(&self, skin: &Skin) -> Vec<f64> {
        let mut thickest = vec![0.0; skin.bodies as usize];
        for facet in skin.facets.iter().filter(|facet| !facet.is_mirror) {
            let most: &mut f64 = &mut thickest[facet.body as usize];
            *most = most.max(self.of(skin, facet.first));
        }
        // Bodies may grow thicker.
        thickest.into_iter().map(|most: f64| 2.0 * most).collect()
    }

    /// The least of all, m.
    pub(super) fn least(&self, skin: &Skin) -> f64 {
        let surface = skin.facets.iter().filter(|facet| !facet.is_mirror);
        surface.map(|facet| self.of(skin, facet.first)).fold(f64::INFINITY, f64::min)
    }
}

/// The least thickness of the facets that share vertices, where `of` says that of the facet of a triangle, m.
pub(super) fn least_sharing(skin: &Skin, vertices: &[u32], of: impl Fn(u32) -> f64) -> f64 {
    let surface = skin.sharing(vertices).filter(|&triangle| !skin.is_mirror(triangle));
    surface.map(of).fold(f64::INFINITY, f64::min)
}

/// Bodies with how thick they are, for what meets their facets one by one.
#[derive(Debug)]
pub struct Walls {
    skin: Skin,
    thickness: Thickness,
}

impl Walls {
    /// Of bodies at their initial `positions`, m.
    #[must_use]
    pub fn new(bodies: &Bodies<'_>, positions: &[Vector]) -> Self {
        let mut skin = Skin::new(bodies);
        skin.place(positions);
        let mut tree = Tree::new(&skin);
        tree.refit(&skin);
        let thickness = Thickness::new(&skin, &tree);
        Self { skin, thickness }
    }
}

impl Thick<3> for Walls {
    fn place(&mut self, positions: &[Vector]) {
        self.skin.place(positions);
    }

    fn at(&self, node: u32) -> f64 {
        self.skin.nodes.binary_search(&node).map_or(f64::INFINITY, |vertex| self.thickness.sharing(&self.skin, &[vertex as u32]))
    }

    fn least(&self) -> f64 {
        self.thickness.least(&self.skin)
    }

    fn facets(&self, see: See<'_, 3>) {
        for facet in self.skin.facets.iter().filter(|facet| !facet.is_mirror) {
            let (thickness, node) = (self.thickness.of(&self.skin, facet.first), self.skin.nodes[facet.vertices[0] as usize]);
            facet.triangles().for_each(|triangle| see(&self.skin.corners(triangle), thickness, node));
        }
    }
}

/// What is opposite of the facet of a beam: around a joint others are within it, and the ray leaves all of
/// them where it has come out of as many as it was in.
fn opposite_of_beam(skin: &Skin, tree: &Tree, facet: &Facet) -> Opposite {
    let (from, normal) = middle(skin, facet.first);
    let inward = normal.map(|n| -n);
    let mut crossed: Vec<(f64, bool, u32)> = Vec::new();
    tree.along(skin, facet.body, from, inward, |triangle| {
        if let Some((away, _)) = crosses(from, inward, skin.corners(triangle))
            && !facet.triangles().contains(&triangle)
        {
            crossed.push((away, dot(skin.double(triangle), inward) > 0.0, triangle));
        }
    });
    crossed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    // Along an edge or through a corner the ray meets several triangles at once.
    crossed.dedup_by(|next, last| next.1 == last.1 && next.0 - last.0 <= BESIDE * next.0);
    let mut depth: i64 = crossed.iter().map(|&(_, comes_out, _)| if comes_out { 1 } else { -1 }).sum();
    for (_, comes_out, triangle) in crossed {
        depth -= if comes_out { 1 } else { -1 };
        if depth == 0 {
            let met = meets(from, inward, skin.corners(triangle));
            let (triangle, shares) = met.map_or((NONE, [0.0; 3]), |(_, shares)| (triangle, shares));
            return Opposite { triangle, shares, most: f64::INFINITY };
        }
    }
    Opposite { triangle: NONE, shares: [0.0; 3], most: f64::INFINITY }
}

/// Middle and unit normal of the facet of a first triangle.
fn middle(skin: &Skin, first: u32) -> (Vector, Vector) {
    let facet = &skin.facets[skin.facet_of[first as usize] as usize];
    let at = |k: usize| skin.x[facet.vertices[k] as usize];
    let double =
        if facet.count == 1 { cross(minus(at(1), at(0)), minus(at(2), at(0))) } else { cross(minus(at(2), at(0)), minus(at(3), at(1))) };
    (centre(skin, facet), unit(double))
}

/// Middle of a facet.
fn centre(skin: &Skin, facet: &Facet) -> Vector {
    let at = |k: usize| skin.x[facet.vertices[k] as usize];
    if facet.count == 1 {
        let [a, b, c] = [at(0), at(1), at(2)];
        return [0, 1, 2].map(|d| (a[d] + b[d] + c[d]) / 3.0);
    }
    at(4)
}

/// Where a ray meets a triangle that it comes to from behind: how far, m, and the shares of the corners
/// there.
fn meets(from: Vector, direction: Vector, [a, b, c]: [Vector; 3]) -> Option<(f64, [f64; 3])> {
    let double = cross(minus(b, a), minus(c, a));
    let is_opposite = dot(double, direction) > -OPPOSITE * length(double);
    if is_opposite { crosses(from, direction, [a, b, c]) } else { None }
}

/// The same of a triangle that it comes to from either side.
fn crosses(from: Vector, direction: Vector, [a, b, c]: [Vector; 3]) -> Option<(f64, [f64; 3])> {
    let double = cross(minus(b, a), minus(c, a));
    let (square, falls) = (dot(double, double), dot(double, direction));
    let away = dot(minus(a, from), double) / falls;
    let foot = [0, 1, 2].map(|d| from[d] + away * direction[d]);
    let second = dot(double, cross(minus(foot, a), minus(c, a))) / square;
    let third = dot(double, cross(minus(b, a), minus(foot, a))) / square;
    let shares = [1.0 - second - third, second, third];
    (away > 0.0 && shares.iter().all(|share| *share >= -BESIDE)).then_some((away, shares))
}
