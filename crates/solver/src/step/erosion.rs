//! Erosion within a step: after the laws have answered, what fails is taken out of blocks, mesh, contacts and
//! loads, before anything moves.
//!
//! The elastic energy of an eroded element goes to the ledger as `eroded`. The element pulled until the step
//! before and pulls no more now; by the trapezoidal rule of the ledger half of its last pull, f^n·½ (x^n −
//! x^{n−1}), was never done on the nodes and stays in what is entered. Springs of contacts live in half
//! steps: what those of surfaces that are gone stored at n − ½, less what springs of the new surfaces store
//! there, is entered with it. So the drift does not see erosion.

use super::System;
use super::surface_springs::SurfaceSprings;
use crate::archive::{Archive, ArchiveError, ArchiveResult, Persist, persist_each};
use crate::block::{NodalForces, Report};
use crate::contact::rebuild::{ContactParts, ContactSource};
use crate::dimension::Dimension;
use crate::failure::{Criterion, by_name};
use crate::mesh::geometry::CellGeometry;
use crate::mesh::surface::{Corners, Facet};
use crate::model::in_3d;
use crate::reductions;
use crate::tensor::Dim;

/// What fails and what has failed.
pub(crate) struct Erosion<const D: usize>
where
    Dim<D>: Dimension<D>,
{
    /// Criteria of each block.
    criteria: Vec<Vec<Criterion>>,
    /// Makes contacts again.
    source: Box<dyn ContactSource<D>>,
    /// Energy that went with elements and springs, J/m.
    pub(crate) energy: f64,
    /// Blocks without elements.
    gone: Vec<bool>,
    pub(super) springs: SurfaceSprings,
    /// Elements by part, and what the first one was.
    pub(crate) by_part: Vec<usize>,
    pub(crate) first: Option<Eroded>,
}

/// An element that was eroded.
#[derive(Clone, Debug, PartialEq)]
pub struct Eroded {
    /// Its part.
    pub part: String,
    /// Its number in the part.
    pub element: usize,
    /// Mean of its nodes when it failed, m; in 2D z is zero.
    pub at: [f64; 3],
    /// When it failed, s.
    pub time: f64,
    /// By which criterion.
    pub criterion: &'static str,
}

/// What fails in a step: block, element, criterion.
type Failed = (usize, u32, &'static str);

impl<const D: usize> Erosion<D>
where
    Dim<D>: Dimension<D>,
{
    pub(crate) fn new(criteria: Vec<Vec<Criterion>>, source: Box<dyn ContactSource<D>>) -> Self {
        let gone = vec![false; criteria.len()];
        Self { criteria, source, energy: 0.0, gone, springs: SurfaceSprings::default(), by_part: Vec::new(), first: None }
    }

    /// Whether elements of a block may fail.
    pub(crate) fn may_fail(&self, block: usize) -> bool {
        self.criteria.get(block).is_some_and(|criteria| !criteria.is_empty())
    }

    pub(crate) fn is_gone(&self, block: usize) -> bool {
        self.gone.get(block).is_some_and(|&gone| gone)
    }
}

impl<const D: usize> Persist for Erosion<D>
where
    Dim<D>: Dimension<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { criteria: _, source: _, energy, gone, springs, by_part, first } = self;
        energy.persist(archive)?;
        gone[..].persist(archive)?;
        persist_each!(archive; springs, by_part);
        let mut reported =
            first.take().map(|Eroded { part, element, at, time, criterion }| (part, (criterion.to_string(), (element, (at, time)))));
        reported.persist(archive)?;
        *first = match reported {
            Some((part, (criterion, (element, (at, time))))) => {
                let criterion =
                    by_name(&criterion).ok_or_else(|| ArchiveError::new(format!("there is no criterion \"{criterion}\"")))?.limit.name;
                Some(Eroded { part, element, at, time, criterion })
            }
            None => None,
        };
        Ok(())
    }
}

