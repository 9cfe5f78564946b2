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
use crate::mesh::cell::{Cell, CellKind};
use crate::mesh::surface::Corners;
use crate::mesh::surface::tributary::{Depth, Tributary};
use crate::model::{self, Model};
use crate::rigid::Body;
use crate::tensor::{Dim, Space, SymmetricTensor, cross, product};
use crate::vector::{dot, minus, plus, times};

impl World<3> for Dim<3> {
    const MOMENT: &[&str] = &["moment_x", "moment_y", "moment_z"];
    const MOTION: &[&str] = &["x", "y", "z", "vx", "vy", "vz", "spin_x", "spin_y", "spin_z"];

    fn facets(cell: Cell<'_>) -> Vec<[u32; 4]> {
        cell.faces().map(Corners::canonical).collect()
    }
    fn flatness(facet: [u32; 4], cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
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
    fn least_corner(cell: Cell<'_>, positions: &[[f64; 3]]) -> Option<f64> {
        let of = |(corner, others): (usize, [u8; 3])| {
            let [a, b, c] = edges(cell, corner, others, positions);
            dot(cross(a, b), c)
        };
        corners(cell.kind).map(of).fold(None, |least: Option<f64>, own| Some(least.unwrap_or(f64::INFINITY).min(own)))
    }
    fn shape(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        let Some(least) = Self::least_corner(cell, positions) else { return 1.0 };
        let all = corners(cell.kind).flat_map(|(corner, others)| edges(cell, corner, others, positions));
        let longest = all.map(|edge| dot(edge, edge)).fold(0.0, f64::max);
        least / (longest * longest.sqrt())
    }
    fn moment(arm: [f64; 3], force: [f64; 3]) -> [f64; 3] {
        cross(arm, force)
    }
    fn size(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
        size(cell, positions)
    }
    fn strains(cell: Cell<'_>, from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
        strains(cell, from, to)
    }
}

/// Volume enclosed by the facets, bilinear where they have four corners (the mean of both ways to halve them); of a line its length.
fn size(cell: Cell<'_>, positions: &[[f64; 3]]) -> f64 {
    let o = positions[cell.nodes[0] as usize];
    let x = |node: u32| minus(positions[node as usize], o);
    if cell.kind.dimension() == 1 {
        return dot(x(cell.nodes[1]), x(cell.nodes[1])).sqrt();
    }
    let wedge = |a: u32, b: u32, c: u32| dot(x(a), cross(x(b), x(c)));
    let facet = |[a, b, c, d]: [u32; 4]| 0.5 * (wedge(a, b, c) + wedge(a, c, d) + wedge(a, b, d) + wedge(b, c, d));
    cell.faces().map(facet).sum::<f64>() / 6.0
}

/// Three vectors that a cell carries with it: the edges of a tetrahedron at a corner, else means of opposite sides.
fn frame(cell: Cell<'_>, x: &[[f64; 3]]) -> Square<3> {
    let mean = |corners: &[u8]| {
        let sum = corners.iter().fold([0.0; 3], |sum, &corner| plus(sum, x[cell.nodes[usize::from(corner)] as usize]));
        sum.map(|component| component / corners.len() as f64)
    };
    let axes = cell.kind.facts().axes;
    std::array::from_fn(|k| axes.get(k).map_or([0.0; 3], |[from, to]| minus(mean(to), mean(from))))
}

/// See [`World::strains`].
fn strains(cell: Cell<'_>, from: &[[f64; 3]], to: &[[f64; 3]]) -> [f64; 2] {
    if cell.kind.dimension() == 1 {
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

/// A corner of a cell that is a volume and the other ends of its edges, right-handed; of a simplex one corner
/// says it all.
fn corners(kind: CellKind) -> impl Iterator<Item = (usize, [u8; 3])> + Clone {
    let is_simplex = kind.corners() == kind.dimension() + 1;
    let three = kind.facts().neighbours.iter().map_while(|neighbours| neighbours.first_chunk::<3>().copied());
    three.take(if is_simplex { 1 } else { kind.corners() }).enumerate()
}

/// The edges from a corner of a cell to `others`, m.
fn edges(cell: Cell<'_>, corner: usize, others: [u8; 3], positions: &[[f64; 3]]) -> [[f64; 3]; 3] {
    others.map(|other| minus(positions[cell.nodes[usize::from(other)] as usize], positions[cell.nodes[corner] as usize]))
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
        let cells: [(CellKind, &[u32], f64); 3] = [
            (CellKind::Hexahedron, &[0, 1, 2, 3, 4, 5, 6, 7], 6.0),
            (CellKind::Wedge, &[0, 1, 2, 4, 5, 6], 3.0),
            (CellKind::Tetrahedron, &[0, 1, 2, 4], 1.0),
        ];
        for (kind, nodes, volume) in cells {
            let cell = kind.cell(nodes);
            assert!((size(cell, &from) - volume).abs() < 1e-14 && (size(cell, &to) - 1.1 * volume).abs() < 1e-13);
            let [most, least] = strains(cell, &from, &to);
            assert!((most - 2f64.ln()).abs() < 1e-12 && (least + 2f64.ln()).abs() < 1e-12, "{most} {least}");
            assert!(<Dim<3>>::least_corner(cell, &from) > Some(0.0));
        }
    }
}
