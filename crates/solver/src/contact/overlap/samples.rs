//! How deep the places of a region are: its vertices, and three places on each part of an edge that is
//! inside.
//!
//! Regions come from [`super::regions`], local thicknesses from [`super::thickness`]; what is deepest goes to
//! the findings.

use super::super::findings::{CAST, Overlap, PLACES};
use super::super::projection::node_facet::{Vector, corners_below, square_to_triangle, unit};
use super::OverlapCheck;
use super::regions::Region;
use super::skin::Edge;
use super::thickness::least_sharing;
use crate::mesh::surface::NONE;
use crate::tensor::dot;
use rayon::prelude::*;
use std::cell::Cell;

/// From this fraction on, depth is measured to the side of entry.
const SIDED: f64 = 0.15;
/// Nothing inside a body is farther from its surface than this fraction of the thickness there: half of it,
/// but for wedges.
const INSIDE: f64 = 1.0;
/// A place that is deeper than this fraction of the thickness is looked at once more, by its winding number.
const CERTAIN: f64 = CAST;
/// Of so many places, the deepest ones.
const SIDED_MOST: usize = 16;
/// Cosine of normals of the two sides of a crease.
const AGAINST: f64 = -0.5;
/// How well a facet of the side of entry looks against the area vector.
const FACES: f64 = 0.2;
/// Vertices or edges that one task looks at.
const CHUNK: usize = 256;

/// A place of a region.
pub(super) struct Sample {
    /// A triangle there, and whether it is of the second side.
    own: u32,
    is_second: bool,
    /// The triangle of the other side that is nearest.
    pub(super) foot: u32,
    /// The vertex that it is; [`NONE`]: none.
    pub(super) vertex: u32,
    pub(super) overlap: Overlap,
}

/// Where a sample is taken.
struct Site {
    /// A triangle there, and the vertex, if it is one.
    own: u32,
    vertex: u32,
    place: Vector,
    /// Thickness of its body there, m.
    behind: f64,
}

/// A region, and what its places are measured with.
struct Looking<'a> {
    check: &'a OverlapCheck,
    region: &'a Region,
    /// Thickness at each facet, m.
    walls: &'a [f64],
    /// The last foot of either side: neighbours along a contour are nearest to neighbours.
    last: [Cell<u32>; 2],
}

impl OverlapCheck {
    /// Vertices and three places on each part of an edge that is inside, where facets are as thick as `walls`
    /// say, m.
    pub(super) fn samples(&self, region: &Region, walls: &[f64]) -> Vec<Sample> {
        // Where the contour is open the flood can't be trusted.
        let inside = if region.is_open { &[] } else { &region.inside[..] };
        let looking = || Looking { check: self, region, walls, last: [const { Cell::new(NONE) }; 2] };
        let vertices = |part: &[u32]| {
            let (looking, mut found) = (looking(), Vec::with_capacity(part.len()));
            found.extend(part.iter().filter_map(|&vertex| looking.at_vertex(vertex)));
            found
        };
        let chords = |part: &[(u32, [Vector; 2])]| {
            let (looking, mut found) = (looking(), Vec::with_capacity(PLACES.len() * part.len()));
            found.extend(part.iter().flat_map(|chord| looking.on_chord(chord)).flatten());
            found
        };
        if rayon::current_thread_index().is_some() && inside.len() + region.chords.len() > CHUNK {
            let parts = inside.par_chunks(CHUNK).map(vertices).chain(region.chords.par_chunks(CHUNK).map(chords));
            return parts.collect::<Vec<_>>().into_iter().flatten().collect();
        }
        let mut found = vertices(inside);
        found.extend(chords(&region.chords));
        found
    }

