//! Values of fields at the nodes and elements of a probe.
//!
//! Of fields of elements these are the values of elements, or those of nodes: the mean of the elements e at a
//! node n, u_n = Σ V_e u_e / Σ V_e, with their volumes at the start (of shells the areas, of beams and bars
//! the lengths). Of a set they are a weighted mean over elements or nodes, or an extreme, which has a place:
//! that of its node, or the middle of its element.

use crate::dimension::Dimension;
use crate::field::kind::FieldKind;
use crate::field::snapshot::LiveSnapshot;
use crate::field::{Cell, NodeFields, OfCell, OfNode, Source};
use crate::mesh::geometry::CellGeometry;
use crate::mesh::{ElementGroup, Mesh};
use crate::model::{Extreme, Position};
use crate::rows::Rows;
use crate::tensor::Dim;

/// What a probe makes of the values of a field.
pub(super) struct Values {
    pub(super) extreme: Option<Extreme>,
    /// Whether the places of extremes are written.
    pub(super) has_place: bool,
    pub(super) elements: Elements,
}

/// Elements of whose fields a probe has values.
#[derive(Default)]
pub(super) struct Elements {
    /// Group, number in it, and weight: of a mean over elements, where the weights sum to one; where values
    /// are those of nodes their size.
    list: Vec<(usize, u32, f64)>,
    /// By node of the probe its elements, by their places in the list; none: values are those of elements.
    at_nodes: Option<Rows<u32>>,
}

impl Elements {
    /// A single one: its group and its number in that.
    pub(super) fn one((group, element): (usize, u32)) -> Self {
        Self { list: vec![(group, element, 1.0)], at_nodes: None }
    }

    /// Group of the first.
    pub(super) fn first(&self) -> Option<usize> {
        self.list.first().map(|it| it.0)
    }

    /// Those at weighted nodes, of a part or of all parts.
    pub(super) fn at<const D: usize>(mesh: &Mesh<D>, part: Option<&String>, nodes: &[(u32, f64)], position: Position) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        match position {
            Position::Element => Self { list: shared(mesh, part, nodes), at_nodes: None },
            Position::Node => Self::by_node(mesh, part, nodes),
        }
    }

    fn by_node<const D: usize>(mesh: &Mesh<D>, part: Option<&String>, nodes: &[(u32, f64)]) -> Self
    where
        Dim<D>: Dimension<D>,
    {
        let mut places = vec![u32::MAX; mesh.positions.len()];
        (0..).zip(nodes).for_each(|(place, &(node, _))| places[mesh.leader_of(node) as usize] = place);
        let (mut list, mut pairs) = (Vec::new(), Vec::new());
        for (place, element, cell) in cells(mesh, part) {
            let at = cell.iter().map(|&node| places[node as usize]).filter(|&at| at != u32::MAX);
            let before = pairs.len();
            pairs.extend(at.map(|at| (at, list.len() as u32)));
            if pairs.len() > before {
                let size = <Dim<D> as CellGeometry<D>>::size(mesh.groups[place].cell(element), &mesh.positions);
                list.push((place, element as u32, size));
            }
        }
        Self { list, at_nodes: Some(Rows::new(nodes.len(), pairs.iter().copied())) }
    }
}

/// Cells of a part or of all: group, number in it, nodes.
fn cells<'a, const D: usize>(mesh: &'a Mesh<D>, part: Option<&'a String>) -> impl Iterator<Item = (usize, usize, &'a [u32])>
where
    Dim<D>: Dimension<D>,
{
    let own = move |group: &ElementGroup| part.is_none_or(|name| mesh.parts[group.part].name == *name);
    let own = mesh.groups.iter().enumerate().filter(move |(_, group)| own(group));
    own.flat_map(|(place, group)| (0..group.elements()).map(move |element| (place, element, group.nodes_of(element))))
}

/// Elements at weighted nodes: each node shares its weight out to its elements alike.
fn shared<const D: usize>(mesh: &Mesh<D>, part: Option<&String>, nodes: &[(u32, f64)]) -> Vec<(usize, u32, f64)>
where
    Dim<D>: Dimension<D>,
{
    let mut weights = vec![0.0; mesh.positions.len()];
    nodes.iter().for_each(|&(node, weight)| weights[mesh.leader_of(node) as usize] += weight);
    let mut counts = vec![0.0; mesh.positions.len()];
    cells(mesh, part).flat_map(|(_, _, nodes)| nodes).for_each(|&node| counts[node as usize] += 1.0);
    let share = |&node: &u32| weights[node as usize] / counts[node as usize];
    let weighted = cells(mesh, part).map(|(place, element, nodes)| (place, element as u32, nodes.iter().map(share).sum()));
    let mut found: Vec<(usize, u32, f64)> = weighted.filter(|it| it.2 > 0.0).collect();
    let sum: f64 = found.iter().map(|it| it.2).sum();
    found.iter_mut().for_each(|it| it.2 /= sum);
    found
}

impl Values {
    /// Names of those of a field, in the order in which [`Values::add`] adds them.
    pub(super) fn names(&self, kind: &FieldKind, probe: &str, axes: &[&str]) -> Vec<String> {
        let component = |component: &&str| format!("{probe}.{}_{component}", kind.name);
        let mut names: Vec<String> = kind.components.iter().map(component).collect();
        if names.is_empty() {
            names.push(format!("{probe}.{}", kind.name));
        }
        let places = names.iter().flat_map(|name| axes.iter().map(move |axis| format!("{name}_at_{axis}")));
        let places: Vec<String> = places.filter(|_| self.has_place).collect();
        names.extend(places);
        names
    }

