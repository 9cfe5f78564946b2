//! Values and places over all frames of a result folder: of a node or of an element.

use super::bodies::Bodies;
use super::describe::FrameTime;
use super::folder::{ResultView, frames};
use crate::picture::field::Scalar;
use crate::results::ResultsError;
use crate::vtu::read::VtuReader;
use embate_solver::output::Location;
use serde::Serialize;

/// Of what a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProbePlace {
    /// A node; of a quantity of elements the mean of those around it.
    Node(usize),
    /// An element; of a quantity of nodes the mean of its own.
    Cell(usize),
}

/// A scalar at a node or in a cell over the frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Probed {
    /// s.
    pub times: Vec<f64>,
    /// `null` where there is none: the cell was eroded, the field has no value there.
    pub values: Vec<Option<f64>>,
    /// SI.
    pub unit: &'static str,
    /// Name for people.
    pub label: String,
}

/// Where a node, or the middle of an element, is in the frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Track {
    /// s.
    pub times: Vec<f64>,
    /// At the beginning, m.
    pub initial: [f64; 3],
    /// m; in 2D z is zero.
    pub positions: Vec<[f64; 3]>,
}

impl ResultView {
    /// A scalar at a node or in a cell, in all frames; none where there is no such scalar or place.
    ///
    /// # Errors
    /// As [`ResultView::frame`].
    pub fn probe(&self, name: &str, place: ProbePlace) -> Result<Option<Probed>, ResultsError> {
        let Some(scalar) = Scalar::of(self.kinds.iter().copied(), name) else { return Ok(None) };
        let is_cell = scalar.kind.location == Location::Cell;
        let Some(places) = places(&self.bodies, place, is_cell) else { return Ok(None) };
        let mut probed = Probed { unit: scalar.kind.unit, label: scalar.label(), ..Probed::default() };
        for (FrameTime { time, .. }, file) in frames(&self.path)? {
            let mut reader = VtuReader::open(&file)?;
            self.check(&reader)?;
            let gone = if is_cell { reader.gone()? } else { Vec::new() };
            let (mut sum, mut count) = (0.0, 0u32);
            for &place in places.iter().filter(|&&place| gone.binary_search(&(place as u32)).is_err()) {
                let own = reader.values(scalar.kind, place..place + 1)?;
                let value = if own.is_empty() { f64::NAN } else { scalar.scalar(&own) };
                if value.is_finite() {
                    (sum, count) = (sum + value, count + 1);
                }
            }
            probed.times.push(time);
            probed.values.push((count > 0).then(|| sum / f64::from(count)));
        }
        Ok(Some(probed))
    }

    /// Where a node, or the mean of the nodes of an element, is in all frames; none where there is no such
    /// place.
    ///
    /// # Errors
    /// As [`ResultView::frame`].
    pub fn track(&self, place: ProbePlace) -> Result<Option<Track>, ResultsError> {
        let Some(nodes) = places(&self.bodies, place, false).filter(|nodes| !nodes.is_empty()) else { return Ok(None) };
        let mut track = Track { initial: initial(&self.bodies, &nodes), ..Track::default() };
        for (FrameTime { time, .. }, file) in frames(&self.path)? {
            let mut reader = VtuReader::open(&file)?;
            self.check(&reader)?;
            let places: Result<Vec<_>, _> = nodes.iter().map(|&node| reader.place(node)).collect();
            track.times.push(time);
            track.positions.push(mean(places?));
        }
        Ok(Some(track))
    }
}

/// Nodes or cells whose mean is the value at a place; none where there is no such place.
pub(super) fn places(bodies: &Bodies, place: ProbePlace, is_cell: bool) -> Option<Vec<usize>> {
    let (cells, nodes) = (&bodies.cells, bodies.nodes());
    match place {
        ProbePlace::Node(node) if node >= nodes => None,
        ProbePlace::Cell(cell) if cell >= cells.len() => None,
        ProbePlace::Node(node) if !is_cell => Some(vec![node]),
        ProbePlace::Cell(cell) if is_cell => Some(vec![cell]),
        ProbePlace::Node(node) => Some((0..cells.len()).filter(|&cell| cells.cell(cell).iter().any(|&own| own as usize == node)).collect()),
        ProbePlace::Cell(cell) => Some(cells.cell(cell).iter().map(|&node| node as usize).filter(|&node| node < nodes).collect()),
    }
}

/// Mean of the places of some nodes at the beginning, m.
pub(super) fn initial(bodies: &Bodies, nodes: &[usize]) -> [f64; 3] {
    mean(nodes.iter().map(|&node| bodies.initial(node).unwrap_or([f64::NAN; 3])).collect())
}

/// The mean of some places, of which there is one at least.
fn mean(places: Vec<[f64; 3]>) -> [f64; 3] {
    let count = places.len() as f64;
    let sum = places.into_iter().reduce(|sum, place| [0, 1, 2].map(|k| sum[k] + place[k])).unwrap_or([f64::NAN; 3]);
    sum.map(|x| x / count)
}
