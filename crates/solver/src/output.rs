//! Output data of a run: the cells once, a frame per output time, a row of the history, the summary at the
//! end. Values only, no formats; they go to the writers of `embate-files`.

use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::contact::tracker::Certificate;
use crate::error::Notice;
pub use crate::field::kind::{FIELDS, FIELDS_IN_SPACE, FieldKind, Location, Needs, field_kind, fields_of};
pub use crate::mesh::cell::CellKind;
pub use crate::outline::Outline;
pub use crate::step::erosion::Eroded;
pub use crate::step::flow::Flow;
pub use crate::step::remap::Remeshing;
pub use crate::step::stages::StageRun;
use std::borrow::Cow;
use std::ops::Range;

/// The cells of all parts; they don't change during a run, unless it is meshed again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    /// Node indices of all cells, one after the other.
    pub nodes: Vec<u32>,
    /// Where each cell's nodes start in `nodes`, and the total at the end: `cells + 1` values.
    pub offsets: Vec<u32>,
    /// Kind of each cell.
    pub kinds: Vec<CellKind>,
    /// Part index of each cell.
    pub parts: Vec<u32>,
    /// Name of each part.
    pub part_names: Vec<String>,
    /// How many times elements have been made again until these; 0: they are those of the model.
    pub revision: u32,
}

impl Cells {
    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.kinds.len()
    }
    /// Whether there is no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }
    /// Memory that it needs.
    #[must_use]
    pub fn bytes(&self) -> usize {
        4 * (self.nodes.len() + self.offsets.len() + self.parts.len()) + size_of_val(&self.kinds[..])
    }
    /// Node indices of cell `index`.
    #[must_use]
    pub fn cell(&self, index: usize) -> &[u32] {
        &self.nodes[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }
}

impl Persist for Cells {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { nodes, offsets, kinds, parts, part_names, revision } = self;
        persist_each!(archive; nodes, offsets, kinds, parts, part_names, revision);
        let are_in_order = offsets.is_sorted() && offsets.last().is_none_or(|&last| last as usize <= nodes.len());
        let is_sound = are_in_order && [kinds.len(), parts.len()] == [offsets.len().saturating_sub(1); 2];
        archive.check(is_sound, "cells have nodes that are not there")
    }
}

/// A field at one time: `width` values per node or cell, one node or cell after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// What it is.
    pub kind: &'static FieldKind,
    /// The values.
    pub values: Vec<f64>,
}

/// The state at one output time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Time, s.
    pub time: f64,
    /// Step number.
    pub step: u64,
    /// Components of a position: 2 in 2D, 3 in 3D.
    pub dimension: usize,
    /// Current node positions, m, one after the other: see [`Frame::positions`].
    pub coordinates: Vec<f64>,
    /// Fields in the order of [`FIELDS`].
    pub fields: Vec<Field>,
    /// Obstacles in model order.
    pub outlines: Vec<Outline>,
}

impl Frame {
    /// Nodes at these places (m), and nothing else.
    #[must_use]
    pub fn of<const D: usize>(positions: &[[f64; D]]) -> Self {
        Self { dimension: D, coordinates: positions.as_flattened().to_vec(), ..Self::default() }
    }

    /// Current node positions, m; none where the frame has another dimension.
    #[must_use]
    pub fn positions<const D: usize>(&self) -> &[[f64; D]] {
        if D == self.dimension { self.coordinates.as_chunks().0 } else { &[] }
    }

    /// How many nodes there are.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.coordinates.len() / self.dimension.max(1)
    }

    /// Current position of a node in 3D, m; in 2D z is zero.
    #[must_use]
    pub fn place(&self, node: usize) -> [f64; 3] {
        let own = &self.coordinates[node * self.dimension..][..self.dimension];
        std::array::from_fn(|d| own.get(d).copied().unwrap_or(0.0))
    }
}

/// A state at an output time, to be taken piece by piece: nodes and cells in the user's order, fields in that
/// of [`FIELDS`]. A [`Frame`] has all of it in memory, a running simulation makes each piece when it is asked
/// for.
pub trait Shown: Sync {
    /// Time, s.
    fn time(&self) -> f64;
    /// Step number.
    fn step(&self) -> u64;
    /// Components of a position: 2 in 2D, 3 in 3D.
    fn dimension(&self) -> usize;
    /// How many nodes there are.
    fn nodes(&self) -> usize;
    /// The fields.
    fn kinds(&self) -> Vec<&'static FieldKind>;
    /// How many numbers a field has, by its place among [`Shown::kinds`].
    fn numbers(&self, field: usize) -> usize;
    /// Puts the current positions of nodes into `values`, m, one after the other; what was there goes.
    fn coordinates(&self, nodes: Range<usize>, values: &mut Vec<f64>);
    /// The same of the values of a field at nodes or cells.
    fn values(&self, field: usize, places: Range<usize>, values: &mut Vec<f64>);
    /// The obstacles, and the positions of the nodes where there are any; no fields are needed.
    fn outlined(&self) -> Cow<'_, Frame>;
    /// Puts all of it into a frame; what the frame held goes, its buffers serve again.
    fn fill(&self, frame: &mut Frame);
}

