//! Contact forces on nodes, stored sparsely in groups of eight nodes, since few nodes of a model have any.
//!
//! Solved springs add to them ([`crate::contact::Contact::collect`]); the velocity update, rigid bodies and
//! records read them. A step costs as much as there are nodes in contact.

use crate::archive::{Archive, ArchiveResult, Persist};
use embate_lanes::BATCH;

/// Forces of contacts and obstacles on nodes, N/m. Of a model without contacts there are none, not even of
/// zero: [`ContactForces::new`] of no nodes.
#[derive(Clone, Debug, Default)]
pub struct ContactForces<const D: usize> {
    /// As far as any node was pushed: nodes of surfaces come before the others.
    values: Vec<[f64; D]>,
    /// Number of nodes.
    nodes: usize,
    /// Whether any node of a group of eight was pushed in this step.
    marks: Vec<bool>,
    /// The groups that were.
    marked: Vec<u32>,
}

impl<const D: usize> Persist for ContactForces<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        if archive.reads() {
            self.clear();
        }
        let Self { values, nodes, marks, marked } = self;
        marked.persist(archive)?;
        for &mut group in marked {
            let group = group as usize;
            archive.check(group < marks.len(), "a contact force is nowhere")?;
            marks[group] = true;
            let end = grown(values, *nodes, group);
            values[group * BATCH..end].iter_mut().try_for_each(|force| force.persist(archive))?;
        }
        Ok(())
    }
}

impl<const D: usize> ContactForces<D> {
    /// None on so many nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self { values: Vec::new(), nodes, marks: vec![false; nodes.div_ceil(BATCH)], marked: Vec::new() }
    }

    /// Takes all forces away.
    pub fn clear(&mut self) {
        for group in self.marked.drain(..) {
            let first = group as usize * BATCH;
            let end = self.nodes.min(first + BATCH);
            self.values[first..end].fill([0.0; D]);
            self.marks[group as usize] = false;
        }
    }

    /// Pushes a node; `false`: there is no node of this number.
    #[inline]
    pub fn push(&mut self, node: u32, force: [f64; D]) -> bool {
        let (node, group) = (node as usize, node as usize / BATCH);
        if node >= self.nodes {
            return false;
        }
        if node >= self.values.len() {
            grown(&mut self.values, self.nodes, group);
        }
        (0..D).for_each(|d| self.values[node][d] += force[d]);
        if !std::mem::replace(&mut self.marks[group], true) {
            self.marked.push(group as u32);
        }
        true
    }

    /// That on a node; zero where there are none.
    #[inline]
    #[must_use]
    pub fn of(&self, node: usize) -> [f64; D] {
        self.values.get(node).copied().unwrap_or([0.0; D])
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Of each node as far as any was pushed, groups of [`BATCH`] as a whole.
    #[must_use]
    pub fn values(&self) -> &[[f64; D]] {
        &self.values
    }

    /// The groups of [`BATCH`] nodes in which any may have one.
    #[must_use]
    pub fn groups(&self) -> &[u32] {
        &self.marked
    }

    /// Whether any node of a group of [`BATCH`] may have one.
    #[inline]
    #[must_use]
    pub fn has(&self, group: usize) -> bool {
        self.marks.get(group).copied().unwrap_or(false)
    }
}

/// Lets the values of so many `nodes` reach to the end of a group, which is returned.
fn grown<const D: usize>(values: &mut Vec<[f64; D]>, nodes: usize, group: usize) -> usize {
    let end = nodes.min((group + 1) * BATCH);
    if end > values.len() {
        // Doubled, but never beyond what there can be.
        values.reserve_exact(end.max(2 * values.len()).min(nodes) - values.len());
        values.resize(end, [0.0; D]);
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_pushed_is_there_until_it_is_taken_away() {
        let mut forces = ContactForces::new(19);
        assert!(forces.nodes() == 19 && forces.values().is_empty(), "no room before it is needed");
        for round in 0..3 {
            assert!(forces.values().iter().all(|force| *force == [0.0; 2]) && !(0..4).any(|group| forces.has(group)), "{round}");
            assert!(forces.push(17, [1.0, 2.0]) && forces.push(17, [0.5, 0.0]) && forces.push(3, [0.0, 1.0]) && !forces.push(19, [1.0; 2]));
            assert_eq!([17, 3, 16, 19].map(|node| forces.of(node)), [[1.5, 2.0], [0.0, 1.0], [0.0; 2], [0.0; 2]]);
            assert_eq!([0, 1, 2, 3].map(|group| forces.has(group)), [true, false, true, false]);
            forces.clear();
        }
    }
}
