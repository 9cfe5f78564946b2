//! A polygon, perhaps with holes, of triangles.

use super::numbers::{cross, distance, minus};
use super::{Body, BuiltIn, Count, ShapeCheck, Values, Wrong, shape_key};
use crate::mesh::cell::CellKind;
use crate::quantity::Dimension;
use crate::quantity::Range::{NotNegative, Positive};
use crate::vocabulary::Kind::{Outlines, Points, Quantities, Quantity};
use crate::vocabulary::Need::{Default as Written, Optional, Required};
use crate::vocabulary::{Key, Rule, Section, key};
use embate_lanes::math::ln;
use embate_remesh::mesher::delaunay::{is_inside, triangles};

/// A polygon with straight edges and perhaps holes, of Delaunay triangles. Sides: `outer`, its edges `edge1`,
/// `edge2`, ... from the first point on, and the holes `hole1`, `hole2`, ...
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Corners, m, in either direction.
    pub outline: Vec<[f64; 2]>,
    /// Corners of each hole, m.
    pub holes: Vec<Vec<[f64; 2]>>,
    /// Length of the elements' edges, m.
    pub size: f64,
    /// Points around which elements are smaller, m.
    pub near: Vec<[f64; 2]>,
    /// Length of the elements' edges at each of them, m.
    pub sizes: Vec<f64>,
    /// Growth of that length by distance from them.
    pub growth: f64,
}

impl Default for Polygon {
    fn default() -> Self {
        Self { outline: Vec::new(), holes: Vec::new(), size: 1.0, near: Vec::new(), sizes: Vec::new(), growth: 0.3 }
    }
}

pub(super) const KEY: Key = shape_key("polygon", &SECTION, "A polygon, with or without holes, of triangles.");

static SECTION: Section = Section {
    name: "polygon",
    doc: "A polygon with straight edges, with or without holes, of triangles (`element_triangles`). Its sides are `outer`, the edges of the outline \
          `edge1` (from the first point to the second), `edge2`, ..., and the holes `hole1`, `hole2`, ...",
    keys: &[
        key("outline", Points(3), Required, "Corners, in either direction; the last is joined to the first."),
        key("size", Quantity(Dimension::LENGTH, Positive), Required, "Length of the elements' edges."),
        key("holes", Outlines(3), Optional("none"), "Corners of each hole."),
        key("near", Points(1), Optional("none"), "Points around which elements are smaller."),
        key(
            "sizes",
            Quantities(Dimension::LENGTH, Positive, 1),
            Optional("`size`"),
            "Length of the elements' edges at each of these points.",
        ),
        key("growth", Quantity(Dimension::NONE, NotNegative), Written("0.3"), "Growth of that length by distance from them, up to `size`."),
    ],
    rules: &[Rule::Needs("near", "sizes"), Rule::Needs("sizes", "near")],
    ..Section::EMPTY
};

/// Area of an equilateral triangle by the square of its edge.
const EQUILATERAL: f64 = 0.433_012_701_892_219_3;

impl Polygon {
    fn outlines(&self) -> impl Iterator<Item = &Vec<[f64; 2]>> {
        std::iter::once(&self.outline).chain(&self.holes)
    }

    /// Wanted length of edges at a point, m.
    fn size_at(&self, x: [f64; 2]) -> f64 {
        let at = |(near, size): (&[f64; 2], &f64)| size + self.growth * distance(*near, x);
        self.near.iter().zip(&self.sizes).map(at).fold(self.size, f64::min)
    }

    fn area(&self) -> f64 {
        area(&self.outline).abs() - self.holes.iter().map(|hole| area(hole).abs()).sum::<f64>()
    }

    /// Number of triangles that the sizes ask for: ∫ dA / (area of one), around a point ∫ 2πr dr / (s + g
    /// r)².
    fn elements_about(&self) -> f64 {
        let around = |&size: &f64| {
            let (s, g) = (size, self.growth);
            if s >= self.size {
                0.0
            } else if g > 1e-6 {
                let q = self.size / s;
                std::f64::consts::TAU / (g * g) * (ln(q) + 1.0 / q - 1.0)
            } else {
                self.area() / (s * s)
            }
        };
        let most = self.area() / self.sizes.iter().fold(self.size, |a, &b| a.min(b)).powi(2);
        let wanted = self.area() / (self.size * self.size) + self.sizes.iter().map(around).sum::<f64>();
        wanted.min(most) / EQUILATERAL
    }
}

