//! What space means for the system: rotations about any axis, cells are tetrahedra, wedges, hexahedra and lines.

use super::{Square, World, inverse, transposed};
use crate::angle::cos_sin;
use crate::build::Builder;
use crate::contact::Contact;
use crate::contact::springs::TangentSpace;
use crate::contact::traces::Traces;
use crate::contact_forces::ContactForces;
use crate::error::Fault;
use crate::mesh::Mesh;
use crate::mesh::surface::Corners;
use crate::mesh::surface::tributary::{Depth, Tributary};
use crate::model::{self, Model};
use crate::output::CellKind;
use crate::rigid::Body;
use crate::tensor::{Dim, Space, SymmetricTensor, cross, product};
use crate::vector::{dot, minus, plus, times};

impl World<3> for Dim<3> {
    const MOMENT: &[&str] = &["moment_x", "moment_y", "moment_z"];
    const MOTION: &[&str] = &["x", "y", "z", "vx", "vy", "vz", "spin_x", "spin_y", "spin_z"];

    fn facets(cell: &[u32]) -> Vec<[u32; 4]> {
        quadrilaterals(cell.len()).iter().map(|facet| facet.map(|corner| cell[corner]).canonical()).collect()
    }
    fn flatness(facet: [u32; 4], cell: &[u32], positions: &[[f64; 3]]) -> f64 {
        let areas = <Self as Tributary<3>>::shares(Depth::Plane, facet, positions);
        areas.into_iter().sum::<f64>() / size(cell, positions)
    }
    fn tractions(traces: &Traces<3>, forces: &ContactForces<3>, positions: &[[f64; 3]]) -> Vec<[f64; 2]> {
        traces.tractions(forces, positions)
    }
    fn moments(moment: &[f64; 3]) -> Vec<f64> {
        moment.to_vec()
    }
    fn motion(body: &Body<3>, before: f64) -> Vec<f64> {
        let velocity = (0..6).map(|k| body.velocity_old[k] + before * (body.velocity[k] - body.velocity_old[k]));
        body.centre.into_iter().chain(velocity).collect()
    }
    fn numbers(body: &Body<3>) -> Vec<f64> {
        body.centre.into_iter().chain(body.angle.0).chain(body.velocity).collect()
    }
    fn momenta(body: &Body<3>) -> (f64, [f64; 3], [f64; 3]) {
        let [u, v, w, ..] = body.velocity;
        (body.mass[..3].iter().copied().fold(0.0, f64::max), [u, v, w], body.turning.momentum)
    }
    /// No join turns what contacts see.
    fn image(turn: &Square<3>) -> <Self as TangentSpace<3>>::ImageRotation {
        *turn
    }
    fn with_axis(_: &Model, _: &Mesh<3>) -> Result<Option<Model>, Vec<Fault>> {
        Ok(None)
    }
    fn part_at_start(builder: &mut Builder<'_, 3>) -> Vec<String> {
        builder.part_at_start_in_space()
    }
    fn rigid_part(builder: &Builder<'_, 3>, index: usize, motion: &model::Motion, own: &[(u32, f64)]) -> Body<3> {
        builder.rigid_part_in_space(index, motion, own)
    }
    fn contacts(builder: &mut Builder<'_, 3>) -> Vec<Contact<3>> {
        builder.contacts_in_space()
    }
    fn obstacles(builder: &mut Builder<'_, 3>) -> Vec<Contact<3>> {
        builder.obstacles_in_space()
    }
    fn renew(builder: &mut Builder<'_, 3>, contacts: &mut [Contact<3>]) {
        builder.renew_in_space(contacts);
    }
    fn cell_kind(nodes: usize) -> CellKind {
        match nodes {
            2 => CellKind::Line,
            4 => CellKind::Tetrahedron,
            6 => CellKind::Wedge,
            _ => CellKind::Hexahedron,
        }
    }
    fn led(arm: [f64; 3], axis: [f64; 3], spin: f64, time_step: f64) -> [f64; 3] {
        let sweep = cross(axis, arm);
        if time_step == 0.0 {
            return times(spin, sweep);
        }
        let [[_, sin], [_, half]] = [time_step * spin, 0.5 * time_step * spin].map(cos_sin);
        let (along, around) = (-2.0 * half * half / time_step, sin / time_step);
        let arm = Self::across(arm, axis);
        std::array::from_fn(|d| along * arm[d] + around * sweep[d])
    }
    /// Rodrigues: R = cos I + sin (a ×) + (1 − cos) a aᵀ.
    fn rotation(axis: [f64; 3], angle: f64) -> Square<3> {
        let [cos, sin] = cos_sin(angle);
        let column = |d: usize| {
            let unit = std::array::from_fn(|k| if k == d { 1.0 } else { 0.0 });
            let (across, sweep) = (Self::across(unit, axis), cross(axis, unit));
            let along = minus(unit, across);
            std::array::from_fn(|k| cos * across[k] + sin * sweep[k] + along[k])
        };
        let columns: Square<3> = [0, 1, 2].map(column);
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
    }
    fn across(arm: [f64; 3], axis: [f64; 3]) -> [f64; 3] {
        minus(arm, times(dot(arm, axis), axis))
    }
    fn swept(spin: [f64; 3], arm: [f64; 3]) -> [f64; 3] {
        cross(spin, arm)
    }
    fn least_corner(cell: &[u32], positions: &[[f64; 3]]) -> Option<f64> {
        let corners = corners(cell.len());
        let of = |corner: usize| {
            let [a, b, c] = edges(cell, corner, corners[corner], positions);
            dot(cross(a, b), c)
        };
        (!corners.is_empty()).then(|| (0..corners.len()).map(of).fold(f64::INFINITY, f64::min))
    }
    fn shape(cell: &[u32], positions: &[[f64; 3]]) -> f64 {
        let Some(least) = Self::least_corner(cell, positions) else { return 1.0 };
        let all = corners(cell.len()).iter().enumerate().flat_map(|(corner, &others)| edges(cell, corner, others, positions));
        let longest = all.map(|edge| dot(edge, edge)).fold(0.0, f64::max);
        least / (longest * longest.sqrt())
    }
    fn moment(arm: [f64; 3], force: [f64; 3]) -> [f64; 3] {
        cross(arm, force)
    }
    fn size(cell: &[u32], positions: &[[f64; 3]]) -> f64 {
        size(cell, positions)
    }
    fn strains(cell: &[u32], from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
        strains(cell, from, to)
    }
}

