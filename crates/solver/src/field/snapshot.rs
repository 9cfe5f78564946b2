//! A system as it is shown at an output time: positions and fields, in the user's order, piece by piece, so
//! that a large model is never there a second time.
//!
//! `crate::snapshot` hands it to the writers; `record` knows which fields there are.

use super::kind::FieldKind;
use crate::block::ElementState;
use crate::contact::traces::{State, Traces, Tractions};
use crate::dimension::Dimension;
use crate::field::{Cell, Moving, NodeFields, OfCell, OfNode, Source};
use crate::mesh::ElementGroup;
use crate::mesh::geometry::CellGeometry;
use crate::mesh::kinematics::{Across, Kinematics};
use crate::model::in_3d;
use crate::rotation::applied;
use crate::skins::RotatedArm;
use crate::step::System;
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus, unit};
use std::ops::Range;
use std::sync::OnceLock;

/// Most elements whose states are asked for at once.
const STATES: usize = 64;

/// A system at an output time. What several pieces are taken from is found when the first of them asks.
pub(crate) struct LiveSnapshot<'a, const D: usize>
where
    Dim<D>: Dimension<D>,
{
    pub(crate) system: &'a System<D>,
    pub(crate) fields: &'a [&'static FieldKind],
    /// Node of each of the user's numbers.
    nodes: OnceLock<Vec<u32>>,
    /// Where the element of each cell is stored, in all groups one after the other, part by part by the
    /// user's numbers: beams have several cells.
    elements: OnceLock<Vec<u32>>,
    /// Pressure and shear stress of the nodes, Pa; zero of those beyond.
    tractions: OnceLock<Vec<[f64; 2]>>,
    /// Of the nodes as far as any has a spring.
    states: OnceLock<Vec<State>>,
    /// Of the nodes of shells' middles; zero of others.
    directors: OnceLock<Vec<[f64; D]>>,
}

impl<'a, const D: usize> LiveSnapshot<'a, D>
where
    Dim<D>: Dimension<D>,
{
    pub(crate) fn new(system: &'a System<D>, fields: &'a [&'static FieldKind]) -> Self {
        Self {
            system,
            fields,
            nodes: OnceLock::new(),
            elements: OnceLock::new(),
            tractions: OnceLock::new(),
            states: OnceLock::new(),
            directors: OnceLock::new(),
        }
    }

    pub(crate) fn elements(&self) -> &[u32] {
        self.elements.get_or_init(|| {
            let mesh = &self.system.mesh;
            let mut stored = vec![0; mesh.groups.iter().map(ElementGroup::elements).sum()];
            // Groups of a part follow each other and share its numbering.
            let (mut first, mut next, mut last) = (0, 0, None);
            let mut places = 0u32..;
            for group in &mesh.groups {
                if last != Some(group.part) {
                    (first, last) = (next, Some(group.part));
                    next += mesh.elements_of(group.part);
                }
                group.user_elements.iter().zip(&mut places).for_each(|(&user, place)| stored[first + user as usize] = place);
            }
            if mesh.groups.iter().any(|group| (0..group.elements()).any(|element| group.shown(element) > 1)) {
                let shown = |group: &ElementGroup| (0..group.elements()).map(|element| group.shown(element)).collect::<Vec<_>>();
                let counts: Vec<usize> = mesh.groups.iter().flat_map(shown).collect();
                stored = stored.into_iter().flat_map(|place| std::iter::repeat_n(place, counts[place as usize])).collect();
            }
            stored
        })
    }

    /// Pressure and shear stress of a node, Pa; zero where it is on no surface.
    pub(crate) fn traction(&self, node: usize) -> [f64; 2] {
        let system = self.system;
        let of = || <Dim<D>>::tractions(&system.traces, &system.contact_forces, &system.positions);
        self.tractions.get_or_init(of).get(node).copied().unwrap_or_default()
    }

    /// Gap and status of a node in contact.
    pub(crate) fn contact_state(&self, node: usize) -> State {
        let system = self.system;
        let of =
            || Traces::states(&system.springs, system.mesh.user_nodes.len(), system.contacts.iter().flat_map(|contact| contact.inside()));
        self.states.get_or_init(of).get(node).copied().unwrap_or(State::OPEN)
    }

    /// The direction normal to a shell at its node, of the middle or of a face; zero at others.
    pub(crate) fn director(&self, node: usize) -> [f64; D] {
        let mesh = &self.system.mesh;
        let middle = node.checked_sub(mesh.first_skin_node()).map_or(node, |face| mesh.skins[face].owner as usize);
        self.directors.get_or_init(|| directors(self.system))[middle]
    }

    /// Values of nodes by the user's numbers, `width` for each.
    pub(crate) fn by_node(&self, users: Range<usize>, width: usize, values: &mut Vec<f64>, value: impl Fn(usize, &mut [f64])) {
        let nodes = self.nodes.get_or_init(|| {
            let mut nodes = vec![0; self.system.mesh.user_nodes.len()];
            (0..).zip(&self.system.mesh.user_nodes).for_each(|(node, &user)| nodes[user as usize] = node);
            nodes
        });
        values.resize(width * users.len(), 0.0);
        values.chunks_exact_mut(width).zip(&nodes[users]).for_each(|(own, &node)| value(node as usize, own));
    }

    /// Makes the values of a field at nodes; of one at cells it makes room, and gives the column to fill.
    pub(crate) fn begin<'v>(&self, kind: &FieldKind, places: Range<usize>, values: &'v mut Vec<f64>) -> Option<Column<'v>>
    where
        Dim<D>: NodeFields<D>,
    {
        let width = kind.width();
        match kind.source {
            Source::Nodes(plane, space) => {
                let OfNode(of_node) = <Dim<D>>::of_node(plane, space);
                self.by_node(places, width, values, |node, own| of_node(self, node, own));
                None
            }
            Source::Cells(of_cell) => {
                values.resize(width * places.len(), 0.0);
                Some(Column { width, of_cell, values })
            }
        }
    }

    /// Values of several fields of cells: each element is asked for its state once.
    pub(crate) fn of_cells(&self, cells: Range<usize>, columns: &mut [Column<'_>]) {
        let (groups, blocks) = (&self.system.mesh.groups, &self.system.blocks);
        let mut states = [ElementState::default(); STATES];
        let mut elements = Vec::with_capacity(STATES);
        // The group of the cell before, and which of all elements it has.
        let (mut own, mut of_group) = (0, 0..0);
        let (stored, mut first) = (&self.elements()[cells], 0);
        while first < stored.len() {
            if !of_group.contains(&stored[first]) {
                (own, of_group) = (0, 0..groups[0].elements() as u32);
                while !of_group.contains(&stored[first]) {
                    own += 1;
                    of_group = of_group.end..of_group.end + groups[own].elements() as u32;
                }
            }
            let run = stored[first..].iter().take(STATES).take_while(|cell| of_group.contains(cell));
            elements.clear();
            elements.extend(run.map(|&cell| cell - of_group.start));
            blocks[own].states(&elements, &mut states[..elements.len()]);
            let cells: [Cell<'_>; STATES] = std::array::from_fn(|at| Cell {
                state: &states[at],
                is_alive: elements.get(at).is_some_and(|&element| groups[own].is_alive(element as usize)),
                place: (own, elements.get(at).map_or(0, |&element| element as usize)),
                within: self.system,
            });
            for Column { width, of_cell, values } in &mut *columns {
                let places = values[*width * first..][..*width * elements.len()].chunks_exact_mut(*width).zip(&cells);
                let index = of_cell.variable().and_then(|variable| blocks[own].index_of(variable));
                places.for_each(|(values, cell)| of_cell.write(cell, index, values));
            }
            first += elements.len();
        }
    }
}