impl BuiltIn<2> for Polygon {
    fn read(values: &dyn Values) -> Self {
        Self {
            outline: values.get("outline"),
            holes: values.get("holes"),
            size: values.get("size"),
            near: values.get("near"),
            sizes: values.get("sizes"),
            growth: values.get("growth"),
        }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        let mut sound = check.points("outline", &self.outline);
        for (k, hole) in self.holes.iter().enumerate() {
            sound &= check.points(&format!("holes[{k}]"), hole);
        }
        sound &= check.points("near", &self.near);
        check.number("size", self.size);
        check.number("growth", self.growth);
        check.numbers("sizes", &self.sizes);
        if self.near.len() != self.sizes.len() {
            let message = format!("there are {} points in `near`, but {} `sizes`", self.near.len(), self.sizes.len());
            check.fault("sizes", message, "give one for each point");
        }
        if sound {
            self.check_form(check);
        }
    }

    fn sides(&self) -> Vec<String> {
        let edges = (1..=self.outline.len()).map(|k| format!("edge{k}"));
        let holes = (1..=self.holes.len()).map(|k| format!("hole{k}"));
        std::iter::once("outer".to_string()).chain(edges).chain(holes).collect()
    }

    fn count(&self) -> Count {
        let corners: usize = self.outlines().map(Vec::len).sum();
        let elements = (1.3 * self.elements_about()) as usize;
        Count { nodes: (elements / 2).saturating_add(corners), elements: elements.saturating_add(corners), exact: false }
    }

    fn size_key(&self) -> &'static str {
        "size"
    }

    fn cell_kind(&self) -> CellKind {
        CellKind::Triangle
    }

    fn body(&self) -> Result<Body<2>, Wrong> {
        // Counter-clockwise, holes clockwise: the body on the left.
        let is_turned = |(k, outline): (usize, &Vec<[f64; 2]>)| (area(outline) < 0.0) == (k == 0);
        let turned: Vec<bool> = self.outlines().enumerate().map(is_turned).collect();
        let directed = |(outline, &turned): (&Vec<[f64; 2]>, &bool)| {
            let mut outline = outline.clone();
            if turned {
                outline.reverse();
            }
            outline
        };
        let outlines: Vec<Vec<[f64; 2]>> = self.outlines().zip(&turned).map(directed).collect();
        let limit = self.count().nodes.saturating_mul(20).saturating_add(10_000);
        let Some(made) = triangles(&outlines, &|x| self.size_at(x), limit) else {
            let message = format!("no good triangles were found with {limit} nodes");
            return Err(Wrong::new("size", message, "look for corners or gaps much smaller than `size`, or take a smaller `size`"));
        };
        // Sides have the body on their right: backwards.
        let backwards = |nodes: &[u32]| nodes.windows(2).rev().map(|pair| [pair[1], pair[0]]).collect::<Vec<[u32; 2]>>();
        let mut sides = Vec::new();
        let mut first = 0;
        for ((k, outline), turned) in outlines.iter().enumerate().zip(&turned) {
            let n = outline.len();
            let edges = &made.edges[first..first + n];
            let whole: Vec<[u32; 2]> = edges.iter().rev().flat_map(|edge| backwards(edge)).collect();
            if k == 0 {
                sides.push(("outer".to_string(), whole));
                // Edge e runs from corner e to e + 1 of the outline as given; backwards that is corner n − 1
                // − e and the one before.
                let given = |e: usize| if *turned { (2 * n - 2 - e) % n } else { e };
                sides.extend((0..n).map(|e| (format!("edge{}", e + 1), backwards(&edges[given(e)]))));
            } else {
                sides.push((format!("hole{k}"), whole));
            }
            first += n;
        }
        let mut body = Body { positions: made.positions, sides, ..Body::default() };
        body.extend(CellKind::Triangle, made.triangles);
        Ok(body)
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let size = 1.0 / n as f64;
        let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let hole = vec![[0.3, 0.3], [0.7, 0.4], [0.5, 0.7]];
        let bracket = vec![[0.0, 0.0], [0.0, 2.0], [0.4, 2.0], [0.4, 0.4], [1.5, 0.1], [1.5, 0.0]];
        let sharp = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 0.7]];
        let of = |outline: &[[f64; 2]], holes: &[Vec<[f64; 2]>]| {
            let polygon = Self { outline: outline.to_vec(), holes: holes.to_vec(), size, ..Self::default() };
            let area = polygon.area();
            (polygon, area)
        };
        let (fine, area) = of(&square, &[]);
        let fine = Self { near: vec![[0.0, 0.0], [1.0, 0.5]], sizes: vec![0.2 * size, 0.4 * size], ..fine };
        vec![of(&square, &[]), of(&square, &[hole]), of(&bracket, &[]), of(&sharp, &[]), (fine, area)]
    }
}

