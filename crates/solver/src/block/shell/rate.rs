//! The strain of the layers of a shell in 3D with a law in rate form: the formulas of `surface.rs`, where
//! what is linear in the height comes from the mean and the difference of both ends of a step.

use super::surface::{Kind, Measures, by_height, times};
use super::{Facts, Strains, Tensor};
use crate::tensor::{Dim, Matrix, Plane, Space, SymmetricTensor, Turn};
use crate::vector::minus;
use embate_lanes::Lane;

/// ½ (a + b), and b − a.
#[inline(always)]
fn mean_and_step<L: Lane>(a: &Matrix<L, 2>, b: &Matrix<L, 2>) -> [Matrix<L, 2>; 2] {
    let half = L::splat(0.5);
    let (mut mean, mut step) = (*a, *a);
    for i in 0..2 {
        for k in 0..2 {
            mean[i][k] = half * (a[i][k] + b[i][k]);
            step[i][k] = b[i][k] - a[i][k];
        }
    }
    [mean, step]
}

/// Strains the layers over the way from `before` to `now`, and turns their stresses with the material.
#[inline(always)]
pub(super) fn strain<L: Lane>(facts: &Facts, kind: Kind<L>, [begin, before, now]: [&Measures<L>; 3], strains: &mut Strains<'_>, at: usize) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let live = L::load(strains.live, at);
    let there = L::splat(0.5).less(live);
    // All are there in most batches.
    let is_gone = L::any(live.less(L::splat(0.5)));
    let (thickness, initial) = (L::load(strains.thickness[0], at), L::load(strains.thickness[1], at));
    let change = minus(now.slide, before.slide);
    let ([map, map_step], [bend, bend_step]) = (mean_and_step(&before.map, &now.map), mean_and_step(&before.bend, &now.bend));
    let over = kind.shear / Dim::<2>::determinant(&map);
    let [[a, b], [c, d]] = Dim::<2>::adjugate(&map);
    let slip = times(&[[a, c], [b, d]], [over * change[0], over * change[1]]);
    let slip = [L::splat(0.25) * slip[0], L::splat(0.25) * slip[1]];
    let area = initial * L::splat(kind.area);
    for (p, (&height, &weight)) in facts.section.heights.iter().zip(&facts.section.weights).enumerate() {
        let z = L::splat(height) * thickness;
        let (middle, step) = (by_height(&map, &bend, z), by_height(&map_step, &bend_step, z));
        let determinant = Dim::<2>::determinant(&middle);
        let (gradient, turns) = Dim::<2>::displaced(&step, &Dim::<2>::adjugate(&middle), determinant);
        let flat = Dim::<2>::symmetric(&gradient).rotated(&turns[0]).0;
        // Half a turn: the mean of what it was and what it is.
        let whole = Dim::<2>::turned(slip, &turns);
        let mut strain = [flat[0], flat[1], zero, flat[3], slip[1] + whole[1], slip[0] + whole[0]];
        let own = &mut strains.stress[p * facts.components..][..facts.components];
        let old = Tensor::<3, L>::load(own, at).0;
        let in_plane = Plane([old[0], old[1], zero, old[3]]).rotated(&turns[1]).0;
        let across = Dim::<2>::turned([old[5], old[4]], &turns);
        let mut stress = [in_plane[0], in_plane[1], old[2], in_plane[3], across[1], across[0]];
        let mut volume = area * L::splat(weight) * determinant;
        if is_gone {
            // What is not there, or only fills the batch up, is not strained.
            for k in 0..6 {
                strain[k] = L::select(there, strain[k], zero);
                stress[k] = L::select(there, stress[k], old[k]);
            }
            volume = L::select(there, volume, zero);
        }
        for k in [0, 1, 3, 4, 5] {
            stress[k].store(&mut own[k], at);
        }
        let own = &mut strains.strain[p * facts.components..][..facts.components];
        for k in 0..6 {
            strain[k].store(&mut own[k], at);
        }
        volume.store(&mut strains.volume[p], at);
        let mut ratio = one;
        if facts.needs_ratio {
            let new = Dim::<2>::determinant(&by_height(&now.map, &now.bend, z));
            ratio = L::select(there, new / Dim::<2>::determinant(&by_height(&begin.map, &begin.bend, z)), one);
        }
        ratio.store(&mut strains.ratio[p], at);
        if !strains.rotation.is_empty() {
            let [cos, sin] = turns[0].0;
            let turn = <Matrix<L, 3> as Turn<L>>::about_z(L::select(there, cos, one), L::select(there, sin, zero));
            turn.store(&mut strains.rotation[p * 9..][..9], at);
        }
    }
}
