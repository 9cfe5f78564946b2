//! The largest forces of the rows of a history, for the summary.

use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::output::ForcePeak;

/// One for each force of the columns, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Peaks(pub(super) Vec<ForcePeak>);

impl Peaks {
    /// Takes a row at a time, s, of a model of so many dimensions.
    pub(super) fn note(&mut self, time: f64, dimension: usize, columns: &[String], row: &[f64]) {
        let forces = columns.iter().enumerate().filter_map(|(at, name)| Some((at, name.split_once(".force_x[")?)));
        for (number, (at, (kind, rest))) in forces.enumerate() {
            if number == self.0.len() {
                let name = format!("{kind}[{rest}");
                self.0.push(ForcePeak { name, largest: 0.0, time, last: Vec::new() });
            }
            let (peak, own) = (&mut self.0[number], &row[at..][..dimension]);
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
