//! A full sphere, or a part of one, without degenerate elements.

use super::numbers::{between, cos_sin};
use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Skin, Values, Wrong, cut, node, shape_key};
use crate::mesh::cell::CellKind;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Choice, Integer, Quantity, Spatial};
use crate::vocabulary::Need::{Default as Written, Required};
use crate::vocabulary::{Choices, Key, Section, key};

/// A sphere of hexahedra, or the half, quarter or eighth of one where x, y and z are above those of its
/// centre: a core of `elements`³ with bulged sides, and layers from each of its six sides to the surface.
/// Sides `outer`, and `left` (x), `bottom` (y), `back` (z) where it is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, m.
    pub centre: [f64; 3],
    /// Radius, m.
    pub radius: f64,
    /// Elements around a quarter of a great circle; even for a part of a sphere.
    pub elements: usize,
    /// How much of it there is: `whole`, `half`, `quarter` or `eighth`.
    pub portion: String,
}

impl Default for Sphere {
    fn default() -> Self {
        Self { centre: [0.0; 3], radius: 1.0, elements: 2, portion: PORTIONS[0].into() }
    }
}

const PORTIONS: [&str; 4] = ["whole", "half", "quarter", "eighth"];

fn portions() -> Vec<&'static str> {
    PORTIONS.into()
}

/// Sides of the cuts, across x, y and z.
const CUTS: [&str; 3] = ["left", "bottom", "back"];

pub(super) const KEY: Key = shape_key("sphere", &SECTION, "A full sphere, or a half, quarter or eighth of one: a solid.");

