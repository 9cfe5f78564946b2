//! On which side of a plane a point lies, exactly, and never "on it": the signs from which everything else in
//! this folder follows.
//!
//! The determinant is Shewchuk's adaptive one (Discrete Comput. Geom. 18 (1997) 305-363, crate `robust`).
//! Where it vanishes, points are moved by infinitely small amounts that depend on their numbers alone:
//! simulation of simplicity (Edelsbrunner and Mücke, ACM Trans. Graph. 9 (1990) 66-104). So all answers about
//! the same points agree with each other, and a closed surface is never left or entered through a gap between
//! two of its triangles.

use robust::{Coord, Coord3D, orient2d, orient3d};

type Vector = [f64; 3];

/// A point, and the number by which ties are broken.
pub(super) type Point = (u32, Vector);

/// Six times the volume of the tetrahedron (a, b, c, d), (b − a) × (c − a)·(d − a), m³, as its sign is
/// exactly; where it is zero the smallest number with the sign of the perturbed volume. Positive: d is before
/// the triangle a, b, c, from where that is counter-clockwise. All four numbers differ.
pub(super) fn volume([a, b, c, d]: [Point; 4]) -> f64 {
    let of = |(_, [x, y, z]): Point| Coord3D { x, y, z };
    // Theirs is positive where the triangle is clockwise.
    let found = -orient3d(of(a), of(b), of(c), of(d));
    if found != 0.0 { found } else { f64::MIN_POSITIVE * perturbed([a, b, c, d]) }
}

/// Terms of the perturbed determinant in powers of ε, the largest first: which columns of each of the four
/// rows are perturbed, three bits a row. They are the products of perturbations in rows and columns that all
/// differ: twelve have one, 36 two, 24 three.
const TERMS: [u16; 72] = {
    let (mut terms, mut count, mut mask) = ([0; 72], 0, 1);
    while mask < 1 << 12 {
        if are_apart(mask) {
            terms[count] = mask;
            count += 1;
        }
        mask += 1;
    }
    assert!(count == terms.len());
    terms
};

/// Whether the perturbed columns of four rows all differ, none or one a row.
const fn are_apart(mask: u16) -> bool {
    let (mut row, mut used) = (0, 0);
    while row < 4 {
        let columns = mask >> (3 * row) & 7;
        if columns.count_ones() > 1 || columns & used != 0 {
            return false;
        }
        used |= columns;
        row += 1;
    }
    true
}

/// The sign of a vanishing volume after the perturbation: coordinate d of the point of rank r grows by
/// ε^(2^(3r + d)).
fn perturbed(mut points: [Point; 4]) -> f64 {
    let mut sign = 1.0;
    // Rows in the order of the numbers; a swap turns the sign.
    for i in 0..4 {
        for j in i + 1..4 {
            if points[j].0 < points[i].0 {
                points.swap(i, j);
                sign = -sign;
            }
        }
    }
    // The volume is minus the determinant of the rows (x, y, z, 1). Three perturbations leave a one.
    let first = TERMS.iter().map(|&mask| coefficient(&points, mask)).find(|term| *term != 0.0);
    first.map_or(sign, |term| -sign * term.signum())
}

/// Determinant (its sign) of the rows (x, y, z, 1) of points where those with a perturbed column are its unit
/// vector.
fn coefficient(points: &[Point; 4], mask: u16) -> f64 {
    let (mut rows, mut columns, mut size, mut sign) = ([0, 1, 2, 3], [0, 1, 2, 3], 4, 1.0);
    for row in 0..4 {
        let perturbed = mask >> (3 * row) & 7;
        if perturbed != 0 {
            let column = perturbed.trailing_zeros() as usize;
            let at = |left: &[usize; 4], one: usize| left[..size].iter().position(|other| *other == one).unwrap_or(0);
            let (i, j) = (at(&rows, row), at(&columns, column));
            sign *= if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
            rows.copy_within(i + 1..size, i);
            columns.copy_within(j + 1..size, j);
            size -= 1;
        }
    }
    // The last column left is that of ones.
    let at = |row: usize, k: usize| points[rows[row]].1[columns[k]];
    sign * match size {
        3 => {
            let of = |row: usize| Coord { x: at(row, 0), y: at(row, 1) };
            orient2d(of(0), of(1), of(2))
        }
        // A difference of two numbers has its exact sign.
        2 => at(0, 0) - at(1, 0),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The same determinant in whole numbers.
    fn exact(points: [[i64; 3]; 4]) -> i64 {
        let [a, b, c, d] = points;
        let minus = |p: [i64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
        let ([p, q, r], [s, t, u], [v, w, x]) = (minus(b), minus(c), minus(d));
        p * (t * x - u * w) - q * (s * x - u * v) + r * (s * w - t * v)
    }

    fn permutations() -> Vec<([usize; 4], f64)> {
        let mut all = Vec::new();
        for a in 0..4 {
            for b in 0..4 {
                for c in 0..4 {
                    let d = 6_usize.wrapping_sub(a + b + c);
                    let order = [a, b, c, d];
                    if d < 4 && (0..4).all(|k| order.contains(&k)) {
                        let swaps = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))).filter(|&(i, j)| order[j] < order[i]).count();
                        all.push((order, if swaps % 2 == 0 { 1.0 } else { -1.0 }));
                    }
                }
            }
        }
        all
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// On a small lattice nearly all are degenerate.
        #[test]
        fn signs_are_exact_turn_with_swaps_and_are_never_zero(points in prop::array::uniform4(prop::array::uniform3(-2..3_i64)), shift in 0..60_u32) {
            let size = f64::from(shift).exp2();
            let placed = [0, 1, 2, 3].map(|k| (7 * k as u32 % 5, points[k].map(|c| c as f64 * size)));
            let found = volume(placed);
            prop_assert!(found != 0.0);
            let whole = exact(points);
            if whole != 0 {
                prop_assert_eq!(found.signum(), whole.signum() as f64);
            }
            for (order, sign) in permutations() {
                prop_assert_eq!(volume(order.map(|k| placed[k])).signum(), sign * found.signum());
            }
        }

        /// A straight line leaves a closed surface as often as it enters it, through whatever corners and
        /// edges it goes: here a cube of lattice points.
        #[test]
        fn no_line_gets_lost_in_a_closed_surface(from in prop::array::uniform3(-2..4_i32), to in prop::array::uniform3(-2..4_i32), numbers in Just([0_u32, 1, 2, 3, 4, 5, 6, 7, 8, 9]).prop_shuffle()) {
            let corner = |k: u32| (numbers[k as usize], [f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)]);
            let squares: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
            let triangles = squares.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|t| t.map(corner));
            let (p, q) = ((numbers[8], from.map(f64::from)), (numbers[9], to.map(f64::from)));
            let mut sum = 0;
            for [a, b, c] in triangles {
                let (before, after) = (volume([a, b, c, p]) > 0.0, volume([a, b, c, q]) > 0.0);
                if before != after {
                    let sides = [[a, b], [b, c], [c, a]].map(|[x, y]| volume([p, q, x, y]) > 0.0);
                    if sides.iter().all(|side| *side == sides[0]) {
                        sum += if before { 1 } else { -1 };
                    }
                }
            }
            let is_outside = |x: [i32; 3]| x.iter().any(|c| !(0..=1).contains(c));
            prop_assert!(sum == 0 || !is_outside(from) || !is_outside(to), "{sum}");
            prop_assert!((-1..=1).contains(&sum));
        }
    }
}
