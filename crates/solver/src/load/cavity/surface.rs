//! The closed surface of a cavity: what it encloses, and what a pressure in it pushes with.
//!
//! By the divergence theorem, with a linear field F whose divergence is 1,
//!
//! ```text
//! V = ∮ F·n dA = Σ_facets Σ_a F(x_a)·∫ N_a n dA,   ∂V/∂x_a = ∫ N_a n dA
//! ```
//!
//! exact for the facets as they are (n out of the gas; in 2D per metre of depth, of an axisymmetric model the
//! volume of revolution): what pushes at a node is the pressure times the gradient of the volume. Planes of
//! symmetry close the rims that lie on them. There F is chosen so that F·n = 0 on these planes: they
//! contribute nothing, wherever the rims are. Of F = B x + c with a symmetric B, n is then an eigenvector of
//! B; of those that are possible the one is taken that is nearest to zero (x/3 in 3D without planes).
//! Around an axis F = (r/2, 0), which planes across the axis close.

use crate::forest;
use crate::mesh::surface::tributary::{Depth, Tributary};
use crate::mesh::surface::{Corners, Facet};
use crate::mesh::{Meshed, extent};
use crate::rotation::{Square, applied};
use crate::tensor::Dim;
use crate::vector::{dot, length, minus, plus, times, unit};
use std::collections::BTreeMap;

/// Nodes of rims that are nearer to each other than this part of the surface's extent are at one place.
const SAME_PLACE: f64 = 1e-6;
/// Part of the area, and of the lengths, that counts as nothing.
const NOTHING: f64 = 1e-6;

/// A plane (in 2D: line) of symmetry.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plane<const D: usize> {
    pub(crate) point: [f64; D],
    pub(crate) normal: [f64; D],
    /// Nodes on it, ascending.
    pub(crate) nodes: Vec<u32>,
}

/// Why a surface encloses nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Open<const D: usize> {
    /// So many pieces of its rim, the first one here, on no plane of symmetry.
    Rim(usize, [f64; D]),
    /// Nothing closes it in this direction.
    Towards([f64; D]),
    /// Its rims are on planes of symmetry that have no field in common.
    Planes,
    /// It is seen from the wrong side: its volume.
    Outside(f64),
}

/// See the head of this file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Closed<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    facets: Vec<Facet<D>>,
    /// Its nodes, ascending, and the place of each corner of each facet among them.
    nodes: Vec<u32>,
    places: Vec<u32>,
    depth: Depth,
    /// F(x) = B (x − o) + c.
    matrix: Square<D>,
    origin: [f64; D],
    offset: [f64; D],
    /// ∂V/∂x of each node, m² (in 2D m).
    gradient: Vec<[f64; D]>,
    /// Bounds of the stiffness by which a pressure of 1 Pa on a surface that moves acts on each node, m.
    sway: Vec<f64>,
}

