//! A full disk without needle elements.

use super::numbers::{between, cos_sin};
use super::{Body, BuiltIn, Count, ELEMENTS, ShapeCheck, Values, Wrong, node, shape_key};
use crate::mesh::cell::CellKind;
use crate::quantity::Dimension;
use crate::quantity::Range::{Finite, Positive};
use crate::vocabulary::Kind::{Integer, Quantity, Vector};
use crate::vocabulary::Need::Required;
use crate::vocabulary::{Key, Section, key};

/// A full disk: a square core of `elements` × `elements` with bulged sides, and layers of quadrilaterals from
/// there to the circle; three elements meet at the core's four corners. Side `outer`.
///
/// From 2 elements on no corner angle is below 67 degrees and no side longer than twice the shortest of its
/// element; with 1 (five elements in all) 45 degrees and 2.5 times (a test holds this).
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    /// Centre, m.
    pub centre: [f64; 2],
    /// Radius, m.
    pub radius: f64,
    /// Elements around a quarter of the circumference.
    pub elements: usize,
}

pub(super) const KEY: Key = shape_key("disk", &SECTION, "A full disk.");

static SECTION: Section = Section {
    name: "disk",
    doc: "A full disk; its side is `outer`.",
    keys: &[
        key("centre", Vector(Dimension::LENGTH, Finite), Required, "Centre."),
        key("radius", Quantity(Dimension::LENGTH, Positive), Required, "Radius."),
        key(ELEMENTS, Integer(1), Required, "Elements around a quarter of the circumference."),
    ],
    ..Section::EMPTY
};

impl BuiltIn<2> for Disk {
    fn read(values: &dyn Values) -> Self {
        Self { centre: values.get("centre"), radius: values.get("radius"), elements: values.get(ELEMENTS) }
    }

    fn check(&self, check: &mut dyn ShapeCheck) {
        check.vector("centre", self.centre);
        check.number("radius", self.radius);
        check.counts(ELEMENTS, &[self.elements]);
    }

    fn sides(&self) -> Vec<String> {
        vec!["outer".into()]
    }

    fn count(&self) -> Count {
        let n = self.elements;
        let (core, ring) = (n.saturating_mul(n), n.saturating_mul(4).saturating_mul(layers_of(n)));
        let lattice = n.saturating_add(1).saturating_mul(n.saturating_add(1));
        Count { nodes: lattice.saturating_add(ring), elements: core.saturating_add(ring), exact: true }
    }

    /// Nodes: the core row by row, then the layers outwards, each counter-clockwise from −135 degrees.
    fn body(&self) -> Result<Body<2>, Wrong> {
        let Self { centre, radius, elements: n } = *self;
        let layers = layers_of(n);
        let mut body = Body::default();
        if n == 0 {
            return Ok(body);
        }
        for j in 0..=n {
            for i in 0..=n {
                let [x, y] = core_point(i, j, n);
                body.positions.push([centre[0] + radius * x, centre[1] + radius * y]);
            }
        }
        let core = |i: usize, j: usize| j * (n + 1) + i;
        for j in 0..n {
            body.extend(
                CellKind::Quadrilateral,
                (0..n).map(|i| [core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)].map(node)),
            );
        }
        // The core's outside, counter-clockwise from its lower left corner; it is layer 0.
        let outside: Vec<[usize; 2]> = (0..n)
            .map(|k| [k, 0])
            .chain((0..n).map(|k| [n, k]))
            .chain((0..n).map(|k| [n - k, n]))
            .chain((0..n).map(|k| [0, n - k]))
            .collect();
        let around = 4 * n;
        let at = |layer: usize, k: usize| match (layer, k % around) {
            (0, k) => node(core(outside[k][0], outside[k][1])),
            (layer, k) => node((n + 1) * (n + 1) + (layer - 1) * around + k),
        };
        for layer in 1..=layers {
            for &[i, j] in &outside {
                let (inside, circle) = (core_point(i, j, n), direction(i, j, n));
                let [x, y] = [0, 1].map(|d| between(inside[d], circle[d], layer, layers));
                body.positions.push([centre[0] + radius * x, centre[1] + radius * y]);
            }
            body.extend(
                CellKind::Quadrilateral,
                (0..around).map(|k| [at(layer - 1, k), at(layer, k), at(layer, k + 1), at(layer - 1, k + 1)]),
            );
        }
        body.sides = vec![("outer".into(), (0..around).rev().map(|k| [at(layers, k + 1), at(layers, k)]).collect())];
        Ok(body)
    }

    #[cfg(test)]
    fn examples(n: usize) -> Vec<(Self, f64)> {
        vec![(Self { centre: [0.5, -0.25], radius: 2.0, elements: n }, 4.0 * std::f64::consts::PI)]
    }
}

impl Disk {
    /// Layers of quadrilaterals around the core.
    pub(super) fn layers(&self) -> usize {
        layers_of(self.elements)
    }
}

