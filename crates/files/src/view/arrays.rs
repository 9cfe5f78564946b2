//! Frames of a result folder as arrays, for programs that read results: positions, cells and fields of one
//! file each, in the order of the files.

use super::folder::frames;
use crate::results::ResultsError;
use crate::vtu::read::VtuReader;
use embate_solver::output::{Cells, FieldKind, Location};
use std::path::{Path, PathBuf};

/// The complete frames of a folder: number, time (s) and file, ascending; none where there are no results.
///
/// # Errors
/// What the system says.
pub fn frame_files(path: &Path) -> Result<Vec<(usize, f64, PathBuf)>, ResultsError> {
    Ok(frames(path)?.into_iter().map(|(frame, file)| (frame.number, frame.time, file)).collect())
}

/// A frame that is open: its arrays are read when they are asked for.
#[derive(Debug)]
pub struct FrameArrays {
    reader: VtuReader,
    cells: Cells,
    dimension: usize,
}

impl FrameArrays {
    /// Opens a file of a frame.
    ///
    /// # Errors
    /// [`ResultsError::Unreadable`]; what the system says.
    pub fn open(file: &Path) -> Result<Self, ResultsError> {
        let mut reader = VtuReader::open(file)?;
        let cells = reader.cells()?;
        let dimension = reader.dimension(&cells);
        Ok(Self { reader, cells, dimension })
    }

    /// s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.reader.time
    }

    /// Components of a position.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The cells; their parts have no names.
    #[must_use]
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Positions of the nodes, m, one after the other.
    ///
    /// # Errors
    /// As [`FrameArrays::open`].
    pub fn positions(&mut self) -> Result<Vec<f64>, ResultsError> {
        self.reader.frame(self.dimension, &[]).map(|frame| frame.coordinates)
    }

    /// Cells that were eroded, ascending.
    ///
    /// # Errors
    /// As [`FrameArrays::open`].
    pub fn gone(&mut self) -> Result<Vec<u32>, ResultsError> {
        self.reader.gone()
    }

    /// Fields that the file has.
    #[must_use]
    pub fn fields(&self) -> Vec<&'static FieldKind> {
        self.reader.kinds(self.dimension)
    }

    /// Values of a field at all nodes or cells.
    ///
    /// # Errors
    /// As [`FrameArrays::open`].
    pub fn values(&mut self, kind: &FieldKind) -> Result<Vec<f64>, ResultsError> {
        let places = if kind.location == Location::Node { self.reader.nodes } else { self.cells.len() };
        self.reader.values(kind, 0..places)
    }
}