static SECTION: Section = Section {
    name: "sphere",
    doc: "A full sphere of hexahedra, or a part of one; its side is `outer`, where it is cut also `left` (across x), \
        `bottom` (across y) and `back` (across z). With `shell4` the shell of its surface.",
    keys: &[
        key("centre", Spatial(Dimension::LENGTH, Finite), Required, "Centre."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key(ELEMENTS, Integer(1), Required, "Elements around a quarter of a great circle; an even number for a part of a sphere."),
        key(
            "portion",
            Choice(Choices::Listed(portions)),
            Written("\"whole\""),
            "How much of it: the half above the centre's x, the quarter above its x and y, the eighth above its x, y and z.",
        ),
    ],
    ..Section::EMPTY
};

impl BuiltIn<3> for Sphere {
    fn read(values: &dyn Values) -> Self {
        let (centre, radius) = (values.get("centre"), values.get("radius"));
        Self { centre, radius, elements: values.get(ELEMENTS), portion: values.get("portion") }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("centre", self.centre);
        check.number("radius", self.radius);
        check.counts(ELEMENTS, &[self.elements]);
        match self.cuts() {
            None => check.known("portion", "portion", &self.portion, &PORTIONS),
            Some(1..) if self.elements % 2 == 1 => {
                let message = format!("a part of a sphere can't have {} elements around a quarter", self.elements);
                check.fault(ELEMENTS, message, "give an even number: the cut goes through the middle of the core");
            }
            Some(_) => {}
        }
    }

    fn sides(&self) -> Vec<String> {
        std::iter::once("outer").chain(CUTS).take(1 + self.cuts().unwrap_or(0)).map(String::from).collect()
    }

    fn count(&self) -> Count {
        let (n, cuts) = (self.elements, self.cuts().unwrap_or(0));
        let layers = layers_of(n);
        let [lattice, inside] = self.lattice();
        let shell = lattice.saturating_sub(inside).saturating_mul(layers);
        let elements = n.saturating_mul(n).saturating_mul(n.saturating_add(layers.saturating_mul(6)));
        Count { nodes: lattice.saturating_add(shell), elements: elements >> cuts, exact: true }
    }

    fn skin(&self) -> Option<Skin> {
        let [lattice, inside] = self.lattice();
        let elements = self.elements.saturating_mul(self.elements).saturating_mul(6) >> self.cuts().unwrap_or(0);
        Some(Skin { sides: &["outer"], count: Count { nodes: lattice.saturating_sub(inside), elements, exact: true } })
    }

    /// Nodes: the core's lattice, along x first, then the layers outwards, each in the order of the lattice.
    fn body(&self) -> Result<Body<3>, Wrong> {
        let mut body = whole(self.radius, self.elements);
        let cuts = self.cuts().unwrap_or(0);
        if cuts > 0 {
            let is_kept = |x: [f64; 3]| x[..cuts].iter().all(|&x| x > 0.0);
            body = cut(&body, is_kept, |x| (0..cuts).find(|&d| x[d] == 0.0).map_or("outer", |d| CUTS[d]));
            // In the order of the announcement.
            body.sides.sort_by_key(|(name, _)| CUTS.iter().position(|cut| cut == name).map_or(0, |at| at + 1));
        }
        for x in &mut body.positions {
            *x = std::array::from_fn(|d| self.centre[d] + x[d]);
        }
        Ok(body)
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        let whole = Self { centre: [0.5, -0.25, 1.0], radius: 2.0, elements: n, ..Self::default() };
        let volume = |share: f64| 32.0 / 3.0 * std::f64::consts::PI / share;
        let part = |cuts: usize| {
            let part = Self { elements: n + n % 2, portion: PORTIONS[cuts].into(), ..whole.clone() };
            (part, volume(f64::from(1 << cuts)))
        };
        vec![(whole.clone(), volume(1.0)), part(1), part(2), part(3)]
    }
}

impl Sphere {
    /// Across how many of x, y and z it is cut; `None` for another portion than there are.
    fn cuts(&self) -> Option<usize> {
        PORTIONS.iter().position(|portion| *portion == self.portion)
    }

    /// Nodes of the core, and how many of them are not on its outside.
    fn lattice(&self) -> [usize; 2] {
        let (n, cuts) = (self.elements, self.cuts().unwrap_or(0));
        let product = |of: &dyn Fn(bool) -> usize| (0..3).map(|d| of(d < cuts)).fold(1, usize::saturating_mul);
        let lattice = product(&|cut| if cut { n / 2 } else { n }.saturating_add(1));
        [lattice, product(&|cut| if cut { n / 2 } else { n.saturating_sub(1) })]
    }
}

/// How round the sides of the core are: 0 flat, 1 spheres around the centre. This and [`core_fraction`] and
/// [`layers_of`] were chosen from a scan for large Jacobians at corners and sides of equal length.
const ROUND: f64 = 0.5;

/// Distance of the core's corners from the centre, as a fraction of the radius: smaller in coarse spheres,
/// whose facets cut the surface.
fn core_fraction(elements: usize) -> f64 {
    match elements {
        1 => 0.45,
        2 => 0.55,
        _ => 0.65,
    }
}

/// Layers of hexahedra between the core and the surface: about as thick as they are wide.
fn layers_of(elements: usize) -> usize {
    (elements.saturating_mul(3).saturating_add(5) / 10).max(1)
}

/// Lattice point of 0..=n in the cube [−1, 1]³.
fn lattice_point(at: [usize; 3], n: usize) -> [f64; 3] {
    at.map(|i| between(-1.0, 1.0, i, n))
}

/// The unit vector that belongs to a lattice point: equal angles for equal steps along a side of the cube it
/// lies on. Worked out without signs and in one order, so that mirror images agree to the last bit. Zero at
/// the centre.
fn direction(at: [usize; 3], n: usize) -> [f64; 3] {
    let point = lattice_point(at, n);
    let largest = point.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if largest == 0.0 {
        return [0.0; 3];
    }
    let tangents = point.map(|x| {
        let [c, s] = cos_sin(0.5 * (x.abs() / largest));
        if x.abs() == largest { 1.0 } else { s / c }
    });
    let mut squares = tangents.map(|t| t * t);
    squares.sort_by(f64::total_cmp);
    let length = (squares[0] + squares[1] + squares[2]).sqrt();
    std::array::from_fn(|d| (tangents[d] / length).copysign(point[d]))
}

/// A point of a unit sphere's core: a cubic lattice at the centre that becomes rounder outwards.
fn core_point(at: [usize; 3], n: usize) -> [f64; 3] {
    let corner = core_fraction(n);
    let half = corner * (1.0_f64 / 3.0).sqrt();
    let point = lattice_point(at, n);
    let ring = point.iter().fold(0.0_f64, |ring, x| ring.max(x.abs()));
    let (round, outwards) = (ROUND * ring, direction(at, n));
    std::array::from_fn(|d| (1.0 - round) * half * point[d] + round * corner * ring * outwards[d])
}

/// A whole sphere around the origin.
fn whole(radius: f64, n: usize) -> Body<3> {
    let layers = layers_of(n);
    let mut body = Body::default();
    let row = n + 1;
    let places = (0..row * row * row).map(|i| [i % row, i / row % row, i / row / row]);
    body.positions.extend(places.clone().map(|at| core_point(at, n).map(|x| radius * x)));
    // The lattice's outside, which is layer 0; its rank is the number in further layers.
    let is_outside = |at: &[usize; 3]| at.iter().any(|&i| i == 0 || i == n);
    let mut rank = vec![usize::MAX; body.positions.len()];
    let outside: Vec<[usize; 3]> = places.clone().filter(is_outside).collect();
    let core = |[i, j, k]: [usize; 3]| (k * row + j) * row + i;
    outside.iter().enumerate().for_each(|(number, &at)| rank[core(at)] = number);
    for layer in 1..=layers {
        for &at in &outside {
            let (inside, surface) = (core_point(at, n), direction(at, n));
            body.positions.push(std::array::from_fn(|d| radius * between(inside[d], surface[d], layer, layers)));
        }
    }
    let at_layer = |layer: usize, at: [usize; 3]| {
        let first = row * row * row;
        node(if layer == 0 { core(at) } else { first + (layer - 1) * outside.len() + rank[core(at)] })
    };
    let square = |[i, j]: [usize; 2]| [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
    for at in places.filter(|at| at.iter().all(|&i| i < n)) {
        let corners = square([at[0], at[1]]);
        let hexahedron = std::array::from_fn::<_, 8, _>(|c| node(core([corners[c % 4][0], corners[c % 4][1], at[2] + c / 4])));
        body.extend(CellKind::Hexahedron, [hexahedron]);
    }
    let mut outer = Vec::new();
    for (axis, end) in (0..3).flat_map(|axis| [(axis, 0), (axis, n)]) {
        for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
            // Counter-clockwise seen from outside.
            let corners = square([i, j]).map(|[i, j]| {
                let mut at = [end; 3];
                (at[(axis + 1) % 3], at[(axis + 2) % 3]) = (i, j);
                at
            });
            let corners = if end == 0 { [corners[0], corners[3], corners[2], corners[1]] } else { corners };
            for layer in 0..layers {
                let hexahedron = std::array::from_fn::<_, 8, _>(|c| at_layer(layer + c / 4, corners[c % 4]));
                body.extend(CellKind::Hexahedron, [hexahedron]);
            }
            outer.push(corners.map(|at| at_layer(layers, at)));
        }
    }
    body.sides.push(("outer".into(), outer));
    body
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirror_images_of_a_sphere_agree_to_the_last_bit() {
        let body = Sphere { elements: 5, ..Sphere::default() }.body().unwrap();
        let sorted = |image: &dyn Fn([f64; 3]) -> [f64; 3]| {
            let mut all: Vec<[f64; 3]> = body.positions.iter().map(|&x| image(x).map(|x| x + 0.0)).collect();
            all.sort_by(|a, b| a.partial_cmp(b).unwrap());
            all
        };
        let same = sorted(&|x| x);
        assert_eq!(sorted(&|[x, y, z]| [-x, y, z]), same);
        assert_eq!(sorted(&|[x, y, z]| [y, z, x]), same);
        assert_eq!(sorted(&|[x, y, z]| [x, z, y]), same);
    }

    #[test]
    fn a_sphere_lies_on_its_surface_and_its_cuts_on_their_planes() {
        let sphere = Sphere { elements: 6, portion: "eighth".into(), ..Sphere::default() };
        let body = sphere.body().unwrap();
        for (name, facets) in &body.sides {
            let nodes = facets.iter().flatten().map(|&node| body.positions[node as usize]);
            match CUTS.iter().position(|cut| cut == name) {
                Some(d) => assert!(facets.len() == 21 && nodes.clone().all(|x| x[d] == 0.0), "{name}"),
                None => assert!(facets.len() == 27 && nodes.clone().all(|x| (x.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-15)),
            }
        }
    }
}
