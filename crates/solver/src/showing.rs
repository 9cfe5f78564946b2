//! A system as it is shown at an output time: positions and fields, in the user's order, piece by piece, so that a large model is never there a second time.
//!
//! What is shown is asked for by the writers of files ([`Shown`]), or put into a [`Frame`] as a whole; `record` knows which fields there are.

use crate::block::ElementState;
use crate::contact::traces::Tractions;
use crate::contact::traces::{State, Traces};
use crate::dimension::Dimension;
use crate::material::Variable;
use crate::mesh::ElementGroup;
use crate::output::{Field, FieldKind, Frame, Location, Shown};
use crate::step::System;
use crate::tensor::{Dim, von_mises};
use crate::vector::minus;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::OnceLock;

/// Most elements whose states are asked for at once.
const STATES: usize = 64;

/// A system at an output time. What several pieces are taken from is found when the first of them asks.
pub(crate) struct Showing<'a, const D: usize>
where
    Dim<D>: Dimension<D>,
{
    system: &'a System<D>,
    fields: &'a [&'static FieldKind],
    /// Node of each of the user's numbers.
    nodes: OnceLock<Vec<u32>>,
    /// Where each element is stored, in all groups one after the other, part by part by the user's numbers.
    elements: OnceLock<Vec<u32>>,
    /// Pressure and shear stress of the nodes, Pa; zero of those beyond.
    tractions: OnceLock<Vec<[f64; 2]>>,
    /// Of the nodes as far as any has a spring.
    states: OnceLock<Vec<State>>,
}

impl<'a, const D: usize> Showing<'a, D>
where
    Dim<D>: Dimension<D>,
{
    pub(crate) fn new(system: &'a System<D>, fields: &'a [&'static FieldKind]) -> Self {
        Self { system, fields, nodes: OnceLock::new(), elements: OnceLock::new(), tractions: OnceLock::new(), states: OnceLock::new() }
    }

    fn elements(&self) -> &[u32] {
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
            stored
        })
    }

    /// Values of nodes by the user's numbers.
    fn by_node<const N: usize>(&self, users: Range<usize>, values: &mut Vec<f64>, value: impl Fn(usize) -> [f64; N]) {
        let nodes = self.nodes.get_or_init(|| {
            let mut nodes = vec![0; self.system.mesh.user_nodes.len()];
            (0..).zip(&self.system.mesh.user_nodes).for_each(|(node, &user)| nodes[user as usize] = node);
            nodes
        });
        values.resize(N * users.len(), 0.0);
        values.as_chunks_mut().0.iter_mut().zip(&nodes[users]).for_each(|(own, &node)| *own = value(node as usize));
    }

    /// Values of one of the fields at nodes, by the user's numbers.
    fn of_nodes(&self, name: &str, users: Range<usize>, values: &mut Vec<f64>) {
        let (system, traces) = (self.system, &self.system.traces);
        let traction = |node: usize| {
            let of = || <Dim<D>>::tractions(traces, &system.contact_forces, &system.positions);
            self.tractions.get_or_init(of).get(node).copied().unwrap_or_default()
        };
        let state = |node: usize| {
            let of = || {
                Traces::states(&system.springs, system.mesh.user_nodes.len(), system.contacts.iter().flat_map(|contact| contact.inside()))
            };
            self.states.get_or_init(of).get(node).copied().unwrap_or(State::OPEN)
        };
        match name {
            "displacement" => self.by_node(users, values, |node| minus(system.positions[node], system.mesh.positions[node])),
            "velocity" => self.by_node(users, values, |node| self.system.velocity(node)),
            "contact_force" => self.by_node(users, values, |node| system.contact_forces.of(node)),
            "contact_pressure" => self.by_node(users, values, |node| [traction(node)[0]]),
            "contact_shear" => self.by_node(users, values, |node| [traction(node)[1]]),
            "contact_gap" => self.by_node(users, values, |node| [state(node).gap]),
            "contact_status" => self.by_node(users, values, |node| [state(node).status]),
            "contact_slip" => self.by_node(users, values, |node| [traces.slip(node)]),
            "friction_heat" => self.by_node(users, values, |node| [traces.heat(node)]),
            _ => values.clear(),
        }
    }

    /// Values of several fields of cells: each element is asked for its state once.
    fn of_cells(&self, cells: Range<usize>, columns: &mut [Column<'_>]) {
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
            for (at, (&element, state)) in (first..).zip(elements.iter().zip(&states)) {
                let alive = f64::from(u8::from(groups[own].is_alive(element as usize)));
                for Column { width, of_element, values } in &mut *columns {
                    of_element(state, alive, &mut values[*width * at..][..*width]);
                }
            }
            first += elements.len();
        }
    }
}