impl<const D: usize> Moving for System<D>
where
    Dim<D>: Dimension<D>,
{
    fn kinematics(&self, (group, element): (usize, usize), state: &ElementState) -> Option<Kinematics> {
        let group = &self.mesh.groups[group];
        let nodes = group.nodes_of(element);
        let node = |&node: &u32| {
            let node = node as usize;
            [self.mesh.positions[node], self.positions[node], self.velocities[node]].map(in_3d)
        };
        let nodes: Vec<[[f64; 3]; 3]> = nodes.iter().map(node).collect();
        let mean = |which: usize| nodes.iter().map(|node| node[which][0]).sum::<f64>();
        let (mut out_of_plane, mut hoop_rate) = (1.0, 0.0);
        if self.of_revolution && mean(0) > 0.0 && mean(1) > 0.0 {
            (out_of_plane, hoop_rate) = (mean(1) / mean(0), mean(2) / mean(1));
        }
        Kinematics::new(group.kind, D, &nodes, Across { thickness: 1.0 - state.thinning, out_of_plane, hoop_rate })
    }

    fn quality(&self, (group, element): (usize, usize)) -> f64 {
        <Dim<D>>::shape_quality(self.mesh.groups[group].cell(element), &self.positions)
    }

    fn stable_step(&self, (group, element): (usize, usize)) -> f64 {
        let step = self.blocks[group].time_step_squared(element).sqrt();
        if self.rigid[group] || !step.is_finite() { 0.0 } else { step }
    }
}

/// Values of a field of cells, while they are made.
pub(crate) struct Column<'v> {
    /// Values of a cell.
    width: usize,
    of_cell: OfCell,
    values: &'v mut [f64],
}

/// The mean of the directors of the elements at each node of shells, where it is now; those that are turned
/// over against the first count the other way.
fn directors<const D: usize>(system: &System<D>) -> Vec<[f64; D]>
where
    Dim<D>: Dimension<D>,
{
    let (mesh, rotations) = (&system.mesh, &system.rotations.now);
    let mut sums = vec![[0.0; D]; mesh.positions.len()];
    for (group, own) in mesh.groups.iter().zip(&mesh.directions).filter(|(group, _)| !group.outer.is_empty()) {
        for (&node, &direction) in group.connectivity.iter().zip(own) {
            // In 2D it is the tangent that is known.
            let normal = if D == 2 { std::array::from_fn(|k| if k == 0 { -direction[1] } else { direction[0] }) } else { direction };
            let sum = &mut sums[node as usize];
            *sum = if dot(*sum, normal) < 0.0 { minus(*sum, normal) } else { plus(*sum, normal) };
        }
    }
    for (node, sum) in sums.iter_mut().enumerate().filter(|(_, sum)| **sum != [0.0; D]) {
        let now = rotations.place(node as u32).map_or(*sum, |place| applied(&<Dim<D>>::turn(rotations.numbers_at::<D>(place)), *sum));
        *sum = unit(now).unwrap_or([0.0; D]);
    }
    sums
}