/// How round the sides of a disk's core are: 0 straight, 1 arcs around the centre. This and [`core_fraction`]
/// and [`layers_of`] were chosen from a scan for large corner angles, sides of equal length, and a large area
/// over longest diagonal (the stable step).
const ROUND: f64 = 0.5;

/// Distance of the core's corners from the centre, as a fraction of the radius: smaller on coarse disks,
/// whose chords flatten the circle.
fn core_fraction(elements: usize) -> f64 {
    match elements {
        1 => 0.40,
        2 => 0.55,
        _ => 0.65,
    }
}

/// Layers of quadrilaterals between a disk's core and its circle: about as thick as they are wide.
fn layers_of(elements: usize) -> usize {
    (elements.saturating_mul(3).saturating_add(5) / 10).max(1)
}

/// Lattice point (i, j) of 0..=n in the square [−1, 1]².
fn lattice_point(i: usize, j: usize, n: usize) -> [f64; 2] {
    [between(-1.0, 1.0, i, n), between(-1.0, 1.0, j, n)]
}

/// Point (i, j) of a unit disk's core: a square lattice at the centre that becomes rounder outwards.
fn core_point(i: usize, j: usize, n: usize) -> [f64; 2] {
    let corner = core_fraction(n);
    let half = corner * std::f64::consts::FRAC_1_SQRT_2;
    let [a, b] = lattice_point(i, j, n);
    let ring = a.abs().max(b.abs());
    let round = ROUND * ring;
    let [c, s] = direction(i, j, n);
    [(1.0 - round) * half * a + round * corner * ring * c, (1.0 - round) * half * b + round * corner * ring * s]
}

/// The unit vector that belongs to lattice point (i, j): equal angles for equal steps along a side of the
/// square. Worked out in the first octant and mirrored, so that mirror images agree to the last bit. Zero at
/// the centre.
fn direction(i: usize, j: usize, n: usize) -> [f64; 2] {
    let [a, b] = lattice_point(i, j, n);
    let (small, large) = (a.abs().min(b.abs()), a.abs().max(b.abs()));
    if large == 0.0 {
        return [0.0, 0.0];
    }
    let [c, s] = if small == large { [std::f64::consts::FRAC_1_SQRT_2; 2] } else { cos_sin(0.5 * (small / large)) };
    let [x, y] = if a.abs() >= b.abs() { [c, s] } else { [s, c] };
    [x.copysign(a), y.copysign(b)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::tests::{cross, minus, moments};
    use std::f64::consts::PI;

    fn disk(centre: [f64; 2], radius: f64, elements: usize) -> Body<2> {
        Disk { centre, radius, elements }.body().unwrap()
    }

    #[test]
    fn the_moments_of_a_disk_converge_with_the_square_of_the_element_size() {
        let exact = [PI, PI / 4.0, PI / 4.0, 0.0];
        for m in 0..4 {
            let error = |n| (moments(&disk([0.0, 0.0], 1.0, n))[m] - exact[m]).abs();
            let slope = (error(10) / error(20)).log2();
            assert!(if m == 3 { error(20) < 1e-15 } else { (1.95..2.05).contains(&slope) }, "moment {m}: slope {slope}");
        }
    }

    #[test]
    fn mirror_images_of_a_disk_agree_to_the_last_bit() {
        crate::mesh::shapes::tests::is_its_mirror_image(&disk([0.0, 0.0], 0.7, 9));
    }

    /// Smallest corner angle in degrees, largest ratio of two sides of an element, largest over smallest side
    /// of the mesh.
    fn quality(body: &Body<2>) -> [f64; 3] {
        let (mut angle, mut aspect, mut shortest, mut longest) = (180.0_f64, 1.0_f64, f64::MAX, 0.0_f64);
        for quad in body.all::<4>(CellKind::Quadrilateral) {
            let x = quad.map(|n| body.positions[n as usize]);
            let (mut low, mut high) = (f64::MAX, 0.0_f64);
            for k in 0..4 {
                let (a, b) = (minus(x[(k + 1) % 4], x[k]), minus(x[(k + 3) % 4], x[k]));
                angle = angle.min(cross(a, b).atan2(a[0] * b[0] + a[1] * b[1]).to_degrees());
                let side = a[0].hypot(a[1]);
                (low, high) = (low.min(side), high.max(side));
            }
            aspect = aspect.max(high / low);
            (shortest, longest) = (shortest.min(low), longest.max(high));
        }
        [angle, aspect, longest / shortest]
    }

    #[test]
    fn a_disk_has_no_needle_elements() {
        for n in 1..=64 {
            let [angle, aspect, range] = quality(&disk([0.0, 0.0], 1.0, n));
            let limits = if n == 1 { [44.9, 2.51, 2.51] } else { [67.0, 2.0, 2.0] };
            assert!(angle > limits[0] && aspect < limits[1] && range < limits[2], "{n}: {angle} {aspect} {range}");
        }
    }
}
