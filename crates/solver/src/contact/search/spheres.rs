//! One sphere around each facet's sweep and one around each slave node's path, each compared with each.

use super::extent::{Extent, Margin};
use super::{Pair, Query, Search, SearchKind};

pub(super) fn kind<const D: usize>() -> SearchKind<D> {
    SearchKind {
        name: "spheres",
        doc: "per facet the sphere around its old and new nodes, compared with the sphere of every slave node's \
            path; slaves x facets comparisons",
        source: "Belytschko and Neal 1991, pinball method; spheres around facets in place of elements",
        make: || Box::new(Spheres { facets: Vec::new() }),
    }
}

/// Storage kept between calls.
struct Spheres<const D: usize> {
    facets: Vec<(Sphere<D>, u32)>,
}

/// A sphere that holds the whole of what it was made from.
#[derive(Clone, Copy)]
struct Sphere<const D: usize> {
    centre: [f64; D],
    radius: f64,
}

impl<const D: usize> Sphere<D> {
    /// Around the middle of a box: through its corner, or less where the farthest of `points` is nearer. A
    /// sphere around points holds their convex hull, so all of a facet at all times.
    fn around<'a>(extent: &Extent<D>, points: impl Iterator<Item = &'a [f64; D]>) -> Self {
        // Halved first: the sum of two large numbers may overflow.
        let centre = std::array::from_fn(|d| 0.5 * extent.low[d] + 0.5 * extent.high[d]);
        let radius = points.map(|p| distance(p, &centre)).fold(0.0, f64::max);
        Self { centre, radius }
    }

    /// Whether two spheres come nearer than a reach, with room for the rounding of centres, radii and their
    /// distance.
    fn meets(&self, other: &Self, margin: Margin) -> bool {
        let scale = self.centre.iter().chain(&other.centre).fold(self.radius + other.radius, |s, x| s + x.abs());
        let apart = distance(&self.centre, &other.centre);
        // A distance that overflows says nothing.
        apart <= (self.radius + other.radius) * (1.0 + 16.0 * f64::EPSILON) + margin.at(4.0 * scale) || apart.is_infinite()
    }
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).fold(0.0_f64, |h, d| h.hypot(a[d] - b[d]))
}

impl<const D: usize> Search<D> for Spheres<D> {
    fn pairs(&mut self, query: &Query<'_, D>, pairs: &mut Vec<Pair>) {
        pairs.clear();
        let ends = |node: u32| [&query.positions_old[node as usize], &query.positions_new[node as usize]];
        let margin = Margin::new(query.reach);
        self.facets.clear();
        self.facets.extend(query.facets.iter().zip(0..).filter_map(|(nodes, facet)| {
            let extent = Extent::of_facet(query, nodes, Margin::new(0.0))?;
            Some((Sphere::around(&extent, nodes.iter().flat_map(|&n| ends(n))), facet))
        }));
        for (&node, slave) in query.slaves.iter().zip(0..) {
            let Some(path) = Extent::of_path(query, node) else { continue };
            let path = Sphere::around(&path, ends(node).into_iter());
            let near =
                self.facets.iter().filter(|(sphere, facet)| sphere.meets(&path, margin) && !query.facets[*facet as usize].contains(&node));
            pairs.extend(near.map(|&(_, facet)| Pair { slave, facet }));
        }
    }
}