impl<const D: usize> Closed<D>
where
    Dim<D>: Tributary<D>,
{
    /// Of pieces of the outsides of bodies, which look into the gas; planes of symmetry may close it. With it
    /// comes its volume.
    ///
    /// # Errors
    /// It is not closed, or encloses what is not its inside.
    pub(crate) fn new(facets: Vec<Facet<D>>, positions: &[[f64; D]], planes: &[Plane<D>], depth: Depth) -> Result<(Self, f64), Open<D>> {
        let mut nodes: Vec<u32> = facets.iter().flat_map(|facet| facet.corners().to_vec()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let place = |node: &u32| nodes.binary_search(node).unwrap_or_default() as u32;
        let places = facets.iter().flat_map(|facet| facet.corners().iter().map(place).collect::<Vec<_>>()).collect();
        let origin = nodes.first().map_or([0.0; D], |&node| positions[node as usize]);
        let count = nodes.len();
        let mut surface = Self {
            facets,
            nodes,
            places,
            depth,
            matrix: [[0.0; D]; D],
            origin,
            offset: [0.0; D],
            gradient: vec![[0.0; D]; count],
            sway: vec![0.0; count],
        };
        let size = extent(&surface.nodes.iter().map(|&node| positions[node as usize]).collect::<Vec<_>>());
        let touched = surface.planes_at_rims(positions, planes, size)?;
        if depth == Depth::Revolution {
            surface.matrix[0][0] = 0.5;
            surface.origin = [0.0; D];
        } else {
            let closing = surface.closing(positions, planes, touched)?;
            (surface.matrix, surface.offset) = field(&closing, origin, size).ok_or(Open::Planes)?;
        }
        let volume = surface.measure(positions);
        let area: f64 = surface.gradient.iter().map(|&gradient| length(gradient)).sum();
        if volume > 1e-9 * NOTHING * area * size { Ok((surface, volume)) } else { Err(Open::Outside(volume)) }
    }

    /// The planes on which rims are.
    fn planes_at_rims(&self, positions: &[[f64; D]], planes: &[Plane<D>], size: f64) -> Result<Vec<usize>, Open<D>> {
        let mut open = self.rims(|node| node);
        if !open.is_empty() {
            let label = places_of(&open, positions, SAME_PLACE * size);
            open = self.rims(|node| label.get(&node).copied().unwrap_or(node));
        }
        let at_axis = |node: u32| self.depth == Depth::Revolution && positions[node as usize][0].abs() <= SAME_PLACE * size;
        let mut touched = vec![false; planes.len()];
        let mut loose = Vec::new();
        for edge in open.into_iter().filter(|edge| !edge.iter().all(|&node| at_axis(node))) {
            let mut is_closed = false;
            for (plane, touched) in planes.iter().zip(&mut touched) {
                if edge.iter().all(|node| plane.nodes.binary_search(node).is_ok()) {
                    (is_closed, *touched) = (true, true);
                }
            }
            loose.extend((!is_closed).then_some(edge));
        }
        match loose.first() {
            Some(&[a, b]) => {
                let middle = times(0.5, plus(positions[a as usize], positions[b as usize]));
                Err(Open::Rim(loose.len(), middle))
            }
            None => Ok((0..planes.len()).filter(|&plane| touched[plane]).collect()),
        }
    }

    /// Ends of segments, each twice, and edges of facets that have no partner on the other side.
    fn rims(&self, label: impl Fn(u32) -> u32) -> Vec<[u32; 2]> {
        let mut balance: BTreeMap<[u32; 2], ([u32; 2], i32)> = BTreeMap::new();
        let mut add = |a: u32, b: u32, sign: i32| {
            let (from, to) = (label(a), label(b));
            if D == 3 && from == to {
                return;
            }
            let (key, sign) = if from <= to { ([from, to], sign) } else { ([to, from], -sign) };
            balance.entry(key).or_insert(([a, b], 0)).1 += sign;
        };
        for facet in &self.facets {
            match facet.corners() {
                &[a, b] => {
                    add(a, a, -1);
                    add(b, b, 1);
                }
                corners => (0..corners.len()).for_each(|k| add(corners[k], corners[(k + 1) % corners.len()], 1)),
            }
        }
        balance.into_values().filter(|(_, balance)| *balance != 0).map(|(edge, _)| edge).collect()
    }

    /// The planes that close it: those at its rims, and one that it faces. Together with them it must be
    /// closed.
    fn closing<'a>(&mut self, positions: &[[f64; D]], planes: &'a [Plane<D>], touched: Vec<usize>) -> Result<Vec<&'a Plane<D>>, Open<D>> {
        self.measure(positions);
        let area: f64 = self.gradient.iter().map(|&gradient| length(gradient)).sum();
        let sum = self.gradient.iter().fold([0.0; D], |sum, &gradient| plus(sum, gradient));
        let mut closing: Vec<&Plane<D>> = touched.iter().map(|&plane| &planes[plane]).collect();
        let normals = basis(closing.iter().map(|plane| plane.normal));
        let left = normals.iter().fold(sum, |left, normal| minus(left, times(dot(left, *normal), *normal)));
        if length(left) <= NOTHING * area {
            return Ok(closing);
        }
        let outwards = unit(left).unwrap_or([0.0; D]);
        let height = |plane: &Plane<D>| dot(minus(self.origin, plane.point), outwards);
        let faces = |plane: &&Plane<D>| dot(plane.normal, outwards).abs() > 1.0 - NOTHING && height(plane) > 0.0;
        match planes.iter().filter(faces).min_by(|a, b| height(a).total_cmp(&height(b))) {
            Some(plane) => {
                closing.push(plane);
                Ok(closing)
            }
            None => Err(Open::Towards(times(-1.0, outwards))),
        }
    }

    /// Finds the gradient of the volume, and how it sways; returns the volume.
    pub(crate) fn measure(&mut self, positions: &[[f64; D]]) -> f64 {
        self.gradient.fill([0.0; D]);
        self.sway.fill(0.0);
        let (mut volume, mut first) = (0.0, 0);
        for &facet in &self.facets {
            let corners = facet.corners();
            let sway = sway(self.depth, corners, positions);
            let presses = <Dim<D>>::presses(self.depth, facet, positions);
            let places = &self.places[first..first + corners.len()];
            for ((&node, &place), &(inward, share)) in corners.iter().zip(places).zip(presses.as_ref()) {
                let push = times(share, inward);
                let field = plus(applied(&self.matrix, minus(positions[node as usize], self.origin)), self.offset);
                volume += dot(field, push);
                let gradient = &mut self.gradient[place as usize];
                *gradient = plus(*gradient, push);
                self.sway[place as usize] += sway;
            }
            first += corners.len();
        }
        volume
    }

    /// Its nodes, ascending, with the gradient of the volume and the bound of how it sways.
    pub(crate) fn gradient(&self) -> impl Iterator<Item = (u32, [f64; D], f64)> + '_ {
        self.nodes.iter().zip(&self.gradient).zip(&self.sway).map(|((&node, &gradient), &sway)| (node, gradient, sway))
    }

    /// Whether all its pieces are there still.
    pub(crate) fn is_whole(&self, is_outside: impl Fn(Facet<D>) -> bool) -> bool {
        self.facets.iter().all(|&facet| is_outside(facet))
    }
}

