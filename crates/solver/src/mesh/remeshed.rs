//! A mesh in which the elements of a part have been made again in the run.
//!
//! Initial positions of the new nodes are those of the material that is there, so what the model says of
//! places, and displacements, keep their meaning. Elements begin where they were made: their form there is in
//! [`Remeshed`], with their masses. Nodes and elements of other parts keep their order.

use super::cell::CellKind;
use super::surface::Corners;
use super::{Dim, ElementGroup, Mesh, Meshed, order};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// No number.
pub(crate) const GONE: u32 = u32::MAX;

/// What is known of the parts that were made again; empty before.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Remeshed<const D: usize> {
    /// Limits of the run as they were at its start: the least step, s, and the largest velocity, m/s.
    pub(crate) limits: [f64; 2],
    /// Each part once.
    pub(crate) parts: Vec<RemeshedPart<D>>,
}

/// A part whose elements were made again.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RemeshedPart<const D: usize> {
    /// Its index.
    pub(crate) part: usize,
    /// Places of its nodes when its elements were made, in the order of its nodes, m.
    pub(crate) places: Vec<[f64; D]>,
    /// Mass of each element, kg/m (axisymmetric: kg).
    pub(crate) masses: Vec<f64>,
    /// How many elements it had at the start.
    pub(crate) elements_at_start: usize,
    /// Masses of its nodes, in their order, kg/m (kg).
    pub(crate) node_masses: Vec<f64>,
}

impl<const D: usize> Persist for RemeshedPart<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { part, places, masses, elements_at_start, node_masses } = self;
        persist_each!(archive; part, elements_at_start);
        super::persist::persist_points(places, archive)?;
        persist_each!(archive; masses, node_masses);
        Ok(())
    }
}

impl<const D: usize> Persist for Remeshed<D> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { limits, parts } = self;
        persist_each!(archive; limits, parts);
        Ok(())
    }
}

impl<const D: usize> Remeshed<D> {
    /// Whether no part was made again.
    pub(crate) fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// What is known of a part, if it was made again.
    pub(crate) fn of(&self, part: usize) -> Option<&RemeshedPart<D>> {
        self.parts.iter().find(|own| own.part == part)
    }
}

/// The elements of a part made again: nodes are numbered from 0 in it.
#[derive(Clone, Debug)]
pub(crate) struct NewPart<const D: usize>
where
    Dim<D>: Meshed<D>,
{
    /// Its index.
    pub(crate) part: usize,
    /// Its elements, kind by kind: the nodes of each.
    pub(crate) elements: Vec<(CellKind, Vec<u32>)>,
    /// Where its nodes are now, and where their material was at the start, m.
    pub(crate) places: Vec<[f64; D]>,
    pub(crate) initial: Vec<[f64; D]>,
    /// The old nodes that each node lies between: one where it is on it, those of a segment, those of an
    /// element.
    pub(crate) origins: Vec<Vec<u32>>,
    /// Pieces of its outline, each with the old one that it lies on.
    pub(crate) outline: Vec<(Piece<D>, Piece<D>)>,
}

impl<const D: usize> NewPart<D>
where
    Dim<D>: Meshed<D>,
{
    /// Its nodes along a curve of their own, and whether each is on an outline.
    fn along_curve(&self) -> Vec<(u32, bool)> {
        let mut is_outer = vec![false; self.places.len()];
        self.outline.iter().flat_map(|(own, _)| own.corners().to_vec()).for_each(|node| is_outer[node as usize] = true);
        order::along(&self.places).into_iter().map(|node| (node, is_outer[node as usize])).collect()
    }
}

/// A piece of an outline.
pub(crate) type Piece<const D: usize> = <Dim<D> as Meshed<D>>::Facet;

