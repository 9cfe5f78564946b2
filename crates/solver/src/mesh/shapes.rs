//! Built-in shapes: rectangle, ring, disk. Parameters come from the model, checked there; bodies go to the mesh builder.
//!
//! Angles are counted in quarter turns and sines and cosines are computed here with fixed operations: the same bits on every platform,
//! exact zeros and ones on the axes (nodes that should lie on a symmetry line do), and mirror images that agree to the last bit.

use crate::model::Shape;
use crate::model::reference::is_full_turn;
use std::f64::consts::FRAC_PI_2;

/// The mesh of one body: nodes, counter-clockwise quadrilaterals, and named sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Node positions, m.
    pub positions: Vec<[f64; 2]>,
    /// Quadrilaterals, counter-clockwise.
    pub quads: Vec<[u32; 4]>,
    /// Named sides as segments with the body on their right.
    pub sides: Vec<(&'static str, Vec<[u32; 2]>)>,
}

/// The mesh of a built-in shape; `None` for a group of an imported mesh.
#[must_use]
pub fn body(shape: &Shape) -> Option<Body> {
    match *shape {
        Shape::Rectangle { corner, size, elements } => Some(rectangle(corner, size, elements)),
        Shape::Ring { centre, inner, outer, from, to, elements } => Some(ring(centre, inner, outer, from, to, elements)),
        Shape::Disk { centre, radius, elements } => Some(disk(centre, radius, elements)),
        Shape::Group { .. } => None,
    }
}

/// Numbers of nodes and of quadrilaterals that [`body`] makes, without making them (saturating at `usize::MAX`);
/// `None` for a group of an imported mesh. Node numbers are 32 bits wide, so a model asks here first.
#[must_use]
pub fn count(shape: &Shape) -> Option<[usize; 2]> {
    let grid = |a: usize, b: usize| a.saturating_mul(b);
    match *shape {
        Shape::Rectangle { elements: [nx, ny], .. } => Some([grid(nx.saturating_add(1), ny.saturating_add(1)), grid(nx, ny)]),
        Shape::Ring { from, to, elements: [through, around], .. } => {
            let stations = around.saturating_add(usize::from(!is_full_turn(from, to)));
            Some([grid(through.saturating_add(1), stations), grid(through, around)])
        }
        Shape::Disk { elements: n, .. } => {
            let ring = grid(n.saturating_mul(4), disk_layers(n));
            Some([grid(n.saturating_add(1), n.saturating_add(1)).saturating_add(ring), grid(n, n).saturating_add(ring)])
        }
        Shape::Group { .. } => None,
    }
}

