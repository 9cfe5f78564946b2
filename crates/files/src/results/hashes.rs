//! `hashes.csv`: what the states of a run were every so many steps, as hashes of the whole and of each part,
//! so that two runs can be held against each other later.
//!
//! Lines come from the simulation through the recorder, and grow as those of the history. Each ends with a
//! check sum of what stands before it: a line that was changed is distinguished from a run that was another.
//! [`HashTable::read`] gives them to `embate diff`, also those of a run that was killed.

use super::atomic::part_path;
use super::csv::{append_number, append_text};
use super::{HASHES, ResultsError};
use crate::plain;
use embate_solver::hashes::Hashes;
use flate2::Crc;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::ErrorKind;
use std::path::Path;

/// Columns before those of the hashes.
const FIRST: [&str; 3] = ["step", "time", "time_step"];
/// Columns of hashes before those of the parts.
const HASHED: [&str; 3] = ["state", "contacts", "bodies"];
/// The last column: CRC32 of the text of its line until there.
const CHECK: &str = "check";

/// The line of names of the table with these parts.
pub(super) fn names(parts: &[String]) -> String {
    let mut names = FIRST.iter().chain(&HASHED).map(|name| format!("{name},")).collect::<String>();
    for name in parts {
        append_text(&mut names, &format!("part[{name}]"));
        names.push(',');
    }
    names.push_str(CHECK);
    names.push('\n');
    names
}

/// Appends the line of a state.
pub(super) fn append_line(text: &mut String, hashes: &Hashes) {
    let Hashes { step, time, time_step, state, contacts, bodies, parts } = hashes;
    let mut line = format!("{step},");
    for number in [*time, *time_step] {
        append_number(&mut line, number);
        line.push(',');
    }
    for hash in [state, contacts, bodies].into_iter().chain(parts) {
        // Writing to a string can't fail.
        let _ = write!(line, "{hash:016x},");
    }
    let _ = writeln!(text, "{line}{:08x}", sum(&line));
}

fn sum(line: &str) -> u32 {
    let mut crc = Crc::new();
    crc.update(line.as_bytes());
    crc.sum()
}

/// What a run left of the hashes of its states.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HashTable {
    /// Names of the parts.
    pub parts: Vec<String>,
    /// By their steps.
    pub lines: BTreeMap<u64, Hashes>,
}

impl HashTable {
    /// That of a folder of results, complete or not; `None`: there is none.
    ///
    /// # Errors
    /// [`ResultsError::Damaged`] with the line that gave it away; what the system says.
    pub fn read(folder: &Path) -> Result<Option<Self>, ResultsError> {
        let whole = folder.join(HASHES);
        for path in [part_path(&whole), whole] {
            match plain::read(&path) {
                Ok(bytes) => return Self::of(&bytes, &path).map(Some),
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                Err(error) => return Err(ResultsError::file("read", &path)(error)),
            }
        }
        Ok(None)
    }

    fn of(bytes: &[u8], path: &Path) -> Result<Self, ResultsError> {
        let damaged = |line: usize, what: &str| ResultsError::Damaged { path: path.into(), line, what: what.into() };
        // A line that was not written to its end was not written.
        let end = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
        let text = std::str::from_utf8(&bytes[..end]).map_err(|error| {
            let before = &bytes[..error.valid_up_to()];
            damaged(1 + before.iter().filter(|&&byte| byte == b'\n').count(), "it is no text")
        })?;
        let mut lines = text.lines().zip(1..);
        let (names, _) = lines.next().ok_or_else(|| damaged(1, "there is nothing in it"))?;
        let parts = parts(names).ok_or_else(|| damaged(1, "these are not the names of its columns"))?;
        let mut table = Self { parts, lines: BTreeMap::new() };
        for (line, number) in lines {
            let hashes = hashes(line, table.parts.len()).map_err(|what| damaged(number, what))?;
            if table.lines.last_key_value().is_some_and(|(&last, _)| last >= hashes.step) {
                return Err(damaged(number, "its step is not after that of the line before"));
            }
            table.lines.insert(hashes.step, hashes);
        }
        Ok(table)
    }
}