impl<const D: usize> Shown for Showing<'_, D>
where
    Dim<D>: Dimension<D>,
{
    fn time(&self) -> f64 {
        self.system.time
    }

    fn step(&self) -> u64 {
        self.system.step
    }

    fn dimension(&self) -> usize {
        D
    }

    fn nodes(&self) -> usize {
        self.system.mesh.user_nodes.len()
    }

    fn kinds(&self) -> Vec<&'static FieldKind> {
        self.fields.to_vec()
    }

    fn numbers(&self, field: usize) -> usize {
        let kind = self.fields[field];
        kind.width() * if kind.location == Location::Node { self.nodes() } else { self.elements().len() }
    }

    fn coordinates(&self, nodes: Range<usize>, values: &mut Vec<f64>) {
        self.by_node(nodes, values, |node| self.system.positions[node]);
    }

    fn values(&self, field: usize, places: Range<usize>, values: &mut Vec<f64>) {
        let kind = self.fields[field];
        match (kind.location, of_element(kind.name)) {
            (Location::Node, _) => self.of_nodes(kind.name, places, values),
            (Location::Cell, Some(of_element)) => {
                values.resize(kind.width() * places.len(), 0.0);
                self.of_cells(places, &mut [Column { width: kind.width(), of_element, values }]);
            }
            (Location::Cell, None) => values.clear(),
        }
    }

    fn outlined(&self) -> Cow<'_, Frame> {
        let mut frame = Frame { time: self.system.time, step: self.system.step, dimension: D, ..Frame::default() };
        frame.outlines.extend(self.system.outlines.iter().map(|outline| outline.now(&self.system.bodies)));
        if !frame.outlines.is_empty() {
            self.coordinates(0..self.nodes(), &mut frame.coordinates);
        }
        Cow::Owned(frame)
    }

    fn fill(&self, frame: &mut Frame) {
        (frame.time, frame.step, frame.dimension) = (self.system.time, self.system.step, D);
        self.coordinates(0..self.nodes(), &mut frame.coordinates);
        let mut spare = std::mem::take(&mut frame.fields).into_iter().map(|field| field.values);
        frame.fields = self.fields.iter().map(|&kind| Field { kind, values: spare.next().unwrap_or_default() }).collect();
        let mut columns = Vec::new();
        for Field { kind, values } in &mut frame.fields {
            match (kind.location, of_element(kind.name)) {
                (Location::Node, _) => self.of_nodes(kind.name, 0..self.nodes(), values),
                (Location::Cell, Some(of_element)) => {
                    values.resize(kind.width() * self.elements().len(), 0.0);
                    columns.push(Column { width: kind.width(), of_element, values });
                }
                (Location::Cell, None) => values.clear(),
            }
        }
        if !columns.is_empty() {
            self.of_cells(0..self.elements().len(), &mut columns);
        }
        frame.outlines.clear();
        frame.outlines.extend(self.system.outlines.iter().map(|outline| outline.now(&self.system.bodies)));
    }
}

/// Values of a field of cells, while they are made.
struct Column<'v> {
    /// Values of a cell.
    width: usize,
    of_element: OfElement,
    values: &'v mut [f64],
}

/// Takes the values of a field from the state of an element that is there (1) or eroded (0).
type OfElement = fn(&ElementState, f64, &mut [f64]);

/// How the values of one of [`FIELDS`] at the cells are made.
fn of_element(name: &str) -> Option<OfElement> {
    Some(match name {
        "stress" => |state, _, values| values.copy_from_slice(&state.stress[..values.len()]),
        "von_mises" => |state, _, values| values[0] = von_mises(&state.stress),
        "pressure" => |state, _, values| values[0] = -(state.stress[0] + state.stress[1] + state.stress[2]) / 3.0,
        "plastic_strain" => |state, _, values| values[0] = state.variables[Variable::PlasticStrain as usize],
        "density" => |state, _, values| values[0] = state.variables[Variable::Density as usize],
        "temperature" => |state, _, values| values[0] = state.variables[Variable::Temperature as usize],
        "damage" => |state, _, values| values[0] = state.variables[Variable::Damage as usize],
        "energy_density" => |state, _, values| values[0] = state.energy_density,
        "alive" => |_, alive, values| values[0] = alive,
        _ => return None,
    })
}