/// How the numbers of a mesh have changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Renumbered {
    /// New number of each old node; [`GONE`]: it is no more.
    pub(crate) of_old: Vec<u32>,
    /// Number of each node of the new part.
    pub(crate) of_new: Vec<u32>,
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Positions that elements are measured in, m: the initial ones, of parts that were made again those at
    /// that time.
    pub(crate) fn references(&self) -> Cow<'_, [[f64; D]]> {
        if self.remeshed.is_empty() {
            return Cow::Borrowed(&self.positions);
        }
        let mut positions = self.positions.clone();
        for own in &self.remeshed.parts {
            for (&node, &place) in self.parts[own.part].nodes.iter().zip(&own.places) {
                positions[node as usize] = place;
            }
        }
        Cow::Owned(positions)
    }

    /// The mesh with the elements of a part made again. Masses are not known yet; `limits` are those of
    /// [`Remeshed::limits`].
    pub(crate) fn with_new(&self, new: &NewPart<D>, limits: [f64; 2]) -> (Self, Renumbered) {
        let curve = new.along_curve();
        let numbers = self.renumbered(new, &curve);
        let mut mesh = self.clone();
        mesh.revision += 1;
        mesh.place_nodes(self, new, &curve, &numbers);
        mesh.name_pieces(new, &numbers);
        mesh.replace_elements(new, &numbers);
        mesh.remeshed.limits = limits;
        let elements_at_start = self.remeshed.of(new.part).map_or_else(|| self.elements_of(new.part), |own| own.elements_at_start);
        mesh.remeshed.parts.retain(|own| own.part != new.part);
        // Nodes of a part are in the order of their numbers.
        let mut nodes: Vec<(u32, [f64; D])> = numbers.of_new.iter().copied().zip(new.places.iter().copied()).collect();
        nodes.sort_unstable_by_key(|&(node, _)| node);
        mesh.parts[new.part].nodes = nodes.iter().map(|&(node, _)| node).collect();
        let places = nodes.into_iter().map(|(_, place)| place).collect();
        mesh.remeshed.parts.push(RemeshedPart { part: new.part, places, elements_at_start, ..RemeshedPart::default() });
        (mesh, numbers)
    }

    /// Of the nodes of a closed chain of an outline those where a named side, or a named set of nodes, begins
    /// or ends, or that have a name of their own.
    pub(crate) fn ends_of_names(&self, chain: &[u32]) -> Vec<bool> {
        let n = chain.len();
        let mut is_end = vec![false; n];
        let surfaces = self.surfaces.values().flatten().map(|(_, facets)| facets);
        for facets in self.sides.values().chain(surfaces) {
            let named: BTreeSet<Piece<D>> = facets.iter().map(|facet| facet.undirected()).collect();
            let is_named =
                |k: usize| Piece::<D>::of_cell(&[chain[k % n], chain[(k + 1) % n]]).is_some_and(|own| named.contains(&own.undirected()));
            (0..n).for_each(|k| is_end[k] |= is_named(k + n - 1) != is_named(k));
        }
        for nodes in self.points.values().chain(self.sets.values().flatten().map(|(_, nodes)| nodes)) {
            let is_named = |k: usize| nodes.binary_search(&chain[k % n]).is_ok();
            (0..n).for_each(|k| is_end[k] |= is_named(k) && !(is_named(k + n - 1) && is_named(k + 1)));
        }
        is_end
    }

    /// Numbers: those on outlines first, the others in their order, the new ones along a curve of their own
    /// behind them.
    fn renumbered(&self, new: &NewPart<D>, curve: &[(u32, bool)]) -> Renumbered {
        let mut is_gone = vec![false; self.positions.len()];
        self.parts[new.part].nodes.iter().for_each(|&node| is_gone[node as usize] = true);
        let flags: Vec<(usize, bool)> = self.along_curve().zip(self.outlines.iter().copied()).collect();
        let mut numbers = Renumbered { of_old: vec![GONE; is_gone.len()], of_new: vec![GONE; new.places.len()] };
        let mut next = 0;
        for wanted in [true, false] {
            for &(node, _) in flags.iter().filter(|&&(node, outer)| outer == wanted && !is_gone[node]) {
                numbers.of_old[node] = next;
                next += 1;
            }
            for &(node, _) in curve.iter().filter(|&&(_, outer)| outer == wanted) {
                numbers.of_new[node as usize] = next;
                next += 1;
            }
        }
        numbers
    }

    fn place_nodes(&mut self, old: &Self, new: &NewPart<D>, curve: &[(u32, bool)], numbers: &Renumbered) {
        let count = numbers.of_old.iter().filter(|&&node| node != GONE).count();
        self.positions = vec![[0.0; D]; count + new.places.len()];
        self.user_nodes = vec![0; self.positions.len()];
        // The user's numbers of what stays close up; new ones follow.
        let mut users: Vec<(u32, u32)> = old.user_nodes.iter().copied().zip(numbers.of_old.iter().copied()).collect();
        users.retain(|&(_, node)| node != GONE);
        users.sort_unstable();
        for (rank, &(_, node)) in (0..).zip(&users) {
            self.user_nodes[node as usize] = rank;
        }
        for placed in &mut self.placed {
            placed.close_up(|user| users.binary_search_by_key(&user, |&(user, _)| user).ok().map(|rank| rank as u32));
        }
        for (&place, &node) in old.positions.iter().zip(&numbers.of_old).filter(|(_, node)| **node != GONE) {
            self.positions[node as usize] = place;
        }
        for (local, (&place, &node)) in (0..).zip(new.initial.iter().zip(&numbers.of_new)) {
            self.positions[node as usize] = place;
            self.user_nodes[node as usize] = count as u32 + local;
        }
        let stays = old.along_curve().zip(&old.outlines).filter(|&(node, _)| numbers.of_old[node] != GONE);
        let kept: Vec<bool> = stays.map(|(_, &outer)| outer).collect();
        self.outlines = kept.into_iter().chain(curve.iter().map(|&(_, outer)| outer)).collect();
        for part in &mut self.parts {
            part.nodes.iter_mut().for_each(|node| *node = numbers.of_old[*node as usize]);
        }
    }

    /// Names of sides, points and groups: on the part of what they named there.
    fn name_pieces(&mut self, new: &NewPart<D>, numbers: &Renumbered) {
        let rename = |node: u32| numbers.of_old[node as usize];
        let surfaces = self.surfaces.values_mut().flatten().map(|(_, facets)| facets);
        for facets in self.sides.values_mut().chain(surfaces) {
            let named: BTreeMap<Piece<D>, Piece<D>> = facets.iter().map(|facet| (facet.undirected(), *facet)).collect();
            facets.retain(|facet| facet.corners().iter().all(|&node| rename(node) != GONE));
            facets.iter_mut().for_each(|facet| *facet = facet.renamed(rename).canonical());
            for (facet, old) in &new.outline {
                // In the direction that the name gives the old one.
                let Some(stored) = named.get(&old.undirected()) else { continue };
                let facet = if stored.canonical() == old.canonical() { *facet } else { facet.reversed() };
                facets.push(facet.renamed(|node| numbers.of_new[node as usize]).canonical());
            }
        }
        let sets = self.sets.values_mut().flatten().map(|(_, nodes)| nodes);
        for nodes in self.points.values_mut().chain(sets) {
            let named: BTreeSet<u32> = nodes.iter().copied().collect();
            nodes.iter_mut().for_each(|node| *node = rename(*node));
            nodes.retain(|&node| node != GONE);
            let own = new.origins.iter().zip(&numbers.of_new).filter(|(origin, _)| origin.iter().all(|node| named.contains(node)));
            nodes.extend(own.map(|(_, &node)| node));
            nodes.sort_unstable();
        }
    }

    fn replace_elements(&mut self, new: &NewPart<D>, numbers: &Renumbered) {
        for group in self.groups.iter_mut().filter(|group| group.part != new.part) {
            group.connectivity.iter_mut().for_each(|node| *node = numbers.of_old[*node as usize]);
        }
        let mut places = self.positions.clone();
        for (&node, &place) in numbers.of_new.iter().zip(&new.places) {
            places[node as usize] = place;
        }
        let at = self.groups.iter().position(|group| group.part == new.part).unwrap_or(self.groups.len());
        self.groups.retain(|group| group.part != new.part);
        let mut first = 0;
        let mut group = |(kind, connectivity): &(CellKind, Vec<u32>)| {
            let mut group = ElementGroup::new(new.part, *kind);
            let count = (connectivity.len() / kind.nodes()) as u32;
            group.connectivity = connectivity.iter().map(|&node| numbers.of_new[node as usize]).collect();
            group.user_elements = (first..first + count).collect();
            first += count;
            group.reorder(&places, false);
            group
        };
        let groups: Vec<ElementGroup> = new.elements.iter().map(&mut group).collect();
        self.groups.splice(at..at, groups);
    }
}
