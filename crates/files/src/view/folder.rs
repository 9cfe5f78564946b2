//! A result folder that is looked at: its description, frames, histories, values over time; of a run that
//! continues, too.
//!
//! Files are read when they are asked for (`vtu::read`, `results`); what a whole run must be read for (the
//! range of a scalar) is kept.

use super::bodies::{Bodies, Topology};
use super::container::Container;
use super::describe::{Column, FrameTime, PartDescription, RunDescription};
use super::frame;
use super::request::FrameRequest;
use super::values::{RangeOf, joined, range_of};
use crate::picture::field::Scalar;
use crate::plain;
use crate::results::{Appearance, History, Provenance, ResultsError, read_json, unit};
use crate::vtu::read::VtuReader;
use embate_solver::output::{Cells, FieldKind, Frame, Outline};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// More obstacles than any model has.
const OBSTACLES: usize = 1 << 16;

/// A folder of results.
#[derive(Debug)]
pub struct ResultView {
    pub(super) path: PathBuf,
    pub(super) bodies: Arc<Bodies>,
    pub(super) kinds: Vec<&'static FieldKind>,
    appearance: Appearance,
    pub(super) nodes: usize,
    /// Bodies of other meshes than that of the first frame, by revision.
    others: Mutex<BTreeMap<u32, Arc<Bodies>>>,
    /// Range of each scalar that was asked for.
    ranges: Mutex<BTreeMap<(String, RangeOf), Ranged>>,
    /// The frame that was read last: a plane that is moved through it does not read it again.
    newest: Mutex<Option<Arc<Kept>>>,
}

/// Range of a scalar, and over how many frames.
pub type Ranged = (Option<[f32; 2]>, usize);

/// Columns of a history.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Series {
    /// Names and units.
    pub columns: Vec<Column>,
    /// By column; `null` where a value is not a number.
    pub values: Vec<Vec<Option<f64>>>,
}

impl Series {
    /// That of a history whose columns are those of `history.csv`; energies and forces are those of whole
    /// bodies or per metre of depth.
    #[must_use]
    pub fn of(columns: &[String], values: Vec<Vec<f64>>, of_whole_bodies: bool) -> Self {
        let columns = columns.iter().map(|name| Column { name: name.clone(), unit: unit(name, of_whole_bodies).into() }).collect();
        let finite = |values: Vec<f64>| values.into_iter().map(|value| Some(value).filter(|value| value.is_finite())).collect();
        Self { columns, values: values.into_iter().map(finite).collect() }
    }
}

/// A frame that was read, and what of it.
#[derive(Debug)]
struct Kept {
    number: usize,
    /// Of its file: when it was written, and its bytes.
    stamp: (Option<SystemTime>, u64),
    fields: Vec<&'static str>,
    bodies: Arc<Bodies>,
    frame: Frame,
    gone: Vec<u32>,
}

impl ResultView {
    /// Opens a folder that has at least one frame.
    ///
    /// # Errors
    /// [`ResultsError::NothingToSee`], [`ResultsError::Unreadable`], what the system says.
    pub fn open(path: &Path) -> Result<Self, ResultsError> {
        let nothing = |what: &str| ResultsError::NothingToSee { path: path.into(), what: what.into() };
        if !path.is_dir() {
            return Err(nothing(if path.exists() { "it is a file" } else { "there is no such folder" }));
        }
        let appearance = Provenance::read(path)?.map(|provenance| provenance.appearance).unwrap_or_default();
        let first = frames(path)?.into_iter().next();
        let mut reader = match first {
            Some((_, file)) => VtuReader::open(&file)?,
            None if path.join("run.json").exists() || path.join("summary.json").exists() => return Err(nothing("it has no field files")),
            None => return Err(nothing("there are no results in it")),
        };
        let mut cells = reader.cells()?;
        let dimension = if appearance.dimension == 0 { reader.dimension(&cells) } else { appearance.dimension };
        let kinds = reader.kinds(dimension);
        cells.part_names = part_names(path, &appearance, &cells)?;
        let frame = displacements(&mut reader, dimension, &kinds)?;
        let bodies = Arc::new(Bodies::new(cells, &frame));
        Ok(Self {
            path: path.into(),
            bodies,
            kinds,
            appearance,
            nodes: reader.nodes,
            others: Mutex::default(),
            ranges: Mutex::default(),
            newest: Mutex::default(),
        })
    }

