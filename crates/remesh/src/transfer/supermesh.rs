//! Integrals over the pieces of two meshes.

use super::boundary::{Sliver, slivers};
use super::clip::{Cut, Piece, TURN, Twin, Vertex, pieces, twins};
use super::{Failure, Side};
use crate::plane::{Measure, Mesh};
use crate::shared::uncovered;

/// Integrals over what an old and a new triangle have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Overlap {
    pub(super) old: u32,
    pub(super) new: u32,
    /// ∫ N_a λ_j dV: N of the new triangle, λ of the old one.
    pub(super) mixed: [[f64; 3]; 3],
    /// ∫ N_a N_b dV.
    pub(super) own: [[f64; 3]; 3],
}

/// The overlaps of the cells of two meshes of the same region.
///
/// Both are cut into triangles, and these into pieces that belong to one of each. Of each piece the integrals
/// of products of the linear functions of both are kept, exact but for rounding. Old material outside the new
/// mesh, as where the chords of a curved outline differ, belongs to the nearest place of the new outline.
#[derive(Debug)]
pub struct Supermesh {
    pub(super) old: Vec<Twin>,
    pub(super) new: Vec<Twin>,
    pub(super) overlaps: Vec<Overlap>,
    pub(super) slivers: Vec<Sliver>,
    /// Volume of each old cell.
    pub(super) volumes: Vec<f64>,
    pub(super) new_cells: usize,
    pub(super) measure: Measure,
    missing: f64,
}

impl Supermesh {
    /// The overlaps of two meshes.
    ///
    /// # Errors
    /// `Size`, `Inverted`; `Uncovered` if less than half of a new cell has old material.
    pub fn new(old: Mesh<'_>, new: Mesh<'_>, measure: Measure) -> Result<Self, Failure> {
        let (old_twins, new_twins) = (twins(old, Cut::Four, Side::Old)?, twins(new, Cut::Four, Side::New)?);
        let whole: Vec<[f64; 3]> = old_twins.iter().map(|twin| twin.moments(measure)).collect();
        let volumes = cell_volumes(&old_twins, &whole, old.cells.len(), Side::Old)?;
        let new_moments: Vec<[f64; 3]> = new_twins.iter().map(|twin| twin.moments(measure)).collect();
        let new_volumes = cell_volumes(&new_twins, &new_moments, new.cells.len(), Side::New)?;
        let mut within = vec![[0.0; 3]; old_twins.len()];
        let mut covered = vec![0.0; new.cells.len()];
        let mut overlaps = Vec::with_capacity(8 * new_twins.len());
        pieces(&old_twins, &new_twins, |i, k, piece| {
            let (mixed, own) = products(piece, &old_twins[i], &new_twins[k], measure);
            let moment = |j: usize| mixed[0][j] + mixed[1][j] + mixed[2][j];
            let moments = [moment(0), moment(1), moment(2)];
            let volume = moments[0] + moments[1] + moments[2];
            if volume > 0.0 {
                (0..3).for_each(|j| within[i][j] += moments[j]);
                covered[new_twins[k].cell as usize] += volume;
                overlaps.push(Overlap { old: i as u32, new: k as u32, mixed, own });
            }
        });
        let missing = uncovered(&covered, &new_volumes)?;
        let slivers = slivers(&old_twins, &whole, &within, new).ok_or(Failure::Size)?;
        Ok(Self { old: old_twins, new: new_twins, overlaps, slivers, volumes, new_cells: new.cells.len(), measure, missing })
    }

    /// Number of pieces.
    #[must_use]
    pub fn pieces(&self) -> usize {
        self.overlaps.len()
    }

    /// Volume of the pieces, m³ (per metre of depth in 2D).
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.overlaps.iter().map(|overlap| overlap.own.iter().flatten().sum::<f64>()).sum()
    }

    /// Volume of old material outside the new mesh, and of the new mesh without old material, m³.
    #[must_use]
    pub fn mismatch(&self) -> [f64; 2] {
        [self.slivers.iter().map(|sliver| sliver.moments.iter().sum::<f64>()).sum(), self.missing]
    }
}

/// Volumes of cells from the moments of their triangles; `Inverted` if one is not positive, as at x < 0 in a
/// axisymmetric body.
pub(super) fn cell_volumes(twins: &[Twin], moments: &[[f64; 3]], cells: usize, side: Side) -> Result<Vec<f64>, Failure> {
    let mut volumes = vec![0.0; cells];
    for (twin, moments) in twins.iter().zip(moments) {
        volumes[twin.cell as usize] += moments[0] + moments[1] + moments[2];
    }
    match volumes.iter().position(|&volume| !(volume > 0.0)) {
        Some(cell) => Err(Failure::Inverted { side, cell }),
        None => Ok(volumes),
    }
}

/// Weights c_ij = ∫ μ_i μ_j dV of the vertices of a triangle with a given area and distances from the axis:
/// A (1 + δ_ij)/12 in 2D, of revolution 2πA/60 (W + x_i + x_j + δ_ij (W + 2 x_i)) with W = Σ x_i.
pub(super) fn weights(area: f64, x: [f64; 3], measure: Measure) -> [[f64; 3]; 3] {
    match measure {
        Measure::Plane => {
            let (same, other) = (area / 6.0, area / 12.0);
            [[same, other, other], [other, same, other], [other, other, same]]
        }
        Measure::Revolution => {
            let (scale, sum) = (TURN * area / 60.0, x[0] + x[1] + x[2]);
            let mut found = [[0.0; 3]; 3];
            for i in 0..3 {
                for j in 0..3 {
                    found[i][j] = scale * if i == j { 2.0 * sum + 4.0 * x[i] } else { sum + x[i] + x[j] };
                }
            }
            found
        }
    }
}

/// ∫ N_a λ_j dV and ∫ N_a N_b dV over a piece.
fn products(piece: &Piece, old: &Twin, new: &Twin, measure: Measure) -> ([[f64; 3]; 3], [[f64; 3]; 3]) {
    let (mut mixed, mut own) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    piece.fan(old, new, |[p, q, r], area| {
        let c = weights(area, [from_axis(p, old), from_axis(q, old), from_axis(r, old)], measure);
        for (row, vertex) in c.iter().zip([p, q, r]) {
            for k in 0..3 {
                let of_old = row[0] * p.old[k] + row[1] * q.old[k] + row[2] * r.old[k];
                let of_new = row[0] * p.new[k] + row[1] * q.new[k] + row[2] * r.new[k];
                for a in 0..3 {
                    mixed[a][k] += vertex.new[a] * of_old;
                    own[a][k] += vertex.new[a] * of_new;
                }
            }
        }
    });
    (mixed, own)
}

/// Distance of a vertex from the axis of revolution, m.
pub(super) fn from_axis(of: &Vertex, old: &Twin) -> f64 {
    of.old[0] * old.places[0][0] + of.old[1] * old.places[1][0] + of.old[2] * old.places[2][0]
}
