//! The data that are recorded of a system: which fields (`field` has their values), history rows, momentum,
//! the state hash. Values only; formats are elsewhere.

mod channels;
mod momentum;
mod peaks;

use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::body_columns::BodyColumns;
use crate::contact::springs::Tangential;
use crate::dimension::Dimension;
use crate::error::{Fault, Warning};
use crate::field::NodeFields;
use crate::field::snapshot::LiveSnapshot;
use crate::field::{ALIVE, VON_MISES};
use crate::hash::Fnv;
use crate::material::variable::PLASTIC_STRAIN;
use crate::mesh::ElementGroup;
use crate::model::{Forces, Model, Part};
use crate::output::{Cells, FieldKind, ForcePeak, Needs, fields_of};
use crate::rigid::RigidMotion;
use crate::step::System;
use crate::tensor::Dim;
pub(crate) use channels::Pushing;
use channels::{Channel, Column, Kind, Probes};
pub(crate) use momentum::Momentum;
use peaks::Peaks;

/// Fields and history of a run.
pub(crate) struct Recorded<const D: usize>
where
    Dim<D>: Dimension<D>,
{
    fields: Vec<&'static FieldKind>,
    channels: Vec<Box<dyn Channel<D>>>,
    columns: Vec<Column>,
    /// Whether rows have means of forces.
    means: bool,
    /// Σ f Δt of the columns with a mean since the last row, and Σ Δt, s.
    sums: Vec<f64>,
    duration: f64,
    /// Those of the last step: of one that fails before its forces are known, of the step before.
    rates: Vec<f64>,
    /// Levels at the last row; none before the first one.
    levels: Vec<f64>,
    peaks: Peaks,
    probe_lines: Vec<String>,
}

impl<const D: usize> Recorded<D>
where
    Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
{
    pub(crate) fn new(model: &Model, system: &System<D>) -> Result<Self, Vec<Fault>> {
        let has_failure = system.erosion.is_some();
        let has_contact = !system.contacts.is_empty();
        let has_friction = system.springs.terms.iter().any(|terms| matches!(terms.tangential, Tangential::Friction(_)));
        let wanted = |kind: &&FieldKind| {
            let include = &model.output.include;
            let named = include.iter().any(|name| name == kind.name) || model.output.picture_field == kind.name;
            let sensible = match kind.needs {
                Needs::Nothing => true,
                Needs::History(variable) => system.blocks.iter().any(|block| block.has(variable)),
                Needs::Contact => has_contact,
                Needs::Friction => has_friction,
                Needs::Failure => has_failure,
                Needs::Shells => model.parts.iter().any(Part::is_of_shells),
                Needs::Beams => model.parts.iter().any(Part::is_of_beams),
                Needs::Asking => false,
            };
            // Pictures fall back on these two.
            let pictured = model.output.pictures && (kind.name == VON_MISES.name || (kind.name == PLASTIC_STRAIN.name && sensible));
            let pictured = pictured || (model.output.pictures && kind.name == ALIVE.name && has_failure);
            named || pictured || (include.is_empty() && sensible)
        };
        let fields = fields_of(D).iter().filter(wanted).collect();
        let probes = Probes::new(model, system)?;
        let probe_lines = probes.lines();
        let channels = channels::of_system(model, system, probes)?;
        let columns: Vec<Column> = channels.iter().flat_map(|channel| channel.columns(system)).collect();
        Ok(Self {
            fields,
            channels,
            peaks: Peaks::of(&columns),
            columns,
            means: model.output.forces == Forces::Mean,
            sums: Vec::new(),
            duration: 0.0,
            rates: Vec::new(),
            levels: Vec::new(),
            probe_lines,
        })
    }

    pub(crate) fn probe_lines(&self) -> Vec<String> {
        self.probe_lines.clone()
    }

    pub(crate) fn columns(&self) -> Vec<String> {
        self.columns.iter().map(|column| column.name.clone()).collect()
    }

    /// Takes the forces at time zero.
    pub(crate) fn begin(&mut self, system: &System<D>) {
        self.rates.clear();
        self.channels.iter().for_each(|channel| channel.rates(system, &mut self.rates));
    }

    /// Values now.
    pub(crate) fn samples(&self, system: &System<D>) -> Vec<f64> {
        let time = system.mean_step();
        self.with(system, &self.rates, self.levels(system).into_iter().map(|[before, after]| (after - before) / time))
    }

    /// Samples now, with these means and changes.
    fn with(&self, system: &System<D>, means: &[f64], mut changes: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut samples = Vec::with_capacity(self.columns.len());
        self.channels.iter().for_each(|channel| channel.samples(system, &mut samples));
        let (mut samples, mut means) = (samples.into_iter(), means.iter().copied());
        let next = |column: &Column| match column.kind {
            Kind::Sample => samples.next(),
            Kind::Mean => means.next(),
            Kind::Change => changes.next(),
        };
        self.columns.iter().filter_map(next).collect()
    }

    /// Takes a step into the means of the interval.
    pub(crate) fn note(&mut self, system: &System<D>) {
        self.begin(system);
        self.sums.resize(self.rates.len(), 0.0);
        let time = system.mean_step();
        self.sums.iter_mut().zip(&self.rates).for_each(|(sum, rate)| *sum += time * rate);
        self.duration += time;
    }

    fn levels(&self, system: &System<D>) -> Vec<[f64; 2]> {
        let mut levels = Vec::new();
        self.channels.iter().for_each(|channel| channel.levels(system, &mut levels));
        levels
    }

    /// The row of the interval that ends now: means of forces, values now of the others. The largest forces
    /// are kept, and another interval begins.
    pub(crate) fn take_row(&mut self, system: &System<D>) -> Vec<f64> {
        let levels: Vec<f64> = self.levels(system).into_iter().map(|[_, after]| after).collect();
        let row = if self.means && self.duration > 0.0 && self.levels.len() == levels.len() {
            let means: Vec<f64> = self.sums.iter().map(|sum| sum / self.duration).collect();
            let changes = self.levels.iter().zip(&levels).map(|(old, new)| (new - old) / self.duration);
            self.with(system, &means, changes)
        } else {
            self.samples(system)
        };
        self.sums.fill(0.0);
        self.duration = 0.0;
        self.levels = levels;
        self.peaks.note(system.time, &row);
        row
    }

    /// What the user should know of its columns, once forces at time zero are known.
    pub(crate) fn warnings(&self, system: &System<D>) -> Vec<Warning> {
        self.channels.iter().flat_map(|channel| channel.warnings(system)).collect()
    }

    /// Contacts that push across cuts now.
    pub(crate) fn pushing(&self, system: &System<D>) -> Vec<Pushing> {
        self.channels.iter().flat_map(|channel| channel.pushing(system)).collect()
    }

    /// The largest forces of the rows so far.
    pub(crate) fn peaks(&self) -> Vec<ForcePeak> {
        self.peaks.found.clone()
    }

    /// A system as it is shown now.
    pub(crate) fn snapshot<'a>(&'a self, system: &'a System<D>) -> LiveSnapshot<'a, D> {
        LiveSnapshot::new(system, &self.fields)
    }
}

