//! What the contract tests in 3D are made on: distorted elements, patches of them, volumes by another way.

use crate::patches::{Patch, Spread, nodes_of};
use embate_solver::element::{Element, ElementVisitor, map_of, with_element};
use std::collections::BTreeMap;

pub(crate) type Vector = [f64; 3];
pub(crate) type Gradient = [Vector; 3];

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn plus(a: Vector, by: f64, b: Vector) -> Vector {
    std::array::from_fn(|d| a[d] + by * b[d])
}

pub(crate) fn apply(g: &Gradient, x: Vector) -> Vector {
    g.map(|row| dot(row, x))
}

/// Unit tensor plus a random tensor of this size.
pub(crate) fn near_one(size: f64, numbers: &mut Spread) -> Gradient {
    let mut g: Gradient = std::array::from_fn(|_| numbers.in_3d(size));
    (0..3).for_each(|d| g[d][d] += 1.0);
    g
}

/// Rotation by an angle about an axis.
pub(crate) fn rotation(axis: Vector, angle: f64) -> Gradient {
    let n = axis.map(|c| c / dot(axis, axis).sqrt());
    let (s, c) = angle.sin_cos();
    let unit = |d: usize| std::array::from_fn(|e| f64::from(u8::from(d == e)));
    let columns: Gradient = std::array::from_fn(|d| {
        let e: Vector = unit(d);
        plus(plus(e.map(|x| c * x), s, cross(n, e)), (1.0 - c) * n[d], n)
    });
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
}

/// Symmetric tensor xx yy zz xy yz zx turned by a rotation.
pub(crate) fn turned(t: [f64; 6], q: &Gradient) -> [f64; 6] {
    let [xx, yy, zz, xy, yz, zx] = t;
    let full = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let at = |i: usize, j: usize| dot(q[i], apply(&full, q[j]));
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(2, 0)]
}

/// Faces of an element, outward by the right hand.
pub(crate) fn faces(nodes: usize) -> &'static [&'static [usize]] {
    match nodes {
        4 => &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]],
        6 => &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]],
        8 => &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]],
        // Four triangles on each face of a tetrahedron.
        10 => &[
            &[0, 6, 4],
            &[6, 2, 5],
            &[4, 5, 1],
            &[6, 5, 4],
            &[0, 4, 7],
            &[4, 1, 8],
            &[7, 8, 3],
            &[4, 8, 7],
            &[1, 5, 8],
            &[5, 2, 9],
            &[8, 9, 3],
            &[5, 9, 8],
            &[2, 6, 9],
            &[6, 0, 7],
            &[9, 7, 3],
            &[6, 7, 9],
        ],
        nodes => panic!("teach the tests the faces of an element of {nodes} nodes"),
    }
}

/// ∫ f(x) x·n dA / 3 over a face, by Gauss's points: of triangles (three) and bilinear quadrilaterals (3 ×
/// 3).
fn over_face(x: &[Vector], f: &dyn Fn(Vector) -> f64) -> f64 {
    if let &[a, b, c] = x {
        let normal = cross(plus(b, -1.0, a), plus(c, -1.0, a)).map(|n| 0.5 * n);
        let at = |i: f64, j: f64, k: f64| {
            let p: Vector = std::array::from_fn(|d| i * a[d] + j * b[d] + k * c[d]);
            f(p) * dot(p, normal) / 9.0
        };
        return at(0.5, 0.5, 0.0) + at(0.0, 0.5, 0.5) + at(0.5, 0.0, 0.5);
    }
    let g = 0.6f64.sqrt();
    let points = [(-g, 5.0 / 9.0), (0.0, 8.0 / 9.0), (g, 5.0 / 9.0)];
    let mut sum = 0.0;
    for (u, wu) in points {
        for (v, wv) in points {
            let mix = |c: [f64; 4]| -> Vector { std::array::from_fn(|d| 0.25 * (0..4).map(|a| c[a] * x[a][d]).sum::<f64>()) };
            let at = mix([(1.0 - u) * (1.0 - v), (1.0 + u) * (1.0 - v), (1.0 + u) * (1.0 + v), (1.0 - u) * (1.0 + v)]);
            let (along, across) = (mix([v - 1.0, 1.0 - v, 1.0 + v, -1.0 - v]), mix([u - 1.0, -1.0 - u, 1.0 + u, 1.0 - u]));
            sum += wu * wv * f(at) * dot(at, cross(along, across)) / 3.0;
        }
    }
    sum
}

