//! `history.csv` read back, also the growing `history.csv.part` of a run that continues.
//!
//! Columns and rows come from the result folder; they go to `embate report` and to anyone who follows a run.
//! [`unit`] says what the columns are in.

use super::ResultsError;
use super::atomic::part_path;
use crate::plain;
use embate_solver::output::{FieldKind, fields_of};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Name of the file.
const HISTORY: &str = "history.csv";

/// A history by columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Values of each column, SI, as many as there are rows.
    pub values: Vec<Vec<f64>>,
}

impl History {
    /// That of a result folder; of a run that continues as far as there are whole lines. `None`: there is
    /// none.
    ///
    /// # Errors
    /// [`ResultsError::Damaged`] with the line that is not as a run writes it; what the system says.
    pub fn read(folder: &Path) -> Result<Option<Self>, ResultsError> {
        let path = folder.join(HISTORY);
        for (path, grows) in [(path.clone(), false), (part_path(&path), true), (path, false)] {
            // A run that ends between the first two looks has renamed the file.
            match plain::read(&path) {
                Ok(bytes) => return Self::of_bytes(&bytes, grows, path).map(Some),
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                Err(error) => return Err(ResultsError::file("read", path)(error)),
            }
        }
        Ok(None)
    }

    fn of_bytes(bytes: &[u8], grows: bool, path: PathBuf) -> Result<Self, ResultsError> {
        let damaged = |line: usize, what: String| ResultsError::Damaged { path: path.clone(), line, what };
        let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        let lines = bytes[..whole].iter().filter(|&&byte| byte == b'\n').count();
        if !grows && whole < bytes.len() {
            return Err(damaged(lines + 1, "the line has no end: the file was cut off".into()));
        }
        let text = std::str::from_utf8(&bytes[..whole]).map_err(|error| {
            let before = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
            damaged(before + 1, "this is no text".into())
        })?;
        let mut lines = (1..).zip(text.lines());
        let Some((_, head)) = lines.next() else {
            // The first line of a run that has just begun is being written.
            return if grows { Ok(Self::default()) } else { Err(damaged(1, "the line of names is missing".into())) };
        };
        let columns = names(head).ok_or_else(|| damaged(1, "a name in quotes has no end".into()))?;
        let mut values = vec![Vec::new(); columns.len()];
        for (number, line) in lines {
            let found = line.split(',').count();
            if found != columns.len() {
                return Err(damaged(number, format!("{found} values for {} columns", columns.len())));
            }
            for (own, text) in values.iter_mut().zip(line.split(',')) {
                own.push(text.parse().map_err(|_| damaged(number, format!("`{}` is no number", shortened(text))))?);
            }
        }
        Ok(Self { columns, values })
    }

    /// How many rows it has.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Values of the column of this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let place = self.columns.iter().position(|own| own == name)?;
        self.values.get(place).map(Vec::as_slice)
    }

    /// At most so many rows, two at least: the first, the last, and of equal stretches between them the row
    /// that stands out most from the mean of its stretch in any column, measured by what that column spans,
    /// so that a peak stays.
    #[must_use]
    pub fn decimated(&self, rows: usize) -> Self {
        let all = self.rows();
        let rows = rows.max(2);
        if all <= rows {
            return self.clone();
        }
        let mut kept = vec![0];
        let spans: Vec<f64> = self.values.iter().map(|values| span(values)).collect();
        let stretches = rows - 2;
        for stretch in 0..stretches {
            let [from, to] = [stretch, stretch + 1].map(|k| 1 + k * (all - 2) / stretches);
            kept.push(self.outstanding(from..to, &spans));
        }
        kept.push(all - 1);
        let values = self.values.iter().map(|values| kept.iter().map(|&row| values[row]).collect()).collect();
        Self { columns: self.columns.clone(), values }
    }

    /// The row of a stretch that is farthest from the mean of any column.
    fn outstanding(&self, stretch: std::ops::Range<usize>, spans: &[f64]) -> usize {
        let mut most = (0.0, stretch.start);
        for (values, span) in self.values.iter().zip(spans).filter(|(_, span)| **span > 0.0) {
            let own = &values[stretch.clone()];
            let mean = own.iter().sum::<f64>() / own.len() as f64;
            for (row, value) in stretch.clone().zip(own) {
                let far = (value - mean).abs() / span;
                if far > most.0 {
                    most = (far, row);
                }
            }
        }
        most.1
    }
}

/// Distance of the smallest from the largest finite value.
fn span(values: &[f64]) -> f64 {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let [low, high] = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
    (high - low).max(0.0)
}

/// The first line; a name with a comma stands in quotes.
fn names(line: &str) -> Option<Vec<String>> {
    let mut names = vec![String::new()];
    let (mut is_quoted, mut chars) = (false, line.chars().peekable());
    while let Some(c) = chars.next() {
        let last = names.last_mut()?;
        match c {
            '"' if is_quoted && chars.peek() == Some(&'"') => last.extend(chars.next()),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => names.push(String::new()),
            c => last.push(c),
        }
    }
    (!is_quoted).then_some(names)
}

fn shortened(text: &str) -> String {
    if text.chars().count() > 30 { text.chars().take(29).chain(['…']).collect() } else { text.to_string() }
}

