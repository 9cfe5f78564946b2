//! Rigid bodies that the springs of a large island push: their few velocities, solved after each sweep.
//!
//! While clusters are swept, what springs have added to the velocity of a body stays what it is: clusters do
//! not wait for each other. Then it follows, with what springs answer to it. With the rows r of the rates of
//! gap and slips on the bodies, forces F that fall by κ per rate of their own, mobilities M⁻¹, and what was
//! added so far, V, it changes by δ:
//!
//! (I + M⁻¹ Σ κ r rᵀ) δ = M⁻¹ Σ r F − V.
//!
//! Without Σ κ r rᵀ a body that is lighter than what it presses on would be thrown to and fro by its springs.
//! Springs come from [`super::block`], and the answers go to [`super::clusters`].

use super::block::Block;
use super::islands::NONE;
use super::link::{Joints, Laws, Movable, Row};
use super::{NodeResponses, TangentSpace, Tangential, friction};
use crate::rigid::RigidMotion;
use crate::tensor::Dim;

/// Most rigid bodies of an island that is solved so.
pub(super) const MOST: usize = 8;

/// A spring at a rigid body.
#[derive(Clone, Copy)]
pub(super) struct Grip<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Batch and lane of the spring.
    batch: u32,
    lane: u8,
    /// Number of the body among those of the island.
    body: u8,
    /// Rows of the gap and of the slips along each tangent.
    rows: [Row<D>; D],
}

/// What springs do to all bodies: forces Σ r F, and answers Σ κ r rᵀ.
#[derive(Default)]
pub(super) struct Pushes {
    forces: Vec<f64>,
    /// Row by row.
    answers: Vec<f64>,
}

impl Pushes {
    /// Nothing, for so many velocities.
    pub(super) fn clear(&mut self, freedoms: usize) {
        for (list, length) in [(&mut self.forces, freedoms), (&mut self.answers, freedoms * freedoms)] {
            list.clear();
            list.resize(length, 0.0);
        }
    }

    /// Adds those of other springs.
    pub(super) fn add(&mut self, other: &Self) {
        for (list, others) in [(&mut self.forces, &other.forces), (&mut self.answers, &other.answers)] {
            list.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        }
    }

    /// Adds a force (N) in a spring whose `grips` are these, along the axis of this number. It falls by
    /// `answer` with its rate, and by so much each along all axes what `follow`s it.
    pub(super) fn push<const D: usize>(&mut self, grips: &[Grip<D>], axis: usize, [force, answer]: [f64; 2], follow: &[f64; D])
    where
        Dim<D>: TangentSpace<D>,
    {
        let (count, all) = (Dim::<D>::FREEDOMS, self.forces.len());
        for one in grips {
            let first = count * usize::from(one.body);
            for i in 0..count {
                self.forces[first + i] += one.rows[axis][i] * force;
                let row: f64 = (0..D).map(|axis| follow[axis] * one.rows[axis][i]).sum();
                for other in grips {
                    let to = &mut self.answers[(first + i) * all + count * usize::from(other.body)..][..count];
                    to.iter_mut().zip(other.rows[axis].as_ref()).for_each(|(sum, other)| *sum += answer * row * other);
                }
            }
        }
    }
}