    /// The place of a region that is deepest against its thickness.
    pub(super) fn deepest(&self, number: usize, found: &[Sample]) -> Overlap {
        let (region, known) = (&self.regions[number], &self.known[number]);
        let ratios = || (0u32..).zip(found).map(|(at, sample)| (sample.overlap.ratio(), at));
        let Some((_, first)) = ratios().reduce(|a, b| if b.0.total_cmp(&a.0).is_gt() { b } else { a }) else { return Overlap::default() };
        let most = found[first as usize].overlap;
        // In itself a body has no side of entry: its parts turn with each other.
        let is_sided = known.began != [0.0; 3] && !region.is_open && !region.is_own();
        if !is_sided || most.ratio().max(known.ratio) <= SIDED {
            return most;
        }
        let mut order: Vec<(f64, u32)> = ratios().collect();
        let deeper_first = |a: &(f64, u32), b: &(f64, u32)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
        if order.len() > SIDED_MOST {
            order.select_nth_unstable_by(SIDED_MOST, deeper_first);
            order.truncate(SIDED_MOST);
        }
        order.sort_unstable_by(deeper_first);
        // The first side comes along its area vector, and the second's side of entry looks against it.
        let direction = unit(known.began);
        order.iter().map(|&(_, at)| &found[at as usize]).fold(most, |most, sample| {
            let sided = self.sided(region, sample, direction);
            sided.filter(|sided| sided.ratio() > most.ratio()).unwrap_or(most)
        })
    }

    /// How deep a place is below the side of entry, which looks against a direction; nothing where it is
    /// nearest to that, or to a flank.
    fn sided(
        &self,
        region: &Region,
        &Sample { own, is_second, foot, overlap: unsided, .. }: &Sample,
        direction: Vector,
    ) -> Option<Overlap> {
        // Positive where a triangle is of the side of entry, negative of the side opposite.
        let faces = |triangle: u32| {
            let along = dot(unit(self.skin.double(triangle)), direction);
            if is_second { along } else { -along }
        };
        let (below, count) = self.below(unsided.place, foot);
        if self.skin.sharing(&below[..count]).any(|triangle| faces(triangle) >= -FACES) {
            return None;
        }
        let farthest = 2.0 * unsided.thickness;
        let most_away = (farthest * farthest, NONE);
        let found = self.depth(region, (own, is_second), unsided.place, most_away, |triangle| faces(triangle) > FACES);
        found.map(|(depth, _)| Overlap { depth, ..unsided })
    }

    /// Vertices of what of a triangle is nearest to a place, of itself, an edge or a corner, and how many:
    /// facets that share these are as near.
    fn below(&self, x: Vector, triangle: u32) -> ([u32; 3], usize) {
        let (mut found, mut count) = ([NONE; 3], 0);
        let vertices = self.skin.triangles[triangle as usize].into_iter().zip(corners_below(x, self.skin.corners(triangle)));
        for (vertex, _) in vertices.filter(|(_, is_there)| *is_there) {
            found[count] = vertex;
            count += 1;
        }
        (found, count)
    }

    /// Depth of a place of a triangle's side (whether it is the second) of a region, by those triangles of
    /// the other side that count, and the nearest one; nothing where all are farther than the root of
    /// `square`, m². The guess is as in [`super::tree::Tree::nearest`].
    fn depth(
        &self,
        region: &Region,
        (own, is_second): (u32, bool),
        x: Vector,
        (square, guess): (f64, u32),
        counts: impl Fn(u32) -> bool,
    ) -> Option<(f64, u32)> {
        let may_be = |triangle: u32| !self.skin.is_mirror(triangle) && counts(triangle);
        let nearest = |others: &mut dyn Iterator<Item = u32>| {
            let away = others.map(|triangle| (square_to_triangle(x, self.skin.corners(triangle)), triangle));
            let nearest = away.reduce(|a, b| if b.0 < a.0 { b } else { a });
            nearest.filter(|nearest| nearest.0 < square).map(|(square, foot)| (square.sqrt(), foot))
        };
        if region.is_torn() {
            // Where its contour is not closed, of what is pierced what does not touch it, and of what touches
            // it what looks against it: the other side of a crease.
            let corners = &self.skin.triangles[own as usize];
            let touches = |triangle: u32| self.skin.triangles[triangle as usize].iter().any(|at| corners.contains(at));
            let pierced = region.pierced.iter().copied().filter(|&triangle| may_be(triangle) && !touches(triangle));
            let normal = unit(self.skin.double(own));
            let is_against = |triangle: u32| may_be(triangle) && dot(unit(self.skin.double(triangle)), normal) < AGAINST;
            return nearest(&mut pierced.chain(self.skin.at_any(corners).filter(|&triangle| is_against(triangle))));
        }
        if region.is_own() {
            // Of its own body the other side of the region alone.
            let others = region.triangles.iter().filter(|&&(triangle, side)| side != is_second && may_be(triangle));
            return nearest(&mut others.map(|&(triangle, _)| triangle));
        }
        let other = region.bodies[usize::from(self.skin.body(own) == region.bodies[0])];
        let (square, foot) = self.tree.nearest(&self.skin, other, x, (square, guess), may_be)?;
        Some((square.sqrt(), foot))
    }