impl Polygon {
    fn check_form(&self, check: &mut dyn ShapeCheck) {
        let name = |k: usize| if k == 0 { "outline".to_string() } else { format!("holes[{}]", k - 1) };
        let outlines: Vec<&Vec<[f64; 2]>> = self.outlines().collect();
        // Edges: outline, place in it, ends.
        let mut edges = Vec::new();
        for (k, outline) in outlines.iter().enumerate() {
            if outline.len() < 3 {
                return check.fault(&name(k), format!("it has {} points, and a polygon has 3 at least", outline.len()), "give more points");
            }
            edges.extend((0..outline.len()).map(|e| (k, e, [outline[e], outline[(e + 1) % outline.len()]])));
        }
        if let Some(&(k, e, _)) = edges.iter().find(|(_, _, [a, b])| a == b) {
            let message = format!("points {e} and {} are the same", (e + 1) % outlines[k].len());
            return check.fault(&name(k), message, "leave one of them out");
        }
        // By x, so that only edges that overlap there are compared.
        edges.sort_by(|one, other| low(&one.2).total_cmp(&low(&other.2)).then((one.0, one.1).cmp(&(other.0, other.1))));
        for (i, one) in edges.iter().enumerate() {
            for other in edges[i + 1..].iter().take_while(|other| low(&other.2) <= high(&one.2)) {
                let n = outlines[one.0].len();
                let follow = one.0 == other.0 && ((one.1 + 1) % n == other.1 || (other.1 + 1) % n == one.1);
                let meet = if follow { folded(&one.2, &other.2) } else { crossing(&one.2, &other.2) };
                if let Some([x, y]) = meet {
                    let which = |&(k, e, _): &(usize, usize, [[f64; 2]; 2])| format!("edge {} of `{}`", e + 1, name(k));
                    let mut both = [(one.0, one.1), (other.0, other.1)].map(|(k, e)| which(&(k, e, one.2)));
                    both.sort();
                    let message = format!("{} and {} meet at ({x:.6e}, {y:.6e}) m", both[0], both[1]);
                    return check.fault(&name(one.0.max(other.0)), message, "an outline must not cross or touch itself or another one");
                }
            }
        }
        for (k, hole) in self.holes.iter().enumerate() {
            let [x, y] = hole[0];
            if !is_inside(std::slice::from_ref(&self.outline), [x, y]) {
                let message = format!("the hole's corner at ({x:.6e}, {y:.6e}) m is not inside the outline");
                return check.fault(&name(k + 1), message, "move the hole into the polygon");
            }
            if let Some(other) = (0..self.holes.len()).find(|&other| other != k && is_inside(&self.holes[other..=other], [x, y])) {
                return check.fault(&name(k + 1), format!("the hole lies in hole {}", other + 1), "leave the inner one out");
            }
        }
    }
}

fn low([a, b]: &[[f64; 2]; 2]) -> f64 {
    a[0].min(b[0])
}

fn high([a, b]: &[[f64; 2]; 2]) -> f64 {
    a[0].max(b[0])
}

/// Signed area of a closed line, positive counter-clockwise, m².
fn area(outline: &[[f64; 2]]) -> f64 {
    let Some(&first) = outline.first() else { return 0.0 };
    outline.windows(2).map(|pair| 0.5 * cross(minus(pair[0], first), minus(pair[1], first))).sum()
}