/// The rigid bodies of an island while it is solved.
#[derive(Default)]
pub(super) struct Velocities<const D: usize>
where
    Dim<D>: TangentSpace<D>,
{
    /// Place of each, ascending, and how it moves.
    pub(super) places: Vec<u32>,
    pub(super) movables: Vec<Movable<D>>,
    /// What springs have added to their velocities, in the order of the bodies.
    pub(super) added: Vec<f64>,
    /// Of all springs.
    pub(super) pushes: Pushes,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl<const D: usize> Velocities<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Takes the rigid bodies that springs move.
    pub(super) fn find<M: NodeResponses<D>>(&mut self, joints: &Joints<'_, M, D>, springs: &[u32]) {
        let nodes = joints.update.nodes.count();
        self.places.clear();
        for place in springs.iter().flat_map(|&number| joints.laws.list[number as usize].ends()).map(|k| joints.places[k]) {
            let is_body = joints.at[place as usize] as usize >= nodes && joints.slots[place as usize] != NONE;
            if is_body && let Err(at) = self.places.binary_search(&place) {
                self.places.insert(at, place);
            }
        }
    }

    /// The state of the step: nothing has been added yet.
    pub(super) fn begin<M: NodeResponses<D>>(&mut self, joints: &Joints<'_, M, D>) {
        self.movables.clear();
        let of = |&place: &u32| Movable::new(joints.at[place as usize], joints.update.nodes.count(), joints.update);
        self.movables.extend(self.places.iter().map(of));
        self.added.clear();
        self.added.resize(Dim::<D>::FREEDOMS * self.places.len(), 0.0);
    }

    /// Number of the body at a place.
    pub(super) fn body(&self, place: u32) -> Option<usize> {
        self.places.binary_search(&place).ok()
    }

    /// Takes over what the springs push with now: with their answers while they are solved, in the end as
    /// they are.
    pub(super) fn follow(&mut self, with_answers: bool) {
        let Self { movables, added, pushes, matrix, right, .. } = self;
        let (count, all) = (Dim::<D>::FREEDOMS, added.len());
        let moved = |body: usize, of: &dyn Fn(usize) -> f64| {
            let row = Dim::<D>::generalized(|i| of(count * body + i));
            Dim::<D>::response(&movables[body].mobility, &row)
        };
        right.clear();
        for body in 0..movables.len() {
            let velocity = moved(body, &|i| pushes.forces[i]);
            right.extend(velocity.as_ref().iter().zip(&added[count * body..]).map(|(new, old)| new - old));
        }
        if with_answers {
            matrix.clear();
            matrix.resize(all * all, 0.0);
            for column in 0..all {
                for body in 0..movables.len() {
                    let answer = moved(body, &|i| pushes.answers[i * all + column]);
                    for (i, value) in answer.as_ref().iter().enumerate() {
                        matrix[(count * body + i) * all + column] = *value;
                    }
                }
                matrix[column * all + column] += 1.0;
            }
            eliminate(matrix, right);
        }
        added.iter_mut().zip(&*right).for_each(|(added, change)| *added += change);
    }
}

impl<const D: usize> Block<D>
where
    Dim<D>: TangentSpace<D>,
{
    /// Springs at rigid bodies, and what these add to their rates without any force.
    pub(super) fn load_grips<M: NodeResponses<D> + Sync>(&mut self, joints: &Joints<'_, M, D>, bodies: &Velocities<D>) {
        self.grips.clear();
        if !self.has_grips {
            return;
        }
        let axes = if self.slides() { D } else { 1 };
        let Self { springs, at, arms, old, free, grips, .. } = self;
        for (number, first, [batch, lane]) in Self::in_lanes((springs, at), joints) {
            let (spring, begin) = (&joints.laws.list[number as usize], grips.len());
            let has_slip = !matches!(joints.laws.terms(number).tangential, Tangential::Free);
            let tangents = joints.laws.tangents(number);
            for (_, k) in arms[first..].iter().zip(spring.ends()).filter(|(arm, _)| **arm == NONE) {
                let Some(body) = bodies.body(joints.places[k]) else { continue };
                let (end, movable) = (joints.ends.get(k), &bodies.movables[body]);
                let slips = if has_slip { end.slip_rows(&tangents) } else { Default::default() };
                let row = |axis: usize| if axis == 0 { end.gap_row(spring.normal) } else { slips[axis - 1] };
                let rows: [_; D] = std::array::from_fn(|axis| movable.row(row(axis), &end));
                for axis in 0..axes {
                    old[batch][axis].0[lane] += Dim::<D>::dot(&rows[axis], &movable.velocity_old);
                    free[batch][axis].0[lane] += Dim::<D>::dot(&rows[axis], &movable.velocity_free);
                }
                match grips[begin..].iter_mut().find(|grip| usize::from(grip.body) == body) {
                    Some(grip) => {
                        let sum = |a: &Row<D>, b: &Row<D>| Dim::<D>::generalized(|i| a[i] + b[i]);
                        (0..D).for_each(|axis| grip.rows[axis] = sum(&grip.rows[axis], &rows[axis]));
                    }
                    None => grips.push(Grip { batch: batch as u32, lane: lane as u8, body: body as u8, rows }),
                }
            }
        }
    }

    /// Takes what springs have added to the velocities of rigid bodies.
    pub(super) fn lend(&mut self, added: &[f64]) {
        let (axes, count) = (if self.slides() { D } else { 1 }, Dim::<D>::FREEDOMS);
        self.lent.fill();
        for Grip { batch, lane, body, rows } in &self.grips {
            let velocity = Dim::<D>::generalized(|i| added[count * usize::from(*body) + i]);
            for axis in 0..axes {
                self.lent[*batch as usize][axis].0[usize::from(*lane)] += Dim::<D>::dot(&rows[axis], &velocity);
            }
        }
    }

    /// Sums up what its springs push rigid bodies with, of so many velocities.
    pub(super) fn push_bodies(&mut self, laws: &Laws<'_, D>, freedoms: usize) {
        let mut pushes = std::mem::take(&mut self.pushes);
        pushes.clear(freedoms);
        for grips in self.grips.chunk_by(|a, b| (a.batch, a.lane) == (b.batch, b.lane)) {
            let (batch, lane) = (grips[0].batch as usize, usize::from(grips[0].lane));
            let number = self.number(self.lanes[batch][lane]);
            let along = !matches!(laws.terms(number).tangential, Tangential::Free);
            let forces: [f64; D] = std::array::from_fn(|axis| if axis == 0 || along { self.forces[batch][axis].0[lane] } else { 0.0 });
            let slides = along && self.slides_at(laws, number, batch, lane);
            for axis in (0..D).filter(|&axis| forces[axis] != 0.0) {
                let mut follow = [0.0; D];
                follow[axis] = 1.0;
                let answer = match axis {
                    0 if slides => {
                        // Friction at its limit follows the normal force.
                        (1..D).for_each(|axis| follow[axis] = forces[axis] / forces[0]);
                        self.answer(laws, number, batch, lane)
                    }
                    0 => self.answer(laws, number, batch, lane),
                    _ if slides => 0.0,
                    _ => self.answer_along(laws, number, axis, batch, lane),
                };
                pushes.push(grips, axis, [forces[axis], answer], &follow);
            }
        }
        self.pushes = pushes;
    }

    /// By how much the normal force of a closed spring falls with the rate of its gap.
    fn answer(&self, laws: &Laws<'_, D>, number: u32, batch: usize, lane: usize) -> f64 {
        let (head, gaps) = (&self.heads[batch], &self.gaps[batch]);
        if head.linear[0].0[lane] <= head.linear[1].0[lane] {
            return head.terms[2].0[lane];
        }
        let patch = laws.list[number as usize].patch();
        let (stiffness, compliance) = (laws.terms(number).law.stiffness(&patch, gaps.old.0[lane]), gaps.compliance.0[lane]);
        let half = 0.5 * laws.time_steps[1];
        if stiffness.is_finite() {
            return half * stiffness / (2.0 + stiffness * compliance);
        }
        if compliance > 0.0 { half / compliance } else { 0.0 }
    }

    /// Whether friction of a spring is at its limit.
    fn slides_at(&self, laws: &Laws<'_, D>, number: u32, batch: usize, lane: usize) -> bool {
        matches!(laws.terms(number).tangential, Tangential::Friction(_)) && self.slid_at(batch, lane).1
    }

    /// By how much what sticks, or is tied, falls with its rate along a tangent.
    fn answer_along(&self, laws: &Laws<'_, D>, number: u32, axis: usize, batch: usize, lane: usize) -> f64 {
        let terms = laws.terms(number);
        let stiffness = terms.law.slip_stiffness(&laws.list[number as usize].patch());
        let softness = match terms.tangential {
            Tangential::Friction(_) => friction::softness(stiffness, laws.time_steps),
            _ => friction::tie_softness(stiffness, laws.time_steps),
        };
        let all = softness + self.own[batch][axis][axis].0[lane];
        if all > 0.0 { 1.0 / all } else { 0.0 }
    }
}

