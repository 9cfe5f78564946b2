//! Coarser forms of a large skin, for pictures that move: nodes in one box of a grid become one of them,
//! facets that lie within a box go.
//!
//! Facets come from `bodies`; a coarser facet uses nodes of the whole skin, so that frames serve all levels,
//! and shows the value of one of the facets that it stands for. Source: J. Rossignac, P. Borrel,
//! "Multi-resolution 3D approximations for rendering complex scenes", 1993 (vertex clustering).

/// Facets of the coarser level, about.
const FACETS: f64 = 12_000.0;
/// A skin with fewer facets has no coarser level.
pub(super) const LARGE: usize = 25_000;

/// Facets by nodes of the skin (a triangle repeats its last), and the facet of the whole skin whose value
/// each shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Level {
    pub(super) facets: Vec<[u32; 4]>,
    pub(super) sources: Vec<u32>,
}

/// The coarser level of facets between these places, m.
pub(super) fn coarser(facets: &[[u32; 4]], places: &[[f32; 3]]) -> Level {
    let boxes = boxes(places, width(facets, places));
    let mut level = Level::default();
    let mut keys: Vec<([u32; 4], u32)> = Vec::new();
    for (facet, corners) in (0..).zip(facets) {
        if let Some(merged) = merged(corners.map(|corner| boxes[corner as usize])) {
            let mut key = merged;
            key.sort_unstable();
            keys.push((key, facet));
        }
    }
    // Several facets may become the same one.
    keys.sort_unstable();
    keys.dedup_by_key(|(key, _)| *key);
    keys.sort_unstable_by_key(|(_, facet)| *facet);
    for (_, facet) in keys {
        level.facets.extend(merged(facets[facet as usize].map(|corner| boxes[corner as usize])));
        level.sources.push(facet);
    }
    level
}

/// Width of the boxes, m: so that a facet per box face makes the wanted number.
fn width(facets: &[[u32; 4]], places: &[[f32; 3]]) -> f32 {
    let area = |corners: &[u32; 4]| {
        let [a, b, c, d] = corners.map(|corner| places[corner as usize].map(f64::from));
        let side = |p: [f64; 3], q: [f64; 3]| [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
        let half = |u: [f64; 3], v: [f64; 3]| {
            let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            0.5 * cross.iter().map(|c| c * c).sum::<f64>().sqrt()
        };
        half(side(a, b), side(a, c)) + half(side(a, c), side(a, d))
    };
    let total: f64 = facets.iter().map(area).filter(|area| area.is_finite()).sum();
    (total / FACETS).sqrt() as f32
}

/// For each node the first node of its box.
fn boxes(places: &[[f32; 3]], width: f32) -> Vec<u32> {
    let key = |place: &[f32; 3]| place.map(|x| if width > 0.0 { (x / width).floor() as i64 } else { 0 });
    let mut nodes: Vec<([i64; 3], u32)> = (0..).zip(places).map(|(node, place)| (key(place), node)).collect();
    nodes.sort_unstable();
    let mut first = vec![0; places.len()];
    for same in nodes.chunk_by(|a, b| a.0 == b.0) {
        for (_, node) in same {
            first[*node as usize] = same[0].1;
        }
    }
    first
}

/// Corners without those that are the same: a quadrilateral, a triangle that repeats its last, or nothing.
fn merged(corners: [u32; 4]) -> Option<[u32; 4]> {
    let mut own: Vec<u32> = Vec::with_capacity(4);
    for corner in corners {
        if !own.contains(&corner) {
            own.push(corner);
        }
    }
    match own[..] {
        [a, b, c] => Some([a, b, c, c]),
        [a, b, c, d] => Some([a, b, c, d]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of so many facets on each side, one metre each.
    fn square(side: u32) -> (Vec<[u32; 4]>, Vec<[f32; 3]>) {
        let node = |i: u32, j: u32| i + (side + 1) * j;
        let facets =
            (0..side * side).map(|k| (k % side, k / side)).map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
        let places = (0..(side + 1) * (side + 1)).map(|k| [(k % (side + 1)) as f32, (k / (side + 1)) as f32, 0.0]);
        (facets.collect(), places.collect())
    }

    fn area(facets: &[[u32; 4]], places: &[[f32; 3]]) -> f64 {
        let cross = |a: [f32; 3], b: [f32; 3]| f64::from(a[0]) * f64::from(b[1]) - f64::from(a[1]) * f64::from(b[0]);
        let twice =
            |corners: &[u32; 4]| (0..4).map(|k| cross(places[corners[k] as usize], places[corners[(k + 1) % 4] as usize])).sum::<f64>();
        facets.iter().map(|corners| 0.5 * twice(corners)).sum()
    }

    #[test]
    fn a_coarser_square_has_fewer_facets_and_covers_almost_all() {
        let (facets, places) = square(700);
        let level = coarser(&facets, &places);
        assert!((6_000..18_000).contains(&level.facets.len()), "{}", level.facets.len());
        assert!(level.facets.len() == level.sources.len());
        assert!((0.95..=1.0).contains(&(area(&level.facets, &places) / 490_000.0)), "{}", area(&level.facets, &places));
    }

    #[test]
    fn every_facet_shows_the_value_of_one_that_it_touches() {
        let (facets, places) = square(500);
        let level = coarser(&facets, &places);
        let middle = |corners: &[u32; 4]| [0, 1].map(|k| corners.iter().map(|c| places[*c as usize][k]).sum::<f32>() / 4.0);
        for (coarse, source) in level.facets.iter().zip(&level.sources) {
            let (a, b) = (middle(coarse), middle(&facets[*source as usize]));
            assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 12.0, "{a:?} {b:?}");
        }
    }
}