impl<const D: usize> System<D>
where
    Dim<D>: Dimension<D>,
{
    /// Takes the elements that blocks have lost out of mesh, contacts and loads, as if they failed now: what
    /// is left of a state that was filled from outside.
    pub(super) fn remove_eroded_elements(&mut self) {
        let Some(mut erosion) = self.erosion.take() else { return };
        let mut is_any_gone = false;
        for (group, block) in self.mesh.groups.iter_mut().zip(&self.blocks) {
            for element in (0..block.elements()).filter(|&element| !block.is_alive(element)) {
                group.erode(element);
                is_any_gone = true;
            }
        }
        if is_any_gone {
            self.rebuild_surfaces(&mut erosion);
        }
        self.erosion = Some(erosion);
    }

    /// Takes out what fails. Returns what `elements` is without it.
    pub(super) fn erode(&mut self, elements: Report) -> Report {
        let Some(mut erosion) = self.erosion.take() else { return elements };
        let failed = self.failed(&erosion, elements.determinant <= 0.0);
        let elements = if failed.is_empty() {
            elements
        } else {
            erosion.by_part.resize(self.mesh.parts.len(), 0);
            for of_block in failed.chunk_by(|a, b| a.0 == b.0) {
                self.remove_elements(of_block, &mut erosion);
            }
            self.rebuild_surfaces(&mut erosion);
            self.joined_reports()
        };
        self.erosion = Some(erosion);
        elements
    }

    /// What fails, ascending by block and element. Where an element is `inverted`, all such ones fail that
    /// may fail for their step.
    fn failed(&self, erosion: &Erosion<D>, inverted: bool) -> Vec<Failed> {
        let mut failed = Vec::new();
        for (index, (block, criteria)) in self.blocks.iter().zip(&erosion.criteria).enumerate() {
            if criteria.is_empty() || erosion.gone[index] {
                continue;
            }
            let name = |criterion: u32| criteria[criterion as usize].kind.limit.name;
            let mut of_block: Vec<(u32, &'static str)> = block
                .failed(criteria, self.team.threads() > 1)
                .into_iter()
                .map(|(element, criterion)| (element, name(criterion)))
                .collect();
            let step = criteria.iter().map(|criterion| criterion.kind.limit.name).find(|name| *name == "time_step");
            if let Some(step) = step.filter(|_| inverted) {
                let is_inverted =
                    |&element: &u32| block.is_alive(element as usize) && !(block.determinant(element as usize, &self.positions) > 0.0);
                of_block.extend((0..block.elements() as u32).filter(is_inverted).map(|element| (element, step)));
                of_block.sort_by_key(|&(element, _)| element);
                of_block.dedup_by_key(|(element, _)| *element);
            }
            failed.extend(of_block.into_iter().map(|(element, name)| (index, element, name)));
        }
        failed
    }

    /// Takes elements out of their block and of the mesh.
    fn remove_elements(&mut self, failed: &[Failed], erosion: &mut Erosion<D>) {
        let index = failed[0].0;
        let first = self.blocks[..index].iter().map(|block| block.slots().len()).sum::<usize>();
        let slots = first..first + self.blocks[index].slots().len();
        let first = self.blocks[..index].iter().map(|block| block.moment_slots().len()).sum::<usize>();
        let moments = first..first + self.blocks[index].moment_slots().len();
        let numbers: Vec<u32> = failed.iter().map(|&(_, element, _)| element).collect();
        let group = &self.mesh.groups[index];
        for &(_, element, criterion) in failed {
            let mut work = 0.0;
            for (corner, &node) in group.nodes_of(element as usize).iter().enumerate() {
                let force = self.blocks[index].force(element as usize, corner, &self.slots[slots.clone()]);
                let [x, x_old] = [self.positions[node as usize], self.positions_old[node as usize]];
                for d in 0..D {
                    work += force[d] * (x[d] - x_old[d]);
                }
                if let Some(moment) = self.rotations.slots[moments.clone()].get(element as usize * group.kind.nodes() + corner) {
                    work += self.time_step_old * crate::vector::dot(*moment, self.rotations.now.spin(node));
                }
            }
            if work.is_finite() {
                erosion.energy += 0.5 * work;
            }
            erosion.first.get_or_insert_with(|| Eroded {
                part: self.mesh.parts[group.part].name.clone(),
                element: group.user_elements[element as usize] as usize,
                at: in_3d(self.centre(group.nodes_of(element as usize))),
                time: self.time,
                criterion,
            });
        }
        let part = group.part;
        erosion.by_part[part] += failed.len();
        let pulls = NodalForces { forces: &mut self.slots[slots], moments: &mut self.rotations.slots[moments] };
        erosion.energy += reductions::sum(self.blocks[index].erode(&numbers, pulls));
        for &element in &numbers {
            self.mesh.groups[index].erode(element as usize);
        }
        let block = &self.blocks[index];
        // How far those that are left have moved is no more than what all reported.
        let motion = self.reports[index].motion;
        self.reports[index] = Report { motion, ..block.report(&self.positions) };
        erosion.gone[index] = !(0..block.elements()).any(|element| block.is_alive(element));
    }

    /// Lets contacts, traces and loads see the surfaces that are left.
    fn rebuild_surfaces(&mut self, erosion: &mut Erosion<D>) {
        if self.rotations.has_loads() {
            let has_elements = self.mesh.has_elements();
            self.rotations.renew_loads(|node| has_elements[node as usize]);
        }
        if !(self.forces.is_empty() && self.cavities.is_empty()) {
            let has_elements = self.mesh.has_elements();
            let cells = self.mesh.groups.iter().filter(|group| group.is_body(D)).flat_map(|group| group.live_outer_cells());
            let mut backed: Vec<Facet<D>> = cells.flat_map(<Dim<D>>::cell_facets).collect();
            backed.sort_unstable();
            let is_backed = |facet: Facet<D>| backed.binary_search(&facet.canonical()).is_ok();
            self.forces.renew(|node| !has_elements[node as usize], is_backed);
            self.cavities.renew(self.time, is_backed);
        }
        if self.contacts.is_empty() {
            return;
        }
        // The outside of what was sound before stays sound with elements taken out of it.
        let outside = self.mesh.outside_without(&[], |segment| self.constraints.is_mirror(segment)).unwrap_or_default();
        self.traces.renew(outside, &self.mesh.positions);
        // Where elements were made again since the last step, springs are none yet, and their account is
        // open.
        if !self.remap.as_ref().is_some_and(|remap| remap.springs.is_open()) {
            erosion.springs.open(reductions::sum(self.contacts.iter().map(|contact| contact.stored(&self.springs))));
        }
        let parts =
            ContactParts { mesh: &mut self.mesh, constraints: &mut self.constraints, mass: &mut self.mass, bodies: &mut self.bodies };
        erosion.source.rebuild(parts, &mut self.contacts);
        self.find_free_nodes();
    }

    /// Whether all elements of a block are eroded.
    pub(super) fn is_gone(&self, block: usize) -> bool {
        self.erosion.as_ref().is_some_and(|erosion| erosion.is_gone(block))
    }

    /// Mass of nodes without elements, kg/m.
    pub(crate) fn mass_loose(&self) -> f64 {
        let has_elements = self.mesh.has_elements();
        let count = self.mesh.positions.len();
        reductions::sum(self.mass[..count].iter().zip(&has_elements).filter(|(_, has)| !**has).map(|(mass, _)| *mass))
    }
}