/// Solves a system of linear equations, `matrix` row by row, where there is a solution: Gauss's elimination
/// with the largest pivot of each column.
fn eliminate(matrix: &mut [f64], right: &mut [f64]) {
    let n = right.len();
    for column in 0..n {
        let size = |row: usize, matrix: &[f64]| matrix[row * n + column].abs();
        let pivot = (column..n).fold(column, |best, row| if size(row, matrix) > size(best, matrix) { row } else { best });
        if pivot != column {
            (0..n).for_each(|k| matrix.swap(column * n + k, pivot * n + k));
            right.swap(column, pivot);
        }
        for row in column + 1..n {
            let factor = matrix[row * n + column] / matrix[column * n + column];
            if factor != 0.0 {
                (column..n).for_each(|k| matrix[row * n + k] -= factor * matrix[column * n + k]);
                right[row] -= factor * right[column];
            }
        }
    }
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|k| matrix[row * n + k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row * n + row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::Random;

    #[test]
    fn systems_of_equations_are_solved() {
        let mut random = Random::new(7);
        for n in [1, 3, 6, 24] {
            for _ in 0..20 {
                let matrix: Vec<f64> = (0..n * n).map(|_| random.unit() - 0.5).collect();
                let right: Vec<f64> = (0..n).map(|_| random.unit()).collect();
                let (mut copy, mut found) = (matrix.clone(), right.clone());
                eliminate(&mut copy, &mut found);
                let size = found.iter().fold(1.0, |most, value| f64::max(most, value.abs()));
                for row in 0..n {
                    let sum: f64 = (0..n).map(|k| matrix[row * n + k] * found[k]).sum();
                    assert!((sum - right[row]).abs() < 1e-12 * size, "{n}: {sum} {}", right[row]);
                }
            }
        }
    }
}