/// Unit of a column of the history; energies and forces are per metre of depth, or `of_whole_bodies` (space,
/// axisymmetric). Empty: a number without unit, or a column of another program.
#[must_use]
pub fn unit(column: &str, of_whole_bodies: bool) -> &'static str {
    let per_depth = |plane, whole| if of_whole_bodies { whole } else { plane };
    let what = column.split('[').next().unwrap_or(column);
    let last = what.rsplit('.').next().unwrap_or(what);
    match what {
        "time" | "time_step" => return "s",
        _ if what.starts_with("energy.") || last == "energy" => return per_depth("J/m", "J"),
        "cavity.pressure" => return "Pa",
        "cavity.volume" => return per_depth("m^3/m", "m^3"),
        "cavity.mass" => return per_depth("kg/m", "kg"),
        "cavity.temperature" => return "K",
        "cavity.work" => return per_depth("J/m", "J"),
        _ => {}
    }
    let of_field = |kind: &&FieldKind| {
        last == kind.name
            || last.strip_prefix(kind.name).and_then(|rest| rest.strip_prefix('_')).is_some_and(|rest| kind.components.contains(&rest))
    };
    if what.contains('.')
        && let Some(kind) = fields_of(if of_whole_bodies { 3 } else { 2 }).iter().find(of_field)
    {
        return kind.unit;
    }
    match last.strip_suffix(['x', 'y', 'z']).map_or(last, |stem| stem.trim_end_matches('_')) {
        "force" | "normal_force" | "shear_force" => per_depth("N/m", "N"),
        "moment" => per_depth("N", "N m"),
        "friction_work" => per_depth("J/m", "J"),
        "penetration" | "" => "m",
        "angle" | "turn" => "rad",
        "spin" => "rad/s",
        "v" => "m/s",
        "a" => "m/s^2",
        // Where an extreme is.
        place if place.ends_with("_at") => "m",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, grows: bool) -> Result<History, String> {
        History::of_bytes(text.as_bytes(), grows, "history.csv".into()).map_err(|error| error.to_string())
    }

    #[test]
    fn a_history_is_read_by_columns_and_names_may_have_commas() {
        let history = read("time,\"energy.kinetic[a, \"\"b\"\"]\"\n0,1e3\n1e-7,NaN\n", false).unwrap();
        assert_eq!(history.columns, ["time", "energy.kinetic[a, \"b\"]"]);
        assert_eq!(history.column("time"), Some(&[0.0, 1e-7][..]));
        assert!(history.values[1][0] == 1e3 && history.values[1][1].is_nan() && history.rows() == 2);
    }

    #[test]
    fn the_last_line_of_a_growing_history_waits_until_it_is_complete() {
        for cut in ["time,a\n0,1\n", "time,a\n0,1\n1", "time,a\n0,1\n1,", "time,a\n0,1\n1,2"] {
            assert_eq!(read(cut, true).unwrap().values, [[0.0], [1.0]], "{cut}");
        }
        assert_eq!(read("ti", true).unwrap(), History::default());
        assert_eq!(read("", true).unwrap(), History::default());
    }

    #[test]
    fn damage_is_reported_with_its_line() {
        let what = |text: &str| read(text, false).unwrap_err();
        assert!(what("time,a\n0,1\n0\n").starts_with("history.csv, line 3: 1 values for 2 columns"));
        assert!(what("time,a\n0,x\n").starts_with("history.csv, line 2: `x` is no number"));
        assert!(what("time,a\n0,1\n0,1").starts_with("history.csv, line 3: the line has no end"));
        assert!(what("").starts_with("history.csv, line 1: the line of names is missing"));
        assert!(what("\"time\n").starts_with("history.csv, line 1: a name in quotes"));
        let bytes = History::of_bytes(b"time\n1\n\xff\n", false, "history.csv".into()).unwrap_err().to_string();
        assert!(bytes.starts_with("history.csv, line 3: this is no text"), "{bytes}");
    }

    #[test]
    fn thinning_keeps_ends_and_a_peak() {
        let mut force = vec![0.0; 10_000];
        force[7_321] = 5.0;
        let time: Vec<f64> = (0..10_000).map(f64::from).collect();
        let thin = History { columns: vec!["time".into(), "f".into()], values: vec![time, force] }.decimated(100);
        assert_eq!((thin.rows(), thin.values[0][0], thin.values[0][99]), (100, 0.0, 9_999.0));
        assert!(thin.values[1].contains(&5.0) && thin.values[0].windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(thin.decimated(100), thin);
        assert_eq!((thin.decimated(0).rows(), thin.decimated(3).rows()), (2, 3));
    }

    #[test]
    fn columns_have_units_in_2d_and_of_whole_bodies() {
        let units = |column: &str| [unit(column, false), unit(column, true)];
        assert_eq!(units("energy.kinetic[bar]"), ["J/m", "J"]);
        assert_eq!(units("contact.force_x[hit]"), ["N/m", "N"]);
        assert_eq!(units("obstacle.moment[roll]"), ["N", "N m"]);
        assert_eq!(units("contact.penetration[hit.x]"), ["m", "m"]);
        assert_eq!((units("cavity.pressure[gas]"), units("cavity.mass[gas]")), (["Pa"; 2], ["kg/m", "kg"]));
        assert_eq!((units("cavity.volume[gas]"), units("cavity.work[gas]")), (["m^3/m", "m^3"], ["J/m", "J"]));
        assert_eq!((units("P.ax"), units("P.spin_z"), units("cut.normal_force[c]")), (["m/s^2"; 2], ["rad/s"; 2], ["N/m", "N"]));
        assert_eq!((units("P.von_mises"), units("P.stress_xx"), units("P.displacement_y")), (["Pa"; 2], ["Pa"; 2], ["m"; 2]));
        assert_eq!((units("P.von_mises_at_x"), units("P.stress_xx_at_y")), (["m"; 2], ["m"; 2]));
        assert_eq!((units("P.x"), units("P.vy"), units("time")), (["m"; 2], ["m/s"; 2], ["s"; 2]));
        assert_eq!((units("rigid.spin[a]"), units("rigid.angle[a]"), units("rigid.vz[a]")), (["rad/s"; 2], ["rad"; 2], ["m/s"; 2]));
    }
}