/// Volume by the surface integral of x·n / 3, warped faces too.
pub(crate) fn volume(x: &[Vector]) -> f64 {
    let face = |face: &&[usize]| over_face(&face.iter().map(|&a| x[a]).collect::<Vec<_>>(), &|_| 1.0);
    faces(x.len()).iter().map(face).sum()
}

/// Centroid: ∫ x_d dV is ¾ of the surface integral of x_d x·n / 3, by the divergence of x_d x.
pub(crate) fn centroid(x: &[Vector]) -> Vector {
    let moment = |d: usize| -> f64 {
        let face = |face: &&[usize]| over_face(&face.iter().map(|&a| x[a]).collect::<Vec<_>>(), &|p| p[d]);
        0.75 * faces(x.len()).iter().map(face).sum::<f64>()
    };
    std::array::from_fn(|d| moment(d) / volume(x))
}

struct ReferenceNodes;

impl ElementVisitor<3> for ReferenceNodes {
    type Output = Vec<Vector>;
    fn visit<E: Element<3, N, P>, const N: usize, const P: usize>(self) -> Vec<Vector> {
        // All of about the same size.
        let size = if P == 1 && N == 8 { 8.0 } else { 1.0 };
        E::NODES.iter().map(|x| x.map(|x| size * x)).collect()
    }
}

/// Nodes of one undistorted element: sides of 1 or 2.
pub(crate) fn reference_nodes(element: &str) -> Vec<Vector> {
    with_element(element, ReferenceNodes).unwrap()
}

/// Least determinant of the Jacobian at points and nodes, over that of a parallelepiped of the same volume.
fn soundness(x: &[Vector]) -> f64 {
    struct Ask<'a>(&'a [Vector]);
    impl ElementVisitor<3> for Ask<'_> {
        type Output = f64;
        fn visit<E: Element<3, N, P>, const N: usize, const P: usize>(self) -> f64 {
            let x: [Vector; N] = self.0.try_into().unwrap();
            let at_points = map_of::<E, f64, 3, N, P>(&x).determinants;
            let natural: f64 = E::WEIGHTS.iter().sum();
            at_points.into_iter().fold(f64::INFINITY, f64::min) * natural
        }
    }
    let edges = |a: usize| -> [usize; 3] {
        match x.len() {
            8 => [[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]][a],
            6 => [[1, 2, 3], [2, 0, 4], [0, 1, 5], [5, 4, 0], [3, 5, 1], [4, 3, 2]][a],
            _ => [[1, 2, 3], [2, 0, 3], [0, 1, 3], [2, 1, 0]][a],
        }
    };
    let corner = |a: usize| {
        let [i, j, k] = edges(a).map(|b| plus(x[b], -1.0, x[a]));
        dot(i, cross(j, k)) * [0.0, 0.0, 0.0, 0.0, 1.0 / 6.0, 0.0, 0.5, 0.0, 1.0, 0.0, 1.0 / 6.0][x.len()]
    };
    // Of ten nodes the tetrahedra at the corners, too: an eighth of the whole each.
    let at_corner = |a: usize| {
        let [i, j, k] = [[4, 6, 7], [5, 4, 8], [6, 5, 9], [9, 8, 7]][a].map(|b: usize| plus(x[b], -1.0, x[a]));
        dot(i, cross(j, k)) * 8.0 / 6.0
    };
    if x.len() == 10 && (0..4).map(at_corner).fold(f64::INFINITY, f64::min) < 0.1 * volume(x) {
        return -1.0;
    }
    let name = ["", "", "", "", "tet4", "", "wedge6", "", "hex8", "", "tet10"][x.len()];
    (0..if x.len() == 10 { 4 } else { x.len() }).map(corner).fold(with_element(name, Ask(x)).unwrap(), f64::min) / volume(x).abs()
}

