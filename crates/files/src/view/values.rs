//! The scalar that a frame shows as colours: at the nodes or cells that are seen, averaged, on sections.
//! Requests come from `request`; the numbers go to `frame`, ranges over whole runs to `folder`.

use super::averages::Averages;
use super::bodies::{Bodies, Topology, ranges};
use super::request::FrameRequest;
use super::section::Section;
use crate::picture::field::Scalar;
use embate_solver::output::{Location, Shown};
use std::cell::OnceCell;

/// The scalar of a request, and what a frame holds of it.
pub(super) struct Colours<'a> {
    pub(super) name: &'a str,
    scalar: Scalar,
    field: usize,
    averages: Option<Averages>,
    /// Of all nodes or cells, read when the first of some sections asks.
    everywhere: OnceCell<Vec<f64>>,
}

impl<'a> Colours<'a> {
    /// None where the frame has no such scalar.
    pub(super) fn of(bodies: &Bodies, topology: &Topology, shown: &dyn Shown, frame_request: &'a FrameRequest) -> Option<Self> {
        let kinds = shown.kinds();
        let name = frame_request.scalar.as_deref()?;
        let scalar = Scalar::of(kinds.iter().copied(), name)?;
        let field = kinds.iter().position(|kind| kind.name == scalar.kind.name)?;
        let mut colours = Self { name, scalar, field, averages: None, everywhere: OnceCell::new() };
        if frame_request.averaged && !scalar.at_nodes() {
            let values = colours.all(shown, bodies.cells.len());
            colours.averages = Some(Averages::new(&bodies.cells, shown.nodes(), topology.gone(), &values));
        }
        Some(colours)
    }

    /// Where values are: `node`, `cell`, or `corner` where they are averaged.
    pub(super) fn location(&self) -> &'static str {
        match (self.scalar.at_nodes(), &self.averages) {
            (true, _) => "node",
            (false, Some(_)) => "corner",
            (false, None) => "cell",
        }
    }

    /// Of so many nodes or cells.
    fn all(&self, shown: &dyn Shown, places: usize) -> Vec<f64> {
        let mut tuples = Vec::new();
        shown.values(self.field, 0..places, &mut tuples);
        tuples.chunks_exact(self.scalar.kind.width()).map(|tuple| self.scalar.scalar(tuple)).collect()
    }

    /// Of what is seen: one value of each node, or of each facet and then each bar; averaged, one of each of
    /// their corners.
    pub(super) fn seen(&self, topology: &Topology, shown: &dyn Shown) -> Vec<f32> {
        if let Some(averages) = &self.averages {
            return corners(topology).map(|(part, node)| averages.at(part, node) as f32).collect();
        }
        let width = self.scalar.kind.width();
        let take = |range, room: &mut Vec<f64>| shown.values(self.field, range, room);
        let tuples = match self.scalar.kind.location {
            Location::Node => taken(topology.nodes.iter().copied(), width, take),
            Location::Cell => {
                let mut tuples = taken(topology.facets.iter().map(|facet| facet.cell), width, take);
                tuples.extend(taken(topology.bars.iter().map(|bar| bar.cell), width, take));
                tuples
            }
        };
        tuples.chunks_exact(width).map(|tuple| self.scalar.scalar(tuple) as f32).collect()
    }

    /// Of a section: one value of each of its points and middles, or of each of its triangles.
    pub(super) fn cut(&self, section: &Section, bodies: &Bodies, shown: &dyn Shown) -> Vec<f32> {
        let single = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
        if let Some(averages) = &self.averages {
            let points = section.points.iter().zip(&section.parts);
            return single(
                section.with_middles(points.map(|(point, &part)| point.between(point.nodes.map(|node| averages.at(part, node)))).collect()),
            );
        }
        let places = if self.scalar.at_nodes() { shown.nodes() } else { bodies.cells.len() };
        let values = self.everywhere.get_or_init(|| self.all(shown, places));
        let value = |place: u32| values.get(place as usize).copied().unwrap_or(f64::NAN);
        if self.scalar.at_nodes() {
            single(section.with_middles(section.points.iter().map(|point| point.between(point.nodes.map(value))).collect()))
        } else {
            section.triangles().map(|(_, polygon)| value(polygon.cell) as f32).collect()
        }
    }
}

/// Part and node of each corner of the facets, four each, and of the ends of the bars.
fn corners(topology: &Topology) -> impl Iterator<Item = (u32, u32)> {
    let node = |own: u32| topology.nodes[own as usize];
    let facets = topology.facets.iter().flat_map(move |facet| facet.corners.map(|corner| (facet.part, node(corner))));
    facets.chain(topology.bars.iter().flat_map(move |bar| bar.nodes.map(|end| (bar.part, node(end)))))
}

/// Of which values a range is: those that are seen, or those inside too; averaged or not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct RangeOf {
    /// Of all nodes or cells that are there, not only of the skin.
    pub inside: bool,
    /// Of values of cells that are averaged at nodes.
    pub averaged: bool,
}

/// Smallest and largest value of a scalar; `values`: of all nodes or cells.
pub(super) fn range_of(bodies: &Bodies, topology: &Topology, scalar: Scalar, values: &[f64], of: RangeOf) -> Option<[f32; 2]> {
    let value = |&place: &u32| values.get(place as usize).map_or(f32::NAN, |value| *value as f32);
    let cells = &bodies.cells;
    let is_there = |cell: &u32| topology.gone().binary_search(cell).is_err();
    let all = || (0..cells.len() as u32).filter(is_there);
    if of.averaged && !scalar.at_nodes() {
        let averages = Averages::new(cells, bodies.nodes(), topology.gone(), values);
        return if of.inside {
            range(averages.all().map(|value| value as f32))
        } else {
            range(corners(topology).map(|(part, node)| averages.at(part, node) as f32))
        };
    }
    match (scalar.at_nodes(), of.inside) {
        (true, false) => range(topology.nodes.iter().map(value)),
        (true, true) => range(all().flat_map(|cell| cells.cell(cell as usize)).map(value)),
        (false, false) => {
            let seen = topology.facets.iter().map(|facet| &facet.cell).chain(topology.bars.iter().map(|bar| &bar.cell));
            range(seen.map(value))
        }
        (false, true) => range(all().map(|cell| value(&cell))),
    }
}

/// Smallest and largest finite value.
pub(super) fn range(values: impl Iterator<Item = f32>) -> Option<[f32; 2]> {
    let finite = values.filter(|value| value.is_finite());
    finite.fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

/// What two ranges span.
pub(super) fn joined(a: Option<[f32; 2]>, b: Option<[f32; 2]>) -> Option<[f32; 2]> {
    a.zip(b).map(|(a, b)| [a[0].min(b[0]), a[1].max(b[1])]).or(a).or(b)
}

/// Numbers of some places (ascending, more than once where they are named so), `width` of each; not a number
/// where nothing is given.
pub(super) fn taken(
    places: impl Iterator<Item = u32> + Clone,
    width: usize,
    take: impl Fn(std::ops::Range<usize>, &mut Vec<f64>),
) -> Vec<f64> {
    let mut numbers = Vec::new();
    let mut room = Vec::new();
    let mut wanted = places.clone().peekable();
    for range in ranges(places) {
        take(range.clone(), &mut room);
        while let Some(place) = wanted.next_if(|&place| (place as usize) < range.end) {
            let at = width * (place as usize - range.start);
            match room.get(at..at + width) {
                Some(own) => numbers.extend(own),
                None => numbers.extend(std::iter::repeat_n(f64::NAN, width)),
            }
        }
    }
    numbers
}
