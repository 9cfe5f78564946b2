//! Pictures of the run as they lie in its folder, and plots of its history.

use super::Left;
use super::html::{escape, paragraph, plot, section};
use crate::picture::{base64, charts};
use crate::plain;
use crate::results::{History, ResultsError};
use std::fs;
use std::io::ErrorKind;

/// Larger pictures are left out: a page that is sent away should stay small. Bytes.
const LARGEST: u64 = 8 << 20;

/// A picture: its file, how the file begins, its type, and what it shows.
const PICTURES: [(&str, &[u8], &str, &str); 2] =
    [("final.png", b"\x89PNG\r\n\x1a\n", "image/png", "the last frame"), ("animation.gif", b"GIF8", "image/gif", "the bodies in motion")];

/// The pictures that are there.
pub(super) fn pictures(left: &Left) -> Result<String, ResultsError> {
    let mut body = String::new();
    for (name, start, kind, what) in PICTURES {
        let path = left.folder.join(name);
        let size = match fs::metadata(&path) {
            Ok(data) => data.len(),
            Err(error) if error.kind() == ErrorKind::NotFound => continue,
            Err(error) => return Err(ResultsError::file("read", path)(error)),
        };
        if size > LARGEST {
            let [size, most] = [size, LARGEST].map(|bytes| bytes as f64 / f64::from(1 << 20));
            body += &paragraph(&format!(
                "{name} ({what}) is left out here: it has {size:.1} MiB, and {most:.0} MiB is the most that goes into a report."
            ));
            continue;
        }
        let bytes = plain::read(&path).map_err(ResultsError::file("read", &path))?;
        if !bytes.starts_with(start) {
            body += &paragraph(&format!("{name} ({what}) is left out: the file is damaged."));
            continue;
        }
        body += &format!(
            "<figure><img src=\"data:{kind};base64,{}\" alt=\"{}: {what}\"><figcaption>{name}: {what}</figcaption></figure>\n",
            base64(&bytes),
            escape(&left.title())
        );
    }
    if body.is_empty() && left.summary.is_none() {
        body = paragraph("A run makes its pictures at its end; there are none yet.");
    }
    Ok(section("Pictures", &body))
}

/// Rows of a history, as plots want them.
fn rows(history: &History) -> Vec<Vec<f64>> {
    (0..history.rows()).map(|row| history.values.iter().map(|values| values[row]).collect()).collect()
}

/// Plots of energies and of probes and forces; empty without two rows.
pub(super) fn plots(left: &Left) -> Option<[String; 2]> {
    let history = left.history.as_ref().filter(|history| history.rows() > 1)?;
    Some(charts(&history.columns, &rows(history), &left.title(), left.is_of_whole_bodies))
}

/// Histories of probes and forces.
pub(super) fn history(left: &Left) -> String {
    let Some([_, svg]) = plots(left) else { return String::new() };
    let rows = left.history.as_ref().map_or(0, History::rows);
    let caption = format!(
        "From {rows} rows of history.csv; of long curves the lowest and highest values of each stretch are drawn. \
            Forces are those of one instant."
    );
    section("Histories", &plot(&svg, "Positions of probes and forces of contacts and obstacles over time", &caption))
}
