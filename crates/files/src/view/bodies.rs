//! The bodies of a run as what is seen of them: skins in 3D, all cells in 2D, each set of eroded
//! cells with a skin of its own.
//!
//! Cells come from the first field file or from the simulation; a [`Topology`] is made when the first frame
//! needs it, and goes to the page once.

use super::container::Container;
use super::levels::{self, Level};
use crate::outline::box_around;
use crate::picture::space::{Bar, Facet, Skinner};
use embate_solver::output::{Cells, Shown};
use serde_json::json;
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Topologies that are kept at once; one that is asked for again is made again.
const KEPT: usize = 64;
/// Sets of eroded cells that have a number at once: a run that is watched for long while it erodes has any
/// number of them.
const NUMBERED: usize = 1024;

/// What is seen of the bodies while some cells are gone.
#[derive(Debug)]
pub struct Topology {
    /// Its number in the run.
    pub id: usize,
    /// Nodes of the frame that it needs, ascending.
    pub(super) nodes: Vec<u32>,
    pub(super) facets: Vec<Facet>,
    pub(super) bars: Vec<Bar>,
    level: Option<Level>,
    /// Cells that are gone, ascending.
    gone: Vec<u32>,
}

/// The cells of a run, and the skins that it has had.
#[derive(Debug)]
pub struct Bodies {
    pub(super) cells: Cells,
    /// Components of a position.
    pub(super) dimension: usize,
    skinner: Skinner,
    /// Initial places of all nodes, m.
    initial: Vec<[f64; 3]>,
    /// What positions are distinguished from, m: single precision is enough beside it.
    pub(super) origin: [f64; 3],
    found: Mutex<Found>,
}

/// The newest sets of cells that were gone in a frame, with their numbers; the newest of their topologies.
#[derive(Debug, Default)]
struct Found {
    gone: VecDeque<(usize, Vec<u32>)>,
    /// Numbers of the topologies of all meshes of the run.
    next: Arc<AtomicUsize>,
    topologies: Vec<Arc<Topology>>,
}

impl Found {
    /// The number of a set.
    fn number(&mut self, gone: &[u32]) -> usize {
        if let Some((id, _)) = self.gone.iter().rev().find(|(_, set)| set == gone) {
            return *id;
        }
        if self.gone.len() == NUMBERED {
            self.gone.pop_front();
        }
        let id = self.next.fetch_add(1, Ordering::Relaxed);
        self.gone.push_back((id, gone.to_vec()));
        id
    }
}

impl Bodies {
    /// The cells of a run, as they are shown first; where there is a field `displacement`, it reports initial
    /// places.
    #[must_use]
    pub fn new(cells: Cells, shown: &dyn Shown) -> Self {
        let (nodes, dimension) = (shown.nodes(), shown.dimension());
        let mut now = Vec::new();
        shown.coordinates(0..nodes, &mut now);
        if let Some(field) = shown.kinds().iter().position(|kind| kind.name == "displacement") {
            let mut displacement = Vec::new();
            shown.values(field, 0..nodes, &mut displacement);
            now.iter_mut().zip(displacement).for_each(|(x, u)| *x -= u);
        }
        let initial: Vec<[f64; 3]> =
            now.chunks_exact(dimension.max(1)).map(|own| std::array::from_fn(|d| own.get(d).copied().unwrap_or(0.0))).collect();
        let place = |node: u32| initial.get(node as usize).copied().unwrap_or([f64::NAN; 3]);
        let skinner = Skinner::new(&cells, &place);
        let size = box_around(initial.iter().copied()).unwrap_or_default();
        let origin = [0, 1, 2].map(|k| 0.5 * (size[0][k] + size[1][k]));
        Self { cells, dimension, skinner, initial, origin, found: Mutex::default() }
    }

    /// The bodies of the same run after it was meshed again, with numbers of topologies that it has not had.
    #[must_use]
    pub fn with_cells(&self, cells: Cells, shown: &dyn Shown) -> Self {
        let next = self.found.lock().unwrap_or_else(PoisonError::into_inner).next.clone();
        Self { origin: self.origin, found: Mutex::new(Found { next, ..Found::default() }), ..Self::new(cells, shown) }
    }

    /// The topology without these cells (ascending).
    pub fn without(&self, gone: &[u32]) -> Arc<Topology> {
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let id = found.number(gone);
        if let Some(topology) = found.topologies.iter().find(|topology| topology.id == id) {
            return topology.clone();
        }
        let topology = Arc::new(self.topology(id, gone.to_vec()));
        if found.topologies.len() == KEPT {
            found.topologies.remove(0);
        }
        found.topologies.push(topology.clone());
        topology
    }

