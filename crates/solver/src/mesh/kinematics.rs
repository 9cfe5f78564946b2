//! Deformation gradient and velocity gradient in the middle of elements, for output.
//!
//! With the Jacobians J₀ = ∂X/∂ξ at the start and J = ∂x/∂ξ now: F = J J₀⁻¹, and L = (∂v/∂ξ) J⁻¹. The
//! gradients of the shape functions in the middle are those of the plane that fits the nodes of the reference
//! cell best: b_a = G⁻¹ (ξ_a − ξ̄), G = Σ (ξ_a − ξ̄)(ξ_a − ξ̄)ᵀ, which for every kind of cell are the
//! isoparametric ones there. Cells of fewer dimensions than the model (shells, beams, bars) are completed by
//! their normals, the first of which is stretched with the thickness; beams and bars keep their
//! cross-section.

use crate::mesh::cell::CellKind;
use crate::rotation::{Square, inverse};
use crate::tensor::{cross, product};
use crate::vector::{any_tangent, dot, length, minus, plus, times};

/// How an element has deformed, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kinematics {
    /// Deformation gradient F.
    pub(crate) gradient: Square<3>,
    /// Velocity gradient L, 1/s.
    pub(crate) rate: Square<3>,
}

/// Stretches that the motion of the nodes does not say, and their rates, 1/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Across {
    /// Of the thickness of shells, t/t₀.
    pub(crate) thickness: f64,
    /// Out of the plane of a 2D model: of an axisymmetric one r/R.
    pub(crate) out_of_plane: f64,
    /// ṙ/r.
    pub(crate) hoop_rate: f64,
}

impl Kinematics {
    /// Of nodes at the start and now (m) that move with velocities (m/s); `dimension` is that of the model.
    /// Nothing where the element had no size.
    pub(crate) fn new(kind: CellKind, dimension: usize, nodes: &[[[f64; 3]; 3]], across: Across) -> Option<Self> {
        let gradients = gradients(kind)?;
        let map = |which: usize| -> Vec<[f64; 3]> {
            (0..kind.dimension())
                .map(|d| nodes.iter().zip(&gradients).fold([0.0; 3], |sum, (node, b)| plus(sum, times(b[d], node[which]))))
                .collect()
        };
        let (initial, now, velocity) = (map(0), map(1), map(2));
        let [whole_initial, whole_now] = completed(dimension, &initial, &now)?;
        let mut stretched = whole_now;
        let mut rates = [[0.0; 3]; 3];
        rates.iter_mut().zip(&velocity).for_each(|(rate, own)| *rate = *own);
        if dimension == 2 {
            stretched[2] = times(across.out_of_plane, stretched[2]);
            rates[2] = times(across.hoop_rate, whole_now[2]);
        }
        if kind.dimension() + 1 == dimension {
            stretched[kind.dimension()] = times(across.thickness, stretched[kind.dimension()]);
        }
        let columns = |of: [[f64; 3]; 3]| -> Square<3> { std::array::from_fn(|i| std::array::from_fn(|j| of[j][i])) };
        let gradient = product(&columns(stretched), &inverse(&columns(whole_initial)));
        let rate = product(&columns(rates), &inverse(&columns(whole_now)));
        gradient.iter().flatten().all(|value| value.is_finite()).then_some(Self { gradient, rate })
    }
}

/// Gradients of the shape functions in the middle of the reference cell.
fn gradients(kind: CellKind) -> Option<Vec<[f64; 3]>> {
    let (places, dimension) = (kind.facts().reference, kind.dimension());
    if dimension == 0 || places.is_empty() {
        return None;
    }
    let middle = times(1.0 / places.len() as f64, places.iter().fold([0.0; 3], |sum, &place| plus(sum, place)));
    let mut g = [[0.0; 3]; 3];
    (dimension..3).for_each(|d| g[d][d] = 1.0);
    for place in places {
        let arm = minus(*place, middle);
        (0..dimension).for_each(|i| (0..dimension).for_each(|j| g[i][j] += arm[i] * arm[j]));
    }
    let inverse = inverse(&g);
    Some(places.iter().map(|&place| inverse.map(|row| dot(row, minus(place, middle)))).collect())
}