/// Facets of a cell of so many nodes, outward by the right-hand rule; a triangle repeats its last corner. Empty: there is no such cell.
fn quadrilaterals(nodes: usize) -> &'static [[usize; 4]] {
    match nodes {
        4 => &[[0, 2, 1, 1], [0, 1, 3, 3], [1, 2, 3, 3], [2, 0, 3, 3]],
        6 => &[[0, 2, 1, 1], [3, 4, 5, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
        8 => &[[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
        _ => &[],
    }
}

/// Volume enclosed by the facets, bilinear where they have four corners (the mean of both ways to halve them); of a line its length.
fn size(cell: &[u32], positions: &[[f64; 3]]) -> f64 {
    let o = positions[cell[0] as usize];
    let x = |corner: usize| minus(positions[cell[corner] as usize], o);
    if cell.len() == 2 {
        return dot(x(1), x(1)).sqrt();
    }
    let wedge = |a: usize, b: usize, c: usize| dot(x(a), cross(x(b), x(c)));
    let facet = |&[a, b, c, d]: &[usize; 4]| 0.5 * (wedge(a, b, c) + wedge(a, c, d) + wedge(a, b, d) + wedge(b, c, d));
    quadrilaterals(cell.len()).iter().map(facet).sum::<f64>() / 6.0
}

/// Three vectors that a cell carries with it: the edges of a tetrahedron at a corner, else means of opposite sides.
fn frame(cell: &[u32], x: &[[f64; 3]]) -> Square<3> {
    let mean = |corners: &[usize]| {
        let sum = corners.iter().fold([0.0; 3], |sum, &corner| plus(sum, x[cell[corner] as usize]));
        sum.map(|component| component / corners.len() as f64)
    };
    let between = |[from, to]: [&[usize]; 2]| minus(mean(to), mean(from));
    match cell.len() {
        4 => [[&[0][..], &[1]], [&[0], &[2]], [&[0], &[3]]].map(between),
        6 => [[&[0, 3][..], &[1, 4]], [&[0, 3], &[2, 5]], [&[0, 1, 2], &[3, 4, 5]]].map(between),
        _ => [[&[0, 3, 4, 7][..], &[1, 2, 5, 6]], [&[0, 1, 4, 5], &[2, 3, 6, 7]], [&[0, 1, 2, 3], &[4, 5, 6, 7]]].map(between),
    }
}

/// See [`World::strains`].
fn strains(cell: &[u32], from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
    if cell.len() == 2 {
        return [(size(cell, to) / size(cell, from)).ln(); 2];
    }
    // Rows of both are the vectors: F maps those at the start to those now.
    let (start, now) = (frame(cell, from), frame(cell, to));
    let f = product(&transposed(&now), &inverse(&transposed(&start)));
    let (squares, _) = <Dim<3> as Space<3>>::left_cauchy_green(&f, 1.0).principal();
    let most = squares.into_iter().fold(0.0, f64::max);
    let least = squares.into_iter().fold(f64::INFINITY, f64::min);
    [0.5 * most.ln(), 0.5 * least.max(0.0).ln()]
}

/// The three other ends of the edges at each corner of a cell of so many nodes, right-handed; of a tetrahedron one corner says it all. Empty: there is no such cell.
fn corners(nodes: usize) -> &'static [[usize; 3]] {
    match nodes {
        4 => &[[1, 2, 3]],
        6 => &[[1, 2, 3], [2, 0, 4], [0, 1, 5], [5, 4, 0], [3, 5, 1], [4, 3, 2]],
        8 => &[[1, 3, 4], [2, 0, 5], [3, 1, 6], [0, 2, 7], [7, 5, 0], [4, 6, 1], [5, 7, 2], [6, 4, 3]],
        _ => &[],
    }
}

/// The edges from a corner of a cell to `others`, m.
fn edges(cell: &[u32], corner: usize, others: [usize; 3], positions: &[[f64; 3]]) -> [[f64; 3]; 3] {
    others.map(|other| minus(positions[cell[other] as usize], positions[cell[corner] as usize]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::{applied, axis};

    #[test]
    fn size_and_strains_are_those_of_the_stretch_whatever_the_rotation() {
        let from: Vec<[f64; 3]> = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 3.0],
            [2.0, 0.0, 3.0],
            [2.0, 1.0, 3.0],
            [0.0, 1.0, 3.0],
        ]
        .into();
        let turn = <Dim<3>>::rotation(axis([1.0, -2.0, 0.5]), 1.1);
        let to: Vec<[f64; 3]> = from.iter().map(|[x, y, z]| applied(&turn, [2.0 * x, 0.5 * y, 1.1 * z])).collect();
        for (cell, volume) in [(&[0, 1, 2, 3, 4, 5, 6, 7][..], 6.0), (&[0, 1, 2, 4, 5, 6], 3.0), (&[0, 1, 2, 4], 1.0)] {
            assert!((size(cell, &from) - volume).abs() < 1e-14 && (size(cell, &to) - 1.1 * volume).abs() < 1e-13);
            let [most, least] = strains(cell, &from, &to);
            assert!((most - 2f64.ln()).abs() < 1e-12 && (least + 2f64.ln()).abs() < 1e-12, "{most} {least}");
            assert!(<Dim<3>>::least_corner(cell, &from) > Some(0.0));
        }
    }
}