/// An axis-parallel rectangle of `elements` = `[along x, along y]` equal quadrilaterals.
///
/// `corner` is the lower left corner, `size` the width and height (m, positive). Nodes run along x first. Sides `left`, `right`, `bottom`,
/// `top`, each in the direction that has the body on its right (clockwise around the body).
#[must_use]
pub fn rectangle(corner: [f64; 2], size: [f64; 2], elements: [usize; 2]) -> Body {
    let [nx, ny] = elements;
    let row = nx + 1;
    let at = |i: usize, j: usize| node(j * row + i);
    let mut body = Body::default();
    for j in 0..=ny {
        let y = between(corner[1], corner[1] + size[1], j, ny);
        body.positions.extend((0..=nx).map(|i| [between(corner[0], corner[0] + size[0], i, nx), y]));
    }
    for j in 0..ny {
        body.quads.extend((0..nx).map(|i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    }
    body.sides = vec![
        ("left", (0..ny).map(|j| [at(0, j), at(0, j + 1)]).collect()),
        ("right", (0..ny).rev().map(|j| [at(nx, j + 1), at(nx, j)]).collect()),
        ("bottom", (0..nx).rev().map(|i| [at(i + 1, 0), at(i, 0)]).collect()),
        ("top", (0..nx).map(|i| [at(i, ny), at(i + 1, ny)]).collect()),
    ];
    body
}

/// A ring, or a sector of one, of `elements` = `[through the wall, around]` quadrilaterals.
///
/// It runs counter-clockwise from angle `from` to angle `to` (radians from +x, `from < to ≤ from + 2π`) and closes on itself
/// when they differ by 2π (within 1e-9 of a quarter turn; at least 3 elements around are needed then). `0 < inner < outer`, m.
/// Nodes run through the wall first, from the inside. Sides `inner`, `outer` and, for a sector, `start` (at `from`) and `end` (at `to`).
#[must_use]
pub fn ring(centre: [f64; 2], inner: f64, outer: f64, from: f64, to: f64, elements: [usize; 2]) -> Body {
    let [through, around] = elements;
    let full = is_full_turn(from, to);
    let first = quarters(from);
    let last = if full { first + 4.0 } else { quarters(to) };
    let stations = if full { around } else { around + 1 };
    let row = through + 1;
    // A full ring's last station is its first.
    let at = |i: usize, j: usize| node(if full && j == around { i } else { j * row + i });
    let mut body = Body::default();
    for j in 0..stations {
        let [c, s] = cos_sin(between(first, last, j, around));
        body.positions.extend((0..=through).map(|i| {
            let r = between(inner, outer, i, through);
            [centre[0] + r * c, centre[1] + r * s]
        }));
    }
    for j in 0..around {
        body.quads.extend((0..through).map(|i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    }
    body.sides = vec![
        ("inner", (0..around).map(|j| [at(0, j), at(0, j + 1)]).collect()),
        ("outer", (0..around).rev().map(|j| [at(through, j + 1), at(through, j)]).collect()),
    ];
    if !full {
        body.sides.push(("start", (0..through).rev().map(|i| [at(i + 1, 0), at(i, 0)]).collect()));
        body.sides.push(("end", (0..through).map(|i| [at(i, around), at(i + 1, around)]).collect()));
    }
    body
}

/// How round the sides of a disk's core are: 0 straight, 1 arcs around the centre. This and [`core_fraction`] and [`disk_layers`] were
/// chosen from a scan for large corner angles, sides of equal length, and a large area over longest diagonal (the stable step).
const ROUND: f64 = 0.5;

/// Distance of the core's corners from the centre, as a fraction of the radius: smaller on coarse disks, whose chords flatten the circle.
fn core_fraction(elements: usize) -> f64 {
    match elements {
        1 => 0.40,
        2 => 0.55,
        _ => 0.65,
    }
}

/// A full disk with `elements` quadrilaterals around each quarter of its circumference and no needle elements.
///
/// A square core of `elements` × `elements` with bulged sides, and layers of quadrilaterals from there to the circle; three elements meet at
/// the core's four corners. From 2 elements on no corner angle is below 67 degrees and no side longer than twice the shortest of its
/// element; with 1 (five elements in all) 45 degrees and 2.5 times (a test holds this). `radius` in m. Nodes: the core row by row, then the layers outwards, each counter-clockwise
/// from −135 degrees. Side `outer`.
#[must_use]
pub fn disk(centre: [f64; 2], radius: f64, elements: usize) -> Body {
    let n = elements;
    let layers = disk_layers(n);
    let mut body = Body::default();
    if n == 0 {
        return body;
    }
    for j in 0..=n {
        for i in 0..=n {
            let [x, y] = core_point(i, j, n);
            body.positions.push([centre[0] + radius * x, centre[1] + radius * y]);
        }
    }
    let core = |i: usize, j: usize| j * (n + 1) + i;
    for j in 0..n {
        body.quads.extend((0..n).map(|i| [core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)].map(node)));
    }
    // The core's outside, counter-clockwise from its lower left corner; it is layer 0.
    let outside: Vec<[usize; 2]> =
        (0..n).map(|k| [k, 0]).chain((0..n).map(|k| [n, k])).chain((0..n).map(|k| [n - k, n])).chain((0..n).map(|k| [0, n - k])).collect();
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
        body.quads.extend((0..around).map(|k| [at(layer - 1, k), at(layer, k), at(layer, k + 1), at(layer - 1, k + 1)]));
    }
    body.sides = vec![("outer", (0..around).rev().map(|k| [at(layers, k + 1), at(layers, k)]).collect())];
    body
}

/// Layers of quadrilaterals between a disk's core and its circle: about as thick as they are wide.
fn disk_layers(elements: usize) -> usize {
    (elements.saturating_mul(3).saturating_add(5) / 10).max(1)
}

/// Lattice point (i, j) of 0..=n in the square [−1, 1]².
fn lattice(i: usize, j: usize, n: usize) -> [f64; 2] {
    [between(-1.0, 1.0, i, n), between(-1.0, 1.0, j, n)]
}

/// Point (i, j) of a unit disk's core: a square lattice at the centre that becomes rounder outwards.
fn core_point(i: usize, j: usize, n: usize) -> [f64; 2] {
    let corner = core_fraction(n);
    let half = corner * std::f64::consts::FRAC_1_SQRT_2;
    let [a, b] = lattice(i, j, n);
    let ring = a.abs().max(b.abs());
    let round = ROUND * ring;
    let [c, s] = direction(i, j, n);
    [(1.0 - round) * half * a + round * corner * ring * c, (1.0 - round) * half * b + round * corner * ring * s]
}

/// The unit vector that belongs to lattice point (i, j): equal angles for equal steps along a side of the square. Worked out in
/// the first octant and mirrored, so that mirror images agree to the last bit. Zero at the centre.
fn direction(i: usize, j: usize, n: usize) -> [f64; 2] {
    let [a, b] = lattice(i, j, n);
    let (small, large) = (a.abs().min(b.abs()), a.abs().max(b.abs()));
    if large == 0.0 {
        return [0.0, 0.0];
    }
    let [c, s] = if small == large { [std::f64::consts::FRAC_1_SQRT_2; 2] } else { cos_sin(0.5 * (small / large)) };
    let [x, y] = if a.abs() >= b.abs() { [c, s] } else { [s, c] };
    [x.copysign(a), y.copysign(b)]
}

/// Entry `i` of `0..=n` equal steps from `a` to `b`, exact at both ends and symmetric under exchange of the ends.
fn between(a: f64, b: f64, i: usize, n: usize) -> f64 {
    if i == 0 {
        a
    } else if i == n {
        b
    } else {
        (a * (n - i) as f64 + b * i as f64) / n as f64
    }
}

fn node(index: usize) -> u32 {
    u32::try_from(index).expect("the model has limited the number of nodes to 32 bits (shapes::count)")
}

/// An angle in radians as a number of quarter turns; whole, half and quarter steps of a quarter turn that were meant are made exact.
fn quarters(angle: f64) -> f64 {
    let q = angle / FRAC_PI_2;
    let snapped = (4.0 * q).round() / 4.0;
    if (q - snapped).abs() < 1e-12 { snapped } else { q }
}

/// Cosine and sine of a number of quarter turns, by Taylor polynomials of degree 18 and 17 on ±45 degrees (truncation below 1e-17).
/// Within 1e-12 of whole quarter turns they are exactly 0 and ±1.
fn cos_sin(quarters: f64) -> [f64; 2] {
    let whole = quarters.round();
    let mut rest = quarters - whole;
    if rest.abs() < 1e-12 {
        rest = 0.0;
    }
    let r = rest * FRAC_PI_2;
    let r2 = r * r;
    let (mut c, mut s) = (1.0, 1.0);
    // Horner from the inside: each step multiplies by −r²/(k (k + 1)).
    for k in (1..=17).rev().step_by(2) {
        c = 1.0 - r2 / f64::from(k * (k + 1)) * c;
    }
    for k in (2..=16).rev().step_by(2) {
        s = 1.0 - r2 / f64::from(k * (k + 1)) * s;
    }
    s *= r;
    match whole.rem_euclid(4.0) as u8 {
        0 => [c, s],
        1 => [0.0 - s, c],
        2 => [-c, 0.0 - s],
        _ => [s, -c],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::surface::exterior;
    use std::f64::consts::PI;

    fn jacobians(body: &Body) -> impl Iterator<Item = f64> + '_ {
        body.quads.iter().flat_map(|quad| {
            let x = quad.map(|n| body.positions[n as usize]);
            (0..4).map(move |k| cross(minus(x[(k + 1) % 4], x[k]), minus(x[(k + 3) % 4], x[k])))
        })
    }
    fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        [a[0] - b[0], a[1] - b[1]]
    }
    fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
        a[0] * b[1] - a[1] * b[0]
    }

    /// Area, ∫x², ∫y² and ∫xy, exact for the polygons (triangle formula).
    fn moments(body: &Body) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for quad in &body.quads {
            for t in [[0, 1, 2], [0, 2, 3]] {
                let [p, q, r] = t.map(|k| body.positions[quad[k] as usize]);
                let area = 0.5 * cross(minus(q, p), minus(r, p));
                let product = |i: usize, j: usize| {
                    let (s, t) = (p[i] + q[i] + r[i], p[j] + q[j] + r[j]);
                    area / 12.0 * (s * t + p[i] * p[j] + q[i] * q[j] + r[i] * r[j])
                };
                let more = [area, product(0, 0), product(1, 1), product(0, 1)];
                for (s, m) in sum.iter_mut().zip(more) {
                    *s += m;
                }
            }
        }
        sum
    }

    fn cells(body: &Body) -> impl Iterator<Item = &[u32]> {
        body.quads.iter().map(<[u32; 4]>::as_slice)
    }

    fn sides_cover_the_outside(body: &Body) {
        let mut of_sides: Vec<_> = body.sides.iter().flat_map(|(_, segments)| segments.iter().copied()).collect();
        let mut of_cells = exterior(cells(body)).unwrap();
        of_sides.sort_unstable();
        of_cells.sort_unstable();
        assert_eq!(of_sides, of_cells);
        for (name, segments) in &body.sides {
            for pair in segments.windows(2) {
                assert_eq!(pair[0][1], pair[1][0], "the segments of {name} follow each other");
            }
        }
    }

    fn every_shape() -> Vec<Shape> {
        let mut shapes = vec![];
        for elements in [1, 2, 3, 4, 7, 12, 33] {
            shapes.push(Shape::Rectangle { corner: [-1.0, 2.0], size: [3.0, 0.25], elements: [elements, 3] });
            shapes.push(Shape::Disk { centre: [0.5, -0.25], radius: 2.0, elements });
            let ring = |from: f64, to: f64, around| Shape::Ring {
                centre: [0.0, 1.0],
                inner: 0.9,
                outer: 1.0,
                from,
                to,
                elements: [elements, around],
            };
            shapes.push(ring(-0.5 * PI, 0.5 * PI, 2 * elements));
            shapes.push(ring(0.3, 1.1, elements));
            shapes.push(ring(-PI, PI, elements + 2));
        }
        shapes
    }

    #[test]
    fn every_corner_of_every_shape_has_a_positive_jacobian() {
        for shape in every_shape() {
            let body = body(&shape).unwrap();
            assert!(!body.quads.is_empty());
            assert!(jacobians(&body).all(|j| j > 0.0), "{shape:?}");
        }
    }

    #[test]
    fn the_sides_of_every_shape_cover_its_outside_exactly_and_have_the_promised_names_and_counts() {
        for shape in every_shape() {
            let body = body(&shape).unwrap();
            sides_cover_the_outside(&body);
            let names: Vec<_> = body.sides.iter().map(|s| s.0).collect();
            assert_eq!(names, shape.sides());
            assert_eq!(count(&shape), Some([body.positions.len(), body.quads.len()]));
            let mut used: Vec<u32> = body.quads.iter().flatten().copied().collect();
            used.sort_unstable();
            used.dedup();
            assert_eq!(used.len(), body.positions.len(), "every node is used");
        }
    }

    #[test]
    fn a_group_of_a_file_is_no_built_in_shape() {
        let group = Shape::Group { mesh: 0, group: "tube".into() };
        assert_eq!((body(&group), group.sides().len(), count(&group)), (None, 0, None));
    }

    #[test]
    fn a_rectangle_has_its_area_and_its_sides_lie_where_their_names_say() {
        let body = rectangle([1.0, 2.0], [3.0, 0.5], [6, 2]);
        assert!((moments(&body)[0] - 1.5).abs() < 1e-14);
        for (name, d, value) in [("left", 0, 1.0), ("right", 0, 4.0), ("bottom", 1, 2.0), ("top", 1, 2.5)] {
            let side = &body.sides.iter().find(|s| s.0 == name).unwrap().1;
            assert!(side.iter().flatten().all(|&n| body.positions[n as usize][d] == value), "{name}");
        }
    }

    #[test]
    fn the_moments_of_a_ring_and_a_disk_converge_with_the_square_of_the_element_size() {
        let of_ring = |n: usize| moments(&ring([0.0, 0.0], 0.5, 1.0, 0.0, 0.5 * PI, [2, n]));
        let of_disk = |n: usize| moments(&disk([0.0, 0.0], 1.0, n));
        let second = |a: f64, r: f64| a * (1.0 - r * r * r * r) / 16.0;
        let ring_exact = [0.75 * PI / 4.0, second(PI, 0.5), second(PI, 0.5), (1.0 - 0.0625) / 8.0];
        let disk_exact = [PI, PI / 4.0, PI / 4.0, 0.0];
        for m in 0..4 {
            let error = |n| (of_ring(n)[m] - ring_exact[m]).abs();
            let slope = (error(20) / error(40)).log2();
            assert!((1.95..2.05).contains(&slope), "ring moment {m}: slope {slope}");
            let error = |n| (of_disk(n)[m] - disk_exact[m]).abs();
            let slope = (error(10) / error(20)).log2();
            assert!(if m == 3 { error(20) < 1e-15 } else { (1.95..2.05).contains(&slope) }, "disk moment {m}: slope {slope}");
        }
    }

    #[test]
    fn a_ring_closes_on_itself() {
        for (from, to) in [(0.0, 2.0 * PI), (-PI, PI), (0.7, 0.7 + 2.0 * PI), (0.0, 2.0 * PI - 2e-10)] {
            let body = ring([0.0, 0.0], 1.0, 2.0, from, to, [2, 8]);
            assert_eq!((body.positions.len(), body.quads.len(), body.sides.len()), (24, 16, 2));
        }
    }

    #[test]
    fn nodes_on_an_axis_lie_on_it_exactly() {
        // As the reader turns degrees into radians.
        let degrees = |d: f64| d * (PI / 180.0);
        for around in [2, 4, 6, 40, 180, 1000] {
            let tube = ring([0.0, 0.1], 0.094, 0.100, degrees(-90.0), degrees(90.0), [1, around]);
            let on_line = tube.positions.iter().filter(|p| p[0] == 0.0).count();
            assert_eq!(on_line, 4, "{around} around");
            assert!(tube.positions.iter().all(|p| p[0] >= 0.0));
            assert_eq!(tube.positions[1], [0.0, 0.1 - 0.1]);
            let whole = ring([0.25, 0.5], 1.0, 2.0, degrees(-90.0), degrees(270.0), [1, 2 * around]);
            assert_eq!(whole.positions.iter().filter(|p| p[0] == 0.25).count(), 4, "{around} around");
        }
    }

    #[test]
    fn mirror_images_agree_to_the_last_bit() {
        let half = ring([0.0, 0.0], 0.3, 0.7, -0.5 * PI, 0.5 * PI, [3, 37]);
        let full = disk([0.0, 0.0], 0.7, 9);
        for body in [&half, &full] {
            let mut ours = body.positions.clone();
            let mut mirrored: Vec<_> = ours.iter().map(|&[x, y]| [x, 0.0 - y]).collect();
            let order = |a: &[f64; 2], b: &[f64; 2]| a.partial_cmp(b).unwrap();
            ours.sort_by(order);
            mirrored.sort_by(order);
            assert_eq!(ours, mirrored);
        }
    }

    #[test]
    fn the_own_sine_and_cosine_agree_with_the_platforms() {
        let mut worst = 0.0_f64;
        for i in -40_000..=40_000 {
            let q = f64::from(i) * 1.234_567e-4;
            let [c, s] = cos_sin(q);
            worst = worst.max((c - (q * FRAC_PI_2).cos()).abs()).max((s - (q * FRAC_PI_2).sin()).abs());
        }
        // Far angles carry the rounding of their own argument: 7.8 · 1.1e-16.
        assert!(worst < 1.2e-15, "{worst:e}");
        for i in -1000..=1000 {
            let q = f64::from(i) * 5e-4;
            let [c, s] = cos_sin(q);
            assert!((c - (q * FRAC_PI_2).cos()).abs() <= 2.3e-16 && (s - (q * FRAC_PI_2).sin()).abs() <= 1.7e-16, "{q}");
        }
        assert_eq!(
            [0.0, 1.0, 2.0, 3.0, 4.0, -1.0].map(cos_sin),
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, -1.0]]
        );
    }

    /// Smallest corner angle in degrees, largest ratio of two sides of an element, largest over smallest side of the mesh.
    fn quality(body: &Body) -> [f64; 3] {
        let (mut angle, mut aspect, mut shortest, mut longest) = (180.0_f64, 1.0_f64, f64::MAX, 0.0_f64);
        for quad in &body.quads {
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