    /// The topology of a number; none where no frame has named it, or too long ago.
    #[must_use]
    pub fn numbered(&self, id: usize) -> Option<Arc<Topology>> {
        let gone = self.found.lock().unwrap_or_else(PoisonError::into_inner).gone.iter().find(|(own, _)| *own == id)?.1.clone();
        Some(self.without(&gone))
    }

    fn topology(&self, id: usize, gone: Vec<u32>) -> Topology {
        let (mut facets, mut bars) = self.skinner.seen(&self.cells, &gone);
        // A damaged file may name nodes that are not there.
        let is_there = |nodes: &[u32]| nodes.iter().all(|&node| (node as usize) < self.initial.len());
        facets.retain(|facet| is_there(&facet.corners));
        bars.retain(|bar| is_there(&bar.nodes));
        let mut own = vec![u32::MAX; self.initial.len()];
        let named = facets.iter().flat_map(|facet| &facet.corners).chain(bars.iter().flat_map(|bar| &bar.nodes));
        named.for_each(|&node| own[node as usize] = 0);
        let nodes: Vec<u32> = (0..own.len() as u32).filter(|&node| own[node as usize] == 0).collect();
        (0..).zip(&nodes).for_each(|(place, &node)| own[node as usize] = place);
        facets.iter_mut().flat_map(|facet| &mut facet.corners).for_each(|corner| *corner = own[*corner as usize]);
        bars.iter_mut().flat_map(|bar| &mut bar.nodes).for_each(|node| *node = own[*node as usize]);
        let level = (facets.len() > levels::LARGE).then(|| {
            let corners: Vec<[u32; 4]> = facets.iter().map(|facet| facet.corners).collect();
            levels::coarser(&corners, self.places(&nodes).as_chunks().0)
        });
        Topology { id, nodes, facets, bars, level, gone }
    }

    /// How many nodes there are.
    pub(super) fn nodes(&self) -> usize {
        self.initial.len()
    }

    /// Where a node is at the beginning, m.
    pub(super) fn initial(&self, node: usize) -> Option<[f64; 3]> {
        self.initial.get(node).copied()
    }

    /// A place of a node as it is shown, m: with the displacement times a factor.
    pub(super) fn scaled(&self, node: u32, now: [f64; 3], scale: f64) -> [f64; 3] {
        match self.initial.get(node as usize) {
            Some(initial) if scale != 1.0 => [0, 1, 2].map(|k| initial[k] + scale * (now[k] - initial[k])),
            _ => now,
        }
    }

    /// Initial places from the origin, m.
    fn places(&self, nodes: &[u32]) -> Vec<f32> {
        let place = |&node: &u32| [0, 1, 2].map(|k| (self.initial[node as usize][k] - self.origin[k]) as f32);
        nodes.iter().flat_map(place).collect()
    }

    /// What the page needs of a topology.
    #[must_use]
    pub fn container(&self, topology: &Topology) -> Container {
        let Topology { id, nodes, facets, bars, level, gone } = topology;
        let mut container = Container::default()
            .with("topology", *id)
            .with("origin", json!(self.origin))
            .with("levels", 1 + usize::from(level.is_some()))
            .with("cells", self.cells.len() - gone.len());
        container.indices("node_numbers", nodes.clone());
        container.floats("initial", self.places(nodes));
        container.indices("facets", facets.iter().flat_map(|facet| facet.corners).collect());
        container.indices("facet_parts", facets.iter().map(|facet| facet.part).collect());
        container.indices("facet_cells", facets.iter().map(|facet| facet.cell).collect());
        container.indices("bars", bars.iter().flat_map(|bar| bar.nodes).collect());
        container.indices("bar_parts", bars.iter().map(|bar| bar.part).collect());
        container.indices("bar_cells", bars.iter().map(|bar| bar.cell).collect());
        if let Some(level) = level {
            container.indices("facets_1", level.facets.as_flattened().to_vec());
            container.indices("sources_1", level.sources.clone());
        }
        container
    }

    /// The box around all bodies at the beginning, m; none without bodies.
    #[must_use]
    pub fn size(&self) -> Option<[[f64; 3]; 2]> {
        box_around(self.initial.iter().copied())
    }
}

impl Topology {
    /// Cells that have gone.
    #[must_use]
    pub fn gone(&self) -> &[u32] {
        &self.gone
    }
}