impl<const D: usize> Persist for Recorded<D>
where
    Dim<D>: Dimension<D>,
{
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { fields: _, channels: _, columns: _, means: _, probe_lines: _, rates, levels, sums, duration, peaks } = self;
        persist_each!(archive; rates, levels, sums, duration, &mut peaks.found);
        Ok(())
    }
}

/// The cells of all parts, in the user's order and numbering: of a beam those of its cross-section.
pub(crate) fn cells<const D: usize>(system: &System<D>) -> Cells
where
    Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
{
    let elements: usize = system.mesh.groups.iter().map(ElementGroup::elements).sum();
    // A large model has no room to grow into.
    let mut cells = Cells {
        nodes: Vec::with_capacity(system.mesh.groups.iter().map(|group| group.connectivity.len().max(group.outer.len())).sum()),
        offsets: Vec::with_capacity(elements + 1),
        kinds: Vec::with_capacity(elements),
        parts: Vec::with_capacity(elements),
        part_names: Vec::new(),
        revision: system.mesh.revision,
    };
    cells.offsets.push(0);
    for (index, part) in system.mesh.parts.iter().enumerate() {
        cells.part_names.push(part.name.clone());
        let groups: Vec<&ElementGroup> = system.mesh.groups_of(index).collect();
        // Where each element is stored, by the user's number.
        let mut places = vec![(0, 0); system.mesh.elements_of(index)];
        for (of_part, group) in (0u8..).zip(&groups) {
            (0..).zip(&group.user_elements).for_each(|(element, &user)| places[user as usize] = (of_part, element));
        }
        for (of_part, element) in places {
            for cell in groups[usize::from(of_part)].shown_cells_of(element as usize) {
                cells.nodes.extend(cell.nodes.iter().map(|&node| system.mesh.user_nodes[node as usize]));
                cells.offsets.push(cells.nodes.len() as u32);
                cells.kinds.push(cell.kind);
                cells.parts.push(index as u32);
            }
        }
    }
    cells
}

/// FNV-1a hash (64 bit) of the bits of all positions and velocities v^{n+1/2}, node by node, then of the
/// obstacles that move; hexadecimal.
pub(crate) fn state_hash<const D: usize>(system: &System<D>) -> String
where
    Dim<D>: Dimension<D> + BodyColumns<D> + NodeFields<D>,
{
    let mut hash = Fnv::default();
    let moving = system.bodies.iter().filter(|body| !body.of_elements && !body.is_fixed());
    let states = moving.flat_map(<Dim<D>>::numbers);
    // Nodes in the order of the curve, then those of obstacles: as they are numbered only for speed, that is
    // no matter here.
    let nodes = || system.mesh.along_curve().chain(system.mesh.user_nodes.len()..system.positions.len());
    let positions = nodes().flat_map(|node| system.positions[node]);
    let velocities = nodes().flat_map(|node| system.velocities[node]);
    let rotations = nodes().flat_map(|node| system.rotations.now.numbers(node as u32));
    for value in positions.chain(velocities).chain(rotations).chain(states) {
        hash.add(&value.to_le_bytes());
    }
    hash.to_string()
}