    /// Whether a place may lie in another body, as far as that is closed.
    pub(super) fn may_be_in(&self, body: u32, place: Vector) -> bool {
        !self.is_closed[body as usize] || self.tree.may_be_in(&self.skin, body, place)
    }

    /// A node of a triangle.
    fn node_of(&self, triangle: u32) -> u32 {
        let (carriers, _) = self.skin.shares(self.skin.triangles[triangle as usize][0]);
        self.skin.nodes[carriers[0] as usize]
    }
}

impl Looking<'_> {
    fn at_vertex(&self, vertex: u32) -> Option<Sample> {
        let skin = &self.check.skin;
        let own = *skin.at_vertex.of(vertex as usize).first()?;
        self.look(&Site { own, vertex, place: skin.x[vertex as usize], behind: self.thickness(&[vertex]) })
    }

    fn on_chord(&self, &(edge, [from, to]): &(u32, [Vector; 2])) -> [Option<Sample>; 3] {
        let Edge { ends, triangles: [own, _] } = self.check.skin.edges[edge as usize];
        let behind = self.thickness(&ends);
        let at = |share: f64| [0, 1, 2].map(|d| (1.0 - share) * from[d] + share * to[d]);
        PLACES.map(|share| self.look(&Site { own, vertex: NONE, place: at(share), behind }))
    }

    /// The least thickness of the facets that share vertices, m.
    fn thickness(&self, vertices: &[u32]) -> f64 {
        let skin = &self.check.skin;
        least_sharing(skin, vertices, |triangle| self.walls[skin.facet_of[triangle as usize] as usize])
    }

    fn look(&self, &Site { own, vertex, place, behind }: &Site) -> Option<Sample> {
        let Self { check, region, .. } = *self;
        let is_own = region.is_own();
        let is_second = if is_own && !region.is_open { region.side(own)? } else { check.skin.body(own) == region.bodies[1] };
        let other = region.bodies[usize::from(!is_second)];
        let farthest = INSIDE * check.thickest[other as usize];
        // Where a vertex was nearest in the last look it is still nearly so.
        let before = check.feet.get(vertex as usize).copied().filter(|&foot| foot != NONE && check.skin.body(foot) == other);
        let last = &self.last[usize::from(is_second)];
        let guess = before.unwrap_or(last.get());
        let (depth, foot) = check.depth(region, (own, is_second), place, (farthest * farthest, guess), |_| true)?;
        last.set(foot);
        let (below, count) = check.below(place, foot);
        let there = self.thickness(&below[..count]);
        let thickness = behind.min(there);
        // Farther than that it is not inside: an element of the other body is inverted, and the flood went
        // astray.
        if depth > INSIDE * if is_own { thickness } else { there } {
            return None;
        }
        // The flood may go astray where the contour does not close, and where surfaces are flush.
        let is_in = || if is_own { check.tree.is_in_itself(&check.skin, own, place) } else { check.may_be_in(other, place) };
        if !(depth < CERTAIN * thickness) && !is_in() {
            return None;
        }
        let nodes = [own, foot].map(|triangle| check.node_of(triangle));
        Some(Sample { own, is_second, foot, vertex, overlap: Overlap { place, depth, thickness, nodes, time: 0.0 } })
    }
}
