//! The largest forces of the rows of a history, for the summary.

use super::channels::{AXES, Column};
use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::output::ForcePeak;
use std::ops::Range;

/// One for each force of the columns, in their order.
#[derive(Clone, Debug)]
pub(super) struct Peaks {
    pub(super) found: Vec<ForcePeak>,
    /// Columns of each.
    columns: Vec<Range<usize>>,
}

impl Peaks {
    /// Of the forces of these columns.
    pub(super) fn of(columns: &[Column]) -> Self {
        let forces = columns.iter().enumerate().filter_map(|(at, column)| Some((at, column.name.split_once(".force_x[")?)));
        let (found, columns) = forces
            .map(|(at, (kind, name))| {
                let components =
                    columns[at..].iter().zip(AXES).take_while(|(column, axis)| column.name == format!("{kind}.force_{axis}[{name}"));
                let peak = ForcePeak { name: format!("{kind}[{name}"), ..ForcePeak::default() };
                (peak, at..at + components.count())
            })
            .unzip();
        Self { found, columns }
    }

    /// Takes a row at a time, s.
    pub(super) fn note(&mut self, time: f64, row: &[f64]) {
        for (peak, columns) in self.found.iter_mut().zip(&self.columns) {
            let own = &row[columns.clone()];
            let size = own.iter().map(|component| component * component).sum::<f64>().sqrt();
            if size > peak.largest {
                (peak.largest, peak.time) = (size, time);
            }
            peak.last = own.to_vec();
        }
    }
}

impl Persist for ForcePeak {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let Self { name, largest, time, last } = self;
        persist_each!(archive; name, largest, time, last);
        Ok(())
    }
}