/// Ascending places as ranges, with those between them where these are few: asking for a range costs more
/// than some numbers too many.
pub(super) fn ranges(places: impl IntoIterator<Item = u32>) -> Vec<Range<usize>> {
    const BETWEEN: usize = 32;
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for place in places {
        let place = place as usize;
        match ranges.last_mut() {
            Some(last) if place < last.end + BETWEEN => last.end = last.end.max(place + 1),
            _ => ranges.push(place..place + 1),
        }
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::{CellKind, Frame};

    /// Three quadrilaterals side by side and a bar behind them.
    fn bodies() -> Bodies {
        let cells = Cells {
            nodes: vec![0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 8],
            offsets: vec![0, 4, 8, 12, 14],
            kinds: vec![CellKind::Quadrilateral, CellKind::Quadrilateral, CellKind::Quadrilateral, CellKind::Line],
            parts: vec![0, 0, 0, 1],
            part_names: vec!["strip".into(), "bar".into()],
            revision: 0,
        };
        let places: Vec<[f64; 2]> = (0..8).map(|k| [f64::from(k % 4), f64::from(k / 4)]).chain([[4.0, 0.0]]).collect();
        Bodies::new(cells, &Frame::of(&places))
    }

    #[test]
    fn cells_of_2d_are_all_seen_and_those_that_have_gone_are_not() {
        let bodies = bodies();
        let whole = bodies.without(&[]);
        assert_eq!((whole.facets.len(), whole.bars.len(), whole.nodes.len()), (3, 1, 9));
        let rest = bodies.without(&[0]);
        assert_eq!((rest.id, rest.facets.len(), rest.nodes.clone()), (1, 2, vec![1, 2, 3, 5, 6, 7, 8]));
        assert_eq!(rest.facets[0].corners, [0, 1, 4, 3], "by places among the nodes that are left");
        assert_eq!(bodies.without(&[]).id, 0);
        assert_eq!(bodies.numbered(1).unwrap().gone(), [0]);
        assert!(bodies.numbered(2).is_none());
    }

    #[test]
    fn cells_that_name_nodes_that_are_not_there_are_left_out() {
        let mut cells = bodies().cells;
        cells.nodes[4] = 77;
        let places: Vec<[f64; 2]> = (0..9).map(|k| [f64::from(k), 1.0]).collect();
        let bodies = Bodies::new(cells, &Frame::of(&places));
        assert_eq!(bodies.without(&[]).facets.len(), 2);
    }

    #[test]
    fn bodies_that_are_meshed_again_have_topologies_with_new_numbers_from_the_same_origin() {
        let before = bodies();
        assert_eq!((before.without(&[]).id, before.without(&[0]).id), (0, 1));
        let cells = Cells {
            nodes: vec![0, 1, 2],
            offsets: vec![0, 3],
            kinds: vec![CellKind::Triangle],
            parts: vec![0],
            part_names: vec!["strip".into()],
            revision: 0,
        };
        let now = before.with_cells(cells, &Frame::of(&[[10.0, 0.0], [11.0, 0.0], [10.0, 1.0]]));
        let whole = now.without(&[]);
        assert_eq!((whole.id, whole.facets.len(), now.origin), (2, 1, before.origin));
        assert!(now.numbered(1).is_none() && now.numbered(2).is_some());
    }

    #[test]
    fn old_sets_of_eroded_cells_are_forgotten_and_new_ones_have_new_numbers() {
        let count = 60;
        let cells = Cells {
            nodes: (0..count).flat_map(|k| [2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1]).collect(),
            offsets: (0..=count).map(|k| 4 * k).collect(),
            kinds: vec![CellKind::Quadrilateral; count as usize],
            parts: vec![0; count as usize],
            part_names: vec!["strip".into()],
            revision: 0,
        };
        let places: Vec<[f64; 2]> = (0..2 * count + 2).map(|k| [f64::from(k / 2), f64::from(k % 2)]).collect();
        let bodies = Bodies::new(cells, &Frame::of(&places));
        let pairs: Vec<[u32; 2]> = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).take(1200).collect();
        assert!(pairs.iter().map(|pair| bodies.without(pair).id).eq(0..1200));
        assert!(bodies.numbered(100).is_none() && bodies.numbered(1100).is_some_and(|it| it.gone() == pairs[1100]));
        assert_eq!((bodies.without(&pairs[3]).id, bodies.without(&pairs[1100]).id), (1200, 1100));
    }

    #[test]
    fn ranges_join_what_is_near() {
        assert_eq!(ranges([1, 2, 3, 20, 90, 91]), [1..21, 90..92]);
        assert_eq!(ranges([5, 5, 6, 99]), [5..7, 99..100]);
    }
}