impl Shown for Frame {
    fn time(&self) -> f64 {
        self.time
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn dimension(&self) -> usize {
        self.dimension
    }

    fn nodes(&self) -> usize {
        Self::nodes(self)
    }

    fn kinds(&self) -> Vec<&'static FieldKind> {
        self.fields.iter().map(|field| field.kind).collect()
    }

    fn numbers(&self, field: usize) -> usize {
        self.fields[field].values.len()
    }

    fn coordinates(&self, nodes: Range<usize>, values: &mut Vec<f64>) {
        put(&self.coordinates, self.dimension, nodes, values);
    }

    fn values(&self, field: usize, places: Range<usize>, values: &mut Vec<f64>) {
        put(&self.fields[field].values, self.fields[field].kind.width(), places, values);
    }

    fn outlined(&self) -> Cow<'_, Frame> {
        Cow::Borrowed(self)
    }

    fn fill(&self, frame: &mut Frame) {
        frame.clone_from(self);
    }
}

/// Puts the numbers of some places into `values`, `width` for each.
fn put(all: &[f64], width: usize, places: Range<usize>, values: &mut Vec<f64>) {
    values.clear();
    values.extend_from_slice(&all[width * places.start..width * places.end]);
}

/// What erosion has done.
#[derive(Clone, Debug, PartialEq)]
pub struct Erosion {
    /// Eroded elements of each part: name and number.
    pub elements: Vec<(String, usize)>,
    /// Mass of nodes that have no element any more, kg/m.
    pub mass_loose: f64,
    /// The first element.
    pub first: Eroded,
}

/// The largest value of a force in the history.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ForcePeak {
    /// What it is of, as in the history: `constraint[plate.left]`.
    pub name: String,
    /// Size of the largest force of a row, N/m (N).
    pub largest: f64,
    /// Time of that row, s.
    pub time: f64,
    /// Components of the last row's force, N/m (N).
    pub last: Vec<f64>,
}

/// Mass that was added in the run for longer steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassInRun {
    /// The mass, kg/m (kg).
    pub mass: f64,
    /// Absolute value of the momentum that it brought, kg/s (kg m/s).
    pub momentum: f64,
    /// Kinetic energy that it brought, J/m (J).
    pub kinetic_energy: f64,
}

impl Summary {
    /// Whether the run is not at its end yet.
    #[must_use]
    pub fn is_early(&self) -> bool {
        self.time_end < self.end * (1.0 - 1e-9)
    }
}

/// Result figures of a run, in the order in which they are written; see `docs/output.md` for the meaning of
/// each.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Components of a position: 2 in 2D, 3 in 3D.
    pub dimension: usize,
    /// Number of elements.
    pub elements: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Steps done.
    pub steps: u64,
    /// Time reached, s.
    pub time_end: f64,
    /// Time at which the run ends: that of the model, less what stages that were at rest early have left, s.
    pub end: f64,
    /// When relaxation had brought everything to rest, which ended the run, s.
    pub rest: Option<f64>,
    /// The stages so far; the last one until now.
    pub stages: Vec<StageRun>,
    /// Smallest time step taken, s.
    pub stable_time_step_min: f64,
    /// What governed that step.
    pub stable_time_step_governor: String,
    /// Largest |stores − works| so far as a fraction of the largest total energy.
    pub energy_drift: f64,
    /// Largest |change of kinetic energy − sum of works| as a fraction of the largest total energy.
    pub ledger_residual: f64,
    /// Change of linear momentum over Σ m|v|; `None` where something is held or driven, or loads act.
    pub momentum_drift_linear: Option<f64>,
    /// Change of angular momentum about the centre of mass at the start c, over Σ m|x − c||v|; `None` where
    /// something is held or driven, or loads act.
    pub momentum_drift_angular: Option<f64>,
    /// Deepest penetration seen in any contact or obstacle, m.
    pub penetration_max: f64,
    /// What was checked in all contacts between surfaces, and whether one was missed.
    pub contact: Certificate,
    /// Mass that was added for longer steps, kg/m.
    pub mass_added: f64,
    /// That of it which was added in the run; `None`: none was.
    pub mass_added_in_run: Option<MassInRun>,
    /// With subcycling: evaluations of elements, summed over the steps; without it, all are evaluated in
    /// each.
    pub element_evaluations: Option<u64>,
    /// Each time that elements of a part were made again.
    pub remeshings: Vec<Remeshing>,
    /// Parts that material flows through.
    pub flows: Vec<Flow>,
    /// What erosion has done; `None`: no element was eroded.
    pub erosion: Option<Erosion>,
    /// Largest forces of the history's rows, in the order of its columns.
    pub forces: Vec<ForcePeak>,
    /// Hash of positions and velocities at the end, hexadecimal.
    pub state_hash: String,
    /// Threads used.
    pub threads: usize,
    /// Instruction set used.
    pub simd: String,
    /// Things the user should know, each said once.
    pub warnings: Vec<Notice>,
}