/// Bound of the norm of ∂(∫ N_a n dA)/∂x of one piece: 1 of a segment per metre of depth, 2π (r + l) of a
/// cone, half of the longest edge of a triangle, of a facet of four nodes the longest distance l of two
/// corners: with w = ∂δx/∂ξ × ∂x/∂η + ∂x/∂ξ × ∂δx/∂η the norm of all ∫ N_a w is at most that of w over the
/// facet, |∂x/∂ξ| is at most l/2, and the norm of ∂δx/∂ξ at most that of δx.
fn sway<const D: usize>(depth: Depth, corners: &[u32], positions: &[[f64; D]]) -> f64 {
    let places = || corners.iter().map(|&node| positions[node as usize]);
    let square = |a: [f64; D], b: [f64; D]| dot(minus(a, b), minus(a, b));
    let longest = places().enumerate().flat_map(|(k, a)| places().skip(k + 1).map(move |b| square(a, b))).fold(0.0, f64::max).sqrt();
    match (D, depth) {
        (2, Depth::Plane) => 1.0,
        (2, Depth::Revolution) => std::f64::consts::TAU * (places().fold(0.0, |most: f64, x| most.max(x[0].abs())) + longest),
        _ if corners.len() == 3 => 0.5 * longest,
        _ => longest,
    }
}

