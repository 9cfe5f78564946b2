//! Where a node of a face in 3D is from its node of the middle: at half of the thickness from every smooth
//! piece around it.

use super::MITRE;
use crate::rotation::applied;
use crate::tensor::{Solid, SymmetricTensor};
use crate::vector::{dot, length, minus, plus, times};

/// Eigenvalues below this part of the largest bring nothing: pieces that are nearly parallel have no corner.
const FLAT: f64 = 0.03;
/// The same of two pieces that fold back on each other, which have one far away.
const FOLDED_BACK: f64 = 1e-9;
/// Cosine above which two directions are the same.
const SAME: f64 = 1.0 - 1e-9;
/// Cosine above which the foot of a wall runs along the piece that it stands on.
const ALONG: f64 = 0.99;

/// A smooth piece of a shell at one of its nodes: direction to one of its faces, and half of its thickness,
/// m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) to_face: [f64; 3],
    pub(super) half: f64,
}

/// Adds a piece, unless there is one with its direction.
pub(super) fn add(pieces: &mut Vec<Piece>, new: Piece) {
    if pieces.iter().all(|piece| dot(piece.to_face, new.to_face) < SAME) {
        pieces.push(new);
    }
}

/// Adds a piece that others stand on, unless they run along it.
pub(super) fn stand_on(pieces: &mut Vec<Piece>, ground: Piece) {
    if pieces.iter().all(|piece| dot(piece.to_face, ground.to_face).abs() < ALONG) {
        pieces.push(ground);
    }
}

/// The shortest arm that is at half of the thickness from all pieces, in the mean of squares; no longer than
/// [`MITRE`] halves.
pub(super) fn arm(pieces: &[Piece]) -> [f64; 3] {
    if let [one] = pieces {
        return times(one.half, one.to_face);
    }
    let (mut matrix, mut sum, mut farthest) = ([0.0; 6], [0.0; 3], 0.0f64);
    for piece in pieces {
        let d = piece.to_face;
        matrix = plus(matrix, [d[0] * d[0], d[1] * d[1], d[2] * d[2], d[0] * d[1], d[1] * d[2], d[2] * d[0]]);
        sum = plus(sum, times(piece.half, d));
        farthest = farthest.max(MITRE * piece.half);
    }
    let folds_back = matches!(pieces, [a, b] if dot(a.to_face, b.to_face) < 0.0);
    let (values, axes) = Solid(matrix).principal();
    let least = values.iter().copied().fold(0.0, f64::max) * if folds_back { FOLDED_BACK } else { FLAT };
    let mut arm = [0.0; 3];
    for (value, Solid([xx, yy, zz, xy, yz, zx])) in values.into_iter().zip(axes).filter(|(value, _)| *value > least) {
        arm = plus(arm, times(1.0 / value, applied(&[[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]], sum)));
    }
    let size = length(arm);
    if size > farthest { times(farthest / size, arm) } else { arm }
}

/// What of a vector is in a plane with a unit normal.
pub(super) fn within(vector: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    minus(vector, times(dot(vector, normal), normal))
}
