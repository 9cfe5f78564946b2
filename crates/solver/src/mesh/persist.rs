//! The mesh of a run whose cells are not those of its model any more, in an archive. The model gives all
//! other meshes.

use super::cell::CellKind;
use super::remeshed::RemeshedPart;
use super::surface::Corners;
use super::{Dim, ElementGroup, Mesh, Meshed, PartMesh, Pieces, SkinNode};
use crate::archive::{Archive, ArchiveError, ArchiveResult, Persist, Section, persist_all, persist_each};

/// The section of the state that has it.
const SECTION: &str = "mesh";

impl Persist for CellKind {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut number = Self::ALL.iter().position(|kind| kind == self).unwrap_or_default();
        number.persist(archive)?;
        *self = *Self::ALL.get(number).ok_or_else(|| ArchiveError::new("unknown kind of cell"))?;
        Ok(())
    }
}

persist_all!(PartMesh { name, nodes, faces });
persist_all!(Pieces { kind, firsts });

impl Persist for ElementGroup {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // The state of erosion has the elements that are gone.
        let Self { part, kind, connectivity, user_elements, outer, pieces, eroded: _ } = self;
        persist_each!(archive; part, kind, connectivity, user_elements, outer, pieces);
        Ok(())
    }
}

/// Places or vectors, number by number.
pub(super) fn persist_points<const D: usize>(points: &mut Vec<[f64; D]>, archive: &mut Archive<'_>) -> ArchiveResult {
    let mut numbers = std::mem::take(points).into_flattened();
    numbers.persist(archive)?;
    *points = numbers.as_chunks().0.to_vec();
    Ok(())
}

impl<const D: usize> Persist for Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self {
            positions,
            parts,
            groups,
            user_nodes,
            placed,
            revision,
            remeshed,
            skins,
            kin,
            joints,
            directions,
            thicknesses,
            outlines,
            sides,
            points,
            surfaces,
            sets,
        } = self;
        persist_points(positions, archive)?;
        persist_each!(archive; parts, groups, user_nodes, placed, revision, remeshed, thicknesses, outlines, sides, points, surfaces, sets);
        let mut owners: Vec<u32> = skins.iter().map(|skin| skin.owner).collect();
        let mut arms: Vec<[f64; D]> = skins.iter().map(|skin| skin.arm).collect();
        owners.persist(archive)?;
        persist_points(&mut arms, archive)?;
        *skins = owners.into_iter().zip(arms).map(|(owner, arm)| SkinNode { owner, arm }).collect();
        persist_each!(archive; kin, joints);
        let mut count = directions.len();
        count.persist(archive)?;
        archive.check(count <= groups.len(), "more groups of shells than groups")?;
        directions.resize(count, Vec::new());
        directions.iter_mut().try_for_each(|own| persist_points(own, archive))?;

        archive.check(self.is_sound(), "the mesh refers to nodes or parts that are not there")
    }
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// The mesh as a section of a state; nothing where it is that of the model.
    pub(crate) fn section(&mut self) -> Result<Vec<Section>, ArchiveError> {
        if self.revision == 0 {
            return Ok(Vec::new());
        }
        let mut archive = Archive::new();
        archive.section(SECTION)?;
        self.persist(&mut archive)?;
        archive.finish()
    }

    /// The mesh that a state begins with, unless it is that of the model, and the sections after it.
    pub(crate) fn of_state(sections: &[Section]) -> Result<(Option<Self>, &[Section]), ArchiveError> {
        let Some((first, rest)) = sections.split_first().filter(|(first, _)| first.name == SECTION) else {
            return Ok((None, sections));
        };
        let (mut archive, mut mesh) = (Archive::of(std::slice::from_ref(first)), Self::default());
        archive.section(SECTION)?;
        mesh.persist(&mut archive)?;
        archive.finish()?;
        Ok((Some(mesh), rest))
    }

    /// Whether all indices are those of something that is there, and each number of the user is given once.
    fn is_sound(&self) -> bool {
        let (nodes, parts) = (self.positions.len(), self.parts.len());
        let are_nodes = |all: &[u32]| all.iter().all(|&node| (node as usize) < nodes);
        let of_group = |group: &ElementGroup| {
            group.part < parts
                && group.connectivity.len() == group.kind.nodes() * group.elements()
                && are_nodes(&group.connectivity)
                && group.outer_is_sound()
                && are_nodes(&group.outer)
        };
        let is_numbered = |part: usize| is_permutation(self.groups_of(part).flat_map(|group| &group.user_elements), self.elements_of(part));
        [0, nodes].contains(&self.kin.len())
            && self.parts.iter().all(|part| are_nodes(&part.nodes) && are_nodes(&part.faces))
            && self.groups.iter().all(of_group)
            && (0..parts).all(is_numbered)
            && is_permutation(&self.user_nodes, nodes)
            && self.placed.iter().all(|place| place.is_sound(nodes, parts))
            && self.remeshed.parts.iter().all(|own| self.is_sound_again(own))
            && self.outlines.len() + self.skins.len() == nodes
            && self.skins.iter().all(|skin| (skin.owner as usize) < self.outlines.len())
            && self.sides.values().flatten().all(|facet| are_nodes(facet.corners()))
            && self.points.values().all(|points| are_nodes(points))
            && self.surfaces.values().flatten().all(|(_, facets)| facets.iter().all(|facet| are_nodes(facet.corners())))
            && self.sets.values().flatten().all(|(_, nodes)| are_nodes(nodes))
    }
}

impl<const D: usize> Mesh<D>
where
    Dim<D>: Meshed<D>,
{
    /// Whether what is known of a part that was made again is as much as it has nodes and elements.
    fn is_sound_again(&self, own: &RemeshedPart<D>) -> bool {
        self.parts.get(own.part).is_some_and(|part| {
            [own.places.len(), own.node_masses.len()] == [part.nodes.len(); 2] && own.masses.len() == self.elements_of(own.part)
        })
    }
}

impl ElementGroup {
    /// Whether its cells as bodies have them are as many as they have to be.
    fn outer_is_sound(&self) -> bool {
        let Pieces { kind, firsts } = &self.pieces;
        if firsts.is_empty() {
            return [0, self.kind.thickened().nodes() * self.elements()].contains(&self.outer.len());
        }
        firsts.len() == self.elements() + 1
            && firsts[0] == 0
            && firsts.is_sorted()
            && firsts.last().map(|&last| last as usize * kind.nodes()) == Some(self.outer.len())
    }
}

/// Whether numbers are those from 0 to below `count`, each once.
fn is_permutation<'a>(numbers: impl IntoIterator<Item = &'a u32>, count: usize) -> bool {
    let mut is_there = vec![false; count];
    let is_new = |&number: &u32| is_there.get_mut(number as usize).is_some_and(|is_there| !std::mem::replace(is_there, true));
    let found = numbers.into_iter().map(is_new).try_fold(0, |found, is_new| is_new.then_some(found + 1));
    found == Some(count)
}
