//! `channels.csv`: the model's channels, found from the history when the run is over.
//!
//! Formulas come from the solver's [`Channels`], values from `history.csv` as it was written; the recorder
//! puts the figures into the summary.

use super::ResultsError;
use super::atomic::write_whole;
use super::csv::{append_number, append_text};
use super::history::History;
use super::report::ChannelFigures;
use embate_solver::channel::{Channels, Figures};
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the file.
const CHANNELS: &str = "channels.csv";

/// Writes the file, if there are channels, and says what they come to.
pub(super) fn write(folder: &Path, channels: &Channels) -> Result<BTreeMap<String, ChannelFigures>, ResultsError> {
    if channels.is_empty() {
        return Ok(BTreeMap::new());
    }
    let Some(history) = History::read(folder)? else { return Ok(BTreeMap::new()) };
    let found = channels.evaluate(&history.values);
    let mut text = String::from("time");
    for channel in &found {
        text.push(',');
        append_text(&mut text, &channel.name);
    }
    text.push('\n');
    for row in 0..history.rows() {
        append_number(&mut text, history.values[0][row]);
        for channel in &found {
            text.push(',');
            append_number(&mut text, channel.values[row]);
        }
        text.push('\n');
    }
    write_whole(&folder.join(CHANNELS), text.as_bytes())?;
    let figures = |channel: Figures| {
        let Figures { name, values, max, min } = channel;
        let end = values.last().copied().unwrap_or(f64::NAN);
        (name, ChannelFigures { max: max[0], time_max: max[1], min: min[0], time_min: min[1], end })
    };
    Ok(found.into_iter().map(figures).collect())
}