    /// A folder into which a run begins to write: what it will hold is known, its frames are read as they
    /// come.
    #[must_use]
    pub fn begun(path: &Path, bodies: Arc<Bodies>, kinds: Vec<&'static FieldKind>, appearance: Appearance, nodes: usize) -> Self {
        Self {
            path: path.into(),
            bodies,
            kinds,
            appearance,
            nodes,
            others: Mutex::default(),
            ranges: Mutex::default(),
            newest: Mutex::default(),
        }
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its bodies.
    #[must_use]
    pub fn bodies(&self) -> &Arc<Bodies> {
        &self.bodies
    }

    /// Whether energies and forces are those of whole bodies, not per metre of depth.
    #[must_use]
    pub fn is_of_whole_bodies(&self) -> bool {
        self.appearance.axisymmetric || self.bodies.dimension == 3
    }

    /// What there is now.
    ///
    /// # Errors
    /// What the system says; [`ResultsError::Damaged`].
    pub fn description(&self) -> Result<RunDescription, ResultsError> {
        let summary: Option<Value> = read_json(&self.path.join("summary.json"))?;
        let provenance = Provenance::read(&self.path)?;
        let text = |key: &str| summary.as_ref().and_then(|summary| summary.get(key)).and_then(Value::as_str).map(ToString::to_string);
        let folder = self.path.file_name().map(|name| name.to_string_lossy().into_owned());
        let name = text("model").or(folder).unwrap_or_default();
        let mut elements = vec![0usize; self.bodies.cells.part_names.len()];
        for &part in &self.bodies.cells.parts {
            if let Some(count) = elements.get_mut(part as usize) {
                *count += 1;
            }
        }
        let is_rigid = |name: &str| self.appearance.parts.iter().any(|(part, is_rigid)| part == name && *is_rigid);
        let parts = self.bodies.cells.part_names.iter().zip(elements);
        let parts = parts.map(|(name, elements)| PartDescription { is_rigid: is_rigid(name), name: name.clone(), elements });
        let frames = frames(&self.path)?;
        let size_on_disk = frames.iter().filter_map(|(_, file)| std::fs::metadata(file).ok()).map(|data| data.len()).sum();
        let mut description = RunDescription {
            title: name.clone(),
            name,
            path: std::path::absolute(&self.path).unwrap_or_else(|_| self.path.clone()).to_string_lossy().into_owned(),
            command: provenance.and_then(|provenance| provenance.command()),
            dimension: self.bodies.dimension,
            nodes: self.nodes,
            elements: self.bodies.cells.len(),
            parts: parts.collect(),
            frames: frames.into_iter().map(|(frame, _)| frame).collect(),
            is_over: summary.is_some(),
            size: self.bodies.size().unwrap_or_default(),
            obstacles: self.appearance.obstacles.clone(),
            contacts: self.appearance.contacts.clone(),
            warnings: summary.as_ref().map(RunDescription::warned).unwrap_or_default(),
            error: text("error"),
            size_on_disk,
            ..RunDescription::default()
        };
        description.show(&self.appearance, &self.kinds);
        description.summary = summary;
        Ok(description)
    }

    /// A frame; none where there is none of this number.
    ///
    /// # Errors
    /// [`ResultsError::Unreadable`], what the system says.
    pub fn frame(&self, number: usize, frame_request: &FrameRequest) -> Result<Option<Container>, ResultsError> {
        let Some(file) = self.file("frame", number) else { return Ok(None) };
        let scalar = frame_request.scalar.as_deref().and_then(|name| Scalar::of(self.kinds.iter().copied(), name));
        let named = [scalar.map(|scalar| scalar.kind.name), frame_request.glyphs.as_deref()];
        let is_wanted = |kind: &&&FieldKind| named.contains(&Some(kind.name)) || (frame_request.arrows && kind.name == "contact_force");
        let wanted: Vec<_> = self.kinds.iter().filter(is_wanted).copied().collect();
        let kept = self.read(number, &file, &wanted)?;
        let topology = kept.bodies.without(&kept.gone);
        let outlines = self.outlines(number)?;
        Ok(Some(frame::frame(&kept.bodies, &topology, &kept.frame, &outlines, frame_request).with("frame", number)))
    }

    /// A frame with some fields: that which was read last, or from its file.
    fn read(&self, number: usize, file: &Path, wanted: &[&'static FieldKind]) -> Result<Arc<Kept>, ResultsError> {
        let data = std::fs::metadata(file).map_err(ResultsError::file("read", file))?;
        let stamp = (data.modified().ok(), data.len());
        let fields: Vec<_> = wanted.iter().map(|kind| kind.name).collect();
        let newest = || self.newest.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(kept) = newest().clone().filter(|kept| (kept.number, &kept.stamp, &kept.fields) == (number, &stamp, &fields)) {
            return Ok(kept);
        }
        let mut reader = VtuReader::open(file)?;
        let bodies = self.bodies_of(&mut reader)?;
        let gone = reader.gone()?;
        let frame = reader.frame(self.bodies.dimension, wanted)?;
        let kept = Arc::new(Kept { number, stamp, fields, bodies, frame, gone });
        *newest() = Some(kept.clone());
        Ok(kept)
    }

    /// Whether a file is of the bodies of the first frame: their nodes and cells have its numbers.
    pub(super) fn check(&self, reader: &VtuReader) -> Result<(), ResultsError> {
        if reader.revision != self.bodies.cells.revision {
            return Err(ResultsError::Renumbered { path: self.path.clone() });
        }
        reader.has(self.nodes, self.bodies.cells.len())
    }

    /// The bodies that a file is of: elements may have been made again.
    fn bodies_of(&self, reader: &mut VtuReader) -> Result<Arc<Bodies>, ResultsError> {
        if reader.revision == self.bodies.cells.revision {
            self.check(reader)?;
            return Ok(self.bodies.clone());
        }
        let others = || self.others.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = others().get(&reader.revision).cloned() {
            reader.has(found.nodes(), found.cells.len())?;
            return Ok(found);
        }
        let mut cells = reader.cells()?;
        cells.part_names.clone_from(&self.bodies.cells.part_names);
        let frame = displacements(reader, self.bodies.dimension, &self.kinds)?;
        let bodies = Arc::new(self.bodies.with_cells(cells, &frame));
        Ok(others().entry(reader.revision).or_insert(bodies).clone())
    }

    /// A topology that a frame has named, and its bodies.
    #[must_use]
    pub fn topology(&self, number: usize) -> Option<(Arc<Bodies>, Arc<Topology>)> {
        let others: Vec<Arc<Bodies>> = self.others.lock().unwrap_or_else(PoisonError::into_inner).values().cloned().collect();
        [self.bodies.clone()].into_iter().chain(others).find_map(|bodies| bodies.numbered(number).map(|found| (bodies.clone(), found)))
    }

    /// The obstacles at a frame, in model order.
    fn outlines(&self, number: usize) -> Result<Vec<Outline>, ResultsError> {
        let Some(file) = self.file("obstacles", number) else { return Ok(Vec::new()) };
        let mut outlines = Vec::new();
        for (index, outline) in VtuReader::open(&file)?.outlines()? {
            // Those without points are not in the file; a damaged file may name any number.
            if index < OBSTACLES {
                outlines.resize_with(outlines.len().max(index + 1), Outline::default);
                outlines[index] = outline;
            }
        }
        Ok(outlines)
    }

    fn file(&self, kind: &str, number: usize) -> Option<PathBuf> {
        Some(self.path.join("fields").join(format!("{kind}-{number:05}.vtu"))).filter(|file| file.is_file())
    }

    /// The history, thinned to so many rows; of a run that continues as far as it is written.
    ///
    /// # Errors
    /// [`ResultsError::Damaged`], what the system says.
    pub fn history(&self, rows: usize) -> Result<Series, ResultsError> {
        let Some(history) = History::read(&self.path)? else { return Ok(Series::default()) };
        let History { columns, values } = history.decimated(rows);
        Ok(Series::of(&columns, values, self.is_of_whole_bodies()))
    }

    /// Smallest and largest value of a scalar in all frames, and how many these are.
    ///
    /// # Errors
    /// As [`ResultView::frame`].
    pub fn range(&self, name: &str, of: RangeOf) -> Result<Ranged, ResultsError> {
        let frames = frames(&self.path)?;
        let key = (name.to_string(), of);
        if let Some((range, count)) = self.ranges.lock().unwrap_or_else(PoisonError::into_inner).get(&key)
            && *count == frames.len()
        {
            return Ok((*range, *count));
        }
        let mut whole: Option<[f32; 2]> = None;
        if let Some(scalar) = Scalar::of(self.kinds.iter().copied(), name) {
            for (_, file) in &frames {
                let mut reader = VtuReader::open(file)?;
                let bodies = self.bodies_of(&mut reader)?;
                let topology = bodies.without(&reader.gone()?);
                let places = if scalar.at_nodes() { bodies.nodes() } else { bodies.cells.len() };
                let tuples = reader.values(scalar.kind, 0..places)?;
                let values: Vec<f64> = tuples.chunks_exact(scalar.kind.width()).map(|tuple| scalar.scalar(tuple)).collect();
                whole = joined(whole, range_of(&bodies, &topology, scalar, &values, of));
            }
        }
        self.ranges.lock().unwrap_or_else(PoisonError::into_inner).insert(key, (whole, frames.len()));
        Ok((whole, frames.len()))
    }
}

/// A frame with the displacements alone: what says where bodies were at the start.
fn displacements(reader: &mut VtuReader, dimension: usize, kinds: &[&'static FieldKind]) -> Result<Frame, ResultsError> {
    let own: Vec<_> = kinds.iter().copied().filter(|kind| kind.name == "displacement").collect();
    reader.frame(dimension, &own)
}

/// The names of the parts, as far as anything reports them.
fn part_names(path: &Path, appearance: &Appearance, cells: &Cells) -> Result<Vec<String>, ResultsError> {
    let count = cells.parts.iter().max().map_or(0, |&last| last as usize + 1).min(cells.len());
    let summary: Option<Value> = read_json(&path.join("summary.json"))?;
    let reported = summary.as_ref().and_then(|summary| summary.get("parts")).and_then(Value::as_array);
    let reported: Vec<String> = reported.into_iter().flatten().filter_map(Value::as_str).map(ToString::to_string).collect();
    let mut names = if reported.is_empty() { appearance.parts.iter().map(|(name, _)| name.clone()).collect() } else { reported };
    names.extend((names.len()..count).map(|part| format!("part {part}")));
    Ok(names)
}

/// The frames of a folder by number, with their times; those after the last collection are asked themselves.
pub(super) fn frames(path: &Path) -> Result<Vec<(FrameTime, PathBuf)>, ResultsError> {
    let collection = plain::read_to_string(&path.join("fields.pvd")).unwrap_or_default();
    let attribute =
        |line: &str, name: &str| line.split(&format!("{name}=\"")).nth(1).and_then(|rest| rest.split('"').next()).map(ToString::to_string);
    let reported: BTreeMap<String, f64> = collection
        .lines()
        .filter_map(|line| {
            Some((attribute(line, "file")?, attribute(line, "timestep")?.parse().ok().filter(|time: &f64| time.is_finite())?))
        })
        .collect();
    let folder = path.join("fields");
    let mut found: Vec<(usize, PathBuf, String)> = Vec::new();
    let entries = match std::fs::read_dir(&folder) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(ResultsError::file("read", &folder))?,
    };
    for entry in entries {
        let name = entry.map_err(ResultsError::file("read", &folder))?.file_name().to_string_lossy().into_owned();
        let number = name.strip_prefix("frame-").and_then(|rest| rest.strip_suffix(".vtu"));
        let Some(number) = number.filter(|digits| digits.len() >= 5).and_then(|digits| digits.parse().ok()) else { continue };
        found.push((number, folder.join(&name), format!("fields/{name}")));
    }
    found.sort_unstable_by_key(|(number, _, _)| *number);
    let time =
        |file: &Path, name: &str| reported.get(name).map_or_else(|| VtuReader::open(file).map(|reader| reader.time), |time| Ok(*time));
    let frames = found.into_iter().filter_map(|(number, file, name)| {
        // One that can't be read is reported when it is wanted; without a time it has no place.
        let time = time(&file, &name).ok()?;
        Some((FrameTime { number, time }, file))
    });
    Ok(frames.collect())
}