/// A random sound element: corners moved by up to `roughness` of its half size, stretched by up to `aspect`,
/// sheared, turned.
pub(crate) fn distorted(element: &str, roughness: f64, aspect: f64, numbers: &mut Spread) -> Vec<Vector> {
    let reference = reference_nodes(element);
    loop {
        let rough = numbers.between(0.0, roughness);
        let stretch: Vector = std::array::from_fn(|_| numbers.between(-0.5 * aspect.ln(), 0.5 * aspect.ln()).exp());
        // In every third element.
        let sheared = numbers.between(0.0, 1.5).floor();
        let shear: Vector = numbers.in_3d(sheared);
        let q = rotation(plus([0.1, 0.2, 1.0], 1.0, numbers.in_3d(1.0)), numbers.between(0.0, 6.3));
        let size = [0.5, 1.0, 0.3][usize::from(reference.len() == 8) + 2 * usize::from(reference.len() == 10)];
        let corner = |x: &Vector, moved: Vector| {
            let [x, y, z] = plus(*x, size, moved);
            let [x, y, z] = [x * stretch[0], y * stretch[1], z * stretch[2]];
            apply(&q, [x + shear[0] * y + shear[1] * z, y + shear[2] * z, z])
        };
        let moved: Vec<_> = reference.iter().map(|x| corner(x, numbers.in_3d(rough))).collect();
        if volume(&moved) > 0.0 && soundness(&moved) > 0.05 {
            return moved;
        }
    }
}

/// A patch of `n` × `n` × `n` unit cells with displaced inner nodes.
pub(crate) fn patch(element: &str, n: usize, roughness: f64) -> Patch<3> {
    let mut numbers = Spread::new(7);
    let side = n + 1;
    let indices = |k: usize| [k % side, k / side % side, k / (side * side)];
    let is_inner = |k: usize| indices(k).iter().all(|i| (1..n).contains(i));
    let place = |k: usize| {
        let moved = if is_inner(k) { numbers.in_3d(roughness) } else { [0.0; 3] };
        plus(indices(k).map(|i| i as f64), 1.0, moved)
    };
    let mut positions: Vec<Vector> = (0..side * side * side).map(place).collect();
    let mut connectivity: Vec<u32> = Vec::new();
    for cell in 0..n * n * n {
        let node = |[i, j, k]: [usize; 3]| (((cell / (n * n) + k) * side + cell / n % n + j) * side + cell % n + i) as u32;
        let c = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]].map(node);
        match nodes_of(element) {
            8 => connectivity.extend(c),
            6 => connectivity.extend([0, 1, 2, 4, 5, 6, 0, 2, 3, 4, 6, 7].map(|a: usize| c[a])),
            // Kuhn's six tetrahedra around the diagonal from 0 to 6.
            4 | 10 => connectivity.extend(
                [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
                    .as_flattened()
                    .iter()
                    .map(|&a: &usize| c[a]),
            ),
            nodes => panic!("teach the patch an element of {nodes} nodes"),
        }
    }
    if nodes_of(element) == 10 {
        connectivity = with_middles(&mut positions, &connectivity);
    }
    let is_within = |x: &Vector| x.iter().all(|x| (1e-9..n as f64 - 1e-9).contains(x));
    let inner = (0..positions.len()).filter(|&k| if k < side * side * side { is_inner(k) } else { is_within(&positions[k]) }).collect();
    Patch { positions, connectivity, inner }
}

/// Tetrahedra of ten nodes from those of four, with straight edges.
pub(crate) fn with_middles(positions: &mut Vec<Vector>, connectivity: &[u32]) -> Vec<u32> {
    let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let mut all = Vec::new();
    for cell in connectivity.chunks_exact(4) {
        all.extend_from_slice(cell);
        for [a, b] in [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]].map(|edge| edge.map(|k: usize| cell[k])) {
            let new = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push(plus(positions[a as usize], 1.0, positions[b as usize]).map(|x| 0.5 * x));
                positions.len() as u32 - 1
            });
            all.push(new);
        }
    }
    all
}