/// Where two lines cross or touch.
fn crossing([a, b]: &[[f64; 2]; 2], [c, d]: &[[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (ab, cd, ac) = (minus(*b, *a), minus(*d, *c), minus(*c, *a));
    let turn = cross(ab, cd);
    if turn == 0.0 {
        // Parallel: they touch where an end of one is on the other.
        let on = |x: &[f64; 2], [a, b]: [&[f64; 2]; 2]| {
            let (ab, ax) = (minus(*b, *a), minus(*x, *a));
            let along = ab[0] * ax[0] + ab[1] * ax[1];
            cross(ab, ax) == 0.0 && (0.0..=ab[0] * ab[0] + ab[1] * ab[1]).contains(&along)
        };
        return [(c, [a, b]), (d, [a, b]), (a, [c, d])].into_iter().find(|(x, line)| on(x, *line)).map(|(x, _)| *x);
    }
    let (s, t) = (cross(ac, cd) / turn, cross(ac, ab) / turn);
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)).then(|| [a[0] + s * ab[0], a[1] + s * ab[1]])
}

/// Where an edge runs back over the one that it follows.
fn folded([a, b]: &[[f64; 2]; 2], [c, d]: &[[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (ab, cd) = (minus(*b, *a), minus(*d, *c));
    (cross(ab, cd) == 0.0 && ab[0] * cd[0] + ab[1] * cd[1] < 0.0).then(|| if b == c || b == d { *b } else { *a })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smallest angle of each triangle, degrees, with its place.
    fn angles(body: &Body<2>) -> Vec<(f64, [f64; 2])> {
        let of = |triangle: &[u32; 3]| {
            let x = triangle.map(|node| body.positions[node as usize]);
            let angle = |k: usize| {
                let (a, b) = (minus(x[(k + 1) % 3], x[k]), minus(x[(k + 2) % 3], x[k]));
                cross(a, b).atan2(a[0] * b[0] + a[1] * b[1]).to_degrees()
            };
            ((0..3).map(angle).fold(180.0, f64::min), x[0])
        };
        body.all::<3>(CellKind::Triangle).iter().map(of).collect()
    }

    #[test]
    fn no_triangle_is_a_needle() {
        for n in [2, 5, 10, 20, 40] {
            for (polygon, _) in Polygon::examples(n) {
                let body = polygon.body().unwrap();
                let is_sharp = polygon.outline.len() == 3;
                let worst = angles(&body).into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a }).unwrap();
                let least = if is_sharp { 17.0 } else { 25.0 };
                assert!(worst.0 > least, "{n}: {worst:?} of {} triangles of {polygon:?}", body.cells().count());
            }
        }
    }

    #[test]
    fn edges_are_about_as_long_as_asked_for() {
        for (polygon, area) in Polygon::examples(20).into_iter().take(3) {
            let mean = (area / polygon.body().unwrap().cells().count() as f64 / EQUILATERAL).sqrt();
            assert!((0.7..1.1).contains(&(mean / polygon.size)), "{}", mean / polygon.size);
        }
    }

    #[test]
    fn the_direction_of_an_outline_changes_no_side() {
        let (polygon, _) = Polygon::examples(6).remove(2);
        let mut turned = polygon.clone();
        turned.outline.reverse();
        let n = turned.outline.len();
        let places = |body: &Body<2>, name: &str| {
            let segments = &body.sides.iter().find(|side| side.0 == name).unwrap().1;
            let mut places: Vec<[f64; 2]> = segments.iter().flatten().map(|&node| body.positions[node as usize]).collect();
            places.sort_by(|a, b| a.partial_cmp(b).unwrap());
            places
        };
        let (one, other) = (polygon.body().unwrap(), turned.body().unwrap());
        for e in 0..n {
            // Corner k has become corner n − 1 − k, so edge e from e to e + 1 is now edge n − 2 − e.
            let (a, b) = (places(&one, &format!("edge{}", e + 1)), places(&other, &format!("edge{}", (2 * n - 2 - e) % n + 1)));
            let ends = |places: &[[f64; 2]]| (places[0], places[places.len() - 1]);
            assert_eq!(ends(&a), ends(&b), "edge {e}");
        }
    }
}