    /// Adds those of a field; `nodes` of the probe with their weights.
    pub(super) fn add<const D: usize>(&self, kind: &FieldKind, nodes: &[(u32, f64)], snapshot: &LiveSnapshot<'_, D>, row: &mut Vec<f64>)
    where
        Dim<D>: Dimension<D> + NodeFields<D>,
    {
        let mut join = Joined::new(self.extreme, kind.width());
        match (kind.source, &self.elements.at_nodes) {
            (Source::Nodes(plane, space), _) => {
                let OfNode(of_node) = <Dim<D>>::of_node(plane, space);
                let mut own = vec![0.0; kind.width()];
                for (at, &(node, weight)) in nodes.iter().enumerate() {
                    of_node(snapshot, node as usize, &mut own);
                    join.add(&own, weight, at);
                }
            }
            (Source::Cells(of_cell), None) => self.each_element(of_cell, kind.width(), snapshot, |at, own, is_alive, weight| {
                if self.extreme.is_none() || is_alive {
                    join.add(own, weight, at);
                }
            }),
            (Source::Cells(of_cell), Some(at_nodes)) => self.join_nodes(of_cell, at_nodes, nodes, snapshot, &mut join),
        }
        row.extend(join.values);
        if self.has_place {
            let is_of_nodes = matches!(kind.source, Source::Nodes(..)) || self.elements.at_nodes.is_some();
            let place = |at: Option<usize>| at.map_or([f64::NAN; D], |at| self.place(at, is_of_nodes.then_some(nodes), snapshot));
            row.extend(join.places.into_iter().flat_map(place));
        }
    }

    /// Where one of the nodes, or of the elements, is now, m.
    fn place<const D: usize>(&self, at: usize, nodes: Option<&[(u32, f64)]>, snapshot: &LiveSnapshot<'_, D>) -> [f64; D]
    where
        Dim<D>: Dimension<D>,
    {
        let system = snapshot.system;
        if let Some(nodes) = nodes {
            return system.positions[nodes[at].0 as usize];
        }
        let (group, element, _) = self.elements.list[at];
        system.centre(system.mesh.groups[group].nodes_of(element as usize))
    }

    /// Hands over the elements by their places in the list: values, whether it is there, weight.
    fn each_element<const D: usize>(
        &self,
        of_cell: OfCell,
        width: usize,
        snapshot: &LiveSnapshot<'_, D>,
        mut see: impl FnMut(usize, &[f64], bool, f64),
    ) where
        Dim<D>: Dimension<D> + NodeFields<D>,
    {
        let system = snapshot.system;
        let mut own = vec![0.0; width];
        for (at, &(group, element, weight)) in self.elements.list.iter().enumerate() {
            let (block, element) = (&system.blocks[group], element as usize);
            let is_alive = system.mesh.groups[group].is_alive(element);
            let cell = Cell { state: &block.state(element), is_alive, place: (group, element), within: system };
            of_cell.write(&cell, of_cell.variable().and_then(|variable| block.index_of(variable)), &mut own);
            see(at, &own, is_alive, weight);
        }
    }

    /// Joins the values of nodes: means over the elements that are there. Where none is left an extreme
    /// passes the node over, and a mean takes what they had at the end.
    fn join_nodes<const D: usize>(
        &self,
        of_cell: OfCell,
        at_nodes: &Rows<u32>,
        nodes: &[(u32, f64)],
        snapshot: &LiveSnapshot<'_, D>,
        join: &mut Joined,
    ) where
        Dim<D>: Dimension<D> + NodeFields<D>,
    {
        let width = join.values.len();
        let (mut values, mut are_alive) = (Vec::new(), Vec::new());
        self.each_element(of_cell, width, snapshot, |_, own, is_alive, _| {
            values.extend_from_slice(own);
            are_alive.push(is_alive);
        });
        let mut own = vec![0.0; width];
        for (place, &(_, weight)) in nodes.iter().enumerate() {
            let all = at_nodes.of(place);
            let has_live = all.iter().any(|&at| are_alive[at as usize]);
            if all.is_empty() || (!has_live && self.extreme.is_some()) {
                continue;
            }
            own.fill(0.0);
            let mut sizes = 0.0;
            for at in all.iter().map(|&at| at as usize).filter(|&at| are_alive[at] || !has_live) {
                let size = self.elements.list[at].2;
                sizes += size;
                own.iter_mut().zip(&values[at * width..]).for_each(|(sum, value)| *sum += size * value);
            }
            own.iter_mut().for_each(|sum| *sum /= sizes);
            join.add(&own, weight, place);
        }
    }
}

/// Values of several places as one.
struct Joined {
    extreme: Option<Extreme>,
    values: Vec<f64>,
    /// Number of the first place that has each extreme.
    places: Vec<Option<usize>>,
}

impl Joined {
    /// Of no places: zero, and not a number for an extreme.
    fn new(extreme: Option<Extreme>, width: usize) -> Self {
        Self { extreme, values: vec![if extreme.is_some() { f64::NAN } else { 0.0 }; width], places: vec![None; width] }
    }

    fn add(&mut self, own: &[f64], weight: f64, at: usize) {
        for ((sum, place), &value) in self.values.iter_mut().zip(&mut self.places).zip(own) {
            let is_first = place.is_none() && !value.is_nan();
            let (new, is_more) = match self.extreme {
                None => (*sum + weight * value, false),
                Some(Extreme::Max) => (sum.max(value), value > *sum),
                Some(Extreme::Min) => (sum.min(value), value < *sum),
            };
            if is_first || is_more {
                *place = Some(at);
            }
            *sum = new;
        }
    }
}