/// The parts that a line of names has. Names are plain, so none stands in quotes.
fn parts(names: &str) -> Option<Vec<String>> {
    let names: Vec<&str> = names.split(',').collect();
    let (first, rest) = names.split_at_checked(FIRST.len() + HASHED.len())?;
    let (&last, parts) = rest.split_last()?;
    let is_known = first.iter().eq(FIRST.iter().chain(&HASHED)) && last == CHECK;
    let name = |column: &&str| column.strip_prefix("part[")?.strip_suffix(']').map(String::from);
    parts.iter().map(name).collect::<Option<Vec<String>>>().filter(|_| is_known)
}

fn hashes(line: &str, parts: usize) -> Result<Hashes, &'static str> {
    let (text, check) = line.rsplit_once(',').ok_or("it has no columns")?;
    if format!("{:08x}", sum(&format!("{text},"))) != check {
        return Err("its check sum is not that of what stands before it");
    }
    let wrong = "it has other columns";
    let columns: Vec<&str> = text.split(',').collect();
    let (&[step, time, time_step], hashed) = columns.split_first_chunk().ok_or(wrong)?;
    let hash = |text: &&str| u64::from_str_radix(text, 16).map_err(|_| "a hash is none");
    let hashed: Vec<u64> = hashed.iter().map(hash).collect::<Result<_, _>>()?;
    let (&[state, contacts, bodies], of_parts) = hashed.split_first_chunk().ok_or(wrong)?;
    if of_parts.len() != parts {
        return Err(wrong);
    }
    let number = |text: &str| text.parse::<f64>().map_err(|_| "a time is none");
    let step = step.parse().map_err(|_| "its step is no number")?;
    Ok(Hashes { step, time: number(time)?, time_step: number(time_step)?, state, contacts, bodies, parts: of_parts.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> (String, HashTable) {
        let parts = vec!["a".to_string(), "b-2".to_string()];
        let mut text = "step,time,time_step,state,contacts,bodies,part[a],part[b-2],check\n".to_string();
        let mut table = HashTable { parts, lines: BTreeMap::new() };
        for step in [0, 10, 23] {
            let time = 0.1 * step as f64;
            let hashes = Hashes { step, time, time_step: 1e-9 / 3.0, state: u64::MAX, contacts: 0, bodies: 7, parts: vec![step, 1 << 63] };
            let line = format!("{step},{time},{:e},{:016x},{:016x},{:016x},{step:016x},{:016x},", 1e-9 / 3.0, u64::MAX, 0, 7, 1_u64 << 63);
            text.push_str(&format!("{line}{:08x}\n", sum(&line)));
            table.lines.insert(step, hashes);
        }
        (text, table)
    }

    #[test]
    fn a_table_reads_back_and_a_line_that_is_not_whole_does_not_count() {
        let (text, table) = table();
        let read = |text: &str| HashTable::of(text.as_bytes(), Path::new("hashes.csv"));
        assert_eq!(read(&text).unwrap(), table);
        let torn = read(&text[..text.len() - 5]).unwrap();
        assert_eq!(torn.lines.keys().copied().collect::<Vec<_>>(), [0, 10]);
    }

    #[test]
    fn every_changed_byte_is_reported_with_its_line() {
        let (text, table) = table();
        let read = |bytes: &[u8]| HashTable::of(bytes, Path::new("hashes.csv"));
        for at in 0..text.len() - 1 {
            for flip in [1, 0x80] {
                let mut bytes = text.clone().into_bytes();
                bytes[at] ^= flip;
                let line = 1 + text[..at].matches('\n').count();
                match read(&bytes) {
                    Err(ResultsError::Damaged { line: reported, .. }) => {
                        assert!(reported == line || reported == line + 1, "{at}: {reported}")
                    }
                    // A name may be another one: no part of the other run will have it.
                    Ok(read) => assert!(line == 1 && read.parts != table.parts, "{at}"),
                    Err(error) => panic!("{error}"),
                }
            }
        }
        let lines: Vec<&str> = text.lines().collect();
        let swapped = [lines[0], lines[2], lines[1]].join("\n") + "\n";
        assert!(read(swapped.as_bytes()).unwrap_err().to_string().contains("line 3"));
        assert!(read(b"").is_err() && read(b"time\n0\n").is_err());
    }
}