/// Nodes of edges that are at one place get one number.
fn places_of<const D: usize>(edges: &[[u32; 2]], positions: &[[f64; D]], near: f64) -> BTreeMap<u32, u32> {
    // Along a direction that surfaces are hardly across, so that few are beside each other.
    const ALONG: [f64; 3] = [0.7548, 0.5698, 0.3248];
    let along = |node: u32| (0..D).map(|d| ALONG[d] * positions[node as usize][d]).sum::<f64>();
    let mut nodes: Vec<(f64, u32)> = edges.iter().flatten().map(|&node| (along(node), node)).collect();
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    nodes.dedup();
    let mut root: Vec<u32> = (0..nodes.len() as u32).collect();
    for (at, &(height, node)) in nodes.iter().enumerate() {
        for (other, &(_, second)) in nodes.iter().enumerate().skip(at + 1).take_while(|(_, (other, _))| *other <= height + near) {
            if length(minus(positions[node as usize], positions[second as usize])) <= near {
                forest::join(&mut root, at as u32, other as u32);
            }
        }
    }
    (0..nodes.len()).map(|at| (nodes[at].1, nodes[forest::root(&mut root, at as u32) as usize].1)).collect()
}

/// An orthonormal basis of what these span.
fn basis<const N: usize>(vectors: impl Iterator<Item = [f64; N]>) -> Vec<[f64; N]> {
    let mut found: Vec<[f64; N]> = Vec::new();
    for vector in vectors {
        let size = length(vector);
        // Twice: what is left of the first time is round-off of the whole.
        let rest = (0..2).fold(vector, |rest, _| found.iter().fold(rest, |rest, one| minus(rest, times(dot(rest, *one), *one))));
        if length(rest) > 1e-9 * size {
            found.extend(unit(rest));
        }
    }
    found
}

/// B and c of the field F = B (x − o) + c nearest to zero whose divergence is 1 and which leads through none
/// of the planes; `None`: there is none. `size` is a length of the model, m.
///
/// Unknowns: the entries of B, the symmetry of which is required, and c/`size`.
fn field<const D: usize>(planes: &[&Plane<D>], origin: [f64; D], size: f64) -> Option<(Square<D>, [f64; D])> {
    const MOST: usize = 12;
    let matrix = |i: usize, j: usize| D * i + j;
    let mut rows: Vec<[f64; MOST]> = Vec::new();
    for i in 0..D {
        for j in 0..i {
            let mut row = [0.0; MOST];
            (row[matrix(i, j)], row[matrix(j, i)]) = (1.0, -1.0);
            rows.push(row);
        }
    }
    for Plane { point, normal, .. } in planes.iter().copied() {
        // n·B t = 0 along the plane, n·(B (p − o) + c) = 0 at a point of it.
        let place = times(1.0 / size, minus(*point, origin));
        let through = |direction: [f64; D], offset: f64| {
            let mut row = [0.0; MOST];
            for i in 0..D {
                (0..D).for_each(|j| row[matrix(i, j)] = normal[i] * direction[j]);
                row[D * D + i] = offset * normal[i];
            }
            row
        };
        for axis in crate::rotation::unit_matrix::<D>() {
            rows.push(through(minus(axis, times(dot(axis, *normal), *normal)), 0.0));
        }
        rows.push(through(place, 1.0));
    }
    let mut trace = [0.0; MOST];
    (0..D).for_each(|i| trace[matrix(i, i)] = 1.0);
    let held = basis(rows.into_iter());
    let free = (0..2).fold(trace, |free, _| held.iter().fold(free, |free, row| minus(free, times(dot(free, *row), *row))));
    let divergence = dot(free, trace);
    if divergence < 1e-6 {
        return None;
    }
    let found = times(1.0 / divergence, free);
    Some((std::array::from_fn(|i| std::array::from_fn(|j| found[matrix(i, j)])), std::array::from_fn(|i| size * found[D * D + i])))
}

#[cfg(test)]
mod tests;