/// Tangents at the start and now, completed to three by unit vectors across them: of a line in 3D by two that
/// turn with it on the shortest way. In 2D the last one is z.
fn completed(dimension: usize, initial: &[[f64; 3]], now: &[[f64; 3]]) -> Option<[[[f64; 3]; 3]; 2]> {
    let z = [0.0, 0.0, 1.0];
    let unit = |v: [f64; 3]| Some(times(1.0 / length(v), v)).filter(|_| length(v) > 0.0);
    let complete = |tangents: &[[f64; 3]]| match (tangents, dimension) {
        (&[a, b, c], _) => Some([a, b, c]),
        (&[a, b], 2) => Some([a, b, z]),
        (&[a, b], _) => Some([a, b, unit(cross(a, b))?]),
        (&[a], 2) => Some([a, unit(cross(z, a))?, z]),
        _ => None,
    };
    if let (&[from], &[to], 3) = (initial, now, dimension) {
        let (from_unit, to_unit) = (unit(from)?, unit(to)?);
        let first = any_tangent(from_unit);
        let across = [first, cross(from_unit, first)];
        // R w = w − (t·w)/(1 + T·t) (T + t) for w across T.
        let cosine = dot(from_unit, to_unit);
        let turned = across.map(|w| {
            let factor = if cosine > -1.0 { dot(to_unit, w) / (1.0 + cosine) } else { 0.0 };
            minus(w, times(factor, plus(from_unit, to_unit)))
        });
        return Some([[from, across[0], across[1]], [to, turned[0], turned[1]]]);
    }
    Some([complete(initial)?, complete(now)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Of a motion x = A X + c of all nodes, F is A, for every kind of cell; with v = B x, L is B.
    #[test]
    fn a_homogeneous_motion_is_found_in_every_solid_cell() {
        let mut random = Random::apart(7);
        let mut number = || 2.0 * random.unit() - 1.0;
        for kind in CellKind::ALL.into_iter().filter(|kind| kind.dimension() >= 2) {
            let plane = kind.dimension() == 2;
            let mut matrix = |scale: f64| {
                let mut m: Square<3> = std::array::from_fn(|i| std::array::from_fn(|j| scale * number() + f64::from(u8::from(i == j))));
                if plane {
                    (m[0][2], m[1][2], m[2]) = (0.0, 0.0, [0.0, 0.0, 1.0]);
                }
                m
            };
            let (a, b) = (matrix(0.3), matrix(1.0));
            let apply = |m: &Square<3>, x: [f64; 3]| m.map(|row| dot(row, x));
            let nodes: Vec<[[f64; 3]; 3]> = kind
                .facts()
                .reference
                .iter()
                .map(|&x| {
                    let now = plus(apply(&a, x), [3.0, -2.0, 0.0]);
                    [x, now, apply(&b, now)]
                })
                .collect();
            let across = Across { thickness: 1.0, out_of_plane: 1.0, hoop_rate: b[2][2] };
            let found = Kinematics::new(kind, kind.dimension(), &nodes, across).unwrap();
            for (found, wanted) in [(found.gradient, a), (found.rate, b)] {
                for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
                    assert!((found - wanted).abs() < 1e-12, "{kind:?}: {found} for {wanted}");
                }
            }
        }
    }

    /// A sheet and a bar that are stretched and turned: F Fᵀ has the squares of their stretches.
    #[test]
    fn sheets_and_bars_stretch_along_themselves() {
        let (c, s) = (0.6, 0.8);
        let turned = |[x, y, z]: [f64; 3]| [c * x - s * z, y, s * x + c * z];
        let across = Across { thickness: 0.9, out_of_plane: 1.0, hoop_rate: 0.0 };
        let sheet = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let nodes: Vec<_> = sheet.iter().map(|&[x, y, z]| [[x, y, z], turned([1.2 * x, 1.1 * y, z]), [0.0; 3]]).collect();
        let f = Kinematics::new(CellKind::Quadrilateral, 3, &nodes, across).unwrap().gradient;
        // Columns are images of the axes.
        for (axis, stretch) in [1.2, 1.1, 0.9].into_iter().enumerate() {
            let wanted = times(stretch, turned(std::array::from_fn(|d| f64::from(u8::from(d == axis)))));
            (0..3).for_each(|d| assert!((f[d][axis] - wanted[d]).abs() < 1e-14, "{f:?}"));
        }
        let bar = [[[0.0; 3]; 3], [[0.0, 0.0, 2.0], turned([0.0, 0.0, 2.5]), [0.0; 3]]];
        let f = Kinematics::new(CellKind::Line, 3, &bar, across).unwrap().gradient;
        let b = product(&f, &std::array::from_fn(|i| std::array::from_fn(|j| f[j][i])));
        let t = turned([0.0, 0.0, 1.0]);
        for i in 0..3 {
            for j in 0..3 {
                let wanted = f64::from(u8::from(i == j)) + (1.5625 - 1.0) * t[i] * t[j];
                assert!((b[i][j] - wanted).abs() < 1e-14, "{b:?}");
            }
        }
    }
}
